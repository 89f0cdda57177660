/* SPDX-License-Identifier: MIT */
#include "sphere.h"

#include <math.h>
#include <string.h>

enum { UNKNOWNS = 4, FEWEST_POINTS = 6 };

/* A pivot below this share of the radius squared: the points lie on one side of the sphere. */
static const double flat_share = 0.02;

void sphere_add(sphere_t *sphere, const double point[3])
{
    const double u[UNKNOWNS] = {point[0], point[1], point[2], 1.0};
    double square = point[0] * point[0] + point[1] * point[1] + point[2] * point[2];
    for (int i = 0; i < UNKNOWNS; i++) {
        for (int j = 0; j < UNKNOWNS; j++) {
            sphere->outer[i][j] += u[i] * u[j];
        }
        sphere->squared[i] += square * u[i];
    }
    sphere->length += sqrt(square);
    sphere->count++;
}

double sphere_mean_length(const sphere_t *sphere)
{
    return sphere->count > 0u ? sphere->length / (double)sphere->count : 0.0;
}

/* Gaussian elimination from the constant backwards: its pivots are then the scatter of the points
 * along x, y and z, each given those before. */
static bool solve(double A[UNKNOWNS][UNKNOWNS], double b[UNKNOWNS], const double smallest[UNKNOWNS])
{
    for (int k = UNKNOWNS - 1; k >= 0; k--) {
        if (!(A[k][k] > smallest[k])) {
            return false;
        }
        for (int i = 0; i < UNKNOWNS; i++) {
            double factor = i == k ? 0.0 : A[i][k] / A[k][k];
            for (int j = 0; j < UNKNOWNS; j++) {
                A[i][j] -= factor * A[k][j];
            }
            b[i] -= factor * b[k];
        }
    }
    for (int k = 0; k < UNKNOWNS; k++) {
        b[k] /= A[k][k];
    }
    return true;
}

bool sphere_fit(const sphere_t *sphere, double center[3], double *radius)
{
    double A[UNKNOWNS][UNKNOWNS], b[UNKNOWNS];
    double mean = sphere_mean_length(sphere);
    double scatter = flat_share * (double)sphere->count * mean * mean;
    const double smallest[UNKNOWNS] = {scatter, scatter, scatter, 0.0};
    memcpy(A, sphere->outer, sizeof A);
    memcpy(b, sphere->squared, sizeof b);
    if (sphere->count < FEWEST_POINTS || !solve(A, b, smallest)) {
        return false;
    }
    double square = b[3];
    for (int i = 0; i < 3; i++) {
        center[i] = 0.5 * b[i];
        square += center[i] * center[i];
    }
    *radius = sqrt(square);
    return square > 0.0;
}
