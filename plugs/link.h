/* The state of one link. Shared by the files of the linker; each says which part it fills. */
#ifndef PLR_PLUGS_LINK_H
#define PLR_PLUGS_LINK_H

#include "plugs/source.h"

typedef struct plr_unit plr_unit;
typedef struct plr_node plr_node;
typedef struct plr_binding plr_binding;
typedef struct plr_scope plr_scope;
typedef struct plr_socket plr_socket;

/* Owners of scopes besides the effects. */
#define PLR_OWNER_BASE UINT32_MAX
#define PLR_OWNER_LIBRARY (UINT32_MAX - 1)
#define PLR_OWNER_HOST (UINT32_MAX - 2) /* names that effects declare and nobody owns */

/* A source as this link sees it: its identifiers numbered for the whole link. */
typedef struct plr_reading {
    const plr_source *source;
    const uint32_t *gids; /* by local identifier */
} plr_reading;

/* A macro as conditionals see it. */
typedef enum plr_macro_state {
    PLR_MACRO_UNDEFINED,
    PLR_MACRO_UNKNOWN, /* defined in a conditional that is kept */
    PLR_MACRO_NUMBER,
    PLR_MACRO_TOKENS
} plr_macro_state;

typedef struct plr_macro {
    plr_macro_state state;
    bool host; /* written nowhere in the program */
    bool function_like;
    int64_t number;
    const char *text; /* of a host's macro */
    const plr_lexed *lexed;
    const uint32_t *gids;
    uint32_t first, end; /* the replacement */
} plr_macro;

typedef struct plr_edge {
    plr_binding *symbol; /* or else */
    struct plr_function *function;
    struct plr_edge *next;
} plr_edge;

/* An item of a unit in this link. */
struct plr_node {
    plr_unit *unit;
    const plr_item *item;
    plr_edge *edges;               /* the symbols that its text names */
    plr_binding *symbol;           /* of its first name */
    struct plr_function *function; /* its first plug function */
    bool reached, dropped, emitted, declared, entered, declaring;
    bool undefine_before; /* another unit of the effect defined the macro otherwise */
};

/* A declaration of a symbol. */
typedef struct plr_definition {
    plr_node *node;
    const plr_name *name;
    struct plr_definition *next;
} plr_definition;

struct plr_binding {
    uint32_t gid;
    plr_scope *scope;
    plr_definition *definitions, *last;
    const plr_definition *pending; /* the first that may still be missing in the text */
    const char *text;              /* in the program; NULL: not made yet */
    uint32_t length;
    uint32_t variant; /* 2 and more: a unit's own among several of the effect */
    bool renamed, macro, function, variable, weak /* prototypes only */, reached;
    bool builtin; /* also the name of a built-in function */
    bool passed;  /* of the fragment stage: a geometry stage hands it on under another name */
    uint32_t stamp;
};

/* A branch of a conditional that is kept. */
typedef struct plr_branch {
    const struct plr_branch *outer;
    uint32_t depth, group, number; /* which conditional of its unit, which of its branches */
} plr_branch;

/* A function PLUG_xxx. */
typedef struct plr_function {
    plr_node *node;
    const plr_name *name;
    uint32_t gid;     /* of PLUG_xxx */
    uint32_t plug;    /* gid of xxx */
    const char *text; /* in the program */
    uint32_t length;
    uint32_t effect;
    bool placed;
    bool guarded; /* in some branch that is kept: whether it is there is known to the compiler only
                   */
    const plr_item *item;
    const plr_branch *branch;       /* the innermost that it stands in */
    struct plr_function *twin;      /* the same in another branch of a kept conditional */
    const struct plr_function *met; /* the last one that stands in the same branch */
    struct plr_function *next;      /* in its unit */
    struct plr_function *next_same; /* of the same name in the effect and stage */
} plr_function;

