/** @file foot_lag.h  The shoe's second order, told later: by then what came after has been worked
 * in.
 *
 *  foot_fusion -> foot_late, `foot_fusion.lag_s` apart
 *
 *      static insole_spot_t past[500 * 42];
 *      static insole_late_row_t rows[2000];
 *      static insole_foot_late_t late;
 *      config.lag_s = 10;
 *      insole_fusion_memory_t memory = {particles, 500, past, 42};
 *      insole_foot_fusion_init(&shoe, &config, &memory, &building, seed);
 *      insole_foot_late_init(&late, rows, 2000);
 *      on each sample:   insole_foot_fusion_imu(&shoe, &imu);
 *                        while (insole_foot_lag_next(&late, &shoe, &fix) == INSOLE_OK) use(&fix);
 *
 *  All else is as foot_fusion.h has it. Rows are as many as samples come in `lag_s`; with fewer a
 * fix leaves as late as there is room.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TRACK_FOOT_LAG_H
#define INSOLE_TRACK_FOOT_LAG_H

#include "insole/track/foot_fusion.h"
#include "insole/track/foot_late.h"

#ifdef __cplusplus
extern "C" {
#endif

/** The next fix, in place of insole_foot_fusion_next(); the same without a lag, and for `wifi`.
 *  @param late  with a fusion that has been set up anew it is, too
 *  @return INSOLE_ERR_NULL, also for a lag without rows; INSOLE_ERR_STATE when none is ready
 */
insole_status_t insole_foot_lag_next(insole_foot_late_t *late, insole_foot_fusion_t *fusion,
                                     insole_fix_t *fix);

#ifdef __cplusplus
}
#endif

#endif
