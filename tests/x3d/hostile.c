/* Input that means harm: nesting, counts, growth, loops; and memory that runs out at any point. */
#include "checks.h"

#include <time.h>

/* `head`, n times `piece`, `tail` */
static char *repeat(const char *head, const char *piece, size_t n, const char *tail) {
    size_t length = strlen(piece);
    char *text = malloc(strlen(head) + n * length + strlen(tail) + 1), *p = text;
    p += strlen(strcpy(p, head));
    for (size_t i = 0; i < n; i++, p += length)
        memcpy(p, piece, length);
    strcpy(p, tail);
    return text;
}

/* Reads a text within some seconds; only the codes of the faults count, each once. */
static void check_codes(const char *what, char *text, const plr_read_desc *desc,
                        const char *expected) {
    clock_t start = clock();
    plr_diags *diags = plr_diags_create(NULL);
    plr_scene *scene = plr_scene_parse(text, strlen(text), "s", desc, diags);
    char codes[500] = "";
    for (size_t i = 0; i < plr_diags_count(diags); i++) {
        const plr_diag *diag = plr_diags_get(diags, i);
        const char *code = plr_code_text(diag->code);
        if (diag->severity != PLR_NOTE && !strstr(codes, code)) {
            strcat(codes, code);
            strcat(codes, " ");
        }
    }
    double seconds = (double)(clock() - start) / CLOCKS_PER_SEC;
    TAP_RESULT(strcmp(codes, expected) == 0, "%s: %s", what, expected);
    if (strcmp(codes, expected) != 0)
        printf("#   %s\n", codes);
    TAP_RESULT(seconds < 20, "%s: quick", what);
    if (seconds >= 2)
        printf("#   %.1f s\n", seconds);
    plr_scene_destroy(&scene);
    plr_diags_destroy(&diags);
    free(text);
}

static void test_nesting(void) {
    const char *header = "#X3D V3.3 utf8\n";
    check_codes("deep nodes", repeat(header, "Group { children [ ", 1000000, ""), NULL, "limit ");
    check_codes("deep brackets", repeat(header, "[ ", 1000000, ""), NULL, "syntax ");
    check_codes("deep unknown nodes", repeat(header, "Foo { x ", 1000000, ""), NULL,
                "unknown-node syntax ");
    check_codes("deep prototypes", repeat(header, "PROTO P [ ] { ", 100000, ""), NULL, "limit ");
    check_codes("deep elements", repeat("<X3D><Scene>", "<Group>", 1000000, ""), NULL, "limit ");
    check_codes("deep unknown elements", repeat("<X3D><Scene>", "<Foo>", 1000000, ""), NULL,
                "unknown-node xml ");
    check_codes("the allowed depth", repeat("<X3D><Scene>", "<Group>", 511, ""), NULL, "xml ");
    plr_read_desc desc = {.max_depth = 1000000};
    check_codes("more depth than there is stack", repeat(header, "Group { children ", 1000000, ""),
                &desc, "limit ");
}

static void test_counts(void) {
    const char *header = "#X3D V3.3 utf8\n";
    plr_read_desc desc = {.max_nodes = 1000};
    check_codes("many nodes", repeat(header, "Group { } ", 2000, ""), &desc, "limit ");
    check_codes("many elements", repeat("<X3D><Scene>", "<Group/>", 2000, "</Scene></X3D>"), &desc,
                "limit ");
    plr_read_desc little = {.max_memory = 1000000};
    plr_diags *diags = plr_diags_create(NULL);
    char *text = repeat(header, "Group { } ", 20000, "");
    CHECK(plr_scene_parse(text, strlen(text), "s", &little, diags) == NULL);
    CHECK_STR(plr_code_text(plr_diags_get(diags, 0)->code), "no-memory");
    plr_diags_destroy(&diags);
    free(text);
    check_codes("many faults", repeat(header, "Group { foo 1 } ", 100000, ""), NULL,
                "unknown-field limit ");
    check_codes("many unknown names with long near misses",
                repeat("#X3D V3.3 utf8\n",
                       "DEF Abcdefghijklmnopqrstuvwxyz Group { children USE "
                       "Abcdefghijklmnopqrstuvwxya } ",
                       50000, ""),
                NULL, "unknown-def limit ");
    check_codes("a huge image that is not there",
                repeat(header, "PixelTexture { image 2000000000 2000000000 4 0 }", 1, ""), NULL,
                "bad-value ");
    check_codes(
        "huge voxels that are not there",
        repeat(header, "PixelTexture3D { image 4 2147483647 2147483647 2147483647 0 }", 1, ""),
        NULL, "bad-value ");
    check_codes("many attributes", repeat("<X3D><Scene a='", " ", 10, "'/></X3D>"), NULL, "");
    check_codes("many ROUTEs",
                repeat(header, "DEF T Transform { } ROUTE T.scale TO T.scale ", 50000, ""), NULL,
                "");
    check_codes("many redefinitions of a prototype",
                repeat(header, "PROTO P [ ] { Group { } } P { } ", 20000, ""), NULL, "");
}

