/* SPDX-License-Identifier: MIT
 * The smoother against the textbook's: gains P Phi' (P-)^-1 of full matrices, in double. */
#include "insole/move/zupt_smooth.h"

#include <string.h>

#include "foot_filter.h"
#include "near.h"
#include "suite.h"

static const double EPS = (double)INSOLE_REAL_EPSILON;

enum { COUNT = 256 };

/* ---- the textbook ----------------------------------------------------------------------- */

/* One sample: its model, and what a filter of full matrices makes of it. */
typedef struct {
    dense_t Phi, P_before, P_after; /* before and after the corrections */
    column_t dx;                    /* what the corrections added to the state */
    column_t moved;                 /* smoothed less filtered state */
    dense_t P_smoothed;
} textbook_t;

static textbook_t book[COUNT];
static insole_zupt_node_t nodes[COUNT];
static insole_zupt_ekf_t filtered[COUNT];

/* Noise of one sample, as the settings have it. */
static dense_t sample_noise(const insole_zupt_ekf_t *ekf, bool has_bias)
{
    const insole_zupt_ekf_config_t *c = &ekf->config;
    const double dt = (double)ekf->dt_s, w = d3_norm(d3_of(ekf->last_gyro_radps));
    const double g = (double)c->gyro_noise_rad_rts, t = (double)c->gyro_turn_noise_rts * w;
    const double sigma2[4] = {0.0, pow((double)c->accel_noise_mps_rts, 2.0), g * g + t * t,
                              has_bias ? pow((double)c->accel_bias_walk_mps2_rts, 2.0) : 0.0};
    dense_t Q = dense_diagonal(dt);
    for (int i = 0; i < DENSE; i++) {
        Q.at[i][i] *= sigma2[i / 3];
    }
    return Q;
}

/* Corrects `b` for the states first..first+n-1, measured as `y` where the state says `x`. */
static void correct(textbook_t *b, int first, int n, double r, const double *y, const double *x)
{
    dense_t K, P = dense_joseph(&b->P_after, first, n, r, &K);
    column_t z = {{0.0}};
    for (int i = 0; i < n; i++) {
        z.at[i] = y[i] - x[i] - b->dx.at[first + i];
    }
    column_t dx = dense_apply(&K, &z);
    for (int i = 0; i < DENSE; i++) {
        b->dx.at[i] += dx.at[i];
    }
    b->P_after = P;
}

static void backwards(void)
{
    book[COUNT - 1].P_smoothed = book[COUNT - 1].P_after;
    memset(&book[COUNT - 1].moved, 0, sizeof book[COUNT - 1].moved);
    for (int k = COUNT - 2; k >= 0; k--) {
        textbook_t *b = &book[k], *next = &book[k + 1];
        dense_t Phi_t = dense_transpose(next->Phi), W = dense_inverse(next->P_before);
        dense_t PPhi = dense_mul(&b->P_after, &Phi_t), G = dense_mul(&PPhi, &W);
        column_t ahead = next->moved;
        for (int i = 0; i < DENSE; i++) {
            ahead.at[i] += next->dx.at[i];
        }
        b->moved = dense_apply(&G, &ahead);
        dense_t gained = dense_add(next->P_smoothed, -1.0, &next->P_before);
        gained = dense_congruent(&G, &gained);
        b->P_smoothed = dense_add(b->P_after, 1.0, &gained);
    }
}

/* ---- a swing, a stance and a swing ------------------------------------------------------ */

static d3_t before_correction(const insole_zupt_ekf_t *ekf, bool velocity)
{
    return d3_of(velocity ? ekf->v_mps : ekf->p_m);
}

