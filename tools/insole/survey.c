/* SPDX-License-Identifier: MIT */
#include "survey.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "memory.h"
#include "session.h"
#include "track.h"

/* A walker's direction is that of the way from this long before to this long after; on a shorter
 * way they stand. */
static const int64_t around_us = 1000000;
static const double shortest_way_m = 0.6;

/* A record of rss as it is read, before the truth is complete. */
typedef struct {
    int64_t t_us, heard_us;
    uint32_t id;
    double dbm;
} signal_t;

typedef struct {
    survey_t *survey;
    session_t session;
    track_t truth;
    signal_t *signals;
    size_t count, room;
} reader_t;

static int64_t to_us(double s)
{
    return (int64_t)llround(1e6 * s);
}

static void keep_signal(reader_t *reader, const record_t *record)
{
    double age_s = isfinite(record->value[1]) ? record->value[1] : 0.0;
    if (!isfinite(record->value[0])) {
        reader->survey->unheard++;
        return;
    }
    const signal_t signal = {
        record->t_us, record->t_us - to_us(age_s),
        id_table_number(&reader->survey->ids, reader->session.ids.names[record->id]),
        record->value[0]};
    reader->signals =
        memory_room(reader->signals, &reader->room, reader->count + 1u, sizeof *reader->signals);
    reader->signals[reader->count++] = signal;
}

static bool read_session(reader_t *reader, const char *path, failure_t *failure)
{
    record_t record;
    read_t answer = READ_FAILED;
    if (session_open(&reader->session, &path, 1u, failure)) {
        while ((answer = session_next(&reader->session, &record, failure)) == READ_ONE) {
            if (record.kind == RECORD_TRUTH) {
                track_add_record(&reader->truth, &record);
            } else if (record.kind == RECORD_RSS) {
                keep_signal(reader, &record);
            }
        }
    }
    session_close(&reader->session);
    return answer == READ_END;
}

static void add_scan(survey_t *survey)
{
    const survey_scan_t scan = {survey->sessions, survey->reading_count, 0u};
    survey->scans =
        memory_room(survey->scans, &survey->scan_room, survey->scan_count + 1u, sizeof scan);
    survey->scans[survey->scan_count++] = scan;
}

static void find_heading(const track_t *truth, int64_t t_us, survey_reading_t *reading)
{
    double x0, y0, x1, y1;
    if (track_place(truth, t_us - around_us, &x0, &y0) &&
        track_place(truth, t_us + around_us, &x1, &y1)) {
        double way_m = hypot(x1 - x0, y1 - y0);
        reading->cos_heading = way_m < shortest_way_m ? 0.0 : (x1 - x0) / way_m;
        reading->sin_heading = way_m < shortest_way_m ? 0.0 : (y1 - y0) / way_m;
    }
}

static void add_reading(survey_t *survey, const survey_reading_t *reading)
{
    survey->readings = memory_room(survey->readings, &survey->reading_room,
                                   survey->reading_count + 1u, sizeof *reading);
    survey->readings[survey->reading_count++] = *reading;
    survey->scans[survey->scan_count - 1u].count++;
}

static int compare_signals(const void *a, const void *b)
{
    const signal_t *s = a, *t = b;
    if (s->t_us != t->t_us) {
        return s->t_us < t->t_us ? -1 : 1;
    }
    return (s->id > t->id) - (s->id < t->id);
}

/* Has it a place? Then that and the direction walked there. */
static bool place_reading(const reader_t *reader, int64_t t_us, survey_reading_t *reading)
{
    const survey_rule_t *rule = &reader->survey->rule;
    if (!track_place(&reader->truth, t_us, &reading->x_m, &reading->y_m)) {
        return false;
    }
    find_heading(&reader->truth, t_us, reading);
    reading->x_m += rule->ahead_m * reading->cos_heading;
    reading->y_m += rule->ahead_m * reading->sin_heading;
    return true;
}

static int64_t youngest_of(const signal_t *signals, size_t count)
{
    int64_t youngest_us = signals[0].heard_us;
    for (size_t i = 1u; i < count; i++) {
        youngest_us = signals[i].heard_us > youngest_us ? signals[i].heard_us : youngest_us;
    }
    return youngest_us;
}

/* Adds one scan: `count` signals of one time. */
static void place_scan(reader_t *reader, const signal_t *signals, size_t count)
{
    survey_t *survey = reader->survey;
    const survey_rule_t *rule = &survey->rule;
    int64_t youngest_us = youngest_of(signals, count);
    bool is_begun = false;
    for (size_t i = 0u; i < count; i++) {
        survey_reading_t reading = {signals[i].id, signals[i].dbm, 0.0, 0.0, 0.0, 0.0};
        int64_t heard_us = rule->whole_scans ? youngest_us : signals[i].heard_us;
        int64_t late_us = heard_us + to_us(rule->late_s);
        int64_t at_us = late_us < signals[i].t_us ? late_us : signals[i].t_us;
        if (rule->oldest_s > 0.0 && youngest_us - signals[i].heard_us > to_us(rule->oldest_s)) {
            survey->stale++;
        } else if (!place_reading(reader, at_us, &reading)) {
            survey->outside++;
        } else {
            if (!is_begun) {
                add_scan(survey);
            }
            is_begun = true;
            add_reading(survey, &reading);
        }
    }
}

static void place_signals(reader_t *reader)
{
    if (reader->count > 1u) {
        qsort(reader->signals, reader->count, sizeof *reader->signals, compare_signals);
    }
    for (size_t i = 0u, end; i < reader->count; i = end) {
        for (end = i; end < reader->count && reader->signals[end].t_us == reader->signals[i].t_us;
             end++) {
        }
        place_scan(reader, &reader->signals[i], end - i);
    }
}

static bool check_session(const reader_t *reader, const char *path, failure_t *failure)
{
    if (reader->truth.count == 0u) {
        return failure_input(failure,
                             "%s: no truth: a survey tells where it was made, by truth records or "
                             "a file t,x,y in the same folder",
                             path);
    }
    return reader->count > 0u ||
           failure_input(failure, "%s: no signal strengths: expected rss records", path);
}

bool survey_add(survey_t *survey, const char *path, failure_t *failure)
{
    reader_t reader;
    memset(&reader, 0, sizeof reader);
    reader.survey = survey;
    bool is_good = read_session(&reader, path, failure) && check_session(&reader, path, failure);
    if (is_good) {
        track_sort(&reader.truth);
        place_signals(&reader);
        survey->sessions++;
    }
    track_free(&reader.truth);
    free(reader.signals);
    return is_good;
}

void survey_free(survey_t *survey)
{
    id_table_free(&survey->ids);
    free(survey->readings);
    free(survey->scans);
    memset(survey, 0, sizeof *survey);
}
