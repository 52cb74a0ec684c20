/* plugray/plugs.h - the linker: GLSL text in, GLSL text out.
 *
 * It finds functions named PLUG_xxx in effects and the comments "PLUG: xxx (params)" in base
 * shaders and earlier effects, renames, forward-declares and joins them into one program a stage.
 * It knows nothing of GL, X3D, files or time.
 *
 * Use: read texts into sources (once; a source is immutable and may serve many links, in many
 * threads), describe base, library and effects by arrays of sources, call plr_link, take the text
 * of each stage from the program, translate messages of compilers with its map.
 *
 * Thread safety: plr_link is re-entrant. Nothing is printed, nothing is global. */
#ifndef PLUGRAY_PLUGS_H
#define PLUGRAY_PLUGS_H

#include <plugray/base.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum plr_stage {
    PLR_VERTEX,
    PLR_GEOMETRY,
    PLR_FRAGMENT,
    PLR_STAGE_COUNT
} plr_stage;

/* "vertex", "geometry", "fragment". */
PLR_API const char *plr_stage_text(plr_stage stage);

/* ---- Reading -------------------------------------------------------------------------------- */

/* One unit of GLSL, read: tokens and declarations, not yet linked. Immutable. */
typedef struct plr_source plr_source;

/* Reads `length` bytes of GLSL for one stage. Text, file name and breaks are copied. Faults of the
 * text (an unterminated comment or body) are kept in the source and reported by each link that uses
 * it, so that a fault is reported even if the source was read elsewhere.
 * Returns NULL only without memory or if the text is larger than 64 MiB (added to `diags`). */
PLR_API plr_source *plr_source_read(plr_stage stage, const char *text, size_t length,
                                    const plr_origin *origin, const plr_allocator *allocator,
                                    plr_diags *diags);
PLR_API void plr_source_destroy(plr_source **source);
PLR_API plr_stage plr_source_stage(const plr_source *source);
/* The text as given, NUL-terminated; owned by the source. */
PLR_API const char *plr_source_text(const plr_source *source, size_t *length);
/* The names of the plugs whose comments stand anywhere in the text, inactive branches included, in
 * order of text, as often as they stand there. A name is not NUL-terminated: `length` is its own.
 */
PLR_API size_t plr_source_plug_count(const plr_source *source);
PLR_API const char *plr_source_plug(const plr_source *source, size_t index, size_t *length);
/* Its argument lists as written, "(c, tex, coord) (c, coord)", of that length; and where the
 * comment begins. */
PLR_API const char *plr_source_plug_lists(const plr_source *source, size_t index, size_t *length);
PLR_API plr_place plr_source_plug_place(const plr_source *source, size_t index);

/* ---- Describing a program ------------------------------------------------------------------ */

/* A macro that the host defines; value NULL means 1. */
typedef struct plr_define {
    const char *name, *value;
} plr_define;

typedef enum plr_placement {
    PLR_ADD_AFTER,
    PLR_ADD_BEFORE,
    PLR_REPLACE,
    PLR_REMOVE
} plr_placement;

/* "attached to nothing": the effect reaches the plugs of the base and of every effect before it. */
#define PLR_WHOLE 0
/* How deep effects may be attached to effects. */
#define PLR_MOST_ATTACHED 64

/* An effect: an ordered group of units that share names. */
typedef struct plr_effect {
    const char *name; /* for messages and maps: a DEF name or a node type; may be NULL */
    const plr_source *const *sources;
    size_t source_count;
    /* Macros for the conditionals of this effect's units alone. They are evaluated by the linker
     * and never written to the program; tokens elsewhere are not replaced. */
    const plr_define *defines;
    size_t define_count;
    /* 0: PLR_WHOLE. k: this effect is local to effect k-1 of the list (a light, a texture, a
     * volume; it must stand earlier): it uses the plugs of that effect and of the effects attached
     * to it, directly or not, and where these have none of the name, those of everything before it.
     * No more than PLR_MOST_ATTACHED effects deep. */
    size_t attached;
    bool only_attached; /* attached, and never to use the plugs of anything else */
    bool private_plugs; /* its plugs are for what is attached to it, directly, and for nothing else:
                         * it calls there what stands inside it */
    bool builtin;  /* comes with the host: may be a target, stands before authors' in its place */
    bool disabled; /* keeps its number, contributes nothing */
    plr_placement placement;
    const char *target; /* name of a built-in effect; NULL or "": the whole step */
    bool only_if_active;
    /* A uniform bool that one of its units declares: while it is false, plug functions of that
     * stage return at once, as if the effect were not there. NULL: there is none. */
    const char *gate;
    plr_place
        place; /* where the author wrote the effect, for messages about the effect as a whole */
} plr_effect;

