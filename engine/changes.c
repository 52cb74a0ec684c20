#include "engine/changes.h"

#include <string.h>

/* The first row that fits counts; a field that is in none changes parts. Fields of NULL stand for
 * all single numbers and vectors, that is, for what can be nothing but a uniform. */
static const struct {
    const char *type, *field;
    plr_change change;
} rows[] = {
    {"X3DViewpointNode", NULL, PLR_CHANGE_PLACES},
    {"X3DViewpointNode", "isBound", PLR_CHANGE_PLACES},
    {"Transform", NULL, PLR_CHANGE_PLACES},
    {"MatrixTransform", "matrix", PLR_CHANGE_PLACES},
    {"Billboard", "axisOfRotation", PLR_CHANGE_PLACES},
    {"X3DMaterialNode", "transparency", PLR_CHANGE_PARTS},
    {"X3DMaterialNode", NULL, PLR_CHANGE_NONE},
    {"X3DLightNode", "cutOffAngle", PLR_CHANGE_PARTS},
    {"X3DLightNode", NULL, PLR_CHANGE_NONE},
    {"X3DTextureTransformNode", NULL, PLR_CHANGE_NONE},
    {"X3DVolumeRenderStyleNode", NULL, PLR_CHANGE_NONE},
    {"X3DFogObject", "color", PLR_CHANGE_NONE},
};

/* Nodes that are not drawn, whatever happens to them. */
static bool is_unseen(const plr_node *node) {
    static const char *const types[] = {"X3DInterpolatorNode", "X3DSequencerNode", "X3DTriggerNode",
                                        "X3DScriptNode",       "BooleanFilter",    "BooleanToggle",
                                        "EaseInEaseOut",       "Toggler"};
    for (size_t i = 0; i < sizeof types / sizeof *types; i++)
        if (plr_node_is(node, types[i]))
            return true;
    return plr_node_is(node, "X3DSensorNode") && !plr_node_is(node, "X3DGroupingNode");
}

/* One number or vector, or one that the author declared as a uniform. */
static bool is_plain(const plr_field *field) {
    plr_kind kind = plr_type_kind(field->type);
    return !plr_type_is_multiple(field->type) &&
           (kind == PLR_FLOAT || kind == PLR_DOUBLE ||
            (field->declared && (kind == PLR_INT || kind == PLR_BOOL)));
}

static plr_change meaning(const plr_node *node, const plr_field *field) {
    bool tells_binding = strcmp(field->name, "isBound") == 0;
    if (is_unseen(node) || (field->access == PLR_OUTPUT_ONLY && !tells_binding))
        return PLR_CHANGE_NONE;
    if (field->declared)
        return is_plain(field) ? PLR_CHANGE_NONE : PLR_CHANGE_PARTS;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        if (plr_node_is(node, rows[i].type) &&
            (rows[i].field ? strcmp(field->name, rows[i].field) == 0 : is_plain(field)))
            return rows[i].change;
    return PLR_CHANGE_PARTS;
}

static void look_at(void *user, plr_node *node, const plr_field *field) {
    plr_change *most = user, change = meaning(node, field);
    if (change > *most)
        *most = change;
}

plr_change plr_view_changed(const plr_view *view) {
    plr_change most = PLR_CHANGE_NONE;
    if (!plr_scene_changes(view->scene, view->revision, look_at, &most) || !plr_lights_stay(view))
        most = PLR_CHANGE_PARTS;
    return most;
}
