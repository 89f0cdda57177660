/* SPDX-License-Identifier: MIT */
#include "insole/fuse/particle_filter.h"

#include <string.h>

#include "insole/base/snapshot.h"
#include "radio.h"
#include "suite.h"

enum { N = 500, N_MAX = 20000, PAST = 12, APS = 12, STRIDES = 60, WHOLE = 1 << 30 };

static radio_t radio;
static insole_rng_t rng; /* of the world */
static insole_rss_t readings[RADIO_APS];
static insole_particle_t particles[N_MAX];
static insole_spot_t past[N_MAX * PAST];
static insole_cloud_t cloud;
static insole_particle_filter_t filter;
static uint32_t slice;

/* ---- a world: a corridor around a block, 40 m x 24 m and 2 m wide ---- */

typedef struct {
    double x, y;            /* true place, end of a stride */
    double length, heading; /* of the stride in n, as measured */
} step_t;

static step_t walk[STRIDES + 1];
static double map_x, map_y; /* where the corridor lies */

static void draw_corridor(void)
{
    draw_begin(&radio.drawing);
    draw_box(&radio.drawing, INSOLE_LINE_OUTLINE, 4.0, map_x, map_y, map_x + 40.0, map_y + 24.0);
    draw_box(&radio.drawing, INSOLE_LINE_HOLE, 4.0, map_x + 2.0, map_y + 2.0, map_x + 38.0,
             map_y + 22.0);
    ck_assert_int_eq(draw_build(&radio.drawing), INSOLE_OK);
    radio.building.plan = &radio.drawing.plan;
}

/* The place `along` metres around the middle of the corridor. */
static step_t on_the_round(double along)
{
    static const double corners[5][2] = {{1, 1}, {39, 1}, {39, 23}, {1, 23}, {1, 1}};
    step_t at = {map_x, map_y, 0.0, 0.0};
    for (int k = 0; k < 4; k++) {
        double dx = corners[k + 1][0] - corners[k][0], dy = corners[k + 1][1] - corners[k][1];
        double side = hypot(dx, dy), share = fmin(along, side) / side;
        if (along >= 0.0) {
            at.x = map_x + corners[k][0] + share * dx;
            at.y = map_y + corners[k][1] + share * dy;
        }
        along -= side;
    }
    return at;
}

/* The walk, and what an inertial filter makes of it whose n is turned by -`offset` against m: its
 * heading drifts by so much a stride, its lengths are 2 % short. */
static void make_walk(uint64_t seed, double offset, double drift_rad)
{
    double drift = 0.0;
    insole_rng_seed(&rng, seed);
    for (int k = 0; k <= STRIDES; k++) {
        walk[k] = on_the_round(3.0 + 1.35 * k);
        if (k > 0) {
            double dx = walk[k].x - walk[k - 1].x, dy = walk[k].y - walk[k - 1].y;
            drift += drift_rad * (double)insole_rng_normal(&rng);
            walk[k].length = 0.98 * hypot(dx, dy) + 0.01 * (double)insole_rng_normal(&rng);
            walk[k].heading = atan2(dy, dx) - offset + drift;
        }
    }
}

static void begin_world(uint64_t seed, double x0, double y0, double offset)
{
    map_x = x0;
    map_y = y0;
    insole_rng_seed(&rng, 77u);
    radio_scatter(&radio, &rng, APS, x0, y0);
    draw_corridor();
    make_walk(seed, offset, 0.0175);
}

/* ---- the filter in it ---- */

static void begin_filter(const insole_particle_filter_config_t *config, uint32_t count)
{
    insole_cloud_t c = {particles, count, NULL, 0, NULL};
    cloud = c;
    slice = WHOLE;
    ck_assert_int_eq(insole_particle_filter_init(&filter, config, 42u), INSOLE_OK);
}

static void finish_work(void)
{
    uint32_t rounds = 0;
    while (insole_particle_filter_work(&filter, &cloud, &radio.building, slice)) {
        ck_assert_uint_le(++rounds, 20u * cloud.count + 10000u);
    }
    ck_assert_int_eq(filter.phase, INSOLE_PARTICLES_IDLE);
}

static insole_particle_start_t start_at(double x, double y, double sigma_m, double offset,
                                        double sigma_rad)
{
    insole_particle_start_t s = {(insole_real_t)x, (insole_real_t)y, (insole_real_t)sigma_m,
                                 (insole_real_t)offset, (insole_real_t)sigma_rad};
    return s;
}

static void start(double x, double y, double sigma_m, double offset, double sigma_rad)
{
    insole_particle_start_t s = start_at(x, y, sigma_m, offset, sigma_rad);
    ck_assert_int_eq(insole_particle_filter_start(&filter, &cloud, &s), INSOLE_OK);
    finish_work();
}

static insole_evidence_t stride_of(int k)
{
    insole_evidence_t news;
    insole_evidence_clear(&news);
    double turn = k > 1 ? walk[k].heading - walk[k - 1].heading : 0.0;
    ck_assert_int_eq(insole_evidence_stride(&news, (insole_real_t)fmax(0.0, walk[k].length),
                                            (insole_real_t)walk[k].heading, (insole_real_t)turn),
                     INSOLE_OK);
    return news;
}

static void begin(const insole_evidence_t *news)
{
    ck_assert_int_eq(insole_particle_filter_begin(&filter, &radio.building, news), INSOLE_OK);
}

/* A scan heard where stride k ended. */
static void hear(insole_evidence_t *news, int k)
{
    insole_spot_t none = {0, 0};
    double dx = walk[k].x - walk[k - 1].x, dy = walk[k].y - walk[k - 1].y;
    radio_listen(&radio, &rng, walk[k].x, walk[k].y, atan2(dy, dx), 3.0, radio.building.ap_count,
                 readings);
    ck_assert_int_eq(insole_evidence_scan(news, readings, radio.building.ap_count, none),
                     INSOLE_OK);
}

static void step(int k, bool with_scan)
{
    insole_evidence_t news = stride_of(k);
    if (with_scan) {
        hear(&news, k);
    }
    begin(&news);
    finish_work();
}

static double error_at(int k)
{
    return hypot((double)filter.fix.x_m - walk[k].x, (double)filter.fix.y_m - walk[k].y);
}

/* Walks strides first..last. @return mean error of the second half */
static double follow(int first, int last, bool with_scans)
{
    double sum = 0.0;
    int half = (first + last) / 2;
    for (int k = first; k <= last; k++) {
        step(k, with_scans);
        sum += k > half ? error_at(k) : 0.0;
    }
    return sum / (last - half);
}

static double offset_off(double offset)
{
    return fabs(remainder((double)filter.fix.offset_rad - offset, 6.283185307179586));
}

/* ---- what it must do ---- */

START_TEST(it_starts_where_told)
{
    begin_world(1u, 0.0, 0.0, 0.5);
    begin_filter(&insole_particle_filter_defaults, 5000);
    start(10.0, 1.0, 0.2, 0.5, 0.1);
    ck_assert(filter.has_fix);
    ASSERT_NEAR(filter.fix.x_m, 10.0, 0.015, "m");
    ASSERT_NEAR(filter.fix.y_m, 1.0, 0.015, "m");
    ASSERT_NEAR(filter.fix.var_x_m2, 0.04, 0.004, "m2");
    ASSERT_NEAR(filter.fix.var_y_m2, 0.04, 0.004, "m2");
    ASSERT_NEAR(filter.fix.offset_rad, 0.5, 0.01, "rad");
    ASSERT_NEAR(filter.fix.var_offset_rad2, 0.01, 0.001, "rad2");
    ASSERT_NEAR(filter.fix.effective, 5000.0, 0.5, "particles");
}
END_TEST

