/* The calls of a linked program, in the order in which it comes to them. */
#include "plugs/program.h"

/* A stretch of text that is being followed, and how far. */
typedef struct stretch {
    plr_unit *unit;
    uint32_t at, end;
    unsigned depth;
    const plr_socket *socket; /* whose calls are being followed; NULL: none */
    size_t call;
} stretch;

typedef struct walk {
    const plr_linking *l;
    plr_arena arena;
    PLR_LIST(stretch) stack;
    plr_table seen; /* functions and definitions that were followed */
    plr_call_info *calls;
    size_t count, capacity;
} walk;

static bool is_new(walk *w, const void *followed) {
    void **slot = plr_table_put(&w->arena, &w->seen, (uint64_t)(uintptr_t)followed);
    bool fresh = !*slot;
    *slot = w;
    return fresh;
}

static void follow(walk *w, plr_unit *unit, uint32_t first, uint32_t end, unsigned depth) {
    *PLR_PUSH(&w->arena, &w->stack) = (stretch){unit, first, end, depth, NULL, 0};
}

static void follow_function(walk *w, const plr_function *function, unsigned depth) {
    uint32_t end = plr_function_end(function->node->unit, function->name);
    if (end != PLR_NONE && is_new(w, function))
        follow(w, function->node->unit, function->name->close, end, depth);
}

/* A function or macro that the text names. */
static void follow_symbol(walk *w, const plr_binding *symbol, unsigned depth) {
    for (const plr_definition *d = symbol->definitions; d; d = d->next) {
        plr_unit *unit = d->node->unit;
        uint32_t end = PLR_NONE, first = d->name->token + 1;
        if (d->name->kind == PLR_ITEM_FUNCTION)
            end = plr_function_end(unit, d->name);
        else if (d->name->kind == PLR_ITEM_MACRO && !d->name->inner)
            end = d->node->item->end;
        if (end != PLR_NONE && d->node->reached && is_new(w, d))
            follow(w, unit, first, end, depth);
    }
}

static void follow_ident(walk *w, const stretch *s, uint32_t token) {
    const plr_unit *unit = s->unit;
    const plr_token *t = &unit->lexed->tokens.items[token];
    const plr_binding *symbol = unit->refs[t->value];
    if (symbol && (symbol->function || symbol->macro) && !plr_is_plain(unit, t, symbol)) {
        follow_symbol(w, symbol, s->depth);
    } else if (!symbol && plr_token_ident(unit, token)->flags & PLR_IF_PLUG) {
        plr_function *found[64];
        size_t count = plr_direct_functions(w->l, s->unit, token, found, 64);
        while (count > 0) /* the first one on top of the stack */
            follow_function(w, found[--count], s->depth);
    }
}

static void note_call(walk *w, const stretch *s, const plr_call *call) {
    const plr_function *function = call->function;
    if (w->count < w->capacity)
        w->calls[w->count] = (plr_call_info){
            .plug = s->socket->index,
            .effect = function->effect,
            .depth = s->depth,
            .function = plr_token_place(function->node->unit, function->name->token)};
    w->count++;
}

/* One step of the stretch on top. */
static void step(walk *w) {
    size_t top = w->stack.count - 1;
    stretch *s = &w->stack.items[top];
    const plr_lexed *lexed = s->unit->lexed;
    if (s->socket) {
        if (s->call == s->socket->calls.count) {
            s->socket = NULL;
            return;
        }
        const plr_call *call = &s->socket->calls.items[s->call++];
        note_call(w, s, call);
        follow_function(w, call->function, s->depth + 1);
        return;
    }
    if (s->at >= s->end) {
        w->stack.count--;
        return;
    }
    const plr_token *token = &lexed->tokens.items[s->at];
    if (token->kind == PLR_T_DIRECTIVE) {
        s->at = s->unit->activity ? s->unit->activity->next[token->value]
                                  : lexed->directives.items[token->value].end;
    } else if (token->kind == PLR_T_PLUG) {
        s->socket = s->unit->sockets[token->value];
        s->call = 0;
        s->at = lexed->plugs.items[token->value].end;
    } else if (token->kind == PLR_T_IDENT) {
        stretch here = *s;
        s->at++;
        follow_ident(w, &here, here.at);
    } else {
        s->at++;
    }
}

/* False without memory. */
static bool walk_stages(walk *w) {
    jmp_buf out_of_memory;
    w->arena.out_of_memory = &out_of_memory;
    if (setjmp(out_of_memory))
        return false;
    for (unsigned s = 0; s < PLR_STAGE_COUNT; s++) {
        const plr_binding *entry = w->l->stages & 1u << s ? plr_entry(w->l, (plr_stage)s) : NULL;
        if (entry)
            follow_symbol(w, entry, 0);
        while (w->stack.count)
            step(w);
    }
    return true;
}

size_t plr_program_calls(const plr_program *program, plr_call_info *calls, size_t capacity) {
    walk w = {.l = &program->linking, .calls = calls, .capacity = capacity};
    plr_arena_init(&w.arena, &program->allocator, NULL);
    bool done = walk_stages(&w);
    plr_arena_finish(&w.arena);
    return done ? w.count : 0;
}
