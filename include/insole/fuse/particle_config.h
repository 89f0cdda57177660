/** @file particle_config.h  All settings of the particle filter.
 *
 *  Source  [TwoOrder] 3.2, 4.1: `insole_particle_filter_two_order`; ours: the defaults.
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
    KEY(CHOICE, walls, 2, 0, 2, "off|inside|crosses", "what a plan kills a particle for")         \
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
        "with a larger 1-sigma of the offset the direction counts as unknown to the radio")
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
        .recover_sigma_m = INSOLE_R(0.5), .field = {                                               \
            INSOLE_RSS_FIELD_KEYS(INSOLE_CONFIG_DEFAULT)                                           \
        }                                                                                          \
    }
extern const insole_particle_filter_config_t insole_particle_filter_two_order;

/** @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE for a setting out of its range */
insole_status_t insole_particle_config_check(const insole_particle_filter_config_t *config);

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
