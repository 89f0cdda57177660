/* SPDX-License-Identifier: MIT */
#include "insole/fuse/particle_cloud.h"

#include <stddef.h>
#include <string.h>

#define ZERO INSOLE_R(0.0)
#define ONE  INSOLE_R(1.0)

INSOLE_COLD insole_status_t insole_cloud_check(const insole_cloud_t *cloud)
{
    if (!cloud || !cloud->particles || (!cloud->past && cloud->past_strides > 0)) {
        return INSOLE_ERR_NULL;
    }
    return cloud->count > 0 && cloud->count <= INSOLE_CLOUD_PARTICLES_MAX ? INSOLE_OK
                                                                          : INSOLE_ERR_VALUE;
}

/* ---- summing up ---- */

static insole_real_t weight_of(const insole_particle_t *particle, insole_real_t heaviest)
{
    return insole_particle_lives(particle) ? insole_exp(particle->log_weight - heaviest) : ZERO;
}

void insole_cloud_sum_begin(insole_cloud_sum_t *sum, const insole_cloud_t *cloud, uint32_t heaviest)
{
    memset(sum, 0, sizeof *sum);
    sum->reference = cloud->particles[heaviest];
}

static inline void add(insole_cloud_sum_t *sum, const insole_particle_t *particle)
{
    insole_real_t w = weight_of(particle, sum->reference.log_weight);
    insole_real_t x = particle->x_m - sum->reference.x_m, wx = w * x;
    insole_real_t y = particle->y_m - sum->reference.y_m, wy = w * y;
    insole_real_t turn = insole_wrap_near(particle->offset_rad - sum->reference.offset_rad);
    sum->weight += w;
    sum->weight2 += w * w;
    sum->x += wx;
    sum->y += wy;
    sum->xx += wx * x;
    sum->xy += wx * y;
    sum->yy += wy * y;
    sum->offset += w * turn;
    sum->offset2 += w * turn * turn;
    sum->scale += w * (particle->scale - sum->reference.scale);
}

bool insole_cloud_sum_work(insole_cloud_sum_t *sum, const insole_cloud_t *cloud, uint32_t *budget)
{
    insole_cloud_sum_t own = *sum; /* in registers */
    const insole_particle_t *particle = &cloud->particles[own.next];
    own.next = insole_cloud_slice(cloud, own.next, budget);
    for (const insole_particle_t *end = &cloud->particles[own.next]; particle < end; particle++) {
        add(&own, particle);
    }
    *sum = own;
    return own.next < cloud->count;
}

static insole_real_t variance(insole_real_t mean_square, insole_real_t mean)
{
    return insole_max(ZERO, mean_square - mean * mean);
}

INSOLE_COLD insole_status_t insole_cloud_fix(const insole_cloud_sum_t *sum, insole_cloud_fix_t *fix)
{
    if (!sum || !fix) {
        return INSOLE_ERR_NULL;
    }
    if (!(sum->weight > ZERO)) {
        return INSOLE_ERR_STATE;
    }
    insole_real_t normalise = ONE / sum->weight; /* [TwoOrder (9)] */
    insole_real_t x = sum->x * normalise, y = sum->y * normalise, turn = sum->offset * normalise;
    fix->x_m = sum->reference.x_m + x; /* [TwoOrder (7), (42)] */
    fix->y_m = sum->reference.y_m + y;
    fix->var_x_m2 = variance(sum->xx * normalise, x);
    fix->var_y_m2 = variance(sum->yy * normalise, y);
    insole_real_t limit = insole_sqrt(fix->var_x_m2) * insole_sqrt(fix->var_y_m2);
    fix->cov_xy_m2 = insole_max(-limit, insole_min(sum->xy * normalise - x * y, limit));
    fix->offset_rad = insole_wrap_pi(sum->reference.offset_rad + turn);
    fix->var_offset_rad2 = variance(sum->offset2 * normalise, turn);
    fix->scale = sum->reference.scale + sum->scale * normalise;
    fix->effective = sum->weight * sum->weight / sum->weight2;
    return INSOLE_OK;
}

/* ---- resampling ---- */

void insole_cloud_resample_begin(insole_cloud_comb_t *comb, const insole_cloud_sum_t *sum,
                                 uint32_t count, insole_real_t shift)
{
    memset(comb, 0, sizeof *comb);
    comb->counting = true;
    comb->heaviest = sum->reference.log_weight;
    comb->per_tooth = (insole_real_t)count / sum->weight;
    comb->shift = shift;
}

/* Teeth that lie before the weight passed so far: at shift, 1 + shift, 2 + shift, ... */
static inline uint32_t teeth_passed(const insole_cloud_comb_t *comb, uint32_t count)
{
    insole_real_t spacings = comb->passed * comb->per_tooth;
    if (!(spacings < (insole_real_t)count)) {
        return count;
    }
    uint32_t whole = (uint32_t)spacings;
    return spacings - (insole_real_t)whole > comb->shift ? whole + 1u : whole;
}

