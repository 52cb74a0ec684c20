/* plugray/engine.h - drawing scenes with GL.
 *
 * Two ways in: a host that has a GL context (3.3 core or later) gives its loader and draws into its
 * own framebuffer; a program without one creates a headless plr_context first.
 *
 * Thread safety: functions marked "needs GL" must run on the thread where the context is current.
 */
#ifndef PLUGRAY_ENGINE_H
#define PLUGRAY_ENGINE_H

#include <plugray/base.h>
#include <plugray/plugs.h>
#include <plugray/x3d.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Headless contexts --------------------------------------------------------------------------
 */

typedef enum plr_backend {
    PLR_BACKEND_AUTO, /* EGL, then OSMesa */
    PLR_BACKEND_EGL,  /* surfaceless or device platform: no window, no display */
    PLR_BACKEND_OSMESA
} plr_backend;

typedef struct plr_context plr_context;

/* Creates a context (GL 3.3 core or later) and makes it current on this thread. Libraries are
 * loaded at run time. NULL with an error (`no-gl`) that says what was tried. */
PLR_API plr_context *plr_context_create(plr_backend backend, plr_diags *diags);
PLR_API void plr_context_destroy(plr_context **context);
/* Makes it current on the calling thread, whatever was current before. */
PLR_API bool plr_context_make_current(plr_context *context);
/* The loader of the context; `user` is the context. */
PLR_API void *plr_context_get_proc_address(void *context, const char *name);
/* For plr_engine_desc.make_shared_current; `user` is the context. */
PLR_API bool plr_context_make_shared_current(void *context, bool current);
/* PLR_BACKEND_EGL or PLR_BACKEND_OSMESA; and a line "EGL, llvmpipe (LLVM 15...), 4.5". */
PLR_API plr_backend plr_context_backend(const plr_context *context);
PLR_API const char *plr_context_description(const plr_context *context);

/* ---- Engine
 * --------------------------------------------------------------------------------------- */

typedef struct plr_engine_desc {
    /* The host's loader; must not be NULL. */
    void *(*get_proc_address)(void *user, const char *name);
    void *user;
    const char *cache_folder; /* for compiled programs; NULL: none on disk */
    /* For views that are interactive: a thread of the engine calls it with `current` true before it
     * builds programs, and with false at its end. It makes a context current on that thread that
     * shares programs with the engine's. NULL: plr_view_build builds, on the thread that calls it.
     */
    bool (*make_shared_current)(void *user, bool current);
} plr_engine_desc;

/* Programs and textures of one GL context. Needs GL. */
typedef struct plr_engine plr_engine;
PLR_API plr_engine *plr_engine_create(const plr_engine_desc *desc, plr_diags *diags);
/* Frees what it made in GL. Needs GL. */
PLR_API void plr_engine_destroy(plr_engine **engine);
/* $XDG_CACHE_HOME/plugray or ~/.cache/plugray, written to buffer; false without either. */
PLR_API bool plr_engine_default_cache(char *buffer, size_t size);

/* ---- A scene made ready
 * ----------------------------------------------------------------------------- */

/* How the integral along a ray is taken. */
typedef enum plr_method {
    PLR_METHOD_AUTO,          /* the planner's choice; with fixed steps: midpoint */
    PLR_METHOD_MIDPOINT,      /* one sample in the middle of each step */
    PLR_METHOD_PREINTEGRATED, /* between two samples the value is linear: integrals over it */
    PLR_METHOD_CELLS /* in each cell of voxels the value is a cubic: cut until it is exact */
} plr_method;

