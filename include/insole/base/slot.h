/** @file slot.h  Which slot of even length a time stamp lies in.
 *
 *  Slot 0 begins with the clock. A processor that divides 32 bits has the answer in four
 *  divisions, as by pencil, where a division of 64 bits would be a library's.
 *
 *      uint64_t slot = insole_slot_of(imu.t_us, 50000u);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_BASE_SLOT_H
#define INSOLE_BASE_SLOT_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** @param slot_us  1 to 65536; longer ones that are even serve with half of both
 *  @return t_us / slot_us without its remainder; 0 for a length out of its range */
uint64_t insole_slot_of(uint64_t t_us, uint32_t slot_us);

#ifdef __cplusplus
}
#endif

#endif
