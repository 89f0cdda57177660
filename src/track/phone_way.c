/* SPDX-License-Identifier: MIT */
#include "insole/track/phone_way.h"

#include <string.h>

#include "insole/base/slot.h"

#define ZERO INSOLE_R(0.0)
#define ONE  INSOLE_R(1.0)

static const insole_real_t LONGEST = INSOLE_R(2.0);  /* of a vector that should be of unit length */
static const insole_real_t SHORTEST = INSOLE_R(0.1); /* of a sum that has a direction */

static const insole_turn_t nowhere = {ZERO, ZERO};

INSOLE_COLD insole_status_t insole_phone_way_init(insole_phone_way_t *way)
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

/* `back` = 0 is the newest. */
static uint32_t place_of(const insole_phone_way_t *way, uint32_t back)
{
    return ((uint32_t)way->slot - back) % INSOLE_PHONE_WAY_SLOTS;
}

/* The slots from the newest to that of the time, as many as there are. */
static void open_slots(insole_phone_way_t *way, uint64_t t_us)
{
    uint64_t slot = slot_of(t_us), fresh = slot - way->slot;
    uint32_t count = fresh < INSOLE_PHONE_WAY_SLOTS ? (uint32_t)fresh : INSOLE_PHONE_WAY_SLOTS;
    way->first_slot = has_slots(way) ? way->first_slot : slot;
    way->slot = slot;
    for (uint32_t back = 0u; back < count; back++) {
        way->ahead[place_of(way, back)] = nowhere;
    }
}

insole_status_t insole_phone_way_face(insole_phone_way_t *way, uint64_t t_us, insole_turn_t ahead)
{
    if (!way) {
        return INSOLE_ERR_NULL;
    }
    if (!(ahead.cos * ahead.cos + ahead.sin * ahead.sin <= LONGEST * LONGEST)) {
        return INSOLE_ERR_VALUE;
    }
    if (t_us >= way->slot * INSOLE_PHONE_WAY_SLOT_US) {
        open_slots(way, t_us);
    }
    insole_turn_t *sum = &way->ahead[place_of(way, 0u)];
    sum->cos += ahead.cos;
    sum->sin += ahead.sin;
    return INSOLE_OK;
}

static uint32_t oldest_back(const insole_phone_way_t *way)
{
    uint64_t before = way->slot - way->first_slot;
    return before < INSOLE_PHONE_WAY_SLOTS ? (uint32_t)before : INSOLE_PHONE_WAY_SLOTS - 1u;
}

/* That of the time, or the next one to it. */
static uint32_t back_of(const insole_phone_way_t *way, uint64_t t_us)
{
    uint64_t slot = slot_of(t_us), back = way->slot > slot ? way->slot - slot : 0u;
    uint32_t oldest = oldest_back(way);
    return back < oldest ? (uint32_t)back : oldest;
}

static insole_turn_t sum_of(const insole_phone_way_t *way, uint32_t from, uint32_t to)
{
    insole_turn_t sum = nowhere;
    for (uint32_t back = from + 1u; back-- > to;) {
        const insole_turn_t *slot = &way->ahead[place_of(way, back)];
        sum.cos += slot->cos;
        sum.sin += slot->sin;
    }
    return sum;
}

static bool has_direction(insole_turn_t sum)
{
    return insole_abs(sum.cos) + insole_abs(sum.sin) >= SHORTEST;
}

INSOLE_COLD insole_status_t insole_phone_way_direction(const insole_phone_way_t *way,
                                                       const insole_footfall_t *footfall,
                                                       insole_real_t *direction_rad)
{
    if (!way || !footfall || !direction_rad) {
        return INSOLE_ERR_NULL;
    }
    if (!has_slots(way)) {
        return INSOLE_ERR_STATE;
    }
    uint32_t to = back_of(way, footfall->end_us), from = back_of(way, footfall->begin_us);
    from = from > to ? from : to;
    insole_turn_t sum = sum_of(way, from, to);
    while (!has_direction(sum) && from < oldest_back(way)) {
        from++;
        sum = sum_of(way, from, from);
    }
    while (!has_direction(sum) && to > 0u) {
        to--;
        sum = sum_of(way, to, to);
    }
    *direction_rad = insole_atan2(sum.sin, sum.cos);
    return INSOLE_OK;
}

/* ---- steps ------------------------------------------------------------------------------ */

INSOLE_COLD insole_status_t insole_phone_way_go(insole_phone_way_t *way,
                                                const insole_footfall_t *footfall,
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

INSOLE_COLD insole_real_t insole_phone_way_share(const insole_footfall_t *footfall, uint64_t t_us)
{
    return share_before(footfall->begin_us, footfall->end_us, t_us);
}

INSOLE_COLD insole_spot_t insole_phone_way_since(const insole_phone_way_t *way, uint64_t t_us)
{
    insole_spot_t sum = {ZERO, ZERO};
    for (uint32_t i = way->ring.begin; i != way->ring.end; i++) {
        const insole_phone_way_step_t *step = &way->steps[insole_ring_slot(&way->ring, i)];
        insole_real_t after = ONE - share_before(step->begin_us, step->end_us, t_us);
        sum = insole_spot_add_scaled(sum, after, step->way);
    }
    return sum;
}

INSOLE_COLD bool insole_phone_way_reaches(const insole_phone_way_t *way, uint64_t t_us)
{
    uint32_t oldest = insole_ring_slot(&way->ring, way->ring.begin);
    return !insole_ring_is_full(&way->ring) || way->steps[oldest].begin_us <= t_us;
}
