/* SPDX-License-Identifier: MIT */
#include "insole/track/phone_tracker.h"

#include <stddef.h>
#include <string.h>

#include "insole/move/magnetic.h"

#define ZERO INSOLE_R(0.0)

/* A scan so far ahead of the samples has a stamp that cannot be. */
static const uint64_t SCAN_AHEAD_US = 60000000u;

static bool has_filter(const insole_phone_parts_t *parts)
{
    return parts->filter.calls != NULL;
}

INSOLE_COLD insole_status_t insole_phone_tracker_init(insole_phone_tracker_t *tracker,
                                                      const insole_phone_tracker_config_t *config,
                                                      const insole_phone_parts_t *parts,
                                                      const insole_radio_map_t *map)
{
    if (!tracker || !config || !parts) {
        return INSOLE_ERR_NULL;
    }
    insole_phone_radio_t radio;
    if (insole_phone_config_check(config) != INSOLE_OK ||
        insole_phone_radio_init(&radio, &parts->solver, map, config->radio_late_s) != INSOLE_OK ||
        (!has_filter(parts) && !insole_phone_radio_can_hear(&radio))) {
        return INSOLE_ERR_VALUE;
    }
    if (!has_filter(parts)) {
        memset(&tracker->place, 0, sizeof tracker->place);
    } else if (insole_phone_place_init(&tracker->place, &config->place, &config->auto_start,
                                       parts->circles, &parts->filter,
                                       insole_phone_radio_can_hear(&radio)) != INSOLE_OK) {
        return INSOLE_ERR_VALUE;
    }
    memcpy(&tracker->config, config, sizeof tracker->config); /* both begin with the list */
    tracker->parts = *parts;
    tracker->radio = radio;
    tracker->counts = (insole_phone_counts_t){0u};
    tracker->t_us = 0u;
    tracker->starts = 0u;
    tracker->trusts_pointing = tracker->has_time = tracker->coasting = false;
    tracker->finished = tracker->has_fix = false;
    tracker->fix = (insole_fix_t){0u};
    (void)insole_phone_walk_init(&tracker->walk, &config->walk, &parts->guide);
    (void)insole_screen_init(&tracker->screen, &config->screen);
    (void)insole_still_bias_init(&tracker->still_bias, &config->still_bias);
    (void)insole_attitude_init(&tracker->attitude, &config->attitude);
    return insole_phone_compass_init(&tracker->compass, &config->compass);
}

static insole_status_t answer(insole_phone_tracker_t *t, insole_status_t status)
{
    t->counts.refused += status == INSOLE_OK ? 0u : 1u;
    return status;
}

INSOLE_COLD insole_status_t insole_phone_tracker_start(insole_phone_tracker_t *tracker,
                                                       const insole_start_t *start)
{
    if (!tracker) {
        return INSOLE_ERR_NULL;
    }
    return answer(tracker, has_filter(&tracker->parts)
                               ? insole_phone_place_tell(&tracker->place, start)
                               : INSOLE_ERR_STATE);
}

/* ---- steps ------------------------------------------------------------------------------ */

/* The first that are shown have the direction of a start: should they prove to be no steps, the
 * phone was carried there all the same. */
static void direct_start(insole_phone_tracker_t *t)
{
    const insole_phone_walk_t *walk = &t->walk;
    if (insole_spot_dot(walk->shown, walk->shown) > ZERO && insole_phone_walk_is_directed(walk) &&
        insole_phone_place_wants_direction(&t->place, walk->shown_end_us)) {
        (void)insole_phone_place_direct(&t->place, walk->shown_end_us,
                                        insole_atan2(walk->shown.y_m, walk->shown.x_m));
    }
}

static void note_starts(insole_phone_tracker_t *t)
{
    if (t->place.starts != t->starts) {
        t->starts = t->place.starts;
        t->trusts_pointing = !t->walk.lie.is_askew;
    }
}

