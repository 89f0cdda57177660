/* SPDX-License-Identifier: MIT */
#include "insole/place/radio_map.h"

#include "fingerprints.h"
#include "refusal.h"
#include "suite.h"

static prints_t prints;
static insole_rng_t rng;

static insole_spot_t spot(double x_m, double y_m)
{
    insole_spot_t at = {(insole_real_t)x_m, (insole_real_t)y_m};
    return at;
}

START_TEST(levels_and_bins)
{
    for (int quarter = 0; quarter <= 4 * 127; quarter++) {
        double dbm = -0.25 * quarter;
        double kept = (double)insole_radio_level_dbm(insole_radio_level((insole_real_t)dbm));
        ASSERT_AT_MOST(fabs(kept - dbm), 0.25, "dB");
        if (quarter % 2 == 0) {
            ASSERT_NEAR(kept, dbm, 0.0, "dBm");
        }
        double bin = fmin(7.0, fmax(0.0, floor((dbm + 92.0) / 8.0)));
        ASSERT_NEAR(insole_radio_bin((insole_real_t)dbm), bin, 0.0, "");
    }
    ck_assert_uint_eq(insole_radio_level(20), 0u);
    ck_assert_uint_eq(insole_radio_level(-1000), 255u);
    ck_assert_uint_eq(insole_radio_bin(20), 7u);
    ck_assert_uint_eq(insole_radio_bin(-1000), 0u);
}
END_TEST

START_TEST(finding)
{
    worst_t wrong = {0.0, 0.0};
    prints_hall(&prints, 200, 0.0, 0.0);
    ck_assert_int_eq(insole_radio_map_check(&prints.map), INSOLE_OK);
    for (uint32_t point = 0; point < PRINTS_POINTS; point++) {
        for (uint32_t ap = 0; ap < 205u; ap++) {
            uint32_t entry = 7777u, expected = 7777u;
            bool found = insole_radio_map_find(&prints.map, point, ap, &entry);
            double mean = prints_mean(&prints, point, ap, &expected);
            worst_require(&wrong, found == !isnan(mean) && entry == expected, ap);
            if (found) {
                worst_note(&wrong,
                           fabs((double)insole_radio_map_mean_dbm(&prints.map, entry) - mean), ap);
            }
        }
    }
    ASSERT_ALL_HELD(wrong);
    uint32_t entry;
    ck_assert(!insole_radio_map_find(&prints.map, PRINTS_POINTS, 0, &entry));
    ck_assert(!insole_radio_map_find(&prints.map, 0, UINT32_MAX, &entry));
    ck_assert(!insole_radio_map_find(NULL, 0, 0, &entry));
    ck_assert(!insole_radio_map_find(&prints.map, 0, 0, NULL));
}
END_TEST

START_TEST(what_an_entry_says)
{
    prints_begin(&prints);
    prints_point(&prints, 1.0, 2.0);
    prints_entry(&prints, 4, -61.5, 3.25);
    ASSERT_NEAR(insole_radio_map_mean_dbm(&prints.map, 0), -61.5, 0.0, "dBm");
    ASSERT_NEAR(insole_radio_map_std_db(&prints.map, 0), 3.25, 0.0, "dB");
    ck_assert_uint_eq(insole_radio_map_heard(&prints.map, 0), 3u);
    prints.map.spread = NULL;
    prints.map.counts = NULL;
    ASSERT_NEAR(insole_radio_map_std_db(&prints.map, 0), 0.0, 0.0, "dB");
    ck_assert_uint_eq(insole_radio_map_heard(&prints.map, 0), 1u);
}
END_TEST

/* A map of a point that heard nothing is a map; the tables beyond the needed may be missing. */
START_TEST(sound_tables)
{
    prints_begin(&prints);
    prints_point(&prints, 1.0, 2.0);
    ck_assert_int_eq(insole_radio_map_check(&prints.map), INSOLE_OK);
    prints_hall(&prints, 100, 0.0, 0.0);
    prints.map.visits = prints.map.spread = prints.map.counts = prints.map.bins = NULL;
    ck_assert_int_eq(insole_radio_map_check(&prints.map), INSOLE_OK);
}
END_TEST

static insole_status_t spoiled(void)
{
    return insole_radio_map_check(&prints.map);
}

