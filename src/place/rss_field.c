/* SPDX-License-Identifier: MIT */
#include "insole/place/rss_field.h"

#include <stddef.h>
#include <string.h>

#define ZERO INSOLE_R(0.0)
#define HALF INSOLE_R(0.5)
#define ONE  INSOLE_R(1.0)

/* A reading further from its expectation tells of a wrong model, not of the receiver. */
#define DEVIATION_MAX_DB INSOLE_R(12.0)
#define SPACING_STEP     INSOLE_R(1.41421356)
#define SPACING_MAX_M    INSOLE_R(1000.0)

enum {
    SIDE = INSOLE_WALL_LOSSES_SIDE,
    NODES = INSOLE_RSS_FIELD_NODES,
    POINTING = 4,
    PRIOR_SCANS = 3
};

const insole_rss_field_config_t insole_rss_field_defaults = {
    INSOLE_RSS_FIELD_KEYS(INSOLE_CONFIG_DEFAULT)};

insole_status_t insole_rss_field_check(const insole_rss_field_config_t *config)
{
    typedef insole_rss_field_config_t config_t;
    static const insole_config_range_t ranges[] = {INSOLE_RSS_FIELD_KEYS(INSOLE_CONFIG_RANGE)};
    return insole_config_check(config, ranges, sizeof ranges / sizeof ranges[0]);
}

INSOLE_COLD insole_status_t insole_rss_field_init(insole_rss_field_t *field,
                                                  const insole_rss_field_config_t *config)
{
    insole_status_t status = insole_rss_field_check(config);
    if (!field || status != INSOLE_OK) {
        return field ? status : INSOLE_ERR_NULL;
    }
    *field = (insole_rss_field_t){.config = *config};
    return insole_wall_losses_init(&field->losses);
}

/* ---- the scan ---- */

/* Keeps the strongest, sorted; of equals the first stays in front. */
static void insert(insole_rss_field_t *field, const insole_rss_t *reading)
{
    uint32_t *id = field->heard_id, at = field->heard_count;
    insole_real_t *dbm = field->heard_dbm;
    if (at < INSOLE_RSS_FIELD_HEARD) {
        field->heard_count++;
    } else if (!(reading->rss_dbm > dbm[--at])) {
        return;
    }
    for (; at > 0 && reading->rss_dbm > dbm[at - 1u]; at--) {
        id[at] = id[at - 1u];
        dbm[at] = dbm[at - 1u];
    }
    id[at] = reading->id;
    dbm[at] = reading->rss_dbm;
}

static insole_spot_t spot_of_ap(const insole_ap_t *ap)
{
    insole_spot_t spot = {ap->x_m, ap->y_m};
    return spot;
}

static bool is_usable(const insole_rss_t *reading, const insole_building_t *building)
{
    return reading->id < building->ap_count && insole_is_finite(reading->rss_dbm) &&
           insole_spot_is_finite(spot_of_ap(&building->aps[reading->id]));
}

static bool is_any_usable(const insole_building_t *building, const insole_rss_t *readings,
                          uint32_t count)
{
    uint32_t i = 0;
    while (i < count && !is_usable(&readings[i], building)) {
        i++;
    }
    return i < count;
}

static void keep_strongest(insole_rss_field_t *field, const insole_building_t *building,
                           const insole_rss_t *readings, uint32_t count)
{
    field->heard_count = 0;
    for (uint32_t i = 0; i < count; i++) {
        if (is_usable(&readings[i], building)) {
            insert(field, &readings[i]);
        }
    }
}