/* Without anything to weigh by the cloud goes as the strides go, and grows as they scatter. */
START_TEST(strides_alone_are_dead_reckoning)
{
    enum { STEPS = 20 };
    insole_particle_filter_config_t config = insole_particle_filter_defaults;
    config.sigma_scale = 0;
    config.sigma_wander_rad = 0;
    config.sigma_length_m = INSOLE_R(0.05);
    begin_filter(&config, N_MAX);
    radio.building.plan = NULL;
    start(0.0, 0.0, 0.0, 0.5, 0.0);
    insole_evidence_t news;
    for (int k = 0; k < STEPS; k++) {
        insole_evidence_clear(&news);
        insole_evidence_stride(&news, INSOLE_R(1.4), INSOLE_R(0.3), 0);
        ck_assert_int_eq(insole_particle_filter_begin(&filter, NULL, &news), INSOLE_OK);
        while (insole_particle_filter_work(&filter, &cloud, NULL, WHOLE)) {
        }
    }
    double c = cos(0.8), s = sin(0.8), var = STEPS * 0.0025;
    ASSERT_NEAR(filter.fix.x_m, STEPS * 1.4 * c, 0.01, "m");
    ASSERT_NEAR(filter.fix.y_m, STEPS * 1.4 * s, 0.01, "m");
    ASSERT_NEAR(filter.fix.var_x_m2, var * c * c, 0.04 * var, "m2");
    ASSERT_NEAR(filter.fix.cov_xy_m2, var * c * s, 0.04 * var, "m2");
    ASSERT_NEAR(filter.fix.var_y_m2, var * s * s, 0.04 * var, "m2");
    ck_assert_uint_eq(filter.counts.strides, STEPS);
    ck_assert_uint_eq(filter.counts.resampled, 0);
}
END_TEST

/* The paper's second stage for one stride: normal all along, so the answer is known, (32), (34),
 * (42). Along the stride sigma_s, across it what sigma_psi makes of the length. */
START_TEST(one_stride_of_the_paper_is_a_product_of_normals)
{
    insole_particle_filter_config_t config = insole_particle_filter_two_order;
    config.resample_share = 0;
    begin_filter(&config, N_MAX);
    radio.building.plan = NULL;
    start(0.0, 0.0, 0.0, 0.0, 0.0);
    insole_evidence_t news;
    insole_spot_t inertial = {INSOLE_R(1.5), INSOLE_R(0.2)};
    insole_evidence_clear(&news);
    insole_evidence_stride(&news, INSOLE_R(1.4), 0, INSOLE_R(0.5));
    insole_evidence_position(&news, inertial, INSOLE_R(0.15));
    begin(&news);
    finish_work();
    double across = 1.4 * 0.5 * (double)config.turn_share, r = 0.0225;
    double along2 = pow((double)config.sigma_length_m, 2.0), across2 = across * across;
    ASSERT_NEAR(filter.fix.x_m, 1.4 + along2 / (along2 + r) * 0.1, 0.01, "m");
    ASSERT_NEAR(filter.fix.y_m, across2 / (across2 + r) * 0.2, 0.01, "m");
    ASSERT_NEAR(filter.fix.var_x_m2, along2 * r / (along2 + r), 5e-4, "m2");
    ASSERT_NEAR(filter.fix.var_y_m2, across2 * r / (across2 + r), 6e-4, "m2");
    ASSERT_NEAR(filter.fix.scale, 1.0, 0.0, "");
    ASSERT_NEAR(filter.fix.var_offset_rad2, 0.0, 0.0, "rad2");
}
END_TEST

/* The range to the access point that is nearest, as if measured without error. */
static void tell_nearest(insole_evidence_t *news, int k)
{
    insole_evidence_range_t range = {{0, 0}, {0, 0}, INSOLE_R(1e3), INSOLE_R(0.5), 0};
    for (uint32_t i = 0; i < APS; i++) {
        double dx = walk[k].x - (double)radio.aps[i].x_m, dy = walk[k].y - (double)radio.aps[i].y_m;
        if (hypot(dx, dy) < (double)range.range_m) {
            range.from.x_m = radio.aps[i].x_m;
            range.from.y_m = radio.aps[i].y_m;
            range.range_m = (insole_real_t)hypot(dx, dy);
        }
    }
    ck_assert_int_eq(insole_evidence_range(news, &range), INSOLE_OK);
}

typedef struct {
    double filter, inertial;
} errors_t;

/* The paper's filter around the corridor, with an inertial position that drifts off. */
static errors_t follow_paper(uint64_t seed, bool with_ranges)
{
    errors_t sum = {0.0, 0.0};
    begin_world(seed, 0.0, 0.0, 0.0);
    make_walk(seed, 0.0, 0.006);
    begin_filter(&insole_particle_filter_two_order, N);
    start(walk[0].x, walk[0].y, 0.3, 0.0, 0.0);
    insole_spot_t inertial = {(insole_real_t)walk[0].x, (insole_real_t)walk[0].y};
    for (int k = 1; k <= STRIDES; k++) {
        insole_evidence_t news = stride_of(k);
        inertial.x_m += (insole_real_t)(walk[k].length * cos(walk[k].heading));
        inertial.y_m += (insole_real_t)(walk[k].length * sin(walk[k].heading));
        insole_evidence_position(&news, inertial, 1);
        if (with_ranges) {
            tell_nearest(&news, k);
        }
        begin(&news);
        finish_work();
        sum.inertial += hypot((double)inertial.x_m - walk[k].x, (double)inertial.y_m - walk[k].y);
        sum.filter += error_at(k);
    }
    return sum;
}

START_TEST(the_paper_corrects_the_inertial_position)
{
    errors_t with = {0.0, 0.0}, without = {0.0, 0.0};
    for (uint64_t seed = 3; seed < 9; seed++) {
        errors_t a = follow_paper(seed, false), b = follow_paper(seed, true);
        without.filter += a.filter / (6 * STRIDES);
        without.inertial += a.inertial / (6 * STRIDES);
        with.filter += b.filter / (6 * STRIDES);
    }
    ASSERT_AT_MOST(without.filter, 1.1 * without.inertial, "m");
    ASSERT_AT_MOST(with.filter, 0.8 * without.inertial, "m");
}
END_TEST

/* The corridor tells direction: five degrees of error at the start are found. */
START_TEST(walls_correct_the_offset)
{
    double sum = 0.0;
    for (uint64_t seed = 0; seed < 4; seed++) {
        begin_world(10u + seed, 0.0, 0.0, -2.0);
        begin_filter(&insole_particle_filter_defaults, N);
        start(walk[0].x, walk[0].y, 0.3, -2.0 + 0.087, 0.15);
        sum += follow(1, STRIDES, false) / 4.0;
        ck_assert_uint_eq(filter.counts.recovered, 0);
        ASSERT_AT_MOST(offset_off(-2.0), 0.25, "rad"); /* it has drifted by 0.14 */
    }
    ASSERT_AT_MOST(sum, 0.8, "m");
}
END_TEST

