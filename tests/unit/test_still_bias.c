/* SPDX-License-Identifier: MIT */
#include "insole/sense/still_bias.h"

#include "near.h"
#include "refusal.h"
#include "setting.h"
#include "suite.h"
#include "walk_samples.h"

#define PI 3.14159265358979323846

static const double BIAS[3] = {0.011, -0.024, 0.035};

typedef struct {
    insole_still_bias_t rest;
    insole_rng_t rng;
    double rate_hz, t_s;
    double bias[3], gravity;
    double accel_noise, gyro_noise;
} bench_t;

static bench_t bench(double rate_hz, uint64_t seed)
{
    bench_t b = {
        .rate_hz = rate_hz, .t_s = 5.0, .gravity = 9.83, .accel_noise = 0.03, .gyro_noise = 0.005};
    memcpy(b.bias, BIAS, sizeof b.bias);
    insole_rng_seed(&b.rng, seed);
    ck_assert_int_eq(insole_still_bias_init(&b.rest, &insole_still_bias_defaults), INSOLE_OK);
    return b;
}

/* A sensor that lies on its side, turned by the rates `sway` and tilted by the angle `tilt`. */
static insole_imu_t reading(bench_t *b, const double sway[3], double tilt)
{
    const double up[3] = {cos(tilt), 0.0, sin(tilt)};
    insole_real_t a[3], w[3];
    for (int i = 0; i < 3; i++) {
        a[i] = (insole_real_t)(b->gravity * up[i] +
                               b->accel_noise * (double)insole_rng_normal(&b->rng));
        w[i] = (insole_real_t)(b->bias[i] + sway[i] +
                               b->gyro_noise * (double)insole_rng_normal(&b->rng));
    }
    insole_imu_t imu = {(uint64_t)llround(b->t_s * 1.0e6), insole_vec3(a[0], a[1], a[2]),
                        insole_vec3(w[0], w[1], w[2])};
    return imu;
}

static void sway_for(bench_t *b, double time_s, double radps, double hz, int axis)
{
    for (int i = 0, n = (int)lround(time_s * b->rate_hz); i < n; i++) {
        b->t_s += 1.0 / b->rate_hz;
        double sway[3] = {0.0, 0.0, 0.0}, angle = 2.0 * PI * hz * b->t_s;
        sway[axis] = radps * sin(angle);
        double tilt = axis == 1 && hz > 0.0 ? radps * cos(angle) / (2.0 * PI * hz) : 0.0;
        insole_imu_t imu = reading(b, sway, tilt);
        ck_assert_int_eq(insole_still_bias_push(&b->rest, &imu), INSOLE_OK);
    }
}

static void rest_for(bench_t *b, double time_s)
{
    sway_for(b, time_s, 0.0, 0.0, 0);
}

static double error_of(const bench_t *b, int axis)
{
    const insole_vec3_t v = b->rest.gyro_bias_radps;
    const insole_real_t told[3] = {v.x, v.y, v.z};
    return (double)told[axis] - b->bias[axis];
}

static double worst_error(const bench_t *b)
{
    return fmax(fmax(fabs(error_of(b, 0)), fabs(error_of(b, 1))), fabs(error_of(b, 2)));
}

/* No error of 150 is beyond 3.5 of the sigmas told, and these are small after three seconds. */
START_TEST(a_rest_tells_bias_and_gravity)
{
    static const double RATES_HZ[] = {60.0, 100.0, 200.0, 250.0};
    worst_t sigmas = {0.0, 0.0}, gravity = {0.0, 0.0};
    for (uint64_t seed = 0u; seed < 50u; seed++) {
        bench_t b = bench(RATES_HZ[_i], seed);
        rest_for(&b, 3.0);
        const insole_vec3_t var = b.rest.variance_radps2;
        const double v[3] = {(double)var.x, (double)var.y, (double)var.z};
        for (int axis = 0; axis < 3; axis++) {
            worst_note(&sigmas, fabs(error_of(&b, axis)) / sqrt(v[axis]), (double)seed);
            ASSERT_AT_MOST(sqrt(v[axis]), 0.0025, "rad/s");
        }
        worst_note(&gravity, fabs((double)b.rest.gravity_mps2 - b.gravity), (double)seed);
    }
    ASSERT_WORST(sigmas, 3.5, "sigma");
    ASSERT_WORST(gravity, 0.01, "m/s^2");
}
END_TEST

/* Blocks of 25 samples at 200 Hz, the first of 26: each but the first of a run tells something. */
START_TEST(every_second_block_of_a_run_counts)
{
    bench_t b = bench(200.0, 1u);
    rest_for(&b, 1.006);
    ck_assert_uint_eq(b.rest.rests, 7u);
    ck_assert_uint_eq(b.rest.gravity_rests, 7u);
    b.t_s += 0.2; /* what was begun is thrown away, and the blocks before do not count */
    rest_for(&b, 0.131);
    ck_assert_uint_eq(b.rest.rests, 7u);
    rest_for(&b, 0.125);
    ck_assert_uint_eq(b.rest.rests, 8u);
}
END_TEST

