/* SPDX-License-Identifier: MIT */
#include "foot_estimator.h"

#include <stdlib.h>
#include <string.h>

#include "convert.h"
#include "memory.h"

/* Fixes that are smoothed together, and how many of them wait for the next window: at 200 Hz 164 s
 * and 41 s, far longer than a later stance reaches back. */
enum { SMOOTH_FIXES = 32768, SMOOTH_KEEP = 8192 };

/* More than a foot makes, and more than a sensor gives, in a second of lag. */
enum { LAG_STRIDES = 4, LAG_FIXES = 2000 };

/* At a desk all the work is done at once. */
static const uint32_t whole_work = UINT32_MAX;

/* ---- init ------------------------------------------------------------------------------- */

static void lend_rows(foot_estimator_t *estimator, insole_real_t lag_s)
{
    insole_late_row_t *rows = NULL;
    uint32_t count = 0u;
    if (lag_s > INSOLE_R(0.0)) {
        count = (1u + (uint32_t)ceil((double)lag_s)) * LAG_FIXES;
        rows = memory_new(count, sizeof *rows);
    }
    (void)insole_foot_late_init(&estimator->late, rows, count);
}

static void lend_memory(foot_estimator_t *estimator, insole_real_t lag_s, int32_t start_fixes)
{
    insole_fusion_memory_t *memory = &estimator->memory;
    memory->count = estimator->setup.particles;
    memory->particles = memory_new(memory->count, sizeof *memory->particles);
    (void)insole_fusion_ranges_init(&estimator->ranges);
    memory->ranges = &estimator->ranges;
    memory->steps = &insole_step_weighing_calls;
    (void)insole_fusion_start_init(&estimator->start, start_fixes);
    memory->starter = (insole_fusion_starter_t){insole_fusion_start_hear, &estimator->start};
    if (lag_s > INSOLE_R(0.0)) {
        memory->past_strides = 2u + (uint32_t)ceil((double)lag_s) * LAG_STRIDES;
        memory->past =
            memory_new((size_t)memory->count * memory->past_strides, sizeof *memory->past);
    }
}

static void set_up_smoothing(foot_estimator_t *estimator)
{
    estimator->nodes = memory_new(SMOOTH_FIXES, sizeof *estimator->nodes);
    estimator->fixes = memory_new(SMOOTH_FIXES, sizeof *estimator->fixes);
    (void)insole_foot_smooth_init(&estimator->past, estimator->nodes, estimator->fixes,
                                  SMOOTH_FIXES);
}

static void set_method(insole_foot_fusion_config_t *config, method_t method)
{
    if (method_is_first_order(method)) {
        config->foot.method = method == METHOD_PDR ? INSOLE_FOOT_PDR : INSOLE_FOOT_INS;
    } else {
        config->method = method == METHOD_BEST        ? INSOLE_FUSION_BEST
                         : method == METHOD_TWO_ORDER ? INSOLE_FUSION_TWO_ORDER
                                                      : INSOLE_FUSION_WIFI;
    }
}

/* The caller's building, with the settings of this run. */
static bool take_building(foot_estimator_t *estimator)
{
    const settings_t *settings = estimator->setup.settings;
    if (estimator->setup.building != NULL) {
        estimator->building = *estimator->setup.building;
    }
    estimator->building.propagation = &settings->propagation;
    estimator->building.rss_fix = &settings->fusion.rss_fix;
    return estimator->building.plan != NULL || estimator->building.ap_count > 0u;
}

bool foot_estimator_init(foot_estimator_t *estimator, const estimator_setup_t *setup)
{
    insole_foot_fusion_config_t config = setup->settings->fusion;
    memset(estimator, 0, sizeof *estimator);
    estimator->setup = *setup;
    estimator->radio_row.state = INSOLE_FIX_SEARCH;
    bool knows_building = take_building(estimator);
    set_method(&config, setup->method);
    estimator->is_fused =
        setup->method == METHOD_TWO_ORDER || (setup->method == METHOD_BEST && knows_building);
    if (!estimator->is_fused && setup->method != METHOD_WIFI) {
        if (setup->is_smooth) {
            set_up_smoothing(estimator);
        }
        return insole_foot_tracker_init(&estimator->fusion.foot, &config.foot) == INSOLE_OK;
    }
    lend_memory(estimator, config.lag_s, config.start_fixes);
    lend_rows(estimator, config.lag_s);
    return insole_propagation_check(&setup->settings->propagation) == INSOLE_OK &&
           insole_foot_fusion_init(&estimator->fusion, &config, &estimator->memory,
                                   &estimator->building, setup->seed) == INSOLE_OK;
}

