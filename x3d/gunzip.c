#include "x3d/files.h"

#include <limits.h>
#include <string.h>
#include <zlib.h>

bool x3d_is_gzip(const char *data, size_t length) {
    return length > 2 && (unsigned char)data[0] == 0x1f && (unsigned char)data[1] == 0x8b;
}

/* That much is unpacked before the host is told how far. */
#define PIECE (16u << 20)

typedef struct unpacker {
    z_stream stream;
    const char *packed;
    size_t left; /* packed bytes not yet given to zlib */
    char *data;
    size_t used, size, most;
} unpacker;

static void feed(unpacker *u) {
    if (u->stream.avail_in || !u->left)
        return;
    uInt amount = u->left < UINT_MAX / 2 ? (uInt)u->left : UINT_MAX / 2;
    u->stream.next_in = (Bytef *)(uintptr_t)u->packed;
    u->stream.avail_in = amount;
    u->packed += amount;
    u->left -= amount;
}

static bool grow(unpacker *u) {
    if (u->used < u->size)
        return true;
    size_t size = u->size < u->most / 2 ? u->size * 2 : u->most;
    char *larger = size > u->size ? x3d_block_resize(u->data, size + 1) : NULL;
    if (!larger)
        return false;
    u->data = larger;
    u->size = size;
    return true;
}

static x3d_failure fail(plr_code code, const char *text) {
    return (x3d_failure){code, text};
}

/* One call of zlib; *done: the data is complete. */
static x3d_failure step(unpacker *u, bool *done) {
    feed(u);
    if (!grow(u))
        return u->size >= u->most
                   ? fail(PLR_CODE_LIMIT, "is larger than may be read")
                   : fail(PLR_CODE_NO_MEMORY, "not enough memory to unpack the file");
    size_t room = u->size - u->used;
    uInt before = room < PIECE ? (uInt)room : PIECE;
    u->stream.next_out = (Bytef *)u->data + u->used;
    u->stream.avail_out = before;
    int result = inflate(&u->stream, Z_NO_FLUSH);
    u->used += before - u->stream.avail_out;
    if (result == Z_STREAM_END) {
        /* Several members may follow each other; anything else behind the last one is ignored. */
        feed(u);
        *done =
            u->stream.avail_in < 2 || u->stream.next_in[0] != 0x1f || u->stream.next_in[1] != 0x8b;
        if (!*done)
            inflateReset(&u->stream);
        return fail(PLR_CODE_MISSING_FILE, NULL);
    }
    if (result == Z_MEM_ERROR)
        return fail(PLR_CODE_NO_MEMORY, "not enough memory to unpack the file");
    if (result == Z_BUF_ERROR && !u->stream.avail_in && !u->left)
        return fail(PLR_CODE_MISSING_FILE, "is packed with gzip and ends too early");
    if (result != Z_OK && result != Z_BUF_ERROR)
        return fail(PLR_CODE_MISSING_FILE, "is packed with gzip and damaged");
    return fail(PLR_CODE_MISSING_FILE, NULL);
}

x3d_failure x3d_gunzip(plr_scene *scene, const char *name, const char *packed, size_t packed_length,
                       char **data, size_t *length) {
    unpacker u = {.packed = packed, .left = packed_length};
    u.most = scene->rules.max_bytes ? scene->rules.max_bytes : (size_t)1 << 30;
    u.size = packed_length < u.most / 4 ? packed_length * 4 : u.most;
    u.data = x3d_block_new(&scene->allocator, u.size + 1);
    *data = NULL;
    if (!u.data)
        return fail(PLR_CODE_NO_MEMORY, "not enough memory to unpack the file");
    if (inflateInit2(&u.stream, 16 + MAX_WBITS) != Z_OK) {
        x3d_block_free(u.data);
        return fail(PLR_CODE_NO_MEMORY, "not enough memory to unpack the file");
    }
    x3d_failure failure = {PLR_CODE_MISSING_FILE, NULL};
    for (bool done = false; !done && !failure.text;) {
        failure = step(&u, &done);
        size_t given = packed_length - u.left - u.stream.avail_in;
        if (u.used > PIECE)
            plr_scene_progress(scene, name, (double)given / (double)packed_length);
    }
    inflateEnd(&u.stream);
    if (failure.text) {
        x3d_block_free(u.data);
        return failure;
    }
    u.data[u.used] = '\0';
    *data = u.data;
    *length = u.used;
    return failure;
}
