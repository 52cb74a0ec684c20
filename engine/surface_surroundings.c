/* What is around a surface: fog, clip planes; and the way of its colour to the picture. */
#include "engine/surface.h"

void plr_shape_surroundings(plr_shape *shape) {
    (void)shape;
}
