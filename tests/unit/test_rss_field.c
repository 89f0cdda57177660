/* SPDX-License-Identifier: MIT */
#include "insole/place/rss_field.h"

#include <stdlib.h>
#include <string.h>

#include "radio.h"
#include "suite.h"

enum { HEARD = INSOLE_RSS_FIELD_HEARD, NODES = INSOLE_RSS_FIELD_NODES, SIDE = 6, ALL = 100000 };

static radio_t radio;
static insole_rng_t rng;
static insole_rss_field_t field;
static insole_rss_t readings[RADIO_APS];

static void begin(uint64_t seed, uint32_t aps)
{
    insole_rng_seed(&rng, seed);
    radio_scatter(&radio, &rng, aps, 0.0, 0.0);
    ck_assert_int_eq(insole_rss_field_init(&field, &insole_rss_field_defaults), INSOLE_OK);
}

static insole_rss_around_t around(double x, double y, double sigma_m, double heading_rad)
{
    insole_rss_around_t a = {(insole_real_t)x, (insole_real_t)y, (insole_real_t)sigma_m,
                             (insole_real_t)heading_rad, true};
    return a;
}

static void hear(uint32_t count)
{
    ck_assert_int_eq(insole_rss_field_hear(&field, &radio.building, readings, count), INSOLE_OK);
}

static void lay(insole_rss_around_t a)
{
    ck_assert_int_eq(insole_rss_field_place(&field, &a), INSOLE_OK);
}

static insole_spot_t node_spot(uint32_t n)
{
    return insole_wall_losses_spot(&field.losses, n);
}

static void need_all(void)
{
    for (uint32_t n = 0; n < NODES; n++) {
        insole_spot_t s = node_spot(n);
        insole_rss_field_need(&field, s.x_m, s.y_m);
    }
}

/* @return pairs that it took */
static uint32_t compute(uint32_t slice)
{
    uint32_t used = 0;
    bool more = true;
    while (more) {
        uint32_t left = slice;
        more = insole_rss_field_work(&field, &radio.building, &left);
        used += slice - left;
    }
    return used;
}

static double at(double x, double y, double heading_rad)
{
    return (double)insole_rss_field_at(&field, (insole_real_t)x, (insole_real_t)y,
                                       insole_turn((insole_real_t)heading_rad));
}

static double at_node(uint32_t n, double heading_rad)
{
    return at((double)node_spot(n).x_m, (double)node_spot(n).y_m, heading_rad);
}

/* Walls of any loss. */
static void wall_in_anyhow(void)
{
    draw_random(&radio.drawing, &rng, 60);
    ck_assert_int_eq(draw_build(&radio.drawing), INSOLE_OK);
    radio.building.plan = &radio.drawing.plan;
}

/* What the logarithm can be off when each of so many losses is off by a sixteenth of a decibel: the
 * slope of the student tail is steepest at the root of its degrees of freedom. */
static double of_rounded_losses(int aps)
{
    const insole_propagation_config_t *c = radio.building.propagation;
    double dof = (double)c->tail_dof;
    double per_db = (double)c->power * 0.5 * (dof + 1.0) / sqrt(dof) / (double)c->sigma_db;
    return 0.0625 * per_db * aps;
}

/* At every node the sum over the access points, computed anew in double precision. */
START_TEST(nodes_hold_the_likelihood_of_the_scan)
{
    worst_t off = {0.0, 0.0};
    begin(1u + (uint64_t)_i, 12);
    if (_i == 2) {
        wall_in_anyhow();
    } else if (_i % 2 == 1) {
        radio_wall_in(&radio, &rng, 0.0, 0.0);
    }
    for (int trial = 0; trial < 20; trial++) {
        double x = draw_uniform(&rng, 5.0, 35.0), y = draw_uniform(&rng, 5.0, 25.0);
        double heading = draw_uniform(&rng, -3.1, 3.1);
        radio_listen(&radio, &rng, x, y, heading, 4.0, 12, readings);
        hear(12);
        lay(around(x, y, 0.5, heading));
        need_all();
        compute(ALL);
        for (uint32_t n = 0; n < NODES; n++) {
            insole_spot_t s = node_spot(n);
            double expected =
                radio_log_likelihood(&radio, (double)s.x_m, (double)s.y_m, heading, readings, 12);
            worst_note(&off, fabs(at_node(n, heading) - expected), n);
        }
    }
    ASSERT_WORST(off, 5e-4 + (_i == 2 ? of_rounded_losses(12) : 0.0), "");
}
END_TEST

