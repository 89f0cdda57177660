/* SPDX-License-Identifier: MIT */
#include "reproduce.h"

#include <math.h>
#include <string.h>

#include "reproduce_draw.h"

enum { EKF, PDR, PDR_GYRO, WIFI, CLOUD, CLOUD_KDE, OUR_BEST, OUR_BEST_PLAN, OUR_BEST_TOLD, ROWS };

/* The length of a step is the walker's own: C1 of (3) by `calibrate steplength` from walks of seeds
 * 1001 to 1006. */
#define OWN_STEPS "step_length.root_scale=0.4395"

/* The kernels are the paper's; no gate holds fixes off, and the phone points ahead. The radius of
 * (28) is fixed: sigmas add nothing to it. It, the widths of the kernels and the scatters of steps
 * are the best of a grid over seeds 1001 to 1020; so are, for themselves, those of the particle
 * filters and the width for Wi-Fi alone. */
static const char *const settings[] = {OWN_STEPS,
                                       "phone_walk.sigma_length_share=0.1",
                                       "phone_walk.sigma_ahead_rad=0",
                                       "phone_tracker.trust_sigmas=0.001",
                                       "phone_tracker.trust_least_m=2",
                                       "kde_fix.kernel=gauss",
                                       "kde_fix.sigma_db=8",
                                       "kde_fix.point_sigma_m=0.4",
                                       "kde_fix.widen=1",
                                       "step_fusion.gate=1e9",
                                       "plain_cloud.length_share=0.1",
                                       "plain_cloud.sigma_heading_rad=0.25",
                                       NULL};

static const char *const notes[] = {
    "All are told the true start, and err at each footfall. One sensor rate of 100 Hz stands for",
    "the paper's 100 Hz and 50 Hz. Noise of gyroscope and radio was set once, by other seeds, so",
    "that the rows of PDR and of Wi-Fi come within 20 % of what is printed.",
    "The paper's parts are told the length of this walker's steps; our defaults are not, but in "
    "the",
    "last row. All 50 fingerprints lie along the way, which flatters filters that look only at "
    "near",
    "ones, as the paper's does. Figure 9, seconds per step in Matlab, is not measured: tests/bench",
    "counts instructions per call.",
    NULL};

static const reproduce_figure_t columns[] = {REPRODUCE_MEAN, REPRODUCE_STD};

#define PRINTED(mean, std)                                                                         \
    {                                                                                              \
        {                                                                                          \
            [REPRODUCE_MEAN] = mean, [REPRODUCE_STD] = std                                         \
        }                                                                                          \
    }

static const reproduce_row_t rows[ROWS] = {
    [EKF] = {"proposed EKF", METHOD_EKF, .lacks_plan = true, .printed = PRINTED(0.71, 0.37)},
    [PDR] = {"PDR (gyro + acc)", METHOD_PHONE_PDR, .lacks_plan = true,
             .printed = PRINTED(1.24, 0.53)},
    [PDR_GYRO] = {"PDR (gyro)", METHOD_PDR_GYRO, .lacks_plan = true,
                  .printed = PRINTED(1.56, 1.07)},
    [WIFI] = {"Wi-Fi localization", METHOD_WIFI_KDE, .lacks_plan = true,
              .printed = PRINTED(2.83, 2.79), .settings = "kde_fix.sigma_db=5"},
    [CLOUD] = {"particle filter", METHOD_PF, .lacks_plan = true, .printed = PRINTED(0.81, 0.40)},
    [CLOUD_KDE] = {"improved PF", METHOD_PF_KDE, .lacks_plan = true, .printed = PRINTED(0.65, 0.33),
                   .settings = "plain_cloud.length_share=0.2"},
    [OUR_BEST] = {"best", METHOD_PHONE_BEST, .is_ours = true, .lacks_plan = true},
    [OUR_BEST_PLAN] = {"best, with the plan", METHOD_PHONE_BEST, .is_ours = true},
    [OUR_BEST_TOLD] = {"best, own step length", METHOD_PHONE_BEST, .is_ours = true,
                       .lacks_plan = true, .settings = OWN_STEPS}};

