/* SPDX-License-Identifier: MIT */
#include "reproduce_wifi_shift.h"

#include <math.h>
#include <stdlib.h>

#include "memory.h"
#include "phone_estimator.h"
#include "platform.h"
#include "plot_chart.h"
#include "reproduce_walk.h"
#include "session.h"

/* A start that is looked for, and where the walk began: nobody moves before the first row of the
 * truth. */
typedef struct {
    wifi_shift_start_t kind;
    const track_t *truth;
    double begin_x_m, begin_y_m;
    uint32_t fixes;
} hunt_t;

static void note_start(wifi_shift_t *study, const hunt_t *hunt, wifi_shift_start_t kind,
                       insole_spot_t found)
{
    uint32_t lambda = hunt->fixes - 1u;
    study->start_m[kind][lambda] +=
        hypot((double)found.x_m - hunt->begin_x_m, (double)found.y_m - hunt->begin_y_m);
    study->starts[kind][lambda]++;
}

/* The fixes of the pairs count from the first. */
static insole_spot_t mean_of(const insole_auto_start_t *start)
{
    insole_spot_t sum = {INSOLE_R(0.0), INSOLE_R(0.0)};
    for (uint32_t i = 0u; i < start->pairs; i++) {
        sum = insole_spot_add(sum, start->pair[i].radio);
    }
    return insole_spot_add_scaled(start->first_radio, INSOLE_R(1.0) / (insole_real_t)start->pairs,
                                  sum);
}

/* After each fix: what would be the start now. */
static void look(wifi_shift_t *study, hunt_t *hunt, const phone_estimator_t *estimator)
{
    const insole_auto_start_t *start = &estimator->tracker.place.auto_start;
    insole_auto_start_answer_t found;
    if (start->fixes == hunt->fixes || start->fixes > WIFI_SHIFT_LAMBDAS ||
        insole_auto_start_answer(start, &found) != INSOLE_OK) {
        return;
    }
    hunt->fixes = start->fixes;
    if (hunt->fixes == 1u) {
        hunt->begin_x_m = hunt->truth->rows[0].x_m;
        hunt->begin_y_m = hunt->truth->rows[0].y_m;
    }
    note_start(study, hunt, hunt->kind, found.begin);
    if (hunt->kind == WIFI_SHIFT_CIRCLES) {
        note_start(study, hunt, WIFI_SHIFT_FIRST, start->first_radio);
        note_start(study, hunt, WIFI_SHIFT_MEAN, mean_of(start));
    }
}

static void push(phone_estimator_t *estimator, const site_t *site, const id_table_t *ids,
                 record_t record)
{
    track_row_t fix;
    if (record.kind == RECORD_RSS) {
        record.id = radiomap_file_number(&site->radiomap_file, ids, record.id);
    }
    if (record.kind == RECORD_IMU || record.kind == RECORD_MAG || record.kind == RECORD_RSS) {
        phone_estimator_push(estimator, &record);
    }
    while (phone_estimator_step(estimator)) {
        event_t event;
        (void)phone_estimator_take(estimator, &fix);
        (void)phone_estimator_event(estimator, &event);
    }
}

static bool hunt_start(wifi_shift_t *study, const wifi_shift_walk_t *walk, wifi_shift_start_t kind,
                       failure_t *failure)
{
    static const char *const circles[] = {"phone_parts.fix=ml", "auto_start.method=circles",
                                          "auto_start.fixes=8", NULL};
    static const char *const moved[] = {"phone_parts.fix=ml", "auto_start.method=moved",
                                        "auto_start.fixes=8", NULL};
    settings_t settings;
    session_t session;
    record_t record;
    hunt_t hunt = {.kind = kind, .truth = &walk->truth};
    const char *const logs[] = {walk->log};
    const estimator_setup_t setup = {.settings = &settings,
                                     .method = METHOD_ML_SHIFT,
                                     .map = &study->sites[0].radiomap_file.map,
                                     .seed = walk->seed};
    if (!reproduce_set(&settings, kind == WIFI_SHIFT_CIRCLES ? circles : moved, failure)) {
        return false;
    }
    phone_estimator_t *estimator = memory_new(1u, sizeof *estimator);
    bool is_good =
        phone_estimator_init(estimator, &setup) && session_open(&session, logs, 1u, failure);
    while (is_good && hunt.fixes < WIFI_SHIFT_LAMBDAS &&
           session_next(&session, &record, failure) == READ_ONE) {
        push(estimator, &study->sites[0], &session.ids, record);
        look(study, &hunt, estimator);
    }
    if (is_good) {
        session_close(&session);
    }
    phone_estimator_free(estimator);
    free(estimator);
    return is_good;
}

bool wifi_shift_hunt(wifi_shift_t *study, const wifi_shift_walk_t *walk, failure_t *failure)
{
    return hunt_start(study, walk, WIFI_SHIFT_CIRCLES, failure) &&
           hunt_start(study, walk, WIFI_SHIFT_MOVED, failure);
}

double wifi_shift_start_error(const wifi_shift_t *study, wifi_shift_start_t start, int lambda)
{
    unsigned long count = study->starts[start][lambda - 1];
    return count > 0u ? study->start_m[start][lambda - 1] / (double)count : NUMBER_UNKNOWN;
}

bool wifi_shift_draw(const wifi_shift_t *study, failure_t *failure)
{
    chart_line_t lines[WIFI_SHIFT_STARTS] = {{.name = "circles, as printed"},
                                             {.name = "moved, ours"},
                                             {.name = "first fix"},
                                             {.name = "mean of the fixes"}};
    double high_m = 1.0;
    for (int start = 0; start < WIFI_SHIFT_STARTS; start++) {
        for (int lambda = 1; lambda <= WIFI_SHIFT_LAMBDAS; lambda++) {
            double error_m = wifi_shift_start_error(study, (wifi_shift_start_t)start, lambda);
            chart_add(&lines[start], lambda, isnan(error_m) ? 0.0 : error_m);
            high_m = error_m > high_m ? error_m : high_m;
        }
    }
    const chart_t chart = {.title = "Error of the start, after [WifiShift] figure 7",
                           .subtitle = "mean over walks and paths",
                           .x_name = "lambda",
                           .y_name = "m",
                           .x_low = 1.0,
                           .x_high = WIFI_SHIFT_LAMBDAS,
                           .y_high = ceil(high_m),
                           .lines = lines,
                           .line_count = WIFI_SHIFT_STARTS};
    char *path = platform_join(study->request.out, "figure7.svg");
    bool is_good = chart_write(&chart, path, failure);
    for (int start = 0; start < WIFI_SHIFT_STARTS; start++) {
        chart_free(&lines[start]);
    }
    free(path);
    return is_good;
}
