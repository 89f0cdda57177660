/** @file config.h  One list per config struct, from which all else is made.
 *
 *  A module lists its settings once:
 *
 *      #define INSOLE_STRIDE_KEYS(KEY)                                                     \
 *          KEY(REAL, min_s, 0.2, 0.05, 2.0, "s", "shortest stride that counts; 0.05 = off") \
 *          KEY(CHOICE, by, 0, 0, 1, "ins|model", "what gives the length")
 *      typedef struct { INSOLE_STRIDE_KEYS(INSOLE_CONFIG_MEMBER) } insole_stride_config_t;
 *
 *  The struct, its defaults, the check of its ranges and the keys of `insole config` come from
 *  that list. REAL is an insole_real_t (write its numbers with a decimal point), INT an int32_t,
 *  CHOICE an int32_t whose numbers have names: the unit column holds them, separated by `|`.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_BASE_CONFIG_H
#define INSOLE_BASE_CONFIG_H

#include "insole/base/real.h"

#define INSOLE_CONFIG_TYPE_REAL   insole_real_t
#define INSOLE_CONFIG_TYPE_INT    int32_t
#define INSOLE_CONFIG_TYPE_CHOICE int32_t

#define INSOLE_CONFIG_LITERAL_REAL(number)   INSOLE_R(number)
#define INSOLE_CONFIG_LITERAL_INT(number)    number
#define INSOLE_CONFIG_LITERAL_CHOICE(number) number

/** A member of the struct. */
#define INSOLE_CONFIG_MEMBER(kind, name, value, low, high, unit, text)                             \
    INSOLE_CONFIG_TYPE_##kind name;

/** The member's default, for the initialiser of the struct. */
#define INSOLE_CONFIG_DEFAULT(kind, name, value, low, high, unit, text)                            \
    INSOLE_CONFIG_LITERAL_##kind(value),

/** `&& in range`, for a check of the struct that `config` points at; not-a-number is outside. */
#define INSOLE_CONFIG_IN_RANGE(kind, name, value, low, high, unit, text)                           \
    &&config->name >= INSOLE_CONFIG_LITERAL_##kind(low) &&                                         \
        config->name <= INSOLE_CONFIG_LITERAL_##kind(high)

#endif
