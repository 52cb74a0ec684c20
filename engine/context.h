/* Headless contexts, inside: what EGL and OSMesa have in common. */
#ifndef PLR_ENGINE_CONTEXT_H
#define PLR_ENGINE_CONTEXT_H

#include <plugray/engine.h>

/* A way to GL without a window. The libraries are loaded at run time. */
typedef struct plr_context_platform {
    plr_backend backend;
    const char *name; /* "EGL" */
    /* Makes a context that is not yet current. `library` NULL: the usual names. NULL with the
     * reason in `reason` if there is none. */
    void *(*open)(const char *library, char *reason, size_t size);
    /* Makes another context that shares programs, textures and buffers with that of `state`, which
     * may be current on another thread. NULL: it cannot be had. */
    void *(*share)(void *state);
    /* Nothing of either platform is current on this thread when this is called. */
    bool (*make_current)(void *state);
    /* Leaves this thread without a context of this API, whoever made it current. */
    void (*unbind)(void);
    void (*close)(void *state); /* current on no other thread; unbinds it from this one */
    void *(*get_proc_address)(void *state, const char *name);
} plr_context_platform;

extern const plr_context_platform plr_context_egl, plr_context_osmesa;

/* The libraries to load; NULL: the usual names. Others serve tests. */
typedef struct plr_context_libraries {
    const char *egl, *osmesa;
} plr_context_libraries;

/* plr_context_create with other libraries. */
plr_context *plr_context_create_with(plr_backend backend, const plr_context_libraries *libraries,
                                     plr_diags *diags);

/* A function of a library that dlopen returned, for a pointer of any function type. */
#define PLR_FUNCTION(library, name, pointer)                                                       \
    plr_library_function((library), (name), &(pointer), sizeof(pointer))
bool plr_library_function(void *library, const char *name, void *pointer, size_t size);

#endif
