/* realpath and fchmod belong to the X/Open part of POSIX. */
#define _XOPEN_SOURCE 700

#include "engine/file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

bool plr_buffer_write_at(plr_buffer *buffer, size_t offset, const void *data, size_t length) {
    if (offset > SIZE_MAX / 4 || length > SIZE_MAX / 4)
        return false;
    size_t end = offset + length;
    if (end > buffer->capacity) {
        size_t capacity = buffer->capacity < 4096 ? 4096 : buffer->capacity;
        while (capacity < end)
            capacity *= 2;
        unsigned char *larger = realloc(buffer->data, capacity);
        if (!larger)
            return false;
        buffer->data = larger;
        buffer->capacity = capacity;
    }
    if (offset > buffer->length)
        memset(buffer->data + buffer->length, 0, offset - buffer->length);
    if (length)
        memcpy(buffer->data + offset, data, length);
    if (end > buffer->length)
        buffer->length = end;
    return true;
}

bool plr_buffer_append(plr_buffer *buffer, const void *data, size_t length) {
    return plr_buffer_write_at(buffer, buffer->length, data, length);
}

void plr_buffer_free(plr_buffer *buffer) {
    free(buffer->data);
    *buffer = (plr_buffer){0};
}

static int write_all(int file, const unsigned char *data, size_t length) {
    while (length) {
        ssize_t written = write(file, data, length);
        if (written < 0 && errno == EINTR)
            continue;
        if (written < 0)
            return errno;
        data += written;
        length -= (size_t)written;
    }
    return 0;
}

/* Writes and closes. */
static int fill(int file, const void *data, size_t length) {
    int error = write_all(file, data, length);
    if (close(file) && !error)
        error = errno;
    return error;
}

static int write_direct(const char *path, const void *data, size_t length) {
    int file = open(path, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    return file < 0 ? errno : fill(file, data, length);
}

/* Opens a new file whose name is `path` and a suffix; returns -1 with errno set. */
static int open_beside(const char *path, char *name, size_t size) {
    for (unsigned attempt = 0; attempt < 1000; attempt++) {
        snprintf(name, size, "%s.%ld-%u.new", path, (long)getpid(), attempt);
        int file = open(name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (file >= 0 || errno != EEXIST)
            return file;
    }
    return -1;
}

static int replace(const char *path, const struct stat *old, const void *data, size_t length) {
    size_t size = strlen(path) + 64;
    char *name = malloc(size);
    if (!name)
        return ENOMEM;
    int file = open_beside(path, name, size);
    int error = file < 0 ? errno : 0;
    if (!error && old && fchmod(file, old->st_mode & 07777))
        error = 0; /* a file system without permissions: not worth a failure */
    if (!error) {
        error = fill(file, data, length);
        if (!error && rename(name, path))
            error = errno;
        if (error)
            unlink(name);
    }
    free(name);
    return error;
}

int plr_file_write(const char *path, const void *data, size_t length) {
    struct stat old;
    if (stat(path, &old))
        return errno == ENOENT ? replace(path, NULL, data, length) : errno;
    if (!S_ISREG(old.st_mode))
        return S_ISDIR(old.st_mode) ? EISDIR : write_direct(path, data, length);
    char *target = realpath(path, NULL);
    if (!target)
        return errno;
    int error = replace(target, &old, data, length);
    free(target);
    return error;
}
