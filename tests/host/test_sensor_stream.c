/* SPDX-License-Identifier: MIT */
#include "sensor_stream.h"

#include <math.h>
#include <stdlib.h>

#include "files.h"
#include "near.h"
#include "suite.h"

static failure_t failure;

/* ---- pairing ---------------------------------------------------------------------------- */

static imu_pairer_t pairer;

static void push(record_kind_t kind, int64_t t_us, double x)
{
    record_t record = {kind, t_us, 0u, {x, 2.0 * x, -x, 0.0, 0.0, 0.0}};
    imu_pairer_push(&pairer, &record);
}

static record_t take(void)
{
    record_t imu;
    ck_assert(imu_pairer_take(&pairer, &imu));
    ck_assert_int_eq(imu.kind, RECORD_IMU);
    return imu;
}

static void expect_none(void)
{
    record_t imu;
    ck_assert(!imu_pairer_take(&pairer, &imu));
}

START_TEST(turn_rates_get_the_force_interpolated)
{
    imu_pairer_init(&pairer);
    push(RECORD_ACC, 0, 10.0);
    push(RECORD_GYR, 5000, 1.0);
    push(RECORD_GYR, 15000, 2.0);
    expect_none();
    push(RECORD_ACC, 20000, 30.0);
    record_t imu = take();
    ck_assert_int_eq(imu.t_us, 5000);
    ASSERT_NEAR(imu.value[0], 15.0, 1e-12, "m/s^2");
    ASSERT_NEAR(imu.value[1], 30.0, 1e-12, "m/s^2");
    ASSERT_NEAR(imu.value[2], -15.0, 1e-12, "m/s^2");
    ck_assert(imu.value[3] == 1.0 && imu.value[4] == 2.0 && imu.value[5] == -1.0);
    imu = take();
    ck_assert_int_eq(imu.t_us, 15000);
    ASSERT_NEAR(imu.value[0], 25.0, 1e-12, "m/s^2");
    expect_none();
}
END_TEST

START_TEST(a_straight_line_of_force_survives_any_two_rates)
{
    int64_t accel_us = 0, gyro_us = 3000;
    int taken = 0;
    imu_pairer_init(&pairer);
    while (gyro_us < 2000000) {
        record_t imu;
        if (accel_us <= gyro_us) {
            push(RECORD_ACC, accel_us, 1e-6 * (double)accel_us);
            accel_us += 9000;
        } else {
            push(RECORD_GYR, gyro_us, 0.5);
            gyro_us += 5000;
        }
        while (imu_pairer_take(&pairer, &imu)) {
            ASSERT_NEAR(imu.value[0], 1e-6 * (double)imu.t_us, 1e-12, "m/s^2");
            taken++;
        }
    }
    ck_assert_int_ge(taken, 397);
}
END_TEST

START_TEST(equal_times_pair_at_once)
{
    imu_pairer_init(&pairer);
    push(RECORD_ACC, 0, 9.0);
    push(RECORD_GYR, 0, 1.0);
    ck_assert(take().value[0] == 9.0);
    push(RECORD_GYR, 10000, 1.0);
    push(RECORD_ACC, 10000, 8.0);
    ck_assert(take().value[0] == 8.0);
}
END_TEST

START_TEST(a_force_that_lags_is_held_and_then_unknown)
{
    imu_pairer_init(&pairer);
    push(RECORD_ACC, 0, 9.0);
    for (int64_t t_us = 10000; t_us <= 300000; t_us += 10000) {
        record_t imu;
        push(RECORD_GYR, t_us, 1.0);
        while (imu_pairer_take(&pairer, &imu)) {
            ck_assert_int_gt(t_us - imu.t_us, PAIRER_WAIT_US);
            ck_assert(imu.t_us <= PAIRER_HOLD_US ? imu.value[0] == 9.0 : isnan(imu.value[0]));
        }
    }
    ck_assert_uint_eq(insole_ring_count(&pairer.waiting), 4u);
}
END_TEST