INSOLE_COLD insole_status_t insole_rss_field_hear(insole_rss_field_t *field,
                                                  const insole_building_t *building,
                                                  const insole_rss_t *readings, uint32_t count)
{
    if (!field || !building || !building->propagation || !building->aps ||
        (!readings && count > 0)) {
        return INSOLE_ERR_NULL;
    }
    if (!is_any_usable(building, readings, count)) {
        return INSOLE_ERR_STATE;
    }
    keep_strongest(field, building, readings, count);
    insole_wall_losses_limit(&field->losses, building->propagation->walls_max_db);
    insole_wall_losses_reserve(&field->losses, field->heard_id, field->heard_count,
                               field->heard_slot);
    const insole_rss_fix_config_t *config =
        building->rss_fix ? building->rss_fix : &insole_rss_fix_defaults;
    field->points_elsewhere =
        insole_rss_fix_solve(config, building->propagation, building->aps, building->ap_count,
                             readings, count, &field->elsewhere) == INSOLE_OK;
    field->placed = false;
    return INSOLE_OK;
}

/* ---- the lattice ---- */

/* Half a spacing to either side is left over: the lattice lies by whole nodes. */
static insole_real_t spacing_for(const insole_rss_field_config_t *config, insole_real_t sigma_m)
{
    insole_real_t wanted_m = INSOLE_R(2.0) * config->cover * sigma_m / (insole_real_t)(SIDE - 2);
    insole_real_t spacing_m = config->spacing_m;
    while (spacing_m < wanted_m && spacing_m < SPACING_MAX_M) {
        spacing_m *= SPACING_STEP;
    }
    return spacing_m;
}

/* The cell of four nodes that a place lies in, and their shares. */
typedef struct {
    int32_t corner; /* lowest of the four */
    insole_real_t share[4];
} cell_t;

static insole_real_t in_lattice(insole_real_t at_m, int32_t first, insole_real_t spacing_m)
{
    insole_real_t at = at_m / spacing_m - (insole_real_t)first;
    return insole_max(ZERO, insole_min(at, (insole_real_t)(SIDE - 1)));
}

/* Number of the cell; the border belongs to the last. */
static int32_t cell_of(insole_real_t at)
{
    int32_t number = (int32_t)at;
    return number < SIDE - 1 ? number : SIDE - 2;
}

static inline cell_t cell_at(const insole_rss_field_t *field, insole_real_t x_m, insole_real_t y_m)
{
    const insole_wall_losses_t *losses = &field->losses;
    insole_real_t x = in_lattice(x_m, losses->column, losses->spacing_m);
    insole_real_t y = in_lattice(y_m, losses->row, losses->spacing_m);
    int32_t i = cell_of(x), j = cell_of(y);
    x -= (insole_real_t)i;
    y -= (insole_real_t)j;
    cell_t cell = {j * SIDE + i, {(ONE - x) * (ONE - y), x * (ONE - y), (ONE - x) * y, x * y}};
    return cell;
}

INSOLE_FLAT void insole_rss_field_need(insole_rss_field_t *field, insole_real_t x_m,
                                       insole_real_t y_m)
{
    if (!field) {
        return;
    }
    bool *needed = &field->needed[cell_at(field, x_m, y_m).corner];
    needed[0] = true;
    needed[1] = true;
    needed[SIDE] = true;
    needed[SIDE + 1] = true;
}

INSOLE_COLD insole_status_t insole_rss_field_place(insole_rss_field_t *field,
                                                   const insole_rss_around_t *around)
{
    if (!field || !around) {
        return INSOLE_ERR_NULL;
    }
    insole_real_t heading_rad = around->has_heading ? around->heading_rad : ZERO;
    if (!(around->sigma_m >= ZERO) || !insole_is_finite(heading_rad)) {
        return INSOLE_ERR_VALUE;
    }
    if (field->heard_count == 0) {
        return INSOLE_ERR_STATE;
    }
    if (insole_wall_losses_move(&field->losses, spacing_for(&field->config, around->sigma_m),
                                around->x_m, around->y_m) != INSOLE_OK) {
        return INSOLE_ERR_VALUE;
    }
    field->centre.x_m = around->x_m;
    field->centre.y_m = around->y_m;
    field->direction = insole_turn(heading_rad);
    field->views = around->has_heading ? 1u : INSOLE_RSS_FIELD_VIEWS;
    field->next_node = 0;
    field->next_heard = 0;
    field->placed = true;
    memset(field->node, 0, sizeof field->node);
    memset(field->needed, 0, sizeof field->needed);
    field->needed[NODES] = field->points_elsewhere;
    insole_rss_field_need(field, around->x_m, around->y_m);
    return INSOLE_OK;
}

