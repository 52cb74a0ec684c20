/* The types of uniforms, and the fields that fit them. */
#include <stdio.h>
#include <string.h>

#include "engine/bind_internal.h"

static const plr_glsl_type glsl_types[] = {
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
    {"usampler3D", SHAPE_SAMPLER, PLR_TEXTURE_3D_LABELS, " Node "},
    {"samplerCube", SHAPE_SAMPLER, PLR_TEXTURE_CUBE, " Node "},
    {"sampler2DShadow", SHAPE_SAMPLER, PLR_TEXTURE_2D_SHADOW, " Node "},
    {"samplerCubeShadow", SHAPE_SAMPLER, PLR_TEXTURE_CUBE_SHADOW, " Node "},
};

const plr_glsl_type *plr_glsl_type_find(const char *name) {
    for (size_t i = 0; i < sizeof glsl_types / sizeof *glsl_types; i++)
        if (strcmp(glsl_types[i].name, name) == 0)
            return &glsl_types[i];
    return NULL;
}

bool plr_field_fits(const plr_field *field, const plr_glsl_type *type, bool array) {
    char element[32];
    snprintf(element, sizeof element, " %s ", plr_type_name(field->type) + 2);
    return type && strstr(type->fields, element) && plr_type_is_multiple(field->type) == array;
}

const char *plr_glsl_sampler_name(plr_texture_kind kind) {
    for (size_t i = 0; i < sizeof glsl_types / sizeof *glsl_types; i++)
        if (glsl_types[i].shape == SHAPE_SAMPLER && glsl_types[i].components == (int)kind)
            return glsl_types[i].name;
    return "";
}
