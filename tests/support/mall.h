/** @file mall.h  Recorded walks with a phone in the hand, and their surveyed waypoints.
 *
 *  The recordings stand beside the checkout, in ../shared/data/phone/mall_F1, or nowhere.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TESTS_MALL_H
#define INSOLE_TESTS_MALL_H

#include <math.h>
#include <stdlib.h>

#include "insole/base/types.h"
#include "recorded.h"

enum { MALL_WALKS = 106, MALL_WAYPOINTS = 100, MALL_PATH = RECORDED_PATH };

/** Logs begin near zero, or before: time stamps count from here. */
#define MALL_ZERO_S 1000.0

typedef struct {
    double t_s, x_m, y_m;
} mall_waypoint_t;

/** Where a file of a walk is; its folder: of no name. */
static inline void mall_path(char path[MALL_PATH], int walk, const char *name)
{
    char inside[100];
    snprintf(inside, sizeof inside, "phone/mall_F1/p%03d%s%s", walk, *name != '\0' ? "/" : "",
             name);
    (void)recorded_path(path, inside);
}

/** Opens a file of a walk; NULL where there is none. */
static inline FILE *mall_open(int walk, const char *name)
{
    char path[MALL_PATH];
    mall_path(path, walk, name);
    return fopen(path, "r");
}

static inline int mall_read_truth(FILE *file, mall_waypoint_t points[MALL_WAYPOINTS])
{
    char line[MALL_PATH];
    int n = 0;
    while (n < MALL_WAYPOINTS && fgets(line, sizeof line, file)) {
        mall_waypoint_t p;
        if (sscanf(line, "%lf,%lf,%lf", &p.t_s, &p.x_m, &p.y_m) == 3) {
            points[n++] = p;
        }
    }
    fclose(file);
    return n;
}

/** The next sample. @return false at the end */
static inline int mall_read_imu(FILE *file, insole_imu_t *imu)
{
    char line[MALL_PATH];
    while (fgets(line, sizeof line, file)) {
        double v[7];
        char *at = line, *end = line;
        int n = 0;
        for (; n < 7 && (v[n] = strtod(at, &end), end != at); n++) {
            at = *end == ',' ? end + 1 : end;
        }
        if (n == 7) {
            imu->t_us = (uint64_t)llround((v[0] + MALL_ZERO_S) * 1.0e6);
            imu->accel_mps2 =
                insole_vec3((insole_real_t)v[1], (insole_real_t)v[2], (insole_real_t)v[3]);
            imu->gyro_radps =
                insole_vec3((insole_real_t)v[4], (insole_real_t)v[5], (insole_real_t)v[6]);
            return 1;
        }
    }
    fclose(file);
    return 0;
}

#endif
