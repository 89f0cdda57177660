/* SPDX-License-Identifier: MIT */
#include "insole/move/heading.h"

#include "motion.h"
#include "near.h"
#include "sample.h"
#include "suite.h"

#define PI  3.14159265358979323846
#define DEG (PI / 180.0)
#define EPS ((double)INSOLE_REAL_EPSILON)

static double off_by(double a, double b)
{
    return fabs(remainder(a - b, 2.0 * PI));
}

/* Heading `yaw` + a quarter turn, top pitched up, then rolled about the long axis. */
static insole_quat_t held(double yaw, double pitch, double roll)
{
    return quat_of(d33_mul(turn_z(yaw), d33_mul(turn_x(pitch), turn_y(roll))));
}

START_TEST(tilt_below_sixty_degrees_does_not_matter)
{
    worst_t heading = {0.0, 0.0}, direction = {0.0, 0.0};
    for (int yaw = -180; yaw < 180; yaw += 15) {
        for (int pitch = -60; pitch <= 60; pitch += 10) {
            for (int roll = -180; roll < 180; roll += 20) {
                double expected = yaw * DEG + 0.5 * PI;
                insole_heading_t h = insole_heading(held(yaw * DEG, pitch * DEG, roll * DEG), NULL);
                worst_note(&heading, off_by((double)h.heading_rad, expected), yaw);
                worst_note(
                    &direction,
                    hypot((double)h.ahead.cos - cos(expected), (double)h.ahead.sin - sin(expected)),
                    yaw);
                worst_note(&direction, fabs((double)h.variance_rad2), yaw);
            }
        }
    }
    ASSERT_WORST(heading, 8.0 * EPS, "rad");
    ASSERT_WORST(direction, 8.0 * EPS, "");
}
END_TEST

/* The printed formulas, which count from +y, in double. */
START_TEST(yaw_of_the_paper_is_a_quarter_turn_less)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 1u);
    worst_t six = {0.0, 0.0}, thirty = {0.0, 0.0};
    int used = 0;
    for (int i = 0; i < 4000; i++) {
        insole_quat_t q = sample_quat(&rng);
        double q0 = (double)q.w, q1 = (double)q.x, q2 = (double)q.y, q3 = (double)q.z;
        double steep = 2.0 * (q0 * q1 + q2 * q3);
        if (1.0 - steep * steep < 0.13) {
            continue;
        }
        used++;
        insole_heading_t h = insole_heading(q, NULL);
        double yaw = atan2(2.0 * (q0 * q3 - q1 * q2), q0 * q0 - q1 * q1 + q2 * q2 - q3 * q3);
        double root = pow(1.0 - 4.0 * (q0 * q1 + q2 * q3) * (q0 * q1 + q2 * q3), -0.5);
        double c = (1.0 - 2.0 * q1 * q1 - 2.0 * q3 * q3) * root;
        double s = (2.0 * q0 * q3 - 2.0 * q1 * q2) * root;
        worst_note(&six, off_by((double)h.heading_rad, yaw + 0.5 * PI), i);
        worst_note(&thirty, hypot((double)h.ahead.sin - c, (double)h.ahead.cos + s), i);
    }
    ck_assert_int_gt(used, 3000);
    ASSERT_WORST(six, 20.0 * EPS, "rad");
    ASSERT_WORST(thirty, 20.0 * EPS, "");
}
END_TEST

/* From face down over flat, upright and back over the head: no jump, whatever the axis in use. */
START_TEST(pitching_through_the_vertical_keeps_the_heading)
{
    worst_t heading = {0.0, 0.0};
    for (int pitch = -110; pitch <= 110; pitch++) {
        for (int yaw = -180; yaw < 180; yaw += 30) {
            insole_heading_t h = insole_heading(held(yaw * DEG, pitch * DEG, 0.0), NULL);
            worst_note(&heading, off_by((double)h.heading_rad, yaw * DEG + 0.5 * PI), pitch);
        }
    }
    ASSERT_WORST(heading, 20.0 * EPS, "rad");
}
END_TEST

