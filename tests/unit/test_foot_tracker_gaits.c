/* SPDX-License-Identifier: MIT */
#include "sample.h"
#include "shoe.h"
#include "suite.h"

#define PI 3.14159265358979323846

static insole_fix_t reference[SHOE_SAMPLES_MAX];

static walk_t silent(const walk_t *gait, int strides, double turn_rad)
{
    walk_t walk = *gait;
    walk.strides = strides;
    walk.turn_rad = turn_rad;
    walk.accel_noise_mps2 = walk.gyro_noise_radps = 0.0;
    return walk;
}

static const insole_fix_t *last_fix(void)
{
    return &fixes[fix_count - 1u];
}

/* Where the sensor has truly gone since the beginning. */
static void way_to(const walk_t *walk, double t_s, double way_m[3])
{
    walk_pose_t begin = walk_pose(walk, 0.0), now = walk_pose(walk, t_s);
    for (int i = 0; i < 3; i++) {
        way_m[i] = now.sensor_m[i] - begin.sensor_m[i];
    }
}

/* ---- a perfect sensor ------------------------------------------------------------------- */

/* Nothing is wrong but the sampling: every fix of a straight way, those in mid-swing too. */
START_TEST(sampling_alone_costs_millimetres)
{
    static const double RATES_HZ[] = {100.0, 128.0, 200.0, 250.0, 400.0, 820.0};
    walk_t walk = silent(&WALK, _i < 3 ? LOOP_STRIDES : 14, 0.0);
    record(&walk, RATES_HZ[_i], 0.0);
    run_all(&shoe, &insole_foot_tracker_defaults);
    worst_t level = {0.0, 0.0}, height = {0.0, 0.0};
    for (uint32_t i = 0u; i < fix_count; i++) {
        double t = (double)fixes[i].t_us * 1e-6, way[3];
        way_to(&walk, t, way);
        worst_note(
            &level,
            hypot((double)fixes[i].position_m.x - way[0], (double)fixes[i].position_m.y - way[1]),
            t);
        worst_note(&height, fabs((double)fixes[i].position_m.z - way[2]), t);
    }
    ASSERT_WORST(level, 0.02, "m");
    ASSERT_WORST(height, 0.02, "m");
}
END_TEST

/* A run has no still stance: what the foot rolls on is known to half a per cent. */
START_TEST(every_gait_at_every_rate)
{
    static const double RATES_HZ[] = {60.0, 100.0, 200.0};
    static const double SHARE[] = {0.0005, 0.005, 0.0005};
    const walk_t *gaits[] = {&WALK, &RUN, &STAIRS};
    walk_t walk = silent(gaits[_i / 3], 20, 0.1);
    double end[3], off = SHARE[_i / 3] * 20.0 * walk.length_m + 0.005;
    record(&walk, RATES_HZ[_i % 3], 0.0);
    run_all(&shoe, &insole_foot_tracker_defaults);
    way_to(&walk, walk_end_s(&walk), end);
    ASSERT_NEAR(last_fix()->position_m.x, end[0], off, "m");
    ASSERT_NEAR(last_fix()->position_m.y, end[1], off, "m");
    ASSERT_NEAR(last_fix()->position_m.z, end[2], 0.01, "m");
    ck_assert_uint_le(shoe.strides.count, 20u);
    ck_assert_uint_ge(shoe.strides.count, _i / 3 == 1 ? 17u : 20u); /* a run comes as a surprise */
}
END_TEST

/* Straight up and straight down the sensor's own x axis has no heading. */
START_TEST(an_upright_x_axis_is_a_mounting_like_any_other)
{
    walk_t walk = silent(&WALK, 20, 0.15);
    record(&walk, 100.0, 0.0);
    drop_out(12.0, 13.0);
    run_all(&shoe, &insole_foot_tracker_defaults);
    memcpy(reference, fixes, sizeof reference);
    const double half = sqrt(0.5);
    walk.mounting[0] = half;
    walk.mounting[2] = _i == 0 ? half : -half;
    record(&walk, 100.0, 0.0);
    drop_out(12.0, 13.0);
    run_all(&shoe, &insole_foot_tracker_defaults);
    double x = (double)last_fix()->position_m.x, y = (double)last_fix()->position_m.y;
    double X = (double)reference[fix_count - 1u].position_m.x;
    double Y = (double)reference[fix_count - 1u].position_m.y;
    double turn = atan2(Y, X) - atan2(y, x);
    worst_t off = {0.0, 0.0};
    for (uint32_t i = 0u; i < fix_count; i++) {
        x = (double)fixes[i].position_m.x;
        y = (double)fixes[i].position_m.y;
        worst_note(&off,
                   hypot(cos(turn) * x - sin(turn) * y - (double)reference[i].position_m.x,
                         sin(turn) * x + cos(turn) * y - (double)reference[i].position_m.y),
                   i);
    }
    ASSERT_WORST(off, 0.02, "m");
}
END_TEST

