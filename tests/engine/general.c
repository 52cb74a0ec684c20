/* No frame waits for a compiler: what an edit switches on or off is drawn at once by general
 * programs, as the specialised ones draw it, which take over when they are built. */
#include "tests/tap.h"

#include "engine/view.h"

#define MAP                                                                                        \
    "OpacityMapVolumeStyle { transferFunction DEF P PixelTexture { "                               \
    "image 2 1 4 0xff802000 0x20ff60c0 } }\n"
#define VOXELS                                                                                     \
    "voxels PixelTexture3D { image [ 1 4 4 4 0 40 90 20 60 120 130 70 80 200 180 30 0 20 10 0 "    \
    "10 60 80 0 90 250 220 60 100 255 210 90 20 90 120 30 "                                        \
    "0 50 70 10 70 190 230 90 60 240 200 80 0 70 90 40 "                                           \
    "0 10 20 0 30 80 60 10 40 70 110 20 0 30 20 0 ] } "
/* In quarters: 0, 1, 2, 3. */
#define LABELS                                                                                     \
    "segmentIdentifiers PixelTexture3D { image [ 1 4 4 4 "                                         \
    "0 0 1 1 0 0 1 1 2 2 3 3 2 2 3 3 0 0 1 1 0 0 1 1 2 2 3 3 2 2 3 3 "                             \
    "0 0 1 1 0 0 1 1 2 2 3 3 2 2 3 3 0 0 1 1 0 0 1 1 2 2 3 3 2 2 3 3 ] } "
#define HEAD                                                                                       \
    "#X3D V4.0 utf8\nPROFILE Immersive\nDEF N NavigationInfo { headlight FALSE }\n"                \
    "OrthoViewpoint { fieldOfView -1 -1 1 1 }\n"

typedef struct edit {
    const char *name, *def, *field, *value;
} edit;

enum {
    MOST_EDITS = 14,
    SIDE = 24
};

typedef struct example {
    const char *name, *text;
    edit edits[MOST_EDITS];
    plr_method method;
    bool by_error; /* the planner decides on steps: each program keeps to 1/255 */
} example;

static const char lights_text[] =
    HEAD "DEF G Switch { children PointLight { location -1 -1 2 color 0.2 0.2 1 } }\n"
         "DEF D DirectionalLight { direction 1 -0.4 -1 intensity 0.8 ambientIntensity 0.1 }\n"
         "DEF P PointLight { on FALSE location 1 1 2 color 0.3 0.9 0.5 ambientIntensity 0.3 }\n"
         "DEF S SpotLight { location 0 0 3 direction 0 0 -1 on FALSE color 1 0.5 0.2 }\n"
         "VolumeData { dimensions 1.6 1.6 1.6 " VOXELS
         "renderStyle DEF C ComposedVolumeStyle { renderStyle [ DEF M " MAP
         "DEF E EdgeEnhancementVolumeStyle { enabled FALSE edgeColor 1 0 0 1 }\n"
         "DEF SH ShadedVolumeStyle { lighting TRUE } ] } }\n";

static const char planes_text[] = HEAD
    "DEF A ClipPlane { plane 1 0 0 0.1 enabled FALSE }\n"
    "DEF O Switch { whichChoice 0 children [\n"
    "Group { children DEF V VolumeData { dimensions 1.6 1.6 1.6 " VOXELS "renderStyle " MAP "} }\n"
    "Group { children [ ClipPlane { plane 0 0 -1 0.1 } USE V ] } ] }\n"
    "Transform { translation 0.3 0.2 0.1 children VolumeData { dimensions 0.8 0.8 0.8 " VOXELS
    "clipPlanes DEF B ClipPlane { plane 0 1 0 0.2 }\n"
    "renderStyle DEF M OpacityMapVolumeStyle {\n"
    "transferFunction PixelTexture { image 2 1 4 0x00ff0000 0x2020ffff } } } }\n"
    "Shape { appearance Appearance { material Material { } } geometry Box { size .5 .5 .5 } }\n";

