/** @file mall_scans.h  Scans of the recorded walks of mall.h, with truth, for the tests of fixes.
 *
 *  Walks whose number is divisible by 4 are the test, the others the survey.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TESTS_MALL_SCANS_H
#define INSOLE_TESTS_MALL_SCANS_H

#include "mall.h"

enum {
    MALL_SCANS = 2000,
    MALL_READINGS = 300000,
    MALL_APS = 2500,
    MALL_NAME = 18,
    MALL_LINE = 128
};

typedef struct {
    double t_s, age_s; /* arrival; age of its youngest reading */
    uint32_t first, count;
    bool has_truth;  /* the walker was between two waypoints when it was heard */
    double x_m, y_m; /* there */
} mall_scan_t;

typedef struct {
    uint32_t number;
    uint32_t first_scan, scan_count;
    mall_waypoint_t waypoints[MALL_WAYPOINTS];
    uint32_t waypoint_count;
} mall_walk_t;

typedef struct {
    mall_walk_t walks[MALL_WALKS];
    mall_scan_t scans[MALL_SCANS];
    insole_rss_t readings[MALL_READINGS];
    char names[MALL_APS][MALL_NAME];
    uint32_t slots[2 * MALL_APS]; /* hash table of numbers + 1 */
    uint32_t walk_count, scan_count, reading_count, ap_count;
} mall_t;

static inline bool mall_is_test(const mall_walk_t *walk)
{
    return walk->number % 4u == 0u;
}

/** The number of an access point, given to it when it is new. */
static inline uint32_t mall_ap(mall_t *mall, const char *name)
{
    uint32_t hash = 2166136261u;
    for (const char *c = name; *c; c++) {
        hash = (hash ^ (unsigned char)*c) * 16777619u;
    }
    uint32_t slot = hash % (2u * MALL_APS);
    while (mall->slots[slot] && strcmp(mall->names[mall->slots[slot] - 1u], name) != 0) {
        slot = (slot + 1u) % (2u * MALL_APS);
    }
    if (!mall->slots[slot]) {
        strcpy(mall->names[mall->ap_count], name);
        mall->slots[slot] = ++mall->ap_count;
    }
    return mall->slots[slot] - 1u;
}

static inline void mall_read_scans(mall_t *mall, mall_walk_t *walk, FILE *file)
{
    char line[MALL_LINE], name[MALL_NAME];
    double t_s, dbm, age_s;
    walk->first_scan = mall->scan_count;
    while (fgets(line, sizeof line, file)) {
        if (sscanf(line, "rss,%lf,%17[^,],%lf,%lf", &t_s, name, &dbm, &age_s) != 4) {
            continue;
        }
        if (mall->scan_count == walk->first_scan || mall->scans[mall->scan_count - 1u].t_s != t_s) {
            mall_scan_t scan = {t_s, age_s, mall->reading_count, 0u, false, 0.0, 0.0};
            mall->scans[mall->scan_count++] = scan;
        }
        mall_scan_t *scan = &mall->scans[mall->scan_count - 1u];
        insole_rss_t reading = {mall_ap(mall, name), (insole_real_t)dbm, (uint32_t)(age_s * 1e6)};
        mall->readings[mall->reading_count++] = reading;
        scan->count++;
        scan->age_s = age_s < scan->age_s ? age_s : scan->age_s;
    }
    walk->scan_count = mall->scan_count - walk->first_scan;
    fclose(file);
}

/** Truth between two waypoints. */
static inline bool mall_truth_at(const mall_walk_t *walk, double t_s, double *x_m, double *y_m)
{
    const mall_waypoint_t *points = walk->waypoints;
    for (uint32_t i = 1; i < walk->waypoint_count; i++) {
        if (t_s >= points[i - 1u].t_s && t_s <= points[i].t_s) {
            double share = (t_s - points[i - 1u].t_s) / (points[i].t_s - points[i - 1u].t_s);
            *x_m = points[i - 1u].x_m + share * (points[i].x_m - points[i - 1u].x_m);
            *y_m = points[i - 1u].y_m + share * (points[i].y_m - points[i - 1u].y_m);
            return true;
        }
    }
    return false;
}

/** @return false, with a message, where the recordings are not there */
static inline bool mall_load(mall_t *mall)
{
    for (uint32_t number = 0; number < MALL_WALKS; number++) {
        FILE *truth = mall_open((int)number, "truth.csv");
        FILE *radio = mall_open((int)number, "radio.csv");
        if (!truth || !radio) {
            printf("SKIPPED: no recordings in ../shared/data/phone/mall_F1\n");
            return false;
        }
        mall_walk_t *walk = &mall->walks[mall->walk_count++];
        walk->number = number;
        walk->waypoint_count = (uint32_t)mall_read_truth(truth, walk->waypoints);
        mall_read_scans(mall, walk, radio);
    }
    return true;
}

/** Moves a place so far ahead of the walker, in the direction walked from 1 s before to 1 s after;
 *  a walker who stands, or whose way is not known so far, looks nowhere. */
static inline void mall_look_ahead(const mall_walk_t *walk, double t_s, double ahead_m,
                                   mall_scan_t *scan)
{
    double x0, y0, x1, y1;
    if (mall_truth_at(walk, t_s - 1.0, &x0, &y0) && mall_truth_at(walk, t_s + 1.0, &x1, &y1)) {
        double way_m = hypot(x1 - x0, y1 - y0);
        scan->x_m += way_m < 0.6 ? 0.0 : ahead_m * (x1 - x0) / way_m;
        scan->y_m += way_m < 0.6 ? 0.0 : ahead_m * (y1 - y0) / way_m;
    }
}

/** Puts each scan so far ahead of where the walker was when it was heard, or `late_s` after, if it
 *  was no later than its arrival. */
static inline void mall_place(mall_t *mall, double late_s, double ahead_m)
{
    for (uint32_t w = 0; w < mall->walk_count; w++) {
        const mall_walk_t *walk = &mall->walks[w];
        for (uint32_t i = 0; i < walk->scan_count; i++) {
            mall_scan_t *scan = &mall->scans[walk->first_scan + i];
            double age_s = scan->age_s > late_s ? scan->age_s - late_s : 0.0;
            double t_s = scan->t_s - age_s;
            scan->has_truth = mall_truth_at(walk, t_s, &scan->x_m, &scan->y_m);
            if (scan->has_truth) {
                mall_look_ahead(walk, t_s, ahead_m, scan);
            }
        }
    }
}

#endif
