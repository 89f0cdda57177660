/* SPDX-License-Identifier: MIT */
#include "insole/fuse/weighing.h"

#include <string.h>

#include "radio.h"
#include "suite.h"

enum { N = 400, APS = 10 };

static radio_t radio;
static insole_rng_t rng;
static insole_rss_field_t field;
static insole_rss_t readings[RADIO_APS];
static insole_particle_t particles[N];
static const insole_cloud_t cloud = {particles, N, NULL, 0, NULL};
static insole_weighing_t weighing;

static insole_spot_t spot(double x, double y)
{
    insole_spot_t s = {(insole_real_t)x, (insole_real_t)y};
    return s;
}

static void begin(uint64_t seed)
{
    insole_rng_seed(&rng, seed);
    radio_scatter(&radio, &rng, APS, 0.0, 0.0);
    ck_assert_int_eq(insole_rss_field_init(&field, &insole_rss_field_defaults), INSOLE_OK);
    memset(&weighing, 0, sizeof weighing);
    insole_evidence_clear(&weighing.news);
    weighing.stride.scale_memory = 1;
    weighing.scan_power = 1;
    insole_weighing_begin(&weighing);
    for (uint32_t i = 0; i < N; i++) {
        insole_particle_t p = {(insole_real_t)draw_uniform(&rng, 18.5, 21.5),
                               (insole_real_t)draw_uniform(&rng, 13.5, 16.5),
                               (insole_real_t)draw_uniform(&rng, -0.3, 0.3), 1,
                               (insole_real_t)draw_uniform(&rng, -3.0, 0.0)};
        particles[i] = p;
    }
}

static void tell_stride(double length_m, double heading_rad)
{
    ck_assert_int_eq(insole_evidence_stride(&weighing.news, (insole_real_t)length_m,
                                            (insole_real_t)heading_rad, 0),
                     INSOLE_OK);
    weighing.stride.length_m = (insole_real_t)length_m;
    weighing.stride.heading_rad = (insole_real_t)heading_rad;
}

static void tell_scan(insole_spot_t since, bool has_heading)
{
    radio_listen(&radio, &rng, 20.0, 15.0, 0.5, 4.0, APS, readings);
    ck_assert_int_eq(insole_evidence_scan(&weighing.news, readings, APS, since), INSOLE_OK);
    ck_assert_int_eq(insole_rss_field_hear(&field, &radio.building, readings, APS), INSOLE_OK);
    insole_rss_around_t around = {20, 15, 1, INSOLE_R(0.5), has_heading};
    ck_assert_int_eq(insole_rss_field_place(&field, &around), INSOLE_OK);
}

static void pass(const insole_floor_plan_t *plan)
{
    insole_weighing_move(&weighing, &field, plan, &cloud, 0, N, &rng);
    uint32_t pairs = 1u << 20;
    insole_rss_field_work(&field, &radio.building, &pairs);
    insole_weighing_weigh(&weighing, &field, &cloud, 0, N);
}

/* The same scan, computed at every node whether needed or not. */
static insole_rss_field_t compute_all_nodes(void)
{
    insole_rss_field_t all = field;
    for (uint32_t n = 0; n < INSOLE_RSS_FIELD_NODES; n++) {
        insole_spot_t s = insole_wall_losses_spot(&all.losses, n);
        insole_rss_field_need(&all, s.x_m, s.y_m);
    }
    uint32_t pairs = 1u << 20;
    ck_assert(!insole_rss_field_work(&all, &radio.building, &pairs));
    return all;
}

/* All that can be told at once, the weight of each particle computed anew in double precision, at
 * the place that it had when each was measured. How the field interpolates is its own affair, but
 * it must have been told of all nodes that count. */
START_TEST(weights_by_double)
{
    static insole_particle_t before[N];
    worst_t off = {0.0, 0.0};
    begin(1u);
    memcpy(before, particles, sizeof before);
    tell_stride(1.4, 0.2);
    insole_evidence_position(&weighing.news, spot(21.0, 15.0), INSOLE_R(0.8));
    insole_evidence_range_t range = {spot(10.0, 3.0), spot(0.5, 0.1), 16, 2, 0};
    insole_evidence_range(&weighing.news, &range);
    tell_scan(spot(0.9, -1.2), true);
    insole_rss_field_t all = compute_all_nodes();
    weighing.common_log = INSOLE_R(-0.7);
    weighing.scan_power = INSOLE_R(2.5);
    pass(NULL);
    for (uint32_t i = 0; i < N; i++) {
        double angle = 0.2 + (double)before[i].offset_rad;
        double x = (double)before[i].x_m + 1.4 * cos(angle);
        double y = (double)before[i].y_m + 1.4 * sin(angle);
        double z = (16.0 - hypot(x - 0.5 - 10.0, y - 0.1 - 3.0)) / 2.0;
        double expected = (double)before[i].log_weight + 0.7 -
                          0.5 * (pow(x - 21.0, 2.0) + pow(y - 15.0, 2.0)) / 0.64 - 0.5 * z * z +
                          2.5 * (double)insole_rss_field_at(&all, (insole_real_t)(x - 0.9),
                                                            (insole_real_t)(y + 1.2),
                                                            insole_turn((insole_real_t)angle));
        worst_note(&off, fabs((double)particles[i].log_weight - expected), i);
    }
    ASSERT_WORST(off, 5e-4, ""); /* 2e-4 of the field, times its power */
}
END_TEST

