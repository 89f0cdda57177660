/* SPDX-License-Identifier: MIT */
#include "insole/base/snapshot.h"

#include <stdbool.h>
#include <string.h>

#include "insole/base/rng.h"
#include "near.h"
#include "suite.h"

enum { KIND = 0x1234abcd, STATE_BYTES = 37, HEADER = INSOLE_SNAPSHOT_HEADER_BYTES };
enum { SAVED_BYTES = STATE_BYTES + HEADER };

typedef struct {
    uint8_t state[STATE_BYTES];
    uint8_t saved[SAVED_BYTES];
} fixture_t;

static fixture_t saved_fixture(void)
{
    fixture_t f;
    insole_rng_t rng;
    size_t used = 0u;
    insole_rng_seed(&rng, 1u);
    for (int i = 0; i < STATE_BYTES; i++) {
        f.state[i] = (uint8_t)insole_rng_bits(&rng);
    }
    ck_assert_int_eq(
        insole_snapshot_save(KIND, f.state, STATE_BYTES, f.saved, sizeof f.saved, &used),
        INSOLE_OK);
    ck_assert_uint_eq(used, SAVED_BYTES);
    return f;
}

/* True when the load is refused with `expected` and the state keeps every bit. */
static bool refused(insole_status_t expected, uint32_t kind, size_t size, const void *buffer,
                    size_t count)
{
    uint8_t state[2 * STATE_BYTES], before[2 * STATE_BYTES];
    memset(state, 0x77, sizeof state);
    memcpy(before, state, sizeof state);
    return insole_snapshot_load(kind, state, size, buffer, count) == expected &&
           memcmp(before, state, sizeof state) == 0;
}

static uint32_t word_at(const uint8_t *at)
{
    return (uint32_t)at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24;
}

START_TEST(crc_has_its_published_check_value)
{
    ck_assert_uint_eq(insole_crc32(0u, "123456789", 9u), 0xcbf43926u);
    ck_assert_uint_eq(insole_crc32(0u, "", 0u), 0u);
    ck_assert_uint_eq(insole_crc32(0u, "a", 1u), 0xe8b7be43u);
    ck_assert_uint_eq(insole_crc32(5u, NULL, 9u), 5u);
}
END_TEST

/* One bit at a time, as the definition has it. */
static uint32_t crc_by_bits(const uint8_t *bytes, size_t count)
{
    uint32_t crc = 0xffffffffu;
    for (size_t i = 0; i < 8u * count; i++) {
        uint32_t bit = ((uint32_t)bytes[i / 8u] >> (i % 8u)) & 1u;
        crc = (crc >> 1) ^ (((crc ^ bit) & 1u) != 0u ? 0xedb88320u : 0u);
    }
    return ~crc;
}

START_TEST(crc_agrees_with_its_definition_and_chains)
{
    fixture_t f = saved_fixture();
    for (size_t count = 0u; count <= SAVED_BYTES; count++) {
        uint32_t whole = insole_crc32(0u, f.saved, count);
        ck_assert_uint_eq(whole, crc_by_bits(f.saved, count));
        uint32_t first = insole_crc32(0u, f.saved, count / 3u);
        ck_assert_uint_eq(insole_crc32(first, f.saved + count / 3u, count - count / 3u), whole);
    }
}
END_TEST

START_TEST(a_saved_state_comes_back)
{
    fixture_t f = saved_fixture();
    uint8_t loaded[STATE_BYTES];
    memset(loaded, 0, sizeof loaded);
    ck_assert_int_eq(insole_snapshot_load(KIND, loaded, STATE_BYTES, f.saved, SAVED_BYTES),
                     INSOLE_OK);
    ck_assert_int_eq(memcmp(loaded, f.state, STATE_BYTES), 0);
}
END_TEST

