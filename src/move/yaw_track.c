/* SPDX-License-Identifier: MIT */
#include "insole/move/yaw_track.h"

#include <string.h>

#define ZERO INSOLE_R(0.0)
#define ONE  INSOLE_R(1.0)

/* Time constant of how a phone lies, over the swing of a leg; a gap counts as no more. */
static const insole_real_t LIE_S = INSOLE_R(1.0);

insole_status_t insole_yaw_track_init(insole_yaw_track_t *yaw, insole_real_t tipped_rad)
{
    if (!yaw) {
        return INSOLE_ERR_NULL;
    }
    if (!(tipped_rad >= INSOLE_R(0.1) && tipped_rad <= INSOLE_R(3.2))) {
        return INSOLE_ERR_VALUE;
    }
    memset(yaw, 0, sizeof *yaw);
    yaw->tipped_cos = insole_cos(insole_min(tipped_rad, INSOLE_PI));
    return INSOLE_OK;
}

static insole_vec3_t unit_or(insole_vec3_t v, insole_vec3_t otherwise)
{
    insole_real_t length = insole_vec3_norm(v);
    return length > INSOLE_R(0.1) ? insole_vec3_scale(v, ONE / length) : otherwise;
}

static void follow_lie(insole_yaw_track_t *yaw, insole_vec3_t up, uint64_t t_us)
{
    insole_real_t dt_s = t_us > yaw->t_us ? insole_seconds(yaw->t_us, t_us) : ZERO;
    dt_s = insole_min(dt_s, LIE_S);
    insole_vec3_t apart = insole_vec3_sub(up, yaw->up);
    yaw->up = unit_or(insole_vec3_add_scaled(yaw->up, dt_s / (LIE_S + dt_s), apart), up);
}

/* The edge of the phone that is most level, made wholly so. */
static insole_vec3_t level_axis(insole_vec3_t up)
{
    insole_real_t x = insole_abs(up.x), y = insole_abs(up.y), z = insole_abs(up.z);
    insole_vec3_t edge = insole_vec3(ZERO, ZERO, ONE);
    if (x <= y && x <= z) {
        edge = insole_vec3(ONE, ZERO, ZERO);
    } else if (y <= z) {
        edge = insole_vec3(ZERO, ONE, ZERO);
    }
    insole_vec3_t level = insole_vec3_add_scaled(edge, -insole_vec3_dot(edge, up), up);
    return insole_vec3_scale(level, ONE / insole_vec3_norm(level));
}

static insole_real_t heading_of(const insole_yaw_track_t *yaw, insole_quat_t q)
{
    insole_vec3_t ahead = insole_quat_rotate(q, yaw->axis);
    return insole_atan2(ahead.y, ahead.x);
}

bool insole_yaw_track_push(insole_yaw_track_t *yaw, insole_quat_t q, uint64_t t_us)
{
    insole_vec3_t up = insole_quat_to_mat3(q).r2; /* what is up in n, seen from b */
    yaw->up = yaw->has_axis ? yaw->up : up;
    follow_lie(yaw, up, t_us);
    yaw->t_us = t_us;
    bool tipped = !yaw->has_axis || insole_vec3_dot(yaw->up, yaw->lay) < yaw->tipped_cos;
    if (tipped) {
        yaw->turned_rad =
            yaw->has_axis ? insole_wrap_pi(yaw->offset_rad + heading_of(yaw, q)) : ZERO;
        yaw->has_axis = true;
        yaw->lay = yaw->up;
        yaw->axis = level_axis(yaw->up);
        yaw->offset_rad = insole_wrap_pi(yaw->turned_rad - heading_of(yaw, q));
        yaw->laid++;
    }
    yaw->turned_rad = insole_wrap_pi(yaw->offset_rad + heading_of(yaw, q));
    return tipped;
}
