/* SPDX-License-Identifier: MIT */
#include "insole/fuse/ml_shift.h"

#include "filter_calls.h"

#include "insole/base/snapshot.h"
#include "near.h"
#include "plane.h"
#include "refusal.h"
#include "setting.h"
#include "suite.h"

#define EPS ((double)INSOLE_REAL_EPSILON)

static insole_ml_shift_t begin(const insole_ml_shift_config_t *config)
{
    insole_ml_shift_t ml;
    ck_assert_int_eq(insole_ml_shift_init(&ml, config), INSOLE_OK);
    ck_assert_int_eq(insole_ml_shift_start(&ml, insole_spot(0, 0), insole_sym2_circle(4), 0),
                     INSOLE_OK);
    return ml;
}

static insole_pace_t some_pace(insole_rng_t *rng)
{
    insole_pace_t pace = {sample_between(rng, INSOLE_R(0.3), 1), sample_between(rng, -3, 3),
                          INSOLE_R(0.01), INSOLE_R(0.01)};
    return pace;
}

static void step(insole_ml_shift_t *ml, const insole_pace_t *pace)
{
    ck_assert_int_eq(insole_ml_shift_step(ml, pace), INSOLE_OK);
}

static void take(insole_ml_shift_t *ml, const insole_spot_fix_t *fix)
{
    ck_assert_int_eq(insole_ml_shift_fix(ml, fix), INSOLE_OK);
}

static insole_spot_fix_t fix_at(uint64_t t_us, insole_spot_t spot)
{
    insole_spot_fix_t fix = {t_us, spot, insole_sym2_circle(4), {0, 0}};
    return fix;
}

/* ---- the window by the paper's search, in double ------------------------------------------ */

typedef struct {
    int count;
    point_t radio[INSOLE_ML_SHIFT_MOST], pdr[INSOLE_ML_SHIFT_MOST];
    plane_t W[INSOLE_ML_SHIFT_MOST]; /* inverse covariance of each fix */
    double var_pdr;
} window_t;

/* Logarithm of the product of (2), up to a constant. */
static double log_product(const window_t *w, double x, double y)
{
    double sum = 0.0;
    for (int i = 0; i < w->count; i++) {
        point_t off = {w->radio[i].x - w->pdr[i].x - x, w->radio[i].y - w->pdr[i].y - y};
        sum -= 0.5 * ((x * x + y * y) / w->var_pdr + plane_form(w->W[i], off));
    }
    return sum;
}

/* Best of a square of `2 n + 1` points a side about the centre. */
static point_t best_of(const window_t *w, point_t centre, double cell, int n)
{
    point_t best = centre;
    double most = log_product(w, centre.x, centre.y);
    for (int i = -n; i <= n; i++) {
        for (int k = -n; k <= n; k++) {
            double x = centre.x + i * cell, y = centre.y + k * cell;
            double value = log_product(w, x, y);
            if (value > most) {
                most = value;
                best.x = x;
                best.y = y;
            }
        }
    }
    return best;
}

/* 5 mm, about the best of 8 cm, about the best of 64 cm. */
static point_t search(const window_t *w)
{
    point_t none = {0.0, 0.0};
    point_t coarse = best_of(w, none, 0.64, 40);
    point_t middle = best_of(w, coarse, 0.08, 16);
    return best_of(w, middle, 0.005, 32);
}

static window_t window_of(const insole_ml_shift_t *ml, insole_spot_t shift)
{
    window_t w;
    w.count = (int)ml->count;
    w.var_pdr = (double)ml->var_pdr_m2;
    for (int i = 0; i < w.count; i++) {
        const insole_ml_shift_pair_t *pair = &ml->pair[i];
        w.radio[i] = point_of(pair->radio);
        w.pdr[i] = point_of(insole_spot_sub(pair->pdr, shift)); /* before it was shifted */
        insole_sym2_t R = ml->config.radio == INSOLE_ML_SHIFT_TOLD
                              ? pair->cov_m2
                              : insole_sym2_circle(ml->var_radio_m2);
        w.W[i] = plane_inverse(plane_of(R));
    }
    return w;
}

/* Largest by smallest curvature of the product: the best point of a lattice lies no farther from
 * the true one than half a diagonal times the root of this. */
