/* Placement: the order in which the functions at a plug are called. */
#include "plugs/link.h"

#include <string.h>

enum {
    REACH_ALL,   /* built-in effects anywhere */
    REACH_WHOLE, /* those that are attached to nothing; k + 2: effect k and what is attached to it
                  */
    MOST_KEYS = PLR_MOST_ATTACHED + 3
};

static uint64_t target_key(uint32_t name, uint64_t reach) {
    return (reach + 1) << 32 | name;
}

static const char *target_of(const plr_linking *l, uint32_t effect) {
    const char *target = l->desc->effects[effect].target;
    return target && *target ? target : NULL;
}

/* The keys under which a built-in effect may be aimed at: what it is attached to, directly or not,
 * as far as their plugs reach. */
static unsigned keys_of(const plr_linking *l, uint32_t effect, uint64_t keys[MOST_KEYS]) {
    unsigned count = 0;
    uint32_t name = l->names[effect];
    keys[count++] = target_key(name, REACH_ALL);
    keys[count++] = target_key(name, (uint64_t)effect + 2);
    if (!l->desc->effects[effect].attached)
        keys[count++] = target_key(name, REACH_WHOLE);
    for (size_t around = plr_attached_to(l, effect); around && count < MOST_KEYS;
         around = l->desc->effects[around - 1].private_plugs ? 0 : plr_attached_to(l, around - 1))
        keys[count++] = target_key(name, (uint64_t)around + 1);
    return count;
}

/* The key that an effect aims at: what it is attached to first, then what stands alone. */
static uint64_t aim_of(const plr_linking *l, uint32_t effect) {
    size_t attached = l->desc->effects[effect].attached;
    if (!attached)
        return target_key(l->targets[effect], REACH_ALL);
    uint64_t local = target_key(l->targets[effect], (uint64_t)attached + 1);
    return plr_table_get(&l->targets_of, local) ? local
                                                : target_key(l->targets[effect], REACH_WHOLE);
}

void plr_note_targets(plr_linking *l) {
    for (uint32_t e = 0; e < l->effect_count; e++) {
        const plr_effect *effect = &l->desc->effects[e];
        l->placements |=
            !effect->disabled && (effect->placement != PLR_ADD_AFTER || target_of(l, e));
    }
    if (!l->placements)
        return;
    l->names = PLR_NEW_ARRAY(l->arena, l->effect_count, uint32_t);
    l->targets = PLR_NEW_ARRAY(l->arena, l->effect_count, uint32_t);
    for (uint32_t e = 0; e < l->effect_count; e++) {
        const plr_effect *effect = &l->desc->effects[e];
        const char *target = target_of(l, e);
        l->names[e] = l->targets[e] = PLR_NONE;
        if (effect->disabled)
            continue;
        if (target)
            l->targets[e] = plr_gid(l, target, strlen(target));
        if (!effect->builtin || !effect->name)
            continue;
        l->names[e] = plr_gid(l, effect->name, strlen(effect->name));
        uint64_t keys[MOST_KEYS];
        unsigned count = keys_of(l, e, keys);
        for (unsigned k = 0; k < count; k++)
            *plr_table_put(l->arena, &l->targets_of, keys[k]) = l;
    }
}

bool plr_target_exists(const plr_linking *l, uint32_t effect) {
    return !target_of(l, effect) || plr_table_get(&l->targets_of, aim_of(l, effect));
}

/* Marks the effects that are called, whatever others remove. Sockets stand in the order of their
 * effects, and an effect is called at sockets of earlier ones. */
static void find_called(plr_linking *l) {
    l->called = PLR_NEW_ARRAY(l->pass, (size_t)l->effect_count + 1, bool);
    for (size_t i = 0; i < l->sockets.count; i++) {
        const plr_socket *socket = l->sockets.items[i];
        if (socket->effect < l->effect_count && !l->called[socket->effect])
            continue;
        for (size_t c = 0; c < socket->calls.count; c++)
            l->called[socket->calls.items[c].function->effect] = true;
    }
}

void plr_leave_inactive(plr_linking *l) {
    plr_table active = {NULL, NULL, 0, 0};
    for (uint32_t e = 0; e < l->effect_count; e++) {
        uint64_t keys[MOST_KEYS];
        unsigned count = l->names[e] == PLR_NONE || !l->called[e] ? 0 : keys_of(l, e, keys);
        for (unsigned k = 0; k < count; k++)
            *plr_table_put(l->pass, &active, keys[k]) = l;
    }
    for (uint32_t e = 0; e < l->effect_count; e++) {
        const plr_effect *effect = &l->desc->effects[e];
        if (!effect->only_if_active || effect->disabled || l->faulty[e] || l->left_out[e] ||
            !target_of(l, e) || plr_table_get(&active, aim_of(l, e)))
            continue;
        plr_leave_out(l, e, NULL);
    }
}

/* Marks the effects that others REMOVE or REPLACE. */
static void mark_removed(plr_linking *l) {
    plr_table aims = {NULL, NULL, 0, 0};
    bool any = false;
    for (uint32_t e = 0; e < l->effect_count; e++) {
        plr_placement placement = l->desc->effects[e].placement;
        if ((placement != PLR_REMOVE && placement != PLR_REPLACE) || !target_of(l, e) ||
            l->desc->effects[e].disabled || l->faulty[e] || l->left_out[e])
            continue;
        *plr_table_put(l->pass, &aims, aim_of(l, e)) = l;
        any = true;
    }
    for (uint32_t e = 0; any && e < l->effect_count; e++) {
        uint64_t keys[MOST_KEYS];
        unsigned count = l->names[e] == PLR_NONE ? 0 : keys_of(l, e, keys);
        for (unsigned k = 0; k < count; k++)
            l->removed[e] |= plr_table_get(&aims, keys[k]) != NULL;
    }
}

