/* Meshes: ISO/IEC 12113 3.7.2. A primitive becomes a Shape. Data that several primitives share are
 * read once, and the nodes made of them are shared as well. */
#include "x3d/gltf_internal.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* What a mode of drawing is in X3D. */
typedef struct mode {
    const char *indexed, *plain; /* nodes; NULL: the points are put in order */
    const char *index, *count;   /* fields: of the indexed node; of the plain one, or NULL */
    unsigned least;              /* vertices */
    bool triangles, lines, closed, pairs;
} mode;

static const mode modes[] = {
    {NULL, "PointSet", NULL, NULL, 1, false, false, false, false},
    {"IndexedLineSet", NULL, "coordIndex", NULL, 2, false, true, false, true},
    {"IndexedLineSet", NULL, "coordIndex", NULL, 2, false, true, true, false},
    {"IndexedLineSet", NULL, "coordIndex", NULL, 2, false, true, false, false},
    {"IndexedTriangleSet", "TriangleSet", "index", NULL, 3, true, false, false, false},
    {"IndexedTriangleStripSet", "TriangleStripSet", "index", "stripCount", 3, true, false, false,
     false},
    {"IndexedTriangleFanSet", "TriangleFanSet", "index", "fanCount", 3, true, false, false, false},
};

enum {
    MODES = sizeof modes / sizeof *modes,
    USUAL_MODE = 4,
    MOST_OWN = 16, /* attributes of a primitive that the standard does not name */
    MOST_NAME = 100
};

/* What an accessor holds, as floats. */
typedef struct values {
    const float *items; /* NULL: they cannot be had */
    size_t count;
    unsigned components;
    gltf_box box; /* of the first three components */
} values;

typedef struct primitive {
    gltf *g;
    const x3d_json *json, *attributes;
    const mode *mode;
    size_t mode_number;
    size_t vertex_count;
    const gltf_indices *indices; /* NULL: the vertices in their order */
    size_t index_accessor;
    const gltf_material *material;
    plr_node *geometry;
} primitive;

void gltf_box_add(gltf_box *box, const double point[3]) {
    for (int i = 0; i < 3; i++) {
        box->least[i] = box->any ? fmin(box->least[i], point[i]) : point[i];
        box->most[i] = box->any ? fmax(box->most[i], point[i]) : point[i];
    }
    box->any = true;
}

/* ---- Vertices ---- */

static const values *values_of(gltf *g, const gltf_accessor *accessor, size_t index) {
    void **made = gltf_made(g, "values %zu", index);
    if (*made)
        return *made;
    values *v = PLR_NEW(g->scratch, values);
    *v = (values){gltf_floats(g, accessor), accessor->count, accessor->components, {0}};
    for (size_t i = 0; v->items && v->components >= 3 && i < v->count; i++) {
        const float *p = v->items + i * v->components;
        gltf_box_add(&v->box, (double[]){(double)p[0], (double)p[1], (double)p[2]});
    }
    *made = v;
    return v;
}

/* An attribute of `least` to `most` components; NULL: there is none that can be used. */
static const values *attribute(primitive *p, const char *name, unsigned least, unsigned most,
                               size_t *index) {
    const x3d_json *reference = x3d_json_member(p->attributes, name);
    const gltf_accessor *a = reference ? gltf_accessor_of(p->g, reference, index) : NULL;
    if (!a)
        return NULL;
    if (a->components < least || a->components > most) {
        x3d_report(p->g->scene, PLR_CODE_BAD_GEOMETRY, gltf_place(p->g, reference),
                   "%s has %u components", name, a->components);
        return NULL;
    }
    if (p->vertex_count && a->count != p->vertex_count) {
        x3d_report(p->g->scene, PLR_CODE_BAD_GEOMETRY, gltf_place(p->g, reference),
                   "%s has %zu elements for %zu vertices", name, a->count, p->vertex_count);
        return NULL;
    }
    const values *v = values_of(p->g, a, *index);
    return v->items ? v : NULL;
}

/* Points in the order of an index: X3D has no indexed PointSet. */
static const float *put_in_order(primitive *p, const float *items, unsigned components) {
    const gltf_indices *indices = p->indices;
    if (!indices || p->mode->indexed)
        return items;
    if (!gltf_afford(p->g, p->json, indices->count, components))
        return NULL;
    float *ordered =
        plr_arena_array(&p->g->scene->arena, indices->count, components * sizeof *ordered);
    for (size_t i = 0; i < indices->count; i++)
        memcpy(ordered + i * components, items + (size_t)indices->items[i] * components,
               components * sizeof *ordered);
    return ordered;
}

