/* SPDX-License-Identifier: MIT */
#include "insole/sense/screen.h"

#include <string.h>

#include "near.h"
#include "sample.h"
#include "suite.h"

enum { MOST = 20000 };

/* What came out. */
typedef struct {
    insole_clean_t out[MOST];
    int count;
} stream_t;

static stream_t clean, plain;
static insole_screen_t screen;

static void begin(const insole_screen_config_t *config)
{
    ck_assert_int_eq(insole_screen_init(&screen, config ? config : &insole_screen_defaults),
                     INSOLE_OK);
    clean.count = 0;
}

static void push(insole_imu_t imu)
{
    if (insole_screen_push(&screen, &imu, &clean.out[clean.count]) == INSOLE_OK) {
        clean.count++;
    }
}

static void finish(void)
{
    while (insole_screen_finish(&screen, &clean.out[clean.count]) == INSOLE_OK) {
        clean.count++;
    }
}

/* A smooth motion, and its stamp. */
static insole_imu_t moving(double t_s)
{
    insole_imu_t imu;
    imu.t_us = (uint64_t)llround(1e6 * t_s);
    imu.accel_mps2 = insole_vec3((insole_real_t)(3.0 * sin(6.0 * t_s)), INSOLE_R(-2.0),
                                 (insole_real_t)(9.8 + 4.0 * cos(5.0 * t_s)));
    imu.gyro_radps = insole_vec3((insole_real_t)(2.0 * cos(7.0 * t_s)),
                                 (insole_real_t)(4.0 * sin(6.3 * t_s)), INSOLE_R(0.5));
    return imu;
}

static void run(double rate_hz, double seconds)
{
    for (int i = 0; i / rate_hz < seconds; i++) {
        push(moving(i / rate_hz));
    }
}

static double apart(insole_vec3_t a, insole_vec3_t b)
{
    return (double)insole_vec3_norm(insole_vec3_sub(a, b));
}

static void assert_increasing(void)
{
    worst_t worst = {0.0, 0.0};
    for (int i = 1; i < clean.count; i++) {
        worst_require(&worst, clean.out[i].imu.t_us > clean.out[i - 1].imu.t_us, i);
    }
    ASSERT_ALL_HELD(worst);
}

static const double RATES_HZ[] = {60.0, 100.0, 200.0, 250.0};

START_TEST(good_samples_pass_untouched)
{
    begin(NULL);
    run(RATES_HZ[_i], 10.0);
    finish();
    ck_assert_int_eq(clean.count, (int)(10.0 * RATES_HZ[_i]));
    worst_t worst = {0.0, 0.0};
    for (int i = 0; i < clean.count; i++) {
        insole_imu_t expected = moving(i / RATES_HZ[_i]);
        worst_require(&worst, memcmp(&clean.out[i].imu, &expected, sizeof expected) == 0, i);
        worst_require(&worst, clean.out[i].marks == 0u, i);
    }
    ASSERT_ALL_HELD(worst);
    insole_screen_counts_t counts = {0};
    counts.samples = (uint32_t)clean.count;
    ck_assert_mem_eq(&screen.counts, &counts, sizeof counts);
}
END_TEST

START_TEST(repeated_and_backward_stamps_are_dropped)
{
    begin(NULL);
    for (int i = 0; i < 200; i++) {
        push(moving(i / 200.0));
        if (i % 20 == 10) {
            push(moving(i / 200.0));
        }
        if (i % 40 == 30) {
            push(moving((i - 3) / 200.0));
        }
    }
    finish();
    ck_assert_int_eq(clean.count, 200);
    ck_assert_uint_eq(screen.counts.repeated, 10u);
    ck_assert_uint_eq(screen.counts.backward, 5u);
    assert_increasing();
}
END_TEST

