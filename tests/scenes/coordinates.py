#!/usr/bin/env python3
"""Texture coordinates: given, generated, projected, transformed, by unit and by name."""

import math
import os

from harness import Suite, dot, rotate, unit
from scenes import HEADER, Row, effect, front_scene, quad

suite = Suite()

# probed in a quad of Row: its place, and its texture coordinates
X, Y = -0.125, 0.125
S, T = 0.375, 0.625
WHITE = "UnlitMaterial { }"
SHADER = "ShaderTexture { %s effects [ " + effect(
    "void PLUG_texture_color(inout vec4 c, const in vec4 t)"
    "{ c.rgb = 0.5 + 0.5 * t.stp / t.q; }") + " ] }"
SHOW = SHADER % ""
POINTS = "-.5 -.5 0, .5 -.5 0, .5 .5 0, -.5 .5 0"
FLAT = "TextureCoordinate { point [0 0, 1 0, 1 1, 0 1] }"


def face(coordinates="", points=POINTS, more=""):
    coordinates = f"texCoord {coordinates}" if coordinates else ""
    return (f"IndexedFaceSet {{ coordIndex [0 1 2 3 -1] coord Coordinate {{ point [{points}] }} "
            f"solid FALSE {coordinates} {more} }}")


def shown(coordinates="", appearance="", texture=SHOW, **options):
    return quad(WHITE, appearance=f"texture {texture} {appearance}",
                geometry=face(coordinates, **options))


def seen(coordinates):
    return tuple(0.5 + 0.5 * c for c in coordinates) + (1,)


def check_all(cases, tolerance=2e-3):
    """Cases: name, content, expected coordinates s, t, r (None: any)."""
    row = Row(suite)
    for _, content, _ in cases:
        row.add(content)
    for (name, _, expected), got in zip(cases, row.draw()):
        known = [i for i, c in enumerate(expected) if c is not None]
        suite.close(name, [got[i] for i in known],
                    [seen(expected[i : i + 1])[0] for i in known], tolerance)


def generator(mode, parameter=""):
    parameter = f"parameter [ {parameter} ]" if parameter else ""
    return f'TextureCoordinateGenerator {{ mode "{mode}" {parameter} }}'


@suite.case
def given():
    "coordinates of the file, with two, three and four components; the division by the fourth"
    flat3 = "TextureCoordinate3D { point [0 0 .1, 1 0 .1, 1 1 .5, 0 1 .5] }"
    flat4 = "TextureCoordinate4D { point [0 0 0 2, 2 0 0 2, 2 2 0 2, 0 2 0 2] }"
    image = ("PixelTexture { repeatS FALSE repeatT FALSE image 2 1 3 0xFF0000 0x0000FF "
             "textureProperties TextureProperties { magnificationFilter \"NEAREST\" minificationFilter "
             "\"NEAREST\" } }")
    check_all((
        ("TextureCoordinate", shown(FLAT), (S, T, 0)),
        ("TextureCoordinate3D", shown(flat3), (S, T, 0.1 + 0.4 * T)),
        ("TextureCoordinate4D", shown(flat4), (S, T, 0)),
        ("the default", shown(), (S, T, 0)),
        ("of a box", quad(WHITE, appearance="texture " + SHOW, geometry="Box { size 1 1 1 }"), (S, T, 0)),
    ))
    row = Row(suite)
    row.add(shown(flat4, texture=image))
    row.add(shown(flat4.replace("2,", "1,").replace("2]", "1]"), texture=image))
    got = row.draw()
    suite.close("a 2D texture is divided: the first texel", got[0], (1, 0, 0, 1), 2e-3)
    suite.close("the second", got[1], (0, 0, 1, 1), 2e-3)


