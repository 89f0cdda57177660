/** @file fusion_start.h  Where the shoe's cloud begins when nobody tells: by radio, at its first
 * fix or, through auto_start.h, by several.
 *
 *  Frames  n: level, as the inertial filter left it.  m: map.
 *
 *  The way between two fixes of radio is what the foot has gone. After one fix the direction is not
 *  known, and the particles search for it with all that is heard from then on; after more it is
 *  known the better, and the search begins the later. On real walks in buildings the search at once
 *  is the better one.
 *
 *      insole_fusion_start_init(&start, 5);
 *      insole_fusion_starter_t starter = {insole_fusion_start_hear, &start};
 *      on each sample, until a cloud is drawn:
 *          if (starter.hear(starter.state, &radio, &where))
 *              insole_particle_filter_start(&filter, &cloud, &where);
 *
 *  A fusion that holds no such pair takes the first fix and links nothing of the others.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TRACK_FUSION_START_H
#define INSOLE_TRACK_FUSION_START_H

#include "insole/fuse/auto_start.h"
#include "insole/fuse/particle_start.h"
#include "insole/track/fusion_radio.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { INSOLE_FUSION_START_MOST = INSOLE_CIRCLE_START_MOST };

typedef struct {
    insole_auto_start_t fixes;
    insole_spot_t n_m; /**< where the foot was at the newest */
} insole_fusion_start_t;

/** Looks at the fix of radio. @return whether there is a start, as insole_fusion_start_hear */
typedef bool insole_fusion_start_hear_t(insole_fusion_start_t *start,
                                        const insole_fusion_radio_t *radio,
                                        insole_particle_start_t *where);

typedef struct {
    insole_fusion_start_hear_t *hear; /**< NULL: the first fix is the start */
    insole_fusion_start_t *state;     /**< stays where it is */
} insole_fusion_starter_t;

/** The first fix as a start in any direction, to the bit what insole_fusion_start_hear() makes of
 * it when one is enough.
 *  @param[out] where  untouched unless there is a fix
 *  @return whether there is one */
bool insole_fusion_start_first(const insole_fusion_radio_t *radio, insole_particle_start_t *where);

/** @param fixes  of radio that a start takes, 1 .. INSOLE_FUSION_START_MOST
 *  @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE */
insole_status_t insole_fusion_start_init(insole_fusion_start_t *start, int32_t fixes);

/** Looks at the fix of radio; one that was looked at before is no news.
 *  @param[out] where  untouched unless there is a start: an offset from n to m whose sigma is pi
 *                     where it is not known
 *  @return whether there is one */
bool insole_fusion_start_hear(insole_fusion_start_t *start, const insole_fusion_radio_t *radio,
                              insole_particle_start_t *where);

#ifdef __cplusplus
}
#endif

#endif
