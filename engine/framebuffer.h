/* An offscreen framebuffer: float colour and depth. Needs GL. */
#ifndef PLR_ENGINE_FRAMEBUFFER_H
#define PLR_ENGINE_FRAMEBUFFER_H

#include <plugray/base.h>
#include "engine/gl.h"

typedef struct plr_framebuffer {
    const plr_gl *gl;
    GLuint name;
    GLuint color; /* 2D texture, RGBA32F, nearest */
    GLuint depth; /* 2D texture, DEPTH_COMPONENT32F, nearest */
    int width, height;
} plr_framebuffer;

/* Makes a framebuffer of that size. False with an error (`limit`, `no-memory`, `no-gl`) if the
 * context cannot; it may then be destroyed or resized. No state of the context changes. */
bool plr_framebuffer_create(plr_framebuffer *framebuffer, const plr_gl *gl, int width, int height,
                            plr_diags *diags);
/* Another size; what it held is lost. The names in GL stay the same. */
bool plr_framebuffer_resize(plr_framebuffer *framebuffer, int width, int height, plr_diags *diags);
/* Frees what it made in GL; a struct of zeros is fine. */
void plr_framebuffer_destroy(plr_framebuffer *framebuffer);

/* Binds it for drawing and reading, and sets the viewport to all of it. */
void plr_framebuffer_bind(const plr_framebuffer *framebuffer);
/* Reads width * height RGBA floats, top row first. No state of the context changes. */
bool plr_framebuffer_read(const plr_framebuffer *framebuffer, float *pixels);
/* Reads width * height depths, top row first. No state of the context changes. */
bool plr_framebuffer_read_depth(const plr_framebuffer *framebuffer, float *depths);

/* ---- Depths apart ---- */

#define PLR_SPARE_DEPTHS 3

/* Depth textures of the engine's own, that depths are copied to and drawn into. */
typedef struct plr_spare_depths {
    const plr_gl *gl;
    GLuint names[PLR_SPARE_DEPTHS]; /* framebuffers without colours */
    GLuint textures[PLR_SPARE_DEPTHS];
    int width, height;
} plr_spare_depths;

/* Makes them, or makes them larger, so that they hold pictures of this size. Changes no state of
 * the context. False if the context cannot. */
bool plr_spare_depths_fit(plr_spare_depths *spare, const plr_gl *gl, int width, int height);
/* Frees what it made in GL; a struct of zeros is fine. */
void plr_spare_depths_destroy(plr_spare_depths *spare);
/* Copies the depths of a framebuffer from (x, y) on to (0, 0) of a depth texture. Changes what is
 * bound for reading and as a 2D texture of the active unit. */
void plr_depths_copy(const plr_gl *gl, GLuint from, const double viewport[4], GLuint texture);

/* ---- Textures of others as targets ---- */

/* What draws into a texture: the texture's image is attached, depths are its own. */
typedef struct plr_canvas {
    const plr_gl *gl;
    GLuint name;          /* colours and depths; depths alone where the texture holds depths */
    GLuint without_depth; /* the same colours alone, while the depths are read; 0 without colours */
    GLuint depth;         /* 2D texture, DEPTH_COMPONENT32F; 0: the texture's own */
} plr_canvas;

/* No state of the context changes. False if the context cannot. */
bool plr_canvas_create(plr_canvas *canvas, const plr_gl *gl, int width, int height, bool depths);
/* Attaches level 0 of a texture: GL_TEXTURE_2D or the face of a cube map. Changes what is bound for
 * drawing and reading. */
void plr_canvas_attach(const plr_canvas *canvas, GLenum face, GLuint texture);
/* Frees what it made in GL; a struct of zeros is fine. */
void plr_canvas_destroy(plr_canvas *canvas);

#endif
