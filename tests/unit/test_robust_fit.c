/* SPDX-License-Identifier: MIT */
#include "insole/place/robust_fit.h"

#include "anchors.h"
#include "suite.h"

static insole_real_t any(double low, double high)
{
    return (insole_real_t)uniform(low, high);
}

static insole_known_t known_at(insole_vec3_t mean, double sigma)
{
    insole_real_t information = (insole_real_t)(1.0 / (sigma * sigma));
    insole_known_t known = {mean, insole_sym3_diagonal(information, information, information)};
    return known;
}

static insole_robust_reading_t reading_of(insole_vec3_t J, double residual, double sigma)
{
    insole_robust_reading_t reading = {J, (insole_real_t)residual, (insole_real_t)sigma, 1000, 0};
    return reading;
}

/* With linear readings and squares the first step is the solution: J'J x = J'r, by hand. */
START_TEST(linear_squares_in_one_step)
{
    insole_known_t known = known_at(insole_vec3_zero(), 1e3);
    insole_vec3_t truth = insole_vec3(1, -2, INSOLE_R(0.5)), step = insole_vec3_zero();
    insole_sym3_t P;
    insole_robust_fit_t fit = insole_robust_fit_begin(&known, insole_vec3_zero());
    insole_rng_seed(&rng, 1u);
    for (int i = 0; i < 12; i++) {
        insole_vec3_t J = insole_vec3(any(-1, 1), any(-1, 1), 1);
        insole_robust_reading_t reading = reading_of(J, (double)insole_vec3_dot(J, truth), 0.1);
        insole_robust_fit_add(&fit, &reading, 1);
    }
    ck_assert(insole_robust_fit_step(&fit, &step, &P));
    ASSERT_NEAR(step.x, 1.0, 1e-3, "m");
    ASSERT_NEAR(step.y, -2.0, 1e-3, "m");
    ASSERT_NEAR(step.z, 0.5, 1e-3, "");
    insole_mat3_t unit = insole_mat3_mul(insole_sym3_full(P), insole_sym3_full(fit.information));
    ASSERT_NEAR(unit.r0.x, 1.0, 1e-3, "");
    ASSERT_NEAR(unit.r1.y, 1.0, 1e-3, "");
    ASSERT_NEAR(unit.r2.x, 0.0, 1e-3, "");
}
END_TEST

START_TEST(weights_by_hand)
{
    insole_known_t known = known_at(insole_vec3_zero(), 1e3);
    static const double cases[][5] = {/* residual, sigma, tail, loosen, weight */
                                      {0, 2, 1, 1, 0.25},   {2, 2, 1, 1, 0.125},
                                      {-2, 2, 1, 1, 0.125}, {4, 2, 1, 2, 0.125},
                                      {6, 1, 3, 1, 0.2},    {3, 1, 1, 1, 0.1}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        insole_robust_reading_t reading =
            reading_of(insole_vec3(1, 0, 0), cases[i][0], cases[i][1]);
        reading.tail = (insole_real_t)cases[i][2];
        insole_robust_fit_t fit = insole_robust_fit_begin(&known, insole_vec3_zero());
        insole_robust_fit_add(&fit, &reading, (insole_real_t)cases[i][3]);
        ASSERT_NEAR(fit.information.xx, 1e-6 + cases[i][4], 1e-6, "");
        ASSERT_NEAR(fit.pull.x, cases[i][0] * cases[i][4], 1e-6, "");
        ASSERT_NEAR(fit.information.yy, 1e-6, 1e-9, "");
    }
}
END_TEST

/* Second derivatives of half the square of a range's residual, by finite differences. */
START_TEST(bend_is_the_second_derivative)
{
    for (int i = 0; i < 12; i++) {
        double a = 0.5 * i, d = 4.0, x = d * cos(a), y = d * sin(a), rho = d - 1.5, h = 1e-3;
        double f0 = 0.5 * pow(rho - hypot(x, y), 2.0);
        double fxx = 0.5 * pow(rho - hypot(x + h, y), 2.0) + 0.5 * pow(rho - hypot(x - h, y), 2.0);
        double fxy =
            0.5 * pow(rho - hypot(x + h, y + h), 2.0) + 0.5 * pow(rho - hypot(x - h, y - h), 2.0) -
            0.5 * pow(rho - hypot(x - h, y + h), 2.0) - 0.5 * pow(rho - hypot(x + h, y - h), 2.0);
        insole_known_t known = known_at(insole_vec3_zero(), 1e3);
        insole_robust_fit_t fit = insole_robust_fit_begin(&known, insole_vec3_zero());
        insole_vec3_t J = insole_vec3((insole_real_t)cos(a), (insole_real_t)sin(a), 1);
        insole_robust_reading_t reading = reading_of(J, -1.5, 1.0);
        reading.bend = (insole_real_t)(1.0 / d);
        insole_robust_fit_add(&fit, &reading, 1);
        ASSERT_NEAR(fit.information.xx, (fxx - 2.0 * f0) / (h * h), 1e-3, "");
        ASSERT_NEAR(fit.information.xy, fxy / (4.0 * h * h), 1e-3, "");
        /* a range too long would bend the other way: left out, the equations stay positive */
        fit = insole_robust_fit_begin(&known, insole_vec3_zero());
        reading.residual = INSOLE_R(1.5);
        insole_robust_fit_add(&fit, &reading, 1);
        ASSERT_NEAR(fit.information.xx, cos(a) * cos(a), 1e-4, "");
    }
}
END_TEST

