/* SPDX-License-Identifier: MIT */
#include "path_report.h"

#include <math.h>

#include "number.h"

enum { NAMES_SHOWN = 5 };

/* What is out of the common. */
static const double free_walls = 0.2, free_wall_db = 1.0, few_outside = 0.05, wild_db = 9.0,
                    many_lost = 0.3, low_exponent = 1.0, high_exponent = 5.0;

static const char *plural(unsigned long count)
{
    return count == 1u ? "" : "s";
}

static void print_number(FILE *file, double value, int decimals)
{
    char number[NUMBER_ROOM];
    fputs(number_fixed(number, value, decimals), file);
}

static void print_measured(FILE *file, double value, double error, int decimals)
{
    print_number(file, value, decimals);
    fputs(" +- ", file);
    print_number(file, error, decimals);
}

/* ---- what was there --------------------------------------------------------------------- */

static void print_head(FILE *file, const path_readings_t *path, const survey_t *survey)
{
    unsigned long missing = (unsigned long)path->count - path->heard;
    fprintf(file, "# calibrate pathloss: %lu readings, %lu scans, %lu session%s, %lu squares of ",
            path->heard, (unsigned long)survey->scan_count, (unsigned long)survey->sessions,
            plural(survey->sessions), (unsigned long)path->squares.count);
    print_number(file, PATH_SQUARE_M, 0);
    fputs(" m by access point;\n# heard from ", file);
    print_number(file, path->nearest_m, 1);
    fputs(" to ", file);
    print_number(file, path->farthest_m, 1);
    fprintf(file, " m, %lu of them through walls; %lu times an access point was missing\n",
            path->through, missing);
    if (survey->outside + survey->unheard > 0u) {
        fprintf(file, "# left out: %lu reading%s outside the truth, %lu without a number\n",
                survey->outside, plural(survey->outside), survey->unheard);
    }
}

static void print_unknown(FILE *file, const path_readings_t *path)
{
    if (path->unknown == 0u) {
        return;
    }
    fprintf(file, "# left out: %lu reading%s of %lu access point%s not in the file:", path->unknown,
            plural(path->unknown), (unsigned long)path->unknown_ids.count,
            plural(path->unknown_ids.count));
    for (size_t i = 0u; i < path->unknown_ids.count && i < NAMES_SHOWN; i++) {
        fprintf(file, " %s", path->unknown_ids.names[i]);
    }
    fputs(path->unknown_ids.count > NAMES_SHOWN ? " ...\n" : "\n", file);
}

/* ---- values ----------------------------------------------------------------------------- */

static void print_value(FILE *file, const char *key, double value, double error, int decimals)
{
    char number[NUMBER_ROOM];
    fprintf(file, "propagation.%s = %s  # +- ", key, number_fixed(number, value, decimals));
    print_number(file, error, decimals);
}

static void print_kept(FILE *file, const path_model_t *model, path_unknown_t k, const char *key)
{
    fprintf(file, "# propagation.%s is not observable, ", key);
    print_number(file, model->fit.survey.start[k], 2);
    fprintf(file, " assumed: %s\n", model->reason[k]);
}

static void print_unknown_value(FILE *file, const path_model_t *model, path_unknown_t k,
                                const char *key, int decimals)
{
    if (model->fit.is_fixed[k]) {
        print_kept(file, model, k, key);
    } else {
        print_value(file, key, model->fit.value[k], model->fit.error[k], decimals);
        fputc('\n', file);
    }
}

static void print_told_walls(FILE *file, const path_model_t *model, const path_readings_t *path)
{
    const path_fit_t *fit = &model->fit;
    double mean_db = path->told_walls > 0.0 ? path->told_db / path->told_walls : 0.0;
    if (fit->is_fixed[PATH_TOLD]) {
        fprintf(file, "# the plan's wall losses cannot be checked: %s\n", model->reason[PATH_TOLD]);
        return;
    }
    if (fit->is_fixed[PATH_WALL]) {
        print_value(file, "wall_db", fit->value[PATH_TOLD] * mean_db,
                    fit->error[PATH_TOLD] * mean_db, 2);
        fputs("; for plans that do not tell\n", file);
    }
    fputs("# the losses that the plan tells, ", file);
    print_number(file, mean_db, 2);
    fputs(" dB a wall in the mean, count ", file);
    print_measured(file, fit->value[PATH_TOLD], fit->error[PATH_TOLD], 2);
    fputs(" times\n", file);
}

