/* SPDX-License-Identifier: MIT */
#include "insole/fuse/step_cloud.h"

#include <string.h>

#include "filter_calls.h"
#include "near.h"
#include "plans.h"
#include "suite.h"

enum { MANY = 10000, WHOLE = 1 << 30 };

static drawing_t drawing;
static insole_particle_t particles[MANY];
static insole_spot_t bias[MANY];
static insole_step_cloud_t cloud;
static insole_rng_t rng;

static void begin(const insole_step_cloud_config_t *config, uint32_t count,
                  const insole_floor_plan_t *plan, uint64_t seed)
{
    const insole_cloud_t memory = {particles, count, NULL, 0, bias};
    ck_assert_int_eq(insole_step_cloud_init(&cloud, config, &memory, plan, seed), INSOLE_OK);
}

static void work(void)
{
    while (insole_step_cloud_work(&cloud, WHOLE)) {
    }
}

static void step(double length_m, double heading_rad)
{
    insole_pace_t pace = {(insole_real_t)length_m, (insole_real_t)heading_rad, 0, 0};
    ck_assert_int_eq(insole_step_cloud_step(&cloud, &pace), INSOLE_OK);
    work();
}

static insole_step_cloud_answer_t answer(void)
{
    insole_step_cloud_answer_t a;
    ck_assert_int_eq(insole_step_cloud_answer(&cloud, &a), INSOLE_OK);
    return a;
}

static void start_at(double x, double y, double sigma_m, double sigma_rad)
{
    insole_step_origin_t origin = {1000000u,
                                   {(insole_real_t)x, (insole_real_t)y},
                                   insole_sym2_circle((insole_real_t)(sigma_m * sigma_m)),
                                   0,
                                   (insole_real_t)(sigma_rad * sigma_rad),
                                   false};
    ck_assert_int_eq(insole_step_cloud_start(&cloud, &origin), INSOLE_OK);
    work();
}

static void tell_fix(double t_s, double x, double y, double variance_m2)
{
    insole_spot_fix_t fix = {(uint64_t)(t_s * 1e6),
                             {(insole_real_t)x, (insole_real_t)y},
                             insole_sym2_circle((insole_real_t)variance_m2),
                             {0, 0}};
    ck_assert_int_eq(insole_step_cloud_fix(&cloud, &fix), INSOLE_OK);
    work();
}

/* ---- zee: walls alone ---------------------------------------------------------------------- */

/* Corridors that no turn and no mirror takes into themselves. */
static void draw_corridors(void)
{
    static const double ring[] = {0, 0,  30, 0,  30, 2,  16, 2,  16, 14, 6, 14,
                                  6, 22, 4,  22, 4,  12, 14, 12, 14, 2,  0, 2};
    draw_begin(&drawing);
    draw_line(&drawing, INSOLE_LINE_OUTLINE, 6.0, ring, 12);
    ck_assert_int_eq(draw_build(&drawing), INSOLE_OK);
}

static const double legs[][2] = {{15.0, 1.0}, {15.0, 13.0}, {5.0, 13.0}, {5.0, 21.0}};
enum { LEGS = sizeof legs / sizeof legs[0] };

/* Walks a leg: what is told is turned, too short, and scatters. */
static void walk_leg(double *x, double *y, const double *to)
{
    static const double turned_rad = 2.1, scale = 1.07, length_m = 0.7;
    double way = hypot(to[0] - *x, to[1] - *y), heading = atan2(to[1] - *y, to[0] - *x);
    int steps = (int)(way / length_m);
    for (int i = 0; i < steps; i++) {
        insole_normals_t off = insole_rng_normals(&rng);
        step(way / steps / scale * (1.0 + 0.05 * (double)off.first),
             heading - turned_rad + 0.04 * (double)off.second);
    }
    *x = to[0];
    *y = to[1];
}

static double error_m(double x, double y)
{
    insole_step_cloud_answer_t a = answer();
    return hypot((double)a.spot.x_m - x, (double)a.spot.y_m - y);
}

START_TEST(three_turns_tell_place_direction_and_scale)
{
    double x = 28.0, y = 1.0;
    draw_corridors();
    insole_rng_seed(&rng, 100u + (uint64_t)_i);
    begin(&insole_step_cloud_zee, MANY, &drawing.plan, (uint64_t)_i + 1u);
    ck_assert_int_eq(insole_step_cloud_start_anywhere(&cloud), INSOLE_OK);
    work();
    ck_assert_msg(error_m(x, y) > 5.0, "known before anything was: %f m", error_m(x, y));
    for (int i = 0; i < LEGS; i++) {
        walk_leg(&x, &y, legs[i]);
    }
    insole_step_cloud_answer_t a = answer();
    ck_assert_msg(error_m(x, y) < 2.0, "after three turns %f m off", error_m(x, y));
    ASSERT_NEAR(a.offset_rad, 2.1, 0.15, "rad");
    ASSERT_NEAR(a.scale, 1.07, 0.1, "");
    ck_assert((double)(a.cov_m2.xx + a.cov_m2.yy) < 4.0);
}
END_TEST

