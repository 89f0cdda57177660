/* SPDX-License-Identifier: MIT */
#include "insole/fuse/step_ukf.h"

#include "insole/base/unscented.h"

#define ZERO INSOLE_R(0.0)
#define ONE  INSOLE_R(1.0)

enum { N = 2, POINTS = 2 * N + 1 };

insole_step_way_t insole_step_ukf(const insole_pace_t *pace)
{
    /* L + lambda = 3 is right to the fourth moment; then beta = 0 is, too. */
    insole_unscented_t ut = insole_unscented(N, ONE, ZERO, ONE);
    insole_real_t var_heading_rad2 = insole_min(pace->var_heading_rad2, INSOLE_HEADING_MOST_R2);
    const insole_real_t qd[N] = {pace->heading_rad, pace->length_m};
    const insole_real_t root[N * N] = {insole_sqrt(var_heading_rad2), ZERO, /* [PhoneUKF (41)] */
                                       ZERO, insole_sqrt(pace->var_length_m2)};
    insole_real_t points[POINTS * N], values[POINTS * N], mean[N], Q[N * N];
    insole_unscented_points(&ut, qd, root, points);
    for (uint32_t i = 0u; i < POINTS * N; i += N) {
        insole_turn_t t = insole_turn(points[i]);
        values[i] = points[i + 1u] * t.cos; /* [PhoneUKF (38)] */
        values[i + 1u] = points[i + 1u] * t.sin;
    }
    insole_unscented_mean(&ut, N, values, mean);                    /* [PhoneUKF (39)] */
    insole_unscented_cov(&ut, N, values, mean, N, values, mean, Q); /* [PhoneUKF (40)] */
    insole_step_way_t way = {insole_spot(mean[0], mean[1]), insole_sym2(Q[0], Q[1], Q[3])};
    return way;
}

static insole_status_t step_state(void *state, uint64_t t_us, const insole_pace_t *pace)
{
    (void)t_us;
    return insole_step_fusion_step(state, insole_step_ukf, pace);
}

const insole_step_filter_calls_t insole_step_ukf_calls = {
    .start = insole_step_fusion_begin_state,
    .step = step_state,
    .fix = insole_step_fusion_fix_state,
    .answer = insole_step_fusion_answer_state,
};
