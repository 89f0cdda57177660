/* SPDX-License-Identifier: MIT */
#include "phone_rival.h"

#include <stdlib.h>
#include <string.h>

#include "memory.h"

void phone_rival_init(phone_rival_t *rival, insole_kde_fix_t *kde_fix,
                      insole_step_cloud_t *step_cloud, uint32_t points)
{
    memset(rival, 0, sizeof *rival);
    rival->kde_fix = kde_fix;
    rival->step_cloud = step_cloud;
    rival->points = points;
    rival->log_weights = memory_new(points > 0u ? points : 1u, sizeof *rival->log_weights);
}

void phone_rival_free(phone_rival_t *rival)
{
    free(rival->log_weights);
}

/* ---- solver ----------------------------------------------------------------------------- */

static insole_status_t begin(void *state, const insole_radio_map_t *map,
                             const insole_trusted_area_t *area, const insole_rss_t *readings,
                             uint32_t count)
{
    phone_rival_t *rival = state;
    insole_status_t status =
        insole_rss_weigh_begin(&rival->rss, map, rival->log_weights, rival->points,
                               rival->kde_fix->config.unheard_dbm, readings, count);
    return status == INSOLE_OK ? insole_kde_fix_begin(rival->kde_fix, map, area, readings, count)
                               : status;
}

static bool work(void *state, const insole_radio_map_t *map, uint32_t points)
{
    phone_rival_t *rival = state;
    return insole_rss_weigh_work(&rival->rss, points) ||
           insole_kde_fix_work(rival->kde_fix, map, points);
}

static insole_status_t finish(void *state, const insole_radio_map_t *map, insole_radio_fix_t *fix)
{
    phone_rival_t *rival = state;
    return insole_kde_fix_finish(rival->kde_fix, map, fix);
}

const insole_radio_solver_calls_t phone_rival_solver = {begin, work, finish};

/* ---- filter ----------------------------------------------------------------------------- */

static insole_status_t start(void *state, const insole_step_filter_begin_t *at)
{
    phone_rival_t *rival = state;
    return insole_step_cloud_calls.start(rival->step_cloud, at);
}

static insole_status_t step(void *state, uint64_t t_us, const insole_pace_t *pace)
{
    phone_rival_t *rival = state;
    return insole_step_cloud_calls.step(rival->step_cloud, t_us, pace);
}

/* The scan that the fix was made of has just been compared with the map. */
static insole_status_t weigh(void *state, const insole_spot_fix_t *fix)
{
    phone_rival_t *rival = state;
    return insole_step_cloud_rss(rival->step_cloud, &rival->rss, fix->since);
}

static bool work_in(void *state, uint32_t particles)
{
    phone_rival_t *rival = state;
    return insole_step_cloud_work(rival->step_cloud, particles);
}

static insole_status_t answer(const void *state, insole_step_filter_answer_t *known)
{
    const phone_rival_t *rival = state;
    return insole_step_cloud_calls.answer(rival->step_cloud, known);
}

const insole_step_filter_calls_t phone_rival_filter = {
    .start = start, .step = step, .fix = weigh, .work = work_in, .answer = answer};
