/* How the volumes of a cast are sampled. */
#ifndef PLR_ENGINE_VOLUME_PLAN_H
#define PLR_ENGINE_VOLUME_PLAN_H

#include "engine/view.h"

/* Decides it, once it is known what authors do with samples; without it, all are looked at in the
 * middle of steps. */
void plr_cast_plan(plr_view *view, plr_cast *cast, bool early_end);
/* Says it in words, once the program is composed (volume_plan_words.c). */
void plr_cast_explain(plr_view *view, plr_cast *cast, bool early_end);

#endif
