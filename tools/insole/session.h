/** @file session.h  Several logs on one clock, merged by time into one stream.
 *
 *  Memory is bounded: of each log no more than two records are held. Within a log, time may go
 *  back or leap for a record (that is for the estimator to judge); the merge does not stumble over
 *  it. Records of equal time come in the order of record_kind_t, then of the logs. A session of one
 *  log is handed on as it is read, without looking ahead.
 *
 *      session_open(&session, paths, count, &failure);       files, folders or `-`
 *      while (session_next(&session, &record, &failure) == READ_ONE) ...
 *      session_close(&session);
 *
 *  A folder stands for its .csv files but plan.csv, aps.csv, radiomap.csv, tracks, and the
 *  pose.csv and steps.csv of a simulated phone.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_SESSION_H
#define INSOLE_HOST_SESSION_H

#include "log_reader.h"

/** Records of a log that have been read but not handed on. */
enum { SESSION_AHEAD = 2 };

typedef struct {
    log_reader_t reader;
    bool is_from_folder;
    bool has_ended;
    record_t ahead[SESSION_AHEAD];
    int held;
} session_log_t;

typedef struct {
    session_log_t **logs;
    size_t count, room;
    id_table_t ids;
    unsigned long long bytes; /**< of all logs together; 0 when one of them is a pipe */
    unsigned long records;    /**< handed on so far */
} session_t;

bool session_open(session_t *session, const char *const *paths, size_t count, failure_t *failure);

read_t session_next(session_t *session, record_t *record, failure_t *failure);

/** Bytes read so far. */
unsigned long long session_bytes_read(const session_t *session);

/** Is the file one of the session's logs? */
bool session_reads(const session_t *session, const char *path);

void session_close(session_t *session);

#endif
