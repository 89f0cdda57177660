/* SPDX-License-Identifier: MIT */
#include "sim/write.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "near.h"
#include "sim/algebra.h"
#include "suite.h"

#define OUT SIM_OUTPUT_DIR "/walks"

enum { MOST_BYTES = 4000000 };

/* Writes a scenario file and simulates it into a folder of its own. */
static int simulate(const char *name, const char *text, uint64_t seed, sim_report_t *report,
                    char error[512])
{
    char path[600], folder[600];
    snprintf(path, sizeof path, "%s_%s.scenario", OUT, name);
    snprintf(folder, sizeof folder, "%s_%s", OUT, name);
    FILE *stream = fopen(path, "w");
    ck_assert_ptr_nonnull(stream);
    fputs(text, stream);
    fclose(stream);
    return sim_write_scenario(path, folder, seed, report, error, 512);
}

static char *text_of(const char *name, const char *file)
{
    char path[600];
    snprintf(path, sizeof path, "%s_%s/%s", OUT, name, file);
    FILE *stream = fopen(path, "r");
    ck_assert_msg(stream != NULL, "%s", path);
    char *text = malloc(MOST_BYTES);
    ck_assert_ptr_nonnull(text);
    size_t size = fread(text, 1, MOST_BYTES - 1, stream);
    ck_assert_uint_lt(size, MOST_BYTES - 1);
    text[size] = '\0';
    fclose(stream);
    return text;
}

static size_t lines_of(const char *text, const char *begin)
{
    size_t count = strncmp(text, begin, strlen(begin)) == 0 ? 1u : 0u;
    for (const char *at = strchr(text, '\n'); at != NULL; at = strchr(at + 1, '\n')) {
        count += strncmp(at + 1, begin, strlen(begin)) == 0 && at[1] != '\0' ? 1u : 0u;
    }
    return count;
}

#define WALK "start,2,3,0.5\nwalk,8,3,1.2\n"

START_TEST(log_and_truth_have_the_agreed_form)
{
    char error[512];
    sim_report_t report;
    ck_assert_msg(simulate("form", WALK, 1, &report, error) == 0, "%s", error);
    char *log = text_of("form", "log.csv"), *truth = text_of("form", "truth.csv");
    double x, y, heading, t, v[6], p[3];
    ck_assert_int_eq(sscanf(log, "start,0,%lf,%lf,%lf\n", &x, &y, &heading), 3);
    const char *imu = strchr(log, '\n') + 1;
    ck_assert_int_eq(sscanf(imu, "imu,%lf,%lf,%lf,%lf,%lf,%lf,%lf\n", &t, &v[0], &v[1], &v[2],
                            &v[3], &v[4], &v[5]),
                     7);
    ASSERT_NEAR(t, 0.0, 0.0, "s");
    ASSERT_NEAR(sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]), 9.81, 0.5, "m/s^2");
    ck_assert(strncmp(truth, "t,x,y,z\n", 8) == 0);
    ck_assert_int_eq(sscanf(truth + 8, "%lf,%lf,%lf,%lf\n", &t, &p[0], &p[1], &p[2]), 4);
    ASSERT_NEAR(p[0], x, 1e-3, "m"); /* the start is where the truth begins */
    ASSERT_NEAR(p[1], y, 1e-3, "m");
    ASSERT_NEAR(p[2], 0.08, 1e-3, "m");
    ASSERT_NEAR(heading, 0.0, 0.05, "rad");
    ck_assert_uint_eq(lines_of(log, "imu,"), report.samples);
    ck_assert_uint_eq(lines_of(log, ""), report.samples + 1u);
    ASSERT_NEAR((double)lines_of(truth, "") - 1.0, report.duration_s * 50.0, 1.0, "rows");
    free(log);
    free(truth);
}
END_TEST

/* A file beside the scenarios of this suite. */
static void write_beside(const char *file, const char *text)
{
    char path[600];
    snprintf(path, sizeof path, "%s/%s", SIM_OUTPUT_DIR, file);
    FILE *stream = fopen(path, "w");
    ck_assert_ptr_nonnull(stream);
    fputs(text, stream);
    fclose(stream);
}