/* Where no direction is known the nodes know four, and particles differ by theirs. */
START_TEST(four_views_where_no_direction_is_known)
{
    worst_t off = {0.0, 0.0};
    begin(5u, 12);
    radio_wall_in(&radio, &rng, 0.0, 0.0);
    radio_listen(&radio, &rng, 20.0, 15.0, 1.0, 4.0, 12, readings);
    hear(12);
    insole_rss_around_t a = around(20.0, 15.0, 0.5, 0.0);
    a.has_heading = false;
    lay(a);
    need_all();
    compute(ALL);
    for (uint32_t n = 0; n < NODES; n++) {
        insole_spot_t s = node_spot(n);
        for (int view = 0; view < 4; view++) {
            double heading = 1.5707963267948966 * view;
            double expected =
                radio_log_likelihood(&radio, (double)s.x_m, (double)s.y_m, heading, readings, 12);
            worst_note(&off, fabs(at_node(n, heading) - expected), n);
        }
    }
    ASSERT_WORST(off, 5e-4, "");
}
END_TEST

/* Between the views: the only a + b cos + c sin + d cos 2 through four directions. */
START_TEST(between_views_a_trigonometric_polynomial)
{
    begin(6u, 12);
    radio_listen(&radio, &rng, 20.0, 15.0, 1.0, 4.0, 12, readings);
    hear(12);
    insole_rss_around_t a = around(20.0, 15.0, 0.5, 0.0);
    a.has_heading = false;
    lay(a);
    need_all();
    compute(ALL);
    double v[4];
    for (int view = 0; view < 4; view++) {
        v[view] = at_node(14, 1.5707963267948966 * view);
    }
    for (double h = -3.0; h < 3.2; h += 0.1) {
        double expected = 0.25 * (v[0] + v[1] + v[2] + v[3]) + 0.5 * (v[0] - v[2]) * cos(h) +
                          0.5 * (v[1] - v[3]) * sin(h) +
                          0.25 * (v[0] + v[2] - v[1] - v[3]) * cos(2.0 * h);
        ASSERT_NEAR(at_node(14, h), expected, 1e-5, "");
    }
}
END_TEST

/* Between nodes bilinear; beyond the border as on it. */
START_TEST(between_nodes_bilinear_beyond_the_border_constant)
{
    worst_t off = {0.0, 0.0};
    begin(7u, 8);
    radio_listen(&radio, &rng, 20.0, 15.0, 1.0, 4.0, 8, readings);
    hear(8);
    lay(around(20.0, 15.0, 0.5, 1.0));
    need_all();
    compute(ALL);
    insole_spot_t first = node_spot(0);
    for (int trial = 0; trial < 500; trial++) {
        double u = draw_uniform(&rng, -2.0, 7.0), v = draw_uniform(&rng, -2.0, 7.0);
        double h = (double)field.losses.spacing_m;
        double value = at((double)first.x_m + u * h, (double)first.y_m + v * h, 1.0);
        double cu = fmax(0.0, fmin(u, SIDE - 1)), cv = fmax(0.0, fmin(v, SIDE - 1));
        uint32_t i = (uint32_t)fmin(cu, SIDE - 2), j = (uint32_t)fmin(cv, SIDE - 2);
        double fu = cu - i, fv = cv - j;
        double expected = (1.0 - fu) * (1.0 - fv) * at_node(j * SIDE + i, 1.0) +
                          fu * (1.0 - fv) * at_node(j * SIDE + i + 1, 1.0) +
                          (1.0 - fu) * fv * at_node((j + 1) * SIDE + i, 1.0) +
                          fu * fv * at_node((j + 1) * SIDE + i + 1, 1.0);
        worst_note(&off, fabs(value - expected), trial);
    }
    ASSERT_WORST(off, 2e-5, "");
}
END_TEST