/* One sample through both filters; the covariance is carried on with it, or when it must. */
static void step(insole_zupt_ekf_t *ekf, const gait_t *gait, int k, dense_t *waiting, bool settle)
{
    const double dt = 1.0e-6 * FILTER_STEP_US, t = gait->rest_s + 0.1 + dt * k;
    const bool has_bias = ekf->config.sigma_accel_bias_mps2 > INSOLE_R(0.0);
    const bool still = gait_is_still(gait, t, t + dt);
    textbook_t *b = &book[k];
    d3_t force, rate;
    gait_reading(gait, t, t + dt, &force, &rate);
    (void)filter_feel(ekf, real_of(force), real_of(rate));
    if (settle) {
        (void)insole_zupt_ekf_settle(ekf);
    }
    b->Phi = dense_phi(insole_vec3_scale(ekf->force_mps2, ekf->dt_s), insole_quat_to_mat3(ekf->q),
                       ekf->dt_s);
    dense_t Q = sample_noise(ekf, has_bias);
    *waiting = dense_add(*waiting, 1.0, &Q);
    b->P_before = k > 0 ? dense_congruent(&b->Phi, &book[k - 1].P_after) : dense_of(&ekf->P);
    if (ekf->noise.samples == 0u) {
        b->P_before = dense_add(b->P_before, 1.0, waiting);
        *waiting = dense_diagonal(0.0);
    }
    b->P_after = b->P_before;
    memset(&b->dx, 0, sizeof b->dx);
    if (still) {
        d3_t v = before_correction(ekf, true);
        (void)insole_zupt_ekf_correct(ekf, ekf->dt_s, NULL);
        d3_t y = d3_of(ekf->trace.velocity_mps);
        correct(b, DENSE_V, 3, (double)ekf->trace.velocity_var_m2ps2, &y.x, &v.x);
    }
    if (k == 60 || k == 110) { /* once in a swing, once together with a velocity */
        d3_t p = before_correction(ekf, false);
        const double height = 0.05;
        (void)insole_zupt_ekf_correct_height(ekf, (insole_real_t)height, INSOLE_R(0.01));
        p.z -= b->dx.at[2]; /* the height before both */
        correct(b, DENSE_P + 2, 1, 1.0e-4, &height, &p.z);
    }
}

/* Fills the book, the history and the filter's states. */
static void walk_on(insole_zupt_smooth_t *smooth, double sigma_bias, bool settle)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 1u);
    gait_t gait = gait_usual();
    insole_zupt_ekf_t ekf = filter_swinging(&rng);
    moment_t m = gait_moment(&gait, gait.rest_s + 0.1);
    ekf.config.sigma_accel_bias_mps2 = (insole_real_t)sigma_bias;
    ekf.config.point_share = INSOLE_R(0.0);
    ekf.q = quat_of(m.R);
    memset(&ekf.noise, 0, sizeof ekf.noise);
    if (!(sigma_bias > 0.0)) {
        insole_mat3_t none = insole_mat3_zero();
        ekf.P.bb = insole_sym3_zero();
        ekf.P.pb = ekf.P.vb = ekf.P.ab = none;
    }
    dense_t waiting = dense_diagonal(0.0);
    ck_assert_int_eq(insole_zupt_smooth_init(smooth, nodes, COUNT), INSOLE_OK);
    for (int k = 0; k < COUNT; k++) {
        step(&ekf, &gait, k, &waiting, settle);
        filtered[k] = ekf;
        ck_assert_int_eq(insole_zupt_smooth_push(smooth, &ekf), INSOLE_OK);
    }
}

static void walk_through(insole_zupt_smooth_t *smooth, double sigma_bias)
{
    walk_on(smooth, sigma_bias, true);
}

static column_t moved_by(const insole_zupt_smoothed_t *s, const insole_zupt_ekf_t *ekf)
{
    column_t x = {{0.0}};
    column_put(&x, DENSE_P, insole_vec3_sub(s->p_m, ekf->p_m));
    column_put(&x, DENSE_V, insole_vec3_sub(s->v_mps, ekf->v_mps));
    d33_t C = d33_of(insole_quat_to_mat3(s->q));
    column_put(&x, DENSE_A, real_of(turn_between(d33_of(insole_quat_to_mat3(ekf->q)), C)));
    return x;
}

static dense_t position_block(insole_sym3_t P)
{
    dense_t d = dense_diagonal(0.0);
    dense_put(&d, 0, 0, insole_sym3_full(P));
    return d;
}

/* With and without bias states. A swing begins anywhere, a stance tells most of what there is to
 * know, and the height is told twice: alone, and in one sample together with a velocity. */
