/* One drawing of a world: from one camera into one framebuffer. Needs GL. */
#ifndef PLR_ENGINE_FRAME_H
#define PLR_ENGINE_FRAME_H

#include "engine/view.h"

/* Where it is drawn, and what of the world. */
typedef struct plr_shot {
    GLuint framebuffer;   /* with colours and depths */
    GLuint without_depth; /* the same colours, while volumes read the depths of plr_frame */
    GLuint depths;        /* what has the depths of plr_frame, from (0, 0) on */
    bool depths_copied;   /* these are a copy of those of `framebuffer` */
    const plr_background *background;
    const float *behind;      /* RGBA where there is no background; NULL: nothing is cleared */
    const plr_texture *avoid; /* what reads this texture is left out; may be NULL */
} plr_shot;

/* Near and far planes for a camera, such that the surfaces lie between them; and sorts: the depths
 * of this camera are those of the world until the next call. */
void plr_frame_depths(const plr_view *view, const plr_matrix *world_to_eye, bool parallel,
                      bool reversed, double depths[2]);
/* The frame of a viewpoint: matrices, viewport from (0, 0), time. */
void plr_frame_plan(const plr_view *view, const plr_viewpoint *viewpoint, int width, int height,
                    bool reversed, plr_frame *frame);
/* From world space to the camera in `place` that looks at a face of a cube map, 0 to 5 in the order
 * of GL: what is drawn with 90 degrees is read back by directions of the world. */
plr_matrix plr_frame_cube_face(const double place[3], int face);
/* Shifts the frame to one of several samples of its pixels. */
void plr_frame_jitter(plr_frame *frame, int sample, int samples);

/* A ray in eye space, of length 1 for each unit of t. */
typedef struct plr_ray {
    double origin[3], direction[3];
} plr_ray;

/* The ray through a place of the framebuffer, in pixels from the bottom left. */
void plr_frame_ray(const plr_frame *frame, double x, double y, plr_ray *ray);
/* Where along the ray a depth of the depth buffer is. */
double plr_frame_distance(const plr_frame *frame, const plr_ray *ray, double depth);
/* Where the ray runs in the box of a volume, from the eye on; false if nowhere. */
bool plr_volume_crossed(const plr_volume_state *volume, const plr_frame *frame, const plr_ray *ray,
                        double range[2]);

/* Whether our own framebuffers have reversed depths. */
bool plr_frame_reversed(const plr_view *view);
/* The depth conventions of our own framebuffers; not for those of hosts. */
void plr_frame_conventions(const plr_view *view, const plr_frame *frame);

/* The parts of a drawing, with the framebuffer and the viewport that are set. */
void plr_frame_draw_opaque(plr_view *view, const plr_frame *frame, const plr_shot *shot);
/* Translucent surfaces and volumes, from the farthest to the nearest. Volumes read the depths of
 * the frame, so they are drawn without them where that texture belongs to the framebuffer. */
void plr_frame_draw_translucent(plr_view *view, const plr_frame *frame, const plr_shot *shot);
/* All of it into our own framebuffer: conventions, background, opaque, translucent. Binds
 * framebuffer and viewport. */
void plr_frame_draw(plr_view *view, const plr_frame *frame, const plr_shot *shot);

#endif
