/* SPDX-License-Identifier: MIT */
#include "sim/way.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double square_share = 0.6;    /* of the clearance */
static const double straight_share = 0.85; /* of the clearance: kept by the pulled way */
static const double shortest_straight_m = 0.6;
enum { NEIGHBOURS = 8, NOWHERE = -1 };

static const long step_column[NEIGHBOURS] = {1, -1, 0, 0, 1, 1, -1, -1};
static const long step_row[NEIGHBOURS] = {0, 0, 1, -1, 1, -1, 1, -1};

static sim_point_t middle(const sim_way_map_t *map, long square)
{
    sim_point_t p = {map->low.x_m + ((double)(square % map->columns) + 0.5) * map->square_m,
                     map->low.y_m + ((double)(square / map->columns) + 0.5) * map->square_m};
    return p;
}

static long column_of(const sim_way_map_t *map, double x_m)
{
    double column = floor((x_m - map->low.x_m) / map->square_m);
    return (long)fmax(0.0, fmin((double)(map->columns - 1), column));
}

static long row_of(const sim_way_map_t *map, double y_m)
{
    double row = floor((y_m - map->low.y_m) / map->square_m);
    return (long)fmax(0.0, fmin((double)(map->rows - 1), row));
}

/* Closes the squares that are too near to a wall. */
static void close_beside(sim_way_map_t *map, const sim_wall_t *wall)
{
    double far = map->clearance_m;
    long left = column_of(map, fmin(wall->a.x_m, wall->b.x_m) - far);
    long right = column_of(map, fmax(wall->a.x_m, wall->b.x_m) + far);
    long low = row_of(map, fmin(wall->a.y_m, wall->b.y_m) - far);
    long high = row_of(map, fmax(wall->a.y_m, wall->b.y_m) + far);
    for (long row = low; row <= high; row++) {
        for (long column = left; column <= right; column++) {
            long square = row * map->columns + column;
            sim_point_t p = middle(map, square);
            if (sim_wall_distance(wall, p, p) < far) {
                map->is_free[square] = 0;
            }
        }
    }
}

bool sim_way_map(sim_way_map_t *map, const sim_plan_t *plan, double clearance_m)
{
    sim_point_t high;
    map->plan = plan;
    map->clearance_m = clearance_m;
    map->square_m = square_share * clearance_m;
    sim_plan_box(plan, &map->low, &high);
    map->columns = 1 + (long)((high.x_m - map->low.x_m) / map->square_m);
    map->rows = 1 + (long)((high.y_m - map->low.y_m) / map->square_m);
    size_t squares = (size_t)map->columns * (size_t)map->rows;
    map->is_free = malloc(squares);
    if (map->is_free == NULL) {
        return false;
    }
    memset(map->is_free, 1, squares);
    for (size_t i = 0; i < plan->walls.count; i++) {
        close_beside(map, sim_plan_wall(plan, i));
    }
    for (size_t i = 0; i < squares; i++) {
        if (map->is_free[i] != 0 && !sim_plan_is_inside(plan, middle(map, (long)i))) {
            map->is_free[i] = 0;
        }
    }
    return true;
}

bool sim_way_can_stand(const sim_way_map_t *map, sim_point_t p)
{
    return sim_plan_is_inside(map->plan, p) &&
           sim_plan_clearance(map->plan, p, p) >= map->clearance_m;
}

static bool is_clear(const sim_way_map_t *map, sim_point_t p, sim_point_t q)
{
    return sim_plan_clearance(map->plan, p, q) >= straight_share * map->clearance_m;
}

static double distance(sim_point_t p, sim_point_t q)
{
    return hypot(q.x_m - p.x_m, q.y_m - p.y_m);
}

/* The free square nearest to a point, of those that can be reached straight from it. */
static long square_near(const sim_way_map_t *map, sim_point_t p)
{
    long nearest = NOWHERE;
    double least = HUGE_VAL;
    for (long row = row_of(map, p.y_m) - 2; row <= row_of(map, p.y_m) + 2; row++) {
        for (long column = column_of(map, p.x_m) - 2; column <= column_of(map, p.x_m) + 2;
             column++) {
            long square = row * map->columns + column;
            bool there = row >= 0 && row < map->rows && column >= 0 && column < map->columns;
            if (!there || map->is_free[square] == 0) {
                continue;
            }
            double far = distance(p, middle(map, square));
            if (far < least && is_clear(map, p, middle(map, square))) {
                least = far;
                nearest = square;
            }
        }
    }
    return nearest;
}

