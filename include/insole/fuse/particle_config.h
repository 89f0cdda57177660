/** @file particle_config.h  All settings of the particle filter.
 *
 *  Source  [TwoOrder] 3.2, 4.1: `insole_particle_filter_two_order`; ours: the defaults, for a shoe,
 *          and `insole_particle_filter_phone`, for the steps of a phone and fixes by fingerprints;
 *          [PhoneEKF] 4.1: `insole_particle_filter_phone_plain`; [WifiShift] I, IV:
 *          `insole_particle_filter_phone_wpf`, `insole_particle_filter_phone_zee`.
 *
 *      insole_particle_filter_config_t config = insole_particle_filter_defaults;
 *      config.walls = INSOLE_WALLS_OFF;
 *      insole_particle_filter_init(&filter, &config, seed);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_FUSE_PARTICLE_CONFIG_H
#define INSOLE_FUSE_PARTICLE_CONFIG_H

#include "insole/base/config.h"
#include "insole/fuse/cloud_source.h"
#include "insole/fuse/weighing.h"
#include "insole/place/rss_field.h"

#ifdef __cplusplus
extern "C" {
#endif

/* clang-format off */
#define INSOLE_PARTICLE_FILTER_KEYS(KEY)                                                          \
    KEY(REAL, sigma_length_m, 0.02, 0.0, 10.0, "m", "sigma_s of (32), length of a stride")        \
    KEY(REAL, turn_share, 0.0, 0.0, 10.0, "",                                                     \
        "sigma_psi of (32), as a share of the turn from stride to stride")                        \
    KEY(REAL, sigma_wander_rad, 0.01, 0.0, 3.0, "rad",                                           \
        "1-sigma of the offset's change in a stride")                                             \
    KEY(REAL, sigma_scale, 0.01, 0.0, 1.0, "", "1-sigma of the scale of strides; 0 = none")       \
    KEY(REAL, scale_memory, 0.99, 0.0, 1.0, "",                                                   \
        "share of a particle's scale that stays from stride to stride")                           \
    KEY(CHOICE, walls, 2, 0, 3, "off|inside|crosses|soft", "what a plan kills a particle for")    \
    KEY(REAL, resample_share, 0.5, 0.0, 1.0, "",                                                  \
        "resampled when the effective number is a smaller share of all; 0 = never")               \
    KEY(REAL, spread_share, 0.3, 0.0, 1.0, "",                                                    \
        "copies are spread by so much of the cloud's 1-sigma; 0 = not")                           \
    KEY(REAL, redraw_share, 0.15, 0.0, 0.5, "",                                                    \
        "share of the cloud drawn where scans point when they point elsewhere; 0 = none")         \
    KEY(REAL, redraw_margin, 0.08, 0.0, 100.0, "",                                                \
        "how much likelier scans must be elsewhere, in logarithms")                               \
    KEY(REAL, redraw_offset_rad, 0.8, 0.0, 3.1, "rad", "1-sigma of the offset of those drawn")   \
    KEY(REAL, recover_sigma_m, 0.5, 0.01, 100.0, "m",                                             \
        "1-sigma added when all have died; twice as much each time")                              \
    KEY(REAL, recover_offset_rad, 0.09, 0.0, 3.1, "rad", "the same for the offset")               \
    KEY(REAL, search_power, 8.0, 0.0, 100.0, "",                                                  \
        "a scan says so much more to a cloud far wider than search_sigma_m")                      \
    KEY(REAL, blind_power, 0.1, 0.001, 1.0, "",                                                   \
        "a scan says so much less where no plan tells of walls")                                  \
    KEY(REAL, blind_search_power, 2.0, 0.0, 100.0, "", "search_power there")                      \
    KEY(REAL, search_sigma_m, 1.5, 0.01, 100.0, "m", "1-sigma of a cloud to which it says half")  \
    KEY(REAL, search_offset_rad, 0.7, 0.01, 10.0, "rad", "the same for the offset")               \
    KEY(REAL, wide_offset_rad, 0.6, 0.0, 3.1, "rad",                                              \
        "with a larger 1-sigma of the offset the direction counts as unknown to the radio")       \
    KEY(REAL, length_share, 0.0, 0.0, 10.0, "",                                                   \
        "1-sigma of a stride's length as a share of it, beside sigma_length_m")                   \
    KEY(REAL, sigma_heading_rad, 0.0, 0.0, 3.0, "rad",                                            \
        "1-sigma of a stride's direction, beside turn_share")                                     \
    KEY(CHOICE, scatter, 0, 0, 1, "shared|apart",                                                 \
        "scale and offset change with the errors of length and direction, or by themselves")      \
    KEY(REAL, soft_depth_m, 1.0, 0.0, 100.0, "m",                                                 \
        "soft walls: so deep in what is not walkable a place counts as closed")                   \
    KEY(REAL, soft_weight, 0.2, 0.001, 1.0, "", "soft walls: weight of a stride that ends there") \
    KEY(REAL, soft_least, 0.02, 0.0, 1.0, "",                                                     \
        "soft walls: with a smaller share of particles elsewhere they do not count")              \
    KEY(REAL, bias_sigma_m, 3.5, 0.0, 1000.0, "m",                                                \
        "1-sigma of the error that fixes by fingerprints share for a while; 0 = none")            \
    KEY(REAL, bias_s, 15.0, 0.1, 1.0e6, "s", "time in which that error is forgotten")             \
    KEY(REAL, fix_floor, 0.01, 0.0, 1.0, "", "least weight by a fix, beside 1 for the best place") \
    KEY(REAL, fix_ahead_m, 1.0, -10.0, 10.0, "m", "a fix lies so far ahead of the walker")
