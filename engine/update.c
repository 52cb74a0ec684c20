/* A view in time: the scene as its viewer sees it, and what has to be made anew when it changes. */
#include "engine/update.h"

#include <string.h>

#include "engine/changes.h"
#include "engine/dialect.h"
#include "engine/general.h"
#include "engine/targets.h"

/* ---- The scene at a time ---- */

const plr_viewpoint *plr_view_chosen(const plr_view *view, const plr_flat *flat) {
    const plr_viewpoint *chosen = plr_flat_viewpoint(flat, view->desc.viewpoint);
    return chosen || !view->made ? chosen : plr_flat_viewpoint(flat, NULL);
}

/* Depths do not matter to sensors. */
static plr_viewer viewer_at(const plr_viewpoint *viewpoint, const plr_node *bound, double aspect) {
    plr_viewer viewer = {.viewpoint = bound};
    plr_matrix projection, view;
    plr_viewpoint_matrices(viewpoint, aspect > 0 ? aspect : 4.0 / 3, 1, (double[]){0.1, 1e4},
                           &projection, &view);
    memcpy(viewer.eye_to_world, viewpoint->to_world.m, sizeof viewer.eye_to_world);
    memcpy(viewer.world_to_eye, view.m, sizeof view.m);
    memcpy(viewer.projection, projection.m, sizeof projection.m);
    return viewer;
}

/* Where the first look comes from, for any time the same: as the file has it, or the first
 * viewpoint where that is hidden. */
static void find_first(plr_view *view, plr_arena *arena) {
    plr_flat flat;
    plr_flatten(arena, view->scene, NULL, &flat, NULL);
    const plr_viewpoint *chosen = plr_view_chosen(view, &flat);
    view->first = chosen ? *chosen : *plr_flat_viewpoint(&flat, NULL);
}

/* What happens in the scene may move the viewer, or put another one in his place, and that may be
 * seen by what happens: it is looked at again from where he comes to stand. */
bool plr_view_live(plr_view *view, plr_matrix *eye_to_world, plr_diags *diags) {
    enum {
        LOOKS = 3
    };
    jmp_buf out_of_memory;
    plr_arena arena;
    plr_arena_init(&arena, NULL, &out_of_memory);
    if (setjmp(out_of_memory)) {
        plr_arena_finish(&arena);
        longjmp(*view->arena.out_of_memory, 1);
    }
    plr_flat flat;
    view->desc.dialect = plr_dialect_set(view->scene, view->asked_dialect);
    if (!view->made)
        find_first(view, &arena);
    plr_viewpoint used = view->first;
    const plr_node *asked = used.node;
    const plr_viewpoint *chosen = NULL;
    bool same = false;
    for (int i = 0; i < LOOKS && !same; i++) {
        plr_viewer viewer = viewer_at(&used, asked, view->desc.aspect);
        plr_scene_set_time(view->scene, view->desc.time, &viewer, diags);
        plr_flatten(&arena, view->scene, &used.to_world, &flat, NULL);
        chosen = plr_view_chosen(view, &flat);
        if (!chosen)
            break;
        const plr_viewpoint *now = plr_flat_bound(&flat, chosen);
        same = now->node == used.node && chosen->node == asked &&
               memcmp(now->to_world.m, used.to_world.m, sizeof used.to_world.m) == 0;
        used = *now;
        asked = chosen->node;
    }
    *eye_to_world = used.to_world;
    plr_arena_finish(&arena);
    return chosen != NULL;
}

/* ---- What has changed ---- */

uint64_t plr_deep_revision(const plr_node *node, int depth) {
    uint64_t sum = plr_node_revision(node);
    for (size_t i = 0; depth > 0 && i < plr_node_field_count(node); i++) {
        const plr_field *field = plr_node_field_at(node, i);
        if (plr_type_kind(field->type) != PLR_NODE || strcmp(field->name, "metadata") == 0 ||
            strcmp(field->name, "effects") == 0)
            continue;
        for (size_t k = 0; k < field->count; k++)
            if (field->value.nodes[k])
                sum += plr_deep_revision(field->value.nodes[k], depth - 1);
    }
    return sum;
}

enum {
    TEXTURE_DEPTH = 2 /* a cube map or a 3D texture, its images, their properties */
};

void plr_view_note_textures(plr_view *view) {
    for (size_t i = 0; i < view->textures.list.count; i++) {
        plr_texture *texture = view->textures.list.items[i];
        if (texture->node && !texture->generated)
            texture->revision = plr_deep_revision(texture->node, TEXTURE_DEPTH);
    }
}

static void reload_textures(plr_view *view) {
    for (size_t i = 0; i < view->textures.list.count; i++) {
        plr_texture *texture = view->textures.list.items[i];
        if (texture->node && !texture->generated &&
            texture->revision != plr_deep_revision(texture->node, TEXTURE_DEPTH))
            plr_textures_reload(&view->textures, texture);
    }
}

/* ---- Updating ---- */

void plr_view_remake(plr_view *view, const plr_matrix *eye, plr_diags *diags) {
    plr_view_set_diags(view, diags);
    plr_targets_finish(view);
    plr_world_finish(view);
    memset(&view->world, 0, sizeof view->world);
    memset(&view->targets, 0, sizeof view->targets);
    plr_textures_sweep(&view->textures);
    jmp_buf *out_of_memory = view->arena.out_of_memory;
    plr_arena_finish(&view->arena);
    plr_arena_init(&view->arena, NULL, out_of_memory);
    reload_textures(view);
    view->composer.waiting = view->composer.refused = 0;
    plr_view_make(view, eye, diags);
    plr_view_set_diags(view, NULL);
}

static void follow(plr_view *view, const plr_matrix *eye, plr_diags *diags) {
    plr_change change = plr_view_changed(view);
    view->eye_to_world = *eye;
    if (change == PLR_CHANGE_PARTS || (change == PLR_CHANGE_PLACES && !plr_view_move(view, eye)))
        plr_general_remake(view, diags);
    else
        view->stats.built = 0;
    view->revision = plr_scene_revision(view->scene);
}

bool plr_view_update(plr_view *view, double time, plr_diags *diags) {
    jmp_buf out_of_memory;
    volatile bool fine = true;
    view->arena.out_of_memory = view->lasting.out_of_memory = &out_of_memory;
    if (setjmp(out_of_memory) == 0) {
        plr_matrix eye = plr_matrix_identity();
        view->desc.time = time;
        if (plr_view_live(view, &eye, diags))
            follow(view, &eye, diags);
    } else {
        fine = false;
        plr_view_set_diags(view, NULL);
        plr_diags_add(diags, PLR_CODE_NO_MEMORY, (plr_place){0}, "there is not enough memory");
    }
    return fine;
}
