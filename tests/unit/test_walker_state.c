/* SPDX-License-Identifier: MIT */
#include "insole/fuse/walker_state.h"

#include "insole/fuse/step_news.h"
#include "near.h"
#include "plane.h"
#include "suite.h"
#include "walker.h"

#define PI  3.14159265358979323846
#define EPS ((double)INSOLE_REAL_EPSILON)

static insole_rng_t rng;

static insole_walker_state_t state_with(insole_real_t offset_rad, insole_real_t var_rad2,
                                        insole_real_t var_scale)
{
    insole_walker_state_t s = {.offset_rad = offset_rad, .scale = 1};
    insole_walker_cov_add_pair(&s.P, INSOLE_WALKER_BIAS, insole_sym2_circle(9));
    insole_walker_cov_add_pair(&s.P, INSOLE_WALKER_X, insole_sym2_circle(4));
    insole_walker_cov_add_pair(&s.P, INSOLE_WALKER_TURN, insole_sym2(var_rad2, 0, var_scale));
    return s;
}

/* Steps, so that all states hang together. */
static void walk(insole_walker_state_t *s, insole_spot_t way)
{
    insole_walker_lever_t lever = insole_walker_state_lever(s, way);
    s->spot = insole_spot_add(s->spot, lever.moved);
    insole_walker_cov_walk(&s->P, lever.by_first, lever.by_second);
}

static insole_walker_seen_t seen_along(int place, insole_spot_t pair, insole_real_t innovation,
                                       insole_real_t variance)
{
    insole_walker_seen_t seen = {insole_walker_column(place, pair), innovation, variance};
    return seen;
}

/* ---- levers -------------------------------------------------------------------------------- */

/* Against differences of the lever's own way: the slopes are exact. */
START_TEST(levers_are_the_slopes)
{
    insole_rng_seed(&rng, 1u);
    worst_t off = {0.0, 0.0};
    const double h = _i ? 0.1 : 0.01;
    for (int n = 0; n < 300; n++) {
        insole_walker_state_t s =
            state_with(sample_between(&rng, -3, 3), INSOLE_R(0.02), INSOLE_R(0.01));
        s.scale = sample_between(&rng, INSOLE_R(0.7), INSOLE_R(1.4));
        s.is_wide = _i == 1;
        s.c.cos = sample_between(&rng, -1, 1);
        s.c.sin = sample_between(&rng, -1, 1);
        insole_spot_t way = sample_spot(&rng, 3);
        insole_walker_lever_t lever = insole_walker_state_lever(&s, way);
        insole_walker_state_t low = s, high = s;
        insole_real_t *value[2][4] = {{&low.offset_rad, &high.offset_rad, &low.scale, &high.scale},
                                      {&low.c.cos, &high.c.cos, &low.c.sin, &high.c.sin}};
        for (int k = 0; k < 2; k++) {
            low = high = s;
            *value[_i][2 * k] -= (insole_real_t)h;
            *value[_i][2 * k + 1] += (insole_real_t)h;
            point_t a = point_of(insole_walker_state_lever(&low, way).moved);
            point_t b = point_of(insole_walker_state_lever(&high, way).moved);
            point_t slope = {(b.x - a.x) / (2.0 * h), (b.y - a.y) / (2.0 * h)};
            worst_note(&off, point_apart(slope, k ? lever.by_second : lever.by_first), n);
        }
    }
    /* third derivative: 5 h^2 / 6; rounding: 5 eps / h */
    ASSERT_WORST(off, (_i ? 0.0 : 1e-4) + 2000.0 * EPS, "m");
}
END_TEST

START_TEST(the_mean_way_is_shorter)
{
    insole_walker_state_t s = state_with(1, INSOLE_R(0.2), INSOLE_R(0.01));
    s.scale = INSOLE_R(1.2);
    insole_spot_t moved = insole_walker_state_lever(&s, insole_spot(10, 0)).moved;
    ASSERT_NEAR(moved.x_m, 12.0 * exp(-0.1) * cos(1.0), 100.0 * EPS, "m");
    ASSERT_NEAR(moved.y_m, 12.0 * exp(-0.1) * sin(1.0), 100.0 * EPS, "m");
}
END_TEST

/* ---- the direction is lost, and found ------------------------------------------------------ */

/* Mean and covariance of a walk whose offset and scale are drawn. */
typedef struct {
    point_t mean;
    plane_t cov;
} moments_t;

