/* glTF files that are wrong, cut or hostile: what is reported where, and what is kept. */
#include "gltf_text.h"

/* A triangle whose parts the cases replace: they stand at known columns of line 2. */
#define NODES "'nodes':[{'mesh':0}],'scenes':[{'nodes':[0]}],"
#define VIEWS "'bufferViews':[{'buffer':0,'byteLength':48}],"
#define POINTS "{'bufferView':0,'count':3,'componentType':5126,'type':'VEC3'}"
#define MESH "'meshes':[{'primitives':[{'attributes':{'POSITION':0},'indices':1}]}],"
#define MATERIAL                                                                                   \
    NODES VIEWS "'accessors':[" POINTS "],'meshes':[{'primitives':[{'attributes':{'POSITION':0},"  \
                "'material':0}]}],\n"

static bytes data(void) {
    bytes b = {0};
    PUT_FLOATS(&b, 0, 0, 0, 1, 0, 0, 0, 1, 0);
    PUT_INTS(&b, 0, 1, 9);
    return b;
}

/* `drawn`: the number of shapes that are kept. */
typedef struct fault_case {
    const char *what, *body, *faults;
    int drawn;
} fault_case;

static int count_shapes(const plr_scene *scene) {
    int count = 0;
    for (size_t i = 0; i < plr_scene_root_count(scene); i++)
        count += first_below(plr_scene_root(scene, i), "Shape") != NULL;
    return count;
}

static void run(const fault_case *cases, size_t count) {
    bytes b = data();
    for (size_t i = 0; i < count; i++) {
        plr_scene *scene = check_body(cases[i].what, &b, cases[i].body, cases[i].faults, NULL);
        CHECK_INT(count_shapes(scene), cases[i].drawn);
        plr_scene_destroy(&scene);
    }
}
#define RUN(cases) run(cases, sizeof(cases) / sizeof *(cases))

#define ACCESSORS(points)                                                                          \
    NODES VIEWS "'meshes':[{'primitives':[{'attributes':{'POSITION':0}}]}],\n"                     \
                "'accessors':[" points "]"

static const fault_case accessor_cases[] = {
    {"a count beyond the data",
     ACCESSORS("{'bufferView':0,'count':5,'componentType':5126,'type':'VEC3'}"),
     "3:14 error bad-value\n", 0},
    {"a count beyond all numbers",
     ACCESSORS("{'bufferView':0,'count':9007199254740991,'componentType':5126,'type':'VEC3'}"),
     "3:14 error bad-value\n", 0},
    {"a count and an offset that overflow together",
     ACCESSORS("{'bufferView':0,'byteOffset':9007199254740991,'count':2147483647,"
               "'componentType':5126,'type':'VEC3'}"),
     "3:14 error bad-value\n", 0},
    {"an offset a little too far",
     ACCESSORS("{'bufferView':0,'byteOffset':13,'count':3,'componentType':5126,'type':'VEC3'}"),
     "3:14 error bad-value\n", 0},
    {"no elements", ACCESSORS("{'bufferView':0,'count':0,'componentType':5126,'type':'VEC3'}"),
     "3:14 error bad-value\n", 0},
    {"half an element",
     ACCESSORS("{'bufferView':0,'count':1.5,'componentType':5126,'type':'VEC3'}"),
     "3:38 error bad-value\n", 0},
    {"fewer than none", ACCESSORS("{'bufferView':0,'count':-3,'componentType':5126,'type':'VEC3'}"),
     "3:38 error bad-value\n", 0},
    {"an unknown type of components",
     ACCESSORS("{'bufferView':0,'count':3,'componentType':5124,'type':'VEC3'}"),
     "3:56 error bad-value\n", 0},
    {"an unknown type", ACCESSORS("{'bufferView':0,'count':3,'componentType':5126,'type':'VEC5'}"),
     "3:68 error bad-value\n", 0},
    {"points in a plane",
     NODES VIEWS "'accessors':[{'bufferView':0,'count':3,'componentType':5126,'type':'VEC2'}],\n"
                 "'meshes':[{'primitives':[{'attributes':{'POSITION':0}}]}]",
     "3:52 error bad-geometry\n", 0},
    {"a view that does not exist",
     ACCESSORS("{'bufferView':1,'count':3,'componentType':5126,'type':'VEC3'}"),
     "3:28 error bad-value\n", 0},
    {"a view that is a word",
     ACCESSORS("{'bufferView':'x','count':3,'componentType':5126,'type':'VEC3'}"),
     "3:28 error bad-value\n", 0},
    {"an accessor that does not exist", ACCESSORS(""), "2:143 error bad-value\n", 0},
    {"an accessor that is a number", ACCESSORS("7"), "3:14 error bad-value\n", 0},
    {"more zeros than a file of this size may ask for",
     ACCESSORS("{'count':2147483647,'componentType':5126,'type':'VEC3'}"), "3:14 error limit\n", 0},
};

