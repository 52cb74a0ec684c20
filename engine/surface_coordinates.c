/* Texture coordinates of a shape: which of the geometry's, generated or projected, and transformed
 * by what. Each combination in use is a channel, one effect. */
#include <string.h>

#include "engine/surface_textures.h"

/* ---- Entries of texCoord and textureTransform ---- */

static plr_node *entry_at(const plr_field *list, size_t index) {
    return list && index < list->count ? list->value.nodes[index] : NULL;
}

/* The nodes in geometry.texCoord, one a unit. */
static size_t coordinate_count(const plr_shape *shape, const plr_field **list) {
    plr_node *node = shape->geometry ? plr_node_child(shape->geometry, "texCoord") : NULL;
    *list = node ? plr_node_field(node, "texCoord") : NULL;
    if (!*list)
        return node != NULL;
    return (*list)->count < PLR_MESH_TEX_UNITS ? (*list)->count : PLR_MESH_TEX_UNITS;
}

static plr_node *coordinate_at(const plr_shape *shape, size_t index) {
    const plr_field *list;
    size_t count = coordinate_count(shape, &list);
    if (index >= count)
        return NULL;
    return list ? entry_at(list, index) : plr_node_child(shape->geometry, "texCoord");
}

/* ISO/IEC 19775-1 V4 18.4.5: a MultiTexture is moved by a MultiTextureTransform alone. */
static plr_node *transform_at(const plr_shape *shape, size_t index) {
    plr_node *node =
        shape->appearance ? plr_node_child(shape->appearance, "textureTransform") : NULL;
    if (!node)
        return NULL;
    if (plr_node_is(node, "MultiTextureTransform"))
        return entry_at(plr_node_field(node, "textureTransform"), index);
    const plr_node *texture = plr_node_child(shape->appearance, "texture");
    bool multi = texture && plr_node_is(texture, "MultiTexture");
    return index == 0 && !multi ? node : NULL;
}

static bool is_named(const plr_node *node, const char *mapping) {
    return node && strcmp(plr_node_string(node, "mapping"), mapping) == 0;
}

static plr_node *transform_named(const plr_shape *shape, const char *mapping) {
    plr_node *node =
        shape->appearance ? plr_node_child(shape->appearance, "textureTransform") : NULL;
    const plr_field *list = node ? plr_node_field(node, "textureTransform") : NULL;
    if (!*mapping)
        return transform_at(shape, 0);
    if (!list)
        return is_named(node, mapping) ? node : NULL;
    for (size_t i = 0; i < list->count; i++)
        if (is_named(entry_at(list, i), mapping))
            return entry_at(list, i);
    return NULL;
}

/* ---- Generators ---- */

/* The modes of ISO/IEC 19775-1 V4 table 18.6 and extensions, and what they are made from. */
static const struct mode {
    const char *name;
    const char *needs; /* a macro of TextureCoordinate.vert.glsl; "": object space */
    bool reflects;     /* again for each fragment */
} modes[] = {{"SPHERE", "NORMAL", false},           {"CAMERASPACENORMAL", "NORMAL", false},
             {"CAMERASPACEPOSITION", "EYE", false}, {"CAMERASPACEREFLECTIONVECTOR", "NORMAL", true},
             {"SPHERE-LOCAL", "", false},           {"COORD", "", false},
             {"COORD-EYE", "EYE", false},           {"NOISE", "", false},
             {"NOISE-EYE", "EYE", false},           {"SPHERE-REFLECT", "NORMAL", true},
             {"SPHERE-REFLECT-LOCAL", "", false},   {"WORLDSPACEREFLECTIONVECTOR", "NORMAL", true},
             {"WORLDSPACENORMAL", "NORMAL", false}, {"BOUNDS", "", false},
             {"BOUNDS2D", "PLANE", false},          {"BOUNDS3D", "BOX", false}};

