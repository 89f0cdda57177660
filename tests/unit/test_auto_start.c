/* SPDX-License-Identifier: MIT */
#include "insole/fuse/auto_start.h"

#include "insole/base/snapshot.h"
#include "near.h"
#include "plane.h"
#include "refusal.h"
#include "setting.h"
#include "suite.h"

#define PI  3.14159265358979323846
#define EPS ((double)INSOLE_REAL_EPSILON)

/* The settings, but that a fix speaks of where the walker is. */
static insole_auto_start_config_t plain;

/* A generator of its own, so that nothing is shared with what is tested. */
typedef struct {
    uint64_t state;
} dice_t;

static double dice_uniform(dice_t *dice)
{
    dice->state += 0x9e3779b97f4a7c15u;
    uint64_t z = dice->state;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return ((double)((z ^ (z >> 31)) >> 11) + 0.5) / 9007199254740992.0;
}

static double dice_normal(dice_t *dice)
{
    double r = sqrt(-2.0 * log(dice_uniform(dice)));
    return r * cos(2.0 * PI * dice_uniform(dice));
}

static point_t dice_point(dice_t *dice, double sigma)
{
    double x = sigma * dice_normal(dice);
    point_t p = {x, sigma * dice_normal(dice)};
    return p;
}

/* ---- a walk that starts somewhere ---------------------------------------------------------- */

enum { MOST_FIXES = 16, STEP_US = 500000 };

typedef struct {
    int fixes;
    double gap_s;   /**< between fixes */
    double bias_m;  /**< of the fixes, lasting 15 s */
    double sigma_m; /**< of each fix, beside that */
    double scale;   /**< 1-sigma of the lengths' common error */
    double compass; /**< 1-sigma; 0: none */
    double turns;   /**< rad a step */
    int32_t method;
} plot_t;

typedef struct {
    insole_auto_start_t start;
    insole_auto_start_answer_t answer;
    point_t truth; /**< now */
    point_t begin; /**< at the first fix */
    point_t first; /**< first fix */
    double offset;
} outcome_t;

static insole_auto_start_t begin_start(const insole_auto_start_config_t *config)
{
    insole_auto_start_t start;
    ck_assert_int_eq(insole_auto_start_init(&start, config, &insole_auto_start_circles), INSOLE_OK);
    return start;
}

static outcome_t play(const plot_t *plot, dice_t *dice)
{
    outcome_t o;
    insole_auto_start_config_t config = plain;
    config.bias_m = (insole_real_t)plot->bias_m;
    config.sigma_scale = (insole_real_t)plot->scale;
    config.method = plot->method;
    o.start = begin_start(&config);
    o.offset = PI * (2.0 * dice_uniform(dice) - 1.0);
    o.truth = dice_point(dice, 30.0);
    double psi = PI * (2.0 * dice_uniform(dice) - 1.0), t = 0.0, next = 0.1;
    double scale = 1.0 + plot->scale * dice_normal(dice);
    point_t bias = dice_point(dice, plot->bias_m);
    if (plot->compass > 0.0) {
        double told = o.offset + plot->compass * dice_normal(dice);
        ck_assert_int_eq(
            insole_auto_start_compass(&o.start, (insole_real_t)told, (insole_real_t)plot->compass),
            INSOLE_OK);
    }
    int heard = 0;
    while (heard < plot->fixes) {
        t += 0.5;
        psi += plot->turns;
        o.truth.x += 0.65 * cos(psi);
        o.truth.y += 0.65 * sin(psi);
        insole_pace_t pace = {(insole_real_t)(0.65 * scale), (insole_real_t)(psi - o.offset), 0, 0};
        ck_assert_int_eq(insole_auto_start_step(&o.start, &pace), INSOLE_OK);
        double left = exp(-0.5 / 15.0), fresh = plot->bias_m * sqrt(1.0 - left * left);
        bias.x = left * bias.x + fresh * dice_normal(dice);
        bias.y = left * bias.y + fresh * dice_normal(dice);
        if (t >= next) {
            next += plot->gap_s;
            point_t e = dice_point(dice, plot->sigma_m);
            point_t z = {o.truth.x + bias.x + e.x, o.truth.y + bias.y + e.y};
            insole_real_t variance = (insole_real_t)(plot->sigma_m * plot->sigma_m);
            insole_spot_fix_t fix = {(uint64_t)(t * 1.0e6),
                                     {(insole_real_t)z.x, (insole_real_t)z.y},
                                     insole_sym2_circle(variance),
                                     {0, 0}};
            ck_assert_int_eq(insole_auto_start_fix(&o.start, &fix), INSOLE_OK);
            o.begin = heard == 0 ? o.truth : o.begin;
            o.first = heard == 0 ? z : o.first;
            heard++;
        }
    }
    ck_assert_int_eq(insole_auto_start_answer(&o.start, &o.answer), INSOLE_OK);
    return o;
}

static double off_heading(const outcome_t *o)
{
    return fabs(remainder((double)o->answer.offset_rad - o->offset, 2.0 * PI));
}

/* ---- the least squares, dense and in double ------------------------------------------------ */

typedef struct {
    int n;
    double t[MOST_FIXES], var[MOST_FIXES];
    point_t way[MOST_FIXES], radio[MOST_FIXES];
} rows_t;

