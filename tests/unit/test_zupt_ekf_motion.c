/* SPDX-License-Identifier: MIT
 * The mechanisation against motions that have a formula: how wrong it is, and how fast that goes
 * down with the interval. */
#include "motion.h"
#include "near.h"
#include "sample.h"
#include "suite.h"

static const double EPS = (double)INSOLE_REAL_EPSILON;

/* Any mounting: the sensor is turned on the body by this. */
static d33_t mounting(void)
{
    return d33_mul(turn_x(2.1), d33_mul(turn_z(-0.7), turn_y(0.4)));
}

static moment_t mounted(moment_t m)
{
    m.R = d33_mul(m.R, mounting());
    m.w = d33_apply(d33_transpose(mounting()), m.w);
    return m;
}

/* ---- motions ---------------------------------------------------------------------------- */

static moment_t resting(double t)
{
    (void)t;
    moment_t m = {{1.0, -2.0, 3.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, turn_z(0.3)};
    return mounted(m);
}

static moment_t falling(double t)
{
    moment_t m = {{0.0, 0.0, -0.5 * MOTION_G * t * t},
                  {0.0, 0.0, -MOTION_G * t},
                  {0.0, 0.0, -MOTION_G},
                  {0.0, 2.0, 0.0},
                  turn_y(2.0 * t)};
    return mounted(m);
}

/* Round a circle of 1.5 m, looking ahead. */
static moment_t circling(double t)
{
    const double w = 1.2, r = 1.5;
    double c = cos(w * t), s = sin(w * t);
    moment_t m = {{r * s, r * (1.0 - c), 0.0},
                  {w * r * c, w * r * s, 0.0},
                  {-w * w * r * s, w * w * r * c, 0.0},
                  {0.0, 0.0, w},
                  turn_z(w * t)};
    return mounted(m);
}

/* On the rim of a wheel that turns upright: gravity goes round the sensor. */
static moment_t looping(double t)
{
    const double w = 3.0, r = 0.5;
    double c = cos(w * t), s = sin(w * t);
    moment_t m = {{r * s, 0.0, r * c},
                  {w * r * c, 0.0, -w * r * s},
                  {-w * w * r * s, 0.0, -w * w * r * c},
                  {0.0, w, 0.0},
                  turn_y(w * t)};
    return mounted(m);
}

/* The sensor's z axis goes round a cone while the sensor does not spin about it. */
static moment_t coning(double t)
{
    const double w = 9.0, tilt = 0.2;
    moment_t m = {{0.0, 0.0, 0.0},
                  {0.0, 0.0, 0.0},
                  {0.0, 0.0, 0.0},
                  {-w * sin(tilt) * cos(w * t), -w * sin(tilt) * sin(w * t), w * (cos(tilt) - 1.0)},
                  d33_mul(turn_z(w * t), d33_mul(turn_y(tilt), turn_z(-w * t)))};
    return mounted(m);
}

/* Rocking and shaking in step: the mean of a product that neither sensor sees. */
static moment_t sculling(double t)
{
    const double w = 9.0, tilt = 0.15, shake = 4.0;
    double s = sin(w * t), c = cos(w * t);
    moment_t m = {{-shake / (w * w) * s, 0.0, 0.0},
                  {-shake / w * c, 0.0, 0.0},
                  {shake * s, 0.0, 0.0},
                  {0.0, tilt * w * c, 0.0},
                  turn_y(tilt * s)};
    return mounted(m);
}

/* ---- the filter on them ----------------------------------------------------------------- */

typedef struct {
    double position_m, velocity_mps, attitude_rad;
} deviation_t;

static insole_zupt_ekf_config_t config_of(double point_share)
{
    insole_zupt_ekf_config_t config = insole_zupt_ekf_defaults;
    config.point_share = (insole_real_t)point_share;
    return config;
}

/* Where the filter ends after `seconds` in steps of `step_us`, against the formula. */
static deviation_t follow(motion_t motion, double seconds, unsigned step_us, double point_share)
{
    insole_zupt_ekf_t ekf;
    insole_zupt_ekf_config_t config = config_of(point_share);
    moment_t m = motion(0.0);
    unsigned steps = (unsigned)(seconds * 1.0e6 / step_us + 0.5);
    motion_put(&ekf, &config, &m, 1000u);
    for (unsigned k = 0u; k < steps; k++) {
        double begin = 1.0e-6 * k * step_us, end = 1.0e-6 * (k + 1u) * step_us;
        d3_t force, rate;
        motion_mean(motion, begin, end, &force, &rate);
        insole_imu_t imu = {1000u + (uint64_t)(k + 1u) * step_us, real_of(force), real_of(rate)};
        if (point_share > 0.0) {
            m = motion(end);
            imu.accel_mps2 = real_of(motion_force(&m));
            imu.gyro_radps = real_of(m.w);
        } else if (k == 0u) { /* the mean over the interval before the first */
            motion_mean(motion, -end, begin, &force, &rate);
            ekf.last_accel_mps2 = real_of(force);
            ekf.last_gyro_radps = real_of(rate);
        }
        ck_assert_int_eq(insole_zupt_ekf_predict(&ekf, &imu, 0u), INSOLE_OK);
    }
    m = motion(1.0e-6 * steps * step_us);
    deviation_t off = {d3_norm(d3_add(d3_of(ekf.p_m), -1.0, m.p)),
                       d3_norm(d3_add(d3_of(ekf.v_mps), -1.0, m.v)),
                       d3_norm(turn_between(m.R, d33_of(insole_quat_to_mat3(ekf.q))))};
    return off;
}

/* ---- order of convergence --------------------------------------------------------------- */

typedef struct {
    const char *name;
    motion_t motion;
    double point_share;
    unsigned step_us;
    double order;  /* of what is measured */
    bool attitude; /* measured: attitude [rad], else position [m] */
    double most;   /* error after 8 s in these steps */
} order_t;

/* The mean over an interval is felt from a turning frame: the position is of second order. Without
 * the sculling term the velocity of the rocking sensor would be off by w^2 tilt shake dt^2 / 12 a
 * second, 0.2 m after 8 s; without the coning term the attitude would be of second order. */
static const order_t ORDERS[] = {
    {"circle, means", circling, 0.0, 80000u, 2.0, false, 0.03},
    {"circle, points", circling, 1.0, 80000u, 2.0, false, 0.03},
    {"loop, means", looping, 0.0, 40000u, 2.0, false, 1.0},
    {"loop, points", looping, 1.0, 40000u, 2.0, false, 0.5},
    {"cone, means", coning, 0.0, 80000u, 4.0, true, 0.015},
    {"cone, means, finer", coning, 0.0, 40000u, 4.0, true, 1.0e-3},
    {"cone, points", coning, 1.0, 40000u, 2.0, true, 0.04},
    {"sculling, means", sculling, 0.0, 40000u, 2.0, false, 0.1},
    {"sculling, points", sculling, 1.0, 40000u, 2.0, false, 0.3},
};
enum { ORDER_COUNT = sizeof ORDERS / sizeof ORDERS[0] };

static double error_of(const order_t *row, unsigned step_us)
{
    deviation_t off = follow(row->motion, 8.0, step_us, row->point_share);
    return row->attitude ? off.attitude_rad : off.position_m;
}

START_TEST(converges_in_its_order)
{
    const order_t *row = &ORDERS[_i];
    double coarse = error_of(row, row->step_us), fine = error_of(row, row->step_us / 2u);
    ck_assert_msg(coarse <= row->most, "%s: %g, at most %g", row->name, coarse, row->most);
    ck_assert_msg(fabs(log2(coarse / fine) - row->order) < 0.3, "%s: order %.2f, expected %g",
                  row->name, log2(coarse / fine), row->order);
}
END_TEST

/* ---- exact cases ------------------------------------------------------------------------ */

START_TEST(turns_exactly_at_a_constant_rate)
{
    static const motion_t all[3] = {falling, circling, looping};
    for (int i = 0; i < 3; i++) {
        deviation_t off = follow(all[i], 8.0, 20000u, 0.25);
        ASSERT_AT_MOST(off.attitude_rad, 400.0 * EPS, "rad: one rounding for each step");
    }
}
END_TEST

START_TEST(falls_freely)
{
    static const unsigned step_us[3] = {40000u, 10000u, 5000u};
    const double seconds = 8.0;
    double steps = seconds * 1.0e6 / step_us[_i], way = 0.5 * MOTION_G * seconds * seconds;
    deviation_t off = follow(falling, seconds, step_us[_i], 0.25);
    ASSERT_AT_MOST(off.position_m, steps * EPS * way / 2.0, "m: one rounding for each step");
    ASSERT_AT_MOST(off.velocity_mps, steps * EPS * MOTION_G * seconds / 2.0, "m/s");
}
END_TEST

START_TEST(stays_where_it_rests)
{
    deviation_t off = follow(resting, 8.0, 5000u, 0.25);
    const double most = 4.0 * EPS * MOTION_G;
    ASSERT_AT_MOST(off.velocity_mps, most * 8.0, "m/s");
    ASSERT_AT_MOST(off.position_m, most * 32.0, "m");
    ASSERT_AT_MOST(off.attitude_rad, 3.0 * EPS, "rad");
}
END_TEST

/* ---- rates that grow evenly between samples --------------------------------------------- */

typedef struct {
    double w, x, y, z;
} d4_t;

static d4_t d4_add(d4_t q, double s, d4_t k)
{
    d4_t r = {q.w + s * k.w, q.x + s * k.x, q.y + s * k.y, q.z + s * k.z};
    return r;
}

/* dq/dt = q (0, w) / 2 */
static d4_t d4_rate(d4_t q, d3_t w)
{
    d4_t k = {-q.x * w.x - q.y * w.y - q.z * w.z, q.w * w.x + q.y * w.z - q.z * w.y,
              q.w * w.y + q.z * w.x - q.x * w.z, q.w * w.z + q.x * w.y - q.y * w.x};
    d4_t none = {0.0, 0.0, 0.0, 0.0};
    return d4_add(none, 0.5, k);
}

/* Runge and Kutta over one interval in 16 parts. */
static d4_t d4_turned(d4_t q, d3_t from, d3_t to, double dt)
{
    const int parts = 16;
    const double h = dt / parts;
    d3_t slope = d3_add(to, -1.0, from);
    for (int i = 0; i < parts; i++) {
        d3_t begin = d3_add(from, (double)i / parts, slope);
        d3_t middle = d3_add(from, (i + 0.5) / parts, slope);
        d4_t k1 = d4_rate(q, begin);
        d4_t k2 = d4_rate(d4_add(q, 0.5 * h, k1), middle);
        d4_t k3 = d4_rate(d4_add(q, 0.5 * h, k2), middle);
        d4_t k4 = d4_rate(d4_add(q, h, k3), d3_add(from, (i + 1.0) / parts, slope));
        q = d4_add(d4_add(q, h / 6.0, d4_add(k1, 1.0, k4)), h / 3.0, d4_add(k2, 1.0, k3));
    }
    return q;
}

/* Angle between the filter and the exact turn of rates that are those of the cone at the samples
 * and straight lines between them. */
static double error_on_lines(unsigned step_us)
{
    insole_zupt_ekf_t ekf;
    insole_zupt_ekf_config_t config = config_of(1.0);
    moment_t m = coning(0.0);
    motion_put(&ekf, &config, &m, 1000u);
    d4_t q = {(double)ekf.q.w, (double)ekf.q.x, (double)ekf.q.y, (double)ekf.q.z};
    d3_t last = m.w;
    const double dt = 1.0e-6 * step_us;
    for (unsigned k = 1u; k * step_us <= 8000000u; k++) {
        m = coning(dt * k);
        insole_imu_t imu = {1000u + (uint64_t)k * step_us, real_of(motion_force(&m)), real_of(m.w)};
        ck_assert_int_eq(insole_zupt_ekf_predict(&ekf, &imu, 0u), INSOLE_OK);
        q = d4_turned(q, last, m.w, dt);
        last = m.w;
    }
    d4_t e = {(double)ekf.q.w, (double)ekf.q.x, (double)ekf.q.y, (double)ekf.q.z};
    d3_t apart = d3(q.w * e.x - q.x * e.w - q.y * e.z + q.z * e.y,
                    q.w * e.y + q.x * e.z - q.y * e.w - q.z * e.x,
                    q.w * e.z - q.x * e.y + q.y * e.x - q.z * e.w);
    return 2.0 * d3_norm(apart);
}

/* Were the mean put where the samples belong, half of the correction would be lost and the order
 * would be 2. */
START_TEST(takes_point_samples_as_ends_of_lines)
{
    double coarse = error_on_lines(160000u), fine = error_on_lines(80000u);
    ASSERT_AT_MOST(coarse, 4.0e-4, "rad");
    ASSERT_NEAR(log2(coarse / fine), 4.0, 0.3, "order");
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("zupt_ekf motion");
    suite_add_loop(suite, "order of convergence", converges_in_its_order, ORDER_COUNT);
    suite_add(suite, "constant turn rates", turns_exactly_at_a_constant_rate);
    suite_add_loop(suite, "free fall", falls_freely, 3);
    suite_add(suite, "rest", stays_where_it_rests);
    suite_add(suite, "point samples", takes_point_samples_as_ends_of_lines);
    return suite;
}
