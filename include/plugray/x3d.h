/* plugray/x3d.h - reading X3D scenes: XML, Classic VRML and VRML97, and glTF 2.0 (.gltf, .glb),
 * plain or gzipped, into one typed graph. No GL, no drawing.
 *
 * Thread safety: one scene may be used by one thread at a time. Nothing is printed or global. All
 * pointers that a scene gives out live until the scene is destroyed or the field is set. */
#ifndef PLUGRAY_X3D_H
#define PLUGRAY_X3D_H

#include <plugray/base.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Files ---- */

/* What a scene may read. Zero value: files inside the folder of the scene (symbolic links resolved)
 * and below, nothing else, never the network. */
typedef struct plr_file_rules {
    const char *const *allowed; /* further folders, everything below them is allowed */
    size_t allowed_count;
    bool allow_network; /* http(s) urls are handed to `fetch`, if there is one */
    size_t max_bytes;   /* of one file, after gunzip; 0: 1 GiB */
    /* The host's way to fetch a network url: returns malloc'ed bytes or NULL. May be NULL. */
    char *(*fetch)(void *user, const char *url, size_t *length);
    void *user;
    /* Told now and then, on the thread that reads, while long files are read, unpacked and
     * decoded: the name of the file and how much of this work is done, 0 to 1. May be NULL. */
    void (*progress)(void *user, const char *name, double done);
} plr_file_rules;

/* Bytes read from a file or a data: url. */
typedef struct plr_bytes {
    char *data; /* NUL-terminated beyond `length` */
    size_t length;
    char *name; /* the path as messages give it: the referring folder joined with the url */
} plr_bytes;

typedef struct plr_scene plr_scene;
typedef struct plr_node plr_node;

/* ---- Values ---- */

/* All field types of ISO/IEC 19775-1 clause 5. PLR_TYPE(identifier, name, kind, components) */
#define PLR_TYPES(PLR_TYPE)                                                                        \
    PLR_TYPE(SFBOOL, "SFBool", BOOL, 1)                                                            \
    PLR_TYPE(SFINT32, "SFInt32", INT, 1)                                                           \
    PLR_TYPE(SFFLOAT, "SFFloat", FLOAT, 1)                                                         \
    PLR_TYPE(SFDOUBLE, "SFDouble", DOUBLE, 1)                                                      \
    PLR_TYPE(SFTIME, "SFTime", DOUBLE, 1)                                                          \
    PLR_TYPE(SFVEC2F, "SFVec2f", FLOAT, 2)                                                         \
    PLR_TYPE(SFVEC3F, "SFVec3f", FLOAT, 3)                                                         \
    PLR_TYPE(SFVEC4F, "SFVec4f", FLOAT, 4)                                                         \
    PLR_TYPE(SFVEC2D, "SFVec2d", DOUBLE, 2)                                                        \
    PLR_TYPE(SFVEC3D, "SFVec3d", DOUBLE, 3)                                                        \
    PLR_TYPE(SFVEC4D, "SFVec4d", DOUBLE, 4)                                                        \
    PLR_TYPE(SFCOLOR, "SFColor", FLOAT, 3)                                                         \
    PLR_TYPE(SFCOLORRGBA, "SFColorRGBA", FLOAT, 4)                                                 \
    PLR_TYPE(SFROTATION, "SFRotation", FLOAT, 4)                                                   \
    PLR_TYPE(SFMATRIX3F, "SFMatrix3f", FLOAT, 9)                                                   \
    PLR_TYPE(SFMATRIX4F, "SFMatrix4f", FLOAT, 16)                                                  \
    PLR_TYPE(SFMATRIX3D, "SFMatrix3d", DOUBLE, 9)                                                  \
    PLR_TYPE(SFMATRIX4D, "SFMatrix4d", DOUBLE, 16)                                                 \
    PLR_TYPE(SFSTRING, "SFString", STRING, 1)                                                      \
    PLR_TYPE(SFIMAGE, "SFImage", INT, 1)                                                           \
    PLR_TYPE(SFNODE, "SFNode", NODE, 1)                                                            \
    PLR_TYPE(MFBOOL, "MFBool", BOOL, 1)                                                            \
    PLR_TYPE(MFINT32, "MFInt32", INT, 1)                                                           \
    PLR_TYPE(MFFLOAT, "MFFloat", FLOAT, 1)                                                         \
    PLR_TYPE(MFDOUBLE, "MFDouble", DOUBLE, 1)                                                      \
    PLR_TYPE(MFTIME, "MFTime", DOUBLE, 1)                                                          \
    PLR_TYPE(MFVEC2F, "MFVec2f", FLOAT, 2)                                                         \
    PLR_TYPE(MFVEC3F, "MFVec3f", FLOAT, 3)                                                         \
    PLR_TYPE(MFVEC4F, "MFVec4f", FLOAT, 4)                                                         \
    PLR_TYPE(MFVEC2D, "MFVec2d", DOUBLE, 2)                                                        \
    PLR_TYPE(MFVEC3D, "MFVec3d", DOUBLE, 3)                                                        \
    PLR_TYPE(MFVEC4D, "MFVec4d", DOUBLE, 4)                                                        \
    PLR_TYPE(MFCOLOR, "MFColor", FLOAT, 3)                                                         \
    PLR_TYPE(MFCOLORRGBA, "MFColorRGBA", FLOAT, 4)                                                 \
    PLR_TYPE(MFROTATION, "MFRotation", FLOAT, 4)                                                   \
    PLR_TYPE(MFMATRIX3F, "MFMatrix3f", FLOAT, 9)                                                   \
    PLR_TYPE(MFMATRIX4F, "MFMatrix4f", FLOAT, 16)                                                  \
    PLR_TYPE(MFMATRIX3D, "MFMatrix3d", DOUBLE, 9)                                                  \
    PLR_TYPE(MFMATRIX4D, "MFMatrix4d", DOUBLE, 16)                                                 \
    PLR_TYPE(MFSTRING, "MFString", STRING, 1)                                                      \
    PLR_TYPE(MFIMAGE, "MFImage", INT, 1)                                                           \
    PLR_TYPE(MFNODE, "MFNode", NODE, 1)

