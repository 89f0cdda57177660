/* SPDX-License-Identifier: MIT */
#include "method.h"

#include <string.h>

static const char *const trackers[] = {"foot", "phone"};

static const char *const names[METHODS] = {[METHOD_BEST] = "best",
                                           [METHOD_TWO_ORDER] = "two-order",
                                           [METHOD_WIFI] = "wifi",
                                           [METHOD_INS] = "ins",
                                           [METHOD_PDR] = "pdr",
                                           [METHOD_PHONE_BEST] = "best",
                                           [METHOD_PHONE_PDR] = "pdr",
                                           [METHOD_PDR_GYRO] = "pdr-gyro",
                                           [METHOD_WIFI_KDE] = "wifi-kde",
                                           [METHOD_WIFI_ML] = "wifi-ml",
                                           [METHOD_EKF] = "ekf",
                                           [METHOD_UKF] = "ukf",
                                           [METHOD_KF_CONST] = "kf-const",
                                           [METHOD_EKF_CONST] = "ekf-const",
                                           [METHOD_UKF_CONST] = "ukf-const",
                                           [METHOD_ML_SHIFT] = "ml-shift",
                                           [METHOD_PF] = "pf",
                                           [METHOD_PF_KDE] = "pf-kde",
                                           [METHOD_WPF] = "wpf",
                                           [METHOD_ZEE] = "zee"};

bool tracker_parse(const char *name, tracker_t *tracker, failure_t *failure)
{
    for (int i = TRACKER_FOOT; i <= TRACKER_PHONE; i++) {
        if (strcmp(name, trackers[i]) == 0) {
            *tracker = (tracker_t)i;
            return true;
        }
    }
    return failure_usage(failure, "insole: --tracker %.40s: expected foot or phone", name);
}

const char *tracker_name(tracker_t tracker)
{
    return trackers[tracker];
}

tracker_t method_tracker(method_t method)
{
    return method < METHOD_PHONE_BEST ? TRACKER_FOOT : TRACKER_PHONE;
}

/* The user may have meant the other tracker. */
static bool refuse(tracker_t tracker, const char *name, failure_t *failure)
{
    bool is_of_phone = false;
    for (int i = METHOD_PHONE_BEST; tracker == TRACKER_FOOT && i < METHODS; i++) {
        is_of_phone = is_of_phone || strcmp(name, names[i]) == 0;
    }
    return failure_usage(failure, "insole: --method %.40s: expected %s%s", name,
                         tracker == TRACKER_FOOT ? METHOD_FOOT_NAMES : METHOD_PHONE_NAMES,
                         is_of_phone ? "; with --tracker phone it is a method" : "");
}

bool method_parse(tracker_t tracker, const char *name, method_t *method, failure_t *failure)
{
    for (int i = 0; i < METHODS; i++) {
        if (method_tracker((method_t)i) == tracker && strcmp(name, names[i]) == 0) {
            *method = (method_t)i;
            return true;
        }
    }
    return refuse(tracker, name, failure);
}

const char *method_name(method_t method)
{
    return names[method];
}

method_t method_of(const settings_t *settings, tracker_t tracker)
{
    static const method_t fused[] = {[INSOLE_FUSION_BEST] = METHOD_BEST,
                                     [INSOLE_FUSION_TWO_ORDER] = METHOD_TWO_ORDER,
                                     [INSOLE_FUSION_WIFI] = METHOD_WIFI};
    return tracker == TRACKER_PHONE ? METHOD_PHONE_BEST : fused[settings->fusion.method];
}
