/* Buffers and the views of them: ISO/IEC 12113 3.6.1. Each is read when it is first asked for, and
 * what is wrong with it is told once. */
#include "x3d/gltf_internal.h"

#include <string.h>
#include <strings.h>

#include "x3d/files.h"
#include "x3d/read.h"

enum {
    MOST_STRIDE = 252
};

/* ---- Urls ---- */

static int hexadecimal(char c) {
    if (c >= '0' && c <= '9')
        return c - '0';
    return c >= 'a' && c <= 'f' ? c - 'a' + 10 : c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

static size_t decode_percent(char *text, size_t length) {
    size_t used = 0;
    for (size_t i = 0; i < length; i++) {
        int high = text[i] == '%' && i + 2 < length ? hexadecimal(text[i + 1]) : -1;
        int low = high >= 0 ? hexadecimal(text[i + 2]) : -1;
        text[used++] = low >= 0 ? (char)(high * 16 + low) : text[i];
        i += low >= 0 ? 2 : 0;
    }
    text[used] = '\0';
    return used;
}

static bool has_scheme(const x3d_json *uri, const char *scheme) {
    size_t length = strlen(scheme);
    return uri->count > length && strncasecmp(uri->value.text, scheme, length) == 0;
}

plr_string gltf_url(gltf *g, const x3d_json *uri) {
    /* What has a scheme is handed on as it stands: its own rules hold. */
    bool whole = has_scheme(uri, "data:") || has_scheme(uri, "file:") || has_scheme(uri, "http:") ||
                 has_scheme(uri, "https:");
    char *text = plr_arena_copy(&g->scene->arena, uri->value.text, uri->count);
    size_t length = whole ? uri->count : decode_percent(text, uri->count);
    plr_place place = gltf_place(g, uri);
    return (plr_string){text, length, {place.file, place.line, place.column, NULL, 0}};
}

/* ---- Buffers ---- */

static plr_string url_of_buffer(gltf *g, const x3d_json *uri) {
    if (!has_scheme(uri, "data:"))
        return gltf_url(g, uri);
    plr_place place = gltf_place(g, uri); /* large, and no copy is needed */
    return (plr_string){
        uri->value.text, uri->count, {place.file, place.line, place.column, NULL, 0}};
}

static void load_buffer(gltf *g, const x3d_json *uri, gltf_buffer *buffer) {
    plr_scene *scene = g->scene;
    plr_string url = url_of_buffer(g, uri);
    plr_bytes bytes;
    const char *name;
    x3d_failure failure = x3d_load_url(scene, &url, false, &bytes, &name);
    if (failure.text) {
        x3d_report(scene, failure.code, gltf_place(g, uri), "'%.300s' %s", name, failure.text);
        return;
    }
    x3d_block_free(bytes.name);
    if (bytes.length > g->loadable) {
        x3d_block_free(bytes.data);
        x3d_report(scene, PLR_CODE_LIMIT, gltf_place(g, uri),
                   "the buffers of the file are too large");
        return;
    }
    g->loadable -= bytes.length;
    buffer->owned = bytes.data;
    buffer->data = bytes.data;
    buffer->length = bytes.length;
}

/* The bytes of a GLB file: those of the first buffer, if it has no uri. */
static void take_attached(gltf *g, const x3d_json *json, size_t index, gltf_buffer *buffer) {
    const x3d_file *file = g->build->file;
    if (index == 0 && file->attached) {
        buffer->data = file->attached;
        buffer->length = file->attached_length;
    } else if (!gltf_needs_unknown(g, json)) {
        x3d_report(g->scene, PLR_CODE_BAD_VALUE, gltf_place(g, json),
                   "the buffer has neither a uri nor bytes in this file");
    }
}

static const gltf_buffer *buffer_at(gltf *g, const x3d_json *json, size_t index) {
    gltf_buffer *buffer = &g->buffers[index];
    if (buffer->read)
        return buffer;
    buffer->read = true;
    size_t declared;
    if (!gltf_size(g, json, "byteLength", 0, &declared))
        return buffer;
    const x3d_json *uri = gltf_text(g, json, "uri");
    if (uri)
        load_buffer(g, uri, buffer);
    else
        take_attached(g, json, index, buffer);
    if (buffer->data && buffer->length < declared)
        x3d_report(g->scene, PLR_CODE_BAD_VALUE, gltf_place(g, json),
                   "the buffer has %zu bytes, not %zu", buffer->length, declared);
    if (buffer->length > declared)
        buffer->length = declared;
    g->budget += 8 * buffer->length;
    return buffer;
}

void gltf_free_buffers(gltf *g) {
    for (size_t i = 0; g->buffers && i < gltf_table_count(g, GLTF_BUFFERS); i++) {
        x3d_block_free(g->buffers[i].owned);
        g->buffers[i] = (gltf_buffer){.read = true};
    }
}

/* ---- Views ---- */

static void read_view(gltf *g, const x3d_json *json, gltf_view *view) {
    size_t index, offset, length, stride;
    const x3d_json *owner = gltf_refer(g, json, "buffer", GLTF_BUFFERS, &index);
    if (gltf_needs_unknown(g, json))
        return;
    if (!owner || !gltf_size(g, json, "byteOffset", 0, &offset) ||
        !gltf_size(g, json, "byteLength", 0, &length) ||
        !gltf_size(g, json, "byteStride", 0, &stride)) {
        if (!x3d_json_member(json, "buffer"))
            x3d_report(g->scene, PLR_CODE_BAD_VALUE, gltf_place(g, json), "the view has no buffer");
        return;
    }
    const gltf_buffer *buffer = buffer_at(g, owner, index);
    if (!buffer->data)
        return;
    if (offset > buffer->length || length > buffer->length - offset || stride > MOST_STRIDE) {
        x3d_report(g->scene, PLR_CODE_BAD_VALUE, gltf_place(g, json),
                   "the view does not lie in its buffer, which has %zu bytes", buffer->length);
        return;
    }
    *view = (gltf_view){true, buffer->data + offset, length, stride};
}

const gltf_view *gltf_view_of(gltf *g, const x3d_json *object, const char *key) {
    size_t index;
    const x3d_json *json = gltf_refer(g, object, key, GLTF_VIEWS, &index);
    if (!json)
        return NULL;
    gltf_view *view = &g->views[index];
    if (!view->read) {
        view->read = true;
        read_view(g, json, view);
    }
    return view->data ? view : NULL;
}