START_TEST(the_header_is_little_endian_on_every_machine)
{
    fixture_t f = saved_fixture();
    ck_assert_int_eq(memcmp(f.saved, "INSL", 4u), 0);
    ck_assert_uint_eq(word_at(f.saved + 4), KIND);
    ck_assert_uint_eq(word_at(f.saved + 8), INSOLE_SNAPSHOT_VERSION);
    ck_assert_uint_eq(word_at(f.saved + 12), STATE_BYTES);
    uint8_t covered[SAVED_BYTES - 4];
    memcpy(covered, f.saved, 16u);
    memcpy(covered + 16, f.saved + HEADER, STATE_BYTES);
    ck_assert_uint_eq(word_at(f.saved + 16), crc_by_bits(covered, sizeof covered));
    ck_assert_int_eq(memcmp(f.saved + HEADER, f.state, STATE_BYTES), 0);
}
END_TEST

/* Flash may be at any address and its page longer than the snapshot. */
START_TEST(any_address_and_bytes_behind_do_not_matter)
{
    fixture_t f = saved_fixture();
    uint8_t page[SAVED_BYTES + 16], loaded[STATE_BYTES];
    for (size_t shift = 0u; shift < 8u; shift++) {
        memset(page, 0xff, sizeof page);
        memset(loaded, 0, sizeof loaded);
        memcpy(page + shift, f.saved, SAVED_BYTES);
        ck_assert_int_eq(
            insole_snapshot_load(KIND, loaded, STATE_BYTES, page + shift, sizeof page - shift),
            INSOLE_OK);
        ck_assert_int_eq(memcmp(loaded, f.state, STATE_BYTES), 0);
    }
}
END_TEST

START_TEST(every_wrong_byte_is_noticed)
{
    fixture_t f = saved_fixture();
    worst_t noticed = {0.0, 0.0};
    for (int at = 0; at < SAVED_BYTES; at++) {
        for (int flip = 1; flip < 256; flip++) {
            f.saved[at] = (uint8_t)(f.saved[at] ^ flip);
            worst_require(&noticed,
                          refused(INSOLE_ERR_DATA, KIND, STATE_BYTES, f.saved, SAVED_BYTES), at);
            f.saved[at] = (uint8_t)(f.saved[at] ^ flip);
        }
    }
    ASSERT_ALL_HELD(noticed);
    ck_assert(!refused(INSOLE_ERR_DATA, KIND, STATE_BYTES, f.saved, SAVED_BYTES));
}
END_TEST

START_TEST(a_cut_snapshot_is_refused)
{
    fixture_t f = saved_fixture();
    for (size_t count = 0u; count < SAVED_BYTES; count++) {
        ck_assert(refused(INSOLE_ERR_DATA, KIND, STATE_BYTES, f.saved, count));
    }
}
END_TEST

START_TEST(another_kind_or_size_is_refused)
{
    fixture_t f = saved_fixture();
    ck_assert(refused(INSOLE_ERR_DATA, KIND + 1, STATE_BYTES, f.saved, SAVED_BYTES));
    ck_assert(refused(INSOLE_ERR_DATA, KIND, STATE_BYTES - 1, f.saved, SAVED_BYTES));
    ck_assert(refused(INSOLE_ERR_DATA, KIND, STATE_BYTES + 1, f.saved, SAVED_BYTES));
    ck_assert(refused(INSOLE_ERR_DATA, KIND, 0u, f.saved, SAVED_BYTES));
}
END_TEST

/* Whole, but of an older layout: its checksum is right. */
START_TEST(another_version_is_refused)
{
    fixture_t f = saved_fixture();
    f.saved[8]++;
    uint32_t crc = insole_crc32(insole_crc32(0u, f.saved, 16u), f.saved + HEADER, STATE_BYTES);
    for (int i = 0; i < 4; i++) {
        f.saved[16 + i] = (uint8_t)(crc >> (8 * i));
    }
    ck_assert(refused(INSOLE_ERR_DATA, KIND, STATE_BYTES, f.saved, SAVED_BYTES));
}
END_TEST

START_TEST(erased_and_zeroed_flash_is_refused)
{
    uint8_t page[SAVED_BYTES];
    memset(page, 0xff, sizeof page);
    ck_assert(refused(INSOLE_ERR_DATA, KIND, STATE_BYTES, page, sizeof page));
    memset(page, 0, sizeof page);
    ck_assert(refused(INSOLE_ERR_DATA, KIND, STATE_BYTES, page, sizeof page));
    ck_assert(refused(INSOLE_ERR_DATA, 0u, 0u, page, sizeof page));
}
END_TEST