static void print_walls(FILE *file, const path_model_t *model, const path_readings_t *path)
{
    const path_fit_t *fit = &model->fit;
    if (!fit->is_fixed[PATH_WALL] || fit->is_fixed[PATH_TOLD]) {
        print_unknown_value(file, model, PATH_WALL, "wall_db", 2);
    }
    print_told_walls(file, model, path);
    if (!model->sees_most) {
        fputs("# propagation.walls_max_db is not observable, ", file);
        print_number(file, fit->most_db, 0);
        fputs(" assumed: no other limit is clearly likelier\n", file);
        return;
    }
    fputs("propagation.walls_max_db = ", file);
    print_number(file, fit->most_db, 0);
    fputs("  # ", file);
    print_number(file, model->most_low_db, 0);
    fputs(" to ", file);
    print_number(file, model->most_high_db, 0);
    fputs(" are nearly as likely; 1000 = no limit\n", file);
}

static void print_sigma(FILE *file, const path_fit_t *fit, bool has_own)
{
    fputs("propagation.sigma_db = ", file);
    print_number(file, has_own ? fit->sigma_db : fit->common_sigma_db, 2);
    fprintf(file, "  # about the values of %s, for tail = student\n# 1-sigma of the readings ",
            has_own ? "each access point, --out" : "all access points");
    print_number(file, fit->rms_db, 2);
    fputs(" dB about each access point's values, of which ", file);
    print_number(file, 100.0 * fit->alike, 0);
    fputs(" % of the variance is alike within a\n# square; ", file);
    print_number(file, 100.0 * fit->lost_share, 1);
    fputs(" % lost by chance; floor ", file);
    print_number(file, fit->survey.floor_dbm, 0);
    fputs(" dBm\n", file);
}

static void print_values(FILE *file, const path_model_t *model, const path_readings_t *path,
                         bool has_own)
{
    print_value(file, "p0_dbm", model->fit.value[PATH_P0], model->fit.error[PATH_P0], 2);
    fputs("; as this receiver reads: another may differ\n", file);
    print_unknown_value(file, model, PATH_EXPONENT, "exponent", 3);
    print_walls(file, model, path);
    print_unknown_value(file, model, PATH_BODY, "body_db", 2);
    fputs("# propagation.multipath_db is not observable, ", file);
    print_number(file, model->fit.survey.multipath_db, 2);
    fputs(" assumed: it is not told apart from p0_dbm\n", file);
    if ((double)path->settings.height_m != (double)insole_propagation_defaults.height_m) {
        fputs("propagation.height_m = ", file);
        print_number(file, (double)path->settings.height_m, 2);
        fputs("  # as told\n", file);
    }
    print_sigma(file, &model->fit, has_own);
}

static void print_aps(FILE *file, const path_model_t *model, const path_readings_t *path)
{
    fputs("# access points: readings, p0_dbm, exponent, 1-sigma of the residuals in dB\n", file);
    for (size_t a = 0u; a < path->ap_count; a++) {
        const path_ap_t *ap = &model->fit.aps[a];
        fprintf(file, "#   %s: ", path->site.ap_file.ids.names[a]);
        if (ap->heard == 0u) {
            fputs("never heard: it gets the values of all\n", file);
            continue;
        }
        fprintf(file, "%lu, ", (unsigned long)ap->heard);
        print_measured(file, ap->own[PATH_P0], ap->error[PATH_P0], 1);
        fputs(", ", file);
        print_measured(file, ap->own[PATH_EXPONENT], ap->error[PATH_EXPONENT], 2);
        fputs(", ", file);
        print_number(file, ap->sigma_db, 1);
        fputc('\n', file);
    }
}

/* ---- what may be wrong ------------------------------------------------------------------ */

