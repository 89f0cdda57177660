/* SPDX-License-Identifier: MIT */
#include "hand_walk.h"
#include "insole/base/snapshot.h"
#include "insole/track/phone_tracker.h"
#include "refusal.h"
#include "suite.h"

enum { SHORT = 2600, MOST_READINGS = 40 };

static insole_fix_t reference[HAND_SAMPLES];
static rig_t rig, other;

/* A walk with everything that a phone has. */
static rig_case_t full_case(bool has_start)
{
    walk_legs(&usual_hand, L_SHAPE, 5);
    sample_count = SHORT;
    hear_on_the_way(1.0, 3.0);
    rig_case_t c = usual_case(&usual_hand);
    c.has_start = has_start;
    c.hears = c.sees = true;
    return c;
}

static uint32_t run_reference(const rig_case_t *c)
{
    run_case(&rig, c);
    memcpy(reference, fixes, sizeof reference);
    return fix_count;
}

/* ---- in and out ---------------------------------------------------------------------------- */

START_TEST(finish_gives_one_fix_per_sample_and_only_once)
{
    insole_fix_t fix;
    rig_case_t c = full_case(true);
    run_case(&rig, &c);
    ck_assert_uint_eq(fix_count, sample_count);
    ck_assert_uint_eq(rig.phone.counts.fixes, sample_count);
    for (uint32_t i = 0u; i < fix_count; i++) {
        ck_assert(fixes[i].t_us == samples[i].t_us);
    }
    ASSERT_UNCHANGED(rig, insole_phone_tracker_finish(&rig.phone), INSOLE_OK);
    ASSERT_UNCHANGED(rig, insole_phone_tracker_next(&rig.phone, &fix), INSOLE_ERR_STATE);
}
END_TEST

START_TEST(nothing_in_nothing_out)
{
    insole_fix_t fix;
    rig_case_t c = full_case(true);
    set_up(&rig, &c);
    ck_assert_int_eq(insole_phone_tracker_next(&rig.phone, &fix), INSOLE_ERR_STATE);
    ck_assert(!insole_phone_tracker_work(&rig.phone, 16u));
    ck_assert_int_eq(insole_phone_tracker_finish(&rig.phone), INSOLE_OK);
    ck_assert_int_eq(insole_phone_tracker_next(&rig.phone, &fix), INSOLE_ERR_STATE);
}
END_TEST

/* Nothing gets lost when the caller takes the last fix after the finish. */
START_TEST(a_fix_that_waits_at_the_finish_is_not_lost)
{
    rig_case_t c = full_case(true);
    uint32_t expected = run_reference(&c);
    set_up(&rig, &c);
    run(&rig, &c, 0u, sample_count - 1u);
    ck_assert_int_eq(insole_phone_tracker_imu(&rig.phone, &samples[sample_count - 1u]), INSOLE_OK);
    finish(&rig);
    ck_assert_uint_eq(fix_count, expected);
    expect_same_fixes(fixes, reference, 0u, expected);
}
END_TEST

/* A phone that samples faster than is looked at: the last mean comes out, too. */
START_TEST(a_fast_phone_gets_all_of_its_fixes)
{
    phone_t p = phone(turn_x(0.5), 4u);
    insole_fix_t fix;
    uint64_t last_us = 0u, end_us = 0u;
    uint32_t count = 0u;
    rig_case_t c = full_case(true);
    set_up(&rig, &c);
    for (int i = 0; i < 1001; i++) {
        insole_imu_t imu = phone_sample(&p, d3(0.0, 0.0, 0.0), 2500u);
        end_us = imu.t_us;
        ck_assert_int_eq(insole_phone_tracker_imu(&rig.phone, &imu), INSOLE_OK);
        for (; insole_phone_tracker_next(&rig.phone, &fix) == INSOLE_OK; count++) {
            ck_assert(fix.t_us > last_us);
            last_us = fix.t_us;
        }
    }
    ck_assert_int_eq(insole_phone_tracker_finish(&rig.phone), INSOLE_OK);
    for (; insole_phone_tracker_next(&rig.phone, &fix) == INSOLE_OK; count++) {
        ck_assert(fix.t_us > last_us);
        last_us = fix.t_us;
    }
    ck_assert_uint_eq(count, rig.phone.counts.fixes);
    ck_assert(end_us - last_us <= 5000u);
}
END_TEST