/* A phone that was taken to point ahead points aside. */
INSOLE_COLD static void turn_aside(insole_phone_tracker_t *t, uint64_t t_us,
                                   const insole_pace_t *pace)
{
    const insole_phone_lie_t *lie = &t->walk.lie;
    insole_spot_t way = insole_phone_way_since(&t->walk.way, lie->since_us);
    insole_phone_aside_t aside = {lie->askew_rad, insole_spot_sub(way, insole_pace_way(pace, ZERO)),
                                  t->trusts_pointing};
    (void)insole_phone_place_turn(&t->place, t_us, &aside);
    t->starts = t->place.starts;
    t->trusts_pointing = false;
}

INSOLE_APART static void count_steps(insole_phone_tracker_t *t, const insole_imu_t *imu)
{
    insole_footfall_t footfall;
    insole_pace_t pace;
    note_starts(t);
    (void)insole_phone_walk_push(&t->walk, &t->attitude, imu);
    bool was_aside = t->walk.lie.is_aside;
    while (insole_phone_walk_next(&t->walk, &footfall, &pace) == INSOLE_OK) {
        t->coasting = false;
        t->counts.steps++;
        if (has_filter(&t->parts)) {
            if (t->walk.lie.is_aside && !was_aside) {
                turn_aside(t, footfall.end_us, &pace);
            }
            was_aside = t->walk.lie.is_aside;
            t->trusts_pointing = t->trusts_pointing && !t->walk.lie.is_ahead;
            (void)insole_phone_place_step(&t->place, footfall.end_us, &pace);
        }
    }
    if (has_filter(&t->parts)) {
        direct_start(t);
    }
}

/* ---- the fix ---------------------------------------------------------------------------- */

static insole_fix_state_t state_of(const insole_phone_tracker_t *t,
                                   const insole_phone_answer_t *known)
{
    insole_real_t var_m2 = known->at.cov_m2.xx + known->at.cov_m2.yy;
    if (!t->attitude.aligned) {
        return INSOLE_FIX_ALIGN;
    }
    if (known->knowledge == INSOLE_PHONE_NOWHERE || known->knowledge == INSOLE_PHONE_GUESSED) {
        return INSOLE_FIX_SEARCH;
    }
    if (var_m2 > insole_square(t->config.lost_sigma_m)) {
        return INSOLE_FIX_LOST;
    }
    if (var_m2 > insole_square(t->config.search_sigma_m)) {
        return INSOLE_FIX_SEARCH;
    }
    return t->coasting ? INSOLE_FIX_COAST : INSOLE_FIX_TRACK;
}

/* The offset; where only a told direction is known, that of what is walked, or faced, gives it. */
static insole_real_t offset_of(const insole_phone_tracker_t *t, const insole_phone_answer_t *known)
{
    if (known->knows_offset) {
        return known->at.offset_rad;
    }
    if (known->knowledge != INSOLE_PHONE_TOLD || !t->place.start.has_heading) {
        return ZERO;
    }
    insole_turn_t from = insole_phone_walk_ahead(&t->walk);
    if (insole_spot_dot(t->walk.shown, t->walk.shown) > ZERO) {
        from.cos = t->walk.shown.x_m;
        from.sin = t->walk.shown.y_m;
    }
    return insole_wrap_pi(t->place.start.heading_rad - insole_atan2(from.sin, from.cos));
}

INSOLE_APART static void fix_by_filter(insole_phone_tracker_t *t, insole_fix_t *fix)
{
    insole_phone_answer_t known;
    (void)insole_phone_place_answer(&t->place, fix->t_us, &known);
    insole_real_t offset_rad = offset_of(t, &known);
    insole_spot_t spot = known.at.spot;
    if (known.knowledge != INSOLE_PHONE_NOWHERE) {
        insole_spot_t shown = insole_turn_way(insole_turn(offset_rad), t->walk.shown);
        spot = insole_spot_add_scaled(spot, known.at.scale, shown);
    }
    fix->position_m = insole_vec3(spot.x_m, spot.y_m, ZERO);
    insole_turn_t ahead = insole_phone_walk_ahead(&t->walk);
    fix->heading_rad = insole_wrap_pi(insole_atan2(ahead.sin, ahead.cos) + offset_rad);
    fix->var_x_m2 = known.at.cov_m2.xx;
    fix->cov_xy_m2 = known.at.cov_m2.xy;
    fix->var_y_m2 = known.at.cov_m2.yy;
    fix->var_heading_rad2 =
        insole_min(t->walk.yaw_rad2 + known.at.var_offset_rad2, INSOLE_HEADING_MOST_R2);
    fix->state = state_of(t, &known);
}