/* Puts the number of copies in the place of the weight. */
static inline void count_copies(insole_cloud_comb_t *comb, const insole_cloud_t *cloud)
{
    insole_particle_t *particle = &cloud->particles[comb->next];
    insole_real_t weight = weight_of(particle, comb->heaviest);
    comb->passed += weight;
    uint32_t teeth = teeth_passed(comb, cloud->count);
    particle->log_weight = (insole_real_t)(teeth - comb->teeth);
    comb->teeth = teeth;
    if (weight > ZERO) {
        comb->source = comb->next;
    }
    comb->next++;
}

/* A last tooth may lie beyond the sum of the weights by a rounding: it is the last one's. */
static void begin_copying(insole_cloud_comb_t *comb, const insole_cloud_t *cloud)
{
    cloud->particles[comb->source].log_weight += (insole_real_t)(cloud->count - comb->teeth);
    comb->counting = false;
    comb->next = 0;
    comb->source = 0;
}

static insole_spot_t *past_of(const insole_cloud_t *cloud, uint32_t particle)
{
    return &cloud->past[(size_t)particle * cloud->past_strides];
}

static void copy_rows(const insole_cloud_t *cloud, uint32_t to, uint32_t from)
{
    if (cloud->bias) {
        cloud->bias[to] = cloud->bias[from];
    }
    for (uint32_t k = 0; k < cloud->past_strides; k++) {
        past_of(cloud, to)[k] = past_of(cloud, from)[k];
    }
}

/* Gives a copy to a place without one, or looks one place further. Ends with one everywhere, hence
 * with equal weights. */
static inline void copy_one(insole_cloud_comb_t *comb, const insole_cloud_t *cloud)
{
    insole_particle_t *place = &cloud->particles[comb->next];
    insole_particle_t *source = &cloud->particles[comb->source];
    if (place->log_weight > ZERO) {
        comb->next++;
    } else if (source->log_weight <= ONE) {
        comb->source++;
    } else {
        source->log_weight -= ONE;
        *place = *source;
        place->log_weight = ONE;
        copy_rows(cloud, comb->next, comb->source);
    }
}

INSOLE_FLAT bool insole_cloud_resample_work(insole_cloud_comb_t *comb, const insole_cloud_t *cloud,
                                            uint32_t *budget)
{
    insole_cloud_comb_t own = *comb; /* in registers */
    uint32_t left = *budget;
    for (; left > 0 && own.counting; left--) {
        count_copies(&own, cloud);
        if (own.next == cloud->count) {
            begin_copying(&own, cloud);
        }
    }
    for (; left > 0 && own.next < cloud->count; left--) {
        copy_one(&own, cloud);
    }
    *comb = own;
    *budget = left;
    return own.counting || own.next < cloud->count;
}

/* ---- the past ---- */

void insole_cloud_remember(const insole_cloud_t *cloud, uint32_t first, uint32_t end,
                           uint32_t stride)
{
    for (uint32_t i = first; i < end && cloud->past_strides > 0; i++) {
        insole_spot_t *past = &past_of(cloud, i)[stride % cloud->past_strides];
        past->x_m = cloud->particles[i].x_m;
        past->y_m = cloud->particles[i].y_m;
    }
}

static insole_real_t heaviest_of(const insole_cloud_t *cloud)
{
    insole_real_t heaviest = INSOLE_PARTICLE_DEAD;
    for (uint32_t i = 0; i < cloud->count; i++) {
        heaviest = insole_max(heaviest, cloud->particles[i].log_weight);
    }
    return heaviest;
}

INSOLE_COLD insole_status_t insole_cloud_recall(const insole_cloud_t *cloud, uint32_t stride,
                                                insole_spot_t *mean)
{
    insole_status_t status = insole_cloud_check(cloud);
    if (status != INSOLE_OK || !mean) {
        return status != INSOLE_OK ? status : INSOLE_ERR_NULL;
    }
    insole_real_t heaviest = heaviest_of(cloud);
    if (cloud->past_strides == 0 || !(heaviest > INSOLE_PARTICLE_DEAD)) {
        return INSOLE_ERR_STATE;
    }
    const insole_spot_t *past = &cloud->past[stride % cloud->past_strides];
    insole_spot_t origin = past[0];
    insole_real_t weight = ZERO, x = ZERO, y = ZERO;
    for (uint32_t i = 0; i < cloud->count; i++, past += cloud->past_strides) {
        insole_real_t w = weight_of(&cloud->particles[i], heaviest);
        weight += w;
        x += w * (past->x_m - origin.x_m);
        y += w * (past->y_m - origin.y_m);
    }
    mean->x_m = origin.x_m + x / weight;
    mean->y_m = origin.y_m + y / weight;
    return INSOLE_OK;
}
