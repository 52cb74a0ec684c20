#!/usr/bin/env python3
"""Textures of surfaces: kinds, units, samplers, effects on them, textures of materials."""

import os

from harness import Suite, blinn_phong
from scenes import HEADER, NO_HEADLIGHT, Row, effect, effect_parts, front_scene, quad

suite = Suite()

# probed in a quad of Row: texture coordinates
S, T = 0.375, 0.625
HALF = "UnlitMaterial { emissiveColor 1 .5 .5 }"
WHITE = "UnlitMaterial { }"
FIELD = "PixelTexture { repeatS FALSE repeatT FALSE image 1 1 3 0x3366CC %s }"
COLOR = (0.2, 0.4, 0.8)
VOLUME = "PixelTexture3D { image [ 3 1 1 1 0x3366CC ] %s }"
CUBE = ("ComposedCubeMapTexture { %s "
        + " ".join(f"{side}Texture PixelTexture {{ image 1 1 3 {color} }}" for side, color in (
            ("front", "0x3366CC"), ("back", "0x3366CC"), ("left", "0x3366CC"),
            ("right", "0x3366CC"), ("top", "0x3366CC"), ("bottom", "0x3366CC"))) + " }")
SHOW = "{ texture_color.rgb = vec3(tex_coord.st, 0.25); }"


def texture_effect(body, sampler=None):
    extra = f" const in {sampler} tex," if sampler else ""
    return effect(f"void PLUG_texture_color(inout vec4 texture_color,{extra} const in vec4 tex_coord)"
                  f"{body}")


def effects(text):
    return f"effects [ {text} ]"


def check_all(cases, head="", **options):
    """Cases: name, content, expected colour."""
    row = Row(suite)
    for _, content, _ in cases:
        row.add(content)
    for (name, _, expected), got in zip(cases, row.draw(head=head, **options)):
        expected = tuple(expected) + (1,) * (4 - len(expected))
        suite.close(name, got, expected, 2e-3)


@suite.case
def kinds():
    "2D, 3D and cube textures multiply the colour before light"
    check_all(tuple((name, quad(HALF, appearance="texture " + texture % ""), (0.2, 0.2, 0.4))
                    for name, texture in (("2D", FIELD), ("3D", VOLUME), ("cube", CUBE))))


@suite.case
def components():
    "how many components the texture has: grey, with alpha, colour"
    pixel = "texture PixelTexture { image 1 1 %s }"
    check_all((
        ("L", quad(HALF, appearance=pixel % "1 0x80"), (0.502, 0.251, 0.251)),
        ("LA", quad(HALF, appearance=pixel % "2 0x8080"), (0.252, 0.126, 0.126, 0.502)),
        ("RGB", quad(HALF, appearance=pixel % "3 0x3366CC"), (0.2, 0.2, 0.4)),
        ("RGBA", quad(HALF, appearance=pixel % "4 0x3366CC80"), (0.1004, 0.1004, 0.2008, 0.502)),
    ))


@suite.case
def plugs():
    "texture_color with and without the sampler, for every kind of texture"
    cases = []
    for name, texture, sampler, read in (
            ("2D", FIELD, "sampler2D", "texture2D(tex, tex_coord.st)"),
            ("3D", VOLUME, "sampler3D", "texture3D(tex, tex_coord.stp)"),
            ("cube", CUBE, "samplerCube", "textureCube(tex, tex_coord.stp)")):
        cases.append((name + ", without", quad(WHITE, appearance="texture " + texture % effects(
            texture_effect("{ texture_color.rgb = texture_color.bgr; }"))), (0.8, 0.4, 0.2)))
        cases.append((name + ", with", quad(WHITE, appearance="texture " + texture % effects(
            texture_effect("{ texture_color.rgb = 1.0 - %s.rgb; }" % read, sampler))),
            (0.8, 0.6, 0.2)))
        cases.append((name + ", of the shape", quad(WHITE, texture_effect(
            "{ texture_color.rgb = 0.5 * %s.rgb; }" % read, sampler),
            "texture " + texture % ""), (0.1, 0.2, 0.4)))
    check_all(cases)


