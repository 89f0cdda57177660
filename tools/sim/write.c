/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L /* mkdir */

#include "sim/write.h"

#include <errno.h>
#include <inttypes.h>
#include <string.h>
#include <sys/stat.h>

#include "sim/carried.h"
#include "sim/magnet.h"
#include "sim/scans.h"
#include "sim/site.h"
#include "sim/survey.h"
#include "sim/trunk.h"

/* Room for a setting. */
enum { SETTING_BYTES = 100 };

/* The files of one walk. */
typedef struct {
    FILE *log, *truth;
    const sim_settings_t *settings;
    long truth_rows;
    const sim_list_t *aps;
    sim_list_t heard; /* of sim_heard_t */
    size_t written;   /* of those */
    bool has_magnet;
    sim_magnet_t magnet; /* if so */
    long mag_rows;
} output_t;

static bool open_output(output_t *output, const char *folder, sim_error_t *error)
{
    if (mkdir(folder, 0777) != 0 && errno != EEXIST) {
        return sim_fail(error, "%.300s cannot be made: %s", folder, strerror(errno));
    }
    output->log = sim_site_create(folder, "log.csv", error);
    if (output->log == NULL) {
        return false;
    }
    output->truth = sim_site_create(folder, "truth.csv", error);
    return output->truth != NULL;
}

static bool close_output(output_t *output)
{
    bool log = sim_site_close(output->log), truth = sim_site_close(output->truth);
    return log && truth;
}

static double told(insole_rng_t *rng, double value, double sigma)
{
    return value + sigma * (double)insole_rng_normal(rng);
}

/* A shoe starts where it stands, a phone where its truth does. */
static sim_vec3_t start_place(const sim_walk_t *walk, const sim_log_settings_t *settings)
{
    sim_body_t body = sim_walk_body(walk);
    if (sim_walk_phone(walk) == NULL || settings->truth == SIM_TRUTH_OF_SENSOR) {
        return body.pose(body.state, 0.0).position_m;
    }
    sim_place_t trunk = sim_trunk_at(sim_walk_steps(walk), 0.0);
    return sim_vec3(trunk.x_m, trunk.y_m, trunk.z_m);
}

static void write_start(FILE *log, const sim_walk_t *walk, const sim_log_settings_t *settings,
                        uint64_t seed)
{
    insole_rng_t rng;
    sim_seed(&rng, seed, SIM_SEED_LOG);
    sim_vec3_t at = start_place(walk, settings);
    double x = told(&rng, at.x, settings->start_sigma_m);
    double y = told(&rng, at.y, settings->start_sigma_m);
    double heading;
    fprintf(log, "start,0,%.4f,%.4f", x, y);
    if (sim_walk_start_heading(walk, &heading)) {
        double wrong = told(&rng, heading, settings->start_sigma_rad);
        fprintf(log, ",%.5f", sim_wrap_pi(wrong));
        if (settings->start_sigma_m > 0.0 && settings->start_sigma_rad > 0.0) {
            fprintf(log, ",%g,%g", settings->start_sigma_m, settings->start_sigma_rad);
        }
    }
    fputc('\n', log);
}

static void write_imu(FILE *log, const insole_imu_t *imu)
{
    insole_vec3_t f = imu->accel_mps2, w = imu->gyro_radps;
    fprintf(log, "imu,%" PRIu64 ".%06" PRIu64 ",%.6f,%.6f,%.6f,%.7f,%.7f,%.7f\n",
            imu->t_us / 1000000u, imu->t_us % 1000000u, (double)f.x, (double)f.y, (double)f.z,
            (double)w.x, (double)w.y, (double)w.z);
}

static sim_vec3_t true_place(const output_t *output, const sim_walk_t *walk,
                             const sim_sample_t *sample)
{
    if (output->settings->log.truth == SIM_TRUTH_OF_SENSOR) {
        return sample->truth.pose.position_m;
    }
    sim_place_t trunk = sim_trunk_at(sim_walk_steps(walk), sample->truth.t_s);
    return sim_vec3(trunk.x_m, trunk.y_m, trunk.z_m + output->settings->radio.height_m);
}

