/* SPDX-License-Identifier: MIT */
#include "insole/sense/screen.h"

#include <string.h>

#define ZERO INSOLE_R(0.0)
#define ONE  INSOLE_R(1.0)

/* Beyond all reason: 200 g, 5,700 deg/s. */
static const insole_real_t ACCEL_LIMIT_MPS2 = INSOLE_R(2000.0);
static const insole_real_t GYRO_LIMIT_RADPS = INSOLE_R(100.0);

/* A later stamp is no time; sums and differences of earlier ones fit into 64 bits. */
static const uint64_t LATEST_US = (uint64_t)INT64_MAX;

/* A neighbour of a spike lies this much nearer to the other neighbour than to the spike. */
static const insole_real_t SPIKE_SHARE = INSOLE_R(0.25);

/* The clock behind the stamps: gains of its phase and period per sample, the interval that makes a
 * burst, and how far a stamp may lie from it before it starts anew. */
enum { CLOCK_INTERVALS = 20 };
static const insole_real_t CLOCK_PHASE_GAIN = INSOLE_R(0.05);
static const insole_real_t CLOCK_PERIOD_GAIN = INSOLE_R(0.0006);
static const insole_real_t CLOCK_REACH_US = INSOLE_R(30000.0);
static const insole_real_t BURST_INTERVAL_SHARE = INSOLE_R(0.75);
static const insole_real_t BURST_WEIGHT = INSOLE_R(0.01);

/* An interval this much shorter than that of the highest rate is still one of it. */
static const insole_real_t INTERVAL_SHARE = INSOLE_R(0.98);

const insole_screen_config_t insole_screen_defaults = {INSOLE_SCREEN_KEYS(INSOLE_CONFIG_DEFAULT)};

insole_status_t insole_screen_check(const insole_screen_config_t *config)
{
    typedef insole_screen_config_t config_t;
    static const insole_config_range_t ranges[] = {INSOLE_SCREEN_KEYS(INSOLE_CONFIG_RANGE)};
    return insole_config_check(config, ranges, sizeof ranges / sizeof ranges[0]);
}

insole_status_t insole_screen_init(insole_screen_t *screen, const insole_screen_config_t *config)
{
    if (!screen || !config) {
        return INSOLE_ERR_NULL;
    }
    if (insole_screen_check(config) != INSOLE_OK) {
        return INSOLE_ERR_VALUE;
    }
    memset(screen, 0, sizeof *screen);
    screen->config = *config;
    screen->gap_us = insole_microseconds(config->gap_s);
    screen->hold_us = insole_microseconds(config->hold_s);
    screen->least_us = insole_microseconds(INTERVAL_SHARE / config->max_rate_hz);
    return insole_gyro_clip_init(&screen->clip, config->gyro_range_radps, config->clip_share);
}

/* ---- fields ----------------------------------------------------------------------------- */

/* @return how many fields were held: 0 or 1 */
static uint32_t hold_field(insole_real_t *value, insole_real_t last, insole_real_t limit)
{
    if (insole_abs(*value) <= limit) {
        return 0u;
    }
    *value = last;
    return 1u;
}

/* Not true of what is no number. */
static bool is_shorter(insole_vec3_t v, insole_real_t limit)
{
    return insole_vec3_norm2(v) <= insole_square(limit);
}

static bool hold_fields(insole_imu_t *imu, const insole_imu_t *last)
{
    if (is_shorter(imu->accel_mps2, ACCEL_LIMIT_MPS2) &&
        is_shorter(imu->gyro_radps, GYRO_LIMIT_RADPS)) {
        return false; /* nor is any of the fields beyond the limit */
    }
    insole_vec3_t *a = &imu->accel_mps2, *w = &imu->gyro_radps;
    const insole_vec3_t *la = &last->accel_mps2, *lw = &last->gyro_radps;
    uint32_t held = 0u;
    held += hold_field(&a->x, la->x, ACCEL_LIMIT_MPS2) + hold_field(&w->x, lw->x, GYRO_LIMIT_RADPS);
    held += hold_field(&a->y, la->y, ACCEL_LIMIT_MPS2) + hold_field(&w->y, lw->y, GYRO_LIMIT_RADPS);
    held += hold_field(&a->z, la->z, ACCEL_LIMIT_MPS2) + hold_field(&w->z, lw->z, GYRO_LIMIT_RADPS);
    return held > 0u;
}

