/* SPDX-License-Identifier: MIT */
#include "insole/track/fusion_radio.h"

#include <stdlib.h>
#include <string.h>

#include "radio.h"
#include "refusal.h"
#include "suite.h"

enum { APS = 12, MANY = 300, RANGES = INSOLE_FUSION_RANGES, SECOND = 1000000 };

static radio_t world;
static insole_rng_t rng;
static insole_rss_t readings[RADIO_APS];
static insole_range_t ranges[RADIO_APS];
static insole_rss_fix_config_t rss_fix;
static insole_range_fix_config_t range_fix;
static insole_fusion_site_t site;
static insole_fusion_radio_t radio, before;
static insole_fusion_ranges_t kept;
static insole_evidence_t news;

static void begin(uint32_t aps)
{
    static const insole_fusion_radio_t blank;
    insole_rng_seed(&rng, 3u);
    radio_scatter(&world, &rng, aps, 0.0, 0.0);
    rss_fix = insole_rss_fix_defaults;
    range_fix = insole_range_fix_defaults;
    insole_fusion_site_t s = {&world.building, &rss_fix, &range_fix, false, false, 2};
    site = s;
    radio = blank;
    ck_assert_int_eq(insole_fusion_ranges_init(&kept), INSOLE_OK);
    radio.ranges = &kept;
    insole_evidence_clear(&news);
}

static insole_spot_t spot(double x, double y)
{
    insole_spot_t s = {(insole_real_t)x, (insole_real_t)y};
    return s;
}

static insole_scan_t scan_of(uint64_t t_us, uint32_t count)
{
    insole_scan_t scan = {t_us, readings, count};
    return scan;
}

/* All access points heard at (x, y). */
static void hear(uint64_t t_us, double x, double y)
{
    uint32_t count = world.building.ap_count;
    radio_listen(&world, &rng, x, y, 0.5, 2.0, count, readings);
    insole_scan_t scan = scan_of(t_us, count);
    ck_assert_int_eq(insole_fusion_radio_hear(&radio, &site, &scan), INSOLE_OK);
}

/* Ranges from (x, y) to the first `count` access points, as a radio measures them: too long. */
static void range(uint64_t t_us, double x, double y, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        double d = hypot(x - (double)world.aps[i].x_m, y - (double)world.aps[i].y_m);
        insole_range_t r = {t_us, i, (insole_real_t)hypot(d, 2.5) + range_fix.bias_m, 0};
        ranges[i] = r;
    }
    ck_assert_int_eq(insole_fusion_radio_range(&radio, &site, ranges, count), INSOLE_OK);
}

static void place(uint64_t t_us, double x, double y)
{
    ck_assert_int_eq(insole_fusion_radio_place(&radio, &site, t_us, spot(x, y)), INSOLE_OK);
}

static void tell(double x, double y)
{
    insole_evidence_clear(&news);
    ck_assert_int_eq(insole_fusion_radio_tell(&radio, &site, spot(x, y), &news), INSOLE_OK);
    ck_assert_int_eq(insole_evidence_check(&news), INSOLE_OK);
}

static void check_same_place(const insole_anchor_fix_t *a, const insole_anchor_fix_t *b)
{
    ASSERT_NEAR(a->x_m, b->x_m, 0.0, "m");
    ASSERT_NEAR(a->y_m, b->y_m, 0.0, "m");
    ck_assert_mem_eq(&a->P, &b->P, sizeof a->P);
    ck_assert_uint_eq(a->used, b->used);
}

/* ---- scans ---- */

/* First for the foot, then for the stride; told with the way walked since it was heard. */
START_TEST(a_scan_waits_twice)
{
    begin(APS);
    hear(5 * SECOND, 20.0, 15.0);
    place(5 * SECOND - 1, 7.0, 7.0);
    tell(7.0, 7.0);
    ck_assert(!news.has_scan && !radio.has_fix);
    ck_assert(!insole_fusion_radio_waits(&radio, UINT64_MAX));
    place(5 * SECOND, 2.0, 3.0);
    place(6 * SECOND, 4.0, 4.0); /* later places are another matter */
    ck_assert(radio.has_fix);
    ASSERT_NEAR(radio.fix_n_m.x_m, 2.0, 0.0, "m");
    ck_assert(radio.fix_us == 5 * SECOND);
    tell(5.0, 1.0);
    ck_assert(news.has_scan);
    ASSERT_NEAR(news.since.x_m, 3.0, 1e-6, "m");
    ASSERT_NEAR(news.since.y_m, -2.0, 1e-6, "m");
    ck_assert_uint_eq(news.reading_count, APS);
    for (uint32_t i = 1; i < APS; i++) {
        ck_assert(news.readings[i].rss_dbm <= news.readings[i - 1].rss_dbm);
    }
    tell(6.0, 1.0);
    ck_assert(!news.has_scan); /* told once */
    insole_fusion_counts_t expected = {1, 0, 0, 0};
    ck_assert_mem_eq(&radio.counts, &expected, sizeof expected);
}
END_TEST

