/* SPDX-License-Identifier: MIT */
#include "insole/track/foot_fusion.h"

#include "insole/base/fastmath.h"

#define ZERO INSOLE_R(0.0)
#define HALF INSOLE_R(0.5)

/* Radio that no stride has fetched for so long is worked in without one. */
static const uint64_t PATIENCE_US = 2000000u;

/* A heading told so vaguely is compared with the first stride alone. */
#define VAGUE_RAD INSOLE_R(0.3)

static insole_cloud_t cloud_in(const insole_fusion_memory_t *m)
{
    insole_cloud_t cloud = {m->particles, m->count, m->past, m->past ? m->past_strides : 0u};
    return cloud;
}

static insole_status_t check(const insole_foot_fusion_config_t *config,
                             const insole_fusion_memory_t *memory)
{
    insole_cloud_t cloud = cloud_in(memory);
    insole_status_t status = insole_fusion_config_check(config);
    if (status != INSOLE_OK) {
        return status;
    }
    if (config->lag_s > ZERO && (!memory->past || !memory->late || memory->late_count == 0u)) {
        return INSOLE_ERR_NULL;
    }
    return insole_cloud_check(&cloud);
}

insole_status_t insole_foot_fusion_init(insole_foot_fusion_t *fusion,
                                        const insole_foot_fusion_config_t *config,
                                        const insole_fusion_memory_t *memory,
                                        const insole_building_t *building, uint64_t seed)
{
    if (!fusion || !config || !memory) {
        return INSOLE_ERR_NULL;
    }
    insole_status_t status = check(config, memory);
    if (status != INSOLE_OK) {
        return status;
    }
    *fusion = (insole_foot_fusion_t){.config = *config, .memory = *memory, .building = building};
    (void)insole_foot_tracker_init(&fusion->foot, &config->foot);
    (void)insole_particle_filter_init(
        &fusion->particles,
        config->method == INSOLE_FUSION_TWO_ORDER ? &config->two_order : &config->particles, seed);
    return insole_foot_late_init(&fusion->late, memory->late,
                                 memory->late ? memory->late_count : 0u);
}

static insole_status_t answer(insole_foot_fusion_t *fusion, insole_status_t status)
{
    fusion->counts.refused += status == INSOLE_OK ? 0u : 1u;
    return status;
}

insole_status_t insole_foot_fusion_start(insole_foot_fusion_t *fusion, const insole_start_t *start)
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

insole_status_t insole_foot_fusion_finish(insole_foot_fusion_t *fusion)
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
    insole_spot_t n_m = {f->foot.zupt_ekf.p_m.x, f->foot.zupt_ekf.p_m.y};
    return n_m;
}

/* The cloud's mean, moved on by what the foot has gone since. */
static void fix_by_particles(const insole_foot_fusion_t *f, insole_fix_t *fix)
{
    const insole_cloud_fix_t *cloud = &f->particles.fix;
    insole_spot_t now = foot_n(f);
    insole_spot_t gone = {cloud->scale * (now.x_m - f->fixed_n_m.x_m),
                          cloud->scale * (now.y_m - f->fixed_n_m.y_m)};
    gone = insole_turn_way(insole_turn(cloud->offset_rad), gone);
    fix->position_m.x = cloud->x_m + gone.x_m;
    fix->position_m.y = cloud->y_m + gone.y_m;
    fix->var_x_m2 = cloud->var_x_m2;
    fix->cov_xy_m2 = cloud->cov_xy_m2;
    fix->var_y_m2 = cloud->var_y_m2;
    fix->heading_rad =
        insole_wrap_pi(fix->heading_rad - f->foot.anchor.yaw_rad + cloud->offset_rad);
    fix->var_heading_rad2 = cloud->var_offset_rad2;
}

