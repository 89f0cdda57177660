/* SPDX-License-Identifier: MIT */
#include "insole/move/walk_heading.h"

#include "insole/base/rng.h"
#include "insole/base/snapshot.h"
#include "insole/move/heading.h"
#include "near.h"
#include "phone.h"
#include "refusal.h"
#include "sample.h"
#include "setting.h"
#include "stroll.h"
#include "suite.h"

#define PI  3.14159265358979323846
#define DEG (PI / 180.0)
#define EPS ((double)INSOLE_REAL_EPSILON)

enum { RATE_HZ = 50, SAMPLE_US = 1000000 / RATE_HZ, START_US = 700000, LAG_US = 100000 };

static insole_walk_heading_t walk;
static insole_walk_heading_config_t config;
static const insole_sym3_t no_cov;

static double off_by(double a, double b)
{
    return fabs(remainder(a - b, 2.0 * PI));
}

static double axis_off_by(double a, double b)
{
    return fabs(remainder(a - b, PI));
}

/* The attitude alone speaks: no noise of our own is added. */
static void begin_exact(int32_t method)
{
    config = insole_walk_heading_defaults;
    config.method = method;
    config.sigma_tilt_rad = config.sigma_rad = config.scatter_share = config.wander_share = 0;
    config.turn_share = config.axis_keep = 0;
    config.sway_weight = 1;
    config.level = 0;
    config.least_mps2 = INSOLE_R(0.01);
    ck_assert_int_eq(insole_walk_heading_init(&walk, &config), INSOLE_OK);
}

static void begin(int32_t method)
{
    config = insole_walk_heading_defaults;
    config.method = method;
    ck_assert_int_eq(insole_walk_heading_init(&walk, &config), INSOLE_OK);
}

static uint64_t time_of(int sample)
{
    return START_US + (uint64_t)sample * SAMPLE_US;
}

static insole_footfall_t footfall_from(double begin_s, double end_s)
{
    insole_footfall_t f = {.begin_us = START_US + (uint64_t)llround(begin_s * 1.0e6),
                           .end_us = START_US + (uint64_t)llround(end_s * 1.0e6)};
    return f;
}

/* ---- ellipses: the axis, by an oracle ------------------------------------------------------ */

/* Level accelerations on an ellipse, and a bounce. */
typedef struct {
    double along, across, late, axis, bounce;
} ellipse_t;

static d3_t ellipse_force(const ellipse_t *e, double t)
{
    double phase = 2.0 * PI * t / 0.5;
    d3_t a = d3(e->along * cos(phase), e->across * sin(phase + e->late), 0.0);
    a = d33_apply(turn_z(e->axis), a);
    return d3_add(a, MOTION_G + e->bounce * cos(phase + 0.7), d3(0.0, 0.0, 1.0));
}

enum { PASSED = 200, ORACLE_SLOTS = 400 };

/* What the slots hold, gathered in double: their means of three, less the mean of all, of the
 * slots `first` to `end` - 1. */
typedef struct {
    d3_t a[ORACLE_SLOTS];
    int count;
} oracle_t;

static oracle_t oracle_of(const d3_t *force, int samples, uint64_t begin_us, uint64_t end_us)
{
    static d3_t sums[ORACLE_SLOTS];
    static double counts[ORACLE_SLOTS];
    oracle_t o = {.count = 0};
    for (int k = 0; k < ORACLE_SLOTS; k++) {
        sums[k] = d3(0.0, 0.0, 0.0);
        counts[k] = 0.0;
    }
    for (int i = 0; i < samples; i++) {
        int k = (int)(time_of(i) / 50000u);
        sums[k] = d3_add(sums[k], 1.0, force[i]);
        counts[k] += 1.0;
    }
    d3_t mean = d3(0.0, 0.0, 0.0);
    for (int k = (int)(begin_us / 50000u); (uint64_t)k * 50000u < end_us; k++) {
        d3_t three = d3_add(d3_add(sums[k - 1], 1.0, sums[k]), 1.0, sums[k + 1]);
        o.a[o.count] = d3_scale(three, 1.0 / (counts[k - 1] + counts[k] + counts[k + 1]));
        mean = d3_add(mean, 1.0, o.a[o.count++]);
    }
    for (int i = 0; i < o.count; i++) {
        o.a[i] = d3_add(o.a[i], -1.0 / o.count, mean);
    }
    return o;
}

/* Energy along a direction, after a turn of all. */
static double energy(const oracle_t *o, d33_t E, double angle)
{
    double sum = 0.0;
    for (int i = 0; i < o->count; i++) {
        d3_t a = d33_apply(E, o->a[i]);
        double part = cos(angle) * a.x + sin(angle) * a.y;
        sum += part * part;
    }
    return sum;
}

/* Where it is largest near `middle`: thirds of an interval that holds one maximum. */
static double axis_near(const oracle_t *o, d33_t E, double middle)
{
    double low = middle - 0.5 * PI, high = middle + 0.5 * PI;
    double best = middle;
    for (int i = 0; i <= 36; i++) {
        double angle = low + i * PI / 36.0;
        best = energy(o, E, angle) > energy(o, E, best) ? angle : best;
    }
    low = best - 0.1;
    high = best + 0.1;
    for (int i = 0; i < 60; i++) {
        double a = low + (high - low) / 3.0, b = high - (high - low) / 3.0;
        bool in_upper = energy(o, E, a) < energy(o, E, b);
        low = in_upper ? a : low;
        high = in_upper ? high : b;
    }
    return 0.5 * (low + high);
}