static const struct mode *mode_of(plr_shape *shape, const plr_node *node) {
    static const struct mode unknown = {"COORD", "", false};
    const char *name = plr_node_string(node, "mode");
    for (size_t i = 0; i < sizeof modes / sizeof *modes; i++)
        if (strcmp(modes[i].name, name) == 0)
            return &modes[i];
    plr_diags_add_as(shape->diags, PLR_WARNING, PLR_CODE_BAD_VALUE,
                     plr_node_field(node, "mode")->place,
                     "'%s' is no mode of TextureCoordinateGenerator; COORD is taken", name);
    return &unknown;
}

/* ---- Channels ---- */

enum {
    MOST_DEFINES = 4
};

typedef struct defines {
    plr_define items[MOST_DEFINES];
    size_t count;
} defines;

static void define(plr_shape *shape, defines *list, const char *name, int value) {
    list->items[list->count++] = plr_shape_define(shape, name, value);
}

/* Where the geometry has no coordinates of its own for this kind of texture (ISO/IEC 19775-1 V4
 * 33.2.4 for space). The standard leaves cubes open: the direction from the middle of the shape. */
static const char *default_source(const plr_shape *shape, int dimensions) {
    if (shape->model->mesh.tex_coords_given)
        return "UNIT";
    return dimensions == 3                                                   ? "BOX"
           : dimensions == 6                                                 ? "CENTER"
           : dimensions == 0 && !plr_mesh_tex_coords(&shape->model->mesh, 0) ? "PLANE"
                                                                             : "UNIT";
}

/* The macro that says where coordinates come from, and the effect that makes them. */
static const char *source_of(plr_shape *shape, const plr_channel *channel, const char **generator,
                             bool *reflects) {
    *generator = NULL;
    *reflects = false;
    if (!channel->node)
        return default_source(shape, channel->dimensions);
    const char *type = plr_node_type(channel->node);
    if (strcmp(type, "ProjectedTextureCoordinate") == 0) {
        if (!plr_node_child(channel->node, "projector"))
            return default_source(shape, channel->dimensions);
        *generator = type;
        return "EYE";
    }
    if (strcmp(type, "TextureCoordinateGenerator") != 0)
        return "UNIT";
    const struct mode *mode = mode_of(shape, channel->node);
    *reflects = mode->reflects && shape->lit && !shape->recipe->base_node;
    if (strcmp(mode->name, "BOUNDS") == 0)
        return channel->dimensions == 3 || channel->dimensions == 6 ? "BOX" : "PLANE";
    if (strncmp(mode->name, "BOUNDS", 6) != 0)
        *generator = type;
    return *mode->needs ? mode->needs : "UNIT";
}

/* To a channel, where it acts for each vertex, or to a texture, for each fragment. */
static void attach(plr_shape *shape, plr_node *node, size_t attached, bool fragments) {
    const char *type = plr_node_type(node);
    plr_define stage = plr_shape_define(shape, fragments ? "FRAGMENTS" : "VERTICES", 1);
    plr_shape_effect(shape, plr_arena_format(&shape->view->arena, "textures/%s", type), type, node,
                     attached, &stage, 1);
}

static bool is_projective(const plr_channel *channel) {
    return (channel->node && (plr_node_is(channel->node, "TextureCoordinate4D") ||
                              plr_node_is(channel->node, "ProjectedTextureCoordinate"))) ||
           (channel->transform && plr_node_is(channel->transform, "TextureTransformMatrix3D"));
}

static void compose_channel(plr_shape *shape, int index, plr_channel *channel) {
    defines list = {.count = 0};
    const char *generator, *source = source_of(shape, channel, &generator, &channel->reflects);
    define(shape, &list, "CHANNEL", index);
    define(shape, &list, "UNIT", (int)channel->unit);
    if (strcmp(source, "UNIT") != 0)
        define(shape, &list, source, 1);
    size_t effect = plr_shape_effect(shape, "textures/TextureCoordinate", "TextureCoordinate", NULL,
                                     0, list.items, list.count);
    if (generator)
        attach(shape, channel->node, effect, false);
    if (channel->transform)
        attach(shape, channel->transform, effect, false);
    channel->projective = is_projective(channel);
}