START_TEST(all_of_the_plan_is_begun_with)
{
    double mean_x = 0.0, cos_sum = 0.0, sin_sum = 0.0;
    draw_corridors();
    begin(&insole_step_cloud_zee, MANY, &drawing.plan, 5u);
    ck_assert_int_eq(insole_step_cloud_start_anywhere(&cloud), INSOLE_OK);
    work();
    for (int i = 0; i < MANY; i++) {
        ck_assert(insole_floor_plan_inside(&drawing.plan, particles[i].x_m, particles[i].y_m));
        mean_x += (double)particles[i].x_m / MANY;
        cos_sum += cos((double)particles[i].offset_rad) / MANY;
        sin_sum += sin((double)particles[i].offset_rad) / MANY;
    }
    /* the rectangles' middles, by their areas: 60 x 15 + 24 x 15 + 20 x 9 + 16 x 5 */
    ASSERT_NEAR(mean_x, (60.0 * 15 + 24 * 15 + 20 * 9 + 16 * 5) / 120.0, 0.3, "m");
    ASSERT_NEAR(cos_sum, 0.0, 0.03, "");
    ASSERT_NEAR(sin_sum, 0.0, 0.03, "");
}
END_TEST

START_TEST(without_a_plan_nothing_can_be_begun)
{
    begin(&insole_step_cloud_zee, 100, NULL, 5u);
    insole_step_cloud_t before;
    memcpy(&before, &cloud, sizeof before);
    before.refused++;
    ck_assert_int_eq(insole_step_cloud_start_anywhere(&cloud), INSOLE_ERR_STATE);
    ck_assert_mem_eq(&cloud, &before, sizeof cloud);
    ck_assert_int_eq(insole_step_cloud_start_anywhere(NULL), INSOLE_ERR_NULL);
}
END_TEST

START_TEST(a_start_anywhere_drops_what_waits)
{
    draw_corridors();
    begin(&insole_step_cloud_zee, 1000, &drawing.plan, 5u);
    start_at(28.0, 1.0, 0.1, 0.1);
    insole_pace_t pace = {INSOLE_R(0.7), 0, 0, 0};
    ck_assert_int_eq(insole_step_cloud_step(&cloud, &pace), INSOLE_OK);
    ck_assert_int_eq(insole_step_cloud_start_anywhere(&cloud), INSOLE_OK);
    work();
    ck_assert_uint_eq(answer().waiting, 0u);
    ck_assert((double)answer().cov_m2.xx > 20.0);
}
END_TEST

START_TEST(fixes_are_passed_over)
{
    const insole_step_filter_calls_t *calls = &insole_step_cloud_zee_calls;
    insole_spot_fix_t fix = {2000000u, {4, 13}, insole_sym2_circle(1), {0, 0}};
    draw_corridors();
    begin(&insole_step_cloud_zee, 1000, &drawing.plan, 5u);
    ck_assert_int_eq(calls->start_anywhere(&cloud, 1000000u), INSOLE_OK);
    work();
    insole_step_cloud_t before;
    memcpy(&before, &cloud, sizeof before);
    ck_assert_int_eq(calls->fix(&cloud, &fix), INSOLE_OK);
    ck_assert_mem_eq(&cloud, &before, sizeof cloud);
    ck_assert(insole_step_cloud_calls.start_anywhere == NULL);
}
END_TEST

START_TEST(its_table_does_as_others)
{
    draw_corridors();
    begin(&insole_step_cloud_zee, 100, &drawing.plan, 5u);
    check_filter_calls(&insole_step_cloud_zee_calls, &cloud);
    ck_assert_int_eq(insole_step_cloud_zee_calls.start_anywhere(NULL, 0u), INSOLE_ERR_NULL);
}
END_TEST

START_TEST(a_compass_is_listened_to)
{
    draw_corridors();
    begin(&insole_step_cloud_zee, MANY, &drawing.plan, 5u);
    ck_assert_int_eq(insole_step_cloud_start_anywhere(&cloud), INSOLE_OK);
    for (int i = 0; i < 10; i++) {
        ck_assert_int_eq(insole_step_cloud_zee_calls.compass(&cloud, INSOLE_R(-1.2), INSOLE_R(0.5)),
                         INSOLE_OK);
    }
    work();
    ASSERT_NEAR(answer().offset_rad, -1.2, 0.05, "rad");
}
END_TEST

/* ---- wpf: the likeliest fingerprint, and walls --------------------------------------------- */

