/* SPDX-License-Identifier: MIT */
#include "insole/fuse/particle_filter.h"

#include <string.h>

#define ZERO INSOLE_R(0.0)
#define ONE  INSOLE_R(1.0)

/* A pair of a node and an access point costs about so many particles. */
#define PARTICLES_PER_PAIR 3u
/* After so many deaths of all the cloud is as wide as it gets. */
#define DEATHS_MAX 6u

static insole_status_t refuse(insole_particle_filter_t *filter, insole_status_t status)
{
    if (filter) {
        filter->counts.refused++;
    }
    return filter ? status : INSOLE_ERR_NULL;
}

INSOLE_COLD insole_status_t insole_particle_filter_init_steps(
    insole_particle_filter_t *filter, const insole_particle_filter_config_t *config,
    const insole_step_weighing_calls_t *calls, uint64_t seed)
{
    insole_status_t status = insole_particle_config_check(config);
    if (!filter || status != INSOLE_OK) {
        return filter ? status : INSOLE_ERR_NULL;
    }
    bool is_soft = config->walls == INSOLE_WALLS_SOFT;
    if (is_soft && !calls) {
        return INSOLE_ERR_NULL;
    }
    memset(filter, 0, sizeof *filter);
    filter->config = *config;
    filter->weighing.walls = is_soft ? INSOLE_WALLS_OFF : (insole_walls_t)config->walls;
    insole_rng_seed(&filter->rng, seed);
    filter->step_calls = calls;
    status = calls ? calls->init(&filter->steps, config) : INSOLE_OK;
    return status != INSOLE_OK ? status : insole_rss_field_init(&filter->field, &config->field);
}

/* ---- what is told ---- */

static void begin_phase(insole_particle_filter_t *filter, insole_particle_phase_t phase)
{
    filter->next = 0;
    filter->phase = phase;
    insole_weighing_begin(&filter->weighing);
}

static void begin_drawing(insole_particle_filter_t *filter, const insole_cloud_source_t *source)
{
    filter->source = *source;
    filter->anywhere = false;
    begin_phase(filter, INSOLE_PARTICLES_DRAW);
}

INSOLE_COLD insole_status_t insole_particle_filter_start(insole_particle_filter_t *filter,
                                                         const insole_cloud_t *cloud,
                                                         const insole_particle_start_t *start)
{
    insole_status_t status = insole_particle_start_check(start);
    if (!filter || status != INSOLE_OK) {
        return refuse(filter, status);
    }
    insole_cloud_source_t source = insole_particle_start_source(start, filter->config.sigma_scale);
    return insole_particle_filter_start_from(filter, cloud, &source, NULL);
}

INSOLE_COLD insole_status_t insole_particle_filter_start_from(insole_particle_filter_t *filter,
                                                              const insole_cloud_t *cloud,
                                                              const insole_cloud_source_t *source,
                                                              const insole_spot_fix_t *fix)
{
    insole_status_t status = source ? insole_cloud_check(cloud) : INSOLE_ERR_NULL;
    if (filter && status == INSOLE_OK) {
        status =
            insole_step_calls_start(filter->step_calls, &filter->steps, fix, cloud->bias != NULL);
    }
    if (!filter || status != INSOLE_OK) {
        return refuse(filter, status);
    }
    insole_evidence_clear(&filter->weighing.news);
    filter->count = cloud->count;
    filter->has_bias = cloud->bias != NULL;
    filter->has_fix = false;
    filter->since_start = filter->deaths = 0;
    begin_drawing(filter, source);
    return INSOLE_OK;
}

static void take_stride(insole_particle_filter_t *filter, const insole_evidence_t *news)
{
    filter->weighing.stride = insole_particle_config_stride(&filter->config, news);
    filter->since_start++;
    filter->counts.strides++;
    insole_cloud_source_walk(&filter->reach, &filter->weighing.stride);
}

static bool is_idle(const insole_particle_filter_t *filter)
{
    return filter && filter->count > 0 && filter->phase == INSOLE_PARTICLES_IDLE;
}

