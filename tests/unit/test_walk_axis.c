/* SPDX-License-Identifier: MIT */
#include "insole/move/walk_axis.h"

#include "insole/base/rng.h"
#include "motion.h"
#include "near.h"
#include "phone.h"
#include "sample.h"
#include "suite.h"

#define PI  3.14159265358979323846
#define EPS ((double)INSOLE_REAL_EPSILON)

/* A scatter of points, some of them, turned by a matrix. */
static insole_sym3_t scatter_of(const d3_t *points, int count, d33_t E)
{
    insole_sym3_t S = insole_sym3_zero();
    for (int i = 0; i < count; i++) {
        S = insole_sym3_add_outer(S, 1, real_of(d33_apply(E, points[i])));
    }
    return S;
}

enum { POINTS = 40 };
static d3_t points[POINTS];
static const d33_t no_turn = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

static void draw_points(insole_rng_t *rng, double angle)
{
    for (int i = 0; i < POINTS; i++) {
        double x = 2.0 * (double)insole_rng_normal(rng), y = 0.7 * (double)insole_rng_normal(rng);
        double z = 0.4 * x + 2.0 * (double)insole_rng_normal(rng);
        points[i] = d33_apply(turn_z(angle), d3(x, y, z));
    }
}

static double energy(double angle)
{
    double sum = 0.0;
    for (int i = 0; i < POINTS; i++) {
        double part = cos(angle) * points[i].x + sin(angle) * points[i].y;
        sum += part * part;
    }
    return sum;
}

/* No other direction has more energy, and a quarter turn away lies the least. */
START_TEST(axis_has_the_largest_energy)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 1u);
    worst_t most = {0.0, 0.0}, energies = {0.0, 0.0};
    for (int i = 0; i < 200; i++) {
        draw_points(&rng, i * 0.2);
        insole_sym3_t S = scatter_of(points, POINTS, no_turn);
        double angle = (double)insole_walk_axis_of(S).rad, own = energy(angle), best = 0.0;
        for (int k = 0; k < 3600; k++) {
            best = fmax(best, energy(k * PI / 3600.0));
        }
        worst_note(&most, (best - own) / own, i);
        insole_walk_energies_t e = insole_walk_energies(S);
        worst_note(&energies, fabs((double)e.most - own) / own, i);
        worst_note(&energies, fabs((double)e.least - energy(angle + 0.5 * PI)) / own, i);
    }
    ASSERT_WORST(most, 30.0 * EPS, "");
    ASSERT_WORST(energies, 60.0 * EPS, "");
}
END_TEST

START_TEST(a_way_has_a_direction)
{
    for (int i = -3; i <= 3; i++) {
        insole_walk_axis_t axis = insole_walk_axis_along(real_of(d3(cos(i), sin(i), 5.0)));
        ASSERT_NEAR(axis.rad, i, 4.0 * EPS, "rad");
        ck_assert(!axis.is_axis);
    }
}
END_TEST

/* Mean and spread of the angle over attitudes that are wrong as the covariance says. */
static void through_by_chance(bool is_axis, double tilt, double turn, double *mean, double *sd)
{
    enum { DRAWS = 20000 };
    insole_rng_t rng;
    insole_rng_seed(&rng, 7u);
    insole_walk_axis_t base = insole_walk_axis_of(scatter_of(points, POINTS, no_turn));
    double middle = is_axis ? (double)base.rad : atan2(points[0].y, points[0].x);
    double sum = 0.0, square = 0.0, period = is_axis ? PI : 2.0 * PI;
    for (int i = 0; i < DRAWS; i++) {
        double x = (double)insole_rng_normal(&rng), y = (double)insole_rng_normal(&rng);
        double z = turn * (double)insole_rng_normal(&rng);
        d33_t E = d33_mul(turn_z(z), d33_exp(d3(tilt * x, tilt * y, 0.0)));
        d3_t way = d33_apply(E, points[0]);
        double angle = is_axis ? (double)insole_walk_axis_of(scatter_of(points, POINTS, E)).rad
                               : atan2(way.y, way.x);
        double off = remainder(angle - z - middle, period) + z;
        sum += off / DRAWS;
        square += off * off / DRAWS;
    }
    *mean = sum;
    *sd = sqrt(square - sum * sum);
}

START_TEST(variance_is_that_of_wrong_attitudes)
{
    static const double tilts[] = {0.01, 0.05, 0.1, 0.02}, turns[] = {0.0, 0.05, 0.2, 1.5};
    insole_rng_t rng;
    insole_rng_seed(&rng, 3u);
    for (int is_axis = 0; is_axis < 2; is_axis++) {
        draw_points(&rng, 0.8);
        points[0] = d3(1.5, 1.0, 2.0);
        insole_walk_axis_t axis = is_axis ? insole_walk_axis_of(scatter_of(points, POINTS, no_turn))
                                          : insole_walk_axis_along(real_of(points[0]));
        insole_real_t t2 = (insole_real_t)(tilts[_i] * tilts[_i]), off, variance;
        insole_sym3_t P = insole_sym3_diagonal(t2, t2, (insole_real_t)(turns[_i] * turns[_i]));
        insole_walk_axis_through(&axis, P, &off, &variance);
        double mean, sd;
        through_by_chance(is_axis == 1, tilts[_i], turns[_i], &mean, &sd);
        ASSERT_NEAR(insole_sqrt(variance), sd, 0.06 * sd, "rad");
        ASSERT_NEAR(off, mean, 0.05 * sd, "rad");
    }
}
END_TEST

/* A tilt of half a turn and more, a covariance that is none: finite. */
START_TEST(wild_attitudes_give_numbers)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 5u);
    draw_points(&rng, 0.3);
    insole_walk_axis_t axis = insole_walk_axis_of(scatter_of(points, POINTS, no_turn));
    const insole_sym3_t wild[] = {{100, 0, 0, 100, 0, 100}, {0, 0, 0, 0, 0, 0}, {1, 9, 9, 1, 9, 1}};
    for (int i = 0; i < 3; i++) {
        insole_real_t off = 0, variance = 0;
        insole_walk_axis_through(&axis, wild[i], &off, &variance);
        ck_assert(insole_is_finite(off + variance) && variance >= 0);
    }
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("walk_axis");
    suite_add(suite, "axis", axis_has_the_largest_energy);
    suite_add(suite, "way", a_way_has_a_direction);
    suite_add_loop(suite, "variance", variance_is_that_of_wrong_attitudes, 4);
    suite_add(suite, "wild", wild_attitudes_give_numbers);
    return suite;
}
