/* SPDX-License-Identifier: MIT */
#include "insole/base/fastmath.h"

#include "fingerprint.h"
#include <string.h>

#include "near.h"
#include "oracle.h"
#include "suite.h"

static const insole_real_t NOT_A_NUMBER = (insole_real_t)NAN;
static const insole_real_t INFINITE = (insole_real_t)INFINITY;
static const insole_real_t RANGE = INSOLE_R(1e4);
static const oracle_t PI_EXACT = (oracle_t)3.14159265358979323846264338328L;

static bool same_value(insole_real_t a, insole_real_t b)
{
    return a <= b && a >= b;
}

/* One function over one range: every 1009th number. */
typedef struct {
    const char *name;
    insole_real_t (*function)(insole_real_t);
    oracle_t (*exact)(oracle_t);
    float smallest, largest, sign;
    double promised_ulp;
} sweep_t;

static const sweep_t SWEEPS[] = {
    {"sin", insole_sin, ORACLE(sin), 1e-37f, 9999.9f, 1.0f, 1.6},
    {"sin of negative", insole_sin, ORACLE(sin), 1e-37f, 9999.9f, -1.0f, 1.6},
    {"cos", insole_cos, ORACLE(cos), 1e-37f, 9999.9f, 1.0f, 1.6},
    {"cos of negative", insole_cos, ORACLE(cos), 1e-37f, 9999.9f, -1.0f, 1.6},
    {"exp", insole_exp, ORACLE(exp), 1e-37f, 88.7228f, 1.0f, 1.0},
    {"exp of negative", insole_exp, ORACLE(exp), 1e-37f, 87.3365f, -1.0f, 1.0},
    {"log", insole_log, ORACLE(log), 1e-45f, 3.40282e38f, 1.0f, 1.0},
};

START_TEST(error_stays_below_the_promise)
{
    const sweep_t *sweep = &SWEEPS[_i];
    worst_t error_of_function = {0.0, 0.0};
    for (uint32_t bits = bits_of(sweep->smallest); bits <= bits_of(sweep->largest); bits += 1009u) {
        insole_real_t x = (insole_real_t)sweep->sign * number_of(bits);
        double off = ulps_off(sweep->function(x), sweep->exact((oracle_t)x));
        worst_note(&error_of_function, off, (double)x);
    }
    ASSERT_WORST(error_of_function, sweep->promised_ulp, sweep->name);
    ASSERT_AT_LEAST(error_of_function.off, 0.4, "ulp: less cannot be a measurement");
}
END_TEST

/* The numbers around each multiple of pi/2, where the reduction of the angle cancels most. */
START_TEST(sin_and_cos_hold_at_their_zeros)
{
    worst_t error_near_zeros = {0.0, 0.0};
    for (int k = 0; k <= 6366; k++) {
        insole_real_t x = (insole_real_t)((oracle_t)k * PI_EXACT / 2);
        x = REAL_NEXT(REAL_NEXT(x, -RANGE), -RANGE);
        for (int i = 0; i < 5; i++) {
            double sin_off = ulps_off(insole_sin(x), ORACLE(sin)((oracle_t)x));
            double cos_off = ulps_off(insole_cos(x), ORACLE(cos)((oracle_t)x));
            worst_note(&error_near_zeros, sin_off, (double)x);
            worst_note(&error_near_zeros, cos_off, (double)x);
            x = REAL_NEXT(x, RANGE);
        }
    }
    ASSERT_WORST(error_near_zeros, 1.6, "ulp");
}
END_TEST

static double atan2_off(insole_real_t y, insole_real_t x)
{
    insole_real_t angle = insole_atan2(y, x);
    if (!(angle > -INSOLE_PI && angle <= INSOLE_PI)) {
        return (double)NAN;
    }
    oracle_t exact = ORACLE(atan2)((oracle_t)y, (oracle_t)x);
    bool across_the_cut = angle > INSOLE_R(3.0) && exact < 0; /* -pi is told as +pi */
    return ulps_off(angle, across_the_cut ? exact + 2 * PI_EXACT : exact);
}

static void note_octants(worst_t *error_of_atan2, insole_real_t shorter, insole_real_t longer)
{
    for (int octant = 0; octant < 8; octant++) {
        insole_real_t x = octant & 1 ? shorter : longer;
        insole_real_t y = octant & 1 ? longer : shorter;
        double off = atan2_off(octant & 4 ? -y : y, octant & 2 ? -x : x);
        worst_note(error_of_atan2, off, (double)(shorter / longer));
    }
}

