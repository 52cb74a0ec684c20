#include "engine/bind.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "engine/projector.h"
#include "engine/light_values.h"

/* ---- GLSL types and the field types that fit them ---- */

typedef enum shape {
    SHAPE_FLOAT,
    SHAPE_INT,
    SHAPE_MATRIX,
    SHAPE_SAMPLER
} shape;

static const struct glsl_type {
    const char *name;
    shape shape;
    int components;
    const char *fields; /* element types that may be bound, without SF or MF */
} glsl_types[] = {
    {"float", SHAPE_FLOAT, 1, " Float Double Time "},
    {"vec2", SHAPE_FLOAT, 2, " Vec2f Vec2d "},
    {"vec3", SHAPE_FLOAT, 3, " Vec3f Vec3d Color "},
    {"vec4", SHAPE_FLOAT, 4, " Vec4f Vec4d ColorRGBA Rotation Color "},
    {"bool", SHAPE_INT, 1, " Bool "},
    {"int", SHAPE_INT, 1, " Int32 "},
    {"mat3", SHAPE_MATRIX, 9, " Matrix3f Matrix3d "},
    {"mat4", SHAPE_MATRIX, 16, " Matrix4f Matrix4d "},
    /* of samplers: the kind of texture that they read */
    {"sampler2D", SHAPE_SAMPLER, PLR_TEXTURE_2D, " Node "},
    {"sampler3D", SHAPE_SAMPLER, PLR_TEXTURE_3D, " Node "},
    {"samplerCube", SHAPE_SAMPLER, PLR_TEXTURE_CUBE, " Node "},
    {"sampler2DShadow", SHAPE_SAMPLER, PLR_TEXTURE_2D_SHADOW, " Node "},
    {"samplerCubeShadow", SHAPE_SAMPLER, PLR_TEXTURE_CUBE_SHADOW, " Node "},
};

static const struct glsl_type *find_glsl_type(const char *name) {
    for (size_t i = 0; i < sizeof glsl_types / sizeof *glsl_types; i++)
        if (strcmp(glsl_types[i].name, name) == 0)
            return &glsl_types[i];
    return NULL;
}

static bool field_fits(const plr_field *field, const struct glsl_type *type, bool array) {
    char element[32];
    snprintf(element, sizeof element, " %s ", plr_type_name(field->type) + 2);
    return type && strstr(type->fields, element) && plr_type_is_multiple(field->type) == array;
}

/* A field by path: "material_diffuseColor" is the field diffuseColor of the node in material. */
static const plr_field *field_by_path(const plr_node *node, const char *path) {
    const plr_field *field = plr_node_field(node, path);
    const char *split = strchr(path, '_');
    if (field || !split || split - path >= 64)
        return field;
    char head[64];
    snprintf(head, sizeof head, "%.*s", (int)(split - path), path);
    const plr_node *child = plr_node_child(node, head);
    return child ? field_by_path(child, split + 1) : NULL;
}

/* ---- Values that the engine knows ---- */

typedef struct context {
    const plr_values *values;
    const plr_binding *binding; /* NULL: base or library */
    const plr_volume_state *volume;
} context;

static plr_matrix model_view(const context *c) {
    return plr_matrix_multiply(&c->values->frame->view, &c->values->to_world);
}

static void put(const plr_matrix *m, float *out) {
    plr_matrix_to_floats(m, out);
}

static void put_inverse(const plr_matrix *m, float *out) {
    plr_matrix inverse;
    plr_matrix_invert(m, &inverse);
    put(&inverse, out);
}

