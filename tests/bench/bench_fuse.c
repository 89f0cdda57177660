/* SPDX-License-Identifier: MIT
 * fuse/: the particle filter in offices of equal density and different size, on a walk along a
 * corridor, into a room and back. All that a stride takes is counted, for all particles together.
 */
#include "bench.h"

#define ROOM_W  INSOLE_R(4.0) /* along the corridor */
#define ROOM_D  INSOLE_R(5.0)
#define ROW_D   INSOLE_R(12.0) /* a corridor and the rooms on both its sides */
#define DOOR_AT INSOLE_R(1.5)
#define DOOR_TO INSOLE_R(2.5)
#define SHAFT_M INSOLE_R(0.5)
#define LOSS_DB INSOLE_R(4.0)
#define LEG_M   INSOLE_R(1.2)

enum { PARTICLES = 500, STRIDES = 48, APS = 8, WALLS = 10100, SLICE = 50 };

/* ---- an office, drawn piece by piece ---- */

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

static void build_office(uint32_t columns, uint32_t rows)
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

/* ---- a walk, and what is told of it ---- */

static insole_ap_t aps[APS];
static const insole_building_t building = {&insole_propagation_defaults, aps, APS, &office.plan,
                                           NULL};
static insole_spot_t at, inertial;
static insole_real_t length_m, heading_rad, turn_rad;
static insole_rss_t readings[APS];

static insole_particle_t particles[PARTICLES];
static const insole_cloud_t cloud = {particles, PARTICLES, NULL, 0, NULL};
static insole_particle_filter_t filter;

/* Over 16 m x 48 m. */
static void put_aps(void)
{
    for (uint32_t i = 0; i < APS; i++) {
        insole_propagation_ap(&insole_propagation_defaults, INSOLE_R(2.0) * (insole_real_t)(i + 1u),
                              INSOLE_R(6.0) * (insole_real_t)((5u * i) % APS) + INSOLE_R(2.0),
                              INSOLE_R(2.5), &aps[i]);
    }
}

static void begin_walk(const insole_particle_filter_config_t *config)
{
    insole_particle_start_t start = {INSOLE_R(2.0), INSOLE_R(6.1), INSOLE_R(0.3), INSOLE_R(0.0),
                                     config->sigma_wander_rad * INSOLE_R(4.0)};
    at.x_m = inertial.x_m = start.x_m;
    at.y_m = inertial.y_m = start.y_m;
    heading_rad = INSOLE_R(0.0);
    put_aps();
    insole_particle_filter_init(&filter, config, 1u);
    insole_particle_filter_start(&filter, &cloud, &start);
    while (insole_particle_filter_work(&filter, &cloud, &building, SLICE)) {
    }
}

/* Ten strides along the corridor, two into a room, turn about, and all the way back. */
static insole_real_t way_of(uint32_t stride)
{
    static const insole_real_t quarters[4] = {INSOLE_R(0.0), INSOLE_R(1.0), INSOLE_R(-1.0),
                                              INSOLE_R(2.0)};
    uint32_t k = stride % 24u;
    return INSOLE_R(0.5) * INSOLE_PI * quarters[k < 10u ? 0u : k < 12u ? 1u : k < 14u ? 2u : 3u];
}

static void listen(insole_real_t way_rad)
{
    insole_turn_t ahead = insole_turn(way_rad);
    for (uint32_t i = 0; i < APS; i++) {
        insole_walls_between_t walls = {0, 0};
        insole_expected_rss_t expected = {0, 0};
        insole_real_t dx = aps[i].x_m - at.x_m, dy = aps[i].y_m - at.y_m;
        bool behind = dx * ahead.cos + dy * ahead.sin < INSOLE_R(0.0);
        insole_floor_plan_walls_between(&office.plan, at.x_m, at.y_m, aps[i].x_m, aps[i].y_m,
                                        &walls);
        insole_propagation_expect(&insole_propagation_defaults, &aps[i], at.x_m, at.y_m,
                                  walls.loss_db, behind ? INSOLE_R(1.0) : INSOLE_R(0.0), &expected);
        readings[i].id = i;
        readings[i].rss_dbm = expected.rss_dbm + INSOLE_R(4.0) * insole_rng_normal(&bench_rng);
    }
}

static void make_stride(uint32_t call)
{
    insole_real_t way_rad = way_of(call);
    insole_turn_t way = insole_turn(way_rad);
    insole_real_t measured_rad = way_rad + INSOLE_R(0.03) * insole_rng_normal(&bench_rng);
    length_m = LEG_M + INSOLE_R(0.02) * insole_rng_normal(&bench_rng);
    turn_rad = call == 0u ? INSOLE_R(0.0) : measured_rad - heading_rad;
    heading_rad = measured_rad;
    at.x_m += LEG_M * way.cos;
    at.y_m += LEG_M * way.sin;
    inertial.x_m = at.x_m + INSOLE_R(0.01) * (insole_real_t)call;
    inertial.y_m = at.y_m;
    listen(way_rad);
}

