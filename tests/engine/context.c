/* Contexts of both kinds: alone, by turns on one thread, on two threads, and missing. */
#include <pthread.h>
#include <plugray/engine.h>

#include "engine/context.h"
#include "engine/gl.h"
#include "tests/engine/triangle.h"
#include "tests/tap.h"

static const plr_backend backends[] = {PLR_BACKEND_EGL, PLR_BACKEND_OSMESA};
static const float red[4] = {1, 0, 0, 1}, unclamped[4] = {-2.5f, 3.25f, 1e-6f, 0.5f};

static bool load(plr_gl *gl, plr_context *context) {
    return plr_gl_load(gl, plr_context_get_proc_address, context) == NULL;
}

/* Whether a context of that kind can be created; a test for it is skipped otherwise. */
static bool have(plr_backend backend) {
    plr_context *context = plr_context_create(backend, NULL);
    bool created = context != NULL;
    plr_context_destroy(&context);
    return created;
}

static void test_one(plr_backend backend) {
    plr_diags *diags = plr_diags_create(NULL);
    plr_context *context = plr_context_create(backend, diags);
    plr_gl gl;
    CHECK_INT(plr_diags_count(diags), 0);
    CHECK_INT(plr_context_backend(context), backend);
    printf("# %s\n", plr_context_description(context));
    CHECK(strstr(plr_context_description(context), ", ") != NULL);
    CHECK(load(&gl, context));
    CHECK(gl.version >= 330);
    CHECK(triangle_works(&gl, red));
    CHECK(triangle_works(&gl, unclamped));
    GLint profile = 0;
    gl.GetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
    CHECK_INT(profile & GL_CONTEXT_CORE_PROFILE_BIT, GL_CONTEXT_CORE_PROFILE_BIT);
    CHECK(plr_gl_has(&gl, "GL_ARB_get_program_binary") == (gl.GetProgramBinary != NULL) ||
          gl.version >= 410);
    CHECK(!plr_gl_has(&gl, "GL_ARB_get_program"));
    plr_context_destroy(&context);
    CHECK(context == NULL);
    plr_context_destroy(&context);
    plr_diags_destroy(&diags);
}

/* Two contexts that are current in turn keep apart what is theirs. */
static void test_turns(plr_backend first, plr_backend second) {
    plr_context *contexts[2] = {plr_context_create(first, NULL), plr_context_create(second, NULL)};
    plr_gl gl[2];
    GLuint programs[2];
    bool works = true, own = true;
    for (int i = 0; i < 2; i++) {
        works = plr_context_make_current(contexts[i]) && load(&gl[i], contexts[i]) && works;
        for (int j = 0; j <= i; j++) /* so that the names differ */
            programs[i] = triangle_program(&gl[i]);
    }
    for (int turn = 0; turn < 10; turn++) {
        int i = turn & 1;
        const float color[4] = {(float)turn, 1, 2, 3};
        works = plr_context_make_current(contexts[i]) && triangle_works(&gl[i], color) && works;
        own = gl[i].IsProgram(programs[i]) && own;
        own = (i == 1 || !gl[0].IsProgram(programs[1])) && own;
    }
    CHECK(works);
    CHECK(own);
    /* One goes while the other is current; the other goes on. */
    CHECK(plr_context_make_current(contexts[1]));
    plr_context_destroy(&contexts[0]);
    CHECK(triangle_works(&gl[1], red));
    plr_context_destroy(&contexts[1]);
}

/* EGL bound by us, then OSMesa by a host that does not know of it: we recover. */
static void test_careless_host(void) {
    char reason[256];
    plr_context *egl = plr_context_create(PLR_BACKEND_EGL, NULL);
    void *osmesa = plr_context_osmesa.open(NULL, reason, sizeof reason);
    plr_gl gl;
    CHECK(load(&gl, egl));
    CHECK(triangle_works(&gl, red));
    CHECK(osmesa && plr_context_osmesa.make_current(osmesa));
    CHECK(plr_context_make_current(egl));
    CHECK(triangle_works(&gl, unclamped));
    plr_context_osmesa.close(osmesa);
    CHECK(triangle_works(&gl, red));
    plr_context_destroy(&egl);
}

