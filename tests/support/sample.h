/** @file sample.h  Random arguments for tests that try many.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TESTS_SAMPLE_H
#define INSOLE_TESTS_SAMPLE_H

#include "insole/base/quat.h"
#include "insole/base/rng.h"

static inline insole_real_t sample_between(insole_rng_t *rng, insole_real_t low, insole_real_t high)
{
    return low + (high - low) * insole_rng_uniform(rng);
}

/** Components in [-size, size). */
static inline insole_vec3_t sample_vec3(insole_rng_t *rng, insole_real_t size)
{
    insole_real_t x = sample_between(rng, -size, size);
    insole_real_t y = sample_between(rng, -size, size);
    return insole_vec3(x, y, sample_between(rng, -size, size));
}

static inline insole_mat3_t sample_mat3(insole_rng_t *rng, insole_real_t size)
{
    insole_vec3_t r0 = sample_vec3(rng, size);
    insole_vec3_t r1 = sample_vec3(rng, size);
    return insole_mat3_rows(r0, r1, sample_vec3(rng, size));
}

static inline insole_sym3_t sample_sym3(insole_rng_t *rng, insole_real_t size)
{
    insole_vec3_t diagonal = sample_vec3(rng, size), rest = sample_vec3(rng, size);
    insole_sym3_t s = {diagonal.x, rest.x, rest.y, diagonal.y, rest.z, diagonal.z};
    return s;
}

/** Of unit length, but for rounding; every direction. */
static inline insole_quat_t sample_quat(insole_rng_t *rng)
{
    insole_real_t w = insole_rng_normal(rng), x = insole_rng_normal(rng);
    insole_real_t y = insole_rng_normal(rng), z = insole_rng_normal(rng);
    insole_real_t s = INSOLE_R(1.0) / insole_sqrt(w * w + x * x + y * y + z * z);
    return insole_quat(w * s, x * s, y * s, z * s);
}

#endif