static double condition_of(const window_t *w)
{
    plane_t H = {w->count / w->var_pdr, 0.0, 0.0, w->count / w->var_pdr};
    for (int i = 0; i < w->count; i++) {
        H = plane_add(H, 1.0, w->W[i]);
    }
    double middle = 0.5 * (H.a + H.d), half = hypot(0.5 * (H.a - H.d), H.b);
    return (middle + half) / (middle - half);
}

START_TEST(the_closed_form_is_what_a_search_finds)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 1u);
    worst_t distance = {0.0, 0.0}, value = {0.0, 0.0};
    int shifted = 0;
    for (int i = 0; i < 1000; i++) {
        insole_ml_shift_config_t config = insole_ml_shift_defaults;
        config.window = 1 + (int32_t)(insole_rng_bits(&rng) % 6u);
        config.pdr = (int32_t)(insole_rng_bits(&rng) % 3u);
        config.radio = (int32_t)(insole_rng_bits(&rng) % 3u);
        config.sigma_pdr_m = sample_between(&rng, INSOLE_R(0.3), 5);
        config.sigma_radio_m = sample_between(&rng, 1, 8);
        insole_ml_shift_t ml = begin(&config);
        uint64_t fixes = 1u + insole_rng_bits(&rng) % 8u;
        for (uint64_t t = 1u; t <= fixes; t++) {
            insole_pace_t pace = some_pace(&rng);
            step(&ml, &pace);
            step(&ml, &pace);
            insole_spot_fix_t fix = {t, sample_spot(&rng, 12), sample_sym2(&rng, 6),
                                     sample_spot(&rng, 2)};
            take(&ml, &fix);
        }
        window_t w = window_of(&ml, ml.shift);
        point_t found = search(&w), closed = point_of(ml.shift);
        worst_note(&distance, point_apart(found, ml.shift) / sqrt(condition_of(&w)), i);
        worst_note(&value, log_product(&w, found.x, found.y) - log_product(&w, closed.x, closed.y),
                   i);
        shifted += hypot(found.x, found.y) > 0.1 ? 1 : 0;
    }
    ASSERT_WORST(distance, 0.0025 * sqrt(2.0) + 1.0e-4, "m");
    ASSERT_WORST(value, 1.0e-4, "of the logarithm");
    ck_assert_int_gt(shifted, 600);
}
END_TEST

/* One fix, equal sigmas: half the way. Then half of what is left, and so on. */
START_TEST(the_shifts_are_those_computed_by_hand)
{
    insole_ml_shift_config_t config = insole_ml_shift_defaults;
    config.pdr = INSOLE_ML_SHIFT_FIXED_PDR;
    config.radio = INSOLE_ML_SHIFT_FIXED_RADIO;
    config.sigma_pdr_m = 2;
    config.sigma_radio_m = 2;
    config.window = 2;
    insole_ml_shift_t ml = begin(&config);
    insole_spot_fix_t fix = fix_at(1u, insole_spot(8, 0));
    take(&ml, &fix);
    ASSERT_NEAR(ml.spot.x_m, 4.0, 8.0 * EPS, "m");
    insole_pace_t pace = {1, 0, 0, 0};
    step(&ml, &pace);
    fix = fix_at(2u, insole_spot(8, 4));
    take(&ml, &fix); /* L_p = 4 and 5; apart (4, 0) and (3, 4); mean (3.5, 2), half of it */
    ASSERT_NEAR(ml.shift.x_m, 1.75, 8.0 * EPS, "m");
    ASSERT_NEAR(ml.shift.y_m, 1.0, 8.0 * EPS, "m");
    ASSERT_NEAR(ml.spot.x_m, 6.75, 16.0 * EPS, "m");
    fix = fix_at(3u, insole_spot(7, 1));
    take(&ml, &fix); /* the first has left: L_p (6.75, 1) twice; apart (1.25, 3) and (.25, 0) */
    ASSERT_NEAR(ml.shift.x_m, 0.375, 16.0 * EPS, "m");
    ASSERT_NEAR(ml.shift.y_m, 0.75, 16.0 * EPS, "m");
}
END_TEST