START_TEST(scans_alone_hold_the_position)
{
    double with = 0.0, without = 0.0;
    for (uint64_t seed = 0; seed < 4; seed++) {
        for (int scans = 0; scans < 2; scans++) {
            begin_world(20u + seed, 0.0, 0.0, 1.0);
            radio.building.plan = NULL;
            insole_particle_filter_config_t config = insole_particle_filter_defaults;
            config.blind_power = 1; /* there are no walls */
            config.blind_search_power = config.search_power;
            begin_filter(&config, N);
            start(walk[0].x, walk[0].y, 0.3, 1.1, 0.15);
            *(scans ? &with : &without) += follow(1, STRIDES, scans == 1) / 4.0;
        }
    }
    ASSERT_AT_MOST(with, 2.0, "m");
    ASSERT_AT_LEAST(without, 2.0 * with, "m");
}
END_TEST

START_TEST(scans_and_walls_are_best)
{
    double sum = 0.0;
    for (uint64_t seed = 0; seed < 4; seed++) {
        begin_world(30u + seed, 0.0, 0.0, 3.0);
        begin_filter(&insole_particle_filter_defaults, N);
        start(walk[0].x, walk[0].y, 0.3, 3.05, 0.1);
        sum += follow(1, STRIDES, true) / 4.0;
        ck_assert_uint_eq(filter.counts.scans, STRIDES);
    }
    ASSERT_AT_MOST(sum, 0.8, "m");
}
END_TEST

/* The whole thing somewhere else on the map. */
START_TEST(far_from_the_origin_it_does_as_well)
{
    begin_world(30u, 500.0, -10000.0, 3.0);
    begin_filter(&insole_particle_filter_defaults, N);
    start(walk[0].x, walk[0].y, 0.3, 3.05, 0.1);
    ASSERT_AT_MOST(follow(1, STRIDES, true), 0.8, "m");
}
END_TEST

/* Nothing known of the direction, little of the place: scans and walls find both. */
START_TEST(an_unknown_direction_is_found)
{
    for (uint64_t seed = 0; seed < 3; seed++) {
        begin_world(40u + seed, 0.0, 0.0, -1.5);
        begin_filter(&insole_particle_filter_defaults, 2000);
        start(walk[0].x, walk[0].y, 1.0, 0.0, 3.2);
        ASSERT_AT_MOST(follow(1, STRIDES, true), 1.0, "m");
        ASSERT_AT_MOST(offset_off(-1.5), 0.3, "rad");
    }
}
END_TEST

/* Told to be on the other side of the block: the scans say otherwise. Without a share that is drawn
 * anew it stays lost. */
START_TEST(the_kidnapped_come_back)
{
    double errors[2] = {0.0, 0.0};
    for (uint64_t seed = 0; seed < 4; seed++) {
        for (int redraw = 0; redraw < 2; redraw++) {
            insole_particle_filter_config_t config = insole_particle_filter_defaults;
            config.redraw_share = redraw ? INSOLE_R(0.1) : 0;
            begin_world(50u + seed, 0.0, 0.0, 0.0);
            begin_filter(&config, N);
            start(walk[0].x + 5.0, 23.0, 0.3, 0.0, 0.1);
            double error = follow(1, STRIDES, true);
            ASSERT_AT_MOST(redraw ? error : 0.0, 1.5, "m");
            ck_assert(redraw == (filter.counts.redrawn > 0));
            errors[redraw] += error;
        }
    }
    ASSERT_AT_LEAST(errors[0], 3.0 * errors[1], "m");
}
END_TEST

/* At the first scan that points across the block a share of the cloud goes there, to where the
 * walker is by now, all weigh the same, and the cloud reaches so far as to hold both. */
START_TEST(a_share_is_drawn_where_the_scan_points)
{
    double share = (double)insole_particle_filter_defaults.redraw_share, rest = 1.0 - share;
    begin_world(50u, 0.0, 0.0, 0.0);
    begin_filter(&insole_particle_filter_defaults, N);
    start(walk[0].x + 5.0, 23.0, 0.3, 0.0, 0.01);
    insole_spot_t since = {INSOLE_R(0.5), INSOLE_R(-2.5)};
    for (int k = 1; filter.counts.redrawn == 0; k++) {
        ck_assert_int_lt(k, STRIDES);
        insole_evidence_t news = stride_of(k);
        hear(&news, k);
        news.since = since;
        begin(&news);
        finish_work();
    }
    uint32_t away = 0;
    for (uint32_t i = 0; i < N; i++) {
        away += particles[i].y_m < 17;
        ck_assert(!insole_particle_lives(&particles[i]) ||
                  fabs((double)(particles[i].log_weight - particles[1].log_weight)) < 1e-6);
    }
    ASSERT_NEAR(away, share * N, 8.0, "particles");
    const insole_anchor_fix_t *there = &filter.field.elsewhere;
    ASSERT_NEAR(filter.source.x_m, (double)there->x_m + 0.5 * (double)filter.fix.scale, 0.1, "m");
    ASSERT_NEAR(filter.source.y_m, (double)there->y_m - 2.5 * (double)filter.fix.scale, 0.1, "m");
    ASSERT_NEAR(filter.reach.y_m, rest * (double)filter.fix.y_m + share * (double)filter.source.y_m,
                0.01, "m");
    double apart = (double)(filter.source.y_m - filter.fix.y_m);
    ASSERT_NEAR(filter.reach.var_y_m2,
                rest * (double)filter.fix.var_y_m2 + share * (double)filter.source.var_y_m2 +
                    rest * share * apart * apart,
                0.01, "m2");
    ASSERT_AT_LEAST(filter.source.sigma_offset_rad,
                    insole_particle_filter_defaults.redraw_offset_rad, "rad");
}
END_TEST

/* The radio is computed about where the walker was when he heard it: ahead of the last fix by the
 * stride, behind its end by the way since, both turned into the map. */
START_TEST(the_field_lies_where_the_scan_was_heard)
{
    insole_evidence_t news;
    insole_spot_t since = {INSOLE_R(0.9), INSOLE_R(0.3)};
    begin_world(51u, 0.0, 0.0, 2.0);
    begin_filter(&insole_particle_filter_defaults, N);
    start(walk[0].x, walk[0].y, 0.1, 2.0, 0.02);
    double x = (double)filter.fix.x_m, y = (double)filter.fix.y_m;
    double offset = (double)filter.fix.offset_rad;
    insole_evidence_clear(&news);
    insole_evidence_stride(&news, INSOLE_R(1.4), -2, 0);
    hear(&news, 1);
    news.since = since;
    begin(&news);
    double dx = 1.4 * cos(-2.0) - 0.9, dy = 1.4 * sin(-2.0) - 0.3;
    ASSERT_NEAR(filter.field.centre.x_m, x + dx * cos(offset) - dy * sin(offset), 0.01, "m");
    ASSERT_NEAR(filter.field.centre.y_m, y + dx * sin(offset) + dy * cos(offset), 0.01, "m");
    ASSERT_NEAR(atan2((double)filter.field.direction.sin, (double)filter.field.direction.cos),
                -2.0 + offset, 1e-4, "rad");
    ck_assert_uint_eq(filter.field.views, 1);
    finish_work();
    start(walk[0].x, walk[0].y, 0.1, 2.0, 3.2); /* in which direction nobody knows */
    hear(&news, 1);
    begin(&news);
    ck_assert_uint_eq(filter.field.views, 4);
}
END_TEST

