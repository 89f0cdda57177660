/* SPDX-License-Identifier: MIT */
#include "insole/track/foot_late.h"

#include <stddef.h>
#include <string.h>

#include "insole/base/fastmath.h"

#define ZERO INSOLE_R(0.0)

/* A stride shorter than this has no direction of its own. */
#define SHORT_M INSOLE_R(0.2)

/* No stride is stretched by more than these. */
#define STRETCH_MIN INSOLE_R(0.5)
#define STRETCH_MAX INSOLE_R(2.0)

INSOLE_COLD insole_status_t insole_foot_late_init(insole_foot_late_t *late, insole_late_row_t *rows,
                                                  uint32_t room)
{
    if (!late || (!rows && room > 0u)) {
        return INSOLE_ERR_NULL;
    }
    memset(late, 0, sizeof *late);
    late->rows = rows;
    late->room = room;
    return INSOLE_OK;
}

INSOLE_COLD insole_status_t insole_foot_late_stride(insole_foot_late_t *late, uint32_t number,
                                                    insole_spot_t n_m)
{
    if (!late) {
        return INSOLE_ERR_NULL;
    }
    if (!insole_spot_is_finite(n_m)) {
        return INSOLE_ERR_VALUE;
    }
    late->end_n_m[number % INSOLE_LATE_STRIDES] = n_m;
    return INSOLE_OK;
}

insole_status_t insole_foot_late_push(insole_foot_late_t *late, const insole_late_row_t *row)
{
    if (!late || !row) {
        return INSOLE_ERR_NULL;
    }
    if (late->count == late->room) {
        return INSOLE_ERR_ROOM;
    }
    late->rows[(late->first + late->count) % late->room] = *row;
    late->count++;
    return INSOLE_OK;
}

bool insole_foot_late_is_due(const insole_foot_late_t *late, uint64_t lag_us)
{
    if (!late || late->count == 0u) {
        return false;
    }
    const insole_late_row_t *newest = &late->rows[(late->first + late->count - 1u) % late->room];
    return late->count == late->room ||
           newest->fix.t_us - late->rows[late->first].fix.t_us >= lag_us;
}

/* Where the ancestors were when this stride ended, if anybody knows. */
static bool recall(const insole_particle_filter_t *particles, const insole_cloud_t *cloud,
                   uint32_t stride, insole_spot_t *m_m)
{
    uint32_t ago = particles->since_start - stride;
    return stride <= particles->since_start && ago < INSOLE_LATE_STRIDES &&
           insole_particle_filter_past(particles, cloud, ago, m_m) == INSOLE_OK;
}

/* While the particles are being worked on nobody can tell, but what was the end is the begin. */
static void find_begin(insole_foot_late_t *late, const insole_late_row_t *row)
{
    late->has_begin =
        late->has_end && late->start == row->start && late->stride + 1u == row->stride;
    late->begin_m_m = late->end_m_m;
    late->has_end = false;
    late->news--; /* to be looked up yet */
}

static void look_up(insole_foot_late_t *late, const insole_late_row_t *row,
                    const insole_particle_filter_t *particles, const insole_cloud_t *cloud)
{
    late->has_begin = recall(particles, cloud, row->stride, &late->begin_m_m);
    late->has_end = recall(particles, cloud, row->stride + 1u, &late->end_m_m);
    late->news = particles->counts.strides + particles->counts.scans;
}

/* Both ends of what this fix lies between. A pass over the cloud is made for a new stride, and for
 * news while the stride after it has not ended. */
static void find_ends(insole_foot_late_t *late, const insole_late_row_t *row,
                      const insole_particle_filter_t *particles, const insole_cloud_t *cloud)
{
    bool is_same = late->stride == row->stride && late->start == row->start;
    bool is_old = late->news != particles->counts.strides + particles->counts.scans;
    if (particles->phase == INSOLE_PARTICLES_IDLE) {
        if (!is_same || (is_old && !(late->has_begin && late->has_end))) {
            look_up(late, row, particles, cloud);
        }
    } else if (!is_same) {
        find_begin(late, row);
    }
    late->stride = row->stride;
    late->start = row->start;
}

static insole_spot_t way(insole_spot_t from, insole_spot_t to)
{
    insole_spot_t between = {to.x_m - from.x_m, to.y_m - from.y_m};
    return between;
}

/* What turns and stretches the way in n into the way in m: a division of complex numbers. */
static insole_turn_t turn_between(insole_spot_t n, insole_spot_t m, insole_turn_t otherwise)
{
    insole_real_t square = n.x_m * n.x_m + n.y_m * n.y_m;
    if (square < insole_square(SHORT_M)) {
        return otherwise;
    }
    insole_turn_t turn = {(m.x_m * n.x_m + m.y_m * n.y_m) / square,
                          (m.y_m * n.x_m - m.x_m * n.y_m) / square};
    insole_real_t stretch = insole_sqrt(turn.cos * turn.cos + turn.sin * turn.sin);
    bool is_sane = stretch > STRETCH_MIN && stretch < STRETCH_MAX;
    return is_sane ? turn : otherwise;
}

static void correct(const insole_foot_late_t *late, const insole_late_row_t *row,
                    const insole_cloud_fix_t *cloud, insole_fix_t *fix)
{
    insole_spot_t begin_n = late->end_n_m[row->stride % INSOLE_LATE_STRIDES];
    insole_turn_t turn = insole_turn(cloud->offset_rad);
    if (late->has_end) {
        insole_spot_t end_n = late->end_n_m[(row->stride + 1u) % INSOLE_LATE_STRIDES];
        turn = turn_between(way(begin_n, end_n), way(late->begin_m_m, late->end_m_m), turn);
    }
    insole_spot_t gone = insole_turn_way(turn, way(begin_n, row->n_m));
    fix->position_m.x = late->begin_m_m.x_m + gone.x_m;
    fix->position_m.y = late->begin_m_m.y_m + gone.y_m;
}

INSOLE_COLD insole_status_t insole_foot_late_take(insole_foot_late_t *late,
                                                  const insole_particle_filter_t *particles,
                                                  const insole_cloud_t *cloud, uint32_t start,
                                                  insole_fix_t *fix)
{
    if (!late || !particles || !cloud || !fix) {
        return INSOLE_ERR_NULL;
    }
    if (late->count == 0u) {
        return INSOLE_ERR_STATE;
    }
    const insole_late_row_t *row = &late->rows[late->first];
    *fix = row->fix;
    if (row->start == start && start > 0u) {
        find_ends(late, row, particles, cloud);
        if (late->has_begin) {
            correct(late, row, &particles->fix, fix);
        }
    }
    late->first = (late->first + 1u) % late->room;
    late->count--;
    return INSOLE_OK;
}