/* One stamp far ahead must not make all that follow look late. */
START_TEST(a_wild_stamp_is_dropped_alone)
{
    begin(NULL);
    for (int i = 0; i < 200; i++) {
        insole_imu_t imu = moving(i / 200.0);
        imu.t_us += i == 100 ? UINT64_C(3600000000) : 0u;
        push(imu);
    }
    finish();
    ck_assert_int_eq(clean.count, 199);
    ck_assert_uint_eq(screen.counts.wild, 1u);
    ck_assert_uint_eq(screen.counts.backward, 0u);
    ck_assert_uint_eq(clean.out[clean.count - 1].imu.t_us, 995000u);
}
END_TEST

static insole_real_t *field(insole_imu_t *imu, int number)
{
    insole_vec3_t *v = number < 3 ? &imu->accel_mps2 : &imu->gyro_radps;
    return number % 3 == 0 ? &v->x : number % 3 == 1 ? &v->y : &v->z;
}

/* Each field, with each kind of nonsense: held for hold_s, then the samples are dropped. */
START_TEST(bad_fields_are_held_then_dropped)
{
    const insole_real_t bad[] = {(insole_real_t)NAN, (insole_real_t)INFINITY, INSOLE_R(-1e6)};
    int number = _i % 6;
    begin(NULL);
    for (int i = 0; i < 400; i++) {
        insole_imu_t imu = moving(i / 200.0);
        bool is_bad = (i >= 100 && i < 103) || (i >= 200 && i < 240);
        if (is_bad) {
            *field(&imu, number) = bad[_i / 6];
        }
        push(imu);
    }
    finish();
    insole_imu_t last_good = moving(99 / 200.0);
    for (int i = 100; i < 103; i++) {
        ASSERT_NEAR(*field(&clean.out[i].imu, number), *field(&last_good, number), 0.0, "");
        ck_assert(insole_vec3_is_finite(clean.out[i].imu.accel_mps2));
    }
    ck_assert_uint_eq(screen.counts.not_finite, 43u);
    ck_assert_int_eq(clean.count, 400 - (40 - 6)); /* 30 ms of 5 ms each are held */
    ck_assert_uint_eq(screen.counts.gaps, 1u);     /* the rest of the 0.2 s is missing */
    assert_increasing();
}
END_TEST

START_TEST(single_spikes_become_the_mean_of_their_neighbours)
{
    int number = _i;
    begin(NULL);
    for (int i = 0; i < 200; i++) {
        insole_imu_t imu = moving(i / 200.0);
        if (i == 77) {
            *field(&imu, number) += number < 3 ? INSOLE_R(400.0) : INSOLE_R(-20.0);
        }
        push(imu);
    }
    finish();
    insole_imu_t before = moving(76 / 200.0), after = moving(78 / 200.0);
    insole_real_t mean = INSOLE_R(0.5) * (*field(&before, number) + *field(&after, number));
    ASSERT_NEAR(*field(&clean.out[77].imu, number), mean, 1e-5, "");
    ck_assert_uint_eq(screen.counts.spikes, 1u);
    ck_assert_int_eq(clean.count, 200);
}
END_TEST

/* A heel strike of two samples, or one that rings on, is no spike. */
START_TEST(heel_strikes_stay)
{
    begin(NULL);
    for (int i = 0; i < 200; i++) {
        insole_imu_t imu = moving(i / 200.0);
        imu.accel_mps2.z += i == 50 || i == 51 ? INSOLE_R(180.0) : INSOLE_R(0.0);
        imu.accel_mps2.z += i == 120 ? INSOLE_R(160.0) : INSOLE_R(0.0);
        imu.accel_mps2.z -= i == 121 ? INSOLE_R(90.0) : INSOLE_R(0.0);
        push(imu);
    }
    finish();
    ck_assert_uint_eq(screen.counts.spikes, 0u);
    ASSERT_AT_LEAST(clean.out[50].imu.accel_mps2.z, 180.0, "m/s^2");
    ASSERT_AT_LEAST(clean.out[120].imu.accel_mps2.z, 160.0, "m/s^2");
}
END_TEST

