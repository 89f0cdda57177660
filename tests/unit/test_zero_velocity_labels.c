/* SPDX-License-Identifier: MIT */
#include "insole/sense/zero_velocity.h"

#include "near.h"
#include "refusal.h"
#include "setting.h"
#include "suite.h"
#include "walk_samples.h"

enum { MOST = 20000 };

static insole_zero_velocity_t line;
static insole_labelled_t out[MOST];
static insole_imu_t in[MOST];
static int pushed, count;
static double latest_s; /* longest wait for a sample, up to now */

static void begin(const insole_zero_velocity_config_t *config)
{
    ck_assert_int_eq(insole_zero_velocity_init(&line, config), INSOLE_OK);
    pushed = count = 0;
    latest_s = 0.0;
}

static void drain(void)
{
    while (insole_zero_velocity_next(&line, &out[count]) == INSOLE_OK) {
        count++;
    }
}

static void push(const insole_imu_t *imu)
{
    if (pushed >= MOST) {
        ck_abort_msg("more than %d samples", MOST);
    }
    in[pushed++] = *imu;
    if (insole_zero_velocity_push(&line, imu, (uint8_t)(pushed % 7)) != INSOLE_OK) {
        ck_abort_msg("sample %d was refused", pushed);
    }
    drain();
    if (count < pushed) { /* the oldest that still waits */
        latest_s = fmax(latest_s, 1.0e-6 * (double)(imu->t_us - in[count].t_us));
    }
}

static void finish(void)
{
    ck_assert_int_eq(insole_zero_velocity_finish(&line), INSOLE_OK);
    drain();
}

static void run(const insole_zero_velocity_config_t *config, const walk_t *walk, double rate_hz,
                uint64_t from_us)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 4u);
    begin(config);
    for (int i = 1; i / rate_hz < walk_end_s(walk); i++) {
        insole_imu_t imu = walk_sample(walk, (i - 1) / rate_hz, i / rate_hz, &rng);
        imu.t_us = from_us + (uint64_t)llround(1.0e6 * i / rate_hz);
        push(&imu);
    }
    finish();
}

static double norm2(insole_vec3_t v)
{
    return (double)v.x * (double)v.x + (double)v.y * (double)v.y + (double)v.z * (double)v.z;
}

/* The formulas over the window around sample `k`, which is moved inwards at the ends. */
static double direct(int detector, int k, int half)
{
    const insole_zero_velocity_config_t *c = &insole_zero_velocity_defaults;
    int n = 2 * half + 1, middle = k < half ? half : k > pushed - 1 - half ? pushed - 1 - half : k;
    double g = (double)c->gravity_mps2, s[3] = {0, 0, 0}, a2 = 0, a1 = 0, w2 = 0;
    for (int i = middle - half; i <= middle + half; i++) {
        s[0] += (double)in[i].accel_mps2.x / n;
        s[1] += (double)in[i].accel_mps2.y / n;
        s[2] += (double)in[i].accel_mps2.z / n;
        a2 += norm2(in[i].accel_mps2) / n;
        a1 += sqrt(norm2(in[i].accel_mps2)) / n;
        w2 += norm2(in[i].gyro_radps) / n;
    }
    double mean2 = s[0] * s[0] + s[1] * s[1] + s[2] * s[2];
    double per_a = pow((double)c->sigma_accel_mps2, -2.0);
    double per_w = pow((double)c->sigma_gyro_radps, -2.0);
    switch (detector) {
    case INSOLE_DETECT_MV:
        return (a2 - mean2) * per_a;
    case INSOLE_DETECT_MAG:
        return (a2 - 2.0 * g * a1 + g * g) * per_a;
    case INSOLE_DETECT_ARE:
        return w2 * per_w;
    default:
        return (a2 - 2.0 * g * sqrt(mean2) + g * g) * per_a + w2 * per_w;
    }
}