/* Bad fields are held for a while; false: the sample is of no use. */
static bool repair_fields(insole_screen_t *s, insole_imu_t *imu)
{
    if (!hold_fields(imu, &s->pending.imu)) {
        s->good_us = imu->t_us;
        return true;
    }
    s->counts.not_finite++;
    return s->held > 0u && imu->t_us - s->good_us <= s->hold_us;
}

/* ---- stamps ----------------------------------------------------------------------------- */

/* The sample held back was alone in jumping far ahead. */
static bool has_jumped(const insole_screen_t *s, uint64_t t_us)
{
    if (s->held == 1u) { /* the first of all: nothing says that it was right */
        return !s->has_spare && s->raw_us - t_us > s->gap_us;
    }
    return t_us > s->raw_before_us && s->raw_us - s->raw_before_us > s->gap_us &&
           t_us - s->raw_before_us <= s->gap_us;
}

/* The stream is again as it was before the sample held back came. */
static void drop_pending(insole_screen_t *s)
{
    s->pending = s->before;
    s->raw_us = s->raw_before_us;
    s->last_us = s->before.imu.t_us;
    s->good_us = s->raw_before_us;
    s->held--;
    s->has_spare = s->held > 0u;
}

/* A stamp that does not advance is dropped, or else the one that it follows. */
static bool is_in_time(insole_screen_t *s, uint64_t t_us)
{
    if (t_us > LATEST_US) {
        s->counts.wild++;
        return false;
    }
    if (s->held == 0u || t_us > s->raw_us) {
        return true;
    }
    if (has_jumped(s, t_us)) {
        s->counts.wild++;
        drop_pending(s);
        return true;
    }
    if (t_us == s->raw_us) {
        s->counts.repeated++;
    } else {
        s->counts.backward++;
        s->back_run++;
    }
    return false;
}

/* Nothing is known of the time since the sample before: no sample came, or a run of them was
 * dropped because the clock had been put back. */
static bool is_after_gap(const insole_screen_t *s, uint64_t t_us)
{
    if (s->held == 0u) {
        return false;
    }
    insole_real_t dropped_us =
        s->back_run > 0u ? (insole_real_t)s->back_run * s->clock.period_us : ZERO;
    return t_us - s->raw_us > s->gap_us || dropped_us > (insole_real_t)s->gap_us;
}

/* ---- bursts ----------------------------------------------------------------------------- */

/* A stamp that follows the one before this soon was read late, with its successor. */
static bool follows_too_soon(const insole_even_clock_t *clock, insole_real_t dt_us)
{
    return dt_us < BURST_INTERVAL_SHARE * clock->period_us;
}

/* The clock ticks on by its period and is drawn towards the stamp that came. */
static void tick(insole_even_clock_t *clock, insole_real_t dt_us)
{
    insole_real_t error_us = dt_us - clock->period_us - clock->lead_us; /* raw less expected */
    clock->burst_share +=
        BURST_WEIGHT * ((follows_too_soon(clock, dt_us) ? ONE : ZERO) - clock->burst_share);
    if (insole_abs(error_us) > CLOCK_REACH_US) {
        clock->lead_us = ZERO;
        return;
    }
    clock->lead_us = -(ONE - CLOCK_PHASE_GAIN) * error_us;
    clock->period_us += CLOCK_PERIOD_GAIN * error_us;
}

static void learn_period(insole_even_clock_t *clock, uint32_t dt_us)
{
    clock->span_us += dt_us;
    if (++clock->intervals == CLOCK_INTERVALS) {
        clock->period_us = (insole_real_t)clock->span_us / (insole_real_t)CLOCK_INTERVALS;
    }
}