#define SPARSE(sparse)                                                                             \
    ACCESSORS("{'bufferView':0,'count':3,'componentType':5126,'type':'VEC3',\n'sparse':" sparse "}")

static const fault_case sparse_cases[] = {
    {"a sparse accessor without values",
     SPARSE("{'count':1,'indices':{'bufferView':0,'componentType':5125}}"),
     "4:10 error bad-value\n", 0},
    {"more sparse elements than elements",
     SPARSE(
         "{'count':4,'indices':{'bufferView':0,'componentType':5125},'values':{'bufferView':0}}"),
     "4:10 error bad-value\n", 0},
    {"a sparse index that is too large",
     SPARSE("{'count':1,'indices':{'bufferView':0,'byteOffset':44,'componentType':5125},"
            "'values':{'bufferView':0}}"),
     "3:14 error bad-value\n", 0},
    {"sparse indices beyond the data",
     SPARSE("{'count':1,'indices':{'bufferView':0,'byteOffset':45,'componentType':5125},"
            "'values':{'bufferView':0}}"),
     "4:31 error bad-value\n", 0},
    {"sparse values beyond the data",
     SPARSE("{'count':1,'indices':{'bufferView':0,'componentType':5125},"
            "'values':{'bufferView':0,'byteOffset':40}}"),
     "4:78 error bad-value\n", 0},
    {"sparse indices with signs",
     SPARSE("{'count':1,'indices':{'bufferView':0,'componentType':5120},"
            "'values':{'bufferView':0}}"),
     "4:31 error bad-value\n", 0},
};

static const fault_case view_cases[] = {
    {"a view longer than its buffer",
     NODES MESH "'accessors':[" POINTS "],\n'bufferViews':[{'buffer':0,'byteLength':49}]",
     "3:16 error bad-value\n", 0},
    {"a view that begins behind its buffer",
     NODES MESH "'accessors':[" POINTS "],\n'bufferViews':[{'buffer':0,'byteOffset':49,"
                "'byteLength':0}]",
     "3:16 error bad-value\n", 0},
    {"a view of no buffer",
     NODES MESH "'accessors':[" POINTS "],\n'bufferViews':[{'byteLength':40}]",
     "3:16 error bad-value\n", 0},
    {"a stride that is too large",
     NODES MESH "'accessors':[" POINTS "],\n'bufferViews':[{'buffer':0,'byteLength':48,"
                "'byteStride':256}]",
     "3:16 error bad-value\n", 0},
    {"a stride that is smaller than an element",
     NODES MESH "'bufferViews':[{'buffer':0,'byteLength':48,'byteStride':8}],\n"
                "'accessors':[" POINTS "]",
     "3:14 error bad-value\n", 0},
};

static const fault_case index_cases[] = {
    {"an index of no vertex",
     NODES VIEWS "'accessors':[" POINTS ",{'bufferView':0,'byteOffset':36,'count':3,"
                 "'componentType':5125,'type':'SCALAR'}],\n" MESH "'x':0",
     "3:65 error bad-geometry\n", 0},
    {"indices that are no integers",
     NODES VIEWS MESH "\n'accessors':[" POINTS ",\n{'bufferView':0,'count':3,"
                      "'componentType':5126,'type':'SCALAR'}]",
     "4:1 error bad-value\n", 0},
    {"indices that come in pairs",
     NODES VIEWS MESH "\n'accessors':[" POINTS ",\n{'bufferView':0,'count':3,"
                      "'componentType':5125,'type':'VEC2'}]",
     "4:1 error bad-value\n", 0},
    {"a mode that does not exist",
     NODES VIEWS "'accessors':[" POINTS "],\n'meshes':[{'primitives':[{'attributes':{'POSITION':0},"
                 "'mode':7}]}]",
     "3:62 error bad-value\n", 0},
    {"normals that are too few",
     NODES VIEWS "'accessors':[" POINTS ",{'bufferView':0,'count':2,'componentType':5126,"
                 "'type':'VEC3'}],\n"
                 "'meshes':[{'primitives':[{'attributes':{'POSITION':0,'NORMAL':1}}]}]",
     "3:63 error bad-geometry\n", 1},
    {"a primitive that is a number, beside a good one",
     NODES VIEWS "'accessors':[" POINTS "],\n"
                 "'meshes':[{'primitives':[5,{'attributes':{'POSITION':0}}]}]",
     "3:26 error bad-value\n", 1},
};