/* The square beside one, or NOWHERE at the edge of the map and where it is not free. */
static long beside(const sim_way_map_t *map, long square, int side)
{
    long column = square % map->columns + step_column[side];
    long row = square / map->columns + step_row[side];
    bool there = column >= 0 && column < map->columns && row >= 0 && row < map->rows;
    long other = row * map->columns + column;
    return there && map->is_free[other] != 0 ? other : NOWHERE;
}

/* Goes outwards from `from` until `to` is reached; `before` then leads back from it. */
static void spread(const sim_way_map_t *map, long from, long to, long *before, long *queue)
{
    long head = 0, tail = 0;
    for (long i = 0; i < map->columns * map->rows; i++) {
        before[i] = NOWHERE;
    }
    before[from] = from;
    queue[tail++] = from;
    while (head < tail && before[to] == NOWHERE) {
        long square = queue[head++];
        for (int side = 0; side < NEIGHBOURS; side++) {
            long other = beside(map, square, side);
            if (other != NOWHERE && before[other] == NOWHERE) {
                before[other] = square;
                queue[tail++] = other;
            }
        }
    }
}

/* All points of the way: the beginning, the middles of the squares, the end. The search began at
 * the end, so that `before` leads on from the beginning. */
static bool add_squares(const sim_way_map_t *map, long from, const long *before, sim_list_t *all)
{
    for (long square = from;; square = before[square]) {
        sim_point_t p = middle(map, square);
        if (!sim_list_add(all, &p)) {
            return false;
        }
        if (before[square] == square) {
            return true;
        }
    }
}

static bool find_squares(const sim_way_map_t *map, sim_point_t from, sim_point_t to,
                         sim_list_t *all)
{
    long first = square_near(map, from), last = square_near(map, to);
    size_t bytes = (size_t)map->columns * (size_t)map->rows * sizeof(long);
    long *before = malloc(bytes), *queue = malloc(bytes);
    bool found = false;
    if (first != NOWHERE && last != NOWHERE && before != NULL && queue != NULL) {
        spread(map, last, first, before, queue);
        found = before[first] != NOWHERE && sim_list_add(all, &from) &&
                add_squares(map, first, before, all) && sim_list_add(all, &to);
    }
    free(before);
    free(queue);
    return found;
}

static sim_point_t point_at(const sim_list_t *points, size_t number)
{
    return *(const sim_point_t *)sim_list_at(points, number);
}

/* The furthest point that can be reached straight, with straights that are not too short. */
static size_t furthest(const sim_way_map_t *map, const sim_list_t *all, size_t here)
{
    sim_point_t p = point_at(all, here), end = point_at(all, all->count - 1);
    for (size_t i = all->count - 1; i > here + 1; i--) {
        sim_point_t q = point_at(all, i);
        bool too_short = distance(p, q) < shortest_straight_m ||
                         (i + 1 < all->count && distance(q, end) < shortest_straight_m);
        if (!too_short && is_clear(map, p, q)) {
            return i;
        }
    }
    return here + 1;
}

static bool pull_straight(const sim_way_map_t *map, const sim_list_t *all, sim_list_t *points)
{
    size_t here = 0;
    bool good = sim_list_add(points, sim_list_at(all, 0));
    while (good && here + 1 < all->count) {
        here = furthest(map, all, here);
        good = sim_list_add(points, sim_list_at(all, here));
    }
    return good;
}

bool sim_way_find(const sim_way_map_t *map, sim_point_t from, sim_point_t to, sim_list_t *points)
{
    sim_list_t all = sim_list(sizeof(sim_point_t));
    *points = sim_list(sizeof(sim_point_t));
    bool good = find_squares(map, from, to, &all) && pull_straight(map, &all, points);
    sim_list_free(&all);
    if (!good) {
        sim_list_free(points);
    }
    return good;
}

void sim_way_map_free(sim_way_map_t *map)
{
    free(map->is_free);
    map->is_free = NULL;
}
