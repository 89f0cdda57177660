/* SPDX-License-Identifier: MIT */
#include "sim/scenario.h"

#include <errno.h>
#include <math.h>
#include <string.h>

#include "sim/text.h"

enum { MAX_FIELDS = 4, PATH_BYTES = 1024 };

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
    {"errands", SIM_ORDER_ERRANDS, 1, 1, "errands,goals", {FIELD("goals", goals, 1.0, 1000.0)}},
    {"survey", SIM_ORDER_SURVEY, 1, 1, "survey,spacing", {FIELD("spacing", spacing_m, 1.0, 50.0)}},
};

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
    double number;
    if (!sim_text_number(text, field->name, field->low, field->high, &number, error)) {
        return false;
    }
    memcpy((unsigned char *)order + field->offset, &number, sizeof number);
    return true;
}

static bool read_fields(sim_order_t *order, const form_t *form, char *rest, sim_error_t *error)
{
    size_t count = 0;
    for (char *text = sim_text_field(&rest); text != NULL; text = sim_text_field(&rest), count++) {
        if (count == form->known) {
            return sim_fail(error, "too many fields, expected %s", form->usage);
        }
        if (!read_field(order, &form->fields[count], text, error)) {
            return false;
        }
    }
    return count >= form->needed || sim_fail(error, "too few fields, expected %s", form->usage);
}

