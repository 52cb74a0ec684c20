/* Files within files: Inline and EXTERNPROTO. */
#include "x3d/build.h"

#include <string.h>

#include "x3d/files.h"
#include "x3d/read.h"

enum {
    MOST_LOADS = 20000
};

static int shown(size_t length) {
    return length > 200 ? 200 : (int)length;
}

/* The part of a url after '#', or NULL. */
static const char *fragment_of(const plr_string *url) {
    return memchr(url->text, '#', url->length);
}

static size_t length_without_fragment(const plr_string *url) {
    const char *fragment = fragment_of(url);
    return fragment ? (size_t)(fragment - url->text) : url->length;
}

static plr_place place_of(const plr_string *url) {
    return (plr_place){url->origin.file, url->origin.line, url->origin.column};
}

static bool is_being_read(const x3d_build *build, const char *real) {
    for (; build; build = build->outer)
        if (build->file->real && real && strcmp(build->file->real, real) == 0)
            return true;
    return false;
}

static x3d_failure locate(x3d_build *build, const plr_string *url, x3d_located *located) {
    plr_scene *scene = build->scene;
    const x3d_file *file = x3d_file_of_name(scene, url->origin.file);
    x3d_failure failure = x3d_locate(scene, file->folder, file->name, url->text,
                                     length_without_fragment(url), located);
    if (!failure.text && is_being_read(build, located->real))
        return (x3d_failure){PLR_CODE_RECURSION, "is being read already: it includes itself"};
    return failure;
}

/* The file, read now or before. */
static x3d_failure load(x3d_build *build, const x3d_located *located, x3d_file **file) {
    plr_scene *scene = build->scene;
    for (*file = scene->files; *file; *file = (*file)->next)
        if ((*file)->real && located->real && strcmp((*file)->real, located->real) == 0 &&
            strcmp((*file)->name, located->name) == 0)
            return (x3d_failure){PLR_CODE_MISSING_FILE, NULL};
    char *data = NULL;
    size_t length = 0;
    x3d_failure failure = x3d_read_located(scene, located, true, &data, &length);
    if (!failure.text)
        *file = x3d_add_file(scene, located->name, located->folder ? located->folder : "/",
                             located->real, data, length);
    return failure;
}

static bool may_load(x3d_build *build, plr_place place) {
    plr_scene *scene = build->scene;
    if (scene->stopped)
        return false;
    if (scene->load_count++ < MOST_LOADS)
        return true;
    x3d_report(scene, PLR_CODE_LIMIT, place, "more than %d inlined files", MOST_LOADS);
    scene->stopped = true;
    return false;
}

/* ---- Inline ---- */

static plr_field *children_of(plr_scene *scene, plr_node *node) {
    size_t index = x3d_field_index(scene, node, "children", 8, node->place);
    return index != SIZE_MAX ? &node->fields[index]
                             : x3d_field_declare(scene, node, "children", 8, PLR_MFNODE,
                                                 PLR_OUTPUT_ONLY, node->place);
}

/* Lengths of another unit: a Transform around what was inlined brings them to those of the main
 * file. */
static plr_node *scaled(x3d_build *build, const x3d_build *inner, plr_place place) {
    plr_scene *scene = build->scene;
    plr_node *transform = x3d_node_new(scene, x3d_type_find(scene, "Transform", 9, place), place);
    if (!transform)
        return NULL;
    float *scale = PLR_NEW_ARRAY(&scene->arena, 3, float);
    scale[0] = scale[1] = scale[2] = (float)(inner->length_unit / scene->length_unit);
    plr_field *field = &transform->fields[x3d_field_index(scene, transform, "scale", 5, place)];
    field->value.floats = scale;
    field->given = true;
    field = &transform->fields[x3d_field_index(scene, transform, "children", 8, place)];
    field->given = true;
    for (size_t i = 0; i < inner->nodes.count; i++)
        x3d_append_node(scene, field, inner->nodes.items[i]);
    return transform;
}

static void read_inlined(x3d_build *build, plr_node *node, x3d_file *file) {
    plr_scene *scene = build->scene;
    x3d_build inner = {.scene = scene,
                       .file = file,
                       .scope = x3d_scope_new(scene, NULL, NULL),
                       .depth = build->depth,
                       .outer = build,
                       .length_unit = 1,
                       .angle_unit = 1};
    if (!x3d_enter(&inner, node->place))
        return;
    x3d_read_text(&inner);
    x3d_scope_end(&inner);
    node->inlined = inner.scope;
    plr_field *children = children_of(scene, node);
    children->value.nodes = NULL;
    children->count = 0;
    plr_node *wrapper =
        inner.length_unit != scene->length_unit ? scaled(build, &inner, node->place) : NULL;
    if (wrapper)
        x3d_append_node(scene, children, wrapper);
    for (size_t i = 0; !wrapper && i < inner.nodes.count; i++)
        x3d_append_node(scene, children, inner.nodes.items[i]);
}

bool x3d_is_inline(const plr_node *node) {
    return plr_node_is(node, "Inline") || plr_node_is(node, "KambiInline");
}

