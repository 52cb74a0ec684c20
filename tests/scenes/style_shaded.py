#!/usr/bin/env python3
"""ShadedVolumeStyle: materials of every kind, emissive light, what scatters where there is no gradient."""

import math

from harness import Suite, blinn_phong, dot, unit
from physical_data import reflection
from scenes import constant
from style_data import OPACITY, SLOPE, TINT, VIEW, Styles, composed, normal_of

suite = Suite()

NORMAL = normal_of(SLOPE)
FROM = (1, -2, -3)
TO_LIGHT = unit((-1, 2, 3))
FLAT = constant(100, (8, 8, 8))


def directional(direction=FROM, fields=""):
    return f"DirectionalLight {{ direction {' '.join(map(str, direction))} {fields} }}\n"


def shaded(material="", fields="lighting TRUE"):
    return f"ShadedVolumeStyle {{ {fields} {f'material {material}' if material else ''} }}"


@suite.case
def emissive():
    "T7: emissive light once, however many lights there are"
    styles = Styles(suite)
    style = shaded("Material { diffuseColor 0 0 0 emissiveColor .2 .3 .1 }")
    for count in (0, 1, 3):
        styles.add(f"{count} lights", style, (0.2, 0.3, 0.1), OPACITY, lights=directional() * count)
    styles.draw()


@suite.case
def material_fields():
    "each field of a Material"
    styles = Styles(suite)
    base = {"diffuseColor": (0.6, 0.4, 0.2), "specularColor": (0.1, 0.2, 0.3), "emissiveColor": (0, 0, 0),
            "shininess": (0.1,), "ambientIntensity": (0.5,), "transparency": (0,)}
    for field, value in (("diffuseColor", (0.1, 0.5, 0.3)), ("specularColor", (0.4, 0.1, 0)),
                         ("emissiveColor", (0.1, 0.2, 0)), ("shininess", (0.02,)),
                         ("ambientIntensity", (1,)), ("transparency", (0.25,)), ("transparency", (1,))):
        now = {**base, field: value}
        text = " ".join(f"{f} {' '.join(map(str, v))}" for f, v in now.items())
        shine = blinn_phong(NORMAL, TO_LIGHT, VIEW, now["diffuseColor"], now["specularColor"],
                            128 * now["shininess"][0])
        rgb = [e + s + 0.3 * now["ambientIntensity"][0] * d for e, s, d in
               zip(now["emissiveColor"], shine, now["diffuseColor"])]
        styles.add(f"{field} {value}", shaded(f"Material {{ {text} }}"), rgb,
                   OPACITY * (1 - now["transparency"][0]), lights=directional(fields="ambientIntensity .3"))
    styles.draw()


@suite.case
def flat():
    "lighting FALSE: the colour as it is, or the material's"
    styles = Styles(suite)
    for material, rgb, alpha in (
        ("", TINT, 1),
        ("Material { diffuseColor .1 .2 .3 emissiveColor 1 1 1 transparency .5 }", (0.1, 0.2, 0.3), 0.5),
        ("UnlitMaterial { emissiveColor .4 .3 .2 transparency .25 }", (0.4, 0.3, 0.2), 0.75),
        ("PhysicalMaterial { baseColor .4 .3 .2 transparency .5 }",
         [c ** (1 / 2.2) for c in (0.4, 0.3, 0.2)], 0.5),
    ):
        styles.add(material or "no material", shaded(material, ""), rgb, OPACITY * alpha,
                   lights=directional())
    styles.draw()


@suite.case
def other_materials():
    "UnlitMaterial, TwoSidedMaterial and PhysicalMaterial, lit"
    styles = Styles(suite)
    styles.add("UnlitMaterial", shaded("UnlitMaterial { emissiveColor .4 .3 .2 transparency .25 }"),
               (0.4, 0.3, 0.2), 0.75 * OPACITY, lights=directional())
    styles.add("TwoSidedMaterial",
               shaded("TwoSidedMaterial { diffuseColor .6 .4 .2 backDiffuseColor 1 0 0 }"),
               blinn_phong(NORMAL, TO_LIGHT, VIEW, (0.6, 0.4, 0.2), (0, 0, 0), 1), OPACITY,
               lights=directional())
    for metallic, roughness in ((0, 0.5), (1, 0.4), (0.3, 0.8)):
        light = reflection((0.6, 0.4, 0.2), metallic, roughness, TO_LIGHT, NORMAL)
        styles.add(f"PhysicalMaterial, metallic {metallic}, roughness {roughness}",
                   shaded(f"PhysicalMaterial {{ baseColor .6 .4 .2 metallic {metallic} "
                          f"roughness {roughness} emissiveColor .1 0 .05 }}"),
                   [(2 * r + e) ** (1 / 2.2) for r, e in zip(light, (0.1, 0, 0.05))], OPACITY,
                   lights=directional(fields="intensity 2 ambientIntensity 1"))
    styles.draw(tolerance=2e-4)


