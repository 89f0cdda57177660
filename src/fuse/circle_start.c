/* SPDX-License-Identifier: MIT */
#include "insole/fuse/circle_start.h"

#include <stddef.h>

#define ZERO INSOLE_R(0.0)
#define HALF INSOLE_R(0.5)
#define ONE  INSOLE_R(1.0)

/* What squares of distances count beside the distances: enough to choose among equals, 1/m. */
static const insole_real_t TIE = INSOLE_R(1.0e-3);

/* Circles whose middles are nearer meet nowhere, or everywhere. */
static const insole_real_t SAME_M = INSOLE_R(0.001);

/* The search about the best candidates: steps from metres to a millimetre, a few of each. */
static const insole_real_t FIRST_STEP_M = INSOLE_R(2.0);
enum { STEPS = 12, MOVES_PER_STEP = 12, REFINED = 3 };

/* As the paper turns, and as fine as makes sense. */
static const insole_real_t TURN_RAD = INSOLE_PI / INSOLE_R(36.0);
static const insole_real_t LAST_TURN_RAD = INSOLE_R(1.0e-4);
enum { TURNS = 18 };

typedef struct {
    const insole_circle_pair_t *pairs;
    uint32_t count;
} circles_t;

typedef struct {
    insole_spot_t place;
    insole_real_t cost;
} candidate_t;

static circles_t circles_of(const insole_circle_pair_t *pairs, uint32_t count)
{
    uint32_t most = INSOLE_CIRCLE_START_MOST;
    circles_t circles = {pairs, pairs == NULL ? 0u : count < most ? count : most};
    return circles;
}

/* From a place to a circle; negative inside. */
static insole_real_t distance(const insole_circle_pair_t *pair, insole_spot_t place)
{
    return insole_spot_norm(insole_spot_sub(place, pair->radio)) - insole_spot_norm(pair->way);
}

INSOLE_COLD insole_real_t insole_circle_start_distance(const insole_circle_pair_t *pairs,
                                                       uint32_t count, insole_spot_t place)
{
    circles_t circles = circles_of(pairs, count);
    insole_real_t sum = ZERO;
    for (uint32_t i = 0u; i < circles.count; i++) {
        sum += insole_abs(distance(&circles.pairs[i], place));
    }
    return sum;
}

static candidate_t candidate_at(const circles_t *circles, insole_spot_t place)
{
    candidate_t candidate = {place, ZERO};
    for (uint32_t i = 0u; i < circles->count; i++) {
        insole_real_t off = insole_abs(distance(&circles->pairs[i], place));
        candidate.cost += off + TIE * off * off;
    }
    return candidate;
}

/* Keeps the best, in their order. */
static void consider(const circles_t *circles, candidate_t best[REFINED], insole_spot_t place)
{
    candidate_t candidate = candidate_at(circles, place);
    for (uint32_t i = 0u; i < REFINED; i++) {
        if (candidate.cost < best[i].cost) {
            candidate_t worse = best[i];
            best[i] = candidate;
            candidate = worse;
        }
    }
}

/* Where two circles meet, or the middle of the gap between them. */
static void consider_meeting(const circles_t *circles, candidate_t best[REFINED], uint32_t a,
                             uint32_t b)
{
    const insole_circle_pair_t *p = &circles->pairs[a], *q = &circles->pairs[b];
    insole_real_t r = insole_spot_norm(p->way), s = insole_spot_norm(q->way);
    insole_spot_t between = insole_spot_sub(q->radio, p->radio);
    insole_real_t d = insole_spot_norm(between);
    if (!(d > SAME_M)) {
        return;
    }
    insole_real_t along = HALF * (d + (r + s) * (r - s) / d);
    insole_real_t across2 = (r - along) * (r + along);
    if (across2 < ZERO) {
        along = d > r + s ? HALF * (d + r - s) : r > s ? HALF * (r + d + s) : HALF * (d - s - r);
        across2 = ZERO;
    }
    insole_real_t across = insole_sqrt(across2) / d;
    insole_spot_t foot = insole_spot_add_scaled(p->radio, along / d, between);
    insole_spot_t side = {-between.y_m, between.x_m};
    consider(circles, best, insole_spot_add_scaled(foot, across, side));
    consider(circles, best, insole_spot_add_scaled(foot, -across, side));
}

/* The best of eight neighbours. @return whether it is better */
static bool move(const circles_t *circles, candidate_t *best, insole_real_t step_m)
{
    static const insole_spot_t SIDES[8] = {{1, 0}, {-1, 0}, {0, 1},  {0, -1},
                                           {1, 1}, {-1, 1}, {1, -1}, {-1, -1}};
    insole_spot_t from = best->place;
    bool moved = false;
    for (uint32_t i = 0u; i < 8u; i++) {
        candidate_t next = candidate_at(circles, insole_spot_add_scaled(from, step_m, SIDES[i]));
        if (next.cost < best->cost) {
            *best = next;
            moved = true;
        }
    }
    return moved;
}

