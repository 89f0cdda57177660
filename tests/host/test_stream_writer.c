/* SPDX-License-Identifier: MIT */
#include "stream_writer.h"

#include <math.h>
#include <string.h>

#include "near.h"
#include "suite.h"

enum { FRAMES_MOST = 64 };

static const stream_settings_t usual = {.tracker = TRACKER_FOOT,
                                        .seed = 7u,
                                        .fixes_per_row = 20u,
                                        .batch = 4u,
                                        .accel_full_mps2 = 163.84, /* 0.005 a count */
                                        .gyro_full_radps = 32.768, /* 0.001 a count */
                                        .field_full_ut = 4915.2};

static stream_writer_t writer;
static failure_t failure;
static wire_frame_t frames[FRAMES_MOST];
static size_t frame_count;

static void begin(const stream_settings_t *settings)
{
    stream_writer_init(&writer, settings);
}

static record_t record_of(record_kind_t kind, int64_t t_us, uint32_t id, const double *values,
                          size_t count)
{
    record_t record = {.kind = kind, .t_us = t_us, .id = id};
    for (size_t i = 0u; i < RECORD_VALUES; i++) {
        record.value[i] = i < count ? values[i] : (double)NAN;
    }
    return record;
}

static bool push(record_kind_t kind, int64_t t_us, uint32_t id, const double *values, size_t count)
{
    const record_t record = record_of(kind, t_us, id, values, count);
    return stream_writer_record(&writer, &record, &failure);
}

static void push_imu(int64_t t_us, double ax)
{
    const double values[6] = {ax, -1.0, 9.81, 0.25, -0.5, 1.0};
    ck_assert(push(RECORD_IMU, t_us, 0u, values, 6u));
}

static void push_rss(int64_t t_us, uint32_t id, double dbm, double age_s)
{
    const double values[2] = {dbm, age_s};
    ck_assert(push(RECORD_RSS, t_us, id, values, 2u));
}

/* Ends the stream and reads it back as a device would. */
static void read_back(void)
{
    wire_t wire = {.got = 0u};
    stream_writer_finish(&writer);
    frame_count = 0u;
    for (size_t i = 0u; i < writer.counts.bytes; i++) {
        if (wire_push(&wire, writer.bytes[i])) {
            ck_assert_uint_lt(frame_count, FRAMES_MOST);
            frames[frame_count++] = wire.frame;
        }
    }
    ck_assert_uint_eq(wire.bad, 0u);
    ck_assert_uint_eq(wire.got, 0u);
    ck_assert_uint_eq(frame_count, writer.counts.frames);
    stream_writer_free(&writer);
}

static void kinds_are(const char *kinds)
{
    char found[FRAMES_MOST + 1] = "";
    for (size_t i = 0u; i < frame_count; i++) {
        found[i] = (char)frames[i].kind;
    }
    ck_assert_str_eq(found, kinds);
}

static const uint8_t *payload(size_t frame)
{
    return frames[frame].payload;
}

START_TEST(the_head_tells_who_and_how)
{
    begin(&usual);
    push_imu(-2500000, 1.0);
    read_back();
    kinds_are("HIE");
    const uint8_t *head = payload(0u);
    ck_assert_uint_eq(frames[0].count, WIRE_HEAD_BYTES);
    ck_assert_uint_eq(head[0], WIRE_VERSION);
    ck_assert_uint_eq(head[1], WIRE_FOOT);
    ck_assert_uint_eq(wire_u16(head + 2), 20u);
    ck_assert_uint_eq(wire_u32(head + 4), 1000000u);
    ck_assert_int_eq(wire_i32(head + 12), -2500000);
    ck_assert_int_eq(wire_i32(head + 16), -1);
    ASSERT_NEAR(wire_float(head + 20), 0.005, 1e-9, "m/s^2");
    ASSERT_NEAR(wire_float(head + 24), 0.001, 1e-9, "rad/s");
    ASSERT_NEAR(wire_float(head + 28), 0.15, 1e-7, "uT");
    ck_assert_uint_eq(wire_u32(head + 32), 7u);
    ck_assert_uint_eq(wire_u32(payload(1u)), wire_u32(head + 8));
}
END_TEST

START_TEST(a_phone_is_told_apart)
{
    stream_settings_t settings = usual;
    settings.tracker = TRACKER_PHONE;
    begin(&settings);
    push_imu(0, 1.0);
    read_back();
    ck_assert_uint_eq(payload(0u)[1], WIRE_PHONE);
}
END_TEST

