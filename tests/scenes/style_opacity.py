#!/usr/bin/env python3
"""BoundaryEnhancementVolumeStyle and SilhouetteEnhancementVolumeStyle: what they do to the opacity."""

import math

from harness import Suite, dot, premultiplied, unit
from scenes import NO_HEADLIGHT, constant, scene, volume
from shading_data import ramp
from style_data import (OPACITY, SLOPE, TINT, VIEW, Styles, boundary, inside, magnitude, normal_of,
                        silhouette)

suite = Suite()
UNIT = 1.25
CHANGE = magnitude(SLOPE) * UNIT
FACING = dot(normal_of(SLOPE), VIEW)


@suite.case
def boundary_fields():
    "Boundary: Og = Ov (retained + boundary |grad f|^factor)"
    styles = Styles(suite)
    for fields, values in (
        ("", {}),
        ("retainedOpacity .6", {"retained": 0.6}),
        ("retainedOpacity 0", {"retained": 0}),
        ("boundaryOpacity .4", {"boundary": 0.4}),
        ("boundaryOpacity 0", {"boundary": 0}),
        ("opacityFactor 1", {"factor": 1}),
        ("opacityFactor 3.5", {"factor": 3.5}),
        ("opacityFactor 0 boundaryOpacity .5", {"factor": 0, "boundary": 0.5}),
    ):
        styles.add(fields or "defaults", f"BoundaryEnhancementVolumeStyle {{ {fields} }}", TINT,
                   boundary(OPACITY, CHANGE, **values), fields=f"gradientUnit {UNIT}")
    styles.draw()


@suite.case
def boundary_gradient():
    "Boundary: the gradient that counts as 1"
    styles = Styles(suite)
    plain = "BoundaryEnhancementVolumeStyle { retainedOpacity .1 boundaryOpacity .5 opacityFactor 1 }"
    styles.add("the volume's own", plain, TINT, OPACITY * 0.6)
    styles.add("the same for a weak one", plain, TINT, OPACITY * 0.6, slope=(0.03, 0.01, 0.02))
    styles.add("a given unit clamps nothing", plain, TINT, OPACITY * (0.1 + 0.5 * 2 * magnitude(SLOPE)),
               fields="gradientUnit 2")
    styles.add("the opacity is clamped", plain, TINT, 1, fields="gradientUnit 100")
    steep = "BoundaryEnhancementVolumeStyle { boundaryOpacity 1e9 opacityFactor 10 }"
    styles.add("huge, and finite", steep, TINT, 1, fields="gradientUnit 1e9")
    styles.add("no boundary, however steep",
               "BoundaryEnhancementVolumeStyle { boundaryOpacity 0 opacityFactor 10 }", TINT,
               OPACITY * 0.2, fields="gradientUnit 1e9")
    styles.draw()


@suite.case
def boundary_axes():
    "T13: ramps along x, y and z are equal"
    styles = Styles(suite)
    for axis in range(3):
        slope = tuple(0.4 * (i == axis) for i in range(3))
        styles.add("xyz"[axis], "BoundaryEnhancementVolumeStyle { }", TINT,
                   boundary(OPACITY, 0.4 * UNIT), slope=slope, fields=f"gradientUnit {UNIT}")
    styles.draw()


@suite.case
def boundary_2005():
    "Boundary as in 2005: gradientColor's share grows with the gradient, contribution weighs it"
    styles = Styles(suite)
    base = "retainedOpacity 1 boundaryOpacity 0 opacityFactor 1"

    def add(name, fields, color, share, change=CHANGE, **options):
        rgb = [t + share * (c - t) for t, c in zip(TINT, color)]
        styles.add(name, f"BoundaryEnhancementVolumeStyle {{ {base} {fields} }}", rgb, OPACITY,
                   fields=f"gradientUnit {change / magnitude(SLOPE)}", **options)

    add("colour, contribution .2", "gradientColor 1 0 0 1", (1, 0, 0), 0.2 * CHANGE)
    add("its alpha", "gradientColor 0 1 0 .5", (0, 1, 0), 0.1 * CHANGE)
    add("contribution 1", "gradientColor 1 0 0 1 contribution 1", (1, 0, 0), CHANGE)
    add("contribution .5, black", "contribution .5", (0, 0, 0), 0.5 * CHANGE)
    add("no more than all", "gradientColor 1 0 0 1 contribution 1", (1, 0, 0), 1, change=3)
    add("neither given: colours stay", "", (0, 0, 0), 0)
    styles.draw()


@suite.case
def boundary_transfer_function():
    "Boundary as in 2005: its own transfer function comes first, and replaces colour and opacity"
    styles = Styles(suite)
    for texel, rgb, alpha in ((0xFF000080, (1, 0, 0), 128), (0x00FF3340, (0, 1, 0.2), 64)):
        function = f"transferFunction PixelTexture {{ image 1 1 4 0x{texel:08X} }}"
        styles.add(hex(texel), f"BoundaryEnhancementVolumeStyle {{ {function} retainedOpacity .5 "
                   "boundaryOpacity .5 opacityFactor 2 }", rgb,
                   boundary(alpha / 255, CHANGE, 0.5, 0.5, 2), fields=f"gradientUnit {UNIT}")
    styles.draw()


