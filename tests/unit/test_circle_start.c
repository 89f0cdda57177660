/* SPDX-License-Identifier: MIT */
#include "insole/fuse/circle_start.h"

#include "near.h"
#include "plane.h"
#include "suite.h"

#define PI  3.14159265358979323846
#define EPS ((double)INSOLE_REAL_EPSILON)

enum { MOST = INSOLE_CIRCLE_START_MOST };

/* The printed sum, in double. */
static double total(const insole_circle_pair_t *pairs, int count, double x, double y)
{
    double sum = 0.0;
    for (int i = 0; i < count; i++) {
        point_t c = point_of(pairs[i].radio), w = point_of(pairs[i].way);
        sum += fabs(hypot(x - c.x, y - c.y) - hypot(w.x, w.y));
    }
    return sum;
}

/* Least sum on a grid of 25 cm over all circles, then of 1 cm about the best. */
static double least_on_grid(const insole_circle_pair_t *pairs, int count, double side)
{
    double least = 1.0e30, bx = 0.0, by = 0.0;
    for (double x = -side; x <= side; x += 0.25) {
        for (double y = -side; y <= side; y += 0.25) {
            double sum = total(pairs, count, x, y);
            if (sum < least) {
                least = sum;
                bx = x;
                by = y;
            }
        }
    }
    for (double x = bx - 0.3; x <= bx + 0.3; x += 0.01) {
        for (double y = by - 0.3; y <= by + 0.3; y += 0.01) {
            least = fmin(least, total(pairs, count, x, y));
        }
    }
    return least;
}

static insole_spot_t along(double length, double angle)
{
    return insole_spot((insole_real_t)(length * cos(angle)), (insole_real_t)(length * sin(angle)));
}

/* A walk with a bend from `begin`, seen without error. */
static void true_walk(insole_circle_pair_t *pairs, int count, insole_spot_t begin, double offset,
                      double bend)
{
    insole_spot_t way = {0, 0};
    for (int i = 0; i < count; i++) {
        insole_turn_t turn = {(insole_real_t)cos(offset), (insole_real_t)sin(offset)};
        pairs[i].way = way;
        pairs[i].radio = insole_spot_add(begin, insole_turn_way(turn, way));
        way = insole_spot_add(way, along(2.0, i * bend));
    }
}

START_TEST(circles_without_noise_meet_at_the_start)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 1u);
    worst_t off = {0.0, 0.0};
    for (int i = 0; i < 300; i++) {
        insole_circle_pair_t pairs[MOST];
        insole_spot_t begin = sample_spot(&rng, 50);
        int count = 1 + i % MOST;
        true_walk(pairs, count, begin, (double)sample_between(&rng, -3, 3),
                  (double)sample_between(&rng, -1, 1));
        worst_note(&off,
                   point_apart(point_of(begin), insole_circle_start_place(pairs, (uint32_t)count)),
                   i);
    }
    ASSERT_WORST(off, 0.003, "m");
}
END_TEST

/* Tangent circles along a straight walk: the one point where all touch. */
START_TEST(tangent_circles_touch_at_the_start)
{
    insole_circle_pair_t pairs[5];
    insole_spot_t begin = {3, -7};
    true_walk(pairs, 5, begin, 1.0, 0.0);
    insole_spot_t found = insole_circle_start_place(pairs, 5u);
    ASSERT_AT_MOST(point_apart(point_of(begin), found), 0.002, "m");
    ASSERT_AT_MOST(insole_circle_start_distance(pairs, 5u, found), 0.005, "m");
}
END_TEST

