/* SPDX-License-Identifier: MIT */
#include "insole/fuse/cloud_source.h"

#include <stddef.h>

#define ZERO INSOLE_R(0.0)
#define HALF INSOLE_R(0.5)
#define ONE  INSOLE_R(1.0)

/* Beyond, wide is wide; infinity may be among it. */
#define WIDE_MAX INSOLE_R(1e6)

/* Of a plan's rectangle little may be walkable. */
enum { ATTEMPTS = 8, ATTEMPTS_EVEN = 100 };

INSOLE_COLD insole_cloud_source_t insole_cloud_source(const insole_cloud_fix_t *fix,
                                                      insole_real_t sigma_scale)
{
    insole_cloud_source_t source = {.x_m = fix->x_m,
                                    .y_m = fix->y_m,
                                    .var_x_m2 = fix->var_x_m2,
                                    .cov_xy_m2 = fix->cov_xy_m2,
                                    .var_y_m2 = fix->var_y_m2,
                                    .offset_rad = fix->offset_rad,
                                    .sigma_offset_rad = insole_sqrt(fix->var_offset_rad2),
                                    .scale = fix->scale,
                                    .sigma_scale = sigma_scale};
    return source;
}

/* Variance of what lies evenly on a length. */
static insole_real_t even_m2(insole_real_t length_m)
{
    return insole_square(length_m) / INSOLE_R(12.0);
}

INSOLE_COLD insole_cloud_source_t insole_cloud_source_everywhere(const insole_floor_plan_t *plan,
                                                                 insole_real_t sigma_scale)
{
    insole_real_t width_m = plan->cell_m * (insole_real_t)plan->columns;
    insole_real_t height_m = plan->cell_m * (insole_real_t)plan->rows;
    insole_cloud_source_t source = {.x_m = plan->origin_x_m + HALF * width_m,
                                    .y_m = plan->origin_y_m + HALF * height_m,
                                    .var_x_m2 = even_m2(width_m),
                                    .var_y_m2 = even_m2(height_m),
                                    .sigma_offset_rad = INSOLE_PI,
                                    .scale = ONE,
                                    .sigma_scale = sigma_scale,
                                    .even = ONE};
    return source;
}

INSOLE_COLD void insole_cloud_source_put(insole_cloud_source_t *source, insole_spot_t spot,
                                         insole_sym2_t cov_m2)
{
    source->x_m = spot.x_m;
    source->y_m = spot.y_m;
    source->var_x_m2 = cov_m2.xx;
    source->cov_xy_m2 = cov_m2.xy;
    source->var_y_m2 = cov_m2.yy;
}

INSOLE_COLD insole_turn_t insole_cloud_source_turn(const insole_cloud_source_t *source)
{
    insole_real_t length =
        source->scale * insole_exp(-HALF * insole_square(source->sigma_offset_rad));
    insole_turn_t turn = insole_turn(source->offset_rad);
    turn.cos *= length;
    turn.sin *= length;
    return turn;
}

INSOLE_COLD void insole_cloud_source_walk(insole_cloud_source_t *source,
                                          const insole_cloud_stride_t *stride)
{
    insole_turn_t direction = insole_turn(stride->heading_rad);
    insole_spot_t way = {stride->length_m * direction.cos, stride->length_m * direction.sin};
    way = insole_turn_way(insole_cloud_source_turn(source), way);
    insole_real_t var_rad2 =
        insole_square(source->sigma_offset_rad) + insole_square(stride->sigma_heading_rad) +
        insole_square(stride->sigma_wander_rad) + insole_square(stride->apart_wander_rad);
    insole_real_t var_m2 = insole_square(stride->sigma_length_m) +
                           insole_square(stride->length_m) * insole_min(var_rad2, ONE);
    source->x_m += way.x_m;
    source->y_m += way.y_m;
    source->var_x_m2 += var_m2;
    source->var_y_m2 += var_m2;
}

INSOLE_COLD void insole_cloud_source_widen(insole_cloud_source_t *source, insole_real_t sigma_m,
                                           insole_real_t sigma_rad)
{
    source->var_x_m2 += insole_square(sigma_m);
    source->var_y_m2 += insole_square(sigma_m);
    source->sigma_offset_rad =
        insole_sqrt(insole_square(source->sigma_offset_rad) + insole_square(sigma_rad));
}

static insole_real_t mixed(insole_real_t own, insole_real_t other, insole_real_t share)
{
    return own + share * (other - own);
}

INSOLE_COLD insole_real_t insole_cloud_source_width(const insole_cloud_source_t *source,
                                                    insole_real_t sigma_m, insole_real_t sigma_rad)
{
    insole_real_t wide = HALF * (source->var_x_m2 + source->var_y_m2) / insole_square(sigma_m) +
                         insole_square(source->sigma_offset_rad / sigma_rad);
    return wide < WIDE_MAX ? wide / (ONE + wide) : ONE;
}

