/** @file progress.h  A bar on the terminal while something takes long.
 *
 *  Nothing is shown where stderr is no terminal, before a second has passed, or where the end
 *  is not known.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_PROGRESS_H
#define INSOLE_HOST_PROGRESS_H

#include <stdbool.h>

typedef struct {
    bool is_wanted, is_shown;
    double begin_s;
    unsigned long calls;
    int percent; /**< on the screen */
} progress_t;

void progress_begin(progress_t *progress);

/** Cheap: may be called for every record. @param all 0: not known */
void progress_show(progress_t *progress, unsigned long long done, unsigned long long all);

/** The same for long steps: every call looks. */
void progress_step(progress_t *progress, unsigned long long done, unsigned long long all);

/** Wipes the bar. */
void progress_end(progress_t *progress);

#endif
