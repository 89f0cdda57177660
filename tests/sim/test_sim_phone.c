/* SPDX-License-Identifier: MIT */
#include "sim/phone.h"

#include "near.h"
#include "phones.h"
#include "sim/motion.h"
#include "suite.h"

static const double g = 9.81;

#define IDEAL "imu.model = ideal\n"
static const char *const poses[] = {"phone.pose = hand\n", "phone.pose = ear\n",
                                    "phone.pose = swing\n", "phone.pose = pocket\n"};
static const char all_poses[] = "pose,4,ear\npose,8,pocket\npose,12.5,swing\npose,16,hand\n";

static sim_walk_t *walk_with(const char *text, const char *more, uint64_t seed)
{
    char whole[1500];
    snprintf(whole, sizeof whole, "%s%s", text, more);
    return walk_of(whole, seed);
}

/* --- what an ideal sensor feels --- */

static sim_mat3_t transposed(sim_mat3_t m)
{
    sim_mat3_t t = {{m.r0.x, m.r1.x, m.r2.x}, {m.r0.y, m.r1.y, m.r2.y}, {m.r0.z, m.r1.z, m.r2.z}};
    return t;
}

static double turned_by(sim_mat3_t a, sim_mat3_t b)
{
    sim_mat3_t between = sim_mat3_mul(transposed(a), b);
    return acos(fmin(1.0, 0.5 * (between.r0.x + between.r1.y + between.r2.z - 1.0)));
}

/* Integrates point samples by the midpoint rule, in the outer frame. */
typedef struct {
    sim_pose_t pose;
    sim_vec3_t velocity;
} strapdown_t;

static void navigate(strapdown_t *ins, const sim_motion_t *before, const sim_motion_t *now,
                     double dt)
{
    sim_vec3_t rate = sim_vec3_add(before->rate_radps, now->rate_radps);
    sim_mat3_t half = sim_mat3_from_turn(sim_vec3_scale(rate, 0.25 * dt));
    sim_mat3_t middle = sim_mat3_mul(ins->pose.attitude, half);
    sim_vec3_t force = sim_vec3_scale(sim_vec3_add(before->force_mps2, now->force_mps2), 0.5);
    sim_vec3_t a = sim_mat3_mul_vec(middle, force);
    a.z -= g;
    sim_vec3_t p = sim_vec3_add_scaled(ins->pose.position_m, dt, ins->velocity);
    ins->pose.position_m = sim_vec3_add_scaled(p, 0.5 * dt * dt, a);
    ins->velocity = sim_vec3_add_scaled(ins->velocity, dt, a);
    ins->pose.attitude = sim_mat3_mul(middle, half);
}

static void assert_strapdown_follows(const sim_walk_t *walk)
{
    double rate_hz = 1000.0, dt = 1.0 / rate_hz;
    sim_motion_stream_t stream = sim_motion_stream(sim_walk_body(walk), rate_hz, g);
    sim_motion_t before = sim_motion_next_point(&stream);
    strapdown_t ins = {before.pose, {0.0, 0.0, 0.0}};
    sim_pose_t start[2] = {before.pose, sim_phone_pose(phone_of(walk), 1e-4)};
    ins.velocity = sim_vec3_scale(sim_vec3_sub(start[1].position_m, start[0].position_m), 1e4);
    worst_t off = {0.0, 0.0}, turned = {0.0, 0.0};
    while (before.t_s < sim_walk_duration(walk)) {
        sim_motion_t now = sim_motion_next_point(&stream);
        navigate(&ins, &before, &now, dt);
        sim_vec3_t error = sim_vec3_sub(ins.pose.position_m, now.pose.position_m);
        worst_note(&off, sim_vec3_norm(error), now.t_s);
        worst_note(&turned, turned_by(ins.pose.attitude, now.pose.attitude), now.t_s);
        before = now;
    }
    ASSERT_AT_LEAST(before.t_s, 15.0, "s");
    ASSERT_WORST(off, 0.02, "m");
    ASSERT_WORST(turned, 2e-4, "rad");
}

START_TEST(an_ideal_sensor_leads_along_the_true_way)
{
    sim_walk_t *walk = walk_with(CORNERS, poses[_i], 4);
    assert_strapdown_follows(walk);
    sim_walk_close(walk);
}
END_TEST

START_TEST(it_does_through_changes_too)
{
    sim_walk_t *walk = walk_with(CORNERS, all_poses, 4);
    assert_strapdown_follows(walk);
    sim_walk_close(walk);
}
END_TEST

