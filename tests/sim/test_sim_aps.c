/* SPDX-License-Identifier: MIT */
#include "sim/aps.h"

#include <math.h>

#include "buildings.h"
#include "near.h"
#include "suite.h"

static const sim_ap_t *ap_at(const sim_list_t *aps, size_t number)
{
    const sim_ap_t *ap = sim_list_at(aps, number);
    ck_assert_ptr_nonnull(ap);
    return ap;
}

START_TEST(all_columns_are_read)
{
    sim_list_t aps = aps_of("id,x,y,z,p0_dbm,exponent,near_dbm\n02:ab c,1,2,3,-40,2.5,-44\n"
                            "second,-1,-2,0,-38,2,-41\n");
    ck_assert_uint_eq(aps.count, 2u);
    const sim_ap_t *ap = ap_at(&aps, 0);
    ck_assert_str_eq(ap->id, "02:ab c");
    ck_assert(ap->x_m == 1.0 && ap->y_m == 2.0 && ap->z_m == 3.0);
    ck_assert(ap->p0_dbm == -40.0 && ap->exponent == 2.5 && ap->near_dbm == -44.0);
    ck_assert_str_eq(ap_at(&aps, 1)->id, "second");
    sim_list_free(&aps);
}
END_TEST

START_TEST(columns_come_in_any_order_and_most_may_lack)
{
    sim_list_t aps = aps_of("# aps\n\ny, x, exponent, id\n2,1,,a\n4,3,2.5,b # last\n");
    ck_assert(ap_at(&aps, 0)->x_m == 1.0 && ap_at(&aps, 0)->y_m == 2.0);
    ck_assert(isnan(ap_at(&aps, 0)->exponent) && ap_at(&aps, 1)->exponent == 2.5);
    ck_assert(isnan(ap_at(&aps, 1)->z_m) && isnan(ap_at(&aps, 1)->p0_dbm));
    ck_assert(isnan(ap_at(&aps, 1)->near_dbm));
    ck_assert_str_eq(ap_at(&aps, 1)->id, "b");
    sim_list_free(&aps);
}
END_TEST

#define LONG_ID "0123456789012345678901234567890123456789012345678901234567890123"

static const struct {
    const char *text;
    int line;
    const char *says;
} refusals[] = {
    {"", 1, "no access points, expected a header and at least one"},
    {"id,x,y\n", 2, "no access points"},
    {"id,x\na,1\n", 1, "the header lacks id, x or y"},
    {"x,y\n1,2\n", 1, "the header lacks id, x or y"},
    {"a,1,2\n", 1, "the column 'a' is unknown or comes twice"},
    {"id,x,y,x\n", 1, "the column 'x' is unknown or comes twice"},
    {"id,x,y,id\n", 1, "the column 'id' is unknown or comes twice"},
    {"id,x,y,z,p0_dbm,exponent,near_dbm,z\n", 1, "the column 'z' is unknown or comes twice"},
    {"id,x,y\na,1\n", 2, "too few fields, expected 3"},
    {"id,x,y\na,1,2,3\n", 2, "too many fields, expected 3"},
    {"id,x,y\na,1,2\na,3,4\n", 3, "the id 'a' comes twice"},
    {"id,x,y\n,1,2\n", 2, "an id of 0 characters, expected 1 to 63"},
    {"id,x,y\n" LONG_ID ",1,2\n", 2, "an id of 64 characters"},
    {"id,x,y\na,,2\n", 2, "x is '', expected a number"},
    {"id,x,y\na,1,north\n", 2, "y is 'north', expected a number"},
    {"id,x,y,exponent\na,1,2,0\n", 2, "exponent is '0', expected a number from 0.5 to 10"},
    {"id,x,y,p0_dbm\na,1,2,nan\n", 2, "p0_dbm is 'nan'"},
};

START_TEST(bad_access_points_are_refused_by_line)
{
    sim_list_t aps;
    sim_error_t error;
    FILE *stream = stream_of(refusals[_i].text);
    ck_assert(!sim_aps_read(stream, &aps, &error));
    fclose(stream);
    ck_assert_msg(strstr(error.text, refusals[_i].says) != NULL, "says: %s", error.text);
    ck_assert_int_eq(error.line, refusals[_i].line);
    ck_assert_ptr_null(aps.items);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("sim/aps");
    suite_add(suite, "form", all_columns_are_read);
    suite_add(suite, "columns", columns_come_in_any_order_and_most_may_lack);
    suite_add_loop(suite, "refusals", bad_access_points_are_refused_by_line,
                   (int)(sizeof refusals / sizeof refusals[0]));
    return suite;
}
