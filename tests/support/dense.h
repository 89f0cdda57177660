/** @file dense.h  Plain twelve-state algebra in double, to hold the filter's blocks against.
 *
 *  Order of the states: p v a b, three each.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TESTS_DENSE_H
#define INSOLE_TESTS_DENSE_H

#include <math.h>
#include <string.h>

#include "insole/move/zupt_cov.h"
#include "sample.h"

enum { DENSE = 12, DENSE_P = 0, DENSE_V = 3, DENSE_A = 6, DENSE_B = 9 };

typedef struct {
    double at[DENSE][DENSE];
} dense_t;

typedef struct {
    double at[DENSE];
} column_t;

static inline dense_t dense_diagonal(double value)
{
    dense_t d;
    memset(&d, 0, sizeof d);
    for (int i = 0; i < DENSE; i++) {
        d.at[i][i] = value;
    }
    return d;
}

static inline dense_t dense_transpose(dense_t a)
{
    dense_t t;
    for (int i = 0; i < DENSE; i++) {
        for (int j = 0; j < DENSE; j++) {
            t.at[j][i] = a.at[i][j];
        }
    }
    return t;
}

static inline dense_t dense_mul(const dense_t *a, const dense_t *b)
{
    dense_t c = dense_diagonal(0.0);
    for (int i = 0; i < DENSE; i++) {
        for (int k = 0; k < DENSE; k++) {
            for (int j = 0; j < DENSE; j++) {
                c.at[i][j] += a->at[i][k] * b->at[k][j];
            }
        }
    }
    return c;
}

/** A S A' */
static inline dense_t dense_congruent(const dense_t *a, const dense_t *s)
{
    dense_t as = dense_mul(a, s), t = dense_transpose(*a);
    return dense_mul(&as, &t);
}

/** A + s B */
static inline dense_t dense_add(dense_t a, double s, const dense_t *b)
{
    for (int i = 0; i < DENSE; i++) {
        for (int j = 0; j < DENSE; j++) {
            a.at[i][j] += s * b->at[i][j];
        }
    }
    return a;
}

static inline column_t dense_apply(const dense_t *a, const column_t *x)
{
    column_t y;
    for (int i = 0; i < DENSE; i++) {
        y.at[i] = 0.0;
        for (int j = 0; j < DENSE; j++) {
            y.at[i] += a->at[i][j] * x->at[j];
        }
    }
    return y;
}

/** Inverse by Gauss and Jordan with pivots. */
static inline dense_t dense_inverse(dense_t a)
{
    dense_t x = dense_diagonal(1.0);
    for (int k = 0; k < DENSE; k++) {
        int pivot = k;
        for (int i = k + 1; i < DENSE; i++) {
            pivot = fabs(a.at[i][k]) > fabs(a.at[pivot][k]) ? i : pivot;
        }
        for (int j = 0; j < DENSE; j++) {
            double m = a.at[k][j], n = x.at[k][j];
            a.at[k][j] = a.at[pivot][j];
            a.at[pivot][j] = m;
            x.at[k][j] = x.at[pivot][j];
            x.at[pivot][j] = n;
        }
        double d = 1.0 / a.at[k][k];
        for (int j = 0; j < DENSE; j++) {
            a.at[k][j] *= d;
            x.at[k][j] *= d;
        }
        for (int i = 0; i < DENSE; i++) {
            double m = i == k ? 0.0 : a.at[i][k];
            for (int j = 0; j < DENSE; j++) {
                a.at[i][j] -= m * a.at[k][j];
                x.at[i][j] -= m * x.at[k][j];
            }
        }
    }
    return x;
}

/** x' S^-1 x of the leading n states from `first` on, by Cholesky; not-a-number when the block is
 *  not positive. */
static inline double dense_mahalanobis(const dense_t *s, const column_t *x, int first, int n)
{
    double L[DENSE][DENSE], y[DENSE], sum = 0.0;
    for (int i = 0; i < n; i++) {
        for (int j = 0; j <= i; j++) {
            double v = s->at[first + i][first + j];
            for (int k = 0; k < j; k++) {
                v -= L[i][k] * L[j][k];
            }
            L[i][j] = i == j ? sqrt(v) : v / L[j][j];
        }
        y[i] = x->at[first + i];
        for (int k = 0; k < i; k++) {
            y[i] -= L[i][k] * y[k];
        }
        y[i] /= L[i][i];
        sum += y[i] * y[i];
    }
    return sum;
}

