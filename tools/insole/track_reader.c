/* SPDX-License-Identifier: MIT */
#include "track_reader.h"

#include "log_reader.h"

static read_t add_place(track_t *track, const record_t *record, const log_reader_t *reader,
                        failure_t *failure)
{
    if (record->kind != RECORD_TRACK && record->kind != RECORD_TRUTH) {
        return READ_ONE;
    }
    if (track->count > 0u && record->t_us < track->rows[track->count - 1u].t_us) {
        return line_reader_fail(&reader->lines, failure,
                                "time goes back: expected places in order of time");
    }
    track_add_record(track, record);
    return READ_ONE;
}

static bool read_places(track_t *track, log_reader_t *reader, failure_t *failure)
{
    record_t record;
    read_t answer = READ_ONE;
    while (answer == READ_ONE) {
        answer = log_reader_next(reader, &record, failure);
        if (answer == READ_ONE) {
            answer = add_place(track, &record, reader, failure);
        }
    }
    if (answer == READ_END && track->count == 0u) {
        return failure_input(failure,
                             "%s: holds no place: expected a header such as t,x,y or lines "
                             "truth,t,x,y[,z]",
                             reader->lines.name);
    }
    return answer == READ_END;
}

bool track_read(track_t *track, const char *path, failure_t *failure)
{
    log_reader_t reader;
    id_table_t ids;
    id_table_init(&ids);
    bool is_good =
        log_reader_open(&reader, path, &ids, failure) && read_places(track, &reader, failure);
    log_reader_close(&reader);
    id_table_free(&ids);
    return is_good;
}
