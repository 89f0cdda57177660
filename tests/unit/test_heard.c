/* SPDX-License-Identifier: MIT */
#include "insole/place/heard.h"

#include <string.h>

#include "insole/base/rng.h"
#include "near.h"
#include "refusal.h"
#include "suite.h"

enum { MAX = INSOLE_HEARD_MAX, MANY = 2500, APS = 900 };

static insole_heard_t heard;
static insole_rss_t readings[MANY];
static insole_rng_t rng;

static insole_rss_t reading(uint32_t id, double dbm, double age_s)
{
    insole_rss_t r = {id, (insole_real_t)dbm, (uint32_t)(age_s * 1e6)};
    return r;
}

static void gather(uint32_t count)
{
    ck_assert_int_eq(insole_heard_gather(&heard, APS, 3500000u, readings, count), INSOLE_OK);
}

START_TEST(sorted_each_once)
{
    readings[0] = reading(9, -60, 0);
    readings[1] = reading(3, -70, 1);
    readings[2] = reading(9, -55, 3.5);
    readings[3] = reading(3, -75, 0);
    readings[4] = reading(0, -80, 2);
    gather(5);
    ck_assert_uint_eq(heard.count, 3u);
    ck_assert_uint_eq(insole_heard_passing(APS, 3500000u, readings, 5), 5u);
    static const uint16_t ids[] = {0, 3, 9};
    static const double dbm[] = {-80, -70, -55};
    for (int i = 0; i < 3; i++) {
        ck_assert_uint_eq(heard.ap[i], ids[i]);
        ASSERT_NEAR(heard.dbm[i], dbm[i], 0.0, "dBm");
    }
}
END_TEST

START_TEST(what_is_left_out)
{
    const insole_rss_t bad[] = {reading(APS, -50, 0),
                                reading(UINT32_MAX, -50, 0),
                                reading(65536u, -50, 0),
                                reading(5, (double)NAN, 0),
                                reading(5, (double)INFINITY, 0),
                                reading(5, -(double)INFINITY, 0),
                                reading(5, -127.5, 0),
                                reading(5, 0.5, 0),
                                reading(5, -50, 3.6)};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        readings[0] = reading(1, -127, 0);
        readings[1] = bad[i];
        readings[2] = reading(2, 0, 3.5);
        ck_assert_uint_eq(insole_heard_passing(APS, 3500000u, readings, 3), 2u);
        gather(3);
        ck_assert_uint_eq(heard.count, 2u);
    }
    readings[0] = reading(65536u, -50, 0);
    ck_assert_uint_eq(insole_heard_passing(UINT32_MAX, 3500000u, readings, 1), 0u);
}
END_TEST

/* Against a table over all access points, of which the strongest are picked one by one. */
START_TEST(of_too_many_the_strongest)
{
    insole_rng_seed(&rng, 11u);
    for (int round = 0; round < 50; round++) {
        static double table[APS];
        double kept[APS];
        uint32_t distinct = 0, stay = 0;
        for (int i = 0; i < APS; i++) {
            table[i] = -200.0;
            kept[i] = -200.0;
        }
        for (int i = 0; i < MANY; i++) { /* distinct strengths: no ties */
            uint32_t id = insole_rng_bits(&rng) % APS;
            readings[i] = reading(id, -20.0 - 0.0625 * (insole_rng_bits(&rng) % 8u) - 0.1 * id, 0);
            table[id] = fmax(table[id], (double)readings[i].rss_dbm);
        }
        for (int i = 0; i < APS; i++) {
            distinct += table[i] > -200.0 ? 1u : 0u;
        }
        for (; stay < MAX && stay < distinct; stay++) {
            int best = 0;
            for (int i = 0; i < APS; i++) {
                best = table[i] > table[best] ? i : best;
            }
            kept[best] = table[best];
            table[best] = -200.0;
        }
        gather(MANY);
        ck_assert_uint_eq(heard.count, stay);
        ck_assert_uint_gt(distinct, (unsigned)MAX);
        worst_t wrong = {0.0, 0.0};
        for (uint32_t i = 0; i < heard.count; i++) {
            worst_note(&wrong, fabs((double)heard.dbm[i] - kept[heard.ap[i]]), heard.ap[i]);
            worst_require(&wrong, i == 0u || heard.ap[i] > heard.ap[i - 1u], i);
        }
        ASSERT_WORST(wrong, 0.0, "dB");
    }
}
END_TEST

START_TEST(seeking)
{
    readings[0] = reading(10, -60, 0);
    readings[1] = reading(20, -70, 0);
    gather(2);
    uint32_t at = 0;
    ck_assert(!insole_heard_seek(&heard, &at, 5));
    ck_assert(insole_heard_seek(&heard, &at, 10));
    ASSERT_NEAR(heard.dbm[at], -60.0, 0.0, "dBm");
    ck_assert(!insole_heard_seek(&heard, &at, 15));
    ck_assert(insole_heard_seek(&heard, &at, 20));
    ck_assert_uint_eq(at, 1u);
    ck_assert(!insole_heard_seek(&heard, &at, 30));
    ck_assert_uint_eq(at, 2u);
}
END_TEST

START_TEST(refusals)
{
    memset(&heard, 0x5a, sizeof heard);
    ck_assert_int_eq(insole_heard_gather(NULL, APS, 0, readings, 1), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(heard, insole_heard_gather(&heard, APS, 0, NULL, 1), INSOLE_ERR_NULL);
    ck_assert_uint_eq(insole_heard_passing(APS, 0, NULL, 3), 0u);
    gather(0);
    ck_assert_uint_eq(heard.count, 0u);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("heard");
    suite_add(suite, "sorted, each once", sorted_each_once);
    suite_add(suite, "what is left out", what_is_left_out);
    suite_add(suite, "of too many the strongest", of_too_many_the_strongest);
    suite_add(suite, "seeking", seeking);
    suite_add(suite, "refusals", refusals);
    return suite;
}
