/* Pilot drawings: when they are made, and that they leave no trace but the steps. */
#include "tests/tap.h"

#include "engine/framebuffer.h"
#include "engine/view.h"

enum {
    SIDE = 40
};

#define HEAD "#X3D V4.0 utf8\nPROFILE Immersive\nNavigationInfo { headlight FALSE }\n"
#define VOLUME                                                                                     \
    "DirectionalLight { direction 0.5 0.2 -1 }\n"                                                  \
    "VolumeData { dimensions 1.6 1.6 1.6 voxels PixelTexture3D { image [ 1 4 4 4 0 40 90 20 60 "   \
    "120 130 70 80 200 180 30 0 20 10 0 10 60 80 0 90 250 220 60 100 255 210 90 20 90 120 30 0 "   \
    "50 70 10 70 190 230 90 60 240 200 80 0 70 90 40 0 10 20 0 30 80 60 10 40 70 110 20 0 30 20 "  \
    "0 ] } renderStyle DEF S ShadedVolumeStyle { lighting TRUE } }\n"

/* The viewer goes to the side while time passes. */
static const char moving_text[] =
    HEAD "DEF V OrthoViewpoint { fieldOfView -1 -1 1 1 }\n" VOLUME
         "DEF T TimeSensor { cycleInterval 1 loop TRUE }\n"
         "DEF P OrientationInterpolator { key [ 0 1 ] keyValue [ 0 1 0 0 0 1 0 0.4 ] }\n"
         "ROUTE T.fraction_changed TO P.set_fraction\n"
         "ROUTE P.value_changed TO V.orientation\n";

/* A mirror of the volume, which is drawn before the picture. */
static const char mirrored_text[] =
    HEAD "OrthoViewpoint { fieldOfView -1 -1 3 1 }\n" VOLUME
         "Transform { translation 2 0 0 children Shape { appearance Appearance {\n"
         "material UnlitMaterial { } texture RenderedTexture { dimensions [ 32 32 4 ]\n"
         "update \"NEXT_FRAME_ONLY\" } } geometry Box { size 1.6 1.6 0.1 } } }\n";

static const plr_draw_desc size = {SIDE, SIDE, 1};

static plr_view *make(plr_engine *engine, plr_scene *scene, bool interactive) {
    const plr_view_desc desc = {.error = 1.0 / 64, .interactive = interactive};
    return plr_view_create(engine, scene, &desc, NULL);
}

static plr_plan plan_of(const plr_view *view) {
    plr_plan plan;
    plr_view_get_plan(view, &plan);
    return plan;
}

static double wall(const plr_view *view) {
    plr_view_stats stats;
    plr_view_get_stats(view, &stats);
    return stats.pilots.wall_ms;
}

static double difference(const plr_picture *a, const plr_picture *b) {
    double most = 0;
    for (size_t i = 0; i < (size_t)SIDE * SIDE * 4; i++)
        most = fmax(most, fabs((double)a->pixels[i] - (double)b->pixels[i]));
    return most;
}

/* The picture of a view that is made for it. */
static void draw_cold(plr_engine *engine, const char *text, double time, plr_picture *picture,
                      plr_plan *plan) {
    plr_scene *scene = plr_scene_parse(text, strlen(text), "test.x3dv", NULL, NULL);
    const plr_view_desc desc = {.error = 1.0 / 64, .time = time};
    plr_view *view = plr_view_create(engine, scene, &desc, NULL);
    CHECK(plr_view_draw(view, &size, picture, NULL));
    *plan = plan_of(view);
    plan->why = NULL;
    plr_view_destroy(&view);
    plr_scene_destroy(&scene);
}