/* clang-format on */

typedef struct {
    INSOLE_PARTICLE_FILTER_KEYS(INSOLE_CONFIG_MEMBER)
    insole_rss_field_config_t field;
} insole_particle_filter_config_t;

extern const insole_particle_filter_config_t insole_particle_filter_defaults;

/** The paper's second stage as printed: no offset, no scale, (40) at the end of a stride. As an
 *  initialiser, for settings that hold these. */
#define INSOLE_PARTICLE_FILTER_TWO_ORDER                                                           \
    {                                                                                              \
        .sigma_length_m = INSOLE_R(0.1), .turn_share = INSOLE_R(0.2),                              \
        .scale_memory = INSOLE_R(1.0), .walls = INSOLE_WALLS_INSIDE,                               \
        .search_power = INSOLE_R(1.0), .blind_power = INSOLE_R(1.0),                               \
        .blind_search_power = INSOLE_R(1.0), .search_sigma_m = INSOLE_R(1.0),                      \
        .search_offset_rad = INSOLE_R(1.0), .resample_share = INSOLE_R(0.5),                       \
        .recover_sigma_m = INSOLE_R(0.5), .soft_weight = INSOLE_R(1.0), .bias_s = INSOLE_R(1.0),   \
        .field = {                                                                                 \
            INSOLE_RSS_FIELD_KEYS(INSOLE_CONFIG_DEFAULT)                                           \
        }                                                                                          \
    }
extern const insole_particle_filter_config_t insole_particle_filter_two_order;

enum { INSOLE_SCATTER_SHARED = 0, INSOLE_SCATTER_APART = 1 };

/** What both settings for a phone have in common. */
#define INSOLE_PARTICLE_FILTER_STEPS                                                               \
    .length_share = INSOLE_R(0.3), .sigma_heading_rad = INSOLE_R(0.07),                            \
    .scatter = INSOLE_SCATTER_APART, .resample_share = INSOLE_R(0.5),                              \
    .search_power = INSOLE_R(1.0), .blind_power = INSOLE_R(1.0),                                   \
    .blind_search_power = INSOLE_R(1.0), .search_sigma_m = INSOLE_R(1.0),                          \
    .search_offset_rad = INSOLE_R(1.0), .recover_sigma_m = INSOLE_R(0.5),                          \
    .recover_offset_rad = INSOLE_R(0.09), .field = {INSOLE_RSS_FIELD_KEYS(INSOLE_CONFIG_DEFAULT)}

/** Steps of a phone: the direction wanders by 2.5 degrees a step, the scale by 0.005 about 1 +-
 *  0.12; fixes err together, and a plan may lack doors. */
