/* SPDX-License-Identifier: MIT */
#include "insole/track/foot_late.h"

#include <complex.h>
#include <string.h>

#include "insole/base/rng.h"
#include "near.h"
#include "refusal.h"
#include "suite.h"

/* A cloud of two, whose past is put where the tests want it. */

#define J ((double complex)I)

enum { ROWS = 5, PAST = 70, START = 1 };

static insole_foot_late_t late;
static insole_late_row_t rows[ROWS], room_for_one[1];
static insole_particle_t particles[2];
static insole_spot_t past[2 * PAST];
static insole_cloud_t cloud;
static insole_particle_filter_t filter;
static insole_rng_t rng;

static insole_spot_t spot(double complex at)
{
    insole_spot_t s = {(insole_real_t)creal(at), (insole_real_t)cimag(at)};
    return s;
}

static void begin(void)
{
    static const insole_particle_filter_t blank;
    insole_cloud_t c = {particles, 2, past, PAST, NULL};
    cloud = c;
    filter = blank;
    filter.has_fix = true;
    filter.fix.offset_rad = INSOLE_R(0.4);
    filter.fix.scale = 1;
    memset(particles, 0, sizeof particles);
    memset(past, 0, sizeof past);
    insole_rng_seed(&rng, 9u);
    ck_assert_int_eq(insole_foot_late_init(&late, rows, ROWS), INSOLE_OK);
}

/* A stride ends at `n` where by now the ancestors are thought to have been about `m`. */
static void stride(uint32_t number, double complex n, double complex m)
{
    double complex aside = 0.3 - 0.2 * J;
    for (uint32_t i = 0; i < 2; i++) {
        insole_spot_t s = spot(i == 0 ? m - aside : m + aside);
        particles[i].x_m = s.x_m;
        particles[i].y_m = s.y_m;
        insole_cloud_remember(&cloud, i, i + 1u, number);
    }
    filter.since_start = number;
    filter.counts.strides++;
    ck_assert_int_eq(insole_foot_late_stride(&late, number, spot(n)), INSOLE_OK);
}

static insole_late_row_t row_at(double complex n, uint32_t number)
{
    insole_late_row_t row = {{1000u * number, {101, 102, 103}, 4, 5, 6, 7, 8, 9, INSOLE_FIX_COAST},
                             spot(n),
                             number,
                             START};
    return row;
}

static void push(double complex n, uint32_t number)
{
    insole_late_row_t row = row_at(n, number);
    ck_assert_int_eq(insole_foot_late_push(&late, &row), INSOLE_OK);
}

static insole_fix_t take(void)
{
    insole_fix_t fix;
    ck_assert_int_eq(insole_foot_late_take(&late, &filter, &cloud, START, &fix), INSOLE_OK);
    return fix;
}

static void check_at(double complex m, double tolerance)
{
    insole_fix_t fix = take();
    ASSERT_NEAR(fix.position_m.x, creal(m), tolerance, "m");
    ASSERT_NEAR(fix.position_m.y, cimag(m), tolerance, "m");
}

static void check_stays(void)
{
    insole_fix_t expected = late.rows[late.first].fix, fix = take();
    ck_assert_mem_eq(&fix, &expected, sizeof fix);
}

static double complex somewhere(double size)
{
    double x = size * (double)insole_rng_normal(&rng);
    return x + size * J * (double)insole_rng_normal(&rng);
}

static double complex turned(double complex way, double angle)
{
    return way * cexp(J * angle);
}

/* ---- where they come to lie ---- */

/* A way in n between two ends, divided and multiplied as complex numbers. */
START_TEST(a_fix_lies_on_the_way_between_two_ends)
{
    begin();
    for (uint32_t k = 0; k < 200; k++) {
        double complex n0 = somewhere(20.0), n1 = n0 + 0.4 + fabs(creal(somewhere(1.0)));
        double complex m0 = somewhere(100.0);
        double stretch = 0.6 + 1.3 * (double)insole_rng_uniform(&rng);
        double complex m1 = m0 + turned((n1 - n0) * stretch, creal(somewhere(3.0)));
        double complex r = n0 + somewhere(1.0);
        stride(2u * k, n0, m0);
        stride(2u * k + 1u, n1, m1);
        push(r, 2u * k);
        check_at(m0 + (m1 - m0) / (n1 - n0) * (r - n0), 1e-4);
    }
}
END_TEST

