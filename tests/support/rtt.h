/** @file rtt.h  Recorded round-trip ranges and signal strengths with truth, for the tests of fixes.
 *
 *  The recordings stand beside the checkout, in ../shared/data/rtt, or nowhere.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TESTS_RTT_H
#define INSOLE_TESTS_RTT_H

#include <stdlib.h>

#include "insole/place/propagation.h"
#include "recorded.h"

enum { RTT_APS = 8, RTT_EPOCHS = 20000, RTT_PATH = RECORDED_PATH };

/** All that arrived at one time. */
typedef struct {
    double t_s, x_m, y_m; /* truth */
    bool begins;          /* the first of its run */
    uint32_t range_count, rss_count;
    insole_range_t ranges[RTT_APS];
    insole_rss_t readings[RTT_APS];
} rtt_epoch_t;

typedef struct {
    insole_ap_t aps[RTT_APS];
    rtt_epoch_t epochs[RTT_EPOCHS];
    uint32_t count;
} rtt_scene_t;

static const char *const rtt_runs[2][10] = {
    {"113", "124", "213", "224", "313", "324", "413", "424", "513", "524"},
    {"1013", "1024", "1113", "1124", "713", "724", "913", "924", NULL, NULL}};
static const char *const rtt_names[2] = {"Laboratory", "Shopping_Mall"};

/** Opens a file of a scene; NULL where there is none. */
static inline FILE *rtt_open(int scene, const char *kind, const char *run, const char *end)
{
    char inside[100], path[RTT_PATH];
    snprintf(inside, sizeof inside, "rtt/%s/%s%s%s", rtt_names[scene], kind, run, end);
    return fopen(recorded_path(path, inside), "r");
}

static inline void rtt_read_aps(rtt_scene_t *scene, FILE *file)
{
    unsigned id;
    double x, y, z;
    char line[RTT_PATH];
    while (fgets(line, sizeof line, file)) {
        if (sscanf(line, "AP%u,%lf,%lf,%lf", &id, &x, &y, &z) == 4 && id >= 1 && id <= RTT_APS) {
            insole_propagation_ap(&insole_propagation_defaults, (insole_real_t)x, (insole_real_t)y,
                                  (insole_real_t)z, &scene->aps[id - 1]);
        }
    }
    fclose(file);
}

static inline rtt_epoch_t *rtt_epoch_at(rtt_scene_t *scene, double t_s, bool *begins)
{
    if (*begins || scene->epochs[scene->count - 1].t_s != t_s) {
        rtt_epoch_t epoch = {t_s, 0.0, 0.0, *begins, 0u, 0u, {{0}}, {{0}}};
        scene->epochs[scene->count++] = epoch;
        *begins = false;
    }
    return &scene->epochs[scene->count - 1];
}

static inline void rtt_read_run(rtt_scene_t *scene, FILE *file)
{
    unsigned id;
    double t, value, sigma;
    char line[RTT_PATH];
    bool begins = true;
    while (fgets(line, sizeof line, file)) {
        if (sscanf(line, "range,%lf,AP%u,%lf,%lf", &t, &id, &value, &sigma) == 4) {
            rtt_epoch_t *epoch = rtt_epoch_at(scene, t, &begins);
            insole_range_t range = {0, id - 1, (insole_real_t)value, (insole_real_t)sigma};
            epoch->ranges[epoch->range_count++] = range;
        } else if (sscanf(line, "rss,%lf,AP%u,%lf", &t, &id, &value) == 3) {
            rtt_epoch_t *epoch = rtt_epoch_at(scene, t, &begins);
            insole_rss_t reading = {id - 1, (insole_real_t)value, 0};
            epoch->readings[epoch->rss_count++] = reading;
        }
    }
    fclose(file);
}

/** Each epoch has its truth. */
static inline void rtt_read_truth(rtt_scene_t *scene, uint32_t from, FILE *file)
{
    double t, x, y;
    char line[RTT_PATH];
    uint32_t i = from;
    while (fgets(line, sizeof line, file) && i < scene->count) {
        if (sscanf(line, "%lf,%lf,%lf", &t, &x, &y) == 3 && t == scene->epochs[i].t_s) {
            scene->epochs[i].x_m = x;
            scene->epochs[i++].y_m = y;
        }
    }
    ck_assert_uint_eq(i, scene->count);
    fclose(file);
}

/** @return false, with a message, where the recordings are not there */
static inline bool rtt_load(rtt_scene_t *scene, int number)
{
    FILE *file = rtt_open(number, "aps", "", ".csv");
    scene->count = 0;
    if (!file) {
        printf("SKIPPED: no recordings in ../shared/data/rtt\n");
        return false;
    }
    rtt_read_aps(scene, file);
    for (int i = 0; i < 10 && rtt_runs[number][i]; i++) {
        uint32_t from = scene->count;
        file = rtt_open(number, "run_", rtt_runs[number][i], ".csv");
        ck_assert_ptr_nonnull(file);
        rtt_read_run(scene, file);
        file = rtt_open(number, "run_", rtt_runs[number][i], ".truth.csv");
        ck_assert_ptr_nonnull(file);
        rtt_read_truth(scene, from, file);
    }
    return true;
}

#endif
