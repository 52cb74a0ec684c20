/* Whether effects do what their authors promise: their functions are asked what they make of many
 * samples, each effect alone, with the uniforms that the scene gives it. */
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "engine/frame.h"
#include "engine/state.h"
#include "engine/targets.h"
#include "engine/volume_pass.h"

enum {
    SIDE = 192, /* of a square of trials */
    TRIALS = SIDE * SIDE
};

/* What a trial is asked, as in effects/volume/Trial.glsl: of either of two samples. */
typedef enum quantity {
    QUANTITY_COLOR,
    QUANTITY_VALUE,
    QUANTITY_PLACE,
    QUANTITY_CLASSIFIED,
    QUANTITY_SHADED,
    QUANTITIES
} quantity;

/* The plugs whose functions promises are about. */
static const struct {
    const char *name;
    quantity result;
} plugs[] = {{"volume_classify", QUANTITY_CLASSIFIED}, {"volume_shade", QUANTITY_SHADED}};

enum {
    PLUG_COUNT = sizeof plugs / sizeof *plugs
};

typedef float texel[4];

/* What is looked at, and what has been. */
typedef struct inspector {
    plr_view *view;
    plr_diags *diags;
    plr_framebuffer framebuffer;
    texel *answers[QUANTITIES][2]; /* TRIALS each; the first one owns them all */
    struct {
        struct {
            const plr_node *node;
            size_t volume; /* or PLR_NO_EFFECT: of a surface */
        } * items;
        size_t count, capacity;
    } seen;
} inspector;

/* One effect on one volume. */
typedef struct trial {
    inspector *in;
    const plr_volume_state *volume;
    plr_pass pass;
    plr_program *linked; /* with the effect's own places */
    size_t effect;
    plr_promises promises;
    bool broken[PLR_PROMISE_KINDS]; /* as was told */
    /* at hand: */
    size_t plug, calls;
    quantity result;
    size_t socket;
} trial;

/* ---- The program ---- */

static size_t add_volume(plr_view *view, plr_recipe *recipe, const plr_volume_state *state) {
    const plr_define defines[] = {
        {"voxels_COMPONENTS",
         plr_arena_format(&view->arena, "%u", state->grid->voxels->components)},
        {"HAS_LABELS", state->labels ? "1" : "0"},
        {"BRICKED", state->grid->brick_sides[0] ? "1" : "0"}};
    plr_define *extra = PLR_NEW_ARRAY(&view->arena, sizeof defines / sizeof *defines, plr_define);
    memcpy(extra, defines, sizeof defines);
    return plr_recipe_builtin(&view->kitchen, recipe, "volume/grid volume/Trial",
                              plr_node_type(state->node),
                              (plr_binding){.node = state->node,
                                            .to_world = state->to_world,
                                            .place = &state->to_world,
                                            .volume = state->index,
                                            .grid = state->grid},
                              0, extra, sizeof defines / sizeof *defines);
}

/* The recipe that tries effect `e` of another recipe, wherever it stands there. */
static void write_recipe(trial *t, const plr_recipe *from, size_t e) {
    plr_view *view = t->in->view;
    plr_recipe *recipe = &t->pass.recipe;
    *recipe = (plr_recipe){.base = *plr_catalog_units(view->kitchen.catalog, "general/trust"),
                           .casts_rays = true};
    plr_recipe_define(&view->kitchen, recipe, "CASTLE_GLSL_VERSION_UPGRADE", 1);
    plr_effect effect = from->effects.items[e];
    plr_binding binding = from->bindings.items[e];
    effect.attached = add_volume(view, recipe, t->volume);
    effect.only_attached = effect.only_if_active = false;
    effect.placement = PLR_ADD_AFTER;
    effect.target = NULL;
    binding.volume = t->volume->index;
    t->effect = recipe->effects.count;
    *PLR_PUSH(&view->arena, &recipe->effects) = effect;
    *PLR_PUSH(&view->arena, &recipe->bindings) = binding;
}

