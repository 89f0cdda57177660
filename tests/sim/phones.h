/** @file phones.h  Walks with a phone, for the suites of the simulator.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TESTS_PHONES_H
#define INSOLE_TESTS_PHONES_H

#include "walks.h"

/** The phone of a walk that must be possible. */
static inline const sim_phone_t *phone_of(const sim_walk_t *walk)
{
    const sim_phone_t *phone = sim_walk_phone(walk);
    ck_assert_ptr_nonnull(phone);
    return phone;
}

#define PHONE "log.sensor = phone\n"

/** A long straight walk, some turns and stops. */
#define STRAIGHT PHONE "start,0,0,0\nwalk,60,0,1.3\n"
#define CORNERS                                                                                    \
    PHONE "start,0,0,0.4\nwalk,8,3,1.2\nwalk,8,12,1.4\npause,4\nwalk,2,12,1\nturn,1\npause,3\n"

/** Nobody differs from the mean, and no step from the others. */
#define SAME                                                                                       \
    "person.leg_spread = 0\nperson.step_spread = 0\nperson.bounce_spread = 0\n"                    \
    "person.spread = 0\nphone.rock_spread = 0\nphone.hold_rad = 0\n"

/** The hand does nothing of its own. */
#define CALM "phone.wander_rad = 0\nphone.tremor_rad = 0\nphone.fidgets_hz = 0\n"

#endif
