/* SPDX-License-Identifier: MIT */
#include "insole/track/foot_walk.h"

#include <string.h>

#include "near.h"
#include "suite.h"

static insole_foot_walk_t walk, before;
static insole_vec3_t way;

static insole_stride_t stride_of(double x, double y, double z, double model_m, double turn_rad)
{
    insole_stride_t s;
    memset(&s, 0, sizeof s);
    s.begin_us = 10000000u;
    s.end_us = 10600000u;
    s.displacement_m = insole_vec3((insole_real_t)x, (insole_real_t)y, (insole_real_t)z);
    s.length_m = (insole_real_t)hypot(x, y);
    s.model_length_m = (insole_real_t)model_m;
    s.heading_rad = (insole_real_t)atan2(y, x);
    s.turn_rad = (insole_real_t)turn_rad;
    return s;
}

static void walk_one(const insole_stride_t *s, uint64_t t_us)
{
    ck_assert_int_eq(insole_foot_walk_stride(&walk, s, t_us), INSOLE_OK);
}

#define ASSERT_VEC(v, X, Y, Z, tolerance, unit)                                                    \
    ASSERT_NEAR((v).x, X, tolerance, unit);                                                        \
    ASSERT_NEAR((v).y, Y, tolerance, unit);                                                        \
    ASSERT_NEAR((v).z, Z, tolerance, unit)

START_TEST(begins_at_rest_in_the_origin)
{
    memset(&walk, 0x55, sizeof walk);
    ck_assert_int_eq(insole_foot_walk_init(&walk), INSOLE_OK);
    ASSERT_VEC(walk.place_m, 0.0, 0.0, 0.0, 0.0, "m");
    ck_assert_int_eq(insole_foot_walk_cease(&walk, 1000000u), INSOLE_OK);
    ck_assert_int_eq(insole_foot_walk_on(&walk, 1000000u, 3000000u, &way), INSOLE_OK);
    ASSERT_VEC(way, 0.0, 0.0, 0.0, 0.0, "m");
    ck_assert(insole_foot_walk_bow(&walk, INSOLE_R(1.0)) == INSOLE_R(0.0));
}
END_TEST

/* 0.6 s from stance to stance make a gait cycle of 0.96 s: 1.2 m in it are 1.25 m/s. */
START_TEST(velocity_of_a_stride_by_hand)
{
    insole_stride_t s = stride_of(0.0, 1.2, 0.2, 1.0, 0.48);
    (void)insole_foot_walk_init(&walk);
    walk_one(&s, 11000000u);
    ASSERT_VEC(walk.velocity_mps, 0.0, 1.25, 0.0, 1e-6, "m/s");
    ASSERT_NEAR(walk.turn_radps, 0.5, 1e-6, "rad/s");
    ASSERT_NEAR(walk.heading_rad, 1.57079633, 1e-6, "rad");
}
END_TEST

/* No gait cycle is shorter than half a second: 0.1 s from stance to stance count as that. */
START_TEST(short_swing_makes_no_great_speed)
{
    insole_stride_t s = stride_of(1.0, 0.0, 0.0, 1.0, 0.0);
    s.end_us = s.begin_us + 100000u;
    (void)insole_foot_walk_init(&walk);
    walk_one(&s, 11000000u);
    ASSERT_VEC(walk.velocity_mps, 2.0, 0.0, 0.0, 1e-6, "m/s");
    s.end_us = s.begin_us;
    walk_one(&s, 12000000u);
    ASSERT_VEC(walk.velocity_mps, 2.0, 0.0, 0.0, 1e-6, "m/s");
}
END_TEST

/* Strides of the model's length in the direction of the inertial ones, with their climb. */
START_TEST(dead_reckoning_by_hand)
{
    insole_stride_t east = stride_of(1.3, 0.0, 0.17, 1.5, 0.0);
    insole_stride_t slant = stride_of(-0.6, 0.8, -0.05, 2.0, 0.0);
    (void)insole_foot_walk_init(&walk);
    walk_one(&east, 11000000u);
    walk_one(&slant, 12000000u);
    ASSERT_VEC(walk.place_m, 1.5 - 1.2, 1.6, 0.12, 1e-6, "m");
    ASSERT_NEAR(walk.place_m2, 0.15 * 0.15 + 0.2 * 0.2, 1e-6, "m2");
}
END_TEST

