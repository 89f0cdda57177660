/* SPDX-License-Identifier: MIT */
#include "insole/track/foot_tracker.h"

#include "insole/base/fastmath.h"
#include "shoe.h"
#include "suite.h"

static insole_fix_t reference[SHOE_SAMPLES_MAX];

static insole_start_t start_at(double t_s, double x, double y, double sigma_m)
{
    insole_start_t start;
    memset(&start, 0, sizeof start);
    start.t_us = (uint64_t)(t_s * 1e6);
    start.x_m = (insole_real_t)x;
    start.y_m = (insole_real_t)y;
    start.sigma_m = (insole_real_t)sigma_m;
    return start;
}

static void tell(const insole_start_t *start)
{
    ck_assert_int_eq(insole_foot_tracker_start(&shoe, start), INSOLE_OK);
}

/* How far the fixes since `from_s` are from the walk, after the turn and shift that fit best at
 * their begin and the turn by all. */
static worst_t worst_off(const walk_t *walk, double from_s)
{
    const insole_fix_t *first = fix_at(from_s);
    walk_pose_t begin = walk_pose(walk, (double)first->t_us * 1e-6);
    double dot = 0.0, cross = 0.0;
    worst_t worst = {0.0, 0.0};
    for (int pass = 0; pass < 2; pass++) {
        double size = hypot(dot, cross), c = pass ? dot / size : 1.0, s = pass ? cross / size : 0.0;
        for (const insole_fix_t *f = first; f < fixes + fix_count; f++) {
            walk_pose_t pose = walk_pose(walk, (double)f->t_us * 1e-6);
            double x = (double)f->position_m.x - (double)first->position_m.x;
            double y = (double)f->position_m.y - (double)first->position_m.y;
            double z = (double)f->position_m.z - (double)first->position_m.z;
            double X = pose.sensor_m[0] - begin.sensor_m[0];
            double Y = pose.sensor_m[1] - begin.sensor_m[1];
            double Z = pose.sensor_m[2] - begin.sensor_m[2];
            if (pass == 0) {
                dot += x * X + y * Y;
                cross += x * Y - y * X;
            } else {
                worst_note(&worst, hypot(hypot(c * x - s * y - X, s * x + c * y - Y), z - Z),
                           (double)f->t_us * 1e-6);
            }
        }
    }
    return worst;
}

static const struct {
    double rate_hz;
    bool loop;
} walks[] = {{100.0, false}, {100.0, true}, {200.0, false}, {200.0, true}};

/* 1 % of the way is what the source calls good; a walk without faults should do better. */
START_TEST(hundred_metres_are_followed)
{
    walk_t walk = hundred_metres(walks[_i].loop);
    record(&walk, walks[_i].rate_hz, 0.0);
    run_all(&shoe, &insole_foot_tracker_defaults);
    worst_t off = worst_off(&walk, 2.0);
    ASSERT_WORST(off, 0.7, "m");
    ck_assert_uint_eq(shoe.strides.count, LOOP_STRIDES);
    ck_assert_uint_ge(shoe.counts.stances, LOOP_STRIDES + 1u);
    ck_assert_uint_eq(fix_count, sample_count);
    ck_assert_uint_eq(shoe.counts.fixes, sample_count);
    ck_assert_uint_eq(shoe.counts.coasts + shoe.counts.bridged + shoe.counts.refused, 0u);
    ck_assert(!shoe.counts.aligned_moving);
    ck_assert_int_eq(fixes[fix_count - 1u].state, INSOLE_FIX_TRACK);
}
END_TEST

static const double mountings[][4] = {{0.0, 1.0, 0.0, 0.0},  {0.0, 0.0, 1.0, 0.0},
                                      {0.5, 0.5, 0.5, 0.5},  {0.6, 0.0, 0.8, 0.0},
                                      {0.6, 0.0, 0.0, -0.8}, {0.1, -0.7, 0.1, 0.7}};

