#include "plugs/printer.h"

#include <stdio.h>
#include <string.h>

void plr_put(plr_printer *p, const char *text, size_t length) {
    plr_arena *arena = p->l->arena;
    if (p->out.count + length > p->out.capacity)
        p->out.items =
            plr_arena_grow(arena, p->out.items, &p->out.capacity, p->out.count + length, 1);
    if (length)
        memcpy(p->out.items + p->out.count, text, length);
    p->out.count += length;
}

void plr_add_run(plr_printer *p, uint32_t origin, uint32_t offset) {
    uint32_t out = (uint32_t)p->out.count;
    if (p->runs.count) {
        plr_run *last = &p->runs.items[p->runs.count - 1];
        if (last->origin == origin &&
            (origin >= PLR_RUN_OWN || last->offset == offset ||
             (out - last->out == offset - last->offset && !(offset & PLR_RUN_FIXED))))
            return;
        if (last->out == out) {
            *last = (plr_run){out, origin, offset};
            return;
        }
    }
    *PLR_PUSH(p->l->arena, &p->runs) = (plr_run){out, origin, offset};
}

void plr_flush(plr_printer *p) {
    if (p->end > p->begin) {
        plr_add_run(p, p->unit->number, p->begin);
        plr_put(p, p->unit->lexed->text + p->begin, p->end - p->begin);
    }
    p->begin = p->end = 0;
}

void plr_print_own(plr_printer *p, const char *text) {
    plr_flush(p);
    plr_add_run(p, PLR_RUN_OWN, 0);
    plr_put(p, text, strlen(text));
}

void plr_print_newline(plr_printer *p) {
    plr_flush(p);
    if (p->out.count && p->out.items[p->out.count - 1] != '\n')
        plr_put(p, "\n", 1);
}

#define MAX_INDENT 100

/* The blanks that begin the line of a byte of the unit. */
static void put_indent(plr_printer *p, uint32_t offset) {
    const char *text = p->unit->lexed->text;
    uint32_t begin = (uint32_t)plr_source_line_start(p->unit->reading->source, offset), end = begin;
    while (end < offset && end - begin < MAX_INDENT && (text[end] == ' ' || text[end] == '\t'))
        end++;
    plr_put(p, text + begin, end - begin);
}

/* What stands between the token before and one at `offset`: comments and splices become blanks. */
void plr_put_gap(plr_printer *p, uint32_t offset) {
    plr_flush(p);
    if (p->fresh)
        return;
    const char *text = p->unit->lexed->text;
    if (p->out.count && p->out.items[p->out.count - 1] == '\n') {
        put_indent(p, offset);
    } else if (p->broken || memchr(text + p->last, '\n', offset - p->last)) {
        plr_put(p, "\n", 1);
        put_indent(p, offset);
    } else if (offset > p->last) {
        plr_put(p, " ", 1);
    }
}

/* Makes ready to go on at a token: p->begin is where the text to be copied next begins. */
static void begin_token(plr_printer *p, const plr_token *token) {
    bool plain_gap = !p->fresh && !p->broken && !(token->flags & PLR_TF_GAP);
    if (!plain_gap) {
        plr_put_gap(p, token->offset);
        p->begin = token->offset;
    } else if (p->end == 0) {
        p->begin = p->last; /* the token before was printed with another text */
    }
    p->fresh = p->broken = false;
}

void plr_end_token(plr_printer *p, const plr_token *token) {
    p->last = token->offset + token->length;
    p->before = token->kind;
    p->last_token = (uint32_t)(token - p->unit->lexed->tokens.items);
}

/* The text of a token, where a NUL would end the program's. */
static const char *printable_text(const plr_printer *p, const plr_token *token, size_t *length) {
    const char *text = plr_token_text(p->unit->lexed, token, length);
    if (token->kind != PLR_T_OTHER)
        return text;
    if (*length == 1)
        return *text == '\0' ? "?" : text;
    char *string = plr_arena_copy(p->l->pass, text, *length);
    for (size_t i = 0; i < *length; i++) /* compilers would see a comment or the text's end */
        if (string[i] == '\0' ||
            (string[i] == '/' && (string[i + 1] == '/' || string[i + 1] == '*')))
            string[i] = '?';
    return string;
}