START_TEST(too_little_room_is_refused_and_nothing_written)
{
    fixture_t f = saved_fixture();
    uint8_t buffer[SAVED_BYTES], before[SAVED_BYTES];
    memset(buffer, 0x77, sizeof buffer);
    memcpy(before, buffer, sizeof buffer);
    size_t used = 4711u;
    for (size_t room = 0u; room < SAVED_BYTES; room++) {
        ck_assert_int_eq(insole_snapshot_save(KIND, f.state, STATE_BYTES, buffer, room, &used),
                         INSOLE_ERR_ROOM);
    }
    ck_assert_int_eq(insole_snapshot_save(KIND, f.state, UINT32_MAX, buffer, SAVED_BYTES, &used),
                     INSOLE_ERR_ROOM);
    ck_assert_int_eq(memcmp(buffer, before, sizeof buffer), 0);
    ck_assert_uint_eq(used, 4711u);
}
END_TEST

START_TEST(null_is_refused)
{
    fixture_t f = saved_fixture();
    size_t used = 4711u;
    ck_assert_int_eq(insole_snapshot_save(KIND, NULL, STATE_BYTES, f.saved, SAVED_BYTES, &used),
                     INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_snapshot_save(KIND, f.state, STATE_BYTES, NULL, SAVED_BYTES, &used),
                     INSOLE_ERR_NULL);
    ck_assert_uint_eq(used, 4711u);
    ck_assert_int_eq(insole_snapshot_save(KIND, f.state, STATE_BYTES, f.saved, SAVED_BYTES, NULL),
                     INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_snapshot_load(KIND, NULL, STATE_BYTES, f.saved, SAVED_BYTES),
                     INSOLE_ERR_NULL);
    ck_assert(refused(INSOLE_ERR_NULL, KIND, STATE_BYTES, NULL, SAVED_BYTES));
}
END_TEST

/* The header counts bytes in 32 bits; where size_t has more, more is refused. */
START_TEST(a_size_beyond_32_bits_is_refused)
{
    fixture_t f = saved_fixture();
    size_t huge = SIZE_MAX - HEADER, used = 0u;
    if ((uint64_t)huge <= UINT32_MAX) {
        return;
    }
    ck_assert_int_eq(insole_snapshot_save(KIND, f.state, huge, f.saved, SIZE_MAX, &used),
                     INSOLE_ERR_VALUE);
    ck_assert(refused(INSOLE_ERR_VALUE, KIND, huge, f.saved, SIZE_MAX));
}
END_TEST

START_TEST(an_empty_state_can_be_saved)
{
    uint8_t saved[HEADER], state = 5u;
    size_t used = 0u;
    ck_assert_int_eq(insole_snapshot_save(KIND, &state, 0u, saved, sizeof saved, &used), INSOLE_OK);
    ck_assert_uint_eq(used, HEADER);
    ck_assert_int_eq(insole_snapshot_load(KIND, &state, 0u, saved, used), INSOLE_OK);
    ck_assert_uint_eq(state, 5u);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("snapshot");
    suite_add(suite, "crc check value", crc_has_its_published_check_value);
    suite_add(suite, "crc definition", crc_agrees_with_its_definition_and_chains);
    suite_add(suite, "comes back", a_saved_state_comes_back);
    suite_add(suite, "header", the_header_is_little_endian_on_every_machine);
    suite_add(suite, "any address", any_address_and_bytes_behind_do_not_matter);
    suite_add(suite, "wrong bytes", every_wrong_byte_is_noticed);
    suite_add(suite, "cut", a_cut_snapshot_is_refused);
    suite_add(suite, "kind and size", another_kind_or_size_is_refused);
    suite_add(suite, "version", another_version_is_refused);
    suite_add(suite, "erased flash", erased_and_zeroed_flash_is_refused);
    suite_add(suite, "too little room", too_little_room_is_refused_and_nothing_written);
    suite_add(suite, "NULL", null_is_refused);
    suite_add(suite, "beyond 32 bits", a_size_beyond_32_bits_is_refused);
    suite_add(suite, "empty state", an_empty_state_can_be_saved);
    return suite;
}
