/* SPDX-License-Identifier: MIT */
#include "insole/track/phone_place.h"

#include <stddef.h>

#include "insole/track/foot_anchor.h"

#define ZERO INSOLE_R(0.0)
#define HALF INSOLE_R(0.5)
#define ONE  INSOLE_R(1.0)

const insole_phone_place_config_t insole_phone_place_defaults = {
    INSOLE_PHONE_PLACE_KEYS(INSOLE_CONFIG_DEFAULT)};

/* Of a place that is so by definition. */
static const insole_real_t LEAST_SIGMA_M = INSOLE_R(0.001);

static bool is_whole(const insole_step_filter_t *filter)
{
    const insole_step_filter_calls_t *calls = filter->calls;
    return calls && filter->state && calls->start && calls->step && calls->fix && calls->answer;
}

insole_status_t insole_phone_place_check(const insole_phone_place_config_t *config)
{
    typedef insole_phone_place_config_t config_t;
    static const insole_config_range_t ranges[] = {INSOLE_PHONE_PLACE_KEYS(INSOLE_CONFIG_RANGE)};
    return insole_config_check(config, ranges, sizeof ranges / sizeof ranges[0]);
}

insole_status_t insole_phone_place_init(insole_phone_place_t *place,
                                        const insole_phone_place_config_t *config,
                                        const insole_auto_start_config_t *config_start,
                                        const insole_auto_start_circles_t *circles,
                                        const insole_step_filter_t *filter, bool has_radio)
{
    if (!place || !config || !config_start || !filter) {
        return INSOLE_ERR_NULL;
    }
    if (insole_phone_place_check(config) != INSOLE_OK || !is_whole(filter) ||
        insole_auto_start_init(&place->auto_start, config_start, circles) != INSOLE_OK) {
        return INSOLE_ERR_VALUE;
    }
    place->config = *config;
    place->filter = *filter;
    place->has_radio = has_radio;
    place->sight = (insole_phone_sight_t){.is_known = false};
    place->start = (insole_start_t){.t_us = 0u};
    place->has_start = place->is_started = false;
    place->told = (insole_phone_told_t){.fixes = 0u};
    place->starts = place->refused = 0u;
    return INSOLE_OK;
}

INSOLE_COLD insole_status_t insole_phone_place_tell(insole_phone_place_t *place,
                                                    const insole_start_t *start)
{
    if (!place) {
        return INSOLE_ERR_NULL;
    }
    insole_status_t status = insole_foot_anchor_check(start);
    if (status == INSOLE_OK &&
        insole_max(insole_abs(start->x_m), insole_abs(start->y_m)) > INSOLE_SPOT_MOST_M) {
        status = INSOLE_ERR_VALUE;
    }
    if (status != INSOLE_OK) {
        return status;
    }
    place->start = *start;
    place->has_start = true;
    return INSOLE_OK;
}

/* ---- to the filter ---------------------------------------------------------------------- */

static insole_status_t note(insole_phone_place_t *p, insole_status_t status)
{
    p->refused += status == INSOLE_OK ? 0u : 1u;
    return status;
}

static insole_status_t begin(insole_phone_place_t *p, const insole_step_filter_begin_t *at)
{
    insole_status_t status = p->filter.calls->start(p->filter.state, at);
    if (status == INSOLE_OK) {
        p->is_started = true;
        p->starts++;
    }
    return note(p, status);
}

/* Where the filter is now, to be begun anew there; false when nobody knows. */
static bool is_somewhere(const insole_phone_place_t *p, uint64_t t_us,
                         insole_step_filter_begin_t *anew)
{
    insole_step_filter_answer_t now;
    if (!p->is_started || p->filter.calls->answer(p->filter.state, &now) != INSOLE_OK) {
        return false;
    }
    *anew = (insole_step_filter_begin_t){.t_us = t_us,
                                         .spot = now.spot,
                                         .cov_m2 = insole_spot_cov(now.cov_m2),
                                         .offset_rad = now.offset_rad,
                                         .var_offset_rad2 = now.var_offset_rad2};
    return true;
}