/* (4), summed in double beside it, with an offset and fixes heard a while ago. */
START_TEST(the_position_is_start_and_paces_and_shifts)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 2u);
    insole_ml_shift_t ml = begin(&insole_ml_shift_defaults);
    const insole_real_t offset = INSOLE_R(-2.0);
    ck_assert_int_eq(insole_ml_shift_start(&ml, insole_spot(5, 6), insole_sym2_circle(4), offset),
                     INSOLE_OK);
    point_t sum = {5.0, 6.0};
    worst_t off = {0.0, 0.0}, heard = {0.0, 0.0};
    for (uint64_t i = 1u; i < 500u; i++) {
        insole_pace_t pace = some_pace(&rng);
        step(&ml, &pace);
        double psi = (double)pace.heading_rad + (double)offset, d = (double)pace.length_m;
        sum.x += d * cos(psi);
        sum.y += d * sin(psi);
        if (i % 2u == 0u) {
            insole_spot_fix_t fix = fix_at(i, insole_spot_add(ml.spot, sample_spot(&rng, 4)));
            fix.since = sample_spot(&rng, 2);
            double c = cos((double)offset), s = sin((double)offset);
            point_t since = {c * (double)fix.since.x_m - s * (double)fix.since.y_m,
                             s * (double)fix.since.x_m + c * (double)fix.since.y_m};
            take(&ml, &fix);
            sum.x += (double)ml.shift.x_m;
            sum.y += (double)ml.shift.y_m;
            point_t then = {sum.x - since.x, sum.y - since.y};
            uint32_t newest = (ml.next + 3u) % 4u;
            worst_note(&heard, point_apart(then, ml.pair[newest].pdr), (double)i);
        }
        worst_note(&off, point_apart(sum, ml.spot), (double)i);
    }
    ASSERT_WORST(off, 1000.0 * EPS, "m");
    ASSERT_WORST(heard, 1000.0 * EPS, "m");
}
END_TEST

/* ---- sigma and sigma* ---------------------------------------------------------------------- */

typedef struct {
    int count;
    double at[256];
} list_t;

static double variance_of(const list_t *list)
{
    double mean = 0.0, sum = 0.0;
    for (int i = 0; i < list->count; i++) {
        mean += list->at[i] / list->count;
    }
    for (int i = 0; i < list->count; i++) {
        sum += pow(list->at[i] - mean, 2.0) / list->count;
    }
    return sum;
}

START_TEST(sigmas_are_those_of_the_numbers_seen)
{
    insole_ml_shift_config_t config = insole_ml_shift_defaults;
    config.pdr = _i;
    config.memory = 256;
    insole_rng_t rng;
    insole_rng_seed(&rng, 3u);
    insole_ml_shift_t ml = begin(&config);
    list_t distances = {0, {0.0}}, lengths = {0, {0.0}};
    double squares = 0.0;
    insole_spot_t last = {0, 0};
    worst_t radio = {0.0, 0.0}, pdr = {0.0, 0.0};
    for (int i = 1; i <= 60; i++) {
        for (int k = 0; k < 2; k++) {
            insole_pace_t pace = some_pace(&rng);
            step(&ml, &pace);
            lengths.at[lengths.count++] = (double)pace.length_m;
        }
        insole_spot_fix_t fix = fix_at((uint64_t)i, sample_spot(&rng, 9));
        squares += 0.5 * pow(point_apart(point_of(fix.spot), ml.spot), 2.0);
        if (i > 1) {
            distances.at[distances.count++] = point_apart(point_of(fix.spot), last);
        }
        last = fix.spot;
        take(&ml, &fix);
        double n = distances.count,
               of_radio = (4.0 * 16.0 + n * (n > 0 ? variance_of(&distances) : 0.0)) / (4.0 + n);
        double left_over = squares / i - of_radio;
        int in_window = i < 4 ? i : 4;
        const double of_pdr[] = {fmax((4.0 * 2.25 + i * left_over) / (4.0 + i), 0.01),
                                 fmax(2.0 * (in_window - 1) * variance_of(&lengths), 0.01), 2.25};
        worst_note(&radio, fabs((double)ml.var_radio_m2 / of_radio - 1.0), i);
        worst_note(&pdr, fabs((double)ml.var_pdr_m2 / of_pdr[_i] - 1.0), i);
    }
    ASSERT_WORST(radio, 200.0 * EPS, "of it");
    ASSERT_WORST(pdr, 400.0 * EPS, "of it");
}
END_TEST