START_TEST(on_a_good_walk_nothing_is_redrawn)
{
    uint32_t redrawn = 0;
    for (uint64_t seed = 0; seed < 4; seed++) {
        begin_world(60u + seed, 0.0, 0.0, 0.0);
        begin_filter(&insole_particle_filter_defaults, N);
        start(walk[0].x, walk[0].y, 0.3, 0.0, 0.1);
        follow(1, STRIDES, true);
        redrawn += filter.counts.redrawn;
        ck_assert_uint_eq(filter.counts.recovered, 0);
    }
    ASSERT_AT_MOST(redrawn, 4, "times in 240 strides");
}
END_TEST

/* Strides that lead through the wall again and again: everyone dies, each time the cloud is drawn
 * about where it should be, twice as wide as before, and it never stops. Copies that are spread
 * soon find a way to walk so, around the corridor; without it all keep dying. */
START_TEST(when_all_have_died_it_goes_on)
{
    insole_particle_filter_config_t config = insole_particle_filter_defaults;
    config.spread_share = _i == 0 ? 0 : config.spread_share;
    begin_world(70u, 0.0, 0.0, 0.0);
    begin_filter(&config, N);
    start(20.0, 1.0, 0.1, 0.0, 0.02);
    insole_evidence_t news;
    double widest = 0.0;
    uint32_t deaths = 0;
    for (int k = 0; k < 100; k++) {
        insole_evidence_clear(&news);
        insole_evidence_stride(&news, 3, INSOLE_R(-1.5708), 0); /* out of the building */
        begin(&news);
        finish_work();
        ck_assert(insole_is_finite(filter.fix.x_m) && insole_is_finite(filter.fix.y_m));
        ck_assert(filter.fix.effective >= INSOLE_R(0.99));
        widest = fmax(widest, sqrt((double)(filter.fix.var_x_m2 + filter.fix.var_y_m2)));
        deaths = filter.deaths > deaths ? filter.deaths : deaths;
        ck_assert(
            insole_floor_plan_inside(radio.building.plan, particles[0].x_m, particles[0].y_m) ||
            !insole_particle_lives(&particles[0]));
    }
    ASSERT_AT_LEAST(filter.counts.recovered, _i == 0 ? 10 : 1, "times");
    ASSERT_AT_LEAST(deaths, 3, "times in a row");
    ASSERT_AT_LEAST(widest, ldexp((double)config.recover_sigma_m, (int)deaths - 1), "m");
    ck_assert_uint_eq(filter.counts.strides, 100);
    start(20.0, 1.0, 0.1, 0.0, 0.02);
    ck_assert_uint_eq(filter.deaths, 0);
    ASSERT_NEAR(filter.fix.var_x_m2, 0.01, 0.003, "m2");
}
END_TEST

/* One death of all is forgotten after some strides. */
START_TEST(it_recovers_from_one_wrong_stride)
{
    begin_world(71u, 0.0, 0.0, 0.0);
    begin_filter(&insole_particle_filter_defaults, N);
    start(walk[0].x, walk[0].y, 0.2, 0.0, 0.05);
    follow(1, 8, true);
    insole_evidence_t news;
    insole_evidence_clear(&news);
    insole_evidence_stride(&news, 3, INSOLE_R(1.5708), 0);
    begin(&news);
    finish_work();
    ck_assert_uint_eq(filter.counts.recovered, 1);
    ck_assert_uint_eq(filter.deaths, 1);
    ASSERT_AT_MOST(error_at(8), 4.0, "m"); /* near the last good fix */
    ASSERT_AT_MOST(follow(9, STRIDES, true), 0.8, "m");
    ck_assert_uint_eq(filter.deaths, 0);
}
END_TEST

/* A start just outside: the nearest rooms are found. */
START_TEST(a_start_beside_the_building)
{
    begin_world(73u, 0.0, 0.0, 0.0);
    begin_filter(&insole_particle_filter_defaults, N);
    start(walk[0].x, -3.0, 0.2, 0.0, 0.1);
    ASSERT_NEAR(filter.fix.y_m, 0.5, 1.5, "m");
    ck_assert_uint_eq(filter.counts.recovered, 0);
    for (uint32_t i = 0; i < N; i++) {
        ck_assert(
            insole_floor_plan_inside(radio.building.plan, particles[i].x_m, particles[i].y_m) ||
            !insole_particle_lives(&particles[i]));
    }
    ASSERT_AT_MOST(follow(1, STRIDES, true), 0.8, "m");
}
END_TEST

/* A start far from any room: the plan is set aside rather than the walker. */
START_TEST(a_start_where_nobody_can_be)
{
    begin_world(72u, 0.0, 0.0, 0.0);
    begin_filter(&insole_particle_filter_defaults, N);
    start(-300.0, -300.0, 0.5, 0.0, 0.1);
    ASSERT_NEAR(filter.fix.x_m, -300.0, 10.0, "m");
    ASSERT_NEAR(filter.fix.effective, N, 0.5, "particles");
    ASSERT_AT_MOST(follow(1, STRIDES, true), 2.0, "m"); /* and scans bring it back */
}
END_TEST

/* ---- the same bits ---- */

/* A walk on which everything happens: scans, ranges, positions, standing, a wall in the way. */
static void eventful_walk(void)
{
    insole_spot_t since = {INSOLE_R(0.4), INSOLE_R(-0.1)};
    for (int k = 1; k <= 30; k++) {
        insole_evidence_t news = stride_of(k);
        if (k == 12) {
            news.length_m = 60; /* out through all walls */
        }
        if (k % 3 == 0) {
            hear(&news, k);
            news.since = since;
        }
        if (k % 4 == 0) {
            insole_evidence_range_t range = {{5, 5}, since, 9, 3, k % 8 == 0 ? 3 : 0};
            insole_evidence_range(&news, &range);
        }
        if (k % 7 == 0) {
            insole_spot_t position = {(insole_real_t)walk[k].x, (insole_real_t)walk[k].y};
            insole_evidence_position(&news, position, 2);
        }
        begin(&news);
        finish_work();
    }
}

static void run_eventful(uint32_t count, uint32_t in_slices_of)
{
    insole_particle_filter_config_t config = insole_particle_filter_defaults;
    config.field.elsewhere_weight = 1;
    config.redraw_margin = 0; /* so that more happens */
    begin_world(80u, 0.0, 0.0, 0.0);
    begin_filter(&config, count);
    cloud.past = past;
    cloud.past_strides = PAST;
    memset(past, 0, sizeof past);
    slice = in_slices_of;
    start(walk[0].x + 14.0, walk[0].y, 0.3, 0.0, 0.1);
    eventful_walk();
}

