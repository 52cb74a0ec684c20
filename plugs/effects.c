/* Takes in the base, the library and one effect after the other; leaves the faulty ones out. */
#include "plugs/link.h"

#include <string.h>

static void say_faults(plr_linking *l, const plr_unit *unit, const plr_fault *faults,
                       size_t count) {
    for (size_t i = 0; i < count; i++)
        plr_say(l, faults[i].code, plr_unit_place(unit, faults[i].offset), "%s", faults[i].message);
}

/* Evaluates conditionals and cuts: false if a unit has a fault. */
static bool take_text(plr_linking *l, plr_scope *scope) {
    bool good = true, macros = false;
    for (uint32_t u = 0; u < scope->unit_count; u++)
        macros |= scope->units[u].lexed->conditional;
    if (macros)
        plr_begin_macros(l, scope);
    for (uint32_t u = 0; u < scope->unit_count; u++) {
        plr_unit *unit = &scope->units[u];
        const plr_lexed *lexed = unit->lexed;
        say_faults(l, unit, lexed->warnings.items, lexed->warnings.count);
        if (lexed->faults.count) {
            say_faults(l, unit, lexed->faults.items, lexed->faults.count);
            good = false;
            if (lexed->conditional)
                continue; /* which cannot be evaluated */
        } else if (macros) {
            plr_evaluate(l, unit);
        }
        unit->cut = &unit->reading->source->cut;
        if (lexed->conditional) {
            plr_cut_items(l->pass, lexed, unit->activity, &unit->own_cut);
            unit->cut = &unit->own_cut;
        }
        say_faults(l, unit, unit->cut->warnings.items, unit->cut->warnings.count);
        say_faults(l, unit, unit->cut->faults.items, unit->cut->faults.count);
        good &= unit->cut->faults.count == 0;
    }
    return good;
}

static bool check_effect(plr_linking *l, uint32_t e) {
    const plr_effect *effect = &l->desc->effects[e];
    bool has_target = effect->target && *effect->target;
    if (effect->placement == PLR_REMOVE && !has_target) {
        plr_say(l, PLR_CODE_BAD_TARGET, effect->place, "%s: REMOVE needs a target",
                plr_effect_text(l, e));
        return false;
    }
    if ((unsigned)effect->placement > PLR_REMOVE || effect->attached > e) {
        plr_say(l, PLR_CODE_BAD_TARGET, effect->place,
                "%s is attached to an effect that does not come before it", plr_effect_text(l, e));
        return false;
    }
    size_t depth = 0;
    for (size_t at = plr_attached_to(l, e); at && depth <= PLR_MOST_ATTACHED; depth++)
        at = plr_attached_to(l, at - 1);
    if (depth > PLR_MOST_ATTACHED)
        plr_say(l, PLR_CODE_LIMIT, effect->place, "%s is attached more than %d effects deep",
                plr_effect_text(l, e), PLR_MOST_ATTACHED);
    return depth <= PLR_MOST_ATTACHED;
}

/* Whether the effect brings main() to the geometry stage. */
static bool has_main(const plr_linking *l, uint32_t e) {
    uint32_t gid = plr_gid_find(l, "main", 4);
    const plr_binding *entry =
        gid == PLR_NONE ? NULL : plr_binding_find(l, plr_scope_of(l, PLR_GEOMETRY, e), gid);
    return entry && entry->function;
}

void plr_leave_out(plr_linking *l, uint32_t effect, const plr_message *message) {
    plr_unfit *unfit = PLR_NEW(l->arena, plr_unfit);
    if (message) {
        unfit->messages = PLR_NEW(l->arena, plr_message);
        *unfit->messages = *message;
        unfit->count = 1;
    }
    l->unfit[effect] = unfit;
    l->again = true;
}

void plr_keep_faults(plr_linking *l, plr_stage stage) {
    for (uint32_t e = 0; e < l->effect_count; e++) {
        size_t count = l->said_end[e] - l->said[e];
        if (!l->faulty[e] || l->unfit[e] || !count || !plr_scope_of(l, stage, e)->unit_count)
            continue;
        plr_unfit *unfit = PLR_NEW(l->arena, plr_unfit);
        unfit->messages = PLR_NEW_ARRAY(l->arena, count, plr_message);
        unfit->count = count;
        for (size_t i = 0; i < count; i++) {
            unfit->messages[i] = l->messages.items[l->said[e] + i];
            const char *text = unfit->messages[i].text;
            unfit->messages[i].text = plr_arena_copy(l->arena, text, strlen(text));
        }
        l->unfit[e] = unfit;
    }
}

