/* SPDX-License-Identifier: MIT */
#include "insole/base/quat.h"

#include "near.h"
#include "sample.h"
#include "suite.h"

static const double EPS = (double)INSOLE_REAL_EPSILON;
static const double PI = 3.14159265358979323846;
enum { TRIES = 500 };

static insole_rng_t seeded(void)
{
    insole_rng_t rng;
    insole_rng_seed(&rng, 1u);
    return rng;
}

static insole_vec3_t axis(int i)
{
    return insole_vec3((insole_real_t)(i == 0), (insole_real_t)(i == 1), (insole_real_t)(i == 2));
}

static void assert_vec3(insole_vec3_t v, insole_vec3_t expected, double tolerance)
{
    ASSERT_NEAR(v.x, expected.x, tolerance, "in x");
    ASSERT_NEAR(v.y, expected.y, tolerance, "in y");
    ASSERT_NEAR(v.z, expected.z, tolerance, "in z");
}

static void assert_quat(insole_quat_t q, double w, double x, double y, double z, double tolerance)
{
    ASSERT_NEAR(q.w, w, tolerance, "in w");
    ASSERT_NEAR(q.x, x, tolerance, "in x");
    ASSERT_NEAR(q.y, y, tolerance, "in y");
    ASSERT_NEAR(q.z, z, tolerance, "in z");
}

static double norm_of(insole_quat_t q)
{
    double w = (double)q.w, x = (double)q.x, y = (double)q.y, z = (double)q.z;
    return sqrt(w * w + x * x + y * y + z * z);
}

/* Turning v by `angle` about the unit vector k, by Rodrigues, in double. */
static insole_vec3_t turned(insole_vec3_t v, insole_vec3_t k, double angle)
{
    double c = cos(angle), s = sin(angle);
    double along = (1.0 - c) * ((double)k.x * (double)v.x + (double)k.y * (double)v.y +
                                (double)k.z * (double)v.z);
    insole_vec3_t w = insole_vec3_cross(k, v);
    return insole_vec3((insole_real_t)(c * (double)v.x + s * (double)w.x + along * (double)k.x),
                       (insole_real_t)(c * (double)v.y + s * (double)w.y + along * (double)k.y),
                       (insole_real_t)(c * (double)v.z + s * (double)w.z + along * (double)k.z));
}

START_TEST(hamilton_i_j_is_k)
{
    const insole_real_t o = INSOLE_R(0.0), one = INSOLE_R(1.0);
    insole_quat_t i = insole_quat(o, one, o, o), j = insole_quat(o, o, one, o);
    insole_quat_t k = insole_quat(o, o, o, one);
    assert_quat(insole_quat_mul(i, j), 0.0, 0.0, 0.0, 1.0, 0.0);
    assert_quat(insole_quat_mul(j, k), 0.0, 1.0, 0.0, 0.0, 0.0);
    assert_quat(insole_quat_mul(k, i), 0.0, 0.0, 1.0, 0.0, 0.0);
    assert_quat(insole_quat_mul(j, i), 0.0, 0.0, 0.0, -1.0, 0.0);
    assert_quat(insole_quat_mul(i, i), -1.0, 0.0, 0.0, 0.0, 0.0);
    assert_quat(insole_quat_mul(insole_quat_identity(), j), 0.0, 0.0, 1.0, 0.0, 0.0);
}
END_TEST

START_TEST(conjugate_turns_back)
{
    insole_rng_t rng = seeded();
    for (int n = 0; n < TRIES; n++) {
        insole_quat_t q = sample_quat(&rng);
        insole_quat_t none = insole_quat_mul(q, insole_quat_conjugate(q));
        assert_quat(none, 1.0, 0.0, 0.0, 0.0, 8.0 * EPS);
    }
}
END_TEST

