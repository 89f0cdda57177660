/* SPDX-License-Identifier: MIT */
#include "insole/move/gait_memory.h"

#include "insole/base/rng.h"
#include "insole/move/walk_axis.h"
#include "motion.h"
#include "near.h"
#include "phone.h"
#include "sample.h"
#include "suite.h"

#define PI  3.14159265358979323846
#define EPS ((double)INSOLE_REAL_EPSILON)

static insole_gait_memory_t memory;

static void begin(void)
{
    static const insole_gait_memory_t nothing;
    memory = nothing;
}

/* Of an ellipse along an angle, and a bounce that goes with it. */
static insole_sym3_t scatter_along(double angle, double most, double least)
{
    insole_sym3_t S = insole_sym3_diagonal(0, 0, 4);
    d3_t along = d3(cos(angle), sin(angle), 0.3), across = d3(-sin(angle), cos(angle), 0.0);
    S = insole_sym3_add_outer(S, (insole_real_t)most, real_of(along));
    return insole_sym3_add_outer(S, (insole_real_t)least, real_of(across));
}

static double axis_of(const insole_gait_memory_t *m)
{
    return (double)insole_walk_axis_of(m->scatter).rad;
}

/* The walker turns: whatever is kept turns along, the share that is kept left aside. */
START_TEST(all_turns_along)
{
    worst_t off = {0.0, 0.0};
    for (int i = 0; i < 100; i++) {
        double turn = i * 0.13 - 6.0;
        begin();
        insole_gait_moments_t m = {.force_mps2 = insole_vec3(1, 0, 9)};
        insole_gait_memory_level(&memory, &m);
        insole_gait_memory_add(&memory, scatter_along(0.4, 2.0, 0.5));
        insole_gait_memory_note(&memory, INSOLE_R(0.4), INSOLE_R(0.9));
        memory.pull = insole_spot(2, 1);
        insole_sym3_t before = memory.scatter;
        insole_gait_memory_fade(&memory, (insole_real_t)turn, INSOLE_R(0.8), INSOLE_R(0.5));
        worst_note(&off, fabs(remainder(axis_of(&memory) - 0.4 - turn, PI)), i);
        worst_note(&off, fabs(remainder((double)memory.axis_rad[0] - 0.4 - turn, PI)), i);
        worst_note(&off, fabs((double)(memory.scatter.zz - INSOLE_R(0.8) * before.zz)), i);
        d3_t tilted = d3(0.8 * (double)before.xz, 0.8 * (double)before.yz, 0.0);
        tilted = d33_apply(turn_z(turn), tilted);
        worst_note(
            &off, hypot((double)memory.scatter.xz - tilted.x, (double)memory.scatter.yz - tilted.y),
            i);
        d3_t pull = d33_apply(turn_z(turn), d3(1.0, 0.5, 0.0));
        worst_note(&off, hypot((double)memory.pull.x_m - pull.x, (double)memory.pull.y_m - pull.y),
                   i);
        d3_t force = d33_apply(turn_z(turn), d3(0.8, 0.0, 7.2));
        worst_note(&off, d3_norm(d3_add(d3_of(memory.force_mps2), -1.0, force)), i);
        ASSERT_NEAR(memory.steps, 0.8, 4.0 * EPS, "");
    }
    ASSERT_WORST(off, 40.0 * EPS, "");
}
END_TEST

/* Each step counts alike, however strong; one much weaker than 0.3 m/s^2 counts less. */
START_TEST(steps_count_alike)
{
    begin();
    insole_gait_memory_add(&memory, scatter_along(0.0, 100.0, 1.0));
    insole_gait_memory_add(&memory, scatter_along(0.6, 1000.0, 10.0));
    ASSERT_NEAR(axis_of(&memory), 0.3, 1.0e-3, "rad");
    ASSERT_NEAR(memory.steps, 2.0, 4.0 * EPS, "");
    insole_gait_memory_add(&memory, scatter_along(1.5, 0.001, 0.0));
    ASSERT_NEAR(axis_of(&memory), 0.3, 0.01, "rad");
}
END_TEST

