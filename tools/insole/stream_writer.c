/* SPDX-License-Identifier: MIT */
#include "stream_writer.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "convert.h"
#include "estimator_setup.h"
#include "memory.h"

static const double COUNTS = 32768.0;

void stream_writer_init(stream_writer_t *writer, const stream_settings_t *settings)
{
    memset(writer, 0, sizeof *writer);
    writer->settings = *settings;
    writer->batch.kind = WIRE_IMU;
}

void stream_writer_free(stream_writer_t *writer)
{
    radio_group_free(&writer->radio);
    free(writer->bytes);
    writer->bytes = NULL;
}

/* ---- frames ----------------------------------------------------------------------------- */

static void put(wire_frame_t *frame, uint64_t number, uint32_t bytes)
{
    for (uint32_t i = 0u; i < bytes; i++) {
        frame->payload[frame->count++] = (uint8_t)(number >> (8u * i));
    }
}

static void put_float(wire_frame_t *frame, double value)
{
    float narrow = (float)value;
    uint32_t bits;
    memcpy(&bits, &narrow, sizeof bits);
    put(frame, bits, sizeof bits);
}

static void put_ticks(wire_frame_t *frame, int64_t since_begin_us)
{
    put(frame, STREAM_FIRST_TICKS + (uint64_t)since_begin_us, WIRE_TICKS_BYTES);
}

/* The nearest whole number in low..high. */
static int64_t to_whole(stream_writer_t *writer, double value, double low, double high)
{
    double within = fmin(fmax(value, low), high);
    writer->counts.clipped += within < value || within > value ? 1u : 0u;
    return (int64_t)floor(within + 0.5);
}

static void put_counts(stream_writer_t *writer, wire_frame_t *frame, const double *values,
                       double full)
{
    for (int i = 0; i < 3; i++) {
        int64_t counts = to_whole(writer, values[i] * COUNTS / full, -COUNTS, COUNTS - 1.0);
        put(frame, (uint64_t)counts, sizeof(int16_t));
    }
}

static void write_frame(stream_writer_t *writer, const wire_frame_t *frame)
{
    const uint8_t head[] = {(uint8_t)WIRE_MARK, frame->kind, frame->count};
    size_t before = writer->counts.bytes, after = before + frame->count + WIRE_FRAMING;
    writer->bytes = memory_room(writer->bytes, &writer->room, after, 1u);
    memcpy(writer->bytes + before, head, sizeof head);
    memcpy(writer->bytes + before + sizeof head, frame->payload, frame->count);
    writer->bytes[after - 1u] = wire_check(frame);
    writer->counts.frames++;
    writer->counts.bytes = (unsigned long)after;
}

static wire_frame_t frame_of(uint8_t kind)
{
    wire_frame_t frame = {.kind = kind};
    return frame;
}

static void write_batch(stream_writer_t *writer)
{
    if (writer->batch.count > 0u) {
        write_frame(writer, &writer->batch);
    }
    writer->batch.count = 0u;
}

/* ---- begin, reset, end ------------------------------------------------------------------ */

static void write_head(stream_writer_t *writer)
{
    const stream_settings_t *settings = &writer->settings;
    wire_frame_t head = frame_of(WIRE_HEAD);
    put(&head, WIRE_VERSION, 1u);
    put(&head, settings->tracker == TRACKER_PHONE ? WIRE_PHONE : WIRE_FOOT, 1u);
    put(&head, settings->fixes_per_row, 2u);
    put(&head, STREAM_TICKS_HZ, 4u);
    put(&head, STREAM_FIRST_TICKS, 4u);
    put(&head, (uint64_t)writer->begin_us, 8u);
    put_float(&head, settings->accel_full_mps2 / COUNTS);
    put_float(&head, settings->gyro_full_radps / COUNTS);
    put_float(&head, settings->field_full_ut / COUNTS);
    put(&head, settings->seed, 4u);
    write_frame(writer, &head);
}

