/* SPDX-License-Identifier: MIT */
#include "insole/track/phone_radio.h"

#include "fingerprints.h"
#include "insole/place/kde_fix.h"
#include "refusal.h"
#include "suite.h"

/* A solver that does as it is told, and remembers what it was asked. */
typedef struct {
    insole_status_t begins, finishes; /* what it answers */
    uint32_t points;                  /* of the map */
    uint32_t left;
    uint32_t begun, worked, finished; /* calls */
    uint32_t asked;                   /* points, by the last call of work */
    const insole_radio_map_t *map;
    const insole_trusted_area_t *area;
    uint32_t count; /* readings of the last scan */
} fake_t;

static insole_status_t fake_begin(void *state, const insole_radio_map_t *map,
                                  const insole_trusted_area_t *area, const insole_rss_t *readings,
                                  uint32_t count)
{
    fake_t *fake = state;
    fake->begun++;
    fake->map = map;
    fake->area = area;
    fake->count = readings || count == 0u ? count : UINT32_MAX;
    fake->left = fake->points;
    return fake->begins;
}

static bool fake_work(void *state, const insole_radio_map_t *map, uint32_t points)
{
    fake_t *fake = state;
    fake->worked += map == fake->map ? 1u : 1000u;
    fake->asked = points;
    fake->left -= points < fake->left ? points : fake->left;
    return fake->left > 0u;
}

static insole_status_t fake_finish(void *state, const insole_radio_map_t *map,
                                   insole_radio_fix_t *fix)
{
    fake_t *fake = state;
    fake->finished += map == fake->map ? 1u : 1000u;
    memset(fix, 0x55, sizeof *fix);
    if (fake->finishes == INSOLE_OK) {
        fix->spot = insole_spot((insole_real_t)fake->begun, INSOLE_R(-2.0));
        fix->var_x_m2 = INSOLE_R(9.0);
        fix->cov_xy_m2 = INSOLE_R(1.0);
        fix->var_y_m2 = INSOLE_R(4.0);
    }
    return fake->finishes;
}

static const insole_radio_solver_calls_t fake_calls = {fake_begin, fake_work, fake_finish};

static fake_t fake;
static const insole_radio_map_t map;
static insole_phone_radio_t radio;
static insole_rss_t readings[4];

static const insole_radio_solver_t solver = {&fake_calls, &fake};
static const insole_radio_solver_t no_solver = {NULL, NULL};

static void set_up(double late_s, uint32_t points)
{
    const fake_t blank = {.points = points};
    fake = blank;
    ck_assert_int_eq(insole_phone_radio_init(&radio, &solver, &map, (insole_real_t)late_s),
                     INSOLE_OK);
}

static insole_scan_t scan_at(uint64_t t_us, uint32_t count)
{
    insole_scan_t scan = {t_us, readings, count};
    return scan;
}

static void hear(uint64_t t_us, uint32_t count)
{
    insole_scan_t scan = scan_at(t_us, count);
    ck_assert_int_eq(insole_phone_radio_hear(&radio, &scan, NULL), INSOLE_OK);
}

static void work_all(uint32_t points)
{
    for (uint32_t left = 1000u; insole_phone_radio_work(&radio, points); left--) {
        ck_assert_uint_gt(left, 0u);
    }
}

/* ---- when it was heard ------------------------------------------------------------------ */

/* min(t, t - age + late), never before time began */
START_TEST(heard_time_is_that_of_the_youngest_reading)
{
    const struct {
        double late_s;
        uint64_t t_us;
        uint32_t count, age_us[3];
        uint64_t heard_us;
    } rows[] = {{0.0, 50000000u, 1u, {2000000u}, 48000000u},
                {1.0, 50000000u, 1u, {2000000u}, 49000000u},
                {3.0, 50000000u, 1u, {2000000u}, 50000000u},
                {1.0, 50000000u, 3u, {9000000u, 1500000u, 4000000u}, 49500000u},
                {1.0, 50000000u, 3u, {9000000u, 8000000u, 7000000u}, 44000000u},
                {1.0, 50000000u, 3u, {9000000u, 0u, 7000000u}, 50000000u},
                {1.0, 50000000u, 0u, {0u}, 50000000u},
                {0.0, 3000000u, 1u, {4000000u}, 0u},
                {1.0, 3000000u, 2u, {4000000u, 5000000u}, 0u},
                {10.0, 50000000u, 1u, {UINT32_MAX}, 0u},
                {10.0, 0u, 1u, {0u}, 0u},
                {1.0, UINT64_MAX, 1u, {2000000u}, UINT64_MAX - 1000000u}};
    set_up(rows[_i].late_s, 1u);
    for (uint32_t i = 0u; i < rows[_i].count; i++) {
        readings[i].age_us = rows[_i].age_us[i];
    }
    hear(rows[_i].t_us, rows[_i].count);
    work_all(1u);
    ck_assert(insole_phone_radio_take(&radio));
    ck_assert_msg(radio.t_us == rows[_i].t_us, "came");
    ck_assert_msg(radio.heard_us == rows[_i].heard_us, "heard at %llu us, expected %llu us",
                  (unsigned long long)radio.heard_us, (unsigned long long)rows[_i].heard_us);
    ck_assert_uint_eq(fake.count, rows[_i].count);
}
END_TEST

