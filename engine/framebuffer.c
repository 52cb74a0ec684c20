#include "engine/framebuffer.h"

#include <stddef.h>
#include <string.h>

/* The state that creating and reading touch. */
typedef struct saved_state {
    GLint texture, draw, read, unpack_buffer, pack_buffer;
} saved_state;

static void save(const plr_gl *gl, saved_state *state) {
    gl->GetIntegerv(GL_TEXTURE_BINDING_2D, &state->texture);
    gl->GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &state->draw);
    gl->GetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &state->read);
    gl->GetIntegerv(GL_PIXEL_UNPACK_BUFFER_BINDING, &state->unpack_buffer);
    gl->GetIntegerv(GL_PIXEL_PACK_BUFFER_BINDING, &state->pack_buffer);
    gl->BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    gl->BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
}

static void restore(const plr_gl *gl, const saved_state *state) {
    gl->BindTexture(GL_TEXTURE_2D, (GLuint)state->texture);
    gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, (GLuint)state->draw);
    gl->BindFramebuffer(GL_READ_FRAMEBUFFER, (GLuint)state->read);
    gl->BindBuffer(GL_PIXEL_UNPACK_BUFFER, (GLuint)state->unpack_buffer);
    gl->BindBuffer(GL_PIXEL_PACK_BUFFER, (GLuint)state->pack_buffer);
}

/* Errors of others, which would hide ours. A lost context reports its loss without end. */
static void forget_errors(const plr_gl *gl) {
    for (int i = 0; i < 32 && gl->GetError(); i++)
        ;
}

static void make_texture(const plr_gl *gl, GLuint texture, GLint internal, int width, int height,
                         GLenum format) {
    static const GLint parameters[][2] = {{GL_TEXTURE_MIN_FILTER, GL_NEAREST},
                                          {GL_TEXTURE_MAG_FILTER, GL_NEAREST},
                                          {GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE},
                                          {GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE},
                                          {GL_TEXTURE_MAX_LEVEL, 0}};
    gl->BindTexture(GL_TEXTURE_2D, texture);
    for (size_t i = 0; i < sizeof parameters / sizeof parameters[0]; i++)
        gl->TexParameteri(GL_TEXTURE_2D, (GLenum)parameters[i][0], parameters[i][1]);
    gl->TexImage2D(GL_TEXTURE_2D, 0, internal, width, height, 0, format, GL_FLOAT, NULL);
}

/* False with an error if the context has no framebuffer of that size. */
static bool check_size(const plr_gl *gl, int width, int height, plr_diags *diags) {
    GLint side = 0, viewport[2] = {0, 0};
    gl->GetIntegerv(GL_MAX_TEXTURE_SIZE, &side);
    gl->GetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport);
    int widest = viewport[0] < side ? viewport[0] : side;
    int highest = viewport[1] < side ? viewport[1] : side;
    if (width >= 1 && height >= 1 && width <= widest && height <= highest)
        return true;
    plr_diags_add(diags, PLR_CODE_LIMIT, (plr_place){0},
                  "a picture of %d x %d pixels is not possible here, %d x %d is the largest", width,
                  height, widest, highest);
    return false;
}

bool plr_framebuffer_resize(plr_framebuffer *framebuffer, int width, int height, plr_diags *diags) {
    const plr_gl *gl = framebuffer->gl;
    if (!check_size(gl, width, height, diags))
        return false;
    saved_state state;
    save(gl, &state);
    forget_errors(gl);
    make_texture(gl, framebuffer->color, GL_RGBA32F, width, height, GL_RGBA);
    make_texture(gl, framebuffer->depth, GL_DEPTH_COMPONENT32F, width, height, GL_DEPTH_COMPONENT);
    gl->BindFramebuffer(GL_FRAMEBUFFER, framebuffer->name);
    gl->FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D,
                             framebuffer->color, 0);
    gl->FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, framebuffer->depth,
                             0);
    GLenum error = gl->GetError();
    GLenum status = gl->CheckFramebufferStatus(GL_FRAMEBUFFER);
    restore(gl, &state);
    framebuffer->width = width;
    framebuffer->height = height;
    if (error == GL_OUT_OF_MEMORY)
        plr_diags_add(diags, PLR_CODE_NO_MEMORY, (plr_place){0},
                      "no memory for a picture of %d x %d pixels", width, height);
    else if (error || status != GL_FRAMEBUFFER_COMPLETE)
        plr_diags_add(diags, PLR_CODE_NO_GL, (plr_place){0},
                      "the context cannot draw to float textures (error 0x%x, status 0x%x)", error,
                      status);
    return !error && status == GL_FRAMEBUFFER_COMPLETE;
}

