/* What a view draws, thing by thing, for listings. */
#include "engine/view.h"

typedef struct found {
    plr_drawable drawable;
    plr_pass *pass;
    size_t volume; /* PLR_NO_EFFECT: no volume */
} found;

static plr_pass *cast_of(const plr_view *view, size_t volume) {
    for (size_t i = 0; i < view->volumes.cast_count; i++)
        for (size_t m = 0; m < view->volumes.casts[i].count; m++)
            if (view->volumes.casts[i].members[m] == volume)
                return &view->volumes.casts[i].pass;
    return NULL;
}

/* Shapes, then volumes, then the background. */
static bool find(const plr_view *view, size_t index, found *out) {
    *out = (found){.volume = PLR_NO_EFFECT};
    if (index < view->model_count) {
        plr_model *model = view->models[index];
        out->drawable = (plr_drawable){.kind = "surface", .node = model->node};
        out->pass = &model->pass;
    } else if ((index -= view->model_count) < view->volumes.count) {
        out->drawable = (plr_drawable){.kind = "volume", .node = view->volumes.volumes[index].node};
        out->volume = index;
        out->pass = cast_of(view, index);
    } else if (index == view->volumes.count && view->background.pass.built) {
        out->drawable = (plr_drawable){.kind = "background", .node = view->background.node};
        out->pass = (plr_pass *)&view->background.pass;
    } else {
        return false;
    }
    if (out->pass && out->pass->built)
        out->drawable.program = &out->pass->built->info;
    return true;
}

size_t plr_view_drawable_count(const plr_view *view) {
    return view->model_count + view->volumes.count + (view->background.pass.built != NULL);
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
