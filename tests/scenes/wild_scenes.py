#!/usr/bin/env python3
"""Scenes as authors write them for effects: whole ideas - water, terrain, flowers, fog - with answers in
closed form, in the styles of several versions of the format."""

import math

from harness import Suite
from scenes import FRONT, NO_HEADLIGHT, Row, effect, effect_parts, front_scene, quad, scene

suite = Suite()

OLD = "#X3D V3.2 utf8\nPROFILE Immersive\n"
BLACK = "UnlitMaterial { emissiveColor 0 0 0 }"
LIGHT = "DirectionalLight { direction 0 0 -1 }\n"
GREEN = (0, 1, 0, 1)
SIMPLE_TEXTURE = "PixelTexture { image 1 1 3 0x%06x }"
CLOCK = ("DEF Clock TimeSensor { loop TRUE cycleInterval 10 }\n"
         "EXTERNPROTO KambiNavigationInfo [ inputOutput SFBool headlight initializeOnly SFBool timeOriginAtLoad ]\n"
         "  [ \"urn:castle-engine.sourceforge.net:node:KambiNavigationInfo\"\n"
         "    \"http://castle-engine.sourceforge.net/fallback_prototypes.wrl#KambiNavigationInfo\" ]\n"
         "KambiNavigationInfo { timeOriginAtLoad TRUE headlight FALSE }\n")


def texture_color(code, head="", fields="", sampler=""):
    """An effect on a texture; `sampler`: the type of the second parameter."""
    middle = f"const in {sampler} texture, " if sampler else ""
    return effect(f"{head}void PLUG_texture_color(inout vec4 texture_color, {middle}const in vec4 tex_coord)\n"
                  f"{{ {code} }}", f'language "GLSL" {fields}')


def silent(text, pixels, *arguments, **options):
    """Probes of a scene that must not cause a word."""
    where = [word for x, y in pixels for word in ("--probe", f"{x},{y}")]
    result = suite.render(text, *where, *arguments, **options)
    suite.equal("no messages", result.errors, "")
    return [tuple(map(float, line.split())) for line in result.output.splitlines()]


@suite.case
def terrain():
    "a landscape mixes three textures by the height that its vertices hand over"
    grid = ("ElevationGrid { xDimension 2 zDimension 2 xSpacing 1 zSpacing 1 height [ 0 1 0 1 ] solid FALSE }")
    mixing = effect_parts((
        ("VERTEX", "varying float h;\nvoid PLUG_vertex_object_space(const in vec4 vertex_object,"
                   " inout vec3 normal_object)\n{ h = vertex_object.y; }"),
        ("FRAGMENT", """
varying float h;
uniform sampler2D low, middle, high;
uniform float border;
void PLUG_texture_color(inout vec4 texture_color, const in sampler2D texture, const in vec4 tex_coord)
{
  vec4 below = texture2D(low, tex_coord.st);
  texture_color = mix(below, texture2D(middle, tex_coord.st), clamp(h / border, 0, 1));
  texture_color = mix(texture_color, texture2D(high, tex_coord.st), clamp((h - border) / border, 0, 1));
}""")), """language "GLSL" inputOutput SFNode low USE Sand
  initializeOnly SFNode middle PixelTexture { image 1 1 3 0x00ff00 }
  field SFNode high PixelTexture { image 1 1 3 0x0000ff }
  exposedField SFFloat border 0.5""")
    text = OLD + NO_HEADLIGHT + (
        "OrthoViewpoint { position 0.5 10 0.5 orientation 1 0 0 -1.5707963 fieldOfView -.5 -.5 .5 .5 }\n"
        "Shape { appearance Appearance { texture DEF Sand PixelTexture { image 1 1 3 0xff0000 } "
        f"effects {mixing} }} geometry {grid} }}\n")
    for (x, color) in zip((0, 2, 6), silent(text, [(0, 3), (2, 3), (6, 3)], size="8x8")):
        h = (x + .5) / 8 * 2
        below, above = min(h, 1), max(h - 1, 0)
        suite.close(f"column {x}", color, ((1 - below), below * (1 - above), above, 1))