#define INSOLE_PARTICLE_FILTER_PHONE                                                               \
    {                                                                                              \
        .sigma_wander_rad = INSOLE_R(0.0436), .sigma_scale = INSOLE_R(0.12),                       \
        .scale_memory = INSOLE_R(0.99913), .walls = INSOLE_WALLS_SOFT,                             \
        .soft_depth_m = INSOLE_R(1.0), .soft_weight = INSOLE_R(0.2), .soft_least = INSOLE_R(0.02), \
        .bias_sigma_m = INSOLE_R(3.5), .bias_s = INSOLE_R(15.0), .fix_floor = INSOLE_R(0.01),      \
        .fix_ahead_m = INSOLE_R(1.0), INSOLE_PARTICLE_FILTER_STEPS                                 \
    }
extern const insole_particle_filter_config_t insole_particle_filter_phone;

/** The paper's rivals: steps as told, no offset that wanders, no scale, no plan, fixes weigh by
 *  their covariance alone. */
#define INSOLE_PARTICLE_FILTER_PHONE_PLAIN                                                         \
    {                                                                                              \
        .scale_memory = INSOLE_R(1.0), .walls = INSOLE_WALLS_OFF, .soft_weight = INSOLE_R(1.0),    \
        .bias_s = INSOLE_R(1.0), INSOLE_PARTICLE_FILTER_STEPS                                      \
    }
extern const insole_particle_filter_config_t insole_particle_filter_phone_plain;

/** The fingerprint particle filter that [WifiShift] compares with, its reference 16: steps as told
 *  in directions that differ and wander, a wall kills. */
#define INSOLE_PARTICLE_FILTER_PHONE_WPF                                                           \
    {                                                                                              \
        .sigma_wander_rad = INSOLE_R(0.02), .scale_memory = INSOLE_R(1.0),                         \
        .walls = INSOLE_WALLS_CROSSES, .soft_weight = INSOLE_R(1.0), .bias_s = INSOLE_R(1.0),      \
        INSOLE_PARTICLE_FILTER_STEPS                                                               \
    }
extern const insole_particle_filter_config_t insole_particle_filter_phone_wpf;

/** The augmented particle filter that [WifiShift] compares with, its reference 18: place, offset
 *  and scale are unknown, a wall kills, and nothing else weighs. No common spread: the cloud may be
 *  in several places. */
#define INSOLE_PARTICLE_FILTER_PHONE_ZEE                                                           \
    {                                                                                              \
        .length_share = INSOLE_R(0.1), .sigma_heading_rad = INSOLE_R(0.05),                        \
        .sigma_wander_rad = INSOLE_R(0.015), .sigma_scale = INSOLE_R(0.1),                         \
        .scale_memory = INSOLE_R(0.999), .scatter = INSOLE_SCATTER_APART,                          \
        .walls = INSOLE_WALLS_CROSSES, .resample_share = INSOLE_R(0.5),                            \
        .soft_weight = INSOLE_R(1.0), .bias_s = INSOLE_R(1.0), .search_power = INSOLE_R(1.0),      \
        .blind_power = INSOLE_R(1.0), .blind_search_power = INSOLE_R(1.0),                         \
        .search_sigma_m = INSOLE_R(1.0), .search_offset_rad = INSOLE_R(1.0),                       \
        .recover_sigma_m = INSOLE_R(1.0), .recover_offset_rad = INSOLE_R(0.1), .field = {          \
            INSOLE_RSS_FIELD_KEYS(INSOLE_CONFIG_DEFAULT)                                           \
        }                                                                                          \
    }
extern const insole_particle_filter_config_t insole_particle_filter_phone_zee;

/** @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE for a setting out of its range */
insole_status_t insole_particle_config_check(const insole_particle_filter_config_t *config);

/** How particles walk a stride that was told. */
insole_cloud_stride_t insole_particle_config_stride(const insole_particle_filter_config_t *config,
                                                    const insole_evidence_t *news);

/** How much a scan says to such a cloud, in powers of its likelihood: what scans say in a row is
 *  much the same, the first ones say something new. Where walls are not known they err together
 *  for longer.
 *  @param is_blind  no plan tells of walls */
insole_real_t insole_particle_config_scan_power(const insole_particle_filter_config_t *config,
                                                const insole_cloud_source_t *cloud, bool is_blind);

#ifdef __cplusplus
}
#endif

#endif
