/** @file device.h  A device from frames to rows; the same C on every chip and at the desk.
 *
 *      device_start();
 *      for each frame:
 *          answer = device_take(&frame);
 *          DEVICE_RESETS: device_save(), and the reset; DEVICE_ENDS: device_end(frames_lost)
 *
 *  Each reading of the IMU is followed by one slice of work, so what comes out depends on what came
 *  in and on nothing else. Rows are those of a track file, with one column more: the CRC-32 of all
 *  fixes so far, each as 12 words: time (low, high), position, heading, the five variances in the
 *  row's order, state.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_FIRMWARE_DEVICE_H
#define INSOLE_FIRMWARE_DEVICE_H

#include "wire.h"

typedef enum { DEVICE_GOES_ON, DEVICE_RESETS, DEVICE_ENDS } device_answer_t;

/** Goes on with the state that has survived a reset, or waits for a head. What has survived is used
 *  once: a state that makes the device fail does not come back.
 *  @param image  tells images apart: addresses in a state mean nothing to another */
void device_start(uint32_t image);

device_answer_t device_take(const wire_frame_t *frame);

/** Keeps the state for device_start. @return false when there is no room, a mistake in the build */
bool device_save(void);

/** Says how it went. @return 0; 1 when a walk had no head or the settings were refused */
int device_end(uint32_t bad_frames, uint32_t stack_bytes);

#endif
