/* SPDX-License-Identifier: MIT */
#include "insole/sense/zero_velocity.h"

#include <string.h>

#include "near.h"
#include "sample.h"
#include "suite.h"

enum { MOST = 20000 };

static const double PI = 3.14159265358979323846;

/* What a foot's sensor feels, made plainly: still, a slow stance, or a swing. */
typedef struct {
    double period_s;     /**< 0 = stands for ever */
    double stance_share; /**< of the period */
    double stance_radps; /**< turn rate in the middle of a stance */
    double swing_radps;  /**< largest turn rate of a swing */
} gait_t;

static const gait_t STANDING = {0.0, 1.0, 0.0, 0.0};
static const gait_t WALKING = {1.1, 0.35, 0.1, 7.0};
static const gait_t RUNNING = {0.7, 0.2, 0.9, 10.0}; /* never as still as a plain stance */

static insole_imu_t feel(const gait_t *gait, double t_s, insole_rng_t *rng)
{
    double phase = gait->period_s > 0.0 ? fmod(t_s / gait->period_s, 1.0) : 0.0;
    double swing = (phase - gait->stance_share) / (1.0 - gait->stance_share);
    double bowl = (2.0 * phase / gait->stance_share - 1.0);
    double rate = swing > 0.0 ? gait->swing_radps * sin(PI * swing) * sin(PI * swing)
                              : gait->stance_radps * (1.0 + 2.0 * bowl * bowl);
    double push = swing > 0.0 ? 15.0 * sin(2.0 * PI * swing) : 0.0;
    if (gait->period_s > 0.0 && swing > 0.0) {
        rate += 0.8 + gait->stance_radps;
    }
    insole_imu_t imu;
    imu.t_us = (uint64_t)llround(1e6 * t_s);
    imu.gyro_radps = insole_vec3_add(insole_vec3(INSOLE_R(0.0), (insole_real_t)rate, INSOLE_R(0.0)),
                                     sample_vec3(rng, INSOLE_R(0.01)));
    imu.accel_mps2 =
        insole_vec3_add(insole_vec3((insole_real_t)push, INSOLE_R(0.0), INSOLE_R(9.81)),
                        sample_vec3(rng, INSOLE_R(0.05)));
    return imu;
}

/* Everything that came out of the delay line, and how long it took. */
typedef struct {
    insole_labelled_t out[MOST];
    int count;
    double latest_s; /**< longest time from a sample's stamp to that of the push that freed it */
} record_t;

static record_t record, other;

static void take(insole_zero_velocity_t *zv, record_t *r, uint64_t now_us)
{
    insole_labelled_t out;
    while (insole_zero_velocity_has_next(zv)) {
        ck_assert_int_eq(insole_zero_velocity_next(zv, &out), INSOLE_OK);
        r->latest_s = fmax(r->latest_s, 1e-6 * (double)(now_us - out.imu.t_us));
        r->out[r->count++] = out;
    }
    ck_assert_int_eq(insole_zero_velocity_next(zv, &out), INSOLE_ERR_STATE);
}

static void run_from(insole_zero_velocity_t *zv, const gait_t *gait, double rate_hz, double from_s,
                     double to_s, record_t *r)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 1u);
    for (int i = 0; i / rate_hz < to_s; i++) {
        insole_imu_t imu = feel(gait, i / rate_hz, &rng);
        if (i / rate_hz >= from_s) {
            ck_assert_int_eq(insole_zero_velocity_push(zv, &imu, (uint8_t)(i % 251)), INSOLE_OK);
            take(zv, r, imu.t_us);
        }
    }
}

static void run(const insole_zero_velocity_config_t *config, const gait_t *gait, double rate_hz,
                double seconds, record_t *r)
{
    static insole_zero_velocity_t zv;
    memset(r, 0, sizeof *r);
    ck_assert_int_eq(insole_zero_velocity_init(&zv, config), INSOLE_OK);
    run_from(&zv, gait, rate_hz, 0.0, seconds, r);
    ck_assert_int_eq(insole_zero_velocity_finish(&zv), INSOLE_OK);
    insole_labelled_t out;
    while (insole_zero_velocity_next(&zv, &out) == INSOLE_OK) {
        r->out[r->count++] = out;
    }
}

