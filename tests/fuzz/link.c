/* Fuzzes the linker. The bytes are texts, separated by lines that begin with "%%": %%B base,
 * %%L library, %%E a new effect, %%U another unit of it; then v or g for another stage than the
 * fragment's, b for built-in, l for local to the first effect, - < = x for placements. */
#include <plugray/plugs.h>

#include <stdlib.h>
#include <string.h>

enum {
    MOST = 32
};

typedef struct job {
    plr_source *base[MOST], *library[MOST], *units[MOST][4];
    plr_effect effects[MOST];
    size_t base_count, library_count, effect_count;
    bool keep_all;
} job;

static plr_source *read_text(const char *head, size_t head_length, const char *text,
                             size_t length) {
    plr_stage stage = memchr(head, 'v', head_length)   ? PLR_VERTEX
                      : memchr(head, 'g', head_length) ? PLR_GEOMETRY
                                                       : PLR_FRAGMENT;
    plr_origin origin = {.file = "fuzz"};
    return plr_source_read(stage, text, length, &origin, NULL, NULL);
}

static void set_options(plr_effect *effect, const char *head, size_t length, size_t count) {
    effect->name = "Style";
    effect->builtin = memchr(head, 'b', length);
    effect->attached = count && memchr(head, 'l', length) ? 1 : 0;
    effect->only_if_active = memchr(head, 'o', length);
    effect->placement = memchr(head, '<', length)   ? PLR_ADD_BEFORE
                        : memchr(head, '=', length) ? PLR_REPLACE
                        : memchr(head, 'x', length) ? PLR_REMOVE
                                                    : PLR_ADD_AFTER;
    effect->target = memchr(head, 't', length) ? "Style" : NULL;
}

static void add_text(job *j, const char *head, size_t head_length, const char *text,
                     size_t length) {
    char kind = head_length > 2 ? head[2] : 'E';
    j->keep_all |= kind == 'K';
    if (kind == 'B' && j->base_count < MOST) {
        j->base[j->base_count++] = read_text(head, head_length, text, length);
    } else if (kind == 'L' && j->library_count < MOST) {
        j->library[j->library_count++] = read_text(head, head_length, text, length);
    } else if (kind == 'U' && j->effect_count && j->effects[j->effect_count - 1].source_count < 4) {
        plr_effect *effect = &j->effects[j->effect_count - 1];
        j->units[j->effect_count - 1][effect->source_count++] =
            read_text(head, head_length, text, length);
    } else if (kind == 'E' && j->effect_count < MOST) {
        plr_effect *effect = &j->effects[j->effect_count];
        set_options(effect, head, head_length, j->effect_count);
        j->units[j->effect_count][0] = read_text(head, head_length, text, length);
        effect->sources = (const plr_source *const *)j->units[j->effect_count++];
        effect->source_count = 1;
    }
}

static void split(job *j, const char *text, size_t length) {
    const char *head = "%%B", *begin = text, *end = text + length;
    size_t head_length = 3;
    for (const char *line = text; line < end;) {
        const char *newline = memchr(line, '\n', (size_t)(end - line));
        const char *next = newline ? newline + 1 : end;
        if (end - line >= 2 && line[0] == '%' && line[1] == '%') {
            add_text(j, head, head_length, begin, (size_t)(line - begin));
            head = line;
            head_length = (size_t)((newline ? newline : end) - line);
            begin = next;
        }
        line = next;
    }
    add_text(j, head, head_length, begin, (size_t)(end - begin));
}

/* Every position of the program is asked for; what the answers say must be within the sources. */
static void look_around(const plr_program *program) {
    char buffer[64];
    for (int s = 0; s < PLR_STAGE_COUNT; s++) {
        size_t length;
        const char *text = plr_program_text(program, (plr_stage)s, &length);
        if (text && strlen(text) != length)
            abort();
        for (uint32_t line = 1; line <= plr_program_lines(program, (plr_stage)s); line++)
            for (uint32_t column = 0; column < 24; column += 7) {
                plr_mapped mapped;
                if (!plr_program_map(program, (plr_stage)s, line, column, &mapped))
                    abort();
                size_t size = 0;
                if (mapped.source)
                    plr_source_text(mapped.source, &size);
                if (mapped.offset > size)
                    abort();
                plr_program_find_word(program, (plr_stage)s, line, "x", 1);
            }
        if (text)
            plr_program_demangle(program, text, buffer, sizeof buffer);
    }
}

/* The calls are those that their plugs count. */
static void look_at_calls(const plr_program *program) {
    plr_call_info calls[64];
    size_t count = plr_program_calls(program, calls, 64);
    for (size_t i = 0; i < count && i < 64; i++) {
        const plr_plug_info *plug = plr_program_plug(program, calls[i].plug);
        if (!plug || !plug->call_count)
            abort();
    }
}

/* Members stand on lines that there are. */
static void look_at_members(const plr_program *program) {
    plr_member_use uses[64];
    for (int stage = 0; stage < PLR_STAGE_COUNT; stage++) {
        size_t count = plr_program_member_uses(program, (plr_stage)stage, "x", uses, 64);
        for (size_t i = 0; i < count && i < 64; i++)
            if (!uses[i].at.source && uses[i].at.place.file)
                abort();
    }
}

/* What an effect promises is said somewhere, as each of its functions would have it. */
static void look_at_promises(const plr_program *program) {
    for (size_t i = 0; i < plr_program_plug_count(program); i++)
        for (size_t call = 0; call < plr_program_plug(program, i)->call_count; call++) {
            plr_place place = {0};
            size_t effect = plr_program_plug_call(program, i, call, NULL);
            plr_promises made = plr_program_promises(program, effect);
            bool is_fragment = plr_program_plug(program, i)->stage == PLR_FRAGMENT;
            bool said = plr_program_promise_place(program, i, call, PLR_LIPSCHITZ, &place);
            if (is_fragment && made.lipschitz > 0 && (!said || !place.line))
                abort();
            if ((made.colour_only && !made.keeps_transparent) || !(made.lipschitz >= 0))
                abort();
        }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    job *j = calloc(1, sizeof *j);
    if (!j)
        return 0;
    split(j, (const char *)data, size);
    plr_link_desc desc = {.base = (const plr_source *const *)j->base,
                          .base_count = j->base_count,
                          .library = (const plr_source *const *)j->library,
                          .library_count = j->library_count,
                          .effects = j->effects,
                          .effect_count = j->effect_count,
                          .keep_all = j->keep_all};
    plr_diags *diags = plr_diags_create(NULL);
    plr_program *program = plr_link(&desc, diags);
    if (program) {
        look_around(program);
        look_at_calls(program);
        look_at_members(program);
        look_at_promises(program);
    }
    plr_program_destroy(&program);
    plr_diags_destroy(&diags);
    for (size_t i = 0; i < MOST; i++) {
        plr_source_destroy(&j->base[i]);
        plr_source_destroy(&j->library[i]);
        for (size_t u = 0; u < 4; u++)
            plr_source_destroy(&j->units[i][u]);
    }
    free(j);
    return 0;
}
