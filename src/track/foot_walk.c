/* SPDX-License-Identifier: MIT */
#include "insole/track/foot_walk.h"

#include <string.h>

#include "insole/base/fastmath.h"

#define ZERO INSOLE_R(0.0)

/* A stride older than this says nothing about the walker's velocity. */
static const uint64_t MEMORY_US = 1500000u;

/* While samples are missing the walk goes on for so long, and so long in a bow. */
static const insole_real_t WALK_ON_S = INSOLE_R(3.0);
static const insole_real_t BOW_S = INSOLE_R(1.0);

/* A gait cycle per time between its stances; none is shorter than the second. */
static const insole_real_t GAIT_PER_SWING = INSOLE_R(1.6);
static const insole_real_t SHORTEST_GAIT_S = INSOLE_R(0.5);

/* Share of its length by which a stride of the model may be wrong. */
static const insole_real_t MODEL_ERROR_SHARE = INSOLE_R(0.1);

INSOLE_COLD insole_status_t insole_foot_walk_init(insole_foot_walk_t *walk)
{
    if (!walk) {
        return INSOLE_ERR_NULL;
    }
    memset(walk, 0, sizeof *walk);
    return INSOLE_OK;
}

static bool is_finite(const insole_stride_t *stride)
{
    return insole_vec3_is_finite(stride->displacement_m) &&
           insole_is_finite(stride->model_length_m) && insole_is_finite(stride->heading_rad) &&
           insole_is_finite(stride->turn_rad);
}

INSOLE_COLD insole_status_t insole_foot_walk_stride(insole_foot_walk_t *walk,
                                                    const insole_stride_t *stride, uint64_t t_us)
{
    if (!walk || !stride) {
        return INSOLE_ERR_NULL;
    }
    if (!is_finite(stride)) {
        return INSOLE_ERR_VALUE;
    }
    if (stride->end_us < stride->begin_us) {
        return INSOLE_ERR_TIME;
    }
    insole_real_t gait_s = GAIT_PER_SWING * insole_seconds(stride->begin_us, stride->end_us);
    insole_real_t per_s = INSOLE_R(1.0) / insole_max(gait_s, SHORTEST_GAIT_S);
    insole_real_t length_m = stride->model_length_m;
    walk->velocity_mps = insole_vec3_scale(stride->displacement_m, per_s);
    walk->velocity_mps.z = ZERO;
    walk->turn_radps = stride->turn_rad * per_s;
    walk->heading_rad = stride->heading_rad;
    walk->stride_us = t_us;
    walk->has_stride = true;
    insole_turn_t ahead = insole_turn(stride->heading_rad);
    walk->place_m.x += length_m * ahead.cos;
    walk->place_m.y += length_m * ahead.sin;
    walk->place_m.z += stride->displacement_m.z;
    walk->place_m2 += insole_square(MODEL_ERROR_SHARE * length_m);
    return INSOLE_OK;
}

INSOLE_COLD insole_status_t insole_foot_walk_cease(insole_foot_walk_t *walk, uint64_t t_us)
{
    if (!walk) {
        return INSOLE_ERR_NULL;
    }
    walk->ceased_us = t_us;
    if (!walk->has_stride || t_us - walk->stride_us > MEMORY_US) {
        walk->velocity_mps = insole_vec3_zero();
        walk->turn_radps = ZERO;
    }
    return INSOLE_OK;
}

INSOLE_COLD insole_real_t insole_foot_walk_bow(const insole_foot_walk_t *walk, insole_real_t time_s)
{
    return walk ? walk->turn_radps * insole_min(time_s, BOW_S) : ZERO;
}

INSOLE_COLD insole_status_t insole_foot_walk_on(insole_foot_walk_t *walk, uint64_t from_us,
                                                uint64_t to_us, insole_vec3_t *way_m)
{
    if (!walk || !way_m) {
        return INSOLE_ERR_NULL;
    }
    if (from_us < walk->ceased_us || to_us <= from_us) {
        return INSOLE_ERR_TIME;
    }
    insole_real_t from_s = insole_seconds(walk->ceased_us, from_us);
    insole_real_t to_s = insole_seconds(walk->ceased_us, to_us);
    insole_real_t walked_s = insole_min(to_s, WALK_ON_S) - insole_min(from_s, WALK_ON_S);
    insole_real_t bow = insole_foot_walk_bow(walk, INSOLE_R(0.5) * (from_s + to_s));
    insole_vec3_t ahead = insole_quat_rotate(insole_quat_from_yaw(bow), walk->velocity_mps);
    *way_m = insole_vec3_scale(ahead, walked_s);
    walk->place_m = insole_vec3_add(walk->place_m, *way_m);
    return INSOLE_OK;
}
