/** @file rhythm.h  How much a motion repeats itself: the rhythm of a gait.
 *
 *  Our own; it guards the step counter (step.h) against motion that is no walk.
 *
 *      static insole_rhythm_t rhythm;
 *      insole_rhythm_init(&rhythm);
 *      on each sample:  insole_rhythm_push(&rhythm, t_us, value);
 *      when asked:      insole_rhythm_likeness(&rhythm, lag_us, &likeness);
 *
 *  The signal, of any rate, is laid on a grid of 1/16 s. The likeness compares its last two seconds
 *  with the two seconds that end one lag earlier, 2 sum ab / sum (a^2 + b^2): 1 is a perfect
 *  repetition. Steady gaits repeat from step to step or (limp, pocket) from stride to stride with
 *  0.8 to 0.99, fidgeting of the same strength with about 0.4. The signal must be free of a mean
 * and below 8 Hz.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_SENSE_RHYTHM_H
#define INSOLE_SENSE_RHYTHM_H

#include "insole/base/real.h"
#include "insole/base/status.h"

#ifdef __cplusplus
extern "C" {
#endif

enum {
    INSOLE_RHYTHM_PAST = 64,         /**< grid points kept: window and longest lag */
    INSOLE_RHYTHM_WINDOW = 32,       /**< grid points compared */
    INSOLE_RHYTHM_GRID_US = 62500,   /**< 1/16 s */
    INSOLE_RHYTHM_FIRST_US = 125000, /**< shortest lag */
    INSOLE_RHYTHM_LAST_US = 1999999, /**< longest */
    INSOLE_RHYTHM_GAP_US = 1000000   /**< a longer interval between samples forgets all before */
};

typedef struct {
    insole_real_t past[INSOLE_RHYTHM_PAST]; /**< the signal on the grid, a ring */
    uint32_t end;                           /**< running number of the next grid point */
    uint64_t grid_us;                       /**< time of the newest grid point */
    uint64_t t_us;                          /**< of the newest sample */
    insole_real_t newest;                   /**< its value */
    bool has_time;
    uint32_t refused;
} insole_rhythm_t;

/** Silence before the first sample. @return INSOLE_ERR_NULL */
insole_status_t insole_rhythm_init(insole_rhythm_t *rhythm);

/** Takes a sample; between samples the signal is a straight line.
 *  @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE: not finite or over 1e6; INSOLE_ERR_TIME */
insole_status_t insole_rhythm_push(insole_rhythm_t *rhythm, uint64_t t_us, insole_real_t value);

/** @param lag_us  in [INSOLE_RHYTHM_FIRST_US, INSOLE_RHYTHM_LAST_US]; taken to the better of the
 *                  grid points around it
 *  @param[out] likeness  in [-1, 1]; 0 when there is nothing but silence
 *  @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE */
insole_status_t insole_rhythm_likeness(const insole_rhythm_t *rhythm, uint64_t lag_us,
                                       insole_real_t *likeness);

#ifdef __cplusplus
}
#endif

#endif
