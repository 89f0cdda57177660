/* SPDX-License-Identifier: MIT */
#include "insole/fuse/soft_walls.h"

#include "insole/base/fastmath.h"

void insole_soft_walls_begin(insole_soft_walls_t *soft, insole_real_t depth_m, insole_real_t weight,
                             insole_real_t least_free)
{
    soft->depth_m = depth_m;
    soft->log_weight = insole_log(weight);
    soft->least_free = least_free;
    soft->seen = 0u;
    soft->closed = 0u;
}

void insole_soft_walls_look(insole_soft_walls_t *soft, const insole_floor_plan_t *plan,
                            insole_real_t x_m, insole_real_t y_m)
{
    soft->seen++;
    soft->closed += insole_floor_plan_is_closed(plan, x_m, y_m, soft->depth_m) ? 1u : 0u;
}

bool insole_soft_walls_count(const insole_soft_walls_t *soft)
{
    insole_real_t free = (insole_real_t)(soft->seen - soft->closed);
    return soft->closed > 0u && free >= soft->least_free * (insole_real_t)soft->seen;
}

insole_real_t insole_soft_walls_weigh(const insole_soft_walls_t *soft,
                                      const insole_floor_plan_t *plan, insole_real_t x_m,
                                      insole_real_t y_m)
{
    bool closed =
        insole_soft_walls_count(soft) && insole_floor_plan_is_closed(plan, x_m, y_m, soft->depth_m);
    return closed ? soft->log_weight : INSOLE_R(0.0);
}
