/* What materials, lights, textures and plugs of surfaces draw, against closed forms: one pixel in
 * the middle of a square that faces the viewer. */
#include <plugray/engine.h>

#include "tests/tap.h"

#define SIZE 9 /* odd: the middle pixel looks at the origin */

typedef struct shot {
    const char *name;
    const char *body; /* of the scene, in Classic VRML */
    double color[4];  /* premultiplied */
} shot;

static const char head[] = "#X3D V4.0 utf8\nPROFILE Full\n"
                           "NavigationInfo { headlight FALSE }\n"
                           "OrthoViewpoint { position 0 0 10 fieldOfView [ -1 -1 1 1 ] }\n";

static bool draw(plr_engine *engine, const shot *s, float color[4]) {
    char text[4096];
    snprintf(text, sizeof text, "%s%s\n", head, s->body);
    plr_diags *diags = plr_diags_create(NULL);
    plr_scene *scene = plr_scene_parse(text, strlen(text), "shot.x3dv", NULL, diags);
    plr_view *view = scene ? plr_view_create(engine, scene, NULL, diags) : NULL;
    plr_draw_desc desc = {.width = SIZE, .height = SIZE};
    plr_picture picture = {0};
    bool drawn = view && plr_view_draw(view, &desc, &picture, diags);
    if (drawn)
        memcpy(color, picture.pixels + 4 * (size_t)(SIZE * (SIZE / 2) + SIZE / 2),
               4 * sizeof *color);
    for (size_t i = 0; i < plr_diags_count(diags); i++) {
        const plr_diag *diag = plr_diags_get(diags, i);
        printf("# %u: %s\n", diag->place.line, diag->message);
        drawn = drawn && diag->code == PLR_CODE_DEPRECATED_PLUG;
    }
    plr_picture_free(&picture);
    plr_view_destroy(&view);
    plr_scene_destroy(&scene);
    plr_diags_destroy(&diags);
    return drawn;
}

static void check_shot(plr_engine *engine, const shot *s) {
    float color[4] = {-1, -1, -1, -1};
    bool fine = draw(engine, s, color);
    for (int i = 0; i < 4; i++)
        fine = fine && fabs((double)color[i] - s->color[i]) < 2e-5;
    TAP_RESULT(fine, "%s", s->name);
    if (!fine)
        printf("# expected %.5f %.5f %.5f %.5f\n#   actual %.5f %.5f %.5f %.5f\n", s->color[0],
               s->color[1], s->color[2], s->color[3], (double)color[0], (double)color[1],
               (double)color[2], (double)color[3]);
}

/* Shapes and effects in short. */
#define SQUARE "geometry Rectangle2D { size 2 2 } "
#define LOOKS(appearance) "Shape { " SQUARE " appearance Appearance { " appearance " } } "
#define MATERIAL(fields) LOOKS("material Material { " fields " }")
#define WHITE "material Material { diffuseColor 1 1 1 ambientIntensity 0 } "
#define FRONT_LIGHT "DirectionalLight { direction 0 0 -1 } "
/* A light from above: L = (0, 0.6, 0.8), the normal is (0, 0, 1). */
#define LIGHT(fields) "DirectionalLight { direction 0 -3 -4 " fields " } "
#define EFFECT(code)                                                                               \
    "Effect { parts EffectPart { type \"FRAGMENT\" url \"data:text/plain," code "\" } } "
#define VERTEX_EFFECT(code) "Effect { parts EffectPart { url \"data:text/plain," code "\" } } "

