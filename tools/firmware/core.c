/* SPDX-License-Identifier: MIT */
#include "core.h"

#include "insole/base/snapshot.h"
#include "startup.h"

#define NVIC_ISER   ((volatile uint32_t *)0xE000E100u)
#define NVIC_ICER   ((volatile uint32_t *)0xE000E180u)
#define AIRCR       (*(volatile uint32_t *)0xE000ED0Cu)
#define AIRCR_KEY   0x05FA0000u
#define SYSRESETREQ 4u

/* By the linker script; the address of a symbol ..._bytes is the size itself. */
extern const char code_begin[], code_bytes[], stack_bytes[];
extern const uint32_t stack_bottom[];

void core_interrupt_on(uint32_t number)
{
    NVIC_ISER[number / 32u] = 1u << number % 32u;
}

void core_interrupt_off(uint32_t number)
{
    NVIC_ICER[number / 32u] = 1u << number % 32u;
    __asm volatile("dsb\n\tisb" ::: "memory");
}

void core_reset(void)
{
    __asm volatile("dsb" ::: "memory");
    AIRCR = AIRCR_KEY | SYSRESETREQ;
    for (;;) {
        __asm volatile("dsb" ::: "memory");
    }
}

uint32_t core_image(void)
{
    return insole_crc32(0u, code_begin, (size_t)code_bytes);
}

uint32_t core_stack_used(void)
{
    uint32_t words = (uint32_t)stack_bytes / 4u, unused = 0u;
    while (unused < words && stack_bottom[unused] == STARTUP_PAINT) {
        unused++;
    }
    return 4u * (words - unused);
}
