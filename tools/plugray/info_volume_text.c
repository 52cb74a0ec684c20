/* What a volume holds, as text. */
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "engine/volume_geometry.h"
#include "engine/volume_internal.h"
#include "tools/plugray/info.h"
#include "tools/plugray/info_words.h"
#include "tools/plugray/listing.h"

#define INDENT "        "

enum {
    BAR = 40,         /* characters */
    MOST_USES = 8,    /* nodes that share a texture */
    MOST_LABELS = 256 /* lines; JSON has all */
};

/* The name of a line, and where its text begins. */
static void print_name(const char *name) {
    printf(INDENT "%-13s", name);
}

static void print_head(const volume_report *r) {
    const plr_volume *v = &r->volume;
    printf("    %s at ", plr_node_type(r->texture));
    print_place(plr_node_place(r->texture));
    printf(": %ux%ux%u, %u of %s, %zu bytes, values %g to %g\n", v->size[0], v->size[1], v->size[2],
           v->components, voxel_type_word(v->type), plr_volume_count(v) * plr_voxel_size(v->type),
           v->minimum, v->maximum);
    for (size_t i = 0; i < r->use_count && i < MOST_USES; i++) {
        printf(INDENT "%s of ", r->uses[i].field);
        print_node(r->uses[i].user);
        putchar('\n');
    }
    if (r->use_count > MOST_USES)
        printf(INDENT "and of %zu others\n", r->use_count - MOST_USES);
}

/* Where the range that 0 to 1 stands for comes from. */
static const char *range_origin(const volume_report *r) {
    if (r->volume.range_declared)
        return "declared by the file";
    double least = r->statistics[0].minimum, greatest = r->statistics[0].maximum;
    for (uint32_t c = 1; c < r->volume.components; c++) {
        least = fmin(least, r->statistics[c].minimum);
        greatest = fmax(greatest, r->statistics[c].maximum);
    }
    bool found = least == r->volume.minimum && greatest == r->volume.maximum;
    return found ? "that of the data" : "that of the type";
}

static void print_range(const volume_report *r) {
    const plr_volume *v = &r->volume;
    print_name("range");
    printf("%g to %g, %s", v->minimum, v->maximum, range_origin(r));
    if (r->shown_by_node)
        printf("; the volume node shows %g to %g", r->shown[0], r->shown[1]);
    putchar('\n');
    for (uint32_t c = 0; c < v->components; c++) {
        const plr_volume_statistics *s = &r->statistics[c];
        print_name(c ? "" : "found");
        printf("%g to %g", s->minimum, s->maximum);
        if (v->components > 1)
            printf(" in component %u", c + 1);
        printf(", %" PRIu64 " NaN", s->nan);
        if (s->infinite)
            printf(", %" PRIu64 " infinite", s->infinite);
        putchar('\n');
    }
}

/* ---- Geometry ---- */

static void print_spacing(const plr_volume *v) {
    double spacing[3];
    char buffer[32];
    voxel_sides(v, spacing);
    const char *unit = length_unit(v->metres, buffer);
    print_name("spacing");
    printf("%g x %g x %g %s, the whole %g x %g x %g %s\n", spacing[0], spacing[1], spacing[2], unit,
           spacing[0] * v->size[0], spacing[1] * v->size[1], spacing[2] * v->size[2], unit);
}

static void print_affine(const plr_volume *v) {
    plr_matrix m = plr_volume_affine(v);
    for (int row = 0; row < 3; row++) {
        print_name(row ? "" : "affine");
        for (int column = 0; column < 4; column++) {
            if (column == 3 && v->unplaced)
                printf(" %12s", "-");
            else
                printf(" %12.6g", m.m[column * 4 + row] + 0.0);
        }
        putchar('\n');
    }
}

static void print_space(const plr_volume *v) {
    print_name("space");
    if (v->space == PLR_SPACE_UNKNOWN || v->space == PLR_SPACE_LEFT_HANDED) {
        printf("the file does not say where x, y and z point%s\n",
               v->space == PLR_SPACE_LEFT_HANDED ? ", only that they are left-handed" : "");
        return;
    }
    char letters[4] = "";
    const char *words[3];
    for (int axis = 0; axis < 3; axis++)
        words[axis] = plr_space_direction(v->space, axis, 1, &letters[axis]);
    printf("%s: x to the %s, y to the %s, z %s\n", letters, words[0], words[1], words[2]);
}

