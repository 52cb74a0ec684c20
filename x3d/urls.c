/* What the urls of nodes lead to: files, data: urls, source code. */
#include <string.h>
#include <strings.h>

#include "x3d/files.h"
#include "x3d/read.h"

static plr_place place_of(const plr_string *url) {
    return (plr_place){url->origin.file, url->origin.line, url->origin.column};
}

/* A public entry point sets up where to go when memory runs out, and undoes it. */
typedef struct entry {
    jmp_buf out_of_memory;
    jmp_buf *outer;
    plr_diags *outer_diags;
} entry;

static void enter(entry *e, plr_scene *scene, plr_diags *diags) {
    e->outer = scene->arena.out_of_memory;
    e->outer_diags = scene->diags;
    scene->arena.out_of_memory = &e->out_of_memory;
    scene->diags = diags;
    scene->reported = 0;
}

static void leave(entry *e, plr_scene *scene) {
    scene->arena.out_of_memory = e->outer;
    scene->diags = e->outer_diags;
}

static bool out_of_memory(entry *e, plr_scene *scene, plr_place place) {
    plr_diags_add(scene->diags, PLR_CODE_NO_MEMORY, place, "not enough memory to read the file");
    leave(e, scene);
    return false;
}

/* ---- data: urls ---- */

static bool is_data(const plr_string *url, size_t *start) {
    size_t i = 0;
    while (i < url->length && (unsigned char)url->text[i] <= ' ')
        i++;
    *start = i;
    return url->length - i >= 5 && strncasecmp(url->text + i, "data:", 5) == 0;
}

/* Where the data begin, after the first comma; *base64: they are encoded. */
static size_t data_start(const plr_string *url, size_t start, bool *base64) {
    const char *comma = memchr(url->text + start, ',', url->length - start);
    if (!comma)
        return url->length;
    size_t at = (size_t)(comma - url->text);
    *base64 = at - start >= 7 && strncasecmp(url->text + at - 7, ";base64", 7) == 0;
    return at + 1;
}

static int sextet(unsigned char c) {
    if (c >= 'A' && c <= 'Z')
        return c - 'A';
    if (c >= 'a' && c <= 'z')
        return c - 'a' + 26;
    if (c >= '0' && c <= '9')
        return c - '0' + 52;
    return c == '+' || c == '-' ? 62 : c == '/' || c == '_' ? 63 : -1;
}

/* Writes at most length * 3 / 4 bytes; SIZE_MAX: not base64. */
static size_t decode_base64(const char *text, size_t length, char *out) {
    uint32_t bits = 0;
    unsigned count = 0;
    size_t used = 0;
    for (size_t i = 0; i < length && text[i] != '='; i++) {
        if ((unsigned char)text[i] <= ' ')
            continue;
        int value = sextet((unsigned char)text[i]);
        if (value < 0)
            return SIZE_MAX;
        bits = bits << 6 | (uint32_t)value;
        count += 6;
        if (count >= 8) {
            count -= 8;
            out[used++] = (char)(bits >> count & 0xff);
        }
    }
    return used;
}

/* ---- Loading ---- */

static x3d_failure load_data(plr_scene *scene, const plr_string *url, size_t start,
                             plr_bytes *bytes) {
    bool base64 = false;
    size_t at = data_start(url, start, &base64), length = url->length - at;
    char *data = x3d_block_copy(&scene->allocator, url->text + at, length);
    if (!data)
        return (x3d_failure){PLR_CODE_NO_MEMORY, "does not fit into memory"};
    if (base64) {
        length = decode_base64(url->text + at, length, data);
        if (length == SIZE_MAX) {
            x3d_block_free(data);
            return (x3d_failure){PLR_CODE_BAD_VALUE, "is no base64"};
        }
        data[length] = '\0';
    }
    bytes->data = data;
    bytes->length = length;
    return (x3d_failure){PLR_CODE_MISSING_FILE, NULL};
}

static x3d_failure load_located(plr_scene *scene, const x3d_located *located, bool gunzip,
                                plr_bytes *bytes) {
    x3d_failure failure = x3d_read_located(scene, located, gunzip, &bytes->data, &bytes->length);
    if (failure.text)
        return failure;
    bytes->name = x3d_block_copy(&scene->allocator, located->name, strlen(located->name));
    if (bytes->name)
        return failure;
    plr_bytes_free(bytes);
    return (x3d_failure){PLR_CODE_NO_MEMORY, "does not fit into memory"};
}

x3d_failure x3d_load_url(plr_scene *scene, const plr_string *url, bool gunzip, plr_bytes *bytes,
                         const char **name) {
    size_t start;
    *name = "the data: url";
    *bytes = (plr_bytes){0};
    if (is_data(url, &start)) {
        x3d_failure failure = load_data(scene, url, start, bytes);
        if (!failure.text && !(bytes->name = x3d_block_copy(&scene->allocator, "data:", 5))) {
            plr_bytes_free(bytes);
            failure = (x3d_failure){PLR_CODE_NO_MEMORY, "does not fit into memory"};
        }
        return failure;
    }
    const x3d_file *file = x3d_file_of_name(scene, url->origin.file);
    x3d_located located;
    x3d_failure failure =
        x3d_locate(scene, file->folder, file->name, url->text, url->length, &located);
    *name = located.name;
    return failure.text ? failure : load_located(scene, &located, gunzip, bytes);
}