static void write_reset(stream_writer_t *writer)
{
    const wire_frame_t reset = frame_of(WIRE_RESET);
    write_frame(writer, &reset);
    writer->was_reset = true;
}

static void end_radio(stream_writer_t *writer);

void stream_writer_finish(stream_writer_t *writer)
{
    const wire_frame_t end = frame_of(WIRE_END);
    end_radio(writer);
    write_batch(writer);
    write_frame(writer, &end);
}

/* A counter does not go back. */
static bool set_time(stream_writer_t *writer, int64_t t_us, failure_t *failure)
{
    if (!writer->has_begun) {
        writer->has_begun = true;
        writer->begin_us = writer->newest_us = t_us;
        write_head(writer);
    }
    if (t_us < writer->newest_us) {
        writer->counts.back++;
        return true;
    }
    if (t_us - writer->newest_us > (int64_t)UINT32_MAX) {
        return failure_input(failure, "nothing for more than an hour: a counter of 32 bits would "
                                      "wrap unseen: expected logs of one walk");
    }
    writer->newest_us = t_us;
    return true;
}

static int64_t now_us(const stream_writer_t *writer)
{
    return writer->newest_us - writer->begin_us;
}

/* ---- radio ------------------------------------------------------------------------------ */

static bool is_stronger(const insole_rss_t *a, const insole_rss_t *b)
{
    return a->rss_dbm > b->rss_dbm;
}

/* The strongest that a frame holds come first. */
static uint32_t choose(insole_rss_t *readings, size_t count)
{
    uint32_t most = count < WIRE_RSS_MOST ? (uint32_t)count : (uint32_t)WIRE_RSS_MOST;
    for (size_t i = most; i < count; i++) {
        uint32_t weakest = 0u;
        for (uint32_t k = 1u; k < most; k++) {
            weakest = is_stronger(&readings[weakest], &readings[k]) ? k : weakest;
        }
        if (is_stronger(&readings[i], &readings[weakest])) {
            readings[weakest] = readings[i];
        }
    }
    return most;
}

static void write_scan(stream_writer_t *writer, int64_t since_us)
{
    wire_frame_t frame = frame_of(WIRE_SCAN);
    uint32_t count = choose(writer->radio.rss, writer->radio.rss_count);
    put_ticks(&frame, since_us);
    for (uint32_t i = 0u; i < count; i++) {
        const insole_rss_t *reading = &writer->radio.rss[i];
        double age_ms = 1e-3 * ((double)reading->age_us + (double)writer->radio.age_us);
        put(&frame, reading->id, 2u);
        put(&frame, (uint64_t)to_whole(writer, (double)reading->rss_dbm, -128.0, 127.0), 1u);
        put(&frame, (uint64_t)to_whole(writer, age_ms, 0.0, UINT16_MAX), 2u);
    }
    write_frame(writer, &frame);
    writer->counts.scans++;
}

static void write_ranges(stream_writer_t *writer, int64_t since_us)
{
    size_t count = writer->radio.range_count;
    for (size_t i = 0u; i < count;) {
        wire_frame_t frame = frame_of(WIRE_RANGES);
        put_ticks(&frame, since_us);
        for (int k = 0; k < WIRE_RANGE_MOST && i < count; k++, i++) {
            const insole_range_t *range = &writer->radio.range[i];
            double range_mm = 1e3 * (double)range->range_m, sigma_mm = 1e3 * (double)range->sigma_m;
            put(&frame, range->id, 2u);
            put(&frame, (uint64_t)to_whole(writer, range_mm, 0.0, UINT32_MAX), 4u);
            put(&frame, (uint64_t)to_whole(writer, sigma_mm, 0.0, UINT16_MAX), 2u);
        }
        write_frame(writer, &frame);
    }
    writer->counts.ranges += (unsigned long)count;
}

