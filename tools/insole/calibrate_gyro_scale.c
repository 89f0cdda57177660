/* SPDX-License-Identifier: MIT */
#include "calibrate.h"

#include <math.h>
#include <string.h>

#include "number.h"
#include "readings.h"

static const double two_pi = 6.283185307179586;

/* The first and the last so many seconds of the log must be rests: they tell the bias. */
static const double rest_s = 2.0;

/* A gyroscope's scale is good to a few percent; more is a turn miscounted. */
static const double largest_scale_error = 0.1;

/* Whole turns bring gravity back to where it was in the sensor. */
static const double largest_tilt_rad = 0.1;

typedef struct {
    stretch_t before, after;
    double length_s; /* of the log */
} rests_t;

static bool find_rests(const char *path, const readings_t *readings, rests_t *rests,
                       failure_t *failure)
{
    size_t first_end = 0u, last_begin = readings->count - 1u;
    rests->length_s = readings->at[readings->count - 1u].t_s;
    if (rests->length_s < 3.0 * rest_s) {
        return failure_input(failure, "%s: too short for turns between two rests of 2 s", path);
    }
    while (readings->at[first_end].t_s < rest_s) {
        first_end++;
    }
    while (readings->at[last_begin - 1u].t_s > rests->length_s - rest_s) {
        last_begin--;
    }
    readings_describe(readings, 0u, first_end, &rests->before);
    readings_describe(readings, last_begin, readings->count, &rests->after);
    if (!stretch_is_rest(&rests->before) || !stretch_is_rest(&rests->after)) {
        return failure_input(failure, "%s: the sensor does not rest for 2 s %s the turns", path,
                             stretch_is_rest(&rests->before) ? "after" : "before");
    }
    return true;
}

static double angle_between(const double a[3], const double b[3])
{
    double dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    double cosine = dot / (vector_length(a) * vector_length(b));
    return acos(fmax(-1.0, fmin(1.0, cosine)));
}

/* Turn rate without the bias, which goes in a line from the middle of one rest to that of the
 * other. */
static void rate_at(const reading_t *reading, const rests_t *rests, double rate[3])
{
    double share = (reading->t_s - 0.5 * rest_s) / (rests->length_s - rest_s);
    for (int k = 0; k < 3; k++) {
        double bias = rests->before.gyro_radps[k] +
                      share * (rests->after.gyro_radps[k] - rests->before.gyro_radps[k]);
        rate[k] = reading->gyro_radps[k] - bias;
    }
}

/* Length of the integral of the turn rate: the axis stays where it is in the sensor. */
static double turned_angle(const readings_t *readings, const rests_t *rests)
{
    double angle[3] = {0.0, 0.0, 0.0}, last[3], rate[3];
    rate_at(&readings->at[0], rests, last);
    for (size_t i = 1u; i < readings->count; i++) {
        double half_s = 0.5 * (readings->at[i].t_s - readings->at[i - 1u].t_s);
        rate_at(&readings->at[i], rests, rate);
        for (int k = 0; k < 3; k++) {
            angle[k] += half_s * (last[k] + rate[k]);
            last[k] = rate[k];
        }
    }
    return vector_length(angle);
}

static bool measure(const char *path, const readings_t *readings, double turns, double *scale,
                    failure_t *failure)
{
    rests_t rests;
    char number[NUMBER_ROOM];
    if (!find_rests(path, readings, &rests, failure)) {
        return false;
    }
    double tilt = angle_between(rests.before.accel_mps2, rests.after.accel_mps2);
    if (tilt > largest_tilt_rad) {
        return failure_input(failure,
                             "%s: the sensor lies %s deg otherwise after the turns than before: "
                             "expected whole turns",
                             path, number_fixed(number, 360.0 * tilt / two_pi, 1));
    }
    double angle = turned_angle(readings, &rests);
    *scale = turns * two_pi / angle;
    if (!(fabs(*scale - 1.0) <= largest_scale_error)) {
        return failure_input(failure, "%s: the gyroscope saw %s turns: is --turns right?", path,
                             number_fixed(number, angle / two_pi, 2));
    }
    return true;
}

bool calibrate_gyro_scale(const arguments_t *arguments, const char *const *sessions, size_t count,
                          FILE *file, failure_t *failure)
{
    double turns = 0.0, scale = 1.0;
    char number[NUMBER_ROOM];
    readings_t readings;
    if (!options_has(arguments, "turns") || count != 1u) {
        return failure_usage(failure,
                             "insole calibrate gyro-scale: expected one LOG and --turns N");
    }
    if (!options_number(arguments, "turns", 1.0, 1000.0, &turns, failure)) {
        return false;
    }
    bool is_good = readings_load(&readings, sessions[0], options_value(arguments, "accel-unit"),
                                 options_value(arguments, "gyro-unit"), failure) &&
                   measure(sessions[0], &readings, turns, &scale, failure);
    readings_free(&readings);
    if (is_good) {
        fprintf(file, "# calibrate gyro-scale: %s whole turns\n", number_short(number, turns));
        calibrate_line(file, "sensor.gyro_scale", scale, 6);
    }
    return is_good;
}
