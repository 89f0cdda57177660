/** @file radio.h  A building with walls and access points, and what is heard in it, by double.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TESTS_RADIO_H
#define INSOLE_TESTS_RADIO_H

#include "insole/place/rss_field.h"
#include "near.h"
#include "plans.h"

enum { RADIO_APS = 320 };

typedef struct {
    drawing_t drawing;
    insole_propagation_config_t propagation;
    insole_ap_t aps[RADIO_APS];
    insole_building_t building;
} radio_t;

/** An access point at (x, y), `x`, `y` of the map. */
static inline void radio_put(radio_t *r, uint32_t id, double x, double y)
{
    ck_assert_int_eq(insole_propagation_ap(&r->propagation, (insole_real_t)x, (insole_real_t)y,
                                           INSOLE_R(2.5), &r->aps[id]),
                     INSOLE_OK);
}

/** Access points all over the 40 m x 30 m of a random drawing, shifted by (x0, y0). */
static inline void radio_scatter(radio_t *r, insole_rng_t *rng, uint32_t count, double x0,
                                 double y0)
{
    r->propagation = insole_propagation_defaults;
    for (uint32_t i = 0; i < count; i++) {
        double y = y0 + draw_uniform(rng, 0.0, 30.0), x = x0 + draw_uniform(rng, 0.0, 40.0);
        radio_put(r, i, x, y);
        r->aps[i].exponent = (insole_real_t)draw_uniform(rng, 1.8, 2.6);
    }
    insole_building_t building = {&r->propagation, r->aps, count, NULL, NULL};
    r->building = building;
}

/** Random walls among them, whose losses are kept as they are: of whole eighths of a decibel. */
static inline void radio_wall_in(radio_t *r, insole_rng_t *rng, double x0, double y0)
{
    draw_random(&r->drawing, rng, 60);
    for (uint32_t i = 0; i < r->drawing.line_count; i++) {
        insole_real_t *loss_db = &r->drawing.lines[i].loss_db;
        *loss_db = (insole_real_t)(uint32_t)(INSOLE_R(8.0) * *loss_db) / INSOLE_R(8.0);
    }
    draw_move(&r->drawing, 0.0, x0, y0);
    ck_assert_int_eq(draw_build(&r->drawing), INSOLE_OK);
    r->building.plan = &r->drawing.plan;
}

static inline double radio_walls_db(const radio_t *r, double x, double y, const insole_ap_t *ap)
{
    insole_walls_between_t walls = {0, 0};
    if (r->building.plan) {
        insole_floor_plan_walls_between(r->building.plan, (insole_real_t)x, (insole_real_t)y,
                                        ap->x_m, ap->y_m, &walls);
    }
    return (double)walls.loss_db;
}

/** Share of the body in the way, of a walker at (x, y) heading `heading_rad`. */
static inline double radio_body_share(double x, double y, double heading_rad, const insole_ap_t *ap)
{
    double bearing = atan2((double)ap->y_m - y, (double)ap->x_m - x);
    return fmax(0.0, fmin(1.0, 0.5 - 1.5 * cos(bearing - heading_rad)));
}

/** What the model expects, [TwoOrder (10)]. */
static inline double radio_expected_dbm(const radio_t *r, double x, double y, double heading_rad,
                                        uint32_t id)
{
    const insole_propagation_config_t *p = &r->propagation;
    const insole_ap_t *ap = &r->aps[id];
    double dz = (double)p->height_m - (double)ap->z_m;
    double d = sqrt(pow(x - (double)ap->x_m, 2.0) + pow(y - (double)ap->y_m, 2.0) + dz * dz);
    return (double)ap->p0_dbm -
           10.0 * (double)ap->exponent * log10(fmax(d, (double)p->distance_min_m)) -
           fmin(radio_walls_db(r, x, y, ap), (double)p->walls_max_db) - (double)p->multipath_db -
           radio_body_share(x, y, heading_rad, ap) * (double)p->body_db;
}

/** Logarithm of the likelihood of one reading. */
static inline double radio_log_of(const radio_t *r, double x, double y, double heading_rad,
                                  const insole_rss_t *reading, double offset_db)
{
    double dof = (double)r->propagation.tail_dof;
    double off = (double)reading->rss_dbm - offset_db -
                 radio_expected_dbm(r, x, y, heading_rad, reading->id);
    double z = off / (double)r->propagation.sigma_db;
    return -(double)r->propagation.power * 0.5 * (dof + 1.0) * log1p(z * z / dof);
}

/** That of a scan. */
static inline double radio_log_likelihood(const radio_t *r, double x, double y, double heading_rad,
                                          const insole_rss_t *readings, uint32_t count)
{
    double sum = 0.0;
    for (uint32_t i = 0; i < count; i++) {
        sum += radio_log_of(r, x, y, heading_rad, &readings[i], 0.0);
    }
    return sum;
}

/** What a walker at (x, y) hears of the first `count` access points, in order of their ids; `rng`
 *  NULL: without noise. */
static inline void radio_listen(const radio_t *r, insole_rng_t *rng, double x, double y,
                                double heading_rad, double sigma_db, uint32_t count,
                                insole_rss_t *readings)
{
    for (uint32_t id = 0; id < count; id++) {
        double noise = rng ? sigma_db * (double)insole_rng_normal(rng) : 0.0;
        readings[id].id = id;
        readings[id].age_us = 0;
        readings[id].rss_dbm =
            (insole_real_t)(radio_expected_dbm(r, x, y, heading_rad, id) + noise);
    }
}

#endif
