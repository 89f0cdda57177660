/** @file ring.h  Index arithmetic of a ring buffer whose slots the caller owns.
 *
 *  Slots are addressed by a running number that never goes back; slot = number mod capacity.
 *
 *      insole_ring_t ring = insole_ring(128);
 *      buffer[insole_ring_push(&ring)] = sample;               overwrites the oldest when full
 *      oldest = buffer[insole_ring_slot(&ring, ring.begin)];
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_BASE_RING_H
#define INSOLE_BASE_RING_H

#include <stdbool.h>
#include <stdint.h>

typedef struct {
    uint32_t capacity; /**< a power of two */
    uint32_t begin;    /**< running number of the oldest slot in use */
    uint32_t end;      /**< running number after the newest */
} insole_ring_t;

static inline insole_ring_t insole_ring(uint32_t capacity)
{
    insole_ring_t ring = {capacity, 0u, 0u};
    return ring;
}

static inline uint32_t insole_ring_count(const insole_ring_t *ring)
{
    return ring->end - ring->begin;
}

static inline uint32_t insole_ring_slot(const insole_ring_t *ring, uint32_t number)
{
    return number & (ring->capacity - 1u);
}

static inline bool insole_ring_is_full(const insole_ring_t *ring)
{
    return insole_ring_count(ring) >= ring->capacity;
}

/** Slot for a new entry; drops the oldest when full. */
static inline uint32_t insole_ring_push(insole_ring_t *ring)
{
    if (insole_ring_is_full(ring)) {
        ring->begin++;
    }
    return insole_ring_slot(ring, ring->end++);
}

/** Lets go of the oldest entry; nothing happens to an empty ring. */
static inline void insole_ring_pop(insole_ring_t *ring)
{
    if (ring->begin != ring->end) {
        ring->begin++;
    }
}

#endif
