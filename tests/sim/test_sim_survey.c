/* SPDX-License-Identifier: MIT */
#include "sim/survey.h"

#include <stdlib.h>
#include <sys/stat.h>

#include "buildings.h"
#include "near.h"
#include "sim/trunk.h"
#include "suite.h"

#define FOLDER      SIM_OUTPUT_DIR "/survey"
#define ROOM        "outline,0,0,12,0,12,9,0,9\n"
#define APS         "id,x,y,z,p0_dbm,exponent\nA,1,1,2.5,-40,2\nB,11,8,2.5,-40,2\nfar,4000,0,2.5,-40,2\n"
#define QUIET_RADIO "radio.building = 3\nradio.place = body\nradio.period_s = 0.5\nlog.imu = none\n"

enum { MOST_ROWS = 100 };

typedef struct {
    double x_m, y_m, mean_dbm, std_db, count;
    char id[32];
} row_t;

typedef struct {
    sim_scenario_t scenario;
    sim_walk_t *walk;
    sim_list_t heard;
    row_t rows[MOST_ROWS];
    size_t count;
} survey_t;

static void read_rows(survey_t *survey)
{
    char line[200];
    FILE *file = fopen(FOLDER "/radiomap.csv", "r");
    ck_assert_ptr_nonnull(file);
    ck_assert_ptr_nonnull(fgets(line, sizeof line, file));
    ck_assert_str_eq(line, "x,y,id,mean_dbm,std_dbm,count\n");
    for (survey->count = 0; fgets(line, sizeof line, file) != NULL; survey->count++) {
        row_t *row = &survey->rows[survey->count];
        ck_assert_int_eq(sscanf(line, "%lf,%lf,%31[^,],%lf,%lf,%lf\n", &row->x_m, &row->y_m,
                                row->id, &row->mean_dbm, &row->std_db, &row->count),
                         6);
    }
    fclose(file);
}

static void make(survey_t *survey, const char *text)
{
    sim_error_t error;
    survey->scenario = scenario_in(text, ROOM, APS);
    survey->walk = sim_walk_open(&survey->scenario, 1, &error);
    ck_assert_msg(survey->walk != NULL, "%s", error.text);
    ck_assert(sim_scans_make(survey->walk, &survey->scenario, 1, &survey->heard, &error));
    mkdir(FOLDER, 0777);
    remove(FOLDER "/radiomap.csv");
    ck_assert_msg(sim_survey_write(survey->walk, &survey->scenario, &survey->heard, FOLDER, &error),
                  "%s", error.text);
}

static void end(survey_t *survey)
{
    sim_list_free(&survey->heard);
    sim_walk_close(survey->walk);
    sim_scenario_free(&survey->scenario);
}

/* Mean, standard deviation and count again, from the readings in two passes. */
static row_t direct(const survey_t *survey, const row_t *row, size_t ap)
{
    row_t again = {0};
    for (int pass = 0; pass < 2; pass++) {
        for (size_t i = 0; i < survey->heard.count; i++) {
            const sim_heard_t *h = sim_list_at(&survey->heard, i);
            sim_place_t at = sim_trunk_at(sim_walk_steps(survey->walk), h->t_s - h->age_s);
            if (h->ap != ap || hypot(at.x_m - row->x_m, at.y_m - row->y_m) > 0.1) {
                continue;
            }
            again.count += pass == 0 ? 1.0 : 0.0;
            again.mean_dbm += pass == 0 ? h->dbm : 0.0;
            again.std_db += pass == 1 ? (h->dbm - again.mean_dbm) * (h->dbm - again.mean_dbm) : 0.0;
        }
        again.mean_dbm /= pass == 0 ? again.count : 1.0;
    }
    again.std_db = sqrt(again.std_db / (again.count - 1.0));
    return again;
}

START_TEST(rows_are_mean_spread_and_count_at_each_point)
{
    static survey_t survey;
    make(&survey, "start,2,2,0\nsurvey,3\nsurvey.pause_s = 10\n" QUIET_RADIO);
    read_rows(&survey);
    ck_assert_uint_eq(survey.count, 24u); /* 12 points; what is too far is in no row */
    for (size_t i = 0; i < survey.count; i++) {
        const row_t *row = &survey.rows[i];
        ck_assert_str_eq(row->id, i % 2 == 0 ? "A" : "B");
        row_t again = direct(&survey, row, i % 2);
        ASSERT_NEAR(row->count, again.count, 0.0, "readings");
        ASSERT_NEAR(row->mean_dbm, again.mean_dbm, 0.0051, "dBm");
        ASSERT_NEAR(row->std_db, again.std_db, 0.0051, "dB");
        /* 10 s at 2 Hz, of which some are lost; the feet close before, and turn after it. */
        ASSERT_AT_LEAST(row->count, 15.0, "readings");
        ASSERT_AT_MOST(row->count, 32.0, "readings");
    }
    end(&survey);
}
END_TEST

START_TEST(means_are_those_of_the_radio)
{
    static survey_t survey;
    sim_error_t error;
    sim_radio_t radio;
    make(&survey, "start,2,2,0\nsurvey,3\nsurvey.pause_s = 60\nradio.rice_db = 40\n"
                  "radio.body_db = 0\n" QUIET_RADIO);
    read_rows(&survey);
    ck_assert(sim_radio_open(&radio, &survey.scenario, 1, &error));
    for (size_t i = 0; i < survey.count; i++) {
        const row_t *row = &survey.rows[i];
        sim_vec3_t at = {row->x_m, row->y_m, 1.1};
        /* Steps of 1 dB remain. */
        ASSERT_NEAR(row->mean_dbm, sim_radio_mean(&radio, i % 2, at, 0.0), 0.6, "dBm");
    }
    sim_radio_close(&radio);
    end(&survey);
}
END_TEST

START_TEST(a_walk_without_survey_has_no_radio_map)
{
    static survey_t survey;
    make(&survey, "start,2,2,0\nwalk,9,2,1.2\n" QUIET_RADIO);
    ck_assert_ptr_null(fopen(FOLDER "/radiomap.csv", "r"));
    end(&survey);
}
END_TEST

START_TEST(a_folder_that_is_not_there_is_told)
{
    sim_error_t error;
    static survey_t survey;
    make(&survey, "start,2,2,0\nsurvey,6\n" QUIET_RADIO);
    ck_assert(!sim_survey_write(survey.walk, &survey.scenario, &survey.heard,
                                SIM_OUTPUT_DIR "/absent/folder", &error));
    ck_assert_ptr_nonnull(strstr(error.text, "absent/folder/radiomap.csv cannot be written"));
    end(&survey);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("sim/survey");
    suite_add(suite, "rows", rows_are_mean_spread_and_count_at_each_point);
    suite_add(suite, "rows", means_are_those_of_the_radio);
    suite_add(suite, "rows", a_walk_without_survey_has_no_radio_map);
    suite_add(suite, "errors", a_folder_that_is_not_there_is_told);
    return suite;
}