typedef struct job {
    plr_backend backend;
    bool works;
} job;

static void *work(void *user) {
    job *j = user;
    plr_gl gl;
    plr_context *context = plr_context_create(j->backend, NULL);
    j->works = context && load(&gl, context);
    for (int i = 0; i < 20 && j->works; i++) {
        const float color[4] = {(float)i, (float)j->backend, 0, 1};
        j->works = triangle_works(&gl, color);
    }
    plr_context_destroy(&context);
    return NULL;
}

static void test_threads(plr_backend first, plr_backend second) {
    job jobs[4] = {{first, false}, {second, false}, {first, false}, {second, false}};
    pthread_t threads[4];
    for (int i = 0; i < 4; i++)
        pthread_create(&threads[i], NULL, work, &jobs[i]);
    for (int i = 0; i < 4; i++)
        pthread_join(threads[i], NULL);
    CHECK(jobs[0].works && jobs[2].works);
    CHECK(jobs[1].works && jobs[3].works);
}

/* A context moves to another thread. */
static void *draw_there(void *user) {
    plr_context *context = user;
    plr_gl gl;
    bool works =
        plr_context_make_current(context) && load(&gl, context) && triangle_works(&gl, red);
    plr_context_egl.unbind();
    plr_context_osmesa.unbind();
    return works ? context : NULL;
}

static void test_move(plr_backend backend) {
    plr_context *context = plr_context_create(backend, NULL);
    pthread_t thread;
    void *result = NULL;
    plr_context_egl.unbind();
    plr_context_osmesa.unbind();
    pthread_create(&thread, NULL, draw_there, context);
    pthread_join(thread, &result);
    CHECK(result == context);
    plr_context_destroy(&context);
}

static void test_missing(void) {
    const plr_context_libraries none = {"libplugray-no-egl.so", "libplugray-no-osmesa.so"};
    const plr_context_libraries wrong = {"libm.so.6", "libm.so.6"};
    for (int backend = PLR_BACKEND_AUTO; backend <= PLR_BACKEND_OSMESA; backend++) {
        plr_diags *diags = plr_diags_create(NULL);
        CHECK(plr_context_create_with((plr_backend)backend, &none, diags) == NULL);
        CHECK(plr_context_create_with((plr_backend)backend, &wrong, diags) == NULL);
        CHECK_INT(plr_diags_count_of(diags, PLR_ERROR), 2);
        const plr_diag *diag = plr_diags_get(diags, 0);
        CHECK_STR(plr_code_text(diag->code), "no-gl");
        CHECK(!!strstr(diag->message, "no-egl") == (backend != PLR_BACKEND_OSMESA));
        CHECK(!!strstr(diag->message, "no-osmesa") == (backend != PLR_BACKEND_EGL));
        CHECK(strstr(plr_diags_get(diags, 1)->message, "too old") != NULL);
        plr_diags_destroy(&diags);
    }
}

static void *no_loader(void *user, const char *name) {
    return strcmp(name, user) ? (void *)name : NULL;
}

static void test_load(void) {
    plr_gl gl;
    CHECK_STR(plr_gl_load(&gl, no_loader, "glDrawArrays"), "glDrawArrays");
}

int main(void) {
    bool egl = have(PLR_BACKEND_EGL), osmesa = have(PLR_BACKEND_OSMESA);
    test_missing();
    test_load();
    for (int i = 0; i < 2; i++) {
        if (!(i ? osmesa : egl)) {
            TAP_SKIP("a context of one kind", i ? "no OSMesa" : "no EGL");
            continue;
        }
        test_one(backends[i]);
        test_turns(backends[i], backends[i]);
        test_threads(backends[i], backends[i]);
        test_move(backends[i]);
    }
    if (egl && osmesa) {
        test_turns(PLR_BACKEND_EGL, PLR_BACKEND_OSMESA);
        test_turns(PLR_BACKEND_OSMESA, PLR_BACKEND_EGL);
        test_threads(PLR_BACKEND_EGL, PLR_BACKEND_OSMESA);
        test_careless_host();
    } else {
        TAP_SKIP("EGL and OSMesa by turns", "one of them is missing");
    }
    return tap_done();
}
