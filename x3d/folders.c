/* What a folder holds. */
#define _XOPEN_SOURCE 700 /* fdopendir */

#include "x3d/files.h"

#include <dirent.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Names one behind the other, each with its NUL. */
typedef struct name_list {
    char *text;
    size_t length, capacity, count;
} name_list;

static bool add_name(name_list *list, const plr_allocator *allocator, const char *name) {
    size_t size = strlen(name) + 1;
    if (list->length + size > list->capacity) {
        size_t capacity = list->capacity * 2 + size + 256;
        char *grown = list->text ? x3d_block_resize(list->text, capacity)
                                 : x3d_block_new(allocator, capacity);
        if (!grown)
            return false;
        list->text = grown;
        list->capacity = capacity;
    }
    memcpy(list->text + list->length, name, size);
    list->length += size;
    list->count++;
    return true;
}

/* Files, and links, whose ends are looked at where they are read. */
static bool is_wanted(DIR *folder, const char *name) {
    struct stat status;
    return *name != '.' && fstatat(dirfd(folder), name, &status, AT_SYMLINK_NOFOLLOW) == 0 &&
           (S_ISREG(status.st_mode) || S_ISLNK(status.st_mode));
}

static x3d_failure read_names(plr_scene *scene, DIR *folder, size_t limit, name_list *list) {
    for (const struct dirent *entry; (entry = readdir(folder));) {
        if (!is_wanted(folder, entry->d_name))
            continue;
        if (list->count == limit)
            return (x3d_failure){PLR_CODE_LIMIT, "holds more files than may be read"};
        if (!add_name(list, &scene->allocator, entry->d_name))
            return (x3d_failure){PLR_CODE_NO_MEMORY, "does not fit into memory"};
    }
    return (x3d_failure){PLR_CODE_MISSING_FILE, NULL};
}

static int compare_names(const void *a, const void *b) {
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

/* The names in order, in a block of their exact size. */
static char *sorted(const plr_allocator *allocator, const name_list *list) {
    const char **names =
        (const char **)(void *)x3d_block_new(allocator, (list->count + 1) * sizeof(const char *));
    char *out = x3d_block_new(allocator, list->length + 1), *to = out;
    const char *at = list->text;
    if (names && out) {
        for (size_t i = 0; i < list->count; i++, at += strlen(at) + 1)
            names[i] = at;
        qsort(names, list->count, sizeof *names, compare_names);
        for (size_t i = 0; i < list->count; i++)
            to = stpcpy(to, names[i]) + 1;
        *to = '\0';
    } else {
        x3d_block_free(out);
        out = NULL;
    }
    x3d_block_free((char *)(void *)names);
    return out;
}

x3d_failure x3d_list_located(plr_scene *scene, const x3d_located *located, size_t limit,
                             plr_bytes *bytes) {
    if (!located->path)
        return (x3d_failure){PLR_CODE_NOT_ALLOWED, "is on the network, where folders have no list"};
    int file = open(located->real, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    DIR *folder = file < 0 ? NULL : fdopendir(file);
    if (!folder) {
        if (file >= 0)
            close(file);
        return (x3d_failure){PLR_CODE_MISSING_FILE, "is no folder that can be read"};
    }
    name_list list = {0};
    x3d_failure failure = read_names(scene, folder, limit, &list);
    closedir(folder);
    if (!failure.text && !(bytes->data = sorted(&scene->allocator, &list)))
        failure = (x3d_failure){PLR_CODE_NO_MEMORY, "does not fit into memory"};
    bytes->length = list.length;
    x3d_block_free(list.text);
    return failure;
}