typedef enum plr_type {
#define PLR_TYPE(id, name, kind, components) PLR_##id,
    PLR_TYPES(PLR_TYPE)
#undef PLR_TYPE
    PLR_TYPE_COUNT
} plr_type;

/* How the values of a type are stored. */
typedef enum plr_kind {
    PLR_BOOL,   /* bool */
    PLR_INT,    /* int32_t; RGBA pixels above 0x7fffffff keep their 32 bits */
    PLR_FLOAT,  /* float */
    PLR_DOUBLE, /* double */
    PLR_STRING, /* plr_string */
    PLR_NODE    /* plr_node * */
} plr_kind;

PLR_API const char *plr_type_name(plr_type type);
PLR_API plr_kind plr_type_kind(plr_type type);
/* Numbers in one element: 3 for SFVec3f and MFVec3f, 1 for images, strings and nodes. */
PLR_API int plr_type_components(plr_type type);
PLR_API bool plr_type_is_multiple(plr_type type); /* MFxxx */

typedef struct plr_string {
    const char *text; /* decoded UTF-8, NUL-terminated */
    size_t length;
    plr_origin origin; /* of its first byte, exact through escapes, entities and CDATA */
} plr_string;

typedef enum plr_access {
    PLR_INITIALIZE_ONLY,
    PLR_INPUT_ONLY,
    PLR_OUTPUT_ONLY,
    PLR_INPUT_OUTPUT
} plr_access;

/* Matrices are kept in the order of the file, which gives row after row, the top row first (ISO/IEC
 * 19776-1 and 19776-2, 5.9 to 5.12). GL takes columns: hand them over with transposing. */

/* One field of one node, with its value now. `count` is the number of elements: 1 for SFxxx, except
 * that an SFNode of NULL has 0. SFImage: width, height, components, then the pixels; `count` is
 * then the number of integers. */
