/** @file auto_start.h  Where a walk began and which way it went, when nobody tells.
 *
 *  Source  [WifiShift] III.A, eq. (1) (method `circles`); our own (method `moved`, the default).
 *  Frames  m: map.  n: level, the frame of the paces' headings; heading in m = heading in n +
 * offset.
 *
 *      static insole_auto_start_t start;
 *      insole_auto_start_init(&start, &insole_auto_start_defaults, NULL);
 *      on each step:
 *          insole_auto_start_step(&start, &pace);
 *      with a magnetometer, whenever there is news of it:
 *          insole_auto_start_compass(&start, compass_less_gyro_rad, sigma_rad);
 *      on each scan that gave a fix:
 *          insole_auto_start_fix(&start, &fix);
 *          insole_auto_start_answer(&start, &answer);
 *          if (answer.ready) insole_step_fusion_start(&fusion, answer.spot, answer.cov_m2,
 *                                                     answer.offset_rad);
 *
 *  `moved`: each fix, moved back along the way walked, speaks of the same place; least squares over
 *  place and offset. The errors of fixes are alike for seconds: a part of them is a Gauss-Markov
 *  process, and the sums below are those of what is new in each fix (generalised least squares, in
 *  constant memory). Given the fixes, the offset's density is that of von Mises, exactly; what a
 *  compass tells is taken as one, too, and the product of two of them is one again. So it is
 *  answered without iterations, from no knowledge of the direction on.
 *
 *  `circles`: circle_start.h over the first `fixes` fixes, as printed, with the running mean of the
 *  places. A compass is of no use to it. Who does not give
 *  `&insole_auto_start_circles` to the init does not link it.
 *
 *  The covariance is that of least squares: what fixes have in common stays, however many there
 *  are. The direction's variance is never less than that of its density. To `circles` the squared
 *  difference between both answers is added: the errors of the efficient answer and this difference
 *  are not correlated.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_FUSE_AUTO_START_H
#define INSOLE_FUSE_AUTO_START_H

#include "insole/base/config.h"
#include "insole/fuse/circle_start.h"
#include "insole/fuse/step_news.h"

#ifdef __cplusplus
extern "C" {
#endif

/* clang-format off */
#define INSOLE_AUTO_START_KEYS(KEY)                                                               \
    KEY(CHOICE, method, 0, 0, 1, "moved|circles", "how the start is found")                       \
    KEY(INT, fixes, 5, 1, 8, "fixes", "lambda: ready no sooner")                                  \
    KEY(REAL, refine_rad, 0.5, 0.01, 3.2, "rad",                                                  \
        "ready when the 1-sigma of the direction is no larger; 3.2 = after lambda fixes")         \
    KEY(INT, fixes_most, 16, 1, 1000, "fixes", "ready after so many in any case")                 \
    KEY(REAL, bias_m, 3.5, 0.0, 100.0, "m", "1-sigma of the errors that fixes share; 0 = none")   \
    KEY(REAL, bias_s, 15.0, 0.1, 10000.0, "s", "how long they last")                              \
    KEY(REAL, sigma_scale, 0.1, 0.0, 1.0, "", "1-sigma of what all lengths are wrong by")         \
    KEY(REAL, ahead_m, 1.0, -10.0, 10.0, "m", "a fix lies so far ahead of the walker")
/* clang-format on */

typedef struct {
    INSOLE_AUTO_START_KEYS(INSOLE_CONFIG_MEMBER)
} insole_auto_start_config_t;

extern const insole_auto_start_config_t insole_auto_start_defaults;

/** @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE for a setting out of its range */
insole_status_t insole_auto_start_check(const insole_auto_start_config_t *config);

enum { INSOLE_AUTO_START_MOVED = 0, INSOLE_AUTO_START_CIRCLES = 1 };

/** A row of the least squares: of ones, ways and fixes; or what the past makes expect of them. */
typedef struct {
    insole_real_t one;
    insole_spot_t way, radio;
} insole_auto_start_row_t;

/** Sums over the rows of what is new. */
typedef struct {
    insole_real_t ones;          /**< information of the place, 1/m^2 */
    insole_spot_t way, radio;    /**< times ones */
    insole_real_t along, across; /**< ways times fixes: dot and cross products */
} insole_auto_start_sums_t;

