/* SPDX-License-Identifier: MIT
 * The part of a device that is the same on all boards, with a tracker that only writes down. */
#include "device.h"

#include <string.h>

#include "frames.h"
#include "near.h"
#include "said.h"
#include "suite.h"
#include "tracker.h"

/* ---- a tracker that writes down --------------------------------------------------------- */

static struct {
    uint32_t seed, begun, imus, mags, starts, scans, ranges, slices, finishes;
    bool refuses, has_fix;
    insole_imu_t imu;
    insole_mag_t mag;
    insole_start_t start;
    insole_rss_t readings[WIRE_RSS_MOST];
    uint32_t reading_count;
    insole_range_t range[WIRE_RANGE_MOST];
    uint32_t range_count;
    uint64_t scan_us;
} told;

const uint8_t tracker_name = WIRE_FOOT;

bool tracker_begin(uint32_t seed)
{
    told.seed = seed;
    told.begun++;
    return !told.refuses;
}

void tracker_imu(const insole_imu_t *imu)
{
    told.imu = *imu;
    told.imus++;
    told.has_fix = true;
}

void tracker_mag(const insole_mag_t *mag)
{
    told.mag = *mag;
    told.mags++;
}

void tracker_start(const insole_start_t *start)
{
    told.start = *start;
    told.starts++;
}

void tracker_scan(uint64_t t_us, insole_rss_t *readings, uint32_t count)
{
    told.scan_us = t_us;
    told.reading_count = count;
    memcpy(told.readings, readings, count * sizeof *readings);
    told.scans++;
}

void tracker_ranges(const insole_range_t *ranges, uint32_t count)
{
    told.range_count = count;
    memcpy(told.range, ranges, count * sizeof *ranges);
    told.ranges++;
}

bool tracker_next(insole_fix_t *fix)
{
    bool has_fix = told.has_fix;
    memset(fix, 0, sizeof *fix);
    fix->t_us = told.imu.t_us;
    fix->position_m = told.imu.accel_mps2;
    fix->state = INSOLE_FIX_TRACK;
    told.has_fix = false;
    return has_fix;
}

bool tracker_work(void)
{
    told.slices++;
    return false;
}

void tracker_finish(void)
{
    told.finishes++;
}

void *tracker_state(size_t *size)
{
    *size = sizeof told;
    return &told;
}

/* ---- walks ------------------------------------------------------------------------------ */

static device_answer_t take(void)
{
    return device_take(&frame);
}

static void make_head(int tracker, uint32_t fixes_per_row)
{
    begin_frame(WIRE_HEAD);
    put(WIRE_VERSION, 1);
    put((uint32_t)tracker, 1);
    put(fixes_per_row, 2);
    put(2000000u, 4);
    put(UINT32_MAX, 4);
    put((uint32_t)-5000000, 4);
    put(UINT32_MAX, 4);
    put_float(0.5f);
    put_float(0.25f);
    put_float(2.0f);
    put(77u, 4);
}

static void begin_walk(uint32_t fixes_per_row)
{
    memset(&told, 0, sizeof told);
    forget();
    device_start(1u);
    make_head(WIRE_FOOT, fixes_per_row);
    ck_assert_int_eq(take(), DEVICE_GOES_ON);
    ck_assert_uint_eq(told.begun, 1u);
}

/* ---- device ----------------------------------------------------------------------------- */

START_TEST(readings_have_their_scale_and_their_time)
{
    begin_walk(1000u);
    make_imu(19999u, 2);
    ck_assert_int_eq(take(), DEVICE_GOES_ON);
    ck_assert_uint_eq(told.seed, 77u);
    ck_assert_uint_eq(told.imus, 2u);
    ck_assert_uint_eq(told.slices, 2u);
    ck_assert_uint_eq(told.imu.t_us, 15000u); /* the counter of 2 MHz has wrapped */
    ASSERT_NEAR(told.imu.accel_mps2.x, -0.5, 0.0, "m/s^2");
    ASSERT_NEAR(told.imu.accel_mps2.y, 1.0, 0.0, "m/s^2");
    ASSERT_NEAR(told.imu.gyro_radps.x, 1.0, 0.0, "rad/s");
    ASSERT_NEAR(told.imu.gyro_radps.y, -1.25, 0.0, "rad/s");
}
END_TEST

START_TEST(radio_and_places_arrive_whole)
{
    begin_walk(1000u);
    begin_frame(WIRE_SCAN);
    put(1u, 4);
    put(9u, 2);
    put((uint32_t)-70, 1);
    put(250u, 2);
    (void)take();
    ck_assert_uint_eq(told.reading_count, 1u);
    ck_assert_uint_eq(told.readings[0].id, 9u);
    ck_assert_uint_eq(told.readings[0].age_us, 250000u);
    ASSERT_NEAR(told.readings[0].rss_dbm, -70.0, 0.0, "dBm");
    begin_frame(WIRE_RANGES);
    put(3u, 4);
    put(4u, 2);
    put(12500u, 4);
    put(250u, 2);
    (void)take();
    ck_assert_uint_eq(told.range_count, 1u);
    ck_assert_uint_eq(told.range[0].t_us, 2u);
    ASSERT_NEAR(told.range[0].range_m, 12.5, 1e-6, "m");
    ASSERT_NEAR(told.range[0].sigma_m, 0.25, 1e-7, "m");
    begin_frame(WIRE_PLACE);
    put(5u, 4);
    put((uint32_t)-1500, 4);
    put(2000u, 4);
    put((uint32_t)WIRE_UNTOLD, 4);
    put(300u, 4);
    put(90000u, 4);
    (void)take();
    ASSERT_NEAR(told.start.x_m, -1.5, 1e-6, "m");
    ck_assert(!told.start.has_heading);
    ASSERT_NEAR(told.start.sigma_rad, 0.09, 1e-7, "rad");
    begin_frame(WIRE_MAG);
    put(7u, 4);
    for (int i = 0; i < 3; i++) {
        put((uint32_t)-20, 2);
    }
    (void)take();
    ASSERT_NEAR(told.mag.field_ut.z, -40.0, 0.0, "uT");
}
END_TEST

