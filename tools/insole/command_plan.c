/* SPDX-License-Identifier: MIT */
#include "command.h"

#include <stdio.h>
#include <string.h>

#include "number.h"
#include "output.h"
#include "plan_check.h"
#include "plan_page.h"

enum { TEXT_ROOM = 240 };

/* "26 x 15 m, 212 m^2 to walk on" */
static void describe(char text[TEXT_ROOM], const site_t *site, const plan_parts_t *parts)
{
    plan_box_t box = plan_box(&site->plan_file);
    char width[NUMBER_ROOM], height[NUMBER_ROOM], area[NUMBER_ROOM];
    snprintf(text, TEXT_ROOM, "%s x %s m, %s m^2 to walk on, %u walls",
             number_fixed(width, box.high.x_m - box.low.x_m, 1),
             number_fixed(height, box.high.y_m - box.low.y_m, 1),
             number_fixed(area, parts->walkable_m2, 0), (unsigned)site->plan.wall_count);
}

static const char *plural(size_t count)
{
    return count == 1u ? "" : "s";
}

static void print_summary(const site_t *site, const plan_parts_t *parts, const findings_t *findings)
{
    char text[TEXT_ROOM], cell[NUMBER_ROOM];
    size_t warnings = findings->count - findings->errors;
    describe(text, site, parts);
    printf("%s: %s", site->plan_file.name, text);
    if (parts->is_searched) {
        printf(", %u part%s", (unsigned)parts->count, plural(parts->count));
    }
    printf("\n%s: grid of %u x %u cells of %s m, %lu bytes\n", site->plan_file.name,
           site->plan.columns, site->plan.rows, number_fixed(cell, (double)site->plan.cell_m, 1),
           (unsigned long)site_plan_bytes(&site->plan));
    if (site->ap_file.count > 0u) {
        printf("%s: %u access point%s\n", site->ap_file.name, (unsigned)site->ap_file.count,
               plural(site->ap_file.count));
    }
    printf("%u error%s, %u warning%s\n", (unsigned)findings->errors, plural(findings->errors),
           (unsigned)warnings, plural(warnings));
}

static bool check(const arguments_t *arguments, const site_t *site, failure_t *failure)
{
    findings_t findings;
    plan_parts_t parts;
    (void)arguments;
    memset(&findings, 0, sizeof findings);
    plan_parts_find(&parts, &site->plan);
    plan_check(&findings, site, &parts);
    findings_print(&findings, stdout, site->plan_file.name, site->ap_file.name);
    print_summary(site, &parts, &findings);
    bool is_good = output_flush(stdout, "-", failure);
    if (findings.errors > 0u) {
        failure->exit_code = EXIT_BAD_INPUT;
        is_good = false;
    }
    plan_parts_free(&parts);
    findings_free(&findings);
    return is_good;
}

static bool draw(const arguments_t *arguments, const site_t *site, failure_t *failure)
{
    const char *path = options_value(arguments, "out");
    char text[TEXT_ROOM];
    plan_parts_t parts;
    if (site_is_file(site, path)) {
        return failure_usage(failure, "insole plan: --out %s would overwrite what is read", path);
    }
    plan_parts_find(&parts, &site->plan);
    describe(text, site, &parts);
    plan_parts_free(&parts);
    return plan_page_write(site, site->plan_file.name, text, path, failure);
}

static bool run(const arguments_t *arguments, failure_t *failure)
{
    static site_t site;
    const char *action = arguments->operand_count > 0u ? arguments->operands[0] : "nothing";
    bool is_draw = strcmp(action, "draw") == 0;
    if (!is_draw && strcmp(action, "check") != 0) {
        return failure_usage(failure, "insole plan %.40s: expected check or draw", action);
    }
    if (arguments->operand_count != 2u) {
        return failure_usage(failure, "insole plan %s: expected one file, PLAN", action);
    }
    if (is_draw != options_has(arguments, "out")) {
        return failure_usage(failure, is_draw ? "insole plan draw: no --out: expected --out FILE"
                                              : "insole plan check: --out is of draw");
    }
    if (!site_open_sketch(&site, arguments->operands[1], options_value(arguments, "aps"),
                          &insole_propagation_defaults, failure)) {
        return false;
    }
    bool is_good = (is_draw ? draw : check)(arguments, &site, failure);
    site_free(&site);
    return is_good;
}

static const option_t options[] = {
    {"aps", "FILE", "access points of the building"},
    {"out", "FILE", "draw: write the picture, an SVG; - is standard output"},
    {NULL, NULL, NULL}};

const command_t command_plan = {
    "plan",
    "check|draw PLAN",
    "what is wrong with a floor plan, and a picture of it",
    "  check  tells, with file and line, what cannot have been meant so (error, exit 1) or what\n"
    "         may not have been (warning): rings that cross themselves, rooms without a door,\n"
    "         walls and access points outside, walls drawn twice, pixels, degrees. Then size,\n"
    "         area, walls, parts that cannot be reached from each other, and memory\n"
    "  draw   draws walls, the darker the more they cost the radio, holes, access points\n"
    "\n"
    "A plan is drawn in metres from a corner of the building, x to the east, y to the north:\n"
    "\n"
    "  outline,0,0,20,0,20,10,0,10    around where one can walk\n"
    "  hole,4,4,6,4,6,6,4,6           a pillar, a stairwell\n"
    "  wall,5,10,0,10,4               5 dB, from 10,0 to 10,4; then a door, a gap of 1.2 m,\n"
    "  wall,5,10,5.2,10,10            and the rest of the wall\n"
    "\n"
    "  insole plan check plan.csv --aps aps.csv\n"
    "  insole plan draw plan.csv --aps aps.csv --out plan.svg\n"
    "\n"
    "`insole help files` describes both files.\n",
    options,
    run};
