/* SPDX-License-Identifier: MIT */
#include "insole/sense/screen.h"

#include <string.h>

#include "insole/sense/hold.h"
#include "insole/sense/spike.h"

#define ZERO INSOLE_R(0.0)

/* Beyond all reason: 200 g, 5,700 deg/s. */
static const insole_real_t ACCEL_LIMIT_MPS2 = INSOLE_R(2000.0);
static const insole_real_t GYRO_LIMIT_RADPS = INSOLE_R(100.0);

/* A later stamp is no time; sums and differences of earlier ones fit into 64 bits. */
static const uint64_t LATEST_US = (uint64_t)INT64_MAX;

/* Longer intervals than this are all the same. */
static const uint32_t FAR_US = 1u << 30;

/* Two vectors shorter than this share of a spike cannot be one away from each other. */
static const insole_real_t CALM_SHARE = INSOLE_R(0.49);

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
    screen->calm_accel2 =
        insole_square(insole_min(CALM_SHARE * config->spike_accel_mps2, ACCEL_LIMIT_MPS2));
    return insole_gyro_clip_init(&screen->clip, config->gyro_range_radps, config->clip_share);
}

/* The sample that waits for its successor, and the slot of the one before it. */
static insole_screen_slot_t *pending(insole_screen_t *s)
{
    return s->newest != 0u ? &s->slots[1] : &s->slots[0];
}

static insole_screen_slot_t *before(insole_screen_t *s)
{
    return s->newest != 0u ? &s->slots[0] : &s->slots[1];
}

/* ---- fields ----------------------------------------------------------------------------- */

/* What is no number is neither calm nor lively: fields of the rest may have to be held. */
static insole_screen_look_t look_at(const insole_screen_t *s, const insole_imu_t *imu)
{
    insole_real_t accel2 = insole_vec3_norm2(imu->accel_mps2);
    insole_real_t gyro2 = insole_vec3_norm2(imu->gyro_radps);
    if (accel2 < s->calm_accel2 && gyro2 < s->calm_gyro2) {
        return INSOLE_SCREEN_CALM;
    }
    bool fine =
        accel2 <= insole_square(ACCEL_LIMIT_MPS2) && gyro2 <= insole_square(GYRO_LIMIT_RADPS);
    return fine ? INSOLE_SCREEN_LIVELY : INSOLE_SCREEN_HELD;
}

/* Bad fields are held for a while. @return INSOLE_SCREEN_OUT: the sample is of no use */
INSOLE_APART static insole_screen_look_t repair_fields(insole_screen_t *s, insole_imu_t *imu)
{
    const insole_imu_t *last = &pending(s)->clean.imu;
    bool accel = insole_hold(&imu->accel_mps2, last->accel_mps2, ACCEL_LIMIT_MPS2);
    bool gyro = insole_hold(&imu->gyro_radps, last->gyro_radps, GYRO_LIMIT_RADPS);
    if (!accel && !gyro) {
        return INSOLE_SCREEN_LIVELY; /* long, but of fields that may be */
    }
    if (s->look != INSOLE_SCREEN_HELD) {
        s->good_us = last->t_us;
    }
    s->counts.not_finite++;
    bool soon = s->held > 0u && imu->t_us - s->good_us <= s->hold_us;
    return soon ? INSOLE_SCREEN_HELD : INSOLE_SCREEN_OUT;
}

/* ---- stamps ----------------------------------------------------------------------------- */

/* The sample held back was alone in jumping far ahead. */
static bool has_jumped(insole_screen_t *s, uint64_t t_us)
{
    uint64_t last_us = pending(s)->clean.imu.t_us, before_us = before(s)->clean.imu.t_us;
    if (s->held == 1u) { /* the first of all: nothing says that it was right */
        return s->look != INSOLE_SCREEN_OUT && last_us - t_us > s->gap_us;
    }
    return t_us > before_us && last_us - before_us > s->gap_us && t_us - before_us <= s->gap_us;
}