enum { DRAWS = 200000, STEPS = 12 };

static insole_spot_t way_of(int k)
{
    return k < 8 ? insole_spot(INSOLE_R(0.7), 0) : insole_spot(0, INSOLE_R(0.7));
}

static moments_t drawn(double offset, double sigma, double sigma_scale, double turn)
{
    double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
    for (int n = 0; n < DRAWS; n++) {
        double psi = offset + sigma * (double)insole_rng_normal(&rng);
        double size = 1.0 + sigma_scale * (double)insole_rng_normal(&rng);
        point_t p = {0.0, 0.0};
        for (int k = 0; k < STEPS; k++) {
            point_t w = point_of(way_of(k));
            p.x += size * (cos(psi) * w.x - sin(psi) * w.y);
            p.y += size * (sin(psi) * w.x + cos(psi) * w.y);
            psi += turn * (double)insole_rng_normal(&rng);
        }
        x += p.x / DRAWS;
        y += p.y / DRAWS;
        xx += p.x * p.x / DRAWS;
        xy += p.x * p.y / DRAWS;
        yy += p.y * p.y / DRAWS;
    }
    moments_t m = {{x, y}, {xx - x * x, xy - x * y, xy - x * y, yy - y * y}};
    return m;
}

/* However little is known of the direction: mean and covariance of the place after a walk are those
 * of many drawn walks. */
START_TEST(a_walk_in_an_unknown_direction_has_its_moments)
{
    static const struct {
        double sigma, turn;
    } ROWS[] = {{0.6, 0.0}, {1.0, 0.0}, {1.0, 0.15}, {1.7, 0.044}, {4.0, 0.044}, {0.1, 0.3}};
    insole_rng_seed(&rng, 2u);
    double sigma = ROWS[_i].sigma, turn = ROWS[_i].turn;
    insole_walker_state_t s = state_with(INSOLE_R(0.5), INSOLE_R(1e-6), INSOLE_R(0.0144));
    insole_sym2_t before = insole_walker_cov_pair(&s.P, INSOLE_WALKER_X);
    insole_walker_state_wander(&s, (insole_real_t)(sigma * sigma));
    for (int k = 0; k < STEPS; k++) {
        walk(&s, way_of(k));
        insole_walker_state_wander(&s, (insole_real_t)(turn * turn));
    }
    ck_assert(s.is_wide);
    moments_t m = drawn(0.5, sigma, 0.12, turn);
    insole_sym2_t P = insole_walker_cov_pair(&s.P, INSOLE_WALKER_X);
    P = insole_sym2_add(P, insole_sym2_scale(before, -1));
    double size = sqrt(m.cov.a + m.cov.d);
    ASSERT_AT_MOST(point_apart(m.mean, s.spot), 0.01 * size, "m");
    ASSERT_AT_MOST(plane_apart(m.cov, P), (_i == 5 ? 0.05 : 0.015) * size * size, "m^2");
}
END_TEST

START_TEST(offset_and_its_variance_go_through_c_unharmed)
{
    static const double SIGMA[] = {0.51, 0.7, 1.0, 1.4};
    insole_walker_state_t s = state_with(-2, INSOLE_R(1e-6), INSOLE_R(1e-6));
    insole_walker_state_wander(&s, (insole_real_t)(SIGMA[_i] * SIGMA[_i]));
    ck_assert(s.is_wide);
    ASSERT_NEAR(insole_walker_state_offset(&s), -2.0, 100.0 * EPS, "rad");
    ASSERT_NEAR(insole_walker_state_var_offset(&s), SIGMA[_i] * SIGMA[_i], 1e-4, "rad^2");
    ASSERT_NEAR(hypot((double)s.c.cos, (double)s.c.sin), exp(-0.5 * (SIGMA[_i] * SIGMA[_i] + 1e-6)),
                100.0 * EPS, "");
}
END_TEST

