/* SPDX-License-Identifier: MIT */
#include "sim/grid.h"

static bool can_stand(const sim_plan_t *plan, double clearance_m, sim_point_t p)
{
    return sim_plan_is_inside(plan, p) && sim_plan_clearance(plan, p, p) >= clearance_m;
}

bool sim_grid(const sim_plan_t *plan, double spacing_m, double clearance_m, sim_list_t *points)
{
    sim_point_t low, high;
    *points = sim_list(sizeof(sim_point_t));
    if (!sim_plan_box(plan, &low, &high)) {
        return true;
    }
    for (int row = 0; low.y_m + (row + 0.5) * spacing_m <= high.y_m; row++) {
        for (int column = 0; low.x_m + (column + 0.5) * spacing_m <= high.x_m; column++) {
            sim_point_t p = {low.x_m + (column + 0.5) * spacing_m,
                             low.y_m + (row + 0.5) * spacing_m};
            if (can_stand(plan, clearance_m, p) && !sim_list_add(points, &p)) {
                sim_list_free(points);
                return false;
            }
        }
    }
    return true;
}
