/* The two dialects of volume rendering: what tells them apart, and the defaults of each. */
#include "checks.h"

#include <math.h>

/* ---- What selects the dialect of 2005 ---- */

static void check_selects(const char *text, bool expected) {
    plr_diags *diags;
    plr_scene *scene = parse_text(text, "scene", &diags);
    const char *line = strrchr(text, '\n');
    TAP_RESULT(plr_scene_uses_2005(scene, NULL) == expected, "%s: %s", expected ? "2005" : "final",
               line ? line + 1 : text);
    plr_scene_destroy(&scene);
    plr_diags_destroy(&diags);
}

#define STYLE(style) CLASSIC("VolumeData { renderStyle " style " }")

static void test_tokens(void) {
    static const char *const of_2005[] = {
        STYLE("CompositeVolumeStyle { }"),
        STYLE("ComposedVolumeStyle { styles [ ] }"),
        STYLE("BoundaryEnhancementVolumeStyle { contribution 0.2 }"),
        STYLE("BoundaryEnhancementVolumeStyle { gradientColor 0 0 0 1 }"),
        STYLE("BoundaryEnhancementVolumeStyle { transferFunction NULL }"),
        STYLE("EdgeEnhancementVolumeStyle { contribution 0.2 }"),
        STYLE("SilhouetteEnhancementVolumeStyle { silhouetteFactor 0.5 }"),
        STYLE("ISOSurfaceVolumeStyle { }"),
        STYLE("ISOVolumeStyle { }"),
        STYLE("StippleVolumeStyle { }"),
        CLASSIC("OctTree { }"),
        CLASSIC("SegmentedVolumeData { segmentedVoxels NULL }"),
        CLASSIC("VolumeData { voxels [ PixelTexture3D { } PixelTexture3D { } ] }"),
        XML("<VolumeData><StippleVolumeStyle/></VolumeData>"),
        XML("<VolumeData><SilhouetteEnhancementVolumeStyle silhouetteFactor='1'/></VolumeData>"),
    };
    static const char *const others[] = {
        STYLE("NULL"),
        "#X3D V3.0 utf8\nPROFILE Immersive\nVolumeData { renderStyle OpacityMapVolumeStyle { } }",
        "#X3D V3.1 utf8\nPROFILE Full\nVolumeData { renderStyle CartoonVolumeStyle { } }",
        STYLE("ComposedVolumeStyle { ordered TRUE }"),
        STYLE("BlendedVolumeStyle { weightFunction1 \"ALPHA2\" }"),
        STYLE("EdgeEnhancementVolumeStyle { edgeColor 1 0 0 }"),
        STYLE("SilhouetteEnhancementVolumeStyle { silhouetteSharpness 2 }"),
        STYLE("OpacityMapVolumeStyle { opacityFactor 1 lightFactor 1 type \"simple\" }"),
        CLASSIC("ISOSurfaceVolumeData { }"),
        CLASSIC("SegmentedVolumeData { numberOfMaxSegments 3 }"),
        CLASSIC("VolumeData { swapped TRUE sliceThickness 1 1 1 allowViewpointInside FALSE }"),
        CLASSIC("VolumeData { voxels [ PixelTexture3D { } ] }"),
    };
    for (size_t i = 0; i < sizeof of_2005 / sizeof *of_2005; i++)
        check_selects(of_2005[i], true);
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        check_selects(others[i], false);
}

/* ---- Defaults ---- */

static void check_number(const plr_node *node, const char *field, double expected) {
    double value = plr_node_number(node, field);
    TAP_RESULT(fabs(value - expected) < 1e-6, "%s.%s is %g", plr_node_type(node), field, expected);
    if (fabs(value - expected) >= 1e-6)
        printf("# it is %g\n", value);
}

static void check_silhouette(const plr_node *node, double retained, double boundary,
                             double sharpness) {
    check_number(node, "silhouetteRetainedOpacity", retained);
    check_number(node, "silhouetteBoundaryOpacity", boundary);
    check_number(node, "silhouetteSharpness", sharpness);
}

static void check_boundary(const plr_node *node, double retained, double boundary, double factor) {
    check_number(node, "retainedOpacity", retained);
    check_number(node, "boundaryOpacity", boundary);
    check_number(node, "opacityFactor", factor);
}

