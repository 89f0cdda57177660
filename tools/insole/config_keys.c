/* SPDX-License-Identifier: MIT */
#include "config_keys.h"

#include <string.h>

#include "nearest.h"
#include "number.h"

#define ROW(section, member, kind, name, value, low, high, unit, text)                             \
    {#section "." #name, CONFIG_##kind, offsetof(settings_t, member.name), low, high, unit, text},

#define SENSOR_ROW(kind, name, ...)       ROW(sensor, sensor, kind, name, __VA_ARGS__)
#define FOOT_TRACKER_ROW(kind, name, ...) ROW(foot_tracker, fusion.foot, kind, name, __VA_ARGS__)
#define SCREEN_ROW(kind, name, ...)       ROW(screen, fusion.foot.screen, kind, name, __VA_ARGS__)
#define STILL_BIAS_ROW(kind, name, ...)                                                            \
    ROW(still_bias, fusion.foot.still_bias, kind, name, __VA_ARGS__)
#define ZERO_VELOCITY_ROW(kind, name, ...)                                                         \
    ROW(zero_velocity, fusion.foot.zero_velocity, kind, name, __VA_ARGS__)
#define ZUPT_EKF_ROW(kind, name, ...) ROW(zupt_ekf, fusion.foot.zupt_ekf, kind, name, __VA_ARGS__)

#define STRIDE_ROW(kind, name, ...)      ROW(stride, fusion.foot.stride, kind, name, __VA_ARGS__)
#define FOOT_FUSION_ROW(kind, name, ...) ROW(foot_fusion, fusion, kind, name, __VA_ARGS__)
#define PARTICLE_FILTER_ROW(kind, name, ...)                                                       \
    ROW(particle_filter, fusion.particles, kind, name, __VA_ARGS__)
#define TWO_ORDER_ROW(kind, name, ...) ROW(two_order, fusion.two_order, kind, name, __VA_ARGS__)
#define RSS_FIELD_ROW(kind, name, ...)                                                             \
    ROW(rss_field, fusion.particles.field, kind, name, __VA_ARGS__)
#define PROPAGATION_ROW(kind, name, ...) ROW(propagation, propagation, kind, name, __VA_ARGS__)
#define RSS_FIX_ROW(kind, name, ...)     ROW(rss_fix, fusion.rss_fix, kind, name, __VA_ARGS__)
#define RANGE_FIX_ROW(kind, name, ...)   ROW(range_fix, fusion.range_fix, kind, name, __VA_ARGS__)

#define PHONE_TRACKER_ROW(kind, name, ...)                                                         \
    ROW(phone_tracker, phone.tracker, kind, name, __VA_ARGS__)
#define MAGNETIC_ROW(kind, name, ...) ROW(magnetic, phone.magnetic, kind, name, __VA_ARGS__)

#define PHONE_GAIT_ROW(kind, name, ...) ROW(phone_walk, phone.gait, kind, name, __VA_ARGS__)
#define PHONE_WALK_ROW(kind, name, ...) ROW(phone_walk, phone.tracker.walk, kind, name, __VA_ARGS__)
#define PHONE_PLACE_ROW(kind, name, ...)                                                           \
    ROW(phone_place, phone.tracker.place, kind, name, __VA_ARGS__)
#define PHONE_COMPASS_ROW(kind, name, ...)                                                         \
    ROW(phone_compass, phone.tracker.compass, kind, name, __VA_ARGS__)
#define ATTITUDE_ROW(kind, name, ...) ROW(attitude, phone.tracker.attitude, kind, name, __VA_ARGS__)
#define STEP_ROW(kind, name, ...)     ROW(step, phone.tracker.walk.step, kind, name, __VA_ARGS__)
#define STEP_LENGTH_ROW(kind, name, ...)                                                           \
    ROW(step_length, phone.tracker.walk.step_length, kind, name, __VA_ARGS__)
#define AUTO_START_ROW(kind, name, ...)                                                            \
    ROW(auto_start, phone.tracker.auto_start, kind, name, __VA_ARGS__)
#define WALK_HEADING_ROW(kind, name, ...)                                                          \
    ROW(walk_heading, phone.walk_heading, kind, name, __VA_ARGS__)
#define CARRY_ROW(kind, name, ...) ROW(carry, phone.carry, kind, name, __VA_ARGS__)
#define STEP_FUSION_ROW(kind, name, ...)                                                           \
    ROW(step_fusion, phone.step_fusion, kind, name, __VA_ARGS__)
#define ML_SHIFT_ROW(kind, name, ...)   ROW(ml_shift, phone.ml_shift, kind, name, __VA_ARGS__)
#define WALKER_EKF_ROW(kind, name, ...) ROW(walker_ekf, phone.walker_ekf, kind, name, __VA_ARGS__)
#define STEP_CLOUD_ROW(kind, name, ...) ROW(step_cloud, phone.step_cloud, kind, name, __VA_ARGS__)
#define STEP_CLOUD_PARTICLES_ROW(kind, name, ...)                                                  \
    ROW(step_cloud, phone.step_cloud.particles, kind, name, __VA_ARGS__)
#define PLAIN_CLOUD_ROW(kind, name, ...)                                                           \
    ROW(plain_cloud, phone.plain_cloud, kind, name, __VA_ARGS__)
#define PLAIN_CLOUD_PARTICLES_ROW(kind, name, ...)                                                 \
    ROW(plain_cloud, phone.plain_cloud.particles, kind, name, __VA_ARGS__)
#define PHONE_PARTS_ROW(kind, name, ...)   ROW(phone_parts, phone.parts, kind, name, __VA_ARGS__)
#define WPF_ROW(kind, name, ...)           ROW(wpf, phone.wpf, kind, name, __VA_ARGS__)
#define WPF_PARTICLES_ROW(kind, name, ...) ROW(wpf, phone.wpf.particles, kind, name, __VA_ARGS__)
#define ZEE_ROW(kind, name, ...)           ROW(zee, phone.zee, kind, name, __VA_ARGS__)
#define ZEE_PARTICLES_ROW(kind, name, ...) ROW(zee, phone.zee.particles, kind, name, __VA_ARGS__)
#define KDE_FIX_ROW(kind, name, ...)       ROW(kde_fix, phone.kde_fix, kind, name, __VA_ARGS__)
#define ML_FIX_ROW(kind, name, ...)        ROW(ml_fix, phone.ml_fix, kind, name, __VA_ARGS__)

/* clang-format off */
static const config_key_t keys[] = {
    SENSOR_KEYS(SENSOR_ROW)
    INSOLE_FOOT_TRACKER_KEYS(FOOT_TRACKER_ROW)
    INSOLE_SCREEN_KEYS(SCREEN_ROW)
    INSOLE_STILL_BIAS_KEYS(STILL_BIAS_ROW)
    INSOLE_ZERO_VELOCITY_KEYS(ZERO_VELOCITY_ROW)
    INSOLE_ZUPT_EKF_KEYS(ZUPT_EKF_ROW)
    INSOLE_STRIDE_KEYS(STRIDE_ROW)
    INSOLE_FOOT_FUSION_KEYS(FOOT_FUSION_ROW)
    INSOLE_PARTICLE_FILTER_KEYS(PARTICLE_FILTER_ROW)
    INSOLE_PARTICLE_FILTER_KEYS(TWO_ORDER_ROW)
    INSOLE_RSS_FIELD_KEYS(RSS_FIELD_ROW)
    INSOLE_PROPAGATION_KEYS(PROPAGATION_ROW)
    INSOLE_RSS_FIX_KEYS(RSS_FIX_ROW)
    INSOLE_RANGE_FIX_KEYS(RANGE_FIX_ROW)
    PHONE_PARTS_KEYS(PHONE_PARTS_ROW)
    INSOLE_PHONE_TRACKER_KEYS(PHONE_TRACKER_ROW)
    INSOLE_PHONE_WALK_KEYS(PHONE_WALK_ROW)
    INSOLE_PHONE_GAIT_KEYS(PHONE_GAIT_ROW)
    INSOLE_PHONE_PLACE_KEYS(PHONE_PLACE_ROW)
    INSOLE_PHONE_COMPASS_KEYS(PHONE_COMPASS_ROW)
    INSOLE_ATTITUDE_KEYS(ATTITUDE_ROW)
    INSOLE_MAGNETIC_KEYS(MAGNETIC_ROW)
    INSOLE_STEP_KEYS(STEP_ROW)
    INSOLE_STEP_LENGTH_KEYS(STEP_LENGTH_ROW)
    INSOLE_AUTO_START_KEYS(AUTO_START_ROW)
    INSOLE_WALK_HEADING_KEYS(WALK_HEADING_ROW)
    INSOLE_CARRY_KEYS(CARRY_ROW)
    INSOLE_STEP_FUSION_KEYS(STEP_FUSION_ROW)
    INSOLE_ML_SHIFT_KEYS(ML_SHIFT_ROW)
    INSOLE_WALKER_EKF_KEYS(WALKER_EKF_ROW)
    INSOLE_STEP_CLOUD_KEYS(STEP_CLOUD_ROW)
    INSOLE_PARTICLE_FILTER_KEYS(STEP_CLOUD_PARTICLES_ROW)
    INSOLE_STEP_CLOUD_KEYS(PLAIN_CLOUD_ROW)
    INSOLE_PARTICLE_FILTER_KEYS(PLAIN_CLOUD_PARTICLES_ROW)
    INSOLE_STEP_CLOUD_KEYS(WPF_ROW)
    INSOLE_PARTICLE_FILTER_KEYS(WPF_PARTICLES_ROW)
    INSOLE_STEP_CLOUD_KEYS(ZEE_ROW)
    INSOLE_PARTICLE_FILTER_KEYS(ZEE_PARTICLES_ROW)
    INSOLE_KDE_FIX_KEYS(KDE_FIX_ROW)
    INSOLE_ML_FIX_KEYS(ML_FIX_ROW)
};
/* clang-format on */

enum { KEY_COUNT = sizeof keys / sizeof keys[0] };

const config_key_t *config_keys(size_t *count)
{
    *count = KEY_COUNT;
    return keys;
}

static const config_key_t *find_key(const char *name)
{
    for (size_t i = 0u; i < KEY_COUNT; i++) {
        if (strcmp(keys[i].name, name) == 0) {
            return &keys[i];
        }
    }
    return NULL;
}

/* A user who leaves out the section means the key of that name. */
static bool refuse_key(const char *name, failure_t *failure)
{
    nearest_t nearest;
    nearest_begin(&nearest, name);
    for (size_t i = 0u; i < KEY_COUNT; i++) {
        nearest_offer(&nearest, keys[i].name);
    }
    failure_input(failure, "unknown key \"%.60s\": ", name);
    return nearest.best != NULL ? failure_add(failure, "did you mean %s?", nearest.best)
                                : failure_add(failure, "`insole config` lists all of them");
}

/* Number of a name in a list separated by |; -1: it is not in it. */
static int find_choice(const char *names, const char *name)
{
    size_t length = strlen(name);
    for (int i = 0; names != NULL; i++) {
        if (strncmp(names, name, length) == 0 && (names[length] == '|' || names[length] == '\0')) {
            return length > 0u ? i : -1;
        }
        names = strchr(names, '|');
        names = names != NULL ? names + 1 : NULL;
    }
    return -1;
}

static bool parse_value(const config_key_t *key, const char *text, double *value,
                        failure_t *failure)
{
    int64_t whole = 0;
    bool is_good = false;
    if (key->kind == CONFIG_CHOICE) {
        *value = find_choice(key->unit, text);
        is_good = *value >= 0.0;
    } else if (key->kind == CONFIG_INT) {
        is_good = number_parse_whole(text, INT32_MIN, INT32_MAX, &whole);
        *value = (double)whole;
    } else {
        is_good = number_parse(text, value);
    }
    if (!is_good) {
        return failure_input(failure, "%s: \"%.40s\" is not %s%s", key->name, text,
                             key->kind == CONFIG_REAL  ? "a number"
                             : key->kind == CONFIG_INT ? "a whole number"
                                                       : "one of ",
                             key->kind == CONFIG_CHOICE ? key->unit : "");
    }
    return true;
}

static bool check_range(const config_key_t *key, double value, failure_t *failure)
{
    char low[NUMBER_ROOM], high[NUMBER_ROOM], told[NUMBER_ROOM];
    if (value >= key->low && value <= key->high) {
        return true;
    }
    return failure_input(failure, "%s: %s is out of range: expected %s .. %s%s%s", key->name,
                         number_short(told, value), number_short(low, key->low),
                         number_short(high, key->high), key->unit[0] != '\0' ? " " : "", key->unit);
}

bool config_set(settings_t *settings, const char *name, const char *value, failure_t *failure)
{
    const config_key_t *key = find_key(name);
    double number;
    if (key == NULL) {
        return refuse_key(name, failure);
    }
    if (!parse_value(key, value, &number, failure) || !check_range(key, number, failure)) {
        return false;
    }
    char *target = (char *)settings + key->offset;
    insole_real_t real = (insole_real_t)number;
    int32_t whole = (int32_t)number;
    if (key->kind == CONFIG_REAL) {
        memcpy(target, &real, sizeof real);
    } else {
        memcpy(target, &whole, sizeof whole);
    }
    return true;
}

double config_value(const settings_t *settings, const config_key_t *key)
{
    const char *source = (const char *)settings + key->offset;
    insole_real_t real;
    int32_t whole;
    if (key->kind == CONFIG_REAL) {
        memcpy(&real, source, sizeof real);
        return (double)real;
    }
    memcpy(&whole, source, sizeof whole);
    return (double)whole;
}

/* ---- printing --------------------------------------------------------------------------- */

static void copy_choice(char buffer[CONFIG_CHOICE_ROOM], const char *names, int32_t value)
{
    for (; value > 0; value--) {
        names = strchr(names, '|') + 1;
    }
    snprintf(buffer, CONFIG_CHOICE_ROOM, "%.*s", (int)strcspn(names, "|"), names);
}

const char *config_choice(char buffer[CONFIG_CHOICE_ROOM], const char *key, int32_t value)
{
    copy_choice(buffer, find_key(key)->unit, value);
    return buffer;
}

static void print_value(FILE *file, const config_key_t *key, double value)
{
    char number[NUMBER_ROOM], name[CONFIG_CHOICE_ROOM];
    if (key->kind == CONFIG_CHOICE) {
        copy_choice(name, key->unit, (int32_t)value);
        fputs(name, file);
    } else {
        fputs(number_short(number, value), file);
    }
}

static void print_range(FILE *file, const config_key_t *key, const char *bar)
{
    char low[NUMBER_ROOM], high[NUMBER_ROOM];
    if (key->kind != CONFIG_CHOICE) {
        fprintf(file, "%s .. %s", number_short(low, key->low), number_short(high, key->high));
        return;
    }
    for (const char *name = key->unit; *name != '\0'; name++) {
        if (*name == '|') {
            fputs(bar, file);
        } else {
            putc(*name, file);
        }
    }
}

static const char *unit_of(const config_key_t *key)
{
    return key->kind == CONFIG_CHOICE ? "" : key->unit;
}

void config_print(FILE *file, const settings_t *settings)
{
    for (size_t i = 0u; i < KEY_COUNT; i++) {
        size_t section = strcspn(keys[i].name, ".");
        if (i > 0u && strncmp(keys[i].name, keys[i - 1u].name, section + 1u) != 0) {
            putc('\n', file);
        }
        fprintf(file, "# %s [%s%s", keys[i].text, unit_of(&keys[i]),
                unit_of(&keys[i])[0] != '\0' ? "; " : "");
        print_range(file, &keys[i], "|");
        fprintf(file, "]\n%s = ", keys[i].name);
        print_value(file, &keys[i], config_value(settings, &keys[i]));
        putc('\n', file);
    }
}

void config_print_table(FILE *file)
{
    settings_t defaults;
    settings_init(&defaults);
    fputs("| key | default | range | unit | meaning |\n|---|---|---|---|---|\n", file);
    for (size_t i = 0u; i < KEY_COUNT; i++) {
        fprintf(file, "| `%s` | ", keys[i].name);
        print_value(file, &keys[i], config_value(&defaults, &keys[i]));
        fputs(" | ", file);
        print_range(file, &keys[i], ", ");
        fprintf(file, " | %s | %s |\n", unit_of(&keys[i]), keys[i].text);
    }
}
