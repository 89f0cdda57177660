/** @file compass_legs.h  What a compass told on straight ways: where magnetic north lies on the
 * map.
 *
 *  Who walks straight with the phone pointing ahead goes where the phone's heading points. Heading
 *  and compass are told in one level frame of any yaw, the truth on the map: the direction of the
 *  truth plus compass minus heading is magnetic north on the map. A leg is 5 s of a straight way.
 *
 *      compass_legs_t legs = {0};
 *      for each session: if (!compass_legs_add(&legs, path, accel_unit, gyro_unit, &failure)) ...
 *      compass_legs_mean(&legs, &north);
 *      compass_legs_free(&legs);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_COMPASS_LEGS_H
#define INSOLE_HOST_COMPASS_LEGS_H

#include <stddef.h>

#include "failure.h"

typedef struct {
    size_t session;   /**< counted from 0 */
    double north_rad; /**< counter-clockwise from +x of the map */
} compass_leg_t;

/** Without legs all zeros. */
typedef struct {
    compass_leg_t *legs;
    size_t count, room;
    size_t sessions;
} compass_legs_t;

typedef struct {
    double north_rad;   /**< -pi .. pi */
    double scatter_rad; /**< of single legs, 1-sigma */
    double error_rad;   /**< of north, 1-sigma: of any error that a session's legs share, from five
                             sessions on, below that of legs that err each by itself */
} compass_north_t;

/** @param path  a session: a file, a folder or `-`. @return false without readings, field or truth
 */
bool compass_legs_add(compass_legs_t *legs, const char *path, const char *accel_unit,
                      const char *gyro_unit, failure_t *failure);

/** Mean over all legs; there must be one. */
void compass_legs_mean(const compass_legs_t *legs, compass_north_t *north);

void compass_legs_free(compass_legs_t *legs);

#endif
