/* The offscreen framebuffer: rows, sizes, limits, and the state of others. */
#include <plugray/engine.h>

#include "engine/framebuffer.h"
#include "engine/gl.h"
#include "tests/tap.h"

/* Columns in red, rows from the top in green: what clearing through the scissor gives. */
static void paint(const plr_framebuffer *framebuffer) {
    const plr_gl *gl = framebuffer->gl;
    plr_framebuffer_bind(framebuffer);
    gl->Enable(GL_SCISSOR_TEST);
    for (int y = 0; y < framebuffer->height; y++)
        for (int x = 0; x < framebuffer->width; x++) {
            gl->Scissor(x, framebuffer->height - 1 - y, 1, 1);
            gl->ClearColor((float)x, (float)y, -1e6f, 1e-6f);
            gl->Clear(GL_COLOR_BUFFER_BIT);
        }
    gl->Disable(GL_SCISSOR_TEST);
}

static bool is_painted(const plr_framebuffer *framebuffer) {
    int width = framebuffer->width, height = framebuffer->height;
    float *pixels = calloc((size_t)(width * height), 4 * sizeof *pixels), *at = pixels;
    bool same = plr_framebuffer_read(framebuffer, pixels);
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++, at += 4)
            same =
                same && at[0] == (float)x && at[1] == (float)y && at[2] == -1e6f && at[3] == 1e-6f;
    free(pixels);
    return same;
}

static void test_sizes(const plr_gl *gl) {
    static const int sizes[][2] = {{1, 1}, {5, 3}, {3, 8}, {1, 7}, {9, 1}};
    plr_framebuffer framebuffer = {0};
    CHECK(plr_framebuffer_create(&framebuffer, gl, 4, 2, NULL));
    paint(&framebuffer);
    CHECK(is_painted(&framebuffer));
    GLuint name = framebuffer.name;
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        GLint viewport[4];
        CHECK(plr_framebuffer_resize(&framebuffer, sizes[i][0], sizes[i][1], NULL));
        CHECK_INT(framebuffer.name, name);
        paint(&framebuffer);
        CHECK(is_painted(&framebuffer));
        gl->GetIntegerv(GL_VIEWPORT, viewport);
        CHECK(!viewport[0] && !viewport[1] && viewport[2] == sizes[i][0] &&
              viewport[3] == sizes[i][1]);
    }
    plr_framebuffer_destroy(&framebuffer);
    CHECK(!gl->IsFramebuffer(name));
    plr_framebuffer_destroy(&framebuffer);
}

static void test_limits(const plr_gl *gl) {
    static const int sizes[][2] = {{0, 1}, {1, 0}, {-5, 5}, {1 << 30, 1}, {1, 1 << 30}};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        plr_framebuffer framebuffer;
        plr_diags *diags = plr_diags_create(NULL);
        CHECK(!plr_framebuffer_create(&framebuffer, gl, sizes[i][0], sizes[i][1], diags));
        CHECK_INT(plr_diags_count_of(diags, PLR_ERROR), 1);
        CHECK_STR(plr_code_text(plr_diags_get(diags, 0)->code), "limit");
        CHECK(plr_framebuffer_resize(&framebuffer, 2, 2, diags));
        plr_framebuffer_destroy(&framebuffer);
        plr_diags_destroy(&diags);
    }
}

/* Depth is kept as float: a value that 24 bits do not hold comes back. */
static void test_depth(const plr_gl *gl) {
    plr_framebuffer framebuffer;
    GLint bits = 0, kind = 0;
    GLfloat depth = 0;
    CHECK(plr_framebuffer_create(&framebuffer, gl, 2, 2, NULL));
    plr_framebuffer_bind(&framebuffer);
    gl->GetFramebufferAttachmentParameteriv(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT,
                                            GL_FRAMEBUFFER_ATTACHMENT_DEPTH_SIZE, &bits);
    gl->GetFramebufferAttachmentParameteriv(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT,
                                            GL_FRAMEBUFFER_ATTACHMENT_COMPONENT_TYPE, &kind);
    CHECK_INT(bits, 32);
    CHECK_INT(kind, GL_FLOAT);
    gl->ClearDepth(1e-30);
    gl->Clear(GL_DEPTH_BUFFER_BIT);
    gl->ReadPixels(0, 0, 1, 1, GL_DEPTH_COMPONENT, GL_FLOAT, &depth);
    CHECK(depth > 0.9e-30f && depth < 1.1e-30f);
    plr_framebuffer_destroy(&framebuffer);
}

