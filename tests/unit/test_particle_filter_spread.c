/* SPDX-License-Identifier: MIT */
#include "insole/fuse/particle_filter.h"

#include <stdlib.h>
#include <string.h>

#include "radio.h"
#include "suite.h"

/* Copies that are spread, and what a scan says to a cloud that is wide. */

enum { N = 400, N_MAX = 20000, PAST = 4, APS = 12, WHOLE = 1 << 30 };

static radio_t radio;
static insole_rng_t rng;
static insole_rss_t readings[RADIO_APS];
static insole_particle_t particles[N_MAX], before[N_MAX];
static insole_spot_t past[N_MAX * PAST];
static insole_cloud_t cloud;
static insole_particle_filter_t filter, whole;
static insole_particle_filter_config_t config;
static const insole_building_t *building;

static void work(uint32_t slice)
{
    while (insole_particle_filter_work(&filter, &cloud, building, slice)) {
    }
    ck_assert_int_eq(filter.phase, INSOLE_PARTICLES_IDLE);
}

/* Resampled at every news. */
static void begin_world(void)
{
    insole_rng_seed(&rng, 5u);
    radio_scatter(&radio, &rng, APS, 0.0, 0.0);
    building = &radio.building;
    config = insole_particle_filter_defaults;
    config.resample_share = 1;
    config.redraw_share = 0;
}

static void start(uint32_t count, double x, double y, double sigma_m, double sigma_rad)
{
    insole_cloud_t c = {particles, count, past, PAST, NULL};
    insole_particle_start_t s = {(insole_real_t)x, (insole_real_t)y, (insole_real_t)sigma_m,
                                 INSOLE_R(0.4), (insole_real_t)sigma_rad};
    cloud = c;
    ck_assert_int_eq(insole_particle_filter_init(&filter, &config, 42u), INSOLE_OK);
    ck_assert_int_eq(insole_particle_filter_start(&filter, &cloud, &s), INSOLE_OK);
    work(WHOLE);
}

static insole_evidence_t position_news(double x, double y, double sigma_m)
{
    insole_evidence_t news;
    insole_spot_t spot = {(insole_real_t)x, (insole_real_t)y};
    insole_evidence_clear(&news);
    ck_assert_int_eq(insole_evidence_position(&news, spot, (insole_real_t)sigma_m), INSOLE_OK);
    return news;
}

static insole_evidence_t scan_news(double x, double y)
{
    insole_evidence_t news;
    insole_spot_t none = {0, 0};
    insole_evidence_clear(&news);
    radio_listen(&radio, &rng, x, y, 0.3, 3.0, APS, readings);
    ck_assert_int_eq(insole_evidence_scan(&news, readings, APS, none), INSOLE_OK);
    return news;
}

static void begin(const insole_evidence_t *news)
{
    ck_assert_int_eq(insole_particle_filter_begin(&filter, building, news), INSOLE_OK);
}

static void tell(const insole_evidence_t *news)
{
    begin(news);
    work(WHOLE);
}

/* ---- spreading ---- */

typedef struct {
    double x, y, offset, xx, xy, yy, offset2;
} moments_t;

static moments_t moments(void)
{
    moments_t m = {0, 0, 0, 0, 0, 0, 0};
    double n = cloud.count;
    for (uint32_t i = 0; i < cloud.count; i++) {
        m.x += (double)particles[i].x_m / n;
        m.y += (double)particles[i].y_m / n;
        m.offset += (double)particles[i].offset_rad / n;
    }
    for (uint32_t i = 0; i < cloud.count; i++) {
        double x = (double)particles[i].x_m - m.x, y = (double)particles[i].y_m - m.y;
        m.xx += x * x / n;
        m.xy += x * y / n;
        m.yy += y * y / n;
        m.offset2 += pow((double)particles[i].offset_rad - m.offset, 2.0) / n;
    }
    return m;
}

static const double shares[] = {0.0, 0.3, 1.0};

/* Each coordinate by a share of its own 1-sigma: variances grow by its square, nothing else moves.
 * The cloud is a long one on a slant. */
