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

#include <stddef.h>

#include "insole/base/real.h"
#include "insole/base/status.h"

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

/** A row of the table of ranges; `config_t` is the struct. */
#define INSOLE_CONFIG_RANGE(kind, name, value, low, high, unit, text)                              \
    {(insole_real_t)(INSOLE_CONFIG_LITERAL_##kind(low)),                                           \
     (insole_real_t)(INSOLE_CONFIG_LITERAL_##kind(high)), (uint16_t)offsetof(config_t, name),      \
     INSOLE_CONFIG_IS_WHOLE_##kind},

#define INSOLE_CONFIG_IS_WHOLE_REAL   false
#define INSOLE_CONFIG_IS_WHOLE_INT    true
#define INSOLE_CONFIG_IS_WHOLE_CHOICE true

#ifdef __cplusplus
extern "C" {
#endif

/** Where a setting lies in its struct, and what it may be. Ends of whole numbers are less than
 *  2^24, so that a real tells them from their neighbours. */
typedef struct {
    insole_real_t low, high;
    uint16_t offset;
    bool is_whole;
} insole_config_range_t;

/** Are all settings in their ranges? Not-a-number is outside of any.
 *
 *      insole_status_t insole_stride_check(const insole_stride_config_t *config)
 *      {
 *          typedef insole_stride_config_t config_t;
 *          static const insole_config_range_t ranges[] = {INSOLE_STRIDE_KEYS(INSOLE_CONFIG_RANGE)};
 *          return insole_config_check(config, ranges, sizeof ranges / sizeof ranges[0]);
 *      }
 *
 *  @param config  the struct that the table is of
 *  @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE for a setting out of its range */
insole_status_t insole_config_check(const void *config, const insole_config_range_t *ranges,
                                    size_t count);

#ifdef __cplusplus
}
#endif

#endif
