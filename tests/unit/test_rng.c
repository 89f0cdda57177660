/* SPDX-License-Identifier: MIT */
#include "insole/base/rng.h"

#include <string.h>

#include "near.h"
#include "suite.h"

enum { DRAWS = 1000000, TAIL_DRAWS = 20000000 };

static insole_rng_t seeded(uint64_t seed)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, seed);
    return rng;
}

/* Probability that a standard normal number lies beyond x. */
static double normal_above(double x)
{
    return 0.5 * erfc(x * 0.70710678118654752440);
}

/* The published first numbers of xoshiro128++ from the state 1, 2, 3, 4. */
START_TEST(bits_are_those_of_the_published_generator)
{
    static const uint32_t EXPECTED[] = {641u,       1573767u,    3222811527u, 3517856514u,
                                        836907274u, 4247214768u, 3867114732u, 1355841295u,
                                        495546011u, 621204420u};
    insole_rng_t rng = {{1u, 2u, 3u, 4u}};
    for (size_t i = 0; i < sizeof EXPECTED / sizeof EXPECTED[0]; i++) {
        ck_assert_uint_eq(insole_rng_bits(&rng), EXPECTED[i]);
    }
}
END_TEST

/* First numbers after SplitMix64, computed by a program of its own in integers of any size. */
START_TEST(seeds_give_the_known_sequences)
{
    static const struct {
        uint64_t seed;
        uint32_t first[4];
    } KNOWN[] = {
        {0u, {0x4653daa3u, 0x73922b58u, 0xb82b4addu, 0xd9fabd3bu}},
        {1u, {0x7ff78de4u, 0x9a170265u, 0xdac127b8u, 0x9859e914u}},
        {UINT64_MAX, {0x9df76fa2u, 0x4c367255u, 0x96ef9cd0u, 0x2313ad4bu}},
    };
    insole_rng_t rng = seeded(KNOWN[_i].seed);
    for (int i = 0; i < 4; i++) {
        ck_assert_uint_eq(insole_rng_bits(&rng), KNOWN[_i].first[i]);
    }
}
END_TEST

static int bits_set(uint32_t x)
{
    int count = 0;
    for (; x != 0u; x &= x - 1u) {
        count++;
    }
    return count;
}

START_TEST(neighbouring_seeds_have_nothing_in_common)
{
    double differing = 0.0;
    insole_rng_t before = seeded(0u);
    uint32_t last = insole_rng_bits(&before);
    for (uint64_t seed = 1u; seed <= 1000u; seed++) {
        insole_rng_t rng = seeded(seed);
        uint32_t bits = insole_rng_bits(&rng);
        ck_assert_uint_ne(bits, last);
        differing += bits_set(bits ^ last);
        last = bits;
    }
    /* 32000 fair coins: sigma 89 */
    ASSERT_NEAR(differing, 16000.0, 400.0, "bits");
    insole_rng_t high_half = seeded((uint64_t)1u << 32), low_half = seeded(1u);
    ck_assert_uint_ne(insole_rng_bits(&high_half), insole_rng_bits(&low_half));
}
END_TEST

START_TEST(each_bit_is_fair)
{
    insole_rng_t rng = seeded(3u);
    int ones[32] = {0}, repeats[32] = {0};
    uint32_t last = 0u;
    for (int i = 0; i < DRAWS; i++) {
        uint32_t bits = insole_rng_bits(&rng);
        for (int k = 0; k < 32; k++) {
            ones[k] += (int)((bits >> k) & 1u);
            repeats[k] += (int)((~(bits ^ last) >> k) & 1u);
        }
        last = bits;
    }
    for (int k = 0; k < 32; k++) {
        ASSERT_NEAR(ones[k], 0.5 * DRAWS, 2000.0, "ones"); /* 4 sigma */
        ASSERT_NEAR(repeats[k], 0.5 * DRAWS, 2000.0, "repeats");
    }
}
END_TEST

