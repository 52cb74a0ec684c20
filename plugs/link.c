/* plr_link: rounds until nothing new is asked for, then the texts. */
#include <string.h>

#include "plugs/program.h"

#define MAX_TEXT ((size_t)64 << 20)
#define MAX_EFFECTS ((size_t)65536)
#define MAX_ROUNDS 32

/* ---- Limits ------------------------------------------------------------------------------------
 */

static size_t add_lengths(const plr_source *const *sources, size_t count, size_t total) {
    for (size_t i = 0; i < count; i++)
        if (sources[i])
            total += sources[i]->length;
    return total;
}

static bool within_limits(const plr_link_desc *desc, plr_diags *diags) {
    plr_place place = {NULL, 0, 0};
    size_t most_text = desc->max_text ? desc->max_text : MAX_TEXT;
    size_t most_effects = desc->max_effects ? desc->max_effects : MAX_EFFECTS;
    if (most_effects > (size_t)1 << 24)
        most_effects = (size_t)1 << 24;
    size_t text = add_lengths(desc->base, desc->base_count, 0);
    text = add_lengths(desc->library, desc->library_count, text);
    for (size_t e = 0; e < desc->effect_count && text <= most_text; e++)
        text = add_lengths(desc->effects[e].sources, desc->effects[e].source_count, text);
    if (desc->effect_count > most_effects) {
        plr_diags_add(diags, PLR_CODE_LIMIT, place, "%zu effects are more than the limit of %zu",
                      desc->effect_count, most_effects);
        return false;
    }
    if (text > most_text) {
        plr_diags_add(diags, PLR_CODE_LIMIT, place,
                      "the shaders are larger than the limit of %zu bytes", most_text);
        return false;
    }
    return true;
}

/* ---- Rounds ------------------------------------------------------------------------------------
 */

/* Which members and plugs conditionals ask for. */
static void note_questions(plr_linking *l) {
    for (size_t r = 0; l->readings.keys && r <= l->readings.mask; r++) {
        const plr_reading *reading = l->readings.keys[r] ? l->readings.values[r] : NULL;
        if (!reading || !reading->source->lexed.dynamic)
            continue;
        const plr_lexed *lexed = &reading->source->lexed;
        for (size_t i = 0; i < lexed->plugs.count; i++)
            l->offered[reading->gids[lexed->plugs.items[i].name]] = 1;
        for (size_t i = 0; i + 2 < lexed->tokens.count; i++) {
            const plr_token *token = &lexed->tokens.items[i];
            if (token->kind != PLR_T_IDENT)
                continue;
            uint16_t word = lexed->idents.items[token->value].word;
            const plr_token *name = token + 1 + (token[1].kind == '(');
            if ((word == PLR_WORD_READS || word == PLR_WORD_PLUG_USED) && name->kind == PLR_T_IDENT)
                l->asked[reading->gids[name->value]] |=
                    word == PLR_WORD_READS ? PLR_ASKED_READS : PLR_ASKED_USED;
        }
        l->dynamic = true;
    }
}

static void note_members(plr_linking *l) {
    for (size_t e = 0; e < l->desc->effect_count; e++)
        for (size_t s = 0; s < l->desc->effects[e].source_count; s++) {
            const plr_source *source = l->desc->effects[e].sources[s];
            const plr_reading *reading =
                source ? plr_table_get(&l->readings, (uint64_t)(uintptr_t)source) : NULL;
            for (size_t i = 0; reading && i < source->lexed.idents.count; i++)
                if (source->lexed.idents.items[i].flags & PLR_IF_MEMBER)
                    l->members[reading->gids[i]] = 1;
        }
}

static void start_round(plr_linking *l, plr_arena *pass) {
    size_t idents = l->idents.count + 1, effects = (size_t)l->effect_count + 1;
    plr_linking fresh = {.desc = l->desc,
                         .arena = l->arena,
                         .pass = pass,
                         .effect_count = l->effect_count,
                         .slots = l->slots,
                         .slot_mask = l->slot_mask,
                         .readings = l->readings,
                         .hosts = l->hosts,
                         .host_capacity = l->host_capacity,
                         .used = l->used,
                         .reads = l->reads,
                         .offered = l->offered,
                         .asked = l->asked,
                         .members = l->members,
                         .unfit = l->unfit,
                         .restarts = l->restarts,
                         .dynamic = l->dynamic,
                         .all = l->all,
                         .names = l->names,
                         .targets = l->targets,
                         .placements = l->placements,
                         .targets_of = l->targets_of,
                         .no_geometry = l->no_geometry,
                         .main_effect = PLR_NONE,
                         .version = l->version};
    memcpy(&fresh.idents, &l->idents, sizeof fresh.idents);
    *l = fresh;
    l->macros = PLR_NEW_ARRAY(pass, idents, plr_macro *);
    l->faulty = PLR_NEW_ARRAY(pass, effects, bool);
    l->left_out = PLR_NEW_ARRAY(pass, effects, bool);
    l->active = PLR_NEW_ARRAY(pass, effects, bool);
    l->provider_of = PLR_NEW_ARRAY(pass, effects, uint32_t);
    l->lost_from = PLR_NEW_ARRAY(pass, effects, uint32_t);
    l->said = PLR_NEW_ARRAY(pass, effects, size_t);
    l->said_end = PLR_NEW_ARRAY(pass, effects, size_t);
}