/* The times of the fix are those of its scan until the next fix is ready. */
START_TEST(times_belong_to_the_fix)
{
    set_up(0.0, 8u);
    readings[0].age_us = 500000u;
    hear(1000000u, 1u);
    work_all(8u);
    hear(2000000u, 1u);
    ck_assert(insole_phone_radio_work(&radio, 4u));
    ck_assert(radio.t_us == 1000000u && radio.heard_us == 500000u);
    work_all(4u);
    ck_assert(radio.t_us == 2000000u && radio.heard_us == 1500000u);
    ASSERT_NEAR(radio.fix.spot.x_m, 2.0, 0.0, "m");
}
END_TEST

/* ---- work ------------------------------------------------------------------------------- */

START_TEST(work_is_done_in_slices)
{
    const uint32_t slices[] = {1u, 3u, 10u, 99u, 100u, 101u, UINT32_MAX};
    const uint32_t calls[] = {100u, 34u, 10u, 2u, 1u, 1u, 1u};
    uint32_t count = 1u;
    set_up(1.0, 100u);
    hear(5000000u, 1u);
    ck_assert(!insole_phone_radio_take(&radio));
    for (; insole_phone_radio_work(&radio, slices[_i]); count++) {
        ck_assert(!radio.has_fix && !insole_phone_radio_take(&radio));
        ck_assert_uint_eq(fake.finished, 0u);
    }
    ck_assert_uint_eq(count, calls[_i]);
    ck_assert_uint_eq(fake.worked, calls[_i]);
    ck_assert_uint_eq(fake.asked, slices[_i]);
    ck_assert_uint_eq(fake.finished, 1u);
    ck_assert(!insole_phone_radio_work(&radio, slices[_i]));
    ck_assert_uint_eq(fake.worked, calls[_i]);
}
END_TEST

START_TEST(a_fix_is_taken_once)
{
    set_up(1.0, 4u);
    hear(5000000u, 1u);
    work_all(2u);
    ck_assert(insole_phone_radio_take(&radio));
    ck_assert(!insole_phone_radio_take(&radio));
    ck_assert(radio.has_fix);
    ASSERT_NEAR(radio.fix.spot.x_m, 1.0, 0.0, "m");
    ASSERT_NEAR(radio.fix.var_x_m2, 9.0, 0.0, "m^2");
    ASSERT_NEAR(radio.fix.cov_xy_m2, 1.0, 0.0, "m^2");
    ASSERT_NEAR(radio.fix.var_y_m2, 4.0, 0.0, "m^2");
    ck_assert_uint_eq(radio.scans, 1u);
    ck_assert_uint_eq(radio.fixes, 1u);
    ck_assert_uint_eq(radio.given_up + radio.unplaced, 0u);
}
END_TEST

START_TEST(a_scan_in_work_is_given_up_for_the_next)
{
    set_up(1.0, 4u);
    hear(5000000u, 1u);
    ck_assert(insole_phone_radio_work(&radio, 3u));
    hear(6000000u, 2u);
    ck_assert_uint_eq(radio.given_up, 1u);
    ck_assert_uint_eq(fake.finished, 0u);
    work_all(3u);
    ck_assert(insole_phone_radio_take(&radio));
    ck_assert(radio.t_us == 6000000u);
    hear(7000000u, 1u); /* nothing is in work now */
    ck_assert_uint_eq(radio.given_up, 1u);
    ck_assert_uint_eq(radio.scans, 3u);
    ck_assert_uint_eq(radio.fixes, 1u);
}
END_TEST

START_TEST(the_area_is_handed_on)
{
    const insole_trusted_area_t area = {{INSOLE_R(1.0), INSOLE_R(2.0)}, INSOLE_R(5.0)};
    insole_scan_t scan = scan_at(5000000u, 3u);
    set_up(1.0, 4u);
    ck_assert_int_eq(insole_phone_radio_hear(&radio, &scan, &area), INSOLE_OK);
    ck_assert_ptr_eq(fake.area, &area);
    ck_assert_ptr_eq(fake.map, &map);
    ck_assert_uint_eq(fake.count, 3u);
}
END_TEST

/* ---- what goes wrong -------------------------------------------------------------------- */

