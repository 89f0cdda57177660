/** @file sphere.h  The sphere on which the readings of a resting accelerometer lie, whichever side
 *         is up: its center is the bias, its radius gravity.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_SPHERE_H
#define INSOLE_HOST_SPHERE_H

#include <stdbool.h>
#include <stddef.h>

/** Sums over the points: of u u' with u = (x, y, z, 1), of |p|^2 u, and of |p|. */
typedef struct {
    double outer[4][4];
    double squared[4];
    double length;
    size_t count;
} sphere_t;

/** An empty one is all zeros. */
void sphere_add(sphere_t *sphere, const double point[3]);

/** Center and radius by linear least squares: |p|^2 = 2 c p + r^2 - |c|^2.
 *  @return false for fewer than six points, or when they leave a direction open */
bool sphere_fit(const sphere_t *sphere, double center[3], double *radius);

double sphere_mean_length(const sphere_t *sphere);

#endif