@suite.case
def generated():
    "the modes of TextureCoordinateGenerator"
    turn = "Transform { rotation 1 0 0 .5 children [ %s ] }\n"
    normal = (0, -math.sin(0.5), math.cos(0.5))
    cases = [
        ("SPHERE", "SPHERE", (0.5 * normal[0] + 0.5, 0.5 * normal[1] + 0.5, 0)),
        ("CAMERASPACENORMAL", "CAMERASPACENORMAL", normal),
        ("WORLDSPACENORMAL", "WORLDSPACENORMAL", normal),
        # parallel view: E = +z
        ("CAMERASPACEREFLECTIONVECTOR", "CAMERASPACEREFLECTIONVECTOR", rotate((1, 0, 0), 1, (0, 0, 1))),
        ("WORLDSPACEREFLECTIONVECTOR", "WORLDSPACEREFLECTIONVECTOR", rotate((1, 0, 0), 1, (0, 0, 1))),
        ("SPHERE-REFLECT", "SPHERE-REFLECT", rotate((1, 0, 0), 1, (0, 0, 1))),
        ("SPHERE-LOCAL", "SPHERE-LOCAL", (0.5, 0.5, 0)),
    ]
    check_all([(name, turn % shown(generator(mode)), expected) for name, mode, expected in cases])
    y = Y / math.cos(0.5)  # in the tilted plane
    check_all([
        ("COORD", turn % shown(generator("COORD")), (X, y, 0)),
        ("COORD-EYE", shown(generator("COORD-EYE") ,
                            texture=SHOW.replace("t.stp", "(t.stp * vec3(0.1, 0.1, 0.1))")),
         ((1.5 + X) / 10, (0.5 + Y) / 10, -1)),
        ("CAMERASPACEPOSITION", shown(generator("CAMERASPACEPOSITION"),
                                      texture=SHOW.replace("t.stp", "(t.stp * vec3(0.1, 0.1, 0.1))")),
         ((2.5 + X) / 10, (0.5 + Y) / 10, -1)),
        ("BOUNDS", shown(generator("BOUNDS")), (S, T, 0)),
        ("BOUNDS2D", shown(generator("BOUNDS2D")), (S, T, 0)),
        ("an unknown mode is COORD", shown(generator("NONSENSE")), (X, Y, 0)),
        ("none", shown(), (S, T, 0)),
    ])


@suite.case
def refraction():
    "SPHERE-REFLECT with an index of refraction; SPHERE-REFLECT-LOCAL with an eye of its own"
    n, angle = 1.5, 0.5
    normal = (0, -math.sin(angle), math.cos(angle))
    seen_along, eta = (0, 0, -1), 1 / n
    cosine = dot(normal, seen_along)
    k = 1 - eta * eta * (1 - cosine * cosine)
    bent = tuple(eta * s - (eta * cosine + math.sqrt(k)) * c for s, c in zip(seen_along, normal))
    check_all([
        ("refracted", "Transform { rotation 1 0 0 .5 children [ %s ] }\n"
         % shown(generator("SPHERE-REFLECT", "1.5")), bent),
    ])
    # a far eye: the same direction at all vertices
    eye = (100.0, 200.0, 300.0)
    away = unit(tuple(p - e for p, e in zip((0, 0, 0), eye)))
    check_all([("local", shown(generator("SPHERE-REFLECT-LOCAL", "0 100 200 300")),
                (away[0], away[1], -away[2]))], 5e-3)


@suite.case
def noise():
    "NOISE is 0 at the corners of its lattice, scaled and moved by its parameters"
    check_all([
        ("at corners", shown(generator("NOISE", "1 1 1 .5 .5 0")), (0, 0, 0)),
        ("all places in one cell's corner", shown(generator("NOISE", "0 0 0 3 4 5")), (0, 0, 0)),
        ("eye", shown(generator("NOISE-EYE", "0 0 0 3 4 5")), (0, 0, 0)),
    ])
    row = Row(suite)
    row.add(shown(generator("NOISE", "0 0 0 .3 .4 .7")))
    row.add(shown(generator("NOISE", "0 0 0 1.3 .4 .7")))
    row.add(shown(generator("NOISE-EYE", "0 0 0 .3 .4 .7")))
    got = row.draw()
    suite.check("not 0 between them", max(abs(v - 0.5) for v in got[0][:3]) > 0.02, got)
    suite.check("three components of their own", len(set(got[0][:3])) == 3, got)
    suite.check("another cell is another place", got[0] != got[1], got)
    suite.close("the same place, the same noise", got[2], got[0], 1e-6)


@suite.case
def reflected_for_each_fragment():
    "a reflection vector is that of the fragment, not between those of the vertices"
    text = HEADER + ("NavigationInfo { headlight FALSE }\n"
                     "Viewpoint { position 0 0 .5 fieldOfView 1.5708 }\n"
                     + quad(WHITE, appearance="texture " + SHOW,
                            geometry=face(generator("CAMERASPACEREFLECTIONVECTOR"))))
    for x, y in ((8, 8), (12, 3), (2, 14)):
        px, py = (x + 0.5) / 8 - 1, 1 - (y + 0.5) / 8
        e = unit((-px, -py, 1))
        r = tuple(2 * e[2] * n - c for n, c in zip((0, 0, 1), e))
        suite.close(f"pixel {x},{y}", suite.probe(text, [(x, y)])[0], seen(r), 2e-3)