static void warn_of_walls(FILE *file, const path_model_t *model)
{
    const path_fit_t *fit = &model->fit;
    bool told = !fit->is_fixed[PATH_TOLD] && fit->value[PATH_TOLD] < free_walls;
    bool untold = !fit->is_fixed[PATH_WALL] && fit->value[PATH_WALL] < free_wall_db;
    if (told || untold) {
        fputs("# ! walls seem to cost nothing: are plan and truth of one building, in one frame?\n",
              file);
    }
}

static void warn_of_places(FILE *file, const path_readings_t *path)
{
    double share = (double)path->outside / (double)path->heard;
    if (share > few_outside) {
        fputs("# ! ", file);
        print_number(file, 100.0 * share, 0);
        fputs(" % of the readings were made outside the plan: are plan and truth in one frame?\n",
              file);
    }
}

static void warn_of_noise(FILE *file, const path_model_t *model)
{
    const path_fit_t *fit = &model->fit;
    double exponent = fit->value[PATH_EXPONENT];
    if (fit->rms_db > wild_db || exponent < low_exponent || exponent > high_exponent) {
        fputs("# ! readings hardly follow the distance: are access points and truth in one frame, "
              "on one clock?\n",
              file);
    }
    if (fit->lost_share > many_lost) {
        fputs("# ! ", file);
        print_number(file, 100.0 * fit->lost_share, 0);
        fputs(" % of the readings are missing though strong enough: does the log hold all?\n",
              file);
    }
}

static void warn_of_ap(FILE *file, const path_model_t *model, const path_readings_t *path, size_t a)
{
    const path_elsewhere_t elsewhere = path_model_elsewhere(model, path, a);
    const path_ap_t *ap = &model->fit.aps[a];
    fprintf(file, "# ! %s: residuals scatter by ", path->site.ap_file.ids.names[a]);
    print_number(file, ap->sigma_db, 1);
    fputs(" dB where others do by ", file);
    print_number(file, model->typical_sigma_db, 1);
    fputs(", exponent ", file);
    print_number(file, ap->own[PATH_EXPONENT], 2);
    if (elsewhere.is_better) {
        fputs(":\n#   it would fit at ", file);
        print_number(file, elsewhere.x_m, 0);
        fputs(", ", file);
        print_number(file, elsewhere.y_m, 0);
        fputs(": placed wrongly, or moved?\n", file);
    } else {
        fputs(
            ":\n#   no place fits better: two devices of one name, or behind something not in the "
            "plan?\n",
            file);
    }
}

static void print_warnings(FILE *file, const path_model_t *model, const path_readings_t *path)
{
    warn_of_places(file, path);
    warn_of_walls(file, model);
    warn_of_noise(file, model);
    for (size_t a = 0u; a < path->ap_count; a++) {
        if (path_model_is_absurd(model, a)) {
            warn_of_ap(file, model, path, a);
        }
    }
}

void path_report(FILE *file, const path_model_t *model, const path_readings_t *path,
                 const survey_t *survey, bool has_own)
{
    print_head(file, path, survey);
    print_unknown(file, path);
    print_values(file, model, path, has_own);
    print_aps(file, model, path);
    print_warnings(file, model, path);
}

void path_report_aps(FILE *file, const path_model_t *model, const path_readings_t *path)
{
    const path_fit_t *fit = &model->fit;
    insole_propagation_config_t own = path->settings;
    insole_ap_t *aps = path->site.ap_file.aps;
    own.body_db = (insole_real_t)fit->value[PATH_BODY];
    for (size_t a = 0u; a < path->ap_count; a++) {
        insole_real_t x_m = aps[a].x_m, y_m = aps[a].y_m, z_m = aps[a].z_m;
        own.p0_dbm = (insole_real_t)fit->aps[a].own[PATH_P0];
        own.exponent = (insole_real_t)fmax(0.5, fmin(fit->aps[a].own[PATH_EXPONENT], 10.0));
        insole_propagation_ap(&own, x_m, y_m, z_m, &aps[a]);
    }
    ap_file_write(file, &path->site.ap_file.ids, aps);
}
