/* SPDX-License-Identifier: MIT */
#include "insole/fuse/step_ukf.h"

#include "filter_calls.h"
#include "insole/fuse/step_ekf.h"
#include "near.h"
#include "plane.h"
#include "suite.h"

#define EPS ((double)INSOLE_REAL_EPSILON)

/* Mean and covariance of (d cos psi, d sin psi) with normal, independent d and psi: exact. */
static void exact(const insole_pace_t *pace, point_t *mean, plane_t *Q)
{
    double d = (double)pace->length_m, psi = (double)pace->heading_rad;
    double v = (double)pace->var_heading_rad2, dd = d * d + (double)pace->var_length_m2;
    double shrink = exp(-0.5 * v), twice = exp(-2.0 * v);
    mean->x = d * shrink * cos(psi);
    mean->y = d * shrink * sin(psi);
    Q->a = 0.5 * dd * (1.0 + twice * cos(2.0 * psi)) - mean->x * mean->x;
    Q->d = 0.5 * dd * (1.0 - twice * cos(2.0 * psi)) - mean->y * mean->y;
    Q->b = Q->c = 0.5 * dd * twice * sin(2.0 * psi) - mean->x * mean->y;
}

/* The transform by the book, in double: five points with weights 1/3 and 1/6. */
static void by_the_book(const insole_pace_t *pace, point_t *mean, plane_t *Q)
{
    double s = sqrt(3.0 * (double)pace->var_heading_rad2);
    double l = sqrt(3.0 * (double)pace->var_length_m2);
    const double turn[5] = {0.0, s, 0.0, -s, 0.0}, longer[5] = {0.0, 0.0, l, 0.0, -l};
    point_t p[5];
    mean->x = mean->y = 0.0;
    for (int i = 0; i < 5; i++) {
        double d = (double)pace->length_m + longer[i], psi = (double)pace->heading_rad + turn[i];
        double w = i == 0 ? 1.0 / 3.0 : 1.0 / 6.0;
        p[i].x = d * cos(psi);
        p[i].y = d * sin(psi);
        mean->x += w * p[i].x;
        mean->y += w * p[i].y;
    }
    plane_t sum = {0.0, 0.0, 0.0, 0.0};
    for (int i = 0; i < 5; i++) {
        double x = p[i].x - mean->x, y = p[i].y - mean->y;
        plane_t square = {x * x, x * y, x * y, y * y};
        sum = plane_add(sum, i == 0 ? 1.0 / 3.0 : 1.0 / 6.0, square);
    }
    *Q = sum;
}

static insole_pace_t some_pace(insole_rng_t *rng, insole_real_t var_heading_rad2)
{
    insole_pace_t pace = {sample_between(rng, INSOLE_R(0.2), 2), sample_between(rng, -4, 4),
                          sample_between(rng, 0, INSOLE_R(0.05)),
                          sample_between(rng, 0, var_heading_rad2)};
    return pace;
}

START_TEST(the_points_are_those_of_the_book)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 1u);
    worst_t mean = {0.0, 0.0}, covariance = {0.0, 0.0};
    for (int i = 0; i < 2000; i++) {
        insole_pace_t pace = some_pace(&rng, 3);
        point_t m;
        plane_t Q;
        by_the_book(&pace, &m, &Q);
        insole_step_way_t found = insole_step_ukf(&pace);
        worst_note(&mean, point_apart(m, found.mean), i);
        worst_note(&covariance, plane_apart(Q, found.Q), i);
    }
    ASSERT_WORST(mean, 32.0 * EPS, "m");
    ASSERT_WORST(covariance, 64.0 * EPS, "m^2");
}
END_TEST

/* The more the heading is in doubt, the more linearisation is wrong; the points are less so. */
START_TEST(it_is_nearer_to_the_truth_than_linearisation)
{
    static const double SIGMA[] = {0.2, 0.4, 0.6, 0.8, 1.0};
    double sigma = SIGMA[_i];
    insole_rng_t rng;
    insole_rng_seed(&rng, 2u);
    worst_t mean = {0.0, 0.0}, worse = {0.0, 0.0};
    for (int i = 0; i < 500; i++) {
        insole_pace_t pace = some_pace(&rng, 1);
        pace.var_heading_rad2 = (insole_real_t)(sigma * sigma);
        pace.var_length_m2 = 0; /* the product of both variances is beyond five points */
        point_t m;
        plane_t Q;
        exact(&pace, &m, &Q);
        insole_step_way_t u = insole_step_ukf(&pace), e = insole_step_ekf(&pace);
        double d = (double)pace.length_m;
        worst_note(&mean, point_apart(m, u.mean) / d, i);
        worst_require(&worse, point_apart(m, u.mean) < point_apart(m, e.mean), i);
        worst_require(&worse, plane_apart(Q, u.Q) < plane_apart(Q, e.Q), i);
    }
    /* of exp(-v / 2) the weights leave out v^3 / 48 - 9 v^3 / 720 and what follows */
    ASSERT_WORST(mean, pow(sigma, 6.0) / 120.0 + 16.0 * EPS, "of the length");
    ASSERT_ALL_HELD(worse);
}
END_TEST

START_TEST(certain_steps_are_those_of_linearisation)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 3u);
    worst_t mean = {0.0, 0.0}, covariance = {0.0, 0.0};
    for (int i = 0; i < 500; i++) {
        insole_pace_t pace = some_pace(&rng, INSOLE_R(1e-4));
        insole_step_way_t u = insole_step_ukf(&pace), e = insole_step_ekf(&pace);
        worst_note(&mean, point_apart(point_of(u.mean), e.mean), i);
        worst_note(&covariance, plane_apart(plane_of(u.Q), e.Q), i);
    }
    ASSERT_WORST(mean, 1.1e-4, "m"); /* half the variance of the heading, twice a metre */
    ASSERT_WORST(covariance, 2.0e-5, "m^2");
}
END_TEST

START_TEST(no_doubt_gives_no_covariance)
{
    const insole_pace_t sure = {1, INSOLE_R(0.5), 0, 0}, lost = {1, 0, 0, INSOLE_R(1e20)};
    insole_step_way_t w = insole_step_ukf(&sure);
    ASSERT_NEAR(w.Q.xx + w.Q.yy, 0.0, 4.0 * EPS, "m^2");
    w = insole_step_ukf(&lost);
    ASSERT_AT_MOST(w.mean.x_m, 0.34, "m");
    ASSERT_AT_LEAST(plane_least(w.Q), -4.0 * EPS, "m^2");
}
END_TEST

/* The table's step is this method, not another one. */
START_TEST(the_table_steps_by_it)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 6u);
    insole_pace_t pace = some_pace(&rng, INSOLE_R(0.1));
    insole_step_way_t way = insole_step_ukf(&pace);
    check_filter_steps_by(&insole_step_ukf_calls, &pace, &way);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("step_ukf");
    suite_add(suite, "book", the_points_are_those_of_the_book);
    suite_add_loop(suite, "truth", it_is_nearer_to_the_truth_than_linearisation, 5);
    suite_add(suite, "certain", certain_steps_are_those_of_linearisation);
    suite_add(suite, "doubt", no_doubt_gives_no_covariance);
    suite_add(suite, "table", the_table_steps_by_it);
    return suite;
}
