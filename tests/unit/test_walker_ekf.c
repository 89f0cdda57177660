/* SPDX-License-Identifier: MIT */
#include "insole/fuse/walker_ekf.h"

#include "insole/base/snapshot.h"
#include "insole/fuse/step_ekf.h"
#include "near.h"
#include "plane.h"
#include "refusal.h"
#include "setting.h"
#include "suite.h"
#include "walker.h"

#define PI      3.14159265358979323846
#define EPS     ((double)INSOLE_REAL_EPSILON)
#define UNKNOWN (PI * PI / 3.0)

static insole_rng_t rng;

static double normal(double sigma)
{
    return sigma * (double)insole_rng_normal(&rng);
}

static insole_walker_start_t start_with(insole_real_t offset_rad, double var_rad2, bool by_radio)
{
    insole_walker_start_t start = {
        0u, {0, 0}, insole_sym2_circle(4), offset_rad, (insole_real_t)var_rad2, by_radio};
    return start;
}

static insole_walker_ekf_t begin_known(const insole_walker_ekf_config_t *config)
{
    insole_walker_start_t start = start_with(0, 0.0025, false);
    return walker_begun(config, &start);
}

static insole_spot_fix_t fix_at(uint64_t t_us, insole_spot_t spot, insole_real_t variance)
{
    insole_spot_fix_t fix = {t_us, spot, insole_sym2_circle(variance), {0, 0}};
    return fix;
}

static void take(insole_walker_ekf_t *walker, const insole_spot_fix_t *fix)
{
    ck_assert_int_eq(insole_walker_ekf_fix(walker, fix), INSOLE_OK);
}

static void step(insole_walker_ekf_t *walker, const insole_pace_t *pace)
{
    ck_assert_int_eq(insole_walker_ekf_step(walker, pace), INSOLE_OK);
}

static insole_walker_answer_t answer_of(const insole_walker_ekf_t *walker)
{
    insole_walker_answer_t answer;
    ck_assert_int_eq(insole_walker_ekf_answer(walker, &answer), INSOLE_OK);
    return answer;
}

/* ---- the extended filter by the book, dense and in double ---------------------------------- */

enum { BX, BY, X, Y, OFFSET, SCALE };

typedef struct {
    double x[SIX];
    dense_t P;
    double t_s, ahead; /**< of the newest fix; direction of the newest pace */
    bool has_pace;
} book_t;

static book_t book_of(const insole_walker_start_t *start)
{
    book_t book = {{0.0}, dense_diagonal(0.0), 1e-6 * (double)start->t_us, 0.0, false};
    const double bias2 = 3.5 * 3.5;
    plane_t cov = plane_of(start->cov_m2);
    book.x[X] = (double)start->spot.x_m;
    book.x[Y] = (double)start->spot.y_m;
    book.x[OFFSET] = (double)start->offset_rad;
    book.x[SCALE] = 1.0;
    book.P.at[X][X] = cov.a;
    book.P.at[X][Y] = book.P.at[Y][X] = cov.b;
    book.P.at[Y][Y] = cov.d;
    for (int k = 0; k < 2; k++) {
        book.P.at[BX + k][BX + k] = bias2;
        if (start->by_radio) {
            book.P.at[X + k][X + k] += bias2;
            book.P.at[X + k][BX + k] = book.P.at[BX + k][X + k] = -bias2;
        }
    }
    book.P.at[OFFSET][OFFSET] = (double)start->var_offset_rad2 + 1e-6;
    book.P.at[SCALE][SCALE] = 0.12 * 0.12;
    return book;
}

static double book_short(const book_t *book)
{
    return exp(-0.5 * book->P.at[OFFSET][OFFSET]);
}

static void book_step(book_t *book, const insole_pace_t *pace)
{
    double L = (double)pace->length_m, psi = (double)pace->heading_rad + book->x[OFFSET];
    double s = book->x[SCALE], wx = L * book_short(book) * cos(psi);
    double wy = L * book_short(book) * sin(psi);
    dense_t F = dense_diagonal(1.0);
    F.at[X][OFFSET] = -s * wy;
    F.at[Y][OFFSET] = s * wx;
    F.at[X][SCALE] = wx;
    F.at[Y][SCALE] = wy;
    book->x[X] += s * wx;
    book->x[Y] += s * wy;
    book->P = dense_congruent(&F, &book->P);
    double along = fmax(0.3 * 0.3 * L * L, (double)pace->var_length_m2);
    column_t a = {{0, 0, cos(psi), sin(psi)}}, c = {{0, 0, -sin(psi), cos(psi)}};
    book->P = walker_outer(book->P, s * s * along, &a);
    book->P = walker_outer(book->P, s * s * L * L * 0.07 * 0.07, &c);
    book->P.at[OFFSET][OFFSET] += 0.044 * 0.044;
    double room = 0.12 * 0.12 - book->P.at[SCALE][SCALE];
    book->P.at[SCALE][SCALE] += fmax(0.0, fmin(0.005 * 0.005, room));
    book->ahead = (double)pace->heading_rad;
    book->has_pace = true;
}

static void book_fade(book_t *book, double t_s)
{
    double left = exp(-(t_s - book->t_s) / 15.0);
    dense_t A = dense_diagonal(1.0);
    for (int k = 0; k < 2; k++) {
        A.at[k][k] = left;
        book->x[k] *= left;
    }
    book->P = dense_congruent(&A, &book->P);
    book->P.at[0][0] += 3.5 * 3.5 * (1.0 - left * left);
    book->P.at[1][1] += 3.5 * 3.5 * (1.0 - left * left);
    book->t_s = t_s;
}

/* What is expected of a fix. */
static point_t book_expects(const double *x, double m, const insole_spot_fix_t *fix, bool has_pace,
                            double ahead)
{
    point_t w = point_of(fix->since);
    double c = m * cos(x[OFFSET]), s = m * sin(x[OFFSET]), front = has_pace ? m : 0.0;
    point_t h = {x[X] + x[BX] - x[SCALE] * (c * w.x - s * w.y) + front * cos(ahead + x[OFFSET]),
                 x[Y] + x[BY] - x[SCALE] * (s * w.x + c * w.y) + front * sin(ahead + x[OFFSET])};
    return h;
}