START_TEST(copies_are_spread_by_the_share)
{
    double share = shares[_i], grown = 1.0 + share * share;
    begin_world();
    building = NULL;
    config.spread_share = (insole_real_t)share;
    config.sigma_length_m = 1;
    start(N_MAX, 0.0, 0.0, 0.4, 0.2);
    insole_evidence_t news = position_news(1.0, 0.5, 1.5);
    ck_assert_int_eq(insole_evidence_stride(&news, 1, INSOLE_R(0.2), 0), INSOLE_OK);
    tell(&news);
    ck_assert_uint_eq(filter.counts.resampled, 1);
    const insole_cloud_fix_t *f = &filter.fix;
    moments_t m = moments();
    double sigma = sqrt((double)f->var_x_m2);
    ASSERT_NEAR(m.x, f->x_m, 0.02 * sigma, "m");
    ASSERT_NEAR(m.y, f->y_m, 0.02 * sigma, "m");
    ASSERT_NEAR(m.offset, f->offset_rad, 0.004, "rad");
    ASSERT_AT_LEAST(f->cov_xy_m2, 0.2, "m2");
    ASSERT_NEAR(m.xx, grown * (double)f->var_x_m2, 0.03 * m.xx, "m2");
    ASSERT_NEAR(m.yy, grown * (double)f->var_y_m2, 0.03 * m.yy, "m2");
    ASSERT_NEAR(m.xy, f->cov_xy_m2, 0.03 * m.xx, "m2");
    ASSERT_NEAR(m.offset2, grown * (double)f->var_offset_rad2, 0.03 * m.offset2, "rad2");
}
END_TEST

static int by_place(const void *a, const void *b)
{
    const insole_particle_t *p = a, *q = b;
    int x = (p->x_m > q->x_m) - (p->x_m < q->x_m);
    return x ? x : (p->y_m > q->y_m) - (p->y_m < q->y_m);
}

static uint32_t places(void)
{
    uint32_t different = 1;
    memcpy(before, particles, cloud.count * sizeof particles[0]);
    qsort(before, cloud.count, sizeof before[0], by_place);
    for (uint32_t i = 1; i < cloud.count; i++) {
        different += by_place(&before[i - 1], &before[i]) ? 1u : 0u;
    }
    return different;
}

/* Told again and again where it is, without a stride: copies of copies. Only those that are spread
 * remain a cloud. */
START_TEST(copies_do_not_stay_together)
{
    for (int spreads = 0; spreads < 2; spreads++) {
        begin_world();
        building = NULL;
        config.spread_share = spreads ? INSOLE_R(0.3) : 0;
        start(N, 0.0, 0.0, 1.0, 0.2);
        insole_evidence_t news = position_news(0.0, 0.0, 1.0);
        for (int k = 0; k < 10; k++) {
            tell(&news);
        }
        ck_assert_uint_eq(filter.counts.resampled, 10);
        if (spreads) {
            ck_assert_uint_eq(places(), N);
        } else {
            ASSERT_AT_MOST(places(), N / 4, "places");
        }
    }
}
END_TEST

START_TEST(without_copies_nobody_is_spread)
{
    begin_world();
    config.resample_share = 0;
    start(N, 20.0, 15.0, 1.0, 0.2);
    memcpy(before, particles, sizeof before);
    insole_evidence_t news = position_news(20.0, 15.0, 1.0);
    tell(&news);
    for (uint32_t i = 0; i < N; i++) {
        before[i].log_weight = particles[i].log_weight;
    }
    ck_assert_mem_eq(particles, before, N * sizeof particles[0]);
    ck_assert_uint_eq(filter.counts.resampled, 0);
    config.resample_share = 1;
    start(N, 20.0, 15.0, 1.0, 0.2);
    tell(&news);
    tell(&news); /* and one that makes copies is over with its news */
    uint32_t resampled = filter.counts.resampled;
    filter.config.resample_share = 0;
    memcpy(before, particles, sizeof before);
    tell(&news);
    ck_assert_uint_eq(filter.counts.resampled, resampled);
    ASSERT_NEAR(particles[7].x_m, before[7].x_m, 0.0, "m");
}
END_TEST

