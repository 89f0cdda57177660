/* SPDX-License-Identifier: MIT */
#include "calibrate.h"

#include <math.h>
#include <string.h>

#include "number.h"
#include "readings.h"
#include "sphere.h"

/* Rests are looked at in pieces this long: a push in the middle of a long log must show. */
static const double piece_s = 0.5;
static const double shortest_rest_s = 2.0;

/* How far the mean of a piece may be from that of the whole. */
static const double creep_gyro_radps = 0.02, creep_accel_mps2 = 0.15;

/* Gravity between the poles and the highest peaks, and what the settings take. */
static const double gravity_low_mps2 = 9.7, gravity_high_mps2 = 9.9;

/* What all rests together tell. */
typedef struct {
    double seconds;
    double gyro_bias_radps[3];
    double accel_noise, gyro_noise; /* of a reading times the root of its interval */
    sphere_t sphere;
} rests_t;

void calibrate_line(FILE *file, const char *key, double value, int decimals)
{
    char number[NUMBER_ROOM];
    fprintf(file, "%s = %s\n", key, number_fixed(number, value, decimals));
}

/* A log that should be a rest, and what it is on the whole. */
typedef struct {
    const char *path;
    const readings_t *readings;
    const stretch_t *whole;
} log_t;

static bool check_motion(const log_t *log, size_t from, const stretch_t *piece, failure_t *failure)
{
    char t[NUMBER_ROOM], gyro[NUMBER_ROOM], accel[NUMBER_ROOM];
    if (stretch_is_rest(piece)) {
        return true;
    }
    return failure_input(
        failure,
        "%s: the sensor moves %s s into the log (turn rate %s rad/s, acceleration "
        "scattered by %s m/s^2): expected a sensor at rest",
        log->path, number_fixed(t, log->readings->at[from].t_s, 1),
        number_short(gyro, vector_length(piece->gyro_radps) + vector_length(piece->gyro_std_radps)),
        number_short(accel, vector_length(piece->accel_std_mps2)));
}

static bool check_creep(const log_t *log, size_t from, const stretch_t *piece, failure_t *failure)
{
    char t[NUMBER_ROOM];
    for (int i = 0; i < 3; i++) {
        if (fabs(piece->gyro_radps[i] - log->whole->gyro_radps[i]) > creep_gyro_radps ||
            fabs(piece->accel_mps2[i] - log->whole->accel_mps2[i]) > creep_accel_mps2) {
            return failure_input(failure,
                                 "%s: %s s into the log the sensor lies otherwise, or turns "
                                 "otherwise, than on average: expected one pose per log",
                                 log->path, number_fixed(t, log->readings->at[from].t_s, 1));
        }
    }
    return true;
}

static bool check_pieces(const log_t *log,
                         bool (*check)(const log_t *log, size_t from, const stretch_t *piece,
                                       failure_t *failure),
                         failure_t *failure)
{
    const readings_t *readings = log->readings;
    stretch_t piece;
    for (size_t from = 0u, to; from < readings->count; from = to) {
        to = from + 1u;
        while (to < readings->count && readings->at[to].t_s < readings->at[from].t_s + piece_s) {
            to++;
        }
        readings_describe(readings, from, to, &piece);
        if (!check(log, from, &piece, failure)) {
            return false;
        }
    }
    return true;
}

static double noise_of(const double std[3], double interval_s)
{
    return vector_length(std) / sqrt(3.0) * sqrt(interval_s);
}

/* Adds a session to the means, weighted by its length. */
static void add_rest(rests_t *rests, const readings_t *readings, const stretch_t *whole)
{
    double seconds = readings->at[readings->count - 1u].t_s;
    double interval_s = seconds / (double)(readings->count - 1u);
    rests->seconds += seconds;
    double share = seconds / rests->seconds;
    for (int i = 0; i < 3; i++) {
        rests->gyro_bias_radps[i] += share * (whole->gyro_radps[i] - rests->gyro_bias_radps[i]);
    }
    rests->accel_noise +=
        share * (noise_of(whole->accel_std_mps2, interval_s) - rests->accel_noise);
    rests->gyro_noise += share * (noise_of(whole->gyro_std_radps, interval_s) - rests->gyro_noise);
    sphere_add(&rests->sphere, whole->accel_mps2);
}