static void say_untested(const trial *t, const char *why) {
    const plr_effect *effect = &t->pass.recipe.effects.items[t->effect];
    plr_diags_add_as(t->in->diags, PLR_INFO, PLR_CODE_PROMISE, effect->place,
                     "the promises of effect \"%s\" are not tested: %s", effect->name, why);
}

/* Compiles it; false: it cannot be tried (reported). */
static bool build(trial *t) {
    plr_view *view = t->in->view;
    t->pass.built =
        plr_compose_program(&view->composer, &t->pass.recipe, "trust", &t->pass.program);
    if (!t->pass.built || t->pass.recipe.effects.items[t->effect].disabled) {
        say_untested(t, "it needs what is there along a ray alone");
        return false;
    }
    plr_pass_find(view, &t->pass);
    plr_textures_upload(&view->textures);
    return true;
}

/* ---- Drawing ---- */

static GLint find_quantity(const trial *t) {
    const plr_gl *gl = &t->in->view->engine->gl;
    for (size_t i = 0; i < plr_program_symbol_count(t->pass.program); i++) {
        const plr_symbol *symbol = plr_program_symbol(t->pass.program, i);
        if (symbol->effect == PLR_NO_EFFECT && strcmp(symbol->name, "quantity") == 0)
            return gl->GetUniformLocation(t->pass.built->name, symbol->program);
    }
    return -1;
}

/* Draws the answers of the functions at one plug. */
static void ask(const trial *t) {
    plr_view *view = t->in->view;
    const plr_gl *gl = &view->engine->gl;
    plr_frame frame;
    plr_frame_plan(view, view->viewpoint, SIDE, SIDE, false, &frame);
    plr_values values = {.frame = &frame,
                         .view = view,
                         .to_world = t->volume->to_world,
                         .volumes = view->volumes.volumes,
                         .volume_count = view->volumes.count,
                         .functions = view->volumes.functions.texture};
    static const GLenum off[] = {GL_BLEND, GL_DEPTH_TEST, GL_CULL_FACE, GL_SCISSOR_TEST};
    for (size_t i = 0; i < sizeof off / sizeof *off; i++)
        gl->Disable(off[i]);
    gl->ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl->DepthMask(GL_FALSE);
    plr_framebuffer_bind(&t->in->framebuffer);
    gl->UseProgram(t->pass.built->name);
    plr_bind_set(gl, &view->textures, &t->pass.slots, &values);
    gl->BindVertexArray(view->empty_vertex_array);
    GLint location = find_quantity(t);
    for (int q = 0; q < 2 * QUANTITIES; q++) {
        bool second = q & 1;
        bool other = q / 2 >= QUANTITY_CLASSIFIED && q / 2 != (int)t->result;
        if (other || (second && t->promises.lipschitz <= 0))
            continue;
        gl->Uniform1i(location, q);
        gl->DrawArrays(GL_TRIANGLES, 0, 3);
        plr_framebuffer_read(&t->in->framebuffer, t->in->answers[q / 2][second][0]);
    }
}

/* ---- Judging ---- */

static bool is_finite(const texel x) {
    return isfinite(x[0]) && isfinite(x[1]) && isfinite(x[2]) && isfinite(x[3]);
}

/* The greatest difference of two texels, in the first `count` components. */
static double difference(const texel a, const texel b, int count) {
    double most = 0;
    for (int i = 0; i < count; i++)
        most = fmax(most, fabs((double)a[i] - (double)b[i]));
    return most;
}

/* How much a trial breaks a promise; 0: not at all, infinite: no numbers come out. */
static double alpha_fault(const trial *t, plr_promise_kind kind, size_t n) {
    const float *color = t->in->answers[QUANTITY_COLOR][0][n];
    const float *result = t->in->answers[t->result][0][n];
    const double rounding = 1e-6;
    double changed = fabs((double)result[3] - (double)color[3]);
    if (kind == PLR_KEEPS_TRANSPARENT && color[3] != 0)
        return 0;
    if (!is_finite(result))
        return INFINITY;
    return changed > (kind == PLR_COLOUR_ONLY ? rounding : 0) ? changed : 0;
}

