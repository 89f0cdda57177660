/* SPDX-License-Identifier: MIT */
#include "calibrate.h"

#include <string.h>

#include "compass_legs.h"
#include "number.h"

enum { FEWEST_LEGS = 4 };

static const double rad_to_deg = 57.295779513082321;

/* Legs that scatter more point nowhere: a phone that is carried anyhow tells no direction. */
static const double widest_rad = 1.0;

static bool print_north(FILE *file, const compass_legs_t *legs, failure_t *failure)
{
    compass_north_t north;
    char number[NUMBER_ROOM];
    if (legs->count < FEWEST_LEGS) {
        return failure_input(failure,
                             "insole calibrate compass: only %lu legs of a straight way: expected "
                             "%d or more of 2 s at least",
                             (unsigned long)legs->count, FEWEST_LEGS);
    }
    compass_legs_mean(legs, &north);
    if (north.scatter_rad > widest_rad) {
        return failure_input(failure,
                             "insole calibrate compass: legs scatter by %s deg: does the phone "
                             "point ahead?",
                             number_fixed(number, rad_to_deg * north.scatter_rad, 0));
    }
    fprintf(file, "# calibrate compass: %lu legs of %lu session%s; they scatter by %s deg\n",
            (unsigned long)legs->count, (unsigned long)legs->sessions,
            legs->sessions == 1u ? "" : "s",
            number_fixed(number, rad_to_deg * north.scatter_rad, 1));
    fprintf(file, "phone_compass.north_rad = %s", number_fixed(number, north.north_rad, 4));
    fprintf(file, "  # +- %s\n", number_fixed(number, north.error_rad, 4));
    return true;
}

bool calibrate_compass(const arguments_t *arguments, const char *const *sessions, size_t count,
                       FILE *file, failure_t *failure)
{
    compass_legs_t legs;
    bool is_good = true;
    memset(&legs, 0, sizeof legs);
    for (size_t i = 0u; i < count && is_good; i++) {
        is_good = compass_legs_add(&legs, sessions[i], options_value(arguments, "accel-unit"),
                                   options_value(arguments, "gyro-unit"), failure);
    }
    is_good = is_good && print_north(file, &legs, failure);
    compass_legs_free(&legs);
    return is_good;
}
