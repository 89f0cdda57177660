/* SPDX-License-Identifier: MIT */
#include "insole/fuse/particle_cloud.h"

#include <string.h>

#include "near.h"
#include "suite.h"

enum { MANY = 100000, PAST = 6, ALL = 1 << 30 };

static insole_particle_t particles[MANY], before[MANY];
static insole_spot_t past[1000 * PAST], past_before[1000 * PAST];
static insole_cloud_t cloud;
static insole_rng_t rng;

static double uniform(double low, double high)
{
    return low + (high - low) * (double)insole_rng_uniform(&rng);
}

static double normal(void)
{
    return (double)insole_rng_normal(&rng);
}

/* Particles about (x, y) whose logarithms of weights spread over `spread`. */
static void make_cloud(uint64_t seed, uint32_t count, double x, double y, double spread)
{
    insole_rng_seed(&rng, seed);
    for (uint32_t i = 0; i < count; i++) {
        double a = normal(), b = normal();
        insole_particle_t p = {(insole_real_t)(x + 2.0 * a), (insole_real_t)(y + a - 0.5 * b),
                               (insole_real_t)(0.3 * normal()), (insole_real_t)(1.0 + 0.02 * b),
                               (insole_real_t)uniform(-spread, 0.0)};
        particles[i] = p;
    }
    insole_cloud_t c = {particles, count, NULL, 0, NULL};
    cloud = c;
}

static uint32_t heaviest(void)
{
    uint32_t best = 0;
    for (uint32_t i = 1; i < cloud.count; i++) {
        best = particles[i].log_weight > particles[best].log_weight ? i : best;
    }
    return best;
}

static insole_cloud_sum_t sum_up(uint32_t slice)
{
    insole_cloud_sum_t sum;
    insole_cloud_sum_begin(&sum, &cloud, heaviest());
    uint32_t budget = slice;
    while (insole_cloud_sum_work(&sum, &cloud, &budget)) {
        budget = slice;
    }
    return sum;
}

static insole_cloud_fix_t fix_of_cloud(void)
{
    insole_cloud_sum_t sum = sum_up(ALL);
    insole_cloud_fix_t fix;
    ck_assert_int_eq(insole_cloud_fix(&sum, &fix), INSOLE_OK);
    return fix;
}

static double weight(uint32_t i)
{
    return insole_particle_lives(&particles[i]) ? exp((double)particles[i].log_weight) : 0.0;
}

static double total_weight(void)
{
    double total = 0.0;
    for (uint32_t i = 0; i < cloud.count; i++) {
        total += weight(i);
    }
    return total;
}

static void resample(double shift, uint32_t slice)
{
    insole_cloud_sum_t sum = sum_up(ALL);
    insole_cloud_comb_t comb;
    insole_cloud_resample_begin(&comb, &sum, cloud.count, (insole_real_t)shift);
    uint32_t budget = slice, rounds = 0;
    while (insole_cloud_resample_work(&comb, &cloud, &budget)) {
        ck_assert_uint_eq(budget, 0);
        ck_assert_uint_le(++rounds, 4u * cloud.count);
        budget = slice;
    }
}

/* ---- summing up ---- */

typedef struct {
    double x, y, xx, xy, yy, effective, scale;
} moments_t;

static moments_t moments_by_double(void)
{
    moments_t m = {0};
    double total = total_weight(), squares = 0.0;
    for (uint32_t i = 0; i < cloud.count; i++) {
        double w = weight(i) / total;
        m.x += w * (double)particles[i].x_m;
        m.y += w * (double)particles[i].y_m;
        m.scale += w * (double)particles[i].scale;
        squares += w * w;
    }
    for (uint32_t i = 0; i < cloud.count; i++) {
        double w = weight(i) / total;
        double x = (double)particles[i].x_m - m.x, y = (double)particles[i].y_m - m.y;
        m.xx += w * x * x;
        m.xy += w * x * y;
        m.yy += w * y * y;
    }
    m.effective = 1.0 / squares;
    return m;
}

