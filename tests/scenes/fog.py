#!/usr/bin/env python3
"""Fog, LocalFog, FogCoordinate and ClipPlane against ISO/IEC 19775-1 24.2 and 11.4.1."""

import math

from harness import HEADER, Suite
from scenes import NO_HEADLIGHT, Row, effect, front_scene, quad, scene

suite = Suite()

GREEN = "UnlitMaterial { emissiveColor 0 1 0 }"


def linear(d, reach):
    return max(0, (reach - d) / reach)


def exponential(d, reach):
    return math.exp(-d / (reach - d)) if d < reach else 0


def fogged(interpolant, alpha=1.0):
    """Green in red fog."""
    return ((1 - interpolant) * alpha, interpolant * alpha, 0, alpha)


def check_all(cases, head="", **options):
    row = Row(suite)
    for _, content, _ in cases:
        row.add(content)
    for (name, _, expected), got in zip(cases, row.draw(head=head, **options)):
        suite.close(name, got, expected)


def perspective(fog, shape=None, at=(0, 0)):
    """The pixel straight ahead, the shape four before the viewer."""
    text = scene(NO_HEADLIGHT, "Viewpoint { position 0 0 4 fieldOfView 1.5707963 }\n", fog,
                 shape or quad(GREEN, geometry="Rectangle2D { size 40 40 }"))
    return suite.probe(text, [at], size="9x9")[0]


@suite.case
def fog():
    "linear and exponential by the distance from the viewer"
    middle = (4, 4)
    for kind, function in (("LINEAR", linear), ("EXPONENTIAL", exponential)):
        for reach in (5, 8, 3):
            suite.close(f"{kind}, visible to {reach}",
                        perspective(f'Fog {{ fogType "{kind}" visibilityRange {reach} color 1 0 0 }}',
                                    at=middle), fogged(function(4, reach)))
    corner = 4 * math.sqrt(1 + 2 * (8 / 9) ** 2)
    suite.close("the distance, not the depth", perspective("Fog { visibilityRange 10 color 1 0 0 }"),
                fogged(linear(corner, 10)))
    suite.close("range 0: no fog", perspective("Fog { color 1 0 0 }", at=middle), (0, 1, 0, 1))
    suite.close("the first fog is bound", perspective(
        "Fog { visibilityRange 8 color 1 0 0 }\nFog { visibilityRange 1 color 0 0 1 }", at=middle),
        fogged(0.5))
    suite.close("in the fog's own lengths", perspective(
        "Transform { scale 2 2 2 children Fog { visibilityRange 4 color 1 0 0 } }", at=middle),
        fogged(0.5))


@suite.case
def what_is_fogged():
    "lit and transparent surfaces; not the background, nor what is immune"
    middle = (4, 4)
    fog = "Fog { visibilityRange 8 color 1 0 0 }\n"
    shape = quad("UnlitMaterial { emissiveColor 0 1 0 transparency .5 }",
                 geometry="Rectangle2D { size 40 40 }")
    suite.close("transparent: its colour alone", perspective(fog, shape, middle), fogged(0.5, 0.5))
    shape = quad("Material { emissiveColor 0 1 0 fogImmune TRUE }", geometry="Rectangle2D { size 40 40 }")
    suite.close("fogImmune", perspective(fog, shape, middle), (0, 1, 0, 1))
    suite.close("the background", perspective(fog + "Background { skyColor 0 0 1 }\n", " ", middle),
                (0, 0, 1, 1))
    modify = effect("void PLUG_fragment_modify(inout vec4 c) { c.rgb = c.bgr + vec3(0.0, 0.0, 0.5); }\n"
                    "void PLUG_fog_apply(inout vec4 c, const vec3 n) { c.rgb *= 0.5; }")
    shape = quad(GREEN, modify, geometry="Rectangle2D { size 40 40 }")
    suite.close("between fragment_modify and the author's fog_apply", perspective(fog, shape, middle),
                (0.25, 0.25, 0.125, 1))
    replace = effect("void PLUG_fog_apply(inout vec4 c, const vec3 n) { c.b = 1.0; }",
                     fields='placement "REPLACE" target "Fog"')
    shape = quad(GREEN, replace, geometry="Rectangle2D { size 40 40 }")
    suite.close("an author's fog in place of Fog", perspective(fog, shape, middle), (0, 1, 1, 1))


