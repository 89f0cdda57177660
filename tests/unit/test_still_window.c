/* SPDX-License-Identifier: MIT */
#include "insole/sense/still_window.h"

#include "near.h"
#include "refusal.h"
#include "sample.h"
#include "suite.h"

enum { STREAM = 400 };

static const insole_still_scale_t SCALE = {INSOLE_STILL_SHOE, INSOLE_R(9.81), INSOLE_R(0.01),
                                           INSOLE_R(0.0017)};

typedef struct {
    insole_vec3_t accel, gyro;
} reading_t;

static insole_still_window_t opened(insole_still_kind_t kind, uint32_t width)
{
    insole_still_window_t window;
    insole_still_scale_t scale = SCALE;
    scale.kind = kind;
    ck_assert_int_eq(insole_still_window_init(&window, &scale, width), INSOLE_OK);
    return window;
}

/* A foot's day: rest, swings, and now and then a blow. */
static reading_t random_reading(insole_rng_t *rng)
{
    insole_real_t what = insole_rng_uniform(rng);
    bool moving = what > INSOLE_R(0.4), blow = what > INSOLE_R(0.99);
    insole_real_t size = blow ? INSOLE_R(900.0) : moving ? INSOLE_R(25.0) : INSOLE_R(0.05);
    reading_t r;
    r.accel = insole_vec3_add(sample_vec3(rng, size), insole_vec3(1, -2, INSOLE_R(9.5)));
    r.gyro = sample_vec3(rng, moving ? INSOLE_R(8.0) : INSOLE_R(0.01));
    return r;
}

static double norm2(insole_vec3_t v)
{
    return (double)v.x * (double)v.x + (double)v.y * (double)v.y + (double)v.z * (double)v.z;
}

/* The formulas of the header, sample by sample. */
static double direct(insole_still_kind_t kind, const reading_t *r, uint32_t width)
{
    double g = (double)SCALE.gravity_mps2, sx = 0.0, sy = 0.0, sz = 0.0;
    double accel2 = 0.0, norm = 0.0, gyro2 = 0.0;
    for (uint32_t i = 0; i < width; i++) {
        sx += (double)r[i].accel.x / width;
        sy += (double)r[i].accel.y / width;
        sz += (double)r[i].accel.z / width;
        accel2 += norm2(r[i].accel) / width;
        norm += sqrt(norm2(r[i].accel)) / width;
        gyro2 += norm2(r[i].gyro) / width;
    }
    double mean2 = sx * sx + sy * sy + sz * sz;
    double per_a = 1.0 / ((double)SCALE.sigma_accel_mps2 * (double)SCALE.sigma_accel_mps2);
    double per_w = 1.0 / ((double)SCALE.sigma_gyro_radps * (double)SCALE.sigma_gyro_radps);
    switch (kind) {
    case INSOLE_STILL_MV:
        return (accel2 - mean2) * per_a;
    case INSOLE_STILL_MAG:
        return (accel2 - 2.0 * g * norm + g * g) * per_a;
    case INSOLE_STILL_ARE:
        return gyro2 * per_w;
    default:
        return (accel2 - 2.0 * g * sqrt(mean2) + g * g) * per_a + gyro2 * per_w;
    }
}

/* Rounding of running sums: some ulps of the largest term of the last two windows. */
static double rounding(const reading_t *newest, uint32_t width)
{
    double largest = 0.0;
    for (uint32_t i = 0; i < 2u * width; i++) {
        double a = sqrt(norm2((newest - i)->accel)) + (double)SCALE.gravity_mps2;
        double accel = a * a / ((double)SCALE.sigma_accel_mps2 * (double)SCALE.sigma_accel_mps2);
        double gyro = norm2((newest - i)->gyro) /
                      ((double)SCALE.sigma_gyro_radps * (double)SCALE.sigma_gyro_radps);
        largest = fmax(largest, fmax(accel, gyro));
    }
    return 30.0 * (double)INSOLE_REAL_EPSILON * largest;
}