static void shuffle(uint32_t count)
{
    for (uint32_t i = count - 1u; i > 0; i--) {
        uint32_t k = insole_rng_bits(&rng) % (i + 1u);
        insole_rss_t kept = readings[i];
        readings[i] = readings[k];
        readings[k] = kept;
    }
}

static int stronger_first(const void *a, const void *b)
{
    insole_real_t x = ((const insole_rss_t *)a)->rss_dbm, y = ((const insole_rss_t *)b)->rss_dbm;
    return (x < y) - (x > y);
}

/* Of three hundred the sixteen strongest count, in whatever order they come. */
START_TEST(of_a_huge_scan_the_strongest_count)
{
    worst_t off = {0.0, 0.0};
    begin(8u, 300);
    radio_listen(&radio, &rng, 20.0, 15.0, 1.0, 4.0, 300, readings);
    shuffle(300);
    hear(300);
    ck_assert_uint_eq(field.heard_count, HEARD);
    lay(around(20.0, 15.0, 0.5, 1.0));
    need_all();
    compute(ALL);
    qsort(readings, 300, sizeof readings[0], stronger_first);
    for (uint32_t n = 0; n < NODES; n++) {
        insole_spot_t s = node_spot(n);
        double expected =
            radio_log_likelihood(&radio, (double)s.x_m, (double)s.y_m, 1.0, readings, HEARD);
        worst_note(&off, fabs(at_node(n, 1.0) - expected), n);
    }
    ASSERT_WORST(off, 5e-4, "");
    for (uint32_t k = 0; k < HEARD; k++) {
        ck_assert_uint_eq(field.heard_id[k], readings[k].id);
    }
}
END_TEST

START_TEST(readings_that_make_no_sense_are_passed_over)
{
    begin(9u, 6);
    radio.aps[4].x_m = (insole_real_t)NAN;
    radio_listen(&radio, &rng, 20.0, 15.0, 1.0, 4.0, 4, readings);
    readings[4].id = 4;
    readings[4].rss_dbm = -40;
    readings[5].id = 6; /* beyond the list */
    readings[5].rss_dbm = -40;
    readings[6].id = 5;
    readings[6].rss_dbm = (insole_real_t)NAN;
    readings[7].id = UINT32_MAX;
    readings[7].rss_dbm = -40;
    hear(8);
    ck_assert_uint_eq(field.heard_count, 4);
    insole_rss_field_t before = field;
    ck_assert_int_eq(insole_rss_field_hear(&field, &radio.building, &readings[4], 4),
                     INSOLE_ERR_STATE);
    ck_assert_int_eq(insole_rss_field_hear(&field, &radio.building, NULL, 0), INSOLE_ERR_STATE);
    ck_assert_mem_eq(&field, &before, sizeof field);
}
END_TEST

/* Four nodes for a particle, four around the centre, and where the scan points. */
START_TEST(only_needed_nodes_are_computed)
{
    begin(10u, 5);
    radio_listen(&radio, &rng, 20.0, 15.0, 1.0, 4.0, 5, readings);
    hear(5);
    lay(around(20.5, 15.5, 0.5, 1.0)); /* centre between nodes 14, 15, 20, 21 */
    ck_assert_uint_eq(compute(ALL), 5u * 5u);
    lay(around(20.5, 15.5, 0.5, 1.0));
    insole_spot_t s = node_spot(0);
    insole_rss_field_need(&field, s.x_m + INSOLE_R(0.1), s.y_m + INSOLE_R(0.1));
    ck_assert_uint_eq(compute(ALL), 9u * 5u);
    lay(around(20.5, 15.5, 0.5, 1.0));
    insole_rss_field_need(&field, -1000, 1000); /* beyond: the corner */
    ck_assert_uint_eq(compute(ALL), 9u * 5u);
    lay(around(20.5, 15.5, 0.5, 1.0));
    need_all();
    ck_assert_uint_eq(compute(ALL), 37u * 5u);
}
END_TEST