START_TEST(a_gap_of_the_force_is_not_interpolated)
{
    record_t imu;
    imu_pairer_init(&pairer);
    push(RECORD_ACC, 0, 9.0);
    push(RECORD_GYR, 150000, 1.0);
    push(RECORD_ACC, 250000, 9.0);
    ck_assert(isnan(take().value[0]));
    push(RECORD_GYR, 245000, 1.0);
    ck_assert(imu_pairer_take(&pairer, &imu));
    ck_assert(imu.value[0] == 9.0);
}
END_TEST

START_TEST(what_waits_at_the_end_is_given_out)
{
    imu_pairer_init(&pairer);
    push(RECORD_ACC, 0, 9.0);
    push(RECORD_GYR, 10000, 1.0);
    push(RECORD_GYR, 20000, 1.0);
    expect_none();
    imu_pairer_finish(&pairer);
    ck_assert(take().value[0] == 9.0);
    ck_assert(take().t_us == 20000);
    expect_none();
}
END_TEST

START_TEST(turn_rates_alone_do_not_fill_the_memory)
{
    record_t imu;
    int taken = 0;
    imu_pairer_init(&pairer);
    for (int i = 0; i < 10000; i++) {
        push(RECORD_GYR, 10, 1.0); /* time stands still: nothing ever is late */
        while (imu_pairer_take(&pairer, &imu)) {
            ck_assert(isnan(imu.value[0]) && imu.value[3] == 1.0);
            taken++;
        }
    }
    ck_assert_int_ge(taken, 10000 - PAIRER_ROOM);
}
END_TEST

/* ---- units ------------------------------------------------------------------------------ */

static units_t units;

/* Feeds readings of a resting and then turning sensor. @return readings taken before a refusal */
static int feed(double gravity, double turn_rate, int count)
{
    for (int i = 0; i < count; i++) {
        record_t imu = {RECORD_IMU, 5000 * i, 0u, {0.1, 0.0, gravity, 0.0, turn_rate, 0.0}};
        if (!units_apply(&units, &imu, &failure)) {
            return i;
        }
    }
    return count;
}

START_TEST(units_are_converted_as_told)
{
    record_t imu = {RECORD_IMU, 0, 0u, {0.5, 0.0, 1.0, 180.0, -90.0, 0.0}};
    ck_assert(units_init(&units, "g", "dps", &failure));
    ck_assert(units_apply(&units, &imu, &failure));
    ASSERT_NEAR(imu.value[0], 4.903325, 1e-9, "m/s^2");
    ASSERT_NEAR(imu.value[2], 9.80665, 1e-9, "m/s^2");
    ASSERT_NEAR(imu.value[3], 3.14159265358979, 1e-9, "rad/s");
    ASSERT_NEAR(imu.value[4], -1.570796326794897, 1e-9, "rad/s");
    record_t acc = {RECORD_ACC, 0, 0u, {1000.0, 0.0, 0.0, 7.0, 0.0, 0.0}};
    ck_assert(units_init(&units, "mg", NULL, &failure));
    ck_assert(units_apply(&units, &acc, &failure));
    ASSERT_NEAR(acc.value[0], 9.80665, 1e-9, "m/s^2");
    ck_assert(acc.value[3] == 7.0);
}
END_TEST

static const struct {
    const char *unit;
    double gravity;
    const char *message; /* NULL: taken */
} accel_cases[] = {
    {NULL, 9.81, NULL},
    {"mps2", 9.4, NULL},
    {"g", 1.02, NULL},
    {"mg", 990.0, NULL},
    {NULL, 3.0, NULL}, /* no unit reads this at rest: not for us to say */
    {NULL, 0.99, "insole: the accelerometer looks like g (median of |a| is 0.995038): use "
                 "--accel-unit g"},
    {NULL, 1000.0,
     "insole: the accelerometer looks like mg (median of |a| is 1000): use --accel-unit mg"},
    {"g", 9.8,
     "insole: the accelerometer looks like mps2 (median of |a| is 9.80051): use --accel-unit mps2"},
    {"g", 1000.0,
     "insole: the accelerometer looks like mg (median of |a| is 1000): use --accel-unit mg"}};

