#include "engine/node_file.h"

static plr_place url_place(const plr_field *urls, size_t index) {
    const plr_origin *origin = &urls->value.strings[index].origin;
    if (!origin->file)
        return urls->place;
    return (plr_place){origin->file, origin->line ? origin->line : 1,
                       origin->column ? origin->column : 1};
}

static void repeat_diags(const plr_diags *from, plr_diags *to, bool as_warnings) {
    for (size_t i = 0; i < plr_diags_count(from); i++) {
        const plr_diag *diag = plr_diags_get(from, i);
        plr_severity severity =
            as_warnings && diag->severity == PLR_ERROR ? PLR_WARNING : diag->severity;
        if (severity == PLR_NOTE)
            plr_diags_note(to, diag->place, "%s", diag->message);
        else
            plr_diags_add_as(to, severity, diag->code, diag->place, "%s", diag->message);
    }
}

typedef enum outcome {
    FINE,
    NOT_LOADED,
    NOT_UNDERSTOOD
} outcome;

static outcome try_url(plr_scene *scene, const plr_field *urls, size_t index,
                       plr_file_decoder decode, void *user, plr_diags *diags) {
    plr_bytes bytes;
    if (!plr_scene_load(scene, &urls->value.strings[index], true, &bytes, diags))
        return NOT_LOADED;
    bool fine = decode(user, scene, &bytes, url_place(urls, index), diags);
    plr_bytes_free(&bytes);
    return fine ? FINE : NOT_UNDERSTOOD;
}

bool plr_node_file(plr_scene *scene, const plr_node *node, plr_file_decoder decode, void *user,
                   plr_diags *diags) {
    const plr_field *urls = plr_node_field(node, "url");
    if (!urls || urls->type != PLR_MFSTRING || urls->count == 0) {
        plr_diags_add(diags, PLR_CODE_MISSING_FILE, plr_node_place(node), "%s has no url",
                      plr_node_type(node));
        return false;
    }
    plr_diags *first = plr_diags_create(NULL), *faults = plr_diags_create(NULL);
    outcome last = NOT_LOADED;
    bool any = false;
    for (size_t i = 0; first && faults && i < urls->count && last != FINE; i++) {
        plr_diags *now = plr_diags_create(NULL);
        last = try_url(scene, urls, i, decode, user, now);
        any = any || last == NOT_UNDERSTOOD;
        if (last == FINE) /* what is said about a file that is taken stays as it is */
            repeat_diags(faults, diags, true);
        repeat_diags(now,
                     last == FINE             ? diags
                     : last == NOT_UNDERSTOOD ? faults
                     : i                      ? NULL
                                              : first,
                     false);
        plr_diags_destroy(&now);
    }
    if (last != FINE)
        repeat_diags(any ? faults : first, diags, false);
    plr_diags_destroy(&first);
    plr_diags_destroy(&faults);
    return last == FINE;
}