static const char segments_text[] = HEAD
    "DirectionalLight { direction 0.5 0 -1 }\n"
    "DEF V SegmentedVolumeData { dimensions 1.6 1.6 1.6 " VOXELS LABELS
    "segmentEnabled [ TRUE TRUE FALSE ] effects Effect { parts EffectPart { type \"FRAGMENT\"\n"
    "url \"data:text/plain,void PLUG_volume_shade(inout vec4 c, const in VolumeSample s) {"
    " c.g *= 0.5; }\" } }\n"
    "renderStyle [ CartoonVolumeStyle { } DEF SH ShadedVolumeStyle { lighting TRUE } ] }\n";

/* Opacity maps alone: each segment has its own rows in the tables. */
static const char functions_text[] =
    HEAD "DEF V SegmentedVolumeData { dimensions 1.6 1.6 1.6 " VOXELS LABELS
         "segmentEnabled [ TRUE TRUE FALSE ] renderStyle [ DEF A " MAP
         "DEF B OpacityMapVolumeStyle { transferFunction PixelTexture {\n"
         "image 3 1 4 0x00ff0000 0xff2020c0 0x2020ff80 } }\n"
         "ComposedVolumeStyle { renderStyle [ OpacityMapVolumeStyle { transferFunction USE P }\n"
         "DEF F BoundaryEnhancementVolumeStyle { boundaryOpacity 0 retainedOpacity 0.5 } ] }\n"
         "USE A ] }\n";

static const char surfaces_text[] =
    HEAD "DirectionalLight { direction 0.5 0 -1 }\n"
         "DEF V IsoSurfaceVolumeData { dimensions 1.6 1.6 1.6 " VOXELS "surfaceValues [ 0.3 0.6 ]\n"
         "renderStyle [ DEF C CartoonVolumeStyle {\n"
         "orthogonalColor 1 0 0 0.5 parallelColor 0 1 0 0.5 }\n"
         "DEF SH ShadedVolumeStyle { lighting TRUE enabled FALSE } ] }\n";

static const char shadows_text[] = HEAD
    "DirectionalLight { direction 1 0 -1 }\n"
    "VolumeData { dimensions 1.6 1.6 1.6 " VOXELS "renderStyle ComposedVolumeStyle {\n"
    "renderStyle [ " MAP "DEF SH ShadedVolumeStyle { lighting TRUE shadows TRUE }\n"
    "DEF B BlendedVolumeStyle { enabled FALSE " VOXELS
    "renderStyle DEF I SilhouetteEnhancementVolumeStyle { silhouetteBoundaryOpacity 1 } } ] } }\n";

static const char tables_text[] =
    HEAD "DEF T TransferFunction { key [ 0 0.5 1 ] keyValue [ 0 0 0 0, 1 0 0 0.3, 0 1 1 0.8 ] }\n"
         "DEF V VolumeData { dimensions 1.6 1.6 1.6 " VOXELS
         "renderStyle DEF C ComposedVolumeStyle { renderStyle [ DEF A " MAP
         "DEF B OpacityMapVolumeStyle { enabled FALSE transferFunction USE T } ] } }\n";

#define TABLE_EDITS                                                                                \
    {                                                                                              \
        {"a map on", "B", "enabled", "TRUE"}, {"knots", "T", "key", "0 0.3 1"},                    \
            {"their colours", "T", "keyValue", "0 0 0 0 0 1 0 0.4 1 0 1 0.9"},                     \
            {"the map off", "B", "enabled", "FALSE"},                                              \
            {"texels", "P", "image", "2 1 4 0x00ff0010 0xff0000ff"},                               \
            {"the unit of opacity", "V", "opacityUnitDistance", "0.8"},                            \
            {"the range of values", "V", "valueRange", "20 200"},                                  \
            {"the other map off: nothing is drawn", "A", "enabled", "FALSE"}, {                    \
            "a map on again", "B", "enabled", "TRUE"                                               \
        }                                                                                          \
    }

