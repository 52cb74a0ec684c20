/* The GL state of a host, saved and set back: what drawing a view changes, and no more. */
#ifndef PLR_ENGINE_STATE_H
#define PLR_ENGINE_STATE_H

#include "engine/gl.h"

enum {
    PLR_SAVED_UNITS = 32, /* texture units of one program at most */
    PLR_SAVED_SWITCHES = 8
};

typedef struct plr_gl_state {
    GLint viewport[4];
    GLint draw_framebuffer, read_framebuffer, program, vertex_array, array_buffer, active_texture;
    GLint unit_count;
    struct {
        GLint texture_2d, texture_3d, texture_cube, sampler;
    } units[PLR_SAVED_UNITS];
    GLboolean enabled[PLR_SAVED_SWITCHES];
    GLint blend[6];
    GLint clip_origin, clip_depth; /* 0 where the context has no ClipControl */
    GLfloat polygon_offset[2];
    GLint depth_function, cull_face, front_face, unpack_alignment;
    GLboolean depth_mask, color_mask[4];
    GLdouble clear_depth;
    GLfloat clear_color[4], blend_color[4], line_width;
} plr_gl_state;

void plr_gl_state_save(const plr_gl *gl, plr_gl_state *state);
void plr_gl_state_restore(const plr_gl *gl, const plr_gl_state *state);

#endif
