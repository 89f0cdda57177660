/* SPDX-License-Identifier: MIT */
#include "reproduce.h"

#include <math.h>

#include "json.h"
#include "number.h"

static const char *const names[REPRODUCE_FIGURES] = {
    [REPRODUCE_MAX] = "max", [REPRODUCE_MIN] = "min",   [REPRODUCE_MEAN] = "mean",
    [REPRODUCE_RMS] = "rms", [REPRODUCE_STD] = "std",   [REPRODUCE_75] = "75 %",
    [REPRODUCE_90] = "90 %", [REPRODUCE_NEAR] = "% <1m"};

static const char *const keys[REPRODUCE_FIGURES] = {
    [REPRODUCE_MAX] = "max_m",   [REPRODUCE_MIN] = "min_m",
    [REPRODUCE_MEAN] = "mean_m", [REPRODUCE_RMS] = "rms_m",
    [REPRODUCE_STD] = "std_m",   [REPRODUCE_75] = "p75_m",
    [REPRODUCE_90] = "p90_m",    [REPRODUCE_NEAR] = "within_1m_percent"};

const char *reproduce_figure_name(reproduce_figure_t figure)
{
    return names[figure];
}

/* The lowest and the highest mean error of a walk. */
static void find_span(const reproduction_t *reproduction, int row, double *low_m, double *high_m)
{
    const reproduce_figures_t *walks = reproduction->results[row].walks;
    *low_m = *high_m = walks[0].m[REPRODUCE_MEAN];
    for (int i = 1; i < reproduction->request.runs; i++) {
        *low_m = fmin(*low_m, walks[i].m[REPRODUCE_MEAN]);
        *high_m = fmax(*high_m, walks[i].m[REPRODUCE_MEAN]);
    }
}

/* What is not printed is not known. */
static reproduce_figures_t printed_of(const reproduce_row_t *row)
{
    reproduce_figures_t printed = row->printed;
    for (int i = 0; i < REPRODUCE_FIGURES; i++) {
        printed.m[i] = printed.m[i] > 0.0 ? printed.m[i] : NUMBER_UNKNOWN;
    }
    return printed;
}

/* By how much a row's figure lies below its rival's; negative: above. */
static double share_below(const reproduction_t *reproduction, const reproduce_claim_t *claim)
{
    reproduce_figures_t own = reproduce_means(reproduction, claim->row);
    reproduce_figures_t rival = claim->is_against_print
                                    ? printed_of(&reproduction->paper->rows[claim->rival])
                                    : reproduce_means(reproduction, claim->rival);
    return 1.0 - own.m[claim->figure] / rival.m[claim->figure];
}

/* ---- text ------------------------------------------------------------------------------- */

enum { CELL = 7 };

static void print_cell(FILE *file, double value)
{
    char number[NUMBER_ROOM];
    fprintf(file, " %6s", isnan(value) ? "-" : number_fixed(number, value, 2));
}

static void print_figures(FILE *file, const reproduce_paper_t *paper,
                          const reproduce_figures_t *figures)
{
    for (int i = 0; i < paper->column_count; i++) {
        print_cell(file, figures->m[paper->columns[i]]);
    }
}

static void print_names(FILE *file, const reproduce_paper_t *paper)
{
    for (int i = 0; i < paper->column_count; i++) {
        fprintf(file, " %6s", names[paper->columns[i]]);
    }
}

static void print_row(FILE *file, const reproduction_t *reproduction, int row)
{
    const reproduce_paper_t *paper = reproduction->paper;
    const reproduce_row_t *asked = &paper->rows[row];
    reproduce_figures_t means = reproduce_means(reproduction, row);
    reproduce_figures_t printed = printed_of(asked);
    double low_m, high_m;
    find_span(reproduction, row, &low_m, &high_m);
    fprintf(file, "%-22s", asked->label);
    print_figures(file, paper, &means);
    print_cell(file, low_m);
    print_cell(file, high_m);
    if (!isnan(printed.m[REPRODUCE_MEAN])) {
        fputs("  ", file);
        print_figures(file, paper, &printed);
    }
    fputc('\n', file);
}

static void print_claim(FILE *file, const reproduction_t *reproduction,
                        const reproduce_claim_t *claim)
{
    const reproduce_paper_t *paper = reproduction->paper;
    char number[NUMBER_ROOM];
    double below = share_below(reproduction, claim);
    fprintf(file, "%s against %s%s: %s %s %% %s (%s)\n", paper->rows[claim->row].label,
            paper->rows[claim->rival].label, claim->is_against_print ? " as printed" : "",
            names[claim->figure], number_fixed(number, 100.0 * fabs(below), 1),
            below < 0.0 ? "higher" : "lower", claim->claim);
}

