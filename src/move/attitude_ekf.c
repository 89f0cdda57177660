/* SPDX-License-Identifier: MIT */
#include "insole/move/attitude_ekf.h"

#define ZERO INSOLE_R(0.0)

typedef struct {
    insole_sym3_t P;
    insole_vec3_t turn_rad; /* of the components so far */
    insole_real_t nis;      /* of these */
    insole_real_t variance; /* of one component */
    bool possible;
} update_t;

/* One component: row h of H, what is seen less what is known in `z`. */
static void correct(update_t *update, insole_vec3_t h, insole_real_t z)
{
    insole_vec3_t Ph = insole_sym3_mul_vec(update->P, h);
    insole_real_t s = insole_vec3_dot(h, Ph) + update->variance;
    update->possible = update->possible && s > ZERO;
    insole_real_t per_s = INSOLE_R(1.0) / s;
    insole_real_t left = z - insole_vec3_dot(h, update->turn_rad);
    update->turn_rad = /* K = P h / s [PhoneEKF (19)] */
        insole_vec3_add_scaled(update->turn_rad, left * per_s, Ph);
    update->nis += left * left * per_s;
    update->P = insole_sym3_add_outer(update->P, -per_s, Ph); /* [PhoneEKF (21)] */
}

insole_status_t insole_attitude_ekf(insole_sym3_t *P, const insole_sighting_t *sighting,
                                    insole_correction_t *correction)
{
    if (!P || !sighting || !correction) {
        return INSOLE_ERR_NULL;
    }
    insole_vec3_t e = sighting->known;
    insole_vec3_t z = insole_vec3_sub(sighting->seen, e); /* [PhoneEKF (16)] */
    update_t update = {*P, insole_vec3_zero(), ZERO, sighting->variance, true};
    /* R_true = (I + [a]x) R: seen = known - a x known = known + [known]x a [PhoneEKF (15)] */
    correct(&update, insole_vec3(ZERO, -e.z, e.y), z.x);
    correct(&update, insole_vec3(e.z, ZERO, -e.x), z.y);
    if (e.x != ZERO || e.y != ZERO) {
        correct(&update, insole_vec3(-e.y, e.x, ZERO), z.z);
    }
    insole_real_t trace = update.P.xx + update.P.yy + update.P.zz;
    if (!update.possible || !insole_is_finite(trace + update.nis) ||
        !insole_vec3_is_finite(update.turn_rad)) {
        return INSOLE_ERR_STATE;
    }
    insole_vec3_t half = insole_vec3_scale(update.turn_rad, INSOLE_R(0.5));
    *P = update.P;
    correction->turn = insole_quat(INSOLE_R(1.0), half.x, half.y, half.z);
    correction->nis = update.nis;
    return INSOLE_OK;
}
