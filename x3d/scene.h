/* The scene graph from inside: what the public accessors and the readers share. */
#ifndef PLR_X3D_SCENE_H
#define PLR_X3D_SCENE_H

#include <plugray/x3d.h>
#include "base/arena.h"
#include "x3d/names.h"
#include "x3d/nodes.h"
#include "x3d/text.h"

struct x3d_scope;
struct x3d_proto;

/* Default values that another dialect has. */
typedef struct x3d_other_default {
    size_t index; /* of the field */
    size_t from;  /* the field whose value it takes; SIZE_MAX: none, it is: */
    plr_field value;
} x3d_other_default;

typedef struct x3d_other_defaults {
    x3d_other_default *items;
    size_t count, capacity;
} x3d_other_defaults;

/* A node type of the table, as one scene uses it. */
typedef struct x3d_type {
    const plr_node_info *info;
    plr_field *defaults;             /* parsed default values; NULL until the first use */
    x3d_other_defaults others;       /* of the dialect of 2005; found with the former */
    const x3d_alias *const *aliases; /* of its fields; ends with NULL */
    size_t alias_count;
    const struct x3d_behaviour *behaviour; /* what it does in time; see events.h */
    bool transforms;                       /* moves what is below it */
    bool behaviour_known;
} x3d_type;

/* "Field `field` of this node carries field `interface` of the prototype." */
typedef struct x3d_is {
    plr_node *node;
    uint32_t field, interface;
    plr_place place;
} x3d_is;

typedef struct x3d_is_list {
    x3d_is *items;
    size_t count, capacity;
} x3d_is_list;

/* What an instance of a prototype shows to the outside: the fields of its interface, and where in
 * the copied body they lead. */
typedef struct x3d_instance {
    struct x3d_proto *proto;
    const x3d_is *targets;
    size_t target_count;
} x3d_instance;

/* Memory that a setter made for the value of a field: `count` numbers. */
typedef struct x3d_room {
    void *memory;
    size_t count;
} x3d_room;

struct plr_node {
    x3d_type *type;      /* NULL: stands for an instance of a prototype that is still being read */
    const char *written; /* as the file spells the type */
    const char *def;
    plr_place place;
    uint32_t id;
    uint32_t owner_index; /* in the list of nodes of `owner` */
    plr_field *fields;
    size_t field_count, field_capacity;
    x3d_room *room;                /* for each field; NULL until one is set */
    struct x3d_proto *owner;       /* the prototype whose body it is part of; NULL in a scene */
    x3d_instance *instance;        /* where it is the first node of an instance */
    struct x3d_scope *inlined;     /* of an Inline: the names of the file */
    struct x3d_event_node *events; /* where it takes part in events */
    uint64_t revision;
};

typedef struct x3d_node_list {
    plr_node **items;
    size_t count, capacity;
} x3d_node_list;

typedef struct x3d_route_list {
    plr_route *items;
    size_t count, capacity;
} x3d_route_list;

typedef struct x3d_meta {
    const char *name, *content;
} x3d_meta;

struct plr_scene {
    plr_arena arena;
    plr_allocator allocator; /* the host's */
    size_t used_memory, max_memory;
    plr_file_rules rules;
    size_t max_nodes, max_depth;
    plr_diags *diags; /* of the call that runs */
    size_t reported;
    size_t nearest_budget; /* how many names may still be compared */
    size_t work_budget;    /* how many steps may still go into what grows faster than its text */
    bool stopped;          /* a limit was reached: nothing more is read */

    x3d_file *files;
    size_t load_count;
    const char *const *roots; /* real paths of the folders that may be read, NULL at the end */
    x3d_names types;          /* name or alias -> x3d_type */
    x3d_names externals;      /* real path of a file -> its x3d_scope: prototypes of other files */

    x3d_node_list nodes; /* top level */
    x3d_route_list routes;
    struct {
        x3d_meta *items;
        size_t count, capacity;
    } metas;
    struct x3d_scope *scope; /* names of the main file */
    const char *version;
    double length_unit, angle_unit;
    uint32_t node_count;
    bool uses_2005;
    plr_place place_2005;
    bool is_2005;               /* the defaults are those of 2005 now */
    x3d_node_list two_dialects; /* nodes whose type has other defaults there */
    struct x3d_events *events;  /* NULL until a time is asked for */
    plr_node *box_edges;        /* NULL until a bounding box is to be seen */
    uint64_t revision;
    uint64_t set_revision; /* the last one that a setter made */
};

/* Reports to the diagnostics of the running call. After some hundred errors and warnings the rest
 * is left out, with one word about it. */
void x3d_report(plr_scene *scene, plr_code code, plr_place place, const char *format, ...)
    PLR_PRINTF(4, 5);
void x3d_warn(plr_scene *scene, plr_code code, plr_place place, const char *format, ...)
    PLR_PRINTF(4, 5);
/* Takes from the work budget; false when it is used up (reported; everything then stops). */
bool x3d_spend(plr_scene *scene, size_t steps, plr_place place);
/* "(did you mean 'x'?)" as a note, where there is a nearest name. */
void x3d_suggest(plr_scene *scene, plr_place place, const x3d_nearest *nearest);

/* The type of a name or alias; NULL: unknown. Notes the use of words of 2005. */
x3d_type *x3d_type_find(plr_scene *scene, const char *name, size_t length, plr_place place);
/* A new node with default values; NULL when the limit of nodes is reached (reported). */
plr_node *x3d_node_new(plr_scene *scene, x3d_type *type, plr_place place);
/* Reads a default of the table into a field. */
void x3d_read_default(plr_scene *scene, const plr_node_info *info, const plr_field_info *row,
                      const char *text, plr_field *field);
/* Counts one more node without a type; false at the limit. */
bool x3d_node_count_up(plr_scene *scene, plr_place place);
/* Index of a field by name or alias; SIZE_MAX: none. Notes the use of words of 2005. */
size_t x3d_field_index(plr_scene *scene, const plr_node *node, const char *name, size_t length,
                       plr_place place);
/* The row of the table of a field, or NULL (declared by the author). */
const plr_field_info *x3d_field_info(const plr_node *node, size_t index);
/* Adds a field that the author declares; name is copied. */
plr_field *x3d_field_declare(plr_scene *scene, plr_node *node, const char *name, size_t length,
                             plr_type type, plr_access access, plr_place place);
void x3d_uses_2005(plr_scene *scene, plr_place place);
/* Finds what other defaults the type has in the dialect of 2005. */
void x3d_find_other_defaults(plr_scene *scene, x3d_type *type);
/* The file whose name this very pointer is; the main file if there is none. */
x3d_file *x3d_file_of_name(const plr_scene *scene, const char *name);
/* Appends a node to a value of nodes (its array grows by doubling, and is never shared). */
void x3d_append_node(plr_scene *scene, plr_field *field, plr_node *node);
/* Allocator for memory that counts against max_memory. */
plr_allocator x3d_counting_allocator(plr_scene *scene);

#endif
