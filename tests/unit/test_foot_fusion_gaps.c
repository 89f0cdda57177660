/* SPDX-License-Identifier: MIT */
#include "fusion_walk.h"
#include "insole/track/foot_fusion.h"
#include "suite.h"

/* Readings that are missing, and work that is not done: what is not known is not claimed. */

static const double gaps_s[] = {0.5, 2.0, 5.0, 10.0, 20.0};

enum { GAPS = sizeof gaps_s / sizeof gaps_s[0], BEGIN = 1500 /* sample */ };

/* Takes the readings of so long away; those after move up. */
static uint32_t cut_out(uint32_t from, double gap_s)
{
    uint32_t count = (uint32_t)(100.0 * gap_s);
    ck_assert_uint_lt(from + count, sample_count);
    memmove(&samples[from], &samples[from + count],
            (sample_count - from - count) * sizeof samples[0]);
    sample_count -= count;
    return from;
}

static uint32_t count_lies_after(double from_s, double limit_m)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < fix_count; i++) {
        double var_m2 = (double)(fixes[i].var_x_m2 + fixes[i].var_y_m2);
        count += fixes[i].state == INSOLE_FIX_TRACK && 1e-6 * (double)fixes[i].t_us >= from_s &&
                         error_of(&fixes[i]) > fmax(limit_m, 3.0 * sqrt(0.5 * var_m2))
                     ? 1u
                     : 0u;
    }
    return count;
}

static uint32_t count_lies(double limit_m)
{
    return count_lies_after(0.0, limit_m);
}

/* Who walks on during a gap is not where the cloud was; and is found again. */
START_TEST(a_gap_is_not_covered_up)
{
    for (uint64_t seed = 1; seed <= 3; seed++) {
        walk_round(seed);
        double end_s = 1e-6 * (double)samples[sample_count - 1u].t_us;
        uint32_t first = cut_out(BEGIN, gaps_s[_i]);
        fusion_case_t c = usual_case();
        run_case(&c);
        ck_assert_uint_eq(fix_count, sample_count);
        ck_assert_int_ne(fixes[first].state, INSOLE_FIX_TRACK); /* the first after it */
        ck_assert_uint_eq(fusion.counts.starts, 2);
        ck_assert_uint_eq(count_lies(2.0), 0);
        if (gaps_s[_i] <= 2.0) { /* a longer one leaves the round corridor to be searched */
            ASSERT_AT_MOST(mean_error(end_s - 5.0, HUGE_VAL), 1.5, "m");
        }
        for (uint32_t i = 0; i < fix_count; i++) {
            ck_assert(is_sane_fix(&fixes[i]));
        }
    }
}
END_TEST

/* Without radio walls and strides are all there is. */
START_TEST(without_radio_it_does_not_claim_to_know)
{
    walk_round(1u);
    (void)cut_out(BEGIN, gaps_s[_i]);
    fusion_case_t c = usual_case();
    c.scans = false;
    run_case(&c);
    ck_assert_uint_eq(fusion.counts.starts, 2);
    ck_assert_uint_eq(count_lies(3.0), 0);
}
END_TEST

/* A start told within the gap, or just after it, is what counts. */
START_TEST(a_start_in_a_gap_is_believed)
{
    walk_round(1u);
    (void)cut_out(BEGIN, 10.0);
    fusion_case_t c = usual_case();
    insole_start_t here = start_at(_i == 0 ? 24.999 : 26.5, 0.0, 0.0, 0.3);
    set_up(&c);
    run(&c, &fusion, 0u, BEGIN - 1u);
    ck_assert_int_eq(insole_foot_fusion_start(&fusion, &here), INSOLE_OK);
    run(&c, &fusion, BEGIN - 1u, sample_count);
    finish(&c, &fusion);
    ck_assert(!fusion.gap.is_open);
    ck_assert_uint_eq(count_lies_after(28.0, 2.0), 0); /* its direction has been walked */
    ASSERT_AT_MOST(mean_error(30.0, HUGE_VAL), 1.2, "m");
}
END_TEST

/* Late fixes lie on either side of the gap; none is drawn out of one cloud into the other. */
START_TEST(late_fixes_cross_a_gap)
{
    walk_round(1u);
    (void)cut_out(BEGIN, 10.0);
    fusion_case_t c = usual_case();
    c.config.lag_s = 4;
    run_case(&c);
    ck_assert_uint_eq(fix_count, sample_count);
    ck_assert_uint_eq(count_lies(2.0), 0);
}
END_TEST

static const uint32_t slices[] = {0, 1, 7};

/* A cloud that hangs behind by more than some strides says so. */
START_TEST(starved_it_says_so)
{
    walk_round(1u);
    fusion_case_t c = usual_case();
    c.slice = slices[_i];
    set_up(&c);
    for (uint32_t i = 0; i < sample_count; i++) {
        uint32_t count = fix_count;
        run(&c, &fusion, i, i + 1u);
        bool lags = insole_fusion_strides_behind(&fusion.strides) > 3u;
        for (; lags && count < fix_count; count++) {
            ck_assert_int_ne(fixes[count].state, INSOLE_FIX_TRACK);
        }
    }
    ck_assert_uint_eq(count_lies(2.0), 0);
    c.slice = WHOLE; /* caught up */
    for (int i = 0; i < 3; i++) {
        (void)insole_foot_fusion_work(&fusion, WHOLE);
    }
    ck_assert(!fusion.working);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("foot_fusion_gaps");
    suite_add_loop(suite, "gaps", a_gap_is_not_covered_up, GAPS);
    suite_add_loop(suite, "no radio", without_radio_it_does_not_claim_to_know, GAPS);
    suite_add_loop(suite, "told", a_start_in_a_gap_is_believed, 2);
    suite_add(suite, "late", late_fixes_cross_a_gap);
    suite_add_loop(suite, "starved", starved_it_says_so, sizeof slices / sizeof slices[0]);
    return suite;
}