START_TEST(statistics_agree_with_their_formulas)
{
    insole_still_kind_t kind = (insole_still_kind_t)(_i % 4);
    uint32_t width = (uint32_t)(_i / 4 + 1);
    insole_still_window_t window = opened(kind, width);
    reading_t stream[STREAM];
    insole_rng_t rng;
    insole_rng_seed(&rng, (uint64_t)_i);
    worst_t off = {0.0, 0.0};
    for (uint32_t i = 0; i < STREAM; i++) {
        insole_real_t statistic = INSOLE_R(-7.0);
        stream[i] = random_reading(&rng);
        insole_status_t status =
            insole_still_window_push(&window, stream[i].accel, stream[i].gyro, &statistic);
        worst_require(&off, status == (i + 1u < width ? INSOLE_ERR_STATE : INSOLE_OK), i);
        worst_require(&off, status == INSOLE_OK || statistic == INSOLE_R(-7.0), i);
        if (i + 1u >= 2u * width) {
            double exact = direct(kind, &stream[i + 1u - width], width);
            worst_note(&off, fabs((double)statistic - exact) / rounding(&stream[i], width), i);
        }
    }
    ASSERT_WORST(off, 1.0, "of what rounding explains");
}
END_TEST

/* A day of samples leaves no trace: the last windows are as good as the first. */
START_TEST(sums_do_not_drift)
{
    enum { WIDTH = 7, KEPT = 2 * WIDTH, SAMPLES = 1000000 };
    insole_still_window_t window = opened((insole_still_kind_t)_i, WIDTH);
    reading_t kept[KEPT];
    insole_rng_t rng;
    insole_rng_seed(&rng, 3u);
    worst_t off = {0.0, 0.0};
    for (int i = 0; i < SAMPLES; i++) {
        insole_real_t statistic;
        reading_t r = random_reading(&rng);
        insole_still_window_push(&window, r.accel, r.gyro, &statistic);
        if (i % 10000 >= 10000 - KEPT) {
            kept[i % 10000 - (10000 - KEPT)] = r;
        }
        if (i % 10000 == 9999) {
            double exact = direct((insole_still_kind_t)_i, &kept[KEPT - WIDTH], WIDTH);
            worst_note(&off, fabs((double)statistic - exact) / rounding(&kept[KEPT - 1], WIDTH), i);
        }
    }
    ASSERT_WORST(off, 1.0, "of what rounding explains");
}
END_TEST

/* By hand: |a| = 10 and 9.5, the same direction; |w| = 0.1 and 0.3. */
START_TEST(values_by_hand)
{
    insole_still_scale_t scale = {(insole_still_kind_t)_i, INSOLE_R(9.81), INSOLE_R(0.01),
                                  INSOLE_R(0.01)};
    insole_still_window_t window;
    ck_assert_int_eq(insole_still_window_init(&window, &scale, 2u), INSOLE_OK);
    insole_real_t statistic;
    insole_still_window_push(&window, insole_vec3(6, 0, 8), insole_vec3(0, INSOLE_R(0.1), 0),
                             &statistic);
    insole_still_window_push(&window, insole_vec3(INSOLE_R(5.7), 0, INSOLE_R(7.6)),
                             insole_vec3(INSOLE_R(0.3), 0, 0), &statistic);
    double variance = 625.0; /* 0.25^2 / 0.01^2 */
    double spread = (0.19 * 0.19 + 0.31 * 0.31) / 2.0 * 1.0e4;
    double gyro = (0.01 + 0.09) / 2.0 * 1.0e4;
    const double expected[] = {spread + gyro, variance, spread, gyro};
    ASSERT_NEAR(statistic, expected[_i], 4.0e6 * (double)INSOLE_REAL_EPSILON, "");
}
END_TEST

START_TEST(mounting_does_not_matter)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 8u);
    insole_quat_t turn = sample_quat(&rng);
    insole_still_window_t plain = opened((insole_still_kind_t)_i, 7u), turned = plain;
    worst_t off = {0.0, 0.0};
    reading_t stream[STREAM];
    for (int i = 0; i < STREAM; i++) {
        insole_real_t a = 0, b = 0;
        reading_t r = stream[i] = random_reading(&rng);
        insole_still_window_push(&plain, r.accel, r.gyro, &a);
        insole_still_window_push(&turned, insole_quat_rotate(turn, r.accel),
                                 insole_quat_rotate(turn, r.gyro), &b);
        if (i > 14) {
            worst_note(&off, fabs((double)(a - b)) / rounding(&stream[i], 7u), i);
        }
    }
    ASSERT_WORST(off, 2.0, "of what rounding explains");
}
END_TEST

