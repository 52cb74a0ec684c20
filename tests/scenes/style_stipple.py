#!/usr/bin/env python3
"""StippleVolumeStyle: how many points there are, for each factor of the formula in the proposal of 2005."""

import math

from harness import Suite, dot, unit
from scenes import NO_HEADLIGHT, constant, effect, scene, volume
from shading_data import ramp
from style_data import VIEW, magnitude, normal_of

suite = Suite()

SIZE = 32  # voxels; a pixel is one of the 64 x 64 cells of a layer
CELLS = 2 * SIZE
MARGIN = 3  # cells whose gradient the border of the box changes
SLOPE = (0.3, -0.4, -0.2)
UNIT = 1.25
CHANGE = magnitude(SLOPE) * UNIT
FACING = dot(normal_of(SLOPE), VIEW)
DATA = 'ImageTexture3D { url "ramp.nrrd" }'
FILES = {"ramp.nrrd": ramp(SLOPE, SIZE)}
# A layer of cells behind the middle of the box.
BEHIND = -1 / 128
TINT = (0.5, 0.25, 0.75)

LAYER = """void PLUG_volume_ray(inout float t_enter, inout float t_exit, const in vec3 origin_eye,
                     const in vec3 direction_eye) { t_enter = %r - 0.004; t_exit = %r + 0.004; }
void PLUG_volume_classify(inout vec4 color, const in VolumeSample s) { color = vec4(0.5, 0.25, 0.75, %r); }"""


def seen(at, opacity, distance=10.0):
    return effect(LAYER % (distance - at, distance - at, float(opacity)))


class Points:
    """Layers of cells side by side; the share of them that is a point."""

    def __init__(self):
        self.parts = []
        self.expected = []

    def add(self, name, fields, share, *, opacity=1.0, at=BEHIND, lights="", data=DATA, unit_field=UNIT):
        # what a case does not look at is 1: Ti with interiorFactor 0, Td nearly, with distanceFactor 9
        style = f"StippleVolumeStyle {{ distanceFactor 9 interiorFactor 0 {fields} }}"
        content = volume(data, style, seen(at, opacity), f"valueRange 0 1 gradientUnit {unit_field}")
        self.parts.append(f"Transform {{ translation {len(self.parts)} 0 0 children [ {lights} {content} ] }}\n")
        self.expected.append((name, share))

    def draw(self):
        count = len(self.parts)
        view = f"OrthoViewpoint {{ position 0 0 10 fieldOfView -.5 -.5 {count - 0.5} .5 }}\n"
        picture = suite.picture(scene(view, NO_HEADLIGHT, *self.parts), files=FILES,
                                size=f"{count * CELLS}x{CELLS}")
        for i, (name, share) in enumerate(self.expected):
            suite.close(name, points_of(picture, i * CELLS), share, tolerance_of(share))


def tolerance_of(share):
    """Three and a half standard deviations of a count."""
    share = min(max(share, 0), 1)
    return 3.5 * math.sqrt(share * (1 - share)) / (CELLS - 2 * MARGIN) + 1e-6


def points_of(picture, left=0):
    inner = range(MARGIN, CELLS - MARGIN)
    alphas = [picture.at(left + x, y)[3] for y in inner for x in inner]
    suite.check("opaque or nothing", set(alphas) <= {0.0, 1.0}, sorted(set(alphas))[:5])
    return sum(alphas) / len(alphas)


@suite.case
def opacity():
    "N grows with the square of Cv: Tb and Ts both have it"
    points = Points()
    for value in (0.2, 0.5, 0.9, 1.0):
        points.add(f"Cv {value}", "", value**2, opacity=value)
    points.add("clear", "", 0, opacity=0)
    points.draw()


@suite.case
def boundary():
    "Tb: gradientRetainedOpacity, gradientBoundaryOpacity, gradientOpacityFactor, gradientThreshold"
    points = Points()
    half = "gradientRetainedOpacity .2 gradientBoundaryOpacity .7"
    angle = math.acos(FACING)
    points.add("retained .3", "gradientRetainedOpacity .3", 0.3)
    points.add("retained .8", "gradientRetainedOpacity .8", 0.8)
    points.add("boundary .7", half, 0.2 + 0.7 * CHANGE)
    points.add("boundary .4", "gradientRetainedOpacity .2 gradientBoundaryOpacity .4", 0.2 + 0.4 * CHANGE)
    points.add("factor 3", half + " gradientOpacityFactor 3", 0.2 + 0.7 * CHANGE**3)
    points.add("threshold below the angle", f"{half} gradientThreshold {angle - 0.05}", 0.2 + 0.7 * CHANGE)
    points.add("threshold above the angle", f"{half} gradientThreshold {angle + 0.05}", 0.2)
    points.draw()