/* A plug that the host knows, for messages: silent where it is inactive, named where the stage is
 * wrong, offered as the nearest name. */
typedef struct plr_known_plug {
    const char *name;
    plr_stage stage;
} plr_known_plug;

typedef enum plr_target_glsl {
    PLR_GLSL_330, /* desktop core profile, 330 or the highest that base or units ask for */
    PLR_GLSL_410,
    PLR_GLSL_450,
    PLR_GLSL_300ES
} plr_target_glsl;

typedef struct plr_link_desc {
    const plr_source *const *base; /* all stages together; order counts within a stage */
    size_t base_count;
    /* Archives: declarations are taken out one by one, when a name refers to them. Uniforms and
     * inputs that stand here are host names: effects may declare them again, and never own them. */
    const plr_source *const *library;
    size_t library_count;
    const plr_effect *effects; /* in the order of calls; see plr_effect.attached */
    size_t effect_count;
    const plr_define *defines; /* macros for the conditionals of all units */
    size_t define_count;
    const plr_known_plug *known_plugs;
    size_t known_plug_count;
    /* Names of built-in effects that the host knows, for messages: silent where one is not there,
     * offered as the nearest name. */
    const char *const *known_targets;
    size_t known_target_count;
    /* The base is an author's own shader: of plugs that it lacks nothing is said, unless one of
     * nearly that name is known. */
    bool own_base;
    /* What the host draws, "points", "lines" or "triangles", for the geometry stage; NULL: not
     * compared. */
    const char *primitive;
    plr_target_glsl glsl;
    bool keep_all;      /* leave nothing out */
    size_t max_text;    /* bytes of input at most; 0: 64 MiB */
    size_t max_effects; /* 0: 65536 */
    const plr_allocator *allocator;
} plr_link_desc;

/* ---- The program --------------------------------------------------------------------------- */

typedef struct plr_program plr_program;

/* Links. Faulty effects are left out and reported; the rest is linked. Returns NULL only if nothing
 * can be linked at all: no memory, a limit, a fault in the base (reported in `diags`, may be NULL).
 * The description may go afterwards, but the sources must live as long as the program.
 *
 * Conditionals see, besides the macros given: __VERSION__, GL_ES or GL_core_profile, and one of
 * PLUGRAY_VERTEX, PLUGRAY_GEOMETRY, PLUGRAY_FRAGMENT; PLUG_USED (plug) is 1 where a function is
 * called at that plug, READS (name) where `.name` occurs in reached text, or where a stage
 * after the vertex stage reads its input `name`. */
PLR_API plr_program *plr_link(const plr_link_desc *desc, plr_diags *diags);
PLR_API void plr_program_destroy(plr_program **program);

/* The text of a stage, NUL-terminated, owned by the program; NULL if the base has no such stage. */
PLR_API const char *plr_program_text(const plr_program *program, plr_stage stage, size_t *length);
/* Whether the effect was left out as faulty by this link, and whether any of its text is in the
 * program (it is active). */
PLR_API bool plr_program_is_faulty(const plr_program *program, size_t effect);
PLR_API bool plr_program_is_active(const plr_program *program, size_t effect);

#define PLR_NO_EFFECT ((size_t)-1)

/* What comments "PLUG-PROMISE: colour-only keeps-transparent lipschitz 12.5" of an effect's units
 * promise of each of its plug functions that change a colour, whatever the input. The linker
 * believes them. */
typedef struct plr_promises {
    bool colour_only;       /* alpha stays as it is */
    bool keeps_transparent; /* alpha 0 stays 0; colour_only has it, too */
    double lipschitz; /* X: no component of the premultiplied colour, or alpha, changes by more than
                       * so many times the greatest change of the components of the colour before
                       * and of the sample's value, all else being equal; 0: none is promised */
} plr_promises;

/* What all fragment units of the effect promise that have plug functions in active text: nothing
 * where one of them promises nothing, the greatest `lipschitz`. Nothing of an effect that is faulty
 * or left out. */
PLR_API plr_promises plr_program_promises(const plr_program *program, size_t effect);

/* What stands at a position of the program. */
typedef struct plr_mapped {
    plr_place place;          /* the author's; file NULL for text that the linker made itself */
    size_t effect;            /* index, or PLR_NO_EFFECT for base and library */
    const plr_source *source; /* the unit, or NULL for text that the linker made itself */
    size_t offset;            /* of the place in the source */
    /* Set in the line of a socket call: the comment that it stands for. `place` is then that of the
     * parameter list of the function called, and `effect` the one that owns the function. */
    bool socket_call;
    plr_place plug_place;
} plr_mapped;

