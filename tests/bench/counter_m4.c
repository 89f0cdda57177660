/* SPDX-License-Identifier: MIT
 * QEMU lets 64 ns pass with each instruction; the board's counter has a tick of 40 ns. */
#include "bench.h"
#include "semihost.h"
#include "systick.h"

#include <string.h>

enum { SYS_GET_CMDLINE = 0x15 };
enum { INSTRUCTION_NS = 64, TICK_NS = 40, CALIBRATION_ROUNDS = 100000 };

/* Ticks that the measuring itself takes. */
static uint32_t overhead;

void bench_write(const char *text)
{
    semihost_write(text);
}

/* The words after `-kernel IMAGE -append "..."`: names of cases; none: all. */
bool bench_is_wanted(const char *name)
{
    static char words[256];
    static bool asked;
    if (!asked) {
        const struct {
            char *text;
            uint32_t size;
        } block = {words, sizeof words};
        register uint32_t r0 __asm("r0") = SYS_GET_CMDLINE;
        register const void *r1 __asm("r1") = &block;
        __asm volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
        asked = true;
    }
    const char *list = strchr(words, ' ');
    return !list || strstr(list, name);
}

static uint32_t to_instructions(uint32_t ticks)
{
    return (ticks * TICK_NS + INSTRUCTION_NS / 2) / INSTRUCTION_NS;
}

/* Two instructions a round. */
static void spin(uint32_t rounds)
{
    __asm volatile("1: subs %0, #1\n\tbne 1b" : "+r"(rounds) : : "cc");
}

static void nothing(uint32_t index)
{
    (void)index;
}

__attribute__((noinline)) static uint32_t ticks_of(void (*call)(uint32_t), uint32_t index)
{
    uint32_t before = systick_now();
    call(index);
    return systick_since(before);
}

bool bench_counter_start(void)
{
    systick_start();
    overhead = ticks_of(nothing, 0u);
    uint32_t counted = to_instructions(ticks_of(spin, CALIBRATION_ROUNDS) - overhead);
    uint32_t off = counted > 2u * CALIBRATION_ROUNDS ? counted - 2u * CALIBRATION_ROUNDS
                                                     : 2u * CALIBRATION_ROUNDS - counted;
    return off <= 2u;
}

uint32_t bench_count(void (*call)(uint32_t), uint32_t index)
{
    uint32_t ticks = ticks_of(call, index);
    return ticks > overhead ? to_instructions(ticks - overhead) : 0u;
}