void x3d_load_inline(x3d_build *build, plr_node *node) {
    plr_scene *scene = build->scene;
    const plr_field *load_field = plr_node_field(node, "load"), *urls = plr_node_field(node, "url");
    if (!urls || urls->type != PLR_MFSTRING || (load_field && !plr_node_bool(node, "load")))
        return;
    x3d_failure failure = {PLR_CODE_MISSING_FILE, NULL};
    x3d_located located = {0};
    for (size_t i = 0; i < urls->count; i++) {
        x3d_file *file = NULL;
        if (!may_load(build, place_of(&urls->value.strings[i])))
            return;
        failure = locate(build, &urls->value.strings[i], &located);
        if (!failure.text)
            failure = load(build, &located, &file);
        if (!failure.text) {
            read_inlined(build, node, file);
            return;
        }
        if (failure.code == PLR_CODE_RECURSION)
            break;
    }
    if (failure.text)
        x3d_report(scene, failure.code, place_of(&urls->value.strings[0]), "'%.*s' %s",
                   shown(strlen(located.name)), located.name, failure.text);
}

/* ---- EXTERNPROTO ---- */

/* The prototypes of another file; its nodes are read as the mould of nothing and left alone. */
static x3d_scope *read_library(x3d_build *build, x3d_file *file, const char *key) {
    plr_scene *scene = build->scene;
    x3d_proto *nothing = PLR_NEW(&scene->arena, x3d_proto);
    x3d_build inner = {.scene = scene,
                       .file = file,
                       .scope = x3d_scope_new(scene, NULL, nothing),
                       .depth = build->depth,
                       .outer = build,
                       .length_unit = 1,
                       .angle_unit = 1};
    if (!x3d_enter(&inner, (plr_place){file->name, 1, 1}))
        return inner.scope;
    x3d_read_text(&inner);
    *x3d_names_at(&scene->externals, &scene->arena, key, strlen(key)) = inner.scope;
    return inner.scope;
}

static bool before(plr_place a, plr_place b) {
    return a.line != b.line ? a.line < b.line : a.column < b.column;
}

static x3d_proto *find_in(const x3d_scope *scope, const char *name) {
    if (name)
        return x3d_names_find(&scope->protos, name, strlen(name));
    x3d_proto *first = NULL; /* without a name: the first one of the file */
    for (size_t i = 0; i < scope->protos.capacity; i++) {
        x3d_proto *proto = scope->protos.slots[i].value;
        if (proto && (!first || before(proto->place, first->place)))
            first = proto;
    }
    return first;
}

static x3d_failure find_external(x3d_build *build, x3d_proto *proto, const plr_string *url) {
    plr_scene *scene = build->scene;
    x3d_located located;
    x3d_failure failure = locate(build, url, &located);
    if (failure.text)
        return failure;
    const char *key = located.real ? located.real : located.name;
    x3d_scope *scope = x3d_names_find(&scene->externals, key, strlen(key));
    if (!scope) {
        x3d_file *file = NULL;
        if (!may_load(build, place_of(url)))
            return (x3d_failure){PLR_CODE_LIMIT, "is left out"};
        failure = load(build, &located, &file);
        if (failure.text)
            return failure;
        scope = read_library(build, file, key);
    }
    const char *fragment = fragment_of(url);
    x3d_proto *found = find_in(scope, fragment ? fragment + 1 : NULL);
    if (found && found->external) {
        x3d_build there = *build;
        there.scope = scope;
        if (!x3d_externproto_resolve(&there, found))
            return (x3d_failure){PLR_CODE_BAD_PROTO, "leads to a prototype that cannot be used"};
        proto->known = found->known;
        found = found->actual;
    }
    proto->actual = found;
    if (!found && !proto->known)
        return (x3d_failure){PLR_CODE_BAD_PROTO, "has no such prototype"};
    return failure;
}

static bool is_urn(const plr_string *url) {
    return url->length > 4 && memcmp(url->text, "urn:", 4) == 0;
}

bool x3d_externproto_resolve(x3d_build *build, x3d_proto *proto) {
    plr_scene *scene = build->scene;
    if (proto->resolved)
        return proto->actual || proto->known;
    proto->resolved = true;
    size_t length = strlen(proto->name);
    x3d_failure failure = {PLR_CODE_BAD_PROTO, NULL};
    const char *failed = "";
    plr_place place = proto->place;
    for (size_t i = 0; i < proto->urls.count; i++) {
        const plr_string *url = &proto->urls.value.strings[i];
        if (is_urn(url)) {
            proto->known = x3d_type_find(scene, proto->name, length, place_of(url));
            if (proto->known)
                return true;
            continue;
        }
        x3d_failure result = find_external(build, proto, url);
        if (!result.text)
            return true;
        if (!failure.text) {
            failure = result;
            failed = url->text;
            place = place_of(url);
        }
    }
    proto->known = x3d_type_find(scene, proto->name, length, proto->place);
    if (proto->known)
        return true;
    if (failure.text)
        x3d_report(scene, failure.code, place, "'%.200s' %s", failed, failure.text);
    else
        x3d_report(scene, PLR_CODE_BAD_PROTO, place, "no url gives the prototype '%s'",
                   proto->name);
    return false;
}
