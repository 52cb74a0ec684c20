/* Materials of surfaces as effects, what their transparency means, and the other properties of an
 * Appearance. */
#include <string.h>

#include "engine/surface_textures.h"

plr_node *plr_shape_material_node(const plr_shape *shape) {
    const plr_field *shaders =
        shape->appearance ? plr_node_field(shape->appearance, "shaders") : NULL;
    for (size_t i = 0; shaders && i < shaders->count; i++)
        if (shaders->value.nodes[i] && plr_node_is(shaders->value.nodes[i], "CommonSurfaceShader"))
            return shaders->value.nodes[i];
    return shape->appearance ? plr_node_child(shape->appearance, "material") : NULL;
}

/* Its node types are those of the material's colours; the field's place is the fault's. */
static plr_node *back_material(const plr_shape *shape, plr_node *material, const char *type) {
    plr_node *back = plr_node_child(shape->appearance, "backMaterial");
    if (plr_node_is(material, "TwoSidedMaterial"))
        return plr_node_bool(material, "separateBackColor") ? material : NULL;
    if (!back || plr_node_is(back, type))
        return back;
    plr_diags_add(shape->diags, PLR_CODE_BAD_VALUE, plr_node_place(back),
                  "backMaterial must be of the type of material, %s; it is left out", type);
    return NULL;
}

/* A TwoSidedMaterial is a Material with other colours on its back. */
static void add_material(plr_shape *shape, plr_node *material) {
    plr_arena *arena = &shape->view->arena;
    const char *type = plr_node_type(material);
    bool two = plr_node_is(material, "TwoSidedMaterial");
    const char *model = shape->lit ? (two ? "Material" : type) : "UnlitMaterial";
    shape->material = plr_shape_effect(shape, plr_arena_format(arena, "surface/%s", model), type,
                                       material, 0, NULL, 0);
    plr_node *back = shape->lit ? back_material(shape, material, type) : NULL;
    if (shape->material && back)
        plr_shape_effect(shape, plr_arena_format(arena, "surface/back/%s", type), type, back,
                         shape->material, NULL, 0);
}

/* Colours at the vertices stand for the material's. */
static void add_vertex_colors(plr_shape *shape) {
    if (!shape->model->mesh.colors)
        return;
    plr_node *colors = plr_node_child(shape->geometry, "color");
    const char *type = colors ? plr_node_type(colors) : "Color";
    plr_define alpha = plr_shape_define(shape, "WITH_ALPHA", strcmp(type, "ColorRGBA") == 0);
    plr_shape_effect(shape, "surface/Color", type, colors, 0, &alpha, 1);
}

/* What has no normals is not lit: its Material counts by its emissive colour (ISO/IEC 19775-1 V4
 * 11.2.2.5). */
void plr_shape_material(plr_shape *shape) {
    plr_node *material = plr_shape_material_node(shape);
    if (material)
        add_material(shape, material);
    if (material && !shape->material)
        plr_diags_add(shape->diags, PLR_CODE_NOT_DRAWN, plr_node_place(material),
                      "%s is not drawn yet; the shape is white", plr_node_type(material));
    if (!shape->material)
        shape->material =
            plr_shape_effect(shape, "surface/UnlitMaterial", "UnlitMaterial", NULL, 0, NULL, 0);
    add_vertex_colors(shape);
}

/* ---- Alpha ---- */

typedef struct alpha_word {
    const char *text;
    plr_texture_alpha alpha;
} alpha_word;

/* ISO/IEC 19775-1 V4 12.4.2, and the older extension alphaChannel. "AUTO" is in none: the parts of
 * the shape say. */
static const struct {
    const char *field;
    alpha_word words[3];
} alpha_fields[] = {
    {"alphaMode",
     {{"OPAQUE", PLR_ALPHA_OPAQUE}, {"MASK", PLR_ALPHA_TEST}, {"BLEND", PLR_ALPHA_BLENDING}}},
    {"alphaChannel",
     {{"NONE", PLR_ALPHA_OPAQUE}, {"TEST", PLR_ALPHA_TEST}, {"BLENDING", PLR_ALPHA_BLENDING}}}};

