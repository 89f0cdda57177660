/** @file phone_logs.h  Logs of somebody who walks with a phone through a hall of access points.
 *
 *  The phone lies level, its y axis ahead. It stands 3 s, then walks with two steps of 0.7 m a
 *  second to the east, turns left at 24 s, walks north until 40 s, and stands.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TESTS_HOST_PHONE_LOGS_H
#define INSOLE_TESTS_HOST_PHONE_LOGS_H

#include <math.h>
#include <stdio.h>

#define PHONE_LOGS_END_S 43.0

enum { PHONE_LOGS_APS = 24 };

typedef struct {
    double x_m, y_m, rad, radps;
    int walks;
} phone_pose_t;

static inline phone_pose_t phone_pose(double t_s)
{
    const double begin_s = 3.0, turn_s = 24.0, end_s = 40.0, mps = 1.4;
    double east_s = fmin(fmax(t_s, begin_s), turn_s) - begin_s;
    double north_s = fmin(fmax(t_s, turn_s), end_s) - turn_s;
    double turned = fmin(fmax(t_s - turn_s, 0.0), 0.5);
    phone_pose_t pose = {4.0 + mps * east_s, 4.0 + mps * north_s, 3.14159265 * turned,
                         turned > 0.0 && turned < 0.5 ? 3.14159265 : 0.0,
                         t_s >= begin_s && t_s < end_s};
    return pose;
}

static inline double phone_logs_dbm(int ap, double x_m, double y_m)
{
    double ap_x_m = fmod(7.3 * ap, 40.0), ap_y_m = fmod(13.7 * ap, 40.0);
    return -35.0 - 10.0 * log10(1.0 + pow(x_m - ap_x_m, 2.0) + pow(y_m - ap_y_m, 2.0));
}

/** The IMU at 50 Hz, and the compass at 10 Hz: north is +y. */
static inline void phone_logs_write_motion(FILE *file, double from_s, double until_s)
{
    for (int i = (int)(50.0 * from_s); i <= (int)(50.0 * until_s); i++) {
        double t_s = 0.02 * i;
        phone_pose_t pose = phone_pose(t_s);
        double up = 9.81 + (pose.walks ? 2.5 * sin(4.0 * 3.14159265 * t_s) : 0.0);
        fprintf(file, "imu,%.6f,%.5f,%.5f,%.5f,0,0,%.5f\n", t_s, 0.02 * sin(77.0 * t_s),
                0.02 * cos(91.0 * t_s), up, pose.radps);
        if (i % 5 == 0) { /* the phone's x axis is a quarter turn to the right of ahead */
            fprintf(file, "mag,%.6f,%.4f,%.4f,-43\n", t_s, -20.0 * cos(pose.rad),
                    20.0 * sin(pose.rad));
        }
    }
}

/** A scan a second. */
static inline void phone_logs_write_radio(FILE *file, double until_s)
{
    for (double t_s = 0.51; t_s <= until_s; t_s += 1.0) {
        phone_pose_t pose = phone_pose(t_s);
        for (int ap = 0; ap < PHONE_LOGS_APS; ap++) {
            double dbm = phone_logs_dbm(ap, pose.x_m, pose.y_m) + 2.0 * sin(7.0 * ap + 3.0 * t_s);
            fprintf(file, "rss,%.3f,ap%02d,%.1f\n", t_s, ap, dbm);
        }
        fprintf(file, "rss,%.3f,stranger,-40\n", t_s);
    }
}

/** Fingerprints every 4 m. */
static inline void phone_logs_write_map(FILE *file)
{
    fputs("x,y,id,mean_dbm,std_dbm,count\n", file);
    for (double x_m = 2.0; x_m < 40.0; x_m += 4.0) {
        for (double y_m = 2.0; y_m < 40.0; y_m += 4.0) {
            for (int ap = 0; ap < PHONE_LOGS_APS; ap++) {
                fprintf(file, "%.1f,%.1f,ap%02d,%.2f,2,10\n", x_m, y_m, ap,
                        phone_logs_dbm(ap, x_m, y_m));
            }
        }
    }
}

#endif
