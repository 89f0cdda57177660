/** @file weighing.h  One particle's stride and weight, by all that was told of one moment.
 *
 *  Source  [TwoOrder] 2.3 (8), 3.2 (32), (34), (38)-(41).
 *  Frames  n: level, of strides.  m: map.
 *
 *  A weighing is filled in by who knows; then each particle walks, and is weighed once the radio is
 *  computed where particles need it.
 *
 *      insole_weighing_t weighing = {.walls = INSOLE_WALLS_CROSSES, .news = news, .scan_power = 1};
 *      insole_weighing_begin(&weighing);
 *      for each particle i:
 *          insole_weighing_move(&weighing, &field, &plan, &particle[i], &rng);
 *      compute the field;
 *      for each particle i:
 *          insole_weighing_weigh(&weighing, &field, &particle[i], i);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_FUSE_WEIGHING_H
#define INSOLE_FUSE_WEIGHING_H

#include "insole/fuse/cloud_source.h"
#include "insole/fuse/evidence.h"
#include "insole/place/floor_plan.h"
#include "insole/place/rss_field.h"

#ifdef __cplusplus
extern "C" {
#endif

/** How a plan kills. */
typedef enum {
    INSOLE_WALLS_OFF = 0,
    INSOLE_WALLS_INSIDE = 1,  /**< whose stride ends where nobody can be, (40) */
    INSOLE_WALLS_CROSSES = 2, /**< whose stride meets a wall anywhere */
    INSOLE_WALLS_SOFT = 3     /**< nobody, as off, but see soft_walls.h */
} insole_walls_t;

typedef struct {
    insole_walls_t walls;
    insole_evidence_t news;       /**< ways walked since are in m */
    insole_cloud_stride_t stride; /**< the last one; walked when `news` tells of a stride */
    insole_real_t scan_power;     /**< of the likelihood of the scan */
    insole_real_t common_log;     /**< taken off all weights, so that they stay near 0 */
    insole_real_t heaviest_log;   /**< largest weight so far */
    uint32_t heaviest;            /**< whose it is */
} insole_weighing_t;

/** No particle has been weighed. */
void insole_weighing_begin(insole_weighing_t *weighing);

/** Takes the scan that was told, and lays its field over where the walker was when it was heard.
 *  @param news      with the caller's readings
 *  @param wide_rad  with a larger 1-sigma of the offset all directions are possible
 *  @return whether there is anything to weigh by */
bool insole_weighing_listen(const insole_weighing_t *weighing, insole_rss_field_t *field,
                            const insole_building_t *building, const insole_evidence_t *news,
                            const insole_cloud_source_t *reach, insole_real_t wide_rad);

/** Particles from number `first` on, up to `end`, walk the stride, if there is one, and tell the
 *  field where they need it, if there is a scan. A particle that the plan kills is marked dead, the
 *  dead stay where they are.
 *  @param plan  NULL: no walls */
void insole_weighing_move(const insole_weighing_t *weighing, insole_rss_field_t *field,
                          const insole_floor_plan_t *plan, const insole_cloud_t *cloud,
                          uint32_t first, uint32_t end, insole_rng_t *rng);

/** Weighs particles, but the dead. */
void insole_weighing_weigh(insole_weighing_t *weighing, const insole_rss_field_t *field,
                           const insole_cloud_t *cloud, uint32_t first, uint32_t end);

/** Sees whether a particle is the heaviest. */
static inline void insole_weighing_note(insole_weighing_t *weighing,
                                        const insole_particle_t *particle, uint32_t number)
{
    if (particle->log_weight > weighing->heaviest_log) {
        weighing->heaviest_log = particle->log_weight;
        weighing->heaviest = number;
    }
}

/** False when all particles noted were dead. */
static inline bool insole_weighing_has_survivors(const insole_weighing_t *weighing)
{
    return weighing->heaviest_log > INSOLE_PARTICLE_DEAD;
}

#ifdef __cplusplus
}
#endif

#endif
