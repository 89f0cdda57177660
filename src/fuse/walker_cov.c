/* SPDX-License-Identifier: MIT */
#include "insole/fuse/walker_cov.h"

#define ZERO INSOLE_R(0.0)
#define ONE  INSOLE_R(1.0)

enum {
    N = INSOLE_WALKER_STATES,
    X = INSOLE_WALKER_X,
    Y = INSOLE_WALKER_X + 1,
    FIRST = INSOLE_WALKER_TURN,
    SECOND = INSOLE_WALKER_TURN + 1
};

/* The entry of U in row 0 of this column. */
static inline insole_real_t *column(insole_walker_cov_t *P, int j)
{
    return P->U + j * (j - 1) / 2;
}

static inline const insole_real_t *column_of(const insole_walker_cov_t *P, int j)
{
    return P->U + j * (j - 1) / 2;
}

insole_walker_column_t insole_walker_column(int place, insole_spot_t pair)
{
    insole_walker_column_t v = {{ZERO, ZERO, ZERO, ZERO, ZERO, ZERO}};
    v.at[place] = pair.x_m;
    v.at[place + 1] = pair.y_m;
    return v;
}

/* From the last state on, each takes its share of the new variance; what is left of v is that part
 * which the states so far do not explain. */
void insole_walker_cov_add(insole_walker_cov_t *P, insole_real_t weight, insole_walker_column_t v)
{
    for (int j = N - 1; j >= 0 && weight > ZERO; j--) {
        insole_real_t vj = v.at[j], old = P->D[j], share = weight * vj;
        insole_real_t d = old + share * vj;
        if (!(d > old)) {
            continue;
        }
        insole_real_t *u = column(P, j), per = ONE / d;
        share *= per;
        for (int i = 0; i < j; i++) {
            v.at[i] -= vj * u[i];
            u[i] += share * v.at[i];
        }
        P->D[j] = d;
        weight *= old * per;
    }
}

void insole_walker_cov_add_pair(insole_walker_cov_t *P, int place, insole_sym2_t Q)
{
    insole_real_t slope = Q.yy > ZERO ? Q.xy / Q.yy : ZERO;
    insole_walker_cov_add(P, Q.yy, insole_walker_column(place, insole_spot(slope, ONE)));
    insole_walker_cov_add(P, Q.xx - slope * Q.xy,
                          insole_walker_column(place, insole_spot(ONE, ZERO)));
}

void insole_walker_cov_walk(insole_walker_cov_t *P, insole_spot_t by_first, insole_spot_t by_second)
{
    insole_real_t *first = column(P, FIRST), *second = column(P, SECOND);
    insole_real_t u = second[FIRST];
    first[X] += by_first.x_m;
    first[Y] += by_first.y_m;
    second[X] += by_first.x_m * u + by_second.x_m;
    second[Y] += by_first.y_m * u + by_second.y_m;
}

/* U between both biases stays: they fade alike. */
void insole_walker_cov_fade(insole_walker_cov_t *P, insole_real_t left)
{
    for (int b = INSOLE_WALKER_BIAS; b < X; b++) {
        P->D[b] *= left * left;
        for (int j = X; j < N; j++) {
            column(P, j)[b] *= left;
        }
    }
}

/* The regression of the other states on the last two is multiplied by the inverse of T; what it
 * does not explain stays as it is. */
void insole_walker_cov_turn(insole_walker_cov_t *P, insole_spot_t row_first,
                            insole_spot_t row_second)
{
    insole_real_t *first = column(P, FIRST), *second = column(P, SECOND);
    insole_real_t u = second[FIRST];
    insole_real_t det = row_first.x_m * row_second.y_m - row_first.y_m * row_second.x_m;
    insole_sym2_t S =
        insole_sym2_map(row_first, row_second, insole_walker_cov_pair(P, INSOLE_WALKER_TURN));
    insole_real_t per = ONE / det, turned_u = S.yy > ZERO ? S.xy / S.yy : ZERO;
    for (int i = 0; i < FIRST; i++) {
        insole_real_t on_first = per * first[i], on_second = per * (second[i] - u * first[i]);
        first[i] = on_first * row_second.y_m - on_second * row_second.x_m;
        second[i] = on_second * row_first.x_m - on_first * row_first.y_m + first[i] * turned_u;
    }
    second[FIRST] = turned_u;
    /* as a quotient of determinants: a difference could come out negative */
    P->D[FIRST] = S.yy > ZERO ? det * det * P->D[FIRST] * (P->D[SECOND] / S.yy) : S.xx;
    P->D[SECOND] = S.yy;
}

/* U' h */
static insole_walker_column_t through(const insole_walker_cov_t *P, const insole_walker_column_t *h)
{
    insole_walker_column_t f = *h;
    for (int j = 1; j < N; j++) {
        const insole_real_t *u = column_of(P, j);
        for (int i = 0; i < j; i++) {
            f.at[j] += u[i] * h->at[i];
        }
    }
    return f;
}

insole_sym2_t insole_walker_cov_seen(const insole_walker_cov_t *P, const insole_walker_column_t *hx,
                                     const insole_walker_column_t *hy)
{
    insole_walker_column_t fx = through(P, hx), fy = through(P, hy);
    insole_sym2_t S = insole_sym2_circle(ZERO);
    for (int j = 0; j < N; j++) {
        S = insole_sym2_add_outer(S, P->D[j], insole_spot(fx.at[j], fy.at[j]));
    }
    return S;
}

insole_sym2_t insole_walker_cov_pair(const insole_walker_cov_t *P, int place)
{
    insole_real_t u = column_of(P, place + 1)[place];
    insole_sym2_t S = {P->D[place], ZERO, ZERO};
    S = insole_sym2_add_outer(S, P->D[place + 1], insole_spot(u, ONE));
    for (int j = place + 2; j < N; j++) {
        const insole_real_t *row = column_of(P, j) + place;
        S = insole_sym2_add_outer(S, P->D[j], insole_spot(row[0], row[1]));
    }
    return S;
}

/* From the first state on; S is the variance of the noise and of the states so far. */
insole_walker_column_t insole_walker_cov_correct(insole_walker_cov_t *P,
                                                 const insole_walker_column_t *h,
                                                 insole_real_t variance)
{
    insole_walker_column_t f = through(P, h), K;
    insole_real_t S = variance, per = ONE / S;
    for (int j = 0; j < N; j++) {
        insole_real_t *u = column(P, j), pull = P->D[j] * f.at[j], back = -f.at[j] * per;
        insole_real_t before = S;
        S += pull * f.at[j];
        per = ONE / S;
        P->D[j] *= before * per;
        for (int i = 0; i < j; i++) {
            insole_real_t ui = u[i];
            u[i] = ui + back * K.at[i];
            K.at[i] += pull * ui;
        }
        K.at[j] = pull;
    }
    for (int j = 0; j < N; j++) {
        K.at[j] *= per;
    }
    return K;
}
