/* SPDX-License-Identifier: MIT */
#include "session.h"

#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include "files.h"
#include "near.h"
#include "suite.h"

enum { PATHS = 8 };

static session_t session;
static failure_t failure;

static void open_paths(const char *const *paths, size_t count)
{
    memset(&failure, 0, sizeof failure);
    ck_assert_msg(session_open(&session, paths, count, &failure), "%s", failure.text);
}

/* Times of all records, in milliseconds, and their kinds by first letter: "0i 5t ...". */
static const char *order(void)
{
    static char text[TEXT_ROOM];
    static const char letters[] = "siagmrRtT";
    record_t record;
    read_t answer;
    size_t length = 0u;
    text[0] = '\0';
    while ((answer = session_next(&session, &record, &failure)) == READ_ONE) {
        length += (size_t)snprintf(text + length, sizeof text - length, "%s%ld%c",
                                   length > 0u ? " " : "", (long)(record.t_us / 1000),
                                   letters[record.kind]);
    }
    ck_assert_msg(answer == READ_END, "%s", failure.text);
    session_close(&session);
    return text;
}

static const char *order_of(const char *const *texts, size_t count)
{
    static char names[PATHS][32];
    const char *paths[PATHS];
    static char held[PATHS][512];
    for (size_t i = 0u; i < count; i++) {
        snprintf(names[i], sizeof names[i], "log%lu.csv", (unsigned long)i);
        snprintf(held[i], sizeof held[i], "%s", scratch_file(names[i], texts[i]));
        paths[i] = held[i];
    }
    open_paths(paths, count);
    return order();
}

START_TEST(logs_are_merged_by_time)
{
    const char *const texts[] = {"t,ax,ay,az,gx,gy,gz\n0,0,0,9,0,0,0\n0.02,0,0,9,0,0,0\n0.04,0,0,9,0,0,0\n",
                                 "rss,0.01,a,-70\nrss,0.03,a,-70\n",
                                 "t,x,y\n-0.5,1,2\n0.05,1,2\n"};
    ck_assert_str_eq(order_of(texts, 3u), "-500t 0i 10r 20i 30r 40i 50t");
}
END_TEST

START_TEST(equal_times_come_by_kind_whatever_the_order_of_the_logs)
{
    const char *const texts[] = {"truth,1,0,0\n", "imu,1,0,0,9,0,0,0\n", "rss,1,a,-70\n",
                                 "start,1,0,0\n"};
    const char *const turned[] = {texts[3], texts[2], texts[1], texts[0]};
    ck_assert_str_eq(order_of(texts, 4u), "1000s 1000i 1000r 1000t");
    ck_assert_str_eq(order_of(turned, 4u), "1000s 1000i 1000r 1000t");
}
END_TEST

START_TEST(one_log_keeps_its_order)
{
    const char *const text = "imu,1,0,0,9,0,0,0\nimu,0.5,0,0,9,0,0,0\nstart,0.5,0,0\n"
                             "imu,99,0,0,9,0,0,0\nimu,0.6,0,0,9,0,0,0\n";
    ck_assert_str_eq(order_of(&text, 1u), "1000i 500i 500s 99000i 600i");
}
END_TEST

START_TEST(a_wild_stamp_does_not_hold_back_a_log)
{
    const char *const texts[] = {"imu,1,0,0,9,0,0,0\nimu,99999,0,0,9,0,0,0\nimu,3,0,0,9,0,0,0\nimu,4,0,0,9,0,0,0\n",
                                 "rss,2,a,-70\nrss,3.5,a,-70\nrss,5,a,-70\n"};
    ck_assert_str_eq(order_of(texts, 2u), "1000i 2000r 99999000i 3000i 3500r 4000i 5000r");
}
END_TEST

START_TEST(a_stamp_that_goes_back_comes_at_once)
{
    const char *const texts[] = {"imu,1,0,0,9,0,0,0\nimu,0.2,0,0,9,0,0,0\nimu,3,0,0,9,0,0,0\n",
                                 "rss,2,a,-70\n"};
    ck_assert_str_eq(order_of(texts, 2u), "1000i 200i 2000r 3000i");
}
END_TEST

START_TEST(ids_are_shared_between_logs)
{
    record_t record;
    char a[512], b[512];
    snprintf(a, sizeof a, "%s", scratch_file("a.csv", "rss,0,x,-70\nrss,2,y,-70\n"));
    snprintf(b, sizeof b, "%s", scratch_file("b.csv", "range,1,y,5\nrange,3,x,5\n"));
    const char *const paths[] = {a, b};
    const uint32_t expected[] = {0u, 1u, 1u, 0u};
    open_paths(paths, 2u);
    for (int i = 0; i < 4; i++) {
        ck_assert_int_eq(session_next(&session, &record, &failure), READ_ONE);
        ck_assert_str_eq(session.ids.names[record.id], expected[i] == 0u ? "x" : "y");
    }
    session_close(&session);
}
END_TEST

/* Against sorting: many logs with random times that never go back within a log. */
START_TEST(a_random_merge_is_in_order_of_time)
{
    static char texts[PATHS][8192];
    const char *logs[PATHS];
    srand(3);
    for (int i = 0; i < PATHS; i++) {
        size_t length = 0u;
        int t_ms = rand() % 50;
        for (int k = 0; k < 100; k++) {
            length += (size_t)snprintf(texts[i] + length, sizeof texts[i] - length,
                                       "imu,%d.%03d,0,0,9,0,0,0\n", t_ms / 1000, t_ms % 1000);
            t_ms += rand() % 40;
        }
        logs[i] = texts[i];
    }
    const char *merged = order_of(logs, PATHS);
    long last = -1, count = 0;
    for (const char *at = merged; at != NULL; at = strchr(at, ' ')) {
        at += *at == ' ' ? 1 : 0;
        long t_ms = strtol(at, NULL, 10);
        ck_assert_int_ge(t_ms, last);
        last = t_ms;
        count++;
    }
    ck_assert_int_eq(count, 100 * PATHS);
}
END_TEST

