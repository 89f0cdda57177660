/* SPDX-License-Identifier: MIT */
#include "path_readings.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "memory.h"
#include "number.h"
#include "statistics.h"

/* An access point heard less often in a session may be gone for other reasons than distance. */
enum { FEWEST_HEARD = 5, NAME_ROOM = 64 };

/* So many percent of the readings are weaker than what counts as the floor. */
static const double floor_percent = 1.0;

static bool has_untold_walls(const plan_file_t *plan)
{
    for (size_t i = 0u; i < plan->count; i++) {
        if (plan->lines[i].floor == 0u && isnan(plan->lines[i].loss_db)) {
            return true;
        }
    }
    return false;
}

static bool open_sites(path_readings_t *path, const path_site_t *request, failure_t *failure)
{
    path->settings = path->other_settings = insole_propagation_defaults;
    path->settings.height_m = (insole_real_t)request->height_m;
    path->settings.wall_db = (insole_real_t)0.0;
    path->other_settings.wall_db = (insole_real_t)1.0;
    if (!site_open_sketch(&path->site, request->plan, request->aps, &path->settings, failure)) {
        return false;
    }
    path->ap_count = path->site.ap_file.count;
    return !has_untold_walls(&path->site.plan_file) ||
           site_open_sketch(&path->other, request->plan, NULL, &path->other_settings, failure);
}

/* ---- one reading ------------------------------------------------------------------------ */

static insole_walls_between_t walls_between(const site_t *site, const insole_ap_t *ap,
                                            const survey_reading_t *heard)
{
    insole_walls_between_t walls = {0u, 0};
    if (site->building.plan != NULL) {
        insole_floor_plan_walls_between(site->building.plan, (insole_real_t)heard->x_m,
                                        (insole_real_t)heard->y_m, ap->x_m, ap->y_m, &walls);
    }
    return walls;
}

static double body_share(const insole_ap_t *ap, const survey_reading_t *heard)
{
    double dx = (double)ap->x_m - heard->x_m, dy = (double)ap->y_m - heard->y_m;
    double away_m = fmax(hypot(dx, dy), 1e-3);
    double cos_bearing = (dx * heard->cos_heading + dy * heard->sin_heading) / away_m;
    return (double)insole_body_share((insole_real_t)cos_bearing);
}

path_reading_t path_readings_at(const path_readings_t *path, const insole_ap_t *ap,
                                const survey_reading_t *heard)
{
    path_reading_t reading;
    memset(&reading, 0, sizeof reading);
    double away_m = hypot(hypot((double)ap->x_m - heard->x_m, (double)ap->y_m - heard->y_m),
                          (double)ap->z_m - (double)path->settings.height_m);
    reading.log_m = 10.0 * log10(fmax(away_m, (double)path->settings.distance_min_m));
    reading.told_db = (double)walls_between(&path->site, ap, heard).loss_db;
    if (path->other.building.plan != NULL) {
        reading.walls = (double)walls_between(&path->other, ap, heard).loss_db - reading.told_db;
    }
    reading.body_share = body_share(ap, heard);
    reading.dbm = heard->dbm;
    return reading;
}

/* Number of the square, of those of the access point. */
static uint32_t square_of(path_readings_t *path, uint32_t ap, const survey_reading_t *heard)
{
    char name[NAME_ROOM];
    snprintf(name, sizeof name, "%u,%.0f,%.0f", (unsigned)ap, floor(heard->x_m / PATH_SQUARE_M),
             floor(heard->y_m / PATH_SQUARE_M));
    return id_table_number(&path->squares, name);
}

static void count_reading(path_readings_t *path, const insole_ap_t *ap,
                          const path_reading_t *reading, const survey_reading_t *heard)
{
    const insole_floor_plan_t *plan = path->site.building.plan;
    double away_m = pow(10.0, 0.1 * reading->log_m);
    path->nearest_m = path->heard == 0u ? away_m : fmin(path->nearest_m, away_m);
    path->farthest_m = fmax(path->farthest_m, away_m);
    path->heard++;
    path->told_db += reading->told_db;
    path->untold_walls += reading->walls;
    path->told_walls += (double)walls_between(&path->site, ap, heard).count - reading->walls;
    path->through += reading->told_db > 0.0 || reading->walls > 0.5 ? 1u : 0u;
    path->with_heading += heard->cos_heading != 0.0 || heard->sin_heading != 0.0 ? 1u : 0u;
    if (plan != NULL && plan->outline_walls > 0u &&
        !insole_floor_plan_inside(plan, (insole_real_t)heard->x_m, (insole_real_t)heard->y_m)) {
        path->outside++;
    }
}

