/* SPDX-License-Identifier: MIT
 * Any stream of samples, starts and gaps: what comes out is finite, in order, and in range. */
#include "fuzz.h"

#include "insole/track/foot_tracker.h"

static insole_foot_tracker_t shoe;
static uint64_t now_us, last_fix_us;

static insole_vec3_t measured(fuzz_input_t *input, float full_scale)
{
    float unit = full_scale / 32768.0f;
    float x = (float)fuzz_short(input) * unit;
    float y = (float)fuzz_short(input) * unit;
    return insole_vec3((insole_real_t)x, (insole_real_t)y,
                       (insole_real_t)((float)fuzz_short(input) * unit));
}

static insole_vec3_t any_bits(fuzz_input_t *input)
{
    insole_real_t x = (insole_real_t)fuzz_float(input);
    insole_real_t y = (insole_real_t)fuzz_float(input);
    return insole_vec3(x, y, (insole_real_t)fuzz_float(input));
}

static void check_fix(const insole_fix_t *fix)
{
    fuzz_claim(insole_vec3_is_finite(fix->position_m), "the position is finite");
    fuzz_claim(insole_abs(fix->heading_rad) <= INSOLE_R(3.1415928), "the heading is in range");
    fuzz_claim(fix->var_x_m2 >= INSOLE_R(0.0) && insole_is_finite(fix->var_x_m2), "var_x");
    fuzz_claim(fix->var_y_m2 >= INSOLE_R(0.0) && insole_is_finite(fix->var_y_m2), "var_y");
    fuzz_claim(fix->var_z_m2 >= INSOLE_R(0.0) && insole_is_finite(fix->var_z_m2), "var_z");
    fuzz_claim(insole_is_finite(fix->cov_xy_m2), "cov_xy is finite");
    fuzz_claim(fix->var_heading_rad2 >= INSOLE_R(0.0) && insole_is_finite(fix->var_heading_rad2),
               "var_heading");
    fuzz_claim(fix->t_us >= last_fix_us, "fixes come in the order of time");
    last_fix_us = fix->t_us;
}

static void drain(void)
{
    insole_fix_t fix;
    insole_stride_t stride;
    while (insole_foot_tracker_next(&shoe, &fix) == INSOLE_OK) {
        check_fix(&fix);
    }
    if (insole_foot_tracker_stride(&shoe, &stride) == INSOLE_OK) {
        fuzz_claim(insole_vec3_is_finite(stride.displacement_m), "the stride is finite");
        fuzz_claim(stride.end_us >= stride.begin_us, "a stride ends after it begins");
    }
}

static void push(insole_vec3_t accel, insole_vec3_t gyro)
{
    insole_imu_t imu = {now_us, accel, gyro};
    insole_foot_tracker_imu(&shoe, &imu);
    drain();
}

/* The same reading for a while: rests and stances, which random samples would never make. */
static void hold(fuzz_input_t *input)
{
    insole_vec3_t accel = measured(input, 160.0f), gyro = measured(input, 0.1f);
    for (unsigned count = fuzz_byte(input); count > 0; count--) {
        now_us += 5000u;
        push(accel, gyro);
    }
}

static void start(fuzz_input_t *input)
{
    insole_vec3_t place = any_bits(input), sigma = any_bits(input);
    insole_start_t told = {now_us,  place.x, place.y, (fuzz_byte(input) & 1u) != 0u,
                           place.z, sigma.x, sigma.y};
    insole_foot_tracker_start(&shoe, &told);
}

static void act(fuzz_input_t *input)
{
    uint8_t what = fuzz_byte(input);
    uint32_t step_us = 5000u;
    if (what < 160u) {
        insole_vec3_t accel = measured(input, 160.0f);
        now_us += step_us;
        push(accel, measured(input, 35.0f));
    } else if (what < 200u) {
        hold(input);
    } else if (what < 220u) {
        insole_vec3_t accel = any_bits(input);
        now_us += step_us;
        push(accel, any_bits(input));
    } else if (what < 240u) {
        fuzz_take(input, &step_us, sizeof step_us);
        now_us = (what & 1u) != 0u ? now_us + step_us : now_us - step_us;
    } else {
        start(input);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_input_t input = {data, size};
    insole_foot_tracker_config_t config = insole_foot_tracker_defaults;
    uint8_t choice = fuzz_byte(&input);
    config.method = choice & 1u;
    config.zero_velocity.detector = (choice >> 1) % 6u;
    config.zupt_ekf.sigma_accel_bias_mps2 = (choice & 64u) != 0u ? INSOLE_R(0.05) : INSOLE_R(0.0);
    now_us = (choice & 128u) != 0u ? 0u : 1000000000000u;
    last_fix_us = 0u;
    fuzz_claim(insole_foot_tracker_init(&shoe, &config) == INSOLE_OK, "the settings are in range");
    while (input.left > 0) {
        act(&input);
    }
    insole_foot_tracker_finish(&shoe);
    drain();
    return 0;
}
