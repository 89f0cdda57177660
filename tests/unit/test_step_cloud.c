/* SPDX-License-Identifier: MIT */
#include "insole/fuse/step_cloud.h"

#include <string.h>

#include "filter_calls.h"
#include "fingerprints.h"
#include "plans.h"
#include "refusal.h"
#include "sample.h"
#include "suite.h"

enum { N = 500, MANY = 40000, WHOLE = 1 << 30 };

static drawing_t drawing;
static insole_particle_t particles[MANY];
static insole_spot_t bias[MANY];
static insole_step_cloud_t cloud;
static insole_rng_t rng;

static void begin(const insole_step_cloud_config_t *config, uint32_t count,
                  const insole_floor_plan_t *plan)
{
    const insole_cloud_t memory = {particles, count, NULL, 0, bias};
    ck_assert_int_eq(insole_step_cloud_init(&cloud, config, &memory, plan, 42u), INSOLE_OK);
}

static insole_step_origin_t origin_at(double x, double y, double sigma_m, double offset,
                                      double sigma_rad, bool is_radio)
{
    insole_step_origin_t origin = {1000000u,
                                   {(insole_real_t)x, (insole_real_t)y},
                                   insole_sym2_circle((insole_real_t)(sigma_m * sigma_m)),
                                   (insole_real_t)offset,
                                   (insole_real_t)(sigma_rad * sigma_rad),
                                   is_radio};
    return origin;
}

static void work(uint32_t slice)
{
    uint32_t rounds = 0;
    while (insole_step_cloud_work(&cloud, slice)) {
        ck_assert_uint_le(++rounds, 1000000u);
    }
}

static void start(double x, double y, double sigma_m, double offset, double sigma_rad,
                  bool is_radio)
{
    insole_step_origin_t origin = origin_at(x, y, sigma_m, offset, sigma_rad, is_radio);
    ck_assert_int_eq(insole_step_cloud_start(&cloud, &origin), INSOLE_OK);
    work(WHOLE);
}

static void step(double length_m, double heading_rad)
{
    insole_pace_t pace = {(insole_real_t)length_m, (insole_real_t)heading_rad, 0, 0};
    ck_assert_int_eq(insole_step_cloud_step(&cloud, &pace), INSOLE_OK);
}

static insole_spot_fix_t fix_of(double t_s, double x, double y, double variance)
{
    insole_spot_fix_t fix = {(uint64_t)(t_s * 1e6),
                             {(insole_real_t)x, (insole_real_t)y},
                             insole_sym2_circle((insole_real_t)variance),
                             {0, 0}};
    return fix;
}

static void tell_fix(const insole_spot_fix_t *fix)
{
    ck_assert_int_eq(insole_step_cloud_fix(&cloud, fix), INSOLE_OK);
}

static insole_step_cloud_answer_t answer(void)
{
    insole_step_cloud_answer_t a;
    ck_assert_int_eq(insole_step_cloud_answer(&cloud, &a), INSOLE_OK);
    return a;
}

/* ---- linear and normal all along: a Kalman filter of place and bias, in double ---- */

/* One axis: x and y are alike and independent, as strides go along the one or the other. */
typedef struct {
    double p, b, pp, pb, bb;
} axis_t;

static axis_t axis_begin(double at, double variance, bool is_radio, double bias_m2)
{
    axis_t a = {at, 0.0, variance, 0.0, bias_m2};
    if (is_radio) {
        a.pp += bias_m2;
        a.pb = -bias_m2;
    }
    return a;
}

static void axis_walk(axis_t *a, double way, double variance)
{
    a->p += way;
    a->pp += variance;
}

static void axis_fix(axis_t *a, double z, double r, double dt_s, double sigma_m, double time_s)
{
    double e = exp(-dt_s / time_s);
    a->b *= e;
    a->pb *= e;
    a->bb = e * e * a->bb + (1.0 - e * e) * sigma_m * sigma_m;
    double hp = a->pp + a->pb, hb = a->pb + a->bb, s = hp + hb + r, v = z - a->p - a->b;
    a->p += hp / s * v;
    a->b += hb / s * v;
    a->pp -= hp * hp / s;
    a->pb -= hp * hb / s;
    a->bb -= hb * hb / s;
}

static insole_step_cloud_config_t linear_config(void)
{
    insole_step_cloud_config_t config = insole_step_cloud_defaults;
    config.particles.sigma_heading_rad = 0;
    config.particles.sigma_wander_rad = 0;
    config.particles.sigma_scale = 0;
    config.particles.scale_memory = 1;
    config.particles.fix_floor = 0;
    config.particles.fix_ahead_m = 0;
    config.particles.resample_share = INSOLE_R(0.9);
    return config;
}

