/* SPDX-License-Identifier: MIT */
#include "insole/place/propagation.h"

#include "insole/base/fastmath.h"

#define ZERO         INSOLE_R(0.0)
#define HALF         INSOLE_R(0.5)
#define ONE          INSOLE_R(1.0)
#define DB_PER_NEPER INSOLE_R(4.3429448190325183) /* 10 lg x = 4.34 ln x */
#define RANGE_MAX_M  INSOLE_R(10000.0)

const insole_propagation_config_t insole_propagation_defaults = {
    INSOLE_PROPAGATION_KEYS(INSOLE_CONFIG_DEFAULT)};

insole_status_t insole_propagation_check(const insole_propagation_config_t *config)
{
    typedef insole_propagation_config_t config_t;
    static const insole_config_range_t ranges[] = {INSOLE_PROPAGATION_KEYS(INSOLE_CONFIG_RANGE)};
    return insole_config_check(config, ranges, sizeof ranges / sizeof ranges[0]);
}

/* What is lost on the way but for the distance. */
static insole_real_t obstacles_db(const insole_propagation_config_t *config,
                                  insole_real_t wall_loss_db, insole_real_t body_share)
{
    return insole_min(wall_loss_db, config->walls_max_db) + config->multipath_db +
           body_share * config->body_db;
}

static insole_real_t rss_at_dbm(const insole_propagation_config_t *config, const insole_ap_t *ap,
                                insole_real_t distance_m, insole_real_t obstacle_db)
{
    insole_real_t d = insole_max(distance_m, config->distance_min_m);
    return ap->p0_dbm -
           (DB_PER_NEPER * ap->exponent * insole_log(d) + obstacle_db); /* [TwoOrder (10)] */
}

insole_status_t insole_propagation_ap(const insole_propagation_config_t *config, insole_real_t x_m,
                                      insole_real_t y_m, insole_real_t z_m, insole_ap_t *ap)
{
    if (!config || !ap) {
        return INSOLE_ERR_NULL;
    }
    if (!insole_vec3_is_finite(insole_vec3(x_m, y_m, z_m))) {
        return INSOLE_ERR_VALUE;
    }
    insole_ap_t blank = {x_m, y_m, z_m, config->p0_dbm, config->exponent, ZERO};
    *ap = blank;
    ap->near_dbm = rss_at_dbm(config, ap, config->near_m, obstacles_db(config, ZERO, HALF));
    return INSOLE_OK;
}

/* True for losses that can be; not-a-number cannot. */
static bool are_losses(insole_real_t wall_loss_db, insole_real_t body_share)
{
    return wall_loss_db >= ZERO && body_share >= ZERO && body_share <= ONE;
}

insole_status_t insole_propagation_expect(const insole_propagation_config_t *config,
                                          const insole_ap_t *ap, insole_real_t x_m,
                                          insole_real_t y_m, insole_real_t wall_loss_db,
                                          insole_real_t body_share, insole_expected_rss_t *expected)
{
    if (!config || !ap || !expected) {
        return INSOLE_ERR_NULL;
    }
    insole_vec3_t way = insole_vec3(x_m - ap->x_m, y_m - ap->y_m, config->height_m - ap->z_m);
    insole_real_t distance_m = insole_vec3_norm(way); /* [TwoOrder (38)] */
    if (!are_losses(wall_loss_db, body_share) || !insole_is_finite(distance_m)) {
        return INSOLE_ERR_VALUE;
    }
    insole_real_t rss_dbm =
        rss_at_dbm(config, ap, distance_m, obstacles_db(config, wall_loss_db, body_share));
    if (!insole_is_finite(rss_dbm)) {
        return INSOLE_ERR_VALUE;
    }
    expected->distance_m = distance_m;
    expected->rss_dbm = rss_dbm;
    return INSOLE_OK;
}

INSOLE_COLD insole_status_t insole_propagation_range(const insole_propagation_config_t *config,
                                                     const insole_ap_t *ap, insole_real_t rss_dbm,
                                                     insole_real_t wall_loss_db,
                                                     insole_real_t body_share,
                                                     insole_rss_range_t *range)
{
    if (!config || !ap || !range) {
        return INSOLE_ERR_NULL;
    }
    insole_real_t loss_db =
        ap->p0_dbm - rss_dbm - obstacles_db(config, wall_loss_db, body_share); /* of distance */
    if (!are_losses(wall_loss_db, body_share) || !insole_is_finite(loss_db) ||
        !insole_ap_has_model(ap)) {
        return INSOLE_ERR_VALUE;
    }
    insole_real_t db_per_e = DB_PER_NEPER * ap->exponent; /* e times as far loses so much more */
    insole_real_t d = insole_exp(loss_db / db_per_e);     /* [TwoOrder (11)] */
    range->range_m = insole_max(config->distance_min_m, insole_min(d, RANGE_MAX_M));
    range->sigma_m = range->range_m * insole_min(config->sigma_db / db_per_e, RANGE_MAX_M);
    return INSOLE_OK;
}

INSOLE_COLD insole_status_t insole_propagation_nearest(const insole_ap_t *aps, uint32_t ap_count,
                                                       const insole_rss_t *readings, uint32_t count,
                                                       uint32_t *reading)
{
    if (!aps || !readings || !reading) {
        return INSOLE_ERR_NULL;
    }
    insole_real_t strongest_dbm = -INSOLE_REAL_MAX;
    for (uint32_t i = 0; i < count; i++) {
        insole_real_t rss_dbm = readings[i].rss_dbm;
        if (readings[i].id < ap_count && insole_is_finite(rss_dbm) && rss_dbm > strongest_dbm &&
            rss_dbm >= aps[readings[i].id].near_dbm) { /* [TwoOrder (37)] */
            strongest_dbm = rss_dbm;
            *reading = i;
        }
    }
    return strongest_dbm > -INSOLE_REAL_MAX ? INSOLE_OK : INSOLE_ERR_STATE;
}

insole_real_t insole_propagation_log_likelihood(const insole_propagation_config_t *config,
                                                insole_real_t deviation_db)
{
    if (!config || !insole_is_finite(deviation_db)) {
        return ZERO;
    }
    insole_real_t in_sigmas = insole_min(insole_abs(deviation_db) / config->sigma_db,
                                         INSOLE_R(1e6)); /* squares of it stay finite */
    insole_real_t squared = in_sigmas * in_sigmas, dof = config->tail_dof;
    insole_real_t surprise =
        config->tail == INSOLE_TAIL_GAUSS ? squared : (dof + ONE) * insole_log(ONE + squared / dof);
    return -config->power * HALF * surprise;
}