START_TEST(what_was_long_ago_is_forgotten)
{
    insole_ml_shift_config_t config = insole_ml_shift_defaults;
    config.memory = 20;
    insole_rng_t rng;
    insole_rng_seed(&rng, 4u);
    insole_ml_shift_t ml = begin(&config);
    insole_spot_fix_t wild = fix_at(1u, insole_spot(300, 0));
    insole_spot_fix_t home = fix_at(2u, insole_spot(0, 0));
    take(&ml, &wild);
    take(&ml, &home);
    for (uint64_t t = 3u; t < 300u; t++) {
        insole_spot_fix_t fix =
            fix_at(t, insole_spot(3 * insole_rng_normal(&rng), 3 * insole_rng_normal(&rng)));
        take(&ml, &fix);
    }
    /* distances of two normal fixes: 9 (4 - pi) of variance */
    ASSERT_AT_MOST(ml.var_radio_m2, 20.0, "m^2");
    ASSERT_AT_MOST(insole_spot_norm(ml.spot), 4.0, "m");
}
END_TEST

/* ---- what it is for ------------------------------------------------------------------------ */

typedef struct {
    double shift, pdr, radio; /* rms */
    double inside;            /* share of the errors within 2.45 sigma: 95 % of a plane's normal */
} score_t;

/* Walks of 90 s with a wrong heading and wrong lengths; fixes with errors that last. */
static score_t walks(const insole_ml_shift_config_t *config, int count)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 6u);
    score_t score = {0.0, 0.0, 0.0, 0.0};
    double samples = 0.0, fixes = 0.0;
    for (int w = 0; w < count; w++) {
        insole_ml_shift_t ml = begin(config);
        point_t truth = sample_of(&rng, plane_of(insole_sym2_circle(4))), pdr = {0.0, 0.0};
        point_t lasting = sample_of(&rng, plane_of(insole_sym2_circle(9)));
        double wrong = 0.14 * (double)insole_rng_normal(&rng), psi = 0.0;
        double scale = 1.0 + 0.1 * (double)insole_rng_normal(&rng);
        for (int k = 1; k <= 180; k++) {
            psi += k % 40 == 0 ? 1.57 : 0.0;
            truth.x += 0.65 * cos(psi);
            truth.y += 0.65 * sin(psi);
            insole_pace_t pace = {(insole_real_t)(0.65 * scale), (insole_real_t)(psi + wrong),
                                  INSOLE_R(0.01), INSOLE_R(0.02)};
            step(&ml, &pace);
            pdr.x += 0.65 * scale * cos(psi + wrong);
            pdr.y += 0.65 * scale * sin(psi + wrong);
            lasting.x += -lasting.x / 30.0 + 0.77 * (double)insole_rng_normal(&rng);
            lasting.y += -lasting.y / 30.0 + 0.77 * (double)insole_rng_normal(&rng);
            if (k % 3 == 0) {
                double ex = lasting.x + 2.0 * (double)insole_rng_normal(&rng);
                double ey = lasting.y + 2.0 * (double)insole_rng_normal(&rng);
                insole_spot_fix_t fix =
                    fix_at((uint64_t)k, insole_spot((insole_real_t)(truth.x + ex),
                                                    (insole_real_t)(truth.y + ey)));
                fix.cov_m2 = insole_sym2_circle(13);
                take(&ml, &fix);
                score.radio += ex * ex + ey * ey;
                fixes += 1.0;
            }
            double off = point_apart(truth, ml.spot);
            score.shift += off * off;
            score.pdr += pow(truth.x - pdr.x, 2.0) + pow(truth.y - pdr.y, 2.0);
            score.inside += off < 2.45 * sqrt((double)ml.P.xx) ? 1.0 : 0.0;
            samples += 1.0;
        }
    }
    score.shift = sqrt(score.shift / samples);
    score.pdr = sqrt(score.pdr / samples);
    score.radio = sqrt(score.radio / fixes);
    score.inside /= samples;
    return score;
}

START_TEST(it_is_better_than_paces_and_than_fixes)
{
    score_t score = walks(&insole_ml_shift_defaults, 200);
    ASSERT_AT_MOST(score.shift, 0.9 * score.radio, "m");
    ASSERT_AT_MOST(score.shift, 0.9 * score.pdr, "m");
    ASSERT_AT_LEAST(score.inside, 0.95, "of the errors");
}
END_TEST

/* As the header says: the scatter of lengths alone can not correct a walk. */
START_TEST(the_variance_of_strides_corrects_little)
{
    insole_ml_shift_config_t config = insole_ml_shift_defaults;
    config.pdr = INSOLE_ML_SHIFT_STRIDES;
    score_t printed = walks(&config, 100), ours = walks(&insole_ml_shift_defaults, 100);
    ASSERT_AT_MOST(ours.shift, 0.9 * printed.shift, "m");
    ASSERT_NEAR(printed.shift / printed.pdr, 1.0, 0.1, "");
}
END_TEST

