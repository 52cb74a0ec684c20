/* EGL without a window, a display or a surface. */
#include "engine/context.h"

#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#define EGL_NO_X11 /* no types of window systems */
#include <EGL/egl.h>
#include <EGL/eglext.h>

/* EGL_EXT_platform_base and friends are asked for by name; libEGL is not linked. */
#define EGL_FUNCTIONS(F)                                                                           \
    F(EGLBoolean, BindAPI, (EGLenum api))                                                          \
    F(EGLBoolean, ChooseConfig,                                                                    \
      (EGLDisplay display, const EGLint *attributes, EGLConfig *configs, EGLint size,              \
       EGLint *count))                                                                             \
    F(EGLContext, CreateContext,                                                                   \
      (EGLDisplay display, EGLConfig config, EGLContext share, const EGLint *attributes))          \
    F(EGLBoolean, DestroyContext, (EGLDisplay display, EGLContext context))                        \
    F(EGLContext, GetCurrentContext, (void))                                                       \
    F(EGLDisplay, GetCurrentDisplay, (void))                                                       \
    F(EGLDisplay, GetDisplay, (EGLNativeDisplayType native))                                       \
    F(EGLint, GetError, (void))                                                                    \
    F(void *, GetProcAddress, (const char *name))                                                  \
    F(EGLBoolean, Initialize, (EGLDisplay display, EGLint * major, EGLint * minor))                \
    F(EGLBoolean, MakeCurrent,                                                                     \
      (EGLDisplay display, EGLSurface draw, EGLSurface read, EGLContext context))                  \
    F(EGLenum, QueryAPI, (void))                                                                   \
    F(const char *, QueryString, (EGLDisplay display, EGLint name))

typedef struct egl {
    void *library;
#define F(type, name, parameters) type(EGLAPIENTRY *name) parameters;
    EGL_FUNCTIONS(F)
#undef F
    EGLDisplay display;
    EGLContext context;
} egl;

#define DEVICE_LIMIT 16

static const char library_name[] = "libEGL.so.1";

/* Libraries and displays stay as they are once opened. A display belongs to the process: ending it
 * (eglTerminate) would take it from other contexts and from the host; and drivers that are unloaded
 * leave threads and thread-local data behind. */
static void *load(const char *name, int flags) {
    return dlopen(name ? name : library_name, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE | flags);
}

static bool resolve(egl *e) {
    bool all = true;
#define F(type, name, parameters) all = PLR_FUNCTION(e->library, "egl" #name, e->name) && all;
    EGL_FUNCTIONS(F)
#undef F
    return all;
}

static void finish(egl *e) {
    if (e->library)
        dlclose(e->library);
    free(e);
}

/* Whether a list of words has the word. */
static bool has_word(const char *list, const char *word) {
    size_t length = strlen(word);
    for (const char *at = list; at && (at = strstr(at, word)); at += length)
        if ((at == list || at[-1] == ' ') && (at[length] == ' ' || !at[length]))
            return true;
    return false;
}

static bool has(const egl *e, EGLDisplay display, const char *extension) {
    return has_word(e->QueryString(display, EGL_EXTENSIONS), extension);
}

/* A config for contexts without surfaces: none where that is possible. */
static bool choose_config(const egl *e, EGLConfig *config) {
    static const EGLint attributes[] = {EGL_SURFACE_TYPE, EGL_DONT_CARE, EGL_RENDERABLE_TYPE,
                                        EGL_OPENGL_BIT, EGL_NONE};
    EGLint count = 0;
    *config = EGL_NO_CONFIG_KHR;
    if (has(e, e->display, "EGL_KHR_no_config_context") ||
        has(e, e->display, "EGL_MESA_configless_context"))
        return true;
    return e->ChooseConfig(e->display, attributes, config, 1, &count) && count > 0;
}

static const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                    3,
                                    EGL_CONTEXT_MINOR_VERSION,
                                    3,
                                    EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                    EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                    EGL_NONE};

/* Makes a context on the display, or says why not. */
static const char *try_display(egl *e, EGLDisplay display) {
    EGLint major = 0, minor = 0;
    EGLConfig config;
    if (display == EGL_NO_DISPLAY)
        return "no display";
    if (!e->Initialize(display, &major, &minor))
        return "cannot be initialised";
    e->display = display;
    if (!has(e, display, "EGL_KHR_surfaceless_context"))
        return "no contexts without a surface";
    if (!e->BindAPI(EGL_OPENGL_API))
        return "no desktop GL";
    if (!choose_config(e, &config))
        return "no configuration for desktop GL";
    e->context = e->CreateContext(display, config, EGL_NO_CONTEXT, attributes);
    return e->context == EGL_NO_CONTEXT ? "no core profile of GL 3.3" : NULL;
}

/* One way to a display that is tried, and what came of it. */
typedef struct attempt {
    egl *e;
    PFNEGLGETPLATFORMDISPLAYEXTPROC get_display;
    char *reason;
    size_t size;
} attempt;

