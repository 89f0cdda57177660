/* SPDX-License-Identifier: MIT */
#include "sim/imu_model.h"

#include <stdlib.h>
#include <string.h>

#include "near.h"
#include "suite.h"

static const sim_vec3_t nothing = {0.0, 0.0, 0.0};
static const sim_vec3_t up = {0.0, 0.0, 9.81};

/* A full sensor with every error switched off. */
static sim_imu_settings_t perfect(void)
{
    sim_imu_settings_t s = sim_settings_defaults.imu;
    s.accel_noise_mps2_rthz = s.gyro_noise_radps_rthz = 0.0;
    s.accel_bias_mps2 = s.gyro_bias_radps = s.accel_drift_mps2 = s.gyro_drift_radps = 0.0;
    s.accel_scale = s.gyro_scale = s.accel_skew_rad = s.gyro_skew_rad = 0.0;
    s.gyro_g_radps_per_mps2 = s.warm_up_k = s.accel_per_k_mps2 = s.gyro_per_k_radps = 0.0;
    s.accel_step_mps2 = s.gyro_step_radps = 0.0;
    return s;
}

static void get(const insole_imu_t *sample, double axes[6])
{
    axes[0] = (double)sample->accel_mps2.x;
    axes[1] = (double)sample->accel_mps2.y;
    axes[2] = (double)sample->accel_mps2.z;
    axes[3] = (double)sample->gyro_radps.x;
    axes[4] = (double)sample->gyro_radps.y;
    axes[5] = (double)sample->gyro_radps.z;
}

/* n samples of a sensor that feels the same all the time; lost ones are left out. */
typedef struct {
    size_t count;
    double (*axes)[6];
    uint64_t *t_us;
    sim_imu_t imu;
} record_t;

static record_t record(const sim_imu_settings_t *settings, uint64_t seed, size_t n,
                       sim_vec3_t force, sim_vec3_t rate)
{
    record_t r = {
        .count = 0, .axes = malloc(n * sizeof *r.axes), .t_us = malloc(n * sizeof *r.t_us)};
    ck_assert(r.axes != NULL && r.t_us != NULL);
    sim_imu_init(&r.imu, settings, seed);
    for (size_t i = 0; i < n; i++) {
        insole_imu_t sample;
        if (sim_imu_read(&r.imu, (double)i / settings->rate_hz, force, rate, &sample)) {
            get(&sample, r.axes[r.count]);
            r.t_us[r.count++] = sample.t_us;
        }
    }
    return r;
}

static void free_record(record_t *r)
{
    free(r->axes);
    free(r->t_us);
}

static double mean_of(const record_t *r, int axis)
{
    double sum = 0.0;
    for (size_t i = 0; i < r->count; i++) {
        sum += r->axes[i][axis];
    }
    return sum / (double)r->count;
}

/* Covariance of samples `lag` apart. */
static double covariance_of(const record_t *r, int axis, size_t lag)
{
    double mean = mean_of(r, axis), sum = 0.0;
    for (size_t i = 0; i + lag < r->count; i++) {
        sum += (r->axes[i][axis] - mean) * (r->axes[i + lag][axis] - mean);
    }
    return sum / (double)(r->count - lag);
}

/* Allan deviation of averages over m samples. */
static double allan_of(const record_t *r, int axis, size_t m)
{
    double last = 0.0, sum = 0.0;
    size_t blocks = r->count / m;
    for (size_t b = 0; b < blocks; b++) {
        double mean = 0.0;
        for (size_t i = b * m; i < (b + 1) * m; i++) {
            mean += r->axes[i][axis] / (double)m;
        }
        sum += b == 0 ? 0.0 : (mean - last) * (mean - last);
        last = mean;
    }
    return sqrt(0.5 * sum / (double)(blocks - 1));
}

START_TEST(a_sensor_without_errors_reads_the_truth)
{
    sim_imu_settings_t full = perfect(), ideal = sim_settings_defaults.imu;
    ideal.model = SIM_MODEL_IDEAL;
    sim_vec3_t force = sim_vec3(1.5, -2.25, 9.75), rate = sim_vec3(-0.5, 3.0, 0.125);
    const sim_imu_settings_t *both[] = {&full, &ideal};
    for (int k = 0; k < 2; k++) {
        record_t r = record(both[k], 7, 100, force, rate);
        const double truth[6] = {1.5, -2.25, 9.75, -0.5, 3.0, 0.125};
        ck_assert_uint_eq(r.count, 100u);
        for (size_t i = 0; i < r.count; i++) {
            ck_assert_mem_eq(r.axes[i], truth, sizeof truth);
            ck_assert_uint_eq(r.t_us[i], 5000u * i);
        }
        free_record(&r);
    }
}
END_TEST