START_TEST(the_place_by_radio_is_that_of_the_scan)
{
    insole_anchor_fix_t fix;
    begin(APS);
    hear(SECOND, 20.0, 15.0);
    place(SECOND, 0.0, 0.0);
    ck_assert_int_eq(insole_rss_fix_solve(&rss_fix, &world.propagation, world.aps, APS,
                                          radio.scan.readings, APS, &fix),
                     INSOLE_OK);
    check_same_place(&radio.fix, &fix);
    ASSERT_NEAR(fix.x_m, 20.0, 3.0 * sqrt((double)fix.P.xx), "m");
    ASSERT_NEAR(fix.y_m, 15.0, 3.0 * sqrt((double)fix.P.yy), "m");
    ASSERT_AT_MOST(fix.P.xx, 36.0, "m2");
}
END_TEST

static int weaker_last(const void *a, const void *b)
{
    const insole_rss_t *p = a, *q = b;
    return (q->rss_dbm > p->rss_dbm) - (q->rss_dbm < p->rss_dbm);
}

/* Of three hundred, the strongest sixteen that are known and finite, strongest first. */
START_TEST(of_many_the_strongest_are_kept)
{
    static insole_rss_t sorted[MANY];
    uint32_t usable = 0;
    begin(MANY);
    radio_listen(&world, &rng, 20.0, 15.0, 0.5, 2.0, MANY, readings);
    for (uint32_t i = 0; i < MANY; i++) {
        readings[i].id = i % 7 == 0 ? MANY + i : readings[i].id;
        readings[i].rss_dbm = i % 11 == 0 ? (insole_real_t)NAN : readings[i].rss_dbm;
        readings[i].rss_dbm = i % 13 == 0 ? (insole_real_t)HUGE_VAL : readings[i].rss_dbm;
        if (i % 7 != 0 && i % 11 != 0 && i % 13 != 0) {
            sorted[usable++] = readings[i];
        }
    }
    qsort(sorted, usable, sizeof sorted[0], weaker_last);
    insole_scan_t scan = scan_of(SECOND, MANY);
    ck_assert_int_eq(insole_fusion_radio_hear(&radio, &site, &scan), INSOLE_OK);
    memset(readings, 0xa5, sizeof readings); /* they have been copied */
    place(SECOND, 0.0, 0.0);
    tell(0.0, 0.0);
    ck_assert_uint_eq(news.reading_count, INSOLE_FUSION_HEARD);
    for (uint32_t i = 0; i < INSOLE_FUSION_HEARD; i++) {
        ck_assert_uint_eq(news.readings[i].id, sorted[i].id);
        ASSERT_NEAR(news.readings[i].rss_dbm, sorted[i].rss_dbm, 0.0, "dBm");
    }
}
END_TEST

START_TEST(a_scan_of_strangers_says_nothing)
{
    begin(APS);
    for (uint32_t i = 0; i < 3; i++) {
        insole_rss_t stranger = {APS + i, -50, 0};
        readings[i] = stranger;
    }
    insole_scan_t scan = scan_of(SECOND, 3), empty = {SECOND, NULL, 0};
    ck_assert_int_eq(insole_fusion_radio_hear(&radio, &site, &scan), INSOLE_OK);
    ck_assert_int_eq(insole_fusion_radio_hear(&radio, &site, &empty), INSOLE_OK);
    place(2 * SECOND, 0.0, 0.0);
    tell(0.0, 0.0);
    ck_assert(!news.has_scan && !radio.has_fix);
    insole_fusion_counts_t expected = {2, 0, 0, 2};
    ck_assert_mem_eq(&radio.counts, &expected, sizeof expected);
}
END_TEST

/* One waits for the foot, one for the stride; there is no room for more. */
START_TEST(the_first_keeps_its_place_before_the_foot)
{
    begin(APS);
    hear(3 * SECOND, 20.0, 15.0);
    insole_fusion_scan_t first = radio.arrived;
    hear(4 * SECOND, 5.0, 5.0);
    hear(3 * SECOND, 5.0, 5.0);
    ck_assert_mem_eq(&radio.arrived, &first, sizeof first);
    ck_assert_uint_eq(radio.counts.unused, 2);
    place(3 * SECOND, 1.0, 1.0);
    hear(5 * SECOND, 5.0, 5.0);
    ck_assert_uint_eq(radio.counts.unused, 2);
    ck_assert(radio.arrived.waits && radio.scan.waits);
    place(5 * SECOND, 2.0, 2.0); /* no stride came for the first: the newer is told */
    ck_assert_uint_eq(radio.counts.unused, 3);
    tell(2.5, 2.0);
    ck_assert(news.has_scan);
    ASSERT_NEAR(news.since.x_m, 0.5, 1e-6, "m");
    ck_assert_uint_eq(radio.counts.scans, 4);
}
END_TEST

