/* SPDX-License-Identifier: MIT */
#include "sim/walk.h"

#include <string.h>

#include "near.h"
#include "suite.h"
#include "walks.h"

static const double g = 9.81;

/* A course with all there is to walk: straight, corner, stop, turn on the spot, stairs, run. */
#define COURSE                                                                                     \
    "start,0,0,0\nwalk,6,0,1.2\nwalk,6,4,0.8\npause,1\nwalk,3,4,1.5\nturn,1\nwalk,3,20,3\n"        \
    "stairs,3,23,1.7,0.6\n"

/* --- an integrator of its own: Runge-Kutta of fourth order on position, velocity, attitude --- */

typedef struct {
    sim_vec3_t p, v;
    sim_mat3_t R;
} nav_t;

static sim_mat3_t times_skew(sim_mat3_t R, sim_vec3_t w)
{
    sim_mat3_t W = {{0.0, -w.z, w.y}, {w.z, 0.0, -w.x}, {-w.y, w.x, 0.0}};
    return sim_mat3_mul(R, W);
}

static nav_t slope(const nav_t *at, const sim_motion_t *felt)
{
    nav_t d = {at->v, sim_mat3_mul_vec(at->R, felt->force_mps2),
               times_skew(at->R, felt->rate_radps)};
    d.v.z -= g;
    return d;
}

static nav_t along(const nav_t *at, const nav_t *d, double h)
{
    nav_t n = {sim_vec3_add_scaled(at->p, h, d->p), sim_vec3_add_scaled(at->v, h, d->v), at->R};
    n.R.r0 = sim_vec3_add_scaled(at->R.r0, h, d->R.r0);
    n.R.r1 = sim_vec3_add_scaled(at->R.r1, h, d->R.r1);
    n.R.r2 = sim_vec3_add_scaled(at->R.r2, h, d->R.r2);
    return n;
}

static nav_t runge_kutta(const sim_body_t *body, nav_t at, double t, double h)
{
    sim_motion_t begin = sim_motion_at(body, t, 1e-4, g);
    sim_motion_t middle = sim_motion_at(body, t + 0.5 * h, 1e-4, g);
    sim_motion_t end = sim_motion_at(body, t + h, 1e-4, g);
    nav_t k1 = slope(&at, &begin), a2 = along(&at, &k1, 0.5 * h);
    nav_t k2 = slope(&a2, &middle), a3 = along(&at, &k2, 0.5 * h);
    nav_t k3 = slope(&a3, &middle), a4 = along(&at, &k3, h);
    nav_t k4 = slope(&a4, &end);
    at = along(&at, &k1, h / 6.0);
    at = along(&at, &k2, h / 3.0);
    at = along(&at, &k3, h / 3.0);
    return along(&at, &k4, h / 6.0);
}

static double worst_difference(const sim_mat3_t *a, const sim_mat3_t *b)
{
    return fmax(
        sim_vec3_norm(sim_vec3_sub(a->r0, b->r0)),
        fmax(sim_vec3_norm(sim_vec3_sub(a->r1, b->r1)), sim_vec3_norm(sim_vec3_sub(a->r2, b->r2))));
}

START_TEST(force_and_rate_integrate_to_the_true_way)
{
    sim_walk_t *walk = walk_of(COURSE "walk.lead_in_s = 0.5\n", 3);
    sim_body_t body = sim_walk_body(walk);
    double h = 5e-4;
    sim_pose_t start = body.pose(body.state, 0.0);
    nav_t nav = {start.position_m, {0.0, 0.0, 0.0}, start.attitude};
    nav.v = sim_vec3_scale(sim_vec3_sub(body.pose(body.state, 1e-4).position_m,
                                        body.pose(body.state, -1e-4).position_m),
                           0.5e4);
    double worst = 0.0, turned_off = 0.0;
    long steps = (long)(sim_walk_duration(walk) / h);
    for (long i = 0; i < steps; i++) {
        nav = runge_kutta(&body, nav, (double)i * h, h);
        sim_pose_t truth = body.pose(body.state, (double)(i + 1) * h);
        worst = fmax(worst, sim_vec3_norm(sim_vec3_sub(nav.p, truth.position_m)));
        turned_off = fmax(turned_off, worst_difference(&nav.R, &truth.attitude));
    }
    ASSERT_AT_MOST(turned_off, 1e-5, "rad");
    ASSERT_AT_LEAST((double)steps * h, 25.0, "s"); /* some twenty strides */
    ASSERT_AT_MOST(worst, 0.003, "m");
    sim_walk_close(walk);
}
END_TEST

