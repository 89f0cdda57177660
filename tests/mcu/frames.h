/** @file frames.h  Frames of the wire, byte by byte.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TESTS_MCU_FRAMES_H
#define INSOLE_TESTS_MCU_FRAMES_H

#include <string.h>

#include "wire.h"

static wire_frame_t frame;

static inline void put(uint32_t number, int bytes)
{
    for (int i = 0; i < bytes; i++) {
        frame.payload[frame.count++] = (uint8_t)(number >> (8 * i));
    }
}

static inline void put_float(float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    put(bits, 4);
}

static inline void begin_frame(int kind)
{
    memset(&frame, 0, sizeof frame);
    frame.kind = (uint8_t)kind;
}

static inline void make_imu(uint32_t ticks, int count)
{
    begin_frame(WIRE_IMU);
    for (int i = 0; i < count; i++) {
        put(ticks + (uint32_t)i * 10000u, 4);
        for (int k = 1; k <= 6; k++) {
            put((uint32_t)(k % 2 == 0 ? k : -k), 2);
        }
    }
}

#endif
