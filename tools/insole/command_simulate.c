/* SPDX-License-Identifier: MIT */
#include "command.h"

#ifdef INSOLE_HOST_HAS_SIMULATOR /* builds without the simulator do not offer the command */

#include <stdio.h>

#include "number.h"
#include "sim/write.h"

static void print_report(const sim_report_t *report)
{
    char duration[NUMBER_ROOM], distance[NUMBER_ROOM];
    fprintf(stderr,
            "simulated %s s, %s m in %lu steps: %lu readings, %lu lost, %lu clipped, "
            "%lu signals\n",
            number_fixed(duration, report->duration_s, 1),
            number_fixed(distance, report->distance_m, 1), (unsigned long)report->steps,
            (unsigned long)report->samples, (unsigned long)report->lost,
            (unsigned long)report->clipped, (unsigned long)report->signals);
}

static bool run(const arguments_t *arguments, failure_t *failure)
{
    const char *folder = options_value(arguments, "out");
    char error[sizeof failure->text];
    sim_report_t report;
    int64_t seed = 1;
    if (arguments->operand_count != 1u || folder == NULL) {
        return failure_usage(failure, "insole simulate: expected one SCENARIO and --out DIR");
    }
    if (!options_whole(arguments, "seed", 0, INT64_MAX, &seed, failure)) {
        return false;
    }
    if (sim_write_scenario(arguments->operands[0], folder, (uint64_t)seed, &report, error,
                           sizeof error) != 0) {
        return failure_input(failure, "%s", error);
    }
    print_report(&report);
    return true;
}

static const option_t options[] = {
    {"out", "DIR", "folder for log, truth, plan and access points; made if it is not there"},
    {"seed", "N", "of the randomness: equal seeds give equal walks (default 1)"},
    {NULL, NULL, NULL}};

const command_t command_simulate = {
    "simulate",
    "SCENARIO",
    "make the log and the truth of a simulated walk",
    "A scenario tells where somebody walks, how, and with which sensor.\n"
    "\n"
    "  insole simulate maps/demo/scenario --out demo\n"
    "  insole replay demo --plot demo.svg\n",
    options,
    run};

#endif
