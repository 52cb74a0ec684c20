#include "plugs/mark.h"

typedef struct marker {
    plr_arena *arena;
    plr_lexed *lexed;
    plr_token *tokens;
    PLR_LIST(uint32_t) open;   /* brackets that wait for their match */
    PLR_LIST(size_t) branches; /* how many were open at each #if */
    bool balanced;             /* no conditional opens or closes a bracket on its own */
    uint32_t *local, *seen;    /* function number by identifier */
    uint32_t function;
} marker;

static bool has_kind(const plr_lexed *lexed, uint32_t token, unsigned kinds) {
    const plr_token *t = &lexed->tokens.items[token];
    return t->kind == PLR_T_IDENT &&
           (plr_word_get(lexed->idents.items[t->value].word)->kinds & kinds) != 0;
}

static bool is_word(const plr_lexed *lexed, uint32_t token, uint16_t word) {
    const plr_token *t = &lexed->tokens.items[token];
    return t->kind == PLR_T_IDENT && lexed->idents.items[t->value].word == word;
}

static char closing(uint8_t open) {
    return open == '(' ? ')' : open == '[' ? ']' : '}';
}

static void match_close(marker *m, uint32_t i, size_t floor) {
    if (m->open.count <= floor)
        return;
    uint32_t open = m->open.items[m->open.count - 1];
    if (closing(m->tokens[open].kind) != (char)m->tokens[i].kind)
        return;
    m->open.count--;
    m->tokens[open].value = i;
    m->tokens[i].value = open;
    bool empty = i == open + 1 || (i == open + 2 && is_word(m->lexed, open + 1, PLR_WORD_void));
    if (m->tokens[open].kind != '(')
        return;
    if (empty)
        m->tokens[open].count = 0;
    else if (m->tokens[open].count < UINT16_MAX)
        m->tokens[open].count++;
}

static void match_token(marker *m, uint32_t i, size_t floor) {
    switch (m->tokens[i].kind) {
    case '(':
    case '[':
    case '{':
        m->tokens[i].count = 0;
        *PLR_PUSH(m->arena, &m->open) = i;
        break;
    case ')':
    case ']':
    case '}':
        match_close(m, i, floor);
        break;
    case ',':
        if (m->open.count > floor) {
            plr_token *open = &m->tokens[m->open.items[m->open.count - 1]];
            if (open->kind == '(' && open->count < UINT16_MAX)
                open->count++;
        }
        break;
    default:
        break;
    }
}

/* A branch begins with the brackets open that were open before the #if. */
static void match_branch(marker *m, const plr_directive *directive) {
    if (directive->kind >= PLR_D_IF && directive->kind <= PLR_D_IFNDEF) {
        *PLR_PUSH(m->arena, &m->branches) = m->open.count;
    } else if (directive->kind >= PLR_D_ELIF && directive->kind <= PLR_D_ENDIF &&
               m->branches.count) {
        size_t before = m->branches.items[m->branches.count - 1];
        m->balanced &= m->open.count == before;
        if (directive->kind == PLR_D_ENDIF)
            m->branches.count--;
        else if (m->open.count > before)
            m->open.count = before;
    }
}

static void match_brackets(marker *m) {
    const plr_lexed *lexed = m->lexed;
    for (uint32_t i = 0; m->tokens[i].kind != PLR_T_END; i++) {
        uint8_t kind = m->tokens[i].kind;
        if (kind != PLR_T_DIRECTIVE && kind != PLR_T_PLUG) {
            match_token(m, i, 0);
            continue;
        }
        uint32_t end = kind == PLR_T_PLUG ? lexed->plugs.items[m->tokens[i].value].end
                                          : lexed->directives.items[m->tokens[i].value].end;
        if (kind == PLR_T_DIRECTIVE)
            match_branch(m, &lexed->directives.items[m->tokens[i].value]);
        size_t floor = m->open.count;
        for (i++; i < end; i++)
            match_token(m, i, floor);
        m->open.count = floor;
        i--;
    }
}

