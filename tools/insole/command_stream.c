/* SPDX-License-Identifier: MIT */
#include "command.h"

#include <stdio.h>
#include <string.h>

#include "number.h"
#include "output.h"
#include "sensor_stream.h"
#include "site.h"
#include "site_folder.h"
#include "stream_writer.h"

#define STANDARD_GRAVITY_MPS2 9.80665
#define RAD_PER_DEGREE        0.017453292519943295

/* 0.15 uT a count, as common magnetometers of phones have it. */
#define FIELD_FULL_UT 4915.2

enum { FIXES_PER_ROW = 20, BATCH = 8 };

static bool parse_sensors(const arguments_t *arguments, stream_settings_t *settings,
                          failure_t *failure)
{
    double accel_g = 16.0, gyro_dps = 2000.0;
    bool is_good = options_number(arguments, "accel-range", 1.0, 1000.0, &accel_g, failure) &&
                   options_number(arguments, "gyro-range", 10.0, 100000.0, &gyro_dps, failure);
    settings->accel_full_mps2 = accel_g * STANDARD_GRAVITY_MPS2;
    settings->gyro_full_radps = gyro_dps * RAD_PER_DEGREE;
    settings->field_full_ut = FIELD_FULL_UT;
    return is_good;
}

static bool parse_reset(const arguments_t *arguments, stream_settings_t *settings,
                        failure_t *failure)
{
    const char *reset = options_value(arguments, "reset");
    settings->has_reset = reset != NULL;
    return reset == NULL || number_parse_time(reset, &settings->reset_us) ||
           failure_usage(failure, "insole stream: --reset %.40s: expected seconds such as 12.5",
                         reset);
}

static bool parse(const arguments_t *arguments, stream_settings_t *settings, failure_t *failure)
{
    int64_t seed = 1, fixes_per_row = FIXES_PER_ROW, batch = BATCH;
    const char *tracker = options_value(arguments, "tracker");
    memset(settings, 0, sizeof *settings);
    if (arguments->operand_count == 0u) {
        return failure_usage(
            failure, "insole stream: no log: expected files, folders or - for standard input");
    }
    if (!options_has(arguments, "out")) {
        return failure_usage(failure, "insole stream: no --out: expected --out FILE");
    }
    bool is_good = (tracker == NULL || tracker_parse(tracker, &settings->tracker, failure)) &&
                   options_whole(arguments, "seed", 0, UINT32_MAX, &seed, failure) &&
                   options_whole(arguments, "every", 1, UINT16_MAX, &fixes_per_row, failure) &&
                   options_whole(arguments, "batch", 1, WIRE_IMU_MOST, &batch, failure) &&
                   parse_sensors(arguments, settings, failure) &&
                   parse_reset(arguments, settings, failure);
    settings->seed = (uint32_t)seed;
    settings->fixes_per_row = (uint32_t)fixes_per_row;
    settings->batch = (uint32_t)batch;
    return is_good;
}

/* ---- radio ------------------------------------------------------------------------------ */

/* The tables that the device has: access points for the shoe, the radio map for the phone. */
static bool open_site(const arguments_t *arguments, site_t *site, const stream_settings_t *settings,
                      failure_t *failure)
{
    site_folder_t found;
    bool is_phone = settings->tracker == TRACKER_PHONE;
    memset(site, 0, sizeof *site);
    if (!site_folder_find(&found, arguments, failure)) {
        return false;
    }
    const char *aps = is_phone ? NULL : found.aps, *radiomap = is_phone ? found.radiomap : NULL;
    bool is_good = (aps == NULL && radiomap == NULL) ||
                   site_open(site, NULL, aps, radiomap, &insole_propagation_defaults, failure);
    site_folder_free(&found);
    return is_good;
}

/* The index that the id of a log has in the tables. */
static uint32_t number_of(const site_t *site, const stream_settings_t *settings,
                          const id_table_t *ids, uint32_t id)
{
    return settings->tracker == TRACKER_PHONE ? radiomap_file_number(&site->radiomap_file, ids, id)
                                              : ap_file_number(&site->ap_file, ids, id);
}

/* Of access points that the device does not know it is not told. */
static bool is_known(const site_t *site, const stream_settings_t *settings,
                     const sensor_stream_t *stream, record_t *record)
{
    if (record->kind != RECORD_RSS && record->kind != RECORD_RANGE) {
        return true;
    }
    if (site->ap_file.count == 0u && !site_has_radiomap(site)) {
        return false;
    }
    record->id = number_of(site, settings, &stream->session.ids, record->id);
    return record->id < UINT16_MAX;
}

/* ---- all together ----------------------------------------------------------------------- */

