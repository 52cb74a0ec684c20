/* Plugs of active text, and which plug functions are called there. */
#include "plugs/link.h"

#include <stdlib.h>
#include <string.h>

/* instance 0: all of the stage; k + 1: those of effect k and of what is attached to it */
static uint64_t plug_key(plr_stage stage, uint32_t instance, uint32_t gid) {
    return (uint64_t)(stage + 1) << 60 | (uint64_t)instance << 32 | gid;
}

size_t plr_attached_to(const plr_linking *l, size_t effect) {
    size_t attached = l->desc->effects[effect].attached;
    return attached <= effect ? attached : 0; /* faulty: see check_effect */
}

static void list_socket(plr_linking *l, uint64_t key, plr_socket *socket) {
    void **slot = plr_table_put(l->pass, &l->by_plug, key);
    if (!*slot)
        *slot = PLR_NEW(l->pass, plr_sockets);
    plr_sockets *sockets = *slot;
    *PLR_PUSH(l->pass, sockets) = socket;
}

void plr_add_sockets(plr_linking *l, plr_unit *unit) {
    plr_stage stage = unit->scope->stage;
    uint32_t owner = unit->scope->owner;
    for (size_t i = 0; unit->cut && i < unit->cut->plugs.count; i++) {
        uint32_t index = unit->cut->plugs.items[i];
        const plr_plug *plug = &unit->lexed->plugs.items[index];
        uint32_t gid = unit->reading->gids[plug->name];
        plr_socket *socket = PLR_NEW(l->pass, plr_socket);
        socket->unit = unit;
        socket->plug = plug;
        socket->effect = owner;
        socket->index = (uint32_t)l->sockets.count;
        unit->sockets[index] = socket;
        *PLR_PUSH(l->pass, &l->sockets) = socket;
        bool of_effect = owner < l->effect_count;
        bool hidden = of_effect && l->desc->effects[owner].private_plugs;
        if (!hidden)
            list_socket(l, plug_key(stage, 0, gid), socket);
        if (!of_effect)
            continue;
        list_socket(l, plug_key(stage, owner + 1, gid), socket);
        for (size_t around = hidden ? 0 : plr_attached_to(l, owner); around;
             around = plr_attached_to(l, around - 1))
            list_socket(l, plug_key(stage, (uint32_t)around, gid), socket);
    }
}

/* ---- Functions ---------------------------------------------------------------------------------
 */

uint32_t plr_function_end(const plr_unit *unit, const plr_name *name) {
    const plr_token *tokens = unit->lexed->tokens.items;
    uint32_t body = plr_active(unit->lexed, unit->activity, name->close + 1);
    if (tokens[body].kind == '{')
        return tokens[body].value;
    uint32_t open = plr_active(unit->lexed, unit->activity, body + 1); /* of a macro */
    return tokens[open].kind == '(' ? tokens[open].value : body;
}

/* Follows the branches of kept conditionals through a unit. */
typedef struct branches {
    const plr_branch *inner;
    uint32_t next_directive, groups;
} branches;

static const plr_branch *new_branch(plr_linking *l, const plr_branch *outer, uint32_t group,
                                    uint32_t number) {
    plr_branch *branch = PLR_NEW(l->pass, plr_branch);
    *branch = (plr_branch){outer, outer ? outer->depth + 1 : 1, group, number};
    return branch;
}

/* The innermost branch at a token that comes after the last one asked for. */
static const plr_branch *branch_at(plr_linking *l, const plr_unit *unit, branches *b,
                                   uint32_t token) {
    const plr_lexed *lexed = unit->lexed;
    for (; unit->activity && b->next_directive < lexed->directives.count; b->next_directive++) {
        uint32_t i = b->next_directive;
        if (lexed->directives.items[i].token > token)
            break;
        uint8_t kept = unit->activity->kept[i];
        if (kept == PLR_KEPT_IF)
            b->inner = new_branch(l, b->inner, ++b->groups, 0);
        else if (b->inner && (kept == PLR_KEPT_ELIF || kept == PLR_KEPT_ELSE))
            b->inner = new_branch(l, b->inner->outer, b->inner->group, b->inner->number + 1);
        else if (b->inner && kept == PLR_KEPT_ENDIF)
            b->inner = b->inner->outer;
    }
    return b->inner;
}

