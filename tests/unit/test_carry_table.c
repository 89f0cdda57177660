/* SPDX-License-Identifier: MIT */
#include "insole/sense/carry_table.h"

#include "insole/sense/carry.h"
#include "near.h"
#include "sample.h"
#include "stroll.h"
#include "suite.h"

enum { RATE_HZ = 50, WALK_S = 30, MOST_BYTES = 24 * 1024 };

static const insole_carry_forest_t *const table = &insole_carry_table_forest;
static insole_carry_t carry;
static uint32_t windows, right;

START_TEST(the_table_is_whole_and_small)
{
    static const char *const NAMES[] = {"hand", "ear", "swing", "pocket"};
    ck_assert_int_eq(insole_carry_forest_check(table), INSOLE_OK);
    ck_assert_uint_eq(table->class_count, INSOLE_CARRY_POSITIONS);
    for (int k = 0; k < INSOLE_CARRY_POSITIONS; k++) {
        ck_assert_str_eq(table->names[k], NAMES[k]);
    }
    uint32_t node_bytes = sizeof(float) + 4u; /* of the device */
    uint32_t bytes = table->roots[table->tree_count] * node_bytes + 2u * (table->tree_count + 1u);
    ck_assert_uint_le(bytes, MOST_BYTES);
}
END_TEST

/* Every class is told by some leaf and every leaf tells a class. */
START_TEST(each_class_has_leaves)
{
    uint32_t leaves[INSOLE_CARRY_CLASSES] = {0u};
    for (uint32_t i = 0u; i < table->roots[table->tree_count]; i++) {
        uint8_t links[2] = {table->nodes[i].at_most, table->nodes[i].above};
        for (int side = 0; side < 2; side++) {
            if (links[side] >= INSOLE_CARRY_TREE_NODES) {
                leaves[links[side] - INSOLE_CARRY_TREE_NODES]++;
            }
        }
    }
    for (int k = 0; k < INSOLE_CARRY_CLASSES; k++) {
        ck_assert_int_eq(leaves[k] >= table->tree_count, k < INSOLE_CARRY_POSITIONS);
    }
}
END_TEST

/* ---- walkers by formula, who are not those of the simulator ------------------------------- */

static d33_t any_mounting(uint32_t seed)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, seed);
    insole_mat3_t R = insole_quat_to_mat3(sample_quat(&rng));
    d33_t mounting = {d3((double)R.r0.x, (double)R.r0.y, (double)R.r0.z),
                      d3((double)R.r1.x, (double)R.r1.y, (double)R.r1.z),
                      d3((double)R.r2.x, (double)R.r2.y, (double)R.r2.z)};
    return mounting;
}

/* A forearm of 0.35 m gives way to 0.7 of the bounce, about the axis to the left. */
static d33_t rocked(const stroll_t *stroll, double t)
{
    double rise_m = -stroll->bounce_m * cos(2.0 * 3.14159265358979 * t / stroll->step_s);
    return turn_y(-0.7 * rise_m / 0.35);
}

/* What the strike of that leg, once in two steps, leaves in a pocket, n. */
static d3_t jolt(const stroll_t *stroll, stroll_pose_t pose, double t)
{
    double since_s = fmod(t, 2.0 * stroll->step_s);
    double ring = 40.0 * exp(-since_s / 0.05) * sin(2.0 * 3.14159265358979 * 7.0 * since_s);
    return pose == STROLL_POCKET ? d3(-0.5 * ring, 0.0, ring) : d3(0.0, 0.0, 0.0);
}

/* Turn rate by differences of the attitude. */
static d3_t rate_of(d33_t before, d33_t after, double dt)
{
    d33_t turn = d33_mul(d33_transpose(before), after);
    return d3_scale(d3(turn.r2.y - turn.r1.z, turn.r0.z - turn.r2.x, turn.r1.x - turn.r0.y),
                    0.5 / dt);
}

static d33_t attitude_at(const stroll_t *stroll, stroll_pose_t pose, double t)
{
    d33_t R;
    d3_t accel;
    stroll_moment(stroll, t, &R, &accel);
    d33_t trunk = d33_mul(R, d33_transpose(stroll->mounting));
    return pose == STROLL_HAND ? d33_mul(d33_mul(trunk, rocked(stroll, t)), stroll->mounting) : R;
}

static void walk(stroll_pose_t pose, uint32_t seed)
{
    static const double DT = 1e-4;
    stroll_t stroll = stroll_in(pose, any_mounting(seed));
    stroll.step_s = 0.5 + 0.02 * (seed % 6u);
    stroll.bounce_m = 0.018 + 0.002 * (seed % 3u);
    windows = right = 0u;
    ck_assert_int_eq(insole_carry_init(&carry, &insole_carry_defaults), INSOLE_OK);
    for (uint32_t i = 0u; i < WALK_S * RATE_HZ; i++) {
        insole_carry_news_t news;
        double t = (double)i / RATE_HZ;
        d33_t R;
        d3_t accel;
        stroll_moment(&stroll, t, &R, &accel);
        R = attitude_at(&stroll, pose, t);
        accel = d3_add(accel, 1.0, jolt(&stroll, pose, t));
        insole_vec3_t force = real_of(stroll_force(R, accel));
        insole_vec3_t gyro = real_of(rate_of(attitude_at(&stroll, pose, t - DT),
                                             attitude_at(&stroll, pose, t + DT), 2.0 * DT));
        ck_assert(insole_carry_push(&carry, 1000000u + i * 20000u, force, &gyro, NULL) ==
                  INSOLE_OK);
        if (insole_carry_next(&carry, table, &news) == INSOLE_OK) {
            windows++;
            right += news.votes.winner == (int32_t)pose ? 1u : 0u;
        }
    }
}

START_TEST(a_walker_by_formula_is_known)
{
    stroll_pose_t pose = (stroll_pose_t)(_i % STROLL_POSES);
    walk(pose, (uint32_t)_i + 1u);
    ck_assert_uint_eq(windows, WALK_S - 1);
    ASSERT_AT_LEAST((double)right / windows, 0.9, "");
    ck_assert_int_eq(carry.told, (int32_t)pose);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("carry_table");
    suite_add(suite, "whole", the_table_is_whole_and_small);
    suite_add(suite, "leaves", each_class_has_leaves);
    suite_add_loop(suite, "formula", a_walker_by_formula_is_known, 24);
    return suite;
}
