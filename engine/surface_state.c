#include "engine/surface_state.h"

#include <math.h>
#include <string.h>
#include <strings.h>

#include "engine/surface.h"

typedef struct word {
    const char *text;
    GLenum value;
} word;

static const word factor_words[] = {{"ZERO", GL_ZERO},
                                    {"ONE", GL_ONE},
                                    {"SRC_COLOR", GL_SRC_COLOR},
                                    {"ONE_MINUS_SRC_COLOR", GL_ONE_MINUS_SRC_COLOR},
                                    {"DST_COLOR", GL_DST_COLOR},
                                    {"ONE_MINUS_DST_COLOR", GL_ONE_MINUS_DST_COLOR},
                                    {"SRC_ALPHA", GL_SRC_ALPHA},
                                    {"ONE_MINUS_SRC_ALPHA", GL_ONE_MINUS_SRC_ALPHA},
                                    {"DST_ALPHA", GL_DST_ALPHA},
                                    {"ONE_MINUS_DST_ALPHA", GL_ONE_MINUS_DST_ALPHA},
                                    {"SRC_ALPHA_SATURATE", GL_SRC_ALPHA_SATURATE},
                                    {"CONSTANT_COLOR", GL_CONSTANT_COLOR},
                                    {"ONE_MINUS_CONSTANT_COLOR", GL_ONE_MINUS_CONSTANT_COLOR},
                                    {"CONSTANT_ALPHA", GL_CONSTANT_ALPHA},
                                    {"ONE_MINUS_CONSTANT_ALPHA", GL_ONE_MINUS_CONSTANT_ALPHA},
                                    {NULL, 0}};

static const word equation_words[] = {{"FUNC_ADD", GL_FUNC_ADD},
                                      {"FUNC_SUBTRACT", GL_FUNC_SUBTRACT},
                                      {"FUNC_REVERSE_SUBTRACT", GL_FUNC_REVERSE_SUBTRACT},
                                      {"MIN", GL_MIN},
                                      {"MAX", GL_MAX},
                                      {NULL, 0}};

/* What each field sets: two sets of extensions, of which the one that the file uses counts. */
static const struct {
    const char *field;
    const word *words;
    int factor, equation; /* index, or -1 */
} blend_fields[] = {
    {"sourceColorFactor", factor_words, 0, -1}, {"destinationColorFactor", factor_words, 1, -1},
    {"sourceAlphaFactor", factor_words, 2, -1}, {"destinationAlphaFactor", factor_words, 3, -1},
    {"srcFactor", factor_words, 0, -1},         {"destFactor", factor_words, 1, -1},
    {"colorEquation", equation_words, -1, 0},   {"alphaEquation", equation_words, -1, 1}};

static bool find_word(const word *words, const char *text, GLenum *value) {
    for (; words->text; words++)
        if (strcasecmp(words->text, text) == 0) {
            *value = words->value;
            return true;
        }
    return false;
}

static void read_blend_mode(const plr_node *node, plr_surface_state *state, plr_diags *diags) {
    for (size_t i = 0; i < sizeof blend_fields / sizeof *blend_fields; i++) {
        const plr_field *field = plr_node_field(node, blend_fields[i].field);
        const char *text = plr_node_string(node, blend_fields[i].field);
        int factor = blend_fields[i].factor;
        if (!field || !field->given || (factor >= 0 && strcasecmp(text, "none") == 0))
            continue; /* as usual */
        GLenum *value =
            factor >= 0 ? &state->factors[factor] : &state->equations[blend_fields[i].equation];
        if (!find_word(blend_fields[i].words, text, value))
            plr_diags_add(diags, PLR_CODE_BAD_VALUE, field->place, "'%s' is no %s", text,
                          factor >= 0 ? "factor of blending" : "equation of blending");
    }
}

void plr_surface_state_read(const plr_shape *shape, plr_surface_state *state) {
    /* pictures are premultiplied: their alpha is coverage */
    *state = (plr_surface_state){
        .factors = {GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA},
        .equations = {GL_FUNC_ADD, GL_FUNC_ADD}};
    if (!shape->appearance)
        return;
    state->blend_mode = plr_node_child(shape->appearance, "blendMode");
    if (state->blend_mode)
        read_blend_mode(state->blend_mode, state, shape->diags);
    const plr_node *lines = plr_node_child(shape->appearance, "lineProperties");
    if (lines && shape->model->mesh.kind == PLR_MESH_LINES && plr_node_bool(lines, "applied"))
        state->line_properties = lines;
    state->sizes_points = shape->model->mesh.kind == PLR_MESH_POINTS &&
                          plr_node_child(shape->appearance, "pointProperties");
}

/* blendColor, or color with colorTransparency: whichever the file gives. */
static void set_blend_color(const plr_gl *gl, const plr_node *node) {
    float color[4] = {0};
    if (plr_node_field(node, "blendColor")->given) {
        plr_node_numbers(node, "blendColor", color, 4);
    } else {
        plr_node_numbers(node, "color", color, 3);
        color[3] = 1 - (float)plr_node_number(node, "colorTransparency");
    }
    gl->BlendColor(color[0], color[1], color[2], color[3]);
}

/* As wide as GL draws lines; a factor that is not positive asks for the least (12.4.4). */
static void set_line_width(const plr_gl *gl, const plr_node *node) {
    GLfloat range[2] = {1, 1}, width = (GLfloat)plr_node_number(node, "linewidthScaleFactor");
    gl->GetFloatv(GL_ALIASED_LINE_WIDTH_RANGE, range);
    gl->LineWidth(fminf(fmaxf(width, 1), fmaxf(range[1], 1)));
}

void plr_surface_state_enter(const plr_gl *gl, const plr_surface_state *state, bool blends) {
    (blends ? gl->Enable : gl->Disable)(GL_BLEND);
    if (blends) {
        gl->BlendFuncSeparate(state->factors[0], state->factors[1], state->factors[2],
                              state->factors[3]);
        gl->BlendEquationSeparate(state->equations[0], state->equations[1]);
    }
    if (blends && state->blend_mode)
        set_blend_color(gl, state->blend_mode);
    if (state->line_properties)
        set_line_width(gl, state->line_properties);
    if (state->sizes_points)
        gl->Enable(GL_PROGRAM_POINT_SIZE);
}

void plr_surface_state_leave(const plr_gl *gl, const plr_surface_state *state) {
    if (state->blend_mode)
        gl->BlendEquationSeparate(GL_FUNC_ADD, GL_FUNC_ADD);
    if (state->line_properties)
        gl->LineWidth(1);
    if (state->sizes_points)
        gl->Disable(GL_PROGRAM_POINT_SIZE);
}