START_TEST(a_sample_is_refused_until_the_fix_is_taken)
{
    uint32_t i = 0u;
    rig_case_t c = full_case(true);
    (void)run_reference(&c);
    set_up(&rig, &c);
    while (insole_phone_tracker_imu(&rig.phone, &samples[i]) == INSOLE_OK) {
        i++;
    }
    ck_assert_uint_eq(i, 2u); /* one is held back */
    ASSERT_REFUSED(rig, rig.phone.counts.refused, insole_phone_tracker_imu(&rig.phone, &samples[i]),
                   INSOLE_ERR_ROOM);
    take_fixes(&rig);
    ck_assert_uint_eq(fix_count, 1u);
    ck_assert_int_eq(insole_phone_tracker_imu(&rig.phone, &samples[i]), INSOLE_OK);
}
END_TEST

START_TEST(after_the_finish_no_sample_is_taken)
{
    rig_case_t c = full_case(true);
    run_case(&rig, &c);
    insole_imu_t late = samples[sample_count - 1u];
    late.t_us += 10000u;
    ASSERT_REFUSED(rig, rig.phone.counts.refused, insole_phone_tracker_imu(&rig.phone, &late),
                   INSOLE_ERR_STATE);
}
END_TEST

/* ---- the same bits ------------------------------------------------------------------------- */

START_TEST(fixes_of_a_prefix_are_a_prefix_of_the_fixes)
{
    const double share[] = {0.02, 0.14, 0.2, 0.45, 0.8};
    rig_case_t c = full_case(_i % 2 == 0);
    (void)run_reference(&c);
    uint32_t cut = (uint32_t)(share[_i] * sample_count);
    set_up(&rig, &c);
    run(&rig, &c, 0u, cut);
    ck_assert_uint_ge(fix_count + 1u, cut);
    expect_same_fixes(fixes, reference, 0u, fix_count);
    finish(&rig);
    ck_assert_uint_eq(fix_count, cut);
}
END_TEST

START_TEST(a_copy_goes_on_bit_for_bit)
{
    const uint32_t cuts[] = {0u, 3u, 299u, 410u, 460u, 1205u, 2400u};
    rig_case_t c = full_case(_i % 2 == 0);
    uint32_t expected = run_reference(&c), cut = cuts[_i];
    set_up(&rig, &c);
    run(&rig, &c, 0u, cut);
    rig_move(&other, &rig, &c);
    memset(&rig, 0xa5, sizeof rig);
    run(&other, &c, cut, sample_count);
    finish(&other);
    ck_assert_uint_eq(fix_count, expected);
    expect_same_fixes(fixes, reference, 0u, expected);
}
END_TEST

/* Parts stay where they are; tracker and parts are written out and read again. */
START_TEST(saved_and_restored_it_goes_on_bit_for_bit)
{
    static uint8_t saved[sizeof(rig_t) + INSOLE_SNAPSHOT_HEADER_BYTES];
    size_t used;
    rig_case_t c = full_case(true);
    uint32_t expected = run_reference(&c);
    set_up(&rig, &c);
    run(&rig, &c, 0u, 1205u);
    ck_assert_int_eq(insole_snapshot_save(9u, &rig, sizeof rig, saved, sizeof saved, &used),
                     INSOLE_OK);
    memset(&rig, 0xa5, sizeof rig);
    ck_assert_int_eq(insole_snapshot_load(9u, &rig, sizeof rig, saved, used), INSOLE_OK);
    run(&rig, &c, 1205u, sample_count);
    finish(&rig);
    ck_assert_uint_eq(fix_count, expected);
    expect_same_fixes(fixes, reference, 0u, expected);
}
END_TEST

START_TEST(slices_of_work_give_the_same_bits)
{
    const uint32_t slices[] = {1u, 3u, 16u, 63u, 64u, 65u};
    rig_case_t c = full_case(_i % 2 == 0);
    uint32_t expected = run_reference(&c);
    c.slice = slices[_i];
    run_case(&rig, &c);
    ck_assert_uint_eq(fix_count, expected);
    expect_same_fixes(fixes, reference, 0u, expected);
    ck_assert_uint_eq(rig.phone.radio.fixes, scan_count);
}
END_TEST