@suite.case
def spaces():
    "3D textures and cubes without coordinates: the box, and the direction from its middle"
    grid = "PixelTexture3D { image [ 3 2 2 2 0xFF0000 0x00FF00 0x0000FF 0xFFFF00 0x00FFFF 0xFF00FF 0xFFFFFF 0x101010 ] textureProperties TextureProperties { magnificationFilter \"NEAREST\" minificationFilter \"NEAREST\" } }"
    sides = {"front": "0xFF0000", "back": "0x00FF00", "left": "0x0000FF", "right": "0xFFFF00",
             "top": "0x00FFFF", "bottom": "0xFF00FF"}
    cube = ("ComposedCubeMapTexture { " + " ".join(
        f"{side}Texture PixelTexture {{ image 1 1 3 {color} }}" for side, color in sides.items()) + " }")
    turned = "Transform { rotation 0 1 0 %s children [ %s ] }\n"
    box = "Box { size 1 1 1 }"
    row = Row(suite)
    row.add(quad(WHITE, appearance="texture " + grid, geometry=box))
    row.add(turned % (math.pi, quad(WHITE, appearance="texture " + grid, geometry=box)))
    row.add(quad(WHITE, appearance="texture " + cube, geometry=box))
    row.add(turned % (math.pi, quad(WHITE, appearance="texture " + cube, geometry=box)))
    row.add(turned % (math.pi / 2, quad(WHITE, appearance="texture " + cube, geometry=box)))
    row.add(turned % (-math.pi / 2, quad(WHITE, appearance="texture " + cube, geometry=box)))
    got = row.draw()
    # in front r = 0; s and t are 3/8 and 5/8: texel (0, 1, 0)
    suite.close("3D, in front", got[0], (0, 0, 1, 1), 2e-3)
    suite.close("3D, behind: texel (1, 1, 1)", got[1], (16 / 255,) * 3 + (1,), 2e-3)
    faces = [tuple(round(v) for v in color[:3]) for color in got[2:]]
    # front is what is seen looking along -z: the surface behind the middle of the box
    suite.check("cube: four sides, four faces", len(set(faces)) == 4, faces)
    named = {(1, 0, 0): "front", (0, 1, 0): "back", (0, 0, 1): "left", (1, 1, 0): "right"}
    suite.check("opposite sides, opposite faces",
                {named.get(faces[0]), named.get(faces[1])} == {"front", "back"}
                and {named.get(faces[2]), named.get(faces[3])} == {"left", "right"}, faces)


@suite.case
def transforms():
    "TextureTransform: translation, then rotation and scale about the centre"
    def one(fields, coordinates=FLAT):
        return shown(coordinates, f"textureTransform TextureTransform {{ {fields} }}")

    def apply(t=(0, 0), c=(0, 0), r=0.0, s=(1, 1), at=(S, T)):
        x, y = at[0] + t[0] + c[0], at[1] + t[1] + c[1]
        x, y = math.cos(r) * x - math.sin(r) * y, math.sin(r) * x + math.cos(r) * y
        return s[0] * x - c[0], s[1] * y - c[1], 0

    check_all([
        ("nothing", one(""), apply()),
        ("translation", one("translation .1 -.2"), apply(t=(0.1, -0.2))),
        ("rotation", one("rotation .5"), apply(r=0.5)),
        ("scale", one("scale .5 .25"), apply(s=(0.5, 0.25))),
        ("all", one("translation .1 .2 center -.3 -.4 rotation .7 scale .8 .6"),
         apply((0.1, 0.2), (-0.3, -0.4), 0.7, (0.8, 0.6))),
        ("after a generator", one("translation .1 .2", generator("COORD")), (X + 0.1, Y + 0.2, 0)),
        ("of homogeneous coordinates", one(
            "translation .1 .2 rotation .7",
            "TextureCoordinate4D { point [0 0 0 2, 2 0 0 2, 2 2 0 2, 0 2 0 2] }"),
         apply((0.1, 0.2), r=0.7)),
    ])


