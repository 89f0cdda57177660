/** @file step_weighing.h  What a phone tells, held against each particle: fix, compass, soft walls.
 *
 *  Source  ours; [PhoneEKF] 4.1, the particle filters it is compared with.
 *  Frames  n: level, of steps.  m: map.
 *
 *  A fix speaks of the place where the radio was heard, and of a point ahead of the walker there:
 *  from where a particle is now its own offset and scale lead back the way walked since.
 *
 *      insole_step_weighing_begin(&steps, &config, &news, learns, has_plan);
 *      for each particle:
 *          insole_step_weighing_move(&steps, &weighing, &field, &plan, &particle, &rng);
 *      for each particle:
 *          insole_step_weighing_weigh(&steps, &weighing, &field, &plan, &cloud, i);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_FUSE_STEP_WEIGHING_H
#define INSOLE_FUSE_STEP_WEIGHING_H

#include "insole/fuse/particle_config.h"
#include "insole/fuse/radio_bias.h"
#include "insole/fuse/soft_walls.h"
#include "insole/fuse/weighing.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
    insole_radio_bias_t radio;
    bool by_radio; /**< the start was a fix, that particles are drawn about */

    bool is_told; /**< there is something here to look at or weigh by */
    bool looks;   /**< soft walls: all must have walked before they are weighed */
    bool has_fix, has_compass;
    insole_real_t heading_rad; /**< n: of the last stride */
    insole_real_t ahead_m;
    insole_spot_t since; /**< n: way walked since the fix was heard */
    insole_soft_walls_t soft;
    insole_real_t compass_rad, per_sigma_compass;
    const insole_rss_weigh_t *rss; /**< the caller's, as long as work is left */
    insole_spot_t rss_since;
} insole_step_weighing_t;

/** @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE as insole_radio_bias_init() */
insole_status_t insole_step_weighing_init(insole_step_weighing_t *steps,
                                          const insole_particle_filter_config_t *config);

/** Particles will be drawn anew.
 *  @param fix  about which, as heard by radio; NULL: no fix, nothing is known of its bias
 *  @return as insole_radio_bias_hear() */
insole_status_t insole_step_weighing_start(insole_step_weighing_t *steps,
                                           const insole_spot_fix_t *fix, bool learns);

/** Sets the bias of a particle that was drawn. */
void insole_step_weighing_drawn(const insole_step_weighing_t *steps, const insole_cloud_t *cloud,
                                uint32_t number);

/** Takes what was told, that has passed insole_evidence_check().
 *  @param learns    particles have biases
 *  @param has_plan  a plan will be asked
 *  @return INSOLE_ERR_TIME for a fix that is not newer than the one before; nothing was taken */
insole_status_t insole_step_weighing_begin(insole_step_weighing_t *steps,
                                           const insole_particle_filter_config_t *config,
                                           const insole_evidence_t *news, bool learns,
                                           bool has_plan);

/** First round, when particles have walked: those from number `first` on, up to `end`, are looked
 *  at. */
void insole_step_weighing_look(insole_step_weighing_t *steps, const insole_floor_plan_t *plan,
                               const insole_cloud_t *cloud, uint32_t first, uint32_t end);

/** Second round: what was told here goes into their weights, but the dead ones'. */
void insole_step_weighing_weigh(const insole_step_weighing_t *steps,
                                const insole_floor_plan_t *plan, const insole_cloud_t *cloud,
                                uint32_t first, uint32_t end);

/** The calls above, for a filter that is to have them. */
typedef struct {
    insole_status_t (*init)(insole_step_weighing_t *steps,
                            const insole_particle_filter_config_t *config);
    insole_status_t (*start)(insole_step_weighing_t *steps, const insole_spot_fix_t *fix,
                             bool learns);
    void (*drawn)(const insole_step_weighing_t *steps, const insole_cloud_t *cloud,
                  uint32_t number);
    insole_status_t (*begin)(insole_step_weighing_t *steps,
                             const insole_particle_filter_config_t *config,
                             const insole_evidence_t *news, bool learns, bool has_plan);
    void (*look)(insole_step_weighing_t *steps, const insole_floor_plan_t *plan,
                 const insole_cloud_t *cloud, uint32_t first, uint32_t end);
    void (*weigh)(const insole_step_weighing_t *steps, const insole_floor_plan_t *plan,
                  const insole_cloud_t *cloud, uint32_t first, uint32_t end);
} insole_step_weighing_calls_t;

extern const insole_step_weighing_calls_t insole_step_weighing_calls;

/** As insole_step_weighing_start.
 *  @return INSOLE_ERR_STATE for a fix without calls */
static inline insole_status_t insole_step_calls_start(const insole_step_weighing_calls_t *calls,
                                                      insole_step_weighing_t *steps,
                                                      const insole_spot_fix_t *fix, bool learns)
{
    return calls ? calls->start(steps, fix, learns) : fix ? INSOLE_ERR_STATE : INSOLE_OK;
}

/** As insole_step_weighing_begin.
 *  @return INSOLE_ERR_STATE for what a phone tells without calls */
static inline insole_status_t insole_step_calls_begin(const insole_step_weighing_calls_t *calls,
                                                      insole_step_weighing_t *steps,
                                                      const insole_particle_filter_config_t *config,
                                                      const insole_evidence_t *news, bool learns,
                                                      bool has_plan)
{
    bool is_phone = news->fix || news->rss || news->has_compass;
    return calls      ? calls->begin(steps, config, news, learns, has_plan)
           : is_phone ? INSOLE_ERR_STATE
                      : INSOLE_OK;
}

#ifdef __cplusplus
}
#endif

#endif