START_TEST(uniform_has_the_right_range_and_moments)
{
    insole_rng_t rng = seeded(4u);
    double sum = 0.0, sum2 = 0.0, lag = 0.0, last = 0.5;
    worst_t inside = {0.0, 0.0};
    for (int i = 0; i < DRAWS; i++) {
        double u = (double)insole_rng_uniform(&rng);
        double steps = u * 16777216.0;
        worst_require(&inside, u >= 0.0 && u < 1.0 && floor(steps) >= steps, u);
        sum += u - 0.5;
        sum2 += (u - 0.5) * (u - 0.5);
        lag += (u - 0.5) * (last - 0.5);
        last = u;
    }
    ASSERT_ALL_HELD(inside);
    ASSERT_NEAR(sum / DRAWS, 0.0, 4.0 * 0.288675 / 1000.0, "");
    ASSERT_NEAR(sum2 / DRAWS, 1.0 / 12.0, 4.0 * 0.0745356 / 1000.0, "");
    ASSERT_NEAR(lag / DRAWS, 0.0, 4.0 / 12.0 / 1000.0, "");
}
END_TEST

/* The last uniform below 1 and the first above 0 exist. */
START_TEST(uniform_reaches_its_ends_but_never_one)
{
    insole_rng_t zeros = {{0u, 1u, 1u, 0u}}, ones = {{0xffffffffu, 1u, 1u, 1u}};
    ASSERT_NEAR(insole_rng_uniform(&zeros), 0.0, 0.0, "");
    ASSERT_NEAR(insole_rng_uniform(&ones), 1.0 - 1.0 / 16777216.0, 0.0, "");
}
END_TEST

static double chi_square(const int *counts, const double *expected, int bins)
{
    double sum = 0.0;
    for (int i = 0; i < bins; i++) {
        double off = counts[i] - expected[i];
        sum += off * off / expected[i];
    }
    return sum;
}

/* Pairs of draws on a board of 16 x 16: chi-square with 255 degrees, sigma 22.6. */
START_TEST(uniform_pairs_fill_the_square_evenly)
{
    insole_rng_t rng = seeded(5u);
    int counts[256] = {0};
    double expected[256];
    for (int i = 0; i < DRAWS; i++) {
        int row = (int)(insole_rng_uniform(&rng) * INSOLE_R(16.0));
        int column = (int)(insole_rng_uniform(&rng) * INSOLE_R(16.0));
        counts[16 * row + column]++;
    }
    for (int i = 0; i < 256; i++) {
        expected[i] = DRAWS / 256.0;
    }
    ASSERT_NEAR(chi_square(counts, expected, 256), 255.0, 4.0 * 22.6, "");
}
END_TEST

START_TEST(normal_has_the_right_moments)
{
    insole_rng_t rng = seeded(6u);
    double sum[5] = {0.0}, lag = 0.0, last = 0.0;
    for (int i = 0; i < DRAWS; i++) {
        double z = (double)insole_rng_normal(&rng), power = 1.0;
        for (int k = 1; k <= 4; k++) {
            power *= z;
            sum[k] += power;
        }
        lag += z * last;
        last = z;
    }
    /* 4 sigma; the variance of z^k is the moment 2k less the square of the moment k */
    ASSERT_NEAR(sum[1] / DRAWS, 0.0, 0.004 * 1.0, "");
    ASSERT_NEAR(sum[2] / DRAWS, 1.0, 0.004 * sqrt(2.0), "");
    ASSERT_NEAR(sum[3] / DRAWS, 0.0, 0.004 * sqrt(15.0), "");
    ASSERT_NEAR(sum[4] / DRAWS, 3.0, 0.004 * sqrt(96.0), "");
    ASSERT_NEAR(lag / DRAWS, 0.0, 0.004, "");
}
END_TEST