START_TEST(bad_settings_are_refused)
{
    insole_still_window_t window;
    memset(&window, 0x5a, sizeof window);
    ck_assert_int_eq(insole_still_window_init(NULL, &SCALE, 3u), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(window, insole_still_window_init(&window, NULL, 3u), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(window, insole_still_window_init(&window, &SCALE, 0u), INSOLE_ERR_VALUE);
    ASSERT_UNCHANGED(window, insole_still_window_init(&window, &SCALE, 16u), INSOLE_ERR_VALUE);
    static const insole_real_t BAD[] = {0, -1, (double)NAN, (double)INFINITY};
    for (int i = 0; i < 12; i++) {
        insole_still_scale_t scale = SCALE;
        insole_real_t *member[] = {&scale.gravity_mps2, &scale.sigma_accel_mps2,
                                   &scale.sigma_gyro_radps};
        *member[i % 3] = BAD[i / 3];
        ASSERT_UNCHANGED(window, insole_still_window_init(&window, &scale, 3u), INSOLE_ERR_VALUE);
    }
}
END_TEST

START_TEST(bad_samples_are_refused)
{
    insole_still_window_t window = opened(INSOLE_STILL_SHOE, 3u);
    insole_vec3_t one = insole_vec3(1, 1, 1);
    insole_real_t statistic = INSOLE_R(-7.0);
    for (int i = 0; i < 5; i++) {
        insole_still_window_push(&window, one, one, &statistic);
    }
    insole_real_t before = statistic;
    ck_assert_int_eq(insole_still_window_push(NULL, one, one, &statistic), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(window, insole_still_window_push(&window, one, one, NULL), INSOLE_ERR_NULL);
    const insole_vec3_t bad[] = {insole_vec3((double)NAN, 1, 1),
                                 insole_vec3(1, (double)INFINITY, 1),
                                 insole_vec3(1, 1, -(double)INFINITY)};
    for (int i = 0; i < 3; i++) {
        ASSERT_UNCHANGED(window, insole_still_window_push(&window, bad[i], one, &statistic),
                         INSOLE_ERR_VALUE);
        ASSERT_UNCHANGED(window, insole_still_window_push(&window, one, bad[i], &statistic),
                         INSOLE_ERR_VALUE);
    }
    ck_assert(statistic == before);
}
END_TEST

START_TEST(what_is_known_to_be_finite_is_taken_alike)
{
    insole_still_window_t pushed = opened((insole_still_kind_t)_i, 7u), taken = pushed;
    insole_rng_t rng;
    insole_rng_seed(&rng, 4u);
    for (int i = 0; i < STREAM; i++) {
        reading_t r = random_reading(&rng);
        insole_real_t a;
        insole_status_t status = insole_still_window_push(&pushed, r.accel, r.gyro, &a);
        insole_real_t b = insole_still_window_take(&taken, &r.accel, &r.gyro);
        ck_assert_int_eq(status == INSOLE_OK, taken.full);
        ck_assert(status != INSOLE_OK || a == b);
        ck_assert_int_eq(memcmp(&pushed, &taken, sizeof pushed), 0);
    }
}
END_TEST

START_TEST(a_copy_goes_on_alike)
{
    insole_still_window_t window = opened(INSOLE_STILL_SHOE, 9u);
    insole_rng_t rng;
    insole_rng_seed(&rng, 5u);
    insole_real_t a = 0, b = 0;
    for (int i = 0; i < 31; i++) {
        reading_t r = random_reading(&rng);
        insole_still_window_push(&window, r.accel, r.gyro, &a);
    }
    insole_still_window_t copy = window;
    for (int i = 0; i < 50; i++) {
        reading_t r = random_reading(&rng);
        insole_still_window_push(&window, r.accel, r.gyro, &a);
        insole_still_window_push(&copy, r.accel, r.gyro, &b);
        ck_assert(a == b);
    }
    ck_assert_int_eq(memcmp(&window, &copy, sizeof window), 0);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("still_window");
    suite_add_loop(suite, "formulas", statistics_agree_with_their_formulas,
                   4 * INSOLE_STILL_WINDOW);
    suite_add_loop(suite, "no drift", sums_do_not_drift, 4);
    suite_add_loop(suite, "by hand", values_by_hand, 4);
    suite_add_loop(suite, "mounting", mounting_does_not_matter, 4);
    suite_add(suite, "settings", bad_settings_are_refused);
    suite_add(suite, "samples", bad_samples_are_refused);
    suite_add_loop(suite, "unchecked", what_is_known_to_be_finite_is_taken_alike, 4);
    suite_add(suite, "copy", a_copy_goes_on_alike);
    return suite;
}