/** Scaled to a unit diagonal over the leading n states; zeros where a variance is not positive. */
static inline dense_t dense_correlation(const dense_t *s, int n)
{
    dense_t c = dense_diagonal(0.0);
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < n; j++) {
            double scale = s->at[i][i] * s->at[j][j];
            c.at[i][j] = s->at[i][i] > 0.0 && scale > 0.0 ? s->at[i][j] / sqrt(scale) : 0.0;
        }
    }
    return c;
}

/** Turns by Jacobi in the plane of p and q: a_pq becomes zero. */
static inline void dense_jacobi_turn(dense_t *a, int n, int p, int q)
{
    double theta = 0.5 * atan2(2.0 * a->at[p][q], a->at[q][q] - a->at[p][p]);
    double c = cos(theta), s = sin(theta);
    for (int k = 0; k < n; k++) {
        double x = a->at[k][p], y = a->at[k][q];
        a->at[k][p] = c * x - s * y;
        a->at[k][q] = s * x + c * y;
    }
    for (int k = 0; k < n; k++) {
        double x = a->at[p][k], y = a->at[q][k];
        a->at[p][k] = c * x - s * y;
        a->at[q][k] = s * x + c * y;
    }
}

/** Smallest eigenvalue of the leading n states of a symmetric matrix. */
static inline double dense_least_eigenvalue(dense_t a, int n)
{
    for (int sweep = 0; sweep < 12; sweep++) {
        for (int p = 0; p < n; p++) {
            for (int q = p + 1; q < n; q++) {
                dense_jacobi_turn(&a, n, p, q);
            }
        }
    }
    double least = a.at[0][0];
    for (int i = 1; i < n; i++) {
        least = fmin(least, a.at[i][i]);
    }
    return least;
}

/* ---- to and from the blocks ------------------------------------------------------------- */

static inline void dense_put(dense_t *d, int row, int column, insole_mat3_t m)
{
    const insole_vec3_t *rows[3] = {&m.r0, &m.r1, &m.r2};
    for (int i = 0; i < 3; i++) {
        double v[3] = {(double)rows[i]->x, (double)rows[i]->y, (double)rows[i]->z};
        for (int j = 0; j < 3; j++) {
            d->at[row + i][column + j] = v[j];
        }
    }
}

static inline void dense_put_both(dense_t *d, int row, int column, insole_mat3_t m)
{
    dense_put(d, row, column, m);
    dense_put(d, column, row, insole_mat3_transpose(m));
}

static inline dense_t dense_of(const insole_zupt_cov_t *P)
{
    dense_t d;
    dense_put(&d, DENSE_P, DENSE_P, insole_sym3_full(P->pp));
    dense_put(&d, DENSE_V, DENSE_V, insole_sym3_full(P->vv));
    dense_put(&d, DENSE_A, DENSE_A, insole_sym3_full(P->aa));
    dense_put(&d, DENSE_B, DENSE_B, insole_sym3_full(P->bb));
    dense_put_both(&d, DENSE_P, DENSE_V, P->pv);
    dense_put_both(&d, DENSE_P, DENSE_A, P->pa);
    dense_put_both(&d, DENSE_V, DENSE_A, P->va);
    dense_put_both(&d, DENSE_P, DENSE_B, P->pb);
    dense_put_both(&d, DENSE_V, DENSE_B, P->vb);
    dense_put_both(&d, DENSE_A, DENSE_B, P->ab);
    return d;
}

static inline insole_mat3_t dense_block(const dense_t *d, int row, int column)
{
    insole_vec3_t r[3];
    for (int i = 0; i < 3; i++) {
        const double *from = &d->at[row + i][column];
        r[i] = insole_vec3((insole_real_t)from[0], (insole_real_t)from[1], (insole_real_t)from[2]);
    }
    return insole_mat3_rows(r[0], r[1], r[2]);
}

static inline insole_zupt_cov_t dense_to_cov(const dense_t *d)
{
    insole_zupt_cov_t P;
    P.pp = insole_mat3_symmetric(dense_block(d, DENSE_P, DENSE_P));
    P.vv = insole_mat3_symmetric(dense_block(d, DENSE_V, DENSE_V));
    P.aa = insole_mat3_symmetric(dense_block(d, DENSE_A, DENSE_A));
    P.bb = insole_mat3_symmetric(dense_block(d, DENSE_B, DENSE_B));
    P.pv = dense_block(d, DENSE_P, DENSE_V);
    P.pa = dense_block(d, DENSE_P, DENSE_A);
    P.va = dense_block(d, DENSE_V, DENSE_A);
    P.pb = dense_block(d, DENSE_P, DENSE_B);
    P.vb = dense_block(d, DENSE_V, DENSE_B);
    P.ab = dense_block(d, DENSE_A, DENSE_B);
    return P;
}

