/* SPDX-License-Identifier: MIT */
#include "text.h"

#include "said.h"
#include "suite.h"

static const struct {
    float value;
    uint32_t decimals;
    const char *text;
} fixed[] = {{0.0f, 3u, "0.000"},        {1.0f, 0u, "1"},
             {-1.25f, 2u, "-1.25"},      {0.0625f, 3u, "0.063"},
             {-0.0001f, 3u, "0.000"},    {12.5f, 6u, "12.500000"},
             {3.0e9f, 0u, "2147483520"}, {-3.0e9f, 3u, "-2147483.520"},
             {0.00095f, 3u, "0.001"}};

START_TEST(a_number_becomes_text)
{
    forget();
    text_fixed(fixed[_i].value, fixed[_i].decimals);
    ck_assert_str_eq(said, fixed[_i].text);
}
END_TEST

START_TEST(times_keep_their_sign_and_their_microseconds)
{
    forget();
    text_seconds(-1500000);
    text_write(" ");
    text_seconds(3600000001);
    text_write(" ");
    text_seconds(0);
    text_write(" ");
    text_whole(4294967295u);
    text_write(" ");
    text_hex(0xabcu);
    ck_assert_str_eq(said, "-1.500000 3600.000001 0.000000 4294967295 00000abc");
}
END_TEST
Suite *insole_suite(void)
{
    Suite *suite = suite_create("text");
    suite_add_loop(suite, "a number becomes text", a_number_becomes_text,
                   (int)(sizeof fixed / sizeof fixed[0]));
    suite_add(suite, "times", times_keep_their_sign_and_their_microseconds);
    return suite;
}