START_TEST(nothing_known_is_told_as_such)
{
    insole_walker_state_t s = state_with(1, INSOLE_R(1e-6), INSOLE_R(0.01));
    insole_walker_state_wander(&s, INSOLE_HEADING_MOST_R2);
    ASSERT_NEAR(insole_walker_state_var_offset(&s), INSOLE_HEADING_MOST_R2, 0.0, "rad^2");
    for (int i = 0; i < 5000; i++) {
        insole_walker_state_wander(&s, i % 100 ? INSOLE_R(0.002) : 10);
    }
    insole_sym2_t T = insole_walker_state_turn(&s);
    ASSERT_NEAR(insole_walker_state_var_offset(&s), INSOLE_HEADING_MOST_R2, 0.0, "rad^2");
    ASSERT_NEAR(T.xx + T.yy, 1.01, 2e-4 + 5000.0 * EPS, ""); /* the mean of |c|^2 */
    ck_assert(walker_is_sane(&s.P));
}
END_TEST

/* A direction that is seen makes it narrow; what hung together does so after as before. */
START_TEST(a_direction_that_is_seen_is_settled)
{
    insole_walker_state_t s = state_with(2, INSOLE_R(1e-6), INSOLE_R(0.0144));
    insole_walker_state_wander(&s, 1);
    for (int k = 0; k < 10; k++) {
        walk(&s, insole_spot(1, 0));
    }
    insole_walker_state_settle(&s);
    ck_assert(s.is_wide);
    insole_walker_seen_t seen =
        seen_along(INSOLE_WALKER_X, insole_spot(0, 1), 8 - s.spot.y_m, INSOLE_R(0.01));
    insole_walker_state_learn(&s, &seen, 1);
    seen = seen_along(INSOLE_WALKER_X, insole_spot(1, 0), -6 - s.spot.x_m, INSOLE_R(0.01));
    insole_walker_state_learn(&s, &seen, 1);
    insole_real_t offset = insole_walker_state_offset(&s);
    insole_walker_state_settle(&s);
    ck_assert(!s.is_wide);
    ASSERT_NEAR(insole_walker_state_offset(&s), offset, 0.3, "rad");
    ASSERT_NEAR(offset, atan2(8, -6), 0.3, "rad");
    ASSERT_NEAR(insole_walker_state_var_scale(&s), 0.0144, 1e-4, "");
    ASSERT_AT_MOST(insole_walker_state_var_offset(&s), 0.13, "rad^2");
    ck_assert(walker_is_sane(&s.P));
}
END_TEST

/* To c and back with next to nothing in between: all states as they were, the scale not surer. */
START_TEST(there_and_back_changes_little)
{
    insole_rng_seed(&rng, 3u);
    insole_walker_state_t s = state_with(2, INSOLE_R(0.1), INSOLE_R(0.0144));
    s.scale = INSOLE_R(1.1);
    for (int k = 0; k < 10; k++) {
        walk(&s, sample_spot(&rng, 1));
    }
    insole_walker_state_t before = s;
    insole_walker_state_wander(&s, INSOLE_R(0.1501));
    ck_assert(s.is_wide);
    ASSERT_NEAR(insole_walker_state_var_scale(&s), 0.0144, 1e-5, "");
    insole_walker_seen_t seen = {
        insole_walker_column(INSOLE_WALKER_TURN, insole_spot(-s.c.sin, s.c.cos)), 0,
        INSOLE_R(0.05)};
    insole_walker_state_learn(&s, &seen, 1);
    insole_walker_state_settle(&s);
    ck_assert(!s.is_wide);
    ASSERT_NEAR(s.offset_rad, 2.0, 0.02, "rad");
    ASSERT_NEAR(s.scale, 1.1, 0.02, "");
    ASSERT_NEAR(insole_walker_state_var_scale(&s), 0.0144, 1e-4, "");
    /* the way is longer by what is now known better of the direction */
    ASSERT_AT_MOST(point_apart(point_of(before.spot), s.spot),
                   0.1 * (double)insole_spot_norm(before.spot), "m");
}
END_TEST

/* ---- learning ------------------------------------------------------------------------------ */

