/** @file number.h  Numbers read and written the same way in every locale.
 *
 *  Times never pass through floating point: "-1.5" is -1500000 us exactly.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_NUMBER_H
#define INSOLE_HOST_NUMBER_H

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/** Room for any formatted number and its final NUL. */
enum { NUMBER_ROOM = 40 };

/** A value that nobody knows. */
#define NUMBER_UNKNOWN ((double)NAN)

/** Times lie between -this and +this [us]: 31,000 years. */
#define NUMBER_TIME_LIMIT_US INT64_C(1000000000000000000)

/** A finite decimal number that takes up the whole text: `-12`, `.5`, `3e-4`. */
bool number_parse(const char *text, double *value);

/** As number_parse, and `nan`, `inf` of any case or sign and the empty text, which all give
 *  not-a-number: what a logger writes when its sensor said nothing useful. */
bool number_parse_sensor(const char *text, double *value);

/** Seconds with decimals, no exponent; what is finer than a microsecond is rounded. */
bool number_parse_time(const char *text, int64_t *t_us);

/** A whole number in low..high. */
bool number_parse_whole(const char *text, int64_t low, int64_t high, int64_t *value);

/** `decimals` (0..9) digits after the point; -0 is written as 0; what is not finite or does not
 *  fit as `nan`. @return buffer */
const char *number_fixed(char buffer[NUMBER_ROOM], double value, int decimals);

/** At most 6 significant digits and no more than the number needs: 0.02, 40000, 1.5e-09.
 *  @return buffer */
const char *number_short(char buffer[NUMBER_ROOM], double value);

/** Seconds with 6 decimals. @return buffer */
const char *number_time(char buffer[NUMBER_ROOM], int64_t t_us);

#endif
