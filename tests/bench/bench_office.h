/** @file bench_office.h  Offices of equal density and different size, drawn piece by piece, with
 *  eight access points.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_TESTS_BENCH_OFFICE_H
#define INSOLE_TESTS_BENCH_OFFICE_H

#include "bench.h"

enum { BENCH_APS = 8 };

/** What is known of the office that was built last, and what was heard in it last. */
extern const insole_building_t bench_building;
extern insole_rss_t bench_readings[BENCH_APS];

/** 11 walls for each column of each row. */
void bench_build_office(uint32_t columns, uint32_t rows);

void bench_put_aps(void);

/** A scan of all access points by a walker there. */
void bench_listen(insole_spot_t at, insole_real_t way_rad);

#endif
