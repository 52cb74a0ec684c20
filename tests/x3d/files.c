/* Inline, EXTERNPROTO, IMPORT and EXPORT, code in files, gzip, and what may be read at all. Works
 * in a folder of its own. */
#define _XOPEN_SOURCE 700
#include "checks.h"

#include <dirent.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

static char top[] = "/tmp/plugray-files-XXXXXX";

static void write_file(const char *name, const char *content) {
    FILE *file = fopen(name, "w");
    if (file) {
        fwrite(content, 1, strlen(content), file);
        fclose(file);
    }
}

static void remove_tree(const char *path) {
    DIR *dir = opendir(path);
    for (struct dirent *entry; dir && (entry = readdir(dir));) {
        char name[1024];
        struct stat status;
        if (strcmp(entry->d_name, ".") == 0 || strcmp(entry->d_name, "..") == 0)
            continue;
        snprintf(name, sizeof name, "%s/%s", path, entry->d_name);
        if (lstat(name, &status) == 0 && S_ISDIR(status.st_mode))
            remove_tree(name);
        else
            unlink(name);
    }
    if (dir)
        closedir(dir);
    rmdir(path);
}

/* Reads a file and checks the faults. */
static plr_scene *read_checked(const char *what, const char *path, const plr_read_desc *desc,
                               const char *expected) {
    plr_diags *diags = plr_diags_create(NULL);
    plr_scene *scene = plr_scene_read(path, desc, diags);
    check_these_faults(what, diags, expected);
    plr_diags_destroy(&diags);
    return scene;
}

static void read_only_checked(const char *what, const char *path, const char *expected) {
    plr_scene *scene = read_checked(what, path, NULL, expected);
    plr_scene_destroy(&scene);
}

static void test_inline(void) {
    write_file("main.x3dv", CLASSIC("DEF I Inline { url [ \"missing.x3d\" \"sub/part.x3d\" ] }\n"
                                    "IMPORT I.Out AS Ball\nROUTE Ball.translation_changed TO "
                                    "Ball.scale Group { children USE Ball }"));
    mkdir("sub", 0777);
    write_file("sub/part.x3d",
               XML("<Transform DEF='B'><Inline url='\"../other.x3dv\"'/></Transform><EXPORT "
                   "localDEF='B' AS='Out'/><Effect DEF='E'><EffectPart>\n<![CDATA[\n  "
                   "word;]]></EffectPart></Effect><Effect DEF='F'><EffectPart url='\"code.glsl\"'/>"
                   "</Effect>"));
    write_file("sub/code.glsl", "int x;\nword");
    write_file("other.x3dv", CLASSIC("Shape { geometry Box { sze 1 } }"));
    plr_diags *diags = plr_diags_create(NULL);
    plr_scene *scene = plr_scene_read("main.x3dv", NULL, diags);
    check_these_faults("inlined files", diags, "3:24 warning unknown-field\n");
    CHECK_STR(plr_diags_get(diags, 0)->place.file, "sub/../other.x3dv");
    const plr_node *inlined = plr_scene_root(scene, 0);
    const plr_field *children = plr_node_field(inlined, "children");
    CHECK_INT(children->count, 3);
    plr_node *ball = children->value.nodes[0];
    CHECK_STR(plr_node_type(plr_node_child(ball, "children")), "Inline");
    CHECK_STR(plr_node_type(plr_node_child(plr_node_child(ball, "children"), "children")), "Shape");
    CHECK_INT(plr_scene_route_count(scene), 1);
    CHECK(plr_scene_route(scene, 0)->from == ball);
    CHECK(plr_node_child(plr_scene_root(scene, 1), "children") == ball);
    CHECK(plr_scene_find(scene, "B") == NULL);
    plr_string code;
    CHECK(plr_scene_code(scene, plr_node_child(children->value.nodes[1], "parts"), "url", &code,
                         diags));
    check_place("CDATA in an inlined file", &code, "word", "sub/part.x3d", 3, 3);
    CHECK(plr_scene_code(scene, plr_node_child(children->value.nodes[2], "parts"), "url", &code,
                         diags));
    check_place("code in a file", &code, "word", "sub/code.glsl", 2, 1);
    size_t length = 0;
    const char *line = plr_scene_line(scene, "sub/code.glsl", 2, &length);
    CHECK(line && length == 4 && memcmp(line, "word", 4) == 0);
    plr_scene_destroy(&scene);
    plr_diags_destroy(&diags);
}

