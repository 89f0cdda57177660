/* SPDX-License-Identifier: MIT */
#include "insole/move/magnetic.h"

#include <string.h>

#define ZERO INSOLE_R(0.0)

/* No magnetometer in a phone goes beyond; a level field weaker than LEAST_UT has no direction. */
static const insole_real_t MOST_UT = INSOLE_R(1.0e4), LEAST_UT = INSOLE_R(1.0);

/* Intervals of readings that a variance may speak of: a pause does not make the next one sharper.
 */
static const insole_real_t SHORTEST_S = INSOLE_R(1.0e-3), LONGEST_S = INSOLE_R(1.0);

const insole_magnetic_config_t insole_magnetic_defaults = {
    INSOLE_MAGNETIC_KEYS(INSOLE_CONFIG_DEFAULT)};

static insole_status_t refuse(insole_magnetic_t *magnetic, insole_status_t why)
{
    magnetic->refused++;
    return why;
}

static bool is_field(insole_vec3_t v)
{
    return insole_vec3_is_within(v, MOST_UT);
}

insole_status_t insole_magnetic_check(const insole_magnetic_config_t *config)
{
    typedef insole_magnetic_config_t config_t;
    static const insole_config_range_t ranges[] = {INSOLE_MAGNETIC_KEYS(INSOLE_CONFIG_RANGE)};
    return insole_config_check(config, ranges, sizeof ranges / sizeof ranges[0]);
}

insole_status_t insole_magnetic_init(insole_magnetic_t *magnetic,
                                     const insole_magnetic_config_t *config)
{
    if (!magnetic || !config) {
        return INSOLE_ERR_NULL;
    }
    if (insole_magnetic_check(config) != INSOLE_OK) {
        return INSOLE_ERR_VALUE;
    }
    memset(magnetic, 0, sizeof *magnetic);
    magnetic->config = *config;
    return INSOLE_OK;
}

insole_status_t insole_magnetic_set_field(insole_magnetic_t *magnetic, insole_vec3_t field_ut)
{
    if (!magnetic) {
        return INSOLE_ERR_NULL;
    }
    if (!is_field(field_ut)) {
        return refuse(magnetic, INSOLE_ERR_VALUE);
    }
    magnetic->field_ut = field_ut;
    magnetic->told = insole_vec3_max_abs(field_ut) > ZERO;
    magnetic->learned = 0u;
    return INSOLE_OK;
}

/* Difference of two fields in what no heading changes: strength and dip. */
static insole_real_t deviation_of(insole_vec3_t a, insole_vec3_t b)
{
    return insole_sqrt(insole_square(insole_vec3_level(a) - insole_vec3_level(b)) +
                       insole_square(a.z - b.z));
}

static void learn(insole_magnetic_t *magnetic, insole_vec3_t field_n)
{
    magnetic->learned++;
    insole_vec3_t apart = insole_vec3_sub(field_n, magnetic->field_ut);
    insole_real_t weight = INSOLE_R(1.0) / (insole_real_t)magnetic->learned;
    magnetic->field_ut = insole_vec3_add_scaled(magnetic->field_ut, weight, apart);
    magnetic->told = magnetic->learned >= (uint32_t)magnetic->config.readings;
}

static void correct(insole_magnetic_t *magnetic, insole_attitude_t *att,
                    insole_attitude_method_t *method, insole_vec3_t field_n, insole_real_t dt_s)
{
    const insole_magnetic_config_t *c = &magnetic->config;
    insole_trust_t trust = {c->noise_ut_rts, c->soft_ut, c->gate_ut};
    magnetic->deviation_ut = deviation_of(field_n, magnetic->field_ut);
    insole_sighting_t field = {magnetic->field_ut, field_n, /* [PhoneUKF (11)-(12)] */
                               insole_trust_variance(&trust, magnetic->deviation_ut, dt_s)};
    bool used = field.variance > ZERO && insole_attitude_observe(att, method, &field) == INSOLE_OK;
    magnetic->corrected += used ? 1u : 0u;
    magnetic->passed += used ? 0u : 1u;
}

static bool is_timely(const insole_magnetic_t *magnetic, const insole_attitude_t *att,
                      uint64_t t_us)
{
    insole_real_t off_s =
        t_us > att->t_us ? insole_seconds(att->t_us, t_us) : insole_seconds(t_us, att->t_us);
    return (!magnetic->has_time || t_us > magnetic->t_us) && off_s <= att->config.gap_s;
}

insole_status_t insole_magnetic_push(insole_magnetic_t *magnetic, insole_attitude_t *att,
                                     insole_attitude_method_t *method, const insole_mag_t *mag)
{
    if (!magnetic || !att || !method || !mag) {
        return INSOLE_ERR_NULL;
    }
    if (!is_field(mag->field_ut)) {
        return refuse(magnetic, INSOLE_ERR_VALUE);
    }
    if (!att->aligned || att->levelling) {
        return refuse(magnetic, INSOLE_ERR_STATE);
    }
    if (!is_timely(magnetic, att, mag->t_us)) {
        return refuse(magnetic, INSOLE_ERR_TIME);
    }
    insole_real_t dt_s =
        magnetic->has_time ? insole_seconds(magnetic->t_us, mag->t_us) : SHORTEST_S;
    magnetic->has_time = true;
    magnetic->t_us = mag->t_us;
    insole_vec3_t field_n = insole_quat_rotate(att->q, mag->field_ut);
    if (!magnetic->told) {
        learn(magnetic, field_n);
    } else if (magnetic->config.use == 1) {
        dt_s = insole_min(insole_max(dt_s, SHORTEST_S), LONGEST_S);
        correct(magnetic, att, method, field_n, dt_s);
    }
    return INSOLE_OK;
}

insole_status_t insole_magnetic_azimuth(const insole_attitude_t *att, insole_vec3_t field_b_ut,
                                        insole_real_t *azimuth_rad)
{
    if (!att || !azimuth_rad) {
        return INSOLE_ERR_NULL;
    }
    if (!is_field(field_b_ut)) {
        return INSOLE_ERR_VALUE;
    }
    insole_vec3_t field_n = insole_quat_rotate(att->q, field_b_ut);
    if (!att->aligned || insole_vec3_level(field_n) < LEAST_UT) {
        return INSOLE_ERR_STATE;
    }
    *azimuth_rad = insole_atan2(field_n.y, field_n.x);
    return INSOLE_OK;
}
