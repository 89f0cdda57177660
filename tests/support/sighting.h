/** @file sighting.h  What every correction of an attitude by a direction must do.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TESTS_SIGHTING_H
#define INSOLE_TESTS_SIGHTING_H

#include "insole/move/attitude.h"
#include "near.h"
#include "refusal.h"
#include "sample.h"

/** Any covariance with a 1-sigma of about `size`; its least axis is no narrower than a share of it.
 */
static inline insole_sym3_t sighting_cov(insole_rng_t *rng, insole_real_t size, insole_real_t share)
{
    insole_mat3_t M = sample_mat3(rng, size);
    return insole_sym3_add_diagonal(insole_mat3_mul_t_sym(M, M), share * size * size);
}

/** Positive for a covariance. */
static inline double sighting_least_pivot(insole_sym3_t s)
{
    double xx = (double)s.xx, xy = (double)s.xy, xz = (double)s.xz;
    double yy = (double)s.yy - xy * xy / xx, yz = (double)s.yz - xy * xz / xx;
    double zz = (double)s.zz - xz * xz / xx - yz * yz / yy;
    return fmin(xx, fmin(yy / (double)s.yy, zz / (double)s.zz));
}

/** Four very sharp sightings of the attitude in a row, gravity every second. */
static inline bool sighting_keeps_positive(insole_attitude_method_t *correct, insole_rng_t *rng,
                                           insole_sym3_t P)
{
    bool positive = true;
    for (int k = 0; k < 4; k++) {
        insole_vec3_t known = k % 2 == 0 ? insole_vec3(0, 0, INSOLE_R(9.81)) : sample_vec3(rng, 50);
        insole_sighting_t s = {known, insole_vec3_add(known, sample_vec3(rng, 1)), INSOLE_R(0.01)};
        insole_correction_t made;
        ck_assert_int_eq(correct(&P, &s, &made), INSOLE_OK);
        positive = positive && sighting_least_pivot(P) > 0.0;
    }
    return positive;
}

static inline void check_sighting_refusals(insole_attitude_method_t *correct)
{
    insole_vec3_t up = insole_vec3(0, 0, INSOLE_R(9.81));
    insole_sighting_t s = {up, up, INSOLE_R(1.0)};
    struct {
        insole_sym3_t P;
        insole_correction_t made;
    } all = {insole_sym3_diagonal(1, 1, 1), {insole_quat_identity(), 7}};
    ASSERT_UNCHANGED(all, correct(NULL, &s, &all.made), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(all, correct(&all.P, NULL, &all.made), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(all, correct(&all.P, &s, NULL), INSOLE_ERR_NULL);
    s.variance = INSOLE_R(-1000.0);
    ASSERT_UNCHANGED(all, correct(&all.P, &s, &all.made), INSOLE_ERR_STATE);
    s.variance = (insole_real_t)NAN;
    ASSERT_UNCHANGED(all, correct(&all.P, &s, &all.made), INSOLE_ERR_STATE);
    s.variance = INSOLE_R(1.0);
    s.seen.x = (insole_real_t)NAN;
    ASSERT_UNCHANGED(all, correct(&all.P, &s, &all.made), INSOLE_ERR_STATE);
    s.seen = up;
    s.known.z = (insole_real_t)INFINITY;
    ASSERT_UNCHANGED(all, correct(&all.P, &s, &all.made), INSOLE_ERR_STATE);
    s.known = up;
    all.P.yy = (insole_real_t)NAN;
    ASSERT_UNCHANGED(all, correct(&all.P, &s, &all.made), INSOLE_ERR_STATE);
}

#endif
