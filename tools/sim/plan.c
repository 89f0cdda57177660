/* SPDX-License-Identifier: MIT */
#include "sim/plan.h"

#include <math.h>
#include <string.h>

#include "sim/text.h"

static const double furthest_m = 1e5, highest_m = 1e4;
static const double highest_db = 200.0;
static const double highest_floor = 1000.0;
static const double smallest_ring_m2 = 0.01;

typedef struct {
    sim_plan_t *plan;
    int floors;     /* opened so far */
    double ring_db; /* loss of the rings that come */
} reader_t;

/* --- geometry --- */

/* Twice the area of the triangle; positive when p, q, r turn left. */
static double turn(sim_point_t p, sim_point_t q, sim_point_t r)
{
    return (q.x_m - p.x_m) * (r.y_m - p.y_m) - (q.y_m - p.y_m) * (r.x_m - p.x_m);
}

bool sim_wall_is_crossed(const sim_wall_t *wall, sim_point_t p, sim_point_t q)
{
    return (turn(p, q, wall->a) > 0.0) != (turn(p, q, wall->b) > 0.0) &&
           (turn(wall->a, wall->b, p) > 0.0) != (turn(wall->a, wall->b, q) > 0.0);
}

static double point_distance(sim_point_t p, sim_point_t a, sim_point_t b)
{
    double dx = b.x_m - a.x_m, dy = b.y_m - a.y_m, length2 = dx * dx + dy * dy;
    double along = (p.x_m - a.x_m) * dx + (p.y_m - a.y_m) * dy;
    double share = length2 > 0.0 ? fmax(0.0, fmin(1.0, along / length2)) : 0.0;
    return hypot(p.x_m - a.x_m - share * dx, p.y_m - a.y_m - share * dy);
}

double sim_wall_distance(const sim_wall_t *wall, sim_point_t p, sim_point_t q)
{
    if (sim_wall_is_crossed(wall, p, q)) {
        return 0.0;
    }
    return fmin(fmin(point_distance(p, wall->a, wall->b), point_distance(q, wall->a, wall->b)),
                fmin(point_distance(wall->a, p, q), point_distance(wall->b, p, q)));
}

double sim_plan_clearance(const sim_plan_t *plan, sim_point_t p, sim_point_t q)
{
    double least = HUGE_VAL;
    for (size_t i = 0; i < plan->walls.count; i++) {
        least = fmin(least, sim_wall_distance(sim_plan_wall(plan, i), p, q));
    }
    return least;
}

/* A ray to the east crosses the ring an odd number of times. */
static bool is_in_ring(const sim_plan_t *plan, const sim_ring_t *ring, sim_point_t p)
{
    bool inside = false;
    for (size_t i = 0; i < ring->count; i++) {
        const sim_wall_t *edge = sim_plan_wall(plan, ring->first + i);
        sim_point_t low = edge->a, high = edge->b;
        if ((low.y_m > p.y_m) != (high.y_m > p.y_m)) {
            double share = (p.y_m - low.y_m) / (high.y_m - low.y_m);
            inside = inside != (low.x_m + share * (high.x_m - low.x_m) > p.x_m);
        }
    }
    return inside;
}

bool sim_plan_is_inside(const sim_plan_t *plan, sim_point_t p)
{
    bool outlined = false, inside = false;
    for (size_t i = 0; i < plan->rings.count; i++) {
        const sim_ring_t *ring = sim_list_at(&plan->rings, i);
        bool in = is_in_ring(plan, ring, p);
        if (ring->is_hole && in) {
            return false;
        }
        outlined = outlined || !ring->is_hole;
        inside = inside || in;
    }
    return inside || !outlined;
}

bool sim_plan_box(const sim_plan_t *plan, sim_point_t *low, sim_point_t *high)
{
    low->x_m = low->y_m = HUGE_VAL;
    high->x_m = high->y_m = -HUGE_VAL;
    for (size_t i = 0; i < plan->walls.count; i++) {
        const sim_wall_t *wall = sim_plan_wall(plan, i);
        low->x_m = fmin(low->x_m, fmin(wall->a.x_m, wall->b.x_m));
        low->y_m = fmin(low->y_m, fmin(wall->a.y_m, wall->b.y_m));
        high->x_m = fmax(high->x_m, fmax(wall->a.x_m, wall->b.x_m));
        high->y_m = fmax(high->y_m, fmax(wall->a.y_m, wall->b.y_m));
    }
    return plan->walls.count > 0;
}

/* --- the file --- */

static bool add_wall(sim_plan_t *plan, sim_point_t a, sim_point_t b, double loss_db,
                     sim_error_t *error)
{
    sim_wall_t wall = {a, b, plan->lines, loss_db};
    if (a.x_m == b.x_m && a.y_m == b.y_m) {
        return sim_fail(error, "the point %g,%g comes twice in a row, expected a line", a.x_m,
                        a.y_m);
    }
    return sim_list_add(&plan->walls, &wall) || sim_fail(error, "out of memory");
}

/* The next two fields; false with nothing written to `error->text` at the end of the line. */
static bool read_point(char **rest, sim_point_t *point, sim_error_t *error)
{
    const char *x = sim_text_field(rest), *y = sim_text_field(rest);
    error->text[0] = '\0';
    if (x == NULL) {
        return false;
    }
    if (y == NULL) {
        return sim_fail(error, "a point has no y, expected x,y,x,y,...");
    }
    return sim_text_number(x, "x", -furthest_m, furthest_m, &point->x_m, error) &&
           sim_text_number(y, "y", -furthest_m, furthest_m, &point->y_m, error);
}

