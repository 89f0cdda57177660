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

#include "number.h"
#include "replay.h"

enum { REPRODUCE_ROWS = 16, REPRODUCE_RUNS_MAX = 1000 };

/** What is told of the errors of a walk; each paper prints some of them. */
typedef enum {
    REPRODUCE_MAX,
    REPRODUCE_MIN,
    REPRODUCE_MEAN,
    REPRODUCE_RMS,
    REPRODUCE_STD, /**< scatter about the mean */
    REPRODUCE_FIGURES
} reproduce_figure_t;

/** In the order of reproduce_figure_t; not-a-number: not known. */
typedef struct {
    double m[REPRODUCE_FIGURES];
} reproduce_figures_t;

#define REPRODUCE_NOT_PRINTED                                                                      \
    {                                                                                              \
        {                                                                                          \
            NUMBER_UNKNOWN, NUMBER_UNKNOWN, NUMBER_UNKNOWN, NUMBER_UNKNOWN, NUMBER_UNKNOWN         \
        }                                                                                          \
    }

/** A row of the table. */
typedef struct {
    const char *label;
    method_t method;
    bool is_ours;         /**< by the default settings; else by the paper's */
    bool starts_by_radio; /**< for the particles only the heading is told, not the place */
    bool lacks_plan;      /**< it is not told the walls */
    reproduce_figures_t printed;
    const char *setting; /**< of this row beside the others, key=value; NULL: none */
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

typedef struct {
    const char *name;     /**< on the command line */
    const char *table;    /**< which of the paper's */
    const char *scenario; /**< in the folder of maps */
    const char *survey;   /**< there, of fingerprints; each walk has its own; NULL: none */
    double begin_s;       /**< errors count from here on: the first step comes later */
    reproduce_scored_t scored;
    const reproduce_figure_t *columns; /**< that the paper prints */
    int column_count;
    const char *const *settings; /**< of the paper's parts, key=value; the last is NULL */
    const char *const *notes;    /**< what to know of the table; the last is NULL */
    const reproduce_row_t *rows; /**< those of the paper's parts first */
    int row_count;
    const reproduce_claim_t *claims;
    int claim_count;
    /** Pictures of the first walk, while its files are there, and of all walks. */
    bool (*draw_walk)(const reproduction_t *reproduction, failure_t *failure);
    bool (*draw_all)(const reproduction_t *reproduction, failure_t *failure);
} reproduce_paper_t;

extern const reproduce_paper_t reproduce_two_order;
extern const reproduce_paper_t reproduce_phone_ekf;

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

    uint64_t seed; /**< of the walk */
    site_t site;
    site_t bare;                    /**< the site without its plan */
    track_t truth;                  /**< where errors are taken, from `begin_s` on */
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

/** Of a row, over the walks. */
reproduce_figures_t reproduce_means(const reproduction_t *reproduction, int row);

/** `max`, `min`, `mean`, ... */
const char *reproduce_figure_name(reproduce_figure_t figure);

void reproduce_print(const reproduction_t *reproduction, FILE *file);

void reproduce_json(const reproduction_t *reproduction, FILE *file);

void reproduce_free(reproduction_t *reproduction);

#endif
