/* SPDX-License-Identifier: MIT */
#include "insole/place/radio_survey.h"

#include <string.h>

#include "insole/base/rng.h"
#include "near.h"
#include "refusal.h"
#include "suite.h"

enum { POINTS = 100, RECORDS = 2000, APS = 30, SAMPLES = 6000, BINS = INSOLE_RADIO_BINS };

static insole_survey_point_t points[POINTS], other_points[POINTS];
static insole_survey_record_t records[RECORDS], other_records[RECORDS];
static insole_radio_survey_t survey, other;

typedef struct {
    insole_spot_t spots[POINTS];
    uint32_t first[POINTS + 1];
    uint8_t visits[POINTS];
    uint16_t aps[RECORDS];
    uint8_t below[RECORDS], spread[RECORDS], counts[RECORDS], bins[RECORDS * BINS];
} tables_t;

static tables_t tables, more_tables;
static insole_radio_map_t map;
static insole_rng_t rng;

typedef struct {
    insole_spot_t spot;
    uint32_t ap;
    double dbm;
} sample_t;

static sample_t samples[SAMPLES];

static insole_spot_t spot(double x_m, double y_m)
{
    insole_spot_t at = {(insole_real_t)x_m, (insole_real_t)y_m};
    return at;
}

static void begin(double spacing_m)
{
    ck_assert_int_eq(insole_radio_survey_init(&survey, (insole_real_t)spacing_m, points, POINTS,
                                              records, RECORDS),
                     INSOLE_OK);
}

static insole_radio_map_memory_t memory_of(tables_t *t)
{
    insole_radio_map_memory_t memory = {t->spots, t->first,  t->visits, POINTS,  t->aps,
                                        t->below, t->spread, t->counts, t->bins, RECORDS};
    return memory;
}

static insole_status_t freeze(uint32_t keep)
{
    insole_radio_map_memory_t memory = memory_of(&tables);
    return insole_radio_survey_freeze(&survey, keep, &memory, &map);
}

/* Random samples on a plan of 8 x 8 squares of 2.5 m, negative coordinates too. */
static void draw_samples(uint64_t seed)
{
    insole_rng_seed(&rng, seed);
    for (int i = 0; i < SAMPLES; i++) {
        samples[i].spot.x_m = (insole_real_t)(insole_rng_bits(&rng) % 2000u) / 100 - 10;
        samples[i].spot.y_m = (insole_real_t)(insole_rng_bits(&rng) % 2000u) / 100 - 10;
        samples[i].ap = insole_rng_bits(&rng) % APS;
        samples[i].dbm = -40.0 - samples[i].ap - (double)(insole_rng_bits(&rng) % 16u);
    }
}

static void add_all(insole_radio_survey_t *into, int from, int to)
{
    for (int i = from; i < to; i++) {
        ck_assert_int_eq(insole_radio_survey_add(into, samples[i].spot, samples[i].ap,
                                                 (insole_real_t)samples[i].dbm),
                         INSOLE_OK);
    }
}

/* ---- the oracle: two passes over all samples of a square ---- */

typedef struct {
    double mean, std;
    uint32_t count, bins[BINS];
} told_t;

static bool in_square(const sample_t *s, int column, int row)
{
    return (int)floor((double)s->spot.x_m / 2.5) == column &&
           (int)floor((double)s->spot.y_m / 2.5) == row;
}

static told_t tell(int column, int row, uint32_t ap)
{
    told_t told;
    memset(&told, 0, sizeof told);
    double squares = 0.0;
    for (int i = 0; i < SAMPLES; i++) {
        if (samples[i].ap == ap && in_square(&samples[i], column, row)) {
            told.mean += samples[i].dbm;
            told.count++;
            told.bins[(int)fmin(7.0, fmax(0.0, floor((samples[i].dbm + 92.0) / 8.0)))]++;
        }
    }
    told.mean /= told.count ? told.count : 1u;
    for (int i = 0; i < SAMPLES; i++) {
        if (samples[i].ap == ap && in_square(&samples[i], column, row)) {
            squares += (samples[i].dbm - told.mean) * (samples[i].dbm - told.mean);
        }
    }
    told.std = told.count ? sqrt(squares / told.count) : 0.0;
    return told;
}

