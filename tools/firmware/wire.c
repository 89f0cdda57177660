/* SPDX-License-Identifier: MIT */
#include "wire.h"

#include <string.h>

enum { MARKED = 1, KIND_KNOWN = 2, COUNT_KNOWN = 3 };

/* The payload, and its check. @return true when the frame is whole and right */
static bool push_rest(wire_t *wire, uint8_t byte)
{
    uint32_t at = wire->got - COUNT_KNOWN;
    if (at < wire->frame.count) {
        wire->frame.payload[at] = byte;
        wire->got++;
        return false;
    }
    bool is_right = byte == wire_check(&wire->frame);
    wire->bad += is_right ? 0u : 1u;
    wire->got = 0u;
    return is_right;
}

bool wire_push(wire_t *wire, uint8_t byte)
{
    switch (wire->got) {
    case 0:
        wire->got = byte == WIRE_MARK ? MARKED : 0u;
        return false;
    case MARKED:
        wire->frame.kind = byte;
        wire->got = KIND_KNOWN;
        return false;
    case KIND_KNOWN:
        wire->frame.count = byte;
        wire->got = byte <= WIRE_ROOM ? COUNT_KNOWN : 0u;
        wire->bad += byte <= WIRE_ROOM ? 0u : 1u;
        return false;
    default:
        return push_rest(wire, byte);
    }
}

uint16_t wire_u16(const uint8_t *at)
{
    return (uint16_t)(at[0] | (uint32_t)at[1] << 8);
}

uint32_t wire_u32(const uint8_t *at)
{
    return wire_u16(at) | (uint32_t)wire_u16(at + 2) << 16;
}

float wire_float(const uint8_t *at)
{
    uint32_t bits = wire_u32(at);
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}