static const double rates[] = {50.0, 200.0, 1000.0};

START_TEST(white_noise_is_as_dense_as_told)
{
    sim_imu_settings_t s = sim_settings_defaults.imu;
    s.model = SIM_MODEL_MATCHED;
    s.rate_hz = rates[_i];
    size_t n = (size_t)(400.0 * rates[_i]), second = (size_t)rates[_i];
    record_t r = record(&s, 11, n, up, nothing);
    for (int axis = 0; axis < 6; axis++) {
        double density = axis < 3 ? s.accel_noise_mps2_rthz : s.gyro_noise_radps_rthz;
        double sigma = density * sqrt(s.rate_hz), variance = covariance_of(&r, axis, 0);
        double few = 4.0 / sqrt((double)n); /* four sigmas of an estimate from n samples */
        ASSERT_NEAR(variance / (sigma * sigma), 1.0, few * sqrt(2.0), "1");
        ASSERT_NEAR(covariance_of(&r, axis, 1) / variance, 0.0, few, "1");
        ASSERT_NEAR(mean_of(&r, axis), axis == 2 ? 9.81 : 0.0, sigma * few + 1e-6, "");
        /* over 1 s the density itself, over 4 s half of it; 400 and 100 blocks */
        ASSERT_NEAR(allan_of(&r, axis, second) / density, 1.0, 0.16, "1");
        ASSERT_NEAR(allan_of(&r, axis, 4u * second) / density, 0.5, 0.16, "1");
    }
    free_record(&r);
}
END_TEST

START_TEST(noise_is_normal_and_axes_are_independent)
{
    sim_imu_settings_t s = sim_settings_defaults.imu;
    s.model = SIM_MODEL_MATCHED;
    record_t r = record(&s, 12, 60000, nothing, nothing);
    double sigma = s.gyro_noise_radps_rthz * sqrt(s.rate_hz), cross = 0.0;
    size_t beyond1 = 0, beyond3 = 0;
    for (size_t i = 0; i < r.count; i++) {
        double u = r.axes[i][3] / sigma, v = r.axes[i][4] / sigma;
        beyond1 += fabs(u) > 1.0 ? 1u : 0u;
        beyond3 += fabs(u) > 3.0 ? 1u : 0u;
        cross += u * v / (double)r.count;
    }
    ASSERT_NEAR((double)beyond1 / (double)r.count, 0.3173, 0.0076, "1");
    ASSERT_NEAR((double)beyond3 / (double)r.count, 0.0027, 0.00085, "1");
    ASSERT_NEAR(cross, 0.0, 0.0165, "1");
    free_record(&r);
}
END_TEST

START_TEST(matched_has_noise_and_nothing_else)
{
    sim_imu_settings_t s = sim_settings_defaults.imu, quiet;
    s.model = SIM_MODEL_MATCHED;
    s.stamp_jitter_s = 0.01;
    s.dropouts_hz = 5.0;
    quiet = s;
    quiet.accel_noise_mps2_rthz = quiet.gyro_noise_radps_rthz = 0.0;
    sim_vec3_t huge = sim_vec3(1000.0, -1000.0, 500.0);
    record_t r = record(&quiet, 3, 2000, huge, huge);
    ck_assert_uint_eq(r.count, 2000u);
    for (size_t i = 0; i < r.count; i++) {
        ck_assert(r.axes[i][0] == 1000.0 && r.axes[i][5] == 500.0);
        ck_assert_uint_eq(r.t_us[i], 5000u * i);
    }
    ck_assert_uint_eq(r.imu.clipped, 0u);
    free_record(&r);
}
END_TEST

/* Root mean square over many sensors of what one of them reads too much at t = 0. */
static double spread_of(const sim_imu_settings_t *settings, int axis, sim_vec3_t force,
                        sim_vec3_t rate, double truth)
{
    double sum = 0.0;
    int n = 2000;
    for (int seed = 1; seed <= n; seed++) {
        record_t r = record(settings, (uint64_t)seed, 1, force, rate);
        sum += (r.axes[0][axis] - truth) * (r.axes[0][axis] - truth) / n;
        free_record(&r);
    }
    return sqrt(sum);
}

