/** @file reproduced.h  What the suites of the papers' tables have in common.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TESTS_HOST_REPRODUCED_H
#define INSOLE_TESTS_HOST_REPRODUCED_H

#include "reproduce.h"

#include <math.h>
#include <stdlib.h>

#include "files.h"
#include "near.h"
#include "platform.h"
#include "suite.h"
#include "xml.h"

static failure_t failure;
static reproduction_t reproduction;

static inline reproduce_request_t request_of(int runs, uint64_t seed, const char *out)
{
    reproduce_request_t request = {MAPS, out, runs, seed};
    return request;
}

static inline bool try_paper(const reproduce_paper_t *paper, int runs, uint64_t seed,
                             const char *out)
{
    reproduce_request_t request = request_of(runs, seed, out);
    return reproduce_begin(&reproduction, paper, &request, &failure) &&
           reproduce_measure(&reproduction, &failure);
}

static inline void measure_paper(const reproduce_paper_t *paper, int runs, uint64_t seed,
                                 const char *out)
{
    ck_assert_msg(try_paper(paper, runs, seed, out), "%s", failure.text);
}

static inline const char *printed(void (*print)(const reproduction_t *, FILE *))
{
    FILE *file = tmpfile();
    ck_assert_ptr_nonnull(file);
    print(&reproduction, file);
    return text_of(file);
}

static inline int row_in(const reproduce_paper_t *paper, const char *label)
{
    for (int i = 0; i < paper->row_count; i++) {
        if (strcmp(paper->rows[i].label, label) == 0) {
            return i;
        }
    }
    ck_abort_msg("no row %s", label);
    return -1;
}

/* A claim speaks of rows that are there, and against print of what is printed. */
static inline void check_claims(const reproduce_paper_t *paper)
{
    for (int i = 0; i < paper->claim_count; i++) {
        const reproduce_claim_t *claim = &paper->claims[i];
        ck_assert(claim->row >= 0 && claim->row < paper->row_count);
        ck_assert(claim->rival >= 0 && claim->rival < paper->row_count);
        ck_assert(!claim->is_against_print ||
                  paper->rows[claim->rival].printed.m[claim->figure] > 0.0);
    }
}

/* A walk is the same among others as alone. */
static inline void check_walk_alone(const reproduce_paper_t *paper, int walk, uint64_t seed)
{
    reproduce_figures_t among[REPRODUCE_ROWS];
    for (int row = 0; row < paper->row_count; row++) {
        among[row] = reproduction.results[row].walks[walk];
    }
    reproduce_free(&reproduction);
    measure_paper(paper, 1, seed, NULL);
    for (int row = 0; row < paper->row_count; row++) {
        for (int k = 0; k < REPRODUCE_FIGURES; k++) {
            ASSERT_NEAR(reproduction.results[row].walks[0].m[k], among[row].m[k], 0.0, "m");
        }
    }
    reproduce_free(&reproduction);
}

static inline void check_picture(const char *out, const char *name)
{
    char *path = platform_join(out, name);
    const char *fault = xml_fault(content_of(path));
    ck_assert_msg(fault == NULL, "%s is not well formed at: %.60s", name, fault);
    free(path);
}

#endif
