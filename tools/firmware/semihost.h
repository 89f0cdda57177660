/** @file semihost.h  What a bare-metal image may ask of the host that emulates it.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_FIRMWARE_SEMIHOST_H
#define INSOLE_FIRMWARE_SEMIHOST_H

#include <stdbool.h>
#include <stdint.h>

/** Prints a text on the host's standard output. */
void semihost_write(const char *text);

/** The words that the image was started with, a blank between them. @return false when they are
 * more than fit, or there are none */
bool semihost_command_line(char *text, uint32_t room);

/** A file of the host, to be read. @return its number, -1 when it cannot be read */
int32_t semihost_open(const char *name);

/** @return bytes read; 0 at the end of the file */
uint32_t semihost_read(int32_t file, uint8_t *bytes, uint32_t room);

/** Ends the emulation with an exit code; does not return. */
void semihost_exit(int code) __attribute__((noreturn));

#endif
