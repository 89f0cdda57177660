/* SPDX-License-Identifier: MIT */
#include "number.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

static bool take_minus(const char **text)
{
    bool minus = **text == '-';
    if (**text == '-' || **text == '+') {
        (*text)++;
    }
    return minus;
}

/* The digits of a decimal number as an integer, and the power of ten it is to be multiplied by. */
typedef struct {
    uint64_t digits;
    int exponent;
    int count; /* digits seen */
} decimal_t;

static void take_digits(const char **text, decimal_t *decimal, int exponent_per_digit)
{
    for (; is_digit(**text); (*text)++) {
        decimal->count++;
        if (decimal->digits < UINT64_C(1000000000000000000)) {
            decimal->digits = 10u * decimal->digits + (uint64_t)(**text - '0');
            decimal->exponent += exponent_per_digit;
        } else { /* beyond what a double can hold: only its size counts */
            decimal->exponent += exponent_per_digit + 1;
        }
    }
}

static bool take_exponent(const char **text, decimal_t *decimal)
{
    if (**text != 'e' && **text != 'E') {
        return true;
    }
    (*text)++;
    bool minus = take_minus(text);
    if (!is_digit(**text)) {
        return false;
    }
    int exponent = 0;
    for (; is_digit(**text); (*text)++) {
        exponent = exponent < 10000 ? 10 * exponent + (**text - '0') : exponent;
    }
    decimal->exponent += minus ? -exponent : exponent;
    return true;
}

/* 10^exponent for exponent >= 0; exact up to 22. */
static long double power_of_ten(int exponent)
{
    long double result = 1.0L, power = 10.0L;
    for (; exponent > 0; exponent /= 2, power *= power) {
        result *= exponent % 2 != 0 ? power : 1.0L;
    }
    return result;
}

static double decimal_value(const decimal_t *decimal)
{
    int size = decimal->exponent < 0 ? -decimal->exponent : decimal->exponent;
    if (size <= 22 && decimal->digits <= UINT64_C(1) << 53) { /* both exact: rounded once */
        double digits = (double)decimal->digits, power = (double)power_of_ten(size);
        return decimal->exponent < 0 ? digits / power : digits * power;
    }
    long double power = power_of_ten(size < 700 ? size : 700);
    long double digits = (long double)decimal->digits;
    return (double)(decimal->exponent < 0 ? digits / power : digits * power);
}

bool number_parse(const char *text, double *value)
{
    bool minus = take_minus(&text);
    decimal_t decimal = {0u, 0, 0};
    take_digits(&text, &decimal, 0);
    if (*text == '.') {
        text++;
        take_digits(&text, &decimal, -1);
    }
    if (decimal.count == 0 || !take_exponent(&text, &decimal) || *text != '\0') {
        return false;
    }
    double size = decimal.digits == 0u ? 0.0 : decimal_value(&decimal);
    if (!isfinite(size)) {
        return false;
    }
    *value = minus ? -size : size;
    return true;
}

static bool is_word(const char *text, const char *word)
{
    for (; *word != '\0' && tolower((unsigned char)*text) == *word; text++, word++) {
    }
    return *text == '\0' && *word == '\0';
}

bool number_parse_sensor(const char *text, double *value)
{
    const char *word = text;
    take_minus(&word);
    if (*text == '\0' || is_word(word, "nan") || is_word(word, "inf") ||
        is_word(word, "infinity")) {
        *value = NUMBER_UNKNOWN;
        return true;
    }
    return number_parse(text, value);
}

/* The fraction in microseconds; the digit after the sixth rounds. */
static int64_t take_microseconds(const char **text, int *count)
{
    int64_t micros = 0;
    int64_t unit = 100000;
    for (; is_digit(**text); (*text)++, (*count)++) {
        int digit = **text - '0';
        micros += unit > 0 ? digit * unit : (*count == 6 && digit >= 5 ? 1 : 0);
        unit /= 10;
    }
    return micros;
}

bool number_parse_time(const char *text, int64_t *t_us)
{
    bool minus = take_minus(&text);
    int64_t seconds = 0;
    int whole = 0, fraction = 0;
    for (; is_digit(*text); text++, whole++) {
        if (seconds >= NUMBER_TIME_LIMIT_US / 10000000) {
            return false;
        }
        seconds = 10 * seconds + (*text - '0');
    }
    int64_t micros = 0;
    if (*text == '.') {
        text++;
        micros = take_microseconds(&text, &fraction);
    }
    if (whole + fraction == 0 || *text != '\0') {
        return false;
    }
    *t_us = (minus ? -1 : 1) * (1000000 * seconds + micros);
    return true;
}

bool number_parse_whole(const char *text, int64_t low, int64_t high, int64_t *value)
{
    bool minus = take_minus(&text);
    int64_t number = 0;
    if (!is_digit(*text)) {
        return false;
    }
    for (; is_digit(*text); text++) {
        if (number > (INT64_MAX - 9) / 10) {
            return false;
        }
        number = 10 * number + (*text - '0');
    }
    number = minus ? -number : number;
    if (*text != '\0' || number < low || number > high) {
        return false;
    }
    *value = number;
    return true;
}

const char *number_fixed(char buffer[NUMBER_ROOM], double value, int decimals)
{
    double unit = (double)power_of_ten(decimals);
    if (!(fabs(value) * unit < 9.0e18)) {
        snprintf(buffer, NUMBER_ROOM, "nan");
        return buffer;
    }
    uint64_t scaled = (uint64_t)llround(fabs(value) * unit);
    uint64_t whole = scaled / (uint64_t)unit;
    const char *sign = value < 0.0 && scaled > 0u ? "-" : "";
    if (decimals == 0) {
        snprintf(buffer, NUMBER_ROOM, "%s%llu", sign, (unsigned long long)whole);
    } else {
        snprintf(buffer, NUMBER_ROOM, "%s%llu.%0*llu", sign, (unsigned long long)whole, decimals,
                 (unsigned long long)(scaled % (uint64_t)unit));
    }
    return buffer;
}

static void drop_trailing_zeros(char *text)
{
    size_t length = strlen(text);
    while (strchr(text, '.') != NULL && (text[length - 1u] == '0' || text[length - 1u] == '.')) {
        text[--length] = '\0';
    }
}

const char *number_short(char buffer[NUMBER_ROOM], double value)
{
    double size = fabs(value);
    int exponent = size > 0.0 && isfinite(size) ? (int)floor(log10(size)) : 0;
    if (exponent >= -4 && exponent <= 9) {
        number_fixed(buffer, value, exponent < 5 ? 5 - exponent : 0);
        drop_trailing_zeros(buffer);
        return buffer;
    }
    number_fixed(buffer, value * pow(10.0, -exponent), 5);
    drop_trailing_zeros(buffer);
    size_t length = strlen(buffer);
    snprintf(buffer + length, NUMBER_ROOM - length, "e%+03d", exponent);
    return buffer;
}

const char *number_time(char buffer[NUMBER_ROOM], int64_t t_us)
{
    int64_t micros = t_us < 0 ? -t_us : t_us;
    snprintf(buffer, NUMBER_ROOM, "%s%lld.%06d", t_us < 0 ? "-" : "", (long long)(micros / 1000000),
             (int)(micros % 1000000));
    return buffer;
}