static void print_head(FILE *file, const reproduction_t *reproduction)
{
    const reproduce_paper_t *paper = reproduction->paper;
    unsigned long long first = reproduction->request.seed;
    fprintf(file, "[%s] %s, %d simulated walk%s of %s, seed %llu", paper->name, paper->table,
            reproduction->request.runs, reproduction->request.runs == 1 ? "" : "s", paper->scenario,
            first);
    if (reproduction->request.runs > 1) {
        fprintf(file, " to %llu", first + (unsigned long long)reproduction->request.runs - 1u);
    }
    fprintf(file,
            "\nError in m. Measured: each figure is %s; low and high are the\n"
            "least and the largest mean of a walk. Printed: %s.\n\n",
            paper->is_pooled ? "that of all errors" : "the mean of the walks'",
            paper->is_pooled ? "40 walks" : "one walk");
    fprintf(file, "%-22s%*s  %*s\n%-22s", "", CELL * (paper->column_count + 2), "measured",
            CELL * paper->column_count, "printed", "method");
    print_names(file, paper);
    fprintf(file, " %6s %6s  ", "low", "high");
    print_names(file, paper);
    fputc('\n', file);
}

void reproduce_print(const reproduction_t *reproduction, FILE *file)
{
    const reproduce_paper_t *paper = reproduction->paper;
    print_head(file, reproduction);
    fputs("by the paper's parts\n", file);
    for (int row = 0; row < paper->row_count; row++) {
        if (row > 0 && paper->rows[row].is_ours && !paper->rows[row - 1].is_ours) {
            fputs("by our defaults, on the same logs\n", file);
        }
        print_row(file, reproduction, row);
    }
    fputc('\n', file);
    for (int i = 0; i < paper->claim_count; i++) {
        print_claim(file, reproduction, &paper->claims[i]);
    }
    fputc('\n', file);
    if (paper->more != NULL && paper->more->print != NULL) {
        paper->more->print(reproduction, file);
        fputc('\n', file);
    }
    for (const char *const *note = paper->notes; *note != NULL; note++) {
        fprintf(file, "%s\n", *note);
    }
}

/* ---- json ------------------------------------------------------------------------------- */

static void json_figures(json_t *json, const char *key, const reproduce_paper_t *paper,
                         const reproduce_figures_t *figures)
{
    json_object(json, key);
    for (int i = 0; i < paper->column_count; i++) {
        json_number(json, keys[paper->columns[i]], figures->m[paper->columns[i]], 4);
    }
    json_end(json);
}

static void json_row(json_t *json, const reproduction_t *reproduction, int row)
{
    const reproduce_paper_t *paper = reproduction->paper;
    const reproduce_row_t *asked = &paper->rows[row];
    reproduce_figures_t means = reproduce_means(reproduction, row);
    reproduce_figures_t printed = printed_of(asked);
    json_object(json, NULL);
    json_text(json, "label", asked->label);
    json_text(json, "method", method_name(asked->method));
    json_text(json, "settings", asked->is_ours ? "ours" : "paper");
    json_figures(json, "measured", paper, &means);
    json_figures(json, "printed", paper, &printed);
    json_array(json, "walks");
    for (int i = 0; i < reproduction->request.runs; i++) {
        json_figures(json, NULL, paper, &reproduction->results[row].walks[i]);
    }
    json_end(json);
    json_end(json);
}

static void json_claim(json_t *json, const reproduction_t *reproduction,
                       const reproduce_claim_t *claim)
{
    const reproduce_paper_t *paper = reproduction->paper;
    json_object(json, NULL);
    json_text(json, "row", paper->rows[claim->row].label);
    json_text(json, "rival", paper->rows[claim->rival].label);
    json_text(json, "figure", names[claim->figure]);
    json_flag(json, "rival_as_printed", claim->is_against_print);
    json_number(json, "share_lower", share_below(reproduction, claim), 4);
    json_text(json, "claim", claim->claim);
    json_end(json);
}

void reproduce_json(const reproduction_t *reproduction, FILE *file)
{
    const reproduce_paper_t *paper = reproduction->paper;
    json_t json;
    json_begin(&json, file);
    json_object(&json, NULL);
    json_text(&json, "paper", paper->name);
    json_text(&json, "table", paper->table);
    json_text(&json, "scenario", paper->scenario);
    json_whole(&json, "runs", reproduction->request.runs);
    json_whole(&json, "seed", (long long)reproduction->request.seed);
    json_array(&json, "rows");
    for (int row = 0; row < paper->row_count; row++) {
        json_row(&json, reproduction, row);
    }
    json_end(&json);
    json_array(&json, "claims");
    for (int i = 0; i < paper->claim_count; i++) {
        json_claim(&json, reproduction, &paper->claims[i]);
    }
    json_end(&json);
    if (paper->more != NULL && paper->more->json != NULL) {
        paper->more->json(reproduction, &json);
    }
    json_end(&json);
}
