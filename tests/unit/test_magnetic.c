/* SPDX-License-Identifier: MIT */
#include "insole/move/magnetic.h"

#include "insole/move/attitude_ekf.h"
#include "insole/move/attitude_ukf.h"
#include "near.h"
#include "phone.h"
#include "refusal.h"
#include "setting.h"
#include "suite.h"

#define PI  3.14159265358979323846
#define DEG (PI / 180.0)

static const d3_t STILL = {0.0, 0.0, 0.0};
static const d3_t EARTH_UT = {20.0, 5.0, -43.0};

/* A phone with a magnetometer, and what follows it. */
typedef struct {
    phone_t phone;
    insole_attitude_t att;
    insole_magnetic_t magnetic;
    insole_attitude_method_t *method;
    d3_t iron_ut; /* added to the earth's field, n */
} bench_t;

static bench_t bench(int32_t use, insole_attitude_method_t *method)
{
    bench_t b = {.phone = phone(turn_x(0.4), 1u), .method = method};
    insole_magnetic_config_t settings = insole_magnetic_defaults;
    settings.use = use;
    b.phone.accel_noise = 0.02;
    b.phone.gyro_bias = d3(0.001, -0.002, 0.008);
    ck_assert_int_eq(insole_attitude_init(&b.att, &insole_attitude_defaults), INSOLE_OK);
    ck_assert_int_eq(insole_magnetic_init(&b.magnetic, &settings), INSOLE_OK);
    return b;
}

static insole_mag_t reading(bench_t *b)
{
    d3_t n = d3_add(EARTH_UT, 1.0, b->iron_ut);
    d3_t f = d3_add(d33_apply(d33_transpose(b->phone.R), n), 0.5, phone_noise(&b->phone, 1.0));
    insole_mag_t mag = {b->phone.t_us, real_of(f)};
    return mag;
}

static void walk_for(bench_t *b, d3_t w, double time_s)
{
    for (int i = 0, n = (int)lround(time_s * 50.0); i < n; i++) {
        insole_imu_t imu = phone_sample(&b->phone, w, 20000u);
        ck_assert_int_eq(insole_attitude_push(&b->att, b->method, &imu, 0u), INSOLE_OK);
        insole_mag_t mag = reading(b);
        if (!b->att.levelling) {
            ck_assert_int_eq(insole_magnetic_push(&b->magnetic, &b->att, b->method, &mag),
                             INSOLE_OK);
        }
    }
}

/* Heading of the truth less that of the estimate: n of the attitude has a yaw of its own. */
static double offset_of(const bench_t *b)
{
    d33_t Q = d33_of(insole_quat_to_mat3(b->att.q));
    d33_t E = d33_mul(b->phone.R, d33_transpose(Q));
    return atan2(E.r1.x, E.r0.x);
}

static double drift_over(bench_t *b, double time_s)
{
    walk_for(b, STILL, 2.0);
    double before = offset_of(b);
    walk_for(b, d3(0.0, 0.0, 0.4), time_s);
    return remainder(offset_of(b) - before, 2.0 * PI) / DEG;
}

/* Two minutes with a bias of half a degree a second. */
START_TEST(the_field_holds_the_heading)
{
    insole_attitude_method_t *method = _i == 0 ? insole_attitude_ekf : insole_attitude_ukf;
    bench_t off = bench(0, method), on = bench(1, method);
    ASSERT_AT_LEAST(fabs(drift_over(&off, 120.0)), 40.0, "degrees");
    ASSERT_AT_MOST(fabs(drift_over(&on, 120.0)), 6.0, "degrees");
    ck_assert_uint_eq(off.magnetic.corrected, 0u);
    ck_assert_uint_gt(on.magnetic.corrected, 5900u);
    ASSERT_NEAR(on.magnetic.deviation_ut, 0.0, 3.0, "uT");
}
END_TEST

/* Beside a steel door strength and dip are wrong: for these seconds the gyro goes alone. */
START_TEST(what_is_disturbed_is_not_used)
{
    bench_t b = bench(1, insole_attitude_ukf);
    (void)drift_over(&b, 20.0);
    b.iron_ut = d3(-5.0, 15.0, 12.0);
    uint32_t corrected = b.magnetic.corrected, passed = b.magnetic.passed;
    double before = offset_of(&b);
    walk_for(&b, d3(0.0, 0.0, 0.4), 5.0);
    ck_assert_uint_eq(b.magnetic.corrected, corrected);
    ck_assert_uint_eq(b.magnetic.passed, passed + 250u);
    ASSERT_AT_LEAST(b.magnetic.deviation_ut, 10.0, "uT");
    /* five seconds of the bias, and nothing of the 45 degrees that the field is turned */
    ASSERT_NEAR(remainder(offset_of(&b) - before, 2.0 * PI) / DEG, -0.008 * 5.0 / DEG, 1.0,
                "degrees");
    b.iron_ut = d3(0.0, 0.0, 0.0);
    walk_for(&b, d3(0.0, 0.0, 0.4), 60.0);
    ck_assert_uint_gt(b.magnetic.corrected, corrected + 2900u);
}
END_TEST