typedef struct plr_field {
    const char *name;
    plr_type type;
    plr_access access;
    bool given;      /* the file or a setter gives it; else it has its default */
    bool declared;   /* the author declared it (on Effect, ComposedShader, Script, ...) */
    plr_place place; /* of the field's name where given or declared, else of the node */
    size_t count;
    union {
        const bool *bools;
        const int32_t *ints;
        const float *floats;
        const double *doubles;
        const plr_string *strings;
        plr_node *const *nodes;
        const void *any;
    } value;
} plr_field;

/* ---- Scenes ---- */

typedef struct plr_read_desc {
    plr_file_rules rules;
    const plr_allocator *allocator; /* NULL: the C library's (libxml2 and zlib keep their own) */
    size_t max_nodes;               /* after prototypes and inlines; 0: 10 million */
    size_t max_depth;  /* of nesting of nodes, inlines, prototypes; 0: 512, at most 2000 */
    size_t max_memory; /* of the graph in bytes, texts of files not counted; 0: 4 GiB */
} plr_read_desc;

/* Reads the file at `path` with everything that it inlines. Faults are reported and what can be
 * kept is kept; returns NULL only if nothing can be kept (no file, no memory, not a scene at all).
 * `desc` NULL: all defaults. */
PLR_API plr_scene *plr_scene_read(const char *path, const plr_read_desc *desc, plr_diags *diags);
/* The same from memory; `path` names it in messages, its folder is where relative urls start. */
PLR_API plr_scene *plr_scene_parse(const char *text, size_t length, const char *path,
                                   const plr_read_desc *desc, plr_diags *diags);
PLR_API void plr_scene_destroy(plr_scene **scene);

/* The top-level nodes, in the order of the file; inlined content is inside its Inline nodes, in
 * their field `children`. */
PLR_API size_t plr_scene_root_count(const plr_scene *scene);
PLR_API plr_node *plr_scene_root(const plr_scene *scene, size_t index);
/* The first node with this DEF name in the main file, or NULL. */
PLR_API plr_node *plr_scene_find(const plr_scene *scene, const char *def);
/* "3.3", "4.0"; "2.0" for VRML97. */
PLR_API const char *plr_scene_version(const plr_scene *scene);
/* Metres per length unit of the file, radians per angle unit (UNIT statements); 1 without.
 * Lengths of inlined files are scaled to the unit of the main file; fields that are angles hold
 * radians, whatever the file's unit. */
PLR_API double plr_scene_length_unit(const plr_scene *scene);
PLR_API double plr_scene_angle_unit(const plr_scene *scene);
/* META statements in order: name and content; NULL beyond the last. */
PLR_API const char *plr_scene_meta(const plr_scene *scene, size_t index, const char **content);
/* Whether the scene uses a node or field that only the volume proposal of 2005 has; `where` (may be
 * NULL) is then set to the first place that does. */
PLR_API bool plr_scene_uses_2005(const plr_scene *scene, plr_place *where);
/* Gives fields of volume nodes that the file leaves out the defaults of the proposal of 2005, or
 * those of the final standard, which they have at first. Fields that are given stay as they are. */
PLR_API void plr_scene_set_2005(plr_scene *scene, bool proposal);
/* A Shape, no part of the graph, that stands for bounding boxes: the white edges of a cube of side
 * 1 around the origin. Made at the first call; NULL without memory. */
PLR_API plr_node *plr_scene_box_edges(plr_scene *scene);
/* One line of a file that the scene was read from (newline excluded), or NULL; for messages. */
PLR_API const char *plr_scene_line(const plr_scene *scene, const char *file, uint32_t line,
                                   size_t *length);

typedef struct plr_route {
    plr_node *from, *to;
    const char *from_field, *to_field; /* without set_ and _changed where the field has them */
    uint32_t from_index, to_index;     /* of these fields, for plr_node_field_at */
    plr_place place;
} plr_route;
PLR_API size_t plr_scene_route_count(const plr_scene *scene);
PLR_API const plr_route *plr_scene_route(const plr_scene *scene, size_t index);

/* The functions below report a failure at the first byte of the url, that is behind its quote. */