static const struct {
    uint32_t count;
    double x, y, spread;
} clouds[] = {{500, 3.0, 4.0, 0.0},     {500, 3.0, 4.0, 5.0},      {500, 500.0, -500.0, 5.0},
              {500, 1e4, 1e4, 30.0},    {7, -3.0, 0.0, 2.0},       {1, 1.0, 2.0, 0.0},
              {2, 100.0, 100.0, 200.0}, {20000, -500.0, 3.0, 10.0}};

START_TEST(mean_and_covariance_by_double)
{
    make_cloud(1u, clouds[_i].count, clouds[_i].x, clouds[_i].y, clouds[_i].spread);
    for (uint32_t i = 3; i < cloud.count; i += 5) {
        particles[i].log_weight = INSOLE_PARTICLE_DEAD;
    }
    insole_cloud_fix_t fix = fix_of_cloud();
    moments_t m = moments_by_double();
    double sharp = 2e-7 * (fabs(clouds[_i].x) + fabs(clouds[_i].y)) + 2e-5;
    ASSERT_NEAR(fix.x_m, m.x, sharp, "m");
    ASSERT_NEAR(fix.y_m, m.y, sharp, "m");
    ASSERT_NEAR(fix.var_x_m2, m.xx, 1e-4 * m.xx + 1e-7, "m2");
    ASSERT_NEAR(fix.cov_xy_m2, m.xy, 1e-4 * m.xx + 1e-7, "m2");
    ASSERT_NEAR(fix.var_y_m2, m.yy, 1e-4 * m.yy + 1e-7, "m2");
    ASSERT_NEAR(fix.scale, m.scale, 1e-5, "");
    ASSERT_NEAR(fix.effective, m.effective, 1e-4 * m.effective, "particles");
}
END_TEST

/* Whatever the cloud, no direction has a negative variance. */
START_TEST(covariance_is_never_negative)
{
    for (uint64_t seed = 0; seed < 2000; seed++) {
        make_cloud(seed, 1u + (uint32_t)(seed % 9u), 300.0, -700.0, (double)(seed % 50u));
        double along = uniform(-1.0, 1.0), turn = uniform(-3.0, 3.0);
        for (uint32_t i = 0; i < cloud.count && seed % 3u != 0u; i++) { /* all on a line */
            double s = seed % 3u == 1u ? 1e-3 * i : 5.0 * i * along;
            particles[i].x_m = (insole_real_t)(300.0 + s * cos(turn));
            particles[i].y_m = (insole_real_t)(-700.0 + s * sin(turn));
        }
        insole_cloud_fix_t fix = fix_of_cloud();
        double xx = (double)fix.var_x_m2, xy = (double)fix.cov_xy_m2, yy = (double)fix.var_y_m2;
        ck_assert(xx >= 0.0 && yy >= 0.0 && fix.var_offset_rad2 >= 0);
        ck_assert_msg(xy * xy <= xx * yy * (1.0 + 1e-5), "%g %g %g", xx, xy, yy);
        ck_assert(fix.effective >= INSOLE_R(0.9999) &&
                  fix.effective <= INSOLE_R(1.0001) * (insole_real_t)cloud.count);
    }
}
END_TEST

/* A hundred thousand beside one that is the heaviest by a hair: nothing but rounding is left. */
START_TEST(rounding_makes_no_negative_variance)
{
    for (uint64_t seed = 0; seed < 20; seed++) {
        make_cloud(seed, MANY, 0.0, 0.0, 0.0);
        double x = uniform(1.0, 300.0), y = uniform(1.0, 300.0), offset = uniform(0.1, 3.0);
        for (uint32_t i = 0; i < MANY; i++) {
            particles[i].x_m = (insole_real_t)(i == seed ? 0.0 : x);
            particles[i].y_m = (insole_real_t)(i == seed ? 0.0 : y);
            particles[i].offset_rad = (insole_real_t)(i == seed ? 0.0 : offset);
            particles[i].log_weight = i == seed ? INSOLE_R(1e-6) : 0;
        }
        insole_cloud_fix_t fix = fix_of_cloud();
        ck_assert(fix.var_x_m2 >= 0 && fix.var_y_m2 >= 0 && fix.var_offset_rad2 >= 0);
        double limit = sqrt((double)fix.var_x_m2) * sqrt((double)fix.var_y_m2);
        ASSERT_AT_MOST(fabs((double)fix.cov_xy_m2), limit * (1.0 + 1e-6), "m2");
        ASSERT_NEAR(fix.x_m, x, 3e-3 * x, "m"); /* half a rounding for each of them */
    }
}
END_TEST

