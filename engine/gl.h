/* The GL functions that the engine calls: one table per context, no direct gl* call anywhere. */
#ifndef PLR_ENGINE_GL_H
#define PLR_ENGINE_GL_H

#include <stdbool.h>
#include <GL/glcorearb.h>

/* PLR_GL(RETURN, Name, (PARAMETERS)): add what you need. All are in GL 3.3 core. */
#define PLR_GL_FUNCTIONS(PLR_GL)                                                                   \
    /* GL 1.0 */                                                                                   \
    PLR_GL(void, CullFace, (GLenum mode))                                                          \
    PLR_GL(void, FrontFace, (GLenum mode))                                                         \
    PLR_GL(void, LineWidth, (GLfloat width))                                                       \
    PLR_GL(void, PointSize, (GLfloat size))                                                        \
    PLR_GL(void, PolygonMode, (GLenum face, GLenum mode))                                          \
    PLR_GL(void, Scissor, (GLint x, GLint y, GLsizei width, GLsizei height))                       \
    PLR_GL(void, Clear, (GLbitfield mask))                                                         \
    PLR_GL(void, ClearColor, (GLfloat red, GLfloat green, GLfloat blue, GLfloat alpha))            \
    PLR_GL(void, ClearStencil, (GLint s))                                                          \
    PLR_GL(void, ClearDepth, (GLdouble depth))                                                     \
    PLR_GL(void, StencilMask, (GLuint mask))                                                       \
    PLR_GL(void, ColorMask, (GLboolean red, GLboolean green, GLboolean blue, GLboolean alpha))     \
    PLR_GL(void, DepthMask, (GLboolean flag))                                                      \
    PLR_GL(void, Disable, (GLenum cap))                                                            \
    PLR_GL(void, Enable, (GLenum cap))                                                             \
    PLR_GL(void, Finish, (void))                                                                   \
    PLR_GL(void, Flush, (void))                                                                    \
    PLR_GL(void, BlendFunc, (GLenum sfactor, GLenum dfactor))                                      \
    PLR_GL(void, StencilFunc, (GLenum func, GLint ref, GLuint mask))                               \
    PLR_GL(void, StencilOp, (GLenum fail, GLenum zfail, GLenum zpass))                             \
    PLR_GL(void, DepthFunc, (GLenum func))                                                         \
    PLR_GL(void, PixelStorei, (GLenum pname, GLint param))                                         \
    PLR_GL(void, PixelStoref, (GLenum pname, GLfloat param))                                       \
    PLR_GL(void, ReadBuffer, (GLenum src))                                                         \
    PLR_GL(void, ReadPixels,                                                                       \
           (GLint x, GLint y, GLsizei width, GLsizei height, GLenum format, GLenum type,           \
            void *pixels))                                                                         \
    PLR_GL(void, DrawBuffer, (GLenum buf))                                                         \
    PLR_GL(void, GetBooleanv, (GLenum pname, GLboolean * data))                                    \
    PLR_GL(void, GetDoublev, (GLenum pname, GLdouble * data))                                      \
    PLR_GL(GLenum, GetError, (void))                                                               \
    PLR_GL(void, GetFloatv, (GLenum pname, GLfloat * data))                                        \
    PLR_GL(void, GetIntegerv, (GLenum pname, GLint * data))                                        \
    PLR_GL(const GLubyte *, GetString, (GLenum name))                                              \
    PLR_GL(void, GetTexImage,                                                                      \
           (GLenum target, GLint level, GLenum format, GLenum type, void *pixels))                 \
    PLR_GL(void, GetTexParameterfv, (GLenum target, GLenum pname, GLfloat * params))               \
    PLR_GL(void, GetTexParameteriv, (GLenum target, GLenum pname, GLint * params))                 \
    PLR_GL(void, GetTexLevelParameteriv,                                                           \
           (GLenum target, GLint level, GLenum pname, GLint * params))                             \
    PLR_GL(GLboolean, IsEnabled, (GLenum cap))                                                     \
    PLR_GL(void, DepthRange, (GLdouble n, GLdouble f))                                             \
    PLR_GL(void, Viewport, (GLint x, GLint y, GLsizei width, GLsizei height))                      \
    PLR_GL(void, Hint, (GLenum target, GLenum mode))                                               \
    PLR_GL(void, LogicOp, (GLenum opcode))                                                         \
    PLR_GL(void, TexParameterf, (GLenum target, GLenum pname, GLfloat param))                      \
    PLR_GL(void, TexParameterfv, (GLenum target, GLenum pname, const GLfloat *params))             \
    PLR_GL(void, TexParameteri, (GLenum target, GLenum pname, GLint param))                        \
    PLR_GL(void, TexParameteriv, (GLenum target, GLenum pname, const GLint *params))               \
    PLR_GL(void, TexImage1D,                                                                       \
           (GLenum target, GLint level, GLint internalformat, GLsizei width, GLint border,         \
            GLenum format, GLenum type, const void *pixels))                                       \
    PLR_GL(void, TexImage2D,                                                                       \
           (GLenum target, GLint level, GLint internalformat, GLsizei width, GLsizei height,       \
            GLint border, GLenum format, GLenum type, const void *pixels))                         \
    /* GL 1.1 */                                                                                   \
    PLR_GL(void, DrawArrays, (GLenum mode, GLint first, GLsizei count))                            \
    PLR_GL(void, DrawElements, (GLenum mode, GLsizei count, GLenum type, const void *indices))     \
    PLR_GL(void, PolygonOffset, (GLfloat factor, GLfloat units))                                   \
    PLR_GL(void, CopyTexSubImage2D,                                                                \
           (GLenum target, GLint level, GLint xoffset, GLint yoffset, GLint x, GLint y,            \
            GLsizei width, GLsizei height))                                                        \
    PLR_GL(void, TexSubImage1D,                                                                    \
           (GLenum target, GLint level, GLint xoffset, GLsizei width, GLenum format, GLenum type,  \
            const void *pixels))                                                                   \
    PLR_GL(void, TexSubImage2D,                                                                    \
           (GLenum target, GLint level, GLint xoffset, GLint yoffset, GLsizei width,               \
            GLsizei height, GLenum format, GLenum type, const void *pixels))                       \
    PLR_GL(void, BindTexture, (GLenum target, GLuint texture))                                     \
    PLR_GL(void, DeleteTextures, (GLsizei n, const GLuint *textures))                              \
    PLR_GL(void, GenTextures, (GLsizei n, GLuint * textures))                                      \
    PLR_GL(GLboolean, IsTexture, (GLuint texture))                                                 \
    /* GL 1.2 */                                                                                   \
    PLR_GL(                                                                                        \
        void, DrawRangeElements,                                                                   \
        (GLenum mode, GLuint start, GLuint end, GLsizei count, GLenum type, const void *indices))  \
    PLR_GL(void, TexImage3D,                                                                       \
           (GLenum target, GLint level, GLint internalformat, GLsizei width, GLsizei height,       \
            GLsizei depth, GLint border, GLenum format, GLenum type, const void *pixels))          \
    PLR_GL(void, TexSubImage3D,                                                                    \
           (GLenum target, GLint level, GLint xoffset, GLint yoffset, GLint zoffset,               \
            GLsizei width, GLsizei height, GLsizei depth, GLenum format, GLenum type,              \
            const void *pixels))                                                                   \
    PLR_GL(void, CopyTexSubImage3D,                                                                \
           (GLenum target, GLint level, GLint xoffset, GLint yoffset, GLint zoffset, GLint x,      \
            GLint y, GLsizei width, GLsizei height))                                               \
    /* GL 1.3 */                                                                                   \
    PLR_GL(void, ActiveTexture, (GLenum texture))                                                  \
    PLR_GL(void, SampleCoverage, (GLfloat value, GLboolean invert))                                \
    PLR_GL(void, CompressedTexImage2D,                                                             \
           (GLenum target, GLint level, GLenum internalformat, GLsizei width, GLsizei height,      \
            GLint border, GLsizei imageSize, const void *data))                                    \
    /* GL 1.4 */                                                                                   \
    PLR_GL(void, BlendFuncSeparate,                                                                \
           (GLenum sfactorRGB, GLenum dfactorRGB, GLenum sfactorAlpha, GLenum dfactorAlpha))       \
    PLR_GL(void, PointParameterf, (GLenum pname, GLfloat param))                                   \
    PLR_GL(void, PointParameteri, (GLenum pname, GLint param))                                     \
    PLR_GL(void, BlendColor, (GLfloat red, GLfloat green, GLfloat blue, GLfloat alpha))            \
    PLR_GL(void, BlendEquation, (GLenum mode))                                                     \
    PLR_GL(void, MultiDrawArrays,                                                                  \
           (GLenum mode, const GLint *first, const GLsizei *count, GLsizei drawcount))             \
    /* GL 1.5 */                                                                                   \
    PLR_GL(void, GenQueries, (GLsizei n, GLuint * ids))                                            \
    PLR_GL(void, DeleteQueries, (GLsizei n, const GLuint *ids))                                    \
    PLR_GL(GLboolean, IsQuery, (GLuint id))                                                        \
    PLR_GL(void, BeginQuery, (GLenum target, GLuint id))                                           \
    PLR_GL(void, EndQuery, (GLenum target))                                                        \
    PLR_GL(void, GetQueryiv, (GLenum target, GLenum pname, GLint * params))                        \
    PLR_GL(void, GetQueryObjectiv, (GLuint id, GLenum pname, GLint * params))                      \
    PLR_GL(void, GetQueryObjectuiv, (GLuint id, GLenum pname, GLuint * params))                    \
    PLR_GL(void, BindBuffer, (GLenum target, GLuint buffer))                                       \
    PLR_GL(void, DeleteBuffers, (GLsizei n, const GLuint *buffers))                                \
    PLR_GL(void, GenBuffers, (GLsizei n, GLuint * buffers))                                        \
    PLR_GL(GLboolean, IsBuffer, (GLuint buffer))                                                   \
    PLR_GL(void, BufferData, (GLenum target, GLsizeiptr size, const void *data, GLenum usage))     \
    PLR_GL(void, BufferSubData,                                                                    \
           (GLenum target, GLintptr offset, GLsizeiptr size, const void *data))                    \
    PLR_GL(void, GetBufferSubData, (GLenum target, GLintptr offset, GLsizeiptr size, void *data))  \
    PLR_GL(void *, MapBuffer, (GLenum target, GLenum access))                                      \
    PLR_GL(GLboolean, UnmapBuffer, (GLenum target))                                                \
    PLR_GL(void, GetBufferParameteriv, (GLenum target, GLenum pname, GLint * params))              \
    /* GL 2.0 */                                                                                   \
    PLR_GL(void, BlendEquationSeparate, (GLenum modeRGB, GLenum modeAlpha))                        \
    PLR_GL(void, DrawBuffers, (GLsizei n, const GLenum *bufs))                                     \
    PLR_GL(void, StencilOpSeparate, (GLenum face, GLenum sfail, GLenum dpfail, GLenum dppass))     \
    PLR_GL(void, StencilFuncSeparate, (GLenum face, GLenum func, GLint ref, GLuint mask))          \
    PLR_GL(void, StencilMaskSeparate, (GLenum face, GLuint mask))                                  \
    PLR_GL(void, AttachShader, (GLuint program, GLuint shader))                                    \
    PLR_GL(void, BindAttribLocation, (GLuint program, GLuint index, const GLchar *name))           \
    PLR_GL(void, CompileShader, (GLuint shader))                                                   \
    PLR_GL(GLuint, CreateProgram, (void))                                                          \
    PLR_GL(GLuint, CreateShader, (GLenum type))                                                    \
    PLR_GL(void, DeleteProgram, (GLuint program))                                                  \
    PLR_GL(void, DeleteShader, (GLuint shader))                                                    \
    PLR_GL(void, DetachShader, (GLuint program, GLuint shader))                                    \
    PLR_GL(void, DisableVertexAttribArray, (GLuint index))                                         \
    PLR_GL(void, EnableVertexAttribArray, (GLuint index))                                          \
    PLR_GL(void, GetActiveAttrib,                                                                  \
           (GLuint program, GLuint index, GLsizei bufSize, GLsizei * length, GLint * size,         \
            GLenum * type, GLchar * name))                                                         \
    PLR_GL(void, GetActiveUniform,                                                                 \
           (GLuint program, GLuint index, GLsizei bufSize, GLsizei * length, GLint * size,         \
            GLenum * type, GLchar * name))                                                         \
    PLR_GL(void, GetAttachedShaders,                                                               \
           (GLuint program, GLsizei maxCount, GLsizei * count, GLuint * shaders))                  \
    PLR_GL(GLint, GetAttribLocation, (GLuint program, const GLchar *name))                         \
    PLR_GL(void, GetProgramiv, (GLuint program, GLenum pname, GLint * params))                     \
    PLR_GL(void, GetProgramInfoLog,                                                                \
           (GLuint program, GLsizei bufSize, GLsizei * length, GLchar * infoLog))                  \
    PLR_GL(void, GetShaderiv, (GLuint shader, GLenum pname, GLint * params))                       \
    PLR_GL(void, GetShaderInfoLog,                                                                 \
           (GLuint shader, GLsizei bufSize, GLsizei * length, GLchar * infoLog))                   \
    PLR_GL(void, GetShaderSource,                                                                  \
           (GLuint shader, GLsizei bufSize, GLsizei * length, GLchar * source))                    \
    PLR_GL(GLint, GetUniformLocation, (GLuint program, const GLchar *name))                        \
    PLR_GL(void, GetUniformfv, (GLuint program, GLint location, GLfloat * params))                 \
    PLR_GL(void, GetUniformiv, (GLuint program, GLint location, GLint * params))                   \
    PLR_GL(void, GetVertexAttribiv, (GLuint index, GLenum pname, GLint * params))                  \
    PLR_GL(void, GetVertexAttribfv, (GLuint index, GLenum pname, GLfloat * params))                \
    PLR_GL(void, GetVertexAttribPointerv, (GLuint index, GLenum pname, void **pointer))            \
    PLR_GL(GLboolean, IsProgram, (GLuint program))                                                 \
    PLR_GL(GLboolean, IsShader, (GLuint shader))                                                   \
    PLR_GL(void, LinkProgram, (GLuint program))                                                    \
    PLR_GL(void, ShaderSource,                                                                     \
           (GLuint shader, GLsizei count, const GLchar *const *string, const GLint *length))       \
    PLR_GL(void, UseProgram, (GLuint program))                                                     \
    PLR_GL(void, Uniform1f, (GLint location, GLfloat v0))                                          \
    PLR_GL(void, Uniform2f, (GLint location, GLfloat v0, GLfloat v1))                              \
    PLR_GL(void, Uniform3f, (GLint location, GLfloat v0, GLfloat v1, GLfloat v2))                  \
    PLR_GL(void, Uniform4f, (GLint location, GLfloat v0, GLfloat v1, GLfloat v2, GLfloat v3))      \
    PLR_GL(void, Uniform1i, (GLint location, GLint v0))                                            \
    PLR_GL(void, Uniform2i, (GLint location, GLint v0, GLint v1))                                  \
    PLR_GL(void, Uniform3i, (GLint location, GLint v0, GLint v1, GLint v2))                        \
    PLR_GL(void, Uniform4i, (GLint location, GLint v0, GLint v1, GLint v2, GLint v3))              \
    PLR_GL(void, Uniform1fv, (GLint location, GLsizei count, const GLfloat *value))                \
    PLR_GL(void, Uniform2fv, (GLint location, GLsizei count, const GLfloat *value))                \
    PLR_GL(void, Uniform3fv, (GLint location, GLsizei count, const GLfloat *value))                \
    PLR_GL(void, Uniform4fv, (GLint location, GLsizei count, const GLfloat *value))                \
    PLR_GL(void, Uniform1iv, (GLint location, GLsizei count, const GLint *value))                  \
    PLR_GL(void, Uniform2iv, (GLint location, GLsizei count, const GLint *value))                  \
    PLR_GL(void, Uniform3iv, (GLint location, GLsizei count, const GLint *value))                  \
    PLR_GL(void, Uniform4iv, (GLint location, GLsizei count, const GLint *value))                  \
    PLR_GL(void, UniformMatrix2fv,                                                                 \
           (GLint location, GLsizei count, GLboolean transpose, const GLfloat *value))             \
    PLR_GL(void, UniformMatrix3fv,                                                                 \
           (GLint location, GLsizei count, GLboolean transpose, const GLfloat *value))             \
    PLR_GL(void, UniformMatrix4fv,                                                                 \
           (GLint location, GLsizei count, GLboolean transpose, const GLfloat *value))             \
    PLR_GL(void, ValidateProgram, (GLuint program))                                                \
    PLR_GL(void, VertexAttrib1f, (GLuint index, GLfloat x))                                        \
    PLR_GL(void, VertexAttrib2f, (GLuint index, GLfloat x, GLfloat y))                             \
    PLR_GL(void, VertexAttrib3f, (GLuint index, GLfloat x, GLfloat y, GLfloat z))                  \
    PLR_GL(void, VertexAttrib4f, (GLuint index, GLfloat x, GLfloat y, GLfloat z, GLfloat w))       \
    PLR_GL(void, VertexAttrib1fv, (GLuint index, const GLfloat *v))                                \
    PLR_GL(void, VertexAttrib2fv, (GLuint index, const GLfloat *v))                                \
    PLR_GL(void, VertexAttrib3fv, (GLuint index, const GLfloat *v))                                \
    PLR_GL(void, VertexAttrib4fv, (GLuint index, const GLfloat *v))                                \
    PLR_GL(void, VertexAttribPointer,                                                              \
           (GLuint index, GLint size, GLenum type, GLboolean normalized, GLsizei stride,           \
            const void *pointer))                                                                  \
    /* GL 2.1 */                                                                                   \
    PLR_GL(void, UniformMatrix2x3fv,                                                               \
           (GLint location, GLsizei count, GLboolean transpose, const GLfloat *value))             \
    PLR_GL(void, UniformMatrix3x2fv,                                                               \
           (GLint location, GLsizei count, GLboolean transpose, const GLfloat *value))             \
    PLR_GL(void, UniformMatrix2x4fv,                                                               \
           (GLint location, GLsizei count, GLboolean transpose, const GLfloat *value))             \
    PLR_GL(void, UniformMatrix4x2fv,                                                               \
           (GLint location, GLsizei count, GLboolean transpose, const GLfloat *value))             \
    PLR_GL(void, UniformMatrix3x4fv,                                                               \
           (GLint location, GLsizei count, GLboolean transpose, const GLfloat *value))             \
    PLR_GL(void, UniformMatrix4x3fv,                                                               \
           (GLint location, GLsizei count, GLboolean transpose, const GLfloat *value))             \
    /* GL 3.0 */                                                                                   \
    PLR_GL(void, ColorMaski, (GLuint index, GLboolean r, GLboolean g, GLboolean b, GLboolean a))   \
    PLR_GL(void, GetBooleani_v, (GLenum target, GLuint index, GLboolean * data))                   \
    PLR_GL(void, GetIntegeri_v, (GLenum target, GLuint index, GLint * data))                       \
    PLR_GL(void, Enablei, (GLenum target, GLuint index))                                           \
    PLR_GL(void, Disablei, (GLenum target, GLuint index))                                          \
    PLR_GL(GLboolean, IsEnabledi, (GLenum target, GLuint index))                                   \
    PLR_GL(void, BindBufferRange,                                                                  \
           (GLenum target, GLuint index, GLuint buffer, GLintptr offset, GLsizeiptr size))         \
    PLR_GL(void, BindBufferBase, (GLenum target, GLuint index, GLuint buffer))                     \
    PLR_GL(void, ClampColor, (GLenum target, GLenum clamp))                                        \
    PLR_GL(void, BeginConditionalRender, (GLuint id, GLenum mode))                                 \
    PLR_GL(void, EndConditionalRender, (void))                                                     \
    PLR_GL(void, VertexAttribIPointer,                                                             \
           (GLuint index, GLint size, GLenum type, GLsizei stride, const void *pointer))           \
    PLR_GL(void, GetUniformuiv, (GLuint program, GLint location, GLuint * params))                 \
    PLR_GL(void, BindFragDataLocation, (GLuint program, GLuint color, const GLchar *name))         \
    PLR_GL(GLint, GetFragDataLocation, (GLuint program, const GLchar *name))                       \
    PLR_GL(void, Uniform1ui, (GLint location, GLuint v0))                                          \
    PLR_GL(void, Uniform2ui, (GLint location, GLuint v0, GLuint v1))                               \
    PLR_GL(void, Uniform3ui, (GLint location, GLuint v0, GLuint v1, GLuint v2))                    \
    PLR_GL(void, Uniform4ui, (GLint location, GLuint v0, GLuint v1, GLuint v2, GLuint v3))         \
    PLR_GL(void, Uniform1uiv, (GLint location, GLsizei count, const GLuint *value))                \
    PLR_GL(void, Uniform2uiv, (GLint location, GLsizei count, const GLuint *value))                \
    PLR_GL(void, Uniform3uiv, (GLint location, GLsizei count, const GLuint *value))                \
    PLR_GL(void, Uniform4uiv, (GLint location, GLsizei count, const GLuint *value))                \
    PLR_GL(void, ClearBufferiv, (GLenum buffer, GLint drawbuffer, const GLint *value))             \
    PLR_GL(void, ClearBufferuiv, (GLenum buffer, GLint drawbuffer, const GLuint *value))           \
    PLR_GL(void, ClearBufferfv, (GLenum buffer, GLint drawbuffer, const GLfloat *value))           \
    PLR_GL(void, ClearBufferfi, (GLenum buffer, GLint drawbuffer, GLfloat depth, GLint stencil))   \
    PLR_GL(const GLubyte *, GetStringi, (GLenum name, GLuint index))                               \
    PLR_GL(GLboolean, IsRenderbuffer, (GLuint renderbuffer))                                       \
    PLR_GL(void, BindRenderbuffer, (GLenum target, GLuint renderbuffer))                           \
    PLR_GL(void, DeleteRenderbuffers, (GLsizei n, const GLuint *renderbuffers))                    \
    PLR_GL(void, GenRenderbuffers, (GLsizei n, GLuint * renderbuffers))                            \
    PLR_GL(void, RenderbufferStorage,                                                              \
           (GLenum target, GLenum internalformat, GLsizei width, GLsizei height))                  \
    PLR_GL(void, GetRenderbufferParameteriv, (GLenum target, GLenum pname, GLint * params))        \
    PLR_GL(GLboolean, IsFramebuffer, (GLuint framebuffer))                                         \
    PLR_GL(void, BindFramebuffer, (GLenum target, GLuint framebuffer))                             \
    PLR_GL(void, DeleteFramebuffers, (GLsizei n, const GLuint *framebuffers))                      \
    PLR_GL(void, GenFramebuffers, (GLsizei n, GLuint * framebuffers))                              \
    PLR_GL(GLenum, CheckFramebufferStatus, (GLenum target))                                        \
    PLR_GL(void, FramebufferTexture1D,                                                             \
           (GLenum target, GLenum attachment, GLenum textarget, GLuint texture, GLint level))      \
    PLR_GL(void, FramebufferTexture2D,                                                             \
           (GLenum target, GLenum attachment, GLenum textarget, GLuint texture, GLint level))      \
    PLR_GL(void, FramebufferTexture3D,                                                             \
           (GLenum target, GLenum attachment, GLenum textarget, GLuint texture, GLint level,       \
            GLint zoffset))                                                                        \
    PLR_GL(void, FramebufferRenderbuffer,                                                          \
           (GLenum target, GLenum attachment, GLenum renderbuffertarget, GLuint renderbuffer))     \
    PLR_GL(void, GetFramebufferAttachmentParameteriv,                                              \
           (GLenum target, GLenum attachment, GLenum pname, GLint * params))                       \
    PLR_GL(void, GenerateMipmap, (GLenum target))                                                  \
    PLR_GL(void, BlitFramebuffer,                                                                  \
           (GLint srcX0, GLint srcY0, GLint srcX1, GLint srcY1, GLint dstX0, GLint dstY0,          \
            GLint dstX1, GLint dstY1, GLbitfield mask, GLenum filter))                             \
    PLR_GL(void, RenderbufferStorageMultisample,                                                   \
           (GLenum target, GLsizei samples, GLenum internalformat, GLsizei width, GLsizei height)) \
    PLR_GL(void, FramebufferTextureLayer,                                                          \
           (GLenum target, GLenum attachment, GLuint texture, GLint level, GLint layer))           \
    PLR_GL(void *, MapBufferRange,                                                                 \
           (GLenum target, GLintptr offset, GLsizeiptr length, GLbitfield access))                 \
    PLR_GL(void, FlushMappedBufferRange, (GLenum target, GLintptr offset, GLsizeiptr length))      \
    PLR_GL(void, BindVertexArray, (GLuint array))                                                  \
    PLR_GL(void, DeleteVertexArrays, (GLsizei n, const GLuint *arrays))                            \
    PLR_GL(void, GenVertexArrays, (GLsizei n, GLuint * arrays))                                    \
    PLR_GL(GLboolean, IsVertexArray, (GLuint array))                                               \
    /* GL 3.1 */                                                                                   \
    PLR_GL(void, DrawArraysInstanced,                                                              \
           (GLenum mode, GLint first, GLsizei count, GLsizei instancecount))                       \
    PLR_GL(void, DrawElementsInstanced,                                                            \
           (GLenum mode, GLsizei count, GLenum type, const void *indices, GLsizei instancecount))  \
    PLR_GL(void, TexBuffer, (GLenum target, GLenum internalformat, GLuint buffer))                 \
    PLR_GL(void, PrimitiveRestartIndex, (GLuint index))                                            \
    PLR_GL(void, CopyBufferSubData,                                                                \
           (GLenum readTarget, GLenum writeTarget, GLintptr readOffset, GLintptr writeOffset,      \
            GLsizeiptr size))                                                                      \
    PLR_GL(void, GetUniformIndices,                                                                \
           (GLuint program, GLsizei uniformCount, const GLchar *const *uniformNames,               \
            GLuint *uniformIndices))                                                               \
    PLR_GL(void, GetActiveUniformsiv,                                                              \
           (GLuint program, GLsizei uniformCount, const GLuint *uniformIndices, GLenum pname,      \
            GLint *params))                                                                        \
    PLR_GL(void, GetActiveUniformName,                                                             \
           (GLuint program, GLuint uniformIndex, GLsizei bufSize, GLsizei * length,                \
            GLchar * uniformName))                                                                 \
    PLR_GL(GLuint, GetUniformBlockIndex, (GLuint program, const GLchar *uniformBlockName))         \
    PLR_GL(void, GetActiveUniformBlockiv,                                                          \
           (GLuint program, GLuint uniformBlockIndex, GLenum pname, GLint * params))               \
    PLR_GL(void, GetActiveUniformBlockName,                                                        \
           (GLuint program, GLuint uniformBlockIndex, GLsizei bufSize, GLsizei * length,           \
            GLchar * uniformBlockName))                                                            \
    PLR_GL(void, UniformBlockBinding,                                                              \
           (GLuint program, GLuint uniformBlockIndex, GLuint uniformBlockBinding))                 \
    /* GL 3.2 */                                                                                   \
    PLR_GL(void, DrawElementsBaseVertex,                                                           \
           (GLenum mode, GLsizei count, GLenum type, const void *indices, GLint basevertex))       \
    PLR_GL(void, ProvokingVertex, (GLenum mode))                                                   \
    PLR_GL(GLsync, FenceSync, (GLenum condition, GLbitfield flags))                                \
    PLR_GL(GLboolean, IsSync, (GLsync sync))                                                       \
    PLR_GL(void, DeleteSync, (GLsync sync))                                                        \
    PLR_GL(GLenum, ClientWaitSync, (GLsync sync, GLbitfield flags, GLuint64 timeout))              \
    PLR_GL(void, GetInteger64v, (GLenum pname, GLint64 * data))                                    \
    PLR_GL(void, GetBufferParameteri64v, (GLenum target, GLenum pname, GLint64 * params))          \
    PLR_GL(void, FramebufferTexture,                                                               \
           (GLenum target, GLenum attachment, GLuint texture, GLint level))                        \
    PLR_GL(void, TexImage2DMultisample,                                                            \
           (GLenum target, GLsizei samples, GLenum internalformat, GLsizei width, GLsizei height,  \
            GLboolean fixedsamplelocations))                                                       \
    PLR_GL(void, SampleMaski, (GLuint maskNumber, GLbitfield mask))                                \
    /* GL 3.3 */                                                                                   \
    PLR_GL(void, GenSamplers, (GLsizei count, GLuint * samplers))                                  \
    PLR_GL(void, DeleteSamplers, (GLsizei count, const GLuint *samplers))                          \
    PLR_GL(GLboolean, IsSampler, (GLuint sampler))                                                 \
    PLR_GL(void, BindSampler, (GLuint unit, GLuint sampler))                                       \
    PLR_GL(void, SamplerParameteri, (GLuint sampler, GLenum pname, GLint param))                   \
    PLR_GL(void, SamplerParameterf, (GLuint sampler, GLenum pname, GLfloat param))                 \
    PLR_GL(void, SamplerParameterfv, (GLuint sampler, GLenum pname, const GLfloat *param))         \
    PLR_GL(void, GetSamplerParameteriv, (GLuint sampler, GLenum pname, GLint * params))            \
    PLR_GL(void, QueryCounter, (GLuint id, GLenum target))                                         \
    PLR_GL(void, GetQueryObjecti64v, (GLuint id, GLenum pname, GLint64 * params))                  \
    PLR_GL(void, GetQueryObjectui64v, (GLuint id, GLenum pname, GLuint64 * params))                \
    PLR_GL(void, VertexAttribDivisor, (GLuint index, GLuint divisor))