/* A stamp from far ahead would be waited for all day. */
START_TEST(a_leap_of_stamps_is_got_over)
{
    begin(APS);
    hear((uint64_t)1 << 60, 5.0, 5.0);
    place(SECOND, 1.0, 1.0);
    ck_assert(!radio.scan.waits);
    hear(2 * SECOND, 20.0, 15.0);
    ck_assert_uint_eq(radio.counts.unused, 1);
    place(2 * SECOND, 1.0, 1.0);
    ck_assert(radio.scan.waits && radio.scan.t_us == 2 * SECOND);
    range((uint64_t)1 << 60, 5.0, 5.0, 1);
    for (uint32_t i = 0; i < RANGES; i++) {
        range((3 + i) * SECOND, 20.0, 15.0, 1);
        place((3 + i) * SECOND, 1.0, 1.0);
    }
    ck_assert_uint_eq(radio.ranges->placed, RANGES);
    ck_assert_uint_eq(radio.counts.unused, 2);
}
END_TEST

START_TEST(it_is_known_how_long_it_waits)
{
    begin(APS);
    hear(5 * SECOND, 20.0, 15.0);
    place(5 * SECOND, 0.0, 0.0);
    ck_assert(!insole_fusion_radio_waits(&radio, 5 * SECOND - 1));
    ck_assert(insole_fusion_radio_waits(&radio, 5 * SECOND));
    tell(0.0, 0.0);
    ck_assert(!insole_fusion_radio_waits(&radio, UINT64_MAX));
    range(7 * SECOND, 20.0, 15.0, 2);
    ck_assert(!insole_fusion_radio_waits(&radio, UINT64_MAX));
    place(7 * SECOND, 0.0, 0.0);
    ck_assert(!insole_fusion_radio_waits(&radio, 7 * SECOND - 1));
    ck_assert(insole_fusion_radio_waits(&radio, 7 * SECOND));
    ck_assert(!insole_fusion_radio_waits(NULL, UINT64_MAX));
}
END_TEST

/* ---- ranges ---- */

/* Each from where the foot was; what is still to come waits on. */
START_TEST(ranges_are_told_from_where_they_were_measured)
{
    begin(APS);
    ranges[0].sigma_m = 0;
    range(SECOND, 20.0, 15.0, 2);
    range(2 * SECOND, 20.0, 15.0, 2);
    range(3 * SECOND, 20.0, 15.0, 1);
    radio.ranges->range[2].sigma_m = INSOLE_R(0.75);
    place(SECOND, 1.0, 0.0);
    place(2 * SECOND + 5, 2.0, 0.5);
    tell(4.0, 2.0);
    ck_assert_uint_eq(news.ranges, 4);
    for (uint32_t i = 0; i < 4; i++) {
        const insole_evidence_range_t *told = &news.range[i];
        double sigma = (double)range_fix.sigma_m;
        ASSERT_NEAR(told->since.x_m, i < 2 ? 3.0 : 2.0, 1e-6, "m");
        ASSERT_NEAR(told->since.y_m, i < 2 ? 2.0 : 1.5, 1e-6, "m");
        ASSERT_NEAR(told->from.x_m, world.aps[i % 2].x_m, 0.0, "m");
        ASSERT_NEAR(told->from.y_m, world.aps[i % 2].y_m, 0.0, "m");
        ASSERT_NEAR(told->range_m, (double)ranges[i % 2].range_m - (double)range_fix.bias_m, 1e-5,
                    "m");
        ASSERT_NEAR(told->sigma_m, i == 2 ? hypot(sigma, 0.75) : sigma, 1e-6, "m");
        ck_assert(told->dof > 0);
    }
    ck_assert_uint_eq(radio.ranges->count, 1);
    place(3 * SECOND, 5.0, 5.0);
    tell(6.0, 5.0);
    ck_assert_uint_eq(news.ranges, 1);
    ASSERT_NEAR(news.range[0].since.x_m, 1.0, 1e-6, "m");
    ck_assert_uint_eq(radio.ranges->count, 0);
    ck_assert_uint_eq(radio.counts.ranges, 5);
}
END_TEST

/* More than there is room for: the newest stay. */
START_TEST(the_oldest_ranges_leave)
{
    begin(APS);
    range(SECOND, 20.0, 15.0, 3);
    place(SECOND, 1.0, 1.0);
    range(2 * SECOND, 20.0, 15.0, 7);
    ck_assert_uint_eq(radio.ranges->count, RANGES);
    ck_assert_uint_eq(radio.ranges->placed, 1);
    ck_assert_uint_eq(radio.counts.unused, 2);
    range(2 * SECOND, 20.0, 15.0, APS);
    ck_assert_uint_eq(radio.ranges->placed, 0);
    ck_assert_uint_eq(radio.counts.unused, 2 + APS);
    for (uint32_t i = 0; i < RANGES; i++) {
        ck_assert_uint_eq(radio.ranges->range[i].id, APS - RANGES + i);
    }
    place(2 * SECOND, 2.0, 2.0);
    tell(3.0, 3.0);
    ck_assert_uint_eq(news.ranges, RANGES);
    ck_assert_uint_eq(radio.counts.ranges, 10 + APS);
}
END_TEST

