/* SPDX-License-Identifier: MIT */
#include "insole/place/radio_survey.h"

#include <stddef.h>

#define ZERO INSOLE_R(0.0)
#define HALF INSOLE_R(0.5)
#define ONE  INSOLE_R(1.0)

#define FAR_M        INSOLE_R(1e5)
#define STEPS_PER_DB INSOLE_R(8.0) /* of a spread */

enum { COUNT_MAX = 1000000, BINS = INSOLE_RADIO_BINS };

insole_status_t insole_radio_survey_init(insole_radio_survey_t *survey, insole_real_t spacing_m,
                                         insole_survey_point_t *points, uint32_t point_room,
                                         insole_survey_record_t *records, uint32_t record_room)
{
    if (!survey || !points || !records) {
        return INSOLE_ERR_NULL;
    }
    if (!(spacing_m >= INSOLE_R(0.05) && spacing_m <= INSOLE_R(1000.0)) || point_room == 0u ||
        record_room == 0u) {
        return INSOLE_ERR_VALUE;
    }
    insole_radio_survey_t blank = {spacing_m, points, 0, point_room, records, 0, record_room, 0, 0};
    for (uint32_t i = 0; i < record_room; i++) {
        records[i].stat.count = 0;
    }
    *survey = blank;
    return INSOLE_OK;
}

/* ---- one sample, or many at once ---- */

static bool is_sound(insole_spot_t spot, uint32_t ap, const insole_survey_stat_t *stat)
{
    uint64_t sum = 0;
    for (int i = 0; i < BINS; i++) {
        sum += stat->bins[i];
    }
    bool placed = insole_abs(spot.x_m) <= FAR_M && insole_abs(spot.y_m) <= FAR_M;
    bool strength = stat->mean_dbm >= INSOLE_R(-127.0) && stat->mean_dbm <= ZERO &&
                    stat->std_db >= ZERO && stat->std_db <= INSOLE_R(127.0);
    bool counted = stat->count > 0u && stat->count <= (uint32_t)COUNT_MAX && sum == stat->count;
    return placed && strength && counted && ap < (uint32_t)INSOLE_RADIO_APS_MAX;
}

static int32_t square_of(insole_real_t m, insole_real_t spacing_m)
{
    int32_t square = (int32_t)(m / spacing_m);
    return (insole_real_t)square * spacing_m > m ? square - 1 : square;
}

static bool is_in(const insole_survey_point_t *point, int32_t column, int32_t row)
{
    return point->column == column && point->row == row;
}

/* The point of a square; `point_count` when it has none yet. */
static uint32_t find_point(const insole_radio_survey_t *survey, int32_t column, int32_t row)
{
    if (survey->last < survey->point_count && is_in(&survey->points[survey->last], column, row)) {
        return survey->last;
    }
    uint32_t i = 0;
    while (i < survey->point_count && !is_in(&survey->points[i], column, row)) {
        i++;
    }
    return i;
}

/* The record of an access point at a point, or the free slot for it; `record_room`: none. */
static uint32_t find_record(const insole_radio_survey_t *survey, uint32_t point, uint32_t ap)
{
    uint32_t hash = (point * 2654435761u) ^ (ap * 2246822519u);
    hash ^= hash >> 15;
    uint32_t room = survey->record_room, slot = hash % room;
    for (uint32_t tried = 0; tried < room; tried++) {
        const insole_survey_record_t *record = &survey->records[slot];
        if (record->stat.count == 0u || (record->point == point && record->ap == ap)) {
            return slot;
        }
        slot = slot + 1u < room ? slot + 1u : 0u;
    }
    return room;
}

/* Means, spreads and counts of two sets of samples made those of both. */
static void pool(insole_survey_stat_t *stat, const insole_survey_stat_t *more)
{
    insole_real_t n = (insole_real_t)stat->count, m = (insole_real_t)more->count;
    insole_real_t share = m / (n + m), gap_db = more->mean_dbm - stat->mean_dbm;
    insole_real_t variance_db2 = (ONE - share) * insole_square(stat->std_db) +
                                 share * insole_square(more->std_db) +
                                 share * (ONE - share) * gap_db * gap_db;
    stat->mean_dbm += share * gap_db;
    stat->std_db = insole_sqrt(variance_db2);
    stat->count += more->count;
    for (int i = 0; i < BINS; i++) {
        stat->bins[i] += more->bins[i];
    }
}

/* `heard`: how often the access point was heard there, with the new samples. */
static void locate(insole_survey_point_t *point, insole_spot_t spot, uint32_t count, uint32_t heard)
{
    point->samples += count;
    point->visits = heard > point->visits ? heard : point->visits;
    insole_real_t share = (insole_real_t)count / (insole_real_t)point->samples;
    point->spot.x_m += share * (spot.x_m - point->spot.x_m);
    point->spot.y_m += share * (spot.y_m - point->spot.y_m);
}

