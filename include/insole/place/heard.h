/** @file heard.h  One scan made ready for a radio map: in order of access points, each once.
 *
 *  Source  [PhoneEKF] 3.2, the RSS vector r.
 *
 *      static insole_heard_t heard;
 *      if (insole_heard_passing(map.ap_count, age_max_us, readings, count) >= 3)
 *          insole_heard_gather(&heard, map.ap_count, age_max_us, readings, count);
 *
 *  Left out: access points that the map does not know, readings that are too old or not in
 *  -127 .. 0 dBm. Of two of one access point the stronger counts; of too many the strongest stay.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_PLACE_HEARD_H
#define INSOLE_PLACE_HEARD_H

#include "insole/base/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/** What is beyond counts as unheard: room for a crowded mall, at six bytes each. A firmware for a
 *  small site may set less when it compiles the library, and then itself. */
#ifndef INSOLE_HEARD_MAX
#define INSOLE_HEARD_MAX 512
#endif

typedef struct {
    uint32_t count;
    insole_real_t dbm[INSOLE_HEARD_MAX];
    uint16_t ap[INSOLE_HEARD_MAX]; /**< ascending */
} insole_heard_t;

/** Readings that are not left out; two of one access point count twice. */
uint32_t insole_heard_passing(uint32_t ap_count, uint32_t age_max_us, const insole_rss_t *readings,
                              uint32_t count);

/** @return INSOLE_ERR_NULL; INSOLE_OK with nothing heard, too */
insole_status_t insole_heard_gather(insole_heard_t *heard, uint32_t ap_count, uint32_t age_max_us,
                                    const insole_rss_t *readings, uint32_t count);

/** Moves `at` on to the access point; those asked for must ascend, `at` begins at 0.
 *  @return whether it is heard: heard->dbm[*at] is its strength then */
static inline bool insole_heard_seek(const insole_heard_t *heard, uint32_t *at, uint32_t ap)
{
    while (*at < heard->count && heard->ap[*at] < ap) {
        (*at)++;
    }
    return *at < heard->count && heard->ap[*at] == ap;
}

#ifdef __cplusplus
}
#endif

#endif
