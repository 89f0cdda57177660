/* SPDX-License-Identifier: MIT
 * Vector table and reset of a Cortex-M with a floating-point unit, without an operating system. */
#include "startup.h"

#include <stdint.h>
#include <string.h>

#include "semihost.h"

#define CPACR        (*(volatile uint32_t *)0xE000ED88u)
#define CPACR_FPU_ON (0xFu << 20)

enum { EXCEPTIONS = 15 /* of the core, from reset on */ };

/* By the linker script; the address of a symbol ..._bytes is the size itself. */
extern char data_begin[], data_bytes[], bss_begin[], bss_bytes[];
extern const char data_image[];
extern uint32_t stack_bottom[];
int main(void);
void reset(void);

/* Up to where this function stands; a word at a time, because memset() would stand there too. */
static inline void paint_stack(void)
{
    uint32_t *top;
    __asm volatile("mov %0, sp" : "=r"(top));
    for (volatile uint32_t *at = stack_bottom; at < top; at++) {
        *at = STARTUP_PAINT;
    }
}

void reset(void)
{
    CPACR |= CPACR_FPU_ON;
    __asm volatile("dsb\n\tisb" ::: "memory");
    memcpy(data_begin, data_image, (size_t)data_bytes);
    memset(bss_begin, 0, (size_t)bss_bytes);
    paint_stack();
    semihost_exit(main());
}

static void fault(void)
{
    semihost_write("fault\n");
    semihost_exit(3);
}

/* From reset on; the linker script puts the top of the stack in front. */
#ifdef BOARD_INTERRUPT
enum { VECTORS = EXCEPTIONS + BOARD_INTERRUPT + 1 };
#else
enum { VECTORS = EXCEPTIONS };
#endif

__attribute__((section(".vectors"), used)) static void (*const vectors[VECTORS])(void) = {
    reset,
    fault,
    fault,
    fault,
    fault,
    fault,
#ifdef BOARD_INTERRUPT
    [EXCEPTIONS + BOARD_INTERRUPT] = startup_interrupt,
#endif
};
