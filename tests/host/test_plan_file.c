/* SPDX-License-Identifier: MIT */
#include "plan_file.h"

#include <math.h>

#include "files.h"
#include "line_reader.h"
#include "near.h"
#include "suite.h"

static plan_file_t plan;
static failure_t failure;

static void read_text(const char *text)
{
    bool is_good = plan_file_take(&plan, file_of(text), "plan", &failure);
    ck_assert_msg(is_good, "%s", failure.text);
}

static void expect_line(size_t i, insole_line_kind_t kind, unsigned long number, size_t points)
{
    ck_assert_uint_lt(i, plan.count);
    ck_assert_int_eq(plan.lines[i].kind, kind);
    ck_assert_uint_eq(plan.lines[i].number, number);
    ck_assert_uint_eq(plan.lines[i].count, points);
}

static void expect_point(size_t line, size_t i, double x_m, double y_m)
{
    ck_assert(plan.lines[line].points[i].x_m == x_m && plan.lines[line].points[i].y_m == y_m);
}

START_TEST(every_record_is_read_with_its_line)
{
    read_text("# a plan\n"
              "outline,0,0,10,0,10,5,0,5\n"
              "\n"
              "loss,12.5\n"
              "hole,1,1,2,1,1.5,2\n"
              "wall,4,5,0,5,-3.25\n"
              "wall,0,5,4,5,5,6,5\n");
    ck_assert_uint_eq(plan.count, 4u);
    expect_line(0u, INSOLE_LINE_OUTLINE, 2u, 4u);
    expect_line(1u, INSOLE_LINE_HOLE, 5u, 3u);
    expect_line(2u, INSOLE_LINE_WALL, 6u, 2u);
    expect_line(3u, INSOLE_LINE_WALL, 7u, 3u);
    expect_point(0u, 2u, 10.0, 5.0);
    expect_point(1u, 2u, 1.5, 2.0);
    expect_point(2u, 1u, 5.0, -3.25);
    expect_point(3u, 2u, 6.0, 5.0);
    ck_assert_str_eq(plan.name, "plan");
    plan_file_free(&plan);
}
END_TEST

START_TEST(a_loss_holds_for_the_rings_after_it)
{
    read_text("outline,0,0,9,0,9,9\nloss,8\nhole,1,1,2,1,2,2\nwall,3,0,0,1,1\nloss,0\n"
              "outline,5,5,6,5,6,6\n");
    ck_assert(isnan(plan.lines[0].loss_db));
    ck_assert(plan.lines[1].loss_db == 8.0);
    ck_assert(plan.lines[2].loss_db == 3.0);
    ck_assert(plan.lines[3].loss_db == 0.0);
    plan_file_free(&plan);
}
END_TEST

START_TEST(a_ring_may_end_where_it_begins)
{
    read_text("outline,0,0,10,0,10,5,0,0\nwall,1,0,0,3,0,0,0\n");
    expect_line(0u, INSOLE_LINE_OUTLINE, 1u, 3u);
    expect_line(1u, INSOLE_LINE_WALL, 2u, 3u); /* a wall may come back */
    plan_file_free(&plan);
}
END_TEST

START_TEST(pieces_go_from_point_to_point_and_rings_close)
{
    read_text("outline,0,0,10,0,10,5\nwall,1,0,0,3,0,3,4\n");
    ck_assert_uint_eq(plan_line_pieces(&plan.lines[0]), 3u);
    ck_assert_uint_eq(plan_line_pieces(&plan.lines[1]), 2u);
    ck_assert(plan_line_end(&plan.lines[0], 1u).y_m == 5.0);
    ck_assert(plan_line_end(&plan.lines[0], 2u).x_m == 0.0);
    ck_assert(plan_line_end(&plan.lines[1], 1u).y_m == 4.0);
    plan_file_free(&plan);
}
END_TEST

START_TEST(blanks_comments_and_commas_of_spreadsheets_mean_nothing)
{
    read_text("  # nothing\n,,,\n outline , 0 ,0, 10,0 ,10,5   # the hall\n"
              "wall,4,1,1,2,2,,,,,\nloss,4,,,\n");
    ck_assert_uint_eq(plan.count, 2u);
    expect_line(0u, INSOLE_LINE_OUTLINE, 3u, 3u);
    expect_line(1u, INSOLE_LINE_WALL, 4u, 2u);
    plan_file_free(&plan);
}
END_TEST

START_TEST(without_a_floor_all_is_floor_0)
{
    read_text("outline,0,0,10,0,10,5\n");
    ck_assert_uint_eq(plan.floor_count, 1u);
    ck_assert_int_eq(plan.floors[0].number, 0);
    ck_assert_str_eq(plan.floors[0].name, "");
    ck_assert_uint_eq(plan.floors[0].line, 0u);
    plan_file_free(&plan);
}
END_TEST

