/* SPDX-License-Identifier: MIT */
#include "estimator_setup.h"

#include <string.h>

#include "convert.h"

insole_start_t estimator_start(const record_t *record)
{
    const double *v = record->value;
    insole_start_t start;
    memset(&start, 0, sizeof start);
    start.t_us = to_library_us(record->t_us);
    start.x_m = to_real(v[0]);
    start.y_m = to_real(v[1]);
    start.has_heading = !isnan(v[2]);
    start.heading_rad = start.has_heading ? to_real(v[2]) : INSOLE_R(0.0);
    start.sigma_m = to_real(isnan(v[3]) ? START_SIGMA_M : v[3]);
    start.sigma_rad = to_real(isnan(v[4]) ? START_SIGMA_RAD : v[4]);
    return start;
}

insole_imu_t estimator_imu(const record_t *record, const settings_t *settings)
{
    const double *v = record->value;
    insole_imu_t imu = {to_library_us(record->t_us),
                        {to_real(v[0]), to_real(v[1]), to_real(v[2])},
                        {to_real(v[3]), to_real(v[4]), to_real(v[5])}};
    settings_correct(&settings->sensor, &imu);
    return imu;
}

void estimator_row(const insole_fix_t *fix, track_row_t *row)
{
    row->t_us = to_log_us(fix->t_us);
    row->x_m = (double)fix->position_m.x;
    row->y_m = (double)fix->position_m.y;
    row->z_m = (double)fix->position_m.z;
    row->heading_rad = (double)fix->heading_rad;
    row->var_x_m2 = (double)fix->var_x_m2;
    row->cov_xy_m2 = (double)fix->cov_xy_m2;
    row->var_y_m2 = (double)fix->var_y_m2;
    row->var_z_m2 = (double)fix->var_z_m2;
    row->var_heading_rad2 = (double)fix->var_heading_rad2;
    row->state = fix->state;
}
