#include "tools/plugray/plugs_chain.h"

#include <stdlib.h>

#include "tools/plugray/files.h"
#include "tools/plugray/json.h"
#include "tools/plugray/listing.h"
#include "tools/plugray/report.h"

/* A thing that is drawn, and the calls that are made for it. */
typedef struct chain {
    plr_drawable drawable;
    plr_program *program;
    const plr_effect *effects;
    plr_call_info *calls;
    size_t count;
} chain;

/* Calls of a function of another volume, and what these call, are left out. */
static void keep_own(chain *c, plr_view *view, size_t index) {
    size_t kept = 0;
    unsigned out = 0; /* depth of the call that was left out, + 1; 0: none */
    for (size_t i = 0; i < c->count; i++) {
        const plr_call_info *call = &c->calls[i];
        if (out && call->depth >= out)
            continue;
        out = plr_view_drawable_has(view, index, call->effect) ? 0 : call->depth + 1;
        if (!out)
            c->calls[kept++] = *call;
    }
    c->count = kept;
}

static chain chain_of(plr_view *view, size_t index) {
    chain c = {0};
    size_t effect_count;
    plr_view_drawable(view, index, &c.drawable);
    c.program = plr_view_link_drawable(view, index, &c.effects, &effect_count);
    if (!c.program)
        return c;
    c.count = plr_program_calls(c.program, NULL, 0);
    c.calls = memory_array(NULL, c.count + 1, sizeof *c.calls);
    plr_program_calls(c.program, c.calls, c.count);
    keep_own(&c, view, index);
    return c;
}

static void free_chain(chain *c) {
    plr_program_destroy(&c->program);
    free(c->calls);
}

/* ---- Text ---- */

static void print_head(const plr_drawable *drawable) {
    const char *def = drawable->node ? plr_node_def(drawable->node) : NULL;
    printf("%s: %s", drawable->kind, drawable->node ? plr_node_type(drawable->node) : "-");
    if (def) {
        putchar(' ');
        print_plain(def);
    }
    if (drawable->node) {
        fputs(" at ", stdout);
        print_place(plr_node_place(drawable->node));
    }
    if (drawable->program)
        printf(", program %s\n", drawable->program->name);
    else
        puts(", not drawn");
}

static void print_call(const chain *c, const plr_call_info *call) {
    char buffer[32];
    printf("%*s%s: ", 4 + 2 * (int)(call->depth < 30 ? call->depth : 30), "",
           plr_program_plug(c->program, call->plug)->name);
    print_plain(effect_label(c->effects, call->effect, buffer));
    fputs(" at ", stdout);
    print_place(call->function);
    putchar('\n');
}

static void print_chain(const chain *c) {
    plr_stage stage = PLR_STAGE_COUNT;
    print_head(&c->drawable);
    for (size_t i = 0; i < c->count; i++) {
        plr_stage at = plr_program_plug(c->program, c->calls[i].plug)->stage;
        if (at != stage)
            printf("  %s\n", plr_stage_text(stage = at));
        print_call(c, &c->calls[i]);
    }
    if (c->program && !c->count)
        puts("  calls nothing");
}

void print_chains(plr_view *view) {
    for (size_t i = 0; i < plr_view_drawable_count(view); i++) {
        chain c = chain_of(view, i);
        if (i)
            putchar('\n');
        print_chain(&c);
        free_chain(&c);
    }
}

/* ---- JSON ---- */

static void write_call(const chain *c, const plr_call_info *call) {
    char buffer[32];
    const plr_plug_info *plug = plr_program_plug(c->program, call->plug);
    printf("      {\"stage\": \"%s\", \"plug\": ", plr_stage_text(plug->stage));
    json_string(stdout, plug->name);
    printf(", \"depth\": %u, \"effect\": ", call->depth);
    json_string(stdout, effect_label(c->effects, call->effect, buffer));
    printf(", \"builtin\": %s, \"function\": ",
           c->effects[call->effect].builtin ? "true" : "false");
    write_place(call->function);
    fputs(", \"offered_by\": ", stdout);
    json_string(stdout, plug->effect == PLR_NO_EFFECT
                            ? NULL
                            : effect_label(c->effects, plug->effect, buffer));
    fputs(", \"offered_at\": ", stdout);
    write_place(plug->place);
    putchar('}');
}

static void write_chain(const chain *c) {
    const plr_drawable *d = &c->drawable;
    printf("    {\"kind\": \"%s\", \"node\": ", d->kind);
    json_string(stdout, d->node ? plr_node_type(d->node) : NULL);
    fputs(", \"def\": ", stdout);
    json_string(stdout, d->node ? plr_node_def(d->node) : NULL);
    fputs(", \"place\": ", stdout);
    write_place(d->node ? plr_node_place(d->node) : (plr_place){NULL, 0, 0});
    fputs(", \"program\": ", stdout);
    json_string(stdout, d->program ? d->program->name : NULL);
    fputs(",\n     \"calls\": [", stdout);
    for (size_t i = 0; i < c->count; i++) {
        fputs(i ? ",\n" : "\n", stdout);
        write_call(c, &c->calls[i]);
    }
    fputs("]}", stdout);
}

void write_chains(plr_view *view) {
    fputs("{\"drawables\": [", stdout);
    for (size_t i = 0; i < plr_view_drawable_count(view); i++) {
        chain c = chain_of(view, i);
        fputs(i ? ",\n" : "\n", stdout);
        write_chain(&c);
        free_chain(&c);
    }
    puts("]}");
}