static const example examples[] = {
    {.name = "surfaces",
     .text = surfaces_text,
     .edits = {{"the style of a surface on", "SH", "enabled", "TRUE"},
               {"values of surfaces", "V", "surfaceValues", "0.2 0.7"},
               {"the other style off", "C", "enabled", "FALSE"}}},
    {.name = "lights",
     .text = lights_text,
     .edits = {{"a light is switched on", "P", "on", "TRUE"},
               {"another one, too", "S", "on", "TRUE"},
               {"the first is switched off", "D", "on", "FALSE"},
               {"its intensity", "P", "intensity", "0.5"},
               {"a style is switched on", "E", "enabled", "TRUE"},
               {"lighting off", "SH", "lighting", "FALSE"},
               {"lighting on", "SH", "lighting", "TRUE"},
               {"the headlight", "N", "headlight", "TRUE"},
               {"shading off", "SH", "enabled", "FALSE"},
               {"shading on", "SH", "enabled", "TRUE"},
               {"a light that was not there", "G", "whichChoice", "0"},
               {"all styles off: nothing is drawn", "C", "enabled", "FALSE"},
               {"and on", "C", "enabled", "TRUE"}}},
    {.name = "planes",
     .text = planes_text,
     .edits = {{"a plane is switched on", "A", "enabled", "TRUE"},
               {"the volume's own one is switched off", "B", "enabled", "FALSE"},
               {"a plane that was not there", "O", "whichChoice", "1"},
               {"a plane moves", "A", "plane", "1 0 0 -0.1"},
               {"the one volume is hidden", "M", "enabled", "FALSE"},
               {"the headlight on volumes and shapes", "N", "headlight", "TRUE"},
               {"the volume is there again", "M", "enabled", "TRUE"}}},
    {.name = "segments",
     .text = segments_text,
     .edits = {{"a segment is switched on", "V", "segmentEnabled", "TRUE TRUE TRUE"},
               {"another one off", "V", "segmentEnabled", "FALSE TRUE TRUE"},
               {"the style of a segment off", "SH", "enabled", "FALSE"},
               {"more switches than before", "V", "segmentEnabled", "TRUE TRUE TRUE FALSE"},
               {"and on", "SH", "enabled", "TRUE"}}},
    {.name = "functions of segments",
     .text = functions_text,
     .edits = {{"a segment is switched on", "V", "segmentEnabled", "TRUE TRUE TRUE"},
               {"another one off", "V", "segmentEnabled", "FALSE TRUE TRUE"},
               {"the factor of one", "F", "retainedOpacity", "0.9"},
               {"the texels of one", "P", "image", "2 1 4 0x00ff0010 0xff0000ff"},
               {"the style of a segment off", "B", "enabled", "FALSE"},
               {"more switches than before", "V", "segmentEnabled", "TRUE TRUE TRUE FALSE"},
               {"and on", "B", "enabled", "TRUE"}},
     .method = PLR_METHOD_CELLS},
    {.name = "shadows and blending",
     .text = shadows_text,
     .edits = {{"blending on", "B", "enabled", "TRUE"},
               {"the style inside off", "I", "enabled", "FALSE"},
               {"shadows off with their style", "SH", "enabled", "FALSE"},
               {"the style inside on", "I", "enabled", "TRUE"},
               {"shadows on", "SH", "enabled", "TRUE"}}},
    {.name = "transfer functions",
     .text = tables_text,
     .edits = {{"a map on", "B", "enabled", "TRUE"}, {"knots", "T", "key", "0 0.3 1"}}},
    {.name = "integrals of them",
     .text = tables_text,
     .edits = TABLE_EDITS,
     .method = PLR_METHOD_PREINTEGRATED},
    {.name = "steps by the error",
     .text = tables_text,
     .edits = {{"a map on", "B", "enabled", "TRUE"},
               {"knots", "T", "key", "0 0.3 1"},
               {"the map off", "B", "enabled", "FALSE"},
               {"texels", "P", "image", "2 1 4 0x00ff0010 0xff0000ff"},
               {"opaque twice", "P", "image",
                "5 1 4 0x00ff0010 0xff0000ff 0x00ff0010 0x0000ffff 0x00ff0010"},
               {"so even that long steps do", "P", "image", "2 1 4 0xff802010 0xff802010"},
               {"even, and denser", "P", "image", "2 1 4 0xff802030 0xff802030"},
               {"and not even", "P", "image", "2 1 4 0x00ff0010 0xff0000e0"}},
     .by_error = true},
    {.name = "cells", .text = tables_text, .edits = TABLE_EDITS, .method = PLR_METHOD_CELLS},
};