/* Whether the compiler sees one of them at most. */
static bool exclude(const plr_branch *a, const plr_branch *b) {
    while (a && b && a != b) {
        if (a->group == b->group)
            return true;
        if (a->depth >= b->depth)
            a = a->outer;
        else
            b = b->outer;
    }
    return false;
}

/* One function in several branches of a conditional that is kept: only one of them will be. */
static plr_function *find_twin(plr_function *first, const plr_function *function) {
    plr_function *like[64];
    unsigned count = 0, looked = 0;
    if (function->item->kind != PLR_ITEM_GROUP)
        return NULL;
    for (plr_function *f = first; f != function && looked < 64; f = f->next, looked++) {
        if (f->gid != function->gid || f->name->parameters != function->name->parameters)
            continue;
        plr_function *root = f->twin ? f->twin : f;
        if (!exclude(f->branch, function->branch))
            root->met = function; /* they are both there */
        like[count++] = root;
    }
    for (unsigned i = 0; i < count; i++)
        if (like[i]->met != function)
            return like[i];
    return NULL;
}

static bool add_function(plr_linking *l, plr_unit *unit, const plr_item *item, const plr_name *name,
                         plr_function **first, branches *at) {
    const plr_ident *ident = plr_token_ident(unit, name->token);
    uint16_t type = PLR_WORD_NONE;
    if (name->type != PLR_NONE && unit->lexed->tokens.items[name->type].kind == PLR_T_IDENT)
        type = plr_token_ident(unit, name->type)->word;
    if (type != PLR_WORD_void) {
        plr_say(l, PLR_CODE_PLUG_NOT_VOID, plr_token_place(unit, name->token),
                "\"%.*s\" must return void, as every plug function",
                (int)(ident->length < 200 ? ident->length : 200), ident->text);
        return false;
    }
    plr_function *function = PLR_NEW(l->pass, plr_function);
    *function = (plr_function){.item = item, .name = name, .effect = unit->scope->owner};
    function->gid = plr_token_gid(unit, name->token);
    function->plug = plr_gid(l, ident->text + 5, ident->length - 5);
    if (unit->last_function)
        unit->last_function->next = function;
    else
        unit->functions = function;
    unit->last_function = function;
    if (!*first || (*first)->item != item)
        *first = function;
    function->branch = branch_at(l, unit, at, name->token);
    function->twin = find_twin(*first, function);
    bool known = plr_function_end(unit, name) != PLR_NONE;
    if (function->twin)
        function->twin->guarded &= known;
    else
        function->guarded = known && item->kind == PLR_ITEM_GROUP;
    return true;
}

bool plr_find_functions(plr_linking *l, plr_scope *scope) {
    bool good = true;
    for (uint32_t u = 0; u < scope->unit_count; u++) {
        plr_unit *unit = &scope->units[u];
        plr_function *first = NULL; /* of the item at hand */
        branches at = {NULL, 0, 0};
        for (size_t i = 0; unit->cut && i < unit->cut->items.count; i++) {
            const plr_item *item = &unit->cut->items.items[i];
            for (uint32_t n = 0; n < item->name_count; n++) {
                const plr_name *name = &unit->cut->names.items[item->names + n];
                if (name->kind == PLR_ITEM_FUNCTION &&
                    plr_token_ident(unit, name->token)->flags & PLR_IF_PLUG)
                    good &= add_function(l, unit, item, name, &first, &at);
            }
        }
    }
    return good;
}

typedef struct same_name {
    plr_function *first, *last;
    uint32_t number;
} same_name;

/* Whether the effect declares the name, or has a plug function that will be called so. */
static bool is_taken(plr_linking *l, const plr_scope *scope, const char *local, uint32_t number) {
    uint32_t gid = plr_gid_find(l, local, strlen(local));
    if (gid != PLR_NONE && plr_binding_find(l, scope, gid))
        return true;
    if (number < 2)
        return false;
    const char *plug = plr_arena_format(l->pass, "PLUG_%s", local);
    gid = plr_gid_find(l, plug, strlen(plug));
    return gid != PLR_NONE && plr_table_get(&l->functions, (uint64_t)scope->number << 32 | gid);
}