static d3_t forces[PASSED];

static void push_ellipse(const ellipse_t *e, insole_sym3_t P)
{
    for (int i = 0; i < PASSED; i++) {
        forces[i] = ellipse_force(e, (double)i / RATE_HZ);
        ck_assert_int_eq(insole_walk_heading_push(&walk, insole_quat_identity(), &P,
                                                  real_of(forces[i]), time_of(i)),
                         INSOLE_OK);
    }
}

static const d33_t no_turn = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

START_TEST(axis_is_that_of_the_largest_energy)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 11u);
    worst_t axis = {0.0, 0.0}, ratio = {0.0, 0.0}, rms = {0.0, 0.0};
    for (int i = 0; i < 100; i++) {
        begin_exact(INSOLE_WALK_HEADING_RMPCA);
        ellipse_t e = {1.0 + (double)insole_rng_uniform(&rng), 0.6, i * 0.1, i * 0.13, 2.0};
        push_ellipse(&e, no_cov);
        insole_footfall_t f = footfall_from(1.0 + i * 0.01, 1.5 + i * 0.01);
        insole_walked_t walked;
        ck_assert_int_eq(insole_walk_heading_step(&walk, &f, &walked), INSOLE_OK);
        oracle_t o = oracle_of(forces, PASSED, f.begin_us, f.end_us);
        double expected = axis_near(&o, no_turn, e.axis);
        double most = energy(&o, no_turn, expected) / o.count;
        double least = energy(&o, no_turn, expected + 0.5 * PI) / o.count;
        worst_note(&axis, axis_off_by((double)walked.direction_rad, expected), i);
        worst_note(&ratio, fabs((double)walked.ratio - least / most), i);
        worst_note(&rms, fabs((double)walked.rms_mps2 - sqrt(most)), i);
    }
    ASSERT_WORST(axis, 1.0e-7 + 40.0 * EPS, "rad");
    ASSERT_WORST(ratio, 40.0 * EPS, "");
    ASSERT_WORST(rms, 40.0 * EPS, "m/s^2");
}
END_TEST

/* ---- the variance: Monte Carlo of the attitude's errors ------------------------------------ */

typedef struct {
    double tilt_x, tilt_y, correlation, yaw, bounce;
} errors_t;

static const errors_t errors[] = {{0.02, 0.02, 0.0, 0.0, 3.0},  {0.05, 0.03, 0.5, 0.02, 3.0},
                                  {0.1, 0.1, 0.0, 0.1, 3.0},    {0.1, 0.02, -0.8, 0.3, 4.0},
                                  {0.03, 0.03, 0.0, 2.0, 2.0},  {0.15, 0.15, 0.3, 0.05, 2.0},
                                  {0.001, 0.001, 0.0, 0.0, 8.0}};

static insole_sym3_t cov_of(const errors_t *e)
{
    insole_sym3_t P = no_cov;
    P.xx = (insole_real_t)(e->tilt_x * e->tilt_x);
    P.yy = (insole_real_t)(e->tilt_y * e->tilt_y);
    P.xy = (insole_real_t)(e->correlation * e->tilt_x * e->tilt_y);
    P.xz = (insole_real_t)(0.3 * e->tilt_x * e->yaw);
    P.zz = (insole_real_t)(e->yaw * e->yaw);
    return P;
}

/* A rotation with that covariance; about the vertical last. */
static d33_t draw_turn(const errors_t *e, insole_rng_t *rng)
{
    double g0 = (double)insole_rng_normal(rng), g1 = (double)insole_rng_normal(rng);
    double g2 = (double)insole_rng_normal(rng), c = e->correlation;
    double x = e->tilt_x * g0, y = e->tilt_y * (c * g0 + sqrt(1.0 - c * c) * g1);
    /* cov(x, z) = 0.3, cov(y, z) = 0 */
    double b = -0.3 * c / sqrt(1.0 - c * c), left = sqrt(1.0 - 0.09 - b * b);
    double z = e->yaw * (0.3 * g0 + b * g1 + left * g2);
    return d33_mul(turn_z(z), d33_exp(d3(x, y, 0.0)));
}

START_TEST(variance_is_that_of_the_attitudes_errors)
{
    const errors_t *e = &errors[_i];
    ellipse_t ellipse = {1.5, 0.5, 0.3, 0.8, e->bounce};
    begin_exact(INSOLE_WALK_HEADING_RMPCA);
    push_ellipse(&ellipse, cov_of(e));
    insole_footfall_t f = footfall_from(1.0, 1.5);
    insole_walked_t walked;
    ck_assert_int_eq(insole_walk_heading_step(&walk, &f, &walked), INSOLE_OK);
    oracle_t o = oracle_of(forces, PASSED, f.begin_us, f.end_us);
    double base = axis_near(&o, no_turn, ellipse.axis), sum = 0.0, square = 0.0;
    insole_rng_t rng;
    insole_rng_seed(&rng, 21u);
    enum { DRAWS = 4000 };
    for (int i = 0; i < DRAWS; i++) {
        d33_t E = draw_turn(e, &rng);
        double yaw = atan2(E.r1.x, E.r0.x);
        double off = remainder(axis_near(&o, E, base + yaw) - base, 2.0 * PI);
        sum += off;
        square += off * off;
    }
    double mean = sum / DRAWS, sd = sqrt(square / DRAWS - mean * mean);
    if (e->yaw < 1.0) {
        ASSERT_NEAR(sqrt((double)walked.variance_rad2), sd, 0.12 * sd, "rad");
        ASSERT_NEAR(remainder((double)walked.direction_rad - base, PI), mean, 0.2 * sd + 1.0e-5,
                    "rad");
    } else {
        ASSERT_NEAR((double)walked.variance_rad2, PI * PI / 3.0, 1.0e-5, "rad^2");
    }
}
END_TEST

