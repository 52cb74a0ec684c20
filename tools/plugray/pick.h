/* What is seen in a pixel, as JSON. */
#ifndef PLUGRAY_TOOL_PICK_H
#define PLUGRAY_TOOL_PICK_H

#include <stdio.h>

#include <plugray/engine.h>

/* One object on one line. */
void pick_print(FILE *out, const plr_pick *pick);

#endif
