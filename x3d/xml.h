#ifndef PLR_X3D_XML_H
#define PLR_X3D_XML_H

#include "x3d/build.h"

/* Brings the text of a file to UTF-8, as its first bytes or its declaration tell; places are then
 * those in the converted text. False: not possible (reported). */
bool x3d_xml_to_utf8(plr_scene *scene, x3d_file *file);

#endif
