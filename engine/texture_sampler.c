/* Filters and repetition of textures as GL sampler objects. Needs GL. */
#include "engine/texture_internal.h"

#include <string.h>

static const GLenum wraps[] = {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R};

static void make_clamping(const plr_gl *gl, GLuint *name) {
    gl->GenSamplers(1, name);
    for (int i = 0; i < 3; i++)
        gl->SamplerParameteri(*name, wraps[i], GL_CLAMP_TO_EDGE);
    gl->SamplerParameteri(*name, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl->SamplerParameteri(*name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
}

static void set_compare(const plr_gl *gl, const plr_texture *texture, GLuint sampler) {
    if (texture->kind != PLR_TEXTURE_2D_SHADOW && texture->kind != PLR_TEXTURE_CUBE_SHADOW)
        return;
    const char *mode = texture->node ? plr_node_string(texture->node, "compareMode") : "";
    bool greater = strcmp(mode, "COMPARE_R_GEQUAL") == 0;
    gl->SamplerParameteri(sampler, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    gl->SamplerParameteri(sampler, GL_TEXTURE_COMPARE_FUNC, greater ? GL_GEQUAL : GL_LEQUAL);
}

void plr_texture_make_samplers(const plr_textures *t, plr_texture *texture) {
    static const char *const repeats[] = {"repeatS", "repeatT", "repeatR"};
    const plr_gl *gl = t->gl;
    gl->GenSamplers(2, texture->samplers);
    for (int use = 0; use < 2; use++) {
        GLuint sampler = texture->samplers[use];
        for (int i = 0; i < 3; i++)
            gl->SamplerParameteri(sampler, wraps[i],
                                  texture->node && plr_node_bool(texture->node, repeats[i])
                                      ? GL_REPEAT
                                      : GL_CLAMP_TO_EDGE);
        gl->SamplerParameteri(sampler, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
        gl->SamplerParameteri(sampler, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
        set_compare(gl, texture, sampler);
    }
}

void plr_texture_bind(plr_textures *t, plr_texture *texture, unsigned unit, plr_texture_use use) {
    const plr_gl *gl = t->gl;
    if (use == PLR_USE_CLAMPED && !t->clamping)
        make_clamping(gl, &t->clamping);
    GLenum target = plr_texture_target(texture->kind);
    gl->ActiveTexture(GL_TEXTURE0 + unit);
    gl->BindTexture(target, texture->name);
    if (target == GL_TEXTURE_CUBE_MAP)
        gl->Enable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
    gl->BindSampler(unit, use == PLR_USE_CLAMPED ? t->clamping : texture->samplers[use]);
}
