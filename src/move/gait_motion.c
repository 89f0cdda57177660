/* SPDX-License-Identifier: MIT */
#include "insole/move/gait_motion.h"

#include <string.h>

#include "insole/base/slot.h"

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

static uint64_t slot_of(uint64_t t_us)
{
    return insole_slot_of(t_us, INSOLE_GAIT_SLOT_US);
}

static uint32_t place_of(uint64_t number)
{
    return (uint32_t)number & (SLOTS - 1u);
}

/* Empties the slots that time has passed over. */
static void open_slots(insole_gait_motion_t *motion, uint64_t newest)
{
    uint64_t last = motion->newest, over = newest - last;
    uint32_t count = motion->has_time && over < (uint64_t)SLOTS ? (uint32_t)over : SLOTS;
    insole_gait_slot_t empty = {insole_vec3_zero(), motion->slots[place_of(last)].facing};
    for (uint32_t i = 0u; i < count; i++) {
        motion->slots[place_of(newest - i)] = empty;
        motion->counts[place_of(newest - i)] = 0u;
    }
    motion->newest = newest;
}

insole_status_t insole_gait_motion_push(insole_gait_motion_t *motion, insole_vec3_t force_mps2,
                                        const insole_gait_facing_t *facing, uint64_t t_us)
{
    if (!motion || !facing) {
        return INSOLE_ERR_NULL;
    }
    if (!(insole_vec3_norm(force_mps2) <= LARGEST_MPS2) ||
        !(insole_abs(facing->device_rad) <= LARGEST_RAD) ||
        !(insole_abs(facing->turned_rad) <= LARGEST_RAD)) {
        return INSOLE_ERR_VALUE;
    }
    if (motion->has_time && t_us <= motion->t_us) {
        return INSOLE_ERR_TIME;
    }
    open_slots(motion, slot_of(t_us));
    motion->has_time = true;
    motion->t_us = t_us;
    uint32_t at = place_of(motion->newest);
    motion->slots[at].facing = *facing;
    if (motion->counts[at] < MOST_SAMPLES) {
        motion->slots[at].sum_mps2 = insole_vec3_add(motion->slots[at].sum_mps2, force_mps2);
        motion->counts[at]++;
    }
    return INSOLE_OK;
}

/* ---- looking back ----------------------------------------------------------------------- */

static bool is_remembered(const insole_gait_motion_t *motion, uint64_t number)
{
    return motion->has_time && number <= motion->newest &&
           motion->newest - number < (uint64_t)SLOTS;
}

bool insole_gait_motion_reaches(const insole_gait_motion_t *motion, uint64_t t_us)
{
    return motion && is_remembered(motion, slot_of(t_us));
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
    insole_real_t facing_rad;
} span_t;

static insole_real_t turned_at(const insole_gait_motion_t *motion, uint64_t number)
{
    return motion->slots[place_of(number)].facing.turned_rad;
}

/* Mean over the last step. */
static insole_real_t mean_facing(const insole_gait_motion_t *motion, const span_t *span,
                                 uint32_t steps)
{
    insole_real_t last = turned_at(motion, span->end - 1u), sum = ZERO;
    uint32_t length = (uint32_t)(span->end - span->first) / steps;
    length = length > 0u ? length : 1u;
    for (uint64_t k = span->end - length; k < span->end; k++) {
        sum += insole_wrap_pi(turned_at(motion, k) - last);
    }
    return insole_wrap_pi(last + sum / (insole_real_t)length);
}

static span_t span_of(const insole_gait_motion_t *motion, const insole_gait_window_t *window)
{
    span_t span = {slot_of(window->begin_us), slot_of(window->end_us - 1u) + 1u, ZERO, ZERO};
    span.weight = ONE / (insole_real_t)(uint32_t)(span.end - span.first);
    span.facing_rad = mean_facing(motion, &span, window->steps);
    return span;
}

/* That mean of a slot, turned to where the walker faces at last. */
static bool find_turned(const insole_gait_motion_t *motion, const span_t *span, uint64_t number,
                        insole_vec3_t *mean)
{
    insole_vec3_t a;
    if (!find_mean(motion, number, &a)) {
        return false;
    }
    insole_turn_t turn = insole_turn(insole_wrap_pi(span->facing_rad - turned_at(motion, number)));
    insole_spot_t level = insole_turn_way(turn, insole_spot(a.x, a.y));
    *mean = insole_vec3(level.x_m, level.y_m, a.z);
    return true;
}

