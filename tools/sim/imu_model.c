/* SPDX-License-Identifier: MIT */
#include "sim/imu_model.h"

static const double soft_share = 0.9; /* of the range: where soft clipping begins */

static double normal(insole_rng_t *rng)
{
    return (double)insole_rng_normal(rng);
}

static sim_vec3_t normal3(insole_rng_t *rng, double sigma)
{
    double x = normal(rng), y = normal(rng), z = normal(rng);
    return sim_vec3(sigma * x, sigma * y, sigma * z);
}

/* Random matrix with one sigma on the diagonal and another beside it. */
static sim_mat3_t normal33(insole_rng_t *rng, double diagonal, double beside)
{
    sim_mat3_t m = {normal3(rng, 1.0), normal3(rng, 1.0), normal3(rng, 1.0)};
    m.r0 = sim_vec3(m.r0.x * diagonal, m.r0.y * beside, m.r0.z * beside);
    m.r1 = sim_vec3(m.r1.x * beside, m.r1.y * diagonal, m.r1.z * beside);
    m.r2 = sim_vec3(m.r2.x * beside, m.r2.y * beside, m.r2.z * diagonal);
    return m;
}

static sim_mat3_t near_identity(insole_rng_t *rng, double scale, double skew_rad)
{
    sim_mat3_t m = normal33(rng, scale, skew_rad);
    m.r0.x += 1.0;
    m.r1.y += 1.0;
    m.r2.z += 1.0;
    return m;
}

/* Settings with everything off that the chosen model does not have. */
static sim_imu_settings_t effective(const sim_imu_settings_t *settings)
{
    sim_imu_settings_t kept = *settings;
    if (settings->model == SIM_MODEL_FULL) {
        return kept;
    }
    double accel_noise = 0.0, gyro_noise = 0.0;
    if (settings->model == SIM_MODEL_MATCHED) {
        accel_noise = settings->accel_noise_mps2_rthz;
        gyro_noise = settings->gyro_noise_radps_rthz;
    }
    sim_imu_settings_t none = {.model = settings->model,
                               .rate_hz = settings->rate_hz,
                               .sampling = settings->sampling,
                               .accel_noise_mps2_rthz = accel_noise,
                               .gyro_noise_radps_rthz = gyro_noise,
                               .drift_time_s = 1.0,
                               .warm_up_s = 1.0,
                               .accel_range_mps2 = HUGE_VAL,
                               .gyro_range_radps = HUGE_VAL};
    return none;
}

static void init_accel(sim_imu_t *imu, insole_rng_t *unit)
{
    const sim_imu_settings_t *s = &imu->settings;
    sim_triad_t *t = &imu->accel;
    t->gain = near_identity(unit, s->accel_scale, s->accel_skew_rad);
    t->per_force = normal33(unit, 0.0, 0.0);
    t->turn_on = normal3(unit, s->accel_bias_mps2);
    t->per_kelvin = normal3(unit, s->accel_per_k_mps2);
    t->drift = normal3(&imu->drift_rng, s->accel_drift_mps2);
    t->walk = sim_vec3(0.0, 0.0, 0.0);
    t->noise = s->accel_noise_mps2_rthz * sqrt(s->rate_hz);
    t->drift_sigma = s->accel_drift_mps2;
    t->walk_sigma = s->accel_walk_mps2_rts / sqrt(s->rate_hz);
    t->range = s->accel_range_mps2;
    t->step = s->accel_step_mps2;
}

static void init_gyro(sim_imu_t *imu, insole_rng_t *unit)
{
    const sim_imu_settings_t *s = &imu->settings;
    sim_triad_t *t = &imu->gyro;
    t->gain = near_identity(unit, s->gyro_scale, s->gyro_skew_rad);
    t->per_force = normal33(unit, s->gyro_g_radps_per_mps2, s->gyro_g_radps_per_mps2);
    t->turn_on = normal3(unit, s->gyro_bias_radps);
    t->per_kelvin = normal3(unit, s->gyro_per_k_radps);
    t->drift = normal3(&imu->drift_rng, s->gyro_drift_radps);
    t->walk = sim_vec3(0.0, 0.0, 0.0);
    t->noise = s->gyro_noise_radps_rthz * sqrt(s->rate_hz);
    t->drift_sigma = s->gyro_drift_radps;
    t->walk_sigma = s->gyro_walk_radps_rts / sqrt(s->rate_hz);
    t->range = s->gyro_range_radps;
    t->step = s->gyro_step_radps;
}