/* Errors of old position and fix in any two directions, as large as their sigmas: what comes out of
 * the shift is no larger than the sigma told. */
START_TEST(the_bound_holds_for_any_errors)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 8u);
    insole_ml_shift_config_t config = insole_ml_shift_defaults;
    config.radio = INSOLE_ML_SHIFT_TOLD;
    config.pdr = INSOLE_ML_SHIFT_FIXED_PDR;
    worst_t beyond = {0.0, 0.0};
    double nearest = 1.0;
    for (int i = 0; i < 300; i++) {
        insole_ml_shift_t ml = begin(&config);
        insole_sym2_t R = sample_sym2(&rng, i % 2 == 0 ? INSOLE_R(0.5) : 10);
        insole_spot_fix_t fix = {1u, {0, 0}, R, {0, 0}};
        take(&ml, &fix);
        double own = 1.0 / pow((double)config.sigma_pdr_m, 2.0), most = 0.0;
        plane_t W = plane_inverse(plane_of(R)), own_W = {own, 0.0, 0.0, own};
        plane_t G = plane_mul(plane_inverse(plane_add(own_W, 1.0, W)), W);
        double sigma_fix = sqrt((double)insole_sym2_largest(R));
        for (int k = 0; k < 3600; k++) {
            double a = k / 60 * 0.104719755, b = k % 60 * 0.104719755;
            point_t e = {2.0 * cos(a), 2.0 * sin(a)};
            point_t f = {sigma_fix * cos(b), sigma_fix * sin(b)};
            point_t Ge = plane_apply(G, e), Gf = plane_apply(G, f);
            most = fmax(most, hypot(e.x - Ge.x + Gf.x, e.y - Ge.y + Gf.y));
        }
        worst_note(&beyond, most / sqrt((double)ml.P.xx) - 1.0, i);
        nearest = fmin(nearest, most / sqrt((double)ml.P.xx));
    }
    ASSERT_WORST(beyond, 1.0e-4, "of it");
    ASSERT_AT_LEAST(nearest, 0.5, "of it");
}
END_TEST

/* ---- for ever ------------------------------------------------------------------------------ */

START_TEST(a_day_and_any_input_stay_finite)
{
    insole_ml_shift_config_t config = insole_ml_shift_defaults;
    config.pdr = _i % 3;
    config.radio = _i / 3;
    config.window = 16;
    insole_ml_shift_t ml = begin(&config);
    insole_rng_t rng;
    insole_rng_seed(&rng, 7u);
    worst_t held = {0.0, 0.0};
    static const insole_real_t SIZE[] = {INSOLE_R(1e-6), 1, INSOLE_R(1e12)};
    for (uint32_t i = 0u; i < 40000u; i++) {
        bool wild = i % 4000u > 3000u;
        insole_pace_t pace = {wild ? 10 : 1, sample_between(&rng, -900, 900), wild ? 100 : 0,
                              wild ? INSOLE_R(1e30) : 0};
        worst_require(&held, insole_ml_shift_step(&ml, &pace) == INSOLE_OK, i);
        insole_real_t size = wild ? INSOLE_R(1e5) : 50;
        insole_real_t a = wild ? SIZE[i % 3u] : 4, b = wild ? SIZE[i / 3u % 3u] : 4;
        insole_real_t r = sample_between(&rng, INSOLE_R(-0.9999), INSOLE_R(0.9999));
        insole_spot_fix_t fix = {i + 1u, sample_spot(&rng, size),
                                 insole_sym2(a, r * insole_sqrt(a) * insole_sqrt(b), b),
                                 sample_spot(&rng, wild ? size : 2)};
        worst_require(&held, insole_ml_shift_fix(&ml, &fix) == INSOLE_OK, i);
        worst_require(&held, insole_sym2_is_between(ml.P, INSOLE_R(1e-6), INSOLE_R(1e12)), i);
        worst_require(&held, insole_spot_norm(ml.spot) < INSOLE_R(2e6), i);
        worst_require(&held, ml.var_pdr_m2 > 0 && ml.var_radio_m2 > 0, i);
    }
    ASSERT_ALL_HELD(held);
}
END_TEST

