/** @file text.h  Numbers as text without a C library.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_FIRMWARE_TEXT_H
#define INSOLE_FIRMWARE_TEXT_H

#include <stdint.h>

void text_write(const char *text);
void text_whole(uint32_t number);
void text_hex(uint32_t number);

/** Seconds with six decimals. */
void text_seconds(int64_t t_us);

/** @param decimals  0 .. 6. Beyond 2^31 units of the last decimal it is written as that. */
void text_fixed(float value, uint32_t decimals);

#endif