/* The stream is again as it was before the sample held back came. */
static void drop_pending(insole_screen_t *s)
{
    s->newest ^= 1u;
    s->held--;
    s->flowing = false;
    s->look = s->held > 0u ? INSOLE_SCREEN_OUT : INSOLE_SCREEN_LIVELY;
}

/* A stamp that does not advance is dropped, or else the one that it follows. */
INSOLE_APART static bool is_believed(insole_screen_t *s, uint64_t t_us)
{
    if (has_jumped(s, t_us)) {
        s->counts.wild++;
        drop_pending(s);
        return true;
    }
    if (t_us == pending(s)->clean.imu.t_us) {
        s->counts.repeated++;
    } else {
        s->counts.backward++;
        s->back_run++;
        s->flowing = false;
    }
    return false;
}

static bool is_in_time(insole_screen_t *s, uint64_t t_us)
{
    if (t_us > LATEST_US) {
        s->counts.wild++;
        return false;
    }
    return s->held == 0u || t_us > pending(s)->clean.imu.t_us || is_believed(s, t_us);
}

/* Nothing is known of the time since the sample before: no sample came, or a run of them was
 * dropped because the clock had been put back. */
static bool is_after_gap(insole_screen_t *s, uint32_t dt_us)
{
    insole_real_t dropped_us = (insole_real_t)s->back_run * s->clock.period_us;
    s->back_run = 0u;
    return dt_us > s->gap_us || dropped_us > (insole_real_t)s->gap_us;
}

/* What the even stamp adds to the raw one: nothing unless stamps come in bursts. */
static int32_t even_lead_us(insole_screen_t *s, uint32_t dt_us, bool known)
{
    if (known && s->clock.period_us > ZERO) {
        insole_even_clock_go_on(&s->clock, dt_us);
        if (s->clock.burst_share < s->config.burst_share) {
            return 0;
        }
        s->counts.evened++;
        return (int32_t)s->clock.lead_us; /* at most INSOLE_EVEN_CLOCK_REACH_US */
    }
    known ? (void)insole_even_clock_tick(&s->clock, dt_us) : insole_even_clock_restart(&s->clock);
    return 0;
}

/* Of a slot whose raw stamp comes so long after that of the last. */
static void set_times(insole_screen_t *s, const insole_screen_slot_t *last,
                      insole_screen_slot_t *slot, uint32_t dt_us, bool known)
{
    int32_t lead_us = even_lead_us(s, dt_us, known);
    int32_t since_us = (int32_t)dt_us + lead_us - last->lead_us;
    if (since_us < 1) { /* stamps advance */
        lead_us += 1 - since_us;
        since_us = 1;
    }
    slot->lead_us = lead_us;
    slot->since_us = (uint32_t)since_us;
}

/* ---- spikes and clipping ---------------------------------------------------------------- */

/* The pending sample, between the one before it and the one that has come. */
static void mend(insole_screen_t *s, const insole_imu_t *after, uint32_t since_us)
{
    insole_screen_slot_t *slot = pending(s);
    if (s->held < 2u || slot->since_us + since_us > s->gap_us) {
        return;
    }
    const insole_imu_t *first = &before(s)->clean.imu;
    insole_imu_t *middle = &slot->clean.imu;
    insole_real_t far_mps2 = s->config.spike_accel_mps2, far_radps = s->config.spike_gyro_radps;
    bool accel =
        insole_spike_may_be(&first->accel_mps2, &middle->accel_mps2, far_mps2) &&
        insole_spike_mend(first->accel_mps2, &middle->accel_mps2, after->accel_mps2, far_mps2);
    bool gyro =
        insole_spike_may_be(&first->gyro_radps, &middle->gyro_radps, far_radps) &&
        insole_spike_mend(first->gyro_radps, &middle->gyro_radps, after->gyro_radps, far_radps);
    s->counts.spikes += accel || gyro ? 1u : 0u;
}