START_TEST(a_row_comes_for_every_so_many_fixes)
{
    begin_walk(2u);
    forget();
    make_imu(UINT32_MAX, 4);
    (void)take();
    ck_assert_int_eq(strncmp(said, "-4.995000,-0.500,1.000,-1.500,0.00000,", 38u), 0);
    const char *second = strchr(said, '\n') + 1;
    ck_assert_int_eq(strncmp(second, "-4.985000,", 10u), 0);
    ck_assert_ptr_eq(strchr(strchr(second, '\n') + 1, '\n'), NULL);
    forget();
    begin_frame(WIRE_END);
    ck_assert_int_eq(take(), DEVICE_ENDS);
    ck_assert_int_eq(device_end(3u, 44u), 0);
    ck_assert_uint_eq(told.finishes, 1u);
    ck_assert_ptr_nonnull(strstr(said, "# fixes 4 rows 2 crc "));
    ck_assert_ptr_nonnull(strstr(said, " bad 3 resets 0 stack 44\n"));
}
END_TEST

START_TEST(what_does_not_belong_is_left_out)
{
    begin_walk(1u);
    const int kinds[] = {WIRE_MAG, WIRE_SCAN, WIRE_RANGES, WIRE_PLACE, WIRE_HEAD, '?'};
    for (size_t i = 0u; i < sizeof kinds / sizeof kinds[0]; i++) {
        begin_frame(kinds[i]);
        put(0u, 3);
        ck_assert_int_eq(take(), DEVICE_GOES_ON);
    }
    ck_assert_uint_eq(told.mags + told.scans + told.ranges + told.starts, 0u);
    ck_assert_uint_eq(told.begun, 1u);
}
END_TEST

START_TEST(without_a_right_head_there_is_no_walk)
{
    const struct {
        int tracker;
        uint32_t fixes_per_row;
        bool refuses;
    } heads[] = {{WIRE_PHONE, 1u, false}, {WIRE_FOOT, 0u, false}, {WIRE_FOOT, 1u, true}};
    for (size_t i = 0u; i < sizeof heads / sizeof heads[0]; i++) {
        memset(&told, 0, sizeof told);
        device_start(1u);
        told.refuses = heads[i].refuses;
        forget();
        make_head(heads[i].tracker, heads[i].fixes_per_row);
        (void)take();
        make_imu(5u, 1);
        (void)take();
        ck_assert_uint_eq(told.imus, 0u);
        ck_assert_ptr_nonnull(strstr(said, "# the head is of another version"));
        ck_assert_int_eq(device_end(0u, 0u), 1);
        ck_assert_uint_eq(told.finishes, 0u);
    }
}
END_TEST

START_TEST(a_walk_goes_on_after_a_reset)
{
    begin_walk(1000u);
    make_imu(19999u, 2);
    (void)take();
    begin_frame(WIRE_RESET);
    ck_assert_int_eq(take(), DEVICE_RESETS);
    ck_assert(device_save());
    memset(&told, 0xa5, sizeof told);
    forget();
    device_start(1u);
    ck_assert_str_eq(said, "# goes on after a reset\n# ready\n");
    ck_assert_uint_eq(told.imus, 2u);
    make_imu(59999u, 1);
    (void)take();
    ck_assert_uint_eq(told.imus, 3u);
    ck_assert_uint_eq(told.imu.t_us, 30000u);
    forget();
    (void)device_end(0u, 0u);
    ck_assert_ptr_nonnull(strstr(said, "# fixes 3 "));
    ck_assert_ptr_nonnull(strstr(said, " resets 1 "));
}
END_TEST

START_TEST(what_has_survived_is_used_once_and_by_its_own_image)
{
    begin_walk(1000u);
    ck_assert(device_save());
    forget();
    device_start(2u);
    ck_assert_str_eq(said, "# ready\n");
    device_start(2u);
    ck_assert(device_save());
    device_start(2u);
    forget();
    device_start(2u);
    ck_assert_str_eq(said, "# ready\n");
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("device");
    suite_add(suite, "readings", readings_have_their_scale_and_their_time);
    suite_add(suite, "radio and places", radio_and_places_arrive_whole);
    suite_add(suite, "rows", a_row_comes_for_every_so_many_fixes);
    suite_add(suite, "left out", what_does_not_belong_is_left_out);
    suite_add(suite, "heads", without_a_right_head_there_is_no_walk);
    suite_add(suite, "a reset", a_walk_goes_on_after_a_reset);
    suite_add(suite, "used once", what_has_survived_is_used_once_and_by_its_own_image);
    return suite;
}
