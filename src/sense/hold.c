/* SPDX-License-Identifier: MIT */
#include "insole/sense/hold.h"

static bool hold(insole_real_t *value, insole_real_t last, insole_real_t limit)
{
    bool fine = insole_abs(*value) <= limit;
    if (!fine) {
        *value = last;
    }
    return !fine;
}

INSOLE_COLD bool insole_hold(insole_vec3_t *v, insole_vec3_t last, insole_real_t limit)
{
    if (!v) {
        return false;
    }
    bool x = hold(&v->x, last.x, limit), y = hold(&v->y, last.y, limit);
    return hold(&v->z, last.z, limit) || x || y;
}
