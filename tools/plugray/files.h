/* Files of the command line: read whole, replaced as a whole. */
#ifndef PLUGRAY_TOOL_FILES_H
#define PLUGRAY_TOOL_FILES_H

#include <stdio.h>

#include <plugray/base.h>

/* All bytes of a file, or of standard input if `path` is "-", with a NUL beyond; free them. On
 * failure NULL, and an error about `path`. At most `maximum` bytes. */
char *file_read(const char *path, size_t maximum, size_t *length, plr_diags *diags);

/* A file being written: `stream` is memory until output_close puts all of it into the file. */
typedef struct output_file {
    FILE *stream;
    char *path, *text;
    size_t length;
} output_file;

/* Begins, making missing folders. False with an error. */
bool output_open(output_file *file, const char *path, plr_diags *diags);
/* Writes the file as a whole. False with an error. */
bool output_close(output_file *file, plr_diags *diags);

/* Makes `folder` and what is missing above it. False with an error. */
bool folder_make(const char *folder, plr_diags *diags);
/* Makes the folders above the file `path`. */
bool folder_make_above(const char *path, plr_diags *diags);

/* malloc'ed text, or the program ends: out of memory in a command line tool. */
char *text_format(const char *format, ...) PLR_PRINTF(1, 2);
void *memory_array(void *old, size_t count, size_t size);

#endif
