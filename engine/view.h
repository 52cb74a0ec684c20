/* The insides of a plr_view, shared by the passes that draw it. */
#ifndef PLR_ENGINE_VIEW_H
#define PLR_ENGINE_VIEW_H

#include "engine/bind.h"
#include "engine/framebuffer.h"
#include "engine/light_strength.h"
#include "engine/mesh.h"
#include "engine/surface_state.h"
#include "engine/transfer_atlas.h"
#include "engine/traverse.h"

struct plr_engine {
    plr_gl gl;
    plr_cache *cache;
    plr_catalog *catalog;
    plr_engine_desc desc;
    plr_builder *builder; /* NULL: no view was interactive yet */
};

/* A program with everything that it needs to run. */
typedef struct plr_pass {
    plr_recipe recipe;
    plr_built *built; /* NULL: nothing is drawn */
    const plr_program *program;
    plr_slots slots;
} plr_pass;

/* What is said of a cast whose steps pilots chose (engine/pilot.h). */
typedef struct plr_piloted {
    double step, allowed; /* as planned; 0: not looked at yet */
    const char *why;
    bool applied; /* what was measured */
    plr_choice *choices;
    char words[640], method[704], error[128];
} plr_piloted;

/* Volumes that are cast together, mixed where they overlap. */
typedef struct plr_cast {
    plr_pass pass;
    size_t *members; /* indices of volumes */
    size_t count;
    double depth;             /* of the nearest centre, in this frame */
    double nearest, farthest; /* of its boxes */
    bool divided;             /* by translucent surfaces inside: it is drawn in parts */
    bool writes_depth;
    bool drawn;               /* in this frame */
    unsigned slabs;           /* along the view, in which it is cast */
    bool picks;               /* says what is seen instead of drawing it (engine/pick.c) */
    struct plr_cast *picking; /* the same that picks; NULL: not asked for yet */
    bool everywhere;          /* an author draws where no volume is, too */
    plr_plan plan;            /* how rays are integrated */
    double allowed;           /* error of the integral along a ray, of PLR_METHOD_CELLS */
    bool dense;               /* next to nothing is clear: nobody looks for what is not */
    bool short_leaps;         /* so short that nobody leaps: */
    double leap_gain;         /* plr_leaps_gain */
    bool early_end;           /* rays may end early, and be cut into slabs */
    plr_piloted *piloted;     /* NULL: pilots have nothing to do with it */
} plr_cast;

/* Voxels that outlive a change of the scene. */
typedef struct plr_kept_volume {
    const plr_node *node; /* that has them in a field: VolumeData, BlendedVolumeStyle */
    uint64_t revision;    /* of its nodes, when they were read */
    plr_grid grid;
    uint32_t full_size[3]; /* of the data, before they were brought down to fit */
    plr_texture *labels;   /* or NULL */
    plr_texture *cell_labels;
    plr_texture *gradients; /* of the voxels; NULL: not asked for yet */
    plr_texture *quads;     /* the voxels again, four a texel; NULL: not asked for yet */
    bool placed;            /* the file says where it is and how large: */
    plr_matrix place;
    double dimensions[3];
    uint64_t hash;                   /* of the voxels */
    const struct plr_blocks *blocks; /* of voxels of one component that are cast as a whole */
    const struct plr_bends *bends;   /* of these, if they are not very many */
} plr_kept_volume;

/* All volumes: most in one cast; one whose author decides how it accumulates is a layer of its own.
 */
typedef struct plr_volume_pass {
    plr_volume_state *volumes;
    const plr_leaf **leaves; /* parallel to volumes */
    size_t count;
    plr_cast *casts; /* as many as there are volumes at most */
    size_t cast_count;
    plr_atlas functions;
    struct {
        plr_grid **items;
        size_t count, capacity;
    } grids;         /* of the volumes and of their styles */
    size_t *casters; /* indices of those that cast shadows, in the order of plr_volume_order */
    size_t caster_count;
} plr_volume_pass;

/* A shape with its program: shared by all places where it stands under the same lights and
 * effects. */
typedef struct plr_model {
    const plr_node *node;   /* Shape */
    const plr_scope *scope; /* the nearest one around it that brings anything */
    plr_pass pass;
    plr_mesh mesh;
    bool blends;
    plr_surface_state state;
    struct plr_model *caster; /* the same into shadow maps; NULL: casts none, or none is drawn */
    GLuint vertex_array, buffers[40];
    int buffer_count;
} plr_model;

