/** @file step_filter.h  What a tracker asks of whatever makes steps and fixes one position.
 *
 *  A filter is its functions and a state that the caller owns and has set up with the stem's own
 *  init. A tracker that holds such a pair links that one filter and no other.
 *
 *      static insole_step_fusion_t fusion;
 *      insole_step_fusion_init(&fusion, &insole_step_fusion_defaults);
 *      insole_step_filter_t filter = {&insole_step_ekf_calls, &fusion};
 *      insole_step_filter_begin_t begin = {t_us, spot, cov_m2, offset_rad, var_offset_rad2};
 *      filter.calls->start(filter.state, &begin);
 *
 *  All return what the calls they stand for return.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_FUSE_STEP_FILTER_H
#define INSOLE_FUSE_STEP_FILTER_H

#include "insole/fuse/step_news.h"

#ifdef __cplusplus
extern "C" {
#endif

/** A start, however it was found. */
typedef struct {
    uint64_t t_us;
    insole_spot_t spot; /**< m */
    insole_sym2_t cov_m2;
    insole_real_t offset_rad;      /**< heading in m less heading in n */
    insole_real_t var_offset_rad2; /**< pi^2 / 3 and more: not known */
    bool from_radio;               /**< it errs as the next fixes will */
    insole_real_t shared_m2;       /**< of each variance in cov_m2: by what they will err as well */
} insole_step_filter_begin_t;

/** The covariance of a start for a filter that has a bias of the fixes of its own, to add it. */
static inline insole_sym2_t insole_step_filter_less_bias(const insole_step_filter_begin_t *begin,
                                                         insole_real_t sigma_bias_m)
{
    insole_real_t less_m2 = insole_min(begin->shared_m2, insole_square(sigma_bias_m));
    return insole_spot_cov(
        insole_sym2_add(begin->cov_m2, insole_sym2_circle(begin->from_radio ? -less_m2 : 0)));
}

typedef struct {
    insole_spot_t spot; /**< m */
    insole_sym2_t cov_m2;
    insole_real_t offset_rad;
    insole_real_t var_offset_rad2; /**< 0 where the filter takes the offset for known */
    insole_real_t scale;           /**< of the lengths of steps; 1 where none is learned */
} insole_step_filter_answer_t;

/** NULL: the filter has no use for it. */
typedef struct {
    insole_status_t (*start)(void *state, const insole_step_filter_begin_t *begin);

    /** Nobody tells where the walk begins, and no fix will: the filter looks for the place itself.
     *  @return other than INSOLE_OK: it cannot */
    insole_status_t (*start_anywhere)(void *state, uint64_t t_us);

    insole_status_t (*step)(void *state, uint64_t t_us, const insole_pace_t *pace);
    insole_status_t (*fix)(void *state, const insole_spot_fix_t *fix);

    /** 1-sigma of what the fixes from now on, and the start that they tell, are wrong by alike; the
     *  filter's own setting is the most. */
    insole_status_t (*bias)(void *state, insole_real_t sigma_m);

    /** The offset as a compass sees it. A filter that takes it may start with an offset that is
     *  hardly known. */
    insole_status_t (*compass)(void *state, insole_real_t offset_rad, insole_real_t sigma_rad);

    /** At most so many particles' worth of what waits. @return true while more is left */
    bool (*work)(void *state, uint32_t particles);

    /** @return INSOLE_ERR_STATE, the answer untouched, before there is one */
    insole_status_t (*answer)(const void *state, insole_step_filter_answer_t *answer);
} insole_step_filter_calls_t;

typedef struct {
    const insole_step_filter_calls_t *calls; /**< NULL: there is no filter */
    void *state;                             /**< stays where it is */
} insole_step_filter_t;

#ifdef __cplusplus
}
#endif

#endif