/* Work that spreads over samples comes later, but it comes. */
START_TEST(work_may_spread_over_samples)
{
    rig_case_t c = full_case(true);
    set_up(&rig, &c);
    for (uint32_t i = 0u, scan = 0u; i < sample_count; i++) {
        ck_assert_int_eq(insole_phone_tracker_imu(&rig.phone, &samples[i]), INSOLE_OK);
        take_fixes(&rig);
        if (scan < scan_count && scans[scan].t_us <= samples[i].t_us) {
            insole_scan_t s = {scans[scan].t_us, scans[scan].readings, scans[scan].count};
            ck_assert_int_eq(insole_phone_tracker_scan(&rig.phone, &s), INSOLE_OK);
            scan++;
        }
        (void)insole_phone_tracker_work(&rig.phone, 2u); /* 64 fingerprints: 32 samples */
    }
    finish(&rig);
    ck_assert_uint_eq(rig.phone.radio.given_up, 0u);
    ck_assert_uint_ge(rig.phone.radio.fixes + 1u, scan_count);
    ASSERT_AT_MOST(error_at_end(), 2.5, "m");
}
END_TEST

/* Another phone, fed in turns with other samples, is none of this one's business. */
START_TEST(instances_are_independent)
{
    insole_fix_t elsewhere;
    rig_case_t c = full_case(_i == 0);
    uint32_t expected = run_reference(&c);
    set_up(&other, &c);
    set_up(&rig, &c);
    for (uint32_t i = 0u; i < sample_count; i++) {
        insole_imu_t turned = samples[i];
        turned.gyro_radps = insole_vec3_neg(turned.gyro_radps);
        run(&rig, &c, i, i + 1u);
        (void)insole_phone_tracker_imu(&other.phone, &turned);
        while (insole_phone_tracker_next(&other.phone, &elsewhere) == INSOLE_OK) {
        }
        if (i % 70u == 0u) {
            insole_scan_t scan = {turned.t_us, scans[i % scan_count].readings,
                                  scans[i % scan_count].count};
            (void)insole_phone_tracker_scan(&other.phone, &scan);
            (void)insole_phone_tracker_work(&other.phone, 1000u);
        }
    }
    finish(&rig);
    ck_assert_uint_eq(fix_count, expected);
    expect_same_fixes(fixes, reference, 0u, expected);
}
END_TEST

/* ---- whatever comes in --------------------------------------------------------------------- */

/* Any bits at all, or one of the values that break things. */
static insole_real_t garbage(insole_rng_t *rng)
{
    const double values[] = {(double)NAN, HUGE_VAL, -HUGE_VAL, 3.0e38, -3.0e38, 1.0e4, -160.0, 0.0};
    union {
        uint32_t bits;
        float value;
    } any = {insole_rng_bits(rng)};
    uint32_t choice = insole_rng_bits(rng) % 16u;
    return choice < 8u ? (insole_real_t)values[choice] : (insole_real_t)any.value;
}

static uint64_t wild_stamp(insole_rng_t *rng, uint64_t t_us)
{
    const int64_t shifts_us[] = {0, 1, 5000, -5000, -100000000, 1000000000, INT64_MAX};
    return t_us + (uint64_t)shifts_us[insole_rng_bits(rng) % 7u];
}

static insole_imu_t spoiled(const insole_imu_t *good, insole_rng_t *rng)
{
    insole_imu_t bad = *good;
    insole_real_t *fields[] = {&bad.accel_mps2.x, &bad.accel_mps2.y, &bad.accel_mps2.z,
                               &bad.gyro_radps.x, &bad.gyro_radps.y, &bad.gyro_radps.z};
    for (uint32_t i = insole_rng_bits(rng) % 4u; i > 0u; i--) {
        *fields[insole_rng_bits(rng) % 6u] = garbage(rng);
    }
    bad.t_us = wild_stamp(rng, bad.t_us);
    return bad;
}