typedef struct plr_surface {
    plr_model *model;
    plr_matrix to_world;
    double depth; /* of the centre, in this frame */
    double reach; /* from there to its nearest and its farthest place */
    bool inside;  /* of a volume: it divides rays, in this frame */
} plr_surface;

/* Which faces of a surface. */
typedef enum plr_faces {
    PLR_FACES_ALL,
    PLR_FACES_BACK,
    PLR_FACES_FRONT
} plr_faces;

/* A drawing of a translucent surface. */
typedef struct plr_blend {
    plr_surface *surface;
    plr_faces faces;
    double depth;
} plr_blend;

typedef struct plr_background {
    plr_node *node; /* NULL: none */
    plr_matrix to_world;
    plr_pass pass; /* of more than one colour */
} plr_background;

/* The lights that have a shadow map (engine/shadows.h). */
typedef struct plr_shadows {
    struct plr_shadow **items;
    size_t count, capacity;
} plr_shadows;

/* A ROUTE of the scene that begins at a target's node. */
typedef struct plr_signal {
    size_t target, route;
} plr_signal;

/* Textures that are drawn before the picture (engine/targets.h). */
typedef struct plr_targets {
    struct plr_target **items;
    size_t count, capacity;
    size_t *order; /* of drawing */
    size_t order_count;
    struct {
        plr_signal *items;
        size_t count, capacity;
    } signals;
} plr_targets;

/* What is drawn together: the scene, or what a RenderedTexture shows in its place. A view has the
 * fields of the one that it is at as its own (plr_view_enter). */
#define PLR_WORLD_FIELDS                                                                           \
    plr_flat flat;                                                                                 \
    const plr_viewpoint *viewpoint;                                                                \
    plr_background background;                                                                     \
    plr_volume_pass volumes;                                                                       \
    plr_model **models;                                                                            \
    size_t model_count;                                                                            \
    plr_surface *surfaces;                                                                         \
    size_t surface_count;                                                                          \
    plr_surface **blending; /* the translucent ones */                                             \
    size_t blending_count;                                                                         \
    plr_blend *blends; /* their drawings in this frame: two each at most */                        \
    plr_shadows shadows;

typedef struct plr_world {
    PLR_WORLD_FIELDS
} plr_world;

/* What projectors saw last, so that every shape in their light need not look at all shapes anew. */
typedef struct plr_projection {
    const plr_node *projector;
    const plr_surface *surfaces; /* the world's */
    uint64_t revision;           /* of the scene */
    plr_matrix world_to_clip;
} plr_projection;

/* What general programs have room for, more than the scene has. */
typedef enum plr_slot_kind {
    PLR_SLOT_DIRECTIONAL,
    PLR_SLOT_POINT,
    PLR_SLOT_SPOT,
    PLR_SLOT_PLANE,
    PLR_SLOT_KINDS
} plr_slot_kind;

#define PLR_PILOT_RUNGS 5
#define PLR_PILOT_WIDTH 49
#define PLR_PILOT_HEIGHT 47

/* What pilot drawings found, and of which frame. */
typedef struct plr_pilot {
    plr_framebuffer framebuffer;
    GLuint color_only;
    int rung;     /* of the ladder; -1: there is none that can be drawn */
    double value; /* the estimate of the error */
    int drawings;
    bool known;
    uint64_t revision; /* of the view's worlds */
    double time;
    plr_matrix projection, view;
    plr_frame last; /* that was drawn, of views that are interactive */
} plr_pilot;

