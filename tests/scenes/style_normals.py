#!/usr/bin/env python3
"""The field surfaceNormals: a texture of normals that each style has for itself."""

import math

from harness import Suite, blinn_phong, dot, rotate, unit
from scenes import constant, voxels
from style_data import (OPACITY, SLOPE, TINT, VIEW, Styles, cartoon, composed, edge, magnitude,
                        normal_of, silhouette, tone)
from style_data import boundary as boundary_of

suite = Suite()


def encoded(normal):
    """As eight bits, and what they mean: n = 2 t - 1."""
    texel = tuple(round((n + 1) / 2 * 255) for n in normal)
    return texel, unit(tuple(2 * t / 255 - 1 for t in texel))


def packed(texel):
    return sum(t << shift for t, shift in zip(texel, (16, 8, 0)))


def normals(texel, size=(1, 1, 1)):
    return f"surfaceNormals {constant(packed(texel), size, 3)}"


TEXEL, NORMAL = encoded(unit((0.6, -0.3, 0.5)))
FACING = dot(NORMAL, VIEW)
LIGHT = "DirectionalLight { direction 1 -2 -3 }\n"
TO_LIGHT = unit((-1, 2, 3))
SILHOUETTE = "silhouetteRetainedOpacity .1 silhouetteBoundaryOpacity .8"


def style_of(name, fields, texture):
    return f"{name} {{ {fields} {texture} }}"


def cases(texture, normal):
    """Every style that has the field: what it makes of a normal."""
    facing = dot(normal, VIEW)
    flat = cartoon(math.acos(facing), 6)
    yield ("SilhouetteEnhancementVolumeStyle", SILHOUETTE, TINT,
           silhouette(OPACITY, facing, 0.1, 0.8))
    yield ("EdgeEnhancementVolumeStyle", "edgeColor 1 0 0 1", edge(TINT, facing, (1, 0, 0)), OPACITY)
    yield "CartoonVolumeStyle", "colorSteps 6", flat[:3], OPACITY * flat[3]
    yield "ToneMappedVolumeStyle", "", tone(normal, [TO_LIGHT]), OPACITY
    yield ("ShadedVolumeStyle", "lighting TRUE",
           blinn_phong(normal, TO_LIGHT, VIEW, TINT, (0, 0, 0), 1), OPACITY)


@suite.case
def own_normals():
    "every style looks at its own normals"
    styles = Styles(suite)
    texture = normals(TEXEL)
    for name, fields, rgb, alpha in cases(texture, NORMAL):
        styles.add(name, style_of(name, fields, texture), rgb, alpha, lights=LIGHT)
    styles.draw()


@suite.case
def instead():
    "no normals, of too few components or dimensions: the gradient's are taken"
    styles = Styles(suite)
    two = f"surfaceNormals {constant(0x00FF, (1, 1, 1), 2)}"
    for texture in ("surfaceNormals NULL", two):
        for name, fields, rgb, alpha in list(cases(texture, normal_of(SLOPE)))[:3]:
            styles.add(f"{name} {texture[:19]}", style_of(name, fields, texture), rgb, alpha)
    styles.draw()


@suite.case
def boundary():
    "Boundary asks for magnitudes: normals say nothing to it"
    styles = Styles(suite)
    styles.add("", f"BoundaryEnhancementVolumeStyle {{ retainedOpacity .1 boundaryOpacity .8 {normals(TEXEL)} }}",
               TINT, boundary_of(OPACITY, 0.75, 0.1, 0.8), fields=f"gradientUnit {0.75 / magnitude(SLOPE)}")
    styles.draw()


@suite.case
def zero():
    "T18: a zero vector is no normal, whether 127 or 128 stands for 0"
    styles = Styles(suite)
    for texel in ((127, 127, 127), (128, 127, 128)):
        for name, fields, _, _ in cases("", NORMAL):
            rgb = TINT if name != "ShadedVolumeStyle" else (0, 0, 0)
            styles.add(f"{name} {texel}", style_of(name, fields, normals(texel)), rgb, OPACITY,
                       lights=LIGHT)
    styles.draw()


@suite.case
def each_its_own():
    "several styles in one list, each with normals of its own"
    other, there = encoded(unit((-0.2, 0.3, 0.9)))
    styles = Styles(suite)
    dark = silhouette(OPACITY, dot(there, VIEW), 0.1, 0.8)
    first = f"EdgeEnhancementVolumeStyle {{ edgeColor 1 0 0 1 {normals(TEXEL)} }}"
    second = f"SilhouetteEnhancementVolumeStyle {{ {SILHOUETTE} {normals(other)} }}"
    third = f"SilhouetteEnhancementVolumeStyle {{ {SILHOUETTE} }}"
    for name, members in (("", (first, second, third)), ("another order", (third, second, first))):
        styles.add(name or "three styles", composed(*members), edge(TINT, FACING, (1, 0, 0)),
                   silhouette(dark, dot(normal_of(SLOPE), VIEW), 0.1, 0.8))
    styles.draw()


@suite.case
def carried():
    "normals are of the volume's own coordinates: they turn, and stretch by the inverse transpose"
    styles = Styles(suite)
    tone_style = f"ToneMappedVolumeStyle {{ {normals(TEXEL)} }}"
    turned = rotate((0, 0, 1), 0.4, NORMAL)
    styles.add("turned", tone_style, tone(turned, [TO_LIGHT]), OPACITY, lights=LIGHT,
               around="Transform { rotation 0 0 1 .4")
    stretch = (0.8, 0.5, 1)
    normal = unit(tuple(n / s for n, s in zip(NORMAL, stretch)))
    styles.add("stretched", tone_style, tone(normal, [TO_LIGHT]), OPACITY, lights=LIGHT,
               around="Transform { scale .8 .5 1")
    styles.draw()


@suite.case
def interpolated():
    "normals of another size than the data's are interpolated in the box"
    left, right = encoded((1, 0, 0)), encoded((0, 0, 1))
    texture = f"surfaceNormals {voxels(3, (2, 1, 1), [packed(left[0]), packed(right[0])])}"
    # the pixel looks at x = -1/8, t = 3/8: a quarter of the way between the texels' centres
    share = (0.375 - 0.25) / 0.5
    between = unit(tuple(2 * (a + share * (b - a)) / 255 - 1 for a, b in zip(left[0], right[0])))
    styles = Styles(suite)
    styles.add("", f"ToneMappedVolumeStyle {{ {texture} }}", tone(between, [TO_LIGHT]), OPACITY,
               lights=LIGHT)
    styles.draw(tolerance=1e-3)


suite.run()
