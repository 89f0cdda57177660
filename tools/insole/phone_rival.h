/** @file phone_rival.h  The particle filter that [PhoneEKF] 4.1 compares with, as parts of a
 * tracker.
 *
 *  Its particles weigh by the inverse distance of the strengths heard to those of the fingerprint
 *  nearest to them. As a solver it gives the fix of kernels besides, from which a walk can start
 *  when no start is told; as a filter it leaves that fix aside and weighs by the scan.
 *
 *      phone_rival_init(&rival, &kde, &cloud, points);
 *      insole_radio_solver_t solver = {&phone_rival_solver, &rival};
 *      insole_step_filter_t filter = {&phone_rival_filter, &rival};
 *      phone_rival_free(&rival);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_PHONE_RIVAL_H
#define INSOLE_HOST_PHONE_RIVAL_H

#include "insole/fuse/step_cloud.h"
#include "insole/place/kde_fix.h"
#include "insole/place/radio_solver.h"

typedef struct {
    insole_kde_fix_t *kde_fix;       /**< the caller's */
    insole_step_cloud_t *step_cloud; /**< the caller's */
    insole_rss_weigh_t rss;
    insole_real_t *log_weights;
    uint32_t points;
} phone_rival_t;

extern const insole_radio_solver_calls_t phone_rival_solver;
extern const insole_step_filter_calls_t phone_rival_filter;

/** @param points  of the radio map */
void phone_rival_init(phone_rival_t *rival, insole_kde_fix_t *kde_fix,
                      insole_step_cloud_t *step_cloud, uint32_t points);

void phone_rival_free(phone_rival_t *rival);

#endif