/* The fix changes once in the work of a stride, when it has settled, and not after that. */
START_TEST(it_has_settled_as_soon_as_its_fix_is_the_new_one)
{
    uint32_t late = 0u;
    begin_world(81u, 0.0, 0.0, 0.0);
    begin_filter(&insole_particle_filter_defaults, N);
    start(walk[0].x, walk[0].y, 0.3, 0.0, 0.1);
    for (int k = 1; k <= 30; k++) {
        const insole_cloud_fix_t before = filter.fix;
        insole_evidence_t news = stride_of(k);
        hear(&news, k);
        begin(&news);
        ck_assert(!insole_particle_filter_has_settled(&filter));
        while (insole_particle_filter_work(&filter, &cloud, &radio.building, 20)) {
            bool is_new = memcmp(&before, &filter.fix, sizeof before) != 0;
            ck_assert_int_eq(insole_particle_filter_has_settled(&filter), is_new);
            late += is_new ? 1u : 0u;
        }
        ck_assert(insole_particle_filter_has_settled(&filter));
    }
    ck_assert_uint_gt(late, 0u); /* work was left after it */
}
END_TEST

static insole_particle_filter_t whole_filter;
static insole_particle_t whole_particles[N];
static insole_spot_t whole_past[N * PAST];

static void keep_whole(void)
{
    whole_filter = filter;
    memcpy(whole_particles, particles, sizeof whole_particles);
    memcpy(whole_past, past, sizeof whole_past);
}

static void compare_with_whole(void)
{
    ck_assert_mem_eq(&filter, &whole_filter, sizeof filter);
    ck_assert_mem_eq(particles, whole_particles, sizeof whole_particles);
    ck_assert_mem_eq(past, whole_past, sizeof whole_past);
}

START_TEST(sliced_or_whole_the_bits_are_the_same)
{
    static const uint32_t slices[] = {1, 2, 13, 100, 499, 500, 501, 1500};
    run_eventful(N, WHOLE);
    ck_assert(filter.counts.resampled > 0 && filter.counts.recovered > 0 &&
              filter.counts.redrawn > 0); /* else it would not show much */
    keep_whole();
    for (size_t i = 0; i < sizeof slices / sizeof slices[0]; i++) {
        run_eventful(N, slices[i]);
        compare_with_whole();
    }
}
END_TEST

/* ---- what it costs ---- */

START_TEST(five_hundred_particles_fit_in_16_kilobytes)
{
    size_t floats = sizeof(insole_real_t) / sizeof(float);
    ck_assert_uint_le(sizeof filter + 500 * sizeof particles[0], 16384 * floats);
}
END_TEST

/* Works in a stride with a scan up to the end of the phase.
 *  @return calls that this took, with a budget of one pair of a node and an access point */
static uint32_t calls_in_phase(insole_particle_phase_t phase)
{
    uint32_t calls = 0;
    while (filter.phase != phase) {
        ck_assert(insole_particle_filter_work(&filter, &cloud, &radio.building, 1));
    }
    for (; filter.phase == phase; calls++) {
        ck_assert(insole_particle_filter_work(&filter, &cloud, &radio.building, 1));
    }
    return calls;
}

/* However many particles there are, the walls between nodes and access points are all that the
 * radio needs: once the field is computed nobody asks for the building any more. */
START_TEST(walls_weaken_the_radio_by_node_not_by_particle)
{
    static const uint32_t counts[] = {N, N_MAX};
    begin_world(21u, 0.0, 0.0, 0.0);
    begin_filter(&insole_particle_filter_defaults, counts[_i]);
    start(walk[0].x, walk[0].y, 0.3, 0.0, 0.1);
    for (int k = 1; k < 4; k++) {
        insole_evidence_t news = stride_of(k);
        hear(&news, k);
        begin(&news);
        ck_assert_uint_le(calls_in_phase(INSOLE_PARTICLES_FIELD),
                          (INSOLE_RSS_FIELD_NODES + 1) * APS);
        ck_assert_int_eq(filter.phase, INSOLE_PARTICLES_WEIGH);
        while (insole_particle_filter_work(&filter, &cloud, NULL, WHOLE)) {
        }
        ASSERT_AT_MOST(error_at(k), 0.5, "m");
    }
    ck_assert_uint_eq(filter.counts.scans, 3);
}
END_TEST

/* The comb lies anew each time. */
START_TEST(resampling_draws_its_shift)
{
    insole_real_t shift = -1;
    uint32_t shifts = 0, resampled = 0;
    begin_world(82u, 0.0, 0.0, 0.0);
    begin_filter(&insole_particle_filter_defaults, N);
    start(walk[0].x, walk[0].y, 0.3, 0.0, 0.1);
    for (int k = 1; k <= STRIDES; k++) {
        step(k, true);
        if (filter.counts.resampled > resampled) {
            resampled = filter.counts.resampled;
            shifts += filter.comb.shift < shift || filter.comb.shift > shift ? 1u : 0u;
            shift = filter.comb.shift;
            ck_assert(shift >= 0 && shift < 1);
        }
    }
    ASSERT_AT_LEAST(shifts, 5, "shifts");
    ck_assert_uint_eq(shifts, resampled);
}
END_TEST

START_TEST(equal_seeds_give_equal_bits_others_do_not)
{
    run_eventful(N, WHOLE);
    keep_whole();
    run_eventful(N, WHOLE);
    compare_with_whole();
    begin_world(80u, 0.0, 0.0, 0.0);
    begin_filter(&insole_particle_filter_defaults, N);
    insole_particle_filter_init(&filter, &insole_particle_filter_defaults, 43u);
    start(walk[0].x + 14.0, walk[0].y, 0.3, 0.0, 0.1);
    eventful_walk();
    ck_assert(memcmp(particles, whole_particles, sizeof whole_particles) != 0);
}
END_TEST

/* Saved in the middle of a stride, restored into other memory after a reset. */
START_TEST(saved_and_restored_it_goes_on_alike)
{
    static uint8_t flash[sizeof filter + INSOLE_SNAPSHOT_HEADER_BYTES];
    static insole_particle_t kept[N];
    size_t used;
    begin_world(81u, 0.0, 0.0, 0.0);
    begin_filter(&insole_particle_filter_defaults, N);
    start(walk[0].x, walk[0].y, 0.3, 0.0, 0.1);
    follow(1, 10, true);
    insole_evidence_t news = stride_of(11);
    hear(&news, 11);
    begin(&news);
    ck_assert(insole_particle_filter_work(&filter, &cloud, &radio.building, 700));
    ck_assert_int_eq(insole_snapshot_save(1u, &filter, sizeof filter, flash, sizeof flash, &used),
                     INSOLE_OK);
    memcpy(kept, particles, sizeof kept);
    insole_rng_t world = rng;
    finish_work();
    follow(12, 30, true);
    keep_whole();
    memset(&filter, 0xA5, sizeof filter);
    ck_assert_int_eq(insole_snapshot_load(1u, &filter, sizeof filter, flash, used), INSOLE_OK);
    memcpy(&particles[N], kept, sizeof kept);
    cloud.particles = &particles[N];
    rng = world;
    finish_work();
    follow(12, 30, true);
    ck_assert_mem_eq(&filter, &whole_filter, sizeof filter);
    ck_assert_mem_eq(&particles[N], whole_particles, sizeof whole_particles);
}
END_TEST

/* ---- little to go on ---- */

static const uint32_t few[] = {1, 2, 3};

START_TEST(few_particles_do)
{
    begin_world(90u, 0.0, 0.0, 0.0);
    begin_filter(&insole_particle_filter_defaults, few[_i]);
    start(walk[0].x, walk[0].y, 0.1, 0.0, 0.02);
    for (int k = 1; k <= STRIDES; k++) {
        step(k, k % 2 == 0);
        ck_assert(insole_is_finite(filter.fix.x_m) && insole_is_finite(filter.fix.y_m));
        ck_assert(filter.fix.var_x_m2 >= 0 && filter.fix.var_y_m2 >= 0);
    }
    ASSERT_AT_MOST(error_at(STRIDES), 60.0, "m");
}
END_TEST

