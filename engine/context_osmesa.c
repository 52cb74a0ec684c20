/* OSMesa: Mesa's software renderer, which draws into memory and needs no driver. */
#include "engine/context.h"

#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <GL/glcorearb.h>

/* <GL/osmesa.h> would bring <GL/gl.h> and with it direct gl* functions; these facts are its ABI. */
typedef struct osmesa_context *OSMesaContext;
enum {
    OSMESA_FORMAT = 0x22,
    OSMESA_PROFILE = 0x33,
    OSMESA_CORE_PROFILE = 0x34,
    OSMESA_CONTEXT_MAJOR_VERSION = 0x36,
    OSMESA_CONTEXT_MINOR_VERSION = 0x37
};

typedef struct osmesa {
    void *library;
    OSMesaContext (*CreateContextAttribs)(const int *attributes, OSMesaContext share);
    void (*DestroyContext)(OSMesaContext context);
    GLboolean (*MakeCurrent)(OSMesaContext context, void *buffer, GLenum type, GLsizei width,
                             GLsizei height);
    OSMesaContext (*GetCurrentContext)(void);
    void *(*GetProcAddress)(const char *name);
    OSMesaContext context;
    /* OSMesa has no context without a drawing surface: the smallest one, that nobody draws to. */
    GLubyte surface[4];
} osmesa;

static const char *const libraries[] = {"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"};
#define LIBRARY_COUNT (sizeof libraries / sizeof libraries[0])

/* The libraries stay loaded once they are: drivers keep threads and thread-local data. */
static void *load(const char *name, int flags) {
    if (name)
        return dlopen(name, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE | flags);
    void *library = NULL;
    for (size_t i = 0; !library && i < LIBRARY_COUNT; i++)
        library = load(libraries[i], flags);
    return library;
}

static bool resolve(osmesa *o) {
    return PLR_FUNCTION(o->library, "OSMesaCreateContextAttribs", o->CreateContextAttribs) &&
           PLR_FUNCTION(o->library, "OSMesaDestroyContext", o->DestroyContext) &&
           PLR_FUNCTION(o->library, "OSMesaMakeCurrent", o->MakeCurrent) &&
           PLR_FUNCTION(o->library, "OSMesaGetCurrentContext", o->GetCurrentContext) &&
           PLR_FUNCTION(o->library, "OSMesaGetProcAddress", o->GetProcAddress);
}

static void finish(osmesa *o) {
    if (o->library)
        dlclose(o->library);
    free(o);
}

static const int attributes[] = {OSMESA_FORMAT,
                                 0x1908, /* GL_RGBA */
                                 OSMESA_PROFILE,
                                 OSMESA_CORE_PROFILE,
                                 OSMESA_CONTEXT_MAJOR_VERSION,
                                 3,
                                 OSMESA_CONTEXT_MINOR_VERSION,
                                 3,
                                 0};

static void *osmesa_open(const char *library, char *reason, size_t size) {
    osmesa *o = calloc(1, sizeof *o);
    if (!o)
        return NULL;
    o->library = load(library, 0);
    if (!o->library) {
        const char *why = dlerror();
        snprintf(reason, size, "%s", why ? why : "the library cannot be loaded");
    } else if (!resolve(o)) {
        snprintf(reason, size, "the library is too old");
    } else {
        o->context = o->CreateContextAttribs(attributes, NULL);
        if (o->context)
            return o;
        snprintf(reason, size, "it has no core profile of GL 3.3");
    }
    finish(o);
    return NULL;
}

static void *osmesa_share(void *state) {
    const osmesa *o = state;
    osmesa *other = calloc(1, sizeof *other);
    if (!other)
        return NULL;
    *other = *o;
    other->library = load(NULL, RTLD_NOLOAD); /* held once more */
    other->context = o->CreateContextAttribs(attributes, o->context);
    if (other->context)
        return other;
    finish(other);
    return NULL;
}

static bool osmesa_make_current(void *state) {
    osmesa *o = state;
    return o->MakeCurrent(o->context, o->surface, GL_UNSIGNED_BYTE, 1, 1);
}

static void osmesa_unbind(void) {
    osmesa o = {.library = load(NULL, RTLD_NOLOAD)};
    if (!o.library)
        return;
    if (resolve(&o) && o.GetCurrentContext())
        o.MakeCurrent(NULL, NULL, 0, 0, 0);
    dlclose(o.library);
}

static void osmesa_close(void *state) {
    osmesa *o = state;
    if (o->GetCurrentContext() == o->context)
        o->MakeCurrent(NULL, NULL, 0, 0, 0);
    o->DestroyContext(o->context);
    finish(o);
}

static void *osmesa_get_proc_address(void *state, const char *name) {
    osmesa *o = state;
    return o->GetProcAddress(name);
}

const plr_context_platform plr_context_osmesa = {
    PLR_BACKEND_OSMESA,  "OSMesa",      osmesa_open,  osmesa_share,
    osmesa_make_current, osmesa_unbind, osmesa_close, osmesa_get_proc_address};