/* Without the first sample after the gap nothing would join the two biases. */
START_TEST(a_gap_never_joins_two_sides)
{
    bench_t b = bench(200.0, 2u);
    b.gyro_noise = b.accel_noise = 0.0;
    for (int i = 0; i < 40; i++) {
        rest_for(&b, 0.2);
        b.t_s += 0.15;
        b.bias[0] = (i & 1) != 0 ? 0.01 : 0.012;
    }
    ck_assert_uint_eq(b.rest.rests, 0u);
}
END_TEST

START_TEST(gravity_is_told_by_the_first_seconds_alone)
{
    bench_t b = bench(200.0, 3u);
    rest_for(&b, 3.0);
    double early = (double)b.rest.gravity_mps2;
    b.t_s += 1.5;
    b.gravity = 9.6;
    rest_for(&b, 3.0);
    ASSERT_NEAR(b.rest.gravity_mps2, early, 0.0, "m/s^2");
    ck_assert_uint_gt(b.rest.rests, 40u);
}
END_TEST

START_TEST(no_gravity_from_a_sensor_of_another_unit)
{
    bench_t b = bench(200.0, 4u);
    b.gravity = 1.0;
    b.accel_noise = 0.003;
    rest_for(&b, 3.0);
    ck_assert_uint_gt(b.rest.rests, 10u);
    ASSERT_NEAR(b.rest.gravity_mps2, insole_still_bias_defaults.gravity_mps2, 0.0, "m/s^2");
}
END_TEST

START_TEST(what_is_switched_off_is_not_learned)
{
    insole_still_bias_config_t config = insole_still_bias_defaults;
    bench_t b = bench(200.0, 5u);
    config.quiet_gyro_radps = 0;
    ck_assert_int_eq(insole_still_bias_init(&b.rest, &config), INSOLE_OK);
    rest_for(&b, 3.0);
    ck_assert_uint_eq(b.rest.rests, 0u);
    config = insole_still_bias_defaults;
    config.gravity_s = 0;
    ck_assert_int_eq(insole_still_bias_init(&b.rest, &config), INSOLE_OK);
    rest_for(&b, 3.0);
    ck_assert_uint_gt(b.rest.rests, 20u);
    ck_assert_uint_eq(b.rest.gravity_rests, 0u);
    ASSERT_NEAR(b.rest.gravity_mps2, config.gravity_mps2, 0.0, "m/s^2");
}
END_TEST

/* Somebody who stands and sways: the turning points look like rest, but balance each other. */
START_TEST(sway_is_not_taken_for_bias)
{
    const double hz = 0.25 + 0.25 * (_i / 2), radps = 0.03;
    const int axis = (_i & 1) != 0 ? 1 : 2;
    bench_t b = bench(200.0, 6u);
    rest_for(&b, 1.0);
    sway_for(&b, 20.0, radps, hz, axis);
    ASSERT_AT_MOST(worst_error(&b), radps / 3.0, "rad/s");
}
END_TEST

/* A shaking hand or a running engine is no rest. */
START_TEST(what_shakes_does_not_rest)
{
    bench_t b = bench(200.0, 7u);
    b.gyro_noise = 0.05;
    rest_for(&b, 5.0);
    b.gyro_noise = 0.005;
    b.accel_noise = 0.2;
    rest_for(&b, 5.0);
    ck_assert_uint_eq(b.rest.rests, 0u);
}
END_TEST

/* Strides without the rests around them, of every gait and at many rates of rolling. */
START_TEST(stances_never_feed_it)
{
    static const double ROLL_RADPS[] = {0.13, 0.15, 0.2, 0.25, 0.4, 0.8};
    const walk_t *gaits[] = {&WALK, &RUN, &STAIRS, &CRAWL};
    walk_t walk = *gaits[_i % 4];
    walk.roll_radps = ROLL_RADPS[_i / 4];
    walk.strides = 40;
    insole_still_bias_t rest;
    insole_rng_t rng;
    insole_rng_seed(&rng, 8u);
    ck_assert_int_eq(insole_still_bias_init(&rest, &insole_still_bias_defaults), INSOLE_OK);
    const double dt = 0.005;
    for (double t = walk.rest_s; t < walk_end_s(&walk) - walk.rest_s; t += dt) {
        insole_imu_t imu = walk_sample(&walk, t - dt, t, &rng);
        ck_assert_int_eq(insole_still_bias_push(&rest, &imu), INSOLE_OK);
    }
    ck_assert_uint_eq(rest.rests, 0u);
    ASSERT_NEAR(insole_vec3_norm(rest.gyro_bias_radps), 0.0, 0.0, "rad/s");
}
END_TEST

