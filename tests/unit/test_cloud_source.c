/* SPDX-License-Identifier: MIT */
#include "insole/fuse/cloud_source.h"

#include <string.h>

#include "near.h"
#include "plans.h"
#include "suite.h"

static insole_rng_t rng;

static insole_cloud_source_t source_at(double x, double y, double xx, double xy, double yy)
{
    insole_cloud_source_t s = {.x_m = (insole_real_t)x,
                               .y_m = (insole_real_t)y,
                               .var_x_m2 = (insole_real_t)xx,
                               .cov_xy_m2 = (insole_real_t)xy,
                               .var_y_m2 = (insole_real_t)yy,
                               .scale = 1};
    return s;
}

START_TEST(it_is_the_summary_of_a_fix)
{
    insole_cloud_fix_t fix = {1, 2, 9, 3, 4, INSOLE_R(0.5), INSOLE_R(0.04), INSOLE_R(1.02), 250};
    insole_cloud_source_t s = insole_cloud_source(&fix, INSOLE_R(0.02));
    ASSERT_NEAR(s.x_m, 1.0, 0.0, "m");
    ASSERT_NEAR(s.y_m, 2.0, 0.0, "m");
    ASSERT_NEAR(s.var_x_m2, 9.0, 0.0, "m2");
    ASSERT_NEAR(s.cov_xy_m2, 3.0, 0.0, "m2");
    ASSERT_NEAR(s.var_y_m2, 4.0, 0.0, "m2");
    ASSERT_NEAR(s.offset_rad, 0.5, 0.0, "rad");
    ASSERT_NEAR(s.sigma_offset_rad, 0.2, 1e-7, "rad");
    ASSERT_NEAR(s.scale, 1.02, 1e-7, "");
    ASSERT_NEAR(s.sigma_scale, 0.02, 1e-8, "");
}
END_TEST

typedef struct {
    double x, y, xx, xy, yy;
} moments_t;

static void take(moments_t *m, double x, double y, double share)
{
    m->x += share * x;
    m->y += share * y;
    m->xx += share * x * x;
    m->xy += share * x * y;
    m->yy += share * y * y;
}

static void centre(moments_t *m)
{
    m->xx -= m->x * m->x;
    m->xy -= m->x * m->y;
    m->yy -= m->y * m->y;
}