/* After the turn that fits best: n begins in the direction of the sensor's own x axis. */
static worst_t worst_between(void)
{
    double dot = 0.0, cross = 0.0;
    worst_t worst = {0.0, 0.0};
    for (uint32_t i = 0u; i < fix_count; i++) {
        double x = (double)fixes[i].position_m.x, y = (double)fixes[i].position_m.y;
        double X = (double)reference[i].position_m.x, Y = (double)reference[i].position_m.y;
        dot += x * X + y * Y;
        cross += x * Y - y * X;
    }
    double size = hypot(dot, cross), c = dot / size, s = cross / size;
    for (uint32_t i = 0u; i < fix_count; i++) {
        double x = (double)fixes[i].position_m.x, y = (double)fixes[i].position_m.y;
        double dz = (double)fixes[i].position_m.z - (double)reference[i].position_m.z;
        double dx = c * x - s * y - (double)reference[i].position_m.x;
        double dy = s * x + c * y - (double)reference[i].position_m.y;
        worst_note(&worst, hypot(hypot(dx, dy), dz), i);
    }
    return worst;
}

START_TEST(any_mounting_gives_the_same_way)
{
    walk_t walk = hundred_metres(true);
    const double *m = mountings[_i];
    double size = sqrt(m[0] * m[0] + m[1] * m[1] + m[2] * m[2] + m[3] * m[3]);
    insole_quat_t turn = insole_quat((insole_real_t)(m[0] / size), (insole_real_t)(m[1] / size),
                                     (insole_real_t)(m[2] / size), (insole_real_t)(m[3] / size));
    record(&walk, 100.0, 0.0);
    run_all(&shoe, &insole_foot_tracker_defaults);
    memcpy(reference, fixes, sizeof reference);
    for (uint32_t i = 0u; i < sample_count; i++) {
        samples[i].accel_mps2 = insole_quat_rotate(turn, samples[i].accel_mps2);
        samples[i].gyro_radps = insole_quat_rotate(turn, samples[i].gyro_radps);
    }
    run_all(&shoe, &insole_foot_tracker_defaults);
    worst_t off = worst_between();
    ASSERT_WORST(off, 0.02, "m");
    ck_assert_uint_eq(shoe.strides.count, LOOP_STRIDES);
}
END_TEST

START_TEST(start_with_heading_lays_the_way_on_the_map)
{
    walk_t walk = hundred_metres(false);
    insole_start_t start = start_at(1.0, 20.0, -7.0, 0.3);
    start.has_heading = true;
    start.heading_rad = INSOLE_R(2.0);
    start.sigma_rad = INSOLE_R(0.01);
    record(&walk, 100.0, 0.0);
    set_up(&shoe, &insole_foot_tracker_defaults);
    tell(&start);
    run(&shoe, 0u, sample_count);
    finish(&shoe);
    const insole_fix_t *begin = fix_at(1.0), *end = &fixes[fix_count - 1u];
    ASSERT_NEAR(begin->position_m.x, 20.0, 1e-4, "m");
    ASSERT_NEAR(begin->position_m.y, -7.0, 1e-4, "m");
    ASSERT_NEAR(begin->var_x_m2, 0.09, 1e-5, "m2");
    ASSERT_NEAR(begin->var_heading_rad2, 1e-4, 1e-6, "rad2");
    double x = (double)end->position_m.x - 20.0 - 100.05 * cos(2.0);
    double y = (double)end->position_m.y + 7.0 - 100.05 * sin(2.0);
    ASSERT_AT_MOST(hypot(x, y), 3.0 * sqrt((double)(end->var_x_m2 + end->var_y_m2)), "m");
    ASSERT_NEAR(end->heading_rad, 2.0, 0.05, "rad");
}
END_TEST

