/* Diagnostics of a round, kept until it is known to be the last. */
#include "plugs/link.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static void say(plr_linking *l, plr_severity severity, plr_code code, plr_place place,
                const char *format, va_list arguments) PLR_PRINTF(5, 0);
static void say(plr_linking *l, plr_severity severity, plr_code code, plr_place place,
                const char *format, va_list arguments) {
    char text[512];
    int length = vsnprintf(text, sizeof text, format, arguments);
    size_t size = length < 0 ? 0 : (size_t)length < sizeof text ? (size_t)length : sizeof text - 1;
    *PLR_PUSH(l->pass, &l->messages) =
        (plr_message){severity, code, place, plr_arena_copy(l->pass, text, size)};
}

void plr_say(plr_linking *l, plr_code code, plr_place place, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    say(l, plr_code_severity(code), code, place, format, arguments);
    va_end(arguments);
}

void plr_say_note(plr_linking *l, plr_place place, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    size_t count = l->messages.count;
    plr_code code = count ? l->messages.items[count - 1].code : PLR_CODE_LACKS;
    say(l, PLR_NOTE, code, place, format, arguments);
    va_end(arguments);
}

const char *plr_gid_text(plr_linking *l, uint32_t gid) {
    const plr_ident *ident = &l->idents.items[gid];
    uint32_t length = ident->length < 200 ? ident->length : 200;
    return plr_arena_copy(l->pass, ident->text, length);
}

const char *plr_effect_text(plr_linking *l, uint32_t effect) {
    if (effect >= l->effect_count)
        return "the base shader";
    const char *name = l->desc->effects[effect].name;
    if (name && *name)
        return plr_arena_format(l->pass, "effect \"%.100s\"", name);
    return plr_arena_format(l->pass, "effect %u", effect + 1);
}

/* ---- A plug function that is called nowhere ----------------------------------------------------
 */

#define MAX_WORD 64
#define MAX_COMPARED (1u << 20) /* names in one link */

static uint32_t minimum(uint32_t a, uint32_t b) {
    return a < b ? a : b;
}

/* How many letters must be put, dropped, changed or swapped to make one word of the other. */
static uint32_t edit_distance(const char *a, uint32_t a_length, const char *b, uint32_t b_length) {
    uint32_t rows[3][MAX_WORD + 1];
    if (a_length > MAX_WORD || b_length > MAX_WORD)
        return UINT32_MAX;
    for (uint32_t j = 0; j <= b_length; j++)
        rows[0][j] = j;
    for (uint32_t i = 1; i <= a_length; i++) {
        uint32_t *row = rows[i % 3], *above = rows[(i + 2) % 3], *second = rows[(i + 1) % 3];
        row[0] = i;
        for (uint32_t j = 1; j <= b_length; j++) {
            uint32_t change = above[j - 1] + (a[i - 1] != b[j - 1]);
            row[j] = minimum(change, minimum(above[j], row[j - 1]) + 1);
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = minimum(row[j], second[j - 2] + 1);
        }
    }
    return rows[a_length % 3][b_length];
}

typedef struct nearest {
    const char *names[3];
    uint32_t lengths[3], distances[3], count;
} nearest;

static void consider(nearest *n, const plr_ident *wanted, const char *name, uint32_t length) {
    uint32_t most = wanted->length < 5 ? 1 : wanted->length < 9 ? 2 : 3;
    if (length > wanted->length + most || wanted->length > length + most)
        return;
    uint32_t distance = edit_distance(wanted->text, wanted->length, name, length);
    if (distance > most)
        return;
    for (uint32_t i = 0; i < n->count; i++)
        if (n->lengths[i] == length && memcmp(n->names[i], name, length) == 0)
            return;
    uint32_t at = n->count;
    while (at > 0 && n->distances[at - 1] > distance)
        at--;
    if (at == 3)
        return;
    n->count += n->count < 3;
    for (uint32_t i = n->count - 1; i > at; i--) {
        n->names[i] = n->names[i - 1];
        n->lengths[i] = n->lengths[i - 1];
        n->distances[i] = n->distances[i - 1];
    }
    n->names[at] = name;
    n->lengths[at] = length;
    n->distances[at] = distance;
}

static const char *nearest_text(plr_linking *l, const nearest *n) {
    const char *text = "";
    for (uint32_t i = 0; i < n->count; i++)
        text = plr_arena_format(l->pass, "%s%s\"%.*s\"", text, i ? " or " : "; did you mean ",
                                (int)n->lengths[i], n->names[i]);
    return text;
}

const char *plr_nearest_words(plr_linking *l, const char *text, size_t length,
                              const char *const *words, size_t count) {
    nearest n = {.count = 0};
    plr_ident wanted = {.text = text, .length = (uint32_t)length};
    for (size_t i = 0; i < count; i++)
        consider(&n, &wanted, words[i], (uint32_t)strlen(words[i]));
    return nearest_text(l, &n);
}