/* Lower root of the covariance of all fixes. */
static void root_of(const rows_t *rows, double bias_m, double L[MOST_FIXES][MOST_FIXES])
{
    for (int i = 0; i < rows->n; i++) {
        for (int k = 0; k <= i; k++) {
            double c = bias_m * bias_m * exp(-fabs(rows->t[i] - rows->t[k]) / 15.0);
            c += i == k ? rows->var[i] : 0.0;
            for (int j = 0; j < k; j++) {
                c -= L[i][j] * L[k][j];
            }
            L[i][k] = i == k ? sqrt(c) : c / L[k][k];
        }
    }
}

static void solve(int n, double L[MOST_FIXES][MOST_FIXES], double *v)
{
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < i; j++) {
            v[i] -= L[i][j] * v[j];
        }
        v[i] /= L[i][i];
    }
}

typedef struct {
    point_t begin;
    double squares, var_place;
} fit_t;

/* For one offset: the best place by least squares, and the sum of squares that is left. */
static fit_t fit(const rows_t *rows, double bias_m, double offset)
{
    double L[MOST_FIXES][MOST_FIXES], one[MOST_FIXES], x[MOST_FIXES], y[MOST_FIXES];
    root_of(rows, bias_m, L);
    for (int i = 0; i < rows->n; i++) {
        point_t w = rows->way[i];
        one[i] = 1.0;
        x[i] = rows->radio[i].x - cos(offset) * w.x + sin(offset) * w.y;
        y[i] = rows->radio[i].y - sin(offset) * w.x - cos(offset) * w.y;
    }
    solve(rows->n, L, one);
    solve(rows->n, L, x);
    solve(rows->n, L, y);
    fit_t f = {{0.0, 0.0}, 0.0, 0.0};
    double ones = 0.0;
    for (int i = 0; i < rows->n; i++) {
        ones += one[i] * one[i];
        f.begin.x += one[i] * x[i];
        f.begin.y += one[i] * y[i];
    }
    f.begin.x /= ones;
    f.begin.y /= ones;
    f.var_place = 1.0 / ones;
    for (int i = 0; i < rows->n; i++) {
        f.squares += pow(x[i] - one[i] * f.begin.x, 2.0) + pow(y[i] - one[i] * f.begin.y, 2.0);
    }
    return f;
}

START_TEST(it_is_generalised_least_squares)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 1u);
    worst_t place = {0.0, 0.0}, angle = {0.0, 0.0}, variance = {0.0, 0.0}, curve = {0.0, 0.0};
    for (int i = 0; i < 200; i++) {
        insole_auto_start_config_t config = plain;
        config.bias_m = sample_between(&rng, 0, 5);
        insole_auto_start_t start = begin_start(&config);
        rows_t rows = {2 + i % (MOST_FIXES - 1), {0.0}, {0.0}, {{0.0, 0.0}}, {{0.0, 0.0}}};
        uint64_t t_us = 0u;
        point_t walked = {0.0, 0.0};
        for (int k = 0; k < rows.n; k++) {
            insole_pace_t pace = {3, sample_between(&rng, -1, 1), 0, 0};
            ck_assert_int_eq(insole_auto_start_step(&start, &pace), INSOLE_OK);
            walked.x += 3.0 * cos((double)pace.heading_rad);
            walked.y += 3.0 * sin((double)pace.heading_rad);
            t_us += 500000u + insole_rng_bits(&rng) % 4000000u;
            insole_spot_fix_t fix = {t_us, insole_spot_add(start.way, sample_spot(&rng, 4)),
                                     insole_sym2_circle(sample_between(&rng, 1, 9)),
                                     sample_spot(&rng, 2)};
            ck_assert_int_eq(insole_auto_start_fix(&start, &fix), INSOLE_OK);
            rows.t[k] = (double)t_us * 1.0e-6;
            rows.var[k] = (double)fix.cov_m2.xx;
            rows.radio[k] = point_of(fix.spot);
            rows.way[k].x = walked.x - (double)fix.since.x_m;
            rows.way[k].y = walked.y - (double)fix.since.y_m;
        }
        point_t first = rows.way[0];
        for (int k = 0; k < rows.n; k++) {
            rows.way[k].x -= first.x;
            rows.way[k].y -= first.y;
        }
        double best = 0.0, least = 1.0e30, bias_m = (double)config.bias_m;
        for (double step = 0.1, from = -PI, to = PI; step > 1.0e-6; step *= 0.1) {
            for (double a = from; a <= to; a += step) {
                double squares = fit(&rows, bias_m, a).squares;
                if (squares < least) {
                    least = squares;
                    best = a;
                }
            }
            from = best - step;
            to = best + step;
        }
        insole_auto_start_answer_t answer;
        ck_assert_int_eq(insole_auto_start_answer(&start, &answer), INSOLE_OK);
        fit_t f = fit(&rows, bias_m, best);
        /* half the squares are - log density: of von Mises, with this concentration */
        double worst = fit(&rows, bias_m, best + PI).squares;
        double concentration = 0.25 * (worst - least);
        double expected = 1.0 / fmax(concentration - 0.75, 3.0 / (PI * PI));
        worst_note(
            &angle,
            fabs(remainder((double)answer.offset_rad - best, 2.0 * PI)) * sqrt(concentration), i);
        worst_note(&place, point_apart(f.begin, answer.begin) / (1.0 + 1.0 / concentration), i);
        worst_note(&variance, fabs(1.0 / (double)start.sums.ones / f.var_place - 1.0), i);
        worst_note(&curve, fabs((double)answer.var_offset_rad2 / expected - 1.0), i);
    }
    ASSERT_WORST(angle, 2.0e-4, "sigma");
    ASSERT_WORST(place, 2.0e-4, "m");
    ASSERT_WORST(variance, 100.0 * EPS, "of it");
    ASSERT_WORST(curve, 1.0e-3, "of it");
}
END_TEST

