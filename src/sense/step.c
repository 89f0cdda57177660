/* SPDX-License-Identifier: MIT */
#include "insole/sense/step.h"

#include <string.h>

#define ZERO INSOLE_R(0.0)
#define ONE  INSOLE_R(1.0)

const insole_step_config_t insole_step_defaults = {INSOLE_STEP_KEYS(INSOLE_CONFIG_DEFAULT)};

static const insole_real_t GRAVITY_MPS2 = INSOLE_R(9.81); /* keeps sums small, no more */
static const insole_real_t LARGEST_MPS2 = INSOLE_R(1000.0);
static const insole_real_t FIRST_INTERVAL_S = INSOLE_R(0.5);
static const insole_real_t HABIT_WEIGHT = INSOLE_R(0.15);
static const insole_real_t MISSED_ONE = INSOLE_R(1.5); /* usual intervals: a step is missing */
static const uint64_t LONGEST_GAP_US = 250000u;

enum { MOST_WAITING = INSOLE_STEP_RING - INSOLE_STEP_HELD - 1 /* a push may find one more */ };

static void clear_span(insole_step_span_t *span)
{
    static const insole_step_span_t nothing = {ZERO, ZERO, INSOLE_REAL_MAX, -INSOLE_REAL_MAX, 0u};
    *span = nothing;
}

insole_status_t insole_step_check(const insole_step_config_t *config)
{
    typedef insole_step_config_t config_t;
    static const insole_config_range_t ranges[] = {INSOLE_STEP_KEYS(INSOLE_CONFIG_RANGE)};
    return insole_config_check(config, ranges, sizeof ranges / sizeof ranges[0]);
}

INSOLE_COLD insole_status_t insole_step_init(insole_step_counter_t *counter,
                                             const insole_step_config_t *config)
{
    if (!counter || !config) {
        return INSOLE_ERR_NULL;
    }
    if (insole_step_check(config) != INSOLE_OK) {
        return INSOLE_ERR_VALUE;
    }
    memset(counter, 0, sizeof *counter);
    counter->config = *config;
    counter->ring = insole_ring(INSOLE_STEP_RING);
    counter->usual_interval_s = FIRST_INTERVAL_S;
    return insole_rhythm_init(&counter->rhythm);
}

/* ---- spans ------------------------------------------------------------------------------ */

static void widen(insole_step_span_t *span, insole_real_t length_mps2, insole_real_t smooth_mps2)
{
    insole_real_t off = length_mps2 - GRAVITY_MPS2;
    span->sum += off;
    span->sum_of_squares += off * off;
    span->min_mps2 = insole_min(span->min_mps2, smooth_mps2);
    span->max_mps2 = insole_max(span->max_mps2, smooth_mps2);
    span->count++;
}

static insole_step_span_t join(insole_step_span_t a, insole_step_span_t b)
{
    insole_step_span_t both = {a.sum + b.sum, a.sum_of_squares + b.sum_of_squares,
                               insole_min(a.min_mps2, b.min_mps2),
                               insole_max(a.max_mps2, b.max_mps2), a.count + b.count};
    return both;
}

static insole_real_t scatter(const insole_step_span_t *span)
{
    insole_real_t n = (insole_real_t)span->count, mean = span->sum / n;
    return insole_sqrt(insole_max(span->sum_of_squares / n - mean * mean, ZERO));
}

/* ---- steps: told, or held back ---------------------------------------------------------- */

/* `back` = 1 is the newest. */
static insole_footfall_t *newest_footfall(insole_step_counter_t *c, uint32_t back)
{
    return &c->footfalls[insole_ring_slot(&c->ring, c->ring.end - back)];
}

/* It has no step before it: it lasts as long as the one after it. */
static void borrow(insole_footfall_t *first, const insole_footfall_t *second)
{
    uint64_t lasted_us = second->end_us - second->begin_us;
    first->begin_us = first->end_us > lasted_us ? first->end_us - lasted_us : 0u;
    first->range_mps2 = second->range_mps2;
    first->accel_sigma_mps2 = second->accel_sigma_mps2;
}

static void drop_held(insole_step_counter_t *c)
{
    c->ring.end -= c->held;
    c->held = 0u;
}

static void drop_oldest_held(insole_step_counter_t *c)
{
    for (uint32_t back = c->held; back > 1u; back--) {
        *newest_footfall(c, back) = *newest_footfall(c, back - 1u);
    }
    c->ring.end--;
    c->held--;
}

static void hold(insole_step_counter_t *c)
{
    if (c->held == INSOLE_STEP_HELD) {
        drop_oldest_held(c);
    }
    insole_footfall_t *f = &c->footfalls[insole_ring_push(&c->ring)];
    f->begin_us = c->last_us;
    f->end_us = c->peak.t_us;
    f->peak_mps2 = c->peak.height_mps2;
    f->range_mps2 = c->peak.span.max_mps2 - c->peak.span.min_mps2;
    f->accel_sigma_mps2 = scatter(&c->peak.span);
    c->held++;
}

