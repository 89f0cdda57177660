/* SPDX-License-Identifier: MIT
 * A log through tracker and smoother: what goes in comes out, in order, on the map, and better. */
#include "insole/track/foot_smooth.h"

#include <string.h>

#include "foot_filter.h"
#include "near.h"
#include "sample.h"
#include "suite.h"

enum { RATE_HZ = 200, LOG = 16 * RATE_HZ, ROOM = 4096 };

static const uint64_t ZERO_US = 50000000u;
static insole_imu_t readings[LOG];
static insole_zupt_node_t nodes[ROOM];
static insole_foot_past_t pasts[ROOM];
static insole_fix_t tracked[LOG], smoothed[LOG];
static insole_vec3_t late_m2[LOG]; /* what a fix's variances lack of the filter's */
static int tracked_count, smoothed_count;

/* A straight walk with the noise of a good sensor. */
static gait_t straight_gait(void)
{
    gait_t gait = gait_usual();
    gait.turn_rad = 0.0;
    return gait;
}

static double time_of(int k)
{
    return (double)(k + 1) / RATE_HZ;
}

static void fill_readings(void)
{
    gait_t gait = straight_gait();
    insole_rng_t rng;
    insole_rng_seed(&rng, 1u);
    for (int k = 0; k < LOG; k++) {
        d3_t force, rate;
        gait_reading(&gait, time_of(k - 1), time_of(k), &force, &rate);
        readings[k].t_us = ZERO_US + (uint64_t)(k + 1) * (1000000u / RATE_HZ);
        readings[k].accel_mps2 = insole_vec3_add(real_of(force), sample_vec3(&rng, INSOLE_R(0.4)));
        readings[k].gyro_radps = insole_vec3_add(real_of(rate), sample_vec3(&rng, INSOLE_R(0.01)));
    }
}

typedef struct {
    insole_foot_tracker_t shoe;
    insole_foot_smooth_t past;
    uint32_t keep;
} replay_t;

static void take_smoothed(replay_t *r)
{
    while (insole_foot_smooth_take(&r->past, &smoothed[smoothed_count]) == INSOLE_OK) {
        smoothed_count++;
    }
}

static insole_vec3_t lateness(const insole_zupt_ekf_t *ekf)
{
    insole_sym3_t now = filter_cov(ekf).pp, told = ekf->P.pp;
    return insole_vec3(now.xx - told.xx, now.yy - told.yy, now.zz - told.zz);
}

static void take_fixes(replay_t *r)
{
    insole_fix_t fix;
    while (insole_foot_tracker_next(&r->shoe, &fix) == INSOLE_OK) {
        late_m2[tracked_count] = lateness(&r->shoe.zupt_ekf);
        tracked[tracked_count++] = fix;
        if (insole_foot_smooth_push(&r->past, &r->shoe, &fix) == INSOLE_ERR_ROOM) {
            ck_assert_int_eq(insole_foot_smooth_run(&r->past, r->keep), INSOLE_OK);
            take_smoothed(r);
            ck_assert_int_eq(insole_foot_smooth_push(&r->past, &r->shoe, &fix), INSOLE_OK);
        }
    }
}

static void begin(replay_t *r, const insole_foot_tracker_config_t *config, uint32_t room)
{
    tracked_count = smoothed_count = 0;
    r->keep = room / 2u;
    ck_assert_int_eq(insole_foot_tracker_init(&r->shoe, config), INSOLE_OK);
    ck_assert_int_eq(insole_foot_smooth_init(&r->past, nodes, pasts, room), INSOLE_OK);
}

/* The log, but for `missing` readings from number `from` on. */
static void replay(replay_t *r, int from, int missing)
{
    for (int k = 0; k < LOG; k++) {
        if (k < from || k >= from + missing) {
            (void)insole_foot_tracker_imu(&r->shoe, &readings[k]);
            take_fixes(r);
        }
    }
    (void)insole_foot_tracker_finish(&r->shoe);
    take_fixes(r);
    ck_assert_int_eq(insole_foot_smooth_run(&r->past, 0u), INSOLE_OK);
    take_smoothed(r);
}

