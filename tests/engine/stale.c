/* After an edit the next picture is the one that a new view draws: nothing of blocks, tables or
 * surfaces is left from before. */
#include "tests/tap.h"

#include "engine/view.h"

enum {
    SIDE = 24,
    VOXELS = 12
};

static const char scene_text[] =
    "#X3D V4.0 utf8\nPROFILE Immersive\nNavigationInfo { headlight FALSE }\n"
    "OrthoViewpoint { fieldOfView -.8 -.8 .8 .8 }\n"
    "Transform { rotation 1 2 3 .7 children [\n"
    "DEF F VolumeData { voxels DEF V PixelTexture3D { } renderStyle\n"
    "  ComposedVolumeStyle { renderStyle [\n"
    "    OpacityMapVolumeStyle { transferFunction DEF P PixelTexture { image 4 1 4 0 0 0xFF0000FF "
    "0 } }\n"
    "    DEF M OpacityMapVolumeStyle { enabled FALSE transferFunction\n"
    "      PixelTexture { image 1 1 4 0x00FF0040 } } ] } }\n"
    "DEF I IsoSurfaceVolumeData { surfaceValues [ .9 ] voxels USE V } ] }\n";

/* Tables, blocks and cells with labels. */
static const char segments_text[] =
    "#X3D V4.0 utf8\nPROFILE Immersive\nNavigationInfo { headlight FALSE }\n"
    "OrthoViewpoint { fieldOfView -.8 -.8 .8 .8 }\n"
    "Transform { rotation 1 2 3 .7 children DEF F SegmentedVolumeData {\n"
    "voxels DEF V PixelTexture3D { } segmentIdentifiers DEF L PixelTexture3D { } renderStyle [\n"
    "  OpacityMapVolumeStyle { transferFunction DEF P PixelTexture { image 4 1 4 0 0 0xFF000080 "
    "0 } }\n"
    "  DEF M OpacityMapVolumeStyle { transferFunction PixelTexture { image 3 1 4 0 0x00FF0040 "
    "0x00FFFFFF } } ] } }\n";

typedef struct fixture {
    plr_engine *engine;
    plr_scene *scene;
    plr_view *view;
    plr_view_desc desc;
    plr_diags *diags;
    plr_picture before;
} fixture;

static plr_node *node(const fixture *f, const char *def) {
    return plr_scene_find(f->scene, def);
}

/* Almost everything is 0; `value` is in one voxel. */
static void set_image(const fixture *f, const char *def, int at, int32_t value) {
    static int32_t image[4 + VOXELS * VOXELS * VOXELS];
    memset(image, 0, sizeof image);
    image[0] = 1;
    image[1] = image[2] = image[3] = VOXELS;
    image[4 + at + VOXELS * (at + VOXELS * at)] = value;
    plr_node_set(f->scene, node(f, def), "image", image, sizeof image / sizeof *image);
}

static void set_voxels(const fixture *f, int at, int32_t value) {
    set_image(f, "V", at, value);
}

static bool draw(plr_view *view, plr_picture *picture, plr_diags *diags) {
    plr_draw_desc desc = {SIDE, SIDE, 1};
    return plr_view_draw(view, &desc, picture, diags);
}

static bool same(const plr_picture *a, const plr_picture *b) {
    return memcmp(a->pixels, b->pixels, sizeof *a->pixels * 4 * SIDE * SIDE) == 0;
}

/* The edited view draws what a new one does, and something else than before. */
static void check_edit(fixture *f, const char *what) {
    plr_picture edited = {0}, fresh = {0};
    plr_view *view = plr_view_create(f->engine, f->scene, &f->desc, f->diags);
    bool drawn = view && plr_view_update(f->view, 0, f->diags) &&
                 draw(f->view, &edited, f->diags) && draw(view, &fresh, f->diags);
    CHECK(drawn);
    if (!drawn)
        return;
    TAP_RESULT(same(&edited, &fresh), "%s: as a new view draws it", what);
    TAP_RESULT(!same(&edited, &f->before), "%s: it can be seen", what);
    plr_picture_free(&f->before);
    plr_picture_free(&fresh);
    f->before = edited;
    plr_view_destroy(&view);
}

