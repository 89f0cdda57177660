/* SPDX-License-Identifier: MIT */
#include "insole/sense/spike.h"

#include <string.h>

#include "near.h"
#include "sample.h"
#include "suite.h"

static const insole_real_t LIMIT = INSOLE_R(10.0);

static insole_vec3_t on_axis(int axis, double value)
{
    insole_real_t v[3] = {INSOLE_R(0.0), INSOLE_R(0.0), INSOLE_R(0.0)};
    v[axis] = (insole_real_t)value;
    return insole_vec3(v[0], v[1], v[2]);
}

/* What becomes of `middle` on one axis. */
static double mended(int axis, double before, double middle, double after, bool *spike)
{
    insole_vec3_t v = on_axis(axis, middle);
    *spike = insole_spike_mend(on_axis(axis, before), &v, on_axis(axis, after), LIMIT);
    return (double)(axis == 0 ? v.x : axis == 1 ? v.y : v.z);
}

START_TEST(a_spike_gets_the_mean_of_its_neighbours)
{
    bool spike;
    ASSERT_NEAR(mended(_i, 1.0, 20.0, 2.0, &spike), 1.5, 1e-6, "");
    ck_assert(spike);
    ASSERT_NEAR(mended(_i, 1.0, -20.0, 2.0, &spike), 1.5, 1e-6, "");
    ck_assert(spike);
}
END_TEST

typedef struct {
    double before, middle, after;
} triple_t;

static const triple_t NONE[] = {
    {0.0, 0.0, 0.0},   {1.0, 10.875, 1.0}, /* not far enough */
    {0.0, 20.0, 40.0}, {40.0, 20.0, 0.0},  /* on the way */
    {0.0, 20.0, 9.0},  {9.0, 20.0, 0.0},   /* one side near */
    {0.0, 20.0, 4.0},  {-4.0, -20.0, 0.0}, /* neighbours not close enough together */
};

START_TEST(what_is_no_spike_stays)
{
    for (int axis = 0; axis < 3; axis++) {
        bool spike;
        const triple_t *t = &NONE[_i];
        ASSERT_NEAR(mended(axis, t->before, t->middle, t->after, &spike), t->middle, 0.0, "");
        ck_assert(!spike);
    }
}
END_TEST

START_TEST(other_axes_stay)
{
    insole_vec3_t before = insole_vec3(INSOLE_R(1.0), INSOLE_R(2.0), INSOLE_R(3.0));
    insole_vec3_t middle = insole_vec3(INSOLE_R(1.5), INSOLE_R(52.0), INSOLE_R(3.5));
    ck_assert(insole_spike_mend(before, &middle, before, LIMIT));
    ASSERT_NEAR(middle.x, 1.5, 0.0, "");
    ASSERT_NEAR(middle.y, 2.0, 0.0, "");
    ASSERT_NEAR(middle.z, 3.5, 0.0, "");
}
END_TEST

/* The rule once more, told by the two distances; none of the random cases lies on a border. */
static bool is_spike(double before, double middle, double after)
{
    double rise = middle - before, fall = middle - after;
    double least = fmin(fabs(rise), fabs(fall));
    return rise * fall > 0.0 && least > (double)LIMIT && fabs(after - before) < 0.25 * least;
}

START_TEST(random_ones_against_the_rule)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 11u);
    worst_t alike = {0.0, 0.0};
    int spikes = 0;
    for (int i = 0; i < 20000; i++) {
        insole_vec3_t a = sample_vec3(&rng, INSOLE_R(5.0)), c = sample_vec3(&rng, INSOLE_R(5.0));
        insole_vec3_t b = sample_vec3(&rng, INSOLE_R(30.0)), was = b;
        bool x = is_spike((double)a.x, (double)b.x, (double)c.x);
        bool y = is_spike((double)a.y, (double)b.y, (double)c.y);
        bool z = is_spike((double)a.z, (double)b.z, (double)c.z);
        bool told = insole_spike_mend(a, &b, c, LIMIT);
        worst_require(&alike, told == (x || y || z), i);
        worst_require(&alike, x == (b.x < was.x || b.x > was.x), i);
        worst_require(&alike, y == (b.y < was.y || b.y > was.y), i);
        worst_require(&alike, z == (b.z < was.z || b.z > was.z), i);
        bool may_be = insole_spike_may_be(&a, &was, LIMIT);
        worst_require(&alike, may_be || !told, i);
        spikes += told ? 1 : 0;
    }
    ASSERT_ALL_HELD(alike);
    ck_assert_int_gt(spikes, 1000);
}
END_TEST

START_TEST(nothing_to_mend)
{
    ck_assert(!insole_spike_mend(insole_vec3_zero(), NULL, insole_vec3_zero(), LIMIT));
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("spike");
    suite_add_loop(suite, "spike", a_spike_gets_the_mean_of_its_neighbours, 3);
    suite_add_loop(suite, "none", what_is_no_spike_stays, sizeof NONE / sizeof NONE[0]);
    suite_add(suite, "axes", other_axes_stay);
    suite_add(suite, "random", random_ones_against_the_rule);
    suite_add(suite, "null", nothing_to_mend);
    return suite;
}
