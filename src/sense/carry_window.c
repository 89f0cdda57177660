/* SPDX-License-Identifier: MIT */
#include "insole/sense/carry_window.h"

#include <string.h>

#define ZERO INSOLE_R(0.0)
#define ONE  INSOLE_R(1.0)

enum {
    HALVES = 3,
    WINDOW = 2 * INSOLE_CARRY_HALF,
    BLOCKS = 2 * INSOLE_CARRY_BLOCKS,
    STEP_FROM = 4, /* blocks */
    STEP_TO = 7,
    STRIDE_FROM = 8,
    STRIDE_TO = 13
};

static const insole_real_t GRID_S = INSOLE_R(0.02);
static const insole_real_t LARGEST_MPS2 = INSOLE_R(1000.0);
static const insole_real_t SHORTEST_UP = INSOLE_R(1.0e-6), LONGEST_UP = INSOLE_R(1.0e6);
static const insole_real_t LEAST_CUBE = INSOLE_R(0.01);    /* (m/s^2)^3: noise has no skewness */
static const insole_real_t LEAST_POWER = INSOLE_R(0.0025); /* (m/s^2)^2: nor is it like itself */

insole_status_t insole_carry_window_init(insole_carry_window_t *window, insole_real_t gravity_s)
{
    if (!window) {
        return INSOLE_ERR_NULL;
    }
    if (!(gravity_s >= INSOLE_R(0.05) && gravity_s <= INSOLE_R(100.0))) {
        return INSOLE_ERR_VALUE;
    }
    memset(window, 0, sizeof *window);
    window->gravity_s = gravity_s;
    return INSOLE_OK;
}

/* ---- samples ---------------------------------------------------------------------------- */

static void insert(insole_real_t *sorted, uint32_t count, insole_real_t value)
{
    uint32_t at = count;
    for (; at > 0u && sorted[at - 1u] > value; at--) {
        sorted[at] = sorted[at - 1u];
    }
    sorted[at] = value;
}

/* The half is full: the oldest of the three is filled next. */
static void turn_over(insole_carry_window_t *w)
{
    w->count = 0u;
    w->filling = (w->filling + 1u) % HALVES;
    w->full = w->full < 2u ? w->full + 1u : 2u;
    w->is_new = w->full == 2u;
}

/* In its first seconds the low-pass is a mean. */
static void find_gravity(insole_carry_window_t *w, insole_vec3_t accel)
{
    w->points += w->points < UINT32_MAX ? 1u : 0u;
    insole_real_t gain = GRID_S / (GRID_S + w->gravity_s);
    gain = insole_max(gain, ONE / (insole_real_t)w->points);
    insole_vec3_t off = insole_vec3_sub(accel, w->gravity);
    w->gravity = insole_vec3_add_scaled(w->gravity, gain, off);
}

static void take_point(insole_carry_window_t *w, insole_vec3_t accel, const insole_vec3_t *up)
{
    find_gravity(w, accel);
    insole_vec3_t g = up ? *up : w->gravity;
    insole_real_t norm = insole_vec3_norm(g);
    insole_vec3_t n = norm > ZERO ? insole_vec3_scale(g, ONE / norm) : insole_vec3_zero();
    insole_real_t along = insole_vec3_dot(accel, n);
    insole_vec3_t level = insole_vec3_add_scaled(accel, -along, n);
    insole_carry_half_t *half = &w->halves[w->filling];
    insert(half->sorted[INSOLE_CARRY_MACC], w->count, insole_vec3_norm(accel)); /* [PhoneUKF (1)] */
    insert(half->sorted[INSOLE_CARRY_HACC], w->count, insole_vec3_norm(level)); /* [PhoneUKF (2)] */
    insert(half->sorted[INSOLE_CARRY_GACC], w->count, insole_abs(along));       /* [PhoneUKF (3)] */
    insole_vec3_t *block = &half->blocks[w->count / INSOLE_CARRY_BLOCK];
    bool is_first = w->count % INSOLE_CARRY_BLOCK == 0u;
    *block = is_first ? accel : insole_vec3_add(*block, accel);
    if (++w->count == INSOLE_CARRY_HALF) {
        turn_over(w);
    }
}