/* plr3_plug, plr3_plug_2, ...: none that the effect declares otherwise. */
static void name_function(plr_linking *l, plr_scope *scope, plr_function *function,
                          uint32_t *number) {
    const plr_ident *plug = &l->idents.items[function->plug];
    for (;; ++*number) {
        const char *text = *number < 2
                               ? plr_arena_format(l->pass, "plr%u_%.*s", (unsigned)scope->owner,
                                                  (int)plug->length, plug->text)
                               : plr_arena_format(l->pass, "plr%u_%.*s_%u", (unsigned)scope->owner,
                                                  (int)plug->length, plug->text, (unsigned)*number);
        function->text = text;
        function->length = (uint32_t)strlen(text);
        const char *local = strchr(text, '_') + 1;
        if (!is_taken(l, scope, local, *number))
            break;
    }
    ++*number;
}

/* Lists the functions of one name, so that names can be given. */
static void register_functions(plr_linking *l, plr_scope *scope, plr_unit *unit) {
    for (plr_function *f = unit->functions; f; f = f->next) {
        f->node = &unit->nodes[f->item - unit->cut->items.items];
        if (!f->node->function)
            f->node->function = f;
        if (f->twin)
            continue;
        void **slot = plr_table_put(l->pass, &l->functions, (uint64_t)scope->number << 32 | f->gid);
        if (!*slot) {
            same_name *fresh = PLR_NEW(l->pass, same_name);
            *fresh = (same_name){f, NULL, 1};
            *slot = fresh;
        }
        same_name *same = *slot;
        if (same->last)
            same->last->next_same = f;
        same->last = f;
    }
}

void plr_name_functions(plr_linking *l, plr_scope *scope) {
    for (uint32_t u = 0; u < scope->unit_count; u++)
        register_functions(l, scope, &scope->units[u]);
    for (uint32_t u = 0; u < scope->unit_count; u++)
        for (plr_function *f = scope->units[u].functions; f; f = f->next) {
            if (f->twin) {
                f->text = f->twin->text;
                f->length = f->twin->length;
                continue;
            }
            same_name *same = plr_table_get(&l->functions, (uint64_t)scope->number << 32 | f->gid);
            name_function(l, scope, f, &same->number);
        }
}

size_t plr_direct_functions(const plr_linking *l, const plr_unit *unit, uint32_t token,
                            plr_function **found, size_t capacity) {
    const plr_lexed *lexed = unit->lexed;
    uint32_t gid = plr_token_gid(unit, token);
    uint32_t open = plr_active(lexed, unit->activity, token + 1);
    bool call = lexed->tokens.items[open].kind == '(';
    const same_name *same = plr_table_get(&l->functions, (uint64_t)unit->scope->number << 32 | gid);
    size_t count = 0;
    for (int own = 1; own >= 0 && !count && same; own--)
        for (plr_function *f = same->first; f && count < capacity; f = f->next_same)
            if ((f->node->unit == unit) == (own == 1) &&
                (!call || f->name->parameters == lexed->tokens.items[open].count))
                found[count++] = f;
    return count;
}

/* ---- Placing -----------------------------------------------------------------------------------
 */

static const plr_sockets *sockets_in_reach(const plr_linking *l, const plr_function *function,
                                           plr_stage stage) {
    size_t attached = l->desc->effects[function->effect].attached;
    const plr_sockets *local = NULL;
    if (attached)
        local = plr_table_get(&l->by_plug, plug_key(stage, (uint32_t)attached, function->plug));
    for (size_t i = 0; local && i < local->count; i++)
        if (local->items[i]->effect >= l->effect_count || !l->faulty[local->items[i]->effect])
            return local; /* what the instance has hides the rest */
    if (attached && l->desc->effects[function->effect].only_attached)
        return NULL;
    return plr_table_get(&l->by_plug, plug_key(stage, 0, function->plug));
}

