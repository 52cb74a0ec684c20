/* What the files of volumes in a scene share: loading, styles, programs, drawing. */
#ifndef PLR_ENGINE_VOLUME_PASS_H
#define PLR_ENGINE_VOLUME_PASS_H

#include "engine/view.h"

/* ---- Data (volume_load.c) ---- */

/* The voxels, labels and place that a node's fields name, read once for each state of the nodes;
 * NULL where there are none to be had (reported). `owner`: a volume node or BlendedVolumeStyle. */
const plr_kept_volume *plr_volume_keep(plr_view *view, const plr_node *owner, plr_diags *diags);
/* What is kept of them now; NULL: nothing. */
plr_kept_volume *plr_volume_kept(plr_view *view, const plr_node *owner);
/* Makes the state of a leaf from its data; false if nothing of it can be drawn. */
bool plr_volume_load(plr_view *view, const plr_leaf *leaf, plr_volume_state *state,
                     plr_diags *diags);

/* The voxels of a grid: those that are still held, else read into `again`, which is the caller's to
 * free; NULL: they cannot be had any more. */
const plr_image *plr_volume_voxels(plr_view *view, const plr_grid *grid, plr_image *again);

/* ---- Made of voxels (volume_gradients.c, volume_quads.c) ---- */

/* Whether textures may be made of a volume's voxels: gradients, and voxels four a texel. */
bool plr_volume_can_derive(const plr_volume_state *state);
/* Makes those that the program of a cast reads, once for the voxels. */
void plr_cast_derive(plr_view *view, plr_cast *cast);
/* Whether voxels are bytes, whatever they are held as. */
bool plr_volume_has_bytes(const plr_image *voxels);
/* Whether a texture may have its voxels four a texel. */
bool plr_volume_has_quads(const plr_volume_state *state);
/* Voxels of one component, four a texel: (i, j, k), (i + 1, j, k), (i, j + 1, k), (i + 1, j + 1, k)
 * for the texel (i, j, k). False: no memory. */
bool plr_volume_fill_quads(const plr_image *voxels, plr_image *out);

/* ---- Surfaces of equal value (volume_surfaces.c) ---- */

/* Finds the values of IsoSurfaceVolumeData, or of a style of 2005 that draws one. */
void plr_volume_find_surfaces(plr_view *view, plr_volume_state *state, plr_diags *diags);
/* The style of 2005 that makes a surface of a VolumeData; or NULL. */
const plr_node *plr_surface_style(const plr_node *style);

/* ---- Styles (volume_styles.c) ---- */

/* Whether the styles of a volume node draw anything at all. */
bool plr_volume_has_styles(const plr_volume_state *state);
/* Adds the styles of a volume, attached to its effect, to a recipe; `lights` says where the light
 * comes from. NULL: there is none, of styles that only say what is opaque. `tabled`: without the
 * leading opacity maps, which a table has. */
void plr_volume_add_styles(plr_view *view, plr_recipe *recipe, size_t volume, size_t attached,
                           const plr_scope *lights, bool tabled, plr_diags *diags);

/* Whether anything of a segment is drawn, with this style (NULL: the default one). */
bool plr_volume_draws_segment(const plr_node *node, const plr_node *style, size_t segment);

/* Where the transfer function of an opacity map is among those of all volumes; NULL: the default
 * ramp. NULL where it needs a texture of its own. */
const plr_atlas_place *plr_style_place(plr_view *view, const plr_node *map, const plr_grid *grid);

/* ---- Bricks (volume_bricks.c) ---- */

/* The sides of bricks that fit into textures of so many texels a side (0: any) and so many bytes.
 */
void plr_bricks_plan(const plr_image *image, uint32_t most_side, size_t most_bytes,
                     uint32_t sides[3]);
/* Calls `cast` for each brick, the farthest first, with the grid set to it. Needs GL. */
void plr_bricks_cast(plr_view *view, const plr_volume_state *state, const plr_frame *frame,
                     void (*cast)(void *), void *user);

/* ---- Order (volume_order.c) ---- */

/* Sorts volumes by what they are, whatever the order in which the scene has them. */
void plr_volume_order(plr_view *view, size_t *members, size_t count);

/* ---- Programs (volume_recipe.c) ---- */

/* Notes that an effect of an author is called at a plug, of a volume or (PLR_NO_EFFECT) of all:
 * what it does with samples nobody knows, unless it promises something (volume_skip.c). */
void plr_volume_note_call(plr_volume_pass *pass, const char *plug, size_t volume,
                          plr_promises promises);
/* Whether samples that the leading opacity maps of a volume make clear stay so in its styles
 * (volume_skip.c). */
bool plr_volume_keeps_clear(const plr_volume_state *state);
/* Whether a cast may pass over samples of such volumes: nobody else asks for each of them. */
bool plr_cast_skips(const plr_view *view, const plr_cast *cast, bool early_end);
void plr_cast_build_recipe(plr_view *view, plr_cast *cast, bool early_end, plr_diags *diags);
/* Divides a cast whose rays take more steps than the renderer can in one drawing; where that cannot
 * be, its steps become longer, with a warning (no diagnostics: it stays as it is). */
void plr_cast_find_slabs(plr_view *view, plr_cast *cast, bool early_end, plr_diags *diags);
/* Slabs for the steps that its volumes have now; false where the renderer cannot take so many, even
 * in slabs: then nothing has changed. */
bool plr_cast_fit_slabs(const plr_view *view, plr_cast *cast);
/* Whether it needs slabs, should steps become so many times as long. */
bool plr_cast_has_slabs(const plr_view *view, const plr_cast *cast, double length);
/* Narrows the near and far planes to a slab; 0 is the nearest. */
void plr_cast_slab(const plr_cast *cast, unsigned slab, double cut[2]);
/* The clip planes of a volume: its own, in the node's coordinates, and those of the scene around
 * it.
 */
void plr_volume_add_planes(plr_view *view, plr_recipe *recipe, size_t volume, size_t attached);

/* ---- Shadows (volume_shadows.c) ---- */

/* Whether a style asks for shadows; `general`: or would, with lighting. */
bool plr_style_has_shadows(const plr_node *style, bool general);
/* Whether some style of a volume would, were everything on. */
bool plr_volumes_have_shadows(const plr_view *view);
/* Finds which volumes cast some. */
void plr_volume_find_shadows(plr_view *view, plr_diags *diags);
/* Whether colours of what is transparent matter to nothing in the volume. */
bool plr_volume_skips_clear(const plr_view *view, size_t volume);

#endif