static void test_defaults(void) {
    plr_scene *scene = check_faults(
        "styles with and without fields",
        CLASSIC("DEF B BoundaryEnhancementVolumeStyle { }\n"
                "DEF B2 BoundaryEnhancementVolumeStyle { boundaryOpacity 0.9 opacityFactor 3 }\n"
                "DEF S SilhouetteEnhancementVolumeStyle { }\n"
                "DEF S2 SilhouetteEnhancementVolumeStyle { silhouetteFactor 2 }\n"
                "DEF S3 SilhouetteEnhancementVolumeStyle { silhouetteFactor 2 "
                "silhouetteSharpness 4 silhouetteRetainedOpacity 0.25 }\n"),
        "");
    const plr_node *b = plr_scene_find(scene, "B"), *b2 = plr_scene_find(scene, "B2");
    const plr_node *s = plr_scene_find(scene, "S"), *s2 = plr_scene_find(scene, "S2"),
                   *s3 = plr_scene_find(scene, "S3");
    for (int round = 0; round < 2; round++) { /* back and forth */
        check_boundary(b, 0.2, 0.9, 2);
        check_boundary(b2, 0.2, 0.9, 3);
        check_silhouette(s, 1, 0, 0.5);
        check_silhouette(s2, 1, 0, 0.5);
        check_silhouette(s3, 0.25, 0, 4);
        plr_scene_set_2005(scene, true);
        uint64_t revision = plr_scene_revision(scene);
        plr_scene_set_2005(scene, true);
        CHECK(plr_scene_revision(scene) == revision);
        check_boundary(b, 1, 0, 1);
        check_boundary(b2, 1, 0.9, 3);
        check_silhouette(s, 0, 1, 0.5);
        check_silhouette(s2, 0, 1, 2);
        check_silhouette(s3, 0.25, 1, 4);
        plr_scene_set_2005(scene, false);
        CHECK(plr_scene_revision(scene) > revision);
    }
    plr_scene_destroy(&scene);
}

/* Setters and events come before defaults; what takes another field's value goes with it. */
static void test_changes(void) {
    plr_scene *scene =
        check_faults("a factor in time",
                     CLASSIC("DEF T TimeSensor { loop TRUE }\n"
                             "DEF I ScalarInterpolator { key [ 0 1 ] keyValue [ 0 8 ] }\n"
                             "DEF S SilhouetteEnhancementVolumeStyle { silhouetteFactor 2 }\n"
                             "DEF K SilhouetteEnhancementVolumeStyle { silhouetteSharpness 3 }\n"
                             "DEF P BoundaryEnhancementVolumeStyle { }\n"
                             "ROUTE T.fraction_changed TO I.set_fraction\n"
                             "ROUTE I.value_changed TO S.silhouetteFactor\n"
                             "ROUTE I.value_changed TO K.silhouetteFactor\n"
                             "ROUTE I.value_changed TO P.opacityFactor\n"),
                     "");
    plr_node *s = plr_scene_find(scene, "S"), *k = plr_scene_find(scene, "K"),
             *p = plr_scene_find(scene, "P");
    plr_scene_set_2005(scene, true);
    plr_scene_set_time(scene, 0.5, NULL, NULL);
    check_silhouette(s, 0, 1, 4);
    check_silhouette(k, 0, 1, 3);
    check_boundary(p, 1, 0, 4);
    plr_scene_set_2005(scene, false); /* while events stand */
    check_number(p, "opacityFactor", 4);
    plr_scene_set_time(scene, 0.75, NULL, NULL);
    check_silhouette(s, 1, 0, 0.5);
    check_boundary(p, 0.2, 0.9, 6);
    const float factor = 5;
    CHECK(plr_node_set(scene, s, "silhouetteFactor", &factor, 1));
    plr_scene_set_2005(scene, true);
    check_number(s, "silhouetteSharpness", 5); /* a setter speaks after events */
    plr_scene_set_time(scene, 0.25, NULL, NULL);
    check_number(s, "silhouetteSharpness", 2);
    CHECK(plr_node_set(scene, p, "retainedOpacity", &factor, 1));
    plr_scene_set_2005(scene, true);
    check_number(p, "retainedOpacity", 5);
    plr_scene_destroy(&scene);
}

static void test_prototypes(void) {
    plr_scene *scene = check_faults(
        "a prototype of a style",
        CLASSIC("PROTO P [ inputOutput SFFloat f 3 ] { SilhouetteEnhancementVolumeStyle { "
                "silhouetteFactor IS f } }\n"
                "DEF A P { } DEF B P { f 7 }\n"),
        "");
    plr_scene_set_2005(scene, true);
    check_silhouette(plr_scene_find(scene, "A"), 0, 1, 3);
    check_silhouette(plr_scene_find(scene, "B"), 0, 1, 7);
    plr_scene_destroy(&scene);
}

/* Colours of the proposal and of other browsers may lack their alpha. */
static void test_colours(void) {
    static const char *const texts[] = {
        CLASSIC("DEF S EdgeEnhancementVolumeStyle { edgeColor 0.25 0.5 1 }"),
        XML("<EdgeEnhancementVolumeStyle DEF='S' edgeColor='0.25 0.5 1'/>")};
    for (int i = 0; i < 2; i++) {
        plr_scene *scene = check_faults("a colour of three numbers", texts[i], "");
        float c[4] = {0};
        CHECK(plr_node_numbers(plr_scene_find(scene, "S"), "edgeColor", c, 4) == 4);
        CHECK(c[0] == 0.25f && c[1] == 0.5f && c[2] == 1 && c[3] == 1);
        plr_scene_destroy(&scene);
    }
}

int main(void) {
    test_tokens();
    test_defaults();
    test_changes();
    test_prototypes();
    test_colours();
    return tap_done();
}