static insole_start_t start_at(double x, double y, double heading)
{
    insole_start_t start;
    memset(&start, 0, sizeof start);
    start.t_us = ZERO_US;
    start.x_m = (insole_real_t)x;
    start.y_m = (insole_real_t)y;
    start.has_heading = true;
    start.heading_rad = (insole_real_t)heading;
    start.sigma_m = INSOLE_R(0.1);
    start.sigma_rad = INSOLE_R(0.05);
    return start;
}

/* ---- in and out ------------------------------------------------------------------------- */

START_TEST(gives_every_fix_once_and_in_order)
{
    static const uint32_t room[4] = {2u, 64u, 1024u, ROOM};
    replay_t r;
    fill_readings();
    begin(&r, &insole_foot_tracker_defaults, room[_i]);
    replay(&r, 0, 0);
    ck_assert_int_eq(tracked_count, LOG);
    ck_assert_int_eq(smoothed_count, LOG);
    worst_t same = {0.0, 0.0}, less = {0.0, 0.0};
    for (int k = 0; k < LOG; k++) {
        const insole_fix_t *a = &tracked[k], *b = &smoothed[k];
        worst_require(&same, a->t_us == b->t_us && a->state == b->state, k);
        worst_require(&same, a->var_heading_rad2 == b->var_heading_rad2, k);
        worst_require(&same, a->heading_rad == b->heading_rad, k);
        insole_vec3_t late = late_m2[k];
        worst_require(&less, b->var_x_m2 <= (a->var_x_m2 + late.x) * INSOLE_R(1.0001), k);
        worst_require(&less, b->var_y_m2 <= (a->var_y_m2 + late.y) * INSOLE_R(1.0001), k);
        worst_require(&less, b->var_z_m2 <= (a->var_z_m2 + late.z) * INSOLE_R(1.0001), k);
    }
    ASSERT_ALL_HELD(same);
    ASSERT_ALL_HELD(less);
    ck_assert_uint_eq(r.past.history.refused, 0u);
}
END_TEST

/* ---- on the map ------------------------------------------------------------------------- */

static d3_t error_of(const insole_fix_t *fix, double x, double y, double heading)
{
    gait_t gait = straight_gait();
    moment_t m = gait_pose(&gait, 1.0e-6 * (double)(fix->t_us - ZERO_US));
    d3_t on_map = d33_apply(turn_z(heading), m.p);
    d3_t truth = d3_add(on_map, 1.0, d3(x, y, 0.0));
    return d3_add(d3_of(fix->position_m), -1.0, truth);
}

static double off_truth(const insole_fix_t *fix, double x, double y, double heading)
{
    return d3_norm(error_of(fix, x, y, heading));
}

static bool is_swing(int k)
{
    gait_t gait = straight_gait();
    double number, phase = gait_phase(&gait, time_of(k), &number);
    return phase > 0.3 && phase < 0.9 && time_of(k) < 15.0;
}

/* Errors that have come up since the stance before. */
START_TEST(brings_the_swing_nearer_to_the_truth)
{
    const double x = 12.0, y = -7.0, heading = 2.5;
    insole_start_t start = start_at(x, y, heading);
    replay_t r;
    double before = 0.0, after = 0.0;
    int stance = 0;
    fill_readings();
    begin(&r, &insole_foot_tracker_defaults, ROOM);
    ck_assert_int_eq(insole_foot_tracker_start(&r.shoe, &start), INSOLE_OK);
    replay(&r, 0, 0);
    for (int k = 5 * RATE_HZ; k < LOG; k++) {
        stance = is_swing(k) ? stance : k;
        d3_t was = error_of(&tracked[k], x, y, heading), is = error_of(&smoothed[k], x, y, heading);
        was = d3_add(was, -1.0, error_of(&tracked[stance], x, y, heading));
        is = d3_add(is, -1.0, error_of(&smoothed[stance], x, y, heading));
        before += d3_dot(was, was);
        after += d3_dot(is, is);
        ASSERT_AT_MOST(off_truth(&smoothed[k], x, y, heading), 0.3, "m");
    }
    ASSERT_AT_LEAST(before, 0.01, "m^2: there was something to do");
    ASSERT_AT_MOST(sqrt(after / before), 0.7, "of the tracker's error");
}
END_TEST

/* The tracker learns only by the second stride how its frame lies on the map; the smoother knows.
 */