static void tell_nonsense(insole_phone_tracker_t *phone, insole_rng_t *rng, uint64_t t_us)
{
    static insole_rss_t readings[MOST_READINGS];
    insole_mag_t mag = {wild_stamp(rng, t_us), {garbage(rng), garbage(rng), garbage(rng)}};
    insole_start_t start = {
        wild_stamp(rng, t_us), garbage(rng), garbage(rng), insole_rng_bits(rng) % 2u == 0u,
        garbage(rng),          garbage(rng), garbage(rng)};
    for (uint32_t i = 0u; i < MOST_READINGS; i++) {
        readings[i].id = insole_rng_bits(rng) % 2u == 0u ? i : insole_rng_bits(rng);
        readings[i].rss_dbm = insole_rng_bits(rng) % 2u == 0u ? INSOLE_R(-60.0) : garbage(rng);
        readings[i].age_us = insole_rng_bits(rng) % 2u == 0u ? 0u : insole_rng_bits(rng);
    }
    insole_scan_t scan = {wild_stamp(rng, t_us), readings, insole_rng_bits(rng) % MOST_READINGS};
    (void)insole_phone_tracker_mag(phone, &mag);
    (void)insole_phone_tracker_start(phone, &start);
    (void)insole_phone_tracker_scan(phone, &scan);
    (void)insole_phone_tracker_work(phone, insole_rng_bits(rng) % 100u);
}

START_TEST(garbage_never_makes_a_fix_that_is_no_number)
{
    const insole_step_filter_calls_t *filters[] = {&insole_step_ekf_calls, &insole_step_kf_calls,
                                                   &insole_ml_shift_calls, NULL};
    insole_rng_t rng;
    insole_fix_t fix;
    uint64_t last_us = 0u;
    insole_rng_seed(&rng, 300u + (uint64_t)_i);
    rig_case_t c = full_case(false);
    c.filter = filters[_i % 4];
    set_up(&rig, &c);
    for (uint32_t i = 0u; i < 2u * sample_count; i++) {
        insole_imu_t imu = samples[i / 2u];
        if (i % 2u != 0u) {
            imu = spoiled(&imu, &rng);
        }
        if (insole_rng_bits(&rng) % 20u == 0u) {
            tell_nonsense(&rig.phone, &rng, imu.t_us);
        }
        ck_assert(insole_phone_tracker_imu(&rig.phone, &imu) == INSOLE_OK);
        while (insole_phone_tracker_next(&rig.phone, &fix) == INSOLE_OK) {
            fix_count++;
            if (!is_sane_fix(&fix) || fix.t_us <= last_us) {
                ck_abort_msg("fix %u of sample %u", fix_count, i);
            }
            last_us = fix.t_us;
        }
    }
    ck_assert_uint_gt(fix_count, 0u);
    ck_assert_uint_gt(rig.phone.counts.refused, 0u);
    ck_assert_uint_gt(rig.phone.screen.counts.not_finite, 0u);
    ck_assert_uint_gt(rig.phone.screen.counts.backward, 0u);
}
END_TEST

/* One scan whose stamp leads astray must not shut out all that come after it. */
START_TEST(a_scan_far_ahead_does_not_end_the_fixes)
{
    const uint64_t ahead_us[] = {100000000u, 10000000000u, UINT64_MAX / 4u};
    rig_case_t c = full_case(true);
    c.start.sigma_m = INSOLE_R(5.0);
    c.start.x_m += INSOLE_R(5.0);
    set_up(&rig, &c);
    run(&rig, &c, 0u, 500u);
    insole_scan_t wild = {samples[500].t_us + ahead_us[_i], scans[5].readings, scans[5].count};
    (void)insole_phone_tracker_scan(&rig.phone, &wild);
    work(&rig, &c);
    run(&rig, &c, 500u, sample_count);
    finish(&rig);
    ASSERT_AT_MOST(error_at_end(), 2.5, "m");
    ck_assert_uint_eq(rig.phone.place.refused, 0u);
}
END_TEST

/* A scan of which the way since has been forgotten is no fix. */
START_TEST(a_scan_of_long_ago_is_refused)
{
    rig_case_t c = full_case(true);
    set_up(&rig, &c);
    run(&rig, &c, 0u, 2000u);
    insole_scan_t old = {samples[600].t_us, scans[5].readings, scans[5].count};
    ASSERT_REFUSED(rig, rig.phone.counts.refused, insole_phone_tracker_scan(&rig.phone, &old),
                   INSOLE_ERR_TIME);
    old.t_us = samples[1400].t_us; /* 12 steps ago */
    ck_assert_int_eq(insole_phone_tracker_scan(&rig.phone, &old), INSOLE_OK);
}
END_TEST

