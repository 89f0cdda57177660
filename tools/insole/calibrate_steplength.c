/* SPDX-License-Identifier: MIT */
#include "calibrate.h"

#include <math.h>
#include <string.h>

#include "number.h"
#include "step_fit.h"

enum { FEWEST_STEPS = 20, DECIMALS = 4 };

static void print_coefficient(FILE *file, const char *key, double value, double error)
{
    char number[NUMBER_ROOM];
    fprintf(file, "step_length.%s = %s", key, number_fixed(number, value, DECIMALS));
    if (isnan(error)) {
        fputs("\n", file);
    } else {
        fprintf(file, "  # +- %s\n", number_fixed(number, error, DECIMALS));
    }
}

static void print_model(FILE *file, const step_model_t *model, const step_walks_t *walks)
{
    char share[NUMBER_ROOM], scatter[NUMBER_ROOM];
    step_fit_t fit;
    step_fit(&fit, model, walks);
    if (!fit.is_told) {
        fprintf(file,
                "# %s is not observable: expected more truth, of walks with quick and slow, weak "
                "and strong steps\n",
                model->name);
        return;
    }
    if (walks->count > 1u) {
        fprintf(
            file,
            "# %s: distances are off by %s %% (mean of %lu session%s), segments by %s m (rms)\n",
            model->name, number_fixed(share, 100.0 * fit.session_share, 1),
            (unsigned long)walks->sessions, walks->sessions == 1u ? "" : "s",
            number_fixed(scatter, fit.segment_m, 2));
    } else {
        fprintf(file, "# %s: one distance tells no error\n", model->name);
    }
    for (int k = 0; k < model->count; k++) {
        print_coefficient(file, model->key[k], fit.value[k], fit.error[k]);
    }
    if (model->feature[0] == STEP_ROOT) {
        calibrate_line(file, "step_length.root_degree",
                       (double)insole_step_length_defaults.root_degree, 1);
    }
}

static void print_head(FILE *file, const step_walks_t *walks)
{
    char number[NUMBER_ROOM];
    double way_m = 0.0;
    for (size_t i = 0u; i < walks->count; i++) {
        way_m += walks->segments[i].distance_m;
    }
    fprintf(file, "# calibrate steplength: %lu steps, %s m in %lu segment%s of %lu session%s\n",
            walks->steps, number_fixed(number, way_m, 1), (unsigned long)walks->count,
            walks->count == 1u ? "" : "s", (unsigned long)walks->sessions,
            walks->sessions == 1u ? "" : "s");
    if (walks->without_steps > 0u) {
        fprintf(file, "# left out: %lu segments with hardly a step\n", walks->without_steps);
    }
}

static bool print_walks(FILE *file, const step_walks_t *walks, failure_t *failure)
{
    if (walks->steps < FEWEST_STEPS) {
        return failure_input(failure,
                             "insole calibrate steplength: only %lu steps: expected %d or more",
                             walks->steps, FEWEST_STEPS);
    }
    if (walks->count == 0u) {
        return failure_input(failure, "insole calibrate steplength: no steps within the times of "
                                      "10 m of truth: are log and truth on one clock?");
    }
    print_head(file, walks);
    for (size_t i = 0u; i < sizeof step_models / sizeof step_models[0]; i++) {
        print_model(file, &step_models[i], walks);
    }
    return true;
}

bool calibrate_steplength(const arguments_t *arguments, const char *const *sessions, size_t count,
                          FILE *file, failure_t *failure)
{
    step_source_t source = {options_value(arguments, "accel-unit"),
                            options_value(arguments, "gyro-unit"), 0.0};
    step_walks_t walks;
    if (options_has(arguments, "distance") && count != 1u) {
        return failure_usage(failure, "insole calibrate steplength: --distance is that of one LOG");
    }
    if (!options_number(arguments, "distance", 1.0, 1e6, &source.distance_m, failure)) {
        return false;
    }
    memset(&walks, 0, sizeof walks);
    bool is_good = true;
    for (size_t i = 0u; i < count && is_good; i++) {
        is_good = step_walks_add(&walks, sessions[i], &source, failure);
    }
    is_good = is_good && print_walks(file, &walks, failure);
    step_walks_free(&walks);
    return is_good;
}
