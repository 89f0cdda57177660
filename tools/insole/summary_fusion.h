/** @file summary_fusion.h  The part of the summary about building, radio and particles.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_SUMMARY_FUSION_H
#define INSOLE_HOST_SUMMARY_FUSION_H

#include "json.h"
#include "summary.h"

/** Lines for people: what is known of the building, and what radio and cloud did. */
void summary_fusion_print(FILE *file, const summary_t *summary);

/** The same as members of the object. */
void summary_fusion_json(json_t *json, const summary_t *summary);

#endif