static bool is_ordered(const primitive *p) {
    return p->indices && !p->mode->indexed;
}

/* The node of a property, shared by all that use these values. */
static plr_node *property(primitive *p, const char *type, const char *field, const float *items,
                          size_t count, unsigned components, const x3d_json *from) {
    items = put_in_order(p, items, components);
    plr_node *node = items ? gltf_node(p->g, type, from) : NULL;
    gltf_set_list(p->g, node, field, items, is_ordered(p) ? p->indices->count : count, from);
    return node;
}

/* Adds the node to the geometry: one made before, or a new one. */
static void add_property(primitive *p, const char *slot, const char *type, const char *field,
                         const values *v, size_t index) {
    const x3d_json *from = p->g->accessors[index].json;
    void *none = NULL;
    void **made = is_ordered(p) ? &none : gltf_made(p->g, "%s %zu", type, index);
    if (!*made)
        *made = property(p, type, field, v->items, v->count, v->components, from);
    gltf_add_node(p->g, p->geometry, slot, *made);
}

static void add_colors(primitive *p) {
    size_t index;
    const values *v = attribute(p, "COLOR_0", 3, 4, &index);
    if (!v)
        return;
    add_property(p, "color", v->components == 3 ? "Color" : "ColorRGBA", "color", v, index);
    plr_node *color = plr_node_child(p->geometry, "color");
    if (color && !plr_node_field(color, "mode")->given) /* they multiply the material's colour */
        gltf_set_string(p->g, color, "mode", "MODULATE", 8, p->g->accessors[index].json);
}

/* X3D's t runs up, where the other runs down. */
static float *move_coordinates(primitive *p, const values *v, const gltf_set *set) {
    if (!gltf_afford(p->g, p->json, v->count, 2))
        return NULL;
    const float *m = set->transform;
    float *moved = plr_arena_array(&p->g->scene->arena, v->count, 2 * sizeof *moved);
    for (size_t i = 0; i < v->count; i++) {
        const float *from = v->items + 2 * i;
        moved[2 * i] = m[0] * from[0] + m[1] * from[1] + m[2];
        moved[2 * i + 1] = 1 - (m[3] * from[0] + m[4] * from[1] + m[5]);
    }
    return moved;
}

static plr_node *coordinates(primitive *p, const gltf_set *set) {
    char name[40];
    snprintf(name, sizeof name, "TEXCOORD_%zu", set->number);
    size_t index;
    const values *v = attribute(p, name, 2, 2, &index);
    if (!v)
        return NULL;
    const float *m = set->transform;
    void *none = NULL;
    void **made = is_ordered(p)
                      ? &none
                      : gltf_made(p->g, "tex %zu %a %a %a %a %a %a %s", index, (double)m[0],
                                  (double)m[1], (double)m[2], (double)m[3], (double)m[4],
                                  (double)m[5], set->mapping ? set->mapping : "");
    if (*made)
        return *made;
    const float *moved = move_coordinates(p, v, set);
    const x3d_json *from = p->g->accessors[index].json;
    plr_node *node =
        moved ? property(p, "TextureCoordinate", "point", moved, v->count, 2, from) : NULL;
    if (set->mapping)
        gltf_set_string(p->g, node, "mapping", set->mapping, strlen(set->mapping), from);
    *made = node;
    return node;
}

static void add_coordinates(primitive *p) {
    static const gltf_set first = {.transform = {1, 0, 0, 0, 1, 0}};
    const gltf_material *m = p->material;
    if (m->set_count < 2) { /* without a texture, an author's effect may want them */
        gltf_add_node(p->g, p->geometry, "texCoord",
                      coordinates(p, m->set_count ? &m->sets[0] : &first));
        return;
    }
    plr_node *all = gltf_node(p->g, "MultiTextureCoordinate", p->json);
    for (size_t i = 0; i < m->set_count; i++)
        gltf_add_node(p->g, all, "texCoord", coordinates(p, &m->sets[i]));
    if (all && plr_node_child(all, "texCoord"))
        gltf_add_node(p->g, p->geometry, "texCoord", all);
}

