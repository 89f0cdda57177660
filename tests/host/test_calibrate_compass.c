/* SPDX-License-Identifier: MIT */
#include "calibrate.h"

#include <math.h>
#include <stdlib.h>

#include "calibrations.h"
#include "compass_legs.h"
#include "mall.h"
#include "near.h"
#include "suite.h"

static failure_t failure;
static compass_legs_t legs;

static const double pi = 3.14159265358979;

/* ---- walks that are known --------------------------------------------------------------- */

enum { RATE = 50, SIDE_S = 12 };

typedef struct {
    double north_rad; /* on the map */
    double iron_rad;  /* what iron turns the field by, everywhere */
    double pitch_rad; /* of the phone: its top is up */
    double carry_rad; /* the phone points so far left of the way */
    double speed_mps;
    double seconds;
    bool has_field, has_truth;
} walk_t;

static const walk_t plain = {2.0, 0.0, 0.0, 0.0, 1.3, 60.0, true, true};

/* Writes what the phone, pitched about its x axis, tells of a level vector at `bearing` from where
 * it points and of a part upwards. */
static void print_seen(FILE *file, const walk_t *walk, double level, double bearing, double up)
{
    double y = level * cos(bearing), x = -level * sin(bearing);
    double c = cos(walk->pitch_rad), s = sin(walk->pitch_rad);
    fprintf(file, ",%.5f,%.5f,%.5f", x, c * y + s * up, c * up - s * y);
}

/* Round and round a square, a turn of 1 s at each corner. */
static const char *write_walk(const char *name, const walk_t *walk)
{
    const char *path = scratch(name);
    FILE *file = fopen(path, "wb");
    double x_m = 0.0, y_m = 0.0, way_rad = 0.7;
    for (int i = 0; i < (int)(RATE * walk->seconds); i++) {
        double t_s = (double)i / RATE, in_side_s = fmod(t_s, SIDE_S);
        double turn_radps = in_side_s >= SIDE_S - 1.0 ? 0.5 * pi : 0.0;
        double points_rad = way_rad + walk->carry_rad;
        way_rad += turn_radps / RATE;
        fprintf(file, "imu,%.3f", t_s);
        print_seen(file, walk, 0.0, 0.0, 9.81);
        print_seen(file, walk, 0.0, 0.0, turn_radps);
        if (walk->has_field) {
            fprintf(file, "\nmag,%.3f", t_s);
            print_seen(file, walk, 20.0, walk->north_rad + walk->iron_rad - points_rad, -43.0);
        }
        if (walk->has_truth && i % 10 == 0) {
            fprintf(file, "\ntruth,%.3f,%.4f,%.4f", t_s, x_m, y_m);
        }
        putc('\n', file);
        x_m += walk->speed_mps * cos(way_rad) / RATE;
        y_m += walk->speed_mps * sin(way_rad) / RATE;
    }
    fclose(file);
    return path;
}

static void add(const walk_t *walk)
{
    bool is_good = compass_legs_add(&legs, write_walk("walk.csv", walk), NULL, NULL, &failure);
    ck_assert_msg(is_good, "%s", failure.text);
}

static double off(double a_rad, double b_rad)
{
    return fabs(atan2(sin(a_rad - b_rad), cos(a_rad - b_rad)));
}

static const double norths[] = {2.0, 0.0, -1.5, 3.1415, -3.0};

START_TEST(north_comes_back_wherever_it_is)
{
    walk_t walk = plain;
    compass_north_t north;
    walk.north_rad = norths[_i];
    walk.pitch_rad = 0.2 * _i;
    add(&walk);
    ck_assert_uint_ge(legs.count, 8u);
    for (size_t i = 0u; i < legs.count; i++) {
        ASSERT_AT_MOST(off(legs.legs[i].north_rad, norths[_i]), 0.02, "rad");
    }
    compass_legs_mean(&legs, &north);
    ASSERT_AT_MOST(off(north.north_rad, norths[_i]), 0.01, "rad");
    ASSERT_AT_MOST(north.scatter_rad, 0.02, "rad");
    compass_legs_free(&legs);
}
END_TEST

START_TEST(ways_that_bend_or_stand_are_no_legs)
{
    walk_t walk = plain;
    walk.seconds = 24.0; /* two sides of 11 s and their turns */
    add(&walk);
    /* 1 s at both ends, around a turn 1 s before and after: 9 s of each side, cut once. */
    ck_assert_uint_eq(legs.count, 4u);
    compass_legs_free(&legs);
    walk.speed_mps = 0.1;
    add(&walk);
    ck_assert_uint_eq(legs.count, 0u);
    compass_legs_free(&legs);
}
END_TEST

