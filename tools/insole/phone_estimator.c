/* SPDX-License-Identifier: MIT */
#include "phone_estimator.h"

#include <math.h>
#include <string.h>

#include "convert.h"

/* At a desk all the work is done at once. */
static const uint32_t whole_work = UINT32_MAX;

bool phone_estimator_init(phone_estimator_t *estimator, const estimator_setup_t *setup)
{
    memset(estimator, 0, sizeof *estimator);
    estimator->setup = *setup;
    return phone_parts_init(&estimator->parts, setup) &&
           insole_phone_tracker_init(&estimator->tracker, &estimator->parts.config,
                                     &estimator->parts.library, estimator->parts.map) == INSOLE_OK;
}

void phone_estimator_free(phone_estimator_t *estimator)
{
    radio_group_free(&estimator->radio);
    phone_parts_free(&estimator->parts);
}

static bool is_radio_alone(const phone_estimator_t *estimator)
{
    return method_is_radio_alone(estimator->setup.method);
}

/* ---- events ----------------------------------------------------------------------------- */

static event_t *add_event(phone_estimator_t *estimator, event_kind_t kind, int64_t begin_us,
                          int64_t end_us)
{
    event_t *event = &estimator->events[estimator->event_count++];
    memset(event, 0, sizeof *event);
    event->kind = kind;
    event->begin_us = begin_us;
    event->end_us = end_us;
    return event;
}

static double offset_rad(const phone_estimator_t *estimator)
{
    insole_phone_answer_t known;
    const insole_phone_tracker_t *tracker = &estimator->tracker;
    return tracker->parts.filter.calls != NULL &&
                   insole_phone_place_answer(&tracker->place, tracker->t_us, &known) == INSOLE_OK
               ? (double)known.at.offset_rad
               : 0.0;
}

/* The steps that were told since. */
static void watch_steps(phone_estimator_t *estimator)
{
    const insole_phone_way_t *way = &estimator->tracker.walk.way;
    double turn_rad = offset_rad(estimator);
    uint32_t fresh = way->ring.end - estimator->steps;
    uint32_t kept = insole_ring_count(&way->ring);
    for (uint32_t back = fresh < kept ? fresh : kept; back > 0u; back--) {
        const insole_phone_way_step_t *step =
            &way->steps[insole_ring_slot(&way->ring, way->ring.end - back)];
        double x_m = (double)step->way.x_m, y_m = (double)step->way.y_m;
        event_t *event =
            add_event(estimator, EVENT_STEP, to_log_us(step->begin_us), to_log_us(step->end_us));
        event->length_m = hypot(x_m, y_m);
        event->heading_rad = remainder(atan2(y_m, x_m) + turn_rad, 6.283185307179586);
    }
    int32_t position = estimator->tracker.walk.lie.position;
    if (position != INSOLE_PHONE_NO_POSITION) {
        estimator->carried[position] += fresh;
    }
    estimator->steps = way->ring.end;
}

static void watch(phone_estimator_t *estimator, int64_t t_us)
{
    const insole_phone_tracker_t *tracker = &estimator->tracker;
    if (estimator->event_taken == estimator->event_count) {
        estimator->event_taken = estimator->event_count = 0;
    }
    if (tracker->walk.way.ring.end != estimator->steps) {
        watch_steps(estimator);
    }
    if (tracker->place.starts != estimator->starts) {
        (void)add_event(estimator, EVENT_START, t_us, t_us);
        estimator->starts = tracker->place.starts;
    }
    if (tracker->radio.fixes != estimator->reached) {
        (void)add_event(estimator, EVENT_SCAN, t_us, t_us);
        estimator->reached = tracker->radio.fixes;
        estimator->counts.worked_in++;
    }
}

bool phone_estimator_event(phone_estimator_t *estimator, event_t *event)
{
    if (estimator->event_taken == estimator->event_count) {
        return false;
    }
    *event = estimator->events[estimator->event_taken++];
    return true;
}

/* ---- records in ------------------------------------------------------------------------- */

static void work(phone_estimator_t *estimator)
{
    while (insole_phone_tracker_work(&estimator->tracker, whole_work)) {
    }
}

