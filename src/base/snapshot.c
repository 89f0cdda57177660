/* SPDX-License-Identifier: MIT */
#include "insole/base/snapshot.h"

#include <stdbool.h>
#include <string.h>

/* Byte offsets of the header's five little-endian words. */
enum { AT_MAGIC = 0, AT_KIND = 4, AT_VERSION = 8, AT_SIZE = 12, AT_CRC = 16 };

static const uint32_t MAGIC = 0x4c534e49u; /* "INSL" */

/* CRC of each 4-bit value, reflected polynomial 0xedb88320. */
static const uint32_t CRC_OF_NIBBLE[16] = {0x00000000u, 0x1db71064u, 0x3b6e20c8u, 0x26d930acu,
                                           0x76dc4190u, 0x6b6b51f4u, 0x4db26158u, 0x5005713cu,
                                           0xedb88320u, 0xf00f9344u, 0xd6d6a3e8u, 0xcb61b38cu,
                                           0x9b64c2b0u, 0x86d3d2d4u, 0xa00ae278u, 0xbdbdf21cu};

uint32_t insole_crc32(uint32_t crc, const void *bytes, size_t count)
{
    const uint8_t *byte = (const uint8_t *)bytes;
    crc = ~crc;
    for (size_t i = 0; byte != NULL && i < count; i++) {
        crc ^= byte[i];
        crc = (crc >> 4) ^ CRC_OF_NIBBLE[crc & 15u];
        crc = (crc >> 4) ^ CRC_OF_NIBBLE[crc & 15u];
    }
    return ~crc;
}

static void put_word(uint8_t *at, uint32_t word)
{
    for (int i = 0; i < 4; i++) {
        at[i] = (uint8_t)(word >> (8 * i));
    }
}

static void put_header(uint8_t *header, uint32_t kind, const void *state, size_t size)
{
    put_word(header + AT_MAGIC, MAGIC);
    put_word(header + AT_KIND, kind);
    put_word(header + AT_VERSION, INSOLE_SNAPSHOT_VERSION);
    put_word(header + AT_SIZE, (uint32_t)size);
    put_word(header + AT_CRC, insole_crc32(insole_crc32(0u, header, AT_CRC), state, size));
}

static bool fits_a_word(size_t size)
{
    return (uint32_t)size == size;
}

insole_status_t insole_snapshot_save(uint32_t kind, const void *state, size_t size, void *buffer,
                                     size_t room, size_t *used)
{
    if (state == NULL || buffer == NULL || used == NULL) {
        return INSOLE_ERR_NULL;
    }
    if (!fits_a_word(size)) {
        return INSOLE_ERR_VALUE;
    }
    if (room < INSOLE_SNAPSHOT_HEADER_BYTES || room - INSOLE_SNAPSHOT_HEADER_BYTES < size) {
        return INSOLE_ERR_ROOM;
    }
    put_header((uint8_t *)buffer, kind, state, size);
    memcpy((uint8_t *)buffer + INSOLE_SNAPSHOT_HEADER_BYTES, state, size);
    *used = INSOLE_SNAPSHOT_HEADER_BYTES + size;
    return INSOLE_OK;
}

insole_status_t insole_snapshot_load(uint32_t kind, void *state, size_t size, const void *buffer,
                                     size_t count)
{
    if (state == NULL || buffer == NULL) {
        return INSOLE_ERR_NULL;
    }
    if (!fits_a_word(size)) {
        return INSOLE_ERR_VALUE;
    }
    if (count < INSOLE_SNAPSHOT_HEADER_BYTES || count - INSOLE_SNAPSHOT_HEADER_BYTES < size) {
        return INSOLE_ERR_DATA;
    }
    const uint8_t *saved = (const uint8_t *)buffer + INSOLE_SNAPSHOT_HEADER_BYTES;
    uint8_t expected[INSOLE_SNAPSHOT_HEADER_BYTES];
    put_header(expected, kind, saved, size);
    if (memcmp(expected, buffer, sizeof expected) != 0) {
        return INSOLE_ERR_DATA;
    }
    memcpy(state, saved, size);
    return INSOLE_OK;
}
