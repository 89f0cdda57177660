/** @file reproduce_wifi_shift.h  Tables I to IV and figure 7 of [WifiShift] again: what was
 * measured beside what was printed.
 *
 *  Three paths, and one survey of fingerprints for all. Each walk is replayed by every row, and by
 *  those of table IV with fewer access points in the radio map as well. All rows have the same
 *  steps, headings and, but for the defaults, fixes; no row sees the truth.
 *
 *      wifi_shift_t study;
 *      if (wifi_shift_begin(&study, &request, &failure) && wifi_shift_measure(&study, &failure))
 *          wifi_shift_print(&study, stdout);
 *      wifi_shift_free(&study);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_REPRODUCE_WIFI_SHIFT_H
#define INSOLE_HOST_REPRODUCE_WIFI_SHIFT_H

#include "number.h"
#include "reproduce.h"

/** On the command line. */
#define WIFI_SHIFT_NAME "WifiShift"

enum {
    WIFI_SHIFT_PATHS = 3,
    WIFI_SHIFT_COUNTS = 3, /**< of access points */
    WIFI_SHIFT_LAMBDAS = 8,
    WIFI_SHIFT_ROWS = 11
};

/** What a start is made of. */
typedef enum {
    WIFI_SHIFT_CIRCLES = 0, /**< (1) */
    WIFI_SHIFT_MOVED,       /**< our own */
    WIFI_SHIFT_FIRST,       /**< the first fix alone */
    WIFI_SHIFT_MEAN,        /**< the mean of lambda fixes */
    WIFI_SHIFT_STARTS
} wifi_shift_start_t;

/** Of the errors of a walk [m]; not-a-number: not known. */
typedef struct {
    double mean_m, std_m;
} wifi_shift_error_t;

/** A row of the tables. */
typedef struct {
    const char *label;
    method_t method;
    bool is_told;       /**< the true start */
    bool lacks_radio;   /**< its radio map is kept from it */
    bool is_in_table_4; /**< measured with fewer access points too */
    const char *const *settings;
    wifi_shift_error_t printed[WIFI_SHIFT_COUNTS][WIFI_SHIFT_PATHS];
} wifi_shift_row_t;

/** A row's mean is at most so large a share of a rival's. */
typedef struct {
    int row, rival;
    double at_most; /**< not-a-number: nothing was set */
} wifi_shift_claim_t;

typedef struct {
    reproduce_request_t request;
    char *survey_folder, *walk_folder;
    site_t sites[WIFI_SHIFT_COUNTS];
    site_t bare; /**< without fingerprints */
    /** Sums over the walks. */
    wifi_shift_error_t sums[WIFI_SHIFT_ROWS][WIFI_SHIFT_COUNTS][WIFI_SHIFT_PATHS];
    double start_m[WIFI_SHIFT_STARTS][WIFI_SHIFT_LAMBDAS]; /**< of figure 7, over walks and paths */
    unsigned long starts[WIFI_SHIFT_STARTS][WIFI_SHIFT_LAMBDAS];
} wifi_shift_t;

/** A walk that was simulated. */
typedef struct {
    int path; /**< from 0 */
    uint64_t seed;
    char *log;
    track_t truth; /**< from the first step on */
} wifi_shift_walk_t;

extern const wifi_shift_row_t wifi_shift_rows[WIFI_SHIFT_ROWS];
extern const int wifi_shift_counts[WIFI_SHIFT_COUNTS];

/** Simulates the survey and opens the site. A refusal leaves something to free as well. */
bool wifi_shift_begin(wifi_shift_t *study, const reproduce_request_t *request, failure_t *failure);

/** Simulates, replays and scores. */
bool wifi_shift_measure(wifi_shift_t *study, failure_t *failure);

/** Looks for the walk's start by the first fixes, more and more of them. */
bool wifi_shift_hunt(wifi_shift_t *study, const wifi_shift_walk_t *walk, failure_t *failure);

/** Mean over the walks. */
wifi_shift_error_t wifi_shift_mean(const wifi_shift_t *study, int row, int count, int path);

/** Mean error of a start that was found from the first so many fixes; not-a-number: none was. */
double wifi_shift_start_error(const wifi_shift_t *study, wifi_shift_start_t start, int lambda);

/** @param[out] count  of them */
const wifi_shift_claim_t *wifi_shift_claims(int *count);

void wifi_shift_print(const wifi_shift_t *study, FILE *file);

void wifi_shift_json(const wifi_shift_t *study, FILE *file);

/** Figure 7. */
bool wifi_shift_draw(const wifi_shift_t *study, failure_t *failure);

void wifi_shift_free(wifi_shift_t *study);

#endif
