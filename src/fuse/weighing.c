/* SPDX-License-Identifier: MIT */
#include "insole/fuse/weighing.h"

#include <stddef.h>

void insole_weighing_begin(insole_weighing_t *weighing)
{
    weighing->heaviest_log = INSOLE_PARTICLE_DEAD;
    weighing->heaviest = 0;
}

INSOLE_COLD bool insole_weighing_listen(const insole_weighing_t *weighing,
                                        insole_rss_field_t *field,
                                        const insole_building_t *building,
                                        const insole_evidence_t *news,
                                        const insole_cloud_source_t *reach, insole_real_t wide_rad)
{
    insole_rss_around_t around = {.x_m = reach->x_m - weighing->news.since.x_m,
                                  .y_m = reach->y_m - weighing->news.since.y_m,
                                  .sigma_m =
                                      insole_sqrt(insole_max(reach->var_x_m2, reach->var_y_m2)),
                                  .heading_rad = weighing->stride.heading_rad + reach->offset_rad,
                                  .has_heading = reach->sigma_offset_rad <= wide_rad};
    return insole_rss_field_hear(field, building, news->readings, news->reading_count) ==
               INSOLE_OK &&
           insole_rss_field_place(field, &around) == INSOLE_OK;
}

/* Does the way to where a particle is now kill it? */
static bool kills(insole_walls_t walls, const insole_floor_plan_t *plan, insole_spot_t from,
                  const insole_particle_t *to)
{
    return walls == INSOLE_WALLS_INSIDE
               ? !insole_floor_plan_inside(plan, to->x_m, to->y_m) /* [TwoOrder (40)] */
               : insole_floor_plan_crosses(plan, from.x_m, from.y_m, to->x_m, to->y_m);
}

/* The settings of the stride are copied: they stay the same while particles change. */
static void walk(const insole_weighing_t *weighing, const insole_floor_plan_t *plan,
                 insole_particle_t *particle, insole_particle_t *end, insole_rng_t *rng)
{
    const insole_cloud_stride_t stride = weighing->stride;
    const insole_walls_t walls = plan ? weighing->walls : INSOLE_WALLS_OFF;
    for (; particle < end; particle++) {
        if (insole_particle_lives(particle)) {
            insole_spot_t from = {particle->x_m, particle->y_m};
            insole_cloud_walk(particle, &stride, rng);
            if (walls != INSOLE_WALLS_OFF && kills(walls, plan, from, particle)) {
                particle->log_weight = INSOLE_PARTICLE_DEAD;
            }
        }
    }
}

void insole_weighing_move(const insole_weighing_t *weighing, insole_rss_field_t *field,
                          const insole_floor_plan_t *plan, const insole_cloud_t *cloud,
                          uint32_t first, uint32_t end, insole_rng_t *rng)
{
    if (weighing->news.has_stride) {
        walk(weighing, plan, &cloud->particles[first], &cloud->particles[end], rng);
    }
    const insole_spot_t since = weighing->news.since;
    for (uint32_t i = first; i < end && weighing->news.has_scan; i++) {
        const insole_particle_t *particle = &cloud->particles[i];
        if (insole_particle_lives(particle)) {
            insole_rss_field_need(field, particle->x_m - since.x_m, particle->y_m - since.y_m);
        }
    }
}

static insole_real_t log_of_scan(const insole_weighing_t *weighing, const insole_rss_field_t *field,
                                 const insole_particle_t *particle)
{
    insole_turn_t direction = {INSOLE_R(1.0), INSOLE_R(0.0)};
    if (field->views > 1u) {
        direction = insole_cloud_direction(particle, weighing->stride.heading_rad);
    }
    return insole_rss_field_at(field, particle->x_m - weighing->news.since.x_m,
                               particle->y_m - weighing->news.since.y_m, direction);
}

void insole_weighing_weigh(insole_weighing_t *weighing, const insole_rss_field_t *field,
                           const insole_cloud_t *cloud, uint32_t first, uint32_t end)
{
    const insole_evidence_t *news = &weighing->news;
    const bool is_placed = news->has_position || news->ranges > 0;
    for (uint32_t i = first; i < end; i++) {
        insole_particle_t *particle = &cloud->particles[i];
        if (insole_particle_lives(particle)) {
            insole_real_t log_weight = particle->log_weight - weighing->common_log;
            if (is_placed) { /* [TwoOrder (8)] */
                log_weight += insole_evidence_log_weight(news, particle->x_m, particle->y_m);
            }
            if (news->has_scan) {
                log_weight += weighing->scan_power * log_of_scan(weighing, field, particle);
            }
            particle->log_weight = log_weight;
            insole_weighing_note(weighing, particle, i);
        }
    }
}
