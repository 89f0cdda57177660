/** @file tracker.h  The tracker that an image is made with: shoe.c or phone.c, whichever is linked.
 *
 *  All memory is static. Calls as in foot_fusion.h and phone_tracker.h.
 *
 *      tracker_begin(seed);
 *      on each reading:  tracker_imu(&imu);
 *                        while (tracker_next(&fix)) use(&fix);
 *                        tracker_work();
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_FIRMWARE_TRACKER_H
#define INSOLE_FIRMWARE_TRACKER_H

#include <stddef.h>

#include "insole/base/types.h"

/** WIRE_FOOT or WIRE_PHONE. */
extern const uint8_t tracker_name;

/** Afresh. @return false when the library does not take the settings */
bool tracker_begin(uint32_t seed);

void tracker_imu(const insole_imu_t *imu);
void tracker_mag(const insole_mag_t *mag);
void tracker_start(const insole_start_t *start);

/** @param readings  with ages before `t_us` */
void tracker_scan(uint64_t t_us, insole_rss_t *readings, uint32_t count);
void tracker_ranges(const insole_range_t *ranges, uint32_t count);

/** @return false when no fix is ready */
bool tracker_next(insole_fix_t *fix);

/** A slice of what is left to do. @return true while something is left */
bool tracker_work(void);

/** No more will come: what is held leaves through tracker_next, in turns with tracker_work. */
void tracker_finish(void);

/** All that must survive a reset. It holds addresses, which mean something to the same image. */
void *tracker_state(size_t *size);

#endif
