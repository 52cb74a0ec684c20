/* What faulty effects would have given to others: plugs, and names for those who use these. */
#include "plugs/link.h"

static uint64_t name_key(uint32_t effect, uint32_t gid) {
    return (uint64_t)(effect + 1) << 32 | gid;
}

/* What a text declares at file scope, whatever its conditionals say. */
static void note_names(plr_linking *l, uint32_t effect, const plr_reading *reading) {
    const plr_source *source = reading->source;
    plr_cut all = {.items = {NULL, 0, 0}};
    const plr_cut *cut = &source->cut;
    if (source->lexed.conditional) {
        plr_cut_items(l->pass, &source->lexed, NULL, &all);
        cut = &all;
    }
    for (size_t i = 0; i < cut->names.count; i++) {
        const plr_token *token = &source->lexed.tokens.items[cut->names.items[i].token];
        if (token->kind == PLR_T_IDENT)
            *plr_table_put(l->pass, &l->lost_names, name_key(effect, reading->gids[token->value])) =
                l;
    }
}

void plr_note_lost(plr_linking *l, uint32_t effect) {
    uint32_t *number = PLR_NEW(l->pass, uint32_t);
    *number = effect;
    const plr_effect *lost = &l->desc->effects[effect];
    for (size_t s = 0; s < lost->source_count; s++) {
        const plr_source *source = lost->sources[s];
        const plr_reading *reading =
            source ? plr_table_get(&l->readings, (uint64_t)(uintptr_t)source) : NULL;
        for (size_t i = 0; reading && i < source->lexed.plugs.count; i++) {
            uint32_t gid = reading->gids[source->lexed.plugs.items[i].name];
            *plr_table_put(l->pass, &l->lost, (uint64_t)(source->stage + 1u) << 32 | gid) = number;
        }
        if (reading && source->lexed.plugs.count)
            note_names(l, effect, reading);
    }
}

bool plr_lacks_name(plr_linking *l, const plr_unit *unit, uint32_t token) {
    uint32_t owner = unit->scope->owner;
    if (owner >= l->effect_count || !l->lost_from[owner] || l->unfit[owner])
        return false;
    uint32_t from = l->lost_from[owner] - 1, gid = plr_token_gid(unit, token);
    if (!plr_table_get(&l->lost_names, name_key(from, gid)))
        return false;
    const plr_message message = {
        .severity = PLR_NOTE,
        .code = PLR_CODE_LACKS,
        .place = plr_token_place(unit, token),
        .text = plr_arena_format(l->arena, "%s lacks \"%s\", that %s would have offered",
                                 plr_effect_text(l, owner), plr_gid_text(l, gid),
                                 plr_effect_text(l, from))};
    plr_leave_out(l, owner, &message);
    return true;
}
