/* Mistakes are reported at their own places, and the reading goes on. */
#include "checks.h"

static void test_eight(void) {
    check_only_faults("eight mistakes in Classic",
                      "#X3D V3.3 utf8\n"
                      "Trasform { translation 1 2 3 }\n"                 /* 1: unknown node */
                      "Transform { translaton 1 2 3 scale 1 1 1 }\n"     /* 2: unknown field */
                      "Transform { translation 1 2 rotation 0 0 1 0 }\n" /* 3: too few numbers */
                      "Shape { geometry Box { size 1 x 1 } }\n"          /* 4: no number */
                      "Shape { appearance Material { } }\n"              /* 5: wrong node */
                      "Group { children USE Nobody }\n"                  /* 6: unknown name */
                      "Shape { appearance Appearance { material Material { transparency 2 } } }\n"
                      "ROUTE A.b TO C.d\n" /* 8: unknown names */
                      "DEF Last Group { }\n",
                      "2:1 warning unknown-node\n"
                      "3:13 warning unknown-field\n"
                      "4:25 error bad-value\n"
                      "5:31 error bad-value\n"
                      "6:20 warning bad-node\n"
                      "7:22 error unknown-def\n"
                      "8:66 warning bad-range\n"
                      "9:7 error unknown-def\n"
                      "9:14 error unknown-def\n");
    check_only_faults("eight mistakes in XML",
                      "<X3D><Scene>\n"
                      "<Trasform translation='1 2 3'><Foo DEF='F'/></Trasform>\n"
                      "<Transform translaton='1 2 3' scale='1 1 1'/>\n"
                      "<Transform translation='1 2' rotation='0 0 1 0'/>\n"
                      "<Shape><Box size='1 x 1'/></Shape>\n"
                      "<Shape><Material containerField='appearance'/></Shape>\n"
                      "<Group><Shape USE='Nobody'/></Group>\n"
                      "<Shape><Appearance><Material transparency='2'/></Appearance></Shape>\n"
                      "<ROUTE fromNode='A' fromField='b' toNode='F' toField='d'/>\n"
                      "</Scene></X3D>",
                      "2:1 warning unknown-node\n"
                      "3:12 warning unknown-field\n"
                      "4:25 error bad-value\n"
                      "5:21 error bad-value\n"
                      "6:8 warning bad-node\n"
                      "7:20 error unknown-def\n"
                      "8:44 warning bad-range\n"
                      "9:18 error unknown-def\n");
}

static void test_values(void) {
    check_only_faults("too many numbers", CLASSIC("Box { size 1 2 3 4 solid TRUE }"),
                      "3:18 error bad-value\n");
    check_only_faults("too many numbers in XML", XML("<Shape><Box size='1 2 3 4'/></Shape>"),
                      "1:51 error bad-value\n");
    check_only_faults("not a multiple", CLASSIC("Coordinate { point [ 0 0 0 1 1 ] }"),
                      "3:20 error bad-value\n");
    check_only_faults("a word in a list", CLASSIC("Coordinate { point [ 0 0 zero ] fog 1 }"),
                      "3:26 error bad-value\n3:33 warning unknown-field\n");
    check_only_faults("a word for the last number", CLASSIC("Material { diffuseColor 1 0 zero }"),
                      "3:29 error bad-value\n");
    check_only_faults("a word for a number, then a field",
                      CLASSIC("Material { diffuseColor 1 zero shininess 2 }"),
                      "3:27 error bad-value\n3:42 warning bad-range\n");
    check_only_faults(
        "a misspelled field after too few numbers",
        CLASSIC("ImageTexture3D { repeatS TRUE } Material { diffuseColor 1 0 shinines "
                "TRUE }"),
        "3:57 error bad-value\n3:61 warning unknown-field\n");
    check_only_faults("fraction for a whole number", CLASSIC("SpatialGeometry { }"),
                      "3:1 warning unknown-node\n");
    check_only_faults("whole number expected", CLASSIC("Switch { whichChoice 1.5 }"),
                      "3:22 error bad-value\n");
    check_only_faults("beyond 32 bits", CLASSIC("Switch { whichChoice 3000000000 }"),
                      "3:22 error bad-value\n");
    check_only_faults("beyond float", CLASSIC("Sphere { radius 1e39 }"), "3:17 error bad-value\n");
    check_only_faults("bool expected", CLASSIC("Box { solid 1 size 1 1 1 }"),
                      "3:13 error bad-value\n");
    check_only_faults("string expected", CLASSIC("WorldInfo { title Hello info \"x\" }"),
                      "3:19 error bad-value\n");
    check_only_faults("image with too few pixels", CLASSIC("PixelTexture { image 2 2 1 0 0 0 }"),
                      "3:22 error bad-value\n");
    check_only_faults("image with too many pixels", CLASSIC("PixelTexture { image 1 1 1 0 0 }"),
                      "3:22 error bad-value\n");
    check_only_faults("image with negative size", CLASSIC("PixelTexture { image -1 1 1 }"),
                      "3:22 error bad-value\n");
    check_only_faults("voxels that do not fit",
                      CLASSIC("PixelTexture3D { image [ 1 2 2 2 0 0 0 ] }"),
                      "3:18 error bad-value\n");
    check_only_faults("a list where one value is", CLASSIC("Sphere { radius [ 1 ] }"),
                      "3:17 error bad-value\n");
    check_only_faults("range of a list", CLASSIC("Color { color [ 0 0 0, 0 1.5 0 ] }"),
                      "3:26 warning bad-range\n");
    check_only_faults("a default outside the range is none of a fault",
                      CLASSIC("Group { bboxSize -1 -1 -1 }"), "");
    check_only_faults("output takes no value", CLASSIC("Inline { load FALSE children [] }"),
                      "3:21 error bad-value\n");
}

