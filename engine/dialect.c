#include "engine/dialect.h"

#include <string.h>

enum {
    DEEPEST = 64 /* styles inside styles */
};

static bool field_is_2005(const plr_node_info *info, const plr_field *field) {
    for (size_t i = 0; field->given && i < info->field_count; i++)
        if (strcmp(info->fields[i].name, field->name) == 0)
            return info->fields[i].dialect_2005;
    return false;
}

/* The node below `node` (itself included) that only the proposal knows, or has a field of its. */
static const plr_node *find_2005(const plr_node *node, int depth) {
    const plr_node_info *info = plr_node_info_find(plr_node_type(node));
    if (!info || depth > DEEPEST)
        return NULL;
    if (info->dialect_2005 || strcmp(plr_node_written_type(node), plr_node_type(node)) != 0)
        return node;
    for (size_t i = 0; i < plr_node_field_count(node); i++) {
        const plr_field *field = plr_node_field_at(node, i);
        if (field_is_2005(info, field))
            return node;
        bool styles = strcmp(field->name, "renderStyle") == 0;
        for (size_t k = 0; styles && k < field->count; k++) {
            const plr_node *found =
                field->value.nodes[k] ? find_2005(field->value.nodes[k], depth + 1) : NULL;
            if (found)
                return found;
        }
    }
    return NULL;
}

int plr_dialect(const plr_flat *flat, int asked, plr_diags *diags) {
    if (!flat->volumes.count)
        return asked ? asked : PLR_DIALECT_FINAL;
    const plr_node *reason = NULL;
    for (size_t i = 0; i < flat->volumes.count && !reason; i++)
        reason = find_2005(flat->volumes.items[i].node, 0);
    int dialect = asked ? asked : reason ? PLR_DIALECT_2005 : PLR_DIALECT_FINAL;
    if (dialect == PLR_DIALECT_FINAL && !asked)
        return dialect; /* what everybody expects needs no line */
    plr_place place = plr_node_place(reason ? reason : flat->volumes.items[0].node);
    plr_diags_add(diags, PLR_CODE_DIALECT, place, "volume nodes are read as %s%s",
                  dialect == PLR_DIALECT_2005 ? "the proposal of 2005 has them"
                                              : "the final standard has them",
                  asked ? ", as asked" : "");
    return dialect;
}