static void add_reading(path_readings_t *path, uint32_t ap, const survey_reading_t *heard)
{
    const insole_ap_t *place = &path->site.ap_file.aps[ap];
    const path_place_t at = {heard->x_m, heard->y_m};
    path_reading_t reading = path_readings_at(path, place, heard);
    reading.ap = ap;
    reading.square = square_of(path, ap, heard);
    if (!isnan(reading.dbm)) {
        count_reading(path, place, &reading, heard);
    }
    path->readings =
        memory_room(path->readings, &path->room, path->count + 1u, sizeof *path->readings);
    path->places =
        memory_room(path->places, &path->place_room, path->count + 1u, sizeof *path->places);
    path->readings[path->count] = reading;
    path->places[path->count++] = at;
}

/* ---- all readings ----------------------------------------------------------------------- */

static uint32_t ap_of(const path_readings_t *path, const survey_t *survey, size_t reading)
{
    return ap_file_number(&path->site.ap_file, &survey->ids, survey->readings[reading].id);
}

/* How often each access point is heard in each session. */
static size_t *count_heard(const path_readings_t *path, const survey_t *survey)
{
    size_t *heard = memory_new(survey->sessions * path->ap_count, sizeof *heard);
    for (size_t s = 0u; s < survey->scan_count; s++) {
        const survey_scan_t *scan = &survey->scans[s];
        for (size_t i = scan->first; i < scan->first + scan->count; i++) {
            uint32_t ap = ap_of(path, survey, i);
            if (ap != AP_FILE_UNKNOWN) {
                heard[scan->session * path->ap_count + ap]++;
            }
        }
    }
    return heard;
}

static void add_heard(path_readings_t *path, const survey_t *survey, const survey_scan_t *scan,
                      bool *is_heard)
{
    for (size_t i = scan->first; i < scan->first + scan->count; i++) {
        const survey_reading_t *reading = &survey->readings[i];
        uint32_t ap = ap_of(path, survey, i);
        if (ap == AP_FILE_UNKNOWN) {
            id_table_number(&path->unknown_ids, survey->ids.names[reading->id]);
            path->unknown++;
        } else {
            is_heard[ap] = true;
            add_reading(path, ap, reading);
        }
    }
}

static void add_scans(path_readings_t *path, const survey_t *survey)
{
    size_t *heard = count_heard(path, survey);
    bool *is_heard = memory_new(path->ap_count, sizeof *is_heard);
    for (size_t s = 0u; s < survey->scan_count; s++) {
        const survey_scan_t *scan = &survey->scans[s];
        survey_reading_t missing = survey->readings[scan->first];
        missing.dbm = NUMBER_UNKNOWN;
        memset(is_heard, 0, path->ap_count * sizeof *is_heard);
        add_heard(path, survey, scan, is_heard);
        for (uint32_t a = 0u; a < path->ap_count; a++) {
            if (!is_heard[a] && heard[scan->session * path->ap_count + a] >= FEWEST_HEARD) {
                add_reading(path, a, &missing);
            }
        }
    }
    free(is_heard);
    free(heard);
}

static void find_floor(path_readings_t *path)
{
    double *heard = memory_new(path->heard, sizeof *heard);
    size_t count = 0u;
    for (size_t i = 0u; i < path->count; i++) {
        if (!isnan(path->readings[i].dbm)) {
            heard[count++] = path->readings[i].dbm;
        }
    }
    path->floor_dbm = statistics_percentile(heard, count, floor_percent);
    free(heard);
}

static bool check(const path_readings_t *path, const survey_t *survey, failure_t *failure)
{
    const char *aps = path->site.ap_file.name;
    if (path->heard > 0u) {
        return true;
    }
    if (path->unknown == 0u) {
        return failure_input(failure,
                             "insole calibrate pathloss: none of the %lu readings lies within the "
                             "times of its truth: are log and truth on one clock?",
                             survey->outside);
    }
    return failure_input(failure,
                         "%s: none of the %lu access points heard is in it: heard are %.63s, ...; "
                         "the file has %.63s, ...",
                         aps, (unsigned long)path->unknown_ids.count, path->unknown_ids.names[0],
                         path->site.ap_file.ids.names[0]);
}

bool path_readings_make(path_readings_t *path, const survey_t *survey, const path_site_t *request,
                        failure_t *failure)
{
    memset(path, 0, sizeof *path);
    bool is_good = open_sites(path, request, failure);
    if (is_good) {
        add_scans(path, survey);
        is_good = check(path, survey, failure);
    }
    if (is_good) {
        find_floor(path);
    } else {
        path_readings_free(path);
    }
    return is_good;
}

void path_readings_free(path_readings_t *path)
{
    site_free(&path->site);
    site_free(&path->other);
    id_table_free(&path->squares);
    id_table_free(&path->unknown_ids);
    free(path->readings);
    free(path->places);
    memset(path, 0, sizeof *path);
}
