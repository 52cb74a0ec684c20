/* The same scene in XML and in Classic VRML gives the same graph. */
#include "checks.h"

static void check_same(const char *what, const char *xml, const char *classic) {
    plr_diags *xml_diags, *classic_diags;
    plr_scene *a = parse_text(xml, "a.x3d", &xml_diags);
    plr_scene *b = parse_text(classic, "b.x3dv", &classic_diags);
    char *xml_faults = dump_diags(xml_diags), *classic_faults = dump_diags(classic_diags);
    char *xml_dump = dump_scene(a), *classic_dump = dump_scene(b);
    TAP_RESULT(!*xml_faults, "%s: XML without fault", what);
    if (*xml_faults)
        printf("# %s\n", xml_faults);
    TAP_RESULT(!*classic_faults, "%s: Classic without fault", what);
    if (*classic_faults)
        printf("# %s\n", classic_faults);
    TAP_RESULT(strcmp(xml_dump, classic_dump) == 0 && *xml_dump, "%s: same graph", what);
    if (strcmp(xml_dump, classic_dump) != 0)
        printf("# --- XML\n%s\n# --- Classic\n%s\n", xml_dump, classic_dump);
    free(xml_dump), free(classic_dump), free(xml_faults), free(classic_faults);
    plr_scene_destroy(&a);
    plr_scene_destroy(&b);
    plr_diags_destroy(&xml_diags);
    plr_diags_destroy(&classic_diags);
}

static void test_nodes(void) {
    check_same("nested nodes",
               XML("<Transform DEF='T' translation='1 2 3'><Shape><Box size='1 2 4'/>"
                   "<Appearance><Material diffuseColor='1 0 0.5' transparency='.25'/></Appearance>"
                   "</Shape></Transform>"),
               CLASSIC("DEF T Transform { translation 1 2 3 children [ Shape { geometry Box { size "
                       "1, 2, 4 } appearance Appearance { material Material { diffuseColor 1 0 "
                       "0.5 transparency .25 } } } ] }"));
    check_same("DEF and USE",
               XML("<Group><Shape DEF='S'><Sphere/></Shape><Transform><Shape USE='S'/></Transform>"
                   "</Group>"),
               CLASSIC("Group { children [ DEF S Shape { geometry Sphere {} } Transform { children "
                       "USE S } ] }"));
}

static void test_volume(void) {
    check_same(
        "a volume",
        XML("<VolumeData dimensions='1 1 2'><OpacityMapVolumeStyle containerField='renderStyle'>"
            "<PixelTexture containerField='transferFunction' image='2 1 4 0x000000ff 0xffffffff'/>"
            "</OpacityMapVolumeStyle><PixelTexture3D containerField='voxels' image='1 2 1 1 0 "
            "255'/>"
            "<Effect><field name='amount' type='SFFloat' accessType='inputOutput' value='0.5'/>"
            "<EffectPart type='FRAGMENT' url='\"a.glsl\"'/></Effect></VolumeData>"),
        CLASSIC(
            "VolumeData { dimensions 1 1 2 renderStyle OpacityMapVolumeStyle { transferFunction "
            "PixelTexture { image 2 1 4 0xFF 0xFFFFFFFF } } voxels PixelTexture3D { image [ 1 2 "
            "1 1 0 255 ] } effects Effect { inputOutput SFFloat amount 0.5 parts EffectPart { "
            "type \"FRAGMENT\" url \"a.glsl\" } } }"));
}

