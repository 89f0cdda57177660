/* SPDX-License-Identifier: MIT
 * Whatever lies in flash: a snapshot that loads is one that was saved, and a refusal changes
 * nothing. */
#include "fuzz.h"

#include "insole/base/snapshot.h"

enum { KIND = 7, STATE_BYTES = 24, WHOLE = INSOLE_SNAPSHOT_HEADER_BYTES + STATE_BYTES };

static void load(const uint8_t *data, size_t size)
{
    uint8_t state[STATE_BYTES], before[STATE_BYTES], again[WHOLE];
    size_t used = 0;
    memset(state, 0xA5, sizeof state);
    memcpy(before, state, sizeof state);
    if (insole_snapshot_load(KIND, state, sizeof state, data, size) != INSOLE_OK) {
        fuzz_claim(memcmp(state, before, sizeof state) == 0, "a refusal changes nothing");
        return;
    }
    fuzz_claim(insole_snapshot_save(KIND, state, sizeof state, again, sizeof again, &used) ==
                   INSOLE_OK,
               "what was loaded can be saved");
    fuzz_claim(used <= size && memcmp(again, data, used) == 0, "and gives the same bytes");
}

/* A sound snapshot with some bytes turned by the input must be refused unless all turn back. */
static void damage(fuzz_input_t input)
{
    uint8_t state[STATE_BYTES], image[WHOLE], sound[WHOLE];
    size_t used = 0;
    fuzz_take(&input, state, sizeof state);
    insole_snapshot_save(KIND, state, sizeof state, image, sizeof image, &used);
    memcpy(sound, image, sizeof image);
    while (input.left > 1) {
        size_t at = fuzz_byte(&input) % sizeof image;
        image[at] = (uint8_t)(image[at] ^ fuzz_byte(&input));
    }
    insole_status_t status = insole_snapshot_load(KIND, state, sizeof state, image, used);
    int same = memcmp(image, sound, sizeof image) == 0;
    fuzz_claim(!same || status == INSOLE_OK, "a sound snapshot loads");
    load(image, used);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_input_t input = {data, size};
    load(data, size);
    damage(input);
    return 0;
}
