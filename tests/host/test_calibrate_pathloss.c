/* SPDX-License-Identifier: MIT */
#include "calibrate.h"

#include <math.h>
#include <stdlib.h>

#include "ap_file.h"
#include "calibrations.h"
#include "near.h"
#include "rtt.h"
#include "suite.h"

#ifdef INSOLE_HOST_HAS_SIMULATOR
#include "sim/radio.h"
#include "sim/write.h"
#endif

static failure_t failure;

static const option_t options[] = {{"aps", "FILE", ""},
                                   {"plan", "FILE", ""},
                                   {"height", "M", ""},
                                   {"out", "FILE", ""},
                                   {NULL, NULL, NULL}};

/* What is printed for words like "--aps a.csv"; NULL when it refuses. */
static const char *calibrate(const char *words, const char *const *sessions, size_t count)
{
    return calibrated(calibrate_pathloss, options, words, sessions, count, &failure);
}

/* A value and its standard error. */
typedef struct {
    double value, error;
} measured_t;

static measured_t measured(const char *text, const char *key)
{
    char line[100];
    snprintf(line, sizeof line, "\npropagation.%s = ", key);
    const char *at = strstr(text, line);
    ck_assert_msg(at != NULL, "no %s in:\n%s", key, text);
    measured_t m = {strtod(at + strlen(line), NULL), 0.0};
    const char *error = strstr(at + 1, "+- ");
    m.error = error != NULL ? strtod(error + 3, NULL) : 0.0;
    return m;
}

/* ---- recordings ------------------------------------------------------------------------- */

static const char *const walks[] = {"31", "32", "35", "36", "39", "40", "43", "45"};
enum { WALKS = sizeof walks / sizeof walks[0] };

/* Path of a recording. */
static const char *shared(const char *name)
{
    static char path[8][RECORDED_PATH];
    static int next;
    next = (next + 1) % 8;
    return recorded_path(path[next], name);
}

/* Made with p0 -38, exponent 2, walls of 4 dB of which at most 4 count, 6.81 dB for the body, and
 * a receiver at the body. The standard errors do not hold what the model has otherwise. */
START_TEST(buildings_of_recorded_walks_are_found_again)
{
    static const struct {
        const char *key;
        double truth, mean, worst;
    } values[] = {{"p0_dbm", -38.0, 1.0, 3.0},
                  {"exponent", 2.0, 0.1, 0.35},
                  {"wall_db", 4.0, 0.3, 0.8},
                  {"body_db", 6.81, 0.3, 1.0}};
    double sum[4] = {0.0}, squares[4] = {0.0};
    for (int i = 0; i < WALKS; i++) {
        char name[64], words[2000];
        snprintf(name, sizeof name, "buildings/llio_%s", walks[i]);
        const char *const folder = shared(name);
        snprintf(words, sizeof words, "--plan %s/plan.csv --aps %s/aps.csv --height 1.1", folder,
                 folder);
        snprintf(name, sizeof name, "buildings/llio_%s/plan.csv", walks[i]);
        if (!recorded_is_there(shared(name))) {
            return;
        }
        const char *text = calibrate(words, &folder, 1u);
        ck_assert_msg(text != NULL, "%s", failure.text);
        for (int k = 0; k < 4; k++) {
            measured_t m = measured(text, values[k].key);
            ASSERT_NEAR(m.value, values[k].truth, values[k].worst, values[k].key);
            sum[k] += m.value / WALKS;
            squares[k] += pow((m.value - values[k].truth) / m.error, 2.0) / WALKS;
        }
        ck_assert_ptr_null(strstr(text, "# !"));
    }
    for (int k = 0; k < 4; k++) {
        printf("%s: %.2f in the mean of %d walks, true %.2f; rms of error over standard error "
               "%.2f\n",
               values[k].key, sum[k], WALKS, values[k].truth, sqrt(squares[k]));
        ASSERT_NEAR(sum[k], values[k].truth, values[k].mean, values[k].key);
        ASSERT_AT_MOST(sqrt(squares[k]), 2.5, "standard errors");
    }
}
END_TEST

