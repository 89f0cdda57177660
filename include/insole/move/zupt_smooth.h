/** @file zupt_smooth.h  Where the foot was, seen from afterwards: a fixed-interval smoother.
 *
 *  Source  the smoother of Rauch, Tung and Striebel on the filter of [TwoOrder] 3.1, in the adjoint
 *          form of Bryson and Frazier, which inverts nothing.
 *  Frames  as in zupt_ekf.h.
 *
 *      static insole_zupt_node_t nodes[4096];
 *      static insole_zupt_smooth_t past;
 *      insole_zupt_smooth_init(&past, nodes, 4096);
 *      on each sample, after all that the filter makes of it:
 *          if (insole_zupt_smooth_push(&past, &foot) == INSOLE_ERR_ROOM) {
 *              insole_zupt_smooth_run(&past, 2048);
 *              while (insole_zupt_smooth_take(&past, &smoothed) == INSOLE_OK) use(&smoothed);
 *              insole_zupt_smooth_push(&past, &foot);
 *          }
 *      at the end: run(&past, 0) and take the rest.
 *
 *  The memory is bounded, so a long walk is smoothed in windows that overlap: what leaves has been
 *  seen from at least `keep` samples later, and what stays is smoothed again with what comes. A
 *  stride is enough for what the next stance tells of a swing; some more seconds add what the
 *  filter learns slowly, of tilt and bias.
 *
 *  Backwards over the history runs the adjoint lambda of the error, zero at the newest sample:
 *
 *      x_s = x - P lambda              at a sample: state and covariance as the filter left them
 *      lambda -= H' (y - H x_s) / r    over a correction: what is still unexplained of y
 *      lambda = Phi' lambda            over an interval
 *
 *  and its covariance Lambda, which is what P_s = P - P Lambda P has gained. The noise that the
 *  filter adds in blocks is in P and needs no thought. Nothing passes an alignment or a gap.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_MOVE_ZUPT_SMOOTH_H
#define INSOLE_MOVE_ZUPT_SMOOTH_H

#include "insole/base/ring.h"
#include "insole/move/zupt_ekf.h"

#ifdef __cplusplus
extern "C" {
#endif

/** A sample as it is known afterwards. */
typedef struct {
    uint64_t t_us;
    insole_vec3_t p_m, v_mps; /**< n */
    insole_quat_t q;          /**< b to n */
    insole_sym3_t P_pp_m2;    /**< covariance of p_m */
} insole_zupt_smoothed_t;

/** One sample of the history. */
typedef struct {
    uint64_t t_us;
    bool is_linked;               /**< its state follows from that of the node before, by Phi */
    insole_real_t dt_s;           /**< Phi: interval */
    insole_vec3_t u_mps;          /**< Phi: specific force in n times the interval */
    insole_vec3_t p_m, v_mps;     /**< after the sample's corrections */
    insole_quat_t q;              /**< after the sample's corrections */
    insole_zupt_cov_t P;          /**< after the sample's corrections */
    insole_zupt_trace_t trace;    /**< the corrections */
    insole_zupt_smoothed_t after; /**< filled by insole_zupt_smooth_run */
} insole_zupt_node_t;

typedef struct {
    insole_zupt_node_t *nodes; /**< the caller's */
    insole_ring_t ring;
    uint32_t ready; /**< running number after the newest node that may be taken */
    uint64_t newest_us;
    uint32_t refused; /**< calls answered with a negative status that tells of an error */
} insole_zupt_smooth_t;

/** An empty history in `count` nodes of the caller's, which must live as long as it.
 *  @param count  a power of two, 2 or more
 *  @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE */
insole_status_t insole_zupt_smooth_init(insole_zupt_smooth_t *smooth, insole_zupt_node_t *nodes,
                                        uint32_t count);

/** Remembers the filter's present state; once per sample, after its corrections. A sample that was
 *  left out cuts the history in two.
 *  @return INSOLE_ERR_ROOM when all nodes are in use, INSOLE_ERR_STATE before the filter is
 *          aligned, INSOLE_ERR_TIME when the filter has not moved on since the last call */
insole_status_t insole_zupt_smooth_push(insole_zupt_smooth_t *smooth, const insole_zupt_ekf_t *ekf);

/** Smooths the whole history, in time proportional to it, and makes all but the newest `keep`
 *  samples ready to be taken. */
insole_status_t insole_zupt_smooth_run(insole_zupt_smooth_t *smooth, uint32_t keep);

/** Takes the oldest sample out of the history.
 *  @return INSOLE_ERR_STATE when none is ready */
insole_status_t insole_zupt_smooth_take(insole_zupt_smooth_t *smooth,
                                        insole_zupt_smoothed_t *smoothed);

#ifdef __cplusplus
}
#endif

#endif