/* ---- honesty ------------------------------------------------------------------------------- */

static const plot_t PLOTS[] = {
    {5, 2.0, 3.5, 3.0, 0.1, 0.25, 0.0, INSOLE_AUTO_START_MOVED},
    {5, 2.0, 3.5, 3.0, 0.1, 0.0, 0.0, INSOLE_AUTO_START_MOVED},
    {3, 2.0, 3.5, 2.0, 0.1, 0.25, 0.0, INSOLE_AUTO_START_MOVED},
    {1, 2.0, 3.5, 3.0, 0.1, 0.0, 0.0, INSOLE_AUTO_START_MOVED},
    {10, 2.0, 3.5, 3.0, 0.1, 0.0, 0.1, INSOLE_AUTO_START_MOVED},
    {16, 2.0, 3.5, 2.0, 0.05, 0.4, 0.05, INSOLE_AUTO_START_MOVED},
    {16, 1.0, 0.0, 5.0, 0.0, 0.0, 0.0, INSOLE_AUTO_START_MOVED},
};

enum { PLOT_COUNT = sizeof PLOTS / sizeof PLOTS[0], STARTS = 500 };

START_TEST(the_covariance_of_the_start_is_honest)
{
    dice_t dice = {(uint64_t)_i + 1u};
    double position = 0.0, heading = 0.0, outside = 0.0;
    for (int i = 0; i < STARTS; i++) {
        outcome_t o = play(&PLOTS[_i], &dice);
        point_t e = {(double)o.answer.spot.x_m - o.truth.x, (double)o.answer.spot.y_m - o.truth.y};
        position += plane_form(plane_inverse(plane_of(o.answer.cov_m2)), e) / STARTS;
        heading += pow(off_heading(&o), 2.0) / (double)o.answer.var_offset_rad2 / STARTS;
        outside += off_heading(&o) > 2.0 * sqrt((double)o.answer.var_offset_rad2) ? 1.0 : 0.0;
    }
    ASSERT_AT_LEAST(position, 1.5, "");
    ASSERT_AT_MOST(position, 3.0, "");
    ASSERT_AT_LEAST(heading, 0.5, "");
    ASSERT_AT_MOST(heading, 1.25, "");
    ASSERT_AT_MOST(outside / STARTS, 0.07, "beyond 2 sigma");
}
END_TEST

/* By its density, integrated: the variance told is never less than the true one. */
START_TEST(the_direction_s_variance_is_no_less_than_that_of_von_mises)
{
    insole_auto_start_t start = begin_start(&plain);
    insole_spot_fix_t fix = {1u, {0, 0}, {4, 0, 4}, {0, 0}};
    ck_assert_int_eq(insole_auto_start_fix(&start, &fix), INSOLE_OK);
    for (double sigma = 0.02; sigma < 3.0; sigma *= 1.05) {
        ck_assert_int_eq(insole_auto_start_compass(&start, 1, (insole_real_t)sigma), INSOLE_OK);
        insole_auto_start_answer_t answer;
        ck_assert_int_eq(insole_auto_start_answer(&start, &answer), INSOLE_OK);
        double known = sigma * sigma < PI * PI / 3.0 ? 1.0 / (sigma * sigma) : 0.0;
        double mass = 0.0, squares = 0.0;
        for (int i = -20000; i < 20000; i++) {
            double a = (i + 0.5) * PI / 20000.0, density = exp(known * (cos(a) - 1.0));
            mass += density;
            squares += a * a * density;
        }
        double exact = squares / mass;
        ASSERT_AT_LEAST(answer.var_offset_rad2, exact * (1.0 - 1.0e-5), "rad^2");
        ASSERT_AT_MOST(answer.var_offset_rad2, exact * 2.1, "rad^2");
        if (sigma < 0.5) {
            ASSERT_NEAR((double)answer.var_offset_rad2 / exact, 1.0, 0.12, "");
        }
        if (known > 0.0) {
            ASSERT_NEAR(answer.offset_rad, 1.0, 1.0e-5, "rad");
        }
    }
}
END_TEST

/* ---- what it is for ------------------------------------------------------------------------ */

