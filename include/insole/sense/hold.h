/** @file hold.h  Values that cannot be, or are no number, give way to those before them.
 *
 *  Frames  b: sensor, any mounting; each axis by itself.
 *
 *      if (insole_hold(&accel, last_accel, limit)) count++;
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_SENSE_HOLD_H
#define INSOLE_SENSE_HOLD_H

#include "insole/base/vec3.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Axes of `v` that are larger than `limit` either way, or no number, get the value of `last`.
 *  @return true when there was one; false for NULL */
bool insole_hold(insole_vec3_t *v, insole_vec3_t last, insole_real_t limit);

#ifdef __cplusplus
}
#endif

#endif
