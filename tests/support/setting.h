/** @file setting.h  Settings are taken in all of their range, and refused next to it.
 *
 *  For the KEYS list of a struct (base/config.h). Needs a function `insole_status_t judge(void)`
 *  that tries what stands in the struct, which is `config` or what `part` points at:
 *
 *      INSOLE_STRIDE_KEYS(SETTING_HAS_ENDS)
 *      insole_screen_config_t *part = &config.screen;
 *      INSOLE_SCREEN_KEYS(SETTING_OF_PART_HAS_ENDS)
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TESTS_SETTING_H
#define INSOLE_TESTS_SETTING_H

#include <check.h>
#include <math.h>

#include "insole/base/real.h"
#include "insole/base/status.h"

typedef insole_status_t setting_judge_t(void);

enum { SETTING_OUTSIDE = 5 };

/** The next number from `value` towards `end`. */
static inline insole_real_t setting_next(insole_real_t value, insole_real_t end)
{
#ifdef INSOLE_DOUBLE
    return nextafter(value, end);
#else
    return nextafterf(value, end);
#endif
}

static inline void setting_expect(setting_judge_t *judge, insole_status_t expected,
                                  const char *name, double value)
{
    insole_status_t status = judge();
    ck_assert_msg(status == expected, "%s = %.9g: %d, expected %d", name, value, (int)status,
                  (int)expected);
}

static inline void setting_try_real(insole_real_t *key, insole_real_t low, insole_real_t high,
                                    const char *name, setting_judge_t *judge)
{
    const insole_real_t kept = *key;
    const insole_real_t in[] = {low, high, INSOLE_R(0.5) * (low + high)};
    const insole_real_t out[SETTING_OUTSIDE] = {
        setting_next(low, -INSOLE_REAL_MAX), setting_next(high, INSOLE_REAL_MAX),
        (insole_real_t)NAN, (insole_real_t)INFINITY, -(insole_real_t)INFINITY};
    ck_assert_msg(low < high, "%s", name);
    for (int i = 0; i < 3; i++) {
        *key = in[i];
        setting_expect(judge, INSOLE_OK, name, (double)in[i]);
    }
    for (int i = 0; i < SETTING_OUTSIDE; i++) {
        *key = out[i];
        setting_expect(judge, INSOLE_ERR_VALUE, name, (double)out[i]);
    }
    *key = kept;
}

static inline void setting_try_int(int32_t *key, int32_t low, int32_t high, const char *name,
                                   setting_judge_t *judge)
{
    const int32_t kept = *key;
    const int32_t in[] = {low, low + (high - low) / 2, high};
    const int32_t out[] = {low - 1, high + 1, INT32_MIN, INT32_MAX};
    for (int i = 0; i < 3; i++) {
        *key = in[i];
        setting_expect(judge, INSOLE_OK, name, (double)in[i]);
    }
    for (int i = 0; i < 4; i++) {
        *key = out[i];
        setting_expect(judge, INSOLE_ERR_VALUE, name, (double)out[i]);
    }
    *key = kept;
}

#define SETTING_TRY_REAL(key, low, high, name)                                                     \
    setting_try_real(key, INSOLE_R(low), INSOLE_R(high), name, judge);
#define SETTING_TRY_INT(key, low, high, name)    setting_try_int(key, low, high, name, judge);
#define SETTING_TRY_CHOICE(key, low, high, name) setting_try_int(key, low, high, name, judge);

#define SETTING_HAS_ENDS(kind, name, value, low, high, unit, text)                                 \
    SETTING_TRY_##kind(&config.name, low, high, #name)

#define SETTING_OF_PART_HAS_ENDS(kind, name, value, low, high, unit, text)                         \
    SETTING_TRY_##kind(&part->name, low, high, #name)

#endif