@suite.case
def water():
    "normals by a plug of the water's own, reflections carried to the world by a ROUTEd matrix"
    sky = " ".join(f"{side} PixelTexture {{ image 1 1 3 0x{color:06x} }}" for side, color in (
        ("front", 0xff0000), ("back", 0x00ff00), ("left", 0x0000ff), ("right", 0xffff00),
        ("top", 0xff00ff), ("bottom", 0x00ffff)))
    base = effect("""
void PLUG_fragment_eye_space(const vec4 vertex_eye, inout vec3 normal_eye)
{
  vec3 n = vec3(0, 0, 1);
  /* PLUG: water_normal (n, vertex_eye.xy) */
  normal_eye = normalize(castle_NormalMatrix * n);
}""".replace("\nvoid", "\nuniform mat3 castle_NormalMatrix;\nvoid", 1))
    waves = effect("uniform vec3 tilt;\nvoid PLUG_water_normal(inout vec3 n, const in vec2 st) { n = tilt; }",
                   "inputOutput SFVec3f tilt %s")
    mirror = effect_parts((
        ("VERTEX", "varying vec3 place;\nvoid PLUG_vertex_eye_space(const in vec4 vertex_eye, const in vec3 normal_eye)"
                   " { place = vertex_eye.xyz; }"),
        ("FRAGMENT", """
varying vec3 place;
uniform samplerCube sky;
uniform highp mat3 to_world;
void PLUG_main_texture_apply(inout vec4 fragment_color, const in vec3 normal_eye)
{
  fragment_color.rgb = textureCube(sky, to_world * reflect(normalize(place), normal_eye)).rgb;
}""")), f"initializeOnly SFNode sky ComposedCubeMapTexture {{ {sky} }}\n"
        "inputOutput SFMatrix3f to_world 1 0 0 0 1 0 0 0 1", head="DEF Mirror")
    # The viewer stands at +X and looks to -X; the surface looks to +X.
    for name, tilt, expected in (("back to the right", "0 0 1", (1, 1, 0)), ("to the top", "0 1 1", (1, 0, 1)),
                                 ("to the left of the viewer", "1 0 1", (1, 0, 0))):
        text = OLD + NO_HEADLIGHT + (
            "DEF View Viewpoint { position 5 0 0 orientation 0 1 0 1.5707963 }\n"
            "Transform { rotation 0 1 0 1.5707963 children ["
            f"{quad('UnlitMaterial { }', base + waves % tilt + mirror)}] }}\n"
            "ROUTE View.cameraRotationInverseMatrix TO Mirror.to_world\n")
        suite.close(name, silent(text, [(0, 0)], size="1x1")[0], (*expected, 1), 1e-3)


@suite.case
def flowers():
    "an effect of a group bends what USE repeats, by the clock; each in its own coordinates"
    text = OLD + CLOCK + FRONT + (
        "Group { children [ DEF Wind Effect { language \"GLSL\" inputOutput SFTime time 0 parts EffectPart { type \"VERTEX\" "
        "url \"data:text/plain,uniform float time;\n"
        "void PLUG_vertex_object_space_change(inout vec4 vertex_object, inout vec3 normal_object)\n"
        "{ vertex_object.x += time * vertex_object.y; }\" } }\n"
        "Transform { translation -.5 -1 0 children DEF Stalk Shape { appearance Appearance { } geometry IndexedFaceSet {"
        " coordIndex [0 1 2 3 -1] coord Coordinate { point [-.125 0 0, .125 0 0, .125 2 0, -.125 2 0] } } } }\n"
        "Transform { translation .25 -1 0 children USE Stalk } ] }\n"
        "ROUTE Clock.elapsedTime TO Wind.time\n")
    for time in (0, 0.25):
        top = [p[0] for p in silent(text, [(x, 0) for x in range(16)], "--time", time)]
        shift = round(8 * time * 2 * 31 / 32)
        wanted = [1.0 if any(0 <= x - (8 + at * 8 - 1) - shift < 2 for at in (-.5, .25)) else 0.0 for x in range(16)]
        suite.equal(f"the top row after {time} seconds", top, wanted)


