/* SPDX-License-Identifier: MIT */
#include "help.h"

#include <string.h>

#include "insole/insole.h"

static const command_t *const commands[] = {
    &command_replay,   &command_score,
#ifdef INSOLE_HOST_HAS_SIMULATOR
    &command_simulate, &command_reproduce,
#endif
    &command_compare,  &command_calibrate, &command_config,   &command_plan,        &command_pack,
    &command_stream,   &command_draw,      &command_radiomap, &command_train_carry, NULL};

const command_t *const *help_commands(void)
{
    return commands;
}

void help_version(FILE *file)
{
    fputs("insole " INSOLE_VERSION "\n", file);
}

void help_program(FILE *file)
{
    fputs(
        "insole finds where a walking person is, from the log of an inertial sensor on the shoe,\n"
        "or of a phone that is carried (--tracker phone).\n"
        "\n"
        "First steps: record a log of lines  imu,t,ax,ay,az,gx,gy,gz  (s, m/s^2, rad/s), standing\n"
        "still for two seconds before the first step, and look at it:\n"
        "\n"
        "  insole replay walk.csv --plot walk.svg\n"
        "\n"
        "The summary says what was found, what had to be repaired, and what to do better.\n"
        "\n"
        "Commands\n",
        file);
    for (const command_t *const *command = commands; *command != NULL; command++) {
        fprintf(file, "  %-11s %s\n", (*command)->name, (*command)->purpose);
    }
    fputs("\n"
          "insole COMMAND --help    options and examples of a command\n"
          "insole help files        formats of logs, tracks, plans, access points and radio maps\n"
          "insole --version\n"
          "\n"
          "Exit: 0 done, 1 bad input, 2 wrong usage.\n",
          file);
}

void help_files(FILE *file)
{
    fputs(
        "All files are text, all lengths metres, all times seconds; # starts a comment.\n"
        "\n"
        "Log: one record a line, in order of time. t has up to 6 decimals (more are rounded) and\n"
        "may be negative; tracks keep the log's clock.\n"
        "\n"
        "  imu,t,ax,ay,az,gx,gy,gz      m/s^2 (specific force: +9.8 upwards at rest), rad/s\n"
        "  acc,t,ax,ay,az               where the accelerometer and\n"
        "  gyr,t,gx,gy,gz               the gyroscope come apart\n"
        "  mag,t,mx,my,mz               uT\n"
        "  rss,t,id,dbm[,age]           one line per access point; age: seconds since heard\n"
        "  range,t,id,metres[,sigma]    RTT or UWB\n"
        "  start,t,x,y[,heading[,sigma_m,sigma_rad]]   known start; heading: direction walked "
        "over\n"
        "                               the first two strides, counter-clockwise from +x\n"
        "  truth,t,x,y[,z]              for scoring; no tracker ever sees it\n"
        "\n"
        "A value of a sensor may be empty or nan: that is counted as trouble of the sensor.\n"
        "\n"
        "Or a table with a header line: t (or time) and ax,ay,az,gx,gy,gz, mx,my,mz make a log;\n"
        "t,x,y and perhaps z make a truth. Any order, other columns are passed over.\n"
        "\n"
        "Session: several logs on one clock, or a folder of them, merged by time. A folder may\n"
        "hold the building too, as plan.csv, aps.csv and radiomap.csv.\n"
        "\n"
        "Track (replay --out): t,x,y,z,heading,var_x,cov_xy,var_y,var_z,var_heading,state\n"
        "  state: align (not yet stood still), search (place not known), track, coast (readings\n"
        "  are missing), lost\n"
        "\n"
        "Plan: metres from a corner of the building, x to the east, y to the north.\n"
        "\n"
        "  outline,x,y,x,y,...          ring around where one can walk; several may overlap\n"
        "  hole,x,y,x,y,...             ring nobody can be in: a pillar, a stairwell\n"
        "  wall,loss_db,x,y,x,y,...     inner wall from point to point; doors are gaps\n"
        "  loss,dB                      loss of the walls that the rings after it are\n"
        "  floor,number,z,name          opens a floor; the first of a file is the one that is "
        "used\n"
        "\n"
        "A ring closes by itself. `insole plan check` tells what is wrong with a plan.\n"
        "\n"
        "Access points: a header that names the columns id,x,y,z,p0_dbm,exponent,near_dbm in any\n"
        "order, then one access point a line. id,x,y must be there; an empty field tells nothing.\n"
        "  p0_dbm: received at 1 m; exponent: of the path loss; near_dbm: mean received at 1.5 m\n"
        "\n"
        "Radio map: a header that names the columns x,y,id,mean_dbm,std_dbm,count in any order,\n"
        "then one access point at one point a line; std_dbm and count may be missing. Rows whose\n"
        "places are equal to the millimetre are one point. `insole radiomap` makes it.\n"
        "\n"
        "Config: lines  key = value ; `insole config` prints all keys.\n",
        file);
}

/* The text's further lines stand below the first. */
static void print_indented(FILE *file, const char *text, int column)
{
    for (; *text != '\0'; text++) {
        putc(*text, file);
        if (*text == '\n') {
            fprintf(file, "%*s", column, "");
        }
    }
    putc('\n', file);
}

static void print_option(FILE *file, const option_t *option)
{
    char name[64];
    enum { COLUMN = 26 };
    snprintf(name, sizeof name, "--%s%s%s", option->name, option->value != NULL ? " " : "",
             option->value != NULL ? option->value : "");
    if (strlen(name) > COLUMN - 4) {
        fprintf(file, "  %s\n%*s", name, COLUMN, "");
    } else {
        fprintf(file, "  %-*s", COLUMN - 2, name);
    }
    print_indented(file, option->text, COLUMN);
}

void help_command(FILE *file, const command_t *command)
{
    fprintf(file, "insole %s%s%s [options]\n\n%s.\n\n%s\nOptions\n", command->name,
            command->operands[0] != '\0' ? " " : "", command->operands, command->purpose,
            command->text);
    for (const option_t *option = command->options; option->name != NULL; option++) {
        print_option(file, option);
    }
}
