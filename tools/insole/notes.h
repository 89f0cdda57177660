/** @file notes.h  What the facts of a replay say about the log: the advice of somebody who has
 *         seen many.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_NOTES_H
#define INSOLE_HOST_NOTES_H

#include "replay.h"

enum { NOTES_MAX = 16, NOTE_ROOM = 240 };

typedef struct {
    char text[NOTES_MAX][NOTE_ROOM];
    int count;
} notes_t;

void notes_take(notes_t *notes, const replay_facts_t *facts);

/** Readings per second over the log; 0 when there are less than two. */
double notes_rate_hz(const replay_facts_t *facts);

/** Share of the time in which the foot was still, 0..1. */
double notes_still_share(const replay_facts_t *facts);

#endif