START_TEST(goes_on_as_the_last_stride_went)
{
    insole_stride_t s = stride_of(1.2, 0.0, 0.1, 1.2, 0.0);
    (void)insole_foot_walk_init(&walk);
    walk_one(&s, 11000000u);
    (void)insole_foot_walk_cease(&walk, 12000000u);
    ck_assert_int_eq(insole_foot_walk_on(&walk, 12000000u, 14000000u, &way), INSOLE_OK);
    ASSERT_VEC(way, 2.5, 0.0, 0.0, 1e-6, "m");
    ASSERT_VEC(walk.place_m, 3.7, 0.0, 0.1, 1e-6, "m");
    ck_assert_int_eq(insole_foot_walk_on(&walk, 14000000u, 16000000u, &way), INSOLE_OK);
    ASSERT_VEC(way, 1.25, 0.0, 0.0, 1e-6, "m"); /* three seconds in all */
    ck_assert_int_eq(insole_foot_walk_on(&walk, 16000000u, 99000000u, &way), INSOLE_OK);
    ASSERT_VEC(way, 0.0, 0.0, 0.0, 0.0, "m");
}
END_TEST

/* In a bow: the direction at the middle of the piece; after a second it stays. */
START_TEST(goes_on_in_a_bow)
{
    insole_stride_t s = stride_of(0.0, 1.2, 0.0, 1.2, 0.48);
    (void)insole_foot_walk_init(&walk);
    walk_one(&s, 11000000u);
    (void)insole_foot_walk_cease(&walk, 11500000u);
    ck_assert_int_eq(insole_foot_walk_on(&walk, 11500000u, 12300000u, &way), INSOLE_OK);
    ASSERT_VEC(way, -sin(0.2), cos(0.2), 0.0, 1e-5, "m"); /* 1 m, turned by 0.5 * 0.4 */
    ck_assert_int_eq(insole_foot_walk_on(&walk, 13500000u, 14300000u, &way), INSOLE_OK);
    ASSERT_VEC(way, -sin(0.5), cos(0.5), 0.0, 1e-5, "m");
    ASSERT_NEAR(insole_foot_walk_bow(&walk, INSOLE_R(0.3)), 0.15, 1e-6, "rad");
    ASSERT_NEAR(insole_foot_walk_bow(&walk, INSOLE_R(30.0)), 0.5, 1e-6, "rad");
}
END_TEST

/* However a straight gap is cut, the way is the same. */
START_TEST(pieces_of_a_gap_chain)
{
    insole_stride_t s = stride_of(0.9, -0.7, 0.0, 1.0, 0.0);
    insole_vec3_t sum = insole_vec3_zero(), whole;
    (void)insole_foot_walk_init(&walk);
    walk_one(&s, 11000000u);
    (void)insole_foot_walk_cease(&walk, 11200000u);
    before = walk;
    (void)insole_foot_walk_on(&before, 11200000u, 15200000u, &whole);
    for (uint64_t t = 11200000u; t < 15200000u; t += 40000u) {
        ck_assert_int_eq(insole_foot_walk_on(&walk, t, t + 40000u, &way), INSOLE_OK);
        sum = insole_vec3_add(sum, way);
    }
    ASSERT_VEC(sum, (double)whole.x, (double)whole.y, 0.0, 1e-5, "m");
    ASSERT_VEC(walk.place_m, (double)before.place_m.x, (double)before.place_m.y, 0.0, 1e-5, "m");
}
END_TEST

START_TEST(whoever_made_no_stride_lately_stands)
{
    insole_stride_t s = stride_of(1.2, 0.0, 0.0, 1.2, 0.3);
    (void)insole_foot_walk_init(&walk);
    walk_one(&s, 11000000u);
    before = walk;
    (void)insole_foot_walk_cease(&walk, 12500000u);
    ck_assert_mem_eq(&walk.velocity_mps, &before.velocity_mps, sizeof walk.velocity_mps);
    (void)insole_foot_walk_cease(&walk, 12500001u);
    ASSERT_VEC(walk.velocity_mps, 0.0, 0.0, 0.0, 0.0, "m/s");
    ck_assert(walk.turn_radps == INSOLE_R(0.0));
    ck_assert(walk.heading_rad == before.heading_rad);
}
END_TEST