/* What the even stamp adds to the raw one: nothing unless stamps come in bursts. */
static int32_t even_lead_us(insole_screen_t *s, uint32_t dt_us, bool after_gap)
{
    insole_even_clock_t *clock = &s->clock;
    if (after_gap) {
        clock->lead_us = ZERO;
        return 0;
    }
    if (!(clock->period_us > ZERO)) {
        learn_period(clock, dt_us);
        return 0;
    }
    tick(clock, (insole_real_t)dt_us);
    if (clock->burst_share < s->config.burst_share) {
        return 0;
    }
    s->counts.evened++;
    return (int32_t)clock->lead_us; /* at most CLOCK_REACH_US */
}

/* The stamp to use; always later than the one before. */
static uint64_t even_stamp(insole_screen_t *s, uint64_t t_us, bool after_gap)
{
    if (s->held == 0u) {
        return t_us;
    }
    int64_t dt_us = (int64_t)(t_us - s->last_us);
    dt_us += even_lead_us(s, (uint32_t)(t_us - s->raw_us), after_gap);
    return s->last_us + (dt_us > 0 ? (uint64_t)dt_us : 1u);
}

/* ---- spikes ----------------------------------------------------------------------------- */

static bool mend_spike(insole_real_t before, insole_real_t *middle, insole_real_t after,
                       insole_real_t limit)
{
    insole_real_t rise = *middle - before, fall = *middle - after;
    insole_real_t least = insole_min(insole_abs(rise), insole_abs(fall));
    bool spike =
        rise * fall > ZERO && least > limit && insole_abs(after - before) < SPIKE_SHARE * least;
    if (spike) {
        *middle = INSOLE_R(0.5) * (before + after);
    }
    return spike;
}

static bool mend_spikes(insole_vec3_t before, insole_vec3_t *middle, insole_vec3_t after,
                        insole_real_t limit)
{
    if (is_shorter(insole_vec3_sub(*middle, before), limit)) {
        return false;
    }
    bool x = mend_spike(before.x, &middle->x, after.x, limit);
    bool y = mend_spike(before.y, &middle->y, after.y, limit);
    bool z = mend_spike(before.z, &middle->z, after.z, limit);
    return x || y || z;
}

static void mend(insole_screen_t *s, const insole_imu_t *after)
{
    if (s->held < 2u || after->t_us - s->before.imu.t_us > s->gap_us) {
        return;
    }
    const insole_imu_t *before = &s->before.imu;
    insole_imu_t *middle = &s->pending.imu;
    bool accel = mend_spikes(before->accel_mps2, &middle->accel_mps2, after->accel_mps2,
                             s->config.spike_accel_mps2);
    bool gyro = mend_spikes(before->gyro_radps, &middle->gyro_radps, after->gyro_radps,
                            s->config.spike_gyro_radps);
    s->counts.spikes += accel || gyro ? 1u : 0u;
}

/* ---- clipping --------------------------------------------------------------------------- */

static uint8_t clip_marks(insole_screen_t *s, const insole_imu_t *imu, bool after_gap)
{
    bool known = s->held > 0u && !after_gap;
    insole_real_t dt_us = known ? (insole_real_t)(uint32_t)(imu->t_us - s->last_us) : ZERO;
    uint8_t axes = 0u;
    (void)insole_gyro_clip_push(&s->clip, imu->gyro_radps, dt_us, &axes);
    s->counts.clipped += axes != 0u ? 1u : 0u;
    return axes;
}

/* ---- averaging -------------------------------------------------------------------------- */

static void sum_add(insole_screen_t *s, const insole_clean_t *c, insole_real_t weight_s)
{
    s->sum_accel = insole_vec3_add_scaled(s->sum_accel, weight_s, c->imu.accel_mps2);
    s->sum_gyro = insole_vec3_add_scaled(s->sum_gyro, weight_s, c->imu.gyro_radps);
    s->sum_s += weight_s;
    s->sum_marks |= c->marks;
    s->sum_count++;
}

