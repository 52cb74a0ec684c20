#include "tools/plugray/info_words.h"

#include <math.h>
#include <stdio.h>

#include "engine/volume_geometry.h"
#include "tools/plugray/json.h"
#include "tools/plugray/listing.h"

const char *voxel_type_word(plr_voxel_type type) {
    static const char *const words[] = {
        [PLR_VOXEL_U8] = "uint8",   [PLR_VOXEL_S8] = "int8",    [PLR_VOXEL_U16] = "uint16",
        [PLR_VOXEL_S16] = "int16",  [PLR_VOXEL_U32] = "uint32", [PLR_VOXEL_S32] = "int32",
        [PLR_VOXEL_U64] = "uint64", [PLR_VOXEL_S64] = "int64",  [PLR_VOXEL_F32] = "float",
        [PLR_VOXEL_F64] = "double",
    };
    return words[type];
}

/* ---- Geometry ---- */

const char *length_unit(double metres, char buffer[32]) {
    static const struct {
        double metres;
        const char *word;
    } units[] = {{1, "m"},     {1e-2, "cm"}, {1e-3, "mm"},
                 {1e-6, "um"}, {1e-9, "nm"}, {1e-10, "angstrom"}};
    if (!(metres > 0))
        return "mm (the file names no unit)";
    for (size_t i = 0; i < sizeof units / sizeof *units; i++)
        if (fabs(metres / units[i].metres - 1) < 1e-9)
            return units[i].word;
    snprintf(buffer, 32, "x %g m", metres);
    return buffer;
}

void voxel_sides(const plr_volume *volume, double sides[3]) {
    for (int i = 0; i < 3; i++) {
        const double *step = volume->directions[i];
        sides[i] = hypot(hypot(step[0], step[1]), step[2]);
    }
}

static int greatest_part(const double step[3]) {
    int axis = 0;
    for (int i = 1; i < 3; i++)
        if (fabs(step[i]) > fabs(step[axis]))
            axis = i;
    return axis;
}

char voxel_axis_letter(const plr_volume *volume, int axis) {
    const double *step = volume->directions[axis];
    int along = greatest_part(step);
    char letter = 0;
    plr_space_direction(volume->space, along, step[along], &letter);
    return letter;
}

const char *voxel_axis_words(const plr_volume *volume, int axis, char buffer[16]) {
    const double *step = volume->directions[axis];
    int along = greatest_part(step);
    const char *word = plr_space_direction(volume->space, along, step[along], NULL);
    if (word)
        snprintf(buffer, 16, "%s%s", along < 2 ? "to the " : "", word);
    else
        snprintf(buffer, 16, "along %c%c", step[along] < 0 ? '-' : '+', "xyz"[along]);
    return buffer;
}

double voxel_tilt(const plr_volume *volume) {
    double sides[3], least = 1;
    voxel_sides(volume, sides);
    for (int i = 0; i < 3; i++) {
        const double *step = volume->directions[i];
        if (sides[i] > 0)
            least = fmin(least, fabs(step[greatest_part(step)]) / sides[i]);
    }
    return acos(least) * 180 / acos(-1);
}

bool is_right_handed(const plr_volume *volume) {
    plr_matrix affine = plr_volume_affine(volume);
    bool left = volume->space == PLR_SPACE_LAS || volume->space == PLR_SPACE_LEFT_HANDED;
    return (plr_matrix_determinant3(&affine) >= 0) != left;
}

/* ---- Nodes and places ---- */

void print_node(const plr_node *node) {
    const char *def = plr_node_def(node);
    fputs(plr_node_type(node), stdout);
    if (def) {
        putchar(' ');
        print_plain(def);
    }
    fputs(" at ", stdout);
    print_place(plr_node_place(node));
}

void write_node(const plr_node *node) {
    fputs("\"node\": ", stdout);
    json_string(stdout, node ? plr_node_type(node) : NULL);
    fputs(", \"def\": ", stdout);
    json_string(stdout, node ? plr_node_def(node) : NULL);
    fputs(", \"place\": ", stdout);
    write_place(node ? plr_node_place(node) : (plr_place){NULL, 0, 0});
}

void write_numbers(const double *numbers, size_t count) {
    putchar('[');
    for (size_t i = 0; i < count; i++) {
        if (i)
            fputs(", ", stdout);
        json_number(stdout, numbers[i]);
    }
    putchar(']');
}
