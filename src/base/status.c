/* SPDX-License-Identifier: MIT */
#include "insole/base/status.h"

const char *insole_status_text(insole_status_t status)
{
    switch (status) {
    case INSOLE_OK:
        return "ok";
    case INSOLE_ERR_NULL:
        return "NULL pointer";
    case INSOLE_ERR_VALUE:
        return "value not finite or out of range";
    case INSOLE_ERR_TIME:
        return "time stamp does not advance";
    case INSOLE_ERR_STATE:
        return "call does not fit the state";
    case INSOLE_ERR_ROOM:
        return "memory handed in is too small";
    case INSOLE_ERR_DATA:
        return "data damaged or of another version";
    }
    return "unknown status";
}
