/* SPDX-License-Identifier: MIT */
#include "radiomap_file.h"

#include "files.h"
#include "insole/base/rng.h"
#include "near.h"
#include "same_tables.h"
#include "suite.h"

static radiomap_file_t file;
static failure_t failure;

static bool take(const char *text)
{
    memset(&failure, 0, sizeof failure);
    return radiomap_file_take(&file, file_of(text), "map", &failure);
}

static void read_text(const char *text)
{
    bool is_good = take(text);
    ck_assert_msg(is_good, "%s", failure.text);
    ck_assert_int_eq(insole_radio_map_check(&file.map), INSOLE_OK);
}

/* What the map knows of an access point by its name. */
static uint32_t entry_of(uint32_t point, const char *name)
{
    uint32_t ap, entry = UINT32_MAX;
    ck_assert_msg(id_table_find(&file.ids, name, &ap), "%s", name);
    ck_assert_msg(insole_radio_map_find(&file.map, point, ap, &entry), "%s", name);
    return entry;
}

START_TEST(every_column_is_read)
{
    read_text("# two points\nx,y,id,mean_dbm,std_dbm,count\n"
              "1.5,-2,02:1b:00:00:00:01,-61.5,2.25,4   # door\n1.5,-2,a b#1,-80,0,9\n\n"
              "100,.25,a b#1,-45.26,31.9,1\n");
    const insole_radio_map_t *map = &file.map;
    ck_assert_uint_eq(map->point_count, 2u);
    ck_assert_uint_eq(map->ap_count, 2u);
    ck_assert_uint_eq(file.ids.count, 2u);
    ck_assert(map->spots[0].x_m == INSOLE_R(1.5) && map->spots[0].y_m == INSOLE_R(-2.0));
    ck_assert(map->spots[1].x_m == INSOLE_R(100.0) && map->spots[1].y_m == INSOLE_R(0.25));
    ck_assert_uint_eq(map->visits[0], 9u);
    ck_assert_uint_eq(map->visits[1], 1u);
    uint32_t first = entry_of(0, "02:1b:00:00:00:01"), other = entry_of(1, "a b#1");
    ASSERT_NEAR((double)insole_radio_map_mean_dbm(map, first), -61.5, 0.0, "dBm");
    ASSERT_NEAR((double)insole_radio_map_std_db(map, first), 2.25, 0.0, "dB");
    ck_assert_uint_eq(insole_radio_map_heard(map, first), 4u);
    ck_assert_uint_eq(insole_radio_map_heard(map, entry_of(0, "a b#1")), 9u);
    ASSERT_NEAR((double)insole_radio_map_mean_dbm(map, other), -45.5, 0.0, "dBm");
    ASSERT_NEAR((double)insole_radio_map_std_db(map, other), 31.875, 0.0, "dB");
    ck_assert_ptr_null(map->bins);
    radiomap_file_free(&file);
}
END_TEST

START_TEST(columns_come_in_any_order_and_may_be_left_out)
{
    read_text("id,mean_dbm,y,x\na,-60,2,1\n");
    ck_assert(file.map.spots[0].x_m == 1 && file.map.spots[0].y_m == 2);
    ck_assert_ptr_null(file.map.spread);
    ck_assert_ptr_null(file.map.counts);
    ck_assert_ptr_null(file.map.visits);
    radiomap_file_free(&file);
    read_text("count,id,mean_dbm,y,x\n3,a,-60,2,1\n,b,-60,2,1\n");
    ck_assert_ptr_null(file.map.spread);
    ck_assert_uint_eq(insole_radio_map_heard(&file.map, entry_of(0, "a")), 3u);
    ck_assert_uint_eq(insole_radio_map_heard(&file.map, entry_of(0, "b")), 1u);
    radiomap_file_free(&file);
}
END_TEST

START_TEST(rows_of_a_place_are_one_point_wherever_they_stand)
{
    read_text("x,y,id,mean_dbm\n1,2,z,-60\n3,4,a,-61\n1.0002,2,b,-62\n-0,0,b,-70\n0,-0.0001,c,-71\n"
              "3,4,z,-63\n");
    ck_assert_uint_eq(file.map.point_count, 3u);
    ck_assert_uint_eq(file.map.first[1], 2u);
    ck_assert_uint_eq(file.map.first[2], 4u);
    ck_assert_uint_eq(file.map.first[3], 6u);
    ck_assert(file.map.spots[0].x_m == 1 && file.map.spots[1].x_m == 3);
    ASSERT_NEAR((double)insole_radio_map_mean_dbm(&file.map, entry_of(0, "b")), -62.0, 0.0, "dBm");
    ASSERT_NEAR((double)insole_radio_map_mean_dbm(&file.map, entry_of(1, "z")), -63.0, 0.0, "dBm");
    static const char *const names[] = {"a", "b", "c", "z"};
    for (size_t i = 0u; i < 4u; i++) {
        ck_assert_str_eq(file.ids.names[i], names[i]);
    }
    radiomap_file_free(&file);
}
END_TEST

