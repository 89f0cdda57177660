/* SPDX-License-Identifier: MIT */
#include "config_keys.h"

#include <stdlib.h>

#include "files.h"
#include "near.h"
#include "number.h"
#include "suite.h"

static settings_t settings;
static failure_t failure;

START_TEST(the_table_is_complete_and_sane)
{
    size_t count;
    const config_key_t *keys = config_keys(&count);
    size_t members = sizeof(settings_t) / sizeof(insole_real_t);
    ck_assert_uint_ge(count, 40u);
    ck_assert_uint_le(count, members);
    settings_init(&settings);
    for (size_t i = 0u; i < count; i++) {
        ck_assert_ptr_nonnull(strchr(keys[i].name, '.'));
        double value = config_value(&settings, &keys[i]);
        ck_assert_msg((double)(insole_real_t)keys[i].low <= value &&
                          value <= (double)(insole_real_t)keys[i].high, "%s", keys[i].name);
        ck_assert(keys[i].text[0] != '\0');
        ck_assert_uint_lt(keys[i].offset, sizeof(settings_t));
        for (size_t k = 0u; k < i; k++) {
            ck_assert_str_ne(keys[i].name, keys[k].name);
            ck_assert_uint_ne(keys[i].offset, keys[k].offset);
        }
    }
}
END_TEST

/* The config that is printed sets every key to its default, and they are the library's. */
START_TEST(what_is_printed_is_read_back)
{
    settings_t defaults;
    FILE *file = tmpfile();
    settings_init(&defaults);
    config_print(file, &defaults);
    const char *path = scratch_file("defaults.conf", text_of(file));
    memset(&settings, 0x55, sizeof settings);
    ck_assert_msg(config_read(&settings, path, &failure), "%s", failure.text);
    FILE *again = tmpfile();
    config_print(again, &settings);
    char text[TEXT_ROOM];
    strcpy(text, text_of(again));
    ck_assert_str_eq(text, content_of(path));
    ck_assert(settings.fusion.foot.zupt_ekf.sigma_zupt_mps ==
              insole_foot_tracker_defaults.zupt_ekf.sigma_zupt_mps);
    ck_assert(settings.fusion.foot.stride.min_length_m ==
              insole_foot_tracker_defaults.stride.min_length_m);
    ck_assert_int_eq(settings.fusion.foot.zero_velocity.detector, INSOLE_DETECT_ADAPTIVE);
}
END_TEST

START_TEST(each_key_sets_its_own_member)
{
    size_t count;
    const config_key_t *keys = config_keys(&count);
    for (size_t i = 0u; i < count; i++) {
        settings_t other;
        char value[NUMBER_ROOM];
        settings_init(&settings);
        settings_init(&other);
        if (keys[i].kind != CONFIG_REAL) {
            continue;
        }
        double now = config_value(&settings, &keys[i]);
        double target = now != (double)(insole_real_t)keys[i].high ? keys[i].high : keys[i].low;
        ck_assert_msg(config_set(&other, keys[i].name, number_short(value, target), &failure), "%s",
                      failure.text);
        int changed = 0;
        for (size_t k = 0u; k < sizeof settings; k += sizeof(insole_real_t)) {
            bool differs =
                memcmp((char *)&settings + k, (char *)&other + k, sizeof(insole_real_t)) != 0;
            ck_assert(!differs || k == keys[i].offset);
            changed += differs ? 1 : 0;
        }
        ck_assert_int_eq(changed, 1);
    }
}
END_TEST

/* Two particle filters have the same keys; each prints the defaults of its own. */
START_TEST(the_settings_of_the_paper_are_apart)
{
    settings_init(&settings);
    ck_assert(config_set(&settings, "two_order.sigma_length_m", "0.5", &failure));
    ck_assert(settings.fusion.two_order.sigma_length_m == INSOLE_R(0.5));
    ck_assert(settings.fusion.particles.sigma_length_m ==
              insole_particle_filter_defaults.sigma_length_m);
    FILE *file = tmpfile();
    config_print_table(file);
    const char *text = text_of(file);
    ck_assert_ptr_nonnull(strstr(text, "\n| `particle_filter.walls` | crosses |"));
    ck_assert_ptr_nonnull(strstr(text, "\n| `two_order.walls` | inside |"));
}
END_TEST

static const char *const groups[] = {"foot_fusion.lag_s",  "particle_filter.turn_share",
                                     "rss_field.spacing_m", "propagation.p0_dbm",
                                     "rss_fix.sigma_db",    "range_fix.bias_m"};

START_TEST(the_second_order_has_keys)
{
    settings_t before;
    settings_init(&settings);
    before = settings;
    ck_assert_msg(config_set(&settings, groups[_i], "3", &failure), "%s", failure.text);
    ck_assert_int_ne(memcmp(&settings, &before, sizeof settings), 0);
}
END_TEST

START_TEST(values_are_set)
{
    settings_init(&settings);
    ck_assert(config_set(&settings, "zupt_ekf.sigma_zupt_mps", "0.03", &failure));
    ck_assert(settings.fusion.foot.zupt_ekf.sigma_zupt_mps == INSOLE_R(0.03));
    ck_assert(config_set(&settings, "foot_tracker.method", "pdr", &failure));
    ck_assert_int_eq(settings.fusion.foot.method, INSOLE_FOOT_PDR);
    ck_assert(config_set_pair(&settings, " zero_velocity.detector =  two-step ", &failure));
    ck_assert_int_eq(settings.fusion.foot.zero_velocity.detector, INSOLE_DETECT_TWO_STEP);
    ck_assert(config_set_pair(&settings, "sensor.gyro_scale=1.01", &failure));
    ck_assert(settings.sensor.gyro_scale == INSOLE_R(1.01));
}
END_TEST