static insole_status_t search_anew(insole_phone_place_t *p)
{
    insole_auto_start_config_t config = p->auto_start.config;
    return insole_auto_start_init(&p->auto_start, &config, p->auto_start.circles);
}

static insole_status_t walk(insole_phone_place_t *p, uint64_t t_us, const insole_pace_t *pace)
{
    return note(p, p->filter.calls->step(p->filter.state, t_us, pace));
}

static bool learns_offset(const insole_phone_place_t *p)
{
    return p->filter.calls->compass != NULL;
}

/* ---- a start that was told -------------------------------------------------------------- */

static bool is_reached(const insole_phone_place_t *p, uint64_t t_us)
{
    return p->has_start && t_us >= p->start.t_us;
}

static insole_step_filter_begin_t at_start(const insole_phone_place_t *p, uint64_t t_us)
{
    insole_real_t sigma_m = insole_max(p->start.sigma_m, LEAST_SIGMA_M);
    insole_step_filter_begin_t at = {.t_us = t_us,
                                     .spot = {p->start.x_m, p->start.y_m},
                                     .cov_m2 = insole_sym2_circle(insole_square(sigma_m))};
    return at;
}

bool insole_phone_place_wants_direction(const insole_phone_place_t *place, uint64_t t_us)
{
    return place && is_reached(place, t_us) && place->start.has_heading;
}

INSOLE_COLD insole_status_t insole_phone_place_direct(insole_phone_place_t *place, uint64_t t_us,
                                                      insole_real_t direction_rad)
{
    if (!place) {
        return INSOLE_ERR_NULL;
    }
    if (!insole_phone_place_wants_direction(place, t_us)) {
        return INSOLE_ERR_STATE;
    }
    insole_step_filter_begin_t at = at_start(place, t_us);
    at.offset_rad = insole_wrap_pi(place->start.heading_rad - direction_rad);
    at.var_offset_rad2 = insole_min(insole_square(place->start.sigma_rad), INSOLE_HEADING_MOST_R2);
    place->has_start = false;
    return begin(place, &at);
}

/* The place alone was told. */
static insole_status_t begin_undirected(insole_phone_place_t *p, uint64_t t_us)
{
    insole_step_filter_begin_t at = at_start(p, t_us);
    p->has_start = false;
    if (!p->sight.is_known && !learns_offset(p) && p->has_radio) {
        insole_spot_fix_t fix = {t_us, at.spot, at.cov_m2, {ZERO, ZERO}};
        (void)search_anew(p);
        p->is_started = false;
        return insole_auto_start_fix(&p->auto_start, &fix);
    }
    at.offset_rad = p->sight.is_known ? p->sight.mean_rad : ZERO;
    at.var_offset_rad2 =
        p->sight.is_known ? insole_square(p->sight.sigma_mean_rad) : INSOLE_HEADING_MOST_R2;
    return begin(p, &at);
}

static insole_status_t begin_at_origin(insole_phone_place_t *p, uint64_t t_us)
{
    const insole_step_filter_calls_t *calls = p->filter.calls;
    if (calls->start_anywhere && calls->start_anywhere(p->filter.state, t_us) == INSOLE_OK) {
        p->is_started = true;
        p->starts++;
        return INSOLE_OK;
    }
    const insole_start_t origin = {.t_us = t_us};
    p->start = origin;
    insole_step_filter_begin_t at = at_start(p, t_us);
    return begin(p, &at);
}

INSOLE_COLD insole_status_t insole_phone_place_step(insole_phone_place_t *place, uint64_t t_us,
                                                    const insole_pace_t *pace)
{
    if (!place || !pace) {
        return INSOLE_ERR_NULL;
    }
    if (insole_phone_place_wants_direction(place, t_us)) {
        (void)insole_phone_place_direct(place, t_us, pace->heading_rad);
    } else if (is_reached(place, t_us)) {
        (void)begin_undirected(place, t_us);
    } else if (!place->is_started && !place->has_start && !place->has_radio) {
        (void)begin_at_origin(place, t_us);
    }
    return place->is_started ? walk(place, t_us, pace)
                             : note(place, insole_auto_start_step(&place->auto_start, pace));
}

