/* SPDX-License-Identifier: MIT
 * Any bytes as a plan: what is read can be built, checked and asked, a refusal names its line. */
#include "fuzz.h"

#include <math.h>

#include "ap_file.h"
#include "plan_file.h"
#include "plan_shape.h"

enum { MOST_LINES = 64, MOST_POINTS = 1024 };

static void check_line(const plan_file_t *plan, const plan_line_t *line)
{
    fuzz_claim(line->floor < plan->floor_count, "the floor is there");
    fuzz_claim(line->count >= (line->kind == INSOLE_LINE_WALL ? 2u : 3u), "there are points");
    fuzz_claim(isnan(line->loss_db) || (line->loss_db >= 0.0 && line->loss_db <= PLAN_FILE_LOSS_DB),
               "the loss is in its range or not told");
    for (size_t i = 0; i < line->count; i++) {
        fuzz_claim(fabs(line->points[i].x_m) <= PLAN_FILE_LIMIT_M &&
                       fabs(line->points[i].y_m) <= PLAN_FILE_LIMIT_M,
                   "points are on the map");
    }
    fuzz_claim(plan_line_distance(line, line->points[0]) <= 1e-6, "a line holds its points");
}

/* What the reader lets through, the library takes; without a wall that has a length there is
 * nothing to build. */
static void build(const plan_file_t *plan)
{
    static insole_real_t xy_m[2 * MOST_POINTS];
    static insole_floor_plan_line_t lines[MOST_LINES];
    static insole_wall_t walls[MOST_POINTS];
    static insole_floor_plan_cell_t cells[4096];
    static uint16_t entries[16384];
    const insole_floor_plan_memory_t memory = {walls, MOST_POINTS, cells, 4096, entries, 16384};
    insole_floor_plan_t built;
    uint32_t count = 0, points = 0;
    for (; count < plan->count && count < MOST_LINES; count++) {
        const plan_line_t *line = &plan->lines[count];
        if (points + line->count > MOST_POINTS) {
            break;
        }
        lines[count].kind = line->kind;
        lines[count].points = (uint32_t)line->count;
        lines[count].xy_m = &xy_m[2 * points];
        lines[count].loss_db = isnan(line->loss_db) ? 0 : (insole_real_t)line->loss_db;
        for (size_t i = 0; i < line->count; i++, points++) {
            xy_m[2 * points] = (insole_real_t)line->points[i].x_m;
            xy_m[2 * points + 1] = (insole_real_t)line->points[i].y_m;
        }
    }
    insole_status_t status = insole_floor_plan_build(&built, lines, count, &memory);
    fuzz_claim(status == INSOLE_OK || status == INSOLE_ERR_STATE, "the library takes the plan");
    if (status == INSOLE_OK) {
        fuzz_claim(insole_floor_plan_crosses(&built, xy_m[0], xy_m[1], xy_m[2], xy_m[3]) ||
                       (xy_m[0] == xy_m[2] && xy_m[1] == xy_m[3]),
                   "the way along a wall meets it");
    }
}

static void check_refusal(const failure_t *failure, const char *name)
{
    fuzz_claim(failure->exit_code == EXIT_BAD_INPUT, "a malformed file is bad input");
    fuzz_claim(strncmp(failure->text, name, strlen(name)) == 0 &&
                   strlen(failure->text) > strlen(name) + 8u,
               "the message says where and what");
}

static void read_as_aps(const uint8_t *data, size_t size)
{
    ap_file_t aps;
    failure_t failure = {EXIT_DONE, ""};
    if (!ap_file_take(&aps, fuzz_file(data, size), "aps", &insole_propagation_defaults, &failure)) {
        check_refusal(&failure, "aps:");
        return;
    }
    for (size_t i = 0; i < aps.count; i++) {
        fuzz_claim(insole_ap_has_place(&aps.aps[i]) && insole_ap_has_model(&aps.aps[i]) &&
                       insole_is_finite(aps.aps[i].near_dbm),
                   "an access point is whole");
        fuzz_claim(aps.ids.names[i][0] != '\0', "ids have names");
    }
    fuzz_claim(aps.count > 0 && aps.ids.count == aps.count, "each has an id of its own");
    ap_file_free(&aps);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    plan_file_t plan;
    failure_t failure = {EXIT_DONE, ""};
    read_as_aps(data, size);
    if (!plan_file_take(&plan, fuzz_file(data, size), "plan", &failure)) {
        check_refusal(&failure, "plan:");
        return 0;
    }
    fuzz_claim(plan.count > 0 && plan.floor_count > 0, "an empty plan is refused");
    for (size_t i = 0; i < plan.count; i++) {
        check_line(&plan, &plan.lines[i]);
    }
    build(&plan);
    plan_file_free(&plan);
    return 0;
}