/* A token as it is. */
void plr_copy_token(plr_printer *p, const plr_token *token) {
    begin_token(p, token);
    if (token->flags & PLR_TF_SPLICED || token->kind == PLR_T_OTHER) {
        size_t length;
        const char *text = printable_text(p, token, &length);
        p->end = token->offset;
        plr_flush(p);
        plr_add_run(p, p->unit->number, token->offset | PLR_RUN_FIXED);
        plr_put(p, text, length);
    } else {
        p->end = token->offset + token->length;
    }
    plr_end_token(p, token);
}

/* A token with another text. */
void plr_replace_token(plr_printer *p, const plr_token *token, const char *text, size_t length) {
    begin_token(p, token);
    p->end = token->offset;
    plr_flush(p);
    plr_add_run(p, p->unit->number, token->offset | PLR_RUN_FIXED);
    plr_put(p, text, length);
    plr_end_token(p, token);
}

void plr_drop_token(plr_printer *p, const plr_token *token) {
    plr_flush(p);
    p->last = token->offset + token->length;
}

/* ---- Preprocessor lines ------------------------------------------------------------------------
 */

/* A macro of the host in a condition that is kept: its value, as the program does not define it. */
static bool print_host_macro(plr_printer *p, uint32_t token) {
    uint32_t gid = plr_token_gid(p->unit, token);
    const plr_linking *l = p->l;
    const plr_macro *macro = gid < l->host_capacity ? l->hosts[gid] : NULL;
    uint32_t owner = p->unit->scope->owner;
    char number[32];
    const char *text = macro ? macro->text : NULL;
    if (owner < l->effect_count) {
        const plr_effect *effect = &l->desc->effects[owner];
        const plr_ident *ident = &l->idents.items[gid];
        for (size_t i = 0; i < effect->define_count; i++)
            if (effect->defines[i].name && strlen(effect->defines[i].name) == ident->length &&
                memcmp(effect->defines[i].name, ident->text, ident->length) == 0)
                text = effect->defines[i].value ? effect->defines[i].value : "1";
    }
    if (!text && (!macro || macro->state != PLR_MACRO_NUMBER))
        return false;
    if (!text) {
        snprintf(number, sizeof number, "%lld", (long long)macro->number);
        text = number;
    }
    plr_put(p, " (", 2);
    plr_put(p, text, strlen(text));
    plr_put(p, ")", 1);
    return true;
}

/* defined (X), PLUG_USED (x), READS (m): the token after it; 0: it is none, or stays. */
static uint32_t print_query(plr_printer *p, uint32_t token, uint32_t end) {
    const plr_token *tokens = p->unit->lexed->tokens.items;
    uint16_t word = plr_token_ident(p->unit, token)->word;
    if (word != PLR_WORD_defined && word != PLR_WORD_PLUG_USED && word != PLR_WORD_READS)
        return 0;
    bool parens = token + 1 < end && tokens[token + 1].kind == '(';
    uint32_t name = token + 1 + parens;
    if (name >= end || tokens[name].kind != PLR_T_IDENT)
        return 0;
    uint32_t gid = plr_token_gid(p->unit, name);
    bool known = true, value = false;
    if (word == PLR_WORD_defined) {
        value = known = gid < p->l->host_capacity && p->l->hosts[gid];
    } else {
        value = p->l->all || (word == PLR_WORD_READS ? p->l->reads : p->l->used)[gid];
    }
    if (!known)
        return 0;
    plr_put(p, value ? " 1" : " 0", 2);
    return name + 1 + parens;
}

static void print_condition(plr_printer *p, const plr_directive *directive) {
    const plr_token *tokens = p->unit->lexed->tokens.items;
    for (uint32_t i = directive->token + 1; i < directive->end;) {
        const plr_token *token = &tokens[i];
        uint32_t length, next = 0;
        if (token->kind == PLR_T_IDENT) {
            next = print_query(p, i, directive->end);
            plr_binding *symbol = p->unit->refs[token->value];
            if (!next && !symbol && print_host_macro(p, i))
                next = i + 1;
            if (!next && symbol && symbol->macro) {
                const char *text = plr_binding_text(p->l, symbol, &length);
                plr_put(p, " ", 1);
                plr_put(p, text, length);
                next = i + 1;
            }
        }
        if (!next) {
            size_t size;
            const char *text = printable_text(p, token, &size);
            const plr_token *before = token - 1;
            if (i == directive->token + 1 || before->offset + before->length != token->offset)
                plr_put(p, " ", 1);
            plr_put(p, text, size);
            next = i + 1;
        }
        i = next;
    }
}