/* A room 10 m x 4 m, cut in two by a wall at x = 5. */
static void draw_rooms(void)
{
    draw_begin(&radio.drawing);
    draw_box(&radio.drawing, INSOLE_LINE_OUTLINE, 4.0, 0.0, 0.0, 10.0, 4.0);
    draw_wall(&radio.drawing, 4.0, 5.0, 0.0, 5.0, 4.0);
    ck_assert_int_eq(draw_build(&radio.drawing), INSOLE_OK);
    radio.building.plan = &radio.drawing.plan;
}

static uint32_t beyond(double x)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < cloud.count; i++) {
        count += (double)particles[i].x_m > x ? 1u : 0u;
    }
    return count;
}

/* Beside the wall for a long time: nobody comes through, nobody leaves the building, nobody dies.
 * Without the wall many would. */
START_TEST(nobody_is_spread_through_a_wall)
{
    for (int walls = 0; walls < 2; walls++) {
        begin_world();
        draw_rooms();
        building = walls ? &radio.building : NULL;
        config.spread_share = INSOLE_R(0.7);
        start(N, 4.3, 0.7, 0.15, 0.1);
        ck_assert_uint_eq(beyond(4.999), 0);
        insole_evidence_t news = position_news(4.3, 0.7, 2.0);
        uint32_t through = 0;
        for (int k = 0; k < 20; k++) {
            tell(&news);
            through += beyond(5.0);
            for (uint32_t i = 0; i < N && walls; i++) {
                ck_assert(insole_particle_lives(&particles[i]));
                ck_assert(drawing_inside(&radio.drawing, (double)particles[i].x_m,
                                         (double)particles[i].y_m));
            }
        }
        ck_assert_uint_eq(filter.counts.resampled, 20);
        ck_assert(walls ? through == 0 : through > N);
    }
}
END_TEST

/* When a scan points elsewhere and a share goes there, the rest are spread by the width of the
 * cloud that they are, not by that of both. */
START_TEST(those_that_stay_are_spread_by_their_own_width)
{
    begin_world();
    config.redraw_share = INSOLE_R(0.1);
    config.spread_share = INSOLE_R(0.5);
    start(N_MAX, 10.0, 5.0, 0.4, 0.1);
    while (filter.counts.redrawn == 0) {
        ck_assert_uint_le(filter.counts.scans, 50);
        insole_evidence_t news = scan_news(33.0, 26.0);
        tell(&news);
    }
    ASSERT_AT_LEAST(filter.reach.var_x_m2, 10.0, "m2");
    double var_m2 = 0.0;
    for (uint32_t i = 0; i < N_MAX; i++) {
        double x = (double)(particles[i].x_m - filter.fix.x_m);
        var_m2 += i % filter.redraw_every ? x * x / (0.9 * N_MAX) : 0.0;
    }
    ASSERT_NEAR(var_m2, 1.25 * (double)filter.fix.var_x_m2, 0.05 * var_m2, "m2");
}
END_TEST

/* The past keeps where they were put, not where the copy was made. */
START_TEST(the_past_knows_the_spread)
{
    insole_spot_t mean;
    begin_world();
    building = NULL;
    config.spread_share = 1;
    start(N, 0.0, 0.0, 1.0, 0.2);
    insole_evidence_t news = position_news(0.5, 0.5, 0.3);
    tell(&news);
    moments_t m = moments();
    ASSERT_AT_LEAST(hypot(m.x - (double)filter.fix.x_m, m.y - (double)filter.fix.y_m), 1e-3, "m");
    ck_assert_int_eq(insole_particle_filter_past(&filter, &cloud, 0, &mean), INSOLE_OK);
    ASSERT_NEAR(mean.x_m, m.x, 1e-5, "m");
    ASSERT_NEAR(mean.y_m, m.y, 1e-5, "m");
}
END_TEST

static void run_sliced(uint32_t slice)
{
    begin_world();
    draw_rooms();
    start(N, 4.3, 0.7, 0.3, 0.2);
    for (int k = 0; k < 6; k++) {
        insole_evidence_t news = scan_news(4.0, 2.0);
        insole_evidence_stride(&news, INSOLE_R(0.3), (insole_real_t)k, 1);
        begin(&news);
        work(slice);
    }
}

