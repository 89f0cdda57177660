/** @file mall_fixes.c  Fixes from fingerprints on recorded walks: how far off, and do they know it.
 *
 *  usage: mall_fixes [--survey] [--folds N] [--late SECONDS] [--ahead M] [--offset DB]
 *                    [--spacing M] [--keep N] [--limit M] [KEY=VALUE]
 *
 *  Builds the radio map from the survey walks and prints each method's errors on the test walks:
 *  of each scan, against where the walker was when it was heard; at each waypoint, of the last
 *  fix. `--survey`: settings are chosen here, each sixth (or N-th) of the survey walks against
 *  the others, and no test walk is looked at. `--late`, `--ahead`: as of `insole radiomap`, for
 *  map and fixes (defaults are those of the command). `--offset`: the test phone reads so much
 *  too strong. `--limit`: fails when the mean error at the waypoints of the default method is
 *  larger. KEY is one of kde_fix. or ml_fix.
 *
 *  SPDX-License-Identifier: MIT
 */
#include "insole/place/kde_fix.h"
#include "insole/place/ml_fix.h"
#include "mall_scans.h"
#include "radiomap_make.h"

enum { SKIPPED = 77, PARTS = 6 };

static mall_t mall;

static radiomap_file_t file;                 /* the map in work */
static insole_rss_t readings[MALL_READINGS]; /* of the walks, by the numbers of the map */
static const insole_radio_map_t *const map = &file.map;

typedef struct {
    bool survey_only;
    double late_s, ahead_m, offset_db, limit_m;
    uint32_t folds; /* of the survey walks */
    radiomap_options_t map;
    insole_kde_fix_config_t kde;
    insole_ml_fix_config_t ml;
} options_t;

typedef struct {
    double error_m[MALL_SCANS];
    uint32_t count;
    double nees;
} errors_t;

typedef struct {
    const char *name;
    insole_kde_fix_t kde;
    insole_ml_fix_t ml;
    bool by_ml;
    errors_t scans, waypoints;
} method_t;

/* ---- the map ---- */

/* The survey walks but those of one part; `fold` = `folds`: all. */
static bool is_mapped(const mall_walk_t *walk, uint32_t part, uint32_t fold, uint32_t folds)
{
    return !mall_is_test(walk) && (fold == folds || part % folds != fold);
}

static void add_walk(survey_t *survey, const mall_walk_t *walk)
{
    char path[MALL_PATH];
    failure_t failure;
    mall_path(path, (int)walk->number, "");
    if (!survey_add(survey, path, &failure)) {
        exit(failure_report(&failure));
    }
}

/* Readings of the walks have the numbers of the map from now on. */
static void name_readings(void)
{
    static uint32_t numbers[MALL_APS];
    for (uint32_t i = 0; i < mall.ap_count; i++) {
        numbers[i] = RADIOMAP_FILE_UNKNOWN;
        id_table_find(&file.ids, mall.names[i], &numbers[i]);
    }
    for (uint32_t i = 0; i < mall.reading_count; i++) {
        readings[i] = mall.readings[i];
        readings[i].id = numbers[mall.readings[i].id];
    }
}

static void build_map(const options_t *options, uint32_t fold)
{
    survey_t survey;
    failure_t failure;
    unsigned long weird;
    memset(&survey, 0, sizeof survey);
    survey.rule = radiomap_rule(options->late_s, options->ahead_m);
    for (uint32_t w = 0, part = 0; w < mall.walk_count; w++) {
        const mall_walk_t *walk = &mall.walks[w];
        if (is_mapped(walk, part, fold, options->folds)) {
            add_walk(&survey, walk);
        }
        part += mall_is_test(walk) ? 0u : 1u;
    }
    radiomap_file_free(&file);
    if (!radiomap_make(&file, &survey, &options->map, &weird, &failure)) {
        exit(failure_report(&failure));
    }
    survey_free(&survey);
    name_readings();
}

/* ---- errors ---- */

static double nees_of(const insole_radio_fix_t *fix, double x_m, double y_m)
{
    double xx = (double)fix->var_x_m2, xy = (double)fix->cov_xy_m2, yy = (double)fix->var_y_m2;
    return (yy * x_m * x_m - 2.0 * xy * x_m * y_m + xx * y_m * y_m) / (xx * yy - xy * xy);
}

