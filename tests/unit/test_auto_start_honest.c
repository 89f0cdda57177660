/* SPDX-License-Identifier: MIT
 * Whether a start by radio knows how wrong it is, where nothing is as the estimator takes it to be:
 * the errors of fixes are a field over the floor that stays and a crowd that comes and goes, 3.6 m
 * together, as in a mall that was measured, and noise with a heavy tail; they come when they like,
 * late, and tell their own size badly. The walker goes along corridors, with steps of his own
 * length; his gyroscope drifts, and iron turns his compass. */
#include "insole/fuse/auto_start.h"

#include "insole/fuse/walker_filter.h"
#include "near.h"
#include "plane.h"
#include "suite.h"

#define PI 3.14159265358979323846

enum { STARTS = 500, WAVES = 8 };

static insole_rng_t rng;

static double uniform(double low, double high)
{
    return low + (high - low) * (double)insole_rng_bits(&rng) / 4294967296.0;
}

static double normal(double sigma)
{
    return sigma * (double)insole_rng_normal(&rng);
}

/* ---- radio ---------------------------------------------------------------------------------- */

/* Waves of 15 to 60 m, a sum of which is what radio is wrong by at a place. */
typedef struct {
    double x[WAVES], y[WAVES], phase_x[WAVES], phase_y[WAVES];
} field_t;

static field_t make_field(void)
{
    field_t field;
    for (int i = 0; i < WAVES; i++) {
        double wave = 2.0 * PI / uniform(15.0, 60.0), direction = uniform(-PI, PI);
        field.x[i] = wave * cos(direction);
        field.y[i] = wave * sin(direction);
        field.phase_x[i] = uniform(-PI, PI);
        field.phase_y[i] = uniform(-PI, PI);
    }
    return field;
}

/* @param rms  of each coordinate */
static point_t field_at(const field_t *field, point_t at, double rms)
{
    point_t sum = {0.0, 0.0};
    for (int i = 0; i < WAVES; i++) {
        double along = field->x[i] * at.x + field->y[i] * at.y;
        sum.x += rms * sqrt(2.0 / WAVES) * sin(along + field->phase_x[i]);
        sum.y += rms * sqrt(2.0 / WAVES) * sin(along + field->phase_y[i]);
    }
    return sum;
}

/* ---- a walk --------------------------------------------------------------------------------- */

typedef struct {
    field_t field;
    point_t at, crowd;
    double t, crowd_until, next_scan, step_s;
    double offset, drift; /* heading in m less heading in n, and its rate */
    double psi, length, told_length;
    uint32_t since_turn;
} walk_t;

static walk_t begin_walk(void)
{
    walk_t w = {.field = make_field()};
    w.at.x = uniform(-50.0, 50.0);
    w.at.y = uniform(-50.0, 50.0);
    w.offset = uniform(-PI, PI);
    w.drift = normal(0.003);
    w.psi = uniform(-PI, PI);
    w.step_s = uniform(0.45, 0.65);
    w.length = 0.65;
    w.told_length = w.length * uniform(0.85, 1.15);
    w.next_scan = uniform(0.5, 3.0);
    return w;
}

/* @return what the phone tells of the step */
static insole_pace_t go(walk_t *w)
{
    w->t += w->step_s;
    w->offset += w->drift * w->step_s;
    if (++w->since_turn > 8u && uniform(0.0, 1.0) < 0.07) {
        w->psi += uniform(0.0, 1.0) < 0.5 ? PI / 2.0 : -PI / 2.0;
        w->since_turn = 0u;
    }
    if (w->t > w->crowd_until) {
        w->crowd_until = w->t + uniform(5.0, 25.0);
        w->crowd.x = normal(2.0);
        w->crowd.y = normal(2.0);
    }
    double length = w->length * uniform(0.85, 1.15), psi = w->psi + uniform(-0.1, 0.1);
    w->at.x += length * cos(psi);
    w->at.y += length * sin(psi);
    insole_pace_t pace = {(insole_real_t)w->told_length, (insole_real_t)(w->psi - w->offset), 0,
                          INSOLE_R(0.01)};
    return pace;
}

/* A fix of where the walker was a step ago; told is the way since, and a size that is up to 30 %
 * wrong. */
static insole_spot_fix_t hear(const walk_t *w, point_t then, const insole_pace_t *pace)
{
    point_t b = field_at(&w->field, then, 3.0);
    double sigma = uniform(0.0, 1.0) < 0.1 ? 6.0 : 2.5, told = 3.0 * uniform(0.7, 1.3);
    double ahead_x = cos(w->psi), ahead_y = sin(w->psi);
    insole_spot_fix_t fix = {(uint64_t)llround(1e6 * w->t),
                             {(insole_real_t)(then.x + b.x + w->crowd.x + normal(sigma) + ahead_x),
                              (insole_real_t)(then.y + b.y + w->crowd.y + normal(sigma) + ahead_y)},
                             insole_sym2_circle((insole_real_t)(told * told)),
                             insole_pace_way(pace, 0)};
    return fix;
}

