/* Where each uniform of a program takes its value from, and setting it. */
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "engine/bind_internal.h"
#include "engine/transfer_function.h"
#include "engine/light_values.h"

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

struct plr_slot {
    GLint location;
    const plr_glsl_type *type;
    const plr_binding *binding;
    const plr_known *known;
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
        SLOT_VOLUME_TEXTURE,
        SLOT_SURFACES,
        SLOT_MAPS,
        SLOT_FUNCTIONS,
        SLOT_HULL,
        SLOT_DEPTHS
    } source;
    size_t depths;        /* of SLOT_DEPTHS: where in plr_frame its name is */
    size_t offset;        /* of SLOT_VOLUME_TEXTURE: where in plr_volume_state it is */
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

/* The depth textures of the frame. */
static bool find_depths(const char *name, plr_slot *slot) {
    static const struct {
        const char *name;
        size_t offset;
    } depths[] = {{"opaqueDepth", offsetof(plr_frame, opaque_depth)},
                  {"partStart", offsetof(plr_frame, part_start)},
                  {"partEnd", offsetof(plr_frame, part_end)}};
    slot->source = SLOT_DEPTHS;
    for (size_t i = 0; i < sizeof depths / sizeof *depths; i++)
        if (strcmp(depths[i].name, name) == 0) {
            slot->depths = depths[i].offset;
            return true;
        }
    return false;
}

/* What a volume has that is no field of a node. */
static bool find_volume_source(const plr_symbol *symbol, plr_slot *slot) {
    static const struct {
        const char *name;
        size_t offset;
    } textures[] = {{"labels", offsetof(plr_volume_state, labels)},
                    {"cellLabels", offsetof(plr_volume_state, cell_labels)},
                    {"integrals", offsetof(plr_volume_state, integrals)},
                    {"voxelGradients", offsetof(plr_volume_state, gradients)},
                    {"voxelQuads", offsetof(plr_volume_state, quads)},
                    {"places", offsetof(plr_volume_state, places)},
                    {"sums", offsetof(plr_volume_state, sums)},
                    {"ranges", offsetof(plr_volume_state, ranges)},
                    {"leaps", offsetof(plr_volume_state, leaps)}};
    slot->source = SLOT_VOLUME_TEXTURE;
    for (size_t i = 0; i < sizeof textures / sizeof *textures; i++)
        if (strcmp(textures[i].name, symbol->name) == 0) {
            slot->offset = textures[i].offset;
            return true;
        }
    bool surfaces = strcmp(symbol->name, "surfaces") == 0;
    bool maps = strcmp(symbol->name, "segmentMaps") == 0;
    slot->source = surfaces ? SLOT_SURFACES : SLOT_MAPS;
    return surfaces || maps;
}

/* Keys of transfer functions may be physical values of the voxels that the effect reads. */
static plr_texture *texture_of(plr_kitchen *k, const plr_node *node, const plr_binding *binding) {
    if (binding->grid && plr_transfer_function_is_physical(node))
        return plr_transfer_function_texture(k->textures, node, binding->grid->range);
    return plr_textures_get(k->textures, node);
}

/* Where the value of a uniform comes from; false if nothing is known (its initialiser stands). */
static bool find_source(plr_kitchen *k, const plr_symbol *symbol, const plr_binding *binding,
                        bool builtin, size_t element, plr_slot *slot) {
    if (slot->type->shape == SHAPE_SAMPLER && !binding) {
        if (find_depths(symbol->name, slot))
            return true;
        slot->source = SLOT_FUNCTIONS;
        return strcmp(symbol->name, "plugray_TransferFunctions") == 0;
    }
    if (slot->type->shape == SHAPE_SAMPLER && builtin && binding->grid &&
        strcmp(symbol->name, "voxels") == 0) {
        slot->source = SLOT_VOXELS;
        return true;
    }
    slot->source = SLOT_HULL;
    if (!binding && strcmp(symbol->name, "hull") == 0)
        return true;
    if (builtin && slot->volume != PLR_NO_EFFECT && find_volume_source(symbol, slot))
        return true;
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
    if (slot->light_value && slot->type->shape == SHAPE_FLOAT) {
        slot->source = SLOT_LIGHT;
        return true;
    }
    if (!binding || builtin)
        slot->known = plr_known_find(symbol->name, binding);
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
    if (!slot->field || !plr_field_fits(slot->field, slot->type, symbol->array != 0))
        return false;
    if (slot->type->shape != SHAPE_SAMPLER)
        return true;
    slot->source = SLOT_TEXTURE;
    if (builtin && slot->volume != PLR_NO_EFFECT)
        slot->use = PLR_USE_CLAMPED;
    if (element < slot->field->count && slot->field->value.nodes[element])
        slot->texture = texture_of(k, slot->field->value.nodes[element], binding);
    return slot->texture && (int)slot->texture->kind == slot->type->components;
}