START_TEST(both_ends_are_where_the_ancestors_were)
{
    begin();
    stride(0, 1.0 + 2.0 * J, 30.0 + 20.0 * J);
    stride(1, 1.0 + 3.3 * J, 31.2 + 20.3 * J);
    push(1.0 + 2.0 * J, 0);
    push(1.0 + 3.3 * J, 0);
    check_at(30.0 + 20.0 * J, 1e-5);
    check_at(31.2 + 20.3 * J, 1e-5);
}
END_TEST

/* Place alone: heading, height, variances, time and state are those of then. */
START_TEST(only_the_place_is_told_anew)
{
    begin();
    stride(0, 0.0, 30.0);
    stride(1, 1.3, 31.3);
    push(0.5, 0);
    insole_fix_t before = rows[0].fix, fix = take();
    ck_assert(fix.position_m.x < 31 && fix.position_m.x > 30);
    before.position_m.x = fix.position_m.x;
    before.position_m.y = fix.position_m.y;
    ck_assert_mem_eq(&fix, &before, sizeof fix);
}
END_TEST

/* Before the stride has ended, and for one that makes no sense, the cloud's own turn is taken. */
static const struct {
    const char *what;
    double n, m; /* lengths of the way; 0: not ended */
} odd_strides[] = {{"not ended", 0.0, 0.0},
                   {"short", 0.19, 0.19},
                   {"shrunk", 1.0, 0.49},
                   {"stretched", 1.0, 2.01},
                   {"nowhere", 1.0, 0.0}};

START_TEST(otherwise_the_cloud_tells_the_turn)
{
    double complex n0 = 3.0 + 1.0 * J, m0 = 40.0 + 10.0 * J, r = n0 + 0.3 - 0.2 * J;
    begin();
    stride(5, n0, m0);
    if (odd_strides[_i].n > 0.0) {
        stride(6, n0 + odd_strides[_i].n * J, m0 + odd_strides[_i].m);
    }
    push(r, 5);
    check_at(m0 + turned(r - n0, 0.4), 1e-5);
}
END_TEST

/* The heavier ancestor says more, the dead say nothing. */
START_TEST(ancestors_weigh_what_they_weigh)
{
    begin();
    stride(0, 0.0, 30.0);
    particles[1].log_weight = INSOLE_PARTICLE_DEAD;
    push(0.0, 0);
    check_at(30.0 - 0.3 + 0.2 * J, 1e-5);
}
END_TEST

/* ---- when nobody knows ---- */

START_TEST(without_a_past_it_stays)
{
    begin();
    stride(0, 0.0, 30.0);
    stride(1, 1.3, 31.3);
    cloud.past_strides = 0;
    push(0.5, 0);
    check_stays();
    cloud.past_strides = PAST;
    particles[0].log_weight = particles[1].log_weight = INSOLE_PARTICLE_DEAD;
    push(0.5, 1);
    check_stays();
}
END_TEST

/* Drawn anew in between, or not drawn at all then. */
START_TEST(of_another_start_it_stays)
{
    insole_fix_t fix;
    begin();
    stride(0, 0.0, 30.0);
    stride(1, 1.3, 31.3);
    insole_late_row_t row = row_at(0.5, 0);
    const uint32_t starts[3][2] = {{1, 2}, {0, 1}, {0, 0}}; /* then and now */
    for (int i = 0; i < 3; i++) {
        row.start = starts[i][0];
        ck_assert_int_eq(insole_foot_late_push(&late, &row), INSOLE_OK);
        ck_assert_int_eq(insole_foot_late_take(&late, &filter, &cloud, starts[i][1], &fix),
                         INSOLE_OK);
        ck_assert_mem_eq(&fix, &row.fix, sizeof fix);
    }
    row.start = 2; /* stride 0 of another start is not the one just looked up */
    push(0.5, 0);
    check_at(30.5, 1e-5);
    stride(0, 0.0, 50.0);
    filter.counts.strides--;
    ck_assert_int_eq(insole_foot_late_push(&late, &row), INSOLE_OK);
    ck_assert_int_eq(insole_foot_late_take(&late, &filter, &cloud, 2, &fix), INSOLE_OK);
    ASSERT_NEAR(fix.position_m.x, 50.0 + 0.5 * cos(0.4), 1e-5, "m");
}
END_TEST

/* Ends are kept of so many strides; older ones have been overwritten. */
START_TEST(of_too_old_a_stride_it_stays)
{
    begin();
    for (uint32_t k = 0; k <= INSOLE_LATE_STRIDES + 3u; k++) {
        stride(k, 1.3 * k, 30.0 + 1.3 * k);
    }
    push(1.3 * 3.0, 3);
    check_stays();
    push(1.3 * 4.5, 4);
    check_at(30.0 + 1.3 * 4.5, 1e-4);
    push(1.3 * 68.0, 68); /* and none that has not ended */
    check_stays();
}
END_TEST

