/* SPDX-License-Identifier: MIT */
#include "method.h"

#include <string.h>

static const char *const names[] = {"best", "two-order", "wifi", "ins", "pdr"};

bool method_parse(const char *name, method_t *method, failure_t *failure)
{
    for (int i = 0; i <= METHOD_PDR; i++) {
        if (strcmp(name, names[i]) == 0) {
            *method = (method_t)i;
            return true;
        }
    }
    return failure_usage(failure, "insole: --method %.40s: expected " METHOD_NAMES, name);
}

const char *method_name(method_t method)
{
    return names[method];
}

method_t method_of(const settings_t *settings)
{
    static const method_t fused[] = {[INSOLE_FUSION_BEST] = METHOD_BEST,
                                     [INSOLE_FUSION_TWO_ORDER] = METHOD_TWO_ORDER,
                                     [INSOLE_FUSION_WIFI] = METHOD_WIFI};
    return fused[settings->fusion.method];
}