static const struct {
    const char *what;
    double range_m, sigma_m;
    uint32_t id;
} bad_ranges[] = {{"unknown", 5, 0, APS},           {"negative", -0.1, 0, 1},
                  {"no number", (double)NAN, 0, 1}, {"endless", HUGE_VAL, 0, 1},
                  {"too long", 101, 0, 1},          {"unsure", 5, 10.5, 1},
                  {"very unsure", 5, HUGE_VAL, 1},  {"from nowhere", 5, 0, 2}};

START_TEST(bad_ranges_are_passed_over)
{
    begin(APS);
    world.aps[2].x_m = (insole_real_t)NAN;
    insole_range_t bad = {SECOND, bad_ranges[_i].id, (insole_real_t)bad_ranges[_i].range_m,
                          (insole_real_t)bad_ranges[_i].sigma_m};
    ck_assert_int_eq(insole_fusion_radio_range(&radio, &site, &bad, 1), INSOLE_OK);
    place(2 * SECOND, 0.0, 0.0);
    insole_fusion_counts_t expected = {0, 1, 0, 1};
    ck_assert_msg(radio.ranges->count == 0 && !radio.has_fix, "%s", bad_ranges[_i].what);
    ck_assert_mem_eq(&radio.counts, &expected, sizeof expected);
}
END_TEST

/* A shorter range than what all are too long by. */
START_TEST(no_range_is_told_below_zero)
{
    begin(APS);
    insole_range_t brief = {SECOND, 1, INSOLE_R(0.5), (insole_real_t)NAN};
    ck_assert_int_eq(insole_fusion_radio_range(&radio, &site, &brief, 1), INSOLE_OK);
    place(SECOND, 0.0, 0.0);
    tell(0.0, 0.0);
    ck_assert_uint_eq(news.ranges, 1);
    ASSERT_NEAR(news.range[0].range_m, 0.0, 0.0, "m");
    ASSERT_NEAR(news.range[0].sigma_m, range_fix.sigma_m, 0.0, "m");
}
END_TEST

/* With what is remembered of the moment before, aged; nothing is remembered of the future. */
START_TEST(ranges_give_a_place)
{
    begin(APS);
    range(SECOND, 20.0, 15.0, 6);
    place(SECOND, 1.0, 1.0);
    ck_assert(radio.has_fix && radio.fix_us == SECOND);
    insole_anchor_fix_t aged = radio.fix, fix;
    ASSERT_NEAR(aged.x_m, 20.0, 1.0, "m");
    ASSERT_NEAR(aged.y_m, 15.0, 1.0, "m");
    tell(0.0, 0.0);
    range(3 * SECOND, 21.0, 15.0, 4);
    place(3 * SECOND, 1.0, 1.0);
    ck_assert_int_eq(insole_range_fix_age(&range_fix, &aged, 2), INSOLE_OK);
    insole_range_fix_solve(&range_fix, world.aps, APS, ranges, 4, &aged, &fix);
    check_same_place(&radio.fix, &fix);
    tell(0.0, 0.0);
    range(2 * SECOND, 5.0, 5.0, 4);
    place(4 * SECOND, 1.0, 1.0);
    insole_range_fix_solve(&range_fix, world.aps, APS, ranges, 4, NULL, &fix);
    check_same_place(&radio.fix, &fix);
}
END_TEST

/* Place by radio, time, and place of the foot belong together at every moment. */
START_TEST(the_foot_was_there_then)
{
    begin(APS);
    hear(SECOND, 20.0, 15.0);
    place(SECOND, 1.0, 2.0);
    range(2 * SECOND, 25.0, 15.0, 6);
    hear(2 * SECOND, 25.0, 15.0);
    ck_assert(radio.fix_us == SECOND); /* the foot is not there yet */
    ASSERT_NEAR(radio.fix_n_m.x_m, 1.0, 0.0, "m");
    place(2 * SECOND, 6.0, 2.0);
    ck_assert(radio.fix_us == 2 * SECOND);
    ASSERT_NEAR(radio.fix_n_m.x_m, 6.0, 0.0, "m");
    insole_rss_t faint = {0, -130, 0}; /* no place comes of it */
    insole_scan_t scan = {3 * SECOND, &faint, 1};
    ck_assert_int_eq(insole_fusion_radio_hear(&radio, &site, &scan), INSOLE_OK);
    place(3 * SECOND, 9.0, 9.0);
    ck_assert(radio.fix_us == 2 * SECOND);
    ASSERT_NEAR(radio.fix_n_m.x_m, 6.0, 0.0, "m");
}
END_TEST

/* ---- the method of radio alone ---- */

