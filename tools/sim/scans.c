/* SPDX-License-Identifier: MIT */
#include "sim/scans.h"

#include <stdlib.h>
#include <string.h>

#include "sim/trunk.h"

/* Of the readings of one access point in a scan. */
typedef struct {
    double dbm, count;
} sum_t;

typedef struct {
    const sim_walk_t *walk;
    sim_radio_t radio;
    insole_rng_t times;
    sim_list_t *heard;
    sum_t *sums;   /* by access point */
    double last_s; /* of the last reading */
} scanner_t;

/* When a scan is heard, and when it is in the log. */
typedef struct {
    double heard_s, logged_s;
    bool comes;
} scan_t;

static double uniform(insole_rng_t *rng)
{
    return (double)insole_rng_uniform(rng);
}

/* Draws the same amount of chance for every scan. */
static scan_t draw_scan(scanner_t *scanner, double due_s)
{
    const sim_radio_settings_t *s = &scanner->radio.settings;
    double shift = (double)insole_rng_normal(&scanner->times);
    double missed = uniform(&scanner->times), late = uniform(&scanner->times);
    double age_s = -s->late_s * log(1.0 - uniform(&scanner->times));
    scan_t scan = {due_s, due_s, true};
    if (s->model == SIM_RADIO_MATCHED) {
        return scan;
    }
    scan.heard_s = fmax(0.0, due_s + s->jitter_s * shift);
    scan.logged_s = late < s->late_share ? scan.heard_s + age_s : scan.heard_s;
    scan.comes = missed >= s->missed_share;
    return scan;
}

static sim_vec3_t place_at(const scanner_t *scanner, double t_s, const sim_place_t *trunk)
{
    if (scanner->radio.settings.place == SIM_CARRIED_BY_BODY) {
        return sim_vec3(trunk->x_m, trunk->y_m, trunk->z_m + scanner->radio.settings.height_m);
    }
    sim_body_t body = sim_walk_body(scanner->walk);
    return body.pose(body.state, t_s).position_m;
}

/* One reading of all access points, added to what the scan has heard of each. */
static void read_once(scanner_t *scanner, double t_s)
{
    sim_place_t trunk = sim_trunk_at(sim_walk_steps(scanner->walk), t_s);
    sim_vec3_t at = place_at(scanner, t_s, &trunk);
    sim_radio_wait(&scanner->radio, fmax(0.0, t_s - scanner->last_s));
    scanner->last_s = fmax(t_s, scanner->last_s);
    for (size_t i = 0; i < scanner->radio.sources.count; i++) {
        double dbm;
        if (sim_radio_hear(&scanner->radio, i, at, trunk.heading_rad, &dbm)) {
            scanner->sums[i].dbm += dbm;
            scanner->sums[i].count += 1.0;
        }
    }
}

static bool listen(scanner_t *scanner, const scan_t *scan)
{
    const sim_radio_settings_t *s = &scanner->radio.settings;
    size_t sources = scanner->radio.sources.count;
    int readings = (int)s->readings;
    memset(scanner->sums, 0, sources * sizeof *scanner->sums);
    for (int k = readings - 1; k >= 0; k--) {
        read_once(scanner, fmax(0.0, scan->heard_s - k * s->period_s / readings));
    }
    for (size_t i = 0; i < sources; i++) {
        const sum_t *sum = &scanner->sums[i];
        sim_heard_t heard = {scan->logged_s, scan->logged_s - scan->heard_s, i, 0.0};
        heard.dbm = sum->dbm / fmax(1.0, sum->count);
        if (sum->count > 0.0 && scan->comes && scan->logged_s <= sim_walk_duration(scanner->walk) &&
            !sim_list_add(scanner->heard, &heard)) {
            return false;
        }
    }
    return true;
}

static int by_time(const void *left, const void *right)
{
    const sim_heard_t *a = left, *b = right;
    if (a->t_s != b->t_s) {
        return a->t_s < b->t_s ? -1 : 1;
    }
    return a->ap < b->ap ? -1 : a->ap > b->ap;
}

static bool scan_all(scanner_t *scanner)
{
    const sim_radio_settings_t *s = &scanner->radio.settings;
    double first_s = s->period_s * uniform(&scanner->times);
    if (s->model == SIM_RADIO_MATCHED) {
        first_s = 0.0;
    }
    for (long i = 0;; i++) {
        double due_s = first_s + (double)i * s->period_s;
        if (due_s > sim_walk_duration(scanner->walk)) {
            return true;
        }
        scan_t scan = draw_scan(scanner, due_s);
        if (!listen(scanner, &scan)) {
            return false;
        }
    }
}

bool sim_scans_make(const sim_walk_t *walk, const sim_scenario_t *scenario, uint64_t seed,
                    sim_list_t *heard, sim_error_t *error)
{
    scanner_t scanner = {.walk = walk, .heard = heard};
    *heard = sim_list(sizeof(sim_heard_t));
    if (scenario->aps.count == 0 || scenario->settings.radio.model == SIM_RADIO_OFF) {
        return true;
    }
    if (!sim_radio_open(&scanner.radio, scenario, seed, error)) {
        return false;
    }
    sim_seed(&scanner.times, seed, SIM_SEED_RADIO_SCANS);
    scanner.sums = malloc(scanner.radio.sources.count * sizeof *scanner.sums);
    bool done = scanner.sums != NULL && scan_all(&scanner);
    free(scanner.sums);
    sim_radio_close(&scanner.radio);
    if (!done) {
        sim_list_free(heard);
        return sim_fail(error, "out of memory");
    }
    if (heard->count > 0) {
        qsort(heard->items, heard->count, heard->item_size, by_time);
    }
    return true;
}
