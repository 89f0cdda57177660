/* SPDX-License-Identifier: MIT */
#include "site.h"

#include "files.h"
#include "near.h"
#include "suite.h"

static site_t site;
static failure_t failure;

static const char plan_text[] = "loss,12\noutline,0,0,20,0,20,10,0,10\nhole,4,4,6,4,6,6,4,6\n"
                                "wall,5,10,0,10,4\nwall,5,10,5.2,10,10\n";
static const char map_text[] = "x,y,id,mean_dbm\n1,1,b,-50\n9,9,b,-60\n9,9,c,-61\n";
static const char aps_text[] = "id,x,y\na,1,1\nb,19,9\n";

static void open_site(const char *plan, const char *aps)
{
    const char *plan_path = plan == NULL ? NULL : scratch_file("plan.csv", plan);
    const char *aps_path = aps == NULL ? NULL : scratch_file("aps.csv", aps);
    bool is_good =
        site_open(&site, plan_path, aps_path, NULL, &insole_propagation_defaults, &failure);
    ck_assert_msg(is_good, "%s", failure.text);
}

START_TEST(a_plan_can_be_asked)
{
    insole_walls_between_t between;
    open_site(plan_text, NULL);
    const insole_floor_plan_t *plan = site.building.plan;
    ck_assert(insole_floor_plan_inside(plan, 1, 1));
    ck_assert(!insole_floor_plan_inside(plan, 5, 5));
    ck_assert(!insole_floor_plan_inside(plan, 21, 1));
    ck_assert(insole_floor_plan_crosses(plan, 9, 2, 11, 2));
    ck_assert(!insole_floor_plan_crosses(plan, 9, INSOLE_R(4.6), 11, INSOLE_R(4.6)));
    ck_assert_int_eq(insole_floor_plan_walls_between(plan, 1, 5, 19, 5, &between), INSOLE_OK);
    ck_assert_uint_eq(between.count, 2u); /* the hole's; the way leads through the door */
    ASSERT_NEAR(between.loss_db, 24.0, 1e-4, "dB");
    ck_assert_uint_eq(site.building.ap_count, 0u);
    site_free(&site);
}
END_TEST

START_TEST(walls_whose_loss_is_not_told_have_that_of_the_settings)
{
    insole_propagation_config_t propagation = insole_propagation_defaults;
    insole_walls_between_t between;
    propagation.wall_db = 7;
    const char *path = scratch_file("plan.csv", "outline,0,0,20,0,20,10,0,10\n");
    ck_assert(site_open(&site, path, NULL, NULL, &propagation, &failure));
    insole_floor_plan_walls_between(site.building.plan, 5, 5, 25, 5, &between);
    ASSERT_NEAR(between.loss_db, 7.0, 1e-5, "dB");
    ck_assert_ptr_eq(site.building.propagation, &propagation);
    site_free(&site);
}
END_TEST

START_TEST(access_points_are_the_buildings)
{
    open_site(NULL, aps_text);
    ck_assert_ptr_null(site.building.plan);
    ck_assert_uint_eq(site.building.ap_count, 2u);
    ck_assert(site.building.aps[1].x_m == 19 && site.building.aps[1].y_m == 9);
    site_free(&site);
}
END_TEST

START_TEST(fingerprints_are_the_sites)
{
    const char *map = scratch_file("radiomap.csv", map_text);
    ck_assert(site_open(&site, NULL, NULL, map, &insole_propagation_defaults, &failure));
    ck_assert(site_has_radiomap(&site));
    ck_assert_uint_eq(site.radiomap_file.map.point_count, 2u);
    ck_assert_ptr_null(site.building.plan);
    ck_assert_uint_eq(site.building.ap_count, 0u);
    ck_assert(site_is_file(&site, map));
    site_free(&site);
    ck_assert(!site_has_radiomap(&site));
}
END_TEST