START_TEST(errors_of_the_unit_are_drawn_with_the_sigma_told)
{
    double few = 4.0 / sqrt(2.0 * 2000.0);
    sim_imu_settings_t s = perfect();
    s.accel_bias_mps2 = 0.2;
    s.gyro_bias_radps = 0.01;
    ASSERT_NEAR(spread_of(&s, 1, up, nothing, 0.0) / 0.2, 1.0, few, "1");
    ASSERT_NEAR(spread_of(&s, 5, up, nothing, 0.0) / 0.01, 1.0, few, "1");
    s = perfect();
    s.accel_scale = 0.01;
    s.gyro_scale = 0.02;
    sim_vec3_t spin = sim_vec3(0.0, 5.0, 0.0);
    ASSERT_NEAR(spread_of(&s, 2, up, spin, 9.81) / (0.01 * 9.81), 1.0, few, "1");
    ASSERT_NEAR(spread_of(&s, 4, up, spin, 5.0) / (0.02 * 5.0), 1.0, few, "1");
    ASSERT_NEAR(spread_of(&s, 3, up, spin, 0.0), 0.0, 1e-7, "rad/s");
    s = perfect();
    s.accel_skew_rad = 0.01;
    s.gyro_skew_rad = 0.02;
    ASSERT_NEAR(spread_of(&s, 0, up, spin, 0.0) / (0.01 * 9.81), 1.0, few, "1");
    ASSERT_NEAR(spread_of(&s, 3, up, spin, 0.0) / (0.02 * 5.0), 1.0, few, "1");
    ASSERT_NEAR(spread_of(&s, 4, up, spin, 5.0), 0.0, 1e-6, "rad/s");
    s = perfect();
    s.gyro_g_radps_per_mps2 = 0.001;
    ASSERT_NEAR(spread_of(&s, 3, up, spin, 0.0) / 0.00981, 1.0, few, "1");
    ASSERT_NEAR(spread_of(&s, 2, up, spin, 9.81), 0.0, 1e-5, "m/s^2");
}
END_TEST

START_TEST(the_bias_wanders_as_told)
{
    sim_imu_settings_t s = perfect();
    s.accel_drift_mps2 = 0.03;
    s.gyro_drift_radps = 0.002;
    s.drift_time_s = 2.0;
    s.rate_hz = 100.0;
    record_t r = record(&s, 5, 800000, nothing, nothing); /* 4,000 correlation times */
    for (int axis = 0; axis < 6; axis++) {
        double sigma = axis < 3 ? 0.03 : 0.002, variance = covariance_of(&r, axis, 0);
        ASSERT_NEAR(variance / (sigma * sigma), 1.0, 0.1, "1");
        ASSERT_NEAR(covariance_of(&r, axis, 200) / variance, exp(-1.0), 0.07, "1");
        ASSERT_NEAR(covariance_of(&r, axis, 400) / variance, exp(-2.0), 0.07, "1");
    }
    free_record(&r);
}
END_TEST

START_TEST(the_random_walk_grows_as_told)
{
    sim_imu_settings_t s = perfect();
    s.gyro_walk_radps_rts = 1e-3;
    s.accel_walk_mps2_rts = 1e-2;
    s.rate_hz = 60.0;
    double gyro = 0.0, accel = 0.0;
    int n = 600;
    for (int seed = 1; seed <= n; seed++) {
        record_t r = record(&s, (uint64_t)seed, 60u * 9u + 1u, nothing, nothing);
        gyro += r.axes[r.count - 1][3] * r.axes[r.count - 1][3] / n;
        accel += r.axes[r.count - 1][0] * r.axes[r.count - 1][0] / n;
        free_record(&r);
    }
    ASSERT_NEAR(sqrt(gyro) / 3e-3, 1.0, 0.12, "1"); /* sqrt(9 s) */
    ASSERT_NEAR(sqrt(accel) / 3e-2, 1.0, 0.12, "1");
}
END_TEST

START_TEST(warmth_moves_the_bias)
{
    sim_imu_settings_t s = perfect();
    s.warm_up_k = 10.0;
    s.warm_up_s = 50.0;
    s.gyro_per_k_radps = 0.001;
    s.rate_hz = 100.0;
    record_t r = record(&s, 2, 20001, nothing, nothing);
    double k = r.imu.gyro.per_kelvin.y;
    ck_assert(k != 0.0);
    ASSERT_NEAR(r.axes[0][4], 0.0, 1e-12, "rad/s");
    ASSERT_NEAR(r.axes[5000][4], k * 10.0 * (1.0 - exp(-1.0)), 1e-8, "rad/s");
    ASSERT_NEAR(r.axes[20000][4], k * 10.0 * (1.0 - exp(-4.0)), 1e-8, "rad/s");
    ASSERT_NEAR(r.axes[20000][1], 0.0, 1e-12, "m/s^2");
    free_record(&r);
}
END_TEST