/* However many pairs are computed at a time. */
START_TEST(slices_give_the_same_bits)
{
    static const uint32_t slices[] = {1, 2, 7, 64};
    begin(11u, 9);
    radio_wall_in(&radio, &rng, 0.0, 0.0);
    radio_listen(&radio, &rng, 20.0, 15.0, 1.0, 4.0, 9, readings);
    hear(9);
    lay(around(20.0, 15.0, 0.5, 1.0));
    need_all();
    insole_rss_field_t start = field;
    compute(ALL);
    insole_rss_field_t whole = field;
    for (size_t i = 0; i < sizeof slices / sizeof slices[0]; i++) {
        field = start;
        ck_assert_uint_eq(compute(slices[i]), 37u * 9u);
        ck_assert_mem_eq(&field, &whole, sizeof field);
    }
}
END_TEST

static void hear_and_learn(double x, double y, double heading_rad)
{
    lay(around(x, y, 0.5, heading_rad));
    compute(ALL);
    ck_assert_int_eq(insole_rss_field_learn(&field), INSOLE_OK);
}

/* A receiver that hears 6 dB too strong, on a walk that is known. */
START_TEST(the_offset_of_the_receiver_is_learned)
{
    begin(12u, 10);
    for (int i = 0; i < 60; i++) {
        double x = 10.0 + 0.3 * i, y = 12.0, heading = 0.0;
        radio_listen(&radio, &rng, x, y, heading, 2.0, 10, readings);
        for (uint32_t k = 0; k < 10; k++) {
            readings[k].rss_dbm += 6;
        }
        hear(10);
        hear_and_learn(x, y, heading);
    }
    ASSERT_NEAR(field.offset_db, 6.0, 0.5, "dB");
}
END_TEST

/* With three scans of offset 0 that were never heard, it is the plain mean. */
START_TEST(the_first_scans_weigh_alike)
{
    static const double offsets[] = {5.0, 3.0, -2.0, 4.0};
    double sum = 0.0;
    begin(13u, 6);
    radio.propagation.body_db = 0;
    for (int i = 0; i < 4; i++) {
        radio_listen(&radio, NULL, 20.0, 15.0, 0.0, 0.0, 6, readings);
        for (uint32_t k = 0; k < 6; k++) {
            readings[k].rss_dbm += (insole_real_t)offsets[i];
        }
        hear(6);
        hear_and_learn(20.0, 15.0, 0.0);
        sum += offsets[i];
        ASSERT_NEAR(field.offset_db, sum / (4.0 + i), 0.02, "dB");
    }
}
END_TEST

START_TEST(the_offset_keeps_to_its_limit_and_can_be_switched_off)
{
    insole_rss_field_config_t config = insole_rss_field_defaults;
    for (int off = 0; off < 2; off++) {
        begin(14u, 6);
        config.learn_weight = off ? 0 : INSOLE_R(0.5);
        config.offset_max_db = 3;
        ck_assert_int_eq(insole_rss_field_init(&field, &config), INSOLE_OK);
        for (int i = 0; i < 10; i++) {
            radio_listen(&radio, &rng, 20.0, 15.0, 0.0, 1.0, 6, readings);
            for (uint32_t k = 0; k < 6; k++) {
                readings[k].rss_dbm -= 10;
            }
            hear(6);
            hear_and_learn(20.0, 15.0, 0.0);
        }
        ASSERT_NEAR(field.offset_db, off ? 0.0 : -3.0, 0.0, "dB");
    }
}
END_TEST

/* A single reading may be off by 40 dB: it counts as 12. */
START_TEST(one_wild_reading_does_not_move_the_offset_far)
{
    begin(15u, 6);
    radio_listen(&radio, NULL, 20.0, 15.0, 0.0, 0.0, 6, readings);
    readings[2].rss_dbm += 40;
    hear(6);
    hear_and_learn(20.0, 15.0, 0.0);
    ASSERT_NEAR(field.offset_db, 12.0 / 6.0 / 4.0, 0.1, "dB");
}
END_TEST

/* Scans heard at one place, a cloud thought to be at another. */
START_TEST(scans_tell_when_the_walker_is_elsewhere)
{
    begin(16u, 12);
    for (int i = 0; i < 12; i++) {
        radio_listen(&radio, &rng, 10.0, 8.0, 1.0, 2.0, 12, readings);
        hear(12);
        hear_and_learn(10.0, 8.0, 1.0);
    }
    ASSERT_AT_MOST(field.elsewhere_likelier, 0.0, "");
    double here = (double)field.elsewhere_likelier;
    for (int i = 0; i < 12; i++) {
        radio_listen(&radio, &rng, 30.0, 22.0, 1.0, 2.0, 12, readings);
        hear(12);
        hear_and_learn(10.0, 8.0, 1.0);
        ASSERT_NEAR(hypot((double)field.elsewhere.x_m - 30.0, (double)field.elsewhere.y_m - 22.0),
                    0.0, 6.0, "m");
    }
    ASSERT_AT_LEAST(field.elsewhere_likelier, 0.5, "");
    ck_assert((double)field.elsewhere_likelier > here);
}
END_TEST

