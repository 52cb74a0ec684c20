#include "engine/state.h"

static const GLenum switches[] = {GL_BLEND,
                                  GL_DEPTH_TEST,
                                  GL_CULL_FACE,
                                  GL_SCISSOR_TEST,
                                  GL_TEXTURE_CUBE_MAP_SEAMLESS,
                                  GL_DEPTH_CLAMP,
                                  GL_POLYGON_OFFSET_FILL,
                                  GL_PROGRAM_POINT_SIZE};
static const GLenum blend_names[] = {GL_BLEND_SRC_RGB,      GL_BLEND_DST_RGB,
                                     GL_BLEND_SRC_ALPHA,    GL_BLEND_DST_ALPHA,
                                     GL_BLEND_EQUATION_RGB, GL_BLEND_EQUATION_ALPHA};

static void save_units(const plr_gl *gl, plr_gl_state *state) {
    gl->GetIntegerv(GL_ACTIVE_TEXTURE, &state->active_texture);
    gl->GetIntegerv(GL_MAX_TEXTURE_IMAGE_UNITS, &state->unit_count);
    if (state->unit_count > PLR_SAVED_UNITS)
        state->unit_count = PLR_SAVED_UNITS;
    for (GLint i = 0; i < state->unit_count; i++) {
        gl->ActiveTexture(GL_TEXTURE0 + (GLenum)i);
        gl->GetIntegerv(GL_TEXTURE_BINDING_2D, &state->units[i].texture_2d);
        gl->GetIntegerv(GL_TEXTURE_BINDING_3D, &state->units[i].texture_3d);
        gl->GetIntegerv(GL_TEXTURE_BINDING_CUBE_MAP, &state->units[i].texture_cube);
        gl->GetIntegerv(GL_SAMPLER_BINDING, &state->units[i].sampler);
    }
    gl->ActiveTexture((GLenum)state->active_texture);
}

static void restore_units(const plr_gl *gl, const plr_gl_state *state) {
    for (GLint i = 0; i < state->unit_count; i++) {
        gl->ActiveTexture(GL_TEXTURE0 + (GLenum)i);
        gl->BindTexture(GL_TEXTURE_2D, (GLuint)state->units[i].texture_2d);
        gl->BindTexture(GL_TEXTURE_3D, (GLuint)state->units[i].texture_3d);
        gl->BindTexture(GL_TEXTURE_CUBE_MAP, (GLuint)state->units[i].texture_cube);
        gl->BindSampler((GLuint)i, (GLuint)state->units[i].sampler);
    }
    gl->ActiveTexture((GLenum)state->active_texture);
}

void plr_gl_state_save(const plr_gl *gl, plr_gl_state *state) {
    *state = (plr_gl_state){0};
    gl->GetIntegerv(GL_VIEWPORT, state->viewport);
    gl->GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &state->draw_framebuffer);
    gl->GetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &state->read_framebuffer);
    gl->GetIntegerv(GL_CURRENT_PROGRAM, &state->program);
    gl->GetIntegerv(GL_VERTEX_ARRAY_BINDING, &state->vertex_array);
    gl->GetIntegerv(GL_ARRAY_BUFFER_BINDING, &state->array_buffer);
    save_units(gl, state);
    for (int i = 0; i < PLR_SAVED_SWITCHES; i++)
        state->enabled[i] = gl->IsEnabled(switches[i]);
    for (int i = 0; i < 6; i++)
        gl->GetIntegerv(blend_names[i], &state->blend[i]);
    if (gl->ClipControl) {
        gl->GetIntegerv(GL_CLIP_ORIGIN, &state->clip_origin);
        gl->GetIntegerv(GL_CLIP_DEPTH_MODE, &state->clip_depth);
    }
    gl->GetFloatv(GL_POLYGON_OFFSET_FACTOR, &state->polygon_offset[0]);
    gl->GetFloatv(GL_POLYGON_OFFSET_UNITS, &state->polygon_offset[1]);
    gl->GetIntegerv(GL_DEPTH_FUNC, &state->depth_function);
    gl->GetIntegerv(GL_CULL_FACE_MODE, &state->cull_face);
    gl->GetIntegerv(GL_FRONT_FACE, &state->front_face);
    gl->GetIntegerv(GL_UNPACK_ALIGNMENT, &state->unpack_alignment);
    gl->GetBooleanv(GL_DEPTH_WRITEMASK, &state->depth_mask);
    gl->GetBooleanv(GL_COLOR_WRITEMASK, state->color_mask);
    gl->GetDoublev(GL_DEPTH_CLEAR_VALUE, &state->clear_depth);
    gl->GetFloatv(GL_COLOR_CLEAR_VALUE, state->clear_color);
    gl->GetFloatv(GL_BLEND_COLOR, state->blend_color);
    gl->GetFloatv(GL_LINE_WIDTH, &state->line_width);
}

void plr_gl_state_restore(const plr_gl *gl, const plr_gl_state *state) {
    gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, (GLuint)state->draw_framebuffer);
    gl->BindFramebuffer(GL_READ_FRAMEBUFFER, (GLuint)state->read_framebuffer);
    gl->Viewport(state->viewport[0], state->viewport[1], state->viewport[2], state->viewport[3]);
    gl->UseProgram((GLuint)state->program);
    gl->BindVertexArray((GLuint)state->vertex_array);
    gl->BindBuffer(GL_ARRAY_BUFFER, (GLuint)state->array_buffer);
    restore_units(gl, state);
    for (int i = 0; i < PLR_SAVED_SWITCHES; i++)
        (state->enabled[i] ? gl->Enable : gl->Disable)(switches[i]);
    gl->BlendFuncSeparate((GLenum)state->blend[0], (GLenum)state->blend[1], (GLenum)state->blend[2],
                          (GLenum)state->blend[3]);
    gl->BlendEquationSeparate((GLenum)state->blend[4], (GLenum)state->blend[5]);
    if (gl->ClipControl)
        gl->ClipControl((GLenum)state->clip_origin, (GLenum)state->clip_depth);
    gl->PolygonOffset(state->polygon_offset[0], state->polygon_offset[1]);
    gl->DepthFunc((GLenum)state->depth_function);
    gl->CullFace((GLenum)state->cull_face);
    gl->FrontFace((GLenum)state->front_face);
    gl->PixelStorei(GL_UNPACK_ALIGNMENT, state->unpack_alignment);
    gl->DepthMask(state->depth_mask);
    gl->ColorMask(state->color_mask[0], state->color_mask[1], state->color_mask[2],
                  state->color_mask[3]);
    gl->ClearDepth(state->clear_depth);
    gl->ClearColor(state->clear_color[0], state->clear_color[1], state->clear_color[2],
                   state->clear_color[3]);
    gl->BlendColor(state->blend_color[0], state->blend_color[1], state->blend_color[2],
                   state->blend_color[3]);
    gl->LineWidth(state->line_width);
}
