/* SPDX-License-Identifier: MIT */
#include "plan_file.h"

#include <stdlib.h>
#include <string.h>

#include "fields.h"
#include "line_reader.h"
#include "memory.h"
#include "nearest.h"
#include "number.h"

static const double highest_m = 10000.0;
static const int64_t highest_floor = 1000;

typedef struct {
    plan_file_t *plan;
    line_reader_t lines;
    failure_t *failure;
    const char *form; /* of the record that is being read, for messages */
    double ring_db;   /* loss of the rings that come */
} reader_t;

static bool refuse(reader_t *reader, const char *what)
{
    line_reader_fail(&reader->lines, reader->failure, "%s: expected %s", what, reader->form);
    return false;
}

static bool read_number(reader_t *reader, const char *text, const char *what, double low,
                        double high, double *number)
{
    char low_text[NUMBER_ROOM], high_text[NUMBER_ROOM];
    if (!number_parse(text, number)) {
        line_reader_fail(&reader->lines, reader->failure,
                         "%s \"%.40s\" is not a number: expected %s", what, text, reader->form);
        return false;
    }
    if (*number < low || *number > high) {
        line_reader_fail(&reader->lines, reader->failure,
                         "%s %.40s is out of range: expected %s to %s", what, text,
                         number_short(low_text, low), number_short(high_text, high));
        return false;
    }
    return true;
}

static bool read_loss(reader_t *reader, char **rest, double *loss_db)
{
    const char *text = fields_next(rest);
    return text == NULL ? refuse(reader, "too few fields")
                        : read_number(reader, text, "loss", 0.0, PLAN_FILE_LOSS_DB, loss_db);
}

/* ---- lines ------------------------------------------------------------------------------ */

static void add_point(plan_line_t *line, plan_point_t point)
{
    line->points = memory_room(line->points, &line->room, line->count + 1u, sizeof *line->points);
    line->points[line->count++] = point;
}

static bool read_points(reader_t *reader, char *rest, plan_line_t *line)
{
    for (const char *x = fields_next(&rest); x != NULL; x = fields_next(&rest)) {
        plan_point_t point;
        const char *y = fields_next(&rest);
        if (y == NULL) {
            return refuse(reader, "the last point has no y");
        }
        if (!read_number(reader, x, "x", -PLAN_FILE_LIMIT_M, PLAN_FILE_LIMIT_M, &point.x_m) ||
            !read_number(reader, y, "y", -PLAN_FILE_LIMIT_M, PLAN_FILE_LIMIT_M, &point.y_m)) {
            return false;
        }
        add_point(line, point);
    }
    return true;
}

static bool is_same_place(plan_point_t a, plan_point_t b)
{
    return a.x_m == b.x_m && a.y_m == b.y_m;
}

static bool has_enough_points(reader_t *reader, const plan_line_t *line)
{
    size_t least = line->kind == INSOLE_LINE_WALL ? 2u : 3u;
    if (line->count < least) {
        line_reader_fail(&reader->lines, reader->failure,
                         "%s of %u point%s: expected at least %u, %s",
                         plan_line_kind_name(line->kind), (unsigned)line->count,
                         line->count == 1u ? "" : "s", (unsigned)least, reader->form);
        return false;
    }
    return true;
}

static plan_floor_t *add_floor(plan_file_t *plan)
{
    plan->floors =
        memory_room(plan->floors, &plan->floor_room, plan->floor_count + 1u, sizeof *plan->floors);
    plan_floor_t *floor = &plan->floors[plan->floor_count++];
    memset(floor, 0, sizeof *floor);
    return floor;
}

/* The new line is the plan's at once, so that it is freed with the plan whatever comes. */
static plan_line_t *add_line(reader_t *reader, insole_line_kind_t kind)
{
    plan_file_t *plan = reader->plan;
    if (plan->floor_count == 0u) {
        add_floor(plan)->name = memory_text("");
    }
    plan->lines = memory_room(plan->lines, &plan->room, plan->count + 1u, sizeof *plan->lines);
    plan_line_t *line = &plan->lines[plan->count++];
    memset(line, 0, sizeof *line);
    line->kind = kind;
    line->number = reader->lines.number;
    line->floor = plan->floor_count - 1u;
    line->loss_db = reader->ring_db;
    return line;
}

static bool read_ring(reader_t *reader, insole_line_kind_t kind, char *rest)
{
    plan_line_t *line = add_line(reader, kind);
    if (!read_points(reader, rest, line)) {
        return false;
    }
    if (line->count > 1u && is_same_place(line->points[0], line->points[line->count - 1u])) {
        line->count--;
    }
    return has_enough_points(reader, line);
}

static bool read_outline(reader_t *reader, char *rest)
{
    return read_ring(reader, INSOLE_LINE_OUTLINE, rest);
}

static bool read_hole(reader_t *reader, char *rest)
{
    return read_ring(reader, INSOLE_LINE_HOLE, rest);
}

static bool read_wall(reader_t *reader, char *rest)
{
    plan_line_t *line = add_line(reader, INSOLE_LINE_WALL);
    return read_loss(reader, &rest, &line->loss_db) && read_points(reader, rest, line) &&
           has_enough_points(reader, line);
}

/* ---- other records ---------------------------------------------------------------------- */

static bool read_ring_loss(reader_t *reader, char *rest)
{
    return read_loss(reader, &rest, &reader->ring_db) &&
           (rest == NULL || refuse(reader, "too many fields"));
}

static bool is_new_floor(reader_t *reader, int64_t number)
{
    for (size_t i = 0u; i < reader->plan->floor_count; i++) {
        if (reader->plan->floors[i].number == number) {
            line_reader_fail(&reader->lines, reader->failure,
                             "floor %d comes twice: expected each floor once", (int)number);
            return false;
        }
    }
    return true;
}

