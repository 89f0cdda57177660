/* SPDX-License-Identifier: MIT */
#include "insole/sense/zero_velocity.h"

#include <string.h>

#include "insole/base/fastmath.h"

#define ONE INSOLE_R(1.0)

enum {
    RATE_SAMPLES = 16, /* samples from which the window's length is found */
    LONGEST_HALF = INSOLE_STILL_WINDOW / 2,
    LABEL_STILL = 1,
    LABEL_PLAIN = 2
};

static const insole_real_t FIRST_PERIOD_S = INSOLE_R(1.0);
static const insole_real_t SHORTEST_PERIOD_S = INSOLE_R(0.3);
static const uint32_t SHORTEST_PERIOD_US = 300000u;
static const insole_real_t LONGEST_PERIOD_S = INSOLE_R(1.6);
static const insole_real_t HABIT_WEIGHT = INSOLE_R(0.25);
static const uint32_t LONGEST_INTERVAL_US = 50000u; /* of a rate that is worth measuring */

const insole_zero_velocity_config_t insole_zero_velocity_defaults = {
    INSOLE_ZERO_VELOCITY_KEYS(INSOLE_CONFIG_DEFAULT)};

insole_status_t insole_zero_velocity_check(const insole_zero_velocity_config_t *config)
{
    typedef insole_zero_velocity_config_t config_t;
    static const insole_config_range_t ranges[] = {INSOLE_ZERO_VELOCITY_KEYS(INSOLE_CONFIG_RANGE)};
    return insole_config_check(config, ranges, sizeof ranges / sizeof ranges[0]);
}

INSOLE_COLD insole_status_t insole_zero_velocity_init(insole_zero_velocity_t *zv,
                                                      const insole_zero_velocity_config_t *config)
{
    if (!zv || !config) {
        return INSOLE_ERR_NULL;
    }
    if (insole_zero_velocity_check(config) != INSOLE_OK) {
        return INSOLE_ERR_VALUE;
    }
    memset(zv, 0, sizeof *zv);
    zv->config = *config;
    zv->ring = insole_ring(INSOLE_STANCE_RING);
    zv->reach_us = insole_microseconds(config->reach_s);
    zv->spread_us = insole_microseconds(config->spread_s);
    zv->hole_us = insole_microseconds(config->two_step_hole_s);
    if (config->detector == INSOLE_DETECT_ADAPTIVE) {
        zv->ahead_us = zv->reach_us;
        zv->back_us = zv->spread_us;
    } else if (config->detector == INSOLE_DETECT_TWO_STEP) {
        zv->ahead_us = zv->hole_us;
    }
    const insole_real_t thresholds[] = {config->plain_threshold, ONE,
                                        config->shoe_threshold,  config->mv_threshold,
                                        config->mag_threshold,   config->are_threshold};
    zv->threshold = thresholds[config->detector];
    zv->period_s = FIRST_PERIOD_S;
    zv->usual_log = insole_log(config->plain_threshold);
    (void)insole_past_min_init(&zv->past, zv->reach_us);
    return INSOLE_OK;
}

/* As insole_ring_slot, with a capacity that the compiler knows. */
static insole_stance_slot_t *slot(insole_zero_velocity_t *zv, uint32_t number)
{
    return &zv->slots[number % INSOLE_STANCE_RING];
}

static insole_real_t seconds(uint32_t from_us, uint32_t to_us)
{
    return (insole_real_t)(to_us - from_us) * INSOLE_R(1.0e-6);
}

/* ---- the statistic ---------------------------------------------------------------------- */

/* Of each detector; the two-step logic needs none, but out it goes. */
static const insole_still_kind_t KIND[] = {INSOLE_STILL_SHOE, INSOLE_STILL_SHOE, INSOLE_STILL_SHOE,
                                           INSOLE_STILL_MV,   INSOLE_STILL_MAG,  INSOLE_STILL_ARE};

