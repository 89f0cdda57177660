/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L

#include "platform.h"

#include <dirent.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "memory.h"

bool platform_is_folder(const char *path)
{
    struct stat info;
    return stat(path, &info) == 0 && S_ISDIR(info.st_mode);
}

const char *platform_base_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash != NULL && slash[1] != '\0' ? slash + 1 : path;
}

bool platform_is_same_file(const char *a, const char *b)
{
    struct stat of_a, of_b;
    return stat(a, &of_a) == 0 && stat(b, &of_b) == 0 && S_ISREG(of_a.st_mode) &&
           of_a.st_dev == of_b.st_dev && of_a.st_ino == of_b.st_ino;
}

bool platform_is_terminal(FILE *file)
{
    return isatty(fileno(file)) != 0;
}

unsigned long long platform_file_size(const char *path)
{
    struct stat info;
    bool is_file = stat(path, &info) == 0 && S_ISREG(info.st_mode) && info.st_size > 0;
    return is_file ? (unsigned long long)info.st_size : 0u;
}

static bool ends_with(const char *name, const char *ending)
{
    size_t length = strlen(name), tail = strlen(ending);
    return length > tail && strcmp(name + length - tail, ending) == 0;
}

char *platform_join(const char *folder, const char *name)
{
    size_t size = strlen(folder) + strlen(name) + 2u;
    char *path = memory_new(size, 1u);
    bool has_slash = folder[0] != '\0' && folder[strlen(folder) - 1u] == '/';
    snprintf(path, size, "%s%s%s", folder, has_slash ? "" : "/", name);
    return path;
}

bool platform_make_folder(const char *path)
{
    return mkdir(path, 0777) == 0 || platform_is_folder(path);
}

char *platform_scratch_folder(void)
{
    const char *parent = getenv("TMPDIR");
    char *path =
        platform_join(parent != NULL && parent[0] != '\0' ? parent : "/tmp", "insole-XXXXXX");
    if (mkdtemp(path) == NULL) {
        free(path);
        return NULL;
    }
    return path;
}

void platform_remove_folder(const char *path)
{
    DIR *open_folder = opendir(path);
    if (open_folder == NULL) {
        return;
    }
    for (struct dirent *entry; (entry = readdir(open_folder)) != NULL;) {
        if (strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0) {
            char *file = platform_join(path, entry->d_name);
            (void)unlink(file);
            free(file);
        }
    }
    closedir(open_folder);
    (void)rmdir(path);
}

static int compare_paths(const void *a, const void *b)
{
    return strcmp(*(char *const *)a, *(char *const *)b);
}

bool platform_list(const char *folder, const char *ending, char ***paths, size_t *count)
{
    DIR *open_folder = opendir(folder);
    if (open_folder == NULL) {
        return false;
    }
    size_t room = 0u;
    *paths = NULL;
    *count = 0u;
    for (struct dirent *entry; (entry = readdir(open_folder)) != NULL;) {
        if (entry->d_name[0] != '.' && ends_with(entry->d_name, ending)) {
            *paths = memory_room(*paths, &room, *count + 1u, sizeof **paths);
            (*paths)[(*count)++] = platform_join(folder, entry->d_name);
        }
    }
    closedir(open_folder);
    if (*count > 0u) {
        qsort(*paths, *count, sizeof **paths, compare_paths);
    }
    return true;
}

void platform_free_paths(char **paths, size_t count)
{
    for (size_t i = 0u; i < count; i++) {
        free(paths[i]);
    }
    free(paths);
}

double platform_seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}