START_TEST(gaps_are_marked_once)
{
    begin(NULL);
    for (int i = 0; i < 400; i++) {
        if (i < 100 || i >= 180) {
            push(moving(i / 200.0));
        }
    }
    finish();
    ck_assert_uint_eq(screen.counts.gaps, 1u);
    for (int i = 0; i < clean.count; i++) {
        ck_assert_int_eq((clean.out[i].marks & INSOLE_MARK_GAP) != 0u, i == 100);
    }
}
END_TEST

START_TEST(a_told_range_marks_its_axis)
{
    insole_screen_config_t config = insole_screen_defaults;
    config.gyro_range_radps = INSOLE_R(3.9);
    config.clip_share = INSOLE_R(0.9);
    begin(&config);
    run(200.0, 5.0);
    finish();
    uint32_t marked = 0u;
    worst_t worst = {0.0, 0.0};
    for (int i = 0; i < clean.count; i++) {
        bool far = insole_abs(clean.out[i].imu.gyro_radps.y) >= INSOLE_R(0.9) * INSOLE_R(3.9);
        marked += far ? 1u : 0u;
        worst_require(&worst, (clean.out[i].marks & INSOLE_MARK_CLIP) == (far ? 2u : 0u), i);
    }
    ASSERT_ALL_HELD(worst);
    ck_assert_uint_eq(screen.counts.clipped, marked);
    ASSERT_AT_LEAST(marked, 100.0, "samples");
}
END_TEST

START_TEST(bursts_are_evened_out)
{
    begin(NULL);
    int burst = 2 + _i;
    for (int i = 0; i < 4000; i++) {
        insole_imu_t imu = moving(i / 200.0);
        int last = i - i % burst + burst - 1;
        imu.t_us = (uint64_t)(last * 5000 + (i % burst) * 40 - (burst - 1) * 40);
        push(imu);
    }
    finish();
    assert_increasing();
    ASSERT_AT_LEAST(screen.counts.evened, 3800.0, "stamps");
    worst_t worst = {0.0, 0.0};
    double sum = 0.0;
    for (int i = 2000; i < clean.count - 1; i++) {
        double dt_us = (double)(clean.out[i + 1].imu.t_us - clean.out[i].imu.t_us);
        worst_note(&worst, fabs(dt_us - 5000.0), i);
        sum += dt_us;
    }
    ASSERT_WORST(worst, 1500.0, "us from the sensor's interval");
    ASSERT_NEAR(sum / (clean.count - 2001), 5000.0, 10.0, "us");
    /* Until the bursts are noticed, what lies too close is averaged. */
    ck_assert_int_eq(clean.count, 4000 - (int)screen.counts.averaged);
    ASSERT_AT_MOST(screen.counts.averaged, 30.0, "samples");
}
END_TEST

/* Lost samples leave honest stamps, and so does a little jitter. */
START_TEST(honest_stamps_stay)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 1u);
    begin(NULL);
    int sent = 0;
    for (int i = 0; i < 4000; i++) {
        bool lost = insole_rng_uniform(&rng) < INSOLE_R(0.05);
        insole_imu_t imu = moving(i / 200.0);
        imu.t_us += insole_rng_bits(&rng) % 600u;
        if (!lost) {
            push(imu);
            ck_assert_int_le(clean.count, ++sent);
        }
    }
    finish();
    ck_assert_uint_eq(screen.counts.evened, 0u);
    ck_assert_int_eq(clean.count, sent);
}
END_TEST

