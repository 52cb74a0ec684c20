/* The NRRD reader: which axis means what, where the data are, and their way into a volume. */
#include "engine/volume_nrrd.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- axes ---- */

/* Which axes of the file become x, y, z and components; -1: none. */
typedef struct axes {
    int spatial[3], components;
    int time;                      /* of the others, the axis along which a sample may be chosen */
    uint64_t index[NRRD_MAX_AXES]; /* the sample taken along the others */
    nrrd_role roles[NRRD_MAX_AXES];
} axes;

static void warn_first_only(const nrrd *header, const axes *a, size_t axis) {
    bool chosen = header->source->time_given && a->time == (int)axis;
    if (header->sizes[axis] > 1 && !chosen)
        plr_diags_add_as(
            header->source->diags, PLR_WARNING, PLR_CODE_BAD_VOLUME, header->sizes_place,
            "axis %zu of %llu samples is neither space nor components of a voxel; only "
            "the first sample is used",
            axis, (unsigned long long)header->sizes[axis]);
}

/* Roles where the kinds leave them open: an axis without a direction is no space; of four axes
 * without any hint, a short first one is components, else the last is time. */
static void guess_roles(const nrrd *header, nrrd_role *roles) {
    size_t count = (size_t)header->dimension, known = 0, spatial = 0;
    bool directions = header->directions_given.place.line != 0;
    for (size_t i = 0; i < count; i++) {
        roles[i] = header->kinds_given.place.line ? header->kinds[i] : NRRD_NO_ROLE;
        if (roles[i] == NRRD_NO_ROLE && directions)
            roles[i] = header->no_direction[i] ? NRRD_COMPONENTS : NRRD_SPATIAL;
        known += roles[i] != NRRD_NO_ROLE;
        spatial += roles[i] == NRRD_SPATIAL;
    }
    if (known == 0 && count == 4 && header->sizes[0] <= 4)
        roles[0] = NRRD_COMPONENTS;
    for (size_t i = 0; i < count; i++)
        if (roles[i] == NRRD_NO_ROLE) {
            roles[i] = spatial < 3 ? NRRD_SPATIAL : known ? NRRD_COMPONENTS : NRRD_FIRST_ONLY;
            spatial += roles[i] == NRRD_SPATIAL;
        }
}

/* Along which of the axes that are left over a sample is chosen, and which: the one of time, else
 * the slowest. */
static void choose_samples(const nrrd *header, axes *a) {
    a->time = -1;
    for (size_t i = 0; i < header->dimension; i++) {
        bool is_time = header->kinds_given.place.line && header->kinds[i] == NRRD_TIME;
        a->index[i] = 0;
        if (a->roles[i] == NRRD_FIRST_ONLY && (header->sizes[i] > 1 || is_time))
            if (a->time < 0 || header->kinds[a->time] != NRRD_TIME || is_time)
                a->time = (int)i;
    }
    if (a->time >= 0)
        a->index[a->time] = plr_volume_time_point(header->source, header->sizes[a->time]);
    for (size_t i = 0; i < header->dimension; i++)
        if (a->roles[i] == NRRD_FIRST_ONLY)
            warn_first_only(header, a, i);
}

static bool assign_axes(const nrrd *header, axes *a) {
    size_t spatial = 0;
    guess_roles(header, a->roles);
    a->components = a->spatial[0] = a->spatial[1] = a->spatial[2] = -1;
    for (size_t i = 0; i < header->dimension; i++) {
        bool is_space = a->roles[i] == NRRD_SPATIAL && spatial < 3;
        bool is_components =
            a->roles[i] == NRRD_COMPONENTS && a->components < 0 && header->sizes[i] <= 4;
        if (is_space)
            a->spatial[spatial++] = (int)i;
        else if (is_components)
            a->components = (int)i;
        else
            a->roles[i] = NRRD_FIRST_ONLY;
    }
    choose_samples(header, a);
    if (spatial == 0)
        return NRRD_FAIL(header, header->sizes_place, "no axis of the data is one of space");
    return true;
}

/* ---- data files ---- */

/* The next line of the list; `list` goes on behind it. Comments are no names. */
static bool next_in_list(nrrd_text *list, char *name, size_t size) {
    while (list->at < list->end) {
        const char *newline = memchr(list->at, '\n', (size_t)(list->end - list->at));
        nrrd_text line = {list->at, newline ? newline : list->end};
        list->at = newline ? newline + 1 : list->end;
        while (line.end > line.at && strchr(" \t\r", line.end[-1]))
            line.end--;
        size_t length = (size_t)(line.end - line.at);
        if (length == 0 || *line.at == '#')
            continue;
        if (length >= size)
            return false;
        memcpy(name, line.at, length);
        name[length] = '\0';
        return true;
    }
    return false;
}

