/* SPDX-License-Identifier: MIT */
#include "insole/track/foot_anchor.h"

#include <string.h>

#include "near.h"
#include "sample.h"
#include "suite.h"

static insole_foot_anchor_t anchor, before;

static const insole_start_t START = {.x_m = INSOLE_R(12.0),
                                     .y_m = INSOLE_R(-5.0),
                                     .has_heading = true,
                                     .heading_rad = INSOLE_R(2.0),
                                     .sigma_m = INSOLE_R(0.5),
                                     .sigma_rad = INSOLE_R(0.1)};

static insole_vec3_t at(double x, double y, double z)
{
    return insole_vec3((insole_real_t)x, (insole_real_t)y, (insole_real_t)z);
}

static insole_fix_t fix_at(double x, double y, double z, uint64_t t_us)
{
    insole_fix_t fix;
    memset(&fix, 0, sizeof fix);
    fix.t_us = t_us;
    fix.position_m = at(x, y, z);
    fix.state = INSOLE_FIX_TRACK;
    return fix;
}

static void set_up(const insole_start_t *start, insole_vec3_t position_m, uint64_t t_us)
{
    ck_assert_int_eq(insole_foot_anchor_init(&anchor, INSOLE_R(0.001), 0u), INSOLE_OK);
    ck_assert_int_eq(insole_foot_anchor_start(&anchor, start, position_m, t_us), INSOLE_OK);
}

static void follow(double x, double y, bool stride_ended)
{
    ck_assert_int_eq(insole_foot_anchor_follow(&anchor, at(x, y, 0.0), stride_ended), INSOLE_OK);
}

START_TEST(without_a_start_n_is_m)
{
    insole_fix_t fix = fix_at(3.0, 4.0, 5.0, 2000000u), in_n;
    fix.heading_rad = INSOLE_R(1.0);
    fix.var_x_m2 = INSOLE_R(0.1);
    fix.cov_xy_m2 = INSOLE_R(0.02);
    in_n = fix;
    memset(&anchor, 0x55, sizeof anchor);
    ck_assert_int_eq(insole_foot_anchor_init(&anchor, INSOLE_R(0.0), 1000000u), INSOLE_OK);
    ck_assert_int_eq(insole_foot_anchor_to_map(&anchor, &fix), INSOLE_OK);
    ck_assert_mem_eq(&fix, &in_n, sizeof fix);
}
END_TEST

/* n turned by what drift has made since: across the way, not along it. */
START_TEST(drift_widens_across_the_way)
{
    insole_fix_t fix = fix_at(100.0, 0.0, 0.0, 41000000u);
    ck_assert_int_eq(insole_foot_anchor_init(&anchor, INSOLE_R(0.001), 1000000u), INSOLE_OK);
    ck_assert_int_eq(insole_foot_anchor_to_map(&anchor, &fix), INSOLE_OK);
    ASSERT_NEAR(fix.var_heading_rad2, 0.0016, 1e-8, "rad2");
    ASSERT_NEAR(fix.var_x_m2, 0.0, 1e-6, "m2");
    ASSERT_NEAR(fix.var_y_m2, 16.0, 1e-4, "m2");
    fix = fix_at(100.0, 0.0, 0.0, 500000u); /* of before the anchor: no drift */
    ck_assert_int_eq(insole_foot_anchor_to_map(&anchor, &fix), INSOLE_OK);
    ASSERT_NEAR(fix.var_heading_rad2, 0.0, 0.0, "rad2");
    fix = fix_at(1.0, 0.0, 0.0, 1000000000000u); /* never more than any turn */
    ck_assert_int_eq(insole_foot_anchor_to_map(&anchor, &fix), INSOLE_OK);
    ASSERT_NEAR(fix.var_heading_rad2, 9.8696044, 1e-5, "rad2");
}
END_TEST

/* Covariance by J P J', J of the whole map from (anchor, turn, position in n) to position. */
static void map_directly(const insole_foot_anchor_t *a, const insole_fix_t *n, double out[6])
{
    double c = cos((double)a->yaw_rad), s = sin((double)a->yaw_rad);
    double dx = (double)n->position_m.x - (double)a->anchor_n_m.x;
    double dy = (double)n->position_m.y - (double)a->anchor_n_m.y;
    double age = ((double)n->t_us - (double)a->t_us) * 1e-6 * (double)a->drift_radps;
    double J[2][5] = {{1.0, 0.0, -s * dx - c * dy, c, -s}, {0.0, 1.0, c * dx - s * dy, s, c}};
    double P[5][5] = {{0.0}}, S[2][2] = {{0.0}};
    P[0][0] = P[1][1] = (double)a->var_m2;
    P[2][2] = (double)a->var_rad2 + age * age;
    P[3][3] = (double)n->var_x_m2;
    P[4][4] = (double)n->var_y_m2;
    P[3][4] = P[4][3] = (double)n->cov_xy_m2;
    for (int i = 0; i < 2; i++) {
        for (int j = 0; j < 2; j++) {
            for (int k = 0; k < 25; k++) {
                S[i][j] += J[i][k / 5] * P[k / 5][k % 5] * J[j][k % 5];
            }
        }
    }
    out[0] = (double)a->anchor_m_m.x + c * dx - s * dy;
    out[1] = (double)a->anchor_m_m.y + s * dx + c * dy;
    out[2] = (double)a->anchor_m_m.z + (double)n->position_m.z - (double)a->anchor_n_m.z;
    out[3] = S[0][0];
    out[4] = S[0][1];
    out[5] = S[1][1];
}

