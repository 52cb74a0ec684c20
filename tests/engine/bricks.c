/* A volume that is cast in bricks is the picture of the whole. */
#include "tests/tap.h"

#include <plugray/engine.h>

enum {
    SIDE = 24, /* of the picture */
    VOXELS = 23
};

static const char head[] =
    "#X3D V4.0 utf8\nPROFILE Immersive\n"
    "NavigationInfo { headlight FALSE }\nDirectionalLight { direction -1 -2 -3 }\n";

static const char *const views[] = {
    "OrthoViewpoint { fieldOfView -1 -1 1 1 }",
    "Viewpoint { position 1.6 1.1 1.9 orientation -0.49 0.86 0.13 0.85 fieldOfView 0.7 }",
    "OrthoViewpoint { position -2 1 -1.5 orientation -0.13 -0.98 -0.16 2.22 fieldOfView -1 -1 1 1 "
    "}",
    "Viewpoint { position 0.1 0.05 0.2 fieldOfView 1.2 }", /* inside */
};

static const char map[] = "OpacityMapVolumeStyle { transferFunction PixelTexture { image 3 1 4 "
                          "0x00000000 0xFF800030 0x80C0FF60 } }";

static const char glass[] = "Shape { appearance Appearance { material UnlitMaterial { "
                            "emissiveColor 0 1 0 transparency .3 } } "
                            "geometry IndexedFaceSet { solid FALSE coordIndex [ 0 1 2 3 ] coord "
                            "Coordinate { point [ -3 -3 0, "
                            "3 -3 0, 3 3 0, -3 3 0 ] } } }";

/* Voxels with slopes everywhere. */
static void print_voxels(char *out, size_t size) {
    size_t used = (size_t)snprintf(out, size, "voxels PixelTexture3D { image [ 1 %d %d %d", VOXELS,
                                   VOXELS - 4, VOXELS + 2);
    for (int z = 0; z < VOXELS + 2; z++)
        for (int y = 0; y < VOXELS - 4; y++)
            for (int x = 0; x < VOXELS; x++)
                used += (size_t)snprintf(out + used, size - used, " %d",
                                         (x * x + 3 * y * z + 7 * x * z) / 9 % 200);
    snprintf(out + used, size - used, " ] }");
}

static bool draw(plr_engine *engine, const char *text, size_t bytes, plr_picture *picture,
                 size_t *messages) {
    plr_diags *diags = plr_diags_create(NULL);
    plr_scene *scene = plr_scene_parse(text, strlen(text), "bricks.x3dv", NULL, diags);
    const plr_view_desc desc = {.max_voxel_bytes = bytes, .step = 0.05};
    plr_view *view = plr_view_create(engine, scene, &desc, diags);
    const plr_draw_desc size = {SIDE, SIDE, 1};
    bool fine = view && plr_view_draw(view, &size, picture, diags);
    *messages = plr_diags_count(diags);
    plr_view_destroy(&view);
    plr_scene_destroy(&scene);
    plr_diags_destroy(&diags);
    return fine;
}

static void compare(plr_engine *engine, const char *name, const char *node, const char *styles,
                    const char *view, double tolerance) {
    static char voxels[1 << 17], text[1 << 18];
    print_voxels(voxels, sizeof voxels);
    snprintf(text, sizeof text, "%s%s\n%s { %s renderStyle [ %s ] }\n", head, view, node, voxels,
             styles);
    plr_picture whole = {0}, bricks = {0};
    size_t messages;
    CHECK(draw(engine, text, 0, &whole, &messages));
    CHECK_INT(messages, 0);
    CHECK(draw(engine, text, 5000, &bricks, &messages));
    CHECK_INT(messages, 0); /* nothing is lost, so nothing is said */
    double worst = 0, most = 0;
    int beyond = 0; /* where a ray grazes a surface, steps elsewhere may miss it */
    for (size_t i = 0; whole.pixels && bricks.pixels && i < (size_t)SIDE * SIDE * 4; i++) {
        worst = fmax(worst, fabs((double)(whole.pixels[i] - bricks.pixels[i])));
        beyond += fabs((double)(whole.pixels[i] - bricks.pixels[i])) > tolerance;
        most = fmax(most, (double)whole.pixels[i]);
    }
    TAP_RESULT(beyond <= 4 && most > 0.1, "%s, %.30s: %d values, %g of %g", name, view, beyond,
               worst, most);
    plr_picture_free(&whole);
    plr_picture_free(&bricks);
}