START_TEST(start_holds_from_its_time_or_from_when_it_was_told)
{
    walk_t walk = WALK;
    insole_start_t ahead = start_at(8.0, 100.0, 50.0, 0.2), late = start_at(9.0, -3.0, 4.0, 0.1);
    record(&walk, 100.0, 0.0);
    set_up(&shoe, &insole_foot_tracker_defaults);
    tell(&ahead);
    run(&shoe, 0u, 1100u);
    ck_assert(fabs((double)fix_at(7.99)->position_m.x) < 20.0);
    ASSERT_NEAR(fix_at(8.0)->position_m.x, 100.0, 1e-4, "m");
    ASSERT_NEAR(fix_at(8.0)->position_m.y, 50.0, 1e-4, "m");
    ASSERT_NEAR(fix_at(8.0)->var_x_m2, 0.04, 1e-5, "m2");
    tell(&late);
    uint32_t next = fix_count;
    run(&shoe, 1100u, sample_count);
    ck_assert(fabs((double)fixes[next - 1u].position_m.x) > 90.0);
    ASSERT_NEAR(fixes[next].position_m.x, -3.0, 1e-4, "m");
    ASSERT_NEAR(fixes[next].position_m.y, 4.0, 1e-4, "m");
    ASSERT_NEAR(fixes[next].var_y_m2, 0.01, 1e-5, "m2");
}
END_TEST

START_TEST(later_start_replaces_the_earlier)
{
    walk_t walk = WALK;
    insole_start_t first = start_at(6.0, 500.0, 0.0, 0.2), second = start_at(7.0, 30.0, 0.0, 0.2);
    record(&walk, 100.0, 0.0);
    set_up(&shoe, &insole_foot_tracker_defaults);
    tell(&first);
    tell(&second);
    run(&shoe, 0u, sample_count);
    ck_assert(fabs((double)fix_at(6.5)->position_m.x) < 20.0);
    ASSERT_NEAR(fix_at(7.0)->position_m.x, 30.0, 1e-4, "m");
}
END_TEST

START_TEST(log_may_begin_in_motion)
{
    walk_t walk = hundred_metres(false);
    record(&walk, 100.0, 9.6); /* in the seventh swing */
    run_all(&shoe, &insole_foot_tracker_defaults);
    ck_assert(shoe.counts.aligned_moving);
    ck_assert_int_eq(fixes[0].state, INSOLE_FIX_ALIGN);
    ck_assert_int_eq(fix_at(12.0)->state, INSOLE_FIX_TRACK);
    worst_t off = worst_off(&walk, 12.0);
    ASSERT_WORST(off, 1.0, "m");
}
END_TEST

START_TEST(two_seconds_without_samples)
{
    walk_t walk = hundred_metres(false);
    insole_start_t start = start_at(1.0, 0.0, 0.0, 0.1);
    record(&walk, 100.0, 0.0);
    drop_out(30.0, 32.0);
    set_up(&shoe, &insole_foot_tracker_defaults);
    tell(&start);
    run(&shoe, 0u, sample_count);
    finish(&shoe);
    ck_assert_uint_eq(shoe.counts.coasts, 1u);
    ck_assert_uint_eq(shoe.counts.realigned, 1u);
    ck_assert_uint_eq(shoe.counts.bridged, 0u);
    const insole_fix_t *last = fix_at(29.98), *gone = fix_at(32.0);
    ck_assert_int_eq(last->state, INSOLE_FIX_TRACK);
    ck_assert_int_eq(gone->state, INSOLE_FIX_COAST);
    ck_assert_int_eq(fix_at(34.0)->state, INSOLE_FIX_TRACK);
    ASSERT_AT_LEAST(gone->var_x_m2, (double)last->var_x_m2 + 0.5, "m2");
    ASSERT_AT_LEAST(gone->var_y_m2, (double)last->var_y_m2 + 0.5, "m2");
    double x = (double)gone->position_m.x - walk_pose(&walk, 32.0).sensor_m[0];
    ASSERT_AT_MOST(fabs(x), 3.0 * sqrt((double)gone->var_x_m2), "m");
    const insole_fix_t *end = &fixes[fix_count - 1u];
    double dx = (double)end->position_m.x - 100.05, dy = (double)end->position_m.y;
    ASSERT_AT_MOST(fabs(dx), 3.0 * sqrt((double)end->var_x_m2), "m");
    ASSERT_AT_MOST(fabs(dy), 3.0 * sqrt((double)end->var_y_m2), "m");
    worst_t off = worst_off(&walk, 34.0);
    ASSERT_WORST(off, 0.7, "m"); /* the way since is as good as ever */
}
END_TEST