/* The mean over scans is exponential: a tenth scan of one kind has the known share. */
START_TEST(elsewhere_is_a_running_mean)
{
    begin(17u, 8);
    insole_rss_field_config_t config = insole_rss_field_defaults;
    config.learn_weight = 0;
    config.elsewhere_weight = INSOLE_R(0.25);
    ck_assert_int_eq(insole_rss_field_init(&field, &config), INSOLE_OK);
    radio_listen(&radio, &rng, 30.0, 22.0, 1.0, 2.0, 8, readings);
    double each = 0.0;
    for (int i = 1; i <= 10; i++) {
        hear(8);
        hear_and_learn(10.0, 8.0, 1.0);
        each = i == 1 ? (double)field.elsewhere_likelier / 0.25 : each;
        ASSERT_NEAR(field.elsewhere_likelier, each * (1.0 - pow(0.75, i)), 1e-4 * fabs(each), "");
    }
}
END_TEST

static const struct {
    double sigma_m, spacing_m;
} sigmas[] = {{0.0, 1.0}, {0.5, 1.0}, {1.33, 1.0}, {1.4, 1.41421356}, {5.0, 4.0}, {1e9, 1024.0}};

/* One and a half sigmas to every side, in steps of the square root of two. */
START_TEST(the_lattice_grows_with_what_is_not_known)
{
    begin(18u, 4);
    insole_rss_field_config_t config = insole_rss_field_defaults;
    config.spacing_m = 1;
    config.cover = INSOLE_R(1.5);
    ck_assert_int_eq(insole_rss_field_init(&field, &config), INSOLE_OK);
    radio_listen(&radio, &rng, 20.0, 15.0, 1.0, 4.0, 4, readings);
    hear(4);
    lay(around(20.0, 15.0, sigmas[_i].sigma_m, 0.0));
    ASSERT_NEAR(field.losses.spacing_m, sigmas[_i].spacing_m, 1e-6 * sigmas[_i].spacing_m, "m");
    insole_spot_t low = node_spot(0), high = node_spot(NODES - 1);
    if (sigmas[_i].sigma_m < 100.0) {
        double reach = 1.5 * sigmas[_i].sigma_m;
        ASSERT_AT_MOST(low.x_m, 20.0 - reach, "m");
        ASSERT_AT_LEAST(high.y_m, 15.0 + reach, "m");
    }
}
END_TEST

/* Everything shifted by whole nodes: the same to the precision of coordinates there. */
START_TEST(far_from_the_origin_nothing_changes)
{
    static double near_by[NODES];
    for (int far = 0; far < 2; far++) {
        double shift = far ? 500.0 : 0.0;
        insole_rng_seed(&rng, 19u);
        radio_scatter(&radio, &rng, 10, shift, -shift);
        radio_wall_in(&radio, &rng, shift, -shift);
        insole_rss_field_config_t config = insole_rss_field_defaults;
        config.spacing_m = 1; /* the shift is so many nodes, without a rounding */
        ck_assert_int_eq(insole_rss_field_init(&field, &config), INSOLE_OK);
        insole_rng_seed(&rng, 20u);
        radio_listen(&radio, &rng, 20.2 + shift, 15.3 - shift, 1.0, 4.0, 10, readings);
        hear(10);
        lay(around(20.2 + shift, 15.3 - shift, 0.5, 1.0));
        need_all();
        compute(ALL);
        for (uint32_t n = 0; n < NODES; n++) {
            if (far) {
                ASSERT_NEAR(at_node(n, 1.0), near_by[n], 2e-3, "");
            }
            near_by[n] = at_node(n, 1.0);
        }
    }
}
END_TEST