static void check_point(uint32_t point, worst_t *wrong)
{
    int column = (int)floor((double)map.spots[point].x_m / 2.5);
    int row = (int)floor((double)map.spots[point].y_m / 2.5);
    double x_m = 0.0, y_m = 0.0, n = 0.0;
    for (int i = 0; i < SAMPLES; i++) {
        if (in_square(&samples[i], column, row)) {
            x_m += (double)samples[i].spot.x_m;
            y_m += (double)samples[i].spot.y_m;
            n += 1.0;
        }
    }
    worst_require(wrong, fabs((double)map.spots[point].x_m - x_m / n) < 1e-4, point);
    worst_require(wrong, fabs((double)map.spots[point].y_m - y_m / n) < 1e-4, point);
    uint32_t most = 0;
    for (uint32_t ap = 0; ap < APS; ap++) {
        told_t told = tell(column, row, ap);
        uint32_t entry;
        most = told.count > most ? told.count : most;
        worst_require(wrong, insole_radio_map_find(&map, point, ap, &entry) == (told.count > 0u),
                      ap);
        if (told.count > 0u && insole_radio_map_find(&map, point, ap, &entry)) {
            double mean = (double)insole_radio_map_mean_dbm(&map, entry);
            double std = (double)insole_radio_map_std_db(&map, entry);
            worst_require(wrong, fabs(mean - told.mean) <= 0.2501, ap);
            worst_require(wrong, fabs(std - told.std) <= 0.0635, ap);
            worst_require(wrong, map.counts[entry] == told.count, ap);
            for (int b = 0; b < BINS; b++) {
                worst_require(wrong, map.bins[entry * BINS + (uint32_t)b] == told.bins[b], ap);
            }
        }
    }
    worst_require(wrong, map.visits[point] == most, point);
}

START_TEST(map_tells_what_was_heard)
{
    worst_t wrong = {0.0, 0.0};
    draw_samples(50u);
    begin(2.5);
    add_all(&survey, 0, SAMPLES);
    ck_assert_int_eq(freeze(UINT32_MAX), INSOLE_OK);
    ck_assert_int_eq(insole_radio_map_check(&map), INSOLE_OK);
    ck_assert_uint_eq(map.point_count, 64u);
    ck_assert_uint_eq(map.ap_count, APS);
    ck_assert_uint_eq(map.first[64], survey.record_count);
    for (uint32_t point = 0; point < map.point_count; point++) {
        check_point(point, &wrong);
    }
    ASSERT_ALL_HELD(wrong);
}
END_TEST

/* Two surveys joined are the survey of all samples. */
START_TEST(joined)
{
    draw_samples(51u);
    begin(2.5);
    ck_assert_int_eq(insole_radio_survey_init(&other, INSOLE_R(2.5), other_points, POINTS,
                                              other_records, RECORDS),
                     INSOLE_OK);
    add_all(&survey, 0, 2000);
    add_all(&other, 2000, SAMPLES);
    ck_assert_int_eq(insole_radio_survey_join(&survey, &other), INSOLE_OK);
    ck_assert_int_eq(freeze(UINT32_MAX), INSOLE_OK);
    worst_t wrong = {0.0, 0.0};
    for (uint32_t point = 0; point < map.point_count; point++) {
        check_point(point, &wrong);
    }
    ASSERT_ALL_HELD(wrong);
}
END_TEST

