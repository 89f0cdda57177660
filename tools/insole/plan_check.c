/* SPDX-License-Identifier: MIT */
#include "plan_check.h"

#include <math.h>
#include <stdlib.h>

#include "memory.h"
#include "plan_shape.h"

static const double smallest_m = 2.0, largest_m = 2000.0;
static const double smallest_ring_m2 = 0.01;
static const double pixels_m = 300.0;     /* whole numbers up to more than this may be pixels */
static const double outside_wall_m = 0.1; /* farther outside than this is outside */
static const double outside_ap_m = 1.0;
static const double doubled_gap_m = 0.05, doubled_length_m = 0.3;

enum { DOUBLED_TOLD = 5 };

#define ADD(weight, line, ...)                                                                     \
    findings_add(findings, FINDING_##weight, FINDING_PLAN, line, __VA_ARGS__)

/* ---- scale ------------------------------------------------------------------------------ */

plan_box_t plan_box(const plan_file_t *plan)
{
    plan_box_t box = {{HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}};
    for (size_t i = 0u; i < plan->count; i++) {
        const plan_line_t *line = &plan->lines[i];
        for (size_t k = 0u; k < line->count && line->floor == 0u; k++) {
            box.low.x_m = fmin(box.low.x_m, line->points[k].x_m);
            box.low.y_m = fmin(box.low.y_m, line->points[k].y_m);
            box.high.x_m = fmax(box.high.x_m, line->points[k].x_m);
            box.high.y_m = fmax(box.high.y_m, line->points[k].y_m);
        }
    }
    return box;
}

static bool is_all_whole(const plan_file_t *plan)
{
    for (size_t i = 0u; i < plan->count; i++) {
        for (size_t k = 0u; k < plan->lines[i].count; k++) {
            plan_point_t p = plan->lines[i].points[k];
            if (p.x_m != floor(p.x_m) || p.y_m != floor(p.y_m)) {
                return false;
            }
        }
    }
    return true;
}

/* A building is far less than a degree wide, and few stand where longitude and latitude are 0. */
static bool looks_like_degrees(plan_box_t box, double extent)
{
    return extent < 0.1 && fabs(box.low.x_m) <= 180.0 && fabs(box.low.y_m) <= 180.0 &&
           fmax(fabs(box.low.x_m), fabs(box.low.y_m)) > 0.5;
}

static void check_scale(findings_t *findings, const plan_file_t *plan)
{
    plan_box_t box = plan_box(plan);
    double width = box.high.x_m - box.low.x_m, height = box.high.y_m - box.low.y_m;
    double extent = fmax(width, height);
    if (looks_like_degrees(box, extent)) {
        ADD(ERROR, 0u,
            "%g x %g m at %g,%g: these look like degrees: expected metres from a corner of the "
            "building",
            width, height, box.low.x_m, box.low.y_m);
    } else if (extent < smallest_m) {
        ADD(ERROR, 0u, "the building is %g x %g m: expected at least %g m; are these kilometres?",
            width, height, smallest_m);
    } else if (extent > largest_m) {
        ADD(ERROR, 0u,
            "the building is %g x %g m: expected at most %g m; are these pixels or millimetres?",
            width, height, largest_m);
    } else if (extent > pixels_m && is_all_whole(plan)) {
        ADD(WARNING, 0u, "whole numbers up to %g m: are these pixels?", extent);
    }
}

/* ---- single lines ----------------------------------------------------------------------- */

/* @return true when it does */
static bool crosses_itself(findings_t *findings, const plan_line_t *ring)
{
    plan_point_t where;
    for (size_t i = 0u; i < ring->count; i++) {
        for (size_t k = i + 2u; k < ring->count; k++) {
            if (plan_pieces_cross(ring->points[i], plan_line_end(ring, i), ring->points[k],
                                  plan_line_end(ring, k), &where)) {
                ADD(ERROR, ring->number,
                    "%s crosses itself near %.2f,%.2f: expected corners in their order around it",
                    plan_line_kind_name(ring->kind), where.x_m, where.y_m);
                return true;
            }
        }
    }
    return false;
}

/* @return pieces of no length, the last of them in `*where` */
static size_t count_nothings(const plan_line_t *line, plan_point_t *where)
{
    size_t count = 0u;
    for (size_t i = 0u; i < plan_line_pieces(line); i++) {
        plan_point_t a = line->points[i], b = plan_line_end(line, i);
        if (a.x_m == b.x_m && a.y_m == b.y_m) {
            *where = a;
            count++;
        }
    }
    return count;
}

static void check_line(findings_t *findings, const plan_line_t *line)
{
    plan_point_t where = {0.0, 0.0};
    size_t nothings = count_nothings(line, &where);
    bool is_ring = line->kind != INSOLE_LINE_WALL;
    if (nothings == plan_line_pieces(line)) {
        ADD(ERROR, line->number, "%s of no length at %.2f,%.2f: expected points that differ",
            plan_line_kind_name(line->kind), where.x_m, where.y_m);
    } else if (is_ring && !crosses_itself(findings, line) &&
               plan_ring_area(line) < smallest_ring_m2) {
        ADD(ERROR, line->number, "%s around %.2g m^2: expected at least %g m^2",
            plan_line_kind_name(line->kind), plan_ring_area(line), smallest_ring_m2);
    } else if (nothings > 0u) {
        ADD(WARNING, line->number, "the point %.2f,%.2f comes twice in a row", where.x_m,
            where.y_m);
    }
}

/* ---- lines and their outline ------------------------------------------------------------ */

static void check_hole_inside(findings_t *findings, const plan_file_t *plan,
                              const plan_line_t *hole)
{
    for (size_t i = 0u; i < hole->count; i++) {
        if (plan_distance_outside(plan, hole->floor, hole->points[i]) <= 0.0) {
            return;
        }
    }
    for (size_t i = 0u; i < plan->count; i++) {
        const plan_line_t *outline = &plan->lines[i];
        if (outline->kind == INSOLE_LINE_OUTLINE && outline->floor == hole->floor &&
            plan_ring_holds(hole, outline->points[0])) {
            return; /* and nobody can be in that outline, which is told elsewhere */
        }
    }
    ADD(WARNING, hole->number, "hole outside the outline, near %.2f,%.2f", hole->points[0].x_m,
        hole->points[0].y_m);
}

static void check_wall_inside(findings_t *findings, const plan_file_t *plan,
                              const plan_line_t *wall)
{
    for (size_t i = 0u; i < wall->count; i++) {
        plan_point_t p = wall->points[i];
        double distance_m = plan_distance_outside(plan, wall->floor, p);
        if (distance_m > outside_wall_m) {
            ADD(WARNING, wall->number, "wall reaches %.1f m outside the outline, to %.2f,%.2f",
                distance_m, p.x_m, p.y_m);
            return;
        }
    }
}

static void check_inside(findings_t *findings, const plan_file_t *plan, const plan_line_t *line)
{
    if (!plan_file_has_outline(plan, line->floor)) {
        return;
    }
    if (line->kind == INSOLE_LINE_HOLE) {
        check_hole_inside(findings, plan, line);
    } else if (line->kind == INSOLE_LINE_WALL) {
        check_wall_inside(findings, plan, line);
    }
}

/* ---- walls that lie on each other ------------------------------------------------------- */

/* Length over which the piece from c to d runs along that from a to b; its middle in `*where`. */
static double shared_length(plan_point_t a, plan_point_t b, plan_point_t c, plan_point_t d,
                            plan_point_t *where)
{
    double length = hypot(b.x_m - a.x_m, b.y_m - a.y_m);
    if (!(length > 0.0) || fabs(plan_turn(a, b, c)) > doubled_gap_m * length ||
        fabs(plan_turn(a, b, d)) > doubled_gap_m * length) {
        return 0.0;
    }
    double ux = (b.x_m - a.x_m) / length, uy = (b.y_m - a.y_m) / length;
    double along_c = (c.x_m - a.x_m) * ux + (c.y_m - a.y_m) * uy;
    double along_d = (d.x_m - a.x_m) * ux + (d.y_m - a.y_m) * uy;
    double low = fmax(0.0, fmin(along_c, along_d)), high = fmin(length, fmax(along_c, along_d));
    where->x_m = a.x_m + 0.5 * (low + high) * ux;
    where->y_m = a.y_m + 0.5 * (low + high) * uy;
    return fmax(high - low, 0.0);
}

/* Do pieces of the two lines lie on each other? `where` the first do. */
static bool lie_on_each_other(const plan_line_t *a, const plan_line_t *b, plan_point_t *where)
{
    for (size_t i = 0u; i < plan_line_pieces(a); i++) {
        for (size_t k = a == b ? i + 1u : 0u; k < plan_line_pieces(b); k++) {
            if (shared_length(a->points[i], plan_line_end(a, i), b->points[k], plan_line_end(b, k),
                              where) > doubled_length_m) {
                return true;
            }
        }
    }
    return false;
}

static plan_box_t line_box(const plan_line_t *line)
{
    plan_box_t box = {line->points[0], line->points[0]};
    for (size_t i = 1u; i < line->count; i++) {
        box.low.x_m = fmin(box.low.x_m, line->points[i].x_m);
        box.low.y_m = fmin(box.low.y_m, line->points[i].y_m);
        box.high.x_m = fmax(box.high.x_m, line->points[i].x_m);
        box.high.y_m = fmax(box.high.y_m, line->points[i].y_m);
    }
    return box;
}

static bool are_near(plan_box_t a, plan_box_t b)
{
    return a.low.x_m <= b.high.x_m + doubled_gap_m && b.low.x_m <= a.high.x_m + doubled_gap_m &&
           a.low.y_m <= b.high.y_m + doubled_gap_m && b.low.y_m <= a.high.y_m + doubled_gap_m;
}

/* A drawing that doubles its walls doubles all of them: the first are enough to see it. */
static void tell_doubled(findings_t *findings, const plan_line_t *a, const plan_line_t *b,
                         plan_point_t where, size_t before)
{
    if (before < DOUBLED_TOLD) {
        ADD(WARNING, b->number,
            "%s runs along the %s of line %lu near %.2f,%.2f: radio counts both",
            plan_line_kind_name(b->kind), plan_line_kind_name(a->kind), a->number, where.x_m,
            where.y_m);
    }
}

static void check_doubled(findings_t *findings, const plan_file_t *plan)
{
    plan_box_t *boxes = memory_new(plan->count, sizeof *boxes);
    size_t pairs = 0u;
    for (size_t k = 0u; k < plan->count; k++) {
        const plan_line_t *b = &plan->lines[k];
        boxes[k] = line_box(b);
        for (size_t i = 0u; i <= k; i++) {
            const plan_line_t *a = &plan->lines[i];
            plan_point_t where;
            if (a->floor == b->floor && are_near(boxes[i], boxes[k]) &&
                lie_on_each_other(a, b, &where)) {
                tell_doubled(findings, a, b, where, pairs++);
            }
        }
    }
    if (pairs > DOUBLED_TOLD) {
        ADD(WARNING, 0u, "%u more lines run along others", (unsigned)(pairs - DOUBLED_TOLD));
    }
    free(boxes);
}

/* ---- the whole -------------------------------------------------------------------------- */

static void check_floors(findings_t *findings, const plan_file_t *plan)
{
    if (plan->floor_count > 1u) {
        ADD(WARNING, plan->floors[1].line, "%u floors: only the first, %d, is used",
            (unsigned)plan->floor_count, (int)plan->floors[0].number);
    }
    if (!plan_file_has_outline(plan, 0u)) {
        ADD(ERROR, 0u, "no outline: expected a ring around where one can walk");
    }
}

/* Line of the wall next to a place. */
static unsigned long nearest_line(const plan_file_t *plan, plan_point_t place)
{
    double least_m = HUGE_VAL;
    unsigned long number = 0u;
    for (size_t i = 0u; i < plan->count; i++) {
        double distance_m =
            plan->lines[i].floor == 0u ? plan_line_distance(&plan->lines[i], place) : HUGE_VAL;
        if (distance_m < least_m) {
            least_m = distance_m;
            number = plan->lines[i].number;
        }
    }
    return number;
}

static void check_parts(findings_t *findings, const plan_file_t *plan, const plan_parts_t *parts)
{
    if (!plan_file_has_outline(plan, 0u)) {
        return;
    }
    if (!(parts->walkable_m2 > 0.0)) {
        ADD(ERROR, 0u, "nowhere to walk: expected an outline that is not all holes");
    } else if (!parts->is_searched) {
        ADD(WARNING, 0u, "too large to look for closed rooms");
    } else if (parts->count == 0u) {
        ADD(WARNING, 0u, "too narrow to walk: nowhere are %g m free", 2.0 * PLAN_PARTS_BODY_M);
    }
    for (size_t i = 1u; i < parts->count; i++) {
        plan_point_t place = parts->parts[i].place;
        ADD(WARNING, nearest_line(plan, place),
            "closed room: %.0f m^2 around %.1f,%.1f cannot be reached: expected a gap of %g m or "
            "more",
            parts->parts[i].area_m2, place.x_m, place.y_m, PLAN_PARTS_DOOR_M);
    }
}

static void check_aps(findings_t *findings, const site_t *site)
{
    for (size_t i = 0u; i < site->ap_file.count; i++) {
        plan_point_t place = {(double)site->ap_file.aps[i].x_m, (double)site->ap_file.aps[i].y_m};
        double distance_m = plan_distance_outside(&site->plan_file, 0u, place);
        if (distance_m > outside_ap_m && isfinite(distance_m)) {
            findings_add(findings, FINDING_WARNING, FINDING_APS, site->ap_file.lines[i],
                         "%.63s lies %.1f m outside the outline, at %.2f,%.2f",
                         site->ap_file.ids.names[i], distance_m, place.x_m, place.y_m);
        }
    }
}

void plan_check(findings_t *findings, const site_t *site, const plan_parts_t *parts)
{
    const plan_file_t *plan = &site->plan_file;
    check_scale(findings, plan);
    if (findings->errors > 0u) {
        return; /* in a wrong unit everything is too near or too far */
    }
    check_floors(findings, plan);
    for (size_t i = 0u; i < plan->count; i++) {
        check_line(findings, &plan->lines[i]);
        check_inside(findings, plan, &plan->lines[i]);
    }
    check_doubled(findings, plan);
    check_parts(findings, plan, parts);
    check_aps(findings, site);
    findings_sort(findings);
}
