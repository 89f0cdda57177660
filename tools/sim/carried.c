/* SPDX-License-Identifier: MIT */
#include "sim/carried.h"

#include "sim/site.h"

static const char *const pose_names[SIM_POSES] = {"hand", "ear", "swing", "pocket"};
static const char *const kind_names[] = {"walk", "run", "stairs", "shuffle"};

static void write_poses(FILE *stream, const sim_phone_t *phone)
{
    const sim_list_t *poses = &phone->changes.poses;
    fputs("t,pose\n", stream);
    for (size_t i = 0; i < poses->count; i++) {
        const sim_pose_change_t *change = sim_list_at(poses, i);
        double done_s = change->t_s;
        if (i > 0) {
            fprintf(stream, "%.3f,change\n", change->t_s);
            done_s += phone->hold.settings.change_s;
        }
        fprintf(stream, "%.3f,%s\n", done_s, pose_names[change->pose]);
    }
}

static void write_steps(FILE *stream, const sim_list_t *steps)
{
    fputs("t,foot,kind\n", stream);
    for (size_t i = 2; i < steps->count; i++) { /* the first two stand from the beginning */
        const sim_step_t *step = sim_list_at(steps, i);
        fprintf(stream, "%.6f,%s,%s\n", step->strike_s,
                step->side == SIM_SIDE_LEFT ? "left" : "right", kind_names[step->kind]);
    }
}

bool sim_carried_write(const sim_walk_t *walk, const char *folder, sim_error_t *error)
{
    const sim_phone_t *phone = sim_walk_phone(walk);
    if (phone == NULL) {
        return true;
    }
    FILE *poses = sim_site_create(folder, "pose.csv", error);
    if (poses == NULL) {
        return false;
    }
    write_poses(poses, phone);
    FILE *steps = sim_site_create(folder, "steps.csv", error);
    if (steps == NULL) {
        sim_site_close(poses);
        return false;
    }
    write_steps(steps, &sim_walk_steps(walk)->steps);
    bool done = sim_site_close(poses);
    return (sim_site_close(steps) && done) ||
           sim_fail(error, "%.300s cannot be written to", folder);
}
