/** @file platform.h  The few things the program asks of the operating system (POSIX).
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_PLATFORM_H
#define INSOLE_HOST_PLATFORM_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

bool platform_is_folder(const char *path);

/** The last part of a path. */
const char *platform_base_name(const char *path);

/** Do both paths lead to the same file? */
bool platform_is_same_file(const char *a, const char *b);

bool platform_is_terminal(FILE *file);

/** Paths of the files in a folder whose name ends in `ending` and does not begin with a dot,
 *  sorted by name; to be freed with platform_free_paths.
 *  @return false when the folder cannot be read */
bool platform_list(const char *folder, const char *ending, char ***paths, size_t *count);

void platform_free_paths(char **paths, size_t count);

/** A path with a folder in front. @return to be freed with free() */
char *platform_join(const char *folder, const char *name);

/** Makes a folder where there is none. @return false when it is not there then */
bool platform_make_folder(const char *path);

/** A new folder for files that nobody keeps. @return its path, to be freed with free(); NULL: it
 *  could not be made */
char *platform_scratch_folder(void);

/** Removes a folder and the files in it. */
void platform_remove_folder(const char *path);

/** Bytes of a regular file; 0 for anything else. */
unsigned long long platform_file_size(const char *path);

/** Seconds of a clock that only goes forward. */
double platform_seconds(void);

#endif