/* Forty bins of 0.2 from -4 to 4, the outer ones open. */
START_TEST(normal_fills_its_bins)
{
    enum { BINS = 40 };
    insole_rng_t rng = seeded(7u);
    int counts[BINS] = {0};
    double expected[BINS];
    for (int i = 0; i < DRAWS; i++) {
        int bin = (int)floor((double)insole_rng_normal(&rng) / 0.2) + BINS / 2;
        counts[bin < 0 ? 0 : bin >= BINS ? BINS - 1 : bin]++;
    }
    for (int i = 0; i < BINS; i++) {
        double above = i == 0 ? 1.0 : normal_above(0.2 * (i - BINS / 2));
        double beyond = i == BINS - 1 ? 0.0 : normal_above(0.2 * (i + 1 - BINS / 2));
        expected[i] = DRAWS * (above - beyond);
    }
    ASSERT_NEAR(chi_square(counts, expected, BINS), 39.0, 4.0 * sqrt(78.0), "");
}
END_TEST

/* Counts beyond each limit, on either side, against the exact probability. */
START_TEST(normal_is_right_in_the_tails)
{
    static const double LIMITS[] = {3.0, 3.5, 4.0, 4.5, 5.0};
    enum { LIMIT_COUNT = sizeof LIMITS / sizeof LIMITS[0] };
    insole_rng_t rng = seeded(8u);
    int above[LIMIT_COUNT] = {0}, below[LIMIT_COUNT] = {0};
    for (int i = 0; i < TAIL_DRAWS; i++) {
        double z = (double)insole_rng_normal(&rng);
        for (int k = 0; k < LIMIT_COUNT && fabs(z) > LIMITS[k]; k++) {
            above[k] += z > 0.0;
            below[k] += z < 0.0;
        }
    }
    for (int k = 0; k < LIMIT_COUNT; k++) {
        double expected = TAIL_DRAWS * normal_above(LIMITS[k]);
        ASSERT_NEAR(above[k], expected, 4.0 * sqrt(expected), "draws");
        ASSERT_NEAR(below[k], expected, 4.0 * sqrt(expected), "draws");
    }
}
END_TEST

/* A share of 0 bits gives the farthest number there is, one of all bits the middle. */
START_TEST(normal_is_finite_at_its_ends)
{
    insole_rng_t farthest = {{0u, 1u, 1u, 0u}}, middle = {{0xffffffffu, 1u, 1u, 1u}};
    insole_rng_t second = farthest;
    (void)insole_rng_bits(&second);
    double angle = 6.283185307179586 * (double)insole_rng_uniform(&second);
    double radius = sqrt(2.0 * 33.0 * log(2.0));
    ASSERT_NEAR(insole_rng_normal(&farthest), radius * cos(angle), 1e-5, "sigma");
    ASSERT_NEAR(insole_rng_normal(&middle), 0.0, 1e-4, "sigma");
}
END_TEST

/* Both against Box and Muller's formula in double, of the same bits. Of shares near one the float
 * has lost what is left to them, hence the second term. */
START_TEST(normals_are_those_of_the_formula)
{
    insole_rng_t rng = seeded(13u);
    worst_t off = {0.0, 0.0};
    for (int i = 0; i < DRAWS; i++) {
        insole_rng_t same = rng;
        double share = ((double)insole_rng_bits(&same) + 0.5) / 4294967296.0;
        double angle = 6.283185307179586 * (double)insole_rng_bits(&same) / 4294967296.0;
        double radius = sqrt(-2.0 * log(share));
        double allowed = 6e-6 * radius + 1.2e-7 / fmax(radius, 1e-4);
        insole_normals_t both = insole_rng_normals(&rng);
        worst_note(&off, fabs((double)both.first - radius * cos(angle)) / allowed, i);
        worst_note(&off, fabs((double)both.second - radius * sin(angle)) / allowed, i);
    }
    ASSERT_WORST(off, 1.0, "of what is allowed");
}
END_TEST

/* The first is the one that a single draw gives; as much is drawn. */
START_TEST(the_first_of_two_normals_is_the_single_one)
{
    insole_rng_t pair = seeded(11u), single = seeded(11u);
    worst_t same = {0.0, 0.0};
    for (int i = 0; i < 10000; i++) {
        insole_real_t alone = insole_rng_normal(&single);
        insole_normals_t both = insole_rng_normals(&pair);
        worst_require(&same, memcmp(&both.first, &alone, sizeof alone) == 0, i);
    }
    ASSERT_ALL_HELD(same);
    ck_assert_int_eq(memcmp(&pair, &single, sizeof pair), 0);
}
END_TEST

