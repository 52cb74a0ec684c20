/* Time and events: what a scene does by itself. Every time is computed from the fields as file and
 * setters gave them, so that it does not matter which times were asked for before: first all fields
 * that events changed are put back, then the scene is brought to the time that is asked for, and
 * last the fields are compared with what they were when the call began. */
#ifndef PLR_X3D_EVENTS_H
#define PLR_X3D_EVENTS_H

#include "base/matrix.h"
#include "x3d/scene.h"

typedef struct x3d_events x3d_events;
typedef struct x3d_event_node x3d_event_node;

/* A value of a field in memory of its own. */
typedef struct x3d_event_value {
    void *memory;
    size_t room; /* of the memory, in bytes */
    size_t count;
} x3d_event_value;

/* A field that events reach. */
typedef struct x3d_event_field {
    x3d_event_node *owner;
    uint32_t index;
    bool changed; /* by events, since the scene was put back */
    bool listed, has_shown;
    plr_field original; /* as file and setters gave it */
    x3d_event_value current;
    x3d_event_value shown; /* when the last call ended */
    uint64_t changed_at;   /* the revision of the scene when it was last another value */
    size_t first_route, route_count;
    struct x3d_event_field *next_listed;
} x3d_event_field;

typedef struct x3d_event_route {
    x3d_event_field *from, *to;
    uint64_t stamp; /* when it last carried an event */
} x3d_event_route;

/* A node that moves what is below it, with all that moves it. */
typedef struct x3d_event_place {
    const plr_node *node; /* NULL: the world */
    uint32_t outer;       /* comes before this one */
    bool needed;
    plr_matrix to_world;
} x3d_event_place;

/* State of a TimeSensor. */
typedef struct x3d_clock {
    bool active, paused, finished;
    bool told;  /* an event gave it its startTime */
    bool dirty; /* an event came since it last looked */
    double start, cycles, paused_sum, paused_at;
} x3d_clock;

/* What a type of node does in time. */
typedef struct x3d_behaviour {
    const char *type; /* or abstract type; the first row that fits counts */
    /* Whether an event may change the field; NULL: it may. */
    bool (*accepts)(const x3d_event_node *node, const plr_field *field, const plr_field *value);
    /* An event has changed the field. */
    void (*receive)(x3d_events *events, x3d_event_node *node, const plr_field *field);
    /* Sees to it that the node is what it should be at events->now. */
    void (*step)(x3d_events *events, x3d_event_node *node);
    /* What happens when the scene is loaded. */
    void (*start)(x3d_events *events, x3d_event_node *node);
    bool is_clock;
    /* Whether the past matters where a ROUTE leads to this field; NULL: to none. */
    bool (*remembers)(const char *field);
    const void *data;
} x3d_behaviour;

struct x3d_event_node {
    plr_node *node;
    const x3d_behaviour *behaviour; /* NULL: events merely change it */
    x3d_event_field **fields;       /* by index; NULL until an event needs it */
    uint32_t place;                 /* of the space that it stands in; 0: the world */
    uint32_t target_place;          /* of what a TransformSensor looks at */
    union {
        x3d_clock clock;
        struct {
            bool inside;
        } sensor;
        struct {
            bool told, far;
        } octants;
        struct {
            size_t current; /* 0: none yet, else one more than the index */
        } sequencer;
        struct {
            x3d_event_node *below, *above; /* in the stack */
            bool bound;
        } bindable;
    } state;
};

typedef struct x3d_event_nodes {
    x3d_event_node **items;
    size_t count, capacity;
} x3d_event_nodes;

enum {
    X3D_STACKS = 4, /* of bindable nodes */
    /* in one call, so that no scene takes longer than some seconds */
    X3D_MOST_WORK = 5000000
};

struct x3d_events {
    plr_scene *scene;
    const plr_viewer *viewer;
    double now;
    uint64_t stamp;        /* of the events that are sent now */
    x3d_event_nodes nodes; /* in the order of the file */
    x3d_event_nodes clocks, steppers, starters;
    struct {
        x3d_event_route *items;
        size_t count;
    } routes; /* by field, then in the order of the file */
    struct {
        x3d_event_place *items;
        size_t count, capacity;
    } places;
    struct {
        struct x3d_event_item {
            x3d_event_field *field;
            bool received;
        } * items;
        size_t count, capacity;
    } queue;
    x3d_event_field *listed;          /* every field that was ever changed */
    x3d_event_node *tops[X3D_STACKS]; /* of the stacks of bindable nodes */
    bool has_history;                 /* the past matters */
    bool again;                       /* a clock got an event */
    bool origin_at_load;              /* startTime 0 is no special time */
    double most_steps;                /* of one call */
    double work;                      /* events that this call has carried, and looks at clocks */
    void *scratch;
    size_t scratch_room;
};

/* ---- For the rest of x3d ---- */

/* A setter has given the field a value, perhaps the same as before. */
void x3d_events_was_set(plr_scene *scene, plr_node *node, size_t index, bool same);

/* The field as file and setters gave it: events may have put another value into the node. */
plr_field *x3d_events_given(plr_node *node, size_t index);

/* ---- Building (events_graph.c) ---- */

x3d_events *x3d_events_build(plr_scene *scene);
/* The node's part in events, made now if it has none. */
x3d_event_node *x3d_event_node_of(x3d_events *events, plr_node *node);
x3d_event_field *x3d_event_field_at(x3d_events *events, x3d_event_node *node, size_t index);
/* Finds where sensors are, as transforms stand now. */
void x3d_event_places_update(x3d_events *events);

/* ---- Sending (events_send.c) ---- */

/* Sends a value from the field of that name, `count` in elements. */
void x3d_send(x3d_events *events, x3d_event_node *node, const char *field, const void *values,
              size_t count);
void x3d_send_bool(x3d_events *events, x3d_event_node *node, const char *field, bool value);
void x3d_send_time(x3d_events *events, x3d_event_node *node, const char *field, double value);
/* Carries all events that wait, and what they cause; every ROUTE once a timestamp. */
void x3d_cascade(x3d_events *events);
/* Puts all fields back that events changed. */
void x3d_events_reset(x3d_events *events);
/* Compares all fields with what they were before and counts revisions up. */
void x3d_events_compare(x3d_events *events);
/* Memory for the value that a behaviour is about to send; valid until the next call. */
void *x3d_events_scratch(x3d_events *events, size_t size);

/* ---- Behaviours ---- */

/* The rows of each file end with a type of NULL. */
extern const x3d_behaviour x3d_clock_behaviours[], x3d_logic_behaviours[],
    x3d_interpolator_behaviours[], x3d_spline_behaviours[], x3d_sensor_behaviours[],
    x3d_bindable_behaviours[], x3d_dialect_behaviours[];

/* The next moment after `now` at which the clock starts, ends, stops, pauses, resumes or, where
 * somebody listens, begins a cycle; INFINITY: none. */
double x3d_clock_next(const x3d_event_node *node, double now, bool origin_at_load);
/* The last moment up to `time` at which the clock has something to tell, as it would run without
 * any event: -1 where it does not run at all. */
double x3d_clock_last(const x3d_event_node *node, double time, bool origin_at_load);
/* Binds what is bound when a scene is loaded. */
void x3d_bindables_start(x3d_events *events);

/* Where a fraction lies among keys: between key `index` and the next, `weight` of the way. Any list
 * of keys is safe; false without keys or for a fraction that is no number. */
typedef struct x3d_key_span {
    size_t index, next;
    double weight;
} x3d_key_span;
bool x3d_key_span_find(const plr_field *key, size_t count, double fraction, x3d_key_span *span);

#endif
