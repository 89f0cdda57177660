/* SPDX-License-Identifier: MIT */
#include "sim/aps.h"

#include <math.h>
#include <string.h>

#include "sim/text.h"

/* A column that holds a number, and where it goes. */
typedef struct {
    const char *name;
    size_t offset;
    double low, high;
} column_t;

static const column_t columns[] = {
    {"x", offsetof(sim_ap_t, x_m), -1e5, 1e5},
    {"y", offsetof(sim_ap_t, y_m), -1e5, 1e5},
    {"z", offsetof(sim_ap_t, z_m), -1e4, 1e4},
    {"p0_dbm", offsetof(sim_ap_t, p0_dbm), -150.0, 50.0},
    {"exponent", offsetof(sim_ap_t, exponent), 0.5, 10.0},
    {"near_dbm", offsetof(sim_ap_t, near_dbm), -150.0, 50.0},
};

enum { NUMBERS = sizeof columns / sizeof columns[0], ID = NUMBERS, MOST_COLUMNS = NUMBERS + 1 };

typedef struct {
    sim_list_t *aps;
    size_t kinds[MOST_COLUMNS]; /* of the file's columns: a number of `columns`, or ID */
    size_t count;               /* of the file's columns; 0 before the header */
} reader_t;

static size_t kind_of(const char *name)
{
    size_t kind = 0;
    while (kind < NUMBERS && strcmp(columns[kind].name, name) != 0) {
        kind++;
    }
    return kind == NUMBERS && strcmp(name, "id") != 0 ? MOST_COLUMNS : kind;
}

static bool has(const reader_t *reader, size_t kind)
{
    for (size_t i = 0; i < reader->count; i++) {
        if (reader->kinds[i] == kind) {
            return true;
        }
    }
    return false;
}

static bool read_header(reader_t *reader, char *rest, sim_error_t *error)
{
    for (char *name = sim_text_field(&rest); name != NULL; name = sim_text_field(&rest)) {
        size_t kind = kind_of(name);
        if (kind == MOST_COLUMNS || has(reader, kind)) {
            return sim_fail(error,
                            "the column '%.60s' is unknown or comes twice, expected a header of "
                            "id,x,y,z,p0_dbm,exponent,near_dbm",
                            name);
        }
        reader->kinds[reader->count++] = kind;
    }
    return (has(reader, ID) && has(reader, 0) && has(reader, 1)) ||
           sim_fail(error,
                    "the header lacks id, x or y, expected id,x,y,z,p0_dbm,exponent,near_dbm");
}

static bool read_id(const reader_t *reader, const char *text, sim_ap_t *ap, sim_error_t *error)
{
    size_t length = strlen(text);
    if (length == 0 || length >= SIM_AP_ID_BYTES) {
        return sim_fail(error, "an id of %u characters, expected 1 to %d", (unsigned)length,
                        SIM_AP_ID_BYTES - 1);
    }
    for (size_t i = 0; i < reader->aps->count; i++) {
        if (strcmp(((const sim_ap_t *)sim_list_at(reader->aps, i))->id, text) == 0) {
            return sim_fail(error, "the id '%s' comes twice, expected another", text);
        }
    }
    memcpy(ap->id, text, length + 1);
    return true;
}

/* An empty field tells nothing, which x and y must not do. */
static bool read_field(const reader_t *reader, size_t kind, const char *text, sim_ap_t *ap,
                       sim_error_t *error)
{
    if (kind == ID) {
        return read_id(reader, text, ap, error);
    }
    const column_t *column = &columns[kind];
    double number;
    if (*text == '\0' && kind > 1) {
        return true;
    }
    if (!sim_text_number(text, column->name, column->low, column->high, &number, error)) {
        return false;
    }
    memcpy((unsigned char *)ap + column->offset, &number, sizeof number);
    return true;
}

static bool read_ap(reader_t *reader, char *rest, sim_error_t *error)
{
    sim_ap_t ap = {"", nan(""), nan(""), nan(""), nan(""), nan(""), nan("")};
    for (size_t i = 0; i < reader->count; i++) {
        const char *text = sim_text_field(&rest);
        if (text == NULL) {
            return sim_fail(error, "too few fields, expected %u", (unsigned)reader->count);
        }
        if (!read_field(reader, reader->kinds[i], text, &ap, error)) {
            return false;
        }
    }
    if (rest != NULL) {
        return sim_fail(error, "too many fields, expected %u", (unsigned)reader->count);
    }
    return sim_list_add(reader->aps, &ap) || sim_fail(error, "out of memory");
}

static bool read_line(void *state, char *line, int number, sim_error_t *error)
{
    reader_t *reader = state;
    (void)number;
    return reader->count == 0 ? read_header(reader, line, error) : read_ap(reader, line, error);
}

bool sim_aps_read(FILE *stream, sim_list_t *aps, sim_error_t *error)
{
    *aps = sim_list(sizeof(sim_ap_t));
    reader_t reader = {.aps = aps};
    int lines;
    bool good = sim_text_lines(stream, read_line, &reader, &lines, error);
    if (good && aps->count == 0) {
        sim_fail(error, "no access points, expected a header and at least one");
        good = sim_fail_on_line(error, lines + 1);
    }
    if (!good) {
        sim_list_free(aps);
    }
    return good;
}