/* Of a rate that is fast or follows none. */
INSOLE_APART static uint8_t watch_clipping(insole_screen_t *s, insole_vec3_t gyro,
                                           insole_real_t dt_us)
{
    uint8_t axes = 0u;
    (void)insole_gyro_clip_push(&s->clip, gyro, dt_us, &axes);
    s->counts.clipped += axes != 0u ? 1u : 0u;
    insole_real_t calm_gyro =
        insole_square(insole_min(CALM_SHARE * s->config.spike_gyro_radps, GYRO_LIMIT_RADPS));
    s->calm_gyro2 = insole_min(calm_gyro, s->clip.quiet_radps2);
    return axes;
}

/* ---- averaging -------------------------------------------------------------------------- */

static void write_mean(insole_screen_t *s, uint64_t t_us, insole_clean_t *clean)
{
    insole_real_t per_s = INSOLE_R(1.0) / s->sum_s;
    clean->imu.t_us = t_us;
    clean->imu.accel_mps2 = insole_vec3_scale(s->sum_accel, per_s);
    clean->imu.gyro_radps = insole_vec3_scale(s->sum_gyro, per_s);
    clean->marks = s->sum_marks;
    s->sum_count = 0u;
}

/* One of the samples that fill the shortest interval; the last of them takes all with it. */
static const insole_clean_t *average(insole_screen_t *s, const insole_clean_t *c, uint32_t since_us,
                                     insole_clean_t *room)
{
    if (s->sum_count == 0u) {
        s->out_us = c->imu.t_us - since_us;
        s->sum_accel = s->sum_gyro = insole_vec3_zero();
        s->sum_s = ZERO;
        s->sum_marks = 0u;
    }
    uint64_t all_us = c->imu.t_us - s->out_us;
    insole_real_t weight_s = insole_max(insole_seconds(0u, all_us) - s->sum_s, INSOLE_R(1.0e-6));
    s->sum_accel = insole_vec3_add_scaled(s->sum_accel, weight_s, c->imu.accel_mps2);
    s->sum_gyro = insole_vec3_add_scaled(s->sum_gyro, weight_s, c->imu.gyro_radps);
    s->sum_s += weight_s;
    s->sum_marks |= c->marks;
    s->sum_count++;
    if (all_us < s->least_us) {
        s->counts.averaged++;
        return NULL;
    }
    write_mean(s, c->imu.t_us, room);
    return room;
}

/* ---- the stream ------------------------------------------------------------------------- */

/* With another stamp, or as a mean with others. */
INSOLE_APART static const insole_clean_t *
release_changed(insole_screen_t *s, const insole_screen_slot_t *slot, insole_clean_t *room)
{
    insole_clean_t c = slot->clean;
    c.imu.t_us += (uint64_t)(int64_t)slot->lead_us;
    if (s->sum_count > 0u || slot->since_us < s->least_us) {
        return average(s, &c, slot->since_us, room);
    }
    *room = c;
    return room;
}

/* The sample that waits, on its way out. */
static const insole_clean_t *release(insole_screen_t *s, const insole_screen_slot_t *slot,
                                     insole_clean_t *room)
{
    bool as_it_is = s->sum_count == 0u && slot->since_us >= s->least_us && slot->lead_us == 0;
    return as_it_is ? &slot->clean : release_changed(s, slot, room);
}

/* The same for one that may have a mark, have gone out already, or not be there. */
INSOLE_APART static const insole_clean_t *release_any(insole_screen_t *s, insole_clean_t *room)
{
    const insole_screen_slot_t *slot = pending(s);
    if (s->held == 0u || s->look == INSOLE_SCREEN_OUT) {
        return NULL;
    }
    s->counts.gaps += (slot->clean.marks & INSOLE_MARK_GAP) != 0u ? 1u : 0u;
    return release(s, slot, room);
}

/* What is calm, and follows the like, is neither clipped nor next to a spike. The watch for
 * clipping has seen no calm sample: of several it wants to know the last. */
