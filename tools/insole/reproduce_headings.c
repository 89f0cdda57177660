/* SPDX-License-Identifier: MIT */
#include "reproduce_headings.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "memory.h"
#include "number.h"
#include "reproduce_draw.h"
#include "statistics.h"

static const double degrees = 57.29577951308232;

/* A nearer place tells no direction. */
static const double shortest_m = 0.3;

static const int limits_deg[] = {5, 10, 15, 20, 30, 45, 90};

enum { LIMITS = sizeof limits_deg / sizeof limits_deg[0] };

/* ---- errors ----------------------------------------------------------------------------- */

/* Where errors go, and the truth. */
typedef struct {
    reproduce_heading_errors_t *errors;
    const reproduction_t *reproduction;
} watch_t;

static bool true_direction(const reproduction_t *reproduction, const event_t *step,
                           double *direction_rad)
{
    double from_x_m, from_y_m, to_x_m, to_y_m;
    if (1e-6 * (double)step->begin_us < reproduction->paper->begin_s ||
        !track_place(&reproduction->whole, step->begin_us, &from_x_m, &from_y_m) ||
        !track_place(&reproduction->whole, step->end_us, &to_x_m, &to_y_m)) {
        return false;
    }
    *direction_rad = atan2(to_y_m - from_y_m, to_x_m - from_x_m);
    return hypot(to_x_m - from_x_m, to_y_m - from_y_m) >= shortest_m;
}

static bool take_step(void *context, const event_t *event, failure_t *failure)
{
    watch_t *watch = context;
    reproduce_heading_errors_t *errors = watch->errors;
    double direction_rad;
    (void)failure;
    if (event->kind == EVENT_STEP && true_direction(watch->reproduction, event, &direction_rad)) {
        errors->errors_deg = memory_room(errors->errors_deg, &errors->room, errors->count + 1u,
                                         sizeof *errors->errors_deg);
        double error_deg = degrees * (event->heading_rad - direction_rad);
        errors->errors_deg[errors->count++] = fabs(remainder(error_deg, 360.0));
    }
    return true;
}

bool reproduce_headings_walk(reproduce_headings_t *headings, const reproduction_t *reproduction,
                             failure_t *failure)
{
    bool is_good = true;
    for (int i = 0; is_good && i < headings->row_count; i++) {
        watch_t watch = {&headings->errors[i], reproduction};
        const replay_sink_t sink = {&watch, NULL, NULL, take_step};
        is_good = reproduce_replay(reproduction, &headings->rows[i].row, &sink, failure);
    }
    return is_good;
}

double reproduce_headings_within(const reproduce_headings_t *headings, int row, double limit_deg)
{
    const reproduce_heading_errors_t *errors = &headings->errors[row];
    size_t within = 0u;
    for (size_t i = 0u; i < errors->count; i++) {
        within += errors->errors_deg[i] <= limit_deg ? 1u : 0u;
    }
    return errors->count > 0u ? 100.0 * (double)within / (double)errors->count : NUMBER_UNKNOWN;
}

/* ---- out -------------------------------------------------------------------------------- */

static void print_cell(FILE *file, double value)
{
    char number[NUMBER_ROOM];
    fprintf(file, " %6s", number_fixed(number, value, 1));
}

static void print_row(const reproduce_headings_t *headings, FILE *file, int row)
{
    const reproduce_heading_errors_t *errors = &headings->errors[row];
    fprintf(file, "%-22s", headings->rows[row].row.label);
    for (int i = 0; i < LIMITS; i++) {
        print_cell(file, reproduce_headings_within(headings, row, limits_deg[i]));
    }
    print_cell(file, statistics_mean(errors->errors_deg, errors->count));
    print_cell(file, statistics_std(errors->errors_deg, errors->count));
    if (headings->rows[row].printed_percent > 0.0) {
        fputs("   ", file);
        print_cell(file, headings->rows[row].printed_percent);
    }
    fputc('\n', file);
}

void reproduce_headings_print(const reproduce_headings_t *headings, FILE *file)
{
    fputs("figures 3 and 4: error of each step's direction; share within so many degrees [%], "
          "mean and\nstd [degrees], and what is printed of the share within 15\n",
          file);
    fprintf(file, "%-22s", "");
    for (int i = 0; i < LIMITS; i++) {
        fprintf(file, " %6d", limits_deg[i]);
    }
    fprintf(file, " %6s %6s   printed\n", "mean", "std");
    for (int row = 0; row < headings->row_count; row++) {
        print_row(headings, file, row);
    }
}

static void json_row(const reproduce_headings_t *headings, json_t *json, int row)
{
    const reproduce_heading_errors_t *errors = &headings->errors[row];
    double printed = headings->rows[row].printed_percent;
    json_object(json, NULL);
    json_text(json, "label", headings->rows[row].row.label);
    json_whole(json, "steps", (long long)errors->count);
    json_object(json, "within_percent");
    for (int i = 0; i < LIMITS; i++) {
        char limit[NUMBER_ROOM];
        json_number(json, number_fixed(limit, limits_deg[i], 0),
                    reproduce_headings_within(headings, row, limits_deg[i]), 2);
    }
    json_end(json);
    json_number(json, "mean_deg", statistics_mean(errors->errors_deg, errors->count), 3);
    json_number(json, "std_deg", statistics_std(errors->errors_deg, errors->count), 3);
    json_number(json, "printed_within_15", printed > 0.0 ? printed : NUMBER_UNKNOWN, 1);
    json_end(json);
}

void reproduce_headings_json(const reproduce_headings_t *headings, json_t *json)
{
    json_array(json, "headings");
    for (int row = 0; row < headings->row_count; row++) {
        json_row(headings, json, row);
    }
    json_end(json);
}

bool reproduce_headings_draw(const reproduce_headings_t *headings,
                             const reproduction_t *reproduction, failure_t *failure)
{
    static const reproduce_picture_t picture = {"figure3.svg", "Errors of the walking direction",
                                                "As figure 3 of [PhoneUKF], all walks"};
    static const double shown_deg = 60.0;
    chart_line_t lines[REPRODUCE_ROWS];
    memset(lines, 0, sizeof lines);
    for (int i = 0; i < headings->row_count; i++) {
        lines[i].name = headings->rows[i].row.label;
        reproduce_add_shares(&lines[i], headings->errors[i].errors_deg, headings->errors[i].count,
                             shown_deg);
    }
    const chart_t chart = {.x_name = "error [degrees]",
                           .y_name = "errors below it [%]",
                           .x_high = shown_deg,
                           .y_high = 100.0,
                           .lines = lines,
                           .line_count = (size_t)headings->row_count};
    bool is_good = reproduce_draw_chart(reproduction, &chart, &picture, failure);
    for (int i = 0; i < headings->row_count; i++) {
        chart_free(&lines[i]);
    }
    return is_good;
}

void reproduce_headings_free(reproduce_headings_t *headings)
{
    for (int i = 0; i < headings->row_count; i++) {
        free(headings->errors[i].errors_deg);
    }
}
