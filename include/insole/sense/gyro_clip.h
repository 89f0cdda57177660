/** @file gyro_clip.h  Which axes of a gyro are at the end of their range.
 *
 *  The range is told, or recognised as it cuts off: a clipped peak stays near its top and then
 *  falls fast, a swing's own peak is round. Of several tops that were cut off the largest counts,
 *  until a rate goes far beyond it.
 *
 *  Frames  b: sensor, any mounting; each axis by itself.
 *
 *      static insole_gyro_clip_t clip;
 *      insole_gyro_clip_init(&clip, INSOLE_R(0.0), INSOLE_R(0.82));
 *      on each sample:
 *          insole_gyro_clip_push(&clip, gyro_radps, dt_us, &axes);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_SENSE_GYRO_CLIP_H
#define INSOLE_SENSE_GYRO_CLIP_H

#include "insole/base/status.h"
#include "insole/base/vec3.h"

#ifdef __cplusplus
extern "C" {
#endif

/** The present excursion of one axis: how long near its top, how long on its way down. */
typedef struct {
    insole_real_t top_radps;  /**< of the excursion; 0 = there is none */
    insole_real_t last_radps; /**< size of the sample before */
    insole_real_t top_us, fall_us;
} insole_clip_peak_t;

typedef struct {
    insole_real_t told_radps;    /**< 0 = to be recognised */
    insole_real_t share;         /**< of the range, from which an axis counts as clipped */
    insole_real_t range_radps;   /**< told, or the largest top that was cut off; 0 = none yet */
    insole_real_t largest_radps; /**< rate that any axis had for two samples, if no slow one */
    insole_real_t quiet_radps2;  /**< a vector whose square is smaller is only remembered */
    insole_clip_peak_t peak[3];
} insole_gyro_clip_t;

/** @param range_radps 0 to 100; 0 = to be recognised
 *  @param share       0.5 to 1
 *  @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE */
insole_status_t insole_gyro_clip_init(insole_gyro_clip_t *clip, insole_real_t range_radps,
                                      insole_real_t share);

/** Is it so slow that only its size is of interest? */
static inline bool insole_gyro_clip_is_quiet(const insole_gyro_clip_t *clip,
                                             const insole_vec3_t *gyro_radps)
{
    return insole_vec3_norm2(*gyro_radps) < clip->quiet_radps2;
}

/** As insole_gyro_clip_push for a rate that is quiet and follows another. Nothing is checked. */
static inline void insole_gyro_clip_remember(insole_gyro_clip_t *clip,
                                             const insole_vec3_t *gyro_radps)
{
    clip->peak[0].last_radps = insole_abs(gyro_radps->x);
    clip->peak[1].last_radps = insole_abs(gyro_radps->y);
    clip->peak[2].last_radps = insole_abs(gyro_radps->z);
}

/** @param dt_us      time since the sample before; 0 = unknown, what was being watched is over
 *  @param[out] axes  bit m set: axis m is at the end of its range
 *  @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE: a rate is not finite, or the time not 0 or more */
insole_status_t insole_gyro_clip_push(insole_gyro_clip_t *clip, insole_vec3_t gyro_radps,
                                      insole_real_t dt_us, uint8_t *axes);

#ifdef __cplusplus
}
#endif

#endif
