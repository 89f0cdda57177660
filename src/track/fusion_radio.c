/* SPDX-License-Identifier: MIT */
#include "insole/track/fusion_radio.h"

#include <stddef.h>
#include <string.h>

#include "insole/base/fastmath.h"

#define ZERO INSOLE_R(0.0)
#define HALF INSOLE_R(0.5)

/* Ranges have more in common than their sigma tells. */
#define RANGE_TAIL_DOF INSOLE_R(2.0)

bool insole_fusion_radio_has_aps(const insole_fusion_site_t *site)
{
    return site && site->building && site->building->aps && site->building->ap_count > 0u &&
           site->building->propagation;
}

static insole_status_t check(const insole_fusion_radio_t *radio, const insole_fusion_site_t *site)
{
    if (!radio || !site) {
        return INSOLE_ERR_NULL;
    }
    return insole_fusion_radio_has_aps(site) ? INSOLE_OK : INSOLE_ERR_STATE;
}

static void take_fix(insole_fusion_radio_t *radio, const insole_anchor_fix_t *fix, uint64_t t_us,
                     insole_spot_t n_m)
{
    radio->fix = *fix;
    radio->fix_us = t_us;
    radio->fix_n_m = n_m;
    radio->has_fix = true;
    radio->is_new = true;
}

/* ---- scans ------------------------------------------------------------------------------ */

static void keep_reading(insole_fusion_scan_t *scan, const insole_rss_t *reading)
{
    uint32_t at = scan->count;
    if (at < INSOLE_FUSION_HEARD) {
        scan->count++;
    } else if (scan->readings[--at].rss_dbm >= reading->rss_dbm) {
        return;
    }
    for (; at > 0u && scan->readings[at - 1u].rss_dbm < reading->rss_dbm; at--) {
        scan->readings[at] = scan->readings[at - 1u];
    }
    scan->readings[at] = *reading;
}

static void keep_scan(insole_fusion_scan_t *kept, const insole_scan_t *scan,
                      const insole_building_t *building)
{
    kept->t_us = scan->t_us;
    kept->count = 0u;
    for (uint32_t i = 0u; i < scan->count; i++) {
        if (scan->readings[i].id < building->ap_count &&
            insole_is_finite(scan->readings[i].rss_dbm)) {
            keep_reading(kept, &scan->readings[i]);
        }
    }
    kept->waits = kept->count > 0u;
}

INSOLE_COLD static void solve_scan(insole_fusion_radio_t *radio, const insole_fusion_site_t *site,
                                   const insole_fusion_scan_t *scan)
{
    const insole_building_t *b = site->building;
    insole_anchor_fix_t fix;
    if (insole_rss_fix_solve(site->rss_fix, b->propagation, b->aps, b->ap_count, scan->readings,
                             scan->count, &fix) == INSOLE_OK) {
        take_fix(radio, &fix, scan->t_us, scan->n_m);
    }
}

INSOLE_COLD insole_status_t insole_fusion_radio_hear(insole_fusion_radio_t *radio,
                                                     const insole_fusion_site_t *site,
                                                     const insole_scan_t *scan)
{
    if (!scan || (!scan->readings && scan->count > 0u)) {
        return INSOLE_ERR_NULL;
    }
    insole_status_t status = check(radio, site);
    if (status != INSOLE_OK) {
        return status;
    }
    insole_fusion_scan_t *kept = &radio->arrived;
    radio->counts.scans++;
    /* An earlier one must not be kept waiting by one whose stamp leapt ahead. */
    if (kept->waits && kept->t_us <= scan->t_us) {
        radio->counts.unused++;
        return INSOLE_OK;
    }
    radio->counts.unused += kept->waits ? 1u : 0u;
    keep_scan(kept, scan, site->building);
    radio->counts.unknown += kept->waits ? 0u : 1u;
    if (site->at_once && kept->waits) {
        kept->waits = false;
        solve_scan(radio, site, kept);
    }
    return INSOLE_OK;
}

/* ---- ranges ----------------------------------------------------------------------------- */

