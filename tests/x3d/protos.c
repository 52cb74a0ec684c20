/* PROTO, EXTERNPROTO, IS, ROUTEs through them, IMPORT and EXPORT, units, metadata. */
#include "checks.h"

static void test_instances(void) {
    check_dump("fields through IS",
               CLASSIC("PROTO Ball [ inputOutput SFColor color 1 0 0 initializeOnly SFFloat size 2 "
                       "inputOutput MFNode more [ ] ]\n"
                       "{ Transform { children [ Shape { appearance Appearance { material Material "
                       "{ diffuseColor IS color } } geometry Sphere { radius IS size } } Group { "
                       "children IS more } ] } }\n"
                       "DEF A Ball { color 0 1 0 more Shape { } } Ball { size 3 }"),
               "1 Transform A\n"
               " .children MFNode\n"
               "  2 Shape -\n"
               "   .appearance SFNode\n"
               "    3 Appearance -\n"
               "     .material SFNode\n"
               "      4 Material -\n"
               "       .diffuseColor SFColor 0 1 0\n"
               "   .geometry SFNode\n"
               "    5 Sphere -\n"
               "     .radius SFFloat 2\n"
               "  6 Group -\n"
               "   .children MFNode\n"
               "    7 Shape -\n"
               "8 Transform -\n"
               " .children MFNode\n"
               "  9 Shape -\n"
               "   .appearance SFNode\n"
               "    10 Appearance -\n"
               "     .material SFNode\n"
               "      11 Material -\n"
               "       .diffuseColor SFColor 1 0 0\n"
               "   .geometry SFNode\n"
               "    12 Sphere -\n"
               "     .radius SFFloat 3\n"
               "  13 Group -\n");
}

static const char nested_graph[] = "1 Transform T\n"
                                   " .children MFNode\n"
                                   "  2 Transform -\n"
                                   "   .children MFNode\n"
                                   "    3 Shape S\n"
                                   "     .geometry SFNode\n"
                                   "      4 Box -\n"
                                   "    (3)\n"
                                   "   .scale SFVec3f 1 2 3\n"
                                   "   .translation SFVec3f 4 5 6\n"
                                   " .scale SFVec3f 1 2 3\n";

static void test_nested(void) {
    plr_scene *scene = check_faults(
        "prototypes in prototypes",
        CLASSIC("PROTO Outer [ inputOutput SFVec3f s 1 1 1 inputOutput SFVec3f t 0 0 0 ] {\n"
                " PROTO Inner [ inputOutput SFVec3f a 9 9 9 inputOutput SFVec3f b 8 8 8 ] {\n"
                "  Transform { scale IS a translation IS b children [ DEF S Shape { geometry Box { "
                "} } USE S ] } }\n"
                " Transform { scale IS s children Inner { a IS s b IS t } } }\n"
                "DEF T Outer { s 1 2 3 t 4 5 6 }"),
        "");
    check_graph("prototypes in prototypes", scene, nested_graph);
    plr_scene_destroy(&scene);
    plr_diags *diags;
    scene = parse_text(
        XML("<ProtoDeclare name='P'><ProtoInterface><field name='c' type='MFNode' "
            "accessType='inputOutput'><Shape/></field><field name='v' type='SFBool' "
            "accessType='inputOutput' "
            "value='false'/></ProtoInterface><ProtoBody><Group><IS><connect "
            "nodeField='children' protoField='c'/><connect nodeField='visible' protoField='v'/>"
            "</IS></Group></ProtoBody></ProtoDeclare>"
            "<ProtoInstance name='P' DEF='A'><fieldValue name='c'><Group/><Shape/></fieldValue>"
            "</ProtoInstance><ProtoInstance name='P' DEF='B'/><ProtoInstance name='P' DEF='C'/>"),
        "s", &diags);
    check_these_faults("prototypes in XML", diags, "");
    const plr_node *a = plr_scene_find(scene, "A"), *b = plr_scene_find(scene, "B"),
                   *c = plr_scene_find(scene, "C");
    CHECK_INT(plr_node_field(a, "children")->count, 2);
    CHECK_STR(plr_node_type(plr_node_child(a, "children")), "Group");
    CHECK(!plr_node_bool(a, "visible"));
    CHECK_STR(plr_node_type(plr_node_child(b, "children")), "Shape");
    CHECK(plr_node_child(b, "children") != plr_node_child(c, "children"));
    CHECK_STR(plr_node_written_type(b), "P");
    CHECK_STR(plr_node_type(b), "Group");
    plr_scene_destroy(&scene);
    plr_diags_destroy(&diags);
}

