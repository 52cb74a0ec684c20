/* The document: container, version, extensions, and memory for its time. */
#include "x3d/gltf.h"

#include <string.h>

#include "x3d/gltf_internal.h"

enum {
    MOST_DEPTH = 200,       /* of the JSON; the standard needs about 10, `extras` may have more */
    MOST_VALUES = 50000000, /* of the JSON */
    MOST_UNKNOWN = 32,      /* extensions */
    LEAST_BUDGET = 1 << 24,
    GLB_HEADER = 12,
    GLB_CHUNK = 8
};

/* ---- GLB: ISO/IEC 12113 4.4 ---- */

static const uint32_t json_chunk = 0x4e4f534a, binary_chunk = 0x004e4942;

static bool is_glb(const x3d_file *file) {
    return file->length >= GLB_HEADER && memcmp(file->text, "glTF", 4) == 0;
}

bool x3d_is_gltf(const x3d_file *file) {
    if (is_glb(file))
        return true;
    size_t i = 0;
    while (i < file->length && memchr(" \t\r\n\xef\xbb\xbf", file->text[i], 7))
        i++;
    return i < file->length && file->text[i] == '{';
}

static uint32_t number_at(const char *at) {
    const unsigned char *b = (const unsigned char *)at;
    return (uint32_t)b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
}

static bool bad_glb(x3d_build *build, const char *message) {
    x3d_report(build->scene, PLR_CODE_SYNTAX, (plr_place){build->file->name, 0, 0}, "%s", message);
    return false;
}

/* The file's text becomes that of its JSON: places in messages count from there. */
static bool open_glb(x3d_build *build) {
    x3d_file *file = build->file;
    const char *all = file->text, *text = NULL;
    size_t end = number_at(all + 8), text_length = 0;
    if (number_at(all + 4) != 2)
        return bad_glb(build, "only version 2 of GLB is read");
    if (end > file->length)
        return bad_glb(build, "the GLB file ends before its declared length");
    for (size_t at = GLB_HEADER; end >= at && end - at >= GLB_CHUNK;) {
        size_t length = number_at(all + at);
        uint32_t kind = number_at(all + at + 4);
        at += GLB_CHUNK;
        if (length > end - at)
            return bad_glb(build, "a chunk of the GLB file is longer than the file");
        if (kind == json_chunk && !text) {
            text = all + at;
            text_length = length;
        } else if (kind == binary_chunk && text && !file->attached) {
            file->attached = all + at;
            file->attached_length = length;
        }
        at += length + (4 - length % 4) % 4;
    }
    if (!text)
        return bad_glb(build, "the GLB file has no JSON");
    file->text = text;
    file->length = text_length;
    file->line_hint = 0;
    x3d_file_index(&build->scene->arena, file);
    return true;
}

/* ---- What the document asks for ---- */

static const char *const known_extensions[] = {
    "KHR_materials_unlit",   "KHR_materials_emissive_strength", "KHR_lights_punctual",
    "KHR_texture_transform", "KHR_mesh_quantization",
};

static bool is_known(const x3d_json *name) {
    for (size_t i = 0; i < sizeof known_extensions / sizeof *known_extensions; i++)
        if (x3d_json_is(name, known_extensions[i]))
            return true;
    return false;
}

/* The names of a list that are not known, as far as there is room for them. */
static size_t unknown_names(gltf *g, const char *key, x3d_json *unknown) {
    const x3d_json *list = gltf_list(g, g->root, key);
    size_t count = 0;
    for (size_t i = 0; list && i < list->count && count < MOST_UNKNOWN; i++)
        if (list->value.items[i].kind == X3D_JSON_STRING && !is_known(&list->value.items[i]))
            unknown[count++] = list->value.items[i];
    return count;
}

static bool is_in(const x3d_json *name, const x3d_json *list) {
    for (size_t i = 0; i < list->count; i++)
        if (list->value.items[i].count == name->count &&
            memcmp(list->value.items[i].value.text, name->value.text, name->count) == 0)
            return true;
    return false;
}

static int shown(const x3d_json *name) {
    return name->count > 100 ? 100 : (int)name->count;
}