/* An attribute of the author's own, for effects: its name is that of the GLSL attribute. */
static void add_own(primitive *p, const x3d_json *member) {
    char name[MOST_NAME + 1];
    size_t index;
    memcpy(name, member->key, member->key_length);
    name[member->key_length] = '\0';
    const values *v = attribute(p, name, 1, 4, &index);
    const float *items = v ? put_in_order(p, v->items, v->components) : NULL;
    if (!items)
        return;
    plr_node *node = gltf_node(p->g, "FloatVertexAttribute", member);
    int32_t *components = PLR_NEW(&p->g->scene->arena, int32_t);
    *components = (int32_t)v->components;
    gltf_set_string(p->g, node, "name",
                    plr_arena_copy(&p->g->scene->arena, name, member->key_length),
                    member->key_length, member);
    gltf_set_list(p->g, node, "numComponents", components, 1, member);
    gltf_set_list(p->g, node, "value", items,
                  (is_ordered(p) ? p->indices->count : v->count) * v->components, member);
    gltf_add_node(p->g, p->geometry, "attrib", node);
}

static void add_all_own(primitive *p) {
    size_t count = 0;
    for (size_t i = 0; i < p->attributes->count && count < MOST_OWN; i++) {
        const x3d_json *member = &p->attributes->value.items[i];
        if (member->key_length && member->key[0] == '_' && member->key_length <= MOST_NAME &&
            !memchr(member->key, '\0', member->key_length)) {
            add_own(p, member);
            count++;
        }
    }
}

/* ---- Indices ---- */

/* False: they are wrong, nothing can be drawn (reported). */
static bool read_indices(primitive *p) {
    const x3d_json *reference = x3d_json_member(p->json, "indices");
    if (!reference)
        return true;
    const gltf_accessor *a = gltf_accessor_of(p->g, reference, &p->index_accessor);
    if (!a)
        return false;
    void **made = gltf_made(p->g, "indices %zu", p->index_accessor);
    if (!*made) {
        gltf_indices *indices = PLR_NEW(p->g->scratch, gltf_indices);
        gltf_integers(p->g, a, indices);
        *made = indices;
    }
    p->indices = *made;
    if (!p->indices->items)
        return false;
    if ((size_t)p->indices->largest < p->vertex_count)
        return true;
    x3d_report(p->g->scene, PLR_CODE_BAD_GEOMETRY, gltf_place(p->g, reference),
               "there is no vertex %d, only 0 to %zu", p->indices->largest, p->vertex_count - 1);
    return false;
}

static int32_t index_at(const primitive *p, size_t i) {
    return p->indices ? p->indices->items[i] : (int32_t)i;
}

/* Lines for an IndexedLineSet: -1 ends each. */
static const gltf_indices *lines_of(primitive *p, size_t count) {
    void **made = p->indices
                      ? gltf_made(p->g, "lines %zu of %zu", p->mode_number, p->index_accessor)
                      : gltf_made(p->g, "lines %zu to %zu", p->mode_number, count);
    if (*made)
        return *made;
    if (!gltf_afford(p->g, p->json, count, 2))
        return NULL;
    size_t used = 0;
    int32_t *items = PLR_NEW_ARRAY(&p->g->scene->arena, count + count / 2 + 2, int32_t);
    for (size_t i = 0; i < count - (p->mode->pairs ? count % 2 : 0); i++) {
        items[used++] = index_at(p, i);
        if (p->mode->pairs && i % 2)
            items[used++] = -1;
    }
    if (p->mode->closed)
        items[used++] = index_at(p, 0);
    gltf_indices *lines = PLR_NEW(p->g->scratch, gltf_indices);
    *lines = (gltf_indices){items, used, 0};
    *made = lines;
    return lines;
}

static void set_indices(primitive *p, size_t count) {
    const mode *m = p->mode;
    if (m->lines) {
        const gltf_indices *lines = lines_of(p, count);
        if (lines)
            gltf_set_list(p->g, p->geometry, m->index, lines->items, lines->count, p->json);
    } else if (p->indices && m->indexed) {
        gltf_set_list(p->g, p->geometry, m->index, p->indices->items, count,
                      p->g->accessors[p->index_accessor].json);
    } else if (m->count) {
        int32_t *length = PLR_NEW(&p->g->scene->arena, int32_t);
        *length = (int32_t)count;
        gltf_set_list(p->g, p->geometry, m->count, length, 1, p->json);
    }
}