INSOLE_COLD insole_status_t insole_particle_filter_begin(insole_particle_filter_t *filter,
                                                         const insole_building_t *building,
                                                         const insole_evidence_t *news)
{
    insole_status_t status = insole_evidence_check(news);
    status = status == INSOLE_OK && !is_idle(filter) ? INSOLE_ERR_STATE : status;
    if (status == INSOLE_OK) {
        status = insole_step_calls_begin(filter->step_calls, &filter->steps, &filter->config, news,
                                         filter->has_bias, building && building->plan);
    }
    if (status != INSOLE_OK) {
        return refuse(filter, status);
    }
    filter->weighing.news = *news;
    insole_evidence_turn(&filter->weighing.news, insole_cloud_source_turn(&filter->reach));
    if (news->has_stride) {
        take_stride(filter, news);
    }
    insole_real_t wide_rad = filter->since_start > 0 ? filter->config.wide_offset_rad : -ONE;
    filter->weighing.news.has_scan =
        news->has_scan && insole_weighing_listen(&filter->weighing, &filter->field, building, news,
                                                 &filter->reach, wide_rad);
    filter->is_blind = building && !building->plan;
    filter->weighing.scan_power =
        insole_particle_config_scan_power(&filter->config, &filter->reach, filter->is_blind);
    begin_phase(filter, filter->steps.is_told ? INSOLE_PARTICLES_STEP : INSOLE_PARTICLES_MOVE);
    return INSOLE_OK;
}

/* ---- weighing ---- */

static void begin_sum(insole_particle_filter_t *filter, const insole_cloud_t *cloud)
{
    filter->weighing.common_log = filter->weighing.heaviest_log;
    insole_cloud_sum_begin(&filter->sum, cloud, filter->weighing.heaviest);
    filter->phase = INSOLE_PARTICLES_SUM;
}

/* Draws about the same place, wider each time in a row. */
INSOLE_COLD static void draw_wider(insole_particle_filter_t *filter, insole_cloud_source_t source)
{
    insole_real_t wider = (insole_real_t)(1u << filter->deaths);
    insole_cloud_source_widen(&source, wider * filter->config.recover_sigma_m,
                              wider * filter->config.recover_offset_rad);
    filter->deaths += filter->deaths < DEATHS_MAX ? 1u : 0u;
    (void)insole_step_calls_start(filter->step_calls, &filter->steps, NULL, false);
    begin_drawing(filter, &source);
}

INSOLE_COLD static void end_weighing(insole_particle_filter_t *filter, const insole_cloud_t *cloud)
{
    if (!insole_weighing_has_survivors(&filter->weighing)) {
        filter->counts.recovered++;
        draw_wider(filter, filter->reach);
        return;
    }
    if (filter->weighing.news.has_scan) {
        insole_rss_field_learn(&filter->field);
        filter->counts.scans++;
    }
    filter->deaths -= filter->weighing.news.has_stride && filter->deaths > 0 ? 1u : 0u;
    begin_sum(filter, cloud);
}

/* ---- settling ---- */

/* The scans point elsewhere: a share of the cloud will be drawn there, and the cloud reaches so far
 * as to hold both. */
static void point_elsewhere(insole_particle_filter_t *filter)
{
    const insole_particle_filter_config_t *config = &filter->config;
    const insole_anchor_fix_t *there = &filter->field.elsewhere;
    insole_cloud_source_t source = filter->reach;
    insole_spot_t spot = insole_spot(there->x_m, there->y_m);
    insole_cloud_source_put(&source, insole_spot_add(spot, filter->weighing.news.since),
                            insole_sym2(there->P.xx, there->P.xy, there->P.yy));
    insole_cloud_source_widen(&source, ZERO, config->redraw_offset_rad);
    insole_cloud_source_mix(&filter->reach, &source, config->redraw_share);
    filter->source = source;
    filter->redraw_every = (uint32_t)(ONE / config->redraw_share + INSOLE_R(0.5));
    filter->counts.redrawn++;
}

static void begin_finish(insole_particle_filter_t *filter, const insole_cloud_t *cloud)
{
    bool visits = filter->redraw_every > 0 || cloud->past_strides > 0 || filter->spreads;
    filter->next = visits ? 0 : filter->count;
    filter->phase = INSOLE_PARTICLES_FINISH;
}