/* Mean error after five fixes with a compass: moved fixes, the first fix, the paper's circles. */
START_TEST(moved_fixes_beat_the_first_and_the_circles)
{
    dice_t moved_dice = {7u}, circle_dice = {7u};
    plot_t moved = {5, 2.0, 3.5, 3.0, 0.1, 0.25, 0.0, INSOLE_AUTO_START_MOVED}, circles = moved;
    circles.method = INSOLE_AUTO_START_CIRCLES;
    double of_moved = 0.0, of_first = 0.0, of_circles = 0.0, turned = 0.0, turned_circles = 0.0;
    for (int i = 0; i < STARTS; i++) {
        outcome_t m = play(&moved, &moved_dice), c = play(&circles, &circle_dice);
        of_moved += point_apart(m.begin, m.answer.begin) / STARTS;
        of_circles += point_apart(c.begin, c.answer.begin) / STARTS;
        of_first += hypot(m.first.x - m.begin.x, m.first.y - m.begin.y) / STARTS;
        turned += off_heading(&m) < PI / 6.0 ? 1.0 / STARTS : 0.0;
        turned_circles += off_heading(&c) < PI / 6.0 ? 1.0 / STARTS : 0.0;
    }
    ASSERT_AT_MOST(of_moved, 0.85 * of_first, "m");
    ASSERT_AT_MOST(of_moved, 0.95 * of_circles, "m");
    ASSERT_AT_LEAST(turned, 0.95, "within 30 degrees");
    ASSERT_AT_MOST(turned_circles, 0.7, "within 30 degrees");
}
END_TEST

START_TEST(the_circles_do_not_claim_more_than_they_know)
{
    dice_t dice = {(uint64_t)_i + 30u};
    plot_t plot = PLOTS[_i];
    plot.method = INSOLE_AUTO_START_CIRCLES;
    double position = 0.0, heading = 0.0;
    for (int i = 0; i < STARTS; i++) {
        outcome_t o = play(&plot, &dice);
        point_t e = {(double)o.answer.spot.x_m - o.truth.x, (double)o.answer.spot.y_m - o.truth.y};
        position += plane_form(plane_inverse(plane_of(o.answer.cov_m2)), e) / STARTS;
        heading += pow(off_heading(&o), 2.0) / (double)o.answer.var_offset_rad2 / STARTS;
    }
    ASSERT_AT_MOST(position, 3.0, "");
    ASSERT_AT_MOST(heading, 1.25, "");
}
END_TEST

START_TEST(without_noise_both_methods_are_exact)
{
    dice_t dice = {9u};
    plot_t plot = {5, 2.0, 0.0, 0.001, 0.0, 0.0, 0.1, _i};
    for (int i = 0; i < 50; i++) {
        outcome_t o = play(&plot, &dice);
        /* the paper's line is straight, the walk is not */
        double lost = _i == INSOLE_AUTO_START_CIRCLES ? 0.1 : 0.002;
        ASSERT_AT_MOST(off_heading(&o), lost, "rad");
        ASSERT_AT_MOST(point_apart(o.begin, o.answer.begin), _i == 1 ? 0.8 : 0.01, "m");
    }
}
END_TEST

/* ---- odd starts ---------------------------------------------------------------------------- */

static insole_auto_start_answer_t answer_of(const insole_auto_start_t *start)
{
    insole_auto_start_answer_t answer;
    ck_assert_int_eq(insole_auto_start_answer(start, &answer), INSOLE_OK);
    return answer;
}

START_TEST(nothing_heard_is_no_start)
{
    insole_auto_start_t start = begin_start(&plain);
    insole_auto_start_answer_t answer;
    memset(&answer, 0x5a, sizeof answer);
    ASSERT_UNCHANGED(answer, insole_auto_start_answer(&start, &answer), INSOLE_ERR_STATE);
    insole_pace_t pace = {1, 0, 0, 0};
    ck_assert_int_eq(insole_auto_start_step(&start, &pace), INSOLE_OK);
    ck_assert_int_eq(insole_auto_start_compass(&start, 1, 1), INSOLE_OK);
    ASSERT_UNCHANGED(answer, insole_auto_start_answer(&start, &answer), INSOLE_ERR_STATE);
}
END_TEST

START_TEST(standing_still_tells_no_direction)
{
    insole_auto_start_config_t config = plain;
    config.method = _i;
    insole_auto_start_t start = begin_start(&config);
    for (uint64_t i = 1u; i <= 12u; i++) {
        insole_spot_fix_t fix = {i * 2000000u, {4, -9}, {9, 0, 9}, {0, 0}};
        ck_assert_int_eq(insole_auto_start_fix(&start, &fix), INSOLE_OK);
    }
    insole_auto_start_answer_t a = answer_of(&start);
    ASSERT_NEAR(a.spot.x_m, 4.0, 0.01, "m");
    ASSERT_NEAR(a.spot.y_m, -9.0, 0.01, "m");
    ASSERT_NEAR(a.var_offset_rad2, PI * PI / 3.0, 1.0e-5, "rad^2");
    ASSERT_AT_LEAST(a.cov_m2.xx, 3.5 * 3.5 / 2.5, "m^2"); /* what they share stays for its 15 s */
    ck_assert(!a.ready);
    ck_assert_int_eq(insole_auto_start_compass(&start, 2, INSOLE_R(0.2)), INSOLE_OK);
    a = answer_of(&start);
    ck_assert(a.ready == (_i == INSOLE_AUTO_START_MOVED));
}
END_TEST

