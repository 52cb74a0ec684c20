/* Volumes that are too large, brought down; the reduced copies that a scene of 2005 gives. */
#include "engine/volume_node.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- How small ---- */

static size_t uploaded_bytes(const plr_image *image, const uint32_t size[3]) {
    size_t sample = plr_image_sample_size(image->type == PLR_UNORM8 ? PLR_UNORM16 : image->type);
    return (size_t)size[0] * size[1] * size[2] * image->components * sample;
}

void plr_image_reduction(const plr_image *image, uint32_t max_side, size_t max_bytes,
                         uint32_t factors[3]) {
    const uint32_t full[3] = {image->width, image->height, image->depth};
    uint32_t size[3];
    for (int i = 0; i < 3; i++) {
        factors[i] = 1;
        while (max_side && (full[i] + factors[i] - 1) / factors[i] > max_side)
            factors[i] *= 2;
        size[i] = (full[i] + factors[i] - 1) / factors[i];
    }
    bool more = true;
    while (more && max_bytes && uploaded_bytes(image, size) > max_bytes) {
        more = false;
        for (int i = 0; i < 3; i++)
            if (size[i] > 1) {
                factors[i] *= 2;
                size[i] = (full[i] + factors[i] - 1) / factors[i];
                more = true;
            }
    }
}

/* ---- Averages ---- */

/* What voxel i of `to` covers of `from`: from the first to the last, of these two a part. The box
 * is the same, so the cells need not be whole voxels. */
typedef struct cover {
    uint32_t first, last;
    float first_part, last_part;
} cover;

static cover covered(uint32_t from, uint32_t to, uint32_t i) {
    double low = (double)i * from / to, high = (double)(i + 1) * from / to;
    cover c = {(uint32_t)low, (uint32_t)ceil(high) - 1, 1, 1};
    if (c.last >= from)
        c.last = from - 1;
    c.first_part = (float)(fmin(c.first + 1.0, high) - low);
    c.last_part = c.last > c.first ? (float)(high - c.last) : c.first_part;
    return c;
}

static float part_of(const cover *c, uint32_t i) {
    return i == c->first ? c->first_part : i == c->last ? c->last_part : 1;
}

typedef struct reduction {
    const plr_image *from;
    plr_image *to;
    cover *columns; /* by x of `to` */
    float *line;    /* the sum of rows of `from` */
} reduction;

static void add_line(const plr_image *image, uint32_t y, uint32_t z, float weight, float *line) {
    size_t count = (size_t)image->width * image->components;
    size_t first = ((size_t)z * image->height + y) * count;
    if (image->type == PLR_FLOAT32) {
        const float *samples = (const float *)image->samples + first;
        for (size_t i = 0; i < count; i++)
            line[i] += weight * samples[i];
    } else if (image->type == PLR_UNORM16) {
        const uint16_t *samples = (const uint16_t *)image->samples + first;
        for (size_t i = 0; i < count; i++)
            line[i] += weight * samples[i];
    } else {
        const uint8_t *samples = (const uint8_t *)image->samples + first;
        for (size_t i = 0; i < count; i++)
            line[i] += weight * samples[i];
    }
}

static void put_means(const reduction *r, float area, uint32_t y, uint32_t z) {
    plr_image *to = r->to;
    size_t at = ((size_t)z * to->height + y) * to->width * to->components;
    for (uint32_t x = 0; x < to->width; x++) {
        const cover *c = &r->columns[x];
        for (uint32_t k = 0; k < to->components; k++, at++) {
            float sum = 0, length = 0;
            for (uint32_t i = c->first; i <= c->last; i++) {
                float part = part_of(c, i);
                sum += part * r->line[(size_t)i * to->components + k];
                length += part;
            }
            float mean = sum / (area * length);
            if (to->type == PLR_FLOAT32)
                ((float *)to->samples)[at] = mean;
            else if (to->type == PLR_UNORM16)
                ((uint16_t *)to->samples)[at] = (uint16_t)(mean + 0.5f);
            else
                ((uint8_t *)to->samples)[at] = (uint8_t)(mean + 0.5f);
        }
    }
}