/* Attitude after turning with a constant rate for h. */
static sim_mat3_t turned(sim_mat3_t R, sim_vec3_t w, double h)
{
    double angle = h * sim_vec3_norm(w);
    double s = angle < 1e-9 ? h : h * sin(angle) / angle;
    double c = angle < 1e-9 ? 0.5 * h * h : h * h * (1.0 - cos(angle)) / (angle * angle);
    sim_mat3_t first = times_skew(R, w), second = times_skew(first, w);
    R.r0 = sim_vec3_add_scaled(sim_vec3_add_scaled(R.r0, s, first.r0), c, second.r0);
    R.r1 = sim_vec3_add_scaled(sim_vec3_add_scaled(R.r1, s, first.r1), c, second.r1);
    R.r2 = sim_vec3_add_scaled(sim_vec3_add_scaled(R.r2, s, first.r2), c, second.r2);
    return R;
}

START_TEST(the_samples_of_an_ideal_sensor_lead_the_same_way)
{
    sim_walk_t *walk = walk_of(COURSE "imu.rate_hz = 1000\nimu.model = ideal\n", 3);
    sim_sample_t sample;
    ck_assert(sim_walk_next(walk, &sample));
    nav_t nav = {sample.truth.pose.position_m, {0.0, 0.0, 0.0}, sample.truth.pose.attitude};
    double h = 1e-3, worst = 0.0;
    while (sim_walk_next(walk, &sample) && sample.truth.t_s < 12.0) {
        insole_vec3_t f = sample.imu.accel_mps2, w = sample.imu.gyro_radps;
        sim_vec3_t force = sim_vec3((double)f.x, (double)f.y, (double)f.z);
        sim_vec3_t rate = sim_vec3((double)w.x, (double)w.y, (double)w.z);
        sim_mat3_t middle = turned(nav.R, rate, 0.5 * h);
        sim_vec3_t a = sim_mat3_mul_vec(middle, force);
        a.z -= g;
        nav.p = sim_vec3_add_scaled(sim_vec3_add_scaled(nav.p, h, nav.v), 0.5 * h * h, a);
        nav.v = sim_vec3_add_scaled(nav.v, h, a);
        nav.R = turned(nav.R, rate, h);
        worst = fmax(worst, sim_vec3_norm(sim_vec3_sub(nav.p, sample.truth.pose.position_m)));
    }
    ASSERT_AT_MOST(worst, 0.02, "m");
    sim_walk_close(walk);
}
END_TEST

START_TEST(the_sensor_rides_on_the_foot)
{
    sim_walk_t *walk = walk_of("start,0,0,0\nwalk,5,0,1.2\nmount.x_m = 0.1\nmount.y_m = -0.02\n"
                               "mount.z_m = 0.07\nmount.roll_rad = 3\nmount.yaw_rad = -2\n",
                               1);
    sim_sample_t sample;
    while (sim_walk_next(walk, &sample)) {
        sim_pose_t foot = sim_gait_pose(sim_walk_gait(walk), sample.truth.t_s);
        sim_vec3_t lever = sim_mat3_mul_vec_t(
            foot.attitude, sim_vec3_sub(sample.truth.pose.position_m, foot.position_m));
        ASSERT_NEAR(lever.x, 0.1, 1e-9, "m");
        ASSERT_NEAR(lever.y, -0.02, 1e-9, "m");
        ASSERT_NEAR(lever.z, 0.07, 1e-9, "m");
        ck_assert(sample.foot_m.x == foot.position_m.x);
    }
    sim_walk_close(walk);
}
END_TEST