/* The cloud's own mean of the biases. */
static double mean_bias_x(void)
{
    double sum = 0.0, weights = 0.0;
    for (int i = 0; i < MANY; i++) {
        double w = exp((double)(particles[i].log_weight - particles[0].log_weight));
        sum += w * (double)bias[i].x_m;
        weights += w;
    }
    return sum / weights;
}

static const bool starts[] = {false, true};

START_TEST(many_particles_are_the_kalman_filter)
{
    insole_step_cloud_config_t config = linear_config();
    bool is_radio = starts[_i];
    double var0 = is_radio ? 9.0 : 0.25, t_s = 1.0, along = 0.3 * 0.8;
    axis_t x = axis_begin(10.0, var0, is_radio, 12.25), y = x;
    insole_rng_seed(&rng, 3u);
    begin(&config, MANY, NULL);
    start(10.0, 10.0, sqrt(var0), 0.0, 0.0, is_radio);
    for (int k = 0; k < 8; k++) {
        for (int s = 0; s < 3; s++) {
            step(0.8, 0.0);
            axis_walk(&x, 0.8, along * along);
            step(0.8, 1.5707963267948966);
            axis_walk(&y, 0.8, along * along);
            work(WHOLE);
        }
        t_s += 2.5;
        insole_spot_fix_t fix = fix_of(t_s, 12.0 + 2.4 * k, 9.0 + 2.4 * k, 8.0);
        tell_fix(&fix);
        work(WHOLE);
        axis_fix(&x, 12.0 + 2.4 * k, 8.0, 2.5, 3.5, 15.0);
        axis_fix(&y, 9.0 + 2.4 * k, 8.0, 2.5, 3.5, 15.0);
        insole_step_cloud_answer_t a = answer();
        ASSERT_NEAR(a.spot.x_m, x.p, 0.05 * sqrt(x.pp), "m");
        ASSERT_NEAR(a.spot.y_m, y.p, 0.05 * sqrt(y.pp), "m");
        ASSERT_NEAR(a.cov_m2.xx, x.pp, 0.06 * x.pp, "m2");
        ASSERT_NEAR(a.cov_m2.yy, y.pp, 0.06 * y.pp, "m2");
        ASSERT_NEAR(a.cov_m2.xy, 0.0, 0.04 * x.pp, "m2");
        ASSERT_NEAR(mean_bias_x(), x.b, 0.05 * sqrt(x.bb), "m");
    }
    ck_assert(!is_radio || cloud.filter.counts.resampled > 0u);
}
END_TEST

/* A compass sees the offset: the product of two normals. */
START_TEST(a_compass_tells_the_offset)
{
    insole_step_cloud_config_t config = linear_config();
    begin(&config, MANY, NULL);
    start(0, 0, 0.5, 3.0, 0.5, false);
    ck_assert_int_eq(
        insole_step_cloud_compass(&cloud, INSOLE_R(-3.0), INSOLE_R(0.8)), /* 0.2832 beyond */
        INSOLE_OK);
    work(WHOLE);
    double gain = 0.25 / (0.25 + 0.64);
    insole_step_cloud_answer_t a = answer();
    ASSERT_NEAR(remainder((double)a.offset_rad - 3.0 - gain * 0.283185, 6.283185307), 0.0, 0.01,
                "rad");
    ASSERT_NEAR(a.var_offset_rad2, (1.0 - gain) * 0.25, 0.005, "rad2");
}
END_TEST

/* Fixes along the way of a walk that goes off by 0.6 rad turn the cloud. */
START_TEST(fixes_find_offset_and_scale)
{
    insole_rng_seed(&rng, 5u);
    begin(&insole_step_cloud_defaults, 2000, NULL);
    start(0, 0, 0.5, 0.0, 0.5, false);
    double x = 0.0, y = 0.0, b[2] = {0, 0};
    for (int k = 1; k <= 300; k++) {
        double heading = k % 100 < 50 ? 0.0 : 2.0;
        x += 0.77 * cos(heading + 0.6);
        y += 0.77 * sin(heading + 0.6);
        step(0.7, heading);
        if (k % 4 == 0) {
            for (int i = 0; i < 2; i++) {
                b[i] = 0.87 * b[i] + 1.0 * (double)insole_rng_normal(&rng);
            }
            insole_spot_fix_t fix = fix_of(
                1.0 + 0.5 * k, x + cos(heading + 0.6) + b[0] + (double)insole_rng_normal(&rng),
                y + sin(heading + 0.6) + b[1] + (double)insole_rng_normal(&rng), 4.0);
            tell_fix(&fix);
        }
        work(WHOLE);
    }
    insole_step_cloud_answer_t a = answer();
    ASSERT_NEAR(a.spot.x_m, x, 3.0, "m");
    ASSERT_NEAR(a.spot.y_m, y, 3.0, "m");
    ASSERT_NEAR(a.offset_rad, 0.6, 0.15, "rad");
    ASSERT_NEAR(a.scale, 1.1, 0.1, "");
}
END_TEST

