/* SPDX-License-Identifier: MIT */
#include "insole/sense/screen.h"

#include "near.h"
#include "refusal.h"
#include "sample.h"
#include "setting.h"
#include "suite.h"

#define PI 3.14159265358979323846

enum { MOST = 20000 };

static insole_screen_t screen;
static insole_clean_t out[MOST];
static int count;

static void begin(void)
{
    ck_assert_int_eq(insole_screen_init(&screen, &insole_screen_defaults), INSOLE_OK);
    count = 0;
}

static void push(const insole_imu_t *imu)
{
    count += insole_screen_push(&screen, imu, &out[count]) == INSOLE_OK ? 1 : 0;
}

static void finish(void)
{
    while (insole_screen_finish(&screen, &out[count]) == INSOLE_OK) {
        count++;
    }
}

/* Number `i` of a calm stream at 200 Hz that began at `from_us`. */
static insole_imu_t calm(int i, uint64_t from_us)
{
    insole_imu_t imu = {from_us + (uint64_t)i * 5000u,
                        insole_vec3((insole_real_t)sin(0.1 * i), 1, INSOLE_R(9.8)),
                        insole_vec3(0, (insole_real_t)cos(0.1 * i), 0)};
    return imu;
}

static void push_calm(int from, int to, uint64_t from_us)
{
    for (int i = from; i < to; i++) {
        insole_imu_t imu = calm(i, from_us);
        push(&imu);
    }
}

static void assert_increasing(void)
{
    worst_t order = {0.0, 0.0};
    for (int i = 1; i < count; i++) {
        worst_require(&order, out[i].imu.t_us > out[i - 1].imu.t_us, i);
    }
    ASSERT_ALL_HELD(order);
}

/* ---- stamps ----------------------------------------------------------------------------- */

/* Nothing says that the first stamp was right: the second shows that it was not. */
START_TEST(a_wild_first_stamp_goes)
{
    begin();
    insole_imu_t imu = calm(0, 1u << 30);
    imu.t_us = UINT64_C(77777777777777);
    push(&imu);
    push_calm(1, 100, 1u << 30);
    finish();
    ck_assert_int_eq(count, 99);
    ck_assert_uint_eq(screen.counts.wild, 1u);
    ck_assert_uint_eq(screen.counts.backward, 0u);
    ck_assert_uint_eq(screen.counts.gaps, 0u);
    ck_assert_uint_eq(out[0].imu.t_us, (1u << 30) + 5000u);
}
END_TEST

/* Stamps of more than 63 bits are none, wherever they come. */
START_TEST(stamps_of_64_bits_go)
{
    begin();
    for (int i = 0; i < 100; i++) {
        insole_imu_t imu = calm(i, 1000u), bad = imu;
        bad.t_us |= UINT64_C(1) << 63;
        push(&bad);
        push(&imu);
        bad.t_us = UINT64_MAX;
        push(&bad);
    }
    finish();
    ck_assert_int_eq(count, 100);
    ck_assert_uint_eq(screen.counts.wild, 200u);
    ck_assert_uint_eq(screen.counts.samples, 300u);
    insole_imu_t latest = calm(0, (uint64_t)INT64_MAX);
    begin();
    push_calm(0, 50, (uint64_t)INT64_MAX - 250000u);
    push(&latest);
    finish();
    ck_assert_int_eq(count, 51);
}
END_TEST

/* Alone far ahead, at any place and after any rest, while the foot swings. */
START_TEST(a_wild_stamp_leaves_no_trace)
{
    begin();
    uint32_t wild = 0u;
    for (int i = 0; i < 4000; i++) {
        insole_imu_t imu = calm(i, 0u);
        imu.gyro_radps.y = (insole_real_t)(12.0 * fmax(sin(PI * i / 60.0), 0.0));
        if (i % 37 == 20) {
            imu.t_us += UINT64_C(1) << (17 + i % 40);
            wild++;
        }
        push(&imu);
    }
    finish();
    ck_assert_uint_eq(screen.counts.wild, wild);
    ck_assert_uint_eq(screen.counts.backward + screen.counts.repeated, 0u);
    ck_assert_uint_eq(screen.counts.gaps, 0u);
    ck_assert_uint_eq(screen.counts.clipped, 0u);
    ASSERT_NEAR(screen.clip.range_radps, 0.0, 0.0, "rad/s");
    ck_assert_int_eq(count, 4000 - (int)wild);
    assert_increasing();
}
END_TEST

