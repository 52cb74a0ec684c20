#!/usr/bin/env python3
"""Complete shaders and what stands around effects, in the way that content in the wild is written."""

import math

from harness import Suite
from scenes import NO_HEADLIGHT, Row, effect, front_scene, quad, scene

suite = Suite()

VERTEX = """/* PLUG-DECLARATIONS */
uniform mat4 castle_ModelViewMatrix;
uniform mat4 castle_ProjectionMatrix;
uniform mat3 castle_NormalMatrix;
attribute vec4 castle_Vertex;
attribute vec3 castle_Normal;
varying vec3 normal_eye;
void main(void)
{
  vec4 vertex_object = castle_Vertex;
  vec3 normal_object = castle_Normal;
  /* PLUG: vertex_object_space_change (vertex_object, normal_object) */
  /* PLUG: vertex_object_space (vertex_object, normal_object) */
  vec4 vertex_eye = castle_ModelViewMatrix * vertex_object;
  normal_eye = normalize(castle_NormalMatrix * normal_object);
  /* PLUG: vertex_eye_space (vertex_eye, normal_eye) */
  gl_Position = castle_ProjectionMatrix * vertex_eye;
}"""
FRAGMENT = """varying vec3 normal_eye;
/* PLUG-DECLARATIONS */
void main(void)
{
  vec4 fragment_color = vec4(1.0, 1.0, normal_eye.z, 1.0);
  /* PLUG: main_texture_apply (fragment_color, normal_eye) */
  gl_FragColor = fragment_color;
}"""
# the probed pixel of a cell: the second of four, counted from the left and from the top
AT = (1.5 / 4, 2.5 / 4)
PIXEL = "PixelTexture { image 1 1 3 0x336699 }"
COLOR = (0.2, 0.4, 0.6)


def shader(vertex=VERTEX, fragment=FRAGMENT, fields=""):
    return (f"shaders ComposedShader {{ {fields} language \"GLSL\" parts [\n"
            f"ShaderPart {{ type \"VERTEX\" url \"data:text/plain,\n{vertex}\n\" }}\n"
            f"ShaderPart {{ type \"FRAGMENT\" url \"data:text/plain,\n{fragment}\n\" }} ] }}\n")


def check_all(cases, head=""):
    """Cases: name, shape, expected red, green and blue; all in one drawing without a word."""
    row = Row(suite)
    for _, content, _ in cases:
        row.add(content)
    for (name, _, expected), got in zip(cases, row.draw(head=head)):
        suite.close(name, got, tuple(expected) + (1,))


def textured(texture, shaders, **options):
    return quad("Material { }", appearance=f"texture {texture}\n{shaders}", **options)


@suite.case
def textures_of_complete_shaders():
    "a complete shader that says in both stages where declarations go takes the shape's textures"
    shown = effect("void PLUG_texture_color(inout vec4 c, const in vec4 coord) { c = vec4(coord.stp, 1.0); }")
    tint = effect("void PLUG_texture_color(inout vec4 c, const in sampler2D texture, const in vec4 coord)\n"
                  "{ c.r = texture2D(texture, coord.st).b; }")
    old = FRAGMENT.replace("main_texture_apply", "texture_apply")
    both = FRAGMENT.replace("gl_FragColor =", "/* PLUG: texture_apply (fragment_color, normal_eye) */\n  gl_FragColor =")
    plain = [text.replace("/* PLUG-DECLARATIONS */\n", "") for text in (VERTEX, FRAGMENT)]
    transform = "textureTransform TextureTransform { translation 1 2 }\n"
    square = "coordIndex [0 1 2 3 -1] coord Coordinate { point [-.5 -.5 0, .5 -.5 0, .5 .5 0, -.5 .5 0] }"
    generated = (f"IndexedFaceSet {{ {square} texCoord TextureCoordinateGenerator {{ mode \"%s\" }} }}")
    check_all([
        ("a PixelTexture", textured(PIXEL, shader()), COLOR),
        ("at texture_apply", textured(PIXEL, shader(fragment=old)), COLOR),
        ("once, where both names are offered", textured(PIXEL, shader(fragment=both)), COLOR),
        ("none, as no stage says it", textured(PIXEL, shader(*plain)), (1, 1, 1)),
        ("none, as one stage says it not", textured(PIXEL, shader(vertex=plain[0])), (1, 1, 1)),
        ("effects on a texture", textured(f"PixelTexture {{ image 1 1 3 0x336699 effects {tint} }}", shader()),
         (0.6, 0.4, 0.6)),
        ("ShaderTexture", textured(f"ShaderTexture {{ effects {shown} }}", shader()), AT + (0,)),
        ("moved coordinates", textured(f"ShaderTexture {{ effects {shown} }}", transform + shader()),
         (AT[0] + 1, AT[1] + 2, 0)),
        ("generated coordinates", textured(f"ShaderTexture {{ effects {shown} }}", shader(),
                                           geometry=generated % "COORD"), (AT[0] - 0.5, AT[1] - 0.5, 0)),
        ("reflections", textured(f"ShaderTexture {{ effects {shown} }}", shader(),
                                 geometry=generated % "CAMERASPACENORMAL"), (0, 0, 1)),
        ("MultiTexture", textured(f"MultiTexture {{ mode [ \"MODULATE\" \"ADD\" ] texture [ {PIXEL} "
                                  "PixelTexture { image 1 1 3 0x330000 } ] }", shader()), (0.4, 0.4, 0.6)),
    ])