START_TEST(a_turned_mounting_turns_the_readings)
{
    const char *plain = "start,0,0,0\nwalk,5,0,1.2\nimu.model = ideal\nmount.roll_rad = 0\n"
                        "mount.pitch_rad = 0\nmount.yaw_rad = 0\n";
    sim_walk_t *a = walk_of(plain, 1);
    sim_walk_t *b = walk_of("start,0,0,0\nwalk,5,0,1.2\nimu.model = ideal\nmount.roll_rad = 2.5\n"
                            "mount.pitch_rad = -0.8\nmount.yaw_rad = 1.1\n",
                            1);
    sim_mat3_t M = sim_mat3_from_euler(2.5, -0.8, 1.1);
    sim_sample_t s, t;
    while (sim_walk_next(a, &s) && sim_walk_next(b, &t)) {
        sim_vec3_t f = sim_mat3_mul_vec(M, t.truth.force_mps2);
        sim_vec3_t w = sim_mat3_mul_vec(M, t.truth.rate_radps);
        ASSERT_NEAR(sim_vec3_norm(sim_vec3_sub(f, s.truth.force_mps2)), 0.0, 1e-6, "m/s^2");
        ASSERT_NEAR(sim_vec3_norm(sim_vec3_sub(w, s.truth.rate_radps)), 0.0, 1e-6, "rad/s");
        ASSERT_NEAR(t.truth.pose.position_m.x, s.truth.pose.position_m.x, 1e-12, "m");
    }
    sim_walk_close(a);
    sim_walk_close(b);
}
END_TEST

static const double rates[] = {50.0, 66.7, 100.0, 200.0, 400.0, 1000.0};

START_TEST(samples_come_at_their_rate_until_the_end)
{
    char text[100];
    snprintf(text, sizeof text, "start,0,0,0\nwalk,5,0,1.2\nimu.rate_hz = %g\n", rates[_i]);
    sim_walk_t *walk = walk_of(text, 1);
    sim_sample_t sample;
    long count = 0;
    while (sim_walk_next(walk, &sample)) {
        ck_assert(sample.given);
        ASSERT_NEAR(sample.truth.t_s, (double)count / rates[_i], 1e-9, "s");
        ASSERT_NEAR(1e-6 * (double)sample.imu.t_us, sample.truth.t_s, 0.51e-6, "s");
        count++;
    }
    ASSERT_NEAR((double)count / rates[_i], sim_walk_duration(walk), 1.01 / rates[_i], "s");
    ck_assert(!sim_walk_next(walk, &sample));
    sim_walk_close(walk);
}
END_TEST

static const double leads[] = {0.0, 3.0, 12.5};

START_TEST(the_foot_is_still_before_the_first_step)
{
    char text[100];
    snprintf(text, sizeof text, "start,0,0,0\nwalk,5,0,1.2\nwalk.lead_in_s = %g\n", leads[_i]);
    sim_walk_t *walk = walk_of(text, 1);
    sim_body_t body = sim_walk_body(walk);
    sim_vec3_t first = body.pose(body.state, 0.0).position_m;
    double t = 0.0;
    while (sim_vec3_norm(sim_vec3_sub(body.pose(body.state, t).position_m, first)) < 5e-4) {
        if (t < leads[_i] - 1.0) { /* no trembling of the walker yet */
            ASSERT_AT_MOST(sim_vec3_norm(sim_motion_at(&body, t, 5e-4, g).rate_radps), 0.02,
                           "rad/s");
        }
        t += 0.01;
    }
    ASSERT_AT_LEAST(t, leads[_i], "s");
    ASSERT_AT_MOST(t, leads[_i] + 1.5, "s"); /* the other foot may go first */
    sim_walk_close(walk);
}
END_TEST

START_TEST(a_loop_ends_where_it_began)
{
    sim_walk_t *walk = walk_of("start,2,3,1\nwalk,12,3,1.2\nwalk,12,9,1.3\npause,1\nwalk,2,9,1.1\n"
                               "walk,2,3,1\nturn,1\ngait.still_rad = 0\n",
                               5);
    sim_body_t body = sim_walk_body(walk);
    sim_pose_t a = body.pose(body.state, 0.0), b = body.pose(body.state, sim_walk_duration(walk));
    ASSERT_NEAR(sim_vec3_norm(sim_vec3_sub(a.position_m, b.position_m)), 0.0, 1e-9, "m");
    ASSERT_NEAR(worst_difference(&a.attitude, &b.attitude), 0.0, 1e-9, "rad");
    sim_walk_close(walk);
}
END_TEST

static const double speeds[] = {0.5, 0.9, 1.2, 1.6, 2.5, 3.5};