static void test_types(void) {
    check_same(
        "every type of field",
        XML("<ComposedShader>"
            "<field name='a' type='SFBool' accessType='inputOutput' value='true'/>"
            "<field name='b' type='SFInt32' accessType='inputOutput' value='-7'/>"
            "<field name='c' type='SFFloat' accessType='inputOutput' value='1.5e-3'/>"
            "<field name='d' type='SFDouble' accessType='inputOutput' value='0.1'/>"
            "<field name='e' type='SFTime' accessType='inputOutput' value='1e9'/>"
            "<field name='f' type='SFVec2f' accessType='inputOutput' value='1 2'/>"
            "<field name='g' type='SFVec3d' accessType='inputOutput' value='1 2 3'/>"
            "<field name='h' type='SFVec4f' accessType='inputOutput' value='1 2 3 4'/>"
            "<field name='i' type='SFColor' accessType='inputOutput' value='1 .5 0'/>"
            "<field name='j' type='SFColorRGBA' accessType='inputOutput' value='1 .5 0 .25'/>"
            "<field name='k' type='SFRotation' accessType='inputOutput' value='0 1 0 3'/>"
            "<field name='l' type='SFMatrix3f' accessType='inputOutput' value='1 2 3 4 5 6 7 8 9'/>"
            "<field name='m' type='SFMatrix4d' accessType='inputOutput' value='1 2 3 4 5 6 7 8 9 "
            "10 11 "
            "12 13 14 15 16'/>"
            "<field name='n' type='SFString' accessType='inputOutput' value='a &quot;b&quot;'/>"
            "<field name='o' type='SFImage' accessType='inputOutput' value='1 2 3 0xff0000 255'/>"
            "<field name='p' type='MFBool' accessType='inputOutput' value='true false'/>"
            "<field name='q' type='MFInt32' accessType='inputOutput' value='1, 0x10, -1'/>"
            "<field name='r' type='MFVec2d' accessType='inputOutput' value='1 2 3 4'/>"
            "<field name='s' type='MFColorRGBA' accessType='inputOutput' value=''/>"
            "<field name='t' type='MFString' accessType='inputOutput' value='\"a\" \"b "
            "\\\"c\\\"\"'/>"
            "<field name='u' type='MFImage' accessType='inputOutput' value='1 1 1 5 0 0 0'/>"
            "<field name='v' type='SFNode' accessType='inputOutput'><PixelTexture/></field>"
            "<field name='w' type='MFNode' accessType='initializeOnly'><Box/><Cone/></field>"
            "<field name='x' type='MFMatrix3f' accessType='inputOutput' value='1 0 0 0 1 0 0 0 1'/>"
            "<field name='y' type='SFFloat' accessType='inputOnly'/>"
            "<field name='z' type='MFRotation' accessType='inputOutput' value='0 1 0 1 1 0 0 2'/>"
            "</ComposedShader>"),
        CLASSIC(
            "ComposedShader {\n"
            "inputOutput SFBool a TRUE exposedField SFInt32 b -7 inputOutput SFFloat c 1.5E-3\n"
            "inputOutput SFDouble d .1 inputOutput SFTime e 1000000000 inputOutput SFVec2f f 1 2\n"
            "inputOutput SFVec3d g 1 2 3 inputOutput SFVec4f h 1 2 3 4 inputOutput SFColor i 1 .5 "
            "0\ninputOutput SFColorRGBA j 1 .5 0 .25 inputOutput SFRotation k 0 1 0 3\n"
            "inputOutput SFMatrix3f l 1 2 3 4 5 6 7 8 9 inputOutput SFMatrix4d m 1 2 3 4 5 6 7 8 9 "
            "10 11 12 13 14 15 16\ninputOutput SFString n \"a \\\"b\\\"\"\n"
            "inputOutput SFImage o 1 2 3 0xFF0000 0XFF inputOutput MFBool p [ TRUE, FALSE ]\n"
            "inputOutput MFInt32 q [ 1 16 -1 ] inputOutput MFVec2d r [ 1 2, 3 4 ]\n"
            "inputOutput MFColorRGBA s [ ] inputOutput MFString t [ \"a\" \"b \\\"c\\\"\" ]\n"
            "inputOutput MFImage u [ 1 1 1 5, 0 0 0 ] inputOutput SFNode v PixelTexture { }\n"
            "field MFNode w [ Box { }, Cone { } ] inputOutput MFMatrix3f x 1 0 0 0 1 0 0 0 1\n"
            "eventIn SFFloat y inputOutput MFRotation z [ 0 1 0 1 1 0 0 2 ] }"));
}

static void test_containers(void) {
    check_same(
        "containerField by itself",
        XML("<Group><Effect DEF='InGroup'/><PointLight><Effect/></PointLight>"
            "<Shape><Appearance><ImageTexture url='x.png'><Effect><EffectPart/></Effect>"
            "</ImageTexture><Effect DEF='InAppearance'/><ComposedShader><ShaderPart/>"
            "</ComposedShader></Appearance><IndexedFaceSet coordIndex='0 1 2'><Coordinate "
            "point='0 0 0 1 0 0 0 1 0'/></IndexedFaceSet></Shape></Group>"),
        CLASSIC("Group { children [ DEF InGroup Effect { } PointLight { effects Effect { } } "
                "Shape { appearance Appearance { texture ImageTexture { url \"x.png\" effects "
                "Effect { parts EffectPart { } } } effects DEF InAppearance Effect { } shaders "
                "ComposedShader { parts ShaderPart { } } } geometry IndexedFaceSet { coordIndex "
                "[ 0 1 2 ] coord Coordinate { point [ 0 0 0 1 0 0 0 1 0 ] } } } ] }"));
    check_same(
        "metadata",
        XML("<Shape><MetadataSet name='s'><MetadataBoolean value='true false'/><MetadataInteger "
            "value='1'/></MetadataSet></Shape>"),
        CLASSIC("Shape { metadata MetadataSet { name \"s\" value [ MetadataBoolean { value [ TRUE "
                "FALSE ] } MetadataInteger { value 1 } ] } }"));
    check_same(
        "the only field that takes the node",
        XML("<VolumeData><PixelTexture3D/><ShadedVolumeStyle><Material/></ShadedVolumeStyle>"
            "</VolumeData>"),
        CLASSIC("VolumeData { voxels PixelTexture3D { } renderStyle ShadedVolumeStyle { material "
                "Material { } } }"));
}

