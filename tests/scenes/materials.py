#!/usr/bin/env python3
"""Materials of two sides, colours at the vertices, and what a shape pays for."""

import math
import os

from harness import Suite, blinn_phong, unit
from scenes import Row, effect, front_scene, quad

suite = Suite()

LIGHT = "DirectionalLight { direction 1 -1 -2 ambientIntensity .2 intensity .8 }\n"
L = unit((-1, 1, 2))
VIEW = (0, 0, 1)
TURN = "Transform { rotation 0 1 0 3.14159265358979 children [ %s ] }\n"
SQUARE = ("IndexedFaceSet { solid %s coordIndex [0 1 2 3 -1] coord Coordinate { point "
          "[-.5 -.5 0, .5 -.5 0, .5 .5 0, -.5 .5 0] } %s }")


def lit(diffuse, specular=(0, 0, 0), shininess=25.6, ambient=0.2, emissive=(0, 0, 0), alpha=1.0):
    shine = blinn_phong((0, 0, 1), L, VIEW, diffuse, specular, shininess)
    rgb = [e + 0.2 * ambient * d + 0.8 * s for e, d, s in zip(emissive, diffuse, shine)]
    return [c * alpha for c in rgb] + [alpha]


def check_all(cases, head="", **options):
    row = Row(suite)
    for _, content, _ in cases:
        row.add(content)
    for (name, _, expected), got in zip(cases, row.draw(head=head, **options)):
        suite.close(name, got, expected)


def sided(material, solid="FALSE", colors=""):
    return quad(material, geometry=SQUARE % (solid, colors))


TWO = ("TwoSidedMaterial { %s diffuseColor .6 .4 .2 ambientIntensity .5 backDiffuseColor .1 .3 .5 "
       "backSpecularColor .2 .4 .6 backShininess .1 backAmbientIntensity .3 "
       "backEmissiveColor .01 .02 .03 }")
BACK = lit((0.1, 0.3, 0.5), (0.2, 0.4, 0.6), 12.8, 0.3, (0.01, 0.02, 0.03))


@suite.case
def two_sides():
    "TwoSidedMaterial and backMaterial: each side has its own colours"
    back = ("backMaterial Material { diffuseColor .1 .3 .5 specularColor .2 .4 .6 shininess .1 "
            "ambientIntensity .3 emissiveColor .01 .02 .03 }")
    appearance = quad("Material { diffuseColor .6 .4 .2 ambientIntensity .5 }", appearance=back,
                      geometry=SQUARE % ("FALSE", ""))
    unlit = quad("UnlitMaterial { emissiveColor 1 0 0 }", geometry=SQUARE % ("FALSE", ""),
                 appearance="backMaterial UnlitMaterial { emissiveColor 0 .5 1 }")
    front = lit((0.6, 0.4, 0.2), ambient=0.5)
    check_all((
        ("front", LIGHT + sided(TWO % "separateBackColor TRUE"), front),
        ("back", LIGHT + TURN % sided(TWO % "separateBackColor TRUE"), BACK),
        ("back, not separate", LIGHT + TURN % sided(TWO % ""), front),
        ("a solid shape has no back", LIGHT + TURN % sided(TWO % "separateBackColor TRUE", "TRUE"),
         (0, 0, 0, 0)),
        ("backMaterial, front", LIGHT + appearance, front),
        ("backMaterial, back", LIGHT + TURN % appearance, BACK),
        ("unlit, front", unlit, (1, 0, 0, 1)),
        ("unlit, back", TURN % unlit, (0, 0.5, 1, 1)),
    ))


@suite.case
def back_of_another_type():
    "a backMaterial of another type than material is reported and left out"
    shape = quad("UnlitMaterial { emissiveColor 1 0 0 }", geometry=SQUARE % ("FALSE", ""),
                 appearance="\nbackMaterial Material { }")
    result = suite.render(front_scene(TURN % shape), "--probe", "0,0", size="1x1", status=1)
    suite.equal("told at its place", [(m[1], m[5]) for m in result.messages()], [(6, "bad-value")])
    suite.equal("the front's is drawn", result.output.split(),
                ["1.00000000", "0.00000000", "0.00000000", "1.00000000"])