static const double offset_means[] = {0.0, 1.0, 3.0, 3.1415, -3.14, -2.0};

START_TEST(the_mean_offset_is_one_on_the_circle)
{
    make_cloud(2u, 500, 0.0, 0.0, 2.0);
    double sin_sum = 0.0, cos_sum = 0.0, mean = offset_means[_i];
    for (uint32_t i = 0; i < cloud.count; i++) {
        particles[i].offset_rad = insole_wrap_pi((insole_real_t)(mean + 0.05 * normal()));
        sin_sum += weight(i) * sin((double)particles[i].offset_rad);
        cos_sum += weight(i) * cos((double)particles[i].offset_rad);
    }
    insole_cloud_fix_t fix = fix_of_cloud();
    ck_assert(fix.offset_rad > -INSOLE_PI && fix.offset_rad <= INSOLE_PI);
    ASSERT_NEAR(remainder((double)fix.offset_rad - atan2(sin_sum, cos_sum), 6.283185307179586), 0.0,
                1e-4, "rad");
    double length = hypot(sin_sum, cos_sum) / total_weight();
    ASSERT_NEAR(fix.var_offset_rad2, -2.0 * log(length), 1e-4, "rad2");
}
END_TEST

START_TEST(a_slice_is_as_large_as_budget_and_cloud_allow)
{
    static const uint32_t cases[][4] = {/* first, budget, end, budget left */
                                        {0, 7, 7, 0},
                                        {7, 7, 14, 0},
                                        {14, 7, 20, 1},
                                        {20, 7, 20, 7},
                                        {25, 7, 25, 7},
                                        {3, 0, 3, 0},
                                        {1, UINT32_MAX, 20, UINT32_MAX - 19}};
    insole_cloud_t twenty = {particles, 20, NULL, 0, NULL};
    uint32_t budget = cases[_i][1];
    ck_assert_uint_eq(insole_cloud_slice(&twenty, cases[_i][0], &budget), cases[_i][2]);
    ck_assert_uint_eq(budget, cases[_i][3]);
}
END_TEST

START_TEST(sums_in_slices_are_the_same)
{
    make_cloud(3u, 500, 50.0, 60.0, 5.0);
    insole_cloud_sum_t whole = sum_up(ALL);
    for (uint32_t slice = 1; slice < 600; slice += 37) {
        insole_cloud_sum_t sliced = sum_up(slice);
        ck_assert_mem_eq(&sliced, &whole, sizeof whole);
    }
}
END_TEST

/* ---- resampling ---- */

/* Marks each particle, so that copies tell whose they are. */
static void mark(void)
{
    for (uint32_t i = 0; i < cloud.count; i++) {
        particles[i].x_m = (insole_real_t)i;
    }
    memcpy(before, particles, cloud.count * sizeof particles[0]);
}

static void count_copies(uint32_t *copies)
{
    memset(copies, 0, cloud.count * sizeof copies[0]);
    for (uint32_t i = 0; i < cloud.count; i++) {
        copies[(uint32_t)particles[i].x_m]++;
    }
}

/* Over all shifts of the comb the mean number of copies is the share of the weight, exactly; for
 * one shift it is next to it. */
