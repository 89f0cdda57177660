/* SPDX-License-Identifier: MIT */
#include "insole/sense/hold.h"

#include <string.h>

#include "suite.h"

static const insole_real_t LIMIT = INSOLE_R(10.0);

static insole_real_t *axis_of(insole_vec3_t *v, int axis)
{
    insole_real_t *axes[] = {&v->x, &v->y, &v->z};
    return axes[axis];
}

/* Each set of axes by itself: bit m of _i says whether axis m cannot be. */
START_TEST(axes_that_cannot_be_hold_the_value_before)
{
    static const double BAD[] = {10.001,           -10.001,           1.0e30,
                                 (double)INFINITY, -(double)INFINITY, (double)NAN};
    for (int b = 0; b < (int)(sizeof BAD / sizeof BAD[0]); b++) {
        insole_vec3_t last = insole_vec3(1, 2, 3), v = insole_vec3(-4, -5, -6), expected = v;
        for (int axis = 0; axis < 3; axis++) {
            if ((_i >> axis & 1) != 0) {
                *axis_of(&v, axis) = (insole_real_t)BAD[b];
                *axis_of(&expected, axis) = *axis_of(&last, axis);
            }
        }
        ck_assert_int_eq(insole_hold(&v, last, LIMIT), _i != 0);
        ck_assert_int_eq(memcmp(&v, &expected, sizeof v), 0);
    }
}
END_TEST

/* What was before stands, whatever it is: nothing better is known. */
START_TEST(the_limit_itself_may_be)
{
    insole_vec3_t last = insole_vec3((double)NAN, 2, 3), v = insole_vec3(10, -10, 0), kept = v;
    ck_assert(!insole_hold(&v, last, LIMIT));
    ck_assert_int_eq(memcmp(&v, &kept, sizeof v), 0);
    v.x = 11;
    ck_assert(insole_hold(&v, last, LIMIT));
    ck_assert(!insole_is_finite(v.x));
    ck_assert(!insole_hold(NULL, last, LIMIT));
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("hold");
    suite_add_loop(suite, "axes", axes_that_cannot_be_hold_the_value_before, 8);
    suite_add(suite, "limit", the_limit_itself_may_be);
    return suite;
}