static void average(const reduction *r) {
    const plr_image *from = r->from, *to = r->to;
    for (uint32_t z = 0; z < to->depth; z++) {
        cover slices = covered(from->depth, to->depth, z);
        for (uint32_t y = 0; y < to->height; y++) {
            cover rows = covered(from->height, to->height, y);
            float area = 0;
            memset(r->line, 0, (size_t)from->width * from->components * sizeof *r->line);
            for (uint32_t k = slices.first; k <= slices.last; k++)
                for (uint32_t j = rows.first; j <= rows.last; j++) {
                    float weight = part_of(&slices, k) * part_of(&rows, j);
                    add_line(from, j, k, weight, r->line);
                    area += weight;
                }
            put_means(r, area, y, z);
        }
    }
}

/* ---- Majorities ---- */

static uint32_t label_at(const plr_image *image, size_t index) {
    return image->type == PLR_UINT8    ? ((const uint8_t *)image->samples)[index]
           : image->type == PLR_UINT16 ? ((const uint16_t *)image->samples)[index]
                                       : ((const uint32_t *)image->samples)[index];
}

static void put_label(plr_image *image, size_t index, uint32_t label) {
    if (image->type == PLR_UINT8)
        ((uint8_t *)image->samples)[index] = (uint8_t)label;
    else if (image->type == PLR_UINT16)
        ((uint16_t *)image->samples)[index] = (uint16_t)label;
    else
        ((uint32_t *)image->samples)[index] = label;
}

/* The voxels whose centres lie in cell i: one or two. */
static void centres(uint32_t from, uint32_t to, uint32_t i, uint32_t range[2]) {
    range[0] = (uint32_t)(((uint64_t)2 * i * from + to) / (2 * (uint64_t)to));
    range[1] = (uint32_t)(((uint64_t)2 * (i + 1) * from + to) / (2 * (uint64_t)to));
    if (range[1] > from)
        range[1] = from;
}

/* The label of most of the voxels of a cell (8 at most); of as many, the first. */
static uint32_t majority(const plr_image *image, uint32_t box[3][2]) {
    uint32_t labels[8], winner = 0;
    size_t count = 0, most = 0;
    for (uint32_t z = box[2][0]; z < box[2][1]; z++)
        for (uint32_t y = box[1][0]; y < box[1][1]; y++)
            for (uint32_t x = box[0][0]; x < box[0][1] && count < 8; x++)
                labels[count++] =
                    label_at(image, ((size_t)z * image->height + y) * image->width + x);
    for (size_t i = 0; i < count; i++) {
        size_t same = 0;
        for (size_t j = i; j < count; j++)
            same += labels[j] == labels[i];
        if (same > most) {
            most = same;
            winner = labels[i];
        }
    }
    return winner;
}

/* Once, along the axes that are said, in place: what is written was read before. */
static void halve_labels(plr_image *image, const bool axes[3]) {
    const uint32_t from[3] = {image->width, image->height, image->depth};
    uint32_t to[3], box[3][2];
    for (int i = 0; i < 3; i++)
        to[i] = axes[i] ? (from[i] + 1) / 2 : from[i];
    size_t at = 0;
    for (uint32_t z = 0; z < to[2]; z++)
        for (uint32_t y = 0; y < to[1]; y++)
            for (uint32_t x = 0; x < to[0]; x++) {
                centres(from[0], to[0], x, box[0]);
                centres(from[1], to[1], y, box[1]);
                centres(from[2], to[2], z, box[2]);
                put_label(image, at++, majority(image, box));
            }
    image->width = to[0];
    image->height = to[1];
    image->depth = to[2];
}

static bool reduce_labels(plr_image *image, const uint32_t factors[3]) {
    for (uint32_t done = 1;; done *= 2) {
        const bool axes[3] = {done < factors[0], done < factors[1], done < factors[2]};
        if (!axes[0] && !axes[1] && !axes[2])
            break;
        halve_labels(image, axes);
    }
    void *less = realloc(image->samples,
                         plr_image_level_samples(image, 0) * plr_image_sample_size(image->type));
    image->samples = less ? less : image->samples;
    return true;
}