/* Half window from the mean interval of the first samples; gaps among them do not count. */
static uint32_t learn_half(insole_zero_velocity_t *zv)
{
    uint32_t sum_us = 0u, intervals = 0u;
    for (uint32_t i = 1u; i < insole_ring_count(&zv->ring); i++) {
        uint32_t number = zv->ring.begin + i;
        uint32_t dt_us = slot(zv, number)->t_us - slot(zv, number - 1u)->t_us;
        if (dt_us <= LONGEST_INTERVAL_US) {
            sum_us += dt_us;
            intervals++;
        }
    }
    insole_real_t half = ONE;
    if (intervals > 0u) {
        insole_real_t dt_s = (insole_real_t)sum_us * INSOLE_R(1.0e-6) / (insole_real_t)intervals;
        half = INSOLE_R(0.5) * zv->config.window_s / dt_s;
    }
    half = insole_min(insole_max(half, ONE), (insole_real_t)LONGEST_HALF);
    return (uint32_t)(half + INSOLE_R(0.001));
}

static void open_window(insole_zero_velocity_t *zv)
{
    const insole_zero_velocity_config_t *c = &zv->config;
    insole_still_scale_t scale = {KIND[c->detector], c->gravity_mps2, c->sigma_accel_mps2,
                                  c->sigma_gyro_radps};
    zv->half = learn_half(zv);
    (void)insole_still_window_init(&zv->window, &scale, 2u * zv->half + 1u);
}

/* The window opens once enough is there to tell the rate, or as much as there will ever be. The
 * first that is full serves the samples before its middle as well. */
INSOLE_COLD static void begin_measuring(insole_zero_velocity_t *zv)
{
    uint32_t number = zv->ring.end - 1u;
    if (zv->half == 0u) {
        if (insole_ring_count(&zv->ring) < RATE_SAMPLES && !zv->finished) {
            return;
        }
        open_window(zv);
        number = zv->ring.begin;
    }
    for (; number != zv->ring.end; number++) {
        const insole_stance_slot_t *s = slot(zv, number);
        insole_real_t statistic =
            insole_still_window_take(&zv->window, &s->accel_mps2, &s->gyro_radps);
        while (zv->window.full && zv->measured + zv->half != number + 1u) {
            slot(zv, zv->measured++)->statistic = statistic;
        }
    }
}

/* The window moves on by the newest sample. */
static void measure(insole_zero_velocity_t *zv, const insole_imu_t *newest)
{
    if (zv->window.full) {
        slot(zv, zv->measured++)->statistic =
            insole_still_window_take(&zv->window, &newest->accel_mps2, &newest->gyro_radps);
    } else {
        begin_measuring(zv);
    }
}

/* ---- the judgement ---------------------------------------------------------------------- */

static bool is_least_of_future(insole_zero_velocity_t *zv, uint32_t number)
{
    const insole_stance_slot_t *k = slot(zv, number);
    for (uint32_t i = number + 1u; i != zv->measured; i++) {
        const insole_stance_slot_t *later = slot(zv, i);
        if (later->t_us - k->t_us > zv->reach_us) {
            break;
        }
        if (later->statistic < k->statistic) {
            return false;
        }
    }
    return true;
}

/* A minimum early in the gait period and less still than usual is one of the swing. */
static bool is_in_swing(const insole_zero_velocity_t *zv, const insole_stance_slot_t *k)
{
    const insole_zero_velocity_config_t *c = &zv->config;
    return zv->has_stance && seconds(zv->last_stance_us, k->t_us) < c->early_share * zv->period_s &&
           insole_log(k->statistic) > zv->usual_log + c->early_log;
}

/* A minimum; of several that are equal the first. */
INSOLE_APART static bool is_guaranteed(insole_zero_velocity_t *zv, uint32_t number)
{
    const insole_stance_slot_t *k = slot(zv, number);
    bool falling = number == zv->ring.begin || k->statistic < slot(zv, number - 1u)->statistic;
    bool rising = number + 1u == zv->measured || k->statistic <= slot(zv, number + 1u)->statistic;
    return falling && rising && k->statistic <= insole_past_min(&zv->past) &&
           is_least_of_future(zv, number) && !is_in_swing(zv, k);
}

/* What is usual for this walker follows the stances that were found. */
INSOLE_APART static void note_stance(insole_zero_velocity_t *zv, uint32_t t_us,
                                     insole_real_t statistic)
{
    insole_real_t interval_s = seconds(zv->last_stance_us, t_us);
    if (zv->has_stance && interval_s >= SHORTEST_PERIOD_S && interval_s <= LONGEST_PERIOD_S) {
        zv->period_s += HABIT_WEIGHT * (interval_s - zv->period_s);
        zv->usual_log += HABIT_WEIGHT * (insole_log(statistic) - zv->usual_log);
    }
    zv->last_stance_us = t_us;
    zv->has_stance = true;
}

