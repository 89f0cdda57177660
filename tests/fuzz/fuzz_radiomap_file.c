/* SPDX-License-Identifier: MIT
 * Any bytes as a radio map: what is read passes the library's check, is written and read again as
 * it is, and can be searched; a refusal names its line. */
#include "fuzz.h"

#include "insole/place/kde_fix.h"
#include "radiomap_file.h"

static void check_refusal(const failure_t *failure)
{
    fuzz_claim(failure->exit_code == EXIT_BAD_INPUT, "a malformed file is bad input");
    fuzz_claim(strncmp(failure->text, "map:", 4u) == 0 && strlen(failure->text) > 12u,
               "the message says where and what");
}

static void check_names(const radiomap_file_t *file)
{
    fuzz_claim(file->ids.count == file->map.ap_count, "every access point has a name");
    for (size_t i = 1; i < file->ids.count; i++) {
        fuzz_claim(strcmp(file->ids.names[i - 1], file->ids.names[i]) < 0, "names ascend");
    }
}

static void check_again(const radiomap_file_t *file)
{
    radiomap_file_t again;
    failure_t failure = {EXIT_DONE, ""};
    FILE *stream = tmpfile();
    fuzz_claim(stream != NULL, "there is a disk");
    radiomap_file_write(stream, file);
    rewind(stream);
    fuzz_claim(radiomap_file_take(&again, stream, "again", &failure), "what is written is read");
    size_t entries = file->map.first[file->map.point_count];
    fuzz_claim(again.map.point_count == file->map.point_count &&
                   again.map.ap_count == file->map.ap_count &&
                   memcmp(again.map.first, file->map.first,
                          (file->map.point_count + 1u) * sizeof *again.map.first) == 0 &&
                   memcmp(again.map.aps, file->map.aps, entries * sizeof *again.map.aps) == 0 &&
                   memcmp(again.map.below, file->map.below, entries) == 0,
               "and is the same");
    radiomap_file_free(&again);
}

/* A scan that hears all as the first point does. */
static void search(const radiomap_file_t *file)
{
    static insole_kde_fix_t kde;
    insole_rss_t heard[16];
    uint32_t count = 0;
    insole_radio_fix_t fix;
    for (; count < 16 && count < file->map.first[1]; count++) {
        heard[count].id = file->map.aps[count];
        heard[count].rss_dbm = insole_radio_map_mean_dbm(&file->map, count);
        heard[count].age_us = 0;
    }
    insole_kde_fix_init(&kde, &insole_kde_fix_defaults);
    if (insole_kde_fix_solve(&kde, &file->map, NULL, heard, count, &fix) == INSOLE_OK) {
        fuzz_claim(insole_spot_is_finite(fix.spot) && insole_is_finite(fix.var_x_m2),
                   "a fix is finite");
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    radiomap_file_t file;
    failure_t failure = {EXIT_DONE, ""};
    if (!radiomap_file_take(&file, fuzz_file(data, size), "map", &failure)) {
        check_refusal(&failure);
        return 0;
    }
    fuzz_claim(insole_radio_map_check(&file.map) == INSOLE_OK, "the library takes the map");
    check_names(&file);
    check_again(&file);
    search(&file);
    radiomap_file_free(&file);
    return 0;
}
