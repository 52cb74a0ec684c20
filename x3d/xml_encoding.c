/* Documents in other encodings than UTF-8. */
#include "x3d/xml.h"

#include <limits.h>
#include <string.h>
#include <strings.h>

#include <libxml/encoding.h>
#include <libxml/tree.h>

#include "x3d/files.h"

/* The name in <?xml ... encoding="name"?>, or what the first bytes say. */
static bool find_encoding(const x3d_file *file, char *name, size_t size) {
    const char *text = file->text;
    size_t length = file->length < 256 ? file->length : 256;
    if (length < 4)
        return false;
    if (memcmp(text, "\xff\xfe", 2) == 0 || memcmp(text, "<\0", 2) == 0) {
        strcpy(name, "UTF-16LE");
        return true;
    }
    if (memcmp(text, "\xfe\xff", 2) == 0 || memcmp(text, "\0<", 2) == 0) {
        strcpy(name, "UTF-16BE");
        return true;
    }
    if (length < 6 || memcmp(text, "<?xml", 5) != 0)
        return false;
    const char *end = memchr(text, '>', length);
    for (const char *p = text; end && p + 9 < end; p++) {
        if (memcmp(p, "encoding", 8) != 0)
            continue;
        p += 8;
        while (p < end && *p != '"' && *p != '\'')
            p++;
        const char *close = p < end ? memchr(p + 1, *p, (size_t)(end - p - 1)) : NULL;
        size_t used = close ? (size_t)(close - p - 1) : 0;
        if (!used || used >= size)
            return false;
        memcpy(name, p + 1, used);
        name[used] = '\0';
        return true;
    }
    return false;
}

static bool is_utf8(const char *name) {
    return strcasecmp(name, "UTF-8") == 0 || strcasecmp(name, "UTF8") == 0 ||
           strcasecmp(name, "US-ASCII") == 0 || strcasecmp(name, "ASCII") == 0;
}

/* libxml2's buffers go before anything that may jump. */
static char *convert(plr_scene *scene, xmlCharEncodingHandlerPtr handler, const x3d_file *file,
                     size_t *length) {
    xmlBufferPtr in = xmlBufferCreateStatic((void *)(uintptr_t)file->text, file->length);
    xmlBufferPtr out = xmlBufferCreate();
    char *copy = NULL;
    bool ok = in && out;
    while (ok && xmlBufferLength(in) > 0) {
        int before = xmlBufferLength(in);
        ok = xmlCharEncInFunc(handler, out, in) >= 0 && xmlBufferLength(in) < before;
    }
    if (ok) {
        *length = (size_t)xmlBufferLength(out);
        copy = x3d_block_copy(&scene->allocator, (const char *)xmlBufferContent(out), *length);
    }
    if (in)
        xmlBufferFree(in);
    if (out)
        xmlBufferFree(out);
    return copy;
}

bool x3d_xml_to_utf8(plr_scene *scene, x3d_file *file) {
    char name[64];
    if (file->decoded || !find_encoding(file, name, sizeof name) || is_utf8(name))
        return true;
    plr_place place = {file->name, 1, 1};
    xmlCharEncodingHandlerPtr handler = xmlFindCharEncodingHandler(name);
    size_t length = 0;
    char *text =
        handler && file->length < INT_MAX / 4 ? convert(scene, handler, file, &length) : NULL;
    if (handler)
        xmlCharEncCloseFunc(handler);
    if (!text) {
        x3d_report(scene, PLR_CODE_XML, place, "the encoding '%s' cannot be read", name);
        return false;
    }
    x3d_block_free(file->owned);
    file->owned = text;
    file->text = text;
    file->length = length;
    file->decoded = true;
    x3d_file_index(&scene->arena, file);
    return true;
}
