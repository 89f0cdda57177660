/* SPDX-License-Identifier: MIT */
#include "carry_windows.h"

#include <stdlib.h>
#include <string.h>

#include "convert.h"
#include "memory.h"
#include "progress.h"
#include "session.h"
#include "units.h"

/* How strong and how slow another walker is. */
static const struct {
    double strength, pace;
} variants[] = {{1.0, 1.0}, {0.7, 1.0}, {1.4, 1.0}, {1.0, 1.12}, {1.0, 0.9}};

enum { VARIANTS = sizeof variants / sizeof variants[0] };

/* What is slower is not the walk's. */
static const double gravity_s = 0.5;

typedef struct {
    int64_t t_us; /* since the first */
    double accel[3], gravity[3], gyro[3];
    bool has_gyro;
} sample_t;

typedef struct {
    sample_t *at;
    size_t count, room;
    int64_t first_us;
} samples_t;

bool carry_windows_init(carry_windows_t *windows, const char *classes, failure_t *failure)
{
    memset(windows, 0, sizeof *windows);
    id_table_init(&windows->persons);
    id_table_init(&windows->groups);
    return carry_classes_init(&windows->classes, classes, failure);
}

/* ---- logs ------------------------------------------------------------------------------- */

static void find_gravity(samples_t *samples, sample_t *sample)
{
    const sample_t *last = sample - 1;
    double dt_s = samples->count > 1u ? 1e-6 * (double)(sample->t_us - last->t_us) : 0.0;
    double gain = fmax(dt_s / (dt_s + gravity_s), 1.0 / (double)samples->count);
    for (int k = 0; k < 3; k++) {
        double before = samples->count > 1u ? last->gravity[k] : 0.0;
        sample->gravity[k] = before + gain * (sample->accel[k] - before);
    }
}

static bool is_good_record(const samples_t *samples, const record_t *record)
{
    double size = 0.0;
    for (int k = 0; k < (record->kind == RECORD_IMU ? 6 : 3); k++) {
        size += fabs(record->value[k]);
    }
    return isfinite(size) && (samples->count == 0u || record->t_us - samples->first_us >
                                                          samples->at[samples->count - 1u].t_us);
}

static void add_sample(samples_t *samples, const record_t *record)
{
    samples->at =
        memory_room(samples->at, &samples->room, samples->count + 1u, sizeof *samples->at);
    samples->first_us = samples->count == 0u ? record->t_us : samples->first_us;
    sample_t *sample = &samples->at[samples->count++];
    sample->t_us = record->t_us - samples->first_us;
    memcpy(sample->accel, record->value, sizeof sample->accel);
    sample->has_gyro = record->kind == RECORD_IMU;
    memcpy(sample->gyro, record->value + 3, sizeof sample->gyro);
    find_gravity(samples, sample);
}

static read_t read_samples(samples_t *samples, session_t *session, units_t *units,
                           unsigned long *refused, failure_t *failure)
{
    record_t record;
    read_t answer;
    while ((answer = session_next(session, &record, failure)) == READ_ONE) {
        if (record.kind != RECORD_IMU && record.kind != RECORD_ACC) {
            continue;
        }
        if (!units_apply(units, &record, failure)) {
            return READ_FAILED;
        }
        if (is_good_record(samples, &record)) {
            add_sample(samples, &record);
        } else {
            ++*refused;
        }
    }
    return answer;
}

static bool load(samples_t *samples, const char *path, const char *accel_unit,
                 unsigned long *refused, failure_t *failure)
{
    session_t session;
    units_t units;
    memset(samples, 0, sizeof *samples);
    bool is_good = units_init(&units, accel_unit, NULL, failure);
    if (is_good) {
        is_good = session_open(&session, &path, 1u, failure) &&
                  read_samples(samples, &session, &units, refused, failure) == READ_END &&
                  units_finish(&units, failure);
        session_close(&session);
    }
    return is_good;
}

/* ---- windows ---------------------------------------------------------------------------- */

static void add_row(carry_windows_t *windows, const insole_carry_features_t *features,
                    uint32_t block, uint8_t variant)
{
    windows->rows = memory_room(windows->rows, &windows->row_room, windows->row_count + 1u,
                                sizeof *windows->rows);
    carry_row_t *row = &windows->rows[windows->row_count++];
    memset(row, 0, sizeof *row);
    row->features = *features;
    row->log = (uint32_t)windows->log_count;
    row->block = block;
    row->variant = variant;
    windows->without_gyro += !features->has_gyro;
}

static insole_vec3_t vec3_of(const double v[3])
{
    return insole_vec3(to_real(v[0]), to_real(v[1]), to_real(v[2]));
}

