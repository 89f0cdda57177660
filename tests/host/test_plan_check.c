/* SPDX-License-Identifier: MIT */
#include "plan_check.h"

#include "files.h"
#include "suite.h"

static failure_t failure;

/* What check finds, as it is printed. */
static const char *check_files(const char *plan_path, const char *aps_path, size_t *errors)
{
    static site_t site;
    findings_t findings;
    plan_parts_t parts;
    FILE *file = tmpfile();
    memset(&findings, 0, sizeof findings);
    ck_assert_msg(
        site_open_sketch(&site, plan_path, aps_path, &insole_propagation_defaults, &failure), "%s",
        failure.text);
    plan_parts_find(&parts, &site.plan);
    plan_check(&findings, &site, &parts);
    findings_print(&findings, file, "plan", "aps");
    *errors = findings.errors;
    findings_free(&findings);
    plan_parts_free(&parts);
    site_free(&site);
    return text_of(file);
}

static const char *check_text(const char *plan, const char *aps, size_t *errors)
{
    return check_files(scratch_file("plan.csv", plan),
                       aps == NULL ? NULL : scratch_file("aps.csv", aps), errors);
}

#define HALL "outline,0,0,20,0,20,10,0,10\n"

static const struct {
    const char *plan, *aps, *findings;
} cases[] = {
    /* what is fine */
    {HALL, NULL, ""},
    {"outline,0,0,20,0,20,10,0,10,0,0\n", NULL, ""},
    {HALL "wall,5,10,0,10,4\nwall,5,10,5.2,10,10\nhole,4,4,6,4,6,6\n", "id,x,y\na,1,1\n", ""},
    {HALL "wall,5,5,5,8,5\nwall,5,8,5,11,5\nwall,5,8,5,8,7\n", NULL, ""}, /* ends meet */
    {"outline,-300.5,0,0,0,0,200\n", NULL, ""},
    /* rings */
    {"outline,0,0,20,0,0,10,20,10\n", NULL,
     "plan:1: error: outline crosses itself near 10.00,5.00: expected corners in their order "
     "around it\n"},
    {HALL "hole,4,4,8,4,8,8,6,3,4,8\n", NULL,
     "plan:2: error: hole crosses itself near 6.40,4.00: expected corners in their order around "
     "it\n"},
    {HALL "hole,4,4,5,5,6,6\n", NULL,
     "plan:2: error: hole around 0 m^2: expected at least 0.01 m^2\n"
     "plan:2: warning: hole runs along the hole of line 2 near 4.50,4.50: radio counts both\n"},
    {HALL "hole,4,4,4,4,4,4,4,4\n", NULL,
     "plan:2: error: hole of no length at 4.00,4.00: expected points that differ\n"},
    {HALL "hole,4,4,4,4,6,4,6,6\n", NULL,
     "plan:2: warning: the point 4.00,4.00 comes twice in a row\n"},
    /* walls */
    {HALL "wall,5,3,3,3,3\n", NULL,
     "plan:2: error: wall of no length at 3.00,3.00: expected points that differ\n"},
    {HALL "\n\nwall,5,3,3,3,3,3,5\n", NULL,
     "plan:4: warning: the point 3.00,3.00 comes twice in a row\n"},
    {HALL "wall,5,15,5,24.5,5\n", NULL,
     "plan:2: warning: wall reaches 4.5 m outside the outline, to 24.50,5.00\n"},
    {HALL "wall,5,15,5,20.05,5\n", NULL, ""},
    {HALL "wall,5,5,5,9,5\nwall,3,6,5.02,12,5.02\n", NULL,
     "plan:3: warning: wall runs along the wall of line 2 near 7.50,5.00: radio counts both\n"},
    {HALL "wall,5,5,5,9,5\nwall,3,6,5.1,12,5.1\n", NULL, ""},
    {HALL "wall,5,0,2,0,6\n", NULL,
     "plan:2: warning: wall runs along the outline of line 1 near 0.00,4.00: radio counts both\n"},
    {HALL "wall,5,5,5,9,5,9,7,9,5,11,5\n", NULL,
     "plan:2: warning: wall runs along the wall of line 2 near 9.00,6.00: radio counts both\n"},
    /* holes and rooms */
    {HALL "hole,30,1,31,1,31,2\n", NULL,
     "plan:2: warning: hole outside the outline, near 30.00,1.00\n"},
    {HALL "hole,18,4,22,4,22,6,18,6\n", NULL, ""},
    {HALL "wall,5,15,0,15,10\n", NULL,
     "plan:2: warning: closed room: 44 m^2 around 17.4,5.1 cannot be reached: expected a gap of "
     "0.7 m or more\n"},
    {HALL "wall,5,15,0,15,4.8\nwall,5,15,5.1,15,10\n", NULL,
     "plan:2: warning: closed room: 44 m^2 around 17.4,5.0 cannot be reached: expected a gap of "
     "0.7 m or more\n"},
    {HALL "hole,-1,-1,21,-1,21,11,-1,11\n", NULL,
     "plan: error: nowhere to walk: expected an outline that is not all holes\n"},
    {"outline,0,0,20,0,20,0.3,0,0.3\n", NULL,
     "plan: warning: too narrow to walk: nowhere are 0.4 m free\n"},
    /* the whole */
    {"wall,5,0,0,10,0\n", NULL,
     "plan: error: no outline: expected a ring around where one can walk\n"},
    {"outline,0,0,2500,0,2500,100\n", NULL,
     "plan: error: the building is 2500 x 100 m: expected at most 2000 m; are these pixels or "
     "millimetres?\n"},
    {"outline,0,0,1.5,0,1.5,1.2,0,1.2\n", NULL,
     "plan: error: the building is 1.5 x 1.2 m: expected at least 2 m; are these kilometres?\n"},
    {"outline,-3.71234,40.41678,-3.71204,40.41678,-3.71204,40.41698\n", NULL,
     "plan: error: 0.0003 x 0.0002 m at -3.71234,40.4168: these look like degrees: expected "
     "metres from a corner of the building\n"},
    {"outline,10,10,810,10,810,610,10,610\nwall,4,100,10,100,400\n", NULL,
     "plan: warning: whole numbers up to 800 m: are these pixels?\n"
     "plan: warning: too large to look for closed rooms\n"},
    {"outline,0,0,1500.5,0,1500,1500,0,1500\n", NULL,
     "plan: warning: too large to look for closed rooms\n"},
    {"floor,1,0,a\n" HALL "floor,2,3,b\noutline,0,0,30,0,30,30,0,30\nwall,1,25,20,25,29\n", NULL,
     "plan:3: warning: 2 floors: only the first, 1, is used\n"},
    /* access points */
    {HALL, "id,x,y\na,1,1\nb,20.9,5\nc,25,5\n",
     "aps:4: warning: c lies 5.0 m outside the outline, at 25.00,5.00\n"},
};