static void test_inline_faults(void) {
    write_file("self.x3dv", CLASSIC("Group { children Inline { url \"self.x3dv\" } }"));
    read_only_checked("a file that inlines itself", "self.x3dv", "3:32 error recursion\n");
    write_file("a.x3dv", CLASSIC("Inline { url \"b.x3d\" }"));
    write_file("b.x3d", XML("<Inline url='\"a.x3dv\"'/>"));
    read_only_checked("files that inline each other", "a.x3dv", "1:41 error recursion\n");
    write_file("gone.x3dv",
               CLASSIC("Inline { url \"nowhere.x3d\" } Inline { load FALSE url \"x\" }"));
    read_only_checked("a missing file", "gone.x3dv", "3:15 error missing-file\n");
    read_only_checked("a scene that is missing", "none.x3dv", "0:0 error missing-file\n");
    read_only_checked("a folder for a scene", "sub", "0:0 error not-allowed\n");
    write_file("import.x3dv",
               CLASSIC("DEF I Inline { url \"sub/part.x3d\" }\nIMPORT I.B\nIMPORT J.B\n"
                       "DEF G Group { } IMPORT G.x EXPORT Nix"));
    read_only_checked("IMPORT that leads nowhere", "import.x3dv",
                      "3:24 warning unknown-field\n4:10 error unknown-def\n5:8 error "
                      "unknown-def\n6:24 error unknown-def\n6:35 error unknown-def\n");
}

static void test_units(void) {
    write_file("mm.x3d",
               "<X3D><head><unit category='length' name='mm' conversionFactor='0.001'/>"
               "<unit category='angle' name='deg' conversionFactor='0.5'/></head><Scene>"
               "<Transform rotation='0 0 1 2'/><SpotLight cutOffAngle='1.5'/></Scene></X3D>");
    write_file("units.x3dv", CLASSIC("UNIT length cm 0.01 Inline { url \"mm.x3d\" }"));
    plr_scene *scene = read_checked("units", "units.x3dv", NULL, "");
    const plr_node *wrapper = plr_node_child(plr_scene_root(scene, 0), "children");
    float numbers[4] = {0};
    plr_node_numbers(wrapper, "scale", numbers, 3);
    CHECK_NEAR(numbers[0], 0.1, 1e-7);
    plr_node_numbers(plr_node_child(wrapper, "children"), "rotation", numbers, 4);
    CHECK_NEAR(numbers[3], 1, 1e-7);
    const plr_node *light = plr_node_field(wrapper, "children")->value.nodes[1];
    CHECK_NEAR(plr_node_number(light, "cutOffAngle"), 0.75, 1e-7);
    plr_scene_destroy(&scene);
}

static void test_external_prototypes(void) {
    write_file("lib.x3dv",
               CLASSIC("PROTO First [ inputOutput SFFloat r 5 ] { Sphere { radius IS r } }\n"
                       "PROTO Second [ ] { Box { } }\nEXTERNPROTO Third [ ] \"lib2.x3d#Deep\"\n"
                       "Transform { } ROUTE nobody.x TO nobody.y"));
    write_file("lib2.x3d", XML("<ProtoDeclare name='Deep'><ProtoBody><Cone/></ProtoBody>"
                               "</ProtoDeclare>"));
    write_file("extern.x3dv",
               CLASSIC("EXTERNPROTO A [ inputOutput SFFloat r ] [ \"urn:x\" \"gone.x3dv#A\" "
                       "\"lib.x3dv\" ]\nEXTERNPROTO B [ ] \"lib.x3dv#Second\"\n"
                       "EXTERNPROTO C [ ] \"lib.x3dv#Third\"\n"
                       "EXTERNPROTO Toggler [ ] [ \"urn:castle-engine.org:node:Toggler\" ]\n"
                       "EXTERNPROTO D [ ] \"lib.x3dv#Nope\" EXTERNPROTO Unused [ ] \"gone.x3dv\"\n"
                       "Group { children [ Shape { geometry A { r 2 } } Shape { geometry B { } } "
                       "Shape { geometry C { } } D { } D { } ] } Toggler { }"));
    plr_scene *scene =
        read_checked("external prototypes", "extern.x3dv", NULL, "7:20 error bad-proto\n");
    char *dump = dump_scene(scene);
    CHECK(strstr(dump, "Sphere -\n     .radius SFFloat 2") != NULL);
    CHECK(strstr(dump, "Box -") && strstr(dump, "Cone -") && strstr(dump, "Toggler -"));
    CHECK_INT(plr_scene_route_count(scene), 0);
    free(dump);
    plr_scene_destroy(&scene);
    write_file("extern.x3d",
               XML("<ExternProtoDeclare name='A' url='\"lib.x3dv#First\"'><field name='r' "
                   "type='SFFloat' accessType='inputOutput'/></ExternProtoDeclare>"
                   "<Shape><ProtoInstance name='A'><fieldValue name='r' value='3'/></ProtoInstance>"
                   "</Shape>"));
    scene = read_checked("external prototypes in XML", "extern.x3d", NULL, "");
    CHECK_NEAR(plr_node_number(plr_node_child(plr_scene_root(scene, 0), "geometry"), "radius"), 3,
               0);
    plr_scene_destroy(&scene);
}

