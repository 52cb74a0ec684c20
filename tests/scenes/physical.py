#!/usr/bin/env python3
"""PhysicalMaterial, gamma and tone mapping against the formulas of glTF 2.0, appendix B."""

import math

from harness import Suite, unit
from physical_data import reflection
from scenes import Row, effect, quad

suite = Suite()

L = unit((-1, 1, 2))
LIGHT = "DirectionalLight { direction 1 -1 -2 ambientIntensity .5 intensity 2 color 1 .5 .25 }\n"
COLOR = (2, 1, 0.5)


def gamma(rgb, alpha=1.0):
    return [max(c, 0) ** (1 / 2.2) * alpha for c in rgb] + [alpha]


def physical(base=(0.6, 0.4, 0.2), metallic=0.0, roughness=0.5, emissive=(0, 0, 0), **more):
    rgb = [e + i * r for e, i, r in
           zip(emissive, COLOR, reflection(base, metallic, roughness, L, **more))]
    return gamma(rgb)


def node(fields="metallic 0 roughness .5"):
    return "PhysicalMaterial { baseColor .6 .4 .2 %s }" % fields


def check_all(cases, head=""):
    row = Row(suite)
    for _, content, _ in cases:
        row.add(content)
    for (name, _, expected), got in zip(cases, row.draw(head=head)):
        suite.close(name, got, expected, 2e-4)


@suite.case
def light():
    "metallic and roughness under one light"
    check_all(tuple(
        (f"metallic {m}, roughness {r}",
         LIGHT + quad(node(f"metallic {m} roughness {r}")), physical(metallic=m, roughness=r))
        for m, r in ((0, 0.5), (1, 0.5), (0.25, 0.75), (1, 1), (0, 0.3), (0.5, 0.2))) + (
        ("two lights add up", LIGHT + LIGHT + quad(node()),
         gamma([2 * i * r for i, r in zip(COLOR, reflection((0.6, 0.4, 0.2), 0, 0.5, L))])),
        ("from behind: nothing, not even ambient light",
         LIGHT.replace("1 -1 -2", "0 0 1") + quad(node()), (0, 0, 0, 1)),
        ("tilted", LIGHT + "Transform { rotation 0 1 0 .5 children [ %s ] }" % quad(node()),
         physical(n=(math.sin(0.5), 0, math.cos(0.5)))),
        ("no light: emissive colour alone", quad(node("emissiveColor .1 .2 .3")),
         gamma((0.1, 0.2, 0.3))),
        ("transparent", quad(node("emissiveColor .1 .2 .3 transparency .75")),
         gamma((0.1, 0.2, 0.3), 0.25)),
        ("no Phong beside it is made linear", LIGHT + quad("UnlitMaterial { emissiveColor .1 .2 .3 }"),
         (0.1, 0.2, 0.3, 1)),
    ))


@suite.case
def mirror():
    "a perfect mirror shows no point of light, and is a number"
    row = Row(suite)
    row.add(LIGHT + quad(node("metallic 1 roughness 0")))
    suite.close("", row.draw()[0], (0, 0, 0, 1), 0.01)


@suite.case
def plugs():
    "material_metallic_roughness, main_texture_apply, occlusion, emissive, light_scale"
    check_all((
        ("material_metallic_roughness", LIGHT + quad(node(), effect(
            "void PLUG_material_metallic_roughness(inout float metallic, inout float roughness)"
            "{ metallic += 0.5; roughness *= 0.5; }")), physical(metallic=0.5, roughness=0.25)),
        ("main_texture_apply: the base colour", LIGHT + quad(node(), effect(
            "void PLUG_main_texture_apply(inout vec4 c, const in vec3 n) { c.rgb = c.bgr; }")),
         physical(base=(0.2, 0.4, 0.6))),
        ("material_occlusion", LIGHT + quad(node("metallic 0 roughness .5 emissiveColor .1 .1 .1"), effect(
            "void PLUG_material_occlusion(inout vec4 c) { c.rgb *= 0.5; }")),
         gamma([0.1 + 0.5 * i * r for i, r in zip(COLOR, reflection((0.6, 0.4, 0.2), 0, 0.5, L))])),
        ("material_emissive", LIGHT + quad(node(), effect(
            "void PLUG_material_emissive(inout vec3 e) { e += vec3(0.1, 0.0, 0.2); }")),
         physical(emissive=(0.1, 0, 0.2))),
        ("light_scale", LIGHT + quad(node(), effect(
            "void PLUG_light_scale(inout float s, const in vec3 n, const in vec3 l) { s *= 0.0; }")),
         (0, 0, 0, 1)),
        ("fragment_modify is before gamma, fog_apply after it", quad(node(), effect(
            "void PLUG_fragment_modify(inout vec4 c) { c.rgb = vec3(0.5); }\n"
            "void PLUG_fog_apply(inout vec4 c, const in vec3 n) { c.g = 0.5; }")),
         (0.5 ** (1 / 2.2), 0.5, 0.5 ** (1 / 2.2), 1)),
    ))


@suite.case
def textures():
    "a texture is made linear before it meets the base colour"
    texture = "texture PixelTexture { repeatS FALSE repeatT FALSE image 1 1 3 0x3366CC }"
    base = [b * t**2.2 for b, t in zip((0.6, 0.4, 0.2), (0.2, 0.4, 0.8))]
    check_all((
        ("base colour", LIGHT + quad(node(), appearance=texture), physical(base=base)),
        ("not for other materials", quad("UnlitMaterial { }", appearance=texture),
         (0.2, 0.4, 0.8, 1)),
    ))


def uncharted(x):
    def curve(v):
        a, b, c, d, e, f = 0.15, 0.5, 0.1, 0.2, 0.02, 0.3
        return (v * (a * v + c * b) + d * e) / (v * (a * v + b) + d * f) - e / f
    return curve(2 * x) / curve(11.2)


def hejl(x):
    x = max(x - 0.004, 0)
    return x * (6.2 * x + 0.5) / (x * (6.2 * x + 1.7) + 0.06)


def aces(x):
    return min(max(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0), 1)


@suite.case
def tone_mapping():
    "ToneMapping: each curve, the exposure, the order of tone mapping and gamma"
    curves = {"UNCHARTED": uncharted, "HEJL_RICHARD": hejl, "REINHARD": lambda x: x / (1 + x),
              "ACES": aces}
    color = (0.2, 0.5, 1.0)
    bright = "void PLUG_fragment_modify(inout vec4 c) { c.rgb *= 4.0; }"
    for mode, curve in curves.items():
        head = f'ToneMapping {{ mode "{mode}" exposure .5 }}\nToneMapping {{ exposure 100 }}\n'
        linear = [curve(2 * c) for c in color]
        twice = linear + [1] if mode == "HEJL_RICHARD" else gamma(linear)
        check_all((
            (mode, quad("UnlitMaterial { emissiveColor .2 .5 1 }", effect(bright)), linear + [1]),
            (f"{mode}, then gamma", quad("PhysicalMaterial { emissiveColor .2 .5 1 }", effect(bright)),
             twice),
        ), head)
    result = suite.render(
        '#X3D V4.0 utf8\nPROFILE Full\nToneMapping { mode "SEPIA" }\nShape { geometry Box { } }\n',
        "-o", "a.png", status=None)
    suite.equal("an unknown mode is told at its place",
                [(m[1], m[2], m[5]) for m in result.messages()], [(3, 15, "bad-value")])


suite.run()