START_TEST(lines_belong_to_the_floor_opened_last)
{
    read_text("loss,3\nfloor,-1,-3.5,cellar\noutline,0,0,10,0,10,5\n"
              "floor,2,7\noutline,0,0,20,0,20,5\nwall,1,0,0,1,1\n");
    ck_assert_uint_eq(plan.floor_count, 2u);
    ck_assert_int_eq(plan.floors[0].number, -1);
    ck_assert(plan.floors[0].z_m == -3.5);
    ck_assert_str_eq(plan.floors[0].name, "cellar");
    ck_assert_uint_eq(plan.floors[0].line, 2u);
    ck_assert_int_eq(plan.floors[1].number, 2);
    ck_assert_str_eq(plan.floors[1].name, "");
    ck_assert_uint_eq(plan.lines[0].floor, 0u);
    ck_assert_uint_eq(plan.lines[1].floor, 1u);
    ck_assert_uint_eq(plan.lines[2].floor, 1u);
    plan_file_free(&plan);
}
END_TEST

START_TEST(lines_before_a_floor_are_floor_0)
{
    read_text("outline,0,0,10,0,10,5\nfloor,1,3,up\nwall,1,0,0,1,1\n");
    ck_assert_uint_eq(plan.floor_count, 2u);
    ck_assert_uint_eq(plan.lines[0].floor, 0u);
    ck_assert_uint_eq(plan.lines[1].floor, 1u);
    plan_file_free(&plan);
}
END_TEST

START_TEST(a_ring_may_have_more_points_than_a_table_columns)
{
    static char text[LINE_LIMIT];
    size_t length = (size_t)sprintf(text, "outline");
    for (int i = 0; i < 600; i++) {
        length += (size_t)sprintf(text + length, ",%d,%d", i, i * i % 97);
    }
    read_text(text);
    expect_line(0u, INSOLE_LINE_OUTLINE, 1u, 600u);
    expect_point(0u, 599u, 599.0, 599 * 599 % 97);
    plan_file_free(&plan);
}
END_TEST

/* ---- malformed -------------------------------------------------------------------------- */

static const struct {
    const char *text, *message;
} malformed[] = {
    {"", "plan: the plan is empty: expected an outline or a wall"},
    {"# only this\nloss,3\n", "plan: the plan is empty: expected an outline or a wall"},
    {"floor,1,0,ground\n", "plan: the plan is empty: expected an outline or a wall"},
    {"room,0,0,1,1\n",
     "plan:1: \"room\" is no part of a plan: expected outline, hole, wall, loss or floor"},
    {"outlin,0,0,1,0,1,1\n",
     "plan:1: \"outlin\" is no part of a plan: expected outline, hole, wall, loss or floor "
     "(outline?)"},
    {"Wall,1,0,0,1,1\n",
     "plan:1: \"Wall\" is no part of a plan: expected outline, hole, wall, loss or floor (wall?)"},
    {"0,0,1,0,1,1\n",
     "plan:1: \"0\" is no part of a plan: expected outline, hole, wall, loss or floor"},
    {"outline\n", "plan:1: outline of 0 points: expected at least 3, outline,x,y,x,y,..."},
    {"outline,1,2\n", "plan:1: outline of 1 point: expected at least 3, outline,x,y,x,y,..."},
    {"# x\n\noutline,0,0,10,0\n",
     "plan:3: outline of 2 points: expected at least 3, outline,x,y,x,y,..."},
    {"hole,0,0,10,0,0,0\n", "plan:1: hole of 2 points: expected at least 3, hole,x,y,x,y,..."},
    {"outline,0,0,10,0,10\n", "plan:1: the last point has no y: expected outline,x,y,x,y,..."},
    {"hole,0,0,10,0,10,5,3\n", "plan:1: the last point has no y: expected hole,x,y,x,y,..."},
    {"outline,0,0,ten,0,10,5\n", "plan:1: x \"ten\" is not a number: expected outline,x,y,x,y,..."},
    {"outline,0,0,10,,10,5\n", "plan:1: y \"\" is not a number: expected outline,x,y,x,y,..."},
    {"outline,0,0,10,nan,10,5\n",
     "plan:1: y \"nan\" is not a number: expected outline,x,y,x,y,..."},
    {"outline,0 0,10 0,10 5\n", "plan:1: x \"0 0\" is not a number: expected outline,x,y,x,y,..."},
    {"outline;0;0;10;0\n",
     "plan:1: \"outline;0;0;10;0\" is no part of a plan: expected outline, hole, wall, loss or "
     "floor"},
    {"outline,0,0,100001,0,10,5\n", "plan:1: x 100001 is out of range: expected -100000 to 100000"},
    {"outline,0,0,1,-1e9,10,5\n", "plan:1: y -1e9 is out of range: expected -100000 to 100000"},
    {"wall\n", "plan:1: too few fields: expected wall,loss_db,x,y,x,y,..."},
    {"wall,4\n", "plan:1: wall of 0 points: expected at least 2, wall,loss_db,x,y,x,y,..."},
    {"wall,4,1,1\n", "plan:1: wall of 1 point: expected at least 2, wall,loss_db,x,y,x,y,..."},
    {"wall,1,1,2,2\n", "plan:1: the last point has no y: expected wall,loss_db,x,y,x,y,..."},
    {"wall,,1,1,2,2\n", "plan:1: loss \"\" is not a number: expected wall,loss_db,x,y,x,y,..."},
    {"wall,concrete,1,1,2,2\n",
     "plan:1: loss \"concrete\" is not a number: expected wall,loss_db,x,y,x,y,..."},
    {"wall,-3,1,1,2,2\n", "plan:1: loss -3 is out of range: expected 0 to 200"},
    {"wall,201,1,1,2,2\n", "plan:1: loss 201 is out of range: expected 0 to 200"},
    {"loss\n", "plan:1: too few fields: expected loss,dB"},
    {"loss,much\n", "plan:1: loss \"much\" is not a number: expected loss,dB"},
    {"loss,4,5\n", "plan:1: too many fields: expected loss,dB"},
    {"loss,1e3\n", "plan:1: loss 1e3 is out of range: expected 0 to 200"},
    {"floor\n", "plan:1: too few fields: expected floor,number,z,name"},
    {"floor,1\n", "plan:1: too few fields: expected floor,number,z,name"},
    {"floor,1,0,a,b\n", "plan:1: too many fields: expected floor,number,z,name"},
    {"floor,1.5,0,a\n",
     "plan:1: number is not a whole number from -1000 to 1000: expected floor,number,z,name"},
    {"floor,ground,0,a\n",
     "plan:1: number is not a whole number from -1000 to 1000: expected floor,number,z,name"},
    {"floor,1,high,a\n", "plan:1: z \"high\" is not a number: expected floor,number,z,name"},
    {"floor,1,20000,a\n", "plan:1: z 20000 is out of range: expected -10000 to 10000"},
    {"floor,1,0,a\noutline,0,0,1,0,1,1\nfloor,1,3,b\n",
     "plan:3: floor 1 comes twice: expected each floor once"},
    {"outline,0,0,1,0,1,1\nfloor,0,3,b\n", "plan:2: floor 0 comes twice: expected each floor once"},
    {"outline,0,0,1,0,1,1\nwall,1,\x1b[2J,0,1,1\n",
     "plan:2: x \"?[2J\" is not a number: expected wall,loss_db,x,y,x,y,..."},
};