static const double powers[] = {1.0, 0.25, 8.0};

/* Near a node the likelihood is that of the model at the particle, by double, to its power. */
START_TEST(a_scan_weighs_by_the_model)
{
    begin(2u);
    weighing.scan_power = (insole_real_t)powers[_i];
    particles[0].x_m = 20; /* a node */
    particles[0].y_m = INSOLE_R(15.2);
    particles[0].log_weight = 0;
    tell_scan(spot(0.0, 0.0), true);
    pass(NULL);
    ASSERT_NEAR(particles[0].log_weight,
                powers[_i] * radio_log_likelihood(&radio, 20.0, 15.2, 0.5, readings, APS),
                5e-4 * powers[_i], "");
}
END_TEST

/* Where the direction is not known each particle is shaded by its own. */
START_TEST(particles_are_shaded_by_their_own_direction)
{
    begin(3u);
    weighing.stride.heading_rad = INSOLE_R(0.3);
    for (int k = 0; k < 4; k++) {
        particles[k] = particles[0];
        particles[k].x_m = 20;
        particles[k].y_m = INSOLE_R(15.2);
        particles[k].log_weight = 0;
        particles[k].offset_rad =
            insole_wrap_pi(INSOLE_R(0.5) * INSOLE_PI * (insole_real_t)k - INSOLE_R(0.3));
    }
    tell_scan(spot(0.0, 0.0), false);
    pass(NULL);
    for (int k = 0; k < 4; k++) {
        ASSERT_NEAR(particles[k].log_weight,
                    radio_log_likelihood(&radio, 20.0, 15.2, 1.5707963 * k, readings, APS), 1e-3,
                    "");
    }
}
END_TEST

/* A corridor along x, 2 m wide, with a wall across it at x = 5 that has a gap. */
static void draw_corridor(void)
{
    draw_begin(&radio.drawing);
    draw_box(&radio.drawing, INSOLE_LINE_OUTLINE, 4.0, 0.0, 0.0, 10.0, 2.0);
    draw_wall(&radio.drawing, 4.0, 5.0, 0.0, 5.0, 1.5);
    ck_assert_int_eq(draw_build(&radio.drawing), INSOLE_OK);
}

static const struct {
    const char *what;
    double x, y, length_m, heading_rad;
    bool dies[3]; /* off, inside, crosses */
} ways[] = {{"along", 1, 1, 1.4, 0.0, {false, false, false}},
            {"out", 1, 1, 1.4, 1.57, {false, true, true}},
            {"through the wall", 4, 1, 1.4, 0.0, {false, false, true}},
            {"through the gap", 4, 1.75, 1.4, 0.0, {false, false, false}},
            {"out at the end", 9.5, 1, 1.4, 0.0, {false, true, true}},
            {"back into the corridor", -1, 1, 1.4, 0.0, {false, false, true}},
            {"outside", -5, 1, 1.4, 0.0, {false, true, false}}};

START_TEST(a_plan_kills_as_it_is_told_to)
{
    for (int walls = 0; walls < 3; walls++) {
        begin(4u);
        draw_corridor();
        weighing.walls = (insole_walls_t)walls;
        tell_stride(ways[_i].length_m, ways[_i].heading_rad);
        particles[0].x_m = (insole_real_t)ways[_i].x;
        particles[0].y_m = (insole_real_t)ways[_i].y;
        particles[0].offset_rad = 0;
        insole_weighing_move(&weighing, &field, &radio.drawing.plan, &cloud, 0, 1, &rng);
        ck_assert_msg(insole_particle_lives(&particles[0]) != ways[_i].dies[walls], "%s, %d",
                      ways[_i].what, walls);
        begin(4u);
        weighing.walls = (insole_walls_t)walls;
        tell_stride(ways[_i].length_m, ways[_i].heading_rad);
        insole_weighing_move(&weighing, &field, NULL, &cloud, 0, 1, &rng);
        ck_assert(insole_particle_lives(&particles[0]));
    }
}
END_TEST

