/* SPDX-License-Identifier: MIT */
#include "summary_states.h"

#include "number.h"

void summary_states_print(FILE *file, const replay_facts_t *facts)
{
    char share[NUMBER_ROOM];
    const char *between = "";
    fputs("  states         ", file);
    for (int state = 0; state <= INSOLE_FIX_LOST; state++) {
        if (facts->states[state] > 0u) {
            double percent = 100.0 * (double)facts->states[state] / (double)facts->fixes;
            fprintf(file, "%s%s %s %%", between, track_state_name((insole_fix_state_t)state),
                    number_fixed(share, percent, 1));
            between = ", ";
        }
    }
    putc('\n', file);
}

void summary_states_json(json_t *json, const replay_facts_t *facts)
{
    json_object(json, "states");
    for (int state = 0; state <= INSOLE_FIX_LOST && facts->fixes > 0u; state++) {
        json_number(json, track_state_name((insole_fix_state_t)state),
                    (double)facts->states[state] / (double)facts->fixes, 4);
    }
    json_end(json);
}
