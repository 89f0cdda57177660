/** @file snapshot.h  A state saved bit for bit, with version and CRC, to survive a reset.
 *
 *  Any state struct of the library can be saved: it holds no pointers to itself. The kind keeps
 *  states of different modules apart; the version changes with the library's layout. The header is
 *  little-endian; the state is the machine's own bytes, for a machine of the same kind.
 *
 *      size_t n;
 *      insole_snapshot_save(KIND, &state, sizeof state, flash, sizeof flash, &n);
 *      after the reset:
 *      if (insole_snapshot_load(KIND, &state, sizeof state, flash, n) != INSOLE_OK) start afresh;
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_BASE_SNAPSHOT_H
#define INSOLE_BASE_SNAPSHOT_H

#include <stddef.h>
#include <stdint.h>

#include "insole/base/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Bytes in front of the state: magic, kind, version, size, CRC, four each. */
enum { INSOLE_SNAPSHOT_HEADER_BYTES = 20 };

/** Layout of the state structs; counts up whenever one of them changes. */
enum { INSOLE_SNAPSHOT_VERSION = 1 };

/** CRC-32 (IEEE 802.3, reflected, as in zip); start with crc = 0, chain freely. NULL is empty. */
uint32_t insole_crc32(uint32_t crc, const void *bytes, size_t count);

/** @param[out] used bytes written: header + size; untouched when refused, and so is the buffer
 *  @return INSOLE_ERR_VALUE when `size` does not fit into 32 bits, INSOLE_ERR_ROOM when `room` is
 *          too small */
insole_status_t insole_snapshot_save(uint32_t kind, const void *state, size_t size, void *buffer,
                                     size_t room, size_t *used);

/** The state is touched only when everything fits; bytes behind the snapshot do not matter.
 *  @return INSOLE_ERR_DATA when magic, kind, version, size or CRC are wrong or bytes are missing */
insole_status_t insole_snapshot_load(uint32_t kind, void *state, size_t size, const void *buffer,
                                     size_t count);

#ifdef __cplusplus
}
#endif

#endif
