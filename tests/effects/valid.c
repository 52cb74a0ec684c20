/* Every base and built-in effect links with what it is made for, compiles, and leaves nothing in
 * the program that is not asked for. */
#include <plugray/engine.h>

#include "engine/glsl.h"
#include "tests/tap.h"

#define MOST 64

/* An effect of a program: a built-in one by path, or an author's text. */
typedef struct part {
    const char *path; /* below effects/, without endings; NULL ends the list */
    const char *text; /* an author's fragment unit; `path` is then its name */
    const char *vertex_text;
    const plr_define *defines;
    size_t define_count;
    const char *geometry_text;
    size_t attached; /* to the part before of this number, from 1 */
    bool is_private; /* its plugs are for what is attached to it */
} part;

typedef struct recipe {
    const char *name, *base;
    part parts[10];
    const plr_define *defines;
    size_t define_count;
    const char *present; /* words that must be in the program, separated by blanks */
    const char *absent;
} recipe;

typedef struct linked {
    plr_diags *diags;
    plr_source *sources[256];
    size_t source_count;
    const plr_source *lists[MOST][5], *library[MOST], *base[4];
    plr_effect effects[MOST];
    plr_program *program;
} linked;

static bool covered[256];

static plr_source *read_text(linked *l, plr_stage stage, const char *name, const char *text) {
    plr_origin origin = {.file = name};
    plr_source *source = plr_source_read(stage, text, strlen(text), &origin, NULL, l->diags);
    l->sources[l->source_count++] = source;
    return source;
}

/* The units of a path, with the stage that their ending says. */
static size_t read_files(linked *l, const char *path, const plr_source **list) {
    static const struct {
        const char *ending;
        plr_stage stage;
    } endings[] = {{".glsl", PLR_FRAGMENT},
                   {".vert.glsl", PLR_VERTEX},
                   {".geom.glsl", PLR_GEOMETRY},
                   {".frag.glsl", PLR_FRAGMENT}};
    const char *name, *text;
    size_t count = 0, length = strlen(path);
    for (size_t i = 0; (name = plr_effects_file(i, &text, NULL)); i++)
        for (size_t e = 0; e < sizeof endings / sizeof *endings; e++)
            if (strncmp(name, path, length) == 0 && strcmp(name + length, endings[e].ending) == 0) {
                list[count++] = read_text(l, endings[e].stage, name, text);
                covered[i] = true;
            }
    return count;
}

/* Styles have a unit in common. */
static bool is_style(const char *path) {
    size_t length = strlen(path), tail = strlen("VolumeStyle");
    return strncmp(path, "volume/", 7) == 0 && strcmp(path + length - tail, "VolumeStyle") == 0;
}

/* Those of paths separated by blanks. */
static size_t read_paths(linked *l, const char *paths, const plr_source **list) {
    size_t count = 0;
    for (const char *at = paths; *at;) {
        char path[64];
        size_t length = strcspn(at, " ");
        snprintf(path, sizeof path, "%.*s", (int)length, at);
        count += read_files(l, path, list + count);
        at += length + (at[length] == ' ');
    }
    return count;
}

static size_t read_library(linked *l) {
    const char *name, *text;
    size_t count = 0;
    for (size_t i = 0; (name = plr_effects_file(i, &text, NULL)); i++)
        if (strncmp(name, "library/", 8) == 0) {
            l->library[count++] = read_text(l, PLR_VERTEX, name, text);
            l->library[count++] = read_text(l, PLR_FRAGMENT, name, text);
            covered[i] = true;
        }
    return count;
}

static void link_recipe(linked *l, const recipe *r) {
    memset(l, 0, sizeof *l);
    l->diags = plr_diags_create(NULL);
    size_t count = 0;
    for (; r->parts[count].path; count++) {
        const part *p = &r->parts[count];
        const plr_source **list = l->lists[count];
        size_t units = 0;
        if (p->text)
            list[units++] = read_text(l, PLR_FRAGMENT, p->path, p->text);
        if (p->vertex_text)
            list[units++] = read_text(l, PLR_VERTEX, p->path, p->vertex_text);
        if (p->geometry_text)
            list[units++] = read_text(l, PLR_GEOMETRY, p->path, p->geometry_text);
        if (!units)
            units = read_paths(l, p->path, list);
        if (is_style(p->path))
            units += read_files(l, "volume/style", list + units);
        l->effects[count] =
            (plr_effect){.name = p->path,
                         .sources = list,
                         .source_count = units,
                         .defines = p->defines,
                         .define_count = p->define_count,
                         .attached = p->attached,
                         .only_attached = p->attached != 0,
                         .private_plugs = p->is_private,
                         .gate = strstr(p->path, "general/Gate") ? "gate" : NULL,
                         .builtin = !p->text && !p->vertex_text && !p->geometry_text};
    }
    plr_link_desc desc = {.base = l->base,
                          .base_count = read_files(l, r->base, l->base),
                          .library = l->library,
                          .library_count = read_library(l),
                          .effects = l->effects,
                          .effect_count = count,
                          .defines = r->defines,
                          .define_count = r->define_count};
    l->program = plr_link(&desc, l->diags);
}

static void finish(linked *l) {
    plr_program_destroy(&l->program);
    for (size_t i = 0; i < l->source_count; i++)
        plr_source_destroy(&l->sources[i]);
    plr_diags_destroy(&l->diags);
}

static void print_messages(const plr_glsl_messages *messages) {
    for (size_t i = 0; i < messages->count; i++)
        printf("# %u: %s\n", messages->items[i].line, messages->items[i].text);
}

static bool compiles(const plr_program *program) {
    const char *texts[PLR_STAGE_COUNT];
    plr_glsl_messages messages[PLR_STAGE_COUNT] = {{0}}, joint = {0};
    for (int s = 0; s < PLR_STAGE_COUNT; s++)
        texts[s] = plr_program_text(program, (plr_stage)s, NULL);
    bool fine = plr_glsl_check(texts, messages, &joint);
    for (int s = 0; s < PLR_STAGE_COUNT; s++) {
        print_messages(&messages[s]);
        plr_glsl_messages_free(&messages[s]);
    }
    print_messages(&joint);
    plr_glsl_messages_free(&joint);
    return fine;
}

static bool in_program(const plr_program *program, const char *word) {
    for (int s = 0; s < PLR_STAGE_COUNT; s++) {
        const char *text = plr_program_text(program, (plr_stage)s, NULL);
        if (text && strstr(text, word))
            return true;
    }
    return false;
}

/* Whether each word is in the program as `wanted` says. */
static void check_words(const linked *l, const recipe *r, const char *words, bool wanted) {
    char word[64];
    int used;
    for (const char *at = words ? words : ""; sscanf(at, " %63s%n", word, &used) == 1; at += used)
        TAP_RESULT(in_program(l->program, word) == wanted, "%s: %s is %sin the program", r->name,
                   word, wanted ? "" : "not ");
}

static void check_recipe(const recipe *r) {
    linked l;
    link_recipe(&l, r);
    size_t problems = plr_diags_count(l.diags);
    for (size_t i = 0; i < problems; i++) {
        const plr_diag *diag = plr_diags_get(l.diags, i);
        printf("# %s:%u:%u: %s\n", diag->place.file ? diag->place.file : "", diag->place.line,
               diag->place.column, diag->message);
    }
    TAP_RESULT(l.program && !problems, "%s: links without a word", r->name);
    if (l.program) {
        bool fine = compiles(l.program);
        TAP_RESULT(fine, "%s: compiles", r->name);
        if (!fine)
            printf("# %s\n", plr_program_text(l.program, PLR_FRAGMENT, NULL) ? "see the messages"
                                                                             : "no text");
        check_words(&l, r, r->present, true);
        check_words(&l, r, r->absent, false);
        if (getenv("SHOW_PROGRAMS"))
            fprintf(stderr, "==== %s\n%s----\n%s\n", r->name,
                    plr_program_text(l.program, PLR_VERTEX, NULL),
                    plr_program_text(l.program, PLR_FRAGMENT, NULL));
    }
    finish(&l);
}

