/* SPDX-License-Identifier: MIT */
#include "session.h"

#include <stdlib.h>
#include <string.h>

#include "memory.h"
#include "platform.h"

static bool open_log(session_t *session, const char *path, bool is_from_folder, failure_t *failure)
{
    session_log_t *log = memory_new(1u, sizeof *log);
    log->is_from_folder = is_from_folder;
    session->logs =
        memory_room(session->logs, &session->room, session->count + 1u, sizeof *session->logs);
    session->logs[session->count++] = log;
    return log_reader_open(&log->reader, path, &session->ids, failure);
}

static bool is_no_log(const char *path)
{
    static const char *const others[] = {"plan.csv", "aps.csv", "radiomap.csv", "pose.csv",
                                         "steps.csv"};
    bool is_other = false;
    for (size_t i = 0u; i < sizeof others / sizeof others[0]; i++) {
        is_other = is_other || strcmp(platform_base_name(path), others[i]) == 0;
    }
    return is_other;
}

static bool open_folder(session_t *session, const char *folder, failure_t *failure)
{
    char **paths;
    size_t count, before = session->count;
    if (!platform_list(folder, ".csv", &paths, &count)) {
        return failure_input(failure, "%s: cannot read the folder", folder);
    }
    bool is_good = true;
    for (size_t i = 0u; i < count && is_good; i++) {
        is_good = is_no_log(paths[i]) || open_log(session, paths[i], true, failure);
    }
    platform_free_paths(paths, count);
    if (is_good && session->count == before) {
        return failure_input(failure, "%s: folder has no log: expected .csv files", folder);
    }
    return is_good;
}

static void count_bytes(session_t *session)
{
    for (size_t i = 0u; i < session->count; i++) {
        unsigned long long bytes = platform_file_size(session->logs[i]->reader.lines.name);
        if (bytes == 0u) {
            session->bytes = 0u;
            return;
        }
        session->bytes += bytes;
    }
}

bool session_open(session_t *session, const char *const *paths, size_t count, failure_t *failure)
{
    memset(session, 0, sizeof *session);
    id_table_init(&session->ids);
    for (size_t i = 0u; i < count; i++) {
        bool is_folder = platform_is_folder(paths[i]);
        if (is_folder ? !open_folder(session, paths[i], failure)
                      : !open_log(session, paths[i], false, failure)) {
            return false;
        }
    }
    count_bytes(session);
    return true;
}

/* A track is no log: in a folder it is passed over, named by hand it is a mistake. */
static read_t refuse_track(session_log_t *log, failure_t *failure)
{
    if (log->is_from_folder) {
        log->has_ended = true;
        return READ_END;
    }
    return line_reader_fail(&log->reader.lines, failure,
                            "this is a track (it has a column state): expected a log");
}

static read_t read_ahead(session_log_t *log, int wanted, failure_t *failure)
{
    while (log->held < wanted && !log->has_ended) {
        record_t *next = &log->ahead[log->held];
        read_t answer = log_reader_next(&log->reader, next, failure);
        if (answer == READ_ONE && next->kind == RECORD_TRACK) {
            answer = refuse_track(log, failure);
        }
        if (answer == READ_FAILED) {
            return READ_FAILED;
        }
        log->has_ended = answer == READ_END;
        log->held += answer == READ_ONE ? 1 : 0;
    }
    return READ_ONE;
}

/* A stamp that leaps ahead for one record must not hold back the records behind it. */
static int64_t due_us(const session_log_t *log)
{
    int64_t first = log->ahead[0].t_us;
    return log->held == 2 && log->ahead[1].t_us < first ? log->ahead[1].t_us : first;
}

static bool is_before(const session_log_t *a, const session_log_t *b)
{
    if (due_us(a) != due_us(b)) {
        return due_us(a) < due_us(b);
    }
    return a->ahead[0].kind < b->ahead[0].kind;
}

static session_log_t *find_first(const session_t *session)
{
    session_log_t *first = NULL;
    for (size_t i = 0u; i < session->count; i++) {
        session_log_t *log = session->logs[i];
        if (log->held > 0 && (first == NULL || is_before(log, first))) {
            first = log;
        }
    }
    return first;
}

read_t session_next(session_t *session, record_t *record, failure_t *failure)
{
    int wanted = session->count == 1u ? 1 : SESSION_AHEAD;
    for (size_t i = 0u; i < session->count; i++) {
        if (read_ahead(session->logs[i], wanted, failure) == READ_FAILED) {
            return READ_FAILED;
        }
    }
    session_log_t *first = find_first(session);
    if (first == NULL) {
        return READ_END;
    }
    *record = first->ahead[0];
    first->ahead[0] = first->ahead[1];
    first->held--;
    session->records++;
    return READ_ONE;
}

unsigned long long session_bytes_read(const session_t *session)
{
    unsigned long long bytes = 0u;
    for (size_t i = 0u; i < session->count; i++) {
        bytes += session->logs[i]->reader.lines.bytes;
    }
    return bytes;
}

bool session_reads(const session_t *session, const char *path)
{
    for (size_t i = 0u; i < session->count; i++) {
        if (platform_is_same_file(session->logs[i]->reader.lines.name, path)) {
            return true;
        }
    }
    return false;
}

void session_close(session_t *session)
{
    for (size_t i = 0u; i < session->count; i++) {
        log_reader_close(&session->logs[i]->reader);
        free(session->logs[i]);
    }
    free(session->logs);
    id_table_free(&session->ids);
    memset(session, 0, sizeof *session);
}
