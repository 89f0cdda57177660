/* SPDX-License-Identifier: MIT */
#include "radiomap_file.h"

#include <stdlib.h>
#include <string.h>

#include "columns.h"
#include "memory.h"
#include "number.h"

enum { X, Y, ID, MEAN, STD, COUNT, COLUMNS, NEEDED = STD, PLACE_ROOM = 2 * NUMBER_ROOM };

static const column_t names[COLUMNS] = {{"x", -1e5, 1e5},        {"y", -1e5, 1e5},
                                        {"id", 0.0, 0.0},        {"mean_dbm", -127.5, 0.0},
                                        {"std_dbm", 0.0, 127.0}, {"count", 1.0, 1e6}};
static const columns_layout_t layout = {names, COLUMNS, NEEDED, ID};

/* A row. */
typedef struct {
    uint32_t point, ap;
    double mean_dbm, std_db;
    uint32_t count;
    unsigned long line;
} entry_t;

typedef struct {
    radiomap_file_t *file;
    columns_t columns;
    failure_t *failure;
    id_table_t places; /* of the points, as text */
    id_table_t ids;    /* in order of appearance */
    insole_spot_t *spots;
    entry_t *entries;
    size_t spot_room, count, room;
} reader_t;

/* ---- rows ------------------------------------------------------------------------------- */

/* The point at a place; as many as there are when it is new. The place counts as it is kept. */
static uint32_t point_at(reader_t *reader, insole_spot_t spot)
{
    char x[NUMBER_ROOM], y[NUMBER_ROOM], place[PLACE_ROOM];
    snprintf(place, sizeof place, "%s,%s", number_fixed(x, (double)spot.x_m, 3),
             number_fixed(y, (double)spot.y_m, 3));
    size_t known = reader->places.count;
    uint32_t point = id_table_number(&reader->places, place);
    if (point == known) {
        reader->spots = memory_room(reader->spots, &reader->spot_room, known + 1u, sizeof spot);
        reader->spots[known] = spot;
    }
    return point;
}

static bool check_limits(const reader_t *reader)
{
    const struct {
        size_t count, most;
        const char *what;
    } limits[] = {{reader->places.count, RADIOMAP_FILE_POINTS, "points"},
                  {reader->ids.count, INSOLE_RADIO_APS_MAX, "access points"},
                  {reader->count, RADIOMAP_FILE_ENTRIES, "rows"}};
    for (size_t i = 0u; i < sizeof limits / sizeof limits[0]; i++) {
        if (limits[i].count > limits[i].most) {
            line_reader_fail(&reader->columns.lines, reader->failure,
                             "too many %s: expected at most %lu", limits[i].what,
                             (unsigned long)limits[i].most);
            return false;
        }
    }
    return true;
}

static bool is_whole(const reader_t *reader, double count)
{
    char number[NUMBER_ROOM];
    if (count == floor(count)) {
        return true;
    }
    line_reader_fail(&reader->columns.lines, reader->failure,
                     "count %s is not a whole number: expected 1 to 1000000",
                     number_short(number, count));
    return false;
}

static bool read_row(reader_t *reader)
{
    double number[COLUMNS] = {0.0, 0.0, 0.0, 0.0, 0.0, 1.0};
    for (int i = 0; i < COLUMNS; i++) {
        if (i != ID && !columns_number(&reader->columns, i, &number[i], reader->failure)) {
            return false;
        }
    }
    const char *id = columns_id(&reader->columns, reader->failure);
    if (id == NULL || !is_whole(reader, number[COUNT])) {
        return false;
    }
    const insole_spot_t spot = {(insole_real_t)number[X], (insole_real_t)number[Y]};
    const entry_t entry = {
        point_at(reader, spot),  id_table_number(&reader->ids, id), number[MEAN], number[STD],
        (uint32_t)number[COUNT], reader->columns.lines.number};
    reader->entries = memory_room(reader->entries, &reader->room, reader->count + 1u, sizeof entry);
    reader->entries[reader->count++] = entry;
    return check_limits(reader);
}

/* ---- order ------------------------------------------------------------------------------ */

typedef struct {
    const char *name;
    uint32_t number;
} named_t;

static int compare_names(const void *a, const void *b)
{
    return strcmp(((const named_t *)a)->name, ((const named_t *)b)->name);
}

void radiomap_file_sort_ids(const id_table_t *ids, id_table_t *sorted, uint32_t *numbers)
{
    named_t *named = memory_new(ids->count, sizeof *named);
    for (size_t i = 0u; i < ids->count; i++) {
        named[i].name = ids->names[i];
        named[i].number = (uint32_t)i;
    }
    qsort(named, ids->count, sizeof *named, compare_names);
    id_table_init(sorted);
    for (size_t i = 0u; i < ids->count; i++) {
        numbers[named[i].number] = id_table_number(sorted, named[i].name);
    }
    free(named);
}