/* ---- walks -------------------------------------------------------------------------------- */

/* How a walk's samples reach the library. */
typedef struct {
    stroll_t stroll;
    double noise_mps2;  /* white, of each sample */
    double tilt_rad;    /* 1-sigma of an error of the attitude that lasts a walk */
    double aim_rad;     /* 1-sigma of what each step's motion points off the walk */
    double hand_rad_ps; /* turn rate of the phone in the hand */
    int bad_stride;     /* its level motion goes backwards; 0: none */
    uint64_t seed;
} trip_t;

/* What came of a step. */
typedef struct {
    insole_status_t status;
    double end_s, off_rad; /* truth: middle of the step */
    insole_walked_t walked;
} told_t;

enum { MOST_STEPS = 200 };
static told_t told[MOST_STEPS];

static insole_sym3_t tilt_cov(double tilt_rad)
{
    insole_real_t t = (insole_real_t)(tilt_rad * tilt_rad);
    return insole_sym3_diagonal(t, t, 0);
}

static void push_moment(const trip_t *trip, double t, int i, d33_t error, double aim,
                        insole_rng_t *rng)
{
    d33_t R;
    d3_t accel;
    stroll_moment(&trip->stroll, t, &R, &accel);
    R = d33_mul(R, turn_x(trip->hand_rad_ps * t));
    accel = d33_apply(turn_z(aim), accel);
    d3_t force = stroll_force(R, accel);
    double n = trip->noise_mps2;
    force = d3_add(force, n,
                   d3((double)insole_rng_normal(rng), (double)insole_rng_normal(rng),
                      (double)insole_rng_normal(rng)));
    insole_sym3_t P = tilt_cov(trip->tilt_rad);
    ck_assert_int_eq(
        insole_walk_heading_push(&walk, quat_of(d33_mul(error, R)), &P, real_of(force), time_of(i)),
        INSOLE_OK);
}

/* Walks that many steps, which are told `late` steps after their end. */
static void take_trip(const trip_t *trip, int steps, int late)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, trip->seed);
    double T = trip->stroll.step_s, lag = LAG_US * 1.0e-6, aim = 0.0;
    double tilt_x = trip->tilt_rad * (double)insole_rng_normal(&rng);
    d33_t error = d33_exp(d3(tilt_x, trip->tilt_rad * (double)insole_rng_normal(&rng), 0.0));
    int next = 0, stride = -1;
    for (int i = 0; next < steps; i++) {
        double t = (double)i / RATE_HZ;
        if ((int)((t - lag) / (2.0 * T)) != stride) {
            stride = (int)((t - lag) / (2.0 * T));
            aim = trip->aim_rad * (double)insole_rng_normal(&rng);
            aim += stride > 0 && stride == trip->bad_stride ? PI : 0.0;
        }
        push_moment(trip, t, i, error, aim, &rng);
        double end = lag + T * (next + 1);
        if (t > end + late * T + 0.25) {
            insole_footfall_t f = footfall_from(end - T, end);
            told_t *d = &told[next++];
            d->status = insole_walk_heading_step(&walk, &f, &d->walked);
            d->end_s = end;
            d->off_rad = remainder((double)d->walked.direction_rad -
                                       stroll_heading(&trip->stroll, end - 0.5 * T),
                                   2.0 * PI);
        }
    }
}

static d33_t any_mounting(insole_rng_t *rng)
{
    return d33_of(insole_quat_to_mat3(sample_quat(rng)));
}

static trip_t trip_in(int pose, insole_rng_t *rng)
{
    trip_t trip = {.stroll = stroll_in((stroll_pose_t)pose, any_mounting(rng)),
                   .noise_mps2 = 0.1,
                   .seed = insole_rng_bits(rng)};
    trip.stroll.heading_rad = 2.0 * PI * (double)insole_rng_uniform(rng);
    return trip;
}

/* Shares of told steps from the one after `settled` on. */
typedef struct {
    int told, certain, turned, certainly_turned, within_one, within_two;
    double square;
} tally_t;

static void count_steps(tally_t *tally, int settled, int steps)
{
    for (int i = settled; i < steps; i++) {
        ck_assert_int_eq(told[i].status, INSOLE_OK);
        bool turned = fabs(told[i].off_rad) > 0.5 * PI, certain = told[i].walked.is_certain;
        double off = fabs(remainder(told[i].off_rad, PI));
        double z = off / sqrt((double)told[i].walked.variance_rad2);
        tally->told++;
        tally->certain += certain;
        tally->turned += turned;
        tally->certainly_turned += turned && certain;
        tally->within_one += z <= 1.0;
        tally->within_two += z <= 2.0;
        tally->square += off * off;
    }
}

static double rms_of(const tally_t *tally)
{
    return sqrt(tally->square / tally->told);
}