/* Two wild ones in a row are believed: time has moved on, and says so with a gap. */
START_TEST(a_new_time_is_believed)
{
    begin();
    push_calm(0, 100, 0u);
    push_calm(100, 200, 90000000u);
    finish();
    ck_assert_int_eq(count, 200);
    ck_assert_uint_eq(screen.counts.gaps, 1u);
    ck_assert_uint_eq(out[100].marks, INSOLE_MARK_GAP);
    ck_assert_uint_eq(screen.counts.wild, 0u);
}
END_TEST

/* The clock is put back by a second: that second is missing, though no interval is long. */
START_TEST(a_clock_put_back_leaves_a_gap)
{
    begin();
    push_calm(0, 400, 1000000u);
    push_calm(400, 800, 0u);
    finish();
    ck_assert_uint_eq(screen.counts.backward, 199u);
    ck_assert_uint_eq(screen.counts.repeated, 1u);
    ck_assert_uint_eq(screen.counts.gaps, 1u);
    ck_assert_uint_eq(out[400].marks, INSOLE_MARK_GAP);
    ck_assert_int_eq(count, 600);
    begin(); /* but a few that come in the wrong order are no gap */
    push_calm(0, 400, 1000000u);
    push_calm(390, 800, 1000000u);
    finish();
    ck_assert_uint_eq(screen.counts.gaps, 0u);
    ck_assert_int_eq(count, 800);
}
END_TEST

/* ---- bursts ----------------------------------------------------------------------------- */

/* A FIFO read out when it holds 2 to 6 samples of a sensor that is 1 % slow: every sample comes
 * through, in order, near the time at which it was taken. */
START_TEST(bursts_of_any_length_are_evened)
{
    const int burst = 2 + _i;
    const double period_us = 5050.0;
    begin();
    for (int i = 0; i < 6000; i++) {
        insole_imu_t imu = calm(i, 0u);
        int last = i - i % burst + burst - 1;
        imu.t_us = (uint64_t)(1.0e6 + last * period_us + 60.0 * (i % burst));
        push(&imu);
    }
    finish();
    assert_increasing();
    ck_assert_uint_eq(screen.counts.backward + screen.counts.repeated, 0u);
    ck_assert_int_eq(count + (int)screen.counts.averaged, 6000);
    worst_t interval = {0.0, 0.0};
    for (int i = count - 3000; i < count - 1; i++) {
        double dt_us = (double)(out[i + 1].imu.t_us - out[i].imu.t_us);
        worst_note(&interval, fabs(dt_us - period_us), i);
    }
    double mean_us = (double)(out[count - 2].imu.t_us - out[count - 3002].imu.t_us) / 3000.0;
    ASSERT_WORST(interval, 0.35 * period_us, "us");
    ASSERT_NEAR(mean_us, period_us, 0.002 * period_us, "us");
}
END_TEST

/* Bursts come and go: stamps stay in order where evening begins and where it ends. */
START_TEST(evening_begins_and_ends_in_order)
{
    begin();
    for (int i = 0; i < 12000; i++) {
        insole_imu_t imu = calm(i, 0u);
        int burst = i / 1500 % 2 == 1 ? 4 : 1;
        imu.t_us = (uint64_t)((i - i % burst + burst) * 5000 + 50 * (i % burst));
        push(&imu);
    }
    finish();
    assert_increasing();
    ck_assert_uint_gt(screen.counts.evened, 3000u);
    ck_assert_uint_lt(screen.counts.evened, 9500u);
    ck_assert_uint_eq(screen.counts.backward, 0u);
    ck_assert_uint_eq(screen.counts.gaps, 0u);
}
END_TEST

START_TEST(evening_may_be_switched_off)
{
    insole_screen_config_t config = insole_screen_defaults;
    config.burst_share = 1;
    ck_assert_int_eq(insole_screen_init(&screen, &config), INSOLE_OK);
    count = 0;
    for (int i = 0; i < 2000; i++) {
        insole_imu_t imu = calm(i - i % 2, 0u);
        imu.t_us += i % 2 == 1 ? 4500u : 0u;
        push(&imu);
    }
    finish();
    ck_assert_uint_eq(screen.counts.evened, 0u);
    ck_assert_int_eq(count, 2000);
    ck_assert_uint_eq(out[1001].imu.t_us, 5004500u);
}
END_TEST

/* ---- clipping --------------------------------------------------------------------------- */

