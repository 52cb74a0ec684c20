/* What a volume holds, as JSON. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

#include "engine/volume_geometry.h"
#include "engine/volume_internal.h"
#include "tools/plugray/files.h"
#include "tools/plugray/info.h"
#include "tools/plugray/info_words.h"
#include "tools/plugray/json.h"

static void write_uses(const volume_report *r) {
    fputs(", \"uses\": [", stdout);
    for (size_t i = 0; i < r->use_count; i++) {
        printf("%s{\"field\": \"%s\", ", i ? ", " : "", r->uses[i].field);
        write_node(r->uses[i].user);
        putchar('}');
    }
    putchar(']');
}

static void write_geometry(const plr_volume *v) {
    plr_matrix m = plr_volume_affine(v);
    double sides[3];
    voxel_sides(v, sides);
    fputs("{\"spacing\": ", stdout);
    write_numbers(sides, 3);
    fputs(", \"metres\": ", stdout);
    if (v->metres > 0)
        json_number(stdout, v->metres);
    else
        fputs("null", stdout);
    printf(", \"placed\": %s, \"affine\": [", v->unplaced ? "false" : "true");
    for (int row = 0; row < 3; row++) {
        const double numbers[] = {m.m[row], m.m[4 + row], m.m[8 + row], m.m[12 + row]};
        fputs(row ? ", " : "", stdout);
        write_numbers(numbers, 4);
    }
    fputs("], \"axes\": ", stdout);
    char letters[4] = {0};
    for (int i = 0; i < 3; i++)
        letters[i] = voxel_axis_letter(v, i);
    json_string(stdout, letters[0] ? letters : NULL);
    fputs(", \"oblique_degrees\": ", stdout);
    json_number(stdout, voxel_tilt(v));
    printf(", \"right_handed\": %s}", is_right_handed(v) ? "true" : "false");
}

static void write_statistics(const plr_volume_statistics *s) {
    static const char *const percents[PLR_PERCENTILE_COUNT] = {"0.1", "1",  "5",  "25",  "50",
                                                               "75",  "95", "99", "99.9"};
    printf("{\"finite\": %" PRIu64 ", \"nan\": %" PRIu64 ", \"infinite\": %" PRIu64, s->finite,
           s->nan, s->infinite);
    fputs(", \"minimum\": ", stdout);
    json_number(stdout, s->minimum);
    fputs(", \"maximum\": ", stdout);
    json_number(stdout, s->maximum);
    fputs(", \"percentiles\": {", stdout);
    for (int i = 0; i < PLR_PERCENTILE_COUNT; i++) {
        printf("%s\"%s\": ", i ? ", " : "", percents[i]);
        json_number(stdout, s->percentiles[i]);
    }
    fputs("}, \"histogram\": {\"first\": ", stdout);
    json_number(stdout, s->first);
    fputs(", \"width\": ", stdout);
    json_number(stdout, s->width);
    fputs(", \"counts\": [", stdout);
    for (uint32_t i = 0; i < s->bins; i++)
        printf("%s%" PRIu64, i ? ", " : "", s->counts[i]);
    fputs("]}}", stdout);
}

static void write_labels(const volume_report *r) {
    fputs(",\n     \"segments\": ", stdout);
    if (!r->labels) {
        fputs("null", stdout);
        return;
    }
    putchar('[');
    for (size_t i = 0; i < r->label_count; i++) {
        const plr_label *label = plr_labels_find(&r->volume.labels, r->labels[i].value);
        printf("%s\n      {\"number\": %" PRIu32 ", \"voxels\": %" PRIu64 ", \"name\": ",
               i ? "," : "", r->labels[i].value, r->labels[i].voxels);
        json_string(stdout, label ? label->name : NULL);
        fputs(", \"color\": ", stdout);
        if (label && label->has_color) {
            double color[4];
            for (int c = 0; c < 4; c++)
                color[c] = (double)label->color[c];
            write_numbers(color, 4);
        } else {
            fputs("null", stdout);
        }
        putchar('}');
    }
    putchar(']');
}

static void write_start(const transfer *t, bool xml) {
    fputs(",\n     \"start_with\": ", stdout);
    if (!t->count) {
        fputs("null", stdout);
        return;
    }
    fputs("{\"knots\": [", stdout);
    for (size_t i = 0; i < t->count; i++) {
        const transfer_knot *k = &t->knots[i];
        printf("%s{\"value\": ", i ? ", " : "");
        json_number(stdout, k->value);
        fputs(", \"color\": ", stdout);
        write_numbers(k->color, 3);
        fputs(", \"opacity\": ", stdout);
        json_number(stdout, k->opacity);
        putchar('}');
    }
    fputs("], \"x3d\": ", stdout);
    char *text = NULL;
    size_t length = 0;
    FILE *stream = open_memstream(&text, &length);
    if (stream) {
        print_transfer(stream, t, xml, "");
        fclose(stream);
    }
    json_string(stdout, text);
    free(text);
    putchar('}');
}

void write_volume(const volume_report *r, bool xml) {
    const plr_volume *v = &r->volume;
    fputs("    {", stdout);
    write_node(r->texture);
    write_uses(r);
    printf(",\n     \"size\": [%u, %u, %u], \"components\": %u, \"type\": \"%s\", \"bytes\": %zu",
           v->size[0], v->size[1], v->size[2], v->components, voxel_type_word(v->type),
           plr_volume_count(v) * plr_voxel_size(v->type));
    fputs(",\n     \"range\": ", stdout);
    write_numbers((const double[]){v->minimum, v->maximum}, 2);
    printf(", \"range_declared\": %s, \"shown\": ", v->range_declared ? "true" : "false");
    write_numbers(r->shown, 2);
    fputs(",\n     \"geometry\": ", stdout);
    if (v->has_geometry)
        write_geometry(v);
    else
        fputs("null", stdout);
    fputs(",\n     \"values\": [", stdout);
    for (uint32_t c = 0; c < v->components; c++) {
        fputs(c ? ",\n      " : "\n      ", stdout);
        write_statistics(&r->statistics[c]);
    }
    putchar(']');
    write_labels(r);
    write_start(&r->transfer, xml);
    putchar('}');
}