bool plr_framebuffer_create(plr_framebuffer *framebuffer, const plr_gl *gl, int width, int height,
                            plr_diags *diags) {
    *framebuffer = (plr_framebuffer){.gl = gl};
    gl->GenFramebuffers(1, &framebuffer->name);
    gl->GenTextures(1, &framebuffer->color);
    gl->GenTextures(1, &framebuffer->depth);
    return plr_framebuffer_resize(framebuffer, width, height, diags);
}

void plr_framebuffer_destroy(plr_framebuffer *framebuffer) {
    const plr_gl *gl = framebuffer->gl;
    if (!gl)
        return;
    gl->DeleteFramebuffers(1, &framebuffer->name);
    gl->DeleteTextures(1, &framebuffer->color);
    gl->DeleteTextures(1, &framebuffer->depth);
    *framebuffer = (plr_framebuffer){0};
}

void plr_framebuffer_bind(const plr_framebuffer *framebuffer) {
    const plr_gl *gl = framebuffer->gl;
    gl->BindFramebuffer(GL_FRAMEBUFFER, framebuffer->name);
    gl->Viewport(0, 0, framebuffer->width, framebuffer->height);
}

/* GL's rows start at the bottom, a picture's at the top. */
static void flip_rows(float *pixels, size_t row, size_t height) {
    for (size_t low = 0, high = height; low + 1 < high--; low++)
        for (size_t i = 0; i < row; i++) {
            float kept = pixels[low * row + i];
            pixels[low * row + i] = pixels[high * row + i];
            pixels[high * row + i] = kept;
        }
}

static bool read(const plr_framebuffer *framebuffer, GLenum format, size_t components,
                 float *pixels) {
    static const GLenum names[] = {GL_PACK_ALIGNMENT, GL_PACK_ROW_LENGTH, GL_PACK_SKIP_ROWS,
                                   GL_PACK_SKIP_PIXELS, GL_PACK_SWAP_BYTES};
    enum {
        COUNT = sizeof names / sizeof names[0]
    };
    const plr_gl *gl = framebuffer->gl;
    GLint pack[COUNT];
    saved_state state;
    save(gl, &state);
    for (size_t i = 0; i < COUNT; i++) {
        gl->GetIntegerv(names[i], &pack[i]);
        gl->PixelStorei(names[i], names[i] == GL_PACK_ALIGNMENT ? 4 : 0);
    }
    forget_errors(gl);
    gl->BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer->name);
    gl->ReadPixels(0, 0, framebuffer->width, framebuffer->height, format, GL_FLOAT, pixels);
    bool fine = gl->GetError() == GL_NO_ERROR;
    for (size_t i = 0; i < COUNT; i++)
        gl->PixelStorei(names[i], pack[i]);
    restore(gl, &state);
    if (fine)
        flip_rows(pixels, (size_t)framebuffer->width * components, (size_t)framebuffer->height);
    return fine;
}

bool plr_framebuffer_read(const plr_framebuffer *framebuffer, float *pixels) {
    return read(framebuffer, GL_RGBA, 4, pixels);
}

bool plr_framebuffer_read_depth(const plr_framebuffer *framebuffer, float *depths) {
    return read(framebuffer, GL_DEPTH_COMPONENT, 1, depths);
}

/* ---- Depths apart ---- */