/* q v q*, the definition of a rotation by a quaternion. */
START_TEST(rotation_agrees_with_its_definition)
{
    insole_rng_t rng = seeded();
    for (int n = 0; n < TRIES; n++) {
        insole_quat_t q = sample_quat(&rng);
        insole_vec3_t v = sample_vec3(&rng, INSOLE_R(10.0));
        insole_quat_t pure = insole_quat(INSOLE_R(0.0), v.x, v.y, v.z);
        insole_quat_t qv = insole_quat_mul(insole_quat_mul(q, pure), insole_quat_conjugate(q));
        insole_vec3_t expected = insole_vec3(qv.x, qv.y, qv.z);
        assert_vec3(insole_quat_rotate(q, v), expected, 100.0 * EPS);
        assert_vec3(insole_mat3_mul_vec(insole_quat_to_mat3(q), v), expected, 100.0 * EPS);
        assert_vec3(insole_quat_rotate_back(q, insole_quat_rotate(q, v)), v, 100.0 * EPS);
    }
}
END_TEST

/* Orthonormal rows that are right-handed. */
START_TEST(rotation_matrices_are_rotations)
{
    insole_rng_t rng = seeded();
    for (int n = 0; n < TRIES; n++) {
        insole_mat3_t C = insole_quat_to_mat3(sample_quat(&rng));
        insole_mat3_t unit = insole_mat3_mul_t(C, C);
        assert_vec3(unit.r0, axis(0), 10.0 * EPS);
        assert_vec3(unit.r1, axis(1), 10.0 * EPS);
        assert_vec3(unit.r2, axis(2), 10.0 * EPS);
        assert_vec3(insole_vec3_cross(C.r0, C.r1), C.r2, 10.0 * EPS);
    }
}
END_TEST

START_TEST(a_product_turns_by_the_right_factor_first)
{
    insole_rng_t rng = seeded();
    for (int n = 0; n < TRIES; n++) {
        insole_quat_t a = sample_quat(&rng), b = sample_quat(&rng);
        insole_vec3_t v = sample_vec3(&rng, INSOLE_R(1.0));
        insole_vec3_t one_by_one = insole_quat_rotate(a, insole_quat_rotate(b, v));
        assert_vec3(insole_quat_rotate(insole_quat_mul(a, b), v), one_by_one, 20.0 * EPS);
    }
}
END_TEST

START_TEST(normalising_keeps_the_direction)
{
    static const float SCALES[] = {1e-15f, 1e-3f, 0.999f, 1.0f, 1.001f, 1e3f, 1e15f};
    const insole_real_t scale = (insole_real_t)SCALES[_i];
    insole_rng_t rng = seeded();
    for (int n = 0; n < TRIES; n++) {
        insole_quat_t q = sample_quat(&rng);
        insole_quat_t unit =
            insole_quat_normalize(insole_quat(q.w * scale, q.x * scale, q.y * scale, q.z * scale));
        ASSERT_NEAR(norm_of(unit), 1.0, 3.0 * EPS, "");
        assert_quat(unit, (double)q.w, (double)q.x, (double)q.y, (double)q.z, 6.0 * EPS);
    }
}
END_TEST

/* One after the other, by matrices: both may be of any length. */
START_TEST(a_chain_turns_as_both_do)
{
    insole_rng_t rng = seeded();
    for (int n = 0; n < TRIES; n++) {
        insole_quat_t a = sample_quat(&rng), b = sample_quat(&rng);
        insole_quat_t longer = insole_quat(INSOLE_R(3.0) * b.w, INSOLE_R(3.0) * b.x,
                                           INSOLE_R(3.0) * b.y, INSOLE_R(3.0) * b.z);
        insole_quat_t chain = insole_quat_chain(a, longer);
        insole_vec3_t v = insole_vec3(INSOLE_R(0.3), INSOLE_R(-0.5), INSOLE_R(0.8));
        insole_vec3_t turned = insole_mat3_mul_vec(insole_quat_to_mat3(a),
                                                   insole_mat3_mul_vec(insole_quat_to_mat3(b), v));
        ASSERT_NEAR(norm_of(chain), 1.0, 3.0 * EPS, "");
        ASSERT_NEAR(insole_vec3_norm(insole_vec3_sub(insole_quat_rotate(chain, v), turned)), 0.0,
                    12.0 * EPS, "");
    }
}
END_TEST