static void check_materials(plr_engine *engine) {
    double n_dot_h = 1.8 / sqrt(0.6 * 0.6 + 1.8 * 1.8);
    const shot shots[] = {
        {"no material is white", LOOKS(""), {1, 1, 1, 1}},
        {"an unlit material is its emissive colour",
         LOOKS("material UnlitMaterial { emissiveColor 1 0.5 0.25 }") FRONT_LIGHT,
         {1, 0.5, 0.25, 1}},
        {"no light: emissive colour only",
         MATERIAL("emissiveColor 0.1 0.2 0.3"),
         {0.1, 0.2, 0.3, 1}},
        {"diffuse by the cosine, the light's colour and intensity",
         MATERIAL("diffuseColor 1 0.5 0.25") LIGHT("color 1 1 0.5 intensity 0.5"),
         {0.4, 0.2, 0.05, 1}},
        {"ambient: both intensities, and not the light's own",
         MATERIAL("diffuseColor 0.5 0.5 0.5 ambientIntensity 0.4")
             LIGHT("intensity 0 ambientIntensity 0.5 color 1 0.5 0"),
         {0.1, 0.05, 0, 1}},
        {"specular: the half vector to the power of 128 shininess",
         MATERIAL("diffuseColor 0 0 0 specularColor 1 0.5 0 shininess 0.25") LIGHT(""),
         {pow(n_dot_h, 32), pow(n_dot_h, 32) / 2, 0, 1}},
        {"two lights add up",
         MATERIAL("diffuseColor 0.5 0.5 0.5") LIGHT("intensity 0.5") LIGHT("color 1 0 0"),
         {0.6, 0.2, 0.2, 1}},
        {"a light from behind gives nothing",
         MATERIAL("") "DirectionalLight { direction 0 0 1 }",
         {0, 0, 0, 1}},
        {"transparency blends",
         LOOKS("material UnlitMaterial { emissiveColor 1 0.5 0 transparency 0.75 }"),
         {0.25, 0.125, 0, 0.25}},
    };
    for (size_t i = 0; i < sizeof shots / sizeof *shots; i++)
        check_shot(engine, &shots[i]);
}

static void check_lights(plr_engine *engine) {
    const shot shots[] = {
        {"a point light by its distance",
         LOOKS(WHITE) "PointLight { location 0 3 4 attenuation 1 1 0 }",
         {0.8 / 6, 0.8 / 6, 0.8 / 6, 1}},
        {"attenuation in the light's own coordinates",
         LOOKS(WHITE) "Transform { scale 2 2 2 children PointLight { location 0 1.5 2 "
                      "attenuation 1 1 0 } }",
         {0.8 / 3.5, 0.8 / 3.5, 0.8 / 3.5, 1}},
        {"in reach, own coordinates",
         LOOKS(
             WHITE) "Transform { scale 2 2 2 children PointLight { location 0 1.5 2 radius 2.6 } }",
         {0.8, 0.8, 0.8, 1}},
        {"out of reach",
         LOOKS(
             WHITE) "Transform { scale 2 2 2 children PointLight { location 0 1.5 2 radius 2.4 } }",
         {0, 0, 0, 1}},
        {"attenuation never brightens",
         LOOKS(WHITE) "PointLight { location 0 0 0.1 attenuation 0 1 0 }",
         {1, 1, 1, 1}},
        {"a spot light between beam and cut-off",
         LOOKS(WHITE) "SpotLight { location 0 0 1 direction 0 -0.479425538604 -0.87758256189 "
                      "beamWidth 0.4 cutOffAngle 0.6 }",
         {0.5, 0.5, 0.5, 1}},
        {"a spot light inside its beam",
         LOOKS(WHITE) "SpotLight { location 0 0 1 beamWidth 0.4 cutOffAngle 0.6 }",
         {1, 1, 1, 1}},
        {"a spot light outside its cone",
         LOOKS(
             WHITE) "SpotLight { location 0 0 1 direction 0 -1 -1 beamWidth 0.4 cutOffAngle 0.7 }",
         {0, 0, 0, 1}},
        {"the back of a two-sided shape faces the viewer",
         "Transform { rotation 0 1 0 3.14159265 children " LOOKS(WHITE) " } " LIGHT(""),
         {0.8, 0.8, 0.8, 1}},
        {"the back of a solid shape is not drawn",
         "Transform { rotation 0 1 0 3.14159265 children Shape { geometry Rectangle2D { solid TRUE "
         "} "
         "} }",
         {0, 0, 0, 0}},
    };
    for (size_t i = 0; i < sizeof shots / sizeof *shots; i++)
        check_shot(engine, &shots[i]);
}

