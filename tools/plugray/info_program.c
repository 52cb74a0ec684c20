/* What a program costs, and why: plugs, texture fetches, members of samples. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/plugray/files.h"
#include "tools/plugray/info.h"
#include "tools/plugray/info_words.h"
#include "tools/plugray/json.h"
#include "tools/plugray/listing.h"

/* What a sample of a volume has for those who ask, and what that takes. */
static const struct {
    const char *name, *from;
} members[] = {
    {"normal_eye", " (from the gradient)"},
    {"gradient", " (its magnitude)"},
    {"position", ""},
    {"position_eye", ""},
    {"step_length", ""},
    {"segment", ""},
    {"volume", ""},
};
enum {
    MEMBER_COUNT = sizeof members / sizeof *members,
    MOST_DRAWN = 8 /* lines of text; JSON has all */
};

/* A distinct program, linked for the first thing that it draws, so that places are that one's. */
typedef struct program_report {
    const plr_program_info *info;
    plr_program *linked; /* NULL: the view's own is used */
    const plr_program *program;
    const plr_effect *effects;
    size_t effect_count;
    plr_fetch_info *fetches;
    size_t fetch_count;
    bool is_volume;
} program_report;

static program_report report_of(plr_view *view, size_t index) {
    program_report r = {.info = plr_view_program(view, index)};
    plr_drawable drawable;
    for (size_t i = 0; !r.linked && plr_view_drawable(view, i, &drawable); i++)
        if (drawable.program == r.info)
            r.linked = plr_view_link_drawable(view, i, &r.effects, &r.effect_count);
    r.program = r.linked;
    if (!r.linked) {
        r.program = r.info->program;
        r.effects = r.info->effects;
        r.effect_count = r.info->effect_count;
    }
    r.fetch_count = plr_program_fetches(r.program, NULL, 0);
    r.fetches = memory_array(NULL, r.fetch_count + 1, sizeof *r.fetches);
    plr_program_fetches(r.program, r.fetches, r.fetch_count);
    r.is_volume = strncmp(r.info->name, "volume", 6) == 0;
    return r;
}

static void free_report(program_report *r) {
    plr_program_destroy(&r->linked);
    free(r->fetches);
}

/* ---- Effects ---- */

/* "ShadedVolumeStyle at scene.x3dv:12:3": the node that brings it. */
static void print_effect(const program_report *r, size_t effect) {
    char buffer[32];
    if (effect == PLR_NO_EFFECT) {
        fputs("the base", stdout);
        return;
    }
    print_plain(effect_label(r->effects, effect, buffer));
    if (r->effects[effect].place.file) {
        fputs(" at ", stdout);
        print_place(r->effects[effect].place);
    }
}

static void write_effect(const program_report *r, size_t effect) {
    char buffer[32];
    fputs("{\"effect\": ", stdout);
    json_string(stdout, effect == PLR_NO_EFFECT ? NULL : effect_label(r->effects, effect, buffer));
    fputs(", \"place\": ", stdout);
    write_place(effect == PLR_NO_EFFECT ? (plr_place){NULL, 0, 0} : r->effects[effect].place);
    putchar('}');
}

/* The effects that read, or compute, a member; each once, in the order of the program. */
typedef struct user_list {
    size_t *items;
    size_t count;
} user_list;

static user_list users_of(const program_report *r, const char *member, bool written) {
    size_t count = plr_program_member_uses(r->program, PLR_FRAGMENT, member, NULL, 0);
    plr_member_use *uses = memory_array(NULL, count + 1, sizeof *uses);
    user_list list = {memory_array(NULL, r->effect_count + 1, sizeof *list.items), 0};
    bool *seen = memory_array(NULL, r->effect_count + 1, sizeof *seen);
    memset(seen, 0, (r->effect_count + 1) * sizeof *seen);
    plr_program_member_uses(r->program, PLR_FRAGMENT, member, uses, count);
    for (size_t i = 0; i < count; i++) {
        size_t effect = uses[i].at.effect;
        size_t slot = effect < r->effect_count ? effect : r->effect_count;
        if (uses[i].written != written || seen[slot])
            continue;
        seen[slot] = true;
        list.items[list.count++] = effect;
    }
    free(uses);
    free(seen);
    return list;
}