/* Both numbers at once, with slopes by differences. @return the normalised innovation squared */
static double book_fix(book_t *book, const insole_spot_fix_t *fix)
{
    book_fade(book, 1e-6 * (double)fix->t_us);
    double m = book_short(book);
    dense_t H = dense_diagonal(0.0), Ht, PH, A = dense_diagonal(1.0);
    for (int i = 0; i < SIX; i++) {
        double low[SIX], high[SIX];
        memcpy(low, book->x, sizeof low);
        memcpy(high, book->x, sizeof high);
        low[i] -= 1e-5;
        high[i] += 1e-5;
        point_t a = book_expects(low, m, fix, book->has_pace, book->ahead);
        point_t b = book_expects(high, m, fix, book->has_pace, book->ahead);
        H.at[0][i] = (b.x - a.x) / 2e-5;
        H.at[1][i] = (b.y - a.y) / 2e-5;
    }
    Ht = dense_transpose(H);
    PH = dense_mul(&book->P, &Ht);
    dense_t S = dense_mul(&H, &PH);
    plane_t R = plane_of(fix->cov_m2), P = {S.at[0][0], S.at[0][1], S.at[1][0], S.at[1][1]};
    point_t h = book_expects(book->x, m, fix, book->has_pace, book->ahead), z = point_of(fix->spot);
    point_t v = {z.x - h.x, z.y - h.y};
    plane_t W = plane_inverse(plane_add(P, 1.0, R));
    double nis = plane_form(W, v), off = fmax(1.0, nis / 9.0);
    R = plane_add(R, off * off - 1.0, R);
    W = plane_inverse(plane_add(P, 1.0, R));
    for (int i = 0; i < SIX; i++) {
        double kx = PH.at[i][0] * W.a + PH.at[i][1] * W.c;
        double ky = PH.at[i][0] * W.b + PH.at[i][1] * W.d;
        book->x[i] += kx * v.x + ky * v.y;
        for (int j = 0; j < SIX; j++) {
            A.at[i][j] -= kx * H.at[0][j] + ky * H.at[1][j];
        }
    }
    book->P = dense_mul(&A, &book->P);
    return nis;
}

static void book_compass(book_t *book, double offset, double sigma)
{
    column_t h = {{0.0}};
    h.at[OFFSET] = 1.0;
    double v = remainder(offset - book->x[OFFSET], 2.0 * PI);
    column_t K = walker_book(&book->P, &h, sigma * sigma);
    for (int i = 0; i < SIX; i++) {
        book->x[i] += K.at[i] * v;
    }
}

/* Largest difference of a state, in 1-sigmas. */
static double book_apart(const book_t *book, const insole_walker_state_t *s)
{
    double x[SIX] = {(double)s->bias.x_m, (double)s->bias.y_m,   (double)s->spot.x_m,
                     (double)s->spot.y_m, (double)s->offset_rad, (double)s->scale};
    double worst = 0.0;
    for (int i = 0; i < SIX; i++) {
        double off = i == OFFSET ? remainder(book->x[i] - x[i], 2.0 * PI) : book->x[i] - x[i];
        off = fabs(off) / sqrt(book->P.at[i][i]);
        worst = off <= worst ? worst : off;
    }
    return worst;
}

START_TEST(it_is_the_filter_of_the_book)
{
    insole_rng_seed(&rng, 1u + (uint64_t)_i);
    insole_walker_start_t start = {1000000u, {20, -10},      insole_sym2(5, 1, 3),
                                   3,        INSOLE_R(0.05), _i % 2 == 1};
    insole_walker_ekf_config_t config = insole_walker_ekf_defaults;
    config.patience = 1000000; /* no book widens */
    insole_walker_ekf_t walker = walker_begun(&config, &start);
    book_t book = book_of(&start);
    worst_t state = {0.0, 0.0}, cov = {0.0, 0.0}, nis = {0.0, 0.0}, held = {0.0, 0.0};
    for (uint64_t k = 1u; k <= 400u; k++) {
        insole_pace_t pace = {sample_between(&rng, 0, 1), sample_between(&rng, -3, 3),
                              sample_between(&rng, 0, INSOLE_R(0.1)), INSOLE_R(0.02)};
        if (k > 3u) {
            step(&walker, &pace);
            book_step(&book, &pace);
        }
        if (k % 3u == 0u) {
            insole_spot_t way = sample_spot(&rng, k % 30u ? 5 : 40);
            insole_spot_fix_t fix = {1000000u + 600000u * k,
                                     insole_spot_add(walker.state.spot, way), sample_sym2(&rng, 5),
                                     sample_spot(&rng, 2)};
            take(&walker, &fix);
            double expected = book_fix(&book, &fix);
            worst_note(&nis, fabs((double)walker.nis - expected) / (1.0 + expected), (double)k);
        }
        if (k % 5u == 0u) {
            insole_real_t told = sample_between(&rng, 2, 4);
            ck_assert_int_eq(insole_walker_ekf_compass(&walker, told, INSOLE_R(0.5)), INSOLE_OK);
            book_compass(&book, (double)told, 0.5);
        }
        worst_require(&held, !walker.state.is_wide, (double)k);
        worst_note(&state, book_apart(&book, &walker.state), (double)k);
        worst_note(&cov, walker_off(&book.P, &walker.state.P), (double)k);
    }
    ASSERT_ALL_HELD(held);
    ASSERT_WORST(state, 3000.0 * EPS + 1e-8, "1-sigmas");
    ASSERT_WORST(cov, 3000.0 * EPS + 1e-8, "of the sigmas");
    ASSERT_WORST(nis, 10000.0 * EPS + 1e-8, "of it");
    ck_assert_uint_gt(walker.gated, 3u);
}
END_TEST

/* ---- honest -------------------------------------------------------------------------------- */

typedef struct {
    bool by_radio;
    double sigma_offset; /**< of the start; more than pi: nobody knows */
    double compass;      /**< 1-sigma of one every two seconds; 0: none */
    int paces;
} plot_t;

typedef struct {
    point_t at, bias, heard;
    double offset, scale;
} truth_t;

static double heading_at(int k)
{
    return k % 40 < 20 ? 0.3 : 0.3 + 0.5 * PI; /* n; bends like an L, again and again */
}

/* A pace of the truth, and what the phone tells of it. */
static insole_pace_t pace_of(truth_t *truth, int k)
{
    double psi = heading_at(k) + truth->offset + normal(0.07), L = 0.65;
    double way = truth->scale * (L + normal(0.3 * L));
    truth->at.x += way * cos(psi);
    truth->at.y += way * sin(psi);
    truth->offset += normal(0.044);
    double left = exp(-0.5 / 15.0), fresh = 3.5 * sqrt(1.0 - left * left);
    truth->bias.x = left * truth->bias.x + normal(fresh);
    truth->bias.y = left * truth->bias.y + normal(fresh);
    insole_pace_t pace = {(insole_real_t)L, (insole_real_t)heading_at(k), 0, INSOLE_R(0.01)};
    return pace;
}