@suite.case
def fog():
    "fog of a density in space: one effect at the top level, matrices by ROUTE, a sum along the view"
    thick = effect_parts((
        ("VERTEX", "varying vec3 world;\nuniform mat4 camera_inverse;\n"
                   "void PLUG_vertex_eye_space(const in vec4 vertex_eye, const in vec3 normal_eye)\n"
                   "{ world = (camera_inverse * vertex_eye).xyz; }"),
        ("FRAGMENT", """
varying vec3 world;
uniform mat4 camera_inverse;
uniform sampler3D noise;
uniform float time, density;
#define STEPS 8
void PLUG_fog_apply(inout vec4 fragment_color, const vec3 normal_eye_fragment)
{
  vec3 eye = vec3(camera_inverse * vec4(0, 0, 0, 1)), way = (world - eye) / float(STEPS), p = eye;
  float sum = 0.0;
  for (int i = 0; i < STEPS; i++) {
    sum += texture3D(noise, p * 0.125 + vec3(time, 0.0, 0.0)).r;
    p += way;
  }
  fragment_color.rgb = mix(fragment_color.rgb, vec3(0.0, 0.0, 1.0), 1.0 - exp(-sum * length(way) * density));
}""")), "initializeOnly SFNode noise PixelTexture3D { repeatS TRUE repeatT TRUE repeatR TRUE image [ 1 1 1 1 128 ] }\n"
        "inputOutput SFTime time 0 inputOutput SFMatrix4f camera_inverse 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1\n"
        "initializeOnly SFFloat density 0.2", head="DEF Fog")
    text = OLD + CLOCK + (
        "DEF View Viewpoint { position 3 2 4 orientation 0 1 0 0 }\n" + thick +
        "Transform { translation 3 2 -1 scale 4 4 1 children [" + quad("UnlitMaterial { emissiveColor 1 0 0 }") + "] }\n"
        "ROUTE Clock.elapsedTime TO Fog.time\nROUTE View.cameraInverseMatrix TO Fog.camera_inverse\n")
    left = math.exp(-128 / 255 * 5 * 0.2)
    suite.close("five metres away", silent(text, [(0, 0)], "--time", "0.3", size="1x1")[0], (left, 0, 1 - left, 1), 1e-3)


@suite.case
def toon_and_rim():
    "two effects shared by DEF and USE, alone and together, from files among urls that are missing"
    files = {
        "toon.fs": "/* see PLUG_fog_apply (...) of the other */\n"
                   "void PLUG_light_scale(inout float scale, const in vec3 normal_eye, const in vec3 light_dir)\n"
                   "{ if (dot(normal_eye, light_dir) > 0.5) scale *= 0.5; }\n",
        "rim.vs": "varying vec3 place;\r\nvoid PLUG_vertex_eye_space (const in vec4 vertex_eye, const in vec3 normal_eye)\r\n"
                  "{\r\n  place = vec3(vertex_eye);\r\n}\r\n",
        "rim.fs": "\xef\xbb\xbfvarying vec3 place;\nuniform float strength;\n"
                  "void PLUG_fog_apply(inout vec4 fragment_color, const vec3 n)\n"
                  "{ fragment_color.b += (place.z < 0.0 ? 1 : 0) * strength; }".encode("latin-1"),
    }
    toon = 'Effect { language "GLSL" parts EffectPart { type "FRAGMENT" url "toon.fs" } }'
    rim = ('Effect { language "GLSL" initializeOnly SFFloat strength 0.25 parts [ '
           'EffectPart { type "VERTEX" url [ "none.vs" "rim.vs" ] } EffectPart { type "FRAGMENT" url "rim.fs" } ] }')
    material = "Material { diffuseColor 1 0 0 }"
    row = Row(suite)
    for effects in (f"DEF Toon {toon} DEF Rim {rim}", "USE Toon", "USE Rim"):
        row.add(quad(material, effects))
    colors = row.draw(head=LIGHT.replace("0 0 -1", "0 0 -1 global TRUE"), files=files)
    for name, got, expected in zip(("both", "toon", "rim"), colors, ((.5, 0, .25), (.5, 0, 0), (1, 0, .25))):
        suite.close(name, got, (*expected, 1))