/* An author who uses every plug of surfaces, with the parameters of docs/plugs.md. */
static const char every_vertex_plug[] =
    "void PLUG_vertex_object_space_change(inout vec4 vertex_object, inout vec3 normal_object) {"
    " vertex_object.xyz += normal_object; }\n"
    "void PLUG_vertex_object_space(const in vec4 vertex_object, inout vec3 normal_object) {"
    " normal_object = -normal_object; }\n"
    "varying vec3 seen;\n"
    "void PLUG_vertex_eye_space(const in vec4 vertex_eye, const in vec3 normal_eye) {"
    " seen = vertex_eye.xyz; }\n"
    "void PLUG_vertex_eye_space_extended(const in vec4 vertex_eye, const in vec3 normal_eye,"
    " const in vec3 normal_object) { seen += normal_object; }\n";
static const char every_fragment_plug[] =
    "varying vec3 seen;\n"
    "void PLUG_fragment_eye_space(const vec4 vertex_eye, inout vec3 normal_eye) { normal_eye += "
    "seen; }\n"
    "void PLUG_main_texture_apply(inout vec4 fragment_color, const in vec3 normal_eye) {"
    " fragment_color.rgb *= normal_eye; }\n"
    "void PLUG_texture_apply(inout vec4 fragment_color, const in vec3 normal_eye) {"
    " fragment_color.g = 1.0; }\n"
    "void PLUG_material_emissive(inout vec3 emissive) { emissive.r += 0.1; }\n"
    "void PLUG_material_light_ambient(inout vec3 light_ambient) { light_ambient.r += 0.1; }\n"
    "void PLUG_material_occlusion(inout vec4 color) { color.r *= 0.5; }\n"
    "void PLUG_lighting_apply(inout vec4 color, const vec4 vertex_eye, const vec3 normal_eye) {"
    " color.b = vertex_eye.z; }\n"
    "void PLUG_fragment_modify(inout vec4 fragment_color) { fragment_color.a = 0.5; }\n"
    "void PLUG_fog_apply(inout vec4 fragment_color, const vec3 normal_eye) {"
    " fragment_color.r = normal_eye.x; }\n"
    "void PLUG_fragment_end(inout vec4 fragment_color) { if (fragment_color.a < 0.5) discard; }\n";
static const char every_lit_plug[] =
    "void PLUG_material_ambient(inout vec3 ambient) { ambient.r += 0.1; }\n"
    "void PLUG_material_specular(inout vec3 specular) { specular.r += 0.1; }\n"
    "void PLUG_material_shininess(inout float shininess) { shininess += 1.0; }\n"
    "void PLUG_light_scale(inout float scale, const in vec3 normal_eye, const in vec3 light_dir) {"
    " scale *= dot(normal_eye, light_dir); }\n"
    "void PLUG_texture_color(inout vec4 texture_color, const in sampler2D texture,"
    " const in vec4 tex_coord) { texture_color = texture2D(texture, tex_coord.ts); }\n";
static const char short_texture_plug[] =
    "void PLUG_texture_color(inout vec4 texture_color, const in vec4 tex_coord) {"
    " texture_color.rg = tex_coord.st; }\n";

#define DEFINES(list) .defines = list, .define_count = sizeof list / sizeof *list
static const plr_define plain[] = {{"HAS_COLORS", "0"},
                                   {"COLORS_MODULATE", "0"},
                                   {"HAS_NORMALS", "1"},
                                   {"TWO_SIDED", "0"},
                                   {"OPAQUE", "1"}};
static const plr_define colored[] = {{"HAS_COLORS", "1"},
                                     {"COLORS_MODULATE", "0"},
                                     {"HAS_NORMALS", "1"},
                                     {"TWO_SIDED", "1"},
                                     {"OPAQUE", "0"}};
/* The units of a volume's effect, by what it does along the ray. */
#define STEPPED "volume/Volume volume/grid volume/steps"
#define LEAPING "volume/Volume volume/grid volume/leaps volume/steps"
#define SURFACES "volume/Volume volume/grid volume/levels volume/crossings volume/surfaces"
#define PROJECTED "volume/Volume volume/grid volume/projection"
/* And along the way of light. */
#define SHADOW_STEPS "volume/ShadowRay volume/grid volume/shadow_steps"
#define SHADOW_SURFACES                                                                            \
    "volume/ShadowRay volume/grid volume/levels volume/crossings volume/shadow_surfaces"
static const plr_define in_shadow[] = {{"IN_SHADOW", "1"}};
static const plr_define plane_of_volume[] = {{"VOLUME", "1"}};
static const plr_define all_shadows[] = {{"SKIPS_CLEAR", "0"}};
static const plr_define seen_shadows[] = {{"SKIPS_CLEAR", "1"}};
static const plr_define on_no_volume[] = {{"VOLUME", "0"}};
static const plr_define fog_of_volume[] = {
    {"HAS_FOG_COORD", "0"}, {"volumetric", "0"}, {"COMPLETE", "0"}, {"VOLUME", "1"}};
#define WHOLE_RAYS                                                                                 \
    {"HAS_PARTS", "0"}, {"WRITES_DEPTH", "0"}, {                                                   \
        "PICKS", "0"                                                                               \
    }
#define NO_SEGMENTS                                                                                \
    {"SEGMENTS", "0"}, {"CELLS", "0"}, {"LEAPS", "0"}, {"HAS_LEAPS", "0"}, {                       \
        "HAS_WALL", "0"                                                                            \
    }
#define EVERY_STEP                                                                                 \
    NO_SEGMENTS, {                                                                                 \
        "SKIPS", "0"                                                                               \
    }
static const plr_define one_volume[] = {
    {"MIXES", "0"},     {"HAS_EVENTS", "0"}, {"HAS_STEPS", "1"}, {"HAS_OPAQUE", "0"},
    {"EARLY_END", "1"}, {"HAS_CUT", "0"},    WHOLE_RAYS,         EVERY_STEP};
static const plr_define one_skipping[] = {
    {"MIXES", "0"},      {"HAS_EVENTS", "0"}, {"HAS_STEPS", "1"},
    {"HAS_OPAQUE", "0"}, {"EARLY_END", "1"},  {"HAS_CUT", "0"},
    WHOLE_RAYS,          NO_SEGMENTS,         {"SKIPS", "1"}};
static const plr_define one_leaping[] = {
    {"MIXES", "0"},     {"HAS_EVENTS", "0"}, {"HAS_STEPS", "1"}, {"HAS_OPAQUE", "0"},
    {"EARLY_END", "1"}, {"HAS_CUT", "0"},    WHOLE_RAYS,         {"SEGMENTS", "0"},
    {"CELLS", "0"},     {"LEAPS", "1"},      {"HAS_WALL", "0"},  {"SKIPS", "1"}};
static const plr_define many_leaping[] = {
    {"MIXES", "1"},       {"HAS_EVENTS", "0"}, {"HAS_STEPS", "1"}, {"HAS_OPAQUE", "0"},
    {"EARLY_END", "1"},   {"HAS_CUT", "0"},    WHOLE_RAYS,         {"SEGMENTS", "0"},
    {"CELLS", "0"},       {"LEAPS", "1"},      {"HAS_WALL", "0"},  {"SKIPS", "1"},
    {"MANY_VOLUMES", "1"}};