static insole_spot_fix_t fix_of(const truth_t *truth, int k)
{
    double psi = heading_at(k) + truth->offset;
    insole_sym2_t R = sample_sym2(&rng, 4);
    point_t e = sample_of(&rng, plane_of(R));
    insole_spot_fix_t fix = {(uint64_t)(k + 1) * 500000u,
                             {(insole_real_t)(truth->at.x + truth->bias.x + e.x + cos(psi)),
                              (insole_real_t)(truth->at.y + truth->bias.y + e.y + sin(psi))},
                             R,
                             {0, 0}};
    return fix;
}

static insole_walker_ekf_t begin_walk(const plot_t *plot, truth_t *truth)
{
    truth_t t = {
        {normal(2.0), normal(2.0)}, {normal(3.5), normal(3.5)}, {0, 0}, 0.0, 1.0 + normal(0.12)};
    double told = 6.0 * (double)insole_rng_uniform(&rng) - 3.0;
    t.offset = plot->sigma_offset > PI ? 2.0 * PI * (double)insole_rng_uniform(&rng)
                                       : told + normal(plot->sigma_offset);
    if (plot->by_radio) {
        t.at.x -= t.bias.x;
        t.at.y -= t.bias.y;
    }
    *truth = t;
    insole_walker_start_t start =
        start_with((insole_real_t)told, plot->sigma_offset * plot->sigma_offset, plot->by_radio);
    return walker_begun(&insole_walker_ekf_defaults, &start);
}

static void walker_go(insole_walker_ekf_t *walker, const plot_t *plot, truth_t *truth)
{
    for (int k = 0; k < plot->paces; k++) {
        insole_pace_t pace = pace_of(truth, k);
        step(walker, &pace);
        if (k % 6 == 5) {
            insole_spot_fix_t fix = fix_of(truth, k);
            take(walker, &fix);
        }
        if (plot->compass > 0.0 && k % 4 == 0) {
            double told = truth->offset + normal(plot->compass);
            ck_assert_int_eq(insole_walker_ekf_compass(walker, (insole_real_t)told,
                                                       (insole_real_t)plot->compass),
                             INSOLE_OK);
        }
    }
}

static insole_walker_ekf_t play(const plot_t *plot, truth_t *truth)
{
    insole_walker_ekf_t walker = begin_walk(plot, truth);
    walker_go(&walker, plot, truth);
    return walker;
}

START_TEST(the_covariance_is_honest)
{
    static const plot_t ROWS[] = {
        {false, 0.05, 0.0, 60},  /* all known */
        {true, 0.26, 0.0, 60},   /* found by radio and compass */
        {true, 0.26, 0.79, 120}, /* with the compass as it goes */
        {true, 0.8, 0.0, 60},    {false, 4.0, 0.0, 20},
        {false, 4.0, 0.0, 60},   {true, 4.0, 0.0, 120}, /* by radio alone */
        {false, 4.0, 0.79, 60},  {true, 4.0, 0.0, 400},
    };
    enum { WALKS = 1000 };
    const plot_t *plot = &ROWS[_i];
    insole_rng_seed(&rng, 3u);
    double nees = 0.0, nees_rad = 0.0;
    for (int w = 0; w < WALKS; w++) {
        truth_t truth;
        insole_walker_ekf_t walker = play(plot, &truth);
        insole_walker_answer_t a = answer_of(&walker);
        point_t e = {truth.at.x - (double)a.spot.x_m, truth.at.y - (double)a.spot.y_m};
        double turn = remainder(truth.offset - (double)a.offset_rad, 2.0 * PI);
        nees += plane_form(plane_inverse(plane_of(a.cov_m2)), e) / WALKS;
        nees_rad += turn * turn / (double)a.var_offset_rad2 / WALKS;
    }
    /* 2 and 1 when consistent, with 1-sigmas of 0.063 and 0.045 over 1000 walks */
    ASSERT_AT_LEAST(nees, 1.8, "");
    ASSERT_AT_MOST(nees, 2.3, "");
    ASSERT_AT_LEAST(nees_rad, 0.8, "");
    ASSERT_AT_MOST(nees_rad, 1.2, "");
}
END_TEST

/* Nobody knows the direction, and the fixes are as bad as ever: it is found all the same, and
 * sooner than chance. */
START_TEST(an_unknown_direction_is_found_on_a_bent_walk)
{
    static const struct {
        int paces;
        double most_rad;
    } ROWS[] = {{40, 0.35}, {80, 0.3}};
    const plot_t plot = {_i == 1, 4.0, 0.0, ROWS[_i].paces};
    insole_rng_seed(&rng, 4u);
    double square = 0.0, worst = 0.0;
    for (int w = 0; w < 500; w++) {
        truth_t truth;
        insole_walker_ekf_t walker = play(&plot, &truth);
        double turn = remainder(truth.offset - (double)answer_of(&walker).offset_rad, 2.0 * PI);
        square += turn * turn / 500.0;
        worst = fmax(worst, fabs(turn));
    }
    ASSERT_AT_MOST(sqrt(square), ROWS[_i].most_rad, "rad");
    ASSERT_AT_MOST(worst, 1.6, "rad");
}
END_TEST

/* Told before the first fix, a smaller bias is that of a filter set so; the setting is the most. */
START_TEST(what_fixes_share_can_be_told)
{
    insole_walker_ekf_config_t less = insole_walker_ekf_defaults;
    less.bias_m = INSOLE_R(1.5);
    insole_walker_start_t start = start_with(0, 0.0025, _i == 1);
    insole_walker_ekf_t told, set = walker_begun(&less, &start);
    memset(&told, 0, sizeof told);
    ck_assert_int_eq(insole_walker_ekf_init(&told, &insole_walker_ekf_defaults), INSOLE_OK);
    ck_assert_int_eq(insole_walker_ekf_bias(&told, INSOLE_R(1.5)), INSOLE_OK);
    ck_assert_int_eq(insole_walker_ekf_start(&told, &start), INSOLE_OK);
    insole_walker_ekf_t late = walker_begun(&insole_walker_ekf_defaults, &start);
    ck_assert_int_eq(insole_walker_ekf_bias(&late, INSOLE_R(1.5)), INSOLE_OK);
    insole_rng_seed(&rng, 14u);
    for (uint32_t k = 1u; k <= 20u; k++) {
        insole_pace_t pace = {INSOLE_R(0.7), INSOLE_R(0.1), 0, 0};
        insole_spot_fix_t fix = fix_at(2000000u * k, sample_spot(&rng, 5), 4);
        step(&told, &pace);
        step(&set, &pace);
        step(&late, &pace);
        take(&told, &fix);
        take(&set, &fix);
        take(&late, &fix);
    }
    ck_assert(told.state.spot.x_m == set.state.spot.x_m);
    ck_assert(told.state.bias.y_m == set.state.bias.y_m);
    if (_i == 0) { /* nothing was known of the bias */
        ASSERT_NEAR(late.state.spot.x_m, set.state.spot.x_m, 1.0e-5, "m");
    }
    ck_assert_int_eq(insole_walker_ekf_bias(&told, 100), INSOLE_OK);
    ck_assert(told.bias_m == insole_walker_ekf_defaults.bias_m);
}
END_TEST