/* ---- one node and one access point ---- */

static insole_spot_t spot_of_node(const insole_rss_field_t *field, uint32_t node)
{
    insole_spot_t elsewhere = {field->elsewhere.x_m, field->elsewhere.y_m};
    return node < NODES ? insole_wall_losses_spot(&field->losses, node) : elsewhere;
}

static insole_real_t wall_loss_db(insole_rss_field_t *field, const insole_floor_plan_t *plan,
                                  uint32_t node, uint32_t k, insole_spot_t ap)
{
    return node < NODES
               ? insole_wall_losses_at(&field->losses, plan, node, field->heard_slot[k], ap)
               : insole_wall_losses_between(plan, spot_of_node(field, node), ap,
                                            field->losses.limit_db);
}

/* Cosines of the access point's bearing as seen by each view: ahead, left, behind, right. */
static void bearings(const insole_rss_field_t *field, insole_spot_t spot, const insole_ap_t *ap,
                     insole_real_t *cos_bearing)
{
    insole_real_t dx = ap->x_m - spot.x_m, dy = ap->y_m - spot.y_m;
    insole_real_t scale = ONE / insole_sqrt(dx * dx + dy * dy + INSOLE_R(1e-6));
    cos_bearing[0] = scale * (dx * field->direction.cos + dy * field->direction.sin);
    cos_bearing[1] = scale * (dy * field->direction.cos - dx * field->direction.sin);
    cos_bearing[2] = -cos_bearing[0];
    cos_bearing[3] = -cos_bearing[1];
}

static void add_pair(insole_rss_field_t *field, const insole_building_t *building, uint32_t node,
                     uint32_t k)
{
    const insole_ap_t *ap = &building->aps[field->heard_id[k]];
    insole_spot_t spot = spot_of_node(field, node);
    insole_real_t loss_db = wall_loss_db(field, building->plan, node, k, spot_of_ap(ap));
    insole_real_t cos_bearing[INSOLE_RSS_FIELD_VIEWS];
    bearings(field, spot, ap, cos_bearing);
    insole_rss_node_t *sums = &field->node[node];
    for (uint32_t view = 0; view < field->views; view++) {
        insole_expected_rss_t expected;
        if (insole_propagation_expect(building->propagation, ap, spot.x_m, spot.y_m, loss_db,
                                      insole_body_share(cos_bearing[view]),
                                      &expected) == INSOLE_OK) {
            insole_real_t deviation_db = field->heard_dbm[k] - expected.rss_dbm - field->offset_db;
            sums->log_likelihood[view] +=
                insole_propagation_log_likelihood(building->propagation, deviation_db);
            sums->deviation_db +=
                insole_max(-DEVIATION_MAX_DB, insole_min(deviation_db, DEVIATION_MAX_DB));
        }
    }
}

static bool is_complete(const insole_rss_field_t *field)
{
    return field->placed && field->next_node > NODES;
}

static void next_pair(insole_rss_field_t *field)
{
    if (++field->next_heard == field->heard_count) {
        field->next_heard = 0;
        field->next_node++;
    }
}

bool insole_rss_field_work(insole_rss_field_t *field, const insole_building_t *building,
                           uint32_t *pairs)
{
    if (!field || !building || !building->propagation || !building->aps || !pairs ||
        !field->placed) {
        return false;
    }
    while (*pairs > 0 && !is_complete(field)) {
        if (!field->needed[field->next_node]) {
            field->next_node++;
            continue;
        }
        if (field->heard_id[field->next_heard] < building->ap_count) {
            add_pair(field, building, field->next_node, field->next_heard);
        }
        next_pair(field);
        --*pairs;
    }
    return !is_complete(field);
}

