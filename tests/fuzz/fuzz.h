/** @file fuzz.h  What fuzz targets share: taking values off the input, and giving up loudly.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TESTS_FUZZ_H
#define INSOLE_TESTS_FUZZ_H

#define _POSIX_C_SOURCE 200809L /* fmemopen */

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/** Input not yet taken. */
typedef struct {
    const uint8_t *data;
    size_t left;
} fuzz_input_t;

/** The next `count` bytes; zeros where the input has ended. */
static inline void fuzz_take(fuzz_input_t *input, void *into, size_t count)
{
    size_t have = count < input->left ? count : input->left;
    memset(into, 0, count);
    if (have > 0) {
        memcpy(into, input->data, have);
        input->data += have;
        input->left -= have;
    }
}

static inline uint8_t fuzz_byte(fuzz_input_t *input)
{
    uint8_t byte;
    fuzz_take(input, &byte, sizeof byte);
    return byte;
}

/** -32768 .. 32767 */
static inline int16_t fuzz_short(fuzz_input_t *input)
{
    int16_t number;
    fuzz_take(input, &number, sizeof number);
    return number;
}

/** Any bits: infinities and not-a-number too. */
static inline float fuzz_float(fuzz_input_t *input)
{
    float number;
    fuzz_take(input, &number, sizeof number);
    return number;
}

static inline void fuzz_claim(int holds, const char *what)
{
    if (!holds) {
        fprintf(stderr, "does not hold: %s\n", what);
        abort();
    }
}

/** The input as a file, open for reading. */
static inline FILE *fuzz_file(const uint8_t *data, size_t size)
{
    static uint8_t bytes[(1 << 16) + 1];
    fuzz_claim(size < sizeof bytes, "the input fits");
    memcpy(bytes, data, size);
    bytes[size] = '\n'; /* an empty file cannot be opened in memory */
    FILE *file = fmemopen(bytes, size > 0 ? size : 1, "rb");
    fuzz_claim(file != NULL, "there is memory");
    return file;
}

#endif