/* ---- All ---- */

static bool reduce_values(plr_image *image, const uint32_t factors[3]) {
    plr_image small = *image;
    small.width = (image->width + factors[0] - 1) / factors[0];
    small.height = (image->height + factors[1] - 1) / factors[1];
    small.depth = (image->depth + factors[2] - 1) / factors[2];
    small.mipmaps = 0;
    small.samples = malloc(plr_image_level_samples(&small, 0) * plr_image_sample_size(small.type));
    reduction r = {.from = image, .to = &small};
    r.columns = malloc(small.width * sizeof *r.columns);
    r.line = malloc((size_t)image->width * image->components * sizeof *r.line);
    bool fine = small.samples && r.columns && r.line;
    for (uint32_t x = 0; fine && x < small.width; x++)
        r.columns[x] = covered(image->width, small.width, x);
    if (fine)
        average(&r);
    free(r.columns);
    free(r.line);
    plr_image_free(fine ? image : &small);
    if (fine)
        *image = small;
    return fine;
}

bool plr_image_reduce(plr_image *image, const uint32_t factors[3]) {
    bool labels =
        image->type == PLR_UINT8 || image->type == PLR_UINT16 || image->type == PLR_UINT32;
    if (factors[0] <= 1 && factors[1] <= 1 && factors[2] <= 1)
        return true;
    return labels ? reduce_labels(image, factors) : reduce_values(image, factors);
}

/* ---- Copies that the scene gives ---- */

/* Half of half of the longest side, and so on, is 1: no file need be read for more. */
#define MOST_LEVELS 14

/* ISO/IEC JTC 1's proposal of 2005 for volumes, VolumeData: "each level should be half the
 * dimensions of the previous level"; both ways of rounding are in use. */
static bool is_half(uint32_t of, uint32_t size) {
    return size == (of + 1) / 2 || size == (of > 1 ? of / 2 : 1);
}

void plr_volume_check_levels(plr_scene *scene, const plr_node *node, const plr_volume *finest,
                             plr_diags *diags) {
    const plr_field *levels = plr_node_field(node, "voxelLevels");
    uint32_t before[3];
    memcpy(before, finest->size, sizeof before);
    for (size_t i = 0; levels && i < levels->count && i < MOST_LEVELS; i++) {
        const plr_node *level = levels->value.nodes[i];
        plr_volume volume;
        if (!level || !plr_volume_from_node(scene, level, &volume, diags))
            continue;
        bool fits = volume.components == finest->components;
        for (int axis = 0; axis < 3; axis++)
            fits = fits && is_half(before[axis], volume.size[axis]);
        if (!fits)
            plr_diags_add_as(diags, PLR_WARNING, PLR_CODE_BAD_VOLUME, plr_node_place(level),
                             "level %zu of the voxels is %u x %u x %u with %u components, not half "
                             "of %u x %u x %u with %u",
                             i + 1, volume.size[0], volume.size[1], volume.size[2],
                             volume.components, before[0], before[1], before[2],
                             finest->components);
        memcpy(before, volume.size, sizeof before);
        plr_volume_free(&volume);
    }
}

size_t plr_volume_fitting_level(size_t count, double voxels) {
    size_t level = 0;
    while (level + 1 < count && voxels >= 2) {
        voxels /= 2;
        level++;
    }
    return level;
}

/* ---- Values ---- */

void plr_volume_node_range(const plr_node *node, double range[2]) {
    float given[2] = {0, 0};
    if (plr_node_field(node, "valueRange"))
        plr_node_numbers(node, "valueRange", given, 2);
    range[0] = (double)given[0];
    range[1] = (double)given[1];
    if (range[0] != range[1] || !plr_node_field(node, "windowWidth"))
        return;
    /* DICOM PS3.3 C.11.2.1.3.2, LINEAR_EXACT: from center - width / 2 to center + width / 2 */
    double width = plr_node_number(node, "windowWidth");
    double center = plr_node_number(node, "windowCenter");
    range[0] = width > 0 ? center - width / 2 : 0;
    range[1] = width > 0 ? center + width / 2 : 0;
}