static bool file_name(const nrrd *header, uint64_t index, nrrd_text *list, char *name,
                      size_t size) {
    size_t length = (size_t)(header->file_name.end - header->file_name.at);
    if (header->files == NRRD_LIST)
        return next_in_list(list, name, size);
    if (header->files == NRRD_PATTERN)
        return plr_pattern_expand(header->file_name.at, length,
                                  header->first + (int64_t)index * header->step, name, size);
    if (length >= size)
        return false;
    memcpy(name, header->file_name.at, length);
    name[length] = '\0';
    return true;
}

/* ---- decoding ---- */

/* Bytes that hold samples, and how messages speak of them. */
typedef struct chunk {
    const char *data;
    size_t length;
    const char *name;
    plr_place place; /* where faults are reported that have no line of their own */
} chunk;

static bool short_of(const nrrd *header, const chunk *from, uint64_t have, uint64_t need) {
    return NRRD_FAIL(header, from->place, "%s holds %llu bytes of voxels, but the header says %llu",
                     from->name, (unsigned long long)have, (unsigned long long)need);
}

/* Lines are skipped in the file as it is, before anything is unpacked. */
static bool skip_lines(const nrrd *header, chunk *from) {
    for (uint64_t i = 0; i < header->line_skip; i++) {
        const char *newline = memchr(from->data, '\n', from->length);
        if (!newline)
            return NRRD_FAIL(header, from->place, "%s has fewer than the %llu lines to skip",
                             from->name, (unsigned long long)header->line_skip);
        from->length -= (size_t)(newline + 1 - from->data);
        from->data = newline + 1;
    }
    return true;
}

/* Bytes are skipped after lines; in packed data, after unpacking. -1: all but what is needed. */
static bool skip_bytes(const nrrd *header, chunk *from, uint64_t size) {
    uint64_t skip = (uint64_t)header->byte_skip;
    if (header->byte_skip < 0)
        skip = from->length > size ? from->length - size : 0;
    if (skip > from->length)
        return NRRD_FAIL(header, from->place, "%s has fewer than the %llu bytes to skip",
                         from->name, (unsigned long long)skip);
    from->data += skip;
    from->length -= (size_t)skip;
    return true;
}

/* The line of the file that `at` is on, for data that are text. */
static plr_place place_in_text(const char *start, const char *at, const char *name) {
    plr_place place = {name, 1, 1};
    for (const char *c = start; c < at; c++) {
        place.column = *c == '\n' ? 1 : place.column + 1;
        place.line += *c == '\n';
    }
    return place;
}

static bool decode_text(const nrrd *header, const chunk *from, const char *file_start, void *out,
                        size_t count) {
    const char *fault;
    size_t offset = 0;
    size_t done =
        plr_read_numbers(from->data, from->length, header->type, out, count, &offset, &fault);
    if (fault) {
        plr_place place = place_in_text(file_start, from->data + offset, from->name);
        return NRRD_FAIL(header, place, "%s: voxels are %s", fault,
                         plr_voxel_type_text(header->type));
    }
    if (done < count)
        return NRRD_FAIL(header, from->place, "%s holds %zu numbers, but the header says %zu",
                         from->name, done, count);
    return true;
}

/* Decodes `count` samples. */
static bool decode(const nrrd *header, chunk from, void *out, size_t count) {
    const char *file_start = from.data, *fault = NULL;
    size_t size = count * plr_voxel_size(header->type), done = 0;
    if (header->files == NRRD_ATTACHED)
        file_start = header->source->data;
    if (header->byte_skip >= 0 && !skip_lines(header, &from))
        return false;
    if (header->encoding == NRRD_GZIP) {
        done = plr_inflate(header->source, from.data, from.length, (uint64_t)header->byte_skip, out,
                           size, &fault);
        if (fault)
            return NRRD_FAIL(header, from.place,
                             "the data of %s cannot be unpacked: %s after %zu of %zu bytes",
                             from.name, fault, done, size);
    } else {
        if (!skip_bytes(header, &from, size))
            return false;
        if (header->encoding == NRRD_ASCII)
            return decode_text(header, &from, file_start, out, count);
        if (header->encoding == NRRD_HEX)
            done = plr_read_hex(from.data, from.length, out, size);
        else {
            done = from.length < size ? from.length : size;
            memcpy(out, from.data, done);
        }
    }
    if (done < size)
        return short_of(header, &from, done, size);
    if (header->big_endian != plr_host_is_big_endian())
        plr_swap_bytes(out, count, plr_voxel_size(header->type));
    return true;
}

/* No encoding makes more than this of `length` bytes: memory is not taken for data that cannot be
 * there. (deflate reaches 1032:1) */