static void prepare(plr_linking *l, plr_arena *pass) {
    plr_read_all(l);
    plr_note_targets(l);
    l->pass = pass;
    l->no_geometry = !plr_wants_geometry(l);
    plr_make_stages(l);
    plr_decide_version(l);
    plr_set_hosts(l);
    size_t idents = l->idents.count + 1;
    l->used = PLR_NEW_ARRAY(l->arena, idents, uint8_t);
    l->reads = PLR_NEW_ARRAY(l->arena, idents, uint8_t);
    l->offered = PLR_NEW_ARRAY(l->arena, idents, uint8_t);
    l->asked = PLR_NEW_ARRAY(l->arena, idents, uint8_t);
    l->members = PLR_NEW_ARRAY(l->arena, idents, uint8_t);
    l->unfit = PLR_NEW_ARRAY(l->arena, (size_t)l->effect_count + 1, plr_unfit *);
    note_questions(l);
    note_members(l);
}

static void next_pass(plr_program *program) {
    jmp_buf *out_of_memory = program->pass.out_of_memory;
    plr_arena_finish(&program->pass);
    plr_arena_init(&program->pass, &program->allocator, out_of_memory);
}

#define MAX_RESTARTS 64

/* Begins anew where something is to be left out: what it asked for is asked no more. */
static bool restart(plr_program *program) {
    plr_linking *l = &program->linking;
    if (!l->again || l->restarts >= MAX_RESTARTS)
        return false;
    l->restarts++;
    l->used = PLR_NEW_ARRAY(l->arena, l->idents.count + 1, uint8_t);
    l->reads = PLR_NEW_ARRAY(l->arena, l->idents.count + 1, uint8_t);
    next_pass(program);
    return true;
}

static void run_rounds(plr_program *program) {
    plr_linking *l = &program->linking;
    bool sure = false; /* of the version: lines in inactive text ask for nothing */
    for (unsigned round = 0;; round++) {
        start_round(l, &program->pass);
        l->all = round >= MAX_ROUNDS;
        plr_make_stages(l);
        plr_make_units(l);
        plr_add_effects(l);
        plr_say_versions(l);
        if (l->base_fault)
            return;
        if (l->stages & 1u << PLR_GEOMETRY && !plr_entry(l, PLR_GEOMETRY)) {
            l->no_geometry = true;
            plr_keep_faults(l, PLR_GEOMETRY);
            plr_set_hosts(l);
            l->again = true;
        }
        if (restart(program)) {
            round = 0;
            continue;
        }
        if (!sure && plr_lower_version(l)) {
            sure = true;
            next_pass(program);
            continue;
        }
        sure = true;
        plr_reach(l);
        if (restart(program)) {
            round = 0;
            continue;
        }
        if (l->dynamic && l->grown && !l->all) {
            next_pass(program);
            continue;
        }
        if (l->placements)
            plr_leave_inactive(l);
        if (!l->again)
            plr_pass_varyings(l);
        if (!restart(program))
            return;
        round = 0;
    }
}

/* ---- Results -----------------------------------------------------------------------------------
 */

static void collect_units(plr_program *program) {
    plr_linking *l = &program->linking;
    program->units = PLR_NEW_ARRAY(&program->arena, (size_t)l->unit_count + 1, const plr_unit *);
    for (unsigned s = 0; s < PLR_STAGE_COUNT; s++)
        for (uint32_t e = 0; e < l->effect_count + 3; e++) {
            const plr_scope *scope = plr_scope_of(l, (plr_stage)s, e);
            for (uint32_t u = 0; u < scope->unit_count; u++)
                program->units[scope->units[u].number] = &scope->units[u];
        }
}

