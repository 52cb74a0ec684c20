#include "x3d/transforms.h"

#include <string.h>

#include "base/matrix.h"

static void read(const plr_node *node, const char *field, double *numbers, size_t count) {
    float values[4];
    size_t there = plr_node_numbers(node, field, values, count);
    for (size_t i = 0; i < there; i++)
        numbers[i] = values[i];
}

/* ISO/IEC 19775-1 V4 10.4.4: P' = T C R SR S -SR -C P. */
static void from_parts(const plr_node *node, double matrix[16]) {
    double t[3] = {0}, c[3] = {0}, r[4] = {0, 0, 1, 0}, s[3] = {1, 1, 1}, o[4] = {0, 0, 1, 0};
    read(node, "translation", t, 3);
    read(node, "center", c, 3);
    read(node, "rotation", r, 4);
    read(node, "scale", s, 3);
    read(node, "scaleOrientation", o, 4);
    const plr_matrix parts[] = {
        plr_matrix_translation(t[0] + c[0], t[1] + c[1], t[2] + c[2]),
        plr_matrix_rotation(r[0], r[1], r[2], r[3]),
        plr_matrix_rotation(o[0], o[1], o[2], o[3]),
        plr_matrix_scale(s[0], s[1], s[2]),
        plr_matrix_rotation(o[0], o[1], o[2], -o[3]),
        plr_matrix_translation(-c[0], -c[1], -c[2]),
    };
    plr_matrix product = parts[0];
    for (size_t i = 1; i < sizeof parts / sizeof *parts; i++)
        product = plr_matrix_multiply(&product, &parts[i]);
    memcpy(matrix, product.m, sizeof product.m);
}

/* Fields hold rows. */
static void from_matrix(const plr_node *node, double matrix[16]) {
    float rows[16];
    if (plr_node_numbers(node, "matrix", rows, 16) < 16)
        return;
    for (int i = 0; i < 16; i++)
        matrix[i % 4 * 4 + i / 4] = rows[i];
}

static const struct {
    const char *type;
    void (*find)(const plr_node *, double *);
} transforms[] = {{"Transform", from_parts},     {"MatrixTransform", from_matrix},
                  {"CADPart", from_parts},       {"HAnimHumanoid", from_parts},
                  {"HAnimJoint", from_parts},    {"HAnimSite", from_parts},
                  {"EspduTransform", from_parts}};

bool x3d_transforms(const plr_node *node) {
    for (size_t i = 0; i < sizeof transforms / sizeof *transforms; i++)
        if (plr_node_is(node, transforms[i].type))
            return true;
    return false;
}

bool plr_node_transform(const plr_node *node, double matrix[16]) {
    plr_matrix identity = plr_matrix_identity();
    memcpy(matrix, identity.m, sizeof identity.m);
    for (size_t i = 0; i < sizeof transforms / sizeof *transforms; i++)
        if (plr_node_is(node, transforms[i].type)) {
            transforms[i].find(node, matrix);
            return true;
        }
    return false;
}
