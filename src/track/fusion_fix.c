/* SPDX-License-Identifier: MIT */
#include "insole/track/fusion_fix.h"

#include <stddef.h>

#include "insole/base/fastmath.h"

insole_status_t insole_fusion_fix_by_cloud(const insole_cloud_fix_t *cloud, insole_spot_t then_n_m,
                                           insole_spot_t now_n_m, insole_real_t yaw_rad,
                                           insole_fix_t *fix)
{
    if (!cloud || !fix) {
        return INSOLE_ERR_NULL;
    }
    insole_spot_t gone = {cloud->scale * (now_n_m.x_m - then_n_m.x_m),
                          cloud->scale * (now_n_m.y_m - then_n_m.y_m)};
    gone = insole_turn_way(insole_turn(cloud->offset_rad), gone);
    fix->position_m.x = cloud->x_m + gone.x_m;
    fix->position_m.y = cloud->y_m + gone.y_m;
    fix->var_x_m2 = cloud->var_x_m2;
    fix->cov_xy_m2 = cloud->cov_xy_m2;
    fix->var_y_m2 = cloud->var_y_m2;
    fix->heading_rad = insole_wrap_pi(fix->heading_rad - yaw_rad + cloud->offset_rad);
    fix->var_heading_rad2 = cloud->var_offset_rad2;
    return INSOLE_OK;
}