/* One fix and a normal cloud: the product of two normal densities, whatever the fix says of its
 * covariance. */
START_TEST(one_length_counts_for_all_fixes)
{
    static const double told_m2[] = {0.01, 100.0};
    insole_step_cloud_config_t config = insole_step_cloud_wpf;
    config.sigma_fix_m = 3;
    config.particles.resample_share = 0;
    begin(&config, MANY, NULL, 7u);
    start_at(10.0, 20.0, 4.0, 0.0);
    tell_fix(2.0, 14.0, 20.0, told_m2[_i]);
    insole_step_cloud_answer_t a = answer();
    ASSERT_NEAR(a.spot.x_m, 10.0 + 4.0 * 16.0 / 25.0, 0.15, "m");
    ASSERT_NEAR(a.spot.y_m, 20.0, 0.15, "m");
    ASSERT_NEAR(a.cov_m2.xx, 16.0 * 9.0 / 25.0, 0.3, "m^2");
}
END_TEST

/* w^u w^(u-1): two fixes are as one of half the variance between them. */
START_TEST(weights_are_multiplied)
{
    insole_step_cloud_config_t config = insole_step_cloud_wpf;
    config.sigma_fix_m = 3;
    config.particles.resample_share = 0;
    begin(&config, MANY, NULL, 7u);
    start_at(0.0, 0.0, 4.0, 0.0);
    tell_fix(2.0, 3.0, 0.0, 1.0);
    tell_fix(3.0, 5.0, 0.0, 1.0);
    ASSERT_NEAR(answer().spot.x_m, 4.0 * 16.0 / (16.0 + 4.5), 0.15, "m");
    ASSERT_NEAR(answer().cov_m2.yy, 16.0 * 4.5 / 20.5, 0.3, "m^2");
}
END_TEST

/* In a corridor the cloud keeps between its walls, unless they are off. */
START_TEST(who_crosses_a_wall_is_dead)
{
    insole_step_cloud_config_t config = insole_step_cloud_wpf;
    draw_corridors();
    config.particles.walls = _i == 0 ? INSOLE_WALLS_CROSSES : INSOLE_WALLS_OFF;
    ck_assert_int_eq(insole_step_cloud_wpf.particles.walls, INSOLE_WALLS_CROSSES);
    begin(&config, 2000, &drawing.plan, 7u);
    start_at(2.0, 1.0, 0.3, 0.3);
    for (int i = 0; i < 30; i++) {
        step(0.7, 0.0);
    }
    uint32_t outside = 0u;
    for (int i = 0; i < 2000; i++) {
        const insole_particle_t *p = &particles[i];
        outside +=
            insole_particle_lives(p) && !insole_floor_plan_inside(&drawing.plan, p->x_m, p->y_m)
                ? 1u
                : 0u;
    }
    ck_assert_msg(_i == 0 ? outside == 0u : outside > 500u, "%u outside", outside);
}
END_TEST

/* Settings of a constant covariance are refused out of their range. */
START_TEST(the_length_of_a_fix_is_checked)
{
    static const double bad[] = {0.0, -1.0, 1001.0};
    const insole_cloud_t memory = {particles, 100, NULL, 0, bias};
    insole_step_cloud_config_t config = insole_step_cloud_wpf;
    config.sigma_fix_m = (insole_real_t)bad[_i];
    insole_step_cloud_t before;
    memcpy(&before, &cloud, sizeof before);
    ck_assert_int_eq(insole_step_cloud_init(&cloud, &config, &memory, NULL, 1u), INSOLE_ERR_VALUE);
    config.sigma_fix_m = 1;
    config.measurement = 2;
    ck_assert_int_eq(insole_step_cloud_init(&cloud, &config, &memory, NULL, 1u), INSOLE_ERR_VALUE);
    ck_assert_mem_eq(&cloud, &before, sizeof cloud);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("step_cloud_rivals");
    suite_add_loop(suite, "three turns", three_turns_tell_place_direction_and_scale, 8);
    suite_add(suite, "anywhere", all_of_the_plan_is_begun_with);
    suite_add(suite, "no plan", without_a_plan_nothing_can_be_begun);
    suite_add(suite, "anew", a_start_anywhere_drops_what_waits);
    suite_add(suite, "fixes", fixes_are_passed_over);
    suite_add(suite, "calls", its_table_does_as_others);
    suite_add(suite, "compass", a_compass_is_listened_to);
    suite_add_loop(suite, "one length", one_length_counts_for_all_fixes, 2);
    suite_add(suite, "product", weights_are_multiplied);
    suite_add_loop(suite, "walls", who_crosses_a_wall_is_dead, 2);
    suite_add_loop(suite, "range", the_length_of_a_fix_is_checked, 3);
    return suite;
}