static bool is_usable(const insole_fusion_site_t *site, const insole_range_t *range)
{
    return range->id < site->building->ap_count && range->range_m >= ZERO &&
           range->range_m <= site->range_fix->range_max_m &&
           !(range->sigma_m > site->range_fix->told_max_m) &&
           insole_ap_has_place(&site->building->aps[range->id]);
}

/* The oldest, or those whose place is known, make room. */
static void drop_ranges(insole_fusion_ranges_t *ranges, uint32_t count)
{
    for (uint32_t i = count; i < ranges->count; i++) {
        ranges->range[i - count] = ranges->range[i];
        ranges->n_m[i - count] = ranges->n_m[i];
    }
    ranges->count -= count;
    ranges->placed -= ranges->placed < count ? ranges->placed : count;
}

static void keep_range(insole_fusion_radio_t *radio, const insole_range_t *range)
{
    insole_fusion_ranges_t *kept = radio->ranges;
    if (kept->count == INSOLE_FUSION_RANGES) {
        drop_ranges(kept, 1u);
        radio->counts.unused++;
    }
    kept->range[kept->count++] = *range;
}

struct insole_fusion_range_calls {
    void (*solve)(insole_fusion_radio_t *radio, const insole_fusion_site_t *site,
                  const insole_range_t *ranges, uint32_t count, insole_spot_t n_m);
    void (*tell)(const insole_range_t *range, const insole_fusion_site_t *site, insole_spot_t since,
                 insole_evidence_t *evidence);
};

/* What ranges of one moment say, and what is remembered of those before. */
INSOLE_COLD static void solve_ranges(insole_fusion_radio_t *radio, const insole_fusion_site_t *site,
                                     const insole_range_t *ranges, uint32_t count,
                                     insole_spot_t n_m)
{
    const insole_building_t *b = site->building;
    uint64_t t_us = ranges[0].t_us;
    insole_anchor_fix_t before = radio->fix, fix;
    bool remembers = radio->has_fix && t_us >= radio->fix_us &&
                     insole_range_fix_age(site->range_fix, &before,
                                          insole_seconds(radio->fix_us, t_us)) == INSOLE_OK;
    if (insole_range_fix_solve(site->range_fix, b->aps, b->ap_count, ranges, count,
                               remembers ? &before : NULL, &fix) == INSOLE_OK) {
        take_fix(radio, &fix, t_us, n_m);
    }
}

INSOLE_COLD static void tell_range(const insole_range_t *range, const insole_fusion_site_t *site,
                                   insole_spot_t since, insole_evidence_t *evidence)
{
    const insole_range_fix_config_t *config = site->range_fix;
    const insole_ap_t *ap = &site->building->aps[range->id];
    insole_real_t told_m = range->sigma_m > ZERO ? range->sigma_m : ZERO;
    insole_real_t var_m2 = insole_square(config->sigma_m) + insole_square(told_m);
    insole_evidence_range_t told = {{ap->x_m, ap->y_m},
                                    since,
                                    insole_max(ZERO, range->range_m - config->bias_m),
                                    insole_sqrt(var_m2),
                                    RANGE_TAIL_DOF};
    (void)insole_evidence_range(evidence, &told);
}

insole_status_t insole_fusion_ranges_init(insole_fusion_ranges_t *ranges)
{
    static const insole_fusion_range_calls_t calls = {solve_ranges, tell_range};
    if (!ranges) {
        return INSOLE_ERR_NULL;
    }
    memset(ranges, 0, sizeof *ranges);
    ranges->calls = &calls;
    return INSOLE_OK;
}

INSOLE_COLD insole_status_t insole_fusion_radio_range(insole_fusion_radio_t *radio,
                                                      const insole_fusion_site_t *site,
                                                      const insole_range_t *ranges, uint32_t count)
{
    if (!ranges && count > 0u) {
        return INSOLE_ERR_NULL;
    }
    insole_status_t status = check(radio, site);
    if (status != INSOLE_OK) {
        return status;
    }
    if (!radio->ranges) {
        return INSOLE_ERR_STATE;
    }
    for (uint32_t i = 0u; i < count; i++) {
        bool usable = is_usable(site, &ranges[i]);
        radio->counts.ranges++;
        radio->counts.unknown += usable ? 0u : 1u;
        if (usable && !site->at_once) {
            keep_range(radio, &ranges[i]);
        }
    }
    if (count > 0u && site->at_once) {
        static const insole_spot_t nowhere = {ZERO, ZERO};
        radio->ranges->calls->solve(radio, site, ranges, count, nowhere);
    }
    return INSOLE_OK;
}

