/* SPDX-License-Identifier: MIT */
#include "path_fit.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "near.h"
#include "normal_tail.h"
#include "suite.h"

/* A building of readings: every access point is heard in every square from some distance. */
enum { APS = 8, SQUARES = 60, PER_SQUARE = 6, MOST = APS * SQUARES * PER_SQUARE };

typedef struct {
    double p0, exponent, told, wall, body, most_db;
    double p0_spread, exponent_spread;
    double shadow_db, noise_db; /* of a square, of a reading */
    double floor_dbm;
    double lost, wild; /* shares of readings that get lost, that are anything */
} world_t;

static const world_t plain = {-40.0, 2.4, 0.8, 6.0,    5.0, 1000.0, 0.0,
                              0.0,   0.0, 3.0, -200.0, 0.0, 0.0};

static path_reading_t readings[MOST];
static double own_p0[APS], own_exponent[APS];

static double uniform(void)
{
    return rand() / (RAND_MAX + 1.0);
}

static double normal(double sigma)
{
    return sigma * sqrt(-2.0 * log(1.0 - uniform())) * cos(6.283185307179586 * uniform());
}

static path_reading_t make_reading(const world_t *world, uint32_t ap, uint32_t square,
                                   double distance_m, double shadow_db)
{
    path_reading_t r = {.ap = ap, .square = ap * SQUARES + square};
    r.log_m = 10.0 * log10(distance_m);
    r.told_db = 3.0 * (square % 5u);
    r.walls = square % 3u;
    r.body_share = uniform() < 0.5 ? 0.0 : 1.0;
    r.dbm = own_p0[ap] - own_exponent[ap] * r.log_m -
            fmin(world->told * r.told_db + world->wall * r.walls, world->most_db) -
            world->body * r.body_share - 2.0 + shadow_db + normal(world->noise_db);
    r.dbm = uniform() < world->wild ? -100.0 + 70.0 * uniform() : r.dbm;
    r.dbm = r.dbm < world->floor_dbm || uniform() < world->lost ? (double)NAN : r.dbm;
    return r;
}

static path_survey_t make_survey(const world_t *world)
{
    size_t count = 0u;
    for (uint32_t a = 0; a < APS; a++) {
        own_p0[a] = world->p0 + normal(world->p0_spread);
        own_exponent[a] = world->exponent + normal(world->exponent_spread);
        for (uint32_t s = 0; s < SQUARES; s++) {
            double distance_m = 1.5 * exp(3.0 * uniform()), shadow_db = normal(world->shadow_db);
            for (int i = 0; i < PER_SQUARE; i++) {
                readings[count++] =
                    make_reading(world, a, s, distance_m * (0.95 + 0.1 * uniform()), shadow_db);
            }
        }
    }
    const path_survey_t survey = {readings,         count, APS, APS * SQUARES,
                                  world->floor_dbm, 2.0,   3.0, {-38.0, 2.0, 1.0, 5.0, 6.81}};
    return survey;
}

static path_fit_t fit_of(const world_t *world)
{
    path_fit_t fit;
    path_survey_t survey = make_survey(world);
    path_fit_begin(&fit, &survey);
    fit.most_db = world->most_db;
    path_fit_run(&fit);
    return fit;
}

static double truth_of(const world_t *world, int k)
{
    const double truth[PATH_UNKNOWNS] = {world->p0, world->exponent, world->told, world->wall,
                                         world->body};
    return truth[k];
}

START_TEST(what_made_the_readings_is_found_again)
{
    srand(61);
    path_fit_t fit = fit_of(&plain);
    for (int k = 0; k < PATH_UNKNOWNS; k++) {
        ASSERT_NEAR(fit.value[k], truth_of(&plain, k), 4.0 * fit.error[k], "");
    }
    ASSERT_NEAR(fit.value[PATH_P0], plain.p0, 1.0, "dBm");
    ASSERT_NEAR(fit.value[PATH_EXPONENT], plain.exponent, 0.1, "");
    ASSERT_NEAR(fit.rms_db, 3.0, 0.15, "dB");
    /* The likeliest scale of Student's distribution of 3 degrees for a normal one. */
    ASSERT_NEAR(fit.sigma_db, 0.785 * 3.0, 0.1, "dB");
    path_fit_free(&fit);
}
END_TEST

/* Squared errors over variances: 1 in the mean, for all values and many worlds. */
static void collect(const world_t *world, int worlds, double ratio[PATH_UNKNOWNS])
{
    memset(ratio, 0, PATH_UNKNOWNS * sizeof *ratio);
    for (int i = 0; i < worlds; i++) {
        path_fit_t fit = fit_of(world);
        for (int k = 0; k < PATH_UNKNOWNS; k++) {
            double z = (fit.value[k] - truth_of(world, k)) / fit.error[k];
            ratio[k] += z * z / worlds;
        }
        path_fit_free(&fit);
    }
}