#define PLAN  "# a hall\nloss,7\noutline,0,0,20,0,20,9,0,9\nwall,3,5,5,9,5\n"
#define APS   "x,y,id,p0_dbm\n2,8,first,-40\n18,1,se cond,-41\n"
#define RADIO "plan,walks_plan.csv\naps,walks_aps.csv\nradio.period_s = 0.25\n"

START_TEST(scans_are_merged_into_the_log)
{
    char error[512];
    sim_report_t report;
    write_beside("walks_plan.csv", PLAN);
    write_beside("walks_aps.csv", APS);
    const char *text = RADIO WALK "radio.late_share = 0.3\n";
    ck_assert_msg(simulate("radio", text, 1, &report, error) == 0, "%s", error);
    char *log = text_of("radio", "log.csv");
    double last = -1.0, t, dbm, age, late = 0.0, signals = 0.0;
    char id[20];
    for (const char *at = strchr(log, '\n') + 1; *at != '\0'; at = strchr(at, '\n') + 1) {
        if (sscanf(at, "imu,%lf", &t) != 1) {
            int fields = sscanf(at, "rss,%lf,%19[^,],%lf,%lf\n", &t, id, &dbm, &age);
            ck_assert_msg(fields >= 3, "%.40s", at);
            ck_assert(strcmp(id, "first") == 0 || strcmp(id, "se cond") == 0);
            ck_assert(dbm == round(dbm) && dbm > -100.0 && dbm < -30.0);
            ck_assert(fields == 3 || (age > 0.0 && age < 10.0));
            late += fields == 4 ? 1.0 : 0.0;
            signals += 1.0;
        }
        ck_assert_msg(t >= last, "%g after %g", t, last);
        last = t;
    }
    ASSERT_NEAR(signals, 8.0 * report.duration_s, 10.0, "signals");
    ASSERT_NEAR(signals, (double)report.signals, 0.0, "signals");
    ASSERT_NEAR(late / signals, 0.3, 0.15, "1");
    free(log);
    ck_assert_int_eq(simulate("radio", RADIO WALK "radio.late_share = 1\nradio.age = silent\n", 1,
                              &report, error),
                     0);
    log = text_of("radio", "log.csv");
    for (const char *at = strstr(log, "\nrss"); at != NULL; at = strstr(at + 1, "\nrss")) {
        ck_assert_int_eq(sscanf(at, "\nrss,%lf,%19[^,],%lf,%lf", &t, id, &dbm, &age), 3);
    }
    free(log);
}
END_TEST

START_TEST(the_radio_leaves_the_sensor_alone)
{
    char error[512];
    ck_assert_int_eq(simulate("with", RADIO WALK, 3, NULL, error), 0);
    ck_assert_int_eq(simulate("without", WALK, 3, NULL, error), 0);
    char *with = text_of("with", "log.csv"), *without = text_of("without", "log.csv");
    size_t kept = 0;
    for (char *at = with, *next; *at != '\0'; at = next) { /* the log without its scans */
        next = strchr(at, '\n') + 1;
        if (strncmp(at, "rss", 3) != 0) {
            memmove(with + kept, at, (size_t)(next - at));
            kept += (size_t)(next - at);
        }
    }
    ck_assert_uint_eq(kept, strlen(without));
    ck_assert_int_eq(memcmp(with, without, kept), 0);
    free(with);
    free(without);
}
END_TEST

START_TEST(plan_and_access_points_are_written_too)
{
    char error[512];
    ck_assert_int_eq(simulate("site", RADIO WALK "radio.near = told\n", 1, NULL, error), 0);
    char *plan = text_of("site", "plan.csv"), *aps = text_of("site", "aps.csv");
    ck_assert_str_eq(plan, PLAN);
    ck_assert_str_eq(aps, APS);
    free(plan);
    free(aps);
    ck_assert_int_eq(simulate("site", RADIO WALK "radio.model = matched\n", 1, NULL, error), 0);
    aps = text_of("site", "aps.csv");
    /* -40 - 20 lg of 1.5 m aside and 1.4 m up */
    ck_assert_str_eq(aps, "id,x,y,z,p0_dbm,exponent,near_dbm\nfirst,2,8,,-40,,-46.2\n"
                          "se cond,18,1,,-41,,-47.2\n");
    free(aps);
}
END_TEST