/* The token after a directive or plug that begins at `i`, or `i` itself. */
static uint32_t skip_inert(const plr_lexed *lexed, uint32_t i) {
    for (;;) {
        const plr_token *token = &lexed->tokens.items[i];
        if (token->kind == PLR_T_DIRECTIVE)
            i = lexed->directives.items[token->value].end;
        else if (token->kind == PLR_T_PLUG)
            i = lexed->plugs.items[token->value].end;
        else if (token->kind == PLR_T_DECLARATIONS)
            i++;
        else
            return i;
    }
}

void plr_each_member(const plr_lexed *lexed, uint32_t open, uint32_t close,
                     plr_member_function *found, void *user) {
    const plr_token *tokens = lexed->tokens.items;
    uint32_t before = open, depth = 0; /* the token before, less directives */
    for (uint32_t i = skip_inert(lexed, open + 1); i < close; i = skip_inert(lexed, i + 1)) {
        uint8_t kind = tokens[i].kind;
        if (kind == '(' || kind == '[' || kind == '{')
            depth++;
        else if (kind == ')' || kind == ']' || kind == '}')
            depth -= depth > 0;
        uint32_t next = skip_inert(lexed, i + 1);
        uint8_t follows = tokens[next].kind;
        if (kind == PLR_T_IDENT && depth == 0 && before != open &&
            (follows == ';' || follows == ',' || follows == '[') &&
            (tokens[before].kind == ']' || tokens[before].kind == ',' ||
             tokens[before].kind == '}' ||
             (tokens[before].kind == PLR_T_IDENT &&
              !has_kind(lexed, before, PLR_WORD_IS_QUALIFIER))))
            found(user, i);
        before = i;
    }
}

static void mark_plain(void *user, uint32_t token) {
    ((plr_token *)user)[token].flags |= PLR_TF_PLAIN;
}

/* Members of `struct S { }` and of blocks with an instance name, keys of `layout ( )`. */
static void mark_members(marker *m) {
    const plr_lexed *lexed = m->lexed;
    plr_token *tokens = m->tokens;
    uint32_t end = (uint32_t)lexed->tokens.count - 1;
    for (uint32_t i = 0; i < end; i++) {
        if (tokens[i].kind == '{' && tokens[i].value != PLR_NONE && i >= 2) {
            bool is_struct =
                is_word(lexed, i - 1, PLR_WORD_struct) || is_word(lexed, i - 2, PLR_WORD_struct);
            uint8_t after = tokens[tokens[i].value + 1].kind;
            bool block =
                tokens[i - 1].kind == PLR_T_IDENT && after == PLR_T_IDENT &&
                (tokens[i - 2].kind == ')' || has_kind(lexed, i - 2, PLR_WORD_IS_QUALIFIER));
            if (is_struct || block)
                plr_each_member(lexed, i, tokens[i].value, mark_plain, tokens);
        } else if (tokens[i].kind == '{' && tokens[i].value != PLR_NONE && i == 1 &&
                   is_word(lexed, 0, PLR_WORD_struct)) {
            plr_each_member(lexed, i, tokens[i].value, mark_plain, tokens);
        } else if (is_word(lexed, i, PLR_WORD_layout) && tokens[i + 1].kind == '(' &&
                   tokens[i + 1].value != PLR_NONE) {
            for (uint32_t k = i + 2; k < tokens[i + 1].value; k++)
                if (tokens[k].kind == PLR_T_IDENT &&
                    (tokens[k - 1].kind == '(' || tokens[k - 1].kind == ','))
                    tokens[k].flags |= PLR_TF_PLAIN;
        }
    }
}

/* `inout in`, `in inout`, `const inout`, `in const`: what some compilers take keeps one meaning. */
static void mark_doubled(marker *m, uint32_t i) {
    uint16_t first = m->lexed->idents.items[m->tokens[i].value].word;
    uint16_t second = m->lexed->idents.items[m->tokens[i + 1].value].word;
    if (second == PLR_WORD_const || (first == second && first != PLR_WORD_const) ||
        (first == PLR_WORD_inout && second != PLR_WORD_const))
        m->tokens[i + 1].flags |= PLR_TF_DROP;
    else if (second == PLR_WORD_inout || (first == PLR_WORD_const && second == PLR_WORD_out))
        m->tokens[i].flags |= PLR_TF_DROP;
}

