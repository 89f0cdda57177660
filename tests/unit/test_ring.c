/* SPDX-License-Identifier: MIT */
#include "insole/base/ring.h"

#include "insole/base/rng.h"
#include "near.h"
#include "suite.h"

enum { LARGEST = 128 };

START_TEST(a_new_ring_is_empty)
{
    insole_ring_t ring = insole_ring(8u);
    ck_assert_uint_eq(insole_ring_count(&ring), 0u);
    ck_assert(!insole_ring_is_full(&ring));
    insole_ring_pop(&ring);
    ck_assert_uint_eq(insole_ring_count(&ring), 0u);
    ck_assert_uint_eq(ring.begin, 0u);
    ck_assert_uint_eq(ring.end, 0u);
}
END_TEST

START_TEST(slots_are_handed_out_in_turn)
{
    insole_ring_t ring = insole_ring(4u);
    static const uint32_t SLOTS[] = {0u, 1u, 2u, 3u, 0u, 1u, 2u, 3u, 0u};
    for (uint32_t i = 0u; i < 9u; i++) {
        ck_assert_int_eq(insole_ring_is_full(&ring), i >= 4u);
        ck_assert_uint_eq(insole_ring_push(&ring), SLOTS[i]);
        ck_assert_uint_eq(insole_ring_count(&ring), i < 4u ? i + 1u : 4u);
    }
    ck_assert_uint_eq(ring.begin, 5u);
    ck_assert_uint_eq(insole_ring_slot(&ring, ring.begin), 1u);
}
END_TEST

/* A queue that moves its entries: slow, but plain. */
typedef struct {
    uint32_t entries[LARGEST], count, capacity;
} queue_t;

static void queue_drop_oldest(queue_t *queue)
{
    for (uint32_t i = 1u; i < queue->count; i++) {
        queue->entries[i - 1u] = queue->entries[i];
    }
    queue->count -= queue->count > 0u ? 1u : 0u;
}

static void queue_add(queue_t *queue, uint32_t entry)
{
    if (queue->count == queue->capacity) {
        queue_drop_oldest(queue);
    }
    queue->entries[queue->count++] = entry;
}

static bool holds_the_same(const insole_ring_t *ring, const uint32_t *buffer, const queue_t *queue)
{
    bool same = insole_ring_count(ring) == queue->count &&
                insole_ring_is_full(ring) == (queue->count == queue->capacity);
    for (uint32_t i = 0u; same && i < queue->count; i++) {
        same = buffer[insole_ring_slot(ring, ring->begin + i)] == queue->entries[i];
    }
    return same;
}

/* Pushes and pops at random, from a running number shortly before it wraps. */
START_TEST(holds_what_a_plain_queue_holds)
{
    static const uint32_t CAPACITIES[] = {1u, 2u, 8u, LARGEST};
    insole_ring_t ring = insole_ring(CAPACITIES[_i]);
    ring.begin = ring.end = UINT32_MAX - 1000u;
    queue_t queue = {{0u}, 0u, CAPACITIES[_i]};
    uint32_t buffer[LARGEST] = {0u};
    insole_rng_t rng;
    insole_rng_seed(&rng, 1u);
    worst_t same = {0.0, 0.0};
    for (int i = 0; i < 20000; i++) {
        uint32_t bits = insole_rng_bits(&rng), pops_of_eight = i / 1000 % 2 == 0 ? 2u : 5u;
        if (bits % 8u < pops_of_eight) {
            insole_ring_pop(&ring);
            queue_drop_oldest(&queue);
        } else {
            buffer[insole_ring_push(&ring)] = bits;
            queue_add(&queue, bits);
        }
        worst_require(&same, holds_the_same(&ring, buffer, &queue), i);
    }
    ASSERT_ALL_HELD(same);
    ck_assert_uint_lt(ring.end, UINT32_MAX - 1000u);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("ring");
    suite_add(suite, "empty", a_new_ring_is_empty);
    suite_add(suite, "slots in turn", slots_are_handed_out_in_turn);
    suite_add_loop(suite, "as a plain queue", holds_what_a_plain_queue_holds, 4);
    return suite;
}