START_TEST(readings_are_rounded_to_the_nearest_count)
{
    const int16_t counts[6] = {-200, -200, 1962, 250, -500, 1000};
    begin(&usual);
    push_imu(0, -1.0024);
    read_back();
    for (int i = 0; i < 6; i++) {
        ck_assert_int_eq(wire_i16(payload(1u) + 4 + 2 * i), counts[i]);
    }
    ck_assert_uint_eq(writer.counts.clipped, 0u);
}
END_TEST

START_TEST(what_a_sensor_cannot_tell_is_clipped_and_counted)
{
    begin(&usual);
    push_imu(0, 500.0);
    push_imu(5000, -500.0);
    read_back();
    ck_assert_int_eq(wire_i16(payload(1u) + 4), INT16_MAX);
    ck_assert_int_eq(wire_i16(payload(1u) + WIRE_IMU_BYTES + 4), INT16_MIN);
    ck_assert_uint_eq(writer.counts.clipped, 2u);
}
END_TEST

START_TEST(readings_come_in_batches_that_nothing_overtakes)
{
    const double field[3] = {15.0, -30.0, 45.0};
    begin(&usual);
    for (int i = 0; i < 6; i++) {
        push_imu(i * 5000, 1.0);
    }
    ck_assert(push(RECORD_MAG, 25000, 0u, field, 3u));
    push_imu(30000, 1.0);
    read_back();
    kinds_are("HIIMIE");
    ck_assert_uint_eq(frames[1].count, 4 * WIRE_IMU_BYTES);
    ck_assert_uint_eq(frames[2].count, 2 * WIRE_IMU_BYTES);
    ck_assert_int_eq(wire_i16(payload(3u) + 4), 100);
    ck_assert_int_eq(wire_i16(payload(3u) + 6), -200);
    ck_assert_int_eq(wire_i16(payload(3u) + 8), 300);
}
END_TEST

START_TEST(the_counter_wraps_ten_seconds_in)
{
    begin(&usual);
    push_imu(0, 1.0);
    push_imu(9999999, 1.0);
    push_imu(10000000, 1.0);
    read_back();
    ck_assert_uint_eq(wire_u32(payload(1u) + WIRE_IMU_BYTES), UINT32_MAX);
    ck_assert_uint_eq(wire_u32(payload(1u) + 2 * WIRE_IMU_BYTES), 0u);
}
END_TEST

START_TEST(a_scan_is_one_frame_with_whole_ages)
{
    begin(&usual);
    push_imu(0, 1.0);
    push_rss(1000, 3u, -60.4, 0.25);
    push_rss(1000, 300u, -81.0, 0.0125);
    push_imu(5000, 1.0);
    read_back();
    kinds_are("HISIE");
    const uint8_t *scan = payload(2u);
    ck_assert_uint_eq(frames[2].count, WIRE_TICKS_BYTES + 2 * WIRE_RSS_BYTES);
    ck_assert_uint_eq(wire_u32(scan), STREAM_FIRST_TICKS + 1000u);
    ck_assert_uint_eq(wire_u16(scan + 4), 3u);
    ck_assert_int_eq((int8_t)scan[6], -60);
    ck_assert_uint_eq(wire_u16(scan + 7), 250u);
    ck_assert_uint_eq(wire_u16(scan + 9), 300u);
    ck_assert_int_eq((int8_t)scan[11], -81);
    ck_assert_uint_eq(wire_u16(scan + 12), 13u);
}
END_TEST

START_TEST(of_a_long_scan_the_strongest_are_told)
{
    begin(&usual);
    push_imu(0, 1.0);
    for (uint32_t i = 0u; i < WIRE_RSS_MOST + 10u; i++) {
        push_rss(1000, i, -90.0 + (double)i, 0.0);
    }
    read_back();
    uint32_t weakest = UINT32_MAX;
    for (int i = 0; i < WIRE_RSS_MOST; i++) {
        uint32_t id = wire_u16(payload(2u) + WIRE_TICKS_BYTES + i * WIRE_RSS_BYTES);
        weakest = id < weakest ? id : weakest;
    }
    ck_assert_uint_eq(weakest, 10u);
}
END_TEST

START_TEST(ranges_come_in_millimetres)
{
    const double told[2] = {12.3456, 0.5}, untold[1] = {7.0};
    begin(&usual);
    ck_assert(push(RECORD_RANGE, 0, 5u, told, 2u));
    ck_assert(push(RECORD_RANGE, 0, 6u, untold, 1u));
    push_imu(1000, 1.0);
    read_back();
    kinds_are("HRIE");
    ck_assert_uint_eq(wire_u16(payload(1u) + 4), 5u);
    ck_assert_uint_eq(wire_u32(payload(1u) + 6), 12346u);
    ck_assert_uint_eq(wire_u16(payload(1u) + 10), 500u);
    ck_assert_uint_eq(wire_u16(payload(1u) + 12), 6u);
    ck_assert_uint_eq(wire_u16(payload(1u) + 18), 0u);
    ck_assert_uint_eq(writer.counts.ranges, 2u);
}
END_TEST

