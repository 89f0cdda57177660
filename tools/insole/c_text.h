/** @file c_text.h  Pieces of C source: literals that give back what they were made of.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_C_TEXT_H
#define INSOLE_HOST_C_TEXT_H

#include <stdio.h>

#include "insole/base/real.h"
#include "number.h"

enum { C_REAL_ROOM = NUMBER_ROOM + 16 };

/** A literal of the library's real type, with as few digits as give it back. @return buffer */
const char *c_real(char buffer[C_REAL_ROOM], insole_real_t value);

/** A string in its quotes. What is not a plain character is written in octal; `?` too, so that no
 *  trigraph comes about. */
void c_write_string(FILE *file, const char *text);

/** The name of a file, without its folder, in a comment, which it must not end. */
void c_write_comment(FILE *file, const char *path);

#endif