/* Functions newer than GL 3.3: PLR_GL(VERSION, "EXTENSION", RETURN, Name, (PARAMETERS)). NULL where
 * the context has neither the version nor the extension, whatever the loader returns. */
#define PLR_GL_OPTIONAL(PLR_GL)                                                                    \
    PLR_GL(                                                                                        \
        410, "GL_ARB_get_program_binary", void, GetProgramBinary,                                  \
        (GLuint program, GLsizei bufSize, GLsizei * length, GLenum * binaryFormat, void *binary))  \
    PLR_GL(410, "GL_ARB_get_program_binary", void, ProgramBinary,                                  \
           (GLuint program, GLenum binaryFormat, const void *binary, GLsizei length))              \
    PLR_GL(410, "GL_ARB_get_program_binary", void, ProgramParameteri,                              \
           (GLuint program, GLenum pname, GLint value))                                            \
    PLR_GL(450, "GL_ARB_clip_control", void, ClipControl, (GLenum origin, GLenum depth))           \
    PLR_GL(430, "GL_KHR_debug", void, DebugMessageCallback,                                        \
           (GLDEBUGPROC callback, const void *userParam))                                          \
    PLR_GL(430, "GL_KHR_debug", void, DebugMessageControl,                                         \
           (GLenum source, GLenum type, GLenum severity, GLsizei count, const GLuint *ids,         \
            GLboolean enabled))                                                                    \
    PLR_GL(430, "GL_KHR_debug", void, ObjectLabel,                                                 \
           (GLenum identifier, GLuint name, GLsizei length, const GLchar *label))                  \
    PLR_GL(430, "GL_KHR_debug", void, PushDebugGroup,                                              \
           (GLenum source, GLuint id, GLsizei length, const GLchar *message))                      \
    PLR_GL(430, "GL_KHR_debug", void, PopDebugGroup, (void))                                       \
    PLR_GL(420, "GL_ARB_texture_storage", void, TexStorage2D,                                      \
           (GLenum target, GLsizei levels, GLenum internalformat, GLsizei width, GLsizei height))  \
    PLR_GL(420, "GL_ARB_texture_storage", void, TexStorage3D,                                      \
           (GLenum target, GLsizei levels, GLenum internalformat, GLsizei width, GLsizei height,   \
            GLsizei depth))

typedef struct plr_gl {
#define PLR_GL(type, name, parameters) type(APIENTRY *name) parameters;
#define PLR_GL_NEWER(version, extension, type, name, parameters) type(APIENTRY *name) parameters;
    PLR_GL_FUNCTIONS(PLR_GL)
    PLR_GL_OPTIONAL(PLR_GL_NEWER)
#undef PLR_GL
#undef PLR_GL_NEWER
    int version; /* of the context: 330, 450 */
} plr_gl;

/* Fills the table from the host's loader, for the context that is current. Returns NULL, or what is
 * missing: the name of a required function, or "GL 3.3" if the context is older. Needs GL. */
const char *plr_gl_load(plr_gl *gl, void *(*get_proc_address)(void *user, const char *name),
                        void *user);
/* Whether the context has the extension. Needs GL. */
bool plr_gl_has(const plr_gl *gl, const char *extension);

#endif