static uint32_t fitting_list(const plr_socket *socket, uint32_t parameters) {
    const plr_plug *plug = socket->plug;
    for (uint32_t i = 0; i < plug->list_count; i++)
        if (socket->unit->lexed->lists.items[plug->lists + i].count == parameters)
            return plug->lists + i;
    return PLR_NONE;
}

static void add_provider(plr_linking *l, plr_scope *scope, uint32_t effect) {
    if (effect >= l->effect_count || effect == scope->owner ||
        l->provider_of[effect] == scope->number)
        return;
    l->provider_of[effect] = scope->number;
    *PLR_PUSH(l->pass, &scope->providers) = effect;
}

static int later_first(const void *a, const void *b) {
    uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return (x < y) - (x > y);
}

static void say_arity(plr_linking *l, const plr_unit *unit, const plr_function *function,
                      const plr_sockets *sockets) {
    const char *counts = "";
    uint32_t last = PLR_NONE;
    for (size_t s = 0; s < sockets->count && s < 8; s++) {
        const plr_socket *socket = sockets->items[s];
        for (uint32_t i = 0; i < socket->plug->list_count; i++) {
            uint32_t count = socket->unit->lexed->lists.items[socket->plug->lists + i].count;
            if (count != last)
                counts = plr_arena_format(l->pass, "%.100s%s%u", counts, *counts ? " or " : "",
                                          (unsigned)count);
            last = count;
        }
    }
    const plr_socket *first = sockets->items[0];
    plr_say(l, PLR_CODE_PLUG_ARITY, plr_token_place(unit, function->name->token),
            "\"%s\" has %u parameter%s, but the plug passes %s", plr_gid_text(l, function->gid),
            (unsigned)function->name->parameters, function->name->parameters == 1 ? "" : "s",
            counts);
    plr_say_note(l, plr_unit_place(first->unit, first->plug->offset), "plug \"%s\" stands here",
                 plr_gid_text(l, function->plug));
}

/* Finds the plugs of one function. False: there are some, and it fits none. */
static bool place_function(plr_linking *l, plr_unit *unit, plr_function *function) {
    if (function->twin) {
        function->placed = true;
        return true;
    }
    const plr_sockets *sockets = sockets_in_reach(l, function, unit->scope->stage);
    size_t offered = 0, called = 0;
    for (size_t i = 0; sockets && i < sockets->count; i++) {
        plr_socket *socket = sockets->items[i];
        if (socket->effect < l->effect_count && l->faulty[socket->effect])
            continue;
        offered++;
        uint32_t list = fitting_list(socket, function->name->parameters);
        add_provider(l, unit->scope, socket->effect);
        if (list == PLR_NONE)
            continue;
        *PLR_PUSH(l->pass, &l->pending) = (plr_pending){socket, function, list};
        called++;
    }
    function->placed = called > 0;
    if (!called && offered) {
        say_arity(l, unit, function, sockets);
        return false;
    }
    return true;
}

bool plr_place_functions(plr_linking *l, uint32_t effect) {
    bool good = true;
    l->pending.count = 0;
    for (unsigned s = 0; s < PLR_STAGE_COUNT; s++) {
        plr_scope *scope = plr_scope_of(l, (plr_stage)s, effect);
        for (uint32_t u = 0; u < scope->unit_count; u++) {
            plr_unit *unit = &scope->units[u];
            for (plr_function *f = unit->functions; f; f = f->next)
                good &= place_function(l, unit, f);
            plr_add_sockets(l, unit); /* open to the later units of the same effect */
        }
        if (scope->providers.count > 1)
            qsort(scope->providers.items, scope->providers.count, sizeof(uint32_t), later_first);
    }
    return good;
}

void plr_commit_calls(plr_linking *l) {
    for (size_t i = 0; i < l->pending.count; i++) {
        const plr_pending *p = &l->pending.items[i];
        *PLR_PUSH(l->pass, &p->socket->calls) = (plr_call){p->function, p->list};
    }
}