static void add_effect(plr_linking *l, uint32_t e) {
    bool good = check_effect(l, e);
    const plr_unfit *unfit = l->unfit[e];
    if (unfit && unfit->count) {
        for (size_t i = 0; i < unfit->count; i++)
            *PLR_PUSH(l->pass, &l->messages) = unfit->messages[i];
        l->faulty[e] = true;
        plr_note_lost(l, e);
        return;
    }
    if (unfit) {
        l->left_out[e] = true;
        return;
    }
    if (good)
        plr_check_target(l, e);
    if (good && l->desc->effects[e].only_if_active && !plr_target_exists(l, e)) {
        l->left_out[e] = true;
        return;
    }
    for (unsigned s = 0; s < PLR_STAGE_COUNT; s++) {
        plr_scope *scope = plr_scope_of(l, (plr_stage)s, e);
        good &= take_text(l, scope);
        good &= plr_find_functions(l, scope);
    }
    for (unsigned s = 0; s < PLR_STAGE_COUNT && good; s++)
        plr_take_promises(l, plr_scope_of(l, (plr_stage)s, e));
    if (good)
        good = plr_place_functions(l, e);
    for (unsigned s = 0; s < PLR_STAGE_COUNT && good; s++)
        good &= plr_define_names(l, plr_scope_of(l, (plr_stage)s, e));
    if (good && has_main(l, e))
        good = plr_takes_primitive(l, plr_scope_of(l, PLR_GEOMETRY, e));
    if (!good) {
        l->faulty[e] = true;
        plr_note_lost(l, e);
        return;
    }
    for (unsigned s = 0; s < PLR_STAGE_COUNT; s++)
        plr_name_functions(l, plr_scope_of(l, (plr_stage)s, e));
    plr_commit_calls(l);
    if (has_main(l, e))
        l->main_effect = e;
}

/* Plugs in use, for PLUG_USED; and messages about functions that are called nowhere. */
static void note_used(plr_linking *l, uint32_t gid) {
    l->grown |= !l->used[gid];
    l->used[gid] = 1;
}

static void check_placed(plr_linking *l) {
    for (size_t i = 0; i < l->sockets.count; i++) {
        const plr_socket *socket = l->sockets.items[i];
        if (socket->calls.count)
            note_used(l, socket->unit->reading->gids[socket->plug->name]);
    }
    for (uint32_t e = 0; e < l->effect_count; e++) {
        for (unsigned s = 0; s < PLR_STAGE_COUNT; s++) {
            plr_scope *scope = plr_scope_of(l, (plr_stage)s, e);
            if (l->faulty[e] || l->left_out[e])
                continue;
            for (uint32_t u = 0; u < scope->unit_count; u++)
                for (plr_function *f = scope->units[u].functions; f; f = f->next) {
                    if (!f->placed && !l->removed[e] && l->offered[f->plug])
                        note_used(l, f->plug);
                    if (!f->placed)
                        plr_say_unplaced(l, &scope->units[u], f);
                }
        }
    }
}

void plr_add_effects(plr_linking *l) {
    for (unsigned s = 0; s < PLR_STAGE_COUNT; s++) {
        plr_scope *base = plr_scope_of(l, (plr_stage)s, PLR_SCOPE_BASE(l));
        plr_scope *library = plr_scope_of(l, (plr_stage)s, PLR_SCOPE_LIBRARY(l));
        bool good = take_text(l, base);
        take_text(l, library);
        plr_take_promises(l, base);
        plr_define_names(l, library);
        good &= plr_define_names(l, base);
        if (s == PLR_GEOMETRY && plr_entry(l, PLR_GEOMETRY))
            good &= plr_takes_primitive(l, base);
        l->base_fault |= !good;
        for (uint32_t u = 0; u < base->unit_count && good; u++)
            plr_add_sockets(l, &base->units[u]);
    }
    for (uint32_t e = 0; e < l->effect_count && !l->base_fault; e++)
        if (l->desc->effects[e].disabled) {
            plr_note_lost(l, e);
        } else {
            l->said[e] = l->messages.count;
            add_effect(l, e);
            l->said_end[e] = l->messages.count;
        }
    if (l->base_fault)
        return;
    plr_order_calls(l);
    check_placed(l);
}
