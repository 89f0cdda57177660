/** @file replay_options.h  The options that every command which replays has in common.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_REPLAY_OPTIONS_H
#define INSOLE_HOST_REPLAY_OPTIONS_H

#include "options.h"
#include "replay.h"

/* clang-format off */
/** Rows of an option_t list. */
#define REPLAY_OPTIONS                                                                            \
    {"tracker", "foot|phone", "where the sensor is: on the shoe (default), or in a phone the\n"   \
     "walker carries"},                                                                           \
    {"plan", "FILE", "floor plan: its walls hold the track; a folder that is replayed may bring\n"\
     "its own plan.csv, aps.csv and radiomap.csv"},                                               \
    {"aps", "FILE", "access points: radio in the log holds the track"},                           \
    {"radiomap", "FILE", "fingerprints, as `insole radiomap` makes them: radio in the log of a\n" \
     "phone holds its track; the foot tracker leaves them aside"},                                \
    {"use", "rss,range", "which radio counts: rss, range or both (default)"},                     \
    {"seed", "N", "of the particles' random numbers (default 1); equal seeds give equal\n"        \
     "tracks"},                                                                                   \
    {"particles", "N", "how many there are (default 500; pf, pf-kde, wpf 1000, zee 10000)"},      \
    {"lag", "SECONDS", "best, two-order: each position comes so late, smoothed by what came\n"    \
     "after it"},                                                                                 \
    {"config", "FILE", "settings: lines `key = value` (`insole config` prints them all)"},        \
    {"set", "KEY=VALUE", "one setting; may be given often, and counts more than --config"},       \
    {"start", "X,Y[,HEADING]", "where the walk begins [m], and its direction over the first two\n"\
     "strides [rad, counter-clockwise from +x]; start records in the logs do not\n"               \
     "count then"},                                                                               \
    {"no-start", NULL, "start records in the logs do not count"},                                 \
    {"accel-unit", "UNIT", "mps2 (default), g or mg"},                                            \
    {"gyro-unit", "UNIT", "radps (default) or dps"},                                              \
    {"truth", "FILE", "true positions to score against; the tracker never sees them.\n"           \
     "Truth records among the logs serve too"},                                                   \
    {"align", "HOW", "bring the track to the truth before scoring: none, yaw (turned about\n"     \
     "its start) or se2 (turned and shifted); default: what no start tells is\n"                 \
     "free"}
/* clang-format on */

/** Fills a request from the options and operands, which are the logs; reads the building.
 *  @param request  stays where it is until replay_options_free, also after a failure */
bool replay_options_parse(const arguments_t *arguments, replay_request_t *request,
                          failure_t *failure);

/** Can the request's method do with what is given? */
bool replay_options_check(const arguments_t *arguments, const replay_request_t *request,
                          failure_t *failure);

void replay_options_free(replay_request_t *request);

#endif