/* The pieces from point to point; `last` is the end of the line. */
static bool read_pieces(sim_plan_t *plan, double loss_db, char *rest, sim_point_t *last,
                        sim_error_t *error)
{
    sim_point_t point;
    if (!read_point(&rest, last, error)) {
        return error->text[0] == '\0' ? sim_fail(error, "no points, expected x,y,x,y,...") : false;
    }
    while (read_point(&rest, &point, error)) {
        if (!add_wall(plan, *last, point, loss_db, error)) {
            return false;
        }
        *last = point;
    }
    return error->text[0] == '\0';
}

static double ring_area(const sim_plan_t *plan, const sim_ring_t *ring)
{
    double twice = 0.0;
    sim_point_t first = sim_plan_wall(plan, ring->first)->a;
    for (size_t i = 0; i < ring->count; i++) {
        const sim_wall_t *edge = sim_plan_wall(plan, ring->first + i);
        twice += turn(first, edge->a, edge->b);
    }
    return 0.5 * fabs(twice);
}

static bool read_ring(reader_t *reader, bool is_hole, char *rest, sim_error_t *error)
{
    sim_plan_t *plan = reader->plan;
    sim_ring_t ring = {plan->walls.count, 0, is_hole};
    sim_point_t last;
    if (!read_pieces(plan, reader->ring_db, rest, &last, error)) {
        return false;
    }
    ring.count = plan->walls.count - ring.first;
    if (ring.count < 2) {
        return sim_fail(error, "a ring of too few points, expected at least 3");
    }
    sim_point_t first = sim_plan_wall(plan, ring.first)->a;
    if (first.x_m != last.x_m || first.y_m != last.y_m) {
        if (!add_wall(plan, last, first, reader->ring_db, error)) {
            return false;
        }
        ring.count++;
    }
    if (!(ring_area(plan, &ring) >= smallest_ring_m2)) {
        return sim_fail(error, "a ring of no area, expected at least %g m^2", smallest_ring_m2);
    }
    plan->lines++;
    return sim_list_add(&plan->rings, &ring) || sim_fail(error, "out of memory");
}

static bool read_loss(char **rest, double *loss_db, sim_error_t *error)
{
    const char *text = sim_text_field(rest);
    return sim_text_number(text == NULL ? "" : text, "loss", 0.0, highest_db, loss_db, error);
}

static bool read_wall(reader_t *reader, char *rest, sim_error_t *error)
{
    double loss_db;
    sim_point_t last;
    size_t before = reader->plan->walls.count;
    if (!read_loss(&rest, &loss_db, error) ||
        !read_pieces(reader->plan, loss_db, rest, &last, error)) {
        return false;
    }
    reader->plan->lines++;
    return reader->plan->walls.count > before ||
           sim_fail(error, "a wall of one point, expected wall,loss_db,x,y,x,y,...");
}

static bool read_floor(reader_t *reader, char *rest, sim_error_t *error)
{
    double number, z_m;
    const char *number_text = sim_text_field(&rest), *z_text = sim_text_field(&rest);
    if (z_text == NULL) {
        return sim_fail(error, "too few fields, expected floor,number,z,name");
    }
    reader->floors += reader->floors == 0 && reader->plan->lines > 0 ? 2 : 1;
    return sim_text_number(number_text, "number", -highest_floor, highest_floor, &number, error) &&
           sim_text_number(z_text, "z", -highest_m, highest_m, &z_m, error);
}

static bool read_record(reader_t *reader, const char *kind, char *rest, sim_error_t *error)
{
    if (strcmp(kind, "outline") == 0 || strcmp(kind, "hole") == 0) {
        return read_ring(reader, *kind == 'h', rest, error);
    }
    if (strcmp(kind, "wall") == 0) {
        return read_wall(reader, rest, error);
    }
    if (strcmp(kind, "loss") == 0) {
        return read_loss(&rest, &reader->ring_db, error) &&
               (rest == NULL || sim_fail(error, "too many fields, expected loss,dB"));
    }
    return sim_fail(
        error, "'%.60s' is no part of a plan, expected floor, outline, hole, wall, loss", kind);
}

/* What belongs to a second floor is checked, but not kept. */
static bool read_line(void *state, char *line, int number, sim_error_t *error)
{
    reader_t *reader = state;
    (void)number;
    char *rest = line;
    const char *kind = sim_text_field(&rest);
    if (strcmp(kind, "floor") == 0) {
        return read_floor(reader, rest, error);
    }
    if (reader->floors <= 1) {
        return read_record(reader, kind, rest, error);
    }
    sim_plan_t other = sim_plan_empty();
    reader_t aside = {&other, 2, reader->ring_db};
    bool good = read_record(&aside, kind, rest, error);
    sim_plan_free(&other);
    return good;
}

sim_plan_t sim_plan_empty(void)
{
    sim_plan_t plan = {sim_list(sizeof(sim_wall_t)), sim_list(sizeof(sim_ring_t)), 0};
    return plan;
}

bool sim_plan_read(FILE *stream, sim_plan_t *plan, sim_error_t *error)
{
    *plan = sim_plan_empty();
    reader_t reader = {plan, 0, nan("")};
    int lines;
    bool good = sim_text_lines(stream, read_line, &reader, &lines, error);
    if (good && plan->walls.count == 0) {
        sim_fail(error, "the plan is empty, expected an outline or a wall");
        good = sim_fail_on_line(error, lines + 1);
    }
    if (!good) {
        sim_plan_free(plan);
    }
    return good;
}

void sim_plan_free(sim_plan_t *plan)
{
    sim_list_free(&plan->walls);
    sim_list_free(&plan->rings);
    plan->lines = 0;
}
