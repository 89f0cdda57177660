/* SPDX-License-Identifier: MIT */
#include "site.h"

#include <stdlib.h>
#include <string.h>

#include "memory.h"
#include "number.h"
#include "platform.h"

/* Of insole_floor_plan_build. */
enum { WALLS_MAX = 65535, CELLS_MAX = 65534, ENTRIES_MAX = 65535 };

/* The plan's lines as the library takes them: all their points lie in one block. */
typedef struct {
    insole_floor_plan_line_t *lines;
    insole_real_t *xy_m;
    uint32_t count, points;
} drawing_t;

static uint32_t count_points(const plan_file_t *plan)
{
    size_t points = 0u;
    for (size_t i = 0u; i < plan->count; i++) {
        points += plan->lines[i].count;
    }
    return (uint32_t)points;
}

static void add_line(drawing_t *drawing, const plan_line_t *line, insole_real_t wall_db)
{
    insole_real_t *xy_m = drawing->xy_m + (size_t)2u * drawing->points;
    for (size_t i = 0u; i < line->count; i++) {
        xy_m[2u * i] = (insole_real_t)line->points[i].x_m;
        xy_m[2u * i + 1u] = (insole_real_t)line->points[i].y_m;
    }
    const insole_floor_plan_line_t taken = {line->kind, xy_m, (uint32_t)line->count,
                                            isnan(line->loss_db) ? wall_db
                                                                 : (insole_real_t)line->loss_db};
    drawing->lines[drawing->count++] = taken;
    drawing->points += (uint32_t)line->count;
}

static drawing_t draw(const plan_file_t *plan, insole_real_t wall_db)
{
    drawing_t drawing = {memory_new(plan->count, sizeof *drawing.lines),
                         memory_new(count_points(plan), 2u * sizeof *drawing.xy_m), 0u, 0u};
    for (size_t i = 0u; i < plan->count; i++) {
        if (plan->lines[i].floor == 0u) {
            add_line(&drawing, &plan->lines[i], wall_db);
        }
    }
    return drawing;
}

static void free_memory(insole_floor_plan_memory_t *memory)
{
    free(memory->walls);
    free(memory->cells);
    free(memory->entries);
    memset(memory, 0, sizeof *memory);
}

/* Room for all that a plan can have: no grid becomes coarser than it would like to be. */
static insole_status_t build(site_t *site, const drawing_t *drawing)
{
    insole_floor_plan_memory_t *memory = &site->memory;
    memory->wall_room = drawing->points;
    memory->cell_room = CELLS_MAX + 1;
    memory->entry_room = ENTRIES_MAX;
    memory->walls = memory_new(memory->wall_room, sizeof *memory->walls);
    memory->cells = memory_new(memory->cell_room, sizeof *memory->cells);
    memory->entries = memory_new(memory->entry_room, sizeof *memory->entries);
    return insole_floor_plan_build(&site->plan, drawing->lines, drawing->count, memory);
}

static bool build_plan(site_t *site, failure_t *failure)
{
    const char *name = site->plan_file.name;
    drawing_t drawing = draw(&site->plan_file, site->building.propagation->wall_db);
    if (drawing.points > WALLS_MAX) {
        failure_input(failure, "%s: %u points: expected at most %d", name, (unsigned)drawing.points,
                      WALLS_MAX);
    } else if (build(site, &drawing) != INSOLE_OK) {
        failure_input(failure,
                      drawing.count == 0u
                          ? "%s: the first floor is empty: expected an outline or a wall"
                          : "%s: no wall has a length: expected points that differ",
                      name);
    } else {
        site->building.plan = &site->plan;
    }
    free(drawing.lines);
    free(drawing.xy_m);
    return site->building.plan != NULL;
}

/* Without one nobody could be anywhere. */
static bool check_outline(const site_t *site, failure_t *failure)
{
    return site->building.plan == NULL || plan_file_has_outline(&site->plan_file, 0u) ||
           failure_input(failure, "%s: no outline: expected a ring around where one can walk",
                         site->plan_file.name);
}

bool site_open_sketch(site_t *site, const char *plan_path, const char *aps_path,
                      const insole_propagation_config_t *propagation, failure_t *failure)
{
    memset(site, 0, sizeof *site);
    site->building.propagation = propagation;
    bool is_good =
        (plan_path == NULL ||
         (plan_file_read(&site->plan_file, plan_path, failure) && build_plan(site, failure))) &&
        (aps_path == NULL || ap_file_read(&site->ap_file, aps_path, propagation, failure));
    if (!is_good) {
        site_free(site);
        return false;
    }
    site->building.aps = site->ap_file.aps;
    site->building.ap_count = (uint32_t)site->ap_file.count;
    return true;
}

bool site_open(site_t *site, const char *plan_path, const char *aps_path, const char *radiomap_path,
               const insole_propagation_config_t *propagation, failure_t *failure)
{
    bool is_good =
        site_open_sketch(site, plan_path, aps_path, propagation, failure) &&
        check_outline(site, failure) &&
        (radiomap_path == NULL || radiomap_file_read(&site->radiomap_file, radiomap_path, failure));
    if (!is_good) {
        site_free(site);
    }
    return is_good;
}

bool site_has_radiomap(const site_t *site)
{
    return site->radiomap_file.map.point_count > 0u;
}

bool site_is_file(const site_t *site, const char *path)
{
    const char *const names[] = {site->plan_file.name, site->ap_file.name,
                                 site->radiomap_file.name};
    for (size_t i = 0u; i < sizeof names / sizeof names[0]; i++) {
        if (names[i] != NULL && platform_is_same_file(names[i], path)) {
            return true;
        }
    }
    return false;
}

size_t site_cell_count(const insole_floor_plan_t *plan)
{
    return (size_t)plan->columns * plan->rows + 1u;
}

size_t site_entry_count(const insole_floor_plan_t *plan)
{
    return plan->cells[site_cell_count(plan) - 1u].begin;
}

size_t site_plan_bytes(const insole_floor_plan_t *plan)
{
    return plan->wall_count * sizeof *plan->walls + site_cell_count(plan) * sizeof *plan->cells +
           site_entry_count(plan) * sizeof *plan->entries;
}

void site_free(site_t *site)
{
    plan_file_free(&site->plan_file);
    ap_file_free(&site->ap_file);
    radiomap_file_free(&site->radiomap_file);
    free_memory(&site->memory);
    memset(site, 0, sizeof *site);
}