@suite.case
def effects_on_complete_shaders():
    "effects see the texture that a complete shader took, and move its vertices and plugs of its own"
    own = FRAGMENT.replace("gl_FragColor =", "/* PLUG: finish (fragment_color) */\n  gl_FragColor =")
    after = effect("void PLUG_main_texture_apply(inout vec4 c, const in vec3 n) { c.rgb = c.bgr * n.z; }")
    finish = effect("void PLUG_finish(inout vec4 c) { c.g += 0.25; }")
    move = effect("void PLUG_vertex_object_space_change(inout vec4 v, inout vec3 n) { v.x += 9.0; }", kind="VERTEX")
    check_all([
        ("after the texture", quad("Material { }", after + finish, f"texture {PIXEL}\n" + shader(fragment=own)),
         (0.6, 0.65, 0.2)),
        ("moved away", quad("Material { }", move, f"texture {PIXEL}\n" + shader()) +
         "Transform { translation 0 0 -1 children [\n" + quad("UnlitMaterial { emissiveColor 0 1 0 }") + "] }\n",
         (0, 1, 0)),
    ])


@suite.case
def parts_left_out():
    "without a vertex part vertices go where others go, effects move them; without a fragment part the material is seen"
    part = "ShaderPart { type \"%s\" url \"data:text/plain,\n%s\n\" }"
    only = "DEF S ComposedShader { language \"GLSL\" parts " + part + " }"
    green = only % ("FRAGMENT", "void main() { gl_FragColor = vec4(0.0, 1.0, 0.0, 1.0); }")
    move = effect("void PLUG_vertex_object_space_change(inout vec4 v, inout vec3 n) { v.x += 9.0; }", kind="VERTEX")
    check_all([
        ("green", quad("Material { }", appearance=f"shaders {green}"), (0, 1, 0)),
        ("moved away", quad("Material { }", move, "shaders USE S") + "Transform { translation 0 0 -1 children [\n" +
         quad("UnlitMaterial { emissiveColor 0 0 1 }") + "] }\n", (0, 0, 1)),
    ])
    content = quad("UnlitMaterial { emissiveColor 1 0 0 }", appearance="shaders " + only % ("VERTEX", VERTEX))
    result = suite.render(front_scene(content, "Transform { translation 9 0 0 children [\n",
                                      quad(appearance="shaders USE S"), "] }\n"), "--probe", "7,8")
    suite.close("the material", [float(w) for w in result.output.split()], (1, 0, 0, 1))
    suite.equal("one warning", [m[5] for m in result.messages()], ["not-drawn"])


@suite.case
def broken_complete_shader():
    "the material with its textures and lights takes over from a broken complete shader"
    broken = FRAGMENT.replace("gl_FragColor =", "gl_FragColor = missing *")
    content = "DirectionalLight { }\n" + textured(PIXEL, shader(fragment=broken))
    result = suite.render(front_scene(content), "--probe", "7,8", status=1)
    suite.close("texture and light", [float(w) for w in result.output.split()],
                tuple(0.8 * c for c in COLOR) + (1,))
    suite.equal("one error", [m[5] for m in result.messages()], ["glsl"])