/* A start that is told, and what radio says, each as far as it is certain. */
static void mix_start_and_radio(const insole_foot_fusion_t *f, insole_fix_t *fix)
{
    insole_turn_t turn = insole_turn(f->foot.anchor.yaw_rad);
    (void)insole_fusion_radio_mix(&f->radio, foot_n(f), turn, f->foot.anchor.var_m2, fix);
}

static void begin(insole_foot_fusion_t *f, const insole_particle_start_t *start)
{
    insole_cloud_t cloud = cloud_in(&f->memory);
    if (insole_particle_filter_start(&f->particles, &cloud, start) != INSOLE_OK) {
        return;
    }
    f->working = true;
    f->wants_start = f->wants_start && f->foot.has_start; /* one told ahead is still to come */
    f->has_stride = false;
    f->stride_turn_rad = f->stride_model_m = ZERO;
    f->told_n_m = f->fixed_n_m = foot_n(f);
    insole_fusion_gap_close(&f->gap);
    f->counts.starts++;
    (void)insole_foot_late_stride(&f->late, 0u, f->told_n_m);
}

/* A told start has been reached and is not yet used. */
static bool is_at_start(const insole_foot_fusion_t *f)
{
    return f->wants_start && !f->foot.has_start;
}

/* A told start serves once the foot has reached it and its direction, if told, has been walked. */
static void begin_as_told(insole_foot_fusion_t *f, const insole_fix_t *foot)
{
    const insole_foot_anchor_t *anchor = &f->foot.anchor;
    insole_real_t sigma_rad = f->foot.start.has_heading ? insole_sqrt(anchor->var_rad2) : INSOLE_PI;
    uint32_t strides_left = sigma_rad > VAGUE_RAD ? 1u : 0u;
    if (anchor->strides_left > strides_left || foot->state == INSOLE_FIX_ALIGN) {
        return;
    }
    insole_fix_t fix = *foot;
    fix.var_x_m2 = anchor->var_m2;
    mix_start_and_radio(f, &fix);
    insole_particle_start_t start = {
        fix.position_m.x, fix.position_m.y,
        insole_sqrt(insole_min(anchor->var_m2, INSOLE_R(1.5) * fix.var_x_m2)), anchor->yaw_rad,
        sigma_rad};
    begin(f, &start);
}

/* Nobody tells: radio does, but not the direction. The paper's inertial position begins there too,
 * and its n lies as m does. */
static void begin_by_radio(insole_foot_fusion_t *f, uint64_t t_us)
{
    const insole_anchor_fix_t *fix = &f->radio.fix;
    insole_real_t sigma_m = insole_sqrt(HALF * (fix->P.xx + fix->P.yy)) + f->config.unsure_start_m;
    insole_particle_start_t start = {fix->x_m, fix->y_m, sigma_m, ZERO, INSOLE_PI};
    if (f->config.method == INSOLE_FUSION_TWO_ORDER) {
        insole_start_t place = {t_us, fix->x_m, fix->y_m, false, ZERO, ZERO, ZERO};
        (void)insole_foot_tracker_start(&f->foot, &place);
        start.sigma_offset_rad = ZERO;
    }
    begin(f, &start);
}

/* The particles go on where the foot seems to have come to, as wide as it has lost its way. */
static void begin_after_gap(insole_foot_fusion_t *f, const insole_fix_t *foot)
{
    insole_fusion_unknown_t lost = insole_fusion_gap_lost(&f->gap);
    insole_fix_t fix = *foot;
    fix_by_particles(f, &fix);
    insole_real_t known_m2 = insole_max(fix.var_x_m2, fix.var_y_m2);
    insole_real_t var_m2 = known_m2 + lost.m2, offset_rad = f->particles.fix.offset_rad;
    fix.var_x_m2 = var_m2;
    (void)insole_fusion_radio_mix(&f->radio, foot_n(f), insole_turn(offset_rad), var_m2, &fix);
    insole_particle_start_t start = {fix.position_m.x, fix.position_m.y,
                                     insole_sqrt(insole_min(var_m2, INSOLE_R(1.5) * fix.var_x_m2)),
                                     offset_rad,
                                     insole_sqrt(f->particles.fix.var_offset_rad2 + lost.rad2)};
    begin(f, &start);
}