static const char *list_nearest(plr_linking *l, const plr_unit *unit, uint32_t plug) {
    nearest n = {.count = 0};
    const plr_ident *wanted = &l->idents.items[plug];
    for (size_t i = 0; i < l->sockets.count && l->compared < MAX_COMPARED; i++, l->compared++) {
        const plr_socket *socket = l->sockets.items[i];
        const plr_ident *ident = &socket->unit->lexed->idents.items[socket->plug->name];
        if (socket->unit->scope->stage == unit->scope->stage)
            consider(&n, wanted, ident->text, ident->length);
    }
    for (size_t i = 0; i < l->desc->known_plug_count; i++)
        if (l->desc->known_plugs[i].stage == unit->scope->stage)
            consider(&n, wanted, l->desc->known_plugs[i].name,
                     (uint32_t)strlen(l->desc->known_plugs[i].name));
    return nearest_text(l, &n);
}

/* The stages that have the plug: in this link, else among the known ones. Bits. */
static unsigned stages_of(plr_linking *l, uint32_t plug, const plr_socket **later) {
    unsigned stages = 0;
    for (size_t i = 0; i < l->sockets.count; i++) {
        const plr_socket *socket = l->sockets.items[i];
        if (socket->unit->reading->gids[socket->plug->name] != plug)
            continue;
        stages |= 1u << socket->unit->scope->stage;
        if (!later[socket->unit->scope->stage])
            later[socket->unit->scope->stage] = socket;
    }
    return stages;
}

static unsigned known_stages(const plr_linking *l, uint32_t plug) {
    const plr_ident *ident = &l->idents.items[plug];
    unsigned stages = 0;
    for (size_t i = 0; i < l->desc->known_plug_count; i++) {
        const char *name = l->desc->known_plugs[i].name;
        if (strlen(name) == ident->length && memcmp(name, ident->text, ident->length) == 0)
            stages |= 1u << l->desc->known_plugs[i].stage;
    }
    return stages;
}

static const char *stage_list(plr_linking *l, unsigned stages) {
    const char *text = "";
    for (unsigned s = 0; s < PLR_STAGE_COUNT; s++)
        if (stages & 1u << s)
            text = plr_arena_format(l->pass, "%s%s%s", text, *text ? " and " : "",
                                    plr_stage_text((plr_stage)s));
    return text;
}

void plr_check_target(plr_linking *l, uint32_t e) {
    const plr_effect *effect = &l->desc->effects[e];
    if (plr_target_exists(l, e))
        return;
    nearest n = {.count = 0};
    plr_ident wanted = {.text = effect->target, .length = (uint32_t)strlen(effect->target)};
    for (size_t i = 0; i < l->desc->known_target_count; i++) {
        const char *name = l->desc->known_targets[i];
        if (strcmp(name, effect->target) == 0)
            return; /* the host has it, where it makes sense */
        consider(&n, &wanted, name, (uint32_t)strlen(name));
    }
    for (uint32_t i = 0; i < l->effect_count && l->compared < MAX_COMPARED; i++, l->compared++)
        if (l->names[i] != PLR_NONE)
            consider(&n, &wanted, l->desc->effects[i].name,
                     (uint32_t)strlen(l->desc->effects[i].name));
    if (!effect->only_if_active || l->desc->known_target_count)
        plr_say(l, PLR_CODE_UNKNOWN_TARGET, effect->place, "%s: there is no effect \"%.100s\"%s",
                plr_effect_text(l, e), effect->target, nearest_text(l, &n));
}

void plr_say_unplaced(plr_linking *l, const plr_unit *unit, plr_function *function) {
    unsigned here = 1u << unit->scope->stage;
    const plr_socket *sockets[PLR_STAGE_COUNT] = {NULL};
    plr_place place = plr_token_place(unit, function->name->token);
    const char *name = plr_gid_text(l, function->plug);
    unsigned known = known_stages(l, function->plug);
    uint64_t key = (uint64_t)(unit->scope->stage + 1) << 32 | function->plug;
    const uint32_t *lost = plr_table_get(&l->lost, key);
    if (lost) {
        plr_say(l, PLR_CODE_LACKS, place, "%s lacks the plug \"%s\", that %s would have offered",
                plr_effect_text(l, function->effect), name, plr_effect_text(l, *lost));
        l->lost_from[function->effect] = *lost + 1;
        return;
    }
    unsigned stages = stages_of(l, function->plug, sockets);
    if (known & here && l->desc->effects[function->effect].only_attached)
        return; /* the instance has it, where it is in use */
    if (stages & here) {
        const plr_socket *socket = sockets[unit->scope->stage];
        plr_say(l, PLR_CODE_UNKNOWN_PLUG, place,
                "plug \"%s\" is offered only by %s, which comes later", name,
                plr_effect_text(l, socket->effect));
        plr_say_note(l, plr_unit_place(socket->unit, socket->plug->offset),
                     "plug \"%s\" stands here", name);
    } else if (known & here) {
        return; /* the host has it, where it makes sense */
    } else if (stages | known) {
        plr_say(l, PLR_CODE_WRONG_STAGE, place,
                "there is no plug \"%s\" in the %s stage; it exists in the %s stage", name,
                plr_stage_text(unit->scope->stage), stage_list(l, stages ? stages : known));
    } else {
        const char *near = list_nearest(l, unit, function->plug);
        if (*near || !l->desc->own_base)
            plr_say(l, PLR_CODE_UNKNOWN_PLUG, place, "there is no plug \"%s\"%s", name, near);
    }
}
