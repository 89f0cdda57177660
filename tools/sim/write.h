/** @file write.h  From a scenario file to the files of a simulated walk.
 *
 *  Writes into a folder, which is made if it is not there: `log.csv` with a `start` record, one
 *  `imu` record per sample, the `mag` records of a phone and the `rss` records of the scans, in the
 *  order of time; `truth.csv` with the header `t,x,y,z`: the true position of the sensor;
 * `plan.csv` and `aps.csv`, if the scenario names them; `radiomap.csv`, if it has a survey; and
 * what scores a phone (carried.h).
 *
 *      char error[512];
 *      if (sim_write_scenario("maps/demo/scenario", "out", 1, &report, error, sizeof error) != 0)
 *          fprintf(stderr, "%s\n", error);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_SIM_WRITE_H
#define INSOLE_SIM_WRITE_H

#include <stddef.h>
#include <stdint.h>

typedef struct {
    double duration_s;
    double distance_m; /**< along the path, level */
    uint32_t steps;    /**< of both feet */
    uint32_t samples, lost, clipped;
    uint32_t signals; /**< `rss` records */
} sim_report_t;

/** @param report  may be NULL
 *  @param error   gets `file:line: what was wrong and what was expected`; may be NULL
 *  @return 0, or -1 when nothing or not everything could be written */
int sim_write_scenario(const char *scenario_path, const char *out_dir, uint64_t seed,
                       sim_report_t *report, char *error, size_t error_size);

/** The same, with settings that count as if they stood at the end of the scenario.
 *  @param set  `key=value key=value ...`; NULL: none */
int sim_write_scenario_with(const char *scenario_path, const char *out_dir, uint64_t seed,
                            const char *set, sim_report_t *report, char *error, size_t error_size);

#endif
