/* SPDX-License-Identifier: MIT
 * On the host callgrind counts. */
#include "bench.h"

#include <stdio.h>

void bench_write(const char *text)
{
    fputs(text, stdout);
}

bool bench_is_wanted(const char *name)
{
    (void)name;
    return true;
}

bool bench_counter_start(void)
{
    return true;
}

uint32_t bench_count(void (*call)(uint32_t), uint32_t index)
{
    call(index);
    return 0u;
}
