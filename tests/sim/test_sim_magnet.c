/* SPDX-License-Identifier: MIT */
#include "sim/magnet.h"

#include "buildings.h"
#include "near.h"
#include "suite.h"

#define HALL "outline,0,0,30,0,30,20,0,20\n"

static sim_magnet_t magnet_in(const char *settings, const char *plan, uint64_t seed)
{
    char text[600];
    sim_error_t error;
    sim_magnet_t magnet;
    snprintf(text, sizeof text, "start,2,2,0\n%s", settings);
    sim_scenario_t scenario = scenario_in(text, plan, "");
    ck_assert(sim_magnet_open(&magnet, &scenario, seed, &error));
    sim_scenario_free(&scenario);
    return magnet;
}

static sim_vec3_t field_at(const sim_magnet_t *magnet, double x, double y, double z)
{
    return sim_magnet_field(magnet, sim_vec3(x, y, z));
}

START_TEST(without_steel_it_is_that_of_the_earth)
{
    sim_magnet_t m = magnet_in("magnet.field_ut = 50\nmagnet.dip_rad = 0.6435011\n"
                               "magnet.declination_rad = 0.1\n",
                               "", 1);
    for (double x = 0.0; x < 30.0; x += 7.0) {
        sim_vec3_t f = field_at(&m, x, 3.0, 1.0); /* 40 level, 30 down */
        ASSERT_NEAR(f.x, 40.0 * sin(0.1), 1e-5, "uT");
        ASSERT_NEAR(f.y, 40.0 * cos(0.1), 1e-5, "uT");
        ASSERT_NEAR(f.z, -30.0, 1e-5, "uT");
    }
    sim_magnet_close(&m);
}
END_TEST

/* On the axis of a dipole 2 m / r^3, beside it -m / r^3. */
START_TEST(a_piece_of_steel_is_a_dipole)
{
    sim_magnet_t m = magnet_in("magnet.field_ut = 0\n", "", 1);
    sim_steel_t piece = {sim_vec3(1.0, 2.0, 3.0), sim_vec3(0.0, 0.0, 200.0)};
    ck_assert(sim_list_add(&m.steel, &piece));
    sim_vec3_t above = field_at(&m, 1.0, 2.0, 13.0), beside = field_at(&m, 11.0, 2.0, 3.0);
    ASSERT_NEAR(above.z, 0.04, 5e-4, "uT"); /* half a metre of size is still seen */
    ASSERT_NEAR(beside.z, -0.02, 5e-4, "uT");
    ASSERT_NEAR(fabs(above.x) + fabs(above.y) + fabs(beside.x) + fabs(beside.y), 0.0, 1e-12, "uT");
    sim_vec3_t inside = field_at(&m, 1.0, 2.0, 3.0);
    ck_assert(isfinite(inside.x) && isfinite(inside.y) && fabs(inside.z) < 1000.0);
    sim_magnet_close(&m);
}
END_TEST

START_TEST(disturbances_are_local)
{
    sim_magnet_t one = magnet_in("magnet.steel_m2 = 600\n", HALL, 1);
    ck_assert_uint_eq(one.steel.count, 1u);
    const sim_steel_t *piece = sim_list_at(&one.steel, 0);
    ck_assert(piece->at_m.x >= 0.0 && piece->at_m.x <= 30.0 && piece->at_m.y >= 0.0 &&
              piece->at_m.y <= 20.0);
    sim_vec3_t near = field_at(&one, piece->at_m.x + 0.8, piece->at_m.y, piece->at_m.z);
    sim_vec3_t far = field_at(&one, piece->at_m.x + 8.0, piece->at_m.y, piece->at_m.z);
    ASSERT_AT_LEAST(sim_vec3_norm(sim_vec3_sub(near, one.earth_ut)), 1.0, "uT");
    ASSERT_AT_MOST(sim_vec3_norm(sim_vec3_sub(far, one.earth_ut)), 0.1, "uT");
    sim_magnet_close(&one);
}
END_TEST

START_TEST(steel_is_as_dense_as_told_and_belongs_to_the_building)
{
    sim_magnet_t a = magnet_in("", HALL, 1), b = magnet_in("", HALL, 2);
    sim_magnet_t other = magnet_in("radio.building = 7\n", HALL, 1);
    sim_magnet_t c = magnet_in("radio.building = 0\n", HALL, 1);
    sim_magnet_t d = magnet_in("radio.building = 0\n", HALL, 2);
    ck_assert_uint_eq(a.steel.count, 40u);
    sim_vec3_t at_a = field_at(&a, 5.0, 5.0, 1.0), at_b = field_at(&b, 5.0, 5.0, 1.0);
    ck_assert(at_a.x == at_b.x && at_a.y == at_b.y && at_a.z == at_b.z);
    ck_assert(at_a.x != field_at(&other, 5.0, 5.0, 1.0).x);
    ck_assert(field_at(&c, 5.0, 5.0, 1.0).x != field_at(&d, 5.0, 5.0, 1.0).x);
    ck_assert(a.hard_ut.x != b.hard_ut.x); /* another phone in the same building */
    sim_magnet_close(&a);
    sim_magnet_close(&b);
    sim_magnet_close(&other);
    sim_magnet_close(&c);
    sim_magnet_close(&d);
}
END_TEST