static const struct {
    const char *pair, *message;
} refused[] = {
    {"zupt_ekf.sigma_zupt_mps=2",
     "zupt_ekf.sigma_zupt_mps: 2 is out of range: expected 0.0001 .. 1 m/s"},
    {"zupt_ekf.sigma_zupt_mps=-1",
     "zupt_ekf.sigma_zupt_mps: -1 is out of range: expected 0.0001 .. 1 m/s"},
    {"zupt_ekf.sigma_zupt_mps=small", "zupt_ekf.sigma_zupt_mps: \"small\" is not a number"},
    {"zupt_ekf.sigma_zupt_mps=nan", "zupt_ekf.sigma_zupt_mps: \"nan\" is not a number"},
    {"zupt_ekf.sigma_zupt_mps=", "zupt_ekf.sigma_zupt_mps: \"\" is not a number"},
    {"zupt_ekf.sigma_zupt_mp=0.1",
     "unknown key \"zupt_ekf.sigma_zupt_mp\": did you mean zupt_ekf.sigma_zupt_mps?"},
    {"sigma_zupt_mps=0.1", "unknown key \"sigma_zupt_mps\": did you mean zupt_ekf.sigma_zupt_mps?"},
    {"colour=red", "unknown key \"colour\": `insole config` lists all of them"},
    {"foot_tracker.method=gps", "foot_tracker.method: \"gps\" is not one of ins|pdr"},
    {"foot_tracker.method=in", "foot_tracker.method: \"in\" is not one of ins|pdr"},
    {"foot_tracker.method=", "foot_tracker.method: \"\" is not one of ins|pdr"},
    {"sensor.gyro_scale", "\"sensor.gyro_scale\": expected key=value"}};

START_TEST(bad_settings_are_refused_and_change_nothing)
{
    settings_t before;
    settings_init(&settings);
    before = settings;
    ck_assert(!config_set_pair(&settings, refused[_i].pair, &failure));
    ck_assert_str_eq(failure.text, refused[_i].message);
    ck_assert_int_eq(memcmp(&settings, &before, sizeof settings), 0);
}
END_TEST

START_TEST(a_config_file_is_read)
{
    settings_init(&settings);
    ck_assert(config_read(&settings,
                          scratch_file("good.conf", "\xEF\xBB\xBF# mine\r\n\r\n"
                                                    "  stride.min_length_m = 0.3 # longer\r\n"
                                                    "foot_tracker.method=pdr"),
                          &failure));
    ck_assert(settings.fusion.foot.stride.min_length_m == INSOLE_R(0.3));
    ck_assert_int_eq(settings.fusion.foot.method, INSOLE_FOOT_PDR);
}
END_TEST

static const struct {
    const char *text, *message;
} bad_files[] = {
    {"\n# x\nstride.min_length_m 0.3\n", ":3: \"stride.min_length_m 0.3\": expected key = value"},
    {"stride.min_lenght_m = 0.3\n",
     ":1: unknown key \"stride.min_lenght_m\": did you mean stride.min_length_m?"},
    {"stride.min_length_m = 99\n",
     ":1: stride.min_length_m: 99 is out of range: expected 0 .. 2 m"},
    {"= 1\n", ":1: unknown key \"\": `insole config` lists all of them"}};

START_TEST(mistakes_in_a_config_file_are_told_with_their_line)
{
    char expected[700];
    settings_init(&settings);
    ck_assert(!config_read(&settings, scratch_file("bad.conf", bad_files[_i].text), &failure));
    snprintf(expected, sizeof expected, "%s/bad.conf%s", SCRATCH, bad_files[_i].message);
    ck_assert_str_eq(failure.text, expected);
    ck_assert_int_eq(failure.exit_code, EXIT_BAD_INPUT);
}
END_TEST

START_TEST(the_table_has_a_row_per_key)
{
    size_t count, lines = 0u;
    FILE *file = tmpfile();
    config_keys(&count);
    config_print_table(file);
    const char *text = text_of(file);
    ck_assert_ptr_nonnull(strstr(text, "\n| `foot_tracker.method` | ins | ins, pdr |  | what makes "
                                       "the position |\n"));
    char row[128], number[NUMBER_ROOM];
    snprintf(row, sizeof row, "\n| `zupt_ekf.sigma_zupt_mps` | %s | 0.0001 .. 1 | m/s | ",
             number_short(number, (double)insole_foot_tracker_defaults.zupt_ekf.sigma_zupt_mps));
    ck_assert_ptr_nonnull(strstr(text, row));
    for (; *text != '\0'; text++) {
        lines += *text == '\n' ? 1u : 0u;
    }
    ck_assert_uint_eq(lines, count + 2u);
}
END_TEST

#define ROWS(table) ((int)(sizeof table / sizeof table[0]))

Suite *insole_suite(void)
{
    Suite *suite = suite_create("config_keys");
    suite_add(suite, "table", the_table_is_complete_and_sane);
    suite_add(suite, "round trip", what_is_printed_is_read_back);
    suite_add(suite, "members", each_key_sets_its_own_member);
    suite_add(suite, "paper", the_settings_of_the_paper_are_apart);
    suite_add_loop(suite, "second order", the_second_order_has_keys, ROWS(groups));
    suite_add(suite, "set", values_are_set);
    suite_add_loop(suite, "refused", bad_settings_are_refused_and_change_nothing, ROWS(refused));
    suite_add(suite, "file", a_config_file_is_read);
    suite_add_loop(suite, "bad file", mistakes_in_a_config_file_are_told_with_their_line,
                   ROWS(bad_files));
    suite_add(suite, "doc", the_table_has_a_row_per_key);
    return suite;
}