/* Where a sample goes: a point, known or to be, and a record, in use or free. */
typedef struct {
    int32_t column, row;
    uint32_t point, slot;
} target_t;

static target_t target_of(const insole_radio_survey_t *survey, insole_spot_t spot, uint32_t ap)
{
    target_t target;
    target.column = square_of(spot.x_m, survey->spacing_m);
    target.row = square_of(spot.y_m, survey->spacing_m);
    target.point = find_point(survey, target.column, target.row);
    target.slot = find_record(survey, target.point, ap);
    return target;
}

static bool has_room(const insole_radio_survey_t *survey, const target_t *target, uint32_t count)
{
    if (target->point == survey->point_room || target->slot == survey->record_room) {
        return false;
    }
    bool known = target->point < survey->point_count;
    return survey->records[target->slot].stat.count <= (uint32_t)COUNT_MAX - count &&
           (!known || survey->points[target->point].samples <= UINT32_MAX - count);
}

insole_status_t insole_radio_survey_merge(insole_radio_survey_t *survey, insole_spot_t spot,
                                          uint32_t ap, const insole_survey_stat_t *stat)
{
    if (!survey || !stat) {
        return INSOLE_ERR_NULL;
    }
    if (!is_sound(spot, ap, stat)) {
        return INSOLE_ERR_VALUE;
    }
    target_t target = target_of(survey, spot, ap);
    if (!has_room(survey, &target, stat->count)) {
        return INSOLE_ERR_ROOM;
    }
    if (target.point == survey->point_count) {
        insole_survey_point_t fresh = {target.column, target.row, spot, 0, 0};
        survey->points[survey->point_count++] = fresh;
    }
    insole_survey_record_t *record = &survey->records[target.slot];
    if (record->stat.count == 0u) {
        insole_survey_record_t fresh = {target.point, ap, *stat};
        *record = fresh;
        survey->record_count++;
    } else {
        pool(&record->stat, stat);
    }
    locate(&survey->points[target.point], spot, stat->count, record->stat.count);
    survey->last = target.point;
    survey->ap_count = ap >= survey->ap_count ? ap + 1u : survey->ap_count;
    return INSOLE_OK;
}

insole_status_t insole_radio_survey_add(insole_radio_survey_t *survey, insole_spot_t spot,
                                        uint32_t ap, insole_real_t dbm)
{
    insole_survey_stat_t one = {dbm, ZERO, 1u, {0}};
    one.bins[insole_radio_bin(dbm)] = 1u;
    return insole_radio_survey_merge(survey, spot, ap, &one);
}

insole_status_t insole_radio_survey_join(insole_radio_survey_t *survey,
                                         const insole_radio_survey_t *other)
{
    if (!survey || !other) {
        return INSOLE_ERR_NULL;
    }
    insole_status_t first = INSOLE_OK;
    for (uint32_t i = 0; i < other->record_room; i++) {
        const insole_survey_record_t *record = &other->records[i];
        if (record->stat.count > 0u) {
            insole_status_t status = insole_radio_survey_merge(
                survey, other->points[record->point].spot, record->ap, &record->stat);
            first = first == INSOLE_OK ? status : first;
        }
    }
    return first;
}

/* ---- the frozen map ---- */

enum { NOBODY = INSOLE_RADIO_APS_MAX }; /* the access point of an entry that is still free */

static uint8_t to_byte(insole_real_t x)
{
    return (uint8_t)insole_max(ZERO, insole_min(x + HALF, INSOLE_R(255.0)));
}

/* A count as a byte, on the scale that makes the point's visits one. */
static uint8_t scaled_count(uint32_t count, uint32_t visits)
{
    insole_real_t scale = visits > 255u ? INSOLE_R(255.0) / (insole_real_t)visits : ONE;
    uint8_t scaled = to_byte(scale * (insole_real_t)count);
    return count > 0u && scaled == 0u ? 1u : scaled;
}

/* The entries of the points begin one after the other; returns how many there are. */
static uint32_t lay_out(const insole_radio_survey_t *survey, uint32_t keep, uint32_t *first)
{
    for (uint32_t i = 0; i <= survey->point_count; i++) {
        first[i] = 0;
    }
    for (uint32_t i = 0; i < survey->record_room; i++) {
        const insole_survey_record_t *record = &survey->records[i];
        if (record->stat.count > 0u && first[record->point + 1u] < keep) {
            first[record->point + 1u]++;
        }
    }
    for (uint32_t i = 0; i < survey->point_count; i++) {
        first[i + 1u] += first[i];
    }
    return first[survey->point_count];
}

