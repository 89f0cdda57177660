/* SPDX-License-Identifier: MIT */
#include "calibrate.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "memory.h"
#include "number.h"
#include "replay.h"

enum { FEWEST_STRIDES = 10 };

/* A turn on the spot says nothing about how long strides are. */
static const double shortest_stride_m = 0.3;

/* A stride's length beside what (33) makes of its acceleration. */
typedef struct {
    double length_m;
    double root; /* fourth root of the acceleration's range */
} pair_t;

typedef struct {
    pair_t *pairs;
    size_t count, room;
    event_t *strides; /* of the session at hand */
    size_t stride_count, stride_room;
} pairs_t;

static bool keep_stride(void *context, const event_t *event, failure_t *failure)
{
    pairs_t *pairs = context;
    (void)failure;
    if (event->kind == EVENT_STRIDE) {
        pairs->strides = memory_room(pairs->strides, &pairs->stride_room, pairs->stride_count + 1u,
                                     sizeof *pairs->strides);
        pairs->strides[pairs->stride_count++] = *event;
    }
    return true;
}

/* True length of a stride where there is truth, else the inertial one; 0: not to be used. */
static double length_of(const event_t *stride, const track_t *truth)
{
    double x0, y0, x1, y1;
    if (truth->count == 0u) {
        return stride->length_m;
    }
    if (!track_place(truth, stride->begin_us, &x0, &y0) ||
        !track_place(truth, stride->end_us, &x1, &y1)) {
        return 0.0;
    }
    return hypot(x1 - x0, y1 - y0);
}

static void add_pairs(pairs_t *pairs, const track_t *truth)
{
    for (size_t i = 0u; i < pairs->stride_count; i++) {
        const event_t *stride = &pairs->strides[i];
        double range = stride->accel_max_mps2 - stride->accel_min_mps2;
        pair_t pair = {length_of(stride, truth), pow(fmax(range, 0.0), 0.25)};
        if (pair.length_m >= shortest_stride_m && pair.root > 0.0) {
            pairs->pairs =
                memory_room(pairs->pairs, &pairs->room, pairs->count + 1u, sizeof *pairs->pairs);
            pairs->pairs[pairs->count++] = pair;
        }
    }
    pairs->stride_count = 0u;
}

static bool take_session(const arguments_t *arguments, const char *path, pairs_t *pairs,
                         failure_t *failure)
{
    replay_request_t request;
    replay_facts_t facts;
    replay_sink_t sink = {pairs, NULL, NULL, keep_stride};
    memset(&request, 0, sizeof request);
    request.logs = &path;
    request.log_count = 1u;
    request.method = METHOD_INS;
    request.rate_hz = 1.0;
    request.accel_unit = options_value(arguments, "accel-unit");
    request.gyro_unit = options_value(arguments, "gyro-unit");
    settings_init(&request.settings);
    bool is_good = replay_run(&request, &sink, &facts, failure);
    if (is_good) {
        track_sort(&facts.truth);
        add_pairs(pairs, &facts.truth);
    }
    replay_facts_free(&facts);
    return is_good;
}

/* Least squares through the origin: K = sum(l r) / sum(r r). [TwoOrder (33)] */
static double fit(const pairs_t *pairs)
{
    double products = 0.0, squares = 0.0;
    for (size_t i = 0u; i < pairs->count; i++) {
        products += pairs->pairs[i].length_m * pairs->pairs[i].root;
        squares += pairs->pairs[i].root * pairs->pairs[i].root;
    }
    return products / squares;
}

static double residual_m(const pairs_t *pairs, double k)
{
    double squares = 0.0;
    for (size_t i = 0u; i < pairs->count; i++) {
        double error = pairs->pairs[i].length_m - k * pairs->pairs[i].root;
        squares += error * error;
    }
    return sqrt(squares / (double)pairs->count);
}

static bool print_k(const pairs_t *pairs, FILE *file, failure_t *failure)
{
    char number[NUMBER_ROOM];
    if (pairs->count < FEWEST_STRIDES) {
        return failure_input(failure,
                             "insole calibrate stride: only %lu strides: expected %d or "
                             "more",
                             (unsigned long)pairs->count, FEWEST_STRIDES);
    }
    double k = fit(pairs);
    fprintf(file,
            "# calibrate stride: %lu strides; their length scatters about the model's by %s m\n",
            (unsigned long)pairs->count, number_fixed(number, residual_m(pairs, k), 3));
    calibrate_line(file, "stride.k_stride", k, 4);
    return true;
}

bool calibrate_stride(const arguments_t *arguments, const char *const *sessions, size_t count,
                      FILE *file, failure_t *failure)
{
    pairs_t pairs;
    bool is_good = true;
    memset(&pairs, 0, sizeof pairs);
    for (size_t i = 0u; i < count && is_good; i++) {
        is_good = take_session(arguments, sessions[i], &pairs, failure);
    }
    is_good = is_good && print_k(&pairs, file, failure);
    free(pairs.pairs);
    free(pairs.strides);
    return is_good;
}
