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
static const insole_real_t LARGEST = INSOLE_R(1000.0); /* m/s^2 or rad/s */
static const insole_real_t SHORTEST_UP = INSOLE_R(1.0e-6), LONGEST_UP = INSOLE_R(1.0e6);
static const insole_real_t LEAST_CUBE = INSOLE_R(0.01);     /* (m/s^2)^3: noise has no skewness */
static const insole_real_t LEAST_POWER = INSOLE_R(0.0025);  /* (m/s^2)^2: nor is it like itself */
static const insole_real_t LEAST_TURN = INSOLE_R(1.0e-4);   /* (rad/s)^2 */
static const insole_real_t LEAST_MOVED = INSOLE_R(0.05);    /* (m/s^2)^2: and no wave */
static const insole_real_t LEAST_TURNED = INSOLE_R(1.0e-3); /* (rad/s)^2 */
static const insole_real_t LEAST_RISE = INSOLE_R(1.0e-3);   /* (m/s)^2, of all blocks together */

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

static void add_to_block(insole_vec3_t *blocks, uint32_t number, insole_vec3_t value)
{
    insole_vec3_t *block = &blocks[number / INSOLE_CARRY_BLOCK];
    *block = number % INSOLE_CARRY_BLOCK == 0u ? value : insole_vec3_add(*block, value);
}

static void take_point(insole_carry_window_t *w, const insole_carry_point_t *point,
                       const insole_vec3_t *up)
{
    insole_vec3_t accel = point->accel;
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
    add_to_block(half->accel, w->count, accel);
    add_to_block(half->gyro, w->count, point->gyro);
    half->has_gyro = point->has_gyro && (w->count == 0u || half->has_gyro);
    if (++w->count == INSOLE_CARRY_HALF) {
        turn_over(w);
    }
}

static void begin(insole_carry_window_t *w, uint64_t t_us, const insole_carry_point_t *sample,
                  const insole_vec3_t *up)
{
    w->has_time = true;
    w->is_new = false;
    w->count = w->points = w->full = 0u;
    w->gravity = insole_vec3_zero();
    w->grid_us = t_us;
    take_point(w, sample, up);
}

/* Grid points up to the new sample, on the line from the last sample to it. */
static void fill_grid(insole_carry_window_t *w, uint64_t t_us, const insole_carry_point_t *sample,
                      const insole_vec3_t *up)
{
    insole_real_t per_us = ONE / (insole_real_t)(uint32_t)(t_us - w->t_us);
    insole_vec3_t way = insole_vec3_sub(w->newest.accel, sample->accel);
    insole_vec3_t turn = insole_vec3_sub(w->newest.gyro, sample->gyro);
    while (t_us - w->grid_us >= INSOLE_CARRY_GRID_US) {
        w->grid_us += INSOLE_CARRY_GRID_US;
        insole_real_t back = (insole_real_t)(uint32_t)(t_us - w->grid_us) * per_us;
        insole_carry_point_t point = {insole_vec3_add_scaled(sample->accel, back, way),
                                      insole_vec3_add_scaled(sample->gyro, back, turn),
                                      sample->has_gyro && w->newest.has_gyro};
        take_point(w, &point, up);
    }
}

static bool is_up(const insole_vec3_t *up)
{
    insole_real_t size = insole_vec3_max_abs(*up);
    return insole_vec3_is_finite(*up) && size >= SHORTEST_UP && size <= LONGEST_UP;
}

static bool is_felt(insole_vec3_t v)
{
    return insole_vec3_is_finite(v) && insole_vec3_max_abs(v) <= LARGEST;
}