/* ---- Pictures ---- */

static plr_scene *parse(const example *e) {
    return plr_scene_parse(e->text, strlen(e->text), "general.x3dv", NULL, NULL);
}

static void apply(plr_scene *scene, const edit *one) {
    plr_diags *diags = plr_diags_create(NULL);
    plr_node_set_text(scene, plr_scene_find(scene, one->def), one->field, one->value,
                      (plr_place){"set", 1, 1}, diags);
    CHECK_INT(plr_diags_count(diags), 0);
    plr_diags_destroy(&diags);
}

static bool draw(plr_view *view, plr_picture *picture) {
    const plr_draw_desc desc = {SIDE, SIDE, 1};
    return plr_view_draw(view, &desc, picture, NULL);
}

/* The greatest difference of any channel. */
static double difference(const plr_picture *a, const plr_picture *b) {
    double most = 0;
    for (size_t i = 0; i < (size_t)SIDE * SIDE * 4; i++)
        most = fmax(most, fabs((double)a->pixels[i] - (double)b->pixels[i]));
    return most;
}

/* The edited scene as a view of its own draws it, that knows nothing of general programs. */
static bool draw_cold(plr_engine *engine, const example *e, size_t edits, plr_picture *picture) {
    plr_scene *scene = parse(e);
    for (size_t i = 0; i < edits; i++)
        apply(scene, &e->edits[i]);
    const plr_view_desc desc = {.step = e->by_error ? 0 : 0.4, .method = e->method};
    plr_view *view = plr_view_create(engine, scene, &desc, NULL);
    bool fine = view && draw(view, picture);
    plr_view_destroy(&view);
    plr_scene_destroy(&scene);
    return fine;
}

/* ---- One edit after the other ---- */

static plr_view_stats stats_of(const plr_view *view) {
    plr_view_stats stats;
    plr_view_get_stats(view, &stats);
    return stats;
}

static void settle(plr_view *view) {
    for (int i = 0; i < 100 && plr_view_build(view, 1e4); i++)
        ;
    CHECK_INT(plr_view_build(view, 0), 0);
}

static void check_same(const plr_picture *now, const plr_picture *cold, double most,
                       const char *what) {
    double d = difference(now, cold);
    TAP_RESULT(d <= most, "%s: as drawn anew", what);
    if (d > most)
        printf("#   it differs by %g\n", d);
}

/* Returns whether general programs drew it first. `last`: the picture before, and after. */
static bool check_edit(plr_engine *engine, plr_view *view, plr_scene *scene, const example *e,
                       size_t at, plr_picture *last) {
    const char *name = e->edits[at].name;
    plr_picture at_once = {0}, later = {0}, cold = {0};
    apply(scene, &e->edits[at]);
    CHECK(plr_view_update(view, 0, NULL));
    bool fine = draw(view, &at_once);
    plr_view_stats stats = stats_of(view);
    bool general = stats.general;
    TAP_RESULT(stats.built == 0, "%s: %s: no program is built for the frame", e->name, name);
    settle(view);
    TAP_RESULT(!stats_of(view).general, "%s: the specialised program takes over", name);
    fine = fine && draw(view, &later) && draw_cold(engine, e, at + 1, &cold);
    CHECK(fine);
    if (fine) {
        check_same(&at_once, &cold, !general ? 0 : e->by_error ? 2.0 / 255 : 1e-6, name);
        check_same(&later, &cold, 0, name);
        TAP_RESULT(difference(last, &cold) > 1e-3, "%s: it can be seen", name);
    }
    plr_picture_free(&at_once);
    plr_picture_free(&later);
    plr_picture_free(last);
    *last = cold;
    return general;
}

