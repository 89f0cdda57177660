/* SPDX-License-Identifier: MIT */
#include "ap_file.h"

#include "files.h"
#include "near.h"
#include "suite.h"

static ap_file_t aps;
static failure_t failure;

static bool take(const char *text)
{
    memset(&failure, 0, sizeof failure);
    return ap_file_take(&aps, file_of(text), "aps", &insole_propagation_defaults, &failure);
}

static void read_text(const char *text)
{
    bool is_good = take(text);
    ck_assert_msg(is_good, "%s", failure.text);
}

static void expect_ap(const insole_ap_t *ap, const insole_ap_t *expected)
{
    ASSERT_NEAR(ap->x_m, expected->x_m, 1e-5, "m");
    ASSERT_NEAR(ap->y_m, expected->y_m, 1e-5, "m");
    ASSERT_NEAR(ap->z_m, expected->z_m, 1e-5, "m");
    ASSERT_NEAR(ap->p0_dbm, expected->p0_dbm, 1e-4, "dBm");
    ASSERT_NEAR(ap->exponent, expected->exponent, 1e-5, "");
    ASSERT_NEAR(ap->near_dbm, expected->near_dbm, 1e-4, "dBm");
}

START_TEST(every_column_is_read)
{
    const insole_ap_t first = {INSOLE_R(1.5),   INSOLE_R(-2.0), INSOLE_R(2.6),
                               INSOLE_R(-38.0), INSOLE_R(2.1),  INSOLE_R(-42.0)};
    const insole_ap_t second = {INSOLE_R(100.0), INSOLE_R(0.25), INSOLE_R(0.0),
                                INSOLE_R(-40.5), INSOLE_R(3.0),  INSOLE_R(-45.0)};
    read_text("# two\nid,x,y,z,p0_dbm,exponent,near_dbm\n"
              "02:1b:00:00:00:01,1.5,-2,2.6,-38,2.1,-42   # hall\n\nb,100,.25,0,-40.5,3,-45\n");
    ck_assert_uint_eq(aps.count, 2u);
    expect_ap(&aps.aps[0], &first);
    expect_ap(&aps.aps[1], &second);
    ck_assert_str_eq(aps.ids.names[0], "02:1b:00:00:00:01");
    ck_assert_str_eq(aps.ids.names[1], "b");
    ck_assert_uint_eq(aps.lines[0], 3u);
    ck_assert_uint_eq(aps.lines[1], 5u);
    ap_file_free(&aps);
}
END_TEST

START_TEST(columns_come_in_any_order)
{
    const insole_ap_t expected = {INSOLE_R(1.0),   INSOLE_R(2.0), INSOLE_R(3.0),
                                  INSOLE_R(-38.0), INSOLE_R(2.5), INSOLE_R(-42.0)};
    read_text("near_dbm,y,exponent,id,p0_dbm,z,x\n-42,2,2.5,a b#1,-38,3,1\n");
    expect_ap(&aps.aps[0], &expected);
    ck_assert_str_eq(aps.ids.names[0], "a b#1");
    ap_file_free(&aps);
}
END_TEST

/* What is heard 1.5 m away, with half the body in the way, as told by [TwoOrder (10)]. */
static double near_dbm(double p0_dbm, double exponent)
{
    const insole_propagation_config_t *config = &insole_propagation_defaults;
    return p0_dbm - 10.0 * exponent * log10(1.5) - (double)config->multipath_db -
           0.5 * (double)config->body_db;
}

START_TEST(what_is_left_out_is_what_the_settings_tell)
{
    insole_ap_t bare, full;
    insole_propagation_ap(&insole_propagation_defaults, 1, 2, (insole_real_t)AP_FILE_HEIGHT_M,
                          &bare);
    read_text("id,x,y\na,1,2\n");
    expect_ap(&aps.aps[0], &bare);
    ASSERT_NEAR(aps.aps[0].near_dbm, near_dbm(-38.0, 2.0), 1e-4, "dBm");
    ap_file_free(&aps);
    read_text("id,x,y,z,p0_dbm,exponent,near_dbm\na,1,2,,,,\nb,1,2,4,-50,3,\nc,1,2,,,,-60\n");
    expect_ap(&aps.aps[0], &bare);
    full = bare;
    full.z_m = 4;
    full.p0_dbm = -50;
    full.exponent = 3;
    full.near_dbm = (insole_real_t)near_dbm(-50.0, 3.0);
    expect_ap(&aps.aps[1], &full);
    full = bare;
    full.near_dbm = -60;
    expect_ap(&aps.aps[2], &full);
    ap_file_free(&aps);
}
END_TEST