/* What another walker's phone feels at that time. */
static insole_carry_point_t felt(const sample_t *sample, uint8_t variant)
{
    insole_carry_point_t point = {vec3_of(sample->accel), vec3_of(sample->gyro), sample->has_gyro};
    if (variant > 0u && variant < VARIANTS) {
        double a[3], w[3], strength = variants[variant].strength;
        for (int k = 0; k < 3; k++) {
            a[k] = sample->gravity[k] + strength * (sample->accel[k] - sample->gravity[k]);
            w[k] = sample->gyro[k] * strength / variants[variant].pace;
        }
        point.accel = vec3_of(a);
        point.gyro = vec3_of(w);
    }
    return point;
}

static void feel(carry_windows_t *windows, const samples_t *samples, uint8_t variant)
{
    insole_carry_window_t window;
    insole_carry_features_t features;
    insole_carry_window_init(&window, insole_carry_defaults.gravity_s);
    for (size_t i = 0u; i < samples->count; i++) {
        const sample_t *sample = &samples->at[i];
        int64_t t_us = (int64_t)((double)sample->t_us * variants[variant].pace + 0.5);
        insole_carry_point_t point = felt(sample, variant);
        (void)insole_carry_window_push(&window, (uint64_t)t_us, point.accel,
                                       point.has_gyro ? &point.gyro : NULL, NULL);
        if (insole_carry_window_next(&window, &features) != INSOLE_OK) {
            continue;
        }
        if (insole_carry_is_still(&insole_carry_defaults, &features)) {
            windows->still += variant == 0u;
            continue;
        }
        uint64_t block = (uint64_t)sample->t_us / (CARRY_BLOCK_S * UINT64_C(1000000));
        add_row(windows, &features, (uint32_t)(windows->block_count + block), variant);
    }
}

static void name_blocks(carry_windows_t *windows, size_t from_row)
{
    size_t count = windows->block_count;
    for (size_t i = from_row; i < windows->row_count; i++) {
        count = windows->rows[i].block >= count ? windows->rows[i].block + 1u : count;
    }
    windows->log_of_block = memory_room(windows->log_of_block, &windows->block_room, count,
                                        sizeof *windows->log_of_block);
    for (size_t b = windows->block_count; b < count; b++) {
        windows->log_of_block[b] = (uint32_t)windows->log_count;
    }
    windows->block_count = count;
}

static void name_source(carry_windows_t *windows, const carry_log_t *log, int class_number)
{
    char group[128];
    windows->logs = memory_room(windows->logs, &windows->log_room, windows->log_count + 1u,
                                sizeof *windows->logs);
    carry_source_t *source = &windows->logs[windows->log_count++];
    snprintf(group, sizeof group, "%s,%s", log->person, log->position);
    source->class_number = class_number;
    source->group = id_table_number(&windows->groups, group);
    source->person = id_table_number(&windows->persons, log->person);
}

static bool add_log(carry_windows_t *windows, const carry_index_t *index, const carry_log_t *log,
                    bool is_varied, const char *accel_unit, failure_t *failure)
{
    samples_t samples;
    int class_number;
    size_t from_row = windows->row_count;
    if (!carry_classes_of(&windows->classes, log->position, &class_number, failure)) {
        return false;
    }
    if (class_number == CARRY_LEFT_OUT) {
        windows->left_out++;
        return true;
    }
    bool is_good = load(&samples, log->path, accel_unit, &windows->refused, failure);
    for (uint8_t v = 0u; is_good && v < (is_varied ? VARIANTS : 1); v++) {
        feel(windows, &samples, v);
    }
    free(samples.at);
    if (!is_good) {
        return failure_add(failure, " (named by %s:%lu)", index->name, log->line);
    }
    if (windows->row_count == from_row) {
        return failure_input(failure, "%s:%lu: %s has no walk of 2 s with an accelerometer",
                             index->name, log->line, log->path);
    }
    name_blocks(windows, from_row);
    name_source(windows, log, class_number);
    return true;
}

bool carry_windows_add(carry_windows_t *windows, const carry_index_t *index, bool is_varied,
                       const char *accel_unit, failure_t *failure)
{
    progress_t progress;
    bool is_good = true;
    progress_begin(&progress);
    for (size_t i = 0u; i < index->count && is_good; i++) {
        progress_step(&progress, i, index->count);
        is_good = add_log(windows, index, &index->logs[i], is_varied, accel_unit, failure);
    }
    progress_end(&progress);
    return is_good;
}

void carry_windows_free(carry_windows_t *windows)
{
    carry_classes_free(&windows->classes);
    id_table_free(&windows->persons);
    id_table_free(&windows->groups);
    free(windows->logs);
    free(windows->rows);
    free(windows->log_of_block);
    memset(windows, 0, sizeof *windows);
}
