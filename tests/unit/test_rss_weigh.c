/* SPDX-License-Identifier: MIT */
#include "insole/fuse/rss_weigh.h"

#include "fingerprints.h"
#include "refusal.h"
#include "suite.h"

enum { APS = 40, HEARD = 25 };

static prints_t prints;
static insole_rss_weigh_t rss;
static insole_real_t log_weights[PRINTS_POINTS];
static insole_rss_t readings[HEARD];
static insole_rng_t rng;

/* Points all over 40 m x 30 m, each hears some of the access points. */
static void draw_prints(uint64_t seed)
{
    insole_rng_seed(&rng, seed);
    prints_begin(&prints);
    for (uint32_t i = 0; i < PRINTS_POINTS; i++) {
        prints_point(&prints, prints_uniform(&rng, 0, 40), prints_uniform(&rng, 0, 30));
        for (uint32_t ap = 0; ap < APS; ap++) {
            if (prints_uniform(&rng, 0, 1) < 0.6) {
                prints_entry(&prints, ap, prints_uniform(&rng, -95, -40), 3.0);
            }
        }
    }
    prints.map.ap_count = APS;
    for (uint32_t i = 0; i < HEARD; i++) {
        insole_rss_t reading = {(i * 7u) % APS, (insole_real_t)prints_uniform(&rng, -95, -40), 0};
        readings[i] = reading;
    }
}

static insole_status_t begin(void)
{
    return insole_rss_weigh_begin(&rss, &prints.map, log_weights, PRINTS_POINTS, -95, readings,
                                  HEARD);
}

/* The distance over all access points there are, one by one. */
static double distance_db(uint32_t point)
{
    double squares = 0.0;
    for (uint32_t ap = 0; ap < APS; ap++) {
        double heard = -95.0, mapped = -95.0;
        uint32_t entry;
        for (uint32_t i = 0; i < HEARD; i++) {
            heard = readings[i].id == ap ? (double)readings[i].rss_dbm : heard;
        }
        if (insole_radio_map_find(&prints.map, point, ap, &entry)) {
            mapped = (double)insole_radio_map_mean_dbm(&prints.map, entry);
        }
        squares += pow(heard - mapped, 2.0);
    }
    return sqrt(squares);
}

START_TEST(weights_are_inverse_distances_of_the_nearest)
{
    worst_t off = {0, 0};
    draw_prints(1u + (uint64_t)_i);
    ck_assert_int_eq(begin(), INSOLE_OK);
    while (insole_rss_weigh_work(&rss, 7)) {
        ck_assert(!insole_rss_weigh_is_ready(&rss));
        ck_assert(insole_rss_weigh_at(&rss, insole_spot(1, 1)) == 0);
    }
    ck_assert(insole_rss_weigh_is_ready(&rss));
    for (int k = 0; k < 500; k++) {
        double x = prints_uniform(&rng, -5, 45), y = prints_uniform(&rng, -5, 35), least = HUGE_VAL;
        uint32_t nearest = 0;
        for (uint32_t i = 0; i < PRINTS_POINTS; i++) {
            double m = hypot((double)prints.spots[i].x_m - x, (double)prints.spots[i].y_m - y);
            nearest = m < least ? i : nearest;
            least = fmin(m, least);
        }
        double weight =
            exp((double)insole_rss_weigh_at(&rss, insole_spot((insole_real_t)x, (insole_real_t)y)));
        worst_note(&off, fabs(weight * distance_db(nearest) - 1.0), k);
    }
    ASSERT_WORST(off, 1e-5, "of it");
}
END_TEST

/* A scan that is the fingerprint itself weighs as one that is 1 dB off. */
START_TEST(no_weight_is_infinite)
{
    prints_begin(&prints);
    prints_point(&prints, 0, 0);
    prints_entry(&prints, 0, -50.0, 3.0);
    insole_rss_t one = {0, -50, 0};
    ck_assert_int_eq(
        insole_rss_weigh_begin(&rss, &prints.map, log_weights, PRINTS_POINTS, -95, &one, 1),
        INSOLE_OK);
    ck_assert(!insole_rss_weigh_work(&rss, 1));
    ASSERT_NEAR(insole_rss_weigh_at(&rss, insole_spot(5, 5)), 0.0, 0.0, "");
}
END_TEST

START_TEST(slices_give_the_same_bits)
{
    insole_real_t whole[PRINTS_POINTS];
    draw_prints(9u);
    ck_assert_int_eq(begin(), INSOLE_OK);
    insole_rss_weigh_work(&rss, PRINTS_POINTS);
    memcpy(whole, log_weights, sizeof whole);
    for (uint32_t slice = 1; slice < 20; slice += 6) {
        memset(log_weights, 0, sizeof log_weights);
        ck_assert_int_eq(begin(), INSOLE_OK);
        while (insole_rss_weigh_work(&rss, slice)) {
        }
        ck_assert_mem_eq(log_weights, whole, sizeof whole);
    }
}
END_TEST

START_TEST(bad_input_changes_nothing)
{
    const insole_radio_map_t *map = &prints.map;
    draw_prints(3u);
    memset(&rss, 0, sizeof rss);
    ck_assert(!insole_rss_weigh_work(&rss, 5));
    ck_assert(!insole_rss_weigh_is_ready(&rss));
    ck_assert(insole_rss_weigh_at(&rss, insole_spot(0, 0)) == 0);
    ck_assert_int_eq(begin(), INSOLE_OK);
#define REFUSED(map, weights, room, dbm, readings, count, why)                                     \
    ASSERT_UNCHANGED(rss, insole_rss_weigh_begin(&rss, map, weights, room, dbm, readings, count),  \
                     why)
    REFUSED(NULL, log_weights, PRINTS_POINTS, -95, readings, HEARD, INSOLE_ERR_NULL);
    REFUSED(map, NULL, PRINTS_POINTS, -95, readings, HEARD, INSOLE_ERR_NULL);
    REFUSED(map, log_weights, PRINTS_POINTS, -95, NULL, HEARD, INSOLE_ERR_NULL);
    REFUSED(map, log_weights, PRINTS_POINTS - 1, -95, readings, HEARD, INSOLE_ERR_ROOM);
    REFUSED(map, log_weights, PRINTS_POINTS, 1, readings, HEARD, INSOLE_ERR_VALUE);
    REFUSED(map, log_weights, PRINTS_POINTS, -128, readings, HEARD, INSOLE_ERR_VALUE);
    REFUSED(map, log_weights, PRINTS_POINTS, (insole_real_t)(double)NAN, readings, HEARD,
            INSOLE_ERR_VALUE);
    REFUSED(map, log_weights, PRINTS_POINTS, -95, readings, 0, INSOLE_ERR_STATE);
    insole_radio_map_t empty = *map;
    empty.point_count = 0;
    REFUSED(&empty, log_weights, PRINTS_POINTS, -95, readings, HEARD, INSOLE_ERR_STATE);
    ck_assert_int_eq(
        insole_rss_weigh_begin(NULL, map, log_weights, PRINTS_POINTS, -95, readings, HEARD),
        INSOLE_ERR_NULL);
    ck_assert(!insole_rss_weigh_work(NULL, 5));
    ck_assert(!insole_rss_weigh_is_ready(NULL));
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("rss_weigh");
    suite_add_loop(suite, "inverse distance", weights_are_inverse_distances_of_the_nearest, 4);
    suite_add(suite, "not infinite", no_weight_is_infinite);
    suite_add(suite, "slices", slices_give_the_same_bits);
    suite_add(suite, "bad input", bad_input_changes_nothing);
    return suite;
}
