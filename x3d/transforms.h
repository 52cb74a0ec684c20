/* Nodes that move what is below them. */
#ifndef PLR_X3D_TRANSFORMS_H
#define PLR_X3D_TRANSFORMS_H

#include <plugray/x3d.h>

/* Whether the type of the node is one that plr_node_transform knows. */
bool x3d_transforms(const plr_node *node);

#endif
