/* SPDX-License-Identifier: MIT */
#include "c_text.h"

#include <stdlib.h>
#include <string.h>

#include "platform.h"

enum { MOST_DIGITS = sizeof(insole_real_t) == sizeof(float) ? 9 : 17 };

static bool gives_back(const char *number, insole_real_t value)
{
    bool is_float = sizeof value == sizeof(float);
    return (is_float ? (double)strtof(number, NULL) : strtod(number, NULL)) == (double)value;
}

const char *c_real(char buffer[C_REAL_ROOM], insole_real_t value)
{
    char number[NUMBER_ROOM];
    int digits = 5;
    do {
        snprintf(number, sizeof number, "%.*g", ++digits, (double)value);
    } while (digits < MOST_DIGITS && !gives_back(number, value));
    snprintf(buffer, C_REAL_ROOM, "INSOLE_R(%s%s)", number,
             strpbrk(number, ".e") == NULL ? ".0" : "");
    return buffer;
}

void c_write_string(FILE *file, const char *text)
{
    putc('"', file);
    for (; *text != '\0'; text++) {
        unsigned char c = (unsigned char)*text;
        if (c < 0x20u || c > 0x7eu || c == '"' || c == '\\' || c == '?') {
            fprintf(file, "\\%03o", (unsigned)c);
        } else {
            putc(c, file);
        }
    }
    putc('"', file);
}

void c_write_comment(FILE *file, const char *path)
{
    for (const char *text = platform_base_name(path); *text != '\0'; text++) {
        bool is_plain = (unsigned char)*text >= 0x20u && strchr("*\\?", *text) == NULL;
        putc(is_plain ? *text : '_', file);
    }
}