START_TEST(short_gap_is_bridged)
{
    walk_t walk = WALK;
    record(&walk, 100.0, 0.0);
    drop_out(6.7, 6.85);
    run_all(&shoe, &insole_foot_tracker_defaults);
    ck_assert_uint_eq(shoe.counts.bridged, 1u);
    ck_assert_uint_eq(shoe.counts.coasts, 0u);
    worst_t off = worst_off(&walk, 2.0);
    ASSERT_WORST(off, 1.0, "m");
}
END_TEST

START_TEST(what_is_too_uncertain_is_lost)
{
    walk_t walk = WALK;
    insole_foot_tracker_config_t config = insole_foot_tracker_defaults;
    config.lost_sigma_m = INSOLE_R(0.8);
    record(&walk, 100.0, 0.0);
    drop_out(6.7, 8.7);
    run_all(&shoe, &config);
    ck_assert_int_eq(fix_at(6.6)->state, INSOLE_FIX_TRACK);
    ck_assert_int_eq(fix_at(8.8)->state, INSOLE_FIX_LOST);
    for (uint32_t i = 0u; i < fix_count; i++) {
        double sigma = sqrt((double)(fixes[i].var_x_m2 + fixes[i].var_y_m2));
        bool lost = fixes[i].state == INSOLE_FIX_LOST;
        if (fixes[i].state != INSOLE_FIX_ALIGN && fabs(sigma - 0.8) > 1e-5 &&
            lost != (sigma > 0.8)) {
            ck_abort_msg("fix %u: sigma %g m, state %d", i, sigma, (int)fixes[i].state);
        }
    }
}
END_TEST

/* All strides are alike, so that K, learned on the way, makes them as long as they are. */
START_TEST(dead_reckoning_by_strides)
{
    walk_t walk = hundred_metres(false);
    insole_foot_tracker_config_t config = insole_foot_tracker_defaults;
    record(&walk, 100.0, 0.0);
    run_all(&shoe, &config);
    double inertial_m2 = (double)(fixes[fix_count - 1u].var_x_m2 + fixes[fix_count - 1u].var_y_m2);
    config.method = INSOLE_FOOT_PDR;
    run_all(&shoe, &config);
    const insole_fix_t *end = &fixes[fix_count - 1u];
    double way = hypot((double)end->position_m.x, (double)end->position_m.y);
    ASSERT_NEAR(way, 100.05, 1.5, "m");
    ASSERT_AT_LEAST((double)(end->var_x_m2 + end->var_y_m2), inertial_m2 + 1.0, "m2");
    uint32_t moves = 0u;
    for (uint32_t i = 1u; i < fix_count; i++) {
        moves += fixes[i].position_m.x != fixes[i - 1u].position_m.x;
    }
    ck_assert_uint_eq(moves, LOOP_STRIDES); /* from stride to stride, not between */
}
END_TEST