/* ---- Text ---- */

static void print_drawn(const program_report *r, const plr_view *view) {
    plr_drawable drawable;
    size_t count = 0;
    for (size_t i = 0; plr_view_drawable(view, i, &drawable); i++) {
        if (drawable.program != r->info || !drawable.node || count++ >= MOST_DRAWN)
            continue;
        fputs("        draws ", stdout);
        print_node(drawable.node);
        putchar('\n');
    }
    if (count > MOST_DRAWN)
        printf("        and %zu others\n", count - MOST_DRAWN);
}

static void print_plugs(const program_report *r) {
    for (size_t i = 0; i < plr_program_plug_count(r->program); i++) {
        const plr_plug_info *plug = plr_program_plug(r->program, i);
        if (!plug->call_count)
            continue;
        printf("        plug %s (%s) of ", plug->name, plr_stage_text(plug->stage));
        print_effect(r, plug->effect);
        puts(", used by");
        for (size_t call = 0; call < plug->call_count; call++) {
            fputs("            ", stdout);
            print_effect(r, plr_program_plug_call(r->program, i, call, NULL));
            putchar('\n');
        }
    }
}

static void print_fetches(const program_report *r) {
    for (size_t i = 0; i < r->fetch_count; i++) {
        const plr_fetch_info *fetch = &r->fetches[i];
        printf("        %u %s of ", fetch->count, fetch->count == 1 ? "fetch" : "fetches");
        print_plain(fetch->sampler ? fetch->sampler : "a texture");
        fputs(", for ", stdout);
        print_effect(r, fetch->effect);
        fputs(", at ", stdout);
        print_place(fetch->place);
        putchar('\n');
    }
}

static void print_members(const program_report *r) {
    for (size_t m = 0; m < MEMBER_COUNT; m++) {
        user_list readers = users_of(r, members[m].name, false);
        for (size_t i = 0; i < readers.count; i++) {
            printf("        %s%s is read by ", members[m].name, members[m].from);
            print_effect(r, readers.items[i]);
            putchar('\n');
        }
        free(readers.items);
    }
}

/* Whether a gradient of the effect is left in the compiled program: the text may compute one that
 * nothing of this volume reads. Central differences take six fetches in one line, where they are
 * not held in a texture. */
static bool fetches_gradient(const program_report *r, size_t effect) {
    for (size_t i = 0; i < r->fetch_count; i++)
        if (r->fetches[i].effect == effect &&
            (r->fetches[i].count >= 6 ||
             (r->fetches[i].sampler && strcmp(r->fetches[i].sampler, "voxelGradients") == 0)))
            return true;
    return false;
}

/* Volumes whose samples have a gradient. */
static size_t count_gradients(const program_report *r) {
    static const char *const made_of_it[] = {"normal_eye", "gradient"};
    size_t count = 0;
    bool *seen = memory_array(NULL, r->effect_count + 1, sizeof *seen);
    memset(seen, 0, (r->effect_count + 1) * sizeof *seen);
    for (int m = 0; m < 2; m++) {
        user_list writers = users_of(r, made_of_it[m], true);
        for (size_t i = 0; i < writers.count; i++) {
            size_t effect = writers.items[i];
            if (effect >= r->effect_count || seen[effect] || !fetches_gradient(r, effect))
                continue;
            seen[effect] = true;
            count++;
        }
        free(writers.items);
    }
    free(seen);
    return count;
}