/* Over whole strides of an even walk the trunk gains no speed: what is felt is gravity. */
START_TEST(the_mean_force_over_whole_strides_is_gravity)
{
    sim_walk_t *walk = walk_with(STRAIGHT EQUAL SAME CALM, poses[_i], 1);
    const sim_list_t *steps = &sim_walk_steps(walk)->steps;
    const sim_step_t *from = sim_list_at(steps, 20), *to = sim_list_at(steps, 60);
    sim_body_t body = sim_walk_body(walk);
    int n = 40000;
    sim_vec3_t sum = sim_vec3(0.0, 0.0, 0.0);
    for (int i = 0; i < n; i++) {
        double t = from->strike_s + (i + 0.5) * (to->strike_s - from->strike_s) / n;
        sim_motion_t m = sim_motion_at(&body, t, 5e-4, g);
        sum = sim_vec3_add_scaled(sum, 1.0 / n, sim_mat3_mul_vec(m.pose.attitude, m.force_mps2));
    }
    ASSERT_NEAR(sum.x, 0.0, 0.01, "m/s^2");
    ASSERT_NEAR(sum.y, 0.0, 0.01, "m/s^2");
    ASSERT_NEAR(sum.z, g, 0.01, "m/s^2");
    sim_walk_close(walk);
}
END_TEST

START_TEST(who_stands_trembles_and_does_nothing_else)
{
    const char *text = PHONE "start,3,4,1\npause,20\nphone.fidgets_hz = 0\n";
    sim_walk_t *walk = walk_with(text, poses[_i], 2);
    sim_body_t body = sim_walk_body(walk);
    worst_t rate = {0.0, 0.0}, force = {0.0, 0.0}, off = {0.0, 0.0};
    sim_vec3_t first = sim_phone_pose(phone_of(walk), 0.0).position_m;
    double squares = 0.0;
    int n = 0;
    for (double t = 0.0; t < sim_walk_duration(walk); t += 0.01, n++) {
        sim_motion_t m = sim_motion_at(&body, t, 5e-4, g);
        double w = sim_vec3_norm(m.rate_radps);
        squares += w * w;
        worst_note(&rate, w, t);
        worst_note(&force, fabs(sim_vec3_norm(m.force_mps2) - g), t);
        worst_note(&off, sim_vec3_norm(sim_vec3_sub(m.pose.position_m, first)), t);
    }
    ASSERT_WORST(rate, 0.8, "rad/s");
    ASSERT_WORST(force, 0.2, "m/s^2");
    ASSERT_WORST(off, 0.02, "m");
    bool trembles = _i != SIM_POSE_POCKET;
    ASSERT_AT_LEAST(sqrt(squares / n), trembles ? 0.05 : 0.0, "rad/s");
    ASSERT_AT_MOST(sqrt(squares / n), trembles ? 0.3 : 1e-6, "rad/s");
    sim_walk_close(walk);
}
END_TEST

/* --- changes --- */

static const char *const smooth[] = {CORNERS, STRAIGHT};

START_TEST(changes_are_smooth_and_last_a_second)
{
    sim_walk_t *walk = walk_with(smooth[_i], all_poses, 5);
    sim_body_t body = sim_walk_body(walk);
    worst_t jump = {0.0, 0.0}, spin = {0.0, 0.0};
    sim_motion_t last = sim_motion_at(&body, 0.0, 2e-4, g);
    for (double t = 2e-4; t < 18.0; t += 2e-4) {
        sim_motion_t now = sim_motion_at(&body, t, 2e-4, g);
        worst_note(&jump, sim_vec3_norm(sim_vec3_sub(now.force_mps2, last.force_mps2)), t);
        worst_note(&spin, sim_vec3_norm(sim_vec3_sub(now.rate_radps, last.rate_radps)), t);
        last = now;
    }
    ASSERT_WORST(jump, 0.7, "m/s^2 in 0.2 ms");
    ASSERT_WORST(spin, 0.04, "rad/s in 0.2 ms");
    sim_walk_close(walk);
}
END_TEST

/* Outside its changes a walk with changes is that of each pose alone. */
START_TEST(between_changes_nothing_is_left_of_them)
{
    static const int32_t at[] = {0, 1, 3, 2, 0};
    static const double begin[] = {0.0, 4.0, 8.0, 12.5, 16.0, 19.0};
    sim_walk_t *mixed = walk_with(CORNERS CALM, all_poses, 6);
    for (int i = 0; i < 5; i++) {
        sim_walk_t *alone = walk_with(CORNERS CALM, poses[at[i]], 6);
        for (double t = begin[i] + 1.0; t < begin[i + 1]; t += 0.1) {
            sim_pose_t a = sim_phone_pose(phone_of(mixed), t);
            sim_pose_t b = sim_phone_pose(phone_of(alone), t);
            ASSERT_NEAR(sim_vec3_norm(sim_vec3_sub(a.position_m, b.position_m)), 0.0, 1e-9, "m");
            ASSERT_NEAR(turned_by(a.attitude, b.attitude), 0.0, 1e-6, "rad");
        }
        sim_walk_close(alone);
    }
    sim_walk_close(mixed);
}
END_TEST

