/** @file survey.h  What was heard where: sessions with rss and truth records, put together.
 *
 *  Every session stands for itself. Readings of equal t are one scan. A reading lies at the truth
 *  interpolated at the time it was heard, t - age; outside the truth it is left out and counted.
 *  For fingerprints a scan lies as a whole where its youngest reading does (radio_group.h): what is
 *  heard together stays together. Frame m: map, metres.
 *
 *      survey_t survey = {0};
 *      for each session: if (!survey_add(&survey, path, &failure)) ...
 *      for each scan i: survey.scans[i], its readings from .first on
 *      survey_free(&survey);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_SURVEY_H
#define INSOLE_HOST_SURVEY_H

#include "failure.h"
#include "id_table.h"

typedef struct {
    uint32_t id; /**< number in the survey's id table */
    double dbm;
    double x_m, y_m;
    double cos_heading, sin_heading; /**< direction walked; both 0: standing, or not known */
} survey_reading_t;

/** What reached the log at one time. */
typedef struct {
    size_t session;      /**< counted from 0 */
    size_t first, count; /**< readings; one at least */
} survey_scan_t;

/** Where and when a reading was heard; all zeros: each at t - age. */
typedef struct {
    bool whole_scans; /**< all of a scan where its youngest reading was heard */
    double oldest_s;  /**< then: what was heard longer before that is left out; 0: nothing is */
    double late_s;    /**< heard so much after t - age tells, but not after t */
    double ahead_m;   /**< what is heard speaks of a place so far ahead of the walker */
} survey_rule_t;

/** An empty survey is all zeros. */
typedef struct {
    survey_rule_t rule; /**< to be set before the first session */
    id_table_t ids;
    survey_reading_t *readings;
    survey_scan_t *scans;
    size_t reading_count, reading_room, scan_count, scan_room;
    size_t sessions;
    unsigned long outside; /**< readings left out: there is no truth at their time */
    unsigned long unheard; /**< readings left out: no number */
    unsigned long stale;   /**< readings left out: too old for their scan */
} survey_t;

/** @param path  of a session: a log, or a folder of logs
 *  @return false for a session that cannot be read, has no truth or no rss records */
bool survey_add(survey_t *survey, const char *path, failure_t *failure);

void survey_free(survey_t *survey);

#endif
