/* SPDX-License-Identifier: MIT */
#include "arrow.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "memory.h"

void arrow_begin(arrow_t *arrow, size_t groups)
{
    memset(arrow, 0, sizeof *arrow);
    arrow->groups = memory_new(groups, sizeof *arrow->groups);
    arrow->count = groups;
}

void arrow_prior(arrow_t *arrow, int k, double value, double sigma)
{
    arrow->A[k][k] += 1.0 / (sigma * sigma);
    arrow->pull[k] += value / (sigma * sigma);
}

void arrow_group_prior(arrow_t *arrow, size_t group, int k, double sigma)
{
    arrow->groups[group].B[k][k] += 1.0 / (sigma * sigma);
}

void arrow_add(arrow_t *arrow, size_t group, const double common[ARROW_COMMON],
               const double own[ARROW_OWN], double value, double weight)
{
    arrow_group_t *g = &arrow->groups[group];
    for (int i = 0; i < ARROW_COMMON; i++) {
        for (int j = 0; j < ARROW_COMMON; j++) {
            g->A[i][j] += weight * common[i] * common[j];
        }
        for (int k = 0; k < ARROW_OWN; k++) {
            g->C[i][k] += weight * common[i] * own[k];
        }
        g->common_pull[i] += weight * common[i] * value;
    }
    for (int i = 0; i < ARROW_OWN; i++) {
        for (int j = 0; j < ARROW_OWN; j++) {
            g->B[i][j] += weight * own[i] * own[j];
        }
        g->pull[i] += weight * own[i] * value;
    }
}

/* B becomes its inverse. */
static void invert_group(arrow_group_t *g)
{
    double a = g->B[0][0], b = g->B[0][1], c = g->B[1][1], determinant = a * c - b * b;
    g->B[0][0] = c / determinant;
    g->B[1][1] = a / determinant;
    g->B[0][1] = g->B[1][0] = -b / determinant;
}

/* D = C B^-1 */
static void lever(const arrow_group_t *g, double D[ARROW_COMMON][ARROW_OWN])
{
    for (int i = 0; i < ARROW_COMMON; i++) {
        for (int k = 0; k < ARROW_OWN; k++) {
            D[i][k] = g->C[i][0] * g->B[0][k] + g->C[i][1] * g->B[1][k];
        }
    }
}

/* A - C B^-1 C' and what pulls at it: what the group tells about the common unknowns alone. */
static void eliminate(arrow_t *arrow, arrow_group_t *g)
{
    double D[ARROW_COMMON][ARROW_OWN];
    invert_group(g);
    lever(g, D);
    for (int i = 0; i < ARROW_COMMON; i++) {
        for (int j = 0; j < ARROW_COMMON; j++) {
            g->A[i][j] -= D[i][0] * g->C[j][0] + D[i][1] * g->C[j][1];
            arrow->A[i][j] += g->A[i][j];
        }
        g->common_pull[i] -= D[i][0] * g->pull[0] + D[i][1] * g->pull[1];
        arrow->pull[i] += g->common_pull[i];
    }
}

/* P = A^-1 by Gauss and Jordan; A is positive. */
static bool invert(double A[ARROW_COMMON][ARROW_COMMON], double P[ARROW_COMMON][ARROW_COMMON])
{
    memset(P, 0, ARROW_COMMON * sizeof P[0]);
    for (int i = 0; i < ARROW_COMMON; i++) {
        P[i][i] = 1.0;
    }
    for (int k = 0; k < ARROW_COMMON; k++) {
        double pivot = A[k][k];
        if (!(pivot > 0.0) || !isfinite(pivot)) {
            return false;
        }
        for (int j = 0; j < ARROW_COMMON; j++) {
            A[k][j] /= pivot;
            P[k][j] /= pivot;
        }
        for (int i = 0; i < ARROW_COMMON; i++) {
            double factor = i == k ? 0.0 : A[i][k];
            for (int j = 0; j < ARROW_COMMON; j++) {
                A[i][j] -= factor * A[k][j];
                P[i][j] -= factor * P[k][j];
            }
        }
    }
    return true;
}

static void solve_group(const arrow_t *arrow, arrow_group_t *g)
{
    double D[ARROW_COMMON][ARROW_OWN];
    lever(g, D);
    for (int k = 0; k < ARROW_OWN; k++) {
        double with_common = 0.0;
        g->x[k] = g->B[k][0] * g->pull[0] + g->B[k][1] * g->pull[1];
        g->variance[k] = g->B[k][k];
        for (int i = 0; i < ARROW_COMMON; i++) {
            g->x[k] -= D[i][k] * arrow->x[i];
            with_common -= arrow->P[k][i] * D[i][k];
            for (int j = 0; j < ARROW_COMMON; j++) {
                g->variance[k] += D[i][k] * arrow->P[i][j] * D[j][k];
            }
        }
        g->sum_variance[k] = arrow->P[k][k] + g->variance[k] + 2.0 * with_common;
    }
}

/* Where a group alone would pull the solution. */
static void pull_of_group(const arrow_t *arrow, const arrow_group_t *g, double step[ARROW_COMMON])
{
    double pull[ARROW_COMMON];
    for (int i = 0; i < ARROW_COMMON; i++) {
        pull[i] = g->common_pull[i];
        for (int j = 0; j < ARROW_COMMON; j++) {
            pull[i] -= g->A[i][j] * arrow->x[j];
        }
    }
    for (int i = 0; i < ARROW_COMMON; i++) {
        step[i] = 0.0;
        for (int j = 0; j < ARROW_COMMON; j++) {
            step[i] += arrow->P[i][j] * pull[j];
        }
    }
}

/* The squares of these pulls add up to the variance, for groups that err independently. */
static void find_variance(arrow_t *arrow)
{
    double groups = (double)arrow->count, step[ARROW_COMMON];
    for (size_t g = 0u; g < arrow->count; g++) {
        pull_of_group(arrow, &arrow->groups[g], step);
        for (int k = 0; k < ARROW_COMMON; k++) {
            arrow->variance[k] += step[k] * step[k] * groups / fmax(1.0, groups - 1.0);
        }
    }
}

bool arrow_solve(arrow_t *arrow)
{
    for (size_t g = 0u; g < arrow->count; g++) {
        eliminate(arrow, &arrow->groups[g]);
    }
    if (!invert(arrow->A, arrow->P)) {
        return false;
    }
    for (int i = 0; i < ARROW_COMMON; i++) {
        for (int j = 0; j < ARROW_COMMON; j++) {
            arrow->x[i] += arrow->P[i][j] * arrow->pull[j];
        }
    }
    for (size_t g = 0u; g < arrow->count; g++) {
        solve_group(arrow, &arrow->groups[g]);
    }
    find_variance(arrow);
    return true;
}

void arrow_free(arrow_t *arrow)
{
    free(arrow->groups);
    memset(arrow, 0, sizeof *arrow);
}