static bool read_floor(reader_t *reader, char *rest)
{
    const char *number_text = fields_next(&rest), *z_text = fields_next(&rest);
    const char *name = fields_next(&rest);
    int64_t number;
    double z_m;
    if (z_text == NULL) {
        return refuse(reader, "too few fields");
    }
    if (rest != NULL) {
        return refuse(reader, "too many fields");
    }
    if (!number_parse_whole(number_text, -highest_floor, highest_floor, &number)) {
        return refuse(reader, "number is not a whole number from -1000 to 1000");
    }
    if (!read_number(reader, z_text, "z", -highest_m, highest_m, &z_m) ||
        !is_new_floor(reader, number)) {
        return false;
    }
    plan_floor_t *floor = add_floor(reader->plan);
    floor->number = number;
    floor->z_m = z_m;
    floor->name = memory_text(name == NULL ? "" : name);
    floor->line = reader->lines.number;
    return true;
}

/* ---- file ------------------------------------------------------------------------------- */

static const struct {
    const char *name, *form;
    bool (*read)(reader_t *reader, char *rest);
} records[] = {{"outline", "outline,x,y,x,y,...", read_outline},
               {"hole", "hole,x,y,x,y,...", read_hole},
               {"wall", "wall,loss_db,x,y,x,y,...", read_wall},
               {"loss", "loss,dB", read_ring_loss},
               {"floor", "floor,number,z,name", read_floor}};

enum { RECORDS = sizeof records / sizeof records[0] };

static bool refuse_record(reader_t *reader, const char *name)
{
    nearest_t nearest;
    nearest_begin(&nearest, name);
    for (size_t i = 0u; i < RECORDS; i++) {
        nearest_offer(&nearest, records[i].name);
    }
    line_reader_fail(&reader->lines, reader->failure,
                     "\"%.40s\" is no part of a plan: expected outline, hole, wall, loss or floor",
                     name);
    return nearest.best != NULL && failure_add(reader->failure, " (%s?)", nearest.best);
}

static bool read_record(reader_t *reader, char *rest)
{
    const char *name = fields_next(&rest);
    for (size_t i = 0u; i < RECORDS; i++) {
        if (strcmp(records[i].name, name) == 0) {
            reader->form = records[i].form;
            return records[i].read(reader, rest);
        }
    }
    return refuse_record(reader, name);
}

/* Drops the comment, and the commas that spreadsheets add to short rows. */
static char *trimmed(char *text)
{
    text[strcspn(text, "#")] = '\0';
    for (size_t length = strlen(text); length > 0u && strchr(", \t", text[length - 1u]) != NULL;) {
        text[--length] = '\0';
    }
    return text;
}

static bool read_lines(reader_t *reader)
{
    read_t answer;
    while ((answer = line_reader_next(&reader->lines, reader->failure)) == READ_ONE) {
        char *text = trimmed(reader->lines.text);
        if (*text != '\0' && !read_record(reader, text)) {
            return false;
        }
    }
    if (answer == READ_END && reader->plan->count == 0u) {
        return failure_input(reader->failure,
                             "%s: the plan is empty: expected an outline or a wall",
                             reader->lines.name);
    }
    return answer == READ_END;
}

static bool read_all(reader_t *reader)
{
    plan_file_t *plan = reader->plan;
    plan->name = memory_text(reader->lines.name);
    bool is_good = read_lines(reader);
    line_reader_close(&reader->lines);
    if (!is_good) {
        plan_file_free(plan);
    }
    return is_good;
}

static reader_t begin(plan_file_t *plan, failure_t *failure)
{
    reader_t reader;
    memset(&reader, 0, sizeof reader);
    memset(plan, 0, sizeof *plan);
    reader.plan = plan;
    reader.failure = failure;
    reader.ring_db = NUMBER_UNKNOWN;
    return reader;
}

bool plan_file_read(plan_file_t *plan, const char *path, failure_t *failure)
{
    reader_t reader = begin(plan, failure);
    return line_reader_open(&reader.lines, path, failure) && read_all(&reader);
}

bool plan_file_take(plan_file_t *plan, FILE *file, const char *name, failure_t *failure)
{
    reader_t reader = begin(plan, failure);
    line_reader_attach(&reader.lines, file, name);
    return read_all(&reader);
}

size_t plan_line_pieces(const plan_line_t *line)
{
    return line->kind == INSOLE_LINE_WALL ? line->count - 1u : line->count;
}

plan_point_t plan_line_end(const plan_line_t *line, size_t i)
{
    return line->points[(i + 1u) % line->count];
}

const char *plan_line_kind_name(insole_line_kind_t kind)
{
    return kind == INSOLE_LINE_OUTLINE ? "outline" : kind == INSOLE_LINE_HOLE ? "hole" : "wall";
}

bool plan_file_has_outline(const plan_file_t *plan, size_t floor)
{
    for (size_t i = 0u; i < plan->count; i++) {
        if (plan->lines[i].kind == INSOLE_LINE_OUTLINE && plan->lines[i].floor == floor) {
            return true;
        }
    }
    return false;
}

void plan_file_free(plan_file_t *plan)
{
    for (size_t i = 0u; i < plan->count; i++) {
        free(plan->lines[i].points);
    }
    for (size_t i = 0u; i < plan->floor_count; i++) {
        free(plan->floors[i].name);
    }
    free(plan->lines);
    free(plan->floors);
    free(plan->name);
    memset(plan, 0, sizeof *plan);
}
