/* Shadows of volumes: which volumes cast some, what receives them, and the effects that ask along
 * the way of the light. */
#include "engine/volume_pass.h"

#include <string.h>

#include "engine/general.h"
#include "engine/shadows.h"

/* ---- Which styles ask for shadows ---- */

enum {
    MOST_CASTERS = 8, /* each is in every lit program, with its textures */
    MOST_LOOKS = 4096 /* at styles of one volume: DEF and USE can make a few lines into very many */
};

/* ISO/IEC 19775-1 V4 41.4.10: `shadows` without `lighting` has no effect. */
bool plr_style_has_shadows(const plr_node *style, bool general) {
    return (plr_node_is(style, "ShadedVolumeStyle") ||
            plr_node_is(style, "ISOSurfaceVolumeStyle")) &&
           (general || plr_node_bool(style, "lighting")) && plr_node_bool(style, "shadows");
}

static bool blends(const plr_node *style, bool general) {
    (void)general;
    return plr_node_is(style, "BlendedVolumeStyle");
}

/* What is asked of styles. */
typedef struct question {
    bool (*is)(const plr_node *style, bool general);
    bool general; /* whatever is switched off */
    size_t left;  /* looks at styles */
} question;

/* Whether any style in use of the tree is so. */
static bool any_style(const plr_node *style, question *q) {
    if (!style || !q->left || !(q->general || plr_node_bool(style, "enabled")))
        return false;
    --q->left;
    if (q->is(style, q->general))
        return true;
    const plr_field *inner = plr_node_field(style, "renderStyle");
    for (size_t i = 0; inner && i < inner->count; i++)
        if (any_style(inner->value.nodes[i], q))
            return true;
    return false;
}

static bool any_style_of(const plr_volume_state *state, bool (*is)(const plr_node *, bool),
                         bool general) {
    const plr_field *styles = plr_node_field(state->node, "renderStyle");
    const plr_field *enabled = plr_node_field(state->node, "segmentEnabled");
    question q = {is, general, MOST_LOOKS};
    for (size_t i = 0; i < styles->count; i++) {
        bool hidden = enabled && i < enabled->count && !enabled->value.bools[i];
        if ((general || !hidden) && any_style(styles->value.nodes[i], &q))
            return true;
    }
    return false;
}

bool plr_volumes_have_shadows(const plr_view *view) {
    bool any = false;
    for (size_t i = 0; i < view->volumes.count && !any; i++)
        any = any_style_of(&view->volumes.volumes[i], plr_style_has_shadows, true);
    return any;
}

/* A projection is no matter that light could meet. */
static bool casts(const plr_volume_state *state, plr_diags *diags) {
    if (state->kind == PLR_VOLUME_PROJECTED ||
        !any_style_of(state, plr_style_has_shadows, state->general))
        return false;
    if (state->grid->brick_sides[0])
        plr_diags_add_as(diags, PLR_WARNING, PLR_CODE_LIMIT, plr_node_place(state->node),
                         "a volume that is cast in bricks casts no shadows");
    return !state->grid->brick_sides[0];
}

void plr_volume_find_shadows(plr_view *view, plr_diags *diags) {
    plr_volume_pass *pass = &view->volumes;
    pass->casters = PLR_NEW_ARRAY(&view->arena, pass->count + 1, size_t);
    for (size_t i = 0; i < pass->count; i++)
        if (casts(&pass->volumes[i], diags))
            pass->casters[pass->caster_count++] = i;
    if (pass->caster_count > 1)
        plr_volume_order(view, pass->casters, pass->caster_count);
    if (pass->caster_count <= MOST_CASTERS)
        return;
    plr_diags_add(diags, PLR_CODE_LIMIT,
                  plr_node_place(pass->volumes[pass->casters[MOST_CASTERS]].node),
                  "more than %d volumes cast shadows; the rest casts none", MOST_CASTERS);
    pass->caster_count = MOST_CASTERS;
}

/* ---- Lights in their shadow ---- */

/* Light from all around comes no way that a shadow could lie on. */
static bool is_straight(const plr_recipe *recipe, size_t index) {
    const plr_binding *binding = &recipe->bindings.items[index];
    return binding->is_light && !binding->shadow &&
           !(binding->node && plr_node_is(binding->node, "EnvironmentLight"));
}

static const plr_define in_shadow = {"IN_SHADOW", "1"};