START_TEST(at_once_nothing_waits)
{
    insole_anchor_fix_t fix;
    begin(APS);
    site.at_once = true;
    hear(3 * SECOND, 20.0, 15.0);
    ck_assert(radio.has_fix && radio.is_new && radio.fix_us == 3 * SECOND);
    insole_rss_fix_solve(&rss_fix, &world.propagation, world.aps, APS, readings, APS, &fix);
    ASSERT_NEAR(radio.fix.x_m, fix.x_m, 1e-3, "m");
    ASSERT_NEAR(radio.fix.y_m, fix.y_m, 1e-3, "m");
    radio.is_new = false;
    range(4 * SECOND, 10.0, 10.0, 6);
    ck_assert(radio.is_new && radio.fix_us == 4 * SECOND);
    ck_assert(!radio.arrived.waits && radio.ranges->count == 0);
    place(5 * SECOND, 0.0, 0.0);
    tell(0.0, 0.0);
    ck_assert(!news.has_scan && news.ranges == 0);
    ck_assert_uint_eq(radio.counts.unused, 0);
}
END_TEST

/* ---- the paper ---- */

/* The strongest access point alone, as a range by (11) whose error is normal. */
START_TEST(the_paper_hears_the_nearest_only)
{
    insole_rss_range_t range_m;
    begin(APS);
    site.nearest_only = true;
    site.sigma_range_m = INSOLE_R(1.7);
    hear(SECOND, (double)world.aps[4].x_m + 0.1, (double)world.aps[4].y_m);
    insole_rss_t loud = {4, INSOLE_R(-20.0), 0};
    radio.arrived.readings[0] = loud;
    place(SECOND, 1.0, 1.0);
    tell(2.0, 3.0);
    ck_assert(!news.has_scan && !radio.scan.waits);
    ck_assert_uint_eq(news.ranges, 1);
    ck_assert_int_eq(insole_propagation_range(&world.propagation, &world.aps[4], -20, 0,
                                              INSOLE_R(0.5), &range_m),
                     INSOLE_OK);
    ASSERT_NEAR(news.range[0].from.x_m, world.aps[4].x_m, 0.0, "m");
    ASSERT_NEAR(news.range[0].range_m, range_m.range_m, 0.0, "m");
    ASSERT_NEAR(news.range[0].sigma_m, 1.7, 1e-6, "m");
    ASSERT_NEAR(news.range[0].dof, 0.0, 0.0, "");
    ASSERT_NEAR(news.range[0].since.y_m, 2.0, 1e-6, "m");
    insole_rss_t faint = {4, INSOLE_R(-80.0), 0};
    insole_scan_t scan = {2 * SECOND, &faint, 1};
    ck_assert_int_eq(insole_fusion_radio_hear(&radio, &site, &scan), INSOLE_OK);
    place(2 * SECOND, 1.0, 1.0);
    tell(2.0, 3.0);
    ck_assert_uint_eq(news.ranges, 0); /* not near */
}
END_TEST

/* ---- a place by radio alone ---- */

static void know_place(double x, double y, double var_x, double var_y)
{
    begin(APS);
    radio.fix.x_m = (insole_real_t)x;
    radio.fix.y_m = (insole_real_t)y;
    radio.fix.P.xx = (insole_real_t)var_x;
    radio.fix.P.xy = INSOLE_R(0.25);
    radio.fix.P.yy = (insole_real_t)var_y;
    radio.fix_n_m = spot(3.0, 1.0);
    radio.has_fix = true;
}

START_TEST(the_place_goes_into_a_fix)
{
    insole_fix_t fix = {7, {1, 2, 3}, 4, 5, 6, 7, 8, 9, INSOLE_FIX_COAST}, expected;
    memcpy(&expected, &fix, sizeof fix);
    expected.position_m = insole_vec3(20, 15, 3);
    expected.var_x_m2 = 4;
    expected.cov_xy_m2 = INSOLE_R(0.25);
    expected.var_y_m2 = 9;
    know_place(20.0, 15.0, 4.0, 9.0);
    ck_assert_int_eq(insole_fusion_radio_fix(&radio, &fix), INSOLE_OK);
    ck_assert_mem_eq(&fix, &expected, sizeof fix);
}
END_TEST