static int stances(const record_t *r)
{
    int count = 0;
    for (int i = 0; i < r->count; i++) {
        count += r->out[i].still && (i == 0 || !r->out[i - 1].still);
    }
    return count;
}

static double still_share(const record_t *r)
{
    int still = 0;
    for (int i = 0; i < r->count; i++) {
        still += r->out[i].still;
    }
    return (double)still / r->count;
}

/* Share of the still samples that lie outside the stances. */
static double false_share(const record_t *r, const gait_t *gait)
{
    int still = 0, wrong = 0;
    for (int i = 0; i < r->count; i++) {
        double phase = fmod(1e-6 * (double)r->out[i].imu.t_us / gait->period_s, 1.0);
        still += r->out[i].still;
        wrong += r->out[i].still && phase > gait->stance_share + 0.02 && phase < 0.98;
    }
    return still > 0 ? (double)wrong / still : 1.0;
}

static const int RATES_HZ[] = {60, 100, 200, 250};
enum { RATES = 4 };

START_TEST(every_sample_comes_out_once_in_order_and_in_time)
{
    insole_zero_velocity_config_t config = insole_zero_velocity_defaults;
    config.detector = _i / RATES;
    double rate_hz = RATES_HZ[_i % RATES];
    run(&config, &WALKING, rate_hz, 20.0, &record);
    ck_assert_int_eq(record.count, (int)ceil(20.0 * rate_hz));
    worst_t worst = {0.0, 0.0};
    for (int i = 0; i < record.count; i++) {
        worst_require(&worst, record.out[i].imu.t_us == (uint64_t)llround(1e6 * i / rate_hz), i);
        worst_require(&worst, record.out[i].tag == i % 251, i);
    }
    ASSERT_ALL_HELD(worst);
    ASSERT_AT_MOST(record.latest_s, 0.485, "s");
}
END_TEST

START_TEST(adaptive_finds_each_stance_of_a_walk_and_of_a_run)
{
    const gait_t *gait = _i / RATES == 0 ? &WALKING : &RUNNING;
    run(&insole_zero_velocity_defaults, gait, RATES_HZ[_i % RATES], 30.0, &record);
    ASSERT_NEAR(stances(&record), 30.0 / gait->period_s, 1.5, "stances");
    ASSERT_AT_MOST(false_share(&record, gait), 0.02, "of the still samples");
}
END_TEST

/* What the guarantee is for: a fixed threshold finds none of the runner's stances. */
START_TEST(a_plain_threshold_misses_the_run)
{
    insole_zero_velocity_config_t config = insole_zero_velocity_defaults;
    config.detector = INSOLE_DETECT_SHOE;
    config.shoe_threshold = config.plain_threshold;
    run(&config, &RUNNING, 200.0, 30.0, &record);
    ck_assert_int_eq(stances(&record), 0);
}
END_TEST

START_TEST(standing_is_still_for_every_detector)
{
    insole_zero_velocity_config_t config = insole_zero_velocity_defaults;
    config.detector = _i;
    run(&config, &STANDING, 200.0, 10.0, &record);
    ASSERT_NEAR(still_share(&record), 1.0, 0.0, "");
    for (int i = 0; i < record.count; i++) {
        ck_assert(record.out[i].plain);
    }
}
END_TEST

/* A minimum in mid-swing, less still than the stances are, is not one of them. */
START_TEST(the_cadence_guard_rejects_swing_minima)
{
    insole_zero_velocity_config_t config = insole_zero_velocity_defaults, unguarded = config;
    unguarded.early_share = INSOLE_R(0.0);
    gait_t gait = {1.0, 0.3, 0.1, 0.0}; /* swings at a flat 0.9 rad/s and a changing push */
    run(&config, &gait, 200.0, 30.0, &record);
    run(&unguarded, &gait, 200.0, 30.0, &other);
    ASSERT_AT_MOST(false_share(&record, &gait), 0.02, "of the still samples");
    ASSERT_AT_LEAST(false_share(&other, &gait), 2.0 * false_share(&record, &gait), "");
}
END_TEST

