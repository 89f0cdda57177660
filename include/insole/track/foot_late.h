/** @file foot_late.h  Fixes that wait, to be told where the walker was by what came after.
 *
 *  Frames  n: level, as the inertial filter left it.  m: map.
 *
 *  Between the ends of two strides a fix lies as the foot went in n, turned and stretched so that
 *  both ends come to lie where the ancestors of the present cloud were.
 *
 *      static insole_late_row_t rows[2000];
 *      insole_foot_late_init(&late, rows, 2000);
 *      on each stride told to the particles:  insole_foot_late_stride(&late, number, n_m);
 *      on each fix:                           insole_foot_late_push(&late, &row);
 *      while (insole_foot_late_is_due(&late, lag_us)) {
 *          insole_foot_late_take(&late, &particles, &cloud, starts, &fix);
 *      }
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TRACK_FOOT_LATE_H
#define INSOLE_TRACK_FOOT_LATE_H

#include "insole/fuse/particle_filter.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { INSOLE_LATE_STRIDES = 64 /**< whose ends are known */ };

/** A fix that waits for its time. */
typedef struct {
    insole_fix_t fix;
    insole_spot_t n_m; /**< n, where the foot was */
    uint32_t stride;   /**< number of the last stride that had been told to the particles */
    uint32_t start;    /**< number of the start that they walked since; 0: none */
} insole_late_row_t;

typedef struct {
    insole_late_row_t *rows; /**< the caller's */
    uint32_t room, first, count;
    insole_spot_t end_n_m[INSOLE_LATE_STRIDES]; /**< n, of the newest strides */

    uint32_t stride, start, news;     /**< that the two places below are of */
    bool has_begin, has_end;          /**< they are known */
    insole_spot_t begin_m_m, end_m_m; /**< m, where it began and where the next one ended */
} insole_foot_late_t;

/** @param rows  NULL with room 0: nothing can wait
 *  @return INSOLE_ERR_NULL */
insole_status_t insole_foot_late_init(insole_foot_late_t *late, insole_late_row_t *rows,
                                      uint32_t room);

/** A stride has ended. */
insole_status_t insole_foot_late_stride(insole_foot_late_t *late, uint32_t number,
                                        insole_spot_t n_m);

/** One fix more. @return INSOLE_ERR_ROOM */
insole_status_t insole_foot_late_push(insole_foot_late_t *late, const insole_late_row_t *row);

/** True when the oldest fix has waited long enough, or there is no room for another. */
bool insole_foot_late_is_due(const insole_foot_late_t *late, uint64_t lag_us);

/** The oldest fix, at the place that the particles now give it. It stays where it was thought to be
 *  when they have been drawn anew since, or remember no stride so old.
 *  @param start  number of the start that the particles walk since
 *  @return INSOLE_ERR_STATE when none waits */
insole_status_t insole_foot_late_take(insole_foot_late_t *late,
                                      const insole_particle_filter_t *particles,
                                      const insole_cloud_t *cloud, uint32_t start,
                                      insole_fix_t *fix);

#ifdef __cplusplus
}
#endif

#endif
