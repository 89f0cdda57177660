/* SPDX-License-Identifier: MIT */
#include "insole/fuse/step_cloud.h"

#include <stddef.h>
#include <string.h>

#define ZERO INSOLE_R(0.0)

/* So many particles' worth of work at a time, where all must be done. */
static const uint32_t SLICE = 1000000u;

const insole_step_cloud_config_t insole_step_cloud_defaults = {
    INSOLE_STEP_CLOUD_KEYS(INSOLE_CONFIG_DEFAULT) INSOLE_PARTICLE_FILTER_PHONE};

const insole_step_cloud_config_t insole_step_cloud_plain = {
    INSOLE_STEP_CLOUD_KEYS(INSOLE_CONFIG_DEFAULT) INSOLE_PARTICLE_FILTER_PHONE_PLAIN};

const insole_step_cloud_config_t insole_step_cloud_wpf = {.process = INSOLE_STEP_CLOUD_CONSTANT,
                                                          .measurement = INSOLE_STEP_CLOUD_CONSTANT,
                                                          .sigma_fix_m = INSOLE_R(6.0),
                                                          .particles =
                                                              INSOLE_PARTICLE_FILTER_PHONE_WPF};

const insole_step_cloud_config_t insole_step_cloud_zee = {.process = INSOLE_STEP_CLOUD_CONSTANT,
                                                          .measurement = INSOLE_STEP_CLOUD_TOLD,
                                                          .sigma_fix_m = INSOLE_R(4.0),
                                                          .particles =
                                                              INSOLE_PARTICLE_FILTER_PHONE_ZEE};

static insole_status_t refuse(insole_step_cloud_t *cloud, insole_status_t why)
{
    cloud->refused++;
    return why;
}

static insole_status_t check_own(const insole_step_cloud_config_t *config)
{
    typedef insole_step_cloud_config_t config_t;
    static const insole_config_range_t ranges[] = {INSOLE_STEP_CLOUD_KEYS(INSOLE_CONFIG_RANGE)};
    return insole_config_check(config, ranges, sizeof ranges / sizeof ranges[0]);
}

static insole_status_t check(const insole_step_cloud_config_t *config, const insole_cloud_t *memory)
{
    if (check_own(config) != INSOLE_OK) {
        return INSOLE_ERR_VALUE;
    }
    insole_status_t status = insole_cloud_check(memory);
    if (status == INSOLE_OK && config->particles.bias_sigma_m > ZERO && !memory->bias) {
        return INSOLE_ERR_NULL;
    }
    return status == INSOLE_OK ? insole_particle_config_check(&config->particles) : status;
}

insole_status_t insole_step_cloud_init(insole_step_cloud_t *cloud,
                                       const insole_step_cloud_config_t *config,
                                       const insole_cloud_t *memory,
                                       const insole_floor_plan_t *plan, uint64_t seed)
{
    if (!cloud || !config || !memory) {
        return INSOLE_ERR_NULL;
    }
    insole_status_t status = check(config, memory);
    if (status != INSOLE_OK) {
        return status;
    }
    memset(cloud, 0, sizeof *cloud);
    cloud->process = config->process;
    cloud->measurement = config->measurement;
    cloud->sigma_fix_m = config->sigma_fix_m;
    cloud->cloud = *memory;
    cloud->building.plan = plan;
    cloud->ring = insole_ring(INSOLE_STEP_CLOUD_WAITING);
    return insole_particle_filter_init_steps(&cloud->filter, &config->particles,
                                             &insole_step_weighing_calls, seed);
}