static const plr_define two_skipping[] = {
    {"MIXES", "1"},     {"HAS_EVENTS", "0"},  {"HAS_STEPS", "1"}, {"HAS_OPAQUE", "0"},
    {"EARLY_END", "1"}, {"HAS_CUT", "0"},     WHOLE_RAYS,         NO_SEGMENTS,
    {"SKIPS", "1"},     {"MANY_VOLUMES", "0"}};
#define CUT(cells, leaps, mixes, wall)                                                             \
    {                                                                                              \
        {"MIXES", mixes}, {"HAS_EVENTS", "0"}, {"HAS_STEPS", "1"}, {"HAS_OPAQUE", "1"},            \
            {"EARLY_END", "1"}, {"HAS_CUT", "0"}, WHOLE_RAYS, {"SKIPS", "0"}, {"SEGMENTS", "1"},   \
            {"CELLS", cells}, {"LEAPS", leaps}, {                                                  \
            "HAS_WALL", wall                                                                       \
        }                                                                                          \
    }
static const plr_define in_segments[] = CUT("0", "1", "0", "0");
static const plr_define two_in_segments[] = CUT("0", "0", "1", "1");
static const plr_define in_cells[] = CUT("1", "1", "0", "0");
static const plr_define two_in_cells[] = CUT("1", "1", "1", "1");
#define TABLED "volume/Volume volume/grid volume/leaps volume/table "
static const plr_define tabled[] = {
    {"voxels_COMPONENTS", "1"}, {"HAS_LABELS", "0"}, {"BRICKED", "0"},   {"PROJECTS", "0"},
    {"HAS_WALL", "0"},          {"JOINS", "1"},      {"HAS_QUADS", "0"}, {"CLIPS", "0"}};
static const plr_define holding[] = {{"voxels_COMPONENTS", "1"},
                                     {"HAS_LABELS", "0"},
                                     {"BRICKED", "0"},
                                     {"PROJECTS", "0"},
                                     {"HAS_WALL", "0"},
                                     {"HAS_GRADIENTS", "1"},
                                     {"JOINS", "1"},
                                     {"HAS_QUADS", "1"},
                                     {"TURNS", "1"}};
static const plr_define walled[] = {{"voxels_COMPONENTS", "1"},
                                    {"HAS_LABELS", "0"},
                                    {"BRICKED", "0"},
                                    {"PROJECTS", "0"},
                                    {"GENTLE", "0"},
                                    {"HAS_WALL", "1"},
                                    {"JOINS", "0"},
                                    {"HAS_QUADS", "0"},
                                    {"CLIPS", "1"}};
static const plr_define in_segmented[] = {{"voxels_COMPONENTS", "1"},
                                          {"HAS_LABELS", "1"},
                                          {"BRICKED", "0"},
                                          {"PROJECTS", "0"},
                                          {"GENTLE", "0"},
                                          {"HAS_WALL", "1"},
                                          {"JOINS", "0"},
                                          {"HAS_QUADS", "0"},
                                          {"CLIPS", "1"}};
static const plr_define two_volumes[] = {
    {"MIXES", "1"},     {"HAS_EVENTS", "0"}, {"HAS_STEPS", "1"}, {"HAS_OPAQUE", "1"},
    {"EARLY_END", "0"}, {"HAS_CUT", "1"},    WHOLE_RAYS,         EVERY_STEP};
static const plr_define surfaces[] = {{"MIXES", "1"},      {"HAS_EVENTS", "1"}, {"HAS_STEPS", "0"},
                                      {"HAS_OPAQUE", "0"}, {"EARLY_END", "1"},  {"HAS_CUT", "0"},
                                      WHOLE_RAYS,          EVERY_STEP};
static const plr_define one_in_parts[] = {
    {"MIXES", "0"},     {"HAS_EVENTS", "0"}, {"HAS_STEPS", "1"}, {"HAS_OPAQUE", "1"},
    {"EARLY_END", "1"}, {"HAS_CUT", "0"},    {"HAS_PARTS", "1"}, {"WRITES_DEPTH", "1"},
    {"PICKS", "0"},     {"writeDepth", "1"}, EVERY_STEP};
static const plr_define all_in_parts[] = {
    {"MIXES", "1"},     {"HAS_EVENTS", "1"}, {"HAS_STEPS", "1"}, {"HAS_OPAQUE", "1"},
    {"EARLY_END", "0"}, {"HAS_CUT", "1"},    {"HAS_PARTS", "1"}, {"WRITES_DEPTH", "1"},
    {"PICKS", "0"},     {"writeDepth", "1"}, EVERY_STEP};
static const plr_define picks[] = {{"MIXES", "1"},      {"HAS_EVENTS", "1"},   {"HAS_STEPS", "1"},
                                   {"HAS_OPAQUE", "1"}, {"EARLY_END", "1"},    {"HAS_CUT", "0"},
                                   {"HAS_PARTS", "0"},  {"WRITES_DEPTH", "0"}, {"PICKS", "1"},
                                   EVERY_STEP};
static const plr_define keeping[] = {
    {"voxels_COMPONENTS", "1"}, {"HAS_LABELS", "0"}, {"PROJECTS", "0"}, {"KEEPS_CLEAR", "1"}};
static const plr_define keeping_leaping[] = {{"voxels_COMPONENTS", "1"},
                                             {"HAS_LABELS", "0"},
                                             {"PROJECTS", "0"},
                                             {"KEEPS_CLEAR", "1"},
                                             {"HAS_LEAPS", "1"}};
static const plr_define keeping_looking[] = {{"voxels_COMPONENTS", "1"},
                                             {"HAS_LABELS", "0"},
                                             {"PROJECTS", "0"},
                                             {"KEEPS_CLEAR", "1"},
                                             {"HAS_LEAPS", "0"}};
static const plr_define scalar[] = {
    {"voxels_COMPONENTS", "1"}, {"HAS_LABELS", "0"}, {"PROJECTS", "0"}, {"HAS_gradients", "0"}};
static const plr_define labelled[] = {
    {"voxels_COMPONENTS", "1"}, {"HAS_LABELS", "1"}, {"PROJECTS", "0"}};
static const plr_define of_segments[] = {{"OF_SURFACES", "0"}};
static const plr_define rgba[] = {
    {"voxels_COMPONENTS", "4"}, {"HAS_LABELS", "0"}, {"PROJECTS", "0"}};
static const plr_define given_gradients[] = {{"voxels_COMPONENTS", "1"},
                                             {"HAS_LABELS", "0"},
                                             {"PROJECTS", "0"},
                                             {"HAS_gradients", "1"},
                                             {"GIVEN_surfaceTolerance", "1"}};
static const plr_define least[] = {{"voxels_COMPONENTS", "2"},
                                   {"HAS_LABELS", "0"},
                                   {"PROJECTS", "1"},
                                   {"renderStyle_type_MIN", "1"}};
static const plr_define mean[] = {{"voxels_COMPONENTS", "4"},
                                  {"HAS_LABELS", "0"},
                                  {"PROJECTS", "1"},
                                  {"renderStyle_type_AVERAGE", "1"}};
static const plr_define greatest[] = {
    {"voxels_COMPONENTS", "1"}, {"HAS_LABELS", "0"}, {"PROJECTS", "1"}};