/* The plan of one walk for another, or an access point somewhere else, does not go unnoticed. */
START_TEST(a_wrong_plan_and_a_wrong_place_are_told)
{
    const char *const folder = shared("buildings/llio_40");
    char words[2000], line[200];
    if (!recorded_is_there(shared("buildings/llio_40/plan.csv"))) {
        return;
    }
    snprintf(words, sizeof words, "--plan %s --aps %s/aps.csv",
             shared("buildings/llio_31/plan.csv"), folder);
    const char *text = calibrate(words, &folder, 1u);
    ck_assert_msg(text != NULL, "%s", failure.text);
    ck_assert_msg(strstr(text, "% of the readings were made outside the plan") != NULL, "%s", text);
    const char *moved = scratch("moved.csv");
    snprintf(words, sizeof words, "%s/aps.csv", folder);
    FILE *from = fopen(words, "rb"), *to = fopen(moved, "wb");
    double x = 0.0, y = 0.0;
    while (fgets(line, sizeof line, from) != NULL) {
        if (sscanf(line, "ap03,%lf,%lf", &x, &y) == 2) {
            snprintf(line, sizeof line, "ap03,%.2f,%.2f,2.5,-38,2,-47\n", x + 25.0, y - 12.0);
        }
        fputs(line, to);
    }
    fclose(from);
    fclose(to);
    snprintf(words, sizeof words, "--plan %s/plan.csv --aps %s --height 1.1", folder, moved);
    text = calibrate(words, &folder, 1u);
    ck_assert_msg(text != NULL, "%s", failure.text);
    const char *told = strstr(text, "# ! ap03: residuals scatter by ");
    ck_assert_msg(told != NULL, "%s", text);
    ck_assert_msg(strstr(strstr(text, "# !") + 3, "# !") == NULL, "others too:\n%s", text);
    double found_x, found_y;
    const char *fits = strstr(told, "it would fit at ");
    ck_assert_msg(fits != NULL, "%s", text);
    ck_assert_int_eq(sscanf(fits, "it would fit at %lf, %lf", &found_x, &found_y), 2);
    ASSERT_NEAR(hypot(found_x - x, found_y - y), 0.0, 6.0, "m from where it is");
}
END_TEST

/* One log of a run's records and its truth. */
static const char *session_of_run(int scene, const char *run)
{
    char name[100], line[200];
    snprintf(name, sizeof name, "%s_%s.csv", rtt_names[scene], run);
    const char *path = scratch(name);
    FILE *to = fopen(path, "wb");
    for (int i = 0; i < 2; i++) {
        FILE *from = rtt_open(scene, "run_", run, i == 0 ? ".csv" : ".truth.csv");
        ck_assert_ptr_nonnull(from);
        while (fgets(line, sizeof line, from) != NULL) {
            if (i == 0) {
                fputs(line, to);
            } else if (line[0] != 't') {
                fprintf(to, "truth,%s", line);
            }
        }
        fclose(from);
    }
    fclose(to);
    return path;
}

/* Nobody knows the truth here: what comes out must be possible, and is printed. */
START_TEST(recorded_signal_strengths_give_possible_values)
{
    const char *sessions[10];
    char name[100], words[600];
    size_t count = 0u;
    snprintf(name, sizeof name, "rtt/%s/aps.csv", rtt_names[_i]);
    if (!recorded_is_there(shared(name))) {
        return;
    }
    for (; count < 10u && rtt_runs[_i][count] != NULL; count++) {
        sessions[count] = session_of_run(_i, rtt_runs[_i][count]);
    }
    snprintf(words, sizeof words, "--aps %s", shared(name));
    const char *text = calibrate(words, sessions, count);
    ck_assert_msg(text != NULL, "%s", failure.text);
    measured_t p0 = measured(text, "p0_dbm"), sigma = measured(text, "sigma_db");
    ASSERT_NEAR(p0.value, -45.0, 20.0, "dBm");
    ASSERT_NEAR(sigma.value, 5.0, 3.0, "dB");
    ck_assert_ptr_nonnull(strstr(text, "# propagation.wall_db is not observable, 5.00 assumed: "
                                       "there is no plan"));
    printf("%s: p0 %.1f +- %.1f dBm, scale of the residuals %.1f dB\n", rtt_names[_i], p0.value,
           p0.error, sigma.value);
}
END_TEST

/* ---- simulated surveys ------------------------------------------------------------------ */

#ifdef INSOLE_HOST_HAS_SIMULATOR

static void copy_map(const char *building, const char *file)
{
    char path[600];
    int c;
    snprintf(path, sizeof path, MAPS "/%s/%s", building, file);
    FILE *from = fopen(path, "rb"), *to = fopen(scratch(file), "wb");
    while ((c = fgetc(from)) != EOF) {
        fputc(c, to);
    }
    fclose(from);
    fclose(to);
}