static const reproduce_claim_t claims[] = {
    {EKF, PDR, REPRODUCE_MEAN, false, "the paper: 42.7 % lower"},
    {EKF, PDR, REPRODUCE_STD, false, "the paper: 30.2 % lower"},
    {EKF, PDR_GYRO, REPRODUCE_MEAN, false, "the paper: 54.5 % lower"},
    {EKF, PDR_GYRO, REPRODUCE_STD, false, "the paper: 65.4 % lower"},
    {EKF, WIFI, REPRODUCE_MEAN, false, "the paper: 74.9 % lower"},
    {EKF, WIFI, REPRODUCE_STD, false, "the paper: 86.7 % lower"},
    {EKF, CLOUD, REPRODUCE_MEAN, false, "the paper: 12.3 % lower"},
    {EKF, CLOUD, REPRODUCE_STD, false, "the paper: 7.5 % lower"},
    {EKF, CLOUD_KDE, REPRODUCE_MEAN, false, "the paper: 9.2 % higher"},
    {PDR, PDR_GYRO, REPRODUCE_MEAN, false, "the paper: 20.5 % lower"},
    {OUR_BEST, EKF, REPRODUCE_MEAN, false, "ours against the paper's, measured"},
    {OUR_BEST, EKF, REPRODUCE_MEAN, true, "and as printed"},
    {OUR_BEST_PLAN, OUR_BEST, REPRODUCE_MEAN, false, "what the plan gives"},
    {OUR_BEST_TOLD, OUR_BEST, REPRODUCE_MEAN, false, "what a calibrated step length gives"}};

/* ---- figure 5: the legs of the walk ----------------------------------------------------- */

static const double quarter_rad = 1.5707963267948966;

/* Nearer footfalls tell no direction. */
static const double shortest_m = 0.3;

enum { LEGS = 7 };

/* From a footfall to the next. @return false when the walker has hardly moved */
static bool find_direction(const track_t *steps, size_t i, double *direction_rad)
{
    double x_m = steps->rows[i + 1u].x_m - steps->rows[i].x_m;
    double y_m = steps->rows[i + 1u].y_m - steps->rows[i].y_m;
    *direction_rad = atan2(y_m, x_m);
    return hypot(x_m, y_m) >= shortest_m;
}

static void add_step(track_t *leg, const track_t *steps, size_t i)
{
    if (leg->count == 0u) {
        track_add(leg, &steps->rows[i]);
    }
    track_add(leg, &steps->rows[i + 1u]);
}

/* All walls and ways of the building are at right angles: a leg ends where a quarter turn begins.
 * @return how many there are */
static size_t cut_legs(const track_t *steps, track_t legs[LEGS])
{
    size_t count = 0u;
    int quarter = 0;
    for (size_t i = 0u; i + 1u < steps->count; i++) {
        double direction_rad;
        if (find_direction(steps, i, &direction_rad)) {
            int here = (int)lround(direction_rad / quarter_rad) & 3;
            count += count == 0u || (here != quarter && count < LEGS) ? 1u : 0u;
            quarter = here;
            add_step(&legs[count - 1u], steps, i);
        }
    }
    return count;
}

static bool draw_legs(const reproduction_t *reproduction, failure_t *failure)
{
    static const char *const labels[LEGS] = {"leg 1", "leg 2", "leg 3", "leg 4",
                                             "leg 5", "leg 6", "leg 7"};
    static const reproduce_picture_t picture = {"figure5.svg", "The walk in seven legs",
                                                "As figure 5 of [PhoneEKF], the first walk"};
    track_t legs[LEGS];
    memset(legs, 0, sizeof legs);
    size_t count = cut_legs(&reproduction->truth, legs);
    bool is_good = reproduce_draw_ways(reproduction, legs, labels, count, &picture, failure);
    for (size_t i = 0u; i < LEGS; i++) {
        track_free(&legs[i]);
    }
    return is_good;
}

/* ---- figure 6: heading ------------------------------------------------------------------ */

enum { BOTH, GYRO, TRUTH, LINES };

/* Of all angles that are the same direction the nearest. */
static double unwound_deg(double heading_rad, double near_deg)
{
    return near_deg + remainder(90.0 * heading_rad / quarter_rad - near_deg, 360.0);
}

