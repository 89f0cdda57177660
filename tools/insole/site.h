/** @file site.h  A building ready for the trackers: plan, access points and fingerprints, in memory
 *         of their own.
 *
 *      static site_t site;
 *      if (site_open(&site, "plan.csv", "aps.csv", "radiomap.csv", &propagation, &failure)) ...
 *          insole_rss_field_hear(&field, &site.building, readings, count);
 *          id = ap_file_number(&site.ap_file, &log_ids, record.id);
 *      site_free(&site);
 *
 *  An open site points into itself: it stays where it is.
 *
 *  SPDX-License-Identifier: MIT
 */
#ifndef INSOLE_HOST_SITE_H
#define INSOLE_HOST_SITE_H

#include "ap_file.h"
#include "insole/place/rss_field.h"
#include "plan_file.h"
#include "radiomap_file.h"

typedef struct {
    plan_file_t plan_file;         /**< all zero without a plan */
    ap_file_t ap_file;             /**< all zero without access points */
    radiomap_file_t radiomap_file; /**< all zero without fingerprints: no points in its map */
    insole_floor_plan_memory_t memory;
    insole_floor_plan_t plan;   /**< the first floor of the file */
    insole_building_t building; /**< its `plan` is NULL without a plan */
} site_t;

/** @param plan_path, aps_path, radiomap_path  NULL: none. A plan must have an outline.
 *  @param propagation  settings that have passed their check; they must last as long as the site.
 *                      A refusal leaves nothing to free. */
bool site_open(site_t *site, const char *plan_path, const char *aps_path, const char *radiomap_path,
               const insole_propagation_config_t *propagation, failure_t *failure);

/** The same for a plan that is to be looked at or sent through by radio, not walked in: it may lack
 *  its outline. */
bool site_open_sketch(site_t *site, const char *plan_path, const char *aps_path,
                      const insole_propagation_config_t *propagation, failure_t *failure);

bool site_has_radiomap(const site_t *site);

/** Is this one of the files the site was read from, which must not be written? */
bool site_is_file(const site_t *site, const char *path);

/** Cells of the plan's grid, and one that closes the table. */
size_t site_cell_count(const insole_floor_plan_t *plan);

/** Entries of the plan's grid. */
size_t site_entry_count(const insole_floor_plan_t *plan);

/** Bytes of walls, cells and entries, as they would lie in flash. */
size_t site_plan_bytes(const insole_floor_plan_t *plan);

void site_free(site_t *site);

#endif