/* Whether only splices stand between two tokens. */
static bool only_splices(const plr_printer *p, uint32_t begin, uint32_t end) {
    for (uint32_t i = begin; i < end; i++) {
        char c = p->unit->lexed->text[i];
        if (c != '\\' && c != '\r' && c != '\n')
            return false;
    }
    return true;
}

static void print_directive_tokens(plr_printer *p, const plr_directive *directive) {
    const plr_token *tokens = p->unit->lexed->tokens.items;
    for (uint32_t i = directive->token + 1; i < directive->end;) {
        const plr_token *token = &tokens[i];
        if (token->flags & PLR_TF_GAP && !p->fresh) {
            plr_flush(p);
            if (!only_splices(p, p->last, token->offset))
                plr_put(p, " ", 1);
            p->fresh = true;
        }
        uint32_t first = i;
        if (token->kind == PLR_T_IDENT) {
            i = plr_print_ident(p, i);
        } else {
            plr_copy_token(p, token);
            i++;
        }
        for (; first < i; first++)
            plr_put_closers(p, first);
    }
    plr_flush(p);
}

static void print_directive(plr_printer *p, uint32_t at) {
    const plr_lexed *lexed = p->unit->lexed;
    const plr_token *token = &lexed->tokens.items[at];
    const plr_directive *directive = &lexed->directives.items[token->value];
    const plr_activity *activity = p->unit->activity;
    static const char *const heads[] = {[PLR_KEPT_IF] = "#if",
                                        [PLR_KEPT_ELIF] = "#elif",
                                        [PLR_KEPT_ELSE] = "#else",
                                        [PLR_KEPT_ENDIF] = "#endif"};
    uint8_t kept = activity ? activity->kept[token->value] : PLR_KEPT_AS_IS;
    p->broken = true;
    plr_flush(p);
    if (kept == PLR_KEPT_NO || directive->kind == PLR_D_DROP || directive->kind == PLR_D_VERSION ||
        directive->kind == PLR_D_EXTENSION)
        return;
    plr_print_newline(p);
    plr_add_run(p, p->unit->number, token->offset | PLR_RUN_FIXED);
    if (kept == PLR_KEPT_AS_IS) {
        plr_put(p, "#", 1);
        plr_put(p, lexed->text + token->offset + token->length - token->count, token->count);
        plr_put(p, " ", 1);
        p->fresh = true;
        p->broken = false;
        p->last = directive->token + 1 < directive->end ? lexed->tokens.items[at + 1].offset : 0;
        print_directive_tokens(p, directive);
    } else {
        bool name_only = directive->kind == PLR_D_IFDEF || directive->kind == PLR_D_IFNDEF;
        plr_put(p, heads[kept], strlen(heads[kept]));
        if (kept == PLR_KEPT_IF && name_only)
            plr_put(p, directive->kind == PLR_D_IFDEF ? "def" : "ndef",
                    directive->kind == PLR_D_IFDEF ? 3 : 4);
        if (kept == PLR_KEPT_IF || kept == PLR_KEPT_ELIF)
            print_condition(p, directive);
    }
    plr_put(p, "\n", 1);
    p->fresh = false;
    p->broken = true;
    p->last = token->offset;
}

/* ---- Plugs -------------------------------------------------------------------------------------
 */

/* The token after the statement that begins at `i`. */
static uint32_t statement_end(const plr_printer *p, uint32_t i, unsigned depth) {
    const plr_lexed *lexed = p->unit->lexed;
    const plr_token *tokens = lexed->tokens.items;
    while (tokens[i].kind != PLR_T_END) {
        const plr_token *t = &tokens[i];
        uint16_t word = t->kind == PLR_T_IDENT ? lexed->idents.items[t->value].word : 0;
        bool bracket = (t->kind == '(' || t->kind == '[' || t->kind == '{') && t->value != PLR_NONE;
        if (t->kind == '{' && bracket)
            return t->value + 1;
        if (t->kind == ';')
            return i + 1;
        if (t->kind == '}')
            return i;
        if ((word == PLR_WORD_if || word == PLR_WORD_for || word == PLR_WORD_while ||
             word == PLR_WORD_switch) &&
            depth < 32) {
            uint32_t open = plr_active_after(p, i);
            if (tokens[open].kind != '(' || tokens[open].value == PLR_NONE)
                return i;
            uint32_t end = statement_end(
                p, plr_active(lexed, p->unit->activity, tokens[open].value + 1), depth + 1);
            uint32_t next = plr_active(lexed, p->unit->activity, end);
            if (word == PLR_WORD_if && tokens[next].kind == PLR_T_IDENT &&
                lexed->idents.items[tokens[next].value].word == PLR_WORD_else)
                return statement_end(p, plr_active_after(p, next), depth + 1);
            return end;
        }
        i = plr_active(lexed, p->unit->activity, bracket ? t->value + 1 : i + 1);
    }
    return i;
}