/* What a host has bound and set is as it was, and does not disturb us. */
static void test_state(const plr_gl *gl) {
    static const struct {
        GLenum name;
        GLint value;
    } pack[] = {{GL_PACK_ALIGNMENT, 8},
                {GL_PACK_ROW_LENGTH, 100},
                {GL_PACK_SKIP_ROWS, 3},
                {GL_PACK_SKIP_PIXELS, 2},
                {GL_PACK_SWAP_BYTES, 1}};
    static const GLenum bindings[] = {GL_TEXTURE_BINDING_2D, GL_DRAW_FRAMEBUFFER_BINDING,
                                      GL_READ_FRAMEBUFFER_BINDING, GL_PIXEL_PACK_BUFFER_BINDING,
                                      GL_PIXEL_UNPACK_BUFFER_BINDING};
    enum {
        BINDINGS = sizeof bindings / sizeof bindings[0]
    };
    GLuint texture, buffers[2];
    GLint before[BINDINGS], after;
    plr_framebuffer theirs, ours;
    CHECK(plr_framebuffer_create(&theirs, gl, 4, 4, NULL));
    gl->GenTextures(1, &texture);
    gl->GenBuffers(2, buffers);
    gl->BindTexture(GL_TEXTURE_2D, texture);
    plr_framebuffer_bind(&theirs);
    gl->BindBuffer(GL_PIXEL_PACK_BUFFER, buffers[0]);
    gl->BindBuffer(GL_PIXEL_UNPACK_BUFFER, buffers[1]);
    for (size_t i = 0; i < sizeof pack / sizeof pack[0]; i++)
        gl->PixelStorei(pack[i].name, pack[i].value);
    for (int i = 0; i < BINDINGS; i++)
        gl->GetIntegerv(bindings[i], &before[i]);
    CHECK(plr_framebuffer_create(&ours, gl, 5, 3, NULL));
    CHECK(plr_framebuffer_resize(&ours, 6, 4, NULL));
    for (int i = 0; i < BINDINGS; i++) {
        gl->GetIntegerv(bindings[i], &after);
        CHECK_INT(after, before[i]);
    }
    paint(&ours);
    plr_framebuffer_bind(&theirs);
    CHECK(is_painted(&ours));
    for (int i = 0; i < BINDINGS; i++) {
        gl->GetIntegerv(bindings[i], &after);
        CHECK_INT(after, before[i]);
    }
    for (size_t i = 0; i < sizeof pack / sizeof pack[0]; i++) {
        gl->GetIntegerv(pack[i].name, &after);
        CHECK_INT(after, pack[i].value);
    }
    CHECK_INT(gl->GetError(), GL_NO_ERROR);
    gl->DeleteTextures(1, &texture);
    gl->DeleteBuffers(2, buffers);
    plr_framebuffer_destroy(&theirs);
    plr_framebuffer_destroy(&ours);
}

int main(void) {
    for (int backend = PLR_BACKEND_EGL; backend <= PLR_BACKEND_OSMESA; backend++) {
        plr_gl gl;
        plr_context *context = plr_context_create((plr_backend)backend, NULL);
        if (!context || plr_gl_load(&gl, plr_context_get_proc_address, context)) {
            TAP_SKIP("the framebuffer in one kind of context", "no such context");
            continue;
        }
        test_sizes(&gl);
        test_limits(&gl);
        test_depth(&gl);
        test_state(&gl);
        plr_context_destroy(&context);
    }
    return tap_done();
}
