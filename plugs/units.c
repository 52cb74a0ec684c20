/* Sources to units: identifiers numbered for the link, scopes, the version. */
#include "plugs/link.h"

#include <string.h>

static void grow_slots(plr_linking *l) {
    size_t mask = l->slots ? l->slot_mask * 2 + 1 : 4095;
    uint32_t *slots = PLR_NEW_ARRAY(l->arena, mask + 1, uint32_t);
    for (uint32_t i = 0; i < l->idents.count; i++) {
        size_t slot = l->idents.items[i].hash & mask;
        while (slots[slot])
            slot = (slot + 1) & mask;
        slots[slot] = i + 1;
    }
    l->slots = slots;
    l->slot_mask = mask;
}

static size_t find_slot(const plr_linking *l, const char *text, uint32_t length, uint32_t hash) {
    size_t slot = hash & l->slot_mask;
    for (; l->slots[slot]; slot = (slot + 1) & l->slot_mask) {
        const plr_ident *ident = &l->idents.items[l->slots[slot] - 1];
        if (ident->hash == hash && ident->length == length &&
            memcmp(ident->text, text, length) == 0)
            break;
    }
    return slot;
}

static uint32_t number_ident(plr_linking *l, const plr_ident *ident) {
    if (!l->slots || l->idents.count * 2 > l->slot_mask)
        grow_slots(l);
    size_t slot = find_slot(l, ident->text, ident->length, ident->hash);
    if (!l->slots[slot]) {
        *PLR_PUSH(l->arena, &l->idents) = *ident;
        l->slots[slot] = (uint32_t)l->idents.count;
    }
    return l->slots[slot] - 1;
}

uint32_t plr_gid(plr_linking *l, const char *text, size_t length) {
    plr_ident ident = {text, (uint32_t)length, plr_hash(text, length), 0, 0};
    if (!l->slots)
        grow_slots(l);
    size_t slot = find_slot(l, text, ident.length, ident.hash);
    if (l->slots[slot])
        return l->slots[slot] - 1;
    ident.text = plr_arena_copy(l->arena, text, length);
    ident.word = plr_word_find(text, length, ident.hash);
    return number_ident(l, &ident);
}

uint32_t plr_gid_find(const plr_linking *l, const char *text, size_t length) {
    if (!l->slots)
        return PLR_NONE;
    size_t slot = find_slot(l, text, (uint32_t)length, plr_hash(text, length));
    return l->slots[slot] ? l->slots[slot] - 1 : PLR_NONE;
}

/* ---- Readings ----------------------------------------------------------------------------------
 */

static void read_source(plr_linking *l, const plr_source *source) {
    if (!source)
        return;
    void **slot = plr_table_put(l->arena, &l->readings, (uint64_t)(uintptr_t)source);
    if (*slot)
        return;
    plr_reading *reading = PLR_NEW(l->arena, plr_reading);
    *slot = reading;
    reading->source = source;
    size_t count = source->lexed.idents.count;
    uint32_t *gids = PLR_NEW_ARRAY(l->arena, count + 1, uint32_t);
    for (size_t i = 0; i < count; i++)
        gids[i] = number_ident(l, &source->lexed.idents.items[i]);
    reading->gids = gids;
}

void plr_read_all(plr_linking *l) {
    const plr_link_desc *desc = l->desc;
    for (size_t i = 0; i < desc->base_count; i++)
        read_source(l, desc->base[i]);
    for (size_t i = 0; i < desc->library_count; i++)
        read_source(l, desc->library[i]);
    for (size_t e = 0; e < desc->effect_count; e++)
        for (size_t i = 0; i < desc->effects[e].source_count; i++)
            read_source(l, desc->effects[e].sources[i]);
}

/* ---- Units -------------------------------------------------------------------------------------
 */

