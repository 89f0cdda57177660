/* SPDX-License-Identifier: MIT */
#include "track_reader.h"
#include "track_writer.h"

#include <stdlib.h>

#include "event_writer.h"
#include "files.h"
#include "near.h"
#include "suite.h"

static failure_t failure;

static const track_row_t sample_row = {
    -1500000, 1.25, -0.00004, 0.12345, 3.14159265, 0.01, -0.0000012, 0.02, 1e-7, 0.5,
    INSOLE_FIX_COAST};

/* Writes rows to a file in the scratch folder. @return its path */
static const char *write_rows(const track_row_t *rows, int count, track_format_t format)
{
    const char *path = scratch("written");
    track_writer_t writer;
    ck_assert(track_writer_open(&writer, path, format, false, &failure));
    for (int i = 0; i < count; i++) {
        ck_assert(track_writer_row(&writer, &rows[i], &failure));
    }
    ck_assert(track_writer_close(&writer, &failure));
    return path;
}

START_TEST(csv_has_fixed_decimals)
{
    ck_assert_str_eq(content_of(write_rows(&sample_row, 1, TRACK_CSV)),
                     "t,x,y,z,heading,var_x,cov_xy,var_y,var_z,var_heading,state\n"
                     "-1.500000,1.2500,0.0000,0.1235,3.14159,0.010000,-0.000001,0.020000,0.000000,"
                     "0.500000,coast\n");
}
END_TEST

START_TEST(every_state_has_its_name)
{
    static const char *const names[] = {"align", "search", "track", "coast", "lost"};
    for (int i = 0; i < 5; i++) {
        ck_assert_str_eq(track_state_name((insole_fix_state_t)i), names[i]);
    }
}
END_TEST

START_TEST(tum_has_the_heading_as_a_quaternion)
{
    track_row_t row = sample_row;
    row.heading_rad = 2.0 * 0.52359877559829887; /* 60 degrees: half of it has sine 1/2 */
    ck_assert_str_eq(content_of(write_rows(&row, 1, TRACK_TUM)),
                     "-1.500000 1.2500 0.0000 0.1235 0.0000000 0.0000000 0.5000000 0.8660254\n");
}
END_TEST

START_TEST(geojson_is_one_line_of_all_places)
{
    track_row_t rows[2] = {sample_row, sample_row};
    rows[1].t_us = 0;
    rows[1].x_m = 2.0;
    ck_assert_str_eq(content_of(write_rows(rows, 2, TRACK_GEOJSON)),
                     "{\"type\":\"FeatureCollection\",\"features\":[{\"type\":\"Feature\",\n"
                     "\"properties\":{\"unit\":\"m\",\"t\":[-1.500000,0.000000]},\n"
                     "\"geometry\":{\"type\":\"LineString\",\"coordinates\":[\n"
                     "[1.2500,0.0000,0.1235],\n[2.0000,0.0000,0.1235]]}}]}\n");
    ck_assert_str_eq(content_of(write_rows(rows, 1, TRACK_GEOJSON)),
                     "{\"type\":\"FeatureCollection\",\"features\":[{\"type\":\"Feature\",\n"
                     "\"properties\":{\"unit\":\"m\",\"t\":[-1.500000]},\n\"geometry\":null}]}\n");
}
END_TEST

START_TEST(what_is_written_is_read_back)
{
    enum { ROWS = 200 };
    track_row_t rows[ROWS];
    track_t track;
    srand(7);
    for (int i = 0; i < ROWS; i++) {
        rows[i] = sample_row;
        rows[i].t_us = 1000 * i - 50000;
        rows[i].x_m = (rand() % 200001 - 100000) / 777.0;
        rows[i].y_m = (rand() % 200001 - 100000) / 777.0;
        rows[i].z_m = (rand() % 2001 - 1000) / 777.0;
    }
    memset(&track, 0, sizeof track);
    ck_assert(track_read(&track, write_rows(rows, ROWS, TRACK_CSV), &failure));
    ck_assert_uint_eq(track.count, ROWS);
    for (int i = 0; i < ROWS; i++) {
        ck_assert_int_eq(track.rows[i].t_us, rows[i].t_us);
        ASSERT_NEAR(track.rows[i].x_m, rows[i].x_m, 5.1e-5, "m");
        ASSERT_NEAR(track.rows[i].y_m, rows[i].y_m, 5.1e-5, "m");
        ASSERT_NEAR(track.rows[i].z_m, rows[i].z_m, 5.1e-5, "m");
    }
    track_free(&track);
}
END_TEST

START_TEST(nothing_is_written_without_a_path)
{
    track_writer_t writer;
    ck_assert(track_writer_open(&writer, NULL, TRACK_CSV, false, &failure));
    ck_assert(track_writer_row(&writer, &sample_row, &failure));
    ck_assert(track_writer_close(&writer, &failure));
}
END_TEST

START_TEST(files_that_cannot_be_written_are_told)
{
    track_writer_t writer;
    ck_assert(!track_writer_open(&writer, SCRATCH "/no/such/folder", TRACK_CSV, false, &failure));
    ck_assert_int_eq(failure.exit_code, EXIT_BAD_INPUT);
    ck_assert_ptr_nonnull(strstr(failure.text, "/no/such/folder: cannot write: "));
}
END_TEST

START_TEST(a_full_disk_is_told)
{
    track_writer_t writer;
    if (fopen("/dev/full", "wb") == NULL) {
        return; /* no such device here */
    }
    ck_assert(track_writer_open(&writer, "/dev/full", TRACK_CSV, true, &failure));
    ck_assert(!track_writer_row(&writer, &sample_row, &failure));
    ck_assert_str_eq(failure.text, "/dev/full: cannot write: No space left on device");
    track_writer_close(&writer, &failure);
    ck_assert(track_writer_open(&writer, "/dev/full", TRACK_TUM, false, &failure));
    ck_assert(track_writer_row(&writer, &sample_row, &failure));
    ck_assert(!track_writer_close(&writer, &failure));
}
END_TEST

