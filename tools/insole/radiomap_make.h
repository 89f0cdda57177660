/** @file radiomap_make.h  A radio map from surveys.
 *
 *      survey.rule = radiomap_rule(1.0, 0.0);
 *      for each session: survey_add(&survey, path, &failure);
 *      radiomap_make(&file, &survey, &options, &left, &failure);
 *      radiomap_file_write(stream, &file);
 *
 *  Places are rounded to the millimetre, as they are written.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_RADIOMAP_MAKE_H
#define INSOLE_HOST_RADIOMAP_MAKE_H

#include "radiomap_file.h"
#include "survey.h"

/** How much later than its age tells a radio has listened [s]. An age counts from the first frame
 * of a scan, or from one that was kept; what is told is heard up to the end of the scan. On
 * recorded surveys fixes lie behind no longer from 0.5 s on, and more changes nothing: a scan is
 * then where it arrives. */
#define RADIOMAP_LATE_S 1.0

/** How far ahead of the walker a scan speaks of a place [m]. */
#define RADIOMAP_AHEAD_M 0.0

#define RADIOMAP_SPACING_M 2.5

typedef struct {
    double spacing_m; /**< 0.05 .. 1000: samples in a square of this side are one point */
    uint32_t keep;    /**< of each point so many access points, the strongest; UINT32_MAX: all */
    bool has_bins;    /**< with histograms, which no file holds */
} radiomap_options_t;

/** Where scans lie in a survey for fingerprints: as wholes, without what fixes would leave out. */
survey_rule_t radiomap_rule(double late_s, double ahead_m);

/** @param[out] weird  readings left out: strengths not in -127 .. 0 dBm
 *  @return false for a survey without readings, or with places, access points or points beyond
 *          what a map can have; nothing is to be freed then */
bool radiomap_make(radiomap_file_t *file, const survey_t *survey, const radiomap_options_t *options,
                   unsigned long *weird, failure_t *failure);

#endif