INSOLE_COLD static void fix_by_radio(const insole_phone_tracker_t *t, insole_fix_t *fix)
{
    fix->var_heading_rad2 = INSOLE_HEADING_MOST_R2;
    fix->state = INSOLE_FIX_SEARCH;
    if (t->radio.has_fix) {
        const insole_radio_fix_t *radio = &t->radio.fix;
        uint64_t age_us = fix->t_us > t->radio.t_us ? fix->t_us - t->radio.t_us : 0u;
        bool fresh = insole_seconds(0u, age_us) <= t->config.radio_fresh_s;
        fix->position_m = insole_vec3(radio->spot.x_m, radio->spot.y_m, ZERO);
        fix->var_x_m2 = radio->var_x_m2;
        fix->cov_xy_m2 = radio->cov_xy_m2;
        fix->var_y_m2 = radio->var_y_m2;
        fix->state = fresh ? INSOLE_FIX_TRACK : INSOLE_FIX_COAST;
    }
}

/* ---- samples ---------------------------------------------------------------------------- */

static void cross_gap(insole_phone_tracker_t *t, uint64_t t_us)
{
    insole_real_t gap_s = insole_seconds(t->t_us, t_us);
    if (t->has_time && gap_s > t->config.gap_s) {
        t->counts.gaps++;
        t->coasting = true;
        insole_phone_compass_forget(&t->compass);
        t->place.sight = insole_phone_compass_sight(&t->compass);
        if (has_filter(&t->parts)) {
            (void)insole_phone_place_gap(&t->place, t_us, gap_s);
        }
    }
}

/* Turns with the sample; the bias is that of the last rest. */
static void face(insole_phone_tracker_t *t, const insole_clean_t *clean)
{
    uint32_t rests = t->still_bias.rests;
    insole_still_bias_take(&t->still_bias, &clean->imu);
    if (t->still_bias.rests != rests) {
        (void)insole_attitude_set_bias(&t->attitude, t->still_bias.gyro_bias_radps);
    }
    (void)insole_attitude_push(&t->attitude, t->parts.attitude, &clean->imu,
                               clean->marks & INSOLE_MARK_CLIP);
}

static void take_clean(insole_phone_tracker_t *t, const insole_clean_t *clean)
{
    const insole_fix_t blank = {.t_us = clean->imu.t_us};
    cross_gap(t, clean->imu.t_us);
    face(t, clean);
    count_steps(t, &clean->imu);
    t->t_us = clean->imu.t_us;
    t->has_time = true;
    t->fix = blank;
    if (has_filter(&t->parts)) {
        fix_by_filter(t, &t->fix);
    } else {
        fix_by_radio(t, &t->fix);
    }
    t->has_fix = true;
    t->counts.fixes++;
}

insole_status_t insole_phone_tracker_imu(insole_phone_tracker_t *tracker, const insole_imu_t *imu)
{
    if (!tracker || !imu) {
        return INSOLE_ERR_NULL;
    }
    if (tracker->finished || tracker->has_fix) {
        return answer(tracker, tracker->finished ? INSOLE_ERR_STATE : INSOLE_ERR_ROOM);
    }
    insole_clean_t clean;
    if (insole_screen_push(&tracker->screen, imu, &clean) == INSOLE_OK) {
        take_clean(tracker, &clean);
    }
    return INSOLE_OK;
}

/* What the screen holds back at the end, one by one. */
static void flush(insole_phone_tracker_t *t)
{
    insole_clean_t clean;
    if (t->finished && !t->has_fix && insole_screen_finish(&t->screen, &clean) == INSOLE_OK) {
        take_clean(t, &clean);
    }
}

INSOLE_COLD insole_status_t insole_phone_tracker_finish(insole_phone_tracker_t *tracker)
{
    if (!tracker) {
        return INSOLE_ERR_NULL;
    }
    tracker->finished = true;
    flush(tracker);
    return INSOLE_OK;
}