START_TEST(sliced_or_whole_they_are_spread_alike)
{
    static const uint32_t slices[] = {1, 3, N - 1, N, N + 1, 3 * N};
    static insole_particle_t whole_particles[N];
    run_sliced(WHOLE);
    ck_assert_uint_ge(filter.counts.resampled, 5);
    whole = filter;
    memcpy(whole_particles, particles, sizeof whole_particles);
    for (size_t i = 0; i < sizeof slices / sizeof slices[0]; i++) {
        run_sliced(slices[i]);
        ck_assert_mem_eq(&filter, &whole, sizeof filter);
        ck_assert_mem_eq(particles, whole_particles, sizeof whole_particles);
    }
}
END_TEST

/* ---- scans to a wide cloud ---- */

/* A hall without end: walls are known, and there are none. */
static void begin_hall(void)
{
    begin_world();
    draw_begin(&radio.drawing);
    draw_box(&radio.drawing, INSOLE_LINE_OUTLINE, 4.0, -4000.0, -4000.0, 4000.0, 4000.0);
    ck_assert_int_eq(draw_build(&radio.drawing), INSOLE_OK);
    radio.building.plan = &radio.drawing.plan;
}

static double power_of(double var_m2, double var_rad2)
{
    double wide = var_m2 / pow((double)config.search_sigma_m, 2.0) +
                  var_rad2 / pow((double)config.search_offset_rad, 2.0);
    return 1.0 + ((double)config.search_power - 1.0) * wide / (1.0 + wide);
}

static const double widths[][2] = {{0.0, 0.0}, {0.3, 0.05}, {1.5, 0.0}, {0.0, 0.7},
                                   {1.5, 0.7}, {4.0, 0.2},  {1.0, 3.2}, {900.0, 3.2}};

/* By the width of the cloud as it is, in double. */
START_TEST(a_scan_says_more_to_a_wide_cloud)
{
    begin_hall();
    start(N_MAX, 20.0, 15.0, widths[_i][0], widths[_i][1]);
    insole_evidence_t news = scan_news(20.0, 15.0);
    begin(&news);
    double var_m2 = 0.5 * (double)(filter.fix.var_x_m2 + filter.fix.var_y_m2);
    double expected = power_of(var_m2, (double)filter.fix.var_offset_rad2);
    ASSERT_NEAR(filter.weighing.scan_power, expected, 1e-4 * expected, "");
    ASSERT_AT_LEAST(filter.weighing.scan_power, 1.0, "");
    ASSERT_AT_MOST(filter.weighing.scan_power, config.search_power, "");
}
END_TEST

/* What the names of the settings promise. */
START_TEST(at_its_settings_a_scan_says_half)
{
    begin_hall();
    double half = 0.5 * (1.0 + (double)config.search_power);
    insole_evidence_t news = scan_news(20.0, 15.0);
    start(N_MAX, 20.0, 15.0, (double)config.search_sigma_m, 0.0);
    begin(&news);
    ASSERT_NEAR(filter.weighing.scan_power, half, 0.03 * half, "");
    config.search_offset_rad = INSOLE_R(0.3);
    start(N_MAX, 20.0, 15.0, 0.0, 0.3);
    begin(&news);
    ASSERT_NEAR(filter.weighing.scan_power, half, 0.03 * half, "");
    start(N, 20.0, 15.0, 0.0, 0.0);
    begin(&news);
    ASSERT_NEAR(filter.weighing.scan_power, 1.0, 1e-3, "");
    config.search_power = 1;
    start(N, 20.0, 15.0, 100.0, 3.2);
    begin(&news);
    ASSERT_NEAR(filter.weighing.scan_power, 1.0, 0.0, "");
}
END_TEST

/* Where no plan tells of walls a scan says less, and contradicts less. */
START_TEST(without_a_plan_a_scan_says_less)
{
    begin_hall();
    insole_evidence_t news = scan_news(20.0, 15.0);
    radio.building.plan = NULL;
    start(N, 20.0, 15.0, 0.0, 0.0);
    begin(&news);
    ASSERT_NEAR(filter.weighing.scan_power, config.blind_power, 1e-3, "");
    start(N, 20.0, 15.0, 1e4, 3.2);
    begin(&news);
    ASSERT_NEAR(filter.weighing.scan_power, config.blind_search_power, 1e-3, "");
    work(WHOLE);
    filter.field.elsewhere_likelier = 3;
    ASSERT_NEAR(insole_particle_filter_misfit(&filter), 3.0 * (double)config.blind_power, 1e-6, "");
    radio.building.plan = &radio.drawing.plan;
    news = position_news(20.0, 15.0, 1.0);
    begin(&news);
    ASSERT_NEAR(insole_particle_filter_misfit(&filter), 3.0, 0.0, "");
    ASSERT_NEAR(insole_particle_filter_misfit(NULL), 0.0, 0.0, "");
}
END_TEST

