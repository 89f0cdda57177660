/* SPDX-License-Identifier: MIT */
#include "insole/sense/still_bias.h"

#include <string.h>

#define ZERO INSOLE_R(0.0)

/* A block with an interval longer than this is thrown away. */
static const uint32_t GAP_US = 100000u;

/* A gravity that a rest may tell; farther off, the sensor's scale or unit is wrong. */
static const insole_real_t GRAVITY_SPREAD_MPS2 = INSOLE_R(0.5);

/* A little more than screen.h lets through. */
static const insole_real_t HIGHEST_RATE_HZ = INSOLE_R(300.0);

const insole_still_bias_config_t insole_still_bias_defaults = {
    INSOLE_STILL_BIAS_KEYS(INSOLE_CONFIG_DEFAULT)};

insole_status_t insole_still_bias_check(const insole_still_bias_config_t *config)
{
    typedef insole_still_bias_config_t config_t;
    static const insole_config_range_t ranges[] = {INSOLE_STILL_BIAS_KEYS(INSOLE_CONFIG_RANGE)};
    return insole_config_check(config, ranges, sizeof ranges / sizeof ranges[0]);
}

INSOLE_COLD insole_status_t insole_still_bias_init(insole_still_bias_t *rest,
                                                   const insole_still_bias_config_t *config)
{
    if (!rest || !config) {
        return INSOLE_ERR_NULL;
    }
    if (insole_still_bias_check(config) != INSOLE_OK) {
        return INSOLE_ERR_VALUE;
    }
    memset(rest, 0, sizeof *rest);
    rest->config = *config;
    rest->block_us = insole_microseconds(config->block_s);
    rest->gravity_mps2 = config->gravity_mps2;
    insole_real_t variance = insole_square(config->sigma_bias_radps);
    rest->variance_radps2 = insole_vec3(variance, variance, variance);
    return INSOLE_OK;
}

static void block_begin(insole_still_block_t *block, const insole_imu_t *imu)
{
    memset(block, 0, sizeof *block);
    block->begin_us = (uint32_t)imu->t_us;
    block->accel0_mps2 = imu->accel_mps2;
    block->gyro0_radps = imu->gyro_radps;
}

/* Values relative to the first sample of the block. */
static void block_add(insole_still_block_t *block, const insole_imu_t *imu)
{
    insole_vec3_t accel = insole_vec3_sub(imu->accel_mps2, block->accel0_mps2);
    insole_vec3_t gyro = insole_vec3_sub(imu->gyro_radps, block->gyro0_radps);
    block->accel = insole_vec3_add(block->accel, accel);
    block->gyro = insole_vec3_add(block->gyro, gyro);
    block->accel2 += insole_vec3_norm2(accel);
    block->gyro2 += insole_vec3_norm2(gyro);
}

static insole_still_moments_t moments_of(const insole_still_block_t *b)
{
    insole_real_t per_n = INSOLE_R(1.0) / (insole_real_t)b->count;
    insole_vec3_t accel = insole_vec3_scale(b->accel, per_n);
    insole_vec3_t gyro = insole_vec3_scale(b->gyro, per_n);
    insole_still_moments_t moments = {
        insole_vec3_add(accel, b->accel0_mps2), insole_vec3_add(gyro, b->gyro0_radps),
        b->accel2 * per_n - insole_vec3_norm2(accel), b->gyro2 * per_n - insole_vec3_norm2(gyro)};
    return moments;
}

/* Variance of two blocks joined, over all axes: the same however the sensor is turned. */
static insole_real_t joint_variance(insole_vec3_t mean_a, insole_real_t var_a, insole_vec3_t mean_b,
                                    insole_real_t var_b)
{
    const insole_real_t half = INSOLE_R(0.5);
    insole_vec3_t half_apart = insole_vec3_scale(insole_vec3_sub(mean_a, mean_b), half);
    return half * (var_a + var_b) + insole_vec3_norm2(half_apart);
}

static insole_real_t distance(insole_vec3_t a, insole_vec3_t b)
{
    return insole_vec3_norm(insole_vec3_sub(a, b));
}

static bool are_quiet(const insole_still_bias_config_t *c, const insole_still_moments_t *a,
                      const insole_still_moments_t *b)
{
    return distance(a->gyro_radps, b->gyro_radps) < c->agree_radps &&
           distance(a->accel_mps2, b->accel_mps2) < c->agree_mps2 &&
           joint_variance(a->gyro_radps, a->var_gyro, b->gyro_radps, b->var_gyro) <
               insole_square(c->quiet_gyro_radps) &&
           joint_variance(a->accel_mps2, a->var_accel, b->accel_mps2, b->var_accel) <
               insole_square(c->quiet_accel_mps2);
}

