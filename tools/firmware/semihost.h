/** @file semihost.h  What a bare-metal image may ask of the host that emulates it.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_FIRMWARE_SEMIHOST_H
#define INSOLE_FIRMWARE_SEMIHOST_H

/** Prints a text on the host's standard output. */
void semihost_write(const char *text);

/** Ends the emulation with an exit code; does not return. */
void semihost_exit(int code) __attribute__((noreturn));

#endif
