/** @file startup.h  What the start-up code leaves behind.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_FIRMWARE_STARTUP_H
#define INSOLE_FIRMWARE_STARTUP_H

/** Each word of the stack that has not been used yet. */
#define STARTUP_PAINT 0x5ac3a53cu

/** Called when the line of interrupt BOARD_INTERRUPT asks for it, in images that have one. */
void startup_interrupt(void);

#endif
