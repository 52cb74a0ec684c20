#include "engine/ignored.h"

#include <string.h>

/* Fields of other browsers; what plugray does instead. */
static const struct {
    const char *type, *field, *instead;
} rows[] = {
    {"X3DVolumeDataNode", "sliceThickness", "'dimensions' or 'fileGeometry' say how large it is"},
    {"X3DVolumeDataNode", "swapped", "files say in which order their bytes are"},
    {"X3DVolumeDataNode", "renderSettings", "steps and gradients are chosen by the engine"},
    {"X3DVolumeDataNode", "rayStep", "--step and --error choose the step"},
    {"X3DVolumeDataNode", "renderer", "rays are cast"},
    {"X3DVolumeDataNode", "filterType", "voxels are interpolated linearly"},
    {"X3DVolumeDataNode", "allowViewpointInside", "the viewer may always be inside"},
    {"OpacityMapVolumeStyle", "type", "the transfer function is looked up at each sample"},
    {"OpacityMapVolumeStyle", "opacityFactor", "'opacityUnitDistance' of the volume says it"},
    {"OpacityMapVolumeStyle", "lightFactor", "it is never lit"},
};

enum {
    ROWS = sizeof rows / sizeof *rows
};

typedef struct walk {
    bool told[ROWS];
    bool *seen; /* by number of the node */
    plr_diags *diags;
} walk;

/* The default of the table, where it is a single value. */
static bool is_default(const plr_node *node, const plr_field *field) {
    const plr_node_info *info = plr_node_info_find(plr_node_type(node));
    const char *text = "";
    for (size_t i = 0; i < info->field_count; i++)
        if (strcmp(info->fields[i].name, field->name) == 0)
            text = info->fields[i].initial;
    switch (plr_type_kind(field->type)) {
    case PLR_BOOL:
        return field->value.bools[0] == (strcmp(text, "TRUE") == 0);
    case PLR_STRING: {
        size_t length = strlen(field->value.strings[0].text);
        return strlen(text) == length + 2 &&
               strncmp(text + 1, field->value.strings[0].text, length) == 0;
    }
    default:
        return field->count == 0;
    }
}

static void look_at(walk *w, const plr_node *node) {
    for (size_t i = 0; i < ROWS; i++) {
        const plr_field *field =
            plr_node_is(node, rows[i].type) ? plr_node_field(node, rows[i].field) : NULL;
        if (!field || !field->given || w->told[i] || is_default(node, field))
            continue;
        w->told[i] = true;
        plr_diags_add(w->diags, PLR_CODE_NOT_DRAWN, field->place,
                      "the field '%s' has no effect: %s", field->name, rows[i].instead);
    }
}

static void visit(walk *w, const plr_node *node) {
    if (!node || w->seen[plr_node_id(node)])
        return;
    w->seen[plr_node_id(node)] = true;
    look_at(w, node);
    const plr_field *styles = plr_node_field(node, "renderStyle");
    for (size_t i = 0; styles && i < styles->count; i++)
        visit(w, styles->value.nodes[i]);
}

void plr_ignored_report(plr_arena *arena, const plr_scene *scene, const plr_flat *flat,
                        plr_diags *diags) {
    walk w = {.seen = PLR_NEW_ARRAY(arena, plr_scene_node_count(scene) + 1, bool), .diags = diags};
    for (size_t i = 0; i < flat->volumes.count; i++)
        visit(&w, flat->volumes.items[i].node);
}
