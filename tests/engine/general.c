/* No frame waits for a compiler: what an edit switches on or off is drawn at once by general
 * programs, as the specialised ones draw it, which take over when they are built. */
#include "tests/tap.h"

#include "engine/view.h"

#define MAP                                                                                        \
    "OpacityMapVolumeStyle { transferFunction PixelTexture { image 2 1 4 0xff802000 0x20ff60c0 } " \
    "}"
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

static const char segments_text[] =
    HEAD "DirectionalLight { direction 0.5 0 -1 }\n"
         "DEF V SegmentedVolumeData { dimensions 1.6 1.6 1.6 " VOXELS LABELS
         "segmentEnabled [ TRUE TRUE FALSE ]\n"
         "renderStyle [ CartoonVolumeStyle { } DEF SH ShadedVolumeStyle { lighting TRUE } ] }\n";

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

static const example examples[] = {
    {"lights",
     lights_text,
     {{"a light is switched on", "P", "on", "TRUE"},
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
    {"planes",
     planes_text,
     {{"a plane is switched on", "A", "enabled", "TRUE"},
      {"the volume's own one is switched off", "B", "enabled", "FALSE"},
      {"a plane that was not there", "O", "whichChoice", "1"},
      {"a plane moves", "A", "plane", "1 0 0 -0.1"},
      {"the one volume is hidden", "M", "enabled", "FALSE"},
      {"the headlight on volumes and shapes", "N", "headlight", "TRUE"},
      {"the volume is there again", "M", "enabled", "TRUE"}}},
    {"segments",
     segments_text,
     {{"a segment is switched on", "V", "segmentEnabled", "TRUE TRUE TRUE"},
      {"another one off", "V", "segmentEnabled", "FALSE TRUE TRUE"},
      {"the style of a segment off", "SH", "enabled", "FALSE"},
      {"more switches than before", "V", "segmentEnabled", "TRUE TRUE TRUE FALSE"},
      {"and on", "SH", "enabled", "TRUE"}}},
    {"surfaces",
     surfaces_text,
     {{"the style of a surface on", "SH", "enabled", "TRUE"},
      {"values of surfaces", "V", "surfaceValues", "0.2 0.7"},
      {"the other style off", "C", "enabled", "FALSE"}}},
    {"shadows and blending",
     shadows_text,
     {{"blending on", "B", "enabled", "TRUE"},
      {"the style inside off", "I", "enabled", "FALSE"},
      {"shadows off with their style", "SH", "enabled", "FALSE"},
      {"the style inside on", "I", "enabled", "TRUE"},
      {"shadows on", "SH", "enabled", "TRUE"}}},
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
    plr_view *view = plr_view_create(engine, scene, NULL, NULL);
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
        check_same(&at_once, &cold, general ? 1e-6 : 0, name);
        check_same(&later, &cold, 0, name);
        TAP_RESULT(difference(last, &cold) > 1e-3, "%s: it can be seen", name);
    }
    plr_picture_free(&at_once);
    plr_picture_free(&later);
    plr_picture_free(last);
    *last = cold;
    return general;
}

static void check_example(plr_engine *engine, const example *e, bool threads) {
    plr_scene *scene = parse(e);
    const plr_view_desc desc = {.interactive = true};
    plr_diags *diags = plr_diags_create(NULL);
    plr_view *view = plr_view_create(engine, scene, &desc, diags);
    CHECK_INT(plr_diags_count(diags), 0);
    plr_diags_destroy(&diags);
    plr_picture picture = {0};
    CHECK(view != NULL && draw(view, &picture));
    settle(view);
    CHECK(!stats_of(view).general && stats_of(view).building == 0);
    size_t general = 0, count = 0;
    for (; count < MOST_EDITS && e->edits[count].name; count++)
        general += check_edit(engine, view, scene, e, count, &picture);
    TAP_RESULT(general > 0 || !threads, "%s: general programs drew %zu of %zu edits", e->name,
               general, count);
    plr_picture_free(&picture);
    plr_view_destroy(&view);
    plr_scene_destroy(&scene);
}

int main(void) {
    plr_context *context = plr_context_create(PLR_BACKEND_AUTO, NULL);
    if (!context) {
        TAP_SKIP("no frame waits for a compiler", "there is no GL");
        return tap_done();
    }
    for (size_t i = 0; i < sizeof examples / sizeof *examples; i++) {
        plr_engine_desc desc = {.get_proc_address = plr_context_get_proc_address,
                                .user = context,
                                .make_shared_current = plr_context_make_shared_current};
        plr_engine *engine = plr_engine_create(&desc, NULL);
        check_example(engine, &examples[i], true);
        plr_engine_destroy(&engine);
    }
    plr_context_destroy(&context);
    return tap_done();
}