/* What is ignored costs: the same filter without a bias claims too much. */
START_TEST(without_a_bias_it_claims_too_much)
{
    const plot_t plot = {false, 0.05, 0.0, 60};
    insole_rng_seed(&rng, 5u);
    double with = 0.0, without = 0.0;
    for (int w = 0; w < 200; w++) {
        for (int k = 0; k < 2; k++) {
            truth_t truth;
            insole_rng_t now = rng;
            insole_walker_ekf_t walker = begin_walk(&plot, &truth);
            walker.bias_m = k ? INSOLE_R(0.0) : walker.bias_m;
            walker_go(&walker, &plot, &truth);
            insole_walker_answer_t a = answer_of(&walker);
            point_t e = {truth.at.x - (double)a.spot.x_m, truth.at.y - (double)a.spot.y_m};
            double *nees = k ? &without : &with;
            *nees += plane_form(plane_inverse(plane_of(a.cov_m2)), e) / 200.0;
            rng = k ? rng : now;
        }
    }
    ASSERT_AT_LEAST(without, 1.5 * with, "");
}
END_TEST

/* ---- special cases ------------------------------------------------------------------------- */

/* Direction and scale known, no bias, nothing ahead: two states, as in step_fusion.h. */
START_TEST(what_is_linear_is_the_plain_filter)
{
    insole_walker_ekf_config_t config = insole_walker_ekf_defaults;
    config.sigma_scale = INSOLE_R(0.001);
    config.wander_scale = config.turn_rad = config.bias_m = config.ahead_m = 0;
    insole_step_fusion_config_t plainly = insole_step_fusion_defaults;
    config.patience = plainly.patience = 1000000; /* one widens the offset, too */
    insole_walker_start_t start = start_with(INSOLE_R(0.7), 0.0, _i == 1);
    insole_walker_ekf_t walker = walker_begun(&config, &start);
    insole_step_fusion_t plain;
    ck_assert_int_eq(insole_step_fusion_init(&plain, &plainly), INSOLE_OK);
    ck_assert_int_eq(insole_step_fusion_start(&plain, start.spot, start.cov_m2, start.offset_rad),
                     INSOLE_OK);
    insole_rng_seed(&rng, 6u);
    worst_t spot = {0.0, 0.0}, cov = {0.0, 0.0};
    for (uint64_t k = 1u; k <= 100u; k++) {
        insole_pace_t pace = {sample_between(&rng, 0, 1), sample_between(&rng, -3, 3), 0, 0};
        step(&walker, &pace);
        pace.var_length_m2 = insole_square(config.along * pace.length_m);
        pace.var_heading_rad2 = insole_square(config.across_rad);
        ck_assert_int_eq(insole_step_fusion_step(&plain, insole_step_ekf, &pace), INSOLE_OK);
        insole_spot_fix_t fix = {k, insole_spot_add(plain.spot, sample_spot(&rng, 5)),
                                 sample_sym2(&rng, 4), sample_spot(&rng, 3)};
        take(&walker, &fix);
        ck_assert_int_eq(insole_step_fusion_fix(&plain, &fix), INSOLE_OK);
        worst_note(&spot, point_apart(point_of(plain.spot), walker.state.spot), (double)k);
        worst_note(&cov, plane_apart(plane_of(plain.P), answer_of(&walker).cov_m2), (double)k);
    }
    /* what 1e-3 of scale and offset do on a hundred paces of half a metre each */
    ASSERT_WORST(spot, 0.01, "m");
    ASSERT_WORST(cov, 0.01, "m^2");
    ck_assert_uint_eq(walker.gated, plain.gated);
}
END_TEST

/* Fixes for an hour where the walker stands: the bias keeps them from telling all. */
START_TEST(who_stands_still_stays)
{
    insole_walker_ekf_t walker = begin_known(&insole_walker_ekf_defaults);
    insole_rng_seed(&rng, 7u);
    insole_spot_t here = {5, 5};
    for (uint64_t k = 1u; k <= 1800u; k++) {
        insole_pace_t standing = {0, 1, 0, 0};
        step(&walker, &standing);
        insole_spot_t noise = {(insole_real_t)normal(_i ? 0.0 : 2.0),
                               (insole_real_t)normal(_i ? 0.0 : 2.0)};
        insole_spot_fix_t fix = fix_at(2000000u * k, insole_spot_add(here, noise), 4);
        take(&walker, &fix);
    }
    insole_walker_answer_t a = answer_of(&walker);
    ASSERT_AT_MOST(insole_spot_norm(insole_spot_sub(a.spot, here)), 0.5, "m");
    /* no better than the mean of a process of 3.5 m and 15 s over an hour */
    double mean2 = 3.5 * 3.5 * 2.0 * 15.0 / 3600.0;
    ASSERT_AT_LEAST(a.cov_m2.xx, 0.8 * mean2, "m^2");
    ASSERT_AT_MOST(a.cov_m2.xx, 1.5 * mean2, "m^2");
    ASSERT_NEAR(a.scale, 1.0, 1e-3, ""); /* standing tells nothing of it */
    ck_assert_uint_eq(walker.ahead.cos == 0 && walker.ahead.sin == 0, 1u);
}
END_TEST