/* ---- walls ---- */

/* A corridor of 40 m x 3 m, closed at x = 20 by a block of 4 m: its door is not in the plan. */
static void draw_corridor(bool with_block)
{
    draw_begin(&drawing);
    draw_box(&drawing, INSOLE_LINE_OUTLINE, 4.0, 0.0, 0.0, 40.0, 3.0);
    if (with_block) {
        draw_box(&drawing, INSOLE_LINE_HOLE, 4.0, 18.0, -1.0, 22.0, 4.0);
    }
    ck_assert_int_eq(draw_build(&drawing), INSOLE_OK);
}

/* A walk from x = 2 m to 38 m along the corridor, told so much off. */
static insole_spot_t walk_corridor(int32_t walls, const insole_floor_plan_t *plan, double off_rad)
{
    insole_step_cloud_config_t config = insole_step_cloud_defaults;
    config.particles.walls = walls;
    begin(&config, N, plan);
    start(2.0, 1.5, 0.5, 0.0, 0.2, false);
    for (int k = 0; k < 48; k++) {
        step(0.75, off_rad);
        work(WHOLE);
    }
    return answer().spot;
}

START_TEST(a_missing_door_is_walked_through)
{
    draw_corridor(true);
    ASSERT_AT_LEAST(walk_corridor(INSOLE_WALLS_SOFT, &drawing.plan, 0.0).x_m, 34.0, "m");
    ck_assert_uint_eq(cloud.filter.counts.recovered, 0u);
    ASSERT_AT_MOST(walk_corridor(INSOLE_WALLS_CROSSES, &drawing.plan, 0.0).x_m, 18.0, "m");
}
END_TEST

START_TEST(walls_hold_the_direction)
{
    draw_corridor(false);
    insole_spot_t with = walk_corridor(INSOLE_WALLS_SOFT, &drawing.plan, 0.12);
    ASSERT_NEAR(with.y_m, 1.5, 1.0, "m");
    ASSERT_NEAR(answer().offset_rad, -0.12, 0.1, "rad");
    insole_spot_t without = walk_corridor(INSOLE_WALLS_SOFT, NULL, 0.12);
    ASSERT_AT_LEAST(without.y_m, 1.5 + 3.0, "m");
}
END_TEST

/* ---- slices and the queue ---- */

static insole_particle_t particles_after[N];
static insole_spot_t bias_after[N];

/* All kinds of news; the work is done in slices of so many, or 0: only as the queue is full. */
static void make_walk(uint32_t slice)
{
    draw_corridor(true);
    memset(&cloud, 0, sizeof cloud);
    memset(particles, 0, sizeof particles);
    memset(bias, 0, sizeof bias);
    begin(&insole_step_cloud_defaults, N, &drawing.plan);
    insole_step_origin_t origin = origin_at(2.0, 1.5, 2.0, 0.1, 0.3, true);
    ck_assert_int_eq(insole_step_cloud_start(&cloud, &origin), INSOLE_OK);
    for (int k = 1; k <= 50; k++) {
        step(0.72, 0.01 * k);
        if (k % 4 == 0) {
            insole_spot_fix_t fix = fix_of(1.0 + 0.5 * k, 2.0 + 0.72 * k, 1.0 + k % 3, 9.0);
            fix.since = insole_spot(INSOLE_R(0.7), INSOLE_R(0.1));
            tell_fix(&fix);
        }
        if (k % 5 == 0) {
            ck_assert_int_eq(insole_step_cloud_compass(&cloud, INSOLE_R(0.2), INSOLE_R(0.8)),
                             INSOLE_OK);
        }
        if (slice > 0) {
            for (int i = 0; i < k % 7; i++) {
                insole_step_cloud_work(&cloud, slice);
            }
        }
    }
    work(slice > 0 ? slice : WHOLE);
}

static const uint32_t slices[] = {0, 1, 7, 333, 499, 500, 501, 5000};

