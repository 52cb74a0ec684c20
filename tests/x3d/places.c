/* Nodes, fields and every byte of a text know their line and column, in both encodings, through
 * escapes, entities, CDATA, prototypes. */
#include "checks.h"

static const plr_node *part_of(const plr_scene *scene) {
    const plr_node *effect = plr_scene_find(scene, "E");
    return effect ? plr_node_child(effect, "parts") : NULL;
}

static void check_code(const char *what, const char *text, const char *faults, const char *word,
                       unsigned line, unsigned column) {
    plr_diags *diags;
    plr_scene *scene = parse_text(text, "dir/s", &diags);
    plr_string code = {0};
    const plr_node *part = part_of(scene);
    TAP_RESULT(part && plr_scene_code(scene, part, "url", &code, diags), "%s: code", what);
    check_these_faults(what, diags, faults);
    check_place(what, &code, word, "dir/s", line, column);
    plr_scene_destroy(&scene);
    plr_diags_destroy(&diags);
}

static void test_code_classic(void) {
    check_code("classic string",
               CLASSIC("DEF E Effect { parts EffectPart {\n"
                       "  url \"data:text/plain,\n"
                       "void PLUG_fragment_modify(inout vec4 c) {\n"
                       "  c = densty;\n}\" } }"),
               "", "densty", 6, 7);
    check_code("classic string without data:",
               CLASSIC("DEF E Effect { parts EffectPart {\n"
                       "  url \"void f() {}\nint x;\" } }"),
               "", "int", 5, 1);
    check_code("classic escapes",
               CLASSIC("DEF E Effect { parts EffectPart {\n"
                       "  url \"data:text/plain,\\\"a\\\" \\\\ word\nlast\" } }"),
               "", "word", 4, 33);
    check_code("classic behind escapes, next line",
               CLASSIC("DEF E Effect { parts EffectPart {\n"
                       "  url \"data:text/plain,\\\"a\\\"\n  word\" } }"),
               "", "word", 5, 3);
    check_code("classic, second string of a list",
               CLASSIC("DEF E Effect { parts EffectPart {\n"
                       "  url [ \"http://x.org/a.glsl\",\n    \"data:text/plain,word\" ] } }"),
               "", "word", 5, 22);
    check_code("classic CRLF",
               "#X3D V3.3 utf8\r\nDEF E Effect { parts EffectPart {\r\n"
               "  url \"data:text/plain,\r\n  one\r\n  word\" } }",
               "", "word", 5, 3);
}

#define PART(content) "<X3D>\n<Scene><Effect DEF='E'><EffectPart " content "</Effect></Scene></X3D>"

static void test_code_xml(void) {
    check_code("CDATA", PART(">\n<![CDATA[data:text/plain,\n  c = densty;\n]]></EffectPart>"), "",
               "densty", 4, 7);
    check_code("CDATA without data:", PART("><![CDATA[void f() {\n  int a;\n}]]></EffectPart>"), "",
               "int", 3, 3);
    check_code("CDATA on its first line", PART("><![CDATA[ a + word;]]></EffectPart>"), "", "word",
               2, 51);
    check_code("CDATA with CRLF",
               PART(">\r\n<![CDATA[data:text/plain,\r\n one;\r\n  word;\r\n]]></EffectPart>"), "",
               "word", 5, 3);
    check_code("two CDATA sections: the first that loads",
               PART("><![CDATA[data:,one;]]><![CDATA[two;]]></EffectPart>"), "", "one", 2, 52);
    check_code("attribute, entities", PART("url='data:text/plain,a &lt; b &amp;&amp; word;'/>"), "",
               "word", 2, 77);
    check_code("attribute, character references", PART("url='data:,a&#10;b&#x41;word;'/>"), "",
               "word", 2, 60);
    check_code("attribute, several lines",
               PART("\n  url='data:text/plain,\n  one;\n   a &gt; word;'/>"),
               "3:8 warning newlines\n", "word", 5, 11);
    check_code("attribute, strings in quotes",
               PART("\n  url='\"data:text/plain,x \\\"y\\\" word\"'/>"), "", "word", 3, 33);
    check_code("attribute, strings in entities",
               PART("\n  url='&quot;http://a.b/c&quot; &quot;data:,word&quot;'/>"), "", "word", 3,
               45);
    check_code("text that is not CDATA", PART(">\nint x = 1 &lt; word;</EffectPart>"), "", "word",
               3, 16);
}

static void test_newlines_in_attribute(void) {
    plr_diags *diags;
    plr_scene *scene = parse_text(PART("url='data:,// one\nint two;'/>"), "s", &diags);
    plr_string code = {0};
    CHECK(plr_scene_code(scene, part_of(scene), "url", &code, diags));
    CHECK_STR(code.text, "// one\nint two;");
    plr_scene_destroy(&scene);
    plr_diags_destroy(&diags);
}

static void test_newlines_between_strings(void) {
    check_only_faults("newlines between strings are none of a fault",
                      XML("<ImageTexture url='\"a.png\"\n \"b.png\"'/>"), "");
    check_only_faults("nor are those of other fields", XML("<WorldInfo info='\"a\nb\"'/>"), "");
}