START_TEST(copies_are_unbiased)
{
    enum { N = 60, SHIFTS = 2000 };
    static uint32_t copies[N];
    double mean[N] = {0.0};
    make_cloud(4u + (uint64_t)_i, N, 0.0, 0.0, 6.0);
    particles[7].log_weight = INSOLE_PARTICLE_DEAD;
    mark();
    double total = total_weight();
    for (int k = 0; k < SHIFTS; k++) {
        memcpy(particles, before, sizeof before[0] * N);
        resample((k + 0.5) / SHIFTS, ALL);
        count_copies(copies);
        for (int i = 0; i < N; i++) {
            double share = before[i].log_weight > INSOLE_PARTICLE_DEAD
                               ? N * exp((double)before[i].log_weight) / total
                               : 0.0;
            ck_assert_msg(fabs(copies[i] - share) < 1.0 + 1e-4, "%u copies of %g", copies[i],
                          share);
            mean[i] += (double)copies[i] / SHIFTS;
        }
    }
    memcpy(particles, before, sizeof before[0] * N);
    for (uint32_t i = 0; i < N; i++) {
        ASSERT_NEAR(mean[i], N * weight(i) / total, 1.5 / SHIFTS, "copies");
    }
}
END_TEST

/* With shifts from the generator: the mean of what the cloud tells stays. */
START_TEST(resampling_keeps_the_mean)
{
    enum { N = 200, TRIALS = 3000 };
    make_cloud(9u, N, 0.0, 0.0, 4.0);
    memcpy(before, particles, sizeof before[0] * N);
    moments_t m = moments_by_double();
    double sum = 0.0, squares = 0.0;
    for (int t = 0; t < TRIALS; t++) {
        memcpy(particles, before, sizeof before[0] * N);
        resample((double)insole_rng_uniform(&rng), ALL);
        double x = moments_by_double().x - m.x;
        sum += x;
        squares += x * x;
    }
    double sigma = sqrt(squares / TRIALS);
    ck_assert(sigma > 0.0 && sigma < 0.05); /* far less than 2 m / sqrt(200) = 0.14 */
    ASSERT_NEAR(sum / TRIALS, 0.0, 4.0 * sigma / sqrt((double)TRIALS), "m");
}
END_TEST

/* Survivors stay where they are, the rest are copies to the bit, and all weigh the same. */
START_TEST(the_living_stay_and_the_dead_are_overwritten)
{
    enum { N = 500 };
    static uint32_t copies[N];
    make_cloud(10u, N, 0.0, 0.0, 8.0);
    for (uint32_t i = 0; i < N; i += 3) {
        particles[i].log_weight = INSOLE_PARTICLE_DEAD;
    }
    mark();
    resample(0.4, ALL);
    count_copies(copies);
    for (uint32_t i = 0; i < N; i++) {
        uint32_t source = (uint32_t)particles[i].x_m;
        ck_assert(copies[i] == 0 || source == i);
        ck_assert(source % 3u != 0u);
        particles[i].log_weight = before[source].log_weight;
        ck_assert_mem_eq(&particles[i], &before[source], sizeof particles[i]);
    }
}
END_TEST

START_TEST(equal_weights_move_nobody)
{
    static const double shifts[] = {0.0, 1e-7, 0.25, 0.5, 0.999999};
    for (size_t k = 0; k < sizeof shifts / sizeof shifts[0]; k++) {
        make_cloud(11u, 500, 0.0, 0.0, 0.0);
        mark();
        resample(shifts[k], ALL);
        for (uint32_t i = 0; i < cloud.count; i++) {
            ASSERT_NEAR(particles[i].x_m, i, 0.0, "");
            ASSERT_NEAR(particles[i].log_weight, particles[0].log_weight, 0.0, "");
        }
    }
}
END_TEST

/* One particle; one survivor at either end or in the middle; weights that leave nothing else. */
START_TEST(the_only_survivor_is_everywhere)
{
    static const uint32_t counts[] = {1, 2, 3, 500}, who[] = {0, 0, 2, 250};
    for (int k = 0; k < 4; k++) {
        for (int weightless = 0; weightless < 2; weightless++) {
            make_cloud(12u, counts[k], 0.0, 0.0, 0.0);
            mark();
            for (uint32_t i = 0; i < counts[k]; i++) {
                particles[i].log_weight = weightless ? INSOLE_R(-1e20) : INSOLE_PARTICLE_DEAD;
            }
            particles[who[k]].log_weight = 5;
            resample(0.999, ALL);
            for (uint32_t i = 0; i < counts[k]; i++) {
                ASSERT_NEAR(particles[i].x_m, who[k], 0.0, "");
            }
        }
    }
}
END_TEST