typedef struct plr_view_desc {
    /* NULL or "": the first of the file; else a number from 1, a DEF name or a description */
    const char *viewpoint;
    double time; /* seconds after the scene was loaded */
    double
        aspect; /* width / height of the pictures, for what sees whether it is in sight; 0: 4/3 */
    /* How far pictures may be from the true ones in any channel of any pixel; 0: 1/255. What comes
     * of it is in plr_view_get_plan. */
    double error;
    double step; /* fixed sample distance in voxels (geometric mean of the sides); 0: by `error` */
    plr_method method; /* what cannot be sampled so is sampled otherwise; the plan says so */
    bool no_leaping;   /* look at every sample, also where nothing can be seen; same pictures */
    /* of volume nodes; 0: found out, 2005, or 1: final. It sets defaults of the scene's fields: of
     * views of one scene, the one that was made or updated last decides. */
    int dialect;
    /* of one volume as a texture; 0: 4 GiB. A larger one, or one of more voxels a side than GL
     * takes, is cast in bricks, which are uploaded anew for each picture; with segments, a
     * projection or inside a BlendedVolumeStyle it is brought down by averaging, with a warning. */
    size_t max_voxel_bytes;
    /* The scene is edited while it is looked at: plr_view_update does not wait for a compiler where
     * general programs can draw the scene meanwhile; plr_view_build has the rest built. */
    bool interactive;
    /* for plr_view_draw_here: the host draws opaque things, at which rays through volumes end */
    bool host_depths;
} plr_view_desc;

/* A scene, with programs, textures and buffers. Scene and engine must outlive it. */
typedef struct plr_view plr_view;

/* Traverses, links, validates, compiles and uploads. Faulty effects are left out and reported.
 * `engine` NULL: no GL at all: links and validates only (plugray check, dump, link). Needs GL
 * otherwise. Returns NULL only without memory or if the viewpoint does not exist. */
PLR_API plr_view *plr_view_create(plr_engine *engine, plr_scene *scene, const plr_view_desc *desc,
                                  plr_diags *diags);
PLR_API void plr_view_destroy(plr_view **view);
/* Brings the scene to another time (plr_scene_set_time, as the view's viewpoint sees it) and the
 * view to what has changed in the scene since, by time or by setters. What has not changed is kept:
 * programs, textures, volumes. Needs GL if the view has an engine. False without memory: the view
 * is then to be destroyed. */
PLR_API bool plr_view_update(plr_view *view, double time, plr_diags *diags);

/* Of a view that is interactive: takes over programs that were built beside, and asks for those
 * that the next edit may need. To be called between frames, while the user looks: it may take as
 * long as some frames, where the driver compiles once more when it first draws. Waits so many
 * milliseconds for what is being built, 0: not at all. Without a context to build in beside
 * (plr_engine_desc.make_shared_current) it builds one program itself. How many are still to be
 * built; it is to be called again then. SIZE_MAX without memory: the view is then to be destroyed.
 * Needs GL. */
PLR_API size_t plr_view_build(plr_view *view, double wait_ms);

typedef struct plr_draw_desc {
    int width, height; /* pixels, at least 1 */
    int samples;       /* per pixel, along a fixed pattern; 0: 1 */
} plr_draw_desc;

/* A picture in memory: width * height RGBA floats, premultiplied, top row first. */
typedef struct plr_picture {
    int width, height;
    float *pixels;
} plr_picture;

/* Draws into memory. Needs GL. Free with plr_picture_free. */
PLR_API bool plr_view_draw(plr_view *view, const plr_draw_desc *desc, plr_picture *picture,
                           plr_diags *diags);
PLR_API void plr_picture_free(plr_picture *picture);
/* Draws into the framebuffer that is bound (colour and depth, not multisampled), in the viewport
 * that is set, over what it holds and without a background, with the host's camera: projection and
 * world-to-eye matrices of 16 numbers, column by column; NULL: those of the scene's viewpoint. The
 * GL state that is changed is set back. Needs GL. */
PLR_API bool plr_view_draw_here(plr_view *view, const double *projection, const double *camera,
                                plr_diags *diags);

