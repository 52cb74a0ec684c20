/* A view follows what setters and time do to its scene, and keeps what has not changed. */
#include "tests/tap.h"

#include "engine/view.h"

static const char scene_text[] =
    "#X3D V4.0 utf8\nPROFILE Immersive\nNavigationInfo { headlight FALSE }\n"
    "OrthoViewpoint { fieldOfView -1 -1 1 1 }\n"
    "DEF S Switch { whichChoice 0 children [\n"
    "DEF M Transform { children Shape { appearance Appearance {\n"
    "  material DEF U UnlitMaterial { emissiveColor 1 1 1 }\n"
    "  texture DEF P PixelTexture { image 1 1 3 0xff0000 }\n"
    "  effects DEF E Effect { inputOutput SFFloat k 1 parts EffectPart { type \"FRAGMENT\" url "
    "\"data:text/plain,uniform float k; void PLUG_fragment_modify(inout vec4 c) { c.rgb *= k; }\" "
    "} } } geometry Box { size 2 2 2 } } }\n"
    "VolumeData { dimensions 4 4 4 voxels DEF V PixelTexture3D { image [ 1 1 1 1 255 ] } } ] }\n"
    "DEF T TimeSensor { loop TRUE cycleInterval 4 }\n";

typedef struct fixture {
    plr_engine *engine;
    plr_scene *scene;
    plr_view *view;
    plr_diags *diags;
} fixture;

static plr_node *node(const fixture *f, const char *def) {
    return plr_scene_find(f->scene, def);
}

/* The picture's only pixel, after an update. */
static void check_color(fixture *f, const char *what, double r, double g, double b, double a) {
    const double expected[4] = {r, g, b, a};
    plr_draw_desc desc = {1, 1, 1};
    plr_picture picture;
    CHECK(plr_view_update(f->view, 0, f->diags));
    CHECK(plr_view_draw(f->view, &desc, &picture, f->diags));
    bool same = picture.pixels != NULL;
    for (int i = 0; same && i < 4; i++)
        same = fabs((double)picture.pixels[i] - expected[i]) < 1e-4;
    TAP_RESULT(same, "%s", what);
    if (!same && picture.pixels)
        printf("#   it is %g %g %g %g\n", (double)picture.pixels[0], (double)picture.pixels[1],
               (double)picture.pixels[2], (double)picture.pixels[3]);
    plr_picture_free(&picture);
}

static void test_setters(fixture *f) {
    check_color(f, "as in the file", 1, 0, 0, 1);
    const float half[3] = {0.5f, 0.5f, 0.5f}, away[3] = {9, 0, 0}, here[3] = {0, 0, 0};
    const float k = 0.5f;
    plr_node_set(f->scene, node(f, "U"), "emissiveColor", half, 1);
    check_color(f, "a material's colour", 0.5, 0, 0, 1);
    plr_node_set(f->scene, node(f, "E"), "k", &k, 1);
    check_color(f, "a uniform", 0.25, 0, 0, 1);
    const int32_t green[] = {1, 1, 3, 0x00ff00};
    plr_node_set(f->scene, node(f, "P"), "image", green, 4);
    check_color(f, "an image", 0, 0.25, 0, 1);
    plr_node_set(f->scene, node(f, "M"), "translation", away, 1);
    check_color(f, "away", 0, 0, 0, 0);
    plr_node_set(f->scene, node(f, "M"), "translation", here, 1);
    check_color(f, "and back", 0, 0.25, 0, 1);
    plr_node_set_text(f->scene, node(f, "S"), "whichChoice", "1", (plr_place){"set", 1, 1},
                      f->diags);
    check_color(f, "the other child", 1, 1, 1, 1);
    const int32_t gray[] = {1, 1, 1, 1, 51};
    plr_node_set(f->scene, node(f, "V"), "image", gray, 5);
    /* 4 units of length, each with the opacity 0.2 of a voxel's side of 4: one voxel */
    check_color(f, "other voxels", 0.04, 0.04, 0.04, 0.2);
    plr_node_set_text(f->scene, node(f, "S"), "whichChoice", "0", (plr_place){"set", 1, 1},
                      f->diags);
    check_color(f, "the first child again", 0, 0.25, 0, 1);
}

static void test_what_is_kept(fixture *f) {
    size_t programs = plr_view_program_count(f->view);
    const plr_surface *surfaces = f->view->surfaces;
    size_t textures = f->view->textures.list.count;
    const float there[3] = {0.25f, 0, 0};
    plr_node_set(f->scene, node(f, "M"), "translation", there, 1);
    CHECK(plr_view_update(f->view, 0, f->diags));
    CHECK_INT(plr_view_program_count(f->view), programs);
    CHECK_INT(f->view->textures.list.count, textures);
    surfaces = f->view->surfaces;
    CHECK(plr_view_update(f->view, 1.5, f->diags));
    CHECK(f->view->surfaces == surfaces); /* a clock that moves nothing costs nothing */
    CHECK_NEAR(f->view->desc.time, 1.5, 0);
    CHECK_NEAR(plr_node_number(node(f, "T"), "elapsedTime"), 1.5, 0);
    CHECK_INT(plr_diags_count(f->diags), 0);
}

static void run(plr_context *context) {
    fixture f = {.diags = plr_diags_create(NULL)};
    plr_engine_desc desc = {.get_proc_address = plr_context_get_proc_address, .user = context};
    f.engine = plr_engine_create(&desc, f.diags);
    f.scene = plr_scene_parse(scene_text, strlen(scene_text), "update.x3dv", NULL, f.diags);
    f.view = plr_view_create(f.engine, f.scene, NULL, f.diags);
    CHECK(f.view != NULL);
    if (f.view) {
        test_setters(&f);
        test_what_is_kept(&f);
    }
    plr_view_destroy(&f.view);
    plr_scene_destroy(&f.scene);
    plr_engine_destroy(&f.engine);
    plr_diags_destroy(&f.diags);
}

int main(void) {
    plr_context *context = plr_context_create(PLR_BACKEND_AUTO, NULL);
    if (!context)
        TAP_SKIP("a view follows its scene", "there is no GL");
    else
        run(context);
    plr_context_destroy(&context);
    return tap_done();
}
