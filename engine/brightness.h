/* How bright what lies behind volumes can be. No GL. */
#ifndef PLR_ENGINE_BRIGHTNESS_H
#define PLR_ENGINE_BRIGHTNESS_H

#include "engine/view.h"

/* A bound of all channels of surfaces and background, 1 at least; infinite where none is known, as
 * of authors' effects. What a ray that ends early leaves out is as much the more. */
double plr_view_brightest(const plr_view *view);

#endif