/* Mean, variance and fourth moment of the second, and nothing in common with the first: not even
 * their squares have. */
START_TEST(the_second_of_two_normals_is_normal_and_independent)
{
    insole_rng_t rng = seeded(12u);
    double mean = 0.0, square = 0.0, fourth = 0.0, product = 0.0, squares = 0.0;
    for (int i = 0; i < DRAWS; i++) {
        insole_normals_t both = insole_rng_normals(&rng);
        double a = (double)both.first, b = (double)both.second;
        mean += b / DRAWS;
        square += b * b / DRAWS;
        fourth += b * b * b * b / DRAWS;
        product += a * b / DRAWS;
        squares += (a * a - 1.0) * (b * b - 1.0) / DRAWS;
    }
    double sigma = 1.0 / sqrt((double)DRAWS); /* four of them each */
    ASSERT_NEAR(mean, 0.0, 4.0 * sigma, "");
    ASSERT_NEAR(square, 1.0, 4.0 * sqrt(2.0) * sigma, "");
    ASSERT_NEAR(fourth, 3.0, 4.0 * sqrt(96.0) * sigma, "");
    ASSERT_NEAR(product, 0.0, 4.0 * sigma, "");
    ASSERT_NEAR(squares, 0.0, 4.0 * 2.0 * sigma, "");
}
END_TEST

START_TEST(a_copied_state_goes_on_alike)
{
    insole_rng_t rng = seeded(9u);
    for (int i = 0; i < 17; i++) {
        (void)insole_rng_normal(&rng);
    }
    insole_rng_t saved = rng;
    for (int i = 0; i < 1000; i++) {
        insole_real_t a = insole_rng_normal(&rng), b = insole_rng_normal(&saved);
        ck_assert_int_eq(memcmp(&a, &b, sizeof a), 0);
    }
    ck_assert_int_eq(memcmp(&rng, &saved, sizeof rng), 0);
}
END_TEST

/* Whatever comes out, a uniform takes one draw and a normal two. */
START_TEST(calls_draw_a_fixed_number_of_bits)
{
    insole_rng_t normal = seeded(10u), bits = seeded(10u);
    for (int i = 0; i < 1000; i++) {
        (void)insole_rng_normal(&normal);
        (void)insole_rng_uniform(&normal);
        for (int k = 0; k < 3; k++) {
            (void)insole_rng_bits(&bits);
        }
        ck_assert_int_eq(memcmp(&normal, &bits, sizeof normal), 0);
    }
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("rng");
    suite_add(suite, "published generator", bits_are_those_of_the_published_generator);
    suite_add_loop(suite, "known sequences", seeds_give_the_known_sequences, 3);
    suite_add(suite, "neighbouring seeds", neighbouring_seeds_have_nothing_in_common);
    suite_add(suite, "fair bits", each_bit_is_fair);
    suite_add(suite, "uniform moments", uniform_has_the_right_range_and_moments);
    suite_add(suite, "uniform ends", uniform_reaches_its_ends_but_never_one);
    suite_add(suite, "uniform pairs", uniform_pairs_fill_the_square_evenly);
    suite_add(suite, "normal moments", normal_has_the_right_moments);
    suite_add(suite, "normal bins", normal_fills_its_bins);
    suite_add(suite, "normal tails", normal_is_right_in_the_tails);
    suite_add(suite, "normal ends", normal_is_finite_at_its_ends);
    suite_add(suite, "formula", normals_are_those_of_the_formula);
    suite_add(suite, "first of two normals", the_first_of_two_normals_is_the_single_one);
    suite_add(suite, "second of two normals", the_second_of_two_normals_is_normal_and_independent);
    suite_add(suite, "copied state", a_copied_state_goes_on_alike);
    suite_add(suite, "draws per call", calls_draw_a_fixed_number_of_bits);
    return suite;
}
