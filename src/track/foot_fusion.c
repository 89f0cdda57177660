/* SPDX-License-Identifier: MIT */
#include "insole/track/foot_fusion.h"

#include <stddef.h>
#include <string.h>

#include "insole/track/fusion_fix.h"

#define ZERO INSOLE_R(0.0)
/* Radio that no stride has fetched for so long is worked in without one. */
static const uint64_t PATIENCE_US = 2000000u;
enum {
    STRIDES_BEHIND = 3, /* a cloud that lags more does not know where the walker is */
    DOUBT_STRIDES = 6   /* for so many a cloud must have been good after a way lost as far as */
};
#define DOUBT_M INSOLE_R(5.0)

/* Strides that wait and lead farther than any may are a way lost, about so far. */
static const insole_fusion_unknown_t STRAY = {INSOLE_R(25.0), INSOLE_R(0.1)};

/* A heading told so vaguely is compared with the first stride alone. */
#define VAGUE_RAD INSOLE_R(0.3)

static insole_foot_fusion_own_t own_of(const insole_foot_fusion_config_t *config)
{
    insole_foot_fusion_own_t own;
    memcpy(&own, config,
           offsetof(insole_foot_fusion_own_t, rss_fix)); /* both begin with the list */
    own.rss_fix = config->rss_fix;
    own.range_fix = config->range_fix;
    return own;
}

INSOLE_COLD insole_status_t insole_foot_fusion_init(insole_foot_fusion_t *fusion,
                                                    const insole_foot_fusion_config_t *config,
                                                    const insole_fusion_memory_t *memory,
                                                    const insole_building_t *building,
                                                    uint64_t seed)
{
    if (!fusion || !config || !memory) {
        return INSOLE_ERR_NULL;
    }
    insole_status_t status = insole_fusion_config_check(config);
    status = status == INSOLE_OK ? insole_fusion_memory_check(memory, config) : status;
    if (status != INSOLE_OK) {
        return status;
    }
    memset(fusion, 0, sizeof *fusion);
    fusion->config = own_of(config);
    fusion->memory = *memory;
    fusion->building = building;
    fusion->radio.ranges = memory->ranges;
    bool printed = config->method == INSOLE_FUSION_TWO_ORDER;
    (void)insole_foot_tracker_init(&fusion->foot, &config->foot);
    return insole_particle_filter_init_steps(
        &fusion->particles, printed ? &config->two_order : &config->particles, memory->steps, seed);
}

static insole_status_t answer(insole_foot_fusion_t *fusion, insole_status_t status)
{
    fusion->counts.refused += status == INSOLE_OK ? 0u : 1u;
    return status;
}

INSOLE_COLD insole_status_t insole_foot_fusion_start(insole_foot_fusion_t *fusion,
                                                     const insole_start_t *start)
{
    if (!fusion) {
        return INSOLE_ERR_NULL;
    }
    insole_status_t status = insole_foot_tracker_start(&fusion->foot, start);
    fusion->wants_start = fusion->wants_start || status == INSOLE_OK;
    return status;
}

insole_status_t insole_foot_fusion_imu(insole_foot_fusion_t *fusion, const insole_imu_t *imu)
{
    return fusion ? insole_foot_tracker_imu(&fusion->foot, imu) : INSOLE_ERR_NULL;
}

INSOLE_COLD insole_status_t insole_foot_fusion_finish(insole_foot_fusion_t *fusion)
{
    if (!fusion) {
        return INSOLE_ERR_NULL;
    }
    fusion->finished = true;
    return insole_foot_tracker_finish(&fusion->foot);
}

/* Nothing more can be told while a fix of radio alone waits to be taken. */
static bool is_full(const insole_foot_fusion_t *f)
{
    return f->config.method == INSOLE_FUSION_WIFI && f->radio.is_new;
}

static insole_fusion_site_t site_of(const insole_foot_fusion_t *f)
{
    insole_fusion_site_t site = {f->building,
                                 &f->config.rss_fix,
                                 &f->config.range_fix,
                                 f->config.method == INSOLE_FUSION_WIFI,
                                 f->config.method == INSOLE_FUSION_TWO_ORDER,
                                 f->config.sigma_range_m};
    return site;
}