START_TEST(smooths_like_the_textbook)
{
    insole_zupt_smooth_t smooth;
    walk_through(&smooth, _i == 0 ? 0.05 : 0.0);
    ck_assert_int_eq(insole_zupt_smooth_run(&smooth, 0u), INSOLE_OK);
    if (_i == 1) { /* the textbook's inverse needs a bias that is not known */
        for (int k = 0; k < COUNT; k++) {
            for (int i = DENSE_B; i < DENSE; i++) {
                book[k].P_before.at[i][i] = 1.0;
            }
        }
    }
    backwards();
    worst_t off[3] = {{0.0, 0.0}, {0.0, 0.0}, {0.0, 0.0}}, variance = {0.0, 0.0};
    double most[3] = {0.0, 0.0, 0.0};
    for (int k = 0; k < COUNT; k++) {
        insole_zupt_smoothed_t s;
        ck_assert_int_eq(insole_zupt_smooth_take(&smooth, &s), INSOLE_OK);
        ck_assert_uint_eq(s.t_us, filtered[k].t_us);
        column_t x = moved_by(&s, &filtered[k]);
        for (int i = 0; i < DENSE_B; i++) {
            worst_note(&off[i / 3], fabs(x.at[i] - book[k].moved.at[i]), k);
            most[i / 3] = fmax(most[i / 3], fabs(book[k].moved.at[i]));
        }
        dense_t got = position_block(s.P_pp_m2), scale = position_block(filtered[k].P.pp);
        insole_zupt_cov_t block = dense_to_cov(&book[k].P_smoothed);
        dense_t expected = position_block(block.pp);
        worst_note(&variance, dense_off(&got, &expected, &scale), k);
    }
    ck_assert(most[0] > 1.0 && most[1] > 0.5 && most[2] > 0.05); /* there was much to do */
    ASSERT_WORST(off[0], 1.0e3 * EPS, "m");
    ASSERT_WORST(off[1], 300.0 * EPS, "m/s");
    ASSERT_WORST(off[2], 100.0 * EPS, "rad");
    ASSERT_WORST(variance, 3.0e3 * EPS, "(of the filter's)");
}
END_TEST

/* Takes all that is ready. @return how many */
static uint32_t take_all(insole_zupt_smooth_t *smooth, insole_zupt_smoothed_t *out)
{
    uint32_t count = 0u;
    while (insole_zupt_smooth_take(smooth, &out[count]) == INSOLE_OK) {
        count++;
    }
    return count;
}

/* A covariance that is carried on for several samples at once leaves out how the sensor turns under
 * its bias meanwhile: of 1 m/s^2, with 10 rad/s over 40 ms, a twelfth of 0.4 rad (40 ms)^2 = 0.05
 * mm and 2 mm/s in the worst of blocks, of which there are twelve before the stance. What counts is
 * the bias that the filter found. */
START_TEST(smooths_in_blocks_as_by_samples)
{
    const double bias = _i == 0 ? 0.05 : 0.0, position = 12.0 * 5.0e-5, velocity = 2.0e-3;
    static insole_zupt_smoothed_t by_samples[COUNT], in_blocks[COUNT];
    insole_zupt_smooth_t smooth;
    worst_t off[2] = {{0.0, 0.0}, {0.0, 0.0}};
    walk_on(&smooth, bias, true);
    (void)insole_zupt_smooth_run(&smooth, 0u);
    ck_assert_uint_eq(take_all(&smooth, by_samples), COUNT);
    walk_on(&smooth, bias, false);
    (void)insole_zupt_smooth_run(&smooth, 0u);
    ck_assert_uint_eq(take_all(&smooth, in_blocks), COUNT);
    for (int k = 0; k < COUNT; k++) {
        const insole_zupt_smoothed_t *a = &by_samples[k], *b = &in_blocks[k];
        worst_note(&off[0], d3_norm(d3_of(insole_vec3_sub(a->p_m, b->p_m))), k);
        worst_note(&off[1], d3_norm(d3_of(insole_vec3_sub(a->v_mps, b->v_mps))), k);
    }
    insole_vec3_t shift =
        insole_vec3_sub(filtered[COUNT - 1].accel_bias_mps2, filtered[0].accel_bias_mps2);
    const double found = d3_norm(d3_of(shift));
    ck_assert(_i == 0 ? found > 0.1 : found == 0.0);
    ASSERT_WORST(off[0], found * position + 1.0e3 * EPS, "m");
    ASSERT_WORST(off[1], found * velocity + 300.0 * EPS, "m/s");
}
END_TEST

