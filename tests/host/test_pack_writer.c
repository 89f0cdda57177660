/* SPDX-License-Identifier: MIT */
#include "pack_writer.h"

#include "files.h"
#include "insole/base/rng.h"
#include "near.h"
#include "same_tables.h"
#include "suite.h"

/* Packed by the program when the suite was built. */
extern const insole_floor_plan_t demo_plan, student_centre_plan;
extern const uint32_t demo_ap_count, student_centre_ap_count;
extern const insole_ap_t demo_aps[], student_centre_aps[];
extern const char *const demo_ap_ids[], *const student_centre_ap_ids[];

extern const insole_radio_map_t surveyed_map;
extern const char *const surveyed_map_ids[];

static const struct {
    const char *plan_path, *aps_path;
    const insole_floor_plan_t *plan;
    const uint32_t *ap_count;
    const insole_ap_t *aps;
    const char *const *ids;
} packed[] = {
    {MAPS "/demo/plan.csv", MAPS "/demo/aps.csv", &demo_plan, &demo_ap_count, demo_aps,
     demo_ap_ids},
    {MAPS "/student_centre/plan.csv", MAPS "/student_centre/aps.csv", &student_centre_plan,
     &student_centre_ap_count, student_centre_aps, student_centre_ap_ids},
};

static site_t site;
static failure_t failure;

static void open_site(const char *plan_path, const char *aps_path)
{
    ck_assert_msg(
        site_open(&site, plan_path, aps_path, NULL, &insole_propagation_defaults, &failure), "%s",
        failure.text);
}

START_TEST(a_packed_plan_is_bit_for_bit_the_one_built)
{
    open_site(packed[_i].plan_path, packed[_i].aps_path);
    const insole_floor_plan_t *plan = packed[_i].plan;
    insole_floor_plan_t same = *plan;
    same.walls = site.plan.walls;
    same.cells = site.plan.cells;
    same.entries = site.plan.entries;
    ck_assert_mem_eq(plan->walls, site.plan.walls, plan->wall_count * sizeof *plan->walls);
    ck_assert_mem_eq(plan->cells, site.plan.cells, site_cell_count(plan) * sizeof *plan->cells);
    ck_assert_mem_eq(plan->entries, site.plan.entries,
                     site_entry_count(plan) * sizeof *plan->entries);
    ck_assert(same.origin_x_m == site.plan.origin_x_m && same.origin_y_m == site.plan.origin_y_m);
    ck_assert(same.cell_m == site.plan.cell_m && same.cells_per_m == site.plan.cells_per_m);
    ck_assert(same.spot_x == site.plan.spot_x && same.spot_y == site.plan.spot_y);
    ck_assert(same.columns == site.plan.columns && same.rows == site.plan.rows);
    ck_assert_uint_eq(same.outline_walls, site.plan.outline_walls);
    ck_assert_uint_eq(same.ring_walls, site.plan.ring_walls);
    ck_assert_uint_eq(same.wall_count, site.plan.wall_count);
    site_free(&site);
}
END_TEST

static insole_real_t anywhere(insole_rng_t *rng, double low, double high)
{
    return (insole_real_t)(low + (high - low) * (double)insole_rng_uniform(rng));
}

START_TEST(a_packed_plan_answers_as_the_one_built)
{
    insole_rng_t rng;
    worst_t equal = {0.0, 0.0};
    int inside = 0, crossing = 0;
    uint32_t walls = 0u;
    open_site(packed[_i].plan_path, packed[_i].aps_path);
    insole_rng_seed(&rng, 7u);
    for (int i = 0; i < 20000; i++) {
        insole_real_t x0 = anywhere(&rng, -2, 62), y0 = anywhere(&rng, -2, 42);
        insole_real_t x1 = x0 + anywhere(&rng, -2, 2), y1 = y0 + anywhere(&rng, -2, 2);
        insole_real_t xa = anywhere(&rng, -2, 62), ya = anywhere(&rng, -2, 42);
        insole_walls_between_t a, b;
        bool is_inside = insole_floor_plan_inside(packed[_i].plan, x0, y0);
        bool is_crossing = insole_floor_plan_crosses(packed[_i].plan, x0, y0, x1, y1);
        insole_floor_plan_walls_between(packed[_i].plan, x0, y0, xa, ya, &a);
        insole_floor_plan_walls_between(&site.plan, x0, y0, xa, ya, &b);
        worst_require(&equal, is_inside == insole_floor_plan_inside(&site.plan, x0, y0), i);
        worst_require(&equal, is_crossing == insole_floor_plan_crosses(&site.plan, x0, y0, x1, y1),
                      i);
        worst_require(&equal, a.count == b.count && a.loss_db == b.loss_db, i);
        inside += is_inside;
        crossing += is_crossing;
        walls += a.count;
    }
    ASSERT_ALL_HELD(equal);
    ck_assert_int_gt(inside, 1000); /* the questions were not idle */
    ck_assert_int_gt(crossing, 500);
    ck_assert_uint_gt(walls, 10000u);
    site_free(&site);
}
END_TEST