START_TEST(tables_that_contradict)
{
    prints_hall(&prints, 100, 0.0, 0.0);
    prints_t good = prints;
#define SPOIL(damage)                                                                              \
    do {                                                                                           \
        prints = good;                                                                             \
        damage;                                                                                    \
        ck_assert_msg(spoiled() == INSOLE_ERR_DATA, #damage);                                      \
    } while (0)
    SPOIL(prints.map.point_count = 0);
    SPOIL(prints.map.ap_count = 65536u);
    SPOIL(prints.map.ap_count = 50);
    SPOIL(prints.first[0] = 1);
    SPOIL(prints.first[10] = prints.first[9] - 1u);
    SPOIL(prints.aps[prints.first[3] + 1u] = prints.aps[prints.first[3]]);
    SPOIL(prints.aps[prints.first[3] + 1u] = prints.aps[prints.first[3] + 2u]);
    SPOIL(prints.counts[77] = 0);
    SPOIL(prints.counts[77] = 5);
    SPOIL(prints.spots[63].x_m = (insole_real_t)NAN);
    SPOIL(prints.spots[0].y_m = (insole_real_t)INFINITY);
    prints = good;
    ck_assert_int_eq(spoiled(), INSOLE_OK);
    ck_assert_int_eq(insole_radio_map_check(NULL), INSOLE_ERR_NULL);
    prints.map.spots = NULL;
    ck_assert_int_eq(spoiled(), INSOLE_ERR_NULL);
    prints = good;
    prints.map.first = NULL;
    ck_assert_int_eq(spoiled(), INSOLE_ERR_NULL);
    prints = good;
    prints.map.aps = NULL;
    ck_assert_int_eq(spoiled(), INSOLE_ERR_NULL);
    prints = good;
    prints.map.below = NULL;
    ck_assert_int_eq(spoiled(), INSOLE_ERR_NULL);
}
END_TEST

START_TEST(trusted_area_is_a_disc)
{
    insole_trusted_area_t area = {spot(10.0, -5.0), 5};
    ck_assert(insole_radio_map_trusts(NULL, spot(1e6, 1e6)));
    ck_assert(insole_radio_map_trusts(&area, spot(10.0, -5.0)));
    ck_assert(insole_radio_map_trusts(&area, spot(13.0, -1.0)));
    ck_assert(!insole_radio_map_trusts(&area, spot(13.01, -1.0)));
    ck_assert(!insole_radio_map_trusts(&area, spot(10.0, 0.01)));
    ck_assert(!insole_radio_map_trusts(&area, spot((double)NAN, 0.0)));
    ck_assert_int_eq(insole_trusted_area_check(&area), INSOLE_OK);
    static const double bad_m[] = {0.0, -1.0, (double)NAN, (double)INFINITY};
    for (int i = 0; i < 4; i++) {
        area.radius_m = (insole_real_t)bad_m[i];
        ck_assert_int_eq(insole_trusted_area_check(&area), INSOLE_ERR_VALUE);
    }
    area.radius_m = 1;
    area.centre.y_m = (insole_real_t)NAN;
    ck_assert_int_eq(insole_trusted_area_check(&area), INSOLE_ERR_VALUE);
    ck_assert_int_eq(insole_trusted_area_check(NULL), INSOLE_ERR_NULL);
}
END_TEST

/* The radius against the largest scatter over all directions. */
START_TEST(radius_from_the_covariance)
{
    insole_rng_seed(&rng, 40u);
    for (int i = 0; i < 200; i++) {
        double a = prints_uniform(&rng, 0.1, 5.0), b = prints_uniform(&rng, 0.1, 5.0);
        double turn = prints_uniform(&rng, 0.0, 3.14159), c = cos(turn), s = sin(turn);
        double xx = a * a * c * c + b * b * s * s, yy = a * a * s * s + b * b * c * c;
        double xy = (a * a - b * b) * c * s;
        insole_trusted_area_t area;
        ck_assert_int_eq(insole_trusted_area_around(spot(3.0, 4.0), (insole_real_t)xx,
                                                    (insole_real_t)xy, (insole_real_t)yy, 3,
                                                    INSOLE_R(1.5), &area),
                         INSOLE_OK);
        ASSERT_NEAR(area.radius_m, 3.0 * fmax(a, b) + 1.5, 1e-4, "m");
        ASSERT_NEAR(area.centre.x_m, 3.0, 0.0, "m");
        ASSERT_NEAR(area.centre.y_m, 4.0, 0.0, "m");
    }
}
END_TEST

START_TEST(no_covariance)
{
    static const double bad[][6] = {{-1, 0, 1, 3, 1, 0},          {1, 0, -1, 3, 1, 0},
                                    {1, 2, 1, 3, 1, 0},           {1, 0, 1, -3, 1, 0},
                                    {1, 0, 1, 3, -1, 0},          {0, 0, 0, 3, 0, 0},
                                    {1, 0, 1, 3, 1, (double)NAN}, {(double)INFINITY, 0, 1, 3, 1, 0},
                                    {1, (double)NAN, 1, 3, 1, 0}};
    insole_trusted_area_t area = {{1, 2}, 3};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        const double *b = bad[i];
        ASSERT_UNCHANGED(area,
                         insole_trusted_area_around(
                             spot(b[5], 0.0), (insole_real_t)b[0], (insole_real_t)b[1],
                             (insole_real_t)b[2], (insole_real_t)b[3], (insole_real_t)b[4], &area),
                         INSOLE_ERR_VALUE);
    }
    ck_assert_int_eq(insole_trusted_area_around(spot(0, 0), 1, 0, 1, 3, 1, NULL), INSOLE_ERR_NULL);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("radio_map");
    suite_add(suite, "levels and bins", levels_and_bins);
    suite_add(suite, "finding", finding);
    suite_add(suite, "what an entry says", what_an_entry_says);
    suite_add(suite, "sound tables", sound_tables);
    suite_add(suite, "tables that contradict", tables_that_contradict);
    suite_add(suite, "trusted area", trusted_area_is_a_disc);
    suite_add(suite, "radius from the covariance", radius_from_the_covariance);
    suite_add(suite, "no covariance", no_covariance);
    return suite;
}