/* ---- windows ---------------------------------------------------------------------------- */

static void refill(insole_zupt_smooth_t *smooth, uint32_t room, int from, int to)
{
    ck_assert_int_eq(insole_zupt_smooth_init(smooth, nodes, room), INSOLE_OK);
    for (int k = from; k < to; k++) {
        ck_assert_int_eq(insole_zupt_smooth_push(smooth, &filtered[k]), INSOLE_OK);
    }
}

START_TEST(keeps_the_newest)
{
    static insole_zupt_smoothed_t all[COUNT], first[COUNT], rest[COUNT];
    insole_zupt_smooth_t smooth;
    walk_through(&smooth, 0.05);
    ck_assert_uint_eq(take_all(&smooth, all), 0u); /* not before a run */
    ck_assert_int_eq(insole_zupt_smooth_run(&smooth, COUNT + 1u), INSOLE_OK);
    ck_assert_uint_eq(take_all(&smooth, all), 0u);
    ck_assert_int_eq(insole_zupt_smooth_run(&smooth, 0u), INSOLE_OK);
    ck_assert_uint_eq(take_all(&smooth, all), COUNT);

    refill(&smooth, COUNT, 0, COUNT);
    ck_assert_int_eq(insole_zupt_smooth_run(&smooth, 100u), INSOLE_OK);
    ck_assert_uint_eq(take_all(&smooth, first), COUNT - 100u);
    ck_assert(memcmp(first, all, (COUNT - 100u) * sizeof *all) == 0);
    ck_assert_int_eq(insole_zupt_smooth_run(&smooth, 0u), INSOLE_OK);
    ck_assert_uint_eq(take_all(&smooth, rest), 100u);
    ck_assert(memcmp(rest, all + COUNT - 100, 100u * sizeof *all) == 0);
}
END_TEST

/* What is pushed after a window has been taken belongs to the same history. */
START_TEST(goes_round_its_memory)
{
    static insole_zupt_smoothed_t expected[COUNT], got[COUNT];
    insole_zupt_smooth_t smooth;
    walk_through(&smooth, 0.05);
    refill(&smooth, COUNT, 100, 160);
    ck_assert_int_eq(insole_zupt_smooth_run(&smooth, 0u), INSOLE_OK);
    ck_assert_uint_eq(take_all(&smooth, expected), 60u);

    refill(&smooth, 64u, 60, 124);
    ck_assert_int_eq(insole_zupt_smooth_push(&smooth, &filtered[124]), INSOLE_ERR_ROOM);
    ck_assert_int_eq(insole_zupt_smooth_run(&smooth, 24u), INSOLE_OK);
    ck_assert_uint_eq(take_all(&smooth, got), 40u);
    for (int k = 124; k < 160; k++) {
        ck_assert_int_eq(insole_zupt_smooth_push(&smooth, &filtered[k]), INSOLE_OK);
    }
    ck_assert_int_eq(insole_zupt_smooth_run(&smooth, 0u), INSOLE_OK);
    ck_assert_uint_eq(take_all(&smooth, got), 60u);
    ck_assert(memcmp(got, expected, 60u * sizeof *got) == 0);
}
END_TEST

START_TEST(can_be_moved_in_memory)
{
    static insole_zupt_node_t elsewhere[COUNT];
    static insole_zupt_smoothed_t expected[COUNT], got[COUNT];
    insole_zupt_smooth_t smooth, copy;
    walk_through(&smooth, 0.05);
    refill(&smooth, COUNT, 0, 200);
    copy = smooth;
    memcpy(elsewhere, nodes, sizeof nodes);
    copy.nodes = elsewhere;
    for (int k = 200; k < COUNT; k++) {
        ck_assert_int_eq(insole_zupt_smooth_push(&smooth, &filtered[k]), INSOLE_OK);
    }
    ck_assert_int_eq(insole_zupt_smooth_run(&smooth, 0u), INSOLE_OK);
    ck_assert_uint_eq(take_all(&smooth, expected), COUNT);
    memset(nodes, 0x5a, sizeof nodes);
    for (int k = 200; k < COUNT; k++) {
        ck_assert_int_eq(insole_zupt_smooth_push(&copy, &filtered[k]), INSOLE_OK);
    }
    ck_assert_int_eq(insole_zupt_smooth_run(&copy, 0u), INSOLE_OK);
    ck_assert_uint_eq(take_all(&copy, got), COUNT);
    ck_assert(memcmp(got, expected, sizeof got) == 0);
}
END_TEST