@suite.case
def vertex_colors():
    "Color stands for the diffuse or emissive colour, ColorRGBA for the transparency too"
    rgb = "color Color { %s color [.5 .25 1, .5 .25 1, .5 .25 1, .5 .25 1] }"
    rgba = "color ColorRGBA { %s color [.5 .25 1 .5, .5 .25 1 .5, .5 .25 1 .5, .5 .25 1 .5] }"
    material = "Material { diffuseColor .6 .4 .2 ambientIntensity .5 transparency %s }"
    unlit = "UnlitMaterial { emissiveColor .6 .4 .2 transparency %s }"
    mode = 'mode "MODULATE"'
    check_all((
        ("diffuse", LIGHT + sided(material % 0, colors=rgb % ""), lit((0.5, 0.25, 1), ambient=0.5)),
        ("Color keeps the transparency", LIGHT + sided(material % 0.75, colors=rgb % ""),
         lit((0.5, 0.25, 1), ambient=0.5, alpha=0.25)),
        ("ColorRGBA replaces it", LIGHT + sided(material % 0.75, colors=rgba % ""),
         lit((0.5, 0.25, 1), ambient=0.5, alpha=0.5)),
        ("alone it makes a shape blend", LIGHT + sided(material % 0, colors=rgba % ""),
         lit((0.5, 0.25, 1), ambient=0.5, alpha=0.5)),
        ("unlit", sided(unlit % 0, colors=rgb % ""), (0.5, 0.25, 1, 1)),
        ("no material", sided("", colors=rgb % ""), (0.5, 0.25, 1, 1)),
        ("MODULATE", LIGHT + sided(material % 0, colors=rgb % mode),
         lit((0.3, 0.1, 0.2), ambient=0.5)),
        ("MODULATE, ColorRGBA, unlit", sided(unlit % 0.5, colors=rgba % mode),
         (0.3 * 0.25, 0.1 * 0.25, 0.2 * 0.25, 0.25)),
    ))


@suite.case
def lines_and_points():
    "lines and points have the emissive colour, or that of their vertices"
    line = "IndexedLineSet { coordIndex [0 1 -1] coord Coordinate { point [-.5 .125 0, .5 .125 0] } %s }"
    colors = "color Color { color [0 1 .5, 0 1 .5] }"
    point = "PointSet { coord Coordinate { point [-.125 .125 0] } %s }"
    material = "Material { diffuseColor 1 1 1 emissiveColor .25 .5 .75 }"
    check_all((
        ("line", LIGHT + quad(material, geometry=line % ""), (0.25, 0.5, 0.75, 1)),
        ("line, coloured", LIGHT + quad(material, geometry=line % colors), (0, 1, 0.5, 1)),
        ("line without material", quad("", geometry=line % ""), (1, 1, 1, 1)),
        ("point", LIGHT + quad(material, geometry=point % ""), (0.25, 0.5, 0.75, 1)),
        ("point, coloured", quad("", geometry=point % "color Color { color [0 1 .5] }"),
         (0, 1, 0.5, 1)),
    ))