/* Two pieces of knowledge make one: inverse variances add, means are weighed by them. */
START_TEST(recall_by_hand)
{
    insole_known_t known = known_at(insole_vec3(0, 10, 3), 2.0);
    insole_sym3_t P = insole_sym3_diagonal(4, INSOLE_R(4.0) / 3, 1);
    ck_assert(insole_robust_fit_recall(&known, insole_vec3(4, 2, 3), P));
    ASSERT_NEAR(known.mean.x, 2.0, 1e-4, "m");
    ASSERT_NEAR(known.mean.y, 4.0, 1e-4, "m");
    ASSERT_NEAR(known.mean.z, 3.0, 1e-4, "");
    ASSERT_NEAR(known.information.xx, 0.5, 1e-6, "1/m2");
    ASSERT_NEAR(known.information.yy, 1.0, 1e-6, "1/m2");
    ASSERT_NEAR(known.information.zz, 1.25, 1e-6, "");
}
END_TEST

START_TEST(recall_refuses_what_is_no_covariance)
{
    const insole_sym3_t bad[] = {insole_sym3_diagonal(-1, 1, 1),
                                 insole_sym3_diagonal(1, 1, 0),
                                 insole_sym3_diagonal(1, (double)NAN, 1),
                                 {1, 2, 0, 1, 0, 1}};
    const insole_vec3_t nowhere = insole_vec3((double)INFINITY, 0, 0);
    insole_known_t known = known_at(insole_vec3(1, 2, 3), 2.0), before = known;
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        ck_assert(!insole_robust_fit_recall(&known, insole_vec3_zero(), bad[i]));
        ck_assert_mem_eq(&known, &before, sizeof known);
    }
    ck_assert(!insole_robust_fit_recall(&known, nowhere, insole_sym3_diagonal(1, 1, 1)));
    ck_assert_mem_eq(&known, &before, sizeof known);
}
END_TEST

START_TEST(steps_are_bounded_and_finite)
{
    insole_known_t known = known_at(insole_vec3(300, 400, 7), 1.0);
    insole_robust_fit_t fit = insole_robust_fit_begin(&known, insole_vec3_zero());
    insole_vec3_t step = insole_vec3_zero();
    insole_sym3_t P;
    ck_assert(insole_robust_fit_step(&fit, &step, &P));
    ASSERT_NEAR(step.x, 3.0, 1e-4, "m");
    ASSERT_NEAR(step.y, 4.0, 1e-4, "m");
    insole_vec3_t ahead = step;
    ck_assert(insole_robust_fit_step(&fit, &step, &P)); /* onwards */
    ASSERT_NEAR(step.y, ahead.y, 0.0, "m");
    step = insole_vec3(-1, 0, 0);
    ck_assert(insole_robust_fit_step(&fit, &step, &P)); /* back again: half as far */
    ASSERT_NEAR(step.x, 1.5, 1e-4, "m");
    ASSERT_NEAR(step.y, 2.0, 1e-4, "m");
    fit.pull.x = (double)NAN;
    ck_assert(!insole_robust_fit_step(&fit, &step, &P));
    fit.information.xx = (double)NAN;
    ck_assert(!insole_robust_fit_step(&fit, &step, &P));
}
END_TEST

/* However badly the readings lie, the covariance stays positive. */
START_TEST(covariance_of_any_geometry)
{
    insole_rng_seed(&rng, 2u);
    for (int i = 0; i < 5000; i++) {
        insole_known_t known = known_at(insole_vec3_zero(), pow(10.0, uniform(-1, 3)));
        known.information.zz = (insole_real_t)pow(10.0, uniform(-4, 6));
        insole_robust_fit_t fit = insole_robust_fit_begin(&known, insole_vec3_zero());
        double a = uniform(-3, 3), spread = pow(10.0, uniform(-6, 0));
        double sigma = pow(10.0, uniform(-2, 1));
        for (int k = 0; k < 8; k++) {
            double b = a + spread * uniform(-1, 1);
            insole_vec3_t J = insole_vec3((insole_real_t)cos(b), (insole_real_t)sin(b), 1);
            insole_robust_reading_t reading = reading_of(J, uniform(-1, 1), sigma);
            insole_robust_fit_add(&fit, &reading, 1);
        }
        insole_vec3_t step = insole_vec3_zero();
        insole_sym3_t P;
        ck_assert(insole_robust_fit_step(&fit, &step, &P));
        check_covariance(&P);
    }
}
END_TEST

START_TEST(tails_tighten)
{
    ASSERT_NEAR(insole_robust_fit_loosening(4, 0, 10), 4.0, 0.0, "");
    ASSERT_NEAR(insole_robust_fit_loosening(4, 2, 10), 2.8, 1e-6, "");
    ASSERT_NEAR(insole_robust_fit_loosening(4, 5, 10), 1.0, 0.0, "");
    ASSERT_NEAR(insole_robust_fit_loosening(4, 9, 10), 1.0, 0.0, "");
    ASSERT_NEAR(insole_robust_fit_loosening(1, 0, 10), 1.0, 0.0, "");
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("robust_fit");
    suite_add(suite, "linear squares in one step", linear_squares_in_one_step);
    suite_add(suite, "weights by hand", weights_by_hand);
    suite_add(suite, "bend is the second derivative", bend_is_the_second_derivative);
    suite_add(suite, "recall by hand", recall_by_hand);
    suite_add(suite, "recall refuses", recall_refuses_what_is_no_covariance);
    suite_add(suite, "steps are bounded and finite", steps_are_bounded_and_finite);
    suite_add(suite, "covariance of any geometry", covariance_of_any_geometry);
    suite_add(suite, "tails tighten", tails_tighten);
    return suite;
}
