/* SPDX-License-Identifier: MIT */
#include "command.h"

#ifdef INSOLE_HOST_HAS_SIMULATOR /* builds without the simulator do not offer the command */

#include <stdlib.h>
#include <string.h>

#include "memory.h"
#include "output.h"
#include "reproduce.h"
#include "reproduce_search.h"
#include "reproduce_wifi_shift.h"

/* Walks of a paper that does not say, and where the seeds of a search begin. */
enum { RUNS = 20, SEARCH_SEED = 1001 };

static const reproduce_paper_t *const papers[] = {&reproduce_two_order, &reproduce_phone_ekf,
                                                  &reproduce_phone_ukf, NULL};

static const reproduce_paper_t *find_paper(const char *name, failure_t *failure)
{
    for (const reproduce_paper_t *const *paper = papers; *paper != NULL; paper++) {
        if (strcmp((*paper)->name, name) == 0) {
            return *paper;
        }
    }
    failure_usage(failure, "insole reproduce: unknown paper %.40s: expected", name);
    for (const reproduce_paper_t *const *paper = papers; *paper != NULL; paper++) {
        failure_add(failure, " %s,", (*paper)->name);
    }
    failure_add(failure, " %s", WIFI_SHIFT_NAME);
    return NULL;
}

static bool parse(const arguments_t *arguments, int64_t runs, reproduce_request_t *request,
                  failure_t *failure)
{
    int64_t seed = options_has(arguments, "search") ? SEARCH_SEED : 1;
    const char *maps = options_value(arguments, "maps");
    if (!options_whole(arguments, "runs", 1, REPRODUCE_RUNS_MAX, &runs, failure) ||
        !options_whole(arguments, "seed", 0, INT64_MAX - REPRODUCE_RUNS_MAX, &seed, failure)) {
        return false;
    }
    request->maps = maps != NULL ? maps : "maps";
    request->out = options_value(arguments, "out");
    request->runs = (int)runs;
    request->seed = (uint64_t)seed;
    return true;
}

static bool search(reproduction_t *reproduction, failure_t *failure)
{
    reproduce_search_t found;
    if (!reproduce_search_has_axes(reproduction->paper)) {
        return failure_usage(failure, "insole reproduce: %s has nothing to --search",
                             reproduction->paper->name);
    }
    reproduce_search_begin(&found, reproduction);
    bool is_good = reproduce_search_run(&found, failure);
    if (is_good) {
        reproduce_search_print(&found, stdout);
    }
    reproduce_search_free(&found);
    return is_good;
}

static bool print_table(const arguments_t *arguments, reproduction_t *reproduction,
                        failure_t *failure)
{
    bool is_good = reproduce_measure(reproduction, failure);
    if (is_good) {
        (options_has(arguments, "json") ? reproduce_json : reproduce_print)(reproduction, stdout);
    }
    return is_good;
}

static bool measure(const arguments_t *arguments, const reproduce_paper_t *paper,
                    const reproduce_request_t *request, failure_t *failure)
{
    reproduction_t *reproduction = memory_new(1u, sizeof *reproduction);
    bool is_good = reproduce_begin(reproduction, paper, request, failure);
    if (is_good) {
        is_good = options_has(arguments, "search") ? search(reproduction, failure)
                                                   : print_table(arguments, reproduction, failure);
    }
    reproduce_free(reproduction);
    free(reproduction);
    return is_good && output_flush(stdout, "-", failure);
}

/* Three paths, with more and less access points, are no table of one walk's rows. */
static bool measure_wifi_shift(const arguments_t *arguments, failure_t *failure)
{
    reproduce_request_t request;
    if (options_has(arguments, "search")) {
        return failure_usage(failure,
                             "insole reproduce: " WIFI_SHIFT_NAME " has nothing to --search");
    }
    if (!parse(arguments, RUNS, &request, failure)) {
        return false;
    }
    wifi_shift_t *study = memory_new(1u, sizeof *study);
    bool is_good = wifi_shift_begin(study, &request, failure) && wifi_shift_measure(study, failure);
    if (is_good) {
        (options_has(arguments, "json") ? wifi_shift_json : wifi_shift_print)(study, stdout);
    }
    wifi_shift_free(study);
    free(study);
    return is_good && output_flush(stdout, "-", failure);
}

static bool run(const arguments_t *arguments, failure_t *failure)
{
    reproduce_request_t request;
    if (arguments->operand_count != 1u) {
        return failure_usage(failure, "insole reproduce: expected the name of one paper");
    }
    if (strcmp(arguments->operands[0], WIFI_SHIFT_NAME) == 0) {
        return measure_wifi_shift(arguments, failure);
    }
    const reproduce_paper_t *paper = find_paper(arguments->operands[0], failure);
    return paper != NULL && parse(arguments, paper->runs, &request, failure) &&
           measure(arguments, paper, &request, failure);
}

static const option_t options[] = {
    {"runs", "N", "how many walks (default 20, of PhoneUKF 40: ten of each carrying position)"},
    {"seed", "N", "of the first walk, and of its particles; the others follow (default 1)"},
    {"maps", "DIR", "where the scenarios are (default maps, as in the source tree)"},
    {"out", "DIR", "draw the paper's figures into it, as SVG; made if it is not there"},
    {"search", NULL, "the best constants of the rivals by a grid, on seeds from 1001 on; no table"},
    {"json", NULL, "as JSON, with the figures of every walk"},
    {NULL, NULL, NULL}};

const command_t command_reproduce = {
    "reproduce",
    "TwoOrder|PhoneEKF|PhoneUKF|WifiShift",
    "a paper's table again: what is measured beside what is printed",
    "Simulates walks with the paper's setup and replays each by the paper's own parts and by\n"
    "our defaults. The table has the errors, and the printed ones beside them.\n"
    "\n"
    "  insole reproduce TwoOrder\n"
    "  insole reproduce PhoneEKF --runs 100 --out figures\n"
    "  insole reproduce PhoneUKF --search --runs 20\n"
    "  insole reproduce WifiShift --runs 4\n",
    options,
    run};

#endif