@suite.case
def transforms_in_space():
    "TextureTransform3D and TextureTransformMatrix3D, also of what is made for each fragment"
    t, c, axis, angle, s = (0.1, 0.2, 0.3), (-0.5, -0.4, -0.3), (1, 2, 3), 0.6, (0.5, 0.6, 0.7)
    moved = rotate(axis, angle, (S + t[0] + c[0], T + t[1] + c[1], t[2] + c[2]))
    expected = tuple(k * m - o for k, m, o in zip(s, moved, c))
    transform = ("textureTransform TextureTransform3D { translation .1 .2 .3 center -.5 -.4 -.3 "
                 "rotation 1 2 3 .6 scale .5 .6 .7 }")
    matrix = ("textureTransform TextureTransformMatrix3D { matrix "
              ".5 0 0 .1  0 .5 0 .2  0 0 1 .3  0 0 0 2 }")
    moved = "textureTransform TextureTransform3D { translation .1 .2 -.5 }"
    check_all([
        ("TextureTransform3D", shown(FLAT, transform), expected),
        ("TextureTransformMatrix3D", shown(FLAT, matrix),
         ((0.5 * S + 0.1) / 2, (0.5 * T + 0.2) / 2, 0.15)),
        ("of a reflection", shown(generator("CAMERASPACEREFLECTIONVECTOR"), moved), (0.1, 0.2, 0.5)),
        ("TextureTransform of a reflection", shown(
            generator("CAMERASPACEREFLECTIONVECTOR"),
            "textureTransform TextureTransform { translation .1 .2 }"), (0.1, 0.2, 1)),
    ])


@suite.case
def units():
    "coordinates and transformations of several textures"
    other = "TextureCoordinate { point [.5 .5, .5 .5, .5 .5, .5 .5] }"
    both = f"MultiTextureCoordinate {{ texCoord [ {FLAT} {other} ] }}"

    def second(coordinates, transform="", count=2):
        first = "PixelTexture { image 1 1 1 0 } " * (count - 1)
        modes = '"MODULATE" ' * (count - 1) + '"REPLACE"'
        return shown(coordinates, transform,
                     f"MultiTexture {{ mode [ {modes} ] texture [ {first} {SHOW} ] }}")

    shift = "TextureTransform { translation .1 .2 }"
    many = "textureTransform MultiTextureTransform { textureTransform [ %s ] }"
    check_all([
        ("the second of two", second(both), (0.5, 0.5, 0)),
        ("the last is repeated", second(both, count=3), (0.5, 0.5, 0)),
        ("one for all", second(FLAT), (S, T, 0)),
        ("a generator for all", second(generator("COORD")), (X, Y, 0)),
        ("a generator beside given ones", second(
            f"MultiTextureCoordinate {{ texCoord [ {FLAT} {generator('COORD')} ] }}"), (X, Y, 0)),
        ("MultiGeneratedTextureCoordinate", second(
            "MultiGeneratedTextureCoordinate { texCoord [ %s %s ] }"
            % (generator("SPHERE"), generator("COORD"))), (X, Y, 0)),
        ("MultiTextureTransform", second(FLAT, many % ("TextureTransform { } " + shift)), (S + 0.1, T + 0.2, 0)),
        ("its first alone", second(FLAT, many % shift), (S, T, 0)),
        ("a single TextureTransform does not move a MultiTexture", second(FLAT, "textureTransform " + shift),
         (S, T, 0)),
        ("MultiTextureTransform of a single texture", shown(FLAT, many % shift), (S + 0.1, T + 0.2, 0)),
        ("MultiTextureCoordinate of a single texture", shown(both), (S, T, 0)),
    ])


@suite.case
def primitives():
    "generators on primitives"
    ball = "Sphere { radius .5 texCoord %s }" % generator("COORD")
    check_all([("Sphere", quad(WHITE, appearance="texture " + SHOW, geometry=ball),
                (X, Y, math.sqrt(0.25 - X * X - Y * Y)))], 0.01)


