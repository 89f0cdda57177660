/* SPDX-License-Identifier: MIT */
#include "pack_writer.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "c_text.h"

enum { LINE_WIDTH = 96 };

typedef struct {
    FILE *file;
    const site_t *site;
    const char *name;
} writer_t;

bool pack_is_name(const char *name)
{
    size_t length = strlen(name);
    if (length == 0u || length > PACK_NAME_LENGTH || !isalpha((unsigned char)name[0])) {
        return false;
    }
    for (size_t i = 0u; i < length; i++) {
        if ((unsigned char)name[i] > 0x7fu ||
            (!isalnum((unsigned char)name[i]) && name[i] != '_')) {
            return false;
        }
    }
    return true;
}

/* ---- numbers ----------------------------------------------------------------------------- */

/* Writes `{a, b, ...}`. */
static void write_reals(FILE *file, const insole_real_t *values, size_t count)
{
    char buffer[C_REAL_ROOM];
    for (size_t i = 0u; i < count; i++) {
        fprintf(file, "%s%s", i == 0u ? "{" : ", ", c_real(buffer, values[i]));
    }
    putc('}', file);
}

/* ---- plan ------------------------------------------------------------------------------- */

static void write_walls(const writer_t *writer)
{
    const insole_floor_plan_t *plan = &writer->site->plan;
    fprintf(writer->file, "static const insole_wall_t %s_walls[%u] = {\n", writer->name,
            (unsigned)plan->wall_count);
    for (size_t i = 0u; i < plan->wall_count; i++) {
        const insole_wall_t *wall = &plan->walls[i];
        const insole_real_t values[5] = {wall->x0_m, wall->y0_m, wall->x1_m, wall->y1_m,
                                         wall->loss_db};
        fputs("    ", writer->file);
        write_reals(writer->file, values, 5u);
        fputs(",\n", writer->file);
    }
    fputs("};\n\n", writer->file);
}

/* Begins a new line where the next item would not fit. */
static void write_item(FILE *file, const char *item, size_t *column)
{
    size_t length = strlen(item);
    if (*column + length + 1u > LINE_WIDTH) {
        *column = 0u;
    }
    fprintf(file, "%s%s", *column > 0u ? " " : "\n    ", item);
    *column += *column > 0u ? length + 1u : length + 4u;
}

static void write_cells(const writer_t *writer)
{
    char item[NUMBER_ROOM];
    size_t column = 0u, count = site_cell_count(&writer->site->plan);
    fprintf(writer->file, "static const insole_floor_plan_cell_t %s_cells[%lu] = {", writer->name,
            (unsigned long)count);
    for (size_t i = 0u; i < count; i++) {
        const insole_floor_plan_cell_t *cell = &writer->site->plan.cells[i];
        snprintf(item, sizeof item, "{%u, %u, %u},", cell->begin, cell->outlines, cell->holes);
        write_item(writer->file, item, &column);
    }
    fputs("\n};\n\n", writer->file);
}

/* Whole numbers, whose value `at` tells. */
static void write_table(const writer_t *writer, const char *type, const char *table, size_t count,
                        uint32_t (*at)(const site_t *site, size_t i))
{
    char item[NUMBER_ROOM];
    size_t column = 0u;
    fprintf(writer->file, "static const %s %s_%s[%lu] = {", type, writer->name, table,
            (unsigned long)count);
    for (size_t i = 0u; i < count; i++) {
        snprintf(item, sizeof item, "%lu,", (unsigned long)at(writer->site, i));
        write_item(writer->file, item, &column);
    }
    fputs("\n};\n\n", writer->file);
}

static uint32_t entry_at(const site_t *site, size_t i)
{
    return site->plan.entries[i];
}

