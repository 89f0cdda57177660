/* SPDX-License-Identifier: MIT */
/* Steps of a recording on defaults.  usage: steps LOG.csv   (t,ax,ay,az,...; s, m/s^2)
 * One line a step: when it began and ended, s, and its length by each model, m. */
#include <stdio.h>
#include <stdlib.h>

#include "insole/move/step_length.h"
#include "insole/sense/step.h"

enum { LINE_SIZE = 512, MODELS = 4 };

static void print(const insole_footfall_t *footfall)
{
    insole_step_length_config_t config = insole_step_length_defaults;
    printf("%.6f,%.6f", (double)footfall->begin_us * 1e-6, (double)footfall->end_us * 1e-6);
    for (config.model = 0; config.model < MODELS; config.model++) {
        insole_real_t length_m = 0;
        if (insole_step_length(&config, footfall, &length_m) != INSOLE_OK) {
            fputs("a step has no length\n", stderr);
            exit(1);
        }
        printf(",%.4f", (double)length_m);
    }
    putchar('\n');
}

static void count(FILE *log, insole_step_counter_t *steps)
{
    char line[LINE_SIZE];
    insole_footfall_t footfall;
    while (fgets(line, sizeof line, log)) {
        double t_s, x, y, z;
        if (sscanf(line, "%lf,%lf,%lf,%lf", &t_s, &x, &y, &z) != 4 || t_s < 0.0) {
            continue; /* the header */
        }
        insole_vec3_t a = insole_vec3((insole_real_t)x, (insole_real_t)y, (insole_real_t)z);
        (void)insole_step_push(steps, (uint64_t)(t_s * 1e6 + 0.5), a);
        while (insole_step_next(steps, &footfall) == INSOLE_OK) {
            print(&footfall);
        }
    }
}

int main(int argc, char **argv)
{
    static insole_step_counter_t steps;
    FILE *log = argc == 2 ? fopen(argv[1], "r") : NULL;
    if (!log) {
        fputs("usage: steps LOG.csv\n", stderr);
        return 2;
    }
    if (insole_step_init(&steps, &insole_step_defaults) != INSOLE_OK) {
        fputs("the defaults are refused\n", stderr);
        return 1;
    }
    count(log, &steps);
    fclose(log);
    fprintf(stderr, "%lu samples refused\n", (unsigned long)steps.refused);
    return 0;
}