START_TEST(wrong_units_of_the_accelerometer_are_told)
{
    ck_assert(units_init(&units, accel_cases[_i].unit, NULL, &failure));
    int taken = feed(accel_cases[_i].gravity, 0.0, 1000);
    if (accel_cases[_i].message == NULL) {
        ck_assert_int_eq(taken, 1000);
        return;
    }
    ck_assert_int_eq(taken, UNITS_READINGS - 1);
    ck_assert_int_eq(failure.exit_code, EXIT_BAD_INPUT);
    ck_assert_str_eq(failure.text, accel_cases[_i].message);
}
END_TEST

START_TEST(a_short_log_is_judged_at_its_end)
{
    ck_assert(units_init(&units, NULL, NULL, &failure));
    ck_assert_int_eq(feed(1.0, 0.0, 30), 30);
    ck_assert(!units_finish(&units, &failure));
    ck_assert_ptr_nonnull(strstr(failure.text, "--accel-unit g"));
    ck_assert(units_init(&units, NULL, NULL, &failure));
    feed(1.0, 0.0, 5);
    ck_assert(units_finish(&units, &failure)); /* too few to say */
}
END_TEST

START_TEST(degrees_per_second_are_told)
{
    ck_assert(units_init(&units, NULL, NULL, &failure));
    ck_assert_int_eq(feed(9.8, 0.2, 2000), 2000);
    int taken = feed(9.8, 200.0, 2000);
    ck_assert_int_lt(taken, 60); /* 0.3 s of walking */
    ck_assert_str_eq(failure.text, "insole: the gyroscope looks like degrees per second (it keeps "
                                   "beyond 40 rad/s): use --gyro-unit dps");
    ck_assert(units_init(&units, NULL, "dps", &failure));
    ck_assert_int_eq(feed(9.8, 200.0, 2000), 2000);
}
END_TEST

START_TEST(spikes_are_no_unit)
{
    ck_assert(units_init(&units, NULL, NULL, &failure));
    for (int i = 0; i < 500; i++) {
        ck_assert_int_eq(feed(i % 3 == 0 ? 500.0 : 9.8, 5.0, 9), 9);
        ck_assert_int_eq(feed(9.8, 1e6, 1), 1);
    }
    record_t silent = {RECORD_IMU, 0, 0u, {0.0, 0.0, 9.8, 0.0, 0.0, 0.0}};
    silent.value[0] = (double)NAN;
    silent.value[3] = (double)NAN;
    for (int i = 0; i < 1000; i++) {
        record_t record = silent;
        ck_assert(units_apply(&units, &record, &failure));
    }
}
END_TEST

START_TEST(unknown_units_are_wrong_usage)
{
    ck_assert(!units_init(&units, "ft", NULL, &failure));
    ck_assert_int_eq(failure.exit_code, EXIT_WRONG_USAGE);
    ck_assert_str_eq(failure.text, "insole: --accel-unit ft: expected mps2, g or mg");
    ck_assert(!units_init(&units, NULL, "rpm", &failure));
    ck_assert_str_eq(failure.text, "insole: --gyro-unit rpm: expected radps or dps");
}
END_TEST

/* ---- the whole stream ------------------------------------------------------------------- */

static sensor_stream_t stream;

/* Opens one log of this text. */
static void open_text(const char *text)
{
    const char *const path = scratch_file("stream.csv", text);
    ck_assert_msg(sensor_stream_open(&stream, &path, 1u, NULL, NULL, &failure), "%s",
                  failure.text);
}