START_TEST(bad_fingerprints_are_told_and_the_rest_is_freed)
{
    const char *plan = scratch_file("plan.csv", plan_text);
    const char *map = scratch_file("radiomap.csv", "x,y,id\n");
    ck_assert(!site_open(&site, plan, NULL, map, &insole_propagation_defaults, &failure));
    ck_assert_ptr_nonnull(strstr(failure.text, "radiomap.csv:1: header has no column mean_dbm"));
    ck_assert_ptr_null(site.memory.walls);
    ck_assert_ptr_null(site.plan_file.lines);
    ck_assert_ptr_null(site.radiomap_file.name);
}
END_TEST

/* Nobody could be anywhere in it; it can still be drawn and lose radio waves. */
START_TEST(a_plan_without_an_outline_is_a_sketch)
{
    static const char other_floor[] = "floor,1,0,a\nwall,5,1,0,1,4\nfloor,2,3,b\n"
                                      "outline,0,0,9,0,9,9\n";
    static const char *const plans[] = {"wall,5,10,0,10,4\n", "hole,4,4,6,4,6,6,4,6\n",
                                        other_floor};
    for (size_t i = 0u; i < sizeof plans / sizeof plans[0]; i++) {
        const char *path = scratch_file("sketch.csv", plans[i]);
        ck_assert(!site_open(&site, path, NULL, NULL, &insole_propagation_defaults, &failure));
        ck_assert_int_eq(failure.exit_code, EXIT_BAD_INPUT);
        ck_assert_ptr_nonnull(strstr(
            failure.text, "sketch.csv: no outline: expected a ring around where one can walk"));
        ck_assert_ptr_null(site.memory.walls);
        ck_assert(site_open_sketch(&site, path, NULL, &insole_propagation_defaults, &failure));
        ck_assert_ptr_nonnull(site.building.plan);
        site_free(&site);
    }
}
END_TEST

START_TEST(both_or_nothing_may_be_there)
{
    open_site(plan_text, aps_text);
    ck_assert(site.building.plan == &site.plan && site.building.ap_count == 2u);
    site_free(&site);
    open_site(NULL, NULL);
    ck_assert(site.building.plan == NULL && site.building.ap_count == 0u);
    site_free(&site);
    site_free(&site);
}
END_TEST

START_TEST(of_several_floors_the_first_counts)
{
    open_site("floor,1,0,a\noutline,0,0,20,0,20,10,0,10\nfloor,2,3,b\noutline,0,0,90,0,90,90\n",
              NULL);
    ck_assert_uint_eq(site.plan.wall_count, 4u);
    ck_assert(!insole_floor_plan_inside(&site.plan, 60, 30));
    site_free(&site);
}
END_TEST

START_TEST(a_scan_is_heard_in_the_building)
{
    static insole_rss_field_t field;
    const insole_rss_t readings[] = {{1, -50, 0}, {7, -60, 0}};
    open_site(plan_text, aps_text);
    insole_rss_field_init(&field, &insole_rss_field_defaults);
    ck_assert_int_eq(insole_rss_field_hear(&field, &site.building, readings, 2u), INSOLE_OK);
    ck_assert_uint_eq(field.heard_count, 1u);
    ck_assert_uint_eq(field.heard_id[0], 1u);
    site_free(&site);
}
END_TEST

START_TEST(the_grid_is_as_fine_as_the_library_wants_it)
{
    open_site(plan_text, NULL);
    size_t cells = site_cell_count(&site.plan) - 1u;
    ck_assert_uint_ge(cells, site.plan.wall_count);
    ck_assert_uint_le(cells, 4u * site.plan.wall_count);
    ck_assert_uint_ge(site_entry_count(&site.plan), site.plan.wall_count);
    ck_assert_uint_eq(site_plan_bytes(&site.plan), sizeof(insole_wall_t) * site.plan.wall_count +
                                                       4u * (cells + 1u) +
                                                       2u * site_entry_count(&site.plan));
    site_free(&site);
}
END_TEST