insole_status_t insole_foot_fusion_scan(insole_foot_fusion_t *fusion, const insole_scan_t *scan)
{
    if (!fusion) {
        return INSOLE_ERR_NULL;
    }
    insole_fusion_site_t site = site_of(fusion);
    return answer(fusion, is_full(fusion) ? INSOLE_ERR_STATE
                                          : insole_fusion_radio_hear(&fusion->radio, &site, scan));
}

insole_status_t insole_foot_fusion_ranges(insole_foot_fusion_t *fusion,
                                          const insole_range_t *ranges, uint32_t count)
{
    if (!fusion) {
        return INSOLE_ERR_NULL;
    }
    insole_fusion_site_t site = site_of(fusion);
    return answer(fusion, is_full(fusion)
                              ? INSOLE_ERR_STATE
                              : insole_fusion_radio_range(&fusion->radio, &site, ranges, count));
}

static insole_spot_t foot_n(const insole_foot_fusion_t *f)
{
    return insole_spot(f->foot.zupt_ekf.p_m.x, f->foot.zupt_ekf.p_m.y);
}

/* The cloud's mean, moved on by what the foot has gone since. */
static void fix_by_particles(const insole_foot_fusion_t *f, insole_fix_t *fix)
{
    (void)insole_fusion_fix_by_cloud(&f->particles.fix, f->strides.done_n_m, foot_n(f),
                                     f->foot.anchor.yaw_rad, fix);
}

/* A place known from elsewhere, and what radio says, each as far as it is certain. */
static void mix_in_radio(const insole_foot_fusion_t *f, insole_real_t yaw_rad, insole_real_t var_m2,
                         insole_fix_t *fix)
{
    (void)insole_fusion_radio_mix(&f->radio, foot_n(f), insole_turn(yaw_rad), var_m2, fix);
}

INSOLE_COLD static void begin(insole_foot_fusion_t *f, const insole_particle_start_t *start)
{
    insole_cloud_t cloud = insole_fusion_cloud(&f->memory);
    if (insole_particle_filter_start(&f->particles, &cloud, start) != INSOLE_OK) {
        return;
    }
    f->working = true;
    f->wants_start = f->wants_start && f->foot.has_start; /* one told ahead is still to come */
    insole_fusion_strides_begin(&f->strides, foot_n(f));
    insole_evidence_clear(&f->news);
    insole_fusion_gap_close(&f->gap);
    f->doubt = 0u;
    f->counts.starts++;
}

INSOLE_COLD static void begin_at(insole_foot_fusion_t *f, insole_fix_t fix, insole_real_t var_m2,
                                 insole_real_t yaw_rad, insole_real_t sigma_rad)
{
    fix.var_x_m2 = var_m2;
    mix_in_radio(f, yaw_rad, var_m2, &fix);
    insole_particle_start_t start = {fix.position_m.x, fix.position_m.y,
                                     insole_sqrt(insole_min(var_m2, INSOLE_R(1.5) * fix.var_x_m2)),
                                     yaw_rad, sigma_rad};
    begin(f, &start);
}

/* A told start has been reached and is not yet used. */
static bool is_at_start(const insole_foot_fusion_t *f)
{
    return f->wants_start && !f->foot.has_start;
}

/* A told start serves once the foot has reached it and its direction, if told, has been walked. */
INSOLE_COLD static void begin_as_told(insole_foot_fusion_t *f, const insole_fix_t *foot)
{
    const insole_foot_anchor_t *anchor = &f->foot.anchor;
    insole_real_t sigma_rad = f->foot.start.has_heading ? insole_sqrt(anchor->var_rad2) : INSOLE_PI;
    uint32_t strides_left = sigma_rad > VAGUE_RAD ? 1u : 0u;
    if (anchor->strides_left > strides_left || foot->state == INSOLE_FIX_ALIGN) {
        return;
    }
    begin_at(f, *foot, anchor->var_m2, anchor->yaw_rad, sigma_rad);
}

static bool hear_start(insole_foot_fusion_t *f, insole_particle_start_t *start)
{
    const insole_fusion_starter_t *starter = &f->memory.starter;
    bool takes_first = f->config.method == INSOLE_FUSION_TWO_ORDER || f->config.start_fixes == 1;
    return takes_first ? insole_fusion_start_first(&f->radio, start)
                       : starter->hear(starter->state, &f->radio, start);
}