/* Every sample's statistic is that of the window around it, and below the threshold it is still. */
START_TEST(labels_follow_statistic_and_threshold)
{
    static const double RATES_HZ[] = {60.0, 100.0, 200.0, 250.0};
    static const int HALVES[] = {1, 1, 3, 3};
    insole_zero_velocity_config_t config = insole_zero_velocity_defaults;
    config.detector = INSOLE_DETECT_SHOE + _i % 4;
    const insole_real_t thresholds[] = {config.shoe_threshold, config.mv_threshold,
                                        config.mag_threshold, config.are_threshold};
    run(&config, &WALK, RATES_HZ[_i / 4], 0u);
    worst_t off = {0.0, 0.0}, label = {0.0, 0.0};
    int still = 0;
    for (int i = 0; i < count; i++) {
        double exact = direct(config.detector, i, HALVES[_i / 4]);
        worst_note(&off, fabs((double)out[i].statistic - exact) / 1.0e7, i);
        worst_require(&label, out[i].still == (out[i].statistic < thresholds[_i % 4]), i);
        worst_require(&label, out[i].plain == out[i].still, i);
        still += out[i].still ? 1 : 0;
    }
    ASSERT_WORST(off, 100.0 * (double)INSOLE_REAL_EPSILON, "of that of a swing");
    ASSERT_ALL_HELD(label);
    ck_assert_int_gt(still, count / 3);
    ck_assert_int_lt(still, count);
}
END_TEST

/* At any rate that the screen lets through a sample waits less than half a second. */
START_TEST(no_sample_waits_half_a_second)
{
    walk_t walk = WALK;
    walk.strides = 1;
    walk.rest_s = 0.7;
    for (double rate_hz = 60.0; rate_hz <= 250.0; rate_hz += 1.9) {
        insole_zero_velocity_config_t config = insole_zero_velocity_defaults;
        config.window_s = _i == 0 ? config.window_s : INSOLE_R(0.2);
        run(&config, &walk, rate_hz, 123456u);
        ASSERT_AT_MOST(latest_s, 0.45 + 1.001 / rate_hz, "s");
        ck_assert_int_eq(count, pushed);
    }
}
END_TEST

/* Whatever comes in goes out once, unchanged, with its tag: uneven stamps, gaps, late finish. */
START_TEST(samples_pass_unchanged)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, (uint64_t)_i);
    insole_zero_velocity_config_t config = insole_zero_velocity_defaults;
    config.detector = _i % 6;
    begin(&config);
    uint64_t t_us = UINT64_C(4294967296) - 2000000u; /* the low half of the stamp wraps */
    for (int i = 0; i < 3000; i++) {
        t_us += 3900u + insole_rng_bits(&rng) % 14000u;
        t_us += insole_rng_bits(&rng) % 300u == 0u ? insole_rng_bits(&rng) % 5000000u : 0u;
        insole_imu_t imu = walk_sample(&WALK, 0.005 * i, 0.005 * i + 0.005, &rng);
        imu.t_us = t_us;
        push(&imu);
    }
    finish();
    ck_assert_int_eq(count, pushed);
    worst_t same = {0.0, 0.0};
    for (int i = 0; i < count; i++) {
        worst_require(&same, memcmp(&out[i].imu, &in[i], sizeof in[i]) == 0, i);
        worst_require(&same, out[i].tag == (i + 1) % 7, i);
    }
    ASSERT_ALL_HELD(same);
}
END_TEST

static double time_between(int from, int to)
{
    return 1.0e-6 * ((double)out[to].imu.t_us - (double)out[from].imu.t_us);
}

/* The least statistic over a time to both sides. */
static double least_around(int k, double before_s, double after_s)
{
    double least = (double)out[k].statistic;
    for (int i = k; i >= 0 && time_between(i, k) <= before_s; i--) {
        least = fmin(least, (double)out[i].statistic);
    }
    for (int i = k; i < count && time_between(k, i) <= after_s; i++) {
        least = fmin(least, (double)out[i].statistic);
    }
    return least;
}

/* A still sample that is not plain lies beside a minimum, which it nearly equals. */
static bool is_beside_a_minimum(int s)
{
    for (int k = 0; k < count; k++) {
        double T = (double)out[k].statistic;
        if (fabs(time_between(k, s)) < 0.0500005 && (double)out[s].statistic < 4.0 * T &&
            T < 1.0e6 && T <= least_around(k, 0.399, 0.38)) {
            return true;
        }
    }
    return false;
}

