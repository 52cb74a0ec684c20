#include "engine/cache_folder.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* A file: the magic, which tells the version; the key; the digest of all that follows; the format
 * of the binary, 4 bytes, little endian; the binary, to the end. */
static const char magic[8] = {'p', 'l', 'r', 'p', 'r', 'o', 'g', '1'};
enum {
    KEY_AT = sizeof magic,
    DIGEST_AT = KEY_AT + PLR_SHA256_SIZE,
    FORMAT_AT = DIGEST_AT + PLR_SHA256_SIZE,
    BINARY_AT = FORMAT_AT + 4
};

static const char ending[] = ".program";
enum {
    NAME_LENGTH = 2 * PLR_SHA256_SIZE + sizeof ending - 1
};

/* The path of the key's file; to be freed. */
static char *file_of(const plr_cache_folder *folder, const uint8_t key[PLR_SHA256_SIZE]) {
    size_t length = strlen(folder->path), size = length + 1 + NAME_LENGTH + 1;
    char *path = malloc(size);
    if (!path)
        return NULL;
    char *at = path + snprintf(path, size, "%s/", folder->path);
    for (int i = 0; i < PLR_SHA256_SIZE; i++)
        at += snprintf(at, 3, "%02x", key[i]);
    memcpy(at, ending, sizeof ending);
    return path;
}

/* Makes all folders of a path that are missing; those of ours are private. */
static bool make_folders(char *path) {
    for (char *at = path + 1; at[-1]; at++)
        if (*at == '/' || !*at) {
            char kept = *at;
            *at = 0;
            bool made = !mkdir(path, 0700) || errno == EEXIST;
            *at = kept;
            if (!made)
                return false;
        }
    return true;
}

bool plr_cache_folder_open(plr_cache_folder *folder, const char *path, size_t limit) {
    *folder = (plr_cache_folder){.limit = limit, .total = SIZE_MAX};
    size_t length = strlen(path);
    folder->path = length ? malloc(length + 1) : NULL;
    if (!folder->path)
        return false;
    memcpy(folder->path, path, length + 1);
    if (make_folders(folder->path))
        return true;
    plr_cache_folder_close(folder);
    return false;
}

void plr_cache_folder_close(plr_cache_folder *folder) {
    free(folder->path);
    folder->path = NULL;
}

/* ---- Loading ---- */

/* Reads a regular file of at most `limit` bytes. */
static bool read_file(const char *path, size_t limit, plr_buffer *content) {
    int file = open(path, O_RDONLY | O_CLOEXEC);
    struct stat status;
    char part[16384];
    ssize_t got = -1;
    if (file < 0)
        return false;
    if (!fstat(file, &status) && S_ISREG(status.st_mode))
        while ((got = read(file, part, sizeof part)) > 0)
            if (content->length > limit || !plr_buffer_append(content, part, (size_t)got))
                break;
    close(file);
    return got == 0;
}

static void digest_of(const unsigned char *content, size_t length,
                      uint8_t digest[PLR_SHA256_SIZE]) {
    plr_sha256 hash;
    plr_sha256_start(&hash);
    plr_sha256_add(&hash, content + FORMAT_AT, length - FORMAT_AT);
    plr_sha256_finish(&hash, digest);
}

static bool is_sound(const plr_buffer *content, const uint8_t key[PLR_SHA256_SIZE]) {
    uint8_t digest[PLR_SHA256_SIZE];
    if (content->length <= BINARY_AT || memcmp(content->data, magic, sizeof magic) != 0 ||
        memcmp(content->data + KEY_AT, key, PLR_SHA256_SIZE) != 0)
        return false;
    digest_of(content->data, content->length, digest);
    return memcmp(content->data + DIGEST_AT, digest, sizeof digest) == 0;
}

bool plr_cache_folder_load(plr_cache_folder *folder, const uint8_t key[PLR_SHA256_SIZE],
                           uint32_t *format, plr_buffer *binary) {
    char *path = file_of(folder, key);
    bool loaded = path && read_file(path, folder->limit, binary);
    bool sound = loaded && is_sound(binary, key);
    if (sound) {
        *format = 0;
        for (int i = 0; i < 4; i++)
            *format |= (uint32_t)binary->data[FORMAT_AT + i] << (8 * i);
        binary->length -= BINARY_AT;
        memmove(binary->data, binary->data + BINARY_AT, binary->length);
        utimensat(AT_FDCWD, path, NULL, 0);
    } else if (loaded) {
        unlink(path);
    }
    free(path);
    return sound;
}