static bool try_platform(attempt *a, const char *name, EGLenum platform, void *native) {
    const char *fault = try_display(a->e, a->get_display(platform, native, NULL));
    size_t length = strlen(a->reason);
    if (fault)
        snprintf(a->reason + length, a->size - length, "%s%s: %s", length ? ", " : "", name, fault);
    return !fault;
}

/* The devices that are software renderers, or those that are not. */
static bool try_devices(attempt *a, bool software) {
    PFNEGLQUERYDEVICESEXTPROC query_devices;
    PFNEGLQUERYDEVICESTRINGEXTPROC query_string;
    void *first = a->e->GetProcAddress("eglQueryDevicesEXT");
    void *second = a->e->GetProcAddress("eglQueryDeviceStringEXT");
    memcpy(&query_devices, &first, sizeof first);
    memcpy(&query_string, &second, sizeof second);
    EGLDeviceEXT devices[DEVICE_LIMIT];
    EGLint count = 0;
    if (!first || !second || !query_devices(DEVICE_LIMIT, devices, &count))
        return false;
    for (EGLint i = 0; i < count; i++) {
        const char *extensions = query_string(devices[i], EGL_EXTENSIONS);
        if (has_word(extensions, "EGL_MESA_device_software") == software &&
            try_platform(a, "device", EGL_PLATFORM_DEVICE_EXT, devices[i]))
            return true;
    }
    return false;
}

/* Real devices come first: where several drivers are installed, the surfaceless platform may be
 * that of the software renderer. */
static bool try_all(egl *e, char *reason, size_t size) {
    attempt a = {.e = e, .reason = reason, .size = size};
    void *function = e->GetProcAddress("eglGetPlatformDisplayEXT");
    memcpy(&a.get_display, &function, sizeof function);
    reason[0] = 0;
    bool platforms = function && has(e, EGL_NO_DISPLAY, "EGL_EXT_platform_base");
    bool devices = platforms && has(e, EGL_NO_DISPLAY, "EGL_EXT_platform_device");
    if (devices && try_devices(&a, false))
        return true;
    if (platforms && has(e, EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless") &&
        try_platform(&a, "surfaceless", EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY))
        return true;
    if (devices && try_devices(&a, true))
        return true;
    const char *fault = try_display(e, e->GetDisplay(EGL_DEFAULT_DISPLAY));
    size_t length = strlen(reason);
    if (fault)
        snprintf(reason + length, size - length, "%sdefault display: %s", length ? ", " : "",
                 fault);
    return !fault;
}

static void *egl_open(const char *library, char *reason, size_t size) {
    egl *e = calloc(1, sizeof *e);
    if (!e)
        return NULL;
    e->library = load(library, 0);
    if (!e->library) {
        const char *why = dlerror();
        snprintf(reason, size, "%s", why ? why : "the library cannot be loaded");
    } else if (!resolve(e)) {
        snprintf(reason, size, "the library is too old");
    } else {
        EGLenum api = e->QueryAPI();
        bool opened = try_all(e, reason, size);
        e->BindAPI(api);
        if (opened)
            return e;
    }
    finish(e);
    return NULL;
}

static void *egl_share(void *state) {
    const egl *e = state;
    egl *other = calloc(1, sizeof *other);
    EGLConfig config;
    if (!other)
        return NULL;
    *other = *e;
    other->library = load(NULL, RTLD_NOLOAD); /* held once more */
    other->context = e->BindAPI(EGL_OPENGL_API) && choose_config(e, &config)
                         ? e->CreateContext(e->display, config, e->context, attributes)
                         : EGL_NO_CONTEXT;
    if (other->context != EGL_NO_CONTEXT)
        return other;
    finish(other);
    return NULL;
}

static bool egl_make_current(void *state) {
    egl *e = state;
    return e->BindAPI(EGL_OPENGL_API) &&
           e->MakeCurrent(e->display, EGL_NO_SURFACE, EGL_NO_SURFACE, e->context);
}

static void egl_unbind(void) {
    egl e = {.library = load(NULL, RTLD_NOLOAD)};
    if (!e.library)
        return;
    if (resolve(&e) && e.GetCurrentContext() != EGL_NO_CONTEXT)
        e.MakeCurrent(e.GetCurrentDisplay(), EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    dlclose(e.library);
}

static void egl_close(void *state) {
    egl *e = state;
    if (e->GetCurrentContext() == e->context)
        e->MakeCurrent(e->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    e->DestroyContext(e->display, e->context);
    finish(e);
}

static void *egl_get_proc_address(void *state, const char *name) {
    egl *e = state;
    return e->GetProcAddress(name);
}

const plr_context_platform plr_context_egl = {
    PLR_BACKEND_EGL,  "EGL",      egl_open,  egl_share,
    egl_make_current, egl_unbind, egl_close, egl_get_proc_address,
};