/* ---- fixes ------------------------------------------------------------------------------ */

static insole_status_t begin_by_fixes(insole_phone_place_t *p, const insole_spot_fix_t *fix)
{
    insole_auto_start_answer_t found;
    if (p->sight.is_known) {
        (void)insole_auto_start_compass(&p->auto_start, p->sight.mean_rad, p->sight.sigma_mean_rad);
    }
    insole_status_t status = insole_auto_start_fix(&p->auto_start, fix);
    if (status != INSOLE_OK || insole_auto_start_answer(&p->auto_start, &found) != INSOLE_OK) {
        return note(p, status);
    }
    bool directs = found.var_offset_rad2 <= insole_square(p->config.direct_sigma_rad);
    if (found.ready || (directs && learns_offset(p))) {
        const insole_step_filter_begin_t at = {
            fix->t_us, found.spot,     found.cov_m2, found.offset_rad, found.var_offset_rad2,
            true,      found.shared_m2};
        return begin(p, &at);
    }
    return INSOLE_OK;
}

/* What is heard of a bias is known before the fix is used. */
static void tell_bias(insole_phone_place_t *p)
{
    insole_real_t sigma_m = p->told.fixes > 0u ? p->config.bias_share * insole_sqrt(p->told.mean_m2)
                                               : INSOLE_SPOT_MOST_M;
    (void)insole_auto_start_bias(&p->auto_start, sigma_m);
    if (p->filter.calls->bias) {
        (void)note(p, p->filter.calls->bias(p->filter.state, sigma_m));
    }
}

/* Of dense fingerprints fixes tell more, and what they share is less. */
static void learn_bias(insole_phone_place_t *p, const insole_spot_fix_t *fix)
{
    insole_phone_told_t *told = &p->told;
    told->fixes += told->fixes < UINT32_MAX ? 1u : 0u;
    insole_real_t var_m2 = HALF * (fix->cov_m2.xx + fix->cov_m2.yy);
    told->mean_m2 += (var_m2 - told->mean_m2) / (insole_real_t)told->fixes;
    tell_bias(p);
}

static insole_status_t use_fix(insole_phone_place_t *p, const insole_spot_fix_t *fix)
{
    return p->is_started ? note(p, p->filter.calls->fix(p->filter.state, fix))
                         : begin_by_fixes(p, fix);
}

INSOLE_COLD insole_status_t insole_phone_place_fix(insole_phone_place_t *place,
                                                   const insole_spot_fix_t *fix)
{
    if (!place || !fix) {
        return INSOLE_ERR_NULL;
    }
    if (is_reached(place, fix->t_us)) {
        return INSOLE_OK;
    }
    if (insole_spot_fix_check(fix) != INSOLE_OK) {
        return use_fix(place, fix); /* is refused */
    }
    insole_phone_told_t before = place->told;
    learn_bias(place, fix);
    insole_status_t status = use_fix(place, fix);
    if (status != INSOLE_OK) {
        place->told = before;
        tell_bias(place);
    }
    return status;
}

INSOLE_COLD insole_status_t insole_phone_place_compass(insole_phone_place_t *place)
{
    if (!place) {
        return INSOLE_ERR_NULL;
    }
    const insole_phone_sight_t *sight = &place->sight;
    if (!place->is_started || !learns_offset(place) || !sight->is_known) {
        return INSOLE_OK;
    }
    return note(place, place->filter.calls->compass(place->filter.state, sight->block_rad,
                                                    sight->sigma_block_rad));
}

/* ---- turns ------------------------------------------------------------------------------ */

INSOLE_COLD insole_status_t insole_phone_place_turn(insole_phone_place_t *place, uint64_t t_us,
                                                    const insole_phone_aside_t *aside)
{
    if (!place) {
        return INSOLE_ERR_NULL;
    }
    insole_step_filter_begin_t anew = {.t_us = t_us};
    bool is_known = is_somewhere(place, t_us, &anew);
    insole_status_t status = insole_phone_aside_turn(&anew, &place->sight, aside);
    if (status != INSOLE_OK) {
        return status;
    }
    if (!place->is_started) {
        return search_anew(place);
    }
    return is_known ? begin(place, &anew) : INSOLE_OK;
}