insole_status_t insole_carry_window_push(insole_carry_window_t *window, uint64_t t_us,
                                         insole_vec3_t accel_mps2, const insole_vec3_t *gyro_radps,
                                         const insole_vec3_t *up)
{
    if (!window) {
        return INSOLE_ERR_NULL;
    }
    if (!is_felt(accel_mps2) || (gyro_radps && !is_felt(*gyro_radps)) || (up && !is_up(up))) {
        window->refused++;
        return INSOLE_ERR_VALUE;
    }
    if (window->has_time && t_us <= window->t_us) {
        window->refused++;
        return INSOLE_ERR_TIME;
    }
    insole_carry_point_t sample = {accel_mps2, gyro_radps ? *gyro_radps : insole_vec3_zero(),
                                   gyro_radps != NULL};
    if (!window->has_time || t_us - window->t_us > INSOLE_CARRY_GAP_US) {
        begin(window, t_us, &sample, up);
    } else {
        fill_grid(window, t_us, &sample, up);
    }
    window->t_us = t_us;
    window->newest = sample;
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

static void describe(const insole_real_t *a, const insole_real_t *b, insole_real_t *statistics,
                     insole_real_t *skewness)
{
    enum { LAST = INSOLE_CARRY_HALF - 1 };
    insole_real_t middle = ZERO, squares = ZERO, cubes = ZERO;
    for (uint32_t i = 0u; i < INSOLE_CARRY_HALF; i++) {
        middle += a[i] + b[i];
    }
    middle /= (insole_real_t)WINDOW;
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

/* The three series. */
static void describe_all(const insole_carry_half_t *a, const insole_carry_half_t *b,
                         insole_real_t *value)
{
    for (size_t k = 0u; k < INSOLE_CARRY_SERIES; k++) {
        describe(a->sorted[k], b->sorted[k], &value[k * INSOLE_CARRY_STATISTICS],
                 &value[INSOLE_CARRY_SKEWNESS + k]);
    }
}

/* ---- features of motion ----------------------------------------------------------------- */

/* Mean of each block without the mean of the window. @return the mean of the window */
static insole_vec3_t lay_out(const insole_vec3_t *a, const insole_vec3_t *b, insole_vec3_t *blocks)
{
    insole_vec3_t mean = insole_vec3_zero();
    for (uint32_t i = 0u; i < BLOCKS; i++) {
        insole_vec3_t sum = i < INSOLE_CARRY_BLOCKS ? a[i] : b[i - INSOLE_CARRY_BLOCKS];
        blocks[i] = insole_vec3_scale(sum, ONE / (insole_real_t)INSOLE_CARRY_BLOCK);
        mean = insole_vec3_add_scaled(mean, ONE / (insole_real_t)BLOCKS, blocks[i]);
    }
    for (uint32_t i = 0u; i < BLOCKS; i++) {
        blocks[i] = insole_vec3_sub(blocks[i], mean);
    }
    return mean;
}

/* 2 sum ab / sum (a^2 + b^2) of what is `lag` blocks apart. @param power  of each block */
static insole_real_t likeness_at(const insole_vec3_t *blocks, const insole_real_t *power,
                                 uint32_t lag)
{
    insole_real_t product = ZERO, sum = ZERO;
    for (uint32_t i = lag; i < BLOCKS; i++) {
        product += insole_vec3_dot(blocks[i], blocks[i - lag]);
        sum += power[i] + power[i - lag];
    }
    return INSOLE_R(2.0) * product / sum;
}

/* @param least  power that blocks have at least, so that noise is not like itself */
static void liken(const insole_vec3_t *blocks, insole_real_t least, insole_real_t *step,
                  insole_real_t *stride)
{
    insole_real_t power[BLOCKS];
    for (uint32_t i = 0u; i < BLOCKS; i++) {
        power[i] = insole_vec3_norm2(blocks[i]) + INSOLE_R(0.5) * least;
    }
    *step = -ONE;
    for (uint32_t lag = STEP_FROM; lag <= STEP_TO; lag++) {
        *step = insole_max(*step, likeness_at(blocks, power, lag));
    }
    if (stride) {
        *stride = -ONE;
        for (uint32_t lag = STRIDE_FROM; lag <= STRIDE_TO; lag++) {
            *stride = insole_max(*stride, likeness_at(blocks, power, lag));
        }
    }
}

/* Squares of a motion, and what of them is along `up` and across it. */
typedef struct {
    insole_sym3_t squares;
    insole_vec3_t of_up;
    insole_real_t along, across;
} power_t;

static power_t power_of(const insole_vec3_t *blocks, insole_vec3_t up)
{
    power_t power = {.squares = insole_sym3_zero()};
    insole_sym3_t *S = &power.squares;
    for (uint32_t i = 0u; i < BLOCKS; i++) {
        *S = insole_sym3_add_outer(*S, ONE / (insole_real_t)BLOCKS, blocks[i]);
    }
    power.of_up = insole_sym3_mul_vec(*S, up);
    power.along = insole_max(insole_vec3_dot(up, power.of_up), ZERO);
    power.across = insole_max(S->xx + S->yy + S->zz - power.along, ZERO);
    return power;
}

/* How the phone goes up and down. */
typedef struct {
    insole_vec3_t up;             /* of unit length */
    insole_real_t power;          /* of the upright acceleration */
    insole_real_t speed[BLOCKS];  /* upwards in the middle of each block, less a line [m/s] */
    insole_real_t speeds_squared; /* sum */
} rise_t;

/* Less the line that fits best: an error of the mean adds up to one. */
static void integrate(const insole_vec3_t *blocks, rise_t *rise)
{
    static const insole_real_t HALF_BLOCK_S = INSOLE_R(0.05), MIDDLE = INSOLE_R(9.5);
    static const insole_real_t SQUARES = INSOLE_R(665.0); /* of all numbers less the middle */
    insole_real_t speed = ZERO, mean = ZERO, slope = ZERO;
    for (uint32_t i = 0u; i < BLOCKS; i++) {
        insole_real_t gained = HALF_BLOCK_S * insole_vec3_dot(blocks[i], rise->up);
        rise->speed[i] = speed + gained;
        speed += gained + gained;
        mean += rise->speed[i] / (insole_real_t)BLOCKS;
        slope += rise->speed[i] * ((insole_real_t)i - MIDDLE) / SQUARES;
    }
    rise->speeds_squared = ZERO;
    for (uint32_t i = 0u; i < BLOCKS; i++) {
        rise->speed[i] -= mean + slope * ((insole_real_t)i - MIDDLE);
        rise->speeds_squared += rise->speed[i] * rise->speed[i];
    }
}

static void describe_accel(const insole_carry_half_t *a, const insole_carry_half_t *b,
                           insole_real_t *value, rise_t *rise)
{
    insole_vec3_t blocks[BLOCKS], mean = lay_out(a->accel, b->accel, blocks);
    insole_real_t norm = insole_vec3_norm(mean);
    rise->up = insole_vec3_scale(mean, norm > ZERO ? ONE / norm : ZERO);
    power_t moved = power_of(blocks, rise->up);
    insole_vec3_t both = insole_vec3_add_scaled(moved.of_up, -moved.along, rise->up);
    liken(blocks, LEAST_POWER, &value[INSOLE_CARRY_STEP_LIKENESS],
          &value[INSOLE_CARRY_STRIDE_LIKENESS]);
    value[INSOLE_CARRY_TOGETHER] =
        insole_vec3_norm2(both) / (moved.along * moved.across + LEAST_CUBE);
    rise->power = moved.along;
    integrate(blocks, rise);
}

/* ((p - q) / (p + q))^2 of the powers about the two level axes in which p is most and q least. */
static insole_real_t line_of(const power_t *turned)
{
    const insole_sym3_t *S = &turned->squares;
    insole_real_t cross = S->xy * S->xy + S->xz * S->xz + S->yz * S->yz;
    insole_real_t all = S->xx * S->xx + S->yy * S->yy + S->zz * S->zz + INSOLE_R(2.0) * cross;
    insole_real_t level = all - INSOLE_R(2.0) * insole_vec3_norm2(turned->of_up) +
                          turned->along * turned->along; /* p^2 + q^2 */
    insole_real_t square = turned->across * turned->across;
    return insole_max(INSOLE_R(2.0) * level - square, ZERO) / (square + INSOLE_R(1.0e-6));
}

/* A forearm that swings along with the steps turns by so much for each metre of rise. */
static void keep_time(const insole_vec3_t *turns, const rise_t *rise, insole_real_t *value)
{
    insole_vec3_t product = insole_vec3_zero();
    insole_real_t power = ZERO;
    for (uint32_t i = 0u; i < BLOCKS; i++) {
        product = insole_vec3_add_scaled(product, rise->speed[i], turns[i]);
        power += insole_vec3_norm2(turns[i]);
    }
    value[INSOLE_CARRY_TURN_GAIN] = insole_vec3_norm(product) / (rise->speeds_squared + LEAST_RISE);
    value[INSOLE_CARRY_TURN_IN_TIME] =
        insole_vec3_norm2(product) / (rise->speeds_squared * power + LEAST_TURN);
}

static void describe_turns(const insole_carry_half_t *a, const insole_carry_half_t *b,
                           const rise_t *rise, insole_real_t *value)
{
    insole_vec3_t blocks[BLOCKS];
    (void)lay_out(a->gyro, b->gyro, blocks);
    power_t turned = power_of(blocks, rise->up);
    value[INSOLE_CARRY_TURN] = turned.across;
    value[INSOLE_CARRY_TURN_UPRIGHT] = turned.along / (turned.across + LEAST_TURNED);
    value[INSOLE_CARRY_TURN_PER_RISE] = turned.across / (rise->power + LEAST_MOVED);
    value[INSOLE_CARRY_TURN_LINE] = line_of(&turned);
    for (uint32_t i = 0u; i < BLOCKS; i++) {
        insole_real_t along = insole_vec3_dot(blocks[i], rise->up);
        blocks[i] = insole_vec3_add_scaled(blocks[i], -along, rise->up);
    }
    liken(blocks, LEAST_TURN, &value[INSOLE_CARRY_TURN_LIKENESS], NULL);
    keep_time(blocks, rise, value);
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
    const insole_carry_half_t *a = full_half(window, 2u), *b = full_half(window, 1u);
    rise_t rise;
    memset(features, 0, sizeof *features);
    describe_all(a, b, features->value);
    describe_accel(a, b, features->value, &rise);
    features->has_gyro = a->has_gyro && b->has_gyro;
    if (features->has_gyro) {
        describe_turns(a, b, &rise, features->value);
    }
    features->t_us = window->grid_us - (uint64_t)window->count * INSOLE_CARRY_GRID_US;
    window->is_new = false;
    return INSOLE_OK;
}
