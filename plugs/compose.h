/* Puts the reached items of a stage into one text, each after what it names. */
#ifndef PLR_PLUGS_COMPOSE_H
#define PLR_PLUGS_COMPOSE_H

#include "plugs/print.h"

void plr_compose(plr_linking *l, plr_stage stage, plr_printer *printer);

#endif
