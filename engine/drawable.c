/* What a view draws, thing by thing, for listings. */
#include "engine/targets.h"

typedef struct found {
    plr_drawable drawable;
    plr_pass *pass;
    size_t volume; /* PLR_NO_EFFECT: no volume */
} found;

static plr_pass *cast_of(const plr_world *world, size_t volume) {
    for (size_t i = 0; i < world->volumes.cast_count; i++)
        for (size_t m = 0; m < world->volumes.casts[i].count; m++)
            if (world->volumes.casts[i].members[m] == volume)
                return &world->volumes.casts[i].pass;
    return NULL;
}

static size_t count_things(const plr_world *world) {
    return world->model_count + world->volumes.count + (world->background.pass.built != NULL);
}

/* Shapes, then volumes, then the background. */
static void take(const plr_world *world, size_t index, found *out) {
    *out = (found){.volume = PLR_NO_EFFECT};
    if (index < world->model_count) {
        plr_model *model = world->models[index];
        out->drawable = (plr_drawable){.kind = "surface", .node = model->node};
        out->pass = &model->pass;
    } else if ((index -= world->model_count) < world->volumes.count) {
        out->drawable =
            (plr_drawable){.kind = "volume", .node = world->volumes.volumes[index].node};
        out->volume = index;
        out->pass = cast_of(world, index);
    } else {
        out->drawable = (plr_drawable){.kind = "background", .node = world->background.node};
        out->pass = (plr_pass *)&world->background.pass;
    }
    if (out->pass && out->pass->built)
        out->drawable.program = &out->pass->built->info;
}

/* The scene itself, then the worlds of textures; NULL beyond the last. */
static const plr_world *world_at(const plr_view *view, size_t index) {
    if (index == 0)
        return &view->world;
    for (size_t i = 0; i < view->targets.count; i++)
        if (view->targets.items[i]->own && --index == 0)
            return view->targets.items[i]->own;
    return NULL;
}

static bool find(const plr_view *view, size_t index, found *out) {
    const plr_world *world;
    *out = (found){.volume = PLR_NO_EFFECT};
    for (size_t i = 0; (world = world_at(view, i)); i++) {
        size_t count = count_things(world);
        if (index < count) {
            take(world, index, out);
            return true;
        }
        index -= count;
    }
    return false;
}

size_t plr_view_drawable_count(const plr_view *view) {
    const plr_world *world;
    size_t count = 0;
    for (size_t i = 0; (world = world_at(view, i)); i++)
        count += count_things(world);
    return count;
}

bool plr_view_drawable(const plr_view *view, size_t index, plr_drawable *drawable) {
    found f;
    bool there = find(view, index, &f);
    *drawable = f.drawable;
    return there;
}

plr_program *plr_view_link_drawable(plr_view *view, size_t index, const plr_effect **effects,
                                    size_t *effect_count) {
    found f;
    if (!find(view, index, &f) || !f.drawable.program)
        return NULL;
    *effects = f.pass->recipe.effects.items;
    *effect_count = f.pass->recipe.effects.count;
    return plr_link_recipe(&view->composer, &f.pass->recipe, false, NULL);
}

bool plr_view_drawable_has(const plr_view *view, size_t index, size_t effect) {
    found f;
    if (!find(view, index, &f) || !f.pass || effect >= f.pass->recipe.bindings.count)
        return false;
    size_t volume = f.pass->recipe.bindings.items[effect].volume;
    return f.volume == PLR_NO_EFFECT || volume == PLR_NO_EFFECT || volume == f.volume;
}