START_TEST(formats_have_names)
{
    track_format_t format;
    ck_assert(track_format_parse("csv", &format, &failure) && format == TRACK_CSV);
    ck_assert(track_format_parse("tum", &format, &failure) && format == TRACK_TUM);
    ck_assert(track_format_parse("geojson", &format, &failure) && format == TRACK_GEOJSON);
    ck_assert(!track_format_parse("kml", &format, &failure));
    ck_assert_int_eq(failure.exit_code, EXIT_WRONG_USAGE);
    ck_assert_str_eq(failure.text, "insole: --format kml: expected csv, tum or geojson");
}
END_TEST

/* ---- reading ---------------------------------------------------------------------------- */

START_TEST(truth_records_are_read_among_others)
{
    track_t track;
    memset(&track, 0, sizeof track);
    ck_assert(track_read(&track, scratch_file("mixed", "imu,0,0,0,9,0,0,0\ntruth,0.5,1,2\n"
                                                       "rss,1,a,-70\ntruth,1.5,3,4,5\n"),
                         &failure));
    ck_assert_uint_eq(track.count, 2u);
    ck_assert_int_eq(track.rows[1].t_us, 1500000);
    ck_assert(track.rows[0].z_m != track.rows[0].z_m); /* not known */
    ASSERT_NEAR(track.rows[1].z_m, 5.0, 0.0, "m");
    track_free(&track);
}
END_TEST

static const struct {
    const char *text, *message;
} bad_tracks[] = {
    {"", "holds no place: expected a header such as t,x,y or lines truth,t,x,y[,z]"},
    {"imu,0,0,0,9,0,0,0\n",
     "holds no place: expected a header such as t,x,y or lines truth,t,x,y[,z]"},
    {"t,x,y\n1,0,0\n0.5,0,0\n", NULL}};

START_TEST(files_without_places_are_refused)
{
    char expected[700];
    track_t track;
    memset(&track, 0, sizeof track);
    ck_assert(!track_read(&track, scratch_file("bad", bad_tracks[_i].text), &failure));
    if (bad_tracks[_i].message == NULL) {
        ck_assert_str_eq(failure.text,
                         SCRATCH "/bad:3: time goes back: expected places in order of time");
    } else {
        snprintf(expected, sizeof expected, "%s/bad: %s", SCRATCH, bad_tracks[_i].message);
        ck_assert_str_eq(failure.text, expected);
    }
    track_free(&track);
}
END_TEST

START_TEST(events_are_written)
{
    const event_t stance = {0, 1500000, false, 0, 0, 0, 0, 0, 0, 0};
    const event_t stride = {1500000, 2400000, true, 1.25, -0.01, 0.5, -0.25, 1.3, -9, 20};
    FILE *file = tmpfile();
    event_writer_head(file);
    event_writer_row(file, &stance);
    event_writer_row(file, &stride);
    ck_assert_str_eq(text_of(file), "event,begin,end,length,height,heading,turn,model_length\n"
                                    "stance,0.000000,1.500000,,,,,\n"
                                    "stride,1.500000,2.400000,1.2500,-0.0100,0.50000,-0.25000,"
                                    "1.3000\n");
}
END_TEST

START_TEST(the_length_of_a_way_does_not_count_jitter)
{
    track_t track;
    memset(&track, 0, sizeof track);
    for (int i = 0; i <= 1000; i++) { /* 10 m along x, 1 cm a row, +-1 cm aside */
        track_row_t row = sample_row;
        row.x_m = 0.01 * i;
        row.y_m = i % 2 == 0 ? 0.01 : -0.01;
        track_add(&track, &row);
    }
    ASSERT_NEAR(track_length(&track, 0.25), 10.0, 0.05, "m");
    ck_assert(track_length(&track, 0.0) > 20.0);
    track_free(&track);
    ASSERT_NEAR(track_length(&track, 0.25), 0.0, 0.0, "m");
}
END_TEST

START_TEST(rows_are_put_in_order)
{
    track_t track;
    memset(&track, 0, sizeof track);
    track_sort(&track);
    for (int i = 0; i < 100; i++) {
        track_row_t row = sample_row;
        row.t_us = (i * 37) % 100;
        track_add(&track, &row);
    }
    track_sort(&track);
    for (int i = 0; i < 100; i++) {
        ck_assert_int_eq(track.rows[i].t_us, i);
    }
    track_free(&track);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("track_files");
    suite_add(suite, "csv", csv_has_fixed_decimals);
    suite_add(suite, "states", every_state_has_its_name);
    suite_add(suite, "tum", tum_has_the_heading_as_a_quaternion);
    suite_add(suite, "geojson", geojson_is_one_line_of_all_places);
    suite_add(suite, "round trip", what_is_written_is_read_back);
    suite_add(suite, "nothing", nothing_is_written_without_a_path);
    suite_add(suite, "unwritable", files_that_cannot_be_written_are_told);
    suite_add(suite, "full disk", a_full_disk_is_told);
    suite_add(suite, "formats", formats_have_names);
    suite_add(suite, "truth records", truth_records_are_read_among_others);
    suite_add_loop(suite, "no places", files_without_places_are_refused,
                   (int)(sizeof bad_tracks / sizeof bad_tracks[0]));
    suite_add(suite, "events", events_are_written);
    suite_add(suite, "length", the_length_of_a_way_does_not_count_jitter);
    suite_add(suite, "order", rows_are_put_in_order);
    return suite;
}