START_TEST(the_sensor_goes_at_the_speed_asked_for)
{
    char text[100];
    snprintf(text, sizeof text, "start,0,0,0\nwalk,60,0,%g\n", speeds[_i]);
    sim_walk_t *walk = walk_of(text, 2);
    sim_sample_t sample;
    double from_s = 0.0, to_s = 0.0, last = 0.0;
    while (sim_walk_next(walk, &sample)) {
        last = sample.truth.pose.position_m.x;
        from_s = last < 15.0 ? sample.truth.t_s : from_s;
        to_s = last < 45.0 ? sample.truth.t_s : to_s;
    }
    /* either end may lie anywhere in a stride */
    ASSERT_NEAR(30.0 / (to_s - from_s), speeds[_i], 0.04 * speeds[_i], "m/s");
    ASSERT_NEAR(last, 60.0 + 0.06 + 0.001, 0.01, "m");
    ASSERT_NEAR(sim_walk_distance(walk), 60.0, 1e-9, "m");
    sim_walk_close(walk);
}
END_TEST

START_TEST(stairs_lift_the_sensor)
{
    sim_walk_t *walk = walk_of("start,0,0,0,10\nstairs,6,0,13.4,0.5\nstairs,12,0,10,0.5\n", 2);
    sim_sample_t sample;
    double highest = 0.0;
    while (sim_walk_next(walk, &sample)) {
        double z = sample.truth.pose.position_m.z, x = sample.foot_m.x;
        highest = fmax(highest, z);
        double ramp = 10.0 + 3.4 * (x < 6.0 ? x : 12.0 - x) / 6.0;
        ASSERT_NEAR(sample.foot_m.z, ramp, 0.45, "m");
    }
    ASSERT_AT_LEAST(highest, 13.4, "m");
    ASSERT_NEAR(sample.truth.pose.position_m.z, 10.08, 0.002, "m");
    sim_walk_close(walk);
}
END_TEST

START_TEST(equal_seeds_make_equal_walks)
{
    sim_walk_t *a = walk_of(COURSE, 5), *b = walk_of(COURSE, 5), *c = walk_of(COURSE, 6);
    sim_sample_t s, t, u;
    bool differs = false;
    for (int i = 0; i < 3000; i++) {
        memset(&s, 0, sizeof s);
        memset(&t, 0, sizeof t);
        ck_assert(sim_walk_next(a, &s) && sim_walk_next(b, &t) && sim_walk_next(c, &u));
        ck_assert_mem_eq(&s, &t, sizeof s);
        differs = differs ||
                  (i > 1500 && fabs(s.truth.pose.position_m.x - u.truth.pose.position_m.x) > 0.005);
    }
    ck_assert(differs);
    sim_walk_close(a);
    sim_walk_close(b);
    sim_walk_close(c);
}
END_TEST

/* --- what a walk feels like, against the bands that recorded walks and runs lie in --- */

typedef struct {
    double gyro_peak, accel_peak, quiet, period;
} features_t;

static double median(double *values, size_t count)
{
    for (size_t i = 1; i < count; i++) {
        for (size_t k = i; k > 0 && values[k - 1] > values[k]; k--) {
            double swap = values[k];
            values[k] = values[k - 1];
            values[k - 1] = swap;
        }
    }
    return values[count / 2];
}

/* Medians over the strides in the middle of the walk; quiet: share of samples below 1 rad/s. */
static features_t features_of(sim_walk_t *walk)
{
    double gyro[200] = {0.0}, accel[200] = {0.0}, quiet[200], periods[200];
    size_t first = 6, count = stride_count(walk) - 12, stride = first;
    long samples = 0, still = 0;
    sim_sample_t sample;
    while (sim_walk_next(walk, &sample) && stride < first + count) {
        double t = sample.truth.t_s;
        insole_vec3_t f = sample.imu.accel_mps2, w = sample.imu.gyro_radps;
        if (t < stride_of(walk, stride)->lift_s) {
            continue;
        }
        double wn = (double)insole_vec3_norm(w);
        size_t i = stride - first;
        gyro[i] = fmax(gyro[i], wn);
        accel[i] = fmax(accel[i], (double)insole_vec3_norm(f));
        samples++;
        still += wn < 1.0 ? 1 : 0;
        if (t >= stride_of(walk, stride + 1)->lift_s) {
            quiet[i] = (double)still / (double)samples;
            periods[i] = stride_of(walk, stride + 1)->lift_s - stride_of(walk, stride)->lift_s;
            samples = still = 0;
            stride++;
        }
    }
    features_t f = {median(gyro, count), median(accel, count), median(quiet, count),
                    median(periods, count)};
    return f;
}