static bool take_session(const arguments_t *arguments, const char *path, rests_t *rests,
                         failure_t *failure)
{
    readings_t readings;
    stretch_t whole;
    bool is_good = readings_load(&readings, path, options_value(arguments, "accel-unit"),
                                 options_value(arguments, "gyro-unit"), failure);
    if (is_good && readings.at[readings.count - 1u].t_s < shortest_rest_s) {
        is_good = failure_input(failure, "%s: shorter than 2 s: expected a longer rest", path);
    }
    if (is_good) {
        readings_describe(&readings, 0u, readings.count, &whole);
        log_t log = {path, &readings, &whole};
        is_good =
            check_pieces(&log, check_motion, failure) && check_pieces(&log, check_creep, failure);
    }
    if (is_good) {
        add_rest(rests, &readings, &whole);
    }
    readings_free(&readings);
    return is_good;
}

static void print_gravity(FILE *file, double gravity_mps2)
{
    static const char *const keys[] = {"still_bias.gravity_mps2", "zero_velocity.gravity_mps2",
                                       "zupt_ekf.gravity_mps2"};
    char number[NUMBER_ROOM];
    if (gravity_mps2 < gravity_low_mps2 || gravity_mps2 > gravity_high_mps2) {
        fprintf(file,
                "# the accelerometer reads %s m/s^2 at rest: this is no gravity, its scale or bias "
                "is off\n",
                number_fixed(number, gravity_mps2, 4));
        return;
    }
    for (int i = 0; i < 3; i++) {
        calibrate_line(file, keys[i], gravity_mps2, 4);
    }
}

static void print_rests(FILE *file, const rests_t *rests)
{
    char a[NUMBER_ROOM], b[NUMBER_ROOM];
    double bias[3], gravity_mps2;
    fprintf(file, "# calibrate imu: %s s of rest in %lu pose%s\n",
            number_fixed(a, rests->seconds, 1), (unsigned long)rests->sphere.count,
            rests->sphere.count == 1u ? "" : "s");
    fprintf(file, "# noise: accelerometer %s m/s/sqrt(s), gyroscope %s rad/sqrt(s)\n",
            number_short(a, rests->accel_noise), number_short(b, rests->gyro_noise));
    calibrate_line(file, "sensor.gyro_bias_x_radps", rests->gyro_bias_radps[0], 6);
    calibrate_line(file, "sensor.gyro_bias_y_radps", rests->gyro_bias_radps[1], 6);
    calibrate_line(file, "sensor.gyro_bias_z_radps", rests->gyro_bias_radps[2], 6);
    if (sphere_fit(&rests->sphere, bias, &gravity_mps2)) {
        calibrate_line(file, "sensor.accel_bias_x_mps2", bias[0], 5);
        calibrate_line(file, "sensor.accel_bias_y_mps2", bias[1], 5);
        calibrate_line(file, "sensor.accel_bias_z_mps2", bias[2], 5);
    } else {
        fputs("# the accelerometer's bias takes rests in six poses or more, one log each: every "
              "side up once\n",
              file);
        gravity_mps2 = sphere_mean_length(&rests->sphere);
    }
    print_gravity(file, gravity_mps2);
}

bool calibrate_imu(const arguments_t *arguments, const char *const *sessions, size_t count,
                   FILE *file, failure_t *failure)
{
    rests_t rests;
    memset(&rests, 0, sizeof rests);
    for (size_t i = 0u; i < count; i++) {
        if (!take_session(arguments, sessions[i], &rests, failure)) {
            return false;
        }
    }
    print_rests(file, &rests);
    return true;
}