@suite.case
def names():
    "textures of materials find coordinates and transformations by the names of their mapping"
    first = 'TextureCoordinate { mapping "one" point [0 0, 1 0, 1 1, 0 1] }'
    second = 'TextureCoordinate { mapping "two" point [.5 .5, .5 .5, .5 .5, .5 .5] }'
    both = f"MultiTextureCoordinate {{ texCoord [ {first} {second} ] }}"
    shift = ('textureTransform MultiTextureTransform { textureTransform [ TextureTransform { mapping '
             '"two" translation .1 .2 } TextureTransform { mapping "one" translation .2 .1 } ] }')

    def unlit(mapping, coordinates=both, appearance=""):
        mapping = f'emissiveTextureMapping "{mapping}"' if mapping else ""
        return quad(f"UnlitMaterial {{ emissiveTexture {SHOW} {mapping} }}",
                    appearance=appearance, geometry=face(coordinates))

    check_all([
        ("the first", unlit("one"), (S, T, 0)),
        ("the second", unlit("two"), (0.5, 0.5, 0)),
        ("no name", unlit(""), (S, T, 0)),
        ("with a transformation", unlit("two", appearance=shift), (0.6, 0.7, 0)),
        ("the first, too", unlit("one", appearance=shift), (S + 0.2, T + 0.1, 0)),
        ("an emissive texture of a Material", quad(
            f'Material {{ emissiveColor 1 1 1 emissiveTexture {SHOW} emissiveTextureMapping "two" }}',
            geometry=face(both)), (0.5, 0.5, 0)),
    ])
    text = front_scene(unlit("three"))
    result = suite.render(text, "--probe", "8,8")
    line = next(i for i, l in enumerate(text.splitlines(), 1) if "three" in l)
    suite.check("an unknown name is warned of",
                [m for m in result.with_code("bad-value") if m[1] == line], result.errors)


@suite.case
def host_names():
    "castle_TexCoord<N> can be read by any effect, and is made only then"
    both = (f"MultiTextureCoordinate {{ texCoord [ {FLAT} "
            "TextureCoordinate { point [.5 .5, .5 .5, .5 .5, .5 .5] } ] }")
    read = ("varying vec4 castle_TexCoord%d;\nvoid PLUG_fragment_modify(inout vec4 c)"
            "{ c.rgb = 0.5 + 0.5 * castle_TexCoord%d.stp; }")
    check_all([
        ("the first, without a texture", quad(WHITE, effect(read % (0, 0)), geometry=face(both)), (S, T, 0)),
        ("the second", quad(WHITE, effect(read % (1, 1)), geometry=face(both)), (0.5, 0.5, 0)),
        ("without a declaration", quad(WHITE, effect((read % (1, 1)).split("\n", 1)[1]),
                                       geometry=face(both)), (0.5, 0.5, 0)),
        ("with a texture and a transformation", quad(WHITE, effect(read % (0, 0)), geometry=face(FLAT),
         appearance="texture PixelTexture { image 1 1 1 0 } "
         "textureTransform TextureTransform { translation .1 .2 }"), (S + 0.1, T + 0.2, 0)),
    ])


def vertex_programs(text):
    """The vertex stages of a scene's programs, together."""
    result = suite.command("dump", "scene.x3dv", "-d", "out", files={"scene.x3dv": text})
    folder = os.path.join(result.folder, "out")
    found = []
    for ending in (".vert", ".frag"):
        texts = []
        for name in sorted(os.listdir(folder)):
            if name.startswith("surface") and name.endswith(ending):
                with open(os.path.join(folder, name), encoding="utf-8") as file:
                    texts.append(file.read())
        found.append("\n".join(texts))
    return found


@suite.case
def cost():
    "what no texture and no effect reads is not in the program"
    both = f"MultiTextureCoordinate {{ texCoord [ {FLAT} {FLAT} {generator('SPHERE')} ] }}"
    vertex, fragment = vertex_programs(front_scene(quad(WHITE, geometry=face(both))))
    suite.check("no texture: no coordinates", "TexCoord" not in vertex and "TexCoord" not in fragment,
                vertex + fragment)
    suite.check("no sampler, no normal", "sampler" not in fragment and "Normal" not in vertex, fragment)
    vertex, fragment = vertex_programs(front_scene(quad(
        WHITE, appearance="texture PixelTexture { image 1 1 1 0 }", geometry=face(both))))
    suite.check("one texture: one channel", "castle_MultiTexCoord0" in vertex and "TexCoord1" not in vertex
                and "TexCoord2" not in vertex and "castle_Normal" not in vertex, vertex)
    suite.check("without a division", "textureProj" not in fragment, fragment)
    vertex, fragment = vertex_programs(front_scene(quad(
        WHITE, appearance="texture ShaderTexture { }", geometry=face(both))))
    suite.check("a pink texture needs no coordinates", "TexCoord" not in vertex + fragment, vertex)
    two = "PixelTexture { image 1 1 1 0 }"
    vertex, fragment = vertex_programs(front_scene(quad(
        WHITE, appearance=f"texture MultiTexture {{ texture [ {two} {two} ] }}", geometry=face(FLAT))))
    suite.check("two textures in one place share a channel", "TexCoord0" in vertex and "TexCoord1" not in vertex,
                vertex)