static void tell_held(insole_step_counter_t *c)
{
    c->count += c->held;
    c->held = 0u;
}

static void learn(insole_step_counter_t *c)
{
    const insole_footfall_t *f = newest_footfall(c, 1u);
    insole_real_t interval_s = insole_seconds(f->begin_us, f->end_us);
    if (interval_s < MISSED_ONE * c->usual_interval_s) {
        c->usual_interval_s += HABIT_WEIGHT * (interval_s - c->usual_interval_s);
    }
    c->usual_range_mps2 += HABIT_WEIGHT * (f->range_mps2 - c->usual_range_mps2);
}

/* The first of the held steps borrows from the second; the walker is known from all others. */
static void begin_walk(insole_step_counter_t *c)
{
    borrow(newest_footfall(c, c->held), newest_footfall(c, c->held - 1u));
    insole_real_t shortest_s = c->config.max_interval_s, sum_mps2 = ZERO;
    for (uint32_t back = 1u; back < c->held; back++) {
        const insole_footfall_t *f = newest_footfall(c, back);
        shortest_s = insole_min(shortest_s, insole_seconds(f->begin_us, f->end_us));
        sum_mps2 += f->range_mps2;
    }
    c->usual_interval_s = shortest_s; /* errs on the side that a step is not swallowed */
    c->usual_range_mps2 = sum_mps2 / (insole_real_t)(c->held - 1u);
    c->walking = true;
}

static insole_real_t likeness_since(const insole_step_counter_t *c, uint64_t peak_us)
{
    insole_real_t likeness = -ONE;
    (void)insole_rhythm_likeness(&c->rhythm, c->peak.t_us - peak_us, &likeness);
    return likeness;
}

/* The peak can not be corrected any more: it is a step, if this is a walk. */
INSOLE_COLD static void close_peak(insole_step_counter_t *c)
{
    const insole_step_config_t *s = &c->config;
    insole_real_t likeness =
        insole_max(likeness_since(c, c->last_us), likeness_since(c, c->before_us));
    bool follows = c->has_last && insole_seconds(c->last_us, c->peak.t_us) <= s->max_interval_s;
    if (!follows) {
        drop_held(c);
    }
    c->alike = likeness >= s->start_likeness ? c->alike + 1u : 0u;
    c->walking = c->walking && follows && likeness >= s->keep_likeness;
    hold(c);
    if (c->walking) {
        learn(c);
    } else if (c->held >= (uint32_t)s->first_steps && c->alike >= (uint32_t)s->start_peaks) {
        begin_walk(c);
    }
    if (c->walking) {
        tell_held(c);
    }
    c->before_us = c->last_us;
    c->last_us = c->peak.t_us;
    c->has_last = true;
    c->has_peak = false;
}

/* ---- peaks ------------------------------------------------------------------------------ */

/* T_Th, two thirds of the walker's usual interval. */
static insole_real_t dead_s(const insole_step_counter_t *c)
{
    const insole_step_config_t *s = &c->config;
    insole_real_t share_s = insole_min(s->interval_share * c->usual_interval_s, s->max_dead_s);
    return insole_max(s->min_interval_s, share_s);
}

static bool is_high(const insole_step_counter_t *c)
{
    const insole_step_config_t *s = &c->config;
    insole_real_t rise = insole_max(s->min_rise_mps2, s->rise_share * c->usual_range_mps2);
    return c->newest >= s->min_height_mps2 && c->newest - c->trough >= rise;
}

/* The trough since the peak is one between two steps: deep under both. */
static bool is_deep(const insole_step_counter_t *c)
{
    const insole_step_config_t *s = &c->config;
    insole_real_t lower = insole_min(c->newest, c->peak.height_mps2) - c->trough;
    insole_real_t higher = insole_max(c->newest, c->peak.height_mps2) - c->trough;
    insole_real_t depth = s->deep_share * insole_max(higher, c->usual_range_mps2);
    return lower >= insole_max(s->min_rise_mps2, depth);
}

/* Too soon after the peak to be another step. */
static bool is_close(const insole_step_counter_t *c, uint64_t t_us)
{
    insole_real_t since_s = insole_seconds(c->peak.t_us, t_us);
    return since_s < c->config.min_interval_s || (since_s < dead_s(c) && !is_deep(c));
}

/* The newest value of the smoothed |a| is a local maximum. [PhoneEKF (2)] [PhoneUKF (5)] */
static void take_peak(insole_step_counter_t *c, uint64_t t_us)
{
    insole_step_peak_t peak = {t_us, c->newest, c->span};
    if (c->has_peak && is_close(c, t_us)) {
        if (c->config.rule == INSOLE_STEP_FIRST || c->newest <= c->peak.height_mps2) {
            return;
        }
        peak.span = join(c->peak.span, c->span);
    } else if (!is_high(c)) {
        return;
    } else if (c->has_peak) {
        close_peak(c);
    }
    c->peak = peak;
    c->has_peak = true;
    c->trough = c->newest;
    clear_span(&c->span);
}

