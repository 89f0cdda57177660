/* SPDX-License-Identifier: MIT */
#include "fusion_walk.h"
#include "insole/base/snapshot.h"
#include "insole/track/foot_fusion.h"
#include "suite.h"

/* What holds whatever is told. */

static insole_fix_t reference[FUSION_SAMPLES];
static insole_foot_fusion_t before, other;

static uint32_t run_reference(const fusion_case_t *c)
{
    run_case(c);
    memcpy(reference, fixes, sizeof reference);
    return fix_count;
}

static void check_sane(void)
{
    for (uint32_t i = 0; i < fix_count; i++) {
        if (!is_sane_fix(&fixes[i]) || (i > 0 && fixes[i].t_us <= fixes[i - 1u].t_us)) {
            ck_abort_msg("fix %u", i);
        }
    }
}

/* ---- the same bits ---- */

START_TEST(equal_seeds_give_equal_bits_others_do_not)
{
    uint32_t differs = 0;
    walk_round(1u);
    fusion_case_t c = told_everything();
    uint32_t count = run_reference(&c);
    memset(&fusion, 0xa5, sizeof fusion);
    memset(fusion_particles, 0x5a, sizeof fusion_particles);
    run_case(&c);
    ck_assert_uint_eq(fix_count, count);
    expect_same_fixes(fixes, reference, 0u, count);
    c.seed++;
    run_case(&c);
    ck_assert_uint_eq(fix_count, count);
    for (uint32_t i = 0; i < count; i++) {
        differs += is_same_fix(&fixes[i], &reference[i]) ? 0u : 1u;
    }
    ck_assert_uint_gt(differs, count / 2u);
}
END_TEST

/* What comes later changes nothing that has been told; half a second is all that waits. */
START_TEST(fixes_of_a_prefix_are_a_prefix_of_the_fixes)
{
    const double shares[] = {0.02, 0.1, 0.333, 0.5, 0.777};
    walk_round(1u);
    fusion_case_t c = told_everything();
    c.has_start = _i % 2 == 0;
    (void)run_reference(&c);
    uint32_t cut = (uint32_t)(shares[_i] * sample_count);
    set_up(&c);
    run(&c, &fusion, 0u, cut);
    ck_assert_uint_ge(fix_count + 50u, cut);
    expect_same_fixes(fixes, reference, 0u, fix_count);
    finish(&c, &fusion);
    ck_assert_uint_eq(fix_count, cut);
}
END_TEST

/* Work left over when a sample comes makes no difference as long as it is done before the next news
 * and before the row that would show it: here, at once in slices of any size. */
START_TEST(in_slices_or_as_a_whole)
{
    walk_round(1u);
    fusion_case_t c = told_everything();
    uint32_t count = run_reference(&c);
    set_up(&c);
    for (uint32_t i = 0; i < sample_count; i++) {
        tell_radio(&c, &fusion, i > 0u ? samples[i - 1u].t_us : 0u, samples[i].t_us);
        ck_assert_int_eq(insole_foot_fusion_imu(&fusion, &samples[i]), INSOLE_OK);
        take_fixes(&fusion);
        while (insole_foot_fusion_work(&fusion, 1u + i % 37u)) {
        }
    }
    finish(&c, &fusion);
    ck_assert_uint_eq(fix_count, count);
    expect_same_fixes(fixes, reference, 0u, count);
}
END_TEST

/* A row in the middle of the work is made of the cloud before or of the one after, each with the
 * way since: never of one with the way of the other, which is a stride. */
START_TEST(no_row_leaps_while_work_is_left)
{
    const uint32_t slices[] = {40, 70, 150};
    double worst_m = 0.0;
    walk_round(1u);
    fusion_case_t c = told_everything();
    uint32_t count = run_reference(&c);
    c.slice = slices[_i];
    run_case(&c);
    ck_assert_uint_eq(fix_count, count);
    for (uint32_t i = 0; i < count; i++) {
        worst_m = fmax(worst_m, hypot((double)(fixes[i].position_m.x - reference[i].position_m.x),
                                      (double)(fixes[i].position_m.y - reference[i].position_m.y)));
    }
    ck_assert_msg(worst_m < 0.7, "%g m, half a stride is 0.7 m", worst_m);
    ck_assert_msg(worst_m > 0.0, "the slices are not late at all");
}
END_TEST

