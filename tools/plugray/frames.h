/* Pictures of a scene at one time after another. */
#ifndef PLR_TOOLS_FRAMES_H
#define PLR_TOOLS_FRAMES_H

#include "tools/plugray/options.h"

typedef struct frame_plan {
    double start, rate; /* seconds; frames a second */
    long count;         /* 0: one picture, without a number */
} frame_plan;

/* Reads --frames and --fps; keeps `start`; false where they are wrong (said). */
bool frames_read(const tool_arguments *arguments, frame_plan *plan);
/* The time of frame `index`, from 0. */
double frames_time(const frame_plan *plan, long index);
/* Where its picture goes: a name with %d or %04d gets the number there, another one before its
 * ending, "a.png" becomes "a-0001.png". Numbers count from 1. malloc'ed. */
char *frames_path(const frame_plan *plan, const char *path, long index);

#endif
