/* SPDX-License-Identifier: MIT */
#include "summary.h"

#include <math.h>
#include <string.h>

#include "notes.h"
#include "number.h"
#include "record_line.h"
#include "score_print.h"
#include "summary_fusion.h"
#include "summary_phone.h"

/* One counter of the screen: what happened to how many readings. */
typedef struct {
    const char *key, *text;
    uint32_t count;
    bool is_repaired; /* else refused */
} trouble_t;

enum { TROUBLES = 9 };

static void list_troubles(const insole_screen_counts_t *counts, trouble_t troubles[TROUBLES])
{
    const trouble_t list[TROUBLES] = {
        {"repeated", "repeated stamps", counts->repeated, false},
        {"backward", "stamps going back", counts->backward, false},
        {"wild", "wild stamps", counts->wild, false},
        {"not_finite", "not a number", counts->not_finite, false},
        {"spikes", "spikes", counts->spikes, true},
        {"clipped", "clipped", counts->clipped, true},
        {"gaps", "gaps", counts->gaps, true},
        {"evened", "stamps of bursts evened out", counts->evened, true},
        {"averaged", "averaged", counts->averaged, true}};
    memcpy(troubles, list, sizeof list);
}

static void print_troubles(FILE *file, const char *title, const trouble_t *troubles,
                           bool is_repaired)
{
    int printed = 0;
    fputs(title, file);
    for (int i = 0; i < TROUBLES; i++) {
        if (troubles[i].is_repaired == is_repaired && troubles[i].count > 0u) {
            fprintf(file, "%s%lu %s", printed++ > 0 ? ", " : "", (unsigned long)troubles[i].count,
                    troubles[i].text);
        }
    }
    fputs(printed > 0 ? "\n" : "none\n", file);
}

static double sigma_m(const track_row_t *row)
{
    return sqrt(fmax(row->var_x_m2, 0.0) + fmax(row->var_y_m2, 0.0));
}

static double duration_s(const replay_facts_t *facts)
{
    return 1e-6 * (double)(facts->last_us - facts->first_us);
}

static void print_walk(FILE *file, const replay_facts_t *facts)
{
    char a[NUMBER_ROOM], b[NUMBER_ROOM];
    fprintf(file, "  duration       %s s", number_fixed(a, duration_s(facts), 1));
    if (facts->readings > 1u) {
        fprintf(file, ", %lu readings at %s Hz", facts->readings,
                number_fixed(b, notes_rate_hz(facts), 1));
    }
    fputc('\n', file);
    if (method_is_radio_alone(facts->method)) {
        return; /* nobody looked at the walker */
    }
    bool is_phone = method_tracker(facts->method) == TRACKER_PHONE;
    fprintf(file, "  distance       %s m in %lu %s\n", number_fixed(a, facts->walked_m, 2),
            facts->strides, is_phone ? "steps" : "strides");
    if (is_phone) {
        return;
    }
    fprintf(file, "  foot still     %s %% of the time, in %lu stances\n",
            number_fixed(a, 100.0 * notes_still_share(facts), 1),
            (unsigned long)facts->foot.stances);
}

static void print_last(FILE *file, const track_row_t *last)
{
    char x[NUMBER_ROOM], y[NUMBER_ROOM], z[NUMBER_ROOM], sigma[NUMBER_ROOM];
    fprintf(file, "  final position %s, %s, height %s m, 1-sigma %s m, state %s\n",
            number_fixed(x, last->x_m, 3), number_fixed(y, last->y_m, 3),
            number_fixed(z, last->z_m, 3), number_fixed(sigma, sigma_m(last), 3),
            track_state_name(last->state));
}

/* ---- what the log lacks ----------------------------------------------------------------- */

static const record_kind_t wanted[] = {RECORD_START, RECORD_MAG, RECORD_RSS, RECORD_RANGE};
enum { WANTED = sizeof wanted / sizeof wanted[0] };