/* After a gap radio may say more of the place than what is left of it; it is not waited for long.
 * What was heard before lies a way back that nobody knows. */
static void cross_gap(insole_foot_fusion_t *f, const insole_fix_t *foot)
{
    insole_fusion_site_t site = site_of(f);
    bool is_new = f->gap.is_crossed && f->gap.crossed_us == foot->t_us;
    if (f->gap.is_open && (is_new || !f->gap.is_crossed)) {
        insole_fusion_radio_forget(&f->radio);
    }
    bool waits = insole_fusion_radio_has_aps(&site) && !f->radio.has_fix &&
                 foot->t_us - f->gap.crossed_us < PATIENCE_US;
    if (f->gap.is_crossed && f->particles.has_fix && !waits) {
        begin_after_gap(f, foot);
    }
}

static void begin_if_possible(insole_foot_fusion_t *f, const insole_fix_t *foot)
{
    if (is_at_start(f)) {
        f->is_told = true;
        begin_as_told(f, foot);
    } else if (f->counts.starts == 0u && f->radio.has_fix && f->foot.zupt_ekf.aligned) {
        begin_by_radio(f, foot->t_us);
    } else {
        cross_gap(f, foot);
    }
}

static void tell_stride(insole_foot_fusion_t *f, const insole_fix_t *foot, insole_evidence_t *news)
{
    insole_spot_t end = {f->foot.strides.origin_m.x, f->foot.strides.origin_m.y};
    insole_real_t dx = end.x_m - f->told_n_m.x_m, dy = end.y_m - f->told_n_m.y_m;
    bool printed = f->config.method == INSOLE_FUSION_TWO_ORDER;
    insole_real_t length_m = printed ? f->stride_model_m : insole_sqrt(dx * dx + dy * dy);
    f->told_n_m = end;
    (void)insole_evidence_stride(news, length_m, insole_atan2(dy, dx), f->stride_turn_rad);
    if (printed) {
        insole_spot_t inertial = {foot->position_m.x, foot->position_m.y};
        (void)insole_evidence_position(news, inertial, f->config.sigma_inertial_m);
    }
    f->has_stride = false;
    f->stride_turn_rad = f->stride_model_m = ZERO;
}

/* Strides that end while the particles are busy are told as one. */
static void gather_stride(insole_foot_fusion_t *f)
{
    insole_stride_t stride;
    if (insole_foot_tracker_stride(&f->foot, &stride) == INSOLE_OK && f->counts.starts > 0u) {
        f->stride_turn_rad = insole_wrap_pi(f->stride_turn_rad + stride.turn_rad);
        f->stride_model_m += stride.model_length_m;
        f->has_stride = true;
    }
}

/* Strides are told when they end, and radio with them, unless none ends. */
static bool has_news(const insole_foot_fusion_t *f, uint64_t t_us)
{
    return f->has_stride ||
           insole_fusion_radio_waits(&f->radio, t_us > PATIENCE_US ? t_us - PATIENCE_US : 0u);
}

static void tell(insole_foot_fusion_t *f, const insole_fix_t *foot)
{
    if (f->working || f->counts.starts == 0u || f->gap.is_open || !has_news(f, foot->t_us)) {
        return;
    }
    insole_fusion_site_t site = site_of(f);
    insole_evidence_clear(&f->news);
    if (f->has_stride) {
        tell_stride(f, foot, &f->news);
    }
    (void)insole_fusion_radio_tell(&f->radio, &site, f->told_n_m, &f->news);
    f->working = insole_particle_filter_begin(&f->particles, f->building, &f->news) == INSOLE_OK;
    (void)insole_foot_late_stride(&f->late, f->particles.since_start, f->told_n_m);
}