static void note(errors_t *errors, const insole_radio_fix_t *fix, double x_m, double y_m)
{
    double off_x_m = (double)fix->spot.x_m - x_m, off_y_m = (double)fix->spot.y_m - y_m;
    errors->error_m[errors->count++] = sqrt(off_x_m * off_x_m + off_y_m * off_y_m);
    errors->nees += nees_of(fix, off_x_m, off_y_m);
}

static insole_status_t solve(method_t *method, const mall_scan_t *scan, double offset_db,
                             insole_radio_fix_t *fix)
{
    static insole_rss_t heard[MALL_LINE * 8];
    for (uint32_t i = 0; i < scan->count; i++) {
        heard[i] = readings[scan->first + i];
        heard[i].rss_dbm += (insole_real_t)offset_db;
    }
    return method->by_ml ? insole_ml_fix_solve(&method->ml, map, NULL, heard, scan->count, fix)
                         : insole_kde_fix_solve(&method->kde, map, NULL, heard, scan->count, fix);
}

static void note_waypoints(method_t *method, const mall_walk_t *walk, double from_s, double to_s,
                           double known_from_s, const insole_radio_fix_t *fix)
{
    for (uint32_t i = 0; i < walk->waypoint_count; i++) {
        const mall_waypoint_t *at = &walk->waypoints[i];
        if (at->t_s >= from_s && at->t_s < to_s && at->t_s >= known_from_s) {
            note(&method->waypoints, fix, at->x_m, at->y_m);
        }
    }
}

static void walk_through(method_t *method, const mall_walk_t *walk, double offset_db)
{
    insole_radio_fix_t fix;
    bool has_fix = false;
    double first_s = HUGE_VAL;
    for (uint32_t i = 0; i < walk->scan_count; i++) {
        const mall_scan_t *scan = &mall.scans[walk->first_scan + i];
        double next_s = i + 1u < walk->scan_count ? scan[1].t_s : HUGE_VAL;
        if (solve(method, scan, offset_db, &fix) == INSOLE_OK) {
            first_s = has_fix ? first_s : scan->t_s;
            has_fix = true;
            if (scan->has_truth) {
                note(&method->scans, &fix, scan->x_m, scan->y_m);
            }
        }
        if (has_fix) {
            note_waypoints(method, walk, scan->t_s, next_s, first_s + 1.0, &fix);
        }
    }
}

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double mean_of(const errors_t *errors)
{
    double sum = 0.0;
    for (uint32_t i = 0; i < errors->count; i++) {
        sum += errors->error_m[i];
    }
    return sum / errors->count;
}

static void print_errors(errors_t *errors)
{
    qsort(errors->error_m, errors->count, sizeof errors->error_m[0], compare);
    printf("  %5u %5.2f %5.2f %5.2f %5.2f %5.2f", (unsigned)errors->count, mean_of(errors),
           errors->error_m[errors->count / 2u], errors->error_m[errors->count * 3u / 4u],
           errors->error_m[errors->count * 9u / 10u], errors->nees / errors->count);
}

/* ---- methods ---- */

enum { KDE, KDE_LEARN, GAUSS, GAUSS_PRINTED, ML, ML_MEAN, HISTOGRAM, HISTOGRAM_MEAN, METHODS };

static method_t methods[METHODS];

static void set_up_kde(method_t *method, const char *name, insole_kde_fix_config_t config)
{
    method->name = name;
    if (insole_kde_fix_init(&method->kde, &config) != INSOLE_OK) {
        exit(EXIT_FAILURE);
    }
}

static void set_up_ml(method_t *method, const char *name, insole_ml_fix_config_t config,
                      int32_t density, int32_t answer)
{
    config.density = density;
    config.answer = answer;
    method->name = name;
    method->by_ml = true;
    if (insole_ml_fix_init(&method->ml, &config) != INSOLE_OK) {
        exit(EXIT_FAILURE);
    }
}

static void set_up(const options_t *options)
{
    insole_kde_fix_config_t kde = options->kde;
    set_up_kde(&methods[KDE], "kde sorensen", kde);
    kde.offset = 1;
    set_up_kde(&methods[KDE_LEARN], "  offset learned", kde);
    kde.offset = 0;
    kde.kernel = INSOLE_KDE_FIX_GAUSS;
    set_up_kde(&methods[GAUSS], "kde gauss", kde);
    insole_kde_fix_normal_reference(map, kde.unheard_dbm, &kde.sigma_db);
    set_up_kde(&methods[GAUSS_PRINTED], "  width as printed", kde);
    set_up_ml(&methods[ML], "ml gauss", options->ml, 0, 0);
    set_up_ml(&methods[ML_MEAN], "  mean", options->ml, 0, 1);
    set_up_ml(&methods[HISTOGRAM], "ml histogram", options->ml, 1, 0);
    set_up_ml(&methods[HISTOGRAM_MEAN], "  mean", options->ml, 1, 1);
}

