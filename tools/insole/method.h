/** @file method.h  How the position is made, by name; each tracker has its own methods.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_METHOD_H
#define INSOLE_HOST_METHOD_H

#include "failure.h"
#include "settings.h"

typedef enum {
    TRACKER_FOOT = 0, /**< an IMU on the shoe */
    TRACKER_PHONE     /**< one anywhere else on the body */
} tracker_t;

typedef enum {
    METHOD_BEST = 0,  /**< whatever is given is used as well as we know how */
    METHOD_TWO_ORDER, /**< the second stage of [TwoOrder] as printed */
    METHOD_WIFI,      /**< radio alone */
    METHOD_INS,       /**< first order: inertial navigation with zero-velocity updates */
    METHOD_PDR,       /**< strides of modelled length in the inertial direction */

    METHOD_PHONE_BEST, /**< whatever is given is used as well as we know how */
    METHOD_PHONE_PDR,  /**< steps alone, attitude by [PhoneEKF] */
    METHOD_PDR_GYRO,   /**< steps alone, attitude by the gyro */
    METHOD_WIFI_KDE,   /**< fixes alone, by kernels */
    METHOD_WIFI_ML,    /**< fixes alone, the likeliest fingerprint [WifiShift] II.A */
    METHOD_EKF,        /**< [PhoneEKF] */
    METHOD_UKF,        /**< [PhoneUKF] */
    METHOD_KF_CONST,   /**< rivals of [PhoneUKF] 7.1: constant covariances */
    METHOD_EKF_CONST,
    METHOD_UKF_CONST,
    METHOD_ML_SHIFT, /**< [WifiShift] */
    METHOD_PF,       /**< rivals of [PhoneEKF] 4: particles weighed by the strengths heard */
    METHOD_PF_KDE,   /**< or by the fix of kernels and its covariance */
    METHOD_WPF, /**< rivals of [WifiShift] IV: particles weighed by the likeliest fingerprint */
    METHOD_ZEE, /**< or by walls alone */
    METHODS
} method_t;

/** For help. */
#define METHOD_FOOT_NAMES   "ins, pdr, wifi, two-order or best"
#define METHOD_PHONE_PAPERS "pdr-gyro, pdr, wifi-kde, wifi-ml, ekf, ukf, kf-const, ekf-const"
#define METHOD_PHONE_OTHERS "ukf-const, ml-shift, pf, pf-kde, wpf, zee or best"
#define METHOD_PHONE_NAMES  METHOD_PHONE_PAPERS ", " METHOD_PHONE_OTHERS

bool tracker_parse(const char *name, tracker_t *tracker, failure_t *failure);

/** `foot`, `phone` */
const char *tracker_name(tracker_t tracker);

/** A method of that tracker. */
bool method_parse(tracker_t tracker, const char *name, method_t *method, failure_t *failure);

const char *method_name(method_t method);

tracker_t method_tracker(method_t method);

/** The one of that tracker that the settings ask for where no option does. */
method_t method_of(const settings_t *settings, tracker_t tracker);

/** Is it the inertial filter and nothing else? */
static inline bool method_is_first_order(method_t method)
{
    return method == METHOD_INS || method == METHOD_PDR;
}

/** Does radio alone make the position, so that a log needs no IMU? */
static inline bool method_is_radio_alone(method_t method)
{
    return method == METHOD_WIFI || method == METHOD_WIFI_KDE || method == METHOD_WIFI_ML;
}

/** Has it no use for a radio map? */
static inline bool method_is_steps_alone(method_t method)
{
    return method == METHOD_PHONE_PDR || method == METHOD_PDR_GYRO;
}

#endif
