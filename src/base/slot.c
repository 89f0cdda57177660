/* SPDX-License-Identifier: MIT */
#include "insole/base/slot.h"

/* Takes a digit of base 2^16 down to the remainder and divides; what remains is below the slot. */
static uint32_t next_digit(uint32_t *remainder, uint32_t digit, uint32_t slot_us)
{
    uint32_t dividend = *remainder << 16 | digit;
    *remainder = dividend % slot_us;
    return dividend / slot_us;
}

static uint32_t next_two(uint32_t *remainder, uint32_t digits, uint32_t slot_us)
{
    uint32_t high = next_digit(remainder, digits >> 16, slot_us);
    return high << 16 | next_digit(remainder, digits & 0xffffu, slot_us);
}

uint64_t insole_slot_of(uint64_t t_us, uint32_t slot_us)
{
    if (slot_us == 0u || slot_us > 65536u) {
        return 0u;
    }
    uint32_t remainder = 0u;
    uint32_t high = next_two(&remainder, (uint32_t)(t_us >> 32), slot_us);
    return (uint64_t)high << 32 | next_two(&remainder, (uint32_t)t_us, slot_us);
}