static void test_frames(plr_engine *engine) {
    plr_scene *scene = plr_scene_parse(moving_text, strlen(moving_text), "m.x3dv", NULL, NULL);
    plr_view *view = make(engine, scene, false);
    plr_picture first = {0}, again = {0}, later = {0}, cold = {0};
    plr_plan of_cold;
    CHECK(plan_of(view).step == 0.5 && plan_of(view).value < 0);
    CHECK(plr_view_draw(view, &size, &first, NULL));
    plr_plan plan = plan_of(view);
    double once = wall(view);
    CHECK(once > 0 && !plan.bounded && plan.value > 0 && plan.value <= 1.0 / 64);
    CHECK(plan.step < 0.5 && strstr(plan.why, "pilot drawings"));
    CHECK(plr_view_draw(view, &size, &again, NULL));
    TAP_RESULT(wall(view) == once, "the same frame is measured once");
    CHECK_NEAR(difference(&first, &again), 0, 0);
    CHECK(plr_view_update(view, 0.7, NULL) && plr_view_draw(view, &size, &later, NULL));
    TAP_RESULT(wall(view) != once, "another one anew");
    draw_cold(engine, moving_text, 0.7, &cold, &of_cold);
    CHECK_NEAR(difference(&later, &cold), 0, 0);
    CHECK_NEAR(plan_of(view).value, of_cold.value, 0);
    plr_picture_free(&first);
    plr_picture_free(&again);
    plr_picture_free(&later);
    plr_picture_free(&cold);
    plr_view_destroy(&view);
    plr_scene_destroy(&scene);
}

static void settle(plr_view *view) {
    for (int i = 0; i < 100 && plr_view_build(view, 1e4); i++)
        ;
}

static void test_interactive(plr_engine *engine) {
    plr_scene *scene = plr_scene_parse(moving_text, strlen(moving_text), "m.x3dv", NULL, NULL);
    plr_view *view = make(engine, scene, true);
    plr_picture picture = {0}, cold = {0};
    plr_plan of_cold, plan;
    CHECK(plr_view_draw(view, &size, &picture, NULL));
    TAP_RESULT(wall(view) == 0 && plan_of(view).step == 0.5 && plan_of(view).value < 0,
               "no frame waits for pilots");
    plr_picture_free(&picture);
    settle(view);
    plan = plan_of(view);
    double once = wall(view);
    TAP_RESULT(once > 0 && plan.value > 0 && plan.step < 0.5, "they are made between frames");
    CHECK(plr_view_update(view, 0.7, NULL) && plr_view_draw(view, &size, &picture, NULL));
    plr_picture_free(&picture);
    TAP_RESULT(wall(view) == once && plan_of(view).step == plan.step, "steps stay while he moves");
    plr_node_set_text(scene, plr_scene_find(scene, "S"), "shininess", "0.7", (plr_place){0}, NULL);
    CHECK(plr_view_update(view, 0.7, NULL) && plr_view_draw(view, &size, &picture, NULL));
    plr_picture_free(&picture);
    TAP_RESULT(wall(view) == once && plan_of(view).step == plan.step, "and after an edit");
    plr_node_set_text(scene, plr_scene_find(scene, "S"), "shininess", "0.2", (plr_place){0}, NULL);
    CHECK(plr_view_update(view, 0.7, NULL) && plr_view_draw(view, &size, &picture, NULL));
    plr_picture_free(&picture);
    settle(view);
    TAP_RESULT(wall(view) != once, "where he stands still they are made anew");
    CHECK(plr_view_draw(view, &size, &picture, NULL));
    draw_cold(engine, moving_text, 0.7, &cold, &of_cold);
    CHECK_NEAR(plan_of(view).value, of_cold.value, 0);
    CHECK_NEAR(difference(&picture, &cold), 0, 0);
    plr_picture_free(&picture);
    plr_picture_free(&cold);
    plr_view_destroy(&view);
    plr_scene_destroy(&scene);
}

