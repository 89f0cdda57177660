/* SPDX-License-Identifier: MIT */
#include "track_writer.h"

#include <math.h>
#include <string.h>

#include "number.h"
#include "output.h"

enum { METRES_DECIMALS = 4, RADIAN_DECIMALS = 5, VARIANCE_DECIMALS = 6, QUATERNION_DECIMALS = 7 };

bool track_format_parse(const char *name, track_format_t *format, failure_t *failure)
{
    static const char *const names[] = {"csv", "tum", "geojson"};
    for (int i = 0; i < 3; i++) {
        if (strcmp(name, names[i]) == 0) {
            *format = (track_format_t)i;
            return true;
        }
    }
    return failure_usage(failure, "insole: --format %s: expected csv, tum or geojson", name);
}

bool track_writer_open(track_writer_t *writer, const char *path, track_format_t format,
                       bool is_live, failure_t *failure)
{
    memset(writer, 0, sizeof *writer);
    writer->path = path;
    writer->format = format;
    writer->is_live = is_live;
    if (!output_open(&writer->file, path, failure)) {
        return false;
    }
    if (writer->file != NULL && format == TRACK_CSV) {
        fputs("t,x,y,z,heading,var_x,cov_xy,var_y,var_z,var_heading,state\n", writer->file);
    }
    return true;
}

static void write_number(FILE *file, char separator, double value, int decimals)
{
    char number[NUMBER_ROOM];
    putc(separator, file);
    fputs(number_fixed(number, value, decimals), file);
}

static void write_time_and_place(FILE *file, char separator, const track_row_t *row)
{
    char time[NUMBER_ROOM];
    fputs(number_time(time, row->t_us), file);
    write_number(file, separator, row->x_m, METRES_DECIMALS);
    write_number(file, separator, row->y_m, METRES_DECIMALS);
    write_number(file, separator, row->z_m, METRES_DECIMALS);
}

static void write_csv(FILE *file, const track_row_t *row)
{
    write_time_and_place(file, ',', row);
    write_number(file, ',', row->heading_rad, RADIAN_DECIMALS);
    write_number(file, ',', row->var_x_m2, VARIANCE_DECIMALS);
    write_number(file, ',', row->cov_xy_m2, VARIANCE_DECIMALS);
    write_number(file, ',', row->var_y_m2, VARIANCE_DECIMALS);
    write_number(file, ',', row->var_z_m2, VARIANCE_DECIMALS);
    write_number(file, ',', row->var_heading_rad2, VARIANCE_DECIMALS);
    fprintf(file, ",%s\n", track_state_name(row->state));
}

/* The attitude of a walker who stands upright and looks where they go. */
static void write_tum(FILE *file, const track_row_t *row)
{
    write_time_and_place(file, ' ', row);
    write_number(file, ' ', 0.0, QUATERNION_DECIMALS);
    write_number(file, ' ', 0.0, QUATERNION_DECIMALS);
    write_number(file, ' ', sin(0.5 * row->heading_rad), QUATERNION_DECIMALS);
    write_number(file, ' ', cos(0.5 * row->heading_rad), QUATERNION_DECIMALS);
    putc('\n', file);
}

static void write_times(FILE *file, const track_t *track)
{
    char time[NUMBER_ROOM];
    for (size_t i = 0u; i < track->count; i++) {
        fprintf(file, "%s%s", i == 0u ? "" : ",", number_time(time, track->rows[i].t_us));
    }
}

static void write_coordinates(FILE *file, const track_t *track)
{
    for (size_t i = 0u; i < track->count; i++) {
        fputs(i == 0u ? "\n" : ",\n", file);
        write_number(file, '[', track->rows[i].x_m, METRES_DECIMALS);
        write_number(file, ',', track->rows[i].y_m, METRES_DECIMALS);
        write_number(file, ',', track->rows[i].z_m, METRES_DECIMALS);
        putc(']', file);
    }
}

static void write_geojson(FILE *file, const track_t *track)
{
    fputs("{\"type\":\"FeatureCollection\",\"features\":[{\"type\":\"Feature\",\n"
          "\"properties\":{\"unit\":\"m\",\"t\":[",
          file);
    write_times(file, track);
    fputs("]},\n\"geometry\":", file);
    if (track->count < 2u) { /* no line */
        fputs("null", file);
    } else {
        fputs("{\"type\":\"LineString\",\"coordinates\":[", file);
        write_coordinates(file, track);
        fputs("]}", file);
    }
    fputs("}]}\n", file);
}

bool track_writer_row(track_writer_t *writer, const track_row_t *row, failure_t *failure)
{
    if (writer->file == NULL) {
        return true;
    }
    if (writer->format == TRACK_GEOJSON) {
        track_add(&writer->rows, row);
        return true;
    }
    if (writer->format == TRACK_CSV) {
        write_csv(writer->file, row);
    } else {
        write_tum(writer->file, row);
    }
    return !writer->is_live || output_flush(writer->file, writer->path, failure);
}

bool track_writer_close(track_writer_t *writer, failure_t *failure)
{
    if (writer->file != NULL && writer->format == TRACK_GEOJSON) {
        write_geojson(writer->file, &writer->rows);
    }
    track_free(&writer->rows);
    bool is_good = output_close(writer->file, writer->path, failure);
    writer->file = NULL;
    return is_good;
}
