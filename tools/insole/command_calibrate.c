/* SPDX-License-Identifier: MIT */
#include "command.h"

#include <stdio.h>
#include <string.h>

#include "calibrate.h"
#include "output.h"

typedef struct {
    const char *name;
    bool (*run)(const arguments_t *arguments, const char *const *sessions, size_t count, FILE *file,
                failure_t *failure);
} calibration_t;

static const calibration_t calibrations[] = {{"imu", calibrate_imu},
                                             {"stride", calibrate_stride},
                                             {"gyro-scale", calibrate_gyro_scale},
                                             {"pathloss", calibrate_pathloss},
                                             {"steplength", calibrate_steplength},
                                             {"compass", calibrate_compass}};

static const calibration_t *find_calibration(const char *name)
{
    for (size_t i = 0u; i < sizeof calibrations / sizeof calibrations[0]; i++) {
        if (strcmp(calibrations[i].name, name) == 0) {
            return &calibrations[i];
        }
    }
    return NULL;
}

static bool run(const arguments_t *arguments, failure_t *failure)
{
    const char *name = arguments->operand_count > 0u ? arguments->operands[0] : "nothing";
    const calibration_t *calibration = find_calibration(name);
    if (calibration == NULL) {
        return failure_usage(failure,
                             "insole calibrate %.40s: expected imu, stride, gyro-scale, pathloss, "
                             "steplength or compass",
                             name);
    }
    if (arguments->operand_count < 2u) {
        return failure_usage(failure, "insole calibrate %s: no log: expected one or more", name);
    }
    return calibration->run(arguments, arguments->operands + 1, arguments->operand_count - 1u,
                            stdout, failure) &&
           output_flush(stdout, "-", failure);
}

static const option_t options[] = {
    {"turns", "N", "gyro-scale: how many whole turns"},
    {"distance", "M", "steplength: length of the one walk; without it truth tells"},
    {"accel-unit", "UNIT", "mps2 (default), g or mg"},
    {"gyro-unit", "UNIT", "radps (default) or dps"},
    {"aps", "FILE", "pathloss: where the access points are"},
    {"plan", "FILE", "pathloss: floor plan, for the walls"},
    {"height", "M", "pathloss: receiver above the floor (default 0)"},
    {"out", "FILE", "pathloss: write the access points there"},
    {NULL, NULL, NULL}};

const command_t command_calibrate = {
    "calibrate",
    "imu|stride|gyro-scale|pathloss|steplength|compass SESSION...",
    "measure what the defaults cannot know",
    "Every SESSION (a file or a folder) stands for itself. What is printed are config lines for\n"
    "`replay --config FILE`.\n"
    "\n"
    "  imu         gyro bias, noise and gravity from logs of a sensor at rest, 10 s or more;\n"
    "              six logs or more, every side up once, tell the accelerometer's bias as well\n"
    "  stride      K of the stride model (method pdr) from walks of 10 strides or more, by their\n"
    "              truth where the session holds one, else by the inertial strides\n"
    "  gyro-scale  from one log: the sensor rests for 2 s, is turned N whole turns about any one\n"
    "              axis, and rests for 2 s again in the same pose\n"
    "  pathloss    how strong access points are heard, from surveys: rss and truth records. Tells\n"
    "              p0, exponent, losses of walls and body, sigma, how good they are, and what "
    "looks\n"
    "              misplaced; --out writes the access points with the values of each\n"
    "  steplength  coefficients of each model of a phone walker's steps, with standard errors, by\n"
    "              the truth of the sessions, or by --distance for one\n"
    "  compass     magnetic north on the map, by the truth of sessions in which a phone with a\n"
    "              magnetometer is held pointing ahead\n"
    "\n"
    "  insole calibrate imu desk.csv >> my.conf\n"
    "  insole calibrate gyro-scale chair.csv --turns 10 >> my.conf\n"
    "  insole calibrate pathloss survey --plan plan.csv --aps aps.csv --out new.csv >> my.conf\n",
    options,
    run};