/* Surveys a building of maps/. @return the folder of the survey */
static const char *survey(const char *building, const char *scenario, uint64_t seed)
{
    char error[512];
    copy_map(building, "plan.csv");
    copy_map(building, "aps.csv");
    const char *path = scratch_file("scenario", scenario), *folder = scratch("walk");
    int answer = sim_write_scenario(path, folder, seed, NULL, error, sizeof error);
    ck_assert_msg(answer == 0, "%s", error);
    return folder;
}

/* The values of each access point, from the file that was written. */
static ap_file_t written(const char *path)
{
    ap_file_t aps;
    ck_assert_msg(ap_file_read(&aps, path, &insole_propagation_defaults, &failure), "%s",
                  failure.text);
    return aps;
}

#define SURVEY                                                                                     \
    "plan,plan.csv\naps,aps.csv\nimu.rate_hz = 50\nradio.place = body\nlog.imu = none\n"           \
    "log.truth = body\nlog.truth_hz = 5\nsurvey.pause_s = 3\n"
#define OFFICE         SURVEY "start,2,2,0\nsurvey,3\nsurvey.directions = 2\n"
#define STUDENT_CENTRE SURVEY "start,18,10,0\nsurvey,5\n"

static const char *const words_of_survey = "--plan " SCRATCH "/walk/plan.csv --aps " SCRATCH
                                           "/aps.csv --height 1.1 --out " SCRATCH "/new.csv";

/* Where the model is the simulator's, each access point's values come back. */
START_TEST(a_matched_survey_gives_back_what_the_files_tell)
{
    const char *const folder =
        survey(_i == 0 ? "office" : "student_centre",
               _i == 0 ? OFFICE "radio.model = matched\nradio.floor_dbm = -200\n"
                       : STUDENT_CENTRE "radio.model = matched\nradio.floor_dbm = -200\n",
               3u);
    const char *text = calibrate(words_of_survey, &folder, 1u);
    ck_assert_msg(text != NULL, "%s", failure.text);
    measured_t body = measured(text, "body_db"), sigma = measured(text, "sigma_db");
    ASSERT_NEAR(body.value, 0.0, 4.0 * body.error + 0.1, "dB");
    ASSERT_NEAR(sigma.value, 0.785 * 4.0, 0.2, "dB"); /* Student's scale of 1-sigma 4 dB */
    const char *count = strstr(text, " count ");
    double scale, error;
    ck_assert_int_eq(sscanf(count, " count %lf +- %lf times", &scale, &error), 2);
    ASSERT_NEAR(scale, 1.0, 4.0 * error + 0.01, "");
    ck_assert_ptr_null(strstr(text, "# !"));
    ap_file_t told = written(SCRATCH "/aps.csv"), found = written(SCRATCH "/new.csv");
    ck_assert_uint_eq(told.count, found.count);
    for (size_t i = 0u; i < told.count; i++) {
        ck_assert_str_eq(told.ids.names[i], found.ids.names[i]);
        ASSERT_NEAR((double)found.aps[i].x_m, (double)told.aps[i].x_m, 1e-3, "m");
        /* What the simulator does not lose to multipath stands in p0. */
        ASSERT_NEAR((double)found.aps[i].p0_dbm, (double)told.aps[i].p0_dbm + 2.0, 4.0, "dBm");
        ASSERT_NEAR((double)found.aps[i].exponent, (double)told.aps[i].exponent, 0.3, "");
        /* 4 dB at most at 1.5 m, where near_dbm is, with the body's half. */
        double near_dbm = (double)found.aps[i].p0_dbm -
                          17.6091 * 0.1 * (double)found.aps[i].exponent - 2.0 - 0.5 * body.value;
        ASSERT_NEAR((double)found.aps[i].near_dbm, near_dbm, 0.11, "dBm");
    }
    ap_file_free(&told);
    ap_file_free(&found);
}
END_TEST

/* Adds squared errors of what is expected at 5 m in free sight, where p0 and exponent count
 * together, by the fit and by what aps.csv believes. */
