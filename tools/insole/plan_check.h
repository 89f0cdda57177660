/** @file plan_check.h  What is wrong with a plan that can be read.
 *
 *  An error is a plan that cannot have been meant so; a warning is what may have been.
 *
 *      findings_t findings = {0};
 *      plan_check(&findings, &site, &parts);
 *      findings_print(&findings, stdout, "plan.csv", "aps.csv");
 *      findings_free(&findings);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_PLAN_CHECK_H
#define INSOLE_HOST_PLAN_CHECK_H

#include "findings.h"
#include "plan_parts.h"
#include "site.h"

/** The corners of a box around a plan. */
typedef struct {
    plan_point_t low, high;
} plan_box_t;

/** The box around all lines of the first floor. */
plan_box_t plan_box(const plan_file_t *plan);

/** @param findings  empty, all zeros
 *  @param parts     of the site's plan */
void plan_check(findings_t *findings, const site_t *site, const plan_parts_t *parts);

#endif