START_TEST(without_fixes_it_goes_on_and_knows_less)
{
    insole_walker_ekf_t walker = begin_known(&insole_walker_ekf_defaults);
    insole_real_t before = 0;
    for (int k = 0; k < 20000; k++) {
        insole_pace_t pace = {INSOLE_R(0.7), 1, 0, 0};
        step(&walker, &pace);
        if (k % 100 == 0) {
            insole_real_t now = insole_sym2_largest(answer_of(&walker).cov_m2);
            ck_assert(now >= before);
            before = now;
        }
    }
    insole_walker_answer_t a = answer_of(&walker);
    ck_assert(walker.state.is_wide);
    ASSERT_NEAR(a.var_offset_rad2, INSOLE_HEADING_MOST_R2, 0.0, "rad^2");
    ASSERT_NEAR(a.var_scale, 0.0144, 1e-6, "");
    ASSERT_AT_LEAST(a.cov_m2.xx + a.cov_m2.yy, 1e5, "m^2");
    /* a random walk whose steps turn by 0.044 rad goes about 700 m: it cannot be 14 km away */
    ASSERT_AT_MOST(insole_spot_norm(a.spot), 800.0, "m");
    insole_spot_fix_t fix = fix_at(1u << 30, insole_spot(-300, 200), 9);
    take(&walker, &fix);
    ck_assert_uint_eq(walker.gated, 0u);
    ASSERT_AT_MOST(insole_spot_norm(insole_spot_sub(walker.state.spot, fix.spot)), 3.0, "m");
}
END_TEST

START_TEST(fixes_that_are_all_equal_do_no_harm)
{
    insole_walker_ekf_t walker = begin_known(&insole_walker_ekf_defaults);
    worst_t held = {0.0, 0.0};
    for (uint64_t k = 1u; k <= 5000u; k++) {
        insole_pace_t pace = {INSOLE_R(0.7), INSOLE_R(0.2) * (insole_real_t)(k % 31u), 0, 0};
        step(&walker, &pace);
        insole_spot_fix_t fix = fix_at(1000000u * k, insole_spot(3, 4), INSOLE_SPOT_LEAST_M2);
        take(&walker, &fix);
        worst_require(&held, walker_is_sane(&walker.state.P), (double)k);
        worst_require(&held, insole_spot_norm(walker.state.spot) < 30, (double)k);
    }
    ASSERT_ALL_HELD(held);
}
END_TEST

/* At 100 km a float has 8 mm: the walk is the same but for that. */
START_TEST(far_from_the_origin_it_is_the_same_walk)
{
    static const insole_spot_t FAR = {INSOLE_R(98304.0), INSOLE_R(-98304.0)};
    const plot_t plot = {true, 0.26, 0.0, 0};
    insole_rng_seed(&rng, 8u);
    truth_t truth;
    insole_walker_ekf_t near = begin_walk(&plot, &truth), far = near;
    far.state.spot = insole_spot_add(far.state.spot, FAR);
    worst_t off = {0.0, 0.0};
    for (int k = 0; k < 2000; k++) {
        insole_pace_t pace = pace_of(&truth, k);
        step(&near, &pace);
        step(&far, &pace);
        if (k % 6 == 5) {
            insole_spot_fix_t fix = fix_of(&truth, k);
            take(&near, &fix);
            fix.spot = insole_spot_add(fix.spot, FAR);
            take(&far, &fix);
        }
        insole_spot_t back = insole_spot_sub(far.state.spot, FAR);
        worst_note(&off, point_apart(point_of(back), near.state.spot), k);
    }
    ASSERT_WORST(off, 0.1, "m");
}
END_TEST

/* ---- what paces tell ----------------------------------------------------------------------- */

static insole_sym2_t cov_after(insole_real_t var_length_m2, const double *told, int paces,
                               insole_walker_ekf_t *walker)
{
    *walker = begin_known(&insole_walker_ekf_defaults);
    for (int k = 0; k < paces; k++) {
        insole_pace_t pace = {1, 0, var_length_m2, (insole_real_t)told[k]};
        step(walker, &pace);
    }
    return insole_walker_cov_pair(&walker->state.P, INSOLE_WALKER_X);
}

START_TEST(the_larger_variance_of_a_length_counts)
{
    static const double NONE[1] = {0.0};
    insole_walker_ekf_t walker;
    double by_setting = (double)cov_after(0, NONE, 1, &walker).xx;
    double less = (double)cov_after(INSOLE_R(0.05), NONE, 1, &walker).xx;
    double more = (double)cov_after(1, NONE, 1, &walker).xx;
    ASSERT_NEAR(by_setting, 4.0 + 0.0144 * exp(-0.0025) + 0.09, 1e-4, "m^2");
    ASSERT_NEAR(less, by_setting, 0.0, "m^2");
    ASSERT_NEAR(more, by_setting + 0.91, 1e-5, "m^2");
}
END_TEST

/* A level that stays is the offset's; one pace that is unsure is unsure alone; a level that rises
 * turns the offset. */
START_TEST(a_told_heading_is_split)
{
    static const double LEVEL[4] = {0.0, 0.0, 0.0, 0.0}, HIGH[4] = {1.0, 1.0, 1.0, 1.0},
                        ONE_PACE[4] = {0.02, 0.02, 9.0, 0.02}, RISE[4] = {0.0, 0.1, 0.1, 0.1};
    insole_walker_ekf_t level, high, one, rise;
    insole_sym2_t P = cov_after(0, LEVEL, 4, &level), P_high = cov_after(0, HIGH, 4, &high);
    insole_sym2_t P_one = cov_after(0, ONE_PACE, 4, &one);
    (void)cov_after(0, RISE, 4, &rise);
    ASSERT_AT_MOST(plane_apart(plane_of(P), P_high), 0.0, "m^2");
    double usual = (double)answer_of(&level).var_offset_rad2;
    ASSERT_NEAR(usual, 0.0025 + 1e-6 + 4.0 * 0.044 * 0.044, 1e-6, "rad^2");
    ASSERT_NEAR(answer_of(&one).var_offset_rad2, usual, 1e-6, "rad^2");
    ASSERT_NEAR(answer_of(&rise).var_offset_rad2, usual + 0.1 - 0.044 * 0.044, 1e-5, "rad^2");
    /* that pace: the moments of its direction, and next to nothing of its way */
    double kept = exp(0.02 - UNKNOWN), less = 16.0 - pow(3.0 + sqrt(kept), 2.0);
    ASSERT_NEAR(P_one.yy - P.yy, 0.5 * (1.0 - kept * kept) - 0.0025 * less, 0.015, "m^2");
    ASSERT_NEAR(P_one.xx - P.xx, 0.5 * pow(1.0 - kept, 2.0) - 0.0144 * less, 0.005, "m^2");
    ASSERT_NEAR(level.state.spot.x_m, 4.0, 0.03, "m");
    ASSERT_NEAR(one.state.spot.x_m, 3.2, 0.03, "m");
}
END_TEST

/* ---- the gate ------------------------------------------------------------------------------ */

