/* SPDX-License-Identifier: MIT */
#include "insole/base/fastmath.h"

/* Beyond this an angle in float32 is too coarse to mean a direction, and k * (first part of pi/2)
 * would no longer be exact. */
#define ANGLE_MAX_RAD INSOLE_R(1e4)

static int32_t nearest(insole_real_t x)
{
    return (int32_t)(x < INSOLE_R(0.0) ? x - INSOLE_R(0.5) : x + INSOLE_R(0.5));
}

#ifdef INSOLE_DOUBLE

#define EXP_ARGUMENT_MAX 709.78271289338397
#define EXP_ARGUMENT_MIN (-708.39641853226408)

/* x - k pi/2, pi/2 in two parts of which the first times k is exact. */
static double minus_quarter_turns(double x, double k)
{
    return (x - k * 1.5703125) - k * 4.838267948966192e-4;
}

static insole_turn_t turn_of(double x)
{
    insole_turn_t turn = {cos(x), sin(x)};
    return turn;
}

#define sin_of               sin
#define cos_of               cos
#define atan_of              atan
#define exp_of               exp
#define log_of               log
#define half_pi_minus(angle) (0.5 * INSOLE_PI - (angle))
#define pi_minus(angle)      (INSOLE_PI - (angle))

#else

typedef union {
    float value;
    uint32_t bits;
} float_bits_t;

enum { MANTISSA_BITS = 23, EXPONENT_BIAS = 127 };

#define EXP_ARGUMENT_MAX 88.7228317f    /* largest whose exponential is not above FLT_MAX */
#define EXP_ARGUMENT_MIN (-87.3365402f) /* smallest whose exponential is a normal number */

static const float LN2_HI = 0.693145752f; /* 15 bits: times an exponent it is exact */
static const float LN2_LO = 1.42860677e-6f;
static const uint32_t SQRT_HALF_BITS = 0x3f3504f3u;

/* The nearest whole number of |x| < 2^22: added to 3 * 2^22 it has no room for a fraction, and
 * stands in the low bits. */
typedef struct {
    int32_t number;
    float value;
} whole_t;

static inline whole_t nearest_whole(float x)
{
    const float room = 12582912.0f;
    float_bits_t sum = {x + room};
    whole_t whole = {(int32_t)(sum.bits - 0x4b400000u), sum.value - room};
    return whole;
}

/* x - k pi/2 for |k| < 2^13, rounded once. The first three parts of pi/2 have 11 bits: their
 * products with k are exact, and so are the first two differences and what the third one loses. */
static inline float minus_quarter_turns(float x, float k)
{
    float coarse = (x - k * 1.5703125f) - k * 4.83751297e-4f;
    float fine = k * 7.54953362e-8f;
    float r = coarse - fine;
    float lost = (coarse - r) - fine;
    return r + (lost - k * 2.56334407e-12f);
}

/* sin r for |r| <= pi/4; minimax, 2^-27.9. */
static float sin_eighth(float r)
{
    float z = r * r;
    float s = (-1.95180954e-4f * z + 8.33218824e-3f) * z - 0.166666552f;
    return r + r * z * s;
}

/* cos r for |r| <= pi/4; minimax, 2^-33. */
static float cos_eighth(float r)
{
    float z = r * r;
    float c = (2.44323273e-5f * z - 1.38873095e-3f) * z + 0.0416666456f;
    return 1.0f - (0.5f * z - z * z * c);
}

/* The nearest number of quarter turns, and what is left of the angle. */
typedef struct {
    int32_t quarters;
    float rest;
} reduced_t;

static inline reduced_t reduce(float x)
{
    whole_t quarters = nearest_whole(x * 0.636619772f);
    reduced_t reduced = {quarters.number, minus_quarter_turns(x, quarters.value)};
    return reduced;
}

static float sin_of(float x)
{
    reduced_t r = reduce(x);
    float s = (r.quarters & 1) ? cos_eighth(r.rest) : sin_eighth(r.rest);
    return (r.quarters & 2) ? -s : s;
}

static float cos_of(float x)
{
    reduced_t r = reduce(x);
    float c = (r.quarters & 1) ? sin_eighth(r.rest) : cos_eighth(r.rest);
    return ((r.quarters + 1) & 2) ? -c : c;
}

static insole_turn_t turn_of(float x)
{
    reduced_t r = reduce(x);
    float s = sin_eighth(r.rest), c = cos_eighth(r.rest);
    insole_turn_t turn = {(r.quarters & 1) ? s : c, (r.quarters & 1) ? c : s};
    turn.cos = ((r.quarters + 1) & 2) ? -turn.cos : turn.cos;
    turn.sin = (r.quarters & 2) ? -turn.sin : turn.sin;
    return turn;
}

/* For 0 <= x <= 1; minimax, 2^-27.2. */
static float atan_of(float x)
{
    float z = x * x;
    float a = -1.79637293e-3f * z + 0.0109221786f;
    a = a * z - 0.0311785471f;
    a = a * z + 0.0579418801f;
    a = a * z - 0.0840156749f;
    a = a * z + 0.109512806f;
    a = a * z - 0.142640367f;
    a = a * z + 0.199985251f;
    a = a * z - 0.333332986f;
    return x + x * z * a;
}

