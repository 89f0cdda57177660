/* SPDX-License-Identifier: MIT */
#include "json.h"

#include <math.h>
#include <string.h>

#include "number.h"

void json_begin(json_t *json, FILE *file)
{
    memset(json, 0, sizeof *json);
    json->file = file;
}

static void write_string(FILE *file, const char *text)
{
    putc('"', file);
    for (; *text != '\0'; text++) {
        unsigned char c = (unsigned char)*text;
        if (c < 0x20u) {
            fprintf(file, "\\u%04x", (unsigned)c);
        } else {
            fputs(c == '"' || c == '\\' ? "\\" : "", file);
            putc(c, file);
        }
    }
    putc('"', file);
}

static void indent(const json_t *json)
{
    if (json->depth > 0) {
        fprintf(json->file, "\n%*s", 2 * json->depth, "");
    }
}

static void write_key(json_t *json, const char *key)
{
    fputs(json->has_item[json->depth] ? "," : "", json->file);
    json->has_item[json->depth] = true;
    indent(json);
    if (key != NULL) {
        write_string(json->file, key);
        fputs(": ", json->file);
    }
}

static void open_level(json_t *json, const char *key, char opening, char closing)
{
    write_key(json, key);
    putc(opening, json->file);
    json->closing[json->depth++] = closing;
    json->has_item[json->depth] = false;
}

void json_object(json_t *json, const char *key)
{
    open_level(json, key, '{', '}');
}

void json_array(json_t *json, const char *key)
{
    open_level(json, key, '[', ']');
}

void json_end(json_t *json)
{
    bool has_item = json->has_item[json->depth];
    json->depth--;
    if (has_item) {
        fprintf(json->file, "\n%*s", 2 * json->depth, "");
    }
    putc(json->closing[json->depth], json->file);
    fputs(json->depth == 0 ? "\n" : "", json->file);
}

void json_number(json_t *json, const char *key, double value, int decimals)
{
    char number[NUMBER_ROOM];
    write_key(json, key);
    number_fixed(number, value, decimals);
    fputs(strcmp(number, "nan") == 0 ? "null" : number, json->file);
}

void json_whole(json_t *json, const char *key, long long value)
{
    write_key(json, key);
    fprintf(json->file, "%lld", value);
}

void json_text(json_t *json, const char *key, const char *text)
{
    write_key(json, key);
    write_string(json->file, text);
}

void json_flag(json_t *json, const char *key, bool value)
{
    write_key(json, key);
    fputs(value ? "true" : "false", json->file);
}