START_TEST(atan2_holds_in_every_octant)
{
    static const float LENGTHS[] = {1e-30f, 1.0f, 1.2345678f, 1.9999999f, 3e38f};
    insole_real_t longer = (insole_real_t)LENGTHS[_i];
    worst_t error_of_atan2 = {0.0, 0.0};
    for (uint32_t bits = bits_of(1e-12f); bits < bits_of(1.0f); bits += 2003u) {
        note_octants(&error_of_atan2, longer * number_of(bits), longer);
    }
    note_octants(&error_of_atan2, longer, longer);
    note_octants(&error_of_atan2, INSOLE_R(0.0), longer);
    ASSERT_WORST(error_of_atan2, 1.7, "ulp");
    ASSERT_AT_LEAST(error_of_atan2.off, 0.4, "ulp: less cannot be a measurement");
}
END_TEST

START_TEST(atan2_of_any_two_lengths)
{
    worst_t error_of_atan2 = {0.0, 0.0};
    for (uint32_t b = 1u; b < 0x7f000000u; b += 5000011u) {
        for (uint32_t c = b; c < 0x7f000000u; c += 10000019u) {
            note_octants(&error_of_atan2, number_of(b), number_of(c));
        }
    }
    ASSERT_WORST(error_of_atan2, 1.7, "ulp");
}
END_TEST

START_TEST(atan2_special_points)
{
    const insole_real_t zero = INSOLE_R(0.0), one = INSOLE_R(1.0), inf = INFINITE;
    const insole_real_t half_pi = INSOLE_R(0.5) * INSOLE_PI;
    const struct {
        insole_real_t y, x, angle;
    } points[] = {
        {zero, zero, zero},
        {-zero, -zero, zero},
        {zero, one, zero},
        {zero, -one, INSOLE_PI},
        {-zero, -one, INSOLE_PI},
        {one, zero, half_pi},
        {-one, zero, -half_pi},
        {one, -zero, half_pi},
        {inf, one, half_pi},
        {-inf, -one, -half_pi},
        {one, inf, zero},
        {one, -inf, INSOLE_PI},
        {inf, inf, INSOLE_R(0.5) * half_pi},
    };
    for (size_t i = 0; i < sizeof points / sizeof points[0]; i++) {
        insole_real_t angle = insole_atan2(points[i].y, points[i].x);
        ck_assert_msg(same_value(angle, points[i].angle), "point %zu: %.9g", i, (double)angle);
    }
    ck_assert(same_value(insole_atan2(-REAL_MIN, -one), INSOLE_PI));
    ck_assert(isnan(insole_atan2(NOT_A_NUMBER, one)));
    ck_assert(isnan(insole_atan2(one, NOT_A_NUMBER)));
    ck_assert(isnan(insole_atan2(zero, NOT_A_NUMBER)));
}
END_TEST

START_TEST(exact_points)
{
    const insole_real_t zero = INSOLE_R(0.0), one = INSOLE_R(1.0);
    ck_assert(same_value(insole_sin(zero), zero));
    ck_assert(same_value(insole_cos(zero), one));
    ck_assert(same_value(insole_exp(zero), one));
    ck_assert(same_value(insole_exp(-zero), one));
    ck_assert(same_value(insole_log(one), zero));
    ck_assert(same_value(insole_wrap_pi(zero), zero));
    ck_assert(same_value(insole_sin(REAL_MIN), REAL_MIN));
    ck_assert(same_value(insole_cos(REAL_MIN), one));
    ck_assert(same_value(insole_exp(REAL_MIN), one));
}
END_TEST

START_TEST(angles_beyond_the_range_count_as_zero)
{
    const insole_real_t beyond[] = {REAL_NEXT(RANGE, INFINITE), INSOLE_R(1e30), INSOLE_REAL_MAX,
                                    INFINITE};
    insole_real_t x = _i & 1 ? -beyond[_i / 2] : beyond[_i / 2];
    ck_assert(same_value(insole_sin(x), INSOLE_R(0.0)));
    ck_assert(same_value(insole_cos(x), INSOLE_R(1.0)));
    ck_assert(same_value(insole_wrap_pi(x), INSOLE_R(0.0)));
    ck_assert(!same_value(insole_sin(RANGE), INSOLE_R(0.0)));
}
END_TEST