/* ---- folders ---------------------------------------------------------------------------- */

START_TEST(a_folder_stands_for_its_logs)
{
    mkdir(scratch("walk"), 0777);
    scratch_file("walk/imu.csv", "imu,1,0,0,9,0,0,0\n");
    scratch_file("walk/radio.csv", "rss,2,a,-70\n");
    scratch_file("walk/truth.csv", "t,x,y\n3,1,2\n");
    scratch_file("walk/plan.csv", "outline,0,0,1,0,1,1\n");
    scratch_file("walk/aps.csv", "id,x,y\na,1,2\n");
    scratch_file("walk/radiomap.csv", "x,y,id,mean_dbm,std_dbm,count\n");
    scratch_file("walk/pose.csv", "t,pose\n0,hand\n");
    scratch_file("walk/steps.csv", "t,foot,kind\n3.5,left,walk\n");
    scratch_file("walk/track.csv", "t,x,y,z,heading,state\n4,1,2,0,0,track\n");
    scratch_file("walk/notes.txt", "nothing\n");
    scratch_file("walk/.hidden.csv", "nothing\n");
    const char *const path = scratch("walk");
    open_paths(&path, 1u);
    ck_assert_str_eq(order(), "1000i 2000r 3000t");
}
END_TEST

START_TEST(a_folder_without_logs_is_refused)
{
    mkdir(scratch("empty"), 0777);
    scratch_file("empty/plan.csv", "outline,0,0,1,0,1,1\n");
    const char *const path = scratch("empty");
    ck_assert(!session_open(&session, &path, 1u, &failure));
    ck_assert_str_eq(failure.text,
                     SCRATCH "/empty: folder has no log: expected .csv files");
    session_close(&session);
}
END_TEST

START_TEST(a_track_named_as_a_log_is_refused)
{
    record_t record;
    const char *const path = scratch_file("track.csv", "t,x,y,state\n4,1,2,track\n");
    open_paths(&path, 1u);
    ck_assert_int_eq(session_next(&session, &record, &failure), READ_FAILED);
    ck_assert_str_eq(failure.text,
                     SCRATCH "/track.csv:2: this is a track (it has a column state): expected a log");
    session_close(&session);
}
END_TEST

START_TEST(a_malformed_line_in_any_log_stops_the_session)
{
    record_t record;
    char a[512], b[512];
    read_t answer;
    snprintf(a, sizeof a, "%s", scratch_file("fine.csv", "imu,0,0,0,9,0,0,0\n"));
    snprintf(b, sizeof b, "%s", scratch_file("bad.csv", "rss,0,a,-70\nrss,1,a\n"));
    const char *const paths[] = {a, b};
    open_paths(paths, 2u);
    while ((answer = session_next(&session, &record, &failure)) == READ_ONE) {
    }
    ck_assert_int_eq(answer, READ_FAILED);
    ck_assert_str_eq(failure.text,
                     SCRATCH "/bad.csv:2: too few fields: expected rss,t,id,dbm[,age]");
    session_close(&session);
}
END_TEST

START_TEST(a_missing_log_is_told)
{
    const char *const path = scratch("absent.csv");
    ck_assert(!session_open(&session, &path, 1u, &failure));
    ck_assert_int_eq(failure.exit_code, EXIT_BAD_INPUT);
    ck_assert_ptr_nonnull(strstr(failure.text, "/absent.csv: cannot open: "));
    session_close(&session);
}
END_TEST

START_TEST(the_session_knows_its_files)
{
    const char *const path = scratch_file("known.csv", "imu,0,0,0,9,0,0,0\n");
    open_paths(&path, 1u);
    ck_assert_uint_eq(session.bytes, 18u);
    ck_assert(session_reads(&session, SCRATCH "/../session/known.csv"));
    ck_assert(!session_reads(&session, scratch_file("other.csv", "")));
    ck_assert(!session_reads(&session, scratch("absent.csv")));
    ck_assert_str_eq(order(), "0i");
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("session");
    suite_add(suite, "merge", logs_are_merged_by_time);
    suite_add(suite, "equal times", equal_times_come_by_kind_whatever_the_order_of_the_logs);
    suite_add(suite, "one log", one_log_keeps_its_order);
    suite_add(suite, "wild stamp", a_wild_stamp_does_not_hold_back_a_log);
    suite_add(suite, "back", a_stamp_that_goes_back_comes_at_once);
    suite_add(suite, "ids", ids_are_shared_between_logs);
    suite_add(suite, "random", a_random_merge_is_in_order_of_time);
    suite_add(suite, "folder", a_folder_stands_for_its_logs);
    suite_add(suite, "empty folder", a_folder_without_logs_is_refused);
    suite_add(suite, "track", a_track_named_as_a_log_is_refused);
    suite_add(suite, "malformed", a_malformed_line_in_any_log_stops_the_session);
    suite_add(suite, "missing", a_missing_log_is_told);
    suite_add(suite, "files", the_session_knows_its_files);
    return suite;
}
