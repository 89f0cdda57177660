/* SPDX-License-Identifier: MIT */
#include "insole/sense/screen.h"

#define ZERO INSOLE_R(0.0)
#define ONE INSOLE_R(1.0)

/* Beyond all reason: 200 g, 5,700 deg/s. */
static const insole_real_t ACCEL_LIMIT_MPS2 = INSOLE_R(2000.0);
static const insole_real_t GYRO_LIMIT_RADPS = INSOLE_R(100.0);

/* A neighbour of a spike lies this much nearer to the other neighbour than to the spike. */
static const insole_real_t SPIKE_SHARE = INSOLE_R(0.25);

/* A swing's own peak is never flat for so long, so high. */
static const insole_real_t FLAT_SHARE = INSOLE_R(0.03);
static const insole_real_t FLAT_FROM_RADPS = INSOLE_R(4.0);
static const uint32_t FLAT_US = 25000u;

const insole_screen_config_t insole_screen_defaults = {INSOLE_SCREEN_KEYS(INSOLE_CONFIG_DEFAULT)};

insole_status_t insole_screen_init(insole_screen_t *screen, const insole_screen_config_t *config)
{
    if (!screen || !config) {
        return INSOLE_ERR_NULL;
    }
    if (!(true INSOLE_SCREEN_KEYS(INSOLE_CONFIG_IN_RANGE))) {
        return INSOLE_ERR_VALUE;
    }
    static const insole_screen_t blank;
    *screen = blank;
    screen->config = *config;
    return INSOLE_OK;
}

static insole_real_t seconds(uint64_t from_us, uint64_t to_us)
{
    return (insole_real_t)(to_us - from_us) * INSOLE_R(1.0e-6);
}

/* ---- fields ----------------------------------------------------------------------------- */

static bool hold_field(insole_real_t *value, insole_real_t last, insole_real_t limit)
{
    if (insole_abs(*value) <= limit) {
        return false;
    }
    *value = last;
    return true;
}

static bool hold_fields(insole_imu_t *imu, const insole_imu_t *last)
{
    insole_vec3_t *a = &imu->accel_mps2, *w = &imu->gyro_radps;
    const insole_vec3_t *la = &last->accel_mps2, *lw = &last->gyro_radps;
    bool x = hold_field(&a->x, la->x, ACCEL_LIMIT_MPS2) | hold_field(&w->x, lw->x, GYRO_LIMIT_RADPS);
    bool y = hold_field(&a->y, la->y, ACCEL_LIMIT_MPS2) | hold_field(&w->y, lw->y, GYRO_LIMIT_RADPS);
    bool z = hold_field(&a->z, la->z, ACCEL_LIMIT_MPS2) | hold_field(&w->z, lw->z, GYRO_LIMIT_RADPS);
    return x || y || z;
}

/* Bad fields are held for a while; false: the sample is of no use. */
static bool repair_fields(insole_screen_t *s, insole_imu_t *imu)
{
    if (!hold_fields(imu, &s->pending.imu)) {
        s->good_us = imu->t_us;
        return true;
    }
    s->counts.not_finite++;
    return s->held > 0u && seconds(s->good_us, imu->t_us) <= s->config.hold_s;
}

/* ---- stamps ----------------------------------------------------------------------------- */

/* A stamp that does not advance is dropped; but when the sample held back was alone in jumping far
 * ahead, it is the one to go. */
static bool is_in_time(insole_screen_t *s, uint64_t t_us)
{
    if (s->held == 0u || t_us > s->last_us) {
        return true;
    }
    bool jumped = s->held == 2u && t_us > s->before.imu.t_us &&
                  seconds(s->before.imu.t_us, s->pending.imu.t_us) > s->config.gap_s &&
                  seconds(s->before.imu.t_us, t_us) <= s->config.gap_s;
    if (jumped) {
        s->counts.wild++;
        s->pending = s->before;
        s->held = 1u;
        s->has_spare = true;
        return true;
    }
    if (t_us == s->last_us) {
        s->counts.repeated++;
    } else {
        s->counts.backward++;
    }
    return false;
}

/* ---- spikes ----------------------------------------------------------------------------- */

static bool mend_spike(insole_real_t before, insole_real_t *middle, insole_real_t after,
                       insole_real_t limit)
{
    insole_real_t rise = *middle - before, fall = *middle - after;
    insole_real_t least = insole_min(insole_abs(rise), insole_abs(fall));
    bool spike = rise * fall > ZERO && least > limit &&
                 insole_abs(after - before) < SPIKE_SHARE * least;
    if (spike) {
        *middle = INSOLE_R(0.5) * (before + after);
    }
    return spike;
}

static bool mend_spikes(insole_vec3_t before, insole_vec3_t *middle, insole_vec3_t after,
                        insole_real_t limit)
{
    bool x = mend_spike(before.x, &middle->x, after.x, limit);
    bool y = mend_spike(before.y, &middle->y, after.y, limit);
    bool z = mend_spike(before.z, &middle->z, after.z, limit);
    return x || y || z;
}

