/* SPDX-License-Identifier: MIT */
#include "insole/fuse/step_weighing.h"

#include <string.h>

#include "fingerprints.h"
#include "plans.h"
#include "refusal.h"
#include "suite.h"

enum { N = 300 };

static drawing_t drawing;
static prints_t prints;
static insole_real_t log_weights[PRINTS_POINTS];
static insole_rss_weigh_t rss;
static insole_rng_t rng;
static insole_particle_t particles[N];
static insole_spot_t bias[N];
static const insole_cloud_t cloud = {particles, N, NULL, 0, bias};
static insole_particle_filter_config_t config;
static insole_step_weighing_t steps;
static insole_weighing_t weighing;
static insole_rss_field_t field; /* there are no scans */
static insole_evidence_t news;
static insole_spot_fix_t fix;

static double uniform(double low, double high)
{
    return draw_uniform(&rng, low, high);
}

static void begin(uint64_t seed)
{
    insole_rng_seed(&rng, seed);
    config = insole_particle_filter_phone;
    ck_assert_int_eq(insole_step_weighing_init(&steps, &config), INSOLE_OK);
    memset(&weighing, 0, sizeof weighing);
    insole_weighing_begin(&weighing);
    insole_evidence_clear(&news);
    for (uint32_t i = 0; i < N; i++) {
        insole_particle_t p = {(insole_real_t)uniform(1, 19), (insole_real_t)uniform(1, 9),
                               (insole_real_t)uniform(-3, 3), (insole_real_t)uniform(0.8, 1.2),
                               (insole_real_t)uniform(-3, 0)};
        particles[i] = p;
        bias[i] = insole_spot((insole_real_t)uniform(-4, 4), (insole_real_t)uniform(-4, 4));
    }
    draw_begin(&drawing);
    draw_box(&drawing, INSOLE_LINE_OUTLINE, 4.0, 0.0, 0.0, 20.0, 10.0);
    draw_box(&drawing, INSOLE_LINE_HOLE, 4.0, 7.0, 2.0, 14.0, 8.0);
    ck_assert_int_eq(draw_build(&drawing), INSOLE_OK);
}

static void tell_fix(double t_s)
{
    insole_spot_fix_t told = {
        (uint64_t)(t_s * 1e6), {8, 3}, {9, 2, 6}, {INSOLE_R(1.2), INSOLE_R(-0.7)}};
    fix = told;
    ck_assert_int_eq(insole_evidence_fix(&news, &fix), INSOLE_OK);
}

static void tell_stride(void)
{
    ck_assert_int_eq(insole_evidence_stride(&news, INSOLE_R(0.7), INSOLE_R(0.4), 0), INSOLE_OK);
    weighing.news = news;
    weighing.stride = insole_particle_config_stride(&config, &news);
}

static void tell_rss(void)
{
    static insole_rss_t readings[20];
    prints_begin(&prints);
    for (int i = 0; i < 30; i++) {
        prints_point(&prints, uniform(0, 20), uniform(0, 10));
        for (uint32_t ap = 0; ap < 20; ap++) {
            prints_entry(&prints, ap, uniform(-90, -40), 3.0);
        }
    }
    for (uint32_t i = 0; i < 20; i++) {
        insole_rss_t reading = {i, (insole_real_t)uniform(-90, -40), 0};
        readings[i] = reading;
    }
    ck_assert_int_eq(
        insole_rss_weigh_begin(&rss, &prints.map, log_weights, PRINTS_POINTS, -95, readings, 20),
        INSOLE_OK);
    insole_rss_weigh_work(&rss, 1000);
    ck_assert_int_eq(insole_evidence_rss(&news, &rss, insole_spot(INSOLE_R(0.5), 2)), INSOLE_OK);
}

static void take(void)
{
    ck_assert_int_eq(insole_step_weighing_begin(&steps, &config, &news, true, true), INSOLE_OK);
}

static void weigh_all(void)
{
    insole_step_weighing_weigh(&steps, &drawing.plan, &cloud, 0, N);
    insole_weighing_weigh(&weighing, &field, &cloud, 0, N);
}

/* Before the stride was told: without its noise a particle goes straight. */
static void move_all(void)
{
    insole_weighing_move(&weighing, &field, &drawing.plan, &cloud, 0, N, &rng);
    insole_step_weighing_look(&steps, &drawing.plan, &cloud, 0, N);
}

