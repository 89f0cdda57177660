/* SPDX-License-Identifier: MIT */
#include "semihost.h"

#include <string.h>

enum {
    SYS_OPEN = 0x01,
    SYS_WRITE0 = 0x04,
    SYS_READ = 0x06,
    SYS_GET_CMDLINE = 0x15,
    SYS_EXIT_EXTENDED = 0x20
};
enum { MODE_RB = 1 };
#define APPLICATION_EXIT 0x20026u

static uint32_t semihost_call(uint32_t operation, const void *argument)
{
    register uint32_t r0 __asm("r0") = operation;
    register const void *r1 __asm("r1") = argument;
    __asm volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
    return r0;
}

void semihost_write(const char *text)
{
    semihost_call(SYS_WRITE0, text);
}

bool semihost_command_line(char *text, uint32_t room)
{
    const struct {
        char *text;
        uint32_t room;
    } block = {text, room};
    return semihost_call(SYS_GET_CMDLINE, &block) == 0u;
}

int32_t semihost_open(const char *name)
{
    const struct {
        const char *name;
        uint32_t mode, length;
    } block = {name, MODE_RB, (uint32_t)strlen(name)};
    return (int32_t)semihost_call(SYS_OPEN, &block);
}

/* The call tells how many bytes it did not read. */
uint32_t semihost_read(int32_t file, uint8_t *bytes, uint32_t room)
{
    const struct {
        int32_t file;
        uint8_t *bytes;
        uint32_t room;
    } block = {file, bytes, room};
    uint32_t unread = semihost_call(SYS_READ, &block);
    return unread <= room ? room - unread : 0u;
}

void semihost_exit(int code)
{
    const uint32_t block[2] = {APPLICATION_EXIT, (uint32_t)code};
    for (;;) {
        semihost_call(SYS_EXIT_EXTENDED, block);
    }
}