/* How one url of a scene in scene/ is judged. */
static void check_url(const char *url, const plr_read_desc *desc, const char *expected) {
    char text[2000];
    snprintf(text, sizeof text, CLASSIC("ImageTexture { url \"%s\" }"), url);
    plr_diags *diags = plr_diags_create(NULL);
    plr_scene *scene = plr_scene_parse(text, strlen(text), "scene/s.x3dv", desc, diags);
    plr_bytes bytes;
    bool ok = plr_scene_load_first(scene, plr_node_field(plr_scene_root(scene, 0), "url"), false,
                                   &bytes, NULL, diags);
    const char *code = plr_diags_count(diags) ? plr_code_text(plr_diags_get(diags, 0)->code) : "";
    TAP_RESULT(strcmp(code, expected) == 0 && ok == !*expected, "%s: %s", url,
               *expected ? expected : "read");
    if (strcmp(code, expected) != 0 && plr_diags_count(diags))
        printf("#   %s\n", plr_diags_get(diags, 0)->message);
    if (ok)
        CHECK(bytes.length == 4 && strcmp(bytes.data, "data") == 0);
    plr_bytes_free(&bytes);
    plr_scene_destroy(&scene);
    plr_diags_destroy(&diags);
}

static void test_rules(void) {
    char absolute[200], url[300];
    mkdir("scene", 0777), mkdir("scene/in", 0777), mkdir("outside", 0777), mkdir("scenery", 0777);
    write_file("scene/in/f", "data"), write_file("outside/f", "data"),
        write_file("scenery/f", "data");
    write_file("scene/a b", "data"), write_file("scene/a%20b", "data");
    CHECK(symlink("../../outside/f", "scene/in/link") == 0);
    CHECK(symlink("../outside", "scene/folder") == 0);
    CHECK(symlink("in/f", "scene/good") == 0);
    CHECK(mkfifo("scene/fifo", 0600) == 0);
    check_url("in/f", NULL, "");
    check_url("in/../in/./f", NULL, "");
    check_url("good", NULL, "");
    check_url("in/link", NULL, "not-allowed");
    check_url("folder/f", NULL, "not-allowed");
    check_url("../outside/f", NULL, "not-allowed");
    check_url("../scenery/f", NULL, "not-allowed");
    check_url("../outside/none", NULL, "not-allowed");
    check_url("/etc/passwd", NULL, "not-allowed");
    check_url("/dev/null", NULL, "not-allowed");
    check_url("in/none", NULL, "missing-file");
    check_url("in", NULL, "not-allowed");
    check_url("fifo", NULL, "not-allowed");
    check_url("", NULL, "missing-file");
    check_url("http://example.org/f", NULL, "not-allowed");
    check_url("castle-data:/f", NULL, "missing-file");
    check_url("a b", NULL, "");
    check_url("a%20b", NULL, "");
    snprintf(absolute, sizeof absolute, "%s/scene/in/f", top);
    check_url(absolute, NULL, "");
    snprintf(url, sizeof url, "file://%s/scene/a%%20b", top);
    check_url(url, NULL, "");
    snprintf(url, sizeof url, "file://%s/scene/in/%%2e%%2e/%%2e%%2e/outside/f", top);
    check_url(url, NULL, "not-allowed");
    check_url("data:text/plain,data", NULL, "");
    check_url("data:;base64,ZGF0YQ==", NULL, "");
    check_url("data:;base64,Z*", NULL, "bad-value");
    const char *const allowed[] = {"outside"};
    plr_read_desc desc = {.rules = {.allowed = allowed, .allowed_count = 1}};
    check_url("../outside/f", &desc, "");
    check_url("in/link", &desc, "");
    check_url("../scenery/f", &desc, "not-allowed");
    plr_read_desc small = {.rules = {.max_bytes = 3}};
    plr_scene *scene =
        read_checked("a file beyond the limit", "main.x3dv", &small, "0:0 error limit\n");
    CHECK(scene == NULL);
}