/* Of each point the strongest stay, and nothing else changes. */
START_TEST(strongest_only)
{
    enum { KEEP = 7 };
    draw_samples(52u);
    begin(2.5);
    add_all(&survey, 0, SAMPLES);
    insole_radio_map_t all;
    insole_radio_map_memory_t memory = memory_of(&more_tables);
    ck_assert_int_eq(insole_radio_survey_freeze(&survey, UINT32_MAX, &memory, &all), INSOLE_OK);
    ck_assert_int_eq(freeze(KEEP), INSOLE_OK);
    ck_assert_int_eq(insole_radio_map_check(&map), INSOLE_OK);
    worst_t wrong = {0.0, 0.0};
    for (uint32_t point = 0; point < map.point_count; point++) {
        uint32_t here = map.first[point + 1u] - map.first[point];
        uint32_t there = all.first[point + 1u] - all.first[point];
        worst_require(&wrong, here == (there < KEEP ? there : KEEP), point);
        for (uint32_t i = all.first[point]; i < all.first[point + 1u]; i++) {
            uint32_t before = 0, entry;
            for (uint32_t k = all.first[point]; k < all.first[point + 1u]; k++) {
                before += all.below[k] < all.below[i] ||
                                  (all.below[k] == all.below[i] && all.aps[k] < all.aps[i])
                              ? 1u
                              : 0u;
            }
            bool stays = insole_radio_map_find(&map, point, all.aps[i], &entry);
            worst_require(&wrong, stays == (before < KEEP), point);
            worst_require(&wrong,
                          !stays || (map.below[entry] == all.below[i] &&
                                     map.counts[entry] == all.counts[i] &&
                                     map.spread[entry] == all.spread[i] &&
                                     !memcmp(&map.bins[entry * BINS], &all.bins[i * BINS], BINS)),
                          point);
        }
    }
    ASSERT_ALL_HELD(wrong);
}
END_TEST

/* A thousand visits fit a byte, and what was silent in half of them still was. */
START_TEST(many_visits)
{
    begin(1.0);
    for (int i = 0; i < 1000; i++) {
        ck_assert_int_eq(insole_radio_survey_add(&survey, spot(0.5, 0.5), 3, -50), INSOLE_OK);
        if (i % 2) {
            ck_assert_int_eq(insole_radio_survey_add(&survey, spot(0.5, 0.5), 5, -60), INSOLE_OK);
        }
    }
    ck_assert_int_eq(insole_radio_survey_add(&survey, spot(0.5, 0.5), 9, -90), INSOLE_OK);
    ck_assert_int_eq(freeze(UINT32_MAX), INSOLE_OK);
    ck_assert_uint_eq(map.visits[0], 255u);
    ck_assert_uint_eq(map.counts[0], 255u);
    ck_assert_uint_eq(map.counts[1], 128u);
    ck_assert_uint_eq(map.counts[2], 1u);
    ck_assert_uint_eq(map.bins[0 * BINS + 5], 255u);
    ck_assert_int_eq(insole_radio_map_check(&map), INSOLE_OK);
}
END_TEST

/* A set of samples told at once is the same as one by one. */
START_TEST(told_at_once)
{
    begin(1.0);
    insole_survey_stat_t stat = {-60, 2, 4, {0, 0, 0, 2, 2, 0, 0, 0}}, gap = stat;
    gap.mean_dbm = -70;
    gap.std_db = 0;
    gap.count = 12;
    gap.bins[3] = 12;
    gap.bins[4] = 0;
    ck_assert_int_eq(insole_radio_survey_merge(&survey, spot(2.25, -3.5), 8, &stat), INSOLE_OK);
    ck_assert_int_eq(insole_radio_survey_merge(&survey, spot(2.75, -3.5), 8, &gap), INSOLE_OK);
    ck_assert_uint_eq(survey.record_count, 1u);
    ck_assert_int_eq(freeze(UINT32_MAX), INSOLE_OK);
    ASSERT_NEAR(map.spots[0].x_m, 2.625, 1e-6, "m");
    ASSERT_NEAR(insole_radio_map_mean_dbm(&map, 0), -67.5, 0.0, "dBm");
    ASSERT_NEAR(insole_radio_map_std_db(&map, 0), sqrt(1.0 + 0.25 * 0.75 * 100.0), 0.0625, "dB");
    ck_assert_uint_eq(map.counts[0], 16u);
    ck_assert_uint_eq(map.bins[3], 14u);
}
END_TEST

