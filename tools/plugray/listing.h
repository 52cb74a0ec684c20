/* What is written about a linked program: its map. */
#ifndef PLUGRAY_TOOL_LISTING_H
#define PLUGRAY_TOOL_LISTING_H

#include <stdio.h>

#include <plugray/plugs.h>

/* The name of an effect for people and maps: its own, else "effect 3"; "-" for PLR_NO_EFFECT.
 * `buffer` is used where a name must be made. */
const char *effect_label(const plr_effect *effects, size_t index, char buffer[32]);

/* FILE:LINE:COLUMN, or - for none, on standard output. */
void print_place(plr_place place);
/* {"file": ..., "line": ..., "column": ...}, on standard output. */
void write_place(plr_place place);
/* Text from files: what could steer a terminal becomes blank. */
void print_plain(const char *text);
/* A plug: its name, argument lists and stage; then who offers it and whose functions are called. */
void print_plug(const plr_program *program, size_t index, const plr_effect *effects);

/* A line for each line of the program: LINE, FILE:LINE:COLUMN, EFFECT, separated by tabs. What the
 * linker wrote itself stands at -:0:0. */
void write_map(FILE *out, const plr_program *program, plr_stage stage, const plr_effect *effects);

#endif
