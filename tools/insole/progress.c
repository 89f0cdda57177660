/* SPDX-License-Identifier: MIT */
#include "progress.h"

#include <stdio.h>

#include "platform.h"

enum { BAR_WIDTH = 40, CALLS_BETWEEN_LOOKS = 1000 };

static const double patience_s = 1.0;

void progress_begin(progress_t *progress)
{
    progress->is_wanted = platform_is_terminal(stderr);
    progress->is_shown = false;
    progress->begin_s = platform_seconds();
    progress->calls = 0u;
    progress->percent = -1;
}

static void draw(progress_t *progress, int percent)
{
    char bar[BAR_WIDTH + 1];
    for (int i = 0; i < BAR_WIDTH; i++) {
        bar[i] = 100 * i < percent * BAR_WIDTH ? '=' : ' ';
    }
    bar[BAR_WIDTH] = '\0';
    fprintf(stderr, "\r[%s] %3d %%", bar, percent);
    fflush(stderr);
    progress->percent = percent;
    progress->is_shown = true;
}

void progress_step(progress_t *progress, unsigned long long done, unsigned long long all)
{
    if (!progress->is_wanted || all == 0u) {
        return;
    }
    int percent = done < all ? (int)(100u * done / all) : 100;
    if (percent != progress->percent && platform_seconds() - progress->begin_s > patience_s) {
        draw(progress, percent);
    }
}

void progress_show(progress_t *progress, unsigned long long done, unsigned long long all)
{
    if (++progress->calls % CALLS_BETWEEN_LOOKS == 0u) {
        progress_step(progress, done, all);
    }
}

void progress_end(progress_t *progress)
{
    if (progress->is_shown) {
        fprintf(stderr, "\r%*s\r", BAR_WIDTH + 8, "");
        progress->is_shown = false;
    }
}
