/* SPDX-License-Identifier: MIT */
#include "insole/move/gait_motion.h"

#include <string.h>

#define ZERO INSOLE_R(0.0)
#define ONE  INSOLE_R(1.0)

enum { SLOTS = INSOLE_GAIT_SLOTS, MOST_SAMPLES = 255 };

static const uint64_t SLOT_US = INSOLE_GAIT_SLOT_US;
static const insole_real_t SLOT_S = INSOLE_R(0.05);
static const insole_real_t LARGEST_MPS2 = INSOLE_R(1000.0), LARGEST_RAD = INSOLE_R(10.0);

insole_status_t insole_gait_motion_init(insole_gait_motion_t *motion)
{
    if (!motion) {
        return INSOLE_ERR_NULL;
    }
    memset(motion, 0, sizeof *motion);
    return INSOLE_OK;
}

/* ---- samples ---------------------------------------------------------------------------- */

static uint32_t place_of(uint64_t number)
{
    return (uint32_t)number & (SLOTS - 1u);
}

/* Empties the slots that time has passed over. */
static void open_slots(insole_gait_motion_t *motion, uint64_t newest)
{
    uint64_t last = motion->t_us / SLOT_US, over = newest - last;
    uint32_t count = motion->has_time && over < (uint64_t)SLOTS ? (uint32_t)over : SLOTS;
    insole_gait_slot_t empty = {insole_vec3_zero(), motion->slots[place_of(last)].device_rad};
    for (uint32_t i = 0u; i < count; i++) {
        motion->slots[place_of(newest - i)] = empty;
        motion->counts[place_of(newest - i)] = 0u;
    }
}

insole_status_t insole_gait_motion_push(insole_gait_motion_t *motion, insole_vec3_t force_mps2,
                                        insole_real_t device_rad, uint64_t t_us)
{
    if (!motion) {
        return INSOLE_ERR_NULL;
    }
    if (!(insole_vec3_norm(force_mps2) <= LARGEST_MPS2) ||
        !(insole_abs(device_rad) <= LARGEST_RAD)) {
        return INSOLE_ERR_VALUE;
    }
    if (motion->has_time && t_us <= motion->t_us) {
        return INSOLE_ERR_TIME;
    }
    open_slots(motion, t_us / SLOT_US);
    motion->has_time = true;
    motion->t_us = t_us;
    uint32_t at = place_of(t_us / SLOT_US);
    motion->slots[at].device_rad = device_rad;
    if (motion->counts[at] < MOST_SAMPLES) {
        motion->slots[at].sum_mps2 = insole_vec3_add(motion->slots[at].sum_mps2, force_mps2);
        motion->counts[at]++;
    }
    return INSOLE_OK;
}

/* ---- looking back ----------------------------------------------------------------------- */

static bool is_remembered(const insole_gait_motion_t *motion, uint64_t number)
{
    uint64_t newest = motion->t_us / SLOT_US;
    return motion->has_time && number <= newest && newest - number < (uint64_t)SLOTS;
}

bool insole_gait_motion_reaches(const insole_gait_motion_t *motion, uint64_t t_us)
{
    return motion && is_remembered(motion, t_us / SLOT_US);
}

/* Mean of a slot and its neighbours. @return false when it is forgotten, or they are empty */
static bool find_mean(const insole_gait_motion_t *motion, uint64_t number, insole_vec3_t *mean)
{
    insole_vec3_t sum = insole_vec3_zero();
    uint32_t count = 0u;
    for (uint64_t k = number > 0u ? number - 1u : 0u; k <= number + 1u; k++) {
        if (is_remembered(motion, k)) {
            sum = insole_vec3_add(sum, motion->slots[place_of(k)].sum_mps2);
            count += motion->counts[place_of(k)];
        }
    }
    if (count == 0u || !is_remembered(motion, number)) {
        return false;
    }
    *mean = insole_vec3_scale(sum, ONE / (insole_real_t)count);
    return true;
}

/* Slots `first` to `end` - 1. */
typedef struct {
    uint64_t first, end;
    insole_real_t weight; /* of each in a mean */
} span_t;

