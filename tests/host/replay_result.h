/** @file replay_result.h  All that a replay tells, kept.
 *
 *      replay_result_t result;                     (static)
 *      replay_result_run(&result, &request);       a replay that must succeed
 *      replay_result_clear(&result);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TESTS_HOST_REPLAY_RESULT_H
#define INSOLE_TESTS_HOST_REPLAY_RESULT_H

#include <check.h>
#include <stddef.h>
#include <string.h>

#include "replay.h"

enum { REPLAY_RESULT_EVENTS = 400 };

typedef struct {
    track_t rows;
    event_t list[REPLAY_RESULT_EVENTS]; /**< the first ones */
    int count;                          /**< of them */
    unsigned long events[EVENT_KINDS];  /**< of all */
    double steps_m;                     /**< length of all steps of a phone */
    replay_facts_t facts;
    failure_t failure;
} replay_result_t;

static inline bool replay_result_keep_row(void *context, const track_row_t *row, failure_t *failure)
{
    (void)failure;
    track_add(&((replay_result_t *)context)->rows, row);
    return true;
}

static inline bool replay_result_keep_event(void *context, const event_t *event, failure_t *failure)
{
    replay_result_t *to = context;
    (void)failure;
    bool is_pace = event->kind == EVENT_STRIDE || event->kind == EVENT_STEP;
    ck_assert_int_le(event->begin_us, event->end_us);
    ck_assert(is_pace || event->length_m == 0.0);
    if (to->count < REPLAY_RESULT_EVENTS) {
        to->list[to->count++] = *event;
    }
    to->events[event->kind]++;
    to->steps_m += event->kind == EVENT_STEP ? event->length_m : 0.0;
    return true;
}

static inline void replay_result_run(replay_result_t *result, const replay_request_t *request)
{
    const replay_sink_t sink = {result, NULL, replay_result_keep_row, replay_result_keep_event};
    ck_assert_msg(replay_run(request, &sink, &result->facts, &result->failure), "%s",
                  result->failure.text);
}

static inline void replay_result_clear(replay_result_t *result)
{
    track_free(&result->rows);
    replay_facts_free(&result->facts);
    memset(result, 0, sizeof *result);
}

/** The rows, to be freed by the caller; all else is cleared. */
static inline track_t replay_result_take_rows(replay_result_t *result)
{
    track_t rows = result->rows;
    memset(&result->rows, 0, sizeof result->rows);
    replay_result_clear(result);
    return rows;
}

/** The first n rows of two tracks hold the same bits (but for padding). */
static inline void replay_result_same_rows(const track_t *a, const track_t *b, size_t n)
{
    ck_assert_uint_le(n, a->count);
    ck_assert_uint_le(n, b->count);
    for (size_t i = 0u; i < n; i++) {
        const track_row_t *p = &a->rows[i], *q = &b->rows[i];
        ck_assert_msg(memcmp(p, q, offsetof(track_row_t, state)) == 0 && p->state == q->state,
                      "row %lu at %.6f and %.6f s: x %.17g and %.17g m, var_x %.17g and %.17g m^2, "
                      "state %d and %d",
                      (unsigned long)i, 1e-6 * (double)p->t_us, 1e-6 * (double)q->t_us, p->x_m,
                      q->x_m, p->var_x_m2, q->var_x_m2, (int)p->state, (int)q->state);
    }
}

#endif
