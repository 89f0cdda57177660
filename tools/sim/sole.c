/* SPDX-License-Identifier: MIT */
#include "sim/sole.h"

#include <math.h>

#include "sim/algebra.h"

/* h, h' and the integral of h on the rocker, where |pitch| <= soft_rad. */
static sim_sole_edge_t on_rocker(const sim_sole_t *sole, double pitch_rad)
{
    double half = 0.5 * sole->radius_m, k = sole->wave, s = sole->stretch;
    double level = half * (1.0 + s); /* minus the factor of cos(pitch): h(0) = 0 */
    double sine = sin(pitch_rad), cosine = cos(pitch_rad);
    sim_sole_edge_t at = {
        pitch_rad, half * (1.0 + s * cos(k * pitch_rad)) - level * cosine - sole->offset_m * sine,
        -half * s * k * sin(k * pitch_rad) + level * sine - sole->offset_m * cosine,
        half * (pitch_rad + s * sin(k * pitch_rad) / k) - level * sine -
            sole->offset_m * (1.0 - cosine)};
    return at;
}

sim_sole_t sim_sole(double heel_m, double ball_m, double soft_rad)
{
    double k = SIM_PI / soft_rad;
    sim_sole_t sole = {.radius_m = (heel_m + ball_m) / soft_rad,
                       .wave = k,
                       .stretch = 1.0 / (1.0 - k * k),
                       .offset_m = 0.5 * (ball_m - heel_m)};
    sole.heel = on_rocker(&sole, soft_rad);
    sole.ball = on_rocker(&sole, -soft_rad);
    return sole;
}

/* On an edge the radius is zero: h'' + h = 0. */
static double edge_height(const sim_sole_edge_t *edge, double pitch_rad)
{
    double turn = pitch_rad - edge->pitch_rad;
    return edge->height_m * cos(turn) + edge->slope_m * sin(turn);
}

static double edge_integral(const sim_sole_edge_t *edge, double pitch_rad)
{
    double turn = pitch_rad - edge->pitch_rad;
    return edge->integral_m + edge->height_m * sin(turn) + edge->slope_m * (1.0 - cos(turn));
}

double sim_sole_height(const sim_sole_t *sole, double pitch_rad)
{
    if (pitch_rad > sole->heel.pitch_rad) {
        return edge_height(&sole->heel, pitch_rad);
    }
    if (pitch_rad < sole->ball.pitch_rad) {
        return edge_height(&sole->ball, pitch_rad);
    }
    return on_rocker(sole, pitch_rad).height_m;
}

double sim_sole_advance(const sim_sole_t *sole, double pitch_rad)
{
    if (pitch_rad > sole->heel.pitch_rad) {
        return -edge_integral(&sole->heel, pitch_rad);
    }
    if (pitch_rad < sole->ball.pitch_rad) {
        return -edge_integral(&sole->ball, pitch_rad);
    }
    return -on_rocker(sole, pitch_rad).integral_m;
}
