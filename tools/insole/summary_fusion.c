/* SPDX-License-Identifier: MIT */
#include "summary_fusion.h"

#include <math.h>

#include "number.h"
#include "platform.h"
#include "summary_states.h"

/* ---- for people ------------------------------------------------------------------------- */

/* `plan.csv (12 walls)` */
static void print_part(FILE *file, const char *before, const char *path, unsigned long count,
                       const char *what)
{
    fprintf(file, "%s%s (%lu %s)", before, platform_base_name(path), count, what);
}

static void print_building(FILE *file, const summary_t *summary)
{
    const replay_fusion_t *facts = &summary->facts->fusion;
    const site_t *site = summary->site;
    fputs("  building       ", file);
    if (facts->walls > 0u) {
        print_part(file, "", site->plan_file.name, facts->walls, "walls");
    }
    if (facts->aps > 0u) {
        print_part(file, facts->walls > 0u ? ", " : "", site->ap_file.name, facts->aps,
                   "access points");
    }
    fputs(facts->walls + facts->aps > 0u ? "\n" : "nothing known (--plan, --aps)\n", file);
}

static void print_radio(FILE *file, const replay_fusion_t *facts)
{
    fprintf(file, "  radio          %lu scans, %lu ranges; worked in %lu times", facts->radio.scans,
            facts->radio.ranges, facts->radio.worked_in);
    if (facts->waits.unused > 0u) {
        fprintf(file, "; %lu came too soon after another", (unsigned long)facts->waits.unused);
    }
    if (facts->waits.unknown > 0u) {
        fprintf(file, "; %lu of no use", (unsigned long)facts->waits.unknown);
    }
    if (facts->unknown_ids > 0u) {
        fprintf(file, "; %lu of %lu ids unknown", facts->unknown_ids, facts->ids);
    }
    putc('\n', file);
}

static void print_cloud(FILE *file, const replay_fusion_t *facts)
{
    char offset[NUMBER_ROOM];
    const insole_particle_counts_t *counts = &facts->particles;
    fprintf(file,
            "  cloud          drawn %lu times, resampled %lu, moved in part to where scans "
            "point %lu, lost and found %lu\n",
            (unsigned long)facts->starts, (unsigned long)counts->resampled,
            (unsigned long)counts->redrawn, (unsigned long)counts->recovered);
    if (facts->has_offset) {
        fprintf(file, "  receiver       hears %s dB %s than expected\n",
                number_fixed(offset, fabs(facts->offset_db), 1),
                facts->offset_db < 0.0 ? "less" : "more");
    }
}

void summary_fusion_print(FILE *file, const summary_t *summary)
{
    const replay_facts_t *facts = summary->facts;
    if (method_is_first_order(facts->method)) {
        return;
    }
    print_building(file, summary);
    if (facts->fusion.aps > 0u) {
        print_radio(file, &facts->fusion);
    }
    if (facts->fusion.is_fused && facts->method != METHOD_WIFI) {
        print_cloud(file, &facts->fusion);
    }
    if (facts->fusion.is_fused) {
        summary_states_print(file, facts);
    }
}

/* ---- JSON ------------------------------------------------------------------------------- */

static void json_building(json_t *json, const summary_t *summary)
{
    const replay_fusion_t *facts = &summary->facts->fusion;
    const site_t *site = summary->site;
    json_object(json, "building");
    if (facts->walls > 0u) {
        json_text(json, "plan", site->plan_file.name);
    }
    if (facts->aps > 0u) {
        json_text(json, "aps", site->ap_file.name);
    }
    json_whole(json, "walls", (long long)facts->walls);
    json_whole(json, "access_points", (long long)facts->aps);
    json_end(json);
}

static void json_radio(json_t *json, const replay_fusion_t *facts)
{
    json_object(json, "radio");
    json_whole(json, "scans", (long long)facts->radio.scans);
    json_whole(json, "ranges", (long long)facts->radio.ranges);
    json_whole(json, "worked_in", (long long)facts->radio.worked_in);
    json_whole(json, "too_soon", (long long)facts->waits.unused);
    json_whole(json, "of_no_use", (long long)facts->waits.unknown);
    json_whole(json, "wild", (long long)facts->radio.wild);
    json_whole(json, "ids", (long long)facts->ids);
    json_whole(json, "unknown_ids", (long long)facts->unknown_ids);
    json_end(json);
}

static void json_cloud(json_t *json, const replay_fusion_t *facts)
{
    json_object(json, "cloud");
    json_whole(json, "drawn", (long long)facts->starts);
    json_whole(json, "resampled", (long long)facts->particles.resampled);
    json_whole(json, "redrawn", (long long)facts->particles.redrawn);
    json_whole(json, "recovered", (long long)facts->particles.recovered);
    json_number(json, "receiver_offset_db", facts->has_offset ? facts->offset_db : NUMBER_UNKNOWN,
                3);
    json_end(json);
}

void summary_fusion_json(json_t *json, const summary_t *summary)
{
    summary_states_json(json, summary->facts);
    if (summary->facts->fusion.is_fused) {
        json_building(json, summary);
        json_radio(json, &summary->facts->fusion);
        json_cloud(json, &summary->facts->fusion);
    }
}
