/* SPDX-License-Identifier: MIT */
#include "score_print.h"

#include <math.h>

#include "number.h"

static void print_value(FILE *file, const char *name, double value, const char *unit)
{
    char number[NUMBER_ROOM];
    if (isnan(value)) {
        fprintf(file, "  %-12s %10s\n", name, "-");
    } else {
        fprintf(file, "  %-12s %10s %s\n", name, number_fixed(number, value, 3), unit);
    }
}

static void print_head(FILE *file, const score_t *score)
{
    char turn[NUMBER_ROOM];
    double turn_deg = score->motion.turn_rad * 57.29577951308232;
    fprintf(file, "score against the truth, in the plane (%s",
            score_alignment_text(score->alignment));
    if (score->alignment != ALIGN_NONE) {
        fprintf(file, ", by %s deg", number_fixed(turn, turn_deg, 1));
    }
    fputs(")\n", file);
    fprintf(file, "  %-12s %10lu\n", "points", (unsigned long)score->n);
    if (score->missing > 0u) {
        fprintf(file, "  %-12s %10lu without a place in the track, counted as %s m each\n",
                "missing", (unsigned long)score->missing, number_fixed(turn, SCORE_MISSING_M, 0));
    }
}

void score_print(FILE *file, const score_t *score)
{
    print_head(file, score);
    print_value(file, "mean", score->mean_m, "m");
    print_value(file, "std", score->std_m, "m");
    print_value(file, "rms", score->rms_m, "m");
    print_value(file, "max", score->max_m, "m");
    print_value(file, "min", score->min_m, "m");
    print_value(file, "50 %", score->p50_m, "m");
    print_value(file, "75 %", score->p75_m, "m");
    print_value(file, "90 %", score->p90_m, "m");
    print_value(file, "95 %", score->p95_m, "m");
    print_value(file, "end", score->end_2d_m, "m");
    print_value(file, "end in 3-D", score->end_3d_m, "m");
    print_value(file, "distance", score->distance_m, "m");
    print_value(file, "end/distance", score->end_percent, "%");
    print_value(file, "height rms", score->z_rms_m, "m");
}

void score_json(json_t *json, const char *key, const score_t *score)
{
    json_object(json, key);
    json_text(json, "align", score_alignment_name(score->alignment));
    json_number(json, "turn_rad", score->motion.turn_rad, 6);
    json_number(json, "shift_x_m", score->motion.x_m, 4);
    json_number(json, "shift_y_m", score->motion.y_m, 4);
    json_number(json, "shift_z_m", score->motion.z_m, 4);
    json_whole(json, "n", (long long)score->n);
    json_whole(json, "missing", (long long)score->missing);
    json_number(json, "mean_m", score->mean_m, 4);
    json_number(json, "std_m", score->std_m, 4);
    json_number(json, "rms_m", score->rms_m, 4);
    json_number(json, "max_m", score->max_m, 4);
    json_number(json, "min_m", score->min_m, 4);
    json_number(json, "p50_m", score->p50_m, 4);
    json_number(json, "p75_m", score->p75_m, 4);
    json_number(json, "p90_m", score->p90_m, 4);
    json_number(json, "p95_m", score->p95_m, 4);
    json_number(json, "end_2d_m", score->end_2d_m, 4);
    json_number(json, "end_3d_m", score->end_3d_m, 4);
    json_number(json, "distance_m", score->distance_m, 4);
    json_number(json, "end_percent", score->end_percent, 3);
    json_number(json, "z_rms_m", score->z_rms_m, 4);
    json_end(json);
}