static inline void column_put(column_t *x, int row, insole_vec3_t v)
{
    x->at[row] = (double)v.x;
    x->at[row + 1] = (double)v.y;
    x->at[row + 2] = (double)v.z;
}

static inline insole_vec3_t column_part(const column_t *x, int row)
{
    return insole_vec3((insole_real_t)x->at[row], (insole_real_t)x->at[row + 1],
                       (insole_real_t)x->at[row + 2]);
}

static inline column_t column_of(const insole_zupt_error_t *e)
{
    column_t x;
    column_put(&x, DENSE_P, e->p);
    column_put(&x, DENSE_V, e->v);
    column_put(&x, DENSE_A, e->a);
    column_put(&x, DENSE_B, e->b);
    return x;
}

/** Phi by its definition: v' = v - u x a - C b dt, p' = p + dt (v + v') / 2. */
static inline dense_t dense_phi(insole_vec3_t u, insole_mat3_t C, insole_real_t dt_s)
{
    double x = (double)u.x, y = (double)u.y, z = (double)u.z;
    double cross[3][3] = {{0.0, -z, y}, {z, 0.0, -x}, {-y, x, 0.0}};
    dense_t d = dense_diagonal(0.0), phi = dense_diagonal(1.0);
    dense_put(&d, 0, 0, C);
    for (int i = 0; i < 3; i++) {
        phi.at[DENSE_P + i][DENSE_V + i] = (double)dt_s;
        for (int j = 0; j < 3; j++) {
            phi.at[DENSE_V + i][DENSE_A + j] = -cross[i][j];
            phi.at[DENSE_V + i][DENSE_B + j] = -d.at[i][j] * (double)dt_s;
            for (int k = DENSE_A; k <= DENSE_B; k += DENSE_B - DENSE_A) {
                phi.at[DENSE_P + i][k + j] = 0.5 * (double)dt_s * phi.at[DENSE_V + i][k + j];
            }
        }
    }
    return phi;
}

/** The correction of states first..first+n-1, each measured with variance r, in Joseph's form.
 *  @param[out] gain  K, its n columns */
static inline dense_t dense_joseph(const dense_t *P, int first, int n, double r, dense_t *gain)
{
    dense_t S = dense_diagonal(1.0), PH = dense_diagonal(0.0), R = dense_diagonal(r);
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < n; j++) {
            S.at[i][j] = P->at[first + i][first + j] + (i == j ? r : 0.0);
        }
        for (int j = 0; j < DENSE; j++) {
            PH.at[j][i] = P->at[j][first + i];
        }
    }
    dense_t W = dense_inverse(S), IKH = dense_diagonal(1.0);
    *gain = dense_mul(&PH, &W);
    for (int i = 0; i < DENSE; i++) {
        for (int j = 0; j < n; j++) {
            IKH.at[i][first + j] -= gain->at[i][j];
        }
    }
    dense_t noise = dense_congruent(gain, &R);
    return dense_add(dense_congruent(&IKH, P), 1.0, &noise);
}

/** A random covariance whose states have the sizes that they have on a foot. */
static inline dense_t dense_sample_cov(insole_rng_t *rng)
{
    static const double size[4] = {0.3, 0.1, 0.02, 0.05};
    dense_t root;
    for (int i = 0; i < DENSE; i++) {
        for (int j = 0; j < DENSE; j++) {
            root.at[i][j] = size[i / 3] * (double)insole_rng_normal(rng) / 3.0;
        }
    }
    dense_t one = dense_diagonal(1.0);
    return dense_congruent(&root, &one);
}

/** Largest difference of two covariances, each entry in units of sqrt(s_ii s_jj) of `scale`. */
static inline double dense_off(const dense_t *a, const dense_t *b, const dense_t *scale)
{
    double worst = 0.0;
    for (int i = 0; i < DENSE; i++) {
        for (int j = 0; j < DENSE; j++) {
            double unit = sqrt(scale->at[i][i] * scale->at[j][j]);
            double off = fabs(a->at[i][j] - b->at[i][j]);
            worst = unit > 0.0 ? fmax(worst, off / unit) : off > 0.0 ? HUGE_VAL : worst;
        }
    }
    return worst;
}

#endif
