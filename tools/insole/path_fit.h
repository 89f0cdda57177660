/** @file path_fit.h  Fits a model of path loss to what was heard at known places.
 *
 *  Source  [TwoOrder] 2.4 (10): what is expected of access point a is
 *
 *              p0 + dp0_a - (n + dn_a) 10 lg d - min(s told + w walls, most) - share body - L_p
 *
 *  with p0, n, s, w, body common to all, and deviations dp0, dn of each access point that stay the
 *  nearer to zero the less is heard of it (their spread is estimated as well).
 *
 *      path_fit_t fit;
 *      path_fit_begin(&fit, &survey);      the settings, nothing known
 *      path_fit_run(&fit);                 again after is_fixed or most_db were changed
 *      path_fit_free(&fit);
 *
 *  Robust: readings deviate by Student's distribution. Readings of one access point within one
 *  square of the floor share their shadowing, so a square's weight stops growing with its readings;
 *  standard errors are those of the squares. An access point that is missing in a scan was weaker
 *  than the receiver's floor, or was lost by chance; how often by chance is estimated.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_PATH_FIT_H
#define INSOLE_HOST_PATH_FIT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef enum {
    PATH_P0,       /**< dBm at 1 m */
    PATH_EXPONENT, /**< n0 */
    PATH_TOLD,     /**< the walls' told losses count so many times */
    PATH_WALL,     /**< dB of a wall whose loss is not told */
    PATH_BODY,     /**< dB of a body in the way */
    PATH_UNKNOWNS
} path_unknown_t;

enum { PATH_OWN = 2 /**< p0 and exponent */ };

typedef struct {
    uint32_t ap;
    uint32_t square;   /**< equal for readings of one access point that err alike */
    double log_m;      /**< 10 lg of the distance in m */
    double told_db;    /**< walls on the way that the plan tells the loss of */
    double walls;      /**< number of the others */
    double body_share; /**< 0 .. 1 */
    double dbm;        /**< not-a-number: it was missing in a scan */
} path_reading_t;

/** What is fitted. */
typedef struct {
    const path_reading_t *readings;
    size_t count, ap_count, square_count;
    double floor_dbm;    /**< of the receiver */
    double multipath_db; /**< L_p: taken as it is */
    double tail_dof;     /**< of Student's distribution; large: Gauss */
    double start[PATH_UNKNOWNS];
} path_survey_t;

/** What an access point has of its own. */
typedef struct {
    double own[PATH_OWN];     /**< p0 and exponent, common value and deviation */
    double error[PATH_OWN];   /**< their standard errors */
    double mean_db, sigma_db; /**< of the residuals: their mean, root mean square about it */
    size_t heard;
} path_ap_t;

typedef struct {
    path_survey_t survey;
    bool is_fixed[PATH_UNKNOWNS]; /**< to stay at `value` */
    double most_db;               /**< all walls together lose no more */
    bool keeps_weights; /**< alike and lost_share stay: likelihoods can then be compared */

    double value[PATH_UNKNOWNS], error[PATH_UNKNOWNS]; /**< and standard errors */
    path_ap_t *aps;
    double spread[PATH_OWN]; /**< 1-sigma of the deviations */
    double sigma_db;         /**< scale of Student's distribution, of the deviations of readings */
    double common_sigma_db;  /**< the same about what is expected with the common values alone */
    double rms_db;           /**< of the readings' deviations */
    double alike;            /**< share of their variance that a square has in common */
    double lost_share;       /**< of the readings that should have been heard */
    double log_likelihood;   /**< counted by squares */
    double *weight;          /**< work space: of each reading by its square */
    double *expected_dbm;    /**< work space: of each reading, of its own access point */
} path_fit_t;

/** Nothing is fixed; values are those of `survey->start`. The survey's readings must last. */
void path_fit_begin(path_fit_t *fit, const path_survey_t *survey);

/** Iterates from what there is. */
void path_fit_run(path_fit_t *fit);

/** What is expected of a reading; with the common values alone, or the access point's own. */
double path_fit_expect(const path_fit_t *fit, const path_reading_t *reading, bool is_own);

void path_fit_free(path_fit_t *fit);

#endif