void print_programs(plr_view *view) {
    puts("programs:");
    for (size_t i = 0; i < plr_view_program_count(view); i++) {
        program_report r = report_of(view, i);
        printf("    %s: %u instructions, %u fetches", r.info->name, r.info->instructions,
               r.info->fetches);
        size_t gradients = count_gradients(&r);
        if (r.is_volume)
            printf(", %zu %s a step", gradients, gradients == 1 ? "gradient" : "gradients");
        putchar('\n');
        print_drawn(&r, view);
        print_plugs(&r);
        print_fetches(&r);
        if (r.is_volume)
            print_members(&r);
        free_report(&r);
    }
}

/* ---- JSON ---- */

static void write_drawn(const program_report *r, const plr_view *view) {
    plr_drawable drawable;
    const char *between = "";
    fputs(",\n     \"draws\": [", stdout);
    for (size_t i = 0; plr_view_drawable(view, i, &drawable); i++) {
        if (drawable.program != r->info)
            continue;
        printf("%s{\"kind\": \"%s\", ", between, drawable.kind);
        write_node(drawable.node);
        putchar('}');
        between = ", ";
    }
    putchar(']');
}

static void write_plugs(const program_report *r) {
    const char *between = "";
    fputs(",\n     \"plugs\": [", stdout);
    for (size_t i = 0; i < plr_program_plug_count(r->program); i++) {
        const plr_plug_info *plug = plr_program_plug(r->program, i);
        printf("%s\n      {\"name\": ", between);
        json_string(stdout, plug->name);
        printf(", \"stage\": \"%s\", \"offered_by\": ", plr_stage_text(plug->stage));
        write_effect(r, plug->effect);
        fputs(", \"used_by\": [", stdout);
        for (size_t call = 0; call < plug->call_count; call++) {
            fputs(call ? ", " : "", stdout);
            write_effect(r, plr_program_plug_call(r->program, i, call, NULL));
        }
        fputs("]}", stdout);
        between = ",";
    }
    putchar(']');
}

static void write_fetches(const program_report *r) {
    fputs(",\n     \"fetched\": [", stdout);
    for (size_t i = 0; i < r->fetch_count; i++) {
        const plr_fetch_info *fetch = &r->fetches[i];
        printf("%s\n      {\"count\": %u, \"sampler\": ", i ? "," : "", fetch->count);
        json_string(stdout, fetch->sampler);
        fputs(", \"for\": ", stdout);
        write_effect(r, fetch->effect);
        fputs(", \"place\": ", stdout);
        write_place(fetch->place);
        putchar('}');
    }
    putchar(']');
}

static void write_users(const program_report *r, const char *key, user_list list) {
    printf("\"%s\": [", key);
    for (size_t i = 0; i < list.count; i++) {
        fputs(i ? ", " : "", stdout);
        write_effect(r, list.items[i]);
    }
    putchar(']');
    free(list.items);
}

static void write_members(const program_report *r) {
    fputs(",\n     \"members\": {", stdout);
    for (size_t m = 0; r->is_volume && m < MEMBER_COUNT; m++) {
        printf("%s\n      \"%s\": {", m ? "," : "", members[m].name);
        write_users(r, "computed_by", users_of(r, members[m].name, true));
        fputs(", ", stdout);
        write_users(r, "read_by", users_of(r, members[m].name, false));
        putchar('}');
    }
    putchar('}');
}

void write_programs(plr_view *view) {
    fputs("  \"programs\": [", stdout);
    for (size_t i = 0; i < plr_view_program_count(view); i++) {
        program_report r = report_of(view, i);
        printf("%s\n    {\"name\": ", i ? "," : "");
        json_string(stdout, r.info->name);
        printf(", \"instructions\": %u, \"fetches\": %u, \"gradients\": %zu", r.info->instructions,
               r.info->fetches, r.is_volume ? count_gradients(&r) : 0);
        write_drawn(&r, view);
        write_plugs(&r);
        write_fetches(&r);
        write_members(&r);
        putchar('}');
        free_report(&r);
    }
    putchar(']');
}
