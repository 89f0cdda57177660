/* SPDX-License-Identifier: MIT */
#include "sim/scenario.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

enum { LINE_BYTES = 512, MAX_FIELDS = 4 };

/* A number that an order names, and where it goes. */
typedef struct {
    const char *name;
    size_t offset;
    double low, high;
} field_t;

#define FIELD(name, member, low, high)                                                             \
    {                                                                                              \
        name, offsetof(sim_order_t, member), low, high                                             \
    }
#define FIELD_X       FIELD("x", x_m, -1e5, 1e5)
#define FIELD_Y       FIELD("y", y_m, -1e5, 1e5)
#define FIELD_Z       FIELD("z", z_m, -1e4, 1e4)
#define FIELD_HEADING FIELD("heading", heading_rad, -6.3, 6.3)

typedef struct {
    const char *name;
    sim_order_kind_t kind;
    size_t needed, known; /* fields that must and may be there */
    const char *usage;
    field_t fields[MAX_FIELDS];
} form_t;

static const form_t forms[] = {
    {"start",
     SIM_ORDER_START,
     3,
     4,
     "start,x,y,heading[,z]",
     {FIELD_X, FIELD_Y, FIELD_HEADING, FIELD_Z}},
    {"walk",
     SIM_ORDER_WALK,
     3,
     3,
     "walk,x,y,speed",
     {FIELD_X, FIELD_Y, FIELD("speed", speed_mps, 0.3, 4.0)}},
    {"stairs",
     SIM_ORDER_STAIRS,
     4,
     4,
     "stairs,x,y,z,speed",
     {FIELD_X, FIELD_Y, FIELD_Z, FIELD("speed", speed_mps, 0.2, 1.2)}},
    {"pause", SIM_ORDER_PAUSE, 1, 1, "pause,seconds", {FIELD("seconds", seconds, 0.0, 36000.0)}},
    {"turn", SIM_ORDER_TURN, 1, 1, "turn,heading", {FIELD_HEADING}},
};

/* Cuts the comment and the white space around what is left. */
static char *trim(char *text)
{
    text[strcspn(text, "#")] = '\0';
    while (isspace((unsigned char)*text)) {
        text++;
    }
    size_t length = strlen(text);
    while (length > 0 && isspace((unsigned char)text[length - 1])) {
        length--;
    }
    text[length] = '\0';
    return text;
}

static const form_t *find_form(const char *name)
{
    for (size_t i = 0; i < sizeof forms / sizeof forms[0]; i++) {
        if (strcmp(forms[i].name, name) == 0) {
            return &forms[i];
        }
    }
    return NULL;
}

static bool read_field(sim_order_t *order, const field_t *field, const char *text,
                       sim_error_t *error)
{
    char *end;
    double number = strtod(text, &end);
    if (end == text || *end != '\0' || !(number >= field->low && number <= field->high)) {
        return sim_fail(error, "%s is '%s', expected a number from %g to %g", field->name, text,
                        field->low, field->high);
    }
    memcpy((unsigned char *)order + field->offset, &number, sizeof number);
    return true;
}

/* Takes the text up to the next comma; NULL when there is none left. */
static char *next_field(char **rest)
{
    char *field = *rest;
    if (field == NULL) {
        return NULL;
    }
    char *comma = strchr(field, ',');
    *rest = comma == NULL ? NULL : comma + 1;
    if (comma != NULL) {
        *comma = '\0';
    }
    return trim(field);
}

static bool read_fields(sim_order_t *order, const form_t *form, char *rest, sim_error_t *error)
{
    size_t count = 0;
    for (char *text = next_field(&rest); text != NULL; text = next_field(&rest), count++) {
        if (count == form->known) {
            return sim_fail(error, "too many fields, expected %s", form->usage);
        }
        if (!read_field(order, &form->fields[count], text, error)) {
            return false;
        }
    }
    return count >= form->needed || sim_fail(error, "too few fields, expected %s", form->usage);
}

static bool read_order(sim_scenario_t *scenario, char *text, int line, sim_error_t *error)
{
    char *rest = text;
    const char *name = next_field(&rest);
    const form_t *form = find_form(name);
    if (form == NULL) {
        return sim_fail(
            error, "'%s' is no order, expected start, walk, stairs, pause, turn or key = value",
            name);
    }
    bool is_first = scenario->orders.count == 0;
    if (is_first != (form->kind == SIM_ORDER_START)) {
        return sim_fail(error, "'%s' is out of place, expected one start before all other orders",
                        name);
    }
    sim_order_t order = {.kind = form->kind, .line = line};
    if (!read_fields(&order, form, rest, error)) {
        return false;
    }
    return sim_list_add(&scenario->orders, &order) || sim_fail(error, "out of memory");
}

static bool read_line(sim_scenario_t *scenario, char *line, int number, sim_error_t *error)
{
    char *text = trim(line);
    char *equals = strchr(text, '=');
    if (*text == '\0') {
        return true;
    }
    if (equals == NULL) {
        return read_order(scenario, text, number, error);
    }
    *equals = '\0';
    return sim_settings_set(&scenario->settings, trim(text), trim(equals + 1), error);
}

static bool read_lines(FILE *stream, sim_scenario_t *scenario, sim_error_t *error)
{
    char line[LINE_BYTES];
    int number = 0;
    while (fgets(line, sizeof line, stream) != NULL) {
        number++;
        if (strchr(line, '\n') == NULL && !feof(stream)) {
            sim_fail(error, "the line is too long, expected at most %d characters", LINE_BYTES - 2);
            return sim_fail_on_line(error, number);
        }
        if (!read_line(scenario, line, number, error)) {
            return sim_fail_on_line(error, number);
        }
    }
    if (ferror(stream)) {
        return sim_fail(error, "cannot be read");
    }
    if (scenario->orders.count == 0) {
        sim_fail(error, "the scenario has no start, expected %s", forms[0].usage);
        return sim_fail_on_line(error, number + 1);
    }
    return true;
}

bool sim_scenario_read(FILE *stream, sim_scenario_t *scenario, sim_error_t *error)
{
    scenario->settings = sim_settings_defaults;
    scenario->orders = sim_list(sizeof(sim_order_t));
    if (!read_lines(stream, scenario, error)) {
        sim_scenario_free(scenario);
        return false;
    }
    return true;
}

void sim_scenario_free(sim_scenario_t *scenario)
{
    sim_list_free(&scenario->orders);
}