/* A call of a function at a plug. */
typedef struct plr_call {
    plr_function *function;
    uint32_t list; /* in plr_lexed.lists of the plug's source */
} plr_call;

/* A plug that stands in active text: where calls go. */
struct plr_socket {
    plr_unit *unit;
    const plr_plug *plug;
    uint32_t effect;          /* or PLR_OWNER_BASE */
    uint32_t index;           /* in the list of the link */
    PLR_LIST(plr_call) calls; /* in their final order after plr_order_calls */
    bool reached;
};

struct plr_unit {
    const plr_reading *reading;
    const plr_lexed *lexed;
    const plr_activity *activity; /* NULL: no conditionals */
    plr_activity own_activity;
    const plr_cut *cut;
    plr_cut own_cut;
    plr_scope *scope;
    uint32_t index;  /* within the scope */
    uint32_t number; /* within the link */
    plr_node *nodes;
    plr_binding **refs;   /* by local identifier; valid where actions say so */
    uint8_t *actions;     /* by local identifier: plr_action */
    plr_socket **sockets; /* by plug of the source */
    plr_function *functions, *last_function;
    plr_promises promises;                                  /* promise.c */
    const plr_promise_comment *promised[PLR_PROMISE_KINDS]; /* the comments that do */
};

/* What an identifier of a unit becomes. */
typedef enum plr_action {
    PLR_ACTION_UNKNOWN, /* not looked up yet */
    PLR_ACTION_COPY,
    PLR_ACTION_NAME,   /* the symbol's name in the program */
    PLR_ACTION_SPECIAL /* depends on what follows: see emit.c */
} plr_action;

/* One effect (or base, library) in one stage. */
struct plr_scope {
    uint32_t owner; /* effect or PLR_OWNER_... */
    plr_stage stage;
    plr_unit *units;
    uint32_t unit_count;
    uint32_t number;              /* of scopes, for keys */
    bool live;                    /* something of it is reached */
    bool split;                   /* some units have names of their own */
    PLR_LIST(uint32_t) providers; /* effects whose plugs it implements, latest first */
};

typedef struct plr_message {
    plr_severity severity;
    plr_code code;
    plr_place place;
    const char *text;
} plr_message;

/* An effect that was found in a round to be left out of the next ones, and what is said of it:
 * nothing where it is merely not needed. */
typedef struct plr_unfit {
    plr_message *messages;
    size_t count;
} plr_unfit;

/* A call that is to be added when its effect proves to be without fault. */
typedef struct plr_pending {
    plr_socket *socket;
    plr_function *function;
    uint32_t list;
} plr_pending;

/* An open addressing table of 64-bit keys (never 0). */
typedef struct plr_table {
    uint64_t *keys;
    void **values;
    size_t mask, count;
} plr_table;

typedef PLR_LIST(plr_socket *) plr_sockets;

/* Begins the names that varyings have behind the geometry stage. */
#define PLR_PASSED "plr_geo_"

/* A varying that the linker carries from the vertex to the fragment stage: geometry.c. */
typedef struct plr_passed {
    const char *name;           /* in the vertex stage, and as the geometry stage's input */
    const char *passed;         /* as the geometry stage's output, and in the fragment stage */
    const char *type;           /* less its array */
    const char *input, *output; /* how it is interpolated: "flat " */
    uint32_t array;             /* elements; 0: none */
    bool whole;                 /* of whole numbers, or flat: nothing to add up */
    bool declared;              /* the author's text declares the input */
} plr_passed;

struct plr_out;

