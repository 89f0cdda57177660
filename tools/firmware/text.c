/* SPDX-License-Identifier: MIT */
#include "text.h"

#include "board.h"

enum { DIGITS = 20 };

void text_write(const char *text)
{
    while (*text != '\0') {
        board_write(*text++);
    }
}

/* At least `least` digits. */
static void write_digits(uint32_t number, uint32_t base, uint32_t least)
{
    char text[DIGITS];
    uint32_t count = 0u;
    do {
        text[count++] = "0123456789abcdef"[number % base];
        number /= base;
    } while (count < least || number != 0u);
    while (count > 0u) {
        board_write(text[--count]);
    }
}

void text_whole(uint32_t number)
{
    write_digits(number, 10u, 1u);
}

void text_hex(uint32_t number)
{
    write_digits(number, 16u, 8u);
}

static uint32_t power_of_ten(uint32_t exponent)
{
    uint32_t power = 1u;
    for (uint32_t i = 0u; i < exponent; i++) {
        power *= 10u;
    }
    return power;
}

static void write_parts(uint32_t whole, uint32_t part, uint32_t decimals)
{
    text_whole(whole);
    if (decimals > 0u) {
        board_write('.');
        write_digits(part, 10u, decimals);
    }
}

void text_seconds(int64_t t_us)
{
    uint64_t magnitude_us = t_us < 0 ? 0u - (uint64_t)t_us : (uint64_t)t_us;
    if (t_us < 0) {
        board_write('-');
    }
    write_parts((uint32_t)(magnitude_us / 1000000u), (uint32_t)(magnitude_us % 1000000u), 6u);
}

void text_fixed(float value, uint32_t decimals)
{
    const float most = 2147483520.0f; /* the largest float below 2^31 */
    uint32_t scale = power_of_ten(decimals);
    float units = (value < 0.0f ? -value : value) * (float)scale + 0.5f;
    uint32_t magnitude = units < most ? (uint32_t)units : (uint32_t)most;
    if (value < 0.0f && magnitude > 0u) {
        board_write('-');
    }
    write_parts(magnitude / scale, magnitude % scale, decimals);
}
