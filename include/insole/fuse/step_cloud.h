/** @file step_cloud.h  Steps of a phone, fixes and walls made one position: a cloud of particles.
 *
 *  Source  ours; [PhoneEKF] 4.1, [WifiShift] I and IV: the particle filters that they are compared
 *          with.
 *  Frames  n: level, the frame of the paces' headings.  m: map; heading in m = heading in n +
 *          offset, which is a part of what is estimated.
 *
 *  The particle filter of particle_filter.h, to be told what step_fusion.h is told. With the
 *  settings `insole_step_cloud_defaults` the direction and the scale of steps are unknown, fixes
 * err together for a while, and a plan may lack doors. With `insole_step_cloud_plain` it is a rival
 * of the paper: told fixes the improved one, told scans held against the map (rss_weigh.h) the
 * other.
 *
 *      static insole_particle_t particles[500];
 *      static insole_spot_t bias[500];
 *      static insole_step_cloud_t cloud;
 *      const insole_cloud_t memory = {particles, 500, NULL, 0, bias};
 *      insole_step_cloud_init(&cloud, &insole_step_cloud_defaults, &memory, &plan, seed);
 *      insole_step_cloud_start(&cloud, &start);
 *      on each step:  insole_step_cloud_step(&cloud, &pace);
 *      on each fix:   insole_step_cloud_fix(&cloud, &fix);
 *      in between:    insole_step_cloud_work(&cloud, 50);
 *      if (insole_step_cloud_answer(&cloud, &answer) == INSOLE_OK) use(&answer);
 *
 *  `insole_step_cloud_wpf`: [WifiShift]'s reference 16, to be told the likeliest fingerprint and a
 *  true start. Weights are multiplied by exp(-d^2 / (2 sigma^2)) of the distance d to that fix, and
 *  a wall that is crossed makes them 0. The text calls sigma "the variance of RSSs", which is no
 *  length: here it is one length for all fixes. It leaves open how directions differ: here each
 *  particle keeps one of its own, which wanders by 0.02 rad a step, beside what each step has (with
 *  `sigma_wander_rad` 0 nothing but the start's lasts, and errors are twice as large); and when
 *  there is a resampling: here below half the effective number. The text's estimate, "according to
 *  all weights", is their mean.
 *
 *  `insole_step_cloud_zee`: its reference 18. Particles have a place, an offset and a scale, spread
 *  over the walkable plan or about the first fix ("used to constrain the initial location"); from
 *  then on only walls weigh, and a compass where there is one. The text leaves open the spread of
 *  scales (0.1 here), what wanders, and what follows when all have died: drawn anew about the last
 *  answer. It has no look back from a later time; so has none here.
 *
 *  What is told waits in a queue until it is worked in. When the queue is full the call that tells
 *  more works the oldest in first: nothing is lost, and the result is the same to the bit however
 *  the work was sliced.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_FUSE_STEP_CLOUD_H
#define INSOLE_FUSE_STEP_CLOUD_H

#include "insole/base/ring.h"
#include "insole/fuse/particle_filter.h"
#include "insole/fuse/step_filter.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { INSOLE_STEP_CLOUD_WAITING = 8 /**< news that wait; a power of two */ };
enum { INSOLE_STEP_CLOUD_TOLD = 0, INSOLE_STEP_CLOUD_CONSTANT = 1 };

/* clang-format off */
#define INSOLE_STEP_CLOUD_KEYS(KEY)                                                               \
    KEY(CHOICE, process, 1, 0, 1, "told|constant",                                                \
        "variances of length and heading of a pace count beside the particles' settings, or not") \
    KEY(CHOICE, measurement, 0, 0, 1, "told|constant", "covariance of a fix")                     \
    KEY(REAL, sigma_fix_m, 4.0, 0.001, 1000.0, "m",                                               \
        "1-sigma of each coordinate of a fix, when constant")
/* clang-format on */

typedef struct {
    INSOLE_STEP_CLOUD_KEYS(INSOLE_CONFIG_MEMBER)
    insole_particle_filter_config_t particles;
} insole_step_cloud_config_t;

extern const insole_step_cloud_config_t insole_step_cloud_defaults;
extern const insole_step_cloud_config_t insole_step_cloud_plain;
extern const insole_step_cloud_config_t insole_step_cloud_wpf;
extern const insole_step_cloud_config_t insole_step_cloud_zee;

/** What is known at the start. */
typedef struct {
    uint64_t t_us;
    insole_spot_t spot;            /**< m */
    insole_sym2_t cov_m2;          /**< m */
    insole_real_t offset_rad;      /**< heading in m less heading in n; -1000 .. 1000 */
    insole_real_t var_offset_rad2; /**< >= 0; pi^2 and more: not known */
    bool is_radio;                 /**< the spot is a fix by fingerprints */
} insole_step_origin_t;

typedef enum {
    INSOLE_STEP_CLOUD_PACE = 0,
    INSOLE_STEP_CLOUD_FIX,
    INSOLE_STEP_CLOUD_COMPASS
} insole_step_cloud_kind_t;