/* ---- One plug ----------------------------------------------------------------------------------
 */

typedef PLR_LIST(plr_call) calls;

/* A call of a built-in effect, where others may stand around. */
typedef struct anchor {
    plr_call call;
    calls before, instead, after;
} anchor;

typedef struct arrangement {
    plr_linking *l;
    calls before, step, after;
    anchor *anchors;
    size_t anchor_count;
    plr_table first, last; /* key -> anchor */
    bool replaced;         /* the whole step is */
} arrangement;

static void add_anchor(arrangement *a, const plr_call *call) {
    anchor *fresh = &a->anchors[a->anchor_count++];
    fresh->call = *call;
    uint64_t keys[MOST_KEYS];
    unsigned count = a->l->names[call->function->effect] == PLR_NONE
                         ? 0
                         : keys_of(a->l, call->function->effect, keys);
    for (unsigned k = 0; k < count; k++) {
        void **first = plr_table_put(a->l->pass, &a->first, keys[k]);
        if (!*first)
            *first = fresh;
        *plr_table_put(a->l->pass, &a->last, keys[k]) = fresh;
    }
}

static void add_call(plr_linking *l, calls *list, const plr_call *call) {
    *PLR_PUSH(l->pass, list) = *call;
}

static void add_placed(arrangement *a, const plr_call *call) {
    plr_linking *l = a->l;
    uint32_t effect = call->function->effect;
    plr_placement placement = l->desc->effects[effect].placement;
    if (!target_of(l, effect)) {
        if (placement == PLR_REPLACE)
            a->replaced = true;
        add_call(l,
                 placement == PLR_ADD_BEFORE ? &a->before
                 : placement == PLR_REPLACE  ? &a->step
                                             : &a->after,
                 call);
        return;
    }
    uint64_t aim = aim_of(l, effect);
    anchor *first = plr_table_get(&a->first, aim), *last = plr_table_get(&a->last, aim);
    if (!first)
        add_call(l, placement == PLR_ADD_BEFORE ? &a->before : &a->after, call);
    else if (placement == PLR_ADD_BEFORE)
        add_call(l, &first->before, call);
    else if (placement == PLR_REPLACE)
        add_call(l, &first->instead, call);
    else if (placement == PLR_ADD_AFTER)
        add_call(l, &last->after, call);
    else
        add_call(l, &a->after, call);
}

static bool is_plain_builtin(const plr_linking *l, const plr_call *call) {
    const plr_effect *effect = &l->desc->effects[call->function->effect];
    return effect->builtin && effect->placement == PLR_ADD_AFTER &&
           !target_of(l, call->function->effect);
}

static void append(plr_linking *l, calls *list, const calls *more) {
    for (size_t i = 0; i < more->count; i++)
        if (!l->removed[more->items[i].function->effect])
            add_call(l, list, &more->items[i]);
}

static void arrange(plr_linking *l, plr_socket *socket) {
    arrangement a = {.l = l};
    a.anchors = PLR_NEW_ARRAY(l->pass, socket->calls.count, anchor);
    for (size_t i = 0; i < socket->calls.count; i++)
        if (is_plain_builtin(l, &socket->calls.items[i]))
            add_anchor(&a, &socket->calls.items[i]);
    for (size_t i = 0; i < socket->calls.count; i++)
        if (!is_plain_builtin(l, &socket->calls.items[i]))
            add_placed(&a, &socket->calls.items[i]);
    calls all = {NULL, 0, 0};
    append(l, &all, &a.before);
    for (size_t i = 0; i < a.anchor_count; i++) {
        anchor *at = &a.anchors[i];
        append(l, &all, &at->before);
        append(l, &all, &at->instead);
        if (!a.replaced && !l->removed[at->call.function->effect])
            add_call(l, &all, &at->call);
        append(l, &all, &at->after);
    }
    append(l, &all, &a.step);
    append(l, &all, &a.after);
    socket->calls.items = all.items;
    socket->calls.count = all.count;
    socket->calls.capacity = all.capacity;
}

/* Without placements: built-in effects before authors', else as they came. */
static void arrange_plain(plr_linking *l, plr_socket *socket) {
    calls all = {NULL, 0, 0};
    bool sorted = true, author = false;
    for (size_t i = 0; i < socket->calls.count; i++) {
        bool builtin = l->desc->effects[socket->calls.items[i].function->effect].builtin;
        sorted &= !(builtin && author);
        author |= !builtin;
    }
    if (sorted)
        return;
    for (int builtin = 1; builtin >= 0; builtin--)
        for (size_t i = 0; i < socket->calls.count; i++)
            if (l->desc->effects[socket->calls.items[i].function->effect].builtin == (builtin == 1))
                add_call(l, &all, &socket->calls.items[i]);
    socket->calls.items = all.items;
}

void plr_order_calls(plr_linking *l) {
    l->removed = PLR_NEW_ARRAY(l->pass, (size_t)l->effect_count + 1, bool);
    if (l->placements) {
        find_called(l);
        mark_removed(l);
    }
    for (size_t i = 0; i < l->sockets.count; i++) {
        plr_socket *socket = l->sockets.items[i];
        if (socket->calls.count == 0)
            continue;
        if (l->placements)
            arrange(l, socket);
        else
            arrange_plain(l, socket);
    }
}