insole_status_t insole_phone_tracker_mag(insole_phone_tracker_t *tracker, const insole_mag_t *mag)
{
    if (!tracker || !mag) {
        return INSOLE_ERR_NULL;
    }
    insole_real_t azimuth_rad;
    insole_status_t status =
        insole_magnetic_azimuth(&tracker->attitude, mag->field_ut, &azimuth_rad);
    if (status != INSOLE_OK) {
        return answer(tracker, status);
    }
    tracker->counts.magnetic++;
    const insole_magnetic_part_t *magnetic = &tracker->parts.magnetic;
    if (magnetic->push && tracker->parts.attitude) {
        (void)magnetic->push(magnetic->state, &tracker->attitude, tracker->parts.attitude, mag);
    }
    insole_phone_compass_t *compass = &tracker->compass;
    bool is_new =
        insole_phone_compass_push(compass, mag->t_us, insole_vec3_norm(mag->field_ut), azimuth_rad);
    tracker->place.sight = insole_phone_compass_sight(compass);
    if (is_new && has_filter(&tracker->parts)) {
        (void)insole_phone_place_compass(&tracker->place);
    }
    return INSOLE_OK;
}

/* ---- radio ------------------------------------------------------------------------------ */

static void use_fix(insole_phone_tracker_t *t)
{
    const insole_radio_fix_t *told = &t->radio.fix;
    insole_real_t more_m2 = insole_square(t->config.sigma_fix_m);
    insole_spot_fix_t fix = {
        t->radio.t_us, told->spot,
        insole_sym2(told->var_x_m2 + more_m2, told->cov_xy_m2, told->var_y_m2 + more_m2),
        insole_phone_walk_since(&t->walk, t->radio.heard_us)};
    (void)insole_phone_place_fix(&t->place, &fix);
}

/* After one ahead the filter takes none of before; of one long ago the way since is forgotten. */
static bool is_in_time(const insole_phone_tracker_t *t, uint64_t t_us)
{
    bool is_ahead = t->has_time && t_us > t->t_us && t_us - t->t_us > SCAN_AHEAD_US;
    return !has_filter(&t->parts) || (!is_ahead && insole_phone_way_reaches(&t->walk.way, t_us));
}

INSOLE_COLD insole_status_t insole_phone_tracker_scan(insole_phone_tracker_t *tracker,
                                                      const insole_scan_t *scan)
{
    if (!tracker) {
        return INSOLE_ERR_NULL;
    }
    if (scan && !is_in_time(tracker, scan->t_us)) {
        return answer(tracker, INSOLE_ERR_TIME);
    }
    insole_trusted_area_t area;
    const insole_phone_tracker_own_t *c = &tracker->config;
    bool is_known = c->trust_sigmas > ZERO && has_filter(&tracker->parts) &&
                    insole_phone_place_area(&tracker->place, tracker->t_us, c->trust_sigmas,
                                            c->trust_least_m, &area);
    return answer(tracker, insole_phone_radio_hear(&tracker->radio, scan, is_known ? &area : NULL));
}

bool insole_phone_tracker_work(insole_phone_tracker_t *tracker, uint32_t count)
{
    if (!tracker || count == 0u) {
        return false;
    }
    if (tracker->radio.in_work) {
        (void)insole_phone_radio_work(&tracker->radio, count);
        if (insole_phone_radio_take(&tracker->radio) && has_filter(&tracker->parts)) {
            use_fix(tracker);
        }
        return true;
    }
    if (insole_phone_walk_work(&tracker->walk)) {
        return true;
    }
    const insole_step_filter_t *filter = &tracker->parts.filter;
    return filter->calls && filter->calls->work && filter->calls->work(filter->state, count);
}

/* ---- out -------------------------------------------------------------------------------- */

insole_status_t insole_phone_tracker_next(insole_phone_tracker_t *tracker, insole_fix_t *fix)
{
    if (!tracker || !fix) {
        return INSOLE_ERR_NULL;
    }
    if (!tracker->has_fix) {
        return INSOLE_ERR_STATE;
    }
    *fix = tracker->fix;
    tracker->has_fix = false;
    flush(tracker);
    return INSOLE_OK;
}
