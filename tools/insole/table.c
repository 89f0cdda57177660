/* SPDX-License-Identifier: MIT */
#include "table.h"

#include <ctype.h>
#include <math.h>
#include <stddef.h>

#include "number.h"
#include "record_line.h"

static bool is_name(const char *field, const char *name)
{
    for (; *name != '\0' && tolower((unsigned char)*field) == *name; field++, name++) {
    }
    return *field == '\0' && *name == '\0';
}

static int find_column(const fields_t *fields, const char *name)
{
    for (int i = 0; i < fields->count && i < FIELDS_MAX; i++) {
        if (is_name(fields->at[i], name)) {
            return i;
        }
    }
    return -1;
}

static int find_time(const fields_t *fields)
{
    int t = find_column(fields, "t");
    return t >= 0 ? t : find_column(fields, "time");
}

bool table_is_header(const fields_t *fields)
{
    return find_time(fields) >= 0;
}

/* Columns of a quantity, which must be there all or none. */
typedef struct {
    const char *name[3];
    int needed; /* the rest may be missing */
} group_t;

static const group_t accel_group = {{"ax", "ay", "az"}, 3};
static const group_t gyro_group = {{"gx", "gy", "gz"}, 3};
static const group_t mag_group = {{"mx", "my", "mz"}, 3};
static const group_t place_group = {{"x", "y", "z"}, 2};

static bool find_group(const fields_t *fields, const group_t *group, int columns[3], bool *found,
                       const line_reader_t *line, failure_t *failure)
{
    int there = 0, missing = 0;
    for (int i = 2; i >= 0; i--) {
        columns[i] = find_column(fields, group->name[i]);
        there = i < group->needed && columns[i] >= 0 ? there + 1 : there;
        missing = i < group->needed && columns[i] < 0 ? i : missing;
    }
    *found = there == group->needed;
    if (there > 0 && !*found) {
        line_reader_fail(line, failure, "header has no column %s: expected %s,%s%s%s",
                         group->name[missing], group->name[0], group->name[1],
                         group->needed == 3 ? "," : "", group->needed == 3 ? group->name[2] : "");
        return false;
    }
    return true;
}

bool table_parse_header(table_t *table, fields_t *fields, const line_reader_t *line,
                        failure_t *failure)
{
    fields_drop_comment(fields, -1);
    if (fields->count > FIELDS_MAX) {
        line_reader_fail(line, failure, "more than %d columns", FIELDS_MAX);
        return false;
    }
    table->columns = fields->count;
    table->t = find_time(fields);
    table->is_track = find_column(fields, "state") >= 0;
    if (!find_group(fields, &accel_group, table->accel, &table->has_accel, line, failure) ||
        !find_group(fields, &gyro_group, table->gyro, &table->has_gyro, line, failure) ||
        !find_group(fields, &mag_group, table->mag, &table->has_mag, line, failure)) {
        return false;
    }
    bool is_log = table->has_accel || table->has_gyro || table->has_mag;
    table->has_place = false;
    if (!is_log &&
        !find_group(fields, &place_group, table->place, &table->has_place, line, failure)) {
        return false;
    }
    if (table->t < 0 || !(is_log || table->has_place)) {
        line_reader_fail(line, failure,
                         "header names no known columns: expected t,ax,ay,az,gx,gy,gz or t,x,y");
        return false;
    }
    return true;
}

/* A row's values of one quantity, read from the fields into a record. */
typedef struct {
    const table_t *table;
    const fields_t *fields;
    const line_reader_t *line;
    failure_t *failure;
} row_t;

static bool read_value(const row_t *row, int column, const char *name, bool is_sensor,
                       double *value)
{
    const char *field = row->fields->at[column];
    bool is_good = is_sensor ? number_parse_sensor(field, value) : number_parse(field, value);
    if (!is_good) {
        line_reader_fail(row->line, row->failure, "%s \"%.40s\" is not a number", name, field);
    }
    return is_good;
}

static bool read_sensor(const row_t *row, const group_t *group, const int columns[3],
                        double value[3])
{
    return read_value(row, columns[0], group->name[0], true, &value[0]) &&
           read_value(row, columns[1], group->name[1], true, &value[1]) &&
           read_value(row, columns[2], group->name[2], true, &value[2]);
}

static bool read_place(const row_t *row, double value[3])
{
    const int *columns = row->table->place;
    bool has_z = columns[2] >= 0 && row->fields->at[columns[2]][0] != '\0';
    return read_value(row, columns[0], "x", false, &value[0]) &&
           read_value(row, columns[1], "y", false, &value[1]) &&
           (!has_z || read_value(row, columns[2], "z", false, &value[2]));
}

static record_t *add_record(record_t *records, int *count, record_kind_t kind)
{
    record_t *record = &records[(*count)++];
    record->kind = kind;
    record->id = 0u;
    for (int i = 0; i < RECORD_VALUES; i++) {
        record->value[i] = NUMBER_UNKNOWN;
    }
    return record;
}

static bool read_inertial(const row_t *row, record_t *records, int *count)
{
    const table_t *table = row->table;
    if (!table->has_accel && !table->has_gyro) {
        return true;
    }
    bool has_both = table->has_accel && table->has_gyro;
    record_t *record = add_record(records, count,
                                  has_both           ? RECORD_IMU
                                  : table->has_accel ? RECORD_ACC
                                                     : RECORD_GYR);
    double *gyro = record->value + (has_both ? 3 : 0);
    return (!table->has_accel || read_sensor(row, &accel_group, table->accel, record->value)) &&
           (!table->has_gyro || read_sensor(row, &gyro_group, table->gyro, gyro));
}

static bool read_records(const row_t *row, record_t *records, int *count)
{
    const table_t *table = row->table;
    if (!read_inertial(row, records, count)) {
        return false;
    }
    if (table->has_mag &&
        !read_sensor(row, &mag_group, table->mag, add_record(records, count, RECORD_MAG)->value)) {
        return false;
    }
    record_kind_t place = table->is_track ? RECORD_TRACK : RECORD_TRUTH;
    return !table->has_place || read_place(row, add_record(records, count, place)->value);
}

bool table_parse_row(const table_t *table, fields_t *fields, record_t records[TABLE_RECORDS],
                     int *count, const line_reader_t *line, failure_t *failure)
{
    fields_drop_comment(fields, -1);
    if (fields->count != table->columns) {
        line_reader_fail(line, failure, "row has %d fields: expected %d as in the header",
                         fields->count, table->columns);
        return false;
    }
    int64_t t_us;
    row_t row = {table, fields, line, failure};
    *count = 0;
    if (!record_line_time(fields->at[table->t], &t_us, line, failure) ||
        !read_records(&row, records, count)) {
        return false;
    }
    for (int i = 0; i < *count; i++) {
        records[i].t_us = t_us;
    }
    return true;
}