INSOLE_COLD void insole_cloud_source_mix(insole_cloud_source_t *source,
                                         const insole_cloud_source_t *other, insole_real_t share)
{
    insole_real_t x = other->x_m - source->x_m, y = other->y_m - source->y_m;
    insole_real_t between = share * (ONE - share);
    source->x_m += share * x;
    source->y_m += share * y;
    source->var_x_m2 = mixed(source->var_x_m2, other->var_x_m2, share) + between * x * x;
    source->cov_xy_m2 = mixed(source->cov_xy_m2, other->cov_xy_m2, share) + between * x * y;
    source->var_y_m2 = mixed(source->var_y_m2, other->var_y_m2, share) + between * y * y;
}

/* One point of the rectangle. */
static void draw_even(const insole_cloud_source_t *source, insole_particle_t *particle,
                      insole_rng_t *rng)
{
    insole_real_t side = insole_sqrt(INSOLE_R(12.0));
    particle->x_m =
        source->x_m + side * insole_sqrt(source->var_x_m2) * (insole_rng_uniform(rng) - HALF);
    particle->y_m =
        source->y_m + side * insole_sqrt(source->var_y_m2) * (insole_rng_uniform(rng) - HALF);
}

/* One normal point with the covariance of the source, by its triangular root. */
static void draw_normal(const insole_cloud_source_t *source, insole_particle_t *particle,
                        insole_rng_t *rng)
{
    insole_normals_t off = insole_rng_normals(rng);
    insole_real_t root_x = insole_sqrt(source->var_x_m2);
    insole_real_t root_xy = root_x > ZERO ? source->cov_xy_m2 / root_x : ZERO;
    insole_real_t root_y = insole_sqrt(insole_max(ZERO, source->var_y_m2 - root_xy * root_xy));
    particle->x_m = source->x_m + root_x * off.first;
    particle->y_m = source->y_m + root_xy * off.first + root_y * off.second;
}

static void draw_place(const insole_cloud_source_t *source, insole_particle_t *particle,
                       insole_rng_t *rng)
{
    if (source->even > ZERO) {
        draw_even(source, particle, rng);
    } else {
        draw_normal(source, particle, rng);
    }
}

static void draw_walk(const insole_cloud_source_t *source, insole_particle_t *particle,
                      insole_rng_t *rng)
{
    insole_normals_t off = insole_rng_normals(rng);
    particle->scale = source->scale + source->sigma_scale * off.second;
    particle->offset_rad =
        insole_wrap_pi(source->offset_rad + source->sigma_offset_rad * off.first);
    if (source->sigma_offset_rad >= INSOLE_PI) {
        particle->offset_rad = INSOLE_PI * (ONE - INSOLE_R(2.0) * insole_rng_uniform(rng));
    }
}

INSOLE_COLD void insole_cloud_source_draw(const insole_cloud_source_t *source,
                                          insole_particle_t *particle,
                                          const insole_floor_plan_t *plan, insole_rng_t *rng)
{
    draw_walk(source, particle, rng);
    particle->log_weight = INSOLE_PARTICLE_DEAD;
    int attempts = source->even > ZERO ? ATTEMPTS_EVEN : ATTEMPTS;
    for (int i = 0; i < attempts && !insole_particle_lives(particle); i++) {
        draw_place(source, particle, rng);
        if (!plan || insole_floor_plan_inside(plan, particle->x_m, particle->y_m)) {
            particle->log_weight = ZERO;
        }
    }
}

INSOLE_COLD insole_cloud_aside_t insole_cloud_source_aside(const insole_cloud_source_t *source,
                                                           insole_real_t share)
{
    insole_real_t widest = insole_sqrt(INSOLE_R(3.0)) * share; /* of what is even, in sigmas */
    insole_cloud_aside_t aside = {widest * insole_sqrt(source->var_x_m2),
                                  widest * insole_sqrt(source->var_y_m2),
                                  widest * source->sigma_offset_rad};
    return aside;
}

/* Evenly to either side: the middle of one of 1024 parts. */
static insole_real_t even_within(insole_real_t most, uint32_t bits)
{
    insole_real_t part = (insole_real_t)(bits & 1023u) + HALF;
    return most * (part * INSOLE_R(0.001953125) - ONE);
}

void insole_cloud_source_spread(const insole_cloud_aside_t *aside, insole_particle_t *particle,
                                const insole_floor_plan_t *plan, insole_rng_t *rng)
{
    uint32_t bits = insole_rng_bits(rng);
    insole_real_t x = particle->x_m + even_within(aside->x_m, bits >> 22);
    insole_real_t y = particle->y_m + even_within(aside->y_m, bits >> 12);
    if (!plan || !insole_floor_plan_crosses(plan, particle->x_m, particle->y_m, x, y)) {
        particle->x_m = x;
        particle->y_m = y;
    }
    particle->offset_rad =
        insole_wrap_near(particle->offset_rad + even_within(aside->offset_rad, bits >> 2));
}