static bool find_mean_of_all(const insole_gait_motion_t *motion, const span_t *span,
                             insole_vec3_t *mean)
{
    insole_vec3_t sum = insole_vec3_zero(), of_slot;
    for (uint64_t k = span->first; k < span->end; k++) {
        if (!find_turned(motion, span, k, &of_slot)) {
            return false;
        }
        sum = insole_vec3_add(sum, of_slot);
    }
    *mean = insole_vec3_scale(sum, span->weight);
    return true;
}

/* Vertical velocity on the way through a window, from zero. */
typedef struct {
    insole_real_t now, lowest;
} rise_t;

/* Takes the acceleration of the next slot, and the velocity in its middle. */
static void rise(rise_t *v, insole_vec3_t a, insole_gait_moments_t *moments)
{
    insole_real_t half_mps = INSOLE_R(0.5) * SLOT_S * a.z;
    insole_real_t middle = v->now + half_mps;
    v->now = middle + half_mps;
    if (middle < v->lowest) {
        v->lowest = middle;
        moments->falling_mps2 = a;
    }
}

/* Phase of the stride in the middle of a slot, and what it gains to the next. */
typedef struct {
    insole_turn_t now, per_slot;
} phase_t;

static phase_t phase_of(const insole_gait_window_t *window, uint64_t first)
{
    insole_real_t step_s =
        insole_seconds(window->begin_us, window->end_us) / (insole_real_t)window->steps;
    insole_real_t before_s = insole_seconds(first * SLOT_US, window->begin_us);
    phase_t phase = {insole_turn(INSOLE_PI * (INSOLE_R(0.5) * SLOT_S - before_s) / step_s),
                     insole_turn(INSOLE_PI * SLOT_S / step_s)};
    return phase;
}

static insole_turn_t sum_of(insole_turn_t a, insole_turn_t b)
{
    insole_turn_t sum = {a.cos * b.cos - a.sin * b.sin, a.sin * b.cos + a.cos * b.sin};
    return sum;
}

static void add_wave(insole_gait_wave_t *wave, insole_real_t weight, insole_turn_t phase,
                     insole_vec3_t a)
{
    wave->c = insole_vec3_add_scaled(wave->c, weight * phase.cos, a);
    wave->s = insole_vec3_add_scaled(wave->s, weight * phase.sin, a);
}

static insole_status_t check(const insole_gait_motion_t *motion, const insole_gait_window_t *window)
{
    if (window->steps == 0u) {
        return INSOLE_ERR_VALUE;
    }
    if (window->begin_us >= window->end_us || !motion->has_time || window->end_us > motion->t_us) {
        return INSOLE_ERR_TIME;
    }
    return INSOLE_OK;
}

/* Sums over the slots of a span whose mean is known. */
static void sum_up(const insole_gait_motion_t *motion, const insole_gait_window_t *window,
                   const span_t *span, insole_vec3_t mean, insole_gait_moments_t *moments)
{
    insole_real_t twice = INSOLE_R(2.0) * span->weight,
                  of_stride = window->steps > 1u ? twice : ZERO;
    rise_t v = {ZERO, INSOLE_REAL_MAX};
    phase_t half = phase_of(window, span->first);
    insole_vec3_t a;
    for (uint64_t k = span->first; k < span->end && find_turned(motion, span, k, &a); k++) {
        a = insole_vec3_sub(a, mean);
        /* [PhoneUKF (26)] */
        moments->scatter = insole_sym3_add_outer(moments->scatter, span->weight, a);
        add_wave(&moments->step, twice, sum_of(half.now, half.now), a);
        add_wave(&moments->stride, of_stride, half.now, a);
        rise(&v, a, moments);
        half.now = sum_of(half.now, half.per_slot);
    }
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
    if (!insole_gait_motion_reaches(motion, window->begin_us)) {
        return INSOLE_ERR_STATE;
    }
    span_t span = span_of(motion, window);
    insole_vec3_t mean;
    if (!find_mean_of_all(motion, &span, &mean)) {
        return INSOLE_ERR_STATE;
    }
    memset(moments, 0, sizeof *moments);
    moments->force_mps2 = mean;
    sum_up(motion, window, &span, mean, moments);
    moments->device_rad = motion->slots[place_of(span.end - 1u)].facing.device_rad;
    moments->facing_rad = span.facing_rad;
    moments->turned_rad =
        insole_wrap_pi(turned_at(motion, span.end - 1u) - turned_at(motion, span.first));
    return INSOLE_OK;
}
