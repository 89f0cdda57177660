/* SPDX-License-Identifier: MIT
 * Vector table and reset of a Cortex-M4F without an operating system. */
#include <stdint.h>
#include <string.h>

#include "semihost.h"

#define CPACR        (*(volatile uint32_t *)0xE000ED88u)
#define CPACR_FPU_ON (0xFu << 20)

/* By the linker script; the address of a symbol ..._bytes is the size itself. */
extern char data_begin[], data_bytes[], bss_begin[], bss_bytes[];
extern const char data_image[];
int main(void);
void reset(void);

void reset(void)
{
    CPACR |= CPACR_FPU_ON;
    __asm volatile("dsb\n\tisb" ::: "memory");
    memcpy(data_begin, data_image, (size_t)data_bytes);
    memset(bss_begin, 0, (size_t)bss_bytes);
    semihost_exit(main());
}

static void fault(void)
{
    semihost_write("fault\n");
    semihost_exit(3);
}

/* From reset on; the linker script puts the top of the stack in front. No interrupt is enabled. */
__attribute__((section(".vectors"), used)) static void (*const vectors[15])(void) = {
    reset, fault, fault, fault, fault, fault,
};
