/* SPDX-License-Identifier: MIT */
#include "forest_writer.h"

#include <stdbool.h>
#include <string.h>

#include "c_text.h"

enum { COLUMNS = 100 };

/* Writes an item of a list, on a line of its own where the last has no room. */
static void write_item(FILE *file, int *column, const char *item)
{
    int length = (int)strlen(item);
    bool has_room = *column > 0 && *column + 1 + length <= COLUMNS;
    fprintf(file, has_room ? " %s" : *column > 0 ? "\n    %s" : "    %s", item);
    *column = has_room ? *column + 1 + length : 4 + length;
}

static void write_nodes(FILE *file, const grown_t *grown, const char *name)
{
    char number[C_REAL_ROOM], item[C_REAL_ROOM + 40];
    int column = 0;
    fprintf(file, "static const insole_carry_node_t %s_nodes[%lu] = {\n", name,
            (unsigned long)grown->node_count);
    for (size_t i = 0u; i < grown->node_count; i++) {
        const insole_carry_node_t *node = &grown->nodes[i];
        snprintf(item, sizeof item, "{%s, %u, %u, %u},", c_real(number, node->threshold),
                 (unsigned)node->feature, (unsigned)node->at_most, (unsigned)node->above);
        write_item(file, &column, item);
    }
    fputs("\n};\n\n", file);
}

static void write_roots(FILE *file, const grown_t *grown, const char *name)
{
    char item[20];
    int column = 0;
    fprintf(file, "static const uint16_t %s_roots[%u] = {\n", name,
            (unsigned)grown->forest.tree_count + 1u);
    for (unsigned tree = 0u; tree <= grown->forest.tree_count; tree++) {
        snprintf(item, sizeof item, "%u,", (unsigned)grown->roots[tree]);
        write_item(file, &column, item);
    }
    fputs("\n};\n\n", file);
}

static void write_names(FILE *file, const insole_carry_forest_t *forest, const char *name)
{
    fprintf(file, "static const char *const %s_names[%u] = {", name, (unsigned)forest->class_count);
    for (unsigned k = 0u; k < forest->class_count; k++) {
        fputs(k == 0u ? "" : ", ", file);
        c_write_string(file, forest->names[k]);
    }
    fputs("};\n\n", file);
}

void forest_write(FILE *file, const grown_t *grown, const char *name, const char *head)
{
    fprintf(file, "/* %s\n * The table takes %lu bytes. */\n", head,
            (unsigned long)forest_bytes(grown));
    fputs("#include \"insole/sense/carry_forest.h\"\n\n/* Say this where the table is used. */\n",
          file);
    fprintf(file, "extern const insole_carry_forest_t %s_forest;\n\n", name);
    write_nodes(file, grown, name);
    write_roots(file, grown, name);
    write_names(file, &grown->forest, name);
    fprintf(file,
            "const insole_carry_forest_t %s_forest = {\n    %s_nodes, %s_roots,\n    %s_names, %u, "
            "%u};\n",
            name, name, name, name, (unsigned)grown->forest.tree_count,
            (unsigned)grown->forest.class_count);
}
