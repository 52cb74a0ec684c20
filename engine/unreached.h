/* Text that nothing calls is not in a program; whether it would compile is worth a warning. No GL.
 */
#ifndef PLR_ENGINE_UNREACHED_H
#define PLR_ENGINE_UNREACHED_H

#include "engine/compose.h"

/* Compiles the recipe with nothing left out and keeps what the compiler says of authors' effects.
 */
void plr_unreached_collect(plr_composer *composer, const plr_recipe *recipe);
/* Warns of what was kept, once all programs are composed: but not of lines that stand in some
 * program and were compiled there. An effect may serve surfaces and volumes, and neither knows the
 * other's structs. */
void plr_unreached_report(plr_composer *composer);

#endif
