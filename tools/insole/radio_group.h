/** @file radio_group.h  Signal strengths and ranges of one moment, gathered from their records.
 *
 *  Records of equal time that follow one another belong together: those of kind rss are one scan.
 *
 *      if (radio_group_ends(&group, &record)) use(&group), radio_group_clear(&group);
 *      if (record.kind == RECORD_RSS || record.kind == RECORD_RANGE)
 *          radio_group_add(&group, &record);
 *      radio_group_free(&group);
 *
 *  A scan counts as heard when its youngest reading was: at its time less the smallest age.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_RADIO_GROUP_H
#define INSOLE_HOST_RADIO_GROUP_H

#include <stdbool.h>
#include <stddef.h>

#include "insole/base/types.h"
#include "record.h"

/** An empty group is all zeros. */
typedef struct {
    int64_t t_us;          /**< of the records */
    insole_rss_t *rss;     /**< ages since the moment the scan was heard */
    insole_range_t *range; /**< their times are to be filled in */
    size_t rss_count, rss_room, range_count, range_room;
    uint32_t age_us; /**< smallest of the scan */
} radio_group_t;

bool radio_group_is_empty(const radio_group_t *group);

/** Does the group hold records of another time than this? */
bool radio_group_ends(const radio_group_t *group, const record_t *record);

/** Takes a record of kind RSS or RANGE, of the group's time. Its id is handed on as it is. */
void radio_group_add(radio_group_t *group, const record_t *record);

/** Nothing is held any more. */
void radio_group_clear(radio_group_t *group);

void radio_group_free(radio_group_t *group);

#endif