START_TEST(one_far_fix_does_little)
{
    insole_walker_ekf_t walker = begin_known(&insole_walker_ekf_defaults);
    insole_spot_fix_t fix = fix_at(1u, insole_spot(90, 0), 4);
    take(&walker, &fix);
    ASSERT_NEAR(walker.nis, 8100.0 / (4.0 + 12.25 + 4.0), 0.01, "");
    ck_assert_uint_eq(walker.gated, 1u);
    ck_assert_uint_eq(walker.gated_in_row, 1u);
    double r = 4.0 * (400.0 / 9.0) * (400.0 / 9.0);
    ASSERT_NEAR(walker.state.spot.x_m, 90.0 * 4.0 / (r + 16.25), 1e-3, "m");
    ASSERT_NEAR(walker.state.bias.x_m, 90.0 * 12.25 / (r + 16.25), 1e-3, "m");
    fix = fix_at(2u, insole_spot(1, 0), 4);
    take(&walker, &fix);
    ck_assert_uint_eq(walker.gated_in_row, 0u);
}
END_TEST

/* Carried off by `away`, or turned about, or both, in the midst of a walk. */
START_TEST(who_was_lost_is_found_again)
{
    static const struct {
        double away_m, turn_rad;
        int paces;
        double most_m;
    } ROWS[] = {{30.0, 0.0, 90, 5.0},  {300.0, 0.0, 120, 5.0}, {50000.0, 0.0, 240, 5.5},
                {0.0, 1.57, 300, 5.0}, {0.0, 3.14, 360, 5.5},  {100.0, -2.0, 180, 5.5}};
    const plot_t plot = {false, 0.05, 0.0, 60};
    insole_rng_seed(&rng, 9u);
    double square = 0.0;
    for (int w = 0; w < 200; w++) {
        truth_t truth;
        insole_walker_ekf_t walker = play(&plot, &truth);
        truth.at.x += ROWS[_i].away_m;
        truth.offset += ROWS[_i].turn_rad;
        for (int k = 60; k < 60 + ROWS[_i].paces; k++) {
            insole_pace_t pace = pace_of(&truth, k);
            step(&walker, &pace);
            if (k % 6 == 5) {
                insole_spot_fix_t fix = fix_of(&truth, k);
                take(&walker, &fix);
            }
        }
        square += pow(point_apart(truth.at, walker.state.spot), 2.0) / 200.0;
    }
    ASSERT_AT_MOST(sqrt(square), ROWS[_i].most_m, "m"); /* 4.4 m for those who never were */
}
END_TEST

/* ---- the compass --------------------------------------------------------------------------- */

/* One look at it, when nothing is known, leaves what it tells. */
START_TEST(a_compass_tells_an_unknown_direction)
{
    static const double SIGMA[] = {0.05, 0.26, 0.5, 0.79, 1.2};
    double sigma = SIGMA[_i];
    insole_walker_start_t start = start_with(1, UNKNOWN, false);
    insole_walker_ekf_t walker = walker_begun(&insole_walker_ekf_defaults, &start);
    ck_assert_int_eq(insole_walker_ekf_compass(&walker, -3, (insole_real_t)sigma), INSOLE_OK);
    insole_walker_answer_t a = answer_of(&walker);
    ASSERT_NEAR(a.offset_rad, -3.0, 3e-3, "rad"); /* a thousandth is left of the start */
    ASSERT_NEAR(sqrt((double)a.var_offset_rad2), sigma, 0.03 * sigma, "rad");
    ck_assert_int_eq(walker.state.is_wide, sigma > 0.36);
    ASSERT_NEAR(a.scale, 1.0, 0.02, "");
}
END_TEST

START_TEST(a_compass_goes_round)
{
    insole_walker_start_t start = start_with(INSOLE_R(3.1), 0.04, false);
    insole_walker_ekf_t walker = walker_begun(&insole_walker_ekf_defaults, &start);
    ck_assert_int_eq(insole_walker_ekf_compass(&walker, INSOLE_R(-3.1), INSOLE_R(0.2)), INSOLE_OK);
    ASSERT_NEAR(fabs((double)walker.state.offset_rad), PI, 1e-4, "rad"); /* the middle */
    ASSERT_NEAR(answer_of(&walker).var_offset_rad2, 0.02, 1e-5, "rad^2");
}
END_TEST

START_TEST(a_compass_that_knows_nothing_tells_nothing)
{
    insole_walker_start_t start = start_with(1, _i ? UNKNOWN : 0.04, false);
    insole_walker_ekf_t walker = walker_begun(&insole_walker_ekf_defaults, &start);
    ASSERT_UNCHANGED(walker, insole_walker_ekf_compass(&walker, 2, INSOLE_R(1.82)), INSOLE_OK);
}
END_TEST

/* ---- for ever ------------------------------------------------------------------------------ */

static insole_pace_t any_pace(void)
{
    insole_pace_t pace = {sample_between(&rng, 0, 1), sample_between(&rng, -3, 3),
                          sample_between(&rng, 0, INSOLE_R(0.02)),
                          sample_between(&rng, 0, INSOLE_R(0.2))};
    return pace;
}

START_TEST(a_day_leaves_a_covariance)
{
    insole_walker_start_t start = start_with(0, _i ? UNKNOWN : 0.01, _i == 1);
    insole_walker_ekf_t walker = walker_begun(&insole_walker_ekf_defaults, &start);
    insole_rng_seed(&rng, 10u);
    worst_t held = {0.0, 0.0};
    for (uint32_t i = 0u; i < 170000u; i++) {
        insole_pace_t pace = any_pace();
        worst_require(&held, insole_walker_ekf_step(&walker, &pace) == INSOLE_OK, i);
        if (i % 4u == 0u && i % 20000u < 15000u) {
            insole_real_t size = insole_exp(sample_between(&rng, -4, 4));
            insole_spot_fix_t fix = {500000u * ((uint64_t)i + 1u), sample_spot(&rng, 50),
                                     sample_sym2(&rng, size), sample_spot(&rng, 3)};
            worst_require(&held, insole_walker_ekf_fix(&walker, &fix) == INSOLE_OK, i);
        }
        if (i % 4u == 1u && i % 50000u < 20000u) {
            (void)insole_walker_ekf_compass(&walker, sample_between(&rng, 0, 2), INSOLE_R(0.8));
        }
        insole_walker_answer_t a;
        (void)insole_walker_ekf_answer(&walker, &a);
        worst_require(&held, walker_is_sane(&walker.state.P), i);
        worst_require(&held, insole_sym2_is_between(a.cov_m2, INSOLE_R(1e-6), INSOLE_R(1e12)), i);
        worst_require(&held, a.var_offset_rad2 > 0 && a.var_scale > 0, i);
        worst_require(&held, insole_spot_norm(a.spot) < 20000, i);
    }
    ASSERT_ALL_HELD(held);
}
END_TEST