static void test_routes(void) {
    plr_scene *scene = check_faults(
        "ROUTEs of a body and of instances",
        CLASSIC(
            "PROTO P [ inputOnly SFVec3f set_at outputOnly SFFloat done inputOutput SFVec3f s 1 1 "
            "1 ] {\n"
            " DEF T Transform { set_translation IS set_at scale IS s }\n"
            " DEF C TimeSensor { fraction_changed IS done }\n"
            " DEF I PositionInterpolator { }\n"
            " ROUTE C.fraction_changed TO I.set_fraction\n"
            " ROUTE I.value_changed TO T.rotation_center }\n"
            "DEF A P { } DEF B P { } DEF J PositionInterpolator { } DEF K ScalarInterpolator { }\n"
            "ROUTE J.value_changed TO A.set_at ROUTE B.done TO K.set_fraction\n"
            "ROUTE J.value_changed TO B.set_s"),
        "8:29 error bad-route\n");
    CHECK_INT(plr_scene_route_count(scene), 5);
    const plr_route *route = plr_scene_route(scene, 0);
    CHECK_STR(route->from_field, "fraction_changed");
    CHECK_STR(plr_node_type(route->to), "PositionInterpolator");
    CHECK(plr_scene_route(scene, 1)->from != route->from);
    route = plr_scene_route(scene, 2);
    CHECK(route->to == plr_scene_find(scene, "A"));
    CHECK_STR(route->to_field, "translation");
    route = plr_scene_route(scene, 3);
    CHECK_STR(plr_node_type(route->from), "TimeSensor");
    CHECK(route->to == plr_scene_find(scene, "K"));
    route = plr_scene_route(scene, 4);
    CHECK(route->to == plr_scene_find(scene, "B"));
    CHECK_STR(route->to_field, "scale");
    plr_scene_destroy(&scene);
}

static void test_declared(void) {
    check_dump(
        "declared fields through IS",
        CLASSIC("PROTO P [ inputOutput SFFloat a 0.5 ] { Effect { inputOutput SFFloat a IS a "
                "inputOnly SFTime t initializeOnly SFNode tex PixelTexture { } } }\n"
                "P { a 0.75 }"),
        "1 Effect -\n"
        " .a SFFloat declared 0.75\n"
        " .t SFTime declared 0\n"
        " .tex SFNode declared\n"
        "  2 PixelTexture -\n");
}

static void test_faults(void) {
    check_only_faults("types that differ",
                      CLASSIC("PROTO P [ inputOutput SFFloat a 1 ] { Transform { scale IS a } }"),
                      "3:60 error bad-proto\n");
    check_only_faults("an unknown field of the interface",
                      CLASSIC("PROTO P [ ] { Transform { scale IS a } }"),
                      "3:36 error bad-proto\n");
    check_only_faults("IS outside", CLASSIC("Transform { scale IS a }"), "3:22 error bad-proto\n");
    check_only_faults(
        "an access that does not fit",
        CLASSIC("PROTO P [ inputOnly SFFloat a ]\n{ ScalarInterpolator { value_changed "
                "IS a } }"),
        "4:41 error bad-proto\n");
    check_only_faults("an empty body", CLASSIC("PROTO P [ ] { } P { }"), "3:7 error bad-proto\n");
    check_only_faults("an unknown field of an instance",
                      CLASSIC("PROTO P [ ] { Group { } } P { x 1 }"),
                      "3:31 warning unknown-field\n");
    check_only_faults("an instance where its node does not belong",
                      CLASSIC("PROTO P [ ] { Group { } } Shape { geometry P { } }"),
                      "3:44 warning bad-node\n");
    check_only_faults("names of a body are its own",
                      CLASSIC("PROTO P [ ] { DEF G Group { } } P { } Group { children USE G }"),
                      "3:60 error unknown-def\n");
}