/* ---- when more is known ---- */

START_TEST(the_end_of_the_stride_is_looked_up_when_it_comes)
{
    begin();
    stride(0, 0.0, 30.0);
    push(0.6, 0);
    push(0.6, 0);
    check_at(30.0 + turned(0.6, 0.4), 1e-5);
    stride(1, 1.2, 30.0 + 1.2 * J);
    check_at(30.0 + 0.6 * J, 1e-5);
}
END_TEST

/* While the particles are busy what was known stays in use, the end of one stride is the begin of
 * the next, and all is looked up when they are done: in small slices as at once. */
START_TEST(busy_particles_do_not_throw_it_back)
{
    begin();
    stride(0, 0.0, 30.0);
    stride(1, 1.2, 30.0 + 1.2 * J);
    push(0.6, 0);
    check_at(30.0 + 0.6 * J, 1e-5);
    filter.phase = INSOLE_PARTICLES_MOVE;
    push(0.9, 0);
    push(1.4, 1);
    push(1.4, 1);
    check_at(30.0 + 0.9 * J, 1e-5);
    check_at(30.0 + 1.2 * J + turned(0.2, 0.4), 1e-5);
    filter.phase = INSOLE_PARTICLES_IDLE;
    stride(1, 1.2, 31.0 + 1.2 * J); /* by now it is thought to have been elsewhere */
    filter.counts.strides--;
    check_at(31.0 + 1.2 * J + turned(0.2, 0.4), 1e-5);
    filter.phase = INSOLE_PARTICLES_MOVE;
    push(2.0, 3); /* a stride further: nobody knows its begin */
    check_stays();
}
END_TEST

/* A stride is not known while it is worked in; afterwards it is. */
START_TEST(what_was_asked_too_early_is_asked_again)
{
    begin();
    stride(0, 0.0, 30.0);
    push(0.6, 0);
    check_at(30.0 + turned(0.6, 0.4), 1e-5);
    filter.counts.strides++; /* the next one begins to be worked in */
    filter.since_start = 1;
    filter.phase = INSOLE_PARTICLES_WEIGH;
    push(0.6, 0);
    check_at(30.0 + turned(0.6, 0.4), 1e-5);
    filter.phase = INSOLE_PARTICLES_IDLE;
    filter.counts.strides--;
    stride(1, 1.2, 30.0 + 1.2 * J);
    push(0.6, 0);
    check_at(30.0 + 0.6 * J, 1e-5);
}
END_TEST

/* ---- the queue ---- */

/* First in, first out, around the ring, as often as you like. */
START_TEST(they_leave_in_order)
{
    insole_fix_t fix;
    uint64_t in = 0, out = 0;
    begin();
    cloud.past_strides = 0;
    for (int k = 0; k < 1000; k++) {
        insole_late_row_t row = row_at(0.0, 0);
        row.fix.t_us = in;
        bool full = late.count == ROWS;
        ck_assert_int_eq(insole_foot_late_push(&late, &row), full ? INSOLE_ERR_ROOM : INSOLE_OK);
        in += full ? 0 : 1;
        for (uint32_t i = insole_rng_bits(&rng) % 3u; i > 0 && late.count > 0; i--) {
            fix = take();
            ck_assert(fix.t_us == out++);
        }
        ck_assert(in - out == late.count);
    }
    ck_assert_uint_gt(out, 500);
    while (late.count > 0) {
        fix = take();
        ck_assert(fix.t_us == out++);
    }
    ck_assert(in == out);
    ASSERT_UNCHANGED(late, insole_foot_late_take(&late, &filter, &cloud, START, &fix),
                     INSOLE_ERR_STATE);
}
END_TEST

START_TEST(they_are_due_after_the_lag_or_when_there_is_no_room)
{
    begin();
    ck_assert(!insole_foot_late_is_due(&late, 0));
    ck_assert(!insole_foot_late_is_due(NULL, 0));
    push(0.0, 2);
    ck_assert(insole_foot_late_is_due(&late, 0));
    ck_assert(!insole_foot_late_is_due(&late, 1));
    push(0.0, 5); /* 3 ms later */
    ck_assert(insole_foot_late_is_due(&late, 3000));
    ck_assert(!insole_foot_late_is_due(&late, 3001));
    push(0.0, 5);
    push(0.0, 5);
    ck_assert(!insole_foot_late_is_due(&late, 3001));
    push(0.0, 5);
    ck_assert(insole_foot_late_is_due(&late, UINT64_MAX)); /* full */
    (void)take();
    ck_assert(!insole_foot_late_is_due(&late, 1));
}
END_TEST

