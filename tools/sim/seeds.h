/** @file seeds.h  One seed, a stream of its own for everything that is random.
 *
 *  Switching one source of randomness on or off leaves the others as they are.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_SIM_SEEDS_H
#define INSOLE_SIM_SEEDS_H

#include "insole/base/rng.h"

typedef enum {
    SIM_SEED_STEPS = 1,
    SIM_SEED_GAIT,
    SIM_SEED_IMU_UNIT,
    SIM_SEED_IMU_NOISE,
    SIM_SEED_IMU_DRIFT,
    SIM_SEED_IMU_STAMPS,
    SIM_SEED_LOG,
    SIM_SEED_ERRANDS,
    SIM_SEED_RADIO_APS,
    SIM_SEED_RADIO_WALLS,
    SIM_SEED_RADIO_SHADOW,
    SIM_SEED_RADIO_RECEIVER,
    SIM_SEED_RADIO_SCANS,
    SIM_SEED_RADIO_NOISE,
    SIM_SEED_PERSON,
    SIM_SEED_TORSO,
    SIM_SEED_HOLD,
    SIM_SEED_FIDGETS,
    SIM_SEED_CHANGES,
    SIM_SEED_STEEL,
    SIM_SEED_MAGNET_UNIT,
    SIM_SEED_MAGNET_NOISE,
    SIM_SEED_RADIO_CROWD
} sim_seed_stream_t;

static inline void sim_seed(insole_rng_t *rng, uint64_t seed, sim_seed_stream_t stream)
{
    insole_rng_seed(rng, seed ^ ((uint64_t)stream << 56));
}

#endif