static float pi_minus(float angle)
{
    return 3.14159274f - (angle + 8.74227766e-8f);
}

static float half_pi_minus(float angle)
{
    return 1.57079637f - (angle + 4.37113883e-8f);
}

/* 2^k exp(r), |r| <= ln(2)/2; minimax, 2^-28.2. */
static float exp_of(float x)
{
    whole_t k = nearest_whole(x * 1.44269504f);
    float r = (x - k.value * LN2_HI) - k.value * LN2_LO;
    float p = (1.3838897e-3f * r + 8.36919248e-3f) * r + 0.0416681021f;
    p = (p * r + 0.166665167f) * r + 0.49999994f;
    float_bits_t result = {1.0f + (r + r * r * p)};
    result.bits += (uint32_t)k.number << MANTISSA_BITS;
    return result.value;
}

/* x = 2^k (1 + f), 1 + f in [sqrt(1/2), sqrt(2)); minimax, 2^-27. @return of x 2^scale */
static float log_of_normal(float x, int32_t scale)
{
    float_bits_t m = {x};
    uint32_t above = m.bits - SQRT_HALF_BITS + ((uint32_t)EXPONENT_BIAS << MANTISSA_BITS);
    int32_t k = (int32_t)(above >> MANTISSA_BITS) - EXPONENT_BIAS;
    m.bits -= (uint32_t)k << MANTISSA_BITS;
    float f = m.value - 1.0f;
    float p = (-0.0762306973f * f + 0.127661943f) * f - 0.131628081f;
    p = (p * f + 0.142002791f) * f - 0.166228324f;
    p = (p * f + 0.200012088f) * f - 0.250008494f;
    p = p * f + 0.333333403f;
    float e = (float)(k + scale);
    return e * LN2_HI + (f + (e * LN2_LO + f * f * (f * p - 0.5f)));
}

static float log_of(float x)
{
    bool is_small = x < FLT_MIN;
    return log_of_normal(is_small ? x * 8388608.0f : x, is_small ? -MANTISSA_BITS : 0);
}

#endif

insole_real_t insole_sin(insole_real_t x_rad)
{
    if (!(insole_abs(x_rad) <= ANGLE_MAX_RAD)) {
        return x_rad != x_rad ? x_rad : INSOLE_R(0.0);
    }
    return sin_of(x_rad);
}

insole_real_t insole_cos(insole_real_t x_rad)
{
    if (!(insole_abs(x_rad) <= ANGLE_MAX_RAD)) {
        return x_rad != x_rad ? x_rad : INSOLE_R(1.0);
    }
    return cos_of(x_rad);
}

insole_turn_t insole_turn(insole_real_t x_rad)
{
    if (!(insole_abs(x_rad) <= ANGLE_MAX_RAD)) {
        bool is_none = x_rad != x_rad;
        insole_turn_t beyond = {is_none ? x_rad : INSOLE_R(1.0), is_none ? x_rad : INSOLE_R(0.0)};
        return beyond;
    }
    return turn_of(x_rad);
}

insole_real_t insole_atan2(insole_real_t y, insole_real_t x)
{
    if (x != x || y != y) {
        return x + y;
    }
    insole_real_t width = insole_abs(x), height = insole_abs(y);
    insole_real_t shorter = insole_min(width, height), longer = insole_max(width, height);
    if (!(longer > INSOLE_R(0.0))) {
        return INSOLE_R(0.0);
    }
    insole_real_t angle = atan_of(shorter < longer ? shorter / longer : INSOLE_R(1.0));
    if (height > width) {
        angle = half_pi_minus(x < INSOLE_R(0.0) ? -angle : angle);
    } else if (x < INSOLE_R(0.0)) {
        angle = pi_minus(angle);
    }
    return y < INSOLE_R(0.0) && angle < INSOLE_PI ? -angle : angle;
}

insole_real_t insole_exp(insole_real_t x)
{
    if (x >= EXP_ARGUMENT_MIN && x <= EXP_ARGUMENT_MAX) {
        return exp_of(x);
    }
    if (x > EXP_ARGUMENT_MAX) {
        return INSOLE_REAL_MAX;
    }
    return x < EXP_ARGUMENT_MIN ? INSOLE_R(0.0) : x;
}

insole_real_t insole_log(insole_real_t x)
{
    if (x > INSOLE_R(0.0) && x <= INSOLE_REAL_MAX) {
        return log_of(x);
    }
    if (x <= INSOLE_R(0.0)) {
        return -INSOLE_REAL_MAX;
    }
    return x > INSOLE_REAL_MAX ? INSOLE_REAL_MAX : x;
}

insole_real_t insole_wrap_far(insole_real_t angle_rad)
{
    if (!(insole_abs(angle_rad) <= ANGLE_MAX_RAD)) {
        return angle_rad != angle_rad ? angle_rad : INSOLE_R(0.0);
    }
    int32_t turns = nearest(angle_rad * INSOLE_R(0.159154943091895336));
    insole_real_t wrapped = minus_quarter_turns(angle_rad, (insole_real_t)(4 * turns));
    if (wrapped > INSOLE_PI) {
        return wrapped - INSOLE_R(2.0) * INSOLE_PI;
    }
    return wrapped <= -INSOLE_PI ? wrapped + INSOLE_R(2.0) * INSOLE_PI : wrapped;
}
