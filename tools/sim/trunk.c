/* SPDX-License-Identifier: MIT */
#include "sim/trunk.h"

#include "sim/algebra.h"

static sim_place_t between(const sim_place_t *a, const sim_place_t *b, double share)
{
    double turn = sim_wrap_pi(b->heading_rad - a->heading_rad);
    sim_place_t place = {a->x_m + share * (b->x_m - a->x_m), a->y_m + share * (b->y_m - a->y_m),
                         a->z_m + share * (b->z_m - a->z_m),
                         sim_wrap_pi(a->heading_rad + share * turn)};
    return place;
}

/* Middle of the footfalls `number` and the one before it. */
static sim_place_t middle(const sim_steps_t *steps, size_t number)
{
    const sim_step_t *a = sim_list_at(&steps->steps, number - 1);
    const sim_step_t *b = sim_list_at(&steps->steps, number);
    return between(&a->place, &b->place, 0.5);
}

/* Number of the first footfall that is not before t; strikes follow each other in time. */
static size_t next_step(const sim_steps_t *steps, double t_s)
{
    size_t low = 2, high = steps->steps.count;
    while (low < high) {
        size_t half = low + (high - low) / 2;
        const sim_step_t *step = sim_list_at(&steps->steps, half);
        if (step->strike_s < t_s) {
            low = half + 1;
        } else {
            high = half;
        }
    }
    return low;
}

sim_place_t sim_trunk_at(const sim_steps_t *steps, double t_s)
{
    size_t number = next_step(steps, t_s);
    const sim_step_t *step = sim_list_at(&steps->steps, number);
    sim_place_t from = middle(steps, number - 1);
    if (step == NULL) {
        return from;
    }
    sim_place_t to = middle(steps, number);
    double share = 1.0 - (step->strike_s - t_s) / step->pace_s;
    return between(&from, &to, fmax(0.0, share));
}