static span_t span_of(const insole_gait_window_t *window)
{
    span_t span = {window->begin_us / SLOT_US, (window->end_us - 1u) / SLOT_US + 1u, ZERO};
    span.weight = ONE / (insole_real_t)(span.end - span.first);
    return span;
}

static bool find_mean_of_all(const insole_gait_motion_t *motion, span_t span, insole_vec3_t *mean)
{
    insole_vec3_t sum = insole_vec3_zero(), of_slot;
    for (uint64_t k = span.first; k < span.end; k++) {
        if (!find_mean(motion, k, &of_slot)) {
            return false;
        }
        sum = insole_vec3_add(sum, of_slot);
    }
    *mean = insole_vec3_scale(sum, span.weight);
    return true;
}

/* Vertical velocity on the way through a window, from zero, and means of products with it. */
typedef struct {
    insole_real_t now, lowest, sum, square;
    insole_vec3_t with_a;
} rise_t;

/* Takes the acceleration of the next slot, and the velocity in its middle. */
static void rise(rise_t *v, insole_vec3_t a, insole_real_t weight, insole_gait_moments_t *moments)
{
    insole_real_t half_mps = INSOLE_R(0.5) * SLOT_S * a.z;
    insole_real_t middle = v->now + half_mps;
    v->now = middle + half_mps;
    v->with_a = insole_vec3_add_scaled(v->with_a, weight * middle, a);
    v->sum += weight * middle;
    v->square += weight * middle * middle;
    if (middle < v->lowest) {
        v->lowest = middle;
        moments->falling_mps2 = a;
    }
}

/* Of the harmonic of a step, a quarter period ahead of the vertical acceleration is -w times the
 * vertical velocity; the reference is made of both. */
static void refer(insole_gait_moments_t *moments, const insole_gait_window_t *window,
                  const rise_t *v)
{
    insole_real_t step_s =
        insole_seconds(window->begin_us, window->end_us) / (insole_real_t)window->steps;
    insole_turn_t lead = insole_turn(window->lead_rad);
    insole_real_t by_v = -lead.sin * INSOLE_R(2.0) * INSOLE_PI / step_s;
    insole_real_t var_v = insole_max(v->square - v->sum * v->sum, ZERO);
    const insole_sym3_t *S = &moments->scatter;
    insole_vec3_t with_a_z = insole_vec3_scale(insole_vec3(S->xz, S->yz, S->zz), lead.cos);
    moments->in_phase = insole_vec3_add_scaled(with_a_z, by_v, v->with_a);
    /* the velocity ends where it began: its product with its own rate is zero */
    moments->reference = lead.cos * with_a_z.z + by_v * by_v * var_v;
}

static insole_status_t check(const insole_gait_motion_t *motion, const insole_gait_window_t *window)
{
    if (window->steps == 0u || !(insole_abs(window->lead_rad) <= LARGEST_RAD)) {
        return INSOLE_ERR_VALUE;
    }
    if (window->begin_us >= window->end_us || !motion->has_time || window->end_us > motion->t_us) {
        return INSOLE_ERR_TIME;
    }
    return INSOLE_OK;
}

insole_status_t insole_gait_motion_look(const insole_gait_motion_t *motion,
                                        const insole_gait_window_t *window,
                                        insole_gait_moments_t *moments)
{
    if (!motion || !window || !moments) {
        return INSOLE_ERR_NULL;
    }
    insole_status_t status = check(motion, window);
    if (status != INSOLE_OK) {
        return status;
    }
    span_t span = span_of(window);
    insole_vec3_t mean, a;
    if (!find_mean_of_all(motion, span, &mean)) {
        return INSOLE_ERR_STATE;
    }
    rise_t v = {ZERO, INSOLE_REAL_MAX, ZERO, ZERO, insole_vec3_zero()};
    moments->scatter = insole_sym3_zero();
    for (uint64_t k = span.first; k < span.end && find_mean(motion, k, &a); k++) {
        a = insole_vec3_sub(a, mean);
        /* [PhoneUKF (26)] */
        moments->scatter = insole_sym3_add_outer(moments->scatter, span.weight, a);
        rise(&v, a, span.weight, moments);
    }
    refer(moments, window, &v);
    moments->device_rad = motion->slots[place_of(span.end - 1u)].device_rad;
    return INSOLE_OK;
}
