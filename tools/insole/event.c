/* SPDX-License-Identifier: MIT */
#include "event.h"

const char *event_name(event_kind_t kind)
{
    static const char *const names[EVENT_KINDS] = {
        "stance", "stride", "step", "start", "scan", "ranges", "resampling", "redraw", "recovery"};
    return names[kind];
}
