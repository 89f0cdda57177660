/* SPDX-License-Identifier: MIT */
#include "sim/settings.h"

#include <stdio.h>
#include <string.h>

#include "near.h"
#include "suite.h"

static size_t key_count(void)
{
    size_t count = 0;
    while (sim_key_at(count) != NULL) {
        count++;
    }
    return count;
}

static double value_of(const sim_settings_t *settings, const sim_key_t *key)
{
    const unsigned char *member = (const unsigned char *)settings + key->offset;
    int32_t number;
    double value;
    memcpy(&number, member, sizeof number);
    memcpy(&value, member, sizeof value);
    return key->is_choice ? (double)number : value;
}

START_TEST(every_default_is_in_its_range)
{
    for (size_t i = 0; i < key_count(); i++) {
        const sim_key_t *key = sim_key_at(i);
        ASSERT_AT_LEAST(key->value, key->low, key->name);
        ASSERT_AT_MOST(key->value, key->high, key->name);
        ck_assert_msg(value_of(&sim_settings_defaults, key) == key->value, "%s", key->name);
    }
}
END_TEST

START_TEST(no_two_keys_have_one_name_or_place)
{
    for (size_t i = 0; i < key_count(); i++) {
        for (size_t k = 0; k < i; k++) {
            const sim_key_t *a = sim_key_at(i), *b = sim_key_at(k);
            ck_assert(strcmp(a->group, b->group) != 0 || strcmp(a->name, b->name) != 0);
            ck_assert_uint_ne(a->offset, b->offset);
        }
    }
}
END_TEST

/* Sets each key to both ends of its range; nothing else may change. */
START_TEST(every_key_can_be_set_and_sets_itself_alone)
{
    for (size_t i = 0; i < key_count(); i++) {
        const sim_key_t *key = sim_key_at(i);
        char name[64], value[32];
        snprintf(name, sizeof name, "%s.%s", key->group, key->name);
        if (key->is_choice) {
            continue;
        }
        for (int end = 0; end < 2; end++) {
            sim_settings_t settings = sim_settings_defaults;
            sim_error_t error;
            double wanted = end == 0 ? key->low : key->high;
            snprintf(value, sizeof value, "%.17g", wanted);
            ck_assert_msg(sim_settings_set(&settings, name, value, &error), "%s", error.text);
            for (size_t k = 0; k < key_count(); k++) {
                const sim_key_t *other = sim_key_at(k);
                ck_assert(value_of(&settings, other) == (k == i ? wanted : other->value));
            }
        }
    }
}
END_TEST

START_TEST(choices_go_by_name)
{
    sim_settings_t settings = sim_settings_defaults;
    sim_error_t error;
    ck_assert(sim_settings_set(&settings, "imu.model", "matched", &error));
    ck_assert_int_eq(settings.imu.model, SIM_MODEL_MATCHED);
    ck_assert(sim_settings_set(&settings, "imu.model", "ideal", &error));
    ck_assert_int_eq(settings.imu.model, SIM_MODEL_IDEAL);
    ck_assert(sim_settings_set(&settings, "imu.model", "full", &error));
    ck_assert_int_eq(settings.imu.model, SIM_MODEL_FULL);
    ck_assert(sim_settings_set(&settings, "imu.sampling", "point", &error));
    ck_assert_int_eq(settings.imu.sampling, SIM_SAMPLING_POINT);
    ck_assert(sim_settings_set(&settings, "imu.clip", "soft", &error));
    ck_assert_int_eq(settings.imu.clip, SIM_CLIP_SOFT);
    ck_assert(sim_settings_set(&settings, "gait.foot", "left", &error));
    ck_assert_int_eq(settings.gait.foot, SIM_FOOT_LEFT);
    ck_assert(sim_settings_set(&settings, "radio.model", "matched", &error));
    ck_assert_int_eq(settings.radio.model, SIM_RADIO_MATCHED);
    ck_assert(sim_settings_set(&settings, "radio.model", "off", &error));
    ck_assert_int_eq(settings.radio.model, SIM_RADIO_OFF);
    ck_assert(sim_settings_set(&settings, "radio.age", "silent", &error));
    ck_assert_int_eq(settings.radio.age, SIM_AGE_SILENT);
    ck_assert(sim_settings_set(&settings, "radio.place", "body", &error));
    ck_assert_int_eq(settings.radio.place, SIM_CARRIED_BY_BODY);
    ck_assert(sim_settings_set(&settings, "radio.near", "told", &error));
    ck_assert_int_eq(settings.radio.near, SIM_NEAR_TOLD);
    ck_assert(sim_settings_set(&settings, "log.sensor", "phone", &error));
    ck_assert_int_eq(settings.log.sensor, SIM_SENSOR_PHONE);
    ck_assert(sim_settings_set(&settings, "phone.pose", "pocket", &error));
    ck_assert_int_eq(settings.phone.pose, SIM_POSE_POCKET);
    ck_assert(sim_settings_set(&settings, "phone.mounting", "random", &error));
    ck_assert_int_eq(settings.phone.mounting, SIM_MOUNTING_RANDOM);
    ck_assert(sim_settings_set(&settings, "magnet.model", "off", &error));
    ck_assert_int_eq(settings.magnet.model, SIM_MAGNET_OFF);
    ck_assert(sim_settings_set(&settings, "log.start", "none", &error));
    ck_assert_int_eq(settings.log.start, SIM_START_NONE);
}
END_TEST