/* Whether a word that became reserved is a name here: a qualifier stands before another word, a
 * built-in function before a parenthesis or alone in a macro (#define texture2D texture). */
static bool is_name_use(const marker *m, uint32_t i, uint8_t before, bool in_directive) {
    const plr_token *token = &m->tokens[i];
    unsigned kinds = plr_word_get(m->lexed->idents.items[token->value].word)->kinds;
    uint8_t next = token[1].kind;
    if (!(kinds & PLR_WORD_IS_SINCE) || token->flags & PLR_TF_MEMBER)
        return false;
    if (token->flags & PLR_TF_PLAIN && (before == '(' || next == ')'))
        return false; /* a key of layout */
    if (next == '(')
        return !(kinds & PLR_WORD_IS_BUILTIN) && before == PLR_T_IDENT &&
               !has_kind(m->lexed, i - 1, PLR_WORD_IS_KEYWORD | PLR_WORD_IS_QUALIFIER);
    if (in_directive && kinds & PLR_WORD_IS_BUILTIN)
        return false;
    return next != PLR_T_IDENT;
}

/* Words that became reserved and that the text uses as names: sampler2D texture, float sample = ...
 */
static void mark_declared_words(marker *m) {
    plr_lexed *lexed = m->lexed;
    uint32_t end = (uint32_t)lexed->tokens.count - 1;
    uint32_t barrier = 0; /* the token after a directive */
    for (uint32_t i = 0; i < end; i++) {
        const plr_token *token = &m->tokens[i];
        if (token->kind == PLR_T_DIRECTIVE)
            barrier = lexed->directives.items[token->value].end;
        if (token->kind != PLR_T_IDENT || i == 0)
            continue;
        plr_ident *ident = &lexed->idents.items[token->value];
        if (ident->word == PLR_WORD_NONE)
            continue;
        lexed->dynamic |= ident->word == PLR_WORD_PLUG_USED || ident->word == PLR_WORD_READS;
        uint8_t next = m->tokens[i + 1].kind;
        if ((m->tokens[i - 1].kind == '(' || m->tokens[i - 1].kind == ',') && next == PLR_T_IDENT &&
            (has_kind(lexed, i, PLR_WORD_IS_INOUT) || ident->word == PLR_WORD_const) &&
            (has_kind(lexed, i + 1, PLR_WORD_IS_INOUT) || is_word(lexed, i + 1, PLR_WORD_const)))
            mark_doubled(m, i);
        if (is_name_use(m, i, i == barrier ? ';' : m->tokens[i - 1].kind, i < barrier))
            ident->flags |= PLR_IF_DECLARED;
    }
}

/* ---- Locals ------------------------------------------------------------------------------------
 */

/* The parameters between the parentheses: the last word of each, outside its brackets. */
static void collect_parameters(marker *m, uint32_t open, uint32_t close) {
    uint32_t name = PLR_NONE, words = 0, depth = 0;
    for (uint32_t i = skip_inert(m->lexed, open + 1); i <= close; i = skip_inert(m->lexed, i + 1)) {
        uint8_t kind = m->tokens[i].kind;
        if (depth == 0 && (kind == ',' || i == close)) {
            if (words >= 2) {
                m->local[m->tokens[name].value] = m->function;
                m->tokens[name].flags |= PLR_TF_LOCAL;
            }
            words = 0;
        } else if (kind == '[' || kind == '(') {
            depth++;
        } else if (kind == ']' || kind == ')') {
            depth -= depth > 0;
        } else if (kind == PLR_T_IDENT && depth == 0) {
            words++;
            name = i;
        }
    }
}