static void begin(insole_carry_window_t *w, uint64_t t_us, insole_vec3_t accel,
                  const insole_vec3_t *up)
{
    w->has_time = true;
    w->is_new = false;
    w->count = w->points = w->full = 0u;
    w->gravity = insole_vec3_zero();
    w->grid_us = t_us;
    take_point(w, accel, up);
}

/* Grid points up to the new sample, on the line from the last sample to it. */
static void fill_grid(insole_carry_window_t *w, uint64_t t_us, insole_vec3_t accel,
                      const insole_vec3_t *up)
{
    insole_real_t per_us = ONE / (insole_real_t)(t_us - w->t_us);
    while (t_us - w->grid_us >= INSOLE_CARRY_GRID_US) {
        w->grid_us += INSOLE_CARRY_GRID_US;
        insole_real_t back = (insole_real_t)(t_us - w->grid_us) * per_us;
        insole_vec3_t way = insole_vec3_sub(w->newest, accel);
        take_point(w, insole_vec3_add_scaled(accel, back, way), up);
    }
}

static bool is_up(const insole_vec3_t *up)
{
    insole_real_t size = insole_vec3_max_abs(*up);
    return insole_vec3_is_finite(*up) && size >= SHORTEST_UP && size <= LONGEST_UP;
}

insole_status_t insole_carry_window_push(insole_carry_window_t *window, uint64_t t_us,
                                         insole_vec3_t accel_mps2, const insole_vec3_t *up)
{
    if (!window) {
        return INSOLE_ERR_NULL;
    }
    if (!insole_vec3_is_finite(accel_mps2) || insole_vec3_max_abs(accel_mps2) > LARGEST_MPS2 ||
        (up && !is_up(up))) {
        window->refused++;
        return INSOLE_ERR_VALUE;
    }
    if (window->has_time && t_us <= window->t_us) {
        window->refused++;
        return INSOLE_ERR_TIME;
    }
    if (!window->has_time || t_us - window->t_us > INSOLE_CARRY_GAP_US) {
        begin(window, t_us, accel_mps2, up);
    } else {
        fill_grid(window, t_us, accel_mps2, up);
    }
    window->t_us = t_us;
    window->newest = accel_mps2;
    return INSOLE_OK;
}

/* ---- features --------------------------------------------------------------------------- */

/* `back` = 1 is the newer of the two full halves. */
static const insole_carry_half_t *full_half(const insole_carry_window_t *w, uint32_t back)
{
    return &w->halves[(w->filling + HALVES - back) % HALVES];
}

/* Mean of the two in the middle of both halves together. */
static insole_real_t median(const insole_real_t *a, const insole_real_t *b)
{
    insole_real_t before = ZERO, value = ZERO;
    for (uint32_t taken = 0u, i = 0u; taken <= INSOLE_CARRY_HALF; taken++) {
        uint32_t j = taken - i;
        bool is_from_a = j == INSOLE_CARRY_HALF || (i < INSOLE_CARRY_HALF && a[i] <= b[j]);
        before = value;
        value = is_from_a ? a[i++] : b[j];
    }
    return INSOLE_R(0.5) * (before + value);
}

static insole_real_t mean(const insole_real_t *a, const insole_real_t *b)
{
    insole_real_t sum = ZERO;
    for (uint32_t i = 0u; i < INSOLE_CARRY_HALF; i++) {
        sum += a[i] + b[i];
    }
    return sum / (insole_real_t)WINDOW;
}