static void write_truth(output_t *output, const sim_walk_t *walk, const sim_sample_t *sample)
{
    double t = sample->truth.t_s, due = 0.0, truth_hz = output->settings->log.truth_hz;
    if (truth_hz > 0.0) {
        due = (double)output->truth_rows / truth_hz;
    }
    if (t > due - 1e-9) {
        sim_vec3_t p = true_place(output, walk, sample);
        fprintf(output->truth, "%.6f,%.5f,%.5f,%.5f\n", t, p.x, p.y, p.z);
        output->truth_rows++;
    }
}

/* The signals that reach the log up to a time. */
static void write_heard(output_t *output, double t_s)
{
    const sim_heard_t *heard = sim_list_at(&output->heard, output->written);
    while (heard != NULL && heard->t_s <= t_s) {
        const sim_ap_t *ap = sim_list_at(output->aps, heard->ap);
        fprintf(output->log, "rss,%.6f,%s,%.6g", heard->t_s, ap->id, heard->dbm);
        if (output->settings->radio.age == SIM_AGE_TOLD && heard->age_s > 0.0) {
            fprintf(output->log, ",%.3f", heard->age_s);
        }
        fputc('\n', output->log);
        heard = sim_list_at(&output->heard, ++output->written);
    }
}

/* The readings of the magnetometer up to a time. */
static void write_mag(output_t *output, const sim_walk_t *walk, double t_s)
{
    sim_body_t body = sim_walk_body(walk);
    for (; output->has_magnet; output->mag_rows++) {
        double due_s = (double)output->mag_rows / output->settings->magnet.rate_hz;
        if (due_s > t_s + 1e-9) {
            return;
        }
        sim_pose_t pose = body.pose(body.state, due_s);
        sim_vec3_t m = sim_magnet_read(&output->magnet, &pose);
        fprintf(output->log, "mag,%.6f,%.3f,%.3f,%.3f\n", due_s, m.x, m.y, m.z);
    }
}

static void write_sensors(output_t *output, const sim_walk_t *walk, const sim_sample_t *sample)
{
    write_mag(output, walk, sample->truth.t_s);
    if (sample->given) {
        write_imu(output->log, &sample->imu);
    }
}

static void write_samples(output_t *output, sim_walk_t *walk)
{
    sim_sample_t sample;
    fputs("t,x,y,z\n", output->truth);
    while (sim_walk_next(walk, &sample)) {
        write_heard(output, sample.truth.t_s);
        if (output->settings->log.imu == SIM_IMU_ALL) {
            write_sensors(output, walk, &sample);
        }
        write_truth(output, walk, &sample);
    }
}

static void fill_report(sim_report_t *report, const sim_walk_t *walk)
{
    const sim_imu_t *imu = sim_walk_imu(walk);
    report->duration_s = sim_walk_duration(walk);
    report->distance_m = sim_walk_distance(walk);
    report->steps = (uint32_t)sim_walk_steps(walk)->steps.count - 2u;
    report->samples = imu->given + imu->lost;
    report->lost = imu->lost;
    report->clipped = imu->clipped;
}

static bool write_files(output_t *output, sim_walk_t *walk, const sim_log_settings_t *settings,
                        const char *folder, uint64_t seed, sim_error_t *error)
{
    if (!open_output(output, folder, error)) {
        close_output(output);
        return false;
    }
    if (settings->start == SIM_START_KNOWN) {
        write_start(output->log, walk, settings, seed);
    }
    write_samples(output, walk);
    return close_output(output) || sim_fail(error, "%.300s cannot be written to", folder);
}

