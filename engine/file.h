/* Bytes in memory that grow, and files that are replaced as a whole. */
#ifndef PLR_ENGINE_FILE_H
#define PLR_ENGINE_FILE_H

#include <stdbool.h>
#include <stddef.h>

typedef struct plr_buffer {
    unsigned char *data;
    size_t length, capacity;
} plr_buffer;

/* Writes at `offset`, which may lie beyond the end (zeros fill the gap). False without memory. */
bool plr_buffer_write_at(plr_buffer *buffer, size_t offset, const void *data, size_t length);
bool plr_buffer_append(plr_buffer *buffer, const void *data, size_t length);
void plr_buffer_free(plr_buffer *buffer);

/* Writes the file: to a new name beside it, that then takes its place, so that no reader ever sees
 * a part of it; links are followed; what is no regular file (a pipe) is written to directly.
 * Returns 0 or an errno. */
int plr_file_write(const char *path, const void *data, size_t length);

#endif
