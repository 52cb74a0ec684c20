/* Worlds: what is drawn together, made ready and freed. */
#include "engine/shadows.h"
#include "engine/volume.h"

void plr_view_enter(plr_view *view, plr_world *world) {
    plr_world kept = view->world;
    view->world = *world;
    *world = kept;
    view->entered = view->entered ? NULL : world;
}

void plr_world_prepare(plr_view *view, plr_diags *diags) {
    view->background.node = view->flat.background;
    view->background.to_world = view->flat.background_to_world;
    plr_background_prepare(view, &view->background);
    plr_volume_pass_find(view, diags);
    plr_surfaces_prepare(view, diags);
    plr_volume_pass_prepare(view, diags);
    plr_casters_prepare(view);
}

/* The unit of gradients that no author gave is found before the voxels leave main memory. */
static void find_gradient_units(plr_view *view) {
    bool needed = false;
    for (size_t i = 0; i < view->volumes.cast_count; i++)
        needed = needed || plr_bind_needs(&view->volumes.casts[i].pass.slots, "gradientUnit");
    for (size_t i = 0; view->volumes.caster_count && i < view->model_count; i++)
        needed = needed || plr_bind_needs(&view->models[i]->pass.slots, "gradientUnit");
    for (size_t i = 0; i < view->volumes.grids.count; i++) {
        plr_grid *grid = view->volumes.grids.items[i];
        if (grid->gradient_unit > 0 || !needed)
            continue;
        plr_texture *voxels = grid->voxels;
        if (!(voxels->steepness > 0))
            voxels->steepness = plr_volume_steepness(view, grid);
        grid->gradient_unit = 1 / voxels->steepness;
    }
}

void plr_world_find(plr_view *view) {
    plr_pass_find(view, &view->background.pass);
    for (size_t i = 0; i < view->volumes.cast_count; i++)
        plr_pass_find(view, &view->volumes.casts[i].pass);
    for (size_t i = 0; i < view->model_count; i++)
        plr_pass_find(view, &view->models[i]->pass);
    plr_casters_find(view);
    find_gradient_units(view);
}

void plr_world_finish(plr_view *view) {
    plr_casters_finish(view);
    for (size_t i = 0; i < view->model_count; i++)
        plr_model_finish(view, view->models[i]);
    view->model_count = 0;
}