START_TEST(two_step_closes_holes_as_told)
{
    insole_zero_velocity_config_t config = insole_zero_velocity_defaults;
    config.detector = INSOLE_DETECT_TWO_STEP;
    config.two_step_hole_s = INSOLE_R(0.05);
    static insole_zero_velocity_t zv;
    insole_zero_velocity_init(&zv, &config);
    memset(&record, 0, sizeof record);
    insole_rng_t rng;
    insole_rng_seed(&rng, 1u);
    for (int i = 0; i < 400; i++) { /* jolts of 6 samples and of 14 samples at 200 Hz */
        insole_imu_t imu = feel(&STANDING, i / 200.0, &rng);
        bool jolt = (i >= 100 && i < 106) || (i >= 200 && i < 214);
        imu.gyro_radps.x += jolt ? INSOLE_R(3.0) : INSOLE_R(0.0);
        insole_zero_velocity_push(&zv, &imu, 0u);
        take(&zv, &record, imu.t_us);
    }
    insole_zero_velocity_finish(&zv);
    take(&zv, &record, 2000000u);
    worst_t worst = {0.0, 0.0};
    for (int i = 0; i < 400; i++) {
        worst_require(&worst, record.out[i].still == !(i >= 200 && i < 214), i);
        worst_require(&worst, record.out[i].plain == (record.out[i].still && (i < 100 || i > 105)),
                      i);
    }
    ASSERT_ALL_HELD(worst);
}
END_TEST

/* Labels of a stream that is cut are those of the whole, up to half a second before the cut. */
START_TEST(a_cut_stream_has_the_same_labels)
{
    const gait_t *gait = _i % 2 == 0 ? &WALKING : &RUNNING;
    double cut_s = 3.0 + 0.37 * _i, rate_hz = RATES_HZ[_i % RATES];
    run(&insole_zero_velocity_defaults, gait, rate_hz, 12.0, &record);
    run(&insole_zero_velocity_defaults, gait, rate_hz, cut_s, &other);
    worst_t worst = {0.0, 0.0};
    for (int i = 0; i < other.count && i / rate_hz <= cut_s - 0.5; i++) {
        worst_require(&worst, record.out[i].still == other.out[i].still, i);
        worst_require(&worst, record.out[i].plain == other.out[i].plain, i);
    }
    ASSERT_ALL_HELD(worst);
}
END_TEST

START_TEST(a_gap_of_hours_keeps_the_stamps)
{
    static insole_zero_velocity_t zv;
    insole_zero_velocity_init(&zv, &insole_zero_velocity_defaults);
    memset(&record, 0, sizeof record);
    insole_rng_t rng;
    insole_rng_seed(&rng, 1u);
    uint64_t last_us = 0u;
    for (int i = 0; i < 1000; i++) {
        insole_imu_t imu = feel(&WALKING, i / 200.0, &rng);
        imu.t_us += i < 500 ? 0u : UINT64_C(9000000000); /* 2.5 h, beyond 2^32 microseconds */
        last_us = imu.t_us;
        ck_assert_int_eq(insole_zero_velocity_push(&zv, &imu, 0u), INSOLE_OK);
        take(&zv, &record, imu.t_us);
    }
    insole_zero_velocity_finish(&zv);
    take(&zv, &record, last_us);
    ck_assert_int_eq(record.count, 1000);
    ck_assert_uint_eq(record.out[499].imu.t_us, 2495000u);
    ck_assert_uint_eq(record.out[500].imu.t_us, UINT64_C(9002500000));
}
END_TEST