/* The crossing of two pieces of a ring leaves more to be found: only that is looked at here. */
START_TEST(what_is_wrong_is_told_with_its_line)
{
    size_t errors;
    const char *found = check_text(cases[_i].plan, cases[_i].aps, &errors);
    ck_assert_uint_eq(errors, (size_t)count_of(found, ": error: "));
    if (strstr(cases[_i].findings, "crosses itself") != NULL) {
        ck_assert_msg(strstr(found, cases[_i].findings) != NULL, "%s", found);
    } else {
        ck_assert_str_eq(found, cases[_i].findings);
    }
}
END_TEST

START_TEST(findings_come_in_the_order_of_the_lines)
{
    size_t errors;
    ck_assert_str_eq(
        check_text(HALL "wall,5,15,0,15,10\nhole,30,1,31,1,31,2\nwall,5,3,3,3,3\n",
                   "id,x,y\na,-5,1\n", &errors),
        "plan:2: warning: closed room: 44 m^2 around 17.4,5.1 cannot be reached: expected a gap "
        "of 0.7 m or more\n"
        "plan:3: warning: hole outside the outline, near 30.00,1.00\n"
        "plan:4: error: wall of no length at 3.00,3.00: expected points that differ\n"
        "aps:2: warning: a lies 5.0 m outside the outline, at -5.00,1.00\n");
    ck_assert_uint_eq(errors, 1u);
}
END_TEST

START_TEST(many_doubled_walls_are_summed_up)
{
    static char text[4000];
    size_t errors, length = (size_t)sprintf(text, HALL);
    for (int i = 0; i < 9; i++) {
        length += (size_t)sprintf(text + length, "wall,5,%d,3,%d,5\nwall,5,%d,3,%d,5\n", i + 2,
                                  i + 2, i + 2, i + 2);
    }
    const char *found = check_text(text, NULL, &errors);
    ck_assert_int_eq(count_of(found, "radio counts both"), 5);
    ck_assert_ptr_nonnull(strstr(found, "plan: warning: 4 more lines run along others\n"));
    ck_assert_uint_eq(errors, 0u);
}
END_TEST

START_TEST(the_maps_are_flawless)
{
    static const char *const maps[] = {"demo", "exhibition_hall", "office", "student_centre"};
    for (size_t i = 0u; i < sizeof maps / sizeof maps[0]; i++) {
        char plan[512], aps[512];
        size_t errors;
        snprintf(plan, sizeof plan, "%s/%s/plan.csv", MAPS, maps[i]);
        snprintf(aps, sizeof aps, "%s/%s/aps.csv", MAPS, maps[i]);
        ck_assert_str_eq(check_files(plan, aps, &errors), "");
    }
}
END_TEST

START_TEST(the_box_holds_the_first_floor)
{
    plan_file_t plan;
    ck_assert(plan_file_take(&plan,
                             file_of("outline,-2,1,5,1,5,9\nwall,1,0,0,7,3\nfloor,5,3\n"
                                     "wall,1,50,50,60,60\n"),
                             "plan", &failure));
    plan_box_t box = plan_box(&plan);
    ck_assert(box.low.x_m == -2.0 && box.low.y_m == 0.0);
    ck_assert(box.high.x_m == 7.0 && box.high.y_m == 9.0);
    plan_file_free(&plan);
}
END_TEST

#define ROWS(table) ((int)(sizeof table / sizeof table[0]))

Suite *insole_suite(void)
{
    Suite *suite = suite_create("plan_check");
    suite_add_loop(suite, "findings", what_is_wrong_is_told_with_its_line, ROWS(cases));
    suite_add(suite, "order", findings_come_in_the_order_of_the_lines);
    suite_add(suite, "doubled", many_doubled_walls_are_summed_up);
    suite_add(suite, "maps", the_maps_are_flawless);
    suite_add(suite, "box", the_box_holds_the_first_floor);
    return suite;
}
