/* SPDX-License-Identifier: MIT */
#include "command.h"

#include <stdio.h>
#include <string.h>

#include "output.h"
#include "pack_writer.h"
#include "plan_check.h"

/* What plan check calls an error must not get into flash. */
static bool is_sound(const site_t *site, failure_t *failure)
{
    findings_t findings;
    plan_parts_t parts;
    if (site->building.plan == NULL) {
        return true;
    }
    memset(&findings, 0, sizeof findings);
    plan_parts_find(&parts, &site->plan);
    plan_check(&findings, site, &parts);
    bool is_good = findings.errors == 0u;
    if (!is_good) {
        failure_input(failure, "%s: %u error%s: `insole plan check` tells what is wrong",
                      site->plan_file.name, (unsigned)findings.errors,
                      findings.errors == 1u ? "" : "s");
    }
    plan_parts_free(&parts);
    findings_free(&findings);
    return is_good;
}

static bool write_file(const arguments_t *arguments, const site_t *site, const char *name,
                       failure_t *failure)
{
    FILE *file;
    const char *path = options_value(arguments, "out");
    if (site_is_file(site, path)) {
        return failure_usage(failure, "insole pack: --out %s would overwrite what is read", path);
    }
    if (!output_open(&file, path, failure)) {
        return false;
    }
    pack_write(file, site, name);
    return output_close(file, path, failure);
}

static bool run(const arguments_t *arguments, failure_t *failure)
{
    static site_t site;
    const char *plan = options_value(arguments, "plan"), *aps = options_value(arguments, "aps");
    const char *radiomap = options_value(arguments, "radiomap");
    const char *name = options_has(arguments, "name") ? options_value(arguments, "name") : "site";
    if (arguments->operand_count > 0u) {
        return failure_usage(failure,
                             "insole pack: takes no operands, only --plan, --aps and --radiomap");
    }
    if (plan == NULL && aps == NULL && radiomap == NULL) {
        return failure_usage(failure,
                             "insole pack: nothing to pack: expected --plan, --aps or --radiomap");
    }
    if (!options_has(arguments, "out")) {
        return failure_usage(failure, "insole pack: no --out: expected --out FILE");
    }
    if (!pack_is_name(name)) {
        return failure_usage(failure,
                             "insole pack: --name %.40s: expected a letter, then letters, digits "
                             "and underscores, at most %d",
                             name, PACK_NAME_LENGTH);
    }
    if (!site_open(&site, plan, aps, radiomap, &insole_propagation_defaults, failure)) {
        return false;
    }
    bool is_good = is_sound(&site, failure) && write_file(arguments, &site, name, failure);
    site_free(&site);
    return is_good;
}

static const option_t options[] = {
    {"plan", "FILE", "floor plan"},
    {"aps", "FILE", "access points"},
    {"radiomap", "FILE", "fingerprints, as `insole radiomap` makes them"},
    {"name", "NAME", "what the names of the tables begin with; default site"},
    {"out", "FILE", "write C there; - is standard output"},
    {NULL, NULL, NULL}};

const command_t command_pack = {
    "pack",
    "--plan P --aps A --radiomap R --out FILE.c",
    "a building as constant C tables, ready for the flash of a device",
    "The plan comes with its grid built, so that the firmware needs no part that builds plans, "
    "and\n"
    "answers as the same plan does in `replay`. A plan that `plan check` finds errors in is "
    "refused.\n"
    "\n"
    "  insole pack --plan plan.csv --aps aps.csv --out site.c\n"
    "\n"
    "site.c then holds site_plan, site_aps, site_ap_count, and site_ap_ids: the names of the "
    "access\n"
    "points, in the order of their indices. The firmware compiles it and says\n"
    "\n"
    "  extern const insole_floor_plan_t site_plan;\n"
    "  extern const uint32_t site_ap_count;\n"
    "  extern const insole_ap_t site_aps[];\n"
    "\n"
    "  insole_building_t building = {&propagation, site_aps, site_ap_count, &site_plan, NULL};\n"
    "\n"
    "Of a radio map it holds site_map, and site_map_ids: names in alphabetical order, so that a\n"
    "device finds the number of what it hears by halving.\n"
    "\n"
    "  extern const insole_radio_map_t site_map;\n"
    "  extern const char *const site_map_ids[];\n"
    "\n"
    "What the files do not tell is taken from the default settings.\n",
    options,
    run};
