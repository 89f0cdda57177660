/** @file spike.h  A single sample far away from both of its neighbours, which lie close together.
 *
 *  Frames  b: sensor, any mounting; each axis by itself.
 *
 *      if (insole_spike_mend(before, &middle, after, limit)) count++;
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_SENSE_SPIKE_H
#define INSOLE_SENSE_SPIKE_H

#include "insole/base/vec3.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Not worth asking further unless `middle` is this far from the one before. */
static inline bool insole_spike_may_be(const insole_vec3_t *before, const insole_vec3_t *middle,
                                       insole_real_t limit)
{
    insole_vec3_t rise = insole_vec3_sub(*middle, *before);
    return !(insole_vec3_norm2(rise) <= insole_square(limit));
}

/** Axes of `middle` that are a spike get the mean of their neighbours.
 *  @param limit  smallest distance of a spike from both neighbours
 *  @return true when there was one; false for NULL */
bool insole_spike_mend(insole_vec3_t before, insole_vec3_t *middle, insole_vec3_t after,
                       insole_real_t limit);

#ifdef __cplusplus
}
#endif

#endif
