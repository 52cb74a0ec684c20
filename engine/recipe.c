#include "engine/recipe.h"

#include <ctype.h>
#include <string.h>

typedef struct define_list {
    plr_define *items;
    size_t count, capacity;
} define_list;

static void push_define(plr_arena *arena, define_list *list, const char *name, const char *value) {
    *PLR_PUSH(arena, list) = (plr_define){name, value};
}

/* A field's string value as the tail of a macro name: letters, digits and underscores. */
static char *macro_tail(plr_arena *arena, const char *text) {
    char *tail = plr_arena_copy(arena, text, strlen(text));
    for (char *c = tail; *c; c++)
        if (!isalnum((unsigned char)*c))
            *c = '_';
    return tail;
}

/* The voxels of volumes and styles, which the volume pass loads itself: to look at them here would
 * load them twice. */
static bool is_volume_data(const plr_field *field) {
    static const char *const names[] = {"voxels", "voxelLevels", "segmentIdentifiers",
                                        "segmentedVoxels"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (strcmp(field->name, names[i]) == 0)
            return true;
    return false;
}

/* The macros that the conditionals of a built-in effect see; effects/README.md lists them. */
static void field_defines(plr_kitchen *k, define_list *list, const plr_node *node,
                          const char *prefix, int depth) {
    plr_arena *arena = k->arena;
    for (size_t i = 0; i < plr_node_field_count(node); i++) {
        const plr_field *field = plr_node_field_at(node, i);
        const char *path = plr_arena_format(arena, "%s%s", prefix, field->name);
        const plr_node *child;
        plr_texture *texture;
        if (field->given && plr_type_kind(field->type) != PLR_NODE)
            push_define(arena, list, plr_arena_format(arena, "GIVEN_%s", path), "1");
        switch (plr_type_kind(field->type)) {
        case PLR_BOOL:
            if (field->type == PLR_SFBOOL)
                push_define(arena, list, path, field->value.bools[0] ? "1" : "0");
            break;
        case PLR_STRING:
            if (field->type == PLR_SFSTRING && field->value.strings[0].length < 64)
                push_define(arena, list,
                            plr_arena_format(arena, "%s_%s", path,
                                             macro_tail(arena, field->value.strings[0].text)),
                            "1");
            break;
        case PLR_NODE:
            child = field->count ? field->value.nodes[0] : NULL;
            push_define(arena, list, plr_arena_format(arena, "HAS_%s", path), child ? "1" : "0");
            if (!child) {
                push_define(arena, list, plr_arena_format(arena, "%s_DIMENSIONS", path), "0");
                push_define(arena, list, plr_arena_format(arena, "%s_COMPONENTS", path), "0");
            }
            if (!child || strcmp(field->name, "metadata") == 0 || is_volume_data(field))
                break;
            push_define(arena, list, plr_arena_format(arena, "%s_%s", path, plr_node_type(child)),
                        "1");
            texture = plr_textures_get(k->textures, child);
            if (texture) {
                push_define(arena, list, plr_arena_format(arena, "%s_DIMENSIONS", path),
                            plr_arena_format(arena, "%d", plr_texture_dimensions(texture)));
                push_define(arena, list, plr_arena_format(arena, "%s_COMPONENTS", path),
                            plr_arena_format(arena, "%u", texture->components));
            } else if (depth > 0) {
                field_defines(k, list, child, plr_arena_format(arena, "%s_", path), depth - 1);
            }
            break;
        default:
            break;
        }
    }
}

void plr_recipe_define(plr_kitchen *k, plr_recipe *recipe, const char *name, int value) {
    *PLR_PUSH(k->arena, &recipe->defines) =
        (plr_define){name, plr_arena_format(k->arena, "%d", value)};
}

static size_t push_effect(plr_kitchen *k, plr_recipe *recipe, plr_effect effect,
                          plr_binding binding) {
    *PLR_PUSH(k->arena, &recipe->effects) = effect;
    *PLR_PUSH(k->arena, &recipe->bindings) = binding;
    return recipe->effects.count;
}

/* The units of paths separated by blanks; none if there are none of the first. */
static plr_sources gather_units(plr_kitchen *k, const char *paths) {
    const char *end = strchr(paths, ' ');
    if (!end)
        return *plr_catalog_units(k->catalog, paths);
    plr_sources units = {0};
    for (const char *at = paths; at; at = end ? end + 1 : NULL) {
        end = strchr(at, ' ');
        const char *path = plr_arena_copy(k->arena, at, end ? (size_t)(end - at) : strlen(at));
        const plr_sources *more = plr_catalog_units(k->catalog, path);
        for (size_t i = 0; i < more->count; i++)
            *PLR_PUSH(k->arena, &units) = more->items[i];
        if (!units.count)
            break;
    }
    return units;
}

size_t plr_recipe_builtin(plr_kitchen *k, plr_recipe *recipe, const char *path, const char *name,
                          plr_binding binding, size_t attached, const plr_define *extra,
                          size_t extra_count) {
    if (binding.gated)
        path = plr_arena_format(k->arena, "%s general/Gate", path);
    plr_sources units = gather_units(k, path);
    if (!units.count)
        return 0;
    define_list defines = {0};
    if (binding.node)
        field_defines(k, &defines, binding.node, "", 1);
    for (size_t i = 0; i < extra_count; i++) /* the last one of a name counts */
        *PLR_PUSH(k->arena, &defines) = extra[i];
    plr_effect effect = {.name = name,
                         .sources = units.items,
                         .source_count = units.count,
                         .defines = defines.items,
                         .define_count = defines.count,
                         .attached = attached,
                         .only_attached = attached != 0,
                         .builtin = true,
                         .gate = binding.gated ? "gate" : NULL};
    if (binding.node)
        effect.place = plr_node_place(binding.node);
    return push_effect(k, recipe, effect, binding);
}

static const struct {
    const char *type;
    plr_stage stage;
} part_types[] = {{"VERTEX", PLR_VERTEX}, {"GEOMETRY", PLR_GEOMETRY}, {"FRAGMENT", PLR_FRAGMENT}};

static plr_stage part_stage(plr_kitchen *k, const plr_node *part) {
    const char *type = plr_node_string(part, "type");
    for (size_t i = 0; i < sizeof part_types / sizeof *part_types; i++)
        if (strcmp(type, part_types[i].type) == 0)
            return part_types[i].stage;
    plr_diags_add_as(k->diags, PLR_WARNING, PLR_CODE_BAD_VALUE, plr_node_field(part, "type")->place,
                     "'%s' is no type of shader part; VERTEX is taken", type);
    return PLR_VERTEX;
}

static const plr_source *part_source(plr_kitchen *k, const plr_node *part) {
    for (size_t i = 0; i < k->part_count; i++)
        if (k->parts[i].node == part)
            return k->parts[i].source;
    k->parts = plr_arena_grow(k->lasting, k->parts, &k->part_capacity, k->part_count + 1,
                              sizeof *k->parts);
    struct part *slot = &k->parts[k->part_count++];
    *slot = (struct part){part, NULL};
    plr_string code;
    if (plr_scene_code(k->scene, part, "url", &code, k->diags))
        slot->source = plr_source_read(part_stage(k, part), code.text, code.length, &code.origin,
                                       NULL, k->diags);
    return slot->source;
}

void plr_kitchen_finish(plr_kitchen *kitchen) {
    for (size_t i = 0; i < kitchen->part_count; i++)
        plr_source_destroy(&kitchen->parts[i].source);
    kitchen->part_count = 0;
}

static void collect_parts(plr_kitchen *k, const plr_node *owner, plr_sources *sources) {
    const plr_field *parts = plr_node_field(owner, "parts");
    for (size_t i = 0; parts && i < parts->count; i++) {
        const plr_source *source =
            parts->value.nodes[i] ? part_source(k, parts->value.nodes[i]) : NULL;
        if (source)
            *PLR_PUSH(k->arena, sources) = source;
    }
}

static bool is_glsl(plr_kitchen *k, const plr_node *node) {
    const plr_field *language = plr_node_field(node, "language");
    const char *text = plr_node_string(node, "language");
    if (!*text || strcmp(text, "GLSL") == 0)
        return true;
    plr_diags_add(k->diags, PLR_CODE_LANGUAGE, language->place,
                  "the language '%s' is not GLSL; the %s is left out", text, plr_node_type(node));
    return false;
}

static const struct {
    const char *text;
    plr_placement placement;
} placements[] = {{"ADD_AFTER", PLR_ADD_AFTER},
                  {"ADD_BEFORE", PLR_ADD_BEFORE},
                  {"REPLACE", PLR_REPLACE},
                  {"REMOVE", PLR_REMOVE}};

static bool read_placement(plr_kitchen *k, const plr_node *node, plr_placement *placement) {
    const char *text = plr_node_string(node, "placement");
    *placement = PLR_ADD_AFTER;
    if (!*text)
        return true;
    for (size_t i = 0; i < sizeof placements / sizeof *placements; i++)
        if (strcmp(text, placements[i].text) == 0) {
            *placement = placements[i].placement;
            return true;
        }
    plr_diags_add(k->diags, PLR_CODE_BAD_VALUE, plr_node_field(node, "placement")->place,
                  "'%s' is no placement: ADD_AFTER, ADD_BEFORE, REPLACE or REMOVE", text);
    return false;
}

/* The libraries that effects may name: their functions are in plugray's library, and come without
 * being named as well. */
static void check_libraries(plr_kitchen *k, const plr_node *node) {
    static const char *const known[] = {"castle-shader:/EyeWorldSpace.glsl"};
    const plr_field *names = plr_node_field(node, "shaderLibraries");
    for (size_t i = 0; names && i < names->count; i++) {
        const plr_string *name = &names->value.strings[i];
        plr_place place = {name->origin.file, name->origin.line, name->origin.column};
        bool found = false;
        for (size_t n = 0; n < sizeof known / sizeof *known; n++)
            found = found || strcmp(name->text, known[n]) == 0;
        if (!found)
            plr_diags_add_as(k->diags, PLR_WARNING, PLR_CODE_MISSING_FILE, place,
                             "plugray has no shader library '%s'", name->text);
    }
}

void plr_recipe_author(plr_kitchen *k, plr_recipe *recipe, plr_node *node, size_t attached,
                       size_t volume) {
    plr_placement placement;
    if (!node || !plr_node_is(node, "Effect") || !plr_node_bool(node, "enabled") ||
        !is_glsl(k, node) || !read_placement(k, node, &placement))
        return;
    plr_sources sources = {0};
    check_libraries(k, node);
    collect_parts(k, node, &sources);
    const char *def = plr_node_def(node);
    plr_effect effect = {.name = def ? def : "Effect",
                         .sources = sources.items,
                         .source_count = sources.count,
                         .attached = attached,
                         .placement = placement,
                         .target = plr_node_string(node, "target"),
                         .only_if_active = plr_node_bool(node, "onlyIfActive"),
                         .place = plr_node_place(node)};
    push_effect(k, recipe, effect,
                (plr_binding){.node = node, .to_world = plr_matrix_identity(), .volume = volume});
}

void plr_recipe_author_list(plr_kitchen *k, plr_recipe *recipe, const plr_node *owner,
                            size_t attached, size_t volume) {
    const plr_field *effects = plr_node_field(owner, "effects");
    for (size_t i = 0; effects && i < effects->count; i++)
        plr_recipe_author(k, recipe, effects->value.nodes[i], attached, volume);
}

void plr_recipe_attached_authors(plr_kitchen *k, plr_recipe *recipe, const char *type) {
    size_t count = recipe->effects.count;
    for (size_t i = 0; i < count; i++) {
        plr_binding binding = recipe->bindings.items[i];
        const char *own = binding.node ? plr_node_type(binding.node) : "";
        const plr_node_info *info = plr_node_info_find(own);
        /* what else is bound to the node (a light's shadow) has another name */
        if (info && plr_node_info_is(info, type) && strcmp(own, recipe->effects.items[i].name) == 0)
            plr_recipe_author_list(k, recipe, binding.node, i + 1, binding.volume);
    }
}

void plr_recipe_groups(plr_kitchen *k, plr_recipe *recipe, const plr_scope *scope, size_t attached,
                       size_t volume) {
    for (; scope; scope = scope->outer)
        for (size_t i = 0; i < scope->effects.count; i++)
            plr_recipe_author(k, recipe, scope->effects.items[i], attached, volume);
}

/* The units of one stage. */
static void add_stage(plr_kitchen *k, plr_sources *to, const plr_sources *from, plr_stage stage) {
    for (size_t i = 0; i < from->count; i++)
        if (plr_source_stage(from->items[i]) == stage)
            *PLR_PUSH(k->arena, to) = from->items[i];
}

static bool has_stage(const plr_sources *units, plr_stage stage) {
    for (size_t i = 0; i < units->count; i++)
        if (plr_source_stage(units->items[i]) == stage)
            return true;
    return false;
}

/* Vertices that a shader says nothing of go where those of other shapes go; a geometry stage is for
 * effects that bring a main() to it. */
bool plr_recipe_shader_base(plr_kitchen *k, plr_recipe *recipe, plr_node *shader) {
    static const plr_stage given[] = {PLR_VERTEX, PLR_GEOMETRY};
    if (!is_glsl(k, shader))
        return false;
    collect_parts(k, shader, &recipe->base);
    if (recipe->base.count == 0)
        return false;
    if (!has_stage(&recipe->base, PLR_FRAGMENT)) {
        plr_diags_add(k->diags, PLR_CODE_NOT_DRAWN, plr_node_place(shader),
                      "the %s has no fragment part; it is left out", plr_node_type(shader));
        return false;
    }
    for (size_t i = 0; i < sizeof given / sizeof *given; i++)
        if (!has_stage(&recipe->base, given[i]))
            add_stage(k, &recipe->base, plr_catalog_units(k->catalog, "surface/surface"), given[i]);
    return true;
}
