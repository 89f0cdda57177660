/* SPDX-License-Identifier: MIT
 * The part of a device that is the same on all boards, with a tracker that only writes down. */
#include "device.h"

#include <string.h>

#include "board.h"
#include "near.h"
#include "suite.h"
#include "text.h"
#include "tracker.h"

/* ---- a board that keeps what is said ---------------------------------------------------- */

static char said[4096];
static size_t said_count;

void board_write(char byte)
{
    ck_assert_uint_lt(said_count, sizeof said - 1u);
    said[said_count++] = byte;
    said[said_count] = '\0';
}

static void forget(void)
{
    said_count = 0u;
    said[0] = '\0';
}

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

/* ---- frames ----------------------------------------------------------------------------- */

static wire_frame_t frame;

static void put(uint32_t number, int bytes)
{
    for (int i = 0; i < bytes; i++) {
        frame.payload[frame.count++] = (uint8_t)(number >> (8 * i));
    }
}

static void put_float(float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    put(bits, 4);
}

static void begin_frame(int kind)
{
    memset(&frame, 0, sizeof frame);
    frame.kind = (uint8_t)kind;
}

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

static void make_imu(uint32_t ticks, int count)
{
    begin_frame(WIRE_IMU);
    for (int i = 0; i < count; i++) {
        put(ticks + (uint32_t)i * 10000u, 4);
        for (int k = 1; k <= 6; k++) {
            put((uint32_t)(k % 2 == 0 ? k : -k), 2);
        }
    }
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

/* ---- text ------------------------------------------------------------------------------- */

static const struct {
    float value;
    uint32_t decimals;
    const char *text;
} fixed[] = {{0.0f, 3u, "0.000"},        {1.0f, 0u, "1"},
             {-1.25f, 2u, "-1.25"},      {0.0625f, 3u, "0.063"},
             {-0.0001f, 3u, "0.000"},    {12.5f, 6u, "12.500000"},
             {3.0e9f, 0u, "2147483520"}, {-3.0e9f, 3u, "-2147483.520"},
             {0.00095f, 3u, "0.001"}};

START_TEST(a_number_becomes_text)
{
    forget();
    text_fixed(fixed[_i].value, fixed[_i].decimals);
    ck_assert_str_eq(said, fixed[_i].text);
}
END_TEST

START_TEST(times_keep_their_sign_and_their_microseconds)
{
    forget();
    text_seconds(-1500000);
    text_write(" ");
    text_seconds(3600000001);
    text_write(" ");
    text_seconds(0);
    text_write(" ");
    text_whole(4294967295u);
    text_write(" ");
    text_hex(0xabcu);
    ck_assert_str_eq(said, "-1.500000 3600.000001 0.000000 4294967295 00000abc");
}
END_TEST

/* ---- wire ------------------------------------------------------------------------------- */

static size_t to_bytes(uint8_t *bytes)
{
    bytes[0] = (uint8_t)WIRE_MARK;
    bytes[1] = frame.kind;
    bytes[2] = frame.count;
    memcpy(bytes + 3, frame.payload, frame.count);
    bytes[3 + frame.count] = wire_check(&frame);
    return (size_t)frame.count + WIRE_FRAMING;
}

static uint32_t frames_in(wire_t *wire, const uint8_t *bytes, size_t count)
{
    uint32_t found = 0u;
    for (size_t i = 0u; i < count; i++) {
        found += wire_push(wire, bytes[i]) ? 1u : 0u;
    }
    return found;
}

START_TEST(a_frame_comes_through_noise)
{
    uint8_t bytes[WIRE_ROOM + WIRE_FRAMING];
    const uint8_t noise[5] = {0u, 1u, 0xffu, 0x5au, 7u};
    wire_t wire = {.got = 0u};
    make_imu(3u, 2);
    size_t count = to_bytes(bytes);
    ck_assert_uint_eq(frames_in(&wire, noise, sizeof noise), 0u);
    ck_assert_uint_eq(frames_in(&wire, bytes, count), 1u);
    ck_assert_mem_eq(wire.frame.payload, frame.payload, frame.count);
    ck_assert_uint_eq(wire.bad, 0u);
}
END_TEST

START_TEST(no_changed_byte_goes_unnoticed)
{
    uint8_t bytes[WIRE_ROOM + WIRE_FRAMING], padding[WIRE_ROOM + WIRE_FRAMING] = {0};
    make_imu(3u, 2);
    size_t count = to_bytes(bytes);
    for (size_t i = 0u; i < count; i++) {
        wire_t wire = {.got = 0u};
        bytes[i] ^= 0x10u;
        ck_assert_uint_eq(frames_in(&wire, bytes, count), 0u);
        (void)frames_in(&wire, padding, sizeof padding);
        ck_assert_uint_eq(wire.bad, i == 0u ? 0u : 1u);
        bytes[i] ^= 0x10u;
        ck_assert_uint_eq(frames_in(&wire, bytes, count), 1u);
    }
}
END_TEST

START_TEST(more_than_a_payload_holds_is_no_frame)
{
    const uint8_t bytes[3] = {WIRE_MARK, WIRE_IMU, WIRE_ROOM + 1};
    wire_t wire = {.got = 0u};
    ck_assert_uint_eq(frames_in(&wire, bytes, sizeof bytes), 0u);
    ck_assert_uint_eq(wire.bad, 1u);
    ck_assert_uint_eq(wire.got, 0u);
}
END_TEST

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
    suite_add_loop(suite, "a number becomes text", a_number_becomes_text,
                   (int)(sizeof fixed / sizeof fixed[0]));
    suite_add(suite, "times", times_keep_their_sign_and_their_microseconds);
    suite_add(suite, "noise", a_frame_comes_through_noise);
    suite_add(suite, "changed bytes", no_changed_byte_goes_unnoticed);
    suite_add(suite, "too long", more_than_a_payload_holds_is_no_frame);
    suite_add(suite, "readings", readings_have_their_scale_and_their_time);
    suite_add(suite, "radio and places", radio_and_places_arrive_whole);
    suite_add(suite, "rows", a_row_comes_for_every_so_many_fixes);
    suite_add(suite, "left out", what_does_not_belong_is_left_out);
    suite_add(suite, "heads", without_a_right_head_there_is_no_walk);
    suite_add(suite, "a reset", a_walk_goes_on_after_a_reset);
    suite_add(suite, "used once", what_has_survived_is_used_once_and_by_its_own_image);
    return suite;
}
