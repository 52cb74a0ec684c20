/* Textures of surfaces as effects: of the Appearance and of the material. */
#include "engine/surface_textures.h"

#include <ctype.h>
#include <string.h>

/* ---- The textures that make the colour before light ---- */

/* ISO/IEC 19775-1 V4 12.2.4: a texture of the material itself comes before that of the Appearance.
 */
static const struct {
    const char *material, *field;
    bool lit;
} main_fields[] = {{"Material", "diffuseTexture", true},
                   {"Material", "emissiveTexture", false},
                   {"PhysicalMaterial", "baseTexture", true},
                   {"PhysicalMaterial", "emissiveTexture", false},
                   {"CommonSurfaceShader", "diffuseTexture", true},
                   {"CommonSurfaceShader", "multiDiffuseAlphaTexture", true},
                   {"UnlitMaterial", "emissiveTexture", true},
                   {"UnlitMaterial", "emissiveTexture", false}};

/* The field of the material that has the main texture, or NULL. */
static const char *main_field(const plr_shape *shape, plr_node **material) {
    *material = plr_shape_material_node(shape);
    for (size_t i = 0; *material && i < sizeof main_fields / sizeof *main_fields; i++)
        if (plr_node_is(*material, main_fields[i].material) && shape->lit == main_fields[i].lit &&
            plr_node_child(*material, main_fields[i].field))
            return main_fields[i].field;
    return NULL;
}

/* The textures at the units of castle_TexCoord<unit>. */
static size_t main_textures(const plr_shape *shape, plr_node *nodes[PLR_MESH_TEX_UNITS]) {
    plr_node *material;
    const char *field = main_field(shape, &material);
    nodes[0] = field               ? plr_node_child(material, field)
               : shape->appearance ? plr_node_child(shape->appearance, "texture")
                                   : NULL;
    if (!nodes[0] || !plr_node_is(nodes[0], "MultiTexture"))
        return nodes[0] != NULL;
    const plr_field *list = plr_node_field(nodes[0], "texture");
    size_t count = list->count < PLR_MESH_TEX_UNITS ? list->count : PLR_MESH_TEX_UNITS;
    for (size_t i = 0; i < count; i++)
        nodes[i] = list->value.nodes[i];
    return count;
}

static plr_texture_alpha alpha_of(const plr_shape *shape, const plr_node *node) {
    static const struct {
        const char *name;
        plr_texture_alpha alpha;
    } names[] = {{"TEST", PLR_ALPHA_TEST}, {"BLENDING", PLR_ALPHA_BLENDING}};
    plr_texture *texture = plr_textures_get(&shape->view->textures, node);
    if (texture)
        return texture->alpha;
    const char *asked = plr_node_string(node, "alphaChannel");
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (strcmp(asked, names[i].name) == 0)
            return names[i].alpha;
    return PLR_ALPHA_OPAQUE;
}

plr_texture_alpha plr_shape_texture_alpha(const plr_shape *shape) {
    plr_node *nodes[PLR_MESH_TEX_UNITS];
    size_t count = main_textures(shape, nodes);
    plr_texture_alpha most = PLR_ALPHA_OPAQUE;
    for (size_t i = 0; i < count; i++) {
        plr_texture_alpha own = nodes[i] ? alpha_of(shape, nodes[i]) : PLR_ALPHA_OPAQUE;
        most = own > most ? own : most;
    }
    return most;
}

/* ---- One texture ---- */

enum {
    MOST_DEFINES = 8
};

typedef struct defines {
    plr_define items[MOST_DEFINES];
    size_t count;
} defines;

static void define(plr_shape *shape, defines *list, const char *name, int value) {
    list->items[list->count++] = plr_shape_define(shape, name, value);
}

/* What the sampler is: 0 for ShaderTexture, -1 where there is no colour to be had: a shadow map
 * says how much light there is. */
static int dimensions_of(const plr_shape *shape, const plr_node *node) {
    if (!node)
        return -1;
    if (plr_node_is(node, "ShaderTexture"))
        return 0;
    const plr_texture *texture = plr_textures_get(&shape->view->textures, node);
    bool color = texture && texture->kind != PLR_TEXTURE_2D_SHADOW &&
                 texture->kind != PLR_TEXTURE_CUBE_SHADOW;
    return color ? plr_texture_dimensions(texture) : -1;
}

/* What its coordinates are by default: ShaderTexture says. */
static int coordinate_dimensions(const plr_shape *shape, const plr_node *node) {
    bool in_space = node && plr_node_is(node, "ShaderTexture") &&
                    strcmp(plr_node_string(node, "defaultTexCoord"), "BOUNDS3D") == 0;
    return in_space ? 3 : dimensions_of(shape, node);
}

/* Adds the instance of a texture; `role` is a macro of Texture.glsl or NULL. 0 if there are no
 * coordinates left. */