static void check_extensions(gltf *g) {
    x3d_json *required = PLR_NEW_ARRAY(g->scratch, MOST_UNKNOWN, x3d_json);
    x3d_json used[MOST_UNKNOWN];
    x3d_json *list = PLR_NEW(g->scratch, x3d_json);
    list->kind = X3D_JSON_ARRAY;
    list->count = unknown_names(g, "extensionsRequired", required);
    list->value.items = required;
    for (size_t i = 0; i < list->count; i++)
        x3d_report(g->scene, PLR_CODE_EXTENSION, gltf_place(g, &required[i]),
                   "the file requires '%.*s', which plugray does not read", shown(&required[i]),
                   required[i].value.text);
    g->unknown = list->count ? list : NULL;
    size_t count = unknown_names(g, "extensionsUsed", used);
    for (size_t i = 0; i < count; i++)
        if (!is_in(&used[i], list))
            x3d_report(g->scene, PLR_CODE_NOT_DRAWN, gltf_place(g, &used[i]),
                       "'%.*s' is not drawn yet", shown(&used[i]), used[i].value.text);
}

static bool check_version(gltf *g) {
    const x3d_json *asset = gltf_object(g, g->root, "asset");
    const x3d_json *version = gltf_text(g, asset, "version");
    if (!asset) {
        x3d_report(g->scene, PLR_CODE_SYNTAX, gltf_place(g, g->root),
                   "this JSON has no 'asset', so it is no glTF; other JSON is not read");
        return false;
    }
    const x3d_json *least = gltf_text(g, asset, "minVersion");
    if (version && version->count >= 2 && memcmp(version->value.text, "2.", 2) == 0 &&
        (!least || x3d_json_is(least, "2.0")))
        return true;
    x3d_report(g->scene, PLR_CODE_SYNTAX,
               gltf_place(g, least     ? least
                             : version ? version
                                       : asset),
               "only glTF 2.0 is read");
    return false;
}

static void tell_animations(gltf *g) {
    const x3d_json *animations = gltf_list(g, g->root, "animations");
    if (animations && animations->count)
        x3d_report(g->scene, PLR_CODE_NOT_DRAWN, gltf_place(g, animations),
                   "animations of glTF are not played yet");
}

static void make_room(gltf *g) {
    g->buffers = PLR_NEW_ARRAY(g->scratch, gltf_table_count(g, GLTF_BUFFERS), gltf_buffer);
    g->views = PLR_NEW_ARRAY(g->scratch, gltf_table_count(g, GLTF_VIEWS), gltf_view);
    g->accessors = PLR_NEW_ARRAY(g->scratch, gltf_table_count(g, GLTF_ACCESSORS), gltf_accessor);
    g->meshes = PLR_NEW_ARRAY(g->scratch, gltf_table_count(g, GLTF_MESHES), gltf_mesh);
    g->materials = PLR_NEW_ARRAY(g->scratch, gltf_table_count(g, GLTF_MATERIALS), gltf_material);
    g->nodes = PLR_NEW_ARRAY(g->scratch, gltf_table_count(g, GLTF_NODES), gltf_state);
    g->budget = LEAST_BUDGET + 8 * g->build->file->length;
    g->loadable = g->scene->max_memory;
}

static void read_document(gltf *g) {
    const x3d_file *file = g->build->file;
    x3d_json_limits limits = {MOST_DEPTH, MOST_VALUES};
    x3d_json_fault fault;
    g->root = x3d_json_parse(g->scratch, file->text, file->length, limits, &fault);
    if (!g->root) {
        x3d_report(g->scene, fault.limit ? PLR_CODE_LIMIT : PLR_CODE_SYNTAX,
                   x3d_file_place(g->build->file, fault.offset), "%s", fault.message);
        return;
    }
    if (!check_version(g))
        return;
    x3d_set_version(g->build, "4.0", 3); /* whose nodes these are */
    check_extensions(g);
    gltf_find_tables(g);
    make_room(g);
    gltf_read_scene(g);
    tell_animations(g);
}

void x3d_read_gltf(x3d_build *build) {
    plr_scene *scene = build->scene;
    if (is_glb(build->file) && !open_glb(build))
        return;
    plr_allocator counting = x3d_counting_allocator(scene);
    plr_arena *scratch = PLR_NEW(&scene->arena, plr_arena);
    jmp_buf *outer = scene->arena.out_of_memory, here;
    gltf *volatile held = NULL;
    plr_arena_init(scratch, &counting, &here);
    scene->arena.out_of_memory = &here;
    bool failed = setjmp(here) != 0;
    if (!failed) {
        gltf *g = PLR_NEW(scratch, gltf);
        *g = (gltf){.build = build, .scene = scene, .scratch = scratch};
        held = g;
        read_document(g);
    }
    scene->arena.out_of_memory = outer;
    if (held)
        gltf_free_buffers(held);
    plr_arena_finish(scratch);
    if (failed)
        longjmp(*outer, 1);
}