static uint8_t look_closely(insole_screen_t *s, const insole_imu_t *imu, uint32_t since_us,
                            bool known)
{
    uint8_t marks = s->held > 0u && !known ? INSOLE_MARK_GAP : 0u;
    if (s->look == INSOLE_SCREEN_CALM) {
        insole_gyro_clip_remember(&s->clip, &pending(s)->clean.imu.gyro_radps);
    }
    if (known && insole_gyro_clip_is_quiet(&s->clip, &imu->gyro_radps)) {
        insole_gyro_clip_remember(&s->clip, &imu->gyro_radps);
    } else {
        marks |= watch_clipping(s, imu->gyro_radps, known ? (insole_real_t)since_us : ZERO);
    }
    mend(s, imu, since_us);
    return marks;
}

/* Of which anything may be the matter. */
INSOLE_COLD static const insole_clean_t *take_doubtful(insole_screen_t *s, const insole_imu_t *imu,
                                                       insole_screen_look_t look,
                                                       insole_clean_t *room)
{
    if (s->finished) {
        return NULL;
    }
    s->counts.samples++;
    if (!is_in_time(s, imu->t_us)) {
        return NULL;
    }
    insole_imu_t repaired;
    if (look == INSOLE_SCREEN_HELD) {
        repaired = *imu;
        imu = &repaired;
        look = repair_fields(s, &repaired);
    }
    if (look == INSOLE_SCREEN_OUT) {
        return NULL;
    }
    insole_screen_slot_t *last = pending(s), *slot = before(s);
    uint64_t raw_us = imu->t_us - last->clean.imu.t_us;
    uint32_t dt_us = s->held > 0u && raw_us < FAR_US ? (uint32_t)raw_us : FAR_US;
    bool known = !is_after_gap(s, dt_us);
    set_times(s, last, slot, dt_us, known);
    uint8_t marks = look_closely(s, imu, slot->since_us, known);
    const insole_clean_t *out = release_any(s, room);
    slot->clean.imu = *imu;
    slot->clean.marks = marks;
    s->newest ^= 1u;
    s->held = s->held > 0u ? 2u : 1u;
    s->look = known || look != INSOLE_SCREEN_CALM ? look : INSOLE_SCREEN_LIVELY;
    s->flowing = true;
    return out;
}

INSOLE_FLAT const insole_clean_t *insole_screen_pass(insole_screen_t *screen,
                                                     const insole_imu_t *raw, insole_clean_t *room)
{
    insole_screen_t *s = screen;
    insole_screen_look_t look = look_at(s, raw);
    insole_screen_slot_t *last = pending(s), *slot = before(s);
    uint64_t dt_us = raw->t_us - last->clean.imu.t_us;
    bool calm = look == INSOLE_SCREEN_CALM && s->look == INSOLE_SCREEN_CALM && s->flowing &&
                dt_us - 1u < s->gap_us && raw->t_us <= LATEST_US;
    if (!calm) {
        return take_doubtful(s, raw, look, room);
    }
    s->counts.samples++;
    set_times(s, last, slot, (uint32_t)dt_us, true);
    const insole_clean_t *out = release(s, last, room);
    slot->clean.imu = *raw;
    slot->clean.marks = 0u;
    s->newest ^= 1u;
    return out;
}

static insole_status_t hand_over(const insole_clean_t *out, insole_clean_t *clean)
{
    if (out && out != clean) {
        *clean = *out;
    }
    return out ? INSOLE_OK : INSOLE_ERR_STATE;
}

insole_status_t insole_screen_push(insole_screen_t *screen, const insole_imu_t *raw,
                                   insole_clean_t *clean)
{
    if (!screen || !raw || !clean) {
        return INSOLE_ERR_NULL;
    }
    return hand_over(insole_screen_take(screen, raw, clean), clean);
}

insole_status_t insole_screen_finish(insole_screen_t *screen, insole_clean_t *clean)
{
    if (!screen || !clean) {
        return INSOLE_ERR_NULL;
    }
    insole_screen_t *s = screen;
    const insole_clean_t *out = s->finished ? NULL : release_any(s, clean);
    s->finished = true;
    s->flowing = false;
    if (!out && s->sum_count > 0u) {
        const insole_screen_slot_t *last = pending(s);
        write_mean(s, last->clean.imu.t_us + (uint64_t)(int64_t)last->lead_us, clean);
        out = clean;
    }
    return hand_over(out, clean);
}