static void learn_axis(insole_real_t *bias, insole_real_t *variance, insole_real_t measured,
                       insole_real_t measured_var)
{
    insole_real_t gain = *variance / (*variance + measured_var);
    *bias += gain * (measured - *bias);
    *variance *= INSOLE_R(1.0) - gain;
}

static void learn_bias(insole_still_bias_t *rest, insole_vec3_t measured, insole_real_t apart)
{
    const insole_still_bias_config_t *c = &rest->config;
    insole_real_t var =
        insole_square(c->agree_weight * apart) + insole_square(c->sigma_block_radps);
    learn_axis(&rest->gyro_bias_radps.x, &rest->variance_radps2.x, measured.x, var);
    learn_axis(&rest->gyro_bias_radps.y, &rest->variance_radps2.y, measured.y, var);
    learn_axis(&rest->gyro_bias_radps.z, &rest->variance_radps2.z, measured.z, var);
    rest->rests++;
}

static void learn_gravity(insole_still_bias_t *rest, insole_vec3_t mean_accel)
{
    insole_real_t since_s = insole_seconds(rest->first_us, rest->last_us);
    insole_real_t g = insole_vec3_norm(mean_accel);
    if (since_s > rest->config.gravity_s ||
        insole_abs(g - rest->config.gravity_mps2) > GRAVITY_SPREAD_MPS2) {
        return;
    }
    rest->gravity_rests++;
    insole_real_t weight = INSOLE_R(1.0) / (insole_real_t)rest->gravity_rests;
    rest->gravity_mps2 += weight * (g - rest->gravity_mps2);
}

/* The squares about the mean can only grow: once they are too large for as many samples as a block
 * may hold, neither this block nor the next is quiet with the other. */
INSOLE_APART static bool is_lively(const insole_still_bias_t *rest)
{
    const insole_still_bias_config_t *c = &rest->config;
    insole_still_moments_t now = moments_of(&rest->block);
    insole_real_t most = HIGHEST_RATE_HZ * c->block_s;
    insole_real_t half_share = INSOLE_R(0.5) * (insole_real_t)rest->block.count / most;
    return half_share * now.var_gyro > insole_square(c->quiet_gyro_radps) ||
           half_share * now.var_accel > insole_square(c->quiet_accel_mps2);
}

/* A full block against the one before. */
static void learn(insole_still_bias_t *rest)
{
    const insole_still_bias_config_t *c = &rest->config;
    insole_still_moments_t now = moments_of(&rest->block), *before = &rest->before;
    if (rest->has_before && are_quiet(c, &now, before)) {
        insole_real_t apart = distance(now.gyro_radps, before->gyro_radps);
        learn_bias(rest, insole_vec3_middle(now.gyro_radps, before->gyro_radps), apart);
        learn_gravity(rest, insole_vec3_middle(now.accel_mps2, before->accel_mps2));
    }
    *before = now;
}

/* A block is full; the next one begins. */
INSOLE_COLD static void end_block(insole_still_bias_t *rest, const insole_imu_t *last)
{
    const insole_still_bias_config_t *c = &rest->config;
    insole_real_t walk = insole_square(c->bias_walk_radps_rts) * c->block_s;
    rest->variance_radps2 = insole_vec3_add(rest->variance_radps2, insole_vec3(walk, walk, walk));
    if (!rest->block.lively) {
        learn(rest);
    }
    rest->has_before = !rest->block.lively;
    block_begin(&rest->block, last);
}

/* The first sample of all, or the first after a gap. */
INSOLE_APART static void begin(insole_still_bias_t *rest, const insole_imu_t *imu)
{
    rest->first_us = rest->has_first ? rest->first_us : imu->t_us;
    rest->has_first = true;
    rest->has_before = false;
    block_begin(&rest->block, imu);
}

void insole_still_bias_take(insole_still_bias_t *rest, const insole_imu_t *imu)
{
    insole_still_block_t *b = &rest->block;
    if (!rest->has_first || imu->t_us - rest->last_us > GAP_US) {
        begin(rest, imu);
    }
    rest->last_us = imu->t_us;
    b->count++;
    if (!b->lively) {
        block_add(b, imu);
        if (b->count % 8u == 4u) {
            b->lively = is_lively(rest);
        }
    }
    if ((uint32_t)imu->t_us - b->begin_us >= rest->block_us && b->count > 2u) {
        end_block(rest, imu);
    }
}

insole_status_t insole_still_bias_push(insole_still_bias_t *rest, const insole_imu_t *imu)
{
    if (!rest || !imu) {
        return INSOLE_ERR_NULL;
    }
    bool finite = insole_vec3_is_finite(imu->accel_mps2) && insole_vec3_is_finite(imu->gyro_radps);
    if (!finite || (rest->has_first && imu->t_us <= rest->last_us)) {
        rest->refused++;
        return finite ? INSOLE_ERR_TIME : INSOLE_ERR_VALUE;
    }
    insole_still_bias_take(rest, imu);
    return INSOLE_OK;
}
