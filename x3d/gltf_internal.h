/* What the files of the glTF reader share. */
#ifndef PLR_X3D_GLTF_INTERNAL_H
#define PLR_X3D_GLTF_INTERNAL_H

#include "x3d/build.h"
#include "x3d/json.h"

/* The arrays at the top of the document, whose items refer to each other by index. */
typedef enum gltf_table {
    GLTF_ACCESSORS,
    GLTF_BUFFERS,
    GLTF_VIEWS,
    GLTF_CAMERAS,
    GLTF_IMAGES,
    GLTF_LIGHTS, /* of KHR_lights_punctual */
    GLTF_MATERIALS,
    GLTF_MESHES,
    GLTF_NODES,
    GLTF_SAMPLERS,
    GLTF_SCENES,
    GLTF_TEXTURES,
    GLTF_TABLES
} gltf_table;

typedef struct gltf_buffer {
    bool read;
    const char *data; /* NULL: it cannot be had */
    size_t length;
    char *owned; /* of x3d_block_new */
} gltf_buffer;

typedef struct gltf_view {
    bool read;
    const char *data; /* NULL: it cannot be had */
    size_t length, stride;
} gltf_view;

typedef struct gltf_component gltf_component;

/* `count` elements of `components` numbers each. */
typedef struct gltf_accessor {
    bool read, ok;
    const x3d_json *json;
    const gltf_component *component;
    unsigned components;
    bool normalized;
    const char *data; /* NULL: zeros */
    size_t count, stride;
    size_t sparse_count; /* elements that stand elsewhere */
    const gltf_component *sparse_index;
    const char *sparse_indices, *sparse_values;
} gltf_accessor;

/* A list of indices, read once. */
typedef struct gltf_indices {
    const int32_t *items;
    size_t count;
    int32_t largest;
} gltf_indices;

typedef struct gltf_box {
    bool any;
    double least[3], most[3];
} gltf_box;

typedef struct gltf_mesh {
    bool read;
    plr_node *node; /* a Shape, or a Group of them; NULL: nothing to draw */
    gltf_box box;
} gltf_mesh;

enum {
    GLTF_MOST_SETS = 5 /* one for each texture of a material */
};

/* Texture coordinates as a material wants them: a set of the mesh, moved by KHR_texture_transform.
 */
typedef struct gltf_set {
    size_t number; /* of TEXCOORD_n */
    float transform[6];
    const char *mapping; /* the name by which material and coordinates find each other */
} gltf_set;

typedef struct gltf_material {
    bool read;
    plr_node *appearance;
    bool two_sided;
    gltf_set sets[GLTF_MOST_SETS];
    size_t set_count;
} gltf_material;

typedef enum gltf_state {
    GLTF_UNSEEN,
    GLTF_OPEN, /* its children are being read */
    GLTF_DONE
} gltf_state;

/* A name that waits until all nodes have theirs. */
typedef struct gltf_name {
    plr_node *node;
    const x3d_json *name;
} gltf_name;

typedef struct gltf {
    x3d_build *build;
    plr_scene *scene;
    plr_arena *scratch; /* gone when the file is read */
    const x3d_json *root;
    const x3d_json *tables[GLTF_TABLES]; /* NULL: the document has none */
    gltf_buffer *buffers;
    gltf_view *views;
    gltf_accessor *accessors;
    gltf_mesh *meshes;
    gltf_material *materials, standard_material;
    gltf_state *nodes;
    x3d_names made;  /* nodes and lists that serve again, by what they are made of */
    size_t budget;   /* numbers that may still be made of the data */
    size_t loadable; /* bytes of buffers that may still be loaded */
    gltf_box box;    /* of all that is drawn */
    bool has_camera; /* the scene has one */
    struct {
        gltf_name *items;
        size_t count, capacity;
    } names;
    const x3d_json *unknown; /* the extensions that are required and not known */
    bool told_skin, told_morph;
} gltf;

/* ---- gltf_value.c: the document, value by value. What is wrong is reported. ---- */

plr_place gltf_place(gltf *g, const x3d_json *value);
size_t gltf_table_count(const gltf *g, gltf_table table);
const char *gltf_table_name(gltf_table table);
/* Finds the arrays at the top. */
void gltf_find_tables(gltf *g);

