/** @file score_print.h  A score as text and as JSON.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_SCORE_PRINT_H
#define INSOLE_HOST_SCORE_PRINT_H

#include "json.h"
#include "score.h"

void score_print(FILE *file, const score_t *score);

void score_json(json_t *json, const char *key, const score_t *score);

#endif