START_TEST(a_place_may_lack_its_heading)
{
    const double all[5] = {-1.5, 2.25, 0.5, 0.1, 0.02}, place[2] = {3.0, 4.0};
    begin(&usual);
    ck_assert(push(RECORD_START, 0, 0u, all, 5u));
    ck_assert(push(RECORD_START, 0, 0u, place, 2u));
    read_back();
    kinds_are("HPPE");
    const int32_t whole[5] = {-1500, 2250, 500000, 100, 20000};
    for (int i = 0; i < 5; i++) {
        ck_assert_int_eq(wire_i32(payload(1u) + 4 + 4 * i), whole[i]);
    }
    ck_assert_int_eq(wire_i32(payload(2u) + 12), WIRE_UNTOLD);
    ck_assert_int_eq(wire_i32(payload(2u) + 16), 300);
    ck_assert_int_eq(wire_i32(payload(2u) + 20), 90000);
}
END_TEST

START_TEST(what_is_no_number_or_no_sensor_is_left_out)
{
    const double blank[6] = {1.0, (double)NAN, 9.8, 0.0, 0.0, 0.0}, truth[2] = {1.0, 2.0};
    begin(&usual);
    push_imu(0, 1.0);
    ck_assert(push(RECORD_IMU, 5000, 0u, blank, 6u));
    ck_assert(push(RECORD_TRUTH, 5000, 0u, truth, 2u));
    read_back();
    kinds_are("HIE");
    ck_assert_uint_eq(frames[1].count, WIRE_IMU_BYTES);
    ck_assert_uint_eq(writer.counts.blank, 1u);
}
END_TEST

START_TEST(time_that_goes_back_is_held)
{
    begin(&usual);
    push_imu(10000, 1.0);
    push_imu(5000, 1.0);
    push_imu(15000, 1.0);
    read_back();
    ck_assert_uint_eq(wire_u32(payload(1u) + WIRE_IMU_BYTES), STREAM_FIRST_TICKS);
    ck_assert_uint_eq(wire_u32(payload(1u) + 2 * WIRE_IMU_BYTES), STREAM_FIRST_TICKS + 5000u);
    ck_assert_uint_eq(writer.counts.back, 1u);
}
END_TEST

START_TEST(a_gap_in_which_the_counter_would_wrap_is_refused)
{
    const double values[6] = {1.0, 1.0, 1.0, 1.0, 1.0, 1.0};
    begin(&usual);
    push_imu(0, 1.0);
    push_imu((int64_t)UINT32_MAX, 1.0);
    ck_assert(!push(RECORD_IMU, 2 * (int64_t)UINT32_MAX + 1, 0u, values, 6u));
    ck_assert_ptr_nonnull(strstr(failure.text, "would wrap unseen"));
    read_back();
}
END_TEST

START_TEST(a_reset_comes_once_at_its_time)
{
    stream_settings_t settings = usual;
    settings.has_reset = true;
    settings.reset_us = 7000;
    begin(&settings);
    for (int i = 0; i < 4; i++) {
        push_imu(i * 5000, 1.0);
    }
    read_back();
    kinds_are("HIZIE");
    ck_assert_uint_eq(frames[1].count, 2 * WIRE_IMU_BYTES);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("stream_writer");
    suite_add(suite, "the head tells who and how", the_head_tells_who_and_how);
    suite_add(suite, "a phone is told apart", a_phone_is_told_apart);
    suite_add(suite, "readings are rounded", readings_are_rounded_to_the_nearest_count);
    suite_add(suite, "clipped", what_a_sensor_cannot_tell_is_clipped_and_counted);
    suite_add(suite, "batches", readings_come_in_batches_that_nothing_overtakes);
    suite_add(suite, "the counter wraps", the_counter_wraps_ten_seconds_in);
    suite_add(suite, "a scan is one frame", a_scan_is_one_frame_with_whole_ages);
    suite_add(suite, "a long scan", of_a_long_scan_the_strongest_are_told);
    suite_add(suite, "ranges", ranges_come_in_millimetres);
    suite_add(suite, "a place", a_place_may_lack_its_heading);
    suite_add(suite, "left out", what_is_no_number_or_no_sensor_is_left_out);
    suite_add(suite, "time goes back", time_that_goes_back_is_held);
    suite_add(suite, "a long gap", a_gap_in_which_the_counter_would_wrap_is_refused);
    suite_add(suite, "a reset", a_reset_comes_once_at_its_time);
    return suite;
}
