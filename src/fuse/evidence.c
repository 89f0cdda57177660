/* SPDX-License-Identifier: MIT */
#include "insole/fuse/evidence.h"

#include <stddef.h>
#include <string.h>

#define ZERO         INSOLE_R(0.0)
#define HALF         INSOLE_R(0.5)
#define ONE          INSOLE_R(1.0)
#define SIGMA_MIN_M  INSOLE_R(1e-6)
#define LENGTH_MAX_M INSOLE_R(100.0)

#define VAR_LENGTH_MAX_M2    INSOLE_R(100.0)
#define VAR_HEADING_MAX_RAD2 INSOLE_R(10.0)
#define COMPASS_MIN_RAD      INSOLE_R(0.001)
#define COMPASS_MAX_RAD      INSOLE_R(100.0)

/* Squares of more would not be finite; nothing is gained by telling such weights apart. */
#define SIGMAS_MAX INSOLE_R(1e12)

void insole_evidence_clear(insole_evidence_t *evidence)
{
    if (evidence) {
        memset(evidence, 0, sizeof *evidence);
    }
}

static bool is_length(insole_real_t length_m)
{
    return length_m >= ZERO && length_m <= LENGTH_MAX_M;
}

static bool is_sigma(insole_real_t sigma_m)
{
    return sigma_m >= SIGMA_MIN_M && insole_is_finite(sigma_m);
}

static bool is_zero_or_more(insole_real_t x)
{
    return x >= ZERO && insole_is_finite(x);
}

static bool is_range(const insole_evidence_range_t *range)
{
    return insole_spot_is_finite(range->from) && insole_spot_is_finite(range->since) &&
           is_zero_or_more(range->range_m) && is_sigma(range->sigma_m) &&
           is_zero_or_more(range->dof);
}

static bool is_stride(insole_real_t length_m, insole_real_t heading_rad, insole_real_t turn_rad)
{
    return is_length(length_m) && insole_is_finite(heading_rad) && insole_is_finite(turn_rad);
}

static bool is_position(insole_spot_t position, insole_real_t sigma_m)
{
    return insole_spot_is_finite(position) && is_sigma(sigma_m);
}

static bool is_scatter(insole_real_t var_length_m2, insole_real_t var_heading_rad2)
{
    return var_length_m2 >= ZERO && var_length_m2 <= VAR_LENGTH_MAX_M2 &&
           var_heading_rad2 >= ZERO && var_heading_rad2 <= VAR_HEADING_MAX_RAD2;
}

static bool is_compass(insole_real_t offset_rad, insole_real_t sigma_rad)
{
    return insole_is_finite(offset_rad) && sigma_rad >= COMPASS_MIN_RAD &&
           sigma_rad <= COMPASS_MAX_RAD;
}

static bool is_pointed(const insole_evidence_t *evidence)
{
    return evidence->readings || evidence->reading_count == 0 || !evidence->has_scan;
}

static bool are_ranges(const insole_evidence_t *evidence)
{
    bool fit = evidence->ranges <= INSOLE_EVIDENCE_RANGES;
    for (uint32_t i = 0; fit && i < evidence->ranges; i++) {
        fit = is_range(&evidence->range[i]);
    }
    return fit;
}

/* What a phone tells. */
static bool is_phone(const insole_evidence_t *evidence)
{
    return is_scatter(evidence->var_length_m2, evidence->var_heading_rad2) &&
           (!evidence->fix || insole_spot_fix_check(evidence->fix) == INSOLE_OK) &&
           (!evidence->rss || insole_spot_is_finite(evidence->rss_since)) &&
           (!evidence->has_compass ||
            is_compass(evidence->compass_rad, evidence->sigma_compass_rad));
}

INSOLE_COLD insole_status_t insole_evidence_check(const insole_evidence_t *evidence)
{
    if (!evidence || !is_pointed(evidence)) {
        return INSOLE_ERR_NULL;
    }
    bool stride = is_stride(evidence->length_m, evidence->heading_rad, evidence->turn_rad);
    bool position = is_position(evidence->position, evidence->sigma_m);
    bool scan = insole_spot_is_finite(evidence->since);
    bool fits = (stride || !evidence->has_stride) && (position || !evidence->has_position) &&
                (scan || !evidence->has_scan);
    return fits && are_ranges(evidence) && is_phone(evidence) ? INSOLE_OK : INSOLE_ERR_VALUE;
}

INSOLE_COLD insole_status_t insole_evidence_stride(insole_evidence_t *evidence,
                                                   insole_real_t length_m,
                                                   insole_real_t heading_rad,
                                                   insole_real_t turn_rad)
{
    if (!evidence) {
        return INSOLE_ERR_NULL;
    }
    if (!is_stride(length_m, heading_rad, turn_rad)) {
        return INSOLE_ERR_VALUE;
    }
    evidence->length_m = length_m;
    evidence->heading_rad = insole_wrap_pi(heading_rad);
    evidence->turn_rad = insole_wrap_pi(turn_rad);
    evidence->has_stride = true;
    return INSOLE_OK;
}

INSOLE_COLD insole_status_t insole_evidence_scatter(insole_evidence_t *evidence,
                                                    insole_real_t var_length_m2,
                                                    insole_real_t var_heading_rad2)
{
    if (!evidence) {
        return INSOLE_ERR_NULL;
    }
    if (!is_scatter(var_length_m2, var_heading_rad2)) {
        return INSOLE_ERR_VALUE;
    }
    evidence->var_length_m2 = var_length_m2;
    evidence->var_heading_rad2 = var_heading_rad2;
    return INSOLE_OK;
}