static int compare_entries(const void *a, const void *b)
{
    const entry_t *s = a, *t = b;
    if (s->point != t->point) {
        return s->point < t->point ? -1 : 1;
    }
    if (s->ap != t->ap) {
        return s->ap < t->ap ? -1 : 1;
    }
    return (s->line > t->line) - (s->line < t->line);
}

static void sort_rows(reader_t *reader)
{
    uint32_t *numbers = memory_new(reader->ids.count, sizeof *numbers);
    radiomap_file_sort_ids(&reader->ids, &reader->file->ids, numbers);
    for (size_t i = 0u; i < reader->count; i++) {
        reader->entries[i].ap = numbers[reader->entries[i].ap];
    }
    qsort(reader->entries, reader->count, sizeof *reader->entries, compare_entries);
    free(numbers);
}

/* Of rows that tell a thing twice the first in the file is named. */
static bool check_twice(const reader_t *reader)
{
    const entry_t *first = NULL;
    for (size_t i = 1u; i < reader->count; i++) {
        const entry_t *a = &reader->entries[i - 1u], *b = a + 1;
        if (a->point == b->point && a->ap == b->ap && (first == NULL || b->line < first->line)) {
            first = b;
        }
    }
    return first == NULL ||
           failure_input(
               reader->failure, "%s:%lu: id \"%s\" comes twice at %s: it is there in line %lu",
               reader->columns.lines.name, first->line, reader->file->ids.names[first->ap],
               reader->places.names[first->point], first[-1].line);
}

/* ---- map -------------------------------------------------------------------------------- */

void radiomap_file_make_room(insole_radio_map_memory_t *memory, uint32_t points, uint32_t entries,
                             bool has_spread, bool has_counts)
{
    memset(memory, 0, sizeof *memory);
    memory->point_room = points;
    memory->entry_room = entries;
    memory->spots = memory_new(points, sizeof *memory->spots);
    memory->first = memory_new((size_t)points + 1u, sizeof *memory->first);
    memory->aps = memory_new(entries, sizeof *memory->aps);
    memory->below = memory_new(entries, sizeof *memory->below);
    memory->spread = has_spread ? memory_new(entries, sizeof *memory->spread) : NULL;
    memory->visits = has_counts ? memory_new(points, sizeof *memory->visits) : NULL;
    memory->counts = has_counts ? memory_new(entries, sizeof *memory->counts) : NULL;
}

/* Counts are kept as bytes: beyond 255 they are told on the scale of the largest of the point. */
static uint8_t scaled(uint32_t count, uint32_t visits)
{
    double scale = visits > 255u ? 255.0 / (double)visits : 1.0;
    return (uint8_t)fmax(1.0, floor(scale * (double)count + 0.5));
}

static void fill_entry(insole_radio_map_memory_t *memory, size_t at, const entry_t *entry,
                       uint32_t visits)
{
    memory->aps[at] = (uint16_t)entry->ap;
    memory->below[at] = insole_radio_level((insole_real_t)entry->mean_dbm);
    if (memory->spread != NULL) {
        memory->spread[at] = (uint8_t)fmin(floor(8.0 * entry->std_db + 0.5), 255.0);
    }
    if (memory->counts != NULL) {
        memory->counts[at] = scaled(entry->count, visits);
    }
}

/* Fills one point from the sorted row `begin` on. @return the row after its last */
static size_t fill_point(const reader_t *reader, size_t begin)
{
    insole_radio_map_memory_t *memory = &reader->file->memory;
    uint32_t point = reader->entries[begin].point, visits = 0u;
    size_t end = begin;
    for (; end < reader->count && reader->entries[end].point == point; end++) {
        visits = reader->entries[end].count > visits ? reader->entries[end].count : visits;
    }
    for (size_t i = begin; i < end; i++) {
        fill_entry(memory, i, &reader->entries[i], visits);
    }
    if (memory->visits != NULL) {
        memory->visits[point] = scaled(visits, visits);
    }
    memory->spots[point] = reader->spots[point];
    memory->first[point + 1u] = (uint32_t)end;
    return end;
}

