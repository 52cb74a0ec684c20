#include "engine/volume_geometry.h"

#include <float.h>
#include <math.h>

/* Columns of directions that are closer to a plane than this span no volume. */
#define LEAST_SPAN 1e-6

/* Lengths from one over this to this: their squares, and quotients of two, are floats. */
#define MOST_LENGTH 1e18

bool plr_volume_has_extent(const plr_matrix *to_world, const double dimensions[3]) {
    plr_matrix inverse;
    if (!plr_matrix_invert(to_world, &inverse))
        return false;
    bool fine = true;
    for (int axis = 0; axis < 3; axis++) {
        const double *there = &to_world->m[4 * axis], *back = &inverse.m[4 * axis];
        fine = fine && hypot(hypot(there[0], there[1]), there[2]) <= MOST_LENGTH;
        fine = fine && hypot(hypot(back[0], back[1]), back[2]) <= MOST_LENGTH;
        fine = fine && dimensions[axis] >= 1 / MOST_LENGTH && dimensions[axis] <= MOST_LENGTH;
    }
    return fine;
}

static bool left_handed(plr_volume_space space) {
    return space == PLR_SPACE_LAS || space == PLR_SPACE_LEFT_HANDED;
}

plr_matrix plr_volume_affine(const plr_volume *volume) {
    plr_matrix affine = plr_matrix_identity();
    for (int row = 0; row < 3; row++) {
        for (int axis = 0; axis < 3; axis++)
            affine.m[axis * 4 + row] = volume->directions[axis][row];
        affine.m[12 + row] = volume->origin[row];
    }
    return affine;
}

static bool usable_length(double length) {
    return isfinite(length) && length >= (double)FLT_MIN && length <= (double)FLT_MAX;
}

bool plr_volume_file_geometry(const plr_volume *volume, double unit_metres,
                              plr_matrix *box_to_scene, double dimensions[3]) {
    if (!volume->has_geometry)
        return false;
    double metres = volume->metres > 0 ? volume->metres : PLR_VOLUME_DEFAULT_METRES;
    double scale = metres / unit_metres, sides[3], centre[3] = {0, 0, 0};
    plr_matrix matrix = plr_matrix_identity();
    for (int axis = 0; axis < 3; axis++) {
        const double *step = volume->directions[axis];
        double length = hypot(hypot(step[0], step[1]), step[2]);
        sides[axis] = length * scale * volume->size[axis];
        if (!usable_length(length) || !usable_length(sides[axis]))
            return false;
        for (int row = 0; row < 3; row++) {
            matrix.m[axis * 4 + row] = step[row] / length;
            centre[row] += step[row] * (volume->size[axis] - 1.0) / 2;
        }
    }
    for (int row = 0; row < 3; row++) {
        matrix.m[12 + row] = volume->unplaced ? 0 : (volume->origin[row] + centre[row]) * scale;
        if (fabs(matrix.m[12 + row]) > (double)FLT_MAX || isnan(matrix.m[12 + row]))
            return false;
    }
    if (!(fabs(plr_matrix_determinant3(&matrix)) > LEAST_SPAN))
        return false;
    for (int column = 0; column < 4 && left_handed(volume->space); column++)
        matrix.m[column * 4] = -matrix.m[column * 4];
    *box_to_scene = matrix;
    for (int axis = 0; axis < 3; axis++)
        dimensions[axis] = sides[axis];
    return true;
}

const char *plr_space_direction(plr_volume_space space, int axis, double step, char *letter) {
    static const struct {
        const char *word;
        char letter;
    } ways[3][2] = {{{"right", 'R'}, {"left", 'L'}},
                    {{"front", 'A'}, {"back", 'P'}},
                    {{"up", 'S'}, {"down", 'I'}}};
    /* whether the axes run to the right, to the front, up; or the other way */
    static const int turned[][3] = {
        [PLR_SPACE_RAS] = {0, 0, 0}, [PLR_SPACE_LAS] = {1, 0, 0}, [PLR_SPACE_LPS] = {1, 1, 0}};
    if (space != PLR_SPACE_RAS && space != PLR_SPACE_LAS && space != PLR_SPACE_LPS)
        return NULL;
    int way = turned[space][axis] ^ (step < 0);
    if (letter)
        *letter = ways[axis][way].letter;
    return ways[axis][way].word;
}