static void sum_clear(insole_screen_t *s)
{
    s->sum_accel = s->sum_gyro = insole_vec3_zero();
    s->sum_s = ZERO;
    s->sum_marks = 0u;
    s->sum_count = 0u;
}

static insole_status_t give(insole_screen_t *s, const insole_clean_t *c, insole_clean_t *clean)
{
    *clean = *c;
    s->out_us = c->imu.t_us;
    s->has_out = true;
    return INSOLE_OK;
}

static insole_status_t give_mean(insole_screen_t *s, uint64_t t_us, insole_clean_t *clean)
{
    insole_real_t per_s = ONE / s->sum_s;
    insole_clean_t mean = {
        {t_us, insole_vec3_scale(s->sum_accel, per_s), insole_vec3_scale(s->sum_gyro, per_s)},
        s->sum_marks};
    sum_clear(s);
    return give(s, &mean, clean);
}

/* A sample on its way out, alone or as the last of those that fill the shortest interval. */
static insole_status_t average(insole_screen_t *s, const insole_clean_t *c, insole_clean_t *clean)
{
    uint64_t since_us = s->has_out ? c->imu.t_us - s->out_us : s->least_us;
    if (s->sum_count == 0u && since_us >= s->least_us) {
        return give(s, c, clean);
    }
    insole_real_t weight_s = insole_seconds(0u, since_us) - s->sum_s;
    sum_add(s, c, insole_max(weight_s, INSOLE_R(1.0e-6)));
    if (since_us < s->least_us) {
        s->counts.averaged++;
        return INSOLE_ERR_STATE;
    }
    return give_mean(s, c->imu.t_us, clean);
}

/* ---- the stream ------------------------------------------------------------------------- */

static insole_status_t release(insole_screen_t *s, insole_clean_t *clean)
{
    s->before = s->pending;
    if (s->has_spare) { /* has gone out before */
        s->has_spare = false;
        return INSOLE_ERR_STATE;
    }
    s->counts.gaps += (s->before.marks & INSOLE_MARK_GAP) != 0u ? 1u : 0u;
    return average(s, &s->before, clean);
}

static void take_in(insole_screen_t *s, const insole_clean_t *next, uint64_t raw_us)
{
    s->pending = *next;
    s->last_us = next->imu.t_us;
    s->raw_before_us = s->raw_us;
    s->raw_us = raw_us;
    s->back_run = 0u;
    s->held = s->held > 0u ? 2u : 1u;
}

insole_status_t insole_screen_push(insole_screen_t *screen, const insole_imu_t *raw,
                                   insole_clean_t *clean)
{
    if (!screen || !raw || !clean) {
        return INSOLE_ERR_NULL;
    }
    insole_screen_t *s = screen;
    insole_clean_t next = {*raw, 0u};
    if (s->finished) {
        return INSOLE_ERR_STATE;
    }
    s->counts.samples++;
    if (!is_in_time(s, raw->t_us) || !repair_fields(s, &next.imu)) {
        return INSOLE_ERR_STATE;
    }
    bool after_gap = is_after_gap(s, raw->t_us);
    next.imu.t_us = even_stamp(s, raw->t_us, after_gap);
    next.marks = clip_marks(s, &next.imu, after_gap);
    next.marks |= after_gap ? INSOLE_MARK_GAP : 0u;
    mend(s, &next.imu);
    insole_status_t status = s->held > 0u ? release(s, clean) : INSOLE_ERR_STATE;
    take_in(s, &next, raw->t_us);
    return status;
}

insole_status_t insole_screen_finish(insole_screen_t *screen, insole_clean_t *clean)
{
    if (!screen || !clean) {
        return INSOLE_ERR_NULL;
    }
    insole_screen_t *s = screen;
    s->finished = true;
    if (s->held > 0u) {
        s->held = 0u;
        if (release(s, clean) == INSOLE_OK) {
            return INSOLE_OK;
        }
    }
    return s->sum_count > 0u ? give_mean(s, s->before.imu.t_us, clean) : INSOLE_ERR_STATE;
}
