/* SPDX-License-Identifier: MIT */
#include "carry_classes.h"

#include <stdlib.h>
#include <string.h>

#include "fields.h"
#include "memory.h"

static bool add_class(carry_classes_t *classes, const char *name, int *number, failure_t *failure)
{
    *number = (int)id_table_number(&classes->names, name);
    return classes->names.count <= INSOLE_CARRY_CLASSES ||
           failure_input(failure,
                         "insole train-carry: more than %d classes: put positions together by "
                         "--classes",
                         INSOLE_CARRY_CLASSES);
}

static bool add_position(carry_classes_t *classes, const char *position, int number,
                         failure_t *failure)
{
    uint32_t known;
    if (*position == '\0' || strchr(position, '=') != NULL ||
        id_table_find(&classes->positions, position, &known)) {
        return failure_usage(failure,
                             "insole train-carry: --classes: position \"%.40s\": expected each "
                             "once, as in  hand=hand+inhand,pocket",
                             position);
    }
    size_t at = id_table_number(&classes->positions, position);
    classes->class_of =
        memory_room(classes->class_of, &classes->room, at + 1u, sizeof *classes->class_of);
    classes->class_of[at] = number;
    return true;
}

/* `name` or `name=position+position`; changes the text. */
static bool read_class(carry_classes_t *classes, char *text, failure_t *failure)
{
    int number;
    char *positions = strchr(text, '=');
    if (positions != NULL) {
        *positions++ = '\0';
    } else {
        positions = text;
    }
    uint32_t known;
    if (*text == '\0' || id_table_find(&classes->names, text, &known)) {
        return failure_usage(failure,
                             "insole train-carry: --classes: class \"%.40s\": expected "
                             "each once, as in  hand=hand+inhand,pocket",
                             text);
    }
    if (!add_class(classes, text, &number, failure)) {
        return false;
    }
    while (positions != NULL) {
        char *next = strchr(positions, '+');
        if (next != NULL) {
            *next++ = '\0';
        }
        if (!add_position(classes, positions, number, failure)) {
            return false;
        }
        positions = next;
    }
    return true;
}

bool carry_classes_init(carry_classes_t *classes, const char *text, failure_t *failure)
{
    memset(classes, 0, sizeof *classes);
    id_table_init(&classes->names);
    id_table_init(&classes->positions);
    classes->are_told = text != NULL;
    char *copy = memory_text(text != NULL ? text : ""), *rest = text != NULL ? copy : NULL, *next;
    bool is_good = true;
    while (is_good && (next = fields_next(&rest)) != NULL) {
        is_good = read_class(classes, next, failure);
    }
    free(copy);
    if (!is_good) {
        carry_classes_free(classes);
    }
    return is_good;
}

bool carry_classes_of(carry_classes_t *classes, const char *position, int *number,
                      failure_t *failure)
{
    uint32_t at;
    if (id_table_find(&classes->positions, position, &at)) {
        *number = classes->class_of[at];
        return true;
    }
    *number = CARRY_LEFT_OUT;
    return classes->are_told || (add_class(classes, position, number, failure) &&
                                 add_position(classes, position, *number, failure));
}

void carry_classes_free(carry_classes_t *classes)
{
    id_table_free(&classes->names);
    id_table_free(&classes->positions);
    free(classes->class_of);
    memset(classes, 0, sizeof *classes);
}