/* Copied in the middle of a stride's work, its memory with it, both go on alike. */
START_TEST(a_copy_goes_on_bit_for_bit)
{
    static insole_particle_t particles[FUSION_PARTICLES];
    static insole_spot_t past[FUSION_PARTICLES * FUSION_PAST];
    static insole_late_row_t late[FUSION_LATE];
    static uint8_t saved[sizeof fusion + INSOLE_SNAPSHOT_HEADER_BYTES];
    const uint32_t cuts[] = {0u, 100u, 700u, 1234u, 3000u};
    uint32_t cut = cuts[_i / 2];
    size_t used;
    walk_round(1u);
    fusion_case_t c = told_everything();
    c.slice = 40;
    c.config.lag_s = _i % 2 ? INSOLE_R(3.0) : 0;
    uint32_t count = run_reference(&c);
    set_up(&c);
    run(&c, &fusion, 0u, cut);
    ck_assert_int_eq(insole_snapshot_save(9, &fusion, sizeof fusion, saved, sizeof saved, &used),
                     INSOLE_OK);
    memcpy(particles, fusion_particles, sizeof particles);
    memcpy(past, fusion_past, sizeof past);
    memcpy(late, fusion_late, sizeof late);
    insole_foot_late_t still_waiting = waiting;
    static insole_fusion_ranges_t ranges;
    ranges = fusion_ranges;
    memset(&fusion, 0xa5, sizeof fusion);
    memset(fusion_particles, 0xa5, sizeof fusion_particles);
    memset(fusion_past, 0xa5, sizeof fusion_past);
    memset(fusion_late, 0xa5, sizeof fusion_late);
    memset(&waiting, 0xa5, sizeof waiting);
    memset(&fusion_ranges, 0xa5, sizeof fusion_ranges);
    ck_assert_int_eq(insole_snapshot_load(9, &other, sizeof other, saved, used), INSOLE_OK);
    other.memory.particles = particles;
    other.memory.past = past;
    other.memory.ranges = other.radio.ranges = &ranges;
    waiting = still_waiting;
    waiting.rows = late;
    run(&c, &other, cut, sample_count);
    finish(&c, &other);
    ck_assert_uint_eq(fix_count, count);
    expect_same_fixes(fixes, reference, 0u, count);
}
END_TEST

/* ---- little time to work ---- */

static const struct {
    uint32_t particles, slice;
    double lag_s;
    bool scans;
} slow[] = {{100, 1, 0.0, true}, {300, 1, 0.0, true}, {100, 1, 1.0, true},
            {300, 1, 5.0, true}, {300, 7, 0.0, true}, {300, 0, 0.0, true},
            {300, 0, 2.0, true}, {50, 3, 0.0, false}, {50, 3, 2.0, false}};

/* However little work is done, no sample is refused, each has its fix, and all are sane. */
START_TEST(starved_it_never_blocks)
{
    walk_round(1u);
    fusion_case_t c = usual_case();
    c.particles = slow[_i].particles;
    c.slice = slow[_i].slice;
    c.scans = slow[_i].scans;
    c.config.lag_s = (insole_real_t)slow[_i].lag_s;
    set_up(&c);
    run(&c, &fusion, 0u, sample_count);
    ck_assert_uint_ge(fix_count + 60u + (uint32_t)(100.0 * slow[_i].lag_s), sample_count);
    c.slice = WHOLE;
    finish(&c, &fusion);
    ck_assert_uint_eq(fix_count, sample_count);
    check_sane();
}
END_TEST

/* With work for a stride done within the stride it is nearly as good as at once. */
START_TEST(work_may_be_spread_over_the_stride)
{
    walk_round(1u);
    fusion_case_t c = usual_case();
    c.slice = 300; /* 30000 a second */
    run_case(&c);
    ASSERT_AT_MOST(mean_error(0.0, HUGE_VAL), 0.4, "m");
    ck_assert_uint_ge(fusion.particles.counts.strides, 36);
}
END_TEST