static void print_axes(const plr_volume *v) {
    static const char names[] = "ijk";
    print_name("axes");
    for (int i = 0; i < 3; i++) {
        char buffer[16];
        printf("%s%c %s", i ? ", " : "", names[i], voxel_axis_words(v, i, buffer));
    }
    double tilt = voxel_tilt(v);
    if (tilt >= 0.05)
        printf("; oblique by up to %.1f degrees", tilt);
    printf(is_right_handed(v) ? "; right-handed\n"
                              : "; left-handed: a mirror image unless fileGeometry is TRUE\n");
}

static void print_geometry(const plr_volume *v) {
    if (!v->has_geometry) {
        print_name("spacing");
        puts("the data do not say");
        return;
    }
    print_spacing(v);
    print_affine(v);
    print_space(v);
    print_axes(v);
}

/* ---- Values ---- */

static void print_percentiles(const volume_report *r) {
    static const double percents[PLR_PERCENTILE_COUNT] = {PLR_PERCENTILES};
    char text[32];
    print_name("percentiles");
    for (int i = 0; i < PLR_PERCENTILE_COUNT; i++) {
        snprintf(text, sizeof text, "%g%%", percents[i]);
        printf("%s%9s", i ? " " : "", text);
    }
    putchar('\n');
    for (uint32_t c = 0; c < r->volume.components; c++) {
        snprintf(text, sizeof text, "component %u", c + 1);
        print_name(r->volume.components > 1 ? text : "");
        for (int i = 0; i < PLR_PERCENTILE_COUNT; i++)
            printf("%s%9.5g", i ? " " : "", r->statistics[c].percentiles[i]);
        putchar('\n');
    }
}

static void print_histogram(const plr_volume_statistics *s) {
    static const char bar[BAR + 1] = "########################################";
    uint64_t most = 0;
    for (uint32_t i = 0; i < s->bins; i++)
        most = s->counts[i] > most ? s->counts[i] : most;
    print_name("histogram");
    puts("from, bar (logarithm of the number), voxels");
    for (uint32_t i = 0; i < s->bins && most; i++) {
        double length = log1p((double)s->counts[i]) / log1p((double)most) * BAR;
        printf(INDENT "%12.5g |%-*.*s| %" PRIu64 "\n", s->first + i * s->width, BAR,
               (int)ceil(length), bar, s->counts[i]);
    }
}

static void print_labels(const volume_report *r) {
    print_name("segments");
    printf("%zu%s: number, voxels, name, colour\n", r->label_count,
           r->more_labels ? " or more" : "");
    for (size_t i = 0; i < r->label_count && i < MOST_LABELS; i++) {
        const plr_label *label = plr_labels_find(&r->volume.labels, r->labels[i].value);
        printf(INDENT "%10" PRIu32 " %12" PRIu64, r->labels[i].value, r->labels[i].voxels);
        if (label) {
            fputs("  ", stdout);
            print_plain(label->name);
            if (label->has_color)
                printf("  %.3g %.3g %.3g %.3g", (double)label->color[0], (double)label->color[1],
                       (double)label->color[2], (double)label->color[3]);
        }
        putchar('\n');
    }
    if (r->label_count > MOST_LABELS)
        printf(INDENT "and %zu more\n", r->label_count - MOST_LABELS);
}

static void print_start(const transfer *t, bool xml) {
    print_name("start with");
    puts("a transfer function made from the values (physical value: colour, opacity):");
    for (size_t i = 0; i < t->count; i++) {
        const transfer_knot *k = &t->knots[i];
        printf(INDENT "%12.5g: %.2f %.2f %.2f, %.4f\n", k->value, k->color[0], k->color[1],
               k->color[2], k->opacity);
    }
    print_transfer(stdout, t, xml, INDENT);
}

void print_volume(const volume_report *r, bool xml) {
    print_head(r);
    print_range(r);
    print_geometry(&r->volume);
    if (!r->labels || r->volume.components > 1) {
        print_percentiles(r);
        print_histogram(&r->statistics[0]);
    }
    if (r->labels)
        print_labels(r);
    if (r->transfer.count)
        print_start(&r->transfer, xml);
}