/* Legs of one session share the iron of its floor: the standard error knows it. */
START_TEST(standard_errors_hold_what_legs_share)
{
    compass_north_t north;
    double squares = 0.0, mean = 0.0;
    const double iron[] = {0.3, -0.2, 0.1, -0.35, 0.15, 0.0};
    for (size_t i = 0u; i < 6u; i++) {
        walk_t walk = plain;
        walk.iron_rad = iron[i];
        add(&walk);
        mean += iron[i] / 6.0;
    }
    for (size_t i = 0u; i < 6u; i++) {
        squares += (iron[i] - mean) * (iron[i] - mean);
    }
    compass_legs_mean(&legs, &north);
    ASSERT_NEAR(north.north_rad, 2.0 + mean, 0.01, "rad");
    ASSERT_NEAR(north.error_rad, sqrt(squares / 5.0 / 6.0), 0.01, "rad");
    ASSERT_NEAR(north.scatter_rad, sqrt(squares / 6.0), 0.01, "rad");
    compass_legs_free(&legs);
}
END_TEST

/* ---- the command ------------------------------------------------------------------------ */

static const option_t options[] = {
    {"accel-unit", "UNIT", ""}, {"gyro-unit", "UNIT", ""}, {NULL, NULL, NULL}};

static const char *calibrate(const char *const *sessions, size_t count)
{
    return calibrated(calibrate_compass, options, "", sessions, count, &failure);
}

static double north_in(const char *text)
{
    static const char key[] = "\nphone_compass.north_rad = ";
    const char *at = strstr(text, key);
    ck_assert_msg(at != NULL, "no north in:\n%s", text);
    return strtod(at + strlen(key), NULL);
}

START_TEST(a_config_line_is_printed)
{
    walk_t other = plain;
    other.iron_rad = 0.2;
    const char *const sessions[] = {write_walk("a.csv", &plain), write_walk("b.csv", &other)};
    const char *text = calibrate(sessions, 2u);
    ck_assert_msg(text != NULL, "%s", failure.text);
    ASSERT_NEAR(north_in(text), 2.1, 0.01, "rad");
    ck_assert_ptr_nonnull(strstr(text, "legs of 2 sessions; they scatter by 5.7 deg\n"));
    ck_assert_ptr_nonnull(strstr(text, "  # +- 0.0"));
}
END_TEST

START_TEST(what_tells_no_north_is_refused)
{
    walk_t no_field = plain, no_truth = plain, brief = plain, turned = plain, back = plain;
    no_field.has_field = false;
    no_truth.has_truth = false;
    brief.seconds = 5.0;
    back.carry_rad = pi;
    turned.carry_rad = 0.5 * pi;
    const char *const lacking[] = {write_walk("field.csv", &no_field)};
    const char *const lost[] = {write_walk("truth.csv", &no_truth)};
    const char *const few[] = {write_walk("brief.csv", &brief)};
    const char *const anyhow[] = {write_walk("ahead.csv", &plain), write_walk("left.csv", &turned),
                                  write_walk("back.csv", &back)};
    const struct {
        const char *const *sessions;
        size_t count;
        const char *says;
    } refusals[] = {{lacking, 1u, "field.csv: no magnetic field: expected mag records"},
                    {lost, 1u, "truth.csv: no truth: expected truth records"},
                    {few, 1u, "legs of a straight way: expected 4 or more of 2 s at least"},
                    {anyhow, 3u, "does the phone point ahead?"}};
    for (size_t i = 0u; i < sizeof refusals / sizeof refusals[0]; i++) {
        ck_assert_ptr_null(calibrate(refusals[i].sessions, refusals[i].count));
        ck_assert_msg(strstr(failure.text, refusals[i].says) != NULL, "%s", failure.text);
        ck_assert_int_eq(failure.exit_code, EXIT_BAD_INPUT);
    }
}
END_TEST

/* ---- recordings ------------------------------------------------------------------------- */

/* Halves of the walks agree about north. */
START_TEST(recorded_walks_agree_about_north)
{
    enum { WALKS = MALL_WALKS };
    static char paths[WALKS][MALL_PATH];
    const char *halves[2][WALKS / 2];
    double north[2];
    for (int i = 0; i < WALKS; i++) {
        mall_path(paths[i], i, "");
        halves[i % 2][i / 2] = paths[i];
    }
    char path[MALL_PATH];
    mall_path(path, 0, "imu.csv");
    if (!recorded_is_there(path)) {
        return;
    }
    for (int i = 0; i < 2; i++) {
        const char *text = calibrate(halves[i], WALKS / 2);
        ck_assert_msg(text != NULL, "%s", failure.text);
        printf("%s", text);
        north[i] = north_in(text);
    }
    /* Four times the standard error of 0.025 rad of either half. */
    ASSERT_NEAR(north[0], north[1], 4.0 * 0.025 * 1.42, "rad");
    /* The plan is drawn with north up, within the declination and what a plan is turned. */
    ASSERT_NEAR(north[0], 0.5 * pi, 0.2, "rad");
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("host/calibrate_compass");
    suite_add_loop(suite, "legs", north_comes_back_wherever_it_is,
                   (int)(sizeof norths / sizeof norths[0]));
    suite_add(suite, "legs", ways_that_bend_or_stand_are_no_legs);
    suite_add(suite, "mean", standard_errors_hold_what_legs_share);
    suite_add(suite, "command", a_config_line_is_printed);
    suite_add(suite, "command", what_tells_no_north_is_refused);
    suite_add(suite, "recordings", recorded_walks_agree_about_north);
    return suite;
}