/* A still sample by threshold; the first after others is a stance of its own. */
INSOLE_APART static void note_plain(insole_zero_velocity_t *zv, insole_stance_slot_t *k)
{
    k->label = LABEL_STILL | LABEL_PLAIN;
    if (!zv->has_still || k->t_us - zv->last_still_us > SHORTEST_PERIOD_US) {
        note_stance(zv, k->t_us, zv->config.plain_threshold);
    }
    zv->last_still_us = k->t_us;
    zv->has_still = true;
}

static void label_if_below(insole_zero_velocity_t *zv, uint32_t number, insole_real_t limit)
{
    insole_stance_slot_t *s = slot(zv, number);
    if (s->statistic < limit) {
        s->label |= LABEL_STILL;
    }
}

/* The minimum and its neighbours, as far as they are nearly as still. */
INSOLE_APART static void spread(insole_zero_velocity_t *zv, uint32_t number)
{
    const insole_stance_slot_t *k = slot(zv, number);
    insole_real_t limit = zv->config.spread_factor * k->statistic;
    for (uint32_t i = number; i != zv->measured && slot(zv, i)->t_us - k->t_us <= zv->spread_us;
         i++) {
        label_if_below(zv, i, limit);
    }
    for (uint32_t i = number;
         i != zv->ring.begin && k->t_us - slot(zv, i - 1u)->t_us <= zv->spread_us; i--) {
        label_if_below(zv, i - 1u, limit);
    }
    zv->last_still_us = k->t_us;
    zv->has_still = true;
}

static void judge_adaptive(insole_zero_velocity_t *zv, uint32_t number)
{
    insole_stance_slot_t *k = slot(zv, number);
    if (k->statistic < zv->config.plain_threshold) {
        note_plain(zv, k);
    } else if (k->statistic < zv->config.guaranteed_threshold && is_guaranteed(zv, number)) {
        note_stance(zv, k->t_us, k->statistic);
        spread(zv, number);
    }
    insole_past_min_push(&zv->past, k->t_us, k->statistic);
}

/* The sample as such, in units of the two thresholds: still below 1. Step one of [TwoOrder] 4.3. */
static insole_real_t two_step_statistic(const insole_zero_velocity_config_t *c,
                                        const insole_stance_slot_t *s)
{
    insole_real_t accel = insole_abs(insole_vec3_norm(s->accel_mps2) - c->gravity_mps2);
    insole_real_t gyro = insole_vec3_norm(s->gyro_radps);
    return insole_max(accel / c->two_step_accel_mps2, gyro / c->two_step_gyro_radps);
}

/* Step two of [TwoOrder] 4.3: a moving sample whose stored neighbours on both sides are still. */
INSOLE_APART static void judge_two_step(insole_zero_velocity_t *zv, uint32_t number)
{
    insole_stance_slot_t *k = slot(zv, number);
    if (two_step_statistic(&zv->config, k) < ONE) {
        note_plain(zv, k);
        return;
    }
    for (uint32_t i = number + 1u; zv->has_still && i != zv->measured; i++) {
        const insole_stance_slot_t *later = slot(zv, i);
        if (later->t_us - zv->last_still_us > zv->hole_us) {
            return;
        }
        if (two_step_statistic(&zv->config, later) < ONE) {
            k->label = LABEL_STILL;
            return;
        }
    }
}

static void judge(insole_zero_velocity_t *zv, uint32_t number)
{
    insole_stance_slot_t *k = slot(zv, number);
    if (zv->config.detector == INSOLE_DETECT_ADAPTIVE) {
        judge_adaptive(zv, number);
    } else if (zv->config.detector == INSOLE_DETECT_TWO_STEP) {
        judge_two_step(zv, number);
    } else if (k->statistic < zv->threshold) {
        note_plain(zv, k);
    }
}