static const world_t honest[] = {
    {-40.0, 2.4, 0.8, 6.0, 5.0, 1000.0, 0.0, 0.0, 0.0, 3.0, -200.0, 0.0, 0.0},
    {-40.0, 2.4, 0.8, 6.0, 5.0, 1000.0, 0.0, 0.0, 3.0, 2.0, -200.0, 0.0, 0.0},
    {-40.0, 2.4, 0.8, 6.0, 5.0, 1000.0, 3.0, 0.2, 3.0, 2.0, -200.0, 0.0, 0.0},
    {-40.0, 2.4, 0.8, 6.0, 5.0, 14.0, 2.0, 0.1, 3.0, 2.0, -88.0, 0.02, 0.0},
};

START_TEST(standard_errors_are_as_large_as_the_errors)
{
    double ratio[PATH_UNKNOWNS];
    srand(62 + (unsigned)_i);
    collect(&honest[_i], 40, ratio);
    printf("world %d: squared errors over variances %.2f %.2f %.2f %.2f %.2f\n", _i, ratio[0],
           ratio[1], ratio[2], ratio[3], ratio[4]);
    for (int k = 0; k < PATH_UNKNOWNS; k++) {
        ASSERT_AT_MOST(ratio[k], 1.9, "mean squared error over variance");
    }
    /* p0 and exponent might differ more from access point to access point than they do, and the
     * body, which changes within a square, is known better than squares tell. */
    ASSERT_AT_LEAST(ratio[PATH_TOLD], 0.5, "mean squared error over variance");
    ASSERT_AT_LEAST(ratio[PATH_WALL], 0.5, "mean squared error over variance");
}
END_TEST

START_TEST(wild_readings_do_not_bend_it)
{
    world_t world = plain;
    world.wild = 0.1;
    srand(70);
    path_fit_t fit = fit_of(&world);
    ASSERT_NEAR(fit.value[PATH_P0], world.p0, 1.5, "dBm");
    ASSERT_NEAR(fit.value[PATH_EXPONENT], world.exponent, 0.12, "");
    ASSERT_NEAR(fit.value[PATH_WALL], world.wall, 0.6, "dB");
    path_fit_free(&fit);
}
END_TEST

/* Weak readings are missing: who fits only what is heard finds too small an exponent. */
START_TEST(what_the_floor_hides_is_accounted_for)
{
    world_t world = plain;
    world.floor_dbm = -80.0;
    world.noise_db = 5.0;
    srand(71);
    path_fit_t fit = fit_of(&world), naive;
    path_survey_t heard = fit.survey;
    static path_reading_t kept[MOST];
    heard.readings = kept;
    heard.count = 0u;
    for (size_t i = 0u; i < fit.survey.count; i++) {
        if (!isnan(readings[i].dbm)) {
            kept[heard.count++] = readings[i];
        }
    }
    path_fit_begin(&naive, &heard);
    path_fit_run(&naive);
    ck_assert_uint_lt(heard.count, fit.survey.count * 9u / 10u);
    ASSERT_NEAR(fit.value[PATH_EXPONENT], world.exponent, 0.12, "");
    ASSERT_AT_MOST(naive.value[PATH_EXPONENT], world.exponent - 0.2, "");
    path_fit_free(&fit);
    path_fit_free(&naive);
}
END_TEST

START_TEST(bad_luck_is_told_from_the_floor)
{
    world_t world = plain;
    world.floor_dbm = -90.0;
    world.lost = 0.2;
    srand(72);
    path_fit_t fit = fit_of(&world);
    ASSERT_NEAR(fit.lost_share, 0.2, 0.03, "");
    ASSERT_NEAR(fit.value[PATH_EXPONENT], world.exponent, 0.12, "");
    path_fit_free(&fit);
}
END_TEST

START_TEST(access_points_differ_as_much_as_they_do)
{
    world_t world = plain;
    world.p0_spread = 4.0;
    world.exponent_spread = 0.3;
    srand(73);
    path_fit_t fit = fit_of(&world);
    for (int a = 0; a < APS; a++) {
        ASSERT_NEAR(fit.aps[a].own[0], own_p0[a], 4.0 * fit.aps[a].error[0], "dBm");
        ASSERT_NEAR(fit.aps[a].own[1], own_exponent[a], 4.0 * fit.aps[a].error[1], "");
        ASSERT_AT_MOST(fit.aps[a].error[0], 2.0, "dBm");
        ck_assert_uint_eq(fit.aps[a].heard, (size_t)SQUARES * PER_SQUARE);
        ASSERT_NEAR(fit.aps[a].sigma_db, 3.0, 0.5, "dB");
    }
    ASSERT_AT_LEAST(fit.common_sigma_db, 1.3 * fit.sigma_db, "dB");
    path_fit_free(&fit);
}
END_TEST