static void make_unit(plr_linking *l, plr_scope *scope, const plr_source *source) {
    plr_unit *unit = &scope->units[scope->unit_count];
    unit->reading = plr_table_get(&l->readings, (uint64_t)(uintptr_t)source);
    unit->lexed = &source->lexed;
    unit->scope = scope;
    unit->index = scope->unit_count++;
    unit->number = l->unit_count++;
    unit->refs = PLR_NEW_ARRAY(l->pass, source->lexed.idents.count + 1, plr_binding *);
    unit->actions = PLR_NEW_ARRAY(l->pass, source->lexed.idents.count + 1, uint8_t);
    if (source->lexed.plugs.count)
        unit->sockets = PLR_NEW_ARRAY(l->pass, source->lexed.plugs.count, plr_socket *);
}

static void make_scope(plr_linking *l, uint32_t at, uint32_t owner,
                       const plr_source *const *sources, size_t count) {
    size_t counts[PLR_STAGE_COUNT] = {0};
    for (size_t i = 0; i < count; i++)
        if (sources[i])
            counts[sources[i]->stage]++;
    for (unsigned s = 0; s < PLR_STAGE_COUNT; s++) {
        plr_scope *scope = &l->scopes[s][at];
        scope->owner = owner;
        scope->stage = (plr_stage)s;
        scope->number = ++l->scope_numbers;
        if ((l->stages & 1u << s) && counts[s])
            scope->units = PLR_NEW_ARRAY(l->pass, counts[s], plr_unit);
    }
    for (size_t i = 0; i < count; i++)
        if (sources[i] && (l->stages & 1u << sources[i]->stage))
            make_unit(l, &l->scopes[sources[i]->stage][at], sources[i]);
}

void plr_make_stages(plr_linking *l) {
    for (size_t i = 0; i < l->desc->base_count; i++)
        if (l->desc->base[i])
            l->stages |= (uint8_t)(1u << l->desc->base[i]->stage);
    if (l->no_geometry)
        l->stages &= (uint8_t) ~(1u << PLR_GEOMETRY);
}

void plr_make_units(plr_linking *l) {
    const plr_link_desc *desc = l->desc;
    for (unsigned s = 0; s < PLR_STAGE_COUNT; s++)
        l->scopes[s] = PLR_NEW_ARRAY(l->pass, (size_t)l->effect_count + 3, plr_scope);
    make_scope(l, PLR_SCOPE_BASE(l), PLR_OWNER_BASE, desc->base, desc->base_count);
    make_scope(l, PLR_SCOPE_LIBRARY(l), PLR_OWNER_LIBRARY, desc->library, desc->library_count);
    make_scope(l, PLR_SCOPE_HOST(l), PLR_OWNER_HOST, NULL, 0);
    for (uint32_t e = 0; e < l->effect_count; e++) {
        const plr_effect *effect = &desc->effects[e];
        if (!effect->disabled)
            make_scope(l, e, e, effect->sources, effect->source_count);
    }
}

/* ---- The version -------------------------------------------------------------------------------
 */

static const struct {
    int written;
    bool es;
    int counts; /* as this version of desktop GLSL */
} versions[] = {
    {110, false, 330}, {120, false, 330}, {130, false, 330}, {140, false, 330}, {150, false, 330},
    {330, false, 330}, {400, false, 400}, {410, false, 410}, {420, false, 420}, {430, false, 430},
    {440, false, 440}, {450, false, 450}, {460, false, 460}, {100, false, 330}, {300, true, 330},
    {310, true, 430},  {320, true, 450},
};