static void fill(const reader_t *reader)
{
    radiomap_file_t *file = reader->file;
    insole_radio_map_memory_t *memory = &file->memory;
    uint32_t points = (uint32_t)reader->places.count;
    radiomap_file_make_room(memory, points, (uint32_t)reader->count,
                            columns_has(&reader->columns, STD),
                            columns_has(&reader->columns, COUNT));
    for (size_t i = 0u; i < reader->count;) {
        i = fill_point(reader, i);
    }
    const insole_radio_map_t map = {points,         (uint32_t)file->ids.count,
                                    memory->spots,  memory->first,
                                    memory->visits, memory->aps,
                                    memory->below,  memory->spread,
                                    memory->counts, NULL};
    file->map = map;
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
    if (answer == READ_END && reader->count == 0u) {
        return failure_input(reader->failure,
                             "%s: no fingerprints: expected a header, %s, and at least one row",
                             reader->columns.lines.name, columns_text(&layout, COLUMNS, header));
    }
    return answer == READ_END;
}

static bool read_all(reader_t *reader)
{
    radiomap_file_t *file = reader->file;
    file->name = memory_text(reader->columns.lines.name);
    bool is_good = read_rows(reader);
    if (is_good) {
        sort_rows(reader);
        is_good = check_twice(reader);
    }
    if (is_good) {
        fill(reader);
    } else {
        radiomap_file_free(file);
    }
    columns_close(&reader->columns);
    id_table_free(&reader->places);
    id_table_free(&reader->ids);
    free(reader->spots);
    free(reader->entries);
    return is_good;
}

static void begin(reader_t *reader, radiomap_file_t *file, failure_t *failure)
{
    memset(reader, 0, sizeof *reader);
    memset(file, 0, sizeof *file);
    reader->file = file;
    reader->failure = failure;
}

bool radiomap_file_read(radiomap_file_t *file, const char *path, failure_t *failure)
{
    reader_t reader;
    begin(&reader, file, failure);
    return columns_open(&reader.columns, &layout, path, failure) && read_all(&reader);
}

bool radiomap_file_take(radiomap_file_t *file, FILE *stream, const char *name, failure_t *failure)
{
    reader_t reader;
    begin(&reader, file, failure);
    columns_attach(&reader.columns, &layout, stream, name);
    return read_all(&reader);
}

uint32_t radiomap_file_number(const radiomap_file_t *file, const id_table_t *ids, uint32_t id)
{
    uint32_t number;
    return id < ids->count && id_table_find(&file->ids, ids->names[id], &number)
               ? number
               : RADIOMAP_FILE_UNKNOWN;
}

size_t radiomap_file_bytes(const insole_radio_map_t *map)
{
    size_t points = map->point_count, entries = map->first[points];
    size_t per_point = sizeof *map->spots + sizeof *map->first + (map->visits != NULL ? 1u : 0u);
    size_t per_entry = sizeof *map->aps + sizeof *map->below + (map->spread != NULL ? 1u : 0u) +
                       (map->counts != NULL ? 1u : 0u) +
                       (map->bins != NULL ? (size_t)INSOLE_RADIO_BINS : 0u);
    return points * per_point + sizeof *map->first + entries * per_entry;
}

static void write_entry(FILE *stream, const radiomap_file_t *file, uint32_t point, uint32_t entry)
{
    const insole_radio_map_t *map = &file->map;
    char x[NUMBER_ROOM], y[NUMBER_ROOM], number[NUMBER_ROOM];
    fprintf(stream, "%s,%s,%s", number_fixed(x, (double)map->spots[point].x_m, 3),
            number_fixed(y, (double)map->spots[point].y_m, 3), file->ids.names[map->aps[entry]]);
    fprintf(stream, ",%s", number_fixed(number, (double)insole_radio_map_mean_dbm(map, entry), 1));
    if (map->spread != NULL) {
        fprintf(stream, ",%s",
                number_fixed(number, (double)insole_radio_map_std_db(map, entry), 3));
    }
    if (map->counts != NULL) {
        fprintf(stream, ",%u", (unsigned)map->counts[entry]);
    }
    putc('\n', stream);
}

void radiomap_file_write(FILE *stream, const radiomap_file_t *file)
{
    const insole_radio_map_t *map = &file->map;
    char header[COLUMNS_TEXT];
    fprintf(stream, "%s%s%s\n", columns_text(&layout, NEEDED, header),
            map->spread != NULL ? ",std_dbm" : "", map->counts != NULL ? ",count" : "");
    for (uint32_t i = 0u; i < map->point_count; i++) {
        for (uint32_t k = map->first[i]; k < map->first[i + 1u]; k++) {
            write_entry(stream, file, i, k);
        }
    }
}

void radiomap_file_free(radiomap_file_t *file)
{
    insole_radio_map_memory_t *memory = &file->memory;
    id_table_free(&file->ids);
    free(memory->spots);
    free(memory->first);
    free(memory->visits);
    free(memory->aps);
    free(memory->below);
    free(memory->spread);
    free(memory->counts);
    free(memory->bins);
    free(file->name);
    memset(file, 0, sizeof *file);
}