static bool is_plausible(const nrrd *header, const chunk *from, uint64_t count) {
    uint64_t size = count * plr_voxel_size(header->type), most = from->length;
    if (header->encoding == NRRD_GZIP)
        most = most > UINT64_MAX / 1040 ? UINT64_MAX : most * 1040;
    else if (header->encoding == NRRD_HEX)
        most /= 2;
    else if (header->encoding == NRRD_ASCII)
        most = (most + 1) / 2 * plr_voxel_size(header->type);
    return size <= most || short_of(header, from, most, size);
}

/* ---- all files ---- */

static bool take_memory(const nrrd *header, uint64_t count, void **out) {
    *out = malloc((size_t)count * plr_voxel_size(header->type));
    if (*out)
        return true;
    plr_diags_add(header->source->diags, PLR_CODE_NO_MEMORY, header->sizes_place,
                  "there is not enough memory for %llu voxels", (unsigned long long)count);
    return false;
}

/* Reads one data file: `each` samples at `index * each` of the whole, cut to `count`. */
static bool read_file(const nrrd *header, const char *name, uint64_t index, uint64_t each,
                      uint64_t count, void **out) {
    const plr_volume_source *source = header->source;
    plr_bytes bytes;
    if (!source->load)
        return NRRD_FAIL(header, header->files_place,
                         "data in a file of their own cannot be read "
                         "here");
    if (!source->load(source->user, source->name, name, false, header->files_place, &bytes,
                      source->diags))
        return false;
    uint64_t start = index * each, part = count - start < each ? count - start : each;
    chunk from = {bytes.data, bytes.length, bytes.name ? bytes.name : name, header->files_place};
    bool ok =
        is_plausible(header, &from, part) && (*out || take_memory(header, count, out)) &&
        decode(header, from, (char *)*out + start * plr_voxel_size(header->type), (size_t)part);
    source->release(source->user, &bytes);
    return ok;
}

/* Each file holds as many samples as another, the first of the slowest axes first. */
static bool check_files(const nrrd *header, uint64_t total) {
    uint64_t slices = 1;
    for (uint64_t i = header->file_dimension; i < header->dimension; i++)
        slices *= header->sizes[i];
    bool fits = total % header->file_count == 0;
    if (header->file_dimension && header->file_dimension < header->dimension)
        fits = slices == header->file_count;
    if (!fits)
        return NRRD_FAIL(header, header->files_place, "%llu data files cannot hold %llu voxels",
                         (unsigned long long)header->file_count, (unsigned long long)total);
    return true;
}

/* The first `count` of `total` samples. */
static bool read_samples(const nrrd *header, uint64_t total, uint64_t count, void **out) {
    if (header->files == NRRD_ATTACHED) {
        const plr_volume_source *source = header->source;
        chunk from = {header->data, (size_t)(source->data + source->length - header->data),
                      source->name, header->sizes_place};
        return is_plausible(header, &from, count) && take_memory(header, count, out) &&
               decode(header, from, *out, (size_t)count);
    }
    if (!check_files(header, total))
        return false;
    nrrd_text list = header->file_name;
    uint64_t each = total / header->file_count;
    for (uint64_t i = 0; i * each < count; i++) {
        char name[4096];
        if (!file_name(header, i, &list, name, sizeof name))
            return NRRD_FAIL(header, header->files_place,
                             "the name of data file %llu cannot be made",
                             (unsigned long long)i + 1);
        if (!read_file(header, name, i, each, count, out))
            return false;
    }
    return true;
}

/* ---- the volume ---- */

/* All samples of the file, and those up to the last that the volume needs. */
static bool count_samples(const nrrd *header, const axes *a, uint64_t *total, uint64_t *needed) {
    *total = *needed = 1;
    for (size_t i = 0; i < header->dimension; i++) {
        if (*total > PLR_VOLUME_MAX_BYTES * 16 / header->sizes[i])
            return NRRD_FAIL(header, header->sizes_place, "there are too many voxels");
        bool all = a->roles[i] != NRRD_FIRST_ONLY;
        *needed += *total * (all ? header->sizes[i] - 1 : a->index[i]);
        *total *= header->sizes[i];
    }
    if (*needed * plr_voxel_size(header->type) > PLR_VOLUME_MAX_BYTES)
        return NRRD_FAIL(header, header->sizes_place, "the voxels are more than %llu bytes",
                         (unsigned long long)PLR_VOLUME_MAX_BYTES);
    return true;
}

/* Samples before the first that the volume needs. */
static uint64_t first_sample(const nrrd *header, const axes *a) {
    uint64_t stride = 1, first = 0;
    for (size_t i = 0; i < header->dimension; i++) {
        first += stride * a->index[i];
        stride *= header->sizes[i];
    }
    return first;
}