/* ---- gaps ------------------------------------------------------------------------------- */

INSOLE_COLD insole_status_t insole_phone_place_gap(insole_phone_place_t *place, uint64_t t_us,
                                                   insole_real_t gap_s)
{
    if (!place) {
        return INSOLE_ERR_NULL;
    }
    if (!(gap_s >= ZERO) || !insole_is_finite(gap_s)) {
        return INSOLE_ERR_VALUE;
    }
    insole_step_filter_begin_t anew;
    if (!is_somewhere(place, t_us, &anew)) {
        return INSOLE_OK;
    }
    insole_real_t way_m2 =
        insole_min(insole_square(place->config.sigma_walk_mps * gap_s), INSOLE_SPOT_MOST_M2);
    insole_real_t turn_rad2 = insole_square(place->config.sigma_gap_turn_rad_rts) * gap_s;
    anew.cov_m2 = insole_spot_cov(insole_sym2_add(anew.cov_m2, insole_sym2_circle(way_m2)));
    anew.var_offset_rad2 = insole_min(anew.var_offset_rad2 + turn_rad2, INSOLE_HEADING_MOST_R2);
    return begin(place, &anew);
}

/* ---- the answer ------------------------------------------------------------------------- */

INSOLE_COLD static insole_step_filter_answer_t told_answer(const insole_phone_place_t *p,
                                                           uint64_t t_us)
{
    insole_step_filter_begin_t at = at_start(p, t_us);
    insole_real_t var_rad2 =
        p->start.has_heading ? insole_square(p->start.sigma_rad) : INSOLE_HEADING_MOST_R2;
    insole_step_filter_answer_t answer = {at.spot, at.cov_m2, p->sight.mean_rad, var_rad2, ONE};
    return answer;
}

insole_status_t insole_phone_place_answer(const insole_phone_place_t *place, uint64_t t_us,
                                          insole_phone_answer_t *answer)
{
    if (!place || !answer) {
        return INSOLE_ERR_NULL;
    }
    const insole_phone_answer_t nowhere = {
        .at = {.cov_m2 = insole_sym2_circle(place->has_radio ? INSOLE_SPOT_MOST_M2 : ZERO),
               .var_offset_rad2 = place->has_radio ? INSOLE_HEADING_MOST_R2 : ZERO,
               .scale = ONE}};
    insole_auto_start_answer_t found;
    *answer = nowhere;
    if (is_reached(place, t_us)) {
        answer->knowledge = INSOLE_PHONE_TOLD;
        answer->at = told_answer(place, t_us);
        answer->knows_offset = !place->start.has_heading && place->sight.is_known;
    } else if (place->is_started &&
               place->filter.calls->answer(place->filter.state, &answer->at) == INSOLE_OK) {
        answer->knowledge = INSOLE_PHONE_FILTERED;
        answer->knows_offset = true;
    } else if (insole_auto_start_answer(&place->auto_start, &found) == INSOLE_OK) {
        const insole_step_filter_answer_t at = {found.spot, found.cov_m2, found.offset_rad,
                                                found.var_offset_rad2, ONE};
        answer->knowledge = INSOLE_PHONE_GUESSED;
        answer->at = at;
        answer->knows_offset = true;
    }
    return INSOLE_OK;
}

INSOLE_COLD bool insole_phone_place_area(const insole_phone_place_t *place, uint64_t t_us,
                                         insole_real_t sigmas, insole_real_t least_m,
                                         insole_trusted_area_t *area)
{
    insole_phone_answer_t known;
    return area && insole_phone_place_answer(place, t_us, &known) == INSOLE_OK &&
           known.knowledge == INSOLE_PHONE_FILTERED &&
           insole_trusted_area_around(known.at.spot, known.at.cov_m2.xx, known.at.cov_m2.xy,
                                      known.at.cov_m2.yy, sigmas, least_m, area) == INSOLE_OK;
}