static void v_model_view(const context *c, float *out) {
    plr_matrix m = model_view(c);
    put(&m, out);
}
static void v_inverse_model_view(const context *c, float *out) {
    plr_matrix m = model_view(c);
    put_inverse(&m, out);
}
static void v_normal(const context *c, float *out) {
    plr_matrix m = model_view(c);
    plr_matrix_to_normal_floats(&m, out);
}
static void v_projection(const context *c, float *out) {
    put(&c->values->frame->projection, out);
}
static void v_inverse_projection(const context *c, float *out) {
    put_inverse(&c->values->frame->projection, out);
}
static void v_view(const context *c, float *out) {
    put(&c->values->frame->view, out);
}
static void v_inverse_view(const context *c, float *out) {
    put_inverse(&c->values->frame->view, out);
}
static void v_model(const context *c, float *out) {
    put(&c->values->to_world, out);
}
static void v_inverse_model(const context *c, float *out) {
    put_inverse(&c->values->to_world, out);
}
static void v_viewport(const context *c, float *out) {
    for (int i = 0; i < 4; i++)
        out[i] = (float)c->values->frame->viewport[i];
}
static void v_viewport_size(const context *c, float *out) {
    out[0] = (float)c->values->frame->viewport[2];
    out[1] = (float)c->values->frame->viewport[3];
}
static void v_cut(const context *c, float *out) {
    out[0] = (float)c->values->frame->cut[0];
    out[1] = (float)fmin(c->values->frame->cut[1], 3e38);
}
static void v_depth_to_clip(const context *c, float *out) {
    out[0] = c->values->frame->reversed_depth ? 1 : 2;
    out[1] = c->values->frame->reversed_depth ? 0 : -1;
}
static void v_empty_depth(const context *c, float *out) {
    out[0] = c->values->frame->reversed_depth ? 0 : 1;
}
static void v_time(const context *c, float *out) {
    out[0] = (float)c->values->frame->time;
}
/* A ray ends where what is left is below an eighth of the error that one 8-bit step is. */
static void v_transparency_left(const context *c, float *out) {
    (void)c;
    out[0] = 1.0f / 255.0f / 8.0f;
}
static void v_node_to_eye(const context *c, float *out) {
    plr_matrix m = c->binding->to_world;
    if (!c->binding->in_eye_space)
        m = plr_matrix_multiply(&c->values->frame->view, &m);
    put(&m, out);
}
static void v_light_direction(const context *c, float *out) {
    plr_light_direction(c->binding, &c->values->frame->view, out);
}
static void v_light_location(const context *c, float *out) {
    plr_light_location(c->binding, &c->values->frame->view, out);
}
/* From lengths in eye space to the node's own; of a node that is scaled otherwise along each axis,
 * their geometric mean. */
static void v_length_to_node(const context *c, float *out) {
    double scale = cbrt(fabs(plr_matrix_determinant3(&c->binding->to_world)));
    out[0] = scale > 0 ? (float)(1 / scale) : 0;
}
static void v_eye_to_node(const context *c, float *out) {
    plr_matrix m = c->binding->to_world;
    if (!c->binding->in_eye_space)
        m = plr_matrix_multiply(&c->values->frame->view, &m);
    put_inverse(&m, out);
}
static void v_eye_to_local(const context *c, float *out) {
    plr_matrix m = plr_matrix_multiply(&c->values->frame->view, &c->volume->to_world);
    put_inverse(&m, out);
}
static void v_dimensions(const context *c, float *out) {
    for (int i = 0; i < 3; i++)
        out[i] = (float)c->volume->dimensions[i];
}
static void v_step(const context *c, float *out) {
    out[0] = (float)c->volume->step;
}
static void v_reference(const context *c, float *out) {
    out[0] = (float)c->volume->reference;
}
static void v_gradient_unit(const context *c, float *out) {
    out[0] = (float)c->volume->gradient_unit;
}

static void v_volume_index(const context *c, float *out) {
    out[0] = (float)c->volume->index;
}

static void v_eye_to_shadow(const context *c, float *out) {
    plr_matrix to_world;
    plr_matrix_invert(&c->values->frame->view, &to_world);
    plr_matrix m = plr_matrix_multiply(&c->binding->shadow->from_world, &to_world);
    put(&m, out);
}
static void v_shadow_axis(const context *c, float *out) {
    const double *axis = c->binding->shadow->axis, *m = c->values->frame->view.m;
    for (int row = 0; row < 3; row++)
        out[row] = (float)(m[row] * axis[0] + m[4 + row] * axis[1] + m[8 + row] * axis[2]);
}
static void v_shadow_texel(const context *c, float *out) {
    out[0] = (float)c->binding->shadow->texel;
}
static void v_shadow_depths(const context *c, float *out) {
    out[0] = (float)c->binding->shadow->depths[0];
    out[1] = (float)c->binding->shadow->depths[1];
}
static void v_shadow_offset(const context *c, float *out) {
    out[0] = (float)c->binding->shadow->offset;
}
static void v_shadow_depth_bias(const context *c, float *out) {
    out[0] = (float)c->binding->shadow->depth_bias;
}