START_TEST(exp_and_log_beyond_their_range)
{
    const insole_real_t zero = INSOLE_R(0.0);
    ck_assert(same_value(insole_exp(INFINITE), INSOLE_REAL_MAX));
    ck_assert(same_value(insole_exp(INSOLE_REAL_MAX), INSOLE_REAL_MAX));
    ck_assert(same_value(insole_exp(-INFINITE), zero));
    ck_assert(same_value(insole_exp(-INSOLE_REAL_MAX), zero));
    ck_assert(same_value(insole_log(zero), -INSOLE_REAL_MAX));
    ck_assert(same_value(insole_log(-zero), -INSOLE_REAL_MAX));
    ck_assert(same_value(insole_log(INSOLE_R(-1.0)), -INSOLE_REAL_MAX));
    ck_assert(same_value(insole_log(-INFINITE), -INSOLE_REAL_MAX));
    ck_assert(same_value(insole_log(INFINITE), INSOLE_REAL_MAX));
}
END_TEST

/* The last argument with a finite, and the first with a normal exponential: right up to there. */
START_TEST(exp_is_exact_to_the_ends_of_its_range)
{
    insole_real_t top = insole_log(INSOLE_REAL_MAX), bottom = insole_log(REAL_MIN);
    for (int i = 0; i < 40; i++) {
        insole_real_t high = insole_exp(top), low = insole_exp(bottom);
        oracle_t exact_high = ORACLE(exp)((oracle_t)top), exact_low = ORACLE(exp)((oracle_t)bottom);
        ck_assert(exact_high > (oracle_t)INSOLE_REAL_MAX ? same_value(high, INSOLE_REAL_MAX)
                                                         : ulps_off(high, exact_high) <= 1.0);
        ck_assert(exact_low < (oracle_t)REAL_MIN ? same_value(low, INSOLE_R(0.0))
                                                 : ulps_off(low, exact_low) <= 1.0);
        top = REAL_NEXT(top, i < 20 ? -INFINITE : INFINITE);
        bottom = REAL_NEXT(bottom, i < 20 ? INFINITE : -INFINITE);
    }
}
END_TEST

static bool answers_are_finite(insole_real_t x)
{
    insole_real_t s = insole_sin(x), c = insole_cos(x), w = insole_wrap_pi(x);
    insole_real_t e = insole_exp(x);
    return insole_abs(s) <= INSOLE_R(1.0) && insole_abs(c) <= INSOLE_R(1.0) && w > -INSOLE_PI &&
           w <= INSOLE_PI && e >= INSOLE_R(0.0) && e <= INSOLE_REAL_MAX &&
           insole_is_finite(insole_log(x)) && insole_is_finite(insole_atan2(x, INSOLE_R(-1.0))) &&
           insole_is_finite(insole_atan2(INSOLE_R(1.0), x));
}

static bool answers_are_not_numbers(insole_real_t x)
{
    return isnan(insole_sin(x)) && isnan(insole_cos(x)) && isnan(insole_wrap_pi(x)) &&
           isnan(insole_exp(x)) && isnan(insole_log(x)) && isnan(insole_atan2(x, x));
}

START_TEST(any_bits_give_a_finite_answer_unless_not_a_number)
{
    worst_t answers = {0.0, 0.0};
    for (uint64_t bits = 0u; bits <= UINT32_MAX; bits += 10007u) {
        insole_real_t x = number_of((uint32_t)bits);
        worst_require(&answers, isnan(x) ? answers_are_not_numbers(x) : answers_are_finite(x),
                      (double)x);
    }
    ASSERT_ALL_HELD(answers);
}
END_TEST

START_TEST(odd_and_even)
{
    worst_t symmetry = {0.0, 0.0}, unit_circle = {0.0, 0.0};
    for (uint32_t bits = bits_of(1e-20f); bits <= bits_of(9999.9f); bits += 5003u) {
        insole_real_t x = number_of(bits), one = INSOLE_R(1.0);
        worst_require(&symmetry, same_value(insole_sin(-x), -insole_sin(x)), (double)x);
        worst_require(&symmetry, same_value(insole_cos(-x), insole_cos(x)), (double)x);
        worst_require(&symmetry, same_value(insole_atan2(-x, one), -insole_atan2(x, one)),
                      (double)x);
        double r2 = (double)(insole_square(insole_sin(x)) + insole_square(insole_cos(x)));
        worst_note(&unit_circle, fabs(r2 - 1.0), (double)x);
    }
    ASSERT_ALL_HELD(symmetry);
    ASSERT_WORST(unit_circle, 4.0 * (double)INSOLE_REAL_EPSILON, "");
}
END_TEST

