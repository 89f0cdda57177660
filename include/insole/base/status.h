/** @file status.h  What every call of the library answers.
 *
 *  Zero is success, negative a refusal. A refused call leaves the state as it was, but for the
 *  state's own counter of refusals.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_BASE_STATUS_H
#define INSOLE_BASE_STATUS_H

#ifdef __cplusplus
extern "C" {
#endif

typedef enum {
    INSOLE_OK = 0,         /**< done */
    INSOLE_ERR_NULL = -1,  /**< a pointer that must point somewhere is NULL */
    INSOLE_ERR_VALUE = -2, /**< an argument is not finite or outside its documented range */
    INSOLE_ERR_TIME = -3,  /**< a time stamp does not come after the one before */
    INSOLE_ERR_STATE = -4, /**< the call does not fit the state (not aligned, nothing to answer) */
    INSOLE_ERR_ROOM = -5,  /**< the caller's memory is too small */
    INSOLE_ERR_DATA = -6   /**< a snapshot or table is damaged or of another version */
} insole_status_t;

/** A short English text for a status, never NULL; unknown codes give "unknown status". */
const char *insole_status_text(insole_status_t status);

#ifdef __cplusplus
}
#endif

#endif