static void add_errors(const char *scenario, uint64_t seed, double *fitted, double *told)
{
    sim_scenario_t s;
    sim_radio_t radio;
    sim_error_t error;
    ck_assert(sim_scenario_load(scenario, &s, &error));
    ck_assert(sim_radio_open(&radio, &s, seed, &error));
    ap_file_t found = written(SCRATCH "/new.csv"), file = written(SCRATCH "/aps.csv");
    for (size_t i = 0u; i < found.count; i++) {
        const sim_source_t *source = sim_list_at(&radio.sources, i);
        double loss_db = 10.0 * log10(5.0), count = (double)found.count;
        double truth = source->p0_dbm + radio.offset_db - source->exponent * loss_db;
        double by_fit = (double)found.aps[i].p0_dbm - 2.0 - (double)found.aps[i].exponent * loss_db;
        double by_file = (double)file.aps[i].p0_dbm - (double)file.aps[i].exponent * loss_db;
        *fitted += (by_fit - truth) * (by_fit - truth) / count;
        *told += (by_file - truth) * (by_file - truth) / count;
    }
    ap_file_free(&file);
    ap_file_free(&found);
    sim_radio_close(&radio);
    sim_scenario_free(&s);
}

/* With everything the simulator has: shadows of 3.5 dB, walls that differ, a receiver that is off,
 * fading. A survey knows the strength at 5 m of each access point better than its file does. */
START_TEST(a_full_survey_finds_the_access_points_of_the_building)
{
    double fitted = 0.0, told = 0.0;
    for (uint64_t seed = 1u; seed <= 2u; seed++) {
        char scenario[800];
        snprintf(scenario, sizeof scenario, "%sradio.building = %d\n",
                 _i == 0 ? OFFICE : STUDENT_CENTRE, (int)seed);
        const char *const folder = survey(_i == 0 ? "office" : "student_centre", scenario, seed);
        const char *text = calibrate(words_of_survey, &folder, 1u);
        ck_assert_msg(text != NULL, "%s", failure.text);
        measured_t exponent = measured(text, "exponent"), body = measured(text, "body_db");
        ASSERT_NEAR(exponent.value, 2.2, 4.0 * exponent.error, "");
        /* The simulator's body takes 6.8 dB (1 - cos) / 2, which the model's shape meets best with
         * 0.73 of that. */
        ASSERT_NEAR(body.value, 0.73 * 6.8, 4.0 * body.error, "dB");
        add_errors(scratch("scenario"), seed, &fitted, &told);
    }
    printf("%s: strength at 5 m of each access point, rms error %.1f dB, that of the file %.1f "
           "dB\n",
           _i == 0 ? "office" : "student centre", sqrt(fitted / 2.0), sqrt(told / 2.0));
    ASSERT_AT_MOST(fitted, told, "dB^2");
}
END_TEST

#endif

/* ---- wrong input ------------------------------------------------------------------------ */

#define WALK                                                                                       \
    "truth,0,0,0\ntruth,60,30,0\nrss,1,a,-50\nrss,2,a,-51\nrss,3,a,-52\nrss,4,a,-50\nrss,5,a,-"    \
    "50\n"

static const struct {
    const char *log, *words, *says;
    int exit_code;
} refusals[] = {
    {WALK, "", "insole calibrate pathloss: no access points: expected --aps FILE",
     EXIT_WRONG_USAGE},
    {WALK, "--aps " SCRATCH "/one.csv --height x", "--height x: expected a number",
     EXIT_WRONG_USAGE},
    {WALK, "--aps " SCRATCH "/absent.csv", "absent.csv: cannot open", EXIT_BAD_INPUT},
    {WALK, "--aps " SCRATCH "/one.csv --plan " SCRATCH "/absent.csv", "absent.csv: cannot open",
     EXIT_BAD_INPUT},
    {"rss,1,a,-50\n", "--aps " SCRATCH "/one.csv", "log.csv: no truth", EXIT_BAD_INPUT},
    {"truth,1,0,0\n", "--aps " SCRATCH "/one.csv", "log.csv: no signal strengths", EXIT_BAD_INPUT},
    {"truth,0,0,0\ntruth,9,9,0\nrss,10,a,-50\n", "--aps " SCRATCH "/one.csv",
     "none of the 1 readings lies within the times of its truth", EXIT_BAD_INPUT},
    {"truth,0,0,0\ntruth,9,9,0\nrss,5,b,-50\nrss,5,c,-50\n", "--aps " SCRATCH "/one.csv",
     "one.csv: none of the 2 access points heard is in it: heard are b, ...; the file has a, ...",
     EXIT_BAD_INPUT},
    {"truth,0,0,0\ntruth,9,0,1\nrss,5,a,-50\nrss,6,a,-50\n", "--aps " SCRATCH "/one.csv",
     "the survey stands at one place", EXIT_BAD_INPUT},
    {WALK, "--aps " SCRATCH "/one.csv", "only 5 readings of known access points: expected 20",
     EXIT_BAD_INPUT},
};