/* A told reference gives north: from a wrong heading it is found. */
START_TEST(a_told_field_knows_north)
{
    bench_t b = bench(1, insole_attitude_ukf);
    b.phone.gyro_bias = STILL;
    ck_assert_int_eq(insole_magnetic_set_field(&b.magnetic, real_of(EARTH_UT)), INSOLE_OK);
    ck_assert(b.magnetic.told);
    walk_for(&b, STILL, 0.52);
    double heading = atan2(b.phone.R.r1.y, b.phone.R.r0.y) + 1.0;
    ck_assert_int_eq(insole_attitude_set_heading(&b.att, (insole_real_t)heading, INSOLE_R(1.0)),
                     INSOLE_OK);
    ASSERT_NEAR(offset_of(&b), -1.0, 0.05, "rad");
    walk_for(&b, STILL, 30.0);
    ASSERT_NEAR(offset_of(&b), 0.0, 0.06, "rad");
    ASSERT_AT_MOST(insole_attitude_covariance(&b.att).zz, 0.1 * 0.1, "rad^2");
}
END_TEST

/* The mean of the first 25 readings, in n. */
START_TEST(the_first_readings_are_the_reference)
{
    bench_t b = bench(1, insole_attitude_ekf);
    walk_for(&b, STILL, 0.98); /* half a second of these levels */
    ck_assert(!b.magnetic.told);
    walk_for(&b, STILL, 0.04);
    ck_assert(b.magnetic.told);
    ck_assert_uint_eq(b.magnetic.learned, 25u);
    d3_t expected = d33_apply(turn_z(-offset_of(&b)), EARTH_UT);
    ASSERT_NEAR(d3_norm(d3_add(d3_of(b.magnetic.field_ut), -1.0, expected)), 0.0, 1.0, "uT");
    ck_assert_int_eq(insole_magnetic_set_field(&b.magnetic, insole_vec3_zero()), INSOLE_OK);
    ck_assert(!b.magnetic.told);
    walk_for(&b, STILL, 1.0);
    ck_assert(b.magnetic.told);
}
END_TEST

START_TEST(azimuth_is_that_of_the_level_field)
{
    insole_real_t azimuth = 7;
    insole_vec3_t field = insole_vec3(0, 0, -43);
    bench_t b = bench(0, insole_attitude_ekf);
    ck_assert_int_eq(insole_magnetic_azimuth(&b.att, field, &azimuth), INSOLE_ERR_STATE);
    walk_for(&b, STILL, 1.0);
    for (int deg = -175; deg < 180; deg += 10) {
        d3_t n = d3(20.0 * cos(deg * DEG), 20.0 * sin(deg * DEG), -43.0);
        d33_t Q = d33_of(insole_quat_to_mat3(b.att.q));
        field = real_of(d33_apply(d33_transpose(Q), n));
        ck_assert_int_eq(insole_magnetic_azimuth(&b.att, field, &azimuth), INSOLE_OK);
        ASSERT_NEAR(azimuth, deg * DEG, 1.0e-5, "rad");
    }
    azimuth = 7;
    field = insole_quat_rotate_back(b.att.q, insole_vec3(INSOLE_R(0.5), 0, -60));
    ck_assert_int_eq(insole_magnetic_azimuth(&b.att, field, &azimuth), INSOLE_ERR_STATE);
    field.x = (insole_real_t)NAN;
    ck_assert_int_eq(insole_magnetic_azimuth(&b.att, field, &azimuth), INSOLE_ERR_VALUE);
    ck_assert_int_eq(insole_magnetic_azimuth(NULL, field, &azimuth), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_magnetic_azimuth(&b.att, field, NULL), INSOLE_ERR_NULL);
    ASSERT_NEAR(azimuth, 7.0, 0.0, "rad");
}
END_TEST

/* One at the end of its range changes nothing; one that hangs is found out by most attitudes. */
START_TEST(a_broken_magnetometer_does_little_harm)
{
    bench_t b = bench(1, insole_attitude_ukf);
    b.phone.gyro_bias = STILL;
    (void)drift_over(&b, 10.0);
    double before = offset_of(&b);
    insole_mag_t stuck = reading(&b);
    for (int i = 0; i < 1000; i++) {
        insole_imu_t imu = phone_sample(&b.phone, d3(0.5, 0.1, 0.3), 20000u);
        ck_assert_int_eq(insole_attitude_push(&b.att, b.method, &imu, 0u), INSOLE_OK);
        stuck.t_us = b.phone.t_us;
        if (_i == 1) {
            stuck.field_ut = insole_vec3(2000, 2000, -2000);
        }
        ck_assert_int_eq(insole_magnetic_push(&b.magnetic, &b.att, b.method, &stuck), INSOLE_OK);
    }
    ASSERT_NEAR(remainder(offset_of(&b) - before, 2.0 * PI) / DEG, 0.0, _i == 1 ? 0.5 : 20.0,
                "degrees");
    ck_assert_uint_gt(b.magnetic.passed, _i == 1 ? 999u : 700u);
}
END_TEST