INSOLE_COLD static void end_sum(insole_particle_filter_t *filter, const insole_cloud_t *cloud)
{
    const insole_particle_filter_config_t *config = &filter->config;
    insole_cloud_fix(&filter->sum, &filter->fix);
    filter->has_fix = true;
    filter->reach = insole_cloud_source(&filter->fix, config->sigma_scale);
    filter->redraw_every = 0;
    filter->spreads = false;
    if (filter->weighing.news.has_scan && config->redraw_share > ZERO &&
        insole_particle_filter_misfit(filter) > config->redraw_margin) {
        point_elsewhere(filter);
    }
    if (filter->redraw_every > 0 ||
        filter->fix.effective < config->resample_share * (insole_real_t)filter->count) {
        insole_cloud_resample_begin(&filter->comb, &filter->sum, filter->count,
                                    insole_rng_uniform(&filter->rng));
        filter->counts.resampled++;
        filter->spreads = config->spread_share > ZERO;
        filter->phase = INSOLE_PARTICLES_RESAMPLE;
    } else {
        begin_finish(filter, cloud);
    }
}

static void finish(insole_particle_filter_t *filter, const insole_cloud_t *cloud,
                   const insole_floor_plan_t *plan, uint32_t first, uint32_t end)
{
    insole_cloud_source_t own = insole_cloud_source(&filter->fix, ZERO); /* `reach` is wider */
    insole_cloud_aside_t aside = insole_cloud_source_aside(&own, filter->config.spread_share);
    for (uint32_t i = first; i < end; i++) {
        insole_particle_t *particle = &cloud->particles[i];
        if (filter->spreads) {
            insole_cloud_source_spread(&aside, particle, plan, &filter->rng);
        }
        if (filter->redraw_every > 0 && i % filter->redraw_every == 0) {
            insole_cloud_source_draw(&filter->source, particle, plan, &filter->rng);
            particle->log_weight = insole_particle_lives(particle) ? filter->weighing.common_log
                                                                   : INSOLE_PARTICLE_DEAD;
        }
    }
    insole_cloud_remember(cloud, first, end, filter->since_start);
}

/* ---- the work ---- */

static void draw(insole_particle_filter_t *filter, const insole_cloud_t *cloud,
                 const insole_floor_plan_t *plan, uint32_t first, uint32_t end)
{
    for (uint32_t i = first; i < end; i++) {
        insole_cloud_source_draw(&filter->source, &cloud->particles[i], plan, &filter->rng);
        if (filter->step_calls) {
            filter->step_calls->drawn(&filter->steps, cloud, i);
        }
        insole_weighing_note(&filter->weighing, &cloud->particles[i], i);
    }
}

/* Where a scan was told, or all must walk before any is weighed, weighing has a round of its own.
 */
static void move(insole_particle_filter_t *filter, const insole_cloud_t *cloud,
                 const insole_floor_plan_t *plan, uint32_t first, uint32_t end)
{
    insole_weighing_t *weighing = &filter->weighing;
    insole_weighing_move(weighing, &filter->field, plan, cloud, first, end, &filter->rng);
    if (filter->phase == INSOLE_PARTICLES_STEP) {
        filter->step_calls->look(&filter->steps, plan, cloud, first, end);
    } else if (!weighing->news.has_scan) {
        insole_weighing_weigh(weighing, &filter->field, cloud, first, end);
    }
}

/* Where nothing walkable is even far around, going on without the plan is better than an end. */
INSOLE_COLD static void end_drawing(insole_particle_filter_t *filter, const insole_cloud_t *cloud)
{
    if (insole_weighing_has_survivors(&filter->weighing)) {
        begin_sum(filter, cloud);
    } else if (filter->deaths < DEATHS_MAX) {
        draw_wider(filter, filter->source);
    } else {
        filter->anywhere = true;
        filter->next = 0;
    }
}

/* All have walked. */
static void begin_round(insole_particle_filter_t *filter, bool field_first)
{
    filter->next = 0;
    filter->phase = filter->steps.is_told ? INSOLE_PARTICLES_STEP_WEIGH : INSOLE_PARTICLES_WEIGH;
    filter->phase = field_first ? INSOLE_PARTICLES_FIELD : filter->phase;
}

