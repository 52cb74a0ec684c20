/* What each shape and volume of a scene calls, in the order of its program. */
#ifndef PLUGRAY_TOOL_PLUGS_CHAIN_H
#define PLUGRAY_TOOL_PLUGS_CHAIN_H

#include <plugray/engine.h>

/* On standard output: as text, as one JSON object. */
void print_chains(plr_view *view);
void write_chains(plr_view *view);

#endif