/* What is seen in a pixel. */
typedef struct plr_pick {
    const plr_node *volume; /* whose data are seen there; NULL: none */
    size_t volume_index;    /* among the volumes that are drawn, in the order of the scene */
    const plr_node *shape;  /* the opaque shape that is seen, where no volume is; NULL: none */
    size_t shape_index;     /* among all shapes, in the order of the scene */
    double position[3];     /* in world coordinates */
    double distance;        /* along the ray from the eye, or from its plane (OrthoViewpoint) */
    int surface;            /* number of the surface of equal value; -1: none */
    uint32_t components;
    double value[4];    /* of the voxels, interpolated, 0 to 1 */
    double physical[4]; /* the same in the units of the file, not clamped */
    bool has_segment;
    uint32_t segment;
    char label[256]; /* what the data call the segment; "": nothing */
} plr_pick;

/* Looks along the ray through the centre of a pixel of such a picture (column and row from the top
 * left, from 0). A volume is seen at the first sample at which what is accumulated reaches an
 * opacity of 1/255, or at the surface or projection that does so; behind opaque shapes and where it
 * is cut away it is not. Shapes that are translucent are looked through. True if nothing is seen,
 * too: then `volume` and `shape` are NULL. False if the pixel is not in the picture, without an
 * engine or memory. The first pick compiles programs. State of the GL context is set back. Needs
 * GL. */
PLR_API bool plr_view_pick(plr_view *view, const plr_draw_desc *desc, int x, int y, plr_pick *pick,
                           plr_diags *diags);

/* Where a ray crosses the box of a volume. */
typedef struct plr_box_pick {
    const plr_node *volume;
    size_t volume_index;
    double entry[3], exit[3]; /* in world coordinates; the eye is the entry where it is inside */
    double distance;          /* of the entry */
} plr_box_pick;

/* The nearest box of a volume along the ray through the centre of a pixel, as a TouchSensor would
 * have it: whatever is in it, whatever is before it. False if there is none. No GL. */
PLR_API bool plr_view_pick_box(const plr_view *view, const plr_draw_desc *desc, int x, int y,
                               plr_box_pick *pick);

/* Writes by the ending of `path`: .png (8-bit; opaque over black, or straight alpha if
 * `transparent`), .exr (float, premultiplied), .npy (float32, height x width x 4). */
PLR_API bool plr_picture_write(const plr_picture *picture, const char *path, bool transparent,
                               plr_diags *diags);

/* ---- What a view is made of
 * --------------------------------------------------------------------------- */

typedef struct plr_program_info {
    const char *name; /* "volume-1", "surface-3": unique in the view */
    const plr_program *program;
    const plr_effect *effects; /* as linked */
    size_t effect_count;
    uint32_t instructions, fetches; /* of the fragment stage, counted in its SPIR-V */
} plr_program_info;

PLR_API size_t plr_view_program_count(const plr_view *view);
PLR_API const plr_program_info *plr_view_program(const plr_view *view, size_t index);

/* A line of GLSL that fetches from a texture. */
typedef struct plr_fetch_info {
    plr_place place;
    size_t effect;       /* whose uniform is read, wherever the line stands; or PLR_NO_EFFECT */
    const char *sampler; /* the author's name of the uniform; NULL: not known */
    uint32_t count;      /* how often: once for each call of the function it stands in */
} plr_fetch_info;

/* The fetches of a program's fragment stage, counted as those of plr_program_info. Writes up to
 * `capacity` rows, in order of text, and returns how many there are. */
PLR_API size_t plr_program_fetches(const plr_program *program, plr_fetch_info *fetches,
                                   size_t capacity);

/* A thing that a program draws. */
typedef struct plr_drawable {
    const char *kind;                /* "surface", "volume", "background" */
    const plr_node *node;            /* the Shape, the volume node, the background node */
    const plr_program_info *program; /* of plr_view_program; things whose texts are equal share it;
                                        NULL: it is not drawn */
} plr_drawable;

PLR_API size_t plr_view_drawable_count(const plr_view *view);
/* False beyond the last. */
PLR_API bool plr_view_drawable(const plr_view *view, size_t index, plr_drawable *drawable);
/* The program of a drawable, linked once more, so that its places are those of the drawable's own
 * effects and not of the first one that has this text. The effects are the view's, the program is
 * the caller's. NULL if it is not drawn. */
PLR_API plr_program *plr_view_link_drawable(plr_view *view, size_t index,
                                            const plr_effect **effects, size_t *effect_count);
