/* SPDX-License-Identifier: MIT */
#include "columns.h"

#include "files.h"
#include "near.h"
#include "suite.h"

enum { SIZE, NAME, WEIGHT, COLOUR };

static const column_t names[] = {
    {"s", -5.0, 5.0}, {"name", 0.0, 0.0}, {"weight", 0.5, 100.0}, {"colour", 0.0, 255.0}};
static const columns_layout_t layout = {names, 4, 2, NAME};

static columns_t columns;
static failure_t failure;

static read_t begin(const char *text)
{
    memset(&failure, 0, sizeof failure);
    columns_attach(&columns, &layout, file_of(text), "things");
    return columns_next(&columns, &failure);
}

START_TEST(values_are_found_by_the_names_of_their_columns)
{
    double s = 0.0, weight = 0.0, colour = 7.0;
    ck_assert_int_eq(begin("# things\n weight , name,s\n\n 1.5,a b#1 , -2 # small\n,c,3\n"),
                     READ_ONE);
    ck_assert(columns_number(&columns, SIZE, &s, &failure));
    ck_assert(columns_number(&columns, WEIGHT, &weight, &failure));
    ck_assert(columns_number(&columns, COLOUR, &colour, &failure));
    ASSERT_NEAR(s, -2.0, 0.0, "");
    ASSERT_NEAR(weight, 1.5, 0.0, "");
    ASSERT_NEAR(colour, 7.0, 0.0, ""); /* no such column: as it was */
    ck_assert_str_eq(columns_id(&columns, &failure), "a b#1");
    ck_assert_uint_eq(columns.lines.number, 4u);
    ck_assert(columns_has(&columns, WEIGHT) && !columns_has(&columns, COLOUR));
    ck_assert_int_eq(columns_next(&columns, &failure), READ_ONE);
    ck_assert(columns_number(&columns, WEIGHT, &weight, &failure));
    ASSERT_NEAR(weight, 1.5, 0.0, ""); /* an empty field: as it was */
    ck_assert_int_eq(columns_next(&columns, &failure), READ_END);
    columns_close(&columns);
}
END_TEST

START_TEST(names_of_columns_are_told_in_order)
{
    char text[COLUMNS_TEXT];
    ck_assert_str_eq(columns_text(&layout, 4, text), "s,name,weight,colour");
    ck_assert_str_eq(columns_text(&layout, 1, text), "s");
    ck_assert_str_eq(columns_text(&layout, 0, text), "");
}
END_TEST

START_TEST(before_the_header_no_column_is_there)
{
    ck_assert_int_eq(begin("# nothing\n"), READ_END);
    ck_assert(!columns_has(&columns, SIZE));
    columns_close(&columns);
}
END_TEST

static const struct {
    const char *text, *message;
} malformed[] = {
    {"s,name,wight\n", "things:1: unknown column \"wight\": expected some of s,name,weight,colour "
                       "(weight?)"},
    {"s,nam\n", "things:1: unknown column \"nam\": expected some of s,name,weight,colour (name?)"},
    {"x,name\n", "things:1: unknown column \"x\": expected some of s,name,weight,colour"},
    {"name,s,name\n", "things:1: column name comes twice: expected each once"},
    {"weight,s\n", "things:1: header has no column name: expected s,name,weight,colour, of which "
                   "s,name must be there"},
    {"s,name\n1,a,2\n", "things:2: row has 3 fields: expected 2 as in the header"},
    {"s,name\n1 # a\n", "things:2: row has 1 fields: expected 2 as in the header"},
};

START_TEST(malformed_headers_and_rows_are_told)
{
    ck_assert_int_eq(begin(malformed[_i].text), READ_FAILED);
    ck_assert_str_eq(failure.text, malformed[_i].message);
    ck_assert_int_eq(failure.exit_code, EXIT_BAD_INPUT);
    columns_close(&columns);
}
END_TEST

#define ID_63 "123456789012345678901234567890123456789012345678901234567890123"

static const struct {
    const char *row, *message;
} values[] = {
    {"big,a,1", "things:2: s \"big\" is not a number"},
    {",a,1", "things:2: s \"\" is not a number"},
    {"nan,a,1", "things:2: s \"nan\" is not a number"},
    {"5.01,a,1", "things:2: s 5.01 is out of range: expected -5 to 5"},
    {"1,a,0.4", "things:2: weight 0.4 is out of range: expected 0.5 to 100"},
    {"1,,1", "things:2: id of 0 characters: expected 1 to 63"},
    {"1," ID_63 "4,1", "things:2: id of 64 characters: expected 1 to 63"},
    {"5," ID_63 ",100", ""},
    {"-5,a,.5", ""},
};

START_TEST(values_out_of_range_are_told)
{
    char text[200];
    double number;
    snprintf(text, sizeof text, "s,name,weight\n%s\n", values[_i].row);
    ck_assert_int_eq(begin(text), READ_ONE);
    bool is_good = columns_number(&columns, SIZE, &number, &failure) &&
                   columns_number(&columns, WEIGHT, &number, &failure) &&
                   columns_id(&columns, &failure) != NULL;
    ck_assert_int_eq(is_good, values[_i].message[0] == '\0');
    ck_assert_str_eq(failure.text, values[_i].message);
    columns_close(&columns);
}
END_TEST

START_TEST(a_missing_file_is_told)
{
    ck_assert(!columns_open(&columns, &layout, SCRATCH "/absent.csv", &failure));
    ck_assert_ptr_nonnull(strstr(failure.text, "absent.csv: cannot open"));
}
END_TEST

#define ROWS(table) ((int)(sizeof table / sizeof table[0]))

Suite *insole_suite(void)
{
    Suite *suite = suite_create("host/columns");
    suite_add(suite, "values", values_are_found_by_the_names_of_their_columns);
    suite_add(suite, "names", names_of_columns_are_told_in_order);
    suite_add(suite, "names", before_the_header_no_column_is_there);
    suite_add_loop(suite, "malformed", malformed_headers_and_rows_are_told, ROWS(malformed));
    suite_add_loop(suite, "values", values_out_of_range_are_told, ROWS(values));
    suite_add(suite, "path", a_missing_file_is_told);
    return suite;
}