static const double covariances[][3] = {{4.0, 0.0, 4.0}, {4.0, 1.9, 1.0}, {1.0, -3.0, 9.0},
                                        {0.0, 0.0, 1.0}, {2.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};

/* Places have the mean and covariance of the source, also where it is flat. */
START_TEST(places_are_drawn_with_its_covariance)
{
    enum { N = 100000 };
    const double *c = covariances[_i];
    insole_cloud_source_t s = source_at(500.0, -20.0, c[0], c[1], c[2]);
    moments_t m = {0};
    insole_rng_seed(&rng, 1u);
    for (int i = 0; i < N; i++) {
        insole_particle_t p;
        insole_cloud_source_draw(&s, &p, NULL, &rng);
        take(&m, (double)p.x_m - 500.0, (double)p.y_m + 20.0, 1.0 / N);
    }
    centre(&m);
    double sharp = 4.0 / sqrt((double)N), size = c[0] + c[2] + 1e-3;
    ASSERT_NEAR(m.x, 0.0, sharp * sqrt(size), "m");
    ASSERT_NEAR(m.y, 0.0, sharp * sqrt(size), "m");
    ASSERT_NEAR(m.xx, c[0], sharp * 1.5 * size, "m2");
    ASSERT_NEAR(m.xy, c[1], sharp * 1.5 * size, "m2");
    ASSERT_NEAR(m.yy, c[2], sharp * 1.5 * size, "m2");
}
END_TEST

START_TEST(offset_and_scale_are_drawn_as_told)
{
    enum { N = 100000 };
    insole_cloud_source_t s = source_at(0.0, 0.0, 1.0, 0.0, 1.0);
    s.offset_rad = 3; /* some are drawn across the cut */
    s.sigma_offset_rad = INSOLE_R(0.2);
    s.scale = INSOLE_R(1.05);
    s.sigma_scale = INSOLE_R(0.02);
    moments_t m = {0};
    insole_rng_seed(&rng, 2u);
    for (int i = 0; i < N; i++) {
        insole_particle_t p;
        insole_cloud_source_draw(&s, &p, NULL, &rng);
        ck_assert(p.offset_rad > -INSOLE_PI && p.offset_rad <= INSOLE_PI);
        ASSERT_NEAR(p.log_weight, 0.0, 0.0, "");
        take(&m, remainder((double)p.offset_rad - 3.0, 6.283185307179586), (double)p.scale - 1.05,
             1.0 / N);
    }
    centre(&m);
    double sharp = 4.0 / sqrt((double)N);
    ASSERT_NEAR(m.x, 0.0, sharp * 0.2, "rad");
    ASSERT_NEAR(m.xx, 0.04, sharp * 1.5 * 0.04, "rad2");
    ASSERT_NEAR(m.y, 0.0, sharp * 0.02, "");
    ASSERT_NEAR(m.yy, 0.0004, sharp * 1.5 * 0.0004, "");
    ASSERT_NEAR(m.xy, 0.0, sharp * 0.2 * 0.02, "");
}
END_TEST

/* With a sigma of pi or more the directions fill the circle evenly: chi-square of 35 degrees. */
START_TEST(an_offset_that_is_not_known_is_any)
{
    enum { N = 36000 };
    insole_cloud_source_t s = source_at(0.0, 0.0, 1.0, 0.0, 1.0);
    s.sigma_offset_rad = INSOLE_PI;
    double bins[36] = {0.0}, chi = 0.0;
    insole_rng_seed(&rng, 3u);
    for (int i = 0; i < N; i++) {
        insole_particle_t p;
        insole_cloud_source_draw(&s, &p, NULL, &rng);
        ck_assert(p.offset_rad > -INSOLE_PI && p.offset_rad <= INSOLE_PI);
        int bin = (int)((double)p.offset_rad * 18.0 / 3.14159266 + 18.0);
        bins[bin < 36 ? bin : 35] += 1.0;
    }
    for (int k = 0; k < 36; k++) {
        chi += pow(bins[k] - N / 36.0, 2.0) / (N / 36.0);
    }
    ASSERT_AT_MOST(chi, 35.0 + 4.0 * sqrt(70.0), "");
}
END_TEST

static drawing_t drawing;

static void draw_room(double x0, double y0)
{
    draw_begin(&drawing);
    draw_box(&drawing, INSOLE_LINE_OUTLINE, 4.0, x0, y0, x0 + 10.0, y0 + 4.0);
    ck_assert_int_eq(draw_build(&drawing), INSOLE_OK);
}

/* At a wall half of the places lie beyond it: nearly all are found inside, none is left outside. */
START_TEST(with_a_plan_places_are_inside)
{
    int dead = 0;
    draw_room(0.0, 0.0);
    insole_cloud_source_t s = source_at(5.0, 0.0, 1.0, 0.0, 1.0);
    insole_rng_seed(&rng, 4u);
    for (int i = 0; i < 20000; i++) {
        insole_particle_t p;
        insole_cloud_source_draw(&s, &p, &drawing.plan, &rng);
        dead += !insole_particle_lives(&p);
        ck_assert(!insole_particle_lives(&p) || (p.y_m >= 0 && p.y_m <= 4));
    }
    ASSERT_NEAR(dead, 20000.0 / 256.0, 40.0, "of 20000"); /* eight attempts */
}
END_TEST

START_TEST(far_from_any_room_all_are_dead)
{
    draw_room(500.0, 500.0);
    insole_cloud_source_t s = source_at(0.0, 0.0, 1.0, 0.0, 1.0);
    insole_rng_seed(&rng, 5u);
    for (int i = 0; i < 100; i++) {
        insole_particle_t p;
        insole_cloud_source_draw(&s, &p, &drawing.plan, &rng);
        ck_assert(!insole_particle_lives(&p));
        ck_assert(insole_is_finite(p.x_m) && insole_is_finite(p.y_m));
    }
}
END_TEST

static const double spreads[] = {0.0, 0.1, 0.5, 1.0};

/* What the source does is what the particles of its cloud do on the mean. */
START_TEST(it_walks_as_its_particles_do)
{
    enum { N = 100000 };
    insole_cloud_source_t s = source_at(3.0, 4.0, 0.25, 0.1, 0.5);
    s.offset_rad = INSOLE_R(0.7);
    s.sigma_offset_rad = (insole_real_t)spreads[_i];
    s.scale = INSOLE_R(1.1);
    insole_cloud_stride_t stride = {.length_m = INSOLE_R(1.5),
                                    .sigma_length_m = INSOLE_R(0.1),
                                    .heading_rad = INSOLE_R(-0.4),
                                    .sigma_wander_rad = INSOLE_R(0.02),
                                    .scale_memory = 1};
    moments_t m = {0};
    insole_rng_seed(&rng, 6u);
    for (int i = 0; i < N; i++) {
        insole_particle_t p;
        insole_cloud_source_draw(&s, &p, NULL, &rng);
        insole_cloud_walk(&p, &stride, &rng);
        take(&m, (double)p.x_m, (double)p.y_m, 1.0 / N);
    }
    centre(&m);
    insole_cloud_source_walk(&s, &stride);
    ASSERT_NEAR(s.x_m, m.x, 0.02, "m");
    ASSERT_NEAR(s.y_m, m.y, 0.02, "m");
    ASSERT_NEAR(s.cov_xy_m2, 0.1, 1e-7, "m2");
    ck_assert((double)(s.var_x_m2 + s.var_y_m2) >= 0.98 * (m.xx + m.yy)); /* never too sure */
    ck_assert((double)s.var_x_m2 < 0.25 + 2.3);
}
END_TEST

/* The mean of cos and sin over the offsets, by quadrature. */
START_TEST(its_turn_is_the_mean_turn)
{
    insole_cloud_source_t s = source_at(0.0, 0.0, 1.0, 0.0, 1.0);
    double sigma = spreads[_i], c = 0.0, n = 0.0;
    s.offset_rad = -2;
    s.sigma_offset_rad = (insole_real_t)sigma;
    s.scale = INSOLE_R(0.9);
    for (double z = -6.0; z <= 6.0; z += 0.01) {
        c += exp(-0.5 * z * z) * cos(sigma * z);
        n += exp(-0.5 * z * z);
    }
    insole_turn_t turn = insole_cloud_source_turn(&s);
    ASSERT_NEAR(turn.cos, 0.9 * cos(-2.0) * c / n, 1e-6, "");
    ASSERT_NEAR(turn.sin, 0.9 * sin(-2.0) * c / n, 1e-6, "");
}
END_TEST

START_TEST(widening_adds_variances)
{
    insole_cloud_source_t s = source_at(1.0, 2.0, 4.0, 1.0, 9.0);
    s.sigma_offset_rad = INSOLE_R(0.3);
    insole_cloud_source_widen(&s, 2, INSOLE_R(0.4));
    ASSERT_NEAR(s.var_x_m2, 8.0, 1e-6, "m2");
    ASSERT_NEAR(s.cov_xy_m2, 1.0, 0.0, "m2");
    ASSERT_NEAR(s.var_y_m2, 13.0, 1e-6, "m2");
    ASSERT_NEAR(s.sigma_offset_rad, 0.5, 1e-6, "rad");
}
END_TEST

static const double shares[] = {0.0, 0.1, 0.5, 1.0};

/* Mean and covariance of places of which a share is drawn from the other. */
START_TEST(a_mixture_has_the_moments_of_both)
{
    enum { N = 200000 };
    insole_cloud_source_t a = source_at(1.0, 2.0, 1.0, 0.3, 0.5);
    insole_cloud_source_t b = source_at(6.0, -4.0, 2.0, -0.5, 3.0);
    moments_t m = {0};
    insole_rng_seed(&rng, 7u);
    for (int i = 0; i < N; i++) {
        insole_particle_t p;
        bool other = i < shares[_i] * N;
        insole_cloud_source_draw(other ? &b : &a, &p, NULL, &rng);
        take(&m, (double)p.x_m, (double)p.y_m, 1.0 / N);
    }
    centre(&m);
    insole_cloud_source_mix(&a, &b, (insole_real_t)shares[_i]);
    ASSERT_NEAR(a.x_m, m.x, 0.02, "m");
    ASSERT_NEAR(a.y_m, m.y, 0.02, "m");
    ASSERT_NEAR(a.var_x_m2, m.xx, 0.05, "m2");
    ASSERT_NEAR(a.cov_xy_m2, m.xy, 0.05, "m2");
    ASSERT_NEAR(a.var_y_m2, m.yy, 0.07, "m2");
}
END_TEST

static const struct {
    double xx, yy, offset, sigma_m, sigma_rad, width;
} width_rows[] = {{0.0, 0.0, 0.0, 2.0, 0.5, 0.0},     {4.0, 4.0, 0.0, 2.0, 0.5, 0.5},
                  {8.0, 0.0, 0.0, 2.0, 0.5, 0.5},     {0.0, 0.0, 0.5, 2.0, 0.5, 0.5},
                  {4.0, 4.0, 0.5, 2.0, 0.5, 2.0 / 3}, {36.0, 36.0, 0.0, 2.0, 0.5, 0.9},
                  {1e30, 1.0, 0.0, 2.0, 0.5, 1.0},    {0.0, 0.0, 3e38, 2.0, 0.01, 1.0}};

START_TEST(its_width_is_beside_what_is_told)
{
    insole_cloud_source_t s = source_at(0.0, 0.0, width_rows[_i].xx, 0.0, width_rows[_i].yy);
    s.sigma_offset_rad = (insole_real_t)width_rows[_i].offset;
    ASSERT_NEAR(insole_cloud_source_width(&s, (insole_real_t)width_rows[_i].sigma_m,
                                          (insole_real_t)width_rows[_i].sigma_rad),
                width_rows[_i].width, 1e-6, "");
}
END_TEST

/* Each of three by its own sigma and the share, independently; scale and weight stay. */
START_TEST(copies_go_aside_by_a_share)
{
    enum { N = 40000 };
    insole_cloud_source_t s = source_at(90.0, 90.0, 4.0, 1.0, 0.25);
    s.sigma_offset_rad = INSOLE_R(0.2);
    insole_cloud_aside_t aside = insole_cloud_source_aside(&s, INSOLE_R(0.5));
    moments_t m = {0, 0, 0, 0, 0};
    double turned2 = 0.0, leaning = 0.0;
    insole_rng_seed(&rng, 6u);
    for (int i = 0; i < N; i++) {
        insole_particle_t p = {3, 4, 1, INSOLE_R(1.1), INSOLE_R(-0.7)};
        insole_cloud_source_spread(&aside, &p, NULL, &rng);
        double turned = (double)p.offset_rad - 1.0;
        take(&m, (double)p.x_m - 3.0, (double)p.y_m - 4.0, 1.0 / N);
        turned2 += turned * turned / N;
        leaning += turned * ((double)p.x_m - 3.0) / N;
        ck_assert(fabs((double)p.x_m - 3.0) <= 1.001 * sqrt(3.0)); /* no copy is thrown far */
        ck_assert(p.scale == INSOLE_R(1.1) && p.log_weight == INSOLE_R(-0.7));
    }
    ASSERT_NEAR(m.x, 0.0, 0.02, "m");
    ASSERT_NEAR(m.y, 0.0, 0.005, "m");
    ASSERT_NEAR(m.xx, 1.0, 0.03, "m2");
    ASSERT_NEAR(m.xy, 0.0, 0.01, "m2");
    ASSERT_NEAR(m.yy, 0.0625, 0.002, "m2");
    ASSERT_NEAR(turned2, 0.01, 0.0003, "rad2");
    ASSERT_NEAR(leaning, 0.0, 0.002, "m rad");
}
END_TEST

/* In a random building: a place that moved has no wall between; one that did not would have met
 * one. */
START_TEST(no_copy_goes_through_a_wall)
{
    uint32_t stayed = 0;
    insole_rng_seed(&rng, 7u);
    draw_random(&drawing, &rng, 60);
    ck_assert_int_eq(draw_build(&drawing), INSOLE_OK);
    insole_cloud_source_t s = source_at(0.0, 0.0, 4.0, 0.0, 4.0);
    s.sigma_offset_rad = INSOLE_R(0.1);
    insole_cloud_aside_t aside = insole_cloud_source_aside(&s, 1);
    for (int i = 0; i < 5000; i++) {
        insole_particle_t p = {(insole_real_t)draw_uniform(&rng, 0.0, 40.0),
                               (insole_real_t)draw_uniform(&rng, 0.0, 30.0), 0, 1, 0};
        insole_particle_t before = p, free = p;
        insole_rng_t same = rng;
        insole_cloud_source_spread(&aside, &free, NULL, &same);
        insole_cloud_source_spread(&aside, &p, &drawing.plan, &rng);
        segment_t way = {(double)before.x_m, (double)before.y_m, (double)free.x_m,
                         (double)free.y_m};
        double clear = drawing_distance(&drawing, way);
        bool moved = p.x_m != before.x_m || p.y_m != before.y_m;
        ck_assert(clear < 2.0 * (double)INSOLE_FLOOR_PLAN_TOUCH_M || moved);
        ck_assert(clear > 0.0 || !moved);
        ck_assert(p.offset_rad == free.offset_rad);
        stayed += moved ? 0u : 1u;
    }
    ASSERT_AT_LEAST(stayed, 500, "of 5000");
}
END_TEST

START_TEST(it_is_put_elsewhere)
{
    insole_cloud_source_t source = {1, 2, 3, 4, 5, INSOLE_R(0.6), INSOLE_R(0.7), INSOLE_R(0.8),
                                    9, 0};
    insole_cloud_source_put(&source, insole_spot(-1, -2), insole_sym2(13, 14, 15));
    ck_assert(source.x_m == -1 && source.y_m == -2);
    ck_assert(source.var_x_m2 == 13 && source.cov_xy_m2 == 14 && source.var_y_m2 == 15);
    ck_assert(source.offset_rad == INSOLE_R(0.6) && source.sigma_offset_rad == INSOLE_R(0.7));
    ck_assert(source.scale == INSOLE_R(0.8) && source.sigma_scale == 9);
}
END_TEST

/* The part of a plan's rectangle that is drawn into is where one can walk, evenly. */
START_TEST(everywhere_is_even_and_walkable)
{
    static drawing_t d;
    int west = 0, all = 4000;
    draw_begin(&d);
    draw_box(&d, INSOLE_LINE_OUTLINE, 4.0, 100.0, -20.0, 140.0, -10.0);
    draw_box(&d, INSOLE_LINE_HOLE, 4.0, 120.0, -19.0, 140.0, -10.0);
    ck_assert_int_eq(draw_build(&d), INSOLE_OK);
    insole_cloud_source_t s = insole_cloud_source_everywhere(&d.plan, INSOLE_R(0.1));
    insole_rng_seed(&rng, 9u);
    for (int i = 0; i < all; i++) {
        insole_particle_t p;
        insole_cloud_source_draw(&s, &p, &d.plan, &rng);
        ck_assert(insole_particle_lives(&p));
        ck_assert(insole_floor_plan_inside(&d.plan, p.x_m, p.y_m));
        ck_assert((double)p.offset_rad >= -3.1416 && (double)p.offset_rad <= 3.1416);
        west += (double)p.x_m < 120.0 ? 1 : 0;
    }
    ASSERT_NEAR((double)west / all, 200.0 / 220.0, 0.02, ""); /* areas 20 x 10 and 20 x 1 */
}
END_TEST

/* Its variances are those of its rectangle. */
START_TEST(everywhere_is_as_wide_as_the_plan)
{
    static drawing_t d;
    draw_begin(&d);
    draw_box(&d, INSOLE_LINE_OUTLINE, 4.0, 100.0, -20.0, 140.0, -10.0);
    ck_assert_int_eq(draw_build(&d), INSOLE_OK);
    insole_cloud_source_t s = insole_cloud_source_everywhere(&d.plan, INSOLE_R(0.1));
    double wide_m = (double)d.plan.cell_m * d.plan.columns;
    double high_m = (double)d.plan.cell_m * d.plan.rows;
    ASSERT_AT_LEAST(wide_m, 40.0, "m");
    ASSERT_NEAR(s.x_m, (double)d.plan.origin_x_m + 0.5 * wide_m, 1e-4, "m");
    ASSERT_NEAR(s.y_m, (double)d.plan.origin_y_m + 0.5 * high_m, 1e-4, "m");
    ASSERT_NEAR(s.var_x_m2, wide_m * wide_m / 12.0, 1e-3, "m2");
    ASSERT_NEAR(s.var_y_m2, high_m * high_m / 12.0, 1e-3, "m2");
    ASSERT_AT_LEAST(s.sigma_offset_rad, 3.14, "rad");
    ASSERT_NEAR(s.sigma_scale, 0.1, 1e-7, "");
    ASSERT_NEAR(s.even, 1.0, 0.0, "");
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("cloud_source");
    suite_add(suite, "summary", it_is_the_summary_of_a_fix);
    suite_add_loop(suite, "places", places_are_drawn_with_its_covariance,
                   sizeof covariances / sizeof covariances[0]);
    suite_add(suite, "offset and scale", offset_and_scale_are_drawn_as_told);
    suite_add(suite, "any offset", an_offset_that_is_not_known_is_any);
    suite_add(suite, "inside", with_a_plan_places_are_inside);
    suite_add(suite, "outside", far_from_any_room_all_are_dead);
    suite_add_loop(suite, "walk", it_walks_as_its_particles_do, 4);
    suite_add_loop(suite, "turn", its_turn_is_the_mean_turn, 4);
    suite_add(suite, "widen", widening_adds_variances);
    suite_add_loop(suite, "mix", a_mixture_has_the_moments_of_both, 4);
    suite_add_loop(suite, "width", its_width_is_beside_what_is_told,
                   sizeof width_rows / sizeof width_rows[0]);
    suite_add(suite, "aside", copies_go_aside_by_a_share);
    suite_add(suite, "aside a wall", no_copy_goes_through_a_wall);
    suite_add(suite, "put", it_is_put_elsewhere);
    suite_add(suite, "everywhere", everywhere_is_even_and_walkable);
    suite_add(suite, "everywhere's width", everywhere_is_as_wide_as_the_plan);
    return suite;
}