static void test_wrong_case(void) {
    plr_diags *diags;
    plr_scene *scene = parse_text(XML("<Transform Translation='1 2 3'/>"), "s", &diags);
    CHECK_INT(plr_diags_count(diags), 2);
    CHECK_STR(plr_code_text(plr_diags_get(diags, 0)->code), "unknown-field");
    CHECK_STR(plr_diags_get(diags, 1)->message, "did you mean 'translation'?");
    plr_scene_destroy(&scene);
    plr_diags_destroy(&diags);
    scene = parse_text(CLASSIC("DEF Lamp Group {} DEF Camp Group {} Group { children USE Lmap }"),
                       "s", &diags);
    CHECK_STR(plr_diags_get(diags, 1)->message, "did you mean 'Lamp'?");
    plr_scene_destroy(&scene);
    plr_diags_destroy(&diags);
}

static void test_syntax(void) {
    check_only_faults("a brace that is never closed", CLASSIC("Group {\n children [ Shape { } ]"),
                      "3:7 error syntax\n");
    check_only_faults("a bracket that is never closed", CLASSIC("Group { children [ Shape { } }"),
                      "3:18 error syntax\n");
    check_only_faults("a string that is never closed", CLASSIC("WorldInfo {\n title \"abc }"),
                      "4:8 error syntax\n3:11 error syntax\n");
    check_only_faults("a brace too many", CLASSIC("Group { } }\nShape { foo 1 }"),
                      "3:11 error syntax\n4:9 warning unknown-field\n");
    check_only_faults("a value too many", CLASSIC("Group { children Shape { } 5 visible TRUE }"),
                      "3:28 error syntax\n");
    check_only_faults("a node without brace", CLASSIC("Group\nShape { bar 2 }"),
                      "4:1 error syntax\n4:9 warning unknown-field\n");
    check_only_faults("no header", "Group { }", "1:1 warning encoding\n");
    check_only_faults("VRML 2.0", "#VRML V2.0 utf8\nGroup { }", "");
    check_only_faults("VRML 1.0", "#VRML V1.0 ascii\nGroup { }",
                      "1:1 warning encoding\n1:12 warning encoding\n");
    check_only_faults("ROUTE without TO", CLASSIC("ROUTE a.b c.d\nGroup { x 1 }"),
                      "3:11 error syntax\n4:9 warning unknown-field\n");
    check_only_faults(
        "unknown values are skipped",
        CLASSIC("Group { a [ 1 2 [ 3 ] ] b DEF X Foo { c { } } c USE X d \"s\" \"t\" e "
                "TRUE f 1 2 3 g NULL h Bar { } children USE X }"),
        "3:9 warning unknown-field\n3:25 warning unknown-field\n3:47 warning "
        "unknown-field\n3:55 warning unknown-field\n3:65 warning unknown-field\n3:72 "
        "warning unknown-field\n3:80 warning unknown-field\n3:87 warning "
        "unknown-field\n");
}

