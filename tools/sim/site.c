/* SPDX-License-Identifier: MIT */
#include "sim/site.h"

#include <errno.h>
#include <math.h>
#include <string.h>

#include "sim/radio.h"

enum { PATH_BYTES = 1024 };

FILE *sim_site_create(const char *folder, const char *name, sim_error_t *error)
{
    char path[PATH_BYTES];
    int length = snprintf(path, sizeof path, "%s/%s", folder, name);
    if (length < 0 || (size_t)length >= sizeof path) {
        sim_fail(error, "the name of the output folder is too long");
        return NULL;
    }
    FILE *stream = fopen(path, "w");
    if (stream == NULL) {
        sim_fail(error, "%.300s cannot be written: %s", path, strerror(errno));
    }
    return stream;
}

bool sim_site_close(FILE *stream)
{
    if (stream == NULL) {
        return false;
    }
    bool good = ferror(stream) == 0;
    return fclose(stream) == 0 && good;
}

static bool read_bytes(FILE *stream, sim_list_t *bytes)
{
    bool good = true;
    for (int c = fgetc(stream); good && c != EOF; c = fgetc(stream)) {
        unsigned char byte = (unsigned char)c;
        good = sim_list_add(bytes, &byte);
    }
    return good && ferror(stream) == 0;
}

static bool write_bytes(const sim_list_t *bytes, const char *folder, const char *name,
                        sim_error_t *error)
{
    FILE *to = sim_site_create(folder, name, error);
    if (to == NULL) {
        return false;
    }
    fwrite(bytes->items, 1, bytes->count, to);
    return sim_site_close(to) || sim_fail(error, "%.300s cannot be written to", folder);
}

/* The whole file is read first: the output folder may be the scenario's. */
static bool copy(const char *scenario_path, const char *file, const char *folder, const char *name,
                 sim_error_t *error)
{
    sim_list_t bytes = sim_list(1);
    FILE *from = sim_scenario_open_beside(scenario_path, file, error);
    if (from == NULL) {
        return false;
    }
    bool done = read_bytes(from, &bytes) || sim_fail(error, "%s cannot be read", file);
    fclose(from);
    done = done && write_bytes(&bytes, folder, name, error);
    sim_list_free(&bytes);
    return done;
}

/* A field, empty when nothing is told. */
static void write_number(FILE *stream, double number)
{
    if (isnan(number)) {
        fputc(',', stream);
    } else {
        fprintf(stream, ",%.8g", number);
    }
}

static void write_aps(FILE *stream, const sim_scenario_t *scenario, const sim_radio_t *radio)
{
    fputs("id,x,y,z,p0_dbm,exponent,near_dbm\n", stream);
    for (size_t i = 0; i < scenario->aps.count; i++) {
        const sim_ap_t *ap = sim_list_at(&scenario->aps, i);
        double near_dbm = sim_radio_near(radio, i, scenario->settings.radio.height_m);
        fprintf(stream, "%s,%.8g,%.8g", ap->id, ap->x_m, ap->y_m);
        write_number(stream, ap->z_m);
        write_number(stream, ap->p0_dbm);
        write_number(stream, ap->exponent);
        write_number(stream, isnan(near_dbm) ? ap->near_dbm : round(10.0 * near_dbm) / 10.0);
        fputc('\n', stream);
    }
}

static bool survey(const sim_scenario_t *scenario, uint64_t seed, const char *folder,
                   sim_error_t *error)
{
    sim_radio_t radio;
    if (!sim_radio_open(&radio, scenario, seed, error)) {
        return false;
    }
    FILE *stream = sim_site_create(folder, "aps.csv", error);
    if (stream != NULL) {
        write_aps(stream, scenario, &radio);
    }
    sim_radio_close(&radio);
    return stream != NULL &&
           (sim_site_close(stream) || sim_fail(error, "%.300s cannot be written to", folder));
}

bool sim_site_write(const char *scenario_path, const sim_scenario_t *scenario, uint64_t seed,
                    const char *folder, sim_error_t *error)
{
    if (scenario->plan_file[0] != '\0' &&
        !copy(scenario_path, scenario->plan_file, folder, "plan.csv", error)) {
        return false;
    }
    if (scenario->aps_file[0] == '\0') {
        return true;
    }
    if (scenario->settings.radio.near == SIM_NEAR_TOLD) {
        return copy(scenario_path, scenario->aps_file, folder, "aps.csv", error);
    }
    return survey(scenario, seed, folder, error);
}