/* ---- Primitives ---- */

static bool read_mode(primitive *p) {
    if (!gltf_size(p->g, p->json, "mode", USUAL_MODE, &p->mode_number))
        return false;
    if (p->mode_number < MODES) {
        p->mode = &modes[p->mode_number];
        return true;
    }
    x3d_report(p->g->scene, PLR_CODE_BAD_VALUE, gltf_place(p->g, x3d_json_member(p->json, "mode")),
               "a mode is 0 to %d", MODES - 1);
    return false;
}

static void make_geometry(primitive *p, const values *points, size_t point_index) {
    gltf *g = p->g;
    const mode *m = p->mode;
    size_t normal_index, count = p->indices ? p->indices->count : p->vertex_count;
    bool indexed = m->indexed && (p->indices || !m->plain);
    p->geometry = gltf_node(g, indexed ? m->indexed : m->plain, p->json);
    set_indices(p, count);
    add_property(p, "coord", "Coordinate", "point", points, point_index);
    const values *normals = attribute(p, "NORMAL", 3, 3, &normal_index);
    if (normals)
        add_property(p, "normal", "Normal", "vector", normals, normal_index);
    else if (m->triangles) /* flat, as the standard asks */
        gltf_set_bool(g, p->geometry, "normalPerVertex", false);
    add_colors(p);
    add_coordinates(p);
    add_all_own(p);
    if (m->triangles && p->material->two_sided)
        gltf_set_bool(g, p->geometry, "solid", false);
}

static plr_node *read_primitive(gltf *g, const x3d_json *json, gltf_box *box) {
    primitive p = {.g = g, .json = json};
    if (json->kind != X3D_JSON_OBJECT || !(p.attributes = gltf_object(g, json, "attributes"))) {
        x3d_report(g->scene, PLR_CODE_BAD_VALUE, gltf_place(g, json),
                   "a primitive is an object with attributes");
        return NULL;
    }
    if (gltf_needs_unknown(g, json) || !x3d_json_member(p.attributes, "POSITION") || !read_mode(&p))
        return NULL;
    size_t point_index;
    const values *points = attribute(&p, "POSITION", 3, 3, &point_index);
    if (!points)
        return NULL;
    p.vertex_count = points->count;
    if (!read_indices(&p))
        return NULL;
    if ((p.indices ? p.indices->count : p.vertex_count) < p.mode->least)
        return NULL; /* nothing to draw */
    const x3d_json *targets = gltf_list(g, json, "targets");
    if (targets && targets->count && !g->told_morph) {
        x3d_report(g->scene, PLR_CODE_NOT_DRAWN, gltf_place(g, targets),
                   "morph targets are not drawn yet");
        g->told_morph = true;
    }
    p.material = gltf_material_of(g, json);
    make_geometry(&p, points, point_index);
    gltf_box_add(box, points->box.least);
    gltf_box_add(box, points->box.most);
    plr_node *shape = gltf_node(g, "Shape", json);
    gltf_add_node(g, shape, "appearance", p.material->appearance);
    gltf_add_node(g, shape, "geometry", p.geometry);
    return shape;
}

static void read_mesh(gltf *g, const x3d_json *json, gltf_mesh *mesh) {
    const x3d_json *primitives = gltf_list(g, json, "primitives");
    plr_node *first = NULL, *group = NULL;
    for (size_t i = 0; primitives && i < primitives->count && !g->scene->stopped; i++) {
        plr_node *shape = read_primitive(g, &primitives->value.items[i], &mesh->box);
        if (!shape)
            continue;
        if (first && !group) {
            group = gltf_node(g, "Group", json);
            gltf_add_node(g, group, "children", first);
        }
        gltf_add_node(g, group, "children", shape);
        first = first ? first : shape;
    }
    mesh->node = group ? group : first;
    gltf_define_later(g, mesh->node, json);
}

const gltf_mesh *gltf_mesh_at(gltf *g, size_t index) {
    gltf_mesh *mesh = &g->meshes[index];
    if (!mesh->read) {
        mesh->read = true;
        read_mesh(g, &g->tables[GLTF_MESHES]->value.items[index], mesh);
    }
    return mesh;
}