/* Everything here would take the square of its length, if it were allowed to. */
static void test_squares(void) {
    const char *header = "#X3D V3.3 utf8\n";
    check_codes(
        "many ROUTEs to an instance of many fields",
        repeat("#X3D V3.3 utf8\nPROTO P [ inputOutput SFVec3f a 1 1 1 ] { DEF T Transform { ",
               "scale IS a ", 90000, "} }\nDEF A P { }\nDEF B Transform { }\n"),
        NULL, "");
    char *routes = repeat("", "ROUTE B.scale TO A.a ", 30000, "");
    char *text =
        repeat("#X3D V3.3 utf8\nPROTO P [ inputOutput SFVec3f a 1 1 1 inputOutput SFVec3f b 1 "
               "1 1 ] { DEF T Transform { ",
               "scale IS b ", 90000, "} }\nDEF A P { }\nDEF B Transform { }\n");
    text = realloc(text, strlen(text) + strlen(routes) + 1);
    strcat(text, routes);
    free(routes);
    check_codes("many ROUTEs to an instance with many IS", text, NULL, "limit ");
    check_codes(
        "many sections of CDATA",
        repeat("<X3D><Scene><EffectPart>", "<![CDATA[x;]]>", 200000, "</EffectPart></Scene></X3D>"),
        NULL, "");
    check_codes(
        "many strings with entities",
        repeat("<X3D><Scene><WorldInfo info='", "&quot;&lt;&quot; ", 200000, "'/></Scene></X3D>"),
        NULL, "");
    check_codes("many declared fields",
                repeat("#X3D V3.3 utf8\nScript { ", "inputOnly SFBool x ", 100000, "}"), NULL,
                "bad-value limit ");
    check_codes("many lines", repeat(header, "\n", 3000000, "Group { }"), NULL, "");
    check_codes("many ampersands", repeat("<X3D><Scene><WorldInfo title='", "&", 1000000, "'/>"),
                NULL, "xml ");
}

static void test_growth(void) {
    char *text = malloc(20000), *p = text;
    p +=
        sprintf(p, "#X3D V3.3 utf8\nPROTO P0 [ ] { Group { children [ Group { } Group { } ] } }\n");
    for (int i = 1; i < 60; i++)
        p += sprintf(p, "PROTO P%d [ ] { Group { children [ P%d { } P%d { } ] } }\n", i, i - 1,
                     i - 1);
    sprintf(p, "P59 { }");
    plr_read_desc desc = {.max_nodes = 1000000};
    check_codes("prototypes that double", text, &desc, "limit ");
    text = malloc(20000), p = text;
    p += sprintf(p, "#X3D V3.3 utf8\nPROTO P0 [ inputOutput SFVec3f a 1 1 1 ] { Group { children "
                    "Transform { scale IS a scale IS a } } }\n");
    for (int i = 1; i < 40; i++)
        p += sprintf(
            p,
            "PROTO P%d [ inputOutput SFVec3f a 1 1 1 ] { Group { children P%d { a IS a a IS "
            "a } } }\n",
            i, i - 1);
    sprintf(p, "P39 { }");
    check_codes("IS that doubles", text, &desc, "limit ");
}

