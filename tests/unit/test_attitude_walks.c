/* SPDX-License-Identifier: MIT */
/* Recorded walks: the heading along each leg against the direction from waypoint to waypoint. What
 * is wrong with the phone in the hand or the walker beside the line counts as well: the limits are
 * wide, the numbers are printed. */
#include "insole/move/attitude.h"
#include "insole/move/attitude_ekf.h"
#include "insole/move/attitude_ukf.h"
#include "insole/move/heading.h"
#include "insole/sense/still_bias.h"
#include "mall.h"
#include "near.h"
#include "suite.h"

#define PI  3.14159265358979323846
#define DEG (PI / 180.0)

enum { METHODS = 3, MOST_LEGS = 2000 };

static const char *const NAMES[METHODS] = {"gyro", "ekf", "ukf"};
static insole_attitude_method_t *const METHOD[METHODS] = {NULL, insole_attitude_ekf,
                                                          insole_attitude_ukf};

/* Sums over the inner part of each leg, where nobody turns. */
typedef struct {
    double begin_s, end_s, direction, length_m;
    double cos[METHODS], sin[METHODS];
} leg_t;

typedef struct {
    double errors_deg[METHODS][MOST_LEGS];
    int legs, walks;
    double apart_deg; /* largest difference of the filters' headings */
    uint32_t upsets;
} results_t;

static int legs_of(const mall_waypoint_t *points, int n, leg_t legs[MALL_WAYPOINTS])
{
    int count = 0;
    for (int i = 0; i + 1 < n; i++) {
        const mall_waypoint_t *a = &points[i], *b = &points[i + 1];
        double x = b->x_m - a->x_m, y = b->y_m - a->y_m, margin = 0.15 * (b->t_s - a->t_s);
        if (hypot(x, y) > 4.0) {
            leg_t leg = {a->t_s + margin, b->t_s - margin, atan2(y, x), hypot(x, y), {0}, {0}};
            legs[count++] = leg;
        }
    }
    return count;
}

static void follow(FILE *file, leg_t *legs, int count, results_t *results)
{
    insole_attitude_t att[METHODS];
    insole_still_bias_t rest;
    insole_imu_t imu;
    for (int m = 0; m < METHODS; m++) {
        ck_assert_int_eq(insole_attitude_init(&att[m], &insole_attitude_defaults), INSOLE_OK);
    }
    ck_assert_int_eq(insole_still_bias_init(&rest, &insole_still_bias_defaults), INSOLE_OK);
    while (mall_read_imu(file, &imu)) {
        double t = (double)imu.t_us * 1.0e-6 - MALL_ZERO_S, heading[METHODS];
        (void)insole_still_bias_push(&rest, &imu);
        for (int m = 0; m < METHODS; m++) {
            (void)insole_attitude_set_bias(&att[m], rest.gyro_bias_radps);
            (void)insole_attitude_push(&att[m], METHOD[m], &imu, 0u);
            insole_turn_t ahead = insole_heading(att[m].q, NULL).ahead;
            heading[m] = atan2((double)ahead.sin, (double)ahead.cos);
            for (int i = 0; i < count; i++) {
                if (t >= legs[i].begin_s && t < legs[i].end_s) {
                    legs[i].cos[m] += (double)ahead.cos;
                    legs[i].sin[m] += (double)ahead.sin;
                }
            }
        }
        double apart = fabs(remainder(heading[1] - heading[2], 2.0 * PI)) / DEG;
        results->apart_deg = fmax(results->apart_deg, apart);
    }
    results->upsets += att[1].upsets + att[2].upsets;
}

/* The walk's own offset, a mean weighed by length, is not the attitude's to know. */
static void compare(const leg_t *legs, int count, results_t *results)
{
    for (int m = 0; m < METHODS; m++) {
        double c = 0.0, s = 0.0, off[MALL_WAYPOINTS];
        for (int i = 0; i < count; i++) {
            off[i] = atan2(legs[i].sin[m], legs[i].cos[m]) - legs[i].direction;
            c += legs[i].length_m * cos(off[i]);
            s += legs[i].length_m * sin(off[i]);
        }
        for (int i = 0; i < count; i++) {
            double e = remainder(off[i] - atan2(s, c), 2.0 * PI) / DEG;
            results->errors_deg[m][results->legs + i] = fabs(e);
        }
    }
    results->legs += count;
    results->walks++;
}

static int by_size(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return x < y ? -1 : x > y ? 1 : 0;
}

static double median_after_printing(double *errors, int n, const char *name)
{
    double sum = 0.0;
    qsort(errors, (size_t)n, sizeof *errors, by_size);
    for (int i = 0; i < n; i++) {
        sum += errors[i] * errors[i] / n;
    }
    printf("heading along %d legs, %s: median %.2f, 90 %% %.2f, rms %.2f degrees\n", n, name,
           errors[n / 2], errors[9 * n / 10], sqrt(sum));
    return errors[n / 2];
}

START_TEST(legs_of_recorded_walks)
{
    static results_t results;
    for (int walk = 0; walk < MALL_WALKS; walk += 2) {
        mall_waypoint_t points[MALL_WAYPOINTS];
        leg_t legs[MALL_WAYPOINTS];
        FILE *truth = mall_open(walk, "truth.csv"), *imu = mall_open(walk, "imu.csv");
        if (!truth || !imu) {
            printf("SKIPPED: no recordings in ../shared/data/phone/mall_F1\n");
            return;
        }
        int count = legs_of(points, mall_read_truth(truth, points), legs);
        follow(imu, legs, count, &results);
        if (count >= 2) {
            compare(legs, count, &results);
        }
    }
    ck_assert_int_gt(results.walks, 30);
    for (int m = 0; m < METHODS; m++) {
        double median = median_after_printing(results.errors_deg[m], results.legs, NAMES[m]);
        ASSERT_AT_MOST(median, 7.0, "degrees");
    }
    printf("the two filters: at most %.2f degrees apart\n", results.apart_deg);
    ASSERT_AT_MOST(results.apart_deg, 3.0, "degrees");
    ck_assert_uint_eq(results.upsets, 0u);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("attitude_walks");
    suite_add(suite, "legs", legs_of_recorded_walks);
    return suite;
}
