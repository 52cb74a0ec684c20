/* Whether it pays to leap over blocks where nothing can be seen. */
#ifndef PLR_ENGINE_VOLUME_LEAPS_H
#define PLR_ENGINE_VOLUME_LEAPS_H

#include <plugray/engine.h>

#include "engine/volume_blocks.h"

/* What it costs without leaps to find what can be seen, divided by what it costs with them: of some
 * rays through a volume, in steps of so many voxels. `leaps`: of plr_blocks_leaps. */
double plr_leaps_gain(const plr_blocks *blocks, const uint32_t *leaps, plr_method method,
                      double step);
/* Below, leaps do not pay: rays that are drawn together wait for each other. */
double plr_leaps_least_gain(plr_method method);

#endif