/* Strides that end while the particles are busy are told as one: their turns add up to the same. */
START_TEST(no_turn_is_lost_while_busy)
{
    double turned[2] = {0.0, 0.0};
    uint32_t strides[2];
    walk_round(1u);
    for (int busy = 0; busy < 2; busy++) {
        fusion_case_t c = usual_case();
        c.scans = false;
        c.slice = busy ? 2 : WHOLE;
        set_up(&c);
        uint32_t told = 0;
        for (uint32_t i = 0; i < sample_count; i++) {
            run(&c, &fusion, i, i + 1u);
            if (fusion.particles.counts.strides > told) {
                told = fusion.particles.counts.strides;
                turned[busy] += (double)fusion.news.turn_rad;
            }
        }
        turned[busy] += (double)fusion.strides.turn_rad;
        strides[busy] = told;
    }
    ck_assert_uint_lt(2u * strides[1], strides[0]);
    ASSERT_AT_LEAST(turned[0], 3.5, "rad");
    ASSERT_NEAR(turned[1], turned[0], 1e-4, "rad");
}
END_TEST

START_TEST(finish_gives_one_fix_per_sample_and_only_once)
{
    insole_fix_t fix;
    walk_round(1u);
    fusion_case_t c = told_everything();
    c.config.lag_s = _i == 0 ? 0 : 4;
    run_case(&c);
    ck_assert_uint_eq(fix_count, sample_count);
    check_sane();
    before = fusion;
    ck_assert_int_eq(insole_foot_fusion_finish(&fusion), INSOLE_OK);
    ck_assert_int_eq(insole_foot_lag_next(&waiting, &fusion, &fix), INSOLE_ERR_STATE);
    ck_assert(!insole_foot_fusion_work(&fusion, WHOLE));
    ck_assert_mem_eq(&fusion, &before, sizeof fusion);
    ck_assert_int_eq(insole_foot_fusion_imu(&fusion, &samples[0]), INSOLE_ERR_STATE);
}
END_TEST

START_TEST(nothing_in_nothing_out)
{
    insole_fix_t fix;
    walk_round(1u);
    fusion_case_t c = told_everything();
    c.config.method = _i % 3;
    c.config.lag_s = _i < 3 ? 0 : 2;
    set_up(&c);
    ck_assert_int_eq(insole_foot_lag_next(&waiting, &fusion, &fix), INSOLE_ERR_STATE);
    ck_assert(!insole_foot_fusion_work(&fusion, WHOLE));
    ck_assert_int_eq(insole_foot_fusion_finish(&fusion), INSOLE_OK);
    ck_assert_int_eq(insole_foot_lag_next(&waiting, &fusion, &fix), INSOLE_ERR_STATE);
}
END_TEST

/* Before the sensor has been still nobody knows anything, and scans do not change that. */
START_TEST(before_the_foot_is_aligned)
{
    walk_round(1u);
    fusion_case_t c = usual_case();
    run_case(&c);
    uint32_t aligning = 0;
    while (fixes[aligning].state == INSOLE_FIX_ALIGN) {
        aligning++;
    }
    ck_assert_uint_ge(aligning, 1);
    for (uint32_t i = aligning; i < fix_count; i++) {
        ck_assert_int_ne(fixes[i].state, INSOLE_FIX_ALIGN);
    }
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("foot_fusion_promises");
    suite_add(suite, "seeds", equal_seeds_give_equal_bits_others_do_not);
    suite_add_loop(suite, "prefix", fixes_of_a_prefix_are_a_prefix_of_the_fixes, 5);
    suite_add(suite, "slices", in_slices_or_as_a_whole);
    suite_add_loop(suite, "no leaps", no_row_leaps_while_work_is_left, 3);
    suite_add_loop(suite, "copy", a_copy_goes_on_bit_for_bit, 10);
    suite_add_loop(suite, "starved", starved_it_never_blocks, sizeof slow / sizeof slow[0]);
    suite_add(suite, "spread work", work_may_be_spread_over_the_stride);
    suite_add(suite, "turns", no_turn_is_lost_while_busy);
    suite_add_loop(suite, "finish", finish_gives_one_fix_per_sample_and_only_once, 2);
    suite_add_loop(suite, "nothing", nothing_in_nothing_out, 6);
    suite_add(suite, "align", before_the_foot_is_aligned);
    return suite;
}