static void test_setting(void) {
    plr_scene *scene =
        check_faults("instance to be set",
                     CLASSIC("PROTO P [ inputOutput SFFloat size 1 ] { Shape { geometry Sphere { "
                             "radius IS size } } }\nDEF A P { } DEF B P { size 4 }"),
                     "");
    plr_node *a = plr_scene_find(scene, "A");
    CHECK(plr_node_set_text(scene, a, "size", "2.5", (plr_place){0}, NULL));
    CHECK_NEAR(plr_node_number(plr_node_child(a, "geometry"), "radius"), 2.5, 0);
    CHECK_NEAR(plr_node_number(plr_node_child(plr_scene_find(scene, "B"), "geometry"), "radius"), 4,
               0);
    plr_scene_destroy(&scene);
}

static void test_statements(void) {
    static const char *const texts[] = {
        "#X3D V4.0 utf8\nPROFILE Interchange COMPONENT Volume:4 COMPONENT Shaders : 1\nUNIT length "
        "millimetre 0.001 UNIT angle degree 0.5\nMETA \"title\" \"a \\\"b\\\"\" META \"x\" \"y\"\n",
        "<X3D version='4.0' profile='Interchange'><head><component name='Volume' level='4'/><unit "
        "category='length' name='millimetre' conversionFactor='0.001'/><unit category='angle' "
        "name='degree' conversionFactor='.5'/><meta name='title' content='a &quot;b&quot;'/><meta "
        "name='x' content='y'/></head><Scene/></X3D>"};
    for (size_t i = 0; i < 2; i++) {
        plr_scene *scene = check_faults("statements", texts[i], "");
        const char *content = NULL;
        CHECK_STR(plr_scene_version(scene), "4.0");
        CHECK_NEAR(plr_scene_length_unit(scene), 0.001, 0);
        CHECK_NEAR(plr_scene_angle_unit(scene), 0.5, 0);
        CHECK_STR(plr_scene_meta(scene, 0, &content), "title");
        CHECK_STR(content, "a \"b\"");
        CHECK_STR(plr_scene_meta(scene, 1, NULL), "x");
        CHECK(plr_scene_meta(scene, 2, NULL) == NULL);
        plr_scene_destroy(&scene);
    }
}

static void test_dialect(void) {
    plr_scene *scene = check_faults(
        "names of 2005",
        CLASSIC("VolumeData {\n renderStyle CompositeVolumeStyle { styles [ "
                "SilhouetteEnhancementVolumeStyle { silhouetteFactor 1 } CartoonVolumeStyle { "
                "parallelColor 1 0 0 } ] } }"),
        "");
    plr_place place = {0};
    CHECK(plr_scene_uses_2005(scene, &place));
    CHECK_INT(place.line, 4);
    const plr_node *style = plr_node_child(plr_scene_root(scene, 0), "renderStyle");
    CHECK_STR(plr_node_type(style), "ComposedVolumeStyle");
    CHECK_STR(plr_node_written_type(style), "CompositeVolumeStyle");
    const plr_field *styles = plr_node_field(style, "renderStyle");
    CHECK_INT(styles->count, 2);
    float color[4] = {0};
    CHECK_INT(plr_node_numbers(styles->value.nodes[1], "parallelColor", color, 4), 4);
    CHECK(color[0] == 1 && color[1] == 0 && color[2] == 0 && color[3] == 1);
    plr_scene_destroy(&scene);
    scene = check_faults("names of today",
                         CLASSIC("VolumeData { renderStyle ComposedVolumeStyle { } }"), "");
    CHECK(!plr_scene_uses_2005(scene, NULL));
    plr_scene_destroy(&scene);
}

int main(void) {
    test_instances();
    test_nested();
    test_routes();
    test_declared();
    test_faults();
    test_setting();
    test_statements();
    test_dialect();
    return tap_done();
}