/* Puts components innermost and leaves out all but one sample of what is no axis of space. */
static bool reorder(const nrrd *header, const axes *a, plr_volume *volume) {
    const int order[4] = {a->components, a->spatial[0], a->spatial[1], a->spatial[2]};
    uint64_t count[4], stride[4], packed = 1, first = first_sample(header, a);
    bool in_order = first == 0;
    for (int i = 0; i < 4; i++) {
        count[i] = order[i] < 0 ? 1 : header->sizes[order[i]];
        stride[i] = 1;
        for (int k = 0; k < order[i]; k++)
            stride[i] *= header->sizes[k];
        in_order = in_order && (count[i] == 1 || stride[i] == packed);
        packed *= count[i];
    }
    if (in_order)
        return true;
    void *ordered;
    if (!take_memory(header, packed, &ordered))
        return false;
    size_t size = plr_voxel_size(volume->type);
    plr_gather(ordered, (const char *)volume->voxels + first * size, size, count, stride);
    free(volume->voxels);
    volume->voxels = ordered;
    return true;
}

bool plr_nrrd_read_data(const nrrd *header, plr_volume *volume) {
    axes a;
    uint64_t total, needed, size[3], components;
    if (!assign_axes(header, &a) || !count_samples(header, &a, &total, &needed))
        return false;
    components = a.components < 0 ? 1 : header->sizes[a.components];
    for (int i = 0; i < 3; i++)
        size[i] = a.spatial[i] < 0 ? 1 : header->sizes[a.spatial[i]];
    if (!plr_volume_check_size(size, components, header->type, header->sizes_place,
                               header->source->diags))
        return false;
    volume->type = header->type;
    volume->components = (uint32_t)components;
    for (int i = 0; i < 3; i++)
        volume->size[i] = (uint32_t)size[i];
    if (read_samples(header, total, needed, &volume->voxels) && reorder(header, &a, volume))
        return true;
    free(volume->voxels);
    volume->voxels = NULL;
    return false;
}

/* ---- geometry ---- */

/* Axes of the file that are axes of space, in order. */
static bool spatial_axes(const nrrd *header, int spatial[3]) {
    nrrd_role roles[NRRD_MAX_AXES];
    size_t found = 0;
    guess_roles(header, roles);
    for (size_t i = 0; i < header->dimension && found < 3; i++)
        if (roles[i] == NRRD_SPATIAL)
            spatial[found++] = (int)i;
    return found == 3;
}

/* Brings the axes of the file space to the unit of the first and keeps that unit. */
static void apply_space_units(const nrrd *header, plr_volume *volume) {
    const double *metres = header->space_units;
    if (header->space_unit_count < 3 || metres[0] <= 0 || metres[1] <= 0 || metres[2] <= 0)
        return;
    volume->metres = metres[0];
    for (int axis = 0; axis < 3; axis++) {
        for (int i = 0; i < 3; i++)
            volume->directions[i][axis] *= metres[axis] / metres[0];
        volume->origin[axis] *= metres[axis] / metres[0];
    }
}

static void set_geometry(const nrrd *header, plr_volume *volume) {
    int spatial[3];
    if (!spatial_axes(header, spatial))
        return;
    bool directions = header->directions_given.place.line && header->direction_components == 3;
    bool spacings = header->spacings_given.place.line != 0;
    for (int i = 0; i < 3 && directions; i++) {
        directions = !header->no_direction[spatial[i]];
        memcpy(volume->directions[i], header->directions[spatial[i]], sizeof volume->directions[i]);
    }
    for (int i = 0; i < 3 && !directions; i++) {
        double spacing = header->spacings[spatial[i]];
        memset(volume->directions[i], 0, sizeof volume->directions[i]);
        volume->directions[i][i] = isfinite(spacing) && spacing != 0 ? spacing : 1;
    }
    volume->has_geometry = directions || spacings;
    volume->space = header->space;
    volume->unplaced = !directions || header->origin_count != 3;
    if (!volume->unplaced)
        memcpy(volume->origin, header->origin, sizeof volume->origin);
    if (directions)
        apply_space_units(header, volume);
    else if (spacings && header->units_given.place.line)
        volume->metres = header->units[spatial[0]];
}

static void set_range(nrrd *header, plr_volume *volume) {
    if (header->minimum >= header->maximum) {
        plr_diags_add_as(header->source->diags, PLR_WARNING, PLR_CODE_BAD_VOLUME,
                         header->sizes_place,
                         "min is not less than max; the range of the data is used");
        header->minimum = header->maximum = NAN;
    }
    plr_volume_set_range(volume, header->minimum, header->maximum);
}

bool plr_volume_parse_nrrd(const plr_volume_source *source, plr_volume *volume) {
    nrrd header;
    bool fine = plr_nrrd_read_header(&header, source) && plr_nrrd_read_data(&header, volume);
    if (fine) {
        volume->slope = 1;
        set_geometry(&header, volume);
        set_range(&header, volume);
        plr_nrrd_take_labels(&header, &volume->labels);
    }
    plr_nrrd_free(&header);
    return fine;
}
