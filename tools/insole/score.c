/* SPDX-License-Identifier: MIT */
#include "score.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "memory.h"
#include "number.h"
#include "statistics.h"

/* The jitter of a motion capture at rest is not distance. */
static const double shortest_leg_m = 0.25;

/* A truth no longer than this is that of a loop: it tells where the walk ended, not how far it
 * went. */
static const double loop_length_m = 1.0;

static const char *const alignment_names[] = {"none", "yaw", "se2"};

bool score_alignment_parse(const char *name, alignment_t *alignment, failure_t *failure)
{
    for (int i = 0; i < 3; i++) {
        if (strcmp(name, alignment_names[i]) == 0) {
            *alignment = (alignment_t)i;
            return true;
        }
    }
    return failure_usage(failure, "insole: --align %s: expected none, yaw or se2", name);
}

const char *score_alignment_name(alignment_t alignment)
{
    return alignment_names[alignment];
}

const char *score_alignment_text(alignment_t alignment)
{
    static const char *const done[] = {"as it is", "turned about its start", "turned and shifted"};
    return done[alignment];
}

/* A point of truth and where the track was then. */
typedef struct {
    const track_row_t *truth;
    bool has_place;
    double x_m, y_m, z_m;
} pair_t;

static double seconds_between(const track_row_t *a, const track_row_t *b)
{
    return 1e-6 * (double)(b->t_us - a->t_us);
}

static void take_place(pair_t *pair, const track_row_t *a, const track_row_t *b, double share)
{
    pair->has_place = true;
    pair->x_m = a->x_m + share * (b->x_m - a->x_m);
    pair->y_m = a->y_m + share * (b->y_m - a->y_m);
    pair->z_m = a->z_m + share * (b->z_m - a->z_m);
}

/* What nobody can walk: a start or a fix has put the track elsewhere. */
static bool is_leap(const track_row_t *a, const track_row_t *b)
{
    return hypot(b->x_m - a->x_m, b->y_m - a->y_m) > SCORE_LEAP_MPS * seconds_between(a, b);
}

/* `after`: number of the first row after the point's time. */
static void find_place(const track_t *track, size_t after, pair_t *pair)
{
    const track_row_t *rows = track->rows, *truth = pair->truth;
    if (after == 0u || after == track->count) {
        const track_row_t *end = &rows[after == 0u ? 0u : after - 1u];
        if (fabs(seconds_between(end, truth)) <= SCORE_END_S) {
            take_place(pair, end, end, 0.0);
        }
        return;
    }
    const track_row_t *a = &rows[after - 1u], *b = &rows[after];
    if (truth->t_us == a->t_us) {
        take_place(pair, a, a, 0.0);
    } else if (seconds_between(a, b) <= SCORE_GAP_S) {
        bool is_later = is_leap(a, b) && truth->t_us > a->t_us;
        take_place(pair, a, b, is_later ? 1.0 : seconds_between(a, truth) / seconds_between(a, b));
    }
}

static pair_t *associate(const track_t *track, const track_t *truth)
{
    pair_t *pairs = memory_new(truth->count, sizeof *pairs);
    size_t after = 0u;
    for (size_t i = 0u; i < truth->count; i++) {
        pairs[i].truth = &truth->rows[i];
        while (after < track->count && track->rows[after].t_us <= truth->rows[i].t_us) {
            after++;
        }
        if (track->count > 0u) {
            find_place(track, after, &pairs[i]);
        }
    }
    return pairs;
}

/* Means of both sides over the pairs that have a place. */
typedef struct {
    double x_m, y_m, truth_x_m, truth_y_m;
    size_t count;
} centers_t;

static centers_t find_centers(const pair_t *pairs, size_t count)
{
    centers_t c = {0.0, 0.0, 0.0, 0.0, 0u};
    for (size_t i = 0u; i < count; i++) {
        if (pairs[i].has_place) {
            c.count++;
            double weight = 1.0 / (double)c.count;
            c.x_m += weight * (pairs[i].x_m - c.x_m);
            c.y_m += weight * (pairs[i].y_m - c.y_m);
            c.truth_x_m += weight * (pairs[i].truth->x_m - c.truth_x_m);
            c.truth_y_m += weight * (pairs[i].truth->y_m - c.truth_y_m);
        }
    }
    return c;
}

