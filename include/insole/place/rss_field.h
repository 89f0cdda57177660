/** @file rss_field.h  How well one scan fits, anywhere around where the walker may be.
 *
 *  Source  [TwoOrder] 2.4 (10) with all access points heard instead of the nearest of (37).
 *  Frames  m: map, x east, y north, metres.
 *
 *  The expected RSS of every access point heard is computed at the nodes of a small square lattice
 *  that lies over the walker's uncertainty, and only there; between nodes the logarithm of the
 *  likelihood is interpolated. A thousand particles then cost little more than one, however many
 *  access points the scan holds. Nodes that no particle is near are left out, and the lattice moves
 *  by whole nodes, so that walls are counted anew only for nodes that come in.
 *
 *      static insole_rss_field_t field;
 *      insole_rss_field_init(&field, &insole_rss_field_defaults);
 *      on each scan:
 *          insole_rss_field_hear(&field, &building, scan.readings, scan.count);
 *          insole_rss_field_place(&field, &around);
 *          while (insole_rss_field_work(&field, &building, 16)) {}
 *          log_weight += insole_rss_field_at(&field, x, y, cos_heading, sin_heading);
 *          insole_rss_field_learn(&field);
 *
 *  Where the walker's direction is known the body shades what lies behind. Where it is not, the
 *  nodes hold the likelihood for four directions, and particles differ by theirs.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_PLACE_RSS_FIELD_H
#define INSOLE_PLACE_RSS_FIELD_H

#include "insole/base/fastmath.h"
#include "insole/place/propagation.h"
#include "insole/place/rss_fix.h"
#include "insole/place/wall_losses.h"

#ifdef __cplusplus
extern "C" {
#endif

/* clang-format off */
#define INSOLE_RSS_FIELD_KEYS(KEY)                                                                \
    KEY(REAL, spacing_m, 0.8, 0.1, 10.0, "m", "smallest distance of nodes")                       \
    KEY(REAL, cover, 1.0, 0.5, 10.0, "", "the nodes cover so many sigmas to every side")          \
    KEY(REAL, learn_weight, 0.02, 0.0, 1.0, "",                                                   \
        "least weight of a new scan in the receiver's own offset; 0 = no offset is learned")      \
    KEY(REAL, offset_max_db, 15.0, 0.0, 60.0, "dB", "largest offset learned")                     \
    KEY(REAL, elsewhere_weight, 0.15, 0.0, 1.0, "",                                                \
        "weight of a new scan in whether scans point elsewhere")
/* clang-format on */

typedef struct {
    INSOLE_RSS_FIELD_KEYS(INSOLE_CONFIG_MEMBER)
} insole_rss_field_config_t;

extern const insole_rss_field_config_t insole_rss_field_defaults;

enum {
    INSOLE_RSS_FIELD_NODES = INSOLE_WALL_LOSSES_NODES,
    INSOLE_RSS_FIELD_HEARD = INSOLE_WALL_LOSSES_SLOTS, /**< of a scan the strongest count */
    INSOLE_RSS_FIELD_VIEWS = 4 /**< directions of a walker whose direction is not known */
};

/** What is known about the building. */
typedef struct {
    const insole_propagation_config_t *propagation;
    const insole_ap_t *aps; /**< a reading's id is an index into them */
    uint32_t ap_count;
    const insole_floor_plan_t *plan;        /**< NULL: no walls */
    const insole_rss_fix_config_t *rss_fix; /**< NULL: the defaults */
} insole_building_t;

/** Where the walker is thought to be, and heading where. */
typedef struct {
    insole_real_t x_m, y_m;
    insole_real_t sigma_m; /**< of each coordinate, >= 0 */
    insole_real_t heading_rad;
    bool has_heading; /**< false: all directions are possible */
} insole_rss_around_t;

/** What a node holds; sums over the access points heard. */
typedef struct {
    insole_real_t log_likelihood[INSOLE_RSS_FIELD_VIEWS]; /**< one when the heading is known */
    insole_real_t deviation_db;                           /**< measured less expected */
} insole_rss_node_t;

typedef struct {
    insole_rss_field_config_t config;
    insole_wall_losses_t losses; /**< and the lattice */

    uint32_t heard_count;
    uint32_t heard_id[INSOLE_RSS_FIELD_HEARD];  /**< strongest first */
    uint8_t heard_slot[INSOLE_RSS_FIELD_HEARD]; /**< of its wall losses */
    insole_real_t heard_dbm[INSOLE_RSS_FIELD_HEARD];
    bool points_elsewhere;
    insole_anchor_fix_t elsewhere; /**< where the scan itself points */

    bool placed;
    insole_spot_t centre;                               /**< where the walker is thought to be */
    insole_turn_t direction;                            /**< of the first view */
    uint32_t views;                                     /**< 1 or INSOLE_RSS_FIELD_VIEWS */
    uint32_t next_node, next_heard;                     /**< to be computed */
    insole_rss_node_t node[INSOLE_RSS_FIELD_NODES + 1]; /**< the last: where the scan points */
    bool needed[INSOLE_RSS_FIELD_NODES + 1];            /**< the same nodes */

    uint32_t learned;                 /**< scans that the offset is the mean of */
    insole_real_t offset_db;          /**< the receiver hears so much stronger than expected */
    insole_real_t elsewhere_likelier; /**< mean of how much likelier scans are where they point;
                                           > 0: the walker is not where thought */
} insole_rss_field_t;

/** @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE for a setting out of its range */
insole_status_t insole_rss_field_check(const insole_rss_field_config_t *config);

/** @return as insole_rss_field_check */
insole_status_t insole_rss_field_init(insole_rss_field_t *field,
                                      const insole_rss_field_config_t *config);

/** Takes the strongest readings of a scan. Readings of unknown ids, or not finite, are passed over.
 *  @return INSOLE_ERR_STATE when no reading is left, INSOLE_ERR_VALUE for propagation settings out
 *          of range */
insole_status_t insole_rss_field_hear(insole_rss_field_t *field, const insole_building_t *building,
                                      const insole_rss_t *readings, uint32_t count);

/** Lays the lattice for the scan heard last. */
insole_status_t insole_rss_field_place(insole_rss_field_t *field,
                                       const insole_rss_around_t *around);

/** The nodes around (x, y) will be asked for. */
void insole_rss_field_need(insole_rss_field_t *field, insole_real_t x_m, insole_real_t y_m);

/** Computes the nodes that are needed, at most so many pairs of a node and an access point, which
 *  it takes off `pairs`.
 *  @return true while more are left */
bool insole_rss_field_work(insole_rss_field_t *field, const insole_building_t *building,
                           uint32_t *pairs);

/** Logarithm of the likelihood of the scan, heard at (x, y) on the way in this direction; beyond
 * the lattice that of its border. 0 before all is computed. */
insole_real_t insole_rss_field_at(const insole_rss_field_t *field, insole_real_t x_m,
                                  insole_real_t y_m, insole_turn_t direction);

/** Lets the scan have its say on the receiver's offset and on whether it points elsewhere; once a
 *  scan.
 *  @return INSOLE_ERR_STATE before all is computed */
insole_status_t insole_rss_field_learn(insole_rss_field_t *field);

#ifdef __cplusplus
}
#endif

#endif
