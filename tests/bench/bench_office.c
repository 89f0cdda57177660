/* SPDX-License-Identifier: MIT */
#include "bench_office.h"

#define ROOM_W  INSOLE_R(4.0) /* along the corridor */
#define ROOM_D  INSOLE_R(5.0)
#define ROW_D   INSOLE_R(12.0) /* a corridor and the rooms on both its sides */
#define DOOR_AT INSOLE_R(1.5)
#define DOOR_TO INSOLE_R(2.5)
#define SHAFT_M INSOLE_R(0.5)
#define LOSS_DB INSOLE_R(4.0)

enum { WALLS = 10100 };

static struct {
    insole_real_t xy_m[WALLS + 1][8];
    insole_floor_plan_line_t line[WALLS + 1];
    uint32_t lines;
    insole_wall_t wall[WALLS];
    insole_floor_plan_cell_t cell[3 * WALLS];
    uint16_t entry[8 * WALLS < 65535 ? 8 * WALLS : 65535];
    insole_floor_plan_t plan;
} office;

static void draw_ring(insole_line_kind_t kind, insole_spot_t low, insole_spot_t high)
{
    insole_real_t *xy = office.xy_m[office.lines];
    insole_floor_plan_line_t line = {kind, xy, 4, LOSS_DB};
    xy[0] = xy[6] = low.x_m;
    xy[1] = xy[3] = low.y_m;
    xy[2] = xy[4] = high.x_m;
    xy[5] = xy[7] = high.y_m;
    office.line[office.lines++] = line;
}

static void draw_line(insole_spot_t from, insole_spot_t to)
{
    insole_real_t *xy = office.xy_m[office.lines];
    insole_floor_plan_line_t line = {INSOLE_LINE_WALL, xy, 2, LOSS_DB};
    xy[0] = from.x_m;
    xy[1] = from.y_m;
    xy[2] = to.x_m;
    xy[3] = to.y_m;
    office.line[office.lines++] = line;
}

static void draw_wall(insole_real_t x_m, insole_real_t y_m, insole_real_t width_m,
                      insole_real_t depth_m)
{
    insole_spot_t from = {x_m, y_m}, to = {x_m + width_m, y_m + depth_m};
    draw_line(from, to);
}

/* Two rooms with doors to the corridor between them, and a shaft: 11 walls. */
static void draw_rooms(insole_real_t x, insole_real_t y)
{
    insole_real_t none = INSOLE_R(0.0), upper = y + ROW_D - ROOM_D;
    insole_spot_t shaft = {x, y + ROOM_D - SHAFT_M}, end = {x + SHAFT_M, y + ROOM_D};
    draw_wall(x, y, none, ROOM_D);
    draw_wall(x, upper, none, ROOM_D);
    draw_wall(x, y, ROOM_W, none);
    draw_wall(x, y + ROOM_D, DOOR_AT, none);
    draw_wall(x + DOOR_TO, y + ROOM_D, ROOM_W - DOOR_TO, none);
    draw_wall(x, upper, DOOR_AT, none);
    draw_wall(x + DOOR_TO, upper, ROOM_W - DOOR_TO, none);
    draw_ring(INSOLE_LINE_HOLE, shaft, end);
}

void bench_build_office(uint32_t columns, uint32_t rows)
{
    insole_spot_t low = {INSOLE_R(0.0), INSOLE_R(0.0)};
    insole_spot_t high = {(insole_real_t)columns * ROOM_W, (insole_real_t)rows * ROW_D};
    insole_floor_plan_memory_t memory = {
        office.wall,  WALLS,
        office.cell,  sizeof office.cell / sizeof office.cell[0],
        office.entry, sizeof office.entry / sizeof office.entry[0]};
    office.lines = 0;
    draw_ring(INSOLE_LINE_OUTLINE, low, high);
    for (uint32_t i = 0; i < columns * rows; i++) {
        draw_rooms((insole_real_t)(i % columns) * ROOM_W, (insole_real_t)(i / columns) * ROW_D);
    }
    insole_floor_plan_build(&office.plan, office.line, office.lines, &memory);
}

/* ---- radio ---- */

static insole_ap_t aps[BENCH_APS];
const insole_building_t bench_building = {&insole_propagation_defaults, aps, BENCH_APS,
                                          &office.plan, NULL};
insole_rss_t bench_readings[BENCH_APS];

/* Over 16 m x 48 m. */
void bench_put_aps(void)
{
    for (uint32_t i = 0; i < BENCH_APS; i++) {
        insole_propagation_ap(&insole_propagation_defaults, INSOLE_R(2.0) * (insole_real_t)(i + 1u),
                              INSOLE_R(6.0) * (insole_real_t)((5u * i) % BENCH_APS) + INSOLE_R(2.0),
                              INSOLE_R(2.5), &aps[i]);
    }
}

void bench_listen(insole_spot_t at, insole_real_t way_rad)
{
    insole_turn_t ahead = insole_turn(way_rad);
    for (uint32_t i = 0; i < BENCH_APS; i++) {
        insole_walls_between_t walls = {0, 0};
        insole_expected_rss_t expected = {0, 0};
        insole_real_t dx = aps[i].x_m - at.x_m, dy = aps[i].y_m - at.y_m;
        bool behind = dx * ahead.cos + dy * ahead.sin < INSOLE_R(0.0);
        insole_floor_plan_walls_between(&office.plan, at.x_m, at.y_m, aps[i].x_m, aps[i].y_m,
                                        &walls);
        insole_propagation_expect(&insole_propagation_defaults, &aps[i], at.x_m, at.y_m,
                                  walls.loss_db, behind ? INSOLE_R(1.0) : INSOLE_R(0.0), &expected);
        bench_readings[i].id = i;
        bench_readings[i].rss_dbm =
            expected.rss_dbm + INSOLE_R(4.0) * insole_rng_normal(&bench_rng);
    }
}
