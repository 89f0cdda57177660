/** @file divide.h  A time over a span, where the processor divides 32 bits alone.
 *
 *      uint64_t slot = insole_divide(t_us, SLOT_US);
 *
 *  What a compiler puts in for 64 bits is code for any divisor, ten times as long.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_BASE_DIVIDE_H
#define INSOLE_BASE_DIVIDE_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** How many times the divisor is in it.
 *  @param by  1 .. 2^24 */
uint64_t insole_divide(uint64_t number, uint32_t by);

#ifdef __cplusplus
}
#endif

#endif
