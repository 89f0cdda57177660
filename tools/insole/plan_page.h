/** @file plan_page.h  A page with the plan and the access points of a site, as SVG.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_PLAN_PAGE_H
#define INSOLE_HOST_PLAN_PAGE_H

#include "failure.h"
#include "site.h"

/** @param path a file, or `-` for standard output */
bool plan_page_write(const site_t *site, const char *title, const char *subtitle, const char *path,
                     failure_t *failure);

#endif