START_TEST(sets_out_in_the_right_direction)
{
    const double heading = -2.0;
    insole_start_t start = start_at(3.0, 4.0, heading);
    replay_t r;
    worst_t tracker = {0.0, 0.0}, smoother = {0.0, 0.0}, forth = {0.0, 0.0};
    fill_readings();
    begin(&r, &insole_foot_tracker_defaults, ROOM);
    ck_assert_int_eq(insole_foot_tracker_start(&r.shoe, &start), INSOLE_OK);
    replay(&r, 0, 0);
    for (int k = 0; k < 3 * RATE_HZ; k++) {
        worst_note(&tracker, off_truth(&tracked[k], 3.0, 4.0, heading), k);
        worst_note(&smoother, off_truth(&smoothed[k], 3.0, 4.0, heading), k);
    }
    for (int k = 3 * RATE_HZ; k < 4 * RATE_HZ; k++) { /* of the first stride */
        double turned = remainder((double)smoothed[k].heading_rad - heading, 6.283185307179586);
        worst_note(&forth, fabs(turned), k);
    }
    ASSERT_AT_LEAST(tracker.off, 0.2, "m: else there is nothing to show");
    ASSERT_WORST(smoother, 0.05, "m");
    ASSERT_WORST(forth, 0.1, "rad");
    ASSERT_NEAR(smoothed[0].position_m.x, 3.0, 1.0e-5, "m");
    ASSERT_NEAR(smoothed[0].position_m.y, 4.0, 1.0e-5, "m");
}
END_TEST

/* A second start in the middle: each fix counts from the start that it knew. */
START_TEST(keeps_starts_apart)
{
    enum { MIDDLE = 9 * RATE_HZ };
    insole_start_t first = start_at(0.0, 0.0, 0.0), second = start_at(100.0, 0.0, 1.5);
    replay_t r;
    fill_readings();
    begin(&r, &insole_foot_tracker_defaults, ROOM);
    second.t_us = readings[MIDDLE].t_us;
    ck_assert_int_eq(insole_foot_tracker_start(&r.shoe, &first), INSOLE_OK);
    for (int k = 0; k < LOG; k++) {
        if (k == 3 * RATE_HZ) {
            ck_assert_int_eq(insole_foot_tracker_start(&r.shoe, &second), INSOLE_OK);
        }
        (void)insole_foot_tracker_imu(&r.shoe, &readings[k]);
        take_fixes(&r);
    }
    ck_assert_int_eq(insole_foot_smooth_run(&r.past, 0u), INSOLE_OK);
    take_smoothed(&r);
    ck_assert_int_gt(smoothed_count, MIDDLE + 10);
    ASSERT_AT_MOST(off_truth(&smoothed[MIDDLE - 1], 0.0, 0.0, 0.0), 0.1, "m");
    ASSERT_NEAR(smoothed[MIDDLE].position_m.x, 100.0, 1.0e-4, "m");
    ASSERT_NEAR(smoothed[MIDDLE].position_m.y, 0.0, 1.0e-4, "m");
    ASSERT_NEAR(smoothed[MIDDLE].var_x_m2, 0.01, 1.0e-6, "m^2");
}
END_TEST

/* ---- what it leaves alone --------------------------------------------------------------- */

START_TEST(leaves_what_no_filter_has_made)
{
    insole_foot_tracker_config_t config = insole_foot_tracker_defaults;
    replay_t r;
    config.method = INSOLE_FOOT_PDR;
    fill_readings();
    begin(&r, &config, 1024u);
    replay(&r, 0, 0);
    ck_assert_int_eq(smoothed_count, LOG);
    ck_assert_uint_eq(insole_ring_count(&r.past.history.ring), 0u);
    ck_assert(memcmp(tracked, smoothed, sizeof tracked) == 0);

    config.method = INSOLE_FOOT_INS;
    begin(&r, &config, 1024u);
    replay(&r, 0, 0);
    int aligned = 0;
    while (tracked[aligned].state == INSOLE_FIX_ALIGN) {
        aligned++;
    }
    ck_assert_int_gt(aligned, 0);
    ck_assert(memcmp(tracked, smoothed, (size_t)aligned * sizeof *tracked) == 0);
}
END_TEST