START_TEST(nothing_is_said_before_all_is_computed)
{
    begin(21u, 4);
    ASSERT_NEAR(at(1.0, 1.0, 0.0), 0.0, 0.0, "");
    ck_assert_int_eq(insole_rss_field_learn(&field), INSOLE_ERR_STATE);
    insole_rss_around_t a = around(20.0, 15.0, 0.5, 0.0);
    ck_assert_int_eq(insole_rss_field_place(&field, &a), INSOLE_ERR_STATE); /* nothing heard */
    radio_listen(&radio, &rng, 20.0, 15.0, 1.0, 4.0, 4, readings);
    hear(4);
    uint32_t pairs = 100;
    ck_assert(!insole_rss_field_work(&field, &radio.building, &pairs));
    ck_assert_uint_eq(pairs, 100);
    lay(a);
    pairs = 3;
    ck_assert(insole_rss_field_work(&field, &radio.building, &pairs));
    ck_assert_uint_eq(pairs, 0);
    ASSERT_NEAR(at(20.0, 15.0, 0.0), 0.0, 0.0, "");
    insole_rss_field_t before = field;
    ck_assert_int_eq(insole_rss_field_learn(&field), INSOLE_ERR_STATE);
    ck_assert_mem_eq(&field, &before, sizeof field);
    compute(ALL);
    ck_assert(fabs(at(20.0, 15.0, 0.0)) > 0.0);
    ck_assert_int_eq(insole_rss_field_learn(&field), INSOLE_OK);
    ck_assert_int_eq(insole_rss_field_learn(&field), INSOLE_ERR_STATE); /* once a scan */
    lay(a);
    compute(ALL);
    hear(4); /* a new scan has not been computed anywhere */
    ASSERT_NEAR(at(20.0, 15.0, 0.0), 0.0, 0.0, "");
    ck_assert_int_eq(insole_rss_field_learn(&field), INSOLE_ERR_STATE);
}
END_TEST

START_TEST(refusals_change_nothing)
{
    begin(22u, 4);
    radio_listen(&radio, &rng, 20.0, 15.0, 1.0, 4.0, 4, readings);
    hear(4);
    lay(around(20.0, 15.0, 0.5, 0.0));
    insole_rss_field_t before = field;
    insole_building_t mute = {NULL, radio.aps, 4, NULL, NULL};
    insole_building_t empty = {&radio.propagation, NULL, 4, NULL, NULL};
    ck_assert_int_eq(insole_rss_field_hear(&field, NULL, readings, 4), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_rss_field_hear(&field, &mute, readings, 4), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_rss_field_hear(&field, &empty, readings, 4), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_rss_field_hear(&field, &radio.building, NULL, 4), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_rss_field_place(&field, NULL), INSOLE_ERR_NULL);
    static const double bad[][4] = {{1e6, 0.0, 1.0, 0.0},         {0.0, -1e6, 1.0, 0.0},
                                    {(double)NAN, 0.0, 1.0, 0.0}, {0.0, 0.0, -1.0, 0.0},
                                    {0.0, 0.0, (double)NAN, 0.0}, {0.0, 0.0, 1.0, HUGE_VAL},
                                    {0.0, 0.0, 1.0, (double)NAN}};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        insole_rss_around_t a = around(bad[i][0], bad[i][1], bad[i][2], bad[i][3]);
        ck_assert_int_eq(insole_rss_field_place(&field, &a), INSOLE_ERR_VALUE);
    }
    uint32_t pairs = 10;
    ck_assert(!insole_rss_field_work(&field, NULL, &pairs));
    ck_assert(!insole_rss_field_work(&field, &mute, &pairs));
    ck_assert(!insole_rss_field_work(&field, &empty, &pairs));
    ck_assert(!insole_rss_field_work(&field, &radio.building, NULL));
    ck_assert_mem_eq(&field, &before, sizeof field);
}
END_TEST