/* From eye space to the projector's clip space, from 0 to 1 in s, t and r. */
static void v_eye_to_projector(const context *c, float *out) {
    const plr_node *node = c->binding->node;
    const plr_node *projector = node ? plr_node_child(node, "projector") : NULL;
    plr_matrix from_world = plr_projector_clip(c->values->view, projector), to_world;
    plr_matrix scale = plr_matrix_scale(0.5, 0.5, 0.5);
    plr_matrix product = plr_matrix_translation(0.5, 0.5, 0.5);
    plr_matrix_invert(&c->values->frame->view, &to_world);
    const plr_matrix *steps[] = {&scale, &from_world, &to_world};
    for (size_t i = 0; i < sizeof steps / sizeof *steps; i++)
        product = plr_matrix_multiply(&product, steps[i]);
    put(&product, out);
}

typedef enum owner {
    OWNER_HOST,   /* base and library */
    OWNER_NODE,   /* a built-in effect with a node or the headlight */
    OWNER_VOLUME, /* a built-in effect of a volume */
    OWNER_SHADOW, /* the effect of a shadow map */
} owner;

static const struct known {
    const char *name;
    owner owner;
    void (*value)(const context *, float *);
} known[] = {
    {"castle_ModelViewMatrix", OWNER_HOST, v_model_view},
    {"castle_ProjectionMatrix", OWNER_HOST, v_projection},
    {"castle_NormalMatrix", OWNER_HOST, v_normal},
    {"plugray_ModelMatrix", OWNER_HOST, v_model},
    {"plugray_InverseModelMatrix", OWNER_HOST, v_inverse_model},
    {"plugray_ViewMatrix", OWNER_HOST, v_view},
    {"plugray_InverseViewMatrix", OWNER_HOST, v_inverse_view},
    {"plugray_ModelViewMatrix", OWNER_HOST, v_model_view},
    {"plugray_InverseModelViewMatrix", OWNER_HOST, v_inverse_model_view},
    {"plugray_ProjectionMatrix", OWNER_HOST, v_projection},
    {"plugray_InverseProjectionMatrix", OWNER_HOST, v_inverse_projection},
    {"plugray_NormalMatrix", OWNER_HOST, v_normal},
    {"plugray_ViewportSize", OWNER_HOST, v_viewport_size},
    {"plugray_Time", OWNER_HOST, v_time},
    {"viewport", OWNER_HOST, v_viewport},
    {"viewpointCut", OWNER_HOST, v_cut},
    {"depthToClip", OWNER_HOST, v_depth_to_clip},
    {"emptyDepth", OWNER_HOST, v_empty_depth},
    {"transparencyLeft", OWNER_HOST, v_transparency_left},
    {"nodeToEye", OWNER_NODE, v_node_to_eye},
    {"eyeToProjector", OWNER_NODE, v_eye_to_projector},
    {"eyeToNode", OWNER_NODE, v_eye_to_node},
    {"lengthToNode", OWNER_NODE, v_length_to_node},
    {"light_direction_eye", OWNER_NODE, v_light_direction},
    {"light_location_eye", OWNER_NODE, v_light_location},
    {"eyeToLocal", OWNER_VOLUME, v_eye_to_local},
    {"dimensions", OWNER_VOLUME, v_dimensions},
    {"sampleDistance", OWNER_VOLUME, v_step},
    {"referenceLength", OWNER_VOLUME, v_reference},
    {"gradientUnit", OWNER_VOLUME, v_gradient_unit},
    {"volumeIndex", OWNER_VOLUME, v_volume_index},
    {"eyeToShadow", OWNER_SHADOW, v_eye_to_shadow},
    {"shadowAxis", OWNER_SHADOW, v_shadow_axis},
    {"shadowTexel", OWNER_SHADOW, v_shadow_texel},
    {"shadowDepths", OWNER_SHADOW, v_shadow_depths},
    {"shadowOffset", OWNER_SHADOW, v_shadow_offset},
    {"shadowDepthBias", OWNER_SHADOW, v_shadow_depth_bias},
};

static const struct known *find_known(const char *name, const plr_binding *binding) {
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        bool fits = known[i].owner == OWNER_HOST     ? !binding
                    : known[i].owner == OWNER_NODE   ? binding != NULL
                    : known[i].owner == OWNER_SHADOW ? binding && binding->shadow
                                                     : binding && binding->volume != PLR_NO_EFFECT;
        if (fits && strcmp(known[i].name, name) == 0)
            return &known[i];
    }
    return NULL;
}