insole_status_t insole_step_cloud_start(insole_step_cloud_t *cloud,
                                        const insole_step_origin_t *origin)
{
    if (!cloud || !origin) {
        return INSOLE_ERR_NULL;
    }
    if (!insole_spot_is_start(origin->spot, origin->cov_m2, origin->offset_rad) ||
        !(origin->var_offset_rad2 >= ZERO)) {
        return refuse(cloud, INSOLE_ERR_VALUE);
    }
    insole_particle_origin_t from = {{origin->t_us, origin->spot, origin->cov_m2, {ZERO, ZERO}},
                                     origin->is_radio,
                                     origin->offset_rad,
                                     insole_sqrt(origin->var_offset_rad2)};
    const insole_particle_filter_config_t *config = &cloud->filter.config;
    insole_cloud_source_t source = insole_particle_origin_source(
        &from, cloud->filter.steps.radio.sigma_m, config->sigma_scale);
    insole_status_t status = insole_particle_filter_start_from(
        &cloud->filter, &cloud->cloud, &source, origin->is_radio ? &from.at : NULL);
    if (status != INSOLE_OK) {
        return refuse(cloud, status);
    }
    cloud->has_fix = origin->is_radio;
    cloud->fix_us = origin->t_us;
    cloud->ring = insole_ring(INSOLE_STEP_CLOUD_WAITING);
    return INSOLE_OK;
}

insole_status_t insole_step_cloud_start_anywhere(insole_step_cloud_t *cloud)
{
    if (!cloud) {
        return INSOLE_ERR_NULL;
    }
    if (!cloud->building.plan) {
        return refuse(cloud, INSOLE_ERR_STATE);
    }
    insole_cloud_source_t source =
        insole_cloud_source_everywhere(cloud->building.plan, cloud->filter.config.sigma_scale);
    insole_status_t status =
        insole_particle_filter_start_from(&cloud->filter, &cloud->cloud, &source, NULL);
    if (status != INSOLE_OK) {
        return refuse(cloud, status);
    }
    cloud->has_fix = false;
    cloud->ring = insole_ring(INSOLE_STEP_CLOUD_WAITING);
    return INSOLE_OK;
}

/* ---- the queue ---- */

static bool is_started(const insole_step_cloud_t *cloud)
{
    return cloud->filter.count > 0u;
}

static bool is_idle(const insole_step_cloud_t *cloud)
{
    return cloud->filter.phase == INSOLE_PARTICLES_IDLE;
}

/* The particle filter takes the oldest. */
static void hand_on(insole_step_cloud_t *cloud)
{
    const insole_step_cloud_news_t *oldest =
        &cloud->waiting[insole_ring_slot(&cloud->ring, cloud->ring.begin)];
    const insole_pace_t *pace = &oldest->pace;
    insole_evidence_t news;
    insole_evidence_clear(&news);
    if (oldest->kind == INSOLE_STEP_CLOUD_PACE) {
        insole_evidence_stride(&news, pace->length_m, pace->heading_rad, ZERO);
        insole_evidence_scatter(&news, pace->var_length_m2,
                                insole_min(pace->var_heading_rad2, INSOLE_HEADING_MOST_R2));
    } else if (oldest->kind == INSOLE_STEP_CLOUD_FIX) {
        insole_evidence_fix(&news, &oldest->fix);
    } else {
        insole_evidence_compass(&news, oldest->offset_rad, oldest->sigma_rad);
    }
    insole_particle_filter_begin(&cloud->filter, &cloud->building, &news);
    insole_ring_pop(&cloud->ring);
}

/* Ends what is in work, and begins the oldest that waits. */
static void make_room(insole_step_cloud_t *cloud)
{
    while (insole_particle_filter_work(&cloud->filter, &cloud->cloud, &cloud->building, SLICE)) {
    }
    if (insole_ring_count(&cloud->ring) > 0u) {
        hand_on(cloud);
    }
}

static insole_status_t tell(insole_step_cloud_t *cloud, const insole_step_cloud_news_t *news)
{
    if (insole_ring_is_full(&cloud->ring)) {
        make_room(cloud);
    }
    cloud->waiting[insole_ring_push(&cloud->ring)] = *news;
    return INSOLE_OK;
}