void foot_estimator_free(foot_estimator_t *estimator)
{
    radio_group_free(&estimator->radio);
    free(estimator->memory.particles);
    free(estimator->memory.past);
    free(estimator->late.rows);
    free(estimator->nodes);
    free(estimator->fixes);
}

static bool is_wifi(const foot_estimator_t *estimator)
{
    return estimator->setup.method == METHOD_WIFI;
}

/* ---- records in ------------------------------------------------------------------------- */

static void push_start(foot_estimator_t *estimator, const record_t *record)
{
    insole_start_t start = estimator_start(record);
    if (estimator->is_fused) {
        (void)insole_foot_fusion_start(&estimator->fusion, &start);
    } else {
        (void)insole_foot_tracker_start(&estimator->fusion.foot, &start);
    }
}

static void push_imu(foot_estimator_t *estimator, const record_t *record)
{
    bool has_leapt = estimator->has_imu && record->t_us - estimator->imu_us > RADIO_AHEAD_US;
    estimator->has_imu = true;
    estimator->imu_us = record->t_us;
    if (is_wifi(estimator)) {
        estimator->is_due = !has_leapt;
        return;
    }
    insole_imu_t imu = estimator_imu(record, estimator->setup.settings);
    (void)insole_foot_tracker_imu(&estimator->fusion.foot, &imu);
}

/* A fix of `wifi` is of the time when the scan came; else it is told when it was heard. */
static void push_scan(foot_estimator_t *estimator, const radio_group_t *radio)
{
    insole_scan_t scan = {to_library_us(radio->t_us) - (is_wifi(estimator) ? 0u : radio->age_us),
                          radio->rss, (uint32_t)radio->rss_count};
    estimator->counts.scans++;
    (void)insole_foot_fusion_scan(&estimator->fusion, &scan);
}

static void push_ranges(foot_estimator_t *estimator, const radio_group_t *radio)
{
    for (size_t i = 0u; i < radio->range_count; i++) {
        radio->range[i].t_us = to_library_us(radio->t_us);
    }
    estimator->counts.ranges += radio->range_count;
    (void)insole_foot_fusion_ranges(&estimator->fusion, radio->range, (uint32_t)radio->range_count);
}

static void hand_on_radio(foot_estimator_t *estimator)
{
    const radio_group_t *radio = &estimator->radio;
    bool is_wild = estimator->has_imu && radio->t_us - estimator->imu_us > RADIO_AHEAD_US;
    estimator->counts.wild += is_wild ? 1u : 0u;
    if (!is_wild && radio->range_count > 0u) {
        push_ranges(estimator, radio);
    }
    if (!is_wild && radio->rss_count > 0u &&
        !(is_wifi(estimator) && estimator->fusion.radio.is_new)) {
        push_scan(estimator, radio);
    }
    radio_group_clear(&estimator->radio);
}

static bool uses_radio(const foot_estimator_t *estimator)
{
    return (estimator->is_fused || is_wifi(estimator)) && estimator->building.ap_count > 0u;
}

void foot_estimator_push(foot_estimator_t *estimator, const record_t *record)
{
    if (radio_group_ends(&estimator->radio, record)) {
        hand_on_radio(estimator);
    }
    if (record->kind == RECORD_IMU) {
        push_imu(estimator, record);
    } else if (record->kind == RECORD_START) {
        push_start(estimator, record);
    } else if ((record->kind == RECORD_RSS || record->kind == RECORD_RANGE) &&
               uses_radio(estimator)) {
        radio_group_add(&estimator->radio, record);
    }
}

void foot_estimator_finish(foot_estimator_t *estimator)
{
    if (!radio_group_is_empty(&estimator->radio)) {
        hand_on_radio(estimator);
    }
    if (estimator->is_fused) {
        (void)insole_foot_fusion_finish(&estimator->fusion);
    } else {
        (void)insole_foot_tracker_finish(&estimator->fusion.foot);
    }
}

/* ---- fixes out -------------------------------------------------------------------------- */

static void remember(foot_estimator_t *estimator)
{
    const insole_foot_tracker_t *foot = &estimator->fusion.foot;
    if (insole_foot_smooth_push(&estimator->past, foot, &estimator->fix) == INSOLE_ERR_ROOM) {
        (void)insole_foot_smooth_run(&estimator->past, SMOOTH_KEEP);
        estimator->is_held = true;
    }
}

