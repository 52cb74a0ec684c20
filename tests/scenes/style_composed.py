#!/usr/bin/env python3
"""Styles in lists: the composition of their functions; what is not in a list is not in the program."""

import math
import os

from harness import Suite, blinn_phong, dot, unit
from physical_data import reflection
from scenes import Row, constant, front_scene, volume
from style_data import (OPACITY, SLOPE, TINT, VIEW, Styles, boundary, cartoon, composed, edge,
                        magnitude, normal_of, silhouette, tone)

suite = Suite()

UNIT = 1.25
CHANGE = magnitude(SLOPE) * UNIT
NORMAL = normal_of(SLOPE)
FACING = dot(NORMAL, VIEW)
LIGHT = "DirectionalLight { direction 1 -2 -3 }\n"

# Styles as text and as functions of colour and opacity.
HALVES = ("BoundaryEnhancementVolumeStyle { retainedOpacity .3 boundaryOpacity .4 opacityFactor 1 }",
          lambda c, a: (c, boundary(a, CHANGE, 0.3, 0.4, 1)))
GROWS = ("BoundaryEnhancementVolumeStyle { retainedOpacity 1 boundaryOpacity 8 opacityFactor .5 }",
         lambda c, a: (c, boundary(a, CHANGE, 1, 8, 0.5)))
EDGES = ("SilhouetteEnhancementVolumeStyle { silhouetteRetainedOpacity .6 silhouetteBoundaryOpacity .5 "
         "silhouetteSharpness 2 }", lambda c, a: (c, silhouette(a, FACING, 0.6, 0.5, 2)))
RED = ("EdgeEnhancementVolumeStyle { edgeColor 1 0 0 1 }",
       lambda c, a: (edge(c, FACING, (1, 0, 0)), a))
GREEN = ("EdgeEnhancementVolumeStyle { edgeColor 0 1 0 1 gradientThreshold .1 }",
         lambda c, a: (edge(c, FACING, (0, 1, 0), 0.1), a))
FLAT = ("CartoonVolumeStyle { orthogonalColor .9 .4 .2 1 parallelColor .1 .3 .8 .5 colorSteps 5 }",
        lambda c, a: flat_of(a))
LIT = ("ShadedVolumeStyle { lighting TRUE }",
       lambda c, a: (blinn_phong(NORMAL, (-1, 2, 3), VIEW, c, (0, 0, 0), 1), a))
SHINY = ("ShadedVolumeStyle { lighting TRUE material Material { diffuseColor .3 .5 .1 specularColor .5 .4 .3 "
         "shininess .1 transparency .25 } }",
         lambda c, a: (blinn_phong(NORMAL, (-1, 2, 3), VIEW, (0.3, 0.5, 0.1), (0.5, 0.4, 0.3), 12.8), 0.75 * a))
METAL = ("ShadedVolumeStyle { lighting TRUE material PhysicalMaterial { baseColor .6 .4 .2 metallic .5 "
         "roughness .6 } }",
         lambda c, a: ([r ** (1 / 2.2) for r in reflection((0.6, 0.4, 0.2), 0.5, 0.6, unit((-1, 2, 3)), NORMAL)], a))
WARM = ("ToneMappedVolumeStyle { warmColor .5 .4 .3 1 }",
        lambda c, a: (tone(NORMAL, [(-1, 2, 3)], warm=(0.5, 0.4, 0.3)), a))


def flat_of(alpha):
    *rgb, share = cartoon(math.acos(FACING), 5, (0.9, 0.4, 0.2, 1), (0.1, 0.3, 0.8, 0.5))
    return tuple(rgb), alpha * share


def compose(members):
    color, alpha = TINT, OPACITY
    for _, function in members:
        color, alpha = function(color, alpha)
    return color, alpha


def add(styles, name, members, text=None):
    styles.add(name, text or composed(*(m[0] for m in members)), *compose(members), lights=LIGHT,
               fields=f"gradientUnit {UNIT}")


