/* SPDX-License-Identifier: MIT */
#include "insole/place/radio_solver.h"

#include "fingerprints.h"
#include "insole/place/kde_fix.h"
#include "insole/place/ml_fix.h"
#include "near.h"
#include "suite.h"

enum { APS = 60 };

static prints_t prints;
static insole_rss_t readings[APS];
static insole_kde_fix_t kde;
static insole_ml_fix_t ml;

static insole_radio_solver_t solver_of(int row)
{
    const insole_radio_solver_t solvers[] = {{&insole_kde_fix_calls, &kde},
                                             {&insole_ml_fix_calls, &ml}};
    ck_assert_int_eq(insole_kde_fix_init(&kde, &insole_kde_fix_defaults), INSOLE_OK);
    ck_assert_int_eq(insole_ml_fix_init(&ml, &insole_ml_fix_defaults), INSOLE_OK);
    prints_hall(&prints, APS, 0.0, 0.0);
    return solvers[row];
}

/* Through the face alone, in slices, each places a scan where it was heard. */
START_TEST(every_solver_places_a_scan)
{
    insole_radio_solver_t solver = solver_of(_i);
    insole_radio_fix_t fix;
    insole_rng_t rng;
    insole_rng_seed(&rng, 4u);
    for (int i = 0; i < 8; i++) {
        double x_m = 6.0 + 4.0 * i, y_m = 30.0 - 3.0 * i;
        uint32_t count = prints_listen(&rng, APS, x_m, y_m, 1.0, 0.0, readings);
        ck_assert_int_eq(solver.calls->begin(solver.state, &prints.map, NULL, readings, count),
                         INSOLE_OK);
        ck_assert_int_eq(solver.calls->finish(solver.state, &prints.map, &fix), INSOLE_ERR_STATE);
        while (solver.calls->work(solver.state, &prints.map, 5u)) {
        }
        ck_assert_int_eq(solver.calls->finish(solver.state, &prints.map, &fix), INSOLE_OK);
        ASSERT_AT_MOST(hypot((double)fix.spot.x_m - x_m, (double)fix.spot.y_m - y_m), 7.0, "m");
    }
}
END_TEST

START_TEST(every_solver_refuses_a_scan_of_nothing)
{
    insole_radio_solver_t solver = solver_of(_i);
    insole_radio_fix_t fix;
    ck_assert_int_eq(solver.calls->begin(solver.state, &prints.map, NULL, readings, 0u),
                     INSOLE_ERR_STATE);
    ck_assert(!solver.calls->work(solver.state, &prints.map, 5u));
    ck_assert_int_eq(solver.calls->finish(solver.state, &prints.map, &fix), INSOLE_ERR_STATE);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("radio_solver");
    suite_add_loop(suite, "places", every_solver_places_a_scan, 2);
    suite_add_loop(suite, "nothing heard", every_solver_refuses_a_scan_of_nothing, 2);
    return suite;
}