static insole_magnetic_config_t config;

static insole_status_t judge(void)
{
    insole_magnetic_t magnetic;
    memset(&magnetic, 0x5a, sizeof magnetic);
    insole_magnetic_t before = magnetic;
    insole_status_t status = insole_magnetic_init(&magnetic, &config);
    ck_assert(status == INSOLE_OK || memcmp(&magnetic, &before, sizeof magnetic) == 0);
    return status;
}

START_TEST(settings_have_their_ranges)
{
    config = insole_magnetic_defaults;
    ck_assert_int_eq(config.use, 0);
    INSOLE_MAGNETIC_KEYS(SETTING_HAS_ENDS)
    ck_assert_int_eq(insole_magnetic_check(NULL), INSOLE_ERR_NULL);
    insole_magnetic_t magnetic;
    memset(&magnetic, 0x5a, sizeof magnetic);
    ck_assert_int_eq(insole_magnetic_init(NULL, &config), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(magnetic, insole_magnetic_init(&magnetic, NULL), INSOLE_ERR_NULL);
}
END_TEST

#define REFUSED(call, why)                                                                         \
    do {                                                                                           \
        insole_attitude_t refused_att_ = b.att;                                                    \
        ASSERT_REFUSED(b.magnetic, b.magnetic.refused, call, why);                                 \
        ck_assert_int_eq(memcmp(&refused_att_, &b.att, sizeof b.att), 0);                          \
    } while (0)

START_TEST(bad_readings_are_refused)
{
    bench_t b = bench(1, insole_attitude_ekf);
    insole_magnetic_t *m = &b.magnetic;
    insole_mag_t mag = reading(&b);
    REFUSED(insole_magnetic_push(m, &b.att, b.method, &mag), INSOLE_ERR_STATE);
    walk_for(&b, STILL, 0.1);
    mag = reading(&b);
    REFUSED(insole_magnetic_push(m, &b.att, b.method, &mag), INSOLE_ERR_STATE);
    walk_for(&b, STILL, 2.0);
    mag = reading(&b);
    REFUSED(insole_magnetic_push(m, &b.att, b.method, &mag), INSOLE_ERR_TIME);
    mag.t_us += 150000u;
    REFUSED(insole_magnetic_push(m, &b.att, b.method, &mag), INSOLE_ERR_TIME);
    mag.t_us -= 140000u;
    const insole_mag_t good = mag;
    static const insole_real_t BAD[] = {(insole_real_t)NAN, (insole_real_t)INFINITY, 10001};
    for (int i = 0; i < 3; i++) {
        mag.field_ut.y = BAD[i];
        REFUSED(insole_magnetic_push(m, &b.att, b.method, &mag), INSOLE_ERR_VALUE);
        REFUSED(insole_magnetic_set_field(m, mag.field_ut), INSOLE_ERR_VALUE);
    }
    ck_assert_int_eq(insole_magnetic_set_field(NULL, mag.field_ut), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_magnetic_push(NULL, &b.att, b.method, &good), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(b, insole_magnetic_push(m, NULL, b.method, &good), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(b, insole_magnetic_push(m, &b.att, NULL, &good), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(b, insole_magnetic_push(m, &b.att, b.method, NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_magnetic_push(m, &b.att, b.method, &good), INSOLE_OK);
}
END_TEST

START_TEST(a_copy_goes_on_alike)
{
    bench_t b = bench(1, insole_attitude_ukf);
    walk_for(&b, STILL, 1.5);
    bench_t copy = b;
    walk_for(&b, d3(0.1, 0.0, 0.4), 3.0);
    walk_for(&copy, d3(0.1, 0.0, 0.4), 3.0);
    ck_assert_int_eq(memcmp(&b.magnetic, &copy.magnetic, sizeof b.magnetic), 0);
    ck_assert_int_eq(memcmp(&b.att, &copy.att, sizeof b.att), 0);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("magnetic");
    suite_add_loop(suite, "heading", the_field_holds_the_heading, 2);
    suite_add(suite, "disturbed", what_is_disturbed_is_not_used);
    suite_add(suite, "north", a_told_field_knows_north);
    suite_add(suite, "reference", the_first_readings_are_the_reference);
    suite_add(suite, "azimuth", azimuth_is_that_of_the_level_field);
    suite_add_loop(suite, "broken", a_broken_magnetometer_does_little_harm, 2);
    suite_add(suite, "settings", settings_have_their_ranges);
    suite_add(suite, "readings", bad_readings_are_refused);
    suite_add(suite, "copy", a_copy_goes_on_alike);
    return suite;
}