START_TEST(no_place_of_a_fine_grid_is_nearer_to_the_circles)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 2u);
    worst_t worse = {0.0, 0.0}, own = {0.0, 0.0};
    for (int i = 0; i < 150; i++) {
        insole_circle_pair_t pairs[MOST];
        int count = 2 + i % (MOST - 1);
        true_walk(pairs, count, insole_spot(0, 0), (double)sample_between(&rng, -3, 3), 0.3);
        for (int k = 0; k < count; k++) {
            pairs[k].radio = insole_spot_add(pairs[k].radio, sample_spot(&rng, 6));
        }
        insole_spot_t found = insole_circle_start_place(pairs, (uint32_t)count);
        point_t p = point_of(found);
        double sum = total(pairs, count, p.x, p.y);
        worst_note(&worse, sum - least_on_grid(pairs, count, 24.0), i);
        worst_note(&own,
                   fabs(sum - (double)insole_circle_start_distance(pairs, (uint32_t)count, found)),
                   i);
    }
    ASSERT_WORST(worse, 0.05, "m"); /* what the ties cost: a thousandth of the squares */
    ASSERT_WORST(own, 200.0 * EPS, "m");
}
END_TEST

START_TEST(of_equal_places_it_is_the_middle_one)
{
    insole_circle_pair_t apart[2] = {{{0, 0}, {0, 0}}, {{10, 0}, {2, 0}}};
    insole_spot_t found = insole_circle_start_place(apart, 2u);
    ASSERT_NEAR(found.x_m, 4.0, 0.01, "m"); /* anywhere on (0..8, 0) is as good */
    ASSERT_NEAR(found.y_m, 0.0, 0.05, "m");
    insole_circle_pair_t within[2] = {{{0, 0}, {10, 0}}, {{2, 0}, {1, 0}}};
    found = insole_circle_start_place(within, 2u);
    ASSERT_NEAR(total(within, 2, (double)found.x_m, (double)found.y_m), 7.0, 0.01, "m");
    insole_circle_pair_t swapped[2] = {within[1], within[0]};
    found = insole_circle_start_place(swapped, 2u);
    ASSERT_NEAR(total(within, 2, (double)found.x_m, (double)found.y_m), 7.0, 0.01, "m");
}
END_TEST

START_TEST(little_is_enough_for_an_answer)
{
    insole_circle_pair_t pairs[MOST + 2] = {{{0, 0}, {0, 0}}};
    insole_spot_t found = insole_circle_start_place(pairs, 0u);
    ASSERT_NEAR(found.x_m + found.y_m, 0.0, 0.0, "m");
    found = insole_circle_start_place(NULL, 3u);
    ASSERT_NEAR(found.x_m + found.y_m, 0.0, 0.0, "m");
    ASSERT_NEAR(insole_circle_start_direction(NULL, 3u, found), 0.0, 0.0, "rad");
    ASSERT_NEAR(insole_circle_start_distance(NULL, 3u, found), 0.0, 0.0, "m");
    for (int i = 0; i < MOST + 2; i++) { /* standing still, all fixes equal */
        pairs[i].radio = insole_spot(4, 5);
        pairs[i].way = insole_spot(0, 0);
    }
    found = insole_circle_start_place(pairs, MOST + 2u);
    ASSERT_AT_MOST(point_apart(point_of(pairs[0].radio), found), 0.002, "m");
    ASSERT_NEAR(insole_circle_start_direction(pairs, MOST + 2u, found), 0.0, 0.0, "rad");
    pairs[MOST].radio = insole_spot(1000, 0); /* beyond the most: not looked at */
    found = insole_circle_start_place(pairs, MOST + 2u);
    ASSERT_AT_MOST(point_apart(point_of(pairs[0].radio), found), 0.002, "m");
}
END_TEST

/* Walks in every direction, along y too, and both ways along the same line. */
START_TEST(a_straight_walk_tells_its_direction)
{
    worst_t off = {0.0, 0.0};
    for (int degrees = -180; degrees < 180; degrees += 15) {
        for (int other = -180; other < 180; other += 60) {
            insole_circle_pair_t pairs[5];
            double offset = degrees * PI / 180.0, heading = other * PI / 180.0;
            for (int i = 0; i < 5; i++) {
                pairs[i].way = along(2.0 * i, heading);
                pairs[i].radio =
                    insole_spot_add(insole_spot(20, 10), along(2.0 * i, heading + offset));
            }
            double found = (double)insole_circle_start_direction(pairs, 5u, pairs[0].radio);
            worst_note(&off, fabs(remainder(found - offset, 2.0 * PI)), degrees);
        }
    }
    ASSERT_WORST(off, 0.002, "rad");
}
END_TEST

