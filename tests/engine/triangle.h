/* Draws one triangle of one colour, for tests of contexts, framebuffers and programs. */
#ifndef TESTS_ENGINE_TRIANGLE_H
#define TESTS_ENGINE_TRIANGLE_H

#include <plugray/engine.h>
#include "engine/framebuffer.h"
#include "engine/gl.h"

/* The lower left half of the picture, without any vertex data. */
static const char triangle_vertex[] =
    "#version 330 core\n"
    "const vec2 corners[3] = vec2[3](vec2(-1.0, -1.0), vec2(1.0, -1.0), vec2(-1.0, 1.0));\n"
    "void main() { gl_Position = vec4(corners[gl_VertexID], 0.25, 1.0); }\n";

static const char triangle_fragment[] = "#version 330 core\n"
                                        "uniform vec4 color;\n"
                                        "out vec4 result;\n"
                                        "void main() { result = color; }\n";

static inline GLuint triangle_compile(const plr_gl *gl, GLenum kind, const char *text) {
    GLuint shader = gl->CreateShader(kind);
    gl->ShaderSource(shader, 1, &text, NULL);
    gl->CompileShader(shader);
    return shader;
}

static inline GLuint triangle_program(const plr_gl *gl) {
    GLuint program = gl->CreateProgram();
    GLuint vertex = triangle_compile(gl, GL_VERTEX_SHADER, triangle_vertex);
    GLuint fragment = triangle_compile(gl, GL_FRAGMENT_SHADER, triangle_fragment);
    gl->AttachShader(program, vertex);
    gl->AttachShader(program, fragment);
    gl->LinkProgram(program);
    gl->DeleteShader(vertex);
    gl->DeleteShader(fragment);
    return program;
}

/* Clears to (0, 0, 0, 0) and draws with the program, that has a uniform `color`. */
static inline void triangle_draw(const plr_gl *gl, GLuint program, const float color[4]) {
    GLuint array;
    gl->GenVertexArrays(1, &array);
    gl->BindVertexArray(array);
    gl->ClearColor(0, 0, 0, 0);
    gl->Enable(GL_DEPTH_TEST);
    gl->Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    gl->UseProgram(program);
    gl->Uniform4fv(gl->GetUniformLocation(program, "color"), 1, color);
    gl->DrawArrays(GL_TRIANGLES, 0, 3);
    gl->UseProgram(0);
    gl->BindVertexArray(0);
    gl->DeleteVertexArrays(1, &array);
}

enum {
    TRIANGLE_SIZE = 16
};

/* Whether each pixel is exactly `color` where the triangle covers its centre, else zero; in
 * pictures with the top row first. The diagonal goes through pixel corners only. */
static inline bool triangle_is(const float *pixels, const float color[4]) {
    static const float nothing[4];
    for (int y = 0; y < TRIANGLE_SIZE; y++)
        for (int x = 0; x < TRIANGLE_SIZE; x++) {
            if (x == y)
                continue;
            const float *expected = x < y ? color : nothing;
            for (int c = 0; c < 4; c++)
                if (pixels[(y * TRIANGLE_SIZE + x) * 4 + c] != expected[c])
                    return false;
        }
    return true;
}

/* Draws into a framebuffer of its own in the current context and compares every pixel. */
static inline bool triangle_works(const plr_gl *gl, const float color[4]) {
    static const int size = TRIANGLE_SIZE;
    float pixels[TRIANGLE_SIZE * TRIANGLE_SIZE * 4] = {0};
    plr_framebuffer framebuffer;
    if (!plr_framebuffer_create(&framebuffer, gl, size, size, NULL))
        return false;
    GLuint program = triangle_program(gl);
    plr_framebuffer_bind(&framebuffer);
    triangle_draw(gl, program, color);
    bool read = plr_framebuffer_read(&framebuffer, pixels);
    gl->DeleteProgram(program);
    plr_framebuffer_destroy(&framebuffer);
    return read && triangle_is(pixels, color);
}

#endif