bool insole_foot_fusion_work(insole_foot_fusion_t *fusion, uint32_t particles)
{
    if (!fusion || !fusion->working) {
        return false;
    }
    insole_cloud_t cloud = cloud_in(&fusion->memory);
    fusion->working =
        insole_particle_filter_work(&fusion->particles, &cloud, fusion->building, particles);
    if (!fusion->working) {
        fusion->fixed_n_m = fusion->told_n_m;
    }
    return fusion->working;
}

/* A told start that has been reached but not walked from yet is better than the cloud before it. */
static bool has_cloud(const insole_foot_fusion_t *f)
{
    return f->particles.has_fix && !is_at_start(f);
}

/* Told nothing, not certain, or with a cloud that just died out or misfits: it still searches. */
static bool is_sure(const insole_foot_fusion_t *f, const insole_fix_t *fix)
{
    bool is_narrow = fix->var_x_m2 + fix->var_y_m2 <= insole_square(f->config.search_sigma_m);
    bool is_doubtful = f->particles.deaths > 0u ||
                       insole_particle_filter_misfit(&f->particles) > f->config.search_margin;
    return is_narrow && (f->counts.starts > 0u || f->is_told) && !(is_doubtful && has_cloud(f));
}

static void make_fix(const insole_foot_fusion_t *f, insole_fix_t *fix)
{
    if (is_at_start(f) && f->radio.has_fix) {
        mix_start_and_radio(f, fix);
    } else if (has_cloud(f)) {
        fix_by_particles(f, fix);
        insole_fusion_gap_widen(&f->gap, fix);
    } else if (!f->is_told && f->radio.has_fix) {
        (void)insole_fusion_radio_fix(&f->radio, fix);
    }
    if (fix->state == INSOLE_FIX_TRACK ||
        (fix->state == INSOLE_FIX_LOST && has_cloud(f) && !f->gap.is_open)) {
        fix->state = is_sure(f, fix) ? INSOLE_FIX_TRACK : INSOLE_FIX_SEARCH;
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
        (void)insole_fusion_gap_follow(&f->gap, &f->foot, fix);
        begin_if_possible(f, fix);
        tell(f, fix);
        make_fix(f, fix);
    }
    return status;
}

static insole_status_t take_late(insole_foot_fusion_t *f, insole_fix_t *fix)
{
    insole_cloud_t cloud = cloud_in(&f->memory);
    return insole_foot_late_take(&f->late, &f->particles, &cloud, f->counts.starts, fix);
}

/* Fixes go in at the young end of what waits until the oldest is due. */
static insole_status_t next_late(insole_foot_fusion_t *f, insole_fix_t *fix)
{
    uint32_t lag_us = (uint32_t)(f->config.lag_s * INSOLE_R(1e6));
    while (!insole_foot_late_is_due(&f->late, lag_us)) {
        insole_late_row_t row;
        if (f->finished && f->working) {
            return INSOLE_ERR_STATE;
        }
        if (step(f, &row.fix) != INSOLE_OK) {
            return f->finished ? take_late(f, fix) : INSOLE_ERR_STATE;
        }
        row.n_m = foot_n(f);
        row.stride = f->particles.since_start;
        row.start = f->counts.starts;
        (void)insole_foot_late_push(&f->late, &row);
    }
    return take_late(f, fix);
}

insole_status_t insole_foot_fusion_next(insole_foot_fusion_t *fusion, insole_fix_t *fix)
{
    if (!fusion || !fix) {
        return INSOLE_ERR_NULL;
    }
    if (fusion->config.method == INSOLE_FUSION_WIFI) {
        return insole_fusion_radio_take(&fusion->radio, fix);
    }
    return fusion->config.lag_s > ZERO ? next_late(fusion, fix) : step(fusion, fix);
}
