/* SPDX-License-Identifier: MIT */
#include "insole/track/phone_radio.h"

#include <stddef.h>

static bool is_whole(const insole_radio_solver_t *solver)
{
    const insole_radio_solver_calls_t *calls = solver->calls;
    return !calls || (solver->state && calls->begin && calls->work && calls->finish);
}

INSOLE_COLD insole_status_t insole_phone_radio_init(insole_phone_radio_t *radio,
                                                    const insole_radio_solver_t *solver,
                                                    const insole_radio_map_t *map,
                                                    insole_real_t late_s)
{
    if (!radio || !solver) {
        return INSOLE_ERR_NULL;
    }
    if (!is_whole(solver) || !(late_s >= INSOLE_R(0.0) && late_s <= INSOLE_R(10.0))) {
        return INSOLE_ERR_VALUE;
    }
    *radio = (insole_phone_radio_t){
        .solver = *solver, .map = map, .late_us = (uint32_t)(late_s * INSOLE_R(1.0e6))};
    return INSOLE_OK;
}

bool insole_phone_radio_can_hear(const insole_phone_radio_t *radio)
{
    return radio->solver.calls && radio->map;
}

/* The age of the youngest reading counts, less what a radio is late by. */
static uint64_t heard_at(const insole_phone_radio_t *radio, const insole_scan_t *scan)
{
    uint64_t age_us = scan->count > 0u ? scan->readings[0].age_us : 0u;
    for (uint32_t i = 1u; i < scan->count; i++) {
        age_us = scan->readings[i].age_us < age_us ? scan->readings[i].age_us : age_us;
    }
    age_us = age_us > radio->late_us ? age_us - radio->late_us : 0u;
    return scan->t_us > age_us ? scan->t_us - age_us : 0u;
}

insole_status_t insole_phone_radio_hear(insole_phone_radio_t *radio, const insole_scan_t *scan,
                                        const insole_trusted_area_t *area)
{
    if (!radio || !scan || (!scan->readings && scan->count > 0u)) {
        return INSOLE_ERR_NULL;
    }
    if (!insole_phone_radio_can_hear(radio)) {
        return INSOLE_ERR_STATE;
    }
    radio->given_up += radio->in_work ? 1u : 0u;
    radio->in_work = false;
    radio->scans++;
    insole_status_t status = radio->solver.calls->begin(radio->solver.state, radio->map, area,
                                                        scan->readings, scan->count);
    if (status != INSOLE_OK) {
        radio->unplaced++;
        return status;
    }
    radio->in_work = true;
    radio->work_us = scan->t_us;
    radio->work_heard_us = heard_at(radio, scan);
    return INSOLE_OK;
}

static void finish(insole_phone_radio_t *radio)
{
    insole_radio_fix_t fix;
    radio->in_work = false;
    if (radio->solver.calls->finish(radio->solver.state, radio->map, &fix) != INSOLE_OK) {
        radio->unplaced++;
        return;
    }
    radio->fix = fix;
    radio->t_us = radio->work_us;
    radio->heard_us = radio->work_heard_us;
    radio->has_fix = radio->is_new = true;
    radio->fixes++;
}

bool insole_phone_radio_work(insole_phone_radio_t *radio, uint32_t points)
{
    if (!radio || !radio->in_work || points == 0u) {
        return false;
    }
    if (!radio->solver.calls->work(radio->solver.state, radio->map, points)) {
        finish(radio);
    }
    return radio->in_work;
}

INSOLE_COLD bool insole_phone_radio_take(insole_phone_radio_t *radio)
{
    bool is_new = radio && radio->is_new;
    if (is_new) {
        radio->is_new = false;
    }
    return is_new;
}