static void judge_seen(insole_zero_velocity_t *zv)
{
    while (zv->judged != zv->measured &&
           (uint32_t)zv->newest_us - slot(zv, zv->judged)->t_us >= zv->ahead_us) {
        judge(zv, zv->judged++);
    }
}

/* A label is certain when every sample whose judgement may reach back to it has been judged. */
static void release_labelled(insole_zero_velocity_t *zv)
{
    uint32_t judged_us = slot(zv, zv->judged)->t_us;
    while (zv->released != zv->judged && judged_us - slot(zv, zv->released)->t_us > zv->back_us) {
        zv->released++;
    }
}

INSOLE_COLD static void judge_next(insole_zero_velocity_t *zv)
{
    judge(zv, zv->judged++);
}

/* The oldest of a full line must do with what there is. */
INSOLE_COLD static void release_oldest(insole_zero_velocity_t *zv)
{
    if (zv->judged == zv->ring.begin && zv->judged != zv->measured) {
        judge_next(zv);
    }
    if (zv->released == zv->ring.begin && zv->released != zv->judged) {
        zv->released++;
    }
}

INSOLE_FLAT void insole_zero_velocity_take(insole_zero_velocity_t *zv, const insole_imu_t *imu,
                                           uint8_t tag)
{
    insole_stance_slot_t *s = slot(zv, zv->ring.end++);
    s->accel_mps2 = imu->accel_mps2;
    s->gyro_radps = imu->gyro_radps;
    s->t_us = (uint32_t)imu->t_us;
    s->high_us = (uint16_t)(imu->t_us >> 32);
    s->tag = tag;
    s->label = 0u;
    zv->newest_us = imu->t_us;
    measure(zv, imu);
    judge_seen(zv);
    release_labelled(zv);
    if (insole_zero_velocity_is_full(zv)) {
        release_oldest(zv);
    }
}

insole_status_t insole_zero_velocity_push(insole_zero_velocity_t *zv, const insole_imu_t *imu,
                                          uint8_t tag)
{
    if (!zv || !imu) {
        return INSOLE_ERR_NULL;
    }
    insole_status_t status = INSOLE_OK;
    if (zv->finished) {
        status = INSOLE_ERR_STATE;
    } else if (!insole_vec3_is_finite(imu->accel_mps2) || !insole_vec3_is_finite(imu->gyro_radps)) {
        status = INSOLE_ERR_VALUE;
    } else if (zv->ring.end != 0u && imu->t_us <= zv->newest_us) {
        status = INSOLE_ERR_TIME;
    } else if (insole_zero_velocity_is_full(zv)) {
        status = INSOLE_ERR_ROOM;
    }
    if (status != INSOLE_OK) {
        zv->refused++;
        return status;
    }
    insole_zero_velocity_take(zv, imu, tag);
    return INSOLE_OK;
}

/* Nothing is left to wait for. The samples after the last full window share its statistic. */
INSOLE_COLD insole_status_t insole_zero_velocity_finish(insole_zero_velocity_t *zv)
{
    if (!zv) {
        return INSOLE_ERR_NULL;
    }
    zv->finished = true;
    if (zv->half == 0u) {
        begin_measuring(zv);
    }
    for (; zv->measured != zv->ring.end; zv->measured++) {
        slot(zv, zv->measured)->statistic =
            zv->window.full ? slot(zv, zv->measured - 1u)->statistic : INSOLE_REAL_MAX;
    }
    while (zv->judged != zv->measured) {
        judge_next(zv);
    }
    zv->released = zv->judged;
    return INSOLE_OK;
}

void insole_zero_velocity_give(insole_zero_velocity_t *zv, insole_labelled_t *out)
{
    const insole_stance_slot_t *s = slot(zv, zv->ring.begin++);
    uint32_t newest_high = (uint32_t)(zv->newest_us >> 32);
    uint32_t high_us = newest_high - (uint16_t)(newest_high - s->high_us);
    out->imu.t_us = (uint64_t)high_us << 32 | s->t_us;
    out->imu.accel_mps2 = s->accel_mps2;
    out->imu.gyro_radps = s->gyro_radps;
    out->statistic = s->statistic;
    out->tag = s->tag;
    out->still = (s->label & LABEL_STILL) != 0u;
    out->plain = (s->label & LABEL_PLAIN) != 0u;
}
