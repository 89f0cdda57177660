/* SPDX-License-Identifier: MIT */
#include "insole/fuse/particle_start.h"

#define ZERO INSOLE_R(0.0)
#define ONE  INSOLE_R(1.0)

#define SIGMA_MAX_M INSOLE_R(1e4)

INSOLE_COLD insole_status_t insole_particle_start_check(const insole_particle_start_t *start)
{
    if (!start) {
        return INSOLE_ERR_NULL;
    }
    bool fits = insole_is_finite(start->x_m) && insole_is_finite(start->y_m) &&
                insole_is_finite(start->offset_rad) && start->sigma_m >= ZERO &&
                start->sigma_m <= SIGMA_MAX_M && start->sigma_offset_rad >= ZERO;
    return fits ? INSOLE_OK : INSOLE_ERR_VALUE;
}

INSOLE_COLD insole_status_t insole_particle_origin_check(const insole_particle_origin_t *origin)
{
    if (!origin) {
        return INSOLE_ERR_NULL;
    }
    bool fits = insole_is_finite(origin->offset_rad) && origin->sigma_offset_rad >= ZERO;
    return fits ? insole_spot_fix_check(&origin->at) : INSOLE_ERR_VALUE;
}

insole_cloud_source_t insole_particle_start_source(const insole_particle_start_t *start,
                                                   insole_real_t sigma_scale)
{
    insole_real_t variance = insole_square(start->sigma_m);
    insole_cloud_source_t source = {.x_m = start->x_m,
                                    .y_m = start->y_m,
                                    .var_x_m2 = variance,
                                    .var_y_m2 = variance,
                                    .offset_rad = insole_wrap_pi(start->offset_rad),
                                    .sigma_offset_rad = start->sigma_offset_rad,
                                    .scale = ONE,
                                    .sigma_scale = sigma_scale};
    return source;
}

insole_cloud_source_t insole_particle_origin_source(const insole_particle_origin_t *origin,
                                                    insole_real_t sigma_bias_m,
                                                    insole_real_t sigma_scale)
{
    insole_real_t bias_m2 = origin->by_radio ? insole_square(sigma_bias_m) : ZERO;
    insole_cloud_source_t source = {.offset_rad = insole_wrap_pi(origin->offset_rad),
                                    .sigma_offset_rad = origin->sigma_offset_rad,
                                    .scale = ONE,
                                    .sigma_scale = sigma_scale};
    insole_cloud_source_put(&source, origin->at.spot,
                            insole_sym2_add(origin->at.cov_m2, insole_sym2_circle(bias_m2)));
    return source;
}