START_TEST(numbers_seen_together_are_those_seen_one_by_one)
{
    insole_rng_seed(&rng, 4u);
    insole_walker_state_t s = state_with(2, INSOLE_R(0.1), INSOLE_R(0.0144));
    walk(&s, insole_spot(5, 1));
    dense_t S = walker_dense(&s.P);
    insole_walker_seen_t seen[2];
    double x[SIX] = {0.0};
    for (int k = 0; k < 2; k++) {
        seen[k].variance = 1 + (insole_real_t)k;
        seen[k].innovation = INSOLE_R(0.5) - (insole_real_t)k;
        for (int i = 0; i < SIX; i++) {
            seen[k].h.at[i] = insole_rng_normal(&rng);
        }
        column_t h = walker_wide(&seen[k].h);
        double v = (double)seen[k].innovation;
        for (int i = 0; i < SIX; i++) {
            v -= h.at[i] * x[i];
        }
        column_t K = walker_book(&S, &h, (double)seen[k].variance);
        for (int i = 0; i < SIX; i++) {
            x[i] += K.at[i] * v;
        }
    }
    insole_walker_state_t after = s;
    insole_walker_state_learn(&after, seen, 2);
    ASSERT_AT_MOST(walker_off(&S, &after.P), 500.0 * EPS, "of the sigmas");
    ASSERT_NEAR(after.bias.x_m, x[0], 100.0 * EPS, "m");
    ASSERT_NEAR(after.bias.y_m, x[1], 100.0 * EPS, "m");
    ASSERT_NEAR(after.spot.x_m - s.spot.x_m, x[2], 200.0 * EPS, "m");
    ASSERT_NEAR(after.spot.y_m - s.spot.y_m, x[3], 200.0 * EPS, "m");
    ASSERT_NEAR(after.offset_rad - s.offset_rad, x[4], 100.0 * EPS, "rad");
    ASSERT_NEAR(after.scale - s.scale, x[5], 100.0 * EPS, "");
}
END_TEST

START_TEST(what_leads_out_of_reach_changes_nothing)
{
    insole_walker_state_t s = state_with(0, INSOLE_R(0.1), INSOLE_R(0.01)), before;
    memcpy(&before, &s, sizeof s);
    insole_walker_seen_t seen =
        seen_along(INSOLE_WALKER_X, insole_spot(1, 0), INSOLE_R(3.0e6), INSOLE_R(0.1));
    insole_walker_state_learn(&s, &seen, 1);
    ck_assert_int_eq(memcmp(&before, &s, sizeof s), 0);
}
END_TEST

START_TEST(the_scale_keeps_its_limits)
{
    insole_walker_state_t s = state_with(3, INSOLE_R(0.1), 1);
    insole_walker_seen_t seen = seen_along(INSOLE_WALKER_TURN, insole_spot(0, 1), -9, 1);
    insole_walker_state_learn(&s, &seen, 1);
    ASSERT_NEAR(s.scale, 0.25, 0.0, "");
    seen = seen_along(INSOLE_WALKER_TURN, insole_spot(1, 0), 1, INSOLE_R(0.01));
    insole_walker_state_learn(&s, &seen, 1); /* and the offset goes round */
    ASSERT_NEAR(s.offset_rad, 3.0 + 1.0 / 1.1 - 2.0 * PI, 100.0 * EPS, "rad");
}
END_TEST

START_TEST(the_scale_is_forgotten_up_to_a_limit)
{
    insole_walker_state_t s = state_with(0, INSOLE_R(0.1), INSOLE_R(0.01));
    if (_i) {
        insole_walker_state_wander(&s, 1);
    }
    insole_walker_state_stretch(&s, INSOLE_R(0.002), INSOLE_R(0.0144));
    ASSERT_NEAR(insole_walker_state_var_scale(&s), 0.012, EPS, "");
    for (int k = 0; k < 10; k++) {
        insole_walker_state_stretch(&s, INSOLE_R(0.002), INSOLE_R(0.0144));
    }
    ASSERT_NEAR(insole_walker_state_var_scale(&s), 0.0144, EPS, "");
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("walker_state");
    suite_add_loop(suite, "slopes", levers_are_the_slopes, 2);
    suite_add(suite, "shorter", the_mean_way_is_shorter);
    suite_add_loop(suite, "moments", a_walk_in_an_unknown_direction_has_its_moments, 6);
    suite_add_loop(suite, "through", offset_and_its_variance_go_through_c_unharmed, 4);
    suite_add(suite, "unknown", nothing_known_is_told_as_such);
    suite_add(suite, "settled", a_direction_that_is_seen_is_settled);
    suite_add(suite, "back", there_and_back_changes_little);
    suite_add(suite, "together", numbers_seen_together_are_those_seen_one_by_one);
    suite_add(suite, "reach", what_leads_out_of_reach_changes_nothing);
    suite_add(suite, "limits", the_scale_keeps_its_limits);
    suite_add_loop(suite, "forgotten", the_scale_is_forgotten_up_to_a_limit, 2);
    return suite;
}