/* Reads the file that a url means, under the scene's rules: `url` is a string of a node of this
 * scene, relative to the file in which it stands; "data:" urls are decoded (base64; else taken as
 * they are). Gzipped files are unpacked if `gunzip`. On failure reports at the url's own place and
 * returns false. Free with plr_bytes_free. */
PLR_API bool plr_scene_load(plr_scene *scene, const plr_string *url, bool gunzip, plr_bytes *bytes,
                            plr_diags *diags);
/* The first of several urls (an MFString field) that loads; reports only if none does. */
PLR_API bool plr_scene_load_first(plr_scene *scene, const plr_field *urls, bool gunzip,
                                  plr_bytes *bytes, size_t *index, plr_diags *diags);
/* The file `name` beside or below `referrer` (a name that plr_scene_load gave): the data file of a
 * detached header. `place` is where failures are reported. */
PLR_API bool plr_scene_load_beside(plr_scene *scene, const char *referrer, const char *name,
                                   bool gunzip, plr_place place, plr_bytes *bytes,
                                   plr_diags *diags);
/* The files in the folder that a url means: one that ends with '/', or with "/#" and a name, which
 * is left to the caller. Hidden files are left out. `names->data` are their names, each ended by a
 * NUL, in the order of their bytes, at most `limit`; each may be read with plr_scene_load_beside,
 * where `names->name`, which ends with '/', is the referrer. False where the url means no folder,
 * or it may not be read (reported). Free with plr_bytes_free. */
PLR_API bool plr_scene_list(plr_scene *scene, const plr_string *url, size_t limit, plr_bytes *names,
                            plr_diags *diags);
/* Whether a url means a folder. */
PLR_API bool plr_url_is_folder(const plr_string *url);
PLR_API void plr_bytes_free(plr_bytes *bytes);
/* Tells the scene's `progress`, where it has one: for those who decode what its files hold. */
PLR_API void plr_scene_progress(const plr_scene *scene, const char *name, double done);

/* Source code from the url field of an EffectPart, ShaderPart or the like: inline text ("data:..."
 * or text that is no url, as CDATA gives it) or a file. `code->text` lives as long as the scene;
 * code->origin is exact. False if no url loads (reported). */
PLR_API bool plr_scene_code(plr_scene *scene, const plr_node *node, const char *field,
                            plr_string *code, plr_diags *diags);

/* ---- Nodes ---- */

/* Node type as the tables name it ("Transform"); aliases of old dialects give the final name. An
 * instance of a prototype is the first node of its body, with the place and the DEF name of the
 * instance; its written type is the name of the prototype. */
PLR_API const char *plr_node_type(const plr_node *node);
PLR_API bool plr_node_is(const plr_node *node, const char *type);
/* DEF name or NULL. */
PLR_API const char *plr_node_def(const plr_node *node);
PLR_API plr_place plr_node_place(const plr_node *node);
/* A number that no other node of the scene has, below plr_scene_node_count. */
PLR_API uint32_t plr_node_id(const plr_node *node);
PLR_API uint32_t plr_scene_node_count(const plr_scene *scene);
/* What the file calls the node, where that is not its type (an alias), else the same. */
PLR_API const char *plr_node_written_type(const plr_node *node);

/* A field by name, or NULL if the node has none of that name. */
PLR_API const plr_field *plr_node_field(const plr_node *node, const char *name);
/* All fields, of the table and declared, in table order then order of declaration. */
PLR_API size_t plr_node_field_count(const plr_node *node);
PLR_API const plr_field *plr_node_field_at(const plr_node *node, size_t index);

/* The value of a field of one element; zero, "" or NULL where there is no such field of that kind.
 */
PLR_API bool plr_node_bool(const plr_node *node, const char *field);
PLR_API int32_t plr_node_int(const plr_node *node, const char *field);
PLR_API double plr_node_number(const plr_node *node, const char *field); /* float, double, int */
PLR_API const char *plr_node_string(const plr_node *node, const char *field);
PLR_API plr_node *plr_node_child(const plr_node *node,
                                 const char *field); /* SFNode, first of MFNode */