typedef struct plr_linking {
    const plr_link_desc *desc;
    plr_arena *arena; /* lives as long as the program */
    plr_arena *pass;  /* of one round of the fixpoint; the last one's lives as long */
    uint32_t effect_count;

    /* Identifiers of the link. */
    PLR_LIST(plr_ident) idents;
    uint32_t *slots;
    size_t slot_mask;
    plr_table readings; /* source -> plr_reading */
    plr_macro **hosts;  /* by gid: macros of the host */
    size_t host_capacity;

    /* What conditionals ask; grows from round to round. */
    uint8_t *used, *reads; /* by gid */
    uint8_t *offered;      /* by gid: plugs of texts that ask */
    uint8_t *asked;        /* by gid: PLR_ASKED_... */
    uint8_t *members;      /* by gid: whether an effect has a member of that name */
    bool dynamic, grown, all;
    plr_unfit **unfit; /* by effect: NULL: it may be used */
    unsigned restarts;
    bool again;       /* the round found an effect to be left out */
    bool no_geometry; /* no text of the geometry stage has main(): there is no such stage */

    /* One round. */
    plr_macro **macros; /* by gid: of the scope at hand */
    PLR_LIST(uint32_t) touched;
    plr_scope *scopes[PLR_STAGE_COUNT]; /* by effect, then base, library, host */
    plr_table symbols;                  /* (scope number, gid) -> plr_binding */
    plr_table by_plug;                  /* (stage, instance, gid) -> plr_sockets */
    plr_table functions;  /* (scope number, gid of PLUG_x) -> the first plr_function */
    plr_table lost_names; /* (effect, gid): a faulty effect declares it */
    plr_table lost;       /* (stage, gid) -> effect + 1 that was faulty and would have offered it */
    PLR_LIST(plr_socket *) sockets;
    bool *faulty, *left_out, *active;
    PLR_LIST(plr_message) messages;
    uint32_t unit_count, scope_numbers;
    uint32_t stamp;
    uint32_t *provider_of; /* by effect: the scope that it was last noted for */
    PLR_LIST(plr_node *) queue;
    PLR_LIST(plr_pending) pending; /* calls of the effect at hand */
    size_t *said, *said_end;       /* by effect: the messages about it */
    uint32_t *lost_from;           /* by effect: + 1: the faulty one that it would build on */
    bool *called;                  /* by effect: it has calls, or had before others' removal */
    bool *removed;                 /* by effect: another takes its calls away */
    uint32_t *names, *targets;     /* by effect: gids, PLR_NONE: none */
    bool placements;               /* some effect has one */
    plr_table targets_of;          /* (name, reach) -> a built-in effect of that name exists */
    uint8_t stages;                /* bit: the base has the stage */
    bool uses_color, uses_data;    /* gl_FragColor, gl_FragData */
    uint32_t data_size;
    bool base_fault;
    uint32_t main_effect; /* whose main() the geometry stage has; PLR_NONE: none's, so far */
    PLR_LIST(plr_passed) passed;
    bool passes_size;  /* of points */
    uint32_t compared; /* names with unknown ones */

    /* Versions. */
    int version;
    bool keep_all;
} plr_linking;

enum {
    PLR_ASKED_USED = 1,
    PLR_ASKED_READS = 2
};

#define PLR_SCOPE_BASE(l) ((l)->effect_count)
#define PLR_SCOPE_LIBRARY(l) ((l)->effect_count + 1)
#define PLR_SCOPE_HOST(l) ((l)->effect_count + 2)

/* table.c */
void *plr_table_get(const plr_table *table, uint64_t key);
/* The value's slot; NULL inside if the key is new. Valid until the next call. */
void **plr_table_put(plr_arena *arena, plr_table *table, uint64_t key);