static void test_edits(fixture *f) {
    const int32_t function[] = {4, 1, 4, 0, 0x00FF0020, 0, 0x0000FFFF};
    const bool on = true, off = false;
    const float value = 0.4f, distance = 3;
    const float crop[3] = {0.8f, 0.4f, 0.45f};
    set_voxels(f, 3, 180);
    check_edit(f, "a voxel");
    set_voxels(f, 8, 200);
    check_edit(f, "another voxel, where blocks were empty");
    plr_node_set(f->scene, node(f, "P"), "image", function, 7);
    check_edit(f, "a transfer function that shows other values");
    plr_node_set(f->scene, node(f, "M"), "enabled", &on, 1);
    check_edit(f, "a style that makes opaque what was clear");
    plr_node_set(f->scene, node(f, "M"), "enabled", &off, 1);
    check_edit(f, "and back");
    plr_node_set(f->scene, node(f, "I"), "surfaceValues", &value, 1);
    check_edit(f, "a surface");
    plr_node_set(f->scene, node(f, "F"), "opacityUnitDistance", &distance, 1);
    check_edit(f, "a reference length");
    plr_node_set(f->scene, node(f, "F"), "cropMin", crop, 1);
    check_edit(f, "a crop box");
}

static void test_labels(fixture *f) {
    const int32_t function[] = {4, 1, 4, 0, 0x00FF0020, 0, 0x0000FFFF};
    const bool on[] = {true, true}, off[] = {false, true}, second[] = {true, false};
    plr_plan plan;
    plr_view_get_plan(f->view, &plan);
    CHECK(plan.method == f->desc.method && plan.bounded);
    set_voxels(f, 3, 180);
    check_edit(f, "a voxel");
    set_image(f, "L", 3, 1);
    check_edit(f, "its label");
    plr_node_set(f->scene, node(f, "F"), "segmentEnabled", second, 2);
    check_edit(f, "its segment off");
    plr_node_set(f->scene, node(f, "F"), "segmentEnabled", off, 2);
    check_edit(f, "the other one off");
    set_image(f, "L", 3, 0);
    plr_node_set(f->scene, node(f, "F"), "segmentEnabled", on, 2);
    plr_node_set(f->scene, node(f, "P"), "image", function, 7);
    check_edit(f, "labels, switches, a function");
    set_image(f, "L", 3, 2);
    check_edit(f, "a label without a style");
}

static void run(plr_context *context, const char *text, plr_view_desc view_desc) {
    fixture f = {.diags = plr_diags_create(NULL), .desc = view_desc};
    plr_engine_desc desc = {.get_proc_address = plr_context_get_proc_address, .user = context};
    f.engine = plr_engine_create(&desc, f.diags);
    f.scene = plr_scene_parse(text, strlen(text), "stale.x3dv", NULL, f.diags);
    set_voxels(&f, 5, 180);
    f.view = plr_view_create(f.engine, f.scene, &f.desc, f.diags);
    bool drawn = f.view && draw(f.view, &f.before, f.diags);
    CHECK(drawn);
    if (drawn)
        (text == scene_text ? test_edits : test_labels)(&f);
    plr_picture_free(&f.before);
    plr_view_destroy(&f.view);
    plr_scene_destroy(&f.scene);
    plr_engine_destroy(&f.engine);
    plr_diags_destroy(&f.diags);
}

int main(void) {
    plr_context *context = plr_context_create(PLR_BACKEND_AUTO, NULL);
    if (!context) {
        TAP_SKIP("edits leave nothing behind", "there is no GL");
    } else {
        run(context, scene_text, (plr_view_desc){.step = 0.5});
        run(context, scene_text, (plr_view_desc){.step = 0.5, .method = PLR_METHOD_PREINTEGRATED});
        run(context, scene_text, (plr_view_desc){.step = 0.5, .method = PLR_METHOD_CELLS});
        run(context, scene_text, (plr_view_desc){.error = 1.0 / 255});
        run(context, segments_text, (plr_view_desc){.method = PLR_METHOD_CELLS});
    }
    plr_context_destroy(&context);
    return tap_done();
}