static bool read_order(sim_scenario_t *scenario, const char *name, char *rest, int line,
                       sim_error_t *error)
{
    const form_t *form = find_form(name);
    if (form == NULL) {
        return sim_fail(error,
                        "'%.60s' is no order, expected start, walk, stairs, pause, turn, errands, "
                        "survey, goal, "
                        "plan, aps, pose, points or key = value",
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
    if (fmod(order.goals, 1.0) != 0.0) {
        return sim_fail(error, "goals is %g, expected a whole number", order.goals);
    }
    return sim_list_add(&scenario->orders, &order) || sim_fail(error, "out of memory");
}

static bool read_goal(sim_scenario_t *scenario, char *rest, int line, sim_error_t *error)
{
    sim_goal_t goal = {.line = line};
    const char *x = sim_text_field(&rest), *y = sim_text_field(&rest);
    if (y == NULL) {
        return sim_fail(error, "too few fields, expected goal,x,y[,name]");
    }
    if (!sim_text_number(x, "x", -1e5, 1e5, &goal.at.x_m, error) ||
        !sim_text_number(y, "y", -1e5, 1e5, &goal.at.y_m, error)) {
        return false;
    }
    return sim_list_add(&scenario->goals, &goal) || sim_fail(error, "out of memory");
}

static bool read_points(sim_scenario_t *scenario, char *rest, sim_error_t *error)
{
    static const char *const names[4] = {"x", "y", "x", "y"};
    double values[4];
    for (int i = 0; i < 4; i++) {
        const char *text = sim_text_field(&rest);
        if (text == NULL) {
            return sim_fail(error, "too few fields, expected points,x,y,x,y");
        }
        if (!sim_text_number(text, names[i], -1e5, 1e5, &values[i], error)) {
            return false;
        }
    }
    sim_line_t line = {{values[0], values[1]}, {values[2], values[3]}};
    if (rest != NULL) {
        return sim_fail(error, "too many fields, expected points,x,y,x,y");
    }
    return sim_list_add(&scenario->lines, &line) || sim_fail(error, "out of memory");
}

static bool read_pose(sim_scenario_t *scenario, char *rest, int line, sim_error_t *error)
{
    sim_pose_change_t change = {.line = line};
    const char *time = sim_text_field(&rest), *name = sim_text_field(&rest);
    sim_settings_t named = sim_settings_defaults;
    if (name == NULL || rest != NULL) {
        return sim_fail(error, "expected pose,seconds,hand|ear|swing|pocket");
    }
    if (!sim_text_number(time, "seconds", 0.0, 1e6, &change.t_s, error) ||
        !sim_settings_set(&named, "phone.pose", name, error)) {
        return false;
    }
    change.pose = named.phone.pose;
    return sim_list_add(&scenario->changes, &change) || sim_fail(error, "out of memory");
}

/* The name of a file in the scenario's own folder. */
static bool read_file_name(char name[SIM_FILE_BYTES], const char *what, char *rest,
                           sim_error_t *error)
{
    const char *text = sim_text_field(&rest);
    size_t length = text == NULL ? 0 : strlen(text);
    if (rest != NULL || length == 0 || length >= SIM_FILE_BYTES || strchr(text, '/') != NULL) {
        return sim_fail(error, "expected %s,FILE with the name of a file beside the scenario",
                        what);
    }
    if (*name != '\0') {
        return sim_fail(error, "a second %s, expected one", what);
    }
    memcpy(name, text, length + 1);
    return true;
}

static bool read_statement(sim_scenario_t *scenario, char *text, int line, sim_error_t *error)
{
    char *rest = text;
    const char *name = sim_text_field(&rest);
    if (strcmp(name, "plan") == 0) {
        return read_file_name(scenario->plan_file, name, rest, error);
    }
    if (strcmp(name, "aps") == 0) {
        return read_file_name(scenario->aps_file, name, rest, error);
    }
    if (strcmp(name, "goal") == 0) {
        return read_goal(scenario, rest, line, error);
    }
    if (strcmp(name, "points") == 0) {
        return read_points(scenario, rest, error);
    }
    if (strcmp(name, "pose") == 0) {
        return read_pose(scenario, rest, line, error);
    }
    return read_order(scenario, name, rest, line, error);
}

static bool read_line(void *state, char *text, int number, sim_error_t *error)
{
    sim_scenario_t *scenario = state;
    char *equals = strchr(text, '=');
    if (equals == NULL) {
        return read_statement(scenario, text, number, error);
    }
    *equals = '\0';
    return sim_settings_set(&scenario->settings, sim_text_trim(text), sim_text_trim(equals + 1),
                            error);
}

bool sim_scenario_read(FILE *stream, sim_scenario_t *scenario, sim_error_t *error)
{
    sim_scenario_t empty = {.settings = sim_settings_defaults,
                            .orders = sim_list(sizeof(sim_order_t)),
                            .goals = sim_list(sizeof(sim_goal_t)),
                            .lines = sim_list(sizeof(sim_line_t)),
                            .changes = sim_list(sizeof(sim_pose_change_t)),
                            .plan = sim_plan_empty(),
                            .aps = sim_list(sizeof(sim_ap_t))};
    *scenario = empty;
    int lines;
    bool good = sim_text_lines(stream, read_line, scenario, &lines, error);
    if (good && scenario->orders.count == 0) {
        sim_fail(error, "the scenario has no start, expected %s", forms[0].usage);
        good = sim_fail_on_line(error, lines + 1);
    }
    if (!good) {
        sim_scenario_free(scenario);
    }
    return good;
}

/* Name of a file beside the scenario; cut when it is too long. */
static void name_beside(const char *path, const char *file, char name[PATH_BYTES])
{
    const char *slash = strrchr(path, '/');
    int folder = slash == NULL ? 0 : (int)(slash - path) + 1;
    snprintf(name, PATH_BYTES, "%.*s%s", folder, path, file);
}

FILE *sim_scenario_open_beside(const char *path, const char *file, sim_error_t *error)
{
    char name[PATH_BYTES];
    name_beside(path, file, name);
    FILE *stream = fopen(name, "r");
    if (stream == NULL) {
        sim_fail(error, "cannot be opened: %s", strerror(errno));
        sim_fail_in_file(error, name);
    }
    return stream;
}

static bool load_plan(const char *path, sim_scenario_t *scenario, sim_error_t *error)
{
    FILE *stream = sim_scenario_open_beside(path, scenario->plan_file, error);
    if (stream == NULL) {
        return false;
    }
    bool good = sim_plan_read(stream, &scenario->plan, error);
    fclose(stream);
    return good;
}

static bool load_aps(const char *path, sim_scenario_t *scenario, sim_error_t *error)
{
    FILE *stream = sim_scenario_open_beside(path, scenario->aps_file, error);
    if (stream == NULL) {
        return false;
    }
    bool good = sim_aps_read(stream, &scenario->aps, error);
    fclose(stream);
    return good;
}

static bool load_beside(const char *path, const char *file, sim_scenario_t *scenario,
                        bool (*load)(const char *, sim_scenario_t *, sim_error_t *),
                        sim_error_t *error)
{
    char name[PATH_BYTES];
    if (file[0] == '\0' || load(path, scenario, error)) {
        return true;
    }
    name_beside(path, file, name);
    return sim_fail_in_file(error, name);
}

bool sim_scenario_load(const char *path, sim_scenario_t *scenario, sim_error_t *error)
{
    FILE *stream = fopen(path, "r");
    if (stream == NULL) {
        return sim_fail(error, "cannot be opened: %s", strerror(errno));
    }
    bool good = sim_scenario_read(stream, scenario, error);
    fclose(stream);
    if (!good) {
        return false;
    }
    good = load_beside(path, scenario->plan_file, scenario, load_plan, error) &&
           load_beside(path, scenario->aps_file, scenario, load_aps, error);
    if (!good) {
        sim_scenario_free(scenario);
    }
    return good;
}

void sim_scenario_free(sim_scenario_t *scenario)
{
    sim_list_free(&scenario->orders);
    sim_list_free(&scenario->goals);
    sim_list_free(&scenario->lines);
    sim_list_free(&scenario->changes);
    sim_plan_free(&scenario->plan);
    sim_list_free(&scenario->aps);
}