static void test_base64(void) {
    plr_diags *diags;
    plr_scene *scene = parse_text(PART("url='data:text/plain;base64,aW50IHg7Cg=='/>"), "s", &diags);
    plr_string code = {0};
    CHECK(plr_scene_code(scene, part_of(scene), "url", &code, diags));
    CHECK_STR(code.text, "int x;\n");
    plr_scene_destroy(&scene);
    plr_diags_destroy(&diags);
    scene = parse_text(PART("url='data:text/plain,100%25 \\n'/>"), "s", &diags);
    CHECK(plr_scene_code(scene, part_of(scene), "url", &code, diags));
    CHECK_STR(code.text, "100%25 \\n");
    plr_scene_destroy(&scene);
    plr_diags_destroy(&diags);
}

static void check_node_place(const plr_node *node, unsigned line, unsigned column) {
    plr_place place = plr_node_place(node);
    CHECK_INT(place.line, line);
    CHECK_INT(place.column, column);
    CHECK_STR(place.file, "s");
}

static void test_nodes_and_fields(void) {
    plr_diags *diags;
    plr_scene *scene =
        parse_text("#X3D V3.3 utf8\n\n  DEF T Transform {\n   scale 1 2 3\n children "
                   "Shape { } }",
                   "s", &diags);
    const plr_node *t = plr_scene_find(scene, "T");
    check_node_place(t, 3, 9);
    CHECK_INT(plr_node_field(t, "scale")->place.line, 4);
    CHECK_INT(plr_node_field(t, "scale")->place.column, 4);
    check_node_place(plr_node_child(t, "children"), 5, 11);
    plr_scene_destroy(&scene);
    plr_diags_destroy(&diags);
    scene =
        parse_text("<?xml version='1.0'?>\n<!-- <Shape> -->\n<X3D><Scene>\n <Transform\n  DEF='T' "
                   "scale='1 2 3'>\n  <Shape/></Transform></Scene></X3D>",
                   "s", &diags);
    t = plr_scene_find(scene, "T");
    check_node_place(t, 4, 2);
    CHECK_INT(plr_node_field(t, "scale")->place.line, 5);
    CHECK_INT(plr_node_field(t, "scale")->place.column, 11);
    check_node_place(plr_node_child(t, "children"), 6, 3);
    plr_scene_destroy(&scene);
    plr_diags_destroy(&diags);
}

static void test_lines(void) {
    plr_diags *diags;
    plr_scene *scene = parse_text("#X3D V3.3 utf8\r\nGroup {}\nlast", "s", &diags);
    size_t length = 0;
    const char *line = plr_scene_line(scene, "s", 1, &length);
    CHECK_INT(length, 14);
    CHECK(line && strncmp(line, "#X3D V3.3 utf8", 14) == 0);
    line = plr_scene_line(scene, "s", 3, &length);
    CHECK(line && length == 4 && strncmp(line, "last", 4) == 0);
    CHECK(plr_scene_line(scene, "s", 4, &length) == NULL);
    CHECK(plr_scene_line(scene, "other", 1, &length) == NULL);
    plr_scene_destroy(&scene);
    plr_diags_destroy(&diags);
}

static void test_prototypes(void) {
    check_code(
        "code in a prototype's body",
        CLASSIC("PROTO P [ ] { Group { children DEF E Effect { parts EffectPart {\n"
                " url \"data:,x\n word\" } } } }\nGroup { } DEF E Effect { parts EffectPart {"
                "\n  url \"data:,word\" } }"),
        "", "word", 7, 14);
    check_code("code through IS",
               CLASSIC("PROTO P [ initializeOnly MFString code [] ] { Effect { parts EffectPart { "
                       "url IS code } } }\n"
                       "DEF E P { code \"data:,\n  word;\" }"),
               "", "word", 5, 3);
    check_code("default of an interface",
               CLASSIC("PROTO P [ initializeOnly MFString code \"data:,\n  word;\" ]\n{ Effect { "
                       "parts EffectPart { url IS code } } }\nDEF E P { }"),
               "", "word", 4, 3);
    check_code(
        "code through fieldValue",
        "<X3D><Scene><ProtoDeclare name='P'><ProtoInterface>\n"
        "<field name='code' type='MFString' accessType='initializeOnly'/></ProtoInterface>\n"
        "<ProtoBody><Effect><EffectPart><IS><connect nodeField='url' protoField='code'/></IS>"
        "</EffectPart></Effect></ProtoBody></ProtoDeclare>\n"
        "<ProtoInstance DEF='E' name='P'>\n<fieldValue name='code' value='\"data:,a "
        "&lt; word;\"'/></ProtoInstance></Scene></X3D>",
        "", "word", 5, 46);
}

int main(void) {
    test_code_classic();
    test_code_xml();
    test_newlines_in_attribute();
    test_newlines_between_strings();
    test_base64();
    test_nodes_and_fields();
    test_lines();
    test_prototypes();
    return tap_done();
}