START_TEST(ready_is_as_the_settings_say)
{
    insole_auto_start_config_t config = plain;
    config.fixes = 3;
    config.fixes_most = 6;
    config.refine_rad = INSOLE_R(0.3);
    for (int sure = 0; sure < 2; sure++) {
        insole_auto_start_t start = begin_start(&config);
        if (sure) {
            ck_assert_int_eq(insole_auto_start_compass(&start, 0, INSOLE_R(0.2)), INSOLE_OK);
        }
        for (uint32_t i = 1u; i <= 8u; i++) {
            insole_spot_fix_t fix = {i * 2000000u, {4, -9}, {9, 0, 9}, {0, 0}};
            ck_assert_int_eq(insole_auto_start_fix(&start, &fix), INSOLE_OK);
            insole_auto_start_answer_t a = answer_of(&start);
            ck_assert_int_eq(a.ready, i >= (sure ? 3u : 6u));
            ck_assert_uint_eq(a.fixes, i);
        }
    }
    config.refine_rad = INSOLE_R(3.2);
    config.fixes = 1;
    insole_auto_start_t start = begin_start(&config);
    insole_spot_fix_t fix = {5u, {4, -9}, {9, 0, 9}, {0, 0}};
    ck_assert_int_eq(insole_auto_start_fix(&start, &fix), INSOLE_OK);
    insole_auto_start_answer_t a = answer_of(&start);
    ck_assert(a.ready);
    ASSERT_NEAR(a.cov_m2.xx, 9.0 + 12.25, 1.0e-4, "m^2");
}
END_TEST

/* A fix heard four steps ago, told with the way since, is that fix heard then. */
START_TEST(a_late_fix_counts_where_it_was_heard)
{
    insole_auto_start_t then = begin_start(&plain), late = then;
    insole_spot_t since = {0, 0};
    for (int i = 0; i < 10; i++) {
        insole_pace_t pace = {1, INSOLE_R(0.2) * (insole_real_t)i, 0, 0};
        if (i == 6 || i == 1) {
            insole_spot_fix_t fix = {(uint64_t)i + 1u, {(insole_real_t)i, 3}, {4, 0, 4}, {0, 0}};
            ck_assert_int_eq(insole_auto_start_fix(&then, &fix), INSOLE_OK);
            since = i == 6 ? insole_spot(0, 0) : since;
            if (i == 1) {
                ck_assert_int_eq(insole_auto_start_fix(&late, &fix), INSOLE_OK);
            }
        }
        since = insole_spot_add(since, insole_pace_way(&pace, 0));
        ck_assert_int_eq(insole_auto_start_step(&then, &pace), INSOLE_OK);
        ck_assert_int_eq(insole_auto_start_step(&late, &pace), INSOLE_OK);
    }
    insole_spot_fix_t fix = {7u, {6, 3}, {4, 0, 4}, since};
    ck_assert_int_eq(insole_auto_start_fix(&late, &fix), INSOLE_OK);
    insole_auto_start_answer_t a = answer_of(&then), b = answer_of(&late);
    ASSERT_NEAR(a.spot.x_m, b.spot.x_m, 1.0e-4, "m");
    ASSERT_NEAR(a.spot.y_m, b.spot.y_m, 1.0e-4, "m");
    ASSERT_NEAR(a.offset_rad, b.offset_rad, 1.0e-4, "rad");
}
END_TEST

/* Fixes that lie so far ahead of the walker, on a way with a turn: the place is his. */
START_TEST(a_fix_speaks_of_a_place_ahead)
{
    static const double AHEAD_M[] = {1.0, -2.0, 0.0};
    insole_auto_start_config_t config = plain;
    config.ahead_m = (insole_real_t)AHEAD_M[_i];
    insole_auto_start_t start = begin_start(&config);
    const double turned = 0.7;
    point_t truth = {3.0, -4.0};
    double psi = 0.0;
    for (uint32_t i = 0u; i < 12u; i++) {
        psi = i < 6u ? 0.2 : 1.4;
        truth.x += 2.0 * cos(psi + turned);
        truth.y += 2.0 * sin(psi + turned);
        insole_pace_t pace = {2, (insole_real_t)psi, 0, 0}, stands = {0, 2, 0, 0};
        insole_spot_fix_t fix = {i + 1u,
                                 {(insole_real_t)(truth.x + AHEAD_M[_i] * cos(psi + turned)),
                                  (insole_real_t)(truth.y + AHEAD_M[_i] * sin(psi + turned))},
                                 {4, 0, 4},
                                 {0, 0}};
        ck_assert_int_eq(insole_auto_start_step(&start, &pace), INSOLE_OK);
        ck_assert_int_eq(insole_auto_start_step(&start, &stands), INSOLE_OK); /* looks nowhere */
        ck_assert_int_eq(insole_auto_start_fix(&start, &fix), INSOLE_OK);
    }
    insole_auto_start_answer_t a = answer_of(&start);
    ASSERT_NEAR(a.offset_rad, turned, 1.0e-4, "rad");
    ASSERT_NEAR(a.spot.x_m, truth.x, 1.0e-3, "m");
    ASSERT_NEAR(a.spot.y_m, truth.y, 1.0e-3, "m");
}
END_TEST

/* By many draws of a shared error and noise: covariance of the place's error with that of the
 * newest fix. */