/* ---- refusals ------------------------------------------------------------------------------ */

START_TEST(bad_starts_leave_all_as_it_was)
{
    insole_start_t bad = start_of(&usual_hand, true);
    rig_case_t c = full_case(true);
    set_up(&rig, &c);
    run(&rig, &c, 0u, 800u);
    bad.x_m = (insole_real_t)NAN;
    ASSERT_REFUSED(rig, rig.phone.counts.refused, insole_phone_tracker_start(&rig.phone, &bad),
                   INSOLE_ERR_VALUE);
    bad.x_m = INSOLE_R(2.0e5);
    ASSERT_REFUSED(rig, rig.phone.counts.refused, insole_phone_tracker_start(&rig.phone, &bad),
                   INSOLE_ERR_VALUE);
    ASSERT_REFUSED(rig, rig.phone.counts.refused, insole_phone_tracker_start(&rig.phone, NULL),
                   INSOLE_ERR_NULL);
}
END_TEST

START_TEST(bad_fields_and_scans_leave_the_position_as_it_was)
{
    const insole_real_t bad[] = {(insole_real_t)NAN, (insole_real_t)INFINITY, INSOLE_R(1.0e5)};
    insole_phone_answer_t before, after;
    rig_case_t c = full_case(true);
    set_up(&rig, &c);
    run(&rig, &c, 0u, 800u);
    (void)insole_phone_place_answer(&rig.phone.place, samples[800].t_us, &before);
    insole_mag_t mag = {samples[800].t_us, {INSOLE_R(0.0), bad[_i], INSOLE_R(20.0)}};
    ASSERT_REFUSED(rig, rig.phone.counts.refused, insole_phone_tracker_mag(&rig.phone, &mag),
                   INSOLE_ERR_VALUE);
    insole_rss_t reading = {0u, bad[_i], 0u};
    insole_scan_t scan = {samples[800].t_us, &reading, 1u};
    uint32_t refused = rig.phone.counts.refused;
    ck_assert_int_ne(insole_phone_tracker_scan(&rig.phone, &scan), INSOLE_OK);
    ck_assert_uint_eq(rig.phone.counts.refused, refused + 1u);
    ck_assert(!insole_phone_tracker_work(&rig.phone, 1000u));
    (void)insole_phone_place_answer(&rig.phone.place, samples[800].t_us, &after);
    ck_assert(after.at.spot.x_m == before.at.spot.x_m && after.at.spot.y_m == before.at.spot.y_m);
    ck_assert(after.at.cov_m2.xx == before.at.cov_m2.xx);
}
END_TEST

START_TEST(trackers_of_nothing_are_refused)
{
    insole_phone_tracker_config_t config = insole_phone_tracker_defaults;
    rig_case_t c = full_case(true);
    set_up(&rig, &c);
    insole_phone_parts_t parts = parts_of(&rig, &c), none = {.attitude = insole_attitude_ekf};
    ASSERT_UNCHANGED(rig, insole_phone_tracker_init(&rig.phone, &config, &none, &prints.map),
                     INSOLE_ERR_VALUE);
    none.solver = parts.solver; /* a solver, but no map */
    ASSERT_UNCHANGED(rig, insole_phone_tracker_init(&rig.phone, &config, &none, NULL),
                     INSOLE_ERR_VALUE);
    insole_phone_parts_t lacking = parts;
    lacking.filter.state = NULL;
    ASSERT_UNCHANGED(rig, insole_phone_tracker_init(&rig.phone, &config, &lacking, &prints.map),
                     INSOLE_ERR_VALUE);
    lacking = parts;
    lacking.solver.state = NULL;
    ASSERT_UNCHANGED(rig, insole_phone_tracker_init(&rig.phone, &config, &lacking, &prints.map),
                     INSOLE_ERR_VALUE);
    config.walk.step.low_pass_hz = (insole_real_t)NAN;
    ASSERT_UNCHANGED(rig, insole_phone_tracker_init(&rig.phone, &config, &parts, &prints.map),
                     INSOLE_ERR_VALUE);
    ck_assert_int_eq(insole_phone_tracker_init(&rig.phone, &c.config, &none, &prints.map),
                     INSOLE_OK); /* radio alone */
    ck_assert_int_eq(insole_phone_tracker_start(&rig.phone, &c.start), INSOLE_ERR_STATE);
}
END_TEST