/* The turn that brings the track, seen from its center, closest to the truth, seen from its own. */
static double best_turn(const pair_t *pairs, size_t count, const centers_t *c)
{
    double along = 0.0, across = 0.0;
    for (size_t i = 0u; i < count; i++) {
        if (pairs[i].has_place) {
            double x = pairs[i].x_m - c->x_m, y = pairs[i].y_m - c->y_m;
            double truth_x = pairs[i].truth->x_m - c->truth_x_m;
            double truth_y = pairs[i].truth->y_m - c->truth_y_m;
            along += x * truth_x + y * truth_y;
            across += x * truth_y - y * truth_x;
        }
    }
    return along == 0.0 && across == 0.0 ? 0.0 : atan2(across, along);
}

/* The motion that turns about `c`'s center and puts it on the truth's. */
static motion_t motion_about(const centers_t *c, double turn_rad)
{
    double cosine = cos(turn_rad), sine = sin(turn_rad);
    motion_t motion = {turn_rad, c->truth_x_m - (cosine * c->x_m - sine * c->y_m),
                       c->truth_y_m - (sine * c->x_m + cosine * c->y_m), 0.0};
    return motion;
}

static double mean_height_difference(const pair_t *pairs, size_t count)
{
    double mean = 0.0;
    size_t n = 0u;
    for (size_t i = 0u; i < count; i++) {
        double difference = pairs[i].truth->z_m - pairs[i].z_m;
        if (pairs[i].has_place && !isnan(difference)) {
            n++;
            mean += (difference - mean) / (double)n;
        }
    }
    return mean;
}

static const pair_t *first_with_place(const pair_t *pairs, size_t count)
{
    size_t i = 0u;
    while (i < count && !pairs[i].has_place) {
        i++;
    }
    return i < count ? &pairs[i] : NULL;
}

static motion_t align_yaw(const pair_t *pairs, size_t count, const pair_t *first)
{
    centers_t pivot = {first->x_m, first->y_m, first->x_m, first->y_m, 1u};
    return motion_about(&pivot, best_turn(pairs, count, &pivot));
}

/* Two points are the ends of a walk: shared out between them, the error at its end would halve. */
static motion_t align_ends(const pair_t *pairs, size_t count, const pair_t *first)
{
    centers_t pin = {first->x_m, first->y_m, first->truth->x_m, first->truth->y_m, 1u};
    motion_t motion = motion_about(&pin, best_turn(pairs, count, &pin));
    motion.z_m = mean_height_difference(first, 1u);
    return motion;
}

static motion_t align_se2(const pair_t *pairs, size_t count, const pair_t *first)
{
    centers_t centers = find_centers(pairs, count);
    if (centers.count < 3u) {
        return align_ends(pairs, count, first);
    }
    motion_t motion = motion_about(&centers, best_turn(pairs, count, &centers));
    motion.z_m = mean_height_difference(pairs, count);
    return motion;
}

static motion_t align(const pair_t *pairs, size_t count, alignment_t alignment)
{
    const pair_t *first = first_with_place(pairs, count);
    if (first != NULL && alignment == ALIGN_YAW) {
        return align_yaw(pairs, count, first);
    }
    if (first != NULL && alignment == ALIGN_SE2) {
        return align_se2(pairs, count, first);
    }
    motion_t none = {0.0, 0.0, 0.0, 0.0};
    return none;
}

static void move_place(const motion_t *motion, double *x_m, double *y_m, double *z_m)
{
    double cosine = cos(motion->turn_rad), sine = sin(motion->turn_rad);
    double x = *x_m, y = *y_m;
    *x_m = cosine * x - sine * y + motion->x_m;
    *y_m = sine * x + cosine * y + motion->y_m;
    *z_m += motion->z_m;
}