@suite.case
def local_fog():
    "LocalFog: the nearest one around a shape, in place of the scene's"
    far = "Fog { visibilityRange 20 color 0 0 1 }\n"
    fog = "LocalFog { visibilityRange %s color 1 0 0 %s }\n"
    d = math.hypot(10, -0.125 + 0.5)
    row = Row(suite)
    for content in (fog % (20, "") + quad(GREEN), quad(GREEN) + fog % (20, ""), quad(GREEN),
                    fog % (20, "enabled FALSE") + quad(GREEN),
                    fog % (4, "") + "Group { children [ %s %s ] }" % (fog % (20, ""), quad(GREEN))):
        row.add(content)
    got = row.draw(head=far)
    for i, name in ((0, "its group"), (1, "what stands before it"), (4, "the inner one")):
        x, y = i + 0.375, 0.625
        depth = math.sqrt(100 + x * x + y * y)
        suite.close(name, got[i], fogged(linear(depth, 20)))
    for i, name in ((2, "not the neighbour"), (3, "not enabled")):
        x, y = i + 0.375, 0.625
        k = linear(math.sqrt(100 + x * x + y * y), 20)
        suite.close(name, got[i], (0, k, 1 - k, 1))


@suite.case
def fog_coordinates():
    "FogCoordinate gives the distance at the vertices"
    square = ("IndexedFaceSet { coordIndex [0 1 2 3 -1] coord Coordinate { point "
              "[-.5 -.5 0, .5 -.5 0, .5 .5 0, -.5 .5 0] } fogCoord FogCoordinate { depth [ %s ] } }")
    fog = "Fog { visibilityRange 8 color 1 0 0 %s }\n"
    row = Row(suite)
    row.add(quad(GREEN, geometry=square % "2 2 2 2"))
    row.add(quad(GREEN, geometry=square % "0 8 8 0"))
    got = row.draw(head=fog % "")
    suite.close("constant", got[0], fogged(0.75))
    suite.close("interpolated", got[1], fogged(1 - 0.375))


@suite.case
def volumetric():
    "the extension volumetric: the depth below a plane"
    fog = ("LocalFog { visibilityRange 2 color 1 0 0 volumetric TRUE volumetricDirection %s "
           "volumetricVisibilityStart %s }\n")
    check_all((
        ("below", fog % ("0 -3 0", -0.625) + quad(GREEN), fogged(1 - 0.25)),
        ("above: none", fog % ("0 -1 0", 2) + quad(GREEN), fogged(1)),
        ("to the side", fog % ("1 0 0", -1.125) + quad(GREEN), fogged(1 - 0.5)),
    ))
    suite.close("visibilityStart", perspective(
        "Fog { visibilityRange 6 visibilityStart 2 color 1 0 0 }", at=(4, 4)), fogged(0.5))


# ---- Planes


@suite.case
def clip_planes():
    "ClipPlane: the half where the plane is not negative is kept, in its group, with its transform"
    shape = quad(GREEN)
    here, gone = (0, 1, 0, 1), (0, 0, 0, 0)
    plane = "ClipPlane { plane %s }\n"
    check_all((
        ("kept", plane % "-1 0 0 0" + shape, here),
        ("cut", plane % "1 0 0 0" + shape, gone),
        ("with its distance", plane % "1 0 0 .25" + shape, here),
        ("disabled", "ClipPlane { enabled FALSE plane 1 0 0 0 }" + shape, here),
        ("what stands before it", shape + plane % "1 0 0 0", gone),
        ("an inner group", plane % "1 0 0 0" + "Group { children [ %s ] }" % shape, gone),
        ("not outside its group", "Group { children %s }" % plane % "1 0 0 0" + shape, here),
        ("turned", "Transform { rotation 0 0 1 1.5707963 children [ %s Transform { rotation 0 0 1 "
         "-1.5707963 children [ %s ] } ] }" % (plane % "0 1 0 0", shape), here),
        ("turned, cut", "Transform { rotation 0 0 1 -1.5707963 children [ %s Transform { rotation 0 0 1 "
         "1.5707963 children [ %s ] } ] }" % (plane % "0 1 0 0", shape), gone),
        ("two planes", plane % "-1 0 0 0" + plane % "0 -1 0 0" + shape, gone),
        ("two planes, neither cuts", plane % "-1 0 0 0" + plane % "0 1 0 0" + shape, here),
        ("a lit shape", "DirectionalLight { }" + plane % "1 0 0 0" + quad("Material { }"), gone),
    ))


