/** @file files.h  Files for tests of the program: made of text, read back as text.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TESTS_HOST_FILES_H
#define INSOLE_TESTS_HOST_FILES_H

#include <check.h>
#include <stdio.h>
#include <string.h>

enum { TEXT_ROOM = 262144 };

/** A file that holds these bytes, open for reading. */
static inline FILE *file_of_bytes(const char *bytes, size_t size)
{
    FILE *file = tmpfile();
    ck_assert_ptr_nonnull(file);
    ck_assert_uint_eq(fwrite(bytes, 1u, size, file), size);
    rewind(file);
    return file;
}

static inline FILE *file_of(const char *text)
{
    return file_of_bytes(text, strlen(text));
}

/** All that was written to a file, as a string in a static buffer; closes the file. */
static inline const char *text_of(FILE *file)
{
    static char text[TEXT_ROOM];
    fflush(file);
    rewind(file);
    size_t size = fread(text, 1u, sizeof text - 1u, file);
    ck_assert_uint_lt(size, sizeof text - 1u);
    text[size] = '\0';
    fclose(file);
    return text;
}

/** Path of a file in the scratch folder of the suite, in one of 64 static buffers. */
static inline const char *scratch(const char *name)
{
    static char path[64][512];
    static int next;
    next = (next + 1) % 64;
    snprintf(path[next], sizeof path[next], "%s/%s", SCRATCH, name);
    return path[next];
}

/** Makes a file in the scratch folder. @return its path */
static inline const char *scratch_file(const char *name, const char *text)
{
    const char *path = scratch(name);
    FILE *file = fopen(path, "wb");
    ck_assert_ptr_nonnull(file);
    fputs(text, file);
    fclose(file);
    return path;
}

/** Content of a file, in a static buffer. */
static inline const char *content_of(const char *path)
{
    FILE *file = fopen(path, "rb");
    ck_assert_ptr_nonnull(file);
    return text_of(file);
}

/** How often something is in a text. */
static inline int count_of(const char *text, const char *what)
{
    int count = 0;
    for (; (text = strstr(text, what)) != NULL; text++) {
        count++;
    }
    return count;
}

#endif