/* The adaptive labels against their definition, gait by gait: plain ones by threshold, guaranteed
 * ones beside a minimum, and no minimum left out but those that come too early. */
START_TEST(adaptive_labels_are_as_defined)
{
    static const double RATES_HZ[] = {60.0, 100.0, 200.0};
    const walk_t *gaits[] = {&WALK, &RUN, &STAIRS, &CRAWL};
    const insole_zero_velocity_config_t *c = &insole_zero_velocity_defaults;
    run(c, gaits[_i % 4], RATES_HZ[_i / 4], 50000000u);
    worst_t label = {0.0, 0.0};
    int guaranteed = 0;
    for (int i = 0; i < count; i++) {
        bool below = out[i].statistic < c->plain_threshold;
        worst_require(&label, out[i].plain == below, i);
        worst_require(&label, !below || out[i].still, i);
        worst_require(&label, !out[i].still || below || is_beside_a_minimum(i), i);
        guaranteed += out[i].still && !out[i].plain ? 1 : 0;
    }
    ASSERT_ALL_HELD(label);
    ck_assert(gaits[_i % 4] != &RUN || guaranteed >= 20);
}
END_TEST

/* Each true stance has a still moment, and no still moment lies in a swing's middle. */
START_TEST(each_stance_of_a_gait_is_found)
{
    static const double RATES_HZ[] = {60.0, 100.0, 200.0, 250.0};
    const walk_t *gaits[] = {&WALK, &RUN, &STAIRS, &CRAWL};
    walk_t walk = *gaits[_i % 4];
    walk.strides = 20;
    run(&insole_zero_velocity_defaults, &walk, RATES_HZ[_i / 4], 0u);
    double period_s = walk.swing_s + walk.stance_s;
    int found[21] = {0}, astray = 0;
    for (int i = 0; i < count; i++) {
        double t = 1.0e-6 * (double)out[i].imu.t_us - walk.rest_s;
        double into_s = t - period_s * floor(t / period_s);
        bool walking = t > 0.0 && t < 20.0 * period_s - walk.stance_s;
        bool mid = into_s > 0.1 * walk.swing_s && into_s < 0.9 * walk.swing_s;
        if (walking && out[i].still) {
            found[(int)(t / period_s)] += mid ? 0 : 1;
            astray += mid ? 1 : 0;
        }
    }
    ck_assert_int_eq(astray, 0);
    for (int stride = _i % 4 == 1 ? 10 : 0; stride < 19; stride++) { /* a sudden run is unusual */
        ck_assert_msg(found[stride] > 0, "no stance after stride %d", stride);
    }
}
END_TEST

/* The period of the gait and what is usual follow the walker. */
START_TEST(habits_are_learned)
{
    walk_t walk = RUN;
    walk.strides = 40;
    run(&insole_zero_velocity_defaults, &walk, 200.0, 0u);
    ASSERT_NEAR(line.period_s, 0.7, 0.05, "s");
    ASSERT_NEAR(line.usual_log, 0.75 * log(4.7e5) + 0.25 * log(4.0e4), 0.05, ""); /* then a rest */
    walk = WALK;
    walk.strides = 30;
    run(&insole_zero_velocity_defaults, &walk, 200.0, 0u);
    ASSERT_NEAR(line.period_s, 1.05, 0.03, "s");
    ASSERT_NEAR(line.usual_log, log(4.0e4), 1.0e-3, "");
}
END_TEST

/* The same stream far beyond 2^32 microseconds has the same labels. */
START_TEST(labels_do_not_depend_on_the_time_of_day)
{
    static insole_labelled_t early[MOST];
    run(&insole_zero_velocity_defaults, &RUN, 200.0, 10000000u);
    memcpy(early, out, sizeof early);
    run(&insole_zero_velocity_defaults, &RUN, 200.0,
        UINT64_C(4294967296) * (uint64_t)(1 + _i) - 7000000u);
    worst_t same = {0.0, 0.0};
    for (int i = 0; i < count; i++) {
        worst_require(&same, early[i].still == out[i].still, i);
        worst_require(&same, early[i].statistic == out[i].statistic, i);
    }
    ASSERT_ALL_HELD(same);
}
END_TEST

