/* SPDX-License-Identifier: MIT */
#include "sim/grid.h"

#include <math.h>

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

static bool add_line(const sim_scenario_t *scenario, const sim_line_t *line, double spacing_m,
                     sim_list_t *points)
{
    double x = line->to.x_m - line->from.x_m, y = line->to.y_m - line->from.y_m;
    int pieces = (int)fmax(1.0, round(hypot(x, y) / spacing_m));
    for (int i = 0; i <= pieces; i++) {
        double share = (double)i / pieces;
        sim_point_t p = {line->from.x_m + share * x, line->from.y_m + share * y};
        if (can_stand(&scenario->plan, scenario->settings.errands.clearance_m, p) &&
            !sim_list_add(points, &p)) {
            return false;
        }
    }
    return true;
}

bool sim_reference_points(const sim_scenario_t *scenario, double spacing_m, sim_list_t *points)
{
    if (scenario->lines.count == 0) {
        return sim_grid(&scenario->plan, spacing_m, scenario->settings.errands.clearance_m, points);
    }
    *points = sim_list(sizeof(sim_point_t));
    for (size_t i = 0; i < scenario->lines.count; i++) {
        if (!add_line(scenario, sim_list_at(&scenario->lines, i), spacing_m, points)) {
            sim_list_free(points);
            return false;
        }
    }
    return true;
}