/* The stride told with the scan has made the cloud wider. */
START_TEST(a_stride_makes_it_say_more)
{
    begin_hall();
    config.sigma_length_m = 2;
    start(N_MAX, 20.0, 15.0, 1.0, 0.0);
    insole_evidence_t news = scan_news(20.0, 15.0);
    ck_assert_int_eq(insole_evidence_stride(&news, 1, 0, 0), INSOLE_OK);
    begin(&news);
    ASSERT_AT_LEAST(filter.weighing.scan_power, power_of(4.5, 0.0), "");
    ASSERT_AT_MOST(filter.weighing.scan_power, power_of(5.5, 0.0), "");
}
END_TEST

/* Differences of logarithms of weights, with the power and without. */
START_TEST(the_power_is_that_of_the_likelihood)
{
    begin_hall();
    insole_evidence_t news = scan_news(20.0, 15.0);
    config.resample_share = 0;
    config.search_power = 1;
    start(N, 20.0, 15.0, 2.0, 0.3);
    tell(&news);
    memcpy(before, particles, sizeof before);
    config.search_power = 5;
    start(N, 20.0, 15.0, 2.0, 0.3);
    tell(&news);
    double power = (double)filter.weighing.scan_power, widest = 0.0;
    ck_assert(power > 2.0 && power < 5.0);
    worst_t off = {0.0, 0.0};
    for (uint32_t i = 1; i < N; i++) {
        double plain = (double)before[i].log_weight - (double)before[0].log_weight;
        double told = (double)particles[i].log_weight - (double)particles[0].log_weight;
        worst_note(&off, fabs(told - power * plain), i);
        widest = fmax(widest, fabs(plain));
    }
    ASSERT_WORST(off, 1e-5, "");
    ASSERT_AT_LEAST(widest, 0.1, "");
}
END_TEST

/* Ranges and positions say what they say. */
START_TEST(only_scans_have_the_power)
{
    begin_hall();
    config.resample_share = 0;
    start(N, 20.0, 15.0, 3.0, 0.3);
    insole_evidence_t news = position_news(20.0, 15.0, 2.0);
    tell(&news);
    double d[2];
    for (int i = 0; i < 2; i++) {
        d[i] = hypot((double)particles[i].x_m - 20.0, (double)particles[i].y_m - 15.0);
    }
    ASSERT_NEAR(particles[1].log_weight - particles[0].log_weight,
                (d[0] * d[0] - d[1] * d[1]) / 8.0, 1e-5, "");
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("particle_filter_spread");
    suite_add_loop(suite, "share", copies_are_spread_by_the_share,
                   sizeof shares / sizeof shares[0]);
    suite_add(suite, "together", copies_do_not_stay_together);
    suite_add(suite, "no copies", without_copies_nobody_is_spread);
    suite_add(suite, "walls", nobody_is_spread_through_a_wall);
    suite_add(suite, "redrawn", those_that_stay_are_spread_by_their_own_width);
    suite_add(suite, "past", the_past_knows_the_spread);
    suite_add(suite, "slices", sliced_or_whole_they_are_spread_alike);
    suite_add_loop(suite, "wide", a_scan_says_more_to_a_wide_cloud,
                   sizeof widths / sizeof widths[0]);
    suite_add(suite, "half", at_its_settings_a_scan_says_half);
    suite_add(suite, "no plan", without_a_plan_a_scan_says_less);
    suite_add(suite, "stride", a_stride_makes_it_say_more);
    suite_add(suite, "power", the_power_is_that_of_the_likelihood);
    suite_add(suite, "only scans", only_scans_have_the_power);
    return suite;
}
