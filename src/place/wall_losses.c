/* SPDX-License-Identifier: MIT */
#include "insole/place/wall_losses.h"

#include <stddef.h>
#include <string.h>

#define ZERO          INSOLE_R(0.0)
#define HALF          INSOLE_R(0.5)
#define STEP_MIN_DB   INSOLE_R(0.125)
#define SPACING_MIN_M INSOLE_R(0.01)

enum {
    SIDE = INSOLE_WALL_LOSSES_SIDE,
    NODES = INSOLE_WALL_LOSSES_NODES,
    SLOTS = INSOLE_WALL_LOSSES_SLOTS,
    STEPS_MAX = 254,
    NOT_COUNTED = 255
};

static void give_slot(insole_wall_losses_slot_t *slot, uint32_t id)
{
    slot->id = id;
    memset(slot->steps, NOT_COUNTED, sizeof slot->steps);
}

INSOLE_COLD insole_status_t insole_wall_losses_init(insole_wall_losses_t *losses)
{
    if (!losses) {
        return INSOLE_ERR_NULL;
    }
    for (uint32_t s = 0; s < SLOTS; s++) {
        give_slot(&losses->slot[s], UINT32_MAX);
    }
    losses->limit_db = STEP_MIN_DB * (insole_real_t)STEPS_MAX;
    losses->step_db = STEP_MIN_DB;
    losses->spacing_m = INSOLE_R(1.0);
    losses->column = 0;
    losses->row = 0;
    return INSOLE_OK;
}

insole_status_t insole_wall_losses_limit(insole_wall_losses_t *losses, insole_real_t limit_db)
{
    if (!losses) {
        return INSOLE_ERR_NULL;
    }
    if (!(limit_db >= ZERO)) {
        return INSOLE_ERR_VALUE;
    }
    limit_db = insole_min(limit_db, INSOLE_WALL_LOSSES_MOST_DB);
    if (limit_db >= losses->limit_db && limit_db <= losses->limit_db) {
        return INSOLE_OK;
    }
    for (uint32_t s = 0; s < SLOTS; s++) {
        give_slot(&losses->slot[s], losses->slot[s].id);
    }
    losses->limit_db = limit_db;
    losses->step_db = STEP_MIN_DB;
    while (losses->step_db * (insole_real_t)STEPS_MAX < limit_db) {
        losses->step_db *= INSOLE_R(2.0); /* most losses stay whole numbers of steps */
    }
    return INSOLE_OK;
}

/* ---- the lattice ---- */

static int32_t floor_of(insole_real_t x)
{
    int32_t whole = (int32_t)x;
    return (insole_real_t)whole > x ? whole - 1 : whole;
}

static uint32_t modulo_side(int32_t number)
{
    int32_t rest = number % SIDE;
    return (uint32_t)(rest < 0 ? rest + SIDE : rest);
}

/* Where a node's losses are kept: by its map numbers, hence the same wherever the lattice lies. */
static uint32_t place_of(int32_t column, int32_t row)
{
    return modulo_side(row) * SIDE + modulo_side(column);
}

static int32_t column_of(const insole_wall_losses_t *losses, uint32_t node)
{
    return losses->column + (int32_t)(node % SIDE);
}

static int32_t row_of(const insole_wall_losses_t *losses, uint32_t node)
{
    return losses->row + (int32_t)(node / SIDE);
}

static void forget(insole_wall_losses_t *losses, uint32_t place)
{
    for (uint32_t s = 0; s < SLOTS; s++) {
        losses->slot[s].steps[place] = NOT_COUNTED;
    }
}

static bool was_within(int32_t number, int32_t first)
{
    return number >= first && number < first + SIDE;
}

static int32_t lowest_number(insole_real_t centre_m, insole_real_t spacing_m)
{
    return floor_of(centre_m / spacing_m - HALF * (insole_real_t)(SIDE - 2));
}