struct plr_view {
    plr_arena arena;   /* of worlds: renewed when the scene changes */
    plr_arena lasting; /* of what is kept then: textures, programs, sources */
    uint64_t revision; /* of the scene, when its worlds were made */
    int asked_dialect; /* as in plr_view_desc, which then has what came of it */
    bool made;         /* once; from then on it is updated */
    bool general;      /* its worlds are made of general programs (engine/general.h) */
    struct {
        bool asked, known; /* its general programs were asked for; and are built */
        bool no_tables;    /* those are made that do without (engine/volume_plan.c) */
        uint64_t of;       /* what the scene was then */
        size_t slots[PLR_SLOT_KINDS], most[PLR_SLOT_KINDS]; /* see engine/general.h */
    } general_state;
    plr_matrix eye_to_world; /* of the last look at the scene */
    plr_viewpoint first;     /* where the first look at a time comes from */
    plr_engine *engine;      /* NULL: nothing is drawn, only checked */
    plr_catalog *own_catalog;
    plr_scene *scene;
    plr_view_desc desc;
    plr_textures textures;
    plr_kitchen kitchen;
    plr_composer composer;
    union {
        plr_world world;
        struct {
            PLR_WORLD_FIELDS
        };
    };
    plr_world *entered; /* the world that the view is at; NULL: the scene */
    plr_targets targets;
    struct {
        plr_kept_volume **items;
        size_t count, capacity;
    } kept_volumes;
    plr_projection projections[8];
    unsigned next_projection; /* to be replaced */
    plr_light_answers lights;
    plr_framebuffer framebuffer;
    GLuint color_only, empty_vertex_array;
    plr_spare_depths spare;
    plr_pilot pilot;
    struct plr_picked_data *picked; /* what was picked from last; NULL: nothing yet */
    plr_view_stats stats;
};

/* Puts the world in the place of the one that the view is at, and that one into *world: twice is
 * back. */
void plr_view_enter(plr_view *view, plr_world *world);

/* ---- Making passes ready ---- */

/* Background, surfaces and volumes of what view->flat holds. */
void plr_world_prepare(plr_view *view, plr_diags *diags);
/* Locations of all its programs. Needs GL. */
void plr_world_find(plr_view *view);
void plr_world_finish(plr_view *view);
/* Finds which volumes there are, and which cast shadows; then makes their programs. */
void plr_volume_pass_find(plr_view *view, plr_diags *diags);
void plr_volume_pass_prepare(plr_view *view, plr_diags *diags);
/* The gradient that counts as 1 where no author says so; never 0. */
double plr_volume_steepness(plr_view *view, const plr_grid *grid);
/* Takes a volume to where its leaf is. */
void plr_volume_move(plr_volume_state *state, const plr_leaf *leaf);
/* Makes the program of background->node; nothing where a clear colour will do. */
void plr_background_prepare(plr_view *view, plr_background *background);
void plr_surfaces_prepare(plr_view *view, plr_diags *diags);
/* Locations, once textures are loaded and GL is there. */
void plr_pass_find(plr_view *view, plr_pass *pass);
/* The fog that a leaf is in: the nearest LocalFog, else the Fog of the scene; its node may be NULL.
 */
const plr_placed *plr_pass_fog(const plr_view *view, const plr_scope *scope);
/* The lights that reach a leaf, as built-in effects. */
void plr_pass_lights(plr_view *view, plr_recipe *recipe, const plr_scope *scope, size_t attached,
                     size_t volume);

/* ---- Drawing ---- */

/* Clears colour and depth, then draws the background. `behind`: the colour where there is none. */
void plr_background_draw(plr_view *view, const plr_background *background, const plr_frame *frame,
                         const float behind[4]);
/* Draws one cast; depths say in which order (plr_volume_depths). One that picks writes what is
 * seen: where along the ray, volume, surface, 1; or zeros. */
void plr_cast_draw(plr_view *view, const plr_cast *cast, const plr_frame *frame);
/* Whether some translucent surface is inside one of its volumes; no GL. */
bool plr_cast_is_divided(const plr_view *view, const plr_cast *cast);
/* Whether the surface meets the box of one of its volumes. */
bool plr_cast_meets(const plr_view *view, const plr_cast *cast, const plr_surface *surface);
/* Finds the depths of the casts in this frame and sorts them, the farthest first. */
void plr_volume_depths(plr_view *view, const plr_frame *frame);
/* Samples along all rays of this frame when none ends early. */
double plr_volume_pass_samples(const plr_view *view, const plr_frame *frame);
void plr_surface_draw(plr_view *view, plr_surface *surface, const plr_frame *frame);
/* Some of its faces; `depths`: their depths alone, into a framebuffer without colours. */
void plr_surface_draw_faces(plr_view *view, plr_surface *surface, const plr_frame *frame,
                            plr_faces faces, bool depths);
/* Bounds of the surfaces along the view direction: least and greatest distance from the eye's
 * plane. */
void plr_surfaces_depths(const plr_view *view, const plr_matrix *world_to_eye, double depths[2]);
void plr_model_finish(plr_view *view, plr_model *model);

#endif