START_TEST(what_the_newest_fix_is_wrong_by_as_well)
{
    enum { DRAWS = 20000 };
    dice_t dice = {77u + (uint64_t)_i};
    insole_auto_start_config_t config = plain;
    config.sigma_scale = 0;
    double left = exp(-2.0 / 15.0), product = 0.0, told = 0.0;
    for (int k = 0; k < DRAWS; k++) {
        insole_auto_start_t start = begin_start(&config);
        double b = 3.5 * dice_normal(&dice);
        for (int i = 0; i <= _i; i++) {
            b = i > 0 ? left * b + 3.5 * sqrt(1.0 - left * left) * dice_normal(&dice) : b;
            insole_spot_fix_t fix = {(uint64_t)(i + 1) * 2000000u,
                                     {(insole_real_t)(b + 3.0 * dice_normal(&dice)), 0},
                                     {9, 0, 9},
                                     {0, 0}};
            ck_assert_int_eq(insole_auto_start_fix(&start, &fix), INSOLE_OK);
        }
        insole_auto_start_answer_t a = answer_of(&start);
        product += (double)a.spot.x_m * b / DRAWS;
        told = (double)a.shared_m2;
    }
    ASSERT_NEAR(product, told, 0.35, "m^2"); /* 1-sigma of the product's mean: 0.13 */
    if (_i == 0) {
        ASSERT_NEAR(told, 12.25, 1.0e-4, "m^2");
    }
}
END_TEST

/* The bias that is told counts from then on, the setting is the most. */
START_TEST(what_fixes_share_can_be_told)
{
    insole_auto_start_config_t less = plain;
    less.bias_m = 2;
    insole_auto_start_t told = begin_start(&plain), set = begin_start(&less), most = told;
    const insole_auto_start_t whole = told;
    ck_assert_int_eq(insole_auto_start_bias(&told, 2), INSOLE_OK);
    ck_assert_int_eq(insole_auto_start_bias(&most, 9), INSOLE_OK);
    for (uint32_t i = 1u; i <= 4u; i++) {
        insole_spot_fix_t fix = {i * 2000000u, {4, -9}, {9, 0, 9}, {0, 0}};
        ck_assert_int_eq(insole_auto_start_fix(&told, &fix), INSOLE_OK);
        ck_assert_int_eq(insole_auto_start_fix(&set, &fix), INSOLE_OK);
    }
    insole_auto_start_answer_t a = answer_of(&told), b = answer_of(&set);
    ck_assert(a.cov_m2.xx == b.cov_m2.xx && a.shared_m2 == b.shared_m2);
    ck_assert(most.bias_m == whole.bias_m);
}
END_TEST

START_TEST(the_answer_walks_on_and_grows_less_sure)
{
    insole_auto_start_t start = begin_start(&plain);
    insole_spot_fix_t fix = {5u, {10, 20}, {9, 0, 9}, {0, 0}};
    ck_assert_int_eq(insole_auto_start_fix(&start, &fix), INSOLE_OK);
    ck_assert_int_eq(insole_auto_start_compass(&start, (insole_real_t)(0.5 * PI), INSOLE_R(0.1)),
                     INSOLE_OK);
    insole_pace_t pace = {10, 0, 0, 0};
    ck_assert_int_eq(insole_auto_start_step(&start, &pace), INSOLE_OK);
    insole_auto_start_answer_t a = answer_of(&start);
    ASSERT_NEAR(a.spot.x_m, 10.0, 1.0e-4, "m");
    ASSERT_NEAR(a.spot.y_m, 30.0, 1.0e-4, "m");
    ASSERT_NEAR(a.begin.y_m, 20.0, 1.0e-4, "m");
    ASSERT_NEAR(a.cov_m2.yy, 22.25, 0.05, "m^2"); /* a tenth of ten metres */
    ASSERT_NEAR(a.cov_m2.xx, 22.25, 0.05, "m^2"); /* a tenth of a radian */
    pace.var_length_m2 = 4;
    pace.length_m = 0;
    ck_assert_int_eq(insole_auto_start_step(&start, &pace), INSOLE_OK);
    insole_auto_start_answer_t b = answer_of(&start);
    ASSERT_NEAR(b.cov_m2.xx - a.cov_m2.xx, 4.0, 1.0e-4, "m^2");
}
END_TEST

/* Ten metres walked since the only fix, in a direction of which the compass tells more or less: the
 * mean squares by integration over its density, along and across. */
START_TEST(a_way_in_a_vague_direction_is_vague)
{
    insole_auto_start_config_t config = plain;
    config.sigma_scale = 0;
    for (double sigma = 0.05; sigma < 2.5; sigma *= 1.3) {
        insole_auto_start_t start = begin_start(&config);
        insole_spot_fix_t fix = {5u, {10, 20}, {9, 0, 9}, {0, 0}};
        ck_assert_int_eq(insole_auto_start_fix(&start, &fix), INSOLE_OK);
        ck_assert_int_eq(insole_auto_start_compass(&start, 0, (insole_real_t)sigma), INSOLE_OK);
        insole_pace_t pace = {10, 0, 0, 0};
        ck_assert_int_eq(insole_auto_start_step(&start, &pace), INSOLE_OK);
        insole_auto_start_answer_t a = answer_of(&start);
        double known = sigma * sigma < PI * PI / 3.0 ? 1.0 / (sigma * sigma) : 0.0;
        double mass = 0.0, along = 0.0, across = 0.0;
        for (int i = -20000; i < 20000; i++) {
            double off = (i + 0.5) * PI / 20000.0, density = exp(known * (cos(off) - 1.0));
            mass += density;
            along += density * pow(1.0 - cos(off), 2.0);
            across += density * pow(sin(off), 2.0);
        }
        along *= 100.0 / mass;
        across *= 100.0 / mass;
        double told_along = (double)a.cov_m2.xx - 21.25, told_across = (double)a.cov_m2.yy - 21.25;
        ASSERT_AT_LEAST(told_along, along - 1.0e-3, "m^2");
        ASSERT_AT_MOST(told_along, along + 1.06,
                       "m^2"); /* the fraction ends 1.05 % too high at most */
        ASSERT_AT_LEAST(told_across, across - 1.0e-3, "m^2");
        ASSERT_AT_MOST(told_across, 1.0131 * across, "m^2"); /* and up to 1.3 % */
    }
}
END_TEST