/* Of one access point there is one reading: it stays with the others. */
START_TEST(who_is_hardly_heard_gets_the_common_values)
{
    world_t world = plain;
    srand(74);
    path_survey_t survey = make_survey(&world);
    survey.ap_count = APS + 1u;
    readings[0].ap = APS;
    readings[0].dbm += 40.0;
    path_fit_t fit;
    path_fit_begin(&fit, &survey);
    path_fit_run(&fit);
    ASSERT_NEAR(fit.aps[APS].own[0], fit.value[0], 2.0, "dBm");
    ASSERT_NEAR(fit.aps[APS].own[1], fit.value[1], 0.1, "");
    ASSERT_AT_LEAST(fit.aps[APS].error[0], 0.4, "dBm");
    path_fit_free(&fit);
}
END_TEST

START_TEST(what_squares_share_is_found)
{
    world_t world = plain;
    world.shadow_db = 4.0;
    world.noise_db = 2.0;
    srand(75);
    path_fit_t fit = fit_of(&world);
    ASSERT_NEAR(fit.alike, 0.8, 0.08, "");
    path_fit_free(&fit);
}
END_TEST

START_TEST(what_is_fixed_stays)
{
    srand(76);
    path_fit_t fit;
    path_survey_t survey = make_survey(&plain);
    path_fit_begin(&fit, &survey);
    fit.is_fixed[PATH_EXPONENT] = true;
    fit.value[PATH_EXPONENT] = 3.0;
    path_fit_run(&fit);
    ASSERT_NEAR(fit.value[PATH_EXPONENT], 3.0, 1e-3, "");
    ASSERT_NEAR(fit.aps[0].own[PATH_EXPONENT], 3.0, 1e-3, "");
    path_fit_free(&fit);
}
END_TEST

/* Against sums of the density. */
START_TEST(tails_of_the_normal_distribution)
{
    for (double z = -6.0; z <= 4.0; z += 0.5) {
        double sum = 0.0, step = 1e-4;
        for (double u = z - 8.0; u < z; u += step) {
            sum += step * exp(-0.5 * (u + 0.5 * step) * (u + 0.5 * step)) / sqrt(6.283185307179586);
        }
        double density = exp(-0.5 * z * z) / sqrt(6.283185307179586);
        ASSERT_NEAR(normal_below(z) / sum, 1.0, 1e-3, "");
        ASSERT_NEAR(normal_hazard(z) / (density / sum), 1.0, 1e-3, "");
    }
    ASSERT_NEAR(normal_hazard(-8.0001), normal_hazard(-7.9999), 0.13, "");
    ASSERT_NEAR(normal_hazard(-300.0), 300.0, 1e-9, "");
}
END_TEST

START_TEST(an_expectation_is_the_formula)
{
    path_fit_t fit;
    path_survey_t survey = make_survey(&plain);
    path_fit_begin(&fit, &survey);
    path_reading_t reading = {.log_m = 10.0, .told_db = 6.0, .walls = 2.0, .body_share = 0.5};
    /* -38 - 20 - (6 + 10) - 0.5 x 6.81 - 2, then with at most 9 dB of walls */
    ASSERT_NEAR(path_fit_expect(&fit, &reading, false), -79.405, 1e-9, "dBm");
    fit.most_db = 9.0;
    ASSERT_NEAR(path_fit_expect(&fit, &reading, false), -72.405, 1e-9, "dBm");
    fit.aps[0].own[PATH_P0] = -30.0;
    ASSERT_NEAR(path_fit_expect(&fit, &reading, true), -64.405, 1e-9, "dBm");
    path_fit_free(&fit);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("host/path_fit");
    suite_add(suite, "model", tails_of_the_normal_distribution);
    suite_add(suite, "model", an_expectation_is_the_formula);
    suite_add(suite, "values", what_made_the_readings_is_found_again);
    suite_add(suite, "values", access_points_differ_as_much_as_they_do);
    suite_add(suite, "values", who_is_hardly_heard_gets_the_common_values);
    suite_add(suite, "values", what_is_fixed_stays);
    suite_add_loop(suite, "errors", standard_errors_are_as_large_as_the_errors,
                   (int)(sizeof honest / sizeof honest[0]));
    suite_add(suite, "robust", wild_readings_do_not_bend_it);
    suite_add(suite, "robust", what_the_floor_hides_is_accounted_for);
    suite_add(suite, "robust", bad_luck_is_told_from_the_floor);
    suite_add(suite, "robust", what_squares_share_is_found);
    return suite;
}