static void describe(const insole_real_t *a, const insole_real_t *b, insole_real_t *statistics,
                     insole_real_t *skewness)
{
    enum { LAST = INSOLE_CARRY_HALF - 1 };
    insole_real_t middle = mean(a, b), squares = ZERO, cubes = ZERO;
    for (uint32_t i = 0u; i < INSOLE_CARRY_HALF; i++) {
        insole_real_t p = a[i] - middle, q = b[i] - middle;
        squares += p * p + q * q;
        cubes += p * p * p + q * q * q;
    }
    insole_real_t variance = squares / (insole_real_t)WINDOW;
    statistics[INSOLE_CARRY_VARIANCE] = variance;
    statistics[INSOLE_CARRY_MEAN] = middle;
    statistics[INSOLE_CARRY_MEDIAN] = median(a, b);
    statistics[INSOLE_CARRY_MAXIMUM] = insole_max(a[LAST], b[LAST]);
    statistics[INSOLE_CARRY_MINIMUM] = insole_min(a[0], b[0]);
    insole_real_t scale = variance * insole_sqrt(variance) + LEAST_CUBE;
    *skewness = cubes / (insole_real_t)WINDOW / scale;
}

/* Mean acceleration of each block, without the mean of the window. */
static void lay_out(const insole_carry_window_t *w, insole_vec3_t *blocks)
{
    insole_vec3_t sum = insole_vec3_zero();
    for (uint32_t i = 0u; i < BLOCKS; i++) {
        const insole_carry_half_t *half = full_half(w, i < INSOLE_CARRY_BLOCKS ? 2u : 1u);
        insole_vec3_t block = half->blocks[i % INSOLE_CARRY_BLOCKS];
        blocks[i] = insole_vec3_scale(block, ONE / (insole_real_t)INSOLE_CARRY_BLOCK);
        sum = insole_vec3_add(sum, blocks[i]);
    }
    for (uint32_t i = 0u; i < BLOCKS; i++) {
        blocks[i] = insole_vec3_add_scaled(blocks[i], -ONE / (insole_real_t)BLOCKS, sum);
    }
}

/* 2 sum ab / sum (a^2 + b^2) of what is `lag` blocks apart. */
static insole_real_t likeness_at(const insole_vec3_t *blocks, uint32_t lag)
{
    insole_real_t product = ZERO, power = LEAST_POWER * (insole_real_t)(BLOCKS - lag);
    for (uint32_t i = lag; i < BLOCKS; i++) {
        product += insole_vec3_dot(blocks[i], blocks[i - lag]);
        power += insole_vec3_norm2(blocks[i]) + insole_vec3_norm2(blocks[i - lag]);
    }
    return INSOLE_R(2.0) * product / power;
}

static insole_real_t likeness(const insole_vec3_t *blocks, uint32_t from, uint32_t to)
{
    insole_real_t best = -ONE;
    for (uint32_t lag = from; lag <= to; lag++) {
        best = insole_max(best, likeness_at(blocks, lag));
    }
    return best;
}

insole_status_t insole_carry_window_next(insole_carry_window_t *window,
                                         insole_carry_features_t *features)
{
    if (!window || !features) {
        return INSOLE_ERR_NULL;
    }
    if (!window->is_new) {
        return INSOLE_ERR_STATE;
    }
    insole_vec3_t blocks[BLOCKS];
    insole_real_t *value = features->value;
    for (size_t k = 0u; k < INSOLE_CARRY_SERIES; k++) {
        describe(full_half(window, 2u)->sorted[k], full_half(window, 1u)->sorted[k],
                 &value[k * INSOLE_CARRY_STATISTICS], &value[INSOLE_CARRY_SKEWNESS + k]);
    }
    lay_out(window, blocks);
    value[INSOLE_CARRY_STEP_LIKENESS] = likeness(blocks, STEP_FROM, STEP_TO);
    value[INSOLE_CARRY_STRIDE_LIKENESS] = likeness(blocks, STRIDE_FROM, STRIDE_TO);
    features->t_us = window->grid_us - (uint64_t)window->count * INSOLE_CARRY_GRID_US;
    window->is_new = false;
    return INSOLE_OK;
}