static void add_headings(chart_line_t *line, const reproduction_t *reproduction, int row)
{
    const track_t *track = &reproduction->tracks[row];
    double last_deg = 0.0;
    for (size_t i = 0u; i < track->count; i++) {
        double t_s = 1e-6 * (double)track->rows[i].t_us;
        if (t_s >= reproduction->paper->begin_s) {
            last_deg = unwound_deg(track->rows[i].heading_rad, last_deg);
            chart_add(line, t_s, last_deg);
        }
    }
}

/* Of a turn by half a circle the footfalls do not tell whether it was to the left: the gyro does.
 */
static void add_truth(chart_line_t *line, const track_t *steps, const chart_line_t *turned)
{
    size_t k = 0u;
    for (size_t i = 0u; turned->count > 0u && i + 1u < steps->count; i++) {
        double direction_rad, begin_s = 1e-6 * (double)steps->rows[i].t_us;
        while (k + 1u < turned->count && turned->points[k].x < begin_s) {
            k++;
        }
        if (find_direction(steps, i, &direction_rad)) {
            double shown_deg = unwound_deg(direction_rad, turned->points[k].y);
            chart_add(line, begin_s, shown_deg);
            chart_add(line, 1e-6 * (double)steps->rows[i + 1u].t_us, shown_deg);
        }
    }
}

static const double margin_deg = 30.0;

static void frame(chart_t *chart, const chart_line_t *line)
{
    for (size_t i = 0u; i < line->count; i++) {
        chart->y_low = fmin(chart->y_low, line->points[i].y - margin_deg);
        chart->y_high = fmax(chart->y_high, line->points[i].y + margin_deg);
    }
}

static bool draw_headings(const reproduction_t *reproduction, failure_t *failure)
{
    static const reproduce_picture_t picture = {"figure6.svg", "Direction of the walk",
                                                "As figure 6 of [PhoneEKF], the first walk"};
    chart_line_t lines[LINES] = {[BOTH] = {.name = "gyro + acc"},
                                 [GYRO] = {.name = "gyro"},
                                 [TRUTH] = {.name = "truth, step by step"}};
    const track_t *steps = &reproduction->truth;
    add_headings(&lines[BOTH], reproduction, PDR);
    add_headings(&lines[GYRO], reproduction, PDR_GYRO);
    add_truth(&lines[TRUTH], steps, &lines[BOTH]);
    chart_t chart = {.x_name = "t [s]",
                     .y_name = "degrees from x, to the left",
                     .x_low = reproduction->paper->begin_s,
                     .x_high = 1e-6 * (double)steps->rows[steps->count - 1u].t_us,
                     .lines = lines,
                     .line_count = LINES};
    frame(&chart, &lines[TRUTH]);
    bool is_good = reproduce_draw_chart(reproduction, &chart, &picture, failure);
    for (int i = 0; i < LINES; i++) {
        chart_free(&lines[i]);
    }
    return is_good;
}

/* ---- the paper -------------------------------------------------------------------------- */

static bool draw_walk(const reproduction_t *reproduction, failure_t *failure)
{
    return draw_legs(reproduction, failure) && draw_headings(reproduction, failure);
}

static const reproduce_drawing_t drawings[] = {
    {.picture = {"figure7.svg", "The walk by four methods",
                 "As figure 7 of [PhoneEKF], the first walk"},
     .rows = {EKF, PDR, PDR_GYRO, WIFI},
     .count = 4},
    {.picture = {"figure7b.svg", "The walk by our defaults", "The first walk; not in the paper"},
     .rows = {EKF, OUR_BEST, OUR_BEST_PLAN},
     .count = 3},
    {.picture = {"figure8.svg", "How many errors are how small",
                 "As figure 8 of [PhoneEKF], all walks"},
     .shown_m = 8.0,
     .rows = {EKF, PDR, PDR_GYRO, WIFI, CLOUD, CLOUD_KDE},
     .count = 6}};

static const reproduce_more_t more = {.draw_walk = draw_walk};

const reproduce_paper_t reproduce_phone_ekf = {.name = "PhoneEKF",
                                               .table = "table 1",
                                               .scenario = "office/phone_ekf.scenario",
                                               .survey = "office/phone_ekf_survey",
                                               .runs = 20,
                                               .begin_s = 3.0,
                                               .scored = REPRODUCE_AT_STEPS,
                                               REPRODUCE_TABLE(columns, rows, claims, drawings),
                                               .settings = settings,
                                               .notes = notes,
                                               .more = &more};