static const struct {
    const char *key, *value, *says;
} refusals[] = {
    {"imu.rate_hz", "49.9", "imu.rate_hz is '49.9', expected a number from 50 to 1000 Hz"},
    {"imu.rate_hz", "1000.1", "expected a number from 50 to 1000 Hz"},
    {"imu.rate_hz", "fast", "imu.rate_hz is 'fast'"},
    {"imu.rate_hz", "200 Hz", "imu.rate_hz is '200 Hz'"},
    {"imu.rate_hz", "", "expected a number"},
    {"imu.rate_hz", "nan", "expected a number"},
    {"imu.rate_hz", "inf", "expected a number"},
    {"gait.wobble_rad", "-0.001", "expected a number from 0 to 0.05 rad"},
    {"imu.model", "perfect", "imu.model is 'perfect', expected one of full|matched|ideal"},
    {"imu.model", "full|matched", "expected one of"},
    {"imu.model", "ful", "expected one of"},
    {"imu.model", "", "expected one of"},
    {"imu.model", "0", "expected one of"},
    {"imu.rate", "200", "no setting is called 'imu.rate'"},
    {"rate_hz", "200", "no setting is called 'rate_hz'"},
    {"im.rate_hz", "200", "no setting is called"},
    {"gait.rate_hz", "200", "no setting is called"},
    {"", "200", "no setting is called"},
    {".", "200", "no setting is called"},
};

START_TEST(bad_settings_are_refused_and_change_nothing)
{
    sim_settings_t settings = sim_settings_defaults;
    sim_error_t error;
    ck_assert(!sim_settings_set(&settings, refusals[_i].key, refusals[_i].value, &error));
    ck_assert_msg(strstr(error.text, refusals[_i].says) != NULL, "says: %s", error.text);
    ck_assert_mem_eq(&settings, &sim_settings_defaults, sizeof settings);
}
END_TEST

/* The text of maps/README.md; the caller's buffer. */
static void read_guide(char *text, size_t room)
{
    FILE *stream = fopen(SIM_SOURCE_DIR "/maps/README.md", "r");
    ck_assert_ptr_nonnull(stream);
    size_t size = fread(text, 1, room - 1, stream);
    text[size] = '\0';
    fclose(stream);
}

START_TEST(the_guide_lists_every_setting_as_it_is)
{
    static char guide[100000];
    read_guide(guide, sizeof guide);
    size_t rows = 0;
    const char *settings = strstr(guide, "\n### Settings\n");
    ck_assert_ptr_nonnull(settings);
    for (const char *at = strstr(settings, "\n| `"); at != NULL; at = strstr(at + 1, "\n| `")) {
        rows += strchr(at, '.') < strchr(at + 4, '`') ? 1u : 0u;
    }
    ck_assert_uint_eq(rows, key_count());
    for (size_t i = 0; i < key_count(); i++) {
        char row[SIM_KEY_ROW_BYTES];
        sim_key_row(sim_key_at(i), row);
        ck_assert_msg(strstr(guide, row) != NULL, "maps/README.md lacks the row\n%s", row);
    }
}
END_TEST

START_TEST(rows_say_default_range_unit_and_meaning)
{
    sim_key_t real = {"imu", "x_m", false, 0, 0.25, -1.0, 2.0, "m", "how far"};
    sim_key_t choice = {"log", "start", true, 0, 1.0, 0.0, 2.0, "none|known|told", "what"};
    char row[SIM_KEY_ROW_BYTES];
    sim_key_row(&real, row);
    ck_assert_str_eq(row, "| `imu.x_m` | 0.25 | -1 to 2 | m | how far |");
    sim_key_row(&choice, row);
    ck_assert_str_eq(row, "| `log.start` | known | none, known, told | | what |");
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("sim/settings");
    suite_add(suite, "defaults", every_default_is_in_its_range);
    suite_add(suite, "names", no_two_keys_have_one_name_or_place);
    suite_add(suite, "set", every_key_can_be_set_and_sets_itself_alone);
    suite_add(suite, "choices", choices_go_by_name);
    suite_add_loop(suite, "refusals", bad_settings_are_refused_and_change_nothing,
                   (int)(sizeof refusals / sizeof refusals[0]));
    suite_add(suite, "guide", the_guide_lists_every_setting_as_it_is);
    suite_add(suite, "rows", rows_say_default_range_unit_and_meaning);
    return suite;
}