/* units.c: sources to units. */
uint32_t plr_gid(plr_linking *l, const char *text, size_t length);
/* PLR_NONE if no source has it. */
uint32_t plr_gid_find(const plr_linking *l, const char *text, size_t length);
void plr_read_all(plr_linking *l);
void plr_make_units(plr_linking *l);
void plr_make_stages(plr_linking *l);
/* The highest version that any text asks for. */
void plr_decide_version(plr_linking *l);
/* Lowers it to what active text asks for; true if that makes a difference. */
bool plr_lower_version(plr_linking *l);
/* Says which #version lines are wrong. */
void plr_say_versions(plr_linking *l);
static inline uint32_t plr_token_gid(const plr_unit *unit, uint32_t token) {
    return unit->reading->gids[unit->lexed->tokens.items[token].value];
}
static inline const plr_ident *plr_token_ident(const plr_unit *unit, uint32_t token) {
    return &unit->lexed->idents.items[unit->lexed->tokens.items[token].value];
}
static inline plr_place plr_unit_place(const plr_unit *unit, size_t offset) {
    return plr_source_place(unit->reading->source, offset);
}
static inline plr_place plr_token_place(const plr_unit *unit, uint32_t token) {
    return plr_unit_place(unit, unit->lexed->tokens.items[token].offset);
}
static inline plr_scope *plr_scope_of(const plr_linking *l, plr_stage stage, uint32_t effect) {
    return &l->scopes[stage][effect];
}

/* condition.c: conditionals. */
void plr_set_hosts(plr_linking *l);
void plr_set_version(plr_linking *l);
void plr_begin_macros(plr_linking *l, const plr_scope *scope);
void plr_evaluate(plr_linking *l, plr_unit *unit);

/* names.c: scopes and what identifiers mean. */
bool plr_define_names(plr_linking *l, plr_scope *scope);
/* Another definition of a name of the scope. */
plr_binding *plr_declare_name(plr_linking *l, plr_node *node, const plr_name *name);
plr_action plr_resolve(plr_linking *l, plr_unit *unit, uint32_t local);
const char *plr_binding_text(plr_linking *l, plr_binding *symbol, uint32_t *length);
plr_binding *plr_binding_find(const plr_linking *l, const plr_scope *scope, uint32_t gid);
/* What a plug function asks before it does anything (plr_effect.gate); NULL: nothing. */
plr_binding *plr_gate_of(const plr_linking *l, const plr_node *node);
/* Whether a token names no symbol: only a macro of its own scope replaces members and locals. */
static inline bool plr_is_plain(const plr_unit *unit, const plr_token *token,
                                const plr_binding *symbol) {
    bool macro = symbol && symbol->macro;
    return (token->flags & (PLR_TF_MEMBER | PLR_TF_PLAIN) &&
            !(macro && symbol->scope == unit->scope)) ||
           (token->flags & PLR_TF_LOCAL && !macro);
}

/* Whether a local variable has the name of a macro of the base, the library or another effect. */
static inline bool plr_is_hidden_local(const plr_linking *l, const plr_unit *unit,
                                       const plr_token *token, const plr_binding *symbol) {
    return symbol && symbol->macro && token->flags & PLR_TF_LOCAL && symbol->scope != unit->scope &&
           unit->scope->owner < l->effect_count;
}

/* compare.c: whether two declarations say the same: token by token; as items; as types of
 * variables, less what does not matter to them; as parameters of functions. */
bool plr_same_tokens(const plr_unit *a, uint32_t a_first, uint32_t a_end, const plr_unit *b,
                     uint32_t b_first, uint32_t b_end);
bool plr_same_item(const plr_unit *a, const plr_item *x, const plr_unit *b, const plr_item *y);
bool plr_same_type(const plr_unit *a, const plr_item *x, const plr_unit *b, const plr_item *y);
bool plr_same_signature(const plr_unit *a, const plr_name *x, const plr_unit *b, const plr_name *y);

/* sockets.c: plugs and the functions called there. */
/* What an effect is attached to: k + 1 of effect k, which stands before it; 0: nothing. */
size_t plr_attached_to(const plr_linking *l, size_t effect);
void plr_add_sockets(plr_linking *l, plr_unit *unit);
bool plr_find_functions(plr_linking *l, plr_scope *scope);
void plr_name_functions(plr_linking *l, plr_scope *scope);
void plr_commit_calls(plr_linking *l);
/* The last token of a function's body; PLR_NONE: its braces are split among branches. */
uint32_t plr_function_end(const plr_unit *unit, const plr_name *name);
/* Finds the plugs of an effect's functions; false: one of them fits nowhere. */
bool plr_place_functions(plr_linking *l, uint32_t effect);

