#include "engine/gl.h"

#include <stddef.h>
#include <stdio.h>
#include <string.h>

typedef struct entry {
    const char *name;
    size_t offset;
    int version;           /* 0: required */
    const char *extension; /* brings it to an older context */
} entry;

static const entry entries[] = {
#define PLR_GL(type, name, parameters) {"gl" #name, offsetof(plr_gl, name), 0, NULL},
#define PLR_GL_NEWER(version, extension, type, name, parameters)                                   \
    {"gl" #name, offsetof(plr_gl, name), version, extension},
    PLR_GL_FUNCTIONS(PLR_GL) PLR_GL_OPTIONAL(PLR_GL_NEWER)
#undef PLR_GL
#undef PLR_GL_NEWER
};

#define ENTRY_COUNT (sizeof entries / sizeof entries[0])

/* ISO C has no conversion between pointers to data and to functions; POSIX gives both one form. */
static void set(plr_gl *gl, const entry *e, void *function) {
    memcpy((char *)gl + e->offset, &function, sizeof function);
}

bool plr_gl_has(const plr_gl *gl, const char *extension) {
    GLint count = 0;
    gl->GetIntegerv(GL_NUM_EXTENSIONS, &count);
    for (GLint i = 0; i < count; i++) {
        const GLubyte *name = gl->GetStringi(GL_EXTENSIONS, (GLuint)i);
        if (name && strcmp((const char *)name, extension) == 0)
            return true;
    }
    return false;
}

/* "4.5 (Core Profile) Mesa" is 450. Before GL 3.0 only this string tells the version. */
static int version_of(const plr_gl *gl) {
    const GLubyte *text = gl->GetString(GL_VERSION);
    int major = 0, minor = 0;
    if (!text || sscanf((const char *)text, "%d.%d", &major, &minor) != 2)
        return 0;
    return major * 100 + minor * 10;
}

const char *plr_gl_load(plr_gl *gl, void *(*get_proc_address)(void *user, const char *name),
                        void *user) {
    *gl = (plr_gl){0};
    for (size_t i = 0; i < ENTRY_COUNT; i++) {
        void *function = get_proc_address(user, entries[i].name);
        if (!function && !entries[i].version)
            return entries[i].name;
        set(gl, &entries[i], function);
    }
    gl->version = version_of(gl);
    if (gl->version < 330)
        return "GL 3.3";
    /* Loaders return stubs for functions that the context does not have. */
    for (size_t i = 0; i < ENTRY_COUNT; i++)
        if (gl->version < entries[i].version && !plr_gl_has(gl, entries[i].extension))
            set(gl, &entries[i], NULL);
    return NULL;
}
