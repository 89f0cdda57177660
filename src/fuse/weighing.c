/* SPDX-License-Identifier: MIT */
#include "insole/fuse/weighing.h"

#include <stddef.h>

void insole_weighing_begin(insole_weighing_t *weighing)
{
    weighing->heaviest_log = INSOLE_PARTICLE_DEAD;
    weighing->heaviest = 0;
}

bool insole_weighing_listen(const insole_weighing_t *weighing, insole_rss_field_t *field,
                            const insole_building_t *building, const insole_evidence_t *news,
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

static bool kills(insole_walls_t walls, const insole_floor_plan_t *plan, insole_spot_t from,
                  const insole_particle_t *to)
{
    if (!plan || walls == INSOLE_WALLS_OFF) {
        return false;
    }
    return walls == INSOLE_WALLS_INSIDE
               ? !insole_floor_plan_inside(plan, to->x_m, to->y_m) /* [TwoOrder (40)] */
               : insole_floor_plan_crosses(plan, from.x_m, from.y_m, to->x_m, to->y_m);
}

void insole_weighing_move(const insole_weighing_t *weighing, insole_rss_field_t *field,
                          const insole_floor_plan_t *plan, insole_particle_t *particle,
                          insole_rng_t *rng)
{
    const insole_evidence_t *news = &weighing->news;
    if (!insole_particle_lives(particle)) {
        return;
    }
    if (news->has_stride) {
        insole_spot_t from = {particle->x_m, particle->y_m};
        insole_cloud_walk(particle, &weighing->stride, rng);
        if (kills(weighing->walls, plan, from, particle)) {
            particle->log_weight = INSOLE_PARTICLE_DEAD;
            return;
        }
    }
    if (news->has_scan) {
        insole_rss_field_need(field, particle->x_m - news->since.x_m,
                              particle->y_m - news->since.y_m);
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
                           insole_particle_t *particle, uint32_t number)
{
    const insole_evidence_t *news = &weighing->news;
    if (!insole_particle_lives(particle)) {
        return;
    }
    particle->log_weight -= weighing->common_log; /* [TwoOrder (8)] */
    if (news->has_position || news->ranges > 0) {
        particle->log_weight += insole_evidence_log_weight(news, particle->x_m, particle->y_m);
    }
    if (news->has_scan) {
        particle->log_weight += weighing->scan_power * log_of_scan(weighing, field, particle);
    }
    insole_weighing_note(weighing, particle, number);
}