START_TEST(what_cannot_be_calibrated_is_refused_with_the_reason)
{
    scratch_file("one.csv", "id,x,y\na,10,3\n");
    const char *const path = scratch_file("log.csv", refusals[_i].log);
    ck_assert_ptr_null(calibrate(refusals[_i].words, &path, 1u));
    ck_assert_msg(strstr(failure.text, refusals[_i].says) != NULL, "%s", failure.text);
    ck_assert_int_eq(failure.exit_code, refusals[_i].exit_code);
}
END_TEST

/* A walk of a minute past one access point, with another that is nowhere in the file. */
static const char *write_walk(void)
{
    const char *path = scratch("past.csv");
    FILE *file = fopen(path, "wb");
    srand(81);
    fputs("truth,0,0,0\ntruth,60,60,0\n", file);
    for (int t = 1; t < 70; t++) {
        double away = hypot(hypot(t - 20.0, 3.0), 2.5);
        fprintf(file, "rss,%d,a,%.1f\nrss,%d,stranger,-70\n", t,
                -42.0 - 22.0 * log10(away) - (t > 20 ? 5.0 : 0.0) + 2.0 * (rand() % 3 - 1), t);
    }
    fclose(file);
    return path;
}

START_TEST(what_is_left_out_and_what_cannot_be_seen_is_told)
{
    const char *const path = write_walk();
    const char *aps = scratch_file("two.csv", "id,x,y,z\na,20,3,2.5\nsilent,90,90,2.5\n");
    char words[600];
    snprintf(words, sizeof words, "--aps %s", aps);
    const char *text = calibrate(words, &path, 1u);
    ck_assert_msg(text != NULL, "%s", failure.text);
    static const char *const told[] = {
        "# calibrate pathloss: 60 readings, 60 scans, 1 session, ",
        "# left out: 18 readings outside the truth, 0 without a number\n",
        "# left out: 60 readings of 1 access point not in the file: stranger\n",
        "# propagation.wall_db is not observable, 5.00 assumed: there is no plan\n",
        "# propagation.multipath_db is not observable, 2.00 assumed: it is not told apart from",
        "#   silent: never heard: it gets the values of all\n"};
    for (size_t i = 0u; i < sizeof told / sizeof told[0]; i++) {
        ck_assert_msg(strstr(text, told[i]) != NULL, "lacks %s:\n%s", told[i], text);
    }
    measured_t p0 = measured(text, "p0_dbm");
    ASSERT_NEAR(p0.value, -40.0, 3.0 * p0.error, "dBm");
}
END_TEST

START_TEST(the_access_points_read_are_not_overwritten)
{
    const char *const path = write_walk();
    const char *aps = scratch_file("two.csv", "id,x,y,z\na,20,3,2.5\nsilent,90,90,2.5\n");
    char words[600];
    snprintf(words, sizeof words, "--aps %s --out %s", aps, aps);
    ck_assert_ptr_null(calibrate(words, &path, 1u));
    ck_assert_msg(strstr(failure.text, "would overwrite what is read") != NULL, "%s", failure.text);
    ck_assert_int_eq(failure.exit_code, EXIT_WRONG_USAGE);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("host/calibrate_pathloss");
    suite_add(suite, "recordings", buildings_of_recorded_walks_are_found_again);
    suite_add(suite, "recordings", a_wrong_plan_and_a_wrong_place_are_told);
    suite_add_loop(suite, "recordings", recorded_signal_strengths_give_possible_values, 2);
#ifdef INSOLE_HOST_HAS_SIMULATOR
    suite_add_loop(suite, "surveys", a_matched_survey_gives_back_what_the_files_tell, 2);
    suite_add_loop(suite, "surveys", a_full_survey_finds_the_access_points_of_the_building, 2);
#endif
    suite_add_loop(suite, "refusals", what_cannot_be_calibrated_is_refused_with_the_reason,
                   (int)(sizeof refusals / sizeof refusals[0]));
    suite_add(suite, "report", what_is_left_out_and_what_cannot_be_seen_is_told);
    suite_add(suite, "report", the_access_points_read_are_not_overwritten);
    return suite;
}