/* At 1 kHz the line holds an eighth of a second: labels suffer, the flow does not. */
START_TEST(a_sensor_that_is_too_fast_still_comes_through)
{
    run(&insole_zero_velocity_defaults, &WALK, 1000.0, 0u);
    ck_assert_int_eq(count, pushed);
    ck_assert_uint_eq(line.refused, 0u);
    int still = 0;
    for (int i = 0; i < count; i++) {
        still += out[i].plain ? 1 : 0;
    }
    ck_assert_int_gt(still, count / 2);
}
END_TEST

/* Without any noise a stance is a plateau: its first sample stands for it. */
START_TEST(a_plateau_has_a_stance)
{
    begin(&insole_zero_velocity_defaults);
    for (int i = 0; i < 1200; i++) {
        insole_real_t rate = i % 240 < 60 ? INSOLE_R(1.0) : INSOLE_R(4.0);
        insole_imu_t imu = {1000000u + (uint64_t)i * 5000u, insole_vec3(0, 0, INSOLE_R(9.81)),
                            insole_vec3(0, rate, 0)};
        push(&imu);
    }
    finish();
    int stances = 0;
    for (int i = 1; i < count; i++) {
        stances += out[i].still && !out[i - 1].still ? 1 : 0;
        ck_assert(!out[i].still || i % 240 < 60);
    }
    ck_assert_int_ge(stances, 4);
}
END_TEST

/* What is held back at the end comes out, once. */
START_TEST(finishing_is_final)
{
    run(&insole_zero_velocity_defaults, &WALK, 100.0, 0u);
    insole_labelled_t none;
    insole_imu_t imu = in[pushed - 1];
    imu.t_us += 10000u;
    ASSERT_UNCHANGED(line, insole_zero_velocity_finish(&line), INSOLE_OK);
    ASSERT_UNCHANGED(line, insole_zero_velocity_next(&line, &none), INSOLE_ERR_STATE);
    ASSERT_REFUSED(line, line.refused, insole_zero_velocity_push(&line, &imu, 0u),
                   INSOLE_ERR_STATE);
    ck_assert_int_eq(insole_zero_velocity_finish(NULL), INSOLE_ERR_NULL);
}
END_TEST

static insole_zero_velocity_config_t config;

static insole_status_t judge(void)
{
    static insole_zero_velocity_t tried, before;
    memset(&tried, 0x5a, sizeof tried);
    before = tried;
    insole_status_t status = insole_zero_velocity_init(&tried, &config);
    ck_assert(status == INSOLE_OK || memcmp(&tried, &before, sizeof tried) == 0);
    return status;
}

START_TEST(settings_have_their_ranges)
{
    config = insole_zero_velocity_defaults;
    INSOLE_ZERO_VELOCITY_KEYS(SETTING_HAS_ENDS)
    ASSERT_UNCHANGED(line, insole_zero_velocity_init(&line, NULL), INSOLE_ERR_NULL);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("zero_velocity_labels");
    suite_add_loop(suite, "thresholds", labels_follow_statistic_and_threshold, 16);
    suite_add_loop(suite, "waiting", no_sample_waits_half_a_second, 2);
    suite_add_loop(suite, "unchanged", samples_pass_unchanged, 12);
    suite_add_loop(suite, "adaptive", adaptive_labels_are_as_defined, 12);
    suite_add_loop(suite, "stances", each_stance_of_a_gait_is_found, 16);
    suite_add(suite, "habits", habits_are_learned);
    suite_add_loop(suite, "time of day", labels_do_not_depend_on_the_time_of_day, 2);
    suite_add(suite, "too fast", a_sensor_that_is_too_fast_still_comes_through);
    suite_add(suite, "plateau", a_plateau_has_a_stance);
    suite_add(suite, "finish", finishing_is_final);
    suite_add(suite, "settings", settings_have_their_ranges);
    return suite;
}
