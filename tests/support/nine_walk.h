/** @file nine_walk.h  One walk through an inertial filter, written down after each call.
 *
 *  Made by whoever includes it, with the filter that is declared there: by the library's, and in
 *  nine_filter.c by one that is compiled for nine states.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TESTS_NINE_WALK_H
#define INSOLE_TESTS_NINE_WALK_H

#include <string.h>

#include "insole/move/zupt_ekf.h"
#include "sample.h"

enum { NINE_CALLS = 2000, NINE_REALS = 6 + 4 + 45 };

typedef struct {
    insole_status_t status[NINE_CALLS];
    insole_real_t state[NINE_CALLS][NINE_REALS]; /**< p v q and the covariance */
} nine_walk_t;

/** What the filter of nine_filter.c says. */
typedef struct {
    size_t state_bytes, real_bytes;
    insole_real_t sigma_accel_bias_mps2;     /**< by default */
    insole_status_t by_default, with_a_bias; /**< of init */
    bool is_unchanged;                       /**< by the refusal */
} nine_facts_t;

void nine_filter_walk(nine_walk_t *walk);
nine_facts_t nine_filter_facts(void);

static inline void nine_note(const insole_zupt_ekf_t *ekf, insole_real_t *state)
{
    const struct {
        insole_vec3_t p, v;
        insole_quat_t q;
        insole_sym3_t pp, vv, aa;
        insole_mat3_t pv, pa, va;
    } all = {ekf->p_m,  ekf->v_mps, ekf->q,    ekf->P.pp, ekf->P.vv,
             ekf->P.aa, ekf->P.pv,  ekf->P.pa, ekf->P.va};
    memcpy(state, &all, sizeof all);
}

/** One of the calls of the walk: mostly samples, of which some are clipped and some turn far. */
static inline insole_status_t nine_call(insole_zupt_ekf_t *ekf, insole_rng_t *rng, int call)
{
    insole_vec3_t up = insole_vec3(INSOLE_R(0.0), INSOLE_R(0.0), INSOLE_R(9.81));
    insole_vec3_t accel = insole_vec3_add(up, sample_vec3(rng, INSOLE_R(8.0)));
    insole_imu_t imu = {ekf->t_us + 5000u + (uint64_t)(call % 7) * 10u, accel,
                        sample_vec3(rng, call % 50 == 0 ? INSOLE_R(100.0) : INSOLE_R(3.0))};
    switch (call % 40) {
    case 20:
        return insole_zupt_ekf_correct_height(ekf, INSOLE_R(0.1), INSOLE_R(0.01));
    case 30:
        return insole_zupt_ekf_coast(ekf, up, INSOLE_R(0.5), imu.t_us);
    case 35:
        return insole_zupt_ekf_align(ekf, up, INSOLE_R(0.05), INSOLE_R(1.0), imu.t_us);
    default:
        break;
    }
    return call % 40 < 16 && call % 2 == 1
               ? insole_zupt_ekf_correct(ekf, ekf->dt_s, NULL)
               : insole_zupt_ekf_predict(ekf, &imu, call % 11 == 0 ? 5u : 0u);
}

static inline void nine_walk_through(nine_walk_t *walk)
{
    insole_zupt_ekf_config_t config = insole_zupt_ekf_defaults;
    insole_zupt_ekf_t ekf;
    insole_rng_t rng;
    insole_rng_seed(&rng, 9u);
    config.sigma_accel_bias_mps2 = INSOLE_R(0.0);
    (void)insole_zupt_ekf_init(&ekf, &config);
    for (int call = 0; call < NINE_CALLS; call++) {
        walk->status[call] = nine_call(&ekf, &rng, call == 0 ? 35 : call);
        nine_note(&ekf, walk->state[call]);
    }
}

#endif