/* Switched on at any moment of a stride: the first stance aligns, and says so. */
START_TEST(a_log_may_begin_at_any_moment_of_a_stride)
{
    walk_t walk = silent(&WALK, 40, 0.0);
    record(&walk, 200.0, walk.rest_s + 0.1 + 0.13 * _i);
    run_all(&shoe, &insole_foot_tracker_defaults);
    ck_assert(shoe.counts.aligned_moving);
    ck_assert_int_eq(fixes[0].state, INSOLE_FIX_ALIGN);
    const insole_fix_t *from = fix_at(6.0);
    walk_pose_t a = walk_pose(&walk, (double)from->t_us * 1e-6);
    walk_pose_t b = walk_pose(&walk, walk_end_s(&walk));
    double way = hypot((double)(last_fix()->position_m.x - from->position_m.x),
                       (double)(last_fix()->position_m.y - from->position_m.y));
    ASSERT_NEAR(way, b.sensor_m[0] - a.sensor_m[0], 0.3, "m");
}
END_TEST

/* ---- an ordinary sensor ----------------------------------------------------------------- */

/* The error stays within what the covariance says, and that is not much too careful. */
START_TEST(covariances_are_honest)
{
    enum { SEEDS = 24 };
    double nees = 0.0, off = 0.0;
    for (uint64_t seed = 0u; seed < SEEDS; seed++) {
        walk_t walk = WALK;
        insole_rng_t rng;
        insole_rng_seed(&rng, seed + 500u);
        walk.strides = 30;
        for (int i = 0; i < 3; i++) {
            walk.gyro_bias_radps[i] = 0.01 * (double)insole_rng_normal(&rng);
            walk.accel_bias_mps2[i] = 0.03 * (double)insole_rng_normal(&rng);
        }
        noise_seed = seed;
        record(&walk, 100.0, 0.0);
        run_all(&shoe, &insole_foot_tracker_defaults);
        const insole_fix_t *f = last_fix();
        double end[3];
        way_to(&walk, walk_end_s(&walk), end);
        double x = (double)f->position_m.x - end[0], y = (double)f->position_m.y - end[1];
        double vx = (double)f->var_x_m2, vy = (double)f->var_y_m2, c = (double)f->cov_xy_m2;
        nees += (vy * x * x - 2.0 * c * x * y + vx * y * y) / (vx * vy - c * c) / SEEDS;
        off += (x * x + y * y) / SEEDS;
    }
    ASSERT_AT_MOST(sqrt(off), 0.25, "m");
    ASSERT_AT_MOST(nees, 2.0, "(two degrees of freedom)");
    ASSERT_AT_LEAST(nees, 0.02, "(two degrees of freedom)");
}
END_TEST

/* A tilted accelerometer would lift the walker off a level floor, slowly. */
START_TEST(a_level_floor_stays_level)
{
    walk_t walk = WALK;
    walk.strides = 60;
    walk.accel_bias_mps2[2] = 0.05;
    record(&walk, 100.0, 0.0);
    run_all(&shoe, &insole_foot_tracker_defaults);
    ASSERT_NEAR(last_fix()->position_m.z, 0.0, 0.03, "m");
    ASSERT_AT_MOST(last_fix()->var_z_m2, 0.1, "m^2");
}
END_TEST

/* ---- gaps ------------------------------------------------------------------------------- */

/* A walk that starts in the origin, its first two strides along x, without some of its samples. */
static void lose(const walk_t *walk, double from_s, double to_s, int method)
{
    insole_foot_tracker_config_t config = insole_foot_tracker_defaults;
    insole_start_t start = {
        0u, INSOLE_R(0.0), INSOLE_R(0.0), true, INSOLE_R(0.0), INSOLE_R(0.3), INSOLE_R(0.09)};
    config.method = method;
    start.heading_rad = (insole_real_t)walk->turn_rad;
    record(walk, 100.0, 0.0);
    drop_out(from_s, to_s);
    set_up(&shoe, &config);
    ck_assert_int_eq(insole_foot_tracker_start(&shoe, &start), INSOLE_OK);
    run(&shoe, 0u, sample_count);
    finish(&shoe);
}

