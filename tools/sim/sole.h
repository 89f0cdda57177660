/** @file sole.h  A sole that rolls over the ground from heel to ball without slipping.
 *
 *  The sole is a convex curve in the foot's upright plane: a heel edge `heel_m` behind the foot's
 *  origin, a ball edge `ball_m` ahead of it, and between them a rocker that is rolled over while
 *  the pitch goes through +- soft_rad. Its radius of curvature R/2 (1 + cos(k pitch)), k = pi /
 *  soft_rad, grows from zero and falls back to it, so that the rolling is twice continuously
 *  differentiable. The height h of the origin solves h'' + h = radius; the contact lies -h' ahead
 *  of the origin, and rolling moves the origin forward by minus the integral of h.
 *
 *  Pitch counts toe up, in rad; the origin lies on the sole, at height 0 when flat.
 *
 *      sim_sole_t sole = sim_sole(0.06, 0.15, 0.12);
 *      z = sim_sole_height(&sole, pitch_rad);
 *      x = place + sim_sole_advance(&sole, pitch_rad);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_SIM_SOLE_H
#define INSOLE_SIM_SOLE_H

/** Height, its slope and its integral where the rocker ends and an edge begins. */
typedef struct {
    double pitch_rad, height_m, slope_m, integral_m;
} sim_sole_edge_t;

typedef struct {
    double radius_m; /**< R */
    double wave;     /**< k */
    double stretch;  /**< 1 / (1 - k^2) */
    double offset_m; /**< contact ahead of the origin when flat */
    sim_sole_edge_t heel, ball;
} sim_sole_t;

/** @param soft_rad  half of the pitch range of the rocker, > 0, not pi */
sim_sole_t sim_sole(double heel_m, double ball_m, double soft_rad);

/** Height of the origin over the ground. */
double sim_sole_height(const sim_sole_t *sole, double pitch_rad);

/** How far the origin is ahead of where it is with a flat foot. */
double sim_sole_advance(const sim_sole_t *sole, double pitch_rad);

#endif