/* A swing each second; the gyro ends at 8.7 rad/s or goes on as far as it must. */
static void swing(double rate_hz, double limit)
{
    begin();
    for (int i = 0; i / rate_hz < 12.0; i++) {
        double phase = fmod(i / rate_hz, 1.0) / 0.3;
        double y = phase < 1.0 ? 15.0 * sin(PI * phase) : 0.0;
        insole_imu_t imu = {(uint64_t)llround(1.0e6 * i / rate_hz), insole_vec3(0, 0, 10),
                            insole_vec3(0, (insole_real_t)-fmin(y, limit), 0)};
        push(&imu);
    }
    finish();
}

START_TEST(clipping_is_recognised_and_marked)
{
    static const double RATES_HZ[] = {60.0, 100.0, 200.0, 400.0, 820.0};
    const double rate_hz = RATES_HZ[_i];
    swing(rate_hz, 1.0e3);
    ck_assert_uint_eq(screen.counts.clipped, 0u);
    swing(rate_hz, 8.7);
    ASSERT_NEAR(screen.clip.range_radps, 8.7, 0.3, "rad/s");
    ck_assert_uint_gt(screen.counts.clipped, (uint32_t)(11.0 * 0.1 * rate_hz));
    worst_t astray = {0.0, 0.0};
    uint32_t marked = 0u;
    for (int i = 0; i < count; i++) {
        uint8_t marks = out[i].marks & INSOLE_MARK_CLIP;
        marked += marks != 0u ? 1u : 0u;
        worst_require(&astray, marks == 0u || marks == 2u, i);
    }
    ASSERT_ALL_HELD(astray);
    ck_assert_uint_gt(marked, 100u); /* averaged samples keep the mark of any of them */
}
END_TEST

/* ---- averaging -------------------------------------------------------------------------- */

/* Intervals of 0.3 to 3 ms: each sample counts by its time. Checked against plain double sums from
 * one clean sample to the next. */
START_TEST(uneven_samples_are_averaged_by_their_time)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, (uint64_t)_i);
    begin();
    screen.config.burst_share = 1; /* these stamps are honest */
    double sum[2] = {0.0, 0.0}, sum_s = 0.0;
    worst_t off = {0.0, 0.0};
    int taken = 0;
    insole_imu_t before = calm(0, 0u);
    push(&before);
    uint64_t t_us = 0u, began_us = 0u;
    for (int i = 1; i < 8000; i++) {
        uint32_t dt_us = 300u + insole_rng_bits(&rng) % 2700u;
        insole_imu_t imu = {t_us += dt_us, sample_vec3(&rng, 20), sample_vec3(&rng, 3)};
        push(&imu);
        /* what has just been released ends with the sample before this one */
        if (count > taken) {
            const insole_imu_t *o = &out[taken++].imu;
            worst_require(&off, taken == 1 || o->t_us == t_us - dt_us, i);
            worst_require(&off, taken == 1 || o->t_us - began_us >= 3920u, i);
            if (sum_s > 0.0) {
                worst_note(&off, fabs((double)o->accel_mps2.x - sum[0] / sum_s), i);
                worst_note(&off, fabs((double)o->gyro_radps.z - sum[1] / sum_s), i);
            }
            began_us = o->t_us;
            sum[0] = sum[1] = sum_s = 0.0;
        }
        sum[0] += dt_us * (double)imu.accel_mps2.x;
        sum[1] += dt_us * (double)imu.gyro_radps.z;
        sum_s += dt_us;
    }
    ASSERT_WORST(off, 2.0e-5, "");
    ck_assert_int_gt(taken, 2000);
}
END_TEST

/* The last few samples of a fast log are not lost, and nothing comes after the end. */
START_TEST(the_end_of_a_log_comes_out)
{
    for (int samples = 1; samples < 30; samples++) {
        begin();
        for (int i = 0; i < samples; i++) {
            insole_imu_t imu = {1000u * (uint64_t)i, insole_vec3(1, 2, 3), insole_vec3(0, 0, 1)};
            push(&imu);
        }
        finish();
        ck_assert_uint_eq(out[count - 1].imu.t_us, 1000u * (uint64_t)(samples - 1));
        insole_imu_t late = {UINT64_C(5000000), insole_vec3(1, 2, 3), insole_vec3(0, 0, 1)};
        ASSERT_UNCHANGED(screen, insole_screen_push(&screen, &late, &out[count]), INSOLE_ERR_STATE);
        ASSERT_UNCHANGED(screen, insole_screen_finish(&screen, &out[count]), INSOLE_ERR_STATE);
    }
}
END_TEST

/* ---- fields ----------------------------------------------------------------------------- */