START_TEST(there_may_be_no_room_at_all)
{
    insole_late_row_t row = row_at(0.0, 0);
    begin();
    cloud.past_strides = 0;
    ck_assert_int_eq(insole_foot_late_init(&late, NULL, 0), INSOLE_OK);
    ASSERT_UNCHANGED(late, insole_foot_late_push(&late, &row), INSOLE_ERR_ROOM);
    ck_assert(!insole_foot_late_is_due(&late, 0));
    ck_assert_int_eq(insole_foot_late_init(&late, room_for_one, 1), INSOLE_OK);
    ck_assert_int_eq(insole_foot_late_push(&late, &row), INSOLE_OK);
    ck_assert(insole_foot_late_is_due(&late, UINT64_MAX));
    ASSERT_UNCHANGED(late, insole_foot_late_push(&late, &row), INSOLE_ERR_ROOM);
    check_stays();
    ck_assert_int_eq(insole_foot_late_push(&late, &row), INSOLE_OK);
}
END_TEST

START_TEST(a_copy_with_its_rows_goes_on_alike)
{
    static insole_late_row_t copied_rows[ROWS];
    begin();
    stride(0, 0.0, 30.0);
    stride(1, 1.2, 30.0 + 1.2 * J);
    push(0.3, 0);
    push(0.6, 0);
    push(0.9, 0);
    (void)take();
    insole_foot_late_t copy = late;
    memcpy(copied_rows, rows, sizeof rows);
    insole_fix_t first = take(), second = take();
    memset(rows, 0xa5, sizeof rows);
    late = copy;
    late.rows = copied_rows;
    insole_fix_t again = take();
    ck_assert_mem_eq(&again, &first, sizeof first);
    again = take();
    ck_assert_mem_eq(&again, &second, sizeof second);
}
END_TEST

START_TEST(bad_input_changes_nothing)
{
    insole_late_row_t row = row_at(0.0, 0);
    insole_fix_t fix;
    begin();
    push(0.0, 0);
    ASSERT_UNCHANGED(late, insole_foot_late_init(&late, NULL, 3), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_foot_late_init(NULL, rows, ROWS), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_foot_late_stride(NULL, 0, spot(0.0)), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(late, insole_foot_late_stride(&late, 0, spot((double)NAN)), INSOLE_ERR_VALUE);
    ASSERT_UNCHANGED(late, insole_foot_late_stride(&late, 0, spot(HUGE_VAL)), INSOLE_ERR_VALUE);
    ck_assert_int_eq(insole_foot_late_push(NULL, &row), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(late, insole_foot_late_push(&late, NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_foot_late_take(NULL, &filter, &cloud, 1, &fix), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(late, insole_foot_late_take(&late, NULL, &cloud, 1, &fix), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(late, insole_foot_late_take(&late, &filter, NULL, 1, &fix), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(late, insole_foot_late_take(&late, &filter, &cloud, 1, NULL), INSOLE_ERR_NULL);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("foot_late");
    suite_add(suite, "between", a_fix_lies_on_the_way_between_two_ends);
    suite_add(suite, "ends", both_ends_are_where_the_ancestors_were);
    suite_add(suite, "place alone", only_the_place_is_told_anew);
    suite_add_loop(suite, "odd strides", otherwise_the_cloud_tells_the_turn,
                   sizeof odd_strides / sizeof odd_strides[0]);
    suite_add(suite, "weights", ancestors_weigh_what_they_weigh);
    suite_add(suite, "no past", without_a_past_it_stays);
    suite_add(suite, "another start", of_another_start_it_stays);
    suite_add(suite, "too old", of_too_old_a_stride_it_stays);
    suite_add(suite, "news", the_end_of_the_stride_is_looked_up_when_it_comes);
    suite_add(suite, "busy", busy_particles_do_not_throw_it_back);
    suite_add(suite, "too early", what_was_asked_too_early_is_asked_again);
    suite_add(suite, "order", they_leave_in_order);
    suite_add(suite, "due", they_are_due_after_the_lag_or_when_there_is_no_room);
    suite_add(suite, "no room", there_may_be_no_room_at_all);
    suite_add(suite, "copy", a_copy_with_its_rows_goes_on_alike);
    suite_add(suite, "bad input", bad_input_changes_nothing);
    return suite;
}
