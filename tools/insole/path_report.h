/** @file path_report.h  Path loss as fitted: config lines, how good they are, and access points.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_PATH_REPORT_H
#define INSOLE_HOST_PATH_REPORT_H

#include <stdio.h>

#include "path_model.h"

/** @param has_own  access points get values of their own (path_report_aps): sigma_db is about
 * these, not about the common ones */
void path_report(FILE *file, const path_model_t *model, const path_readings_t *path,
                 const survey_t *survey, bool has_own);

/** aps.csv with the values of each access point. */
void path_report_aps(FILE *file, const path_model_t *model, const path_readings_t *path);

#endif