/* An attitude that is off by a tilt: force and motion are seen turned, and turned back. */
START_TEST(the_mean_force_points_up)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 1u);
    worst_t off = {0.0, 0.0};
    for (int i = 0; i < 200; i++) {
        double way = i * 0.3, tilt = 0.1 * (double)insole_rng_uniform(&rng);
        d33_t E = d33_exp(d3(tilt * cos(way), tilt * sin(way), 0.0));
        d3_t c = d3_of(sample_vec3(&rng, 3)), falling = d3_of(sample_vec3(&rng, 3));
        insole_gait_moments_t m = {.force_mps2 = real_of(d33_apply(E, d3(0.0, 0.0, 9.7))),
                                   .falling_mps2 = real_of(d33_apply(E, falling)),
                                   .step = {real_of(d33_apply(E, c)), insole_vec3_zero()},
                                   .stride = {insole_vec3_zero(), real_of(d33_apply(E, c))}};
        m.scatter = insole_sym3_add_outer(m.scatter, 1, m.step.c);
        begin();
        insole_gait_memory_level(&memory, &m);
        worst_note(&off, d3_norm(d3_add(d3_of(m.step.c), -1.0, c)), i);
        worst_note(&off, d3_norm(d3_add(d3_of(m.stride.s), -1.0, c)), i);
        worst_note(&off, d3_norm(d3_add(d3_of(m.falling_mps2), -1.0, falling)), i);
        worst_note(&off, fabs((double)m.scatter.xz - c.x * c.z), i);
        worst_note(&off, fabs((double)m.scatter.yy - c.y * c.y), i);
    }
    ASSERT_WORST(off, 0.01, ""); /* the cube of the angle, over 6, times 5 m/s^2 */
}
END_TEST

/* The first steps are sped up by 1 m/s^2, then the pace is even: it is the mean that levels. */
START_TEST(it_is_the_mean_of_all_steps)
{
    begin();
    for (int i = 0; i < 10; i++) {
        insole_gait_moments_t m = {.force_mps2 = insole_vec3(i < 1 ? 1 : 0, 0, INSOLE_R(9.8)),
                                   .step = {insole_vec3(0, 0, 1), insole_vec3_zero()}};
        insole_gait_memory_level(&memory, &m);
        double tilt = 1.0 / 9.8 / (i + 1);
        ASSERT_NEAR(m.step.c.x, -tilt, 0.01 * tilt, "m/s^2");
    }
}
END_TEST

/* Free fall, a phone that hangs on its side by mistake: nothing is turned. */
START_TEST(what_is_no_tilt_is_left)
{
    const insole_vec3_t forces[] = {{0, 0, 0}, {0, 0, INSOLE_R(0.5)}, {4, 0, 9}, {0, 0, -9}};
    for (int i = 0; i < 4; i++) {
        begin();
        insole_gait_moments_t m = {.force_mps2 = forces[i],
                                   .scatter = scatter_along(0.3, 2.0, 1.0)},
                              as_it_was = m;
        insole_gait_memory_level(&memory, &m);
        ck_assert(memcmp(&m, &as_it_was, sizeof m) == 0);
    }
}
END_TEST

/* Axes drawn with a normal error; the angles between one and the next have twice its variance, and
 * the first step has nothing to be compared with. */
START_TEST(wander_is_the_variance_of_an_axis)
{
    const double sigma = 0.2;
    insole_rng_t rng;
    insole_rng_seed(&rng, 2u);
    begin();
    insole_gait_memory_note(&memory, 0, INSOLE_R(0.99));
    ASSERT_NEAR(insole_gait_memory_wander(&memory), -0.5 * log(0.8), 4.0 * EPS, "rad^2");
    double sum = 0.0;
    enum { STEPS = 3000, SETTLED = 500 };
    for (int i = 0; i < STEPS; i++) {
        double angle = sigma * (double)insole_rng_normal(&rng);
        insole_gait_memory_note(&memory, (insole_real_t)angle, INSOLE_R(0.99));
        sum += i >= SETTLED ? (double)insole_gait_memory_wander(&memory) / (STEPS - SETTLED) : 0.0;
    }
    ASSERT_NEAR(sum, 2.0 * sigma * sigma, 0.1 * sigma * sigma, "rad^2");
    begin();
    for (int i = 0; i < 50; i++) { /* a sway: the same for each foot */
        insole_gait_memory_note(&memory, (insole_real_t)(i % 2 * 0.4), INSOLE_R(0.5));
    }
    ASSERT_NEAR(insole_gait_memory_wander(&memory), 0.0, 1.0e-6, "rad^2");
    for (int i = 0; i < 50; i++) { /* at right angles: as wild as can be, and finite */
        insole_gait_memory_note(&memory, (insole_real_t)(i / 2 % 2 * 0.5 * PI), 0);
    }
    ASSERT_NEAR(insole_gait_memory_wander(&memory), -0.5 * log(0.002), 1.0e-4, "rad^2");
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("gait_memory");
    suite_add(suite, "turn", all_turns_along);
    suite_add(suite, "steps", steps_count_alike);
    suite_add(suite, "level", the_mean_force_points_up);
    suite_add(suite, "level", it_is_the_mean_of_all_steps);
    suite_add(suite, "level", what_is_no_tilt_is_left);
    suite_add(suite, "wander", wander_is_the_variance_of_an_axis);
    return suite;
}
