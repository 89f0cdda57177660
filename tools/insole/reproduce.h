/** @file reproduce.h  The tables of the papers again: what was measured beside what was printed.
 *
 *  A paper is a table of rows, each a method with its settings, and of what is claimed of them.
 *  All rows see the same simulated walks; the simulator's noise is that of the paper's scenario.
 *  No row sees the truth.
 *
 *      reproduction_t reproduction;
 *      if (reproduce_begin(&reproduction, &reproduce_two_order, &request, &failure) &&
 *          reproduce_measure(&reproduction, &failure))
 *          reproduce_print(&reproduction, stdout);
 *      reproduce_free(&reproduction);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_REPRODUCE_H
#define INSOLE_HOST_REPRODUCE_H

#include <stdio.h>

#include "json.h"
#include "replay.h"

enum { REPRODUCE_ROWS = 16, REPRODUCE_RUNS_MAX = 1000, REPRODUCE_AXES = 5 };

/** What is told of the errors of a walk; each paper prints some of them. */
typedef enum {
    REPRODUCE_MAX,
    REPRODUCE_MIN,
    REPRODUCE_MEAN,
    REPRODUCE_RMS,
    REPRODUCE_STD,  /**< scatter about the mean */
    REPRODUCE_75,   /**< 75 % of the errors are below it */
    REPRODUCE_90,   /**< so are 90 % */
    REPRODUCE_NEAR, /**< share of the errors below 1 m [%] */
    REPRODUCE_FIGURES
} reproduce_figure_t;

/** In the order of reproduce_figure_t; of what is printed 0: it is not. */
typedef struct {
    double m[REPRODUCE_FIGURES];
} reproduce_figures_t;

/** What a row is told of its start. */
typedef enum {
    REPRODUCE_START_TOLD,      /**< place and heading */
    REPRODUCE_START_BY_RADIO,  /**< the heading alone: particles begin where radio says */
    REPRODUCE_START_BY_COMPASS /**< the place alone */
} reproduce_start_t;

/** Values of a setting among which a row's best one is searched. */
typedef struct {
    const char *key;
    const double *values; /**< upwards */
    int count;
} reproduce_axis_t;

/** A row of the table. */
typedef struct {
    const char *label;
    method_t method;
    bool is_ours;     /**< by the default settings; else by the paper's */
    bool lacks_plan;  /**< it is not told the walls */
    bool lacks_radio; /**< nor the fingerprints */
    reproduce_start_t start;
    reproduce_figures_t printed;
    const char *settings;         /**< of this row beside the others: key=value ...; NULL: none */
    const reproduce_axis_t *axes; /**< of the search for its best settings */
    int axis_count;               /**< at most REPRODUCE_AXES */
} reproduce_row_t;

/** A figure of a row is so much lower than a rival's. */
typedef struct {
    int row, rival; /**< numbers of rows */
    reproduce_figure_t figure;
    bool is_against_print; /**< the rival's printed figure counts, not that measured */
    const char *claim;     /**< what is said of it */
} reproduce_claim_t;

/** Where errors are taken. */
typedef enum {
    REPRODUCE_AT_TRUTH, /**< at all rows of the truth */
    REPRODUCE_AT_STEPS  /**< where the walker is at each footfall, but for turns on the spot */
} reproduce_scored_t;

typedef struct reproduction reproduction_t;

/** Some walks differ from the others by this; settings are key=value ..., NULL: none. */
typedef struct {
    const char *name;
    const char *scenario; /**< settings of the simulator */
    const char *settings; /**< what is known of such walks, for the paper's parts alone */
} reproduce_kind_t;

typedef struct {
    const char *file;
    const char *title, *subtitle;
} reproduce_picture_t;

/** A picture of some rows: the way on the first walk, or how many errors of all are how small. */
typedef struct {
    reproduce_picture_t picture;
    double shown_m; /**< errors up to it; 0: the way */
    int rows[REPRODUCE_ROWS];
    int count;
} reproduce_drawing_t;

/** What a paper has beside a table of rows; a function that is NULL does nothing. */
typedef struct {
    size_t size; /**< of reproduction_t.more, which is all zeros before `begin` */
    bool (*begin)(reproduction_t *reproduction, failure_t *failure);
    bool (*walk)(reproduction_t *reproduction, failure_t *failure); /**< the present one */
    bool (*draw_walk)(const reproduction_t *reproduction, failure_t *failure); /**< the first */
    bool (*draw)(const reproduction_t *reproduction, failure_t *failure);      /**< all */
    void (*print)(const reproduction_t *reproduction, FILE *file);
    void (*json)(const reproduction_t *reproduction, json_t *json);
    void (*free)(reproduction_t *reproduction);
} reproduce_more_t;

