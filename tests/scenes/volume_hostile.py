#!/usr/bin/env python3
"""Volumes that nobody should describe like this, and odd compositions of styles: an answer in time, numbers, a
message where something is wrong."""

import math

from harness import CaseError, Suite, opacity, premultiplied
from scenes import constant, effect, front_scene, scene, volume, voxels

suite = Suite()

TWO = voxels(1, (1, 1, 2), (255, 0))
DATA = constant(128, (2, 2, 2))


def finite(pixels):
    return all(math.isfinite(v) for pixel in pixels for v in pixel)


def draw(text, *arguments, pixels=((8, 8), (5, 7)), status=0, **options):
    """Finite colours of some pixels, and the result."""
    where = [word for x, y in pixels for word in ("--probe", f"{x},{y}")]
    result = suite.render(text, *where, *arguments, status=status, timeout=60, **options)
    got = [tuple(map(float, line.split())) for line in result.output.splitlines()]
    if not finite(got) or len(got) != len(pixels):
        raise CaseError(f"not numbers: {result.output}")
    return got, result


def doubled(leaf, times):
    """A style inside twice as many styles each time."""
    text = f"DEF S0 {leaf}"
    for i in range(times):
        text = f"DEF S{i + 1} ComposedVolumeStyle {{ renderStyle [ {text} USE S{i} ] }}"
    return text


@suite.case
def far_contours():
    "a value far outside the data and a small step: the contours in the data, at once"
    def contours(value):
        text = f"IsoSurfaceVolumeData {{ voxels {TWO} surfaceValues {value} contourStepSize 0.125 }}\n"
        return draw(front_scene(text))[0][0]
    expected = contours(0.5)
    for value in (64, -32, 1e14, -1e14):
        suite.close(f"{value:g}", contours(value), expected)


@suite.case
def doubled_styles():
    "2^28 styles in a few lines: an error at the limit, soon"
    for leaf in ("OpacityMapVolumeStyle { }", "OpacityMapVolumeStyle { enabled FALSE }"):
        _, result = draw(front_scene(volume(DATA, doubled(leaf, 28))), status=1)
        suite.equal(leaf, [m[3] for m in result.with_code("limit")], ["error"])


@suite.case
def sizes():
    "huge and tiny boxes of the same place in the scene: the same picture, or an error where no float is left"
    for style in ("", "ShadedVolumeStyle { lighting TRUE }"):
        pictures = []
        for size in (1, 1e-12, 1e12):
            box = volume(TWO, style, dimensions=(size,) * 3)
            pictures.append(draw(front_scene(f"Transform {{ scale {1 / size} {1 / size} {1 / size} children [ {box} ] }}"))[0])
        for size, got in zip((1e-12, 1e12), pictures[1:]):
            for pixel, want in zip(got, pictures[0]):
                suite.close(f"{style} {size:g}", pixel, want)
    for size in (1e-38, 1e20):
        for fields, dimensions in ((f"scale {1 / size} {1 / size} {1 / size}", size), (f"scale {size} 1 1", 1), ("", size)):
            box = volume(TWO, dimensions=(dimensions,) * 3)
            got, result = draw(front_scene(f"Transform {{ {fields} children [ {box} ] }}"), status=1)
            suite.equal(f"{size:g} {fields}", (got[0], [m[3] for m in result.with_code("bad-volume")]),
                        ((0, 0, 0, 0), ["error"]))


suite.run()
