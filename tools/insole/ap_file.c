/* SPDX-License-Identifier: MIT */
#include "ap_file.h"

#include <stdlib.h>
#include <string.h>

#include "fields.h"
#include "line_reader.h"
#include "memory.h"
#include "nearest.h"
#include "number.h"

#define HEADER "id,x,y,z,p0_dbm,exponent,near_dbm"

enum { ID, X, Y, Z, P0, EXPONENT, NEAR, COLUMNS, NEEDED = Z, ID_LENGTH = 63 };

static const struct {
    const char *name;
    double low, high;
} columns[COLUMNS] = {{"id", 0.0, 0.0},          {"x", -1e5, 1e5},         {"y", -1e5, 1e5},
                      {"z", -1e4, 1e4},          {"p0_dbm", -150.0, 50.0}, {"exponent", 0.5, 10.0},
                      {"near_dbm", -150.0, 50.0}};

typedef struct {
    ap_file_t *aps;
    const insole_propagation_config_t *propagation;
    line_reader_t lines;
    fields_t fields;
    failure_t *failure;
    int at[COLUMNS]; /* field of each column; -1: the file does not have it */
    int field_count; /* 0 before the header */
} reader_t;

/* ---- header ----------------------------------------------------------------------------- */

static bool refuse_column(reader_t *reader, const char *name)
{
    nearest_t nearest;
    nearest_begin(&nearest, name);
    for (int i = P0; i < COLUMNS; i++) {
        nearest_offer(&nearest, columns[i].name);
    }
    line_reader_fail(&reader->lines, reader->failure,
                     "unknown column \"%.40s\": expected some of " HEADER, name);
    return nearest.best != NULL && failure_add(reader->failure, " (%s?)", nearest.best);
}

static bool place_column(reader_t *reader, int field)
{
    const char *name = reader->fields.at[field];
    int column = 0;
    while (column < COLUMNS && strcmp(columns[column].name, name) != 0) {
        column++;
    }
    if (column == COLUMNS) {
        return refuse_column(reader, name);
    }
    if (reader->at[column] >= 0) {
        line_reader_fail(&reader->lines, reader->failure,
                         "column %s comes twice: expected each once", name);
        return false;
    }
    reader->at[column] = field;
    return true;
}

static bool read_header(reader_t *reader)
{
    fields_drop_comment(&reader->fields, -1);
    reader->field_count = reader->fields.count;
    for (int i = 0; i < COLUMNS; i++) {
        reader->at[i] = -1;
    }
    for (int i = 0; i < reader->field_count && i < FIELDS_MAX; i++) {
        if (!place_column(reader, i)) {
            return false;
        }
    }
    for (int i = 0; i < NEEDED; i++) {
        if (reader->at[i] < 0) {
            line_reader_fail(&reader->lines, reader->failure,
                             "header has no column %s: expected " HEADER
                             ", of which id,x,y must be there",
                             columns[i].name);
            return false;
        }
    }
    return true;
}

/* ---- rows ------------------------------------------------------------------------------- */

/* What the row tells of a column; what it does not tell leaves `*number` as it is. */
static bool read_number(reader_t *reader, int column, double *number)
{
    char low[NUMBER_ROOM], high[NUMBER_ROOM];
    const char *text = reader->at[column] < 0 ? "" : reader->fields.at[reader->at[column]];
    if (*text == '\0' && column >= NEEDED) {
        return true;
    }
    if (!number_parse(text, number)) {
        line_reader_fail(&reader->lines, reader->failure, "%s \"%.40s\" is not a number",
                         columns[column].name, text);
        return false;
    }
    if (*number < columns[column].low || *number > columns[column].high) {
        line_reader_fail(&reader->lines, reader->failure,
                         "%s %.40s is out of range: expected %s to %s", columns[column].name, text,
                         number_short(low, columns[column].low),
                         number_short(high, columns[column].high));
        return false;
    }
    return true;
}

static bool check_id(reader_t *reader, const char *id)
{
    uint32_t other;
    if (*id == '\0' || strlen(id) > ID_LENGTH) {
        line_reader_fail(&reader->lines, reader->failure, "id of %u characters: expected 1 to %d",
                         (unsigned)strlen(id), ID_LENGTH);
        return false;
    }
    if (id_table_find(&reader->aps->ids, id, &other)) {
        line_reader_fail(&reader->lines, reader->failure,
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
    fields_drop_comment(&reader->fields, reader->at[ID]);
    if (reader->fields.count != reader->field_count) {
        line_reader_fail(&reader->lines, reader->failure,
                         "row has %d fields: expected %d as in the header", reader->fields.count,
                         reader->field_count);
        return false;
    }
    const char *id = reader->fields.at[reader->at[ID]];
    for (int i = X; i < COLUMNS; i++) {
        if (!read_number(reader, i, &number[i])) {
            return false;
        }
    }
    if (!check_id(reader, id)) {
        return false;
    }
    insole_ap_t ap = make_ap(reader->propagation, number);
    add_ap(reader->aps, id, reader->lines.number, &ap);
    return true;
}

/* ---- file ------------------------------------------------------------------------------- */

static bool read_lines(reader_t *reader)
{
    read_t answer;
    while ((answer = line_reader_next(&reader->lines, reader->failure)) == READ_ONE) {
        fields_split(&reader->fields, reader->lines.text);
        if (reader->fields.count > 0 &&
            !(reader->field_count == 0 ? read_header(reader) : read_row(reader))) {
            return false;
        }
    }
    if (answer == READ_END && reader->aps->count == 0u) {
        return failure_input(reader->failure,
                             "%s: no access points: expected a header, " HEADER
                             ", and at least one row",
                             reader->lines.name);
    }
    return answer == READ_END;
}

static bool read_all(reader_t *reader)
{
    reader->aps->name = memory_text(reader->lines.name);
    bool is_good = read_lines(reader);
    line_reader_close(&reader->lines);
    if (!is_good) {
        ap_file_free(reader->aps);
    }
    return is_good;
}

static reader_t begin(ap_file_t *aps, const insole_propagation_config_t *propagation,
                      failure_t *failure)
{
    reader_t reader;
    memset(&reader, 0, sizeof reader);
    memset(aps, 0, sizeof *aps);
    reader.aps = aps;
    reader.propagation = propagation;
    reader.failure = failure;
    return reader;
}

bool ap_file_read(ap_file_t *aps, const char *path, const insole_propagation_config_t *propagation,
                  failure_t *failure)
{
    reader_t reader = begin(aps, propagation, failure);
    return line_reader_open(&reader.lines, path, failure) && read_all(&reader);
}

bool ap_file_take(ap_file_t *aps, FILE *file, const char *name,
                  const insole_propagation_config_t *propagation, failure_t *failure)
{
    reader_t reader = begin(aps, propagation, failure);
    line_reader_attach(&reader.lines, file, name);
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
    fputs(HEADER "\n", file);
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
