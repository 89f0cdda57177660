/** @file particle_cloud.h  A cloud of weighted particles: walks, is summed up, resampled.
 *
 *  Source  [TwoOrder] 2.3 (7)-(9), 3.2 (42).
 *  Frames  m: map, x east, y north, metres.
 *
 *  The particles are the caller's. Every job may be done in slices: its state is a small struct,
 *  `work` takes so many particles off a budget and tells whether more are left, and the outcome is
 *  the same to the bit however it was sliced. Nothing here needs a second array.
 *
 *      static insole_particle_t particles[500];
 *      insole_cloud_t cloud = {particles, 500, NULL, 0, NULL};
 *      insole_cloud_sum_begin(&sum, &cloud, heaviest);
 *      while (insole_cloud_sum_work(&sum, &cloud, &budget)) budget = 100;
 *      insole_cloud_fix(&sum, &fix);
 *      if (fix.effective < 250) {
 *          insole_cloud_resample_begin(&comb, &sum, insole_rng_uniform(&rng));
 *          while (insole_cloud_resample_work(&comb, &cloud, &budget)) budget = 100;
 *      }
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_FUSE_PARTICLE_CLOUD_H
#define INSOLE_FUSE_PARTICLE_CLOUD_H

#include "insole/base/rng.h"
#include "insole/base/types.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { INSOLE_CLOUD_PARTICLES_MAX = 1000000 };

/** Logarithm of the weight of a particle that is dead. */
#define INSOLE_PARTICLE_DEAD (-INSOLE_REAL_MAX)

typedef struct {
    insole_real_t x_m, y_m;
    insole_real_t offset_rad; /**< from directions in n to directions in m, (-pi, pi] */
    insole_real_t scale;      /**< true length of a stride over its measured one */
    insole_real_t log_weight; /**< up to a number common to all */
} insole_particle_t;

typedef struct {
    insole_particle_t *particles;
    uint32_t count;
    insole_spot_t *past;   /**< `count` x `past_strides`: where each, or its ancestor, was */
    uint32_t past_strides; /**< 0: no past is kept */
    insole_spot_t *bias;   /**< `count`: by which fixes of each err, radio_bias.h; NULL: none */
} insole_cloud_t;

/** The cloud in a few numbers. */
typedef struct {
    insole_real_t x_m, y_m;
    insole_real_t var_x_m2, cov_xy_m2, var_y_m2; /**< never negative definite */
    insole_real_t offset_rad;                    /**< mean on the circle */
    insole_real_t var_offset_rad2;
    insole_real_t scale;
    insole_real_t effective; /**< particles that would tell as much if they weighed alike */
} insole_cloud_fix_t;

/** How a particle walks. */
typedef struct {
    insole_real_t length_m;
    insole_real_t sigma_length_m;
    insole_real_t heading_rad; /**< n */
    insole_real_t sigma_heading_rad;
    insole_real_t sigma_wander_rad; /**< of what stays in the offset */
    insole_real_t scale_memory;     /**< how much of a scale other than 1 stays */
    insole_real_t sigma_scale;      /**< of what is added to it */
    bool is_apart;                  /**< before, the same two by normal numbers of their own */
    insole_real_t apart_wander_rad;
    insole_real_t apart_scale;
} insole_cloud_stride_t;

/** Weighted sums, relative to the heaviest particle. */
typedef struct {
    uint32_t next;
    insole_particle_t reference; /**< the heaviest */
    insole_real_t weight, weight2;
    insole_real_t x, y, xx, xy, yy;
    insole_real_t offset, offset2, scale;
} insole_cloud_sum_t;

/** A comb of as many teeth as particles, evenly spaced over the weights laid end to end. */
typedef struct {
    bool counting;
    uint32_t next;           /**< particle whose teeth are counted, or place to be filled */
    uint32_t source;         /**< last living particle, or particle with a copy to give */
    uint32_t teeth;          /**< passed so far */
    insole_real_t heaviest;  /**< largest logarithm of a weight */
    insole_real_t per_tooth; /**< teeth per weight */
    insole_real_t shift;     /**< of the first tooth, in spacings, [0, 1) */
    insole_real_t passed;    /**< weight so far */
} insole_cloud_comb_t;