START_TEST(a_gap_of_years_keeps_the_stamps)
{
    static insole_zero_velocity_t zv;
    insole_zero_velocity_init(&zv, &insole_zero_velocity_defaults);
    memset(&record, 0, sizeof record);
    insole_rng_t rng;
    insole_rng_seed(&rng, 1u);
    uint64_t years_us = UINT64_C(5) * 365u * 86400u * 1000000u, last_us = 0u;
    for (int i = 0; i < 600; i++) {
        insole_imu_t imu = feel(&WALKING, i / 200.0, &rng);
        imu.t_us += i < 300 ? UINT64_C(4294967000) : years_us;
        last_us = imu.t_us;
        ck_assert_int_eq(insole_zero_velocity_push(&zv, &imu, 0u), INSOLE_OK);
        take(&zv, &record, imu.t_us);
    }
    insole_zero_velocity_finish(&zv);
    take(&zv, &record, last_us);
    ck_assert_int_eq(record.count, 600);
    worst_t stamps = {0.0, 0.0};
    for (int i = 0; i < 600; i++) {
        uint64_t begin_us = i < 300 ? UINT64_C(4294967000) : years_us;
        worst_require(&stamps, record.out[i].imu.t_us - begin_us == (uint64_t)i * 5000u, i);
    }
    ASSERT_ALL_HELD(stamps);
}
END_TEST

/* Unchecked, a good sample is the same. */
START_TEST(what_is_known_to_be_good_is_taken_alike)
{
    static insole_zero_velocity_t pushed, taken;
    insole_zero_velocity_init(&pushed, &insole_zero_velocity_defaults);
    insole_zero_velocity_init(&taken, &insole_zero_velocity_defaults);
    insole_rng_t rng;
    insole_rng_seed(&rng, 2u);
    insole_labelled_t out, same;
    memset(&out, 0, sizeof out);
    memset(&same, 0, sizeof same);
    int count = 0;
    for (int i = 0; i < 2000; i++) {
        insole_imu_t imu = feel(i < 1000 ? &WALKING : &RUNNING, i / 200.0, &rng);
        ck_assert_int_eq(insole_zero_velocity_push(&pushed, &imu, (uint8_t)i), INSOLE_OK);
        insole_zero_velocity_take(&taken, &imu, (uint8_t)i);
        while (insole_zero_velocity_next(&pushed, &out) == INSOLE_OK) {
            ck_assert_int_eq(insole_zero_velocity_next(&taken, &same), INSOLE_OK);
            count += memcmp(&out, &same, sizeof out) == 0 ? 1 : 0;
        }
    }
    ck_assert_int_gt(count, 1800);
    ck_assert_int_eq(count, (int)pushed.ring.begin);
    ck_assert_mem_eq(&pushed, &taken, sizeof pushed);
}
END_TEST

START_TEST(saved_in_mid_walk_it_goes_on_the_same)
{
    static insole_zero_velocity_t zv, saved;
    insole_zero_velocity_init(&zv, &insole_zero_velocity_defaults);
    memset(&record, 0, sizeof record);
    run_from(&zv, &WALKING, 200.0, 0.0, 5.0, &record);
    saved = zv;
    record.count = 0;
    memset(&other, 0, sizeof other);
    run_from(&zv, &WALKING, 200.0, 5.0, 12.0, &record);
    run_from(&saved, &WALKING, 200.0, 5.0, 12.0, &other);
    ck_assert_int_eq(record.count, other.count);
    worst_t worst = {0.0, 0.0};
    for (int i = 0; i < record.count; i++) {
        worst_require(&worst, record.out[i].still == other.out[i].still, i);
        worst_require(&worst, record.out[i].statistic == other.out[i].statistic, i);
    }
    ASSERT_ALL_HELD(worst);
}
END_TEST

START_TEST(a_full_line_asks_to_be_emptied)
{
    static insole_zero_velocity_t zv, before;
    insole_rng_t rng;
    insole_rng_seed(&rng, 1u);
    insole_zero_velocity_init(&zv, &insole_zero_velocity_defaults);
    int pushed = 0;
    insole_imu_t imu;
    insole_status_t status = INSOLE_OK;
    while (status == INSOLE_OK && pushed < 2 * INSOLE_STANCE_RING) {
        imu = feel(&WALKING, pushed / 200.0, &rng);
        memcpy(&before, &zv, sizeof zv);
        status = insole_zero_velocity_push(&zv, &imu, 0u);
        pushed += status == INSOLE_OK;
    }
    ck_assert_int_eq(status, INSOLE_ERR_ROOM);
    ck_assert_int_eq(pushed, INSOLE_STANCE_RING);
    before.refused++;
    ck_assert_mem_eq(&before, &zv, sizeof zv);
    insole_labelled_t out;
    ck_assert_int_eq(insole_zero_velocity_next(&zv, &out), INSOLE_OK);
    ck_assert_int_eq(insole_zero_velocity_push(&zv, &imu, 0u), INSOLE_OK);
}
END_TEST