/* 200 neighbours from x on, through which the function must not fall. */
static bool rises_from(insole_real_t (*function)(insole_real_t), insole_real_t x)
{
    insole_real_t before = function(x);
    for (int i = 0; i < 200; i++) {
        x = REAL_NEXT(x, INFINITE);
        insole_real_t value = function(x);
        if (!(value >= before)) {
            return false;
        }
        before = value;
    }
    return true;
}

/* Where exp changes its power of two and log its exponent, and between. */
START_TEST(exp_and_log_never_step_back)
{
    worst_t rising = {0.0, 0.0};
    for (int half = -240; half <= 240; half++) {
        insole_real_t x = (insole_real_t)(0.34657359027997265 * half);
        insole_real_t before = x - INSOLE_R(100.0) * INSOLE_REAL_EPSILON * insole_abs(x);
        worst_require(&rising, rises_from(insole_exp, before), (double)x);
        insole_real_t power =
            insole_exp(x) * (INSOLE_R(1.0) - INSOLE_R(100.0) * INSOLE_REAL_EPSILON);
        worst_require(&rising, rises_from(insole_log, power), (double)x);
    }
    ASSERT_ALL_HELD(rising);
}
END_TEST

static const struct {
    insole_real_t (*wrap)(insole_real_t);
    float from_rad;
} WRAPS[] = {{insole_wrap_pi, 3.0f}, {insole_wrap_near, 3.0f}, {insole_wrap_far, 1e-6f}};

START_TEST(wrapped_angle_is_the_same_angle)
{
#ifdef INSOLE_DOUBLE
    const double promised_ulp = 2.5;
#else
    const double promised_ulp = 1.3;
#endif
    const double ulp_of_pi = 2.0 * (double)INSOLE_REAL_EPSILON;
    worst_t wrapping = {0.0, 0.0};
    for (uint32_t bits = bits_of(WRAPS[_i].from_rad); bits <= bits_of(9999.9f); bits += 101u) {
        insole_real_t x = bits & 1u ? -number_of(bits) : number_of(bits);
        insole_real_t wrapped = WRAPS[_i].wrap(x);
        oracle_t off = (oracle_t)wrapped - (oracle_t)x;
        off = ORACLE(fabs)(off - 2 * PI_EXACT * ORACLE(nearbyint)(off / (2 * PI_EXACT)));
        bool inside = wrapped > -INSOLE_PI && wrapped <= INSOLE_PI;
        worst_note(&wrapping, inside ? (double)off / ulp_of_pi : (double)NAN, (double)x);
    }
    ASSERT_WORST(wrapping, promised_ulp, "ulp of pi");
}
END_TEST

START_TEST(wrapping_leaves_a_wrapped_angle_alone)
{
    insole_real_t below = REAL_NEXT(INSOLE_PI, INSOLE_R(0.0));
    ck_assert(same_value(insole_wrap_pi(INSOLE_PI), INSOLE_PI));
    ck_assert(same_value(insole_wrap_pi(below), below));
    ck_assert(same_value(insole_wrap_pi(-below), -below));
    worst_t unchanged = {0.0, 0.0};
    for (uint32_t bits = 0u; bits < bits_of(3.1415925f); bits += 10007u) {
        insole_real_t x = number_of(bits);
        worst_require(&unchanged, same_value(insole_wrap_pi(x), x), (double)x);
        worst_require(&unchanged, same_value(insole_wrap_pi(-x), -x), (double)x);
        worst_require(&unchanged, same_value(insole_wrap_near(-x), -x), (double)x);
    }
    ASSERT_ALL_HELD(unchanged);
}
END_TEST

/* The numbers around each odd multiple of pi, where rounding may pick the wrong turn: the result
 * lies at most one step of the argument away from either end. */
START_TEST(wrapping_at_the_cut)
{
    worst_t inside = {0.0, 0.0}, off_the_cut = {0.0, 0.0};
    for (int turn = -1591; turn < 1591; turn++) {
        insole_real_t x = (insole_real_t)((2 * turn + 1) * PI_EXACT);
        double step = 3.0 * (double)insole_abs(x) * (double)INSOLE_REAL_EPSILON;
        x = REAL_NEXT(REAL_NEXT(x, -RANGE), -RANGE);
        for (int i = 0; i < 5; i++) {
            insole_real_t wrapped = insole_wrap_pi(x);
            worst_require(&inside, wrapped > -INSOLE_PI && wrapped <= INSOLE_PI, (double)x);
            double off = fabs((double)insole_abs(wrapped) - (double)INSOLE_PI);
            worst_note(&off_the_cut, off / step, (double)x);
            x = REAL_NEXT(x, RANGE);
        }
    }
    ASSERT_ALL_HELD(inside);
    ASSERT_WORST(off_the_cut, 1.0, "times three steps");
    ck_assert(insole_wrap_pi(INSOLE_R(3.15)) < INSOLE_R(-3.13));
    ck_assert(insole_wrap_pi(INSOLE_R(-3.15)) > INSOLE_R(3.13));
}
END_TEST