static void run_fold(const options_t *options, uint32_t fold)
{
    build_map(options, fold);
    set_up(options);
    for (uint32_t w = 0, part = 0; w < mall.walk_count; w++) {
        const mall_walk_t *walk = &mall.walks[w];
        bool wanted = fold == options->folds ? mall_is_test(walk)
                                             : !mall_is_test(walk) && part % options->folds == fold;
        for (uint32_t m = 0; wanted && m < METHODS; m++) {
            walk_through(&methods[m], walk, options->offset_db);
        }
        part += mall_is_test(walk) ? 0u : 1u;
    }
}

static void print_table(void)
{
    printf("%u points, %u entries, printed width %.2f dB, offset learned %.2f dB\n",
           (unsigned)map->point_count, (unsigned)map->first[map->point_count],
           (double)methods[GAUSS_PRINTED].kde.config.sigma_db,
           (double)methods[KDE_LEARN].kde.offset_db);
    printf("%-18s%-39s%s\n", "", "  scans: n, mean, 50/75/90 % m, NEES", "waypoints: the same");
    for (uint32_t m = 0; m < METHODS; m++) {
        printf("%-18s", methods[m].name);
        print_errors(&methods[m].scans);
        print_errors(&methods[m].waypoints);
        printf("\n");
    }
}

/* ---- the command line ---- */

#define SET_KEY(kind, key, value, low, high, unit, text)                                           \
    if (strcmp(name, #key) == 0) {                                                                 \
        config->key = (INSOLE_CONFIG_TYPE_##kind)number;                                           \
    }

static void set_kde(insole_kde_fix_config_t *config, const char *name, double number)
{
    INSOLE_KDE_FIX_KEYS(SET_KEY)
}

static void set_ml(insole_ml_fix_config_t *config, const char *name, double number)
{
    INSOLE_ML_FIX_KEYS(SET_KEY)
}

static void take_pair(options_t *options, const char *word)
{
    char name[MALL_LINE];
    double number;
    if (sscanf(word, "kde_fix.%63[a-z_]=%lf", name, &number) == 2) {
        set_kde(&options->kde, name, number);
    } else if (sscanf(word, "ml_fix.%63[a-z_]=%lf", name, &number) == 2) {
        set_ml(&options->ml, name, number);
    }
}

static options_t read_options(int argc, char **argv)
{
    options_t options = {false,
                         RADIOMAP_LATE_S,
                         RADIOMAP_AHEAD_M,
                         0.0,
                         HUGE_VAL,
                         PARTS,
                         {2.5, UINT32_MAX, true},
                         insole_kde_fix_defaults,
                         insole_ml_fix_defaults};
    for (int i = 1; i < argc; i++) {
        double number = i + 1 < argc ? strtod(argv[i + 1], NULL) : 0.0;
        if (strcmp(argv[i], "--survey") == 0) {
            options.survey_only = true;
        } else if (strcmp(argv[i], "--late") == 0) {
            options.late_s = number;
        } else if (strcmp(argv[i], "--ahead") == 0) {
            options.ahead_m = number;
        } else if (strcmp(argv[i], "--folds") == 0) {
            options.folds = (uint32_t)number;
        } else if (strcmp(argv[i], "--offset") == 0) {
            options.offset_db = number;
        } else if (strcmp(argv[i], "--spacing") == 0) {
            options.map.spacing_m = number;
        } else if (strcmp(argv[i], "--limit") == 0) {
            options.limit_m = number;
        } else if (strcmp(argv[i], "--keep") == 0) {
            options.map.keep = (uint32_t)number;
        } else {
            take_pair(&options, argv[i]);
        }
    }
    return options;
}

int main(int argc, char **argv)
{
    options_t options = read_options(argc, argv);
    if (!mall_load(&mall)) {
        return SKIPPED;
    }
    mall_place(&mall, options.late_s, options.ahead_m);
    for (uint32_t fold = 0; options.survey_only && fold < options.folds; fold++) {
        run_fold(&options, fold);
    }
    if (!options.survey_only) {
        run_fold(&options, options.folds);
    }
    print_table();
    return mean_of(&methods[KDE].waypoints) <= options.limit_m ? EXIT_SUCCESS : EXIT_FAILURE;
}