static void test_entities(void) {
    char *text = malloc(5000), *p = text;
    p += sprintf(p, "<!DOCTYPE X3D [ <!ENTITY a \"aaaaaaaaaaaaaaaaaaaa\">\n");
    for (char c = 'b'; c <= 'p'; c++)
        p += sprintf(p, "<!ENTITY %c \"&%c;&%c;&%c;&%c;&%c;&%c;&%c;&%c;&%c;&%c;\">\n", c, c - 1,
                     c - 1, c - 1, c - 1, c - 1, c - 1, c - 1, c - 1, c - 1, c - 1);
    sprintf(p, "]><X3D><Scene><WorldInfo title='&p;'/>&p;</Scene></X3D>");
    check_codes("entities of entities", text, NULL, "xml ");
    check_codes("an entity that is a file",
                repeat("<!DOCTYPE X3D [ <!ENTITY e SYSTEM \"/etc/passwd\"> ]><X3D><Scene>", "&e;",
                       1, "</Scene></X3D>"),
                NULL, "xml ");
    check_codes("parameter entities",
                repeat("<!DOCTYPE X3D [ <!ENTITY % e \"<!ENTITY f 'x'>\"> %e; %e; ]><X3D><Scene>",
                       "", 0, "</Scene></X3D>"),
                NULL, "xml ");
    check_codes(
        "an external subset",
        repeat("<!DOCTYPE X3D PUBLIC 'ISO//Web3D//DTD X3D 3.3//EN' "
               "'http://www.web3d.org/specifications/x3d-3.3.dtd' [ <!-- ]> ' --> <?pi ]> ?> "
               "]><X3D><Scene>",
               "<Group/>", 1, "</Scene></X3D>"),
        NULL, "");
    check_codes(
        "attributes by default",
        repeat("<!DOCTYPE X3D [ <!ATTLIST Group DEF CDATA 'x' foo CDATA 'y'> ]><X3D><Scene>",
               "<Group/>", 3, "</Scene></X3D>"),
        NULL, "");
}

static void test_broken(void) {
    static const char *const texts[] = {
        "",
        " ",
        "#",
        "#X3D",
        "#X3D V",
        "#X3D V3.3 utf8",
        "#VRML V2.0 utf8\n{",
        "<",
        "<X3D",
        "<X3D>",
        "<X3D><Scene",
        "<!",
        "<!DOCTYPE",
        "<!DOCTYPE [",
        "<?",
        "<?xml",
        "<X3D><![CDATA[",
        "<X3D a='",
        "<X3D><Scene><Group DEF='a' USE='a'",
        "\xef\xbb\xbf<X3D/>",
        "\xef\xbb\xbf#X3D V3.3 utf8\n",
        "#X3D V3.3 utf8\nDEF",
        "#X3D V3.3 utf8\nUSE",
        "#X3D V3.3 utf8\nPROTO",
        "\"",
        "\\",
        "\xff\xff",
        "#X3D V3.3 utf8\nPROTO P [",
        "#X3D V3.3 utf8\nPROTO P [ ] {",
        "#X3D V3.3 utf8\nROUTE a.",
        "#X3D V3.3 utf8\nEXTERNPROTO P [ ] 5 P { }",
        "#X3D V3.3 utf8\nGroup { IS }",
        "#X3D V3.3 utf8\nScript { inputOnly }",
        "#X3D V3.3 utf8\nScript { field SFNode x }",
        "#X3D V3.3 utf8\nShape { geometry",
        "#X3D V3.3 utf8\nBox { size",
        "<X3D>&#0;</X3D>",
        "<X3D><Scene><Group DEF=''/><Group USE=''/><ROUTE/><IS/><connect/><field/><fieldValue/>"
        "<ProtoDeclare/><ProtoInstance/><ProtoBody/><ExternProtoDeclare/><IMPORT/><EXPORT/></Scene>"
        "</X3D>"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        plr_diags *diags;
        plr_scene *scene = parse_text(texts[i], "s", &diags);
        TAP_RESULT(scene != NULL, "broken text %zu is survived", i);
        plr_scene_destroy(&scene);
        plr_diags_destroy(&diags);
    }
    static const char with_nul[] = "#X3D V3.3 utf8\nDEF \0A Group { url \"a\0b\" }";
    plr_diags *diags = plr_diags_create(NULL);
    plr_scene *scene = plr_scene_parse(with_nul, sizeof with_nul, "s", NULL, diags);
    CHECK(scene != NULL);
    plr_scene_destroy(&scene);
    plr_diags_destroy(&diags);
}