START_TEST(malformed_lines_are_told_with_file_line_and_what_was_expected)
{
    ck_assert(!plan_file_take(&plan, file_of(malformed[_i].text), "plan", &failure));
    ck_assert_int_eq(failure.exit_code, EXIT_BAD_INPUT);
    ck_assert_str_eq(failure.text, malformed[_i].message);
    ck_assert_ptr_null(plan.lines);
    ck_assert_ptr_null(plan.floors);
    ck_assert_ptr_null(plan.name);
}
END_TEST

START_TEST(files_that_cannot_be_read_are_told)
{
    ck_assert(!plan_file_read(&plan, scratch("absent.csv"), &failure));
    ck_assert_ptr_nonnull(strstr(failure.text, "absent.csv: cannot open: No such file"));
    ck_assert(!plan_file_read(&plan, SCRATCH, &failure));
    ck_assert_str_eq(failure.text, SCRATCH ": is a folder: expected a file");
    ck_assert(!plan_file_take(&plan, file_of_bytes("wall,1\0,2", 9u), "plan", &failure));
    ck_assert_str_eq(failure.text, "plan:1: NUL byte: expected plain text");
}
END_TEST

START_TEST(a_file_is_read_by_its_path)
{
    const char *path = scratch_file("plan.csv", "outline,0,0,10,0,10,5\r\nwall,2,0,0,1,1\r\n");
    ck_assert(plan_file_read(&plan, path, &failure));
    ck_assert_uint_eq(plan.count, 2u);
    ck_assert_str_eq(plan.name, path);
    plan_file_free(&plan);
    plan_file_free(&plan);
}
END_TEST

#define ROWS(table) ((int)(sizeof table / sizeof table[0]))

Suite *insole_suite(void)
{
    Suite *suite = suite_create("plan_file");
    suite_add(suite, "records", every_record_is_read_with_its_line);
    suite_add(suite, "loss", a_loss_holds_for_the_rings_after_it);
    suite_add(suite, "closed rings", a_ring_may_end_where_it_begins);
    suite_add(suite, "pieces", pieces_go_from_point_to_point_and_rings_close);
    suite_add(suite, "blanks", blanks_comments_and_commas_of_spreadsheets_mean_nothing);
    suite_add(suite, "no floor", without_a_floor_all_is_floor_0);
    suite_add(suite, "floors", lines_belong_to_the_floor_opened_last);
    suite_add(suite, "lines before a floor", lines_before_a_floor_are_floor_0);
    suite_add(suite, "many points", a_ring_may_have_more_points_than_a_table_columns);
    suite_add_loop(suite, "malformed",
                   malformed_lines_are_told_with_file_line_and_what_was_expected, ROWS(malformed));
    suite_add(suite, "unreadable", files_that_cannot_be_read_are_told);
    suite_add(suite, "path", a_file_is_read_by_its_path);
    return suite;
}
