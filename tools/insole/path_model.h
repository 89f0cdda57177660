/** @file path_model.h  What a survey tells about path loss, and what it cannot tell.
 *
 *  A value that would stay too uncertain is not fitted but kept as the settings have it, with the
 *  reason. Then comes the largest loss of all walls together: the likeliest of a list of limits, if
 *  it is clearly likelier than that of the settings.
 *
 *      path_model_t model;
 *      path_model_fit(&model, &path);          path: made by path_readings_make
 *      path_model_free(&model);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_PATH_MODEL_H
#define INSOLE_HOST_PATH_MODEL_H

#include "path_readings.h"

/** Room for a reason. */
enum { PATH_REASON_ROOM = 120 };

typedef struct {
    path_fit_t fit;
    char reason[PATH_UNKNOWNS][PATH_REASON_ROOM]; /**< why it is not observable; empty: it is */
    bool sees_most;                   /**< the largest loss of all walls is observable */
    double most_low_db, most_high_db; /**< limits that are nearly as likely; 1000: none */
    double typical_sigma_db;          /**< median of the access points' residuals */
} path_model_t;

/** Where an access point would fit. */
typedef struct {
    bool is_better; /**< clearly better than where it is told to be */
    double x_m, y_m;
    double error_db,
        told_error_db; /**< mean absolute residuals, there and where it is told to be */
} path_elsewhere_t;

void path_model_fit(path_model_t *model, const path_readings_t *path);

/** Do the readings of an access point scatter far more than those of others, or ask for an exponent
 *  that cannot be? */
bool path_model_is_absurd(const path_model_t *model, size_t ap);

/** Looks for a better place, around where the survey was made. */
path_elsewhere_t path_model_elsewhere(const path_model_t *model, const path_readings_t *path,
                                      size_t ap);

void path_model_free(path_model_t *model);

#endif