static void refuse_stride(const insole_stride_t *s, insole_status_t expected)
{
    before = walk;
    ck_assert_int_eq(insole_foot_walk_stride(&walk, s, 13000000u), expected);
    ck_assert_mem_eq(&walk, &before, sizeof walk);
}

START_TEST(bad_strides_are_refused)
{
    insole_stride_t good = stride_of(1.2, 0.1, 0.0, 1.2, 0.3), bad;
    insole_real_t *fields[] = {&bad.displacement_m.x, &bad.displacement_m.y, &bad.displacement_m.z,
                               &bad.model_length_m,   &bad.heading_rad,      &bad.turn_rad};
    (void)insole_foot_walk_init(&walk);
    walk_one(&good, 11000000u);
    for (size_t i = 0; i < sizeof fields / sizeof fields[0]; i++) {
        bad = good;
        *fields[i] = (insole_real_t)NAN;
        refuse_stride(&bad, INSOLE_ERR_VALUE);
        *fields[i] = -(insole_real_t)INFINITY;
        refuse_stride(&bad, INSOLE_ERR_VALUE);
    }
    bad = good;
    bad.end_us = bad.begin_us - 1u;
    refuse_stride(&bad, INSOLE_ERR_TIME);
    refuse_stride(NULL, INSOLE_ERR_NULL);
}
END_TEST

START_TEST(bad_times_are_refused)
{
    insole_stride_t s = stride_of(1.2, 0.1, 0.0, 1.2, 0.3);
    insole_vec3_t kept = insole_vec3(INSOLE_R(7.0), INSOLE_R(8.0), INSOLE_R(9.0));
    (void)insole_foot_walk_init(&walk);
    walk_one(&s, 11000000u);
    (void)insole_foot_walk_cease(&walk, 11200000u);
    before = walk;
    way = kept;
    ck_assert_int_eq(insole_foot_walk_on(&walk, 11199999u, 12000000u, &way), INSOLE_ERR_TIME);
    ck_assert_int_eq(insole_foot_walk_on(&walk, 11300000u, 11300000u, &way), INSOLE_ERR_TIME);
    ck_assert_int_eq(insole_foot_walk_on(&walk, 11400000u, 11300000u, &way), INSOLE_ERR_TIME);
    ck_assert_int_eq(insole_foot_walk_on(&walk, 11200000u, 11300000u, NULL), INSOLE_ERR_NULL);
    ck_assert_mem_eq(&walk, &before, sizeof walk);
    ck_assert_mem_eq(&way, &kept, sizeof way);
    ck_assert_int_eq(insole_foot_walk_on(NULL, 0u, 1u, &way), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_foot_walk_init(NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_foot_walk_cease(NULL, 0u), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_foot_walk_stride(NULL, &s, 0u), INSOLE_ERR_NULL);
    ck_assert(insole_foot_walk_bow(NULL, INSOLE_R(1.0)) == INSOLE_R(0.0));
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("foot_walk");
    suite_add(suite, "begins at rest", begins_at_rest_in_the_origin);
    suite_add(suite, "velocity", velocity_of_a_stride_by_hand);
    suite_add(suite, "short swing", short_swing_makes_no_great_speed);
    suite_add(suite, "dead reckoning", dead_reckoning_by_hand);
    suite_add(suite, "goes on", goes_on_as_the_last_stride_went);
    suite_add(suite, "goes on in a bow", goes_on_in_a_bow);
    suite_add(suite, "pieces chain", pieces_of_a_gap_chain);
    suite_add(suite, "stands", whoever_made_no_stride_lately_stands);
    suite_add(suite, "bad strides", bad_strides_are_refused);
    suite_add(suite, "bad times", bad_times_are_refused);
    return suite;
}
