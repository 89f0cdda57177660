/* SPDX-License-Identifier: MIT */
#include "reproduce_wifi_shift.h"

#include <math.h>

#include "json.h"

static const char *const start_names[WIFI_SHIFT_STARTS] = {"circles", "moved (ours)", "first fix",
                                                           "mean of fixes"};

static const char *const notes[] = {
    "Steps and headings are ours and the same for all: the headings are the gyro's, not those of a",
    "compass, which WPF, Zee and best are told beside. Only WPF and steps alone know the start.",
    "The noise was set once, by seeds 1001 to 1004, so that fingerprint-ML comes within 20 % of "
    "what",
    "is printed: radio.crowd_db of the three scenarios; insole reproduce WifiShift --seed 1001 "
    "--runs 4.",
    "Settings of the rows are the best of a grid on the same seeds.",
    NULL};

static bool is_printed(const wifi_shift_row_t *row, int count)
{
    return !isnan(row->printed[count][0].mean_m);
}

/* ---- text --------------------------------------------------------------------------------- */

static void print_number(FILE *file, double value, int width)
{
    char number[NUMBER_ROOM];
    fprintf(file, "%*s", width, isnan(value) ? "-" : number_fixed(number, value, 2));
}

static void print_error(FILE *file, wifi_shift_error_t error)
{
    char number[NUMBER_ROOM];
    print_number(file, error.mean_m, 6);
    fprintf(file, " (%5s)", isnan(error.std_m) ? "-" : number_fixed(number, error.std_m, 2));
}

static void print_row(const wifi_shift_t *study, FILE *file, int row)
{
    const wifi_shift_row_t *asked = &wifi_shift_rows[row];
    fprintf(file, "%-28s", asked->label);
    for (int path = 0; path < WIFI_SHIFT_PATHS; path++) {
        print_error(file, wifi_shift_mean(study, row, 0, path));
    }
    for (int path = 0; path < WIFI_SHIFT_PATHS && is_printed(asked, 0); path++) {
        fputs(path == 0 ? "  |" : "", file);
        print_error(file, asked->printed[0][path]);
    }
    fputc('\n', file);
}

static void print_row_4(const wifi_shift_t *study, FILE *file, int row, int count)
{
    const wifi_shift_row_t *asked = &wifi_shift_rows[row];
    fprintf(file, "%2d  %-24s", wifi_shift_counts[count], asked->label);
    for (int path = 0; path < WIFI_SHIFT_PATHS; path++) {
        print_number(file, wifi_shift_mean(study, row, count, path).mean_m, 7);
    }
    for (int path = 0; path < WIFI_SHIFT_PATHS && is_printed(asked, count); path++) {
        fputs(path == 0 ? "  |" : "", file);
        print_number(file, asked->printed[count][path].mean_m, 7);
    }
    fputc('\n', file);
}

static void print_table_4(const wifi_shift_t *study, FILE *file)
{
    fputs("\ntable IV: mean with so many access points\n", file);
    for (int count = 0; count < WIFI_SHIFT_COUNTS; count++) {
        for (int row = 0; row < WIFI_SHIFT_ROWS; row++) {
            if (wifi_shift_rows[row].is_in_table_4) {
                print_row_4(study, file, row, count);
            }
        }
    }
}

static void print_figure_7(const wifi_shift_t *study, FILE *file)
{
    fputs("\nfigure 7: mean error of the start, by lambda\n                ", file);
    for (int lambda = 1; lambda <= WIFI_SHIFT_LAMBDAS; lambda++) {
        fprintf(file, "%7d", lambda);
    }
    fputc('\n', file);
    for (int start = 0; start < WIFI_SHIFT_STARTS; start++) {
        fprintf(file, "%-16s", start_names[start]);
        for (int lambda = 1; lambda <= WIFI_SHIFT_LAMBDAS; lambda++) {
            print_number(file, wifi_shift_start_error(study, (wifi_shift_start_t)start, lambda), 7);
        }
        fputc('\n', file);
    }
}

static double ratio(const wifi_shift_t *study, const wifi_shift_claim_t *claim, int count, int path)
{
    return wifi_shift_mean(study, claim->row, count, path).mean_m /
           wifi_shift_mean(study, claim->rival, count, path).mean_m;
}

