/** @file refusal.h  Checks of what a refused call leaves behind.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TESTS_REFUSAL_H
#define INSOLE_TESTS_REFUSAL_H

#include <check.h>
#include <math.h>
#include <string.h>

/** The call answers `expected` and leaves every byte of `state` as it was. */
#define ASSERT_UNCHANGED(state, call, expected)                                                    \
    do {                                                                                           \
        unsigned char refusal_before_[sizeof(state)];                                              \
        memcpy(refusal_before_, &(state), sizeof(state));                                          \
        ck_assert_int_eq((call), (expected));                                                      \
        ck_assert_msg(memcmp(refusal_before_, &(state), sizeof(state)) == 0, "%s changed %s",      \
                      #call, #state);                                                              \
    } while (0)

/** The same, but for the state's own counter, which goes up by one. */
#define ASSERT_REFUSED(state, counter, call, expected)                                             \
    do {                                                                                           \
        unsigned char refusal_before_[sizeof(state)];                                              \
        memcpy(refusal_before_, &(state), sizeof(state));                                          \
        ck_assert_int_eq((call), (expected));                                                      \
        (counter)--;                                                                               \
        ck_assert_msg(memcmp(refusal_before_, &(state), sizeof(state)) == 0,                       \
                      "%s changed more of %s than its counter", #call, #state);                    \
        (counter)++;                                                                               \
    } while (0)

#define SETTING_NAN_REAL(setting, judge)                                                           \
    ck_assert_int_eq(((setting) = (insole_real_t)NAN, (judge)), INSOLE_ERR_VALUE)
#define SETTING_NAN_INT(setting, judge)
#define SETTING_NAN_CHOICE(setting, judge)

/** For a KEYS list: each setting of `config` is refused outside its range and taken at its ends.
 *  Needs a config struct `config` and a function `insole_status_t judge(void)` that tries it. */
#define SETTING_HAS_ENDS(kind, name, value, low, high, unit, text)                                 \
    do {                                                                                           \
        INSOLE_CONFIG_TYPE_##kind setting_ = config.name;                                          \
        config.name = INSOLE_CONFIG_LITERAL_##kind(low) - 1;                                       \
        ck_assert_msg(judge() == INSOLE_ERR_VALUE, "%s below its range", #name);                   \
        config.name = (high > 0 ? 2 : 1) * INSOLE_CONFIG_LITERAL_##kind(high) + 1;                 \
        ck_assert_msg(judge() == INSOLE_ERR_VALUE, "%s above its range", #name);                   \
        SETTING_NAN_##kind(config.name, judge());                                                  \
        config.name = INSOLE_CONFIG_LITERAL_##kind(low);                                           \
        ck_assert_msg(judge() == INSOLE_OK, "%s at its low end", #name);                           \
        config.name = INSOLE_CONFIG_LITERAL_##kind(high);                                          \
        ck_assert_msg(judge() == INSOLE_OK, "%s at its high end", #name);                          \
        config.name = setting_;                                                                    \
    } while (0);

#endif