insole_status_t insole_step_cloud_step(insole_step_cloud_t *cloud, const insole_pace_t *pace)
{
    if (!cloud || !pace) {
        return INSOLE_ERR_NULL;
    }
    if (insole_pace_check(pace) != INSOLE_OK) {
        return refuse(cloud, INSOLE_ERR_VALUE);
    }
    if (!is_started(cloud)) {
        return refuse(cloud, INSOLE_ERR_STATE);
    }
    insole_step_cloud_news_t news = {.kind = INSOLE_STEP_CLOUD_PACE, .pace = *pace};
    if (cloud->process == INSOLE_STEP_CLOUD_CONSTANT) {
        news.pace.var_length_m2 = ZERO;
        news.pace.var_heading_rad2 = ZERO;
    }
    return tell(cloud, &news);
}

insole_status_t insole_step_cloud_fix(insole_step_cloud_t *cloud, const insole_spot_fix_t *fix)
{
    if (!cloud || !fix) {
        return INSOLE_ERR_NULL;
    }
    if (insole_spot_fix_check(fix) != INSOLE_OK) {
        return refuse(cloud, INSOLE_ERR_VALUE);
    }
    if (!is_started(cloud)) {
        return refuse(cloud, INSOLE_ERR_STATE);
    }
    if (cloud->has_fix && fix->t_us <= cloud->fix_us) {
        return refuse(cloud, INSOLE_ERR_TIME);
    }
    insole_step_cloud_news_t news = {.kind = INSOLE_STEP_CLOUD_FIX, .fix = *fix};
    if (cloud->measurement == INSOLE_STEP_CLOUD_CONSTANT) {
        news.fix.cov_m2 = insole_sym2_circle(insole_square(cloud->sigma_fix_m));
    }
    cloud->has_fix = true;
    cloud->fix_us = fix->t_us;
    return tell(cloud, &news);
}

insole_status_t insole_step_cloud_compass(insole_step_cloud_t *cloud, insole_real_t offset_rad,
                                          insole_real_t sigma_rad)
{
    if (!cloud) {
        return INSOLE_ERR_NULL;
    }
    insole_evidence_t tried;
    insole_evidence_clear(&tried);
    if (insole_evidence_compass(&tried, offset_rad, sigma_rad) != INSOLE_OK) {
        return refuse(cloud, INSOLE_ERR_VALUE);
    }
    if (!is_started(cloud)) {
        return refuse(cloud, INSOLE_ERR_STATE);
    }
    insole_step_cloud_news_t news = {
        .kind = INSOLE_STEP_CLOUD_COMPASS, .offset_rad = offset_rad, .sigma_rad = sigma_rad};
    return tell(cloud, &news);
}

insole_status_t insole_step_cloud_rss(insole_step_cloud_t *cloud, const insole_rss_weigh_t *rss,
                                      insole_spot_t since)
{
    if (!cloud || !rss) {
        return INSOLE_ERR_NULL;
    }
    insole_evidence_t news;
    insole_evidence_clear(&news);
    insole_status_t status = insole_evidence_rss(&news, rss, since);
    status = status == INSOLE_OK && !is_started(cloud) ? INSOLE_ERR_STATE : status;
    if (status != INSOLE_OK) {
        return refuse(cloud, status);
    }
    while (insole_step_cloud_work(cloud, SLICE)) {
    }
    insole_particle_filter_begin(&cloud->filter, &cloud->building, &news);
    while (insole_step_cloud_work(cloud, SLICE)) {
    }
    return INSOLE_OK;
}

insole_status_t insole_step_cloud_bias(insole_step_cloud_t *cloud, insole_real_t sigma_m)
{
    if (!cloud) {
        return INSOLE_ERR_NULL;
    }
    insole_status_t status = insole_radio_bias_limit(&cloud->filter.steps.radio, sigma_m);
    return status == INSOLE_OK ? INSOLE_OK : refuse(cloud, status);
}

/* ---- the work ---- */

bool insole_step_cloud_work(insole_step_cloud_t *cloud, uint32_t particles)
{
    if (!cloud || !is_started(cloud)) {
        return false;
    }
    if (is_idle(cloud) && insole_ring_count(&cloud->ring) > 0u && particles > 0u) {
        hand_on(cloud);
    }
    insole_particle_filter_work(&cloud->filter, &cloud->cloud, &cloud->building, particles);
    return !is_idle(cloud) || insole_ring_count(&cloud->ring) > 0u;
}

