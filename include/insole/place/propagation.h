/** @file propagation.h  How strong an access point is heard, and how far it is when heard so
 * strong.
 *
 *  Source  [TwoOrder] 2.4 (10)-(11) Keenan-Motley loss; 3.2 (35)-(38) list of access points, near
 *          threshold, distance.
 *  Frames  m: map, metres; heights above the floor. RSS in dBm, losses in dB.
 *
 *      insole_propagation_ap(&config, x_m, y_m, z_m, &aps[i]);    or from a survey
 *      insole_floor_plan_walls_between(&plan, x, y, aps[i].x_m, aps[i].y_m, &walls);
 *      insole_propagation_expect(&config, &aps[i], x, y, walls.loss_db, body_share, &expected);
 *      log_weight += insole_propagation_log_likelihood(&config, rss_dbm - expected.rss_dbm);
 *
 *  Of the floors of (10) there is one, as in (11). The body's loss is between none (`body_share` 0,
 *  the access point lies ahead) and all of it (1, it lies behind; the paper's constant); 0.5 where
 *  the direction is not known.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_PLACE_PROPAGATION_H
#define INSOLE_PLACE_PROPAGATION_H

#include "insole/base/config.h"
#include "insole/base/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Choices of `tail`. */
enum { INSOLE_TAIL_GAUSS = 0, INSOLE_TAIL_STUDENT = 1 };

/* clang-format off */
#define INSOLE_PROPAGATION_KEYS(KEY)                                                              \
    KEY(REAL, p0_dbm, -38.0, -120.0, 40.0, "dBm",                                                 \
        "RSS at 1 m in free sight, for access points that do not tell theirs")                    \
    KEY(REAL, exponent, 2.0, 0.5, 10.0, "",                                                       \
        "n0 of (10), for access points that do not tell theirs")                                  \
    KEY(REAL, near_m, 1.5, 0.1, 50.0, "m",                                                        \
        "an access point heard as from nearer counts as near, (37); for those that do not tell")  \
    KEY(REAL, wall_db, 5.0, 0.0, 100.0, "dB",                                                     \
        "l_w of (10), for walls of a plan that does not tell; the paper has 20")                  \
    KEY(REAL, walls_max_db, 20.0, 0.0, 1000.0, "dB",                                              \
        "all walls together lose no more: radio finds a way around; 1000 = no limit")             \
    KEY(REAL, multipath_db, 2.0, 0.0, 50.0, "dB", "L_p of (10)")                                  \
    KEY(REAL, body_db, 6.81, 0.0, 50.0, "dB", "L_body of (10), of a body right in the way")       \
    KEY(REAL, height_m, 0.0, -10.0, 10.0, "m", "height of the receiver above the floor")          \
    KEY(REAL, distance_min_m, 0.3, 0.01, 10.0, "m", "nearer is not told apart from this")         \
    KEY(REAL, sigma_db, 6.0, 0.1, 50.0, "dB", "1-sigma of a reading about its expectation")       \
    KEY(CHOICE, tail, 1, 0, 1, "gauss|student", "how likely large deviations are")                \
    KEY(REAL, tail_dof, 3.0, 0.5, 1000.0, "", "degrees of freedom of the student tail")           \
    KEY(REAL, power, 0.12, 0.001, 1.0, "",                                                        \
        "of a reading's likelihood: readings err alike; 1 = as if they did not")
/* clang-format on */

typedef struct {
    INSOLE_PROPAGATION_KEYS(INSOLE_CONFIG_MEMBER)
} insole_propagation_config_t;

extern const insole_propagation_config_t insole_propagation_defaults;

/** An access point or ranging anchor, [TwoOrder (35)]; its id is its index in the caller's list,
 *  [TwoOrder (36)]. */
typedef struct {
    insole_real_t x_m, y_m, z_m;
    insole_real_t p0_dbm;   /**< RSS at 1 m in free sight */
    insole_real_t exponent; /**< n0, > 0 */
    insole_real_t near_dbm; /**< heard at least so strong, it is near: mean RSS at 1.5 m */
} insole_ap_t;