static void premultiply(const texel straight, texel result) {
    for (int i = 0; i < 3; i++)
        result[i] = straight[i] * straight[3];
    result[3] = straight[3];
}

static double change_before(const trial *t, size_t n) {
    texel *(*a)[2] = t->in->answers;
    return fmax(difference(a[QUANTITY_COLOR][0][n], a[QUANTITY_COLOR][1][n], 4),
                difference(a[QUANTITY_VALUE][0][n], a[QUANTITY_VALUE][1][n], 4));
}

static double change_after(const trial *t, size_t n) {
    texel first, second;
    premultiply(t->in->answers[t->result][0][n], first);
    premultiply(t->in->answers[t->result][1][n], second);
    return difference(first, second, 4);
}

static double lipschitz_fault(const trial *t, size_t n) {
    const float *first = t->in->answers[t->result][0][n];
    const float *second = t->in->answers[t->result][1][n];
    const double slack = 1e-3, rounding = 2e-6;
    if (!is_finite(first) || !is_finite(second))
        return INFINITY;
    double size = 1;
    for (int i = 0; i < 4; i++)
        size = fmax(size, fmax(fabs((double)first[i]), fabs((double)second[i])));
    double before = change_before(t, n), after = change_after(t, n);
    double bound = pow(t->promises.lipschitz, (double)t->calls) * (1 + slack);
    return before > 0 && after > bound * before + rounding * size * size ? after / before : 0;
}

/* The trial that breaks it most; TRIALS: none does. */
static size_t find_worst(const trial *t, plr_promise_kind kind) {
    size_t worst = TRIALS;
    double most = 0;
    for (size_t n = 0; n < TRIALS; n++) {
        double fault = kind == PLR_LIPSCHITZ ? lipschitz_fault(t, n) : alpha_fault(t, kind, n);
        if (fault > most) {
            most = fault;
            worst = n;
        }
    }
    return worst;
}

/* ---- Telling ---- */

static const char *const kind_names[] = {[PLR_COLOUR_ONLY] = "colour-only",
                                         [PLR_KEEPS_TRANSPARENT] = "keeps-transparent",
                                         [PLR_LIPSCHITZ] = "lipschitz"};

typedef struct words {
    char text[96];
} words;

static words say_numbers(const texel x, int count) {
    words w;
    int at = 0;
    for (int i = 0; i < count; i++)
        at += snprintf(w.text + at, sizeof w.text - (size_t)at, i ? " %.6g" : "%.6g", (double)x[i]);
    return w;
}

/* Where the unit says it whose function is called first; that of the effect, where it does not. */
static plr_place place_of(const trial *t, plr_promise_kind kind) {
    plr_place place = t->pass.recipe.effects.items[t->effect].place;
    for (size_t call = 0; call < t->calls; call++)
        if (plr_program_promise_place(t->linked, t->socket, call, kind, &place))
            break;
    return place;
}

static void say_alpha(const trial *t, plr_promise_kind kind, size_t n) {
    texel *(*a)[2] = t->in->answers;
    int components = (int)t->volume->grid->voxels->components;
    const float *color = a[QUANTITY_COLOR][0][n], *result = a[t->result][0][n];
    words value = say_numbers(a[QUANTITY_VALUE][0][n], components);
    words place = say_numbers(a[QUANTITY_PLACE][0][n], 3);
    if (is_finite(result))
        plr_diags_add(t->in->diags, PLR_CODE_BROKEN_PROMISE, place_of(t, kind),
                      "%s is broken: alpha %.6g becomes %.6g at value %s (at %s, colour %s, place "
                      "%s)",
                      kind_names[kind], (double)color[3], (double)result[3], value.text,
                      plugs[t->plug].name, say_numbers(color, 3).text, place.text);
    else
        plr_diags_add(t->in->diags, PLR_CODE_BROKEN_PROMISE, place_of(t, kind),
                      "%s is broken: colour %s becomes %s at value %s (at %s, place %s)",
                      kind_names[kind], say_numbers(color, 4).text, say_numbers(result, 4).text,
                      value.text, plugs[t->plug].name, place.text);
}

