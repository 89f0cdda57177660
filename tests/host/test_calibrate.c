/* SPDX-License-Identifier: MIT */
#include "calibrate.h"

#include <math.h>
#include <stdlib.h>

#include "calibrations.h"
#include "foot_walk.h"
#include "near.h"
#include "readings.h"
#include "sphere.h"
#include "suite.h"

static failure_t failure;

static const double two_pi = 6.283185307179586;

static const option_t options[] = {
    {"turns", "N", ""}, {"accel-unit", "UNIT", ""}, {"gyro-unit", "UNIT", ""}, {NULL, NULL, NULL}};

static const char *calibrate(calibration_t calibration, const char *turns,
                             const char *const *sessions, size_t count)
{
    char words[64];
    snprintf(words, sizeof words, "%s%s", turns != NULL ? "--turns=" : "",
             turns != NULL ? turns : "");
    return calibrated(calibration, options, words, sessions, count, &failure);
}

static double noise(double sigma)
{
    double sum = 0.0;
    for (int i = 0; i < 12; i++) {
        sum += rand() / (double)RAND_MAX;
    }
    return sigma * (sum - 6.0);
}

/* ---- imu -------------------------------------------------------------------------------- */

/* Log of a sensor at rest with these true values. */
static const char *write_rest(const char *name, const double accel[3], const double gyro[3],
                              double seconds)
{
    const char *path = scratch(name);
    FILE *file = fopen(path, "wb");
    for (int i = 0; i < (int)(100.0 * seconds); i++) {
        fprintf(file, "imu,%.2f", 0.01 * i);
        for (int k = 0; k < 6; k++) {
            fprintf(file, ",%.7f", k < 3 ? accel[k] + noise(0.02) : gyro[k - 3] + noise(0.002));
        }
        fputs("\n", file);
    }
    fclose(file);
    return path;
}

START_TEST(a_rest_tells_bias_noise_and_gravity)
{
    const double accel[3] = {3.0, -4.0, 8.4380}, gyro[3] = {0.01, -0.02, 0.005};
    srand(21);
    const char *const path = write_rest("rest.csv", accel, gyro, 60.0);
    const char *text = calibrate(calibrate_imu, NULL, &path, 1u);
    ck_assert_msg(text != NULL, "%s", failure.text);
    ASSERT_NEAR(value_of(text, "sensor.gyro_bias_x_radps"), 0.01, 2e-4, "rad/s");
    ASSERT_NEAR(value_of(text, "sensor.gyro_bias_y_radps"), -0.02, 2e-4, "rad/s");
    ASSERT_NEAR(value_of(text, "sensor.gyro_bias_z_radps"), 0.005, 2e-4, "rad/s");
    double gravity = sqrt(9.0 + 16.0 + 8.4380 * 8.4380);
    ASSERT_NEAR(value_of(text, "still_bias.gravity_mps2"), gravity, 2e-3, "m/s^2");
    ASSERT_NEAR(value_of(text, "zero_velocity.gravity_mps2"), gravity, 2e-3, "m/s^2");
    ASSERT_NEAR(value_of(text, "zupt_ekf.gravity_mps2"), gravity, 2e-3, "m/s^2");
    /* 0.02 and 0.002 at 100 Hz: a tenth of it per root second. */
    ASSERT_NEAR(strtod(strstr(text, "accelerometer ") + 14, NULL), 0.002, 1e-4, "m/s/sqrt(s)");
    ASSERT_NEAR(strtod(strstr(text, "gyroscope ") + 10, NULL), 0.0002, 1e-5, "rad/sqrt(s)");
    ck_assert_ptr_nonnull(strstr(text, "# calibrate imu: 60.0 s of rest in 1 pose\n"));
    ck_assert_ptr_null(strstr(text, "accel_bias_x"));
}
END_TEST