LIGHT = ("DEF L SpotLight { location 0 4 0 direction 0 -1 0 cutOffAngle 0.8 beamWidth 0.7 "
         "projectionNear 0.5 projectionFar 10 up 0 0 -1 }\n")
SHADOW_MAP = "DEF SM GeneratedShadowMap { light USE L update \"ALWAYS\" scale 1.1 bias 4 size 128 }"


def shadowed(appearance, coordinates):
    """A floor below a box, seen from above: the colour beside the box, in its shadow, and farther off."""
    text = scene(
        "OrthoViewpoint { position 0 10 0 orientation 1 0 0 -1.57079633 fieldOfView -4 -4 4 4 }\n", NO_HEADLIGHT, LIGHT,
        f"Shape {{ appearance Appearance {{ material Material {{ diffuseColor 1 1 1 ambientIntensity 0 }} {appearance} }}\n"
        "geometry IndexedFaceSet { solid FALSE coordIndex [ 0 1 2 3 -1 ]\n"
        f"coord Coordinate {{ point [ -4 0 4, 4 0 4, 4 0 -4, -4 0 -4 ] }} texCoord {coordinates} }} }}\n",
        "Transform { translation 0 2 0 children Shape { appearance Appearance { material Material { } } "
        "geometry Box { size 1 0.2 1 } } }\n")
    result = suite.render(text, "--probe", "37,32", "--probe", "44,32", size="64x64")
    suite.equal("without a word", result.messages(), [])
    return [tuple(float(w) for w in line.split()) for line in result.output.splitlines()]


@suite.case
def shadow_map_in_a_multi_texture():
    "GeneratedShadowMap and ProjectedTextureCoordinate written out, as the second of two textures"
    got = shadowed(
        f"texture MultiTexture {{ mode [ \"MODULATE\" \"MODULATE\" ] texture [ {PIXEL} {SHADOW_MAP} ] }}",
        "MultiTextureCoordinate { texCoord [ TextureCoordinate { point [ 0 0, 1 0, 1 1, 0 1 ] } "
        "ProjectedTextureCoordinate { projector USE L } ] }")
    suite.close("in the shadow", got[0], (0, 0, 0, 1))
    cosine = 4 / math.hypot(4, 12.5 / 8, 0.0625)
    suite.close("in the light", got[1], tuple(c * cosine for c in COLOR) + (1,), 2e-3)


@suite.case
def shadow_map_of_a_complete_shader():
    "a complete shader without a place for textures reads a shadow map at projected coordinates"
    fragment = """/* PLUG-DECLARATIONS */
uniform sampler2DShadow shadowMap;
varying vec4 castle_TexCoord0;
void main(void) { gl_FragColor = vec4(shadow2DProj(shadowMap, castle_TexCoord0).rrr, 1.0); }"""
    got = shadowed(f"texture {SHADOW_MAP}\n" + shader(fragment=fragment, fields="inputOutput SFNode shadowMap USE SM"),
                   "ProjectedTextureCoordinate { projector USE L }")
    suite.close("in the shadow", got[0], (0, 0, 0, 1))
    suite.close("in the light", got[1], (1, 1, 1, 1))


@suite.case
def screen_effect():
    "a ScreenEffect is left out with one warning, the scene is drawn"
    node = ("ScreenEffect { %s shaders ComposedShader { language \"GLSL\" parts ShaderPart { type \"FRAGMENT\" "
            "url \"data:text/plain,\nvoid main(void) { gl_FragColor = screen_get_color(screen_position()); }\n\" } } }\n")
    shape = quad("UnlitMaterial { emissiveColor 0.5 0.25 0 }")
    for fields, told in (("", ["not-drawn"]), ("enabled FALSE", [])):
        result = suite.render(front_scene(node % fields, shape), "--probe", "7,8")
        suite.close("drawn", [float(w) for w in result.output.split()], (0.5, 0.25, 0, 1))
        suite.equal(fields or "enabled", [m[5] for m in result.messages()], told)


suite.run()
