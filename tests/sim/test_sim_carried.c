/* SPDX-License-Identifier: MIT */
#include "sim/carried.h"

#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>

#include "near.h"
#include "phones.h"
#include "suite.h"

#define OUT SIM_OUTPUT_DIR "/carried"

static FILE *written(const char *text, uint64_t seed, const char *file, sim_walk_t **walk)
{
    char path[600];
    sim_error_t error;
    *walk = walk_of(text, seed);
    mkdir(OUT, 0777);
    ck_assert(sim_carried_write(*walk, OUT, &error));
    snprintf(path, sizeof path, "%s/%s", OUT, file);
    FILE *stream = fopen(path, "r");
    ck_assert_msg(stream != NULL, "%s", path);
    return stream;
}

START_TEST(poses_are_written_with_their_changes)
{
    sim_walk_t *walk;
    char text[400];
    FILE *stream = written(STRAIGHT "pose,5,ear\npose,9.25,pocket\n"
                                    "pose,15,swing\nphone.change_s = 0.5\n",
                           1, "pose.csv", &walk);
    text[fread(text, 1, sizeof text - 1, stream)] = '\0';
    ck_assert_str_eq(text, "t,pose\n0.000,hand\n5.000,change\n5.500,ear\n9.250,change\n"
                           "9.750,pocket\n15.000,change\n15.500,swing\n");
    fclose(stream);
    sim_walk_close(walk);
}
END_TEST

START_TEST(every_footfall_is_written)
{
    sim_walk_t *walk;
    FILE *stream = written(CORNERS, 3, "steps.csv", &walk);
    char foot[10], kind[10], header[40];
    double t, last = 0.0;
    size_t walks = 0, shuffles = 0;
    ck_assert_ptr_nonnull(fgets(header, sizeof header, stream));
    ck_assert_str_eq(header, "t,foot,kind\n");
    const sim_list_t *steps = &sim_walk_steps(walk)->steps;
    for (size_t i = 2; i < steps->count; i++) {
        const sim_step_t *step = sim_list_at(steps, i);
        ck_assert_int_eq(fscanf(stream, "%lf,%9[^,],%9s\n", &t, foot, kind), 3);
        ASSERT_NEAR(t, step->strike_s, 1e-6, "s");
        ck_assert_str_eq(foot, step->side == SIM_SIDE_LEFT ? "left" : "right");
        walks += strcmp(kind, "walk") == 0 ? 1u : 0u;
        shuffles += strcmp(kind, "shuffle") == 0 ? 1u : 0u;
        ck_assert(t > last);
        last = t;
    }
    ck_assert_int_eq(fgetc(stream), EOF);
    ck_assert_uint_eq(walks + shuffles, steps->count - 2u);
    ck_assert_uint_ge(walks, 30u);
    ck_assert_uint_ge(shuffles, 4u);
    fclose(stream);
    sim_walk_close(walk);
}
END_TEST

START_TEST(a_shoe_gets_neither_file)
{
    sim_error_t error;
    struct stat info;
    const char *folder = OUT "_shoe";
    sim_walk_t *walk = walk_of("start,0,0,0\nwalk,5,0,1\n", 1);
    mkdir(folder, 0777);
    ck_assert(sim_carried_write(walk, folder, &error));
    ck_assert_int_ne(stat(OUT "_shoe/pose.csv", &info), 0);
    ck_assert_int_ne(stat(OUT "_shoe/steps.csv", &info), 0);
    sim_walk_close(walk);
}
END_TEST

START_TEST(a_folder_that_is_not_there_is_refused)
{
    sim_error_t error;
    sim_walk_t *walk = walk_of(STRAIGHT, 1);
    ck_assert(!sim_carried_write(walk, OUT "_none/such", &error));
    ck_assert_ptr_nonnull(strstr(error.text, "pose.csv cannot be written"));
    sim_walk_close(walk);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("sim/carried");
    suite_add(suite, "poses", poses_are_written_with_their_changes);
    suite_add(suite, "steps", every_footfall_is_written);
    suite_add(suite, "shoe", a_shoe_gets_neither_file);
    suite_add(suite, "no folder", a_folder_that_is_not_there_is_refused);
    return suite;
}