static read_t run_to_end(int counts[RECORD_KINDS])
{
    record_t record;
    read_t answer;
    memset(counts, 0, RECORD_KINDS * sizeof counts[0]);
    while ((answer = sensor_stream_next(&stream, &record, &failure)) == READ_ONE) {
        counts[record.kind]++;
    }
    sensor_stream_close(&stream);
    return answer;
}

START_TEST(apart_readings_come_out_together)
{
    int counts[RECORD_KINDS];
    open_text("start,0,1,2\nacc,0,0,0,9\ngyr,0.005,0,0,1\nacc,0.01,0,0,9\ngyr,0.015,0,0,1\n"
              "mag,0.016,1,2,3\ntruth,0.02,1,2\n");
    ck_assert_int_eq(run_to_end(counts), READ_END);
    ck_assert_int_eq(counts[RECORD_IMU], 2);
    ck_assert_int_eq(counts[RECORD_ACC] + counts[RECORD_GYR], 0);
    ck_assert_int_eq(counts[RECORD_START] + counts[RECORD_MAG] + counts[RECORD_TRUTH], 3);
    ck_assert_uint_eq(stream.seen[RECORD_ACC], 2u);
    ck_assert_uint_eq(stream.seen[RECORD_GYR], 2u);
}
END_TEST

static const struct {
    const char *text, *message;
} hopeless[] = {
    {"", "no imu record in the session: expected imu,t,ax,ay,az,gx,gy,gz"},
    {"truth,0,1,2\n", "no imu record in the session: expected imu,t,ax,ay,az,gx,gy,gz"},
    {"acc,0,0,0,9\n", "no gyr record in the session: expected both acc and gyr"},
    {"gyr,0,0,0,9\n", "no acc record in the session: expected both acc and gyr"},
    {"imu,0,0,0,9,0,0,0\nacc,0,0,0,9\n",
     "the session holds imu records as well as acc or gyr records: expected one or the other"}};

START_TEST(sessions_without_readings_are_refused)
{
    int counts[RECORD_KINDS];
    char expected[700];
    open_text(hopeless[_i].text);
    ck_assert_int_eq(run_to_end(counts), READ_FAILED);
    snprintf(expected, sizeof expected, "%s/stream.csv: %s", SCRATCH, hopeless[_i].message);
    ck_assert_str_eq(failure.text, expected);
    ck_assert_int_eq(failure.exit_code, EXIT_BAD_INPUT);
}
END_TEST

#define ROWS(table) ((int)(sizeof table / sizeof table[0]))

Suite *insole_suite(void)
{
    Suite *suite = suite_create("sensor_stream");
    suite_add(suite, "interpolated", turn_rates_get_the_force_interpolated);
    suite_add(suite, "rates", a_straight_line_of_force_survives_any_two_rates);
    suite_add(suite, "equal times", equal_times_pair_at_once);
    suite_add(suite, "lag", a_force_that_lags_is_held_and_then_unknown);
    suite_add(suite, "gap", a_gap_of_the_force_is_not_interpolated);
    suite_add(suite, "end", what_waits_at_the_end_is_given_out);
    suite_add(suite, "bounded", turn_rates_alone_do_not_fill_the_memory);
    suite_add(suite, "conversion", units_are_converted_as_told);
    suite_add_loop(suite, "accelerometer", wrong_units_of_the_accelerometer_are_told,
                   ROWS(accel_cases));
    suite_add(suite, "short", a_short_log_is_judged_at_its_end);
    suite_add(suite, "gyroscope", degrees_per_second_are_told);
    suite_add(suite, "spikes", spikes_are_no_unit);
    suite_add(suite, "usage", unknown_units_are_wrong_usage);
    suite_add(suite, "stream", apart_readings_come_out_together);
    suite_add_loop(suite, "hopeless", sessions_without_readings_are_refused, ROWS(hopeless));
    return suite;
}