START_TEST(ids_of_a_log_lead_to_access_points_by_name)
{
    id_table_t ids;
    read_text("id,x,y\na,1,2\nb,3,4\nc,5,6\n");
    id_table_init(&ids);
    id_table_number(&ids, "c");
    id_table_number(&ids, "stranger");
    id_table_number(&ids, "a");
    ck_assert_uint_eq(ap_file_number(&aps, &ids, 0u), 2u);
    ck_assert_uint_eq(ap_file_number(&aps, &ids, 1u), AP_FILE_UNKNOWN);
    ck_assert_uint_eq(ap_file_number(&aps, &ids, 2u), 0u);
    ck_assert_uint_eq(ap_file_number(&aps, &ids, 3u), AP_FILE_UNKNOWN);
    ck_assert_uint_eq(ids.count, 3u);
    ck_assert_uint_eq(aps.ids.count, 3u);
    id_table_free(&ids);
    ap_file_free(&aps);
}
END_TEST

START_TEST(no_access_points_know_no_ids)
{
    id_table_t ids;
    memset(&aps, 0, sizeof aps);
    id_table_init(&ids);
    id_table_number(&ids, "a");
    ck_assert_uint_eq(ap_file_number(&aps, &ids, 0u), AP_FILE_UNKNOWN);
    id_table_free(&ids);
}
END_TEST

START_TEST(many_access_points_are_found)
{
    static char text[40000];
    id_table_t ids;
    size_t length = (size_t)sprintf(text, "id,x,y\n");
    id_table_init(&ids);
    for (int i = 0; i < 1000; i++) {
        length += (size_t)sprintf(text + length, "ap-%d,%d,%d\n", i, i, 2 * i);
    }
    read_text(text);
    worst_t right = {0.0, 0.0};
    for (int i = 999; i >= 0; i--) {
        sprintf(text, "ap-%d", i);
        uint32_t number = ap_file_number(&aps, &ids, id_table_number(&ids, text));
        worst_require(&right, number == (uint32_t)i && aps.aps[number].x_m == (insole_real_t)i, i);
    }
    ASSERT_ALL_HELD(right);
    id_table_free(&ids);
    ap_file_free(&aps);
}
END_TEST

/* ---- malformed -------------------------------------------------------------------------- */

#define ID_63 "123456789012345678901234567890123456789012345678901234567890123"