static void make_spare(plr_spare_depths *spare, int index) {
    const plr_gl *gl = spare->gl;
    make_texture(gl, spare->textures[index], GL_DEPTH_COMPONENT32F, spare->width, spare->height,
                 GL_DEPTH_COMPONENT);
    gl->BindFramebuffer(GL_FRAMEBUFFER, spare->names[index]);
    gl->FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D,
                             spare->textures[index], 0);
    gl->DrawBuffer(GL_NONE);
    gl->ReadBuffer(GL_NONE);
}

bool plr_spare_depths_fit(plr_spare_depths *spare, const plr_gl *gl, int width, int height) {
    if (spare->gl && spare->width >= width && spare->height >= height)
        return true;
    if (!spare->gl) {
        gl->GenFramebuffers(PLR_SPARE_DEPTHS, spare->names);
        gl->GenTextures(PLR_SPARE_DEPTHS, spare->textures);
        spare->gl = gl;
    }
    spare->width = width > spare->width ? width : spare->width;
    spare->height = height > spare->height ? height : spare->height;
    saved_state state;
    save(gl, &state);
    forget_errors(gl);
    for (int i = 0; i < PLR_SPARE_DEPTHS; i++)
        make_spare(spare, i);
    bool fine = gl->GetError() == GL_NO_ERROR;
    restore(gl, &state);
    if (!fine)
        spare->width = spare->height = 0; /* to be tried again */
    return fine;
}

void plr_spare_depths_destroy(plr_spare_depths *spare) {
    const plr_gl *gl = spare->gl;
    if (!gl)
        return;
    gl->DeleteFramebuffers(PLR_SPARE_DEPTHS, spare->names);
    gl->DeleteTextures(PLR_SPARE_DEPTHS, spare->textures);
    *spare = (plr_spare_depths){0};
}

void plr_depths_copy(const plr_gl *gl, GLuint from, const double viewport[4], GLuint texture) {
    gl->BindFramebuffer(GL_READ_FRAMEBUFFER, from);
    gl->BindTexture(GL_TEXTURE_2D, texture);
    gl->CopyTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, (GLint)viewport[0], (GLint)viewport[1],
                          (GLsizei)viewport[2], (GLsizei)viewport[3]);
}

/* ---- Textures of others as targets ---- */

bool plr_canvas_create(plr_canvas *canvas, const plr_gl *gl, int width, int height, bool depths) {
    *canvas = (plr_canvas){.gl = gl};
    gl->GenFramebuffers(1, &canvas->name);
    if (depths)
        return true;
    saved_state state;
    save(gl, &state);
    forget_errors(gl);
    gl->GenFramebuffers(1, &canvas->without_depth);
    gl->GenTextures(1, &canvas->depth);
    make_texture(gl, canvas->depth, GL_DEPTH_COMPONENT32F, width, height, GL_DEPTH_COMPONENT);
    gl->BindFramebuffer(GL_FRAMEBUFFER, canvas->name);
    gl->FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, canvas->depth, 0);
    bool fine = gl->GetError() == GL_NO_ERROR;
    restore(gl, &state);
    return fine;
}

void plr_canvas_attach(const plr_canvas *canvas, GLenum face, GLuint texture) {
    const plr_gl *gl = canvas->gl;
    if (canvas->without_depth) {
        gl->BindFramebuffer(GL_FRAMEBUFFER, canvas->without_depth);
        gl->FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, face, texture, 0);
    }
    gl->BindFramebuffer(GL_FRAMEBUFFER, canvas->name);
    gl->FramebufferTexture2D(GL_FRAMEBUFFER,
                             canvas->depth ? GL_COLOR_ATTACHMENT0 : GL_DEPTH_ATTACHMENT, face,
                             texture, 0);
    if (!canvas->depth) {
        gl->DrawBuffer(GL_NONE);
        gl->ReadBuffer(GL_NONE);
    }
}

void plr_canvas_destroy(plr_canvas *canvas) {
    const plr_gl *gl = canvas->gl;
    if (!gl)
        return;
    gl->DeleteFramebuffers(1, &canvas->name);
    gl->DeleteFramebuffers(1, &canvas->without_depth);
    gl->DeleteTextures(1, &canvas->depth);
    *canvas = (plr_canvas){0};
}
