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

#endif