static void test_prototypes(void) {
    check_same(
        "prototypes and ROUTEs",
        XML("<ProtoDeclare name='P'><ProtoInterface><field name='s' type='SFVec3f' "
            "accessType='inputOutput' value='1 2 3'/><field name='c' type='MFNode' "
            "accessType='inputOutput'/></ProtoInterface><ProtoBody><Transform><IS><connect "
            "nodeField='scale' protoField='s'/><connect nodeField='children' protoField='c'/>"
            "</IS></Transform></ProtoBody></ProtoDeclare><ProtoInstance name='P' DEF='A'>"
            "<fieldValue name='c'><Shape/></fieldValue></ProtoInstance><Group><ProtoInstance "
            "name='P'><fieldValue name='s' value='4 5 6'/></ProtoInstance></Group><ROUTE "
            "fromNode='A' fromField='s' toNode='A' toField='set_s'/>"),
        CLASSIC("PROTO P [ inputOutput SFVec3f s 1 2 3 inputOutput MFNode c [ ] ] { Transform { "
                "scale IS s children IS c } } DEF A P { c Shape { } } Group { children P { s 4 5 "
                "6 } } ROUTE A.s_changed TO A.s"));
}

static void test_levels(void) {
    plr_scene *scene = check_faults(
        "a list of voxels",
        CLASSIC("VolumeData { voxels [ DEF A PixelTexture3D { } DEF B PixelTexture3D { } ] }"), "");
    const plr_node *volume = plr_scene_root(scene, 0);
    CHECK(plr_node_child(volume, "voxels") == plr_scene_find(scene, "A"));
    CHECK(plr_node_child(volume, "voxelLevels") == plr_scene_find(scene, "B"));
    CHECK(plr_scene_uses_2005(scene, NULL));
    plr_scene_destroy(&scene);
    scene = check_faults("a list of one node",
                         CLASSIC("VolumeData { voxels [ PixelTexture3D { } ] }"), "");
    CHECK(!plr_scene_uses_2005(scene, NULL));
    plr_scene_destroy(&scene);
    scene = check_faults("a second node", CLASSIC("Shape { geometry [ Box { } Cone { } ] }"),
                         "3:28 warning bad-node\n");
    CHECK_STR(plr_node_type(plr_node_child(plr_scene_root(scene, 0), "geometry")), "Box");
    plr_scene_destroy(&scene);
}

static void check_title(const char *what, const char *text, size_t length) {
    plr_diags *diags = plr_diags_create(NULL);
    plr_scene *scene = plr_scene_parse(text, length, "s", NULL, diags);
    check_these_faults(what, diags, "");
    CHECK_STR(plr_node_string(plr_scene_root(scene, 0), "title"), "\xc3\xa4");
    plr_scene_destroy(&scene);
    plr_diags_destroy(&diags);
}

static void test_encodings(void) {
    static const char latin[] = "<?xml version='1.0' encoding='ISO-8859-1'?><X3D><Scene><WorldInfo "
                                "title='\xe4'/></Scene></X3D>";
    static const char utf8[] = "\xef\xbb\xbf<?xml version=\"1.0\" encoding=\"UTF-8\"?><X3D><Scene>"
                               "<WorldInfo title='\xc3\xa4'/></Scene></X3D>";
    static const char classic[] = "\xef\xbb\xbf#X3D V3.3 utf8\nWorldInfo { title \"\xc3\xa4\" }";
    static const char ascii[] = "<X3D><Scene><WorldInfo title='?'/></Scene></X3D>";
    char utf16[2 * sizeof ascii + 2] = "\xff\xfe";
    size_t length = 2;
    for (const char *p = ascii; *p; p++, length += 2) {
        utf16[length] = *p == '?' ? '\xe4' : *p;
        utf16[length + 1] = '\0';
    }
    check_title("ISO-8859-1", latin, sizeof latin - 1);
    check_title("UTF-8 with a mark", utf8, sizeof utf8 - 1);
    check_title("Classic with a mark", classic, sizeof classic - 1);
    check_title("UTF-16", utf16, length);
    check_only_faults("an unknown encoding",
                      "<?xml version='1.0' encoding='x-none'?><X3D><Scene/></X3D>",
                      "1:1 error xml\n");
}

