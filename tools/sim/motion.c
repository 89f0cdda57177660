/* SPDX-License-Identifier: MIT */
#include "sim/motion.h"

static const double grid_hz = 2000.0; /* at least */

/* Turn rate in b out of R' dR/dt, the skew matrix of it. */
static sim_vec3_t turn_rate(const sim_pose_t window[5], double step_s)
{
    sim_vec3_t rows[3][5];
    for (int i = 0; i < 5; i++) {
        rows[0][i] = window[i].attitude.r0;
        rows[1][i] = window[i].attitude.r1;
        rows[2][i] = window[i].attitude.r2;
    }
    const sim_mat3_t *R = &window[2].attitude;
    sim_vec3_t d0 = sim_vec3_derivative(rows[0], step_s);
    sim_vec3_t d1 = sim_vec3_derivative(rows[1], step_s);
    sim_vec3_t d2 = sim_vec3_derivative(rows[2], step_s);
    double zy = R->r0.z * d0.y + R->r1.z * d1.y + R->r2.z * d2.y;
    double xz = R->r0.x * d0.z + R->r1.x * d1.z + R->r2.x * d2.z;
    double yx = R->r0.y * d0.x + R->r1.y * d1.x + R->r2.y * d2.x;
    double yz = R->r0.y * d0.z + R->r1.y * d1.z + R->r2.y * d2.z;
    double zx = R->r0.z * d0.x + R->r1.z * d1.x + R->r2.z * d2.x;
    double xy = R->r0.x * d0.y + R->r1.x * d1.y + R->r2.x * d2.y;
    return sim_vec3(0.5 * (zy - yz), 0.5 * (xz - zx), 0.5 * (yx - xy));
}

static sim_vec3_t specific_force(const sim_pose_t window[5], double step_s, double gravity_mps2)
{
    sim_vec3_t p[5];
    for (int i = 0; i < 5; i++) {
        p[i] = window[i].position_m;
    }
    sim_vec3_t f = sim_vec3_second_derivative(p, step_s);
    f.z += gravity_mps2;
    return sim_mat3_mul_vec_t(window[2].attitude, f);
}

static sim_motion_t differentiate(const sim_pose_t window[5], double t_s, double step_s,
                                  double gravity_mps2)
{
    sim_motion_t motion = {t_s, window[2], specific_force(window, step_s, gravity_mps2),
                           turn_rate(window, step_s)};
    return motion;
}

sim_motion_t sim_motion_at(const sim_body_t *body, double t_s, double step_s, double gravity_mps2)
{
    sim_pose_t window[5];
    for (int i = 0; i < 5; i++) {
        window[i] = body->pose(body->state, t_s + (i - 2) * step_s);
    }
    return differentiate(window, t_s, step_s, gravity_mps2);
}

static double grid_time(const sim_motion_stream_t *stream, long number)
{
    return (double)number / (stream->rate_hz * (double)stream->parts);
}

static void advance(sim_motion_stream_t *stream)
{
    for (int i = 0; i < 4; i++) {
        stream->window[i] = stream->window[i + 1];
    }
    double t_s = grid_time(stream, stream->next++);
    stream->window[4] = stream->body.pose(stream->body.state, t_s);
}

/* The grid point in the middle of the window. */
static sim_motion_t middle(const sim_motion_stream_t *stream)
{
    return differentiate(stream->window, grid_time(stream, stream->next - 3), grid_time(stream, 1),
                         stream->gravity_mps2);
}

sim_motion_stream_t sim_motion_stream(sim_body_t body, double rate_hz, double gravity_mps2)
{
    long parts = (long)ceil(grid_hz / rate_hz);
    sim_motion_stream_t stream = {.body = body,
                                  .rate_hz = rate_hz,
                                  .gravity_mps2 = gravity_mps2,
                                  .parts = parts,
                                  .next = -parts - 2};
    for (int i = 0; i < 5; i++) {
        advance(&stream);
    }
    stream.last = middle(&stream); /* one sample before t = 0 */
    return stream;
}

sim_motion_t sim_motion_next_point(sim_motion_stream_t *stream)
{
    for (long i = 0; i < stream->parts; i++) {
        advance(stream);
    }
    stream->last = middle(stream);
    return stream->last;
}

/* By the trapezoid rule over the grid. */
sim_motion_t sim_motion_next_mean(sim_motion_stream_t *stream)
{
    double share = 1.0 / (double)stream->parts;
    sim_vec3_t force = sim_vec3_scale(stream->last.force_mps2, 0.5 * share);
    sim_vec3_t rate = sim_vec3_scale(stream->last.rate_radps, 0.5 * share);
    for (long i = 1; i <= stream->parts; i++) {
        double weight = i < stream->parts ? share : 0.5 * share;
        advance(stream);
        stream->last = middle(stream);
        force = sim_vec3_add_scaled(force, weight, stream->last.force_mps2);
        rate = sim_vec3_add_scaled(rate, weight, stream->last.rate_radps);
    }
    sim_motion_t mean = stream->last;
    mean.force_mps2 = force;
    mean.rate_radps = rate;
    return mean;
}
