/* SPDX-License-Identifier: MIT
 * Any bytes as a log: records that come out hold what they promise, a refusal names its line. */
#include "fuzz.h"

#include <math.h>

#include "log_reader.h"
#include "number.h"

static void check_record(const record_t *record, const id_table_t *ids)
{
    fuzz_claim((int)record->kind >= 0 && record->kind < RECORD_KINDS, "the kind is known");
    fuzz_claim(record->t_us > -NUMBER_TIME_LIMIT_US && record->t_us < NUMBER_TIME_LIMIT_US,
               "the time can be computed with");
    for (int i = 0; i < RECORD_VALUES; i++) {
        fuzz_claim(!isinf(record->value[i]), "values are finite or unknown");
    }
    if (record->kind == RECORD_RSS || record->kind == RECORD_RANGE) {
        fuzz_claim(record->id < ids->count && ids->names[record->id][0] != '\0', "ids have names");
    }
    if (record->kind == RECORD_TRUTH || record->kind == RECORD_START ||
        record->kind == RECORD_TRACK) {
        fuzz_claim(isfinite(record->value[0]) && isfinite(record->value[1]), "places are known");
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static log_reader_t reader;
    id_table_t ids;
    record_t record;
    read_t answer;
    failure_t failure = {EXIT_DONE, ""};
    id_table_init(&ids);
    log_reader_attach(&reader, fuzz_file(data, size), "log", &ids);
    while ((answer = log_reader_next(&reader, &record, &failure)) == READ_ONE) {
        check_record(&record, &ids);
    }
    if (answer == READ_FAILED) {
        fuzz_claim(failure.exit_code == EXIT_BAD_INPUT, "a malformed log is bad input");
        fuzz_claim(strncmp(failure.text, "log:", 4u) == 0 && strlen(failure.text) > 8u,
                   "the message says where and what");
    }
    log_reader_close(&reader);
    id_table_free(&ids);
    return 0;
}
