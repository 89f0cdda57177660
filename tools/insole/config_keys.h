/** @file config_keys.h  The keys of every setting, made of the library's own lists.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_CONFIG_KEYS_H
#define INSOLE_HOST_CONFIG_KEYS_H

#include <stdio.h>

#include "failure.h"
#include "settings.h"

typedef enum { CONFIG_REAL, CONFIG_INT, CONFIG_CHOICE } config_kind_t;

typedef struct {
    const char *name; /**< section.key */
    config_kind_t kind;
    size_t offset; /**< in settings_t */
    double low, high;
    const char *unit; /**< of a choice: its names, separated by | */
    const char *text;
} config_key_t;

/** All keys, section by section. */
const config_key_t *config_keys(size_t *count);

/** Sets one key. The failure says what is wrong, without saying where; the caller adds that.
 *  @return false: unknown key (with the nearest known one), not a value, or out of range */
bool config_set(settings_t *settings, const char *name, const char *value, failure_t *failure);

/** The same for `key=value`. */
bool config_set_pair(settings_t *settings, const char *pair, failure_t *failure);

/** Room for the name of a value of a choice. */
enum { CONFIG_CHOICE_ROOM = 32 };

/** Name of a value of the choice `key`. @return buffer */
const char *config_choice(char buffer[CONFIG_CHOICE_ROOM], const char *key, int32_t value);

/** Reads `key = value` lines; `#` starts a comment. */
bool config_read(settings_t *settings, const char *path, failure_t *failure);

/** The same from a file that is already open, which is closed. */
bool config_read_file(settings_t *settings, FILE *file, const char *name, failure_t *failure);

/** What a key is set to; of a choice its number. */
double config_value(const settings_t *settings, const config_key_t *key);

/** All settings as `key = value` lines that config_read takes. */
void config_print(FILE *file, const settings_t *settings);

/** All settings as a Markdown table: key, unit, default, range, meaning. */
void config_print_table(FILE *file);

#endif
