/* SPDX-License-Identifier: MIT
 * Whole walks: does the covariance tell how wrong the filter is, and does the mounting matter? */
#include "near.h"
#include "noisy_gait.h"
#include "suite.h"

static const double EPS = (double)INSOLE_REAL_EPSILON;

/* ---- consistency ------------------------------------------------------------------------ */

enum { SAMPLES = 2400, RUNS = 200, BLOCK = 8, EVERY = 5 * BLOCK, INSTANTS = SAMPLES / EVERY };

typedef struct {
    double part[4]; /* of p, v, a, b: chi2 of 3 */
    double all;     /* chi2 of 12 */
} nees_t;

static noisy_sample_t samples[SAMPLES];
static nees_t nees[INSTANTS];

static void add_nees(const noisy_gait_t *run)
{
    const moment_t *truth = &samples[run->next - 1].end;
    column_t x = noisy_gait_error(run, truth, d3_of(run->ekf.p_m), d3_of(run->ekf.v_mps),
                                  d33_of(insole_quat_to_mat3(run->ekf.q)));
    dense_t P = dense_of(&run->ekf.P);
    nees_t *sum = &nees[run->next / EVERY - 1];
    for (int i = 0; i < 4; i++) {
        sum->part[i] += dense_mahalanobis(&P, &x, 3 * i, 3) / RUNS;
    }
    sum->all += dense_mahalanobis(&P, &x, 0, DENSE) / RUNS;
}

/* Means of 200 runs with the noise that the filter believes in, at 60 moments, where the noise of a
 * block has just been added: then the velocity of a stance counts as less certain than it is. */
START_TEST(knows_how_wrong_it_is)
{
    const double four_sigma = 4.0 * sqrt(2.0 * 3.0 / RUNS);
    gait_t gait = gait_usual();
    noisy_gait_fill(samples, SAMPLES, &gait);
    for (uint64_t seed = 1u; seed <= RUNS; seed++) {
        noisy_gait_t run;
        noisy_gait_begin(&run, &gait, seed);
        while (run.next < SAMPLES) {
            noisy_gait_step(&run, samples);
            if (run.next % EVERY == 0) {
                add_nees(&run);
            }
        }
    }
    double mean = 0.0;
    for (int i = 0; i < INSTANTS; i++) {
        bool still = samples[(i + 1) * EVERY - 1].still;
        for (int part = 0; part < 4; part++) {
            double low = part == 1 && still ? 1.5 : 3.0 - four_sigma;
            ck_assert_msg(nees[i].part[part] >= low && nees[i].part[part] <= 3.0 + four_sigma,
                          "state %d at %d: %.3f, expected 3", part, i, nees[i].part[part]);
        }
        mean += nees[i].all / INSTANTS;
    }
    ASSERT_NEAR(mean, 12.0, 0.8, "(chi2 of 12)");
}
END_TEST

/* So are the innovations: chi2 of 3 on average over a whole stance. */
START_TEST(knows_how_surprised_to_be)
{
    gait_t gait = gait_usual();
    noisy_gait_fill(samples, SAMPLES, &gait);
    double sum = 0.0, count = 0.0;
    for (uint64_t seed = 1u; seed <= 20u; seed++) {
        noisy_gait_t run;
        noisy_gait_begin(&run, &gait, seed);
        while (run.next < SAMPLES) {
            noisy_gait_step(&run, samples);
            sum += (double)run.nis;
            count += run.nis > INSOLE_R(0.0) ? 1.0 : 0.0;
        }
    }
    ASSERT_AT_LEAST(count, 20.0 * 1000.0, "corrections");
    ASSERT_NEAR(sum / count, 3.0, 4.0 * sqrt(2.0 * 3.0 / count), "(chi2 of 3)");
}
END_TEST

/* ---- mounting --------------------------------------------------------------------------- */

/* The walk of a sensor that is turned on the foot by Q, aligned like a tracker would. */
static insole_zupt_ekf_t walk_mounted(d33_t Q, int count)
{
    gait_t gait = gait_usual();
    gait.mounting = d33_mul(gait.mounting, Q);
    moment_t begin = gait_moment(&gait, 0.0);
    d3_t up = motion_force(&begin);
    insole_zupt_ekf_t ekf = filter_new();
    ekf.config.point_share = INSOLE_R(0.0);
    insole_real_t yaw = (insole_real_t)atan2(begin.R.r1.x, begin.R.r0.x);
    ck_assert_int_eq(insole_zupt_ekf_align(&ekf, real_of(up), INSOLE_R(0.01), yaw, 1000000u),
                     INSOLE_OK);
    filter_walk(&ekf, &gait, 0, count);
    ck_assert_uint_eq(ekf.refused, 0u);
    return ekf;
}

START_TEST(walks_alike_in_any_mounting)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 1u);
    insole_zupt_ekf_t expected = walk_mounted(turn_z(0.0), SAMPLES);
    dense_t P = dense_of(&expected.P);
    worst_t off = {0.0, 0.0}, cov = {0.0, 0.0};
    for (int i = 0; i < 30; i++) {
        d33_t Q = d33_of(insole_quat_to_mat3(sample_quat(&rng)));
        insole_zupt_ekf_t ekf = walk_mounted(i == 0 ? turn_x(3.141592653589793) : Q, SAMPLES);
        worst_note(&off, d3_norm(d3_add(d3_of(ekf.p_m), -1.0, d3_of(expected.p_m))), i);
        dense_t other = dense_of(&ekf.P);
        for (int j = 0; j < DENSE_B * DENSE_B; j++) { /* the bias is in b, the rest in n */
            int row = j / DENSE_B, column = j % DENSE_B;
            double apart = fabs(other.at[row][column] - P.at[row][column]);
            worst_note(&cov, apart / sqrt(P.at[row][row] * P.at[column][column]), i);
        }
    }
    ASSERT_WORST(off, 5.0e3 * EPS, "m");
    ASSERT_WORST(cov, 1.0e3 * EPS, "(of the 1-sigmas)");
}
END_TEST

/* Without noise the filter is where the foot is. */
START_TEST(follows_a_perfect_sensor)
{
    gait_t gait = gait_usual();
    insole_zupt_ekf_t ekf = walk_mounted(turn_z(0.0), SAMPLES);
    moment_t truth = gait_moment(&gait, 1.0e-6 * FILTER_STEP_US * SAMPLES);
    ASSERT_AT_MOST(d3_norm(d3_add(d3_of(ekf.p_m), -1.0, truth.p)), 5.0e-4, "m after 13 m");
    ASSERT_AT_MOST(d3_norm(turn_between(truth.R, d33_of(insole_quat_to_mat3(ekf.q)))), 1.0e-5,
                   "rad");
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("zupt_ekf walk");
    suite_add(suite, "covariance", knows_how_wrong_it_is);
    suite_add(suite, "innovations", knows_how_surprised_to_be);
    suite_add(suite, "any mounting", walks_alike_in_any_mounting);
    suite_add(suite, "a perfect sensor", follows_a_perfect_sensor);
    return suite;
}