/* One call, in a line of its own. */
static void print_call(plr_printer *p, plr_socket *socket, const plr_call *call, const char *head,
                       const char *tail) {
    const plr_lexed *lexed = p->unit->lexed;
    const plr_list *list = &lexed->lists.items[call->list];
    uint32_t index = (uint32_t)p->calls.count;
    *PLR_PUSH(p->l->arena, &p->calls) = (plr_written_call){socket, call->function};
    plr_add_run(p, PLR_RUN_CALL + index, 0);
    size_t runs = p->runs.count;
    put_indent(p, socket->plug->offset);
    plr_put(p, head, strlen(head));
    plr_put(p, call->function->text, call->function->length);
    plr_put(p, "(", 1);
    for (uint32_t t = list->first; t < list->end;) {
        p->fresh = true;
        p->broken = false;
        const plr_token *token = &lexed->tokens.items[t];
        if (t > list->first && token[-1].offset + token[-1].length < token->offset)
            plr_put(p, " ", 1);
        t = token->kind == PLR_T_IDENT ? plr_print_ident(p, t) : (plr_copy_token(p, token), t + 1);
        plr_flush(p);
        plr_put_closers(p, t - 1);
    }
    plr_put(p, ");", 2);
    plr_put(p, tail, strlen(tail));
    p->runs.count = runs; /* the whole line stands for the call */
    plr_put(p, "\n", 1);
}

/* A call that is there only if its function is. */
static void print_guarded(plr_printer *p, plr_socket *socket, const plr_call *call,
                          const char *head, const char *tail) {
    plr_print_own(p, head);
    plr_print_newline(p);
    plr_print_own(p, plr_arena_format(p->l->pass, "#ifdef " PLR_HAS "%s\n", call->function->text));
    print_call(p, socket, call, "", "");
    plr_print_own(p, "#endif\n");
    plr_print_own(p, tail);
    plr_print_newline(p);
}

static void print_calls(plr_printer *p, plr_socket *socket, const char *head, const char *tail) {
    plr_flush(p);
    for (size_t i = 0; i < socket->calls.count; i++) {
        const plr_call *call = &socket->calls.items[i];
        plr_print_newline(p);
        (call->function->guarded ? print_guarded : print_call)(
            p, socket, call, i == 0 ? head : "", i + 1 == socket->calls.count ? tail : "");
    }
    p->fresh = false;
    p->broken = true;
    p->before = ';';
}

typedef enum behind {
    BEHIND_STATEMENT,
    BEHIND_HEADER, /* if (x), else, do, ...: the plug is, or begins, the statement */
    BEHIND_EXPRESSION
} behind;

static behind stands_behind(const plr_printer *p) {
    const plr_token *tokens = p->unit->lexed->tokens.items;
    uint32_t last = p->last_token;
    if (p->before == ';' || p->before == '{' || p->before == '}' || p->before == ':')
        return BEHIND_STATEMENT;
    if (p->before == ')')
        last = tokens[last].kind == ')' && tokens[last].value != PLR_NONE && tokens[last].value > 0
                   ? tokens[last].value - 1
                   : last;
    uint16_t word = tokens[last].kind == PLR_T_IDENT ? plr_token_ident(p->unit, last)->word : 0;
    bool header = p->before == ')' ? word == PLR_WORD_if || word == PLR_WORD_for ||
                                         word == PLR_WORD_while || word == PLR_WORD_switch
                                   : word == PLR_WORD_else || word == PLR_WORD_do;
    return header ? BEHIND_HEADER : BEHIND_EXPRESSION;
}

/* The calls of a plug; behind `if (x)`, `else` and the like they are one statement with what
 * follows. Returns the token to go on with. */
