/** @file pack_writer.h  A site as constant C tables, ready for flash.
 *
 *  What is written compiles against the library's headers. Numbers have as many digits as it takes
 *  to get every bit back, so that the plan in flash answers as the one that was packed.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_PACK_WRITER_H
#define INSOLE_HOST_PACK_WRITER_H

#include "site.h"

enum { PACK_NAME_LENGTH = 40 };

/** Can the names of the tables begin so? A letter, then letters, digits and underscores. */
bool pack_is_name(const char *name);

/** @param name  what the names of the tables begin with */
void pack_write(FILE *file, const site_t *site, const char *name);

#endif
