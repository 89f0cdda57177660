/* SPDX-License-Identifier: MIT */
#include "sim/gait.h"

static const double settle_s = 0.3, fade_s = 0.6; /* from walking to standing still */

/* The last stride that has left the ground at t; -1 before the first. */
static long stride_number(const sim_gait_t *gait, double t_s)
{
    size_t low = 0, high = gait->strides.count;
    while (low < high) {
        size_t middle = (low + high) / 2;
        const sim_stride_t *stride = sim_list_at(&gait->strides, middle);
        if (stride->lift_s <= t_s) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return (long)low - 1;
}

static const sim_stride_t *stride_at(const sim_gait_t *gait, long number)
{
    return number < 0 ? NULL : sim_list_at(&gait->strides, (size_t)number);
}

static double pitch_change(const sim_stride_t *stride, double t_s)
{
    double change = 0.0;
    for (int i = 0; i < SIM_TRANSITIONS; i++) {
        const sim_transition_t *part = &stride->pitch[i];
        double u = (t_s - part->begin_s) / part->length_s;
        change += part->change_rad * sim_ease(u, part->rise, part->fall);
    }
    return change;
}

static double pitch_around(const sim_gait_t *gait, long number, double t_s)
{
    const sim_stride_t *stride = stride_at(gait, number), *next = stride_at(gait, number + 1);
    double pitch = stride == NULL ? 0.0 : stride->pitch_before_rad + pitch_change(stride, t_s);
    return next == NULL ? pitch : pitch + pitch_change(next, t_s); /* its push begins in stance */
}

double sim_gait_pitch(const sim_gait_t *gait, double t_s)
{
    return pitch_around(gait, stride_number(gait, t_s), t_s);
}

sim_vec3_t sim_gait_rolled(const sim_gait_t *gait, const sim_place_t *place, double pitch_rad)
{
    double ahead = sim_sole_advance(&gait->sole, pitch_rad);
    return sim_vec3(place->x_m + ahead * cos(place->heading_rad),
                    place->y_m + ahead * sin(place->heading_rad),
                    place->z_m + sim_sole_height(&gait->sole, pitch_rad));
}

/* Origin in the air. */
static sim_vec3_t swung(const sim_gait_t *gait, const sim_stride_t *stride, double since_lift_s,
                        double pitch_rad)
{
    double u = since_lift_s / (stride->strike_s - stride->lift_s);
    double side = stride->side_m * sim_hump(u), heading = stride->from.heading_rad;
    double lifted = sim_ease(u / 0.4, 0.5, 0.5) * (1.0 - sim_ease((u - 0.6) / 0.4, 0.5, 0.5));
    double ball = sim_quintic_at(&stride->ball, since_lift_s) + stride->clearance_m * lifted;
    return sim_vec3(sim_quintic_at(&stride->x, since_lift_s) - side * sin(heading),
                    sim_quintic_at(&stride->y, since_lift_s) + side * cos(heading),
                    ball - gait->ball_m * sin(pitch_rad));
}

static double tremble(const sim_tremble_t *waves, double t_s)
{
    double sum = 0.0;
    for (int i = 0; i < SIM_TREMBLE_WAVES; i++) {
        sum += sin(waves->wave_radps[i] * t_s + waves->phase_rad[i]);
    }
    return sum * sqrt(2.0 / SIM_TREMBLE_WAVES);
}

/* How much the foot trembles: less while it stands for long. */
static double tremble_size(const sim_gait_t *gait, const sim_stride_t *stride,
                           const sim_stride_t *next, double t_s)
{
    double calm = 1.0;
    if (stride != NULL) {
        calm = sim_ease((t_s - stride->strike_s - settle_s) / fade_s, 0.5, 0.5);
    }
    if (next != NULL) {
        calm *= 1.0 - sim_ease((t_s - next->lift_s + settle_s + fade_s) / fade_s, 0.5, 0.5);
    }
    return gait->wobble_rad + calm * (gait->still_rad - gait->wobble_rad);
}

/* Roll, pitch (toe up) and yaw of the foot on top of the course of its pitch. */
typedef struct {
    double roll, pitch, yaw;
} angles_t;

static angles_t trembling(const sim_gait_t *gait, long number, double t_s)
{
    double size = tremble_size(gait, stride_at(gait, number), stride_at(gait, number + 1), t_s);
    angles_t angles = {size * tremble(&gait->roll, t_s), size * tremble(&gait->pitch, t_s),
                       size * tremble(&gait->yaw, t_s)};
    return angles;
}

static void add_swing(angles_t *angles, const sim_stride_t *stride, double t_s)
{
    double u = (t_s - stride->lift_s) / (stride->strike_s - stride->lift_s);
    double hump = sim_hump(u), wave = 2.0 * SIM_PI * u;
    double turn = sim_wrap_pi(stride->to.heading_rad - stride->from.heading_rad);
    angles->roll += stride->roll_rad * hump * cos(wave + stride->roll_phase_rad);
    angles->yaw += stride->yaw_rad * hump * cos(wave + stride->yaw_phase_rad);
    angles->yaw += stride->from.heading_rad + turn * sim_ease(u, 0.5, 0.5);
}

/* The shock of the last strike at t. */
static void add_shock(const sim_gait_t *gait, long number, double t_s, sim_vec3_t *position_m,
                      angles_t *angles)
{
    const sim_stride_t *stride = stride_at(gait, number);
    if (stride != NULL && t_s < stride->strike_s) {
        stride = stride_at(gait, number - 1);
    }
    if (stride != NULL) {
        const sim_shock_t *shock = &stride->shock;
        double since_s = t_s - stride->strike_s,
               size = sim_ringing(shock->wave_radps, shock->decay_s, since_s);
        double missing_s = -shock->settle_s * exp(-since_s / shock->settle_s);
        *position_m = sim_vec3_add_scaled(*position_m, missing_s, shock->settle_mps);
        *position_m = sim_vec3_add_scaled(*position_m, size, shock->shake_m);
        angles->pitch += size * shock->pitch_rad;
    }
}

sim_pose_t sim_gait_pose(const sim_gait_t *gait, double t_s)
{
    long number = stride_number(gait, t_s);
    const sim_stride_t *stride = stride_at(gait, number);
    double pitch = pitch_around(gait, number, t_s);
    angles_t angles = trembling(gait, number, t_s);
    sim_vec3_t position;
    if (stride != NULL && t_s < stride->strike_s) {
        position = swung(gait, stride, t_s - stride->lift_s, pitch);
        add_swing(&angles, stride, t_s);
    } else {
        const sim_place_t *place = stride == NULL ? &gait->home : &stride->to;
        position = sim_gait_rolled(gait, place, pitch);
        angles.yaw += place->heading_rad;
    }
    add_shock(gait, number, t_s, &position, &angles);
    sim_pose_t pose = {position,
                       sim_mat3_from_euler(angles.roll, -(pitch + angles.pitch), angles.yaw)};
    return pose;
}

bool sim_gait_is_flat(const sim_gait_t *gait, double t_s)
{
    long number = stride_number(gait, t_s);
    const sim_stride_t *stride = stride_at(gait, number), *next = stride_at(gait, number + 1);
    if (stride != NULL &&
        t_s < stride->pitch[SIM_LAND].begin_s + stride->pitch[SIM_LAND].length_s) {
        return false;
    }
    return next == NULL || t_s <= next->pitch[SIM_RISE].begin_s;
}
