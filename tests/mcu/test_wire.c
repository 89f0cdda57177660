/* SPDX-License-Identifier: MIT */
#include "wire.h"

#include "frames.h"
#include "suite.h"

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
Suite *insole_suite(void)
{
    Suite *suite = suite_create("wire");
    suite_add(suite, "noise", a_frame_comes_through_noise);
    suite_add(suite, "changed bytes", no_changed_byte_goes_unnoticed);
    suite_add(suite, "too long", more_than_a_payload_holds_is_no_frame);
    return suite;
}