START_TEST(six_poses_tell_the_bias_of_the_accelerometer)
{
    const double bias[3] = {0.12, -0.2, 0.07}, gyro[3] = {0.0, 0.0, 0.0};
    const char *paths[7];
    char name[32];
    srand(22);
    for (int i = 0; i < 7; i++) {
        double accel[3] = {bias[0], bias[1], bias[2]};
        accel[i % 3] += i < 3 ? 9.81 : i < 6 ? -9.81 : 0.0;
        if (i == 6) { /* on an edge */
            accel[0] += 6.0;
            accel[2] += sqrt(9.81 * 9.81 - 36.0);
        }
        snprintf(name, sizeof name, "pose%d.csv", i);
        paths[i] = write_rest(name, accel, gyro, 10.0);
    }
    const char *text = calibrate(calibrate_imu, NULL, paths, 7u);
    ck_assert_msg(text != NULL, "%s", failure.text);
    ASSERT_NEAR(value_of(text, "sensor.accel_bias_x_mps2"), 0.12, 2e-3, "m/s^2");
    ASSERT_NEAR(value_of(text, "sensor.accel_bias_y_mps2"), -0.2, 2e-3, "m/s^2");
    ASSERT_NEAR(value_of(text, "sensor.accel_bias_z_mps2"), 0.07, 2e-3, "m/s^2");
    ASSERT_NEAR(value_of(text, "zupt_ekf.gravity_mps2"), 9.81, 2e-3, "m/s^2");
    ck_assert_ptr_nonnull(strstr(text, "69.9 s of rest in 7 poses")); /* 7 x 9.99 s */
}
END_TEST

START_TEST(a_wrong_scale_is_not_printed_as_gravity)
{
    const double accel[3] = {0.0, 0.0, 10.3}, gyro[3] = {0.0, 0.0, 0.0};
    const char *const path = write_rest("scale.csv", accel, gyro, 5.0);
    const char *text = calibrate(calibrate_imu, NULL, &path, 1u);
    ck_assert_ptr_nonnull(text);
    ck_assert_ptr_null(strstr(text, "gravity_mps2 ="));
    const char *told = strstr(text, "# the accelerometer reads ");
    ck_assert_ptr_nonnull(told);
    ASSERT_NEAR(strtod(told + 26, NULL), 10.3, 5e-3, "m/s^2");
}
END_TEST

/* A rest with something going on from the third second to the fourth. */
static const char *write_disturbed(int what)
{
    const char *path = scratch("disturbed.csv");
    FILE *file = fopen(path, "wb");
    for (int i = 0; i < 1000; i++) {
        double t = 0.01 * i, swing = t > 3.0 && t < 4.0 ? sin(two_pi * 2.0 * (t - 3.0)) : 0.0;
        double tilted = t > 3.5 ? 0.1 : 0.0;
        fprintf(file, "imu,%.2f,%.4f,0,%.4f,%.4f,0,%.4f\n", t,
                what == 0   ? 2.0 * swing
                : what == 1 ? 9.81 * sin(tilted)
                            : 0.0,
                what == 1 ? 9.81 * cos(tilted) : 9.81, what == 2 ? 0.2 * swing : 0.0,
                what == 3 ? 0.3 : 0.0);
    }
    fclose(file);
    return path;
}

START_TEST(a_moving_sensor_is_refused_with_the_reason)
{
    static const char *const reasons[] = {
        "the sensor moves 3.0 s into the log", "the sensor lies otherwise",
        "the sensor moves 3.0 s into the log", "the sensor moves 0.0 s into the log"};
    const char *const path = write_disturbed(_i);
    ck_assert_ptr_null(calibrate(calibrate_imu, NULL, &path, 1u));
    ck_assert_int_eq(failure.exit_code, EXIT_BAD_INPUT);
    ck_assert_msg(strstr(failure.text, reasons[_i]) != NULL, "%s", failure.text);
}
END_TEST

START_TEST(a_short_rest_is_refused)
{
    const double accel[3] = {0.0, 0.0, 9.81}, gyro[3] = {0.0, 0.0, 0.0};
    const char *const path = write_rest("short.csv", accel, gyro, 1.0);
    ck_assert_ptr_null(calibrate(calibrate_imu, NULL, &path, 1u));
    ck_assert_str_eq(failure.text, SCRATCH "/short.csv: shorter than 2 s: expected a longer rest");
}
END_TEST

