/** @file screen.h  Repairs and counts bad samples before anything else sees them.
 *
 *  Handled: stamps that repeat or go back, a single wild stamp (two in a row are believed), fields
 *  that are not a number,
 *  values no foot can produce, single-sample spikes, gyros at the end of their range, gaps, stamps
 *  that tell when a burst was read and not when it was sampled, and rates above `max_rate_hz`
 *  (averaged down: a mean keeps what a pick would lose).
 *
 *  Frames  b: sensor, any mounting. One sample is held back, so that a spike shows.
 *
 *      static insole_screen_t screen;
 *      insole_screen_init(&screen, &insole_screen_defaults);
 *      on each sample:
 *          if (insole_screen_push(&screen, &raw, &clean) == INSOLE_OK) use(&clean);
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_SENSE_SCREEN_H
#define INSOLE_SENSE_SCREEN_H

#include "insole/base/config.h"
#include "insole/base/types.h"
#include "insole/sense/even_clock.h"
#include "insole/sense/gyro_clip.h"

#ifdef __cplusplus
extern "C" {
#endif

/* clang-format off */
#define INSOLE_SCREEN_KEYS(KEY)                                                                   \
    KEY(REAL, max_rate_hz, 250.0, 40.0, 256.0, "Hz", "faster samples are averaged down to it")    \
    KEY(REAL, gap_s, 0.1, 0.02, 1.0, "s", "a longer interval is a gap")                           \
    KEY(REAL, burst_share, 0.05, 0.0, 1.0, "",                                                    \
        "stamps are evened out once this share of them comes in bursts; 1 = never")               \
    KEY(REAL, hold_s, 0.03, 0.0, 1.0, "s",                                                        \
        "a field that is not a number is held this long; then the sample is dropped")             \
    KEY(REAL, spike_accel_mps2, 150.0, 1.0, 1.0e6, "m/s^2",                                       \
        "a single sample this far from both neighbours is a spike; 1e6 = off")                    \
    KEY(REAL, spike_gyro_radps, 8.0, 0.1, 1.0e6, "rad/s", "the same for the gyro; 1e6 = off")     \
    KEY(REAL, gyro_range_radps, 0.0, 0.0, 100.0, "rad/s",                                         \
        "end of the gyro's range where it is known; 0 = recognised as it clips")                  \
    KEY(REAL, clip_share, 0.88, 0.5, 1.0, "",                                                     \
        "share of its range from which a gyro axis counts as clipped: many bend before they end")
/* clang-format on */

typedef struct {
    INSOLE_SCREEN_KEYS(INSOLE_CONFIG_MEMBER)
} insole_screen_config_t;

extern const insole_screen_config_t insole_screen_defaults;

/** @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE for a setting out of its range */
insole_status_t insole_screen_check(const insole_screen_config_t *config);

/** What happened so far. */
typedef struct {
    uint32_t samples;    /**< came in */
    uint32_t repeated;   /**< same stamp as before: dropped */
    uint32_t backward;   /**< stamp before the last one: dropped */
    uint32_t wild;       /**< single stamp far ahead, or beyond 2^63: dropped */
    uint32_t not_finite; /**< a field not a number or beyond all reason: held or dropped */
    uint32_t spikes;     /**< single-sample spikes replaced by the mean of their neighbours */
    uint32_t clipped;    /**< samples with a gyro axis at the end of its range */
    uint32_t gaps;       /**< intervals longer than gap_s */
    uint32_t evened;     /**< stamps of bursts put where the samples were taken */
    uint32_t averaged;   /**< joined with their neighbours to keep the rate down */
} insole_screen_counts_t;

/** Bits of insole_clean_t.marks. */
enum {
    INSOLE_MARK_CLIP = 7, /**< gyro at the end of its range: a bit per axis, x the lowest */
    INSOLE_MARK_GAP = 8   /**< nothing is known of the time since the sample before */
};

/** A sample that may be used. */
typedef struct {
    insole_imu_t imu;
    uint8_t marks;
} insole_clean_t;

/** What the sample that waits looked like. */
typedef enum {
    INSOLE_SCREEN_LIVELY = 0,
    INSOLE_SCREEN_CALM = 1, /**< too short to be a spike or clipped, and soon after another */
    INSOLE_SCREEN_HELD = 2, /**< a field was bad and holds the value before */
    INSOLE_SCREEN_OUT = 3   /**< has gone out before; its successor was wild */
} insole_screen_look_t;

/** A sample as it came, repaired. */
typedef struct {
    insole_clean_t clean; /**< with its raw stamp */
    int32_t lead_us;      /**< of the stamp that it goes out with over the raw one */
    uint32_t since_us;    /**< time between that stamp and the one before; much: the first */
} insole_screen_slot_t;

typedef struct {
    insole_screen_config_t config;
    insole_screen_counts_t counts;
    uint32_t gap_us, hold_us, least_us;    /**< settings; the shortest interval that goes out */
    insole_real_t calm_accel2, calm_gyro2; /**< squares of the lengths below which all is calm */
    insole_even_clock_t clock;
    insole_screen_slot_t slots[2]; /**< the sample that waits for its successor, the one before */
    uint32_t newest;               /**< slot of the former */
    uint32_t held;                 /**< of these two, how many there are */
    insole_screen_look_t look;     /**< of the former */
    bool flowing;                  /**< one waits, and since it came none was dropped */
    uint32_t back_run;             /**< samples dropped in a row, their stamps going back */
    uint64_t good_us;              /**< raw stamp of the last sample before fields were held */
    insole_gyro_clip_t clip;
    insole_vec3_t sum_accel, sum_gyro; /**< of the samples being averaged, weighted by time */
    insole_real_t sum_s;
    uint8_t sum_marks;
    uint32_t sum_count;
    uint64_t out_us; /**< stamp of the clean sample before them */
    bool finished;
} insole_screen_t;

/** @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE for a setting out of its range */
insole_status_t insole_screen_init(insole_screen_t *screen, const insole_screen_config_t *config);

/** Takes a sample, whatever it holds. @param[out] clean  written only with INSOLE_OK
 *  @return INSOLE_OK: a clean sample is out; INSOLE_ERR_STATE: none this time */
insole_status_t insole_screen_push(insole_screen_t *screen, const insole_imu_t *raw,
                                   insole_clean_t *clean);

/** As insole_screen_take, for what is not NULL. */
const insole_clean_t *insole_screen_pass(insole_screen_t *screen, const insole_imu_t *raw,
                                         insole_clean_t *room);

/** The same, but the sample need not be copied. @param[out] room  for one that has to be made
 *  @return the clean sample, in `room` or until the next call in the screen; NULL: none this time,
 *          or an argument was NULL */
static inline const insole_clean_t *
insole_screen_take(insole_screen_t *screen, const insole_imu_t *raw, insole_clean_t *room)
{
    return screen && raw && room ? insole_screen_pass(screen, raw, room) : 0;
}

/** The sample that was held back, and what waits to be averaged; call until it answers
 *  INSOLE_ERR_STATE. Samples that are pushed later are ignored. */
insole_status_t insole_screen_finish(insole_screen_t *screen, insole_clean_t *clean);

#ifdef __cplusplus
}
#endif

#endif