@suite.case
def spot_shapes():
    "an effect of a spot light cuts its cone, by the light's own axis and by an image"
    star = effect("""
uniform vec3 castle_LightSource0SpotDirection;
void PLUG_light_scale(inout float scale, const in vec3 normal_eye, const in vec3 light_dir)
{
  vec3 axis = normalize(castle_LightSource0SpotDirection), side = -light_dir - axis * dot(-light_dir, axis);
  scale *= step(side.x, 0.0);
}""")
    image = effect_parts((
        ("VERTEX", "varying vec2 st;\nvoid PLUG_vertex_object_space(const vec4 vertex_object, inout vec3 normal_object)"
                   " { st = vertex_object.xy + vec2(0.5); }"),
        ("FRAGMENT", "varying vec2 st;\nuniform sampler2D shape;\nvoid PLUG_light_scale(inout float scale, const in vec3 n,"
                     " const in vec3 l) { scale *= texture2D(shape, st).r; }")),
        "initializeOnly SFNode shape PixelTexture { repeatS FALSE image 2 1 1 0xff 0 textureProperties TextureProperties "
        "{ magnificationFilter \"NEAREST_PIXEL\" minificationFilter \"NEAREST_PIXEL\" } }")
    for name, code in (("by its axis", star), ("by an image", image)):
        text = OLD + NO_HEADLIGHT + FRONT + (
            f"SpotLight {{ location 0 0 100 direction 0 0 -1 radius 1000 effects {code} }}\n"
            + quad("Material { diffuseColor 0 1 0 }"))
        left, right = silent(text, [(6, 8), (9, 8)])
        suite.close(name + ": lit", left, GREEN, 1e-3)
        suite.close(name + ": dark", right, (0, 0, 0, 1))


@suite.case
def textures_of_all_kinds():
    "texture_color on each node, a parameter called texture, and on ShaderTexture with its own textures"
    green = lambda kind, call: texture_color(f"texture_color.rgb = {call}.grb;", sampler=kind)
    flat = green("sampler2D", "texture2D(texture, tex_coord.st)")
    red = SIMPLE_TEXTURE % 0xff0000
    with_effect = lambda node, code: node.replace("{", f"{{ effects {code} ", 1)
    faces = " ".join(f"{s} {red}" for s in ("front", "back", "left", "right", "top", "bottom"))
    edge = texture_color("""
  vec2 d = vec2(0.25, 0.0);
  texture_color = vec4(0, abs(value(tex_coord.st + d) - value(tex_coord.st - d)), 0, 1);""",
                         "uniform sampler2D source;\nfloat value(const in vec2 st) { return texture2D(source, st).r; }\n",
                         "initializeOnly SFNode source PixelTexture { repeatS FALSE image 2 1 1 0 0xff }")
    cases = (
        ("PixelTexture", with_effect(red, flat)),
        ("PixelTexture3D", with_effect("PixelTexture3D { image [ 3 1 1 1 0xff0000 ] }",
                                       green("sampler3D", "texture3D(texture, tex_coord.stp)"))),
        ("ComposedCubeMapTexture", with_effect(f"ComposedCubeMapTexture {{ {faces} }}",
                                               green("samplerCube", "textureCube(texture, tex_coord.xyz)"))),
        ("MultiTexture", f"MultiTexture {{ texture [ {with_effect(red, flat)} ShaderTexture {{ effects "
                         f"{texture_color('texture_color = vec4(1);')} }} ] }}"),
        ("ShaderTexture", f"ShaderTexture {{ effects [ {texture_color('texture_color = vec4(0, tex_coord.p, 0, 1);')}"
                          f"{texture_color('texture_color.g += 1;')} ] }}"),
    )
    row = Row(suite)
    for _, texture in cases:
        row.add(quad("UnlitMaterial { }", appearance=f"texture {texture}"))
    for (name, _), got in zip(cases, row.draw()):
        suite.close(name, got, GREEN)
    text = front_scene(quad("UnlitMaterial { }", appearance=f"texture ShaderTexture {{ effects {edge} }}"))
    middle, border = silent(text, [(8, 8), (4, 8)])
    suite.close("the edge of another image", (middle[1], border[1]), (1, 0), 0.3)


