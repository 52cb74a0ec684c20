/* realpath is an X/Open function */
#define _XOPEN_SOURCE 700

#include "x3d/files.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdalign.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

/* ---- Memory ---- */

typedef struct block {
    plr_allocator allocator;
    alignas(max_align_t) char data[];
} block;

static block *block_of(char *data) {
    return (block *)(void *)(data - offsetof(block, data));
}

char *x3d_block_new(const plr_allocator *allocator, size_t size) {
    plr_allocator resolved = plr_allocator_resolve(allocator);
    if (size > SIZE_MAX - sizeof(block))
        return NULL;
    block *made = resolved.reallocate(resolved.user, NULL, sizeof(block) + size);
    if (!made)
        return NULL;
    made->allocator = resolved;
    return made->data;
}

char *x3d_block_resize(char *data, size_t size) {
    block *old = block_of(data);
    if (size > SIZE_MAX - sizeof(block))
        return NULL;
    block *made = old->allocator.reallocate(old->allocator.user, old, sizeof(block) + size);
    return made ? made->data : NULL;
}

void x3d_block_free(char *data) {
    if (!data)
        return;
    plr_allocator allocator = block_of(data)->allocator;
    allocator.release(allocator.user, block_of(data));
}

char *x3d_block_copy(const plr_allocator *allocator, const char *text, size_t length) {
    char *copy = x3d_block_new(allocator, length + 1);
    if (copy) {
        memcpy(copy, text, length);
        copy[length] = '\0';
    }
    return copy;
}

static const x3d_failure fine = {PLR_CODE_MISSING_FILE, NULL};
static const x3d_failure no_memory = {PLR_CODE_NO_MEMORY, "not enough memory to read the file"};

static x3d_failure fail(plr_code code, const char *text) {
    return (x3d_failure){code, text};
}

/* ---- Where a url leads ---- */

static const char *real_path(plr_scene *scene, const char *path) {
    char *real = realpath(path, NULL);
    if (!real)
        return NULL;
    const char *volatile copy = NULL;
    jmp_buf *outer = scene->arena.out_of_memory, here;
    scene->arena.out_of_memory = &here;
    if (setjmp(here) == 0)
        copy = plr_arena_copy(&scene->arena, real, strlen(real));
    scene->arena.out_of_memory = outer;
    free(real);
    if (!copy)
        longjmp(*outer, 1);
    return copy;
}

static const char *folder_of(plr_scene *scene, const char *path) {
    const char *slash = strrchr(path, '/');
    if (!slash)
        return ".";
    return plr_arena_copy(&scene->arena, path, slash == path ? 1 : (size_t)(slash - path));
}

const char *x3d_find_roots(plr_scene *scene, const char *path) {
    bool here = !path || strcmp(path, "-") == 0;
    const char *folder = real_path(scene, here ? "." : folder_of(scene, path));
    const char **roots = PLR_NEW_ARRAY(&scene->arena, scene->rules.allowed_count + 2, const char *);
    size_t count = 0;
    if (folder)
        roots[count++] = folder;
    for (size_t i = 0; i < scene->rules.allowed_count; i++) {
        const char *real = real_path(scene, scene->rules.allowed[i]);
        if (real)
            roots[count++] = real;
    }
    scene->roots = roots;
    return folder ? folder : "/";
}

static bool is_inside(const char *path, const char *root) {
    size_t length = strlen(root);
    while (length && root[length - 1] == '/')
        length--;
    return strncmp(path, root, length) == 0 && (path[length] == '/' || !path[length]);
}

static bool is_allowed(const plr_scene *scene, const char *path) {
    for (const char *const *root = scene->roots; *root; root++)
        if (is_inside(path, *root))
            return true;
    return false;
}

/* "a/./b/../c" -> "a/c", by the text alone: for paths that do not exist. */
static const char *tidy(plr_scene *scene, const char *path) {
    char *out = plr_arena_alloc(&scene->arena, strlen(path) + 2);
    size_t length = 0;
    for (const char *p = path; *p;) {
        while (*p == '/')
            p++;
        size_t n = strcspn(p, "/");
        if (n == 2 && p[0] == '.' && p[1] == '.') {
            while (length && out[--length] != '/')
                continue;
        } else if (n && !(n == 1 && p[0] == '.')) {
            out[length++] = '/';
            memcpy(out + length, p, n);
            length += n;
        }
        p += n;
    }
    out[length] = '\0';
    return out;
}

