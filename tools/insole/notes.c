/* SPDX-License-Identifier: MIT */
#include "notes.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

#include "number.h"

/* Below this the way between two readings is no longer a straight line. */
static const double low_rate_hz = 80.0;

/* A walking foot turns faster than this at least once in every stride. */
static const double slow_foot_radps = 1.0;

/* Gravity differs by less than this all over the Earth: the rest is the accelerometer's. */
static const double gravity_spread_mps2 = 0.05;

static void note(notes_t *notes, const char *format, ...)
{
    if (notes->count < NOTES_MAX) {
        va_list values;
        va_start(values, format);
        vsnprintf(notes->text[notes->count++], NOTE_ROOM, format, values);
        va_end(values);
    }
}

double notes_rate_hz(const replay_facts_t *facts)
{
    double duration_s = 1e-6 * (double)(facts->last_us - facts->first_us);
    return facts->fixes > 1u && duration_s > 0.0 ? (double)(facts->readings - 1u) / duration_s
                                                 : 0.0;
}

double notes_still_share(const replay_facts_t *facts)
{
    return facts->foot.fixes > 0u ? (double)facts->foot.still / (double)facts->foot.fixes : 0.0;
}

static void note_stances(notes_t *notes, const replay_facts_t *facts)
{
    if (facts->foot.stances == 0u) {
        note(notes, "the foot never stood still: is the sensor on the shoe, and firmly?");
    } else if (facts->foot.aligned_moving) {
        note(notes, "the log does not begin at rest: 2 s of standing still before the first step "
                    "make the heading and the gyro bias good");
    }
    if (facts->strides == 0u && facts->foot.stances > 0u) {
        note(notes, "no stride was seen: did anybody walk?");
    }
}

static void note_rate(notes_t *notes, const replay_facts_t *facts)
{
    char rate[NUMBER_ROOM];
    double rate_hz = notes_rate_hz(facts);
    if (rate_hz > 0.0 && rate_hz < low_rate_hz) {
        note(notes, "%s readings per second are few: 100 and more make the track better",
             number_fixed(rate, rate_hz, 0));
    }
    if (facts->screen.gaps > 0u) {
        note(notes, "readings are missing: %lu gap%s, carried over without them",
             (unsigned long)facts->screen.gaps, facts->screen.gaps == 1u ? "" : "s");
    }
}

static void note_gyro(notes_t *notes, const replay_facts_t *facts)
{
    if (facts->screen.clipped > 0u) {
        note(notes,
             "the peaks of the gyroscope look cut off in %lu readings: choose its largest range, "
             "2000 deg/s fits any foot",
             (unsigned long)facts->screen.clipped);
    }
    if (facts->strides > 0u && facts->fastest_radps < slow_foot_radps) {
        note(notes, "the gyroscope hardly turns while the foot walks: is its unit right "
                    "(--gyro-unit)?");
    }
}

static void note_gravity(notes_t *notes, const replay_facts_t *facts)
{
    char gravity[NUMBER_ROOM];
    if (facts->rests > 0u && fabs(facts->gravity_mps2 - 9.807) > gravity_spread_mps2) {
        note(notes,
             "at rest the accelerometer reads %s m/s^2: `insole calibrate imu` tells its "
             "bias",
             number_fixed(gravity, facts->gravity_mps2, 3));
    }
}

static void note_start(notes_t *notes, const replay_facts_t *facts)
{
    const replay_fusion_t *fusion = &facts->fusion;
    char distance[NUMBER_ROOM];
    if (!facts->knows_place) {
        note(notes, "no start is known: the track begins at (0, 0), and x is where the sensor's "
                    "x axis pointed (--start x,y,heading)");
    } else if (!facts->knows_heading) {
        note(notes, "the start tells no heading: x is where the sensor's x axis pointed");
    }
    if (fusion->starts_outside) {
        note(notes,
             "the start lies outside the plan, %s%s m from the nearest wall: are both of the same "
             "map?",
             fusion->start_distance_m < REPLAY_FAR_M ? "" : "more than ",
             number_fixed(distance, fusion->start_distance_m, 1));
    }
}

