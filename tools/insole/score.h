/** @file score.h  How far a track is from the truth.
 *
 *  The track is interpolated at the times of the truth. A truth point has a place in the track when
 *  the rows beside it are at most SCORE_GAP_S apart, or when it lies no more than SCORE_END_S
 * before the first or after the last row, which then counts. One without counts SCORE_MISSING_M.
 *
 *  Alignment, by least squares in closed form over the points that have a place:
 *      none  as they are
 *      yaw   turned about the track's place at the first of them
 *      se2   turned and shifted; height shifted by its mean difference. With fewer than three
 *            points the first is met exactly: then the end error of a loop is what fails to close
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_SCORE_H
#define INSOLE_HOST_SCORE_H

#include "failure.h"
#include "track.h"

#define SCORE_GAP_S     2.0
#define SCORE_END_S     0.5
#define SCORE_MISSING_M 30.0
#define SCORE_LEAP_MPS  20.0

typedef enum { ALIGN_NONE, ALIGN_YAW, ALIGN_SE2 } alignment_t;

/** x' = R(turn) x + shift */
typedef struct {
    double turn_rad;
    double x_m, y_m, z_m; /**< shift */
} motion_t;

typedef struct {
    alignment_t alignment;
    motion_t motion; /**< what was done to the track */
    size_t n;        /**< points of truth */
    size_t missing;  /**< of these, without a place in the track */
    double mean_m, std_m, rms_m, max_m, min_m, p50_m, p75_m, p90_m, p95_m; /**< in the plane */
    double end_2d_m;    /**< at the last point of truth */
    double end_3d_m;    /**< not-a-number: no height to compare */
    double distance_m;  /**< walked: length of the truth, or of the track where truth is a loop */
    double end_percent; /**< 2-D end error in % of it; not-a-number: nobody walked */
    double z_rms_m;     /**< not-a-number: no height to compare */
} score_t;

/** @param name none, yaw or se2 */
bool score_alignment_parse(const char *name, alignment_t *alignment, failure_t *failure);

const char *score_alignment_name(alignment_t alignment);

/** What the alignment does to a track, in words. */
const char *score_alignment_text(alignment_t alignment);

/** @param truth at least one point, in order of time */
void score_compute(const track_t *track, const track_t *truth, alignment_t alignment,
                   score_t *score);

/** The error in the plane at each point of truth, the track as it is.
 *  @param[out] errors_m as many as there are points */
void score_errors(const track_t *track, const track_t *truth, double *errors_m);

/** The row as it is after the motion; the covariance turns along. */
void score_move(const motion_t *motion, track_row_t *row);

#endif
