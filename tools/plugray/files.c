#include "tools/plugray/files.h"

#include <errno.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "engine/file.h"
#include "tools/plugray/options.h"

static void out_of_memory(void) {
    fputs("plugray: there is not enough memory\n", stderr);
    exit(STATUS_MACHINE);
}

char *text_format(const char *format, ...) {
    va_list rest;
    va_start(rest, format);
    int length = vsnprintf(NULL, 0, format, rest);
    va_end(rest);
    char *text = length < 0 ? NULL : malloc((size_t)length + 1);
    if (!text)
        out_of_memory();
    va_start(rest, format);
    vsnprintf(text, (size_t)length + 1, format, rest);
    va_end(rest);
    return text;
}

void *memory_array(void *old, size_t count, size_t size) {
    void *array =
        size && count > SIZE_MAX / size ? NULL : realloc(old, count && size ? count * size : 1);
    if (!array)
        out_of_memory();
    return array;
}

/* ---- Reading ---- */

static bool is_folder(FILE *stream) {
    struct stat status;
    return fstat(fileno(stream), &status) == 0 && S_ISDIR(status.st_mode);
}

static char *read_stream(FILE *stream, size_t maximum, size_t *length) {
    size_t room = 65536, used = 0;
    char *text = memory_array(NULL, room, 1);
    for (size_t got; (got = fread(text + used, 1, room - used - 1, stream)) > 0;) {
        used += got;
        if (used > maximum) {
            errno = EFBIG;
            free(text);
            return NULL;
        }
        if (room - used < 2)
            text = memory_array(text, room *= 2, 1);
    }
    if (ferror(stream)) {
        free(text);
        return NULL;
    }
    text[used] = '\0';
    *length = used;
    return text;
}

char *file_read(const char *path, size_t maximum, size_t *length, plr_diags *diags) {
    bool standard = strcmp(path, "-") == 0;
    FILE *stream = standard ? stdin : fopen(path, "rb");
    char *text = NULL;
    if (stream && is_folder(stream))
        errno = EISDIR;
    else if (stream)
        text = read_stream(stream, maximum, length);
    if (!text)
        plr_diags_add(diags, PLR_CODE_MISSING_FILE, (plr_place){path, 0, 0}, "cannot be read: %s",
                      strerror(errno));
    if (stream && !standard)
        fclose(stream);
    return text;
}

/* ---- Writing ---- */

static bool cannot_write(const char *path, plr_diags *diags) {
    plr_diags_add(diags, PLR_CODE_OUTPUT, (plr_place){path, 0, 0}, "cannot be written: %s",
                  strerror(errno));
    return false;
}

bool folder_make(const char *folder, plr_diags *diags) {
    char *path = text_format("%s", folder);
    bool made = true;
    for (char *end = path + 1; made && *path; end++) {
        char kept = *end;
        if (kept == '/' || !kept) {
            *end = '\0';
            made = mkdir(path, 0777) == 0 || errno == EEXIST || errno == EISDIR;
            *end = kept;
        }
        if (!kept)
            break;
    }
    struct stat status;
    if (made && stat(*path ? path : ".", &status) == 0 && !S_ISDIR(status.st_mode)) {
        errno = ENOTDIR;
        made = false;
    }
    free(path);
    return made || cannot_write(folder, diags);
}

bool folder_make_above(const char *path, plr_diags *diags) {
    const char *slash = strrchr(path, '/');
    if (!slash || slash == path)
        return true;
    char *folder = text_format("%.*s", (int)(slash - path), path);
    bool made = folder_make(folder, diags);
    free(folder);
    return made;
}

bool output_open(output_file *file, const char *path, plr_diags *diags) {
    memset(file, 0, sizeof *file);
    if (!folder_make_above(path, diags))
        return false;
    file->path = text_format("%s", path);
    file->stream = open_memstream(&file->text, &file->length);
    if (!file->stream)
        out_of_memory();
    return true;
}

bool output_close(output_file *file, plr_diags *diags) {
    if (fclose(file->stream) != 0)
        out_of_memory();
    errno = plr_file_write(file->path, file->text, file->length);
    bool written = errno == 0 || cannot_write(file->path, diags);
    free(file->text);
    free(file->path);
    return written;
}
