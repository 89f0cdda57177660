/* SPDX-License-Identifier: MIT */
#include "insole/fuse/step_weighing.h"

#include <stddef.h>
#include <string.h>

#define ZERO INSOLE_R(0.0)
#define HALF INSOLE_R(0.5)
#define ONE  INSOLE_R(1.0)

insole_status_t insole_step_weighing_init(insole_step_weighing_t *steps,
                                          const insole_particle_filter_config_t *config)
{
    if (!steps || !config) {
        return INSOLE_ERR_NULL;
    }
    memset(steps, 0, sizeof *steps);
    return insole_radio_bias_init(&steps->radio, config->bias_sigma_m, config->bias_s,
                                  config->fix_floor);
}

insole_status_t insole_step_weighing_start(insole_step_weighing_t *steps,
                                           const insole_spot_fix_t *fix, bool learns)
{
    insole_radio_bias_t radio = steps->radio;
    insole_radio_bias_forget(&radio);
    insole_status_t status = fix ? insole_radio_bias_hear(&radio, fix, learns) : INSOLE_OK;
    if (status == INSOLE_OK) {
        steps->radio = radio;
        steps->by_radio = fix != NULL;
    }
    return status;
}

void insole_step_weighing_drawn(const insole_step_weighing_t *steps, const insole_cloud_t *cloud,
                                uint32_t number)
{
    insole_spot_t spot = {cloud->particles[number].x_m, cloud->particles[number].y_m};
    if (cloud->bias) {
        cloud->bias[number] =
            steps->by_radio ? insole_radio_bias_at(&steps->radio, spot) : insole_spot(ZERO, ZERO);
    }
}

insole_status_t insole_step_weighing_begin(insole_step_weighing_t *steps,
                                           const insole_particle_filter_config_t *config,
                                           const insole_evidence_t *news, bool learns,
                                           bool has_plan)
{
    if (news->fix) {
        insole_status_t status = insole_radio_bias_hear(&steps->radio, news->fix, learns);
        if (status != INSOLE_OK) {
            return status;
        }
        steps->since = news->fix->since;
        steps->ahead_m = config->fix_ahead_m;
    }
    steps->has_fix = news->fix != NULL;
    steps->has_compass = news->has_compass;
    if (news->has_compass) {
        steps->compass_rad = news->compass_rad;
        steps->per_sigma_compass = ONE / news->sigma_compass_rad;
    }
    steps->heading_rad = news->has_stride ? news->heading_rad : steps->heading_rad;
    steps->rss = news->rss;
    steps->rss_since = news->rss_since;
    steps->looks = config->walls == INSOLE_WALLS_SOFT && has_plan && news->has_stride;
    steps->is_told = steps->has_fix || steps->has_compass || steps->rss || steps->looks;
    insole_soft_walls_begin(&steps->soft, config->soft_depth_m, config->soft_weight,
                            config->soft_least);
    return INSOLE_OK;
}

void insole_step_weighing_look(insole_step_weighing_t *steps, const insole_floor_plan_t *plan,
                               const insole_cloud_t *cloud, uint32_t first, uint32_t end)
{
    for (uint32_t i = first; i < end && steps->looks; i++) {
        const insole_particle_t *particle = &cloud->particles[i];
        if (insole_particle_lives(particle)) {
            insole_soft_walls_look(&steps->soft, plan, particle->x_m, particle->y_m);
        }
    }
}

/* Where a particle was before it walked a way in n. */
static insole_spot_t before(const insole_particle_t *particle, insole_spot_t since)
{
    insole_turn_t turn = insole_turn(particle->offset_rad);
    insole_spot_t way = insole_turn_way(turn, since);
    return insole_spot_add_scaled(insole_spot(particle->x_m, particle->y_m), -particle->scale, way);
}

static insole_real_t log_of_fix(const insole_step_weighing_t *steps,
                                const insole_particle_t *particle, insole_spot_t *bias)
{
    insole_turn_t ahead = insole_cloud_direction(particle, steps->heading_rad);
    insole_spot_t spot = insole_spot_add_scaled(before(particle, steps->since), steps->ahead_m,
                                                insole_spot(ahead.cos, ahead.sin));
    return insole_radio_bias_weigh(&steps->radio, spot, bias); /* [PhoneEKF (35)] */
}

static insole_real_t log_of_compass(const insole_step_weighing_t *steps,
                                    const insole_particle_t *particle)
{
    insole_real_t off = insole_wrap_near(particle->offset_rad - steps->compass_rad);
    return -HALF * insole_square(off * steps->per_sigma_compass);
}

static insole_real_t log_of_all(const insole_step_weighing_t *steps,
                                const insole_floor_plan_t *plan, const insole_particle_t *particle,
                                insole_spot_t *bias)
{
    insole_real_t log = ZERO;
    if (steps->looks) {
        log += insole_soft_walls_weigh(&steps->soft, plan, particle->x_m, particle->y_m);
    }
    if (steps->has_fix) {
        log += log_of_fix(steps, particle, bias);
    }
    if (steps->has_compass) {
        log += log_of_compass(steps, particle);
    }
    if (steps->rss) {
        log += insole_rss_weigh_at(steps->rss, before(particle, steps->rss_since));
    }
    return log;
}

void insole_step_weighing_weigh(const insole_step_weighing_t *steps,
                                const insole_floor_plan_t *plan, const insole_cloud_t *cloud,
                                uint32_t first, uint32_t end)
{
    for (uint32_t i = first; i < end; i++) {
        insole_particle_t *particle = &cloud->particles[i];
        if (insole_particle_lives(particle)) {
            particle->log_weight +=
                log_of_all(steps, plan, particle, cloud->bias ? &cloud->bias[i] : NULL);
        }
    }
}

const insole_step_weighing_calls_t insole_step_weighing_calls = {
    insole_step_weighing_init,  insole_step_weighing_start, insole_step_weighing_drawn,
    insole_step_weighing_begin, insole_step_weighing_look,  insole_step_weighing_weigh};