static void find_lines(plr_arena *arena, plr_composed *stage) {
    PLR_LIST(uint32_t) lines = {NULL, 0, 0};
    const char *at = stage->text, *end = at + stage->length;
    lines.items =
        plr_arena_grow(arena, NULL, &lines.capacity, stage->length / 24 + 8, sizeof *lines.items);
    while (at < end) {
        *PLR_PUSH(arena, &lines) = (uint32_t)(at - stage->text);
        const char *newline = memchr(at, '\n', (size_t)(end - at));
        at = newline ? newline + 1 : end;
    }
    stage->lines = lines.items;
    stage->line_count = (uint32_t)lines.count;
}

static void compose_stage(plr_program *program, plr_stage stage) {
    plr_linking *l = &program->linking;
    plr_printer printer = {.l = l};
    size_t size = 4096;
    const plr_scope *base = plr_scope_of(l, stage, PLR_SCOPE_BASE(l));
    for (uint32_t u = 0; u < base->unit_count; u++)
        size += base->units[u].lexed->length;
    printer.out.items = plr_arena_grow(&program->arena, NULL, &printer.out.capacity, size, 1);
    plr_compose(l, stage, &printer);
    char *end = PLR_PUSH(&program->arena, &printer.out);
    *end = '\0';
    plr_composed *text = &program->stages[stage];
    *text = (plr_composed){.text = printer.out.items,
                           .length = printer.out.count - 1,
                           .runs = printer.runs.items,
                           .run_count = printer.runs.count,
                           .calls = printer.calls.items};
    find_lines(&program->arena, text);
}

static void list_plugs(plr_program *program) {
    plr_linking *l = &program->linking;
    for (size_t i = 0; i < l->sockets.count; i++) {
        const plr_socket *socket = l->sockets.items[i];
        const plr_plug *plug = socket->plug;
        const plr_unit *unit = socket->unit;
        bool owned = socket->effect < l->effect_count;
        *PLR_PUSH(&program->arena, &program->plugs) = (plr_plug_info){
            .name = plr_arena_copy(&program->arena, unit->lexed->idents.items[plug->name].text,
                                   unit->lexed->idents.items[plug->name].length),
            .parameters = plr_arena_copy(&program->arena, unit->lexed->text + plug->text_begin,
                                         plug->text_end - plug->text_begin),
            .stage = unit->scope->stage,
            .effect = owned ? socket->effect : PLR_NO_EFFECT,
            .place = plr_unit_place(unit, plug->offset),
            .call_count = socket->calls.count};
    }
}

static void report(const plr_linking *l, plr_diags *diags) {
    for (size_t i = 0; i < l->messages.count; i++) {
        const plr_message *message = &l->messages.items[i];
        plr_diags_add_as(diags, message->severity, message->code, message->place, "%s",
                         message->text);
    }
}

static bool link_program(plr_program *program, plr_diags *diags) {
    jmp_buf out_of_memory;
    program->arena.out_of_memory = program->pass.out_of_memory = &out_of_memory;
    if (setjmp(out_of_memory)) {
        plr_diags_add(diags, PLR_CODE_NO_MEMORY, (plr_place){NULL, 0, 0}, "no memory to link");
        return false;
    }
    plr_linking *l = &program->linking;
    prepare(l, &program->pass);
    run_rounds(program);
    if (!l->base_fault) {
        plr_say_stages(l);
        for (unsigned s = 0; s < PLR_STAGE_COUNT; s++)
            if (l->stages & 1u << s)
                compose_stage(program, (plr_stage)s);
        collect_units(program);
        list_plugs(program);
        plr_list_symbols(program);
    }
    report(l, diags);
    return !l->base_fault;
}

plr_program *plr_link(const plr_link_desc *desc, plr_diags *diags) {
    if (!within_limits(desc, diags))
        return NULL;
    plr_allocator allocator = plr_allocator_resolve(desc->allocator);
    plr_program *program = allocator.reallocate(allocator.user, NULL, sizeof *program);
    if (!program) {
        plr_diags_add(diags, PLR_CODE_NO_MEMORY, (plr_place){NULL, 0, 0}, "no memory to link");
        return NULL;
    }
    memset(program, 0, sizeof *program);
    program->allocator = allocator;
    plr_arena_init(&program->arena, &allocator, NULL);
    plr_arena_init(&program->pass, &allocator, NULL);
    program->linking = (plr_linking){.desc = desc,
                                     .arena = &program->arena,
                                     .pass = &program->pass,
                                     .effect_count = (uint32_t)desc->effect_count};
    if (!link_program(program, diags))
        plr_program_destroy(&program);
    else
        program->linking.desc = NULL; /* which may not outlive this call */
    return program;
}

void plr_program_destroy(plr_program **program) {
    plr_program *p = *program;
    if (!p)
        return;
    plr_allocator allocator = p->allocator;
    plr_arena_finish(&p->pass);
    plr_arena_finish(&p->arena);
    allocator.release(allocator.user, p);
    *program = NULL;
}