/* Thirty walks a pose, each with a mounting and a direction of its own. */
static tally_t tally_pose(int32_t method, int pose, double tilt_rad, double aim_rad)
{
    enum { WALKS = 30, STEPS = 30, SETTLED = 5 };
    tally_t tally = {0, 0, 0, 0, 0, 0, 0.0};
    insole_rng_t rng;
    insole_rng_seed(&rng, 100u + (uint64_t)pose);
    for (int i = 0; i < WALKS; i++) {
        trip_t trip = trip_in(pose, &rng);
        trip.tilt_rad = tilt_rad;
        trip.aim_rad = aim_rad;
        begin(method);
        take_trip(&trip, STEPS, 0);
        count_steps(&tally, SETTLED, STEPS);
    }
    return tally;
}

static const int32_t methods[] = {INSOLE_WALK_HEADING_RMPCA, INSOLE_WALK_HEADING_UDIRECT,
                                  INSOLE_WALK_HEADING_GAIT};

START_TEST(every_pose_and_mounting_shows_the_way_with_its_sign)
{
    static const double most_rad[3][STROLL_POSES] = {
        {0.03, 0.03, 0.03, 0.08}, {0.08, 0.08, 0.15, 0.18}, {0.03, 0.03, 0.05, 0.05}};
    for (int pose = 0; pose < STROLL_POSES; pose++) {
        tally_t t = tally_pose(methods[_i], pose, 0.0, 0.0);
        ck_assert_int_eq(t.told, 750);
        ck_assert_int_eq(t.turned, 0);
        ASSERT_AT_MOST(rms_of(&t), most_rad[_i][pose], "rad");
        if (pose == STROLL_HAND || pose == STROLL_CALL) {
            ck_assert_int_eq(t.certain, t.told);
        }
    }
}
END_TEST

/* The attitude is off by 3 degrees: an arm's swing hides the trunk, but nothing false is certain.
 */
START_TEST(no_wrong_end_is_certain)
{
    int wrong = 0, told_in_all = 0;
    for (int pose = 0; pose < STROLL_POSES; pose++) {
        tally_t t = tally_pose(methods[_i], pose, 0.05, 0.15);
        ck_assert_int_eq(t.certainly_turned, 0);
        wrong += t.turned;
        told_in_all += t.told;
    }
    ASSERT_AT_MOST((double)wrong / told_in_all, 0.02, "");
}
END_TEST

START_TEST(variance_is_honest_on_noisy_walks)
{
    int one = 0, two = 0, told_in_all = 0;
    for (int pose = 0; pose < STROLL_POSES; pose++) {
        tally_t t = tally_pose(methods[_i], pose, 0.05, 0.25);
        one += t.within_one;
        two += t.within_two;
        told_in_all += t.told;
    }
    ASSERT_NEAR((double)one / told_in_all, 0.68, 0.08, "");
    ASSERT_AT_LEAST((double)two / told_in_all, 0.9, "");
}
END_TEST

static trip_t plain_trip(int pose)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 7u);
    trip_t trip = trip_in(pose, &rng);
    trip.stroll.heading_rad = 2.0;
    return trip;
}

/* Turns begin after ten steps. Three steps after its end the direction is the new one, the right
 * end too, and a turn to a side never shows the other end on its way. */
START_TEST(a_turn_is_followed)
{
    static const struct {
        double turn_rad, lasts_s;
        bool along;
    } turns[] = {{0.5 * PI, 2.2, true},
                 {-0.5 * PI, 1.1, true},
                 {PI, 3.3, true},
                 {PI, 0.55, false},
                 {-0.75 * PI, 1.1, false}};
    for (int pose = STROLL_HAND; pose <= STROLL_CALL; pose++) {
        trip_t trip = plain_trip(pose);
        trip.stroll.turn_begin_s = 5.5;
        trip.stroll.turn_end_s = 5.5 + turns[_i].lasts_s;
        trip.stroll.turn_rad = turns[_i].turn_rad;
        begin(INSOLE_WALK_HEADING_RMPCA);
        take_trip(&trip, 30, 0);
        worst_t on_the_way = {0.0, 0.0}, after = {0.0, 0.0};
        for (int i = 3; i < 30; i++) {
            worst_note(&on_the_way, fabs(told[i].off_rad), i);
            if (told[i].end_s > trip.stroll.turn_end_s + 6.0 * trip.stroll.step_s) {
                worst_note(&after, fabs(told[i].off_rad), i);
            }
        }
        ASSERT_WORST(after, 0.1, "rad");
        if (turns[_i].along) {
            ASSERT_WORST(on_the_way, 0.5 * PI, "rad");
        }
    }
}
END_TEST

/* The phone is turned over and over in the hand, and who is asked knows that it is. */
START_TEST(a_turn_of_the_phone_does_not_matter)
{
    trip_t trip = plain_trip(STROLL_CALL);
    trip.noise_mps2 = 0.0;
    begin(INSOLE_WALK_HEADING_RMPCA);
    walk.config.turned_by = 1;
    take_trip(&trip, 20, 0);
    double still[20];
    for (int i = 0; i < 20; i++) {
        still[i] = told[i].off_rad;
    }
    trip.hand_rad_ps = 1.5;
    begin(INSOLE_WALK_HEADING_RMPCA);
    walk.config.turned_by = 1;
    take_trip(&trip, 20, 0);
    worst_t apart = {0.0, 0.0};
    for (int i = 0; i < 20; i++) {
        ck_assert_int_eq(told[i].status, INSOLE_OK);
        worst_note(&apart, off_by(told[i].off_rad, still[i]), i);
    }
    ASSERT_WORST(apart, 2.0e-5, "rad");
}
END_TEST