static void mend(insole_screen_t *s, const insole_imu_t *after)
{
    if (s->held < 2u || seconds(s->before.imu.t_us, after->t_us) > s->config.gap_s) {
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

/* A gyro at its end stays flat where a foot's swing would go on; the level is remembered. */
static void watch_clip(insole_clip_t *clip, insole_real_t w, uint32_t dt_us)
{
    insole_real_t size = insole_abs(w);
    bool flat = size > FLAT_FROM_RADPS &&
                insole_abs(w - clip->top_radps) <= FLAT_SHARE * insole_abs(clip->top_radps);
    if (!flat) {
        clip->top_radps = w;
        clip->run_us = 0u;
        return;
    }
    clip->run_us += dt_us;
    if (clip->run_us >= FLAT_US) {
        clip->level_radps = insole_max(clip->level_radps, insole_abs(clip->top_radps));
    }
}

static uint8_t clip_mark(insole_screen_t *s, uint32_t axis, insole_real_t w, uint32_t dt_us)
{
    insole_clip_t *clip = &s->clip[axis];
    insole_real_t level = s->config.gyro_range_radps;
    if (!(level > ZERO)) {
        watch_clip(clip, w, dt_us);
        level = clip->level_radps;
    }
    bool clipped = level > ZERO && insole_abs(w) >= s->config.clip_share * level;
    return (uint8_t)(clipped ? 1u << axis : 0u);
}

static uint8_t clip_marks(insole_screen_t *s, const insole_imu_t *imu)
{
    uint32_t dt_us = s->held > 0u ? (uint32_t)(imu->t_us - s->last_us) : 0u;
    insole_vec3_t w = imu->gyro_radps;
    unsigned marks = (unsigned)clip_mark(s, 0u, w.x, dt_us) | clip_mark(s, 1u, w.y, dt_us) |
                     clip_mark(s, 2u, w.z, dt_us);
    s->counts.clipped += marks != 0u ? 1u : 0u;
    return (uint8_t)marks;
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

/* A sample on its way out, alone or as the last of those that fill the shortest interval. */
static insole_status_t average(insole_screen_t *s, const insole_clean_t *c, insole_clean_t *clean)
{
    insole_real_t least_s = INSOLE_R(0.98) / s->config.max_rate_hz;
    insole_real_t since_s = s->has_out ? seconds(s->out_us, c->imu.t_us) : least_s;
    if (s->sum_count == 0u && since_s >= least_s) {
        return give(s, c, clean);
    }
    insole_real_t weight_s = since_s - s->sum_s;
    sum_add(s, c, insole_max(weight_s, INSOLE_R(1.0e-6)));
    if (since_s < least_s) {
        s->counts.averaged++;
        return INSOLE_ERR_STATE;
    }
    insole_real_t per_s = ONE / s->sum_s;
    insole_clean_t mean = {{c->imu.t_us, insole_vec3_scale(s->sum_accel, per_s),
                            insole_vec3_scale(s->sum_gyro, per_s)},
                           s->sum_marks};
    sum_clear(s);
    return give(s, &mean, clean);
}

/* ---- the stream ------------------------------------------------------------------------- */

static insole_status_t release(insole_screen_t *s, insole_clean_t *clean)
{
    s->before = s->pending;
    if (s->has_spare) { /* has gone out before */
        s->has_spare = false;
        return INSOLE_ERR_STATE;
    }
    return average(s, &s->before, clean);
}

insole_status_t insole_screen_push(insole_screen_t *screen, const insole_imu_t *raw,
                                   insole_clean_t *clean)
{
    if (!screen || !raw || !clean) {
        return INSOLE_ERR_NULL;
    }
    insole_screen_t *s = screen;
    insole_clean_t next = {*raw, 0u};
    s->counts.samples++;
    if (!is_in_time(s, raw->t_us) || !repair_fields(s, &next.imu)) {
        return INSOLE_ERR_STATE;
    }
    next.marks = clip_marks(s, &next.imu);
    if (s->held > 0u && seconds(s->pending.imu.t_us, raw->t_us) > s->config.gap_s) {
        next.marks |= INSOLE_MARK_GAP;
    }
    mend(s, &next.imu);
    insole_status_t status = s->held > 0u ? release(s, clean) : INSOLE_ERR_STATE;
    s->pending = next;
    s->last_us = raw->t_us;
    s->held = s->held > 0u ? 2u : 1u;
    return status;
}

insole_status_t insole_screen_finish(insole_screen_t *screen, insole_clean_t *clean)
{
    if (!screen || !clean) {
        return INSOLE_ERR_NULL;
    }
    if (screen->held == 0u) {
        return INSOLE_ERR_STATE;
    }
    screen->held = 0u;
    return release(screen, clean);
}