static char *fetch(void *user, const char *url, size_t *length) {
    ++*(int *)user;
    if (strcmp(url, "https://example.org/f") != 0)
        return NULL;
    char *data = malloc(4);
    memcpy(data, "data", 4);
    *length = 4;
    return data;
}

static void test_network(void) {
    int calls = 0;
    plr_read_desc desc = {.rules = {.allow_network = true, .fetch = fetch, .user = &calls}};
    check_url("https://example.org/f", &desc, "");
    check_url("http://example.org/none", &desc, "missing-file");
    CHECK_INT(calls, 2);
    desc.rules.allow_network = false;
    check_url("https://example.org/f", &desc, "not-allowed");
    CHECK_INT(calls, 2);
}

static void write_gzip(const char *name, const char *content) {
    gzFile file = gzopen(name, "wb");
    gzputs(file, content);
    gzclose(file);
}

static void cut_file(const char *name, long by) {
    struct stat status;
    CHECK(stat(name, &status) == 0 && truncate(name, status.st_size - by) == 0);
}

static void test_gzip(void) {
    write_gzip("packed.x3dvz", CLASSIC("Group { children Inline { url \"packed.x3dz\" } }"));
    write_gzip("packed.x3dz", XML("<Shape DEF='S'/>\n<Foo/>"));
    read_only_checked("gzipped scenes", "packed.x3dvz", "2:1 warning unknown-node\n");
    write_gzip("cut.x3dz", XML("<Shape DEF='S'/><Shape/><Group/><Transform/>"));
    cut_file("cut.x3dz", 12);
    read_only_checked("a truncated gzip file", "cut.x3dz", "0:0 error missing-file\n");
    char *zeros = malloc(3000001);
    memset(zeros, ' ', 3000000);
    zeros[3000000] = '\0';
    write_gzip("bomb.x3dz", zeros);
    free(zeros);
    plr_read_desc desc = {.rules = {.max_bytes = 1000000}};
    plr_scene *scene = read_checked("a file that unpacks beyond the limit", "bomb.x3dz", &desc,
                                    "0:0 error limit\n");
    CHECK(scene == NULL);
}

typedef struct told {
    int calls;
    double last;
    bool in_order, named;
} told;

static void hear(void *user, const char *name, double done) {
    told *t = user;
    t->in_order = t->in_order && done >= t->last && done <= 1;
    t->named = t->named && strcmp(name, "long.x3dvz") == 0;
    t->last = done;
    t->calls++;
}

/* Long files are told of while they are unpacked, short ones are not. */
static void test_progress(void) {
    enum {
        LENGTH = 40 << 20
    };
    char *blanks = malloc(LENGTH + 1);
    memset(blanks, ' ', LENGTH);
    memcpy(blanks, CLASSIC("\n"), strlen(CLASSIC("\n")));
    blanks[LENGTH] = '\0';
    write_gzip("long.x3dvz", blanks);
    free(blanks);
    told t = {0, 0, true, true};
    plr_read_desc desc = {.rules = {.progress = hear, .user = &t}};
    plr_scene *scene = read_checked("a long file", "long.x3dvz", &desc, "");
    plr_scene_destroy(&scene);
    CHECK(t.calls >= 2 && t.calls < 100 && t.in_order && t.named && t.last == 1);
    t = (told){0, 0, true, true};
    write_gzip("short.x3dvz", CLASSIC("\n"));
    scene = read_checked("a short file", "short.x3dvz", &desc, "");
    plr_scene_progress(scene, "long.x3dvz", 0.5);
    CHECK(t.calls == 1 && t.last == 0.5);
    plr_scene_destroy(&scene);
}

static void test_beside(void) {
    mkdir("scene/deep", 0777);
    write_file("scene/deep/head", "data"), write_file("scene/deep/body", "data");
    plr_diags *diags = plr_diags_create(NULL);
    const char *text = CLASSIC("ImageTexture3D { url \"deep/head\" }");
    plr_scene *scene = plr_scene_parse(text, strlen(text), "scene/s.x3dv", NULL, diags);
    plr_bytes head = {0}, body = {0};
    const plr_field *url = plr_node_field(plr_scene_root(scene, 0), "url");
    CHECK(plr_scene_load(scene, &url->value.strings[0], false, &head, diags));
    CHECK_STR(head.name, "scene/deep/head");
    CHECK(plr_scene_load_beside(scene, head.name, "body", false, url->place, &body, diags));
    CHECK_STR(body.name, "scene/deep/body");
    plr_bytes_free(&body);
    CHECK(!plr_scene_load_beside(scene, head.name, "../../outside/f", false, url->place, &body,
                                 diags));
    CHECK_STR(plr_code_text(plr_diags_get(diags, 0)->code), "not-allowed");
    CHECK_INT(plr_diags_get(diags, 0)->place.line, 3);
    plr_bytes_free(&head);
    plr_scene_destroy(&scene);
    plr_diags_destroy(&diags);
}

