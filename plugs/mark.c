#include "plugs/mark.h"

/* A name that a local variable hides up to a token. */
typedef struct hidden {
    uint32_t ident, before /* its marker.local outside */, end;
} hidden;

typedef struct marker {
    plr_arena *arena;
    plr_lexed *lexed;
    plr_token *tokens;
    PLR_LIST(uint32_t) open;   /* brackets that wait for their match */
    PLR_LIST(size_t) branches; /* how many were open at each #if */
    bool balanced;             /* no conditional opens or closes a bracket on its own */
    uint32_t *local;           /* by identifier: the function in which it is hidden at the scan */
    bool *in_macro;            /* by identifier: a #define of the unit names it */
    uint32_t function;
    PLR_LIST(hidden) hidden;
    PLR_LIST(uint32_t) blocks; /* closing braces of those that are open in the function */
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
    plr_lexed *lexed = user;
    lexed->tokens.items[token].flags |= PLR_TF_PLAIN;
    lexed->idents.items[lexed->tokens.items[token].value].flags |= PLR_IF_MEMBER;
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
                plr_each_member(lexed, i, tokens[i].value, mark_plain, m->lexed);
        } else if (tokens[i].kind == '{' && tokens[i].value != PLR_NONE && i == 1 &&
                   is_word(lexed, 0, PLR_WORD_struct)) {
            plr_each_member(lexed, i, tokens[i].value, mark_plain, m->lexed);
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
    uint32_t barrier = 0, name = 0; /* the token after a directive, and its first */
    for (uint32_t i = 0; i < end; i++) {
        const plr_token *token = &m->tokens[i];
        if (token->kind == PLR_T_DIRECTIVE) {
            barrier = lexed->directives.items[token->value].end;
            name = i + 1;
        }
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
        if (is_name_use(m, i, i == barrier ? ';' : m->tokens[i - 1].kind, i < barrier && i != name))
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
            if (words >= 2 && !m->in_macro[m->tokens[name].value]) {
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

static bool ends_name(uint8_t kind) {
    return kind == '=' || kind == ';' || kind == ',' || kind == '[';
}

/* A declaration `[const] Type name` followed by one of = ; , [ that begins at `i`: its name. */
static uint32_t declared_at(const marker *m, uint32_t i) {
    while (has_kind(m->lexed, i, PLR_WORD_IS_QUALIFIER))
        i++;
    bool words = m->tokens[i].kind == PLR_T_IDENT && m->tokens[i + 1].kind == PLR_T_IDENT;
    if (!words || has_kind(m->lexed, i, PLR_WORD_IS_KEYWORD))
        return PLR_NONE;
    return ends_name(m->tokens[i + 2].kind) ? i + 1 : PLR_NONE;
}

static bool begins_statement(uint8_t before) {
    return before == ';' || before == '{' || before == '}' || before == ':';
}

/* Where the scope ends of what the header of a `for` declares; 0: that cannot be told. */
static uint32_t loop_end(const marker *m, uint32_t open) {
    const plr_token *tokens = m->tokens;
    if (tokens[open].kind != '(' || tokens[open].value == PLR_NONE)
        return 0;
    uint32_t i = tokens[open].value + 1;
    if (tokens[i].kind == '{')
        return tokens[i].value == PLR_NONE ? 0 : tokens[i].value;
    if (has_kind(m->lexed, i, PLR_WORD_IS_KEYWORD))
        return 0;
    for (; tokens[i].kind != ';'; i++) {
        uint8_t kind = tokens[i].kind;
        if (kind == PLR_T_DIRECTIVE || kind == PLR_T_PLUG || kind == '{' || kind == '}' ||
            kind == PLR_T_END)
            return 0;
    }
    return i;
}

/* The scan of a function's body. */
typedef struct body_scan {
    uint32_t pending;          /* the name whose declarator the scan stands in */
    uint32_t end;              /* of its scope */
    uint32_t nesting, outside; /* brackets since the declaration began; those around it */
} body_scan;

/* Whether a declaration begins at `i`: of a variable of the block, or of a loop. */
static void begin_declaration(const marker *m, body_scan *scan, uint32_t i) {
    uint32_t block = m->blocks.items[m->blocks.count - 1];
    bool loop = is_word(m->lexed, i, PLR_WORD_for);
    *scan = (body_scan){PLR_NONE, loop ? loop_end(m, i + 1) : block, 0, loop};
    if (scan->end > 0 && scan->end <= block)
        scan->pending = declared_at(m, loop ? i + 2 : i);
}

/* Behind its declarator a variable hides what has its name outside. */
static void pass_declarator(marker *m, body_scan *scan, uint32_t i) {
    const plr_token *tokens = m->tokens;
    uint8_t kind = tokens[i].kind;
    scan->nesting += kind == '(' || kind == '[' || kind == '{';
    scan->nesting -= (kind == ')' || kind == ']' || kind == '}') && scan->nesting > 0;
    if (i <= scan->pending || scan->nesting != scan->outside || (kind != ',' && kind != ';'))
        return;
    uint32_t ident = tokens[scan->pending].value;
    *PLR_PUSH(m->arena, &m->hidden) = (hidden){ident, m->local[ident], scan->end};
    m->local[ident] = m->function;
    bool more = kind == ',' && tokens[i + 1].kind == PLR_T_IDENT && ends_name(tokens[i + 2].kind);
    scan->pending = more ? i + 1 : PLR_NONE;
}

static void leave_scopes(marker *m, uint32_t i) {
    while (m->hidden.count && m->hidden.items[m->hidden.count - 1].end <= i) {
        const hidden *last = &m->hidden.items[--m->hidden.count];
        m->local[last->ident] = last->before;
    }
}

static void mark_token(marker *m, body_scan *scan, uint32_t i) {
    plr_token *token = &m->tokens[i];
    if (token->kind == PLR_T_IDENT && !(token->flags & PLR_TF_MEMBER) &&
        !m->in_macro[token->value] && (m->local[token->value] == m->function || i == scan->pending))
        token->flags |= PLR_TF_LOCAL;
    if (scan->pending != PLR_NONE)
        pass_declarator(m, scan, i);
    if (token->kind == '{')
        *PLR_PUSH(m->arena, &m->blocks) = token->value;
    else if (token->kind == '}' && m->blocks.count > 1)
        m->blocks.count--;
}

/* One function body: what its parameters and variables hide. */
static void mark_body(marker *m, uint32_t open, uint32_t close) {
    uint32_t conditionals = 0, plug_end = 0;
    uint8_t before = '{';
    body_scan scan = {.pending = PLR_NONE};
    m->blocks.count = 0;
    *PLR_PUSH(m->arena, &m->blocks) = close;
    for (uint32_t i = open + 1; i < close; i++) {
        const plr_token *token = &m->tokens[i];
        leave_scopes(m, i);
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
        if (token->kind == PLR_T_IDENT && conditionals == 0 && i >= plug_end &&
            scan.pending == PLR_NONE && begins_statement(before))
            begin_declaration(m, &scan, i);
        mark_token(m, &scan, i);
        before = token->kind;
    }
    leave_scopes(m, PLR_NONE);
}

/* Names in #defines: what they mean depends on where the macro is used, so all keep one name. */
static void note_macros(marker *m) {
    for (size_t d = 0; d < m->lexed->directives.count; d++) {
        const plr_directive *directive = &m->lexed->directives.items[d];
        for (uint32_t i = directive->token + 2;
             directive->kind == PLR_D_DEFINE && i < directive->end; i++)
            if (m->tokens[i].kind == PLR_T_IDENT &&
                !(m->tokens[i].flags & (PLR_TF_PARAM | PLR_TF_MEMBER)))
                m->in_macro[m->tokens[i].value] = true;
    }
}

static void mark_locals(marker *m) {
    const plr_lexed *lexed = m->lexed;
    m->local = PLR_NEW_ARRAY(m->arena, lexed->idents.count + 1, uint32_t);
    m->in_macro = PLR_NEW_ARRAY(m->arena, lexed->idents.count + 1, bool);
    note_macros(m);
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