/* A hundred thousand, over all magnitudes: every place is filled, rounding loses none. */
START_TEST(rounding_loses_no_place)
{
    worst_t filled = {0.0, 0.0}, living = {0.0, 0.0};
    make_cloud(13u + (uint64_t)_i, MANY, 0.0, 0.0, _i % 2 == 0 ? 80.0 : 0.01);
    particles[0].log_weight = INSOLE_PARTICLE_DEAD;
    particles[MANY - 1].log_weight = INSOLE_PARTICLE_DEAD;
    mark();
    resample(_i % 3 == 0 ? 0.0 : 0.9999999, ALL);
    for (uint32_t i = 0; i < MANY; i++) {
        worst_require(&filled, particles[i].log_weight >= 1 && particles[i].log_weight <= 1, i);
        worst_require(&living, particles[i].x_m > 0 && particles[i].x_m < MANY - 1, i);
    }
    ASSERT_ALL_HELD(filled);
    ASSERT_ALL_HELD(living); /* no copy of the dead */
}
END_TEST

START_TEST(resampling_in_slices_is_the_same)
{
    make_cloud(17u, 500, 0.0, 0.0, 10.0);
    memcpy(before, particles, 500 * sizeof particles[0]);
    resample(0.3, ALL);
    static insole_particle_t whole[500];
    memcpy(whole, particles, sizeof whole);
    for (uint32_t slice = 1; slice < 1200; slice = 2u * slice + 1u) {
        memcpy(particles, before, sizeof whole);
        resample(0.3, slice);
        ck_assert_mem_eq(particles, whole, sizeof whole);
    }
}
END_TEST

/* ---- walking ---- */

static const insole_cloud_stride_t straight = {
    .length_m = INSOLE_R(1.5), .heading_rad = INSOLE_R(0.5), .scale_memory = 1};

/* (32) without noise: the offset turns the stride, the scale stretches it. */
START_TEST(a_stride_without_noise)
{
    insole_particle_t p = {10, 20, INSOLE_R(0.7), INSOLE_R(1.1), -3};
    insole_rng_seed(&rng, 1u);
    insole_cloud_walk(&p, &straight, &rng);
    ASSERT_NEAR(p.x_m, 10.0 + 1.65 * cos(1.2), 2e-6, "m");
    ASSERT_NEAR(p.y_m, 20.0 + 1.65 * sin(1.2), 4e-6, "m");
    ASSERT_NEAR(p.offset_rad, 0.7, 1e-7, "rad");
    ASSERT_NEAR(p.scale, 1.1, 1e-7, "");
    ASSERT_NEAR(p.log_weight, -3.0, 0.0, "");
    insole_turn_t d = insole_cloud_direction(&p, straight.heading_rad);
    ASSERT_NEAR(atan2((double)d.sin, (double)d.cos), 1.2, 1e-6, "rad");
}
END_TEST

typedef struct {
    double mean, variance, fourth;
} spread_t;

static void take(spread_t *s, double x, int n)
{
    s->mean += x / n;
    s->variance += x * x / n;
    s->fourth += x * x * x * x / n;
}

static void check_normal(const spread_t *s, double mean, double sigma, int n)
{
    double sharp = 4.0 / sqrt((double)n);
    ASSERT_NEAR(s->mean, mean, sharp * sigma, "");
    ASSERT_NEAR(s->variance, sigma * sigma, sharp * 1.5 * sigma * sigma, "");
    ASSERT_NEAR(s->fourth, 3.0 * pow(sigma, 4.0), sharp * 10.0 * pow(sigma, 4.0), "");
}

