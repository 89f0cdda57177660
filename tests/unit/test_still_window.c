/* SPDX-License-Identifier: MIT */
#include "insole/sense/still_window.h"

#include <string.h>

#include "near.h"
#include "sample.h"
#include "suite.h"

enum { LONG_RUN = 1000000 };

static const insole_still_scale_t SCALE = {INSOLE_STILL_SHOE, INSOLE_R(9.81), INSOLE_R(0.01),
                                           INSOLE_R(0.00174533)};

/* The last samples, kept plainly, and the formulas over them in double. */
typedef struct {
    double accel[INSOLE_STILL_WINDOW][3], gyro[INSOLE_STILL_WINDOW][3];
    uint32_t width, count;
} plain_window_t;

static void plain_push(plain_window_t *w, insole_vec3_t a, insole_vec3_t g)
{
    if (w->count == w->width) {
        memmove(w->accel[0], w->accel[1], (w->width - 1u) * sizeof w->accel[0]);
        memmove(w->gyro[0], w->gyro[1], (w->width - 1u) * sizeof w->gyro[0]);
        w->count--;
    }
    double *at = w->accel[w->count], *rate = w->gyro[w->count];
    at[0] = (double)a.x, at[1] = (double)a.y, at[2] = (double)a.z;
    rate[0] = (double)g.x, rate[1] = (double)g.y, rate[2] = (double)g.z;
    w->count++;
}

static double norm2(const double v[3])
{
    return v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
}

static double plain_statistic(const plain_window_t *w, const insole_still_scale_t *scale)
{
    double mean[3] = {0.0, 0.0, 0.0}, accel2 = 0.0, norm = 0.0, gyro2 = 0.0, n = (double)w->count;
    for (uint32_t i = 0u; i < w->count; i++) {
        for (int k = 0; k < 3; k++) {
            mean[k] += w->accel[i][k] / n;
        }
        accel2 += norm2(w->accel[i]) / n;
        norm += sqrt(norm2(w->accel[i])) / n;
        gyro2 += norm2(w->gyro[i]) / n;
    }
    double g = (double)scale->gravity_mps2, sa = (double)scale->sigma_accel_mps2;
    double are = gyro2 / ((double)scale->sigma_gyro_radps * (double)scale->sigma_gyro_radps);
    switch (scale->kind) {
    case INSOLE_STILL_MV:
        return (accel2 - norm2(mean)) / (sa * sa);
    case INSOLE_STILL_MAG:
        return (accel2 - 2.0 * g * norm + g * g) / (sa * sa);
    case INSOLE_STILL_ARE:
        return are;
    default:
        return (accel2 - 2.0 * g * sqrt(norm2(mean)) + g * g) / (sa * sa) + are;
    }
}

/* What rounding of |a|^2, at most the squares of the window, leaves in the statistic. */
static double rounding(const plain_window_t *w, const insole_still_scale_t *scale)
{
    double largest = 0.0, sa = (double)scale->sigma_accel_mps2;
    for (uint32_t i = 0u; i < w->count; i++) {
        largest = fmax(largest, norm2(w->accel[i]));
    }
    return 40.0 * (double)INSOLE_REAL_EPSILON * (largest + 200.0) / (sa * sa) + 1e-3;
}

static insole_vec3_t resting(insole_rng_t *rng, insole_real_t shake)
{
    insole_vec3_t up = insole_vec3(INSOLE_R(2.0), INSOLE_R(-3.0), INSOLE_R(9.1));
    return insole_vec3_add(up, sample_vec3(rng, shake));
}

/* Every kind at every width against the plain window, calm and violent in turn. */
START_TEST(statistics_are_those_of_the_formulas)
{
    insole_still_scale_t scale = SCALE;
    scale.kind = (insole_still_kind_t)(_i % 4);
    plain_window_t plain = {{{0.0}}, {{0.0}}, 1u + (uint32_t)(_i / 4), 0u};
    insole_still_window_t window;
    insole_rng_t rng;
    insole_rng_seed(&rng, (uint64_t)_i);
    ck_assert_int_eq(insole_still_window_init(&window, &scale, plain.width), INSOLE_OK);
    worst_t worst = {0.0, 0.0}, full = {0.0, 0.0};
    for (int i = 0; i < 2000; i++) {
        insole_real_t shake = i / 100 % 2 == 0 ? INSOLE_R(0.05) : INSOLE_R(40.0);
        insole_vec3_t a = resting(&rng, shake), g = sample_vec3(&rng, shake * INSOLE_R(0.1));
        insole_real_t statistic = INSOLE_R(-1.0);
        insole_status_t status = insole_still_window_push(&window, a, g, &statistic);
        plain_push(&plain, a, g);
        worst_require(&full, (status == INSOLE_OK) == (plain.count == plain.width), i);
        if (status == INSOLE_OK) {
            double expected = plain_statistic(&plain, &scale);
            double tolerance = rounding(&plain, &scale) + 1e-4 * fabs(expected);
            worst_note(&worst, fabs((double)statistic - expected) / tolerance, i);
        }
    }
    ASSERT_ALL_HELD(full);
    ASSERT_WORST(worst, 1.0, "of the tolerance");
}
END_TEST