START_TEST(slices_and_bursts_give_the_same_bits)
{
    make_walk(WHOLE);
    insole_step_cloud_answer_t expected = answer();
    memcpy(particles_after, particles, sizeof particles_after);
    memcpy(bias_after, bias, sizeof bias_after);
    insole_rng_t rng_after = cloud.filter.rng;
    make_walk(slices[_i]);
    insole_step_cloud_answer_t a = answer();
    ck_assert_mem_eq(particles, particles_after, sizeof particles_after);
    ck_assert_mem_eq(bias, bias_after, sizeof bias_after);
    ck_assert_mem_eq(&cloud.filter.rng, &rng_after, sizeof rng_after);
    ck_assert(a.spot.x_m == expected.spot.x_m && a.spot.y_m == expected.spot.y_m);
    ck_assert(a.offset_rad == expected.offset_rad && a.scale == expected.scale);
    ck_assert_uint_eq(cloud.filter.counts.strides, 50u);
}
END_TEST

/* A copy of state and memory in the middle goes on in the same bits. */
START_TEST(a_copy_goes_on_alike)
{
    static insole_particle_t kept[N];
    static insole_spot_t kept_bias[N];
    make_walk(WHOLE);
    step(0.7, 0.1);
    step(0.7, 0.2);
    insole_step_cloud_work(&cloud, 123);
    insole_step_cloud_t copy = cloud;
    memcpy(kept, particles, sizeof kept);
    memcpy(kept_bias, bias, sizeof kept_bias);
    work(77);
    insole_step_cloud_answer_t expected = answer();
    cloud = copy;
    memcpy(particles, kept, sizeof kept);
    memcpy(bias, kept_bias, sizeof kept_bias);
    work(200);
    insole_step_cloud_answer_t a = answer();
    ck_assert(a.spot.x_m == expected.spot.x_m && a.spot.y_m == expected.spot.y_m);
    ck_assert_uint_eq(a.waiting, 0u);
}
END_TEST

START_TEST(what_waits_is_told_and_a_start_drops_it)
{
    begin(&insole_step_cloud_defaults, N, NULL);
    start(5, 5, 0.5, 0, 0.1, false);
    for (uint32_t k = 1; k <= INSOLE_STEP_CLOUD_WAITING; k++) {
        step(0.7, 0);
        ck_assert_uint_eq(answer().waiting, k);
    }
    step(0.7, 0); /* works the oldest in */
    ck_assert_uint_eq(answer().waiting, INSOLE_STEP_CLOUD_WAITING + 1u);
    insole_step_origin_t origin = origin_at(-50, 5, 0.5, 0, 0.1, false);
    insole_step_cloud_answer_t a;
    ck_assert_int_eq(insole_step_cloud_start(&cloud, &origin), INSOLE_OK);
    ck_assert_int_eq(insole_step_cloud_answer(&cloud, &a), INSOLE_ERR_STATE);
    work(WHOLE);
    a = answer();
    ASSERT_NEAR(a.spot.x_m, -50.0, 0.15, "m");
    ck_assert_uint_eq(a.waiting, 0u);
    ck_assert(!insole_step_cloud_work(&cloud, 10));
}
END_TEST

/* ---- rivals ---- */

/* The improved filter of the paper: a prior and a kernel, both normal. */
START_TEST(the_rival_weighs_by_the_kernel_about_the_fix)
{
    begin(&insole_step_cloud_plain, MANY, NULL);
    start(0, 0, 2.0, 0, 0, false);
    for (int k = 0; k < 2; k++) {
        insole_spot_fix_t fix = fix_of(2.0 + k, 3.0, -1.0, 8.0);
        tell_fix(&fix);
        work(WHOLE);
    }
    insole_step_cloud_answer_t a = answer(); /* 4 against twice 8, that are one of 4 */
    ASSERT_NEAR(a.spot.x_m, 1.5, 0.03, "m");
    ASSERT_NEAR(a.spot.y_m, -0.5, 0.03, "m");
    ASSERT_NEAR(a.cov_m2.xx, 2.0, 0.06, "m2");
}
END_TEST