static const plr_define of_segment[] = {{"OF_SURFACES", "0"}, {"OTHERS", "0"}, {"DRAWN", "1"}};
static const plr_define of_surfaces[] = {{"OF_SURFACES", "1"}, {"OTHERS", "1"}, {"DRAWN", "1"}};
static const plr_define hidden_segment[] = {{"OF_SURFACES", "0"}, {"OTHERS", "0"}, {"DRAWN", "0"}};
static const plr_define blended_by_table[] = {
    {"voxels_COMPONENTS", "1"},
    {"HAS_OTHER", "1"},
    {"DRAFT_NAMES", "0"},
    {"weightFunction1_TABLE", "1"},
    {"weightFunction2_ALPHA1", "1"},
    {"HAS_weightTransferFunction1", "1"},
    {"HAS_weightTransferFunction2", "0"},
};
static const plr_define leading[] = {{"voxels_COMPONENTS", "1"},
                                     {"LEADING", "1"},
                                     {"HAS_transferFunction", "1"},
                                     {"transferFunction_DIMENSIONS", "2"}};
static const plr_define lit_style[] = {
    {"lighting", "1"}, {"shadows", "0"}, {"HAS_material", "1"}, {"material_Material", "1"}};
static const plr_define flat_style[] = {{"lighting", "0"}, {"HAS_material", "0"}};
static const plr_define physical_style[] = {
    {"lighting", "1"}, {"shadows", "0"}, {"HAS_material", "1"}, {"material_PhysicalMaterial", "1"}};
static const plr_define scattering_style[] = {{"lighting", "1"},
                                              {"shadows", "1"},
                                              {"HAS_material", "0"},
                                              {"phaseFunction_Henyey_Greenstein", "1"}};
static const plr_define flat_physical_style[] = {
    {"lighting", "0"}, {"HAS_material", "1"}, {"material_PhysicalMaterial", "1"}};
static const plr_define unlit_style[] = {
    {"lighting", "1"}, {"HAS_material", "1"}, {"material_UnlitMaterial", "1"}};
static const plr_define own_normals[] = {{"surfaceNormals_DIMENSIONS", "3"},
                                         {"surfaceNormals_COMPONENTS", "3"}};
static const plr_define flat_normals[] = {{"surfaceNormals_DIMENSIONS", "2"},
                                          {"surfaceNormals_COMPONENTS", "3"}};
static const plr_define plain_boundary[] = {{"HAS_transferFunction", "0"}};
static const plr_define old_boundary[] = {{"HAS_transferFunction", "1"},
                                          {"transferFunction_DIMENSIONS", "3"},
                                          {"voxels_COMPONENTS", "3"},
                                          {"GIVEN_gradientColor", "1"}};
static const plr_define old_edge[] = {{"GIVEN_contribution", "1"}};
static const plr_define opaque_colors[] = {{"WITH_ALPHA", "0"}};
static const plr_define irradiance[] = {{"HAS_diffuseTexture", "1"},
                                        {"diffuseTexture_DIMENSIONS", "6"}};
static const plr_define first_channel[] = {{"CHANNEL", "0"}};
static const plr_define shifted[] = {{"CHANNEL", "0"},   {"DIMENSIONS", "2"}, {"PROJECTIVE", "0"},
                                     {"REFLECTED", "0"}, {"SHIFTED", "1"},    {"DATA", "1"}};
static const plr_define hatched[] = {{"hatched", "1"}, {"filled", "0"}};
static const plr_define uncharted[] = {{"mode_UNCHARTED", "1"}, {"LINEAR", "1"}};
static const plr_define given_fog[] = {{"HAS_FOG_COORD", "1"},
                                       {"volumetric", "0"},
                                       {"fogType_EXPONENTIAL", "1"},
                                       {"COMPLETE", "0"},
                                       {"VOLUME", "0"}};
static const plr_define complete_fog[] = {
    {"HAS_FOG_COORD", "0"}, {"volumetric", "0"}, {"COMPLETE", "1"}, {"VOLUME", "0"}};
static const plr_define on_surface[] = {{"SURFACE", "1"}};
static const plr_define in_volume[] = {{"SURFACE", "0"}};
static const plr_define top_image[] = {{"FACE", "4"}, {"HAS_IMAGE", "1"}};
static const plr_define left_shader[] = {{"FACE", "2"}, {"HAS_IMAGE", "0"}};
static const plr_define with_ground[] = {{"HAS_GROUND", "1"}};
static const plr_define no_ground[] = {{"HAS_GROUND", "0"}};

#define IMAGE(...)                                                                                 \
    { {"CHANNEL", "0"}, {"SHIFTED", "1"}, __VA_ARGS__ }
static const plr_define image_2d[] =
    IMAGE({"DIMENSIONS", "2"}, {"PROJECTIVE", "0"}, {"REFLECTED", "0"}, {"DATA", "0"});
static const plr_define image_projected[] =
    IMAGE({"DIMENSIONS", "2"}, {"PROJECTIVE", "1"}, {"REFLECTED", "0"}, {"DATA", "0"});
static const plr_define image_cube[] =
    IMAGE({"DIMENSIONS", "6"}, {"PROJECTIVE", "0"}, {"REFLECTED", "1"}, {"DATA", "0"});
static const plr_define image_value[] = IMAGE({"DIMENSIONS", "3"}, {"PROJECTIVE", "1"},
                                              {"REFLECTED", "0"}, {"DATA", "1"}, {"VALUE", "1"});
static const plr_define image_stage[] = IMAGE({"DIMENSIONS", "2"}, {"PROJECTIVE", "0"},
                                              {"REFLECTED", "0"}, {"DATA", "0"}, {"STAGE", "1"});
static const plr_define image_made[] =
    IMAGE({"DIMENSIONS", "0"}, {"PROJECTIVE", "0"}, {"REFLECTED", "0"}, {"DATA", "0"});
static const plr_define own_channel[] = {{"CHANNEL", "0"}, {"UNIT", "0"}};
static const plr_define eye_channel[] = {{"CHANNEL", "0"}, {"UNIT", "0"}, {"EYE", "1"}};
static const plr_define normal_channel[] = {{"CHANNEL", "0"}, {"UNIT", "0"}, {"NORMAL", "1"}};
static const plr_define vertices[] = {{"VERTICES", "1"}};
static const plr_define reflecting[] = {{"VERTICES", "1"},
                                        {"mode_WORLDSPACEREFLECTIONVECTOR", "1"}};
static const plr_define reflected[] = {{"FRAGMENTS", "1"},
                                       {"mode_WORLDSPACEREFLECTIONVECTOR", "1"}};
static const plr_define fragments[] = {{"FRAGMENTS", "1"}};
static const plr_define noisy[] = {{"VERTICES", "1"}, {"mode_NOISE_EYE", "1"}};
static const plr_define subtracting[] = {
    {"MODE_SUBTRACT", "1"}, {"SOURCE_SPECULAR", "1"}, {"FUNCTION_COMPLEMENT", "1"}, {"LAST", "1"}};

static const char steep_shade[] =
    "void PLUG_volume_shade(inout vec4 color, const in VolumeSample s) {\n"
    "    color.rgb *= s.gradient * s.normal_eye;\n}\n";