/* ---- sphere ----------------------------------------------------------------------------- */

START_TEST(spheres_are_found_again)
{
    srand(23);
    for (int trial = 0; trial < 50; trial++) {
        sphere_t sphere;
        double center[3], found[3], radius = 5.0 + rand() % 10, found_radius;
        memset(&sphere, 0, sizeof sphere);
        for (int k = 0; k < 3; k++) {
            center[k] = (rand() % 2001 - 1000) * 1e-3;
        }
        for (int i = 0; i < 12; i++) {
            double p[3], z = -1.0 + 2.0 * (i + 0.5) / 12.0, angle = 2.4 * i;
            p[0] = center[0] + radius * sqrt(1.0 - z * z) * cos(angle);
            p[1] = center[1] + radius * sqrt(1.0 - z * z) * sin(angle);
            p[2] = center[2] + radius * z;
            sphere_add(&sphere, p);
        }
        ck_assert(sphere_fit(&sphere, found, &found_radius));
        ASSERT_NEAR(found_radius, radius, 1e-9, "");
        for (int k = 0; k < 3; k++) {
            ASSERT_NEAR(found[k], center[k], 1e-9, "");
        }
    }
}
END_TEST

START_TEST(points_on_one_side_make_no_sphere)
{
    sphere_t sphere;
    double center[3], radius;
    memset(&sphere, 0, sizeof sphere);
    ck_assert(!sphere_fit(&sphere, center, &radius));
    ASSERT_NEAR(sphere_mean_length(&sphere), 0.0, 0.0, "");
    for (int i = 0; i < 20; i++) { /* a cap of 5 degrees */
        const double p[3] = {9.81 * sin(0.09) * cos(i), 9.81 * sin(0.09) * sin(i),
                             9.81 * cos(0.09)};
        sphere_add(&sphere, p);
    }
    ck_assert(!sphere_fit(&sphere, center, &radius));
    ASSERT_NEAR(sphere_mean_length(&sphere), 9.81, 1e-9, "");
}
END_TEST

/* ---- gyro scale ------------------------------------------------------------------------- */

/* A gyroscope of this scale and bias, turned about a skew axis and back to rest. */
static const char *write_turns(double turns, double scale, double drift)
{
    const char *path = scratch("turns.csv");
    const double axis[3] = {0.6, 0.0, 0.8};
    FILE *file = fopen(path, "wb");
    srand(24);
    for (int i = 0; i < 4000; i++) { /* 3 s rest, 34 s turning, 3 s rest */
        double t = 0.01 * i, u = (t - 3.0) / 34.0;
        double rate = u > 0.0 && u < 1.0 ? turns * two_pi / 34.0 * (1.0 - cos(two_pi * u)) : 0.0;
        double angle = u <= 0.0   ? 0.0
                       : u >= 1.0 ? turns * two_pi
                                  : turns * two_pi * (u - sin(two_pi * u) / two_pi);
        /* gravity (0, 0, 9.81), turned back about the axis */
        double c = cos(angle), s = -sin(angle), d = axis[2] * 9.81 * (1.0 - c);
        double a[3] = {axis[0] * d + s * axis[1] * 9.81, axis[1] * d - s * axis[0] * 9.81,
                       9.81 * c + axis[2] * d};
        fprintf(file, "imu,%.2f", t);
        for (int k = 0; k < 3; k++) {
            fprintf(file, ",%.7f", a[k] + noise(0.02));
        }
        for (int k = 0; k < 3; k++) {
            fprintf(file, ",%.7f",
                    rate * axis[k] / scale + 0.02 * (k - 1) + drift * t + noise(0.002));
        }
        fputs("\n", file);
    }
    fclose(file);
    return path;
}

