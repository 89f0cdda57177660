/* SPDX-License-Identifier: MIT */
#include "sim/changes.h"

#include "near.h"
#include "phones.h"
#include "suite.h"

static const sim_changes_t *changes_of(const sim_walk_t *walk)
{
    return &phone_of(walk)->changes;
}

static const sim_pose_change_t *change_of(const sim_walk_t *walk, size_t number)
{
    const sim_pose_change_t *change = sim_list_at(&changes_of(walk)->poses, number);
    ck_assert_ptr_nonnull(change);
    return change;
}

START_TEST(it_begins_as_told_and_stays_so)
{
    sim_walk_t *walk = walk_of(STRAIGHT "phone.pose = pocket\n", 1);
    ck_assert_uint_eq(changes_of(walk)->poses.count, 1u);
    ck_assert(change_of(walk, 0)->t_s == 0.0 && change_of(walk, 0)->pose == SIM_POSE_POCKET);
    sim_walk_close(walk);
}
END_TEST

START_TEST(changes_of_the_scenario_are_taken_as_they_are)
{
    sim_walk_t *walk =
        walk_of(STRAIGHT "pose,3.5,ear\npose,9,swing\nphone.change_every_s = 5\n", 1);
    ck_assert_uint_eq(changes_of(walk)->poses.count, 3u);
    ck_assert(change_of(walk, 1)->t_s == 3.5 && change_of(walk, 1)->pose == SIM_POSE_EAR);
    ck_assert(change_of(walk, 2)->t_s == 9.0 && change_of(walk, 2)->pose == SIM_POSE_SWING);
    sim_walk_close(walk);
}
END_TEST

START_TEST(drawn_changes_are_real_and_as_many_as_told)
{
    double changes = 0.0, seconds = 0.0, seen[SIM_POSES] = {0.0};
    for (uint64_t seed = 1; seed <= 40; seed++) {
        sim_walk_t *walk = walk_of(STRAIGHT "phone.change_every_s = 10\n", seed);
        double end_s = sim_walk_duration(walk);
        for (size_t i = 1; i < changes_of(walk)->poses.count; i++) {
            const sim_pose_change_t *before = change_of(walk, i - 1), *now = change_of(walk, i);
            ck_assert_int_ne(before->pose, now->pose);
            ck_assert(now->pose >= 0 && now->pose < SIM_POSES);
            ASSERT_AT_LEAST(now->t_s - before->t_s, 3.0 - 1e-9, "s");
            ASSERT_AT_MOST(now->t_s, end_s - 1.0, "s");
            seen[now->pose] += 1.0;
            changes += 1.0;
        }
        seconds += end_s;
        sim_walk_close(walk);
    }
    /* a carry lasts at least 3 s, else 10 s on average: 10 (1 + exp(-0.3) 0.3 ...) */
    ASSERT_NEAR(seconds / changes, 11.0, 2.5, "s");
    for (int pose = 0; pose < SIM_POSES; pose++) {
        ASSERT_AT_LEAST(seen[pose] / changes, 0.1, "1");
    }
}
END_TEST

START_TEST(fidgets_come_while_standing_and_are_as_many_as_told)
{
    const char *text = PHONE "start,0,0,0\nwalk,5,0,1\npause,300\nwalk,10,0,1\npause,1\n"
                             "phone.fidgets_hz = 0.2\nphone.fidget_rad = 0.5\n";
    sim_walk_t *walk = walk_of(text, 3);
    const sim_list_t *fidgets = &changes_of(walk)->fidgets;
    double last = 0.0;
    for (size_t i = 0; i < fidgets->count; i++) {
        const sim_fidget_t *f = sim_list_at(fidgets, i);
        double begin = f->begin_s, end = f->begin_s + f->length_s;
        ASSERT_AT_LEAST(begin, last, "s");
        last = end;
        ASSERT_NEAR(sim_torso_at(&phone_of(walk)->torso, 0.5 * (begin + end)).size, 0.0, 0.2, "1");
        ASSERT_AT_MOST(sim_vec3_norm(f->turn_rad), 1.0 * sqrt(3.0), "rad");
    }
    /* one in 5 s, and the next begins after it: 2.1 s more */
    ASSERT_NEAR((double)fidgets->count, 303.0 / 7.1, 15.0, "fidgets");
    sim_walk_close(walk);
    walk = walk_of(PHONE "start,0,0,0\npause,300\nphone.fidgets_hz = 0\n", 3);
    ck_assert_uint_eq(changes_of(walk)->fidgets.count, 0u);
    sim_walk_close(walk);
}
END_TEST

START_TEST(equal_seeds_change_equally)
{
    const char *text = STRAIGHT "phone.change_every_s = 6\n";
    sim_walk_t *a = walk_of(text, 2), *b = walk_of(text, 2), *c = walk_of(text, 3);
    ck_assert_uint_eq(changes_of(a)->poses.count, changes_of(b)->poses.count);
    for (size_t i = 0; i < changes_of(a)->poses.count; i++) {
        ck_assert(change_of(a, i)->t_s == change_of(b, i)->t_s);
        ck_assert_int_eq(change_of(a, i)->pose, change_of(b, i)->pose);
    }
    ck_assert(change_of(a, 3)->t_s != change_of(c, 3)->t_s);
    sim_walk_close(a);
    sim_walk_close(b);
    sim_walk_close(c);
}
END_TEST

Suite *insole_suite(void)
{
    Suite *suite = suite_create("sim/changes");
    suite_add(suite, "start", it_begins_as_told_and_stays_so);
    suite_add(suite, "told", changes_of_the_scenario_are_taken_as_they_are);
    suite_add(suite, "drawn", drawn_changes_are_real_and_as_many_as_told);
    suite_add(suite, "fidgets", fidgets_come_while_standing_and_are_as_many_as_told);
    suite_add(suite, "seeds", equal_seeds_change_equally);
    return suite;
}