START_TEST(what_has_no_direction_becomes_the_identity)
{
    const insole_real_t bad[] = {INSOLE_R(0.0), (insole_real_t)NAN, (insole_real_t)INFINITY,
                                 INSOLE_REAL_MAX};
    insole_quat_t q = insole_quat(INSOLE_R(0.0), bad[_i], INSOLE_R(0.0), INSOLE_R(0.0));
    assert_quat(insole_quat_normalize(q), 1.0, 0.0, 0.0, 0.0, 0.0);
}
END_TEST

/* Angles on both sides of 0.2 rad, where the series ends, and some turns. */
static const double ANGLES_RAD[] = {0.0, 1e-30,  1e-12,     1e-6, 1e-3, 0.02, 0.1999,
                                    0.2, 0.2001, 0.5,       1.0,  2.0,  3.0,  3.14159265,
                                    4.0, 6.0,    6.2831853, 10.0, 100.0};
enum { ANGLE_COUNT = sizeof ANGLES_RAD / sizeof ANGLES_RAD[0] };

START_TEST(rotation_vectors_turn_as_rodrigues_says)
{
    insole_rng_t rng = seeded();
    for (int n = 0; n < 50; n++) {
        insole_vec3_t k = sample_vec3(&rng, INSOLE_R(1.0)), v = sample_vec3(&rng, INSOLE_R(1.0));
        k = insole_vec3_scale(k, INSOLE_R(1.0) / insole_vec3_norm(k));
        insole_vec3_t r = insole_vec3_scale(k, (insole_real_t)ANGLES_RAD[_i]);
        double x = (double)r.x, y = (double)r.y, z = (double)r.z;
        double angle = sqrt(x * x + y * y + z * z);
        insole_quat_t q = insole_quat_from_rotvec(r);
        double tolerance = (10.0 + 3.0 * angle) * EPS;
        ASSERT_NEAR(norm_of(q), 1.0, tolerance, "");
        assert_vec3(insole_quat_rotate(q, v), turned(v, k, angle), tolerance);
        assert_quat(q, cos(angle / 2.0), sin(angle / 2.0) * (double)k.x,
                    sin(angle / 2.0) * (double)k.y, sin(angle / 2.0) * (double)k.z, tolerance);
    }
}
END_TEST

/* A small angle must not be rounded away: half of it, to full precision. */
START_TEST(small_rotation_vectors_keep_their_digits)
{
    static const float SIZES[] = {1e-30f, 1e-12f, 1e-6f, 1e-3f};
    insole_real_t size = (insole_real_t)SIZES[_i];
    insole_quat_t q = insole_quat_from_rotvec(insole_vec3(INSOLE_R(0.0), -size, size));
    double half = 0.5 * (double)size;
    ASSERT_NEAR(q.y, -half, half * (2.0 * EPS + 0.5 * half * half), "");
    ASSERT_NEAR(q.z, half, half * (2.0 * EPS + 0.5 * half * half), "");
}
END_TEST

START_TEST(absurd_rotation_vectors_give_finite_unit_quaternions)
{
    const insole_real_t sizes[] = {INSOLE_R(1e5), INSOLE_R(1e15), INSOLE_R(1e25), INSOLE_REAL_MAX};
    insole_quat_t q = insole_quat_from_rotvec(insole_vec3(sizes[_i], -sizes[_i], sizes[_i]));
    ASSERT_NEAR(norm_of(q), 1.0, 10.0 * EPS, "");
}
END_TEST

/* Which specific force a resting sensor feels, tilted by pitch about y after roll about x. */
static insole_vec3_t resting_force(double roll, double pitch)
{
    const double g = 9.81;
    return insole_vec3((insole_real_t)(-g * sin(pitch)),
                       (insole_real_t)(g * cos(pitch) * sin(roll)),
                       (insole_real_t)(g * cos(pitch) * cos(roll)));
}