/* The other one: of two fingerprints the one that a scan is like draws the cloud. */
START_TEST(the_other_rival_weighs_by_inverse_distance)
{
    static prints_t prints;
    static insole_real_t log_weights[PRINTS_POINTS];
    static insole_rss_weigh_t rss;
    const insole_rss_t heard = {0, -50, 0};
    prints_begin(&prints);
    for (int k = 0; k < 2; k++) {
        prints_point(&prints, 10.0 * k, 0);
        prints_entry(&prints, 0, k ? -60.0 : -53.0, 3); /* 10 dB and 3 dB off */
    }
    begin(&insole_step_cloud_plain, MANY, NULL);
    start(5, 0, 3.0, 0, 0, false);
    ck_assert_int_eq(
        insole_rss_weigh_begin(&rss, &prints.map, log_weights, PRINTS_POINTS, -95, &heard, 1),
        INSOLE_OK);
    ck_assert_int_eq(insole_step_cloud_rss(&cloud, &rss, insole_spot(0, 0)), INSOLE_ERR_STATE);
    insole_rss_weigh_work(&rss, 2);
    step(0, 0); /* waits, is not lost */
    ck_assert_int_eq(insole_step_cloud_rss(&cloud, &rss, insole_spot(0, 0)), INSOLE_OK);
    ck_assert_uint_eq(cloud.filter.counts.strides, 1u);
    double share = (1.0 / 3.0) / (1.0 / 3.0 + 1.0 / 10.0), half = 3.0 * sqrt(2.0 / 3.14159265);
    insole_step_cloud_answer_t a = answer();
    ck_assert_uint_eq(a.waiting, 0u);
    ASSERT_NEAR(a.spot.x_m, 5.0 + (1.0 - 2.0 * share) * half, 0.06, "m");
    ASSERT_NEAR(a.spot.y_m, 0.0, 0.06, "m");
}
END_TEST

/* ---- what a pace tells ---- */

START_TEST(variances_count_when_they_are_to)
{
    insole_pace_t pace = {1, 0, INSOLE_R(0.16), 10};
    for (int32_t process = 0; process < 2; process++) {
        insole_step_cloud_config_t config = linear_config();
        config.process = process;
        config.particles.length_share = INSOLE_R(0.3);
        begin(&config, MANY, NULL);
        start(0, 0, 0.001, 0, 0, false);
        pace.var_heading_rad2 = 0;
        ck_assert_int_eq(insole_step_cloud_step(&cloud, &pace), INSOLE_OK);
        work(WHOLE);
        ASSERT_NEAR(answer().cov_m2.xx, process == INSOLE_STEP_CLOUD_TOLD ? 0.25 : 0.09, 0.008,
                    "m2");
    }
    pace.var_heading_rad2 = INSOLE_R(1e6); /* nothing is known of it */
    ck_assert_int_eq(insole_step_cloud_step(&cloud, &pace), INSOLE_OK);
    work(WHOLE);
    ck_assert(insole_is_finite(answer().spot.x_m));
}
END_TEST

/* ---- refusals ---- */

START_TEST(nothing_before_the_start)
{
    insole_pace_t pace = {1, 0, 0, 0};
    insole_spot_fix_t fix = fix_of(1.0, 0, 0, 4);
    insole_step_cloud_answer_t a;
    begin(&insole_step_cloud_defaults, N, NULL);
    ASSERT_REFUSED(cloud, cloud.refused, insole_step_cloud_step(&cloud, &pace), INSOLE_ERR_STATE);
    ASSERT_REFUSED(cloud, cloud.refused, insole_step_cloud_fix(&cloud, &fix), INSOLE_ERR_STATE);
    ASSERT_REFUSED(cloud, cloud.refused, insole_step_cloud_compass(&cloud, 0, 1), INSOLE_ERR_STATE);
    ck_assert(!insole_step_cloud_work(&cloud, 100));
    ck_assert_int_eq(insole_step_cloud_answer(&cloud, &a), INSOLE_ERR_STATE);
}
END_TEST

static void refuse_start(insole_step_origin_t origin)
{
    ASSERT_REFUSED(cloud, cloud.refused, insole_step_cloud_start(&cloud, &origin),
                   INSOLE_ERR_VALUE);
}

