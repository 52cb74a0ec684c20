/* Reading files under the rules of a scene. */
#ifndef PLR_X3D_FILES_H
#define PLR_X3D_FILES_H

#include "x3d/scene.h"

/* Why something cannot be read; `text` NULL: nothing is wrong. */
typedef struct x3d_failure {
    plr_code code;
    const char *text;
} x3d_failure;

/* A url led back to something that can be read. */
typedef struct x3d_located {
    const char *name;   /* for messages */
    const char *path;   /* absolute; NULL: the network, by `name` */
    const char *real;   /* without symbolic links */
    const char *folder; /* of `path` */
} x3d_located;

/* Works out which real folders may be read. `path`: of the main file; NULL or "-": the current
 * folder. Returns the absolute folder that relative urls of the main file start from. */
const char *x3d_find_roots(plr_scene *scene, const char *path);
/* Where a url leads, relative to a folder whose files messages name `referrer`. */
x3d_failure x3d_locate(plr_scene *scene, const char *folder, const char *referrer, const char *url,
                       size_t length, x3d_located *located);
/* Reads and, if asked, unpacks. `data` is of x3d_block_new. */
x3d_failure x3d_read_located(plr_scene *scene, const x3d_located *located, bool gunzip, char **data,
                             size_t *length);
/* The names of the files in a folder, each with its NUL, in the order of their bytes; no hidden
 * ones. `bytes->name` is left alone. */
x3d_failure x3d_list_located(plr_scene *scene, const x3d_located *located, size_t limit,
                             plr_bytes *bytes);
/* Reads a path as it is, wherever it leads: the file that the caller names. */
x3d_failure x3d_read_path(plr_scene *scene, const char *path, char **data, size_t *length);

/* Reads what a url of a file that was read means, "data:" included; its origin says which file.
 * `name` is for messages. */
x3d_failure x3d_load_url(plr_scene *scene, const plr_string *url, bool gunzip, plr_bytes *bytes,
                         const char **name);

bool x3d_is_gzip(const char *data, size_t length);
/* Unpacks; `data` is then a new block. `name` is for the scene's progress. */
x3d_failure x3d_gunzip(plr_scene *scene, const char *name, const char *packed, size_t packed_length,
                       char **data, size_t *length);

/* Memory that knows its allocator, so that it can outlive the scene. NULL without memory. */
char *x3d_block_new(const plr_allocator *allocator, size_t size);
char *x3d_block_resize(char *block, size_t size);
void x3d_block_free(char *block);
char *x3d_block_copy(const plr_allocator *allocator, const char *text, size_t length);

#endif