static uint32_t print_plug(plr_printer *p, uint32_t at) {
    const plr_lexed *lexed = p->unit->lexed;
    const plr_plug *plug = &lexed->plugs.items[lexed->tokens.items[at].value];
    plr_socket *socket = p->unit->sockets[lexed->tokens.items[at].value];
    if (!socket || socket->calls.count == 0)
        return plug->end;
    if (stands_behind(p) == BEHIND_STATEMENT || p->inside) {
        print_calls(p, socket, "", "");
        p->last = plug->offset;
        return plug->end;
    }
    p->last = plug->offset;
    if (stands_behind(p) == BEHIND_EXPRESSION) {
        p->inside = socket; /* the calls come when the statement ends */
        p->inside_of = ';';
        return plug->end;
    }
    uint32_t next = plr_active(lexed, p->unit->activity, plug->end);
    uint8_t follows = lexed->tokens.items[next].kind;
    if (follows == '{') {
        p->inside = socket;
        p->inside_of = '{';
    } else if (follows == ';') {
        print_calls(p, socket, "{ ", " }");
        p->last = lexed->tokens.items[next].offset + 1;
        p->before = '}';
        return next + 1;
    } else {
        uint32_t end = statement_end(p, next, 0);
        print_calls(p, socket, "{ ", "");
        plr_push_closer(p, end - 1, " }");
    }
    p->last = plug->offset;
    return plug->end;
}

/* What a plug function of a gated effect begins with. */
static void print_gate(plr_printer *p) {
    uint32_t length;
    const char *name = plr_binding_text(p->l, plr_gate_of(p->l, p->node), &length);
    plr_print_own(
        p, plr_arena_format(p->l->pass, "\n    if (!%.*s)\n        return;", (int)length, name));
    p->broken = true;
}

/* ---- Ranges ------------------------------------------------------------------------------------
 */

void plr_put_tokens(plr_printer *p, uint32_t first, uint32_t end) {
    const plr_unit *unit = p->unit;
    const plr_token *tokens = unit->lexed->tokens.items;
    for (uint32_t i = first; i < end;) {
        const plr_token *token = &tokens[i];
        uint32_t from = i;
        if (token->kind == PLR_T_IDENT) {
            if (unit->actions[token->value] == PLR_ACTION_COPY &&
                !(token->flags & (PLR_TF_DROP | PLR_TF_LOCAL)))
                plr_copy_token(p, token), i++;
            else
                i = plr_print_ident(p, i);
        } else if (token->kind == PLR_T_DIRECTIVE) {
            print_directive(p, i);
            i = unit->activity ? unit->activity->next[token->value]
                               : unit->lexed->directives.items[token->value].end;
            continue;
        } else if (token->kind == PLR_T_PLUG) {
            i = print_plug(p, i);
            continue;
        } else if (token->kind == PLR_T_DECLARATIONS) {
            i++;
            continue;
        } else {
            plr_copy_token(p, token);
            if (i == p->body)
                print_gate(p);
            i++;
            if (p->inside && token->kind == p->inside_of) {
                plr_socket *socket = p->inside;
                p->inside = NULL;
                print_calls(p, socket, "", "");
                p->last = token->offset + 1;
            }
        }
        for (; p->closer_count && from < i; from++)
            plr_put_closers(p, from);
    }
}

void plr_print_range(plr_printer *p, plr_node *node, uint32_t first, uint32_t end) {
    p->node = node;
    p->unit = node->unit;
    p->fresh = true;
    p->broken = false;
    p->begin = p->end = p->last = 0;
    p->before = ';';
    p->inside = NULL;
    p->body = node->item->kind == PLR_ITEM_FUNCTION && plr_gate_of(p->l, node) ? node->item->body
                                                                               : PLR_NONE;
    p->closer_count = 0;
    plr_put_tokens(p, first, end);
    plr_flush(p);
}

void plr_print_line_end(plr_printer *p, const char *text) {
    plr_flush(p);
    plr_put(p, text, strlen(text));
    plr_put(p, "\n", 1);
}

void plr_print_extensions(plr_printer *p, plr_node *node) {
    const plr_lexed *lexed = node->unit->lexed;
    const plr_activity *activity = node->unit->activity;
    p->node = node;
    p->unit = node->unit;
    for (uint32_t i = node->item->first; i < node->item->end;) {
        const plr_token *token = &lexed->tokens.items[i];
        if (token->kind != PLR_T_DIRECTIVE) {
            i++;
            continue;
        }
        const plr_directive *directive = &lexed->directives.items[token->value];
        if (directive->kind == PLR_D_EXTENSION) {
            plr_add_run(p, p->unit->number, token->offset | PLR_RUN_FIXED);
            plr_put(p, "#extension", 10);
            print_condition(p, directive);
            plr_put(p, "\n", 1);
        } else if (activity && activity->kept[token->value] > PLR_KEPT_AS_IS) {
            print_directive(p, i);
        }
        i = activity ? activity->next[token->value] : directive->end;
    }
}
