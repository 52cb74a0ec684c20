#include "engine/light_values.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct light_source {
    const plr_node *node; /* NULL: a headlight, a DirectionalLight with the defaults */
    plr_matrix to_eye;
} light_source;

struct plr_light_value {
    const char *name;
    void (*get)(const light_source *, float *);
};

static void numbers(const light_source *light, const char *field, float *out, size_t count) {
    if (light->node && plr_node_field(light->node, field))
        plr_node_numbers(light->node, field, out, count);
}

static float number(const light_source *light, const char *field, float otherwise) {
    numbers(light, field, &otherwise, 1);
    return otherwise;
}

static bool has_place(const light_source *light) {
    return light->node && plr_node_field(light->node, "location");
}

static void v_direction(const light_source *light, float *out) {
    float direction[3] = {0, 0, -1};
    numbers(light, "direction", direction, 3);
    const double *m = light->to_eye.m;
    double length = 0, v[3];
    for (int i = 0; i < 3; i++) {
        v[i] = m[i] * (double)direction[0] + m[4 + i] * (double)direction[1] +
               m[8 + i] * (double)direction[2];
        length += v[i] * v[i];
    }
    for (int i = 0; i < 3; i++)
        out[i] = length > 0 ? (float)(v[i] / sqrt(length)) : 0;
    out[3] = 0;
}

/* Of a light without a place: the direction to it. */
static void v_position(const light_source *light, float *out) {
    float location[3] = {0};
    if (!has_place(light)) {
        v_direction(light, out);
        for (int i = 0; i < 3; i++)
            out[i] = -out[i];
        return;
    }
    numbers(light, "location", location, 3);
    double point[3] = {location[0], location[1], location[2]};
    plr_matrix_point(&light->to_eye, point, point);
    for (int i = 0; i < 3; i++)
        out[i] = (float)point[i];
    out[3] = 1;
}

static void scaled_color(const light_source *light, float factor, float *out) {
    float color[3] = {1, 1, 1};
    numbers(light, "color", color, 3);
    for (int i = 0; i < 3; i++)
        out[i] = factor * color[i];
    out[3] = 1;
}
static void v_color(const light_source *light, float *out) {
    scaled_color(light, number(light, "intensity", 1), out);
}
static void v_ambient(const light_source *light, float *out) {
    scaled_color(light, number(light, "ambientIntensity", 0), out);
}
static void v_attenuation(const light_source *light, float *out) {
    out[0] = 1;
    numbers(light, "attenuation", out, 3);
}
/* In eye space, of a light that is scaled alike along all axes. */
static void v_radius(const light_source *light, float *out) {
    double scale = cbrt(fabs(plr_matrix_determinant3(&light->to_eye)));
    out[0] = (float)scale * number(light, "radius", 100);
}
static void v_cut_off(const light_source *light, float *out) {
    out[0] = number(light, "cutOffAngle", 1.570796f);
}
static void v_cosine(const light_source *light, float *out) {
    out[0] = cosf(number(light, "cutOffAngle", 1.570796f));
}
static void v_beam_width(const light_source *light, float *out) {
    out[0] = number(light, "beamWidth", 1.570796f);
}

static const plr_light_value values[] = {
    {"Position", v_position},    {"SpotDirection", v_direction}, {"Color", v_color},
    {"AmbientColor", v_ambient}, {"Attenuation", v_attenuation}, {"Radius", v_radius},
    {"SpotCosCutoff", v_cosine}, {"SpotCutoff", v_cut_off},      {"BeamWidth", v_beam_width}};

static const plr_binding *find_light(const plr_recipe *recipe, unsigned number) {
    for (size_t i = 0; i < recipe->bindings.count; i++)
        if (recipe->bindings.items[i].is_light && recipe->bindings.items[i].gated
                ? recipe->bindings.items[i].number == (int)number
                : recipe->bindings.items[i].is_light && number-- == 0)
            return &recipe->bindings.items[i];
    return NULL;
}

const plr_light_value *plr_light_value_find(const plr_recipe *recipe, const char *name,
                                            const plr_binding **light) {
    unsigned index;
    int used = 0;
    if (sscanf(name, "castle_LightSource%5u%n", &index, &used) != 1)
        return NULL;
    for (size_t i = 0; i < sizeof values / sizeof *values; i++)
        if (strcmp(name + used, values[i].name) == 0)
            return (*light = find_light(recipe, index)) ? &values[i] : NULL;
    return NULL;
}

static light_source source_of(const plr_binding *light, const plr_matrix *world_to_eye) {
    light_source source = {light->node, light->to_world};
    if (!light->in_eye_space)
        source.to_eye = plr_matrix_multiply(world_to_eye, &light->to_world);
    return source;
}

void plr_light_value_get(const plr_light_value *value, const plr_binding *light,
                         const plr_matrix *world_to_eye, float out[4]) {
    light_source source = source_of(light, world_to_eye);
    memset(out, 0, 4 * sizeof *out);
    value->get(&source, out);
}

void plr_light_direction(const plr_binding *light, const plr_matrix *world_to_eye, float *out) {
    light_source source = source_of(light, world_to_eye);
    v_direction(&source, out);
}

void plr_light_location(const plr_binding *light, const plr_matrix *world_to_eye, float *out) {
    light_source source = source_of(light, world_to_eye);
    v_position(&source, out);
}
