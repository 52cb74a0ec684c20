/* What GL is told to draw a surface, beside its program: blending, widths of lines, sizes of
 * points. */
#ifndef PLR_ENGINE_SURFACE_STATE_H
#define PLR_ENGINE_SURFACE_STATE_H

#include <plugray/engine.h>
#include "engine/gl.h"

struct plr_shape;

typedef struct plr_surface_state {
    const plr_node *blend_mode;      /* NULL: the usual over */
    const plr_node *line_properties; /* NULL: lines of nominal width */
    bool sizes_points;               /* the vertex stage says how large */
    GLenum factors[4];               /* source and destination, of colour, then of alpha */
    GLenum equations[2];             /* of colour, of alpha */
} plr_surface_state;

/* From the nodes of the shape's appearance; reports words that mean nothing. */
void plr_surface_state_read(const struct plr_shape *shape, plr_surface_state *state);
/* Around a draw. Needs GL. */
void plr_surface_state_enter(const plr_gl *gl, const plr_surface_state *state, bool blends);
void plr_surface_state_leave(const plr_gl *gl, const plr_surface_state *state);

#endif
