/* SPDX-License-Identifier: MIT */
#include "device.h"

#include <string.h>

#include "insole/base/ticks.h"
#include "text.h"
#include "tracker.h"

#ifndef DEVICE_STATE_ROOM
#define DEVICE_STATE_ROOM 36864 /* bytes for what survives a reset */
#endif

#define KEPT __attribute__((section(".noinit")))

static struct {
    bool walks; /* a head has come */
    bool failed;
    uint16_t fixes_per_row;
    int64_t t0_us;                          /* log's clock */
    float accel_mps2, gyro_radps, field_ut; /* of a count */
    insole_ticks_t clock;
    uint32_t fixes, rows, crc, resumed;
} device;

/* What survives: the device, then its tracker. Start-up code leaves it as it is. */
KEPT static uint8_t kept[DEVICE_STATE_ROOM];
static uint32_t image_kind;

/* ---- time and state --------------------------------------------------------------------- */

static uint64_t time_us(const uint8_t *payload)
{
    return insole_ticks_now_us(&device.clock, wire_u32(payload));
}

bool device_save(void)
{
    size_t size, used;
    void *state = tracker_state(&size);
    return insole_snapshot_save(image_kind, &device, sizeof device, kept, sizeof kept, &used) ==
               INSOLE_OK &&
           insole_snapshot_save(image_kind, state, size, kept + used, sizeof kept - used, &used) ==
               INSOLE_OK;
}

static bool load(void)
{
    const size_t second = INSOLE_SNAPSHOT_HEADER_BYTES + sizeof device;
    size_t size;
    void *state = tracker_state(&size);
    return insole_snapshot_load(image_kind, &device, sizeof device, kept, sizeof kept) ==
               INSOLE_OK &&
           insole_snapshot_load(image_kind, state, size, kept + second, sizeof kept - second) ==
               INSOLE_OK;
}

void device_start(uint32_t image)
{
    image_kind = image;
    memset(&device, 0, sizeof device);
    if (load()) {
        device.resumed++;
        text_write("# goes on after a reset\n");
    } else {
        memset(&device, 0, sizeof device);
    }
    memset(kept, 0, INSOLE_SNAPSHOT_HEADER_BYTES);
    text_write("# ready\n");
}

/* ---- rows ------------------------------------------------------------------------------- */

/* A struct may have padding, and an enumeration any size. */
static void take_in(const insole_fix_t *fix)
{
    const float values[] = {fix->position_m.x, fix->position_m.y, fix->position_m.z,
                            fix->heading_rad,  fix->var_x_m2,     fix->cov_xy_m2,
                            fix->var_y_m2,     fix->var_z_m2,     fix->var_heading_rad2};
    const uint32_t state = (uint32_t)fix->state;
    device.crc = insole_crc32(device.crc, &fix->t_us, sizeof fix->t_us);
    device.crc = insole_crc32(device.crc, values, sizeof values);
    device.crc = insole_crc32(device.crc, &state, sizeof state);
    device.fixes++;
}

static void write_row(const insole_fix_t *fix)
{
    static const char *const states[] = {"align", "search", "track", "coast", "lost"};
    const struct {
        float value;
        uint32_t decimals;
    } columns[] = {{fix->position_m.x, 3u}, {fix->position_m.y, 3u}, {fix->position_m.z, 3u},
                   {fix->heading_rad, 5u},  {fix->var_x_m2, 4u},     {fix->cov_xy_m2, 4u},
                   {fix->var_y_m2, 4u},     {fix->var_z_m2, 4u},     {fix->var_heading_rad2, 6u}};
    text_seconds(device.t0_us + (int64_t)fix->t_us);
    for (uint32_t i = 0u; i < sizeof columns / sizeof columns[0]; i++) {
        text_write(",");
        text_fixed(columns[i].value, columns[i].decimals);
    }
    text_write(",");
    text_write(states[fix->state]);
    text_write(",");
    text_hex(device.crc);
    text_write("\n");
    device.rows++;
}

static bool take_fixes(void)
{
    insole_fix_t fix;
    bool has_any = false;
    while (tracker_next(&fix)) {
        take_in(&fix);
        if (device.fixes % device.fixes_per_row == 0u) {
            write_row(&fix);
        }
        has_any = true;
    }
    return has_any;
}

/* ---- frames ----------------------------------------------------------------------------- */

static void take_head(const uint8_t *head)
{
    memset(&device, 0, sizeof device);
    device.fixes_per_row = wire_u16(head + 2);
    device.t0_us = (int64_t)((uint64_t)wire_u32(head + 12) | (uint64_t)wire_u32(head + 16) << 32);
    device.accel_mps2 = wire_float(head + 20);
    device.gyro_radps = wire_float(head + 24);
    device.field_ut = wire_float(head + 28);
    device.walks =
        head[0] == WIRE_VERSION && head[1] == tracker_name && device.fixes_per_row > 0u &&
        insole_ticks_init(&device.clock, wire_u32(head + 4), wire_u32(head + 8)) == INSOLE_OK &&
        tracker_begin(wire_u32(head + 32));
    device.failed = !device.walks;
    text_write(device.walks
                   ? "t,x,y,z,heading,var_x,cov_xy,var_y,var_z,var_heading,state,crc\n"
                   : "# the head is of another version or tracker, or the settings are refused\n");
}