@suite.case
def arrays_of_textures():
    "an MFNode is an array of samplers: four pictures of a film, mixed by the clock"
    film = " ".join(SIMPLE_TEXTURE % color for color in (0xff0000, 0x00ff00, 0x0000ff, 0xffffff))
    text = OLD + CLOCK + FRONT + quad(BLACK, effect("""
uniform sampler2D pictures[4];
uniform float time;
vec3 picture(const in vec2 st)
{
  float phase = mod(time, 4);
  if (phase < 1.0) return mix(texture2D(pictures[0], st), texture2D(pictures[1], st), phase).rgb;
  if (phase < 2.0) return mix(texture2D(pictures[1], st), texture2D(pictures[2], st), phase - 1).rgb;
  return mix(texture2D(pictures[2], st), texture2D(pictures[3], st), phase - 2).rgb;
}
void PLUG_fragment_modify(inout vec4 fragment_color) { fragment_color.rgb = picture(vec2(0.5)); }""",
        f"initializeOnly MFNode pictures [ {film} ] inputOutput SFTime time 0", head="DEF Film")) + \
        "ROUTE Clock.elapsedTime TO Film.time\n"
    for time, expected in ((0, (1, 0, 0)), (0.5, (.5, .5, 0)), (1.25, (0, .75, .25)), (2.5, (.5, .5, 1))):
        suite.close(f"after {time} seconds", silent(text, [(0, 0)], "--time", time, size="1x1")[0], (*expected, 1), 1e-3)


@suite.case
def cells():
    "a texture of cells: array constructors, whole numbers, a search among points"
    text = front_scene(quad("UnlitMaterial { }", appearance="texture ShaderTexture { effects " + texture_color("""
  float nearest = 100;
  int which = 0;
  for (int i = 0; i < COUNT; i++) {
    float d = distance(points[i], tex_coord.st);
    if (d < nearest) { nearest = d; which = i; }
  }
  texture_color = vec4(colors[which], 1);""", """
#define COUNT 3
const vec2 points[COUNT] = vec2[COUNT](vec2(0, 0), vec2(1, 0), vec2(0.5, 1));
vec3 colors[] = vec3[](vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1));
""") + "}"))
    for got, expected in zip(silent(text, [(5, 11), (10, 11), (8, 4)]), ((1, 0, 0), (0, 1, 0), (0, 0, 1))):
        suite.close("", got, (*expected, 1))


@suite.case
def prototypes():
    "effects, parts, textures and whole shapes as prototypes, in the file and in another"
    modify = "void PLUG_fragment_modify(inout vec4 fragment_color)"
    library = OLD + "PROTO Unused [ ] { Group { } }\nPROTO Green [ inputOutput SFFloat amount 0 ] { " + effect(
        "uniform float amount;\n" + modify + "{ fragment_color.g = amount; }", "inputOutput SFFloat amount IS amount") + " }\n"
    head = (
        'EXTERNPROTO Green [ inputOutput SFFloat amount ] [ "none.x3dv#Green" "library.x3dv#Green" ]\n'
        'PROTO Part [ initializeOnly MFString code "data:text/plain,' + modify + '{ fragment_color.g = 1.0; }" ]\n'
        '{ EffectPart { type "FRAGMENT" url IS code } }\n'
        "PROTO Stripes [ inputOutput SFFloat scale 1 initializeOnly SFString bounds \"BOUNDS2D\" ] { ShaderTexture {"
        " defaultTexCoord IS bounds effects " + texture_color("texture_color = vec4(0, step(0.5, fract(tex_coord.s * scale)), 0, 1);",
        "uniform float scale;\n", "inputOutput SFFloat scale IS scale") + " } }\n"
        "PROTO Thing [ inputOutput MFNode looks [ ] ] { Shape { appearance Appearance { material " + BLACK +
        " effects IS looks } geometry Box { size 1 1 1 } } }\n")
    cases = (("an effect from another file", quad(BLACK, "Green { amount 1 }")),
             ("a part", quad(BLACK, 'Effect { language "GLSL" parts Part { } }')),
             ("a texture", quad("UnlitMaterial { }", appearance="texture Stripes { scale 2 }")),
             ("a list of effects", "Thing { looks [ Green { amount 0.5 } Green { amount 1 } ] }"))
    row = Row(suite)
    for _, content in cases:
        row.add(content)
    for (name, _), got in zip(cases, row.draw(head=head, files={"library.x3dv": library})):
        suite.close(name, got, GREEN)


