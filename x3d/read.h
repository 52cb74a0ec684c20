#ifndef PLR_X3D_READ_H
#define PLR_X3D_READ_H

#include "x3d/scene.h"

/* Enters a text into the scene. `data` is of x3d_block_new and belongs to the scene from now on,
 * also if memory runs out. */
x3d_file *x3d_add_file(plr_scene *scene, const char *name, const char *folder, const char *real,
                       char *data, size_t length);

#endif