/* All that is level goes backwards in one stride; who keeps no evidence is turned round by it. */
START_TEST(one_bad_stride_turns_nobody_round)
{
    trip_t trip = plain_trip(STROLL_CALL);
    trip.bad_stride = 7;
    for (int keeps = 0; keeps < 2; keeps++) {
        begin(INSOLE_WALK_HEADING_RMPCA);
        walk.config.keep_share = keeps ? config.keep_share : 0;
        take_trip(&trip, 30, 0);
        tally_t tally = {0, 0, 0, 0, 0, 0, 0.0};
        count_steps(&tally, 5, 30);
        ck_assert_int_eq(tally.turned > 0, !keeps);
    }
}
END_TEST

START_TEST(a_step_told_late_is_the_same)
{
    trip_t trip = plain_trip(STROLL_POCKET);
    static told_t at_once[MOST_STEPS];
    begin(INSOLE_WALK_HEADING_RMPCA);
    take_trip(&trip, 30, 0);
    memcpy(at_once, told, sizeof told);
    for (int late = 1; late <= 8; late += 7) {
        begin(INSOLE_WALK_HEADING_RMPCA);
        take_trip(&trip, 30, late);
        for (int i = 0; i < 30; i++) {
            ck_assert_int_eq(told[i].status, INSOLE_OK);
            ck_assert(told[i].walked.direction_rad == at_once[i].walked.direction_rad);
            ck_assert(told[i].walked.evidence == at_once[i].walked.evidence);
        }
    }
    begin(INSOLE_WALK_HEADING_RMPCA); /* 7 s late: forgotten */
    take_trip(&trip, 5, 13);
    for (int i = 0; i < 5; i++) {
        ck_assert_int_eq(told[i].status, INSOLE_ERR_STATE);
    }
    ck_assert_uint_eq(walk.refused, 5u);
}
END_TEST

START_TEST(device_is_where_the_phone_points)
{
    trip_t trip = plain_trip(STROLL_CALL);
    trip.stroll.mounting = turn_z(0.4);
    begin(INSOLE_WALK_HEADING_DEVICE);
    take_trip(&trip, 10, 3);
    for (int i = 0; i < 10; i++) {
        ck_assert_int_eq(told[i].status, INSOLE_OK);
        ASSERT_NEAR(off_by((double)told[i].walked.direction_rad, 2.0 + 0.4 + 0.5 * PI), 0.0, 1.0e-5,
                    "rad");
        ck_assert(told[i].walked.is_certain);
        ASSERT_NEAR(told[i].walked.variance_rad2, 0.0, 0.0, "rad^2");
    }
}
END_TEST

/* A step of its own, this long after the last one: what is gathered has faded by then, and only the
 * step itself is looked at. */
START_TEST(a_pause_lets_evidence_fade)
{
    static const int pauses_s[] = {0, 5, 3600};
    double evidence[3];
    for (int k = 0; k < 3; k++) {
        trip_t trip = plain_trip(STROLL_CALL);
        trip.noise_mps2 = 0.0;
        begin(INSOLE_WALK_HEADING_RMPCA);
        take_trip(&trip, 12, 0);
        ck_assert_uint_eq(walk.row.count, 4u);
        uint64_t from_us = walk.row.end_us + (uint64_t)pauses_s[k] * 1000000u + 10000000u;
        walk.row.end_us += 10000000u; /* the samples between need not be made */
        for (int i = 0; i < 100; i++) {
            d33_t R;
            d3_t accel;
            stroll_moment(&trip.stroll, i * 0.02, &R, &accel);
            insole_sym3_t P = tilt_cov(0.01);
            (void)insole_walk_heading_push(&walk, quat_of(R), &P, real_of(stroll_force(R, accel)),
                                           from_us + (uint64_t)i * SAMPLE_US);
        }
        insole_footfall_t f = {.begin_us = from_us + (pauses_s[k] ? 0u : 550000u),
                               .end_us = from_us + (pauses_s[k] ? 550000u : 1100000u)};
        walk.row.end_us = pauses_s[k] ? walk.row.end_us : f.begin_us - 1u;
        insole_walked_t walked;
        ck_assert_int_eq(insole_walk_heading_step(&walk, &f, &walked), INSOLE_OK);
        ck_assert_uint_eq(walk.row.count, 1u);
        evidence[k] = (double)walked.evidence;
    }
    double fresh = evidence[2], whole = evidence[0] - fresh;
    ASSERT_NEAR((evidence[1] - fresh) / whole, exp(-1.0), 0.03, "");
    ASSERT_AT_LEAST(whole, 1.0, "");
}
END_TEST

/* A bounce alone, seen by an attitude that is off by as much as its covariance says: it looks like
 * a motion ahead, but is no evidence for it. */