static void move_entry(const insole_radio_map_memory_t *memory, uint32_t to, uint32_t from)
{
    memory->aps[to] = memory->aps[from];
    memory->below[to] = memory->below[from];
    if (memory->spread) {
        memory->spread[to] = memory->spread[from];
    }
    if (memory->counts) {
        memory->counts[to] = memory->counts[from];
    }
    for (uint32_t i = 0; memory->bins && i < (uint32_t)BINS; i++) {
        memory->bins[(size_t)to * BINS + i] = memory->bins[(size_t)from * BINS + i];
    }
}

static void write_entry(const insole_radio_map_memory_t *memory, uint32_t at,
                        const insole_survey_record_t *record, uint32_t visits)
{
    const insole_survey_stat_t *stat = &record->stat;
    memory->aps[at] = (uint16_t)record->ap;
    memory->below[at] = insole_radio_level(stat->mean_dbm);
    if (memory->spread) {
        memory->spread[at] = to_byte(STEPS_PER_DB * stat->std_db);
    }
    if (memory->counts) {
        memory->counts[at] = scaled_count(stat->count, visits);
    }
    for (uint32_t i = 0; memory->bins && i < (uint32_t)BINS; i++) {
        memory->bins[(size_t)at * BINS + i] = scaled_count(stat->bins[i], visits);
    }
}

/* The weakest of a full point; of equals the one with the highest number. */
static uint32_t weakest(const insole_radio_map_memory_t *memory, uint32_t from, uint32_t end)
{
    uint32_t at = from;
    for (uint32_t i = from + 1u; i < end; i++) {
        at = memory->below[i] >= memory->below[at] ? i : at;
    }
    return at;
}

/* Makes room in a point that holds all it may keep; false: the record is the weakest itself. */
static bool make_room(const insole_radio_map_memory_t *memory, uint32_t from, uint32_t end,
                      const insole_survey_record_t *record)
{
    uint32_t least = weakest(memory, from, end);
    uint8_t level = insole_radio_level(record->stat.mean_dbm);
    if (level > memory->below[least] ||
        (level == memory->below[least] && record->ap > memory->aps[least])) {
        return false;
    }
    for (uint32_t i = least; i + 1u < end; i++) {
        move_entry(memory, i, i + 1u);
    }
    memory->aps[end - 1u] = NOBODY;
    return true;
}

/* Puts a record among the entries of its point, in order of access points. */
static void insert(const insole_radio_map_memory_t *memory, const insole_survey_record_t *record,
                   uint32_t visits)
{
    uint32_t from = memory->first[record->point], end = memory->first[record->point + 1u];
    if (memory->aps[end - 1u] != NOBODY && !make_room(memory, from, end, record)) {
        return;
    }
    uint32_t free = from;
    while (memory->aps[free] != NOBODY) {
        free++;
    }
    for (; free > from && memory->aps[free - 1u] > record->ap; free--) {
        move_entry(memory, free, free - 1u);
    }
    write_entry(memory, free, record, visits);
}

static void fill(const insole_radio_survey_t *survey, const insole_radio_map_memory_t *memory,
                 uint32_t entries)
{
    for (uint32_t i = 0; i < entries; i++) {
        memory->aps[i] = NOBODY;
    }
    for (uint32_t i = 0; i < survey->record_room; i++) {
        const insole_survey_record_t *record = &survey->records[i];
        if (record->stat.count > 0u) {
            insert(memory, record, survey->points[record->point].visits);
        }
    }
    for (uint32_t i = 0; i < survey->point_count; i++) {
        memory->spots[i] = survey->points[i].spot;
        if (memory->visits) {
            memory->visits[i] = scaled_count(survey->points[i].visits, survey->points[i].visits);
        }
    }
}

insole_status_t insole_radio_survey_freeze(const insole_radio_survey_t *survey, uint32_t keep,
                                           const insole_radio_map_memory_t *memory,
                                           insole_radio_map_t *map)
{
    if (!survey || !memory || !map || !memory->spots || !memory->first || !memory->aps ||
        !memory->below) {
        return INSOLE_ERR_NULL;
    }
    if (keep == 0u) {
        return INSOLE_ERR_VALUE;
    }
    if (survey->record_count == 0u) {
        return INSOLE_ERR_STATE;
    }
    if (survey->point_count > memory->point_room ||
        lay_out(survey, keep, memory->first) > memory->entry_room) {
        return INSOLE_ERR_ROOM;
    }
    fill(survey, memory, memory->first[survey->point_count]);
    insole_radio_map_t frozen = {
        survey->point_count, survey->ap_count, memory->spots,  memory->first,  memory->visits,
        memory->aps,         memory->below,    memory->spread, memory->counts, memory->bins};
    *map = frozen;
    return INSOLE_OK;
}