/* Any mounting: roll all round, pitch to the vertical. Rotating the axes by Rx then Ry. */
START_TEST(gravity_gives_roll_and_pitch)
{
    for (int roll_deg = -180; roll_deg <= 180; roll_deg += 15) {
        for (int pitch_deg = -85; pitch_deg <= 85; pitch_deg += 5) {
            double roll = roll_deg * PI / 180.0, pitch = pitch_deg * PI / 180.0;
            insole_quat_t q = insole_quat_from_gravity(resting_force(roll, pitch));
            for (int i = 0; i < 3; i++) {
                insole_vec3_t rolled = turned(axis(i), axis(0), roll);
                assert_vec3(insole_quat_rotate(q, axis(i)), turned(rolled, axis(1), pitch),
                            16.0 * EPS);
            }
        }
    }
}
END_TEST

/* Without a sine: the error of the small rotation, doubled as often as the angle is halved. */
START_TEST(half_a_rotation_vector_gives_the_rotation)
{
    insole_rng_t rng = seeded();
    worst_t off = {0.0, 0.0};
    for (int n = 0; n < TRIES; n++) {
        double size = pow(10.0, -4.0 + 6.8 * (n + 0.5) / TRIES); /* to 630 rad */
        insole_vec3_t half =
            insole_vec3_scale(sample_vec3(&rng, INSOLE_R(1.0)), (insole_real_t)size);
        double x = (double)half.x, y = (double)half.y, z = (double)half.z;
        double angle = sqrt(x * x + y * y + z * z), s = sin(angle) / angle;
        insole_quat_t q = insole_quat_from_half(half);
        double d[4] = {(double)q.w - cos(angle), (double)q.x - s * x, (double)q.y - s * y,
                       (double)q.z - s * z};
        double error = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2] + d[3] * d[3]);
        ASSERT_NEAR(norm_of(q), 1.0, 3.0 * EPS, "");
        worst_note(&off, error / (2.0 + 20.0 * angle), n);
    }
    ASSERT_WORST(off, EPS, "");
}
END_TEST

START_TEST(half_a_rotation_vector_without_end_gives_no_nonsense)
{
    static const double SIZES[4] = {1.0e4, 1.0e10, 1.0e30, (double)INFINITY};
    insole_quat_t q = insole_quat_from_half(insole_vec3_scale(axis(2), (insole_real_t)SIZES[_i]));
    ASSERT_NEAR(norm_of(q), 1.0, 3.0 * EPS, "");
}
END_TEST

/* Up is up, and the body's x axis points along n-frame x as far as it is level. */
START_TEST(gravity_gives_level_and_yaw_zero_in_any_mounting)
{
    insole_rng_t rng = seeded();
    for (int n = 0; n < TRIES; n++) {
        insole_vec3_t f = sample_vec3(&rng, INSOLE_R(10.0));
        insole_quat_t q = insole_quat_from_gravity(f);
        double size = (double)insole_vec3_norm(f);
        insole_vec3_t up = insole_quat_rotate(q, f), ahead = insole_quat_rotate(q, axis(0));
        ASSERT_NEAR(up.x, 0.0, 16.0 * EPS * size, "m/s^2");
        ASSERT_NEAR(up.y, 0.0, 16.0 * EPS * size, "m/s^2");
        ASSERT_NEAR(up.z, size, 16.0 * EPS * size, "m/s^2");
        ASSERT_NEAR(ahead.y, 0.0, 8.0 * EPS, "");
        ASSERT_AT_LEAST(ahead.x, -8.0 * EPS, "");
    }
}
END_TEST