@suite.case
def projected():
    "a light or a viewpoint projects a texture"
    names = iter(range(100))

    def one(projector, **options):
        """Both in the same place; the quad spans x and y from -.5 to .5."""
        name = f"P{next(names)}"
        return f"DEF {name} {projector}\n" + shown(
            f"ProjectedTextureCoordinate {{ projector USE {name} }}", **options)

    angle = 2 * math.atan(0.25)
    spot = f"SpotLight {{ %s location 0 0 2 projectionAngle {angle} projectionNear 1 projectionFar 3 }}"
    parallel = ("DirectionalLight { projectionLocation 0 0 1 projectionRectangle -1 -.5 1 .5 "
                "projectionNear .5 projectionFar 1.5 }")
    check_all([
        ("SpotLight", one(spot % ""), (0.5 + X, 0.5 + Y, None)),
        ("its cutOffAngle", one(f"SpotLight {{ location 0 0 2 cutOffAngle {angle / 2} projectionNear 1 "
                                "projectionFar 3 }"), (0.5 + X, 0.5 + Y, None)),
        ("up", one(spot % "up 1 0 0"), (0.5 - Y, 0.5 + X, None)),
        ("up along the view", one(spot % "up 0 0 1"), (0.5 + X, 0.5 + Y, None)),
        ("from the side", one("DirectionalLight { direction 1 0 -1 projectionLocation 0 0 0 "
                              "projectionRectangle -1 -1 1 1 projectionNear 1 projectionFar 2 }"),
         (0.5 + X * math.cos(math.pi / 4) / 2, 0.5 + Y / 2, None)),
        ("DirectionalLight", one(parallel), (0.5 + X / 2, 0.5 + Y, 0.5)),
        ("Viewpoint", one(f"Viewpoint {{ position 0 0 2 fieldOfView {angle} nearDistance 1 farDistance 3 }}"),
         (0.5 + X, 0.5 + Y, None)),
        ("OrthoViewpoint", one("OrthoViewpoint { position .1 .2 2 fieldOfView -1 -1 1 1 "
                               "nearDistance 1 farDistance 3 }"), (0.45 + X / 2, 0.4 + Y / 2, 0.5)),
        ("moved and turned", "Transform { translation .1 .2 .3 rotation 0 0 1 1.5707963 children "
         "[ DEF L " + parallel + " ] }\n" + shown("ProjectedTextureCoordinate { projector USE L }"),
         (0.5 + (Y - 0.2) / 2, 0.5 - (X - 0.1), 0.8)),
        ("then transformed", one(parallel, appearance="textureTransform TextureTransform { scale 2 2 }"),
         (1 + X, 1 + 2 * Y, 0.5)),
        ("without a projector", shown("ProjectedTextureCoordinate { }"), (S, T, 0)),
    ])
    # a picture: divided by q for each fragment, in perspective
    image = ("PixelTexture { repeatS FALSE repeatT FALSE image 2 1 3 0xFF0000 0x0000FF textureProperties "
             "TextureProperties { magnificationFilter \"NEAREST\" minificationFilter \"NEAREST\" } }")
    row = Row(suite)
    for x in (-0.5, 0):
        row.add(one((spot % "").replace("location 0 0 2", f"location {x} 0 2"), texture=image))
    row.add(one("PointLight { }"))
    got = row.draw()
    suite.close("a picture: its right half", got[0], (0, 0, 1, 1), 2e-3)
    suite.close("its left half", got[1], (1, 0, 0, 1), 2e-3)


@suite.case
def projected_in_the_world():
    "a projector that stands in the field alone has world coordinates, and is fitted to the scene"
    for name, light, expected in (
            ("fitted", "DirectionalLight { }", (0.5 + X / 1.02, 0.5 + Y / 1.02, 0.5)),
            ("given", "DirectionalLight { projectionLocation 1 0 1 projectionRectangle -2 -2 2 2 "
             "projectionNear .5 projectionFar 1.5 }", (0.5 + (X - 1) / 4, 0.5 + Y / 4, 0.5))):
        text = front_scene(shown(f"ProjectedTextureCoordinate {{ projector {light} }}"))
        suite.close(name, suite.probe(text, [(3, 3)], size="8x8")[0], seen(expected), 2e-3)

suite.run()