/* Averaged down: at most 250 a second, and what the samples add up to over time is kept. */
START_TEST(fast_samples_are_averaged_and_nothing_is_lost)
{
    static const double FAST_HZ[] = {400.0, 500.0, 820.0, 1000.0};
    double rate_hz = FAST_HZ[_i];
    begin(NULL);
    run(rate_hz, 10.0);
    finish();
    double accel = 0.0, gyro = 0.0, raw_accel = 0.0, raw_gyro = 0.0;
    worst_t worst = {0.0, 0.0};
    for (int i = 1; i < clean.count; i++) {
        double dt_s = 1e-6 * (double)(clean.out[i].imu.t_us - clean.out[i - 1].imu.t_us);
        worst_note(&worst, i < clean.count - 1 ? 0.0039 - dt_s : 0.0, i);
        accel += dt_s * (double)clean.out[i].imu.accel_mps2.z;
        gyro += dt_s * (double)clean.out[i].imu.gyro_radps.y;
    }
    uint64_t end_us = clean.out[clean.count - 1].imu.t_us;
    for (int i = 1; moving(i / rate_hz).t_us <= end_us; i++) {
        insole_imu_t imu = moving(i / rate_hz);
        double dt_s = 1e-6 * (double)(imu.t_us - moving((i - 1) / rate_hz).t_us);
        raw_accel += dt_s * (double)imu.accel_mps2.z;
        raw_gyro += dt_s * (double)imu.gyro_radps.y;
    }
    ASSERT_WORST(worst, 0.0, "s shorter than allowed");
    ASSERT_NEAR(accel, raw_accel, 2e-3, "m/s");
    ASSERT_NEAR(gyro, raw_gyro, 2e-4, "rad");
    ck_assert_uint_gt(screen.counts.averaged, 0u);
}
END_TEST

/* Whatever bits come in: what goes out is finite and in the order of time. */
START_TEST(nonsense_never_gets_through)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, (uint64_t)_i);
    begin(NULL);
    worst_t worst = {0.0, 0.0};
    for (int i = 0; i < 15000; i++) {
        insole_imu_t imu = moving(i / 200.0);
        if (insole_rng_bits(&rng) % 4u == 0u) {
            for (int k = 0; k < 6; k++) {
                uint32_t bits[2] = {insole_rng_bits(&rng), insole_rng_bits(&rng)};
                memcpy(field(&imu, k), bits, sizeof(insole_real_t));
            }
        }
        if (insole_rng_bits(&rng) % 16u == 0u) {
            imu.t_us = (uint64_t)insole_rng_bits(&rng) << (insole_rng_bits(&rng) % 33u);
        }
        push(imu);
    }
    finish();
    for (int i = 0; i < clean.count; i++) {
        worst_require(&worst, insole_vec3_is_finite(clean.out[i].imu.accel_mps2), i);
        worst_require(&worst, insole_vec3_is_finite(clean.out[i].imu.gyro_radps), i);
    }
    ASSERT_ALL_HELD(worst);
    assert_increasing();
}
END_TEST

START_TEST(saved_it_goes_on_the_same)
{
    begin(NULL);
    run(820.0, 3.0);
    insole_screen_t saved = screen;
    clean.count = 0;
    for (int i = 2460; i < 5000; i++) {
        push(moving(i / 820.0));
    }
    memcpy(&plain, &clean, sizeof clean);
    screen = saved;
    clean.count = 0;
    for (int i = 2460; i < 5000; i++) {
        push(moving(i / 820.0));
    }
    ck_assert_int_eq(plain.count, clean.count);
    worst_t worst = {0.0, 0.0};
    for (int i = 0; i < clean.count; i++) {
        worst_require(&worst, plain.out[i].imu.t_us == clean.out[i].imu.t_us, i);
        worst_note(&worst, apart(plain.out[i].imu.accel_mps2, clean.out[i].imu.accel_mps2), i);
    }
    ASSERT_ALL_HELD(worst);
}
END_TEST

