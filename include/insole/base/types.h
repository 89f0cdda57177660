/** @file types.h  The records that travel between the rooms.
 *
 *  Frames: b body of the sensor, any mounting; n local level, z up; m map, x east, y north.
 *  Time: microseconds, uint64_t; never a float. Headings: counter-clockwise from +x, (-pi, pi].
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_BASE_TYPES_H
#define INSOLE_BASE_TYPES_H

#include "insole/base/fastmath.h"
#include "insole/base/quat.h"
#include "insole/base/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/** In halves, each of which a processor converts; the upper one is most often empty. */
static inline insole_real_t insole_seconds_of(uint64_t us)
{
    insole_real_t all_us = (insole_real_t)(uint32_t)us;
    if (us >> 32 != 0u) {
        all_us += (insole_real_t)(uint32_t)(us >> 32) * INSOLE_R(4294967296.0);
    }
    return all_us * INSOLE_R(1.0e-6);
}

/** From one time stamp to a later one. */
insole_real_t insole_seconds(uint64_t from_us, uint64_t to_us);

/** Rounded, of a time from 0 to an hour. */
static inline uint32_t insole_microseconds(insole_real_t s)
{
    return (uint32_t)(s * INSOLE_R(1.0e6) + INSOLE_R(0.5));
}

/** A place on the map, or a way on it. */
typedef struct {
    insole_real_t x_m, y_m;
} insole_spot_t;

static inline bool insole_spot_is_finite(insole_spot_t spot)
{
    return insole_is_finite(spot.x_m) && insole_is_finite(spot.y_m);
}

static inline insole_spot_t insole_spot(insole_real_t x_m, insole_real_t y_m)
{
    insole_spot_t spot = {x_m, y_m};
    return spot;
}

static inline insole_spot_t insole_spot_add(insole_spot_t a, insole_spot_t b)
{
    return insole_spot(a.x_m + b.x_m, a.y_m + b.y_m);
}

static inline insole_spot_t insole_spot_sub(insole_spot_t a, insole_spot_t b)
{
    return insole_spot(a.x_m - b.x_m, a.y_m - b.y_m);
}

/** a + s b */
static inline insole_spot_t insole_spot_add_scaled(insole_spot_t a, insole_real_t s,
                                                   insole_spot_t b)
{
    return insole_spot(a.x_m + s * b.x_m, a.y_m + s * b.y_m);
}

static inline insole_spot_t insole_spot_scale(insole_real_t s, insole_spot_t a)
{
    return insole_spot(s * a.x_m, s * a.y_m);
}

/** A quarter turn to the left. */
static inline insole_spot_t insole_spot_left(insole_spot_t a)
{
    return insole_spot(-a.y_m, a.x_m);
}

static inline insole_real_t insole_spot_dot(insole_spot_t a, insole_spot_t b)
{
    return a.x_m * b.x_m + a.y_m * b.y_m;
}

/** Length of a way. */
static inline insole_real_t insole_spot_norm(insole_spot_t a)
{
    return insole_sqrt(insole_spot_dot(a, a));
}

/** A way on the plane, turned; longer or shorter when `turn` is not of unit length. */
static inline insole_spot_t insole_turn_way(insole_turn_t turn, insole_spot_t way)
{
    insole_spot_t turned = {turn.cos * way.x_m - turn.sin * way.y_m,
                            turn.sin * way.x_m + turn.cos * way.y_m};
    return turned;
}

/** One reading of accelerometer and gyroscope. */
typedef struct {
    uint64_t t_us;
    insole_vec3_t accel_mps2; /**< specific force, b: +g upwards at rest */
    insole_vec3_t gyro_radps; /**< turn rate, b */
} insole_imu_t;

/** One reading of a magnetometer, b. */
typedef struct {
    uint64_t t_us;
    insole_vec3_t field_ut;
} insole_mag_t;

/** One access point heard. */
typedef struct {
    uint32_t id;           /**< index of the access point in the caller's list */
    insole_real_t rss_dbm; /**< received signal strength */
    uint32_t age_us;       /**< time since the radio heard it */
} insole_rss_t;

/** All access points that arrive together. */
typedef struct {
    uint64_t t_us;
    const insole_rss_t *readings;
    uint32_t count;
} insole_scan_t;

/** One range to an anchor (RTT or UWB). */
typedef struct {
    uint64_t t_us;
    uint32_t id; /**< index of the anchor in the caller's list */
    insole_real_t range_m;
    insole_real_t sigma_m; /**< 1-sigma told by the radio; <= 0: not told */
} insole_range_t;

/** A start that somebody knows. */
typedef struct {
    uint64_t t_us;
    insole_real_t x_m, y_m;    /**< m */
    bool has_heading;          /**< false: direction unknown */
    insole_real_t heading_rad; /**< direction walked over the first two strides */
    insole_real_t sigma_m;     /**< 1-sigma of each coordinate */
    insole_real_t sigma_rad;   /**< 1-sigma of the heading */
} insole_start_t;

/** One step as an accelerometer on the body feels it. */
typedef struct {
    uint64_t begin_us, end_us;      /**< peaks of |a|: of the step before, of this one */
    insole_real_t peak_mps2;        /**< height of its peak over the mean of |a| */
    insole_real_t range_mps2;       /**< largest - smallest smoothed |a| over the step */
    insole_real_t accel_sigma_mps2; /**< scatter of |a|, not smoothed, over the step */
} insole_footfall_t;

/** One step of a walker whose phone counts steps. */
typedef struct {
    uint64_t t_us;
    insole_real_t length_m;
    insole_quat_t attitude;          /**< b to n */
    insole_sym3_t attitude_cov_rad2; /**< of the small rotation in n */
    insole_real_t accel_sigma_mps2;  /**< scatter of |a| over the step */
} insole_step_t;

/** One stride of the foot, from a stance to the next. */
typedef struct {
    uint64_t begin_us, end_us;    /**< end of the stance before; begin of the stance after */
    insole_vec3_t displacement_m; /**< n, by the inertial filter */
    insole_real_t length_m;       /**< horizontal, by the inertial filter */
    insole_real_t model_length_m; /**< by [TwoOrder (33)] */
    insole_real_t heading_rad;    /**< direction of the displacement */
    insole_real_t turn_rad;       /**< change of the foot's yaw */
    insole_real_t accel_min_mps2; /**< smallest vertical acceleration on the way */
    insole_real_t accel_max_mps2; /**< largest */
} insole_stride_t;

/** How far a position can be trusted. */
typedef enum {
    INSOLE_FIX_ALIGN = 0,  /**< no attitude yet: the sensor has not been still */
    INSOLE_FIX_SEARCH = 1, /**< moving, but the place on the map is not known */
    INSOLE_FIX_TRACK = 2,  /**< all is well */
    INSOLE_FIX_COAST = 3,  /**< samples are missing; carried on without them */
    INSOLE_FIX_LOST = 4    /**< the position no longer means anything */
} insole_fix_state_t;

/** A position that leaves the library. */
typedef struct {
    uint64_t t_us;
    insole_vec3_t position_m;  /**< m (or n where there is no map) */
    insole_real_t heading_rad; /**< direction walked */
    insole_real_t var_x_m2, cov_xy_m2, var_y_m2, var_z_m2;
    insole_real_t var_heading_rad2;
    insole_fix_state_t state;
} insole_fix_t;

#ifdef __cplusplus
}
#endif

#endif
