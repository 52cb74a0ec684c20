/* Textures that the engine draws into before the picture: RenderedTexture, GeneratedCubeMapTexture,
 * shadow maps.
 *
 * A target is drawn where a program of the picture, or of another target that is drawn, reads it;
 * what is read comes first. Shapes that read the texture that is being drawn are left out of it. Of
 * targets that read each other in a circle, the one that is reached first shows the others, and the
 * others show it as cleared: a picture depends on the scene and the time, not on the pictures
 * before. */
#ifndef PLR_ENGINE_TARGETS_H
#define PLR_ENGINE_TARGETS_H

#include "engine/shadows.h"

typedef struct plr_target {
    plr_texture *texture;
    plr_node *node;             /* NULL: a shadow map that no node describes */
    plr_shadow *shadow;         /* NULL: no shadow map */
    plr_world *own;             /* a world that only it shows; or NULL */
    plr_background *background; /* NULL: that of the world */
    const plr_viewpoint
        *viewpoint; /* NULL: that of the picture; no meaning for cubes and shadows */
    plr_canvas canvas;
    bool once;  /* drawn when the scene has changed */
    bool never; /* cleared and no more */
    /* ---- While pictures are drawn ---- */
    enum {
        TARGET_UNSEEN,
        TARGET_OPEN,
        TARGET_DONE
    } state;
    bool clear, drawn;
    uint64_t revision;         /* of the scene, when it was drawn */
    plr_world *world;          /* what it shows; NULL: the scene */
    const plr_surface *reader; /* the first surface there that reads it; NULL: none */
} plr_target;

/* Makes targets of all generated textures, with the worlds that they show. */
void plr_targets_prepare(plr_view *view, plr_diags *diags);
/* Adds that of a shadow, unless there is one; false if there are too many. */
bool plr_targets_add_shadow(plr_view *view, plr_shadow *shadow);
/* Locations of the programs of further worlds. Needs GL. */
void plr_targets_find(plr_view *view);
/* Draws what the picture needs. `here` has the camera of the picture where that is not the
 * viewpoint's; may be NULL. Changes state of the context. Needs GL. */
void plr_targets_draw(plr_view *view, const plr_frame *here);
void plr_targets_finish(plr_view *view);

/* Projection and world-to-eye matrix of the camera that a RenderedTexture is drawn with, near 0.1
 * and far 1000 unless its viewpoint says otherwise. False if the node is none of this view. */
bool plr_targets_camera(plr_view *view, const plr_node *texture, plr_matrix *projection,
                        plr_matrix *viewing);

#endif
