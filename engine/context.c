#include "engine/context.h"

#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "engine/gl.h"

struct plr_context {
    const plr_context_platform *platform;
    void *state, *shared; /* of plr_context_make_shared_current */
    char description[256];
};

/* In the order in which PLR_BACKEND_AUTO tries them. */
static const plr_context_platform *const platforms[] = {&plr_context_egl, &plr_context_osmesa};
#define PLATFORM_COUNT (sizeof platforms / sizeof platforms[0])

bool plr_library_function(void *library, const char *name, void *pointer, size_t size) {
    void *symbol = dlsym(library, name);
    if (size == sizeof symbol)
        memcpy(pointer, &symbol, size);
    return symbol && size == sizeof symbol;
}

/* EGL and OSMesa of Mesa share one slot a thread for the current context, and neither knows when
 * the other has changed it: with both bound, calls go to the wrong context or nowhere. */
static void unbind_all(void) {
    for (size_t i = 0; i < PLATFORM_COUNT; i++)
        platforms[i]->unbind();
}

bool plr_context_make_current(plr_context *context) {
    unbind_all();
    return context->platform->make_current(context->state);
}

/* What is wrong with the context, or NULL; it is then current and described. */
static const char *check(plr_context *context) {
    if (!plr_context_make_current(context))
        return "the context cannot be made current";
    plr_gl gl;
    const char *missing = plr_gl_load(&gl, plr_context_get_proc_address, context);
    if (missing)
        return missing;
    const GLubyte *renderer = gl.GetString(GL_RENDERER);
    snprintf(context->description, sizeof context->description, "%s, %s, %d.%d",
             context->platform->name, renderer ? (const char *)renderer : "unknown",
             gl.version / 100, gl.version / 10 % 10);
    return NULL;
}

/* Appends to a text of fixed size; what does not fit is cut. */
static void append(char *buffer, size_t size, const char *first, const char *second) {
    size_t length = strlen(buffer);
    snprintf(buffer + length, size - length, "%s%s: %s", length ? "; " : "", first, second);
}

static plr_context *open_platform(const plr_context_platform *platform, const char *library,
                                  char *tried, size_t size) {
    char reason[512] = "no memory";
    plr_context *context = calloc(1, sizeof *context);
    if (context) {
        context->platform = platform;
        context->state = platform->open(library, reason, sizeof reason);
    }
    if (context && context->state) {
        const char *fault = check(context);
        if (!fault)
            return context;
        snprintf(reason, sizeof reason, "it lacks or fails: %s", fault);
    }
    append(tried, size, platform->name, reason);
    plr_context_destroy(&context);
    return NULL;
}

plr_context *plr_context_create_with(plr_backend backend, const plr_context_libraries *libraries,
                                     plr_diags *diags) {
    const char *names[PLATFORM_COUNT] = {libraries->egl, libraries->osmesa};
    char tried[1024] = "";
    for (size_t i = 0; i < PLATFORM_COUNT; i++) {
        if (backend != PLR_BACKEND_AUTO && backend != platforms[i]->backend)
            continue;
        plr_context *context = open_platform(platforms[i], names[i], tried, sizeof tried);
        if (context)
            return context;
    }
    plr_diags_add(diags, PLR_CODE_NO_GL, (plr_place){0}, "no context of GL 3.3 or later (%s)",
                  tried);
    return NULL;
}

plr_context *plr_context_create(plr_backend backend, plr_diags *diags) {
    return plr_context_create_with(backend, &(plr_context_libraries){0}, diags);
}

bool plr_context_make_shared_current(void *context, bool current) {
    plr_context *c = context;
    unbind_all();
    if (current && !c->shared)
        c->shared = c->platform->share(c->state);
    if (current)
        return c->shared && c->platform->make_current(c->shared);
    if (c->shared)
        c->platform->close(c->shared);
    c->shared = NULL;
    return true;
}

void plr_context_destroy(plr_context **context) {
    if (!*context)
        return;
    if ((*context)->shared)
        (*context)->platform->close((*context)->shared);
    if ((*context)->state)
        (*context)->platform->close((*context)->state);
    free(*context);
    *context = NULL;
}

void *plr_context_get_proc_address(void *context, const char *name) {
    plr_context *c = context;
    return c->platform->get_proc_address(c->state, name);
}

plr_backend plr_context_backend(const plr_context *context) {
    return context->platform->backend;
}

const char *plr_context_description(const plr_context *context) {
    return context->description;
}