START_TEST(whole_turns_tell_the_scale_of_the_gyroscope)
{
    static const double scales[] = {1.0, 1.013, 0.96};
    const char *const path = write_turns(5.0, scales[_i], 1e-4);
    const char *text = calibrate(calibrate_gyro_scale, "5", &path, 1u);
    ck_assert_msg(text != NULL, "%s", failure.text);
    ASSERT_NEAR(value_of(text, "sensor.gyro_scale"), scales[_i], 2e-4, "");
    ck_assert_ptr_nonnull(strstr(text, "# calibrate gyro-scale: 5 whole turns\n"));
}
END_TEST

START_TEST(miscounted_turns_are_told)
{
    const char *const path = write_turns(5.0, 1.0, 0.0);
    ck_assert_ptr_null(calibrate(calibrate_gyro_scale, "6", &path, 1u));
    ck_assert_str_eq(failure.text,
                     SCRATCH "/turns.csv: the gyroscope saw 5.00 turns: is --turns right?");
}
END_TEST

START_TEST(a_turn_that_is_not_whole_is_told)
{
    const char *const path = write_turns(5.1, 1.0, 0.0);
    ck_assert_ptr_null(calibrate(calibrate_gyro_scale, "5", &path, 1u));
    ck_assert_ptr_nonnull(strstr(failure.text, "deg otherwise after the turns than before: "
                                               "expected whole turns"));
}
END_TEST

START_TEST(turns_without_rests_are_told)
{
    const double accel[3] = {0.0, 0.0, 9.81}, gyro[3] = {0.0, 0.0, 2.0};
    const char *const path = write_rest("spinning.csv", accel, gyro, 10.0);
    ck_assert_ptr_null(calibrate(calibrate_gyro_scale, "5", &path, 1u));
    ck_assert_str_eq(failure.text,
                     SCRATCH "/spinning.csv: the sensor does not rest for 2 s before the turns");
    const char *const brief = write_rest("brief.csv", accel, gyro, 5.0);
    ck_assert_ptr_null(calibrate(calibrate_gyro_scale, "5", &brief, 1u));
    ck_assert_str_eq(failure.text,
                     SCRATCH "/brief.csv: too short for turns between two rests of 2 s");
}
END_TEST

START_TEST(the_number_of_turns_must_be_told)
{
    const char *const path = scratch("turns.csv");
    ck_assert_ptr_null(calibrate(calibrate_gyro_scale, NULL, &path, 1u));
    ck_assert_int_eq(failure.exit_code, EXIT_WRONG_USAGE);
    ck_assert_ptr_null(calibrate(calibrate_gyro_scale, "none", &path, 1u));
    ck_assert_int_eq(failure.exit_code, EXIT_WRONG_USAGE);
}
END_TEST

/* ---- stride ----------------------------------------------------------------------------- */

static const char *write_walk(const char *name, int strides, double truth_scale)
{
    const foot_walk_t walk = {2.0, 1.3, 0.12, 200.0, strides, 0.0};
    const char *path = scratch(name);
    FILE *file = fopen(path, "wb");
    foot_walk_write(&walk, file);
    for (int i = 0; truth_scale > 0.0 && i < 100 * (int)foot_walk_duration(&walk); i++) {
        foot_pose_t pose = foot_walk_pose(&walk, 0.01 * i);
        fprintf(file, "truth,%.2f,%.5f,%.5f\n", 0.01 * i, truth_scale * pose.x_m,
                truth_scale * pose.y_m);
    }
    fclose(file);
    return path;
}

/* Fourth root of the range of the vertical force that foot_walk.h makes, found by looking. */
static double walk_root(void)
{
    const foot_walk_t walk = {0.0, 1.3, 0.12, 10000.0, 1, 0.0};
    double low = 1e9, high = -1e9;
    for (int i = 0; i <= 6000; i++) {
        double z = foot_walk_pose(&walk, 1e-4 * i).accel_mps2[2];
        low = z < low ? z : low;
        high = z > high ? z : high;
    }
    return pow(high - low, 0.25);
}

START_TEST(k_is_found_from_inertial_strides)
{
    const char *const paths[] = {write_walk("a.csv", 12, 0.0), write_walk("b.csv", 8, 0.0)};
    const char *text = calibrate(calibrate_stride, NULL, paths, 2u);
    ck_assert_msg(text != NULL, "%s", failure.text);
    ck_assert_ptr_nonnull(strstr(text, "# calibrate stride: 20 strides; "));
    ASSERT_NEAR(value_of(text, "stride.k_stride"), 1.3 / walk_root(), 0.01, "");
}
END_TEST

