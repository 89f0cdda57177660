/* SPDX-License-Identifier: MIT */
#include "row_maker.h"

#include <math.h>
#include <string.h>

static const double two_pi = 6.283185307179586;

void row_maker_init(row_maker_t *maker, double rate_hz)
{
    memset(maker, 0, sizeof *maker);
    maker->rate_mhz = llround(1000.0 * rate_hz);
    maker->first_us = INT64_MIN;
}

void row_maker_begin(row_maker_t *maker, int64_t first_us)
{
    maker->first_us = first_us;
}

/* A first reading whose stamp was wild does not tell when the rows begin. */
static void set_first(row_maker_t *maker, int64_t fix_us)
{
    if (fix_us < maker->first_us || maker->first_us == INT64_MIN ||
        fix_us - maker->first_us > ROW_HOLD_US) {
        maker->first_us = fix_us;
    }
}

void row_maker_push(row_maker_t *maker, const track_row_t *fix)
{
    if (maker->held > 0 && fix->t_us <= maker->newest.t_us) {
        return;
    }
    if (maker->held == 0) {
        set_first(maker, fix->t_us);
    }
    maker->before = maker->held > 0 ? maker->newest : *fix;
    maker->newest = *fix;
    maker->held = maker->held < 2 ? maker->held + 1 : 2;
    maker->is_taken = false;
}

static int64_t due_us(const row_maker_t *maker)
{
    int64_t kiloseconds = maker->next / maker->rate_mhz;
    int64_t rest = maker->next % maker->rate_mhz;
    return maker->first_us + kiloseconds * INT64_C(1000000000) +
           rest * INT64_C(1000000000) / maker->rate_mhz;
}

static double mix(double a, double b, double share)
{
    return a + share * (b - a);
}

static void mix_rows(const track_row_t *a, const track_row_t *b, double share, track_row_t *row)
{
    double turn = remainder(b->heading_rad - a->heading_rad, two_pi);
    row->x_m = mix(a->x_m, b->x_m, share);
    row->y_m = mix(a->y_m, b->y_m, share);
    row->z_m = mix(a->z_m, b->z_m, share);
    row->heading_rad = remainder(a->heading_rad + share * turn, two_pi);
    row->var_x_m2 = mix(a->var_x_m2, b->var_x_m2, share);
    row->cov_xy_m2 = mix(a->cov_xy_m2, b->cov_xy_m2, share);
    row->var_y_m2 = mix(a->var_y_m2, b->var_y_m2, share);
    row->var_z_m2 = mix(a->var_z_m2, b->var_z_m2, share);
    row->var_heading_rad2 = mix(a->var_heading_rad2, b->var_heading_rad2, share);
}

/* Before the first fix nothing is known but that fix. */
static void fill_row(const row_maker_t *maker, int64_t t_us, track_row_t *row)
{
    const track_row_t *a = &maker->before, *b = &maker->newest;
    *row = t_us >= b->t_us ? *b : *a;
    row->t_us = t_us;
    if (t_us <= a->t_us || t_us >= b->t_us) {
        return;
    }
    if (b->t_us - a->t_us <= ROW_JOIN_US) {
        mix_rows(a, b, (double)(t_us - a->t_us) / (double)(b->t_us - a->t_us), row);
    } else if (row->state == INSOLE_FIX_TRACK) {
        row->state = INSOLE_FIX_COAST;
    }
}

/* Leaps over the rows of a gap that nobody can say anything about any more. */
static void skip_long_gap(row_maker_t *maker)
{
    if (due_us(maker) < maker->newest.t_us && due_us(maker) - maker->before.t_us > ROW_HOLD_US) {
        int64_t wait_us = maker->newest.t_us - maker->first_us;
        maker->next = wait_us / 1000000 * maker->rate_mhz / 1000;
        while (due_us(maker) < maker->newest.t_us) {
            maker->next++;
        }
    }
}

bool row_maker_take(row_maker_t *maker, track_row_t *row)
{
    if (maker->held == 0) {
        return false;
    }
    if (maker->rate_mhz == 0) {
        *row = maker->newest;
        bool is_new = !maker->is_taken;
        maker->is_taken = true;
        return is_new;
    }
    skip_long_gap(maker);
    if (due_us(maker) > maker->newest.t_us) {
        return false;
    }
    fill_row(maker, due_us(maker), row);
    maker->next++;
    return true;
}
