/** @file method.h  How the position is made, by name.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_METHOD_H
#define INSOLE_HOST_METHOD_H

#include "failure.h"
#include "settings.h"

typedef enum {
    METHOD_BEST = 0,  /**< whatever is given is used as well as we know how */
    METHOD_TWO_ORDER, /**< the second stage of [TwoOrder] as printed */
    METHOD_WIFI,      /**< radio alone */
    METHOD_INS,       /**< first order: inertial navigation with zero-velocity updates */
    METHOD_PDR        /**< strides of modelled length in the inertial direction */
} method_t;

/** For help. */
#define METHOD_NAMES "ins, pdr, wifi, two-order or best"

bool method_parse(const char *name, method_t *method, failure_t *failure);

const char *method_name(method_t method);

/** The one that the settings ask for where no option does. */
method_t method_of(const settings_t *settings);

/** Is it the inertial filter and nothing else? */
static inline bool method_is_first_order(method_t method)
{
    return method == METHOD_INS || method == METHOD_PDR;
}

#endif
