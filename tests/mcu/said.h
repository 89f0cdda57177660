/** @file said.h  A board that keeps what is said.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TESTS_MCU_SAID_H
#define INSOLE_TESTS_MCU_SAID_H

#include <check.h>

#include "board.h"

static char said[4096];
static size_t said_count;

void board_write(char byte)
{
    ck_assert_uint_lt(said_count, sizeof said - 1u);
    said[said_count++] = byte;
    said[said_count] = '\0';
}

static inline void forget(void)
{
    said_count = 0u;
    said[0] = '\0';
}

#endif
