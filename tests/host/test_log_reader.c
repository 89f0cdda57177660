/* SPDX-License-Identifier: MIT */
#include "log_reader.h"

#include <math.h>

#include "files.h"
#include "near.h"
#include "suite.h"

static id_table_t ids;
static log_reader_t reader;
static failure_t failure;

static void open_text(const char *text)
{
    id_table_init(&ids);
    memset(&failure, 0, sizeof failure);
    log_reader_attach(&reader, file_of(text), "log", &ids);
}

static void close_text(void)
{
    log_reader_close(&reader);
    id_table_free(&ids);
}

/* The record that must come next. */
static record_t next(void)
{
    record_t record;
    read_t answer = log_reader_next(&reader, &record, &failure);
    ck_assert_msg(answer == READ_ONE, "expected a record: %s", failure.text);
    return record;
}

static void expect_end(void)
{
    record_t record;
    ck_assert_msg(log_reader_next(&reader, &record, &failure) == READ_END, "%s", failure.text);
}

static void expect_values(const record_t *record, const double *values, int count)
{
    for (int i = 0; i < count; i++) {
        ck_assert_msg(record->value[i] == values[i], "value %d is %g, expected %g", i,
                      record->value[i], values[i]);
    }
    for (int i = count; i < RECORD_VALUES; i++) {
        ck_assert(isnan(record->value[i]));
    }
}

/* ---- records ---------------------------------------------------------------------------- */

START_TEST(every_kind_of_record_is_read)
{
    open_text("start,-0.5,1,2,0.5,0.3,0.09\n"
              "imu,0,1,2,3,4,5,6\n"
              "acc,0.1,1,2,3\n"
              "gyr,0.2,4,5,6\n"
              "mag,0.3,7,8,9\n"
              "rss,0.4,aa:bb,-70,1.5\n"
              "range,0.5,A1,3.25,0.1\n"
              "truth,0.6,1.5,2.5,0.5\n");
    const struct {
        record_kind_t kind;
        int64_t t_us;
        double value[6];
        int count;
    } expected[] = {{RECORD_START, -500000, {1, 2, 0.5, 0.3, 0.09}, 5},
                    {RECORD_IMU, 0, {1, 2, 3, 4, 5, 6}, 6},
                    {RECORD_ACC, 100000, {1, 2, 3}, 3},
                    {RECORD_GYR, 200000, {4, 5, 6}, 3},
                    {RECORD_MAG, 300000, {7, 8, 9}, 3},
                    {RECORD_RSS, 400000, {-70, 1.5}, 2},
                    {RECORD_RANGE, 500000, {3.25, 0.1}, 2},
                    {RECORD_TRUTH, 600000, {1.5, 2.5, 0.5}, 3}};
    for (size_t i = 0u; i < sizeof expected / sizeof expected[0]; i++) {
        record_t record = next();
        ck_assert_int_eq(record.kind, expected[i].kind);
        ck_assert_int_eq(record.t_us, expected[i].t_us);
        expect_values(&record, expected[i].value, expected[i].count);
    }
    expect_end();
    close_text();
}
END_TEST

START_TEST(what_is_optional_may_be_left_out_or_empty)
{
    open_text("start,0,1,2\nstart,0,1,2,\nstart,0,1,2,0.5\nstart,0,1,2,,0.5,\nrss,0,a,-70\n"
              "rss,0,a,-70,\nrange,0,a,3\ntruth,0,1,2\ntruth,0,1,2,\n");
    const double at[] = {1, 2}, facing[] = {1, 2, 0.5}, loud[] = {-70}, near[] = {3};
    for (int i = 0; i < 2; i++) {
        record_t start = next();
        expect_values(&start, at, 2);
    }
    record_t record = next();
    expect_values(&record, facing, 3);
    record = next();
    ck_assert(isnan(record.value[2]) && record.value[3] == 0.5 && isnan(record.value[4]));
    for (int i = 0; i < 2; i++) {
        record = next();
        expect_values(&record, loud, 1);
    }
    record = next();
    expect_values(&record, near, 1);
    for (int i = 0; i < 2; i++) {
        record = next();
        expect_values(&record, at, 2);
    }
    expect_end();
    close_text();
}
END_TEST