/* Weight and bias of a particle by a first fix, in double: S = R + 3.5^2 I. */
static double fix_by_double(const insole_particle_t *p, double heading_rad, insole_spot_t *b)
{
    double a = (double)p->offset_rad, s = (double)p->scale, pb = 3.5 * 3.5;
    double wx = cos(a) * 1.2 + sin(a) * 0.7, wy = sin(a) * 1.2 - cos(a) * 0.7;
    double x = (double)p->x_m - s * wx + cos(a + heading_rad);
    double y = (double)p->y_m - s * wy + sin(a + heading_rad);
    double vx = 8.0 - x - (double)b->x_m, vy = 3.0 - y - (double)b->y_m;
    double xx = 9.0 + pb, xy = 2.0, yy = 6.0 + pb, det = xx * yy - xy * xy;
    double ux = (yy * vx - xy * vy) / det, uy = (xx * vy - xy * vx) / det;
    double right = exp(-0.5 * (vx * ux + vy * uy)), share = right / (right + 0.01);
    b->x_m += (insole_real_t)(share * pb * ux);
    b->y_m += (insole_real_t)(share * pb * uy);
    return log(right + 0.01);
}

static bool closed_by_double(const insole_particle_t *p)
{
    double x = (double)p->x_m, y = (double)p->y_m;
    bool deep = x > 8 && x < 13 && y > 3 && y < 7;
    return deep || x < -1 || x > 21 || y < -1 || y > 11;
}

static double rss_by_double(const insole_particle_t *p)
{
    double a = (double)p->offset_rad, s = (double)p->scale, least = HUGE_VAL;
    double x = (double)p->x_m - s * (cos(a) * 0.5 - sin(a) * 2.0);
    double y = (double)p->y_m - s * (sin(a) * 0.5 + cos(a) * 2.0);
    uint32_t nearest = 0;
    for (uint32_t i = 0; i < prints.map.point_count; i++) {
        double m = hypot((double)prints.spots[i].x_m - x, (double)prints.spots[i].y_m - y);
        nearest = m < least ? i : nearest;
        least = fmin(least, m);
    }
    return (double)log_weights[nearest];
}

/* All that can be told at once; each particle's weight and bias computed anew in double. */
START_TEST(weights_by_double)
{
    static insole_particle_t before[N];
    static insole_spot_t bias_before[N];
    worst_t weight = {0, 0}, mean = {0, 0};
    begin(1u + (uint64_t)_i);
    tell_fix(3.0);
    tell_rss();
    ck_assert_int_eq(insole_evidence_compass(&news, 2, INSOLE_R(0.8)), INSOLE_OK);
    tell_stride();
    take();
    move_all();
    memcpy(before, particles, sizeof before);
    memcpy(bias_before, bias, sizeof bias);
    weighing.common_log = INSOLE_R(-0.3);
    weigh_all();
    for (uint32_t i = 0; i < N; i++) {
        const insole_particle_t *p = &before[i];
        double off = remainder((double)p->offset_rad - 2.0, 6.283185307179586);
        double expected = (double)p->log_weight + 0.3 - 0.5 * pow(off / 0.8, 2.0) +
                          fix_by_double(p, 0.4, &bias_before[i]) + rss_by_double(p) +
                          (closed_by_double(p) ? log(0.2) : 0.0);
        worst_note(&weight, fabs((double)particles[i].log_weight - expected), i);
        worst_note(&mean,
                   hypot((double)(bias[i].x_m - bias_before[i].x_m),
                         (double)(bias[i].y_m - bias_before[i].y_m)),
                   i);
    }
    ASSERT_WORST(weight, 2e-5, "");
    ASSERT_WORST(mean, 1e-5, "m");
    ck_assert(insole_weighing_has_survivors(&weighing));
}
END_TEST

/* Offset, scale and place after a step, and how far they scatter. */
START_TEST(a_step_scatters_as_it_is_set)
{
    enum { M = 20000 };
    double sum[4] = {0}, square[4] = {0}, cross = 0.0;
    begin(7u);
    tell_stride();
    take();
    ck_assert(weighing.stride.is_apart && steps.looks && steps.is_told);
    for (int i = 0; i < M; i++) {
        insole_particle_t p = {0, 0, INSOLE_R(-0.4), 1, 0}; /* walks along x */
        const insole_cloud_t one = {&p, 1, NULL, 0, NULL};
        insole_weighing_move(&weighing, &field, NULL, &one, 0, 1, &rng);
        double is[4] = {(double)p.x_m - 0.7, (double)p.y_m, (double)p.offset_rad + 0.4,
                        (double)p.scale - 1.0};
        for (int k = 0; k < 4; k++) {
            sum[k] += is[k] / M;
            square[k] += is[k] * is[k] / M;
        }
        cross += is[0] * is[3] / M;
    }
    const double sigmas[4] = {0.21, hypot(0.7, 0.21) * hypot(0.07, 0.0436), 0.0436, 0.005};
    for (int k = 0; k < 4; k++) {
        ASSERT_NEAR(sum[k], k == 0 ? -0.7 * 0.5 * (0.07 * 0.07 + 0.0436 * 0.0436) : 0.0,
                    4.0 * sigmas[k] / sqrt(M), "");
        ASSERT_NEAR(sqrt(square[k]), sigmas[k], 0.03 * sigmas[k], "");
    }
    ASSERT_NEAR(cross / (0.21 * 0.005), 0.0, 0.03, ""); /* apart */
}
END_TEST