static void print_claim(const wifi_shift_t *study, FILE *file, const wifi_shift_claim_t *claim,
                        int count)
{
    double largest = 0.0;
    if (isnan(ratio(study, claim, count, 0))) {
        return;
    }
    fprintf(file, "%2d  %-24s / %-21s", wifi_shift_counts[count], wifi_shift_rows[claim->row].label,
            wifi_shift_rows[claim->rival].label);
    for (int path = 0; path < WIFI_SHIFT_PATHS; path++) {
        largest = fmax(largest, ratio(study, claim, count, path));
        print_number(file, ratio(study, claim, count, path), 6);
    }
    fputs("   at most", file);
    print_number(file, claim->at_most, 5);
    fputs(largest <= claim->at_most ? "  met\n" : "  missed\n", file);
}

static void print_claims(const wifi_shift_t *study, FILE *file)
{
    int all;
    const wifi_shift_claim_t *claims = wifi_shift_claims(&all);
    fputs("\nshare of a rival's mean on paths 1 to 3, and what was to be reached\n", file);
    for (int count = 0; count < WIFI_SHIFT_COUNTS; count++) {
        for (int i = 0; i < all; i++) {
            print_claim(study, file, &claims[i], count);
        }
    }
}

void wifi_shift_print(const wifi_shift_t *study, FILE *file)
{
    unsigned long long first = study->request.seed;
    fprintf(file,
            "[WifiShift] tables I to IV and figure 7, %d simulated walk%s of each path, seed %llu "
            "to %llu\nError in m: mean (std) of a walk, as means over the walks; paths 1 to 3.\n\n",
            study->request.runs, study->request.runs == 1 ? "" : "s", first,
            first + (unsigned long long)study->request.runs - 1u);
    fprintf(file, "%-28s%-42s  | %s\n", "tables I to III", "  measured", " printed");
    for (int row = 0; row < WIFI_SHIFT_ROWS; row++) {
        print_row(study, file, row);
    }
    print_table_4(study, file);
    print_figure_7(study, file);
    print_claims(study, file);
    fputc('\n', file);
    for (const char *const *note = notes; *note != NULL; note++) {
        fprintf(file, "%s\n", *note);
    }
}

/* ---- json --------------------------------------------------------------------------------- */

static void json_error(json_t *json, wifi_shift_error_t error)
{
    json_object(json, NULL);
    json_number(json, "mean_m", error.mean_m, 4);
    json_number(json, "std_m", error.std_m, 4);
    json_end(json);
}

static void json_count(json_t *json, const wifi_shift_t *study, int row, int count)
{
    json_object(json, NULL);
    json_whole(json, "access_points", wifi_shift_counts[count]);
    json_array(json, "measured");
    for (int path = 0; path < WIFI_SHIFT_PATHS; path++) {
        json_error(json, wifi_shift_mean(study, row, count, path));
    }
    json_end(json);
    json_array(json, "printed");
    for (int path = 0; path < WIFI_SHIFT_PATHS; path++) {
        json_error(json, wifi_shift_rows[row].printed[count][path]);
    }
    json_end(json);
    json_end(json);
}

static void json_row(json_t *json, const wifi_shift_t *study, int row)
{
    int counts = wifi_shift_rows[row].is_in_table_4 ? WIFI_SHIFT_COUNTS : 1;
    json_object(json, NULL);
    json_text(json, "label", wifi_shift_rows[row].label);
    json_text(json, "method", method_name(wifi_shift_rows[row].method));
    json_array(json, "counts");
    for (int count = 0; count < counts; count++) {
        json_count(json, study, row, count);
    }
    json_end(json);
    json_end(json);
}

static void json_start(json_t *json, const wifi_shift_t *study, wifi_shift_start_t start)
{
    json_array(json, start_names[start]);
    for (int lambda = 1; lambda <= WIFI_SHIFT_LAMBDAS; lambda++) {
        json_number(json, NULL, wifi_shift_start_error(study, start, lambda), 4);
    }
    json_end(json);
}

void wifi_shift_json(const wifi_shift_t *study, FILE *file)
{
    json_t json;
    json_begin(&json, file);
    json_object(&json, NULL);
    json_text(&json, "paper", "WifiShift");
    json_whole(&json, "runs", study->request.runs);
    json_whole(&json, "seed", (long long)study->request.seed);
    json_array(&json, "rows");
    for (int row = 0; row < WIFI_SHIFT_ROWS; row++) {
        json_row(&json, study, row);
    }
    json_end(&json);
    json_object(&json, "start_m");
    for (int start = 0; start < WIFI_SHIFT_STARTS; start++) {
        json_start(&json, study, (wifi_shift_start_t)start);
    }
    json_end(&json);
    json_end(&json);
}