void score_move(const motion_t *motion, track_row_t *row)
{
    double c = cos(motion->turn_rad), s = sin(motion->turn_rad);
    double xx = row->var_x_m2, xy = row->cov_xy_m2, yy = row->var_y_m2;
    move_place(motion, &row->x_m, &row->y_m, &row->z_m);
    row->heading_rad = remainder(row->heading_rad + motion->turn_rad, 6.283185307179586);
    row->var_x_m2 = c * c * xx - 2.0 * c * s * xy + s * s * yy;
    row->var_y_m2 = s * s * xx + 2.0 * c * s * xy + c * c * yy;
    row->cov_xy_m2 = c * s * (xx - yy) + (c * c - s * s) * xy;
}

static double plane_error(const pair_t *pair)
{
    return pair->has_place ? hypot(pair->x_m - pair->truth->x_m, pair->y_m - pair->truth->y_m)
                           : SCORE_MISSING_M;
}

static void score_plane(const pair_t *pairs, size_t count, score_t *score)
{
    double *errors = memory_new(count, sizeof *errors);
    for (size_t i = 0u; i < count; i++) {
        errors[i] = plane_error(&pairs[i]);
        score->missing += pairs[i].has_place ? 0u : 1u;
    }
    score->n = count;
    score->mean_m = statistics_mean(errors, count);
    score->std_m = statistics_std(errors, count);
    score->rms_m = statistics_rms(errors, count);
    score->p50_m = statistics_percentile(errors, count, 50.0);
    score->p75_m = statistics_percentile(errors, count, 75.0);
    score->p90_m = statistics_percentile(errors, count, 90.0);
    score->p95_m = statistics_percentile(errors, count, 95.0);
    score->min_m = statistics_percentile(errors, count, 0.0);
    score->max_m = statistics_percentile(errors, count, 100.0);
    free(errors);
}

static void score_height(const pair_t *pairs, size_t count, score_t *score)
{
    double *errors = memory_new(count, sizeof *errors);
    size_t n = 0u;
    for (size_t i = 0u; i < count; i++) {
        double difference = pairs[i].z_m - pairs[i].truth->z_m;
        if (pairs[i].has_place && !isnan(difference)) {
            errors[n++] = difference;
        }
    }
    score->z_rms_m = n > 0u ? statistics_rms(errors, n) : NUMBER_UNKNOWN;
    free(errors);
}

static void score_end(const pair_t *last, const track_t *track, const track_t *truth,
                      score_t *score)
{
    double height = last->has_place ? last->z_m - last->truth->z_m : NUMBER_UNKNOWN;
    score->end_2d_m = plane_error(last);
    score->end_3d_m = isnan(height) ? NUMBER_UNKNOWN : hypot(score->end_2d_m, height);
    score->distance_m = track_length(truth, shortest_leg_m);
    if (score->distance_m < loop_length_m) {
        score->distance_m = track_length(track, shortest_leg_m);
    }
    score->end_percent =
        score->distance_m > 0.0 ? 100.0 * score->end_2d_m / score->distance_m : NUMBER_UNKNOWN;
}

void score_errors(const track_t *track, const track_t *truth, double *errors_m)
{
    pair_t *pairs = associate(track, truth);
    for (size_t i = 0u; i < truth->count; i++) {
        errors_m[i] = plane_error(&pairs[i]);
    }
    free(pairs);
}

void score_compute(const track_t *track, const track_t *truth, alignment_t alignment,
                   score_t *score)
{
    memset(score, 0, sizeof *score);
    pair_t *pairs = associate(track, truth);
    score->alignment = alignment;
    score->motion = align(pairs, truth->count, alignment);
    for (size_t i = 0u; i < truth->count; i++) {
        move_place(&score->motion, &pairs[i].x_m, &pairs[i].y_m, &pairs[i].z_m);
    }
    score_plane(pairs, truth->count, score);
    score_height(pairs, truth->count, score);
    score_end(&pairs[truth->count - 1u], track, truth, score);
    free(pairs);
}