START_TEST(position_and_covariance_against_direct_ones)
{
    insole_rng_t rng;
    worst_t place = {0.0, 0.0}, cov = {0.0, 0.0}, heading = {0.0, 0.0};
    insole_rng_seed(&rng, 7u);
    for (int i = 0; i < 2000; i++) {
        insole_start_t start = START;
        insole_vec3_t p = sample_vec3(&rng, INSOLE_R(30.0)), q = sample_vec3(&rng, INSOLE_R(30.0));
        double e[6];
        start.heading_rad = sample_between(&rng, -INSOLE_R(3.0), INSOLE_R(3.0));
        set_up(&start, p, 5000000u);
        follow((double)q.x, (double)q.y, true);
        q = sample_vec3(&rng, INSOLE_R(30.0));
        insole_fix_t fix = fix_at((double)q.x, (double)q.y, (double)q.z, 20000000u), in_n;
        fix.var_x_m2 = sample_between(&rng, INSOLE_R(0.5), INSOLE_R(1.0));
        fix.var_y_m2 = sample_between(&rng, INSOLE_R(0.5), INSOLE_R(1.0));
        fix.cov_xy_m2 = sample_between(&rng, -INSOLE_R(0.5), INSOLE_R(0.5));
        fix.heading_rad = sample_between(&rng, -INSOLE_R(3.0), INSOLE_R(3.0));
        in_n = fix;
        map_directly(&anchor, &in_n, e);
        ck_assert_int_eq(insole_foot_anchor_to_map(&anchor, &fix), INSOLE_OK);
        worst_note(&place, fabs((double)fix.position_m.x - e[0]), i);
        worst_note(&place, fabs((double)fix.position_m.y - e[1]), i);
        worst_note(&place, fabs((double)fix.position_m.z - e[2]), i);
        worst_note(&cov, fabs((double)fix.var_x_m2 / e[3] - 1.0), i);
        worst_note(&cov, fabs((double)fix.var_y_m2 / e[5] - 1.0), i);
        worst_note(&cov, fabs((double)fix.cov_xy_m2 - e[4]) / sqrt(e[3] * e[5]), i);
        double turned = (double)in_n.heading_rad + (double)anchor.yaw_rad;
        worst_note(&heading, fabs(sin(0.5 * ((double)fix.heading_rad - turned))), i);
    }
    ASSERT_WORST(place, 5e-5, "m");
    ASSERT_WORST(cov, 1e-5, "of itself");
    ASSERT_WORST(heading, 1e-6, "half rad");
}
END_TEST

START_TEST(start_is_where_it_was_told)
{
    insole_fix_t fix = fix_at(7.0, 8.0, 9.0, 3000000u);
    fix.var_heading_rad2 = INSOLE_R(0.0);
    set_up(&START, at(7.0, 8.0, 9.0), 3000000u);
    (void)insole_foot_anchor_to_map(&anchor, &fix);
    ASSERT_NEAR(fix.position_m.x, 12.0, 1e-6, "m");
    ASSERT_NEAR(fix.position_m.y, -5.0, 1e-6, "m");
    ASSERT_NEAR(fix.position_m.z, 9.0, 1e-6, "m"); /* its height stays */
    ASSERT_NEAR(fix.var_x_m2, 0.25, 1e-6, "m2");
    ASSERT_NEAR(fix.var_y_m2, 0.25, 1e-6, "m2");
    ASSERT_NEAR(fix.var_heading_rad2, 0.01, 1e-7, "rad2");
}
END_TEST

