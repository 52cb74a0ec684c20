/* Filters and repetition of textures as GL sampler objects. Needs GL. */
#include "engine/texture_internal.h"

#include <string.h>

#ifndef GL_TEXTURE_MAX_ANISOTROPY
#define GL_TEXTURE_MAX_ANISOTROPY 0x84FE
#define GL_MAX_TEXTURE_MAX_ANISOTROPY 0x84FF
#endif

static const GLenum wraps[] = {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R};

typedef struct word {
    const char *name;
    GLenum value;
} word;

/* ISO/IEC 19775-1 V4 18.4.9, TextureProperties, and GL's own names, which are found in content too.
 * DEFAULT and what is not known are the first row. */
static const word minifications[] = {{"DEFAULT", GL_LINEAR_MIPMAP_LINEAR},
                                     {"AVG_PIXEL", GL_LINEAR},
                                     {"AVG_PIXEL_AVG_MIPMAP", GL_LINEAR_MIPMAP_LINEAR},
                                     {"AVG_PIXEL_NEAREST_MIPMAP", GL_LINEAR_MIPMAP_NEAREST},
                                     {"FASTEST", GL_NEAREST},
                                     {"NEAREST_PIXEL", GL_NEAREST},
                                     {"NEAREST_PIXEL_AVG_MIPMAP", GL_NEAREST_MIPMAP_LINEAR},
                                     {"NEAREST_PIXEL_NEAREST_MIPMAP", GL_NEAREST_MIPMAP_NEAREST},
                                     {"NICEST", GL_LINEAR_MIPMAP_LINEAR},
                                     {"NEAREST", GL_NEAREST},
                                     {"LINEAR", GL_LINEAR},
                                     {"NEAREST_MIPMAP_NEAREST", GL_NEAREST_MIPMAP_NEAREST},
                                     {"NEAREST_MIPMAP_LINEAR", GL_NEAREST_MIPMAP_LINEAR},
                                     {"LINEAR_MIPMAP_NEAREST", GL_LINEAR_MIPMAP_NEAREST},
                                     {"LINEAR_MIPMAP_LINEAR", GL_LINEAR_MIPMAP_LINEAR},
                                     {NULL, 0}};
static const word magnifications[] = {{"DEFAULT", GL_LINEAR},  {"AVG_PIXEL", GL_LINEAR},
                                      {"FASTEST", GL_NEAREST}, {"NEAREST_PIXEL", GL_NEAREST},
                                      {"NICEST", GL_LINEAR},   {"NEAREST", GL_NEAREST},
                                      {"LINEAR", GL_LINEAR},   {NULL, 0}};
/* CLAMP is what GL once called so: half of the border's colour at the very edge, which is nowhere
 * seen apart from CLAMP_TO_EDGE but in linear filtering; no GL of today has it. */
static const word boundaries[] = {{"REPEAT", GL_REPEAT},
                                  {"CLAMP", GL_CLAMP_TO_EDGE},
                                  {"CLAMP_TO_EDGE", GL_CLAMP_TO_EDGE},
                                  {"CLAMP_TO_BOUNDARY", GL_CLAMP_TO_BORDER},
                                  {"CLAMP_TO_BORDER", GL_CLAMP_TO_BORDER},
                                  {"MIRRORED_REPEAT", GL_MIRRORED_REPEAT},
                                  {NULL, 0}};

/* What a field of the properties says; reports a word that is none of its words. */
static GLenum find(const plr_textures *t, const plr_node *properties, const char *field,
                   const word *words) {
    const char *text = plr_node_string(properties, field);
    for (const word *w = words; w->name; w++)
        if (strcmp(w->name, text) == 0)
            return w->value;
    plr_diags_add_as(t->diags, PLR_WARNING, PLR_CODE_BAD_VALUE,
                     plr_node_field(properties, field)->place, "'%s' is no %s; %s is taken", text,
                     field, words->name);
    return words->value;
}

/* ---- One sampler ---- */

typedef struct state {
    GLenum wraps[3], minification, magnification;
    float border[4], anisotropy;
} state;

/* A boundary mode that the file gives wins over repeatS and its like; where it does not, its
 * default does not win. */
static void read_wraps(const plr_textures *t, const plr_node *node, const plr_node *properties,
                       state *s) {
    static const char *const repeats[] = {"repeatS", "repeatT", "repeatR"};
    static const char *const modes[] = {"boundaryModeS", "boundaryModeT", "boundaryModeR"};
    for (int i = 0; i < 3; i++) {
        const plr_field *mode = properties ? plr_node_field(properties, modes[i]) : NULL;
        if (mode && mode->given)
            s->wraps[i] = find(t, properties, modes[i], boundaries);
        else
            s->wraps[i] = plr_node_bool(node, repeats[i]) ? GL_REPEAT : GL_CLAMP_TO_EDGE;
    }
}