/* A wide range is no fault, what no foot does is; both ends of both limits. */
START_TEST(absurd_values_are_held)
{
    begin();
    push_calm(0, 10, 0u);
    insole_imu_t imu = calm(10, 0u);
    imu.accel_mps2 = insole_vec3(0, 0, INSOLE_R(1999.0));
    imu.gyro_radps = insole_vec3(0, INSOLE_R(99.0), 0);
    push(&imu);
    ck_assert_uint_eq(screen.counts.not_finite, 0u);
    imu.t_us += 5000u;
    imu.accel_mps2.z = INSOLE_R(-2001.0);
    imu.gyro_radps.y = INSOLE_R(101.0);
    push(&imu);
    ck_assert_uint_eq(screen.counts.not_finite, 1u);
    ASSERT_NEAR(screen.slots[screen.newest].clean.imu.accel_mps2.z, 1999.0, 0.0, "m/s^2");
    ASSERT_NEAR(screen.slots[screen.newest].clean.imu.gyro_radps.y, 99.0, 0.0, "rad/s");
}
END_TEST

/* Without a good sample before there is nothing to hold. */
START_TEST(a_log_may_begin_with_bad_fields)
{
    begin();
    for (int i = 0; i < 100; i++) {
        insole_imu_t imu = calm(i, 0u);
        imu.gyro_radps.x = i < 40 ? (insole_real_t)NAN : imu.gyro_radps.x;
        push(&imu);
    }
    finish();
    ck_assert_int_eq(count, 60);
    ck_assert_uint_eq(out[0].imu.t_us, 200000u);
    ck_assert_uint_eq(out[0].marks, 0u);
    ck_assert_uint_eq(screen.counts.not_finite, 40u);
}
END_TEST

/* Next to a gap nobody knows what the neighbours were: what looks like a spike may be none. */
START_TEST(no_spike_next_to_a_gap)
{
    for (int gap = 0; gap < 2; gap++) {
        begin();
        push_calm(0, 50, 0u);
        insole_imu_t imu = calm(50, 0u);
        imu.accel_mps2.x += 300;
        push(&imu);
        push_calm(51, 100, gap == 1 ? 200000u : 0u);
        finish();
        ck_assert_uint_eq(screen.counts.spikes, gap == 1 ? 0u : 1u);
    }
}
END_TEST

/* ---- contract --------------------------------------------------------------------------- */

static insole_screen_config_t config;

static insole_status_t judge(void)
{
    static insole_screen_t tried, before;
    memset(&tried, 0x5a, sizeof tried);
    before = tried;
    insole_status_t status = insole_screen_init(&tried, &config);
    ck_assert(status == INSOLE_OK || memcmp(&tried, &before, sizeof tried) == 0);
    return status;
}

START_TEST(settings_have_their_ranges)
{
    config = insole_screen_defaults;
    INSOLE_SCREEN_KEYS(SETTING_HAS_ENDS)
}
END_TEST

START_TEST(null_changes_nothing)
{
    begin();
    push_calm(0, 10, 0u);
    insole_imu_t imu = calm(10, 0u);
    ASSERT_UNCHANGED(screen, insole_screen_init(&screen, NULL), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(screen, insole_screen_push(&screen, NULL, &out[0]), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(screen, insole_screen_push(&screen, &imu, NULL), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(screen, insole_screen_finish(&screen, NULL), INSOLE_ERR_NULL);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("screen_faults");
    suite_add(suite, "wild first", a_wild_first_stamp_goes);
    suite_add(suite, "64 bits", stamps_of_64_bits_go);
    suite_add(suite, "wild in swings", a_wild_stamp_leaves_no_trace);
    suite_add(suite, "new time", a_new_time_is_believed);
    suite_add(suite, "clock put back", a_clock_put_back_leaves_a_gap);
    suite_add_loop(suite, "bursts", bursts_of_any_length_are_evened, 5);
    suite_add(suite, "bursts come and go", evening_begins_and_ends_in_order);
    suite_add(suite, "evening off", evening_may_be_switched_off);
    suite_add_loop(suite, "clipping", clipping_is_recognised_and_marked, 5);
    suite_add_loop(suite, "uneven averages", uneven_samples_are_averaged_by_their_time, 4);
    suite_add(suite, "end", the_end_of_a_log_comes_out);
    suite_add(suite, "absurd", absurd_values_are_held);
    suite_add(suite, "begins badly", a_log_may_begin_with_bad_fields);
    suite_add(suite, "spike at a gap", no_spike_next_to_a_gap);
    suite_add(suite, "settings", settings_have_their_ranges);
    suite_add(suite, "NULL", null_changes_nothing);
    return suite;
}