START_TEST(tables_left_out)
{
    begin(1.0);
    ck_assert_int_eq(insole_radio_survey_add(&survey, spot(0, 0), 1, -50), INSOLE_OK);
    ck_assert_int_eq(insole_radio_survey_add(&survey, spot(0, 0), 0, -60), INSOLE_OK);
    insole_radio_map_memory_t memory = memory_of(&tables);
    memory.visits = memory.spread = memory.counts = memory.bins = NULL;
    ck_assert_int_eq(insole_radio_survey_freeze(&survey, 1, &memory, &map), INSOLE_OK);
    ck_assert_int_eq(insole_radio_map_check(&map), INSOLE_OK);
    ck_assert(!map.visits && !map.spread && !map.counts && !map.bins);
    ck_assert_uint_eq(map.aps[0], 1u);
    ASSERT_NEAR(insole_radio_map_mean_dbm(&map, 0), -50.0, 0.0, "dBm");
}
END_TEST

/* What does not fit is refused and changes nothing; what is known still takes samples. */
START_TEST(full)
{
    ck_assert_int_eq(insole_radio_survey_init(&survey, 1, points, 2, records, 3), INSOLE_OK);
    ck_assert_int_eq(insole_radio_survey_add(&survey, spot(0, 0), 1, -50), INSOLE_OK);
    ck_assert_int_eq(insole_radio_survey_add(&survey, spot(5, 0), 1, -50), INSOLE_OK);
    insole_survey_record_t before[3];
    memcpy(before, records, sizeof before);
    ASSERT_UNCHANGED(survey, insole_radio_survey_add(&survey, spot(9, 0), 1, -50), INSOLE_ERR_ROOM);
    ck_assert_mem_eq(before, records, sizeof before);
    ck_assert_int_eq(insole_radio_survey_add(&survey, spot(5, 0), 2, -50), INSOLE_OK);
    memcpy(before, records, sizeof before);
    ASSERT_UNCHANGED(survey, insole_radio_survey_add(&survey, spot(5, 0), 3, -50), INSOLE_ERR_ROOM);
    ck_assert_mem_eq(before, records, sizeof before);
    ck_assert_int_eq(insole_radio_survey_add(&survey, spot(5, 0), 2, -52), INSOLE_OK);
    insole_survey_stat_t huge = {-50, 0, 1000000, {0, 0, 0, 0, 0, 1000000, 0, 0}};
    ASSERT_UNCHANGED(survey, insole_radio_survey_merge(&survey, spot(5, 0), 2, &huge),
                     INSOLE_ERR_ROOM);
    insole_radio_map_memory_t memory = memory_of(&tables);
    memory.point_room = 1;
    ASSERT_UNCHANGED(map, insole_radio_survey_freeze(&survey, 9, &memory, &map), INSOLE_ERR_ROOM);
    memory.point_room = 2;
    memory.entry_room = 2;
    ASSERT_UNCHANGED(map, insole_radio_survey_freeze(&survey, 9, &memory, &map), INSOLE_ERR_ROOM);
    memory.entry_room = 3;
    ck_assert_int_eq(insole_radio_survey_freeze(&survey, 9, &memory, &map), INSOLE_OK);
}
END_TEST

