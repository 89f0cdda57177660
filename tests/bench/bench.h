/** @file bench.h  Instructions per call of public functions, the same on a desk and on a chip.
 *
 *  A case calls one public function; its results go to `bench_result`, whose CRC tells whether two
 *  machines computed the same bits. A room's file holds a table of cases, bench_main.c the list of
 *  tables. On the host callgrind counts what runs below each `call`; a Cortex-M counts itself.
 *
 *      static void call_insole_sin(uint32_t call)
 *      {
 *          (void)call;
 *          bench_result[0] = insole_sin(angle_rad);
 *      }
 *      const bench_case_t bench_base[] = {{"insole_sin", 256, NULL, make_angle, call_insole_sin}};
 *
 *  The function behind case NAME is named call_NAME.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TESTS_BENCH_H
#define INSOLE_TESTS_BENCH_H

#include "insole/insole.h"

enum { BENCH_RESULTS = 16 };

typedef struct {
    const char *name; /**< of the function, perhaps with a word on the settings */
    uint32_t calls;
    void (*begin)(void);            /**< sets the state up, not counted; NULL: nothing to do */
    void (*prepare)(uint32_t call); /**< makes the arguments, not counted; NULL: nothing to do */
    void (*call)(uint32_t call);    /**< counted */
    void (*take)(void);             /**< puts the results out, not counted; NULL: the call does */
} bench_case_t;

typedef struct {
    const bench_case_t *cases;
    uint32_t count;
} bench_table_t;

#define BENCH_TABLE(cases)                                                                         \
    {                                                                                              \
        cases, sizeof cases / sizeof cases[0]                                                      \
    }

extern const bench_table_t bench_base, bench_foot, bench_fuse, bench_phone, bench_place,
    bench_track;

/** What the call under way found. */
extern insole_real_t bench_result[BENCH_RESULTS];

/** Seeded anew before each case. */
extern insole_rng_t bench_rng;

/** Uniform between the two. */
insole_real_t bench_between(insole_real_t low, insole_real_t high);
insole_vec3_t bench_vec3_between(insole_real_t low, insole_real_t high);

void bench_take_vec3(uint32_t at, insole_vec3_t v);
void bench_take_quat(uint32_t at, insole_quat_t q);

/* What differs between the machines. */

void bench_write(const char *text);

/** Whether this case is to be run. */
bool bench_is_wanted(const char *name);

/** Makes the counter ready. @return false when it does not count what it should */
bool bench_counter_start(void);

/** Runs the call. @return instructions it took; 0 where somebody else counts */
uint32_t bench_count(void (*call)(uint32_t), uint32_t index);

#endif
