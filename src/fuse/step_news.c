/* SPDX-License-Identifier: MIT */
#include "insole/fuse/step_news.h"

#include "insole/move/heading.h"

#define ZERO INSOLE_R(0.0)

/* More turns than these lose the angle to rounding. */
static const insole_real_t MOST_ANGLE_RAD = INSOLE_R(1.0e3);

/* The attitude is of unit length, but for rounding. */
static const insole_real_t UNIT_LOW = INSOLE_R(0.98), UNIT_HIGH = INSOLE_R(1.02);

static bool is_pace(const insole_pace_t *pace)
{
    return pace->length_m >= ZERO && pace->length_m <= INSOLE_PACE_MOST_M &&
           insole_abs(pace->heading_rad) <= MOST_ANGLE_RAD && pace->var_length_m2 >= ZERO &&
           pace->var_length_m2 <= INSOLE_PACE_MOST_M * INSOLE_PACE_MOST_M &&
           pace->var_heading_rad2 >= ZERO && insole_is_finite(pace->var_heading_rad2);
}

insole_status_t insole_pace_check(const insole_pace_t *pace)
{
    if (!pace) {
        return INSOLE_ERR_NULL;
    }
    return is_pace(pace) ? INSOLE_OK : INSOLE_ERR_VALUE;
}

static bool is_near(insole_spot_t spot)
{
    return insole_abs(spot.x_m) <= INSOLE_SPOT_MOST_M && insole_abs(spot.y_m) <= INSOLE_SPOT_MOST_M;
}

static bool is_usable(insole_spot_t spot, insole_sym2_t cov_m2)
{
    return is_near(spot) &&
           insole_sym2_is_between(cov_m2, INSOLE_SPOT_LEAST_M2, INSOLE_SPOT_MOST_M2);
}

INSOLE_COLD bool insole_spot_is_start(insole_spot_t spot, insole_sym2_t cov_m2,
                                      insole_real_t offset_rad)
{
    return is_usable(spot, cov_m2) && insole_abs(offset_rad) <= MOST_ANGLE_RAD;
}

INSOLE_COLD insole_status_t insole_spot_fix_check(const insole_spot_fix_t *fix)
{
    if (!fix) {
        return INSOLE_ERR_NULL;
    }
    bool usable = is_usable(fix->spot, fix->cov_m2) && is_near(fix->since);
    return usable ? INSOLE_OK : INSOLE_ERR_VALUE;
}

INSOLE_COLD insole_spot_t insole_pace_way(const insole_pace_t *pace, insole_real_t offset_rad)
{
    insole_turn_t ahead = insole_turn(pace->heading_rad + offset_rad);
    /* [PhoneEKF (1)], [PhoneUKF (4)] */
    return insole_spot(pace->length_m * ahead.cos, pace->length_m * ahead.sin);
}

insole_status_t insole_pace_of_step(const insole_step_t *step, insole_real_t var_length_m2,
                                    insole_pace_t *pace)
{
    if (!step || !pace) {
        return INSOLE_ERR_NULL;
    }
    insole_quat_t q = step->attitude;
    insole_real_t size = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z;
    if (!(size > UNIT_LOW && size < UNIT_HIGH)) {
        return INSOLE_ERR_VALUE;
    }
    insole_heading_t heading = insole_heading(q, &step->attitude_cov_rad2);
    insole_pace_t found = {step->length_m, heading.heading_rad, var_length_m2,
                           heading.variance_rad2};
    if (!is_pace(&found)) {
        return INSOLE_ERR_VALUE;
    }
    *pace = found;
    return INSOLE_OK;
}
