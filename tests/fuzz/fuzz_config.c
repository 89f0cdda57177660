/* SPDX-License-Identifier: MIT
 * Any bytes as a config file: settings stay within their ranges, a refusal names its line. */
#include "fuzz.h"

#include "config_keys.h"

static void check_settings(const settings_t *settings)
{
    size_t count;
    const config_key_t *keys = config_keys(&count);
    for (size_t i = 0u; i < count; i++) {
        double value = config_value(settings, &keys[i]);
        double slack = 1e-6 * (keys[i].high - keys[i].low); /* ranges are told in double */
        fuzz_claim(value >= keys[i].low - slack && value <= keys[i].high + slack, keys[i].name);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    settings_t settings;
    static insole_foot_fusion_t tracker;
    static insole_particle_t particle;
    static insole_spot_t past;
    static insole_fusion_start_t start;
    static insole_fusion_ranges_t ranges;
    const insole_fusion_memory_t memory = {&particle,
                                           1u,
                                           &past,
                                           1u,
                                           &ranges,
                                           {insole_fusion_start_hear, &start},
                                           &insole_step_weighing_calls};
    failure_t failure = {EXIT_DONE, ""};
    (void)insole_fusion_ranges_init(&ranges);
    settings_init(&settings);
    if (!config_read_file(&settings, fuzz_file(data, size), "config", &failure)) {
        fuzz_claim(failure.exit_code == EXIT_BAD_INPUT, "a malformed config is bad input");
        fuzz_claim(strncmp(failure.text, "config:", 7u) == 0 && strlen(failure.text) > 10u,
                   "the message says where and what");
    }
    check_settings(&settings);
    fuzz_claim(insole_foot_fusion_init(&tracker, &settings.fusion, &memory, NULL, 1u) ==
                       INSOLE_OK &&
                   insole_propagation_check(&settings.propagation) == INSOLE_OK,
               "the library takes what was set");
    return 0;
}