START_TEST(trouble_of_a_sensor_is_not_malformed)
{
    open_text("imu,0,nan,,3,inf,-nan,6\nacc,1,,,\nmag,2,nan,nan,nan\nrss,3,a,\nrange,4,a,nan\n");
    record_t imu = next();
    ck_assert(isnan(imu.value[0]) && isnan(imu.value[1]) && isnan(imu.value[3]) &&
              isnan(imu.value[4]));
    ck_assert(imu.value[2] == 3.0 && imu.value[5] == 6.0);
    for (int i = 0; i < 4; i++) {
        record_t record = next();
        ck_assert(isnan(record.value[0]));
    }
    expect_end();
    close_text();
}
END_TEST

START_TEST(ids_become_numbers_and_may_hold_anything_but_commas)
{
    open_text("rss,0,Cafe #1,-70\nrss,0,b c,-71 # far\nrange,0,Cafe #1,3\nrss,0,  b c ,-72\n");
    const uint32_t expected[] = {0u, 1u, 0u, 1u};
    for (int i = 0; i < 4; i++) {
        record_t record = next();
        ck_assert_uint_eq(record.id, expected[i]);
    }
    expect_end();
    ck_assert_uint_eq(ids.count, 2u);
    ck_assert_str_eq(ids.names[0], "Cafe #1");
    ck_assert_str_eq(ids.names[1], "b c");
    close_text();
}
END_TEST

START_TEST(many_ids_keep_their_numbers)
{
    char name[32];
    id_table_init(&ids);
    for (uint32_t i = 0u; i < 5000u; i++) {
        snprintf(name, sizeof name, "ap%u", i * 7919u);
        ck_assert_uint_eq(id_table_number(&ids, name), i);
    }
    for (uint32_t i = 0u; i < 5000u; i++) {
        snprintf(name, sizeof name, "ap%u", i * 7919u);
        ck_assert_uint_eq(id_table_number(&ids, name), i);
        ck_assert_str_eq(ids.names[i], name);
    }
    id_table_free(&ids);
}
END_TEST

/* ---- how files are made ----------------------------------------------------------------- */

START_TEST(blanks_comments_and_empty_lines_mean_nothing)
{
    open_text("# a log\n\n   \n\t# more\n  imu , 0 ,1,2,\t3,4,5,6  # first\nimu,1,1,2,3,4,5,6#end\n");
    const double values[] = {1, 2, 3, 4, 5, 6};
    for (int i = 0; i < 2; i++) {
        record_t record = next();
        ck_assert_int_eq(record.t_us, 1000000 * i);
        expect_values(&record, values, 6);
    }
    expect_end();
    close_text();
}
END_TEST

START_TEST(any_line_end_and_a_byte_order_mark_are_taken)
{
    open_text("\xEF\xBB\xBFimu,0,1,2,3,4,5,6\r\nimu,1,1,2,3,4,5,6\r\n\r\nimu,2,1,2,3,4,5,6");
    for (int i = 0; i < 3; i++) {
        record_t record = next();
        ck_assert_int_eq(record.t_us, 1000000 * i);
        ck_assert(record.value[5] == 6.0);
    }
    expect_end();
    close_text();
}
END_TEST

START_TEST(an_empty_file_has_no_records)
{
    open_text("");
    expect_end();
    expect_end();
    close_text();
}
END_TEST

/* ---- tables ----------------------------------------------------------------------------- */

START_TEST(a_table_may_have_its_columns_in_any_order)
{
    open_text("gz,note,Time,gy,GX,az,ay,ax\n6,hello,0.5,5,4,3,2,1\n");
    const double values[] = {1, 2, 3, 4, 5, 6};
    record_t record = next();
    ck_assert_int_eq(record.kind, RECORD_IMU);
    ck_assert_int_eq(record.t_us, 500000);
    expect_values(&record, values, 6);
    expect_end();
    close_text();
}
END_TEST