static void check_textures(plr_engine *engine) {
#define TINTED(image)                                                                              \
    LOOKS(                                                                                         \
        "material UnlitMaterial { emissiveColor 1 0.5 0.25 } texture PixelTexture { image " image  \
        " }")
#define FACES(color)                                                                               \
    "Shape { geometry IndexedFaceSet { coordIndex [ 0 1 2 3 ] coord Coordinate { point [ -1 -1 "   \
    "0, 1 "                                                                                        \
    "-1 0, 1 1 0, -1 1 0 ] } color " color " } appearance Appearance { " WHITE " } } "
    const double g = 51.0 / 255;
    const shot shots[] = {
        {"one component multiplies", TINTED("1 1 1 0x33"), {g, g / 2, g / 4, 1}},
        {"two components: grey and alpha", TINTED("1 1 2 0x33ff"), {g, g / 2, g / 4, 1}},
        {"three components multiply", TINTED("1 1 3 0x33ff00"), {g, 0.5, 0, 1}},
        {"four components: alpha too", TINTED("1 1 4 0xffff0033"), {g, g / 2, 0, g}},
        {"a texture is lit",
         LOOKS(WHITE "texture PixelTexture { image 1 1 3 0x33ff00 }") LIGHT(""),
         {0.8 * g, 0.8, 0, 1}},
        {"texture coordinates are moved",
         LOOKS("texture PixelTexture { image 2 1 3 0xff0000 0x00ff00 } "
               "textureTransform TextureTransform { translation 0.25 0 }"),
         {0, 1, 0, 1}},
        {"texture coordinates: rotated and scaled about the centre",
         LOOKS("texture PixelTexture { image 2 1 3 0xff0000 0x00ff00 } textureTransform "
               "TextureTransform { center -0.5 -0.5 translation 0.25 0 rotation 3.14159265 }"),
         {1, 0, 0, 1}},
        {"colours at the vertices replace diffuse colour",
         FACES("Color { color [ 0 1 0.5, 0 1 0.5, 0 1 0.5, 0 1 0.5 ] }") LIGHT(""),
         {0, 0.8, 0.4, 1}},
    };
    for (size_t i = 0; i < sizeof shots / sizeof *shots; i++)
        check_shot(engine, &shots[i]);
}