/* 3 and 6 tell default coordinates apart; 0 and 2 have the same but for shapes without any. */
static bool same_source(const plr_channel *a, const plr_channel *b) {
    return a->unit == b->unit && a->node == b->node && a->transform == b->transform &&
           (a->dimensions == b->dimensions || (a->dimensions < 3 && b->dimensions < 3));
}

static plr_coordinates coordinates_of(const plr_shape *shape, int index) {
    const plr_channel *channel = &shape->channels[index];
    return (plr_coordinates){index, channel->projective, channel->reflects};
}

static plr_coordinates add_channel(plr_shape *shape, plr_channel channel) {
    if (shape->channel_count >= PLR_MESH_TEX_UNITS)
        return (plr_coordinates){.channel = -1};
    int index = (int)shape->channel_count++;
    compose_channel(shape, index, &channel);
    shape->channels[index] = channel;
    return coordinates_of(shape, index);
}

/* The geometry repeats its last coordinates for the units that are left. */
static plr_channel unit_channel(const plr_shape *shape, unsigned unit, int dimensions) {
    const plr_field *list;
    size_t count = coordinate_count(shape, &list);
    unsigned given = unit < count ? unit : count ? (unsigned)count - 1 : 0;
    return (plr_channel){.unit = given,
                         .node = coordinate_at(shape, given),
                         .transform = transform_at(shape, unit),
                         .dimensions = dimensions};
}

void plr_shape_main_coordinates(plr_shape *shape) {
    int dimensions[PLR_MESH_TEX_UNITS];
    const plr_field *list;
    size_t units = plr_shape_units(shape, dimensions), given = coordinate_count(shape, &list);
    if (shape->channel_count)
        return;
    for (size_t i = 0; i < PLR_MESH_TEX_UNITS && (i == 0 || i < units || i < given); i++)
        add_channel(shape, unit_channel(shape, (unsigned)i, i < units ? dimensions[i] : 2));
}

plr_coordinates plr_shape_unit_coordinates(plr_shape *shape, unsigned unit, int dimensions) {
    plr_shape_main_coordinates(shape);
    plr_channel wanted = unit_channel(shape, unit, dimensions);
    for (unsigned i = 0; i < unit; i++)
        if (same_source(&shape->channels[i], &wanted))
            return coordinates_of(shape, (int)i);
    return coordinates_of(shape, (int)unit);
}

plr_coordinates plr_shape_named_coordinates(plr_shape *shape, const char *mapping, int dimensions,
                                            plr_place place) {
    plr_shape_main_coordinates(shape);
    const plr_field *list;
    size_t count = coordinate_count(shape, &list), found = 0;
    while (*mapping && found < count && !is_named(coordinate_at(shape, found), mapping))
        found++;
    if (found > 0 && found == count) {
        plr_diags_add_as(shape->diags, PLR_WARNING, PLR_CODE_BAD_VALUE, place,
                         "no texture coordinates have the mapping '%s'; the first are taken",
                         mapping);
        found = 0;
    }
    plr_channel wanted = {.unit = (unsigned)found,
                          .node = coordinate_at(shape, found),
                          .transform = transform_named(shape, mapping),
                          .dimensions = dimensions};
    for (size_t i = 0; i < shape->channel_count; i++)
        if (same_source(&shape->channels[i], &wanted))
            return coordinates_of(shape, (int)i);
    return add_channel(shape, wanted);
}

void plr_shape_reflect(plr_shape *shape, int channel, size_t texture) {
    attach(shape, shape->channels[channel].node, texture, true);
    if (shape->channels[channel].transform)
        attach(shape, shape->channels[channel].transform, texture, true);
}