@suite.case
def shift():
    "texture_coord_shift moves the coordinates before the first texture is sampled"
    two = "PixelTexture { image 2 1 3 0xFF0000 0x00FF00 repeatS FALSE textureProperties TextureProperties { magnificationFilter \"NEAREST\" minificationFilter \"NEAREST\" boundaryModeS \"CLAMP\" boundaryModeT \"CLAMP\" } %s }"
    move = effect("void PLUG_texture_coord_shift(inout vec2 tex_coord) { tex_coord.s += 0.5; }")
    check_all((
        ("not moved", quad(WHITE, appearance="texture " + two % ""), (1, 0, 0)),
        ("moved", quad(WHITE, move, "texture " + two % ""), (0, 1, 0)),
        ("and seen by effects on the texture", quad(WHITE, move, "texture " + two % effects(
            texture_effect(SHOW))), (S + 0.5, T, 0.25)),
        ("the second unit stays", quad(WHITE, move, "texture MultiTexture { mode [ \"REPLACE\" \"ADD\" ] "
                                       f"texture [ {two % ''} {two % ''} ] }}"), (1, 1, 0)),
        ("cubes stay", quad(WHITE, move, "texture " + CUBE % ""), COLOR),
    ))


@suite.case
def instances():
    "one texture in two units is two instances, each with its own effects and uniforms"
    scaled = effect("uniform float factor;\nvoid PLUG_texture_color(inout vec4 texture_color,"
                    " const in vec4 tex_coord) { texture_color.rgb *= factor; }",
                    "inputOutput SFFloat factor .5")
    other = scaled.replace("factor .5", "factor .25")
    multi = "texture MultiTexture { mode [ \"REPLACE\" \"ADD\" ] texture [ %s %s ] }"
    first = "DEF IMAGE_%d " + FIELD % effects(scaled)
    check_all((
        ("USE", quad(WHITE, appearance=multi % (first % 1, "USE IMAGE_1")), COLOR),
        ("different values", quad(WHITE, appearance=multi % (first % 2, FIELD % effects(other))),
         [0.75 * c for c in COLOR]),
        ("one alone", quad(WHITE, appearance=multi % (FIELD % effects(scaled), FIELD % "")),
         [1.5 * c for c in COLOR]),
        ("both and the shape's", quad(WHITE, texture_effect("{ texture_color.rgb *= 0.5; }"),
                                      multi % (first % 3, "USE IMAGE_3")), [0.5 * c for c in COLOR]),
        ("the MultiTexture's", quad(WHITE, appearance="texture MultiTexture { effects [ "
                                    + texture_effect("{ texture_color.rgb *= 0.25; }")
                                    + f" ] mode [ \"REPLACE\" \"ADD\" ] texture [ {FIELD % ''} {FIELD % ''} ] }}"),
         [0.5 * c for c in COLOR]),
    ))


@suite.case
def reaching():
    "an effect on a texture may use the plugs of the shape, in both stages"
    code = effect_parts((
        ("VERTEX", "varying float height;\nvoid PLUG_vertex_object_space(const in vec4 v, inout vec3 n)"
                   "{ height = v.y; }"),
        ("FRAGMENT", "varying float height;\n"
                     "void PLUG_fragment_modify(inout vec4 color) { color.r = height + 0.5; }\n"
                     "void PLUG_texture_color(inout vec4 c, const in vec4 t) { c.b = 0.5; }")))
    check_all((("", quad(WHITE, appearance="texture " + FIELD % effects(code)), (T, 0.4, 0.5)),))


@suite.case
def samplers_of_effects():
    "textures of all kinds as fields of an effect"
    kinds = (("sampler2D", FIELD % "", "texture2D(image, vec2(0.5))"),
             ("sampler3D", VOLUME % "", "texture3D(image, vec3(0.5))"),
             ("samplerCube", CUBE % "", "textureCube(image, vec3(0.0, 0.0, 1.0))"))
    check_all(tuple(
        (sampler, quad(WHITE, effect(
            f"uniform {sampler} image;\nvoid PLUG_fragment_modify(inout vec4 c) {{ c.rgb = {read}.bgr; }}",
            "inputOutput SFNode image " + texture)), (0.8, 0.4, 0.2))
        for sampler, texture, read in kinds))


# ---- Textures of materials

DIRECTION = "DirectionalLight { direction 0 0 -1 ambientIntensity 1 intensity .5 }\n"
PHONG = ("Material {{ diffuseColor .6 .4 .2 specularColor .5 .5 .5 shininess .25 ambientIntensity .5 "
         "emissiveColor .1 .2 .3 {} }}")