/* ---- Checks that need no GL ---- */

static bool is_word(char c) {
    return c == '_' || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

static bool text_has_word(const char *text, const char *word) {
    size_t length = strlen(word);
    for (const char *at = text; (at = strstr(at, word)); at++)
        if ((at == text || !is_word(at[-1])) && !is_word(at[length]))
            return true;
    return false;
}

static void warn_unused_fields(const plr_effect *effect, const plr_node *node, plr_diags *diags) {
    if (strcmp(plr_node_string(node, "uniformMissing"), "IGNORE") == 0)
        return;
    for (size_t i = 0; i < plr_node_field_count(node); i++) {
        const plr_field *field = plr_node_field_at(node, i);
        bool found = !field->declared;
        for (size_t s = 0; !found && s < effect->source_count; s++)
            found = text_has_word(plr_source_text(effect->sources[s], NULL), field->name);
        if (!found)
            plr_diags_add(diags, PLR_CODE_UNUSED_FIELD, field->place,
                          "no part of the effect has a uniform '%s'", field->name);
    }
}

static const char *sampler_name(plr_texture_kind kind) {
    for (size_t i = 0; i < sizeof glsl_types / sizeof *glsl_types; i++)
        if (glsl_types[i].shape == SHAPE_SAMPLER && glsl_types[i].components == (int)kind)
            return glsl_types[i].name;
    return "";
}

/* Whether the textures in the field are of the kind that the sampler reads; reports the first that
 * is not. */
static bool check_textures(plr_kitchen *k, const plr_symbol *symbol, const plr_field *field,
                           const struct glsl_type *type) {
    for (size_t i = 0; i < field->count && i < (symbol->array ? symbol->array : 1); i++) {
        const plr_node *node = field->value.nodes[i];
        const plr_texture *texture = node ? plr_textures_get(k->textures, node) : NULL;
        if (!node || (texture && (int)texture->kind == type->components))
            continue;
        if (texture)
            plr_diags_add(k->diags, PLR_CODE_UNIFORM_TYPE, field->place,
                          "the field '%s' holds a texture for %s, its uniform is %s", field->name,
                          sampler_name(texture->kind), symbol->type);
        else
            plr_diags_add(k->diags, PLR_CODE_UNIFORM_TYPE, field->place,
                          "the field '%s' holds %s, which no sampler can read", field->name,
                          plr_node_type(node));
        plr_diags_note(k->diags, symbol->place, "the uniform is declared here");
        return false;
    }
    return true;
}

/* Whether the uniform fits; reports if not. */
static bool check_symbol(plr_kitchen *k, const plr_symbol *symbol, const plr_node *node) {
    plr_diags *diags = k->diags;
    const plr_field *field = plr_node_field(node, symbol->name);
    if (!field || !field->declared) {
        if (!symbol->initialized)
            plr_diags_add(diags, PLR_CODE_UNSET_UNIFORM, symbol->place,
                          "the effect has no field '%s' to set this uniform", symbol->name);
        return true;
    }
    const struct glsl_type *type = find_glsl_type(symbol->type);
    if (field_fits(field, type, symbol->array != 0))
        return type->shape != SHAPE_SAMPLER || check_textures(k, symbol, field, type);
    plr_diags_add(diags, PLR_CODE_UNIFORM_TYPE, field->place,
                  "the field '%s' is %s, its uniform is %s%s", field->name,
                  plr_type_name(field->type), symbol->type, symbol->array ? "[]" : "");
    plr_diags_note(diags, symbol->place, "the uniform is declared here");
    return false;
}

bool plr_bind_check(plr_kitchen *k, plr_recipe *recipe, const plr_program *program) {
    bool again = false;
    for (size_t i = 0; i < plr_program_symbol_count(program); i++) {
        const plr_symbol *symbol = plr_program_symbol(program, i);
        const plr_binding *light;
        if (symbol->kind != PLR_UNIFORM || plr_light_value_find(recipe, symbol->name, &light))
            continue;
        if (symbol->effect == PLR_NO_EFFECT) {
            if (recipe->base_node && !find_known(symbol->name, NULL))
                check_symbol(k, symbol, recipe->base_node);
            continue;
        }
        if (recipe->effects.items[symbol->effect].builtin)
            continue;
        if (!check_symbol(k, symbol, recipe->bindings.items[symbol->effect].node)) {
            recipe->effects.items[symbol->effect].disabled = true;
            again = true;
        }
    }
    for (size_t i = 0; !again && i < recipe->effects.count; i++) {
        const plr_effect *effect = &recipe->effects.items[i];
        if (!effect->builtin && !effect->disabled)
            warn_unused_fields(effect, recipe->bindings.items[i].node, k->diags);
    }
    return again;
}

/* ---- Slots ---- */

struct plr_slot {
    GLint location;
    const struct glsl_type *type;
    const plr_binding *binding;
    const struct known *known;
    const plr_light_value *light_value; /* of `binding` */
    const plr_field *field;
    const plr_node *node; /* whose field it is */
    size_t volume;        /* for `known` and the voxels */
    uint32_t array;
    enum {
        SLOT_VALUE,
        SLOT_FIELD,
        SLOT_LIGHT,
        SLOT_COUNT,
        SLOT_TEXTURE,
        SLOT_VOXELS,
        SLOT_DEFAULT_RAMP,
        SLOT_OPAQUE_DEPTH
    } source;
    plr_texture *texture; /* NULL: none; the sampler reads black */
    unsigned unit;
    plr_texture_use use;
};

/* "skyColor_count" is the number of elements of the field skyColor. */
static const plr_field *counted_field(const plr_node *node, const char *name) {
    char field[64];
    size_t length = strlen(name), tail = strlen("_count");
    if (length <= tail || length >= sizeof field || strcmp(name + length - tail, "_count") != 0)
        return NULL;
    snprintf(field, sizeof field, "%.*s", (int)(length - tail), name);
    return plr_node_field(node, field);
}

/* Where the value of a uniform comes from; false if nothing is known (its initialiser stands). */
static bool find_source(plr_kitchen *k, const plr_symbol *symbol, const plr_binding *binding,
                        bool builtin, size_t element, plr_slot *slot) {
    if (slot->type->shape == SHAPE_SAMPLER && !binding) {
        slot->source = SLOT_OPAQUE_DEPTH;
        return strcmp(symbol->name, "opaqueDepth") == 0;
    }
    if (slot->type->shape == SHAPE_SAMPLER && builtin && slot->volume != PLR_NO_EFFECT &&
        strcmp(symbol->name, "voxels") == 0) {
        slot->source = SLOT_VOXELS;
        return true;
    }
    if (slot->type->shape == SHAPE_SAMPLER && builtin && binding->shadow &&
        strcmp(symbol->name, "shadowMap") == 0) {
        slot->source = SLOT_TEXTURE;
        slot->texture = binding->shadow->texture;
        slot->use = PLR_USE_VOLUME;
        return true;
    }
    if (slot->type->shape == SHAPE_SAMPLER && builtin && strcmp(symbol->name, "self") == 0) {
        slot->source = SLOT_TEXTURE;
        slot->texture =
            binding->texture ? binding->texture : plr_textures_get(k->textures, binding->node);
        return slot->texture != NULL;
    }
    if (slot->type->shape == SHAPE_SAMPLER && builtin && slot->volume != PLR_NO_EFFECT &&
        strcmp(symbol->name, "transferFunction") == 0 &&
        !plr_textures_in(k->textures, binding->node, symbol->name)) {
        slot->source = SLOT_DEFAULT_RAMP;
        return true;
    }
    if (slot->light_value && slot->type->shape == SHAPE_FLOAT) {
        slot->source = SLOT_LIGHT;
        return true;
    }
    if (!binding || builtin)
        slot->known = find_known(symbol->name, binding);
    if (slot->known) {
        slot->source = SLOT_VALUE;
        return true;
    }
    if (!binding || !binding->node)
        return false;
    slot->source = SLOT_COUNT;
    if (builtin && (slot->field = counted_field(binding->node, symbol->name)))
        return slot->type->shape == SHAPE_INT;
    slot->field = builtin ? field_by_path(binding->node, symbol->name)
                          : plr_node_field(binding->node, symbol->name);
    slot->source = SLOT_FIELD;
    if (!slot->field || !field_fits(slot->field, slot->type, symbol->array != 0))
        return false;
    if (slot->type->shape != SHAPE_SAMPLER)
        return true;
    slot->source = SLOT_TEXTURE;
    if (builtin && slot->volume != PLR_NO_EFFECT)
        slot->use = PLR_USE_CLAMPED;
    if (element < slot->field->count && slot->field->value.nodes[element])
        slot->texture = plr_textures_get(k->textures, slot->field->value.nodes[element]);
    return slot->texture && (int)slot->texture->kind == slot->type->components;
}

/* A program of volumes reads textures in a loop along a ray. */
static bool is_of_volumes(const plr_recipe *recipe) {
    for (size_t i = 0; i < recipe->bindings.count; i++)
        if (recipe->bindings.items[i].volume != PLR_NO_EFFECT)
            return true;
    return false;
}

void plr_bind_find(plr_kitchen *k, const plr_gl *gl, const plr_recipe *recipe,
                   const plr_program *program, const plr_built *built, plr_slots *slots) {
    slots->defaults = NULL;
    unsigned units = 0;
    plr_texture_use use = is_of_volumes(recipe) ? PLR_USE_VOLUME : PLR_USE_SURFACE;
    for (size_t i = 0; i < plr_program_symbol_count(program); i++) {
        const plr_symbol *symbol = plr_program_symbol(program, i);
        bool own = symbol->effect == PLR_NO_EFFECT;
        const plr_binding *binding = own ? NULL : &recipe->bindings.items[symbol->effect];
        if (own && recipe->base_node && !find_known(symbol->name, NULL)) {
            plr_binding *base = PLR_NEW(k->arena, plr_binding); /* a complete shader's own fields */
            *base = (plr_binding){.node = recipe->base_node, .volume = PLR_NO_EFFECT};
            binding = base;
        }
        plr_slot slot = {.binding = binding,
                         .array = symbol->array,
                         .type = find_glsl_type(symbol->type),
                         .use = use,
                         .volume = binding ? binding->volume : PLR_NO_EFFECT};
        if (symbol->kind == PLR_UNIFORM && !slot.type)
            slots->defaults = built->defaults;
        if (symbol->kind != PLR_UNIFORM || !slot.type)
            continue;
        bool builtin = !own && recipe->effects.items[symbol->effect].builtin;
        if (!builtin && (slot.light_value = plr_light_value_find(recipe, symbol->name, &binding)))
            slot.binding = binding;
        slot.location = gl->GetUniformLocation(built->name, symbol->program);
        if (slot.location < 0)
            continue;
        /* every sampler of an array is a slot of its own */
        bool many = slot.type->shape == SHAPE_SAMPLER && symbol->array;
        for (uint32_t element = 0; element < (many ? symbol->array : 1); element++) {
            plr_slot one = slot;
            one.location += (GLint)element;
            bool found = find_source(k, symbol, binding, builtin, element, &one);
            if (!found && one.type->shape != SHAPE_SAMPLER) {
                slots->defaults = built->defaults;
                break;
            }
            if (!found) { /* samplers of two kinds must not stay at one unit */
                one.source = SLOT_TEXTURE;
                one.texture = NULL;
            }
            if (one.type->shape == SHAPE_SAMPLER)
                one.unit = units++;
            else if (one.field && one.array > one.field->count)
                slots->defaults = built->defaults; /* for the rest of the array */
            *PLR_PUSH(k->arena, slots) = one;
        }
    }
}

bool plr_bind_needs(const plr_slots *slots, const char *name) {
    for (size_t i = 0; i < slots->count; i++)
        if (slots->items[i].known && strcmp(slots->items[i].known->name, name) == 0)
            return true;
    return false;
}

const plr_texture *plr_bind_next_texture(const plr_slots *slots, size_t *at) {
    for (; *at < slots->count; ++*at)
        if (slots->items[*at].source == SLOT_TEXTURE && slots->items[*at].texture)
            return slots->items[(*at)++].texture;
    return NULL;
}

bool plr_bind_reads(const plr_slots *slots, const plr_texture *texture) {
    for (size_t i = 0; i < slots->count; i++)
        if (slots->items[i].source == SLOT_TEXTURE && slots->items[i].texture == texture)
            return true;
    return false;
}

static void set_floats(const plr_gl *gl, const plr_slot *slot, GLsizei count, const float *values,
                       bool transpose) {
    switch (slot->type->components) {
    case 1:
        gl->Uniform1fv(slot->location, count, values);
        break;
    case 2:
        gl->Uniform2fv(slot->location, count, values);
        break;
    case 3:
        gl->Uniform3fv(slot->location, count, values);
        break;
    case 4:
        gl->Uniform4fv(slot->location, count, values);
        break;
    case 9:
        gl->UniformMatrix3fv(slot->location, count, transpose, values);
        break;
    case 16:
        gl->UniformMatrix4fv(slot->location, count, transpose, values);
        break;
    default:
        break;
    }
}

/* One element of a field as floats; a colour for a vec4 is opaque. */
static void element_floats(const plr_field *field, size_t index, int wanted, float *out) {
    int have = plr_type_components(field->type);
    for (int c = 0; c < wanted; c++) {
        size_t at = index * (size_t)have + (size_t)c;
        if (c >= have)
            out[c] = 1;
        else
            out[c] = plr_type_kind(field->type) == PLR_DOUBLE ? (float)field->value.doubles[at]
                                                              : field->value.floats[at];
    }
}

/* Matrix fields are written row by row (ISO/IEC 19776-1 5.14): GL transposes them. */
static void set_field(const plr_gl *gl, const plr_slot *slot) {
    const plr_field *field = slot->field;
    size_t count = slot->array ? field->count : 1;
    if (slot->array && count > slot->array)
        count = slot->array;
    for (size_t i = 0; i < count && i < field->count; i++) {
        plr_slot one = *slot;
        one.location += (GLint)i;
        float values[16];
        if (slot->type->shape == SHAPE_INT) {
            bool is_bool = plr_type_kind(field->type) == PLR_BOOL;
            GLint value = is_bool ? field->value.bools[i] : field->value.ints[i];
            gl->Uniform1i(one.location, value);
        } else {
            element_floats(field, i, slot->type->components, values);
            set_floats(gl, &one, 1, values, slot->type->shape == SHAPE_MATRIX);
        }
    }
}

static void unbind_texture(const plr_gl *gl, const plr_slot *slot) {
    gl->ActiveTexture(GL_TEXTURE0 + slot->unit);
    gl->BindTexture(plr_texture_target((plr_texture_kind)slot->type->components), 0);
    gl->BindSampler(slot->unit, 0);
}

static void set_slot(const plr_gl *gl, plr_textures *textures, const plr_slot *slot,
                     const plr_values *values) {
    const plr_volume_state *volume =
        slot->volume < values->volume_count ? &values->volumes[slot->volume] : NULL;
    float numbers[16];
    switch (slot->source) {
    case SLOT_VALUE:
        slot->known->value(&(context){values, slot->binding, volume}, numbers);
        if (slot->type->shape == SHAPE_INT)
            gl->Uniform1i(slot->location, (GLint)numbers[0]);
        else
            set_floats(gl, slot, 1, numbers, false);
        return;
    case SLOT_LIGHT:
        plr_light_value_get(slot->light_value, slot->binding, &values->frame->view, numbers);
        set_floats(gl, slot, 1, numbers, false);
        return;
    case SLOT_FIELD:
        set_field(gl, slot);
        return;
    case SLOT_COUNT:
        gl->Uniform1i(slot->location, (GLint)slot->field->count);
        return;
    case SLOT_VOXELS:
        if (volume)
            plr_texture_bind(textures, volume->voxels, slot->unit, PLR_USE_CLAMPED);
        break;
    case SLOT_TEXTURE:
        if (slot->texture)
            plr_texture_bind(textures, slot->texture, slot->unit, slot->use);
        else
            unbind_texture(gl, slot);
        break;
    case SLOT_DEFAULT_RAMP:
        plr_texture_bind(textures, values->default_ramp, slot->unit, PLR_USE_CLAMPED);
        break;
    case SLOT_OPAQUE_DEPTH:
        gl->ActiveTexture(GL_TEXTURE0 + slot->unit);
        gl->BindTexture(GL_TEXTURE_2D, values->frame->opaque_depth);
        gl->BindSampler(slot->unit, 0);
        break;
    }
    gl->Uniform1i(slot->location, (GLint)slot->unit);
}

void plr_bind_set(const plr_gl *gl, plr_textures *textures, const plr_slots *slots,
                  const plr_values *values) {
    plr_defaults_apply(gl, slots->defaults);
    for (size_t i = 0; i < slots->count; i++)
        set_slot(gl, textures, &slots->items[i], values);
}
