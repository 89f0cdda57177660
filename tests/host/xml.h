/** @file xml.h  Is a text a well-formed XML document? Elements, attributes, text and entities;
 *         no CDATA, comments or doctypes, which nobody here writes.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TESTS_HOST_XML_H
#define INSOLE_TESTS_HOST_XML_H

#include <ctype.h>
#include <stdbool.h>
#include <string.h>

enum { XML_DEPTH = 16 };

static inline const char *xml_name_end(const char *at)
{
    while (isalnum((unsigned char)*at) || *at == '-' || *at == ':' || *at == '_') {
        at++;
    }
    return at;
}

/** Passes over text up to `stop`; NULL when an entity is unknown or a `<` stands in it. */
static inline const char *xml_text(const char *at, char stop)
{
    for (; *at != '\0' && *at != stop; at++) {
        if ((unsigned char)*at < 0x20u && *at != '\n' && *at != '\t') {
            return NULL;
        }
        if (*at == '<') {
            return NULL;
        }
        if (*at == '&' && strncmp(at, "&lt;", 4u) != 0 && strncmp(at, "&gt;", 4u) != 0 &&
            strncmp(at, "&amp;", 5u) != 0 && strncmp(at, "&quot;", 6u) != 0) {
            return NULL;
        }
    }
    return at;
}

/** Passes over the attributes of a tag, each name="value" with a blank before it. */
static inline const char *xml_attributes(const char *at)
{
    while (at != NULL && isspace((unsigned char)*at)) {
        at++;
        const char *end = xml_name_end(at);
        if (end == at) {
            continue;
        }
        if (end[0] != '=' || end[1] != '"') {
            return NULL;
        }
        at = xml_text(end + 2, '"');
        at = at != NULL && *at == '"' ? at + 1 : NULL;
    }
    return at;
}

/** NULL when the document is well formed; else where it is not. */
static inline const char *xml_fault(const char *at)
{
    const char *open[XML_DEPTH];
    size_t length[XML_DEPTH];
    int depth = 0;
    bool had_root = false;
    if (strncmp(at, "<?xml ", 6u) == 0) {
        at = strstr(at, "?>");
        if (at == NULL) {
            return "<?xml";
        }
        at += 2;
    }
    while (*at != '\0') {
        const char *text = xml_text(at, '<');
        if (text == NULL || (depth == 0 && strspn(at, " \n\t") != (size_t)(text - at))) {
            return at;
        }
        at = text;
        if (*at == '\0') {
            break;
        }
        bool is_closing = at[1] == '/';
        const char *name = at + (is_closing ? 2 : 1), *end = xml_name_end(name);
        if (end == name) {
            return at;
        }
        if (is_closing) {
            depth--;
            if (depth < 0 || length[depth] != (size_t)(end - name) ||
                strncmp(open[depth], name, length[depth]) != 0 || *end != '>') {
                return at;
            }
            at = end + 1;
            continue;
        }
        const char *after = xml_attributes(end);
        if (after == NULL || (depth == 0 && had_root) || depth == XML_DEPTH) {
            return at;
        }
        had_root = true;
        if (strncmp(after, "/>", 2u) == 0) {
            at = after + 2;
        } else if (*after == '>') {
            open[depth] = name;
            length[depth++] = (size_t)(end - name);
            at = after + 1;
        } else {
            return at;
        }
    }
    return depth == 0 && had_root ? NULL : at;
}

#endif
