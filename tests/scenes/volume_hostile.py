#!/usr/bin/env python3
"""Volumes that nobody should describe like this, and odd compositions of styles: an answer in time, numbers, a
message where something is wrong."""

import math
import os

from harness import CaseError, Picture, Suite
from scenes import constant, front_scene, scene, volume, voxels

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


def film(text, count, fps=1):
    """The middle pixel of each picture of a film."""
    result = suite.render(text, "--frames", count, "--fps", fps, "-o", "film.npy", size="1x1", status=None, timeout=60)
    names = sorted(name for name in os.listdir(result.folder) if name.endswith(".npy"))
    return [Picture(os.path.join(result.folder, name)).at(0, 0) for name in names]


def alternating(interpolator, first, second, route):
    """`first` and `second`, two seconds each, again and again."""
    return (f"DEF T TimeSensor {{ loop TRUE cycleInterval 4 }}\nDEF I {interpolator} {{ key [ 0 .5 .5 1 ] keyValue "
            f"[ {first} {first} {second} {second} ] }}\n"
            f"ROUTE T.fraction_changed TO I.set_fraction ROUTE I.value_changed TO {route}\n")


@suite.case
def without_extent_for_a_while():
    "a volume that is squeezed to nothing comes back"
    for nothing in ("1 0 1", "1e-30 1e-30 1e-30"):
        got = film(front_scene(f"DEF G Transform {{ children [ {volume(DATA)} ] }}\n",
                               alternating("PositionInterpolator", "1 1 1", nothing, "G.scale")), 8)
        suite.equal(nothing, [pixel[3] > 0.5 for pixel in got[1::2]], [True, False, True, False])


EVERY_STYLE = (
    "OpacityMapVolumeStyle { }", "BoundaryEnhancementVolumeStyle { }", "CartoonVolumeStyle { }",
    "EdgeEnhancementVolumeStyle { }", "SilhouetteEnhancementVolumeStyle { }", "ToneMappedVolumeStyle { }",
    "DEF LIT ShadedVolumeStyle { lighting TRUE shadows TRUE }", "StippleVolumeStyle { }", "ISOSurfaceVolumeStyle { lighting TRUE }",
    "ComposedVolumeStyle { }", "BlendedVolumeStyle { }", f"BlendedVolumeStyle {{ voxels {DATA} renderStyle USE LIT }}")
LABELS = voxels(1, (2, 2, 2), (0, 3, 6, 8, 9, 10, 11, 12))


@suite.case
def every_style_inside():
    "every style in segments, surfaces and a list, with shadows and without light: numbers and no message"
    head = "OrthoViewpoint { position 0 0 10 fieldOfView -1 -1 1 1 }\nDirectionalLight { direction -1 -1 -1 }\n"
    styles = " ".join(EVERY_STYLE)
    for name, text in (
        ("segments", f"SegmentedVolumeData {{ voxels {TWO.replace('1 1 1 2 255 0', '1 2 2 2 255 0 9 80 70 60 50 40')} "
                     f"segmentIdentifiers {LABELS} renderStyle [ {styles} ] }}\n"),
        ("surfaces", f"IsoSurfaceVolumeData {{ voxels {TWO} surfaceValues [ .1 .2 .3 .4 .5 .6 .7 .8 .9 ] renderStyle [ {styles} ] }}\n"),
        ("a list, in the dialect of 2005", volume(TWO, f"ComposedVolumeStyle {{ renderStyle [ {styles} ] }}")),
    ):
        _, result = draw(scene(head, text))
        suite.equal(name, [m[4] for m in result.messages() if "no value of its own" not in m[4]], [])


@suite.case
def other_commands():
    "what the other commands say of volumes that hold nothing, or one thing thrice"
    data = f"DEF D {DATA}"
    text = front_scene(
        "VolumeData { renderStyle NULL voxels NULL }\n",
        f"DEF A VolumeData {{ writeDepth TRUE voxels {data} renderStyle DEF B BlendedVolumeStyle {{ voxels USE D "
        "renderStyle DEF S ShadedVolumeStyle { lighting TRUE shadows TRUE } } }\nUSE A\n",
        "Transform { translation .3 0 0 children [ USE A USE A ] }\n",
        "SegmentedVolumeData { voxels USE D segmentIdentifiers USE D renderStyle [ USE B USE S USE B ] }\n",
        "IsoSurfaceVolumeData { voxels USE D gradients USE D renderStyle [ ] }\n")
    for command in ("check", "info", "plugs"):
        result = suite.command(command, "scene.x3dv", files={"scene.x3dv": text}, status=0)
        suite.check(command, "runtime error" not in result.errors, result.errors)
    suite.command("dump", "scene.x3dv", "-d", "programs", files={"scene.x3dv": text}, status=0)


@suite.case
def eye_on_a_corner():
    "a projection that only the eye itself touches is not there"
    box = volume(DATA, "ProjectionVolumeStyle { }")
    for place, want in (("0.5 0.5 0.5", [False, True]), ("0.5 0 -0.5", [False, False]), ("0 0 0.5", [True, True])):
        got, _ = draw(scene(f"Viewpoint {{ position {place} }}\n", box), pixels=((12, 4), (4, 12)))
        suite.equal(place, [pixel[3] > 0.5 for pixel in got], want)


@suite.case
def null_members():
    "NULL in a list is skipped, with a warning; an empty list changes nothing"
    want = draw(front_scene(volume(DATA, "ComposedVolumeStyle { }")))[0][0]
    suite.check("an empty list draws", want[3] > 0.5, want)
    for style in ("ComposedVolumeStyle { renderStyle [ NULL NULL ] }",
                  "ComposedVolumeStyle { renderStyle ComposedVolumeStyle { renderStyle [ NULL ] } }"):
        got, result = draw(front_scene(volume(DATA, style)))
        suite.close(style, got[0], want)
        suite.equal("a warning", {m[3] for m in result.with_code("bad-node")}, {"warning"})
    off = "ComposedVolumeStyle { renderStyle [ NULL CartoonVolumeStyle { enabled FALSE } ] }"
    suite.close(off, draw(front_scene(volume(DATA, off)))[0][0], (0, 0, 0, 0))


suite.run()