START_TEST(a_table_with_a_magnetometer_gives_two_records_a_row)
{
    open_text("t,ax,ay,az,gx,gy,gz,mx,my,mz\n0,1,2,3,4,5,6,7,8,9\n1,1,2,3,4,5,6,,nan,9\n");
    const double field[] = {7, 8, 9};
    ck_assert_int_eq(next().kind, RECORD_IMU);
    record_t mag = next();
    ck_assert_int_eq(mag.kind, RECORD_MAG);
    expect_values(&mag, field, 3);
    ck_assert_int_eq(next().kind, RECORD_IMU);
    mag = next();
    ck_assert(isnan(mag.value[0]) && isnan(mag.value[1]) && mag.value[2] == 9.0);
    ck_assert_int_eq(mag.t_us, 1000000);
    expect_end();
    close_text();
}
END_TEST

static const struct {
    const char *text;
    record_kind_t kind;
    double z;
} tables[] = {{"t,ax,ay,az\n0,1,2,3\n", RECORD_ACC, 3.0},
              {"t,gx,gy,gz\n0,1,2,3\n", RECORD_GYR, 3.0},
              {"t,mx,my,mz\n0,1,2,3\n", RECORD_MAG, 3.0},
              {"t,x,y,z\n0,1,2,3\n", RECORD_TRUTH, 3.0},
              {"t,x,y,z,heading,state\n0,1,2,3,0,track\n", RECORD_TRACK, 3.0},
              {"t,x,y,ax,ay,az # m/s^2\n0,8,9,1,2,3 # first\n", RECORD_ACC, 3.0}};

START_TEST(the_columns_tell_what_a_table_is)
{
    open_text(tables[_i].text);
    record_t record = next();
    ck_assert_int_eq(record.kind, tables[_i].kind);
    ck_assert(record.value[0] == 1.0 && record.value[1] == 2.0);
    ck_assert(record.value[2] == tables[_i].z);
    expect_end();
    close_text();
}
END_TEST

START_TEST(truth_without_height_has_none)
{
    open_text("t,x,y\n0,1,2\n");
    ck_assert(isnan(next().value[2]));
    close_text();
    open_text("t,x,y,z\n0,1,2,\n");
    ck_assert(isnan(next().value[2]));
    expect_end();
    close_text();
}
END_TEST

/* ---- malformed -------------------------------------------------------------------------- */

