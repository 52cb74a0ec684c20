/* Rays are cast where something can be seen of volumes, and nowhere else. */
#include "tests/tap.h"

#include <stdio.h>

#include "engine/frame.h"
#include "engine/volume_hull.h"
#include "engine/volume_pass.h"

enum {
    LONG = 64, /* voxels */
    SIDE = 100
};

#define HEAD "#X3D V4.0 utf8\nPROFILE Immersive\nNavigationInfo { headlight FALSE }\n"

/* A bar of voxels from -2 to 2, of which `bright` are not 0, from the left. */
static void write_bar(char *text, size_t size, int bright, const char *camera, const char *effect) {
    int used = snprintf(text, size,
                        HEAD "%s\nVolumeData { dimensions 4 1 1 voxels PixelTexture3D {\n"
                             "image [ 1 %d 2 2",
                        camera, LONG);
    for (int i = 0; i < 4 * LONG; i++)
        used += snprintf(text + used, size - (size_t)used, " %d", i % LONG < bright ? 99 : 0);
    snprintf(text + used, size - (size_t)used, " ] } %s }\n", effect);
}

/* What a picture is drawn in, in clip coordinates: from left to right; false if it is nothing. */
static bool find_sides(plr_engine *engine, const char *text, const plr_view_desc *desc,
                       double sides[2]) {
    plr_scene *scene = plr_scene_parse(text, strlen(text), "test.x3dv", NULL, NULL);
    plr_view *view = plr_view_create(engine, scene, desc, NULL);
    const plr_cast *cast = &view->volumes.casts[0];
    plr_frame frame;
    plr_hull hull;
    CHECK(view->volumes.cast_count == 1);
    plr_frame_plan(view, view->viewpoint, SIDE, SIDE, false, &frame);
    plr_volume_hull(view->volumes.volumes, cast->members, cast->everywhere ? 0 : cast->count,
                    &frame, &hull);
    sides[0] = INFINITY;
    sides[1] = -INFINITY;
    for (int i = 0; i < hull.count; i++) {
        sides[0] = fmin(sides[0], (double)hull.points[i][0]);
        sides[1] = fmax(sides[1], (double)hull.points[i][0]);
    }
    plr_view_destroy(&view);
    plr_scene_destroy(&scene);
    return hull.count > 0;
}

#define FRONT "OrthoViewpoint { fieldOfView -2 -2 2 2 }"
#define PIXEL (2.0 / SIDE)

static const struct {
    const char *name, *camera, *effect;
    plr_view_desc desc;
    int bright;
    bool drawn;
    double sides[2], slack;
} cases[] = {
    {"a bar that is bright", FRONT, "", {.error = 0}, LONG, true, {-1, 1}, 0},
    /* voxels are 2 / LONG long, blocks 2 of them; values reach to the next voxel */
    {"a bright end", FRONT, "", {.error = 0}, 8, true, {-1, -0.75}, 4.0 / LONG},
    {"in steps", FRONT, "", {.step = 0.5}, 8, true, {-1, -0.75}, 4.0 / LONG},
    {"in segments",
     FRONT,
     "",
     {.step = 0.5, .method = PLR_METHOD_PREINTEGRATED},
     8,
     true,
     {-1, -0.75},
     4.0 / LONG},
    {"all samples are looked at", FRONT, "", {.no_leaping = true}, 8, true, {-1, 1}, 0},
    {"nothing can be seen", FRONT, "", {.error = 0}, 0, false, {0, 0}, 0},
    {"cropped", FRONT, "cropMin 0.05 0 0", {.error = 0}, 8, true, {-0.9, -0.75}, 4.0 / LONG},
    {"an effect sees what is clear",
     FRONT,
     "effects Effect { language \"GLSL\" parts EffectPart { type \"FRAGMENT\" url "
     "\"data:text/plain,void PLUG_volume_classify(inout vec4 c, const in VolumeSample s) { c.a = "
     "0.5; "
     "}\" } }",
     {.error = 0},
     8,
     true,
     {-1, 1},
     0},
    {"from within", "Viewpoint { position -1.9 0 0 }", "", {.error = 0}, 8, true, {-1, 1}, 0},
};

static void test_all(plr_engine *engine) {
    static char text[1 << 14];
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        double sides[2];
        write_bar(text, sizeof text, cases[i].bright, cases[i].camera, cases[i].effect);
        bool drawn = find_sides(engine, text, &cases[i].desc, sides);
        bool right = drawn == cases[i].drawn;
        if (drawn && right)
            right = sides[0] >= cases[i].sides[0] - 1.01 * PIXEL &&
                    sides[0] <= cases[i].sides[0] + 0.01 && sides[1] >= cases[i].sides[1] - 0.01 &&
                    sides[1] <= cases[i].sides[1] + cases[i].slack + 1.01 * PIXEL;
        TAP_RESULT(right, "%s: from %g to %g", cases[i].name, sides[0], sides[1]);
    }
}

int main(void) {
    static const plr_backend backends[] = {PLR_BACKEND_EGL, PLR_BACKEND_OSMESA};
    plr_context *context = NULL;
    for (size_t b = 0; b < 2 && !context; b++)
        context = plr_context_create(backends[b], NULL);
    if (!context) {
        TAP_SKIP("outlines", "there is no context");
        return tap_done();
    }
    plr_engine_desc desc = {.get_proc_address = plr_context_get_proc_address, .user = context};
    plr_engine *engine = plr_engine_create(&desc, NULL);
    test_all(engine);
    plr_engine_destroy(&engine);
    plr_context_destroy(&context);
    return tap_done();
}
