/* SPDX-License-Identifier: MIT */
#include "sim/settings.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define IS_CHOICE_REAL   false
#define IS_CHOICE_CHOICE true

#define DEFAULT(kind, name, value, low, high, unit, text) (value),
#define ROW(group, begin, type, kind, name, value, low, high, unit, text)                          \
    {(group), #name, IS_CHOICE_##kind, (begin) + offsetof(type, name), (value), (low), (high),     \
     (unit),  (text)},
#define WALK_ROW(...) ROW("walk", offsetof(sim_settings_t, walk), sim_walk_settings_t, __VA_ARGS__)
#define GAIT_ROW(...) ROW("gait", offsetof(sim_settings_t, gait), sim_gait_settings_t, __VA_ARGS__)
#define MOUNT_ROW(...)                                                                             \
    ROW("mount", offsetof(sim_settings_t, mount), sim_mount_settings_t, __VA_ARGS__)
#define IMU_ROW(...) ROW("imu", offsetof(sim_settings_t, imu), sim_imu_settings_t, __VA_ARGS__)
#define PERSON_ROW(...)                                                                            \
    ROW("person", offsetof(sim_settings_t, person), sim_person_settings_t, __VA_ARGS__)
#define PHONE_ROW(...)                                                                             \
    ROW("phone", offsetof(sim_settings_t, phone), sim_phone_settings_t, __VA_ARGS__)
#define MAGNET_ROW(...)                                                                            \
    ROW("magnet", offsetof(sim_settings_t, magnet), sim_magnet_settings_t, __VA_ARGS__)
#define RADIO_ROW(...)                                                                             \
    ROW("radio", offsetof(sim_settings_t, radio), sim_radio_settings_t, __VA_ARGS__)
#define ERRANDS_ROW(...)                                                                           \
    ROW("errands", offsetof(sim_settings_t, errands), sim_errands_settings_t, __VA_ARGS__)
#define SURVEY_ROW(...)                                                                            \
    ROW("survey", offsetof(sim_settings_t, survey), sim_survey_settings_t, __VA_ARGS__)
#define LOG_ROW(...) ROW("log", offsetof(sim_settings_t, log), sim_log_settings_t, __VA_ARGS__)

const sim_settings_t sim_settings_defaults = {
    {SIM_WALK_KEYS(DEFAULT)},   {SIM_GAIT_KEYS(DEFAULT)},   {SIM_MOUNT_KEYS(DEFAULT)},
    {SIM_IMU_KEYS(DEFAULT)},    {SIM_PERSON_KEYS(DEFAULT)}, {SIM_PHONE_KEYS(DEFAULT)},
    {SIM_MAGNET_KEYS(DEFAULT)}, {SIM_RADIO_KEYS(DEFAULT)},  {SIM_ERRANDS_KEYS(DEFAULT)},
    {SIM_SURVEY_KEYS(DEFAULT)}, {SIM_LOG_KEYS(DEFAULT)}};

/* clang-format off */
static const sim_key_t keys[] = {
    SIM_WALK_KEYS(WALK_ROW)
    SIM_GAIT_KEYS(GAIT_ROW)
    SIM_MOUNT_KEYS(MOUNT_ROW)
    SIM_IMU_KEYS(IMU_ROW)
    SIM_PERSON_KEYS(PERSON_ROW)
    SIM_PHONE_KEYS(PHONE_ROW)
    SIM_MAGNET_KEYS(MAGNET_ROW)
    SIM_RADIO_KEYS(RADIO_ROW)
    SIM_ERRANDS_KEYS(ERRANDS_ROW)
    SIM_SURVEY_KEYS(SURVEY_ROW)
    SIM_LOG_KEYS(LOG_ROW)
};
/* clang-format on */

const sim_key_t *sim_key_at(size_t number)
{
    return number < sizeof keys / sizeof keys[0] ? &keys[number] : NULL;
}

/* Name number `number` in "a|b|c", and its length. */
static const char *choice_name(const char *names, int number, int *length)
{
    for (; number > 0; number--) {
        names += strcspn(names, "|") + 1;
    }
    *length = (int)strcspn(names, "|");
    return names;
}

static void choice_row(const sim_key_t *key, char row[SIM_KEY_ROW_BYTES])
{
    int length;
    const char *name = choice_name(key->unit, (int)key->value, &length);
    int used =
        snprintf(row, SIM_KEY_ROW_BYTES, "| `%s.%s` | %.*s |", key->group, key->name, length, name);
    for (int i = 0; i <= (int)key->high; i++) {
        name = choice_name(key->unit, i, &length);
        used += snprintf(row + used, SIM_KEY_ROW_BYTES - (size_t)used, "%s%.*s",
                         i == 0 ? " " : ", ", length, name);
    }
    snprintf(row + used, SIM_KEY_ROW_BYTES - (size_t)used, " | | %s |", key->text);
}

void sim_key_row(const sim_key_t *key, char row[SIM_KEY_ROW_BYTES])
{
    if (key->is_choice) {
        choice_row(key, row);
    } else {
        snprintf(row, SIM_KEY_ROW_BYTES, "| `%s.%s` | %g | %g to %g | %s | %s |", key->group,
                 key->name, key->value, key->low, key->high, key->unit, key->text);
    }
}

static const sim_key_t *find(const char *key)
{
    const char *dot = strchr(key, '.');
    if (dot == NULL) {
        return NULL;
    }
    size_t group_length = (size_t)(dot - key);
    for (size_t i = 0; sim_key_at(i) != NULL; i++) {
        const sim_key_t *k = sim_key_at(i);
        if (strlen(k->group) == group_length && strncmp(k->group, key, group_length) == 0 &&
            strcmp(k->name, dot + 1) == 0) {
            return k;
        }
    }
    return NULL;
}

/* Which of the names in "a|b|c" the value is; -1 when none. */
static int32_t choice_number(const sim_key_t *key, const char *value)
{
    for (int number = 0; number <= (int)key->high; number++) {
        int length;
        const char *name = choice_name(key->unit, number, &length);
        if (strlen(value) == (size_t)length && strncmp(name, value, (size_t)length) == 0) {
            return number;
        }
    }
    return -1;
}

static bool set_choice(int32_t *member, const sim_key_t *key, const char *value, sim_error_t *error)
{
    int32_t number = choice_number(key, value);
    if (number < 0) {
        return sim_fail(error, "%s.%s is '%s', expected one of %s", key->group, key->name, value,
                        key->unit);
    }
    *member = number;
    return true;
}

static bool set_real(double *member, const sim_key_t *key, const char *value, sim_error_t *error)
{
    char *end;
    double number = strtod(value, &end);
    if (end == value || *end != '\0' || !(number >= key->low && number <= key->high)) {
        return sim_fail(error, "%s.%s is '%s', expected a number from %g to %g %s", key->group,
                        key->name, value, key->low, key->high, key->unit);
    }
    *member = number;
    return true;
}

bool sim_settings_set(sim_settings_t *settings, const char *key, const char *value,
                      sim_error_t *error)
{
    const sim_key_t *found = find(key);
    if (found == NULL) {
        return sim_fail(error, "no setting is called '%s', expected a key of maps/README.md", key);
    }
    void *member = (unsigned char *)settings + found->offset;
    if (found->is_choice) {
        return set_choice(member, found, value, error);
    }
    return set_real(member, found, value, error);
}