static inline bool insole_particle_lives(const insole_particle_t *particle)
{
    return particle->log_weight > INSOLE_PARTICLE_DEAD;
}

/** @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE for no particles or more than a million */
insole_status_t insole_cloud_check(const insole_cloud_t *cloud);

/** Takes as many particles off the budget as it allows and are left from number `first` on.
 *  @return number of the first that is not among them */
static inline uint32_t insole_cloud_slice(const insole_cloud_t *cloud, uint32_t first,
                                          uint32_t *budget)
{
    uint32_t left = first < cloud->count ? cloud->count - first : 0;
    uint32_t taken = left < *budget ? left : *budget;
    *budget -= taken;
    return first + taken;
}

/** The direction of a particle's stride with this heading in n. */
static inline insole_turn_t insole_cloud_direction(const insole_particle_t *particle,
                                                   insole_real_t heading_rad)
{
    return insole_turn(heading_rad + particle->offset_rad);
}

/** Changes offset and scale of one particle apart from how its stride scatters. */
static inline void insole_cloud_wander(insole_particle_t *particle,
                                       const insole_cloud_stride_t *stride, insole_rng_t *rng)
{
    insole_normals_t off = insole_rng_normals(rng);
    particle->offset_rad =
        insole_wrap_near(particle->offset_rad + stride->apart_wander_rad * off.first);
    particle->scale += stride->apart_scale * off.second;
}

/** Moves one particle by a stride, (32). Two normal numbers are drawn, one along and one across:
 *  that of the length goes into the scale too, that of the heading into the offset. */
static inline void insole_cloud_walk(insole_particle_t *particle,
                                     const insole_cloud_stride_t *stride, insole_rng_t *rng)
{
    insole_real_t one = INSOLE_R(1.0);
    if (stride->is_apart) {
        insole_cloud_wander(particle, stride, rng);
    }
    insole_normals_t off = insole_rng_normals(rng);
    insole_real_t along = off.first, across = off.second;
    particle->offset_rad =
        insole_wrap_near(particle->offset_rad + stride->sigma_wander_rad * across);
    insole_turn_t direction =
        insole_cloud_direction(particle, stride->heading_rad + stride->sigma_heading_rad * across);
    insole_real_t length_m = stride->length_m * particle->scale + stride->sigma_length_m * along;
    particle->x_m += length_m * direction.cos; /* [TwoOrder (32)] */
    particle->y_m += length_m * direction.sin;
    particle->scale =
        one + stride->scale_memory * (particle->scale - one) + stride->sigma_scale * along;
}

/** @param heaviest  number of the heaviest particle */
void insole_cloud_sum_begin(insole_cloud_sum_t *sum, const insole_cloud_t *cloud,
                            uint32_t heaviest);

/** @return true while more is left */
bool insole_cloud_sum_work(insole_cloud_sum_t *sum, const insole_cloud_t *cloud, uint32_t *budget);

/** @return INSOLE_ERR_STATE when no particle lives */
insole_status_t insole_cloud_fix(const insole_cloud_sum_t *sum, insole_cloud_fix_t *fix);

/** Systematic resampling: a particle gets as many copies as teeth of the comb fall on it, so that
 *  their expectation is its share of the weight. The dead are overwritten by copies of the living,
 *  nothing else moves, and all weigh the same afterwards.
 *  @param sum    of the whole cloud
 *  @param shift  uniform in [0, 1) */
void insole_cloud_resample_begin(insole_cloud_comb_t *comb, const insole_cloud_sum_t *sum,
                                 uint32_t count, insole_real_t shift);

/** @return true while more is left */
bool insole_cloud_resample_work(insole_cloud_comb_t *comb, const insole_cloud_t *cloud,
                                uint32_t *budget);

/** Keeps where particles from number `first` on, up to `end`, are now as their past in stride
 * number `stride`. */
void insole_cloud_remember(const insole_cloud_t *cloud, uint32_t first, uint32_t end,
                           uint32_t stride);

/** Where the ancestors of the present cloud were in stride number `stride`, by all known now.
 *  @return INSOLE_ERR_STATE when no past is kept, or no particle lives */
insole_status_t insole_cloud_recall(const insole_cloud_t *cloud, uint32_t stride,
                                    insole_spot_t *mean);

#ifdef __cplusplus
}
#endif

#endif