START_TEST(packed_access_points_are_those_of_the_file)
{
    open_site(packed[_i].plan_path, packed[_i].aps_path);
    ck_assert_uint_eq(*packed[_i].ap_count, site.ap_file.count);
    ck_assert_mem_eq(packed[_i].aps, site.ap_file.aps, site.ap_file.count * sizeof(insole_ap_t));
    for (size_t i = 0u; i < site.ap_file.count; i++) {
        ck_assert_str_eq(packed[_i].ids[i], site.ap_file.ids.names[i]);
    }
    site_free(&site);
}
END_TEST

/* The same rows, packed when the suite was built and read now. */
START_TEST(a_packed_radio_map_is_bit_for_bit_the_one_read)
{
    radiomap_file_t file;
    ck_assert_msg(radiomap_file_read(&file, SURVEYED, &failure), "%s", failure.text);
    const insole_radio_map_t *a = &file.map, *b = &surveyed_map;
    ck_assert_int_eq(insole_radio_map_check(b), INSOLE_OK);
    ck_assert_uint_gt(a->point_count, 20u);
    expect_same_tables(a, b);
    ck_assert_ptr_null(b->bins);
    for (size_t i = 0u; i < file.ids.count; i++) {
        ck_assert_str_eq(surveyed_map_ids[i], file.ids.names[i]);
    }
    radiomap_file_free(&file);
}
END_TEST

/* ---- text ------------------------------------------------------------------------------- */

static const char *pack_text(const char *plan, const char *aps, const char *name)
{
    FILE *file = tmpfile();
    open_site(plan == NULL ? NULL : scratch_file("a.csv", plan),
              aps == NULL ? NULL : scratch_file("b.csv", aps));
    pack_write(file, &site, name);
    site_free(&site);
    return text_of(file);
}

static void expect_part(const char *text, const char *part)
{
    ck_assert_msg(strstr(text, part) != NULL, "%s is not in %s", part, text);
}

START_TEST(tables_have_the_name_given)
{
    const char *text = pack_text("outline,0,0,9,0,9,9\n", "id,x,y\na,1,2\n", "hall_2");
    expect_part(text, "\nextern const insole_floor_plan_t hall_2_plan;\n");
    expect_part(text, "\nstatic const insole_wall_t hall_2_walls[3] = {\n");
    expect_part(text, "\nconst insole_ap_t hall_2_aps[1] = {\n");
    expect_part(text, "\nconst uint32_t hall_2_ap_count = 1;\n");
    expect_part(text, ".walls = hall_2_walls,");
}
END_TEST

START_TEST(what_is_not_there_is_not_written)
{
    const char *text = pack_text("outline,0,0,9,0,9,9\n", NULL, "site");
    ck_assert_ptr_null(strstr(text, "_aps"));
    text = pack_text(NULL, "id,x,y\na,1,2\n", "site");
    ck_assert_ptr_null(strstr(text, "_plan;"));
    ck_assert_ptr_null(strstr(text, "_walls"));
    expect_part(text, "\nconst insole_ap_t site_aps[1] = {\n");
}
END_TEST

START_TEST(of_a_radio_map_what_it_knows_is_written)
{
    FILE *file = tmpfile();
    const char *map = scratch_file("map.csv", "x,y,id,mean_dbm\n1,2.5,b,-60\n1,2.5,a,-61.5\n");
    bool is_good = site_open(&site, NULL, NULL, map, &insole_propagation_defaults, &failure);
    ck_assert_msg(is_good, "%s", failure.text);
    pack_write(file, &site, "hall");
    site_free(&site);
    const char *text = text_of(file);
    expect_part(text, "#include \"insole/place/radio_map.h\"\n");
    expect_part(text, "\nextern const insole_radio_map_t hall_map;\n"
                      "extern const char *const hall_map_ids[2];\n");
    expect_part(text, "static const insole_spot_t hall_map_spots[1] = {\n"
                      "    {INSOLE_R(1.0), INSOLE_R(2.5)},\n};\n");
    expect_part(text, "static const uint32_t hall_map_first[2] = {\n    0, 2,\n};\n");
    expect_part(text, "static const uint8_t hall_map_below[2] = {\n    123, 120,\n};\n");
    expect_part(text, "    \"a\",\n    \"b\",\n};\n");
    ck_assert_ptr_null(strstr(text, "spread"));
    ck_assert_ptr_null(strstr(text, "counts"));
    ck_assert_ptr_null(strstr(text, "_plan;"));
}
END_TEST