START_TEST(every_attitude_has_a_heading)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 2u);
    worst_t unit = {0.0, 0.0}, finite = {0.0, 0.0}, slope = {0.0, 0.0};
    for (int i = 0; i < 20000; i++) {
        insole_quat_t q = sample_quat(&rng);
        if (i % 4 == 0) { /* nearly upright, top up or down */
            double up = i % 8 == 0 ? 0.5 * PI : -0.5 * PI;
            q = held(i * 0.37, up + 1.0e-4 * (i % 100 - 50), i * 0.11);
        }
        insole_heading_t h = insole_heading(q, NULL);
        worst_note(&unit, fabs(hypot((double)h.ahead.cos, (double)h.ahead.sin) - 1.0), i);
        worst_require(&finite, fabs((double)h.heading_rad) <= PI * (1.0 + EPS), i);
        worst_note(&slope, (double)insole_vec3_norm(h.jacobian), i);
    }
    ASSERT_WORST(unit, 4.0 * EPS, "");
    ASSERT_ALL_HELD(finite);
    ASSERT_WORST(slope, sqrt(1.0 + (1.0 - 0.35 * 0.35) / (0.35 * 0.35)) + 1.0e-4, "rad/rad");
}
END_TEST

/* Central differences in double of the axis that is in use. */
static double heading_of(d33_t R, int axis)
{
    d3_t v = axis == 1 ? d3(R.r0.y, R.r1.y, R.r2.y) : d3(R.r0.z, R.r1.z, R.r2.z);
    return atan2(v.y, v.x);
}

START_TEST(jacobian_and_variance_are_those_of_small_rotations)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 3u);
    worst_t slope = {0.0, 0.0}, variance = {0.0, 0.0};
    const double step = 1.0e-5;
    for (int i = 0; i < 2000; i++) {
        insole_quat_t q =
            i % 3 == 0 ? held(i, 0.5 * PI - 1.0e-3 * (i % 200), i * 0.3) : sample_quat(&rng);
        insole_mat3_t M = sample_mat3(&rng, 1);
        insole_sym3_t P = insole_mat3_mul_t_sym(M, M);
        insole_heading_t h = insole_heading(q, &P);
        d33_t R = d33_of(insole_quat_to_mat3(q));
        int axis = hypot(R.r0.y, R.r1.y) >= 0.35 ? 1 : 2;
        d33_t turned[3][2] = {{turn_x(step), turn_x(-step)},
                              {turn_y(step), turn_y(-step)},
                              {turn_z(step), turn_z(-step)}};
        double J[3];
        for (int k = 0; k < 3; k++) {
            J[k] = remainder(heading_of(d33_mul(turned[k][0], R), axis) -
                                 heading_of(d33_mul(turned[k][1], R), axis),
                             2.0 * PI) /
                   (2.0 * step);
        }
        d3_t told = d3_of(h.jacobian), j = d3(J[0], J[1], J[2]);
        worst_note(&slope, d3_norm(d3_add(told, -1.0, j)), i);
        d33_t Pd = d33_of(insole_sym3_full(P));
        worst_note(&variance, fabs((double)h.variance_rad2 - d3_dot(j, d33_apply(Pd, j))), i);
    }
    ASSERT_WORST(slope, 1.0e-6 + 30.0 * EPS, "rad/rad");
    ASSERT_WORST(variance, 1.0e-4, "rad^2");
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("heading");
    suite_add(suite, "tilt", tilt_below_sixty_degrees_does_not_matter);
    suite_add(suite, "paper", yaw_of_the_paper_is_a_quarter_turn_less);
    suite_add(suite, "vertical", pitching_through_the_vertical_keeps_the_heading);
    suite_add(suite, "everywhere", every_attitude_has_a_heading);
    suite_add(suite, "jacobian", jacobian_and_variance_are_those_of_small_rotations);
    return suite;
}