START_TEST(refusals)
{
    insole_screen_config_t config = insole_screen_defaults;
    insole_imu_t imu = moving(0.0);
    ck_assert_int_eq(insole_screen_init(NULL, &config), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_screen_init(&screen, NULL), INSOLE_ERR_NULL);
    config.gap_s = (insole_real_t)NAN;
    ck_assert_int_eq(insole_screen_init(&screen, &config), INSOLE_ERR_VALUE);
    begin(NULL);
    ck_assert_int_eq(insole_screen_push(NULL, &imu, &clean.out[0]), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_screen_push(&screen, NULL, &clean.out[0]), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_screen_push(&screen, &imu, NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_screen_finish(&screen, NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_screen_finish(NULL, &clean.out[0]), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_screen_finish(&screen, &clean.out[0]), INSOLE_ERR_STATE);
}
END_TEST

/* ---- most samples need no close look: none must escape that does --------------------------- */

enum { JUMPY = 10000 };

static double jumpy[JUMPY][6], mended[JUMPY][6];

/* A slow motion; now and then one axis jumps anywhere. */
static void make_jumpy(uint64_t seed)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, seed);
    for (int i = 0; i < JUMPY; i++) {
        for (int k = 0; k < 6; k++) {
            jumpy[i][k] = (double)sample_between(&rng, INSOLE_R(-1.0), INSOLE_R(1.0));
        }
        uint32_t axis = insole_rng_bits(&rng) % 60u;
        double most = axis < 3u ? 400.0 : 20.0;
        insole_real_t jump = sample_between(&rng, INSOLE_R(-1.0), INSOLE_R(1.0));
        if (axis < 6u) {
            jumpy[i][axis] = (double)((insole_real_t)most * jump);
        }
    }
}

/* A single value far from both neighbours, which agree. */
static double by_the_rule(double before, double middle, double after, double limit)
{
    double rise = middle - before, fall = middle - after, least = fmin(fabs(rise), fabs(fall));
    bool spike = rise * fall > 0.0 && least > limit && fabs(after - before) < 0.25 * least;
    return spike ? 0.5 * (before + after) : middle;
}

static void mend_all(const insole_screen_config_t *c)
{
    memcpy(mended, jumpy, sizeof mended);
    for (int i = 1; i + 1 < JUMPY; i++) {
        for (int k = 0; k < 6; k++) {
            double limit = (double)(k < 3 ? c->spike_accel_mps2 : c->spike_gyro_radps);
            mended[i][k] = by_the_rule(mended[i - 1][k], jumpy[i][k], jumpy[i + 1][k], limit);
        }
    }
}

static int marks_of(const insole_screen_config_t *c, const double *v)
{
    int marks = 0;
    for (int k = 0; k < 3; k++) {
        bool clipped = (insole_real_t)fabs(v[3 + k]) >= c->clip_share * c->gyro_range_radps;
        marks |= clipped ? 1 << k : 0;
    }
    return marks;
}

static insole_vec3_t vec3_of(const double *v)
{
    return insole_vec3((insole_real_t)v[0], (insole_real_t)v[1], (insole_real_t)v[2]);
}

static const double RANGES_RADPS[] = {2.0, 4.0, 6.0, 8.0, 12.0};
static const double SPIKES[][2] = {{8.0, 150.0}, {3.0, 40.0}, {15.0, 1.0e6}};

START_TEST(jumps_and_clipped_samples_by_the_rule)
{
    insole_screen_config_t config = insole_screen_defaults;
    config.gyro_range_radps = (insole_real_t)RANGES_RADPS[_i % 5];
    config.spike_gyro_radps = (insole_real_t)SPIKES[_i % 3][0];
    config.spike_accel_mps2 = (insole_real_t)SPIKES[_i % 3][1];
    make_jumpy((uint64_t)_i + 1u);
    mend_all(&config);
    begin(&config);
    for (int i = 0; i < JUMPY; i++) {
        insole_imu_t imu = {(uint64_t)i * 5000u, vec3_of(jumpy[i]), vec3_of(jumpy[i] + 3)};
        push(imu);
    }
    finish();
    ck_assert_int_eq(clean.count, JUMPY);
    worst_t value = {0.0, 0.0}, marks = {0.0, 0.0};
    for (int i = 0; i < JUMPY; i++) {
        const insole_clean_t *c = &clean.out[i];
        insole_vec3_t accel = insole_vec3_sub(c->imu.accel_mps2, vec3_of(mended[i]));
        insole_vec3_t gyro = insole_vec3_sub(c->imu.gyro_radps, vec3_of(mended[i] + 3));
        worst_note(&value, (double)insole_vec3_max_abs(accel), i);
        worst_note(&value, (double)insole_vec3_max_abs(gyro), i);
        worst_require(&marks, c->marks == marks_of(&config, jumpy[i]), i);
    }
    ASSERT_WORST(value, 1e-6, "m/s2 or rad/s");
    ASSERT_ALL_HELD(marks);
    ck_assert_uint_gt(screen.counts.spikes, 50u);
    ck_assert_uint_gt(screen.counts.clipped, 50u);
}
END_TEST