START_TEST(a_bounce_seen_at_a_slant_is_no_evidence)
{
    double evidence[2];
    for (int knows = 0; knows < 2; knows++) {
        begin(INSOLE_WALK_HEADING_RMPCA);
        insole_sym3_t P = tilt_cov(knows ? 0.2 : 1.0e-3);
        for (int i = 0; i < PASSED; i++) {
            double bounce = 3.0 * cos(2.0 * PI * i * 0.02 / 0.5);
            d3_t force = d33_apply(turn_y(0.2), d3(0.0, 0.0, MOTION_G + bounce));
            ck_assert_int_eq(insole_walk_heading_push(&walk, insole_quat_identity(), &P,
                                                      real_of(force), time_of(i)),
                             INSOLE_OK);
        }
        insole_footfall_t f = footfall_from(1.0, 1.5);
        insole_walked_t walked;
        ck_assert_int_eq(insole_walk_heading_step(&walk, &f, &walked), INSOLE_OK);
        evidence[knows] = (double)walked.evidence;
        if (knows) { /* the axis may lie anywhere */
            ASSERT_AT_LEAST(walked.variance_rad2, 0.3, "rad^2");
        }
    }
    ASSERT_NEAR(evidence[1], 0.5 * evidence[0], 0.05, "");
}
END_TEST

/* The tilt that the covariance does not know counts like one that it does, about both axes. */
START_TEST(unknown_tilt_adds_to_the_covariance)
{
    double variance[2];
    for (int known = 0; known < 2; known++) {
        begin_exact(INSOLE_WALK_HEADING_RMPCA);
        walk.config.sigma_tilt_rad = known ? 0 : INSOLE_R(0.05);
        ellipse_t e = {1.5, 0.5, 0.3, 0.7, 3.0};
        push_ellipse(&e, tilt_cov(known ? 0.05 : 0.0));
        insole_footfall_t f = footfall_from(1.0, 1.5);
        insole_walked_t walked;
        ck_assert_int_eq(insole_walk_heading_step(&walk, &f, &walked), INSOLE_OK);
        variance[known] = (double)walked.variance_rad2;
    }
    ck_assert_double_gt(variance[1], 1.0e-4);
    ASSERT_NEAR(variance[0], variance[1], 1.0e-5 * variance[1], "rad^2");
}
END_TEST

/* ---- no walk ------------------------------------------------------------------------------- */

static void push_still(insole_vec3_t force, double noise, insole_rng_t *rng)
{
    insole_sym3_t P = tilt_cov(0.03);
    for (int i = 0; i < PASSED; i++) {
        insole_vec3_t n = insole_vec3_scale(
            insole_vec3(insole_rng_normal(rng), insole_rng_normal(rng), insole_rng_normal(rng)),
            (insole_real_t)noise);
        ck_assert_int_eq(insole_walk_heading_push(&walk, insole_quat_identity(), &P,
                                                  insole_vec3_add(force, n), time_of(i)),
                         INSOLE_OK);
    }
}

START_TEST(who_stands_or_falls_goes_nowhere)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 3u);
    insole_real_t up = _i == 0 ? INSOLE_R(9.81) : 0;
    begin(INSOLE_WALK_HEADING_RMPCA);
    push_still(insole_vec3(0, 0, up), 0.05, &rng);
    insole_footfall_t f = footfall_from(1.0, 1.5);
    insole_walked_t walked = {.t_us = 77u}, as_it_was = walked;
    ASSERT_REFUSED(walk, walk.refused, insole_walk_heading_step(&walk, &f, &walked),
                   INSOLE_ERR_STATE);
    ck_assert(memcmp(&walked, &as_it_was, sizeof walked) == 0);
}
END_TEST

/* Shaken without a rhythm: some directions come out, and after a while they say themselves that
 * they are worth little. */
START_TEST(shaking_is_little_trusted)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 4u);
    begin(INSOLE_WALK_HEADING_RMPCA);
    insole_sym3_t P = tilt_cov(0.03);
    int certain = 0, count = 0;
    double sum = 0.0;
    for (int i = 0; i < 60 * RATE_HZ; i++) {
        insole_vec3_t n = insole_vec3(insole_rng_normal(&rng), insole_rng_normal(&rng),
                                      INSOLE_R(9.81) + 2 * insole_rng_normal(&rng));
        (void)insole_walk_heading_push(&walk, insole_quat_identity(), &P, n, time_of(i));
        if (i % 25 == 0 && i > 100) {
            insole_footfall_t f = footfall_from(i * 0.02 - 0.8, i * 0.02 - 0.3);
            insole_walked_t walked;
            ck_assert_int_eq(insole_walk_heading_step(&walk, &f, &walked), INSOLE_OK);
            count++;
            certain += walked.is_certain;
            sum += (double)walked.variance_rad2;
        }
    }
    ASSERT_AT_MOST((double)certain / count, 0.05, "");
    ASSERT_AT_LEAST(sum / count, 0.15, "rad^2");
}
END_TEST

/* ---- what comes in ------------------------------------------------------------------------- */

static insole_status_t judge(void)
{
    static insole_walk_heading_t other;
    return insole_walk_heading_init(&other, &config);
}

