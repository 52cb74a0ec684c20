/* What is seen in a pixel: see plr_view_pick. */
#ifndef PLR_ENGINE_PICK_H
#define PLR_ENGINE_PICK_H

#include "engine/view.h"

/* Numbers, segment and name of what the data of a volume have at a place of its box, 0 to 1. They
 * are read again, and kept until another volume is picked from. */
void plr_pick_read(plr_view *view, const plr_volume_state *volume, const double place[3],
                   plr_pick *pick);
void plr_picked_data_free(struct plr_picked_data **data);

#endif
