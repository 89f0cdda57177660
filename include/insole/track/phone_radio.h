/** @file phone_radio.h  Scans made fixes, in slices, with the time that each speaks of.
 *
 *  Source  [PhoneEKF] 3.2; [PhoneUKF] 6.1.
 *
 *      insole_phone_radio_init(&radio, &solver, &map, late_s);
 *      on each scan:     insole_phone_radio_hear(&radio, &scan, NULL);
 *      in idle time:     while (insole_phone_radio_work(&radio, 16)) {}
 *      if (insole_phone_radio_take(&radio)) use(radio.fix, radio.heard_us);
 *
 *  A reading reaches the log some time after the radio heard it, and tells its age; but what it
 *  tells was seen to lag behind that by about a second. So it speaks of min(t, t - age + late):
 * what matters is that the map was made in the same way.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TRACK_PHONE_RADIO_H
#define INSOLE_TRACK_PHONE_RADIO_H

#include "insole/place/radio_solver.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
    insole_radio_solver_t solver;
    const insole_radio_map_t *map;
    uint64_t late_us;
    bool in_work;
    uint64_t work_us, work_heard_us; /**< the scan in work: when it came, and when it was heard */
    insole_radio_fix_t fix;          /**< the last one */
    uint64_t t_us, heard_us;         /**< its times */
    bool has_fix;
    bool is_new;       /**< it has not been taken */
    uint32_t scans;    /**< taken */
    uint32_t fixes;    /**< made of them */
    uint32_t given_up; /**< scans still in work when the next one came */
    uint32_t unplaced; /**< scans that gave none: too few readings, too old, nothing known */
} insole_phone_radio_t;

/** @param solver  without calls: nothing will be heard
 *  @param map     one that has passed insole_radio_map_check(), or NULL
 *  @param late_s  0 .. 10
 *  @return INSOLE_ERR_NULL; INSOLE_ERR_VALUE for a solver that lacks a call or its state */
insole_status_t insole_phone_radio_init(insole_phone_radio_t *radio,
                                        const insole_radio_solver_t *solver,
                                        const insole_radio_map_t *map, insole_real_t late_s);

/** Whether there is a solver and a map. */
bool insole_phone_radio_can_hear(const insole_phone_radio_t *radio);

/** Takes a scan; its readings are copied, one still in work is given up.
 *  @param area  where fingerprints are looked at; NULL: anywhere
 *  @return INSOLE_ERR_NULL; INSOLE_ERR_STATE without solver or map, or when too little is known of
 *          what was heard; else as the solver answers */
insole_status_t insole_phone_radio_hear(insole_phone_radio_t *radio, const insole_scan_t *scan,
                                        const insole_trusted_area_t *area);

/** Weighs at most `points` fingerprints. @return true while more may be left */
bool insole_phone_radio_work(insole_phone_radio_t *radio, uint32_t points);

/** Whether there is a fix that has not been taken before: `fix`, `t_us` and `heard_us`. */
bool insole_phone_radio_take(insole_phone_radio_t *radio);

#ifdef __cplusplus
}
#endif

#endif
