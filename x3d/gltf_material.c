/* Materials: ISO/IEC 12113 3.9. X3D 4 took its PhysicalMaterial from there, so most fields are
 * copied. */
#include "x3d/gltf_internal.h"

#include <math.h>
#include <string.h>

/* Where a texture stands in a material, and which fields it becomes. */
typedef struct slot {
    const char *group; /* object of the material that has it, or NULL */
    const char *key;
    const char *field, *mapping, *unlit_field, *unlit_mapping; /* unlit NULL: not in that model */
    const char *factor, *factor_field; /* a number of the reference, or NULL */
} slot;

static const slot slots[] = {
    {"pbrMetallicRoughness", "baseColorTexture", "baseTexture", "baseTextureMapping",
     "emissiveTexture", "emissiveTextureMapping", NULL, NULL},
    {"pbrMetallicRoughness", "metallicRoughnessTexture", "metallicRoughnessTexture",
     "metallicRoughnessTextureMapping", NULL, NULL, NULL, NULL},
    {NULL, "normalTexture", "normalTexture", "normalTextureMapping", NULL, NULL, "scale",
     "normalScale"},
    {NULL, "occlusionTexture", "occlusionTexture", "occlusionTextureMapping", NULL, NULL,
     "strength", "occlusionStrength"},
    {NULL, "emissiveTexture", "emissiveTexture", "emissiveTextureMapping", NULL, NULL, NULL, NULL},
};

enum {
    SLOTS = sizeof slots / sizeof *slots
};

_Static_assert((int)SLOTS <= (int)GLTF_MOST_SETS, "each texture may want coordinates of its own");

typedef struct reader {
    gltf *g;
    const x3d_json *json; /* NULL: the material of primitives without one */
    const x3d_json *from; /* for places */
    bool unlit;
    plr_node *node;
    gltf_material *material;
    const char *mapping_fields[SLOTS]; /* of the textures that are there */
    size_t mapping_sets[SLOTS];
    size_t mapping_count;
} reader;

/* KHR_texture_transform: offset, then rotation, then scale. Its README's example ("the lower left
 * quadrant, rotated clockwise", by a positive angle) settles the sense of the rotation: v runs
 * down.
 */
static void read_transform(gltf *g, const x3d_json *reference, gltf_set *set) {
    const x3d_json *json = gltf_extension(g, reference, "KHR_texture_transform");
    double offset[2] = {0, 0}, scale[2] = {1, 1};
    gltf_numbers(g, json, "offset", offset, 2);
    gltf_numbers(g, json, "scale", scale, 2);
    double angle = gltf_number(g, json, "rotation", 0);
    double c = cos(angle), s = sin(angle);
    const double transform[6] = {c * scale[0],  s * scale[1], offset[0],
                                 -s * scale[0], c * scale[1], offset[1]};
    for (int i = 0; i < 6; i++)
        set->transform[i] = (float)transform[i];
    size_t number;
    if (json && gltf_size(g, json, "texCoord", set->number, &number))
        set->number = number;
}

/* The number of the set of coordinates that a texture wants, among those of the material. */
static size_t find_set(reader *r, const x3d_json *reference) {
    gltf_material *m = r->material;
    gltf_set set = {0};
    if (!gltf_size(r->g, reference, "texCoord", 0, &set.number))
        set.number = 0;
    read_transform(r->g, reference, &set);
    for (size_t i = 0; i < m->set_count; i++)
        if (m->sets[i].number == set.number &&
            memcmp(m->sets[i].transform, set.transform, sizeof set.transform) == 0)
            return i;
    m->sets[m->set_count] = set;
    return m->set_count++;
}

static void read_slot(reader *r, const slot *s) {
    gltf *g = r->g;
    const char *field = r->unlit ? s->unlit_field : s->field;
    const x3d_json *owner = s->group ? gltf_object(g, r->json, s->group) : r->json;
    const x3d_json *reference = field ? gltf_object(g, owner, s->key) : NULL;
    plr_node *texture = reference ? gltf_texture(g, reference) : NULL;
    if (!texture)
        return;
    gltf_add_node(g, r->node, field, texture);
    if (s->factor && x3d_json_member(reference, s->factor))
        gltf_set_number(g, r->node, s->factor_field, gltf_number(g, reference, s->factor, 1));
    r->mapping_fields[r->mapping_count] = r->unlit ? s->unlit_mapping : s->mapping;
    r->mapping_sets[r->mapping_count++] = find_set(r, reference);
}