START_TEST(a_fidgeting_walker_turns_the_phone_only_while_standing)
{
    const char *text = PHONE "start,0,0,0\nwalk,6,0,1.2\npause,30\nwalk,12,0,1.2\n"
                             "phone.wander_rad = 0\nphone.tremor_rad = 0\n";
    sim_walk_t *still = walk_with(text, "phone.fidgets_hz = 0\n", 3);
    sim_walk_t *fidgets = walk_with(text, "phone.fidgets_hz = 0.5\n", 3);
    double most = 0.0;
    for (double t = 0.0; t < sim_walk_duration(still); t += 0.02) {
        sim_pose_t a = sim_phone_pose(phone_of(still), t);
        sim_pose_t b = sim_phone_pose(phone_of(fidgets), t);
        double turned = turned_by(a.attitude, b.attitude);
        if (sim_torso_at(&phone_of(still)->torso, t).size > 0.6) {
            ASSERT_NEAR(turned, 0.0, 1e-6, "rad");
        }
        most = fmax(most, turned);
    }
    ASSERT_AT_LEAST(most, 0.3, "rad");
    ASSERT_AT_MOST(most, 2.0, "rad");
    sim_walk_close(still);
    sim_walk_close(fidgets);
}
END_TEST

/* --- people and seeds --- */

START_TEST(equal_seeds_carry_it_equally)
{
    sim_walk_t *a = walk_with(CORNERS, all_poses, 7), *b = walk_with(CORNERS, all_poses, 7);
    sim_walk_t *c = walk_with(CORNERS, all_poses, 8);
    for (double t = 0.0; t < 20.0; t += 0.5) {
        sim_pose_t p = sim_phone_pose(phone_of(a), t), q = sim_phone_pose(phone_of(b), t);
        sim_pose_t r = sim_phone_pose(phone_of(c), t);
        ck_assert_mem_eq(&p, &q, sizeof p);
        ck_assert_mem_ne(&p, &r, sizeof p);
    }
    sim_walk_close(a);
    sim_walk_close(b);
    sim_walk_close(c);
}
END_TEST

START_TEST(other_people_take_other_steps_but_only_with_a_phone)
{
    const char *phone = STRAIGHT EQUAL, *shoe = "start,0,0,0\nwalk,60,0,1.3\n" EQUAL;
    size_t least = 1000, most = 0, shoes = 0;
    for (uint64_t seed = 1; seed <= 12; seed++) {
        sim_walk_t *with = walk_of(phone, seed), *without = walk_of(shoe, seed);
        size_t count = sim_walk_steps(with)->steps.count;
        least = count < least ? count : least;
        most = count > most ? count : most;
        shoes = seed == 1 ? sim_walk_steps(without)->steps.count : shoes;
        ck_assert_uint_eq(sim_walk_steps(without)->steps.count, shoes);
        ck_assert_ptr_null(sim_walk_phone(without));
        sim_walk_close(with);
        sim_walk_close(without);
    }
    ASSERT_AT_LEAST((double)most / (double)least, 1.1, "1");
    ASSERT_AT_MOST((double)most / (double)least, 1.6, "1");
}
END_TEST

START_TEST(the_phone_has_a_rate_of_its_own)
{
    sim_walk_t *walk = walk_of(PHONE "start,0,0,0\npause,1\nphone.rate_hz = 125\n", 1);
    sim_sample_t sample;
    for (int i = 0; i < 100; i++) {
        ck_assert(sim_walk_next(walk, &sample));
        ASSERT_NEAR(sample.truth.t_s, i / 125.0, 1e-12, "s");
    }
    sim_walk_close(walk);
}
END_TEST

static const struct {
    const char *text, *says;
    int line;
} refusals[] = {
    {PHONE "start,0,0,0\npose,5,ear\npose,5.9,hand\n", "pose at 5.9 s, expected not before 6 s", 4},
    {PHONE "start,0,0,0\npose,5,ear\npose,2,hand\n", "pose at 2 s, expected not before 6 s", 4},
    {PHONE "start,0,0,0\npose,5,ear\npose,7,hand\nphone.change_s = 3\n", "not before 8 s", 4},
};

START_TEST(changes_that_run_into_each_other_are_refused)
{
    sim_scenario_t scenario = scenario_of(refusals[_i].text);
    sim_error_t error;
    ck_assert_ptr_null(sim_walk_open(&scenario, 1, &error));
    ck_assert_msg(strstr(error.text, refusals[_i].says) != NULL, "says: %s", error.text);
    ck_assert_int_eq(error.line, refusals[_i].line);
    sim_scenario_free(&scenario);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("sim/phone");
    suite_add_loop(suite, "strapdown", an_ideal_sensor_leads_along_the_true_way, SIM_POSES);
    suite_add(suite, "strapdown through changes", it_does_through_changes_too);
    suite_add_loop(suite, "gravity", the_mean_force_over_whole_strides_is_gravity, SIM_POSES);
    suite_add_loop(suite, "standing", who_stands_trembles_and_does_nothing_else, SIM_POSES);
    suite_add_loop(suite, "smooth", changes_are_smooth_and_last_a_second, 2);
    suite_add(suite, "between", between_changes_nothing_is_left_of_them);
    suite_add(suite, "fidgets", a_fidgeting_walker_turns_the_phone_only_while_standing);
    suite_add(suite, "seeds", equal_seeds_carry_it_equally);
    suite_add(suite, "people", other_people_take_other_steps_but_only_with_a_phone);
    suite_add(suite, "rate", the_phone_has_a_rate_of_its_own);
    suite_add_loop(suite, "refusals", changes_that_run_into_each_other_are_refused,
                   (int)(sizeof refusals / sizeof refusals[0]));
    return suite;
}