/* Copies up to `count` numbers of the first element (or of all, for MF fields) to `numbers`,
 * returns how many. */
PLR_API size_t plr_node_numbers(const plr_node *node, const char *field, float *numbers,
                                size_t count);

/* Both setters take what a ROUTE may set and what only a file may: the caller knows best. */

/* Sets a field from text in the notation of Classic VRML ("0.5", "1 0 0", "[ 1 2 3 ]", "TRUE",
 * "\"text\"" or a bare word for one string). On an instance of a prototype a field of its interface
 * sets all fields that carry it. False with an error at `place` where it does not fit. */
PLR_API bool plr_node_set_text(plr_scene *scene, plr_node *node, const char *field,
                               const char *text, plr_place place, plr_diags *diags);
/* Sets a field of numbers or bools from an array of its kind; `count` in elements. */
PLR_API bool plr_node_set(plr_scene *scene, plr_node *node, const char *field, const void *values,
                          size_t count);

/* Grows whenever a field of the node (of any node of the scene) is set to another value. */
PLR_API uint64_t plr_node_revision(const plr_node *node);
PLR_API uint64_t plr_scene_revision(const plr_scene *scene);
/* Calls `visit` for each field that time has set to another value since the scene had the revision
 * `since`, perhaps more than that; false where setters have set some, too: then anything may have
 * changed. */
PLR_API bool plr_scene_changes(const plr_scene *scene, uint64_t since,
                               void (*visit)(void *user, plr_node *node, const plr_field *field),
                               void *user);
/* What the node does to the coordinates of its children: column-major, element (row, column) at
 * column * 4 + row. False, and the identity, for nodes that leave them alone. */
PLR_API bool plr_node_transform(const plr_node *node, double matrix[16]);

/* ---- Time ---- */

/* What sensors see; matrices are column-major. */
typedef struct plr_viewer {
    const plr_node *viewpoint; /* bound when the scene is loaded; NULL: the first of the scene */
    double eye_to_world[16], world_to_eye[16], projection[16];
} plr_viewer;

/* Brings the scene to `time` seconds after it was loaded: sensors, interpolators, sequencers,
 * ROUTEs and what is bound. The result depends on the fields as file and setters gave them, on the
 * time and on the viewer alone, not on the times asked for before. Clocks and what follows them at
 * once are evaluated at the very time; where the past matters (toggles, triggers, clocks that start
 * each other) it is lived through in steps of 1/32 s, and at the moments at which clocks start and
 * end. `viewer` NULL: nobody looks. False without memory. */
PLR_API bool plr_scene_set_time(plr_scene *scene, double time, const plr_viewer *viewer,
                                plr_diags *diags);

/* ---- The table of nodes ---- */

typedef struct plr_field_info {
    const char *name;
    plr_type type;
    plr_access access;
    const char *initial;     /* default in Classic VRML notation; "" for empty and NULL */
    double minimum, maximum; /* of each number; -INFINITY and INFINITY: unbounded */
    bool exclusive_minimum, exclusive_maximum;
    const char *nodes; /* for nodes: the types and abstract types allowed, separated by blanks */
    bool extension;    /* not in ISO/IEC 19775-1: plugray's own or another browser's */
    bool dialect_2005; /* only in the volume proposal of 2005: tells the dialect of a scene */
} plr_field_info;

typedef struct plr_node_info {
    const char *name;
    const char *component;       /* "VolumeRendering" */
    const char *bases;           /* abstract types, separated by blanks */
    const char *container_field; /* the default in XML */
    const plr_field_info *fields;
    size_t field_count;
    bool author_fields; /* takes fields that the author declares */
    bool extension;
    bool dialect_2005;
} plr_node_info;

PLR_API size_t plr_node_info_count(void);
PLR_API const plr_node_info *plr_node_info_at(size_t index);
PLR_API const plr_node_info *plr_node_info_find(const char *name);
/* Whether a node of type `name` is of type `type` or derived from it. */
PLR_API bool plr_node_info_is(const plr_node_info *info, const char *type);

#ifdef __cplusplus
}
#endif
#endif
