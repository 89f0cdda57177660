/** @file walker_filter.h  The filter of walker_ekf.h as a tracker asks for it.
 *
 *      static insole_walker_ekf_t walker;
 *      insole_walker_ekf_init(&walker, &insole_walker_ekf_defaults);
 *      insole_step_filter_t filter = {&insole_walker_filter_calls, &walker};
 *
 *  Of a start by radio the part that the next fixes err by as well is counted as their bias, once.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_FUSE_WALKER_FILTER_H
#define INSOLE_FUSE_WALKER_FILTER_H

#include "insole/fuse/step_filter.h"
#include "insole/fuse/walker_ekf.h"

#ifdef __cplusplus
extern "C" {
#endif

/** The state is an `insole_walker_ekf_t`. */
extern const insole_step_filter_calls_t insole_walker_filter_calls;

#ifdef __cplusplus
}
#endif

#endif
