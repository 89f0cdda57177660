/* SPDX-License-Identifier: MIT */
#include "insole/base/rng.h"

#include "insole/base/fastmath.h"

static uint32_t rotate_left(uint32_t x, unsigned by)
{
    return (x << by) | (x >> (32u - by));
}

/* SplitMix64: neighbouring seeds land far apart. One-to-one, so no two draws in a row are 0. */
static uint64_t split_mix(uint64_t *seed)
{
    *seed += 0x9e3779b97f4a7c15u;
    uint64_t z = *seed;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

void insole_rng_seed(insole_rng_t *rng, uint64_t seed)
{
    for (int i = 0; i < 4; i += 2) {
        uint64_t z = split_mix(&seed);
        rng->word[i] = (uint32_t)z;
        rng->word[i + 1] = (uint32_t)(z >> 32);
    }
}

/* xoshiro128++, period 2^128 - 1. */
uint32_t insole_rng_bits(insole_rng_t *rng)
{
    uint32_t *s = rng->word;
    uint32_t bits = rotate_left(s[0] + s[3], 7) + s[0];
    uint32_t shifted = s[1] << 9;
    s[2] ^= s[0];
    s[3] ^= s[1];
    s[1] ^= s[2];
    s[0] ^= s[3];
    s[2] ^= shifted;
    s[3] = rotate_left(s[3], 11);
    return bits;
}

insole_real_t insole_rng_uniform(insole_rng_t *rng)
{
    return (insole_real_t)(insole_rng_bits(rng) >> 8) * INSOLE_R(5.9604644775390625e-8);
}

/* Box and Muller: no rejection, so every call costs the same and draws the same. The square of the
 * distance is -2 ln of a share that is uniform in (0, 1] with 32 bits near 0, where the far tail
 * comes from; the bearing is uniform. */
#ifdef INSOLE_DOUBLE

static double distance_of(uint32_t bits)
{
    return insole_sqrt(-2.0 * insole_log(((double)bits + 0.5) * 2.3283064365386963e-10));
}

static insole_turn_t bearing_of(uint32_t bits)
{
    return insole_turn(2.0 * INSOLE_PI * 2.3283064365386963e-10 * (double)bits);
}

#else

/* Within 5e-6 of itself: x = 2^k (1 + f), 1 + f in [sqrt(1/2), sqrt(2)); minimax. */
static float distance_of(uint32_t bits)
{
    union {
        float value;
        uint32_t bits;
    } x = {(float)bits + 0.5f};
    uint32_t above = x.bits + (0x3f800000u - 0x3f3504f3u);
    int32_t k = (int32_t)(above >> 23) - 127;
    x.bits -= (uint32_t)k << 23;
    float f = x.value - 1.0f;
    float p = ((0.284321f * f - 0.4385621f) * f + 0.50775933f) * f - 0.6654806f;
    p = ((p * f + 0.99983484f) * f - 2.0f) * f;
    return insole_sqrt((float)(k - 32) * -1.38629436f + p);
}

/* By the half turn that the direction lies about; minimax, 6e-7. */
static insole_turn_t bearing_of(uint32_t bits)
{
    bool is_behind = ((bits ^ (bits << 1)) >> 31) != 0u;
    float x = (float)(int32_t)(bits << 1) * 2.3283064365386963e-10f, z = x * x;
    float s = ((-0.5546362f * z + 2.541899f) * z - 5.167143f) * z + 3.141582f;
    float c = ((0.2196968f * z - 1.3318802f) * z + 4.058412f) * z - 4.934793f;
    insole_turn_t ahead = {c * z + 0.99999994f, s * x};
    insole_turn_t behind = {-ahead.cos, -ahead.sin};
    return is_behind ? behind : ahead;
}

#endif

insole_normals_t insole_rng_normals(insole_rng_t *rng)
{
    insole_real_t distance = distance_of(insole_rng_bits(rng));
    insole_turn_t bearing = bearing_of(insole_rng_bits(rng));
    insole_normals_t normals = {distance * bearing.cos, distance * bearing.sin};
    return normals;
}

insole_real_t insole_rng_normal(insole_rng_t *rng)
{
    return insole_rng_normals(rng).first;
}