/* Without an IMU nobody else tells the time. */
static void fix_at_scan(phone_estimator_t *estimator, int64_t t_us)
{
    const insole_phone_radio_t *radio = &estimator->tracker.radio;
    if (!is_radio_alone(estimator) || estimator->has_imu || radio->fixes == estimator->reached) {
        return;
    }
    const insole_fix_t blank = {.t_us = to_library_us(t_us)};
    estimator->fix = blank;
    estimator->fix.position_m.x = radio->fix.spot.x_m;
    estimator->fix.position_m.y = radio->fix.spot.y_m;
    estimator->fix.var_x_m2 = radio->fix.var_x_m2;
    estimator->fix.cov_xy_m2 = radio->fix.cov_xy_m2;
    estimator->fix.var_y_m2 = radio->fix.var_y_m2;
    estimator->fix.var_heading_rad2 = INSOLE_HEADING_MOST_R2;
    estimator->fix.state = INSOLE_FIX_TRACK;
    estimator->has_fix = true;
}

static void push_scan(phone_estimator_t *estimator)
{
    const radio_group_t *radio = &estimator->radio;
    bool is_wild = estimator->has_imu && radio->t_us - estimator->imu_us > RADIO_AHEAD_US;
    insole_scan_t scan = {to_library_us(radio->t_us), radio->rss, (uint32_t)radio->rss_count};
    estimator->counts.wild += is_wild ? 1u : 0u;
    if (!is_wild && radio->rss_count > 0u) {
        /* the group's ages count from where the youngest reading was heard */
        for (size_t i = 0u; i < radio->rss_count; i++) {
            radio->rss[i].age_us += radio->age_us;
        }
        estimator->counts.scans++;
        (void)insole_phone_tracker_scan(&estimator->tracker, &scan);
        work(estimator);
        fix_at_scan(estimator, radio->t_us);
        watch(estimator, radio->t_us);
    }
    radio_group_clear(&estimator->radio);
}

static void push_imu(phone_estimator_t *estimator, const record_t *record)
{
    insole_imu_t imu = estimator_imu(record, estimator->setup.settings);
    estimator->has_imu = true;
    estimator->imu_us = record->t_us;
    (void)insole_phone_tracker_imu(&estimator->tracker, &imu);
}

static void push_mag(phone_estimator_t *estimator, const record_t *record)
{
    const double *v = record->value;
    insole_mag_t mag = {to_library_us(record->t_us), {to_real(v[0]), to_real(v[1]), to_real(v[2])}};
    (void)insole_phone_tracker_mag(&estimator->tracker, &mag);
}

void phone_estimator_push(phone_estimator_t *estimator, const record_t *record)
{
    if (radio_group_ends(&estimator->radio, record)) {
        push_scan(estimator);
    }
    if (record->kind == RECORD_IMU) {
        push_imu(estimator, record);
    } else if (record->kind == RECORD_MAG) {
        push_mag(estimator, record);
    } else if (record->kind == RECORD_START) {
        insole_start_t start = estimator_start(record);
        (void)insole_phone_tracker_start(&estimator->tracker, &start);
    } else if (record->kind == RECORD_RSS && estimator->parts.map != NULL) {
        radio_group_add(&estimator->radio, record);
    }
}

void phone_estimator_finish(phone_estimator_t *estimator)
{
    if (!radio_group_is_empty(&estimator->radio)) {
        push_scan(estimator);
    }
    (void)insole_phone_tracker_finish(&estimator->tracker);
}

/* ---- fixes out -------------------------------------------------------------------------- */

bool phone_estimator_step(phone_estimator_t *estimator)
{
    bool has_fix = insole_phone_tracker_next(&estimator->tracker, &estimator->fix) == INSOLE_OK;
    estimator->has_fix = estimator->has_fix || has_fix;
    work(estimator);
    watch(estimator, estimator->imu_us);
    return estimator->has_fix || estimator->event_taken < estimator->event_count;
}

bool phone_estimator_take(phone_estimator_t *estimator, track_row_t *fix)
{
    if (!estimator->has_fix) {
        return false;
    }
    estimator_row(&estimator->fix, fix);
    estimator->has_fix = false;
    return true;
}

bool phone_estimator_is_placed(const phone_estimator_t *estimator)
{
    return estimator->parts.map != NULL && estimator->tracker.radio.has_fix;
}