START_TEST(the_extremes_that_are_taken_stay_finite)
{
    insole_walker_ekf_config_t config = insole_walker_ekf_defaults;
    config.gate = _i % 2 ? INSOLE_R(0.1) : INSOLE_R(1e9);
    config.widen = 100;
    config.patience = 3;
    config.sigma_scale = _i < 2 ? INSOLE_R(0.001) : 1;
    config.bias_m = _i < 2 ? 0 : 100;
    insole_walker_ekf_t walker = begin_known(&config);
    insole_rng_seed(&rng, 11u);
    static const insole_real_t SIZE[] = {INSOLE_R(1e-6), 1, INSOLE_R(1e12)};
    worst_t held = {0.0, 0.0};
    for (uint32_t i = 0u; i < 20000u; i++) {
        insole_real_t a = SIZE[insole_rng_bits(&rng) % 3u], b = SIZE[insole_rng_bits(&rng) % 3u];
        insole_real_t r = sample_between(&rng, INSOLE_R(-0.9999), INSOLE_R(0.9999));
        insole_spot_fix_t fix = {(uint64_t)1 << (i / 400u), sample_spot(&rng, INSOLE_R(1e5)),
                                 insole_sym2(a, r * insole_sqrt(a) * insole_sqrt(b), b),
                                 sample_spot(&rng, INSOLE_R(1e5))};
        fix.t_us += i;
        worst_require(&held, insole_walker_ekf_fix(&walker, &fix) == INSOLE_OK, i);
        insole_pace_t pace = {10, sample_between(&rng, -1000, 1000), 100, INSOLE_R(1e30)};
        pace.var_heading_rad2 = i % 3u ? pace.var_heading_rad2 : INSOLE_R(0.0);
        (void)insole_walker_ekf_step(&walker, &pace);
        (void)insole_walker_ekf_compass(&walker, sample_between(&rng, -1000, 1000),
                                        i % 2u ? INSOLE_R(0.001) : 1);
        worst_require(&held, walker_is_sane(&walker.state.P), i);
        worst_require(&held, insole_spot_is_in_reach(walker.state.spot), i);
        worst_require(&held, insole_is_finite(walker.state.c.cos + walker.state.c.sin), i);
        worst_require(&held, insole_spot_is_finite(walker.state.bias), i);
    }
    ASSERT_ALL_HELD(held);
}
END_TEST

/* ---- contract ------------------------------------------------------------------------------ */

static insole_walker_ekf_config_t config;

static insole_status_t judge(void)
{
    insole_walker_ekf_t walker, before;
    memset(&walker, 0x5a, sizeof walker);
    memcpy(&before, &walker, sizeof walker);
    insole_status_t status = insole_walker_ekf_init(&walker, &config);
    ck_assert(status == INSOLE_OK || memcmp(&walker, &before, sizeof walker) == 0);
    return status;
}