INSOLE_COLD insole_status_t insole_evidence_position(insole_evidence_t *evidence,
                                                     insole_spot_t position, insole_real_t sigma_m)
{
    if (!evidence) {
        return INSOLE_ERR_NULL;
    }
    if (!is_position(position, sigma_m)) {
        return INSOLE_ERR_VALUE;
    }
    evidence->position = position;
    evidence->sigma_m = sigma_m;
    evidence->has_position = true;
    return INSOLE_OK;
}

INSOLE_COLD insole_status_t insole_evidence_range(insole_evidence_t *evidence,
                                                  const insole_evidence_range_t *range)
{
    if (!evidence || !range) {
        return INSOLE_ERR_NULL;
    }
    if (!is_range(range)) {
        return INSOLE_ERR_VALUE;
    }
    if (evidence->ranges >= INSOLE_EVIDENCE_RANGES) {
        return INSOLE_ERR_ROOM;
    }
    evidence->range[evidence->ranges++] = *range;
    return INSOLE_OK;
}

INSOLE_COLD insole_status_t insole_evidence_scan(insole_evidence_t *evidence,
                                                 const insole_rss_t *readings, uint32_t count,
                                                 insole_spot_t since)
{
    if (!evidence || (!readings && count > 0)) {
        return INSOLE_ERR_NULL;
    }
    if (!insole_spot_is_finite(since)) {
        return INSOLE_ERR_VALUE;
    }
    evidence->readings = readings;
    evidence->reading_count = count;
    evidence->since = since;
    evidence->has_scan = true;
    return INSOLE_OK;
}

INSOLE_COLD insole_status_t insole_evidence_fix(insole_evidence_t *evidence,
                                                const insole_spot_fix_t *fix)
{
    if (!evidence || !fix) {
        return INSOLE_ERR_NULL;
    }
    if (insole_spot_fix_check(fix) != INSOLE_OK) {
        return INSOLE_ERR_VALUE;
    }
    evidence->fix = fix;
    return INSOLE_OK;
}

INSOLE_COLD insole_status_t insole_evidence_compass(insole_evidence_t *evidence,
                                                    insole_real_t offset_rad,
                                                    insole_real_t sigma_rad)
{
    if (!evidence) {
        return INSOLE_ERR_NULL;
    }
    if (!is_compass(offset_rad, sigma_rad)) {
        return INSOLE_ERR_VALUE;
    }
    evidence->compass_rad = insole_wrap_pi(offset_rad);
    evidence->sigma_compass_rad = sigma_rad;
    evidence->has_compass = true;
    return INSOLE_OK;
}

INSOLE_COLD insole_status_t insole_evidence_rss(insole_evidence_t *evidence,
                                                const insole_rss_weigh_t *rss, insole_spot_t since)
{
    if (!evidence || !rss) {
        return INSOLE_ERR_NULL;
    }
    if (!insole_spot_is_finite(since)) {
        return INSOLE_ERR_VALUE;
    }
    if (!insole_rss_weigh_is_ready(rss)) {
        return INSOLE_ERR_STATE;
    }
    evidence->rss = rss;
    evidence->rss_since = since;
    return INSOLE_OK;
}

INSOLE_COLD void insole_evidence_turn(insole_evidence_t *evidence, insole_turn_t turn)
{
    if (!evidence) {
        return;
    }
    for (uint32_t i = 0; i < evidence->ranges; i++) {
        evidence->range[i].since = insole_turn_way(turn, evidence->range[i].since);
    }
    evidence->since = insole_turn_way(turn, evidence->since);
    evidence->readings = NULL;
    evidence->fix = NULL;
    evidence->rss = NULL;
}

static insole_real_t in_sigmas(insole_real_t off_m, insole_real_t sigma_m)
{
    return insole_min(insole_abs(off_m / sigma_m), SIGMAS_MAX);
}

static insole_real_t log_of_position(const insole_evidence_t *evidence, insole_real_t x_m,
                                     insole_real_t y_m)
{
    insole_real_t x = in_sigmas(evidence->position.x_m - x_m, evidence->sigma_m);
    insole_real_t y = in_sigmas(evidence->position.y_m - y_m, evidence->sigma_m);
    return -HALF * (x * x + y * y); /* [TwoOrder (34)] */
}

static insole_real_t log_of_range(const insole_evidence_range_t *range, insole_real_t x_m,
                                  insole_real_t y_m)
{
    insole_real_t x = x_m - range->since.x_m - range->from.x_m;
    insole_real_t y = y_m - range->since.y_m - range->from.y_m;
    insole_real_t distance_m = insole_sqrt(x * x + y * y); /* [TwoOrder (38)] */
    insole_real_t off = in_sigmas(range->range_m - distance_m, range->sigma_m);
    if (range->dof > ZERO) {
        return -HALF * (range->dof + ONE) * insole_log(ONE + off * off / range->dof);
    }
    return -HALF * off * off; /* [TwoOrder (39)] */
}

insole_real_t insole_evidence_log_weight(const insole_evidence_t *evidence, insole_real_t x_m,
                                         insole_real_t y_m)
{
    insole_real_t sum = ZERO;
    if (!evidence) {
        return sum;
    }
    if (evidence->has_position) {
        sum += log_of_position(evidence, x_m, y_m);
    }
    for (uint32_t i = 0; i < evidence->ranges; i++) {
        sum += log_of_range(&evidence->range[i], x_m, y_m);
    }
    return sum; /* [TwoOrder (41)]: a product, in logarithms */
}
