#include "engine/defaults.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    NAME_SIZE = 1200 /* GLSL allows names of 1024 characters; and an index */
};

typedef struct value {
    GLint location;
    int type; /* index in `types` */
    union {
        GLfloat floats[16];
        GLint ints[4];
    } numbers;
} value;

struct plr_defaults {
    value *items;
    size_t count, capacity;
};

typedef enum setter {
    SET_FLOATS,
    SET_INTS,
    SET_MATRIX
} setter;

static const struct {
    GLenum type;
    setter setter;
    int components;
} types[] = {
    {GL_FLOAT, SET_FLOATS, 1},      {GL_FLOAT_VEC2, SET_FLOATS, 2}, {GL_FLOAT_VEC3, SET_FLOATS, 3},
    {GL_FLOAT_VEC4, SET_FLOATS, 4}, {GL_INT, SET_INTS, 1},          {GL_INT_VEC2, SET_INTS, 2},
    {GL_INT_VEC3, SET_INTS, 3},     {GL_INT_VEC4, SET_INTS, 4},     {GL_BOOL, SET_INTS, 1},
    {GL_BOOL_VEC2, SET_INTS, 2},    {GL_BOOL_VEC3, SET_INTS, 3},    {GL_BOOL_VEC4, SET_INTS, 4},
    {GL_FLOAT_MAT2, SET_MATRIX, 4}, {GL_FLOAT_MAT3, SET_MATRIX, 9}, {GL_FLOAT_MAT4, SET_MATRIX, 16},
};

static int find_type(GLenum type) {
    for (size_t i = 0; i < sizeof types / sizeof *types; i++)
        if (types[i].type == type)
            return (int)i;
    return -1;
}

static bool push(plr_defaults *defaults, value item) {
    if (defaults->count == defaults->capacity) {
        size_t capacity = defaults->capacity ? 2 * defaults->capacity : 32;
        value *items = realloc(defaults->items, capacity * sizeof *items);
        if (!items)
            return false;
        defaults->items = items;
        defaults->capacity = capacity;
    }
    defaults->items[defaults->count++] = item;
    return true;
}

/* One active uniform, element by element. */
static bool capture(const plr_gl *gl, GLuint program, GLuint index, plr_defaults *defaults) {
    char name[NAME_SIZE], element[NAME_SIZE + 16];
    GLint size = 0;
    GLenum gl_type = 0;
    gl->GetActiveUniform(program, index, sizeof name, NULL, &size, &gl_type, name);
    int type = find_type(gl_type);
    char *bracket = strrchr(name, '[');
    bool array = bracket && strcmp(bracket, "[0]") == 0;
    if (array)
        *bracket = '\0';
    for (GLint i = 0; type >= 0 && i < size; i++) {
        value item = {.type = type};
        if (array)
            snprintf(element, sizeof element, "%s[%d]", name, (int)i);
        else
            snprintf(element, sizeof element, "%s", name);
        item.location = gl->GetUniformLocation(program, element);
        if (item.location < 0)
            continue;
        if (types[type].setter == SET_INTS)
            gl->GetUniformiv(program, item.location, item.numbers.ints);
        else
            gl->GetUniformfv(program, item.location, item.numbers.floats);
        if (!push(defaults, item))
            return false;
    }
    return true;
}

plr_defaults *plr_defaults_capture(const plr_gl *gl, GLuint program) {
    plr_defaults *defaults = calloc(1, sizeof *defaults);
    GLint count = 0;
    gl->GetProgramiv(program, GL_ACTIVE_UNIFORMS, &count);
    for (GLint i = 0; defaults && i < count; i++)
        if (!capture(gl, program, (GLuint)i, defaults))
            plr_defaults_destroy(&defaults);
    return defaults;
}

static void set_floats(const plr_gl *gl, const value *item) {
    const GLfloat *v = item->numbers.floats;
    switch (types[item->type].type) {
    case GL_FLOAT:
        gl->Uniform1fv(item->location, 1, v);
        break;
    case GL_FLOAT_VEC2:
        gl->Uniform2fv(item->location, 1, v);
        break;
    case GL_FLOAT_VEC3:
        gl->Uniform3fv(item->location, 1, v);
        break;
    case GL_FLOAT_VEC4:
        gl->Uniform4fv(item->location, 1, v);
        break;
    case GL_FLOAT_MAT2:
        gl->UniformMatrix2fv(item->location, 1, GL_FALSE, v);
        break;
    case GL_FLOAT_MAT3:
        gl->UniformMatrix3fv(item->location, 1, GL_FALSE, v);
        break;
    default:
        gl->UniformMatrix4fv(item->location, 1, GL_FALSE, v);
        break;
    }
}

static void set_ints(const plr_gl *gl, const value *item) {
    const GLint *v = item->numbers.ints;
    switch (types[item->type].components) {
    case 1:
        gl->Uniform1iv(item->location, 1, v);
        break;
    case 2:
        gl->Uniform2iv(item->location, 1, v);
        break;
    case 3:
        gl->Uniform3iv(item->location, 1, v);
        break;
    default:
        gl->Uniform4iv(item->location, 1, v);
        break;
    }
}

void plr_defaults_apply(const plr_gl *gl, const plr_defaults *defaults) {
    for (size_t i = 0; defaults && i < defaults->count; i++) {
        const value *item = &defaults->items[i];
        (types[item->type].setter == SET_INTS ? set_ints : set_floats)(gl, item);
    }
}

void plr_defaults_destroy(plr_defaults **defaults) {
    if (!*defaults)
        return;
    free((*defaults)->items);
    free(*defaults);
    *defaults = NULL;
}
