/* SPDX-License-Identifier: MIT */
#include "estimator.h"

#include <string.h>

bool estimator_init(estimator_t *estimator, const estimator_setup_t *setup)
{
    memset(estimator, 0, sizeof *estimator);
    estimator->is_phone = method_tracker(setup->method) == TRACKER_PHONE;
    return estimator->is_phone ? phone_estimator_init(&estimator->phone, setup)
                               : foot_estimator_init(&estimator->foot, setup);
}

void estimator_free(estimator_t *estimator)
{
    phone_estimator_free(&estimator->phone);
    foot_estimator_free(&estimator->foot);
}

void estimator_push(estimator_t *estimator, const record_t *record)
{
    if (estimator->is_phone) {
        phone_estimator_push(&estimator->phone, record);
    } else {
        foot_estimator_push(&estimator->foot, record);
    }
}

bool estimator_step(estimator_t *estimator)
{
    return estimator->is_phone ? phone_estimator_step(&estimator->phone)
                               : foot_estimator_step(&estimator->foot);
}

bool estimator_take(estimator_t *estimator, track_row_t *fix)
{
    return estimator->is_phone ? phone_estimator_take(&estimator->phone, fix)
                               : foot_estimator_take(&estimator->foot, fix);
}

bool estimator_event(estimator_t *estimator, event_t *event)
{
    return estimator->is_phone ? phone_estimator_event(&estimator->phone, event)
                               : foot_estimator_event(&estimator->foot, event);
}

bool estimator_is_placed(const estimator_t *estimator)
{
    return estimator->is_phone ? phone_estimator_is_placed(&estimator->phone)
                               : foot_estimator_is_placed(&estimator->foot);
}

void estimator_finish(estimator_t *estimator)
{
    if (estimator->is_phone) {
        phone_estimator_finish(&estimator->phone);
    } else {
        foot_estimator_finish(&estimator->foot);
    }
}

void estimator_settle(estimator_t *estimator)
{
    if (!estimator->is_phone) {
        foot_estimator_settle(&estimator->foot);
    }
}