/* Names are needed only where there is a choice. */
static void name_sets(reader *r) {
    gltf_material *m = r->material;
    if (m->set_count < 2)
        return;
    for (size_t i = 0; i < m->set_count; i++)
        m->sets[i].mapping = plr_arena_format(&r->g->scene->arena, "set%zu", i);
    for (size_t i = 0; i < r->mapping_count; i++) {
        const char *name = m->sets[r->mapping_sets[i]].mapping;
        gltf_set_string(r->g, r->node, r->mapping_fields[i], name, strlen(name), r->from);
    }
}

static void read_factors(reader *r) {
    gltf *g = r->g;
    const x3d_json *pbr = gltf_object(g, r->json, "pbrMetallicRoughness");
    double base[4] = {1, 1, 1, 1}, emissive[3] = {0, 0, 0};
    if (gltf_numbers(g, pbr, "baseColorFactor", base, 4)) {
        gltf_set_numbers(g, r->node, r->unlit ? "emissiveColor" : "baseColor", base, 3);
        if (base[3] < 1)
            gltf_set_number(g, r->node, "transparency", 1 - fmax(base[3], 0));
    }
    if (r->unlit)
        return;
    if (x3d_json_member(pbr, "metallicFactor"))
        gltf_set_number(g, r->node, "metallic", gltf_between(g, pbr, "metallicFactor", 1, 0, 1));
    if (x3d_json_member(pbr, "roughnessFactor"))
        gltf_set_number(g, r->node, "roughness", gltf_between(g, pbr, "roughnessFactor", 1, 0, 1));
    if (!gltf_numbers(g, r->json, "emissiveFactor", emissive, 3))
        return;
    const x3d_json *strength = gltf_extension(g, r->json, "KHR_materials_emissive_strength");
    double factor = gltf_number(g, strength, "emissiveStrength", 1);
    for (int i = 0; i < 3; i++)
        emissive[i] *= factor;
    gltf_set_numbers(g, r->node, "emissiveColor", emissive, 3);
}

static void set_alpha(gltf *g, plr_node *appearance, const x3d_json *json, const x3d_json *from) {
    static const char *const modes[] = {"OPAQUE", "MASK", "BLEND"};
    const x3d_json *given = gltf_text(g, json, "alphaMode");
    const char *mode = given ? NULL : modes[0];
    for (size_t i = 0; i < sizeof modes / sizeof *modes; i++)
        if (x3d_json_is(given, modes[i]))
            mode = modes[i];
    if (!mode) {
        x3d_report(g->scene, PLR_CODE_BAD_VALUE, gltf_place(g, given),
                   "'alphaMode' is none of OPAQUE, MASK, BLEND");
        mode = modes[0];
    }
    gltf_set_string(g, appearance, "alphaMode", mode, strlen(mode), given ? given : from);
    if (x3d_json_member(json, "alphaCutoff"))
        gltf_set_number(g, appearance, "alphaCutoff",
                        gltf_between(g, json, "alphaCutoff", 0.5, 0, 1));
}

static void read_material(gltf *g, const x3d_json *json, const x3d_json *from,
                          gltf_material *material) {
    reader r = {.g = g, .json = json, .from = from, .material = material};
    r.unlit = gltf_extension(g, json, "KHR_materials_unlit") != NULL;
    r.node = gltf_node(g, r.unlit ? "UnlitMaterial" : "PhysicalMaterial", from);
    material->read = true;
    material->two_sided = gltf_bool(g, json, "doubleSided", false);
    material->appearance = gltf_node(g, "Appearance", from);
    read_factors(&r);
    for (size_t i = 0; i < SLOTS; i++)
        read_slot(&r, &slots[i]);
    name_sets(&r);
    gltf_add_node(g, material->appearance, "material", r.node);
    set_alpha(g, material->appearance, json, from);
    gltf_define_later(g, r.node, json);
}

const gltf_material *gltf_material_of(gltf *g, const x3d_json *primitive) {
    size_t index = 0;
    const x3d_json *json = gltf_refer(g, primitive, "material", GLTF_MATERIALS, &index);
    gltf_material *material = json ? &g->materials[index] : &g->standard_material;
    if (!material->read)
        read_material(g, json, json ? json : primitive, material);
    return material;
}