static void note_radio(notes_t *notes, const replay_facts_t *facts)
{
    const replay_fusion_t *fusion = &facts->fusion;
    if (fusion->aps == 0u && fusion->ids > 0u) {
        note(notes,
             "the log hears %lu access points: their places (--aps FILE) would hold the "
             "track",
             fusion->ids);
    }
    if (fusion->aps > 0u && fusion->ids > 0u && fusion->unknown_ids == fusion->ids) {
        note(notes, "none of the access points heard is among those known: are the ids the same?");
    }
    if (fusion->radio.wild > 0u) {
        note(notes,
             "radio was left out %lu times: its stamps are a minute and more ahead of the "
             "readings",
             fusion->radio.wild);
    }
}

/* A corridor drawn a little off is no reason for a note, another building is. */
static void note_outside(notes_t *notes, const replay_facts_t *facts)
{
    char share[NUMBER_ROOM];
    if (facts->fusion.walls > 0u && facts->fusion.outside > facts->fixes / 10u) {
        note(notes,
             "%s %% of the track lie outside the plan: are plan, start and radio of the "
             "same map?",
             number_fixed(share, 100.0 * (double)facts->fusion.outside / (double)facts->fixes, 0));
    }
}

/* Now and then all particles die of a wall that is drawn a little off; often, of a wrong plan. */
static void note_cloud(notes_t *notes, const replay_facts_t *facts)
{
    const insole_particle_counts_t *counts = &facts->fusion.particles;
    if (counts->recovered > 3u && counts->recovered > counts->strides / 10u) {
        note(notes, "the track went astray %lu times: do plan and start fit the walk?",
             (unsigned long)counts->recovered);
    }
}

/* ---- of a phone ------------------------------------------------------------------------- */

static void note_steps(notes_t *notes, const replay_facts_t *facts)
{
    if (facts->strides == 0u) {
        note(notes, "no step was seen: did anybody walk, and is the accelerometer's unit right "
                    "(--accel-unit)?");
    }
    if (facts->phone.gaps > 0u) {
        note(notes, "readings are missing: %lu long gap%s, in which steps may be",
             facts->phone.gaps, facts->phone.gaps == 1u ? "" : "s");
    }
}

static void note_phone_start(notes_t *notes, const replay_facts_t *facts)
{
    if (!facts->knows_place) {
        note(notes, "no start is known, nor does radio tell it: the track begins at (0, 0), and x "
                    "is where the phone pointed (--start x,y,heading, --radiomap FILE)");
    }
    if (facts->phone.magnetic == 0u && !facts->knows_heading) {
        note(notes, "no magnetometer and no start that tells a heading: it takes some scans until "
                    "the direction is known");
    }
}

static void note_map(notes_t *notes, const replay_facts_t *facts)
{
    const replay_fusion_t *radio = &facts->fusion;
    if (facts->phone.points == 0u && radio->ids > 0u) {
        note(notes,
             "the log hears %lu access points: fingerprints (--radiomap FILE) would hold the track",
             radio->ids);
    } else if (radio->ids > 0u && radio->unknown_ids == radio->ids) {
        note(notes, "none of the access points heard is in the radio map: is it of this building?");
    }
    if (radio->radio.wild > 0u) {
        note(notes,
             "radio was left out %lu times: its stamps are a minute and more ahead of the "
             "readings",
             radio->radio.wild);
    }
}

static void notes_of_phone(notes_t *notes, const replay_facts_t *facts)
{
    if (!method_is_radio_alone(facts->method)) {
        note_steps(notes, facts);
        note_gravity(notes, facts);
        note_phone_start(notes, facts);
    }
    if (!method_is_steps_alone(facts->method)) {
        note_map(notes, facts);
        note_outside(notes, facts);
    }
}

void notes_take(notes_t *notes, const replay_facts_t *facts)
{
    notes->count = 0;
    if (method_tracker(facts->method) == TRACKER_PHONE) {
        notes_of_phone(notes, facts);
        return;
    }
    if (facts->method != METHOD_WIFI) {
        note_stances(notes, facts);
        note_rate(notes, facts);
        note_gyro(notes, facts);
        note_gravity(notes, facts);
        note_start(notes, facts);
    }
    if (facts->fusion.leaves_radiomap) {
        note(notes, "the radio map is left aside: the foot tracker takes none");
    }
    if (!method_is_first_order(facts->method)) {
        note_radio(notes, facts);
        note_cloud(notes, facts);
        note_outside(notes, facts);
    }
}