/* Length N(s, sigma_s), heading N(psi, sigma_psi), independent. */
START_TEST(strides_scatter_as_told)
{
    enum { N = 100000 };
    insole_cloud_stride_t stride = straight;
    stride.sigma_length_m = INSOLE_R(0.1);
    stride.sigma_heading_rad = INSOLE_R(0.2);
    insole_rng_seed(&rng, 2u);
    spread_t length = {0}, heading = {0};
    double both = 0.0;
    for (int i = 0; i < N; i++) {
        insole_particle_t p = {0, 0, 0, 1, 0};
        insole_cloud_walk(&p, &stride, &rng);
        double l = hypot((double)p.x_m, (double)p.y_m) - 1.5;
        double h = atan2((double)p.y_m, (double)p.x_m) - 0.5;
        take(&length, l, N);
        take(&heading, h, N);
        both += l * h / N;
        ck_assert(!(p.offset_rad > 0) && !(p.offset_rad < 0));
    }
    check_normal(&length, 0.0, 0.1, N);
    check_normal(&heading, 0.0, 0.2, N);
    ASSERT_NEAR(both, 0.0, 4.0 * 0.1 * 0.2 / sqrt((double)N), "");
}
END_TEST

/* An offset wanders: after 25 strides five times the scatter of one, and the walk follows it. */
START_TEST(offsets_wander)
{
    enum { N = 20000 };
    insole_cloud_stride_t stride = straight;
    stride.sigma_wander_rad = INSOLE_R(0.02);
    insole_rng_seed(&rng, 3u);
    spread_t offset = {0};
    for (int i = 0; i < N; i++) {
        insole_particle_t p = {0, 0, 3, 1, 0};
        for (int k = 0; k < 25; k++) {
            p.x_m = p.y_m = 0;
            insole_cloud_walk(&p, &stride, &rng);
        }
        ck_assert(p.offset_rad > -INSOLE_PI && p.offset_rad <= INSOLE_PI);
        double turned = remainder((double)p.offset_rad - 3.0, 6.283185307179586);
        double walked = atan2((double)p.y_m, (double)p.x_m) - 3.5;
        ASSERT_NEAR(remainder(walked - turned, 6.283185307179586), 0.0, 1e-5, "rad");
        take(&offset, turned, N);
    }
    check_normal(&offset, 0.0, 0.1, N);
}
END_TEST

/* Scales stay scattered as at the start, however long the walk, and forget slowly. */
START_TEST(scales_neither_die_out_nor_run_away)
{
    enum { N = 5000 };
    insole_cloud_stride_t stride = straight;
    stride.scale_memory = INSOLE_R(0.9);
    stride.sigma_scale = INSOLE_R(0.02) * insole_sqrt(1 - INSOLE_R(0.81));
    insole_rng_seed(&rng, 4u);
    spread_t scale = {0};
    double kept = 0.0;
    for (int i = 0; i < N; i++) {
        double first = 0.02 * normal();
        insole_particle_t p = {0, 0, 0, (insole_real_t)(1.0 + first), 0};
        for (int k = 0; k < 100; k++) {
            insole_cloud_walk(&p, &stride, &rng);
            kept += k == 4 ? first * ((double)p.scale - 1.0) / N : 0.0;
        }
        take(&scale, (double)p.scale - 1.0, N);
    }
    check_normal(&scale, 0.0, 0.02, N);
    ASSERT_NEAR(kept / 4e-4, pow(0.9, 5.0), 4.0 / sqrt((double)N), "of the variance");
}
END_TEST

/* ---- the past ---- */

/* A copy takes the bias of its source with it; who has none needs none. */
START_TEST(the_bias_goes_with_its_particle)
{
    static insole_spot_t bias[500];
    make_cloud(9u, 500, 0.0, 0.0, 5.0);
    mark();
    for (uint32_t i = 0; i < 500; i++) {
        bias[i] = insole_spot((insole_real_t)i, -(insole_real_t)i);
    }
    cloud.bias = bias;
    resample(0.4, 37);
    uint32_t copies = 0;
    for (uint32_t i = 0; i < 500; i++) {
        ck_assert(bias[i].x_m == particles[i].x_m && bias[i].y_m == -particles[i].x_m);
        copies += particles[i].x_m != (insole_real_t)i ? 1u : 0u;
    }
    ck_assert_uint_gt(copies, 50u);
    cloud.bias = NULL;
}
END_TEST