def phong(diffuse=(0.6, 0.4, 0.2), specular=(0.5,) * 3, ambient=None, emissive=(0.1, 0.2, 0.3),
          scale=1.0):
    ambient = ambient or [0.5 * d for d in diffuse]
    shine = blinn_phong((0, 0, 1), (0, 0, 1), (0, 0, 1), diffuse, specular, 32)
    return tuple(e + scale * (a + 0.5 * s) for e, a, s in zip(emissive, ambient, shine))


def times(a, b):
    return tuple(x * y for x, y in zip(a, b))


@suite.case
def material_textures():
    "each texture of a Material changes its own part of the light"
    image = "%sTexture " + FIELD % ""
    alpha = "%sTexture PixelTexture { image 1 1 4 0xFFFFFF80 }"
    tilted = "Transform { rotation 0 1 0 .3 children [ %s ] }\n"
    check_all((
        ("none", DIRECTION + quad(PHONG.format("")), phong()),
        ("diffuse", DIRECTION + quad(PHONG.format(image % "diffuse")),
         phong(diffuse=times((0.6, 0.4, 0.2), COLOR))),
        ("ambient", DIRECTION + quad(PHONG.format(image % "ambient")),
         phong(ambient=times((0.3, 0.2, 0.1), COLOR))),
        ("specular", DIRECTION + quad(PHONG.format(image % "specular")),
         phong(specular=times((0.5,) * 3, COLOR))),
        ("emissive", DIRECTION + quad(PHONG.format(image % "emissive")),
         phong(emissive=times((0.1, 0.2, 0.3), COLOR))),
        ("occlusion: red", DIRECTION + quad(PHONG.format(image % "occlusion")), phong(scale=0.2)),
        ("occlusion, one half", DIRECTION + quad(PHONG.format(
            "occlusionStrength .5 " + image % "occlusion")), phong(scale=0.6)),
        ("unlit", quad("UnlitMaterial { emissiveColor 1 .5 .5 emissiveTexture " + FIELD % "" + " }"),
         (0.2, 0.2, 0.4)),
        ("the Appearance's, beside another", DIRECTION + quad(
            PHONG.format(image % "emissive"), appearance="texture " + FIELD % ""),
         phong(diffuse=times((0.6, 0.4, 0.2), COLOR), emissive=times((0.1, 0.2, 0.3), COLOR))),
        ("diffuse hides the Appearance's", DIRECTION + quad(
            PHONG.format(image % "diffuse"), appearance="texture PixelTexture { image 1 1 3 0xFF0000 }"),
         phong(diffuse=times((0.6, 0.4, 0.2), COLOR))),
    ))
    row = Row(suite)
    row.add(DIRECTION + tilted % quad(PHONG.format(alpha % "shininess")))
    row.add(DIRECTION + tilted % quad(PHONG.format("").replace(
        "shininess .25", f"shininess {0.25 * 128 / 255}")))
    row.add(DIRECTION + tilted % quad(PHONG.format("")))
    got = row.draw()
    suite.close("shininess: alpha", got[0], got[1], 1e-4)
    suite.check("which is another exponent", abs(got[0][0] - got[2][0]) > 0.01, got)



