/** @file path_readings.h  What lay between the access points and the places of a survey.
 *
 *      path_readings_make(&path, &survey, &request, &failure);
 *      path.readings, path.count: for path_fit
 *      path_readings_free(&path);
 *
 *  An access point that was heard in a session but is missing in one of its scans is a reading as
 *  well: of something weaker than the receiver's floor, the strength that all but few exceed.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_PATH_READINGS_H
#define INSOLE_HOST_PATH_READINGS_H

#include "path_fit.h"
#include "site.h"
#include "survey.h"

/** Readings of one access point in a square of this side share their shadowing [m]. */
#define PATH_SQUARE_M 4.0

/** The building, and where the receiver is held. */
typedef struct {
    const char *plan; /**< NULL: none */
    const char *aps;
    double height_m; /**< of the receiver over the floor */
} path_site_t;

/** A place and what is known of it. */
typedef struct {
    double x_m, y_m;
} path_place_t;

typedef struct {
    site_t site;  /**< walls whose loss the plan does not tell lose nothing */
    site_t other; /**< they lose 1 dB: the difference counts them; without such walls not open */
    insole_propagation_config_t settings, other_settings; /**< of the two */
    path_reading_t *readings;
    path_place_t *places; /**< of the readings */
    size_t count, room, place_room;
    id_table_t squares;         /**< of the readings, by access point */
    size_t ap_count;            /**< in the file */
    unsigned long heard;        /**< readings that are not missing */
    unsigned long unknown;      /**< readings of access points that the file does not have */
    id_table_t unknown_ids;     /**< their names */
    unsigned long outside;      /**< readings made where nobody can be, by the plan */
    unsigned long with_heading; /**< readings whose body share is known */
    unsigned long through;      /**< readings through a wall */
    double told_db, told_walls; /**< sums over the readings heard: walls with told losses */
    double untold_walls;
    double nearest_m, farthest_m; /**< distances heard */
    double floor_dbm;
} path_readings_t;

/** The site stays open until path_readings_free: `path` must not be moved. */
bool path_readings_make(path_readings_t *path, const survey_t *survey, const path_site_t *request,
                        failure_t *failure);

/** A reading of what is `dbm` strong at a place, from an access point that stands at `ap`. */
path_reading_t path_readings_at(const path_readings_t *path, const insole_ap_t *ap,
                                const survey_reading_t *heard);

void path_readings_free(path_readings_t *path);

#endif
