/* SPDX-License-Identifier: MIT */
#include "insole/place/map_search.h"

#include "fingerprints.h"
#include "refusal.h"
#include "suite.h"

static prints_t prints;
static insole_map_search_t search;
static insole_rss_t readings[PRINTS_APS];
static insole_rng_t rng;

static uint32_t listen(void)
{
    insole_rng_seed(&rng, 30u);
    prints_hall(&prints, 40, 0.0, 0.0);
    ck_assert_int_eq(insole_radio_map_check(&prints.map), INSOLE_OK);
    return prints_listen(&rng, 40, 20.0, 20.0, 1.0, 0.0, readings);
}

static insole_status_t begin(const insole_trusted_area_t *area, uint32_t count)
{
    return insole_map_search_begin(&search, &prints.map, area, 3, INSOLE_R(3.5), readings, count);
}

/* Each point of the area is seen once, however the work is cut. */
START_TEST(cut_anyhow)
{
    static const uint32_t slices[] = {1, 7, 63, 64, 65, UINT32_MAX};
    insole_trusted_area_t area = {{20, 20}, 12};
    uint32_t heard = listen();
    for (int with_area = 0; with_area < 2; with_area++) {
        uint32_t seen[PRINTS_POINTS] = {0}, calls = 0;
        ck_assert_int_eq(begin(with_area ? &area : NULL, heard), INSOLE_OK);
        do {
            uint32_t budget = slices[_i], point;
            while (insole_map_search_next(&search, &prints.map, &budget, &point)) {
                seen[point]++;
                insole_map_search_add(&search, &prints.map, point, -(insole_real_t)point);
            }
            calls++;
        } while (insole_map_search_has_more(&search));
        ck_assert_uint_eq(calls, slices[_i] >= PRINTS_POINTS
                                     ? 1u
                                     : (PRINTS_POINTS + slices[_i] - 1u) / slices[_i]);
        uint32_t inside = 0;
        for (int i = 0; i < PRINTS_POINTS; i++) {
            double x_m = (double)prints.spots[i].x_m - 20.0,
                   y_m = (double)prints.spots[i].y_m - 20.0;
            bool wanted = !with_area || x_m * x_m + y_m * y_m <= 144.0;
            ck_assert_uint_eq(seen[i], wanted ? 1u : 0u);
            inside += wanted ? 1u : 0u;
        }
        ck_assert_uint_eq(search.mixture.count, inside);
        ck_assert_int_eq(insole_map_search_finish(&search, &prints.map), INSOLE_OK);
        ck_assert_int_eq(insole_map_search_finish(&search, &prints.map), INSOLE_ERR_STATE);
    }
}
END_TEST

START_TEST(not_before_its_time)
{
    uint32_t budget = 10, point, heard = listen();
    memset(&search, 0, sizeof search);
    ck_assert(!insole_map_search_next(&search, &prints.map, &budget, &point));
    ASSERT_UNCHANGED(search, insole_map_search_finish(&search, &prints.map), INSOLE_ERR_STATE);
    ck_assert_int_eq(begin(NULL, heard), INSOLE_OK);
    ck_assert(insole_map_search_next(&search, &prints.map, &budget, &point));
    insole_map_search_add(&search, &prints.map, point, 0);
    ck_assert(insole_map_search_has_more(&search));
    ASSERT_UNCHANGED(search, insole_map_search_finish(&search, &prints.map), INSOLE_ERR_STATE);
}
END_TEST

START_TEST(area_without_points)
{
    insole_trusted_area_t area = {{1000, 0}, 5};
    uint32_t budget = UINT32_MAX, point;
    ck_assert_int_eq(begin(&area, listen()), INSOLE_OK);
    ck_assert(!insole_map_search_next(&search, &prints.map, &budget, &point));
    ck_assert(!insole_map_search_has_more(&search));
    ASSERT_UNCHANGED(search, insole_map_search_finish(&search, &prints.map), INSOLE_ERR_STATE);
}
END_TEST

START_TEST(another_map)
{
    uint32_t budget = 10, point, heard = listen();
    ck_assert_int_eq(begin(NULL, heard), INSOLE_OK);
    insole_radio_map_t other = prints.map;
    other.point_count = 5;
    ck_assert(!insole_map_search_next(&search, &other, &budget, &point));
    ck_assert_uint_eq(budget, 10u);
    budget = UINT32_MAX;
    while (insole_map_search_next(&search, &prints.map, &budget, &point)) {
        insole_map_search_add(&search, &prints.map, point, 0);
    }
    ASSERT_UNCHANGED(search, insole_map_search_finish(&search, &other), INSOLE_ERR_STATE);
    ck_assert_int_eq(insole_map_search_finish(&search, &prints.map), INSOLE_OK);
}
END_TEST

START_TEST(refusals)
{
    uint32_t heard = listen();
    insole_trusted_area_t bad = {{0, 0}, 0};
    memset(&search, 0x5a, sizeof search);
    ASSERT_UNCHANGED(search, begin(&bad, heard), INSOLE_ERR_VALUE);
    ASSERT_UNCHANGED(search, begin(NULL, 2), INSOLE_ERR_STATE);
    ASSERT_UNCHANGED(search, begin(NULL, 0), INSOLE_ERR_STATE);
    ASSERT_UNCHANGED(search, insole_map_search_begin(&search, NULL, NULL, 3, 3, readings, heard),
                     INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(search, insole_map_search_begin(&search, &prints.map, NULL, 3, 3, NULL, heard),
                     INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_map_search_begin(NULL, &prints.map, NULL, 3, 3, readings, heard),
                     INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_map_search_finish(NULL, &prints.map), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(search, insole_map_search_finish(&search, NULL), INSOLE_ERR_NULL);
    ck_assert(!insole_map_search_has_more(NULL));
    for (uint32_t i = 0; i < heard; i++) {
        readings[i].id += 40u; /* nobody knows them */
    }
    ASSERT_UNCHANGED(search, begin(NULL, heard), INSOLE_ERR_STATE);
}
END_TEST

/* Over all access points, one by one, in double. */
START_TEST(distances_by_hand)
{
    worst_t off = {0, 0};
    uint32_t heard = listen();
    ck_assert_int_eq(begin(NULL, heard), INSOLE_OK);
    insole_real_t heard_db2 = insole_map_search_heard_db2(&search, -100);
    for (uint32_t point = 0; point < prints.map.point_count; point++) {
        double squares = 0.0;
        for (uint32_t ap = 0, entry; ap < prints.map.ap_count; ap++) {
            double scan = -100.0, mapped = -100.0;
            for (uint32_t i = 0; i < heard; i++) {
                scan = readings[i].id == ap ? (double)readings[i].rss_dbm : scan;
            }
            if (insole_radio_map_find(&prints.map, point, ap, &entry)) {
                mapped = (double)insole_radio_map_mean_dbm(&prints.map, entry);
            }
            squares += pow(scan - mapped, 2.0);
        }
        double found =
            (double)insole_map_search_distance_db2(&search, &prints.map, point, -100, heard_db2);
        worst_note(&off, fabs(found - squares) / (1.0 + (double)heard_db2), point);
    }
    ASSERT_WORST(off, 1e-5, "of the scan's");
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("map_search");
    suite_add_loop(suite, "cut anyhow", cut_anyhow, 6);
    suite_add(suite, "not before its time", not_before_its_time);
    suite_add(suite, "area without points", area_without_points);
    suite_add(suite, "another map", another_map);
    suite_add(suite, "refusals", refusals);
    suite_add(suite, "distances", distances_by_hand);
    return suite;
}