/* It grows warm on the way: the next stand still tells, and the uncertainty told knows it. */
START_TEST(later_rests_follow_the_bias)
{
    bench_t b = bench(200.0, 9u);
    rest_for(&b, 3.0);
    double sigma = sqrt((double)b.rest.variance_radps2.x);
    b.gyro_noise = 3.0;
    rest_for(&b, 300.0);
    double grown = sqrt((double)b.rest.variance_radps2.x);
    ASSERT_NEAR(grown, sqrt(sigma * sigma + 300.0 * 4.0e-8), 1.0e-5, "rad/s");
    b.gyro_noise = 0.005;
    b.bias[0] += 0.006;
    rest_for(&b, 2.0);
    ASSERT_AT_MOST(worst_error(&b), 0.0015, "rad/s");
}
END_TEST

/* ---- against blocks that are summed to their end ---- */

enum { BLOCK = 25, LONGEST = BLOCK + 1 }; /* the first holds the sample that begins it as well */

typedef struct {
    double mean[6], var_accel, var_gyro;
} whole_t;

static whole_t whole_block(const insole_imu_t *of, int count)
{
    whole_t w = {{0.0}, 0.0, 0.0};
    for (int pass = 0; pass < 2; pass++) {
        for (int i = 0; i < count; i++) {
            const insole_vec3_t a = of[i].accel_mps2, g = of[i].gyro_radps;
            const double v[6] = {(double)a.x, (double)a.y, (double)a.z,
                                 (double)g.x, (double)g.y, (double)g.z};
            for (int axis = 0; axis < 6; axis++) {
                double *var = axis < 3 ? &w.var_accel : &w.var_gyro;
                double off = v[axis] - w.mean[axis];
                *(pass == 0 ? &w.mean[axis] : var) += (pass == 0 ? v[axis] : off * off) / count;
            }
        }
    }
    return w;
}

static bool agree(const double *a, const double *b, double var, double apart, double quiet)
{
    double d2 = 0.0;
    for (int axis = 0; axis < 3; axis++) {
        d2 += (a[axis] - b[axis]) * (a[axis] - b[axis]);
    }
    return sqrt(d2) < apart && 0.5 * var + 0.25 * d2 < quiet * quiet;
}

static bool is_rest(const whole_t *a, const whole_t *b)
{
    const insole_still_bias_config_t *c = &insole_still_bias_defaults;
    return agree(a->mean, b->mean, a->var_accel + b->var_accel, (double)c->agree_mps2,
                 (double)c->quiet_accel_mps2) &&
           agree(a->mean + 3, b->mean + 3, a->var_gyro + b->var_gyro, (double)c->agree_radps,
                 (double)c->quiet_gyro_radps);
}

/* Quiet spells and spells of all sizes of shaking, and blows: what is not summed to its end would
 * not have been a rest. */
START_TEST(what_is_left_out_would_tell_nothing)
{
    bench_t b = bench(200.0, 20u + (uint64_t)_i);
    whole_t now, before = {{0.0}, 0.0, 0.0};
    insole_imu_t block[LONGEST];
    uint32_t rests = 0u, lively = 0u;
    const double none[3] = {0.0, 0.0, 0.0};
    for (int n = 0; n < 400; n++) {
        int count = n == 0 ? LONGEST : BLOCK;
        b.gyro_noise = 0.003 * exp(6.0 * fmax(0.0, 2.0 * (double)insole_rng_uniform(&b.rng) - 1.0));
        b.accel_noise = 4.0 * b.gyro_noise;
        for (int i = 0; i < count; i++) {
            b.t_s += 0.005;
            block[i] = reading(&b, none, 0.0);
            block[i].accel_mps2.y += insole_rng_uniform(&b.rng) > INSOLE_R(0.999) ? 20 : 0;
            lively += b.rest.block.lively ? 1u : 0u;
            insole_still_bias_take(&b.rest, &block[i]);
        }
        now = whole_block(block, count);
        rests += n > 0 && is_rest(&now, &before) ? 1u : 0u;
        ck_assert_uint_eq(b.rest.rests, rests);
        before = now;
    }
    ck_assert_uint_gt(rests, 20u);
    ck_assert_uint_gt(lively, 50u * BLOCK);
}
END_TEST

static insole_still_bias_config_t config;

static insole_status_t judge(void)
{
    insole_still_bias_t rest;
    memset(&rest, 0x5a, sizeof rest);
    insole_still_bias_t before = rest;
    insole_status_t status = insole_still_bias_init(&rest, &config);
    ck_assert(status == INSOLE_OK || memcmp(&rest, &before, sizeof rest) == 0);
    return status;
}

