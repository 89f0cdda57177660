/* SPDX-License-Identifier: MIT */
#include "sim/motion.h"

#include "near.h"
#include "suite.h"

static const double g = 9.81;

/* A body on a circle of radius r that it goes round with the rate w, x axis forward. */
typedef struct {
    double r, w;
} circle_t;

static sim_pose_t circling(const void *state, double t)
{
    const circle_t *c = state;
    sim_pose_t pose = {sim_vec3(c->r * cos(c->w * t), c->r * sin(c->w * t), 1.0),
                       sim_mat3_from_euler(0.0, 0.0, c->w * t + 0.5 * SIM_PI)};
    return pose;
}

/* A body that is shaken along x of n and keeps its attitude. */
typedef struct {
    double amplitude, w, roll, pitch, yaw;
} shaker_t;

static sim_pose_t shaken(const void *state, double t)
{
    const shaker_t *s = state;
    sim_pose_t pose = {sim_vec3(s->amplitude * sin(s->w * t), 0.0, 0.0),
                       sim_mat3_from_euler(s->roll, s->pitch, s->yaw)};
    return pose;
}

/* Coning: the rate turns about x and y while the body wobbles about z. */
static sim_pose_t coning(const void *state, double t)
{
    double angle = *(const double *)state;
    sim_pose_t pose = {sim_vec3(0.0, 0.0, 0.0),
                       sim_mat3_from_euler(angle * cos(30.0 * t), angle * sin(30.0 * t), 0.3 * t)};
    return pose;
}

static void assert_vec(sim_vec3_t v, double x, double y, double z, double tolerance,
                       const char *unit)
{
    ASSERT_NEAR(v.x, x, tolerance, unit);
    ASSERT_NEAR(v.y, y, tolerance, unit);
    ASSERT_NEAR(v.z, z, tolerance, unit);
}

START_TEST(at_rest_it_feels_gravity_upwards)
{
    shaker_t shaker = {0.0, 0.0, 0.3, -0.4, 1.0};
    sim_body_t body = {shaken, &shaker};
    sim_motion_t m = sim_motion_at(&body, 3.0, 5e-4, g);
    assert_vec(m.rate_radps, 0.0, 0.0, 0.0, 1e-10, "rad/s");
    /* third row of R */
    assert_vec(m.force_mps2, g * sin(0.4), g * cos(-0.4) * sin(0.3), g * cos(-0.4) * cos(0.3), 1e-9,
               "m/s^2");
}
END_TEST

START_TEST(on_a_circle_it_feels_the_pull_to_the_middle)
{
    circle_t circle = {2.0, 3.0};
    sim_body_t body = {circling, &circle};
    for (double t = 0.0; t < 5.0; t += 0.37) {
        sim_motion_t m = sim_motion_at(&body, t, 5e-4, g);
        assert_vec(m.rate_radps, 0.0, 0.0, 3.0, 1e-8, "rad/s");
        assert_vec(m.force_mps2, 0.0, 18.0, g, 1e-7, "m/s^2");
    }
}
END_TEST

/* A body that turns about a slanted axis of its own has a rate along that axis. */
static sim_pose_t rolling(const void *state, double t)
{
    const double *rate = state;
    sim_pose_t pose = {sim_vec3(0.0, 0.0, 0.0),
                       sim_mat3_mul(sim_mat3_from_euler(0.2, 0.6, -1.0),
                                    sim_mat3_from_euler(*rate * t, 0.0, 0.0))};
    return pose;
}

START_TEST(rates_are_those_of_the_body)
{
    double rate = -7.0;
    sim_body_t body = {rolling, &rate};
    assert_vec(sim_motion_at(&body, 0.9, 5e-4, g).rate_radps, -7.0, 0.0, 0.0, 1e-8, "rad/s");
}
END_TEST

START_TEST(fast_ringing_is_followed)
{
    shaker_t shaker = {1e-3, 2.0 * SIM_PI * 40.0, 0.0, 0.0, 0.0};
    sim_body_t body = {shaken, &shaker};
    for (double t = 0.0; t < 0.03; t += 1e-3) {
        double a = -shaker.amplitude * shaker.w * shaker.w * sin(shaker.w * t);
        ASSERT_NEAR(sim_motion_at(&body, t, 5e-4, g).force_mps2.x, a, 63.0 * 4e-6, "m/s^2");
    }
}
END_TEST

static const double rates[] = {50.0, 100.0, 166.7, 200.0, 333.0, 1000.0};
enum { RATES = sizeof rates / sizeof rates[0] };

START_TEST(point_samples_are_the_motion_at_the_sample)
{
    double angle = 0.1;
    sim_body_t body = {coning, &angle};
    sim_motion_stream_t stream = sim_motion_stream(body, rates[_i], g);
    for (int k = 0; k < 50; k++) {
        sim_motion_t m = sim_motion_next_point(&stream);
        sim_motion_t at = sim_motion_at(&body, k / rates[_i], 1e-4, g);
        ASSERT_NEAR(m.t_s, k / rates[_i], 1e-12, "s");
        assert_vec(m.rate_radps, at.rate_radps.x, at.rate_radps.y, at.rate_radps.z, 1e-6, "rad/s");
        assert_vec(m.force_mps2, at.force_mps2.x, at.force_mps2.y, at.force_mps2.z, 1e-6, "m/s^2");
        ck_assert(m.pose.attitude.r1.x == body.pose(body.state, m.t_s).attitude.r1.x);
    }
}
END_TEST

START_TEST(mean_samples_are_the_mean_since_the_sample_before)
{
    shaker_t shaker = {0.05, 2.0 * SIM_PI * 15.0, 0.0, 0.0, 0.0};
    sim_body_t body = {shaken, &shaker};
    sim_motion_stream_t stream = sim_motion_stream(body, rates[_i], g);
    for (int k = 0; k < 100; k++) {
        sim_motion_t m = sim_motion_next_mean(&stream);
        double before = (k - 1) / rates[_i], now = k / rates[_i], w = shaker.w;
        double gain = shaker.amplitude * w * (cos(w * now) - cos(w * before)); /* of velocity */
        ASSERT_NEAR(m.force_mps2.x, gain * rates[_i], 0.1, "m/s^2"); /* trapezoids of 444 m/s^2 */
        ASSERT_NEAR(m.force_mps2.z, g, 1e-9, "m/s^2");
        ASSERT_NEAR(m.pose.position_m.x, shaker.amplitude * sin(w * now), 1e-12, "m");
    }
}
END_TEST

START_TEST(long_streams_keep_time)
{
    circle_t circle = {1.0, 0.1};
    sim_body_t body = {circling, &circle};
    sim_motion_stream_t stream = sim_motion_stream(body, 60.0, g);
    sim_motion_t m = sim_motion_next_point(&stream);
    for (int k = 1; k <= 6000; k++) {
        m = sim_motion_next_point(&stream);
    }
    ASSERT_NEAR(m.t_s, 100.0, 1e-12, "s");
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("sim/motion");
    suite_add(suite, "rest", at_rest_it_feels_gravity_upwards);
    suite_add(suite, "circle", on_a_circle_it_feels_the_pull_to_the_middle);
    suite_add(suite, "body rates", rates_are_those_of_the_body);
    suite_add(suite, "ringing", fast_ringing_is_followed);
    suite_add_loop(suite, "points", point_samples_are_the_motion_at_the_sample, RATES);
    suite_add_loop(suite, "means", mean_samples_are_the_mean_since_the_sample_before, RATES);
    suite_add(suite, "long", long_streams_keep_time);
    return suite;
}