/* The version that a #version line asks for; 0: none that is known. */
static int read_version(const plr_lexed *lexed, const plr_directive *directive) {
    uint32_t first = directive->token + 1;
    if (first >= directive->end)
        return 0;
    size_t length;
    const char *text = plr_token_text(lexed, &lexed->tokens.items[first], &length);
    int number = 0;
    for (size_t i = 0; i < length && i < 5; i++)
        number = text[i] >= '0' && text[i] <= '9' ? number * 10 + text[i] - '0' : 100000;
    bool es = false;
    if (first + 1 < directive->end) {
        text = plr_token_text(lexed, &lexed->tokens.items[first + 1], &length);
        es = length == 2 && memcmp(text, "es", 2) == 0;
    }
    for (size_t i = 0; i < sizeof versions / sizeof versions[0]; i++)
        if (versions[i].written == number && versions[i].es == es)
            return versions[i].counts;
    return 0;
}

static int most_version(const plr_linking *l) {
    return l->desc->glsl == PLR_GLSL_300ES ? 330 : 460;
}

static void ask_version(plr_linking *l, const plr_lexed *lexed, const plr_directive *directive) {
    int version = directive->kind == PLR_D_VERSION ? read_version(lexed, directive) : 0;
    if (version <= most_version(l) && version > l->version)
        l->version = version;
}

/* What the target asks for at least. */
static int least_version(const plr_linking *l) {
    static const int least[] = {
        [PLR_GLSL_330] = 330, [PLR_GLSL_410] = 410, [PLR_GLSL_450] = 450, [PLR_GLSL_300ES] = 300};
    return least[l->desc->glsl];
}

void plr_decide_version(plr_linking *l) {
    const plr_link_desc *desc = l->desc;
    l->version = least_version(l);
    for (size_t r = 0; l->readings.keys && r <= l->readings.mask; r++) {
        const plr_reading *reading = l->readings.keys[r] ? l->readings.values[r] : NULL;
        const plr_lexed *lexed = reading ? &reading->source->lexed : NULL;
        for (size_t i = 0; lexed && i < lexed->directives.count; i++)
            ask_version(l, lexed, &lexed->directives.items[i]);
    }
    if (desc->glsl == PLR_GLSL_300ES)
        l->version = 300;
}

bool plr_lower_version(plr_linking *l) {
    int before = l->version;
    if (l->desc->glsl == PLR_GLSL_300ES)
        return false;
    l->version = least_version(l);
    for (unsigned s = 0; s < PLR_STAGE_COUNT; s++)
        for (uint32_t e = 0; e < l->effect_count + 1; e++) { /* the effects and the base */
            const plr_scope *scope = plr_scope_of(l, (plr_stage)s, e);
            bool out = e < l->effect_count && (l->faulty[e] || l->left_out[e]);
            for (uint32_t u = 0; u < scope->unit_count && !out; u++) {
                const plr_unit *unit = &scope->units[u];
                for (size_t i = 0; unit->cut && i < unit->cut->versions.count; i++)
                    ask_version(l, unit->lexed,
                                &unit->lexed->directives.items[unit->cut->versions.items[i]]);
            }
        }
    plr_set_version(l);
    return l->version != before;
}

static void say_version(plr_linking *l, const plr_unit *unit, const plr_directive *directive) {
    int version = read_version(unit->lexed, directive);
    plr_place place = plr_token_place(unit, directive->token);
    if (version == 0)
        plr_say(l, PLR_CODE_BAD_VERSION, place, "this GLSL version is not known");
    else if (version > most_version(l))
        plr_say(l, PLR_CODE_BAD_VERSION, place,
                "this GLSL version is newer than the program's, 300 es");
}

void plr_say_versions(plr_linking *l) {
    for (unsigned s = 0; s < PLR_STAGE_COUNT; s++)
        for (uint32_t e = 0; e < l->effect_count + 1; e++) {
            const plr_scope *scope = plr_scope_of(l, (plr_stage)s, e);
            for (uint32_t u = 0; u < scope->unit_count; u++) {
                const plr_unit *unit = &scope->units[u];
                for (size_t i = 0; unit->cut && i < unit->cut->versions.count; i++)
                    say_version(l, unit,
                                &unit->lexed->directives.items[unit->cut->versions.items[i]]);
            }
        }
}
