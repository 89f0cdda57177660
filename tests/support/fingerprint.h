/** @file fingerprint.h  The bits that the functions of a float build give on every machine.
 *
 *  Host and bare metal demand the same numbers.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TESTS_FINGERPRINT_H
#define INSOLE_TESTS_FINGERPRINT_H

#include "insole/base/fastmath.h"
#include "insole/base/rng.h"

#ifndef INSOLE_DOUBLE

typedef union {
    uint32_t bits;
    float value;
} fingerprint_bits_t;

typedef struct {
    const char *name;
    float (*function)(float);
    uint32_t expected;
} fingerprint_t;

static inline float fingerprint_atan2(float x)
{
    return insole_atan2(x, 0.7f) + insole_atan2(-1.3f, x);
}

/** The first normal number of the seed that has the bits of x. */
static inline float fingerprint_normal(float x)
{
    fingerprint_bits_t seed;
    insole_rng_t rng;
    seed.value = x;
    insole_rng_seed(&rng, seed.bits);
    return insole_rng_normal(&rng);
}

/** FNV-1a over the bits of every result on a fixed grid over all floats. */
static inline uint32_t fingerprint_of(float (*function)(float))
{
    uint32_t hash = 2166136261u;
    for (uint32_t i = 0u; i < 100000u; i++) {
        fingerprint_bits_t x = {i * 42949u}, y;
        y.value = function(x.value);
        bool nan = (y.bits & 0x7fffffffu) > 0x7f800000u; /* its payload is the machine's affair */
        hash = (hash ^ (nan ? 0u : y.bits)) * 16777619u;
    }
    return hash;
}

enum { FINGERPRINT_COUNT = 7 };

static const fingerprint_t FINGERPRINTS[FINGERPRINT_COUNT] = {
    {"sin", insole_sin, 0x3d0b514au},
    {"cos", insole_cos, 0xa6220aaau},
    {"exp", insole_exp, 0x49eddf6du},
    {"log", insole_log, 0x75105850u},
    {"wrap_pi", insole_wrap_pi, 0x6c90ccfbu},
    {"atan2", fingerprint_atan2, 0x30c0227eu},
    {"normal", fingerprint_normal, 0xb1d5a4a3u},
};

#endif

#endif
