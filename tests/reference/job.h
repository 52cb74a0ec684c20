/* JSON objects of a job, read strictly: what is unknown is an error. Internal. */
#ifndef JOB_H
#define JOB_H

#include "reference.h"

#include <yajl/yajl_tree.h>

typedef struct ref_reader {
    char *message;
    size_t size;
    const char *path; /* of the job: files are looked for beside it */
} ref_reader;

bool ref_fail(ref_reader *reader, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* A member of an object, or NULL. */
yajl_val ref_member(yajl_val object, const char *name);
bool ref_known(ref_reader *reader, yajl_val object, const char *what, const char *const *names);
/* Numbers, which keep their value where the member is missing. */
bool ref_numbers(ref_reader *reader, yajl_val object, const char *name, double *values,
                 size_t count);
bool ref_bool(yajl_val object, const char *name);
const char *ref_string(yajl_val object, const char *name);
bool ref_is_array(yajl_val value);
bool ref_grid_read(ref_reader *reader, yajl_val object, ref_grid *grid);
bool ref_volume_read(ref_reader *reader, yajl_val object, ref_volume *volume);
void ref_volume_free(ref_volume *volume);

#endif