static void write_plan(const writer_t *writer)
{
    const insole_floor_plan_t *plan = &writer->site->plan;
    const struct {
        const char *name;
        insole_real_t value;
    } reals[] = {{"origin_x_m", plan->origin_x_m}, {"origin_y_m", plan->origin_y_m},
                 {"cell_m", plan->cell_m},         {"cells_per_m", plan->cells_per_m},
                 {"spot_x", plan->spot_x},         {"spot_y", plan->spot_y}};
    char buffer[C_REAL_ROOM];
    write_walls(writer);
    write_cells(writer);
    write_table(writer, "uint16_t", "entries", site_entry_count(plan), entry_at);
    fprintf(writer->file, "const insole_floor_plan_t %s_plan = {\n", writer->name);
    for (size_t i = 0u; i < sizeof reals / sizeof reals[0]; i++) {
        fprintf(writer->file, "    .%s = %s,\n", reals[i].name, c_real(buffer, reals[i].value));
    }
    fprintf(writer->file,
            "    .columns = %u,\n    .rows = %u,\n    .outline_walls = %u,\n    .ring_walls = %u,\n"
            "    .wall_count = %u,\n    .walls = %s_walls,\n    .cells = %s_cells,\n"
            "    .entries = %s_entries,\n};\n",
            plan->columns, plan->rows, plan->outline_walls, plan->ring_walls, plan->wall_count,
            writer->name, writer->name, writer->name);
}

/* ---- access points ---------------------------------------------------------------------- */

static void write_names(const writer_t *writer, const char *table, const id_table_t *ids)
{
    fprintf(writer->file, "const char *const %s_%s[%lu] = {\n", writer->name, table,
            (unsigned long)ids->count);
    for (size_t i = 0u; i < ids->count; i++) {
        fputs("    ", writer->file);
        c_write_string(writer->file, ids->names[i]);
        fputs(",\n", writer->file);
    }
    fputs("};\n", writer->file);
}

static void write_aps(const writer_t *writer)
{
    const ap_file_t *aps = &writer->site->ap_file;
    FILE *file = writer->file;
    unsigned long count = (unsigned long)aps->count;
    fprintf(file, "const uint32_t %s_ap_count = %lu;\n\n", writer->name, count);
    fprintf(file, "const insole_ap_t %s_aps[%lu] = {\n", writer->name, count);
    for (size_t i = 0u; i < aps->count; i++) {
        const insole_ap_t *ap = &aps->aps[i];
        const insole_real_t values[6] = {ap->x_m,    ap->y_m,      ap->z_m,
                                         ap->p0_dbm, ap->exponent, ap->near_dbm};
        fputs("    ", file);
        write_reals(file, values, 6u);
        fputs(",\n", file);
    }
    fputs("};\n\n", file);
    write_names(writer, "ap_ids", &aps->ids);
}

/* ---- fingerprints ----------------------------------------------------------------------- */

#define MAP_COLUMN(name, member)                                                                   \
    static uint32_t name(const site_t *site, size_t i)                                             \
    {                                                                                              \
        return site->radiomap_file.map.member[i];                                                  \
    }

MAP_COLUMN(first_at, first)
MAP_COLUMN(visits_at, visits)
MAP_COLUMN(ap_at, aps)
MAP_COLUMN(below_at, below)
MAP_COLUMN(spread_at, spread)
MAP_COLUMN(count_at, counts)

static void write_spots(const writer_t *writer)
{
    const insole_radio_map_t *map = &writer->site->radiomap_file.map;
    fprintf(writer->file, "static const insole_spot_t %s_map_spots[%lu] = {\n", writer->name,
            (unsigned long)map->point_count);
    for (uint32_t i = 0u; i < map->point_count; i++) {
        const insole_real_t values[2] = {map->spots[i].x_m, map->spots[i].y_m};
        fputs("    ", writer->file);
        write_reals(writer->file, values, 2u);
        fputs(",\n", writer->file);
    }
    fputs("};\n\n", writer->file);
}

static void write_radiomap(const writer_t *writer)
{
    const insole_radio_map_t *map = &writer->site->radiomap_file.map;
    size_t points = map->point_count, entries = map->first[points];
    const struct {
        const char *type, *member, *table;
        size_t count; /* 0: the map does not know */
        uint32_t (*at)(const site_t *site, size_t i);
    } tables[] = {
        {"uint32_t", "first", "map_first", points + 1u, first_at},
        {"uint8_t", "visits", "map_visits", map->visits != NULL ? points : 0u, visits_at},
        {"uint16_t", "aps", "map_aps", entries, ap_at},
        {"uint8_t", "below", "map_below", entries, below_at},
        {"uint8_t", "spread", "map_spread", map->spread != NULL ? entries : 0u, spread_at},
        {"uint8_t", "counts", "map_counts", map->counts != NULL ? entries : 0u, count_at}};
    write_spots(writer);
    for (size_t i = 0u; i < sizeof tables / sizeof tables[0]; i++) {
        if (tables[i].count > 0u) {
            write_table(writer, tables[i].type, tables[i].table, tables[i].count, tables[i].at);
        }
    }
    fprintf(writer->file,
            "const insole_radio_map_t %s_map = {\n    .point_count = %lu,\n    .ap_count = %lu,\n"
            "    .spots = %s_map_spots,\n",
            writer->name, (unsigned long)points, (unsigned long)map->ap_count, writer->name);
    for (size_t i = 0u; i < sizeof tables / sizeof tables[0]; i++) {
        if (tables[i].count > 0u) {
            fprintf(writer->file, "    .%s = %s_%s,\n", tables[i].member, writer->name,
                    tables[i].table);
        }
    }
    fputs("};\n\n", writer->file);
    write_names(writer, "map_ids", &writer->site->radiomap_file.ids);
}