START_TEST(readings_stop_at_the_range)
{
    sim_imu_settings_t s = perfect();
    s.accel_range_mps2 = 100.0;
    s.gyro_range_radps = 10.0;
    record_t r = record(&s, 1, 10, sim_vec3(-500.0, 99.0, 0.0), sim_vec3(0.0, 10.5, -9.9));
    ck_assert(r.axes[0][0] == -100.0 && r.axes[0][1] == 99.0);
    ck_assert(r.axes[0][4] == 10.0);
    ASSERT_NEAR(r.axes[0][5], -9.9, 1e-6, "rad/s");
    ck_assert_uint_eq(r.imu.clipped, 10u);
    free_record(&r);
}
END_TEST

START_TEST(soft_clipping_bends_but_never_turns_back)
{
    sim_imu_settings_t s = perfect();
    s.gyro_range_radps = 10.0;
    s.clip = SIM_CLIP_SOFT;
    double last = -10.1;
    for (double truth = -30.0; truth <= 30.0; truth += 0.25) {
        record_t r = record(&s, 1, 1, nothing, sim_vec3(truth, 0.0, 0.0));
        double read = r.axes[0][3];
        ASSERT_AT_LEAST(read, last, "rad/s");
        ASSERT_AT_MOST(fabs(read), 10.0, "rad/s");
        if (fabs(truth) <= 9.0) {
            ASSERT_NEAR(read, truth, 1e-6, "rad/s");
        }
        last = read;
        free_record(&r);
    }
    record_t edge = record(&s, 1, 1, nothing, sim_vec3(9.5, 0.0, 0.0));
    ASSERT_NEAR(edge.axes[0][3], 9.0 + tanh(0.5), 1e-6, "rad/s");
    free_record(&edge);
}
END_TEST

START_TEST(readings_come_in_steps)
{
    sim_imu_settings_t s = sim_settings_defaults.imu;
    record_t r = record(&s, 4, 500, up, sim_vec3(0.3, -0.2, 0.1));
    for (size_t i = 0; i < r.count; i++) {
        for (int axis = 0; axis < 6; axis++) {
            double step = axis < 3 ? s.accel_step_mps2 : s.gyro_step_radps;
            double steps = r.axes[i][axis] / step;
            ASSERT_NEAR(steps, round(steps), 2e-4, "1"); /* float has 24 bits */
        }
    }
    free_record(&r);
    s = perfect();
    s.accel_step_mps2 = 0.5;
    record_t coarse = record(&s, 4, 1, sim_vec3(0.26, -0.24, 9.81), nothing);
    ck_assert(coarse.axes[0][0] == 0.5 && coarse.axes[0][1] == 0.0 && coarse.axes[0][2] == 10.0);
    free_record(&coarse);
}
END_TEST

START_TEST(lost_samples_come_in_gaps_and_are_counted)
{
    sim_imu_settings_t s = perfect();
    s.dropouts_hz = 0.5;
    s.dropout_s = 0.1;
    record_t r = record(&s, 21, 400000, up, nothing); /* 2,000 s */
    size_t gaps = 0, lost = 0;
    for (size_t i = 1; i < r.count; i++) {
        uint64_t step = r.t_us[i] - r.t_us[i - 1];
        gaps += step > 5000u ? 1u : 0u;
        lost += (size_t)(step / 5000u - 1u);
    }
    ck_assert_uint_eq(r.imu.given, r.count);
    ck_assert_uint_eq(r.imu.given + r.imu.lost, 400000u);
    ASSERT_NEAR((double)lost, (double)r.imu.lost, 200.0, "samples"); /* but for the ends */
    ASSERT_NEAR((double)gaps, 0.5 * 2000.0 * 0.95, 130.0, "gaps");
    /* a gap begins at a sample, so that on average half an interval more is lost */
    ASSERT_NEAR((double)lost / (double)gaps / 200.0, 0.1025, 0.012, "s");
    free_record(&r);
}
END_TEST

START_TEST(stamps_are_wrong_as_told_but_grow)
{
    sim_imu_settings_t s = perfect();
    s.stamp_jitter_s = 0.0005;
    record_t r = record(&s, 8, 20000, up, nothing);
    double sum2 = 0.0;
    for (size_t i = 1; i < r.count; i++) {
        double wrong = 1e-6 * (double)r.t_us[i] - 0.005 * (double)i;
        sum2 += wrong * wrong / (double)r.count;
        ck_assert(r.t_us[i] > r.t_us[i - 1]);
    }
    ASSERT_NEAR(sqrt(sum2), 0.0005, 0.00002, "s");
    free_record(&r);
    s.stamp_jitter_s = 0.05;
    r = record(&s, 8, 2000, up, nothing);
    for (size_t i = 1; i < r.count; i++) {
        ck_assert(r.t_us[i] > r.t_us[i - 1]);
    }
    free_record(&r);
}
END_TEST