/* Records of one moment are one scan. */
static void end_radio(stream_writer_t *writer)
{
    int64_t since_us = now_us(writer);
    if (radio_group_is_empty(&writer->radio)) {
        return;
    }
    write_batch(writer);
    if (writer->radio.range_count > 0u) {
        write_ranges(writer, since_us);
    }
    if (writer->radio.rss_count > 0u) {
        write_scan(writer, since_us);
    }
    radio_group_clear(&writer->radio);
}

/* ---- readings --------------------------------------------------------------------------- */

static void write_imu(stream_writer_t *writer, const record_t *record)
{
    put_ticks(&writer->batch, now_us(writer));
    put_counts(writer, &writer->batch, record->value, writer->settings.accel_full_mps2);
    put_counts(writer, &writer->batch, record->value + 3, writer->settings.gyro_full_radps);
    writer->counts.readings++;
    if (writer->batch.count >= writer->settings.batch * WIRE_IMU_BYTES) {
        write_batch(writer);
    }
}

static void write_mag(stream_writer_t *writer, const record_t *record)
{
    wire_frame_t frame = frame_of(WIRE_MAG);
    write_batch(writer);
    put_ticks(&frame, now_us(writer));
    put_counts(writer, &frame, record->value, writer->settings.field_full_ut);
    write_frame(writer, &frame);
}

static void put_whole(stream_writer_t *writer, wire_frame_t *frame, double value, double low)
{
    put(frame, (uint64_t)to_whole(writer, value, low, INT32_MAX), 4u);
}

static void write_place(stream_writer_t *writer, const record_t *record)
{
    const insole_start_t start = estimator_start(record);
    wire_frame_t frame = frame_of(WIRE_PLACE);
    write_batch(writer);
    put_ticks(&frame, now_us(writer));
    put_whole(writer, &frame, 1e3 * (double)start.x_m, -INT32_MAX);
    put_whole(writer, &frame, 1e3 * (double)start.y_m, -INT32_MAX);
    if (start.has_heading) {
        put_whole(writer, &frame, 1e6 * (double)start.heading_rad, -INT32_MAX);
    } else {
        put(&frame, (uint64_t)WIRE_UNTOLD, 4u);
    }
    put_whole(writer, &frame, 1e3 * (double)start.sigma_m, 0.0);
    put_whole(writer, &frame, 1e6 * (double)start.sigma_rad, 0.0);
    write_frame(writer, &frame);
}

/* What must be there of each kind that a device is told; 0: it is not told. */
static int values_of(record_kind_t kind)
{
    static const int values[RECORD_KINDS] = {[RECORD_START] = 2,
                                             [RECORD_IMU] = 6,
                                             [RECORD_MAG] = 3,
                                             [RECORD_RSS] = 1,
                                             [RECORD_RANGE] = 1};
    return values[kind];
}

static bool is_blank(const record_t *record)
{
    for (int i = 0; i < values_of(record->kind); i++) {
        if (!isfinite(record->value[i])) {
            return true;
        }
    }
    return false;
}

static void write_reading(stream_writer_t *writer, const record_t *record)
{
    if (record->kind == RECORD_IMU) {
        write_imu(writer, record);
    } else if (record->kind == RECORD_MAG) {
        write_mag(writer, record);
    } else if (record->kind == RECORD_START) {
        write_place(writer, record);
    } else {
        radio_group_add(&writer->radio, record);
    }
}

bool stream_writer_record(stream_writer_t *writer, const record_t *record, failure_t *failure)
{
    if (values_of(record->kind) == 0) {
        return true;
    }
    if (is_blank(record)) {
        writer->counts.blank++;
        return true;
    }
    if (radio_group_ends(&writer->radio, record)) {
        end_radio(writer);
    }
    if (!set_time(writer, record->t_us, failure)) {
        return false;
    }
    if (writer->settings.has_reset && !writer->was_reset &&
        record->t_us >= writer->settings.reset_us) {
        write_batch(writer);
        write_reset(writer);
    }
    write_reading(writer, record);
    return true;
}