static candidate_t refine(const circles_t *circles, candidate_t best)
{
    insole_real_t step_m = FIRST_STEP_M;
    for (uint32_t k = 0u; k < STEPS; k++) {
        uint32_t moves = 0u;
        while (moves < MOVES_PER_STEP && move(circles, &best, step_m)) {
            moves++;
        }
        step_m *= HALF;
    }
    return best;
}

insole_spot_t insole_circle_start_place(const insole_circle_pair_t *pairs, uint32_t count)
{
    circles_t circles = circles_of(pairs, count);
    candidate_t none = {{ZERO, ZERO}, INSOLE_REAL_MAX}, best[REFINED] = {none, none, none};
    for (uint32_t a = 0u; a < circles.count; a++) {
        consider(&circles, best, pairs[a].radio);
        for (uint32_t b = 0u; b < a; b++) {
            consider_meeting(&circles, best, a, b);
        }
    }
    candidate_t found = best[0];
    for (uint32_t i = 0u; i < REFINED && best[i].cost < INSOLE_REAL_MAX; i++) {
        candidate_t refined = refine(&circles, best[i]);
        found = refined.cost < found.cost ? refined : found;
    }
    return found.place; /* [WifiShift (1)] */
}

/* ---- direction ----------------------------------------------------------------------------- */

typedef struct {
    insole_spot_t middle; /* of the fixes */
    insole_spot_t normal;
    insole_real_t forward_rad; /* offset by which the walk goes as the fixes went */
} line_t;

static line_t regression(const circles_t *circles)
{
    insole_real_t per = ONE / (insole_real_t)circles->count, dot = ZERO, cross = ZERO;
    insole_spot_t middle = {ZERO, ZERO}, mean_way = {ZERO, ZERO};
    insole_sym2_t scatter = insole_sym2_circle(ZERO);
    for (uint32_t i = 0u; i < circles->count; i++) {
        middle = insole_spot_add_scaled(middle, per, circles->pairs[i].radio);
        mean_way = insole_spot_add_scaled(mean_way, per, circles->pairs[i].way);
    }
    for (uint32_t i = 0u; i < circles->count; i++) {
        insole_spot_t fix = insole_spot_sub(circles->pairs[i].radio, middle);
        insole_spot_t way = insole_spot_sub(circles->pairs[i].way, mean_way);
        scatter = insole_sym2_add_outer(scatter, ONE, fix);
        dot += insole_spot_dot(way, fix);
        cross += way.x_m * fix.y_m - way.y_m * fix.x_m;
    }
    insole_turn_t axis =
        insole_turn(HALF * insole_atan2(scatter.xy + scatter.xy, scatter.xx - scatter.yy));
    line_t line = {middle, {-axis.sin, axis.cos}, insole_atan2(cross, dot)};
    return line;
}

/* Total distance of the turned walk from the line. */
static insole_real_t off_line(const circles_t *circles, const line_t *line, insole_spot_t begin,
                              insole_real_t offset_rad)
{
    insole_turn_t turn = insole_turn(offset_rad);
    insole_spot_t from = insole_spot_sub(begin, line->middle);
    insole_real_t sum = ZERO;
    for (uint32_t i = 0u; i < circles->count; i++) {
        insole_spot_t place = insole_spot_add(from, insole_turn_way(turn, circles->pairs[i].way));
        sum += insole_abs(insole_spot_dot(line->normal, place));
    }
    return sum;
}

INSOLE_COLD insole_real_t insole_circle_start_direction(const insole_circle_pair_t *pairs,
                                                        uint32_t count, insole_spot_t begin)
{
    circles_t circles = circles_of(pairs, count);
    if (circles.count == 0u) {
        return ZERO;
    }
    line_t line = regression(&circles);
    insole_real_t best_rad = line.forward_rad, least = off_line(&circles, &line, begin, best_rad);
    insole_real_t step_rad = TURN_RAD;
    int32_t side = TURNS; /* first all turns to a right angle, then finer ones about the best */
    while (step_rad > LAST_TURN_RAD) {
        insole_real_t middle_rad = best_rad;
        for (int32_t k = -side; k <= side; k++) {
            insole_real_t off_rad = middle_rad + (insole_real_t)k * step_rad - line.forward_rad;
            off_rad = insole_min(insole_max(off_rad, -HALF * INSOLE_PI), HALF * INSOLE_PI);
            insole_real_t offset_rad = line.forward_rad + off_rad;
            insole_real_t off = off_line(&circles, &line, begin, offset_rad);
            best_rad = off < least ? offset_rad : best_rad;
            least = insole_min(off, least);
        }
        side = 1;
        step_rad *= HALF;
    }
    return insole_wrap_pi(best_rad);
}