START_TEST(bad_news_change_nothing)
{
    const insole_real_t nan = (insole_real_t)(double)NAN;
    begin(&insole_step_cloud_defaults, N, NULL);
    insole_step_origin_t good = origin_at(1, 2, 1, 0.5, 0.1, true), bad[5];
    start(1, 2, 1, 0.5, 0.1, true);
    step(1, 0);
    for (int i = 0; i < 5; i++) {
        bad[i] = good;
    }
    bad[0].spot.x_m = nan;
    bad[1].cov_m2.yy = 0;
    bad[2].offset_rad = 1001;
    bad[3].var_offset_rad2 = -1;
    bad[4].var_offset_rad2 = nan;
    for (int i = 0; i < 5; i++) {
        refuse_start(bad[i]);
    }
    insole_pace_t pace = {-1, 0, 0, 0};
    ASSERT_REFUSED(cloud, cloud.refused, insole_step_cloud_step(&cloud, &pace), INSOLE_ERR_VALUE);
    pace.length_m = 1;
    pace.heading_rad = nan;
    ASSERT_REFUSED(cloud, cloud.refused, insole_step_cloud_step(&cloud, &pace), INSOLE_ERR_VALUE);
    insole_spot_fix_t fix = fix_of(2.0, 0, 0, 0);
    ASSERT_REFUSED(cloud, cloud.refused, insole_step_cloud_fix(&cloud, &fix), INSOLE_ERR_VALUE);
    fix = fix_of(1.0, 0, 0, 4); /* the time of the start by radio */
    ASSERT_REFUSED(cloud, cloud.refused, insole_step_cloud_fix(&cloud, &fix), INSOLE_ERR_TIME);
    ASSERT_REFUSED(cloud, cloud.refused, insole_step_cloud_compass(&cloud, nan, 1),
                   INSOLE_ERR_VALUE);
    ASSERT_REFUSED(cloud, cloud.refused, insole_step_cloud_compass(&cloud, 0, 0), INSOLE_ERR_VALUE);
    ASSERT_UNCHANGED(cloud, insole_step_cloud_start(&cloud, NULL), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(cloud, insole_step_cloud_step(&cloud, NULL), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(cloud, insole_step_cloud_fix(&cloud, NULL), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(cloud, insole_step_cloud_rss(&cloud, NULL, insole_spot(0, 0)),
                     INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(cloud, insole_step_cloud_answer(&cloud, NULL), INSOLE_ERR_NULL);
}
END_TEST

START_TEST(no_state_no_answer)
{
    insole_step_origin_t origin = origin_at(0, 0, 1, 0, 0, false);
    insole_pace_t pace = {1, 0, 0, 0};
    insole_spot_fix_t fix = fix_of(1.0, 0, 0, 4);
    insole_step_cloud_answer_t a;
    ck_assert_int_eq(insole_step_cloud_start(NULL, &origin), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_step_cloud_step(NULL, &pace), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_step_cloud_fix(NULL, &fix), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_step_cloud_compass(NULL, 0, 1), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_step_cloud_answer(NULL, &a), INSOLE_ERR_NULL);
    ck_assert(!insole_step_cloud_work(NULL, 5));
}
END_TEST

START_TEST(settings_and_memory_are_checked)
{
    insole_step_cloud_config_t config = insole_step_cloud_defaults;
    insole_cloud_t memory = {particles, N, NULL, 0, bias};
    begin(&config, N, NULL);
#define REFUSED(config, memory, why)                                                               \
    ASSERT_UNCHANGED(cloud, insole_step_cloud_init(&cloud, config, memory, NULL, 1u), why)
    REFUSED(NULL, &memory, INSOLE_ERR_NULL);
    REFUSED(&config, NULL, INSOLE_ERR_NULL);
    memory.bias = NULL;
    REFUSED(&config, &memory, INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_step_cloud_init(&cloud, &insole_step_cloud_plain, &memory, NULL, 1u),
                     INSOLE_OK);
    memory.bias = bias;
    memory.count = 0;
    REFUSED(&config, &memory, INSOLE_ERR_VALUE);
    memory.count = N;
    config.process = 2;
    REFUSED(&config, &memory, INSOLE_ERR_VALUE);
    config.process = 1;
    config.particles.bias_s = 0;
    REFUSED(&config, &memory, INSOLE_ERR_VALUE);
    ck_assert_int_eq(insole_step_cloud_init(NULL, &config, &memory, NULL, 1u), INSOLE_ERR_NULL);
}
END_TEST

/* ---- for a tracker ---- */

static void begin_blank(void)
{
    memset(&cloud, 0, sizeof cloud);
    memset(particles, 0, sizeof *particles * N);
    memset(bias, 0, sizeof *bias * N);
    begin(&insole_step_cloud_defaults, N, &drawing.plan);
}

/* News of all kinds, told by the calls themselves. */
static void walk_directly(const insole_step_filter_begin_t *at)
{
    const insole_step_origin_t origin = {
        at->t_us, at->spot, at->cov_m2, at->offset_rad, at->var_offset_rad2, at->from_radio};
    ck_assert_int_eq(insole_step_cloud_start(&cloud, &origin), INSOLE_OK);
    for (int k = 1; k <= 40; k++) {
        insole_spot_fix_t fix = fix_of(1.0 + 0.5 * k, 5.0, 5.0 - 0.1 * k, 9.0);
        step(0.7, 0.01 * k);
        tell_fix(&fix);
        ck_assert_int_eq(insole_step_cloud_compass(&cloud, INSOLE_R(1.4), INSOLE_R(0.8)),
                         INSOLE_OK);
        (void)insole_step_cloud_work(&cloud, 600u);
    }
    work(70u);
}

/* The same by the table. */
static void walk_by_table(const insole_step_filter_begin_t *at)
{
    const insole_step_filter_calls_t *calls = &insole_step_cloud_calls;
    ck_assert_int_eq(calls->start(&cloud, at), INSOLE_OK);
    for (int k = 1; k <= 40; k++) {
        insole_pace_t pace = {INSOLE_R(0.7), (insole_real_t)(0.01 * k), 0, 0};
        insole_spot_fix_t fix = fix_of(1.0 + 0.5 * k, 5.0, 5.0 - 0.1 * k, 9.0);
        ck_assert_int_eq(calls->step(&cloud, 1000000u + 500000u * (uint64_t)k, &pace), INSOLE_OK);
        ck_assert_int_eq(calls->fix(&cloud, &fix), INSOLE_OK);
        ck_assert_int_eq(calls->compass(&cloud, INSOLE_R(1.4), INSOLE_R(0.8)), INSOLE_OK);
        (void)calls->work(&cloud, 600u);
    }
    for (int left = 100000; calls->work(&cloud, 70u); left--) {
        ck_assert_int_gt(left, 0);
    }
}

/* Bit for bit what the calls themselves do with the same news. */
START_TEST(the_table_is_the_calls_it_names)
{
    insole_step_filter_begin_t at = filter_begin();
    insole_step_filter_answer_t named;
    at.from_radio = _i == 1;
    draw_corridor(true);
    at.spot = insole_spot(INSOLE_R(2.0), INSOLE_R(1.5));
    begin_blank();
    walk_directly(&at);
    insole_step_cloud_t direct = cloud;
    memcpy(particles_after, particles, sizeof particles_after);
    memcpy(bias_after, bias, sizeof bias_after);
    insole_step_cloud_answer_t expected = answer();
    begin_blank();
    walk_by_table(&at);
    ck_assert_mem_eq(particles, particles_after, sizeof particles_after);
    ck_assert_mem_eq(bias, bias_after, sizeof bias_after);
    ck_assert_uint_eq(cloud.filter.counts.strides, 40u);
    ck_assert_uint_eq(cloud.filter.counts.resampled, direct.filter.counts.resampled);
    ck_assert_uint_eq(cloud.refused, direct.refused);
    ck_assert_uint_eq(cloud.fix_us, direct.fix_us);
    ck_assert_int_eq(insole_step_cloud_calls.answer(&cloud, &named), INSOLE_OK);
    ck_assert_mem_eq(&named.spot, &expected.spot, sizeof named.spot);
    ck_assert_mem_eq(&named.cov_m2, &expected.cov_m2, sizeof named.cov_m2);
    ck_assert(named.offset_rad == expected.offset_rad && named.scale == expected.scale);
    ck_assert(named.var_offset_rad2 == expected.var_offset_rad2);
}
END_TEST

/* A start whose covariance holds the bias of the fixes is drawn as wide as that, and no wider. */
START_TEST(a_start_by_radio_is_as_wide_as_it_tells)
{
    static const double BIAS_M[] = {3.5, 2.0};
    insole_step_filter_begin_t at = filter_begin();
    at.cov_m2 = insole_sym2_circle(20);
    at.from_radio = true;
    at.shared_m2 = INSOLE_R(12.25);
    begin(&insole_step_cloud_defaults, MANY, NULL);
    ck_assert_int_eq(insole_step_cloud_calls.bias(&cloud, (insole_real_t)BIAS_M[_i]), INSOLE_OK);
    ck_assert(cloud.filter.steps.radio.sigma_m == (insole_real_t)BIAS_M[_i]);
    ck_assert_int_eq(insole_step_cloud_calls.start(&cloud, &at), INSOLE_OK);
    work(WHOLE);
    insole_step_cloud_answer_t a = answer();
    ASSERT_NEAR(a.cov_m2.xx, 20.0, 1.0, "m2");
    ASSERT_NEAR(a.cov_m2.yy, 20.0, 1.0, "m2");
    ck_assert_int_eq(insole_step_cloud_calls.bias(NULL, 1), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_step_cloud_calls.bias(&cloud, -1), INSOLE_ERR_VALUE);
    ck_assert_uint_eq(cloud.refused, 1u);
}
END_TEST

/* By radio that lies in a wall, or far outside: no particle is drawn where nobody can walk. */
START_TEST(no_start_is_drawn_outside_the_plan)
{
    draw_corridor(true);
    insole_step_filter_begin_t at = filter_begin();
    at.cov_m2 = insole_sym2_circle(16);
    at.from_radio = true;
    uint32_t alive = 0u, outside = 0u;
    insole_rng_seed(&rng, 21u);
    for (uint32_t k = 0u; k < 500u; k++) {
        at.spot = insole_spot(sample_between(&rng, -4, 12), sample_between(&rng, -4, 12));
        begin_blank();
        ck_assert_int_eq(insole_step_cloud_calls.start(&cloud, &at), INSOLE_OK);
        work(WHOLE);
        for (uint32_t i = 0u; i < N; i++) {
            bool lives = insole_particle_lives(&particles[i]);
            alive += lives ? 1u : 0u;
            outside += lives && !insole_floor_plan_inside(&drawing.plan, particles[i].x_m,
                                                          particles[i].y_m)
                           ? 1u
                           : 0u;
        }
    }
    ck_assert_uint_eq(outside, 0u);
    ck_assert_uint_gt(alive, 100u * N);
}
END_TEST

/* A tracker asks right after the start: the cloud is drawn by work, and no sooner. */
START_TEST(the_table_answers_when_the_cloud_is_drawn)
{
    const insole_step_filter_calls_t *calls = &insole_step_cloud_calls;
    insole_step_filter_begin_t at = filter_begin();
    insole_step_filter_answer_t named;
    const insole_cloud_t memory = {particles, N, NULL, 0, bias};
    ck_assert_int_eq(insole_step_cloud_init(&cloud, &insole_step_cloud_defaults, &memory, NULL, 7u),
                     INSOLE_OK);
    ck_assert(!calls->work(&cloud, N));
    ck_assert_int_eq(calls->start(&cloud, &at), INSOLE_OK);
    memset(&named, 0x5a, sizeof named);
    insole_step_filter_answer_t untouched = named;
    ck_assert_int_eq(calls->answer(&cloud, &named), INSOLE_ERR_STATE);
    ck_assert_mem_eq(&named, &untouched, sizeof named);
    while (calls->work(&cloud, 64u)) {
    }
    ck_assert_int_eq(calls->answer(&cloud, &named), INSOLE_OK);
    ASSERT_NEAR(named.spot.x_m, 5.0, 4.0 * 2.0 / sqrt(N), "m"); /* four sigma of a mean */
    ASSERT_NEAR(named.spot.y_m, 5.0, 4.0 * sqrt(3.0 / N), "m");
    ASSERT_NEAR(named.offset_rad, 1.57, 4.0 * 0.2 / sqrt(N), "rad");
    ASSERT_NEAR(named.cov_m2.xx, 4.0, 4.0 * 4.0 * sqrt(2.0 / N), "m^2");
}
END_TEST

START_TEST(the_table_refuses_what_the_calls_refuse)
{
    begin(&insole_step_cloud_defaults, N, NULL);
    check_filter_calls(&insole_step_cloud_calls, &cloud);
    ck_assert_int_eq(insole_step_cloud_calls.compass(NULL, 0, 1), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_step_cloud_calls.compass(&cloud, 0, 1), INSOLE_ERR_STATE);
    ck_assert(!insole_step_cloud_calls.work(NULL, 5u));
    ck_assert_uint_eq(cloud.refused, 4u);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("step_cloud");
    suite_add_loop(suite, "Kalman filter", many_particles_are_the_kalman_filter, 2);
    suite_add(suite, "compass", a_compass_tells_the_offset);
    suite_add(suite, "offset and scale", fixes_find_offset_and_scale);
    suite_add(suite, "missing door", a_missing_door_is_walked_through);
    suite_add(suite, "direction", walls_hold_the_direction);
    suite_add_loop(suite, "slices", slices_and_bursts_give_the_same_bits,
                   sizeof slices / sizeof slices[0]);
    suite_add(suite, "copy", a_copy_goes_on_alike);
    suite_add(suite, "waiting", what_waits_is_told_and_a_start_drops_it);
    suite_add(suite, "kernel rival", the_rival_weighs_by_the_kernel_about_the_fix);
    suite_add(suite, "distance rival", the_other_rival_weighs_by_inverse_distance);
    suite_add(suite, "variances", variances_count_when_they_are_to);
    suite_add(suite, "before the start", nothing_before_the_start);
    suite_add(suite, "bad news", bad_news_change_nothing);
    suite_add(suite, "no state", no_state_no_answer);
    suite_add(suite, "settings", settings_and_memory_are_checked);
    suite_add_loop(suite, "wide", a_start_by_radio_is_as_wide_as_it_tells, 2);
    suite_add(suite, "inside", no_start_is_drawn_outside_the_plan);
    suite_add_loop(suite, "table", the_table_is_the_calls_it_names, 2);
    suite_add(suite, "drawn", the_table_answers_when_the_cloud_is_drawn);
    suite_add(suite, "table refuses", the_table_refuses_what_the_calls_refuse);
    return suite;
}