@suite.case
def physical_textures():
    "textures of a PhysicalMaterial: the same as other numbers in its fields; colours are decoded"
    tilted = DIRECTION.replace("0 0 -1", "0 -.5 -1") + "Transform { rotation 0 1 0 .3 children [ %s ] }\n"
    plain = "PhysicalMaterial { baseColor .8 .6 .4 emissiveColor .2 .3 .4 metallic %s roughness %s %s }"
    pixel = "%sTexture PixelTexture { image 1 1 3 0x336699 }"
    decoded = [(v / 255) ** 2.2 for v in (0x33, 0x66, 0x99)]

    def colors(field, base):
        return f"{field} " + " ".join(repr(b * d) for b, d in zip(base, decoded))

    pairs = (
        ("metallic and roughness", plain % (0.9, 0.8, pixel % "metallicRoughness"),
         plain % (0.9 * 0x99 / 255, 0.8 * 0x66 / 255, "")),
        ("base", plain % (0.5, 0.5, pixel % "base"),
         (plain % (0.5, 0.5, "")).replace("baseColor .8 .6 .4", colors("baseColor", (0.8, 0.6, 0.4)))),
        ("emissive", plain % (0.5, 0.5, pixel % "emissive"),
         (plain % (0.5, 0.5, "")).replace("emissiveColor .2 .3 .4", colors("emissiveColor", (0.2, 0.3, 0.4)))),
    )
    row = Row(suite)
    for _, textured, numbers in pairs:
        row.add(tilted % quad(textured))
        row.add(tilted % quad(numbers))
    row.add(tilted % quad(plain % (0.9, 0.8, "")))
    got = row.draw()
    for i, (name, _, _) in enumerate(pairs):
        suite.close(name, got[2 * i], got[2 * i + 1], 1e-4)
    suite.check("which is not what it is without", abs(got[0][0] - got[-1][0]) > 0.01, got)
    row = Row(suite)
    row.add(DIRECTION + quad(plain % (0, 1, "occlusionStrength 1 occlusionTexture PixelTexture "
                                      "{ image 1 1 3 0x000000 }")))
    suite.close("no light arrives: emissive alone", row.draw()[0],
                [c ** (1 / 2.2) for c in (0.2, 0.3, 0.4)] + [1], 2e-3)


@suite.case
def common_surface_shader():
    "CommonSurfaceShader: factors and textures, in place of the material"
    def shader(fields):
        return ("shaders CommonSurfaceShader { diffuseFactor .6 .4 .2 specularFactor .5 .5 .5 "
                "shininessFactor .25 ambientFactor .3 .2 .1 emissiveFactor .1 .2 .3 " + fields + " }")

    red = "Material { diffuseColor 1 0 0 }"
    check_all((
        ("factors", DIRECTION + quad(red, appearance=shader("")), phong()),
        ("diffuse", DIRECTION + quad(red, appearance=shader("diffuseTexture " + FIELD % "")),
         phong(diffuse=times((0.6, 0.4, 0.2), COLOR), ambient=(0.3, 0.2, 0.1))),
        ("diffuse and alpha in one", DIRECTION + quad(red, appearance=shader(
            "multiDiffuseAlphaTexture " + FIELD % "")),
         phong(diffuse=times((0.6, 0.4, 0.2), COLOR), ambient=(0.3, 0.2, 0.1))),
        ("the Appearance's", DIRECTION + quad(red, appearance=shader("") + " texture " + FIELD % ""),
         phong(diffuse=times((0.6, 0.4, 0.2), COLOR), ambient=(0.3, 0.2, 0.1))),
        ("ambient", DIRECTION + quad(red, appearance=shader("ambientTexture " + FIELD % "")),
         phong(ambient=times((0.3, 0.2, 0.1), COLOR))),
        ("specular", DIRECTION + quad(red, appearance=shader("specularTexture " + FIELD % "")),
         phong(specular=times((0.5,) * 3, COLOR))),
        ("emissive", DIRECTION + quad(red, appearance=shader("emissiveTexture " + FIELD % "")),
         phong(emissive=times((0.1, 0.2, 0.3), COLOR))),
        ("alphaFactor", DIRECTION + quad(red, appearance=shader("alphaFactor .25")),
         [0.25 * c for c in phong()] + [0.25]),
    ))


@suite.case
def too_many_samplers():
    "an effect with more textures than a program can read is left out, with an error at the sampler"
    count = 200
    fields = " ".join(f"inputOutput SFNode i{k} {FIELD % ''}" for k in range(count))
    code = ("\n".join(f"uniform sampler2D i{k};" for k in range(count))
            + "\nvoid PLUG_fragment_modify(inout vec4 c) { c.r = "
            + " + ".join(f"texture2D(i{k}, vec2(0.5)).r" for k in range(count)) + "; }")
    green = effect("void PLUG_fragment_end(inout vec4 c) { c.g = 1.0; }")
    text = front_scene(quad(WHITE, effect(code, fields) + green, "texture " + FIELD % ""))
    result = suite.render(text, "--probe", "8,8", status=1)
    suite.close("the rest is drawn", [float(w) for w in result.output.split()], (0.2, 1, 0.8, 1), 2e-3)
    lines = text.splitlines()
    errors = result.with_code("limit")
    suite.check("an error at a sampler", len(errors) == 1 and "uniform sampler2D i" in lines[errors[0][1] - 1],
                result.errors)


suite.run()
