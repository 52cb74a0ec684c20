/* Lights and viewpoints as cameras: what a shadow map is drawn with and a texture is projected
 * with. No GL. */
#ifndef PLR_ENGINE_PROJECTOR_H
#define PLR_ENGINE_PROJECTOR_H

#include "engine/view.h"

/* Projection (clip space from -1 to 1 in all directions, as GL has it) and the matrix from world
 * space to the projector's eye space, without scale, as the scene stands now. Each zero of
 * projectionNear, projectionFar and projectionRectangle (then of projectionLocation, too) is chosen
 * such that all shapes that cast shadows are just inside.
 * A SpotLight sees projectionAngle in both directions, else 2 * cutOffAngle, at most 170 degrees. A
 * Viewpoint sees fieldOfView in both directions, whether it is bound or not. A PointLight sees 90
 * degrees along the world's -z: the caller turns it to the faces of a cube.
 * A light or viewpoint that stands nowhere in the scene but in the field that names it has world
 * coordinates. False if the node is no projector. */
bool plr_projector_matrices(const plr_view *view, const plr_node *projector, plr_matrix *projection,
                            plr_matrix *world_to_projector);

/* The product of both, kept until the scene changes. */
plr_matrix plr_projector_clip(plr_view *view, const plr_node *projector);

/* The projection to each face of a cube around a light that has a location, and its place in the
 * world: distances as of a PointLight. */
plr_matrix plr_projector_cube(const plr_view *view, const plr_node *light, double place[3]);

#endif
