/* Size, shear and place of a volume as its file says. No GL. */
#ifndef PLR_ENGINE_VOLUME_GEOMETRY_H
#define PLR_ENGINE_VOLUME_GEOMETRY_H

#include "base/matrix.h"
#include "engine/volume.h"

/* What lengths mean in a file that has none of its own: as medicine takes it, millimetres. */
#define PLR_VOLUME_DEFAULT_METRES 1e-3

/* For the field `fileGeometry`: `dimensions` are the true lengths of the sides, and `box_to_scene`
 * carries the box of these dimensions, centred at the origin, to where the file says that it is,
 * both in units of `unit_metres` metres. The matrix rotates, shears and shifts, but never scales.
 *
 * The scene's axes are those of the file's space as written (LPS: x to the left), with one
 * exception: a space that is left-handed (LAS) gets its x turned round, since in the scene, which
 * is right-handed, everything would be its own mirror image. Where directions make the matrix a
 * reflection, the file stores the voxels in mirrored order; reflected they are the right way round.
 *
 * False, and nothing is written, where the file says nothing usable: no geometry, or directions
 * that span no volume. */
bool plr_volume_file_geometry(const plr_volume *volume, double unit_metres,
                              plr_matrix *box_to_scene, double dimensions[3]);

/* From voxel indices (i, j, k) to the file's space in the file's own unit, as written; whatever
 * has_geometry says. */
plr_matrix plr_volume_affine(const plr_volume *volume);

/* Where an axis of a space points, by the sign of `step`: "left", "right", "front", "back", "up",
 * "down"; NULL where the space does not say. `letter` (may be NULL) gets L R A P S I. */
const char *plr_space_direction(plr_volume_space space, int axis, double step, char *letter);

/* Whether a space, and a box in it, are of a size with which floats can compute: lengths are
 * squared. */
bool plr_volume_has_extent(const plr_matrix *to_world, const double dimensions[3]);

#endif
