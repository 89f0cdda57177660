/** @file mat.h  3x3 matrices by value: the blocks that the filters are written in.
 *
 *  `insole_mat3_t` is a full block, row by row; `insole_sym3_t` a symmetric one, upper triangle.
 *  A product with a skew matrix [v]x never builds the matrix and never multiplies its zeros.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_BASE_MAT_H
#define INSOLE_BASE_MAT_H

#include "insole/base/vec3.h"

/** Full 3x3 block: three rows. */
typedef struct {
    insole_vec3_t r0, r1, r2;
} insole_mat3_t;

/** Symmetric 3x3 block. */
typedef struct {
    insole_real_t xx, xy, xz, yy, yz, zz;
} insole_sym3_t;

static inline insole_mat3_t insole_mat3_rows(insole_vec3_t r0, insole_vec3_t r1, insole_vec3_t r2)
{
    insole_mat3_t m = {r0, r1, r2};
    return m;
}

static inline insole_mat3_t insole_mat3_zero(void)
{
    return insole_mat3_rows(insole_vec3_zero(), insole_vec3_zero(), insole_vec3_zero());
}

static inline insole_mat3_t insole_mat3_transpose(insole_mat3_t a)
{
    return insole_mat3_rows(insole_vec3(a.r0.x, a.r1.x, a.r2.x),
                            insole_vec3(a.r0.y, a.r1.y, a.r2.y),
                            insole_vec3(a.r0.z, a.r1.z, a.r2.z));
}

static inline insole_mat3_t insole_mat3_add(insole_mat3_t a, insole_mat3_t b)
{
    return insole_mat3_rows(insole_vec3_add(a.r0, b.r0), insole_vec3_add(a.r1, b.r1),
                            insole_vec3_add(a.r2, b.r2));
}

static inline insole_mat3_t insole_mat3_sub(insole_mat3_t a, insole_mat3_t b)
{
    return insole_mat3_rows(insole_vec3_sub(a.r0, b.r0), insole_vec3_sub(a.r1, b.r1),
                            insole_vec3_sub(a.r2, b.r2));
}

/** A + s B */
static inline insole_mat3_t insole_mat3_add_scaled(insole_mat3_t a, insole_real_t s,
                                                   insole_mat3_t b)
{
    return insole_mat3_rows(insole_vec3_add_scaled(a.r0, s, b.r0),
                            insole_vec3_add_scaled(a.r1, s, b.r1),
                            insole_vec3_add_scaled(a.r2, s, b.r2));
}

static inline insole_mat3_t insole_mat3_scale(insole_mat3_t a, insole_real_t s)
{
    return insole_mat3_rows(insole_vec3_scale(a.r0, s), insole_vec3_scale(a.r1, s),
                            insole_vec3_scale(a.r2, s));
}

/** A + s v w' */
static inline insole_mat3_t insole_mat3_add_outer(insole_mat3_t a, insole_real_t s, insole_vec3_t v,
                                                  insole_vec3_t w)
{
    return insole_mat3_rows(insole_vec3_add_scaled(a.r0, s * v.x, w),
                            insole_vec3_add_scaled(a.r1, s * v.y, w),
                            insole_vec3_add_scaled(a.r2, s * v.z, w));
}

/** A v */
static inline insole_vec3_t insole_mat3_mul_vec(insole_mat3_t a, insole_vec3_t v)
{
    return insole_vec3(insole_vec3_dot(a.r0, v), insole_vec3_dot(a.r1, v),
                       insole_vec3_dot(a.r2, v));
}

/** A' v */
static inline insole_vec3_t insole_mat3_mul_vec_t(insole_mat3_t a, insole_vec3_t v)
{
    return insole_vec3_add_scaled(insole_vec3_add_scaled(insole_vec3_scale(a.r0, v.x), v.y, a.r1),
                                  v.z, a.r2);
}