static void check_plugs(plr_engine *engine) {
#define WITH(code) LOOKS(WHITE "effects " EFFECT(code)) LIGHT("")
    const shot shots[] = {
        {"fragment_eye_space changes the normal",
         WITH("void PLUG_fragment_eye_space(const vec4 v, inout vec3 n) { n = vec3(0., .6, .8); }"),
         {1, 1, 1, 1}},
        {"main_texture_apply comes before light",
         WITH("void PLUG_main_texture_apply(inout vec4 c, const in vec3 n) { c.rg = vec2(.5, n.z); "
              "}"),
         {0.4, 0.8, 0.8, 1}},
        {"texture_apply is its old name",
         WITH("void PLUG_texture_apply(inout vec4 c, const in vec3 n) { c.r = .5; }"),
         {0.4, 0.8, 0.8, 1}},
        {"material_ambient",
         WITH("void PLUG_material_ambient(inout vec3 a) { a = vec3(1.); }"),
         {0.8, 0.8, 0.8, 1}},
        {"material_specular and material_shininess",
         WITH("void PLUG_material_specular(inout vec3 s) { s.g = 1.; } "
              "void PLUG_material_shininess(inout float e) { e = 0.; }"),
         {0.8, 1.8, 0.8, 1}},
        {"material_light_ambient",
         WITH("void PLUG_material_light_ambient(inout vec3 a) { a += vec3(.1, 0., 0.); }"),
         {0.9, 0.8, 0.8, 1}},
        {"material_occlusion after light, before material_emissive",
         WITH("void PLUG_material_occlusion(inout vec4 c) { c.rgb *= .5; } "
              "void PLUG_material_emissive(inout vec3 e) { e.b += .5; }"),
         {0.4, 0.4, 0.9, 1}},
        {"light_scale of every light",
         WITH(
             "void PLUG_light_scale(inout float s, const in vec3 n, const in vec3 l) { s = l.y; }"),
         {0.48, 0.48, 0.48, 1}},
        {"light_scale of one light",
         LOOKS("material Material { diffuseColor .5 .5 .5 }") LIGHT("color 1 0 0 effects " EFFECT(
             "void PLUG_light_scale(inout float s, const in vec3 n, const in vec3 l) { s *= .5; }"))
             LIGHT("color 0 1 0"),
         {0.2, 0.4, 0, 1}},
        {"lighting_apply, fragment_modify, fog_apply and fragment_end, in this order",
         WITH("void PLUG_fragment_end(inout vec4 c) { c.b = c.g + .01; } "
              "void PLUG_fog_apply(inout vec4 c, const vec3 n) { c.g = c.r * n.z + .01; } "
              "void PLUG_fragment_modify(inout vec4 c) { c.r += .01; } "
              "void PLUG_lighting_apply(inout vec4 c, const vec4 v, const vec3 n) { c.r = -v.z; }"),
         {10.01, 10.02, 10.03, 1}},
        {"an opaque surface stays opaque",
         WITH("void PLUG_fragment_modify(inout vec4 c) { c.a = .25; }"),
         {0.8, 0.8, 0.8, 1}},
        {"texture_color of a texture's own effect",
         LOOKS("texture PixelTexture { image 1 1 3 0x33ff00 effects " EFFECT(
             "void PLUG_texture_color(inout vec4 c, const in vec4 t) { c.rg = t.st; }") "}"),
         {0.5, 0.5, 0, 1}},
        {"texture_color with the sampler",
         LOOKS("texture PixelTexture { image 1 1 3 0x33ff00 } effects " EFFECT(
             "void PLUG_texture_color(inout vec4 c, const in sampler2D texture, const in vec4 t) "
             "{ c = texture2D(texture, t.st).grba; }")),
         {1, 0.2, 0, 1}},
        {"vertex plugs: object space changes, and what eye space says arrives",
         "Shape { geometry Rectangle2D { size 0.01 0.01 } appearance Appearance { " WHITE
         "effects Effect { parts [ EffectPart { url \"data:text/plain,varying vec3 seen; "
         "void PLUG_vertex_object_space_change(inout vec4 v, inout vec3 n) { v.xy *= 200.; n = "
         "vec3(0., 1., 0.); } "
         "void PLUG_vertex_object_space(const in vec4 v, inout vec3 n) { n.z += 1.; } "
         "void PLUG_vertex_eye_space(const in vec4 v, const in vec3 n) { seen = v.xyz; } "
         "void PLUG_vertex_eye_space_extended(const in vec4 v, const in vec3 n, const in vec3 o) { "
         "seen.xy = o.yz; }\" } EffectPart { type \"FRAGMENT\" url \"data:text/plain,varying vec3 "
         "seen; void PLUG_fragment_modify(inout vec4 c) { c.rgb = seen; }\" } ] } } }",
         {1, 1, -10, 1}},
        {"a group's effect comes after the shape's",
         "Group { children [ " EFFECT("void PLUG_fragment_modify(inout vec4 c) { c.r *= .5; }")
             LOOKS(
                 "effects " EFFECT("void PLUG_fragment_modify(inout vec4 c) { c.r += .5; }")) "] }",
         {0.75, 1, 1, 1}},
    };
    for (size_t i = 0; i < sizeof shots / sizeof *shots; i++)
        check_shot(engine, &shots[i]);
}

static void check_backend(plr_backend backend, const char *name) {
    plr_diags *diags = plr_diags_create(NULL);
    plr_context *context = plr_context_create(backend, diags);
    plr_engine *engine = NULL;
    if (context)
        engine = plr_engine_create(
            &(plr_engine_desc){.get_proc_address = plr_context_get_proc_address, .user = context},
            diags);
    if (engine) {
        printf("# %s\n", plr_context_description(context));
        check_materials(engine);
        check_lights(engine);
        check_textures(engine);
        check_plugs(engine);
    } else {
        TAP_SKIP(name, "there is no such context here");
    }
    plr_engine_destroy(&engine);
    plr_context_destroy(&context);
    plr_diags_destroy(&diags);
}

int main(void) {
    check_backend(PLR_BACKEND_EGL, "EGL");
    check_backend(PLR_BACKEND_OSMESA, "OSMesa");
    return tap_done();
}