/* Bands of recordings at about these speeds (foot sensors, 200 to 400 Hz). */
static const struct {
    double speed;
    double gyro[2], accel[2], quiet[2], period[2];
} bands[] = {
    {0.5, {2.7, 4.5}, {17.0, 31.0}, {0.45, 0.60}, {1.3, 1.95}},
    {1.0, {5.2, 8.0}, {22.0, 36.0}, {0.36, 0.48}, {1.1, 1.5}},
    {1.2, {6.7, 10.0}, {28.0, 47.0}, {0.30, 0.43}, {1.0, 1.25}},
    {1.4, {7.5, 10.0}, {34.0, 50.0}, {0.25, 0.40}, {0.95, 1.2}},
    {2.5, {8.0, 11.0}, {52.0, 90.0}, {0.03, 0.20}, {0.70, 0.90}},
};

START_TEST(a_walk_feels_like_a_recorded_one)
{
    char text[100];
    snprintf(text, sizeof text, "start,0,0,0\nwalk,60,0,%g\n", bands[_i].speed);
    sim_walk_t *walk = walk_of(text, 1);
    features_t f = features_of(walk);
    ASSERT_AT_LEAST(f.gyro_peak, bands[_i].gyro[0], "rad/s");
    ASSERT_AT_MOST(f.gyro_peak, bands[_i].gyro[1], "rad/s");
    ASSERT_AT_LEAST(f.accel_peak, bands[_i].accel[0], "m/s^2");
    ASSERT_AT_MOST(f.accel_peak, bands[_i].accel[1], "m/s^2");
    ASSERT_AT_LEAST(f.quiet, bands[_i].quiet[0], "1");
    ASSERT_AT_MOST(f.quiet, bands[_i].quiet[1], "1");
    ASSERT_AT_LEAST(f.period, bands[_i].period[0], "s");
    ASSERT_AT_MOST(f.period, bands[_i].period[1], "s");
    sim_walk_close(walk);
}
END_TEST

START_TEST(the_start_heading_is_that_of_the_first_two_strides)
{
    static const struct {
        const char *text;
        bool known;
        double heading;
    } starts[] = {{"start,0,0,0\nwalk,9,0,1.2\n", true, 0.0},
                  {"start,0,0,2\nwalk,0,9,1.2\n", true, 0.5 * SIM_PI},
                  {"start,0,0,-3\nturn,0\nwalk,-5,-5,1\n", true, -0.75 * SIM_PI},
                  {"start,0,0,1\npause,3\n", false, 0.0},
                  {"start,0,0,1\nturn,-1\n", false, 0.0}};
    for (size_t i = 0; i < sizeof starts / sizeof starts[0]; i++) {
        sim_walk_t *walk = walk_of(starts[i].text, 1);
        double heading = 0.0;
        ck_assert_int_eq(sim_walk_start_heading(walk, &heading), starts[i].known);
        ASSERT_NEAR(sim_wrap_pi(heading - starts[i].heading), 0.0, 0.03, "rad");
        sim_walk_close(walk);
    }
}
END_TEST

START_TEST(standing_alone_is_a_walk)
{
    sim_walk_t *walk = walk_of("start,1,2,0\npause,4\n", 1);
    sim_sample_t sample;
    ASSERT_NEAR(sim_walk_duration(walk), 9.0, 1e-12, "s");
    ck_assert_uint_eq(stride_count(walk), 0u);
    while (sim_walk_next(walk, &sample)) {
        ck_assert(sample.flat);
        ASSERT_NEAR(sample.foot_m.x, 1.0, 1e-12, "m");
        ASSERT_NEAR(sim_vec3_norm(sample.truth.force_mps2), g, 0.05, "m/s^2");
    }
    sim_walk_close(walk);
}
END_TEST

