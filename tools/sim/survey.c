/* SPDX-License-Identifier: MIT */
#include "sim/survey.h"

#include <math.h>
#include <stdlib.h>

#include "sim/grid.h"
#include "sim/site.h"
#include "sim/trunk.h"

/* A walker who stops at a point stands within this of it. */
static const double at_point_m = 0.1;
enum { NO_POINT = -1 };

/* Of one access point at one reference point. */
typedef struct {
    double count, mean_dbm, squares_db2; /* squared distances from the mean, summed up */
} cell_t;

typedef struct {
    sim_list_t points; /* of sim_point_t */
    cell_t *cells;     /* by point, then by access point */
    size_t aps;
} table_t;

static long point_at(const sim_list_t *points, const sim_place_t *place)
{
    for (size_t i = 0; i < points->count; i++) {
        const sim_point_t *p = sim_list_at(points, i);
        if (hypot(p->x_m - place->x_m, p->y_m - place->y_m) <= at_point_m) {
            return (long)i;
        }
    }
    return NO_POINT;
}

static void add(cell_t *cell, double dbm)
{
    double step = dbm - cell->mean_dbm;
    cell->count += 1.0;
    cell->mean_dbm += step / cell->count;
    cell->squares_db2 += step * (dbm - cell->mean_dbm);
}

static void fill(table_t *table, const sim_walk_t *walk, const sim_list_t *heard)
{
    double last_s = -1.0;
    long point = NO_POINT;
    for (size_t i = 0; i < heard->count; i++) {
        const sim_heard_t *h = sim_list_at(heard, i);
        double heard_s = h->t_s - h->age_s;
        if (heard_s != last_s) {
            sim_place_t place = sim_trunk_at(sim_walk_steps(walk), heard_s);
            point = point_at(&table->points, &place);
            last_s = heard_s;
        }
        if (point != NO_POINT) {
            add(&table->cells[(size_t)point * table->aps + h->ap], h->dbm);
        }
    }
}

static void write_rows(FILE *stream, const table_t *table, const sim_list_t *aps)
{
    for (size_t i = 0; i < table->points.count; i++) {
        const sim_point_t *p = sim_list_at(&table->points, i);
        for (size_t a = 0; a < table->aps; a++) {
            const cell_t *cell = &table->cells[i * table->aps + a];
            const sim_ap_t *ap = sim_list_at(aps, a);
            double std_db = sqrt(cell->squares_db2 / fmax(1.0, cell->count - 1.0));
            if (cell->count > 0.0) {
                fprintf(stream, "%.3f,%.3f,%s,%.2f,%.2f,%.0f\n", p->x_m, p->y_m, ap->id,
                        cell->mean_dbm, std_db, cell->count);
            }
        }
    }
}

static bool write_grid(FILE *stream, double spacing_m, const sim_walk_t *walk,
                       const sim_scenario_t *scenario, const sim_list_t *heard)
{
    table_t table = {.aps = scenario->aps.count};
    if (!sim_reference_points(scenario, spacing_m, &table.points)) {
        return false;
    }
    table.cells = calloc(table.points.count * table.aps + 1, sizeof *table.cells);
    if (table.cells != NULL) {
        fill(&table, walk, heard);
        write_rows(stream, &table, &scenario->aps);
    }
    bool done = table.cells != NULL;
    free(table.cells);
    sim_list_free(&table.points);
    return done;
}

/* Spacing of the first survey; 0: there is none. */
static double spacing_of(const sim_scenario_t *scenario)
{
    for (size_t i = 0; i < scenario->orders.count; i++) {
        const sim_order_t *order = sim_list_at(&scenario->orders, i);
        if (order->kind == SIM_ORDER_SURVEY) {
            return order->spacing_m;
        }
    }
    return 0.0;
}

bool sim_survey_write(const sim_walk_t *walk, const sim_scenario_t *scenario,
                      const sim_list_t *heard, const char *folder, sim_error_t *error)
{
    double spacing_m = spacing_of(scenario);
    if (spacing_m == 0.0 || scenario->aps.count == 0) {
        return true;
    }
    FILE *stream = sim_site_create(folder, "radiomap.csv", error);
    if (stream == NULL) {
        return false;
    }
    fputs("x,y,id,mean_dbm,std_dbm,count\n", stream);
    bool done = write_grid(stream, spacing_m, walk, scenario, heard);
    if (!sim_site_close(stream)) {
        return sim_fail(error, "%.300s cannot be written to", folder);
    }
    return done || sim_fail(error, "out of memory");
}