static const fault_case material_cases[] = {
    {"a material that does not exist", MATERIAL "'materials':[]", "2:233 error bad-value\n", 1},
    {"a material that is a list", MATERIAL "'materials':[[]]", "3:14 error bad-value\n", 1},
    {"an unknown mode of alpha", MATERIAL "'materials':[{'alphaMode':'FADE'}]",
     "3:27 error bad-value\n", 1},
    {"factors out of range",
     MATERIAL "'materials':[{'pbrMetallicRoughness':{'metallicFactor':2,'roughnessFactor':-1}}]",
     "3:56 warning bad-range\n3:76 warning bad-range\n", 1},
    {"a colour of three numbers",
     MATERIAL "'materials':[{'pbrMetallicRoughness':{'baseColorFactor':[1,1,1]}}]",
     "3:57 error bad-value\n", 1},
    {"a number that is too large", MATERIAL "'materials':[{'emissiveFactor':[1e99,1,1]}]",
     "3:32 error bad-value\n", 1},
    {"a texture without index", MATERIAL "'materials':[{'normalTexture':{}}]",
     "3:31 error bad-value\n", 1},
    {"a texture that does not exist", MATERIAL "'materials':[{'normalTexture':{'index':0}}]",
     "3:40 error bad-value\n", 1},
    {"a texture without image",
     MATERIAL "'materials':[{'normalTexture':{'index':0}}],\n'textures':[{}]",
     "4:13 warning not-drawn\n", 1},
    {"an image without data",
     MATERIAL "'materials':[{'normalTexture':{'index':0}}],\n'textures':[{'source':0}],\n"
              "'images':[{}]",
     "5:11 error bad-value\n", 1},
    {"a sampler of no kind",
     MATERIAL "'materials':[{'normalTexture':{'index':0}}],\n'textures':[{'source':0,'sampler':0}],"
              "\n'images':[{'uri':'x'}],\n'samplers':[{'wrapS':7}]",
     "6:22 error bad-value\n", 1},
};

static const fault_case node_cases[] = {
    {"a node that contains itself", "\n'nodes':[{'children':[0]}],'scenes':[{'nodes':[0]}]",
     "3:23 error recursion\n", 0},
    {"a ring of nodes",
     "\n'nodes':[{'children':[1]},{'children':[2]},{'children':[0]}],'scenes':[{'nodes':[0]}]",
     "3:57 error recursion\n", 0},
    {"a child of two", "\n'nodes':[{'children':[1,1]},{}],'scenes':[{'nodes':[0,1]}]",
     "3:25 error recursion\n3:55 error recursion\n", 0},
    {"children that are no list", "\n'nodes':[{'children':0}],'scenes':[{'nodes':[0]}]",
     "3:22 error bad-value\n", 0},
    {"a scene that does not exist", "\n'scene':3,'nodes':[{}],'scenes':[{'nodes':[0]}]",
     "3:9 error bad-value\n", 0},
    {"a light that does not exist",
     "\n'nodes':[{'extensions':{'KHR_lights_punctual':{'light':0}}}],'scenes':[{'nodes':[0]}]",
     "3:56 error bad-value\n", 0},
    {"a light of no kind",
     "\n'extensions':{'KHR_lights_punctual':{'lights':[{'type':'area'}]}},\n"
     "'nodes':[{'extensions':{'KHR_lights_punctual':{'light':0}}}],'scenes':[{'nodes':[0]}]",
     "3:56 error bad-value\n", 0},
    {"a camera of no kind", "\n'cameras':[{}],'nodes':[{'camera':0}],'scenes':[{'nodes':[0]}]",
     "3:12 error bad-value\n", 0},
    {"tables that are objects", "\n'nodes':{},'scenes':[{'nodes':[0]}]",
     "3:9 error bad-value\n3:32 error bad-value\n", 0},
};