static void test_setters(void) {
    plr_scene *scene = check_faults(
        "fields to be set",
        CLASSIC("DEF T Transform { translation 1 2 3 } DEF W WorldInfo { } DEF C Coordinate { }"),
        "");
    plr_node *t = plr_scene_find(scene, "T"), *w = plr_scene_find(scene, "W"),
             *c = plr_scene_find(scene, "C");
    plr_diags *diags = plr_diags_create(NULL);
    plr_place place = {"command", 1, 1};
    float numbers[6] = {4, 5, 6, 7, 8, 9}, read[6] = {0};
    CHECK(plr_node_set(scene, t, "translation", numbers, 1));
    CHECK_INT(plr_node_numbers(t, "translation", read, 6), 3);
    CHECK(read[0] == 4 && read[2] == 6);
    CHECK(!plr_node_set(scene, t, "translation", numbers, 2));
    CHECK(!plr_node_set(scene, t, "nothing", numbers, 1));
    CHECK(plr_node_set(scene, c, "point", numbers, 2));
    CHECK_INT(plr_node_field(c, "point")->count, 2);
    CHECK(plr_node_set_text(scene, t, "translation", "7 8 9", place, diags));
    CHECK_INT(plr_node_numbers(t, "translation", read, 6), 3);
    CHECK(read[1] == 8);
    CHECK(plr_node_set_text(scene, w, "title", "bare words", place, diags));
    CHECK_STR(plr_node_string(w, "title"), "bare words");
    CHECK(plr_node_set_text(scene, w, "info", "[ \"a\" \"b\" ]", place, diags));
    CHECK_INT(plr_node_field(w, "info")->count, 2);
    CHECK_INT(plr_diags_count(diags), 0);
    CHECK(!plr_node_set_text(scene, t, "translation", "1 2", place, diags));
    CHECK(!plr_node_set_text(scene, t, "translation", "1 2 3 x", place, diags));
    CHECK(!plr_node_set_text(scene, t, "none", "1", place, diags));
    CHECK(!plr_node_set_text(scene, t, "children", "Group { }", place, diags));
    CHECK_INT(plr_diags_count(diags), 4);
    CHECK_STR(plr_diags_get(diags, 0)->place.file, "command");
    CHECK_INT(plr_node_numbers(t, "translation", read, 6), 3);
    CHECK(read[1] == 8);
    plr_diags_destroy(&diags);
    plr_scene_destroy(&scene);
}

/* Without a field of the kind there is zero, "" or NULL. */
static void test_absent(void) {
    plr_scene *scene = check_faults("a node", CLASSIC("DEF T Transform { }"), "");
    const plr_node *t = plr_scene_find(scene, "T");
    CHECK(!plr_node_bool(t, "translation") && plr_node_int(t, "nothing") == 0);
    CHECK(plr_node_number(t, "children") == 0 && plr_node_child(t, "scale") == NULL);
    CHECK_STR(plr_node_string(t, "scale"), "");
    CHECK(plr_node_field(t, "nothing") == NULL && plr_scene_find(scene, "U") == NULL);
    CHECK(plr_scene_root(scene, 1) == NULL && plr_scene_route(scene, 0) == NULL);
    CHECK(plr_node_field(t, "translation")->given == false);
    CHECK(plr_node_field_at(t, plr_node_field_count(t)) == NULL);
    plr_scene_destroy(&scene);
}

/* Numbers as strtod reads them (in the C locale of tests), and none in hexadecimal floats. */
static void test_numbers(void) {
    static const char *const texts[] = {"0",
                                        "-0",
                                        "1",
                                        "1.",
                                        ".5",
                                        "-.5e1",
                                        "1e10",
                                        "1E-10",
                                        "+3.25",
                                        "1e-320",
                                        "123456789012345678901234567890",
                                        "0.1",
                                        "0.3",
                                        "2.2250738585072014e-308",
                                        "1.7976931348623157e308",
                                        "9007199254740993",
                                        "3.14159265358979323846",
                                        "1e22",
                                        "1e23",
                                        "0.000000000000000000000000000001",
                                        "100000000000000000000000000000000000000"};
    char text[200];
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        snprintf(text, sizeof text, CLASSIC("TimeSensor { cycleInterval %s }"), texts[i]);
        plr_diags *diags;
        plr_scene *scene = parse_text(text, "s", &diags);
        double expected = strtod(texts[i], NULL);
        double read = plr_node_number(plr_scene_root(scene, 0), "cycleInterval");
        TAP_RESULT(fabs(read - expected) <= fabs(expected) * 2.3e-16, "%s", texts[i]);
        plr_scene_destroy(&scene);
        plr_diags_destroy(&diags);
    }
}

int main(void) {
    test_nodes();
    test_volume();
    test_types();
    test_containers();
    test_prototypes();
    test_levels();
    test_encodings();
    test_setters();
    test_absent();
    test_numbers();
    return tap_done();
}