START_TEST(the_dead_stay_dead_and_where_they_are)
{
    begin(5u);
    tell_stride(1.4, 0.2);
    tell_scan(spot(0.0, 0.0), true);
    for (uint32_t i = 0; i < N; i++) {
        particles[i].log_weight = INSOLE_PARTICLE_DEAD;
    }
    insole_particle_t before = particles[3];
    insole_rng_t rng_before = rng;
    pass(NULL);
    ck_assert_mem_eq(&particles[3], &before, sizeof before);
    ck_assert_mem_eq(&rng, &rng_before, sizeof rng);
    ck_assert(!insole_weighing_has_survivors(&weighing));
}
END_TEST

/* A part at a time gives the bits of all at once, and the others stay as they are. */
START_TEST(parts_make_the_whole)
{
    static insole_particle_t whole[N], before[N];
    begin(9u);
    memcpy(before, particles, sizeof before);
    insole_rng_t rng_before = rng;
    tell_stride(1.4, 0.2);
    weighing.stride.is_apart = _i > 0;
    weighing.stride.apart_wander_rad = INSOLE_R(0.1);
    weighing.stride.sigma_length_m = INSOLE_R(0.1);
    insole_evidence_position(&weighing.news, spot(21.0, 15.0), INSOLE_R(0.8));
    pass(NULL);
    memcpy(whole, particles, sizeof whole);
    uint32_t heaviest = weighing.heaviest;
    memcpy(particles, before, sizeof before);
    rng = rng_before;
    insole_weighing_begin(&weighing);
    for (uint32_t first = 0, end = 0; first < N; first = end) {
        end = first + 1u + first % 7u < N ? first + 1u + first % 7u : N;
        insole_weighing_move(&weighing, &field, NULL, &cloud, first, end, &rng);
        insole_weighing_weigh(&weighing, &field, &cloud, first, end);
        ck_assert_mem_eq(&particles[end], &before[end], (N - end) * sizeof before[0]);
    }
    ck_assert_mem_eq(particles, whole, sizeof whole);
    ck_assert_uint_eq(weighing.heaviest, heaviest);
    rng_before = rng;
    insole_weighing_move(&weighing, &field, NULL, &cloud, 3, 3, &rng);
    insole_weighing_weigh(&weighing, &field, &cloud, 3, 3);
    ck_assert_mem_eq(particles, whole, sizeof whole);
    ck_assert_mem_eq(&rng, &rng_before, sizeof rng);
}
END_TEST

START_TEST(without_a_stride_nobody_moves)
{
    begin(6u);
    tell_scan(spot(0.0, 0.0), true);
    static insole_particle_t before[N];
    memcpy(before, particles, sizeof before);
    pass(NULL);
    for (uint32_t i = 0; i < N; i++) {
        ck_assert(particles[i].log_weight < before[i].log_weight);
        before[i].log_weight = particles[i].log_weight;
    }
    ck_assert_mem_eq(particles, before, sizeof before);
}
END_TEST

START_TEST(the_heaviest_is_found)
{
    begin(7u);
    tell_stride(1.4, 0.2);
    insole_evidence_position(&weighing.news, spot(21.0, 15.0), INSOLE_R(0.8));
    pass(NULL);
    ck_assert(insole_weighing_has_survivors(&weighing));
    for (uint32_t i = 0; i < N; i++) {
        ck_assert(particles[i].log_weight <= particles[weighing.heaviest].log_weight);
    }
    ASSERT_NEAR(weighing.heaviest_log, particles[weighing.heaviest].log_weight, 0.0, "");
}
END_TEST

/* However unlikely, what lives stays alive and finite. */
START_TEST(no_weight_kills)
{
    begin(8u);
    insole_evidence_position(&weighing.news, spot(1e6, 1e6), INSOLE_R(1e-6));
    for (int again = 0; again < 50; again++) {
        insole_weighing_begin(&weighing);
        pass(NULL);
        for (uint32_t i = 0; i < N; i += 50) {
            ck_assert(insole_particle_lives(&particles[i]));
            ck_assert(insole_is_finite(particles[i].log_weight));
        }
    }
    ck_assert(insole_weighing_has_survivors(&weighing));
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("weighing");
    suite_add(suite, "weights by double", weights_by_double);
    suite_add_loop(suite, "scan by the model", a_scan_weighs_by_the_model,
                   sizeof powers / sizeof powers[0]);
    suite_add(suite, "own direction", particles_are_shaded_by_their_own_direction);
    suite_add_loop(suite, "plan", a_plan_kills_as_it_is_told_to, sizeof ways / sizeof ways[0]);
    suite_add(suite, "dead", the_dead_stay_dead_and_where_they_are);
    suite_add_loop(suite, "parts", parts_make_the_whole, 2);
    suite_add(suite, "no stride", without_a_stride_nobody_moves);
    suite_add(suite, "heaviest", the_heaviest_is_found);
    suite_add(suite, "no weight kills", no_weight_kills);
    return suite;
}
