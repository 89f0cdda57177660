/** @file fusion_radio.h  What radio tells a walking foot, kept until it can be used.
 *
 *  A scan comes before the inertial filter, whose detector looks ahead, has reached its time, and
 *  is wanted only when a stride ends. So it waits twice: until it is known where the foot was, and
 *  until the particles are told.
 *
 *  Frames  n: level, as the inertial filter left it.  m: map.
 *
 *      insole_fusion_radio_t radio = {.ranges = &ranges};
 *      insole_fusion_radio_hear(&radio, &site, &scan);      and ranges alike
 *      on each fix of the foot:
 *          insole_fusion_radio_place(&radio, &site, t_us, n_m);
 *      when a stride ends:
 *          insole_fusion_radio_tell(&radio, &site, end_n_m, &evidence);
 *      whenever a place by radio alone is wanted: radio.fix
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TRACK_FUSION_RADIO_H
#define INSOLE_TRACK_FUSION_RADIO_H

#include "insole/fuse/evidence.h"
#include "insole/place/range_fix.h"
#include "insole/place/rss_field.h"
#include "insole/place/rss_fix.h"

#ifdef __cplusplus
extern "C" {
#endif

enum {
    INSOLE_FUSION_HEARD = 16,                     /**< readings of a scan kept, the strongest */
    INSOLE_FUSION_RANGES = INSOLE_EVIDENCE_RANGES /**< ranges that can wait */
};

/** What is known of the site; all are the caller's and stay where they are. */
typedef struct {
    const insole_building_t *building;          /**< NULL: nothing */
    const insole_rss_fix_config_t *rss_fix;     /**< settings that have passed their check */
    const insole_range_fix_config_t *range_fix; /**< the same */
    bool at_once;                /**< nobody waits for the foot: radio alone is wanted */
    bool nearest_only;           /**< a scan tells of its strongest access point, (37)-(39) */
    insole_real_t sigma_range_m; /**< then, sigma_2 of (39) */
} insole_fusion_site_t;

typedef struct {
    uint32_t scans;   /**< came in */
    uint32_t ranges;  /**< came in */
    uint32_t unused;  /**< scans and ranges for which there was no room */
    uint32_t unknown; /**< scans and ranges without a single usable access point */
} insole_fusion_counts_t;

/** A scan on its way to the particles. */
typedef struct {
    uint64_t t_us;     /**< when it was heard */
    insole_spot_t n_m; /**< n, where the foot was then */
    bool waits;
    uint32_t count;
    insole_rss_t readings[INSOLE_FUSION_HEARD]; /**< strongest first */
} insole_fusion_scan_t;

typedef struct insole_fusion_range_calls insole_fusion_range_calls_t;

/** The same for ranges, with what is made of them: a program that sets none up links nothing of it.
 */
typedef struct {
    const insole_fusion_range_calls_t *calls;
    uint32_t count, placed; /**< of the first `placed` it is known where the foot was */
    insole_range_t range[INSOLE_FUSION_RANGES];
    insole_spot_t n_m[INSOLE_FUSION_RANGES];
} insole_fusion_ranges_t;

typedef struct {
    insole_fusion_counts_t counts;
    insole_fusion_scan_t arrived;   /**< the inertial filter has not come to its time yet */
    insole_fusion_scan_t scan;      /**< waits for the end of a stride */
    insole_fusion_ranges_t *ranges; /**< the caller's; NULL: none can be told */

    insole_anchor_fix_t fix; /**< place by the last scan or ranges alone */
    uint64_t fix_us;
    insole_spot_t fix_n_m; /**< n, where the foot was then */
    bool has_fix;
    bool is_new; /**< for the reader of `fix` to put down */
} insole_fusion_radio_t;

/** @return INSOLE_ERR_NULL */
insole_status_t insole_fusion_ranges_init(insole_fusion_ranges_t *ranges);

/** True when something can be heard. */
bool insole_fusion_radio_has_aps(const insole_fusion_site_t *site);

/** A scan: the strongest readings of known access points are copied. While an earlier one waits for
 *  the foot it is not used.
 *  @return INSOLE_ERR_NULL; INSOLE_ERR_STATE without access points */
insole_status_t insole_fusion_radio_hear(insole_fusion_radio_t *radio,
                                         const insole_fusion_site_t *site,
                                         const insole_scan_t *scan);

/** Ranges of one moment. When there is no more room the oldest leave.
 *  @return as insole_fusion_radio_hear; INSOLE_ERR_STATE also where the site has no calls for them
 */
insole_status_t insole_fusion_radio_range(insole_fusion_radio_t *radio,
                                          const insole_fusion_site_t *site,
                                          const insole_range_t *ranges, uint32_t count);

/** The foot has come to `t_us`: what was heard until then was heard here.
 *  @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE for a place that is not finite */
insole_status_t insole_fusion_radio_place(insole_fusion_radio_t *radio,
                                          const insole_fusion_site_t *site, uint64_t t_us,
                                          insole_spot_t n_m);

/** True when something has waited for a stride since `before_us` or longer. */
bool insole_fusion_radio_waits(const insole_fusion_radio_t *radio, uint64_t before_us);

/** Adds to the evidence all that waits and has its place; it leaves with this. The readings of a
 *  scan stay readable until the next call of place.
 *  @param end_n_m  n, where the stride told last ended
 *  @return INSOLE_ERR_NULL */
insole_status_t insole_fusion_radio_tell(insole_fusion_radio_t *radio,
                                         const insole_fusion_site_t *site, insole_spot_t end_n_m,
                                         insole_evidence_t *evidence);

/** What has its place is dropped, and so is the place by radio: the way since is not known. */
void insole_fusion_radio_forget(insole_fusion_radio_t *radio);

/** The place by radio alone as a fix of its own, once.
 *  @return INSOLE_ERR_NULL, INSOLE_ERR_STATE when there is none that is new */
insole_status_t insole_fusion_radio_take(insole_fusion_radio_t *radio, insole_fix_t *fix);

/** Place and covariance by radio alone into a fix; the rest of it stays.
 *  @return INSOLE_ERR_NULL, INSOLE_ERR_STATE while there is none */
insole_status_t insole_fusion_radio_fix(const insole_fusion_radio_t *radio, insole_fix_t *fix);

/** Draws a place known from elsewhere towards that by radio, each as far as it is certain.
 *  @param n_m     n, where the foot is now
 *  @param turn    from ways in n to ways in m
 *  @param var_m2  of each coordinate of the place in `fix`, >= 0
 *  @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE, INSOLE_ERR_STATE while there is no place by radio */
insole_status_t insole_fusion_radio_mix(const insole_fusion_radio_t *radio, insole_spot_t n_m,
                                        insole_turn_t turn, insole_real_t var_m2,
                                        insole_fix_t *fix);

#ifdef __cplusplus
}
#endif

#endif