START_TEST(many_fixes_and_any_input_stay_finite)
{
    insole_auto_start_config_t config = plain;
    config.method = _i % 2;
    insole_auto_start_t start = begin_start(&config);
    insole_rng_t rng;
    insole_rng_seed(&rng, 5u);
    worst_t held = {0.0, 0.0};
    static const insole_real_t SIZE[] = {INSOLE_R(1e-6), 1, INSOLE_R(1e12)};
    for (uint32_t i = 0u; i < 20000u; i++) {
        insole_real_t far = _i < 2 ? 100 : INSOLE_R(1e5);
        insole_pace_t pace = {1, sample_between(&rng, -900, 900), 1, 1};
        (void)insole_auto_start_step(&start, &pace);
        insole_real_t size = _i < 2 ? 9 : SIZE[insole_rng_bits(&rng) % 3u];
        insole_spot_fix_t fix = {(i + 1u) * UINT64_C(1000000), sample_spot(&rng, far),
                                 insole_sym2_circle(size), sample_spot(&rng, far)};
        worst_require(&held, insole_auto_start_fix(&start, &fix) == INSOLE_OK, i);
        insole_auto_start_answer_t a;
        worst_require(&held, insole_auto_start_answer(&start, &a) == INSOLE_OK, i);
        worst_require(&held, insole_sym2_is_between(a.cov_m2, INSOLE_R(1e-6), INSOLE_R(1e12)), i);
        worst_require(&held, insole_spot_norm(a.spot) < INSOLE_R(1e7), i);
        worst_require(&held, a.var_offset_rad2 > 0 && a.var_offset_rad2 < INSOLE_R(3.29), i);
        worst_require(&held, insole_abs(a.offset_rad) <= INSOLE_PI, i);
    }
    ASSERT_ALL_HELD(held);
}
END_TEST

/* ---- contract ------------------------------------------------------------------------------ */

static insole_auto_start_config_t config;

static insole_status_t judge(void)
{
    insole_auto_start_t start;
    memset(&start, 0x5a, sizeof start);
    insole_auto_start_t before = start;
    insole_status_t status = insole_auto_start_init(&start, &config, &insole_auto_start_circles);
    ck_assert(status == INSOLE_OK || memcmp(&start, &before, sizeof start) == 0);
    return status;
}

