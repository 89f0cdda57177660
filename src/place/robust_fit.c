/* SPDX-License-Identifier: MIT */
#include "insole/place/robust_fit.h"

#define ZERO       INSOLE_R(0.0)
#define HALF       INSOLE_R(0.5)
#define ONE        INSOLE_R(1.0)
#define STEP_MAX_M INSOLE_R(5.0)
#define WEAKEST    INSOLE_R(1e-5)

/* Inverse by way of the block (x, y) without the common part: accurate also where the whole is
 * nearly singular, as with anchors that all lie one way. */
static bool invert(insole_sym3_t a, insole_sym3_t *inverse)
{
    insole_real_t g = ONE / a.zz, gx = g * a.xz, gy = g * a.yz;
    insole_real_t xx = a.xx - gx * a.xz, xy = a.xy - gx * a.yz, yy = a.yy - gy * a.yz;
    insole_real_t determinant = xx * yy - xy * xy;
    if (!(a.zz > ZERO && xx > ZERO && determinant > ZERO)) {
        return false;
    }
    inverse->xx = yy / determinant;
    inverse->xy = -xy / determinant;
    inverse->yy = xx / determinant;
    inverse->xz = -(inverse->xx * gx + inverse->xy * gy);
    inverse->yz = -(inverse->xy * gx + inverse->yy * gy);
    inverse->zz = g - (inverse->xz * gx + inverse->yz * gy);
    return true;
}

/* Covariance from information. Directions told next to nothing about get the least that the number
 * format can tell beside the rest. */
static bool covariance_of(insole_sym3_t information, insole_sym3_t *P)
{
    information.xx += WEAKEST * information.xx;
    information.yy += WEAKEST * information.yy;
    information.zz += WEAKEST * information.zz;
    return invert(information, P);
}

INSOLE_COLD bool insole_robust_fit_recall(insole_known_t *known, insole_vec3_t mean,
                                          insole_sym3_t P)
{
    insole_sym3_t more, sum_P;
    if (!invert(P, &more)) {
        return false;
    }
    insole_sym3_t sum = insole_sym3_add(known->information, more);
    if (!covariance_of(sum, &sum_P)) {
        return false;
    }
    insole_vec3_t pull = insole_sym3_mul_vec(more, insole_vec3_sub(mean, known->mean));
    insole_vec3_t step = insole_sym3_mul_vec(sum_P, pull);
    if (!insole_vec3_is_finite(step)) {
        return false;
    }
    known->mean = insole_vec3_add(known->mean, step);
    known->information = sum;
    return true;
}

INSOLE_COLD insole_robust_fit_t insole_robust_fit_begin(const insole_known_t *known,
                                                        insole_vec3_t x)
{
    insole_robust_fit_t fit = {
        insole_sym3_mul_vec(known->information, insole_vec3_sub(known->mean, x)),
        known->information};
    return fit;
}

/* The expectation bends away from its tangent plane: where that makes the cost steeper, steps must
 * be shorter, else they leap to and fro. */
static void add_bend(insole_robust_fit_t *fit, const insole_robust_reading_t *reading,
                     insole_real_t weight)
{
    insole_real_t bend = -weight * reading->residual * reading->bend;
    if (bend > ZERO) {
        fit->information.xx += bend * (ONE - reading->J.x * reading->J.x);
        fit->information.xy -= bend * reading->J.x * reading->J.y;
        fit->information.yy += bend * (ONE - reading->J.y * reading->J.y);
    }
}

INSOLE_COLD void insole_robust_fit_add(insole_robust_fit_t *fit,
                                       const insole_robust_reading_t *reading, insole_real_t loosen)
{
    insole_real_t ratio = reading->residual / (reading->sigma * reading->tail * loosen);
    insole_real_t weight = ONE / (insole_square(reading->sigma) * (ONE + ratio * ratio));
    fit->information = insole_sym3_add_outer(fit->information, weight, reading->J);
    fit->pull = insole_vec3_add_scaled(fit->pull, weight * reading->residual, reading->J);
    add_bend(fit, reading, weight);
}

INSOLE_COLD bool insole_robust_fit_step(const insole_robust_fit_t *fit, insole_vec3_t *step,
                                        insole_sym3_t *P)
{
    insole_vec3_t last = *step;
    if (!covariance_of(fit->information, P)) {
        return false;
    }
    insole_vec3_t s = insole_sym3_mul_vec(*P, fit->pull);
    insole_real_t length_m = insole_sqrt(s.x * s.x + s.y * s.y);
    insole_real_t share = length_m > STEP_MAX_M ? STEP_MAX_M / length_m : ONE;
    if (s.x * last.x + s.y * last.y < ZERO) {
        share *= HALF; /* turned back: it had gone too far */
    }
    *step = insole_vec3_scale(s, share);
    return insole_vec3_is_finite(*step);
}

INSOLE_COLD insole_real_t insole_robust_fit_loosening(insole_real_t loosen, int32_t iteration,
                                                      int32_t iterations)
{
    insole_real_t rest = ONE - INSOLE_R(2.0) * (insole_real_t)iteration / (insole_real_t)iterations;
    return ONE + (loosen - ONE) * insole_max(ZERO, rest);
}