/* No other angle within a right angle of the fixes' own brings the walk nearer to their line. */
START_TEST(no_other_turn_is_nearer_to_the_line)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 3u);
    worst_t worse = {0.0, 0.0}, behind = {0.0, 0.0};
    for (int i = 0; i < 200; i++) {
        insole_circle_pair_t pairs[5];
        insole_spot_t begin = sample_spot(&rng, 3);
        true_walk(pairs, 5, insole_spot(0, 0), (double)sample_between(&rng, -3, 3), 0.4);
        double mx = 0.0, my = 0.0, wx = 0.0, wy = 0.0;
        for (int k = 0; k < 5; k++) {
            pairs[k].radio = insole_spot_add(pairs[k].radio, sample_spot(&rng, 2));
            mx += (double)pairs[k].radio.x_m / 5.0;
            my += (double)pairs[k].radio.y_m / 5.0;
            wx += (double)pairs[k].way.x_m / 5.0;
            wy += (double)pairs[k].way.y_m / 5.0;
        }
        double best_scatter = -1.0, nx = 0.0, ny = 0.0; /* the line by all angles */
        for (int k = 0; k < 1800; k++) {
            double a = k * PI / 1800.0, sum = 0.0;
            for (int j = 0; j < 5; j++) {
                double x = (double)pairs[j].radio.x_m - mx, y = (double)pairs[j].radio.y_m - my;
                sum += pow(cos(a) * x + sin(a) * y, 2.0);
            }
            if (sum > best_scatter) {
                best_scatter = sum;
                nx = -sin(a);
                ny = cos(a);
            }
        }
        double found = (double)insole_circle_start_direction(pairs, 5u, begin), least = 1.0e30;
        double of_found = 0.0, forward = 0.0;
        for (int k = -1; k < 3600; k++) {
            double a = k < 0 ? found : k * PI / 1800.0, sum = 0.0, together = 0.0;
            for (int j = 0; j < 5; j++) {
                point_t w = point_of(pairs[j].way), r = point_of(pairs[j].radio);
                double x = cos(a) * w.x - sin(a) * w.y, y = sin(a) * w.x + cos(a) * w.y;
                sum += fabs(nx * (x + (double)begin.x_m - mx) + ny * (y + (double)begin.y_m - my));
                double cx = cos(a) * (w.x - wx) - sin(a) * (w.y - wy);
                double cy = sin(a) * (w.x - wx) + cos(a) * (w.y - wy);
                together += cx * (r.x - mx) + cy * (r.y - my);
            }
            of_found = k < 0 ? sum : of_found;
            forward = k < 0 ? together : forward;
            least = together > 0.0 ? fmin(least, sum) : least;
        }
        worst_note(&worse, of_found - least, i);
        worst_require(&behind, forward > -0.01, i);
    }
    ASSERT_WORST(worse, 0.06, "m"); /* a line a twentieth of a degree off, at 20 m in all */
    ASSERT_ALL_HELD(behind);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("circle_start");
    suite_add(suite, "exact", circles_without_noise_meet_at_the_start);
    suite_add(suite, "tangent", tangent_circles_touch_at_the_start);
    suite_add(suite, "grid", no_place_of_a_fine_grid_is_nearer_to_the_circles);
    suite_add(suite, "equal", of_equal_places_it_is_the_middle_one);
    suite_add(suite, "little", little_is_enough_for_an_answer);
    suite_add(suite, "straight", a_straight_walk_tells_its_direction);
    suite_add(suite, "turn", no_other_turn_is_nearer_to_the_line);
    return suite;
}