/** A B */
static inline insole_mat3_t insole_mat3_mul(insole_mat3_t a, insole_mat3_t b)
{
    return insole_mat3_rows(insole_mat3_mul_vec_t(b, a.r0), insole_mat3_mul_vec_t(b, a.r1),
                            insole_mat3_mul_vec_t(b, a.r2));
}

/** A B' */
static inline insole_mat3_t insole_mat3_mul_t(insole_mat3_t a, insole_mat3_t b)
{
    return insole_mat3_rows(insole_mat3_mul_vec(b, a.r0), insole_mat3_mul_vec(b, a.r1),
                            insole_mat3_mul_vec(b, a.r2));
}

/** A [v]x : each row r becomes r x v. */
static inline insole_mat3_t insole_mat3_mul_skew(insole_mat3_t a, insole_vec3_t v)
{
    return insole_mat3_rows(insole_vec3_cross(a.r0, v), insole_vec3_cross(a.r1, v),
                            insole_vec3_cross(a.r2, v));
}

/** [v]x A */
static inline insole_mat3_t insole_mat3_skew_mul(insole_vec3_t v, insole_mat3_t a)
{
    return insole_mat3_rows(
        insole_vec3_sub(insole_vec3_scale(a.r2, v.y), insole_vec3_scale(a.r1, v.z)),
        insole_vec3_sub(insole_vec3_scale(a.r0, v.z), insole_vec3_scale(a.r2, v.x)),
        insole_vec3_sub(insole_vec3_scale(a.r1, v.x), insole_vec3_scale(a.r0, v.y)));
}

static inline insole_sym3_t insole_sym3_diagonal(insole_real_t x, insole_real_t y, insole_real_t z)
{
    insole_sym3_t s = {x, INSOLE_R(0.0), INSOLE_R(0.0), y, INSOLE_R(0.0), z};
    return s;
}

static inline insole_sym3_t insole_sym3_zero(void)
{
    return insole_sym3_diagonal(INSOLE_R(0.0), INSOLE_R(0.0), INSOLE_R(0.0));
}

static inline insole_sym3_t insole_sym3_add(insole_sym3_t a, insole_sym3_t b)
{
    insole_sym3_t s = {a.xx + b.xx, a.xy + b.xy, a.xz + b.xz,
                       a.yy + b.yy, a.yz + b.yz, a.zz + b.zz};
    return s;
}

/** A + s B */
static inline insole_sym3_t insole_sym3_add_scaled(insole_sym3_t a, insole_real_t s,
                                                   insole_sym3_t b)
{
    insole_sym3_t c = {a.xx + s * b.xx, a.xy + s * b.xy, a.xz + s * b.xz,
                       a.yy + s * b.yy, a.yz + s * b.yz, a.zz + s * b.zz};
    return c;
}

/** s A */
static inline insole_sym3_t insole_sym3_scale(insole_sym3_t a, insole_real_t s)
{
    insole_sym3_t c = {a.xx * s, a.xy * s, a.xz * s, a.yy * s, a.yz * s, a.zz * s};
    return c;
}

/** A + s I */
static inline insole_sym3_t insole_sym3_add_diagonal(insole_sym3_t a, insole_real_t s)
{
    insole_sym3_t c = {a.xx + s, a.xy, a.xz, a.yy + s, a.yz, a.zz + s};
    return c;
}

/** A + s v v' */
static inline insole_sym3_t insole_sym3_add_outer(insole_sym3_t a, insole_real_t s, insole_vec3_t v)
{
    insole_vec3_t w = insole_vec3_scale(v, s);
    insole_sym3_t c = {a.xx + w.x * v.x, a.xy + w.x * v.y, a.xz + w.x * v.z,
                       a.yy + w.y * v.y, a.yz + w.y * v.z, a.zz + w.z * v.z};
    return c;
}