START_TEST(what_the_solver_refuses_is_counted)
{
    insole_scan_t scan = scan_at(9000000u, 1u);
    set_up(1.0, 4u);
    hear(5000000u, 1u);
    work_all(4u);
    ck_assert(insole_phone_radio_take(&radio));
    insole_phone_radio_t before = radio;
    fake.begins = INSOLE_ERR_STATE;
    ck_assert_int_eq(insole_phone_radio_hear(&radio, &scan, NULL), INSOLE_ERR_STATE);
    fake.begins = INSOLE_ERR_VALUE;
    ck_assert_int_eq(insole_phone_radio_hear(&radio, &scan, NULL), INSOLE_ERR_VALUE);
    before.scans += 2u;
    before.unplaced += 2u;
    ck_assert_mem_eq(&radio, &before, sizeof radio);
    ck_assert(!insole_phone_radio_work(&radio, 4u));
}
END_TEST

/* One that is refused while another is in work takes that one with it: its solver has begun anew.
 */
START_TEST(a_refused_scan_ends_the_one_in_work)
{
    insole_scan_t scan = scan_at(9000000u, 1u);
    set_up(1.0, 4u);
    hear(5000000u, 1u);
    ck_assert(insole_phone_radio_work(&radio, 1u));
    fake.begins = INSOLE_ERR_STATE;
    ck_assert_int_eq(insole_phone_radio_hear(&radio, &scan, NULL), INSOLE_ERR_STATE);
    ck_assert(!insole_phone_radio_work(&radio, 4u));
    ck_assert_uint_eq(radio.given_up, 1u);
    ck_assert_uint_eq(radio.unplaced, 1u);
    ck_assert_uint_eq(fake.finished, 0u);
}
END_TEST

/* The last fix stays, with its times. */
START_TEST(a_solver_that_fails_at_the_end_gives_no_fix)
{
    set_up(0.0, 4u);
    readings[0].age_us = 0u;
    hear(5000000u, 1u);
    work_all(4u);
    (void)insole_phone_radio_take(&radio);
    insole_radio_fix_t kept = radio.fix;
    fake.finishes = INSOLE_ERR_STATE;
    hear(8000000u, 1u);
    work_all(4u);
    ck_assert(!insole_phone_radio_take(&radio));
    ck_assert_uint_eq(radio.unplaced, 1u);
    ck_assert_uint_eq(radio.fixes, 1u);
    ck_assert_mem_eq(&radio.fix, &kept, sizeof kept);
    ck_assert(radio.has_fix && radio.t_us == 5000000u && radio.heard_us == 5000000u);
    fake.finishes = INSOLE_OK;
    hear(9000000u, 1u);
    work_all(4u);
    ck_assert(insole_phone_radio_take(&radio));
}
END_TEST

START_TEST(without_solver_or_map_nothing_is_heard)
{
    insole_scan_t scan = scan_at(9000000u, 1u);
    set_up(1.0, 4u);
    ck_assert(insole_phone_radio_can_hear(&radio));
    ck_assert_int_eq(insole_phone_radio_init(&radio, &no_solver, &map, INSOLE_R(1.0)), INSOLE_OK);
    ck_assert(!insole_phone_radio_can_hear(&radio));
    ASSERT_UNCHANGED(radio, insole_phone_radio_hear(&radio, &scan, NULL), INSOLE_ERR_STATE);
    ck_assert_int_eq(insole_phone_radio_init(&radio, &solver, NULL, INSOLE_R(1.0)), INSOLE_OK);
    ck_assert(!insole_phone_radio_can_hear(&radio));
    ASSERT_UNCHANGED(radio, insole_phone_radio_hear(&radio, &scan, NULL), INSOLE_ERR_STATE);
    ck_assert(!insole_phone_radio_work(&radio, 4u));
    ck_assert(!insole_phone_radio_take(&radio));
    ck_assert_uint_eq(fake.begun, 0u);
}
END_TEST

START_TEST(solvers_that_lack_a_part_are_refused)
{
    insole_radio_solver_calls_t calls = fake_calls;
    insole_radio_solver_t lacking = {&calls, &fake};
    set_up(1.0, 4u);
    calls.begin = _i == 0 ? NULL : fake_begin;
    calls.work = _i == 1 ? NULL : fake_work;
    calls.finish = _i == 2 ? NULL : fake_finish;
    lacking.state = _i == 3 ? NULL : &fake;
    ASSERT_UNCHANGED(radio, insole_phone_radio_init(&radio, &lacking, &map, INSOLE_R(1.0)),
                     INSOLE_ERR_VALUE);
}
END_TEST