/** Is the place known? */
static inline bool insole_ap_has_place(const insole_ap_t *ap)
{
    return insole_vec3_is_finite(insole_vec3(ap->x_m, ap->y_m, ap->z_m));
}

/** Is it known how strong it is heard? */
static inline bool insole_ap_has_model(const insole_ap_t *ap)
{
    return insole_is_finite(ap->p0_dbm) && ap->exponent > INSOLE_R(0.0) &&
           insole_is_finite(ap->exponent);
}

/** How much of the body stands in the way: none of it for what lies ahead, all of it for what lies
 *  behind, and what lies to the side sees it come in.
 *  @param cos_bearing  cosine of the angle between the walker's direction and the access point
 *  @return 0 .. 1 */
static inline insole_real_t insole_body_share(insole_real_t cos_bearing)
{
    insole_real_t share = INSOLE_R(0.5) - INSOLE_R(1.5) * cos_bearing;
    return insole_max(INSOLE_R(0.0), insole_min(share, INSOLE_R(1.0)));
}

/** What is to be heard of an access point. */
typedef struct {
    insole_real_t distance_m;
    insole_real_t rss_dbm;
} insole_expected_rss_t;

/** How far an access point is. */
typedef struct {
    insole_real_t range_m;
    insole_real_t sigma_m; /**< what `sigma_db` makes of the range, to first order */
} insole_rss_range_t;

/** @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE for a setting out of its range; the other calls take
 *          settings that have passed */
insole_status_t insole_propagation_check(const insole_propagation_config_t *config);

/** An access point of which only the place is known. Its `near_dbm` is what is expected at
 *  `near_m`, with half the body.
 *  @return INSOLE_ERR_VALUE for a place that is not finite */
insole_status_t insole_propagation_ap(const insole_propagation_config_t *config, insole_real_t x_m,
                                      insole_real_t y_m, insole_real_t z_m, insole_ap_t *ap);

/** Distance (38) and expected RSS (10) at the point (x, y).
 *  @param wall_loss_db  of all walls between, k_w l_w of (10)
 *  @param body_share    0 .. 1
 *  @return INSOLE_ERR_VALUE for what is not finite, a negative loss, a share out of range */
insole_status_t insole_propagation_expect(const insole_propagation_config_t *config,
                                          const insole_ap_t *ap, insole_real_t x_m,
                                          insole_real_t y_m, insole_real_t wall_loss_db,
                                          insole_real_t body_share,
                                          insole_expected_rss_t *expected);

/** The distance at which an access point is expected to be heard so: (11) solved for d. No longer
 *  than 10 km.
 *  @return as insole_propagation_expect; INSOLE_ERR_VALUE also for an exponent that is not positive
 */
insole_status_t insole_propagation_range(const insole_propagation_config_t *config,
                                         const insole_ap_t *ap, insole_real_t rss_dbm,
                                         insole_real_t wall_loss_db, insole_real_t body_share,
                                         insole_rss_range_t *range);

/** The access point heard strongest of those that are near, [TwoOrder (37)]. Readings of unknown
 *  ids, or not finite, are passed over; of equals the first counts.
 *  @param[out] reading  index into `readings`
 *  @return INSOLE_ERR_STATE when none is near */
insole_status_t insole_propagation_nearest(const insole_ap_t *aps, uint32_t ap_count,
                                           const insole_rss_t *readings, uint32_t count,
                                           uint32_t *reading);

/** Logarithm of how likely a reading deviates so from its expectation: 0 for none at all, negative
 *  else, tempered by `power`.
 *  @return 0, no opinion, also for NULL and a deviation that is not finite */
insole_real_t insole_propagation_log_likelihood(const insole_propagation_config_t *config,
                                                insole_real_t deviation_db);

#ifdef __cplusplus
}
#endif

#endif