/* Whether an effect of that program is for this drawable: volumes that are cast together have one
 * program, and each its own effects in it. */
PLR_API bool plr_view_drawable_has(const plr_view *view, size_t index, size_t effect);

typedef struct plr_phase {
    double cpu_ms, wall_ms;
} plr_phase;

typedef struct plr_view_stats {
    plr_phase load; /* of the creation: volumes, images, meshes, what is no other phase */
    plr_phase link, compile, upload, draw; /* of the creation and of the last draw */
    plr_phase pilots; /* of the last draw that made pilot drawings (plr_view_desc.error) */
    double gpu_ms;    /* of the last draw, by the GPU's clock; 0: there is no GPU */
    double samples;   /* volume samples asked for in the last draw, at most */
    /* of views that are interactive: programs that the last update waited for; that are being built
     * beside; and whether those of the next picture are general */
    size_t built, building;
    bool general;
} plr_view_stats;
PLR_API void plr_view_get_stats(const plr_view *view, plr_view_stats *stats);

/* ---- The plan ---- */

/* One choice of the plan, in words. */
typedef struct plr_choice {
    const char *about;  /* "sampling", "skipping", ... */
    const char *chosen; /* what is done */
    const char *why;    /* and what it costs or saves */
} plr_choice;

/* How the volumes of a view are sampled, and what that means for the error of pictures. */
typedef struct plr_plan {
    double asked; /* the error; 0: fixed steps were asked for */
    bool bounded; /* proven; else estimated */
    double value; /* the greatest error of a channel; of fixed steps unknown: negative */
    plr_method method;
    double step;               /* voxels; of PLR_METHOD_CELLS the longest piece */
    bool leaps;                /* over blocks where nothing can be seen */
    const char *why;           /* in words, one sentence; owned by the view, until it is updated */
    const plr_choice *choices; /* all, likewise */
    size_t choice_count;
} plr_plan;
PLR_API void plr_view_get_plan(const plr_view *view, plr_plan *plan);

/* ---- Promises ---- */

/* Tries whether the effects of authors on volumes keep what they promise (plr_promises): each alone
 * is given some tens of thousands of samples of its volume, and such as might be, always the same
 * ones. A promise that is broken is an error (`broken-promise`) where it is made; what is not found
 * broken may be, at samples that were not tried. True if all was tried that could be; what could
 * not is told. State of the GL context is set back. Needs GL; false without an engine. */
PLR_API bool plr_view_check_promises(plr_view *view, plr_diags *diags);

/* ---- What volumes hold ---- */

#define PLR_PERCENTILES 0.1, 1, 5, 25, 50, 75, 95, 99, 99.9
#define PLR_PERCENTILE_COUNT 9
#define PLR_HISTOGRAM_BINS 32

/* Of one component of a volume, over all voxels, in physical units; exact. */
typedef struct plr_volume_statistics {
    uint64_t finite, nan, infinite; /* values of each kind; the rest is about the finite ones */
    double minimum, maximum;
    /* By nearest rank: the least value that at least so many percent do not exceed. */
    double percentiles[PLR_PERCENTILE_COUNT];
    /* A histogram: bin i holds what is at least first + i * width and less than the next one's; the
     * last one holds the maximum, too. Bins of integers hold whole numbers of levels. */
    uint32_t bins;
    double first, width;
    uint64_t counts[PLR_HISTOGRAM_BINS];
} plr_volume_statistics;

/* Reads the voxels of a texture node (ImageTexture3D, PixelTexture3D, ComposedTexture3D, ...) and
 * counts. False, reported, if they cannot be read. */
PLR_API bool plr_volume_read_statistics(plr_scene *scene, const plr_node *texture,
                                        uint32_t component, plr_volume_statistics *statistics,
                                        plr_diags *diags);

/* The GLSL that plugray brings: path below effects/, text. NULL beyond the last. */
PLR_API const char *plr_effects_file(size_t index, const char **text, size_t *length);

#ifdef __cplusplus
}
#endif
#endif