/* A plan without walls near by, no plan, no radio, no list of access points, nothing at all. */
START_TEST(whatever_is_missing_it_walks_on)
{
    begin_world(91u, 0.0, 0.0, 0.0);
    insole_building_t all = radio.building;
    for (int missing = 0; missing < 6; missing++) {
        radio.building = all;
        insole_building_t *b = &radio.building;
        if (missing == 1) {
            b->plan = NULL;
        } else if (missing == 2) {
            b->propagation = NULL;
        } else if (missing == 3) {
            b->aps = NULL;
        } else if (missing == 4) {
            b->ap_count = 0;
        }
        begin_filter(&insole_particle_filter_defaults, N);
        start(walk[0].x, walk[0].y, 0.3, 0.0, 0.05);
        for (int k = 1; k <= 20; k++) {
            insole_evidence_t news = stride_of(k);
            radio_t full = radio;
            full.building = all;
            radio_listen(&full, &rng, walk[k].x, walk[k].y, 0.0, 3.0, APS, readings);
            insole_spot_t none = {0, 0};
            insole_evidence_scan(&news, readings, missing == 5 ? 0 : APS, none);
            begin(&news);
            finish_work();
        }
        ck_assert_uint_eq(filter.counts.scans, missing < 2 ? 20 : 0);
        ASSERT_AT_MOST(error_at(20), 4.0, "m");
    }
    ck_assert_int_eq(insole_particle_filter_begin(&filter, NULL, &(insole_evidence_t){0}),
                     INSOLE_OK);
    while (insole_particle_filter_work(&filter, &cloud, NULL, WHOLE)) {
    }
}
END_TEST

START_TEST(three_hundred_access_points)
{
    begin_world(92u, 0.0, 0.0, 0.0);
    insole_rng_seed(&rng, 93u);
    const insole_floor_plan_t *plan = radio.building.plan;
    radio_scatter(&radio, &rng, 300, 0.0, 0.0);
    radio.building.plan = plan;
    begin_filter(&insole_particle_filter_defaults, N);
    start(walk[0].x, walk[0].y, 0.3, 0.0, 0.1);
    ASSERT_AT_MOST(follow(1, 20, true), 0.6, "m");
    ck_assert_uint_eq(filter.field.heard_count, INSOLE_RSS_FIELD_HEARD);
}
END_TEST

/* Standing for ten minutes with a scan a second: nobody moves, the cloud does not fall apart. */
START_TEST(standing_still)
{
    begin_world(94u, 0.0, 0.0, 0.0);
    begin_filter(&insole_particle_filter_defaults, N);
    start(walk[0].x, walk[0].y, 0.5, 0.0, 0.1);
    step(1, true);
    for (int k = 0; k < 600; k++) {
        insole_evidence_t news;
        insole_evidence_clear(&news);
        hear(&news, 1);
        begin(&news);
        finish_work();
        ck_assert(filter.fix.var_x_m2 >= 0 && insole_is_finite(filter.fix.x_m));
        ASSERT_NEAR(particles[filter.weighing.heaviest].log_weight, 0.0, 100.0, "");
    }
    ck_assert_uint_eq(filter.counts.strides, 1);
    ASSERT_AT_MOST(error_at(1), 1.5, "m");
    ASSERT_AT_MOST(follow(2, 20, true), 1.5, "m");
}
END_TEST

/* ---- seen from later ---- */

START_TEST(later_the_past_is_known_better)
{
    double now = 0.0, later = 0.0;
    int count = 0;
    for (uint64_t seed = 0; seed < 4; seed++) {
        begin_world(100u + seed, 0.0, 0.0, 0.0);
        begin_filter(&insole_particle_filter_defaults, N);
        cloud.past = past;
        cloud.past_strides = PAST;
        start(walk[0].x, walk[0].y, 0.3, 0.1, 0.15);
        for (int k = 1; k <= STRIDES; k++) {
            insole_spot_t mean;
            step(k, true);
            now += error_at(k);
            if (k >= 8) {
                ck_assert_int_eq(insole_particle_filter_past(&filter, &cloud, 8, &mean), INSOLE_OK);
                later += hypot((double)mean.x_m - walk[k - 8].x, (double)mean.y_m - walk[k - 8].y);
                count++;
            }
        }
    }
    ASSERT_AT_MOST(later / count, 0.85 * now / (4 * STRIDES), "m");
}
END_TEST

START_TEST(the_past_has_an_end)
{
    insole_spot_t mean = {7, 8};
    begin_world(101u, 0.0, 0.0, 0.0);
    begin_filter(&insole_particle_filter_defaults, N);
    ck_assert_int_eq(insole_particle_filter_past(&filter, &cloud, 0, &mean), INSOLE_ERR_STATE);
    start(walk[0].x, walk[0].y, 0.3, 0.0, 0.1);
    ck_assert_int_eq(insole_particle_filter_past(&filter, &cloud, 0, &mean), INSOLE_ERR_STATE);
    cloud.past = past; /* none was kept before */
    cloud.past_strides = 4;
    start(walk[0].x, walk[0].y, 0.3, 0.0, 0.1);
    ck_assert_int_eq(insole_particle_filter_past(&filter, &cloud, 1, &mean), INSOLE_ERR_STATE);
    for (int k = 1; k <= 6; k++) {
        step(k, true);
    }
    ck_assert_int_eq(insole_particle_filter_past(&filter, &cloud, 4, &mean), INSOLE_ERR_STATE);
    ASSERT_NEAR(mean.x_m, 7.0, 0.0, "m");
    for (uint32_t ago = 0; ago < 4; ago++) {
        ck_assert_int_eq(insole_particle_filter_past(&filter, &cloud, ago, &mean), INSOLE_OK);
        ASSERT_NEAR(mean.x_m, walk[6 - ago].x, 1.5, "m");
        ASSERT_NEAR(mean.y_m, walk[6 - ago].y, 1.5, "m");
    }
    ck_assert_int_eq(insole_particle_filter_past(NULL, &cloud, 0, &mean), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_particle_filter_past(&filter, NULL, 0, &mean), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_particle_filter_past(&filter, &cloud, 0, NULL), INSOLE_ERR_NULL);
    insole_evidence_t news = stride_of(7);
    begin(&news);
    ck_assert_int_eq(insole_particle_filter_past(&filter, &cloud, 0, &mean), INSOLE_ERR_STATE);
}
END_TEST

/* ---- refusals ---- */

/* Refused and counted, and everything else as it was. */
#define REFUSED(call, status)                                                                      \
    do {                                                                                           \
        insole_particle_filter_t before_ = filter;                                                 \
        ck_assert_int_eq(call, status);                                                            \
        before_.counts.refused++;                                                                  \
        ck_assert_mem_eq(&filter, &before_, sizeof filter);                                        \
    } while (0)

static const double bad_starts[][5] = {
    {(double)NAN, 0, 1, 0, 1}, {0, (double)NAN, 1, 0, 1}, {0, 0, (double)NAN, 0, 1},
    {0, 0, 1, (double)NAN, 1}, {0, 0, 1, 0, (double)NAN}, {0, 0, -1, 0, 1},
    {0, 0, 1, 0, -1},          {HUGE_VAL, 0, 1, 0, 1},    {0, 0, 2e4, 0, 1}};

