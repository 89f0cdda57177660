/* SPDX-License-Identifier: MIT */
#include "reproduce_wifi_shift.h"

/* What is the same for all of the paper's rows. */
#define PARTS "phone_parts.fix=ml", "ml_fix.density=gauss", "ml_fix.answer=likeliest"

/* lambda and epsilon as printed; sigma and sigma* by a grid search on seeds 1001 to 1004. */
#define SHIFT                                                                                      \
    PARTS, "auto_start.fixes=5", "auto_start.refine_rad=3.2", "ml_shift.window=4",                 \
        "ml_shift.pdr=constant", "ml_shift.radio=constant", "ml_shift.sigma_radio_m=6"

static const char *const proposed[] = {SHIFT, "ml_shift.sigma_pdr_m=6", "auto_start.method=circles",
                                       NULL};
static const char *const as_printed[] = {SHIFT, "auto_start.method=circles", "ml_shift.pdr=strides",
                                         "ml_shift.radio=distances", NULL};
static const char *const moved[] = {SHIFT, "ml_shift.sigma_pdr_m=3", "auto_start.method=moved",
                                    "auto_start.refine_rad=0.5", NULL};
static const char *const parts[] = {PARTS, NULL};
static const char *const open[] = {PARTS, "wpf.walls=off", NULL};
static const char *const fresh[] = {PARTS, "wpf.sigma_wander_rad=0", NULL};
static const char *const none[] = {NULL};

const int wifi_shift_counts[WIFI_SHIFT_COUNTS] = {24, 20, 15};

enum { PROPOSED, AS_PRINTED, MOVED, WPF, WPF_OPEN, WPF_FRESH, ZEE, ZEE_ANYWHERE, ML, PDR, BEST };

#define UNKNOWN                                                                                    \
    {                                                                                              \
        NUMBER_UNKNOWN, NUMBER_UNKNOWN                                                             \
    }
#define MEAN(mean_m)                                                                               \
    {                                                                                              \
        mean_m, NUMBER_UNKNOWN                                                                     \
    }
#define NONE                                                                                       \
    {                                                                                              \
        UNKNOWN, UNKNOWN, UNKNOWN                                                                  \
    }

/* clang-format off */
const wifi_shift_row_t wifi_shift_rows[WIFI_SHIFT_ROWS] = {
    [PROPOSED] = {"proposed", METHOD_ML_SHIFT, false, false, true, proposed,
                  {{{2.76, 2.88}, {2.57, 2.51}, {2.81, 2.73}},
                   {MEAN(3.36), MEAN(3.03), MEAN(3.25)},
                   {MEAN(4.76), MEAN(4.21), MEAN(4.35)}}},
    [AS_PRINTED] = {"proposed, sigmas as printed", METHOD_ML_SHIFT, false, false, false,
                    as_printed, {NONE, NONE, NONE}},
    [MOVED] = {"proposed, start by moved", METHOD_ML_SHIFT, false, false, true, moved,
               {NONE, NONE, NONE}},
    [WPF] = {"WPF, true start", METHOD_WPF, true, false, true, parts,
             {{{4.45, 3.51}, {4.63, 4.68}, {5.01, 4.60}},
              {MEAN(5.25), MEAN(5.41), MEAN(5.91)},
              {MEAN(7.65), MEAN(7.52), MEAN(8.05)}}},
    [WPF_OPEN] = {"WPF without walls", METHOD_WPF, true, false, false, open, {NONE, NONE, NONE}},
    [WPF_FRESH] = {"WPF, directions anew", METHOD_WPF, true, false, true, fresh,
                   {NONE, NONE, NONE}},
    [ZEE] = {"Zee", METHOD_ZEE, false, false, false, parts,
             {{{6.52, 3.58}, {7.64, 3.74}, {9.15, 4.23}}, NONE, NONE}},
    [ZEE_ANYWHERE] = {"Zee without radio", METHOD_ZEE, false, true, false, parts,
                      {NONE, NONE, NONE}},
    [ML] = {"fingerprint-ML", METHOD_WIFI_ML, false, false, true, parts,
            {{{6.56, 4.53}, {7.10, 4.87}, {7.66, 4.82}},
             {MEAN(7.98), MEAN(8.55), MEAN(9.15)},
             {MEAN(11.68), MEAN(11.53), MEAN(12.26)}}},
    [PDR] = {"steps alone, true start", METHOD_PHONE_PDR, true, true, false, parts,
             {NONE, NONE, NONE}},
    [BEST] = {"best, by our defaults", METHOD_PHONE_BEST, false, false, true, none,
              {NONE, NONE, NONE}}};
/* clang-format on */

static const wifi_shift_claim_t claims[] = {{PROPOSED, WPF, 0.65},    {PROPOSED, ZEE, 0.45},
                                            {PROPOSED, ML, 0.45},     {PROPOSED, WPF_FRESH, 0.65},
                                            {MOVED, WPF_FRESH, 0.65}, {MOVED, ZEE, 0.45},
                                            {MOVED, ML, 0.45},        {BEST, WPF, 0.65},
                                            {BEST, ZEE, 0.45},        {BEST, ML, 0.45}};

const wifi_shift_claim_t *wifi_shift_claims(int *count)
{
    *count = (int)(sizeof claims / sizeof claims[0]);
    return claims;
}