/* Truth that says strides are a tenth longer than they are. */
START_TEST(k_follows_the_truth_where_there_is_one)
{
    const char *const path = write_walk("told.csv", 12, 1.1);
    const char *text = calibrate(calibrate_stride, NULL, &path, 1u);
    ck_assert_msg(text != NULL, "%s", failure.text);
    ASSERT_NEAR(value_of(text, "stride.k_stride"), 1.1 * 1.3 / walk_root(), 0.015, "");
}
END_TEST

START_TEST(few_strides_are_refused)
{
    const char *const path = write_walk("few.csv", 9, 0.0);
    ck_assert_ptr_null(calibrate(calibrate_stride, NULL, &path, 1u));
    ck_assert_str_eq(failure.text, "insole calibrate stride: only 9 strides: expected 10 or more");
}
END_TEST

/* ---- readings --------------------------------------------------------------------------- */

START_TEST(bad_readings_are_left_out)
{
    readings_t readings;
    const char *path = scratch_file("some.csv", "imu,1,0,0,9.8,0,0,0\nimu,1.01,nan,0,9.8,0,0,0\n"
                                                "imu,1.01,0,0,9.9,0,0,0\nimu,1.005,0,0,5,0,0,0\n"
                                                "imu,1.02,0,0,10,0,0,0.3\n");
    ck_assert(readings_load(&readings, path, NULL, NULL, &failure));
    ck_assert_uint_eq(readings.count, 3u);
    ASSERT_NEAR(readings.at[2].t_s, 0.02, 1e-12, "s");
    stretch_t stretch;
    readings_describe(&readings, 0u, 3u, &stretch);
    ASSERT_NEAR(stretch.accel_mps2[2], 9.9, 1e-12, "m/s^2");
    ASSERT_NEAR(stretch.accel_std_mps2[2], 0.1 * sqrt(2.0 / 3.0), 1e-12, "m/s^2");
    ASSERT_NEAR(stretch.gyro_radps[2], 0.1, 1e-12, "rad/s");
    ASSERT_NEAR(stretch.gyro_std_radps[2], 0.1 * sqrt(2.0), 1e-12, "rad/s");
    readings_free(&readings);
    path = scratch_file("one.csv", "imu,1,0,0,9.8,0,0,0\n");
    ck_assert(!readings_load(&readings, path, NULL, NULL, &failure));
    ck_assert_str_eq(failure.text, SCRATCH "/one.csv: fewer than two good readings");
    readings_free(&readings);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("calibrate");
    suite_add(suite, "imu", a_rest_tells_bias_noise_and_gravity);
    suite_add(suite, "six poses", six_poses_tell_the_bias_of_the_accelerometer);
    suite_add(suite, "scale", a_wrong_scale_is_not_printed_as_gravity);
    suite_add_loop(suite, "moving", a_moving_sensor_is_refused_with_the_reason, 4);
    suite_add(suite, "short", a_short_rest_is_refused);
    suite_add(suite, "sphere", spheres_are_found_again);
    suite_add(suite, "cap", points_on_one_side_make_no_sphere);
    suite_add_loop(suite, "gyro scale", whole_turns_tell_the_scale_of_the_gyroscope, 3);
    suite_add(suite, "miscounted", miscounted_turns_are_told);
    suite_add(suite, "not whole", a_turn_that_is_not_whole_is_told);
    suite_add(suite, "no rests", turns_without_rests_are_told);
    suite_add(suite, "turns told", the_number_of_turns_must_be_told);
    suite_add(suite, "stride", k_is_found_from_inertial_strides);
    suite_add(suite, "stride truth", k_follows_the_truth_where_there_is_one);
    suite_add(suite, "few strides", few_strides_are_refused);
    suite_add(suite, "readings", bad_readings_are_left_out);
    return suite;
}
