/** @file radio_bias.h  The error that fixes by radio share for a while: one mean for each particle.
 *
 *  Source  ours: fixes from fingerprints a few seconds apart err alike, as bodies and crowds stay
 *          what they are. [PhoneEKF] 4 weighs particles by a normal kernel about the fix, with its
 *          covariance: that is this with sigma_m = 0 and floor = 0.
 *  Frames  m: map.
 *
 *  The bias is a Gauss-Markov process. Given where a particle went it is normal, and a Kalman
 * filter follows its mean (Rao and Blackwell): b <- b + K v with v = fix - place - b. The
 * covariance does not depend on the way, so all particles share one, P. The weight is that of v in
 * S = R + P:
 *
 *      exp(-v' S^-1 v / 2) + floor
 *
 *  `floor` is for fixes that are wrong altogether; by the share of it the bias is not corrected.
 *
 *      insole_radio_bias_init(&radio, 3.5, 15, 0.01);
 *      on each fix:
 *          insole_radio_bias_hear(&radio, &fix);
 *          for each particle:
 *              log_weight += insole_radio_bias_weigh(&radio, place_then, &bias[i]);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_FUSE_RADIO_BIAS_H
#define INSOLE_FUSE_RADIO_BIAS_H

#include "insole/fuse/step_news.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
    insole_real_t sigma_m, time_s, floor;
    insole_real_t most_m; /**< of sigma_m */
    insole_sym2_t P;      /**< m^2, of the bias of a particle about its mean */
    bool has_time;
    uint64_t t_us; /**< of the newest fix */

    insole_spot_t spot;           /**< the fix in work */
    insole_sym2_t W;              /**< S^-1 */
    insole_spot_t gain_x, gain_y; /**< rows of K = P W, with P from before */
    insole_real_t memory;         /**< share of a bias that is left of the fix before */
} insole_radio_bias_t;

/** Nothing has been heard, nothing is known of the bias.
 *  @param sigma_m  1-sigma of each coordinate, 0 .. 1000; 0: errors are white
 *  @param time_s   the bias forgets in so long, > 0 .. 1e6
 *  @param floor    of the weight, beside 1 at its peak; 0 .. 1
 *  @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE */
insole_status_t insole_radio_bias_init(insole_radio_bias_t *radio, insole_real_t sigma_m,
                                       insole_real_t time_s, insole_real_t floor);

/** Forgets all that was heard; all means must be set to 0. */
void insole_radio_bias_forget(insole_radio_bias_t *radio);

/** From now on fixes share errors of this 1-sigma, or of that of init when it is smaller.
 *  @return INSOLE_ERR_NULL; INSOLE_ERR_VALUE for one that is negative or not finite */
insole_status_t insole_radio_bias_limit(insole_radio_bias_t *radio, insole_real_t sigma_m);

/** Takes a fix to be weighed by; `since` is not looked at.
 *  @param learns  whether means will be corrected; if not, P stays
 *  @return INSOLE_ERR_NULL; INSOLE_ERR_VALUE as insole_spot_fix_check(); INSOLE_ERR_TIME for a fix
 *          that is not newer than the one before */
insole_status_t insole_radio_bias_hear(insole_radio_bias_t *radio, const insole_spot_fix_t *fix,
                                       bool learns);

/** Logarithm of the weight of a particle that was at `spot` when it was heard.
 *  @param[in,out] bias  its mean, is moved on to the fix and corrected; NULL: 0 and stays */
insole_real_t insole_radio_bias_weigh(const insole_radio_bias_t *radio, insole_spot_t spot,
                                      insole_spot_t *bias);

/** The mean for a particle that was drawn about the fix with R + P: what it is, by the fix alone.
 */
insole_spot_t insole_radio_bias_at(const insole_radio_bias_t *radio, insole_spot_t spot);

#ifdef __cplusplus
}
#endif

#endif