void plr_bind_find(plr_kitchen *k, const plr_gl *gl, const plr_recipe *recipe,
                   const plr_program *program, const plr_built *built, plr_slots *slots) {
    slots->defaults = NULL;
    unsigned units = 0;
    for (size_t i = 0; i < plr_program_symbol_count(program); i++) {
        const plr_symbol *symbol = plr_program_symbol(program, i);
        bool own = symbol->effect == PLR_NO_EFFECT;
        const plr_binding *binding = own ? NULL : &recipe->bindings.items[symbol->effect];
        if (own && recipe->base_node && !plr_known_find(symbol->name, NULL)) {
            plr_binding *base = PLR_NEW(k->arena, plr_binding); /* a complete shader's own fields */
            *base = (plr_binding){.node = recipe->base_node, .volume = PLR_NO_EFFECT};
            binding = base;
        }
        size_t volume = binding ? binding->volume : PLR_NO_EFFECT;
        plr_slot slot = {.binding = binding,
                         .array = symbol->array,
                         .type = plr_glsl_type_find(symbol->type),
                         .use = recipe->casts_rays || volume != PLR_NO_EFFECT ? PLR_USE_VOLUME
                                                                              : PLR_USE_SURFACE,
                         .volume = volume};
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
    float numbers[64];
    switch (slot->source) {
    case SLOT_VALUE:
        slot->known->value(&(plr_known_context){values, slot->binding, volume}, numbers);
        if (slot->type->shape == SHAPE_INT)
            gl->Uniform1i(slot->location, (GLint)numbers[0]);
        else
            set_floats(gl, slot, slot->array ? (GLsizei)slot->array : 1, numbers, false);
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
        plr_texture_bind(textures,
                         slot->binding->grid->brick ? slot->binding->grid->brick
                                                    : slot->binding->grid->voxels,
                         slot->unit, PLR_USE_CLAMPED);
        break;
    case SLOT_VOLUME_TEXTURE:
        if (volume) {
            plr_texture *const *texture =
                (plr_texture *const *)(const void *)((const char *)volume + slot->offset);
            if (*texture)
                plr_texture_bind(textures, *texture, slot->unit, PLR_USE_CLAMPED);
        }
        break;
    case SLOT_SURFACES:
        if (volume)
            set_floats(gl, slot, (GLsizei)volume->surface_count, volume->surfaces[0], false);
        return;
    case SLOT_TEXTURE:
        if (slot->texture)
            plr_texture_bind(textures, slot->texture, slot->unit, slot->use);
        else
            unbind_texture(gl, slot);
        break;
    case SLOT_MAPS:
        if (volume && volume->maps)
            set_floats(gl, slot, (GLsizei)volume->map_count, volume->maps[0], false);
        return;
    case SLOT_FUNCTIONS:
        if (values->functions)
            plr_texture_bind(textures, values->functions, slot->unit, PLR_USE_CLAMPED);
        break;
    case SLOT_HULL:
        if (values->hull)
            set_floats(gl, slot, values->hull->count, values->hull->points[0], false);
        return;
    case SLOT_DEPTHS:
        gl->ActiveTexture(GL_TEXTURE0 + slot->unit);
        gl->BindTexture(GL_TEXTURE_2D,
                        *(const GLuint *)((const char *)values->frame + slot->depths));
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