static const struct {
    const char *text, *message;
} malformed[] = {
    {"", "aps: no access points: expected a header, id,x,y,z,p0_dbm,exponent,near_dbm, and at "
         "least one row"},
    {"id,x,y\n# none\n", "aps: no access points: expected a header, "
                         "id,x,y,z,p0_dbm,exponent,near_dbm, and at least one row"},
    {"a,1,2\n", "aps:1: unknown column \"a\": expected some of id,x,y,z,p0_dbm,exponent,near_dbm"},
    {"id,x,y,exponet\n", "aps:1: unknown column \"exponet\": expected some of "
                         "id,x,y,z,p0_dbm,exponent,near_dbm (exponent?)"},
    {"id,x,y,\n", "aps:1: unknown column \"\": expected some of id,x,y,z,p0_dbm,exponent,near_dbm"},
    {"id,x,y,x\n", "aps:1: column x comes twice: expected each once"},
    {"x,y,z\n", "aps:1: header has no column id: expected id,x,y,z,p0_dbm,exponent,near_dbm, of "
                "which id,x,y must be there"},
    {"id,y\n", "aps:1: header has no column x: expected id,x,y,z,p0_dbm,exponent,near_dbm, of "
               "which id,x,y must be there"},
    {"id,x # y\n", "aps:1: header has no column y: expected id,x,y,z,p0_dbm,exponent,near_dbm, of "
                   "which id,x,y must be there"},
    {"id,x,y\na,1\n", "aps:2: row has 2 fields: expected 3 as in the header"},
    {"id,x,y\na,1,2,3\n", "aps:2: row has 4 fields: expected 3 as in the header"},
    {"id,x,y\na,1,2# east\nb,1 # 2\n", "aps:3: row has 2 fields: expected 3 as in the header"},
    {"id,x,y\n,1,2\n", "aps:2: id of 0 characters: expected 1 to 63"},
    {"id,x,y\n" ID_63 "4,1,2\n", "aps:2: id of 64 characters: expected 1 to 63"},
    {"id,x,y\na,1,2\n\nb,1,2\na,3,4\n", "aps:5: id \"a\" comes twice: it is that of line 2"},
    {"id,x,y\na,east,2\n", "aps:2: x \"east\" is not a number"},
    {"id,x,y\na,,2\n", "aps:2: x \"\" is not a number"},
    {"id,x,y\na,1,nan\n", "aps:2: y \"nan\" is not a number"},
    {"id,x,y\na,1,2m\n", "aps:2: y \"2m\" is not a number"},
    {"id,x,y,z\na,1,2,up\n", "aps:2: z \"up\" is not a number"},
    {"id,x,y\na,100001,2\n", "aps:2: x 100001 is out of range: expected -100000 to 100000"},
    {"id,x,y,z\na,1,2,-1e5\n", "aps:2: z -1e5 is out of range: expected -10000 to 10000"},
    {"id,x,y,p0_dbm\na,1,2,51\n", "aps:2: p0_dbm 51 is out of range: expected -150 to 50"},
    {"id,x,y,exponent\na,1,2,0\n", "aps:2: exponent 0 is out of range: expected 0.5 to 10"},
    {"id,x,y,near_dbm\na,1,2,-200\n", "aps:2: near_dbm -200 is out of range: expected -150 to 50"},
    {"id,x,y\n\x1b[2J,1\n", "aps:2: row has 2 fields: expected 3 as in the header"},
};

START_TEST(malformed_lines_are_told_with_file_line_and_what_was_expected)
{
    ck_assert(!take(malformed[_i].text));
    ck_assert_int_eq(failure.exit_code, EXIT_BAD_INPUT);
    ck_assert_str_eq(failure.text, malformed[_i].message);
    ck_assert_ptr_null(aps.aps);
    ck_assert_ptr_null(aps.lines);
    ck_assert_ptr_null(aps.ids.names);
    ck_assert_ptr_null(aps.name);
}
END_TEST

START_TEST(the_longest_id_is_taken)
{
    read_text("id,x,y\n" ID_63 ",1,2\n");
    ck_assert_str_eq(aps.ids.names[0], ID_63);
    ap_file_free(&aps);
}
END_TEST

START_TEST(files_are_read_by_their_path_or_told)
{
    const char *path = scratch_file("aps.csv", "\xEF\xBB\xBFid,x,y\r\na,1,2\r\n");
    ck_assert(ap_file_read(&aps, path, &insole_propagation_defaults, &failure));
    ck_assert_uint_eq(aps.count, 1u);
    ap_file_free(&aps);
    ck_assert(!ap_file_read(&aps, scratch("absent.csv"), &insole_propagation_defaults, &failure));
    ck_assert_ptr_nonnull(strstr(failure.text, "absent.csv: cannot open: No such file"));
    ck_assert(!ap_file_read(&aps, SCRATCH, &insole_propagation_defaults, &failure));
    ck_assert_str_eq(failure.text, SCRATCH ": is a folder: expected a file");
}
END_TEST

#define ROWS(table) ((int)(sizeof table / sizeof table[0]))

Suite *insole_suite(void)
{
    Suite *suite = suite_create("ap_file");
    suite_add(suite, "columns", every_column_is_read);
    suite_add(suite, "order", columns_come_in_any_order);
    suite_add(suite, "left out", what_is_left_out_is_what_the_settings_tell);
    suite_add(suite, "ids of a log", ids_of_a_log_lead_to_access_points_by_name);
    suite_add(suite, "no access points", no_access_points_know_no_ids);
    suite_add(suite, "many", many_access_points_are_found);
    suite_add_loop(suite, "malformed",
                   malformed_lines_are_told_with_file_line_and_what_was_expected, ROWS(malformed));
    suite_add(suite, "long id", the_longest_id_is_taken);
    suite_add(suite, "path", files_are_read_by_their_path_or_told);
    return suite;
}