/* ---- samples ---------------------------------------------------------------------------- */

/* What the walker is used to is kept. */
static void begin_anew(insole_step_counter_t *c, insole_real_t length_mps2)
{
    c->mean_mps2 = length_mps2;
    c->band = c->low = c->newest = c->older = c->trough = ZERO;
    c->has_peak = c->has_last = c->walking = false;
    clear_span(&c->span);
    drop_held(c);
    uint32_t refused = c->rhythm.refused;
    (void)insole_rhythm_init(&c->rhythm);
    c->rhythm.refused = refused;
}

/* High-pass of first order, then a Butterworth low-pass of second order with trapezoidal
 * integrators: stable for every interval. */
static insole_real_t smooth(insole_step_counter_t *c, insole_real_t length_mps2, insole_real_t dt_s)
{
    const insole_real_t sqrt2 = INSOLE_R(1.41421356);
    insole_real_t slow = INSOLE_R(2.0) * INSOLE_PI * c->config.high_pass_hz * dt_s;
    c->mean_mps2 += slow / (ONE + slow) * (length_mps2 - c->mean_mps2);
    insole_real_t g = INSOLE_PI * c->config.low_pass_hz * dt_s;
    insole_real_t high =
        (length_mps2 - c->mean_mps2 - (sqrt2 + g) * c->band - c->low) / (ONE + g * (sqrt2 + g));
    insole_real_t band = c->band + g * high;
    insole_real_t low = c->low + g * band;
    c->band = band + g * high;
    c->low = low + g * band;
    return low;
}

static void take(insole_step_counter_t *c, uint64_t t_us, insole_real_t length_mps2)
{
    insole_real_t dt_s = insole_seconds(c->t_us, t_us);
    insole_real_t value = smooth(c, length_mps2, dt_s);
    if (c->newest > c->older && c->newest >= value) {
        take_peak(c, c->t_us);
    }
    (void)insole_rhythm_push(&c->rhythm, t_us, value);
    widen(&c->span, length_mps2, value);
    c->trough = insole_min(c->trough, value);
    c->older = c->newest;
    c->newest = value;
    if (c->has_peak && insole_seconds(c->peak.t_us, t_us) >= dead_s(c)) {
        close_peak(c);
    }
    if (!c->has_last || insole_seconds(c->last_us, t_us) > c->config.max_interval_s) {
        c->usual_range_mps2 -= c->usual_range_mps2 * dt_s / (c->config.forget_s + dt_s);
    }
}

insole_status_t insole_step_push(insole_step_counter_t *counter, uint64_t t_us, insole_vec3_t a)
{
    if (!counter) {
        return INSOLE_ERR_NULL;
    }
    insole_status_t status = INSOLE_OK;
    insole_real_t length_mps2 = insole_vec3_norm(a);
    if (!(length_mps2 <= LARGEST_MPS2)) {
        status = INSOLE_ERR_VALUE;
    } else if (counter->has_time && t_us <= counter->t_us) {
        status = INSOLE_ERR_TIME;
    } else if (insole_ring_count(&counter->ring) - counter->held > MOST_WAITING) {
        status = INSOLE_ERR_ROOM;
    }
    if (status != INSOLE_OK) {
        counter->refused++;
        return status;
    }
    if (!counter->has_time || t_us - counter->t_us > LONGEST_GAP_US) {
        begin_anew(counter, length_mps2);
    } else {
        take(counter, t_us, length_mps2);
    }
    counter->t_us = t_us;
    counter->has_time = true;
    return INSOLE_OK;
}

insole_status_t insole_step_next(insole_step_counter_t *counter, insole_footfall_t *footfall)
{
    if (!counter || !footfall) {
        return INSOLE_ERR_NULL;
    }
    if (insole_ring_count(&counter->ring) == counter->held) {
        return INSOLE_ERR_STATE;
    }
    *footfall = counter->footfalls[insole_ring_slot(&counter->ring, counter->ring.begin)];
    insole_ring_pop(&counter->ring);
    return INSOLE_OK;
}

INSOLE_COLD insole_status_t insole_step_held(const insole_step_counter_t *counter, uint32_t number,
                                             insole_footfall_t *footfall)
{
    if (!counter || !footfall) {
        return INSOLE_ERR_NULL;
    }
    if (number >= counter->held) {
        return INSOLE_ERR_STATE;
    }
    uint32_t at = counter->ring.end - counter->held + number;
    *footfall = counter->footfalls[insole_ring_slot(&counter->ring, at)];
    if (number == 0u && counter->held > 1u && !counter->walking) {
        borrow(footfall, &counter->footfalls[insole_ring_slot(&counter->ring, at + 1u)]);
    }
    return INSOLE_OK;
}