/* Two normal places, of which one has walked on since, turned into the map. */
START_TEST(two_places_are_mixed_by_their_weights)
{
    insole_fix_t fix = {7, {10, 12, 3}, 4, 5, 6, 7, 8, 9, INSOLE_FIX_TRACK};
    know_place(20.0, 15.0, 4.0, 6.0);
    ck_assert_int_eq(
        insole_fusion_radio_mix(&radio, spot(4.0, 3.0), insole_turn(INSOLE_R(0.7)), 2, &fix),
        INSOLE_OK);
    double x = 20.0 + cos(0.7) - 2.0 * sin(0.7), y = 15.0 + sin(0.7) + 2.0 * cos(0.7);
    double own = 1.0 / 2.0, other = 1.0 / 5.0, sum = own + other;
    ASSERT_NEAR(fix.position_m.x, (own * 10.0 + other * x) / sum, 1e-5, "m");
    ASSERT_NEAR(fix.position_m.y, (own * 12.0 + other * y) / sum, 1e-5, "m");
    ASSERT_NEAR(fix.var_x_m2, 1.0 / sum, 1e-5, "m2");
    ASSERT_NEAR(fix.var_y_m2, 1.0 / sum, 1e-5, "m2");
    ASSERT_NEAR(fix.cov_xy_m2, 0.0, 0.0, "m2");
    ASSERT_NEAR(fix.position_m.z, 3.0, 0.0, "m");
    insole_fix_t exact = fix;
    ck_assert_int_eq(insole_fusion_radio_mix(&radio, spot(4.0, 3.0), insole_turn(0), 0, &exact),
                     INSOLE_OK);
    ASSERT_NEAR(exact.position_m.x, fix.position_m.x, 0.0, "m"); /* what is certain stays */
    ASSERT_NEAR(exact.var_x_m2, 0.0, 0.0, "m2");
}
END_TEST

/* ---- refusals ---- */

START_TEST(without_access_points_there_is_no_radio)
{
    insole_building_t broken[4];
    for (int i = 0; i < 6; i++) {
        begin(APS);
        for (int k = 0; k < 4; k++) {
            broken[k] = world.building;
        }
        broken[0].aps = NULL;
        broken[1].ap_count = 0;
        broken[2].propagation = NULL;
        site.building = i < 3 ? &broken[i] : i == 3 ? NULL : &world.building;
        const insole_fusion_site_t *s = i == 4 ? NULL : &site;
        insole_scan_t scan = scan_of(SECOND, 0);
        insole_status_t status = i == 4 ? INSOLE_ERR_NULL : INSOLE_ERR_STATE;
        ck_assert(insole_fusion_radio_has_aps(s) == (i == 5));
        if (i < 5) {
            ASSERT_UNCHANGED(radio, insole_fusion_radio_hear(&radio, s, &scan), status);
            ASSERT_UNCHANGED(radio, insole_fusion_radio_range(&radio, s, ranges, 1), status);
        }
    }
}
END_TEST

/* Whoever lends nothing for ranges is told none; scans are heard as ever. */
START_TEST(ranges_need_their_room)
{
    begin(APS);
    range(SECOND, 20.0, 15.0, 3);
    radio.ranges = NULL;
    ASSERT_UNCHANGED(radio, insole_fusion_radio_range(&radio, &site, ranges, 3), INSOLE_ERR_STATE);
    hear(SECOND, 20.0, 15.0);
    place(SECOND, 1.0, 1.0);
    ck_assert(insole_fusion_radio_waits(&radio, SECOND));
    tell(2.0, 1.0);
    ck_assert(radio.has_fix && !insole_fusion_radio_waits(&radio, UINT64_MAX));
    ck_assert_uint_eq(news.ranges, 0);
    ck_assert_uint_gt(news.reading_count, 0);
    insole_fusion_radio_forget(&radio);
    ck_assert(!radio.has_fix);
    ck_assert_uint_eq(kept.count, 3); /* nobody has looked */
    ck_assert_int_eq(insole_fusion_ranges_init(NULL), INSOLE_ERR_NULL);
}
END_TEST

