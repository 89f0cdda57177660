/** @file fixes.h  What every fix that leaves a tracker must be.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TESTS_FIXES_H
#define INSOLE_TESTS_FIXES_H

#include <check.h>
#include <string.h>

#include "insole/base/types.h"

/** Bit for bit, whatever lies between the fields. */
static inline bool is_same_fix(const insole_fix_t *a, const insole_fix_t *b)
{
    return a->t_us == b->t_us && a->state == b->state &&
           memcmp(&a->position_m, &b->position_m, sizeof a->position_m) == 0 &&
           memcmp(&a->heading_rad, &b->heading_rad, sizeof a->heading_rad) == 0 &&
           memcmp(&a->var_x_m2, &b->var_x_m2, sizeof a->var_x_m2) == 0 &&
           memcmp(&a->cov_xy_m2, &b->cov_xy_m2, sizeof a->cov_xy_m2) == 0 &&
           memcmp(&a->var_y_m2, &b->var_y_m2, sizeof a->var_y_m2) == 0 &&
           memcmp(&a->var_z_m2, &b->var_z_m2, sizeof a->var_z_m2) == 0 &&
           memcmp(&a->var_heading_rad2, &b->var_heading_rad2, sizeof a->var_heading_rad2) == 0;
}

/** From..to, of two runs. */
static inline void expect_same_fixes(const insole_fix_t *a, const insole_fix_t *b, uint32_t from,
                                     uint32_t to)
{
    for (uint32_t i = from; i < to; i++) {
        if (!is_same_fix(&a[i], &b[i])) {
            ck_abort_msg("fix %u differs", i);
        }
    }
}

/** Every number finite, no variance below zero. */
static inline bool is_sane_fix(const insole_fix_t *f)
{
    return insole_vec3_is_finite(f->position_m) && insole_is_finite(f->heading_rad) &&
           insole_is_finite(f->var_x_m2) && insole_is_finite(f->cov_xy_m2) &&
           insole_is_finite(f->var_y_m2) && insole_is_finite(f->var_z_m2) &&
           insole_is_finite(f->var_heading_rad2) && f->var_x_m2 >= INSOLE_R(0.0) &&
           f->var_y_m2 >= INSOLE_R(0.0) && f->var_z_m2 >= INSOLE_R(0.0) &&
           f->var_heading_rad2 >= INSOLE_R(0.0);
}

#endif