START_TEST(strides_add_up_to_the_way)
{
    walk_t walk = hundred_metres(true);
    insole_stride_t stride;
    double x = 0.0, y = 0.0;
    uint32_t told = 0u;
    record(&walk, 100.0, 0.0);
    set_up(&shoe, &insole_foot_tracker_defaults);
    for (uint32_t i = 0u; i < sample_count; i++) {
        run(&shoe, i, i + 1u);
        if (insole_foot_tracker_stride(&shoe, &stride) == INSOLE_OK) {
            told++;
            x += (double)stride.displacement_m.x;
            y += (double)stride.displacement_m.y;
            ASSERT_NEAR(stride.length_m, 1.45, 0.05, "m");
            ASSERT_NEAR(stride.turn_rad, walk.turn_rad, 0.02, "rad");
            ck_assert_int_eq(insole_foot_tracker_stride(&shoe, &stride), INSOLE_ERR_STATE);
        }
    }
    ck_assert_uint_eq(told, LOOP_STRIDES);
    ASSERT_NEAR(x, fixes[fix_count - 1u].position_m.x, 0.02, "m");
    ASSERT_NEAR(y, fixes[fix_count - 1u].position_m.y, 0.02, "m");
}
END_TEST

/* ---- stances ---- */

static const struct {
    double every_s;
    int samples; /* at 200 Hz */
} measurings[] = {{0.0, 1}, {0.005, 1}, {0.02, 4}, {0.0218, 4}, {0.05, 10}};

/* A stance's velocity is measured with its first sample, then as often as was asked for, and each
 * time as surely as the time since the last is long. */
START_TEST(stances_are_measured_from_time_to_time)
{
    insole_foot_tracker_config_t config = insole_foot_tracker_defaults;
    walk_t walk = WALK;
    const double sigma = (double)config.zupt_ekf.sigma_zupt_mps;
    int since = 0, measured = 0;
    insole_foot_counts_t before = {0};
    worst_t due = {0.0, 0.0}, sure = {0.0, 0.0};
    config.correct_every_s = (insole_real_t)measurings[_i].every_s;
    record(&walk, 200.0, 0.0);
    set_up(&shoe, &config);
    for (uint32_t i = 0u; i < sample_count; i++) {
        (void)insole_foot_tracker_imu(&shoe, &samples[i]);
        while (insole_foot_tracker_next(&shoe, &fixes[0]) == INSOLE_OK) {
            insole_foot_counts_t now = shoe.counts;
            bool is_still = now.still > before.still, begins = now.stances > before.stances;
            bool corrected = now.corrections > before.corrections;
            since = begins ? 1 : since + 1;
            if (measured > 0 || corrected) {
                bool wanted = is_still && (begins || since == measurings[_i].samples);
                worst_require(&due, corrected == wanted || measured == 0, i);
            }
            if (corrected) {
                double variance = (double)shoe.zupt_ekf.trace.velocity_var_m2ps2;
                double speaks_for = begins ? 1.0 : (double)measurings[_i].samples;
                double off = variance * speaks_for / (sigma * sigma) - 1.0;
                worst_note(&sure, measured > 0 ? fabs(off) : 0.0, i);
                since = 0;
                measured++;
            }
            before = now;
        }
    }
    ASSERT_ALL_HELD(due);
    ASSERT_WORST(sure, 1.0e-5, "(of the variance)");
    ck_assert_int_gt(measured, 50);
    ck_assert_uint_eq(shoe.zupt_ekf.refused, 0u);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("foot_tracker");
    suite_add_loop(suite, "100 m", hundred_metres_are_followed, 4);
    suite_add_loop(suite, "any mounting", any_mounting_gives_the_same_way, 6);
    suite_add(suite, "start with heading", start_with_heading_lays_the_way_on_the_map);
    suite_add(suite, "start ahead, late", start_holds_from_its_time_or_from_when_it_was_told);
    suite_add(suite, "start told twice", later_start_replaces_the_earlier);
    suite_add(suite, "begins in motion", log_may_begin_in_motion);
    suite_add(suite, "two seconds without samples", two_seconds_without_samples);
    suite_add(suite, "short gap", short_gap_is_bridged);
    suite_add(suite, "lost", what_is_too_uncertain_is_lost);
    suite_add(suite, "pdr", dead_reckoning_by_strides);
    suite_add(suite, "strides", strides_add_up_to_the_way);
    suite_add_loop(suite, "stances", stances_are_measured_from_time_to_time, 5);
    return suite;
}