/* A declaration `[const] Type name` followed by one of = ; , [ that begins at `i`: its name. */
static uint32_t declared_at(const marker *m, uint32_t i) {
    while (has_kind(m->lexed, i, PLR_WORD_IS_QUALIFIER))
        i++;
    if (m->tokens[i].kind != PLR_T_IDENT || has_kind(m->lexed, i, PLR_WORD_IS_KEYWORD))
        return PLR_NONE;
    const plr_token *name = &m->tokens[i + 1];
    if (name->kind != PLR_T_IDENT || m->seen[name->value] == m->function)
        return PLR_NONE;
    uint8_t after = m->tokens[i + 2].kind;
    return after == '=' || after == ';' || after == ',' || after == '[' ? i + 1 : PLR_NONE;
}

static bool begins_statement(uint8_t before) {
    return before == ';' || before == '{' || before == '}';
}

/* One function body: what its parameters and the variables of its outermost block hide. A variable
 * hides only from the end of its declaration on, and only if no other meaning was used before. */
static void mark_body(marker *m, uint32_t open, uint32_t close) {
    plr_token *tokens = m->tokens;
    uint32_t depth = 1, conditionals = 0, pending = PLR_NONE, plug_end = 0;
    uint8_t before = '{';
    for (uint32_t i = open + 1; i < close; i++) {
        plr_token *token = &tokens[i];
        if (token->kind == PLR_T_PLUG)
            plug_end = m->lexed->plugs.items[token->value].end;
        if (i == plug_end)
            before = ';'; /* what a plug offers declares nothing, and ends as a call does */
        if (token->kind == PLR_T_DIRECTIVE) {
            const plr_directive *directive = &m->lexed->directives.items[token->value];
            conditionals += directive->kind >= PLR_D_IF && directive->kind <= PLR_D_IFNDEF;
            conditionals -= directive->kind == PLR_D_ENDIF && conditionals > 0;
            i = directive->end - 1;
            continue;
        }
        if (depth == 1 && conditionals == 0 && i >= plug_end && begins_statement(before) &&
            pending == PLR_NONE)
            pending = declared_at(m, i);
        if (token->kind == PLR_T_IDENT && !(token->flags & PLR_TF_MEMBER)) {
            if (m->local[token->value] == m->function || i == pending)
                token->flags |= PLR_TF_LOCAL;
            m->seen[token->value] = m->function;
        }
        depth += token->kind == '{';
        depth -= token->kind == '}';
        if (token->kind == ';' && pending != PLR_NONE) {
            m->local[tokens[pending].value] = m->function;
            pending = PLR_NONE;
        }
        before = token->kind;
    }
}

static void mark_locals(marker *m) {
    const plr_lexed *lexed = m->lexed;
    m->local = PLR_NEW_ARRAY(m->arena, lexed->idents.count + 1, uint32_t);
    m->seen = PLR_NEW_ARRAY(m->arena, lexed->idents.count + 1, uint32_t);
    for (uint32_t i = 0; m->tokens[i].kind != PLR_T_END; i++) {
        const plr_token *token = &m->tokens[i];
        if (token->kind == PLR_T_DIRECTIVE) {
            i = lexed->directives.items[token->value].end - 1;
            continue;
        }
        if (token->kind != '{' || token->value == PLR_NONE)
            continue;
        uint32_t close = i ? i - 1 : 0;
        uint32_t open = m->tokens[close].kind == ')' ? m->tokens[close].value : PLR_NONE;
        if (open != PLR_NONE && open >= 2 && m->tokens[open - 1].kind == PLR_T_IDENT) {
            m->function++;
            collect_parameters(m, open, close);
            mark_body(m, i, token->value);
        }
        i = token->value;
    }
}

void plr_mark(plr_arena *arena, plr_lexed *lexed) {
    marker m = {.arena = arena, .lexed = lexed, .tokens = lexed->tokens.items, .balanced = true};
    match_brackets(&m);
    mark_members(&m);
    mark_declared_words(&m);
    if (m.balanced)
        mark_locals(&m);
}