START_TEST(settings_have_their_ranges)
{
    config = insole_still_bias_defaults;
    INSOLE_STILL_BIAS_KEYS(SETTING_HAS_ENDS)
    insole_still_bias_t rest;
    memset(&rest, 0x5a, sizeof rest);
    ck_assert_int_eq(insole_still_bias_init(NULL, &config), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(rest, insole_still_bias_init(&rest, NULL), INSOLE_ERR_NULL);
}
END_TEST

START_TEST(bad_samples_are_refused)
{
    bench_t b = bench(200.0, 10u);
    rest_for(&b, 1.0);
    const double none[3] = {0.0, 0.0, 0.0};
    b.t_s += 0.005;
    insole_imu_t good = reading(&b, none, 0.0), imu = good;
    insole_still_bias_t *rest = &b.rest;
    ck_assert_int_eq(insole_still_bias_push(NULL, &imu), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(*rest, insole_still_bias_push(rest, NULL), INSOLE_ERR_NULL);
    imu.t_us = rest->last_us;
    ASSERT_REFUSED(*rest, rest->refused, insole_still_bias_push(rest, &imu), INSOLE_ERR_TIME);
    imu.t_us = 0u;
    ASSERT_REFUSED(*rest, rest->refused, insole_still_bias_push(rest, &imu), INSOLE_ERR_TIME);
    imu = good;
    imu.accel_mps2.y = (double)NAN;
    ASSERT_REFUSED(*rest, rest->refused, insole_still_bias_push(rest, &imu), INSOLE_ERR_VALUE);
    imu = good;
    imu.gyro_radps.z = (double)INFINITY;
    ASSERT_REFUSED(*rest, rest->refused, insole_still_bias_push(rest, &imu), INSOLE_ERR_VALUE);
    ck_assert_uint_eq(rest->refused, 4u);
    ck_assert_int_eq(insole_still_bias_push(rest, &good), INSOLE_OK);
}
END_TEST

/* A slow sensor's block ends late and holds three samples at least. */
START_TEST(slow_sensors_get_longer_blocks)
{
    bench_t b = bench(12.0, 11u);
    rest_for(&b, 3.0);
    ck_assert_uint_gt(b.rest.rests, 5u);
    ASSERT_AT_MOST(worst_error(&b), 0.004, "rad/s");
}
END_TEST

START_TEST(what_is_known_to_be_good_is_taken_alike)
{
    bench_t b = bench(200.0, 13u);
    insole_still_bias_t taken = b.rest;
    const double none[3] = {0.0, 0.0, 0.0};
    for (int i = 0; i < 2000; i++) {
        b.t_s += i % 500 == 499 ? 0.2 : 0.005;
        b.gyro_noise = i % 300 > 200 ? 2.0 : 0.005;
        insole_imu_t imu = reading(&b, none, 0.0);
        ck_assert_int_eq(insole_still_bias_push(&b.rest, &imu), INSOLE_OK);
        insole_still_bias_take(&taken, &imu);
        ck_assert_int_eq(memcmp(&b.rest, &taken, sizeof taken), 0);
    }
    ck_assert_uint_gt(taken.rests, 10u);
}
END_TEST

START_TEST(a_copy_goes_on_alike)
{
    bench_t b = bench(200.0, 12u);
    rest_for(&b, 1.03);
    bench_t copy = b;
    rest_for(&b, 2.0);
    rest_for(&copy, 2.0);
    ck_assert_int_eq(memcmp(&b.rest, &copy.rest, sizeof b.rest), 0);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("still_bias");
    suite_add_loop(suite, "rest", a_rest_tells_bias_and_gravity, 4);
    suite_add(suite, "blocks", every_second_block_of_a_run_counts);
    suite_add(suite, "gap", a_gap_never_joins_two_sides);
    suite_add(suite, "gravity", gravity_is_told_by_the_first_seconds_alone);
    suite_add(suite, "unit", no_gravity_from_a_sensor_of_another_unit);
    suite_add(suite, "off", what_is_switched_off_is_not_learned);
    suite_add_loop(suite, "sway", sway_is_not_taken_for_bias, 10);
    suite_add(suite, "shaking", what_shakes_does_not_rest);
    suite_add_loop(suite, "stances", stances_never_feed_it, 24);
    suite_add(suite, "later", later_rests_follow_the_bias);
    suite_add_loop(suite, "lively", what_is_left_out_would_tell_nothing, 6);
    suite_add(suite, "settings", settings_have_their_ranges);
    suite_add(suite, "samples", bad_samples_are_refused);
    suite_add(suite, "slow", slow_sensors_get_longer_blocks);
    suite_add(suite, "unchecked", what_is_known_to_be_good_is_taken_alike);
    suite_add(suite, "copy", a_copy_goes_on_alike);
    return suite;
}