/* ---- starts --------------------------------------------------------------------------------- */

typedef struct {
    uint32_t fixes;
    bool has_compass;
    uint32_t more; /* fixes that the filter takes from then on */
} plot_t;

static const plot_t PLOTS[] = {
    {1u, true, 0u},  {3u, true, 0u}, {5u, true, 0u},  {1u, false, 0u}, {5u, false, 0u},
    {8u, false, 0u}, {1u, true, 4u}, {5u, true, 10u}, {8u, false, 6u}, {12u, true, 0u},
};

enum { PLOT_COUNT = sizeof PLOTS / sizeof PLOTS[0] };

typedef struct {
    double place, direction;
} nees_t;

static double squares_of(point_t truth, insole_spot_t spot, insole_sym2_t cov_m2)
{
    point_t e = {(double)spot.x_m - truth.x, (double)spot.y_m - truth.y};
    return plane_form(plane_inverse(plane_of(cov_m2)), e);
}

static double turned(double truth, insole_real_t offset_rad, insole_real_t var_rad2)
{
    double off = remainder((double)offset_rad - truth, 2.0 * PI);
    return off * off / (double)var_rad2;
}

/* Steps up to the next fix. */
static insole_spot_fix_t walk_on(walk_t *w, insole_auto_start_t *start, insole_walker_ekf_t *filter)
{
    for (;;) {
        point_t then = w->at;
        insole_pace_t pace = go(w);
        ck_assert_int_eq(filter ? insole_walker_filter_calls.step(filter, 0u, &pace)
                                : insole_auto_start_step(start, &pace),
                         INSOLE_OK);
        if (w->t >= w->next_scan) {
            w->next_scan = w->t + uniform(1.0, 3.0);
            return hear(w, then, &pace);
        }
    }
}

static insole_auto_start_answer_t find(walk_t *w, const plot_t *plot)
{
    insole_auto_start_t start;
    insole_auto_start_answer_t answer;
    ck_assert_int_eq(insole_auto_start_init(&start, &insole_auto_start_defaults, NULL), INSOLE_OK);
    if (plot->has_compass) {
        insole_real_t told = (insole_real_t)(w->offset + uniform(-0.4, 0.4)); /* 0.23 rms */
        ck_assert_int_eq(insole_auto_start_compass(&start, told, INSOLE_R(0.25)), INSOLE_OK);
    }
    for (uint32_t k = 0u; k < plot->fixes; k++) {
        insole_spot_fix_t fix = walk_on(w, &start, NULL);
        ck_assert_int_eq(insole_auto_start_fix(&start, &fix), INSOLE_OK);
    }
    ck_assert_int_eq(insole_auto_start_answer(&start, &answer), INSOLE_OK);
    return answer;
}

static nees_t follow(walk_t *w, const insole_auto_start_answer_t *found, uint32_t fixes)
{
    const insole_step_filter_calls_t *calls = &insole_walker_filter_calls;
    const insole_step_filter_begin_t at = {
        (uint64_t)llround(1e6 * w->t), found->spot, found->cov_m2,   found->offset_rad,
        found->var_offset_rad2,        true,        found->shared_m2};
    insole_step_filter_answer_t answer;
    insole_walker_ekf_t filter;
    ck_assert_int_eq(insole_walker_ekf_init(&filter, &insole_walker_ekf_defaults), INSOLE_OK);
    ck_assert_int_eq(calls->start(&filter, &at), INSOLE_OK);
    for (uint32_t k = 0u; k < fixes; k++) {
        insole_spot_fix_t fix = walk_on(w, NULL, &filter);
        ck_assert_int_eq(calls->fix(&filter, &fix), INSOLE_OK);
    }
    ck_assert_int_eq(calls->answer(&filter, &answer), INSOLE_OK);
    nees_t nees = {squares_of(w->at, answer.spot, answer.cov_m2),
                   turned(w->offset, answer.offset_rad, answer.var_offset_rad2)};
    return nees;
}

START_TEST(a_start_knows_how_wrong_it_is)
{
    const plot_t *plot = &PLOTS[_i];
    nees_t sum = {0.0, 0.0};
    insole_rng_seed(&rng, 100u + (uint64_t)_i);
    for (int i = 0; i < STARTS; i++) {
        walk_t walk = begin_walk();
        insole_auto_start_answer_t found = find(&walk, plot);
        nees_t nees = {squares_of(walk.at, found.spot, found.cov_m2),
                       turned(walk.offset, found.offset_rad, found.var_offset_rad2)};
        nees = plot->more > 0u ? follow(&walk, &found, plot->more) : nees;
        sum.place += nees.place / STARTS;
        sum.direction += nees.direction / STARTS;
    }
    ASSERT_AT_LEAST(sum.place, 1.5, "");
    ASSERT_AT_MOST(sum.place, 3.0, "");
    ASSERT_AT_MOST(sum.direction, 1.5, "");
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("auto_start_honest");
    suite_add_loop(suite, "honest", a_start_knows_how_wrong_it_is, PLOT_COUNT);
    return suite;
}