/* The six faces of a box on a table: which body axis points up. */
START_TEST(gravity_along_each_axis)
{
    static const double FACES[6][3] = {{0.0, 0.0, 9.81},  {0.0, 0.0, -9.81}, {0.0, 9.81, 0.0},
                                       {0.0, -9.81, 0.0}, {9.81, 0.0, 0.0},  {-9.81, 0.0, 0.0}};
    insole_vec3_t f = insole_vec3((insole_real_t)FACES[_i][0], (insole_real_t)FACES[_i][1],
                                  (insole_real_t)FACES[_i][2]);
    insole_quat_t q = insole_quat_from_gravity(f);
    ASSERT_NEAR(norm_of(q), 1.0, 3.0 * EPS, "");
    assert_vec3(insole_quat_rotate(q, f), insole_vec3_scale(axis(2), INSOLE_R(9.81)), 100.0 * EPS);
}
END_TEST

START_TEST(no_gravity_gives_the_identity)
{
    insole_vec3_t none = insole_vec3_zero(), bad = insole_vec3_zero();
    bad.y = (insole_real_t)NAN;
    assert_quat(insole_quat_from_gravity(none), 1.0, 0.0, 0.0, 0.0, 0.0);
    assert_quat(insole_quat_from_gravity(bad), 1.0, 0.0, 0.0, 0.0, 0.0);
}
END_TEST

/* On top of any tilt short of the vertical, yaw comes back. */
START_TEST(yaw_goes_in_and_comes_out)
{
    for (int yaw_deg = -179; yaw_deg <= 180; yaw_deg++) {
        double yaw = yaw_deg * PI / 180.0;
        insole_quat_t turn = insole_quat_from_yaw((insole_real_t)yaw);
        insole_vec3_t east = insole_quat_rotate(turn, axis(0));
        ASSERT_NEAR(east.x, cos(yaw), 8.0 * EPS, "");
        ASSERT_NEAR(east.y, sin(yaw), 8.0 * EPS, "");
        insole_quat_t tilt = insole_quat_from_gravity(resting_force(yaw + 1.0, 1.0));
        double back = (double)insole_quat_yaw(insole_quat_mul(turn, tilt));
        ASSERT_NEAR(remainder(back - yaw, 2.0 * PI), 0.0, 24.0 * EPS, "rad");
        ASSERT_AT_MOST(fabs(back), (double)INSOLE_PI, "rad");
        ASSERT_NEAR(remainder((double)insole_quat_yaw(turn) - yaw, 2.0 * PI), 0.0, 8.0 * EPS,
                    "rad");
    }
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("quat");
    suite_add(suite, "i j = k", hamilton_i_j_is_k);
    suite_add(suite, "conjugate", conjugate_turns_back);
    suite_add(suite, "definition", rotation_agrees_with_its_definition);
    suite_add(suite, "matrices", rotation_matrices_are_rotations);
    suite_add(suite, "order", a_product_turns_by_the_right_factor_first);
    suite_add(suite, "chain", a_chain_turns_as_both_do);
    suite_add_loop(suite, "normalise", normalising_keeps_the_direction, 7);
    suite_add_loop(suite, "no direction", what_has_no_direction_becomes_the_identity, 4);
    suite_add_loop(suite, "rotation vector", rotation_vectors_turn_as_rodrigues_says, ANGLE_COUNT);
    suite_add_loop(suite, "small angles", small_rotation_vectors_keep_their_digits, 4);
    suite_add_loop(suite, "absurd angles", absurd_rotation_vectors_give_finite_unit_quaternions, 4);
    suite_add(suite, "half a rotation vector", half_a_rotation_vector_gives_the_rotation);
    suite_add_loop(suite, "half without end", half_a_rotation_vector_without_end_gives_no_nonsense,
                   4);
    suite_add(suite, "roll and pitch", gravity_gives_roll_and_pitch);
    suite_add(suite, "level", gravity_gives_level_and_yaw_zero_in_any_mounting);
    suite_add_loop(suite, "six faces", gravity_along_each_axis, 6);
    suite_add(suite, "no gravity", no_gravity_gives_the_identity);
    suite_add(suite, "yaw", yaw_goes_in_and_comes_out);
    return suite;
}
