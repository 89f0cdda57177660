/* SPDX-License-Identifier: MIT
 * Stands in for libFuzzer: the inputs named on the command line, then random ones. */
#include "fuzz.h"

#include "insole/base/rng.h"

enum { LARGEST = 1 << 16, RANDOM_INPUTS = 200, RANDOM_BYTES = 4096 };

static uint8_t bytes[LARGEST];

static void feed(size_t size)
{
    /* A copy of exactly this size lets a sanitizer see a read beyond it. */
    uint8_t *copy = malloc(size > 0 ? size : 1);
    fuzz_claim(copy != NULL, "there is memory");
    memcpy(copy, bytes, size);
    LLVMFuzzerTestOneInput(copy, size);
    free(copy);
}

static void feed_file(const char *name)
{
    FILE *file = fopen(name, "rb");
    fuzz_claim(file != NULL, name);
    size_t size = fread(bytes, 1, sizeof bytes, file);
    fclose(file);
    feed(size);
}

static void feed_random(insole_rng_t *rng)
{
    size_t size = insole_rng_bits(rng) % RANDOM_BYTES;
    for (size_t i = 0; i < size; i++) {
        bytes[i] = (uint8_t)(insole_rng_bits(rng) >> 24);
    }
    feed(size);
}

int main(int argc, char **argv)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 1u);
    for (int i = 1; i < argc; i++) {
        feed_file(argv[i]);
    }
    for (int i = 0; i < RANDOM_INPUTS; i++) {
        feed_random(&rng);
    }
    printf("%d given inputs and %d random ones\n", argc - 1, RANDOM_INPUTS);
    return 0;
}