typedef struct insole_auto_start insole_auto_start_t;
typedef struct insole_auto_start_answer insole_auto_start_answer_t;

/** What the method `circles` does beside the other. */
typedef struct {
    void (*take)(insole_auto_start_t *start, const insole_auto_start_row_t *row);
    void (*answer)(const insole_auto_start_t *start, insole_auto_start_answer_t *answer);
} insole_auto_start_circles_t;

extern const insole_auto_start_circles_t insole_auto_start_circles;

struct insole_auto_start {
    insole_auto_start_config_t config;
    insole_real_t bias_m;           /**< 1-sigma of what fixes share; no more than the setting */
    uint32_t fixes;                 /**< taken */
    uint64_t fix_us;                /**< of the newest */
    insole_spot_t way;              /**< n, walked since init */
    insole_spot_t ahead;            /**< n, direction of the newest pace; zeros before the first */
    insole_real_t drift_m2;         /**< variance that the paces told */
    insole_spot_t first_way;        /**< n, what the first fix speaks of */
    insole_spot_t first_radio;      /**< m, the first fix: place and sums count from there */
    insole_auto_start_row_t shared; /**< of what is shared with the fix before */
    insole_real_t var_shared_m2;    /**< of the shared error, given the fixes so far */
    insole_auto_start_sums_t sums;
    bool has_compass;
    insole_real_t compass_rad, compass_sigma_rad;
    const insole_auto_start_circles_t *circles;          /**< NULL: only `moved` can be asked */
    insole_circle_pair_t pair[INSOLE_CIRCLE_START_MOST]; /**< circles: the first fixes */
    uint32_t pairs;
    insole_spot_t circle_mean; /**< circles: running mean of the places */
    uint32_t refused;
};

struct insole_auto_start_answer {
    insole_spot_t spot; /**< m, where the walker is now */
    insole_sym2_t cov_m2;
    insole_real_t shared_m2;       /**< of it, by what the newest fix is wrong as well */
    insole_real_t offset_rad;      /**< heading in m less heading in n */
    insole_real_t var_offset_rad2; /**< up to pi^2 / 3: not known */
    insole_spot_t begin;           /**< m, where the first fix was heard */
    uint32_t fixes;
    bool ready; /**< good enough to start, by the settings */
};

/** @param circles  NULL: there are none
 *  @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE for a setting out of its range, or when the method is
 *          `circles` and there are none */
insole_status_t insole_auto_start_init(insole_auto_start_t *start,
                                       const insole_auto_start_config_t *config,
                                       const insole_auto_start_circles_t *circles);

/** @return INSOLE_ERR_NULL; INSOLE_ERR_VALUE as insole_pace_check(), or beyond 100 km */
insole_status_t insole_auto_start_step(insole_auto_start_t *start, const insole_pace_t *pace);

/** All that is known of the offset beside the fixes, in place of what was told before.
 *  @param sigma_rad  > 0; pi / sqrt(3) and more: nothing is known
 *  @return INSOLE_ERR_NULL; INSOLE_ERR_VALUE for an offset beyond 1000 rad or a sigma under 1e-3 */
insole_status_t insole_auto_start_compass(insole_auto_start_t *start, insole_real_t offset_rad,
                                          insole_real_t sigma_rad);

/** From now on fixes share errors of this 1-sigma, or of the setting's when that is smaller.
 *  @return INSOLE_ERR_NULL; INSOLE_ERR_VALUE for one that is negative or not finite */
insole_status_t insole_auto_start_bias(insole_auto_start_t *start, insole_real_t sigma_m);

/** @return INSOLE_ERR_NULL; INSOLE_ERR_TIME for a fix that is not newer than the one before;
 *          INSOLE_ERR_VALUE as insole_spot_fix_check() */
insole_status_t insole_auto_start_fix(insole_auto_start_t *start, const insole_spot_fix_t *fix);

/** What the fixes so far tell.
 *  @return INSOLE_ERR_NULL; INSOLE_ERR_STATE, the answer untouched, before the first fix */
insole_status_t insole_auto_start_answer(const insole_auto_start_t *start,
                                         insole_auto_start_answer_t *answer);

#ifdef __cplusplus
}
#endif

#endif
