/** @file refusal.h  Checks of what a refused call leaves behind.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TESTS_REFUSAL_H
#define INSOLE_TESTS_REFUSAL_H

#include <check.h>
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

#endif