void plr_recipe_receive(plr_view *view, plr_recipe *recipe, size_t from) {
    for (size_t i = from; view->volumes.caster_count && i < recipe->effects.count; i++) {
        plr_effect *effect = &recipe->effects.items[i];
        if (!is_straight(recipe, i))
            continue;
        plr_define *defines = PLR_NEW_ARRAY(&view->arena, effect->define_count + 1, plr_define);
        if (effect->define_count)
            memcpy(defines, effect->defines, effect->define_count * sizeof *defines);
        defines[effect->define_count++] = in_shadow;
        effect->defines = defines;
    }
}

static bool has_receiver(const plr_recipe *recipe) {
    for (size_t i = 0; i < recipe->effects.count; i++) {
        const plr_effect *effect = &recipe->effects.items[i];
        if (effect->define_count &&
            effect->defines[effect->define_count - 1].name == in_shadow.name)
            return true;
    }
    return false;
}

/* ---- What is asked ---- */

static const char *const ray_units[] = {
    [PLR_VOLUME_FILLED] = "volume/ShadowRay volume/grid volume/shadow_steps",
    [PLR_VOLUME_SURFACES] =
        "volume/ShadowRay volume/grid volume/levels volume/crossings volume/shadow_surfaces"};

static size_t add_ray(plr_view *view, plr_recipe *recipe, const plr_volume_state *state,
                      size_t shadow) {
    const plr_define defines[] = {
        {"voxels_COMPONENTS",
         plr_arena_format(&view->arena, "%u", state->grid->voxels->components)},
        {"HAS_LABELS", state->labels ? "1" : "0"}};
    const plr_binding binding = {.node = state->node,
                                 .to_world = state->to_world,
                                 .place = &state->to_world,
                                 .volume = state->index,
                                 .grid = state->grid};
    size_t ray = plr_recipe_builtin(&view->kitchen, recipe, ray_units[state->kind], "ShadowRay",
                                    binding, shadow, defines, sizeof defines / sizeof *defines);
    recipe->effects.items[ray - 1].private_plugs = true;
    return ray;
}

/* The effects of authors on the volume and on the groups around it act on its shadow where they act
 * on its samples and its ends, and nowhere else once more. */
static void add_authors(plr_view *view, plr_recipe *recipe, size_t volume, size_t ray) {
    const plr_leaf *leaf = view->volumes.leaves[volume];
    size_t from = recipe->effects.count;
    plr_recipe_author_list(&view->kitchen, recipe, leaf->node, ray, volume);
    plr_recipe_groups(&view->kitchen, recipe, leaf->scope, ray, volume);
    for (size_t i = from; i < recipe->effects.count; i++)
        recipe->effects.items[i].only_attached = true;
}

static void add_caster(plr_view *view, plr_recipe *recipe, size_t volume, size_t shadow) {
    size_t ray = add_ray(view, recipe, &view->volumes.volumes[volume], shadow);
    plr_volume_add_planes(view, recipe, volume, ray);
    const plr_volume_state *state = &view->volumes.volumes[volume];
    plr_general_hide(view, recipe, !any_style_of(state, plr_style_has_shadows, false), volume, ray);
    plr_volume_add_styles(view, recipe, volume, ray, NULL, false, NULL);
    add_authors(view, recipe, volume, ray);
}

void plr_recipe_volume_shadows(plr_view *view, plr_recipe *recipe, bool skips_clear) {
    if (!has_receiver(recipe))
        return;
    plr_diags *diags = view->kitchen.diags;
    view->kitchen.diags =
        NULL; /* what is wrong with styles and effects is said where they are seen */
    const plr_define define = {"SKIPS_CLEAR", skips_clear ? "1" : "0"};
    size_t shadow =
        plr_recipe_builtin(&view->kitchen, recipe, "shadows/VolumeShadow", "VolumeShadow",
                           (plr_binding){.volume = PLR_NO_EFFECT}, 0, &define, 1);
    recipe->effects.items[shadow - 1].private_plugs = true;
    for (size_t i = 0; i < view->volumes.caster_count; i++)
        add_caster(view, recipe, view->volumes.casters[i], shadow);
    view->kitchen.diags = diags;
}

/* ---- Samples that cannot be seen ---- */

/* The colour of what is transparent matters to what mixes colours, and nobody knows what authors do
 * with it. */
bool plr_volume_skips_clear(const plr_view *view, size_t volume) {
    return !view->volumes.volumes[volume].authors_see_all &&
           !any_style_of(&view->volumes.volumes[volume], blends, view->general);
}
