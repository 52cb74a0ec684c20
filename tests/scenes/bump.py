#!/usr/bin/env python3
"""Normal maps and parallax against closed forms."""

import math

from harness import Suite, dot, rotate, unit
from scenes import Row, effect, effect_parts, front_scene, quad

suite = Suite()

DIRECTION = (1, -2, -4)
LIGHT = "DirectionalLight { direction 1 -2 -4 }\n"
L = unit((-1, 2, 4))
TEXEL = (204, 102, 238)  # tilted along s and against t
BUMP = unit([2 * v / 255 - 1 for v in TEXEL])
MAP = "PixelTexture { image 1 1 3 0x%02X%02X%02X }" % TEXEL
WHITE = "Material { diffuseColor 1 1 1 ambientIntensity 0 normalTexture %s }" % MAP
SQUARE = ("IndexedFaceSet { solid %s coordIndex [0 1 2 3 -1] coord Coordinate { point "
          "[-.5 -.5 0, .5 -.5 0, .5 .5 0, -.5 .5 0] } texCoord TextureCoordinate { point [ %s ] } }")
PLAIN = "0 0, 1 0, 1 1, 0 1"


def square(coords=PLAIN, solid="TRUE"):
    return SQUARE % (solid, coords)


def grey(v):
    return (v, v, v, 1)


def lambert(s=(1, 0, 0), t=(0, 1, 0), n=(0, 0, 1), bump=BUMP):
    """Where s and t grow along these directions."""
    normal = unit([bump[0] * s[i] + bump[1] * t[i] + bump[2] * n[i] for i in range(3)])
    return grey(max(dot(normal, L), 0))


def check_all(cases, tolerance=1e-3):
    row = Row(suite)
    for _, content, _ in cases:
        row.add(content)
    for (name, _, expected), got in zip(cases, row.draw()):
        suite.close(name, got, expected, tolerance)


def turned(axis, angle, content):
    return "Transform { rotation %g %g %g %g children [ %s ] }\n" % (*axis, angle, content)


@suite.case
def in_any_rotation():
    "a constant tilted normal: Lambert's cosine, however the square and its coordinates are turned"
    cases = [("plain", LIGHT + quad(WHITE, geometry=square()), lambert())]
    for axis, angle in (((0, 0, 1), 0.7), ((0, 0, 1), 3.0), ((0, 1, 0), 0.6), ((1, 0, 0), -0.5),
                        ((1, 2, 3), 0.8)):
        s, t, n = (rotate(axis, angle, v) for v in ((1, 0, 0), (0, 1, 0), (0, 0, 1)))
        cases.append((f"turned about {axis} by {angle}",
                      LIGHT + turned(axis, angle, quad(WHITE, geometry=square())), lambert(s, t, n)))
    for angle in (0.5, 2.0, 4.0):
        c, s = math.cos(angle), math.sin(angle)
        coords = ", ".join("%g %g" % (c * x + s * y, -s * x + c * y)
                           for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1)))
        cases.append((f"coordinates turned by {angle}", LIGHT + quad(WHITE, geometry=square(coords)),
                      lambert((c, s, 0), (-s, c, 0))))
    cases += [
        ("mirrored coordinates", LIGHT + quad(WHITE, geometry=square("1 0, 0 0, 0 1, 1 1")),
         lambert(s=(-1, 0, 0))),
        ("stretched coordinates", LIGHT + quad(WHITE, geometry=square("0 0, 7 0, 7 .5, 0 .5")), lambert()),
        ("a scaled shape", LIGHT + "Transform { scale 2 1 1 children [ %s ] }" % quad(WHITE, geometry=square()),
         lambert()),
        ("TextureTransform", LIGHT + quad(WHITE, geometry=square(),
                                          appearance="textureTransform TextureTransform { rotation 1.5707963 }"),
         lambert((0, -1, 0), (1, 0, 0))),
        ("no coordinates that run: the normal stays",
         LIGHT + quad(WHITE, geometry=square("0 0, 0 0, 0 0, 0 0")), lambert(bump=(0, 0, 1))),
    ]
    check_all(cases)


@suite.case
def other_materials():
    "PhysicalMaterial, normalScale, Appearance.normalMap, two sides"
    scaled = unit((2 * BUMP[0], 2 * BUMP[1], BUMP[2]))
    appearance = "normalMap " + MAP
    plain = "Material { diffuseColor 1 1 1 ambientIntensity 0 }"
    show = effect("void PLUG_lighting_apply(inout vec4 c, const vec4 v, const vec3 n)"
                  "{ c.rgb = n * 0.5 + 0.5; }")
    physical = "PhysicalMaterial { normalTexture %s }" % MAP
    straight = effect("void PLUG_surface_output(inout vec4 c) { c.rgb = pow(c.rgb, vec3(2.2)); }")
    check_all((
        ("normalScale", LIGHT + quad(WHITE.replace("normalTexture", "normalScale 2 normalTexture"),
                                     geometry=square()), lambert(bump=scaled)),
        ("normalMap", LIGHT + quad(plain, geometry=square(), appearance=appearance), lambert()),
        ("normalTexture counts before it", LIGHT + quad(
            WHITE, geometry=square(), appearance="normalMap PixelTexture { image 1 1 3 0x0000FF }"),
         lambert()),
        ("the back of a shape", LIGHT + turned((0, 1, 0), math.pi, quad(WHITE, geometry=square(solid="FALSE"))),
         lambert((-1, 0, 0), (0, 1, 0), (0, 0, 1))),
        ("PhysicalMaterial", LIGHT + quad(physical, show, geometry=square()),
         [(0.5 * v + 0.5) ** (1 / 2.2) for v in BUMP] + [1]),
    ))
    del straight