insole_status_t insole_step_cloud_answer(const insole_step_cloud_t *cloud,
                                         insole_step_cloud_answer_t *answer)
{
    if (!cloud || !answer) {
        return INSOLE_ERR_NULL;
    }
    const insole_cloud_fix_t *fix = &cloud->filter.fix;
    if (!cloud->filter.has_fix) {
        return INSOLE_ERR_STATE;
    }
    answer->spot = insole_spot(fix->x_m, fix->y_m);
    answer->cov_m2 = insole_spot_cov(insole_sym2(fix->var_x_m2, fix->cov_xy_m2, fix->var_y_m2));
    answer->offset_rad = fix->offset_rad;
    answer->var_offset_rad2 = fix->var_offset_rad2;
    answer->scale = fix->scale;
    answer->waiting = insole_ring_count(&cloud->ring) + (is_idle(cloud) ? 0u : 1u);
    return INSOLE_OK;
}

/* ---- for a tracker ---------------------------------------------------------------------- */

static insole_status_t begin_state(void *state, const insole_step_filter_begin_t *begin)
{
    if (!begin) {
        return INSOLE_ERR_NULL;
    }
    insole_step_cloud_t *cloud = state;
    if (!cloud) {
        return INSOLE_ERR_NULL;
    }
    const insole_step_origin_t origin = {
        begin->t_us,
        begin->spot,
        insole_step_filter_less_bias(begin, cloud->filter.steps.radio.sigma_m),
        begin->offset_rad,
        begin->var_offset_rad2,
        begin->from_radio};
    return insole_step_cloud_start(cloud, &origin);
}

static insole_status_t step_state(void *state, uint64_t t_us, const insole_pace_t *pace)
{
    (void)t_us;
    return insole_step_cloud_step(state, pace);
}

static insole_status_t fix_state(void *state, const insole_spot_fix_t *fix)
{
    return insole_step_cloud_fix(state, fix);
}

static insole_status_t bias_state(void *state, insole_real_t sigma_m)
{
    return insole_step_cloud_bias(state, sigma_m);
}

static insole_status_t compass_state(void *state, insole_real_t offset_rad, insole_real_t sigma_rad)
{
    return insole_step_cloud_compass(state, offset_rad, sigma_rad);
}

static bool work_state(void *state, uint32_t particles)
{
    return insole_step_cloud_work(state, particles);
}

static insole_status_t answer_state(const void *state, insole_step_filter_answer_t *answer)
{
    insole_step_cloud_answer_t known;
    if (!answer) {
        return INSOLE_ERR_NULL;
    }
    insole_status_t status = insole_step_cloud_answer(state, &known);
    if (status == INSOLE_OK) {
        *answer = (insole_step_filter_answer_t){known.spot, known.cov_m2, known.offset_rad,
                                                known.var_offset_rad2, known.scale};
    }
    return status;
}

const insole_step_filter_calls_t insole_step_cloud_calls = {.start = begin_state,
                                                            .step = step_state,
                                                            .fix = fix_state,
                                                            .bias = bias_state,
                                                            .compass = compass_state,
                                                            .work = work_state,
                                                            .answer = answer_state};

static insole_status_t search_state(void *state, uint64_t t_us)
{
    (void)t_us;
    return insole_step_cloud_start_anywhere(state);
}

static insole_status_t pass_over(void *state, const insole_spot_fix_t *fix)
{
    insole_step_cloud_t *cloud = state;
    if (!cloud || !fix) {
        return INSOLE_ERR_NULL;
    }
    return is_started(cloud) ? INSOLE_OK : refuse(cloud, INSOLE_ERR_STATE);
}

const insole_step_filter_calls_t insole_step_cloud_zee_calls = {.start = begin_state,
                                                                .start_anywhere = search_state,
                                                                .step = step_state,
                                                                .fix = pass_over,
                                                                .compass = compass_state,
                                                                .work = work_state,
                                                                .answer = answer_state};