static const struct {
    const char *plan, *aps, *says;
} bad_sites[] = {
    {"outline,0,0,1\n", APS, "/walks_plan.csv:1: a point has no y"},
    {"\nroom,0,0,1\n", APS, "/walks_plan.csv:2: 'room' is no part of a plan"},
    {PLAN, "id,x,y\n\na,1\n", "/walks_aps.csv:3: too few fields"},
    {PLAN, "a,1,2\n", "/walks_aps.csv:1: the column 'a' is unknown"},
    {"outline,0,0,5,0,5,9,0,9\n", APS, ".scenario:5: the way to 8,3 crosses a wall"},
};

START_TEST(bad_plans_and_access_points_are_refused_with_file_and_line)
{
    char error[512];
    write_beside("walks_plan.csv", bad_sites[_i].plan);
    write_beside("walks_aps.csv", bad_sites[_i].aps);
    int done = simulate("badsite", RADIO WALK, 1, NULL, error);
    write_beside("walks_plan.csv", PLAN);
    write_beside("walks_aps.csv", APS);
    ck_assert_int_eq(done, -1);
    ck_assert_msg(strstr(error, bad_sites[_i].says) != NULL, "says: %s", error);
}
END_TEST

START_TEST(the_report_tells_what_was_simulated)
{
    char error[512];
    sim_report_t report;
    ck_assert_int_eq(simulate("report",
                              WALK "imu.dropouts_hz = 1\nimu.dropout_s = 0.1\n"
                                   "imu.accel_range_mps2 = 20\n",
                              1, &report, error),
                     0);
    char *log = text_of("report", "log.csv");
    ASSERT_NEAR(report.distance_m, 6.0, 1e-9, "m");
    ASSERT_NEAR((double)report.samples, 200.0 * report.duration_s, 1.0, "samples");
    ck_assert_uint_eq(lines_of(log, "imu,"), report.samples - report.lost);
    ck_assert_uint_gt(report.lost, 10u);
    ck_assert_uint_gt(report.clipped, 10u);
    ck_assert_uint_ge(report.steps, 8u);
    ck_assert_uint_le(report.steps, 12u);
    free(log);
}
END_TEST

START_TEST(equal_seeds_write_equal_files)
{
    char error[512];
    ck_assert_int_eq(simulate("seed_a", WALK, 7, NULL, error), 0);
    ck_assert_int_eq(simulate("seed_b", WALK, 7, NULL, error), 0);
    ck_assert_int_eq(simulate("seed_c", WALK, 8, NULL, error), 0);
    static const char *const files[] = {"log.csv", "truth.csv"};
    for (int i = 0; i < 2; i++) {
        char *a = text_of("seed_a", files[i]), *b = text_of("seed_b", files[i]);
        char *c = text_of("seed_c", files[i]);
        ck_assert_int_eq(strcmp(a, b), 0);
        ck_assert_int_ne(strcmp(a, c), 0);
        free(a);
        free(b);
        free(c);
    }
}
END_TEST

START_TEST(truth_comes_at_its_own_rate)
{
    static const double rates[] = {0.0, 1.0, 100.0, 1000.0}; /* never more than one a sample */
    static const double rows[] = {200.0, 1.0, 100.0, 200.0};
    for (int i = 0; i < 4; i++) {
        char error[512], text[100];
        sim_report_t report;
        snprintf(text, sizeof text, "%slog.truth_hz = %g\n", WALK, rates[i]);
        ck_assert_int_eq(simulate("rate", text, 1, &report, error), 0);
        char *truth = text_of("rate", "truth.csv");
        double count = (double)lines_of(truth, "") - 1.0;
        ASSERT_NEAR(count, report.duration_s * rows[i], 1.01, "rows");
        free(truth);
    }
}
END_TEST

