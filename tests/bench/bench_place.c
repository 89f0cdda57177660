/* SPDX-License-Identifier: MIT
 * Fixes from fingerprints: each of 40 points and the scan heard the same 24 access points, so that
 * every pair of both is looked at.
 */
#include <stddef.h>

#include "bench.h"

enum { POINTS = 40, APS = 24, ENTRIES = POINTS * APS };

static insole_spot_t spots[POINTS];
static uint32_t first[POINTS + 1];
static uint16_t aps[ENTRIES];
static uint8_t visits[POINTS], below[ENTRIES], spread[ENTRIES], counts[ENTRIES];
static uint8_t bins[ENTRIES * INSOLE_RADIO_BINS];

static const insole_radio_map_t map = {POINTS, APS,   spots,  first,  visits,
                                       aps,    below, spread, counts, bins};

static insole_rss_t readings[APS];

static void make_entry(uint32_t entry, uint32_t ap)
{
    insole_real_t dbm = bench_between(INSOLE_R(-85.0), INSOLE_R(-45.0));
    aps[entry] = (uint16_t)ap;
    below[entry] = insole_radio_level(dbm);
    spread[entry] = 24u;
    counts[entry] = 8u;
    bins[entry * INSOLE_RADIO_BINS + insole_radio_bin(dbm)] = 8u;
}

static void make_map(void)
{
    for (uint32_t point = 0u; point < POINTS; point++) {
        spots[point] =
            insole_spot((insole_real_t)(3u * (point % 8u)), (insole_real_t)(3u * (point / 8u)));
        first[point + 1u] = (point + 1u) * APS;
        visits[point] = 8u;
        for (uint32_t ap = 0u; ap < APS; ap++) {
            make_entry(point * APS + ap, ap);
        }
    }
}

static void make_scan(uint32_t call)
{
    (void)call;
    for (uint32_t ap = 0u; ap < APS; ap++) {
        insole_rss_t reading = {ap, bench_between(INSOLE_R(-85.0), INSOLE_R(-45.0)), 0u};
        readings[ap] = reading;
    }
}

static void take(const insole_radio_fix_t *fix)
{
    bench_take_vec3(0u, insole_vec3(fix->spot.x_m, fix->spot.y_m, fix->log_weight));
    bench_take_vec3(3u, insole_vec3(fix->var_x_m2, fix->cov_xy_m2, fix->var_y_m2));
}

static insole_ml_fix_t ml;

static void begin_ml(int32_t density)
{
    insole_ml_fix_config_t config = insole_ml_fix_defaults;
    config.density = density;
    make_map();
    insole_ml_fix_init(&ml, &config);
}

static void begin_ml_gauss(void)
{
    begin_ml(INSOLE_ML_FIX_GAUSS);
}

static void begin_ml_histogram(void)
{
    begin_ml(INSOLE_ML_FIX_HISTOGRAM);
}

static void solve_ml(void)
{
    insole_radio_fix_t fix = {.points = 0u};
    insole_ml_fix_solve(&ml, &map, NULL, readings, APS, &fix);
    take(&fix);
}

static void call_insole_ml_fix_solve_gauss(uint32_t call)
{
    (void)call;
    solve_ml();
}

static void call_insole_ml_fix_solve_histogram(uint32_t call)
{
    (void)call;
    solve_ml();
}

static insole_kde_fix_t kde;

static void begin_kde(int32_t kernel)
{
    insole_kde_fix_config_t config = insole_kde_fix_defaults;
    config.kernel = kernel;
    make_map();
    insole_kde_fix_init(&kde, &config);
}

static void begin_kde_sorensen(void)
{
    begin_kde(INSOLE_KDE_FIX_SORENSEN);
}

static void begin_kde_gauss(void)
{
    begin_kde(INSOLE_KDE_FIX_GAUSS);
}

static void solve_kde(void)
{
    insole_radio_fix_t fix = {.points = 0u};
    insole_kde_fix_solve(&kde, &map, NULL, readings, APS, &fix);
    take(&fix);
}

static void call_insole_kde_fix_solve_sorensen(uint32_t call)
{
    (void)call;
    solve_kde();
}

static void call_insole_kde_fix_solve_gauss(uint32_t call)
{
    (void)call;
    solve_kde();
}

static const bench_case_t cases[] = {
    {"insole_ml_fix_solve_gauss", 20u, begin_ml_gauss, make_scan, call_insole_ml_fix_solve_gauss,
     NULL},
    {"insole_ml_fix_solve_histogram", 20u, begin_ml_histogram, make_scan,
     call_insole_ml_fix_solve_histogram, NULL},
    {"insole_kde_fix_solve_sorensen", 20u, begin_kde_sorensen, make_scan,
     call_insole_kde_fix_solve_sorensen, NULL},
    {"insole_kde_fix_solve_gauss", 20u, begin_kde_gauss, make_scan, call_insole_kde_fix_solve_gauss,
     NULL},
};

const bench_table_t bench_place = BENCH_TABLE(cases);
