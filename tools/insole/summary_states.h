/** @file summary_states.h  How long a track was in which state.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_SUMMARY_STATES_H
#define INSOLE_HOST_SUMMARY_STATES_H

#include <stdio.h>

#include "json.h"
#include "replay.h"

void summary_states_print(FILE *file, const replay_facts_t *facts);

void summary_states_json(json_t *json, const replay_facts_t *facts);

#endif