START_TEST(equal_fixes_and_a_standing_walker_are_no_trouble)
{
    insole_ml_shift_t ml = begin(&insole_ml_shift_defaults);
    for (uint64_t t = 1u; t <= 500u; t++) {
        insole_spot_fix_t fix = fix_at(t, insole_spot(7, -3));
        take(&ml, &fix);
    }
    ASSERT_NEAR(ml.spot.x_m, 7.0, 0.01, "m");
    ASSERT_NEAR(ml.spot.y_m, -3.0, 0.01, "m");
    ASSERT_AT_LEAST(ml.P.xx, 3.5, "m^2"); /* equal errors are no knowledge */
}
END_TEST

/* ---- contract ------------------------------------------------------------------------------ */

static insole_ml_shift_config_t config;

static insole_status_t judge(void)
{
    insole_ml_shift_t ml;
    memset(&ml, 0x5a, sizeof ml);
    insole_ml_shift_t before = ml;
    insole_status_t status = insole_ml_shift_init(&ml, &config);
    ck_assert(status == INSOLE_OK || memcmp(&ml, &before, sizeof ml) == 0);
    return status;
}

START_TEST(settings_have_their_ranges)
{
    config = insole_ml_shift_defaults;
    ck_assert_int_eq(config.window, 4);
    INSOLE_ML_SHIFT_KEYS(SETTING_HAS_ENDS)
    insole_ml_shift_t ml;
    memset(&ml, 0x5a, sizeof ml);
    ck_assert_int_eq(insole_ml_shift_init(NULL, &config), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(ml, insole_ml_shift_init(&ml, NULL), INSOLE_ERR_NULL);
}
END_TEST

#define REFUSED(call, why) ASSERT_REFUSED(m, m.refused, call, why)

START_TEST(bad_input_is_refused)
{
    const insole_real_t nan = (insole_real_t)NAN;
    const insole_sym2_t circle = insole_sym2_circle(1);
    const insole_spot_t o = {0, 0};
    insole_ml_shift_t m;
    ck_assert_int_eq(insole_ml_shift_init(&m, &insole_ml_shift_defaults), INSOLE_OK);
    insole_pace_t pace = {1, 0, 0, 0}, bad_pace = {1, nan, 0, 0};
    insole_spot_fix_t fix = fix_at(5u, o), bad_fix = fix;
    bad_fix.since.y_m = nan;
    REFUSED(insole_ml_shift_step(&m, &pace), INSOLE_ERR_STATE);
    REFUSED(insole_ml_shift_fix(&m, &fix), INSOLE_ERR_STATE);
    ck_assert_int_eq(insole_ml_shift_start(NULL, o, circle, 0), INSOLE_ERR_NULL);
    REFUSED(insole_ml_shift_start(&m, insole_spot(nan, 0), circle, 0), INSOLE_ERR_VALUE);
    REFUSED(insole_ml_shift_start(&m, o, insole_sym2_circle(0), 0), INSOLE_ERR_VALUE);
    REFUSED(insole_ml_shift_start(&m, o, circle, nan), INSOLE_ERR_VALUE);
    ck_assert_int_eq(insole_ml_shift_start(&m, o, circle, 0), INSOLE_OK);
    ck_assert_int_eq(insole_ml_shift_step(NULL, &pace), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(m, insole_ml_shift_step(&m, NULL), INSOLE_ERR_NULL);
    REFUSED(insole_ml_shift_step(&m, &bad_pace), INSOLE_ERR_VALUE);
    ck_assert_int_eq(insole_ml_shift_fix(NULL, &fix), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(m, insole_ml_shift_fix(&m, NULL), INSOLE_ERR_NULL);
    REFUSED(insole_ml_shift_fix(&m, &bad_fix), INSOLE_ERR_VALUE);
    take(&m, &fix);
    REFUSED(insole_ml_shift_fix(&m, &fix), INSOLE_ERR_TIME);
    m.spot.y_m = INSOLE_R(-999995.0);
    pace.length_m = 10;
    pace.heading_rad = INSOLE_R(-1.5);
    REFUSED(insole_ml_shift_step(&m, &pace), INSOLE_ERR_VALUE);
}
END_TEST

static void walk(insole_ml_shift_t *ml, uint32_t from, uint32_t to)
{
    for (uint32_t i = from; i < to; i++) {
        insole_rng_t rng;
        insole_rng_seed(&rng, i);
        insole_pace_t pace = some_pace(&rng);
        step(ml, &pace);
        insole_spot_fix_t fix = fix_at(i + 1u, sample_spot(&rng, 6));
        take(ml, &fix);
    }
}

START_TEST(a_saved_state_goes_on_alike)
{
    insole_ml_shift_t ml = begin(&insole_ml_shift_defaults), restored;
    walk(&ml, 0u, 50u);
    unsigned char bytes[sizeof ml + INSOLE_SNAPSHOT_HEADER_BYTES];
    size_t used;
    ck_assert_int_eq(insole_snapshot_save(9u, &ml, sizeof ml, bytes, sizeof bytes, &used),
                     INSOLE_OK);
    ck_assert_int_eq(insole_snapshot_load(9u, &restored, sizeof restored, bytes, used), INSOLE_OK);
    walk(&ml, 50u, 200u);
    walk(&restored, 50u, 200u);
    ck_assert_int_eq(memcmp(&ml, &restored, sizeof ml), 0);
}
END_TEST

/* Bit for bit what the calls themselves do with the same news. */
START_TEST(the_table_is_the_calls_it_names)
{
    const insole_step_filter_calls_t *calls = &insole_ml_shift_calls;
    insole_step_filter_begin_t at = filter_begin();
    insole_step_filter_answer_t answer;
    insole_ml_shift_t direct = begin(&insole_ml_shift_defaults), named = direct;
    insole_rng_t rng;
    insole_rng_seed(&rng, 50u);
    ck_assert_int_eq(insole_ml_shift_start(&direct, at.spot, at.cov_m2, at.offset_rad), INSOLE_OK);
    ck_assert_int_eq(calls->start(&named, &at), INSOLE_OK);
    for (uint32_t i = 1u; i < 100u; i++) {
        insole_pace_t pace = some_pace(&rng);
        insole_spot_fix_t fix = fix_at(i, sample_spot(&rng, 9));
        step(&direct, &pace);
        ck_assert_int_eq(calls->step(&named, i, &pace), INSOLE_OK);
        take(&direct, &fix);
        ck_assert_int_eq(calls->fix(&named, &fix), INSOLE_OK);
        ck_assert_mem_eq(&direct, &named, sizeof direct);
    }
    ck_assert_int_eq(calls->answer(&named, &answer), INSOLE_OK);
    ck_assert_mem_eq(&answer.spot, &direct.spot, sizeof answer.spot);
    ck_assert_mem_eq(&answer.cov_m2, &direct.P, sizeof answer.cov_m2);
    ck_assert(answer.offset_rad == direct.offset_rad);
    ck_assert(answer.var_offset_rad2 == 0 && answer.scale == 1);
    ck_assert(!calls->compass && !calls->work);
}
END_TEST

START_TEST(the_table_refuses_what_the_calls_refuse)
{
    insole_ml_shift_t ml;
    ck_assert_int_eq(insole_ml_shift_init(&ml, &insole_ml_shift_defaults), INSOLE_OK);
    check_filter_calls(&insole_ml_shift_calls, &ml);
    ck_assert_uint_eq(ml.refused, 3u);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("ml_shift");
    suite_add(suite, "search", the_closed_form_is_what_a_search_finds);
    suite_add(suite, "hand", the_shifts_are_those_computed_by_hand);
    suite_add(suite, "sum", the_position_is_start_and_paces_and_shifts);
    suite_add_loop(suite, "sigmas", sigmas_are_those_of_the_numbers_seen, 3);
    suite_add(suite, "memory", what_was_long_ago_is_forgotten);
    suite_add(suite, "better", it_is_better_than_paces_and_than_fixes);
    suite_add(suite, "strides", the_variance_of_strides_corrects_little);
    suite_add(suite, "bound", the_bound_holds_for_any_errors);
    suite_add_loop(suite, "day", a_day_and_any_input_stay_finite, 9);
    suite_add(suite, "equal", equal_fixes_and_a_standing_walker_are_no_trouble);
    suite_add(suite, "settings", settings_have_their_ranges);
    suite_add(suite, "refused", bad_input_is_refused);
    suite_add(suite, "saved", a_saved_state_goes_on_alike);
    suite_add(suite, "table", the_table_is_the_calls_it_names);
    suite_add(suite, "table refuses", the_table_refuses_what_the_calls_refuse);
    return suite;
}