/* Three of its own sigmas hold the truth: place, and direction of the last stride. */
static void assert_within_sigmas(const walk_t *walk, double t_s)
{
    const insole_fix_t *f = fix_at(t_s);
    double t = (double)f->t_us * 1e-6, way[3];
    way_to(walk, t, way);
    ASSERT_NEAR(f->position_m.x, way[0], 3.0 * sqrt((double)f->var_x_m2), "m");
    ASSERT_NEAR(f->position_m.y, way[1], 3.0 * sqrt((double)f->var_y_m2), "m");
    double heading = walk_pose(walk, t).yaw_rad - 0.5 * walk->turn_rad;
    ASSERT_NEAR(remainder((double)f->heading_rad - heading, 2.0 * PI), 0.0,
                3.0 * sqrt((double)f->var_heading_rad2), "rad");
}

/* Coasting begins with the first sample after the gap and ends with the next stance. */
static void assert_coasts_only_after(double to_s)
{
    worst_t wrong = {0.0, 0.0};
    const insole_fix_t *resumed = fix_at(to_s);
    for (const insole_fix_t *f = fixes; f < fixes + fix_count; f++) {
        bool coasts = f->state == INSOLE_FIX_COAST;
        bool late = f->t_us > resumed->t_us + 2200000u;
        worst_require(&wrong, coasts ? f >= resumed && !late : f != resumed,
                      (double)f->t_us * 1e-6);
    }
    ASSERT_ALL_HELD(wrong);
}

/* Straight on and in bows, from any moment of a stride, by both methods. */
START_TEST(two_seconds_are_coasted_over)
{
    static const double TURNS_RAD[] = {0.0, 0.15, -0.3};
    walk_t walk = silent(&WALK, 20, TURNS_RAD[_i % 3]);
    double from_s = 10.3 + 0.13 * (_i % 8), after_s = from_s + 4.3;
    lose(&walk, from_s, from_s + 2.0, _i % 2);
    ck_assert_uint_eq(shoe.counts.coasts, 1u);
    ck_assert_uint_eq(shoe.counts.realigned, 1u);
    ck_assert_uint_eq(shoe.counts.bridged, 0u);
    ck_assert_uint_eq(shoe.screen.counts.gaps, 1u);
    assert_coasts_only_after(from_s + 2.0);
    const insole_fix_t *before = fix_at(from_s - 0.1), *after = fix_at(after_s);
    ASSERT_AT_LEAST(after->var_x_m2, (double)before->var_x_m2 + 1.5, "m^2");
    ASSERT_AT_LEAST(after->var_heading_rad2, (double)before->var_heading_rad2 + 0.5, "rad^2");
    assert_within_sigmas(&walk, after_s);
    assert_within_sigmas(&walk, walk_end_s(&walk));
}
END_TEST

/* Straight on nothing is lost but time: the walk went on as it went. */
START_TEST(a_straight_walk_goes_on_straight)
{
    walk_t walk = silent(&WALK, 20, 0.0);
    double end[3], from_s = 10.2 + 0.21 * _i;
    lose(&walk, from_s, from_s + 2.0, INSOLE_FOOT_INS);
    way_to(&walk, walk_end_s(&walk), end);
    ASSERT_NEAR(last_fix()->position_m.x, end[0], 1.0, "m");
    ASSERT_NEAR(last_fix()->position_m.y, end[1], 0.5, "m");
}
END_TEST

START_TEST(tenths_of_a_second_are_bridged)
{
    walk_t walk = silent(&WALK, 20, 0.1);
    double from_s = 10.0 + 0.105 * (_i % 10), to_s = from_s + (_i < 10 ? 0.12 : 0.2);
    lose(&walk, from_s, to_s, INSOLE_FOOT_INS);
    ck_assert_uint_eq(shoe.counts.bridged, 1u);
    ck_assert_uint_eq(shoe.counts.coasts, 0u);
    assert_within_sigmas(&walk, from_s + 2.5);
    assert_within_sigmas(&walk, walk_end_s(&walk));
    double end[3];
    way_to(&walk, walk_end_s(&walk), end);
    ASSERT_AT_MOST(
        hypot((double)last_fix()->position_m.x - end[0], (double)last_fix()->position_m.y - end[1]),
        3.0, "m");
}
END_TEST

/* Someone stands while samples are lost: nobody has walked off. */
START_TEST(who_stands_stays)
{
    walk_t walk = silent(&WALK, 10, 0.0);
    walk.rest_s = 12.0;
    double end[3], end_s = walk_end_s(&walk);
    way_to(&walk, end_s, end);
    lose(&walk, end_s - 9.0, end_s - 4.0, _i);
    ASSERT_NEAR(last_fix()->position_m.x, end[0], _i == INSOLE_FOOT_INS ? 0.05 : 0.5, "m");
    ck_assert_uint_eq(shoe.strides.count, 10u);
    ck_assert_int_eq(last_fix()->state, INSOLE_FIX_TRACK);
}
END_TEST

