/** @file carry_people.h  Logs of people who never were, with their phones in three positions.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TESTS_HOST_CARRY_PEOPLE_H
#define INSOLE_TESTS_HOST_CARRY_PEOPLE_H

#include <stdio.h>

#include "../support/carry_walk.h"
#include "insole/base/rng.h"

enum { PEOPLE = 3, PEOPLE_POSITIONS = 3, PEOPLE_SAMPLES = 3500 };

static const char *const people_positions[PEOPLE_POSITIONS] = {"hand", "pocket", "swing"};

/** A person's gait with the phone in a position. */
static inline carry_gait_t people_gait(int person, int position)
{
    static const carry_gait_t gaits[PEOPLE_POSITIONS] = {{1.05, 2.0, 0.5, 0.4, 0.3, 1.5},
                                                         {1.05, 4.5, 3.0, 2.0, 0.9, 0.0},
                                                         {1.05, 1.2, 1.0, 6.0, 1.7, 0.0}};
    carry_gait_t gait = gaits[position];
    double vigour = 0.85 + 0.15 * person;
    gait.stride_s += 0.06 * (person - 1);
    gait.bounce *= vigour;
    gait.sway *= vigour;
    gait.swing *= vigour;
    return gait;
}

/** Writes a log, turned in the phone's own way, with noise. */
static inline void people_write(FILE *file, int person, int position)
{
    carry_gait_t gait = people_gait(person, position);
    insole_rng_t rng;
    insole_rng_seed(&rng, (uint64_t)(10 * person + position));
    insole_quat_t turn = insole_quat(INSOLE_R(0.5), INSOLE_R(-0.5), INSOLE_R(0.5),
                                     position == 1 ? INSOLE_R(-0.5) : INSOLE_R(0.5));
    fputs("t,ax,ay,az\n", file);
    for (int i = 0; i < PEOPLE_SAMPLES; i++) {
        d3_t f = carry_force(&gait, i * 0.02);
        double x = f.x + 0.4 * (double)insole_rng_normal(&rng);
        double y = f.y + 0.4 * (double)insole_rng_normal(&rng);
        double z = f.z + 0.4 * (double)insole_rng_normal(&rng);
        insole_vec3_t a = insole_quat_rotate(
            turn, insole_vec3((insole_real_t)x, (insole_real_t)y, (insole_real_t)z));
        fprintf(file, "%.2f,%.3f,%.3f,%.3f\n", i * 0.02, (double)a.x, (double)a.y, (double)a.z);
    }
}

/** Writes all logs and their index, people.csv. @return false when it cannot */
static inline bool people_make(const char *folder)
{
    char path[600];
    snprintf(path, sizeof path, "%s/people.csv", folder);
    FILE *index = fopen(path, "wb");
    bool is_good = index != NULL;
    if (is_good) {
        fputs("file,shoes,position,person\n", index);
    }
    for (int i = 0; i < PEOPLE * PEOPLE_POSITIONS && is_good; i++) {
        int person = i / PEOPLE_POSITIONS, position = i % PEOPLE_POSITIONS;
        snprintf(path, sizeof path, "%s/walk%d.csv", folder, i);
        FILE *log = fopen(path, "wb");
        is_good = log != NULL;
        if (is_good) {
            people_write(log, person, position);
            fclose(log);
            fprintf(index, "walk%d.csv,any,%s,p%d\n", i, people_positions[position], person);
        }
    }
    if (index != NULL) {
        fclose(index);
    }
    return is_good;
}

#endif
