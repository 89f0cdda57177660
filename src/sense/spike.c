/* SPDX-License-Identifier: MIT */
#include "insole/sense/spike.h"

/* A neighbour of a spike lies this much nearer to the other neighbour than to the spike. */
static const insole_real_t SPIKE_SHARE = INSOLE_R(0.25);

static bool mend(insole_real_t before, insole_real_t *middle, insole_real_t after,
                 insole_real_t limit)
{
    insole_real_t rise = *middle - before, fall = *middle - after;
    insole_real_t least = insole_min(insole_abs(rise), insole_abs(fall));
    bool spike = rise * fall > INSOLE_R(0.0) && least > limit &&
                 insole_abs(after - before) < SPIKE_SHARE * least;
    if (spike) {
        *middle = INSOLE_R(0.5) * (before + after);
    }
    return spike;
}

bool insole_spike_mend(insole_vec3_t before, insole_vec3_t *middle, insole_vec3_t after,
                       insole_real_t limit)
{
    if (!middle) {
        return false;
    }
    bool x = mend(before.x, &middle->x, after.x, limit);
    bool y = mend(before.y, &middle->y, after.y, limit);
    bool z = mend(before.z, &middle->z, after.z, limit);
    return x || y || z;
}