START_TEST(settings_have_their_ranges)
{
    config = insole_auto_start_defaults;
    ck_assert_int_eq(config.fixes, 5);
    INSOLE_AUTO_START_KEYS(SETTING_HAS_ENDS)
    insole_auto_start_t start;
    memset(&start, 0x5a, sizeof start);
    ck_assert_int_eq(insole_auto_start_init(NULL, &config, &insole_auto_start_circles),
                     INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(start, insole_auto_start_init(&start, NULL, &insole_auto_start_circles),
                     INSOLE_ERR_NULL);
}
END_TEST

START_TEST(circles_are_refused_where_there_are_none)
{
    insole_auto_start_t start;
    memset(&start, 0x5a, sizeof start);
    config = insole_auto_start_defaults;
    ck_assert_int_eq(insole_auto_start_init(&start, &config, NULL), INSOLE_OK);
    config.method = INSOLE_AUTO_START_CIRCLES;
    ASSERT_UNCHANGED(start, insole_auto_start_init(&start, &config, NULL), INSOLE_ERR_VALUE);
}
END_TEST

#define REFUSED(call, why) ASSERT_REFUSED(s, s.refused, call, why)

START_TEST(bad_input_is_refused)
{
    const insole_real_t nan = (insole_real_t)NAN, endless = (insole_real_t)INFINITY;
    insole_auto_start_t s = begin_start(&plain);
    insole_auto_start_answer_t answer;
    insole_pace_t pace = {1, 0, 0, 0}, bad_pace = {1, 0, nan, 0};
    insole_spot_fix_t fix = {5u, {1, 1}, {1, 0, 1}, {0, 0}}, bad_fix = fix;
    bad_fix.spot.x_m = endless;
    ck_assert_int_eq(insole_auto_start_step(NULL, &pace), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(s, insole_auto_start_step(&s, NULL), INSOLE_ERR_NULL);
    REFUSED(insole_auto_start_step(&s, &bad_pace), INSOLE_ERR_VALUE);
    ck_assert_int_eq(insole_auto_start_fix(NULL, &fix), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(s, insole_auto_start_fix(&s, NULL), INSOLE_ERR_NULL);
    REFUSED(insole_auto_start_fix(&s, &bad_fix), INSOLE_ERR_VALUE);
    ck_assert_int_eq(insole_auto_start_compass(NULL, 0, 1), INSOLE_ERR_NULL);
    const insole_real_t bad[] = {nan, endless, -endless, 1001};
    for (int i = 0; i < 4; i++) {
        REFUSED(insole_auto_start_compass(&s, bad[i], 1), INSOLE_ERR_VALUE);
    }
    const insole_real_t no_sigma[] = {nan, endless, 0, -1};
    for (int i = 0; i < 4; i++) {
        REFUSED(insole_auto_start_compass(&s, 0, no_sigma[i]), INSOLE_ERR_VALUE);
    }
    ck_assert_int_eq(insole_auto_start_bias(NULL, 1), INSOLE_ERR_NULL);
    REFUSED(insole_auto_start_bias(&s, -1), INSOLE_ERR_VALUE);
    REFUSED(insole_auto_start_bias(&s, nan), INSOLE_ERR_VALUE);
    REFUSED(insole_auto_start_bias(&s, endless), INSOLE_ERR_VALUE);
    ck_assert_int_eq(insole_auto_start_fix(&s, &fix), INSOLE_OK);
    REFUSED(insole_auto_start_fix(&s, &fix), INSOLE_ERR_TIME);
    ck_assert_int_eq(insole_auto_start_answer(NULL, &answer), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(s, insole_auto_start_answer(&s, NULL), INSOLE_ERR_NULL);
    s.way.x_m = INSOLE_R(99999.5);
    REFUSED(insole_auto_start_step(&s, &pace), INSOLE_ERR_VALUE);
}
END_TEST

static void walk(insole_auto_start_t *start, uint32_t from, uint32_t to)
{
    for (uint32_t i = from; i < to; i++) {
        insole_rng_t rng;
        insole_rng_seed(&rng, i);
        insole_pace_t pace = {1, sample_between(&rng, -1, 1), INSOLE_R(0.01), INSOLE_R(0.01)};
        insole_spot_fix_t fix = {i + 1u, sample_spot(&rng, 9), {4, 1, 5}, {0, 0}};
        ck_assert_int_eq(insole_auto_start_step(start, &pace), INSOLE_OK);
        ck_assert_int_eq(insole_auto_start_fix(start, &fix), INSOLE_OK);
    }
}

START_TEST(a_saved_state_goes_on_alike)
{
    insole_auto_start_config_t circles = plain;
    circles.method = INSOLE_AUTO_START_CIRCLES;
    insole_auto_start_t start = begin_start(&circles), restored;
    walk(&start, 0u, 3u);
    unsigned char bytes[sizeof start + INSOLE_SNAPSHOT_HEADER_BYTES];
    size_t used;
    ck_assert_int_eq(insole_snapshot_save(9u, &start, sizeof start, bytes, sizeof bytes, &used),
                     INSOLE_OK);
    ck_assert_int_eq(insole_snapshot_load(9u, &restored, sizeof restored, bytes, used), INSOLE_OK);
    walk(&start, 3u, 20u);
    walk(&restored, 3u, 20u);
    ck_assert_int_eq(memcmp(&start, &restored, sizeof start), 0);
    insole_auto_start_answer_t a = answer_of(&start), b = answer_of(&restored);
    ck_assert_int_eq(memcmp(&a.spot, &b.spot, sizeof a.spot), 0);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("auto_start");
    plain = insole_auto_start_defaults;
    plain.ahead_m = 0;
    suite_add(suite, "squares", it_is_generalised_least_squares);
    suite_add_loop(suite, "honest", the_covariance_of_the_start_is_honest, PLOT_COUNT);
    suite_add(suite, "density", the_direction_s_variance_is_no_less_than_that_of_von_mises);
    suite_add(suite, "better", moved_fixes_beat_the_first_and_the_circles);
    suite_add_loop(suite, "circles", the_circles_do_not_claim_more_than_they_know, PLOT_COUNT);
    suite_add_loop(suite, "exact", without_noise_both_methods_are_exact, 2);
    suite_add(suite, "nothing", nothing_heard_is_no_start);
    suite_add_loop(suite, "still", standing_still_tells_no_direction, 2);
    suite_add(suite, "ready", ready_is_as_the_settings_say);
    suite_add(suite, "late", a_late_fix_counts_where_it_was_heard);
    suite_add_loop(suite, "ahead", a_fix_speaks_of_a_place_ahead, 3);
    suite_add_loop(suite, "shared", what_the_newest_fix_is_wrong_by_as_well, 4);
    suite_add(suite, "told", what_fixes_share_can_be_told);
    suite_add(suite, "on", the_answer_walks_on_and_grows_less_sure);
    suite_add(suite, "vague", a_way_in_a_vague_direction_is_vague);
    suite_add_loop(suite, "finite", many_fixes_and_any_input_stay_finite, 4);
    suite_add(suite, "settings", settings_have_their_ranges);
    suite_add(suite, "no circles", circles_are_refused_where_there_are_none);
    suite_add(suite, "refused", bad_input_is_refused);
    suite_add(suite, "saved", a_saved_state_goes_on_alike);
    return suite;
}
