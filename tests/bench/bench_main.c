/* SPDX-License-Identifier: MIT
 * Runs all cases and prints a line for each: name,calls,mean,max,crc. */
#include "bench.h"

insole_real_t bench_result[BENCH_RESULTS];
insole_rng_t bench_rng;

insole_real_t bench_between(insole_real_t low, insole_real_t high)
{
    return low + (high - low) * insole_rng_uniform(&bench_rng);
}

insole_vec3_t bench_vec3_between(insole_real_t low, insole_real_t high)
{
    insole_real_t x = bench_between(low, high);
    insole_real_t y = bench_between(low, high);
    return insole_vec3(x, y, bench_between(low, high));
}

void bench_take_vec3(uint32_t at, insole_vec3_t v)
{
    bench_result[at] = v.x;
    bench_result[at + 1u] = v.y;
    bench_result[at + 2u] = v.z;
}

void bench_take_quat(uint32_t at, insole_quat_t q)
{
    bench_result[at] = q.w;
    bench_take_vec3(at + 1u, insole_vec3(q.x, q.y, q.z));
}

static void write_number(uint32_t number, uint32_t base)
{
    char text[12] = "";
    char *at = text + sizeof text - 1;
    do {
        *--at = "0123456789abcdef"[number % base];
        number /= base;
    } while (number != 0u);
    bench_write(at);
}

/* What a case gave. */
typedef struct {
    uint32_t total, longest, crc;
} outcome_t;

static void write_outcome(const bench_case_t *c, const outcome_t *outcome)
{
    bench_write(c->name);
    bench_write(",");
    write_number(c->calls, 10u);
    bench_write(",");
    write_number((outcome->total + c->calls / 2u) / c->calls, 10u);
    bench_write(",");
    write_number(outcome->longest, 10u);
    bench_write(",");
    write_number(outcome->crc, 16u);
    bench_write("\n");
}

static outcome_t run_case(const bench_case_t *c)
{
    outcome_t outcome = {0u, 0u, 0u};
    insole_rng_seed(&bench_rng, 1u);
    if (c->begin) {
        c->begin();
    }
    for (uint32_t i = 0u; i < c->calls; i++) {
        if (c->prepare) {
            c->prepare(i);
        }
        uint32_t count = bench_count(c->call, i);
        if (c->take) {
            c->take();
        }
        outcome.total += count;
        outcome.longest = count > outcome.longest ? count : outcome.longest;
        outcome.crc = insole_crc32(outcome.crc, bench_result, sizeof bench_result);
    }
    return outcome;
}

int main(void)
{
    static const bench_table_t *const tables[] = {&bench_base,  &bench_foot,  &bench_fuse,
                                                  &bench_phone, &bench_place, &bench_track};
    if (!bench_counter_start()) {
        bench_write("the counter does not count instructions\n");
        return 1;
    }
    bench_write("compiler," __VERSION__ "\n");
    for (uint32_t t = 0u; t < sizeof tables / sizeof tables[0]; t++) {
        for (uint32_t i = 0u; i < tables[t]->count; i++) {
            const bench_case_t *c = &tables[t]->cases[i];
            if (bench_is_wanted(c->name)) {
                outcome_t outcome = run_case(c);
                write_outcome(c, &outcome);
            }
        }
    }
    return 0;
}