static bool step_first_order(foot_estimator_t *estimator)
{
    if (insole_foot_tracker_next(&estimator->fusion.foot, &estimator->fix) != INSOLE_OK) {
        return false;
    }
    static const foot_news_t none;
    foot_events_watch(&estimator->events, &estimator->fusion, none, to_log_us(estimator->fix.t_us));
    if (estimator->nodes != NULL) {
        remember(estimator);
    } else {
        estimator->has_fix = true;
    }
    return true;
}

/* Time of the newest fix of the first order: with a lag the one that leaves is older. */
static int64_t newest_us(const foot_estimator_t *estimator)
{
    const insole_foot_late_t *late = &estimator->late;
    bool lags = late->count > 0u;
    return to_log_us(lags ? late->rows[(late->first + late->count - 1u) % late->room].fix.t_us
                          : estimator->fix.t_us);
}

static bool step_fused(foot_estimator_t *estimator)
{
    insole_foot_fusion_t *fusion = &estimator->fusion;
    uint32_t fixes = fusion->foot.counts.fixes, starts = fusion->counts.starts;
    estimator->has_fix =
        insole_foot_lag_next(&estimator->late, fusion, &estimator->fix) == INSOLE_OK;
    bool has_work = fusion->working;
    foot_news_t news = foot_events_news(fusion, starts);
    estimator->counts.worked_in += news.has_scan || news.has_ranges ? 1u : 0u;
    while (insole_foot_fusion_work(fusion, whole_work)) {
    }
    bool has_moved = fusion->foot.counts.fixes != fixes;
    if (has_moved) {
        foot_events_watch(&estimator->events, fusion, news, newest_us(estimator));
    }
    return estimator->has_fix || has_work || has_moved;
}

/* Where radio last said, as of now. */
static void hold_radio(foot_estimator_t *estimator)
{
    track_row_t *row = &estimator->radio_row;
    row->t_us = estimator->imu_us;
    if (row->state == INSOLE_FIX_TRACK && row->t_us - estimator->radio_us > RADIO_FRESH_US) {
        row->state = INSOLE_FIX_COAST;
    }
    estimator->is_due = false;
}

static bool step_wifi(foot_estimator_t *estimator)
{
    if (insole_foot_fusion_next(&estimator->fusion, &estimator->fix) == INSOLE_OK) {
        estimator_row(&estimator->fix, &estimator->radio_row);
        estimator->radio_us = estimator->radio_row.t_us;
        estimator->counts.worked_in++;
    } else if (estimator->is_due) {
        hold_radio(estimator);
    } else {
        return false;
    }
    estimator->has_fix = true;
    return true;
}

bool foot_estimator_step(foot_estimator_t *estimator)
{
    if (is_wifi(estimator)) {
        return step_wifi(estimator);
    }
    return estimator->is_fused ? step_fused(estimator) : step_first_order(estimator);
}

/* A fix that found no room is remembered once the older ones have left. */
static bool take_smooth(foot_estimator_t *estimator, insole_fix_t *fix)
{
    if (insole_foot_smooth_take(&estimator->past, fix) == INSOLE_OK) {
        return true;
    }
    if (estimator->is_held) {
        estimator->is_held = false;
        (void)insole_foot_smooth_push(&estimator->past, &estimator->fusion.foot, &estimator->fix);
    }
    return false;
}

bool foot_estimator_take(foot_estimator_t *estimator, track_row_t *fix)
{
    insole_fix_t smoothed;
    bool is_smooth = estimator->nodes != NULL && take_smooth(estimator, &smoothed);
    if (!is_smooth && !estimator->has_fix) {
        return false;
    }
    if (is_wifi(estimator)) {
        *fix = estimator->radio_row;
    } else {
        estimator_row(is_smooth ? &smoothed : &estimator->fix, fix);
    }
    estimator->has_fix = false;
    return true;
}

void foot_estimator_settle(foot_estimator_t *estimator)
{
    if (estimator->nodes != NULL) {
        (void)insole_foot_smooth_run(&estimator->past, 0u);
    }
}

bool foot_estimator_event(foot_estimator_t *estimator, event_t *event)
{
    return foot_events_take(&estimator->events, event);
}

bool foot_estimator_is_placed(const foot_estimator_t *estimator)
{
    return is_wifi(estimator) ? estimator->fusion.radio.has_fix
                              : estimator->is_fused && estimator->fusion.particles.has_fix;
}