/* Translates line and column (both from 1; column 0: the first non-blank of the line). False
 * outside the text. */
PLR_API bool plr_program_map(const plr_program *program, plr_stage stage, uint32_t line,
                             uint32_t column, plr_mapped *mapped);
PLR_API uint32_t plr_program_lines(const plr_program *program, plr_stage stage);

/* Writes a message of a compiler to `buffer` with every name as the author spelt it. Returns the
 * length that the whole needs, as snprintf does. */
PLR_API size_t plr_program_demangle(const plr_program *program, const char *message, char *buffer,
                                    size_t size);
/* The column (from 1) in program line `line` of the first occurrence of `word` as a whole token,
 * the word being spelt as in the program or as the author spelt it; 0 if it does not occur. */
PLR_API uint32_t plr_program_find_word(const plr_program *program, plr_stage stage, uint32_t line,
                                       const char *word, size_t length);

typedef enum plr_symbol_kind {
    PLR_UNIFORM,
    PLR_ATTRIBUTE, /* input of the vertex stage */
    PLR_OUTPUT     /* output of the fragment stage */
} plr_symbol_kind;

typedef struct plr_symbol {
    plr_symbol_kind kind;
    size_t effect;       /* or PLR_NO_EFFECT */
    const char *name;    /* the author's */
    const char *program; /* the program's */
    const char *type;    /* "vec3", "sampler2D", a struct's program name, ... */
    uint32_t array;      /* elements, 0: no array, UINT32_MAX: an expression that is no number */
    unsigned stages;     /* bit (1u << stage) for each stage that has it */
    bool initialized;    /* its declaration gives a value */
    plr_place place;
} plr_symbol;

/* The uniforms, attributes and outputs that are in the program, by effect, then in order of text.
 * A symbol of several stages stands once. */
PLR_API size_t plr_program_symbol_count(const plr_program *program);
PLR_API const plr_symbol *plr_program_symbol(const plr_program *program, size_t index);

/* A plug that stands in the program's input (active text), for listings. */
typedef struct plr_plug_info {
    const char *name;
    const char *parameters; /* the argument lists as written: "(c, tex, coord) (c, coord)" */
    plr_stage stage;
    size_t effect; /* that offers it, or PLR_NO_EFFECT */
    plr_place place;
    size_t call_count; /* socket calls in its place */
} plr_plug_info;

PLR_API size_t plr_program_plug_count(const plr_program *program);
PLR_API const plr_plug_info *plr_program_plug(const plr_program *program, size_t index);
/* The effect called by the call-th socket call of that plug, and the place of its function. */
PLR_API size_t plr_program_plug_call(const plr_program *program, size_t plug, size_t call,
                                     plr_place *function);

typedef enum plr_promise_kind {
    PLR_COLOUR_ONLY,
    PLR_KEEPS_TRANSPARENT,
    PLR_LIPSCHITZ,
    PLR_PROMISE_KINDS
} plr_promise_kind;

/* Where the comment stands by which the unit of the function that is called there promises that;
 * false: it does not. */
PLR_API bool plr_program_promise_place(const plr_program *program, size_t plug, size_t call,
                                       plr_promise_kind kind, plr_place *place);

/* A call that the program makes. */
typedef struct plr_call_info {
    size_t plug;        /* at which: index of plr_program_plug */
    size_t effect;      /* whose function it is */
    unsigned depth;     /* 0: made by the base; 1: within the function of a call of depth 0; ... */
    plr_place function; /* the name of the function */
} plr_call_info;

/* The calls in the order in which the program comes to them, stage after stage, from main() on;
 * what a function calls follows its call, at the first of its calls alone. Plugs that the program
 * does not reach have no calls here. Writes up to `capacity` of them and returns how many there
 * are; 0 without memory. */
PLR_API size_t plr_program_calls(const plr_program *program, plr_call_info *calls, size_t capacity);

/* A place in the program where a member of a struct is named. */
typedef struct plr_member_use {
    plr_mapped at; /* of the name behind the dot; of an argument at a plug: the plug, and the effect
                      that offers it */
    bool written;  /* the member, or a part of it, is assigned to; else its value is used */
} plr_member_use;

/* Where a stage names a member: `.name`, in order of text, whatever the struct. Writes up to
 * `capacity` of the places and returns how many there are. */
PLR_API size_t plr_program_member_uses(const plr_program *program, plr_stage stage,
                                       const char *name, plr_member_use *uses, size_t capacity);

#ifdef __cplusplus
}
#endif
#endif