static void test_malformed_xml(void) {
    plr_scene *scene = check_faults("malformed XML",
                                    "<X3D><Scene><Group DEF='G'><Shape/>\n <Transform DEF='T'\n"
                                    "</Group></Scene></X3D>",
                                    "3:1 error xml\n");
    CHECK(plr_scene_find(scene, "G") != NULL);
    CHECK_INT(plr_scene_root_count(scene), 1);
    plr_scene_destroy(&scene);
    check_only_faults("wrong end tag", "<X3D>\n<Scene>\n</Group></Scene></X3D>", "3:9 error xml\n");
    check_only_faults("no scene at all", "<html><body/></html>", "1:1 error syntax\n");
    check_only_faults("unknown entity", XML("<WorldInfo title='a &foo; b'/>"), "1:47 error xml\n");
    check_only_faults("strings in single quotes", XML("<NavigationInfo type=\"'FLY','ANY'\"/>"),
                      "1:49 warning bad-value\n");
    check_only_faults("parts of a document where they do not belong",
                      XML("<Scene/><Group><X3D/></Group><head/>"),
                      "1:27 error syntax\n1:42 error syntax\n1:56 error syntax\n");
    check_only_faults("no namespace for a prefix",
                      "<X3D xsd:noNamespaceSchemaLocation='x'><Scene/></X3D>", "");
    check_only_faults("text in a node", XML("<Group>hello</Group>"), "1:34 warning syntax\n");
    check_only_faults("statement without attribute", XML("<ROUTE fromNode='a'/>"),
                      "1:27 error syntax\n");
    check_only_faults("USE of another type", XML("<Group DEF='G'/><Shape USE='G'/>"),
                      "1:43 warning bad-node\n");
}

static void test_routes(void) {
    const char *nodes = "#X3D V3.3 utf8\nDEF T TimeSensor { } DEF I PositionInterpolator { } DEF X "
                        "Transform { }\n";
    char text[1000];
    static const char *const routes[][2] = {
        {"ROUTE T.fraction_changed TO I.set_fraction", ""},
        {"ROUTE I.value_changed TO X.translation", ""},
        {"ROUTE I.value_changed TO X.set_translation", ""},
        {"ROUTE X.translation_changed TO X.scale", ""},
        {"ROUTE T.fraction_changed TO X.translation", "3:1 error bad-route\n"},
        {"ROUTE T.fraction TO I.set_fraction", "3:9 error bad-route\n"},
        {"ROUTE T.set_fraction TO I.value_changed", "3:9 error bad-route\n3:27 error bad-route\n"},
        {"ROUTE Y.x TO X.translation", "3:7 error unknown-def\n"},
        {"ROUTE X.translation TO I.value_changed", "3:26 error bad-route\n"}};
    for (size_t i = 0; i < sizeof routes / sizeof *routes; i++) {
        snprintf(text, sizeof text, "%s%s", nodes, routes[i][0]);
        check_only_faults(routes[i][0], text, routes[i][1]);
    }
    snprintf(text, sizeof text, "%s%s", nodes, "ROUTE X.translation_changed TO X.set_scale");
    plr_scene *scene = check_faults("route", text, "");
    const plr_route *route = plr_scene_route(scene, 0);
    CHECK_INT(plr_scene_route_count(scene), 1);
    CHECK_STR(route->from_field, "translation");
    CHECK_STR(route->to_field, "scale");
    CHECK(route->from == plr_scene_find(scene, "X") && route->to == route->from);
    CHECK_INT(route->place.line, 3);
    plr_scene_destroy(&scene);
}

static void test_loops(void) {
    check_only_faults("USE inside itself", CLASSIC("DEF A Group { children USE A }"),
                      "3:28 error recursion\n");
    check_only_faults("USE inside itself in XML",
                      XML("<Group DEF='A'><Transform><Group USE='A'/></Transform></Group>"),
                      "1:65 error recursion\n");
    check_only_faults("a Script may know itself",
                      CLASSIC("DEF S Script { initializeOnly SFNode self USE S }"), "");
    check_only_faults("a Script may know what is around it",
                      XML("<Transform DEF='T'><Script><field name='f' type='SFNode' "
                          "accessType='inputOutput'><Transform USE='T'/></field></Script>"
                          "</Transform>"),
                      "");
    check_only_faults(
        "an instance that is not complete cannot be used",
        CLASSIC("PROTO P [ inputOutput SFNode n NULL ] { Script { field SFNode n IS n } }\n"
                "DEF A P { n Script { field SFNode m USE A } }"),
        "4:41 error recursion\n");
    check_only_faults("prototype inside itself",
                      CLASSIC("PROTO P [ ] { Group { children P { } } }\nP { }"),
                      "3:32 error recursion\n");
}

int main(void) {
    test_eight();
    test_values();
    test_wrong_case();
    test_syntax();
    test_malformed_xml();
    test_routes();
    test_loops();
    return tap_done();
}
