/* From a path or a text to a scene. */
#include "x3d/read.h"

#include <string.h>

#include "x3d/build.h"
#include "x3d/files.h"
#include "x3d/gltf.h"

enum {
    USUAL_DEPTH = 512,
    MOST_DEPTH = 2000,
    USUAL_NODES = 10000000,
    NEAREST_BUDGET = 200000,
    WORK_BUDGET = 1000000000
};

x3d_file *x3d_add_file(plr_scene *scene, const char *name, const char *folder, const char *real,
                       char *data, size_t length) {
    jmp_buf *outer = scene->arena.out_of_memory, here;
    scene->arena.out_of_memory = &here;
    if (setjmp(here) != 0) {
        x3d_block_free(data);
        scene->arena.out_of_memory = outer;
        longjmp(*outer, 1);
    }
    x3d_file *file = PLR_NEW(&scene->arena, x3d_file);
    file->name = plr_arena_copy(&scene->arena, name, strlen(name));
    file->folder = folder;
    file->real = real;
    file->text = data;
    file->length = length;
    x3d_file_index(&scene->arena, file);
    file->owned = data;
    file->next = scene->files;
    scene->files = file;
    scene->arena.out_of_memory = outer;
    return file;
}

void x3d_read_text(x3d_build *build) {
    const char *text = build->file->text;
    size_t length = build->file->length, i = 0;
    if (x3d_is_gltf(build->file)) {
        x3d_read_gltf(build);
        return;
    }
    if (length >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0)
        i = 3;
    if (length >= 2 && (memcmp(text, "\xff\xfe", 2) == 0 || memcmp(text, "\xfe\xff", 2) == 0)) {
        x3d_read_xml(build); /* UTF-16 */
        return;
    }
    while (i < length && (unsigned char)text[i] <= ' ')
        i++;
    if (i < length && text[i] == '<')
        x3d_read_xml(build);
    else
        x3d_read_classic(build);
}

static plr_scene *create(const plr_read_desc *desc) {
    static const plr_read_desc zero = {0};
    if (!desc)
        desc = &zero;
    plr_allocator allocator = plr_allocator_resolve(desc->allocator);
    plr_scene *scene = allocator.reallocate(allocator.user, NULL, sizeof *scene);
    if (!scene)
        return NULL;
    memset(scene, 0, sizeof *scene);
    scene->allocator = allocator;
    scene->rules = desc->rules;
    scene->max_nodes = desc->max_nodes ? desc->max_nodes : USUAL_NODES;
    if (scene->max_nodes > UINT32_MAX - 1)
        scene->max_nodes = UINT32_MAX - 1;
    scene->max_depth = desc->max_depth ? desc->max_depth : USUAL_DEPTH;
    if (scene->max_depth > MOST_DEPTH)
        scene->max_depth = MOST_DEPTH;
    scene->max_memory = desc->max_memory ? desc->max_memory : (size_t)4 << 30;
    scene->nearest_budget = NEAREST_BUDGET;
    scene->work_budget = WORK_BUDGET;
    scene->version = "";
    scene->length_unit = scene->angle_unit = 1;
    plr_allocator counting = x3d_counting_allocator(scene);
    plr_arena_init(&scene->arena, &counting, NULL);
    return scene;
}

void plr_scene_destroy(plr_scene **scene) {
    if (!*scene)
        return;
    for (x3d_file *file = (*scene)->files; file; file = file->next)
        x3d_block_free(file->owned);
    plr_arena_finish(&(*scene)->arena);
    plr_allocator allocator = (*scene)->allocator;
    allocator.release(allocator.user, *scene);
    *scene = NULL;
}

/* The caller's arrays and strings need not live on. */
static void copy_rules(plr_scene *scene) {
    const char **allowed = PLR_NEW_ARRAY(&scene->arena, scene->rules.allowed_count, const char *);
    for (size_t i = 0; i < scene->rules.allowed_count; i++)
        allowed[i] =
            plr_arena_copy(&scene->arena, scene->rules.allowed[i], strlen(scene->rules.allowed[i]));
    scene->rules.allowed = allowed;
}

static void read_main(plr_scene *scene, x3d_file *file) {
    x3d_build build = {.scene = scene,
                       .file = file,
                       .scope = x3d_scope_new(scene, NULL, NULL),
                       .length_unit = 1,
                       .angle_unit = 1,
                       .is_main = true};
    scene->scope = build.scope;
    x3d_read_text(&build);
    x3d_scope_end(&build);
    scene->nodes = build.nodes;
}

typedef struct input {
    const char *path;
    const char *text; /* NULL: read the path */
    size_t length;
} input;

/* False: there is nothing to read (reported). */
static bool read_input(plr_scene *scene, const input *in) {
    copy_rules(scene);
    const char *folder = x3d_find_roots(scene, in->path);
    const char *path = in->path ? in->path : "-";
    char *data = NULL;
    size_t length = in->length;
    x3d_failure failure = {PLR_CODE_NO_MEMORY, NULL};
    if (!in->text)
        failure = x3d_read_path(scene, path, &data, &length);
    else if (x3d_is_gzip(in->text, in->length))
        failure = x3d_gunzip(scene, path, in->text, in->length, &data, &length);
    else if (!(data = x3d_block_copy(&scene->allocator, in->text, in->length)))
        failure.text = "not enough memory";
    if (failure.text) {
        x3d_report(scene, failure.code, (plr_place){path, 0, 0}, "'%s' %s", path, failure.text);
        return false;
    }
    x3d_file *file = x3d_add_file(scene, path, folder, NULL, data, length);
    if (!in->text) {
        x3d_located located;
        const char *slash = strrchr(path, '/');
        const char *base = slash ? slash + 1 : path;
        x3d_locate(scene, folder, "", base, strlen(base), &located);
        file->real = located.real;
    }
    read_main(scene, file);
    return true;
}

static plr_scene *read_scene(const input *in, const plr_read_desc *desc, plr_diags *diags) {
    plr_place place = {in->path, 0, 0};
    plr_scene *volatile scene = create(desc);
    if (!scene) {
        plr_diags_add(diags, PLR_CODE_NO_MEMORY, place, "not enough memory to read the scene");
        return NULL;
    }
    jmp_buf out_of_memory;
    scene->diags = diags;
    scene->arena.out_of_memory = &out_of_memory;
    plr_scene *kept = scene;
    if (setjmp(out_of_memory) != 0) {
        plr_diags_add(diags, PLR_CODE_NO_MEMORY, place, "not enough memory to read the scene");
        kept = scene;
        plr_scene_destroy(&kept);
        return NULL;
    }
    if (!read_input(scene, in)) {
        plr_scene_destroy(&kept);
        return NULL;
    }
    scene->diags = NULL;
    scene->arena.out_of_memory = NULL;
    return scene;
}

plr_scene *plr_scene_read(const char *path, const plr_read_desc *desc, plr_diags *diags) {
    return read_scene(&(input){path, NULL, 0}, desc, diags);
}

plr_scene *plr_scene_parse(const char *text, size_t length, const char *path,
                           const plr_read_desc *desc, plr_diags *diags) {
    return read_scene(&(input){path, text, length}, desc, diags);
}