START_TEST(the_start_can_be_wrong_or_left_out)
{
    char error[512];
    ck_assert_int_eq(simulate("nostart", WALK "log.start = none\n", 1, NULL, error), 0);
    char *log = text_of("nostart", "log.csv");
    ck_assert_uint_eq(lines_of(log, "start"), 0u);
    free(log);
    double sum = 0.0, turn = 0.0;
    int n = 60;
    for (int seed = 1; seed <= n; seed++) {
        double x, y, heading, sigma_m, sigma_rad;
        ck_assert_int_eq(simulate("wrong",
                                  "start,2,3,0\nwalk,4,3,1.2\nlog.start_sigma_m = 0.5\n"
                                  "log.start_sigma_rad = 0.2\nwalk.lead_in_s = 0\n",
                                  (uint64_t)seed, NULL, error),
                         0);
        log = text_of("wrong", "log.csv");
        ck_assert_int_eq(
            sscanf(log, "start,0,%lf,%lf,%lf,%lf,%lf\n", &x, &y, &heading, &sigma_m, &sigma_rad),
            5);
        ASSERT_NEAR(sigma_m, 0.5, 1e-9, "m");
        ASSERT_NEAR(sigma_rad, 0.2, 1e-9, "rad");
        sum += (pow(x - 2.06, 2.0) + pow(y - 2.934, 2.0)) / (2.0 * n);
        turn += heading * heading / n;
        free(log);
    }
    ASSERT_NEAR(sqrt(sum), 0.5, 0.13, "m");
    ASSERT_NEAR(sqrt(turn), 0.2, 0.075, "rad");
}
END_TEST

static const struct {
    const char *text, *says;
} refusals[] = {
    {"start,0,0,0\nwalk,9\n", ".scenario:2: too few fields, expected walk,x,y,speed"},
    {"start,0,0,0\nimu.rate = 5\n", ".scenario:2: no setting is called 'imu.rate'"},
    {"start,0,0,0\n\n\nwalk,0.1,0,1\n", ".scenario:4: the waypoint is 0.10 m from where"},
    {"", ".scenario:1: the scenario has no start"},
};

START_TEST(bad_scenarios_are_refused_with_file_and_line)
{
    char error[512];
    ck_assert_int_eq(simulate("bad", refusals[_i].text, 1, NULL, error), -1);
    ck_assert_msg(strstr(error, refusals[_i].says) != NULL, "says: %s", error);
    ck_assert_ptr_nonnull(strstr(error, OUT));
}
END_TEST

START_TEST(files_that_cannot_be_opened_are_told)
{
    char error[512];
    ck_assert_int_eq(simulate("noplan", "plan,nowhere.csv\n" WALK, 1, NULL, error), -1);
    ck_assert_ptr_nonnull(strstr(error, "/nowhere.csv: cannot be opened"));
    int done = sim_write_scenario(OUT "_nowhere/scenario", OUT "_x", 1, NULL, error, sizeof error);
    ck_assert_int_eq(done, -1);
    ck_assert_ptr_nonnull(strstr(error, "_nowhere/scenario: cannot be opened"));
    ck_assert_int_eq(simulate("file", WALK, 1, NULL, error), 0);
    done = sim_write_scenario(OUT "_file.scenario", OUT "_file.scenario", 1, NULL, error,
                              sizeof error);
    ck_assert_int_eq(done, -1);
    ck_assert_ptr_nonnull(strstr(error, "cannot be"));
    done = sim_write_scenario(OUT "_file.scenario", OUT "_no/such/folder", 1, NULL, error,
                              sizeof error);
    ck_assert_int_eq(done, -1);
    ck_assert_ptr_nonnull(strstr(error, "_no/such/folder cannot be made"));
    ck_assert_int_eq(sim_write_scenario("", "", 1, NULL, NULL, 0), -1);
}
END_TEST

START_TEST(long_errors_fit_the_room)
{
    char error[20];
    memset(error, 'x', sizeof error);
    ck_assert_int_eq(sim_write_scenario(OUT "_nowhere", OUT "_x", 1, NULL, error, 10), -1);
    ck_assert_uint_eq(strlen(error), 9u);
    ck_assert_int_eq(error[10], 'x');
}
END_TEST