static bool asked_alpha(const plr_shape *shape, plr_texture_alpha *alpha) {
    for (size_t f = 0; f < sizeof alpha_fields / sizeof *alpha_fields; f++) {
        const char *text = plr_node_string(shape->appearance, alpha_fields[f].field);
        for (size_t i = 0; i < 3; i++)
            if (strcmp(text, alpha_fields[f].words[i].text) == 0) {
                *alpha = alpha_fields[f].words[i].alpha;
                return true;
            }
        if (strcmp(text, "AUTO") != 0)
            plr_diags_add(shape->diags, PLR_CODE_BAD_VALUE,
                          plr_node_field(shape->appearance, alpha_fields[f].field)->place,
                          "'%s' is no %s: AUTO, %s, %s or %s", text, alpha_fields[f].field,
                          alpha_fields[f].words[0].text, alpha_fields[f].words[1].text,
                          alpha_fields[f].words[2].text);
    }
    return false;
}

static bool is_transparent(const plr_node *material) {
    static const char *const fields[] = {"transparency", "backTransparency"};
    for (size_t i = 0; material && i < sizeof fields / sizeof *fields; i++)
        if (plr_node_field(material, fields[i]) && plr_node_number(material, fields[i]) > 0)
            return true;
    return material && plr_node_field(material, "alphaFactor") &&
           plr_node_number(material, "alphaFactor") < 1;
}

static bool has_transparent_colors(const plr_mesh *mesh) {
    for (uint32_t i = 0; mesh->colors && i < mesh->vertex_count; i++)
        if (mesh->colors[4 * (size_t)i + 3] < 1)
            return true;
    return false;
}

plr_texture_alpha plr_shape_alpha(const plr_shape *shape) {
    plr_texture_alpha asked;
    bool blends = has_transparent_colors(&shape->model->mesh);
    if (!shape->appearance)
        return blends ? PLR_ALPHA_BLENDING : PLR_ALPHA_OPAQUE;
    if (asked_alpha(shape, &asked))
        return asked;
    blends = blends || plr_node_child(shape->appearance, "blendMode") ||
             is_transparent(plr_shape_material_node(shape)) ||
             is_transparent(plr_node_child(shape->appearance, "backMaterial"));
    return blends ? PLR_ALPHA_BLENDING : plr_shape_texture_alpha(shape);
}

/* ---- Properties of lines, points and areas ---- */

static void add_line_properties(plr_shape *shape, plr_node *lines) {
    int type = plr_node_int(lines, "linetype");
    if (!plr_node_bool(lines, "applied") || type == 1)
        return;
    if (type >= 2 && type <= 5)
        plr_shape_effect(shape, "surface/LineProperties", "LineProperties", lines, 0, NULL, 0);
    else
        plr_diags_add(shape->diags, PLR_CODE_NOT_DRAWN, plr_node_field(lines, "linetype")->place,
                      "lines of type %d are drawn solid", type);
}

static void add_fill_properties(plr_shape *shape, plr_node *fill) {
    int style = plr_node_int(fill, "hatchStyle");
    bool hatched = plr_node_bool(fill, "hatched");
    if (hatched && (style < 1 || style > 6))
        plr_diags_add(shape->diags, PLR_CODE_NOT_DRAWN, plr_node_field(fill, "hatchStyle")->place,
                      "hatches of style %d are drawn as those of style 1", style);
    if (hatched || !plr_node_bool(fill, "filled"))
        plr_shape_effect(shape, "surface/FillProperties", "FillProperties", fill, 0, NULL, 0);
}

static void add_point_properties(plr_shape *shape, plr_node *points) {
    plr_shape_effect(shape, "surface/PointProperties", "PointProperties", points, 0, NULL, 0);
}

void plr_shape_properties(plr_shape *shape) {
    static const struct {
        plr_mesh_kind kind;
        const char *field;
        void (*add)(plr_shape *, plr_node *);
    } properties[] = {{PLR_MESH_LINES, "lineProperties", add_line_properties},
                      {PLR_MESH_TRIANGLES, "fillProperties", add_fill_properties},
                      {PLR_MESH_POINTS, "pointProperties", add_point_properties}};
    if (!shape->appearance)
        return;
    for (size_t i = 0; i < sizeof properties / sizeof *properties; i++) {
        plr_node *node = plr_node_child(shape->appearance, properties[i].field);
        if (node && shape->model->mesh.kind == properties[i].kind)
            properties[i].add(shape, node);
    }
    if (shape->alpha == PLR_ALPHA_TEST)
        plr_shape_effect(shape, "surface/AlphaTest", "AlphaTest", shape->appearance, 0, NULL, 0);
}
