/** @file rng.h  Seeded random numbers: the same sequence on every machine.
 *
 *  The state is the caller's; equal seeds give equal sequences. The normal sampler is right in
 *  the tails (it is not a sum of uniforms): its density holds up to its end at 6.7 sigma. A call
 *  always draws the same number of bits, so that the float and the INSOLE_DOUBLE build stay in
 *  step. No pointer may be NULL.
 *
 *      insole_rng_t rng;
 *      insole_rng_seed(&rng, 1);
 *      x = insole_rng_normal(&rng);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_BASE_RNG_H
#define INSOLE_BASE_RNG_H

#include "insole/base/real.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
    uint32_t word[4]; /**< not all zero once seeded */
} insole_rng_t;

/** Any seed is a good seed. */
void insole_rng_seed(insole_rng_t *rng, uint64_t seed);

/** 32 uniform bits. */
uint32_t insole_rng_bits(insole_rng_t *rng);

/** Uniform in [0, 1), a multiple of 2^-24. */
insole_real_t insole_rng_uniform(insole_rng_t *rng);

/** Normal with mean 0 and standard deviation 1: in float within 6e-6 of itself what the formula of
 *  Box and Muller makes of the bits. */
insole_real_t insole_rng_normal(insole_rng_t *rng);

/** Two normal numbers. */
typedef struct {
    insole_real_t first, second;
} insole_normals_t;

/** Two of them, independent, for the price of one. The first is the number that insole_rng_normal
 *  would have given. */
insole_normals_t insole_rng_normals(insole_rng_t *rng);

#ifdef __cplusplus
}
#endif

#endif