/* order.c: the order of calls at each plug. */
void plr_note_targets(plr_linking *l);
bool plr_target_exists(const plr_linking *l, uint32_t effect);
void plr_order_calls(plr_linking *l);

/* Leaves out the effects that are there only if their target is, and it is not. */
void plr_leave_inactive(plr_linking *l);

/* lost.c: what faulty effects would have given to others. */
void plr_note_lost(plr_linking *l, uint32_t effect);
/* Whether the effect lacks the name; then it is left out in the next round. */
bool plr_lacks_name(plr_linking *l, const plr_unit *unit, uint32_t token);

/* reach.c: what the program needs. */
void plr_reach(plr_linking *l);
/* The functions that a direct call of PLUG_x with that many arguments means, in `found`. */
size_t plr_direct_functions(const plr_linking *l, const plr_unit *unit, uint32_t token,
                            plr_function **found, size_t capacity);

/* symbols.c: elements of an array whose brackets begin at `token`; 0: there are none. */
uint32_t plr_array_size(plr_linking *l, const plr_unit *unit, uint32_t token, uint32_t end);

/* geometry.c: the stage that is there only where an author gives it a main(). */
/* Whether some text of the stage may have main(). */
bool plr_wants_geometry(const plr_linking *l);
/* The main() of a stage: the base's or, of the geometry stage, an effect's; NULL: there is none. */
plr_binding *plr_entry(const plr_linking *l, plr_stage stage);
/* Declares main() in an effect's geometry unit; false: there is one already. */
bool plr_declare_main(plr_linking *l, plr_node *node, const plr_name *name);
/* Whether units of the stage, one of which has main(), take what the host draws; says so if not. */
bool plr_takes_primitive(plr_linking *l, const plr_scope *scope);
/* Says which parts of effects are left out because there is no such stage. */
void plr_say_stages(plr_linking *l);
/* Finds the varyings to be carried through the stage, once everything is reached; effects with what
 * cannot be carried are to be left out. */
void plr_pass_varyings(plr_linking *l);
/* An output of the effect's geometry unit that its fragment units name without declaring it: a
 * binding for them; NULL: there is none. */
plr_binding *plr_geometry_output(plr_linking *l, const plr_unit *unit, uint32_t gid);

/* effects.c: one effect after the other. */
/* Leaves an effect out of the next rounds; `message`, whose text lives as long as the link, may be
 * NULL. */
void plr_leave_out(plr_linking *l, uint32_t effect, const plr_message *message);
/* The effects that are faulty in a stage that there will not be: their faults stay. */
void plr_keep_faults(plr_linking *l, plr_stage stage);
void plr_add_effects(plr_linking *l);

/* promise.c: what units promise. Reads the comments of a scope whose functions are known. */
void plr_take_promises(plr_linking *l, plr_scope *scope);

/* messages.c */
void plr_say(plr_linking *l, plr_code code, plr_place place, const char *format, ...)
    PLR_PRINTF(4, 5);
void plr_say_note(plr_linking *l, plr_place place, const char *format, ...) PLR_PRINTF(3, 4);
const char *plr_gid_text(plr_linking *l, uint32_t gid);
/* "; did you mean ...": the nearest of some words; "" if none is near. */
const char *plr_nearest_words(plr_linking *l, const char *text, size_t length,
                              const char *const *words, size_t count);
/* An effect for messages: its name, or its number. */
const char *plr_effect_text(plr_linking *l, uint32_t effect);
void plr_say_unplaced(plr_linking *l, const plr_unit *unit, plr_function *function);
/* The target of an effect, if it is the name of nothing that is known. */
void plr_check_target(plr_linking *l, uint32_t effect);

#endif