/* Counts are bytes: the largest of a point gives the scale, and what was heard stays heard. */
START_TEST(large_counts_keep_their_shares)
{
    read_text("x,y,id,mean_dbm,count\n1,1,a,-60,1000\n1,1,b,-60,500\n1,1,c,-60,1\n2,2,a,-60,255\n"
              "2,2,b,-60,7\n");
    ck_assert_uint_eq(file.map.visits[0], 255u);
    ck_assert_uint_eq(insole_radio_map_heard(&file.map, entry_of(0, "a")), 255u);
    ck_assert_uint_eq(insole_radio_map_heard(&file.map, entry_of(0, "b")), 128u);
    ck_assert_uint_eq(insole_radio_map_heard(&file.map, entry_of(0, "c")), 1u);
    ck_assert_uint_eq(insole_radio_map_heard(&file.map, entry_of(1, "b")), 7u);
    radiomap_file_free(&file);
}
END_TEST

START_TEST(ids_of_a_log_lead_to_access_points_by_name)
{
    id_table_t ids;
    read_text("x,y,id,mean_dbm\n1,2,b,-60\n1,2,a,-61\n");
    id_table_init(&ids);
    id_table_number(&ids, "b");
    id_table_number(&ids, "stranger");
    id_table_number(&ids, "a");
    ck_assert_uint_eq(radiomap_file_number(&file, &ids, 0u), 1u);
    ck_assert_uint_eq(radiomap_file_number(&file, &ids, 1u), RADIOMAP_FILE_UNKNOWN);
    ck_assert_uint_eq(radiomap_file_number(&file, &ids, 2u), 0u);
    ck_assert_uint_eq(radiomap_file_number(&file, &ids, 3u), RADIOMAP_FILE_UNKNOWN);
    id_table_free(&ids);
    radiomap_file_free(&file);
}
END_TEST

/* ---- round trip ------------------------------------------------------------------------- */

enum { MANY_POINTS = 60, MANY_APS = 40 };

/* A file of what a map can hold, in an order of rows and names that is none. */
static const char *many_rows(uint32_t *rows)
{
    *rows = 0u;
    const char *path = scratch("many.csv");
    FILE *stream = fopen(path, "wb");
    insole_rng_t rng;
    insole_rng_seed(&rng, 5u);
    fputs("count,x,id,y,std_dbm,mean_dbm\n", stream);
    for (int ap = 0; ap < MANY_APS; ap++) {
        for (int point = 0; point < MANY_POINTS; point++) {
            double u = (double)insole_rng_uniform(&rng), v = (double)insole_rng_uniform(&rng);
            if (u < 0.5) {
                (*rows)++;
                fprintf(stream, "%d,%.3f,%02d-ap,%.3f,%.3f,%.1f\n", 1 + (int)(300.0 * v),
                        0.731 * point - 9.0, ap * 17 % MANY_APS, 0.1 * point,
                        (double)(int)(255.0 * v) / 8.0, -(double)(int)(510.0 * u) / 2.0);
            }
        }
    }
    fclose(stream);
    return path;
}

START_TEST(what_is_written_is_read_bit_for_bit)
{
    static char text[TEXT_ROOM];
    radiomap_file_t again;
    uint32_t rows;
    ck_assert_msg(radiomap_file_read(&file, many_rows(&rows), &failure), "%s", failure.text);
    FILE *stream = tmpfile();
    radiomap_file_write(stream, &file);
    strcpy(text, text_of(stream));
    bool is_good = radiomap_file_take(&again, file_of(text), "again", &failure);
    ck_assert_msg(is_good, "%s", failure.text);
    expect_same_tables(&file.map, &again.map);
    ck_assert_uint_eq(file.map.first[file.map.point_count], rows);
    for (size_t i = 0u; i < file.ids.count; i++) {
        ck_assert_str_eq(file.ids.names[i], again.ids.names[i]);
    }
    stream = tmpfile();
    radiomap_file_write(stream, &again);
    ck_assert_str_eq(text_of(stream), text);
    radiomap_file_free(&file);
    radiomap_file_free(&again);
}
END_TEST

START_TEST(what_a_map_does_not_know_is_not_written)
{
    FILE *stream = tmpfile();
    read_text("y,x,id,mean_dbm\n2,1,b,-60\n2,1,a,-61.5\n");
    radiomap_file_write(stream, &file);
    ck_assert_str_eq(text_of(stream),
                     "x,y,id,mean_dbm\n1.000,2.000,a,-61.5\n1.000,2.000,b,-60.0\n");
    ck_assert_uint_eq(radiomap_file_bytes(&file.map),
                      sizeof(insole_spot_t) + 2u * sizeof(uint32_t) + 2u * 3u);
    radiomap_file_free(&file);
}
END_TEST

/* ---- malformed -------------------------------------------------------------------------- */

#define HEADER "x,y,id,mean_dbm,std_dbm,count"