START_TEST(heading_is_that_of_the_first_two_strides)
{
    set_up(&START, at(1.0, 1.0, 0.0), 3000000u);
    follow(1.2, 1.2, false); /* too short a way */
    ASSERT_NEAR(anchor.yaw_rad, 0.0, 0.0, "rad");
    follow(1.0, 1.7, false);
    ASSERT_NEAR(anchor.yaw_rad, 2.0 - 1.57079633, 1e-6, "rad");
    follow(2.0, 1.0, true);
    ASSERT_NEAR(anchor.yaw_rad, 2.0, 1e-6, "rad");
    follow(2.4, 2.4, true);
    ASSERT_NEAR(anchor.yaw_rad, 2.0 - 0.78539816, 1e-6, "rad");
    before = anchor;
    follow(-5.0, 3.0, true); /* the third says nothing */
    ck_assert_mem_eq(&anchor, &before, sizeof anchor);
}
END_TEST

START_TEST(start_without_heading_keeps_the_turn)
{
    insole_start_t place = START;
    place.has_heading = false;
    place.heading_rad = place.sigma_rad = (insole_real_t)NAN; /* nobody reads them */
    set_up(&START, at(0.0, 0.0, 0.0), 3000000u);
    follow(1.0, 0.0, true);
    ck_assert_int_eq(insole_foot_anchor_start(&anchor, &place, at(1.0, 0.0, 0.0), 9000000u),
                     INSOLE_OK);
    ASSERT_NEAR(anchor.yaw_rad, 2.0, 1e-6, "rad");
    ASSERT_NEAR(anchor.var_rad2, 0.01, 1e-7, "rad2");
    ck_assert_uint_eq(anchor.t_us, 3000000u); /* of the turn */
    follow(0.0, 3.0, true);
    ASSERT_NEAR(anchor.yaw_rad, 2.0, 1e-6, "rad");
}
END_TEST

START_TEST(renewed_anchor_leaves_the_place_and_widens_the_turn)
{
    insole_fix_t fix = fix_at(4.0, 0.0, 1.0, 10000000u), far;
    set_up(&START, at(0.0, 0.0, 0.0), 3000000u);
    follow(1.0, 0.0, true);
    (void)insole_foot_anchor_to_map(&anchor, &fix);
    ck_assert_int_eq(insole_foot_anchor_renew(&anchor, &fix, at(4.0, 0.0, 1.0), INSOLE_R(0.5)),
                     INSOLE_OK);
    far = fix_at(4.0, 0.0, 1.0, 10000000u);
    (void)insole_foot_anchor_to_map(&anchor, &far);
    ASSERT_NEAR(far.position_m.x, fix.position_m.x, 1e-6, "m");
    ASSERT_NEAR(far.position_m.y, fix.position_m.y, 1e-6, "m");
    ASSERT_NEAR(far.position_m.z, 1.0, 1e-6, "m");
    ASSERT_NEAR(far.var_x_m2, fmax((double)fix.var_x_m2, (double)fix.var_y_m2), 1e-6, "m2");
    ASSERT_NEAR(far.var_heading_rad2, (double)fix.var_heading_rad2 + 0.5, 1e-6, "rad2");
}
END_TEST

static void refuse_start(const insole_start_t *start)
{
    before = anchor;
    ck_assert_int_eq(insole_foot_anchor_check(start), INSOLE_ERR_VALUE);
    ck_assert_int_eq(insole_foot_anchor_start(&anchor, start, at(0.0, 0.0, 0.0), 4000000u),
                     INSOLE_ERR_VALUE);
    ck_assert_mem_eq(&anchor, &before, sizeof anchor);
}

START_TEST(bad_starts_are_refused)
{
    insole_start_t bad;
    insole_real_t *fields[] = {&bad.x_m, &bad.y_m, &bad.sigma_m, &bad.heading_rad, &bad.sigma_rad};
    const double outside[] = {(double)NAN, (double)INFINITY, -(double)INFINITY, 1.1e6, -1.1e6};
    set_up(&START, at(0.0, 0.0, 0.0), 3000000u);
    for (int i = 0; i < 25; i++) {
        bad = START;
        *fields[i / 5] = (insole_real_t)outside[i % 5];
        refuse_start(&bad);
    }
    bad = START;
    bad.sigma_m = INSOLE_R(-0.001);
    refuse_start(&bad);
    bad = START;
    bad.sigma_rad = INSOLE_R(-0.001);
    refuse_start(&bad);
    bad = START;
    bad.heading_rad = INSOLE_R(-100.1);
    refuse_start(&bad);
    ck_assert_int_eq(insole_foot_anchor_check(&START), INSOLE_OK);
}
END_TEST