START_TEST(turning_the_phone_changes_components_only)
{
    sim_magnet_t m = magnet_in("magnet.model = ideal\n", HALL, 3);
    sim_vec3_t truth = field_at(&m, 6.0, 7.0, 1.2);
    for (double angle = -3.0; angle < 3.0; angle += 0.37) {
        sim_pose_t pose = {sim_vec3(6.0, 7.0, 1.2),
                           sim_mat3_from_euler(angle, 0.4 * angle, 1.0 - angle)};
        sim_vec3_t read = sim_magnet_read(&m, &pose);
        ASSERT_NEAR(sim_vec3_norm(read), sim_vec3_norm(truth), 1e-9, "uT");
        sim_vec3_t back = sim_mat3_mul_vec(pose.attitude, read);
        ASSERT_NEAR(sim_vec3_norm(sim_vec3_sub(back, truth)), 0.0, 1e-9, "uT");
    }
    sim_magnet_close(&m);
}
END_TEST

/* Turned by half a turn about z, x and y of the field change sign, the phone's own iron does not.
 */
START_TEST(hard_iron_turns_with_the_phone)
{
    sim_magnet_t m = magnet_in("magnet.hard_ut = 20\nmagnet.soft = 0\nmagnet.noise_ut = 0\n"
                               "magnet.step_ut = 0\n",
                               "", 4);
    sim_pose_t ahead = {sim_vec3(1.0, 1.0, 1.0), sim_mat3_identity()}, back = ahead;
    back.attitude = sim_mat3_from_euler(0.0, 0.0, SIM_PI);
    sim_vec3_t sum = sim_vec3_add(sim_magnet_read(&m, &ahead), sim_magnet_read(&m, &back));
    ASSERT_NEAR(0.5 * sum.x, m.hard_ut.x, 1e-9, "uT");
    ASSERT_NEAR(0.5 * sum.y, m.hard_ut.y, 1e-9, "uT");
    ASSERT_AT_LEAST(sim_vec3_norm(m.hard_ut), 5.0, "uT");
    sim_magnet_close(&m);
}
END_TEST

/* Root mean square over many phones of what one reads too much, field (0, 30, -40). */
START_TEST(errors_of_the_phone_have_the_sigma_told)
{
    double hard = 0.0, soft = 0.0;
    int n = 1500;
    sim_pose_t pose = {sim_vec3(0.0, 0.0, 0.0), sim_mat3_identity()};
    const char *field = "magnet.field_ut = 50\nmagnet.dip_rad = 0.9272952\n"
                        "magnet.declination_rad = 0\nmagnet.noise_ut = 0\nmagnet.step_ut = 0\n";
    char with_hard[300], with_soft[300];
    snprintf(with_hard, sizeof with_hard, "%smagnet.hard_ut = 2\nmagnet.soft = 0\n", field);
    snprintf(with_soft, sizeof with_soft, "%smagnet.hard_ut = 0\nmagnet.soft = 0.03\n", field);
    for (int seed = 1; seed <= n; seed++) {
        sim_magnet_t h = magnet_in(with_hard, "", (uint64_t)seed);
        sim_magnet_t s = magnet_in(with_soft, "", (uint64_t)seed);
        hard += pow(sim_magnet_read(&h, &pose).x, 2.0) / n;
        soft += pow(sim_magnet_read(&s, &pose).x, 2.0) / n; /* from y and z */
        sim_magnet_close(&h);
        sim_magnet_close(&s);
    }
    ASSERT_NEAR(sqrt(hard), 2.0, 0.15, "uT");
    ASSERT_NEAR(sqrt(soft), 0.03 * 50.0, 0.11, "uT");
}
END_TEST

START_TEST(readings_are_noisy_and_come_in_steps)
{
    sim_magnet_t m = magnet_in("magnet.noise_ut = 0.5\nmagnet.step_ut = 0.25\n", "", 5);
    sim_pose_t pose = {sim_vec3(0.0, 0.0, 0.0), sim_mat3_identity()};
    double sum = 0.0, squares = 0.0;
    int n = 20000;
    for (int i = 0; i < n; i++) {
        double x = sim_magnet_read(&m, &pose).x;
        ASSERT_NEAR(x / 0.25, round(x / 0.25), 1e-9, "1");
        sum += x / n;
        squares += x * x / n;
    }
    ASSERT_NEAR(sqrt(squares - sum * sum), sqrt(0.25 + 0.0625 / 12.0), 0.012, "uT");
    sim_magnet_close(&m);
}
END_TEST

START_TEST(equal_seeds_read_the_same)
{
    sim_magnet_t a = magnet_in("", HALL, 9), b = magnet_in("", HALL, 9);
    sim_pose_t pose = {sim_vec3(3.0, 3.0, 1.0), sim_mat3_from_euler(0.1, 0.2, 0.3)};
    for (int i = 0; i < 100; i++) {
        sim_vec3_t p = sim_magnet_read(&a, &pose), q = sim_magnet_read(&b, &pose);
        ck_assert(p.x == q.x && p.y == q.y && p.z == q.z);
    }
    sim_magnet_close(&a);
    sim_magnet_close(&b);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("sim/magnet");
    suite_add(suite, "earth", without_steel_it_is_that_of_the_earth);
    suite_add(suite, "dipole", a_piece_of_steel_is_a_dipole);
    suite_add(suite, "local", disturbances_are_local);
    suite_add(suite, "building", steel_is_as_dense_as_told_and_belongs_to_the_building);
    suite_add(suite, "turning", turning_the_phone_changes_components_only);
    suite_add(suite, "hard iron", hard_iron_turns_with_the_phone);
    suite_add(suite, "sigma", errors_of_the_phone_have_the_sigma_told);
    suite_add(suite, "noise", readings_are_noisy_and_come_in_steps);
    suite_add(suite, "seeds", equal_seeds_read_the_same);
    return suite;
}