START_TEST(what_cannot_be_built_is_told)
{
    const struct {
        const char *text, *message;
    } bad[] = {
        {"wall,1,2,2,2,2\n", ": no wall has a length: expected points that differ"},
        {"floor,1,0,a\nfloor,2,3,b\nwall,1,0,0,1,1\n",
         ": the first floor is empty: expected an outline or a wall"},
        {"outline,0,0,1,0\n", ":1: outline of 2 points: expected at least 3, outline,x,y,x,y,..."},
    };
    for (size_t i = 0u; i < sizeof bad / sizeof bad[0]; i++) {
        char message[600];
        const char *path = scratch_file("bad.csv", bad[i].text);
        snprintf(message, sizeof message, "%s%s", path, bad[i].message);
        ck_assert(!site_open(&site, path, NULL, NULL, &insole_propagation_defaults, &failure));
        ck_assert_int_eq(failure.exit_code, EXIT_BAD_INPUT);
        ck_assert_str_eq(failure.text, message);
    }
}
END_TEST

START_TEST(bad_access_points_are_told_and_the_plan_is_freed)
{
    const char *plan = scratch_file("plan.csv", plan_text);
    const char *aps = scratch_file("aps.csv", "id,x\na,1\n");
    ck_assert(!site_open(&site, plan, aps, NULL, &insole_propagation_defaults, &failure));
    ck_assert_ptr_nonnull(strstr(failure.text, "aps.csv:1: header has no column y"));
    ck_assert_ptr_null(site.memory.walls);
    ck_assert_ptr_null(site.plan_file.lines);
}
END_TEST

START_TEST(its_files_are_known)
{
    open_site(plan_text, aps_text);
    ck_assert(site_is_file(&site, scratch("plan.csv")));
    ck_assert(site_is_file(&site, SCRATCH "/./aps.csv"));
    ck_assert(!site_is_file(&site, scratch("absent.csv")));
    site_free(&site);
    ck_assert(!site_is_file(&site, scratch("plan.csv")));
}
END_TEST

/* 70 lines of 1000 points each: more walls than the library counts. */
START_TEST(too_many_walls_are_told)
{
    const char *path = scratch("large.csv");
    FILE *file = fopen(path, "wb");
    for (int k = 0; k < 70; k++) {
        fputs("wall,1", file);
        for (int i = 0; i < 1000; i++) {
            fprintf(file, ",%d,%d", i, k + i % 2);
        }
        putc('\n', file);
    }
    fclose(file);
    ck_assert(!site_open(&site, path, NULL, NULL, &insole_propagation_defaults, &failure));
    ck_assert_ptr_nonnull(strstr(failure.text, ": 70000 points: expected at most 65535"));
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("site");
    suite_add(suite, "plan", a_plan_can_be_asked);
    suite_add(suite, "loss", walls_whose_loss_is_not_told_have_that_of_the_settings);
    suite_add(suite, "access points", access_points_are_the_buildings);
    suite_add(suite, "fingerprints", fingerprints_are_the_sites);
    suite_add(suite, "fingerprints", bad_fingerprints_are_told_and_the_rest_is_freed);
    suite_add(suite, "no outline", a_plan_without_an_outline_is_a_sketch);
    suite_add(suite, "both", both_or_nothing_may_be_there);
    suite_add(suite, "floors", of_several_floors_the_first_counts);
    suite_add(suite, "scan", a_scan_is_heard_in_the_building);
    suite_add(suite, "grid", the_grid_is_as_fine_as_the_library_wants_it);
    suite_add(suite, "bad plans", what_cannot_be_built_is_told);
    suite_add(suite, "bad access points", bad_access_points_are_told_and_the_plan_is_freed);
    suite_add(suite, "files", its_files_are_known);
    suite_add(suite, "too many", too_many_walls_are_told);
    return suite;
}