START_TEST(nothing_happens_to_null)
{
    insole_rss_around_t a = around(0.0, 0.0, 1.0, 0.0);
    uint32_t pairs = 10;
    begin(23u, 4);
    ck_assert_int_eq(insole_rss_field_check(NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_rss_field_init(NULL, &insole_rss_field_defaults), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_rss_field_init(&field, NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_rss_field_hear(NULL, &radio.building, readings, 0), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_rss_field_place(NULL, &a), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_rss_field_learn(NULL), INSOLE_ERR_NULL);
    ck_assert(!insole_rss_field_work(NULL, &radio.building, &pairs));
    insole_rss_field_need(NULL, 0, 0);
    ASSERT_NEAR(insole_rss_field_at(NULL, 0, 0, insole_turn(0)), 0.0, 0.0, "");
}
END_TEST

/* Each setting at its ends passes, beyond them it does not. */
#define CHECK_RANGE(kind, name, value, low, high, unit, text)                                      \
    do {                                                                                           \
        insole_rss_field_config_t c = insole_rss_field_defaults;                                   \
        c.name = INSOLE_R(low);                                                                    \
        ck_assert_int_eq(insole_rss_field_check(&c), INSOLE_OK);                                   \
        c.name = INSOLE_R(high);                                                                   \
        ck_assert_int_eq(insole_rss_field_check(&c), INSOLE_OK);                                   \
        c.name = INSOLE_R(high) * INSOLE_R(1.01);                                                  \
        ck_assert_int_eq(insole_rss_field_check(&c), INSOLE_ERR_VALUE);                            \
        c.name = (insole_real_t)NAN;                                                               \
        ck_assert_int_eq(insole_rss_field_init(&field, &c), INSOLE_ERR_VALUE);                     \
    } while (0);

START_TEST(settings_keep_to_their_ranges)
{
    begin(24u, 4);
    insole_rss_field_t before = field;
    INSOLE_RSS_FIELD_KEYS(CHECK_RANGE)
    ck_assert_mem_eq(&field, &before, sizeof field);
}
END_TEST

/* A list that shrank: readings of what is gone have no say, nothing is read beyond it. */
START_TEST(access_points_that_are_gone_have_no_say)
{
    begin(25u, 6);
    radio_listen(&radio, &rng, 20.0, 15.0, 1.0, 4.0, 6, readings);
    hear(6);
    lay(around(20.0, 15.0, 0.5, 1.0));
    need_all();
    radio.building.ap_count = 3;
    compute(ALL);
    insole_spot_t s = node_spot(8);
    ASSERT_NEAR(at_node(8, 1.0),
                radio_log_likelihood(&radio, (double)s.x_m, (double)s.y_m, 1.0, readings, 3), 5e-4,
                "");
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("rss_field");
    suite_add_loop(suite, "nodes by double", nodes_hold_the_likelihood_of_the_scan, 5);
    suite_add(suite, "four views", four_views_where_no_direction_is_known);
    suite_add(suite, "between views", between_views_a_trigonometric_polynomial);
    suite_add(suite, "between nodes", between_nodes_bilinear_beyond_the_border_constant);
    suite_add(suite, "huge scan", of_a_huge_scan_the_strongest_count);
    suite_add(suite, "no sense", readings_that_make_no_sense_are_passed_over);
    suite_add(suite, "needed nodes", only_needed_nodes_are_computed);
    suite_add(suite, "slices", slices_give_the_same_bits);
    suite_add(suite, "offset", the_offset_of_the_receiver_is_learned);
    suite_add(suite, "offset as mean", the_first_scans_weigh_alike);
    suite_add(suite, "offset limit", the_offset_keeps_to_its_limit_and_can_be_switched_off);
    suite_add(suite, "wild reading", one_wild_reading_does_not_move_the_offset_far);
    suite_add(suite, "elsewhere", scans_tell_when_the_walker_is_elsewhere);
    suite_add(suite, "elsewhere as mean", elsewhere_is_a_running_mean);
    suite_add_loop(suite, "lattice", the_lattice_grows_with_what_is_not_known,
                   sizeof sigmas / sizeof sigmas[0]);
    suite_add(suite, "far away", far_from_the_origin_nothing_changes);
    suite_add(suite, "before computed", nothing_is_said_before_all_is_computed);
    suite_add(suite, "refusals", refusals_change_nothing);
    suite_add(suite, "null", nothing_happens_to_null);
    suite_add(suite, "settings", settings_keep_to_their_ranges);
    suite_add(suite, "gone", access_points_that_are_gone_have_no_say);
    return suite;
}