static size_t add_texture(plr_shape *shape, plr_node *node, int dimensions, plr_coordinates where,
                          const char *role, bool data, bool shifted, size_t attached) {
    if (where.channel < 0) {
        plr_diags_add_as(shape->diags, PLR_WARNING, PLR_CODE_LIMIT, plr_node_place(node),
                         "a shape has at most %d kinds of texture coordinates; this texture is "
                         "left out",
                         PLR_MESH_TEX_UNITS);
        return 0;
    }
    defines list = {.count = 0};
    define(shape, &list, "CHANNEL", where.channel);
    define(shape, &list, "DIMENSIONS", dimensions);
    define(shape, &list, "PROJECTIVE", where.projective);
    define(shape, &list, "REFLECTED", where.reflected);
    define(shape, &list, "SHIFTED", shifted);
    define(shape, &list, "DATA", data);
    if (role)
        define(shape, &list, role, 1);
    size_t effect = plr_shape_effect(shape, "textures/Texture", plr_node_type(node), node, attached,
                                     list.items, list.count);
    if (where.reflected)
        plr_shape_reflect(shape, where.channel, effect);
    return effect;
}

size_t plr_shape_field_texture(plr_shape *shape, plr_node *owner, const char *field,
                               const char *path, const plr_define *extra, size_t extra_count) {
    plr_node *node = owner ? plr_node_child(owner, field) : NULL;
    int dimensions = dimensions_of(shape, node);
    if (dimensions < 0)
        return 0;
    const char *mapping_name = plr_arena_format(&shape->view->arena, "%sMapping", field);
    const plr_field *mapping = plr_node_field(owner, mapping_name);
    plr_coordinates where =
        plr_shape_named_coordinates(shape, mapping ? plr_node_string(owner, mapping_name) : "",
                                    dimensions, mapping ? mapping->place : plr_node_place(node));
    size_t role = plr_shape_effect(shape, path, field, owner, 0, extra, extra_count);
    bool data = strcmp(field, "emissiveTexture") != 0 && strcmp(field, "specularTexture") != 0 &&
                strcmp(field, "ambientTexture") != 0;
    return role ? add_texture(shape, node, dimensions, where, "VALUE", data, where.channel == 0,
                              role)
                : 0;
}

size_t plr_shape_units(const plr_shape *shape, int dimensions[PLR_MESH_TEX_UNITS]) {
    plr_node *nodes[PLR_MESH_TEX_UNITS];
    size_t count = main_textures(shape, nodes);
    for (size_t i = 0; i < count; i++)
        dimensions[i] = coordinate_dimensions(shape, nodes[i]);
    return count;
}

/* ---- MultiTexture ---- */

static const char *const mode_names[] = {"MODULATE",
                                         "REPLACE",
                                         "MODULATE2X",
                                         "MODULATE4X",
                                         "ADD",
                                         "ADDSIGNED",
                                         "ADDSIGNED2X",
                                         "SUBTRACT",
                                         "ADDSMOOTH",
                                         "BLENDDIFFUSEALPHA",
                                         "BLENDTEXTUREALPHA",
                                         "BLENDFACTORALPHA",
                                         "BLENDCURRENTALPHA",
                                         "MODULATEALPHA_ADDCOLOR",
                                         "MODULATEINVALPHA_ADDCOLOR",
                                         "MODULATEINVCOLOR_ADDALPHA",
                                         "DOTPRODUCT3",
                                         "SELECTARG1",
                                         "SELECTARG2",
                                         "OFF",
                                         NULL};
static const char *const source_names[] = {"", "DIFFUSE", "SPECULAR", "FACTOR", NULL};
static const char *const function_names[] = {"", "COMPLEMENT", "ALPHAREPLICATE", NULL};

/* A word of a list, in a place of its own: "MODULATE / REPLACE" is one for colour, one for alpha.
 */
typedef struct words {
    const char *color, *alpha; /* of the names known; NULL alpha: as colour */
} words;

static const char *known_name(plr_shape *shape, const plr_string *string, const char *from,
                              const char *end, const char *const *names) {
    while (from < end && isspace((unsigned char)*from))
        from++;
    while (end > from && isspace((unsigned char)end[-1]))
        end--;
    size_t length = (size_t)(end - from);
    for (size_t i = 0; names[i]; i++)
        if (strlen(names[i]) == length && memcmp(names[i], from, length) == 0)
            return names[i];
    plr_place place = {string->origin.file, string->origin.line, string->origin.column};
    plr_diags_add_as(shape->diags, PLR_WARNING, PLR_CODE_BAD_VALUE, place,
                     "MultiTexture does not know '%.*s'; %s is taken",
                     (int)(length < 40 ? length : 40), from, *names[0] ? names[0] : "\"\"");
    return names[0];
}

static words words_at(plr_shape *shape, const plr_node *multi, const char *field, size_t index,
                      const char *const *names) {
    const plr_field *list = plr_node_field(multi, field);
    if (!list || index >= list->count)
        return (words){names[0], NULL};
    const plr_string *string = &list->value.strings[index];
    const char *end = string->text + string->length, *split = strpbrk(string->text, "/,");
    words found = {known_name(shape, string, string->text, split ? split : end, names), NULL};
    if (split)
        found.alpha = known_name(shape, string, split + 1, end, names);
    return found;
}

