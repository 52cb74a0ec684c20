#include "engine/node_file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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

/* ---- Numbered frames ---- */

/* A movie may be a row of pictures: "fire@counter(4).png" is fire0000.png, fire0001.png, ..., and
 * so is "fire%4d.png". */
typedef struct counter {
    size_t start, end; /* of what the number stands for */
    int digits;        /* at least */
} counter;

static bool find_counter(const char *text, counter *c) {
    static const struct { const char *head, *tail; } forms[] = {{"@counter(", ")"}, {"%", "d"}};
    for (size_t i = 0; i < sizeof forms / sizeof *forms; i++) {
        const char *head = strstr(text, forms[i].head);
        char *end = NULL;
        if (!head)
            continue;
        const char *number = head + strlen(forms[i].head);
        long digits = *number >= '0' && *number <= '9' ? strtol(number, &end, 10) : 1;
        const char *tail = end ? end : number;
        if (digits > 20 || strncmp(tail, forms[i].tail, strlen(forms[i].tail)) != 0)
            continue;
        *c = (counter){(size_t)(head - text), (size_t)(tail + strlen(forms[i].tail) - text),
                       digits < 1 ? 1 : (int)digits};
        return true;
    }
    return false;
}

/* The first frame has the number 0 or 1. */
static bool load_first_frame(plr_scene *scene, const plr_string *url, const counter *c,
                             plr_bytes *bytes, plr_diags *diags) {
    size_t size = url->length + 32;
    char *text = malloc(size);
    bool loaded = false;
    for (int frame = 0; text && frame < 2 && !loaded; frame++) {
        int length = snprintf(text, size, "%.*s%0*d%s", (int)c->start, url->text, c->digits, frame,
                              url->text + c->end);
        plr_string name = {text, (size_t)length, url->origin};
        loaded = plr_scene_load(scene, &name, true, bytes, frame ? diags : NULL);
    }
    free(text);
    return loaded;
}

static bool load(plr_scene *scene, const plr_node *node, const plr_string *url, plr_bytes *bytes,
                 plr_diags *diags) {
    counter c;
    bool is_short = url->length < 4096; /* a name, not data */
    if (is_short && plr_node_is(node, "MovieTexture") && find_counter(url->text, &c))
        return load_first_frame(scene, url, &c, bytes, diags);
    return plr_scene_load(scene, url, true, bytes, diags);
}

/* ---- Urls ---- */

bool plr_node_urls(plr_scene *scene, const plr_node *node, plr_url_reader read, void *user,
                   plr_diags *diags) {
    const plr_field *urls = plr_node_field(node, "url");
    if (!urls || urls->type != PLR_MFSTRING || urls->count == 0) {
        plr_diags_add(diags, PLR_CODE_MISSING_FILE, plr_node_place(node), "%s has no url",
                      plr_node_type(node));
        return false;
    }
    plr_diags *first = plr_diags_create(NULL), *faults = plr_diags_create(NULL);
    plr_url_outcome last = PLR_URL_NOT_LOADED;
    bool any = false;
    for (size_t i = 0; first && faults && i < urls->count && last != PLR_URL_FINE; i++) {
        plr_diags *now = plr_diags_create(NULL);
        last = read(user, scene, &urls->value.strings[i], url_place(urls, i), now);
        any = any || last == PLR_URL_NOT_UNDERSTOOD;
        if (last == PLR_URL_FINE) /* what is said about a file that is taken stays as it is */
            repeat_diags(faults, diags, true);
        repeat_diags(now,
                     last == PLR_URL_FINE             ? diags
                     : last == PLR_URL_NOT_UNDERSTOOD ? faults
                     : i                              ? NULL
                                                      : first,
                     false);
        plr_diags_destroy(&now);
    }
    if (last != PLR_URL_FINE)
        repeat_diags(any ? faults : first, diags, false);
    plr_diags_destroy(&first);
    plr_diags_destroy(&faults);
    return last == PLR_URL_FINE;
}

typedef struct decoding {
    const plr_node *node;
    plr_file_decoder decode;
    void *user;
} decoding;

static plr_url_outcome decode_url(void *user, plr_scene *scene, const plr_string *url,
                                  plr_place place, plr_diags *diags) {
    const decoding *d = user;
    plr_bytes bytes;
    if (!load(scene, d->node, url, &bytes, diags))
        return PLR_URL_NOT_LOADED;
    bool fine = d->decode(d->user, scene, &bytes, place, diags);
    plr_bytes_free(&bytes);
    return fine ? PLR_URL_FINE : PLR_URL_NOT_UNDERSTOOD;
}

bool plr_node_file(plr_scene *scene, const plr_node *node, plr_file_decoder decode, void *user,
                   plr_diags *diags) {
    decoding d = {node, decode, user};
    return plr_node_urls(scene, node, decode_url, &d, diags);
}