bool plr_scene_load(plr_scene *scene, const plr_string *url, bool gunzip, plr_bytes *bytes,
                    plr_diags *diags) {
    entry e;
    *bytes = (plr_bytes){0};
    enter(&e, scene, diags);
    if (setjmp(e.out_of_memory) != 0)
        return out_of_memory(&e, scene, place_of(url));
    const char *name;
    x3d_failure failure = x3d_load_url(scene, url, gunzip, bytes, &name);
    if (failure.text)
        x3d_report(scene, failure.code, place_of(url), "'%.300s' %s", name, failure.text);
    leave(&e, scene);
    return !failure.text;
}

bool plr_scene_load_first(plr_scene *scene, const plr_field *urls, bool gunzip, plr_bytes *bytes,
                          size_t *index, plr_diags *diags) {
    entry e;
    *bytes = (plr_bytes){0};
    if (!urls || plr_type_kind(urls->type) != PLR_STRING)
        return false;
    enter(&e, scene, diags);
    if (setjmp(e.out_of_memory) != 0)
        return out_of_memory(&e, scene, urls->place);
    x3d_failure first = {PLR_CODE_MISSING_FILE, "no url is given"};
    const char *first_name = "";
    plr_place place = urls->place;
    bool loaded = false;
    for (size_t i = 0; i < urls->count && !loaded; i++) {
        const char *name;
        x3d_failure failure = x3d_load_url(scene, &urls->value.strings[i], gunzip, bytes, &name);
        loaded = !failure.text;
        if (loaded && index)
            *index = i;
        if (!loaded && i == 0) {
            first = failure;
            first_name = name;
            place = place_of(&urls->value.strings[0]);
        }
    }
    if (!loaded && urls->count)
        x3d_report(scene, first.code, place, "'%.300s' %s", first_name, first.text);
    else if (!loaded)
        x3d_report(scene, first.code, place, "%s", first.text);
    leave(&e, scene);
    return loaded;
}

static const char *folder_of_name(plr_scene *scene, const char *referrer) {
    const char *slash = strrchr(referrer, '/');
    for (const x3d_file *file = scene->files; file; file = file->next)
        if (strcmp(file->name, referrer) == 0)
            return file->folder;
    const x3d_file *main = x3d_file_of_name(scene, NULL);
    if (!slash)
        return main->folder;
    const char *folder = plr_arena_copy(&scene->arena, referrer, (size_t)(slash - referrer));
    /* Names begin with the folder of the main file as its own path gives it. */
    const char *main_slash = strrchr(main->name, '/');
    size_t prefix = main_slash ? (size_t)(main_slash - main->name) : 0;
    if (*referrer == '/' && !(main_slash && *main->name == '/'))
        return *folder ? folder : "/";
    if (prefix && strncmp(folder, main->name, prefix) == 0)
        return plr_arena_format(&scene->arena, "%s%s", main->folder, folder + prefix);
    if (*folder == '/')
        return folder;
    return plr_arena_format(&scene->arena, "%s/%s", main->folder, folder);
}

bool plr_scene_load_beside(plr_scene *scene, const char *referrer, const char *name, bool gunzip,
                           plr_place place, plr_bytes *bytes, plr_diags *diags) {
    entry e;
    *bytes = (plr_bytes){0};
    enter(&e, scene, diags);
    if (setjmp(e.out_of_memory) != 0)
        return out_of_memory(&e, scene, place);
    x3d_located located;
    x3d_failure failure =
        x3d_locate(scene, folder_of_name(scene, referrer), referrer, name, strlen(name), &located);
    if (!failure.text)
        failure = load_located(scene, &located, gunzip, bytes);
    if (failure.text)
        x3d_report(scene, failure.code, place, "'%.300s' %s", located.name, failure.text);
    leave(&e, scene);
    return !failure.text;
}

/* ---- Folders ---- */

/* How much of a url names the folder, the last '/' included; 0: it names none. */
static size_t folder_length(const plr_string *url) {
    size_t start;
    const char *mark = url->length ? memchr(url->text, '#', url->length) : NULL;
    size_t length = mark ? (size_t)(mark - url->text) : url->length;
    bool ends = length && url->text[length - 1] == '/' && length < 4096;
    return ends && !is_data(url, &start) ? length : 0;
}

bool plr_url_is_folder(const plr_string *url) {
    return folder_length(url) > 0;
}