START_TEST(bad_input_changes_nothing)
{
    insole_fix_t fix;
    insole_turn_t turn = insole_turn(0);
    begin(APS);
    hear(SECOND, 20.0, 15.0);
    range(SECOND, 20.0, 15.0, 3);
    insole_scan_t hollow = {SECOND, NULL, 3};
    ASSERT_UNCHANGED(radio, insole_fusion_radio_hear(&radio, &site, NULL), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(radio, insole_fusion_radio_hear(&radio, &site, &hollow), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(radio, insole_fusion_radio_range(&radio, &site, NULL, 3), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(radio, insole_fusion_radio_range(&radio, &site, NULL, 0), INSOLE_OK);
    ASSERT_UNCHANGED(radio,
                     insole_fusion_radio_place(&radio, &site, SECOND, spot((double)NAN, 0.0)),
                     INSOLE_ERR_VALUE);
    ASSERT_UNCHANGED(radio, insole_fusion_radio_place(&radio, &site, SECOND, spot(0.0, HUGE_VAL)),
                     INSOLE_ERR_VALUE);
    ASSERT_UNCHANGED(radio, insole_fusion_radio_place(&radio, NULL, SECOND, spot(0.0, 0.0)),
                     INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(radio, insole_fusion_radio_tell(&radio, &site, spot(0.0, 0.0), NULL),
                     INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(radio, insole_fusion_radio_tell(&radio, NULL, spot(0.0, 0.0), &news),
                     INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_fusion_radio_hear(NULL, &site, &hollow), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_fusion_radio_range(NULL, &site, ranges, 1), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_fusion_radio_place(NULL, &site, 0, spot(0, 0)), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_fusion_radio_tell(NULL, &site, spot(0, 0), &news), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_fusion_radio_fix(NULL, &fix), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_fusion_radio_fix(&radio, NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_fusion_radio_mix(NULL, spot(0, 0), turn, 1, &fix), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_fusion_radio_mix(&radio, spot(0, 0), turn, 1, NULL), INSOLE_ERR_NULL);
}
END_TEST

START_TEST(no_fix_is_touched_in_vain)
{
    insole_fix_t fix;
    insole_turn_t turn = insole_turn(0);
    memset(&fix, 0x5a, sizeof fix);
    begin(APS);
    ASSERT_UNCHANGED(fix, insole_fusion_radio_fix(&radio, &fix), INSOLE_ERR_STATE);
    ASSERT_UNCHANGED(fix, insole_fusion_radio_mix(&radio, spot(0, 0), turn, 1, &fix),
                     INSOLE_ERR_STATE);
    know_place(20.0, 15.0, 4.0, 4.0);
    ASSERT_UNCHANGED(fix, insole_fusion_radio_mix(&radio, spot(0, 0), turn, -1, &fix),
                     INSOLE_ERR_VALUE);
    ASSERT_UNCHANGED(fix,
                     insole_fusion_radio_mix(&radio, spot(0, 0), turn, (insole_real_t)NAN, &fix),
                     INSOLE_ERR_VALUE);
    ASSERT_UNCHANGED(
        fix, insole_fusion_radio_mix(&radio, spot(0, 0), turn, (insole_real_t)HUGE_VAL, &fix),
        INSOLE_ERR_VALUE);
    ASSERT_UNCHANGED(fix, insole_fusion_radio_mix(&radio, spot((double)NAN, 0), turn, 1, &fix),
                     INSOLE_ERR_VALUE);
}
END_TEST

/* ---- whatever comes ---- */

static insole_real_t wild(double low, double high)
{
    static const double odd[] = {0.0, 1e30, -1e30, (double)NAN, HUGE_VAL, -HUGE_VAL};
    uint32_t pick = insole_rng_bits(&rng) % 30u;
    return (insole_real_t)(pick < 6u ? odd[pick] : draw_uniform(&rng, low, high));
}

static uint64_t wild_stamp(uint64_t now_us)
{
    uint32_t pick = insole_rng_bits(&rng) % 20u;
    return pick == 0u   ? UINT64_MAX - pick
           : pick == 1u ? 0u
                        : now_us - 500000u + insole_rng_bits(&rng) % 1000000u;
}

static void come_what_may(uint64_t now_us)
{
    uint32_t count = insole_rng_bits(&rng) % 20u;
    for (uint32_t i = 0; i < count; i++) {
        readings[i].id = insole_rng_bits(&rng) % 15u;
        readings[i].rss_dbm = wild(-100.0, 0.0);
        ranges[i].id = insole_rng_bits(&rng) % 15u;
        ranges[i].range_m = wild(0.0, 40.0);
        ranges[i].sigma_m = wild(-1.0, 3.0);
        ranges[i].t_us = i == 0 || i % 5u == 4u ? wild_stamp(now_us) : ranges[i - 1].t_us;
    }
    insole_scan_t scan = scan_of(wild_stamp(now_us), count);
    (void)insole_fusion_radio_hear(&radio, &site, &scan);
    (void)insole_fusion_radio_range(&radio, &site, ranges, insole_rng_bits(&rng) % (count + 1u));
    insole_spot_t here = {wild(-50.0, 50.0), wild(-50.0, 50.0)};
    (void)insole_fusion_radio_place(&radio, &site, now_us, here);
}

/* What is kept keeps to its room, and what leaves may be told. */
START_TEST(whatever_comes_it_keeps_its_order)
{
    begin(APS);
    site.nearest_only = _i == 1;
    site.at_once = _i == 2;
    for (uint32_t k = 1; k < 5000; k++) {
        come_what_may(k * (uint64_t)500000u);
        ck_assert(radio.ranges->placed <= radio.ranges->count && radio.ranges->count <= RANGES);
        ck_assert(radio.scan.count <= INSOLE_FUSION_HEARD);
        ck_assert(!radio.has_fix || (insole_is_finite(radio.fix.x_m) && radio.fix.P.xx >= 0));
        if (insole_rng_bits(&rng) % 3u == 0u) {
            tell(1.0, 1.0);
        }
    }
    ck_assert(radio.has_fix && radio.counts.unknown > 0 && radio.counts.scans > 1000);
}
END_TEST

/* No pointers into itself: a copy goes on alike. */
START_TEST(a_copy_goes_on_alike)
{
    insole_evidence_t other;
    begin(APS);
    hear(SECOND, 20.0, 15.0);
    range(SECOND, 20.0, 15.0, 5);
    place(SECOND, 1.0, 1.0);
    hear(2 * SECOND, 22.0, 15.0);
    before = radio;
    const insole_fusion_ranges_t kept_before = kept;
    place(2 * SECOND, 2.0, 1.0);
    tell(3.0, 1.0);
    other = news;
    insole_fusion_radio_t first = radio;
    memset(&radio, 0xa5, sizeof radio);
    radio = before;
    kept = kept_before;
    place(2 * SECOND, 2.0, 1.0);
    tell(3.0, 1.0);
    ck_assert(radio.fix.used == first.fix.used);
    ASSERT_NEAR(radio.fix.x_m, first.fix.x_m, 0.0, "m");
    ASSERT_NEAR(radio.fix.y_m, first.fix.y_m, 0.0, "m");
    ASSERT_NEAR(radio.fix.P.xx, first.fix.P.xx, 0.0, "m^2");
    memcpy(&radio.fix, &first.fix, sizeof radio.fix); /* what pads it is anything */
    ck_assert_mem_eq(&radio, &first, sizeof radio);
    ck_assert_mem_eq(news.range, other.range, sizeof news.range);
    ck_assert_ptr_eq(news.readings, radio.scan.readings);
}
END_TEST

/* What has its place is forgotten, what has not come to it yet is not. */
START_TEST(what_lies_before_a_gap_is_forgotten)
{
    begin(APS);
    hear(5 * SECOND, 20.0, 15.0);
    range(5 * SECOND, 20.0, 15.0, 3);
    place(5 * SECOND, 2.0, 3.0);
    hear(6 * SECOND, 21.0, 15.0);
    range(6 * SECOND, 21.0, 15.0, 2);
    insole_fusion_radio_forget(&radio);
    insole_fusion_radio_forget(NULL);
    ck_assert(!radio.has_fix);
    ck_assert_uint_eq(radio.counts.unused, 4);
    tell(2.0, 3.0);
    ck_assert(!news.has_scan && news.ranges == 0);
    place(6 * SECOND, 3.0, 3.0);
    tell(3.0, 3.0);
    ck_assert(news.has_scan && news.ranges == 2 && radio.has_fix);
}
END_TEST

START_TEST(a_place_by_radio_is_taken_once)
{
    insole_fix_t fix;
    begin(APS);
    ASSERT_UNCHANGED(radio, insole_fusion_radio_take(&radio, &fix), INSOLE_ERR_STATE);
    hear(5 * SECOND, 20.0, 15.0);
    place(5 * SECOND, 2.0, 3.0);
    ASSERT_UNCHANGED(radio, insole_fusion_radio_take(&radio, NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_fusion_radio_take(NULL, &fix), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_fusion_radio_take(&radio, &fix), INSOLE_OK);
    ck_assert(fix.t_us == 5 * SECOND && fix.state == INSOLE_FIX_TRACK);
    ASSERT_NEAR(fix.position_m.x, radio.fix.x_m, 0.0, "m");
    ASSERT_NEAR(fix.var_y_m2, radio.fix.P.yy, 0.0, "m2");
    ASSERT_AT_LEAST(fix.var_heading_rad2, 9.8, "rad2"); /* any */
    ASSERT_UNCHANGED(radio, insole_fusion_radio_take(&radio, &fix), INSOLE_ERR_STATE);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("fusion_radio");
    suite_add(suite, "waits twice", a_scan_waits_twice);
    suite_add(suite, "place", the_place_by_radio_is_that_of_the_scan);
    suite_add(suite, "strongest", of_many_the_strongest_are_kept);
    suite_add(suite, "strangers", a_scan_of_strangers_says_nothing);
    suite_add(suite, "first", the_first_keeps_its_place_before_the_foot);
    suite_add(suite, "leap", a_leap_of_stamps_is_got_over);
    suite_add(suite, "how long", it_is_known_how_long_it_waits);
    suite_add(suite, "ranges", ranges_are_told_from_where_they_were_measured);
    suite_add(suite, "oldest", the_oldest_ranges_leave);
    suite_add_loop(suite, "bad ranges", bad_ranges_are_passed_over,
                   sizeof bad_ranges / sizeof bad_ranges[0]);
    suite_add(suite, "brief", no_range_is_told_below_zero);
    suite_add(suite, "place by ranges", ranges_give_a_place);
    suite_add(suite, "there then", the_foot_was_there_then);
    suite_add(suite, "at once", at_once_nothing_waits);
    suite_add(suite, "nearest", the_paper_hears_the_nearest_only);
    suite_add(suite, "fix", the_place_goes_into_a_fix);
    suite_add(suite, "mix", two_places_are_mixed_by_their_weights);
    suite_add(suite, "no radio", without_access_points_there_is_no_radio);
    suite_add(suite, "no room for ranges", ranges_need_their_room);
    suite_add(suite, "bad input", bad_input_changes_nothing);
    suite_add(suite, "in vain", no_fix_is_touched_in_vain);
    suite_add_loop(suite, "whatever comes", whatever_comes_it_keeps_its_order, 3);
    suite_add(suite, "copy", a_copy_goes_on_alike);
    suite_add(suite, "forget", what_lies_before_a_gap_is_forgotten);
    suite_add(suite, "take", a_place_by_radio_is_taken_once);
    return suite;
}