static void check_example(plr_engine *engine, const example *e) {
    plr_scene *scene = parse(e);
    const plr_view_desc desc = {
        .step = e->by_error ? 0 : 0.4, .method = e->method, .interactive = true};
    plr_diags *diags = plr_diags_create(NULL);
    plr_view *view = plr_view_create(engine, scene, &desc, diags);
    CHECK_INT(plr_diags_count(diags), 0);
    plr_diags_destroy(&diags);
    plr_plan plan;
    plr_view_get_plan(view, &plan);
    CHECK(e->method == PLR_METHOD_AUTO || plan.method == e->method);
    plr_picture picture = {0};
    CHECK(view != NULL && draw(view, &picture));
    settle(view);
    CHECK(!stats_of(view).general && stats_of(view).building == 0);
    size_t general = 0, count = 0;
    for (; count < MOST_EDITS && e->edits[count].name; count++)
        general += check_edit(engine, view, scene, e, count, &picture);
    TAP_RESULT(general > 0, "%s: general programs drew %zu of %zu edits", e->name, general, count);
    plr_picture_free(&picture);
    plr_view_destroy(&view);
    plr_scene_destroy(&scene);
}

typedef bool (*sharing)(void *user, bool current);

static void run(plr_context *context, const example *e, sharing share) {
    plr_engine_desc desc = {.get_proc_address = plr_context_get_proc_address,
                            .user = context,
                            .make_shared_current = share};
    plr_engine *engine = plr_engine_create(&desc, NULL);
    check_example(engine, e);
    plr_engine_destroy(&engine);
}

/* An effect that does not compile leaves a view without general programs, and no worse. */
static void test_fault(plr_context *context) {
    static const example faulty = {
        .name = "a fault",
        .text = HEAD
        "DEF D DirectionalLight { direction 0.5 0 -1 }\n"
        "DEF S Shape { appearance Appearance { material Material { }\n"
        "effects Effect { parts EffectPart { type \"FRAGMENT\" url \"data:text/plain,"
        "void PLUG_fragment_modify(inout vec4 c) { c = nothing; }\" } } } geometry Sphere { } }\n",
        .edits = {{"a light off", "D", "on", "FALSE"}, {"and on", "D", "on", "TRUE"}}};
    plr_engine_desc desc = {.get_proc_address = plr_context_get_proc_address,
                            .user = context,
                            .make_shared_current = plr_context_make_shared_current};
    plr_engine *engine = plr_engine_create(&desc, NULL);
    plr_scene *scene = parse(&faulty);
    const plr_view_desc interactive = {.interactive = true};
    plr_view *view = plr_view_create(engine, scene, &interactive, NULL);
    for (size_t i = 0; i < 2; i++) {
        plr_picture now = {0}, cold = {0};
        settle(view);
        apply(scene, &faulty.edits[i]);
        plr_diags *diags = plr_diags_create(NULL);
        CHECK(plr_view_update(view, 0, diags));
        CHECK(draw(view, &now) && draw_cold(engine, &faulty, i + 1, &cold));
        check_same(&now, &cold, 0, faulty.edits[i].name);
        CHECK(!stats_of(view).general);
        TAP_RESULT(plr_diags_count(diags) > 0, "what is wrong is said");
        plr_diags_destroy(&diags);
        plr_picture_free(&now);
        plr_picture_free(&cold);
    }
    plr_view_destroy(&view);
    plr_scene_destroy(&scene);
    plr_engine_destroy(&engine);
}