@suite.case
def backgrounds():
    "effects of a background change its colour, and of the background alone"
    shape = "Transform { translation 0 0 -1 children [" + quad("UnlitMaterial { emissiveColor 1 0 0 }") + "] }"
    by_view = effect("void PLUG_lighting_apply(inout vec4 color, const vec4 vertex_eye, const vec3 normal_eye)\n"
                     "{ color.b = dot(normalize(vertex_eye.xyz), -normal_eye); }")
    both = effect("void PLUG_main_texture_apply(inout vec4 color, const in vec3 normal_eye) { color.r = 0.25; }")
    later = effect("uniform float k;\nvoid PLUG_fragment_modify(inout vec4 color) { color.r += k; }", "inputOutput SFFloat k 0.5")
    for name, node in (("Background", "Background { skyColor 1 0.5 0"),
                       ("TextureBackground", "TextureBackground { skyColor 0 0 0 frontTexture ShaderTexture { effects "
                        + texture_color("texture_color = vec4(1, 0.5, 0, 1);") + " }")):
        text = scene("Viewpoint { position 0 0 3 }\n", NO_HEADLIGHT, f"{node} effects [ {by_view} {both} {later} ] }}\n", shape)
        behind, front = silent(text, [(0, 0), (8, 8)])
        suite.close(f"{name}: behind", behind, (0.75, 0.5, 1, 1))
        suite.close(f"{name}: the shape", front, (1, 0, 0, 1))


@suite.case
def passes():
    "a picture of the scene becomes a texture whose effect reads beside the place"
    inner = "Group { children [ Background { skyColor 0 0 1 } " + quad(
        "UnlitMaterial { emissiveColor 1 0 0 }", effect("void PLUG_fragment_modify(inout vec4 c) { c.rg = c.gr; }")) + "] }"
    blur = texture_color("texture_color = (texture2D(texture, tex_coord.st + vec2(0.5, 0)) + "
                         "texture2D(texture, tex_coord.st)) / 2;", sampler="sampler2D")
    texture = (f'RenderedTexture {{ repeatS FALSE dimensions [ 64 64 ] update "ALWAYS" viewpoint '
               f"OrthoViewpoint {{ position 0 0 3 fieldOfView -1 -1 1 1 }} scene {inner} effects {blur} }}")
    text = front_scene(quad("UnlitMaterial { }", appearance=f"texture {texture}"))
    middle, edge = silent(text, [(7, 8), (11, 8)])
    suite.close("half of each", middle, (0, .5, .5, 1))
    suite.close("beside it", edge, (0, 0, 1, 1))


@suite.case
def driven():
    "what interpolators, sensors and viewpoints give reaches uniforms; devices and scripts do no harm"
    show = effect("""
uniform float amount, since; uniform vec3 place, tint, viewer; uniform mat4 camera;
void PLUG_fragment_modify(inout vec4 c)
{ c.rgb = vec3(amount + since, place.y * tint.g, viewer.z == -camera[3].z ? 1 : 0); }""",
                  "inputOutput SFFloat amount 0 inputOutput SFTime since 0 inputOutput SFVec3f place 0 0 0\n"
                  "exposedField SFColor tint 0 0 0 inputOutput SFVec3f viewer 0 0 0\n"
                  "inputOutput SFMatrix4f camera 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1", head="DEF Show")
    text = OLD + CLOCK + (
        "DEF View Viewpoint { position 0 0 2 }\nDEF Near ProximitySensor { size 1000 1000 1000 }\n"
        "DEF Since TimeSensor { loop TRUE cycleInterval 1000 }\nDEF Keys KeySensor { }\nDEF Touch TouchSensor { }\n"
        "DEF Number ScalarInterpolator { key [ 0 0.5 1 ] keyValue [ 0 0.5 0 ] }\n"
        "DEF Place PositionInterpolator { key [ 0 1 ] keyValue [ 0 0 0, 0 1 0 ] }\n"
        "DEF Tint ColorInterpolator { key [ 0 1 ] keyValue [ 0 1 0, 0 1 0 ] }\n"
        "DEF Toggle BooleanToggle { }\n" + quad(BLACK, show) + "".join(f"ROUTE {a} TO {b}\n" for a, b in (
            ("Clock.fraction_changed", "Number.set_fraction"), ("Number.value_changed", "Show.amount"),
            ("Clock.fraction_changed", "Place.set_fraction"), ("Place.value_changed", "Show.set_place"),
            ("Clock.fraction_changed", "Tint.set_fraction"), ("Tint.value_changed", "Show.tint"),
            ("Near.enterTime", "Since.startTime"), ("Since.elapsedTime", "Show.since"),
            ("Near.position_changed", "Show.viewer"), ("View.cameraMatrix", "Show.camera"),
            ("Touch.isActive", "Toggle.set_boolean"))))
    for time in (0, 0.25):
        suite.close(f"after {time} seconds", silent(text, [(0, 0)], "--time", time, size="1x1")[0],
                    (time / 10 + time, time / 10, 1, 1))


