/* The parts of plugray info. Each gathers what it tells into a report, then prints it as text or
 * writes it as JSON on standard output. */
#ifndef PLUGRAY_TOOL_INFO_H
#define PLUGRAY_TOOL_INFO_H

#include <plugray/engine.h>

#include "engine/volume_statistics.h"

/* Every node of the scene, once. */
typedef struct node_list {
    plr_node **items;
    size_t count;
} node_list;

/* ---- Transfer functions ---- */

enum {
    TRANSFER_KNOTS = 8,
    TRANSFER_TEXELS = 64
};

typedef struct transfer_knot {
    double value; /* physical */
    double color[3], opacity;
} transfer_knot;

/* A transfer function to start with: linear between its knots. */
typedef struct transfer {
    transfer_knot knots[TRANSFER_KNOTS];
    size_t count;    /* 0: the values tell nothing */
    double range[2]; /* what the voxels' 0 and 1 stand for */
} transfer;

/* For the first component of a volume whose values from range[0] to range[1] are shown. */
transfer transfer_to_start_with(const plr_volume *volume, const plr_volume_statistics *statistics,
                                const double range[2]);
/* As an OpacityMapVolumeStyle node, in XML or Classic VRML, every line after `indent`. */
void print_transfer(FILE *out, const transfer *t, bool xml, const char *indent);

/* ---- Volumes ---- */

/* A field of a node that a texture stands in. */
typedef struct volume_use {
    const plr_node *texture, *user;
    const char *field;
} volume_use;

typedef struct volume_report {
    const plr_node *texture;
    const volume_use *uses;
    size_t use_count;
    plr_volume volume;
    plr_volume_statistics statistics[4]; /* by component */
    double shown[2];                     /* what 0 and 1 stand for */
    bool shown_by_node;                  /* the volume node says so */
    plr_label_count *labels;             /* NULL: no segment numbers */
    size_t label_count;
    bool more_labels;
    transfer transfer;
} volume_report;

/* The 3D textures of a scene, in its order. */
typedef struct volume_list {
    volume_use *uses; /* by texture */
    size_t use_count, capacity;
} volume_list;

volume_list find_volumes(const node_list *nodes);
void free_volumes(volume_list *list);
/* The report of the texture whose uses begin at `*next`, which is moved on; false at the end.
 * `readable`: its voxels could be read (what is wrong was reported when the view was made). */
bool next_volume(const volume_list *list, plr_scene *scene, size_t *next, volume_report *report,
                 bool *readable);
void free_volume_report(volume_report *report);

void print_volume(const volume_report *report, bool xml);
void write_volume(const volume_report *report, bool xml);

/* ---- Programs ---- */

void print_programs(plr_view *view);
/* How its volumes are sampled; nothing without volumes. */
void print_plan(const plr_view *view);
void write_plan(const plr_view *view);
void write_programs(plr_view *view);

#endif