/* Promises of effects are tried in all bricks, and told once. */
static void trust(plr_engine *engine) {
    static char voxels[1 << 17], text[1 << 18];
    static const char effect[] =
        "Effect { parts EffectPart { type \"FRAGMENT\" url \"data:text/plain, "
        "/* PLUG-PROMISE: colour-only */ void PLUG_volume_shade(inout vec4 color, const in "
        "VolumeSample s) { if (%s) color.a = 0.3; }\" } }";
    static const char *const places[] = {"s.position.x < 0.03", "s.position.y > 0.97", "true",
                                         "s.position.z > 1.0"};
    char effects[2048];
    size_t used = 0;
    for (size_t i = 0; i < sizeof places / sizeof *places; i++)
        used += (size_t)snprintf(effects + used, sizeof effects - used, effect, places[i]);
    print_voxels(voxels, sizeof voxels);
    snprintf(text, sizeof text, "%s%s\nVolumeData { %s renderStyle %s effects [ %s ] }\n", head,
             views[1], voxels, map, effects);
    plr_diags *diags = plr_diags_create(NULL);
    plr_scene *scene = plr_scene_parse(text, strlen(text), "bricks.x3dv", NULL, diags);
    const plr_view_desc desc = {.max_voxel_bytes = 5000, .step = 1};
    plr_view *view = plr_view_create(engine, scene, &desc, diags);
    CHECK_INT(plr_diags_count(diags), 0);
    CHECK(view && plr_view_check_promises(view, diags));
    CHECK_INT(plr_diags_count(diags), 3);
    for (size_t i = 0; i < plr_diags_count(diags); i++)
        CHECK_INT(plr_diags_get(diags, i)->code, PLR_CODE_BROKEN_PROMISE);
    plr_view_destroy(&view);
    view = plr_view_create(NULL, scene, &desc, NULL);
    CHECK(!plr_view_check_promises(view, NULL)); /* there is no GL */
    plr_view_destroy(&view);
    plr_scene_destroy(&scene);
    plr_diags_destroy(&diags);
}

static void run(plr_context *context) {
    plr_diags *diags = plr_diags_create(NULL);
    plr_engine_desc desc = {.get_proc_address = plr_context_get_proc_address, .user = context};
    plr_engine *engine = plr_engine_create(&desc, diags);
    char lit[512];
    snprintf(lit, sizeof lit,
             "ComposedVolumeStyle { renderStyle [ %s ShadedVolumeStyle { lighting TRUE } ] }", map);
    char surfaces[600]; /* a list may be closed and a field begun: it is the end of the node */
    snprintf(surfaces, sizeof surfaces, "%s ] surfaceValues [ 0.2 0.55", lit);
    for (size_t i = 0; i < sizeof views / sizeof *views; i++) {
        compare(engine, "filled", "VolumeData", map, views[i], 2e-3);
        compare(engine, "lit", "VolumeData", lit, views[i], 5e-3);
        compare(engine, "surfaces", "IsoSurfaceVolumeData", surfaces, views[i], 4e-3);
    }
    char with[1200];
    snprintf(with, sizeof with, "%s ] }\nTransform { rotation 1 2 0 0.4 children [ %s", map, glass);
    compare(engine, "glass inside", "VolumeData", with, views[0], 2e-3);
    trust(engine);
    plr_engine_destroy(&engine);
    plr_diags_destroy(&diags);
}

int main(void) {
    plr_context *context = plr_context_create(PLR_BACKEND_AUTO, NULL);
    if (!context)
        TAP_SKIP("volumes in bricks", "there is no GL");
    else
        run(context);
    plr_context_destroy(&context);
    return tap_done();
}