static void end_phase(insole_particle_filter_t *filter, const insole_cloud_t *cloud)
{
    switch (filter->phase) {
    case INSOLE_PARTICLES_DRAW:
        end_drawing(filter, cloud);
        break;
    case INSOLE_PARTICLES_STEP:
    case INSOLE_PARTICLES_MOVE:
        if (filter->weighing.news.has_scan || filter->steps.is_told) {
            begin_round(filter, filter->weighing.news.has_scan);
            break;
        } /* fall through */
    case INSOLE_PARTICLES_STEP_WEIGH:
    case INSOLE_PARTICLES_WEIGH:
        end_weighing(filter, cloud);
        break;
    default:
        insole_evidence_clear(&filter->weighing.news);
        filter->steps.rss = NULL;
        filter->phase = INSOLE_PARTICLES_IDLE;
    }
}

static void work_particles(insole_particle_filter_t *filter, const insole_cloud_t *cloud,
                           const insole_floor_plan_t *plan, uint32_t *budget)
{
    uint32_t first = filter->next, end = insole_cloud_slice(cloud, first, budget);
    filter->next = end;
    switch (filter->phase) {
    case INSOLE_PARTICLES_DRAW:
        draw(filter, cloud, filter->anywhere ? NULL : plan, first, end);
        break;
    case INSOLE_PARTICLES_STEP:
    case INSOLE_PARTICLES_MOVE:
        move(filter, cloud, plan, first, end);
        break;
    case INSOLE_PARTICLES_STEP_WEIGH:
        filter->step_calls->weigh(&filter->steps, plan, cloud, first, end); /* fall through */
    case INSOLE_PARTICLES_WEIGH:
        insole_weighing_weigh(&filter->weighing, &filter->field, cloud, first, end);
        break;
    default:
        finish(filter, cloud, filter->config.walls == INSOLE_WALLS_SOFT ? NULL : plan, first, end);
    }
    if (end == cloud->count) {
        end_phase(filter, cloud);
    }
}

static void work_field(insole_particle_filter_t *filter, const insole_building_t *building,
                       uint32_t *budget)
{
    uint32_t pairs = (*budget + PARTICLES_PER_PAIR - 1u) / PARTICLES_PER_PAIR, left = pairs;
    if (!insole_rss_field_work(&filter->field, building, &left)) {
        begin_round(filter, false);
    }
    uint32_t used = (pairs - left) * PARTICLES_PER_PAIR;
    *budget -= used < *budget ? used : *budget;
}

static void work_phase(insole_particle_filter_t *filter, const insole_cloud_t *cloud,
                       const insole_building_t *building, uint32_t *budget)
{
    switch (filter->phase) {
    case INSOLE_PARTICLES_FIELD:
        work_field(filter, building, budget);
        break;
    case INSOLE_PARTICLES_SUM:
        if (!insole_cloud_sum_work(&filter->sum, cloud, budget)) {
            end_sum(filter, cloud);
        }
        break;
    case INSOLE_PARTICLES_RESAMPLE:
        if (!insole_cloud_resample_work(&filter->comb, cloud, budget)) {
            filter->weighing.common_log = cloud->particles[0].log_weight;
            begin_finish(filter, cloud);
        }
        break;
    default:
        work_particles(filter, cloud, building ? building->plan : NULL, budget);
    }
}

bool insole_particle_filter_work(insole_particle_filter_t *filter, const insole_cloud_t *cloud,
                                 const insole_building_t *building, uint32_t particles)
{
    if (!filter || insole_cloud_check(cloud) != INSOLE_OK || cloud->count != filter->count) {
        return false;
    }
    while (particles > 0 && filter->phase != INSOLE_PARTICLES_IDLE) {
        work_phase(filter, cloud, building, &particles);
    }
    return filter->phase != INSOLE_PARTICLES_IDLE;
}

insole_status_t insole_particle_filter_past(const insole_particle_filter_t *filter,
                                            const insole_cloud_t *cloud, uint32_t strides_ago,
                                            insole_spot_t *mean)
{
    if (!filter || !cloud) {
        return INSOLE_ERR_NULL;
    }
    if (!filter->has_fix || filter->phase != INSOLE_PARTICLES_IDLE ||
        strides_ago > filter->since_start || strides_ago >= cloud->past_strides) {
        return INSOLE_ERR_STATE;
    }
    return insole_cloud_recall(cloud, filter->since_start - strides_ago, mean);
}