/* Phones alone have a magnetometer. */
static bool open_magnet(output_t *output, const sim_walk_t *walk, const sim_scenario_t *scenario,
                        uint64_t seed, sim_error_t *error)
{
    bool wanted = sim_walk_phone(walk) != NULL && scenario->settings.magnet.model != SIM_MAGNET_OFF;
    output->has_magnet = wanted && sim_magnet_open(&output->magnet, scenario, seed, error);
    return output->has_magnet || !wanted;
}

static bool write_walk(sim_walk_t *walk, const sim_scenario_t *scenario, const char *folder,
                       uint64_t seed, sim_report_t *report, sim_error_t *error)
{
    output_t output = {.settings = &scenario->settings, .aps = &scenario->aps};
    if (!sim_scans_make(walk, scenario, seed, &output.heard, error)) {
        return false;
    }
    if (!open_magnet(&output, walk, scenario, seed, error)) {
        sim_list_free(&output.heard);
        return false;
    }
    bool done = write_files(&output, walk, &scenario->settings.log, folder, seed, error) &&
                sim_survey_write(walk, scenario, &output.heard, folder, error) &&
                sim_carried_write(walk, folder, error);
    fill_report(report, walk);
    report->signals = (uint32_t)output.written;
    sim_list_free(&output.heard);
    if (output.has_magnet) {
        sim_magnet_close(&output.magnet);
    }
    return done;
}

/* `key=value` of so many characters. */
static bool set_pair(sim_settings_t *settings, const char *pair, size_t length, sim_error_t *error)
{
    char text[SETTING_BYTES];
    if (length >= sizeof text) {
        return sim_fail(error, "a setting has %zu characters, expected at most %d", length,
                        SETTING_BYTES - 1);
    }
    memcpy(text, pair, length);
    text[length] = '\0';
    char *value = strchr(text, '=');
    if (value == NULL) {
        return sim_fail(error, "'%s', expected key=value", text);
    }
    *value = '\0';
    return sim_settings_set(settings, text, value + 1, error);
}

static bool set_all(sim_settings_t *settings, const char *pairs, sim_error_t *error)
{
    bool done = true;
    const char *at = pairs != NULL ? pairs : "";
    for (at += strspn(at, " "); done && *at != '\0'; at += strspn(at, " ")) {
        size_t length = strcspn(at, " ");
        done = set_pair(settings, at, length, error);
        at += length;
    }
    return done;
}

static bool simulate(const char *path, const char *folder, uint64_t seed, const char *set,
                     sim_report_t *report, sim_error_t *error)
{
    sim_scenario_t scenario;
    if (!sim_scenario_load(path, &scenario, error)) {
        return false;
    }
    bool done = false;
    sim_walk_t *walk =
        set_all(&scenario.settings, set, error) ? sim_walk_open(&scenario, seed, error) : NULL;
    if (walk != NULL) {
        done = write_walk(walk, &scenario, folder, seed, report, error) &&
               sim_site_write(path, &scenario, seed, folder, error);
        sim_walk_close(walk);
    }
    sim_scenario_free(&scenario);
    return done;
}

int sim_write_scenario(const char *scenario_path, const char *out_dir, uint64_t seed,
                       sim_report_t *report, char *error, size_t error_size)
{
    return sim_write_scenario_with(scenario_path, out_dir, seed, NULL, report, error, error_size);
}

int sim_write_scenario_with(const char *scenario_path, const char *out_dir, uint64_t seed,
                            const char *set, sim_report_t *report, char *error, size_t error_size)
{
    sim_error_t reason;
    sim_report_t unused;
    if (simulate(scenario_path, out_dir, seed, set, report == NULL ? &unused : report, &reason)) {
        return 0;
    }
    if (error == NULL) {
        return -1;
    }
    const char *file = reason.file[0] == '\0' ? scenario_path : reason.file;
    if (reason.line > 0) {
        snprintf(error, error_size, "%s:%d: %s", file, reason.line, reason.text);
    } else {
        snprintf(error, error_size, "%s: %s", file, reason.text);
    }
    return -1;
}