START_TEST(the_demo_takes_a_minute_and_ends_where_it_began)
{
    char error[512];
    sim_report_t report;
    int done = sim_write_scenario(SIM_SOURCE_DIR "/maps/demo/scenario", OUT "_demo", 1, &report,
                                  error, sizeof error);
    ck_assert_msg(done == 0, "%s", error);
    ASSERT_NEAR(report.duration_s, 65.0, 8.0, "s");
    ASSERT_NEAR(report.distance_m, 65.0, 5.0, "m");
    char *truth = text_of("demo", "truth.csv");
    double t, first[3], last[3];
    ck_assert_int_eq(sscanf(truth + 8, "%lf,%lf,%lf,%lf", &t, &first[0], &first[1], &first[2]), 4);
    char *line = strrchr(truth, '\n');
    *line = '\0';
    line = strrchr(truth, '\n') + 1;
    ck_assert_int_eq(sscanf(line, "%lf,%lf,%lf,%lf", &t, &last[0], &last[1], &last[2]), 4);
    ASSERT_NEAR(t, report.duration_s, 0.021, "s");
    for (int i = 0; i < 3; i++) {
        ASSERT_NEAR(last[i], first[i], 1e-3, "m");
    }
    free(truth);
}
END_TEST

START_TEST(a_survey_needs_no_sensor_and_tells_where_the_body_is)
{
    char error[512];
    sim_report_t report;
    const char *quiet = WALK "log.imu = none\nlog.truth = body\nradio.height_m = 1.3\n";
    ck_assert_msg(simulate("quiet", quiet, 1, &report, error) == 0, "%s", error);
    char *log = text_of("quiet", "log.csv"), *truth = text_of("quiet", "truth.csv");
    double t, p[3];
    ck_assert_uint_eq(lines_of(log, "imu,"), 0u);
    ck_assert_uint_eq(lines_of(log, "start,"), 1u);
    ck_assert_int_eq(sscanf(truth + 8, "%lf,%lf,%lf,%lf\n", &t, &p[0], &p[1], &p[2]), 4);
    ASSERT_NEAR(p[0], 2.0, 1e-4, "m"); /* between the feet, where the order puts the walker */
    ASSERT_NEAR(p[1], 3.0, 1e-4, "m");
    ASSERT_NEAR(p[2], 1.3, 1e-4, "m");
    ASSERT_NEAR((double)lines_of(truth, "") - 1.0, report.duration_s * 50.0, 1.0, "rows");
    free(log);
    free(truth);
}
END_TEST

#define HANDHELD WALK "log.sensor = phone\nlog.truth = body\n"

START_TEST(a_phone_writes_its_magnetometer_too)
{
    char error[512];
    sim_report_t report;
    ck_assert_msg(simulate("phone", HANDHELD "magnet.rate_hz = 20\n", 1, &report, error) == 0, "%s",
                  error);
    char *log = text_of("phone", "log.csv"), *truth = text_of("phone", "truth.csv");
    double last = 0.0, t, m[3], p[3], x, y, size = 0.0;
    size_t mags = lines_of(log, "mag,");
    ck_assert_int_eq(sscanf(log, "start,0,%lf,%lf,", &x, &y), 2);
    ASSERT_NEAR(hypot(x - 2.0, y - 3.0), 0.0, 1e-4, "m"); /* of the body, like the truth */
    ck_assert_int_eq(sscanf(truth + 8, "%lf,%lf,%lf", &t, &p[0], &p[1]), 3);
    ASSERT_NEAR(hypot(p[0] - 2.0, p[1] - 3.0), 0.0, 1e-4, "m");
    for (const char *at = strchr(log, '\n') + 1; *at != '\0'; at = strchr(at, '\n') + 1) {
        bool is_mag = sscanf(at, "mag,%lf,%lf,%lf,%lf\n", &t, &m[0], &m[1], &m[2]) == 4;
        ck_assert(is_mag || sscanf(at, "imu,%lf", &t) == 1);
        ck_assert(t >= last);
        last = t;
        size += is_mag ? sqrt(m[0] * m[0] + m[1] * m[1] + m[2] * m[2]) / (double)mags : 0.0;
    }
    ASSERT_NEAR(size, 46.0, 12.0, "uT");
    ASSERT_NEAR((double)mags, report.duration_s * 20.0, 1.01, "records");
    ck_assert_uint_eq(lines_of(log, "imu,"), report.samples);
    ASSERT_NEAR((double)report.samples, report.duration_s * 50.0, 1.01, "records");
    free(log);
    free(truth);
}
END_TEST

