/* glTF 2.0 (ISO/IEC 12113), as JSON or as GLB, into nodes: as if the file were X3D. */
#ifndef PLR_X3D_GLTF_H
#define PLR_X3D_GLTF_H

#include "x3d/build.h"

/* Whether the text of a file is JSON or GLB: told by its content. */
bool x3d_is_gltf(const x3d_file *file);
/* Reads build->file; roots go to build->nodes. */
void x3d_read_gltf(x3d_build *build);

#endif