/* ---- where the foot was, and on to the particles ---------------------------------------- */

static bool is_next_moment(const insole_fusion_ranges_t *ranges, uint64_t t_us)
{
    return ranges->placed < ranges->count && t_us >= ranges->range[ranges->placed].t_us;
}

/* The ranges of one moment find their place, and give one. */
INSOLE_COLD static void place_moment(insole_fusion_radio_t *radio, const insole_fusion_site_t *site,
                                     insole_spot_t n_m)
{
    insole_fusion_ranges_t *ranges = radio->ranges;
    const insole_range_t *first = &ranges->range[ranges->placed];
    uint32_t count = 0u, left = ranges->count - ranges->placed;
    for (; count < left && first[count].t_us == first->t_us; count++) {
        ranges->n_m[ranges->placed + count] = n_m;
    }
    ranges->placed += count;
    ranges->calls->solve(radio, site, first, count, n_m);
}

INSOLE_COLD static void place_scan(insole_fusion_radio_t *radio, const insole_fusion_site_t *site,
                                   insole_spot_t n_m)
{
    radio->counts.unused += radio->scan.waits ? 1u : 0u;
    radio->scan = radio->arrived;
    radio->scan.n_m = n_m;
    radio->arrived.waits = false;
    solve_scan(radio, site, &radio->scan);
}

insole_status_t insole_fusion_radio_place(insole_fusion_radio_t *radio,
                                          const insole_fusion_site_t *site, uint64_t t_us,
                                          insole_spot_t n_m)
{
    insole_status_t status = check(radio, site);
    if (status == INSOLE_ERR_NULL || !insole_spot_is_finite(n_m)) {
        return status == INSOLE_ERR_NULL ? status : INSOLE_ERR_VALUE;
    }
    if (status == INSOLE_OK && radio->arrived.waits && t_us >= radio->arrived.t_us) {
        place_scan(radio, site, n_m);
    }
    while (status == INSOLE_OK && radio->ranges && is_next_moment(radio->ranges, t_us)) {
        place_moment(radio, site, n_m);
    }
    return INSOLE_OK;
}

static uint32_t placed_of(const insole_fusion_radio_t *radio)
{
    return radio->ranges ? radio->ranges->placed : 0u;
}

bool insole_fusion_radio_waits(const insole_fusion_radio_t *radio, uint64_t before_us)
{
    return radio && ((radio->scan.waits && radio->scan.t_us <= before_us) ||
                     (placed_of(radio) > 0u && radio->ranges->range[0].t_us <= before_us));
}

/* The strongest access point, if it is near: its range by (11), weighed by (39). */
static void tell_nearest(const insole_fusion_scan_t *scan, const insole_fusion_site_t *site,
                         insole_spot_t since, insole_evidence_t *evidence)
{
    const insole_building_t *b = site->building;
    uint32_t reading;
    insole_rss_range_t range;
    if (insole_propagation_nearest(b->aps, b->ap_count, scan->readings, scan->count, &reading) !=
        INSOLE_OK) {
        return;
    }
    const insole_ap_t *ap = &b->aps[scan->readings[reading].id];
    if (insole_propagation_range(b->propagation, ap, scan->readings[reading].rss_dbm, ZERO, HALF,
                                 &range) == INSOLE_OK) {
        insole_evidence_range_t told = {
            {ap->x_m, ap->y_m}, since, range.range_m, site->sigma_range_m, ZERO};
        (void)insole_evidence_range(evidence, &told);
    }
}

static void drop_placed(insole_fusion_radio_t *radio)
{
    if (radio->ranges) {
        drop_ranges(radio->ranges, radio->ranges->placed);
    }
}