static void say_lipschitz(const trial *t, size_t n) {
    texel *(*a)[2] = t->in->answers;
    int components = (int)t->volume->grid->voxels->components;
    words before[2], value[2], after[2];
    for (int i = 0; i < 2; i++) {
        before[i] = say_numbers(a[QUANTITY_COLOR][i][n], 4);
        value[i] = say_numbers(a[QUANTITY_VALUE][i][n], components);
        after[i] = say_numbers(a[t->result][i][n], 4);
    }
    plr_diags_add(t->in->diags, PLR_CODE_BROKEN_PROMISE, place_of(t, PLR_LIPSCHITZ),
                  "lipschitz %.6g is broken: colour %s at value %s becomes %s, and %s at value %s "
                  "becomes %s: %.6g times as far apart (at %s, place %s)",
                  t->promises.lipschitz, before[0].text, value[0].text, after[0].text,
                  before[1].text, value[1].text, after[1].text,
                  change_after(t, n) / change_before(t, n), plugs[t->plug].name,
                  say_numbers(a[QUANTITY_PLACE][0][n], 3).text);
}

/* ---- Effects ---- */

/* Looks for the calls of the effect at a plug; false: there are none. */
static bool find_calls(trial *t, size_t plug) {
    t->plug = plug;
    t->result = plugs[plug].result;
    for (size_t i = 0; i < plr_program_plug_count(t->linked); i++) {
        const plr_plug_info *info = plr_program_plug(t->linked, i);
        if (strcmp(info->name, plugs[plug].name) == 0 && info->call_count &&
            plr_program_plug_call(t->linked, i, 0, NULL) == t->effect) {
            t->socket = i;
            t->calls = info->call_count;
            return true;
        }
    }
    return false;
}

/* Colour-only has it that what is clear stays so: that is not said twice. */
static void judge(trial *t) {
    const bool made[] = {[PLR_COLOUR_ONLY] = t->promises.colour_only,
                         [PLR_KEEPS_TRANSPARENT] =
                             t->promises.keeps_transparent && !t->promises.colour_only,
                         [PLR_LIPSCHITZ] = t->promises.lipschitz > 0};
    for (int k = 0; k < PLR_PROMISE_KINDS; k++) {
        plr_promise_kind kind = (plr_promise_kind)k;
        size_t worst = made[kind] && !t->broken[kind] ? find_worst(t, kind) : TRIALS;
        if (worst == TRIALS)
            continue;
        t->broken[kind] = true;
        if (kind == PLR_LIPSCHITZ)
            say_lipschitz(t, worst);
        else
            say_alpha(t, kind, worst);
    }
}

/* With the voxels that are at hand: all, or a brick of them. */
static void ask_and_judge(void *user) {
    ask(user);
    judge(user);
}

static void try_calls(trial *t) {
    bool called = false, built = false;
    for (size_t plug = 0; plug < PLUG_COUNT; plug++) {
        if (!find_calls(t, plug))
            continue;
        if (!built && !build(t))
            return;
        called = built = true;
        if (!t->volume->grid->brick_sides[0]) {
            ask_and_judge(t);
            continue;
        }
        plr_frame frame;
        plr_frame_plan(t->in->view, t->in->view->viewpoint, SIDE, SIDE, false, &frame);
        plr_bricks_cast(t->in->view, t->volume, &frame, ask_and_judge, t);
    }
    if (!called)
        say_untested(t, "it has no function at volume_classify or volume_shade");
}

static void try_effect(inspector *in, const plr_recipe *recipe, size_t e, size_t volume) {
    trial t = {.in = in, .volume = &in->view->volumes.volumes[volume]};
    write_recipe(&t, recipe, e);
    t.linked = plr_link_recipe(&in->view->composer, &t.pass.recipe, false, NULL);
    if (t.linked)
        t.promises = plr_program_promises(t.linked, t.effect);
    if (t.promises.keeps_transparent || t.promises.lipschitz > 0)
        try_calls(&t);
    plr_program_destroy(&t.linked);
}

