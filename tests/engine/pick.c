/* What hosts ask of a pixel: through the engine, and of boxes without GL. */
#include "tests/tap.h"

#include "engine/state.h"
#include "engine/view.h"

/* Two boxes, one behind the other; the near one is empty. */
static const char scene_text[] =
    "#X3D V4.0 utf8\nPROFILE Immersive\nNavigationInfo { headlight FALSE }\n"
    "OrthoViewpoint { position 0 0 10 fieldOfView -2 -2 2 2 }\n"
    "DEF Far Transform { rotation 0 1 0 3.14159265 scale 1 1 2 children DEF B VolumeData { "
    "dimensions 2 2 1 voxels PixelTexture3D { image [ 1 1 1 1 255 ] } } }\n"
    "Transform { translation 0 0 3 children DEF N VolumeData { voxels PixelTexture3D { image [ 1 1 "
    "1 1 0 ] } } }\n";

static const plr_draw_desc picture = {.width = 4, .height = 4};

static plr_view *make_view(const char *text, plr_context *context, plr_engine **engine,
                           plr_scene **scene, plr_diags *diags) {
    plr_engine_desc desc = {.get_proc_address = plr_context_get_proc_address, .user = context};
    plr_view_desc view = {.step = 0.01};
    *engine = context ? plr_engine_create(&desc, diags) : NULL;
    *scene = plr_scene_parse(text, strlen(text), "pick.x3dv", NULL, diags);
    return plr_view_create(*engine, *scene, &view, diags);
}

static void check_point(const double point[3], double x, double y, double z, double tolerance) {
    CHECK_NEAR(point[0], x, tolerance);
    CHECK_NEAR(point[1], y, tolerance);
    CHECK_NEAR(point[2], z, tolerance);
}

/* Boxes are met whatever is in them. */
static void check_boxes(const plr_view *view) {
    plr_box_pick pick;
    CHECK(plr_view_pick_box(view, &picture, 2, 1, &pick));
    CHECK_STR(plr_node_def(pick.volume), "N");
    CHECK_INT(pick.volume_index, 1);
    CHECK_NEAR(pick.distance, 6.5, 1e-9);
    check_point(pick.entry, 0.5, 0.5, 3.5, 1e-9);
    check_point(pick.exit, 0.5, 0.5, 2.5, 1e-9);
    CHECK(!plr_view_pick_box(view, &picture, 0, 0, &pick));
    CHECK(pick.volume == NULL);
    CHECK(!plr_view_pick_box(view, &picture, 4, 0, &pick));
    CHECK(!plr_view_pick_box(view, &picture, 0, -1, &pick));
    const plr_draw_desc fine = {.width = 16, .height = 16};
    CHECK(plr_view_pick_box(view, &fine, 4, 8, &pick)); /* x = -.875, y = -.125 */
    CHECK_STR(plr_node_def(pick.volume), "B");
    check_point(pick.entry, -0.875, -0.125, 1, 1e-6);
    check_point(pick.exit, -0.875, -0.125, -1, 1e-6);
}

static void check_voxels(plr_view *view, plr_context *context, plr_diags *diags) {
    plr_gl gl;
    plr_gl_state before, after;
    plr_pick pick;
    CHECK(plr_gl_load(&gl, plr_context_get_proc_address, context) == NULL);
    gl.Viewport(3, 4, 5, 6);
    gl.Enable(GL_SCISSOR_TEST);
    gl.Scissor(0, 0, 0, 0);
    gl.Enable(GL_BLEND);
    gl.DepthMask(GL_FALSE);
    plr_gl_state_save(&gl, &before);
    for (int again = 0; again < 2; again++) { /* the second time from what was kept */
        CHECK(plr_view_pick(view, &picture, 2, 1, &pick, diags));
        CHECK_STR(plr_node_def(pick.volume), "B");
        CHECK_INT(pick.volume_index, 0);
        CHECK(pick.shape == NULL && !pick.has_segment && pick.surface == -1);
        check_point(pick.position, 0.5, 0.5, 1, 0.02);
        CHECK_NEAR(pick.distance, 9, 0.02);
        CHECK_INT(pick.components, 1);
        CHECK_NEAR(pick.value[0], 1, 0);
        CHECK_NEAR(pick.physical[0], 255, 0);
    }
    plr_gl_state_save(&gl, &after);
    CHECK(memcmp(&before, &after, sizeof before) == 0);
    CHECK_INT(gl.GetError(), GL_NO_ERROR);
    CHECK(plr_view_pick(view, &picture, 0, 0, &pick, diags));
    CHECK(pick.volume == NULL && pick.shape == NULL);
    CHECK(!plr_view_pick(view, &picture, 4, 0, &pick, diags));
    CHECK(!plr_view_pick(view, &picture, 0, 4, &pick, diags));
    CHECK(!plr_view_pick(view, &picture, -1, 0, &pick, diags));
}

/* What was picked from may change: other voxels are read. */
static void check_changes(plr_view *view, plr_scene *scene, plr_diags *diags) {
    plr_pick pick;
    static const float range[2] = {0, 510};
    CHECK(plr_node_set(scene, plr_scene_find(scene, "B"), "valueRange", range, 1));
    CHECK(plr_view_update(view, 0, diags));
    CHECK(plr_view_pick(view, &picture, 2, 1, &pick, diags));
    CHECK_NEAR(pick.value[0], 0.5, 1e-6);
    CHECK_NEAR(pick.physical[0], 255, 0);
}

static void run(plr_context *context) {
    plr_diags *diags = plr_diags_create(NULL);
    plr_engine *engine;
    plr_scene *scene;
    plr_view *view = make_view(scene_text, context, &engine, &scene, diags);
    CHECK(view != NULL);
    check_boxes(view);
    plr_pick pick;
    if (context) {
        check_voxels(view, context, diags);
        check_changes(view, scene, diags);
    } else {
        CHECK(!plr_view_pick(view, &picture, 2, 1, &pick, diags));
    }
    CHECK_INT(plr_diags_count(diags), 0);
    plr_view_destroy(&view);
    plr_scene_destroy(&scene);
    if (engine)
        plr_engine_destroy(&engine);
    plr_diags_destroy(&diags);
}

int main(void) {
    run(NULL);
    plr_context *context = plr_context_create(PLR_BACKEND_AUTO, NULL);
    if (!context)
        TAP_SKIP("picking voxels", "there is no GL");
    else
        run(context);
    plr_context_destroy(&context);
    return tap_done();
}
