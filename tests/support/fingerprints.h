/** @file fingerprints.h  A made-up radio map with all its tables, and scans, for the tests of
 * fixes.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TESTS_FINGERPRINTS_H
#define INSOLE_TESTS_FINGERPRINTS_H

#include <string.h>

#include "insole/base/rng.h"
#include "insole/place/radio_map.h"
#include "near.h"

enum { PRINTS_POINTS = 64, PRINTS_APS = 600, PRINTS_ENTRIES = PRINTS_POINTS * PRINTS_APS };

typedef struct {
    insole_spot_t spots[PRINTS_POINTS];
    uint32_t first[PRINTS_POINTS + 1];
    uint8_t visits[PRINTS_POINTS];
    uint16_t aps[PRINTS_ENTRIES];
    uint8_t below[PRINTS_ENTRIES], spread[PRINTS_ENTRIES], counts[PRINTS_ENTRIES];
    uint8_t bins[PRINTS_ENTRIES * INSOLE_RADIO_BINS];
    insole_radio_map_t map;
} prints_t;

static inline double prints_uniform(insole_rng_t *rng, double low, double high)
{
    return low + (high - low) * (double)insole_rng_bits(rng) / 4294967296.0;
}

static inline void prints_begin(prints_t *p)
{
    memset(p, 0, sizeof *p);
    insole_radio_map_t map = {0,      0,        p->spots,  p->first,  p->visits,
                              p->aps, p->below, p->spread, p->counts, p->bins};
    p->map = map;
}

/** A point without entries behind the last; visited 4 times. */
static inline void prints_point(prints_t *p, double x_m, double y_m)
{
    insole_spot_t spot = {(insole_real_t)x_m, (insole_real_t)y_m};
    uint32_t i = p->map.point_count++;
    p->spots[i] = spot;
    p->visits[i] = 4;
    p->first[i + 1u] = p->first[i];
}

/** An entry of the last point; access points ascend. Heard 3 times, one of them a bin lower. */
static inline void prints_entry(prints_t *p, uint32_t ap, double dbm, double std_db)
{
    uint32_t i = p->first[p->map.point_count]++, bin = insole_radio_bin((insole_real_t)dbm);
    p->aps[i] = (uint16_t)ap;
    p->below[i] = insole_radio_level((insole_real_t)dbm);
    p->spread[i] = (uint8_t)(8.0 * std_db + 0.5);
    p->counts[i] = 3;
    p->bins[i * INSOLE_RADIO_BINS + bin] = 2;
    p->bins[i * INSOLE_RADIO_BINS + (bin > 0u ? bin - 1u : 1u)] = 1;
    p->map.ap_count = ap >= p->map.ap_count ? ap + 1u : p->map.ap_count;
}

/** Mean strength of an access point, by its number, at a place in a hall of 40 m x 40 m. */
static inline double prints_dbm(uint32_t ap, double x_m, double y_m)
{
    double ap_x_m = fmod(7.3 * ap, 40.0), ap_y_m = fmod(13.7 * ap, 40.0);
    return -35.0 - 10.0 * log10(1.0 + pow(x_m - ap_x_m, 2.0) + pow(y_m - ap_y_m, 2.0));
}

/** An 8 x 8 lattice, 5 m apart from (x0, y0) on, that hears what is above -78 dBm at least once in
 *  a while. */
static inline void prints_hall(prints_t *p, uint32_t ap_count, double x0, double y0)
{
    prints_begin(p);
    for (int i = 0; i < PRINTS_POINTS; i++) {
        double x_m = 2.5 + 5.0 * (i % 8), y_m = 2.5 + 5.0 * (i / 8);
        prints_point(p, x0 + x_m, y0 + y_m);
        for (uint32_t ap = 0; ap < ap_count; ap++) {
            if (prints_dbm(ap, x_m, y_m) > -66.0) {
                prints_entry(p, ap, prints_dbm(ap, x_m, y_m), 1.0 + (int)(ap % 5u));
            }
        }
    }
}

/** What is heard at a place of the hall, with noise; returns how many. */
static inline uint32_t prints_listen(insole_rng_t *rng, uint32_t ap_count, double x_m, double y_m,
                                     double sigma_db, double offset_db, insole_rss_t *readings)
{
    uint32_t count = 0;
    for (uint32_t ap = 0; ap < ap_count; ap++) {
        double dbm = prints_dbm(ap, x_m, y_m) + sigma_db * (double)insole_rng_normal(rng);
        if (dbm > -66.0) {
            insole_rss_t reading = {ap, (insole_real_t)(dbm + offset_db), 0};
            readings[count++] = reading;
        }
    }
    return count;
}

/** Mean in dBm of an access point at a point, as the map keeps it, by a plain search; NaN: none. */
static inline double prints_mean(const prints_t *p, uint32_t point, uint32_t ap, uint32_t *entry)
{
    for (uint32_t i = p->first[point]; i < p->first[point + 1u]; i++) {
        if (p->aps[i] == ap) {
            *entry = i;
            return -0.5 * p->below[i];
        }
    }
    return (double)NAN;
}

/** Strength of an access point in a scan, the strongest of several; NaN: not heard. */
static inline double prints_heard(const insole_rss_t *readings, uint32_t count, uint32_t ap)
{
    double dbm = (double)NAN;
    for (uint32_t i = 0; i < count; i++) {
        if (readings[i].id == ap) {
            dbm = fmax(dbm, (double)readings[i].rss_dbm);
        }
    }
    return dbm;
}

/** Mean and covariance by direct double sums over weights exp(log_weight - largest). */
typedef struct {
    double x_m, y_m, xx, xy, yy;
    uint32_t likeliest;
} prints_moments_t;

static inline prints_moments_t prints_moments(const insole_spot_t *spots, const double *log_weight,
                                              uint32_t count)
{
    prints_moments_t m = {0.0, 0.0, 0.0, 0.0, 0.0, 0};
    double sum = 0.0;
    for (uint32_t i = 1; i < count; i++) {
        m.likeliest = log_weight[i] > log_weight[m.likeliest] ? i : m.likeliest;
    }
    double top = log_weight[m.likeliest];
    for (uint32_t i = 0; i < count; i++) {
        double w = exp(log_weight[i] - top);
        sum += w;
        m.x_m += w * (double)spots[i].x_m;
        m.y_m += w * (double)spots[i].y_m;
    }
    m.x_m /= sum;
    m.y_m /= sum;
    for (uint32_t i = 0; i < count; i++) {
        double w = exp(log_weight[i] - top) / sum;
        double x = (double)spots[i].x_m - m.x_m, y = (double)spots[i].y_m - m.y_m;
        m.xx += w * x * x;
        m.xy += w * x * y;
        m.yy += w * y * y;
    }
    return m;
}

#endif
