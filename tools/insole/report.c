/* SPDX-License-Identifier: MIT */
#include "report.h"

#include <math.h>

#include "insole/insole.h"
#include "output.h"
#include "plot_chart.h"
#include "svg.h"

enum { CURVE_POINTS = 600, SIGMA = 0, ERROR, CURVES };

static const char head[] =
    "<!DOCTYPE html>\n"
    "<html lang=\"en\">\n"
    "<head>\n"
    "<meta charset=\"utf-8\"/>\n"
    "<style>body{font-family:Helvetica,Arial,sans-serif;color:#222;margin:2em auto;"
    "max-width:64em;padding:0 1em}svg{max-width:100%;height:auto}"
    "pre{background:#f6f6f6;padding:1em;overflow:auto}</style>\n"
    "<title>";

/* ---- curves over time ------------------------------------------------------------------- */

static double seconds(const track_row_t *row)
{
    return 1e-6 * (double)row->t_us;
}

static void add_sigmas(chart_line_t *line, const track_t *track)
{
    size_t every = 1u + track->count / CURVE_POINTS;
    for (size_t i = 0u; i < track->count; i += every) {
        const track_row_t *row = &track->rows[i];
        chart_add(line, seconds(row), sqrt(fmax(row->var_x_m2 + row->var_y_m2, 0.0)));
    }
}

/* Only where the track was: a point of truth without a row has no error to show. */
static void add_errors(chart_line_t *line, const track_t *track, const track_t *truth)
{
    double x_m, y_m;
    size_t every = 1u + truth->count / CURVE_POINTS;
    for (size_t i = 0u; i < truth->count; i += every) {
        const track_row_t *at = &truth->rows[i];
        if (track_place(track, at->t_us, &x_m, &y_m)) {
            chart_add(line, seconds(at), hypot(x_m - at->x_m, y_m - at->y_m));
        }
    }
}

/* Above nearly all of the points: one moment of ignorance does not flatten the rest. */
static double height_of(const chart_line_t *lines)
{
    double sum = 0.0, most = 0.1;
    size_t count = 0u;
    for (int k = 0; k < CURVES; k++) {
        for (size_t i = 0u; i < lines[k].count; i++, count++) {
            sum += lines[k].points[i].y;
            most = fmax(most, lines[k].points[i].y);
        }
    }
    return count > 0u ? fmin(1.05 * most, fmax(6.0 * sum / (double)count, 0.1)) : most;
}

static void write_curves(FILE *file, const plot_t *plot)
{
    const track_t *track = &plot->tracks[0];
    chart_line_t lines[CURVES] = {{.name = "one sigma"}, {.name = "error"}};
    if (track->count < 2u) {
        return;
    }
    add_sigmas(&lines[SIGMA], track);
    if (plot->truth != NULL) {
        add_errors(&lines[ERROR], track, plot->truth);
    }
    const chart_t chart = {.title = "How sure, and how right",
                           .subtitle = "one sigma that the track tells, and its distance from the "
                                       "truth, if there is one",
                           .x_name = "time [s]",
                           .y_name = "in the plane [m]",
                           .x_low = seconds(&track->rows[0]),
                           .x_high = seconds(&track->rows[track->count - 1u]),
                           .y_high = height_of(lines),
                           .lines = lines,
                           .line_count = lines[ERROR].count > 0u ? 2u : 1u};
    chart_draw(file, &chart);
    chart_free(&lines[SIGMA]);
    chart_free(&lines[ERROR]);
}

/* ---- words ------------------------------------------------------------------------------ */

/* The summary as it is printed, which knows nothing of HTML. */
static bool write_summary(FILE *file, const summary_t *summary)
{
    FILE *text = tmpfile();
    int c;
    if (text == NULL) {
        return false;
    }
    summary_print(text, summary);
    rewind(text);
    while ((c = getc(text)) != EOF) {
        const char letter[] = {(char)c, '\0'};
        if (c == '\n') {
            putc(c, file);
        } else {
            svg_escape(file, letter);
        }
    }
    return fclose(text) == 0;
}

bool report_write(const report_t *report, const char *path, failure_t *failure)
{
    FILE *file;
    if (!output_open(&file, path, failure)) {
        return false;
    }
    fputs(head, file);
    svg_escape(file, report->plot->title);
    fputs("</title>\n</head>\n<body>\n<h1>", file);
    svg_escape(file, report->plot->title);
    fputs("</h1>\n", file);
    plot_draw(file, report->plot);
    write_curves(file, report->plot);
    fputs("<pre>\n", file);
    bool is_good = write_summary(file, report->summary) ||
                   failure_input(failure, "insole: no room for a temporary file");
    fputs("</pre>\n<p>Insole " INSOLE_VERSION "</p>\n</body>\n</html>\n", file);
    bool is_closed = output_close(file, path, failure);
    return is_good && is_closed;
}
