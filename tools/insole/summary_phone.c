/* SPDX-License-Identifier: MIT */
#include "summary_phone.h"

#include "platform.h"
#include "summary_states.h"

static void print_radio(FILE *file, const replay_facts_t *facts)
{
    const replay_fusion_t *radio = &facts->fusion;
    fprintf(file, "  radio          %lu scans; %lu gave a position", radio->radio.scans,
            radio->radio.worked_in);
    if (facts->phone.unplaced > 0u) {
        fprintf(file, "; %lu heard too little", facts->phone.unplaced);
    }
    if (radio->unknown_ids > 0u) {
        fprintf(file, "; %lu of %lu ids unknown", radio->unknown_ids, radio->ids);
    }
    putc('\n', file);
}

static void print_building(FILE *file, const summary_t *summary)
{
    const replay_facts_t *facts = summary->facts;
    if (facts->fusion.walls > 0u) {
        fprintf(file, "  building       %s (%lu walls)\n",
                platform_base_name(summary->site->plan_file.name), facts->fusion.walls);
    }
    if (facts->phone.particles > 0u) {
        fprintf(file, "  cloud          %lu particles, drawn %lu times\n", facts->phone.particles,
                facts->phone.starts);
    }
}

/* Of the steps whose position is known. */
static void print_carried(FILE *file, const replay_facts_t *facts)
{
    unsigned long known = 0u;
    const char *between = "  carried        ";
    for (int k = 0; k < INSOLE_CARRY_POSITIONS; k++) {
        known += facts->phone.carried[k];
    }
    for (int k = 0; k < INSOLE_CARRY_POSITIONS; k++) {
        if (facts->phone.carried[k] > 0u) {
            fprintf(file, "%s%s %.0f %%", between, insole_carry_table_forest.names[k],
                    100.0 * (double)facts->phone.carried[k] / (double)known);
            between = ", ";
        }
    }
    if (known > 0u) {
        fprintf(file, " of %lu steps\n", known);
    }
}

void summary_phone_print(FILE *file, const summary_t *summary)
{
    const replay_facts_t *facts = summary->facts;
    print_building(file, summary);
    if (facts->phone.points > 0u) {
        fprintf(file, "  fingerprints   %s (%lu points, %lu access points)\n",
                platform_base_name(summary->site->radiomap_file.name), facts->phone.points,
                facts->phone.aps);
        print_radio(file, facts);
    } else if (!method_is_steps_alone(facts->method)) {
        fputs("  fingerprints   none (--radiomap)\n", file);
    }
    fprintf(file, "  compass        %lu readings\n", facts->phone.magnetic);
    print_carried(file, facts);
    summary_states_print(file, facts);
}

void summary_phone_json(json_t *json, const summary_t *summary)
{
    const replay_facts_t *facts = summary->facts;
    summary_states_json(json, facts);
    json_object(json, "phone");
    if (facts->fusion.walls > 0u) {
        json_text(json, "plan", summary->site->plan_file.name);
    }
    if (facts->phone.points > 0u) {
        json_text(json, "radiomap", summary->site->radiomap_file.name);
    }
    json_whole(json, "walls", (long long)facts->fusion.walls);
    json_whole(json, "particles", (long long)facts->phone.particles);
    json_whole(json, "points", (long long)facts->phone.points);
    json_whole(json, "access_points", (long long)facts->phone.aps);
    json_whole(json, "scans", (long long)facts->fusion.radio.scans);
    json_whole(json, "placed", (long long)facts->fusion.radio.worked_in);
    json_whole(json, "unplaced", (long long)facts->phone.unplaced);
    json_whole(json, "ids", (long long)facts->fusion.ids);
    json_whole(json, "unknown_ids", (long long)facts->fusion.unknown_ids);
    json_whole(json, "magnetic", (long long)facts->phone.magnetic);
    json_whole(json, "starts", (long long)facts->phone.starts);
    json_whole(json, "gaps", (long long)facts->phone.gaps);
    json_object(json, "carried");
    for (int k = 0; k < INSOLE_CARRY_POSITIONS; k++) {
        json_whole(json, insole_carry_table_forest.names[k], (long long)facts->phone.carried[k]);
    }
    json_end(json);
    json_end(json);
}