@suite.case
def silhouette():
    "Ts: silhouetteRetainedOpacity, silhouetteBoundaryOpacity, silhouetteOpacityFactor"
    points = Points()
    edge = 1 - FACING
    half = "silhouetteRetainedOpacity .2 silhouetteBoundaryOpacity .7"
    points.add("retained .3", "silhouetteRetainedOpacity .3", 0.3)
    points.add("boundary .7", half, 0.2 + 0.7 * edge)
    points.add("boundary .3", "silhouetteRetainedOpacity .2 silhouetteBoundaryOpacity .3", 0.2 + 0.3 * edge)
    points.add("factor 2.5", half + " silhouetteOpacityFactor 2.5", 0.2 + 0.7 * edge**2.5)
    points.draw()


@suite.case
def distance():
    "Td: more points where the volume is near, by distanceFactor"
    points = Points()
    some = "gradientRetainedOpacity .4"
    for factor in (1, 2):
        for at in (-33 / 128, 33 / 128):
            share = 0.4 * (1 + math.copysign(abs(at / 0.5) ** factor, at))
            points.add(f"factor {factor}, {at:+.2f}", f"{some} distanceFactor {factor}", share, at=at)
    points.add("factor 0, far", f"{some} distanceFactor 0", 0, at=-33 / 128)
    points.add("factor 0, near", f"{some} distanceFactor 0", 0.8, at=33 / 128)
    points.draw()


@suite.case
def interior():
    "Ti: fewer points where the value changes little, by interiorFactor"
    points = Points()
    for factor in (0.5, 1, 2):
        points.add(f"factor {factor}", f"interiorFactor {factor}", CHANGE**factor)
    points.add("no gradient", "interiorFactor 1", 0, data=constant(9, (SIZE,) * 3))
    points.add("no gradient, factor 0", "gradientRetainedOpacity .5", 0.5, data=constant(9, (SIZE,) * 3))
    points.draw()


@suite.case
def lighting():
    "Tl: fewer points where light falls, by lightingFactor"
    points = Points()
    normal = normal_of(SLOPE)
    side = unit((-1, 2, 3))
    lit = dot(side, normal)

    def light(to):
        return "DirectionalLight { direction %r %r %r }\n" % tuple(-c for c in to)

    points.add("factor 1", "lightingFactor 1", 1 - lit, lights=light(side))
    points.add("factor 3", "lightingFactor 3", 1 - lit**3, lights=light(side))
    points.add("factor 0", "lightingFactor 0", 0, lights=light(side))
    points.add("from behind", "gradientRetainedOpacity .5", 0.5, lights=light(tuple(-s for s in side)))
    faint = unit((0, -0.3, 1))
    points.add("two lights", "lightingFactor 2", 1 - lit**2 - max(dot(faint, normal), 0) ** 2,
               lights=light(side) + light(faint))
    points.add("a light straight above and one beside", "", 0, lights=light(normal) + light(side))
    points.draw()


@suite.case
def resolution():
    "Tr: more points for a viewer who has gone away, by resolutionFactor"
    going = """DEF V OrthoViewpoint { position 0 0 10 fieldOfView -.5 -.5 .5 .5 }
DEF C TimeSensor { cycleInterval 10 loop TRUE }
DEF P PositionInterpolator { key [0 1] keyValue [0 0 10, 0 0 30] }
ROUTE C.fraction_changed TO P.set_fraction
ROUTE P.value_changed TO V.set_position
"""
    for factor, time in ((1, 0), (1, 5), (2, 5), (0, 5)):
        away = 10 + 2 * time
        style = ("StippleVolumeStyle { distanceFactor 9 interiorFactor 0 gradientRetainedOpacity .2 "
                 f"resolutionFactor {factor} }}")
        text = scene(going, NO_HEADLIGHT, volume(DATA, style, seen(BEHIND, 1, float(away)), "valueRange 0 1"))
        picture = suite.picture(text, "--time", time, files=FILES, size=f"{CELLS}x{CELLS}")
        share = 0.2 * (away / 10) ** factor
        suite.close(f"factor {factor}, {away / 10:g} times as far", points_of(picture), share,
                    tolerance_of(share))


@suite.case
def fixed():
    "points stay where they are, have the colour that comes in, and are none the fewer in longer steps"
    style = "StippleVolumeStyle { distanceFactor 9 interiorFactor 0 gradientRetainedOpacity .3 }"
    view = "OrthoViewpoint { position 0 0 10 fieldOfView -.5 -.5 .5 .5 }\n"
    text = scene(view, NO_HEADLIGHT, volume(DATA, style, seen(BEHIND, 1), "valueRange 0 1"))
    first, later = (suite.picture(text, *options, files=FILES, size=f"{CELLS}x{CELLS}")
                    for options in ((), ("--time", 7, "--step", 3)))
    suite.check("the same at another time", first.values == later.values)
    colors = {first.at(x, y) for x in range(CELLS) for y in range(CELLS)}
    suite.equal("colours", colors, {(0, 0, 0, 0), TINT + (1,)})


suite.run()