static insole_vec3_t vector_at(const uint8_t *at, float scale)
{
    return insole_vec3((float)wire_i16(at) * scale, (float)wire_i16(at + 2) * scale,
                       (float)wire_i16(at + 4) * scale);
}

/* One slice of work for each reading. */
static void take_imu(const wire_frame_t *frame)
{
    for (uint32_t at = 0u; at + WIRE_IMU_BYTES <= frame->count; at += WIRE_IMU_BYTES) {
        const uint8_t *reading = frame->payload + at;
        const insole_imu_t imu = {time_us(reading), vector_at(reading + 4, device.accel_mps2),
                                  vector_at(reading + 10, device.gyro_radps)};
        tracker_imu(&imu);
        (void)take_fixes();
        (void)tracker_work();
    }
}

static void take_mag(const uint8_t *payload)
{
    const insole_mag_t mag = {time_us(payload), vector_at(payload + 4, device.field_ut)};
    tracker_mag(&mag);
}

static void take_scan(const wire_frame_t *frame)
{
    insole_rss_t readings[WIRE_RSS_MOST];
    uint32_t count = ((uint32_t)frame->count - WIRE_TICKS_BYTES) / WIRE_RSS_BYTES;
    for (uint32_t i = 0u; i < count; i++) {
        const uint8_t *at = frame->payload + WIRE_TICKS_BYTES + i * WIRE_RSS_BYTES;
        readings[i].id = wire_u16(at);
        readings[i].rss_dbm = (float)(int8_t)at[2];
        readings[i].age_us = wire_u16(at + 3) * 1000u;
    }
    tracker_scan(time_us(frame->payload), readings, count);
}

static void take_ranges(const wire_frame_t *frame)
{
    insole_range_t ranges[WIRE_RANGE_MOST];
    uint32_t count = ((uint32_t)frame->count - WIRE_TICKS_BYTES) / WIRE_RANGE_BYTES;
    uint64_t t_us = time_us(frame->payload);
    for (uint32_t i = 0u; i < count; i++) {
        const uint8_t *at = frame->payload + WIRE_TICKS_BYTES + i * WIRE_RANGE_BYTES;
        ranges[i].t_us = t_us;
        ranges[i].id = wire_u16(at);
        ranges[i].range_m = (float)wire_u32(at + 2) * 1.0e-3f;
        ranges[i].sigma_m = (float)wire_u16(at + 6) * 1.0e-3f;
    }
    tracker_ranges(ranges, count);
}

static void take_place(const uint8_t *payload)
{
    insole_start_t start = {.t_us = time_us(payload),
                            .x_m = (float)wire_i32(payload + 4) * 1.0e-3f,
                            .y_m = (float)wire_i32(payload + 8) * 1.0e-3f,
                            .has_heading = wire_i32(payload + 12) != WIRE_UNTOLD,
                            .sigma_m = (float)wire_u32(payload + 16) * 1.0e-3f,
                            .sigma_rad = (float)wire_u32(payload + 20) * 1.0e-6f};
    start.heading_rad = start.has_heading ? (float)wire_i32(payload + 12) * 1.0e-6f : 0.0f;
    tracker_start(&start);
}

/* A frame with a right check may still come from a stranger. */
static bool is_long_enough(const wire_frame_t *frame)
{
    switch (frame->kind) {
    case WIRE_HEAD:
        return frame->count >= WIRE_HEAD_BYTES;
    case WIRE_MAG:
        return frame->count >= WIRE_MAG_BYTES;
    case WIRE_SCAN:
    case WIRE_RANGES:
        return frame->count >= WIRE_TICKS_BYTES;
    case WIRE_PLACE:
        return frame->count >= WIRE_PLACE_BYTES;
    default:
        return true;
    }
}

static void take_reading(const wire_frame_t *frame)
{
    switch (frame->kind) {
    case WIRE_IMU:
        take_imu(frame);
        break;
    case WIRE_MAG:
        take_mag(frame->payload);
        break;
    case WIRE_SCAN:
        take_scan(frame);
        break;
    case WIRE_RANGES:
        take_ranges(frame);
        break;
    case WIRE_PLACE:
        take_place(frame->payload);
        break;
    default:
        break; /* a kind of a later version */
    }
}

device_answer_t device_take(const wire_frame_t *frame)
{
    if (!is_long_enough(frame)) {
        return DEVICE_GOES_ON;
    }
    if (frame->kind == WIRE_RESET) {
        return DEVICE_RESETS;
    }
    if (frame->kind == WIRE_END) {
        return DEVICE_ENDS;
    }
    if (frame->kind == WIRE_HEAD) {
        take_head(frame->payload);
    } else if (device.walks) {
        take_reading(frame);
    }
    return DEVICE_GOES_ON;
}

/* ---- end -------------------------------------------------------------------------------- */

static void write_count(const char *name, uint32_t count)
{
    text_write(name);
    text_whole(count);
}

int device_end(uint32_t bad_frames, uint32_t stack_bytes)
{
    if (device.walks) {
        bool goes_on = true;
        tracker_finish();
        while (goes_on) {
            goes_on = take_fixes();
            goes_on = tracker_work() || goes_on;
        }
    }
    write_count("# fixes ", device.fixes);
    write_count(" rows ", device.rows);
    text_write(" crc ");
    text_hex(device.crc);
    write_count(" bad ", bad_frames);
    write_count(" resets ", device.resumed);
    write_count(" stack ", stack_bytes);
    text_write("\n");
    return device.walks && !device.failed ? 0 : 1;
}