/* Every key anywhere in its range, often at an end of it. */
static void shuffle_settings(sim_settings_t *settings, insole_rng_t *rng)
{
    for (size_t i = 0; sim_key_at(i) != NULL; i++) {
        const sim_key_t *key = sim_key_at(i);
        uint32_t way = insole_rng_bits(rng) % 4u;
        double share = way == 0u ? 0.0 : way == 1u ? 1.0 : (double)insole_rng_uniform(rng);
        double value = key->low + share * (key->high - key->low);
        unsigned char *member = (unsigned char *)settings + key->offset;
        int32_t number = (int32_t)(value + 0.5);
        if (key->is_choice) {
            memcpy(member, &number, sizeof number);
        } else {
            memcpy(member, &value, sizeof value);
        }
    }
    settings->walk.lead_in_s = fmin(settings->walk.lead_in_s, 2.0);
    settings->walk.lead_out_s = fmin(settings->walk.lead_out_s, 2.0);
    settings->walk.riser_m = 0.17; /* else the stairs are too deep or steep to climb */
}

START_TEST(any_settings_give_a_finite_walk)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, (uint64_t)_i);
    sim_scenario_t scenario =
        scenario_of("start,0,0,0\nwalk,5,0,0.3\nwalk,5,3,4\npause,0\nturn,3\nwalk,-9,3.1,2\n"
                    "stairs,-9,6,1.7,1.2\nwalk,-9,9,1.9\n");
    shuffle_settings(&scenario.settings, &rng);
    sim_error_t error;
    sim_walk_t *walk = sim_walk_open(&scenario, 1, &error);
    ck_assert_msg(walk != NULL, "line %d: %s", error.line, error.text);
    sim_sample_t sample;
    uint64_t last_us = 0;
    bool fine = true;
    double furthest = 0.0;
    while (fine && sim_walk_next(walk, &sample)) {
        const insole_imu_t *imu = &sample.imu;
        fine = isfinite(sim_vec3_norm(sample.truth.force_mps2)) &&
               isfinite(sim_vec3_norm(sample.truth.rate_radps));
        furthest = fmax(furthest, sim_vec3_norm(sample.truth.pose.position_m));
        if (sample.given) {
            fine = fine && insole_vec3_is_finite(imu->accel_mps2) &&
                   insole_vec3_is_finite(imu->gyro_radps) && (last_us == 0 || imu->t_us > last_us);
            last_us = imu->t_us;
        }
    }
    ck_assert_msg(fine, "at %g s", sample.truth.t_s);
    ASSERT_AT_MOST(furthest, 20.0, "m");
    ASSERT_NEAR(sample.foot_m.x, -9.0, 0.3, "m");
    ASSERT_NEAR(sample.foot_m.y, 9.0, 0.3, "m");
    sim_walk_close(walk);
    sim_scenario_free(&scenario);
}
END_TEST

START_TEST(what_cannot_be_walked_is_not_opened)
{
    sim_scenario_t scenario = scenario_of("start,0,0,0\nwalk,9,0,1\nwalk,9,0,1\n");
    sim_error_t error;
    ck_assert_ptr_null(sim_walk_open(&scenario, 1, &error));
    ck_assert_int_eq(error.line, 3);
    sim_scenario_free(&scenario);
    sim_walk_close(NULL);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("sim/walk");
    suite_add(suite, "integral", force_and_rate_integrate_to_the_true_way);
    suite_add(suite, "samples", the_samples_of_an_ideal_sensor_lead_the_same_way);
    suite_add(suite, "lever", the_sensor_rides_on_the_foot);
    suite_add(suite, "mounting", a_turned_mounting_turns_the_readings);
    suite_add_loop(suite, "rate", samples_come_at_their_rate_until_the_end, 6);
    suite_add_loop(suite, "lead-in", the_foot_is_still_before_the_first_step, 3);
    suite_add(suite, "loop", a_loop_ends_where_it_began);
    suite_add_loop(suite, "speed", the_sensor_goes_at_the_speed_asked_for, 6);
    suite_add(suite, "stairs", stairs_lift_the_sensor);
    suite_add(suite, "seeds", equal_seeds_make_equal_walks);
    suite_add_loop(suite, "real", a_walk_feels_like_a_recorded_one, 5);
    suite_add(suite, "start heading", the_start_heading_is_that_of_the_first_two_strides);
    suite_add(suite, "standing", standing_alone_is_a_walk);
    suite_add_loop(suite, "any settings", any_settings_give_a_finite_walk, 12);
    suite_add(suite, "refusal", what_cannot_be_walked_is_not_opened);
    return suite;
}