static x3d_failure list_url(plr_scene *scene, const plr_string *url, size_t limit, plr_bytes *names,
                            const char **name) {
    const x3d_file *file = x3d_file_of_name(scene, url->origin.file);
    x3d_located located;
    x3d_failure failure =
        x3d_locate(scene, file->folder, file->name, url->text, folder_length(url), &located);
    *name = located.name;
    if (!failure.text)
        failure = x3d_list_located(scene, &located, limit, names);
    if (failure.text)
        return failure;
    names->name = x3d_block_copy(&scene->allocator, located.name, strlen(located.name));
    return names->name ? failure : (x3d_failure){PLR_CODE_NO_MEMORY, "does not fit into memory"};
}

bool plr_scene_list(plr_scene *scene, const plr_string *url, size_t limit, plr_bytes *names,
                    plr_diags *diags) {
    entry e;
    *names = (plr_bytes){0};
    enter(&e, scene, diags);
    if (setjmp(e.out_of_memory) != 0) {
        plr_bytes_free(names);
        return out_of_memory(&e, scene, place_of(url));
    }
    const char *name;
    x3d_failure failure = list_url(scene, url, limit, names, &name);
    if (failure.text) {
        plr_bytes_free(names);
        x3d_report(scene, failure.code, place_of(url), "'%.300s' %s", name, failure.text);
    }
    leave(&e, scene);
    return !failure.text;
}

void plr_bytes_free(plr_bytes *bytes) {
    x3d_block_free(bytes->data);
    x3d_block_free(bytes->name);
    *bytes = (plr_bytes){0};
}

/* ---- Source code ---- */

/* Source text never looks like the name of a file. */
static bool is_inline_code(const plr_string *url) {
    for (size_t i = 0; i < url->length; i++)
        if (strchr("\n{;(", url->text[i]) && url->text[i])
            return true;
    return false;
}

static x3d_failure code_of_data(plr_scene *scene, const plr_string *url, size_t start,
                                plr_string *code) {
    bool base64 = false;
    size_t at = data_start(url, start, &base64);
    *code = x3d_string_tail(&scene->arena, url, at);
    if (!base64)
        return (x3d_failure){PLR_CODE_MISSING_FILE, NULL};
    char *decoded = plr_arena_alloc(&scene->arena, code->length + 1);
    size_t length = decode_base64(code->text, code->length, decoded);
    if (length == SIZE_MAX)
        return (x3d_failure){PLR_CODE_BAD_VALUE, "is no base64"};
    decoded[length] = '\0';
    code->text = decoded;
    code->length = length;
    return (x3d_failure){PLR_CODE_MISSING_FILE, NULL};
}

static x3d_failure code_of_file(plr_scene *scene, const plr_string *url, plr_string *code,
                                const char **name) {
    const x3d_file *referrer = x3d_file_of_name(scene, url->origin.file);
    x3d_located located;
    x3d_failure failure =
        x3d_locate(scene, referrer->folder, referrer->name, url->text, url->length, &located);
    *name = located.name;
    if (failure.text)
        return failure;
    x3d_file *file = scene->files;
    while (file && strcmp(file->name, located.name) != 0)
        file = file->next;
    if (!file) {
        char *data = NULL;
        size_t length = 0;
        failure = x3d_read_located(scene, &located, true, &data, &length);
        if (failure.text)
            return failure;
        file = x3d_add_file(scene, located.name, located.folder ? located.folder : "/",
                            located.real, data, length);
    }
    *code = (plr_string){file->text, file->length, {file->name, 1, 1, NULL, 0}};
    return failure;
}

static x3d_failure code_of(plr_scene *scene, const plr_string *url, plr_string *code,
                           const char **name) {
    size_t start;
    *name = "the data: url";
    if (is_data(url, &start))
        return code_of_data(scene, url, start, code);
    if (is_inline_code(url)) {
        *code = *url;
        return (x3d_failure){PLR_CODE_MISSING_FILE, NULL};
    }
    return code_of_file(scene, url, code, name);
}

bool plr_scene_code(plr_scene *scene, const plr_node *node, const char *field, plr_string *code,
                    plr_diags *diags) {
    const plr_field *urls = plr_node_field(node, field);
    entry e;
    *code = (plr_string){.text = ""};
    if (!urls || plr_type_kind(urls->type) != PLR_STRING || !urls->count)
        return false;
    enter(&e, scene, diags);
    if (setjmp(e.out_of_memory) != 0)
        return out_of_memory(&e, scene, urls->place);
    x3d_failure first = {PLR_CODE_MISSING_FILE, NULL};
    const char *first_name = "";
    bool found = false;
    for (size_t i = 0; i < urls->count && !found; i++) {
        const char *name = "";
        x3d_failure failure = code_of(scene, &urls->value.strings[i], code, &name);
        found = !failure.text;
        if (!found && !first.text) {
            first = failure;
            first_name = name;
        }
    }
    if (!found)
        x3d_report(scene, first.code, place_of(&urls->value.strings[0]), "'%.300s' %s", first_name,
                   first.text);
    leave(&e, scene);
    return found;
}
