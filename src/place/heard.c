/* SPDX-License-Identifier: MIT */
#include "insole/place/heard.h"

#include <stddef.h>

static bool passes(uint32_t ap_count, uint32_t age_max_us, const insole_rss_t *reading)
{
    return reading->id < ap_count && reading->id <= UINT16_MAX &&
           reading->rss_dbm >= INSOLE_R(-127.0) && reading->rss_dbm <= INSOLE_R(0.0) &&
           reading->age_us <= age_max_us;
}

uint32_t insole_heard_passing(uint32_t ap_count, uint32_t age_max_us, const insole_rss_t *readings,
                              uint32_t count)
{
    uint32_t passing = 0;
    for (uint32_t i = 0; readings && i < count; i++) {
        passing += passes(ap_count, age_max_us, &readings[i]) ? 1u : 0u;
    }
    return passing;
}

/* The first place whose access point is not below. */
static uint32_t place_of(const insole_heard_t *heard, uint32_t ap)
{
    uint32_t low = 0, high = heard->count;
    while (low < high) {
        uint32_t middle = (low + high) / 2u;
        if (heard->ap[middle] < ap) {
            low = middle + 1u;
        } else {
            high = middle;
        }
    }
    return low;
}

static uint32_t weakest(const insole_heard_t *heard)
{
    uint32_t at = 0;
    for (uint32_t i = 1; i < heard->count; i++) {
        at = heard->dbm[i] < heard->dbm[at] ? i : at;
    }
    return at;
}

static void move(insole_heard_t *heard, uint32_t from, uint32_t to)
{
    heard->ap[to] = heard->ap[from];
    heard->dbm[to] = heard->dbm[from];
}

/* The place `at` is free; between its neighbours it may not be the right one. */
static void insert(insole_heard_t *heard, uint32_t at, const insole_rss_t *reading)
{
    for (; at > 0u && heard->ap[at - 1u] > reading->id; at--) {
        move(heard, at - 1u, at);
    }
    for (; at + 1u < heard->count && heard->ap[at + 1u] < reading->id; at++) {
        move(heard, at + 1u, at);
    }
    heard->ap[at] = (uint16_t)reading->id;
    heard->dbm[at] = reading->rss_dbm;
}

/* One that is new takes a place at the end, or that of the weakest. */
static void take(insole_heard_t *heard, const insole_rss_t *reading)
{
    uint32_t at = place_of(heard, reading->id);
    if (at < heard->count && heard->ap[at] == reading->id) {
        heard->dbm[at] = insole_max(heard->dbm[at], reading->rss_dbm);
        return;
    }
    if (heard->count < (uint32_t)INSOLE_HEARD_MAX) {
        insert(heard, heard->count++, reading);
        return;
    }
    uint32_t least = weakest(heard);
    if (reading->rss_dbm > heard->dbm[least]) {
        insert(heard, least, reading);
    }
}

insole_status_t insole_heard_gather(insole_heard_t *heard, uint32_t ap_count, uint32_t age_max_us,
                                    const insole_rss_t *readings, uint32_t count)
{
    if (!heard || !readings) {
        return INSOLE_ERR_NULL;
    }
    heard->count = 0;
    for (uint32_t i = 0; i < count; i++) {
        if (passes(ap_count, age_max_us, &readings[i])) {
            take(heard, &readings[i]);
        }
    }
    return INSOLE_OK;
}