typedef struct {
    const char *name;     /**< on the command line */
    const char *table;    /**< which of the paper's */
    const char *scenario; /**< in the folder of maps */
    const char *survey;   /**< there, of fingerprints; NULL: none */
    bool shares_survey;   /**< one for all walks, whatever their seeds; else each has its own */
    int runs;             /**< walks where nobody tells */
    double begin_s;       /**< errors count from here on: the first step comes later */
    reproduce_scored_t scored;
    bool is_pooled;                    /**< figures are of all errors, not means of the walks' */
    const reproduce_figure_t *columns; /**< that the paper prints */
    int column_count;
    const reproduce_kind_t *kinds; /**< of walks, seed by seed; NULL: all are the same */
    int kind_count;
    const char *const *settings; /**< of the paper's parts, key=value; the last is NULL */
    const char *const *notes;    /**< what to know of the table; the last is NULL */
    const reproduce_row_t *rows; /**< those of the paper's parts first */
    int row_count;
    const reproduce_claim_t *claims;
    int claim_count;
    const reproduce_drawing_t *drawings;
    int drawing_count;
    const reproduce_more_t *more; /**< NULL: nothing */
} reproduce_paper_t;

/** How many a list has. */
#define REPRODUCE_COUNT(list) ((int)(sizeof(list) / sizeof(list)[0]))

/** The lists of a paper, with their counts. */
#define REPRODUCE_TABLE(column_list, row_list, claim_list, drawing_list)                           \
    .columns = column_list, .column_count = REPRODUCE_COUNT(column_list), .rows = row_list,        \
    .row_count = REPRODUCE_COUNT(row_list), .claims = claim_list,                                  \
    .claim_count = REPRODUCE_COUNT(claim_list), .drawings = drawing_list,                          \
    .drawing_count = REPRODUCE_COUNT(drawing_list)

extern const reproduce_paper_t reproduce_two_order;
extern const reproduce_paper_t reproduce_phone_ekf;
extern const reproduce_paper_t reproduce_phone_ukf;

/** What is asked for. */
typedef struct {
    const char *maps; /**< folder */
    const char *out;  /**< folder for pictures; NULL: none are drawn */
    int runs;
    uint64_t seed; /**< of the first walk; the others follow */
} reproduce_request_t;

/** What a row came to. */
typedef struct {
    reproduce_figures_t *walks; /**< of each walk */
    double *errors_m;           /**< of all walks, one after the other */
    size_t error_count, error_room;
} reproduce_result_t;

struct reproduction {
    const reproduce_paper_t *paper;
    reproduce_request_t request;
    settings_t paper_settings, our_settings;
    reproduce_result_t results[REPRODUCE_ROWS];
    char *folder; /**< of the walk's files */

    void *more; /**< what the paper keeps beside */

    uint64_t seed;                /**< of the walk */
    const reproduce_kind_t *kind; /**< NULL: there are none */
    site_t site;
    site_t bare, deaf;              /**< the site without its plan, and without both maps */
    track_t whole;                  /**< truth */
    track_t truth;                  /**< of it where errors are taken, from `begin_s` on */
    track_t tracks[REPRODUCE_ROWS]; /**< of the rows */
};

/** A refusal leaves something to free as well. */
bool reproduce_begin(reproduction_t *reproduction, const reproduce_paper_t *paper,
                     const reproduce_request_t *request, failure_t *failure);

/** Simulates, replays, scores and draws. */
bool reproduce_measure(reproduction_t *reproduction, failure_t *failure);

/** Replays the present walk as a row asks. */
bool reproduce_replay(const reproduction_t *reproduction, const reproduce_row_t *row,
                      const replay_sink_t *sink, failure_t *failure);

/** The same for its track alone. @param track  empty */
bool reproduce_track(const reproduction_t *reproduction, const reproduce_row_t *row, track_t *track,
                     failure_t *failure);

/** Of a row, over the walks. */
reproduce_figures_t reproduce_means(const reproduction_t *reproduction, int row);

/** `max`, `min`, `mean`, ... */
const char *reproduce_figure_name(reproduce_figure_t figure);

void reproduce_print(const reproduction_t *reproduction, FILE *file);

void reproduce_json(const reproduction_t *reproduction, FILE *file);

void reproduce_free(reproduction_t *reproduction);

#endif
