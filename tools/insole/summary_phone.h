/** @file summary_phone.h  What the phone tracker was given, and what it made of it.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_SUMMARY_PHONE_H
#define INSOLE_HOST_SUMMARY_PHONE_H

#include "json.h"
#include "summary.h"

void summary_phone_print(FILE *file, const summary_t *summary);

void summary_phone_json(json_t *json, const summary_t *summary);

#endif
