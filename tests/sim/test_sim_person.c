/* SPDX-License-Identifier: MIT */
#include "sim/person.h"

#include "near.h"
#include "suite.h"

enum { PEOPLE = 4000 };

/* Mean and standard deviation of one member over many people. */
typedef struct {
    double sum, squares, least, most;
} moments_t;

static void note(moments_t *m, double value)
{
    m->sum += value / PEOPLE;
    m->squares += value * value / PEOPLE;
    m->least = fmin(m->least, value);
    m->most = fmax(m->most, value);
}

static double sigma_of(const moments_t *m)
{
    return sqrt(m->squares - m->sum * m->sum);
}

START_TEST(people_differ_as_told)
{
    sim_person_settings_t s = sim_settings_defaults.person;
    s.leg_spread = 0.06;
    s.step_spread = 0.0;
    s.bounce_spread = 0.2;
    moments_t leg = {0.0, 0.0, 10.0, 0.0}, bounce = leg, ratio = leg;
    for (uint64_t seed = 1; seed <= PEOPLE; seed++) {
        sim_person_t person = sim_person(&s, seed);
        note(&leg, person.leg_m / s.leg_m);
        note(&bounce, person.bounce / s.bounce);
        note(&ratio, person.steps / (person.leg_m / s.leg_m));
    }
    /* a normal distribution cut at two sigmas and put on its ends has 0.959 of its sigma */
    ASSERT_NEAR(leg.sum, 1.0, 0.004, "1");
    ASSERT_NEAR(sigma_of(&leg), 0.959 * 0.06, 0.003, "1");
    ASSERT_NEAR(sigma_of(&bounce), 0.959 * 0.2, 0.01, "1");
    ASSERT_AT_LEAST(leg.least, 0.88 - 1e-6, "1");
    ASSERT_AT_MOST(leg.most, 1.12 + 1e-6, "1");
    ASSERT_NEAR(ratio.least, 1.0, 1e-9, "1"); /* steps go with the leg */
    ASSERT_NEAR(ratio.most, 1.0, 1e-9, "1");
}
END_TEST

START_TEST(habit_changes_steps_alone)
{
    sim_person_settings_t with = sim_settings_defaults.person, without = with;
    without.step_spread = 0.0;
    double differ = 0.0;
    for (uint64_t seed = 1; seed <= 50; seed++) {
        sim_person_t a = sim_person(&with, seed), b = sim_person(&without, seed);
        ck_assert(a.leg_m == b.leg_m && a.bounce == b.bounce);
        differ = fmax(differ, fabs(a.steps - b.steps));
    }
    ASSERT_AT_LEAST(differ, 0.05, "1");
}
END_TEST

START_TEST(equal_seeds_are_one_person)
{
    sim_person_t a = sim_person(&sim_settings_defaults.person, 5);
    sim_person_t b = sim_person(&sim_settings_defaults.person, 5);
    sim_person_t c = sim_person(&sim_settings_defaults.person, 6);
    ck_assert(a.leg_m == b.leg_m && a.steps == b.steps && a.bounce == b.bounce);
    ck_assert(a.leg_m != c.leg_m && a.steps != c.steps && a.bounce != c.bounce);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("sim/person");
    suite_add(suite, "spread", people_differ_as_told);
    suite_add(suite, "habit", habit_changes_steps_alone);
    suite_add(suite, "seeds", equal_seeds_are_one_person);
    return suite;
}