static const recipe recipes[] = {
    {"unlit",
     "surface/surface",
     {{.path = "surface/UnlitMaterial"}},
     DEFINES(plain),
     .present = "emissiveColor castle_ModelViewMatrix",
     .absent = "ormal castle_vertex_eye vertex_color Color0 MaterialInfo PLUG"},
    {"unlit, coloured",
     "surface/surface",
     {{.path = "surface/UnlitMaterial"}, {.path = "surface/Color", DEFINES(opaque_colors)}},
     DEFINES(colored),
     .present = "vertex_color castle_ColorPerVertex transparency",
     .absent = "ormal emissiveColor"},
    {"unlit, textured",
     "surface/surface",
     {{.path = "surface/UnlitMaterial"},
      {.path = "textures/TextureCoordinate", DEFINES(own_channel)},
      {.path = "textures/TextureTransform", DEFINES(vertices), .attached = 2},
      {.path = "textures/Texture", DEFINES(image_2d)}},
     DEFINES(plain),
     .present = "castle_MultiTexCoord0 sampler2D",
     .absent = "ormal textureProj"},
    {"textures of a complete shader",
     "surface/surface",
     {{.path = "surface/ComposedShader"},
      {.path = "textures/TextureCoordinate", DEFINES(own_channel)},
      {.path = "textures/Texture", DEFINES(image_2d)}},
     DEFINES(plain),
     .present = "main_texture_apply surface_texture vertex_attributes"},
    {"unlit, textures in space and projected",
     "surface/surface",
     {{.path = "surface/UnlitMaterial"},
      {.path = "textures/TextureCoordinate", DEFINES(eye_channel)},
      {.path = "textures/ProjectedTextureCoordinate", .attached = 2},
      {.path = "textures/TextureTransform3D", DEFINES(vertices), .attached = 2},
      {.path = "textures/TextureTransformMatrix3D", DEFINES(vertices), .attached = 2},
      {.path = "textures/Texture", DEFINES(image_projected)}},
     DEFINES(plain),
     .present = "eyeToProjector textureProj",
     .absent = "ormal castle_MultiTexCoord"},
    {"unlit, a cube reflected",
     "surface/surface",
     {{.path = "surface/UnlitMaterial"},
      {.path = "textures/TextureCoordinate", DEFINES(normal_channel)},
      {.path = "textures/TextureCoordinateGenerator", DEFINES(reflecting), .attached = 2},
      {.path = "textures/Texture", DEFINES(image_cube)},
      {.path = "textures/TextureCoordinateGenerator", DEFINES(reflected), .attached = 4},
      {.path = "textures/TextureTransform3D", DEFINES(fragments), .attached = 4},
      {.path = "textures/TextureTransformMatrix3D", DEFINES(fragments), .attached = 4},
      {.path = "textures/TextureTransform", DEFINES(fragments), .attached = 4}},
     DEFINES(plain),
     .present = "samplerCube castle_normal_eye reflect",
     .absent = "castle_MultiTexCoord refract"},
    {"unlit, textures one over the other",
     "surface/surface",
     {{.path = "surface/UnlitMaterial"},
      {.path = "textures/TextureCoordinate", DEFINES(eye_channel)},
      {.path = "textures/TextureCoordinateGenerator", DEFINES(noisy), .attached = 2},
      {.path = "textures/MultiTexture"},
      {.path = "textures/Texture", DEFINES(image_stage), .attached = 4},
      {.path = "textures/MultiTextureMode", DEFINES(subtracting), .attached = 5}},
     DEFINES(plain),
     .present = "specularColor solid_noise_vector",
     .absent = "castle_MultiTexCoord alpha; factor;"},
    {"pink",
     "surface/surface",
     {{.path = "surface/UnlitMaterial"},
      {.path = "textures/TextureCoordinate", DEFINES(own_channel)},
      {.path = "textures/Texture", DEFINES(image_made)}},
     DEFINES(plain),
     .absent = "sampler TexCoord"},
    {"textures of a material",
     "surface/surface",
     {{.path = "surface/Material"},
      {.path = "textures/ambientTexture"},
      {.path = "textures/Texture", DEFINES(image_value), .attached = 2},
      {.path = "textures/specularTexture"},
      {.path = "textures/shininessTexture"},
      {.path = "textures/emissiveTexture"},
      {.path = "textures/occlusionTexture"},
      {.path = "lights/PointLight"}},
     DEFINES(plain),
     .present = "sampler3D occlusionStrength"},
    {"textures of a physical material",
     "surface/surface",
     {{.path = "surface/PhysicalMaterial"},
      {.path = "textures/metallicRoughnessTexture"},
      {.path = "textures/Texture", DEFINES(image_value), .attached = 2},
      {.path = "lights/PointLight"}},
     DEFINES(plain),
     .present = "sampler3D"},
    {"unlit, every plug",
     "surface/surface",
     {{.path = "surface/UnlitMaterial"},
      {"author", .text = "void PLUG_fragment_eye_space(const vec4 v, inout vec3 n) { n.x = v.x; }\n"
                         "void PLUG_fog_apply(inout vec4 c, const vec3 n) { c.rgb = n; }"}},
     DEFINES(plain),
     .present = "castle_Normal castle_vertex_eye castle_NormalMatrix",
     .absent = "gl_FrontFacing"},
    {"material without light",
     "surface/surface",
     {{.path = "surface/Material"}},
     DEFINES(plain),
     .present = "emissiveColor",
     .absent = "ormal castle_vertex_eye MaterialInfo shininess"},
    {"material and light",
     "surface/surface",
     {{.path = "surface/Material"}, {.path = "lights/DirectionalLight"}},
     DEFINES(plain),
     .present = "castle_Normal shininess MaterialInfo",
     .absent = "attenuation gl_FrontFacing"},
    {"material and all lights, two-sided, coloured",
     "surface/surface",
     {{.path = "surface/Material"},
      {.path = "lights/DirectionalLight"},
      {.path = "lights/EnvironmentLight", DEFINES(irradiance)},
      {.path = "lights/PointLight"},
      {.path = "lights/SpotLight"},
      {.path = "lights/SpotLight"}},
     DEFINES(colored),
     .present = "gl_FrontFacing attenuation cutOffAngle",
     .absent = "diffuseColor"},
    {"physical material and light, two-sided",
     "surface/surface",
     {{.path = "surface/PhysicalMaterial"},
      {.path = "textures/Texture", DEFINES(image_2d)},
      {.path = "surface/back/PhysicalMaterial"},
      {.path = "lights/DirectionalLight"},
      {.path = "output/ToneMapping", DEFINES(uncharted)},
      {.path = "output/Gamma"}},
     DEFINES(plain),
     .present = "metallic gl_FrontFacing roughness",
     .absent = "shininess phong"},
    {"a common surface shader",
     "surface/surface",
     {{.path = "surface/CommonSurfaceShader"}, {.path = "lights/PointLight"}},
     DEFINES(plain),
     .present = "ambientFactor specularFactor MaterialInfo"},
    {"two-sided materials",
     "surface/surface",
     {{.path = "surface/Material"},
      {.path = "surface/back/Material"},
      {.path = "surface/back/TwoSidedMaterial"},
      {.path = "lights/PointLight"}},
     DEFINES(plain),
     .present = "backShininess"},
    {"unlit, two-sided, in fog, cut",
     "surface/surface",
     {{.path = "surface/UnlitMaterial"},
      {.path = "surface/back/UnlitMaterial"},
      {.path = "fog/Fog", DEFINES(given_fog)},
      {.path = "fog/ClipPlane", DEFINES(on_no_volume)}},
     DEFINES(plain),
     .present = "castle_FogCoord discard exp",
     .absent = "volumetric"},
    {"fog of a complete shader",
     "surface/surface",
     {{.path = "fog/Fog", DEFINES(complete_fog)}},
     DEFINES(plain),
     .present = "fog_place"},
    {"bumps",
     "surface/surface",
     {{.path = "surface/Material"},
      {.path = "lights/DirectionalLight"},
      {.path = "surface/NormalMap", DEFINES(first_channel)},
      {.path = "textures/Texture", DEFINES(shifted)},
      {.path = "surface/HeightMap"}},
     DEFINES(plain),
     .present = "normalScale dFdx heightMapScale"},
    {"patterns, sizes and holes",
     "surface/surface",
     {{.path = "surface/UnlitMaterial"},
      {.path = "surface/LineProperties"},
      {.path = "surface/PointProperties"},
      {.path = "surface/FillProperties", DEFINES(hatched)},
      {.path = "surface/AlphaTest"}},
     DEFINES(plain),
     .present = "plugray_LineDistance gl_PointSize hatchColor alphaCutoff",
     .absent = "ormal castle_vertex_eye"},
    {"every plug of surfaces",
     "surface/surface",
     {{.path = "surface/Material"},
      {.path = "textures/TextureCoordinate", DEFINES(own_channel)},
      {.path = "textures/Texture", DEFINES(image_2d)},
      {.path = "lights/PointLight"},
      {.path = "lights/PointLight"},
      {"author", .text = every_fragment_plug, .vertex_text = every_vertex_plug},
      {"lit", .text = every_lit_plug},
      {"short", .text = short_texture_plug}},
     DEFINES(colored),
     .present = "seen"},
    {"one volume",
     "volume/raycaster",
     {{.path = STEPPED, DEFINES(scalar)},
      {.path = "volume/OpacityMapVolumeStyle", DEFINES(leading)},
      {.path = "volume/Composite"}},
     DEFINES(one_volume),
     .absent = "normal_ gradient MaterialInfo position_eye"},
    {"promises that are tried",
     "general/trust",
     {{.path = "volume/grid volume/Trial", DEFINES(scalar)},
      {"author", .text = steep_shade, .attached = 1}},
     DEFINES(one_volume),
     .present = "hashed sampleDistance castle_ModelViewMatrix normal_eye",
     .absent = "ray_origin localStart"},
    {"one volume that looks ahead",
     "volume/raycaster",
     {{.path = STEPPED, DEFINES(keeping)},
      {.path = "volume/OpacityMapVolumeStyle", DEFINES(leading), .attached = 1},
      {.path = "volume/Composite"}},
     DEFINES(one_skipping),
     .present = "lowest_bit volume_visible",
     .absent = "VolumeMix ahead_sums leaps"},
    {"one volume that leaps ahead",
     "volume/raycaster",
     {{.path = LEAPING, DEFINES(keeping_leaping)},
      {.path = "volume/OpacityMapVolumeStyle", DEFINES(leading), .attached = 1},
      {.path = "volume/Composite"}},
     DEFINES(one_leaping),
     .present = "lowest_bit volume_visible volume_leap leaps",
     .absent = "VolumeMix ahead_sums"},
    {"two volumes that look ahead",
     "volume/raycaster",
     {{.path = STEPPED, DEFINES(keeping)},
      {.path = STEPPED, DEFINES(keeping)},
      {.path = "volume/OpacityMapVolumeStyle", DEFINES(leading), .attached = 1},
      {.path = "volume/Composite"}},
     DEFINES(two_skipping),
     .present = "lowest_bit volume_visible VolumeMix ahead_sums piece_t"},
    {"many volumes, of which one leaps ahead",
     "volume/raycaster",
     {{.path = LEAPING, DEFINES(keeping_leaping)},
      {.path = STEPPED, DEFINES(keeping_looking)},
      {.path = "volume/OpacityMapVolumeStyle", DEFINES(leading), .attached = 1},
      {.path = "volume/Composite"}},
     DEFINES(many_leaping),
     .present = "lowest_bit pass_clear leaps VolumeMix ahead_sums piece_t"},
    {"one volume in segments",
     "volume/raycaster",
     {{.path = TABLED "volume/segments", DEFINES(tabled)}, {.path = "volume/Composite"}},
     DEFINES(in_segments),
     .present = "integrals leaps lowest_bit volume_join",
     .absent = "wallValues places voxelGradients voxelQuads"},
    {"one lit volume in segments",
     "volume/raycaster",
     {{.path = TABLED "volume/segments", DEFINES(holding)},
      {.path = "volume/ShadedVolumeStyle", DEFINES(lit_style)},
      {.path = "volume/Composite"},
      {.path = "lights/DirectionalLight"}},
     DEFINES(in_segments),
     .present = "integrals places voxelGradients voxelQuads",
     .absent = "scalar_at"},
    {"two volumes in segments",
     "volume/raycaster",
     {{.path = TABLED "volume/segments", DEFINES(walled)},
      {.path = TABLED "volume/segments", DEFINES(walled)},
      {.path = "volume/Composite"}},
     DEFINES(two_in_segments),
     .present = "integrals wallValues",
     .absent = "leaps volume_join"},
    {"one volume in cells",
     "volume/raycaster",
     {{.path = TABLED "volume/cells", DEFINES(tabled)}, {.path = "volume/Composite"}},
     DEFINES(in_cells),
     .present = "sums ranges leaps lowest_bit",
     .absent = "integrals wallValues labels cellLabels"},
    {"two volumes in cells",
     "volume/raycaster",
     {{.path = TABLED "volume/cells", DEFINES(walled)},
      {.path = TABLED "volume/cells", DEFINES(tabled)},
      {.path = "volume/Composite"}},
     DEFINES(two_in_cells),
     .present = "sums wall_at",
     .absent = "wallValues"},
    {"two volumes in cells, one of segments",
     "volume/raycaster",
     {{.path = TABLED "volume/cells", DEFINES(in_segmented)},
      {.path = TABLED "volume/cells", DEFINES(tabled)},
      {.path = "volume/Composite"}},
     DEFINES(two_in_cells),
     .present = "labels cellLabels range_of"},
    {"one lit volume",
     "volume/raycaster",
     {{.path = STEPPED, DEFINES(scalar)},
      {.path = "volume/OpacityMapVolumeStyle", DEFINES(leading)},
      {.path = "volume/ShadedVolumeStyle", DEFINES(lit_style)},
      {.path = "volume/Composite"},
      {.path = "lights/DirectionalLight"},
      {.path = "lights/SpotLight"}},
     DEFINES(one_volume),
     .present = "normal_eye MaterialInfo"},
    {"one volume in parts",
     "volume/raycaster",
     {{.path = STEPPED, DEFINES(scalar)}, {.path = "volume/Composite"}},
     DEFINES(one_in_parts),
     .present = "partStart partEnd gl_FragDepth"},
    {"volumes in parts",
     "volume/raycaster",
     {{.path = STEPPED, DEFINES(scalar)},
      {.path = SURFACES, DEFINES(scalar)},
      {.path = PROJECTED, DEFINES(greatest)},
      {.path = "volume/Composite"}},
     DEFINES(all_in_parts),
     .present = "partStart partEnd gl_FragDepth"},
    {"a ray that picks",
     "volume/raycaster",
     {{.path = STEPPED, DEFINES(scalar)},
      {.path = SURFACES, DEFINES(scalar)},
      {.path = PROJECTED, DEFINES(greatest)},
      {.path = "volume/Composite"}},
     DEFINES(picks),
     .present = "picked",
     .absent = "partStart gl_FragDepth transparencyLeft"},
    {"boundary enhancement",
     "volume/raycaster",
     {{.path = STEPPED, DEFINES(scalar)},
      {.path = "volume/BoundaryEnhancementVolumeStyle", DEFINES(plain_boundary)},
      {.path = "volume/Composite"}},
     DEFINES(one_volume),
     .present = "gradientUnit pow",
     .absent = "position_eye normal_eye gradientColor transferFunction"},
    {"boundary enhancement of 2005",
     "volume/raycaster",
     {{.path = STEPPED, DEFINES(scalar)},
      {.path = "volume/BoundaryEnhancementVolumeStyle", DEFINES(old_boundary)},
      {.path = "volume/Composite"}},
     DEFINES(one_volume),
     .present = "gradientColor contribution style_transfer",
     .absent = "position_eye normal_eye"},
    {"styles of directions",
     "volume/raycaster",
     {{.path = STEPPED, DEFINES(scalar)},
      {.path = "volume/SilhouetteEnhancementVolumeStyle"},
      {.path = "volume/EdgeEnhancementVolumeStyle"},
      {.path = "volume/EdgeEnhancementVolumeStyle", DEFINES(old_edge)},
      {.path = "volume/CartoonVolumeStyle", DEFINES(flat_normals)},
      {.path = "volume/Composite"}},
     DEFINES(one_volume),
     .present = "normal_eye position_eye mix_in_hsv",
     .absent = "gradientUnit surfaceNormals MaterialInfo"},
    {"normals of a style's own",
     "volume/raycaster",
     {{.path = STEPPED, DEFINES(scalar)},
      {.path = "volume/SilhouetteEnhancementVolumeStyle", DEFINES(own_normals)},
      {.path = "volume/CartoonVolumeStyle", DEFINES(own_normals)},
      {.path = "volume/Composite"}},
     DEFINES(one_volume),
     .present = "surfaceNormals",
     .absent = "normal_eye gradient"},
    {"warm and cool",
     "volume/raycaster",
     {{.path = STEPPED, DEFINES(scalar)},
      {.path = "volume/ToneMappedVolumeStyle"},
      {.path = "volume/Composite"},
      {.path = "lights/DirectionalLight"},
      {.path = "lights/PointLight"}},
     DEFINES(one_volume),
     .present = "normal_eye MaterialInfo warmColor",
     .absent = "phong_reflection"},
    {"warm and cool without light",
     "volume/raycaster",
     {{.path = STEPPED, DEFINES(scalar)},
      {.path = "volume/ToneMappedVolumeStyle"},
      {.path = "volume/Composite"}},
     DEFINES(one_volume),
     .absent = "normal_eye MaterialInfo warmColor position_eye"},
    {"a physical material in a volume",
     "volume/raycaster",
     {{.path = STEPPED, DEFINES(scalar)},
      {.path = "volume/ShadedVolumeStyle", DEFINES(physical_style)},
      {.path = "volume/Composite"},
      {.path = "lights/SpotLight"}},
     DEFINES(one_volume),
     .present = "physical_reflection roughness",
     .absent = "phong_reflection shininess phase"},
    {"scattering",
     "volume/raycaster",
     {{.path = STEPPED, DEFINES(scalar)},
      {.path = "volume/ShadedVolumeStyle", DEFINES(scattering_style)},
      {.path = "volume/Composite"},
      {.path = "lights/PointLight"}},
     DEFINES(one_volume),
     .present = "phase_function phong_reflection",
     .absent = "emissiveColor"},
    {"a volume in its own shadow",
     "volume/raycaster",
     {{.path = STEPPED, DEFINES(scalar)},
      {.path = "volume/ShadedVolumeStyle", DEFINES(scattering_style), .is_private = true},
      {.path = "lights/DirectionalLight", DEFINES(in_shadow), .attached = 2},
      {.path = "shadows/VolumeShadow", DEFINES(seen_shadows), .is_private = true},
      {.path = SHADOW_STEPS, DEFINES(scalar), .attached = 4, .is_private = true},
      {.path = "volume/OpacityMapVolumeStyle", DEFINES(leading), .attached = 5},
      {.path = "volume/Composite"}},
     DEFINES(one_volume),
     .present = "shadowIntensity add_depth light.a",
     .absent = "labels surfaceCount t_enter"},
    {"surfaces in the shadow of volumes",
     "surface/surface",
     {{.path = "surface/Material"},
      {.path = "lights/PointLight", DEFINES(in_shadow)},
      {.path = "lights/SpotLight", DEFINES(in_shadow)},
      {.path = "lights/EnvironmentLight"},
      {.path = "shadows/VolumeShadow", DEFINES(all_shadows), .is_private = true},
      {.path = SHADOW_STEPS, DEFINES(labelled), .attached = 5, .is_private = true},
      {.path = "fog/ClipPlane", DEFINES(plane_of_volume), .attached = 6},
      {.path = SHADOW_SURFACES, DEFINES(given_gradients), .attached = 5, .is_private = true},
      {.path = "volume/SilhouetteEnhancementVolumeStyle", .attached = 8}},
     DEFINES(plain),
     .present = "add_depth surfaceCount VolumeSample t_enter",
     .absent = "light.a volumeIndex labels"},
    {"materials without light",
     "volume/raycaster",
     {{.path = STEPPED, DEFINES(scalar)},
      {.path = "volume/ShadedVolumeStyle", DEFINES(unlit_style)},
      {.path = "volume/ShadedVolumeStyle", DEFINES(flat_physical_style)},
      {.path = "volume/ShadedVolumeStyle", DEFINES(lit_style)},
      {.path = "volume/Composite"}},
     DEFINES(one_volume),
     .present = "emissiveColor baseColor",
     .absent = "normal_eye MaterialInfo roughness position_eye"},
    {"points",
     "volume/raycaster",
     {{.path = STEPPED, DEFINES(scalar)},
      {.path = "volume/StippleVolumeStyle"},
      {.path = "volume/Composite"},
      {.path = "lights/DirectionalLight"}},
     DEFINES(one_volume),
     .present = "voxelLength approach MaterialInfo lightingFactor",
     .absent = "phong_reflection surfaceNormals"},
    {"points without light",
     "volume/raycaster",
     {{.path = STEPPED, DEFINES(scalar)},
      {.path = "volume/StippleVolumeStyle"},
      {.path = "volume/Composite"}},
     DEFINES(one_volume),
     .absent = "MaterialInfo lightingFactor"},
    {"two volumes",
     "volume/raycaster",
     {{.path = STEPPED, DEFINES(scalar)},
      {.path = STEPPED, DEFINES(rgba)},
      {.path = "volume/ShadedVolumeStyle", DEFINES(flat_style)},
      {.path = "volume/Composite"}},
     DEFINES(two_volumes)},
    {"surfaces in their own styles",
     "volume/raycaster",
     {{.path = SURFACES, DEFINES(scalar)},
      {.path = "volume/Choice", DEFINES(of_surfaces), .attached = 1, .is_private = true},
      {.path = "volume/OpacityMapVolumeStyle", DEFINES(leading), .attached = 2},
      {.path = "volume/ShadedVolumeStyle", DEFINES(lit_style), .attached = 2},
      {.path = "volume/Composite"},
      {.path = "lights/DirectionalLight"}},
     DEFINES(surfaces),
     .present = "next_crossing cubic choiceNumber MaterialInfo",
     .absent = "volume_mix_add segment cell_value is_steep"},
    {"surfaces with gradients of their own, no style",
     "volume/raycaster",
     {{.path = SURFACES, DEFINES(given_gradients)}, {.path = "volume/Composite"}},
     DEFINES(surfaces),
     .present = "gradients is_steep",
     .absent = "gradient_at normal_eye"},
    {"surfaces of values that an author changes",
     "volume/raycaster",
     {{.path = SURFACES, DEFINES(scalar)},
      {"author",
       .text = "void PLUG_volume_sample(inout VolumeSample s) { s.value.r *= s.value.r; }"},
      {.path = "volume/Composite"}},
     DEFINES(surfaces),
     .present = "cell_value sampleDistance",
     .absent = "cubic is_steep"},
    {"three projections",
     "volume/raycaster",
     {{.path = PROJECTED, DEFINES(least)},
      {.path = PROJECTED, DEFINES(mean)},
      {.path = PROJECTED, DEFINES(greatest)},
      {.path = "volume/Composite"}},
     DEFINES(surfaces),
     .present = "intensityThreshold",
     .absent = "gradient volume_mix_add"},
    {"segments",
     "volume/raycaster",
     {{.path = STEPPED, DEFINES(labelled)},
      {.path = "volume/Choice", DEFINES(of_segment), .attached = 1, .is_private = true},
      {.path = "volume/OpacityMapVolumeStyle", DEFINES(leading), .attached = 2},
      {.path = "volume/Choice", DEFINES(hidden_segment), .attached = 1, .is_private = true},
      {.path = "volume/Composite"}},
     DEFINES(one_volume),
     .present = "usampler3D texelFetch choiceNumber",
     .absent = "gradient"},
    {"segments with maps alone",
     "volume/raycaster",
     {{.path = STEPPED, DEFINES(labelled)},
      {.path = "volume/SegmentMaps", DEFINES(labelled), .attached = 1},
      {.path = "volume/Composite"}},
     DEFINES(one_volume),
     .present = "usampler3D segmentMaps plugray_TransferFunctions",
     .absent = "gradient choiceNumber"},
    {"switches of a general program",
     "volume/raycaster",
     {{.path = STEPPED, DEFINES(labelled)},
      {.path = "volume/Hidden general/Gate", .attached = 1},
      {.path = "volume/SegmentSwitches", DEFINES(of_segments), .attached = 1},
      {.path = "volume/Composite"}},
     DEFINES(one_volume),
     .present = "usampler3D segmentMaps plr1_gate",
     .absent = "gradient choiceNumber plugray_TransferFunctions"},
    {"another volume blended",
     "volume/raycaster",
     {{.path = STEPPED, DEFINES(scalar)},
      {.path = "volume/BlendedVolumeStyle volume/grid",
       DEFINES(blended_by_table),
       .attached = 1,
       .is_private = true},
      {.path = "volume/OpacityMapVolumeStyle", DEFINES(leading), .attached = 2},
      {.path = "volume/Composite"}},
     DEFINES(one_volume),
     .present = "weightTransferFunction1",
     .absent = "gradient weightConstant1 weightTransferFunction2"},
    {"fog and a plane in a volume",
     "volume/raycaster",
     {{.path = STEPPED, DEFINES(scalar)},
      {.path = "fog/Fog", DEFINES(fog_of_volume)},
      {.path = "fog/ClipPlane", DEFINES(fog_of_volume)},
      {.path = "volume/Composite"}},
     DEFINES(one_volume),
     .present = "visibilityRange sample_place t_exit",
     .absent = "gradient discard"},
    {"shadows of a map and of a cube",
     "surface/surface",
     {{.path = "surface/Material"},
      {.path = "lights/DirectionalLight"},
      {.path = "shadows/ShadowMap", DEFINES(on_surface), .attached = 2},
      {.path = "lights/PointLight"},
      {.path = "shadows/ShadowCube", DEFINES(on_surface), .attached = 4}},
     DEFINES(plain),
     .present = "sampler2DShadow samplerCubeShadow shadowIntensity"},
    {"shadow in a volume",
     "volume/raycaster",
     {{.path = STEPPED, DEFINES(scalar)},
      {.path = "volume/OpacityMapVolumeStyle", DEFINES(leading)},
      {.path = "volume/ShadedVolumeStyle", DEFINES(lit_style)},
      {.path = "volume/Composite"},
      {.path = "lights/DirectionalLight"},
      {.path = "shadows/ShadowMap", DEFINES(in_volume), .attached = 5}},
     DEFINES(one_volume),
     .present = "sampler2DShadow",
     .absent = "dFdx"},
    {"depths of a shadow map",
     "shadows/depth",
     {{.path = NULL}},
     DEFINES(plain),
     .absent = "FragColor"},
    {"pictures around the viewer",
     "background/background",
     {{.path = "background/Background", DEFINES(no_ground)},
      {.path = "background/BackgroundFace", DEFINES(top_image)},
      {.path = "background/BackgroundFace", DEFINES(left_shader)}},
     NULL,
     0,
     .present = "textureGrad",
     .absent = "groundColor"},
    {"one picture",
     "background/background",
     {{.path = "background/ImageBackground", DEFINES(top_image)}},
     NULL,
     0,
     .present = "texCoords"},
    {"sky",
     "background/background",
     {{.path = "background/Background", DEFINES(no_ground)}},
     NULL,
     0,
     .absent = "groundColor"},
    {"sky and ground",
     "background/background",
     {{.path = "background/Background", DEFINES(with_ground)}},
     NULL,
     0,
     .present = "groundColor"},
};

