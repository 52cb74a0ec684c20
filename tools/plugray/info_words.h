/* Words and numbers that the text and the JSON of plugray info share. */
#ifndef PLUGRAY_TOOL_INFO_WORDS_H
#define PLUGRAY_TOOL_INFO_WORDS_H

#include <plugray/engine.h>

#include "engine/volume.h"

/* "uint16" */
const char *voxel_type_word(plr_voxel_type type);
/* "mm"; "x 0.02 m"; "mm (not said)" where the file says none. */
const char *length_unit(double metres, char buffer[32]);
/* Lengths of the steps from voxel to voxel. */
void voxel_sides(const plr_volume *volume, double sides[3]);
/* Where a voxel axis points, by the greatest part of its direction: "to the left (L)", "up (S)"; or
 * "along -y". */
const char *voxel_axis_words(const plr_volume *volume, int axis, char buffer[16]);
/* L, R, A, P, S or I; 0 where the file does not say. */
char voxel_axis_letter(const plr_volume *volume, int axis);
/* The greatest angle between a voxel axis and the axis of the space next to it, in degrees. */
double voxel_tilt(const plr_volume *volume);
/* Whether the voxel axes are right-handed in the world, as the axes of a scene are. */
bool is_right_handed(const plr_volume *volume);

/* On standard output: "VolumeData HEAD at scene.x3d:3:5"; JSON members "node", "def", "place". */
void print_node(const plr_node *node);
void write_node(const plr_node *node);
void write_numbers(const double *numbers, size_t count);

#endif
