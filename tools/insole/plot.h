/** @file plot.h  A picture of tracks, and of the truth if there is one, as SVG.
 *
 *  Equal scale on both axes, in metres; x to the right, y up. A single track is coloured by time,
 *  stretches that are not state track by their state; several have a colour each. Ellipses show one
 *  sigma, a circle the start, a square the end. A building lies under the tracks; the particles of
 *  the end are dots.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_PLOT_H
#define INSOLE_HOST_PLOT_H

#include "failure.h"
#include "site.h"
#include "track.h"

/** More tracks than this have colours in common. */
enum { PLOT_COLOURS = 6 };

typedef struct {
    const char *title, *subtitle;
    const track_t *tracks;
    const char *const *names; /**< of the tracks, for the legend */
    size_t track_count;
    const track_t *truth; /**< NULL: none */
    const site_t *site;   /**< NULL: nothing is known of the building, or the track is not on it */
    const track_t *cloud; /**< NULL: none; only places */
} plot_t;

/** Colour of a track among several, by its number. */
const char *plot_colour(size_t number);

/** The picture alone, for a page of its own. */
void plot_draw(FILE *file, const plot_t *plot);

/** @param path a file, or `-` for standard output */
bool plot_write(const plot_t *plot, const char *path, failure_t *failure);

#endif