/* Offset and scale change by numbers of their own, and wrap. */
START_TEST(wandering_apart)
{
    enum { M = 40000 };
    insole_cloud_stride_t stride = straight;
    double sum[2] = {0, 0}, square[2] = {0, 0}, product = 0.0;
    stride.apart_wander_rad = INSOLE_R(0.2);
    stride.apart_scale = INSOLE_R(0.01);
    insole_rng_seed(&rng, 12u);
    for (int i = 0; i < M; i++) {
        insole_particle_t p = {3, 4, 3, INSOLE_R(1.1), -2};
        insole_cloud_wander(&p, &stride, &rng);
        double is[2] = {remainder((double)p.offset_rad - 3.0, 6.283185307179586) / 0.2,
                        ((double)p.scale - 1.1) / 0.01};
        for (int k = 0; k < 2; k++) {
            sum[k] += is[k] / M;
            square[k] += is[k] * is[k] / M;
        }
        product += is[0] * is[1] / M;
        ck_assert(p.x_m == 3 && p.y_m == 4 && p.log_weight == -2 && p.offset_rad <= INSOLE_PI);
    }
    for (int k = 0; k < 2; k++) {
        ASSERT_NEAR(sum[k], 0.0, 0.02, "sigmas");
        ASSERT_NEAR(square[k], 1.0, 0.03, "");
    }
    ASSERT_NEAR(product, 0.0, 0.02, "");
}
END_TEST

static void remember(uint32_t stride)
{
    uint32_t half = cloud.count / 2u;
    insole_cloud_remember(&cloud, 0, half, stride);
    insole_cloud_remember(&cloud, half, cloud.count, stride);
}

/* Places are the particle's number and the stride's; a copy has the past of its source. */
START_TEST(the_past_goes_with_its_particle)
{
    make_cloud(20u, 300, 0.0, 0.0, 8.0);
    cloud.past = past;
    cloud.past_strides = PAST;
    for (uint32_t stride = 0; stride < 15; stride++) { /* the ring runs over twice */
        for (uint32_t i = 0; i < cloud.count; i++) {
            particles[i].y_m = (insole_real_t)stride;
        }
        mark();
        remember(stride);
    }
    memcpy(past_before, past, sizeof past);
    resample(0.7, 50);
    for (uint32_t i = 0; i < cloud.count; i++) {
        uint32_t source = (uint32_t)particles[i].x_m;
        ck_assert_mem_eq(&past[i * PAST], &past_before[source * PAST], PAST * sizeof past[0]);
        for (uint32_t stride = 9; stride < 15; stride++) {
            ASSERT_NEAR(past[i * PAST + stride % PAST].y_m, stride, 0.0, "");
            ASSERT_NEAR(past[i * PAST + stride % PAST].x_m, source, 0.0, "");
        }
    }
}
END_TEST

START_TEST(the_past_is_the_mean_over_ancestors)
{
    make_cloud(21u, 300, 500.0, -500.0, 5.0);
    cloud.past = past;
    cloud.past_strides = PAST;
    remember(7);
    double x = 0.0, y = 0.0, total = 0.0;
    for (uint32_t i = 0; i < cloud.count; i++) {
        if (i % 4u == 0u) {
            particles[i].log_weight = INSOLE_PARTICLE_DEAD;
        }
        x += weight(i) * (double)past[i * PAST + 1].x_m;
        y += weight(i) * (double)past[i * PAST + 1].y_m;
        total += weight(i);
        particles[i].x_m = particles[i].y_m = 0; /* where it is now does not count */
    }
    insole_spot_t mean;
    ck_assert_int_eq(insole_cloud_recall(&cloud, 7, &mean), INSOLE_OK);
    ASSERT_NEAR(mean.x_m, x / total, 1e-4, "m");
    ASSERT_NEAR(mean.y_m, y / total, 1e-4, "m");
}
END_TEST

/* ---- refusals ---- */