/* ---- what is counted ---- */

static void work(const insole_evidence_t *news)
{
    insole_particle_filter_begin(&filter, &building, news);
    while (insole_particle_filter_work(&filter, &cloud, &building, SLICE)) {
    }
    bench_result[0] = filter.fix.x_m;
    bench_result[1] = filter.fix.y_m;
    bench_result[2] = filter.fix.offset_rad;
    bench_result[3] = filter.fix.scale;
    bench_result[4] = filter.fix.effective;
    bench_result[5] = (insole_real_t)filter.counts.recovered;
    bench_result[6] = (insole_real_t)filter.counts.resampled;
}

/* All that is heard, and nothing else. */
static void take_scan(void)
{
    static const insole_spot_t here = {0, 0};
    insole_evidence_t news;
    insole_evidence_clear(&news);
    insole_evidence_stride(&news, length_m, heading_rad, turn_rad);
    insole_evidence_scan(&news, readings, APS, here);
    work(&news);
}

static uint32_t strongest(void)
{
    uint32_t best = 0;
    for (uint32_t i = 1; i < APS; i++) {
        best = readings[i].rss_dbm > readings[best].rss_dbm ? i : best;
    }
    return best;
}

/* The paper's second order: where the first one is, and how far the strongest access point. */
static void take_position_and_range(void)
{
    const insole_rss_t *reading = &readings[strongest()];
    const insole_ap_t *ap = &aps[reading->id];
    insole_rss_range_t heard = {INSOLE_R(1.0), INSOLE_R(1.0)};
    insole_evidence_t news;
    insole_evidence_clear(&news);
    insole_evidence_stride(&news, length_m, heading_rad, turn_rad);
    insole_evidence_position(&news, inertial, INSOLE_R(0.5));
    insole_propagation_range(&insole_propagation_defaults, ap, reading->rss_dbm, INSOLE_R(0.0),
                             INSOLE_R(0.5), &heard);
    insole_evidence_range_t range = {{ap->x_m, ap->y_m}, {0, 0}, heard.range_m, INSOLE_R(2.0), 0};
    insole_evidence_range(&news, &range);
    work(&news);
}

static void begin_small(void)
{
    build_office(5u, 2u);
    begin_walk(&insole_particle_filter_defaults);
}

static void begin_usual(void)
{
    build_office(7u, 13u);
    begin_walk(&insole_particle_filter_defaults);
}

static void begin_huge(void)
{
    build_office(26u, 35u);
    begin_walk(&insole_particle_filter_defaults);
}

static void begin_small_two_order(void)
{
    build_office(5u, 2u);
    begin_walk(&insole_particle_filter_two_order);
}

static void begin_usual_two_order(void)
{
    build_office(7u, 13u);
    begin_walk(&insole_particle_filter_two_order);
}

static void begin_huge_two_order(void)
{
    build_office(26u, 35u);
    begin_walk(&insole_particle_filter_two_order);
}

static void call_insole_particle_filter_100(uint32_t call)
{
    (void)call;
    take_scan();
}

static void call_insole_particle_filter_1000(uint32_t call)
{
    (void)call;
    take_scan();
}

static void call_insole_particle_filter_10000(uint32_t call)
{
    (void)call;
    take_scan();
}

static void call_insole_particle_filter_two_order_100(uint32_t call)
{
    (void)call;
    take_position_and_range();
}

static void call_insole_particle_filter_two_order_1000(uint32_t call)
{
    (void)call;
    take_position_and_range();
}

static void call_insole_particle_filter_two_order_10000(uint32_t call)
{
    (void)call;
    take_position_and_range();
}

static const bench_case_t cases[] = {
    {"insole_particle_filter_100", STRIDES, begin_small, make_stride,
     call_insole_particle_filter_100, NULL},
    {"insole_particle_filter_1000", STRIDES, begin_usual, make_stride,
     call_insole_particle_filter_1000, NULL},
    {"insole_particle_filter_10000", STRIDES, begin_huge, make_stride,
     call_insole_particle_filter_10000, NULL},
    {"insole_particle_filter_two_order_100", STRIDES, begin_small_two_order, make_stride,
     call_insole_particle_filter_two_order_100, NULL},
    {"insole_particle_filter_two_order_1000", STRIDES, begin_usual_two_order, make_stride,
     call_insole_particle_filter_two_order_1000, NULL},
    {"insole_particle_filter_two_order_10000", STRIDES, begin_huge_two_order, make_stride,
     call_insole_particle_filter_two_order_10000, NULL},
};

const bench_table_t bench_fuse = BENCH_TABLE(cases);