/* Half a second in a swing is missing: carried over by the walk, smoothed on either side. */
START_TEST(crosses_a_gap)
{
    enum { FROM = 8 * RATE_HZ + 20, MISSING = RATE_HZ / 2 };
    replay_t r;
    worst_t far = {0.0, 0.0}, coasting = {0.0, 0.0};
    int coasts = 0;
    fill_readings();
    begin(&r, &insole_foot_tracker_defaults, 1024u);
    replay(&r, FROM, MISSING);
    ck_assert_int_eq(smoothed_count, LOG - MISSING);
    ck_assert_uint_eq(r.shoe.counts.coasts, 1u);
    for (int k = 0; k < smoothed_count; k++) {
        d3_t apart = d3_add(d3_of(tracked[k].position_m), -1.0, d3_of(smoothed[k].position_m));
        bool is_coast = tracked[k].state == INSOLE_FIX_COAST;
        coasts += is_coast ? 1 : 0;
        worst_note(&far, d3_norm(apart), k);
        worst_note(&coasting, is_coast ? d3_norm(apart) : 0.0, k);
        ck_assert(smoothed[k].t_us == tracked[k].t_us);
    }
    ck_assert_int_gt(coasts, 5);
    ASSERT_WORST(far, 0.15, "m");
    ASSERT_WORST(coasting, 1.0e-5, "m");
}
END_TEST

/* ---- refusals --------------------------------------------------------------------------- */

START_TEST(refuses_and_stays_as_it_was)
{
    static insole_foot_tracker_t shoe;
    insole_foot_smooth_t past, before;
    insole_fix_t fix;
    memset(&fix, 0, sizeof fix);
    memset(&past, 0x33, sizeof past);
    memcpy(&before, &past, sizeof past);
    ck_assert_int_eq(insole_foot_tracker_init(&shoe, &insole_foot_tracker_defaults), INSOLE_OK);
    ck_assert_int_eq(insole_foot_smooth_init(NULL, nodes, pasts, 2u), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_foot_smooth_init(&past, NULL, pasts, 2u), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_foot_smooth_init(&past, nodes, NULL, 2u), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_foot_smooth_init(&past, nodes, pasts, 0u), INSOLE_ERR_VALUE);
    ck_assert_int_eq(insole_foot_smooth_init(&past, nodes, pasts, 3u), INSOLE_ERR_VALUE);
    ck_assert(memcmp(&past, &before, sizeof past) == 0);

    ck_assert_int_eq(insole_foot_smooth_init(&past, nodes, pasts, 2u), INSOLE_OK);
    ck_assert_int_eq(insole_foot_smooth_push(&past, &shoe, &fix), INSOLE_OK);
    ck_assert_int_eq(insole_foot_smooth_push(&past, &shoe, &fix), INSOLE_OK);
    memcpy(&before, &past, sizeof past);
    ck_assert_int_eq(insole_foot_smooth_push(&past, &shoe, &fix), INSOLE_ERR_ROOM);
    ck_assert_int_eq(insole_foot_smooth_take(&past, &fix), INSOLE_ERR_STATE);
    ck_assert_int_eq(insole_foot_smooth_push(NULL, &shoe, &fix), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_foot_smooth_push(&past, NULL, &fix), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_foot_smooth_push(&past, &shoe, NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_foot_smooth_run(NULL, 0u), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_foot_smooth_take(NULL, &fix), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_foot_smooth_take(&past, NULL), INSOLE_ERR_NULL);
    ck_assert(memcmp(&past, &before, sizeof past) == 0);

    ck_assert_int_eq(insole_foot_smooth_run(&past, 1u), INSOLE_OK);
    ck_assert_int_eq(insole_foot_smooth_take(&past, &fix), INSOLE_OK);
    ck_assert_int_eq(insole_foot_smooth_take(&past, &fix), INSOLE_ERR_STATE);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("foot_smooth");
    suite_add_loop(suite, "in and out", gives_every_fix_once_and_in_order, 4);
    suite_add(suite, "errors of the swing", brings_the_swing_nearer_to_the_truth);
    suite_add(suite, "direction of a start", sets_out_in_the_right_direction);
    suite_add(suite, "two starts", keeps_starts_apart);
    suite_add(suite, "left alone", leaves_what_no_filter_has_made);
    suite_add(suite, "a gap", crosses_a_gap);
    suite_add(suite, "refusals", refuses_and_stays_as_it_was);
    return suite;
}
