/* SPDX-License-Identifier: MIT
 * The inertial filter compiled for nine states, under names of its own beside the library's. */
#define INSOLE_ZUPT_STATES             9
#define insole_zupt_ekf_defaults       nine_ekf_defaults
#define insole_zupt_ekf_check          nine_ekf_check
#define insole_zupt_ekf_init           nine_ekf_init
#define insole_zupt_ekf_align          nine_ekf_align
#define insole_zupt_ekf_predict        nine_ekf_predict
#define insole_zupt_ekf_settle         nine_ekf_settle
#define insole_zupt_ekf_correct        nine_ekf_correct
#define insole_zupt_ekf_correct_height nine_ekf_correct_height
#define insole_zupt_ekf_coast          nine_ekf_coast
#define insole_zupt_cov_propagate      nine_cov_propagate
#define insole_zupt_cov_of_velocity    nine_cov_of_velocity
#define insole_zupt_cov_of_height      nine_cov_of_height
#define insole_zupt_cov_correct_height nine_cov_correct_height
#define insole_zupt_cov_forget_motion  nine_cov_forget_motion
#define insole_zupt_cov_forget_place   nine_cov_forget_place
#define insole_zupt_cov_forget_yaw     nine_cov_forget_yaw
#include "../../src/move/zupt_cov.c"
#include "../../src/move/zupt_ekf.c"

#include "nine_walk.h"

void nine_filter_walk(nine_walk_t *walk)
{
    nine_walk_through(walk);
}

nine_facts_t nine_filter_facts(void)
{
    insole_zupt_ekf_config_t config = insole_zupt_ekf_defaults;
    insole_zupt_ekf_t ekf, before;
    nine_facts_t facts = {
        sizeof ekf, sizeof(insole_real_t), config.sigma_accel_bias_mps2, INSOLE_OK, INSOLE_OK,
        false};
    memset(&ekf, 0, sizeof ekf);
    facts.by_default = insole_zupt_ekf_init(&ekf, &config);
    before = ekf;
    config.sigma_accel_bias_mps2 = INSOLE_R(0.01);
    facts.with_a_bias = insole_zupt_ekf_init(&ekf, &config);
    facts.is_unchanged = memcmp(&ekf, &before, sizeof ekf) == 0;
    return facts;
}