/* ---- The examples of docs/plugs.md -------------------------------------------------------------
 */

/* The next block of indented lines; NULL at the end. Blank lines separate blocks. */
static char *next_block(const char **at) {
    while (**at && strncmp(*at, "    ", 4) != 0) {
        *at += strcspn(*at, "\n");
        *at += **at == '\n';
    }
    if (!**at)
        return NULL;
    const char *start = *at;
    while (strncmp(*at, "    ", 4) == 0) {
        *at += strcspn(*at, "\n");
        *at += **at == '\n';
    }
    size_t length = (size_t)(*at - start);
    char *block = malloc(length + 1);
    memcpy(block, start, length);
    block[length] = 0;
    return block;
}

static void check_example(const char *text) {
    char name[100] = "example";
    sscanf(strstr(text, "PLUG_"), "%99[A-Za-z_]", name);
    bool vertex = strstr(text, "PLUG_vertex") != NULL;
    bool geometry = strstr(text, "PLUG_geometry") != NULL;
    bool volume = strstr(text, "PLUG_volume") != NULL;
    static const char emitting[] =
        "layout(triangles) in; layout(triangle_strip, max_vertices = 3) out;\n"
        "void main() { geometryVertexSet(0); geometryVertexZero(); geometryVertexAdd(1, 0.5);\n"
        "  EmitVertex(); }\n";
    const recipe surfaces = {name,
                             "surface/surface",
                             {{.path = "surface/Material"},
                              {.path = "textures/Texture", DEFINES(image_2d)},
                              {.path = "lights/DirectionalLight"},
                              {.path = name,
                               .text = vertex || geometry ? NULL : text,
                               .vertex_text = vertex ? text : NULL,
                               .geometry_text = geometry ? text : NULL},
                              {.path = geometry ? "emitting" : NULL, .geometry_text = emitting}},
                             DEFINES(plain),
                             .present = name + strlen("PLUG_")};
    const recipe volumes = {name,
                            "volume/raycaster",
                            {{.path = STEPPED, DEFINES(scalar)},
                             {.path = "volume/OpacityMapVolumeStyle", DEFINES(leading)},
                             {.path = "volume/Composite"},
                             {.path = name, .text = text}},
                            DEFINES(one_volume),
                            .present = name + strlen("PLUG_")};
    check_recipe(volume ? &volumes : &surfaces);
}

static void check_examples(const char *path) {
    FILE *file = fopen(path, "rb");
    char *text = calloc(1, 100000);
    size_t length = file ? fread(text, 1, 99999, file) : 0;
    if (file)
        fclose(file);
    int examples = 0;
    char *block;
    for (const char *at = text; length && (block = next_block(&at));) {
        if (strstr(block, "void PLUG_") && !strstr(block, "Effect {")) {
            check_example(block);
            examples++;
        }
        free(block);
    }
    CHECK(examples > 15);
    free(text);
}

int main(int argc, char **argv) {
    for (size_t i = 0; i < sizeof recipes / sizeof *recipes; i++)
        check_recipe(&recipes[i]);
    const char *name;
    for (size_t i = 0; (name = plr_effects_file(i, NULL, NULL)) && i < 256; i++)
        TAP_RESULT(covered[i], "%s is tested", name);
    if (argc > 1)
        check_examples(argv[1]);
    return tap_done();
}