START_TEST(times_it_cannot_be_late_by_are_refused)
{
    const insole_real_t bad[] = {INSOLE_R(-0.1), INSOLE_R(10.1), (insole_real_t)NAN,
                                 (insole_real_t)INFINITY};
    set_up(1.0, 4u);
    ASSERT_UNCHANGED(radio, insole_phone_radio_init(&radio, &solver, &map, bad[_i]),
                     INSOLE_ERR_VALUE);
}
END_TEST

START_TEST(null_is_refused)
{
    insole_scan_t scan = scan_at(9000000u, 1u), hollow = {9000000u, NULL, 1u};
    insole_scan_t empty = {9000000u, NULL, 0u};
    set_up(1.0, 4u);
    hear(5000000u, 1u);
    ck_assert_int_eq(insole_phone_radio_init(NULL, &solver, &map, INSOLE_R(1.0)), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(radio, insole_phone_radio_init(&radio, NULL, &map, INSOLE_R(1.0)),
                     INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_phone_radio_hear(NULL, &scan, NULL), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(radio, insole_phone_radio_hear(&radio, NULL, NULL), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(radio, insole_phone_radio_hear(&radio, &hollow, NULL), INSOLE_ERR_NULL);
    ck_assert(!insole_phone_radio_work(NULL, 4u));
    ASSERT_UNCHANGED(radio, insole_phone_radio_work(&radio, 0u), false);
    ck_assert(!insole_phone_radio_take(NULL));
    ck_assert_int_eq(insole_phone_radio_hear(&radio, &empty, NULL), INSOLE_OK);
}
END_TEST

/* ---- with a solver of the library -------------------------------------------------------- */

/* In slices and through the table the same bits as at once. */
START_TEST(a_solver_of_the_library_gives_its_own_fix)
{
    static prints_t prints;
    static insole_kde_fix_t direct, sliced;
    static insole_rss_t heard[200];
    insole_rng_t rng;
    insole_radio_fix_t expected;
    insole_radio_solver_t kde = {&insole_kde_fix_calls, &sliced};
    insole_rng_seed(&rng, 8u);
    prints_hall(&prints, 200u, 0.0, 0.0);
    ck_assert_int_eq(insole_kde_fix_init(&direct, &insole_kde_fix_defaults), INSOLE_OK);
    ck_assert_int_eq(insole_kde_fix_init(&sliced, &insole_kde_fix_defaults), INSOLE_OK);
    ck_assert_int_eq(insole_phone_radio_init(&radio, &kde, &prints.map, INSOLE_R(1.0)), INSOLE_OK);
    for (int i = 0; i < 10; i++) {
        uint32_t count = prints_listen(&rng, 200u, 4.0 + 3.0 * i, 20.0, 3.0, 0.0, heard);
        insole_scan_t scan = {1000000u * (uint64_t)(i + 1), heard, count};
        ck_assert_int_eq(insole_kde_fix_solve(&direct, &prints.map, NULL, heard, count, &expected),
                         INSOLE_OK);
        ck_assert_int_eq(insole_phone_radio_hear(&radio, &scan, NULL), INSOLE_OK);
        memset(heard, 0x3a, sizeof heard); /* readings are copied */
        work_all(1u + (uint32_t)i);
        ck_assert(insole_phone_radio_take(&radio));
        ck_assert(radio.fix.spot.x_m == expected.spot.x_m);
        ck_assert(radio.fix.spot.y_m == expected.spot.y_m);
        ck_assert(radio.fix.var_x_m2 == expected.var_x_m2);
        ck_assert(radio.fix.cov_xy_m2 == expected.cov_xy_m2);
        ck_assert(radio.fix.var_y_m2 == expected.var_y_m2);
    }
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("phone_radio");
    suite_add_loop(suite, "heard", heard_time_is_that_of_the_youngest_reading, 12);
    suite_add(suite, "times of the fix", times_belong_to_the_fix);
    suite_add_loop(suite, "slices", work_is_done_in_slices, 7);
    suite_add(suite, "taken once", a_fix_is_taken_once);
    suite_add(suite, "given up", a_scan_in_work_is_given_up_for_the_next);
    suite_add(suite, "area", the_area_is_handed_on);
    suite_add(suite, "refused", what_the_solver_refuses_is_counted);
    suite_add(suite, "refused while in work", a_refused_scan_ends_the_one_in_work);
    suite_add(suite, "fails at the end", a_solver_that_fails_at_the_end_gives_no_fix);
    suite_add(suite, "no solver", without_solver_or_map_nothing_is_heard);
    suite_add_loop(suite, "lacking solver", solvers_that_lack_a_part_are_refused, 4);
    suite_add_loop(suite, "late", times_it_cannot_be_late_by_are_refused, 4);
    suite_add(suite, "NULL", null_is_refused);
    suite_add(suite, "library", a_solver_of_the_library_gives_its_own_fix);
    return suite;
}
