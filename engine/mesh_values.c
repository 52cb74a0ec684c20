#include "engine/mesh_internal.h"

#include <string.h>

/* One number of a field of floats or doubles. */
static float number_at(const plr_field *field, size_t i) {
    if (plr_type_kind(field->type) == PLR_DOUBLE)
        return (float)field->value.doubles[i];
    return field->value.floats[i];
}

static bool holds_numbers(const plr_field *field) {
    if (!field)
        return false;
    plr_kind kind = plr_type_kind(field->type);
    return kind == PLR_FLOAT || kind == PLR_DOUBLE;
}

const float *plr_mesh_values(plr_arena *arena, const plr_node *property, const char *name,
                             int components, const float *missing, uint32_t *count) {
    *count = 0;
    const plr_field *field = property ? plr_node_field(property, name) : NULL;
    if (!holds_numbers(field) || !field->count)
        return NULL;
    int given = plr_type_components(field->type);
    size_t n = field->count < PLR_MESH_LIMIT ? field->count : PLR_MESH_LIMIT;
    *count = (uint32_t)n;
    if (given == components && plr_type_kind(field->type) == PLR_FLOAT)
        return field->value.floats;
    float *values = plr_arena_array(arena, n, (size_t)components * sizeof *values);
    for (size_t i = 0; i < n; i++)
        for (int c = 0; c < components; c++)
            values[i * (size_t)components + (size_t)c] =
                c < given ? number_at(field, i * (size_t)given + (size_t)c) : missing[c];
    return values;
}

/* Values of one unit; NULL where it has none or they are generated while drawing. */
static const float *unit_coords(plr_polygons *polygons, const plr_node *node, uint32_t *count) {
    static const float missing[4] = {0, 0, 0, 1};
    *count = 0;
    return node ? plr_mesh_values(polygons->arena, node, "point", 4, missing, count) : NULL;
}

uint32_t plr_polygons_tex_coords(plr_polygons *polygons, const plr_node *tex_coord) {
    if (!tex_coord)
        return 0;
    const plr_field *units = plr_node_field(tex_coord, "texCoord");
    size_t count = units && units->type == PLR_MFNODE ? units->count : 1;
    polygons->tex_given = true;
    uint32_t least = 0;
    for (size_t i = 0; i < count && i < PLR_MESH_TEX_UNITS; i++) {
        const plr_node *node = units ? units->value.nodes[i] : tex_coord;
        uint32_t *values = &polygons->tex_counts[i];
        polygons->tex_coords[i] = unit_coords(polygons, node, values);
        polygons->tex_units = (unsigned)i + 1;
        if (*values && (!least || *values < least))
            least = *values;
    }
    return least;
}

/* The numbers that one vertex has of an attribute node; 0 if it is no such node. */
static int attribute_components(const plr_node *node) {
    if (plr_node_is(node, "FloatVertexAttribute")) {
        int components = plr_node_int(node, "numComponents");
        return components >= 1 && components <= 4 ? components : 0;
    }
    const plr_field *value = plr_node_field(node, "value");
    int components = value && holds_numbers(value) ? plr_type_components(value->type) : 0;
    return components == 9 || components == 16 ? components : 0;
}

static void add_attribute(plr_polygons *polygons, plr_mesh *mesh, const plr_node *node,
                          const uint32_t *coords) {
    int components = attribute_components(node);
    const char *name = plr_node_string(node, "name");
    const plr_field *field = plr_node_field(node, "value");
    if (!components || !holds_numbers(field) || !*name) {
        plr_diags_add(polygons->diags, PLR_CODE_BAD_GEOMETRY, plr_node_place(node),
                      "a vertex attribute needs a name and 1 to 4 components");
        return;
    }
    size_t numbers = field->count * (size_t)plr_type_components(field->type), needed = 0;
    for (size_t i = 0; i < mesh->vertex_count; i++)
        needed = coords[i] >= needed ? (size_t)coords[i] + 1 : needed;
    if (numbers / (size_t)components < needed) {
        plr_diags_add(polygons->diags, PLR_CODE_BAD_GEOMETRY, field->place,
                      "the vertex attribute '%s' has %zu values for %zu points", name,
                      numbers / (size_t)components, needed);
        return;
    }
    plr_mesh_attribute *attribute = &mesh->attributes[mesh->attribute_count++];
    attribute->components = components;
    attribute->name = plr_mesh_array(polygons->arena, strlen(name) + 1, 1);
    memcpy(attribute->name, name, strlen(name));
    size_t size = (size_t)components;
    attribute->values =
        plr_mesh_array(polygons->arena, mesh->vertex_count, size * sizeof *attribute->values);
    /* fields write matrices row by row (ISO/IEC 19776-1 5.14), GL reads them column by column */
    size_t rows = components == 16 ? 4 : components == 9 ? 3 : 1, columns = size / rows;
    for (size_t i = 0; i < mesh->vertex_count; i++)
        for (size_t c = 0; c < size; c++)
            attribute->values[i * size + c % columns * rows + c / columns] =
                number_at(field, coords[i] * size + c);
}

void plr_mesh_attributes(plr_polygons *polygons, plr_mesh *mesh, const uint32_t *coords) {
    const plr_field *field = plr_node_field(polygons->node, "attrib");
    if (!field || !field->count)
        return;
    mesh->attributes = plr_mesh_array(polygons->arena, field->count, sizeof *mesh->attributes);
    for (size_t i = 0; i < field->count; i++)
        if (field->value.nodes[i])
            add_attribute(polygons, mesh, field->value.nodes[i], coords);
}