/* ---- Memory that runs out ---- */

typedef struct failing {
    size_t allocations, fail_at, live;
} failing;

static void *failing_reallocate(void *user, void *pointer, size_t size) {
    failing *f = user;
    if (++f->allocations == f->fail_at)
        return NULL;
    f->live += !pointer;
    return realloc(pointer, size);
}

static void failing_release(void *user, void *pointer) {
    failing *f = user;
    f->live -= pointer != NULL;
    free(pointer);
}

/* What a scene offers, once through. */
static void use_scene(plr_scene *scene, plr_diags *diags) {
    plr_string code;
    plr_bytes bytes;
    plr_node *part = plr_scene_find(scene, "Part");
    if (part)
        plr_scene_code(scene, part, "url", &code, diags);
    plr_node *image = plr_scene_find(scene, "Image");
    if (image &&
        plr_scene_load_first(scene, plr_node_field(image, "url"), true, &bytes, NULL, diags))
        plr_bytes_free(&bytes);
    float three[3] = {1, 2, 3};
    plr_node *t = plr_scene_find(scene, "T");
    if (t) {
        plr_node_set(scene, t, "scale", three, 1);
        plr_node_set_text(scene, t, "translation", "1 2 3", (plr_place){"x", 1, 1}, diags);
    }
}

static void test_allocations(const char *what, const char *text) {
    size_t total = 0;
    bool clean = true, told = true;
    for (size_t n = 1; n <= total + 1; n++) {
        failing f = {.fail_at = n};
        plr_allocator allocator = {failing_reallocate, failing_release, &f};
        plr_read_desc desc = {.allocator = &allocator};
        plr_diags *diags = plr_diags_create(NULL);
        plr_scene *scene = plr_scene_parse(text, strlen(text), "s", &desc, diags);
        if (scene)
            use_scene(scene, diags);
        else
            told = told && plr_diags_count_of(diags, PLR_ERROR) > 0;
        plr_scene_destroy(&scene);
        clean = clean && f.live == 0;
        if (f.allocations >= n)
            total = f.allocations > total ? f.allocations : total;
        plr_diags_destroy(&diags);
    }
    TAP_RESULT(clean && total > 5, "%s: nothing leaks, whichever of %zu allocations fails", what,
               total);
    TAP_RESULT(told, "%s: no scene without a word", what);
}

static void test_memory(void) {
    char *filler = malloc(200001);
    memset(filler, 'x', 200000);
    filler[200000] = '\0';
    for (size_t i = 0; i < 200000; i += 60)
        filler[i] = '\n';
    char *classic = malloc(300000), *xml = malloc(300000);
    sprintf(
        classic,
        "#X3D V3.3 utf8\nPROTO P [ inputOutput SFVec3f s 1 1 1 ] { DEF T Transform { scale IS s } "
        "}\nDEF T P { s 1 2 3 } DEF Part EffectPart { url \"data:,a \\\"%s\" }\nDEF Image "
        "ImageTexture { url \"data:,abc\" } Inline { url \"none\" } Foo { } WorldInfo { info [ "
        "\"%.70000s\" ] } ROUTE T.s TO T.s",
        filler, filler);
    sprintf(
        xml,
        "<X3D><Scene><ProtoDeclare name='P'><ProtoInterface><field name='s' type='SFVec3f' "
        "accessType='inputOutput' value='1 1 1'/></ProtoInterface><ProtoBody><Transform><IS>"
        "<connect nodeField='scale' protoField='s'/></IS></Transform></ProtoBody></ProtoDeclare>"
        "<ProtoInstance name='P' DEF='T'/><EffectPart DEF='Part'><![CDATA[%s]]></EffectPart>"
        "<ImageTexture DEF='Image' url='\"data:,abc\"'/><WorldInfo info='\"%.70000s &lt;\"'/>"
        "<Group><Foo/></Group></Scene></X3D>",
        filler, filler);
    test_allocations("Classic", classic);
    test_allocations("XML", xml);
    free(filler), free(classic), free(xml);
}

int main(void) {
    test_nesting();
    test_counts();
    test_squares();
    test_growth();
    test_entities();
    test_broken();
    test_memory();
    return tap_done();
}
