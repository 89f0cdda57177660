/** @file particle_filter.h  Strides, inertial positions, radio and walls made one position.
 *
 *  Source  [TwoOrder] 2.3 (8)-(9), 3.2 (32), (34), (38)-(42).
 *  Frames  n: level, as the inertial filter left it.  m: map. The angle between the two is a part
 *          of what is estimated: each particle has an offset of its own.
 *
 *  Strides move the particles; walls, positions, ranges, scans and fixes by fingerprints weigh
 * them. With the settings `insole_particle_filter_phone` strides are the steps of a phone
 * (step_cloud.h). With the settings `insole_particle_filter_two_order` it is the paper's second
 * stage as printed. With the defaults a particle's offset wanders, its scale is personal, and the
 * whole stride is tested for walls.
 *
 *      static insole_particle_t particles[500];
 *      static insole_particle_filter_t filter;
 *      insole_cloud_t cloud = {particles, 500, NULL, 0, NULL};
 *      insole_particle_filter_init(&filter, &insole_particle_filter_defaults, seed);
 *      insole_particle_filter_start(&filter, &cloud, &start);
 *      while (insole_particle_filter_work(&filter, &cloud, &building, 50)) {}
 *      on each stride, or scan, or both:
 *          insole_particle_filter_begin(&filter, &building, &news);
 *          while (insole_particle_filter_work(&filter, &cloud, &building, 50)) {}
 *          use(&filter.fix);
 *
 *  The work is done in slices: a stride worked in by many small ones ends in the same bits as by
 * one large one. While work is left nothing new can begin.
 *
 *  When every particle has died the cloud is drawn anew about the last good fix, wider each time.
 *  When scans fit better where they point than where the cloud is, a share of it is drawn there.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_FUSE_PARTICLE_FILTER_H
#define INSOLE_FUSE_PARTICLE_FILTER_H

#include "insole/fuse/cloud_source.h"
#include "insole/fuse/particle_config.h"
#include "insole/fuse/particle_start.h"
#include "insole/fuse/step_weighing.h"
#include "insole/fuse/weighing.h"
#include "insole/place/rss_field.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
    uint32_t strides;
    uint32_t scans;
    uint32_t resampled;
    uint32_t redrawn;   /**< times that a share of the cloud was drawn where a scan pointed */
    uint32_t recovered; /**< times that all had died */
    uint32_t refused;   /**< calls answered with a negative status */
} insole_particle_counts_t;

typedef enum {
    INSOLE_PARTICLES_IDLE = 0,
    INSOLE_PARTICLES_DRAW,
    INSOLE_PARTICLES_MOVE,
    INSOLE_PARTICLES_STEP, /**< the same by what a phone tells; all before any is weighed */
    INSOLE_PARTICLES_FIELD,
    INSOLE_PARTICLES_WEIGH,
    INSOLE_PARTICLES_STEP_WEIGH,
    INSOLE_PARTICLES_SUM,
    INSOLE_PARTICLES_RESAMPLE,
    INSOLE_PARTICLES_FINISH
} insole_particle_phase_t;

typedef struct {
    insole_particle_filter_config_t config;
    insole_particle_counts_t counts;
    insole_cloud_fix_t fix; /**< the last one that was reached */
    bool has_fix;
    bool has_bias; /**< particles of the cloud that was started have biases */

    insole_rng_t rng;
    uint32_t count;                                 /**< of those particles; 0: none */
    uint32_t since_start;                           /**< strides since */
    insole_weighing_t weighing;                     /**< what is being worked in */
    const insole_step_weighing_calls_t *step_calls; /**< NULL: nothing of a phone is told */
    insole_step_weighing_t steps;

    insole_particle_phase_t phase;
    bool is_blind; /**< no plan tells of walls */
    bool anywhere; /**< the plan is not asked: nothing walkable was found */
    uint32_t next; /**< particle */
    insole_cloud_sum_t sum;
    insole_cloud_comb_t comb;
    insole_cloud_source_t source; /**< of what is being drawn */
    insole_cloud_source_t reach;  /**< where the cloud is now */
    uint32_t redraw_every;        /**< every so many are drawn anew; 0: none */
    bool spreads;                 /**< copies have been made */
    uint32_t deaths;              /**< of the whole cloud, less the strides survived since */
    insole_rss_field_t field;
} insole_particle_filter_t;