START_TEST(starts_that_make_no_sense_are_refused)
{
    const double *b = bad_starts[_i];
    insole_particle_start_t s = start_at(b[0], b[1], b[2], b[3], b[4]);
    begin_world(110u, 0.0, 0.0, 0.0);
    begin_filter(&insole_particle_filter_defaults, N);
    REFUSED(insole_particle_filter_start(&filter, &cloud, &s), INSOLE_ERR_VALUE);
    start(1.0, 1.0, 0.1, 0.0, 0.1);
    REFUSED(insole_particle_filter_start(&filter, &cloud, &s), INSOLE_ERR_VALUE);
}
END_TEST

START_TEST(calls_at_the_wrong_time_are_refused)
{
    insole_evidence_t news;
    insole_particle_start_t s = start_at(1.0, 1.0, 0.1, 0.0, 0.1);
    begin_world(111u, 0.0, 0.0, 0.0);
    begin_filter(&insole_particle_filter_defaults, N);
    news = stride_of(1);
    REFUSED(insole_particle_filter_begin(&filter, &radio.building, &news), INSOLE_ERR_STATE);
    ck_assert(!insole_particle_filter_work(&filter, &cloud, &radio.building, 10));
    insole_particle_filter_start(&filter, &cloud, &s);
    REFUSED(insole_particle_filter_begin(&filter, &radio.building, &news), INSOLE_ERR_STATE);
    finish_work();
    begin(&news);
    insole_particle_filter_work(&filter, &cloud, &radio.building, 10);
    REFUSED(insole_particle_filter_begin(&filter, &radio.building, &news), INSOLE_ERR_STATE);
    ck_assert_uint_eq(filter.counts.refused, 3);
    ck_assert_int_eq(insole_particle_filter_start(&filter, &cloud, &s), INSOLE_OK); /* any time */
    finish_work();
    ASSERT_NEAR(filter.fix.x_m, 1.0, 0.1, "m");
    ck_assert_uint_eq(filter.since_start, 0);
}
END_TEST

START_TEST(news_that_make_no_sense_are_refused)
{
    begin_world(112u, 0.0, 0.0, 0.0);
    begin_filter(&insole_particle_filter_defaults, N);
    start(1.0, 1.0, 0.1, 0.0, 0.1);
    insole_evidence_t news = stride_of(1);
    news.length_m = (insole_real_t)NAN;
    REFUSED(insole_particle_filter_begin(&filter, &radio.building, &news), INSOLE_ERR_VALUE);
    REFUSED(insole_particle_filter_begin(&filter, &radio.building, NULL), INSOLE_ERR_NULL);
    insole_particle_start_t s = start_at(1.0, 1.0, 0.1, 0.0, 0.1);
    insole_cloud_t none = {NULL, 3, NULL, 0, NULL}, empty = {particles, 0, NULL, 0, NULL};
    REFUSED(insole_particle_filter_start(&filter, NULL, &s), INSOLE_ERR_NULL);
    REFUSED(insole_particle_filter_start(&filter, &none, &s), INSOLE_ERR_NULL);
    REFUSED(insole_particle_filter_start(&filter, &empty, &s), INSOLE_ERR_VALUE);
    REFUSED(insole_particle_filter_start(&filter, &cloud, NULL), INSOLE_ERR_NULL);
}
END_TEST

START_TEST(another_cloud_is_left_alone)
{
    begin_world(113u, 0.0, 0.0, 0.0);
    begin_filter(&insole_particle_filter_defaults, N);
    start(1.0, 1.0, 0.1, 0.0, 0.1);
    insole_evidence_t news = stride_of(1);
    begin(&news);
    keep_whole();
    insole_cloud_t other = {particles, N + 1, NULL, 0, NULL};
    ck_assert(!insole_particle_filter_work(&filter, &other, &radio.building, 10));
    ck_assert(!insole_particle_filter_work(&filter, NULL, &radio.building, 10));
    ck_assert(!insole_particle_filter_work(NULL, &cloud, &radio.building, 10));
    ck_assert(insole_particle_filter_work(&filter, &cloud, &radio.building, 0));
    ck_assert_mem_eq(&filter, &whole_filter, sizeof filter);
    ck_assert_mem_eq(particles, whole_particles, sizeof whole_particles);
}
END_TEST

START_TEST(null_is_refused)
{
    insole_particle_start_t s = start_at(1.0, 1.0, 0.1, 0.0, 0.1);
    insole_evidence_t news;
    insole_evidence_clear(&news);
    begin_filter(&insole_particle_filter_defaults, N);
    ck_assert_int_eq(insole_particle_filter_init(NULL, &insole_particle_filter_defaults, 1u),
                     INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_particle_filter_init(&filter, NULL, 1u), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_particle_filter_start(NULL, &cloud, &s), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_particle_filter_begin(NULL, NULL, &news), INSOLE_ERR_NULL);
}
END_TEST

static insole_status_t init_all(const insole_particle_filter_config_t *config)
{
    return insole_particle_filter_init_steps(&filter, config, &insole_step_weighing_calls, 1u);
}

/* Each setting at its ends passes, beyond them it does not. */
#define CHECK_RANGE(kind, name, value, low, high, unit, text)                                      \
    do {                                                                                           \
        insole_particle_filter_config_t c = insole_particle_filter_defaults;                       \
        c.name = INSOLE_CONFIG_LITERAL_##kind(low);                                                \
        ck_assert_int_eq(init_all(&c), INSOLE_OK);                                                 \
        c.name = INSOLE_CONFIG_LITERAL_##kind(high);                                               \
        ck_assert_int_eq(init_all(&c), INSOLE_OK);                                                 \
        insole_particle_filter_t before_ = filter;                                                 \
        c.name += 1;                                                                               \
        ck_assert_int_eq(init_all(&c), INSOLE_ERR_VALUE);                                          \
        c.name = INSOLE_CONFIG_LITERAL_##kind(low);                                                \
        c.name -= 1;                                                                               \
        ck_assert_int_eq(init_all(&c), INSOLE_ERR_VALUE);                                          \
        ck_assert_mem_eq(&filter, &before_, sizeof filter);                                        \
    } while (0);

START_TEST(settings_keep_to_their_ranges)
{
    INSOLE_PARTICLE_FILTER_KEYS(CHECK_RANGE)
    insole_particle_filter_config_t c = insole_particle_filter_defaults;
    c.field.cover = (insole_real_t)NAN;
    ck_assert_int_eq(insole_particle_filter_init(&filter, &c, 1u), INSOLE_ERR_VALUE);
    ck_assert_int_eq(insole_particle_filter_init(&filter, &insole_particle_filter_two_order, 1u),
                     INSOLE_OK);
}
END_TEST

/* ---- whatever comes ---- */

static insole_real_t wild(double size)
{
    static const double odd[] = {0.0, 1e-30, 1e30, -1e30, 1e5};
    uint32_t pick = insole_rng_bits(&rng) % 20u;
    double x = pick < 5u ? odd[pick] : draw_uniform(&rng, -size, size);
    return pick == 19u ? (insole_real_t)NAN : (insole_real_t)x;
}

