/** @file json.h  JSON written as it is told, indented.
 *
 *      json_begin(&json, stdout);
 *      json_object(&json, NULL); json_number(&json, "mean", 0.25, 3); json_end(&json);
 *
 *  A key is NULL inside an array and for the outermost value.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_JSON_H
#define INSOLE_HOST_JSON_H

#include <stdbool.h>
#include <stdio.h>

enum { JSON_DEPTH = 8 };

typedef struct {
    FILE *file;
    int depth;
    char closing[JSON_DEPTH]; /**< of what is open */
    bool has_item[JSON_DEPTH + 1];
} json_t;

void json_begin(json_t *json, FILE *file);

void json_object(json_t *json, const char *key);
void json_array(json_t *json, const char *key);

/** Closes the innermost object or array; a line end follows the outermost. */
void json_end(json_t *json);

/** Not-a-number becomes null. */
void json_number(json_t *json, const char *key, double value, int decimals);

void json_whole(json_t *json, const char *key, long long value);
void json_text(json_t *json, const char *key, const char *text);
void json_flag(json_t *json, const char *key, bool value);

#endif