/* Nobody tells: radio does. The paper's inertial position begins there too, with n as m lies. */
INSOLE_COLD static void begin_by_radio(insole_foot_fusion_t *f, uint64_t t_us)
{
    insole_particle_start_t start;
    if (!hear_start(f, &start)) {
        return;
    }
    start.sigma_m += f->config.unsure_start_m;
    if (f->config.method == INSOLE_FUSION_TWO_ORDER) {
        insole_start_t place = {t_us, start.x_m, start.y_m, false, ZERO, ZERO, ZERO};
        (void)insole_foot_tracker_start(&f->foot, &place);
        start.offset_rad = start.sigma_offset_rad = ZERO;
    }
    begin(f, &start);
}

/* The particles go on where the foot seems to have come to, as wide as it has lost its way. */
INSOLE_COLD static void begin_after_gap(insole_foot_fusion_t *f, const insole_fix_t *foot,
                                        insole_fusion_unknown_t lost)
{
    insole_fix_t fix = *foot;
    fix_by_particles(f, &fix);
    begin_at(f, fix, insole_max(fix.var_x_m2, fix.var_y_m2) + lost.m2, f->particles.fix.offset_rad,
             insole_sqrt(f->particles.fix.var_offset_rad2 + lost.rad2));
    f->doubt = lost.m2 > insole_square(DOUBT_M) ? DOUBT_STRIDES : 0u;
}

/* After a gap radio may say more than the way; it is not waited for long. */
INSOLE_COLD static void cross_gap(insole_foot_fusion_t *f, const insole_fix_t *foot)
{
    insole_fusion_site_t site = site_of(f);
    bool waits = insole_fusion_radio_has_aps(&site) && !f->radio.has_fix &&
                 foot->t_us - f->gap.crossed_us < PATIENCE_US;
    if (f->gap.is_crossed && f->particles.has_fix && !waits) {
        begin_after_gap(f, foot, insole_fusion_gap_lost(&f->gap));
    }
}

static void begin_if_possible(insole_foot_fusion_t *f, const insole_fix_t *foot)
{
    if (is_at_start(f)) {
        f->is_told = true;
        begin_as_told(f, foot);
    } else if (f->counts.starts == 0u && f->foot.zupt_ekf.aligned) {
        begin_by_radio(f, foot->t_us);
    } else {
        cross_gap(f, foot);
    }
}

static void tell_stride(insole_foot_fusion_t *f, const insole_fix_t *foot)
{
    insole_spot_t end = {f->foot.strides.origin_m.x, f->foot.strides.origin_m.y};
    bool printed = f->config.method == INSOLE_FUSION_TWO_ORDER;
    if (f->strides.waiting == 0u) {
        return;
    }
    if (insole_fusion_strides_tell(&f->strides, end, printed, &f->news) != INSOLE_OK) {
        begin_after_gap(f, foot, STRAY);
    } else if (printed) {
        insole_spot_t inertial = {foot->position_m.x, foot->position_m.y};
        (void)insole_evidence_position(&f->news, inertial, f->config.sigma_inertial_m);
    }
}

INSOLE_COLD static void gather_stride(insole_foot_fusion_t *f)
{
    insole_stride_t stride;
    if (insole_foot_tracker_stride(&f->foot, &stride) == INSOLE_OK && f->counts.starts > 0u) {
        (void)insole_fusion_strides_gather(&f->strides, &stride);
    }
}

/* Strides are told when they end, and radio with them, unless none ends. */
static bool has_news(const insole_foot_fusion_t *f, uint64_t t_us)
{
    return f->strides.waiting > 0u ||
           insole_fusion_radio_waits(&f->radio, t_us > PATIENCE_US ? t_us - PATIENCE_US : 0u);
}

INSOLE_COLD static void tell(insole_foot_fusion_t *f, const insole_fix_t *foot)
{
    if (f->working || f->counts.starts == 0u || f->gap.is_open || !has_news(f, foot->t_us)) {
        return;
    }
    insole_fusion_site_t site = site_of(f);
    insole_evidence_clear(&f->news);
    tell_stride(f, foot);
    if (f->working) {
        return; /* drawn anew */
    }
    (void)insole_fusion_radio_tell(&f->radio, &site, f->strides.told_n_m, &f->news);
    f->working = insole_particle_filter_begin(&f->particles, f->building, &f->news) == INSOLE_OK;
}