/* What is drawn once, before anything was measured, is drawn again. */
static void test_mirror(plr_engine *engine) {
    plr_scene *scene = plr_scene_parse(mirrored_text, strlen(mirrored_text), "m", NULL, NULL);
    plr_view *view = make(engine, scene, false);
    plr_picture first = {0}, again = {0};
    const plr_draw_desc wide = {2 * SIDE, SIDE, 1};
    CHECK(plr_view_draw(view, &wide, &first, NULL));
    CHECK(plan_of(view).step < 0.5);
    plr_scene *other = plr_scene_parse(mirrored_text, strlen(mirrored_text), "m", NULL, NULL);
    const plr_view_desc fixed = {.step = plan_of(view).step, .method = plan_of(view).method};
    plr_view *by_step = plr_view_create(engine, other, &fixed, NULL);
    CHECK(plr_view_draw(by_step, &wide, &again, NULL));
    double most = 0; /* rays end early at an eighth of the error each */
    for (size_t i = 0; i < (size_t)SIDE * SIDE * 8; i++)
        most = fmax(most, fabs((double)first.pixels[i] - (double)again.pixels[i]));
    CHECK_NEAR(most, 0, 1.0 / 64 / 8);
    plr_picture_free(&first);
    plr_picture_free(&again);
    plr_view_destroy(&by_step);
    plr_view_destroy(&view);
    plr_scene_destroy(&other);
    plr_scene_destroy(&scene);
}

/* In a host's framebuffer, with its camera: the viewpoint's, here. */
static void test_host(plr_engine *engine, plr_context *context) {
    plr_scene *scene = plr_scene_parse(moving_text, strlen(moving_text), "m.x3dv", NULL, NULL);
    plr_view *view = make(engine, scene, false);
    plr_gl gl;
    plr_framebuffer framebuffer;
    plr_picture cold = {0}, here = {SIDE, SIDE, NULL};
    plr_plan of_cold;
    CHECK(plr_gl_load(&gl, plr_context_get_proc_address, context) == NULL);
    CHECK(plr_framebuffer_create(&framebuffer, &gl, SIDE, SIDE, NULL));
    plr_framebuffer_bind(&framebuffer);
    gl.ClearColor(0, 0, 0, 0);
    gl.ClearDepth(1);
    gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    CHECK(plr_view_draw_here(view, NULL, NULL, NULL));
    GLint bound = 0, viewport[4];
    gl.GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
    gl.GetIntegerv(GL_VIEWPORT, viewport);
    CHECK((GLuint)bound == framebuffer.name && viewport[2] == SIDE && viewport[3] == SIDE);
    draw_cold(engine, moving_text, 0, &cold, &of_cold);
    CHECK_NEAR(plan_of(view).value, of_cold.value, 1e-6);
    CHECK_NEAR(plan_of(view).step, of_cold.step, 0);
    here.pixels = calloc((size_t)SIDE * SIDE * 4, sizeof(float));
    CHECK(here.pixels && plr_framebuffer_read(&framebuffer, here.pixels));
    CHECK_NEAR(difference(&here, &cold), 0, 1e-6);
    free(here.pixels);
    plr_picture_free(&cold);
    plr_framebuffer_destroy(&framebuffer);
    plr_view_destroy(&view);
    plr_scene_destroy(&scene);
}

int main(void) {
    static const plr_backend backends[] = {PLR_BACKEND_EGL, PLR_BACKEND_OSMESA};
    for (size_t b = 0; b < 2; b++) {
        plr_context *context = plr_context_create(backends[b], NULL);
        if (!context) {
            TAP_SKIP("pilot drawings", "there is no such context");
            continue;
        }
        plr_engine_desc desc = {.get_proc_address = plr_context_get_proc_address, .user = context};
        plr_engine *engine = plr_engine_create(&desc, NULL);
        test_frames(engine);
        test_interactive(engine);
        test_mirror(engine);
        test_host(engine, context);
        plr_engine_destroy(&engine);
        plr_context_destroy(&context);
    }
    return tap_done();
}