/* Members of an object. Absent ones, and those of another kind than they should be, are NULL. */
const x3d_json *gltf_object(gltf *g, const x3d_json *object, const char *key);
const x3d_json *gltf_list(gltf *g, const x3d_json *object, const char *key);
const x3d_json *gltf_text(gltf *g, const x3d_json *object, const char *key);
const x3d_json *gltf_extension(gltf *g, const x3d_json *object, const char *name);
bool gltf_bool(gltf *g, const x3d_json *object, const char *key, bool missing);
double gltf_number(gltf *g, const x3d_json *object, const char *key, double missing);
/* A number that is no less than `least` and no more than `most`; else it is brought there. */
double gltf_between(gltf *g, const x3d_json *object, const char *key, double missing, double least,
                    double most);
/* `count` numbers; false: they are absent or wrong, and `numbers` stays as it is. */
bool gltf_numbers(gltf *g, const x3d_json *object, const char *key, double *numbers, size_t count);
/* An integer from 0 on; false: there is one and it is wrong. */
bool gltf_size(gltf *g, const x3d_json *object, const char *key, size_t missing, size_t *size);
/* The item of a table that a member refers to: NULL if the member is absent or wrong. */
const x3d_json *gltf_refer(gltf *g, const x3d_json *object, const char *key, gltf_table table,
                           size_t *index);
const x3d_json *gltf_item(gltf *g, const x3d_json *reference, gltf_table table, size_t *index);
/* Whether the object cannot be understood without an extension that is not known. */
bool gltf_needs_unknown(gltf *g, const x3d_json *object);

/* ---- gltf_graph.c: nodes and fields. A node may be NULL: then nothing happens. ---- */

/* NULL when there are too many (reported). */
plr_node *gltf_node(gltf *g, const char *type, const x3d_json *from);
void gltf_set_bool(gltf *g, plr_node *node, const char *field, bool value);
void gltf_set_number(gltf *g, plr_node *node, const char *field, double value);
void gltf_set_numbers(gltf *g, plr_node *node, const char *field, const double *values,
                      size_t count);
/* A list that stays where it is, in the scene's arena; `count` in elements. */
void gltf_set_list(gltf *g, plr_node *node, const char *field, const void *values, size_t count,
                   const x3d_json *from);
/* SFString or MFString of one; text stays where it is. */
void gltf_set_string(gltf *g, plr_node *node, const char *field, const char *text, size_t length,
                     const x3d_json *from);
void gltf_add_node(gltf *g, plr_node *node, const char *field, plr_node *child);
/* Gives a node a DEF name, if it is free, and exports it. */
void gltf_define(gltf *g, plr_node *node, const x3d_json *name);
void gltf_define_later(gltf *g, plr_node *node, const x3d_json *object);
void gltf_define_rest(gltf *g);
/* Where what is made of these data is kept, to serve again. */
void **gltf_made(gltf *g, const char *format, ...) PLR_PRINTF(2, 3);

/* ---- gltf_data.c: buffers, views ---- */

/* The bytes of a view; NULL: they cannot be had (reported). */
const gltf_view *gltf_view_of(gltf *g, const x3d_json *object, const char *key);
void gltf_free_buffers(gltf *g);
/* An url as the scene takes it: percent signs decoded, in the scene's arena. */
plr_string gltf_url(gltf *g, const x3d_json *uri);

/* ---- gltf_accessor.c: typed numbers in buffers ---- */

/* The accessor of a reference; NULL: wrong (reported). */
const gltf_accessor *gltf_accessor_of(gltf *g, const x3d_json *reference, size_t *index);
/* Takes from the budget; false when it is used up (reported). */
bool gltf_afford(gltf *g, const x3d_json *from, size_t count, size_t each);
/* count * components numbers in the scene's arena; NULL: reported. */
float *gltf_floats(gltf *g, const gltf_accessor *accessor);
bool gltf_integers(gltf *g, const gltf_accessor *accessor, gltf_indices *indices);

/* ---- gltf_material.c, gltf_texture.c ---- */

/* The material of a primitive, or that of primitives without. */
const gltf_material *gltf_material_of(gltf *g, const x3d_json *primitive);
/* An ImageTexture for a reference to a texture; NULL: none (reported). */
plr_node *gltf_texture(gltf *g, const x3d_json *reference);

/* ---- gltf_mesh.c, gltf_node.c ---- */

const gltf_mesh *gltf_mesh_at(gltf *g, size_t index);
void gltf_box_add(gltf_box *box, const double point[3]);
/* Reads the scene to be shown. */
void gltf_read_scene(gltf *g);

#endif