static bool same_bits(insole_real_t a, insole_real_t b)
{
    return memcmp(&a, &b, sizeof a) == 0 || (a != a && b != b);
}

static void require_turn_at(worst_t *same, insole_real_t x)
{
    insole_turn_t turn = insole_turn(x);
    worst_require(same, same_bits(turn.cos, insole_cos(x)), (double)x);
    worst_require(same, same_bits(turn.sin, insole_sin(x)), (double)x);
}

/* Near every quarter turn, between them, beyond the range, and for what is no number. */
START_TEST(turn_has_the_bits_of_cos_and_sin)
{
    worst_t same = {0.0, 0.0};
    for (int k = -6366; k <= 6366; k++) {
        insole_real_t x = (insole_real_t)((oracle_t)k * PI_EXACT / 2);
        require_turn_at(&same, x);
        require_turn_at(&same, REAL_NEXT(x, RANGE));
        require_turn_at(&same, REAL_NEXT(x, -RANGE));
        require_turn_at(&same, x + INSOLE_R(0.3));
        require_turn_at(&same, x + INSOLE_R(0.9));
    }
    static const insole_real_t ODD[] = {INSOLE_R(0.0),     INSOLE_R(-0.0),  INSOLE_R(1e-30),
                                        INSOLE_R(-1e-4),   INSOLE_R(1e4),   INSOLE_R(10001.0),
                                        INSOLE_R(-1e9),    INSOLE_REAL_MAX, (insole_real_t)INFINITY,
                                        (insole_real_t)NAN};
    for (size_t i = 0; i < sizeof ODD / sizeof ODD[0]; i++) {
        require_turn_at(&same, ODD[i]);
    }
    ASSERT_ALL_HELD(same);
}
END_TEST

#ifndef INSOLE_DOUBLE
START_TEST(same_bits_on_every_machine)
{
    const fingerprint_t *print = &FINGERPRINTS[_i];
    uint32_t bits = fingerprint_of(print->function);
    ck_assert_msg(bits == print->expected, "%s: %08x, expected %08x", print->name, bits,
                  print->expected);
}
END_TEST
#endif

Suite *insole_suite(void)
{
    Suite *suite = suite_create("fastmath");
    suite_add_loop(suite, "error below the promise", error_stays_below_the_promise,
                   sizeof SWEEPS / sizeof SWEEPS[0]);
    suite_add(suite, "sin and cos at their zeros", sin_and_cos_hold_at_their_zeros);
    suite_add_loop(suite, "atan2 in every octant", atan2_holds_in_every_octant, 5);
    suite_add(suite, "atan2 of any two lengths", atan2_of_any_two_lengths);
    suite_add(suite, "atan2 special points", atan2_special_points);
    suite_add(suite, "exact points", exact_points);
    suite_add_loop(suite, "angles beyond the range", angles_beyond_the_range_count_as_zero, 8);
    suite_add(suite, "exp and log beyond the range", exp_and_log_beyond_their_range);
    suite_add(suite, "exp at the ends of its range", exp_is_exact_to_the_ends_of_its_range);
    suite_add(suite, "any bits", any_bits_give_a_finite_answer_unless_not_a_number);
    suite_add(suite, "odd and even", odd_and_even);
    suite_add(suite, "monotonic", exp_and_log_never_step_back);
    suite_add(suite, "turn", turn_has_the_bits_of_cos_and_sin);
    suite_add_loop(suite, "wrap", wrapped_angle_is_the_same_angle,
                   (int)(sizeof WRAPS / sizeof WRAPS[0]));
    suite_add(suite, "wrap leaves alone", wrapping_leaves_a_wrapped_angle_alone);
    suite_add(suite, "wrap at the cut", wrapping_at_the_cut);
#ifndef INSOLE_DOUBLE
    suite_add_loop(suite, "same bits", same_bits_on_every_machine, FINGERPRINT_COUNT);
#endif
    return suite;
}