static const struct {
    const char *text, *message;
} malformed[] = {
    {"imu,0,1,2,3,4,5,6\nfoo,0\n",
     "log:2: unknown record \"foo\": expected imu, acc, gyr, mag, rss, range, start or truth"},
    {"0.0,1,2,3,4,5,6\n",
     "log:1: \"0.0\" begins neither a record nor a header: expected imu,t,ax,ay,az,gx,gy,gz or a "
     "header such as t,ax,ay,az,gx,gy,gz"},
    {"IMU,0,1,2,3,4,5,6\n",
     "log:1: \"IMU\" begins neither a record nor a header: expected imu,t,ax,ay,az,gx,gy,gz or a "
     "header such as t,ax,ay,az,gx,gy,gz"},
    {"imu,0,1,2,3,4,5\n", "log:1: too few fields: expected imu,t,ax,ay,az,gx,gy,gz"},
    {"imu\n", "log:1: too few fields: expected imu,t,ax,ay,az,gx,gy,gz"},
    {"# x\n\nimu,0,1,2,3,4,5,6,7\n", "log:3: too many fields: expected imu,t,ax,ay,az,gx,gy,gz"},
    {"imu,0,1,2,3,4,5,6,\n", "log:1: too many fields: expected imu,t,ax,ay,az,gx,gy,gz"},
    {"imu,0,1,2,3,4,5# cut\n", "log:1: too few fields: expected imu,t,ax,ay,az,gx,gy,gz"},
    {"imu,0,1,2,3,4,5x,6\n", "log:1: gy \"5x\" is not a number: expected imu,t,ax,ay,az,gx,gy,gz"},
    {"imu,0,1 2,2,3,4,5,6\n",
     "log:1: ax \"1 2\" is not a number: expected imu,t,ax,ay,az,gx,gy,gz"},
    {"imu,,1,2,3,4,5,6\n", "log:1: t \"\" is not a time: expected seconds such as 12.345678"},
    {"imu,nan,1,2,3,4,5,6\n", "log:1: t \"nan\" is not a time: expected seconds such as 12.345678"},
    {"imu,1e3,1,2,3,4,5,6\n", "log:1: t \"1e3\" is not a time: expected seconds such as 12.345678"},
    {"acc,0,1,2\n", "log:1: too few fields: expected acc,t,ax,ay,az"},
    {"gyr,0,1,2,3,4\n", "log:1: too many fields: expected gyr,t,gx,gy,gz"},
    {"mag,0,1,2,x\n", "log:1: mz \"x\" is not a number: expected mag,t,mx,my,mz"},
    {"rss,0,a\n", "log:1: too few fields: expected rss,t,id,dbm[,age]"},
    {"rss,0,,-70\n", "log:1: id is empty: expected rss,t,id,dbm[,age]"},
    {"rss,0,a,loud\n", "log:1: dbm \"loud\" is not a number: expected rss,t,id,dbm[,age]"},
    {"rss,0,a,-70,-1\n", "log:1: age must not be negative: expected rss,t,id,dbm[,age]"},
    {"rss,0,a,-70,nan\n", "log:1: age \"nan\" is not a number: expected rss,t,id,dbm[,age]"},
    {"rss,0,a,b,-70,1\n", "log:1: too many fields: expected rss,t,id,dbm[,age]"},
    {"range,0,a,3,-0.1\n", "log:1: sigma must not be negative: expected range,t,id,metres[,sigma]"},
    {"start,0,1\n", "log:1: too few fields: expected start,t,x,y[,heading[,sigma_m,sigma_rad]]"},
    {"start,0,nan,2\n",
     "log:1: x \"nan\" is not a number: expected start,t,x,y[,heading[,sigma_m,sigma_rad]]"},
    {"start,0,1,\n",
     "log:1: y \"\" is not a number: expected start,t,x,y[,heading[,sigma_m,sigma_rad]]"},
    {"start,0,1,2,3,4\n",
     "log:1: too few fields: expected start,t,x,y[,heading[,sigma_m,sigma_rad]]"},
    {"start,0,1,2,3,4,-5\n",
     "log:1: sigma_rad must not be negative: expected start,t,x,y[,heading[,sigma_m,sigma_rad]]"},
    {"truth,0,1,nan\n", "log:1: y \"nan\" is not a number: expected truth,t,x,y[,z]"},
    {"truth,0,1,2,3,4\n", "log:1: too many fields: expected truth,t,x,y[,z]"},
    {"t,ax,ay\n0,1,2\n", "log:1: header has no column az: expected ax,ay,az"},
    {"t,ax,ay,az,gy,gz\n", "log:1: header has no column gx: expected gx,gy,gz"},
    {"t,ax,ay,az,mx\n", "log:1: header has no column my: expected mx,my,mz"},
    {"t,x\n", "log:1: header has no column y: expected x,y"},
    {"t,a,b\n",
     "log:1: header names no known columns: expected t,ax,ay,az,gx,gy,gz or t,x,y"},
    {"t,ax,ay,az\n0,1,2\n", "log:2: row has 3 fields: expected 4 as in the header"},
    {"t,ax,ay,az\n0,1,2,3,4\n", "log:2: row has 5 fields: expected 4 as in the header"},
    {"t,ax,ay,az\n0,1,2,three\n", "log:2: az \"three\" is not a number"},
    {"t,ax,ay,az\nx,1,2,3\n", "log:2: t \"x\" is not a time: expected seconds such as 12.345678"},
    {"t,x,y\n0,1,nan\n", "log:2: y \"nan\" is not a number"},
    {"t,x,y,z\n0,1,2,up\n", "log:2: z \"up\" is not a number"},
    {"imu,0,\x1b[31m,2,3,4,5,6\n",
     "log:1: ax \"?[31m\" is not a number: expected imu,t,ax,ay,az,gx,gy,gz"},
};

START_TEST(malformed_lines_are_told_with_file_line_and_what_was_expected)
{
    record_t record;
    read_t answer;
    open_text(malformed[_i].text);
    while ((answer = log_reader_next(&reader, &record, &failure)) == READ_ONE) {
    }
    ck_assert_int_eq(answer, READ_FAILED);
    ck_assert_int_eq(failure.exit_code, EXIT_BAD_INPUT);
    ck_assert_str_eq(failure.text, malformed[_i].message);
    close_text();
}
END_TEST