START_TEST(samples_without_sense)
{
    begin(1.0);
    insole_survey_stat_t good = {-60, 2, 4, {0, 0, 0, 4, 0, 0, 0, 0}};
#define REFUSE(at, ap, damage)                                                                     \
    do {                                                                                           \
        insole_survey_stat_t stat = good;                                                          \
        damage;                                                                                    \
        ASSERT_UNCHANGED(survey, insole_radio_survey_merge(&survey, at, ap, &stat),                \
                         INSOLE_ERR_VALUE);                                                        \
    } while (0)
    REFUSE(spot((double)NAN, 0), 1, (void)stat);
    REFUSE(spot(0, 1.1e5), 1, (void)stat);
    REFUSE(spot(-(double)INFINITY, 0), 1, (void)stat);
    REFUSE(spot(0, 0), 65535u, (void)stat);
    REFUSE(spot(0, 0), 1, stat.mean_dbm = (insole_real_t)NAN);
    REFUSE(spot(0, 0), 1, stat.mean_dbm = INSOLE_R(0.5));
    REFUSE(spot(0, 0), 1, stat.mean_dbm = -128);
    REFUSE(spot(0, 0), 1, stat.std_db = -1);
    REFUSE(spot(0, 0), 1, stat.std_db = (insole_real_t)NAN);
    REFUSE(spot(0, 0), 1, stat.count = 0);
    REFUSE(spot(0, 0), 1, stat.bins[0] = 1);
    REFUSE(spot(0, 0), 1, stat.count = stat.bins[3] = 1000001u);
    ck_assert_uint_eq(survey.point_count + survey.record_count, 0u);
    ASSERT_UNCHANGED(survey, insole_radio_survey_add(&survey, spot(0, 0), 1, (insole_real_t)NAN),
                     INSOLE_ERR_VALUE);
    ASSERT_UNCHANGED(survey, freeze(UINT32_MAX), INSOLE_ERR_STATE);
    ck_assert_int_eq(insole_radio_survey_merge(&survey, spot(1e5, -1e5), 65534u, &good), INSOLE_OK);
    ASSERT_UNCHANGED(survey, freeze(0), INSOLE_ERR_VALUE);
}
END_TEST

START_TEST(refusals)
{
    begin(1.0);
    insole_radio_map_memory_t memory = memory_of(&tables);
    insole_survey_stat_t stat = {-60, 2, 4, {0, 0, 0, 4, 0, 0, 0, 0}};
    static const double bad_m[] = {0.04, 1001.0, -1.0, (double)NAN};
    for (int i = 0; i < 4; i++) {
        ASSERT_UNCHANGED(survey,
                         insole_radio_survey_init(&survey, (insole_real_t)bad_m[i], points, POINTS,
                                                  records, RECORDS),
                         INSOLE_ERR_VALUE);
    }
    ASSERT_UNCHANGED(survey, insole_radio_survey_init(&survey, 1, points, 0, records, 1),
                     INSOLE_ERR_VALUE);
    ASSERT_UNCHANGED(survey, insole_radio_survey_init(&survey, 1, points, 1, records, 0),
                     INSOLE_ERR_VALUE);
    ASSERT_UNCHANGED(survey, insole_radio_survey_init(&survey, 1, NULL, 1, records, 1),
                     INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(survey, insole_radio_survey_init(&survey, 1, points, 1, NULL, 1),
                     INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_radio_survey_init(NULL, 1, points, 1, records, 1), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_radio_survey_add(NULL, spot(0, 0), 1, -50), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_radio_survey_merge(NULL, spot(0, 0), 1, &stat), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(survey, insole_radio_survey_merge(&survey, spot(0, 0), 1, NULL),
                     INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_radio_survey_join(NULL, &survey), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(survey, insole_radio_survey_join(&survey, NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_radio_survey_freeze(NULL, 1, &memory, &map), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_radio_survey_freeze(&survey, 1, NULL, &map), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_radio_survey_freeze(&survey, 1, &memory, NULL), INSOLE_ERR_NULL);
    memory.below = NULL;
    ck_assert_int_eq(insole_radio_survey_freeze(&survey, 1, &memory, &map), INSOLE_ERR_NULL);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("radio_survey");
    suite_add(suite, "tells what was heard", map_tells_what_was_heard);
    suite_add(suite, "joined", joined);
    suite_add(suite, "strongest only", strongest_only);
    suite_add(suite, "many visits", many_visits);
    suite_add(suite, "told at once", told_at_once);
    suite_add(suite, "tables left out", tables_left_out);
    suite_add(suite, "full", full);
    suite_add(suite, "samples without sense", samples_without_sense);
    suite_add(suite, "refusals", refusals);
    return suite;
}
