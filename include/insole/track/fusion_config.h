/** @file fusion_config.h  All settings of the shoe's second order, and the memory it is lent.
 *
 *      insole_foot_fusion_config_t config = insole_foot_fusion_defaults;
 *      config.method = INSOLE_FUSION_TWO_ORDER;
 *      insole_foot_fusion_init(&shoe, &config, &memory, &building, seed);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TRACK_FUSION_CONFIG_H
#define INSOLE_TRACK_FUSION_CONFIG_H

#include "insole/fuse/particle_filter.h"
#include "insole/place/range_fix.h"
#include "insole/place/rss_fix.h"
#include "insole/track/foot_config.h"
#include "insole/track/fusion_start.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum {
    INSOLE_FUSION_BEST = 0,      /**< whatever is given is used as well as we know how */
    INSOLE_FUSION_TWO_ORDER = 1, /**< the paper's second stage as printed */
    INSOLE_FUSION_WIFI = 2       /**< radio alone */
} insole_foot_fusion_method_t;

/* clang-format off */
#define INSOLE_FOOT_FUSION_KEYS(KEY)                                                              \
    KEY(CHOICE, method, 0, 0, 2, "best|two-order|wifi", "what makes the position")                \
    KEY(REAL, lag_s, 0.0, 0.0, 60.0, "s",                                                         \
        "each position is told so late, smoothed by what came after; 0 = at once")                \
    KEY(REAL, sigma_inertial_m, 1.0, 0.01, 100.0, "m",                                            \
        "two-order: sigma_1 of (34), how far the inertial position is trusted")                   \
    KEY(REAL, sigma_range_m, 2.0, 0.01, 100.0, "m",                                               \
        "two-order: sigma_2 of (39), of a range from signal strength")                            \
    KEY(INT, start_fixes, 1, 1, 8, "",                                                            \
        "fixes of radio that a start takes which nobody tells; more than 1 tell a direction, too") \
    KEY(REAL, unsure_start_m, 0.5, 0.0, 100.0, "m",                                               \
        "1-sigma added to a start that radio has found")                                          \
    KEY(REAL, search_sigma_m, 1.0, 0.1, 1000.0, "m",                                              \
        "a cloud with a larger 1-sigma is still searching")                                       \
    KEY(REAL, search_margin, 0.05, 0.0, 100.0, "",                                                \
        "so is one when scans are so much likelier elsewhere, in logarithms")
/* clang-format on */

typedef struct {
    INSOLE_FOOT_FUSION_KEYS(INSOLE_CONFIG_MEMBER)
    insole_foot_tracker_config_t foot;
    insole_particle_filter_config_t particles;
    insole_particle_filter_config_t two_order; /**< those of the paper */
    insole_rss_fix_config_t rss_fix;
    insole_range_fix_config_t range_fix;
} insole_foot_fusion_config_t;

/** The fusion's own, which it keeps, and those of radio alone; its parts keep theirs. */
typedef struct {
    INSOLE_FOOT_FUSION_KEYS(INSOLE_CONFIG_MEMBER)
    insole_rss_fix_config_t rss_fix;
    insole_range_fix_config_t range_fix;
} insole_foot_fusion_own_t;

extern const insole_foot_fusion_config_t insole_foot_fusion_defaults;

/** What the caller lends. What is not lent is not linked either. */
typedef struct {
    insole_particle_t *particles;
    uint32_t count;
    insole_spot_t *past;             /**< count x past_strides, for `lag_s`; NULL: no lag */
    uint32_t past_strides;           /**< as many as a walker makes in `lag_s`, and two more */
    insole_fusion_ranges_t *ranges;  /**< set up; NULL: ranges are refused */
    insole_fusion_starter_t starter; /**< for `start_fixes` beyond 1 */
    const insole_step_weighing_calls_t *steps; /**< &insole_step_weighing_calls, for soft walls */
} insole_fusion_memory_t;

/** @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE for a setting out of its range */
insole_status_t insole_fusion_config_check(const insole_foot_fusion_config_t *config);

/** @return INSOLE_ERR_NULL for what is not there and wanted, with such settings; INSOLE_ERR_VALUE
 *          for no particles or too many */
insole_status_t insole_fusion_memory_check(const insole_fusion_memory_t *memory,
                                           const insole_foot_fusion_config_t *config);

static inline insole_cloud_t insole_fusion_cloud(const insole_fusion_memory_t *memory)
{
    insole_cloud_t cloud = {memory->particles, memory->count, memory->past,
                            memory->past ? memory->past_strides : 0u, 0};
    return cloud;
}

#ifdef __cplusplus
}
#endif

#endif
