/* SPDX-License-Identifier: MIT */
#include "insole/fuse/step_ekf.h"

#include "filter_calls.h"
#include "near.h"
#include "plane.h"
#include "suite.h"

#define EPS ((double)INSOLE_REAL_EPSILON)

static point_t way(double heading, double length)
{
    point_t p = {length * cos(heading), length * sin(heading)};
    return p;
}

static insole_pace_t some_pace(insole_rng_t *rng)
{
    insole_pace_t pace = {sample_between(rng, 0, 2), sample_between(rng, -4, 4),
                          sample_between(rng, 0, INSOLE_R(0.1)),
                          sample_between(rng, 0, INSOLE_R(0.5))};
    return pace;
}

/* F P F' with F by differences, in double. */
START_TEST(the_covariance_is_that_of_the_jacobian)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 1u);
    worst_t mean = {0.0, 0.0}, covariance = {0.0, 0.0};
    for (int i = 0; i < 2000; i++) {
        insole_pace_t pace = some_pace(&rng);
        double psi = (double)pace.heading_rad, d = (double)pace.length_m, h = 1.0e-6;
        point_t up = way(psi + h, d), down = way(psi - h, d);
        point_t longer = way(psi, d + h), shorter = way(psi, d - h);
        plane_t F = {(up.x - down.x) / (2 * h), (longer.x - shorter.x) / (2 * h),
                     (up.y - down.y) / (2 * h), (longer.y - shorter.y) / (2 * h)};
        plane_t P = {(double)pace.var_heading_rad2, 0.0, 0.0, (double)pace.var_length_m2};
        insole_step_way_t found = insole_step_ekf(&pace);
        worst_note(&mean, point_apart(way(psi, d), found.mean), i);
        worst_note(&covariance,
                   plane_apart(plane_mul(F, plane_mul(P, plane_transpose(F))), found.Q), i);
    }
    ASSERT_WORST(mean, 8.0 * EPS, "m");
    ASSERT_WORST(covariance, 16.0 * EPS + 1.0e-9, "m^2");
}
END_TEST

/* Printed (29)-(30): yaw and axis both from +y, their difference from the map's x. */
START_TEST(the_paper_s_way_is_ours)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 2u);
    worst_t off = {0.0, 0.0};
    for (int i = 0; i < 1000; i++) {
        insole_pace_t pace = some_pace(&rng);
        double quarter = 0.5 * 3.14159265358979323846, axis = (double)sample_between(&rng, -3, 3);
        double psi = (double)pace.heading_rad - quarter, psi_axis = axis - quarter;
        double d = (double)pace.length_m;
        point_t printed = {d * (cos(psi) * cos(psi_axis) + sin(psi) * sin(psi_axis)),
                           d * (sin(psi) * cos(psi_axis) - sin(psi_axis) * cos(psi))};
        insole_pace_t in_m = pace;
        in_m.heading_rad = (insole_real_t)((double)pace.heading_rad - axis);
        worst_note(&off, point_apart(printed, insole_step_ekf(&in_m).mean), i);
    }
    ASSERT_WORST(off, 16.0 * EPS, "m");
}
END_TEST

START_TEST(an_unknown_heading_is_no_worse_than_none)
{
    insole_pace_t pace = {1, 0, 0, INSOLE_R(1e20)};
    insole_step_way_t found = insole_step_ekf(&pace);
    ASSERT_NEAR(found.Q.yy, 3.2898681, 1.0e-6, "m^2");
    ASSERT_NEAR(found.Q.xx, 0.0, 0.0, "m^2");
    pace.length_m = 0;
    found = insole_step_ekf(&pace);
    ASSERT_NEAR(found.Q.xx + found.Q.yy + found.mean.x_m + found.mean.y_m, 0.0, 0.0, "");
}
END_TEST

/* The table's step is this method, not another one. */
START_TEST(the_table_steps_by_it)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 6u);
    insole_pace_t pace = some_pace(&rng);
    insole_step_way_t way = insole_step_ekf(&pace);
    check_filter_steps_by(&insole_step_ekf_calls, &pace, &way);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("step_ekf");
    suite_add(suite, "covariance", the_covariance_is_that_of_the_jacobian);
    suite_add(suite, "paper", the_paper_s_way_is_ours);
    suite_add(suite, "unknown", an_unknown_heading_is_no_worse_than_none);
    suite_add(suite, "table", the_table_steps_by_it);
    return suite;
}
