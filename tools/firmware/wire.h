/** @file wire.h  What a device is told over its line: frames of bytes.
 *
 *      mark 0xa5 | kind | count | payload of `count` bytes | check
 *
 *  The check is the low byte of the CRC-32 of kind, count and payload. Numbers are little-endian,
 *  floats IEEE 754; `ticks` is a free-running counter. What the kinds hold, in this order:
 *
 *      H head    version u8, tracker u8, fixes per row u16, ticks a second u32, ticks at t0 u32,
 *                t0 i64 [us, clock of the log], of a count: float [m/s^2], float [rad/s],
 *                float [uT]; seed u32
 *      I imu     readings, oldest first: ticks u32, force i16 x 3, turn rate i16 x 3
 *      M mag     ticks u32, field i16 x 3
 *      S scan    ticks u32, then readings: index of access point u16, i8 [dBm], age u16 [ms]
 *      R ranges  ticks u32, then readings: index of access point u16, u32 [mm], sigma u16 [mm], 0:
 *                not told
 *      P place   ticks u32, x i32 [mm], y i32 [mm], heading i32 [urad] or WIRE_UNTOLD, 1-sigmas:
 *                u32 [mm], u32 [urad]
 *      Z reset   the device saves its state and starts again
 *      E end     no more will come
 *
 *  The device says `# ready` once it listens; after a reset it says so again.
 *
 *      wire_t wire = {0};
 *      if (wire_push(&wire, byte)) use(&wire.frame);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_FIRMWARE_WIRE_H
#define INSOLE_FIRMWARE_WIRE_H

#include <stdbool.h>

#include "insole/base/snapshot.h"

#define WIRE_MARK   0xa5u
#define WIRE_UNTOLD INT32_MIN

enum {
    WIRE_VERSION = 1,
    WIRE_FOOT = 'f', /**< the trackers, as the head names them */
    WIRE_PHONE = 'p',
    WIRE_ROOM = 240, /**< bytes that a payload may have */
    WIRE_FRAMING = 4 /**< bytes around it */
};

enum {
    WIRE_HEAD = 'H',
    WIRE_IMU = 'I',
    WIRE_MAG = 'M',
    WIRE_SCAN = 'S',
    WIRE_RANGES = 'R',
    WIRE_PLACE = 'P',
    WIRE_RESET = 'Z',
    WIRE_END = 'E'
};

/** Bytes of what is told. */
enum {
    WIRE_HEAD_BYTES = 36,
    WIRE_IMU_BYTES = 16,
    WIRE_MAG_BYTES = 10,
    WIRE_PLACE_BYTES = 24,
    WIRE_TICKS_BYTES = 4,
    WIRE_RSS_BYTES = 5,
    WIRE_RANGE_BYTES = 8
};

enum {
    WIRE_IMU_MOST = WIRE_ROOM / WIRE_IMU_BYTES, /**< readings in a frame */
    WIRE_RSS_MOST = (WIRE_ROOM - WIRE_TICKS_BYTES) / WIRE_RSS_BYTES,
    WIRE_RANGE_MOST = (WIRE_ROOM - WIRE_TICKS_BYTES) / WIRE_RANGE_BYTES
};

typedef struct {
    uint8_t kind, count;
    uint8_t payload[WIRE_ROOM];
} wire_frame_t;

typedef struct {
    wire_frame_t frame; /**< newest, until the next byte */
    uint32_t got;       /**< bytes of it, the mark and all */
    uint32_t bad;       /**< frames left out because of their check or count */
} wire_t;

static inline uint8_t wire_check(const wire_frame_t *frame)
{
    const uint8_t head[2] = {frame->kind, frame->count};
    return (uint8_t)insole_crc32(insole_crc32(0u, head, sizeof head), frame->payload, frame->count);
}

/** @return true when the frame is whole and right */
bool wire_push(wire_t *wire, uint8_t byte);

/** Reading what a payload holds. */
uint16_t wire_u16(const uint8_t *at);
uint32_t wire_u32(const uint8_t *at);
float wire_float(const uint8_t *at);

static inline int16_t wire_i16(const uint8_t *at)
{
    return (int16_t)wire_u16(at);
}

static inline int32_t wire_i32(const uint8_t *at)
{
    return (int32_t)wire_u32(at);
}

#endif