/* What is known, but not drawn: one word each. */
static const fault_case notice_cases[] = {
    {"extensions that are used",
     NODES VIEWS "'accessors':[" POINTS "],'meshes':[{'primitives':[{'attributes':{'POSITION':0}}]}"
                 "],\n'extensionsUsed':['KHR_texture_transform','KHR_materials_clearcoat']",
     "3:43 warning not-drawn\n", 1},
    {"an extension that is required by one primitive",
     NODES VIEWS "'accessors':[" POINTS "],'meshes':[{'primitives':[{'attributes':{'POSITION':0},"
                 "'extensions':{'X_packed':{}}}]}],\n'extensionsUsed':['X_packed'],\n"
                 "'extensionsRequired':['X_packed']",
     "4:23 error extension\n", 0},
    {"an extension that is required elsewhere",
     NODES VIEWS "'accessors':[" POINTS "],'meshes':[{'primitives':[{'attributes':{'POSITION':0}}]}"
                 "],\n'extensionsRequired':['X_packed','KHR_mesh_quantization']",
     "3:23 error extension\n", 1},
    {"skins, morph targets and animations",
     "'nodes':[{'mesh':0,'skin':0},{'mesh':0,'skin':0}],'scenes':[{'nodes':[0,1]}],\n" VIEWS
     "'accessors':[" POINTS "],'skins':[{'joints':[0]}],\n'meshes':[{'primitives':[{'attributes':{"
     "'POSITION':0},'targets':[{'POSITION':0}]},{'attributes':{'POSITION':0},'targets':[{}]}]}],\n"
     "'animations':[{'channels':[],'samplers':[]}]",
     "4:65 warning not-drawn\n2:27 warning not-drawn\n5:14 warning not-drawn\n", 2},
};

/* A value that is no number: the triangle is left out. */
static void test_not_finite(void) {
    bytes b = {0};
    PUT_FLOATS(&b, 0, 0, 0, 1, 0, 0, 0);
    PUT_INTS(&b, 0x7fc00000, 0, 0, 0, 0);
    check_gltf("a coordinate that is not finite", &b, ACCESSORS(POINTS), "3:14 error bad-value\n",
               NULL);
}

/* ---- JSON ---- */

static void test_json(void) {
    static const struct {
        const char *text, *faults;
    } cases[] = {
        {"{", "1:2 error syntax\n"},
        {"{\"asset\":\n1} 3", "2:4 error syntax\n"},
        {"{\"asset\":{},\n\"nodes\":[1 2]}", "2:12 error syntax\n"},
        {"{\"asset\":{},\n\"nodes\":[tru]}", "2:10 error syntax\n"},
        {"{\"asset\":\"\xff\"}", "1:11 error syntax\n"},
        {"{\"asset\":{}\n", "2:1 error syntax\n"},
        {" \n {}", "2:2 error syntax\n"},
        {"{\"X3D\":{\"encoding\":\"UTF-8\"}}", "1:1 error syntax\n"},
        {"{\"asset\":{\"version\":\"1.0\"}}", "1:21 error syntax\n"},
        {"{\"asset\":{\"version\":\"2.1\",\"minVersion\":\"2.1\"}}", "1:40 error syntax\n"},
        {"{\"asset\":{\"version\":\"2.9\"},\"nodes\":3}", "1:36 error bad-value\n"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        check_only_faults("text that is no glTF", cases[i].text, cases[i].faults);
}

static void test_depth(void) {
    enum {
        DEPTH = 100000
    };
    char *text = malloc(DEPTH + 20);
    strcpy(text, "{\"asset\":");
    memset(text + 9, '[', DEPTH);
    text[9 + DEPTH] = '\0';
    check_only_faults("JSON that is nested deep", text, "1:209 error limit\n");
    free(text);
    text = malloc(DEPTH * 24);
    size_t used =
        (size_t)sprintf(text, "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}"
                              "],\n\"nodes\":[\n");
    for (int i = 1; i < 3000; i++)
        used += (size_t)sprintf(text + used, "{\"children\":[%d]},\n", i);
    strcpy(text + used, "{}]}");
    check_only_faults("nodes that are nested deep", text, "515:1 error limit\n");
    free(text);
}

/* ---- GLB ---- */

static void put_chunk(bytes *b, uint32_t kind, const char *text, size_t length) {
    PUT_INTS(b, (uint32_t)length, kind);
    put(b, text, length);
}

static plr_scene *read_bytes(const char *what, const bytes *b, const char *faults) {
    plr_diags *diags = plr_diags_create(NULL);
    plr_scene *scene = plr_scene_parse((const char *)b->data, b->length, "scene.glb", NULL, diags);
    check_these_faults(what, diags, faults);
    plr_diags_destroy(&diags);
    return scene;
}

static const char json_of_glb[] =
    "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":36}],\"nodes\":[{\"mesh\":0}],"
    "\"scenes\":[{\"nodes\":[0]}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}]"
    ",\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],\n\"accessors\":[{\"bufferView\":0,"
    "\"count\":3,\"componentType\":5126,\"type\":\"VEC3\"}]}   ";