/** One of the news that wait. */
typedef struct {
    insole_step_cloud_kind_t kind;
    insole_pace_t pace;
    insole_spot_fix_t fix;
    insole_real_t offset_rad, sigma_rad;
} insole_step_cloud_news_t;

typedef struct {
    insole_spot_t spot;       /**< m */
    insole_sym2_t cov_m2;     /**< m */
    insole_real_t offset_rad; /**< from n to m */
    insole_real_t var_offset_rad2;
    insole_real_t scale; /**< true length of a step over its told one */
    uint32_t waiting;    /**< news not worked in yet */
} insole_step_cloud_answer_t;

typedef struct {
    int32_t process, measurement;
    insole_real_t sigma_fix_m;
    insole_cloud_t cloud;       /**< the caller's */
    insole_building_t building; /**< the plan alone */
    insole_particle_filter_t filter;
    bool has_fix;
    uint64_t fix_us; /**< of the newest fix that was taken */
    insole_ring_t ring;
    insole_step_cloud_news_t waiting[INSOLE_STEP_CLOUD_WAITING];
    uint32_t refused;
} insole_step_cloud_t;

/** @param memory  the caller's; its particles and biases stay where they are
 *  @param plan    the caller's; NULL: no walls
 *  @return INSOLE_ERR_NULL, also without biases where the settings have one; INSOLE_ERR_VALUE for a
 *          setting out of its range, or as insole_cloud_check() */
insole_status_t insole_step_cloud_init(insole_step_cloud_t *cloud,
                                       const insole_step_cloud_config_t *config,
                                       const insole_cloud_t *memory,
                                       const insole_floor_plan_t *plan, uint64_t seed);

/** The position is known; also later, as a start anew: what waits is dropped.
 *  @return INSOLE_ERR_NULL; INSOLE_ERR_VALUE as insole_spot_fix_check(), for an offset out of range
 *          or a variance below 0 */
insole_status_t insole_step_cloud_start(insole_step_cloud_t *cloud,
                                        const insole_step_origin_t *origin);

/** Nothing is known: the cloud is drawn evenly over all of the plan where one can walk, in all
 *  directions. What waits is dropped.
 *  @return INSOLE_ERR_NULL; INSOLE_ERR_STATE without a plan */
insole_status_t insole_step_cloud_start_anywhere(insole_step_cloud_t *cloud);

/** @return INSOLE_ERR_NULL; INSOLE_ERR_STATE before the start; INSOLE_ERR_VALUE as
 *          insole_pace_check() */
insole_status_t insole_step_cloud_step(insole_step_cloud_t *cloud, const insole_pace_t *pace);

/** @return INSOLE_ERR_NULL; INSOLE_ERR_STATE before the start; INSOLE_ERR_TIME for a fix that is
 *          not newer than the one before; INSOLE_ERR_VALUE as insole_spot_fix_check() */
insole_status_t insole_step_cloud_fix(insole_step_cloud_t *cloud, const insole_spot_fix_t *fix);

/** 1-sigma of what the fixes from now on share, those that wait among them; the setting is the
 * most.
 *  @return INSOLE_ERR_NULL; INSOLE_ERR_VALUE for one that is negative or not finite */
insole_status_t insole_step_cloud_bias(insole_step_cloud_t *cloud, insole_real_t sigma_m);

/** The offset as a compass sees it, insole_evidence_compass().
 *  @return INSOLE_ERR_NULL; INSOLE_ERR_STATE before the start; INSOLE_ERR_VALUE */
insole_status_t insole_step_cloud_compass(insole_step_cloud_t *cloud, insole_real_t offset_rad,
                                          insole_real_t sigma_rad);

/** A scan held against the map, insole_evidence_rss(): the paper's first rival. All that waits is
 *  worked in, and so is this, before the call ends.
 *  @return as insole_evidence_rss(); INSOLE_ERR_STATE also before the start */
insole_status_t insole_step_cloud_rss(insole_step_cloud_t *cloud, const insole_rss_weigh_t *rss,
                                      insole_spot_t since);

/** Does at most `particles` particles' worth of work.
 *  @return true while work is left */
bool insole_step_cloud_work(insole_step_cloud_t *cloud, uint32_t particles);

/** Where the walker is, by all that is worked in.
 *  @return INSOLE_ERR_NULL; INSOLE_ERR_STATE before the cloud is drawn */
insole_status_t insole_step_cloud_answer(const insole_step_cloud_t *cloud,
                                         insole_step_cloud_answer_t *answer);

/** For a tracker; the state is an `insole_step_cloud_t`. */
extern const insole_step_filter_calls_t insole_step_cloud_calls;

/** The same for one that needs no start and passes fixes over: walls do the work. */
extern const insole_step_filter_calls_t insole_step_cloud_zee_calls;

#ifdef __cplusplus
}
#endif

#endif
