/* SPDX-License-Identifier: MIT */
#include "radiomap_make.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "insole/place/kde_fix.h"
#include "memory.h"
#include "number.h"

typedef struct {
    insole_survey_point_t *points;
    insole_survey_record_t *records;
    uint32_t *numbers; /* of the access points in the map, by number in the survey */
    insole_radio_survey_t survey;
} maker_t;

survey_rule_t radiomap_rule(double late_s, double ahead_m)
{
    const survey_rule_t rule = {true, (double)insole_kde_fix_defaults.age_max_s, late_s, ahead_m};
    return rule;
}

static bool check(const survey_t *survey, failure_t *failure)
{
    if (survey->reading_count == 0u) {
        return failure_input(failure,
                             "insole radiomap: none of the %lu readings lies within the times of "
                             "its truth: are log and truth on one clock?",
                             survey->outside + survey->stale);
    }
    if (survey->ids.count > INSOLE_RADIO_APS_MAX) {
        return failure_input(failure, "insole radiomap: %lu access points: expected at most %d",
                             (unsigned long)survey->ids.count, INSOLE_RADIO_APS_MAX);
    }
    return survey->reading_count <= RADIOMAP_FILE_ENTRIES ||
           failure_input(failure, "insole radiomap: %lu readings: expected at most %d",
                         (unsigned long)survey->reading_count, RADIOMAP_FILE_ENTRIES);
}

/* There are no more points than scans, no more records than readings; a hash table wants air. */
static bool begin(maker_t *maker, const survey_t *survey, double spacing_m)
{
    size_t points = survey->scan_count, records = survey->reading_count;
    if (points > RADIOMAP_FILE_POINTS) {
        points = RADIOMAP_FILE_POINTS;
    }
    records += records / 2u;
    memset(maker, 0, sizeof *maker);
    maker->points = memory_new(points, sizeof *maker->points);
    maker->records = memory_new(records, sizeof *maker->records);
    maker->numbers = memory_new(survey->ids.count, sizeof *maker->numbers);
    return insole_radio_survey_init(&maker->survey, (insole_real_t)spacing_m, maker->points,
                                    (uint32_t)points, maker->records,
                                    (uint32_t)records) == INSOLE_OK;
}

static bool add_readings(maker_t *maker, const survey_t *survey, unsigned long *weird,
                         failure_t *failure)
{
    *weird = 0u;
    for (size_t i = 0u; i < survey->reading_count; i++) {
        const survey_reading_t *reading = &survey->readings[i];
        const insole_spot_t spot = {(insole_real_t)reading->x_m, (insole_real_t)reading->y_m};
        if (!(reading->dbm >= -127.0 && reading->dbm <= 0.0)) {
            (*weird)++;
            continue;
        }
        insole_status_t status = insole_radio_survey_add(
            &maker->survey, spot, maker->numbers[reading->id], (insole_real_t)reading->dbm);
        if (status != INSOLE_OK) {
            return failure_input(failure, status == INSOLE_ERR_ROOM
                                              ? "insole radiomap: too many points: expected a "
                                                "larger --spacing"
                                              : "insole radiomap: the truth is farther than "
                                                "100 km from the map's origin");
        }
    }
    return *weird < survey->reading_count ||
           failure_input(failure, "insole radiomap: no signal strength lies in -127 to 0 dBm");
}

static insole_real_t to_mm(insole_real_t m)
{
    return (insole_real_t)(floor(1e3 * (double)m + 0.5) * 1e-3);
}

/* Number of the place at a spot, given to it when it is new. */
static uint32_t place_of(id_table_t *places, insole_spot_t spot)
{
    char place[2 * NUMBER_ROOM], x[NUMBER_ROOM], y[NUMBER_ROOM];
    snprintf(place, sizeof place, "%s,%s", number_fixed(x, (double)spot.x_m, 3),
             number_fixed(y, (double)spot.y_m, 3));
    return id_table_number(places, place);
}

/* Points that the millimetre makes one are set apart: they come back from a file as they are. */
static void round_spots(insole_spot_t *spots, uint32_t count)
{
    id_table_t places;
    id_table_init(&places);
    for (uint32_t i = 0u; i < count; i++) {
        insole_real_t step_m = (insole_real_t)1e-3;
        spots[i].x_m = to_mm(spots[i].x_m);
        spots[i].y_m = to_mm(spots[i].y_m);
        for (; place_of(&places, spots[i]) != i; step_m *= 2) {
            spots[i].x_m = to_mm(spots[i].x_m + step_m);
        }
    }
    id_table_free(&places);
}

/* Access points that no point has kept are forgotten; the others keep their order. */
static void drop_unkept(radiomap_file_t *file)
{
    uint32_t entries = file->map.first[file->map.point_count];
    uint32_t *numbers = memory_new(file->ids.count, sizeof *numbers);
    id_table_t kept;
    id_table_init(&kept);
    for (uint32_t i = 0u; i < entries; i++) {
        numbers[file->map.aps[i]] = 1u;
    }
    for (size_t i = 0u; i < file->ids.count; i++) {
        numbers[i] = numbers[i] > 0u ? id_table_number(&kept, file->ids.names[i]) : 0u;
    }
    for (uint32_t i = 0u; i < entries; i++) {
        file->memory.aps[i] = (uint16_t)numbers[file->memory.aps[i]];
    }
    id_table_free(&file->ids);
    file->ids = kept;
    file->map.ap_count = (uint32_t)kept.count;
    free(numbers);
}

static bool freeze(radiomap_file_t *file, const maker_t *maker, const radiomap_options_t *options)
{
    insole_radio_map_memory_t *memory = &file->memory;
    radiomap_file_make_room(memory, maker->survey.point_count, maker->survey.record_count, true,
                            true);
    memory->bins = options->has_bins
                       ? memory_new((size_t)maker->survey.record_count * INSOLE_RADIO_BINS, 1u)
                       : NULL;
    bool is_good =
        insole_radio_survey_freeze(&maker->survey, options->keep, memory, &file->map) == INSOLE_OK;
    if (is_good) {
        round_spots(memory->spots, maker->survey.point_count);
        drop_unkept(file);
        is_good = insole_radio_map_check(&file->map) == INSOLE_OK;
    }
    return is_good;
}

bool radiomap_make(radiomap_file_t *file, const survey_t *survey, const radiomap_options_t *options,
                   unsigned long *weird, failure_t *failure)
{
    maker_t maker;
    memset(file, 0, sizeof *file);
    if (!check(survey, failure)) {
        return false;
    }
    bool is_good = begin(&maker, survey, options->spacing_m);
    radiomap_file_sort_ids(&survey->ids, &file->ids, maker.numbers);
    is_good = is_good && add_readings(&maker, survey, weird, failure);
    if (is_good && !freeze(file, &maker, options)) {
        is_good = failure_input(failure, "insole radiomap: the readings make no map");
    }
    free(maker.points);
    free(maker.records);
    free(maker.numbers);
    if (!is_good) {
        radiomap_file_free(file);
    }
    return is_good;
}