static const struct {
    const char *text, *message;
} malformed[] = {
    {"", "map: no fingerprints: expected a header, " HEADER ", and at least one row"},
    {HEADER "\n# none\n",
     "map: no fingerprints: expected a header, " HEADER ", and at least one row"},
    {"1,2,a,-60,1,1\n", "map:1: unknown column \"1\": expected some of " HEADER},
    {"x,y,id,rss\n", "map:1: unknown column \"rss\": expected some of " HEADER},
    {"x,y,id,mean_db\n",
     "map:1: unknown column \"mean_db\": expected some of " HEADER " (mean_dbm?)"},
    {"x,y,id\n", "map:1: header has no column mean_dbm: expected " HEADER
                 ", of which x,y,id,mean_dbm must be there"},
    {"x,y,id,mean_dbm\n1,2,a\n", "map:2: row has 3 fields: expected 4 as in the header"},
    {"x,y,id,mean_dbm\neast,2,a,-60\n", "map:2: x \"east\" is not a number"},
    {"x,y,id,mean_dbm\n1,inf,a,-60\n", "map:2: y \"inf\" is not a number"},
    {"x,y,id,mean_dbm\n1,2,a,\n", "map:2: mean_dbm \"\" is not a number"},
    {"x,y,id,mean_dbm\n1,2,,-60\n", "map:2: id of 0 characters: expected 1 to 63"},
    {"x,y,id,mean_dbm\n100001,2,a,-60\n",
     "map:2: x 100001 is out of range: expected -100000 to 100000"},
    {"x,y,id,mean_dbm\n1,2,a,1\n", "map:2: mean_dbm 1 is out of range: expected -127.5 to 0"},
    {"x,y,id,mean_dbm\n1,2,a,-128\n", "map:2: mean_dbm -128 is out of range: expected -127.5 to 0"},
    {"x,y,id,mean_dbm,std_dbm\n1,2,a,-60,-1\n",
     "map:2: std_dbm -1 is out of range: expected 0 to 127"},
    {"x,y,id,mean_dbm,count\n1,2,a,-60,0\n",
     "map:2: count 0 is out of range: expected 1 to 1000000"},
    {"x,y,id,mean_dbm,count\n1,2,a,-60,1.5\n",
     "map:2: count 1.5 is not a whole number: expected 1 to 1000000"},
    {"x,y,id,mean_dbm\n1,2,a,-60\n1,3,a,-60\n1,2,b,-60\n\n1.000,2,a,-61\n1,3,a,-6\n",
     "map:6: id \"a\" comes twice at 1.000,2.000: it is there in line 2"},
};

START_TEST(malformed_lines_are_told_with_file_line_and_what_was_expected)
{
    ck_assert(!take(malformed[_i].text));
    ck_assert_int_eq(failure.exit_code, EXIT_BAD_INPUT);
    ck_assert_str_eq(failure.text, malformed[_i].message);
    ck_assert_ptr_null(file.name);
    ck_assert_ptr_null(file.ids.names);
    ck_assert_ptr_null(file.memory.spots);
    ck_assert_ptr_null(file.map.spots);
}
END_TEST

START_TEST(too_many_access_points_are_told)
{
    const char *path = scratch("crowd.csv");
    FILE *stream = fopen(path, "wb");
    fputs("x,y,id,mean_dbm\n", stream);
    for (int i = 0; i <= INSOLE_RADIO_APS_MAX; i++) {
        fprintf(stream, "1,1,ap%d,-60\n", i);
    }
    fclose(stream);
    ck_assert(!radiomap_file_read(&file, path, &failure));
    ck_assert_ptr_nonnull(
        strstr(failure.text, "crowd.csv:65537: too many access points: expected at most 65535"));
}
END_TEST

START_TEST(files_are_read_by_their_path_or_told)
{
    const char *path = scratch_file("map.csv", "\xEF\xBB\xBFx,y,id,mean_dbm\r\n1,2,a,-60\r\n");
    ck_assert(radiomap_file_read(&file, path, &failure));
    ck_assert_str_eq(file.name, path);
    radiomap_file_free(&file);
    ck_assert(!radiomap_file_read(&file, scratch("absent.csv"), &failure));
    ck_assert_ptr_nonnull(strstr(failure.text, "absent.csv: cannot open: No such file"));
}
END_TEST

#define ROWS(table) ((int)(sizeof table / sizeof table[0]))

Suite *insole_suite(void)
{
    Suite *suite = suite_create("host/radiomap_file");
    suite_add(suite, "columns", every_column_is_read);
    suite_add(suite, "columns", columns_come_in_any_order_and_may_be_left_out);
    suite_add(suite, "points", rows_of_a_place_are_one_point_wherever_they_stand);
    suite_add(suite, "counts", large_counts_keep_their_shares);
    suite_add(suite, "ids of a log", ids_of_a_log_lead_to_access_points_by_name);
    suite_add(suite, "round trip", what_is_written_is_read_bit_for_bit);
    suite_add(suite, "round trip", what_a_map_does_not_know_is_not_written);
    suite_add_loop(suite, "malformed",
                   malformed_lines_are_told_with_file_line_and_what_was_expected, ROWS(malformed));
    suite_add(suite, "limits", too_many_access_points_are_told);
    suite_add(suite, "path", files_are_read_by_their_path_or_told);
    return suite;
}