/* ---- what nothing passes ---------------------------------------------------------------- */

/* Smooths samples 0..end-1 and then the rest as well: the former must not change. */
static void assert_cut_at(int end, const char *what)
{
    static insole_zupt_smoothed_t without[COUNT], with[COUNT];
    insole_zupt_smooth_t smooth;
    refill(&smooth, COUNT, 0, end);
    ck_assert_int_eq(insole_zupt_smooth_run(&smooth, 0u), INSOLE_OK);
    ck_assert_uint_eq(take_all(&smooth, without), (uint32_t)end);
    refill(&smooth, COUNT, 0, COUNT);
    ck_assert_int_eq(insole_zupt_smooth_run(&smooth, 0u), INSOLE_OK);
    ck_assert_uint_eq(take_all(&smooth, with), COUNT);
    ck_assert_msg(memcmp(without, with, (size_t)end * sizeof *with) == 0, "%s", what);
    ck_assert_msg(with[end].p_m.x != filtered[end].p_m.x, "%s: but after it", what);
}

START_TEST(nothing_passes_an_alignment_or_a_gap)
{
    enum { CUT = 60 };
    insole_zupt_smooth_t smooth;
    walk_through(&smooth, 0.05);
    filtered[CUT].trace.step = INSOLE_ZUPT_STEP_ALIGN;
    assert_cut_at(CUT, "alignment");
    filtered[CUT].trace.step = INSOLE_ZUPT_STEP_COAST;
    assert_cut_at(CUT, "coast");
    filtered[CUT].trace.step = INSOLE_ZUPT_STEP_PREDICT;
    filtered[CUT].dt_s *= INSOLE_R(0.5); /* half of the way is missing */
    assert_cut_at(CUT, "a sample left out");
}
END_TEST

/* The filter is told where it is in the swing: what the next stance tells of the way still counts
 * before, but no longer for the place; height alone would have told of it too. */
START_TEST(nothing_passes_a_known_place)
{
    enum { CUT = 30 };
    static insole_zupt_smoothed_t out[COUNT];
    insole_zupt_smooth_t smooth;
    walk_through(&smooth, 0.05);
    for (int k = CUT; k < COUNT; k++) { /* no more correlation with the place before */
        insole_zupt_cov_t *P = &filtered[k].P;
        if (k == CUT) {
            P->pp = insole_sym3_zero();
            P->pv = P->pa = P->pb = insole_mat3_zero();
        }
        filtered[k].trace.velocity_var_m2ps2 = INSOLE_R(0.0);
    }
    filtered[60].trace.height_var_m2 = INSOLE_R(1.0e-4); /* all that is measured: heights */
    refill(&smooth, COUNT, 0, COUNT);
    ck_assert_int_eq(insole_zupt_smooth_run(&smooth, 0u), INSOLE_OK);
    ck_assert_uint_eq(take_all(&smooth, out), COUNT);
    ck_assert(out[CUT].p_m.z == filtered[CUT].p_m.z);
    ck_assert(out[CUT].v_mps.z != filtered[CUT].v_mps.z);
    ck_assert(out[CUT + 1].p_m.z != filtered[CUT + 1].p_m.z);
}
END_TEST

/* ---- refusals --------------------------------------------------------------------------- */

START_TEST(wants_memory_that_goes_round)
{
    static const uint32_t bad[6] = {0u, 1u, 3u, 100u, 255u, 0xffffffffu};
    insole_zupt_smooth_t smooth, before;
    memset(&smooth, 0x33, sizeof smooth);
    memcpy(&before, &smooth, sizeof smooth);
    for (int i = 0; i < 6; i++) {
        ck_assert_int_eq(insole_zupt_smooth_init(&smooth, nodes, bad[i]), INSOLE_ERR_VALUE);
    }
    ck_assert_int_eq(insole_zupt_smooth_init(&smooth, NULL, 64u), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_zupt_smooth_init(NULL, nodes, 64u), INSOLE_ERR_NULL);
    ck_assert(memcmp(&smooth, &before, sizeof smooth) == 0);
    ck_assert_int_eq(insole_zupt_smooth_init(&smooth, nodes, 2u), INSOLE_OK);
}
END_TEST