/* Whether an effect of a recipe is an author's that was not met there yet. */
static bool is_new(inspector *in, const plr_recipe *recipe, size_t e, size_t volume) {
    const plr_effect *effect = &recipe->effects.items[e];
    const plr_node *node = recipe->bindings.items[e].node;
    if (effect->builtin || effect->disabled || !node)
        return false;
    for (size_t i = 0; i < in->seen.count; i++)
        if (in->seen.items[i].node == node && in->seen.items[i].volume == volume)
            return false;
    in->seen.items = plr_arena_grow(&in->view->arena, in->seen.items, &in->seen.capacity,
                                    in->seen.count + 1, sizeof *in->seen.items);
    in->seen.items[in->seen.count].node = node;
    in->seen.items[in->seen.count++].volume = volume;
    return true;
}

/* An effect on the whole cast acts on each of its volumes. */
static void try_cast(inspector *in, const plr_cast *cast) {
    const plr_recipe *recipe = &cast->pass.recipe;
    for (size_t e = 0; e < recipe->effects.count; e++)
        for (size_t m = 0; m < cast->count; m++) {
            size_t volume = recipe->bindings.items[e].volume;
            bool whole = volume == PLR_NO_EFFECT;
            if ((whole || volume == cast->members[m]) && is_new(in, recipe, e, cast->members[m]))
                try_effect(in, recipe, e, cast->members[m]);
        }
}

/* Nothing relies on what effects on surfaces promise. */
static void note_surface(inspector *in, const plr_model *model) {
    const plr_recipe *recipe = &model->pass.recipe;
    plr_program *program = NULL;
    for (size_t e = 0; e < recipe->effects.count; e++) {
        if (!is_new(in, recipe, e, PLR_NO_EFFECT))
            continue;
        if (!program)
            program = plr_link_recipe(&in->view->composer, recipe, false, NULL);
        plr_promises promises =
            program ? plr_program_promises(program, e) : (plr_promises){.lipschitz = 0};
        const plr_effect *effect = &recipe->effects.items[e];
        if (promises.keeps_transparent || promises.lipschitz > 0)
            plr_diags_add_as(in->diags, PLR_INFO, PLR_CODE_PROMISE, effect->place,
                             "the promises of effect \"%s\" are not tested on surfaces: nothing "
                             "relies on them there",
                             effect->name);
    }
    plr_program_destroy(&program);
}

/* ---- The whole ---- */

static bool open_inspector(inspector *in) {
    float *all = malloc((size_t)QUANTITIES * 2 * TRIALS * sizeof(texel));
    if (!all)
        longjmp(*in->view->arena.out_of_memory, 1);
    for (int q = 0; q < QUANTITIES; q++)
        for (int i = 0; i < 2; i++)
            in->answers[q][i] = (texel *)all + (size_t)(2 * q + i) * TRIALS;
    return plr_framebuffer_create(&in->framebuffer, &in->view->engine->gl, SIDE, SIDE, in->diags);
}

static void inspect(inspector *in) {
    plr_view *view = in->view;
    plr_targets_draw(view, NULL);
    for (size_t i = 0; i < view->volumes.cast_count; i++)
        try_cast(in, &view->volumes.casts[i]);
    for (size_t i = 0; i < view->model_count; i++)
        note_surface(in, view->models[i]);
}

bool plr_view_check_promises(plr_view *view, plr_diags *diags) {
    jmp_buf out_of_memory;
    plr_gl_state state;
    inspector in = {.view = view, .diags = diags};
    volatile bool fine = false;
    if (!view->engine)
        return false;
    plr_gl_state_save(&view->engine->gl, &state);
    view->arena.out_of_memory = view->lasting.out_of_memory = &out_of_memory;
    if (setjmp(out_of_memory) == 0) {
        fine = open_inspector(&in);
        if (fine)
            inspect(&in);
    } else {
        fine = false;
        plr_diags_add(diags, PLR_CODE_NO_MEMORY, (plr_place){0}, "there is not enough memory");
    }
    plr_framebuffer_destroy(&in.framebuffer);
    free(in.answers[0][0]);
    plr_gl_state_restore(&view->engine->gl, &state);
    return fine;
}