INSOLE_COLD insole_status_t insole_wall_losses_move(insole_wall_losses_t *losses,
                                                    insole_real_t spacing_m, insole_real_t x_m,
                                                    insole_real_t y_m)
{
    if (!losses) {
        return INSOLE_ERR_NULL;
    }
    if (!(insole_abs(x_m) <= INSOLE_WALL_LOSSES_REACH_M &&
          insole_abs(y_m) <= INSOLE_WALL_LOSSES_REACH_M && spacing_m >= SPACING_MIN_M &&
          spacing_m <= INSOLE_WALL_LOSSES_REACH_M)) {
        return INSOLE_ERR_VALUE;
    }
    bool same = spacing_m >= losses->spacing_m && spacing_m <= losses->spacing_m;
    int32_t old_column = losses->column, old_row = losses->row;
    losses->spacing_m = spacing_m;
    losses->column = lowest_number(x_m, spacing_m);
    losses->row = lowest_number(y_m, spacing_m);
    for (uint32_t node = 0; node < NODES; node++) {
        int32_t column = column_of(losses, node), row = row_of(losses, node);
        if (!same || !was_within(column, old_column) || !was_within(row, old_row)) {
            forget(losses, place_of(column, row));
        }
    }
    return INSOLE_OK;
}

insole_spot_t insole_wall_losses_spot(const insole_wall_losses_t *losses, uint32_t node)
{
    insole_spot_t spot = {ZERO, ZERO};
    if (losses) {
        spot.x_m = (insole_real_t)column_of(losses, node) * losses->spacing_m;
        spot.y_m = (insole_real_t)row_of(losses, node) * losses->spacing_m;
    }
    return spot;
}

/* ---- the access points ---- */

static bool is_among(uint32_t id, const uint32_t *ids, uint32_t count)
{
    for (uint32_t k = 0; k < count; k++) {
        if (ids[k] == id) {
            return true;
        }
    }
    return false;
}

/* The slot that an access point has, else one of an access point that is not asked for. */
static uint32_t slot_for(insole_wall_losses_t *losses, uint32_t id, const uint32_t *ids,
                         uint32_t count)
{
    uint32_t free = SLOTS;
    for (uint32_t s = 0; s < SLOTS; s++) {
        if (losses->slot[s].id == id) {
            return s;
        }
        if (free == SLOTS && !is_among(losses->slot[s].id, ids, count)) {
            free = s;
        }
    }
    give_slot(&losses->slot[free], id);
    return free;
}

INSOLE_COLD insole_status_t insole_wall_losses_reserve(insole_wall_losses_t *losses,
                                                       const uint32_t *ids, uint32_t count,
                                                       uint8_t *slots)
{
    if (!losses || (count > 0 && (!ids || !slots))) {
        return INSOLE_ERR_NULL;
    }
    if (count > SLOTS) {
        return INSOLE_ERR_ROOM;
    }
    for (uint32_t k = 0; k < count; k++) {
        slots[k] = (uint8_t)slot_for(losses, ids[k], ids, count);
    }
    return INSOLE_OK;
}

insole_real_t insole_wall_losses_between(const insole_floor_plan_t *plan, insole_spot_t from,
                                         insole_spot_t to, insole_real_t limit_db)
{
    insole_walls_between_t walls;
    return plan && insole_floor_plan_walls_until(plan, from.x_m, from.y_m, to.x_m, to.y_m, limit_db,
                                                 &walls) == INSOLE_OK
               ? insole_min(walls.loss_db, limit_db)
               : ZERO;
}

insole_real_t insole_wall_losses_at(insole_wall_losses_t *losses, const insole_floor_plan_t *plan,
                                    uint32_t node, uint32_t slot, insole_spot_t ap)
{
    if (!losses || node >= NODES || slot >= SLOTS) {
        return ZERO;
    }
    uint32_t place = place_of(column_of(losses, node), row_of(losses, node));
    uint8_t *steps = &losses->slot[slot].steps[place];
    if (*steps == NOT_COUNTED) {
        insole_spot_t spot = insole_wall_losses_spot(losses, node);
        insole_real_t loss_db = insole_wall_losses_between(plan, spot, ap, losses->limit_db);
        *steps = (uint8_t)(loss_db / losses->step_db + HALF);
    }
    return (insole_real_t)*steps * losses->step_db;
}
