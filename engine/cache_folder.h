/* The folder of a program cache: program binaries in files named by their keys. No GL. */
#ifndef PLR_ENGINE_CACHE_FOLDER_H
#define PLR_ENGINE_CACHE_FOLDER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "engine/file.h"
#include "engine/sha256.h"

typedef struct plr_cache_folder {
    char *path;
    size_t limit; /* bytes of all files together, at most */
    size_t total; /* bytes of all files, as far as we know; SIZE_MAX: not looked yet */
} plr_cache_folder;

/* Makes the folder where it is missing. False if there can be none; nothing is then kept. */
bool plr_cache_folder_open(plr_cache_folder *folder, const char *path, size_t limit);
void plr_cache_folder_close(plr_cache_folder *folder);

/* The binary of that key, with its format of glProgramBinary, and marks it as used. False if there
 * is none; a file that is damaged or of another version is deleted. Free the buffer in any case. */
bool plr_cache_folder_load(plr_cache_folder *folder, const uint8_t key[PLR_SHA256_SIZE],
                           uint32_t *format, plr_buffer *binary);
/* Keeps a binary; least recently used ones go if the limit asks for it. */
void plr_cache_folder_store(plr_cache_folder *folder, const uint8_t key[PLR_SHA256_SIZE],
                            uint32_t format, const void *binary, size_t length);
void plr_cache_folder_remove(plr_cache_folder *folder, const uint8_t key[PLR_SHA256_SIZE]);

#endif
