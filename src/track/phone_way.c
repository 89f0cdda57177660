/* SPDX-License-Identifier: MIT */
#include "insole/track/phone_way.h"

#include <string.h>

#include "insole/base/slot.h"

#define ZERO INSOLE_R(0.0)
#define ONE  INSOLE_R(1.0)

static const insole_real_t LONGEST = INSOLE_R(2.0);  /* of a vector that should be of unit length */
static const insole_real_t SHORTEST = INSOLE_R(0.1); /* of a sum that has a direction */

static const insole_turn_t nowhere = {ZERO, ZERO};

insole_status_t insole_phone_way_init(insole_phone_way_t *way)
{
    if (!way) {
        return INSOLE_ERR_NULL;
    }
    memset(way, 0, sizeof *way);
    way->ring = insole_ring(INSOLE_PHONE_WAY_STEPS);
    return INSOLE_OK;
}

/* ---- directions ------------------------------------------------------------------------- */

static bool has_slots(const insole_phone_way_t *way)
{
    return way->first_slot > 0u;
}

static uint64_t slot_of(uint64_t t_us)
{
    return insole_slot_of(t_us / 2u, INSOLE_PHONE_WAY_SLOT_US / 2u) + 1u; /* 0 means none */
}

static insole_turn_t *slot_at(insole_phone_way_t *way, uint64_t slot)
{
    return &way->ahead[slot % INSOLE_PHONE_WAY_SLOTS];
}

static void open_slot(insole_phone_way_t *way, uint64_t slot)
{
    uint64_t fresh = slot - way->slot;
    uint64_t count = fresh < INSOLE_PHONE_WAY_SLOTS ? fresh : INSOLE_PHONE_WAY_SLOTS;
    for (uint64_t i = 0u; i < count; i++) {
        *slot_at(way, slot - i) = nowhere;
    }
    way->slot = slot;
}

insole_status_t insole_phone_way_face(insole_phone_way_t *way, uint64_t t_us, insole_turn_t ahead)
{
    if (!way) {
        return INSOLE_ERR_NULL;
    }
    if (!(ahead.cos * ahead.cos + ahead.sin * ahead.sin <= LONGEST * LONGEST)) {
        return INSOLE_ERR_VALUE;
    }
    uint64_t slot = slot_of(t_us);
    way->first_slot = has_slots(way) ? way->first_slot : slot;
    if (slot > way->slot) {
        open_slot(way, slot);
    }
    insole_turn_t *sum = slot_at(way, way->slot);
    sum->cos += ahead.cos;
    sum->sin += ahead.sin;
    return INSOLE_OK;
}

static uint64_t clamp(uint64_t slot, uint64_t least, uint64_t most)
{
    return slot < least ? least : slot > most ? most : slot;
}

static uint64_t oldest_slot(const insole_phone_way_t *way)
{
    uint64_t kept = way->slot - way->first_slot < INSOLE_PHONE_WAY_SLOTS
                        ? way->slot - way->first_slot
                        : INSOLE_PHONE_WAY_SLOTS - 1u;
    return way->slot - kept;
}

static insole_turn_t sum_of(const insole_phone_way_t *way, uint64_t from, uint64_t to)
{
    insole_turn_t sum = nowhere;
    for (uint64_t slot = from; slot <= to; slot++) {
        sum.cos += way->ahead[slot % INSOLE_PHONE_WAY_SLOTS].cos;
        sum.sin += way->ahead[slot % INSOLE_PHONE_WAY_SLOTS].sin;
    }
    return sum;
}

static bool has_direction(insole_turn_t sum)
{
    return insole_abs(sum.cos) + insole_abs(sum.sin) >= SHORTEST;
}

insole_status_t insole_phone_way_direction(const insole_phone_way_t *way,
                                           const insole_footfall_t *footfall,
                                           insole_real_t *direction_rad)
{
    if (!way || !footfall || !direction_rad) {
        return INSOLE_ERR_NULL;
    }
    if (!has_slots(way)) {
        return INSOLE_ERR_STATE;
    }
    uint64_t oldest = oldest_slot(way);
    uint64_t to = clamp(slot_of(footfall->end_us), oldest, way->slot);
    uint64_t from = clamp(slot_of(footfall->begin_us), oldest, to);
    insole_turn_t sum = sum_of(way, from, to);
    while (!has_direction(sum) && from > oldest) {
        from--;
        sum = sum_of(way, from, from);
    }
    while (!has_direction(sum) && to < way->slot) {
        to++;
        sum = sum_of(way, to, to);
    }
    *direction_rad = insole_atan2(sum.sin, sum.cos);
    return INSOLE_OK;
}

/* ---- steps ------------------------------------------------------------------------------ */

insole_status_t insole_phone_way_go(insole_phone_way_t *way, const insole_footfall_t *footfall,
                                    insole_spot_t displacement)
{
    if (!way || !footfall) {
        return INSOLE_ERR_NULL;
    }
    if (footfall->end_us <= footfall->begin_us) {
        return INSOLE_ERR_TIME;
    }
    if (!insole_spot_is_finite(displacement)) {
        return INSOLE_ERR_VALUE;
    }
    insole_phone_way_step_t step = {footfall->begin_us, footfall->end_us, displacement};
    way->steps[insole_ring_push(&way->ring)] = step;
    return INSOLE_OK;
}

static insole_real_t share_before(uint64_t begin_us, uint64_t end_us, uint64_t t_us)
{
    if (t_us <= begin_us) {
        return ZERO;
    }
    return t_us >= end_us ? ONE : insole_seconds(begin_us, t_us) / insole_seconds(begin_us, end_us);
}

insole_real_t insole_phone_way_share(const insole_footfall_t *footfall, uint64_t t_us)
{
    return share_before(footfall->begin_us, footfall->end_us, t_us);
}

insole_spot_t insole_phone_way_since(const insole_phone_way_t *way, uint64_t t_us)
{
    insole_spot_t sum = {ZERO, ZERO};
    for (uint32_t i = way->ring.begin; i != way->ring.end; i++) {
        const insole_phone_way_step_t *step = &way->steps[insole_ring_slot(&way->ring, i)];
        insole_real_t after = ONE - share_before(step->begin_us, step->end_us, t_us);
        sum = insole_spot_add_scaled(sum, after, step->way);
    }
    return sum;
}

bool insole_phone_way_reaches(const insole_phone_way_t *way, uint64_t t_us)
{
    uint32_t oldest = insole_ring_slot(&way->ring, way->ring.begin);
    return !insole_ring_is_full(&way->ring) || way->steps[oldest].begin_us <= t_us;
}