/* What a folder holds, with '|' after each name, or the code of the fault. */
static void check_folder(const char *url, size_t limit, const char *expected) {
    char text[2000], got[500] = "";
    snprintf(text, sizeof text, CLASSIC("ImageTexture3D { url \"%s\" }"), url);
    plr_diags *diags = plr_diags_create(NULL);
    plr_scene *scene = plr_scene_parse(text, strlen(text), "scene/s.x3dv", NULL, diags);
    const plr_string *string = plr_node_field(plr_scene_root(scene, 0), "url")->value.strings;
    plr_bytes names, bytes;
    if (plr_scene_list(scene, string, limit, &names, diags)) {
        for (const char *name = names.data; name < names.data + names.length;
             name += strlen(name) + 1) {
            bool read =
                plr_scene_load_beside(scene, names.name, name, false, (plr_place){0}, &bytes, NULL);
            snprintf(got + strlen(got), sizeof got - strlen(got), "%s%s|", name, read ? "" : "!");
            plr_bytes_free(&bytes);
        }
        CHECK_INT(names.data[names.length], 0);
    } else {
        snprintf(got, sizeof got, "%s", plr_code_text(plr_diags_get(diags, 0)->code));
        CHECK_INT(plr_diags_get(diags, 0)->place.line, 3);
    }
    TAP_RESULT(strcmp(got, expected) == 0, "folder %s: %s", url, expected);
    if (strcmp(got, expected) != 0)
        printf("#   %s\n", got);
    plr_bytes_free(&names);
    plr_scene_destroy(&scene);
    plr_diags_destroy(&diags);
}

static void test_folders(void) {
    char absolute[200];
    mkdir("scene/scan", 0777), mkdir("scene/scan/deeper", 0777), mkdir("scene/none", 0777);
    const char *const files[] = {"b", "a", "c10", ".hidden"};
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        char name[64];
        snprintf(name, sizeof name, "scene/scan/%s", files[i]);
        write_file(name, "data");
    }
    CHECK(symlink("../../outside/f", "scene/scan/out") == 0);
    CHECK(symlink("../in/f", "scene/scan/link") == 0);
    CHECK(symlink("scan", "scene/again") == 0);
    check_folder("scan/", 10, "a|b|c10|link|out!|");
    check_folder("scan/", 5, "a|b|c10|link|out!|");
    check_folder("scan/", 4, "limit");
    check_folder("scan/#1.2.3", 10, "a|b|c10|link|out!|");
    check_folder("again/", 10, "a|b|c10|link|out!|");
    check_folder("none/", 10, "");
    check_folder("scan", 10, "missing-file");
    check_folder("gone/", 10, "missing-file");
    check_folder("in/f/", 10, "missing-file");
    check_folder("folder/", 10, "not-allowed");
    check_folder("../outside/", 10, "not-allowed");
    check_folder("/", 10, "not-allowed");
    check_folder("http://example.org/", 10, "not-allowed");
    snprintf(absolute, sizeof absolute, "%s/scene/scan/", top);
    check_folder(absolute, 10, "a|b|c10|link|out!|");
}

static void test_urls_of_folders(void) {
    const struct {
        const char *text;
        bool folder;
    } urls[] = {{"a/", true},   {"/", true},        {"a/#b", true},      {"a/#b/c", true},
                {"a", false},   {"", false},        {"#a/", false},      {"a#b/", false},
                {"a/b", false}, {"data:,/", false}, {"file:///a/", true}};
    for (size_t i = 0; i < sizeof urls / sizeof *urls; i++) {
        const plr_string url = {.text = urls[i].text, .length = strlen(urls[i].text)};
        TAP_RESULT(plr_url_is_folder(&url) == urls[i].folder, "'%s' means a %s", urls[i].text,
                   urls[i].folder ? "folder" : "file");
    }
}

int main(void) {
    if (!mkdtemp(top) || chdir(top) != 0)
        return 1;
    test_inline();
    test_inline_faults();
    test_units();
    test_external_prototypes();
    test_rules();
    test_network();
    test_gzip();
    test_progress();
    test_beside();
    test_folders();
    test_urls_of_folders();
    if (chdir("/") == 0)
        remove_tree(top);
    return tap_done();
}