START_TEST(refuses_and_stays_as_it_was)
{
    insole_zupt_smooth_t smooth, before;
    insole_zupt_smoothed_t out;
    insole_zupt_ekf_t ekf = filter_new();
    ck_assert_int_eq(insole_zupt_smooth_init(&smooth, nodes, 2u), INSOLE_OK);
    ck_assert_int_eq(insole_zupt_smooth_push(&smooth, &ekf), INSOLE_ERR_STATE); /* not aligned */
    ekf = filter_aligned();
    ck_assert_int_eq(insole_zupt_smooth_push(&smooth, &ekf), INSOLE_OK);
    before = smooth;
    ck_assert_int_eq(insole_zupt_smooth_push(&smooth, &ekf), INSOLE_ERR_TIME); /* not moved on */
    before.refused++;
    ck_assert(memcmp(&smooth, &before, sizeof smooth) == 0 && smooth.refused == 2u);
    ck_assert_int_eq(filter_feel(&ekf, FILTER_UP, insole_vec3_zero()), INSOLE_OK);
    ck_assert_int_eq(insole_zupt_smooth_push(&smooth, &ekf), INSOLE_OK);
    ck_assert_int_eq(filter_feel(&ekf, FILTER_UP, insole_vec3_zero()), INSOLE_OK);
    before = smooth;
    ck_assert_int_eq(insole_zupt_smooth_push(&smooth, &ekf), INSOLE_ERR_ROOM);
    ck_assert_int_eq(insole_zupt_smooth_take(&smooth, &out), INSOLE_ERR_STATE);
    ck_assert(memcmp(&smooth, &before, sizeof smooth) == 0); /* these two are no errors */
    ck_assert_int_eq(insole_zupt_smooth_push(NULL, &ekf), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_zupt_smooth_push(&smooth, NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_zupt_smooth_run(NULL, 0u), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_zupt_smooth_take(NULL, &out), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_zupt_smooth_take(&smooth, NULL), INSOLE_ERR_NULL);
    ck_assert(memcmp(&smooth, &before, sizeof smooth) == 0);
}
END_TEST

START_TEST(an_empty_history_is_soon_smoothed)
{
    insole_zupt_smooth_t smooth;
    insole_zupt_smoothed_t out;
    insole_zupt_ekf_t ekf = filter_aligned();
    ck_assert_int_eq(insole_zupt_smooth_init(&smooth, nodes, 2u), INSOLE_OK);
    ck_assert_int_eq(insole_zupt_smooth_run(&smooth, 0u), INSOLE_OK);
    ck_assert_int_eq(insole_zupt_smooth_take(&smooth, &out), INSOLE_ERR_STATE);
    ck_assert_int_eq(insole_zupt_smooth_push(&smooth, &ekf), INSOLE_OK);
    ck_assert_int_eq(insole_zupt_smooth_run(&smooth, 0u), INSOLE_OK);
    ck_assert_int_eq(insole_zupt_smooth_take(&smooth, &out), INSOLE_OK);
    ck_assert(out.p_m.x == ekf.p_m.x && out.t_us == ekf.t_us); /* nothing came after it */
    ck_assert_int_eq(insole_zupt_smooth_take(&smooth, &out), INSOLE_ERR_STATE);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("zupt_smooth");
    suite_add_loop(suite, "the textbook's smoother", smooths_like_the_textbook, 2);
    suite_add_loop(suite, "in blocks", smooths_in_blocks_as_by_samples, 2);
    suite_add(suite, "keep", keeps_the_newest);
    suite_add(suite, "memory that goes round", goes_round_its_memory);
    suite_add(suite, "moved in memory", can_be_moved_in_memory);
    suite_add(suite, "alignments and gaps", nothing_passes_an_alignment_or_a_gap);
    suite_add(suite, "a known place", nothing_passes_a_known_place);
    suite_add(suite, "sizes of memory", wants_memory_that_goes_round);
    suite_add(suite, "refusals", refuses_and_stays_as_it_was);
    suite_add(suite, "hardly any history", an_empty_history_is_soon_smoothed);
    return suite;
}