static const char *const scored[] = {"ear", "swing", "pocket", "hand", "shuffle", "left", "right"};

START_TEST(what_scores_a_phone_is_not_in_its_log)
{
    char error[512];
    ck_assert_int_eq(simulate("scored", HANDHELD "pose,4,ear\n", 1, NULL, error), 0);
    char *log = text_of("scored", "log.csv"), *poses = text_of("scored", "pose.csv");
    char *steps = text_of("scored", "steps.csv");
    ck_assert_str_eq(poses, "t,pose\n0.000,hand\n4.000,change\n5.000,ear\n");
    ck_assert_uint_ge(lines_of(steps, ""), 9u);
    for (size_t i = 0; i < sizeof scored / sizeof scored[0]; i++) {
        ck_assert_ptr_null(strstr(log, scored[i]));
    }
    free(log);
    free(poses);
    free(steps);
}
END_TEST

START_TEST(a_phone_without_magnetometer_writes_the_same_motion)
{
    char error[512];
    ck_assert_int_eq(simulate("mag_on", HANDHELD, 2, NULL, error), 0);
    ck_assert_int_eq(simulate("mag_off", HANDHELD "magnet.model = off\n", 2, NULL, error), 0);
    char *on = text_of("mag_on", "log.csv"), *off = text_of("mag_off", "log.csv");
    ck_assert_uint_eq(lines_of(off, "mag,"), 0u);
    size_t kept = 0;
    for (char *at = on, *next; *at != '\0'; at = next) { /* the log without its mag records */
        next = strchr(at, '\n') + 1;
        if (strncmp(at, "mag", 3) != 0) {
            memmove(on + kept, at, (size_t)(next - at));
            kept += (size_t)(next - at);
        }
    }
    on[kept] = '\0';
    ck_assert_str_eq(on, off);
    free(on);
    free(off);
}
END_TEST

/* What belongs to the phone changes nothing in a shoe's files. */
START_TEST(a_shoe_knows_nothing_of_phones)
{
    char error[512];
    static const char *const files[] = {"log.csv", "truth.csv"};
    ck_assert_int_eq(simulate("shoe_a", WALK, 7, NULL, error), 0);
    ck_assert_int_eq(simulate("shoe_b",
                              WALK "phone.rate_hz = 100\nphone.pose = swing\npose,3,ear\n"
                                   "person.leg_m = 0.7\nmagnet.rate_hz = 10\n",
                              7, NULL, error),
                     0);
    for (int i = 0; i < 2; i++) {
        char *a = text_of("shoe_a", files[i]), *b = text_of("shoe_b", files[i]);
        ck_assert_str_eq(a, b);
        free(a);
        free(b);
    }
}
END_TEST

/* Settings beside a scenario are those that stand in it. */
START_TEST(settings_may_stand_beside_a_scenario)
{
    char error[512];
    ck_assert_int_eq(
        simulate("inside", WALK "imu.rate_hz = 50\nwalk.lead_in_s = 1\n", 3, NULL, error), 0);
    ck_assert_int_eq(simulate("beside", WALK "imu.rate_hz = 100\n", 3, NULL, error), 0);
    ck_assert_int_eq(sim_write_scenario_with(OUT "_beside.scenario", OUT "_beside", 3,
                                             " imu.rate_hz=50  walk.lead_in_s=1", NULL, error,
                                             sizeof error),
                     0);
    char *inside = text_of("inside", "log.csv"), *beside = text_of("beside", "log.csv");
    ck_assert_str_eq(inside, beside);
    free(inside);
    free(beside);
    static const char *const bad[][2] = {
        {"imu.rate_hz", "'imu.rate_hz', expected key=value"},
        {"imu.rate_hz=50 imu.rate_hz=5", "expected a number from 50"},
        {"imu.no_such=1", "no setting is called 'imu.no_such'"},
        {"imu.rate_hz=50000000000000000000000000000000000000000000000000000000000000000000000000000"
         "0000000000000000000000000000",
         "expected at most 99"}};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        ck_assert_int_eq(sim_write_scenario_with(OUT "_beside.scenario", OUT "_beside", 3,
                                                 bad[i][0], NULL, error, sizeof error),
                         -1);
        ck_assert_msg(strstr(error, bad[i][1]) != NULL, "%s", error);
    }
}
END_TEST