@suite.case
def own_names():
    "names of an author that plugray, its library or a later GLSL have too"
    cases = (
        ("float round(float x) { return 0.5; }\nmat3 transpose(mat3 m) { return m; }\n", "vec3(0, 2.0 * round(0.1), 0)"),
        ("vec3 luminance = vec3(0, 1, 0);\nfloat unit_or_zero(float x) { return x; }\n", "luminance * unit_or_zero(1.0)"),
        ("struct MaterialInfo { float a; };\nMaterialInfo surface_normal_eye = MaterialInfo(1.0);\n",
         "vec3(0, surface_normal_eye.a, 0)"),
        ("float sample(float filter) { return filter; }\n", "vec3(0, sample(1.0), 0)"),
        ("float myPLUG_x(float a) { return a; }\n#define MY(name) float name = 1.0\nMY(common);\n", "vec3(0, myPLUG_x(common), 0)"))
    row = Row(suite)
    for head, value in cases:
        row.add(quad(BLACK, effect(f"{head}void PLUG_fragment_modify(inout vec4 color) {{ color.rgb = {value}; }}")))
    for (head, _), got in zip(cases, row.draw()):
        suite.close(head.split("\n")[0], got, GREEN)


@suite.case
def xml():
    "the XML encoding of version 3.2: CDATA, fields with nodes, an instance of a prototype among effects"
    text = """<?xml version="1.0" encoding="UTF-8"?>
<!DOCTYPE X3D PUBLIC "ISO//Web3D//DTD X3D 3.2//EN" "http://www.web3d.org/specifications/x3d-3.2.dtd">
<X3D version="3.2" profile="Immersive"><head><component name="Shaders" level="1"/></head>
<Scene>
<ProtoDeclare name="Tint"><ProtoInterface><field name="tint" type="SFColor" accessType="inputOutput" value="1 1 1"/>
</ProtoInterface><ProtoBody><Effect language="GLSL"><field name="tint" type="SFColor" accessType="inputOutput"/>
<IS><connect nodeField="tint" protoField="tint"/></IS><EffectPart type="FRAGMENT"><![CDATA[data:text/plain,
uniform vec3 tint;
void PLUG_main_texture_apply(inout vec4 fragment_color, const in vec3 normal_eye)
{ if (1 < 2 && 2 > 1) fragment_color.rgb *= tint; }]]></EffectPart></Effect></ProtoBody></ProtoDeclare>
<NavigationInfo headlight="false"/><OrthoViewpoint fieldOfView="-1 -1 1 1"/>
<Group><Effect language="GLSL"><field name="other" type="SFNode" accessType="initializeOnly">
<PixelTexture image="1 1 3 0x000080"/></field><EffectPart type="FRAGMENT" url='"none.fs" "add.fs"'/></Effect>
<Shape><Appearance><Material diffuseColor="0 0 0" emissiveColor="0 0 0"/><ShaderTexture><Effect language="GLSL"
containerField="effects"><EffectPart type="FRAGMENT"><![CDATA[data:text/plain,
void PLUG_texture_color(inout vec4 c, const in vec4 tex_coord) { c = vec4(1.0); }
void PLUG_lighting_apply(inout vec4 c, const vec4 v, const vec3 n) { c.r = 0.25; }]]></EffectPart></Effect></ShaderTexture>
<ProtoInstance name="Tint" containerField="effects"><fieldValue name="tint" value="1 0.5 0"/></ProtoInstance></Appearance>
<Box size="1 1 1"/></Shape></Group>
</Scene></X3D>"""
    add = ("uniform sampler2D other;\nvoid PLUG_fragment_modify(inout vec4 fragment_color)\n"
           "{ fragment_color += texture2D(other, vec2(0.5)); }\n")
    got = silent(text, [(8, 8)], files={"add.fs": add})[0]
    suite.close("", got, (0.25, 0, 128 / 255, 1))


suite.run()