START_TEST(refusals_change_nothing)
{
    static insole_zero_velocity_t zv, before;
    insole_rng_t rng;
    insole_rng_seed(&rng, 1u);
    insole_zero_velocity_init(&zv, &insole_zero_velocity_defaults);
    insole_imu_t fine = feel(&WALKING, 1.0, &rng), bad = feel(&WALKING, 2.0, &rng), late = fine;
    bad.gyro_radps.z = (insole_real_t)NAN;
    late.t_us = 999999u;
    ck_assert_int_eq(insole_zero_velocity_push(&zv, &fine, 0u), INSOLE_OK);
    memcpy(&before, &zv, sizeof zv);
    ck_assert_int_eq(insole_zero_velocity_push(&zv, &bad, 0u), INSOLE_ERR_VALUE);
    ck_assert_int_eq(insole_zero_velocity_push(&zv, &fine, 0u), INSOLE_ERR_TIME);
    ck_assert_int_eq(insole_zero_velocity_push(&zv, &late, 0u), INSOLE_ERR_TIME);
    ck_assert_int_eq(insole_zero_velocity_push(&zv, NULL, 0u), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_zero_velocity_next(&zv, NULL), INSOLE_ERR_NULL);
    before.refused += 3u;
    ck_assert_mem_eq(&before, &zv, sizeof zv);
    insole_zero_velocity_finish(&zv);
    fine.t_us += 5000u;
    ck_assert_int_eq(insole_zero_velocity_push(&zv, &fine, 0u), INSOLE_ERR_STATE);
    insole_zero_velocity_config_t config = insole_zero_velocity_defaults;
    config.reach_s = (insole_real_t)NAN;
    ck_assert_int_eq(insole_zero_velocity_init(&zv, &config), INSOLE_ERR_VALUE);
    ck_assert_int_eq(insole_zero_velocity_init(NULL, &insole_zero_velocity_defaults),
                     INSOLE_ERR_NULL);
}
END_TEST

START_TEST(an_empty_or_short_log_ends_well)
{
    for (int n = 0; n < 20; n++) {
        run(&insole_zero_velocity_defaults, &STANDING, 200.0, n / 200.0 - 0.001, &record);
        ck_assert_int_eq(record.count, n);
    }
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("zero_velocity");
    suite_add_loop(suite, "delay line", every_sample_comes_out_once_in_order_and_in_time,
                   6 * RATES);
    suite_add_loop(suite, "gaits", adaptive_finds_each_stance_of_a_walk_and_of_a_run, 2 * RATES);
    suite_add(suite, "guarantee", a_plain_threshold_misses_the_run);
    suite_add_loop(suite, "standing", standing_is_still_for_every_detector, 6);
    suite_add(suite, "cadence", the_cadence_guard_rejects_swing_minima);
    suite_add(suite, "two-step", two_step_closes_holes_as_told);
    suite_add_loop(suite, "prefix", a_cut_stream_has_the_same_labels, 8);
    suite_add(suite, "long gap", a_gap_of_hours_keeps_the_stamps);
    suite_add(suite, "longer gap", a_gap_of_years_keeps_the_stamps);
    suite_add(suite, "unchecked", what_is_known_to_be_good_is_taken_alike);
    suite_add(suite, "save", saved_in_mid_walk_it_goes_on_the_same);
    suite_add(suite, "full", a_full_line_asks_to_be_emptied);
    suite_add(suite, "refusals", refusals_change_nothing);
    suite_add(suite, "short logs", an_empty_or_short_log_ends_well);
    return suite;
}