/* ---- what it says ---- */

static insole_real_t between_nodes(const insole_rss_field_t *field, const cell_t *cell,
                                   uint32_t view)
{
    const insole_rss_node_t *node = &field->node[cell->corner];
    return cell->share[0] * node[0].log_likelihood[view] +
           cell->share[1] * node[1].log_likelihood[view] +
           cell->share[2] * node[SIDE].log_likelihood[view] +
           cell->share[3] * node[SIDE + 1].log_likelihood[view];
}

/* The trigonometric polynomial through the four views. */
static insole_real_t between_views(const insole_rss_field_t *field, const cell_t *cell,
                                   insole_turn_t direction)
{
    insole_turn_t first = field->direction;
    insole_real_t c = direction.cos * first.cos + direction.sin * first.sin;
    insole_real_t s = direction.sin * first.cos - direction.cos * first.sin;
    insole_real_t ahead = between_nodes(field, cell, 0), left = between_nodes(field, cell, 1);
    insole_real_t behind = between_nodes(field, cell, 2), right = between_nodes(field, cell, 3);
    insole_real_t along = ahead + behind, across = left + right;
    return INSOLE_R(0.25) * (along + across + (c * c - s * s) * (along - across)) +
           HALF * (c * (ahead - behind) + s * (left - right));
}

INSOLE_FLAT insole_real_t insole_rss_field_at(const insole_rss_field_t *field, insole_real_t x_m,
                                              insole_real_t y_m, insole_turn_t direction)
{
    if (!field || !is_complete(field)) {
        return ZERO;
    }
    cell_t cell = cell_at(field, x_m, y_m);
    return field->views == 1u ? between_nodes(field, &cell, 0)
                              : between_views(field, &cell, direction);
}

static insole_real_t deviation_here(const insole_rss_field_t *field)
{
    cell_t cell = cell_at(field, field->centre.x_m, field->centre.y_m);
    const insole_rss_node_t *node = &field->node[cell.corner];
    insole_real_t sum =
        cell.share[0] * node[0].deviation_db + cell.share[1] * node[1].deviation_db +
        cell.share[2] * node[SIDE].deviation_db + cell.share[3] * node[SIDE + 1].deviation_db;
    return sum / (insole_real_t)(field->heard_count * field->views);
}

/* How much likelier the scan is where it points, whatever the direction. */
static insole_real_t likelier_elsewhere(const insole_rss_field_t *field)
{
    cell_t cell = cell_at(field, field->centre.x_m, field->centre.y_m);
    insole_real_t sum = ZERO;
    if (!field->points_elsewhere) {
        return sum;
    }
    for (uint32_t view = 0; view < field->views; view++) {
        sum += field->node[NODES].log_likelihood[view] - between_nodes(field, &cell, view);
    }
    return sum / (insole_real_t)field->views;
}

/* At first the mean of all scans and three more of an offset of 0; later the newer count more. */
static void learn_offset(insole_rss_field_t *field)
{
    insole_real_t limit = field->config.offset_max_db, weight = field->config.learn_weight;
    insole_real_t as_mean = ONE / (insole_real_t)(PRIOR_SCANS + field->learned + 1u);
    if (as_mean > weight && weight > ZERO) {
        weight = as_mean;
        field->learned++;
    }
    insole_real_t offset_db = field->offset_db + weight * deviation_here(field);
    field->offset_db = insole_max(-limit, insole_min(offset_db, limit));
}

INSOLE_COLD insole_status_t insole_rss_field_learn(insole_rss_field_t *field)
{
    if (!field) {
        return INSOLE_ERR_NULL;
    }
    if (!is_complete(field)) {
        return INSOLE_ERR_STATE;
    }
    learn_offset(field);
    field->elsewhere_likelier +=
        field->config.elsewhere_weight * (likelier_elsewhere(field) - field->elsewhere_likelier);
    field->placed = false;
    return INSOLE_OK;
}
