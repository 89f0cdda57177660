/** @file stream_writer.h  A session as the frames that a device's drivers and radio would give it.
 *
 *  Readings are rounded to the counts of a sensor with 16 bits, time to ticks of a counter with 32,
 *  which begins ten seconds before it wraps. The frames are those of ../firmware/wire.h.
 *
 *      stream_writer_t writer;
 *      stream_writer_init(&writer, &settings);
 *      stream_writer_record(&writer, &record, &failure);      ids of radio: index in the tables
 *      stream_writer_finish(&writer);
 *      fwrite(writer.bytes, 1, writer.counts.bytes, file);
 *      stream_writer_free(&writer);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_STREAM_WRITER_H
#define INSOLE_HOST_STREAM_WRITER_H

#include "../firmware/wire.h"
#include "failure.h"
#include "method.h"
#include "radio_group.h"

enum { STREAM_TICKS_HZ = 1000000 };
#define STREAM_FIRST_TICKS (UINT32_MAX - 10u * (uint32_t)STREAM_TICKS_HZ + 1u)

typedef struct {
    tracker_t tracker;
    uint32_t seed;
    uint32_t fixes_per_row;                  /**< a row for every so many fixes, 1 .. 65535 */
    uint32_t batch;                          /**< readings in a frame, 1 .. WIRE_IMU_MOST */
    double accel_full_mps2, gyro_full_radps; /**< what 32768 counts mean */
    double field_full_ut;
    bool has_reset;
    int64_t reset_us; /**< before the first reading at or after this */
} stream_settings_t;

typedef struct {
    unsigned long frames, bytes;
    unsigned long readings, scans, ranges;
    unsigned long clipped; /**< values beyond what counts can tell */
    unsigned long blank;   /**< records left out because they hold what is no number */
    unsigned long back;    /**< records whose time went back, given the newest one's */
} stream_counts_t;

typedef struct {
    stream_settings_t settings;
    stream_counts_t counts;
    uint8_t *bytes; /**< `counts.bytes` of them */
    size_t room;
    wire_frame_t batch; /**< readings that wait */
    radio_group_t radio;
    bool has_begun, was_reset;
    int64_t begin_us, newest_us;
} stream_writer_t;

void stream_writer_init(stream_writer_t *writer, const stream_settings_t *settings);

/** Takes START, IMU, MAG, RSS and RANGE records; others mean nothing to a device.
 *  Fails for a gap in which the counter would wrap unseen. */
bool stream_writer_record(stream_writer_t *writer, const record_t *record, failure_t *failure);

/** What waits, and the end. */
void stream_writer_finish(stream_writer_t *writer);

void stream_writer_free(stream_writer_t *writer);

#endif
