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

/* A point of the plane whose coordinates are normal, by distance and bearing. */
typedef struct {
    insole_real_t distance, bearing_rad;
} polar_t;

/* Box and Muller: no rejection, so every call costs the same and draws the same. The share is
 * uniform in (0, 1] with 32 bits near 0, where the far tail comes from. */
static polar_t normal_point(insole_rng_t *rng)
{
    insole_real_t share =
        ((insole_real_t)insole_rng_bits(rng) + INSOLE_R(0.5)) * INSOLE_R(2.3283064365386963e-10);
    insole_real_t bearing_rad = INSOLE_R(2.0) * INSOLE_PI * insole_rng_uniform(rng);
    polar_t point = {insole_sqrt(INSOLE_R(-2.0) * insole_log(share)), bearing_rad};
    return point;
}

insole_real_t insole_rng_normal(insole_rng_t *rng)
{
    polar_t point = normal_point(rng);
    return point.distance * insole_cos(point.bearing_rad);
}

INSOLE_FLAT void insole_rng_normals(insole_rng_t *rng, insole_real_t *first, insole_real_t *second)
{
    polar_t point = normal_point(rng);
    insole_turn_t bearing = insole_turn(point.bearing_rad);
    *first = point.distance * bearing.cos;
    *second = point.distance * bearing.sin;
}
