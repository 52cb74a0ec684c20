/* glTF: what accessors hold, and the geometry that is made of them. */
#include "gltf_text.h"

#define ONE_MESH "'nodes':[{'mesh':0}],'scenes':[{'nodes':[0]}],"
#define TRIANGLE 0, 0, 0, 1, 0, 0, 0, 1, 0
#define FLOAT3 "'componentType':5126,'type':'VEC3'"

static void test_plain(void) {
    bytes b = {0};
    PUT_FLOATS(&b, TRIANGLE);
    PUT_BYTES(&b, 2, 0, 1);
    plr_scene *scene = check_body(
        "a triangle with indices", &b,
        ONE_MESH "'meshes':[{'primitives':[{'attributes':{'POSITION':0},'indices':1}]}],"
                 "'bufferViews':[{'buffer':0,'byteLength':36},{'buffer':0,'byteOffset':36,"
                 "'byteLength':3}],'accessors':[{'bufferView':0,'count':3," FLOAT3 "},"
                 "{'bufferView':1,'componentType':5121,'count':3,'type':'SCALAR'}]",
        "",
        "1 Transform -\n .children MFNode\n  2 Shape -\n   .appearance SFNode\n    3 Appearance -\n"
        "     .alphaMode SFString \"OPAQUE\"\n     .material SFNode\n      4 PhysicalMaterial -\n"
        "   .geometry SFNode\n    5 IndexedTriangleSet -\n     .coord SFNode\n      6 Coordinate "
        "-\n"
        "       .point MFVec3f 0 0 0 1 0 0 0 1 0\n     .normalPerVertex SFBool FALSE\n"
        "     .index MFInt32 2 0 1\n7 Viewpoint -\n .centerOfRotation SFVec3f 0.5 0.5 0\n"
        " .description SFString \"all\"\n .position SFVec3f 0.5 0.5 1.84775901\n");
    CHECK_STR(plr_scene_version(scene), "4.0");
    plr_scene_destroy(&scene);
}

static void test_interleaved(void) {
    bytes b = {0};
    PUT_BYTES(&b, 9, 9, 9, 9);
    for (int i = 0; i < 3; i++) {
        PUT_FLOATS(&b, (float)i, 1, 2, 0, 0, 1);
        PUT_SHORTS(&b, 7, 7);
    }
    plr_scene *scene = check_body(
        "interleaved data", &b,
        ONE_MESH "'meshes':[{'primitives':[{'attributes':{'POSITION':0,'NORMAL':1}}]}],"
                 "'bufferViews':[{'buffer':0,'byteOffset':4,'byteLength':84,'byteStride':28}],"
                 "'accessors':[{'bufferView':0,'count':3," FLOAT3 "},{'bufferView':0,"
                 "'byteOffset':12,'count':3," FLOAT3 "}]",
        "", NULL);
    CHECK_NUMBERS(first_of(scene, "Coordinate"), "point", 0, 1, 2, 1, 1, 2, 2, 1, 2);
    CHECK_NUMBERS(first_of(scene, "Normal"), "vector", 0, 0, 1, 0, 0, 1, 0, 0, 1);
    CHECK(plr_node_bool(first_of(scene, "TriangleSet"), "normalPerVertex"));
    plr_scene_destroy(&scene);
}