@suite.case
def with_effects():
    "authors' effects run after the normal map, and before it where they move vertices"
    flip = effect("void PLUG_fragment_eye_space(const vec4 vertex_eye, inout vec3 normal_eye)"
                  "{ normal_eye.x = -normal_eye.x; }")
    turn = effect("void PLUG_vertex_object_space_change(inout vec4 v, inout vec3 n)"
                  "{ v.xy = vec2(-v.y, v.x); }", kind="VERTEX")
    mirrored = grey(max(dot((-BUMP[0], BUMP[1], BUMP[2]), L), 0))
    check_all((
        ("after", LIGHT + quad(WHITE, flip, geometry=square()), mirrored),
        ("moved vertices", LIGHT + quad(WHITE, turn, geometry=square()),
         lambert((0, 1, 0), (-1, 0, 0))),
    ))


# ---- Parallax


def heights(pixels, width, scale):
    """A normal map that points straight up, with heights in its alpha."""
    texels = " ".join("0x8080FF%02X" % p for p in pixels)
    sampling = ('textureProperties TextureProperties { minificationFilter "NEAREST_PIXEL" '
                'magnificationFilter "NEAREST_PIXEL" }')
    return "heightMapScale %g normalMap PixelTexture { image %d 1 4 %s %s }" % (
        scale, width, texels, sampling)


SHOW = ("void PLUG_texture_color(inout vec4 color, const in vec4 tex_coord)"
        "{ color.rgb = vec3(tex_coord.st, 0.0); }\n")


@suite.case
def parallax():
    "the textures shift by the depth that the view ray runs below the surface"
    angle = 0.6
    row = Row(suite)
    scales = ((0, 0.1), (0, 0.2), (255, 0.2), (128, 0.2))
    for height, scale in scales:
        shown = quad("UnlitMaterial { }", geometry=square(), appearance="texture PixelTexture { image 1 1 3 "
                     "0xFFFFFF } " + heights([height], 1, scale),
                     effects=effect(SHOW))
        lit = shown.replace("UnlitMaterial { }", "Material { diffuseColor 1 1 1 ambientIntensity 1 }")
        row.add("DirectionalLight { intensity 0 ambientIntensity 1 }\n"
                + turned((0, 1, 0), angle, lit))
    for (height, scale), got in zip(scales, row.draw()):
        x = -0.125 / math.cos(angle)
        depth = scale * (1 - height / 255)
        # the viewer is at (-sin, 0, cos) of the square's own directions: the ray runs towards +s
        expected = (x + 0.5 + depth * math.tan(angle), 0.625, 0, 1)
        suite.close(f"height {height}, scale {scale}", got, expected, 3e-3)


@suite.case
def parallax_shadow():
    "what rises beside a hollow throws a shadow into it"
    # the left half lies low, the right half high; light comes from the right
    def drawn(direction, scale):
        text = front_scene(
            f"DirectionalLight {{ direction {direction} }}\n",
            quad("Material { diffuseColor 1 1 1 ambientIntensity 0 }", geometry="Rectangle2D { size 2 2 }",
                 appearance=heights([0, 255], 2, scale)))
        return suite.picture(text, size="32x32")

    picture = drawn("-1 0 -1", 0.25)
    lit = math.cos(math.pi / 4)
    row = [picture.at(x, 16)[0] for x in range(32)]
    suite.close("far from the step", row[4], lit, 0.02)
    suite.close("on the step", row[24], lit, 0.02)
    dark = sum(1 for v in row if v < 0.1)
    # light at 45 degrees: the shadow is as long as the step is high, 0.25 of the texture's width
    suite.check("as long as the step is high", abs(dark - 8) <= 1, row)
    suite.check("none where light falls straight", all(v > 0.9 for v in
                [drawn("0 0 -1", 0.25).at(x, 16)[0] for x in (2, 14, 17, 30)]))


@suite.case
def tangent_object_space():
    "who asks for tangents gets them along s, and the normal map follows what he makes of them"
    same = effect("void PLUG_tangent_object_space(inout vec4 tangent) { tangent.xyz *= 2.0; }", kind="VERTEX")
    turn = effect("void PLUG_tangent_object_space(inout vec4 tangent) { tangent.xyz = vec3(0, 1, 0); }", kind="VERTEX")
    mirrored = effect("void PLUG_tangent_object_space(inout vec4 tangent) { tangent.w = -tangent.w; }", kind="VERTEX")
    coords = "0 0, 0 1, -1 1, -1 0"  # s grows against y, t along x
    check_all((("kept", LIGHT + quad(WHITE, same, geometry=square()), lambert()),
               ("of turned coordinates", LIGHT + quad(WHITE, same, geometry=square(coords)), lambert((0, -1, 0), (1, 0, 0))),
               ("turned", LIGHT + quad(WHITE, turn, geometry=square()), lambert((0, 1, 0), (-1, 0, 0))),
               ("mirrored", LIGHT + quad(WHITE, mirrored, geometry=square()), lambert((1, 0, 0), (0, -1, 0)))))


@suite.case
def steep_parallax_shadow_apply():
    "the plug is called after lighting_apply, before fragment_modify"
    code = ("void PLUG_steep_parallax_shadow_apply(inout vec4 c) { c.rgb = c.bgr * 0.5; }\n"
            "void PLUG_lighting_apply(inout vec4 c, const vec4 v, const vec3 n) { c.r += 0.4; }\n"
            "void PLUG_fragment_modify(inout vec4 c) { c.g += 0.1; }")
    check_all((("", quad("UnlitMaterial { emissiveColor .2 .4 1 }", effect(code)), (0.5, 0.3, 0.3, 1)),))


suite.run()