void plr_cache_folder_remove(plr_cache_folder *folder, const uint8_t key[PLR_SHA256_SIZE]) {
    char *path = file_of(folder, key);
    if (path)
        unlink(path);
    free(path);
}

/* ---- Storing ---- */

/* A file of the cache. */
typedef struct found {
    char name[NAME_LENGTH + 64]; /* temporary names have a suffix */
    struct timespec used;
    size_t size;
} found;

typedef struct findings {
    found *items;
    size_t count, capacity;
} findings;

static int by_age(const void *a, const void *b) {
    const found *x = a, *y = b;
    if (x->used.tv_sec != y->used.tv_sec)
        return x->used.tv_sec < y->used.tv_sec ? -1 : 1;
    if (x->used.tv_nsec != y->used.tv_nsec)
        return x->used.tv_nsec < y->used.tv_nsec ? -1 : 1;
    return strcmp(x->name, y->name);
}

/* Ours are those whose names start like ours: of a temporary file that was left behind, too. */
static bool is_ours(const char *name) {
    size_t digits = strspn(name, "0123456789abcdef");
    return digits == 2 * PLR_SHA256_SIZE && strlen(name) < sizeof((found *)0)->name &&
           strncmp(name + digits, ending, sizeof ending - 1) == 0;
}

static bool add_found(findings *all, const char *name, const struct stat *status) {
    if (all->count == all->capacity) {
        size_t capacity = all->capacity ? all->capacity * 2 : 64;
        found *items = realloc(all->items, capacity * sizeof *items);
        if (!items)
            return false;
        all->items = items;
        all->capacity = capacity;
    }
    found *one = &all->items[all->count++];
    memcpy(one->name, name, strlen(name) + 1); /* is_ours knows that it fits */
    one->used = status->st_mtim;
    one->size = status->st_size > 0 ? (size_t)status->st_size : 0;
    return true;
}

/* All files of ours in the folder; returns their bytes. */
static size_t look(DIR *directory, findings *all) {
    size_t total = 0;
    for (struct dirent *entry; (entry = readdir(directory));) {
        struct stat status;
        if (!is_ours(entry->d_name) ||
            fstatat(dirfd(directory), entry->d_name, &status, AT_SYMLINK_NOFOLLOW) ||
            !S_ISREG(status.st_mode))
            continue;
        if (!add_found(all, entry->d_name, &status))
            break;
        total += all->items[all->count - 1].size;
    }
    return total;
}

/* Deletes the least recently used files until at most `most` bytes are left. */
static void prune(plr_cache_folder *folder, size_t most) {
    DIR *directory = opendir(folder->path);
    findings all = {0};
    if (!directory)
        return;
    size_t total = look(directory, &all);
    if (total > most)
        qsort(all.items, all.count, sizeof *all.items, by_age);
    for (size_t i = 0; i < all.count && total > most; i++)
        if (!unlinkat(dirfd(directory), all.items[i].name, 0))
            total -= all.items[i].size;
    folder->total = total;
    free(all.items);
    closedir(directory);
}

void plr_cache_folder_store(plr_cache_folder *folder, const uint8_t key[PLR_SHA256_SIZE],
                            uint32_t format, const void *binary, size_t length) {
    if (length > folder->limit || folder->limit - length < BINARY_AT)
        return;
    size_t size = length + BINARY_AT;
    if (folder->total > folder->limit - size) /* or not known yet */
        prune(folder, folder->limit - size);
    char *path = file_of(folder, key);
    unsigned char *content = malloc(size);
    if (path && content) {
        memcpy(content, magic, sizeof magic);
        memcpy(content + KEY_AT, key, PLR_SHA256_SIZE);
        for (int i = 0; i < 4; i++)
            content[FORMAT_AT + i] = (unsigned char)(format >> (8 * i));
        memcpy(content + BINARY_AT, binary, length);
        digest_of(content, size, content + DIGEST_AT);
        if (!plr_file_write(path, content, size) && folder->total != SIZE_MAX)
            folder->total += size;
    }
    free(content);
    free(path);
}