static bool write_records(sensor_stream_t *stream, const site_t *site, stream_writer_t *writer,
                          failure_t *failure)
{
    record_t record;
    read_t answer = READ_ONE;
    bool is_good = true;
    while (is_good && (answer = sensor_stream_next(stream, &record, failure)) == READ_ONE) {
        if (is_known(site, &writer->settings, stream, &record)) {
            is_good = stream_writer_record(writer, &record, failure);
        }
    }
    if (!is_good || answer == READ_FAILED) {
        return false;
    }
    stream_writer_finish(writer);
    return true;
}

static void print_summary(const stream_counts_t *counts)
{
    fprintf(stderr, "stream: %lu bytes in %lu frames: %lu readings, %lu scans, %lu ranges\n",
            counts->bytes, counts->frames, counts->readings, counts->scans, counts->ranges);
    if (counts->clipped > 0u) {
        fprintf(stderr, "  clipped: %lu values beyond the range of their sensor\n",
                counts->clipped);
    }
    if (counts->blank > 0u) {
        fprintf(stderr, "  left out: %lu records without numbers\n", counts->blank);
    }
    if (counts->back > 0u) {
        fprintf(stderr, "  held: %lu records whose time went back\n", counts->back);
    }
}

static bool write_file(const stream_writer_t *writer, const char *path, failure_t *failure)
{
    FILE *file;
    if (!output_open(&file, path, failure)) {
        return false;
    }
    (void)fwrite(writer->bytes, 1u, writer->counts.bytes, file);
    return output_close(file, path, failure);
}

/* A log that is none has not cost an older stream. */
static bool write_stream(const arguments_t *arguments, const stream_settings_t *settings,
                         sensor_stream_t *stream, const site_t *site, failure_t *failure)
{
    const char *path = options_value(arguments, "out");
    stream_writer_t writer;
    if (session_reads(&stream->session, path) || site_is_file(site, path)) {
        return failure_usage(failure, "insole stream: --out %s would overwrite what is read", path);
    }
    stream_writer_init(&writer, settings);
    bool is_good =
        write_records(stream, site, &writer, failure) && write_file(&writer, path, failure);
    if (is_good) {
        print_summary(&writer.counts);
    }
    stream_writer_free(&writer);
    return is_good;
}

static bool run(const arguments_t *arguments, failure_t *failure)
{
    static site_t site;
    stream_settings_t settings;
    sensor_stream_t stream;
    if (!parse(arguments, &settings, failure) || !open_site(arguments, &site, &settings, failure)) {
        return false;
    }
    bool is_good = sensor_stream_open(&stream, arguments->operands, arguments->operand_count,
                                      options_value(arguments, "accel-unit"),
                                      options_value(arguments, "gyro-unit"), failure) &&
                   write_stream(arguments, &settings, &stream, &site, failure);
    sensor_stream_close(&stream);
    site_free(&site);
    return is_good;
}

static const option_t options[] = {
    {"tracker", "NAME", "whom it is for: foot (default) or phone"},
    {"aps", "FILE", "foot: the access points that were packed; default: those of a LOG folder"},
    {"radiomap", "FILE", "phone: the radio map that was packed; the same"},
    {"every", "N", "a row for every N fixes (default 20)"},
    {"seed", "N", "of the device's random numbers (default 1)"},
    {"batch", "N", "readings of the inertial sensor in a frame, at most 15 (default 8)"},
    {"accel-range", "G", "what the accelerometer can tell, in g (default 16)"},
    {"gyro-range", "DPS", "what the gyro can tell, in degrees per second (default 2000)"},
    {"reset", "SECONDS", "then the device is reset, and goes on with the state it has saved"},
    {"accel-unit", "UNIT", "unit of the log's accelerometer: mps2 (default), g or mg"},
    {"gyro-unit", "UNIT", "unit of the log's gyro: radps (default) or dps"},
    {"out", "FILE", "write the stream there; - is standard output"},
    {NULL, NULL, NULL}};

const command_t command_stream = {
    "stream",
    "LOG... --out FILE.bin",
    "a log as the bytes that a device's sensors would give it",
    "What it makes is fed to the images of tools/firmware over a serial line: readings in the\n"
    "counts of sensors with 16 bits, a clock of 32 bits, scans with the indices that the packed\n"
    "tables have. tools/firmware/wire.h tells what every byte means.\n"
    "\n"
    "  insole pack --plan plan.csv --aps aps.csv --out site.c\n"
    "  insole stream walk --out walk.bin\n"
    "\n"
    "Sensors of a device tell no more than this, so compare with a replay of the same stream:\n"
    "tools/firmware/README.md shows how.\n",
    options,
    run};
