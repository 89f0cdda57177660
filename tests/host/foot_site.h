/** @file foot_site.h  A shoe walks round in a building of four access points, and hears them.
 *
 *      write_logs(1e9, start_line);
 *      replay_request_t request = request_of(METHOD_BEST);
 *      open_site(&request, true, true);
 *      replay_result_run(&result, &request);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TESTS_HOST_FOOT_SITE_H
#define INSOLE_TESTS_HOST_FOOT_SITE_H

#include <math.h>
#include <stdlib.h>

#include "files.h"
#include "foot_walk.h"
#include "replay_result.h"
#include "site.h"

/** 20 strides of 1.3 m in a circle of about 10 m about (0, 10). */
static const foot_walk_t walk = {2.0, 1.3, 0.12, 200.0, 20, 0.0};

/** Access points A..D about it, 2.5 m high. */
enum { APS = 4 };
static const double places_m[APS][2] = {{-14.0, -3.0}, {15.0, 2.0}, {3.0, 24.0}, {-9.0, 17.0}};

static replay_result_t result;
static site_t site;
static const char *paths[2];

static inline double distance_m(int ap, double t_s)
{
    foot_pose_t pose = foot_walk_pose(&walk, t_s);
    double flat_m = hypot(pose.x_m - places_m[ap][0], pose.y_m - places_m[ap][1]);
    return hypot(flat_m, 2.5);
}

/** What is heard at a time, once a second or so; `age_s` is told. */
static inline void write_radio(FILE *file, double t_s, double age_s)
{
    for (int i = 0; i < APS; i++) {
        double d_m = distance_m(i, t_s - age_s);
        fprintf(file, "rss,%.3f,%c,%.1f,%.2f\n", t_s, 'A' + i, -43.4 - 20.0 * log10(d_m), age_s);
    }
    fprintf(file, "rss,%.3f,stranger,-30\n", t_s);
    for (int i = 0; i < APS; i++) {
        fprintf(file, "range,%.3f,%c,%.2f\n", t_s, 'A' + i, distance_m(i, t_s) + 1.75);
    }
}

/** Both logs up to a time; damage is the same for every cut. */
static inline void write_logs(double until_s, const char *head)
{
    char line[256];
    const char *whole = scratch("whole.csv");
    FILE *file = fopen(whole, "wb");
    foot_walk_write(&walk, file);
    fclose(file);
    paths[0] = scratch("imu.csv");
    paths[1] = scratch("radio.csv");
    FILE *in = fopen(whole, "rb"), *out = fopen(paths[0], "wb");
    while (fgets(line, sizeof line, in) != NULL) {
        double t_s = strtod(line + 4, NULL);
        if (t_s <= until_s && !(t_s > 9.0 && t_s < 9.2)) {
            fputs(line, out);
        }
    }
    fclose(in);
    fclose(out);
    out = fopen(paths[1], "wb");
    fputs(head, out);
    for (int i = 0; 0.4 + 0.93 * i <= until_s && i < 28; i++) {
        write_radio(out, 0.4 + 0.93 * i, 0.0);
    }
    fclose(out);
}

static inline replay_request_t request_of(method_t method)
{
    replay_request_t request;
    memset(&request, 0, sizeof request);
    request.logs = paths;
    request.log_count = 2u;
    request.rate_hz = 10.0;
    request.method = method;
    request.particles = 200u;
    request.seed = 1u;
    settings_init(&request.settings);
    request.settings.fusion.foot.zupt_ekf.roll_height_m = INSOLE_R(0.0);
    return request;
}

static inline void open_site(replay_request_t *request, bool has_plan, bool has_aps)
{
    const char *plan = scratch_file("plan.csv", "loss,4\noutline,-15,-5,16,-5,16,25,-15,25\n"
                                                "hole,-3,7,3,7,3,13,-3,13\n");
    char text[256];
    int length = snprintf(text, sizeof text, "id,x,y,z\n");
    for (int i = 0; i < APS; i++) {
        length += snprintf(text + length, sizeof text - (size_t)length, "%c,%g,%g,2.5\n", 'A' + i,
                           places_m[i][0], places_m[i][1]);
    }
    const char *aps = scratch_file("aps.csv", text);
    ck_assert_msg(site_open(&site, has_plan ? plan : NULL, has_aps ? aps : NULL, NULL,
                            &request->settings.propagation, &result.failure),
                  "%s", result.failure.text);
    request->site = &site;
}

static inline double mean_error_m(const track_t *rows, double from_s)
{
    double sum = 0.0;
    int count = 0;
    for (size_t i = 0u; i < rows->count; i++) {
        double t_s = 1e-6 * (double)rows->rows[i].t_us;
        foot_pose_t pose = foot_walk_pose(&walk, t_s);
        if (t_s >= from_s) {
            sum += hypot(rows->rows[i].x_m - pose.x_m, rows->rows[i].y_m - pose.y_m);
            count++;
        }
    }
    ck_assert_int_gt(count, 0);
    return sum / count;
}
static const char start_line[] = "start,0,0,0,0.06,0.2,0.05\n";

#endif