START_TEST(numbers_are_literals_of_the_real_type)
{
    const char *text =
        pack_text("loss,12\noutline,0,0,9,0,9,9\n",
                  "id,x,y,z,p0_dbm,exponent,near_dbm\na,100000,-2,1.5,-38,2,-42\n", "site");
    expect_part(text, "    {INSOLE_R(100000.0), INSOLE_R(-2.0), INSOLE_R(1.5), INSOLE_R(-38.0), "
                      "INSOLE_R(2.0), INSOLE_R(-42.0)},\n");
    expect_part(text, ", INSOLE_R(12.0)},\n");
}
END_TEST

START_TEST(ids_become_strings_whatever_they_hold)
{
    const char *text = pack_text(
        NULL, "id,x,y\na\"b\\c,1,2\n?\?/x,1,2\n\303\251t\303\251 1,1,2\n%s,1,2\n", "site");
    expect_part(text, "    \"a\\042b\\134c\",\n    \"\\077\\077/x\",\n"
                      "    \"\\303\\251t\\303\\251 1\",\n    \"%s\",\n");
}
END_TEST

/* An asterisk before the slash that a path is cut at would. */
START_TEST(no_name_of_a_file_ends_the_comment)
{
    FILE *file = tmpfile();
    bool is_good = ap_file_take(&site.ap_file, file_of("id,x,y\na,1,2\n"), "x* int y; *\n\\",
                                &insole_propagation_defaults, &failure);
    ck_assert(is_good);
    pack_write(file, &site, "site");
    expect_part(text_of(file), "/* Made by `insole pack` from x_ int y; ___: change those");
    site_free(&site);
}
END_TEST

START_TEST(lines_stay_short)
{
    open_site(MAPS "/exhibition_hall/plan.csv", NULL);
    FILE *file = tmpfile();
    char line[400];
    size_t longest = 0u, lines = 0u;
    pack_write(file, &site, "hall");
    for (rewind(file); fgets(line, sizeof line, file) != NULL; lines++) {
        bool is_of_reals = strstr(line, "INSOLE_R(") != NULL || strstr(line, "/* Made") != NULL;
        longest = !is_of_reals && strlen(line) > longest ? strlen(line) : longest;
    }
    ck_assert_uint_le(longest, 101u);
    ck_assert_uint_gt(lines, site.plan.wall_count);
    fclose(file);
    site_free(&site);
}
END_TEST

START_TEST(names_are_identifiers)
{
    static const char *const good[] = {"site", "a", "Hall_2",
                                       "x123456789x123456789x123456789x123456789"};
    static const char *const bad[] = {"",
                                      "2nd",
                                      "_site",
                                      "a-b",
                                      "a b",
                                      "caf\xC3\xA9",
                                      "x123456789x123456789x123456789x123456789x"};
    for (size_t i = 0u; i < sizeof good / sizeof good[0]; i++) {
        ck_assert_msg(pack_is_name(good[i]), "%s", good[i]);
    }
    for (size_t i = 0u; i < sizeof bad / sizeof bad[0]; i++) {
        ck_assert_msg(!pack_is_name(bad[i]), "%s", bad[i]);
    }
}
END_TEST

#define ROWS(table) ((int)(sizeof table / sizeof table[0]))

Suite *insole_suite(void)
{
    Suite *suite = suite_create("pack_writer");
    suite_add_loop(suite, "bits", a_packed_plan_is_bit_for_bit_the_one_built, ROWS(packed));
    suite_add_loop(suite, "answers", a_packed_plan_answers_as_the_one_built, ROWS(packed));
    suite_add_loop(suite, "access points", packed_access_points_are_those_of_the_file,
                   ROWS(packed));
    suite_add(suite, "radio map", a_packed_radio_map_is_bit_for_bit_the_one_read);
    suite_add(suite, "radio map", of_a_radio_map_what_it_knows_is_written);
    suite_add(suite, "names of tables", tables_have_the_name_given);
    suite_add(suite, "left out", what_is_not_there_is_not_written);
    suite_add(suite, "numbers", numbers_are_literals_of_the_real_type);
    suite_add(suite, "ids", ids_become_strings_whatever_they_hold);
    suite_add(suite, "comment", no_name_of_a_file_ends_the_comment);
    suite_add(suite, "lines", lines_stay_short);
    suite_add(suite, "names", names_are_identifiers);
    return suite;
}