static void make_wild(insole_evidence_t *news)
{
    insole_evidence_range_t range = {
        {wild(50.0), wild(50.0)}, {wild(3.0), wild(3.0)}, wild(30.0), wild(3.0), wild(5.0)};
    insole_spot_t a = {wild(50.0), wild(50.0)}, b = {wild(3.0), wild(3.0)};
    insole_evidence_clear(news);
    insole_evidence_stride(news, wild(5.0), wild(9.0), wild(9.0));
    insole_evidence_position(news, a, wild(5.0));
    insole_evidence_range(news, &range);
    for (uint32_t i = 0; i < 20; i++) {
        readings[i].id = insole_rng_bits(&rng) % 15u;
        readings[i].rss_dbm = wild(100.0);
    }
    insole_evidence_scan(news, readings, insole_rng_bits(&rng) % 20u, b);
}

/* Whatever is told: what comes out is finite, covariances are positive, work comes to an end. */
START_TEST(whatever_comes_the_fix_is_finite)
{
    begin_world(120u + (uint64_t)_i, 0.0, 0.0, 0.0);
    begin_filter(_i == 0 ? &insole_particle_filter_two_order : &insole_particle_filter_defaults,
                 60);
    start(10.0, 1.0, 1.0, 0.0, 3.2);
    slice = 17;
    for (int k = 0; k < 2000; k++) {
        insole_evidence_t news;
        make_wild(&news);
        begin(&news);
        finish_work();
        const insole_cloud_fix_t *f = &filter.fix;
        double xx = (double)f->var_x_m2, xy = (double)f->cov_xy_m2, yy = (double)f->var_y_m2;
        ck_assert(insole_is_finite(f->x_m) && insole_is_finite(f->y_m) &&
                  insole_is_finite(f->offset_rad) && insole_is_finite(f->scale));
        ck_assert(xx >= 0.0 && yy >= 0.0 && xx < 1e12 && yy < 1e12);
        ck_assert(xy * xy <= xx * yy * (1.0 + 1e-5));
        ck_assert(f->effective >= INSOLE_R(0.99) && f->effective <= INSOLE_R(60.01));
    }
    ck_assert_uint_eq(filter.counts.refused, 0);
}
END_TEST

/* Without the calls for what a phone tells there is no start about a fix, no compass, and no wall
 * is soft; what a shoe tells is as ever. */
START_TEST(what_a_phone_tells_needs_its_calls)
{
    insole_particle_filter_config_t soft = insole_particle_filter_defaults;
    soft.walls = INSOLE_WALLS_SOFT;
    begin_filter(&insole_particle_filter_defaults, 50);
    insole_particle_filter_t before_ = filter;
    ck_assert_int_eq(insole_particle_filter_init(&filter, &soft, 1u), INSOLE_ERR_NULL);
    ck_assert_mem_eq(&filter, &before_, sizeof filter);
    ck_assert_int_eq(init_all(&soft), INSOLE_OK);
    for (int with = 0; with < 2; with++) {
        insole_status_t status = with ? INSOLE_OK : INSOLE_ERR_STATE;
        insole_particle_start_t s = {0, 0, 1, 0, INSOLE_R(0.1)};
        insole_spot_fix_t fix = {1000u, {0, 0}, insole_sym2(1, 0, 1), {0, 0}};
        insole_cloud_source_t source = insole_particle_start_source(&s, INSOLE_R(0.02));
        ck_assert_int_eq(
            with ? init_all(&insole_particle_filter_defaults)
                 : insole_particle_filter_init(&filter, &insole_particle_filter_defaults, 1u),
            INSOLE_OK);
        uint32_t refused = filter.counts.refused;
        ck_assert_int_eq(insole_particle_filter_start_from(&filter, &cloud, &source, &fix), status);
        ck_assert_int_eq(insole_particle_filter_start(&filter, &cloud, &s), INSOLE_OK);
        while (insole_particle_filter_work(&filter, &cloud, NULL, 1000u)) {
        }
        insole_evidence_t told;
        insole_evidence_clear(&told);
        ck_assert_int_eq(insole_evidence_compass(&told, INSOLE_R(0.1), INSOLE_R(0.2)), INSOLE_OK);
        ck_assert_int_eq(insole_particle_filter_begin(&filter, NULL, &told), status);
        ck_assert_uint_eq(filter.counts.refused, refused + (with ? 0u : 2u));
    }
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("particle_filter");
    suite_add(suite, "start", it_starts_where_told);
    suite_add(suite, "dead reckoning", strides_alone_are_dead_reckoning);
    suite_add(suite, "one stride of the paper", one_stride_of_the_paper_is_a_product_of_normals);
    suite_add(suite, "the paper", the_paper_corrects_the_inertial_position);
    suite_add(suite, "walls", walls_correct_the_offset);
    suite_add(suite, "scans", scans_alone_hold_the_position);
    suite_add(suite, "scans and walls", scans_and_walls_are_best);
    suite_add(suite, "far away", far_from_the_origin_it_does_as_well);
    suite_add(suite, "unknown direction", an_unknown_direction_is_found);
    suite_add(suite, "kidnapped", the_kidnapped_come_back);
    suite_add(suite, "a share", a_share_is_drawn_where_the_scan_points);
    suite_add(suite, "where heard", the_field_lies_where_the_scan_was_heard);
    suite_add(suite, "good walk", on_a_good_walk_nothing_is_redrawn);
    suite_add_loop(suite, "all dead", when_all_have_died_it_goes_on, 2);
    suite_add(suite, "one wrong stride", it_recovers_from_one_wrong_stride);
    suite_add(suite, "start beside", a_start_beside_the_building);
    suite_add(suite, "nobody can be there", a_start_where_nobody_can_be);
    suite_add(suite, "has settled", it_has_settled_as_soon_as_its_fix_is_the_new_one);
    suite_add(suite, "slices", sliced_or_whole_the_bits_are_the_same);
    suite_add(suite, "memory", five_hundred_particles_fit_in_16_kilobytes);
    suite_add_loop(suite, "walls by node", walls_weaken_the_radio_by_node_not_by_particle, 2);
    suite_add(suite, "shifts", resampling_draws_its_shift);
    suite_add(suite, "seeds", equal_seeds_give_equal_bits_others_do_not);
    suite_add(suite, "saved", saved_and_restored_it_goes_on_alike);
    suite_add_loop(suite, "few particles", few_particles_do, 3);
    suite_add(suite, "missing", whatever_is_missing_it_walks_on);
    suite_add(suite, "huge scans", three_hundred_access_points);
    suite_add(suite, "standing", standing_still);
    suite_add(suite, "past", later_the_past_is_known_better);
    suite_add(suite, "end of the past", the_past_has_an_end);
    suite_add_loop(suite, "bad starts", starts_that_make_no_sense_are_refused,
                   sizeof bad_starts / sizeof bad_starts[0]);
    suite_add(suite, "wrong time", calls_at_the_wrong_time_are_refused);
    suite_add(suite, "bad news", news_that_make_no_sense_are_refused);
    suite_add(suite, "another cloud", another_cloud_is_left_alone);
    suite_add(suite, "null", null_is_refused);
    suite_add(suite, "settings", settings_keep_to_their_ranges);
    suite_add_loop(suite, "whatever comes", whatever_comes_the_fix_is_finite, 3);
    suite_add(suite, "calls", what_a_phone_tells_needs_its_calls);
    return suite;
}