START_TEST(the_dead_are_left_alone)
{
    begin(2u);
    tell_fix(1.0);
    tell_stride();
    take();
    particles[3].log_weight = INSOLE_PARTICLE_DEAD;
    insole_particle_t before = particles[3];
    insole_spot_t bias_before = bias[3];
    insole_rng_t rng_before = rng;
    insole_weighing_move(&weighing, &field, &drawing.plan, &cloud, 3, 4, &rng);
    insole_step_weighing_look(&steps, &drawing.plan, &cloud, 3, 4);
    insole_step_weighing_weigh(&steps, &drawing.plan, &cloud, 3, 4);
    ck_assert_mem_eq(&particles[3], &before, sizeof before);
    ck_assert_mem_eq(&bias[3], &bias_before, sizeof bias_before);
    ck_assert_mem_eq(&rng, &rng_before, sizeof rng);
    ck_assert_uint_eq(steps.soft.seen, 0u);
}
END_TEST

/* Only what is told is done. */
START_TEST(nothing_told_changes_nothing)
{
    static insole_particle_t before[N];
    begin(3u);
    take();
    ck_assert(!steps.is_told);
    memcpy(before, particles, sizeof before);
    move_all();
    weigh_all();
    ck_assert_mem_eq(particles, before, sizeof before);
    ck_assert_int_eq(insole_step_weighing_begin(&steps, &config, &news, true, false), INSOLE_OK);
    tell_stride();
    ck_assert_int_eq(insole_step_weighing_begin(&steps, &config, &news, true, false), INSOLE_OK);
    ck_assert(!steps.looks && !steps.is_told && weighing.stride.is_apart);
    config.scatter = INSOLE_SCATTER_SHARED;
    tell_stride();
    ck_assert(!weighing.stride.is_apart);
}
END_TEST

/* Ahead means where the last step went, although no step is told with the fix. */
START_TEST(a_fix_without_a_step_knows_the_last_heading)
{
    begin(4u);
    tell_stride();
    take();
    insole_evidence_clear(&news);
    tell_fix(2.0);
    take();
    insole_particle_t p = {1, 2, INSOLE_R(0.5), 1, 0};
    insole_spot_t b = {0, 0}, expected = {0, 0};
    particles[0] = p;
    bias[0] = b;
    insole_step_weighing_weigh(&steps, NULL, &cloud, 0, 1);
    ASSERT_NEAR(particles[0].log_weight, fix_by_double(&p, 0.4, &expected), 1e-5, "");
    ASSERT_NEAR(bias[0].x_m, expected.x_m, 1e-5, "m");
    ASSERT_NEAR(bias[0].y_m, expected.y_m, 1e-5, "m");
}
END_TEST

START_TEST(a_start_sets_the_biases)
{
    begin(5u);
    insole_spot_fix_t at = {1, {10, 5}, {INSOLE_R(12.25), 0, INSOLE_R(36.75)}, {0, 0}};
    ck_assert_int_eq(insole_step_weighing_start(&steps, &at, true), INSOLE_OK);
    particles[0].x_m = 6;
    particles[0].y_m = 9;
    insole_step_weighing_drawn(&steps, &cloud, 0); /* gains 1/2 and 1/4 */
    ASSERT_NEAR(bias[0].x_m, 2.0, 1e-6, "m");
    ASSERT_NEAR(bias[0].y_m, -1.0, 1e-6, "m");
    ck_assert_int_eq(insole_step_weighing_start(&steps, NULL, false), INSOLE_OK);
    insole_step_weighing_drawn(&steps, &cloud, 0);
    ASSERT_NEAR(bias[0].x_m, 0.0, 0.0, "m");
    insole_cloud_t none = {particles, N, NULL, 0, NULL};
    insole_step_weighing_drawn(&steps, &none, 0);
}
END_TEST

START_TEST(bad_input_changes_nothing)
{
    begin(6u);
    tell_fix(2.0);
    take();
    ASSERT_UNCHANGED(steps, insole_step_weighing_begin(&steps, &config, &news, true, true),
                     INSOLE_ERR_TIME);
    fix.cov_m2.xx = -1;
    ASSERT_UNCHANGED(steps, insole_step_weighing_start(&steps, &fix, true), INSOLE_ERR_VALUE);
    ck_assert_int_eq(insole_step_weighing_init(NULL, &config), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_step_weighing_init(&steps, NULL), INSOLE_ERR_NULL);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("step_weighing");
    suite_add_loop(suite, "by double", weights_by_double, 4);
    suite_add(suite, "scatter", a_step_scatters_as_it_is_set);
    suite_add(suite, "dead", the_dead_are_left_alone);
    suite_add(suite, "nothing told", nothing_told_changes_nothing);
    suite_add(suite, "last heading", a_fix_without_a_step_knows_the_last_heading);
    suite_add(suite, "start", a_start_sets_the_biases);
    suite_add(suite, "bad input", bad_input_changes_nothing);
    return suite;
}