@suite.case
def silhouette_fields():
    "Silhouette: Og = Ov (retained + boundary (1 - |n.V|)^sharpness)"
    styles = Styles(suite)
    for fields, values in (
        ("", {}),
        ("silhouetteRetainedOpacity .3", {"retained": 0.3}),
        ("silhouetteRetainedOpacity 0 silhouetteBoundaryOpacity 1", {"retained": 0, "boundary": 1}),
        ("silhouetteRetainedOpacity .2 silhouetteBoundaryOpacity .7", {"retained": 0.2, "boundary": 0.7}),
        ("silhouetteRetainedOpacity .2 silhouetteBoundaryOpacity .7 silhouetteSharpness 3",
         {"retained": 0.2, "boundary": 0.7, "sharpness": 3}),
        ("silhouetteRetainedOpacity .2 silhouetteBoundaryOpacity .7 silhouetteSharpness 0",
         {"retained": 0.2, "boundary": 0.7, "sharpness": 0}),
        ("silhouetteBoundaryOpacity 1 silhouetteSharpness .1", {"boundary": 1, "sharpness": 0.1}),
    ):
        styles.add(fields or "defaults: nothing", f"SilhouetteEnhancementVolumeStyle {{ {fields} }}",
                   TINT, silhouette(OPACITY, FACING, **values))
    styles.draw()


@suite.case
def silhouette_2005():
    "Silhouette as in 2005: Og = Ov (1 - |n.V|)^silhouetteFactor"
    styles = Styles(suite)
    for factor in (0.5, 2):
        styles.add(f"factor {factor}", f"SilhouetteEnhancementVolumeStyle {{ silhouetteFactor {factor} }}",
                   TINT, OPACITY * (1 - FACING) ** factor)
    styles.add("its default", "SilhouetteEnhancementVolumeStyle { }", TINT, OPACITY * (1 - FACING) ** 0.5)
    styles.draw()


STRONG = "SilhouetteEnhancementVolumeStyle { silhouetteRetainedOpacity .1 silhouetteBoundaryOpacity .8 }"
VALUES = {"retained": 0.1, "boundary": 0.8}


@suite.case
def silhouette_directions():
    "Silhouette: faces, backs and edges; normals of boxes and of turned volumes"
    styles = Styles(suite)
    for slope in ((0, 0, -0.5), (0, 0, 0.5), (0.5, 0, 0), (-0.3, 0.4, 0.2), (0.1, 0, 0.4)):
        styles.add(f"slope {slope}", STRONG, TINT,
                   silhouette(OPACITY, dot(normal_of(slope), VIEW), **VALUES), slope=slope)
    size = (0.8, 1, 0.5)
    styles.add("a box", STRONG, TINT, silhouette(OPACITY, dot(normal_of(SLOPE, size), VIEW), **VALUES),
               dimensions=size)
    normal = normal_of(SLOPE, (1, 1, 3))
    styles.add("stretched", STRONG, TINT, 1 - (1 - silhouette(OPACITY, normal[2], **VALUES)) ** (1 / 3),
               around="Transform { scale 1 1 3")
    styles.draw()


@suite.case
def silhouette_in_perspective():
    "Silhouette: the direction to the viewer is each sample's own"
    view = "Viewpoint { position 0 0 2 fieldOfView 0.8 }\n"
    text = scene(view, NO_HEADLIGHT, volume(
        'ImageTexture3D { url "ramp.nrrd" }', STRONG, inside(middle=2.0),
        "valueRange 0 1 opacityUnitDistance .125"))
    size, pixel = 21, (13, 8)
    half = math.tan(0.4)
    x, y = ((p + 0.5) / size * 2 - 1 for p in pixel)
    to_viewer = unit((-x * half, y * half, 1))
    expected = silhouette(OPACITY, dot(normal_of(SLOPE), to_viewer), **VALUES)
    got = suite.probe(text, [pixel], size=f"{size}x{size}", files={"ramp.nrrd": ramp(SLOPE)})[0]
    suite.close("", got, premultiplied(TINT, expected))


@suite.case
def no_gradient():
    "T18: where the gradient is zero Silhouette changes nothing, Boundary keeps what it retains"
    styles = Styles(suite)
    flat = constant(128, (8, 8, 8))
    styles.add("Silhouette", STRONG, TINT, OPACITY, data=flat)
    styles.add("Boundary", "BoundaryEnhancementVolumeStyle { retainedOpacity .3 }", TINT, 0.3 * OPACITY,
               data=flat)
    styles.add("Boundary, factor 0: x^0 is 1",
               "BoundaryEnhancementVolumeStyle { retainedOpacity .3 boundaryOpacity .5 opacityFactor 0 }",
               TINT, 0.8 * OPACITY, data=flat)
    styles.draw()


suite.run()
