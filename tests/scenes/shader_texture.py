#!/usr/bin/env python3
"""ShaderTexture: a texture that effects make, alone and beside textures of images."""

from harness import Suite
from scenes import Row, effect, front_scene, quad

suite = Suite()

X, Y = -0.125, 0.125  # probed in a quad of Row
S, T = 0.375, 0.625
WHITE = "UnlitMaterial { }"
PINK = (1, 0, 1, 1)
COORDINATES = effect("void PLUG_texture_color(inout vec4 texture_color, const in vec4 tex_coord)"
                     "{ texture_color.rgb = tex_coord.stp; }")
SAMPLED = effect("void PLUG_texture_color(inout vec4 texture_color, const in sampler2D tex,"
                 " const in vec4 tex_coord) { texture_color.rgb = texture2D(tex, tex_coord.st).bgr; }")
IMAGE = "PixelTexture { repeatS FALSE repeatT FALSE image 1 1 3 0x3366CC }"


def made(effects="", fields=""):
    return f"ShaderTexture {{ {fields} effects [ {effects} ] }}"


def check_all(cases):
    row = Row(suite)
    for _, content, _ in cases:
        row.add(content)
    for (name, _, expected), got in zip(cases, row.draw()):
        suite.close(name, got, tuple(expected) + (1,) * (4 - len(expected)), 2e-3)


@suite.case
def pink():
    "it is pink until an effect says otherwise, and mixed as any texture"
    check_all((
        ("alone", quad(WHITE, appearance="texture " + made()), PINK),
        ("times the material", quad("UnlitMaterial { emissiveColor .5 1 .25 }",
                                    appearance="texture " + made()), (0.5, 0, 0.25)),
        ("two effects, in order", quad(WHITE, appearance="texture " + made(
            effect("void PLUG_texture_color(inout vec4 c, const in vec4 t) { c = vec4(t.st, 0.25, 1.0); }")
            + effect("void PLUG_texture_color(inout vec4 c, const in vec4 t) { c.rgb = c.bgr; }"))),
         (0.25, T, S)),
        ("over an image", quad(WHITE, appearance="texture MultiTexture { mode [ \"REPLACE\" \"ADD\" ] "
                               f"texture [ {IMAGE} {made()} ] }}"), (1.2, 0.4, 1.8)),
        ("as a diffuse texture", "DirectionalLight { direction 0 0 -1 }\n" + quad(
            f"Material {{ ambientIntensity 0 diffuseColor 1 1 1 diffuseTexture {made(COORDINATES)} }}"),
         (S, T, 0)),
    ))


@suite.case
def default_coordinates():
    "BOUNDS2D is the geometry's own mapping, BOUNDS3D its bounding box"
    box = "Box { size 1 1 1 }"
    flat = ("IndexedFaceSet { coordIndex [0 1 2 3 -1] coord Coordinate { point "
            "[-.5 -.25 0, .5 -.25 0, .5 .25 0, -.5 .25 0] } }")
    turned = "Transform { rotation 0 1 0 3.14159265 children [ %s ] }\n"
    space = 'defaultTexCoord "BOUNDS3D"'
    check_all((
        ("BOUNDS2D, a box", quad(WHITE, appearance="texture " + made(COORDINATES), geometry=box), (S, T, 0)),
        ("BOUNDS2D, faces: the longest side", quad(WHITE, appearance="texture " + made(COORDINATES),
                                                  geometry=flat), (S, Y + 0.25, 0)),
        ("BOUNDS3D, in front", quad(WHITE, appearance="texture " + made(COORDINATES, space), geometry=box),
         (S, T, 0)),
        ("BOUNDS3D, behind", turned % quad(WHITE, appearance="texture " + made(COORDINATES, space),
                                           geometry=box), (1 - S, T, 1)),
        ("BOUNDS3D, two sides", quad(WHITE, appearance="texture " + made(COORDINATES, space),
                                     geometry=flat), (S, 0.5 + Y / 0.5, 0)),
        ("given ones stand", quad(WHITE, appearance="texture " + made(COORDINATES, space)), (S, T, 0)),
        ("transformed", quad(WHITE, appearance="texture " + made(COORDINATES, space)
                             + " textureTransform TextureTransform3D { translation .1 .2 .3 }", geometry=box),
         (S + 0.1, T + 0.2, 0.3)),
        ("generated", quad(WHITE, appearance="texture " + made(COORDINATES), geometry=flat.replace(
            "coordIndex", "texCoord TextureCoordinateGenerator { mode \"COORD\" } coordIndex", 1)),
         (X, Y, 0)),
    ))


@suite.case
def beside_images():
    "an effect of the shape with a sampler reaches the images, one without reaches all; in silence"
    multi = f"texture MultiTexture {{ mode [ \"REPLACE\" \"ADD\" ] texture [ {IMAGE} {made()} ] }}"
    row = Row(suite)
    row.add(quad(WHITE, SAMPLED, multi))
    row.add(quad(WHITE, COORDINATES, multi))
    got = row.draw()
    suite.close("with", got[0], (1.8, 0.4, 1.2, 1), 2e-3)
    suite.close("without", got[1], (2 * S, 2 * T, 0, 1), 2e-3)
    result = suite.render(front_scene(quad(WHITE, SAMPLED, multi)), "--probe", "8,8")
    suite.check("not a word", not result.messages(), result.errors)


@suite.case
def sampler_without_texture():
    "an effect on a ShaderTexture that wants a sampler is an error where it stands; the rest is drawn"
    text = front_scene(quad(WHITE, appearance="texture " + made(SAMPLED)))
    result = suite.render(text, "--probe", "8,8", status=1)
    suite.close("pink", [float(w) for w in result.output.split()], PINK)
    line = next(i for i, l in enumerate(text.splitlines(), 1) if "PLUG_texture_color" in l)
    suite.check("its line", [m for m in result.with_code("plug-arity") if m[1] == line], result.errors)


@suite.case
def uniforms():
    "fields of an effect on a ShaderTexture, among them other textures"
    code = effect("uniform sampler2D image;\nuniform vec3 tint;\n"
                  "void PLUG_texture_color(inout vec4 c, const in vec4 t)"
                  "{ c.rgb = texture2D(image, t.st).rgb * tint; }",
                  f"inputOutput SFNode image {IMAGE} inputOutput SFVec3f tint 1 .5 .25")
    check_all((("", quad(WHITE, appearance="texture " + made(code)), (0.2, 0.2, 0.2)),))


suite.run()