INSOLE_COLD insole_status_t insole_fusion_radio_tell(insole_fusion_radio_t *radio,
                                                     const insole_fusion_site_t *site,
                                                     insole_spot_t end_n_m,
                                                     insole_evidence_t *evidence)
{
    if (!radio || !site || !evidence) {
        return INSOLE_ERR_NULL;
    }
    insole_fusion_scan_t *scan = &radio->scan;
    if (scan->waits && site->nearest_only) {
        tell_nearest(scan, site, insole_spot_sub(end_n_m, scan->n_m), evidence);
    } else if (scan->waits) {
        (void)insole_evidence_scan(evidence, scan->readings, scan->count,
                                   insole_spot_sub(end_n_m, scan->n_m));
    }
    scan->waits = false;
    for (uint32_t i = 0u; i < placed_of(radio); i++) {
        const insole_fusion_ranges_t *ranges = radio->ranges;
        insole_spot_t since = insole_spot_sub(end_n_m, ranges->n_m[i]);
        ranges->calls->tell(&ranges->range[i], site, since, evidence);
    }
    drop_placed(radio);
    return INSOLE_OK;
}

INSOLE_COLD void insole_fusion_radio_forget(insole_fusion_radio_t *radio)
{
    if (radio) {
        radio->counts.unused += (radio->scan.waits ? 1u : 0u) + placed_of(radio);
        radio->scan.waits = false;
        radio->has_fix = false;
        drop_placed(radio);
    }
}

/* ---- radio alone ------------------------------------------------------------------------ */

INSOLE_COLD insole_status_t insole_fusion_radio_fix(const insole_fusion_radio_t *radio,
                                                    insole_fix_t *fix)
{
    if (!radio || !fix) {
        return INSOLE_ERR_NULL;
    }
    if (!radio->has_fix) {
        return INSOLE_ERR_STATE;
    }
    fix->position_m.x = radio->fix.x_m;
    fix->position_m.y = radio->fix.y_m;
    fix->var_x_m2 = radio->fix.P.xx;
    fix->cov_xy_m2 = radio->fix.P.xy;
    fix->var_y_m2 = radio->fix.P.yy;
    return INSOLE_OK;
}

INSOLE_COLD insole_status_t insole_fusion_radio_take(insole_fusion_radio_t *radio,
                                                     insole_fix_t *fix)
{
    if (!radio || !fix) {
        return INSOLE_ERR_NULL;
    }
    if (!radio->is_new) {
        return INSOLE_ERR_STATE;
    }
    memset(fix, 0, sizeof *fix);
    fix->state = INSOLE_FIX_TRACK;
    fix->var_heading_rad2 = insole_square(INSOLE_PI);
    fix->t_us = radio->fix_us;
    (void)insole_fusion_radio_fix(radio, fix);
    radio->is_new = false;
    return INSOLE_OK;
}

INSOLE_COLD insole_status_t insole_fusion_radio_mix(const insole_fusion_radio_t *radio,
                                                    insole_spot_t n_m, insole_turn_t turn,
                                                    insole_real_t var_m2, insole_fix_t *fix)
{
    if (!radio || !fix) {
        return INSOLE_ERR_NULL;
    }
    if (!(var_m2 >= ZERO) || !insole_is_finite(var_m2) || !insole_spot_is_finite(n_m)) {
        return INSOLE_ERR_VALUE;
    }
    insole_real_t radio_m2 = HALF * (radio->fix.P.xx + radio->fix.P.yy);
    if (!radio->has_fix || !(radio_m2 > ZERO)) {
        return INSOLE_ERR_STATE;
    }
    insole_real_t share = var_m2 / (var_m2 + radio_m2);
    insole_spot_t gone = insole_turn_way(turn, insole_spot_sub(n_m, radio->fix_n_m));
    fix->position_m.x += share * (radio->fix.x_m + gone.x_m - fix->position_m.x);
    fix->position_m.y += share * (radio->fix.y_m + gone.y_m - fix->position_m.y);
    fix->var_x_m2 = fix->var_y_m2 = share * radio_m2;
    fix->cov_xy_m2 = ZERO;
    return INSOLE_OK;
}