START_TEST(a_nul_byte_is_refused)
{
    record_t record;
    id_table_init(&ids);
    log_reader_attach(&reader, file_of_bytes("imu,0,1\0,2,3", 12u), "log", &ids);
    ck_assert_int_eq(log_reader_next(&reader, &record, &failure), READ_FAILED);
    ck_assert_str_eq(failure.text, "log:1: NUL byte: expected plain text");
    close_text();
}
END_TEST

/* A line of `length` characters that is a comment after its record. */
static void open_long_line(size_t length)
{
    static char text[LINE_LIMIT + 16];
    memset(text, 'x', sizeof text);
    memcpy(text, "imu,0,1,2,3,4,5,6#", 18u);
    text[length] = '\n';
    text[length + 1u] = '\0';
    open_text(text);
}

START_TEST(an_overlong_line_is_refused)
{
    record_t record;
    open_long_line(LINE_LIMIT);
    ck_assert(next().value[5] == 6.0);
    expect_end();
    close_text();
    open_long_line(LINE_LIMIT + 1u);
    ck_assert_int_eq(log_reader_next(&reader, &record, &failure), READ_FAILED);
    ck_assert_str_eq(failure.text, "log:1: line is longer than 8191 characters");
    close_text();
}
END_TEST

START_TEST(more_columns_than_anybody_has_are_refused)
{
    static char text[3000] = "t";
    record_t record;
    for (int i = 0; i < FIELDS_MAX; i++) {
        strcat(text, ",a");
    }
    open_text(text);
    ck_assert_int_eq(log_reader_next(&reader, &record, &failure), READ_FAILED);
    ck_assert_str_eq(failure.text, "log:1: more than 512 columns");
    close_text();
}
END_TEST

START_TEST(files_that_cannot_be_read_are_told)
{
    id_table_init(&ids);
    ck_assert(!log_reader_open(&reader, scratch("absent.csv"), &ids, &failure));
    ck_assert_ptr_nonnull(strstr(failure.text, "absent.csv: cannot open: No such file"));
    log_reader_close(&reader);
    ck_assert(!log_reader_open(&reader, SCRATCH, &ids, &failure));
    ck_assert_str_eq(failure.text, SCRATCH ": is a folder: expected a file");
    log_reader_close(&reader);
    id_table_free(&ids);
}
END_TEST

#define ROWS(table) ((int)(sizeof table / sizeof table[0]))

Suite *insole_suite(void)
{
    Suite *suite = suite_create("log_reader");
    suite_add(suite, "records", every_kind_of_record_is_read);
    suite_add(suite, "optional", what_is_optional_may_be_left_out_or_empty);
    suite_add(suite, "sensor trouble", trouble_of_a_sensor_is_not_malformed);
    suite_add(suite, "ids", ids_become_numbers_and_may_hold_anything_but_commas);
    suite_add(suite, "many ids", many_ids_keep_their_numbers);
    suite_add(suite, "comments", blanks_comments_and_empty_lines_mean_nothing);
    suite_add(suite, "line ends", any_line_end_and_a_byte_order_mark_are_taken);
    suite_add(suite, "empty", an_empty_file_has_no_records);
    suite_add(suite, "column order", a_table_may_have_its_columns_in_any_order);
    suite_add(suite, "two records", a_table_with_a_magnetometer_gives_two_records_a_row);
    suite_add_loop(suite, "tables", the_columns_tell_what_a_table_is, ROWS(tables));
    suite_add(suite, "no height", truth_without_height_has_none);
    suite_add_loop(suite, "malformed",
                   malformed_lines_are_told_with_file_line_and_what_was_expected, ROWS(malformed));
    suite_add(suite, "NUL", a_nul_byte_is_refused);
    suite_add(suite, "long lines", an_overlong_line_is_refused);
    suite_add(suite, "columns", more_columns_than_anybody_has_are_refused);
    suite_add(suite, "unreadable", files_that_cannot_be_read_are_told);
    return suite;
}