/* ---- file ------------------------------------------------------------------------------- */

/* What other files may say to use the tables; it stands here too, so that the compiler compares. */
static void write_declarations(const writer_t *writer)
{
    FILE *file = writer->file;
    if (writer->site->building.plan != NULL) {
        fprintf(file, "extern const insole_floor_plan_t %s_plan;\n", writer->name);
    }
    if (writer->site->ap_file.count > 0u) {
        unsigned long count = (unsigned long)writer->site->ap_file.count;
        fprintf(file,
                "extern const uint32_t %s_ap_count;\nextern const insole_ap_t %s_aps[%lu];\n"
                "extern const char *const %s_ap_ids[%lu];\n",
                writer->name, writer->name, count, writer->name, count);
    }
    if (site_has_radiomap(writer->site)) {
        fprintf(
            file,
            "extern const insole_radio_map_t %s_map;\nextern const char *const %s_map_ids[%lu];\n",
            writer->name, writer->name, (unsigned long)writer->site->radiomap_file.ids.count);
    }
}

/* The files that it was made from. */
static void write_sources(const writer_t *writer)
{
    const site_t *site = writer->site;
    const char *const names[] = {
        site->building.plan != NULL ? site->plan_file.name : NULL,
        site->ap_file.count > 0u ? site->ap_file.name : NULL,
        site_has_radiomap(site) ? site->radiomap_file.name : NULL,
    };
    bool is_first = true;
    for (size_t i = 0u; i < sizeof names / sizeof names[0]; i++) {
        if (names[i] != NULL) {
            fputs(is_first ? "" : " and ", writer->file);
            c_write_comment(writer->file, names[i]);
            is_first = false;
        }
    }
}

static void write_head(const writer_t *writer)
{
    const site_t *site = writer->site;
    fputs("/* Made by `insole pack` from ", writer->file);
    write_sources(writer);
    fprintf(writer->file,
            ": change those, not this.\n"
            " * The plan takes %lu bytes, the access points %lu and their ids",
            (unsigned long)(site->building.plan != NULL ? site_plan_bytes(&site->plan) : 0u),
            (unsigned long)(site->ap_file.count * sizeof *site->ap_file.aps));
    if (site_has_radiomap(site)) {
        fprintf(writer->file, ", the radio map %lu and its ids",
                (unsigned long)radiomap_file_bytes(&site->radiomap_file.map));
    }
    fprintf(writer->file,
            ". */\n"
            "#include \"insole/place/floor_plan.h\"\n"
            "#include \"insole/place/propagation.h\"\n%s"
            "\n"
            "/* Say this where the tables are used. */\n",
            site_has_radiomap(site) ? "#include \"insole/place/radio_map.h\"\n" : "");
    write_declarations(writer);
    putc('\n', writer->file);
}

void pack_write(FILE *file, const site_t *site, const char *name)
{
    const writer_t writer = {file, site, name};
    const struct {
        bool is_there;
        void (*write)(const writer_t *writer);
    } parts[] = {{site->building.plan != NULL, write_plan},
                 {site->ap_file.count > 0u, write_aps},
                 {site_has_radiomap(site), write_radiomap}};
    bool is_first = true;
    write_head(&writer);
    for (size_t i = 0u; i < sizeof parts / sizeof parts[0]; i++) {
        if (parts[i].is_there) {
            fputs(is_first ? "" : "\n", file);
            parts[i].write(&writer);
            is_first = false;
        }
    }
}