/* Programs are taken over where the viewer is now: a billboard turns to him. */
static void test_moves(plr_context *context) {
    static const example billboard = {
        .text = HEAD "Billboard { axisOfRotation 0 1 0 children Shape { appearance Appearance {\n"
                     "material UnlitMaterial { } } geometry Box { size 1.6 1 0.01 } } }\n"
                     "DEF V OrthoViewpoint { fieldOfView -1 -1 1 1 position 0 0 10 }\n"
                     "DEF T TimeSensor { cycleInterval 1 loop TRUE }\n"
                     "DEF P PositionInterpolator { key [ 0 1 ] keyValue [ 0 0 10 10 0 10 ] }\n"
                     "ROUTE T.fraction_changed TO P.set_fraction\n"
                     "ROUTE P.value_changed TO V.position\n"};
    plr_engine_desc desc = {.get_proc_address = plr_context_get_proc_address, .user = context};
    plr_engine *engine = plr_engine_create(&desc, NULL);
    plr_scene *scene = parse(&billboard);
    const plr_view_desc interactive = {.interactive = true, .viewpoint = "V"};
    plr_view *view = plr_view_create(engine, scene, &interactive, NULL);
    plr_picture start = {0}, moved = {0}, later = {0};
    CHECK(draw(view, &start));
    CHECK(plr_view_update(view, 0.5, NULL));
    CHECK(draw(view, &moved));
    settle(view);
    CHECK(draw(view, &later));
    CHECK(difference(&start, &moved) > 0.1);
    check_same(&later, &moved, 0, "the viewer has moved");
    plr_picture_free(&start);
    plr_picture_free(&moved);
    plr_picture_free(&later);
    plr_view_destroy(&view);
    plr_scene_destroy(&scene);
    plr_engine_destroy(&engine);
}

/* A hidden volume is in general programs; nobody can tell. */
static void test_picks(plr_context *context) {
    static const example two = {
        .text = HEAD
        "Transform { translation 0 0 0.5 children DEF A VolumeData { dimensions 1 1 1 " VOXELS
        "renderStyle DEF M OpacityMapVolumeStyle { } } }\n"
        "DEF B VolumeData { dimensions 1 1 1 " VOXELS "renderStyle CartoonVolumeStyle { } }\n",
        .edits = {{"hidden", "M", "enabled", "FALSE"}}};
    plr_engine_desc desc = {.get_proc_address = plr_context_get_proc_address, .user = context};
    plr_engine *engine = plr_engine_create(&desc, NULL);
    plr_scene *scene = parse(&two);
    const plr_view_desc interactive = {.interactive = true};
    plr_view *view = plr_view_create(engine, scene, &interactive, NULL);
    const plr_draw_desc size = {SIDE, SIDE, 1};
    plr_box_pick box;
    plr_pick pick;
    CHECK(plr_view_pick_box(view, &size, SIDE / 2, SIDE / 2, &box));
    CHECK(box.volume == plr_scene_find(scene, "A") && box.volume_index == 0);
    settle(view);
    apply(scene, &two.edits[0]);
    CHECK(plr_view_update(view, 0, NULL));
    CHECK(stats_of(view).general);
    CHECK(plr_view_pick_box(view, &size, SIDE / 2, SIDE / 2, &box));
    CHECK(box.volume == plr_scene_find(scene, "B") && box.volume_index == 0);
    CHECK(plr_view_pick(view, &size, SIDE / 2, SIDE / 2, &pick, NULL));
    CHECK(pick.volume == plr_scene_find(scene, "B") && pick.volume_index == 0);
    plr_view_destroy(&view);
    plr_scene_destroy(&scene);
    plr_engine_destroy(&engine);
}

int main(void) {
    static const plr_backend backends[] = {PLR_BACKEND_EGL, PLR_BACKEND_OSMESA};
    bool all = false;
    for (size_t b = 0; b < 2; b++) {
        plr_context *context = plr_context_create(backends[b], NULL);
        size_t count = all ? 1 : sizeof examples / sizeof *examples;
        if (!context) {
            TAP_SKIP("no frame waits for a compiler", "there is no such context");
            continue;
        }
        for (size_t i = 0; i < count; i++)
            run(context, &examples[i], plr_context_make_shared_current);
        run(context, &examples[0], NULL);
        if (!all) {
            test_fault(context);
            test_picks(context);
            test_moves(context);
        }
        all = true;
        plr_context_destroy(&context);
    }
    return tap_done();
}