/* A cloud is believed when it is narrow, has not just died out and fits. */
static bool is_good(const insole_foot_fusion_t *f, insole_real_t var_m2)
{
    return var_m2 <= insole_square(f->config.search_sigma_m) && f->particles.deaths == 0u &&
           insole_particle_filter_misfit(&f->particles) <= f->config.search_margin;
}

/* Whoever has lost the way is believed after some strides through which the cloud was good. */
INSOLE_COLD static void follow_work(insole_foot_fusion_t *f)
{
    const insole_cloud_fix_t *cloud = &f->particles.fix;
    if (insole_particle_filter_has_settled(&f->particles)) {
        insole_fusion_strides_done(&f->strides);
    }
    if (!f->working && f->doubt > 0u && f->news.has_stride) {
        f->doubt = is_good(f, cloud->var_x_m2 + cloud->var_y_m2) ? f->doubt - 1u : DOUBT_STRIDES;
    }
}

bool insole_foot_fusion_work(insole_foot_fusion_t *fusion, uint32_t particles)
{
    if (!fusion || !fusion->working) {
        return false;
    }
    insole_cloud_t cloud = insole_fusion_cloud(&fusion->memory);
    fusion->working =
        insole_particle_filter_work(&fusion->particles, &cloud, fusion->building, particles);
    follow_work(fusion);
    return fusion->working;
}

/* A told start that has been reached but not walked from yet is better than the cloud before it. */
static bool has_cloud(const insole_foot_fusion_t *f)
{
    return f->particles.has_fix && !is_at_start(f);
}

/* Told nothing, not certain, or with a cloud that is doubted: it still searches. */
static bool is_sure(const insole_foot_fusion_t *f, const insole_fix_t *fix)
{
    insole_real_t var_m2 = fix->var_x_m2 + fix->var_y_m2;
    return has_cloud(f) ? is_good(f, var_m2) && f->doubt == 0u
                        : var_m2 <= insole_square(f->config.search_sigma_m) &&
                              (f->counts.starts > 0u || f->is_told);
}

static void make_fix(const insole_foot_fusion_t *f, insole_fix_t *fix)
{
    if (is_at_start(f) && f->radio.has_fix) {
        mix_in_radio(f, f->foot.anchor.yaw_rad, f->foot.anchor.var_m2, fix);
    } else if (has_cloud(f)) {
        fix_by_particles(f, fix);
        insole_fusion_gap_widen(&f->gap, fix);
    } else if (!f->is_told && f->radio.has_fix) {
        (void)insole_fusion_radio_fix(&f->radio, fix);
    }
    if (fix->state == INSOLE_FIX_TRACK ||
        (fix->state == INSOLE_FIX_LOST && has_cloud(f) && !f->gap.is_open)) {
        uint32_t behind = insole_fusion_strides_behind(&f->strides);
        bool lags = insole_fusion_gap_lags(&f->gap, behind, STRIDES_BEHIND);
        insole_fix_state_t sure = lags ? INSOLE_FIX_COAST : INSOLE_FIX_TRACK;
        fix->state = is_sure(f, fix) ? sure : INSOLE_FIX_SEARCH;
    }
}

/* What was heard before the foot stood again lies a way back that nobody knows. */
static void follow_gap(insole_foot_fusion_t *f, const insole_fix_t *foot)
{
    if (insole_fusion_gap_follow(&f->gap, &f->foot, foot) &&
        (!f->gap.is_crossed || f->gap.crossed_us == foot->t_us)) {
        insole_fusion_radio_forget(&f->radio);
    }
}

/* One sample of the first order becomes a fix. */
static insole_status_t step(insole_foot_fusion_t *f, insole_fix_t *fix)
{
    insole_status_t status = insole_foot_tracker_next(&f->foot, fix);
    if (status == INSOLE_OK && f->building) {
        gather_stride(f);
        insole_fusion_site_t site = site_of(f);
        (void)insole_fusion_radio_place(&f->radio, &site, fix->t_us, foot_n(f));
        follow_gap(f, fix);
        begin_if_possible(f, fix);
        tell(f, fix);
        make_fix(f, fix);
    }
    return status;
}

insole_status_t insole_foot_fusion_next(insole_foot_fusion_t *fusion, insole_fix_t *fix)
{
    if (!fusion || !fix) {
        return INSOLE_ERR_NULL;
    }
    if (fusion->config.method == INSOLE_FUSION_WIFI) {
        return insole_fusion_radio_take(&fusion->radio, fix);
    }
    return step(fusion, fix);
}