/** A + s (M + M') */
static inline insole_sym3_t insole_sym3_add_twice(insole_sym3_t a, insole_real_t s, insole_mat3_t m)
{
    insole_real_t d = s + s;
    insole_sym3_t c = {
        a.xx + d * m.r0.x, a.xy + s * (m.r0.y + m.r1.x), a.xz + s * (m.r0.z + m.r2.x),
        a.yy + d * m.r1.y, a.yz + s * (m.r1.z + m.r2.y), a.zz + d * m.r2.z};
    return c;
}

static inline insole_mat3_t insole_sym3_full(insole_sym3_t a)
{
    return insole_mat3_rows(insole_vec3(a.xx, a.xy, a.xz), insole_vec3(a.xy, a.yy, a.yz),
                            insole_vec3(a.xz, a.yz, a.zz));
}

/** The symmetric part of a block that is symmetric but for rounding. */
static inline insole_sym3_t insole_mat3_symmetric(insole_mat3_t m)
{
    return insole_sym3_add_twice(insole_sym3_zero(), INSOLE_R(0.5), m);
}

static inline insole_vec3_t insole_sym3_mul_vec(insole_sym3_t a, insole_vec3_t v)
{
    return insole_vec3(a.xx * v.x + a.xy * v.y + a.xz * v.z, a.xy * v.x + a.yy * v.y + a.yz * v.z,
                       a.xz * v.x + a.yz * v.y + a.zz * v.z);
}

/** M S with S symmetric. */
static inline insole_mat3_t insole_mat3_mul_sym(insole_mat3_t m, insole_sym3_t s)
{
    return insole_mat3_rows(insole_sym3_mul_vec(s, m.r0), insole_sym3_mul_vec(s, m.r1),
                            insole_sym3_mul_vec(s, m.r2));
}

/** The symmetric product A B' of two blocks whose product is known to be symmetric. */
static inline insole_sym3_t insole_mat3_mul_t_sym(insole_mat3_t a, insole_mat3_t b)
{
    insole_sym3_t s = {insole_vec3_dot(a.r0, b.r0), insole_vec3_dot(a.r0, b.r1),
                       insole_vec3_dot(a.r0, b.r2), insole_vec3_dot(a.r1, b.r1),
                       insole_vec3_dot(a.r1, b.r2), insole_vec3_dot(a.r2, b.r2)};
    return s;
}

/** Inverse of a positive definite symmetric block, by pivots: nothing of third order that could
 *  leave the range of a float, and the inverse is as definite as the block.
 *  @return false, and `inverse` untouched, when the block is not positive definite or its inverse
 *          is not finite */
static inline bool insole_sym3_inverse(insole_sym3_t a, insole_sym3_t *inverse)
{
    /* A = L D L' with unit lower L, then M = L^-1 and A^-1 = M' D^-1 M */
    insole_real_t ix = INSOLE_R(1.0) / a.xx;
    insole_real_t l_yx = a.xy * ix, l_zx = a.xz * ix;
    insole_real_t d_y = a.yy - l_yx * a.xy, c_zy = a.yz - l_zx * a.xy;
    insole_real_t iy = INSOLE_R(1.0) / d_y;
    insole_real_t l_zy = c_zy * iy;
    insole_real_t d_z = a.zz - l_zx * a.xz - l_zy * c_zy;
    insole_real_t iz = INSOLE_R(1.0) / d_z;
    insole_real_t m_zx = l_yx * l_zy - l_zx;
    insole_sym3_t s = {ix + l_yx * l_yx * iy + m_zx * m_zx * iz,
                       -l_yx * iy - m_zx * l_zy * iz,
                       m_zx * iz,
                       iy + l_zy * l_zy * iz,
                       -l_zy * iz,
                       iz};
    bool definite = a.xx > INSOLE_R(0.0) && d_y > INSOLE_R(0.0) && d_z > INSOLE_R(0.0);
    if (!definite || !insole_is_finite(s.xx + s.yy + s.zz)) {
        return false;
    }
    *inverse = s;
    return true;
}

#endif