/* Lost is lost until somebody tells where the walker is. */
START_TEST(a_lost_track_is_found_by_a_start)
{
    insole_foot_tracker_config_t config = insole_foot_tracker_defaults;
    config.lost_sigma_m = INSOLE_R(2.0);
    walk_t walk = silent(&WALK, 30, 0.0);
    insole_start_t again = {25000000u,     INSOLE_R(20.0), INSOLE_R(0.0), true,
                            INSOLE_R(0.0), INSOLE_R(0.3),  INSOLE_R(0.09)};
    record(&walk, 100.0, 0.0);
    drop_out(10.0, 16.0);
    set_up(&shoe, &config);
    run(&shoe, 0u, 1800u);
    ck_assert_int_eq(insole_foot_tracker_start(&shoe, &again), INSOLE_OK);
    run(&shoe, 1800u, sample_count);
    finish(&shoe);
    ck_assert_int_eq(fix_at(9.9)->state, INSOLE_FIX_TRACK);
    ck_assert_int_eq(fix_at(20.0)->state, INSOLE_FIX_LOST);
    ck_assert_int_eq(fix_at(24.99)->state, INSOLE_FIX_LOST);
    ck_assert_int_eq(fix_at(25.0)->state, INSOLE_FIX_TRACK);
    ck_assert_int_eq(last_fix()->state, INSOLE_FIX_TRACK);
}
END_TEST

/* ---- cuts ------------------------------------------------------------------------------- */

/* What was told half a second ago does not change, at any rate, in any gait, cut anywhere. */
START_TEST(a_cut_log_tells_the_same)
{
    static const double RATES_HZ[] = {60.0, 61.0, 100.0, 128.0, 200.0, 400.0};
    const walk_t *gaits[] = {&WALK, &RUN, &CRAWL};
    walk_t walk = silent(gaits[_i / 6], 4, 0.0);
    insole_rng_t cuts;
    insole_rng_seed(&cuts, (uint64_t)_i);
    record(&walk, RATES_HZ[_i % 6], 0.0);
    run_all(&shoe, &insole_foot_tracker_defaults);
    memcpy(reference, fixes, sizeof reference);
    worst_t differs = {0.0, 0.0};
    for (int cut = 0; cut < 5; cut++) {
        uint32_t end = 1u + insole_rng_bits(&cuts) % (sample_count - 1u);
        set_up(&shoe, &insole_foot_tracker_defaults);
        run(&shoe, 0u, end);
        finish(&shoe);
        for (uint32_t i = 0u; i < fix_count; i++) {
            bool open = fixes[i].t_us + 500000u > samples[end - 1u].t_us;
            worst_require(&differs, open || is_same_fix(&fixes[i], &reference[i]), i);
        }
    }
    ASSERT_ALL_HELD(differs);
}
END_TEST

START_TEST(a_log_of_a_few_samples_ends_well)
{
    walk_t walk = silent(&WALK, 1, 0.0);
    record(&walk, 100.0, 0.0);
    for (uint32_t count = 1u; count < 60u; count++) {
        set_up(&shoe, &insole_foot_tracker_defaults);
        run(&shoe, 0u, count);
        finish(&shoe);
        ck_assert_uint_eq(fix_count, count);
    }
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("foot_tracker_gaits");
    suite_add_loop(suite, "sampling", sampling_alone_costs_millimetres, 6);
    suite_add_loop(suite, "gaits", every_gait_at_every_rate, 9);
    suite_add_loop(suite, "upright", an_upright_x_axis_is_a_mounting_like_any_other, 2);
    suite_add_loop(suite, "begins in motion", a_log_may_begin_at_any_moment_of_a_stride, 8);
    suite_add(suite, "honesty", covariances_are_honest);
    suite_add(suite, "level floor", a_level_floor_stays_level);
    suite_add_loop(suite, "long dropout", two_seconds_are_coasted_over, 24);
    suite_add_loop(suite, "straight on", a_straight_walk_goes_on_straight, 5);
    suite_add_loop(suite, "short dropout", tenths_of_a_second_are_bridged, 20);
    suite_add_loop(suite, "standing", who_stands_stays, 2);
    suite_add(suite, "lost and found", a_lost_track_is_found_by_a_start);
    suite_add_loop(suite, "prefix", a_cut_log_tells_the_same, 18);
    suite_add(suite, "few samples", a_log_of_a_few_samples_ends_well);
    return suite;
}