@suite.case
def edge_of_a_plane():
    "the cut runs along the plane, through the middle of pixels' rows"
    text = front_scene("ClipPlane { plane 1 1 0 0 }", quad(GREEN, geometry="Rectangle2D { size 2 2 }"))
    picture = suite.picture(text, size="16x16")
    wrong = [(x, y) for x in range(16) for y in range(16)
             if x != y and (picture.at(x, y)[3] > 0.5) != (x > y)]
    suite.equal("", wrong, [])


COMPLETE = ("Shape { appearance Appearance { shaders ComposedShader { parts [ ShaderPart { type \"VERTEX\" url \"data:text/plain,\n"
            "attribute vec4 castle_Vertex;\nuniform mat4 castle_ModelViewMatrix, castle_ProjectionMatrix;\n"
            "void main() { vec4 vertex_eye = castle_ModelViewMatrix * castle_Vertex; vec3 normal_eye = vec3(0.0, 0.0, 1.0);\n"
            "/* PLUG: vertex_eye_space (vertex_eye, normal_eye) */\n"
            "gl_Position = castle_ProjectionMatrix * vertex_eye; }\" } ShaderPart { type \"FRAGMENT\" url \"data:text/plain,\n"
            "void main() { vec4 color = vec4(0.0, 1.0, 0.0, 1.0); vec3 normal = vec3(0.0, 0.0, 1.0);\n"
            "%s\ngl_FragColor = color; }\" } ] } } geometry %s }\n")


@suite.case
def complete_shaders():
    "fog reaches an author's complete shader where that offers fog_apply, and no other"
    fog = "Fog { color 1 0 0 visibilityRange 10 %s }\n"
    apply, wall = "/* PLUG: fog_apply (color, normal) */", "Rectangle2D { size 40 40 }"
    suite.close("offered", perspective(fog % "", COMPLETE % (apply, wall), at=(4, 4)), fogged(linear(4, 10)), 2e-3)
    suite.close("exponential", perspective(fog % 'fogType "EXPONENTIAL"', COMPLETE % (apply, wall), at=(4, 4)),
                fogged(exponential(4, 10)), 2e-3)
    square = ("IndexedFaceSet { coordIndex [0 1 2 3 -1] coord Coordinate { point [-9 -9 0, 9 -9 0, 9 9 0, -9 9 0] } "
              "fogCoord FogCoordinate { depth [ 5, 5, 5, 5 ] } }")
    suite.close("fog coordinates", perspective(fog % "", COMPLETE % (apply, square), at=(4, 4)), fogged(linear(5, 10)))
    suite.close("not offered", perspective(fog % "", COMPLETE % ("", wall), at=(4, 4)), (0, 1, 0, 1))


@suite.case
def many_planes():
    "more planes than anybody needs are told of, once"
    planes = "\n".join("ClipPlane { plane 0 0 0 1 }" for _ in range(40))
    result = suite.render(front_scene(planes, quad(GREEN)), "--probe", "0,0", size="1x1", status=1)
    suite.equal("limit", [m[5] for m in result.messages()], ["limit"])
    suite.equal("drawn", result.output.split()[1], "1.00000000")


@suite.case
def unlit_in_fog():
    "nodes that are not there cost nothing: no fog, no plane in the program without them"
    text = front_scene("Group { children LocalFog { visibilityRange 1 } }", quad(GREEN))
    suite.close("", suite.middle(text), (0, 1, 0, 1))


suite.run()