/* In the screen or in the caller's room: what is taken is what would have been pushed. Plain
 * stamps, stamps in bursts, too many samples. */
START_TEST(what_is_taken_is_what_is_pushed)
{
    static insole_screen_t taken;
    insole_clean_t room, pushed;
    const double dt_us[] = {5000.0, 5000.0, 1300.0};
    int in_room = 0, elsewhere = 0;
    make_jumpy(77u);
    begin(NULL);
    taken = screen;
    for (int i = 0; i < JUMPY; i++) {
        uint64_t t_us = (uint64_t)(dt_us[_i] * (_i == 1 ? i / 4 * 4 + 0.01 * (i % 4) : i));
        insole_imu_t imu = {t_us, vec3_of(jumpy[i]), vec3_of(jumpy[i] + 3)};
        insole_status_t status = insole_screen_push(&screen, &imu, &pushed);
        const insole_clean_t *out = insole_screen_take(&taken, &imu, &room);
        ck_assert(!out == (status == INSOLE_ERR_STATE));
        if (out) {
            ck_assert(out->imu.t_us == pushed.imu.t_us && out->marks == pushed.marks);
            ck_assert_mem_eq(&out->imu, &pushed.imu, sizeof pushed.imu);
            in_room += out == &room ? 1 : 0;
            elsewhere += out == &room ? 0 : 1;
        }
    }
    ck_assert_mem_eq(&taken, &screen, sizeof screen);
    ck_assert_int_gt(_i == 0 ? elsewhere : in_room, 1000);
}
END_TEST

START_TEST(nothing_is_taken_from_nowhere)
{
    insole_imu_t imu = moving(1.0);
    insole_clean_t room;
    begin(NULL);
    insole_screen_t before = screen;
    ck_assert(!insole_screen_take(NULL, &imu, &room));
    ck_assert(!insole_screen_take(&screen, NULL, &room));
    ck_assert(!insole_screen_take(&screen, &imu, NULL));
    finish();
    before.finished = true;
    ck_assert(!insole_screen_take(&screen, &imu, &room));
    ck_assert_mem_eq(&screen, &before, sizeof screen);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("screen");
    suite_add_loop(suite, "good samples", good_samples_pass_untouched, 4);
    suite_add(suite, "late stamps", repeated_and_backward_stamps_are_dropped);
    suite_add(suite, "wild stamp", a_wild_stamp_is_dropped_alone);
    suite_add_loop(suite, "bad fields", bad_fields_are_held_then_dropped, 18);
    suite_add_loop(suite, "spikes", single_spikes_become_the_mean_of_their_neighbours, 6);
    suite_add(suite, "heel strikes", heel_strikes_stay);
    suite_add(suite, "gaps", gaps_are_marked_once);
    suite_add(suite, "told range", a_told_range_marks_its_axis);
    suite_add_loop(suite, "bursts", bursts_are_evened_out, 2);
    suite_add(suite, "honest stamps", honest_stamps_stay);
    suite_add_loop(suite, "averages", fast_samples_are_averaged_and_nothing_is_lost, 4);
    suite_add_loop(suite, "nonsense", nonsense_never_gets_through, 20);
    suite_add_loop(suite, "by the rule", jumps_and_clipped_samples_by_the_rule, 15);
    suite_add_loop(suite, "taken", what_is_taken_is_what_is_pushed, 3);
    suite_add(suite, "none taken", nothing_is_taken_from_nowhere);
    suite_add(suite, "save", saved_it_goes_on_the_same);
    suite_add(suite, "refusals", refusals);
    return suite;
}