START_TEST(without_radio_scans_are_refused)
{
    rig_case_t c = full_case(true);
    c.hears = false;
    set_up(&rig, &c);
    insole_scan_t scan = {samples[10].t_us, scans[0].readings, scans[0].count};
    ASSERT_REFUSED(rig, rig.phone.counts.refused, insole_phone_tracker_scan(&rig.phone, &scan),
                   INSOLE_ERR_STATE);
}
END_TEST

START_TEST(null_is_refused)
{
    insole_fix_t fix;
    rig_case_t c = full_case(true);
    set_up(&rig, &c);
    run(&rig, &c, 0u, 300u);
    insole_phone_parts_t parts = parts_of(&rig, &c);
    insole_phone_tracker_t *phone = &rig.phone;
    ASSERT_UNCHANGED(rig, insole_phone_tracker_imu(phone, NULL), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(rig, insole_phone_tracker_mag(phone, NULL), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(rig, insole_phone_tracker_next(phone, NULL), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(rig, insole_phone_tracker_next(phone, &fix), INSOLE_ERR_STATE);
    ASSERT_UNCHANGED(rig, insole_phone_tracker_work(phone, 0u), false);
    ASSERT_REFUSED(rig, phone->counts.refused, insole_phone_tracker_scan(phone, NULL),
                   INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(rig, insole_phone_tracker_init(phone, NULL, &parts, NULL), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(rig, insole_phone_tracker_init(phone, &c.config, NULL, NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_phone_tracker_init(NULL, &c.config, &parts, NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_phone_tracker_start(NULL, &c.start), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_phone_tracker_imu(NULL, samples), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_phone_tracker_mag(NULL, mags), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_phone_tracker_scan(NULL, NULL), INSOLE_ERR_NULL);
    ck_assert(!insole_phone_tracker_work(NULL, 16u));
    ck_assert_int_eq(insole_phone_tracker_next(NULL, &fix), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_phone_tracker_finish(NULL), INSOLE_ERR_NULL);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("phone_tracker_promises");
    suite_add(suite, "finish", finish_gives_one_fix_per_sample_and_only_once);
    suite_add(suite, "nothing", nothing_in_nothing_out);
    suite_add(suite, "fix that waits", a_fix_that_waits_at_the_finish_is_not_lost);
    suite_add(suite, "fast phone", a_fast_phone_gets_all_of_its_fixes);
    suite_add(suite, "room", a_sample_is_refused_until_the_fix_is_taken);
    suite_add(suite, "after the finish", after_the_finish_no_sample_is_taken);
    suite_add_loop(suite, "prefix law", fixes_of_a_prefix_are_a_prefix_of_the_fixes, 5);
    suite_add_loop(suite, "copy", a_copy_goes_on_bit_for_bit, 7);
    suite_add(suite, "save and restore", saved_and_restored_it_goes_on_bit_for_bit);
    suite_add_loop(suite, "slices", slices_of_work_give_the_same_bits, 6);
    suite_add(suite, "work spreads", work_may_spread_over_samples);
    suite_add_loop(suite, "two instances", instances_are_independent, 2);
    suite_add_loop(suite, "garbage", garbage_never_makes_a_fix_that_is_no_number, 16);
    suite_add_loop(suite, "scan far ahead", a_scan_far_ahead_does_not_end_the_fixes, 3);
    suite_add(suite, "scan of long ago", a_scan_of_long_ago_is_refused);
    suite_add(suite, "bad starts", bad_starts_leave_all_as_it_was);
    suite_add_loop(suite, "bad news", bad_fields_and_scans_leave_the_position_as_it_was, 3);
    suite_add(suite, "nothing to track with", trackers_of_nothing_are_refused);
    suite_add(suite, "no radio", without_radio_scans_are_refused);
    suite_add(suite, "NULL", null_is_refused);
    return suite;
}