static void print_missing(FILE *file, const replay_facts_t *facts)
{
    int printed = 0;
    fputs("  the log lacks  ", file);
    for (int i = 0; i < WANTED; i++) {
        if (facts->seen[wanted[i]] == 0u) {
            fprintf(file, "%s%s", printed++ > 0 ? ", " : "", record_line_kind_name(wanted[i]));
        }
    }
    fputs(printed > 0 ? "\n" : "nothing\n", file);
}

void summary_print(FILE *file, const summary_t *summary)
{
    const replay_facts_t *facts = summary->facts;
    trouble_t troubles[TROUBLES];
    notes_t notes;
    fprintf(file, "%s tracker, method %s\n", summary->tracker, summary->method);
    print_walk(file, facts);
    if (method_tracker(facts->method) == TRACKER_PHONE) {
        summary_phone_print(file, summary);
    } else {
        summary_fusion_print(file, summary);
    }
    print_last(file, &facts->last);
    list_troubles(&facts->screen, troubles);
    print_troubles(file, "  refused        ", troubles, false);
    print_troubles(file, "  repaired       ", troubles, true);
    print_missing(file, facts);
    notes_take(&notes, facts);
    for (int i = 0; i < notes.count; i++) {
        fprintf(file, "note: %s\n", notes.text[i]);
    }
    if (summary->score != NULL) {
        score_print(file, summary->score);
    }
}

/* ---- JSON ------------------------------------------------------------------------------- */

static void json_last(json_t *json, const track_row_t *last)
{
    json_object(json, "final");
    json_number(json, "t_s", 1e-6 * (double)last->t_us, 6);
    json_number(json, "x_m", last->x_m, 4);
    json_number(json, "y_m", last->y_m, 4);
    json_number(json, "z_m", last->z_m, 4);
    json_number(json, "heading_rad", last->heading_rad, 5);
    json_number(json, "sigma_m", sigma_m(last), 4);
    json_text(json, "state", track_state_name(last->state));
    json_end(json);
}

static void json_troubles(json_t *json, const insole_screen_counts_t *counts, const char *key,
                          bool is_repaired)
{
    trouble_t troubles[TROUBLES];
    list_troubles(counts, troubles);
    json_object(json, key);
    for (int i = 0; i < TROUBLES; i++) {
        if (troubles[i].is_repaired == is_repaired) {
            json_whole(json, troubles[i].key, (long long)troubles[i].count);
        }
    }
    json_end(json);
}

static void json_lists(json_t *json, const replay_facts_t *facts)
{
    notes_t notes;
    notes_take(&notes, facts);
    json_array(json, "lacks");
    for (int i = 0; i < WANTED; i++) {
        if (facts->seen[wanted[i]] == 0u) {
            json_text(json, NULL, record_line_kind_name(wanted[i]));
        }
    }
    json_end(json);
    json_array(json, "notes");
    for (int i = 0; i < notes.count; i++) {
        json_text(json, NULL, notes.text[i]);
    }
    json_end(json);
}

void summary_json(FILE *file, const summary_t *summary)
{
    const replay_facts_t *facts = summary->facts;
    json_t json;
    json_begin(&json, file);
    json_object(&json, NULL);
    json_text(&json, "tracker", summary->tracker);
    json_text(&json, "method", summary->method);
    json_number(&json, "duration_s", duration_s(facts), 6);
    json_whole(&json, "readings", (long long)facts->readings);
    json_number(&json, "rate_hz", notes_rate_hz(facts), 3);
    json_number(&json, "distance_m", facts->walked_m, 4);
    if (method_tracker(facts->method) == TRACKER_PHONE) {
        json_whole(&json, "steps", (long long)facts->strides);
        summary_phone_json(&json, summary);
    } else {
        json_whole(&json, "strides", (long long)facts->strides);
        json_whole(&json, "stances", (long long)facts->foot.stances);
        json_number(&json, "still_share", notes_still_share(facts), 4);
        summary_fusion_json(&json, summary);
    }
    json_last(&json, &facts->last);
    json_troubles(&json, &facts->screen, "refused", false);
    json_troubles(&json, &facts->screen, "repaired", true);
    json_lists(&json, facts);
    if (summary->score != NULL) {
        score_json(&json, "score", summary->score);
    }
    json_end(&json);
}