/* After a million shocks a rest reads as still as at the start. */
START_TEST(rounding_does_not_gather)
{
    insole_still_window_t window, young;
    insole_rng_t rng;
    insole_rng_seed(&rng, 7u);
    insole_still_window_init(&window, &SCALE, 7u);
    insole_still_window_init(&young, &SCALE, 7u);
    insole_real_t old_statistic = INSOLE_R(0.0), young_statistic = INSOLE_R(0.0);
    for (int i = 0; i < LONG_RUN; i++) {
        insole_still_window_push(&window, resting(&rng, INSOLE_R(150.0)),
                                 sample_vec3(&rng, INSOLE_R(30.0)), &old_statistic);
    }
    for (int i = 0; i < 14; i++) {
        insole_vec3_t a = resting(&rng, INSOLE_R(0.01)), g = sample_vec3(&rng, INSOLE_R(0.001));
        insole_still_window_push(&window, a, g, &old_statistic);
        insole_still_window_push(&young, a, g, &young_statistic);
    }
    ASSERT_NEAR(old_statistic, young_statistic, 3.0, "");
    ASSERT_AT_MOST(old_statistic, 1.0e4, "");
}
END_TEST

START_TEST(turning_the_sensor_changes_nothing)
{
    insole_still_window_t window, turned;
    insole_rng_t rng;
    insole_rng_seed(&rng, 3u);
    insole_quat_t q = sample_quat(&rng);
    insole_still_window_init(&window, &SCALE, 5u);
    insole_still_window_init(&turned, &SCALE, 5u);
    worst_t worst = {0.0, 0.0};
    for (int i = 0; i < 500; i++) {
        insole_vec3_t a = resting(&rng, INSOLE_R(3.0)), g = sample_vec3(&rng, INSOLE_R(2.0));
        insole_real_t one = INSOLE_R(0.0), other = INSOLE_R(0.0);
        insole_still_window_push(&window, a, g, &one);
        insole_still_window_push(&turned, insole_quat_rotate(q, a), insole_quat_rotate(q, g),
                                 &other);
        worst_note(&worst, fabs((double)(one - other)) / (1e-4 * (double)one + 3.0), i);
    }
    ASSERT_WORST(worst, 1.0, "of the tolerance");
}
END_TEST

START_TEST(bad_settings_are_refused)
{
    insole_still_window_t window;
    insole_still_scale_t bad[6] = {SCALE, SCALE, SCALE, SCALE, SCALE, SCALE};
    bad[0].gravity_mps2 = INSOLE_R(0.0);
    bad[1].sigma_accel_mps2 = INSOLE_R(-1.0);
    bad[2].sigma_gyro_radps = INSOLE_R(0.0);
    bad[3].gravity_mps2 = (insole_real_t)NAN;
    bad[4].sigma_accel_mps2 = (insole_real_t)INFINITY;
    bad[5].sigma_gyro_radps = (insole_real_t)NAN;
    for (int i = 0; i < 6; i++) {
        ck_assert_int_eq(insole_still_window_init(&window, &bad[i], 7u), INSOLE_ERR_VALUE);
    }
    ck_assert_int_eq(insole_still_window_init(&window, &SCALE, 0u), INSOLE_ERR_VALUE);
    ck_assert_int_eq(insole_still_window_init(&window, &SCALE, INSOLE_STILL_WINDOW + 1u),
                     INSOLE_ERR_VALUE);
    ck_assert_int_eq(insole_still_window_init(NULL, &SCALE, 7u), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_still_window_init(&window, NULL, 7u), INSOLE_ERR_NULL);
}
END_TEST

START_TEST(a_refused_sample_leaves_no_trace)
{
    insole_still_window_t window, before;
    insole_real_t statistic = INSOLE_R(5.0);
    insole_vec3_t fine = insole_vec3(INSOLE_R(0.0), INSOLE_R(0.0), INSOLE_R(9.81)), bad = fine;
    bad.y = (insole_real_t)NAN;
    memset(&window, 0, sizeof window);
    insole_still_window_init(&window, &SCALE, 3u);
    insole_still_window_push(&window, fine, fine, &statistic);
    memcpy(&before, &window, sizeof window);
    ck_assert_int_eq(insole_still_window_push(&window, bad, fine, &statistic), INSOLE_ERR_VALUE);
    ck_assert_int_eq(insole_still_window_push(&window, fine, bad, &statistic), INSOLE_ERR_VALUE);
    ck_assert_int_eq(insole_still_window_push(&window, fine, fine, NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_still_window_push(NULL, fine, fine, &statistic), INSOLE_ERR_NULL);
    ck_assert_mem_eq(&before, &window, sizeof window);
    ASSERT_NEAR(statistic, 5.0, 0.0, "");
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("still_window");
    suite_add_loop(suite, "formulas", statistics_are_those_of_the_formulas,
                   4 * INSOLE_STILL_WINDOW);
    suite_add(suite, "no drift", rounding_does_not_gather);
    suite_add(suite, "any mounting", turning_the_sensor_changes_nothing);
    suite_add(suite, "settings", bad_settings_are_refused);
    suite_add(suite, "refusals", a_refused_sample_leaves_no_trace);
    return suite;
}