/** @param calls  &insole_step_weighing_calls, for one that is also told what a phone tells or has
 *                soft walls; NULL: neither, and nothing of them is linked
 *  @return INSOLE_ERR_NULL, also for soft walls without calls; INSOLE_ERR_VALUE for a setting out
 * of its range */
insole_status_t insole_particle_filter_init_steps(insole_particle_filter_t *filter,
                                                  const insole_particle_filter_config_t *config,
                                                  const insole_step_weighing_calls_t *calls,
                                                  uint64_t seed);

/** A filter of strides, walls, strengths and ranges alone. @return as above */
static inline insole_status_t
insole_particle_filter_init(insole_particle_filter_t *filter,
                            const insole_particle_filter_config_t *config, uint64_t seed)
{
    return insole_particle_filter_init_steps(filter, config, 0, seed);
}

/** Begins anew: the cloud will be drawn by `work`. What was not yet worked in is dropped.
 *  @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE for what is not finite, a negative sigma, a cloud of
 * no particles or too many */
insole_status_t insole_particle_filter_start(insole_particle_filter_t *filter,
                                             const insole_cloud_t *cloud,
                                             const insole_particle_start_t *start);

/** The same from a source that insole_particle_origin_source() made.
 *  @param fix  by radio, about which particles are drawn: what part of their way to it is bias is
 *              known of each; NULL: none
 *  @return as above, and as insole_spot_fix_check(); INSOLE_ERR_STATE for a fix that the filter has
 *          no calls for */
insole_status_t insole_particle_filter_start_from(insole_particle_filter_t *filter,
                                                  const insole_cloud_t *cloud,
                                                  const insole_cloud_source_t *source,
                                                  const insole_spot_fix_t *fix);

/** Takes news to be worked in. Readings of unknown access points are passed over.
 *  @param building  NULL: nothing is known of it
 *  @return INSOLE_ERR_NULL, INSOLE_ERR_STATE before the start, while work is left, and for what a
 *          phone tells when the filter has no calls for it;
 *          INSOLE_ERR_TIME for a fix by fingerprints that is not newer than the one before */
insole_status_t insole_particle_filter_begin(insole_particle_filter_t *filter,
                                             const insole_building_t *building,
                                             const insole_evidence_t *news);

/** Does at most `particles` particles' worth of work. Nothing is done to a cloud of another number
 *  of particles than that of the start.
 *  @param building  as in the call of begin
 *  @return true while work is left */
bool insole_particle_filter_work(insole_particle_filter_t *filter, const insole_cloud_t *cloud,
                                 const insole_building_t *building, uint32_t particles);

/** Has all that was told come into `fix`? It has before the last of the work is done: the cloud may
 *  yet be drawn anew from itself. */
static inline bool insole_particle_filter_has_settled(const insole_particle_filter_t *filter)
{
    return filter->has_fix &&
           (filter->phase == INSOLE_PARTICLES_IDLE || filter->phase == INSOLE_PARTICLES_RESAMPLE ||
            filter->phase == INSOLE_PARTICLES_FINISH);
}

/** How much likelier the last scans are where they point than where the cloud is, in logarithms:
 *  > 0 casts doubt on the cloud. */
static inline insole_real_t insole_particle_filter_misfit(const insole_particle_filter_t *filter)
{
    if (!filter) {
        return INSOLE_R(0.0);
    }
    insole_real_t power = filter->is_blind ? filter->config.blind_power : INSOLE_R(1.0);
    return power * filter->field.elsewhere_likelier;
}

/** Where the ancestors of the present cloud were some strides ago: the position then, by all that
 *  is known now. The cloud must have kept its past.
 *  @return INSOLE_ERR_STATE before so many strides, while work is left, or without a past so long
 */
insole_status_t insole_particle_filter_past(const insole_particle_filter_t *filter,
                                            const insole_cloud_t *cloud, uint32_t strides_ago,
                                            insole_spot_t *mean);

#ifdef __cplusplus
}
#endif

#endif
