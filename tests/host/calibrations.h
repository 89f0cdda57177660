/** @file calibrations.h  A calibration called as the program calls it.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TESTS_HOST_CALIBRATIONS_H
#define INSOLE_TESTS_HOST_CALIBRATIONS_H

#include <stdlib.h>

#include "calibrate.h"
#include "files.h"

typedef bool (*calibration_t)(const arguments_t *arguments, const char *const *sessions,
                              size_t count, FILE *file, failure_t *failure);

/** What a calibration prints; NULL when it refuses.
 *  @param words  of its options, such as "--turns=5 --gyro-unit dps" */
static inline const char *calibrated(calibration_t calibration, const option_t *options,
                                     const char *words, const char *const *sessions, size_t count,
                                     failure_t *failure)
{
    char copy[2000];
    char *argv[16];
    int argc = 0;
    arguments_t arguments;
    snprintf(copy, sizeof copy, "%s", words);
    for (char *word = strtok(copy, " "); word != NULL; word = strtok(NULL, " ")) {
        argv[argc++] = word;
    }
    ck_assert(options_parse(&arguments, "calibrate", options, argc, argv, failure));
    FILE *file = tmpfile();
    bool is_good = calibration(&arguments, sessions, count, file, failure);
    options_free(&arguments);
    const char *text = text_of(file);
    return is_good ? text : NULL;
}

/** Value of a key in what was printed. */
static inline double value_of(const char *text, const char *key)
{
    const char *at = strstr(text, key);
    ck_assert_msg(at != NULL, "no %s in:\n%s", key, text);
    return strtod(at + strlen(key) + 3u, NULL);
}

#endif