void sim_imu_init(sim_imu_t *imu, const sim_imu_settings_t *settings, uint64_t seed)
{
    insole_rng_t unit;
    imu->settings = effective(settings);
    sim_seed(&unit, seed, SIM_SEED_IMU_UNIT);
    sim_seed(&imu->noise_rng, seed, SIM_SEED_IMU_NOISE);
    sim_seed(&imu->drift_rng, seed, SIM_SEED_IMU_DRIFT);
    sim_seed(&imu->stamp_rng, seed, SIM_SEED_IMU_STAMPS);
    init_accel(imu, &unit);
    init_gyro(imu, &unit);
    imu->drift_keep = exp(-1.0 / (imu->settings.rate_hz * imu->settings.drift_time_s));
    imu->gap_end_s = -1.0;
    imu->last_t_us = 0;
    imu->given = imu->lost = imu->clipped = 0;
}

/* One sample interval later. */
static void let_drift(sim_imu_t *imu, sim_triad_t *t)
{
    double keep = imu->drift_keep;
    sim_vec3_t push = normal3(&imu->drift_rng, t->drift_sigma * sqrt(1.0 - keep * keep));
    t->drift = sim_vec3_add_scaled(push, keep, t->drift);
    t->walk = sim_vec3_add(t->walk, normal3(&imu->drift_rng, t->walk_sigma));
}

static double clip_hard(double value, double range)
{
    return fmax(-range, fmin(range, value));
}

/* Straight up to a share of the range, then bending towards the range without reaching it. */
static double clip_soft(double value, double range)
{
    double knee = soft_share * range, room = range - knee, size = fabs(value);
    return size <= knee ? value : copysign(knee + room * tanh((size - knee) / room), value);
}

static double digitise(const sim_imu_t *imu, const sim_triad_t *t, double value)
{
    if (t->range < HUGE_VAL) {
        value = imu->settings.clip == SIM_CLIP_SOFT ? clip_soft(value, t->range)
                                                    : clip_hard(value, t->range);
    }
    return t->step > 0.0 ? t->step * round(value / t->step) : value;
}

/* What one triad reads; `truth` is what it should, `force` what shakes it. */
static sim_vec3_t read_triad(sim_imu_t *imu, sim_triad_t *t, sim_vec3_t truth, sim_vec3_t force,
                             double warmer_k, bool *clipped)
{
    sim_vec3_t v = sim_mat3_mul_vec(t->gain, truth);
    v = sim_vec3_add(v, sim_mat3_mul_vec(t->per_force, force));
    v = sim_vec3_add(sim_vec3_add(v, t->turn_on), sim_vec3_add(t->drift, t->walk));
    v = sim_vec3_add_scaled(v, warmer_k, t->per_kelvin);
    v = sim_vec3_add(v, normal3(&imu->noise_rng, t->noise));
    let_drift(imu, t);
    *clipped = *clipped || fmax(fabs(v.x), fmax(fabs(v.y), fabs(v.z))) > t->range;
    return sim_vec3(digitise(imu, t, v.x), digitise(imu, t, v.y), digitise(imu, t, v.z));
}

/* Gaps begin at random times and last exponentially long. */
static bool is_lost(sim_imu_t *imu, double t_s)
{
    double chance = imu->settings.dropouts_hz / imu->settings.rate_hz;
    double begins = (double)insole_rng_uniform(&imu->stamp_rng);
    double length = (double)insole_rng_uniform(&imu->stamp_rng);
    if (t_s >= imu->gap_end_s && begins < chance) {
        imu->gap_end_s = t_s - imu->settings.dropout_s * log(1.0 - length);
    }
    return t_s < imu->gap_end_s;
}

/* Stamps are wrong, but they grow. */
static uint64_t stamp(sim_imu_t *imu, double t_s)
{
    double told_us = 1e6 * (t_s + imu->settings.stamp_jitter_s * normal(&imu->stamp_rng));
    uint64_t t_us = told_us <= 0.0 ? 0u : (uint64_t)(told_us + 0.5);
    if (imu->given > 0 && t_us <= imu->last_t_us) {
        t_us = imu->last_t_us + 1u;
    }
    imu->last_t_us = t_us;
    return t_us;
}

static insole_vec3_t to_real(sim_vec3_t v)
{
    return insole_vec3((insole_real_t)v.x, (insole_real_t)v.y, (insole_real_t)v.z);
}

bool sim_imu_read(sim_imu_t *imu, double t_s, sim_vec3_t force_mps2, sim_vec3_t rate_radps,
                  insole_imu_t *sample)
{
    double warmer_k = imu->settings.warm_up_k * (1.0 - exp(-t_s / imu->settings.warm_up_s));
    bool clipped = false;
    sim_vec3_t f = read_triad(imu, &imu->accel, force_mps2, force_mps2, warmer_k, &clipped);
    sim_vec3_t w = read_triad(imu, &imu->gyro, rate_radps, force_mps2, warmer_k, &clipped);
    if (is_lost(imu, t_s)) {
        imu->lost++;
        return false;
    }
    sample->t_us = stamp(imu, t_s);
    sample->accel_mps2 = to_real(f);
    sample->gyro_radps = to_real(w);
    imu->given++;
    imu->clipped += clipped ? 1u : 0u;
    return true;
}
