/* The GL functions that the engine calls: one table per context, no direct gl* call anywhere. */
#ifndef PLR_ENGINE_GL_H
#define PLR_ENGINE_GL_H

#include <stdbool.h>
#include <GL/glcorearb.h>

/* PLR_GL(RETURN, Name, (PARAMETERS)): add what you need. All are in GL 3.3 core. */
#define PLR_GL_FUNCTIONS(PLR_GL)                                                                   \
    PLR_GL(const GLubyte *, GetString, (GLenum name))                                              \
    PLR_GL(GLenum, GetError, (void))

/* Functions that may be missing (NULL): newer than GL 3.3. */
#define PLR_GL_OPTIONAL(PLR_GL)                                                                    \
    PLR_GL(void, GetProgramBinary,                                                                 \
           (GLuint program, GLsizei size, GLsizei *length, GLenum *format, void *binary))

typedef struct plr_gl {
#define PLR_GL(type, name, parameters) type(APIENTRY *name) parameters;
    PLR_GL_FUNCTIONS(PLR_GL)
    PLR_GL_OPTIONAL(PLR_GL)
#undef PLR_GL
} plr_gl;

/* Fills the table from the host's loader. Returns NULL, or the name of a required function that is
 * missing. */
const char *plr_gl_load(plr_gl *gl, void *(*get_proc_address)(void *user, const char *name),
                        void *user);

#endif