/* Anything but level 0 of a depth map means nothing. */
static state read_state(const plr_textures *t, const plr_texture *texture) {
    state s = {{GL_CLAMP_TO_EDGE, GL_CLAMP_TO_EDGE, GL_CLAMP_TO_EDGE},
               GL_LINEAR,
               GL_LINEAR,
               {0, 0, 0, 0},
               1};
    if (!texture->node)
        return s;
    const plr_node *properties = plr_node_child(texture->node, "textureProperties");
    read_wraps(t, texture->node, properties, &s);
    s.minification = texture->depth ? GL_LINEAR : minifications->value;
    if (!properties)
        return s;
    s.minification = find(t, properties, "minificationFilter", minifications);
    s.magnification = find(t, properties, "magnificationFilter", magnifications);
    plr_node_numbers(properties, "borderColor", s.border, 4);
    s.anisotropy = (float)plr_node_number(properties, "anisotropicDegree");
    return s;
}

static void set_state(const plr_gl *gl, GLuint sampler, const state *s) {
    for (int i = 0; i < 3; i++)
        gl->SamplerParameteri(sampler, wraps[i], (GLint)s->wraps[i]);
    gl->SamplerParameteri(sampler, GL_TEXTURE_MIN_FILTER, (GLint)s->minification);
    gl->SamplerParameteri(sampler, GL_TEXTURE_MAG_FILTER, (GLint)s->magnification);
    gl->SamplerParameterfv(sampler, GL_TEXTURE_BORDER_COLOR, s->border);
    if (s->anisotropy > 1 && plr_gl_has(gl, "GL_EXT_texture_filter_anisotropic")) {
        float most = 1;
        gl->GetFloatv(GL_MAX_TEXTURE_MAX_ANISOTROPY, &most);
        gl->SamplerParameterf(sampler, GL_TEXTURE_MAX_ANISOTROPY,
                              s->anisotropy < most ? s->anisotropy : most);
    }
}

static void set_compare(const plr_gl *gl, const plr_texture *texture, GLuint sampler) {
    if (texture->kind != PLR_TEXTURE_2D_SHADOW && texture->kind != PLR_TEXTURE_CUBE_SHADOW)
        return;
    const char *mode = texture->node ? plr_node_string(texture->node, "compareMode") : "";
    bool greater = strcmp(mode, "COMPARE_R_GEQUAL") == 0;
    gl->SamplerParameteri(sampler, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    gl->SamplerParameteri(sampler, GL_TEXTURE_COMPARE_FUNC, greater ? GL_GEQUAL : GL_LEQUAL);
}

/* The filter that looks at level 0 alone. */
static GLenum without_mipmaps(GLenum filter) {
    bool nearest = filter == GL_NEAREST || filter == GL_NEAREST_MIPMAP_NEAREST ||
                   filter == GL_NEAREST_MIPMAP_LINEAR;
    return nearest ? GL_NEAREST : GL_LINEAR;
}

void plr_texture_make_samplers(const plr_textures *t, plr_texture *texture) {
    state s = read_state(t, texture);
    t->gl->GenSamplers(2, texture->samplers);
    set_state(t->gl, texture->samplers[PLR_USE_SURFACE], &s);
    texture->mipmapped = s.minification != without_mipmaps(s.minification);
    s.minification = without_mipmaps(s.minification);
    set_state(t->gl, texture->samplers[PLR_USE_VOLUME], &s);
    set_compare(t->gl, texture, texture->samplers[PLR_USE_SURFACE]);
    set_compare(t->gl, texture, texture->samplers[PLR_USE_VOLUME]);
}

/* ---- Binding ---- */

static GLuint clamping(plr_textures *t) {
    static const state s = {{GL_CLAMP_TO_EDGE, GL_CLAMP_TO_EDGE, GL_CLAMP_TO_EDGE},
                            GL_LINEAR,
                            GL_LINEAR,
                            {0, 0, 0, 0},
                            1};
    if (!t->clamping) {
        t->gl->GenSamplers(1, &t->clamping);
        set_state(t->gl, t->clamping, &s);
    }
    return t->clamping;
}

void plr_texture_bind(plr_textures *t, plr_texture *texture, unsigned unit, plr_texture_use use) {
    const plr_gl *gl = t->gl;
    GLenum target = plr_texture_target(texture->kind);
    gl->ActiveTexture(GL_TEXTURE0 + unit);
    gl->BindTexture(target, texture->name);
    if (target == GL_TEXTURE_CUBE_MAP)
        gl->Enable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
    if (use == PLR_USE_SURFACE && texture->mipmapped && texture->stale_mipmaps) {
        gl->TexParameteri(target, GL_TEXTURE_MAX_LEVEL, 1000);
        gl->GenerateMipmap(target);
        texture->stale_mipmaps = false;
    }
    if (texture->kind == PLR_TEXTURE_3D_LABELS || texture->numbers)
        gl->BindSampler(unit, 0); /* the texture's own parameters: integers cannot be filtered */
    else
        gl->BindSampler(unit, use == PLR_USE_CLAMPED ? clamping(t) : texture->samplers[use]);
}
