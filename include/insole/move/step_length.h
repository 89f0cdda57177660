/** @file step_length.h  How long a step is, from what the accelerometer felt of it.
 *
 *  Source  [PhoneEKF (3)], [PhoneUKF (6)]; a constant as in [WifiShift] II.B; one of our own.
 *
 *      insole_step_length_config_t config = insole_step_length_defaults;
 *      on each footfall of step.h:
 *          insole_step_length(&config, &footfall, &length_m);
 *
 *  | model    | length                                     | error of a walk's distance |
 *  |----------|--------------------------------------------|----------------------------|
 *  | root     | C1 range^(1/C)                             | 8.1 %                      |
 *  | linear   | alpha f + beta variance + gamma            | 8.9 %                      |
 *  | mixed    | a + b f + c sqrt(range)                    | 7.6 %                      |
 *  | constant | L                                          | 10.6 %                     |
 *
 *  f = 1/duration. The defaults are least squares over the steps of 79 walks of 20 to 90 s with the
 *  phone in the hand; the errors are means over those and 27 more. Frequency shortens the steps of
 *  `linear` and `mixed`: of these walkers, those with quick steps took short ones. A single walker
 *  who goes faster does the opposite, so the root is the default; a person's own coefficients come
 *  from a walk of known distance.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_MOVE_STEP_LENGTH_H
#define INSOLE_MOVE_STEP_LENGTH_H

#include "insole/base/config.h"
#include "insole/base/types.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum {
    INSOLE_STEP_LENGTH_ROOT = 0,
    INSOLE_STEP_LENGTH_LINEAR = 1,
    INSOLE_STEP_LENGTH_MIXED = 2,
    INSOLE_STEP_LENGTH_CONSTANT = 3
} insole_step_length_model_t;

/* clang-format off */
#define INSOLE_STEP_LENGTH_KEYS(KEY)                                                              \
    KEY(CHOICE, model, 0, 0, 3, "root|linear|mixed|constant", "what the length is made of")       \
    KEY(REAL, root_degree, 4.0, 1.0, 12.0, "", "C of (3): which root of the range")               \
    KEY(REAL, root_scale, 0.412, 0.01, 5.0, "m/(m/s^2)^(1/C)", "C1 of (3)")                       \
    KEY(REAL, linear_alpha, -0.421, -5.0, 5.0, "m/Hz", "alpha of (6), times the frequency")       \
    KEY(REAL, linear_beta, 0.0081, -1.0, 1.0, "m/(m/s^2)^2", "beta of (6), times the variance")   \
    KEY(REAL, linear_gamma, 1.335, -5.0, 5.0, "m", "gamma of (6)")                                \
    KEY(REAL, mixed_a, 0.41, -5.0, 5.0, "m", "mixed: constant part")                             \
    KEY(REAL, mixed_b, -0.185, -5.0, 5.0, "m/Hz", "mixed: times the frequency")                   \
    KEY(REAL, mixed_c, 0.231, -5.0, 5.0, "m/(m/s^2)^(1/2)", "mixed: times the root of the range") \
    KEY(REAL, constant_m, 0.655, 0.05, 2.0, "m", "constant: every step")                          \
    KEY(REAL, min_s, 0.3, 0.1, 1.0, "s", "a shorter step counts as this long in the frequency")   \
    KEY(REAL, max_s, 1.0, 1.0, 5.0, "s", "a longer one as this long")                             \
    KEY(REAL, min_m, 0.2, 0.01, 0.5, "m", "no step is shorter")                                   \
    KEY(REAL, max_m, 1.5, 0.5, 3.0, "m", "nor longer")
/* clang-format on */

typedef struct {
    INSOLE_STEP_LENGTH_KEYS(INSOLE_CONFIG_MEMBER)
} insole_step_length_config_t;

extern const insole_step_length_config_t insole_step_length_defaults;

/** @return INSOLE_ERR_NULL, INSOLE_ERR_VALUE for a setting out of its range */
insole_status_t insole_step_length_check(const insole_step_length_config_t *config);

/** @param[out] length_m  within [min_m, max_m]
 *  @return INSOLE_ERR_NULL; INSOLE_ERR_VALUE: a setting out of its range, a footfall whose range or
 *          scatter is negative or not finite; INSOLE_ERR_TIME: one that does not end after it
 *          began */
insole_status_t insole_step_length(const insole_step_length_config_t *config,
                                   const insole_footfall_t *footfall, insole_real_t *length_m);

#ifdef __cplusplus
}
#endif

#endif