#ifndef INSOLE_DOUBLE
/* Squares of all readings of one walk, as the simulator made it before it knew phones; in double
 * the generator draws other numbers. */
START_TEST(shoe_walks_stay_as_they_are)
{
    char error[512];
    ck_assert_int_eq(simulate("kept",
                              "start,2,3,0.5\nwalk,4,3,1.2\nwalk.lead_in_s = 0.5\n"
                              "walk.lead_out_s = 0\nimu.rate_hz = 50\n",
                              11, NULL, error),
                     0);
    char *log = text_of("kept", "log.csv");
    double values[6], squares[6] = {0.0};
    size_t samples = 0;
    for (const char *at = strstr(log, "\nimu"); at != NULL;
         at = strstr(at + 1, "\nimu"), samples++) {
        ck_assert_int_eq(sscanf(at, "\nimu,%*f,%lf,%lf,%lf,%lf,%lf,%lf", &values[0], &values[1],
                                &values[2], &values[3], &values[4], &values[5]),
                         6);
        for (int i = 0; i < 6; i++) {
            squares[i] += values[i] * values[i];
        }
    }
    ck_assert_uint_eq(samples, 251u);
    static const double kept[6] = {9841.77531648, 2253.30695424, 21456.3828226,
                                   282.46609942,  851.094895428, 57.6882707066};
    for (int i = 0; i < 6; i++) {
        ASSERT_NEAR(squares[i] / kept[i], 1.0, 1e-9, "1");
    }
    free(log);
}
END_TEST
#endif

Suite *insole_suite(void)
{
    Suite *suite = suite_create("sim/write");
    suite_add(suite, "form", log_and_truth_have_the_agreed_form);
    suite_add(suite, "scans", scans_are_merged_into_the_log);
    suite_add(suite, "sensor", the_radio_leaves_the_sensor_alone);
    suite_add(suite, "site", plan_and_access_points_are_written_too);
    suite_add_loop(suite, "bad site", bad_plans_and_access_points_are_refused_with_file_and_line,
                   (int)(sizeof bad_sites / sizeof bad_sites[0]));
    suite_add(suite, "report", the_report_tells_what_was_simulated);
    suite_add(suite, "seeds", equal_seeds_write_equal_files);
    suite_add(suite, "truth rate", truth_comes_at_its_own_rate);
    suite_add(suite, "start", the_start_can_be_wrong_or_left_out);
    suite_add_loop(suite, "refusals", bad_scenarios_are_refused_with_file_and_line,
                   (int)(sizeof refusals / sizeof refusals[0]));
    suite_add(suite, "no file", files_that_cannot_be_opened_are_told);
    suite_add(suite, "room", long_errors_fit_the_room);
    suite_add(suite, "demo", the_demo_takes_a_minute_and_ends_where_it_began);
    suite_add(suite, "phone", a_phone_writes_its_magnetometer_too);
    suite_add(suite, "scoring", what_scores_a_phone_is_not_in_its_log);
    suite_add(suite, "no magnetometer", a_phone_without_magnetometer_writes_the_same_motion);
    suite_add(suite, "shoe", a_shoe_knows_nothing_of_phones);
    suite_add(suite, "beside", settings_may_stand_beside_a_scenario);
#ifndef INSOLE_DOUBLE
    suite_add(suite, "kept", shoe_walks_stay_as_they_are);
#endif
    suite_add(suite, "files", a_survey_needs_no_sensor_and_tells_where_the_body_is);
    return suite;
}