START_TEST(a_lost_sample_is_left_untouched)
{
    sim_imu_settings_t s = perfect();
    s.dropouts_hz = 10.0;
    s.dropout_s = 10.0;
    sim_imu_t imu;
    insole_imu_t sample, before;
    memset(&before, 0x5a, sizeof before);
    sim_imu_init(&imu, &s, 1);
    int lost = 0;
    for (int i = 0; i < 1000; i++) {
        memcpy(&sample, &before, sizeof sample);
        if (!sim_imu_read(&imu, i / 200.0, up, nothing, &sample)) {
            ck_assert_mem_eq(&sample, &before, sizeof sample);
            lost++;
        }
    }
    ck_assert_int_gt(lost, 500);
}
END_TEST

START_TEST(equal_seeds_are_equal_sensors)
{
    sim_imu_settings_t s = sim_settings_defaults.imu;
    s.stamp_jitter_s = 0.001;
    s.dropouts_hz = 1.0;
    record_t a = record(&s, 31, 3000, up, nothing), b = record(&s, 31, 3000, up, nothing);
    record_t c = record(&s, 32, 3000, up, nothing);
    ck_assert_uint_eq(a.count, b.count);
    ck_assert_mem_eq(a.axes, b.axes, a.count * sizeof *a.axes);
    ck_assert_mem_eq(a.t_us, b.t_us, a.count * sizeof *a.t_us);
    ck_assert_mem_ne(a.axes, c.axes, 100u * sizeof *a.axes);
    free_record(&a);
    free_record(&b);
    free_record(&c);
}
END_TEST

START_TEST(one_error_does_not_change_the_others)
{
    sim_imu_settings_t s = perfect();
    s.gyro_noise_radps_rthz = 1e-3;
    s.gyro_bias_radps = 0.01;
    record_t plain = record(&s, 6, 1000, up, nothing);
    s.gyro_drift_radps = 0.5;
    s.stamp_jitter_s = 0.001;
    s.accel_noise_mps2_rthz = 0.01;
    record_t more = record(&s, 6, 1000, up, nothing);
    s.gyro_drift_radps = 0.0;
    s.dropouts_hz = 3.0;
    record_t fewer = record(&s, 6, 1000, up, nothing);
    ck_assert_uint_lt(fewer.count, 1000u);
    ck_assert(plain.imu.gyro.turn_on.x == more.imu.gyro.turn_on.x);
    ck_assert(plain.axes[0][3] == fewer.axes[0][3] && plain.axes[0][3] != more.axes[0][3]);
    size_t k = 0;
    for (size_t i = 0; i < fewer.count; i++) {
        while (k < 1000u && plain.axes[k][3] != fewer.axes[i][3]) {
            k++;
        }
        ck_assert_msg(k < 1000u, "sample %zu has another noise", i);
    }
    free_record(&plain);
    free_record(&more);
    free_record(&fewer);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("sim/imu_model");
    suite_add(suite, "ideal", a_sensor_without_errors_reads_the_truth);
    suite_add_loop(suite, "noise density", white_noise_is_as_dense_as_told, 3);
    suite_add(suite, "noise", noise_is_normal_and_axes_are_independent);
    suite_add(suite, "matched", matched_has_noise_and_nothing_else);
    suite_add(suite, "unit", errors_of_the_unit_are_drawn_with_the_sigma_told);
    suite_add(suite, "drift", the_bias_wanders_as_told);
    suite_add(suite, "random walk", the_random_walk_grows_as_told);
    suite_add(suite, "temperature", warmth_moves_the_bias);
    suite_add(suite, "range", readings_stop_at_the_range);
    suite_add(suite, "soft range", soft_clipping_bends_but_never_turns_back);
    suite_add(suite, "steps", readings_come_in_steps);
    suite_add(suite, "gaps", lost_samples_come_in_gaps_and_are_counted);
    suite_add(suite, "stamps", stamps_are_wrong_as_told_but_grow);
    suite_add(suite, "untouched", a_lost_sample_is_left_untouched);
    suite_add(suite, "seeds", equal_seeds_are_equal_sensors);
    suite_add(suite, "streams", one_error_does_not_change_the_others);
    return suite;
}