START_TEST(settings_have_ends)
{
    config = insole_walk_heading_defaults;
    INSOLE_WALK_HEADING_KEYS(SETTING_HAS_ENDS)
    config.steps = 0;
    ASSERT_UNCHANGED(walk, insole_walk_heading_init(&walk, &config), INSOLE_ERR_VALUE);
    ASSERT_UNCHANGED(walk, insole_walk_heading_init(&walk, NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_walk_heading_init(NULL, &config), INSOLE_ERR_NULL);
}
END_TEST

static void walk_a_little(void)
{
    trip_t trip = plain_trip(STROLL_HAND);
    begin(INSOLE_WALK_HEADING_RMPCA);
    take_trip(&trip, 8, 0);
}

static insole_vec3_t vec3_with(insole_real_t odd, int k)
{
    return insole_vec3(k == 0 ? odd : 0, k == 1 ? odd : 0, k == 2 ? odd : INSOLE_R(9.81));
}

#define ASSERT_PUSH_REFUSED(q, P, a, t, why)                                                       \
    ASSERT_REFUSED(walk, walk.refused, insole_walk_heading_push(&walk, q, P, a, t), why)

START_TEST(bad_samples_are_refused)
{
    walk_a_little();
    const insole_real_t odd[] = {(insole_real_t)NAN, (insole_real_t)INFINITY,
                                 -(insole_real_t)INFINITY, INSOLE_REAL_MAX, INSOLE_R(1001.0)};
    const insole_quat_t one = insole_quat_identity();
    const insole_vec3_t rest = insole_vec3(0, 0, INSOLE_R(9.81));
    uint64_t next_us = walk.motion.t_us + 1u;
    for (size_t i = 0; i < sizeof odd / sizeof odd[0]; i++) {
        for (int k = 0; k < 3; k++) {
            ASSERT_PUSH_REFUSED(one, &no_cov, vec3_with(odd[i], k), next_us, INSOLE_ERR_VALUE);
        }
        insole_quat_t bad_q[] = {
            {odd[i], 0, 0, 0}, {0, odd[i], 0, 0}, {1, 0, odd[i], 0}, {1, 0, 0, odd[i]}};
        insole_sym3_t bad_P[] = {{odd[i], 0, 0, 1, 0, 1}, {1, odd[i], 0, 1, 0, 1},
                                 {1, 0, odd[i], 1, 0, 1}, {1, 0, 0, odd[i], 0, 1},
                                 {1, 0, 0, 1, odd[i], 1}, {1, 0, 0, 1, 0, odd[i]}};
        for (int k = 0; k < 4; k++) {
            ASSERT_PUSH_REFUSED(bad_q[k], &no_cov, rest, next_us, INSOLE_ERR_VALUE);
        }
        for (int k = 0; k < 6; k++) {
            ASSERT_PUSH_REFUSED(one, &bad_P[k], rest, next_us, INSOLE_ERR_VALUE);
        }
    }
    insole_sym3_t negative = insole_sym3_diagonal(1, INSOLE_R(-0.1), 1);
    ASSERT_PUSH_REFUSED(one, &negative, rest, next_us, INSOLE_ERR_VALUE);
    ASSERT_PUSH_REFUSED(insole_quat(0, 0, 0, 0), &no_cov, rest, next_us, INSOLE_ERR_VALUE);
    ASSERT_PUSH_REFUSED(one, &no_cov, rest, walk.motion.t_us, INSOLE_ERR_TIME);
    ASSERT_UNCHANGED(walk, insole_walk_heading_push(&walk, one, NULL, rest, next_us),
                     INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_walk_heading_push(NULL, one, &no_cov, rest, next_us), INSOLE_ERR_NULL);
}
END_TEST

#define ASSERT_STEP_REFUSED(f, why)                                                                \
    ASSERT_REFUSED(walk, walk.refused, insole_walk_heading_step(&walk, f, &walked), why)

START_TEST(bad_steps_are_refused)
{
    walk_a_little();
    insole_walked_t walked;
    uint64_t last = walk.row.end_us, newest = walk.motion.t_us;
    insole_footfall_t after_newest = {.begin_us = last, .end_us = newest + 1u};
    insole_footfall_t empty = {.begin_us = newest, .end_us = newest};
    insole_footfall_t backwards = {.begin_us = newest, .end_us = newest - 100000u};
    insole_footfall_t again = {.begin_us = last - 500000u, .end_us = last};
    insole_footfall_t endless = {.begin_us = 0u, .end_us = newest};
    ASSERT_STEP_REFUSED(&after_newest, INSOLE_ERR_TIME);
    ASSERT_STEP_REFUSED(&empty, INSOLE_ERR_TIME);
    ASSERT_STEP_REFUSED(&backwards, INSOLE_ERR_TIME);
    ASSERT_STEP_REFUSED(&again, INSOLE_ERR_TIME);
    insole_vec3_t rest = insole_vec3(0, 0, INSOLE_R(9.81));
    for (uint64_t t = newest + SAMPLE_US; t < newest + 7000000u; t += SAMPLE_US) {
        ck_assert_int_eq(insole_walk_heading_push(&walk, insole_quat_identity(), &no_cov, rest, t),
                         INSOLE_OK);
    }
    ASSERT_STEP_REFUSED(&endless, INSOLE_ERR_STATE);
    ASSERT_UNCHANGED(walk, insole_walk_heading_step(&walk, NULL, &walked), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(walk, insole_walk_heading_step(&walk, &endless, NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_walk_heading_step(NULL, &endless, &walked), INSOLE_ERR_NULL);
    begin(INSOLE_WALK_HEADING_RMPCA); /* not one sample yet */
    ASSERT_STEP_REFUSED(&endless, INSOLE_ERR_TIME);
}
END_TEST

static insole_real_t wild(insole_rng_t *rng)
{
    static const insole_real_t sizes[] = {0, INSOLE_R(1.0e-30), INSOLE_R(1.0e-6), 1, 9, 900};
    return sizes[insole_rng_bits(rng) % 6u] * (2 * insole_rng_uniform(rng) - 1);
}

/* Whatever is taken, what is told is finite and in its range. */
START_TEST(all_that_is_told_is_finite)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 5u);
    worst_t bad = {0.0, 0.0};
    int answers = 0;
    for (int trial = 0; trial < 400; trial++) {
        begin_exact(trial % 4);
        walk.config.steps = 1 + trial % 3;
        walk.config.level = trial / 4 % 2;
        walk.config.turned_by = trial / 8 % 2;
        walk.config.axis_keep = walk.config.sway_weight = (insole_real_t)(trial % 5) / 5;
        walk.config.scatter_share = walk.config.wander_share = (insole_real_t)(trial % 2);
        uint64_t t_us = insole_rng_bits(&rng) % 200000u, last_us = t_us;
        insole_real_t size = wild(&rng);
        for (int i = 0; i < 300; i++) {
            insole_mat3_t M = sample_mat3(&rng, wild(&rng) / 200);
            insole_sym3_t P = insole_mat3_mul_t_sym(M, M);
            insole_vec3_t a = sample_vec3(&rng, i % 50 == 0 ? wild(&rng) / 2 : size / 2);
            t_us += 1u + insole_rng_bits(&rng) % 40000u;
            (void)insole_walk_heading_push(&walk, sample_quat(&rng), &P, a, t_us);
            insole_footfall_t f = {.begin_us = last_us, .end_us = t_us - 1u};
            insole_walked_t w;
            if (i % 20 == 19 && insole_walk_heading_step(&walk, &f, &w) == INSOLE_OK) {
                answers++;
                last_us = f.end_us;
                worst_require(&bad, fabs((double)w.direction_rad) <= PI * (1.0 + EPS), trial);
                worst_require(&bad, w.variance_rad2 >= 0, trial);
                worst_require(&bad, (double)w.variance_rad2 <= PI * PI / 3.0 + 1.0e-6, trial);
                worst_require(&bad, w.ratio >= 0 && (double)w.ratio <= 1.0 + 10.0 * EPS, trial);
                worst_require(&bad, insole_is_finite(w.rms_mps2 + w.evidence), trial);
                worst_require(&bad, insole_spot_is_finite(walk.memory.pull), trial);
            }
        }
    }
    ASSERT_ALL_HELD(bad);
    ck_assert_int_gt(answers, 1000);
}
END_TEST

START_TEST(saved_and_restored_it_goes_on)
{
    enum { KIND = 7 };
    static unsigned char buffer[sizeof(insole_walk_heading_t) + 64];
    static told_t whole[MOST_STEPS];
    trip_t trip = plain_trip(STROLL_SWING);
    size_t used = 0;
    begin(INSOLE_WALK_HEADING_GAIT);
    take_trip(&trip, 10, 0);
    insole_walk_heading_t copy;
    ck_assert_int_eq(insole_snapshot_save(KIND, &walk, sizeof walk, buffer, sizeof buffer, &used),
                     INSOLE_OK);
    ck_assert_int_eq(insole_snapshot_load(KIND, &copy, sizeof copy, buffer, used), INSOLE_OK);
    uint64_t begin_us = walk.motion.t_us;
    for (int turn = 0; turn < 2; turn++) {
        for (int i = 1; i <= 100; i++) {
            insole_vec3_t a = insole_vec3((insole_real_t)(i % 7), (insole_real_t)(i % 11), 9);
            (void)insole_walk_heading_push(&walk, insole_quat_identity(), &no_cov, a,
                                           begin_us + (uint64_t)i * SAMPLE_US);
        }
        insole_footfall_t f = {.begin_us = begin_us + 500000u, .end_us = begin_us + 1000000u};
        ck_assert_int_eq(insole_walk_heading_step(&walk, &f, &whole[turn].walked), INSOLE_OK);
        walk = copy;
    }
    ck_assert(memcmp(&whole[0].walked, &whole[1].walked, sizeof whole[0].walked) == 0);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("walk_heading");
    suite_add(suite, "axis", axis_is_that_of_the_largest_energy);
    suite_add_loop(suite, "variance", variance_is_that_of_the_attitudes_errors,
                   sizeof errors / sizeof errors[0]);
    suite_add_loop(suite, "poses", every_pose_and_mounting_shows_the_way_with_its_sign, 3);
    suite_add_loop(suite, "end", no_wrong_end_is_certain, 3);
    suite_add_loop(suite, "honest", variance_is_honest_on_noisy_walks, 3);
    suite_add_loop(suite, "turn", a_turn_is_followed, 5);
    suite_add(suite, "in the hand", a_turn_of_the_phone_does_not_matter);
    suite_add(suite, "bad stride", one_bad_stride_turns_nobody_round);
    suite_add(suite, "late", a_step_told_late_is_the_same);
    suite_add(suite, "pause", a_pause_lets_evidence_fade);
    suite_add(suite, "bounce", a_bounce_seen_at_a_slant_is_no_evidence);
    suite_add(suite, "tilt", unknown_tilt_adds_to_the_covariance);
    suite_add(suite, "device", device_is_where_the_phone_points);
    suite_add_loop(suite, "no walk", who_stands_or_falls_goes_nowhere, 2);
    suite_add(suite, "shaking", shaking_is_little_trusted);
    suite_add(suite, "settings", settings_have_ends);
    suite_add(suite, "samples", bad_samples_are_refused);
    suite_add(suite, "steps", bad_steps_are_refused);
    suite_add(suite, "finite", all_that_is_told_is_finite);
    suite_add(suite, "save", saved_and_restored_it_goes_on);
    return suite;
}
