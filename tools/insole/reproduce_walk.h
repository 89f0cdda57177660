/** @file reproduce_walk.h  The simulated walks that the papers' tables are measured on.
 *
 *      reproduce_open_walk(&reproduction, 0, &failure);    simulates: files, site and truth
 *      reproduce_track(&reproduction, &row, &track, &failure);
 *      reproduce_close_walk(&reproduction);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_REPRODUCE_WALK_H
#define INSOLE_HOST_REPRODUCE_WALK_H

#include "reproduce.h"

/** Simulates a scenario of the folder `maps` into a folder.
 *  @param set  settings of the simulator, key=value ...; NULL: none */
bool reproduce_simulate(const char *maps, const char *scenario, const char *folder, uint64_t seed,
                        const char *set, failure_t *failure);

/** The survey that all walks share, if the paper has one. */
bool reproduce_survey(const reproduction_t *reproduction, failure_t *failure);

/** Makes a walk, from 0, the present one. A refusal leaves something to close as well. */
bool reproduce_open_walk(reproduction_t *reproduction, int walk, failure_t *failure);

void reproduce_close_walk(reproduction_t *reproduction);

/** The defaults and these, key=value; the last is NULL. */
bool reproduce_set(settings_t *settings, const char *const *pairs, failure_t *failure);

/** Adds a row to the track that is the sink's context. */
bool reproduce_keep_row(void *context, const track_row_t *row, failure_t *failure);

#endif
