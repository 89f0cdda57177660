/** @file systick.h  The counter of a Cortex-M, running down from 2^24 - 1 with the core's clock.
 *
 *      systick_start();
 *      uint32_t before = systick_now();
 *      work();
 *      uint32_t ticks = systick_since(before);         less than 2^24 ticks of work
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_FIRMWARE_SYSTICK_H
#define INSOLE_FIRMWARE_SYSTICK_H

#include <stdint.h>

enum { SYSTICK_MASK = 0xFFFFFF };

void systick_start(void);

static inline uint32_t systick_now(void)
{
    return *(volatile uint32_t *)0xE000E018u;
}

static inline uint32_t systick_since(uint32_t before)
{
    return (before - systick_now()) & SYSTICK_MASK;
}

#endif