START_TEST(a_cloud_must_be_one)
{
    insole_cloud_t c = {particles, 1, NULL, 0, NULL};
    ck_assert_int_eq(insole_cloud_check(&c), INSOLE_OK);
    c.count = INSOLE_CLOUD_PARTICLES_MAX;
    ck_assert_int_eq(insole_cloud_check(&c), INSOLE_OK);
    c.count++;
    ck_assert_int_eq(insole_cloud_check(&c), INSOLE_ERR_VALUE);
    c.count = 0;
    ck_assert_int_eq(insole_cloud_check(&c), INSOLE_ERR_VALUE);
    c.count = 1;
    c.past_strides = 1;
    ck_assert_int_eq(insole_cloud_check(&c), INSOLE_ERR_NULL);
    c.past_strides = 0;
    c.particles = NULL;
    ck_assert_int_eq(insole_cloud_check(&c), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_cloud_check(NULL), INSOLE_ERR_NULL);
}
END_TEST

START_TEST(there_is_no_fix_of_the_dead)
{
    insole_cloud_fix_t fix = {0}, fix_before = fix;
    insole_spot_t mean = {5, 6};
    make_cloud(22u, 10, 0.0, 0.0, 0.0);
    insole_cloud_sum_t sum = sum_up(ALL);
    ck_assert_int_eq(insole_cloud_fix(NULL, &fix), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_cloud_fix(&sum, NULL), INSOLE_ERR_NULL);
    for (uint32_t i = 0; i < cloud.count; i++) {
        particles[i].log_weight = INSOLE_PARTICLE_DEAD;
    }
    sum = sum_up(ALL);
    ck_assert_int_eq(insole_cloud_fix(&sum, &fix), INSOLE_ERR_STATE);
    ck_assert_mem_eq(&fix, &fix_before, sizeof fix);
    ck_assert_int_eq(insole_cloud_recall(&cloud, 0, &mean), INSOLE_ERR_STATE); /* no past */
    cloud.past = past;
    cloud.past_strides = PAST;
    ck_assert_int_eq(insole_cloud_recall(&cloud, 0, &mean), INSOLE_ERR_STATE); /* all dead */
    ck_assert_int_eq(insole_cloud_recall(&cloud, 0, NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_cloud_recall(NULL, 0, &mean), INSOLE_ERR_NULL);
    ASSERT_NEAR(mean.x_m, 5.0, 0.0, "m");
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("particle_cloud");
    suite_add_loop(suite, "moments", mean_and_covariance_by_double,
                   sizeof clouds / sizeof clouds[0]);
    suite_add(suite, "covariance", covariance_is_never_negative);
    suite_add(suite, "covariance of many", rounding_makes_no_negative_variance);
    suite_add_loop(suite, "mean offset", the_mean_offset_is_one_on_the_circle,
                   sizeof offset_means / sizeof offset_means[0]);
    suite_add_loop(suite, "a slice", a_slice_is_as_large_as_budget_and_cloud_allow, 7);
    suite_add(suite, "sums in slices", sums_in_slices_are_the_same);
    suite_add_loop(suite, "unbiased", copies_are_unbiased, 3);
    suite_add(suite, "mean stays", resampling_keeps_the_mean);
    suite_add(suite, "living stay", the_living_stay_and_the_dead_are_overwritten);
    suite_add(suite, "equal weights", equal_weights_move_nobody);
    suite_add(suite, "one survivor", the_only_survivor_is_everywhere);
    suite_add_loop(suite, "rounding", rounding_loses_no_place, 12);
    suite_add(suite, "resampling in slices", resampling_in_slices_is_the_same);
    suite_add(suite, "stride", a_stride_without_noise);
    suite_add(suite, "scatter", strides_scatter_as_told);
    suite_add(suite, "wander", offsets_wander);
    suite_add(suite, "scales", scales_neither_die_out_nor_run_away);
    suite_add(suite, "past travels", the_past_goes_with_its_particle);
    suite_add(suite, "past mean", the_past_is_the_mean_over_ancestors);
    suite_add(suite, "check", a_cloud_must_be_one);
    suite_add(suite, "dead", there_is_no_fix_of_the_dead);
    suite_add(suite, "bias", the_bias_goes_with_its_particle);
    suite_add(suite, "wander", wandering_apart);
    return suite;
}
