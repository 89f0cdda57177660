/** @file core.h  The few things that an image asks of its Cortex-M core.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_FIRMWARE_CORE_H
#define INSOLE_FIRMWARE_CORE_H

#include <stdint.h>

/** No interrupt is taken until core_unmask(); what memory holds is read anew after both. */
static inline void core_mask(void)
{
    __asm volatile("cpsid i" ::: "memory");
}

static inline void core_unmask(void)
{
    __asm volatile("cpsie i\n\tisb" ::: "memory");
}

/** Until an interrupt waits, also a masked one. */
static inline void core_sleep(void)
{
    __asm volatile("dsb\n\twfi" ::: "memory");
}

void core_interrupt_on(uint32_t number);
void core_interrupt_off(uint32_t number);

/** Starts the image again; memory that start-up code does not set keeps what it holds. */
void core_reset(void) __attribute__((noreturn));

/** CRC-32 of code and constants. */
uint32_t core_image(void);

/** Most bytes that the stack has had since the reset. */
uint32_t core_stack_used(void);

#endif