static void add_mode(plr_shape *shape, const char *mode, const char *source, const char *function,
                     const char *channels, bool last, size_t texture) {
    plr_arena *arena = &shape->view->arena;
    defines list = {.count = 0};
    define(shape, &list, plr_arena_format(arena, "MODE_%s", mode), 1);
    define(shape, &list, plr_arena_format(arena, "SOURCE_%s", source), 1);
    define(shape, &list, plr_arena_format(arena, "FUNCTION_%s", function), 1);
    if (channels)
        define(shape, &list, channels, 1);
    define(shape, &list, "LAST", last);
    plr_shape_effect(shape, "textures/MultiTextureMode", "MultiTextureMode",
                     plr_shape_material_node(shape), texture, list.items, list.count);
}

static void add_stage(plr_shape *shape, plr_node *multi, size_t index, plr_node *node,
                      size_t attached) {
    int dimensions = dimensions_of(shape, node);
    plr_coordinates where =
        plr_shape_unit_coordinates(shape, (unsigned)index, coordinate_dimensions(shape, node));
    words mode = words_at(shape, multi, "mode", index, mode_names);
    words source = words_at(shape, multi, "source", index, source_names);
    words function = words_at(shape, multi, "function", index, function_names);
    if (dimensions < 0 || strcmp(mode.color, "OFF") == 0)
        return;
    bool one = !mode.alpha && !source.alpha;
    size_t texture =
        add_texture(shape, node, dimensions, where, "STAGE", false, index == 0, attached);
    add_mode(shape, mode.color, source.color, function.color, one ? NULL : "CHANNELS_RGB", one,
             texture);
    if (!one)
        add_mode(shape, mode.alpha ? mode.alpha : mode.color,
                 source.alpha ? source.alpha : source.color, function.color, "CHANNELS_ALPHA", true,
                 texture);
}

static void add_multi_texture(plr_shape *shape, plr_node *multi) {
    const plr_field *list = plr_node_field(multi, "texture");
    size_t effect =
        plr_shape_effect(shape, "textures/MultiTexture", "MultiTexture", multi, 0, NULL, 0);
    for (size_t i = 0; i < list->count; i++) {
        plr_node *node = list->value.nodes[i];
        if (i == PLR_MESH_TEX_UNITS) {
            plr_diags_add_as(shape->diags, PLR_WARNING, PLR_CODE_LIMIT, plr_node_place(node),
                             "a shape has at most %d textures one over the other; the rest is left "
                             "out",
                             PLR_MESH_TEX_UNITS);
            return;
        }
        add_stage(shape, multi, i, node, effect);
    }
}

/* ---- All textures of a shape ---- */

static void add_main(plr_shape *shape) {
    plr_node *material, *appearance = shape->appearance;
    const char *field = main_field(shape, &material);
    plr_node *node =
        field ? plr_node_child(material, field) : plr_node_child(appearance, "texture");
    if (node && plr_node_is(node, "MultiTexture")) {
        add_multi_texture(shape, node);
        return;
    }
    int dimensions = dimensions_of(shape, node);
    if (dimensions < 0)
        return;
    plr_coordinates where;
    if (field) {
        const char *name = plr_arena_format(&shape->view->arena, "%sMapping", field);
        const plr_field *mapping = plr_node_field(material, name);
        where = plr_shape_named_coordinates(shape, plr_node_string(material, name),
                                            coordinate_dimensions(shape, node),
                                            mapping ? mapping->place : plr_node_place(node));
    } else {
        where = plr_shape_unit_coordinates(shape, 0, coordinate_dimensions(shape, node));
    }
    add_texture(shape, node, dimensions, where, NULL, false, true, 0);
}

/* What a texture of a material changes beside the colour before light; effects/textures has them by
 * the names of the fields. */
static const struct {
    const char *material, *field;
} other_fields[] = {{"Material", "ambientTexture"},
                    {"Material", "specularTexture"},
                    {"Material", "shininessTexture"},
                    {"Material", "emissiveTexture"},
                    {"Material", "occlusionTexture"},
                    {"CommonSurfaceShader", "ambientTexture"},
                    {"CommonSurfaceShader", "specularTexture"},
                    {"CommonSurfaceShader", "shininessTexture"},
                    {"CommonSurfaceShader", "emissiveTexture"},
                    {"PhysicalMaterial", "metallicRoughnessTexture"},
                    {"PhysicalMaterial", "emissiveTexture"},
                    {"PhysicalMaterial", "occlusionTexture"}};

void plr_shape_textures(plr_shape *shape) {
    plr_shape_main_coordinates(shape);
    if (shape->appearance)
        add_main(shape);
    plr_node *material = plr_shape_material_node(shape);
    for (size_t i = 0; material && shape->lit && i < sizeof other_fields / sizeof *other_fields;
         i++)
        if (plr_node_is(material, other_fields[i].material))
            plr_shape_field_texture(
                shape, material, other_fields[i].field,
                plr_arena_format(&shape->view->arena, "textures/%s", other_fields[i].field), NULL,
                0);
}
