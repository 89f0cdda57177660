/* SPDX-License-Identifier: MIT */
#include "plan_parts.h"

#include <math.h>

#include "files.h"
#include "near.h"
#include "site.h"
#include "suite.h"

static site_t site;
static plan_parts_t parts;
static failure_t failure;

static void find(const char *text)
{
    const char *path = scratch_file("plan.csv", text);
    ck_assert_msg(site_open_sketch(&site, path, NULL, &insole_propagation_defaults, &failure), "%s",
                  failure.text);
    plan_parts_find(&parts, &site.plan);
}

static void done(void)
{
    plan_parts_free(&parts);
    site_free(&site);
}

START_TEST(an_open_room_is_one_part)
{
    find("outline,0,0,10,0,10,5,0,5\n");
    ck_assert(parts.is_searched);
    ck_assert_uint_eq(parts.count, 1u);
    ASSERT_NEAR(parts.walkable_m2, 50.0, 1.5, "m^2");
    ASSERT_NEAR(parts.parts[0].area_m2, 9.6 * 4.6, 1.5, "m^2");
    ASSERT_NEAR(parts.parts[0].place.x_m, 5.0, 0.1, "m");
    ASSERT_NEAR(parts.parts[0].place.y_m, 2.5, 0.1, "m");
    done();
}
END_TEST

START_TEST(holes_are_not_walked_on)
{
    find("outline,0,0,10,0,10,5,0,5\nhole,4,1,6,1,6,4,4,4\n");
    ASSERT_NEAR(parts.walkable_m2, 44.0, 1.5, "m^2");
    ck_assert_uint_eq(parts.count, 1u);
    /* The middle lies in the hole; the part's place does not. */
    ck_assert(insole_floor_plan_inside(&site.plan, (insole_real_t)parts.parts[0].place.x_m,
                                       (insole_real_t)parts.parts[0].place.y_m));
    done();
}
END_TEST

START_TEST(a_closed_room_is_a_part_of_its_own)
{
    find("outline,0,0,20,0,20,10,0,10\nwall,5,15,0,15,10\n");
    ck_assert_uint_eq(parts.count, 2u);
    ASSERT_NEAR(parts.parts[0].area_m2, 14.6 * 9.6, 4.0, "m^2");
    ASSERT_NEAR(parts.parts[1].area_m2, 4.6 * 9.6, 2.0, "m^2");
    ASSERT_NEAR(parts.parts[1].place.x_m, 17.5, 0.1, "m");
    ASSERT_NEAR(parts.parts[1].place.y_m, 5.0, 0.1, "m");
    done();
}
END_TEST

/* A wall right through a square hall, at any angle, with a gap in its middle. */
static void find_with_gap(double gap_m, double angle_rad)
{
    char text[400];
    double c = cos(angle_rad), s = sin(angle_rad), h = 0.5 * gap_m, l = 9.0;
    snprintf(
        text, sizeof text,
        "outline,-6,-6,6,-6,6,6,-6,6\nwall,5,%.4f,%.4f,%.4f,%.4f\nwall,5,%.4f,%.4f,%.4f,%.4f\n",
        -l * c, -l * s, -h * c, -h * s, h * c, h * s, l * c, l * s);
    find(text);
}

START_TEST(doors_are_found_at_any_angle)
{
    for (int i = 0; i < 16; i++) {
        find_with_gap(PLAN_PARTS_DOOR_M, 0.2 * i + 0.013);
        ck_assert_msg(parts.count == 1u, "%u parts at angle %d", (unsigned)parts.count, i);
        done();
    }
}
END_TEST

START_TEST(cracks_are_no_doors)
{
    for (int i = 0; i < 16; i++) {
        find_with_gap(PLAN_PARTS_CRACK_M, 0.2 * i + 0.013);
        ck_assert_msg(parts.count == 2u, "%u parts at angle %d", (unsigned)parts.count, i);
        done();
    }
}
END_TEST

START_TEST(nooks_are_left_out)
{
    find("outline,0,0,10,0,10,5,0,5\nwall,1,0,1,1.3,1,1.3,0\n"); /* 0.9 x 0.6 m */
    ck_assert_uint_eq(parts.count, 1u);
    done();
}
END_TEST

START_TEST(parts_come_by_falling_area)
{
    find("outline,0,0,3,0,3,3,0,3\noutline,10,0,20,0,20,9,10,9\noutline,30,0,35,0,35,5,30,5\n");
    ck_assert_uint_eq(parts.count, 3u);
    ASSERT_NEAR(parts.parts[0].place.x_m, 15.0, 0.1, "m");
    ASSERT_NEAR(parts.parts[1].place.x_m, 32.5, 0.1, "m");
    ASSERT_NEAR(parts.parts[2].place.x_m, 1.5, 0.1, "m");
    done();
}
END_TEST

START_TEST(without_an_outline_nobody_walks)
{
    find("wall,1,0,0,10,10\n");
    ck_assert(parts.walkable_m2 == 0.0);
    ck_assert_uint_eq(parts.count, 0u);
    done();
}
END_TEST

START_TEST(a_vast_plan_is_measured_but_not_searched)
{
    find("outline,0,0,1500,0,1500,1500,0,1500\n");
    ck_assert(!parts.is_searched);
    ck_assert_uint_eq(parts.count, 0u);
    ASSERT_NEAR(parts.walkable_m2, 2250000.0, 22500.0, "m^2");
    done();
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("plan_parts");
    suite_add(suite, "open", an_open_room_is_one_part);
    suite_add(suite, "holes", holes_are_not_walked_on);
    suite_add(suite, "closed", a_closed_room_is_a_part_of_its_own);
    suite_add(suite, "doors", doors_are_found_at_any_angle);
    suite_add(suite, "narrow", cracks_are_no_doors);
    suite_add(suite, "nooks", nooks_are_left_out);
    suite_add(suite, "order", parts_come_by_falling_area);
    suite_add(suite, "no outline", without_an_outline_nobody_walks);
    suite_add(suite, "vast", a_vast_plan_is_measured_but_not_searched);
    return suite;
}