# So thin that a shadow of the volume itself, where light is cast, stays below what is asked of colours.
THIN = 1e-4


def henyey_greenstein(cosine, g):
    """Times 4 pi: 1 in all directions where g is 0."""
    return (1 - g * g) / (1 + g * g - 2 * g * cosine) ** 1.5


class Scattering:
    """Colours of a constant volume: the same on all that is seen, over what is seen."""

    def __init__(self):
        self.styles = Styles(suite)
        self.expected = []

    def add(self, name, style, rgb, lights, **options):
        self.styles.add(name, style, rgb, THIN, opacity=THIN, lights=lights,
                        **{"data": FLAT, **options})
        self.expected.append((name, rgb))

    def draw(self):
        pixels = self.styles.row.draw(files=self.styles.files)
        for (name, expected), pixel in zip(self.expected, pixels):
            suite.close(name, [c / THIN for c in pixel], tuple(expected) + (1,), 3e-3)


SHADOWS = "lighting TRUE shadows TRUE"


@suite.case
def scattering():
    "with shadows and a phase function samples without gradient scatter light"
    rows = Scattering()
    ambient = [0.2 * 0.5 * t for t in TINT]
    lit = [a + t for a, t in zip(ambient, TINT)]
    light = directional(fields="ambientIntensity .5")
    rows.add("the default phase function", shaded(fields=SHADOWS), lit, light)
    rows.add("no phase function", shaded(fields=SHADOWS + ' phaseFunction "NONE"'), ambient, light)
    rows.add("no shadows", shaded(), ambient, light)
    rows.add("no lighting", shaded(fields="shadows TRUE"), TINT, light)
    style = shaded("Material { diffuseColor .6 .4 .2 emissiveColor .1 .1 .1 specularColor 1 1 1 "
                   "ambientIntensity 0 }", SHADOWS)
    rows.add("a material, light of a colour", style, [0.1 + d * c for d, c in zip((0.6, 0.4, 0.2), (1, 0.5, 0))],
             directional(fields="color 1 .5 0"))
    rows.add("two lights", style, [0.1 + 0.8 * d for d in (0.6, 0.4, 0.2)],
             directional(fields="intensity .4") * 2)
    rows.add("no light", style, (0.1, 0.1, 0.1), "")
    rows.draw()


@suite.case
def phase_function():
    "the phase function of Henyey and Greenstein by phaseAnisotropy"
    rows = Scattering()
    for g in (0.5, -0.7):
        for direction in ((0, 0, 1), (0, 0, -1), (1, 0, 0), (1, -2, -3)):
            cosine = dot(unit(direction), VIEW)
            rows.add(f"g {g}, from {direction}", shaded(fields=f"{SHADOWS} phaseAnisotropy {g}"),
                     [t * henyey_greenstein(cosine, g) * 0.05 for t in TINT],
                     directional(direction, "intensity .05"))
    rows.draw()
    turns = 1000
    mean = sum(henyey_greenstein(math.cos((i + 0.5) * math.pi / turns), 0.5)
               * math.sin((i + 0.5) * math.pi / turns) for i in range(turns)) * math.pi / turns / 2
    suite.close("light is neither gained nor lost", mean, 1, 1e-3)


@suite.case
def surfaces_reflect():
    "where there is a gradient light is reflected, phase function or not"
    rows = Scattering()
    rows.add("", shaded(fields=SHADOWS), blinn_phong(NORMAL, TO_LIGHT, VIEW, TINT, (0, 0, 0), 1),
             directional(), data=None)
    rows.draw()


@suite.case
def after_another_style():
    "the colour that a style before made is what is lit"
    styles = Styles(suite)
    styles.add("", composed("CartoonVolumeStyle { colorSteps 1 orthogonalColor .3 .6 .9 .5 }", shaded()),
               blinn_phong(NORMAL, TO_LIGHT, VIEW, (0.3, 0.6, 0.9), (0, 0, 0), 1), OPACITY / 2,
               lights=directional())
    styles.draw()


suite.run()
