/* SPDX-License-Identifier: MIT */
#include "insole/base/unscented.h"

#define ZERO INSOLE_R(0.0)

/* A pivot this small a share of its diagonal is rounding. */
static const insole_real_t NO_PIVOT = INSOLE_R(4.0) * INSOLE_REAL_EPSILON;

/* Row r times row c of the root, up to column `end`. */
static insole_real_t row_product(const insole_real_t *root, uint32_t n, uint32_t r, uint32_t c,
                                 uint32_t end)
{
    insole_real_t sum = ZERO;
    for (uint32_t k = 0u; k < end; k++) {
        sum += root[r * n + k] * root[c * n + k];
    }
    return sum;
}

bool insole_cholesky(uint32_t n, const insole_real_t *A, insole_real_t *root)
{
    bool positive = true;
    for (uint32_t c = 0u; c < n; c++) {
        insole_real_t pivot = A[c * n + c] - row_product(root, n, c, c, c);
        bool counts = pivot > NO_PIVOT * A[c * n + c];
        insole_real_t diagonal = counts ? insole_sqrt(pivot) : ZERO;
        insole_real_t per = counts ? INSOLE_R(1.0) / diagonal : ZERO;
        positive = positive && counts;
        for (uint32_t r = 0u; r < c; r++) {
            root[r * n + c] = ZERO;
        }
        root[c * n + c] = diagonal;
        for (uint32_t r = c + 1u; r < n; r++) {
            root[r * n + c] = (A[r * n + c] - row_product(root, n, r, c, c)) * per;
        }
    }
    return positive;
}

void insole_unscented_points(const insole_unscented_t *ut, const insole_real_t *mean,
                             const insole_real_t *root, insole_real_t *points)
{
    uint32_t n = ut->n;
    for (uint32_t k = 0u; k < n; k++) {
        points[k] = mean[k];
        for (uint32_t i = 0u; i < n; i++) {
            insole_real_t step = ut->spread * root[k * n + i];
            points[(1u + i) * n + k] = mean[k] + step; /* [PhoneUKF (14)] */
            points[(1u + n + i) * n + k] = mean[k] - step;
        }
    }
}

void insole_unscented_mean(const insole_unscented_t *ut, uint32_t m, const insole_real_t *values,
                           insole_real_t *mean)
{
    for (uint32_t k = 0u; k < m; k++) {
        insole_real_t sum = ZERO;
        for (uint32_t i = 1u; i <= 2u * ut->n; i++) {
            sum += values[i * m + k];
        }
        mean[k] = ut->mean0 * values[k] + ut->weight * sum; /* [PhoneUKF (16)] */
    }
}

void insole_unscented_cov(const insole_unscented_t *ut, uint32_t ma, const insole_real_t *a,
                          const insole_real_t *mean_a, uint32_t mb, const insole_real_t *b,
                          const insole_real_t *mean_b, insole_real_t *cov)
{
    for (uint32_t r = 0u; r < ma; r++) {
        for (uint32_t c = 0u; c < mb; c++) {
            insole_real_t middle = (a[r] - mean_a[r]) * (b[c] - mean_b[c]), sum = ZERO;
            for (uint32_t i = 1u; i <= 2u * ut->n; i++) {
                sum += (a[i * ma + r] - mean_a[r]) * (b[i * mb + c] - mean_b[c]);
            }
            cov[r * mb + c] = ut->cov0 * middle + ut->weight * sum; /* [PhoneUKF (16)-(17)] */
        }
    }
}