START_TEST(settings_have_their_ranges)
{
    config = insole_walker_ekf_defaults;
    INSOLE_WALKER_EKF_KEYS(SETTING_HAS_ENDS)
    insole_walker_ekf_t walker;
    memset(&walker, 0x5a, sizeof walker);
    ck_assert_int_eq(insole_walker_ekf_init(NULL, &config), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(walker, insole_walker_ekf_init(&walker, NULL), INSOLE_ERR_NULL);
}
END_TEST

#define REFUSED(call, why) ASSERT_REFUSED(f, f.refused, call, why)

START_TEST(a_bad_start_is_refused)
{
    const insole_real_t nan = (insole_real_t)NAN, bad_rad[] = {1001, nan};
    insole_walker_ekf_t f = begin_known(&insole_walker_ekf_defaults);
    insole_walker_start_t good = start_with(0, 1.0, true), start = good;
    ck_assert_int_eq(insole_walker_ekf_start(NULL, &good), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(f, insole_walker_ekf_start(&f, NULL), INSOLE_ERR_NULL);
    start.spot.x_m = nan;
    REFUSED(insole_walker_ekf_start(&f, &start), INSOLE_ERR_VALUE);
    start.spot.x_m = INSOLE_R(2e5);
    REFUSED(insole_walker_ekf_start(&f, &start), INSOLE_ERR_VALUE);
    start = good;
    start.cov_m2 = insole_sym2(1, 1, 1);
    REFUSED(insole_walker_ekf_start(&f, &start), INSOLE_ERR_VALUE);
    for (int k = 0; k < 2; k++) {
        start = good;
        start.offset_rad = bad_rad[k];
        REFUSED(insole_walker_ekf_start(&f, &start), INSOLE_ERR_VALUE);
        start = good;
        start.var_offset_rad2 = k ? nan : -1;
        REFUSED(insole_walker_ekf_start(&f, &start), INSOLE_ERR_VALUE);
    }
    start.var_offset_rad2 = (insole_real_t)INFINITY;
    REFUSED(insole_walker_ekf_start(&f, &start), INSOLE_ERR_VALUE);
}
END_TEST

START_TEST(bad_input_is_refused)
{
    const insole_real_t nan = (insole_real_t)NAN;
    insole_walker_ekf_t f;
    insole_walker_answer_t answer;
    memset(&f, 0, sizeof f);
    memset(&answer, 0x5a, sizeof answer);
    ck_assert_int_eq(insole_walker_ekf_init(&f, &insole_walker_ekf_defaults), INSOLE_OK);
    insole_pace_t pace = {1, 0, 0, 0}, bad_pace = {-1, 0, 0, 0};
    insole_spot_fix_t fix = fix_at(5u, insole_spot(1, 1), 1), bad_fix = fix;
    bad_fix.cov_m2.xy = nan;
    REFUSED(insole_walker_ekf_step(&f, &pace), INSOLE_ERR_STATE);
    REFUSED(insole_walker_ekf_fix(&f, &fix), INSOLE_ERR_STATE);
    REFUSED(insole_walker_ekf_compass(&f, 0, 1), INSOLE_ERR_STATE);
    ASSERT_UNCHANGED(answer, insole_walker_ekf_answer(&f, &answer), INSOLE_ERR_STATE);
    insole_walker_start_t start = start_with(0, 0.1, false);
    ck_assert_int_eq(insole_walker_ekf_start(&f, &start), INSOLE_OK);
    ck_assert_int_eq(insole_walker_ekf_answer(NULL, &answer), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(f, insole_walker_ekf_answer(&f, NULL), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_walker_ekf_step(NULL, &pace), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(f, insole_walker_ekf_step(&f, NULL), INSOLE_ERR_NULL);
    REFUSED(insole_walker_ekf_step(&f, &bad_pace), INSOLE_ERR_VALUE);
    ck_assert_int_eq(insole_walker_ekf_fix(NULL, &fix), INSOLE_ERR_NULL);
    ASSERT_UNCHANGED(f, insole_walker_ekf_fix(&f, NULL), INSOLE_ERR_NULL);
    REFUSED(insole_walker_ekf_fix(&f, &bad_fix), INSOLE_ERR_VALUE);
    ck_assert_int_eq(insole_walker_ekf_compass(NULL, 0, 1), INSOLE_ERR_NULL);
    ck_assert_int_eq(insole_walker_ekf_bias(NULL, 1), INSOLE_ERR_NULL);
    REFUSED(insole_walker_ekf_bias(&f, -1), INSOLE_ERR_VALUE);
    REFUSED(insole_walker_ekf_bias(&f, nan), INSOLE_ERR_VALUE);
    REFUSED(insole_walker_ekf_compass(&f, nan, 1), INSOLE_ERR_VALUE);
    REFUSED(insole_walker_ekf_compass(&f, 1001, 1), INSOLE_ERR_VALUE);
    REFUSED(insole_walker_ekf_compass(&f, 0, INSOLE_R(0.0009)), INSOLE_ERR_VALUE);
    REFUSED(insole_walker_ekf_compass(&f, 0, nan), INSOLE_ERR_VALUE);
    REFUSED(insole_walker_ekf_compass(&f, 0, (insole_real_t)INFINITY), INSOLE_ERR_VALUE);
    ck_assert_int_eq(insole_walker_ekf_fix(&f, &fix), INSOLE_OK);
    REFUSED(insole_walker_ekf_fix(&f, &fix), INSOLE_ERR_TIME);
    fix.t_us = 4u;
    REFUSED(insole_walker_ekf_fix(&f, &fix), INSOLE_ERR_TIME);
    f.state.spot.x_m = INSOLE_R(999995.0);
    pace.length_m = 10;
    REFUSED(insole_walker_ekf_step(&f, &pace), INSOLE_ERR_VALUE);
}
END_TEST

/* A start anew is a start; also at a time before. */
START_TEST(a_start_anew_forgets)
{
    const plot_t plot = {true, 4.0, 0.0, 60};
    truth_t truth;
    insole_rng_seed(&rng, 12u);
    insole_walker_ekf_t used = play(&plot, &truth);
    insole_walker_ekf_t fresh = begin_known(&insole_walker_ekf_defaults);
    insole_walker_start_t start = start_with(0, 0.0025, false);
    ck_assert_int_eq(insole_walker_ekf_start(&used, &start), INSOLE_OK);
    for (int k = 0; k < 20; k++) {
        insole_pace_t pace = any_pace();
        step(&used, &pace);
        step(&fresh, &pace);
        insole_spot_fix_t fix = fix_at((uint64_t)k + 1u, sample_spot(&rng, 5), 4);
        take(&used, &fix);
        take(&fresh, &fix);
    }
    ck_assert_int_eq(memcmp(&used.state.P, &fresh.state.P, sizeof used.state.P), 0);
    ck_assert_int_eq(memcmp(&used.state.spot, &fresh.state.spot, sizeof used.state.spot), 0);
    ck_assert_uint_eq(used.fixes, 20u);
    ck_assert_uint_eq(used.steps, 20u);
}
END_TEST

static void go_on(insole_walker_ekf_t *walker, uint32_t from, uint32_t to)
{
    for (uint32_t i = from; i < to; i++) {
        insole_rng_seed(&rng, i);
        insole_pace_t pace = any_pace();
        step(walker, &pace);
        insole_spot_fix_t fix =
            fix_at(500000u * (i + 1u), sample_spot(&rng, i % 20u < 10u ? 5 : 90), 3);
        take(walker, &fix);
    }
}

START_TEST(a_saved_state_goes_on_alike)
{
    insole_walker_ekf_t walker = begin_known(&insole_walker_ekf_defaults), restored;
    go_on(&walker, 0u, 50u);
    unsigned char bytes[sizeof walker + INSOLE_SNAPSHOT_HEADER_BYTES];
    size_t used;
    ck_assert_int_eq(insole_snapshot_save(9u, &walker, sizeof walker, bytes, sizeof bytes, &used),
                     INSOLE_OK);
    ck_assert_int_eq(insole_snapshot_load(9u, &restored, sizeof restored, bytes, used), INSOLE_OK);
    go_on(&walker, 50u, 200u);
    go_on(&restored, 50u, 200u);
    ck_assert_int_eq(memcmp(&walker, &restored, sizeof walker), 0);
    ck_assert_uint_gt(walker.widened, 0u);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("walker_ekf");
    suite_add_loop(suite, "book", it_is_the_filter_of_the_book, 4);
    suite_add_loop(suite, "honest", the_covariance_is_honest, 9);
    suite_add_loop(suite, "found", an_unknown_direction_is_found_on_a_bent_walk, 2);
    suite_add_loop(suite, "told bias", what_fixes_share_can_be_told, 2);
    suite_add(suite, "bias", without_a_bias_it_claims_too_much);
    suite_add_loop(suite, "linear", what_is_linear_is_the_plain_filter, 2);
    suite_add_loop(suite, "stands", who_stands_still_stays, 2);
    suite_add(suite, "alone", without_fixes_it_goes_on_and_knows_less);
    suite_add(suite, "equal", fixes_that_are_all_equal_do_no_harm);
    suite_add(suite, "far", far_from_the_origin_it_is_the_same_walk);
    suite_add(suite, "length", the_larger_variance_of_a_length_counts);
    suite_add(suite, "split", a_told_heading_is_split);
    suite_add(suite, "gate", one_far_fix_does_little);
    suite_add_loop(suite, "lost", who_was_lost_is_found_again, 6);
    suite_add_loop(suite, "compass", a_compass_tells_an_unknown_direction, 5);
    suite_add(suite, "round", a_compass_goes_round);
    suite_add_loop(suite, "silent", a_compass_that_knows_nothing_tells_nothing, 2);
    suite_add_loop(suite, "day", a_day_leaves_a_covariance, 2);
    suite_add_loop(suite, "extremes", the_extremes_that_are_taken_stay_finite, 4);
    suite_add(suite, "settings", settings_have_their_ranges);
    suite_add(suite, "start", a_bad_start_is_refused);
    suite_add(suite, "refused", bad_input_is_refused);
    suite_add(suite, "anew", a_start_anew_forgets);
    suite_add(suite, "saved", a_saved_state_goes_on_alike);
    return suite;
}
