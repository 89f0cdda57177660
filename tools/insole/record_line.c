/* SPDX-License-Identifier: MIT */
#include "record_line.h"

#include <math.h>
#include <string.h>

#include "number.h"

/* How a kind of record is written. */
typedef struct {
    const char *name;
    const char *form;                  /* as messages show it */
    const char *column[RECORD_VALUES]; /* names of the values */
    int needed, most;                  /* values that must be there; values that may */
    bool has_id;
    bool is_sensor; /* then a value may be empty or not a number: trouble, but not malformed */
} form_t;

static const form_t forms[RECORD_KINDS] = {
    [RECORD_START] = {"start",
                      "start,t,x,y[,heading[,sigma_m,sigma_rad]]",
                      {"x", "y", "heading", "sigma_m", "sigma_rad"},
                      2,
                      5,
                      false,
                      false},
    [RECORD_IMU] =
        {"imu", "imu,t,ax,ay,az,gx,gy,gz", {"ax", "ay", "az", "gx", "gy", "gz"}, 6, 6, false, true},
    [RECORD_ACC] = {"acc", "acc,t,ax,ay,az", {"ax", "ay", "az"}, 3, 3, false, true},
    [RECORD_GYR] = {"gyr", "gyr,t,gx,gy,gz", {"gx", "gy", "gz"}, 3, 3, false, true},
    [RECORD_MAG] = {"mag", "mag,t,mx,my,mz", {"mx", "my", "mz"}, 3, 3, false, true},
    [RECORD_RSS] = {"rss", "rss,t,id,dbm[,age]", {"dbm", "age"}, 1, 2, true, true},
    [RECORD_RANGE] = {"range", "range,t,id,metres[,sigma]", {"metres", "sigma"}, 1, 2, true, true},
    [RECORD_TRUTH] = {"truth", "truth,t,x,y[,z]", {"x", "y", "z"}, 2, 3, false, false},
};

static const form_t *find_form(const char *word)
{
    for (int kind = 0; kind < RECORD_TRACK; kind++) {
        if (strcmp(forms[kind].name, word) == 0) {
            return &forms[kind];
        }
    }
    return NULL;
}

bool record_line_is_kind(const char *word)
{
    return find_form(word) != NULL;
}

const char *record_line_kind_name(record_kind_t kind)
{
    return kind < RECORD_TRACK ? forms[kind].name : "track";
}

bool record_line_time(const char *field, int64_t *t_us, const line_reader_t *line,
                      failure_t *failure)
{
    if (!number_parse_time(field, t_us)) {
        line_reader_fail(line, failure,
                         "t \"%.40s\" is not a time: expected seconds such as 12.345678", field);
        return false;
    }
    return true;
}

/* Sensors may say anything; a place or an optional field may not. */
static bool parse_value(const form_t *form, int i, const char *field, double *value)
{
    if (form->is_sensor && i < form->needed) {
        return number_parse_sensor(field, value);
    }
    if (i >= form->needed && field[0] == '\0') {
        return true;
    }
    return number_parse(field, value);
}

static bool is_allowed(const form_t *form, int i, double value, const line_reader_t *line,
                       failure_t *failure)
{
    bool is_measure =
        strcmp(form->column[i], "age") == 0 || strncmp(form->column[i], "sigma", 5u) == 0;
    if (is_measure && value < 0.0) {
        line_reader_fail(line, failure, "%s must not be negative: expected %s", form->column[i],
                         form->form);
        return false;
    }
    return true;
}

static bool parse_values(const form_t *form, char *const *fields, int count, record_t *record,
                         const line_reader_t *line, failure_t *failure)
{
    for (int i = 0; i < RECORD_VALUES; i++) {
        record->value[i] = NUMBER_UNKNOWN;
    }
    for (int i = 0; i < count; i++) {
        if (!parse_value(form, i, fields[i], &record->value[i])) {
            line_reader_fail(line, failure, "%s \"%.40s\" is not a number: expected %s",
                             form->column[i], fields[i], form->form);
            return false;
        }
        if (!is_allowed(form, i, record->value[i], line, failure)) {
            return false;
        }
    }
    return true;
}

static bool has_right_count(const form_t *form, int values, const line_reader_t *line,
                            failure_t *failure)
{
    bool has_lone_sigma = form == &forms[RECORD_START] && values == 4;
    if (values < form->needed || has_lone_sigma) {
        line_reader_fail(line, failure, "too few fields: expected %s", form->form);
        return false;
    }
    if (values > form->most) {
        line_reader_fail(line, failure, "too many fields: expected %s", form->form);
        return false;
    }
    return true;
}

bool record_line_parse(fields_t *fields, id_table_t *ids, record_t *record,
                       const line_reader_t *line, failure_t *failure)
{
    const form_t *form = find_form(fields->at[0]);
    if (form == NULL) {
        line_reader_fail(line, failure,
                         "unknown record \"%.40s\": expected imu, acc, gyr, mag, rss, range, "
                         "start or truth",
                         fields->at[0]);
        return false;
    }
    fields_drop_comment(fields, form->has_id ? 2 : -1);
    int first = form->has_id ? 3 : 2; /* field of the first value */
    if (!has_right_count(form, fields->count - first, line, failure)) {
        return false;
    }
    record->kind = (record_kind_t)(form - forms);
    record->id = 0u;
    if (form->has_id && fields->at[2][0] == '\0') {
        line_reader_fail(line, failure, "id is empty: expected %s", form->form);
        return false;
    }
    if (!record_line_time(fields->at[1], &record->t_us, line, failure) ||
        !parse_values(form, fields->at + first, fields->count - first, record, line, failure)) {
        return false;
    }
    record->id = form->has_id ? id_table_number(ids, fields->at[2]) : 0u;
    return true;
}
