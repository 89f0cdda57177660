/* SPDX-License-Identifier: MIT
 * A board on a debugger, or an emulator: the stream is a file of the host, which the command line
 * of the image names last; rows go to the host's output. */
#include <stdint.h>

#include "board.h"
#include "semihost.h"

enum { ROOM = 256 };

static uint8_t bytes[ROOM];
static uint32_t count, next; /* bytes that are there, and the next of them */
static char line[ROOM];
static uint32_t written;
static int32_t file;

/* The last word. */
static const char *file_name(char *command_line)
{
    const char *word = command_line;
    for (char *at = command_line; *at != '\0'; at++) {
        word = *at == ' ' ? at + 1 : word;
    }
    return word;
}

void board_start(void)
{
    static char command_line[ROOM];
    file = semihost_command_line(command_line, sizeof command_line)
               ? semihost_open(file_name(command_line))
               : -1;
}

int board_read(void)
{
    if (next == count) {
        next = 0u;
        count = file >= 0 ? semihost_read(file, bytes, sizeof bytes) : 0u;
    }
    return next < count ? bytes[next++] : -1;
}

static void flush(void)
{
    line[written] = '\0';
    semihost_write(line);
    written = 0u;
}

void board_write(char byte)
{
    line[written++] = byte;
    if (byte == '\n' || written == sizeof line - 1u) {
        flush();
    }
}

void board_end(int code)
{
    flush();
    semihost_exit(code);
}