/* Each type of components, as numbers and normalized, by way of a colour. */
static void test_components(void) {
    static const struct {
        int code;
        const char *normalized;
        uint8_t data[12];
        double expected[3];
    } cases[] = {
        {5121, "true", {0, 51, 255}, {0, 0.2, 1}},
        {5121, "false", {0, 51, 255}, {0, 51, 255}},
        {5120, "true", {0x80, 0x81, 127}, {-1, -1, 1}},
        {5120, "false", {0x80, 0xff, 127}, {-128, -1, 127}},
        {5123, "true", {0, 0, 0x33, 0x33, 0xff, 0xff}, {0, 0.2, 1}},
        {5123, "false", {1, 0, 0, 1, 0xff, 0xff}, {1, 256, 65535}},
        {5122, "true", {0, 0x80, 0, 0, 0xff, 0x7f}, {-1, 0, 1}},
        {5122, "false", {0xfe, 0xff, 0, 0, 0, 1}, {-2, 0, 256}},
        {5125, "false", {1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0x40}, {1, 65536, 1073741824}},
        {5126, "false", {0, 0, 0x80, 0x3f, 0, 0, 0, 0xc0, 0, 0, 0, 0}, {1, -2, 0}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        bytes b = {0};
        char body[1024];
        PUT_FLOATS(&b, 1, 2, 3);
        put(&b, cases[i].data, sizeof cases[i].data);
        snprintf(body, sizeof body,
                 ONE_MESH "'meshes':[{'primitives':[{'mode':0,'attributes':{'POSITION':0,"
                          "'COLOR_0':1}}]}],'bufferViews':[{'buffer':0,'byteLength':24}],"
                          "'accessors':[{'bufferView':0,'count':1," FLOAT3 "},{'bufferView':0,"
                          "'byteOffset':12,'count':1,'componentType':%d,'type':'VEC3',"
                          "'normalized':%s}]",
                 cases[i].code, cases[i].normalized);
        plr_scene *scene = check_body("a type of components", &b, body, "", NULL);
        const plr_node *color = first_of(scene, "Color");
        check_numbers(color, "color", cases[i].expected, 3);
        CHECK_STR(plr_node_string(color, "mode"), "MODULATE");
        plr_scene_destroy(&scene);
    }
}

static void test_sparse(void) {
    bytes b = {0};
    PUT_FLOATS(&b, TRIANGLE);
    PUT_FLOATS(&b, 5, 6, 7);
    PUT_SHORTS(&b, 2);
    const char *body = ONE_MESH
        "'meshes':[{'primitives':[{'attributes':{'POSITION':0}}]}],"
        "'bufferViews':[{'buffer':0,'byteLength':36},{'buffer':0,'byteOffset':36,'byteLength':12},"
        "{'buffer':0,'byteOffset':48,'byteLength':2}],'accessors':[{%s'count':3," FLOAT3
        ",'sparse':{'count':1,'indices':{'bufferView':2,'componentType':5123},"
        "'values':{'bufferView':1}}}]";
    char text[1024];
    snprintf(text, sizeof text, body, "'bufferView':0,");
    plr_scene *scene = check_body("a sparse accessor", &b, text, "", NULL);
    CHECK_NUMBERS(first_of(scene, "Coordinate"), "point", 0, 0, 0, 1, 0, 0, 5, 6, 7);
    plr_scene_destroy(&scene);
    snprintf(text, sizeof text, body, "");
    scene = check_body("a sparse accessor of zeros", &b, text, "", NULL);
    CHECK_NUMBERS(first_of(scene, "Coordinate"), "point", 0, 0, 0, 0, 0, 0, 5, 6, 7);
    plr_scene_destroy(&scene);
}

/* What the standard does not name is for effects; points take it in the order of their index. */
static void test_own_attributes(void) {
    bytes b = {0};
    PUT_FLOATS(&b, 0, 0, 0, 1, 0, 0);
    PUT_BYTES(&b, 10, 20, 30, 40);
    PUT_BYTES(&b, 1, 0, 1);
    plr_scene *scene = check_body(
        "attributes of one's own", &b,
        ONE_MESH "'meshes':[{'primitives':[{'mode':0,'indices':2,'attributes':{'POSITION':0,"
                 "'_HEAT':1,'HEAT':1}},{'mode':0,'attributes':{'POSITION':0,'_FLOW':1}}]}],"
                 "'bufferViews':[{'buffer':0,'byteLength':31}],'accessors':[{'bufferView':0,"
                 "'count':2," FLOAT3 "},{'bufferView':0,'byteOffset':24,'componentType':5121,"
                 "'count':2,'type':'VEC2'},{'bufferView':0,'byteOffset':28,'componentType':5121,"
                 "'count':3,'type':'SCALAR'}]",
        "", NULL);
    const plr_node *group = first_of(scene, "Group");
    const plr_node *heat = first_below(group, "FloatVertexAttribute");
    CHECK_STR(plr_node_string(heat, "name"), "_HEAT");
    CHECK_INT(plr_node_int(heat, "numComponents"), 2);
    CHECK_NUMBERS(heat, "value", 30, 40, 10, 20, 30, 40);
    const plr_field *shapes = plr_node_field(group, "children");
    const plr_node *flow = first_below(shapes->value.nodes[1], "FloatVertexAttribute");
    CHECK_STR(plr_node_string(flow, "name"), "_FLOW");
    CHECK_NUMBERS(flow, "value", 10, 20, 30, 40);
    CHECK_INT(plr_node_field(first_below(group, "PointSet"), "attrib")->count, 1);
    plr_scene_destroy(&scene);
}

/* Five vertices in every mode, without and with the indices 4 3 2 1 0. */
static plr_scene *in_mode(int mode, bool indexed) {
    bytes b = {0};
    char body[1024];
    for (int i = 0; i < 5; i++)
        PUT_FLOATS(&b, (float)i, (float)(i * i), 0);
    PUT_SHORTS(&b, 4, 3, 2, 1, 0);
    snprintf(body, sizeof body,
             ONE_MESH "'meshes':[{'primitives':[{'mode':%d,'attributes':{'POSITION':0}%s}]}],"
                      "'bufferViews':[{'buffer':0,'byteLength':70}],"
                      "'accessors':[{'bufferView':0,'count':5," FLOAT3 "},{'bufferView':0,"
                      "'byteOffset':60,'componentType':5123,'count':5,'type':'SCALAR'}]",
             mode, indexed ? ",'indices':1" : "");
    return check_body("a mode", &b, body, "", NULL);
}

static void test_modes(void) {
    static const struct {
        const char *node, *field;
        size_t count;
        double numbers[12];
    } cases[7][2] = {
        {{"PointSet", NULL, 0, {0}}, {"PointSet", NULL, 0, {0}}},
        {{"IndexedLineSet", "coordIndex", 6, {0, 1, -1, 2, 3, -1}},
         {"IndexedLineSet", "coordIndex", 6, {4, 3, -1, 2, 1, -1}}},
        {{"IndexedLineSet", "coordIndex", 6, {0, 1, 2, 3, 4, 0}},
         {"IndexedLineSet", "coordIndex", 6, {4, 3, 2, 1, 0, 4}}},
        {{"IndexedLineSet", "coordIndex", 5, {0, 1, 2, 3, 4}},
         {"IndexedLineSet", "coordIndex", 5, {4, 3, 2, 1, 0}}},
        {{"TriangleSet", NULL, 0, {0}}, {"IndexedTriangleSet", "index", 5, {4, 3, 2, 1, 0}}},
        {{"TriangleStripSet", "stripCount", 1, {5}},
         {"IndexedTriangleStripSet", "index", 5, {4, 3, 2, 1, 0}}},
        {{"TriangleFanSet", "fanCount", 1, {5}},
         {"IndexedTriangleFanSet", "index", 5, {4, 3, 2, 1, 0}}},
    };
    for (int mode = 0; mode < 7; mode++)
        for (int indexed = 0; indexed < 2; indexed++) {
            plr_scene *scene = in_mode(mode, indexed);
            const plr_node *node = first_of(scene, cases[mode][indexed].node);
            if (cases[mode][indexed].field)
                check_numbers(node, cases[mode][indexed].field, cases[mode][indexed].numbers,
                              cases[mode][indexed].count);
            if (mode == 0 && indexed) /* there is no indexed PointSet: the points are moved */
                CHECK_NUMBERS(first_of(scene, "Coordinate"), "point", 4, 16, 0, 3, 9, 0, 2, 4, 0, 1,
                              1, 0, 0, 0, 0);
            else
                CHECK_NUMBERS(first_of(scene, "Coordinate"), "point", 0, 0, 0, 1, 1, 0, 2, 4, 0, 3,
                              9, 0, 4, 16, 0);
            plr_scene_destroy(&scene);
        }
}

/* Everything but the indices is the same: it is read once. */
static void test_shared(void) {
    bytes b = {0};
    PUT_FLOATS(&b, TRIANGLE);
    PUT_BYTES(&b, 0, 1, 2);
    check_gltf("shared data", &b,
               "'nodes':[{'mesh':0,'name':'a'},{'mesh':0,'name':'b'}],'scenes':[{'nodes':[0,1]}],"
               "'meshes':[{'primitives':[{'attributes':{'POSITION':0,'NORMAL':0},'material':0},"
               "{'attributes':{'POSITION':0,'NORMAL':0},'indices':1,'material':0}]}],"
               "'materials':[{'extensions':{'KHR_materials_unlit':{}}}],"
               "'bufferViews':[{'buffer':0,'byteLength':39}],"
               "'accessors':[{'bufferView':0,'count':3," FLOAT3 "},{'bufferView':0,"
               "'byteOffset':36,'componentType':5121,'count':3,'type':'SCALAR'}],"
               "'cameras':[]",
               "",
               "1 Transform a\n .children MFNode\n  2 Group -\n   .children MFNode\n    3 Shape -\n"
               "     .appearance SFNode\n      4 Appearance -\n       .alphaMode SFString "
               "\"OPAQUE\"\n       .material SFNode\n        5 UnlitMaterial -\n     .geometry "
               "SFNode\n      6 TriangleSet -\n       .coord SFNode\n        7 Coordinate -\n"
               "         .point MFVec3f 0 0 0 1 0 0 0 1 0\n       .normal SFNode\n        8 Normal "
               "-\n         .vector MFVec3f 0 0 0 1 0 0 0 1 0\n    9 Shape -\n     .appearance "
               "SFNode\n      (4)\n     .geometry SFNode\n      10 IndexedTriangleSet -\n"
               "       .coord SFNode\n        (7)\n       .normal SFNode\n        (8)\n"
               "       .index MFInt32 0 1 2\n11 Transform b\n .children MFNode\n  (2)\n"
               "12 Viewpoint -\n .centerOfRotation SFVec3f 0.5 0.5 0\n .description SFString "
               "\"all\"\n .position SFVec3f 0.5 0.5 1.84775901\n");
}

int main(void) {
    test_plain();
    test_interleaved();
    test_components();
    test_sparse();
    test_own_attributes();
    test_modes();
    test_shared();
    return tap_done();
}