@suite.case
def twice():
    "T9: the same style twice, each with its own values"
    styles = Styles(suite)
    add(styles, "red edges, green edges", (RED, GREEN))
    add(styles, "green edges, red edges", (GREEN, RED))
    add(styles, "boundaries twice", (HALVES, GROWS))
    add(styles, "clamped in between", (GROWS, HALVES))
    add(styles, "four times", (HALVES, RED, HALVES, RED))
    styles.draw()


@suite.case
def orders():
    "any order is the composition of functions"
    styles = Styles(suite)
    for name, members in (("flat, edges, red", (FLAT, EDGES, RED)), ("red, flat, edges", (RED, FLAT, EDGES)),
                          ("warm, red", (WARM, RED)), ("red, warm", (RED, WARM)),
                          ("warm, flat, green", (WARM, FLAT, GREEN))):
        add(styles, name, members)
    nested = composed(composed(RED[0], HALVES[0]), FLAT[0], composed(composed(GREEN[0])))
    add(styles, "lists in lists", (RED, HALVES, FLAT, GREEN), nested)
    styles.draw()


@suite.case
def lit():
    "styles that meet light each in its own way, under the same light"
    styles = Styles(suite)
    for name, members in (("lit twice", (LIT, LIT)), ("warm, lit", (WARM, LIT)), ("lit, red, lit", (LIT, RED, LIT)),
                          ("shiny, metal, warm, red", (SHINY, METAL, WARM, RED)),
                          ("warm, metal, lit", (WARM, METAL, LIT)), ("two warm ones", (WARM, RED, WARM))):
        add(styles, name, members)
    styles.draw()


@suite.case
def many():
    "T9: three, eight and sixteen styles"
    some = (RED, EDGES, FLAT, GREEN, WARM, RED, EDGES, GREEN)
    styles = Styles(suite)
    for members in (some[:3], some, some + some):
        add(styles, f"{len(members)} styles", members)
    styles.draw()


ALL = {
    "BoundaryEnhancementVolumeStyle": "",
    "CartoonVolumeStyle": "",
    "EdgeEnhancementVolumeStyle": "",
    "ShadedVolumeStyle": "lighting TRUE shadows TRUE material Material { }",
    "SilhouetteEnhancementVolumeStyle": "",
    "StippleVolumeStyle": "",
    "ToneMappedVolumeStyle": "",
    "OpacityMapVolumeStyle": "transferFunction PixelTexture { image 1 1 4 0xFF000080 }",
}


@suite.case
def bare():
    "T8: every style without lights, material, gradient, or enabled: drawn or not, never an error"
    flat = constant(51, (4, 4, 4))
    drawn, disabled = Row(suite), Row(suite)
    for name, fields in ALL.items():
        lighting = "lighting TRUE" if name == "ShadedVolumeStyle" else ""
        drawn.add(volume(flat, f"{name} {{ {lighting} }}"))
        disabled.add(volume(flat, f"{name} {{ enabled FALSE {fields} }}"))
    for name, pixel, nothing in zip(ALL, drawn.draw(), disabled.draw()):
        suite.check(f"{name}: numbers", all(0 <= n <= 1 for n in pixel), pixel)
        suite.close(f"{name} disabled", nothing, (0, 0, 0, 0), 0)


def origins(style):
    """The files of effects/ of which a line is in the program."""
    text = front_scene(LIGHT, volume(constant(9, (2, 2, 2)), style))
    result = suite.command("dump", "scene.x3dv", "-d", "programs", files={"scene.x3dv": text})
    folder = os.path.join(result.folder, "programs")
    found = set()
    for name in os.listdir(folder):
        if name.endswith(".frag.map"):
            with open(os.path.join(folder, name), encoding="utf-8") as lines:
                found |= {os.path.basename(line.split("\t")[1].split(":")[0]) for line in lines}
    return found


@suite.case
def nothing_else():
    "a scene without a style composes a program without a line of it"
    for missing in ALL:
        rest = [f"{name} {{ {fields} }}" for name, fields in ALL.items() if name != missing]
        found = origins(composed(*rest))
        suite.check(f"without {missing}", f"{missing}.glsl" not in found, found)
        suite.check("the others are there", all(f"{n}.glsl" in found for n in ALL if n != missing), found)


suite.run()