enum {
    JSON_CHUNK = 0x4e4f534a,
    BINARY_CHUNK = 0x004e4942,
    JSON_LENGTH = (sizeof json_of_glb - 1) / 4 * 4
};

static bytes glb(uint32_t version, size_t binary) {
    const float points[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    bytes b = {0};
    PUT_BYTES(&b, 'g', 'l', 'T', 'F');
    PUT_INTS(&b, version, 0);
    put_chunk(&b, JSON_CHUNK, json_of_glb, JSON_LENGTH);
    put_chunk(&b, 0x12345678, "????????", 8); /* unknown chunks are passed over */
    put_chunk(&b, BINARY_CHUNK, (const char *)points, binary);
    uint32_t length = (uint32_t)b.length;
    memcpy(b.data + 8, &length, 4);
    return b;
}

static void test_glb(void) {
    bytes b = glb(2, 36);
    plr_scene *scene = read_bytes("a GLB file", &b, "");
    CHECK_NUMBERS(first_of(scene, "Coordinate"), "point", 0, 0, 0, 1, 0, 0, 0, 1, 0);
    plr_scene_destroy(&scene);
    b = glb(2, 32); /* places are those of the JSON text */
    scene = read_bytes("a GLB file whose data are too short", &b,
                       "1:39 error bad-value\n1:177 error bad-value\n");
    size_t length = 0;
    const char *line = plr_scene_line(scene, "scene.glb", 2, &length);
    CHECK(line && strncmp(line, "\"accessors\"", 11) == 0);
    plr_scene_destroy(&scene);
    b = glb(1, 36);
    scene = read_bytes("version 1 of GLB", &b, "0:0 error syntax\n");
    plr_scene_destroy(&scene);
    for (size_t length_there = 4; length_there < b.length; length_there += 7) {
        bytes cut = glb(2, 36); /* wherever it is cut, with a length that hides it or not */
        cut.length = length_there;
        uint32_t declared = (uint32_t)length_there;
        if (length_there % 2 && length_there >= 12)
            memcpy(cut.data + 8, &declared, 4);
        plr_diags *diags = plr_diags_create(NULL);
        scene = plr_scene_parse((const char *)cut.data, cut.length, "cut.glb", NULL, diags);
        if (!plr_diags_count_of(diags, PLR_ERROR))
            CHECK_STR("a cut GLB file", "is an error");
        plr_scene_destroy(&scene);
        plr_diags_destroy(&diags);
    }
}

/* Wherever memory runs out, there is a word about it, and nothing is lost (told by the sanitizer).
 */
static void test_memory(void) {
    bytes b = glb(2, 36);
    int scenes = 0, faults = 0, silent = 0;
    for (size_t most = 1000; most < 1000000; most += most / 7) {
        plr_read_desc desc = {.max_memory = most};
        plr_diags *diags = plr_diags_create(NULL);
        plr_scene *scene =
            plr_scene_parse((const char *)b.data, b.length, "scene.glb", &desc, diags);
        size_t errors = plr_diags_count_of(diags, PLR_ERROR);
        scenes += scene && !errors;
        faults += errors > 0;
        silent += !scene && !errors;
        plr_scene_destroy(&scene);
        plr_diags_destroy(&diags);
    }
    CHECK(scenes > 5 && faults > 5 && silent == 0);
}

int main(void) {
    RUN(accessor_cases);
    RUN(sparse_cases);
    RUN(view_cases);
    RUN(index_cases);
    RUN(material_cases);
    RUN(node_cases);
    RUN(notice_cases);
    test_not_finite();
    test_json();
    test_depth();
    test_glb();
    test_memory();
    return tap_done();
}
