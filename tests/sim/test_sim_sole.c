/* SPDX-License-Identifier: MIT */
#include "sim/sole.h"

#include "near.h"
#include "sim/algebra.h"
#include "suite.h"

static const double soles[][3] = {{0.05, 0.15, 0.07}, {0.10, 0.10, 0.30}, {0.02, 0.20, 0.02}};
enum { SOLES = sizeof soles / sizeof soles[0], POINTS = 4001 };

static sim_sole_t sole_of(int row)
{
    return sim_sole(soles[row][0], soles[row][1], soles[row][2]);
}

/* The outline by brute force: in foot axes the contact moves by -radius (cos, -sin) dpitch. */
typedef struct {
    double pitch, x, z, rolled;
} point_t;

static double radius_at(int row, double pitch)
{
    double soft = soles[row][2], R = (soles[row][0] + soles[row][1]) / soft;
    return fabs(pitch) < soft ? 0.5 * R * (1.0 + cos(SIM_PI * pitch / soft)) : 0.0;
}

static void trace(int row, double to_pitch, point_t *points)
{
    int parts = POINTS - 1;
    double step = to_pitch / parts;
    point_t at = {0.0, 0.5 * (soles[row][1] - soles[row][0]), 0.0, 0.0};
    points[0] = at;
    for (int i = 0; i < parts; i++) {
        double middle = (i + 0.5) * step, arc = radius_at(row, middle) * step;
        at.pitch += step;
        at.x -= arc * cos(middle);
        at.z += arc * sin(middle);
        at.rolled += arc;
        points[i + 1] = at;
    }
}

static const double pitches[] = {-1.2, -0.5, -0.1, -0.03, 0.02, 0.06, 0.25, 0.6};

START_TEST(the_lowest_point_of_the_outline_touches_the_ground)
{
    static point_t up[POINTS], down[POINTS];
    sim_sole_t sole = sole_of(_i);
    trace(_i, soles[_i][2], up);
    trace(_i, -soles[_i][2], down);
    for (size_t k = 0; k < sizeof pitches / sizeof pitches[0]; k++) {
        double s = sin(pitches[k]), c = cos(pitches[k]), lowest = HUGE_VAL;
        for (int i = 0; i < POINTS; i++) {
            lowest = fmin(lowest, fmin(up[i].x * s + up[i].z * c, down[i].x * s + down[i].z * c));
        }
        ASSERT_NEAR(sim_sole_height(&sole, pitches[k]), -lowest, 2e-7, "m");
    }
}
END_TEST

START_TEST(the_sole_rolls_without_slipping)
{
    static point_t points[POINTS];
    sim_sole_t sole = sole_of(_i);
    for (int side = -1; side <= 1; side += 2) {
        trace(_i, 0.5 * side, points);
        for (int i = 0; i < POINTS; i += 100) {
            const point_t *p = &points[i];
            double ahead = p->x * cos(p->pitch) - p->z * sin(p->pitch);
            double contact = sim_sole_advance(&sole, p->pitch) + ahead;
            ASSERT_NEAR(contact, 0.5 * (soles[_i][1] - soles[_i][0]) - p->rolled, 2e-6, "m");
        }
    }
}
END_TEST

START_TEST(it_rolls_from_heel_to_ball)
{
    static point_t points[POINTS];
    trace(_i, soles[_i][2], points);
    ASSERT_NEAR(points[POINTS - 1].rolled, 0.5 * (soles[_i][0] + soles[_i][1]), 1e-7, "m");
    /* from there on the edge is a point: as far from the origin as it was told, nearly */
    sim_sole_t sole = sole_of(_i);
    double h = sim_sole_height(&sole, 0.5 * SIM_PI), b = sim_sole_height(&sole, -0.5 * SIM_PI);
    ASSERT_NEAR(h, soles[_i][0], 0.01 * soles[_i][2] + 1e-3, "m");
    ASSERT_NEAR(b, soles[_i][1], 0.01 * soles[_i][2] + 1e-3, "m");
}
END_TEST

START_TEST(a_flat_foot_stands_in_its_place)
{
    sim_sole_t sole = sole_of(_i);
    ASSERT_NEAR(sim_sole_height(&sole, 0.0), 0.0, 1e-15, "m");
    ASSERT_NEAR(sim_sole_advance(&sole, 0.0), 0.0, 1e-15, "m");
}
END_TEST

START_TEST(height_and_advance_are_smooth_where_the_rocker_ends)
{
    sim_sole_t sole = sole_of(_i);
    double h = 1e-4;
    for (int side = -1; side <= 1; side += 2) {
        double at = side * soles[_i][2];
        double z[5];
        for (int k = 0; k < 5; k++) {
            z[k] = sim_sole_height(&sole, at + (k - 2) * h);
        }
        double left = (z[2] - 2.0 * z[1] + z[0]) / (h * h);
        double right = (z[4] - 2.0 * z[3] + z[2]) / (h * h);
        /* the radius falls to zero with a rate of at most k R / 2 */
        double rate = 0.5 * SIM_PI * (soles[_i][0] + soles[_i][1]) / (soles[_i][2] * soles[_i][2]);
        ASSERT_NEAR(left, right, 2.0 * h * rate + 1e-3, "m");
        double before = sim_sole_advance(&sole, at - h), after = sim_sole_advance(&sole, at + h);
        ASSERT_NEAR((after - before) / (2.0 * h), -z[2], 1e-6, "m");
    }
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("sim/sole");
    suite_add_loop(suite, "contact", the_lowest_point_of_the_outline_touches_the_ground, SOLES);
    suite_add_loop(suite, "no slip", the_sole_rolls_without_slipping, SOLES);
    suite_add_loop(suite, "heel to ball", it_rolls_from_heel_to_ball, SOLES);
    suite_add_loop(suite, "flat", a_flat_foot_stands_in_its_place, SOLES);
    suite_add_loop(suite, "smooth", height_and_advance_are_smooth_where_the_rocker_ends, SOLES);
    return suite;
}
