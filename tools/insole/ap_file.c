/* SPDX-License-Identifier: MIT */
#include "ap_file.h"

#include <stdlib.h>
#include <string.h>

#include "columns.h"
#include "memory.h"
#include "number.h"

enum { ID, X, Y, Z, P0, EXPONENT, NEAR, COLUMNS, NEEDED = Z };

static const column_t names[COLUMNS] = {
    {"id", 0.0, 0.0},         {"x", -1e5, 1e5},        {"y", -1e5, 1e5},          {"z", -1e4, 1e4},
    {"p0_dbm", -150.0, 50.0}, {"exponent", 0.5, 10.0}, {"near_dbm", -150.0, 50.0}};
static const columns_layout_t layout = {names, COLUMNS, NEEDED, ID};

typedef struct {
    ap_file_t *aps;
    const insole_propagation_config_t *propagation;
    columns_t columns;
    failure_t *failure;
} reader_t;

/* ---- rows ------------------------------------------------------------------------------- */

static bool is_new(const reader_t *reader, const char *id)
{
    uint32_t other;
    if (id_table_find(&reader->aps->ids, id, &other)) {
        line_reader_fail(&reader->columns.lines, reader->failure,
                         "id \"%s\" comes twice: it is that of line %lu", id,
                         reader->aps->lines[other]);
        return false;
    }
    return true;
}

/* Numbers of a row in the order of the columns; what nobody tells is unknown. */
static insole_ap_t make_ap(const insole_propagation_config_t *propagation,
                           const double number[COLUMNS])
{
    insole_ap_t ap;
    insole_propagation_config_t own = *propagation;
    if (!isnan(number[P0])) {
        own.p0_dbm = (insole_real_t)number[P0];
    }
    if (!isnan(number[EXPONENT])) {
        own.exponent = (insole_real_t)number[EXPONENT];
    }
    insole_propagation_ap(&own, (insole_real_t)number[X], (insole_real_t)number[Y],
                          (insole_real_t)number[Z], &ap);
    if (!isnan(number[NEAR])) {
        ap.near_dbm = (insole_real_t)number[NEAR];
    }
    return ap;
}

static void add_ap(ap_file_t *aps, const char *id, unsigned long line, const insole_ap_t *ap)
{
    aps->aps = memory_room(aps->aps, &aps->ap_room, aps->count + 1u, sizeof *aps->aps);
    aps->lines = memory_room(aps->lines, &aps->line_room, aps->count + 1u, sizeof *aps->lines);
    aps->aps[aps->count] = *ap;
    aps->lines[aps->count++] = line;
    id_table_number(&aps->ids, id);
}

static bool read_row(reader_t *reader)
{
    double number[COLUMNS] = {0.0,
                              NUMBER_UNKNOWN,
                              NUMBER_UNKNOWN,
                              AP_FILE_HEIGHT_M,
                              NUMBER_UNKNOWN,
                              NUMBER_UNKNOWN,
                              NUMBER_UNKNOWN};
    for (int i = X; i < COLUMNS; i++) {
        if (!columns_number(&reader->columns, i, &number[i], reader->failure)) {
            return false;
        }
    }
    const char *id = columns_id(&reader->columns, reader->failure);
    if (id == NULL || !is_new(reader, id)) {
        return false;
    }
    insole_ap_t ap = make_ap(reader->propagation, number);
    add_ap(reader->aps, id, reader->columns.lines.number, &ap);
    return true;
}

/* ---- file ------------------------------------------------------------------------------- */

static bool read_rows(reader_t *reader)
{
    char header[COLUMNS_TEXT];
    read_t answer;
    while ((answer = columns_next(&reader->columns, reader->failure)) == READ_ONE) {
        if (!read_row(reader)) {
            return false;
        }
    }
    if (answer == READ_END && reader->aps->count == 0u) {
        return failure_input(reader->failure,
                             "%s: no access points: expected a header, %s, and at least one row",
                             reader->columns.lines.name, columns_text(&layout, COLUMNS, header));
    }
    return answer == READ_END;
}

static bool read_all(reader_t *reader)
{
    reader->aps->name = memory_text(reader->columns.lines.name);
    bool is_good = read_rows(reader);
    columns_close(&reader->columns);
    if (!is_good) {
        ap_file_free(reader->aps);
    }
    return is_good;
}

static void begin(reader_t *reader, ap_file_t *aps, const insole_propagation_config_t *propagation,
                  failure_t *failure)
{
    memset(aps, 0, sizeof *aps);
    reader->aps = aps;
    reader->propagation = propagation;
    reader->failure = failure;
}

bool ap_file_read(ap_file_t *aps, const char *path, const insole_propagation_config_t *propagation,
                  failure_t *failure)
{
    reader_t reader;
    begin(&reader, aps, propagation, failure);
    return columns_open(&reader.columns, &layout, path, failure) && read_all(&reader);
}

bool ap_file_take(ap_file_t *aps, FILE *file, const char *name,
                  const insole_propagation_config_t *propagation, failure_t *failure)
{
    reader_t reader;
    begin(&reader, aps, propagation, failure);
    columns_attach(&reader.columns, &layout, file, name);
    return read_all(&reader);
}

uint32_t ap_file_number(const ap_file_t *aps, const id_table_t *ids, uint32_t id)
{
    uint32_t number;
    return id < ids->count && id_table_find(&aps->ids, ids->names[id], &number) ? number
                                                                                : AP_FILE_UNKNOWN;
}

static void write_number(FILE *file, insole_real_t value, int decimals)
{
    char number[NUMBER_ROOM];
    fprintf(file, ",%s", number_fixed(number, (double)value, decimals));
}

void ap_file_write(FILE *file, const id_table_t *ids, const insole_ap_t *aps)
{
    char header[COLUMNS_TEXT];
    fprintf(file, "%s\n", columns_text(&layout, COLUMNS, header));
    for (size_t i = 0u; i < ids->count; i++) {
        fputs(ids->names[i], file);
        write_number(file, aps[i].x_m, 3);
        write_number(file, aps[i].y_m, 3);
        write_number(file, aps[i].z_m, 3);
        write_number(file, aps[i].p0_dbm, 1);
        write_number(file, aps[i].exponent, 2);
        write_number(file, aps[i].near_dbm, 1);
        fputc('\n', file);
    }
}

void ap_file_free(ap_file_t *aps)
{
    id_table_free(&aps->ids);
    free(aps->aps);
    free(aps->lines);
    free(aps->name);
    memset(aps, 0, sizeof *aps);
}