static int hexadecimal(char c) {
    if (c >= '0' && c <= '9')
        return c - '0';
    return c >= 'a' && c <= 'f' ? c - 'a' + 10 : c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

/* file:///a%20b -> /a b */
static const char *path_of_file_url(plr_scene *scene, const char *url) {
    url += 5;
    if (strncmp(url, "//", 2) == 0) {
        url += 2;
        if (strncmp(url, "localhost/", 10) == 0)
            url += 9;
    }
    char *path = plr_arena_copy(&scene->arena, url, strlen(url)), *out = path;
    for (const char *p = url; *p; p++) {
        if (*p == '%' && hexadecimal(p[1]) >= 0 && hexadecimal(p[2]) >= 0 &&
            (p[1] != '0' || p[2] != '0')) {
            *out++ = (char)(hexadecimal(p[1]) * 16 + hexadecimal(p[2]));
            p += 2;
        } else {
            *out++ = *p;
        }
    }
    *out = '\0';
    return path;
}

static size_t scheme_length(const char *url) {
    size_t n = 0;
    while ((url[n] >= 'a' && url[n] <= 'z') || (url[n] >= 'A' && url[n] <= 'Z') ||
           (n && (url[n] == '-' || url[n] == '+' || (url[n] >= '0' && url[n] <= '9'))))
        n++;
    return n > 1 && url[n] == ':' ? n : 0;
}

static bool has_scheme(const char *url, const char *scheme) {
    size_t n = strlen(scheme);
    return scheme_length(url) == n && strncasecmp(url, scheme, n) == 0;
}

/* The folder of the referring file as its message name has it, joined with the url. */
static const char *joined_name(plr_scene *scene, const char *referrer, const char *url) {
    const char *slash = strrchr(referrer, '/');
    if (!slash || *url == '/')
        return url;
    return plr_arena_format(&scene->arena, "%.*s/%s", (int)(slash - referrer), referrer, url);
}

/* The folder that castle-data:/ means: the nearest folder called "data" in which the main file
 * lies, else the one beside it. */
static const char *data_folder(plr_scene *scene) {
    const char *folder = x3d_file_of_name(scene, NULL)->folder;
    size_t length = strlen(folder);
    for (size_t i = length; i >= 5; i--)
        if ((i == length || folder[i] == '/') && strncmp(folder + i - 5, "/data", 5) == 0)
            return plr_arena_copy(&scene->arena, folder, i);
    return plr_arena_format(&scene->arena, "%s/data", folder);
}

/* castle-data:/a.png, which Castle Game Engine resolves in the data folder of an application. */
static const char *path_of_data_url(plr_scene *scene, const char *url) {
    url += strlen("castle-data:");
    while (*url == '/')
        url++;
    return plr_arena_format(&scene->arena, "%s/%s", data_folder(scene), url);
}

static x3d_failure locate_path(plr_scene *scene, const char *folder, const char *path,
                               x3d_located *located) {
    located->path = *path == '/' ? path : plr_arena_format(&scene->arena, "%s/%s", folder, path);
    located->folder = folder_of(scene, located->path);
    located->real = real_path(scene, located->path);
    if (!located->real) {
        if (!is_allowed(scene, tidy(scene, located->path)))
            return fail(PLR_CODE_NOT_ALLOWED, "is outside the folders that may be read");
        return fail(PLR_CODE_MISSING_FILE, "does not exist");
    }
    if (!is_allowed(scene, located->real))
        return fail(PLR_CODE_NOT_ALLOWED, "is outside the folders that may be read");
    return fine;
}

x3d_failure x3d_locate(plr_scene *scene, const char *folder, const char *referrer, const char *url,
                       size_t length, x3d_located *located) {
    *located = (x3d_located){.name = url};
    if (length >= PATH_MAX || memchr(url, '\0', length)) {
        located->name = "(a long url)";
        return fail(PLR_CODE_MISSING_FILE, "is no name of a file");
    }
    const char *text = plr_arena_copy(&scene->arena, url, length);
    located->name = text;
    if (!length)
        return fail(PLR_CODE_MISSING_FILE, "is empty");
    bool is_data_url = has_scheme(text, "castle-data");
    if (has_scheme(text, "file"))
        text = path_of_file_url(scene, text);
    else if (is_data_url)
        text = path_of_data_url(scene, text);
    else if (has_scheme(text, "http") || has_scheme(text, "https"))
        return scene->rules.allow_network && scene->rules.fetch
                   ? fine
                   : fail(PLR_CODE_NOT_ALLOWED, "is on the network, which may not be read");
    else if (scheme_length(text))
        return fail(PLR_CODE_NOT_ALLOWED, "is of a kind that plugray does not read");
    located->name = joined_name(scene, referrer, text);
    const x3d_file *main_file = x3d_file_of_name(scene, NULL);
    size_t main_length = strlen(main_file->folder);
    if (is_data_url && strncmp(text, main_file->folder, main_length) == 0 &&
        text[main_length] == '/')
        located->name = joined_name(scene, main_file->name, text + main_length + 1);
    return locate_path(scene, folder, text, located);
}

/* ---- Reading ---- */

/* Longer files are read in pieces, and the host is told how far. */
#define PIECE ((size_t)16 << 20)

static size_t max_bytes(const plr_scene *scene) {
    return scene->rules.max_bytes ? scene->rules.max_bytes : (size_t)1 << 30;
}

void plr_scene_progress(const plr_scene *scene, const char *name, double done) {
    if (scene->rules.progress)
        scene->rules.progress(scene->rules.user, name, done);
}

static x3d_failure read_open_file(plr_scene *scene, const char *name, int file, char **data,
                                  size_t *length) {
    struct stat status;
    if (fstat(file, &status) != 0)
        return fail(PLR_CODE_MISSING_FILE, "cannot be read");
    if (!S_ISREG(status.st_mode))
        return fail(PLR_CODE_NOT_ALLOWED, "is no regular file");
    if ((uintmax_t)status.st_size > max_bytes(scene))
        return fail(PLR_CODE_LIMIT, "is larger than may be read");
    size_t size = (size_t)status.st_size, used = 0;
    char *bytes = x3d_block_new(&scene->allocator, size + 1);
    if (!bytes)
        return no_memory;
    while (used < size) {
        size_t piece = size - used < PIECE ? size - used : PIECE;
        ssize_t n = read(file, bytes + used, piece);
        if (n < 0 && errno == EINTR)
            continue;
        if (n < 0) {
            x3d_block_free(bytes);
            return fail(PLR_CODE_MISSING_FILE, "cannot be read");
        }
        if (n == 0)
            break;
        used += (size_t)n;
        if (size > PIECE)
            plr_scene_progress(scene, name, (double)used / (double)size);
    }
    bytes[used] = '\0';
    *data = bytes;
    *length = used;
    return fine;
}

static x3d_failure read_file(plr_scene *scene, const char *name, const char *path, int flags,
                             char **data, size_t *length) {
    /* O_NONBLOCK: a pipe without a writer must not hold us up. */
    int file = open(path, O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC | flags);
    if (file < 0)
        return errno == ENOENT || errno == ENOTDIR
                   ? fail(PLR_CODE_MISSING_FILE, "does not exist")
                   : fail(PLR_CODE_MISSING_FILE, "cannot be opened");
    x3d_failure failure = read_open_file(scene, name, file, data, length);
    close(file);
    return failure;
}

static x3d_failure fetch(plr_scene *scene, const char *url, char **data, size_t *length) {
    char *fetched = scene->rules.fetch(scene->rules.user, url, length);
    if (!fetched)
        return fail(PLR_CODE_MISSING_FILE, "cannot be fetched");
    if (*length > max_bytes(scene)) {
        free(fetched);
        return fail(PLR_CODE_LIMIT, "is larger than may be read");
    }
    *data = x3d_block_copy(&scene->allocator, fetched, *length);
    free(fetched);
    return *data ? fine : no_memory;
}

static x3d_failure unpack(plr_scene *scene, const char *name, char **data, size_t *length) {
    if (!x3d_is_gzip(*data, *length))
        return fine;
    char *packed = *data;
    x3d_failure failure = x3d_gunzip(scene, name, packed, *length, data, length);
    x3d_block_free(packed);
    return failure;
}

x3d_failure x3d_read_located(plr_scene *scene, const x3d_located *located, bool gunzip, char **data,
                             size_t *length) {
    x3d_failure failure =
        located->path ? read_file(scene, located->name, located->real, O_NOFOLLOW, data, length)
                      : fetch(scene, located->name, data, length);
    return failure.text || !gunzip ? failure : unpack(scene, located->name, data, length);
}

x3d_failure x3d_read_path(plr_scene *scene, const char *path, char **data, size_t *length) {
    x3d_failure failure = read_file(scene, path, path, 0, data, length);
    return failure.text ? failure : unpack(scene, path, data, length);
}
