/* Programs that another thread builds, in a context that shares with ours, and that ours draws. */
#include "tests/tap.h"

#include "engine/builder.h"
#include "engine/cache.h"
#include "tests/engine/triangle.h"

typedef bool (*sharing)(void *user, bool current);

static const char *const good[PLR_STAGE_COUNT] = {
    [PLR_VERTEX] = triangle_vertex,
    [PLR_FRAGMENT] = triangle_fragment,
};
static const char *const bad[PLR_STAGE_COUNT] = {
    [PLR_VERTEX] = triangle_vertex,
    [PLR_FRAGMENT] = "#version 330 core\nout vec4 result;\nvoid main() { result = nothing; }\n",
};

/* Whether the program draws the triangle in a colour, in the context that is current. */
static bool draws(const plr_gl *gl, GLuint program) {
    static const float color[4] = {0.25f, 0.5f, 0.75f, 1};
    float pixels[TRIANGLE_SIZE * TRIANGLE_SIZE * 4] = {0};
    plr_framebuffer framebuffer;
    if (!plr_framebuffer_create(&framebuffer, gl, TRIANGLE_SIZE, TRIANGLE_SIZE, NULL))
        return false;
    plr_framebuffer_bind(&framebuffer);
    triangle_draw(gl, program, color);
    bool read = plr_framebuffer_read(&framebuffer, pixels);
    plr_framebuffer_destroy(&framebuffer);
    return read && triangle_is(pixels, color);
}

static void test_building(const plr_gl *gl, plr_builder *builder, plr_cache *cache) {
    GLuint program = 0, none = 7;
    CHECK(plr_builder_ask(builder, good, &program) == PLR_BUILDING_WAITS);
    for (int i = 0; i < 2; i++) /* asked again, it is the same */
        plr_builder_ask(builder, bad, &none);
    for (int i = 0; i < 3 && plr_builder_wait(builder, 1e4) > 0; i++)
        ;
    CHECK_INT(plr_builder_wait(builder, 0), 0);
    CHECK(plr_builder_ask(builder, good, &program) == PLR_BUILDING_DONE);
    CHECK(program != 0 && draws(gl, program));
    CHECK(plr_builder_ask(builder, bad, &none) == PLR_BUILDING_FAILED);
    CHECK_INT(none, 0);
    /* the caller has it now: the same texts are built anew */
    GLuint other = 0;
    CHECK(plr_builder_ask(builder, good, &other) == PLR_BUILDING_WAITS);
    CHECK(plr_cache_find(cache, good) == 0);
    CHECK(plr_cache_adopt(cache, good, program) == program);
    CHECK(plr_cache_find(cache, good) == program);
    CHECK_INT(plr_cache_get_stats(cache).compiled, 0);
}

static void run(plr_context *context, sharing share) {
    plr_gl gl;
    CHECK(plr_gl_load(&gl, plr_context_get_proc_address, context) == NULL);
    plr_builder *builder = plr_builder_create(&gl, share, context);
    CHECK(builder != NULL);
    plr_cache *cache = plr_cache_create(&gl, NULL);
    if (builder)
        test_building(&gl, builder, cache);
    plr_builder_destroy(&builder); /* first: see there */
    plr_cache_destroy(&cache);
    CHECK(gl.GetError() == GL_NO_ERROR);
}

/* A host that promises a context and has none. */
static bool share_nothing(void *user, bool current) {
    (void)user;
    return !current;
}

int main(void) {
    static const plr_backend backends[] = {PLR_BACKEND_EGL, PLR_BACKEND_OSMESA};
    static const sharing ways[] = {plr_context_make_shared_current, NULL, share_nothing};
    for (int i = 0; i < 2; i++) {
        plr_context *context = plr_context_create(backends[i], NULL);
        if (!context)
            TAP_SKIP("programs built beside", "there is no such context");
        for (size_t way = 0; context && way < sizeof ways / sizeof *ways; way++) {
            printf("# %s, way %zu\n", plr_context_description(context), way);
            run(context, ways[way]);
        }
        plr_context_destroy(&context);
    }
    return tap_done();
}
