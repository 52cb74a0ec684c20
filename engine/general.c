#include "engine/general.h"

#include "engine/frame.h"
#include "engine/pilot.h"
#include "engine/state.h"
#include "engine/update.h"

/* ---- In recipes ---- */

static bool has_authors(const plr_node *node) {
    const plr_field *effects = node ? plr_node_field(node, "effects") : NULL;
    return effects && effects->count;
}

bool plr_general_has(const plr_view *view, bool off, const plr_node *node) {
    return !off || (view->general && !has_authors(node));
}

void plr_general_hide(plr_view *view, plr_recipe *recipe, bool hidden, size_t volume,
                      size_t attached) {
    if (view->general)
        plr_recipe_builtin(&view->kitchen, recipe, "volume/Hidden", "Hidden",
                           (plr_binding){.volume = volume, .gated = true, .closed = !hidden},
                           attached, NULL, 0);
}

size_t plr_general_spares(plr_view *view, plr_slot_kind kind, size_t count) {
    if (!view->general)
        return 0;
    size_t *most = &view->general_state.most[kind], slots = view->general_state.slots[kind];
    *most = count > *most ? count : *most;
    return slots > count ? slots - count : 0;
}

/* Room for one more of each kind; whether there was less. */
static bool make_room(plr_view *view) {
    bool grown = false;
    for (size_t kind = 0; kind < PLR_SLOT_KINDS; kind++) {
        size_t *slots = &view->general_state.slots[kind], most = view->general_state.most[kind];
        grown = grown || *slots <= most;
        *slots = *slots <= most ? most + 1 : *slots;
        view->general_state.most[kind] = 0;
    }
    return grown;
}

/* ---- Worlds ---- */

static bool is_interactive(const plr_view *view) {
    return view->desc.interactive && view->engine && view->composer.builder;
}

/* A world of one kind of programs; false: some of them lack, and nothing of it can be drawn. What
 * `defers` lets the builder compile what lacks. */
static bool make(plr_view *view, bool general, bool defers, plr_diags *diags) {
    view->general = general;
    view->composer.defers = defers;
    plr_view_remake(view, &view->eye_to_world, diags);
    view->composer.defers = false;
    return view->composer.waiting + view->composer.refused == 0;
}

/* A number of the programs that the world draws with, and of the nodes that others are made of. */
static uint64_t class_of(const plr_view *view) {
    uint64_t hash = plr_scene_node_count(view->scene);
    plr_drawable drawable;
    for (size_t i = 0; plr_view_drawable(view, i, &drawable); i++)
        hash = (hash ^ (uintptr_t)drawable.program) * UINT64_C(0x9e3779b97f4a7c15);
    return hash;
}

/* What is said of the specialised world, before it is known whether it can be had. */
static void say(const plr_diags *said, plr_diags *diags) {
    for (size_t i = 0; i < plr_diags_count(said); i++) {
        const plr_diag *one = plr_diags_get(said, i);
        plr_diags_add_as(diags, one->severity, one->code, one->place, "%s", one->message);
    }
}

void plr_general_remake(plr_view *view, plr_diags *diags) {
    size_t before = is_interactive(view) ? plr_cache_get_stats(view->engine->cache).compiled : 0;
    if (!is_interactive(view)) {
        make(view, false, false, diags);
        return;
    }
    plr_diags *said = plr_diags_create(NULL);
    bool had = make(view, false, true, said) || make(view, true, true, NULL);
    if (had)
        say(said, diags);
    else
        make(view, false, false, diags);
    plr_diags_destroy(&said);
    if (!view->general && class_of(view) != view->general_state.of)
        view->general_state.known = view->general_state.asked = false;
    view->stats.built = plr_cache_get_stats(view->engine->cache).compiled - before;
}

/* The specialised world where it can be had, else the general one that was there before. */
static void go_back(plr_view *view) {
    if (!make(view, false, true, NULL) && !make(view, true, true, NULL))
        make(view, false, false, NULL);
}

/* Drivers compile for good when something is drawn: here nothing is, with all that will be. */
static void warm(plr_view *view) {
    const plr_gl *gl = &view->engine->gl;
    plr_gl_state state;
    if (!view->framebuffer.name)
        return;
    plr_gl_state_save(gl, &state);
    GLint box[4];
    gl->GetIntegerv(GL_SCISSOR_BOX, box);
    gl->Enable(GL_SCISSOR_TEST);
    gl->Scissor(0, 0, 0, 0);
    plr_view_draw_again(view);
    gl->Scissor(box[0], box[1], box[2], box[3]);
    plr_gl_state_restore(gl, &state);
    gl->Finish();
}

/* ---- Building beside ---- */

static bool has_tables(const plr_view *view) {
    for (size_t i = 0; i < view->volumes.count; i++)
        if (view->volumes.volumes[i].table)
            return true;
    return false;
}

/* Makes a general world, to have its programs; false: some are being built. */
static bool look_at_general(plr_view *view) {
    bool whole = make(view, true, true, NULL);
    if (make_room(view))
        whole = make(view, true, true, NULL);
    if (whole)
        warm(view);
    return !view->composer.waiting;
}

/* The general programs, before they are needed: asked for, and taken over once they are built. One
 * that does not compile leaves edits waiting for specialised ones. Transfer functions that have a
 * table may be edited into such as have none. */
static void prepare_general(plr_view *view) {
    view->general_state.known = look_at_general(view);
    if (has_tables(view)) {
        view->general_state.no_tables = true;
        view->general_state.known = look_at_general(view) && view->general_state.known;
        view->general_state.no_tables = false;
    }
    view->general_state.asked = true;
    go_back(view);
}

static size_t build(plr_view *view, double wait_ms) {
    if (!view->general_state.asked)
        prepare_general(view);
    view->general_state.of = class_of(view);
    size_t left = plr_builder_wait(view->composer.builder, wait_ms);
    if (left)
        return left;
    if (!view->general_state.known)
        prepare_general(view);
    else if (view->general)
        go_back(view);
    else
        return 0;
    view->general_state.of = class_of(view);
    if (!view->general)
        warm(view);
    return plr_builder_waiting(view->composer.builder);
}

size_t plr_view_build(plr_view *view, double wait_ms) {
    jmp_buf out_of_memory;
    volatile size_t left = 0;
    /* what was edited since is for plr_view_update */
    if (!is_interactive(view) || plr_scene_revision(view->scene) != view->revision)
        return 0;
    view->arena.out_of_memory = view->lasting.out_of_memory = &out_of_memory;
    if (setjmp(out_of_memory) == 0)
        left = build(view, wait_ms);
    else
        left = SIZE_MAX;
    if (!left)
        plr_pilot_rest(view);
    return left;
}