@suite.case
def texture_apply():
    "texture_apply works, with one warning that names its successor"
    code = "void PLUG_texture_apply(inout vec4 c, const in vec3 n) { c.rgb = c.bgr; }"
    text = front_scene(quad("UnlitMaterial { emissiveColor .2 .4 .6 }", effect(code)))
    result = suite.render(text, "--probe", "0,0", size="1x1")
    suite.equal("one warning", [(m[3], m[5]) for m in result.messages()],
                [("warning", "deprecated-plug")])
    suite.check("names main_texture_apply", "main_texture_apply" in result.errors)
    twice = front_scene(quad("", "DEF E " + effect(code).strip()), quad("", "USE E"))
    suite.equal("once for an effect that is used twice",
                len(suite.render(twice, "-o", "a.png").with_code("deprecated-plug")), 1)
    own = ("shaders ComposedShader { parts [ ShaderPart { type \"VERTEX\" url \"data:text/plain,\n"
           "uniform mat4 castle_ModelViewMatrix, castle_ProjectionMatrix; attribute vec4 castle_Vertex;\n"
           "void main() { gl_Position = castle_ProjectionMatrix * (castle_ModelViewMatrix * castle_Vertex); }\" }\n"
           "ShaderPart { type \"FRAGMENT\" url \"data:text/plain,\n"
           "void main() { vec4 c = vec4(.2, .4, .6, 1.); vec3 n = vec3(0.); /* PLUG: texture_apply (c, n) */\n"
           "gl_FragColor = c; }\" } ] }")
    text = front_scene(quad("UnlitMaterial { }", effect(code), appearance=own))
    result = suite.render(text, "--probe", "0,0", size="1x1")
    suite.equal("not where a shader of the author offers it", result.messages(), [])
    suite.close("there it is called", [float(v) for v in result.output.split()], (0.6, 0.4, 0.2, 1))


@suite.case
def material_info():
    "MaterialInfo and add_light: an author may add a light"
    code = ("void PLUG_add_light(inout vec4 lit, const in vec4 vertex_eye, const in vec3 normal_eye,"
            " const in MaterialInfo material) { lit.rgb += brighten(material); }\n")
    helper = "vec3 brighten(MaterialInfo m) { return 2.0 * m.diffuse + m.specular; }\n"
    view = ("void PLUG_add_light(inout vec4 lit, const in vec4 vertex_eye, const in vec3 normal_eye,"
            " const in MaterialInfo material, const in vec3 view) { lit.rgb += material.diffuse * view.z; }")
    material = "Material { diffuseColor .1 .2 .3 specularColor .5 .25 0 }"
    check_all((
        ("a light by an author", quad(material, effect(helper + code)), (0.7, 0.65, 0.6, 1)),
        ("with the direction to the viewer", quad(material, effect(view)), (0.1, 0.2, 0.3, 1)),
        ("of a physical material", quad("PhysicalMaterial { baseColor .25 .5 1 metallic 0 }",
                                        effect(view)),
         [v ** (1 / 2.2) for v in (0.25, 0.5, 1)] + [1]),
    ))


def program(text, *stages):
    result = suite.command("dump", "a.x3dv", "-d", "out", files={"a.x3dv": text})
    folder = os.path.join(result.folder, "out")
    names = sorted(n for n in os.listdir(folder) if n.startswith("surface"))
    found = []
    for stage in stages:
        name = [n for n in names if n.endswith(stage)][0]
        with open(os.path.join(folder, name), encoding="utf-8") as file:
            found.append(file.read())
    return found


@suite.case
def what_nothing_uses():
    "an unlit shape without texture has no light, texture or normal code, nor attributes of these"
    light = "DirectionalLight { } PointLight { } SpotLight { }\n"
    vertex, fragment = program(front_scene(light, quad("UnlitMaterial { }")), ".vert", ".frag")
    for word in ("ormal", "TexCoord", "tex_coord", "olor", "fog", "Fog", "castle_vertex_eye"):
        suite.check(f"no {word} in the vertex stage", word not in vertex, vertex)
    for word in ("ormal", "ight", "sampler", "texture", "oord", "MaterialInfo", "shininess", "fog",
                 "discard", "castle_", " if"):
        suite.check(f"no {word} in the fragment stage", word not in fragment, fragment)
    suite.check("two statements in the vertex stage", vertex.count(";") <= 8, vertex)
    lit_vertex, lit_fragment = program(front_scene(light, quad("Material { }")), ".vert", ".frag")
    suite.check("a lit one has them", "castle_Normal" in lit_vertex and "shininess" in lit_fragment)


suite.run()