START_TEST(other_bad_arguments_are_refused)
{
    insole_fix_t fix = fix_at(1.0, 2.0, 3.0, 0u), bad = fix;
    insole_vec3_t origin = insole_vec3_zero(), nowhere = at((double)NAN, 0.0, 0.0);
    insole_foot_anchor_t *a = &anchor;
    set_up(&START, origin, 3000000u);
    before = anchor;
    bad.var_x_m2 = (insole_real_t)INFINITY;
    ck_assert_int_eq(insole_foot_anchor_init(a, INSOLE_R(-1.0), 0u), INSOLE_ERR_VALUE);
    ck_assert_int_eq(insole_foot_anchor_init(a, (insole_real_t)NAN, 0u), INSOLE_ERR_VALUE);
    ck_assert_int_eq(insole_foot_anchor_start(a, &START, nowhere, 0u), INSOLE_ERR_VALUE);
    ck_assert_int_eq(insole_foot_anchor_start(a, NULL, origin, 0u), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_foot_anchor_follow(a, nowhere, true), INSOLE_ERR_VALUE);
    ck_assert_int_eq(insole_foot_anchor_renew(a, &fix, nowhere, INSOLE_R(0.0)), INSOLE_ERR_VALUE);
    ck_assert_int_eq(insole_foot_anchor_renew(a, &bad, origin, INSOLE_R(0.0)), INSOLE_ERR_VALUE);
    ck_assert_int_eq(insole_foot_anchor_renew(a, &fix, origin, INSOLE_R(-0.1)), INSOLE_ERR_VALUE);
    ck_assert_int_eq(insole_foot_anchor_renew(a, NULL, origin, INSOLE_R(0.0)), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_foot_anchor_to_map(a, NULL), INSOLE_ERR_NULL);
    ck_assert_mem_eq(&anchor, &before, sizeof anchor);
    bad = fix;
    ck_assert_int_eq(insole_foot_anchor_init(NULL, INSOLE_R(0.0), 0u), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_foot_anchor_start(NULL, &START, origin, 0u), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_foot_anchor_check(NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_foot_anchor_follow(NULL, origin, true), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_foot_anchor_renew(NULL, &fix, origin, INSOLE_R(0.0)), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_foot_anchor_to_map(NULL, &fix), INSOLE_ERR_NULL);
    insole_sym3_t P = insole_sym3_zero();
    ck_assert_int_eq(insole_foot_anchor_put(NULL, &origin, &P, &fix), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_foot_anchor_put(a, NULL, &P, &fix), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_foot_anchor_put(a, &origin, NULL, &fix), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_foot_anchor_put(a, &origin, &P, NULL), INSOLE_ERR_NULL);
    ck_assert_mem_eq(&fix, &bad, sizeof fix);
}
END_TEST

/* Place and covariance may come apart from the fix; its state, and what it held of them, is no
 * matter. */
START_TEST(what_comes_apart_is_put_alike)
{
    set_up(&START, at(1.0, 2.0, 3.0), 5000000u);
    follow(3.0, 1.0, true);
    insole_vec3_t place = at(4.0, -2.0, 0.5);
    insole_sym3_t P = {INSOLE_R(0.3), INSOLE_R(0.1), INSOLE_R(9.0),
                       INSOLE_R(0.2), INSOLE_R(8.0), INSOLE_R(0.4)};
    insole_fix_t whole = fix_at(4.0, -2.0, 0.5, 20000000u), put = fix_at(7.0, 7.0, 7.0, 20000000u);
    whole.heading_rad = put.heading_rad = INSOLE_R(0.7);
    whole.var_heading_rad2 = put.var_heading_rad2 = INSOLE_R(0.01);
    whole.var_x_m2 = P.xx;
    whole.cov_xy_m2 = P.xy;
    whole.var_y_m2 = P.yy;
    whole.var_z_m2 = P.zz;
    put.var_x_m2 = put.var_z_m2 = INSOLE_R(77.0);
    ck_assert_int_eq(insole_foot_anchor_to_map(&anchor, &whole), INSOLE_OK);
    ck_assert_int_eq(insole_foot_anchor_put(&anchor, &place, &P, &put), INSOLE_OK);
    ck_assert_mem_eq(&put, &whole, sizeof put);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("foot_anchor");
    suite_add(suite, "without a start", without_a_start_n_is_m);
    suite_add(suite, "drift", drift_widens_across_the_way);
    suite_add(suite, "map against direct one", position_and_covariance_against_direct_ones);
    suite_add(suite, "start", start_is_where_it_was_told);
    suite_add(suite, "heading of two strides", heading_is_that_of_the_first_two_strides);
    suite_add(suite, "start without heading", start_without_heading_keeps_the_turn);
    suite_add(suite, "apart", what_comes_apart_is_put_alike);
    suite_add(suite, "renewed anchor", renewed_anchor_leaves_the_place_and_widens_the_turn);
    suite_add(suite, "bad starts", bad_starts_are_refused);
    suite_add(suite, "other bad arguments", other_bad_arguments_are_refused);
    return suite;
}
